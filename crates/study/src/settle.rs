//! Mechanisms that do not stand on their own stiffness.
//!
//! What only its loads will hold (a pendulum, a weight on a slack tendon, springs in line) has no tangent at rest to start from. It is
//! given a small part of its load and creeps through a viscous medium until it stands: with the poses x_k of the nodes and
//! the coordinates q_k as anchors, balance = κ (x - x_k) is solved again and again while κ goes to nothing, which is implicit
//! Euler of a motion without mass. Where it stands unstably it is pushed a little. From there the load grows as always.
//!
//! What is so stiff that forces in it cannot be told apart at rest (straight beams side by side that do not stretch) is first let
//! stretch, led to the full load, and then stiffened again: under load the beams have bent, and their bending tells.

use crate::ending::Ending;
use crate::way::Way;
use flexura_equilibrium::{Equilibrium, Footing, ProblemError, Stability};
use flexura_nonlinear::{NewtonEnd, NewtonOptions, PathBlock, PathEnd, PathOptions, System, converge};

/// Parts of the load under which a mechanism is let go, one after another until it stands.
const LOADS: [f64; 3] = [1e-3, 3e-2, 1.0];
/// Most steps of a creeping motion, and the way (L) after which it counts as going away for good.
const CREEPS: usize = 250;
const AWAY: f64 = 200.0;
/// Largest way of a step, in L or radians; the way below which the drag is taken back, and by how much.
const LONGEST: f64 = 0.5;
const SHORT: f64 = 0.1;
const EASED: f64 = 0.2;
/// Way of a step from which the drag is left out altogether, to see whether it stands.
const NEAR: f64 = 0.05;
/// By how much what stands unstably is pushed, in L or radians, and how often.
const PUSH: f64 = 1e-2;
const PUSHES: i32 = 4;
/// Way (L or radians) after which it has left where it stood unstably.
const FALLEN: f64 = 0.3;
/// Compliance in stretching that is lent: EI/L² stretches a beam by this part of its length.
const SOFT: f64 = 1e-3;
/// Steps after which a path that has not come to the first of these counts as slow.
const PATIENCE: usize = 25;
/// Parts of the load under which it is taken back.
const SOFT_LOADS: [f64; 3] = [2e-2, 0.1, 1.0];
/// What is left of it at each step back, and the compliance that is as good as none.
const STIFFER: f64 = 0.1;
const NOTHING: f64 = 1e-13;

const CREEPING: NewtonOptions = NewtonOptions { tolerance: 1e-8, iterations: 20, nearest: f64::INFINITY };

/// To the full load, for a mechanism that does not stand firmly at rest.
///
/// # Errors
/// What ended the way.
pub(crate) fn go(way: &mut Way<'_>, footing: &Footing) -> Result<(), Ending> {
    let error = match footing {
        Footing::Firm => return firm(way),
        Footing::Mobile(error) | Footing::Stiff(error) => error,
    };
    let mut ended = None;
    way.problem.rest();
    if matches!(footing, Footing::Mobile(_)) {
        for load in LOADS {
            if !creep(way.problem, load) {
                continue;
            }
            if load == 1.0 {
                return Ok(());
            }
            match way.go(load) {
                Ok(()) => return Ok(()),
                Err(ending) => ended = Some(ending),
            }
        }
    }
    if way.problem.has_beams() {
        match softened(way, matches!(footing, Footing::Mobile(_))) {
            Ok(load) => return way.go(load),
            Err(why) => ended = ended.or(why),
        }
    }
    Err(ended.unwrap_or_else(|| Ending::NoStart(tried(way.problem, error))))
}

/// To the full load from firm rest. Where beams that hardly stretch make the first steps tiny, their stretching is softened for
/// these.
fn firm(way: &mut Way<'_>) -> Result<(), Ending> {
    if !way.problem.has_closed_spans() {
        return way.go(0.0);
    }
    let options = PathOptions { patience: PATIENCE, least_growth: SOFT_LOADS[0], ..way.options };
    match way.follow(0.0, &options) {
        PathEnd::Complete => Ok(()),
        PathEnd::Blocked { by: PathBlock::Slow, load } if load < SOFT_LOADS[0] => {
            match softened(way, false) {
                Ok(load) => way.go(load),
                Err(_) => way.go(0.0),
            }
        }
        PathEnd::Blocked { by: PathBlock::Slow, load } => way.go(load),
        end => way.go_on(0.0, end),
    }
}

/// Does it come to rest somewhere, or has it at least stiffness on its way?
pub(crate) fn stands(way: &mut Way<'_>, footing: &Footing) -> Result<(), ProblemError> {
    match go(way, footing) {
        Err(Ending::NoStart(error)) => Err(error),
        // It started; what ended its way is for the solve to tell.
        _ => Ok(()),
    }
}

