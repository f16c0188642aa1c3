//! Joints and couplings between nodes, and points on nodes.

use super::{Carrier, Gear, JointOrigin, Lowered, NodeJoint, SNUG, contact, length_text};
use crate::coordinates::Coordinates;
use crate::error::ProblemError;
use flexura_mechanics::joint::Kinematics;
use flexura_model::{Attachment, Coupling, Model};
use flexura_spatial::Vector3;

pub(super) fn lower_joint(model: &Model, lowered: &mut Lowered, index: usize) -> Result<(), ProblemError> {
    let joint = &model.joints[index];
    let parent = Carrier {
        node: lowered.node_of(joint.parent.mount),
        frame: lowered.scale.pose_in(&joint.parent.pose),
    };
    let fixed = lowered.carrier_pose(&parent);
    let child_node = lowered.node_of(joint.child);
    let frame = match &joint.child_pose {
        Some(pose) => lowered.scale.pose_in(pose),
        None => lowered.initial(child_node).inverse() * fixed,
    };
    let child = Carrier { node: child_node, frame };
    let offset = fixed.inverse() * lowered.carrier_pose(&child);
    let coordinates = Coordinates::new(&joint.law, &lowered.scale, &offset)
        .map_err(|error| contact::problem(joint, &error))?;
    let mismatch = (coordinates.joint.pose(&coordinates.initial).inverse() * offset).log();
    let apart = mismatch.linear.norm() * lowered.scale.length;
    match &joint.law.contact {
        Some(law) => contact::check(joint, law, &coordinates, &mismatch, apart)?,
        None if mismatch.linear.norm() > SNUG || mismatch.angular.norm() > SNUG => {
            lowered.warnings.push(format!(
                "joint.{}: its two frames are {} and {:.4} deg apart in the initial poses; they are brought together",
                joint.name,
                length_text(apart),
                mismatch.angular.norm().to_degrees(),
            ));
        }
        None => {}
    }
    lowered.joints.push(NodeJoint {
        origin: JointOrigin::Joint(index),
        parent,
        child,
        coordinates,
        mismatch,
    });
    Ok(())
}

pub(super) fn lower_coupling(
    model: &Model,
    lowered: &mut Lowered,
    coupling: &Coupling,
) -> Result<(), ProblemError> {
    let terms = || coupling.terms.iter().map(|t| (t.joint.0, t.coordinate, t.factor));
    let units = |joint: usize, coordinate: usize| lowered.joints[joint].coordinates.units[coordinate];
    let unit = terms().map(|(j, c, factor)| (factor * units(j, c)).abs()).fold(0.0, f64::max);
    if unit == 0.0 {
        return Err(ProblemError::new(
            format!("coupling.{}", coupling.name),
            "all its factors are zero",
            "give each coordinate a factor",
        ));
    }
    let free = terms().any(|(j, c, _)| lowered.joints[j].coordinates.unknown_of(c).is_some());
    if !free {
        let names: Vec<String> = terms().map(|(j, ..)| format!("joint.{}", model.joints[j].name)).collect();
        return Err(ProblemError::new(
            format!("coupling.{}", coupling.name),
            format!("all its coordinates are driven: {}", names.join(", ")),
            "leave one of them free",
        ));
    }
    let terms: Vec<_> = terms().map(|(j, c, factor)| (j, c, factor * units(j, c) / unit)).collect();
    let at_rest = terms
        .iter()
        .map(|(j, c, factor)| {
            let coordinates = &lowered.joints[*j].coordinates;
            factor * coordinates.joint.coordinates(&coordinates.initial)[*c]
        })
        .sum();
    for (joint, ..) in &terms {
        lowered.joints[*joint].coordinates.coupled = true;
    }
    lowered.gears.push(Gear { terms, offset: [at_rest, coupling.offset / unit], unit });
    Ok(())
}

pub(super) fn place(lowered: &Lowered, attachment: &Attachment) -> (Option<usize>, Vector3<f64>) {
    (lowered.node_of(attachment.mount), attachment.point / lowered.scale.length)
}

pub(super) fn distance(lowered: &Lowered, ends: &[(Option<usize>, Vector3<f64>); 2]) -> f64 {
    let [a, b] = ends.map(|(node, point)| lowered.initial(node).point(&point));
    (b - a).norm()
}
