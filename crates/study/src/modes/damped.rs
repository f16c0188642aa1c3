//! The lowest s of a quadratic pencil (K + s D + s² M) x = 0: what damps, and what turns along with a spinning frame.
//!
//! In companion form, with v = s x (F. Tisseur and K. Meerbergen, *SIAM Review* 43 (2001) 235), for a real shift σ
//!
//! ```text
//!   (s - σ)⁻¹ (x, v):   (K + σ D + σ² M) x' = -(M v + (D + σ M) x)      v' = x + σ x'
//! ```
//!
//! in a Krylov space as that of `unsymmetric`. What has neither inertia nor damping follows the rest and does not count in the product
//! that tells vectors apart. Time is measured by `pace`, so that x and v/pace are of one size.

use super::pencil::Trouble;
use super::unsymmetric::{MOST, Operator, PER, Ritz, Wave, largest};
use flexura_equilibrium::Vibration;
use flexura_nonlinear::{Breakdown, Matrix};
use nalgebra::{Complex, DVector};

/// Part of |s| that is round-off in its imaginary part.
const REAL: f64 = 1e-9;
/// The same in its real part, where nothing damps.
const LOSSLESS: f64 = 1e-9;
/// What inertia and damping do to a motion beside what cancels in its stiffness, where it has none.
const NOTHING: f64 = 1e-12;
/// Part that must be left of a motion without stiffness beside others for it to be another.
const NEW: f64 = 1e-3;
/// |s| beside the largest that was found below which a motion may have no stiffness.
const FREE: f64 = 1e-5;
/// Shifts that are tried, beside the first.
const SHIFTED: [f64; 7] = [1.0, 2.3, 0.43, 5.1, 0.19, 15.0, 40.0];
/// Tries of a shift that is no s.
const SHIFTS: usize = 5;

/// (P(σ))⁻¹ in companion form.
struct Companion<'v> {
    vibration: &'v Vibration,
    /// K + σ D + σ² M, factorised.
    matrix: Matrix,
    sigma: f64,
    pace: f64,
    /// Does an unknown have inertia or damping?
    moves: Vec<bool>,
}

impl<'v> Companion<'v> {
    fn new(vibration: &'v Vibration, sigma: f64) -> Result<Self, Breakdown> {
        let mut matrix = Matrix::default();
        matrix.arrange(vibration.size, &vibration.blocks);
        matrix.reset();
        let mut moves = vec![false; vibration.size];
        for &(i, j, value) in &vibration.stiffness {
            matrix.add(i, j, value);
        }
        for &(i, j, value) in rates(vibration) {
            matrix.add(i, j, sigma * value);
            moves[j] = true;
        }
        for &(i, j, value) in &vibration.inertia {
            matrix.add(i, j, sigma * sigma * value);
            moves[j] = true;
        }
        matrix.factorise()?;
        Ok(Self { vibration, matrix, sigma, pace: sigma.abs(), moves })
    }
}

/// What goes with the rates.
fn rates(vibration: &Vibration) -> impl Iterator<Item = &(usize, usize, f64)> {
    vibration.damping.iter().chain(&vibration.gyroscopic)
}

impl Operator for Companion<'_> {
    fn size(&self) -> usize {
        2 * self.vibration.size
    }

    fn weighed(&self, x: &DVector<f64>) -> DVector<f64> {
        let n = self.vibration.size;
        DVector::from_fn(x.len(), |i, _| if self.moves[i % n] { x[i] } else { 0.0 })
    }

    fn apply(&mut self, z: &DVector<f64>, _: &DVector<f64>) -> DVector<f64> {
        let (n, sigma, pace) = (self.vibration.size, self.sigma, self.pace);
        let mut right = vec![0.0; n];
        for &(i, j, value) in &self.vibration.inertia {
            right[i] -= value * (pace * z[n + j] + sigma * z[j]);
        }
        for &(i, j, value) in rates(self.vibration) {
            right[i] -= value * z[j];
        }
        self.matrix.solve(&mut right);
        DVector::from_fn(
            2 * n,
            |i, _| if i < n { right[i] } else { (z[i - n] + sigma * right[i - n]) / pace },
        )
    }
}