/// What can move, and that its loads do not hold it either.
fn tried(problem: &mut Equilibrium, error: &ProblemError) -> ProblemError {
    problem.rest();
    problem.set_load(1.0);
    problem.nudge(PUSH);
    // What is loose beside its place, under its loads too, is plainly loose.
    let resists = problem.loose_here().is_none();
    problem.rest();
    let mut error = error.clone();
    if resists {
        error.message += "; nor do its loads hold it: let go under them, pushed a little and led through a damped motion, it \
                          found no equilibrium";
    }
    error
}

/// Lets the mechanism go from rest under a part of its load until it stands; false where it does not.
fn creep(problem: &mut Equilibrium, load: f64) -> bool {
    problem.rest();
    problem.set_load(load);
    let Ok(force) = problem.unbalance() else { return false };
    let mut strength = (force / SHORT).max(1e-6);
    let most = 1e12 * strength;
    let mut kept = Vec::new();
    let mut pushes = 0;
    let (mut least, mut fallen) = (0.0, 0.0);
    let mut stood = false;
    for _ in 0..CREEPS {
        if problem.is_exhausted() || problem.gone() > AWAY {
            break;
        }
        problem.store(&mut kept);
        problem.set_whole_drag(strength);
        let converged = matches!(converge(problem, &CREEPING), NewtonEnd::Converged { .. });
        let way = problem.dragged();
        problem.set_whole_drag(0.0);
        if !converged || way > LONGEST {
            problem.restore(&kept);
            strength *= 4.0;
            if strength > most {
                break;
            }
            continue;
        }
        problem.renew();
        if way < NEAR && (pushes == 0 || fallen > FALLEN) && stand(problem) {
            if is_stable(problem) {
                stood = true;
                break;
            }
            pushes += 1;
            if pushes > PUSHES {
                break;
            }
            problem.nudge(PUSH);
            // With a drag below what drives it away, a step would lead back to where it stands unstably.
            (least, fallen) = (force * 2.0_f64.powi(pushes), 0.0);
            strength = (force / SHORT).max(least).max(1e-6);
        } else {
            fallen += way;
            let least = if fallen > FALLEN { 0.0 } else { least };
            let eased = if way < SHORT { EASED * strength } else { strength };
            strength = eased.max(least);
        }
    }
    problem.set_whole_drag(0.0);
    stood
}

/// Newton's method without drag from where it creeps; true where that leads to an equilibrium near.
fn stand(problem: &mut Equilibrium) -> bool {
    let mut here = Vec::new();
    problem.store(&mut here);
    let converged = matches!(converge(problem, &CREEPING), NewtonEnd::Converged { .. });
    let mut there = Vec::new();
    problem.store(&mut there);
    let mut step = vec![0.0; problem.unknowns()];
    problem.difference(&here, &there, &mut step);
    if converged && problem.moved_by(&step) < LONGEST && problem.linearise().is_ok() {
        return true;
    }
    problem.restore(&here);
    false
}

/// Is the present equilibrium stable, as far as that is decided?
fn is_stable(problem: &mut Equilibrium) -> bool {
    match problem.stability() {
        Ok(Stability::Unstable(count)) => count == 0,
        Ok(Stability::Undecided(_)) => true,
        Err(_) => false,
    }
}

/// Under a part of the load, with beams that are let stretch and then are what they are again; the load from which the way
/// goes on.
///
/// # Errors
/// What ended it, if that is known.
fn softened(way: &mut Way<'_>, moves: bool) -> Result<f64, Option<Ending>> {
    for load in SOFT_LOADS {
        way.problem.rest();
        way.problem.soften(SOFT);
        let stands = if moves { creep(way.problem, load) } else { step_to(way.problem, load) };
        if stands && stiffened(way.problem) {
            return Ok(load);
        }
        way.problem.soften(0.0);
        if way.problem.is_boundless() {
            return Err(Some(Ending::Unreachable { load: 0.0, force: way.problem.largest_force() }));
        }
    }
    way.problem.rest();
    Err(None)
}

/// From rest to a small load at once, or by creeping where that fails.
fn step_to(problem: &mut Equilibrium, load: f64) -> bool {
    problem.set_load(load);
    (stand(problem) && is_stable(problem)) || creep(problem, load)
}

/// Takes back the compliance that was lent, at the present load.
fn stiffened(problem: &mut Equilibrium) -> bool {
    let newton = NewtonOptions { tolerance: 1e-7, iterations: 30, nearest: f64::INFINITY };
    let (mut compliance, mut part) = (SOFT, STIFFER);
    let mut kept = Vec::new();
    for _ in 0..100 {
        problem.store(&mut kept);
        let next = if compliance * part < NOTHING { 0.0 } else { compliance * part };
        problem.soften(next);
        if matches!(converge(problem, &newton), NewtonEnd::Converged { .. }) {
            if problem.is_boundless() {
                return false;
            }
            problem.renew();
            if next == 0.0 {
                return !matches!(problem.stability(), Ok(Stability::Unstable(1..)));
            }
            compliance = next;
            part = (part * part).max(1e-3);
        } else {
            problem.restore(&kept);
            part = part.sqrt();
            if part > 0.99 || problem.is_exhausted() {
                return false;
            }
        }
    }
    false
}
