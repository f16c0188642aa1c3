//! Concentric pre-curved tubes: up to four round tubes on one axis, which turn and twist inside each other
//! without friction.
//!
//! The state's frame R is that of tube 1, the innermost, which reaches the tip; e1 is the common tangent. Tube
//! i is turned against tube 1 by θ_i about e1, has the rest curvature u_i(s) in its own axes, EI_i and GJ_i.
//! F and M act across all tubes together, by the part beyond on the part before, so they obey the balance of
//! a plain rod. With M in tube 1's axes, a_i = Rot(θ_i) u_i, and m_i the torque in tube i,
//!
//! ```text
//! p' = R e1                                     the axis neither stretches nor shears
//! k_23 = (M_23 + Σ EI_i a_i,23) / Σ EI_i        all tubes bend alike
//! k_1 = u_11 + m_1/GJ_1,  m_1 = M_1 - Σ_{i>1} m_i
//! θ_i' = u_i1 + m_i/GJ_i - k_1
//! m_i' = EI_i (k × a_i)_1                       no torque about e1 passes between tubes
//! ```
//!
//! The last line: tube i carries M_i = (m_i, EI_i (k - a_i)_23), the contact's forces meet the axis, so
//! (M_i·e1)' = M_i·e1' = M_i·(k × e1) = EI_i (k × a_i)_1. Their sum is (M·e1)' = M·(k × e1), as it must be. A
//! moment per length about e1 is taken by tube 1. Where u_i does not depend on s and nothing
//! is loaded between the ends, H = F·e1 + M·k + Σ_{i>1} m_i θ_i' - W is constant, W the elastic energy per length.
//!
//! P. E. Dupont, J. Lock, B. Itkowitz and E. Butler, "Design and control of concentric-tube robots", IEEE
//! Trans. Robotics 26 (2010) 209-225; D. C. Rucker, B. A. Jones and R. J. Webster, "A geometrically exact
//! model for externally loaded concentric-tube continuum robots", IEEE Trans. Robotics 26 (2010) 769-780:
//! the same equations, theirs with the curvature of tube 1 as a state in place of M.

use super::balance::{
    FULL_ROWS, Lanes, Matrix, POSE_ROWS, SectionWrench, apply, apply_transposed, rotation, section_wrench,
    strained_rate, wrench_rate,
};
use super::propagate::{LoadSample, RodState, entry, globalise, localised, unit_product};
use crate::ode::{self, Rate, State};

/// The most tubes.
pub const TUBES: usize = 4;
/// Tubes beside the first.
const OTHERS: usize = TUBES - 1;
const ANGLES: usize = FULL_ROWS;
const TORQUES: usize = FULL_ROWS + OTHERS;
const ROWS: usize = FULL_ROWS + 2 * OTHERS;

/// One tube along a stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct Tube {
    /// EI, N·m².
    pub bending: f64,
    /// GJ, N·m²; infinite where it cannot twist.
    pub torsion: f64,
    /// Rest twist and curvatures (u1, u2, u3) in the tube's own axes, 1/m: one for all places, or
    /// `steps * STAGES`.
    pub rest: Vec<[f64; 3]>,
}

/// A stretch on which the set of tubes is the same and everything is smooth, cut into equal steps.
#[derive(Clone, Debug)]
pub struct TubePiece {
    /// Length, m.
    pub length: f64,
    /// Number of integration steps.
    pub steps: usize,
    /// Tube 1, which is everywhere.
    pub first: Tube,
    /// Tubes 2, 3, 4; `None` where there is none (any more).
    pub others: [Option<Tube>; OTHERS],
    /// No distributed load (empty), one for all places, or `steps * STAGES`.
    pub loads: Vec<LoadSample>,
}

/// The state of concentric tubes at one section.
#[derive(Clone, Copy, Debug)]
pub struct TubeState<const W: usize> {
    /// Tube 1's pose, and the wrench across all tubes, global axes.
    pub rod: RodState<W>,
    /// θ of tubes 2, 3, 4 against tube 1, rad; lane 0 the value, lanes 1.. its derivatives.
    pub angle: [[f64; W]; OTHERS],
    /// m of tubes 2, 3, 4, N·m, likewise. Zero at the end of a tube.
    pub torque: [[f64; W]; OTHERS],
}

/// How a tube comes out of a straight guide that ends at the start of the first stretch.
#[derive(Clone, Copy, Debug)]
pub struct Guided<const W: usize> {
    /// α, by how much its far end is turned about e1 against the guide, rad; lane 0 the value.
    pub turn: [f64; W],
    /// |β|, the length within the guide, m. It has no rest twist there.
    pub back: f64,
    /// GJ, N·m².
    pub torsion: f64,
}

