//! The tangent with one entry lifted, as `continuation` wants it near critical points.

use crate::system::Equilibrium;
use flexura_nonlinear::{BLOCK, Lift, Liftable, System};

impl Liftable for Equilibrium {
    fn lift_rows(&self) -> Vec<usize> {
        // What stands in the rows of an inner state comes out of the elimination of those before it.
        let inner: Vec<usize> =
            self.layout.spans.iter().filter_map(|s| s.inner.last().map(|i| i.unknown)).collect();
        (0..self.layout.interface)
            .filter(|row| !inner.iter().any(|u| (*u..u + BLOCK).contains(row)))
            .collect()
    }

    fn lift_columns(&self) -> usize {
        self.layout.interface
    }

    fn set_lift(&mut self, lift: Option<Lift>) {
        self.lift = lift;
        self.factorised = false;
    }

    fn lifted_by(&self) -> f64 {
        self.lifted_by
    }

    fn unit_step(&mut self, row: usize, step: &mut [f64]) {
        self.r.fill(0.0);
        self.gaps.iter_mut().flatten().for_each(|gap| *gap = [0.0; BLOCK]);
        self.r[row] = -1.0;
        self.newton_step(step);
        self.counts.newton_steps -= 1;
    }

    fn inverse_step(&mut self, x: &[f64], step: &mut [f64]) {
        self.gaps.iter_mut().flatten().for_each(|gap| *gap = [0.0; BLOCK]);
        for ((r, x), w) in self.r.iter_mut().zip(x).zip(&self.weights) {
            *r = -x * w * w;
        }
        self.newton_step(step);
        self.counts.newton_steps -= 1;
    }
}
