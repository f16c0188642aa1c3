//! Model -> nodes (bodies and hubs), spans (beams between them), joints, springs.
//!
//! A beam is one span, unless something that depends on another part holds on to it: then a hub, a massless
//! node of six coordinates, is put there and the beam becomes two spans welded to it. So every coupling
//! acts on nodes, and a span only ever carries loads that depend on its own section.

use crate::beam::BeamLaw;
use crate::coordinates::Coordinates;
use crate::error::ProblemError;
use crate::scale::Scale;
use flexura_mechanics::joint::Kinematics;
use flexura_mechanics::load::PointLoad;
use flexura_mechanics::spring::LinearSpring;
use flexura_model::{
    Attachment, BeamId, End, JointKind, JointLaw, LoadFrame, LoadTarget, Model, Mount, SpringLaw,
};
use flexura_spatial::{Pose, Twist, Vector3, Wrench};

/// What a node stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NodeOrigin {
    Body(usize),
    Hub { beam: usize, s: f64 },
}

/// Something rigid with six coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub origin: NodeOrigin,
    pub initial: Pose,
    /// Point in the node's axes, what acts there, and which load of the model it is.
    pub loads: Vec<(Vector3<f64>, PointLoad, Option<usize>)>,
}

/// A frame on a node, or on the ground (None).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carrier {
    pub node: Option<usize>,
    pub frame: Pose,
}

/// How a span's end is held.
#[derive(Clone, Debug)]
pub(crate) struct Hold {
    pub carrier: Carrier,
    pub coordinates: Coordinates,
    /// What is left between the held frame and the span's end at rest; removed as the load grows.
    pub mismatch: Twist,
}

/// A point load inside a span.
#[derive(Clone, Debug)]
pub(crate) struct Jump {
    pub s: f64,
    pub load: PointLoad,
    pub source: Option<usize>,
}

/// A stretch of a beam between two nodes, or to a free end.
#[derive(Clone, Debug)]
pub(crate) struct Span {
    pub beam: usize,
    /// First and last arc length, m.
    pub s: [f64; 2],
    pub start: Hold,
    pub end: Option<Hold>,
    pub jumps: Vec<Jump>,
    /// The internal force is known everywhere: the far end is free and every load dead.
    pub determinate: bool,
}

/// A joint between two nodes.
#[derive(Clone, Debug)]
pub(crate) struct BodyJoint {
    pub parent: Carrier,
    pub child: Carrier,
    pub coordinates: Coordinates,
    pub mismatch: Twist,
}

/// A spring between two points on nodes.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub ends: [(Option<usize>, Vector3<f64>); 2],
    pub law: LinearSpring,
    pub initial_length: f64,
}

/// The lowered model; numbers nondimensional but for arc lengths.
#[derive(Clone, Debug)]
pub(crate) struct Lowered {
    pub scale: Scale,
    pub beams: Vec<BeamLaw>,
    /// Start frame of each beam in the undeformed mechanism.
    pub beam_rest: Vec<Pose>,
    pub nodes: Vec<Node>,
    pub spans: Vec<Span>,
    pub joints: Vec<BodyJoint>,
    pub springs: Vec<Link>,
    pub warnings: Vec<String>,
}

/// A pose difference too small to be meant.
const SNUG: f64 = 1e-9;

pub(crate) fn lower(model: &Model) -> Result<Lowered, ProblemError> {
    let mut beams =
        (0..model.beams.len()).map(|i| BeamLaw::new(model, BeamId(i))).collect::<Result<Vec<_>, _>>()?;
    let scale = scale_of(model, &beams)?;
    for beam in &mut beams {
        beam.set_scale(scale);
    }
    let mut lowered = Lowered {
        scale,
        beams,
        beam_rest: Vec::new(),
        nodes: Vec::new(),
        spans: Vec::new(),
        joints: Vec::new(),
        springs: Vec::new(),
        warnings: Vec::new(),
    };
    for (i, body) in model.bodies.iter().enumerate() {
        let mut loads = Vec::new();
        let weight = model.gravity * body.mass;
        if weight != Vector3::zeros() {
            let dead = scale.wrench_in(&Wrench::new(weight, Vector3::zeros()));
            let load = PointLoad { dead, follower: Wrench::zero() };
            loads.push((body.center_of_mass / scale.length, load, None));
        }
        lowered.nodes.push(Node { origin: NodeOrigin::Body(i), initial: scale.pose_in(&body.pose), loads });
    }
    for (i, load) in model.loads.iter().enumerate() {
        if let LoadTarget::Body { body, point } = load.target {
            let wrench = point_load(&scale, load.force, load.moment, load.frame);
            lowered.nodes[body.0].loads.push((point / scale.length, wrench, Some(i)));
        }
    }
    for i in 0..model.beams.len() {
        let rest = rest_start(model, &lowered, i)?;
        lowered.beam_rest.push(rest);
    }
    for i in 0..model.beams.len() {
        lower_beam(model, &mut lowered, i)?;
    }
    for joint in &model.joints {
        lower_joint(model, &mut lowered, joint);
    }
    for i in 0..model.springs.len() {
        lower_spring(model, &mut lowered, i)?;
    }
    Ok(lowered)
}

