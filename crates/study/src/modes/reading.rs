//! From vectors of the pencil to modes.

use super::{Spectrum, Wave};
use crate::trace::normalise;
use flexura_equilibrium::{Equilibrium, Swing};
use flexura_model::ModesStudy;
use flexura_solution::{Direction, Followed, Mode, ModeKind, Modes, Shares, Solution};
use flexura_spatial::Vector3;
use nalgebra::Complex;

/// Motion of a beam beside the largest of the mode below which it stands still.
const STILL: f64 = 1e-6;
/// Relative error of ω² by the equilibrium's own error: the spectrum goes with its wrenches.
const OF_STATE: f64 = 4.0;
/// Relative error of ω² by round-off, at least.
const ROUND_OFF: f64 = 1e-13;

pub(super) fn read(
    problem: &Equilibrium,
    mut solution: Solution,
    at_rest: bool,
    study: &ModesStudy,
    found: &Spectrum,
) -> Modes {
    let vibration = &found.vibration;
    let each = found.waves.iter().zip(&found.errors);
    let modes: Vec<Mode> = each.map(|(wave, error)| mode(problem, &solution, found, wave, *error)).collect();
    if found.exhausted {
        let count = modes.iter().filter(|mode| !mode.is_rigid()).count();
        solution.warnings.push(format!("{} modes were asked for; there are {count}", study.count));
    }
    remark(&mut solution, &modes, found.has_energy);
    let [a, b, c, d, e, f] = vibration.whole;
    let elements = [vibration.elements, found.order];
    Modes { solution, at_rest, modes, mass: [a, b, c], inertia: [d, e, f], elements }
}

/// A wave with its shape, scaled, and its masses.
fn mode(problem: &Equilibrium, solution: &Solution, found: &Spectrum, wave: &Wave, error: f64) -> Mode {
    let vibration = &found.vibration;
    let [x, aside] = &wave.vector;
    let swing = problem.swing(vibration, x);
    let mut direction = shape(solution, &swing);
    let size = normalise(&mut direction, vibration.length);
    let energy: f64 = vibration.inertia.iter().map(|(i, j, value)| value * x[*i] * x[*j]).sum();
    // x moves by length and turning 1; the shape was divided by its size (m or rad).
    let unit = vibration.mass * vibration.length * vibration.length;
    let generalised_mass = unit * energy / (size * size);
    let participation = std::array::from_fn(|axis| {
        let dot: f64 = vibration.rigid[axis].iter().zip(x).map(|(a, b)| a * b).sum();
        let per = if axis < 3 { vibration.mass * vibration.length } else { unit };
        per * dot / size / generalised_mass
    });
    let effective = participation.map(|share| share * share * generalised_mass);
    let (growth, rate, kind) = motion(wave, vibration.unit);
    let own = if kind == ModeKind::Rigid { 0.0 } else { OF_STATE * solution.error_estimate };
    let is_swinging = wave.rate.map_or(wave.square.im != 0.0, |s| s.im != 0.0);
    let quadrature = is_swinging.then(|| {
        let mut shape = shape(solution, &problem.swing(vibration, aside));
        for twist in shape.beams.iter_mut().flatten().chain(&mut shape.bodies) {
            twist.linear /= size;
            twist.angular /= size;
        }
        shape
    });
    Mode {
        growth,
        rate,
        kind,
        error_estimate: 0.5 * error.max(ROUND_OFF) + own,
        generalised_mass,
        shares: found.has_energy.then_some(Shares { participation, effective }),
        nodes: nodes(problem, &swing, size),
        damping_ratio: (!vibration.damping.is_empty() && kind != ModeKind::Rigid)
            .then(|| -growth / growth.hypot(rate)),
        direction,
        quadrature,
    }
}

/// What the modes say of stability.
fn remark(solution: &mut Solution, modes: &[Mode], has_energy: bool) {
    let unstable = modes.iter().filter(|mode| mode.growth > 0.0).count();
    if has_energy && unstable > 0 {
        solution.warnings.push(format!(
            "the equilibrium is unstable: of {unstable} modes ω² is negative, and they grow instead of swinging"
        ));
    }
    if !has_energy && unstable > 0 {
        let flutters = modes.iter().filter(|mode| mode.kind == ModeKind::Flutter).count();
        let how = match (flutters, unstable - flutters) {
            (0, _) => "diverges",
            (_, 0) => "flutters",
            _ => "flutters and diverges",
        };
        // Decided by the motion where there is no energy.
        (solution.stable, solution.unstable_directions) = (Some(false), Some(unstable));
        solution.stability_reason = None;
        solution.warnings.push(format!("the equilibrium {how}: {unstable} of these modes grow"));
    }
    if let Some(counted) = solution.unstable_directions
        && counted != unstable
        && (unstable < modes.len() || counted < unstable)
    {
        solution.warnings.push(format!(
            "{unstable} modes grow, but the equilibrium is counted unstable in {counted} directions: it is all but critical"
        ));
    }
}

