//! What there is to draw, in space.

use super::outlines::{Outline, outlines};
use flexura_model::{
    BeamPoint, Body, Frame, Guide, JointKind, LoadFrame, LoadTarget, Model, Mount, Tube, Tubes,
};
use flexura_solution::{BeamSample, Solution, TubesSolution};
use flexura_spatial::{Pose, Vector3};

/// A beam's axis before and after, or that of concentric tubes, of which nothing is known before.
pub struct BeamLine {
    pub name: String,
    pub initial: Vec<Knot>,
    pub deformed: Vec<Knot>,
    /// For each further tube that surrounds the first one's beginning: over how many knots, the longest first.
    pub sleeves: Vec<usize>,
}

/// A point of a beam's axis with its derivative by the arc length, for a smooth curve through few samples.
#[derive(Clone, Copy)]
pub struct Knot {
    pub s: f64,
    pub point: Vector3<f64>,
    pub derivative: Vector3<f64>,
}

impl Knot {
    fn initial(sample: &BeamSample) -> Self {
        let derivative = sample.rest_pose.rotation * Vector3::x();
        Self { s: sample.s, point: sample.rest_pose.position, derivative }
    }

    fn deformed(sample: &BeamSample) -> Self {
        let derivative = sample.pose.rotation * (Vector3::x() + sample.strain);
        Self { s: sample.s, point: sample.pose.position, derivative }
    }
}

/// A point before and after.
#[derive(Clone, Copy)]
pub struct Moved {
    pub initial: Vector3<f64>,
    pub deformed: Vector3<f64>,
}

/// A body's origin, and what is fixed to the body.
pub struct BodyMark {
    pub name: String,
    pub initial: Vector3<f64>,
    pub deformed: Vector3<f64>,
    pub arms: Vec<Moved>,
}

/// A beam's end on the ground.
pub struct Support {
    pub point: Vector3<f64>,
    /// From the beam into the ground, unit.
    pub outward: Vector3<f64>,
    /// Of the hold, unit, global.
    pub axis: Vector3<f64>,
    pub kind: JointKind,
}

/// A joint.
pub struct JointMark {
    pub point: Vector3<f64>,
    /// Unit, global.
    pub axis: Vector3<f64>,
    pub kind: JointKind,
    pub is_grounded: bool,
}

/// A point load; directions are unit vectors or zero.
pub struct LoadMark {
    pub point: Vector3<f64>,
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
    /// Sizes as they act, N and N·m.
    pub sizes: [f64; 2],
}

/// A spring from end to end: two points, or more where it runs over something.
pub struct SpringMark {
    pub name: String,
    pub course: Vec<Vector3<f64>>,
}

/// A cable's course, and the points that guide it.
pub struct CableMark {
    pub name: String,
    pub course: Vec<Vector3<f64>>,
    pub guides: Vec<Vector3<f64>>,
}

/// A mass on a beam, or a body's centre of mass; kg.
pub struct MassMark {
    /// Empty for a body, whose name stands at its origin.
    pub name: String,
    pub point: Vector3<f64>,
    pub mass: f64,
}

/// All of it.
pub struct Scene {
    pub beams: Vec<BeamLine>,
    /// Where beams lie at rest on elastic foundations.
    pub foundations: Vec<Vec<Knot>>,
    pub bodies: Vec<BodyMark>,
    pub supports: Vec<Support>,
    pub joints: Vec<JointMark>,
    pub outlines: Vec<Outline>,
    pub springs: Vec<SpringMark>,
    pub cables: Vec<CableMark>,
    pub loads: Vec<LoadMark>,
    pub masses: Vec<MassMark>,
    /// Global, m/s².
    pub gravity: Vector3<f64>,
}

