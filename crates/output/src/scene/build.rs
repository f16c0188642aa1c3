//! From a model and the rest shapes of its beams to the scene.

use super::contact::boundaries;
use super::sections::dimensions;
use super::{
    BeamScene, BodyScene, CableScene, DistributedScene, FoundationScene, HoldScene, JointScene, LoadDocument,
    LoadScene, MassScene, PlaceDocument, SceneDocument, SpringScene, TubeScene, TubesScene, UnitsDocument,
    WrapScene,
};
use crate::document::{all_finite, finite, finite_list, finite_vectors, quaternion, section_quaternions};
use crate::svg::initial_pose;
use crate::{Named, OutputError};
use flexura_model::{
    Attachment, Beam, BeamPoint, Cable, Distributed, Drive, End, Foundation, Frame, Guide, Joint, JointKind,
    Load, LoadAxes, LoadFrame, LoadTarget, Model, Mount, Obstacle, Spring, SpringLaw, Tubes, Wrap,
};
use flexura_solution::{BeamSolution, Solution};
use flexura_spatial::{Pose, Vector3};

/// Places at which a load per length is told.
const COMB: usize = 9;
/// Places along a channel.
const CHANNEL: usize = 25;

/// What there is to draw; rest shapes are those of the solution's samples.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn scene(model: &Model, solution: &Solution) -> Result<SceneDocument, OutputError> {
    let beams = model.beams.iter().zip(&solution.beams);
    Ok(SceneDocument {
        units: units(model),
        gravity: all_finite(model.gravity.into(), || "scene.gravity".into())?,
        beams: Named::collect(beams, |(beam, result)| {
            Ok((beam.name.clone(), beam_scene(model, solution, beam, result)?))
        })?,
        bodies: Named::collect(model.bodies.iter(), |body| {
            let field = |part: &str| format!("scene.bodies.{}.{part}", body.name);
            let scene = BodyScene {
                position: all_finite(body.pose.position.into(), || field("position"))?,
                rotation: all_finite(quaternion(&body.pose.rotation), || field("rotation"))?,
                mass: finite(body.mass, || field("mass"))?,
                center_of_mass: all_finite(body.center_of_mass.into(), || field("center_of_mass"))?,
            };
            Ok((body.name.clone(), scene))
        })?,
        joints: Named::collect(model.joints.iter(), |joint| {
            Ok((joint.name.clone(), joint_scene(model, solution, joint)?))
        })?,
        springs: Named::collect(model.springs.iter(), |spring| {
            Ok((spring.name.clone(), spring_scene(model, solution, spring)?))
        })?,
        cables: Named::collect(model.cables.iter(), |cable| {
            Ok((cable.name.clone(), cable_scene(model, solution, cable)?))
        })?,
        tubes: Named::collect(model.tubes.iter(), |tubes| {
            Ok((tubes.name.clone(), tubes_scene(model, solution, tubes)?))
        })?,
        masses: Named::collect(model.masses.iter(), |mass| {
            let path = format!("scene.masses.{}", mass.name);
            let place = on_beam(model, solution, &path, mass.point, Vector3::zeros())?;
            Ok((mass.name.clone(), MassScene { place, mass: finite(mass.mass, || path.clone())? }))
        })?,
        loads: Named::collect(model.loads.iter(), |load| {
            Ok((load.name.clone(), load_scene(model, solution, load)?))
        })?,
        text: None,
    })
}

/// Forces and moments of the loads of a model that is like `first` but for the values of parameters: those that differ.
///
/// # Errors
/// As [`scene`].
pub fn loads(first: &Model, model: &Model) -> Result<Named<LoadDocument>, OutputError> {
    let differing = first.loads.iter().zip(&model.loads);
    let differing = differing.filter(|(a, b)| (a.force, a.moment) != (b.force, b.moment));
    Named::collect(differing, |(_, load)| {
        let field = |part: &str| format!("loads.{}.{part}", load.name);
        let document = LoadDocument {
            force: all_finite(load.force.into(), || field("force"))?,
            moment: all_finite(load.moment.into(), || field("moment"))?,
        };
        Ok((load.name.clone(), document))
    })
}

