//! Boundaries that roll on each other.

use super::scene::{final_pose, initial_pose};
use flexura_geometry::Contour;
use flexura_model::{Contact, Joint, Model, Mount, Rolling};
use flexura_solution::{JointSolution, Solution};
use flexura_spatial::{Pose, Vector3};

/// Chords of one boundary.
const CHORDS: usize = 96;

/// A boundary as a polygon, before and after.
pub struct Outline {
    pub initial: Vec<Vector3<f64>>,
    pub deformed: Vec<Vector3<f64>>,
    pub is_grounded: bool,
}

/// The boundaries of all rolling joints.
pub fn outlines(model: &Model, solution: &Solution) -> Vec<Outline> {
    let joints = model.joints.iter().zip(&solution.joints);
    joints
        .flat_map(|(joint, result)| match joint.law.contact.as_deref() {
            Some(Contact::Rolling(rolling)) => of_rolling(model, solution, joint, rolling, result),
            _ => Vec::new(),
        })
        .collect()
}

fn of_rolling(
    model: &Model,
    solution: &Solution,
    joint: &Joint,
    rolling: &Rolling,
    result: &JointSolution,
) -> Vec<Outline> {
    let (x, y) = (joint.law.second_axis, joint.law.axis.cross(&joint.law.second_axis));
    let child_pose = joint.child_pose.unwrap_or_else(Pose::identity);
    let sides =
        [(&rolling.child, joint.child, child_pose), (&rolling.parent, joint.parent.mount, joint.parent.pose)];
    let contours = sides.map(|(boundary, ..)| Contour::new(boundary).ok());
    let lengths = contours.each_ref().map(|contour| contour.as_ref().and_then(Contour::length));
    // What is shown of a line without end: about as much as rolls on it.
    let reach = 0.75 * lengths.iter().flatten().fold(0.0, |a: f64, b| a.max(*b));
    let mut list = Vec::new();
    for (which, ((_, mount, frame), contour)) in sides.into_iter().zip(&contours).enumerate() {
        let Some(contour) = contour else { continue };
        let middle = result.contact.map_or(0.0, |contact| contact.parameters[which][0]);
        let points = contour.polyline(CHORDS, middle, reach);
        let seen = |body: Pose| -> Vec<Vector3<f64>> {
            let pose = body * frame;
            points.iter().map(|[a, b]| pose.point(&(x * *a + y * *b))).collect()
        };
        list.push(Outline {
            initial: seen(initial_pose(model, solution, mount)),
            deformed: seen(final_pose(solution, mount)),
            is_grounded: mount == Mount::Ground,
        });
    }
    list
}
