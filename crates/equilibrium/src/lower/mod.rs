//! Model -> nodes (bodies and hubs), spans (beams between them), joints, couplings, springs, cables.
//!
//! A beam is one span, unless something that depends on another part holds on to it: then a hub, a massless
//! node of six coordinates, is put there and the beam becomes two spans welded to it. Where the beam itself is held
//! at that very place, the span is welded to the hub and the hold becomes a joint of the hub. So every coupling
//! acts on nodes, and a span only ever carries loads that depend on its own section.

mod attachments;
mod cables;
mod contact;
mod spans;
mod springs;

pub(crate) use springs::link;

use crate::beam::BeamLaw;
use crate::channel::{Route, TendonChannel};
use crate::coordinates::Coordinates;
use crate::error::ProblemError;
use crate::scale::Scale;
use flexura_mechanics::load::PointLoad;
use flexura_mechanics::spring::{Obstacle, TensionLaw};
use flexura_model::{BeamId, BeamPoint, LoadFrame, LoadTarget, Model, Mount};
use flexura_spatial::{Pose, Twist, Vector3, Wrench};
use std::sync::Arc;

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
    /// The internal force is known everywhere: the far end is free, every load dead, and there is no foundation.
    pub determinate: bool,
    /// Cables that run in channels along it.
    pub tendons: Vec<usize>,
    pub channels: Vec<TendonChannel>,
    /// A tendon's tension is unknown, and its length along the span an equation: the span is one segment, so that the
    /// length depends on its head alone.
    pub undivided: bool,
}

impl Span {
    /// Is everything the same all along it?
    pub fn is_even(&self, law: &BeamLaw) -> bool {
        law.is_even() && self.channels.iter().all(TendonChannel::is_even)
    }

    /// Its ends and the places inside it at which something jumps or is not smooth, in order.
    pub fn inside(&self, law: &BeamLaw) -> Vec<f64> {
        let mut places = self.happenings(law);
        crate::mesh::order(&mut places, self.s, law.length);
        places.insert(0, self.s[0]);
        places
    }

    /// Does it run as another does, with jumps at the same places and no channel? What jumps there may differ.
    pub fn is_laid_out_as(&self, other: &Span) -> bool {
        self.s == other.s
            && self.channels.is_empty()
            && other.channels.is_empty()
            && self.jumps.len() == other.jumps.len()
            && self.jumps.iter().zip(&other.jumps).all(|(a, b)| a.s == b.s)
    }

    /// Arc lengths (m) of the beam at which something jumps or is not smooth, in no order.
    pub fn happenings(&self, law: &BeamLaw) -> Vec<f64> {
        let mut places = law.breaks().to_vec();
        places.extend(self.jumps.iter().map(|j| j.s));
        places.extend(self.channels.iter().flat_map(TendonChannel::breaks));
        places
    }
}

/// What a joint between two nodes stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum JointOrigin {
    Joint(usize),
    /// The hold of a beam's end at a hub; `true` at its start.
    Hold {
        beam: usize,
        start: bool,
    },
}

/// A joint between two nodes.
#[derive(Clone, Debug)]
pub(crate) struct NodeJoint {
    pub origin: JointOrigin,
    pub parent: Carrier,
    pub child: Carrier,
    pub coordinates: Coordinates,
    pub mismatch: Twist,
}

/// A spring between two points on nodes.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub ends: [(Option<usize>, Vector3<f64>); 2],
    pub law: TensionLaw,
    /// With which it is relaxed initially, and what it is to be.
    pub rest_length: [f64; 2],
    /// Is it longer than the way between its ends initially?
    pub is_loose: bool,
    pub wrap: Option<Wrapping>,
}

/// What a spring runs over.
#[derive(Clone, Debug)]
pub(crate) struct Wrapping {
    pub carrier: Carrier,
    pub obstacle: Obstacle,
}

/// A linear relation between joint coordinates, Σ factor q = offset, nondimensional; the joints of the model come
/// first among those of the lowered one.
#[derive(Clone, Debug)]
pub(crate) struct Gear {
    /// Joint, coordinate, factor.
    pub terms: Vec<(usize, usize, f64)>,
    /// Σ factor q at rest, and what it is to be.
    pub offset: [f64; 2],
    /// What the factors were divided by, SI: the largest of factor times unit of the coordinate.
    pub unit: f64,
}

