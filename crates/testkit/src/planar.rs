//! Planar mechanisms of rigid bodies and uniform beams: the second method for flexure mechanisms.
//!
//! Every beam is integrated from its start by its Taylor series ([`crate::taylor`]); its start wrench and start angle are
//! unknown, as are the bodies' poses. Newton's method closes the beams at their ends and balances the bodies, all at once
//! and dense, with differences for the Jacobian.

use crate::path::Curve;
use crate::taylor::Section;
use nalgebra::{DMatrix, DVector};

/// Where one end of a beam is.
#[derive(Clone, Copy, Debug)]
pub struct End {
    /// Which body; None for the ground.
    pub body: Option<usize>,
    /// x, y, angle of the beam's tangent, in the body's axes.
    pub place: [f64; 3],
    /// Free to turn.
    pub hinged: bool,
}

impl End {
    /// Clamped.
    pub fn clamp(body: Option<usize>, place: [f64; 3]) -> Self {
        Self { body, place, hinged: false }
    }
}

/// A beam that is the same everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// Undeformed length.
    pub length: f64,
    /// EI.
    pub bending: f64,
    /// 1/EA; zero for a beam that does not stretch.
    pub stretch: f64,
    /// Rest curvature.
    pub curvature: f64,
    /// s = 0.
    pub start: End,
    /// s = L.
    pub end: End,
}

/// A rigid body.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// x, y, angle at rest.
    pub rest: [f64; 3],
    /// Coordinates (of the pose) that are held at a value; the others are free.
    pub held: [Option<f64>; 3],
    /// Force and moment on its origin.
    pub load: [f64; 3],
}

/// What is to be solved.
#[derive(Clone, Debug, Default)]
pub struct Mechanism {
    /// The beams.
    pub beams: Vec<Beam>,
    /// The bodies.
    pub bodies: Vec<Body>,
}

/// An equilibrium.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// x, y, angle of every body.
    pub poses: Vec<[f64; 3]>,
    /// What holds every body: zero in free coordinates, up to the residual.
    pub reactions: Vec<[f64; 3]>,
    /// Fx, Fy and the moments at start and end of every beam.
    pub wrenches: Vec<[f64; 4]>,
}

/// Newton's method failed at this fraction of the way; the size of its last scaled step.
#[derive(Clone, Copy, Debug)]
pub struct NotConverged {
    /// 0 to 1.
    pub fraction: f64,
    /// Relative to L, 1, EI/L², EI/L.
    pub step: f64,
}

const STEPS: usize = 24;

impl Beam {
    /// x, y, θ, M at s = L.
    fn integrate(&self, [x, y, angle, moment]: [f64; 4], [fx, fy]: [f64; 2]) -> [f64; 4] {
        let section = Section {
            bending: self.bending,
            stretch: self.stretch,
            curvature: self.curvature,
            load: [0.0; 2],
        };
        let [x, y, angle, moment, _, _] = section.carry([x, y, angle, moment, fx, fy], self.length, STEPS);
        [x, y, angle, moment]
    }
}

/// A place on a body, in fixed axes.
fn place(end: &End, poses: &[[f64; 3]]) -> [f64; 3] {
    let [x, y, angle] = end.body.map_or([0.0; 3], |body| poses[body]);
    let (s, c) = angle.sin_cos();
    let [u, v, turn] = end.place;
    [x + c * u - s * v, y + s * u + c * v, angle + turn]
}

impl Mechanism {
    /// The unknowns at rest: x, y, angle of every body (so that coordinate i of body b is number 3b + i), then four numbers of
    /// every beam.
    fn at_rest(&self) -> Vec<f64> {
        let rest: Vec<[f64; 3]> = self.bodies.iter().map(|body| body.rest).collect();
        let mut unknowns: Vec<f64> = rest.iter().flatten().copied().collect();
        for beam in &self.beams {
            unknowns.extend([0.0, 0.0, 0.0, place(&beam.start, &rest)[2]]);
        }
        unknowns
    }

