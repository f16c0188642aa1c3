//! Where the laws of the mechanism change their form: a path may have a corner there, or end.

use crate::system::Equilibrium;
use flexura_mechanics::joint::Kinematics;
use std::fmt;

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
        let joints = joints.map(|(i, (joint, slots))| (self.joint_name(i), &joint.coordinates, &slots.coordinates));
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
