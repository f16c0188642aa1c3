//! Tendons that run without friction in channels along a rod (continuum robots).
//!
//! Tendon j pulls with one tension T_j along the curve p + R d_j, d_j(s) = (0, y_j, z_j) in the section's
//! axes. Per undeformed length of the rod that curve advances by R w_j,
//!
//! ```text
//! w_j = ν + k × d_j + d_j'        u_j = w_j/|w_j|        ℓ_j' = |w_j|
//! ```
//!
//! The state's wrench (F, M) is that of the WHOLE section, rod and tendons, so it obeys the balance of a
//! plain rod: what a channel's wall exerts on tendon and rod is internal. The rod's own part is
//!
//! ```text
//! n = Rᵀ F - Σ T_j u_j        m = Rᵀ M - Σ d_j × T_j u_j        (ν, k) = (ν0, k0) + C (n, m)
//! ```
//!
//! which determines the strain e = (ν, k) as the minimum of the convex energy
//! `½ (e - e0)·C⁻¹ (e - e0) - (Rᵀ F, Rᵀ M)·e + Σ T_j |w_j(e)|`, found by Newton's method to round-off.
//!
//! D. C. Rucker and R. J. Webster, "Statics and dynamics of continuum robots with general tendon routing and
//! external loading", IEEE Trans. Robotics 27 (2011) 1033-1044, derive the tendons' distributed force
//! f = T u' and moment d × f on the rod (their eqs. 10-12) and solve their balance for ν' and k'. Their
//! equations are the derivative of those above along s: the total wrench has no tendon in its balance,
//! so here the same equilibrium is algebraic in the strain, needs neither d'' nor derivatives of the
//! stiffness, and also holds for a rod that does not stretch or shear (C singular).

use super::balance::{FULL_ROWS, Lanes, Matrix, add, section_wrench, strained_rate, wrench_rate};
use super::constitutive::{Coupled, Law};
use super::foundation::Footing;
use super::propagate::{LawTable, LoadSample, Piece, RodState, entry, globalise, localised, through};
use crate::ode::{Rate, State, WEIGHTS};
use std::cell::RefCell;

/// A tension with its derivatives: lane 0 the value, N (not negative at a solution), lanes 1.. its derivatives
/// along the unknowns.
pub type Tension<const W: usize> = [f64; W];

/// Where a channel runs at one place of the rod.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChannelSample {
    /// (y, z) in the section's axes, m.
    pub offset: [f64; 2],
    /// Their derivatives by undeformed arc length.
    pub slope: [f64; 2],
}

/// One channel along a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Whose tension and length: the index in `tensions` and `lengths`. One tendon may run in several
    /// channels, either way.
    pub tendon: usize,
    /// One place for all, or `steps * STAGES` of them.
    pub samples: Vec<ChannelSample>,
}

/// [`super::advance_tendons`] of any width.
pub(super) fn advance_tendons<const W: usize>(
    piece: &Piece,
    channels: &[Channel],
    tensions: &[Tension<W>],
    load: f64,
    state: &mut RodState<W>,
    lengths: &mut [[f64; W]],
) {
    #[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, as was just asked.
        unsafe { run_avx2(piece, channels, tensions, load, state, lengths) };
        return;
    }
    run(piece, channels, tensions, load, state, lengths);
}

/// Force and moment of the rod alone, section axes, N and N·m, where rod and tendons together carry `total`
/// (n, m). `tendons`: where each runs, and its tension. With it `law` gives the strain.
pub fn rod_share(law: &Coupled, total: &[[f64; 3]; 2], tendons: &[(ChannelSample, f64)]) -> [[f64; 3]; 2] {
    let tendons = tendons
        .iter()
        .map(|(place, tension)| Pull {
            tension: *tension,
            arm: [0.0, place.offset[0], place.offset[1]],
            slope: [0.0, place.slope[0], place.slope[1]],
            ..Pull::default()
        })
        .collect();
    let mut section = Section { tendons, pull: None };
    let (e, _) = section.solve(law, total, false);
    let pull = section.pull_at(&e);
    std::array::from_fn(|part| std::array::from_fn(|i| total[part][i] - pull[3 * part + i]))
}

/// The same kernel compiled for four lanes at a time. No fused multiply-add: both builds give equal bits.
#[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
#[target_feature(enable = "avx2")]
fn run_avx2<const W: usize>(
    piece: &Piece,
    channels: &[Channel],
    tensions: &[Tension<W>],
    load: f64,
    state: &mut RodState<W>,
    lengths: &mut [[f64; W]],
) {
    run(piece, channels, tensions, load, state, lengths);
}

