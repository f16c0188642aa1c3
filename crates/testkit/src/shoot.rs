//! Single shooting along one uniform rod: the second method for ends whose conditions are of any kind.
//!
//! The rod is integrated from its start by extrapolation of order 12 ([`crate::ivp::integrate`]); unknown numbers of the start are found by
//! Newton's method with central differences, led from an easy problem to the wanted one.

use crate::ivp::integrate;
use crate::rod::{Rod, State};
use nalgebra::{DMatrix, DVector};

/// Steps of the integration along the rod.
const STEPS: usize = 64;

/// What is to be met, for a fraction of the way to the wanted problem.
pub struct Shooting<'a, const N: usize> {
    /// The rod; without distributed loads.
    pub rod: &'a Rod,
    /// The start, of the unknown numbers.
    pub start: &'a dyn Fn(f64, &[f64; N]) -> State,
    /// What must vanish, of the unknown numbers and the end.
    pub misfit: &'a Misfit<'a, N>,
}

/// What must vanish: by the fraction of the way, the unknown numbers and the end.
pub type Misfit<'a, const N: usize> = dyn Fn(f64, &[f64; N], &State) -> [f64; N] + 'a;

impl<const N: usize> Shooting<'_, N> {
    /// The end that is reached.
    pub fn end(&self, fraction: f64, unknown: &[f64; N]) -> State {
        let start = (self.start)(fraction, unknown).to_array();
        let path = integrate(|s, y| self.rod.rates(s, y, 0.0), start, 0.0, self.rod.length, STEPS);
        State::from_array(&path[STEPS].1)
    }

    fn misfit(&self, fraction: f64, unknown: &[f64; N]) -> DVector<f64> {
        DVector::from_row_slice(&(self.misfit)(fraction, unknown, &self.end(fraction, unknown)))
    }

    /// The unknown numbers, led from zero in equal steps. None: Newton's method does not get there.
    pub fn solve(&self, steps: usize) -> Option<[f64; N]> {
        let (mut now, mut before) = ([0.0; N], [0.0; N]);
        for step in 1..=steps {
            let ahead: [f64; N] = std::array::from_fn(|i| 2.0 * now[i] - before[i]);
            before = now;
            now = self.newton(step as f64 / steps as f64, if step > 1 { ahead } else { now })?;
        }
        Some(now)
    }

    fn newton(&self, fraction: f64, guess: [f64; N]) -> Option<[f64; N]> {
        let mut unknown = DVector::from_row_slice(&guess);
        let mut last = f64::INFINITY;
        for _ in 0..40 {
            let at = |vector: &DVector<f64>| self.misfit(fraction, &std::array::from_fn(|i| vector[i]));
            let mut jacobian = DMatrix::<f64>::zeros(N, N);
            for column in 0..N {
                let step = 1e-5 * unknown[column].abs().max(1.0);
                let mut moved = [unknown.clone(), unknown.clone()];
                moved[0][column] += step;
                moved[1][column] -= step;
                jacobian.set_column(column, &((at(&moved[0]) - at(&moved[1])) / (2.0 * step)));
            }
            let change = jacobian.lu().solve(&at(&unknown))?;
            unknown -= &change;
            let size = change.amax() / unknown.amax().max(1.0);
            // The differences make the last steps linear, but each far smaller than the one before.
            if size < 1e-11 && size > 0.1 * last || size < 1e-14 {
                return Some(std::array::from_fn(|i| unknown[i]));
            }
            last = size;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use flexura_spatial::{Pose, Vector3, Wrench};

    #[test]
    fn a_straight_rod_bent_by_a_moment_becomes_an_arc() {
        let rod = Rod::uniform(1.0, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], Vector3::zeros());
        let start = |_: f64, x: &[f64; 6]| {
            State::new(
                &Pose::identity(),
                &Wrench::new(Vector3::new(x[0], x[1], x[2]), Vector3::new(x[3], x[4], x[5])),
            )
        };
        let misfit = |fraction: f64, _: &[f64; 6], end: &State| {
            [end.force.x, end.force.y, end.force.z, end.moment.x, end.moment.y - 2.0 * fraction, end.moment.z]
        };
        let shooting = Shooting { rod: &rod, start: &start, misfit: &misfit };
        let found = shooting.solve(4).expect("it converges");
        let end = shooting.end(1.0, &found);
        assert_close(end.position.x, 2f64.sin() / 2.0, 1e-12, "x");
        assert_close(end.position.z, (2f64.cos() - 1.0) / 2.0, 1e-12, "z");
    }
}
