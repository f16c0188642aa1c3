//! Cables: straight from guide to guide, one tension.

use super::actions::Action;
use super::answer::{Answer, Check, V};
use super::rod::Carried;
use flexura::model::{At, BeamPoint, CableLaw, Guide, Mount};

/// A place that a cable goes through: what carries it, and where it is.
type Place = (Mount, V);

/// Where a guide begins and where it ends.
fn ends(answer: &Answer, guide: &Guide) -> [Place; 2] {
    match guide {
        Guide::Point(attachment) => [(attachment.mount, answer.point(attachment)); 2],
        Guide::Channel { beam, between, offset } => between.map(|at| {
            let rod = &answer.rods[beam.0];
            let s = at.arc_length(rod.length);
            let point = BeamPoint { beam: *beam, at: At::Length(s) };
            let pose = answer.station(&point).pose;
            (Mount::Beam(point), rod.channel_point(offset, s, &pose))
        }),
    }
}

/// The straight parts.
fn lines(answer: &Answer, cable: usize) -> Vec<[Place; 2]> {
    let route = &answer.model.cables[cable].route;
    route.windows(2).map(|pair| [ends(answer, &pair[0])[1], ends(answer, &pair[1])[0]]).collect()
}

/// What it pulls its guides with.
pub fn actions(answer: &Answer, cable: usize) -> Vec<Action> {
    let told = answer.document.cables.get(&answer.model.cables[cable].name);
    let Some(told) = told.filter(|told| told.tension != 0.0) else { return Vec::new() };
    let mut actions = Vec::new();
    for [from, to] in lines(answer, cable) {
        let span = to.1 - from.1;
        if span.norm() > 0.0 {
            let pull = span * (told.tension / span.norm());
            for ((on, point), force) in [(from, pull), (to, -pull)] {
                actions.push(Action { on, point, force, moment: V::zeros(), is_load: false });
            }
        }
    }
    actions
}

/// Tension or length as given, and the length that the document tells. `carried`: what the intervals of every beam gave.
pub fn checks(answer: &Answer, carried: &[Vec<Carried>], checks: &mut Vec<Check>) {
    for (index, cable) in answer.model.cables.iter().enumerate() {
        let Some(told) = answer.document.cables.get(&cable.name) else { continue };
        let mut length: f64 = lines(answer, index).iter().map(|[from, to]| (to.1 - from.1).norm()).sum();
        for (rod, intervals) in answer.rods.iter().zip(carried) {
            for (place, _) in rod.channels.iter().enumerate().filter(|(_, channel)| channel.cable == index) {
                length += intervals.iter().map(|interval| interval.lengths[place]).sum::<f64>();
            }
        }
        let unit = answer.length.max(length);
        checks.push(Check {
            what: format!("length of cable.{}", cable.name),
            difference: (length - told.length).abs() / unit,
        });
        let off = match cable.law {
            CableLaw::Length(wanted) => (wanted - told.length).abs() / unit,
            CableLaw::Tension(wanted) => (wanted - told.tension).abs() / answer.force,
        };
        checks.push(Check { what: format!("law of cable.{}", cable.name), difference: off });
    }
}
