//! Multiple shooting as the thesis does it: three segments, thirteen numbers at every node, Newton's method on all of them at once.
//!
//! The thirteen are the position, the tangent R11, R12, R13, the twist φ about it, force and moment. The two other axes follow by the
//! smallest rotation from E1 to the tangent and the twist; where the tangent turns to -E1 the chart ends. With 13 (N + 1) unknown numbers
//! for N segments, `C = 0` collects the gaps and the ends' conditions (B.3), and `x ← x - α DC⁻¹ C` (B.4). Steps of Runge and Kutta's fourth order; differences
//! for DC. For comparison only.

use flexura_spatial::{UnitQuaternion, Vector3};
use nalgebra::{DMatrix, DVector};

/// Segments.
const SEGMENTS: usize = 3;
/// Numbers of a node.
pub const STATE: usize = 13;
const NODES: usize = SEGMENTS + 1;

/// A rod of unit length by its stiffnesses, straight at rest.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// 1/GJ, 1/EI2, 1/EI3.
    pub compliance: [f64; 3],
    /// Force per length.
    pub load: Vector3<f64>,
    /// Steps in each segment.
    pub steps: usize,
    /// The step factor α.
    pub factor: f64,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The state at every node.
    pub nodes: Vec<[f64; STATE]>,
    /// Steps of Newton's method.
    pub iterations: usize,
}

/// The section's axes of a tangent and a twist.
fn axes(tangent: Vector3<f64>, twist: f64) -> [Vector3<f64>; 3] {
    let smallest = UnitQuaternion::rotation_between(&Vector3::x(), &tangent).unwrap_or_default();
    let along = smallest * Vector3::x();
    let turned = UnitQuaternion::from_scaled_axis(along * twist) * smallest;
    [turned * Vector3::x(), turned * Vector3::y(), turned * Vector3::z()]
}

impl Recipe {
    fn rates(&self, state: &[f64; STATE]) -> [f64; STATE] {
        let part = |i: usize| Vector3::new(state[i], state[i + 1], state[i + 2]);
        let (tangent, force, moment) = (part(3), part(7), part(10));
        let axes = axes(tangent, state[6]);
        let k: [f64; 3] = std::array::from_fn(|i| self.compliance[i] * moment.dot(&axes[i]));
        let turn = axes[1] * k[2] - axes[2] * k[1];
        // (2.17): φ' = (k1 + k1 R11 + k2 R21 + k3 R31)/(1 + R11).
        let along = k[0] * axes[0].x + k[1] * axes[1].x + k[2] * axes[2].x;
        let twist = (k[0] + along) / (1.0 + axes[0].x);
        let bend = -tangent.cross(&force);
        let mut rates = [0.0; STATE];
        for i in 0..3 {
            (rates[i], rates[3 + i], rates[7 + i], rates[10 + i]) =
                (tangent[i], turn[i], -self.load[i], bend[i]);
        }
        rates[6] = twist;
        rates
    }

    /// The end of a segment.
    fn cross(&self, start: &[f64; STATE]) -> [f64; STATE] {
        let step = 1.0 / (SEGMENTS * self.steps) as f64;
        let add = |a: &[f64; STATE], b: &[f64; STATE], by: f64| std::array::from_fn(|i| a[i] + by * b[i]);
        let mut state = *start;
        for _ in 0..self.steps {
            let first = self.rates(&state);
            let second = self.rates(&add(&state, &first, 0.5 * step));
            let third = self.rates(&add(&state, &second, 0.5 * step));
            let fourth = self.rates(&add(&state, &third, step));
            state = std::array::from_fn(|i| {
                state[i] + step / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i])
            });
        }
        state
    }

    /// Of a clamp at the origin along x and a force and moment at the other end, from a straight rod whose force is the load and whose
    /// moment is that times half the length, until C is below `tolerance`. None: it does not get there in `most` steps.
    pub fn cantilever(
        &self,
        force: Vector3<f64>,
        moment: Vector3<f64>,
        tolerance: f64,
        most: usize,
    ) -> Option<Outcome> {
        let mut unknown = DVector::<f64>::zeros(STATE * NODES);
        let bend = Vector3::x().cross(&force) * 0.5;
        for node in 0..NODES {
            let place = node as f64 / SEGMENTS as f64;
            (unknown[STATE * node], unknown[STATE * node + 3]) = (place, 1.0);
            for i in 0..3 {
                unknown[STATE * node + 7 + i] = force[i];
                unknown[STATE * node + 10 + i] = bend[i];
            }
        }
        let node =
            |all: &DVector<f64>, i: usize| -> [f64; STATE] { std::array::from_fn(|j| all[STATE * i + j]) };
        let misfit = |all: &DVector<f64>| {
            let mut gaps = Vec::with_capacity(STATE * NODES);
            for segment in 0..SEGMENTS {
                let (end, next) = (self.cross(&node(all, segment)), node(all, segment + 1));
                gaps.extend((0..STATE).map(|i| end[i] - next[i]));
            }
            let (first, last) = (node(all, 0), node(all, SEGMENTS));
            gaps.extend([first[0], first[1], first[2], first[3] - 1.0, first[4], first[5], first[6]]);
            gaps.extend((0..3).map(|i| last[7 + i] - force[i]));
            gaps.extend((0..3).map(|i| last[10 + i] - moment[i]));
            DVector::from_vec(gaps)
        };
        for iterations in 0..=most {
            let now = misfit(&unknown);
            if now.amax() < tolerance {
                let nodes = (0..NODES).map(|i| node(&unknown, i)).collect();
                return Some(Outcome { nodes, iterations });
            }
            let mut jacobian = DMatrix::<f64>::zeros(STATE * NODES, STATE * NODES);
            for column in 0..STATE * NODES {
                let mut moved = unknown.clone();
                moved[column] += 1e-7;
                jacobian.set_column(column, &((misfit(&moved) - &now) / 1e-7));
            }
            unknown -= jacobian.lu().solve(&now)? * self.factor;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::elastica::Elastica;

    fn rod() -> Recipe {
        Recipe { compliance: [1.0; 3], load: Vector3::zeros(), steps: 60, factor: 1.0 }
    }

    #[test]
    fn it_bends_a_cantilever_as_elliptic_integrals_do() {
        let found = rod()
            .cantilever(Vector3::new(0.0, 2.0, 0.0), Vector3::zeros(), 1e-10, 40)
            .expect("it gets there");
        let [x, y] = Elastica::dead(2.0, std::f64::consts::FRAC_PI_2).at(1.0).position;
        assert_close(found.nodes[SEGMENTS][0], x, 1e-7, "x");
        assert_close(found.nodes[SEGMENTS][1], y, 1e-7, "y");
    }

    #[test]
    fn a_smaller_step_factor_takes_more_steps() {
        let force = Vector3::new(0.0, 0.0, -1.0);
        let whole = rod().cantilever(force, Vector3::zeros(), 1e-9, 40).expect("it gets there");
        let half = Recipe { factor: 0.5, ..rod() }
            .cantilever(force, Vector3::zeros(), 1e-9, 80)
            .expect("so does this");
        assert!(half.iterations > 2 * whole.iterations);
        assert_close(half.nodes[SEGMENTS][2], whole.nodes[SEGMENTS][2], 1e-8, "z");
    }
}
