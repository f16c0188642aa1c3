//! A four-bar linkage whose coupler is a leaf spring: a closed loop that also twists it out of its plane.

use crate::build::{Stiffness, UNSHEARABLE, clamped};
use crate::measure::{Units, apart, largest_deviation, parts, root, solve, tip, worst};
use crate::{Case, Row};
use flexura_model::{
    Beam, Body, BodyId, Curve, Drive, Frame, Joint, JointKind, JointLaw, Load, LoadFrame, LoadTarget, Model,
    Mount, SectionFrame, SectionId,
};
use flexura_solution::Solution;
use flexura_spatial::{Matrix3, Pose, Vector3, Wrench, exp};
use flexura_testkit::collocation::{self, Mesh, Tip};
use flexura_testkit::rod::Rod;

pub const CASES: [Case; 2] = [
    Case {
        id: "four_bar_balance",
        title: "Four-bar with a compliant coupler, axes not parallel: balance of every body",
        citation: "force and moment of joint, coupler, weight and load sum to zero, and so does the free joint's \
                   effort",
        needed: "1e-10 of EI/L² and EI/L",
        run: balance,
        closed_form: None,
    },
    Case {
        id: "four_bar",
        title: "Four-bar with a compliant coupler, axes not parallel",
        citation: "a run at a ten times finer tolerance; and collocation of the coupler from the one crank, which \
                   must arrive at the other",
        needed: "1e-8",
        run: compared,
        closed_form: None,
    },
];

/// EA, GJ, EI2, EI3 of a leaf that bends easily about e3, N and N·m²; cranks of 40 mm, ground 100 mm.
const LEAF: Stiffness = Stiffness { ea: 3e5, ga: f64::INFINITY, gj: 9e-4, ei2: 0.5, ei3: 6e-4 };
const SPAN: f64 = 0.1;
const CRANK: f64 = 0.04;
const GRAVITY: Vector3<f64> = Vector3::new(0.0, -9.81, 0.0);
const MASS: [f64; 2] = [0.02, 0.03];
const CENTER: Vector3<f64> = Vector3::new(0.004, 0.02, 0.001);
/// On the free crank, at the coupler's clamp.
const PULL: Vector3<f64> = Vector3::new(0.15, 0.0, 0.1);

fn revolute(name: &str, at: Vector3<f64>, axis: Vector3<f64>, child: usize) -> Joint {
    Joint {
        name: name.to_string(),
        parent: Frame { mount: Mount::Ground, pose: Pose::translation(at) },
        child: Mount::Body(BodyId(child)),
        child_pose: None,
        law: JointLaw::free(JointKind::Revolute, axis.normalize()),
    }
}

fn crank(name: &str, at: Vector3<f64>, mass: f64) -> Body {
    Body {
        name: name.to_string(),
        pose: Pose::translation(at),
        mass,
        center_of_mass: CENTER,
        inertia: Matrix3::zeros(),
    }
}