impl Scene {
    pub fn new(model: &Model, solution: &Solution) -> Self {
        let beams = model.beams.iter().zip(&solution.beams).map(|(beam, result)| BeamLine {
            name: beam.name.clone(),
            initial: result.samples.iter().map(Knot::initial).collect(),
            deformed: result.samples.iter().map(Knot::deformed).collect(),
            sleeves: Vec::new(),
        });
        let tubes = model.tubes.iter().zip(&solution.tubes).map(tubes_line);
        let mut bodies: Vec<BodyMark> = model
            .bodies
            .iter()
            .zip(&solution.bodies)
            .map(|(body, pose)| BodyMark {
                name: body.name.clone(),
                initial: body.pose.position,
                deformed: pose.position,
                arms: Vec::new(),
            })
            .collect();
        let mut supports = add_beam_ends(model, solution, &mut bodies);
        supports.extend(model.tubes.iter().filter_map(guide_support));
        let joints = add_joints(model, solution, &mut bodies);
        for spring in &model.springs {
            for end in [&spring.from, &spring.to] {
                add_arm(model, solution, &mut bodies, end.mount, &Pose::translation(end.point));
            }
            if let Some(wrap) = &spring.wrap {
                add_arm(model, solution, &mut bodies, wrap.frame.mount, &wrap.frame.pose);
            }
        }
        for tubes in &model.tubes {
            add_arm(model, solution, &mut bodies, tubes.base.mount, &tubes.base.pose);
        }
        for guide in model.cables.iter().flat_map(|cable| &cable.route) {
            if let Guide::Point(place) = guide {
                add_arm(model, solution, &mut bodies, place.mount, &Pose::translation(place.point));
            }
        }
        let mut scene = Self {
            beams: beams.chain(tubes).collect(),
            foundations: foundations(model, solution),
            bodies,
            supports,
            joints,
            outlines: Vec::new(),
            springs: springs(model, solution),
            cables: cables(model, solution),
            loads: loads(model, solution),
            masses: masses(model, solution),
            gravity: model.gravity,
        };
        // What has no end is cut to the size of the others.
        let [low, high] = scene.bounds();
        scene.outlines = outlines(model, solution, (high - low).norm());
        scene
    }

    /// The smallest box around everything; the origin when there is nothing.
    pub fn bounds(&self) -> [Vector3<f64>; 2] {
        let beams = self
            .beams
            .iter()
            .flat_map(|beam| beam.initial.iter().chain(&beam.deformed))
            .map(|knot| knot.point);
        let bodies = self.bodies.iter().flat_map(|body| {
            let arms = body.arms.iter().flat_map(|arm| [arm.initial, arm.deformed]);
            [body.initial, body.deformed].into_iter().chain(arms)
        });
        let marks = self
            .springs
            .iter()
            .flat_map(|spring| &spring.course)
            .copied()
            .chain(self.joints.iter().map(|joint| joint.point));
        let marks = marks.chain(self.cables.iter().flat_map(|cable| &cable.course).copied());
        let outlines =
            self.outlines.iter().flat_map(|outline| outline.initial.iter().chain(&outline.deformed));
        let mut points = beams
            .chain(bodies)
            .chain(marks)
            .chain(outlines.copied())
            .filter(|point| point.iter().all(|c| c.is_finite()));
        let first = points.next().unwrap_or_else(Vector3::zeros);
        points.fold([first; 2], |[low, high], point| [low.inf(&point), high.sup(&point)])
    }
}

/// Arms from bodies to the beam ends that they hold; supports where the ground holds one.
fn add_beam_ends(model: &Model, solution: &Solution, bodies: &mut [BodyMark]) -> Vec<Support> {
    let mut supports = Vec::new();
    for (beam, result) in model.beams.iter().zip(&solution.beams) {
        let ends = [(&beam.start, result.samples.first(), -1.0), (&beam.end, result.samples.last(), 1.0)];
        for (end, sample, sign) in ends {
            let (Some(end), Some(sample)) = (end, sample) else { continue };
            match end.mount {
                Mount::Ground => {
                    // Without a place of its own, a hold has the axes of the ground at a start, of the beam at an end.
                    let axes = match end.placement {
                        Some(placement) => placement.rotation,
                        None if sign < 0.0 => Pose::identity().rotation,
                        None => sample.rest_pose.rotation,
                    };
                    supports.push(Support {
                        point: sample.pose.position,
                        outward: sample.pose.rotation * Vector3::x() * sign,
                        axis: axes * end.hold.axis,
                        kind: end.hold.kind,
                    });
                }
                Mount::Body(id) => {
                    if let Some(mark) = bodies.get_mut(id.0) {
                        mark.arms.push(Moved {
                            initial: sample.rest_pose.position,
                            deformed: sample.pose.position,
                        });
                    }
                }
                // A beam held by another beam shows where by touching it.
                Mount::Beam(_) => {}
            }
        }
    }
    supports
}