fn units(model: &Model) -> UnitsDocument {
    let pair = |name: &String, unit: &String| (name.clone(), unit.clone());
    UnitsDocument {
        outputs: Named(model.outputs.iter().map(|output| pair(&output.name, &output.unit)).collect()),
        parameters: Named(model.parameters.iter().map(|given| pair(&given.name, &given.unit)).collect()),
    }
}

/// A pose on a mount.
fn place(
    model: &Model,
    solution: &Solution,
    path: &str,
    mount: Mount,
    pose: &Pose,
) -> Result<PlaceDocument, OutputError> {
    let rotation = all_finite(quaternion(&pose.rotation), || format!("{path}.rotation"))?;
    let (body, beam, s) = match mount {
        Mount::Ground => (None, None, None),
        Mount::Body(id) => (Some(model[id].name.clone()), None, None),
        Mount::Beam(at) => (None, Some(model[at.beam].name.clone()), Some(arc_length(solution, at))),
    };
    Ok(PlaceDocument {
        body,
        beam,
        s: s.map(|s| finite(s, || format!("{path}.s"))).transpose()?,
        position: all_finite(pose.position.into(), || format!("{path}.position"))?,
        rotation: (rotation != [1.0, 0.0, 0.0, 0.0]).then_some(rotation),
    })
}

fn arc_length(solution: &Solution, at: BeamPoint) -> f64 {
    solution.beams.get(at.beam.0).map_or(0.0, |beam| at.at.arc_length(beam.length))
}

fn on_beam(
    model: &Model,
    solution: &Solution,
    path: &str,
    at: BeamPoint,
    point: Vector3<f64>,
) -> Result<PlaceDocument, OutputError> {
    place(model, solution, path, Mount::Beam(at), &Pose::translation(point))
}

fn beam_scene(
    model: &Model,
    solution: &Solution,
    beam: &Beam,
    result: &BeamSolution,
) -> Result<BeamScene, OutputError> {
    let path = format!("scene.beams.{}", beam.name);
    let material = beam.material.map(|id| &model[id]);
    let samples = || result.samples.iter();
    let rotations = section_quaternions(samples().map(|sample| &sample.rest_pose.rotation));
    let size = dimensions(&path, &model[beam.section].shape, result.length)?;
    let hold = |end: &Option<End>, is_start: bool| {
        let scene = |end: &End| hold_scene(model, solution, &path, end, result, is_start);
        end.as_ref().map(scene).transpose()
    };
    Ok(BeamScene {
        section: model[beam.section].name.clone(),
        shape: size.shape.to_owned(),
        material: material.map(|material| material.name.clone()),
        yield_strength: material.and_then(|material| material.yield_strength),
        stations: size.stations,
        width: size.width,
        height: size.height,
        inner: size.inner,
        s: finite_list(&format!("{path}.s"), samples().map(|sample| sample.s))?,
        position: finite_vectors(&path, "position", samples().map(|s| s.rest_pose.position.into()))?,
        rotation: finite_vectors(&path, "rotation", rotations.into_iter())?,
        start: hold(&beam.start, true)?,
        end: hold(&beam.end, false)?,
        distributed: beam
            .distributed
            .iter()
            .map(|load| distributed_scene(&path, load, result.length))
            .collect::<Result<_, _>>()?,
        foundations: beam
            .foundation
            .iter()
            .map(|foundation| foundation_scene(&path, foundation, result.length))
            .collect::<Result<_, _>>()?,
    })
}

