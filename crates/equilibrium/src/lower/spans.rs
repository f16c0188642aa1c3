//! Beams -> hubs and spans.

use super::cables;
use super::{
    Carrier, Hold, JointOrigin, Jump, Lowered, Node, NodeJoint, NodeOrigin, SNUG, Span, length_text, near,
    point_load,
};
use crate::coordinates::Coordinates;
use crate::error::ProblemError;
use crate::scale::Scale;
use flexura_mechanics::joint::Kinematics;
use flexura_mechanics::load::PointLoad;
use flexura_model::{BeamPoint, End, JointKind, LoadFrame, LoadTarget, Model, Mount};
use flexura_spatial::{Pose, Twist, Vector3, Wrench};

/// Where every beam lies in the undeformed mechanism. A beam held by another beam follows from it.
pub(super) fn lay_out(model: &Model, lowered: &mut Lowered) -> Result<(), ProblemError> {
    let count = model.beams.len();
    let mut placed: Vec<Option<Pose>> = vec![None; count];
    // What waits for what: each beam is laid out as soon as the one that holds it is.
    let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut ready = Vec::new();
    for (i, beam) in model.beams.iter().enumerate() {
        match laid_from(beam.start.as_ref(), beam.end.as_ref()) {
            None => {
                return Err(ProblemError::new(
                    format!("beam.{}", beam.name),
                    "is held nowhere: it has neither a start nor an end",
                    "write start = { body = \"ground\", hold = \"clamp\" }",
                ));
            }
            Some((End { mount: Mount::Beam(point), .. }, _)) => waiting[point.beam.0].push(i),
            Some(_) => ready.push(i),
        }
    }
    while let Some(i) = ready.pop() {
        let beam = &model.beams[i];
        let Some((end, at_start)) = laid_from(beam.start.as_ref(), beam.end.as_ref()) else { continue };
        let carrier = match end.mount {
            Mount::Beam(point) => {
                let law = &lowered.beams[point.beam.0];
                let s = point.at.arc_length(law.length);
                placed[point.beam.0].unwrap_or(Pose::identity()) * lowered.scale.pose_in(&law.shape.pose(s))
            }
            mount => lowered.initial(lowered.node_of(mount)),
        };
        let frame = carrier * lowered.scale.pose_in(&end.placement.unwrap_or(Pose::identity()));
        let law = &lowered.beams[i];
        placed[i] = Some(if at_start {
            frame
        } else {
            frame * lowered.scale.pose_in(&law.shape.pose(law.length)).inverse()
        });
        ready.append(&mut waiting[i]);
    }
    for (i, pose) in placed.iter().enumerate() {
        match pose {
            Some(pose) => lowered.beam_rest.push(*pose),
            None => {
                let ring: Vec<String> = (0..count)
                    .filter(|j| placed[*j].is_none())
                    .map(|j| format!("beam.{}", model.beams[j].name))
                    .collect();
                return Err(ProblemError::new(
                    format!("beam.{}", model.beams[i].name),
                    format!(
                        "beams hold each other in a ring, and none of them says where it lies: {}",
                        ring.join(", ")
                    ),
                    "let the ground or a body hold the start of one of them",
                ));
            }
        }
    }
    Ok(())
}

/// The end that a beam is laid out from, and whether it is its start.
fn laid_from<'a>(start: Option<&'a End>, end: Option<&'a End>) -> Option<(&'a End, bool)> {
    start.map(|e| (e, true)).or(end.map(|e| (e, false)))
}

/// Puts hubs where something holds on to a beam, where a motion is asked for, and at free starts.
pub(super) fn place_hubs(model: &Model, lowered: &mut Lowered, probes: &[BeamPoint]) {
    let mut places: Vec<Vec<f64>> = vec![Vec::new(); model.beams.len()];
    let lengths: Vec<f64> = lowered.beams.iter().map(|law| law.length).collect();
    {
        let mut add = |point: &BeamPoint| {
            places[point.beam.0].push(point.at.arc_length(lowered.beams[point.beam.0].length));
        };
        let mut mount = |mount: &Mount| {
            if let Mount::Beam(point) = mount {
                add(point);
            }
        };
        for beam in &model.beams {
            beam.start.iter().chain(&beam.end).for_each(|end| mount(&end.mount));
        }
        for joint in &model.joints {
            mount(&joint.parent.mount);
            mount(&joint.child);
        }
        for spring in &model.springs {
            mount(&spring.from.mount);
            mount(&spring.to.mount);
            spring.wrap.iter().for_each(|wrap| mount(&wrap.frame.mount));
        }
        for cable in &model.cables {
            cables::mounts(cable, &lengths).iter().for_each(&mut mount);
        }
        probes.iter().for_each(&mut add);
    }
    for (beam, mut hubs) in places.into_iter().enumerate() {
        let length = lowered.beams[beam].length;
        if model.beams[beam].start.is_none() {
            hubs.push(0.0);
        }
        hubs.sort_by(f64::total_cmp);
        hubs.dedup_by(|a, b| near(*a, *b, length));
        let mut list = Vec::with_capacity(hubs.len());
        for s in hubs {
            let initial = lowered.rest_pose(beam, s);
            lowered.nodes.push(Node { origin: NodeOrigin::Hub { beam, s }, initial, loads: Vec::new() });
            list.push((s, lowered.nodes.len() - 1));
        }
        lowered.hubs.push(list);
    }
}