    fn poses(&self, unknowns: &[f64]) -> Vec<[f64; 3]> {
        (0..self.bodies.len()).map(|b| [unknowns[3 * b], unknowns[3 * b + 1], unknowns[3 * b + 2]]).collect()
    }

    /// Scales of unknowns and residuals: those of a body and of a beam.
    fn scales(&self) -> (f64, f64) {
        let length = self.beams.iter().map(|beam| beam.length).fold(0.0, f64::max);
        let bending = self.beams.iter().map(|beam| beam.bending).fold(0.0, f64::max);
        (length, bending)
    }

    /// Residual (scaled), and the sums of forces and moments on the bodies and the beams' wrenches.
    fn evaluate(&self, unknowns: &[f64]) -> (DVector<f64>, Vec<[f64; 3]>, Vec<[f64; 4]>) {
        let (l, ei) = self.scales();
        let (unit, n) = (ei / (l * l), 3 * self.bodies.len());
        let poses = self.poses(unknowns);
        let mut sums: Vec<[f64; 3]> = self.bodies.iter().map(|body| body.load).collect();
        let mut residual = DVector::zeros(unknowns.len());
        let mut wrenches = Vec::new();
        for (i, beam) in self.beams.iter().enumerate() {
            let row = n + 4 * i;
            let q = &unknowns[row..row + 4];
            let force = [q[0] * unit, q[1] * unit];
            let (a, b) = (place(&beam.start, &poses), place(&beam.end, &poses));
            let first = [a[0], a[1], q[3], q[2] * unit * l];
            let last = beam.integrate(first, force);
            residual[row] = (last[0] - b[0]) / l;
            residual[row + 1] = (last[1] - b[1]) / l;
            residual[row + 2] = if beam.start.hinged { q[2] } else { q[3] - a[2] };
            residual[row + 3] = if beam.end.hinged { last[3] / (unit * l) } else { last[2] - b[2] };
            for (end, at, sign, moment) in [(&beam.start, a, 1.0, first[3]), (&beam.end, b, -1.0, last[3])] {
                if let Some(body) = end.body {
                    let (u, v) = (at[0] - poses[body][0], at[1] - poses[body][1]);
                    sums[body][0] += sign * force[0];
                    sums[body][1] += sign * force[1];
                    sums[body][2] += sign * (moment + u * force[1] - v * force[0]);
                }
            }
            wrenches.push([force[0], force[1], first[3], last[3]]);
        }
        for (b, body) in self.bodies.iter().enumerate() {
            for i in 0..3 {
                residual[3 * b + i] = match body.held[i] {
                    Some(value) => (poses[b][i] - value) / if i < 2 { l } else { 1.0 },
                    None => sums[b][i] / (unit * if i < 2 { 1.0 } else { l }),
                };
            }
        }
        (residual, sums, wrenches)
    }

    fn newton(&self, unknowns: &mut [f64], fraction: f64) -> Result<(), NotConverged> {
        let (l, _) = self.scales();
        let size = unknowns.len();
        let positions = 3 * self.bodies.len();
        let scale = |j: usize| if j < positions && j % 3 < 2 { l } else { 1.0 };
        let mut step = f64::INFINITY;
        for _ in 0..60 {
            let residual = self.evaluate(unknowns).0;
            let mut jacobian = DMatrix::zeros(size, size);
            for j in 0..size {
                let h = 1e-5 * scale(j);
                let mut moved = unknowns.to_vec();
                moved[j] += h;
                let plus = self.evaluate(&moved).0;
                moved[j] -= 2.0 * h;
                let minus = self.evaluate(&moved).0;
                jacobian.set_column(j, &((plus - minus) / 2e-5));
            }
            let Some(change) = jacobian.lu().solve(&residual) else { break };
            step = change.amax();
            for j in 0..size {
                unknowns[j] -= change[j] * scale(j);
            }
            if step < 1e-10 || !step.is_finite() {
                break;
            }
        }
        if step < 1e-9 { Ok(()) } else { Err(NotConverged { fraction, step }) }
    }
}

