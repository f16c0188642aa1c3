//! Boundaries that touch: curves that roll on each other, and surfaces in contact as nets of lines.

use super::scene::{final_pose, initial_pose};
use crate::scene::{BoundaryScene, boundaries};
use flexura_model::{Joint, Model, Mount};
use flexura_solution::{JointSolution, Solution};
use flexura_spatial::{Pose, Vector3};
use std::f64::consts::TAU;

/// What is shown of a boundary without ends, as a part of the mechanism's size.
const REACH: f64 = 0.35;
/// Every so-manieth list of a net, and every so-manieth point of the lists, is a line.
const RINGS: usize = 4;
const RIBS: usize = 8;

/// A part of a boundary as a polygon, before and after.
pub struct Outline {
    pub initial: Vec<Vector3<f64>>,
    pub deformed: Vec<Vector3<f64>>,
    pub is_grounded: bool,
    /// One of several lines on a surface?
    pub is_surface: bool,
}

/// The boundaries of all joints that have some; what has no end is cut to a mechanism of the given size.
pub fn outlines(model: &Model, solution: &Solution, size: f64) -> Vec<Outline> {
    let joints = model.joints.iter().zip(&solution.joints);
    joints.flat_map(|(joint, result)| of_joint(model, solution, joint, result, size)).collect()
}

fn of_joint(
    model: &Model,
    solution: &Solution,
    joint: &Joint,
    result: &JointSolution,
    size: f64,
) -> Vec<Outline> {
    let Ok(Some(pair)) = boundaries(&joint.name, &joint.law) else { return Vec::new() };
    let child_pose = joint.child_pose.unwrap_or_else(Pose::identity);
    let sides =
        [(&pair.child, joint.child, child_pose), (&pair.parent, joint.parent.mount, joint.parent.pose)];
    let mut list = Vec::new();
    for (boundary, mount, frame) in sides {
        let now = final_pose(solution, mount) * frame;
        let before = initial_pose(model, solution, mount) * frame;
        let near = result.contact.map_or_else(Vector3::zeros, |contact| now.inverse().point(&contact.point));
        let is_surface = !matches!(boundary, BoundaryScene::Curve { .. } | BoundaryScene::Line { .. });
        for line in lines(boundary, &near, REACH * size) {
            list.push(Outline {
                initial: line.iter().map(|point| before.point(point)).collect(),
                deformed: line.iter().map(|point| now.point(point)).collect(),
                is_grounded: mount == Mount::Ground,
                is_surface,
            });
        }
    }
    list
}

/// Lines of a boundary in its own axes, m.
fn lines(boundary: &BoundaryScene, near: &Vector3<f64>, reach: f64) -> Vec<Vec<Vector3<f64>>> {
    match boundary {
        BoundaryScene::Curve { points } => vec![points.iter().map(|point| (*point).into()).collect()],
        BoundaryScene::Line { point, direction } => {
            let (point, direction) = (Vector3::from(*point), Vector3::from(*direction));
            let middle = point + direction * direction.dot(&(near - point));
            vec![vec![middle - direction * reach, middle + direction * reach]]
        }
        BoundaryScene::Plane {} => {
            let corner = |[a, b]: [f64; 2]| Vector3::new(near.x + a * reach, near.y + b * reach, 0.0);
            vec![[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]].map(corner).to_vec()]
        }
        BoundaryScene::Cylinder { semi_axes: [a, b] } => {
            let place = |i: usize, z: f64| {
                let angle = TAU * i as f64 / 32.0;
                Vector3::new(a * angle.cos(), b * angle.sin(), near.z + z)
            };
            let ring = |z: f64| (0..=32).map(|i| place(i, z)).collect::<Vec<_>>();
            let ribs = (0..32).step_by(RIBS).map(|i| vec![place(i, -reach), place(i, reach)]);
            [ring(-reach), ring(reach)].into_iter().chain(ribs).collect()
        }
        BoundaryScene::Net { rows, points } => net(*rows, points),
    }
}

fn net(rows: usize, points: &[[f64; 3]]) -> Vec<Vec<Vector3<f64>>> {
    let count = points.len() / rows.max(1);
    if count == 0 {
        return Vec::new();
    }
    let lists: Vec<&[[f64; 3]]> = points.chunks(count).collect();
    let rings = lists.iter().step_by(RINGS).map(|list| {
        let closed = list.iter().chain(list.first());
        closed.map(|point| Vector3::from(*point)).collect::<Vec<_>>()
    });
    let ribs = (0..count).step_by(RIBS);
    let ribs = ribs.map(|i| lists.iter().map(|list| Vector3::from(list[i])).collect::<Vec<_>>());
    rings.chain(ribs).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_end_is_cut_about_the_contact() {
        let near = Vector3::new(5.0, 0.0, 0.0);
        let line = BoundaryScene::Line { point: [0.0, 1.0, 0.0], direction: [1.0, 0.0, 0.0] };
        assert_eq!(lines(&line, &near, 2.0), [[Vector3::new(3.0, 1.0, 0.0), Vector3::new(7.0, 1.0, 0.0)]]);
        let plane = lines(&BoundaryScene::Plane {}, &near, 2.0);
        assert_eq!(plane[0].len(), 5);
        assert!(plane[0].iter().all(|point| (point - near).norm() < 3.0));
        let cylinder = BoundaryScene::Cylinder { semi_axes: [1.0, 2.0] };
        assert!(lines(&cylinder, &near, 2.0).iter().flatten().all(|point| point.z.abs() <= 2.0));
    }
}