fn add_joints(model: &Model, solution: &Solution, bodies: &mut [BodyMark]) -> Vec<JointMark> {
    let mut marks = Vec::new();
    for (joint, result) in model.joints.iter().zip(&solution.joints) {
        let fixed = final_pose(solution, joint.parent.mount) * joint.parent.pose;
        add_arm(model, solution, bodies, joint.parent.mount, &joint.parent.pose);
        let child_pose = joint.child_pose.unwrap_or_else(|| {
            let parent = initial_pose(model, solution, joint.parent.mount) * joint.parent.pose;
            initial_pose(model, solution, joint.child).inverse() * parent
        });
        let moving = final_pose(solution, joint.child) * child_pose;
        add_arm(model, solution, bodies, joint.child, &child_pose);
        marks.push(JointMark {
            point: result.contact.map_or(moving.position, |contact| contact.point),
            axis: fixed.rotation * joint.law.axis,
            kind: joint.law.kind,
            is_grounded: joint.parent.mount == Mount::Ground || joint.child == Mount::Ground,
        });
    }
    marks
}

fn add_arm(model: &Model, solution: &Solution, bodies: &mut [BodyMark], body: Mount, pose: &Pose) {
    if let Mount::Body(id) = body
        && let Some(mark) = bodies.get_mut(id.0)
    {
        mark.arms.push(Moved {
            initial: initial_pose(model, solution, body).point(&pose.position),
            deformed: final_pose(solution, body).point(&pose.position),
        });
    }
}

fn tubes_line((tubes, result): (&Tubes, &TubesSolution)) -> BeamLine {
    let deformed = result.samples.iter().map(|sample| Knot {
        s: sample.s,
        point: sample.pose.position,
        derivative: sample.pose.rotation * Vector3::x(),
    });
    let deformed: Vec<Knot> = deformed.collect();
    let length = deformed.last().map_or(0.0, |knot| knot.s);
    let covered = |tube: &Tube| deformed.partition_point(|knot| knot.s <= tube.reach() + 1e-9 * length);
    let mut sleeves: Vec<usize> = tubes.tubes.iter().skip(1).map(covered).collect();
    sleeves.sort_unstable_by(|a, b| b.cmp(a));
    BeamLine { name: tubes.name.clone(), initial: Vec::new(), deformed, sleeves }
}

/// The guide's mouth on the ground.
fn guide_support(tubes: &Tubes) -> Option<Support> {
    let axis = tubes.base.pose.rotation * Vector3::x();
    (tubes.base.mount == Mount::Ground).then_some(Support {
        point: tubes.base.pose.position,
        outward: -axis,
        axis,
        kind: JointKind::Weld,
    })
}

pub fn initial_pose(model: &Model, solution: &Solution, mount: Mount) -> Pose {
    match mount {
        Mount::Ground => Pose::identity(),
        Mount::Beam(place) => sample_at(solution, place).map_or_else(Pose::identity, |s| s.rest_pose),
        Mount::Body(id) => model.bodies.get(id.0).map_or_else(Pose::identity, |body: &Body| body.pose),
    }
}

pub fn final_pose(solution: &Solution, mount: Mount) -> Pose {
    match mount {
        Mount::Ground => Pose::identity(),
        Mount::Beam(place) => sample_at(solution, place).map_or_else(Pose::identity, |s| s.pose),
        Mount::Body(id) => solution.bodies.get(id.0).copied().unwrap_or_else(Pose::identity),
    }
}