fn hold_scene(
    model: &Model,
    solution: &Solution,
    path: &str,
    end: &End,
    result: &BeamSolution,
    is_start: bool,
) -> Result<HoldScene, OutputError> {
    let sample = if is_start { result.samples.first() } else { result.samples.last() };
    let carrier = initial_pose(model, solution, end.mount);
    // Without a place of its own a start has the axes of what holds it, an end those of the rest shape.
    let own = match (end.placement, sample) {
        (Some(placement), _) => placement,
        (None, Some(sample)) if !is_start => carrier.inverse() * sample.rest_pose,
        _ => Pose::identity(),
    };
    Ok(HoldScene {
        kind: word(end.hold.kind).to_owned(),
        axis: all_finite((own.rotation * end.hold.axis).into(), || format!("{path}.axis"))?,
        place: place(model, solution, path, end.mount, &own)?,
    })
}

fn distributed_scene(path: &str, load: &Distributed, length: f64) -> Result<DistributedScene, OutputError> {
    let path = format!("{path}.distributed");
    let s: Vec<f64> = (0..COMB).map(|i| length * i as f64 / (COMB - 1) as f64).collect();
    let along = |profiles: &[flexura_model::Profile; 3], field: &str| {
        let values = s.iter().map(|s| [0, 1, 2].map(|i| profiles[i].value(*s, length)));
        finite_vectors(&path, field, values)
    };
    let (force, moment) = (along(&load.force, "force")?, along(&load.moment, "moment")?);
    Ok(DistributedScene { frame: axes(load.axes).to_owned(), s: s.clone(), force, moment })
}

fn foundation_scene(
    path: &str,
    foundation: &Foundation,
    length: f64,
) -> Result<FoundationScene, OutputError> {
    let path = format!("{path}.foundations");
    let between = foundation.between.map(|at| at.arc_length(length));
    let direction = foundation.direction.map(|direction| all_finite(direction.into(), || path.clone()));
    Ok(FoundationScene {
        between: all_finite(between, || path.clone())?,
        direction: direction.transpose()?,
        frame: axes(foundation.axes).to_owned(),
    })
}

fn axes(axes: LoadAxes) -> &'static str {
    match axes {
        LoadAxes::Global => "global",
        LoadAxes::Section => "section",
    }
}

fn joint_scene(model: &Model, solution: &Solution, joint: &Joint) -> Result<JointScene, OutputError> {
    let path = format!("scene.joints.{}", joint.name);
    let child_pose = joint.child_pose.unwrap_or_else(|| {
        let parent = initial_pose(model, solution, joint.parent.mount) * joint.parent.pose;
        initial_pose(model, solution, joint.child).inverse() * parent
    });
    let law = &joint.law;
    let is_driven = |law: &flexura_model::CoordinateLaw| matches!(law.drive, Drive::Driven { .. });
    Ok(JointScene {
        kind: word(law.kind).to_owned(),
        parent: place(model, solution, &path, joint.parent.mount, &joint.parent.pose)?,
        child: place(model, solution, &path, joint.child, &child_pose)?,
        axis: all_finite(law.axis.into(), || format!("{path}.axis"))?,
        second_axis: all_finite(law.second_axis.into(), || format!("{path}.second_axis"))?,
        driven: law.coordinates.iter().any(is_driven),
        boundaries: boundaries(&path, law)?,
    })
}

/// The word of the model file.
fn word(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Weld => "weld",
        JointKind::Revolute => "revolute",
        JointKind::Prismatic => "prismatic",
        JointKind::Cylindrical => "cylindrical",
        JointKind::Universal => "universal",
        JointKind::Spherical => "spherical",
        JointKind::Planar => "planar",
        JointKind::Free => "free",
        JointKind::Rolling(_) => "rolling",
        JointKind::Contact => "contact",
        JointKind::SurfaceRolling => "surface_rolling",
    }
}