pub(super) fn lower_beam(model: &Model, lowered: &mut Lowered, beam: usize) -> Result<(), ProblemError> {
    let description = &model.beams[beam];
    let length = lowered.beams[beam].length;
    let scale = lowered.scale;
    let near = |a: f64, b: f64| near(a, b, length);
    let hubs = lowered.hubs[beam].clone();
    // What acts on a hub acts on the node.
    let mut jumps = point_loads(model, &scale, beam, length);
    for &(s, node) in &hubs {
        let (here, rest): (Vec<Jump>, Vec<Jump>) = jumps.into_iter().partition(|j| near(j.s, s));
        jumps = rest;
        lowered.nodes[node].loads.extend(here.into_iter().map(|j| (Vector3::zeros(), j.load, j.source)));
    }
    let path = format!("beam.{}", description.name);
    let hub_at = |s: f64| hubs.iter().find(|(hub, _)| near(*hub, s)).map(|(_, node)| *node);
    for (end, s, start) in [(&description.start, 0.0, true), (&description.end, length, false)] {
        if let (Some(end), Some(node)) = (end, hub_at(s)) {
            let hold =
                held(lowered, end, beam, s, &format!("{path}.{}", if start { "start" } else { "end" }))?;
            lowered.joints.push(NodeJoint {
                origin: JointOrigin::Hold { beam, start },
                parent: hold.carrier,
                child: Carrier { node: Some(node), frame: Pose::identity() },
                coordinates: hold.coordinates,
                mismatch: hold.mismatch,
            });
        }
    }
    // Stations: start (held or hub), hubs inside, end (held, hub or free).
    let mut stations: Vec<(f64, Option<usize>)> = Vec::new();
    if hub_at(0.0).is_none() {
        stations.push((0.0, None));
    }
    stations.extend(hubs.iter().map(|(s, node)| (*s, Some(*node))));
    if hub_at(length).is_none() {
        stations.push((length, None));
    }
    for (i, pair) in stations.windows(2).enumerate() {
        let ((a, from), (b, to)) = (pair[0], pair[1]);
        let last = i + 2 == stations.len();
        let start = match (from, &description.start) {
            (Some(node), _) => weld(&scale, node),
            (None, Some(end)) => held(lowered, end, beam, 0.0, &format!("{path}.start"))?,
            (None, None) => continue,
        };
        let end = match (to, &description.end) {
            (Some(node), _) => Some(weld(&scale, node)),
            (None, Some(end)) => Some(held(lowered, end, beam, length, &format!("{path}.end"))?),
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
        let founded = law.founded.meets([a, b], length);
        // A load that follows counts where it is nothing at the moment, so that neighbouring models have the same parts.
        let follows = |j: &Jump| j.source.is_some_and(|load| model.loads[load].frame != LoadFrame::Global);
        let spins = model.spin.is_some();
        let determinate =
            end.is_none() && !founded && !spins && !law.may_follow() && !inside.iter().any(follows);
        let mut span = Span {
            beam,
            s: [a, b],
            start,
            end,
            jumps: inside,
            determinate,
            tendons: Vec::new(),
            channels: Vec::new(),
            undivided: false,
        };
        cables::thread(model, law, &mut span)?;
        hold_spin(lowered, &mut span, &path);
        lowered.spans.push(span);
    }
    Ok(())
}

fn weld(scale: &Scale, node: usize) -> Hold {
    Hold {
        carrier: Carrier { node: Some(node), frame: Pose::identity() },
        coordinates: Coordinates::weld(scale),
        mismatch: Twist { angular: Vector3::zeros(), linear: Vector3::zeros() },
    }
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
        // Without gravity, too, so that a neighbouring model with some has the same parts.
        if mass.point.beam.0 == beam {
            let dead = scale.wrench_in(&Wrench::new(model.gravity * mass.mass, Vector3::zeros()));
            let outward = crate::spin::outward(model, scale, mass.mass);
            let load = PointLoad { dead, follower: Wrench::zero(), outward };
            jumps.push(Jump { s: mass.point.at.arc_length(length), load, source: None });
        }
    }
    jumps.sort_by(|a, b| a.s.total_cmp(&b.s));
    jumps
}

/// The hold of a beam's end at `s`, with the mismatch that is preload.
fn held(lowered: &mut Lowered, end: &End, beam: usize, s: f64, path: &str) -> Result<Hold, ProblemError> {
    let node = lowered.node_of(end.mount);
    let rest = lowered.rest_pose(beam, s);
    // An end without a placement attaches where the stress-free beam is; for the end that the beam was laid
    // out from, that is the body's origin.
    let frame = match end.placement {
        Some(pose) => lowered.scale.pose_in(&pose),
        None => lowered.initial(node).inverse() * rest,
    };
    let carrier = Carrier { node, frame };
    let offset = lowered.carrier_pose(&carrier).inverse() * rest;
    let coordinates = Coordinates::new(&end.hold, &lowered.scale, &offset).map_err(|error| {
        ProblemError::new(path, error.to_string(), "hold the end by a body, and put the contact there")
    })?;
    let left = coordinates.joint.pose(&coordinates.initial).inverse() * offset;
    let mismatch = left.log();
    if mismatch.linear.norm() > SNUG || mismatch.angular.norm() > SNUG {
        lowered.warnings.push(format!(
            "{path}: the stress-free beam ends {} from where it is attached, turned by {:.4} deg; the mismatch is preload",
            length_text(mismatch.linear.norm() * lowered.scale.length),
            mismatch.angular.norm().to_degrees(),
        ));
    }
    Ok(Hold { carrier, coordinates, mismatch })
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
