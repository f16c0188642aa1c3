//! Several equilibria of one model under the full load.
//!
//! From rest the mechanism is pushed by random wrenches on all its nodes (every beam has one in its middle) and
//! creeps under load and push through a viscous medium until it stands, snaps included; then the push is taken away and it
//! creeps again. That is how a hand would find the other shape of a switch. From the states on the way, Newton's
//! method that keeps away from what is known (deflation) looks for more, unstable ones among them. None of this
//! proves that there are no others.

use crate::solve::{Prepared, tangent_targets};
use crate::{Options, Outcome};
use flexura_equilibrium::ProblemError;
use flexura_model::{At, BeamId, BeamPoint, Model};
use flexura_nonlinear::{NewtonEnd, NewtonOptions, PathWork, System, converge, converge_deflated};
use flexura_solution::{Solution, Status};
use flexura_spatial::Vector3;

/// Strongest push, in EI/L² and EI/L of the beams at a node; the pushes are spread over the orders below it: a truss of
/// hinged beams withstands far more than EI/L².
const STRONGEST: f64 = 1e4;
const ORDERS: f64 = 4.0;
/// Way of the nodes, in L or radians, between states from which Newton's method starts.
const APART: f64 = 0.25;
/// Most steps of one creeping motion.
const CREEPS: usize = 300;
/// Two equilibria are the same where all positions agree to this part of L and all turnings to as many radians.
const SAME: f64 = 1e-6;

/// Numbers that look random and repeat (Sebastiano Vigna's splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Evenly spread in the unit ball.
    fn ball(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::new(2.0 * self.next() - 1.0, 2.0 * self.next() - 1.0, 2.0 * self.next() - 1.0);
            if v.norm() <= 1.0 {
                return v;
            }
        }
    }
}

/// Looks for distinct equilibria under the full load from `guesses` random pushes, besides the one reached from rest,
/// which comes first; the others follow by energy. The same `seed` gives the same answers.
///
/// # Errors
/// A model that describes no solvable mechanism.
pub fn equilibria(
    model: &Model,
    options: &Options,
    guesses: usize,
    seed: u64,
) -> Result<Vec<Solution>, ProblemError> {
    let middle = |i| BeamPoint { beam: BeamId(i), at: At::Fraction(0.5) };
    let probes: Vec<BeamPoint> = (0..model.beams.len()).map(middle).collect();
    let mut prepared = Prepared::with_probes(model, &probes)?;
    prepared.heed(&options.interrupt);
    let mut found: Vec<Solution> = Vec::new();
    let first = prepared.solve(options.tolerance, &mut |_| {});
    keep(&mut prepared, &first, options, &mut found);
    let mut random = Random(seed);
    for _ in 0..guesses {
        if options.interrupt.is_raised() {
            break;
        }
        let strengths = prepared.problem.node_strengths();
        let size = STRONGEST * 10.0_f64.powf(-ORDERS * random.next());
        let kick: Vec<_> =
            strengths.iter().map(|[f, m]| [random.ball() * *m * size, random.ball() * *f * size]).collect();
        prepared.problem.rest();
        prepared.problem.set_kick(kick, 1.0);
        prepared.problem.set_load(1.0);
        let mut starts = Vec::new();
        if creep(&mut prepared, &mut starts) {
            prepared.problem.set_kick(Vec::new(), 0.0);
            if creep(&mut prepared, &mut starts) {
                let outcome = prepared.finish(options.tolerance, PathWork::default(), f64::INFINITY);
                keep(&mut prepared, &outcome, options, &mut found);
            }
        }
        for start in starts {
            deflate(start, options, &mut found);
        }
        prepared.problem.set_kick(Vec::new(), 0.0);
    }
    if let Some((_, others)) = found.split_first_mut() {
        others.sort_by(|a, b| a.energy.total_cmp(&b.energy));
    }
    Ok(found)
}

/// Newton's method from a state, kept away from what is found.
fn deflate(mut start: Prepared, options: &Options, found: &mut Vec<Solution>) {
    start.problem.set_kick(Vec::new(), 0.0);
    start.problem.set_load(1.0);
    let known: Vec<Vec<f64>> = found.iter().map(|solution| start.state_of(solution)).collect();
    let newton = NewtonOptions { tolerance: 1e-6, iterations: 80, nearest: f64::INFINITY };
    if let NewtonEnd::Converged { .. } = converge_deflated(&mut start.problem, &known, &newton) {
        let outcome = start.finish(options.tolerance, PathWork::default(), f64::INFINITY);
        keep(&mut start, &outcome, options, found);
    }
}

/// Implicit Euler steps of a motion without mass through a viscous medium: balance = drag × speed. The steps grow as
/// the mechanism comes to rest. States on the way are put beside.
fn creep(prepared: &mut Prepared, passed: &mut Vec<Prepared>) -> bool {
    let own = prepared.clone();
    let problem = &mut prepared.problem;
    let mut gone = 0.0;
    let newton = NewtonOptions { tolerance: 1e-6, iterations: 12, nearest: f64::INFINITY };
    let mut strength = 30.0;
    let mut kept = Vec::new();
    let mut arrived = false;
    for _ in 0..CREEPS {
        problem.store(&mut kept);
        problem.set_drag(strength);
        match converge(problem, &newton) {
            NewtonEnd::Converged { .. } if problem.dragged() < 0.7 => {
                if problem.dragged() < 1e-3 && strength < 1.0 {
                    arrived = true;
                    break;
                }
                if problem.dragged() < 0.2 {
                    strength = (0.5 * strength).max(0.02);
                }
                gone += problem.dragged();
                problem.renew();
                if gone > APART {
                    gone = 0.0;
                    let mut here = Prepared { problem: problem.clone(), ..own.clone() };
                    here.problem.set_drag(0.0);
                    passed.push(here);
                }
            }
            _ => {
                problem.restore(&kept);
                strength *= 4.0;
                if strength > 1e7 {
                    break;
                }
            }
        }
    }
    problem.set_drag(0.0);
    arrived
}

/// Keeps a converged state if it is none of those found before.
fn keep(prepared: &mut Prepared, outcome: &Outcome, options: &Options, found: &mut Vec<Solution>) {
    if outcome.status != Status::Converged && !found.is_empty() {
        return;
    }
    let mut solution = prepared.solution(outcome, options.samples);
    if found.iter().any(|other| same(other, &solution)) {
        return;
    }
    if outcome.status == Status::Converged && !tangent_targets(prepared.model()).is_empty() {
        prepared.add_tangents(&mut solution, &[]);
    }
    found.push(solution);
}

pub(crate) fn same(a: &Solution, b: &Solution) -> bool {
    let length = a.beams.iter().map(|beam| beam.length).fold(0.0, f64::max);
    let size = if length > 0.0 { length } else { 1.0 };
    let near = |p: &flexura_spatial::Pose, q: &flexura_spatial::Pose| {
        (p.position - q.position).norm() < SAME * size && p.rotation.angle_to(&q.rotation) < SAME
    };
    let beams = a.beams.iter().zip(&b.beams).all(|(x, y)| {
        x.samples.len() == y.samples.len()
            && x.samples.iter().zip(&y.samples).all(|(p, q)| near(&p.pose, &q.pose))
    });
    beams && a.bodies.iter().zip(&b.bodies).all(|(p, q)| near(p, q))
}

impl Prepared {
    /// The state of this problem, in its present layout, at a solution.
    fn state_of(&self, solution: &Solution) -> Vec<f64> {
        let mut other = self.problem.clone();
        other.stand_on_same_mesh(solution);
        let mut state = Vec::new();
        other.store(&mut state);
        state
    }
}