/// Follows `at(λ)` from λ = 0, where it must be at rest, to 1 in equal steps.
///
/// # Errors
/// Newton's method fails on the way.
pub fn solve(at: &dyn Fn(f64) -> Mechanism, steps: usize) -> Result<Equilibrium, NotConverged> {
    let mut mechanism = at(0.0);
    let mut unknowns = mechanism.at_rest();
    for step in 0..=steps {
        let fraction = step as f64 / steps as f64;
        mechanism = at(fraction);
        mechanism.newton(&mut unknowns, fraction)?;
    }
    let (_, sums, wrenches) = mechanism.evaluate(&unknowns);
    let reactions = sums.iter().map(|sum| sum.map(|value| -value)).collect();
    Ok(Equilibrium { poses: mechanism.poses(&unknowns), reactions, wrenches })
}

/// The curve of all equilibria of `at(λ)`, with λ of the size `size` as last unknown, and the point of rest at λ = 0. Of the
/// other unknowns, coordinate i of body b is number 3b + i.
pub fn curve<'a>(at: impl Fn(f64) -> Mechanism + 'a, size: f64) -> (Curve<'a>, Vec<f64>) {
    let mechanism = at(0.0);
    let (length, _) = mechanism.scales();
    let mut start = mechanism.at_rest();
    start.push(0.0);
    let positions = 3 * mechanism.bodies.len();
    let last = start.len() - 1;
    let scale = |j: usize| if j < positions && j % 3 < 2 { length } else { 1.0 };
    let mut scales: Vec<f64> = (0..last).map(scale).collect();
    scales.push(size);
    let residual = move |y: &[f64]| at(y[last]).evaluate(&y[..last]).0.iter().copied().collect();
    (Curve::new(scales, residual), start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::elastica::Elastica;

    #[test]
    fn a_cantilever_is_the_elastica() {
        let at = |fraction: f64| Mechanism {
            beams: vec![Beam {
                length: 2.0,
                bending: 3.0,
                stretch: 0.0,
                curvature: 0.0,
                start: End::clamp(None, [0.0; 3]),
                end: End::clamp(Some(0), [0.0; 3]),
            }],
            bodies: vec![Body {
                rest: [2.0, 0.0, 0.0],
                held: [None; 3],
                load: [0.0, fraction * 5.0 * 3.0 / 4.0, 0.0],
            }],
        };
        let found = solve(&at, 5).unwrap();
        let tip = Elastica::dead(5.0, std::f64::consts::FRAC_PI_2).tip();
        assert_close(found.poses[0][0], 2.0 * tip.position[0], 1e-12, "x");
        assert_close(found.poses[0][1], 2.0 * tip.position[1], 1e-12, "y");
        assert_close(found.poses[0][2], tip.angle, 1e-12, "angle");
    }

    #[test]
    fn a_hinged_end_bears_no_moment_and_stretch_is_counted() {
        // A bar between two hinges, pulled: x = L (1 + F/EA).
        let at = |fraction: f64| Mechanism {
            beams: vec![Beam {
                length: 1.0,
                bending: 1.0,
                stretch: 1e-3,
                curvature: 0.0,
                start: End { body: None, place: [0.0; 3], hinged: true },
                end: End { body: Some(0), place: [0.0; 3], hinged: true },
            }],
            bodies: vec![Body {
                rest: [1.0, 0.0, 0.0],
                held: [None, Some(0.0), Some(0.0)],
                load: [20.0 * fraction, 0.0, 0.0],
            }],
        };
        let found = solve(&at, 2).unwrap();
        assert_close(found.poses[0][0], 1.02, 1e-12, "x");
        assert_close(found.wrenches[0][3], 0.0, 1e-12, "moment");
    }
}
