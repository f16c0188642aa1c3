//! What a state says about its contacts: whether they hold, and where their boundaries end.

use crate::system::Equilibrium;
use flexura_model::{CoordinateKind, JointKind};
use flexura_spatial::Vector3;

/// A pull smaller than this, relative to the wrench in the joint, is round-off.
const PULL: f64 = 1e-9;

/// Cosine of a universal joint's second angle below which it counts as a right one.
const LOCKED: f64 = 0.05;

impl Equilibrium {
    /// Contacts that pull, and hollows that are too narrow.
    pub(crate) fn contact_warnings(&self, warnings: &mut Vec<String>) {
        for (i, (joint, slots)) in self.lowered.joints.iter().zip(&self.layout.joints).enumerate() {
            let Some(contact) = joint.coordinates.joint.contact(&self.configuration(&slots.coordinates))
            else {
                continue;
            };
            let name = self.joint_name(i);
            let base = self.node_pose(joint.parent.node) * joint.parent.frame;
            let force: Vector3<f64> = self.triple(slots.wrench.state);
            let moment: Vector3<f64> = self.triple(slots.wrench.state + 3);
            let normal = (base.rotation * contact.normal).dot(&force);
            if normal < -PULL * (force.norm() + moment.norm()) {
                let newton = -normal * self.lowered.scale.force;
                warnings.push(format!(
                    "{name}: its contact pulls with {newton:.4e} N: without something that holds them together the two would lift off"
                ));
            }
            if !contact.fits {
                warnings.push(format!(
                    "{name}: where they touch, the hollow of the parent is more curved than the child: they would cut into each other"
                ));
            }
        }
    }

    /// Rolling joints that stand at the end of their boundaries, for the reason why a way ended.
    pub fn contact_ends(&self) -> Vec<String> {
        let mut ends = Vec::new();
        for (i, (joint, slots)) in self.lowered.joints.iter().zip(&self.layout.joints).enumerate() {
            let coordinates = &joint.coordinates;
            let Some(range) = coordinates.joint.range() else { continue };
            let q = self.configuration(&slots.coordinates)[0];
            let width = (range[1] - range[0]).min(1.0);
            let near = |end: &f64| (q - end).abs() < 0.02 * width;
            if let Some(end) = range.iter().find(|end| near(end)) {
                let end = end * coordinates.units[0];
                let text = match coordinates.kind.coordinate_kinds()[0] {
                    CoordinateKind::Angle => format!("{:.4} deg", end.to_degrees()),
                    CoordinateKind::Length => crate::lower::length_text(end),
                };
                ends.push(format!("{} is near {text}, where one of its boundaries ends", self.joint_name(i)));
            }
        }
        ends
    }

    /// Universal joints and holds near a right angle, for the reason why a way ended: there the first axis lies along what the joint
    /// carries, and no torque about that passes.
    pub fn locked_joints(&self) -> Vec<String> {
        self.told_coordinates()
            .filter(|(coordinates, ..)| coordinates.kind == JointKind::Universal)
            .filter(|(_, slot, _)| self.configuration(slot)[1].cos().abs() < LOCKED)
            .map(|(.., told)| {
                let name = self.name_of(told);
                format!("{name}: its universal joint stands near a right angle, where it lets no torque about its shaft pass")
            })
            .collect()
    }
}