/// L of the longest beam and EI/L² of its softest stiffness; of the bodies' spread where there is no beam.
fn scale_of(model: &Model, beams: &[BeamLaw]) -> Result<Scale, ProblemError> {
    if let Some(longest) = beams.iter().max_by(|a, b| a.length.total_cmp(&b.length)) {
        let length = longest.length;
        return Ok(Scale { length, force: longest.stiffness() / (length * length) });
    }
    if model.bodies.is_empty() {
        return Err(ProblemError::new(
            "beam",
            "the model has neither a beam nor a body",
            "add a [beam.<name>] with a section and a start",
        ));
    }
    let spread = model.bodies.iter().map(|b| b.pose.position.norm()).fold(0.0, f64::max);
    let length = if spread > 0.0 { spread } else { 1.0 };
    let mut force = model.loads.iter().map(|l| l.force.norm()).fold(0.0, f64::max);
    for spring in &model.springs {
        let SpringLaw::Linear { stiffness, .. } = spring.law;
        force = force.max(stiffness * length);
    }
    Ok(Scale { length, force: if force > 0.0 { force } else { 1.0 } })
}

pub(crate) fn point_load(
    scale: &Scale,
    force: Vector3<f64>,
    moment: Vector3<f64>,
    frame: LoadFrame,
) -> PointLoad {
    let wrench = scale.wrench_in(&Wrench::new(force, moment));
    match frame {
        LoadFrame::Global => PointLoad { dead: wrench, follower: Wrench::zero() },
        LoadFrame::Local => PointLoad { dead: Wrench::zero(), follower: wrench },
    }
}

fn node_of(body: Mount) -> Option<usize> {
    match body {
        Mount::Ground => None,
        Mount::Body(id) => Some(id.0),
        Mount::Beam(_) => todo!(),
    }
}

impl Lowered {
    fn initial(&self, node: Option<usize>) -> Pose {
        node.map_or(Pose::identity(), |n| self.nodes[n].initial)
    }

    fn carrier_pose(&self, carrier: &Carrier) -> Pose {
        self.initial(carrier.node) * carrier.frame
    }

    /// Stress-free pose of the section at `s`, nondimensional, global.
    fn rest_pose(&self, beam: usize, s: f64) -> Pose {
        self.beam_rest[beam] * self.scale.pose_in(&self.beams[beam].shape.pose(s))
    }
}

/// Where a beam's start frame is in the undeformed mechanism.
fn rest_start(model: &Model, lowered: &Lowered, beam: usize) -> Result<Pose, ProblemError> {
    let description = &model.beams[beam];
    let placed = |end: &End| {
        let frame = lowered.scale.pose_in(&end.placement.unwrap_or(Pose::identity()));
        lowered.initial(node_of(end.mount)) * frame
    };
    match (&description.start, &description.end) {
        (Some(start), _) => Ok(placed(start)),
        (None, Some(end)) => {
            let law = &lowered.beams[beam];
            Ok(placed(end) * lowered.scale.pose_in(&law.shape.pose(law.length)).inverse())
        }
        (None, None) => Err(ProblemError::new(
            format!("beam.{}", description.name),
            "is held nowhere: it has neither a start nor an end",
            "write start = { body = \"ground\", hold = \"clamp\" }",
        )),
    }
}

/// Arc lengths at which springs hold on to a beam, with the beam's free start if it has one.
fn hubs_of(model: &Model, beam: usize, length: f64) -> Vec<f64> {
    let mut hubs = Vec::new();
    if model.beams[beam].start.is_none() {
        hubs.push(0.0);
    }
    for spring in &model.springs {
        for end in [&spring.from, &spring.to] {
            if let Mount::Beam(point) = end.mount
                && point.beam.0 == beam
            {
                hubs.push(point.at.arc_length(length));
            }
        }
    }
    hubs.sort_by(f64::total_cmp);
    hubs.dedup_by(|a, b| (*a - *b).abs() < 1e-12 * length);
    hubs
}