impl<const W: usize> TubeState<W> {
    /// The state at the end of the guide. `guide` holds the guide's pose and the wrench there; the tubes twist
    /// within it by |β| m/GJ.
    ///
    /// R = Q Rot(ψ_1), θ_i = ψ_i - ψ_1, ψ_i = α_i + |β_i| m_i/GJ_i.
    pub fn leave_guide(
        guide: &RodState<W>,
        first: &Guided<W>,
        others: &[Option<Guided<W>>; OTHERS],
        torque: &[[f64; W]; OTHERS],
    ) -> Self {
        let (q, _) = rotation(&guide.rotation);
        let axis = apply(&q, &[1.0, 0.0, 0.0]);
        let mut along = localised(&q, &guide.moment, &guide.rows(9), &guide.rows(0))[0];
        for row in torque {
            for l in 0..W {
                along[l] -= row[l];
            }
        }
        let turned = |tube: &Guided<W>, torque: &[f64; W]| {
            let mut out = tube.turn;
            for l in 0..W {
                out[l] += tube.back / tube.torsion * torque[l];
            }
            out
        };
        let psi = turned(first, &along);
        let mut state = Self { rod: *guide, angle: [[0.0; W]; OTHERS], torque: *torque };
        let (sin, cos) = (0.5 * psi[0]).sin_cos();
        state.rod.rotation = unit_product(&guide.rotation, &[cos, sin, 0.0, 0.0]);
        for i in 0..3 {
            for l in 1..W {
                state.rod.d[i][l] += axis[i] * psi[l];
            }
        }
        for (i, tube) in others.iter().enumerate() {
            if let Some(tube) = tube {
                state.angle[i] = turned(tube, &torque[i]);
                for l in 0..W {
                    state.angle[i][l] -= psi[l];
                }
            }
        }
        state
    }

    /// The torque m_1 = M·e1 - Σ m_i in tube 1.
    pub fn first_torque(&self) -> [f64; W] {
        let (r, _) = rotation(&self.rod.rotation);
        let mut out = localised(&r, &self.rod.moment, &self.rod.rows(9), &self.rod.rows(0))[0];
        for row in &self.torque {
            for l in 0..W {
                out[l] -= row[l];
            }
        }
        out
    }

    /// The moment (m_i, EI_i (k - a_i)_23) of each tube in its own axes, N·m, tube 1 first. `tubes` holds EI and the
    /// rest curvature here of those that are here; the others get none.
    pub fn moments(&self, tubes: &[Option<(f64, [f64; 3])>; TUBES]) -> [[f64; 3]; TUBES] {
        let (r, _) = rotation(&self.rod.rotation);
        let m = apply_transposed(&r, &self.rod.moment);
        let angle = |i: usize| if i == 0 { 0.0 } else { self.angle[i - 1][0] };
        let (mut sum, mut stiffness) = ([m[1], m[2]], 0.0);
        for (i, tube) in tubes.iter().enumerate() {
            let Some((bending, u)) = tube else { continue };
            let (sin, cos) = angle(i).sin_cos();
            sum[0] += bending * (cos * u[1] - sin * u[2]);
            sum[1] += bending * (sin * u[1] + cos * u[2]);
            stiffness += bending;
        }
        let k = sum.map(|m| m / stiffness);
        let mut out = [[0.0; 3]; TUBES];
        for (i, tube) in tubes.iter().enumerate() {
            let Some((bending, u)) = tube else { continue };
            let (sin, cos) = angle(i).sin_cos();
            let torque = if i == 0 { self.first_torque()[0] } else { self.torque[i - 1][0] };
            out[i] = [
                torque,
                bending * (cos * k[0] + sin * k[1] - u[1]),
                bending * (cos * k[1] - sin * k[0] - u[2]),
            ];
        }
        out
    }
}

/// [`super::advance_tubes`] of any width.
pub(super) fn advance_tubes<const W: usize>(piece: &TubePiece, load: f64, state: &mut TubeState<W>) {
    #[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, as was just asked.
        unsafe { run_avx2(piece, load, state) };
        return;
    }
    run(piece, load, state);
}

/// The same kernel compiled for four lanes at a time. No fused multiply-add: both builds give equal bits.
#[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
#[target_feature(enable = "avx2")]
fn run_avx2<const W: usize>(piece: &TubePiece, load: f64, state: &mut TubeState<W>) {
    run(piece, load, state);
}

#[inline(always)]
fn run<const W: usize>(piece: &TubePiece, load: f64, state: &mut TubeState<W>) {
    let (r0, _) = rotation(&state.rod.rotation);
    let dtheta = state.rod.rows(0);
    let force = localised(&r0, &state.rod.force, &state.rod.rows(6), &dtheta);
    let moment = localised(&r0, &state.rod.moment, &state.rod.rows(9), &dtheta);
    let mut y: State<ROWS, W> = [[0.0; W]; ROWS];
    y[0][0] = 1.0;
    y[7..10].copy_from_slice(&force);
    y[10..13].copy_from_slice(&moment);
    y[ANGLES..TORQUES].copy_from_slice(&state.angle);
    y[TORQUES..].copy_from_slice(&state.torque);
    let system = Nested { piece, load, r0, dtheta };
    let h = piece.length / piece.steps as f64;
    let mut rates = ode::workspace();
    for i in 0..piece.steps {
        y = ode::step(&y, h, i, &system, &mut rates);
    }
    let mut pose = [[0.0; W]; POSE_ROWS];
    pose.copy_from_slice(&y[..POSE_ROWS]);
    globalise(&r0, &pose, &[y[7], y[8], y[9]], &[y[10], y[11], y[12]], &mut state.rod);
    state.angle.copy_from_slice(&y[ANGLES..TORQUES]);
    state.torque.copy_from_slice(&y[TORQUES..]);
}