#[inline(always)]
fn run<const W: usize>(
    piece: &Piece,
    channels: &[Channel],
    tensions: &[Tension<W>],
    load: f64,
    state: &mut RodState<W>,
    lengths: &mut [[f64; W]],
) {
    let (r0, _) = super::balance::rotation(&state.rotation);
    let dtheta = state.rows(0);
    let force = localised(&r0, &state.force, &state.rows(6), &dtheta);
    let moment = localised(&r0, &state.moment, &state.rows(9), &dtheta);
    let h = piece.length / piece.steps as f64;
    let tendons =
        channels.iter().map(|c| Pull { tension: tensions[c.tendon][0], ..Pull::default() }).collect();
    let system = Tendoned {
        piece,
        channels,
        tensions,
        h,
        load,
        r0,
        dtheta,
        footing: piece.foundation.as_ref().map(|foundation| Footing {
            foundation,
            r0,
            dtheta,
            start: (state.position, state.rows(3)),
            load,
        }),
        scratch: RefCell::new(Scratch { section: Section { tendons, pull: None }, lengths }),
    };
    let (pose, force, moment) = through(piece, &force, &moment, &system);
    globalise(&r0, &pose, &force, &moment, state);
}

/// What the stages hand on: tendons in the section, and the lengths so far.
struct Scratch<'a, const W: usize> {
    section: Section,
    lengths: &'a mut [[f64; W]],
}

/// The rate of pose and total wrench of a rod with tendons.
struct Tendoned<'a, const W: usize> {
    piece: &'a Piece,
    channels: &'a [Channel],
    tensions: &'a [Tension<W>],
    h: f64,
    load: f64,
    r0: Matrix,
    dtheta: Lanes<W>,
    footing: Option<Footing<'a, W>>,
    scratch: RefCell<Scratch<'a, W>>,
}

impl<const W: usize> Rate<FULL_ROWS, W> for Tendoned<'_, W> {
    #[inline(always)]
    fn rate(&self, step: usize, stage: usize, y: &State<FULL_ROWS, W>) -> State<FULL_ROWS, W> {
        let scratch = &mut *self.scratch.borrow_mut();
        let q = [y[0], y[1], y[2], y[3]];
        let force = [y[7], y[8], y[9]];
        let moment = [y[10], y[11], y[12]];
        let mut total = section_wrench(&q, &force, &moment);
        for (tendon, channel) in scratch.section.tendons.iter_mut().zip(self.channels) {
            let place = entry(&channel.samples, step, stage);
            tendon.arm = [0.0, place.offset[0], place.offset[1]];
            tendon.slope = [0.0, place.slope[0], place.slope[1]];
        }
        let law = coupled(&self.piece.laws, step, stage);
        let (e, tangent) = scratch.section.solve(&law, &total.value, W > 1);

        // δe = S (δn_total - Σ δT u, δm_total - Σ d × δT u), by the implicit function theorem.
        for (tendon, channel) in scratch.section.tendons.iter().zip(self.channels) {
            let tension = &self.tensions[channel.tendon];
            for i in 0..3 {
                for l in 0..W {
                    total.change[0][i][l] -= tendon.generator[i] * tension[l];
                    total.change[1][i][l] -= tendon.generator[3 + i] * tension[l];
                }
            }
        }
        let strain = ([e[0], e[1], e[2]], [e[3], e[4], e[5]]);
        let change = tangent.strain_change(&total.change[0], &total.change[1]);

        // ℓ' = |w| with the weights of the step: the quadrature that the stepper would make of it.
        let weight = self.h * WEIGHTS[stage];
        for (tendon, channel) in scratch.section.tendons.iter().zip(self.channels) {
            let length = &mut scratch.lengths[channel.tendon];
            let g = &tendon.generator;
            length[0] += weight * tendon.stretch;
            for l in 1..W {
                let mut sum = 0.0;
                for i in 0..3 {
                    sum += g[i] * change.0[i][l] + g[3 + i] * change.1[i][l];
                }
                length[l] += weight * sum;
            }
        }

        let (rate, along) = strained_rate(&q, &total.r, &total.dphi, &strain, &change);
        let sample = match self.piece.loads.is_empty() {
            true => LoadSample::default(),
            false => *entry(&self.piece.loads, step, stage),
        };
        let (mut dead, section) = sample.localised(self.load, &self.r0, &self.dtheta);
        if let Some(footing) = &self.footing {
            dead[0] = add(&dead[0], &footing.force(step, stage, &[y[4], y[5], y[6]]));
            if let Some(moment) = footing.moment(step, stage, &q) {
                dead[1] = add(&dead[1], &moment);
            }
        }
        wrench_rate(&rate, &q, &total.r, &along, &force, &dead, &section)
    }
}