fn lower_beam(model: &Model, lowered: &mut Lowered, beam: usize) -> Result<(), ProblemError> {
    let description = &model.beams[beam];
    let length = lowered.beams[beam].length;
    let scale = lowered.scale;
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12 * length;
    let hubs = hubs_of(model, beam, length);
    let mut jumps = point_loads(model, &scale, beam, length);
    // What acts on a hub acts on the node.
    let mut hub_nodes = Vec::new();
    for &s in &hubs {
        let held_start = near(s, 0.0) && description.start.is_some();
        let held_end = near(s, length) && description.end.is_some();
        if held_start || held_end {
            let which = if held_start { "start" } else { "end" };
            return Err(ProblemError::new(
                format!("beam.{}.{which}", description.name),
                "a spring holds on to a beam where the beam itself is held",
                "attach the spring to the body that holds the beam there",
            ));
        }
        let initial = lowered.rest_pose(beam, s);
        let (here, rest): (Vec<Jump>, Vec<Jump>) = jumps.into_iter().partition(|j| near(j.s, s));
        jumps = rest;
        let loads = here.into_iter().map(|j| (Vector3::zeros(), j.load, j.source)).collect();
        lowered.nodes.push(Node { origin: NodeOrigin::Hub { beam, s }, initial, loads });
        hub_nodes.push((s, lowered.nodes.len() - 1));
    }
    let path = format!("beam.{}", description.name);
    let weld = |lowered: &Lowered, node: usize| Hold {
        carrier: Carrier { node: Some(node), frame: Pose::identity() },
        coordinates: Coordinates::new(&JointLaw::weld(), &lowered.scale, &Pose::identity()),
        mismatch: Twist { angular: Vector3::zeros(), linear: Vector3::zeros() },
    };
    // Stations: start (held or hub), hubs inside, end (held, hub or free).
    let mut stations: Vec<(f64, Option<usize>)> = Vec::new();
    if description.start.is_some() {
        stations.push((0.0, None));
    }
    stations.extend(hub_nodes.iter().map(|(s, node)| (*s, Some(*node))));
    if !hub_nodes.iter().any(|(s, _)| near(*s, length)) {
        stations.push((length, None));
    }
    for (i, pair) in stations.windows(2).enumerate() {
        let ((a, from), (b, to)) = (pair[0], pair[1]);
        let last = i + 2 == stations.len();
        let start = match (from, &description.start) {
            (Some(node), _) => weld(lowered, node),
            (None, Some(end)) => held(lowered, end, beam, 0.0, &format!("{path}.start")),
            (None, None) => continue,
        };
        let end = match (to, &description.end) {
            (Some(node), _) => Some(weld(lowered, node)),
            (None, Some(end)) => Some(held(lowered, end, beam, length, &format!("{path}.end"))),
            (None, None) => None,
        };
        let inside: Vec<Jump> = jumps
            .iter()
            .filter(|j| {
                (j.s >= a || near(j.s, a)) && (j.s < b || (last && near(j.s, b))) && !(i > 0 && near(j.s, a))
            })
            .cloned()
            .collect();
        let law = &lowered.beams[beam];
        let determinate = end.is_none() && !law.follows() && inside.iter().all(|j| !j.load.follows());
        let mut span = Span { beam, s: [a, b], start, end, jumps: inside, determinate };
        hold_spin(lowered, &mut span, &path);
        lowered.spans.push(span);
    }
    Ok(())
}

/// Point loads and weights on a beam, increasing in s.
fn point_loads(model: &Model, scale: &Scale, beam: usize, length: f64) -> Vec<Jump> {
    let mut jumps = Vec::new();
    for (i, load) in model.loads.iter().enumerate() {
        if let LoadTarget::Beam(point) = load.target
            && point.beam.0 == beam
        {
            let wrench = point_load(scale, load.force, load.moment, load.frame);
            jumps.push(Jump { s: point.at.arc_length(length), load: wrench, source: Some(i) });
        }
    }
    for mass in &model.masses {
        if mass.point.beam.0 == beam && model.gravity != Vector3::zeros() {
            let dead = scale.wrench_in(&Wrench::new(model.gravity * mass.mass, Vector3::zeros()));
            let load = PointLoad { dead, follower: Wrench::zero() };
            jumps.push(Jump { s: mass.point.at.arc_length(length), load, source: None });
        }
    }
    jumps.sort_by(|a, b| a.s.total_cmp(&b.s));
    jumps
}