fn model() -> Model {
    let mut model = Model { gravity: GRAVITY, ..Model::default() };
    let far = Vector3::new(SPAN, 0.0, 0.0);
    model.sections.push(LEAF.section());
    model.bodies.push(crank("driver", Vector3::zeros(), MASS[0]));
    model.bodies.push(crank("follower", far, MASS[1]));
    model.joints.push(revolute("drive", Vector3::zeros(), Vector3::z(), 0));
    model.joints[0].law.coordinates[0].drive = Drive::Driven { coordinate: 0.6 };
    model.joints.push(revolute("pivot", far, Vector3::new(0.25, 0.1, 1.0), 1));
    let top = Pose::translation(Vector3::new(0.0, CRANK, 0.0));
    // The follower's end of the leaf is turned by 0.4 rad about it: a twist that stays.
    let turned = Pose::new(exp(&Vector3::new(0.4, 0.0, 0.0)), top.position);
    model.beams.push(Beam {
        name: "coupler".to_string(),
        material: None,
        section: SectionId(0),
        curve: Curve::Straight { length: SPAN },
        frame: SectionFrame::Natural,
        theory: UNSHEARABLE,
        damping: 0.0,
        added_mass: 0.0,
        start: Some(clamped(Mount::Body(BodyId(0)), Some(top))),
        end: Some(clamped(Mount::Body(BodyId(1)), Some(turned))),
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    model.loads.push(Load {
        name: "pull".to_string(),
        target: LoadTarget::Body { body: BodyId(1), point: top.position },
        force: PULL,
        moment: Vector3::zeros(),
        frame: LoadFrame::Global,
    });
    model
}

fn units() -> Units {
    Units { length: SPAN, stiffness: LEAF.softest() }
}

/// The sum of a body's forces, and of its moments about the global origin, scaled.
fn unbalanced(solution: &Solution, body: usize) -> Result<f64, String> {
    let pose = solution.bodies[body];
    let beam = &solution.beams[0];
    // The joint's frame M is at the body's origin. A beam pulls on what holds its start with its internal
    // wrench, and on what holds its end with the opposite.
    let (sample, sign) = if body == 0 { (root(beam)?, 1.0) } else { (tip(beam)?, -1.0) };
    let mut all = vec![
        (pose.position, solution.joints[body].wrench),
        (sample.pose.position, sample.wrench * sign),
        (pose.point(&CENTER), Wrench::new(GRAVITY * MASS[body], Vector3::zeros())),
    ];
    if body == 1 {
        let clamp = pose.point(&Vector3::new(0.0, CRANK, 0.0));
        all.push((clamp, Wrench::new(PULL, Vector3::zeros())));
    }
    let force: Vector3<f64> = all.iter().map(|(_, wrench)| wrench.force).sum();
    let moment: Vector3<f64> =
        all.iter().map(|(point, wrench)| wrench.moment + point.cross(&wrench.force)).sum();
    Ok(worst([force.norm() / units().force(), moment.norm() / units().moment()]))
}

fn balance() -> Result<Vec<Row>, String> {
    let solution = solve(&model(), 1e-8)?;
    let names = ["driver", "follower"];
    let mut rows = Vec::new();
    for (body, name) in names.iter().enumerate() {
        let row =
            Row::vanishing(format!("forces and moments on the {name}"), unbalanced(&solution, body)?, 1e-10);
        rows.push(row.with_estimate(solution.error_estimate));
    }
    // The pivot's axis is fixed in the ground.
    let axis = Vector3::new(0.25, 0.1, 1.0).normalize();
    let effort = solution.joints[1].wrench.moment.dot(&axis) / units().moment();
    rows.push(Row::vanishing("moment about the free pivot", effort.abs(), 1e-10));
    let (a, b) = (root(&solution.beams[0])?, tip(&solution.beams[0])?);
    let lever = b.pose.position - a.pose.position;
    let moment = a.wrench.moment - b.wrench.moment - lever.cross(&b.wrench.force);
    let force = a.wrench.force - b.wrench.force;
    let off = worst([force.norm() / units().force(), moment.norm() / units().moment()]);
    rows.push(Row::vanishing("forces and moments on the coupler", off, 1e-10));
    Ok(rows)
}

fn compared() -> Result<Vec<Row>, String> {
    let usual = solve(&model(), 1e-8)?;
    let fine = solve(&model(), 1e-9)?;
    let off = apart(&usual.beams[0], &fine.beams[0], &units())?;
    let bodies = worst(usual.bodies.iter().zip(&fine.bodies).map(|(a, b)| {
        let shift = (a.position - b.position).norm() / SPAN;
        shift.max(a.rotation.angle_to(&b.rotation))
    }));
    let angles = |solution: &Solution| solution.joints[1].coordinates[0];
    let twist = tip(&fine.beams[0])?;
    let carried = (twist.pose.rotation.inverse() * twist.wrench.moment).x / units().moment();
    let exact = collocated(&fine)?;
    let against = largest_deviation(&usual.beams[0], &units(), &|s| parts(&exact.at(s)));
    let estimate = usual.error_estimate;
    // A loop that did not carry twist would not be this case.
    if carried.abs() < 0.1 {
        return Err(format!("the coupler carries no twist: {carried} EI/L"));
    }
    Ok(vec![
        Row::vanishing("coupler, all poses and wrenches, scaled", off, 1e-8).with_estimate(estimate),
        Row::vanishing("poses of the cranks", bodies, 1e-8).with_estimate(estimate),
        Row::absolute("angle of the follower, rad", angles(&fine), angles(&usual), 1e-8)
            .with_estimate(estimate),
        Row::vanishing("coupler against collocation, scaled", against, 1e-8).with_estimate(estimate),
    ])
}

/// The coupler from the driver's clamp under the force and moment that the follower exerts on its end. It must
/// arrive where the follower is.
fn collocated(solution: &Solution) -> Result<collocation::Solution, String> {
    let (start, end) = (root(&solution.beams[0])?.pose, tip(&solution.beams[0])?.wrench);
    let rod = Rod::uniform(SPAN, LEAF.compliance(), Vector3::zeros());
    let dead = |fraction: f64| Tip::Dead(end * fraction);
    collocation::solve(&rod, &start, &dead, 10, Mesh { elements: 2, degree: 20 })
        .map_err(|error| format!("collocation of the coupler: {error:?}"))
}
