use crate::*;
use flexura_nonlinear::{Breakdown, Dense, Lift, Liftable, System};

type Law = fn(&[f64], [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>);

/// A small dense system, with the number of negative eigenvalues of its (symmetric) tangent as index.
struct Small {
    law: Law,
    x: Vec<f64>,
    parameters: [f64; 2],
    r: Vec<f64>,
    dense: Dense,
    lift: Option<Lift>,
    lifted: f64,
    symmetric: bool,
}

impl Small {
    fn new(law: Law, x: &[f64], p: f64, q: f64) -> Self {
        Self {
            law,
            x: x.to_vec(),
            parameters: [p, q],
            r: vec![0.0; x.len()],
            dense: Dense::default(),
            lift: None,
            lifted: 0.0,
            symmetric: true,
        }
    }

    /// With the steps that a curve of unit size wants.
    fn walk(&mut self, direction: f64) -> Walker {
        let options = WalkOptions { largest_parameter: 0.1, largest_change: 0.1, ..WalkOptions::default() };
        Walker::start(self, options, direction).unwrap()
    }
}

impl System for Small {
    fn unknowns(&self) -> usize {
        self.x.len()
    }
    fn set_load(&mut self, _: f64) {}
    fn residual(&mut self) -> Result<(), Breakdown> {
        self.r = (self.law)(&self.x, self.parameters).0;
        if self.r.iter().all(|v| v.is_finite()) { Ok(()) } else { Err(Breakdown::NotFinite) }
    }
    fn linearise(&mut self) -> Result<(), Breakdown> {
        let (r, j) = (self.law)(&self.x, self.parameters);
        self.r = r;
        self.dense.reset(self.x.len());
        for (i, row) in j.iter().enumerate() {
            self.dense.row_mut(i).copy_from_slice(row);
        }
        self.lifted = 0.0;
        if let Some(lift) = self.lift {
            self.lifted = 1.0;
            self.dense.add(lift.row, lift.column, 1.0);
        }
        self.dense.factorise()
    }
    fn orientation(&self) -> bool {
        self.dense.is_positive()
    }
    fn newton_step(&mut self, step: &mut [f64]) {
        step.iter_mut().zip(&self.r).for_each(|(s, r)| *s = -r);
        self.dense.solve(step);
    }
    fn keep_tangent(&mut self) {}
    fn kept_step(&mut self, _: &mut [f64]) {}
    fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }
    fn retract(&mut self, step: &[f64]) {
        self.x.iter_mut().zip(step).for_each(|(x, s)| *x += s);
    }
    fn size(&self, step: &[f64]) -> f64 {
        step.iter().fold(0.0, |m, v| m.max(v.abs()))
    }
    fn turning(&self, _: &[f64]) -> f64 {
        0.0
    }
    fn store(&self, state: &mut Vec<f64>) {
        state.clone_from(&self.x);
    }
    fn restore(&mut self, state: &[f64]) {
        self.x.copy_from_slice(state);
    }
    fn difference(&self, from: &[f64], to: &[f64], step: &mut [f64]) {
        for ((s, a), b) in step.iter_mut().zip(from).zip(to) {
            *s = b - a;
        }
    }
    fn expect(&mut self, _: &[f64]) {}
    fn phase(&self, _: f64) -> f64 {
        0.0
    }
    fn renew(&mut self) -> bool {
        false
    }
}

impl Liftable for Small {
    fn lift_rows(&self) -> Vec<usize> {
        (0..self.x.len()).collect()
    }
    fn lift_columns(&self) -> usize {
        self.x.len()
    }
    fn set_lift(&mut self, lift: Option<Lift>) {
        self.lift = lift;
    }
    fn lifted_by(&self) -> f64 {
        self.lifted
    }
    fn unit_step(&mut self, row: usize, step: &mut [f64]) {
        step.fill(0.0);
        step[row] = 1.0;
        self.dense.solve(step);
    }
    fn inverse_step(&mut self, x: &[f64], step: &mut [f64]) {
        step.copy_from_slice(x);
        self.dense.solve(step);
    }
}