/// The hold of a beam's end at `s`, with the mismatch that is preload.
fn held(lowered: &mut Lowered, end: &End, beam: usize, s: f64, path: &str) -> Hold {
    let node = node_of(end.mount);
    let rest = lowered.rest_pose(beam, s);
    // An end without a placement attaches where the stress-free beam is; for the end that the beam was laid
    // out from, that is the body's origin.
    let frame = match end.placement {
        Some(pose) => lowered.scale.pose_in(&pose),
        None => lowered.initial(node).inverse() * rest,
    };
    let carrier = Carrier { node, frame };
    let offset = lowered.carrier_pose(&carrier).inverse() * rest;
    let coordinates = Coordinates::new(&end.hold, &lowered.scale, &offset);
    let left = coordinates.joint.pose(&coordinates.initial).inverse() * offset;
    let mismatch = left.log();
    if mismatch.linear.norm() > SNUG || mismatch.angular.norm() > SNUG {
        lowered.warnings.push(format!(
            "{path}: the stress-free beam ends {} from where it is attached, turned by {:.4} deg; the mismatch is preload",
            length_text(mismatch.linear.norm() * lowered.scale.length),
            mismatch.angular.norm().to_degrees(),
        ));
    }
    Hold { carrier, coordinates, mismatch }
}

pub(crate) fn length_text(metres: f64) -> String {
    if metres >= 0.1 { format!("{metres:.6} m") } else { format!("{:.6} mm", metres * 1e3) }
}

/// Two balls leave a beam's turning about the line between them free; it is held at zero.
fn hold_spin(lowered: &mut Lowered, span: &mut Span, path: &str) {
    let Some(end) = &span.end else { return };
    let ball = |hold: &Hold| hold.coordinates.kind == JointKind::Spherical && hold.coordinates.is_plain();
    if !(ball(&span.start) && ball(end)) {
        return;
    }
    let start = lowered.rest_pose(span.beam, span.s[0]);
    let chord = lowered.rest_pose(span.beam, span.s[1]).position - start.position;
    // M's axes are the beam's start axes.
    let chord = start.rotation.inverse() * chord;
    let along = if chord.norm() > 1e-9 { chord.normalize() } else { Vector3::x() };
    let aside = if along.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = along.cross(&aside).normalize();
    span.start.coordinates.spin_held = Some([first, along.cross(&first)]);
    lowered.warnings.push(format!(
        "{path}: two ball pins leave it free to spin about the line between them; that motion is held at zero"
    ));
}

fn lower_joint(_model: &Model, lowered: &mut Lowered, joint: &flexura_model::Joint) {
    let parent =
        Carrier { node: node_of(joint.parent.mount), frame: lowered.scale.pose_in(&joint.parent.pose) };
    let fixed = lowered.carrier_pose(&parent);
    let child_node = node_of(joint.child);
    let frame = match &joint.child_pose {
        Some(pose) => lowered.scale.pose_in(pose),
        None => lowered.initial(child_node).inverse() * fixed,
    };
    let child = Carrier { node: child_node, frame };
    let offset = fixed.inverse() * lowered.carrier_pose(&child);
    let coordinates = Coordinates::new(&joint.law, &lowered.scale, &offset);
    let mismatch = (coordinates.joint.pose(&coordinates.initial).inverse() * offset).log();
    if mismatch.linear.norm() > SNUG || mismatch.angular.norm() > SNUG {
        lowered.warnings.push(format!(
            "joint.{}: its two frames are {} and {:.4} deg apart in the initial poses; they are brought together",
            joint.name,
            length_text(mismatch.linear.norm() * lowered.scale.length),
            mismatch.angular.norm().to_degrees(),
        ));
    }
    lowered.joints.push(BodyJoint { parent, child, coordinates, mismatch });
}

fn lower_spring(model: &Model, lowered: &mut Lowered, index: usize) -> Result<(), ProblemError> {
    let spring = &model.springs[index];
    let scale = lowered.scale;
    let place = |attachment: &Attachment| match attachment.mount {
        mount @ (Mount::Ground | Mount::Body(_)) => (node_of(mount), attachment.point / scale.length),
        Mount::Beam(point) => {
            let length = lowered.beams[point.beam.0].length;
            let s = point.at.arc_length(length);
            let node = lowered.nodes.iter().position(|n| {
                matches!(n.origin, NodeOrigin::Hub { beam, s: hub }
                    if beam == point.beam.0 && (hub - s).abs() < 1e-12 * length)
            });
            (node, attachment.point / scale.length)
        }
    };
    let ends = [place(&spring.from), place(&spring.to)];
    let at = |(node, point): &(Option<usize>, Vector3<f64>)| lowered.initial(*node).point(point);
    let initial_length = (at(&ends[1]) - at(&ends[0])).norm();
    let SpringLaw::Linear { stiffness, rest_length } = spring.law;
    if initial_length < 1e-12 {
        return Err(ProblemError::new(
            format!("spring.{}", spring.name),
            "has length zero: its two ends coincide, so it has no direction",
            "move `from` or `to`",
        ));
    }
    let law = LinearSpring {
        stiffness: stiffness * scale.length / scale.force,
        rest_length: rest_length.map_or(initial_length, |l| l / scale.length),
    };
    lowered.springs.push(Link { ends, law, initial_length });
    Ok(())
}