/// The lowest s by their size, one of each conjugate pair: `count` and those of motions without stiffness, or as many as can be told.
/// `sigma` is positive, and about as large as the lowest.
pub fn slowest(vibration: &Vibration, count: usize, sigma: f64) -> Result<Vec<Wave>, Trouble> {
    // From another shift the vectors of what is far from normal are others. Fewer than there may be are none: what grows could be missing.
    let found = SHIFTED.iter().find_map(|factor| match about(vibration, count, factor * sigma) {
        Err(Trouble::Missing) => None,
        found => found.transpose(),
    });
    found.unwrap_or(Err(Trouble::Missing))
}

/// The same from one shift; None where a larger space might show more.
fn about(vibration: &Vibration, count: usize, sigma: f64) -> Result<Option<Vec<Wave>>, Trouble> {
    let mut shift = sigma;
    let mut tries = 0;
    let companion = loop {
        match Companion::new(vibration, shift) {
            Ok(companion) => break companion,
            Err(Breakdown::Singular) if tries < SHIFTS => shift *= 1.37,
            Err(breakdown) => return Err(breakdown.into()),
        }
        tries += 1;
    };
    let most = (MOST + PER * count).min(2 * vibration.size);
    let found = largest(companion, 2 * count, most, &|found| are_lowest(found, count, shift))?;
    let mut waves = Vec::new();
    for (theta, [mut x, mut aside]) in found {
        let mut s = Complex::new(shift, 0.0) + Complex::new(1.0, 0.0) / theta;
        let size = s.re.hypot(s.im);
        if s.im.abs() <= REAL * size {
            s.im = 0.0;
        }
        if vibration.damping.is_empty() && vibration.has_energy && s.re.abs() <= LOSSLESS * size {
            s.re = 0.0;
        }
        if s.im < 0.0 {
            continue;
        }
        x.truncate(vibration.size);
        aside.truncate(vibration.size);
        if is_free(vibration, s, &x, &aside) {
            s = Complex::new(0.0, 0.0);
        }
        waves.push(Wave { square: -(s * s), rate: Some(s), vector: [x, aside] });
    }
    waves.sort_by(|a, b| a.square.norm_sqr().total_cmp(&b.square.norm_sqr()));
    let mut free = Vec::new();
    waves.retain(|wave| wave.square.norm_sqr() > 0.0 || is_new(&mut free, &wave.vector[0]));
    waves.truncate(count + free.len());
    let is_short = waves.len() < count + free.len() && most < 2 * vibration.size;
    Ok((!is_short).then_some(waves))
}

/// Are `count` of these the lowest by their size, whatever lies farther from the shift?
fn are_lowest(found: &[Ritz], count: usize, shift: f64) -> bool {
    let s = |ritz: &Ritz| Complex::new(shift, 0.0) + Complex::new(1.0, 0.0) / ritz.0;
    let Some(last) = found.last() else { return false };
    let reach = 1.0 / last.0.re.hypot(last.0.im) - shift;
    let inside = found.iter().map(s).filter(|s| s.im >= 0.0 && s.re.hypot(s.im) <= reach);
    // Both s of motions without stiffness may be among them.
    let free = inside.clone().filter(|s| s.re.hypot(s.im) < FREE * reach).count();
    inside.count() >= count + free
}

/// Both s of a motion without stiffness are nothing, and it counts once.
fn is_new(free: &mut Vec<DVector<f64>>, x: &[f64]) -> bool {
    let mut x = DVector::from_row_slice(x);
    let size = x.norm();
    for q in free.iter() {
        let part = q.dot(&x);
        x.axpy(-part, q, 1.0);
    }
    let rest = x.norm();
    let is_new = rest > NEW * size;
    if is_new {
        free.push(x / rest);
    }
    is_new
}

/// Is it a motion without stiffness, whose s is round-off?
fn is_free(vibration: &Vibration, s: Complex<f64>, x: &[f64], aside: &[f64]) -> bool {
    let form = |list: &mut dyn Iterator<Item = &(usize, usize, f64)>| -> [f64; 2] {
        let (mut sum, mut all) = (0.0, 0.0);
        for (i, j, value) in list {
            let term = value * (x[*i] * x[*j] + aside[*i] * aside[*j]);
            sum += term;
            all += term.abs();
        }
        [sum, all]
    };
    let [_, cancels] = form(&mut vibration.stiffness.iter());
    let [mass, _] = form(&mut vibration.inertia.iter());
    let [drag, _] = form(&mut vibration.damping.iter());
    let size = s.re.hypot(s.im);
    size * size * mass.abs() + size * drag.abs() <= NOTHING * cancels
}