/// What the modes do, without their shapes.
pub(super) fn rates(found: &Spectrum) -> Vec<Followed> {
    let unit = found.vibration.unit;
    let each = found.waves.iter().zip(&found.errors).map(|(wave, error)| {
        let (growth, rate, kind) = motion(wave, unit);
        Followed { growth, rate, kind, error_estimate: 0.5 * error.max(ROUND_OFF) }
    });
    each.collect()
}

/// Growth and rate of exp(s t) with s² = -ω²: of two opposite s the one that grows, but of a conjugate pair of ω² one each.
fn motion(wave: &Wave, unit: f64) -> (f64, f64, ModeKind) {
    if let Some(s) = wave.rate {
        let (growth, rate) = (s.re * unit.sqrt(), s.im * unit.sqrt());
        let kind = match (growth, rate) {
            (0.0, 0.0) => ModeKind::Rigid,
            (0.0, _) => ModeKind::Swinging,
            (growth, 0.0) if growth > 0.0 => ModeKind::Diverging,
            (_, 0.0) => ModeKind::Creeping,
            (growth, _) if growth > 0.0 => ModeKind::Flutter,
            _ => ModeKind::Decaying,
        };
        return (growth, rate, kind);
    }
    let square = wave.square * Complex::new(unit, 0.0);
    let size = square.norm_sqr().sqrt().sqrt();
    let half = 0.5 * square.im.atan2(square.re);
    let (rate, growth) = (size * half.cos(), size * half.sin());
    match square {
        Complex { re: 0.0, im: 0.0 } => (0.0, 0.0, ModeKind::Rigid),
        Complex { re, im: 0.0 } if re > 0.0 => (0.0, size, ModeKind::Swinging),
        Complex { im: 0.0, .. } => (size, 0.0, ModeKind::Diverging),
        Complex { im, .. } if im > 0.0 => (growth, rate, ModeKind::Flutter),
        _ => (growth, rate, ModeKind::Decaying),
    }
}

/// The shape at the samples of the state.
fn shape(solution: &Solution, swing: &Swing) -> Direction {
    let beams = solution.beams.iter().enumerate();
    let beams = beams.map(|(i, beam)| beam.samples.iter().map(|sample| swing.beam(i, sample.s)).collect());
    Direction { beams: beams.collect(), bodies: swing.bodies.clone() }
}

/// Places along each beam at which it passes through its rest position: where its displacement along the direction in which it moves
/// most changes its sign, of a beam that moves across that direction nowhere.
fn nodes(problem: &Equilibrium, swing: &Swing, size: f64) -> Vec<Vec<f64>> {
    let beams = 0..problem.beam_lengths().len();
    let each = beams.map(|beam| {
        let at = |s: f64| -> Vector3<f64> { swing.beam(beam, s).linear };
        let moved: Vec<(f64, Vector3<f64>)> = swing.places(beam).into_iter().map(|s| (s, at(s))).collect();
        let most = moved.iter().map(|(_, shift)| *shift).max_by(|a, b| a.norm().total_cmp(&b.norm()));
        let Some(most) = most.filter(|most| most.norm() > STILL * size) else { return Vec::new() };
        let along = most.normalize();
        let across = |s: f64| (at(s) - along * along.dot(&at(s))).norm();
        let mut found = Vec::new();
        for (i, pair) in moved.windows(2).enumerate().skip(1) {
            let ([mut a, mut b], [from, to]) =
                ([pair[0].0, pair[1].0], [pair[0].1, pair[1].1].map(|x| along.dot(&x)));
            if from == 0.0 || from * to >= 0.0 || i + 2 == moved.len() && to.abs() < 1e-9 * most.norm() {
                continue;
            }
            for _ in 0..40 {
                let middle = 0.5 * (a + b);
                if along.dot(&at(middle)) * from > 0.0 { a = middle } else { b = middle }
            }
            if across(a) < 1e-3 * most.norm() {
                found.push(0.5 * (a + b));
            }
        }
        found
    });
    each.collect()
}
