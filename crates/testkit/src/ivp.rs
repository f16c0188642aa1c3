//! Initial value problems by extrapolation, and what they solve exactly: rods whose end wrench turns with
//! the end.
//!
//! Gragg's modified midpoint rule with 2, 4, .. 12 substeps, extrapolated in h² (order 12; more would amplify
//! round-off): Hairer, Nørsett
//! and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. (1993), II.9.

use crate::rod::{Rod, State};
use flexura_spatial::{Pose, Wrench};

const LEVELS: usize = 6;

/// The solution of y' = f(s, y) at `steps` equal steps from `from` to `to`, the start included.
pub fn integrate<const N: usize>(
    f: impl Fn(f64, &[f64; N]) -> [f64; N],
    start: [f64; N],
    from: f64,
    to: f64,
    steps: usize,
) -> Vec<(f64, [f64; N])> {
    let h = (to - from) / steps as f64;
    let mut path = vec![(from, start)];
    let mut y = start;
    for i in 0..steps {
        let s = from + h * i as f64;
        y = extrapolate(&f, s, &y, h);
        path.push((from + h * (i + 1) as f64, y));
    }
    path
}

/// One extrapolated step, by Neville's scheme in h².
fn extrapolate<const N: usize>(
    f: &impl Fn(f64, &[f64; N]) -> [f64; N],
    s: f64,
    y: &[f64; N],
    h: f64,
) -> [f64; N] {
    // Increments rather than values, so that round-off stays relative to the step.
    let mut row: Vec<[f64; N]> = Vec::with_capacity(LEVELS);
    for j in 0..LEVELS {
        let mut new = vec![midpoint(f, s, y, h, 2 * (j + 1))];
        for k in 1..=j {
            let ratio = ((j + 1) as f64 / (j + 1 - k) as f64).powi(2) - 1.0;
            let next = std::array::from_fn(|i| new[k - 1][i] + (new[k - 1][i] - row[k - 1][i]) / ratio);
            new.push(next);
        }
        row = new;
    }
    let last = row[LEVELS - 1];
    std::array::from_fn(|i| y[i] + last[i])
}

/// The increment by the modified midpoint rule.
fn midpoint<const N: usize>(
    f: &impl Fn(f64, &[f64; N]) -> [f64; N],
    s: f64,
    y: &[f64; N],
    h: f64,
    substeps: usize,
) -> [f64; N] {
    let small = h / substeps as f64;
    let slope = f(s, y);
    let mut before = [0.0; N];
    let mut now: [f64; N] = std::array::from_fn(|i| small * slope[i]);
    for n in 1..substeps {
        let at = std::array::from_fn(|i| y[i] + now[i]);
        let slope = f(s + small * n as f64, &at);
        let next = std::array::from_fn(|i| before[i] + 2.0 * small * slope[i]);
        before = now;
        now = next;
    }
    let at = std::array::from_fn(|i| y[i] + now[i]);
    let slope = f(s + h, &at);
    std::array::from_fn(|i| 0.5 * (before[i] + now[i] + small * slope[i]))
}

/// A clamped rod under an end wrench that is given in the end section's own axes.
#[derive(Clone, Debug)]
pub struct FollowerSolution {
    /// Arc length and pose in the clamp's frame, from the clamp to the end.
    pub poses: Vec<(f64, Pose)>,
    /// The internal wrench at the clamp, in the clamp's axes.
    pub root: Wrench,
}

impl FollowerSolution {
    /// The pose of the end in the clamp's frame.
    pub fn tip(&self) -> Pose {
        self.poses.last().map_or_else(Pose::identity, |(_, pose)| *pose)
    }
}

/// The equilibrium of a clamped rod under a follower wrench at its end (in the end's own axes).
///
/// Seen from the end the problem has no unknown: there the pose is the identity and the wrench is given,
/// so the balance equations are integrated backwards and the clamp is where they arrive. No iteration, no
/// guess; the error is that of the integrator (halve the steps to see it). The rod's distributed load must
/// be zero, since a dead load has no fixed axes here.
pub fn follower_end(rod: &Rod, wrench: &Wrench, steps: usize) -> FollowerSolution {
    let start = State::new(&Pose::identity(), wrench).to_array();
    let path = integrate(|s, y| rod.rates(s, y, 0.0), start, rod.length, 0.0, steps);
    let root = State::from_array(&path[steps].1);
    let home = root.pose().inverse();
    let poses = path.iter().rev().map(|(s, y)| (*s, home * State::from_array(y).pose())).collect();
    FollowerSolution { poses, root: root.wrench().rotated(&home.rotation) }
}

/// The poses of an unloaded rod, from the identity, at `steps` equal steps.
pub fn rest_poses(rod: &Rod, steps: usize) -> Vec<(f64, Pose)> {
    let start = State::new(&Pose::identity(), &Wrench::zero()).to_array();
    integrate(|s, y| rod.rates(s, y, 0.0), start, 0.0, rod.length, steps)
        .into_iter()
        .map(|(s, y)| (s, State::from_array(&y).pose()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastica::Elastica;
    use crate::{assert_close, assert_close_vec};
    use flexura_spatial::Vector3;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_circle_and_an_exponential_come_back() {
        let path = integrate(|_, y: &[f64; 2]| [-y[1], y[0]], [1.0, 0.0], 0.0, 10.0, 32);
        assert_close(path[32].1[0], 10f64.cos(), 2e-14, "cos");
        assert_close(path[32].1[1], 10f64.sin(), 2e-14, "sin");
        let path = integrate(|s, y: &[f64; 1]| [y[0] * s], [1.0], 0.0, 2.0, 16);
        assert_close(path[16].1[0], 2f64.exp(), 2e-14, "exp(s²/2)");
    }

    #[test]
    fn the_planar_follower_force_agrees_with_elliptic_integrals() {
        for load in [1.0, 4.0, 13.0] {
            let rod = Rod::uniform(1.0, [0.0, 0.0, 0.0, 1.3, 1.0, 1.0], Vector3::zeros());
            let force = Vector3::new(0.0, load, 0.0);
            let found = follower_end(&rod, &Wrench::new(force, Vector3::zeros()), 48);
            let exact = Elastica::follower(load, FRAC_PI_2);
            for (s, pose) in &found.poses {
                let [x, y] = exact.at(*s).position;
                assert_close_vec(&pose.position, &Vector3::new(x, y, 0.0), 3e-14, "shape");
            }
            assert_close(found.root.moment.z, exact.at(0.0).curvature, 1e-13 * load, "clamp");
        }
    }

    #[test]
    fn halving_the_steps_changes_nothing() {
        let rod = Rod::uniform(2.0, [0.01, 0.02, 0.02, 1.3, 1.0, 0.7], Vector3::new(0.2, 0.1, 0.5));
        let wrench = Wrench::new(Vector3::new(-0.5, 1.0, 0.8), Vector3::new(0.3, 0.0, -0.4));
        let (coarse, fine) = (follower_end(&rod, &wrench, 24).tip(), follower_end(&rod, &wrench, 48).tip());
        assert_close_vec(&coarse.position, &fine.position, 1e-13, "tip");
        assert_close(coarse.rotation.angle_to(&fine.rotation), 0.0, 1e-13, "turn");
    }
}