impl Problem for Small {
    type System = Self;
    fn system(&mut self) -> &mut Self {
        self
    }
    fn parameters(&self) -> Parameters {
        self.parameters
    }
    fn set_parameters(&mut self, values: Parameters) -> Result<(), Refusal> {
        if values[0].abs() > 50.0 {
            return Err(Refusal::Parameter("beyond fifty".into()));
        }
        self.parameters = values;
        Ok(())
    }
    fn index(&mut self) -> Option<usize> {
        if !self.symmetric {
            return None;
        }
        // Sylvester: signs of the pivots without exchanges.
        let (_, mut j) = (self.law)(&self.x, self.parameters);
        let n = j.len();
        let mut negative = 0;
        for k in 0..n {
            if j[k][k] < 0.0 {
                negative += 1;
            }
            for i in k + 1..n {
                let factor = j[i][k] / j[k][k];
                for l in k..n {
                    let top = j[k][l];
                    j[i][l] -= factor * top;
                }
            }
        }
        Some(negative)
    }
}

/// Walks until `steps` or a stall; special points with the parameter and state where they lie.
fn specials(problem: &mut Small, walker: &mut Walker, steps: usize) -> Vec<Special> {
    let mut all = Vec::new();
    for _ in 0..steps {
        match walker.advance(problem) {
            Advance::To(found) => all.extend(found),
            Advance::Stalled(_) => break,
        }
    }
    all
}

/// x³ - 3x - p, folds at x = ±1, p = ∓2.
fn s_curve(x: &[f64], [p, _]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
    (vec![x[0].powi(3) - 3.0 * x[0] - p], vec![vec![3.0 * x[0] * x[0] - 3.0]])
}

#[test]
fn both_folds_of_an_s_curve_are_passed_and_located() {
    let mut problem = Small::new(s_curve, &[-2.5], (-2.5_f64).powi(3) + 7.5, 0.0);
    let mut walker = problem.walk(1.0);
    let found = specials(&mut problem, &mut walker, 260);
    assert_eq!(found.len(), 2);
    for (special, [x, p]) in found.iter().zip([[-1.0, 2.0], [1.0, -2.0]]) {
        assert_eq!(special.crossing, None);
        assert!((special.point.state[0] - x).abs() < 1e-10, "{:?}", special.point);
        assert!((special.point.parameters[0] - p).abs() < 1e-12);
    }
    assert!(walker.here().point.state[0] > 2.0 && walker.here().index == Some(0));
}

/// The energy p x²/2 - x⁴/4 · s, beside a stiff unknown: p x - s x³.
fn supercritical(x: &[f64], [p, q]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (a, b) = (x[0], x[1]);
    (vec![-p * a + a.powi(3) + q, 2.0 * b - p], vec![vec![-p + 3.0 * a * a, 0.0], vec![0.0, 2.0]])
}

fn subcritical(x: &[f64], [p, _]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (a, b) = (x[0], x[1]);
    (vec![-p * a - a.powi(3), 2.0 * b - p], vec![vec![-p - 3.0 * a * a, 0.0], vec![0.0, 2.0]])
}

#[test]
fn pitchforks_are_told_apart_and_both_arms_are_reached() {
    let laws: [(Law, Crossing); 2] =
        [(supercritical, Crossing::SupercriticalPitchfork), (subcritical, Crossing::SubcriticalPitchfork)];
    for (law, wanted) in laws {
        let mut problem = Small::new(law, &[0.0, -0.5], -1.0, 0.0);
        let mut walker = problem.walk(1.0);
        let found = specials(&mut problem, &mut walker, 30);
        assert_eq!(found.len(), 1);
        let special = &found[0];
        assert_eq!(special.crossing, Some(wanted));
        assert!(special.point.parameters[0].abs() < 1e-10 && special.point.state[0].abs() < 1e-10);
        assert_eq!(special.branches.len(), 1);
        // The path itself has gone straight on, on the axis of symmetry.
        assert!(walker.here().point.state[0].abs() < 1e-12 && walker.here().index == Some(1));
        for sense in [1.0, -1.0] {
            let options = WalkOptions::default();
            let mut arm = Walker::switch(
                &mut problem,
                options,
                &special.point,
                &special.branches[0].clone().into(),
                sense,
            )
            .unwrap();
            assert!(specials(&mut problem, &mut arm, 10).is_empty());
            let Place { point, index, .. } = arm.here();
            let (x, p) = (point.state[0], point.parameters[0]);
            assert!(x.abs() > 0.1 && (p.abs() - x * x).abs() < 1e-9);
            assert_eq!(*index, Some(if wanted == Crossing::SupercriticalPitchfork { 0 } else { 1 }));
        }
    }
}

