//! Where a mechanism has no energy of which the second variation could be taken.

use crate::lower::{Carrier, Hold};
use crate::system::Equilibrium;
use flexura_model::CoordinateKind;
use flexura_spatial::{Vector3, Wrench};

type V = Vector3<f64>;

impl Equilibrium {
    /// Why stability is not decided for this mechanism under its loads; None where it can be.
    pub(super) fn undecided(&self) -> Option<String> {
        if let Some(tubes) = self.model.tubes.first() {
            return Some(format!(
                "tubes.{}: the stability of concentric tubes is not decided by this version",
                tubes.name
            ));
        }
        if let Some(span) = self.lowered.spans.iter().find(|span| span.undivided) {
            let beam = &self.model.beams[span.beam].name;
            return Some(format!(
                "beam.{beam}: the stability of a beam with a tendon of given length in its channels is not decided by this version"
            ));
        }
        for (i, law) in self.lowered.beams.iter().enumerate() {
            let name = &self.model.beams[i].name;
            if law.follows() {
                return Some(format!(
                    "beam.{name}: its distributed load follows the section and has no energy"
                ));
            }
            if law.turns() {
                return Some(format!(
                    "beam.{name}: its distributed moment keeps its direction while sections turn, and has no energy"
                ));
            }
        }
        for (node, description) in self.lowered.nodes.iter().enumerate() {
            for (_, load, source) in &description.loads {
                if let Some(why) = verdict(&load.dead, &load.follower, self.turns(Some(node), 0)) {
                    return Some(self.blame(*source, why));
                }
            }
        }
        for span in &self.lowered.spans {
            let length = self.lowered.beams[span.beam].length;
            for jump in &span.jumps {
                let turns = if jump.s <= 1e-12 * length {
                    self.turns_of_hold(&span.start)
                } else if jump.s >= span.s[1] - 1e-12 * length {
                    span.end.as_ref().map_or(3, |end| self.turns_of_hold(end))
                } else {
                    3
                };
                if let Some(why) = verdict(&jump.load.dead, &jump.load.follower, turns) {
                    return Some(self.blame(jump.source, why));
                }
            }
        }
        None
    }

    fn blame(&self, load: Option<usize>, why: &str) -> String {
        match load {
            Some(load) => format!("load.{}: {why}", self.model.loads[load].name),
            None => why.to_string(),
        }
    }

    fn turns_of_hold(&self, hold: &Hold) -> usize {
        let own = free_turnings(&hold.coordinates);
        (own + self.turns_of_carrier(&hold.carrier, 0)).min(3)
    }

    fn turns_of_carrier(&self, carrier: &Carrier, depth: usize) -> usize {
        self.turns(carrier.node, depth + 1)
    }

    /// About how many axes, fixed in space, a node can turn at most; 3 where its turning is not restricted by a joint to
    /// something that does not turn.
    fn turns(&self, node: Option<usize>, depth: usize) -> usize {
        let Some(node) = node else { return 0 };
        if depth > 8 {
            return 3;
        }
        let mut fewest = 3;
        for joint in &self.lowered.joints {
            let other = match (joint.parent.node, joint.child.node) {
                (parent, Some(child)) if child == node => parent,
                (Some(parent), child) if parent == node => child,
                _ => continue,
            };
            let beyond = if other.is_none() { 0 } else { self.turns(other, depth + 3) };
            fewest = fewest.min(free_turnings(&joint.coordinates) + beyond);
        }
        fewest
    }
}

fn free_turnings(coordinates: &crate::coordinates::Coordinates) -> usize {
    let kinds = coordinates.kind.coordinate_kinds();
    let free = |i: &usize| kinds[*i] == CoordinateKind::Angle && coordinates.unknown_of(*i).is_some();
    (0..kinds.len()).filter(free).count()
}

/// Why a load on something that turns about so many axes has no energy.
fn verdict(dead: &Wrench, follower: &Wrench, turns: usize) -> Option<&'static str> {
    if turns > 1 && dead.moment != V::zeros() {
        return Some(
            "a moment that keeps its direction, on something that turns about more than one axis, has no energy",
        );
    }
    if turns > 0 && follower.force != V::zeros() {
        return Some("a force that follows what it acts on has no energy");
    }
    if turns > 1 && follower.moment != V::zeros() {
        return Some("a moment that follows what it acts on has no energy");
    }
    None
}