/// What is given of a cable, nondimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum RopeLaw {
    Tension(f64),
    /// Length at rest and length wanted.
    Length([f64; 2]),
}

/// A cable: straight lines between points on nodes, and channels, all under one tension.
#[derive(Clone, Debug)]
pub(crate) struct Rope {
    pub lines: Vec<[(Option<usize>, Vector3<f64>); 2]>,
    pub law: RopeLaw,
    /// From its first anchor to its last.
    pub course: Vec<Course>,
}

/// A part of a cable's course.
#[derive(Clone, Debug)]
pub(crate) enum Course {
    /// Position in [`Rope::lines`].
    Line(usize),
    /// Along a beam, between two arc lengths (m) in the order in which the cable meets them.
    Channel { beam: usize, between: [f64; 2], route: Route },
}

/// The lowered model; numbers nondimensional but for arc lengths.
#[derive(Clone, Debug)]
pub(crate) struct Lowered {
    pub scale: Scale,
    pub beams: Vec<Arc<BeamLaw>>,
    /// Start frame of each beam in the undeformed mechanism.
    pub beam_rest: Vec<Pose>,
    pub nodes: Vec<Node>,
    pub spans: Vec<Span>,
    /// Those of the model in its order, then holds at hubs.
    pub joints: Vec<NodeJoint>,
    pub gears: Vec<Gear>,
    pub springs: Vec<Link>,
    pub ropes: Vec<Rope>,
    pub nests: Vec<crate::tubes::Nest>,
    /// For each beam the hubs along it: arc length (m) and node.
    pub hubs: Vec<Vec<(f64, usize)>>,
    pub warnings: Vec<String>,
}

/// A pose difference too small to be meant.
const SNUG: f64 = 1e-9;