/// The rate of pose, wrench, angles and torques.
struct Nested<'a, const W: usize> {
    piece: &'a TubePiece,
    load: f64,
    r0: Matrix,
    dtheta: Lanes<W>,
}

impl<const W: usize> Rate<ROWS, W> for Nested<'_, W> {
    #[inline(always)]
    fn rate(&self, step: usize, stage: usize, y: &State<ROWS, W>) -> State<ROWS, W> {
        let q = [y[0], y[1], y[2], y[3]];
        let force = [y[7], y[8], y[9]];
        let moment = [y[10], y[11], y[12]];
        let section = section_wrench(&q, &force, &moment);
        let (k, dk, own) = self.bend(step, stage, y, &section);

        let strain = ([1.0, 0.0, 0.0], k);
        let change = ([[0.0; W]; 3], dk);
        let (rate, along) = strained_rate(&q, &section.r, &section.dphi, &strain, &change);
        let sample = match self.piece.loads.is_empty() {
            true => LoadSample::default(),
            false => *entry(&self.piece.loads, step, stage),
        };
        let (dead, follower) = sample.localised(self.load, &self.r0, &self.dtheta);
        let wrench = wrench_rate(&rate, &q, &section.r, &along, &force, &dead, &follower);
        let mut out = [[0.0; W]; ROWS];
        out[..FULL_ROWS].copy_from_slice(&wrench);
        out[FULL_ROWS..].copy_from_slice(&own);
        out
    }
}

impl<const W: usize> Nested<'_, W> {
    /// The common curvature with its changes, and the rates of angles and torques.
    #[inline(always)]
    fn bend(
        &self,
        step: usize,
        stage: usize,
        y: &State<ROWS, W>,
        section: &SectionWrench<W>,
    ) -> ([f64; 3], Lanes<W>, [[f64; W]; 2 * OTHERS]) {
        let first = &self.piece.first;
        let rest = entry(&first.rest, step, stage);
        let m = &section.value[1];
        let mut sum = [m[0], m[1] + first.bending * rest[1], m[2] + first.bending * rest[2]];
        let mut dsum = section.change[1];
        let mut stiffness = first.bending;
        // a_i,23 = (cos θ u2 - sin θ u3, sin θ u2 + cos θ u3), δa = (-a3, a2) δθ.
        let mut turned = [[0.0; 2]; OTHERS];
        for (i, tube) in self.piece.others.iter().enumerate() {
            let Some(tube) = tube else { continue };
            let (angle, torque) = (&y[ANGLES + i], &y[TORQUES + i]);
            let u = entry(&tube.rest, step, stage);
            let (sin, cos) = angle[0].sin_cos();
            let a = [cos * u[1] - sin * u[2], sin * u[1] + cos * u[2]];
            turned[i] = a;
            stiffness += tube.bending;
            sum[0] -= torque[0];
            sum[1] += tube.bending * a[0];
            sum[2] += tube.bending * a[1];
            for l in 1..W {
                dsum[0][l] -= torque[l];
                dsum[1][l] -= tube.bending * a[1] * angle[l];
                dsum[2][l] += tube.bending * a[0] * angle[l];
            }
        }
        let soft = [1.0 / first.torsion, 1.0 / stiffness, 1.0 / stiffness];
        let k = [rest[0] + soft[0] * sum[0], soft[1] * sum[1], soft[2] * sum[2]];
        let mut dk = dsum;
        for i in 0..3 {
            for l in 0..W {
                dk[i][l] *= soft[i];
            }
        }
        let mut own = [[0.0; W]; 2 * OTHERS];
        for (i, tube) in self.piece.others.iter().enumerate() {
            let Some(tube) = tube else { continue };
            let (angle, torque) = (&y[ANGLES + i], &y[TORQUES + i]);
            let [a2, a3] = turned[i];
            let twist = 1.0 / tube.torsion;
            for l in 1..W {
                own[i][l] = twist * torque[l] - dk[0][l];
                own[OTHERS + i][l] =
                    tube.bending * (dk[1][l] * a3 - dk[2][l] * a2 + (k[1] * a2 + k[2] * a3) * angle[l]);
            }
            own[i][0] = entry(&tube.rest, step, stage)[0] + twist * torque[0] - k[0];
            own[OTHERS + i][0] = tube.bending * (k[1] * a3 - k[2] * a2);
        }
        (k, dk, own)
    }
}

#[cfg(test)]
mod tests;