/// x (x - p) in the first unknown.
fn transcritical(x: &[f64], [p, _]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (a, b) = (x[0], x[1]);
    (vec![a * (a - 0.5 * p), b - a], vec![vec![2.0 * a - 0.5 * p, 0.0], vec![-1.0, 1.0]])
}

#[test]
fn two_branches_that_cross_without_turning_back_are_transcritical() {
    let mut problem = Small::new(transcritical, &[0.0, 0.0], -1.0, 0.0);
    problem.symmetric = false;
    let mut walker = problem.walk(1.0);
    let found = specials(&mut problem, &mut walker, 30);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].crossing, Some(Crossing::Transcritical));
    let options = WalkOptions::default();
    let mut other =
        Walker::switch(&mut problem, options, &found[0].point, &found[0].branches[0].clone().into(), 1.0)
            .unwrap();
    specials(&mut problem, &mut other, 10);
    let point = &other.here().point;
    assert!(point.state[0].abs() > 0.05 && (point.state[0] - 0.5 * point.parameters[0]).abs() < 1e-9);
}

/// Two unknowns that become critical together, and slightly apart where q is not zero.
fn double(x: &[f64], [p, q]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let square = x[0] * x[0] + x[1] * x[1];
    (
        vec![(1.0 - p * p + square) * x[0], (1.0 - p * p + q + square) * x[1], x[2] - p],
        vec![
            vec![1.0 - p * p + square + 2.0 * x[0] * x[0], 2.0 * x[0] * x[1], 0.0],
            vec![2.0 * x[0] * x[1], 1.0 - p * p + q + square + 2.0 * x[1] * x[1], 0.0],
            vec![0.0, 0.0, 1.0],
        ],
    )
}

#[test]
fn directions_that_become_critical_together_are_one_point_and_neighbours_are_two() {
    let mut problem = Small::new(double, &[0.0, 0.0, 0.0], 0.0, 0.0);
    let mut walker = problem.walk(1.0);
    let found = specials(&mut problem, &mut walker, 30);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].crossing, Some(Crossing::Multiple(2)));
    assert!((found[0].point.parameters[0] - 1.0).abs() < 1e-10, "{:?}", found[0].point);
    assert_eq!(found[0].kernel.len(), 2);
    assert!(found[0].kernel.iter().all(|k| k[2].abs() < 1e-6));

    let mut problem = Small::new(double, &[0.0, 0.0, 0.0], 0.0, 0.01);
    let mut walker = problem.walk(1.0);
    let found = specials(&mut problem, &mut walker, 60);
    assert_eq!(found.len(), 2);
    assert!((found[1].point.parameters[0] - 1.01_f64.sqrt()).abs() < 1e-10);
}

#[test]
fn an_imperfect_pitchfork_is_no_branch_point() {
    let q = 1e-4;
    let mut problem = Small::new(supercritical, &[0.0, -0.5], -1.0, q);
    // On the branch with p x = x³ + q.
    problem.x[0] = -q;
    for _ in 0..5 {
        problem.linearise().unwrap();
        let mut step = vec![0.0; 2];
        problem.newton_step(&mut step);
        problem.retract(&step);
    }
    let mut walker = problem.walk(1.0);
    assert!(specials(&mut problem, &mut walker, 60).is_empty());
    let point = &walker.here().point;
    assert!(point.state[0] < -0.5 && point.parameters[0] > 0.3);
}

/// A circle: x² + p² = 1.
fn circle(x: &[f64], [p, _]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
    (vec![x[0] * x[0] + p * p - 1.0], vec![vec![2.0 * x[0]]])
}

#[test]
fn a_closed_loop_comes_back_to_its_start() {
    let mut problem = Small::new(circle, &[0.6], 0.8, 0.0);
    problem.symmetric = false;
    let mut walker = problem.walk(-1.0);
    let start = walker.here().clone();
    let mut folds = 0;
    for step in 0..200 {
        let Advance::To(found) = walker.advance(&mut problem) else { panic!("stalled") };
        folds += found.len();
        if step > 3 && walker.passes(&mut problem, &start.point, &start.tangent) {
            assert_eq!(folds, 2);
            assert!((walker.here().arc - 2.0 * std::f64::consts::PI).abs() < 0.3);
            return;
        }
    }
    panic!("the loop was not seen");
}

