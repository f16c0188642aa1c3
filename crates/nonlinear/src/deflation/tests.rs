use super::*;

/// (x² - 1)(x - 4) = 0 with the derivative of the cubic.
struct Cubic {
    x: f64,
    r: f64,
    slope: f64,
}

impl System for Cubic {
    fn unknowns(&self) -> usize {
        1
    }
    fn set_load(&mut self, _: f64) {}
    fn residual(&mut self) -> Result<(), Breakdown> {
        self.r = (self.x * self.x - 1.0) * (self.x - 4.0);
        Ok(())
    }
    fn linearise(&mut self) -> Result<(), Breakdown> {
        self.slope = 3.0 * self.x * self.x - 8.0 * self.x - 1.0;
        self.residual()
    }
    fn orientation(&self) -> bool {
        self.slope > 0.0
    }
    fn newton_step(&mut self, step: &mut [f64]) {
        step[0] = -self.r / self.slope;
    }
    fn keep_tangent(&mut self) {}
    fn kept_step(&mut self, _: &mut [f64]) {}
    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a[0] * b[0]
    }
    fn retract(&mut self, step: &[f64]) {
        self.x += step[0];
    }
    fn size(&self, step: &[f64]) -> f64 {
        step[0].abs()
    }
    fn turning(&self, _: &[f64]) -> f64 {
        0.0
    }
    fn store(&self, state: &mut Vec<f64>) {
        *state = vec![self.x];
    }
    fn restore(&mut self, state: &[f64]) {
        self.x = state[0];
    }
    fn difference(&self, from: &[f64], to: &[f64], step: &mut [f64]) {
        step[0] = to[0] - from[0];
    }
    fn expect(&mut self, _: &[f64]) {}
    fn phase(&self, _: f64) -> f64 {
        0.0
    }
    fn renew(&mut self) -> bool {
        false
    }
}

#[test]
fn the_same_start_leads_to_all_three_roots_one_after_another() {
    let options = NewtonOptions { tolerance: 1e-12, iterations: 300, nearest: f64::INFINITY };
    let mut known: Vec<Vec<f64>> = Vec::new();
    for _ in 0..3 {
        let mut system = Cubic { x: 2.0, r: 0.0, slope: 1.0 };
        let end = converge_deflated(&mut system, &known, &options);
        assert!(matches!(end, NewtonEnd::Converged { .. }), "{end:?} at {}", system.x);
        known.push(vec![system.x]);
    }
    let mut roots: Vec<f64> = known.concat();
    roots.sort_by(f64::total_cmp);
    for (root, expected) in roots.iter().zip([-1.0, 1.0, 4.0]) {
        assert!((root - expected).abs() < 1e-10, "{roots:?}");
    }
}
