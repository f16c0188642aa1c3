//! Where the laws of the mechanism change their form: a path may have a corner there, or end.

use crate::system::Equilibrium;
use flexura_mechanics::joint::Kinematics;
use flexura_nonlinear::System;
use std::fmt;

/// How far beside an edge its two sides are looked at, relative to a rest length.
const BESIDE: f64 = 1e-9;
/// How near to an edge a state counts as standing at it, relative to a rest length.
const NEARLY: f64 = 1e-4;

/// A place at which a law changes its form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Edge {
    /// A spring between slack and taut.
    Slack {
        /// Its name.
        spring: String,
    },
    /// A coordinate at a limit that pushes.
    Limit {
        /// What the coordinate belongs to.
        joint: String,
    },
}

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Edge::Slack { spring } => write!(f, "{spring} is between taut and slack"),
            Edge::Limit { joint } => write!(f, "{joint} is at its limit"),
        }
    }
}

impl Equilibrium {
    /// Does a joint or hold drive the mechanism?
    pub fn is_driven(&self) -> bool {
        self.coordinate_slots().any(|(coordinates, _)| coordinates.is_driven())
    }

    /// Does the path turn back in the load at an edge: has det J the other sign behind it? The state stands at the edge.
    pub fn turns_back_at(&mut self, edge: &Edge) -> bool {
        let index = match edge {
            Edge::Slack { spring } => {
                self.model.springs.iter().position(|other| *spring == format!("spring.{}", other.name))
            }
            Edge::Limit { .. } => return true,
        };
        let Some(index) = index else { return false };
        let Ok(course) = self.spring_course(index) else { return false };
        let mut law = self.spring_law(index);
        // The rest length with which it would be just slack.
        let (mut low, mut high) = (law.rest_length * (1.0 - NEARLY), law.rest_length * (1.0 + NEARLY));
        for _ in 0..50 {
            law.rest_length = 0.5 * (low + high);
            let end = if law.is_slack(course.length) { &mut high } else { &mut low };
            *end = law.rest_length;
        }
        let (slack, beside) = (law.rest_length, BESIDE * law.rest_length);
        let kept = self.lowered.springs[index].rest_length;
        let mut sign = |rest_length: f64| {
            self.lowered.springs[index].rest_length = [rest_length; 2];
            self.linearise().is_ok().then(|| self.orientation())
        };
        let signs = [sign(slack + beside), sign(slack - beside)];
        self.lowered.springs[index].rest_length = kept;
        self.factorised = false;
        signs[0] != signs[1]
    }

    /// The edges of laws that lie within `near` of the present state: of a spring's rest length as a part of that, of limits in
    /// L or radians.
    pub fn edges(&self, near: f64) -> Vec<Edge> {
        let mut edges = Vec::new();
        for index in 0..self.lowered.springs.len() {
            let law = self.spring_law(index);
            let Ok(course) = self.spring_course(index) else { continue };
            let width = near * law.rest_length.abs();
            if law.is_slack(course.length - width) != law.is_slack(course.length + width) {
                edges.push(Edge::Slack { spring: format!("spring.{}", self.model.springs[index].name) });
            }
        }
        let joints = self.lowered.joints.iter().zip(&self.layout.joints).enumerate();
        let joints =
            joints.map(|(i, (joint, slots))| (self.joint_name(i), &joint.coordinates, &slots.coordinates));
        let spans = self.lowered.spans.iter().zip(&self.layout.spans);
        let holds = spans.flat_map(|(span, slots)| {
            let name = |end: &str| format!("beam.{}.{end}", self.model.beams[span.beam].name);
            let end = span.end.as_ref().map(|end| (name("end"), &end.coordinates, &slots.end));
            std::iter::once((name("start"), &span.start.coordinates, &slots.start)).chain(end)
        });
        for (joint, coordinates, slot) in joints.chain(holds) {
            let q = coordinates.joint.coordinates(&self.configuration(slot));
            if coordinates.is_at_limit(&q, self.load, near) {
                edges.push(Edge::Limit { joint });
            }
        }
        edges
    }
}