/// Lowers a model. `probes` are places on beams whose motion is asked for; `scale` is kept if given, so that states
/// of neighbouring models can be compared. Laws of beams that are the same in a neighbouring model are taken over.
pub(crate) fn lower(
    model: &Model,
    probes: &[BeamPoint],
    neighbour: Option<&Lowered>,
) -> Result<Lowered, ProblemError> {
    let law = |i: usize| {
        let kept = neighbour.and_then(|lowered| lowered.beams.get(i));
        match kept.filter(|law| law.is_of(model, BeamId(i))) {
            Some(law) => Ok(law.clone()),
            None => BeamLaw::new(model, BeamId(i)).map(Arc::new),
        }
    };
    let mut beams = (0..model.beams.len()).map(law).collect::<Result<Vec<_>, _>>()?;
    let scale = match neighbour {
        Some(lowered) => lowered.scale,
        None => scale_of(model, &beams)?,
    };
    for beam in beams.iter_mut().filter(|beam| beam.scale != scale) {
        Arc::make_mut(beam).set_scale(scale);
    }
    let mut lowered = Lowered {
        scale,
        beams,
        beam_rest: Vec::new(),
        nodes: Vec::new(),
        spans: Vec::new(),
        joints: Vec::new(),
        gears: Vec::new(),
        springs: Vec::new(),
        ropes: Vec::new(),
        nests: Vec::new(),
        hubs: Vec::new(),
        warnings: Vec::new(),
    };
    for (i, body) in model.bodies.iter().enumerate() {
        let mut loads = Vec::new();
        let weight = model.gravity * body.mass;
        let outward = crate::spin::outward(model, &scale, body.mass);
        if weight != Vector3::zeros() || outward.is_some() {
            let dead = scale.wrench_in(&Wrench::new(weight, Vector3::zeros()));
            let load = PointLoad { dead, follower: Wrench::zero(), outward };
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
    spans::lay_out(model, &mut lowered)?;
    for (beam, rest) in lowered.beams.iter_mut().zip(&lowered.beam_rest) {
        let rest = scale.pose_out(rest);
        if beam.founded.rest != rest {
            Arc::make_mut(beam).founded.rest = rest;
        }
    }
    spans::place_hubs(model, &mut lowered, probes);
    for i in 0..model.joints.len() {
        attachments::lower_joint(model, &mut lowered, i)?;
    }
    for i in 0..model.beams.len() {
        spans::lower_beam(model, &mut lowered, i)?;
        bounded(model, &lowered.beams[i], i)?;
    }
    for coupling in &model.couplings {
        attachments::lower_coupling(model, &mut lowered, coupling)?;
    }
    for spring in &model.springs {
        springs::lower_spring(&mut lowered, spring)?;
    }
    for cable in &model.cables {
        cables::lower_cable(&mut lowered, cable)?;
    }
    for tubes in &model.tubes {
        let nest = crate::tubes::lower(model, &lowered, tubes)?;
        lowered.nests.push(nest);
    }
    Ok(lowered)
}

/// Refuses a foundation for which a beam would have to be cut into more stretches than a computer holds.
pub(crate) fn bounded(model: &Model, law: &BeamLaw, beam: usize) -> Result<(), ProblemError> {
    let growth = law.foundation_growth();
    if growth <= LARGEST_GROWTH {
        return Ok(());
    }
    Err(ProblemError::new(
        format!("beam.{}.foundation", model.beams[beam].name),
        format!(
            "what bends the beam dies away within 1/{growth:.0} of its length, and that is too short to be followed"
        ),
        "check the unit of its stiffness and the section's dimensions; so stiff a foundation is as good as a clamp",
    ))
}

/// L of the longest beam and EI/L² of its softest stiffness; of the bodies' spread where there is no beam.
fn scale_of(model: &Model, beams: &[Arc<BeamLaw>]) -> Result<Scale, ProblemError> {
    if let Some(longest) = beams.iter().max_by(|a, b| a.length.total_cmp(&b.length)) {
        let length = longest.length;
        return Ok(Scale { length, force: longest.stiffness() / (length * length) });
    }
    if let Some(scale) = crate::tubes::size(model)? {
        return Ok(scale);
    }
    if model.bodies.is_empty() {
        return Err(ProblemError::new(
            "beam",
            "the model has neither a beam nor a body",
            "add a [beam.<name>] with a section and a start",
        ));
    }
    // The extent about the middle, which does not depend on where the origin is.
    let middle =
        model.bodies.iter().map(|b| b.pose.position).sum::<Vector3<f64>>() / model.bodies.len() as f64;
    let spread = model.bodies.iter().map(|b| (b.pose.position - middle).norm()).fold(0.0, f64::max);
    // Of one body alone its springs tell how small it is; far anchors tell nothing.
    let length = if spread > 0.0 { spread } else { springs::longest(model).min(1.0) };
    let length = if length > 0.0 { length } else { 1.0 };
    let mut force = model.loads.iter().map(|l| l.force.norm()).fold(0.0, f64::max);
    force = force.max(springs::largest_force(model, length));
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
        LoadFrame::Global => PointLoad { dead: wrench, follower: Wrench::zero(), outward: None },
        LoadFrame::Local => PointLoad { dead: Wrench::zero(), follower: wrench, outward: None },
    }
}

impl Lowered {
    /// The node of what carries a frame; None for the ground.
    pub fn node_of(&self, mount: Mount) -> Option<usize> {
        match mount {
            Mount::Ground => None,
            Mount::Body(id) => Some(id.0),
            Mount::Beam(point) => self.hub_at(&point),
        }
    }

    /// The hub at a place on a beam.
    pub fn hub_at(&self, point: &BeamPoint) -> Option<usize> {
        let beam = point.beam.0;
        let length = self.beams[beam].length;
        let s = point.at.arc_length(length);
        self.hubs[beam].iter().find(|(hub, _)| near(*hub, s, length)).map(|(_, node)| *node)
    }

    fn initial(&self, node: Option<usize>) -> Pose {
        node.map_or(Pose::identity(), |n| self.nodes[n].initial)
    }

    pub fn carrier_pose(&self, carrier: &Carrier) -> Pose {
        self.initial(carrier.node) * carrier.frame
    }

    /// Stress-free pose of the section at `s`, nondimensional, global.
    pub fn rest_pose(&self, beam: usize, s: f64) -> Pose {
        self.beam_rest[beam] * self.scale.pose_in(&self.beams[beam].shape.pose(s))
    }
}

/// Lengths within which what a foundation feels dies away, along one beam, at most.
const LARGEST_GROWTH: f64 = 1e4;

/// Are two arc lengths on a beam the same place?
fn near(a: f64, b: f64, length: f64) -> bool {
    (a - b).abs() < 1e-12 * length
}

pub(crate) fn length_text(metres: f64) -> String {
    if metres.abs() >= 0.1 { format!("{metres:.6} m") } else { format!("{:.6} mm", metres * 1e3) }
}