/// The law at one stage in its general form: one kernel serves all laws, as Newton's method dominates.
fn coupled(laws: &LawTable, step: usize, stage: usize) -> Coupled {
    let diagonal = |k0: [f64; 3], c: [f64; 6]| {
        let mut compliance = [[0.0; 6]; 6];
        for i in 0..6 {
            compliance[i][i] = c[i];
        }
        Coupled { k0, compliance }
    };
    match laws {
        LawTable::Slender(laws) => {
            let l = entry(laws, step, stage);
            diagonal(l.k0, [l.stretch, 0.0, 0.0, l.bend[0], l.bend[1], l.bend[2]])
        }
        LawTable::Shearable(laws) => {
            let l = entry(laws, step, stage);
            diagonal(l.k0, [l.shear[0], l.shear[1], l.shear[2], l.bend[0], l.bend[1], l.bend[2]])
        }
        LawTable::Coupled(laws) => *entry(laws, step, stage),
    }
}

/// One tendon at one section.
#[derive(Clone, Copy, Debug, Default)]
struct Pull {
    tension: f64,
    arm: [f64; 3],
    slope: [f64; 3],
    /// (u, d × u): the wrench of a unit tension, which is the gradient of |w| by the strain.
    generator: [f64; 6],
    /// |w|.
    stretch: f64,
}

impl Pull {
    /// w for the strain `e`, or without the slope for a change of strain.
    fn advance(&self, e: &[f64; 6], slope: &[f64; 3]) -> [f64; 3] {
        let turned = super::balance::cross(&[e[3], e[4], e[5]], &self.arm);
        [e[0] + turned[0] + slope[0], e[1] + turned[1] + slope[1], e[2] + turned[2] + slope[2]]
    }

    fn place(&mut self, e: &[f64; 6]) {
        let w = self.advance(e, &self.slope);
        self.stretch = norm(&w);
        let u = w.map(|x| x / self.stretch);
        let m = super::balance::cross(&self.arm, &u);
        self.generator = [u[0], u[1], u[2], m[0], m[1], m[2]];
    }

    /// Adds T ∂²|w|/∂e² = Gᵀ (T/|w|) (1 - u uᵀ) G, where w = G e + d', to `h`.
    fn add_stiffness(&self, h: &mut [[f64; 6]; 6]) {
        let [_, y, z] = self.arm;
        // Rows of Gᵀ: what w gains from each strain.
        let g =
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -z, y], [z, 0.0, 0.0], [-y, 0.0, 0.0]];
        let factor = self.tension / self.stretch;
        for i in 0..6 {
            for j in 0..6 {
                let dot = g[i][0] * g[j][0] + g[i][1] * g[j][1] + g[i][2] * g[j][2];
                h[i][j] += factor * (dot - self.generator[i] * self.generator[j]);
            }
        }
    }
}

fn norm(a: &[f64; 3]) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]
}

/// A step of the search for the strain.
struct Step {
    /// The rod's wrench before it.
    from: [f64; 6],
    /// The change of the wrench, and of the strain.
    dx: [f64; 6],
    de: [f64; 6],
    /// How fast the energy falls along it, at its start.
    slope: f64,
    /// How far it turns or stretches any tendon.
    turn: f64,
}

impl Step {
    fn halve(&mut self) {
        self.dx.iter_mut().chain(&mut self.de).for_each(|v| *v *= 0.5);
        self.slope *= 0.5;
        self.turn *= 0.5;
    }
}

/// The tendons of a section, and their joint wrench at the last strain found, which starts the next search.
struct Section {
    tendons: Vec<Pull>,
    pull: Option<[f64; 6]>,
}

