//! A mechanism with something of everything that an invariance could break.

use flexura_expression::Function;
use flexura_model::*;
use flexura_spatial::{Matrix3, Pose, Vector3, exp};

/// What is drawn at random.
#[derive(Clone, Debug)]
pub struct Draw {
    /// Strength of all loads, 0.3 to 1.
    pub strength: f64,
    /// A direction, any vector.
    pub direction: [f64; 3],
}

pub const MAST: usize = 0;
pub const ARM: usize = 1;
pub const WHIP: usize = 2;
pub const STAGE: usize = 0;

fn placed(turn: [f64; 3], at: [f64; 3]) -> Pose {
    Pose::new(exp(&Vector3::from(turn)), Vector3::from(at))
}

fn constants(v: Vector3<f64>) -> [Profile; 3] {
    [v.x, v.y, v.z].map(Profile::Constant)
}

fn end(body: Mount, placement: Option<Pose>, kind: JointKind) -> Option<End> {
    Some(End { mount: body, placement, hold: JointLaw::free(kind, Vector3::x()) })
}

fn body(name: &str, pose: Pose, mass: f64) -> Body {
    Body {
        name: name.to_string(),
        pose,
        mass,
        center_of_mass: Vector3::new(0.05, -0.02, 0.04),
        inertia: Matrix3::identity(),
    }
}

fn on(beam: usize, fraction: f64) -> BeamPoint {
    BeamPoint { beam: BeamId(beam), at: At::Fraction(fraction) }
}

fn law(text: &str) -> Function {
    Function::parse(text, "u").expect("a law")
}

fn foundation(law: FoundationLaw, direction: Option<Vector3<f64>>, between: [f64; 2]) -> Foundation {
    Foundation { law, direction, axes: LoadAxes::Global, between: between.map(At::Fraction) }
}

/// A stage on a straight mast and a curved arm that is pinned to the ground; a tapering whip that grows from
/// the stage; a lever that turns on the stage against a spring; gravity, dead and following loads, at ends, at
/// stations and along the way; mast and whip on foundations. Lengths, stiffnesses and loads are of the order of one.
pub fn mechanism(draw: &Draw) -> Model {
    let along = Vector3::from(draw.direction).normalize() * draw.strength;
    let across = Vector3::new(along.z, along.x, along.y);
    let mut model = Model { gravity: across * 1.5, ..Model::default() };
    add_sections(&mut model);
    let (ground, stage) = (Mount::Ground, Mount::Body(BodyId(STAGE)));
    let root = placed([0.0, -1.3, 0.2], [0.1, 0.0, -0.1]);
    // At the mast's end, turned a little against it.
    let top = root * placed([0.3, 0.1, -0.2], [1.0, 0.0, 0.0]);
    model.bodies.push(body("stage", top, 0.2));
    model.bodies.push(body("lever", top * placed([0.0, 0.4, 0.0], [0.1, 0.2, 0.0]), 0.1));
    let beam = |name: &str, section: usize, curve: Curve, start, end, theory| Beam {
        name: name.to_string(),
        material: Some(MaterialId(0)),
        section: SectionId(section),
        curve,
        frame: SectionFrame::Natural,
        theory,
        damping: 0.0,
        added_mass: 0.0,
        start,
        end,
        distributed: Vec::new(),
        foundation: Vec::new(),
    };
    let full = BeamTheory { shear: true, extension: true };
    let mut mast = beam(
        "mast",
        0,
        Curve::Straight { length: 1.0 },
        end(ground, Some(root), JointKind::Weld),
        end(stage, None, JointKind::Weld),
        full,
    );
    let force = constants(along * 0.8);
    mast.distributed.push(Distributed {
        force,
        moment: constants(across * 0.1),
        axes: LoadAxes::Global,
        between: Distributed::EVERYWHERE,
    });
    mast.foundation = vec![
        foundation(FoundationLaw::Linear(2.0.into()), None, [0.0, 1.0]),
        foundation(FoundationLaw::Force(law("1.5*u + 8*u^3")), Some(across.normalize()), [0.0, 1.0]),
    ];
    model.beams.push(mast);
    let side = placed([0.2, 1.0, 0.4], [0.0, 0.1, 0.1]);
    model.beams.push(beam(
        "arm",
        0,
        Curve::Arc { radius: 0.9, angle: 0.8 },
        end(stage, Some(side), JointKind::Weld),
        end(ground, None, JointKind::Spherical),
        full,
    ));
    let other = placed([1.2, -0.5, 0.3], [-0.1, 0.0, 0.05]);
    let helix = Curve::Helix { radius: 0.2, pitch: 0.3, turns: 0.6 };
    let mut whip =
        beam("whip", 1, helix, end(stage, Some(other), JointKind::Weld), None, BeamTheory::default());
    let force = constants(across * 0.4);
    whip.distributed.push(Distributed {
        force,
        moment: constants(along * 0.05),
        axes: LoadAxes::Section,
        between: Distributed::EVERYWHERE,
    });
    let aside = Some(Vector3::new(0.1, 0.8, -0.5).normalize());
    let bed = foundation(FoundationLaw::Force(law("3*sin(u)")), aside, [0.2, 0.9]);
    whip.foundation.push(Foundation { axes: LoadAxes::Section, ..bed });
    model.beams.push(whip);
    add_joints_and_loads(&mut model, along, across);
    model
}

