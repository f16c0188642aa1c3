use super::*;
use crate::{Breakdown, NewtonEnd, NewtonOptions, converge};

/// One unknown: r = f(x) - λ b.
struct Scalar {
    x: f64,
    load: f64,
    goal: f64,
    f: fn(f64) -> (f64, f64),
    r: f64,
    slope: f64,
    kept: f64,
}

impl Scalar {
    fn new(goal: f64, f: fn(f64) -> (f64, f64)) -> Self {
        Self { x: 0.0, load: 0.0, goal, f, r: 0.0, slope: 1.0, kept: 1.0 }
    }
}

impl System for Scalar {
    fn unknowns(&self) -> usize {
        1
    }
    fn set_load(&mut self, fraction: f64) {
        self.load = fraction;
    }
    fn residual(&mut self) -> Result<(), Breakdown> {
        self.r = (self.f)(self.x).0 - self.load * self.goal;
        if self.r.is_finite() { Ok(()) } else { Err(Breakdown::NotFinite) }
    }
    fn linearise(&mut self) -> Result<(), Breakdown> {
        self.slope = (self.f)(self.x).1;
        self.residual()?;
        if self.slope == 0.0 { Err(Breakdown::Singular) } else { Ok(()) }
    }
    fn orientation(&self) -> bool {
        self.slope > 0.0
    }
    fn newton_step(&mut self, step: &mut [f64]) {
        step[0] = -self.r / self.slope;
    }
    fn keep_tangent(&mut self) {
        self.kept = self.slope;
    }
    fn kept_step(&mut self, step: &mut [f64]) {
        step[0] = -self.r / self.kept;
    }
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
        state.clear();
        state.push(self.x);
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
fn newton_shortens_its_step_where_the_full_one_diverges() {
    // The full Newton step for atan diverges from |x| > 1.3917.
    let mut system = Scalar::new(0.0, |x| (x.atan(), 1.0 / (1.0 + x * x)));
    system.x = 20.0;
    let end =
        converge(&mut system, &NewtonOptions { tolerance: 1e-13, iterations: 50, nearest: f64::INFINITY });
    assert!(matches!(end, NewtonEnd::Converged { .. }), "{end:?}");
    assert!(system.x.abs() < 1e-13);
}

#[test]
fn a_path_without_a_fold_reaches_the_full_load() {
    let mut system = Scalar::new(1e4, |x| (x + x * x * x, 1.0 + 3.0 * x * x));
    let (end, _) = follow(&mut system, &PathOptions::default(), &mut |_, _| {});
    assert_eq!(end, PathEnd::Complete);
    assert!((system.x + system.x.powi(3) - 1e4).abs() < 1e-2 * 1e4);
}

#[test]
fn a_path_stops_at_a_fold_and_does_not_jump_over_it() {
    // x - x³/3 folds at x = 1 with f = 2/3; beyond it only the far branch x < -1 solves f = 0.8.
    let mut system = Scalar::new(0.8, |x| (x - x * x * x / 3.0, 1.0 - x * x));
    let options = PathOptions { leaves_crossings: false, ..PathOptions::default() };
    let (end, _) = follow(&mut system, &options, &mut |_, _| {});
    let PathEnd::Blocked { load, .. } = end else { panic!("{end:?}") };
    assert!((load * 0.8 - 2.0 / 3.0).abs() < 1e-4, "stopped at {load}");
    // Points of the path are only as good as `point_tolerance`.
    assert!((system.x - 1.0).abs() < 0.02, "{}", system.x);
}

#[test]
fn a_path_that_starts_at_the_full_load_leaves_the_load_as_it_is() {
    let mut system = Scalar::new(2.0, |x| (x, 1.0));
    (system.x, system.load) = (2.0, 1.0);
    let mut work = PathWork::default();
    let end = follow_on(&mut system, 1.0, &PathOptions::default(), &mut work, &mut |_, _| {});
    assert_eq!((end, system.load, system.x), (PathEnd::Complete, 1.0, 2.0));
}