fn foundations(model: &Model, solution: &Solution) -> Vec<Vec<Knot>> {
    let beams = model.beams.iter().zip(&solution.beams);
    let each = beams.flat_map(|(beam, result)| {
        beam.foundation.iter().map(move |foundation| {
            let [from, to] = foundation.between.map(|at| at.arc_length(result.length));
            let near = 1e-9 * result.length;
            let along = |sample: &&BeamSample| (from - near..=to + near).contains(&sample.s);
            result.samples.iter().filter(along).map(Knot::initial).collect()
        })
    });
    each.collect()
}

fn cables(model: &Model, solution: &Solution) -> Vec<CableMark> {
    let place = |guide: &Guide| match guide {
        Guide::Point(place) => Some(final_pose(solution, place.mount).point(&place.point)),
        Guide::Channel { .. } => None,
    };
    let cables = model.cables.iter().zip(&solution.cables);
    cables
        .map(|(cable, result)| CableMark {
            name: cable.name.clone(),
            course: result.course.clone(),
            guides: cable.route.iter().filter_map(place).collect(),
        })
        .collect()
}

fn masses(model: &Model, solution: &Solution) -> Vec<MassMark> {
    let on_beams = model.masses.iter().filter_map(|mass| {
        let point = sample_at(solution, mass.point)?.pose.position;
        Some(MassMark { name: mass.name.clone(), point, mass: mass.mass })
    });
    let bodies = model.bodies.iter().zip(&solution.bodies).filter(|(body, _)| body.mass > 0.0);
    let bodies = bodies.map(|(body, pose)| MassMark {
        name: String::new(),
        point: pose.point(&body.center_of_mass),
        mass: body.mass,
    });
    on_beams.chain(bodies).collect()
}

fn springs(model: &Model, solution: &Solution) -> Vec<SpringMark> {
    let springs = model.springs.iter().zip(&solution.springs);
    springs
        .map(|(spring, result)| SpringMark {
            name: spring.name.clone(),
            course: match result.course.len() {
                0 => result.ends.to_vec(),
                _ => result.course.clone(),
            },
        })
        .collect()
}

fn loads(model: &Model, solution: &Solution) -> Vec<LoadMark> {
    let unit = |vector: Vector3<f64>| vector.try_normalize(1e-300).unwrap_or_else(Vector3::zeros);
    let mut marks = Vec::new();
    for load in &model.loads {
        let pose = match load.target {
            LoadTarget::Body { body, point } => {
                let frame = Frame { mount: Mount::Body(body), pose: Pose::translation(point) };
                Some(final_pose(solution, frame.mount) * frame.pose)
            }
            LoadTarget::Beam(place) => sample_at(solution, place).map(|sample| sample.pose),
        };
        let Some(pose) = pose else { continue };
        let turned = |vector: Vector3<f64>| match load.frame {
            LoadFrame::Global => vector,
            LoadFrame::Local => pose.rotation * vector,
        };
        marks.push(LoadMark {
            point: pose.position,
            force: turned(unit(load.force)),
            moment: turned(unit(load.moment)),
            sizes: [load.force, load.moment].map(|vector| solution.load_fraction * vector.norm()),
        });
    }
    for (tubes, result) in model.tubes.iter().zip(&solution.tubes) {
        let (force, moment) = (unit(tubes.force), unit(tubes.moment));
        if let Some(tip) = result.samples.last()
            && (force != Vector3::zeros() || moment != Vector3::zeros())
        {
            let sizes = [tubes.force, tubes.moment].map(|vector| solution.load_fraction * vector.norm());
            marks.push(LoadMark { point: tip.pose.position, force, moment, sizes });
        }
    }
    marks
}

fn sample_at(solution: &Solution, place: BeamPoint) -> Option<&BeamSample> {
    let beam = solution.beams.get(place.beam.0)?;
    let s = place.at.arc_length(beam.length);
    beam.samples.iter().min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()))
}