impl Section {
    /// The strain e = (ν, k) under the total wrench, and the law of its changes: the tangent compliance
    /// S = (C⁻¹ + H)⁻¹ = (1 + C H)⁻¹ C, H the tendons' stiffness.
    ///
    /// Newton's method on the rod's own wrench x: e = e0 + C x, x = total - pull(e). It ends with the step
    /// that turns no tendon by more than 1e-8, so that the next one would be of round-off.
    #[inline(never)]
    fn solve(&mut self, law: &Coupled, total: &[[f64; 3]; 2], with_tangent: bool) -> ([f64; 6], Coupled) {
        const STEPS: usize = 60;
        let c = &law.compliance;
        let [n, m] = total;
        let total = [n[0], n[1], n[2], m[0], m[1], m[2]];
        let strain = |x: &[f64; 6]| {
            let (nu, k) = law.strain(&[x[0], x[1], x[2]], &[x[3], x[4], x[5]]);
            [nu[0], nu[1], nu[2], k[0], k[1], k[2]]
        };
        let mut pull = match self.pull {
            Some(pull) => pull,
            None => self.pull_at(&strain(&[0.0; 6])),
        };
        let mut x: [f64; 6] = std::array::from_fn(|i| total[i] - pull[i]);
        // Strains that no wrench changes stay out of the elimination.
        let (mut soft, mut size) = ([0; 6], 0);
        for i in 0..6 {
            if c[i].iter().any(|v| *v != 0.0) {
                soft[size] = i;
                size += 1;
            }
        }
        let soft = &soft[..size];
        let mut last: Option<Step> = None;
        for _ in 0..STEPS {
            let e = strain(&x);
            pull = self.pull_at(&e);
            let gap: [f64; 6] = std::array::from_fn(|i| total[i] - pull[i] - x[i]);
            if let Some(step) = &mut last
                && step.turn > 0.1
                && dot(&step.de, &gap).abs() > step.slope
            {
                // Too far along a descent of the convex energy.
                step.halve();
                x = std::array::from_fn(|i| step.from[i] + step.dx[i]);
                continue;
            }
            let settled = last.as_ref().is_some_and(|step| step.turn <= 1e-8);
            if settled && !with_tangent {
                self.pull = Some(pull);
                return (e, *law);
            }
            let mut stiffness = [[0.0; 6]; 6];
            self.tendons.iter().for_each(|t| t.add_stiffness(&mut stiffness));
            let mut softened = [[0.0; 6]; 6];
            for (p, i) in soft.iter().enumerate() {
                for (q, j) in soft.iter().enumerate() {
                    for l in soft {
                        softened[p][q] += c[*i][*l] * stiffness[*l][*j];
                    }
                }
                softened[p][p] += 1.0;
            }
            if settled {
                self.pull = Some(pull);
                let mut tangent = *law;
                let mut right = [[0.0; 6]; 6];
                for (p, i) in soft.iter().enumerate() {
                    right[p] = c[*i];
                }
                eliminate(size, &mut softened, &mut right);
                for (p, i) in soft.iter().enumerate() {
                    tangent.compliance[*i] = right[p];
                }
                return (e, tangent);
            }
            let mut right = [[0.0; 1]; 6];
            for (p, i) in soft.iter().enumerate() {
                right[p][0] = dot(&c[*i], &gap);
            }
            eliminate(size, &mut softened, &mut right);
            let mut de = [0.0; 6];
            for (p, i) in soft.iter().enumerate() {
                de[*i] = right[p][0];
            }
            let dx: [f64; 6] = std::array::from_fn(|i| gap[i] - dot(&stiffness[i], &de));
            let turn =
                self.tendons.iter().map(|t| norm(&t.advance(&de, &[0.0; 3])) / t.stretch).fold(0.0, f64::max);
            last = Some(Step { from: x, dx, de, slope: dot(&de, &gap).abs(), turn });
            x = std::array::from_fn(|i| x[i] + dx[i]);
        }
        self.pull = None;
        ([f64::NAN; 6], *law)
    }

    /// Places all tendons for the strain `e`, and returns their joint wrench.
    fn pull_at(&mut self, e: &[f64; 6]) -> [f64; 6] {
        let mut sum = [0.0; 6];
        for tendon in &mut self.tendons {
            tendon.place(e);
            for i in 0..6 {
                sum[i] += tendon.tension * tendon.generator[i];
            }
        }
        sum
    }
}

/// Solves the first `size` rows of `a x = b` in place of `b`, by elimination with row exchanges.
fn eliminate<const N: usize>(size: usize, a: &mut [[f64; 6]; 6], b: &mut [[f64; N]; 6]) {
    let size = size.min(6);
    for i in 0..size {
        let mut largest = i;
        for r in i + 1..size {
            if a[r][i].abs() > a[largest][i].abs() {
                largest = r;
            }
        }
        if largest != i {
            a.swap(i, largest);
            b.swap(i, largest);
        }
        let inverse = 1.0 / a[i][i];
        for r in i + 1..size {
            let factor = a[r][i] * inverse;
            for l in i + 1..size {
                a[r][l] -= factor * a[i][l];
            }
            for l in 0..N {
                b[r][l] -= factor * b[i][l];
            }
        }
        a[i][i] = inverse;
    }
    for i in (0..size).rev() {
        for l in 0..N {
            let mut sum = b[i][l];
            for j in i + 1..size {
                sum -= a[i][j] * b[j][l];
            }
            b[i][l] = sum * a[i][i];
        }
    }
}

#[cfg(test)]
mod tests;
