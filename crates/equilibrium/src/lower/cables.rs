//! Cables: straight lines between guides, and channels along beams.

use super::attachments::{distance, place};
use super::{Course, Lowered, Rope, RopeLaw, Span, near};
use crate::beam::BeamLaw;
use crate::channel::{Route, TendonChannel};
use crate::error::ProblemError;
use crate::shooting::MAX_TENSIONS;
use flexura_model::{At, BeamPoint, Cable, CableLaw, Guide, Model, Mount};
use flexura_spatial::Vector3;

/// Does the cable pass from one guide straight into the next, from channel to channel at one point of a section?
fn joins(from: &Guide, to: &Guide, lengths: &[f64]) -> bool {
    let (
        Guide::Channel { beam: a, between: [_, end], offset: first },
        Guide::Channel { beam: b, between: [start, _], offset: second },
    ) = (from, to)
    else {
        return false;
    };
    let length = lengths[a.0];
    let s = end.arc_length(length);
    let apart = |k: usize| (first[k].value(s, length) - second[k].value(s, length)).abs();
    a == b && near(s, start.arc_length(length), length) && apart(0).max(apart(1)) < 1e-12 * length
}

/// Places on which the straight parts of a cable pull: points, and where it enters or leaves a channel.
pub(super) fn mounts(cable: &Cable, lengths: &[f64]) -> Vec<Mount> {
    let mut mounts = Vec::new();
    for guide in &cable.route {
        if let Guide::Point(attachment) = guide {
            mounts.push(attachment.mount);
        }
    }
    for pair in cable.route.windows(2) {
        if joins(&pair[0], &pair[1], lengths) {
            continue;
        }
        let mouths = [(&pair[0], 1), (&pair[1], 0)];
        for (guide, which) in mouths {
            if let Guide::Channel { beam, between, .. } = guide {
                mounts.push(Mount::Beam(BeamPoint { beam: *beam, at: between[which] }));
            }
        }
    }
    mounts
}

/// Puts into a span the channels that run along it.
pub(super) fn thread(model: &Model, law: &BeamLaw, span: &mut Span) -> Result<(), ProblemError> {
    let [first, last] = span.s;
    let mut unknown = 0;
    for (index, cable) in model.cables.iter().enumerate() {
        let mut here = false;
        for (i, guide) in cable.route.iter().enumerate() {
            let Guide::Channel { beam, between, offset } = guide else { continue };
            if beam.0 != span.beam {
                continue;
            }
            let route = Route { offset: offset.clone(), length: law.length };
            let ends = between.map(|at| at.arc_length(law.length));
            let s = [ends[0].min(ends[1]).max(first), ends[0].max(ends[1]).min(last)];
            if s[1] <= s[0] || near(s[0], s[1], law.length) {
                continue;
            }
            check(&format!("cable.{}.route[{i}]", cable.name), &model[*beam].name, law, &route, s)?;
            if !here {
                span.tendons.push(index);
                here = true;
            }
            span.channels.push(TendonChannel::new(law, span.tendons.len() - 1, route, s));
        }
        if here && matches!(cable.law, CableLaw::Length(_)) {
            unknown += 1;
            span.undivided = true;
            if unknown > MAX_TENSIONS {
                return Err(ProblemError::new(
                    format!("cable.{}", cable.name),
                    format!(
                        "more than {MAX_TENSIONS} cables of given length run along one stretch of beam.{}",
                        model.beams[span.beam].name
                    ),
                    "give the tension of some of them",
                ));
            }
        }
    }
    Ok(())
}

/// A channel must lead forwards along the undeformed beam.
fn check(path: &str, beam: &str, law: &BeamLaw, route: &Route, s: [f64; 2]) -> Result<(), ProblemError> {
    const PLACES: usize = 129;
    for i in 0..PLACES {
        let at = s[0] + (s[1] - s[0]) * (i as f64 + 0.5) / PLACES as f64;
        let advance = route.advance_at_rest(law, at);
        if !(advance.y.is_finite() && advance.z.is_finite()) {
            return Err(ProblemError::new(
                format!("{path}.offset"),
                format!("gives no finite number at s = {at} m"),
                "check the expression",
            ));
        }
        if advance.x <= 0.0 {
            return Err(ProblemError::new(
                format!("{path}.offset"),
                format!(
                    "at s = {at:.6} m the channel lies {:.6} m from the axis, beyond the centre about which beam.{beam} is curved there",
                    route.point(at).norm()
                ),
                "bring the channel closer to the axis, or to its other side",
            ));
        }
    }
    Ok(())
}

/// Where a cable meets a guide: at its first or last place.
fn meets(lowered: &Lowered, guide: &Guide, last: bool) -> (Option<usize>, Vector3<f64>) {
    match guide {
        Guide::Point(attachment) => place(lowered, attachment),
        Guide::Channel { beam, between, offset } => {
            let at = between[usize::from(last)];
            let length = lowered.beams[beam.0].length;
            let route = Route { offset: offset.clone(), length };
            let point = route.point(at.arc_length(length)) / lowered.scale.length;
            (lowered.hub_at(&BeamPoint { beam: *beam, at }), point)
        }
    }
}

pub(super) fn lower_cable(lowered: &mut Lowered, cable: &Cable) -> Result<(), ProblemError> {
    let scale = lowered.scale;
    let path = format!("cable.{}", cable.name);
    let lengths: Vec<f64> = lowered.beams.iter().map(|law| law.length).collect();
    let (mut lines, mut course, mut length) = (Vec::new(), Vec::new(), 0.0);
    for (i, guide) in cable.route.iter().enumerate() {
        if let Guide::Channel { beam, between, offset } = guide {
            let law = &lowered.beams[beam.0];
            let route = Route { offset: offset.clone(), length: law.length };
            let between: [f64; 2] = between.map(|at: At| at.arc_length(law.length));
            let [a, b] = between;
            length += route.rest_length(law, [a.min(b), a.max(b)]) / scale.length;
            course.push(Course::Channel { beam: beam.0, between, route });
        }
        let Some(next) = cable.route.get(i + 1).filter(|next| !joins(guide, next, &lengths)) else {
            continue;
        };
        let line = [meets(lowered, guide, true), meets(lowered, next, false)];
        let distance = distance(lowered, &line);
        if distance < 1e-12 {
            let channel = [guide, next].iter().any(|guide| matches!(guide, Guide::Channel { .. }));
            return Err(ProblemError::new(
                format!("{path}.route"),
                format!(
                    "the guides {} and {} coincide, so that the cable has no direction between them",
                    i + 1,
                    i + 2
                ),
                if channel {
                    "leave the point out: where a channel is the first or last guide, the cable is anchored in it"
                } else {
                    "move one of them"
                },
            ));
        }
        length += distance;
        course.push(Course::Line(lines.len()));
        lines.push(line);
    }
    let law = match cable.law {
        CableLaw::Tension(tension) => RopeLaw::Tension(tension / scale.force),
        CableLaw::Length(wanted) => RopeLaw::Length([length, wanted / scale.length]),
    };
    lowered.ropes.push(Rope { lines, law, course });
    Ok(())
}