fn add_sections(model: &mut Model) {
    let p = Profile::Constant;
    model.materials.push(Material {
        name: "soft".to_string(),
        young: 2.3e5,
        shear: 0.9e5,
        density: Some(50.0),
        yield_strength: None,
    });
    model.sections.push(Section {
        name: "uneven".to_string(),
        shape: Shape::Stiffness {
            ea: p(300.0),
            gj: p(0.8),
            ei2: p(1.0),
            ei3: p(2.5),
            ga2: Some(p(90.0)),
            ga3: Some(p(70.0)),
            mass_per_length: Some(p(0.1)),
            rotary_inertia: None,
        },
        plane_strain: false,
    });
    let at = vec![At::Fraction(0.0), At::Fraction(0.3), At::Fraction(1.0)];
    model.sections.push(Section {
        name: "tapering".to_string(),
        shape: Shape::Rectangle {
            width: Profile::Table { at, value: vec![0.12, 0.1, 0.07] },
            height: p(0.08),
        },
        plane_strain: false,
    });
}

fn add_joints_and_loads(model: &mut Model, along: Vector3<f64>, across: Vector3<f64>) {
    let (stage, lever) = (Mount::Body(BodyId(STAGE)), Mount::Body(BodyId(1)));
    let mut turn = JointLaw::free(JointKind::Revolute, Vector3::new(0.6, 0.0, 0.8));
    turn.coordinates[0] = CoordinateLaw {
        drive: Drive::Free { effort: 0.1 },
        stiffness: 0.7,
        rest: 0.2,
        damping: 0.0,
        limits: None,
    };
    model.joints.push(Joint {
        name: "turn".to_string(),
        parent: Frame { mount: stage, pose: placed([0.1, 0.0, 0.3], [0.1, 0.2, 0.0]) },
        child: lever,
        child_pose: None,
        law: turn,
    });
    let ground = |x, y, z| Attachment { mount: Mount::Ground, point: Vector3::new(x, y, z) };
    let on_lever = Attachment { mount: lever, point: Vector3::new(0.2, 0.0, 0.1) };
    model.springs.push(Spring::linear("stay", on_lever, ground(0.5, 1.0, 0.5), 0.8));
    let on_whip = Attachment::on_beam(on(WHIP, 0.4));
    model.springs.push(Spring::linear("guy", on_whip, ground(-0.5, 0.2, 1.0), 0.5));
    model.masses.push(PointMass {
        name: "weight".to_string(),
        point: on(ARM, 0.3),
        mass: 0.15,
        inertia: flexura_spatial::Matrix3::zeros(),
    });
    let mut load = |name: &str, target, force, moment, frame| {
        model.loads.push(Load { name: name.to_string(), target, force, moment, frame });
    };
    let at_lever = LoadTarget::Body { body: BodyId(1), point: Vector3::new(0.0, 0.1, 0.1) };
    load("push", at_lever, across * 0.5, along * 0.1, LoadFrame::Global);
    let at_stage = LoadTarget::Body { body: BodyId(STAGE), point: Vector3::new(0.1, 0.0, 0.0) };
    load("jet", at_stage, along * 0.4, across * 0.2, LoadFrame::Local);
    load("side", LoadTarget::Beam(on(MAST, 0.3)), along * 0.7, across * 0.3, LoadFrame::Local);
    load("tip", LoadTarget::Beam(on(WHIP, 1.0)), across * 0.6, along * 0.1, LoadFrame::Global);
}