#[test]
fn points_between_and_at_a_value_lie_on_the_path() {
    let mut problem = Small::new(s_curve, &[-2.5], (-2.5_f64).powi(3) + 7.5, 0.0);
    let mut walker = problem.walk(1.0);
    specials(&mut problem, &mut walker, 5);
    let (before, p) = (walker.here().point.clone(), walker.here().point.parameters[0]);
    walker.advance(&mut problem);
    let value = 0.3 * p + 0.7 * walker.here().point.parameters[0];
    let place = walker.at_parameter(&mut problem, value).unwrap();
    assert_eq!(place.point.parameters[0], value);
    let x = place.point.state[0];
    assert!((x.powi(3) - 3.0 * x - value).abs() < 1e-9 && x > before.state[0]);
    let middle = walker.between(&mut problem, 0.5).unwrap();
    let x = middle.point.state[0];
    assert!((x.powi(3) - 3.0 * x - middle.point.parameters[0]).abs() < 1e-9);
}

#[test]
fn folds_are_followed_along_the_cusp() {
    // x³ - p x + q: folds at q² = 4 p³/27.
    fn cusp(x: &[f64], [p, q]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let a = x[0];
        (vec![a.powi(3) - q * a + p, x[1] - a], vec![vec![3.0 * a * a - q, 0.0], vec![-1.0, 1.0]])
    }
    let mut problem = Small::new(cusp, &[-1.5, -1.5], 1.5_f64.powi(3) - 1.5, 1.0);
    problem.symmetric = false;
    let mut walker = problem.walk(-1.0);
    let found = specials(&mut problem, &mut walker, 60);
    assert_eq!(found.len(), 2);
    let mut curve = CriticalWalker::start(&mut problem, &found[0].point, true, 0.1, -1.0).unwrap();
    let mut count = 0;
    while curve.point().parameters[1] < 1.0 + 1e-9 || count < 5 {
        curve.advance(&mut problem).unwrap();
        let [p, q] = curve.point().parameters;
        assert!((p * p - 4.0 * q.powi(3) / 27.0).abs() < 1e-10, "{p} {q}");
        count += 1;
        assert!(count < 100);
    }
    // Through the cusp and back on the other fold.
    assert!(curve.point().parameters[0] * found[0].point.parameters[0] < 0.0);
    let from = curve.clone();
    curve.advance(&mut problem).unwrap();
    let [_, q] = curve.point().parameters;
    let wanted = 0.5 * (q + from.point().parameters[1]);
    let there = curve.at_second(&mut problem, &from, wanted).unwrap();
    assert!((there.point().parameters[1] - wanted).abs() < 1e-11);
}

#[test]
fn branch_points_are_followed_in_a_second_parameter() {
    // (p - q²) x - x³: a pitchfork at p = q².
    fn shifted(x: &[f64], [p, q]: [f64; 2]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let (a, b) = (x[0], x[1]);
        (vec![(q * q - p) * a + a.powi(3), b - p], vec![vec![q * q - p + 3.0 * a * a, 0.0], vec![0.0, 1.0]])
    }
    let mut problem = Small::new(shifted, &[0.0, -1.0], -1.0, 0.2);
    let mut walker = problem.walk(1.0);
    let found = specials(&mut problem, &mut walker, 30);
    assert_eq!(found.len(), 1);
    let mut curve = CriticalWalker::start(&mut problem, &found[0].point, false, 0.1, 1.0).unwrap();
    for _ in 0..10 {
        curve.advance(&mut problem).unwrap();
        let [p, q] = curve.point().parameters;
        assert!((p - q * q).abs() < 1e-10);
    }
    assert!(curve.point().parameters[1] > 0.5);
}

#[test]
fn a_parameter_that_ends_says_why() {
    let mut problem = Small::new(|x, [p, _]| (vec![x[0] - p], vec![vec![1.0]]), &[49.0], 49.0, 0.0);
    let mut walker = problem.walk(1.0);
    for _ in 0..200 {
        if let Advance::Stalled(stall) = walker.advance(&mut problem) {
            assert_eq!(stall, Stall::Parameter("beyond fifty".into()));
            return;
        }
    }
    panic!("it must end");
}