fn spring_scene(model: &Model, solution: &Solution, spring: &Spring) -> Result<SpringScene, OutputError> {
    let path = format!("scene.springs.{}", spring.name);
    let end = |end: &Attachment| place(model, solution, &path, end.mount, &Pose::translation(end.point));
    Ok(SpringScene {
        from: end(&spring.from)?,
        to: end(&spring.to)?,
        law: match spring.law {
            SpringLaw::Linear { .. } => "linear",
            SpringLaw::Exponential { .. } => "exponential",
            SpringLaw::Toe { .. } => "toe",
            SpringLaw::Table { .. } => "table",
        }
        .to_owned(),
        wrap: spring.wrap.as_ref().map(|wrap| wrap_scene(model, solution, &path, wrap)).transpose()?,
    })
}

fn wrap_scene(model: &Model, solution: &Solution, path: &str, wrap: &Wrap) -> Result<WrapScene, OutputError> {
    let Frame { mount, pose } = &wrap.frame;
    let (radius, axis) = match wrap.obstacle {
        Obstacle::Sphere { radius } => (radius, None),
        Obstacle::Cylinder { radius, axis, .. } => (radius, Some(axis)),
    };
    Ok(WrapScene {
        place: place(model, solution, path, *mount, pose)?,
        radius: finite(radius, || format!("{path}.radius"))?,
        axis: axis.map(|axis| all_finite(axis.into(), || format!("{path}.axis"))).transpose()?,
    })
}

fn cable_scene(model: &Model, solution: &Solution, cable: &Cable) -> Result<CableScene, OutputError> {
    let path = format!("scene.cables.{}", cable.name);
    let (mut route, mut eyelets) = (Vec::new(), Vec::new());
    for guide in &cable.route {
        match guide {
            Guide::Point(at) => {
                eyelets.push(route.len());
                route.push(place(model, solution, &path, at.mount, &Pose::translation(at.point))?);
            }
            Guide::Channel { beam, between, offset } => {
                let length = solution.beams.get(beam.0).map_or(0.0, |beam| beam.length);
                let [from, to] = between.map(|at| at.arc_length(length));
                for i in 0..CHANNEL {
                    let s = from + (to - from) * i as f64 / (CHANNEL - 1) as f64;
                    let [y, z] = [0, 1].map(|k| offset[k].value(s, length));
                    let at = BeamPoint { beam: *beam, at: flexura_model::At::Length(s) };
                    route.push(on_beam(model, solution, &path, at, Vector3::new(0.0, y, z))?);
                }
            }
        }
    }
    Ok(CableScene { route, eyelets })
}

fn tubes_scene(model: &Model, solution: &Solution, tubes: &Tubes) -> Result<TubesScene, OutputError> {
    let path = format!("scene.tubes.{}", tubes.name);
    let tube = |tube: &flexura_model::Tube| {
        let reach = finite(tube.reach(), || format!("{path}.reach"))?;
        let size = dimensions(&path, &model[tube.section].shape, tube.straight + tube.curved)?;
        Ok(TubeScene { reach, outer: size.width.first().copied() })
    };
    Ok(TubesScene {
        base: place(model, solution, &path, tubes.base.mount, &tubes.base.pose)?,
        tubes: tubes.tubes.iter().map(tube).collect::<Result<_, OutputError>>()?,
        force: all_finite(tubes.force.into(), || format!("{path}.force"))?,
        moment: all_finite(tubes.moment.into(), || format!("{path}.moment"))?,
    })
}

fn load_scene(model: &Model, solution: &Solution, load: &Load) -> Result<LoadScene, OutputError> {
    let path = format!("scene.loads.{}", load.name);
    let place = match load.target {
        LoadTarget::Body { body, point } => {
            place(model, solution, &path, Mount::Body(body), &Pose::translation(point))?
        }
        LoadTarget::Beam(at) => on_beam(model, solution, &path, at, Vector3::zeros())?,
    };
    Ok(LoadScene {
        place,
        force: all_finite(load.force.into(), || format!("{path}.force"))?,
        moment: all_finite(load.moment.into(), || format!("{path}.moment"))?,
        frame: match load.frame {
            LoadFrame::Global => "global",
            LoadFrame::Local => "local",
        }
        .to_owned(),
    })
}
