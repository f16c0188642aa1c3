//! Carries a rod's state, and its derivatives along up to `W - 1` directions, from the start of a piece to
//! its end.
//!
//! A piece is a stretch of a beam on which everything is smooth. It is integrated in its own start frame:
//! positions there are small, and the constant wrench of a stretch without distributed load enters as a
//! parameter, so that only the pose (7 numbers) is integrated.

use super::balance::{
    FULL_ROWS, Lanes, Matrix, POSE_ROWS, add, apply, apply_lanes, apply_transposed, apply_transposed_lanes,
    conserved_moment, cross, cross_lanes, pose_rate, rotation, sub, wrench_rate,
};
use super::constitutive::{Coupled, Law, Shearable, Slender};
use super::foundation::{Footing, Foundation};
use crate::ode::{self, Rate, STAGES, State};

/// The law at every stage of every step, or once where it is the same everywhere.
#[derive(Clone, Debug)]
pub enum LawTable {
    /// Unshearable with diagonal compliance.
    Slender(Vec<Slender>),
    /// Shearable with diagonal compliance.
    Shearable(Vec<Shearable>),
    /// Any compliance.
    Coupled(Vec<Coupled>),
}

/// Distributed load at one place, per undeformed length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoadSample {
    /// Dead force, global axes.
    pub dead_force: [f64; 3],
    /// Dead moment, global axes.
    pub dead_moment: [f64; 3],
    /// Force in the section's axes.
    pub section_force: [f64; 3],
    /// Moment in the section's axes.
    pub section_moment: [f64; 3],
}

impl LoadSample {
    /// `load` times the load: its dead part in the start frame with its lanes, and its section's part.
    #[inline(always)]
    pub(super) fn localised<const W: usize>(
        &self,
        load: f64,
        r0: &Matrix,
        dtheta: &Lanes<W>,
    ) -> ([Lanes<W>; 2], [[f64; 3]; 2]) {
        let scaled = |a: &[f64; 3]| [load * a[0], load * a[1], load * a[2]];
        let zero = [[0.0; W]; 3];
        let dead = [
            localised(r0, &scaled(&self.dead_force), &zero, dtheta),
            localised(r0, &scaled(&self.dead_moment), &zero, dtheta),
        ];
        (dead, [scaled(&self.section_force), scaled(&self.section_moment)])
    }
}

/// A smooth stretch of a beam, cut into equal steps.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Undeformed length.
    pub length: f64,
    /// Number of integration steps.
    pub steps: usize,
    /// One law, or `steps * STAGES` of them.
    pub laws: LawTable,
    /// No distributed load (empty), one for all places, or `steps * STAGES`.
    pub loads: Vec<LoadSample>,
    /// An elastic foundation.
    pub foundation: Option<Foundation>,
}

/// The state of a rod at one section, global axes, with derivatives in lanes 1.. of `d`.
#[derive(Clone, Copy, Debug)]
pub struct RodState<const W: usize> {
    /// Unit quaternion (w, x, y, z), section to global.
    pub rotation: [f64; 4],
    /// Position of the axis.
    pub position: [f64; 3],
    /// Internal force, by the part beyond on the part before.
    pub force: [f64; 3],
    /// Internal moment, likewise.
    pub moment: [f64; 3],
    /// Derivatives of (rotation as a small global turning, position, force, moment); lane 0 is unused.
    pub d: [[f64; W]; 12],
}

impl<const W: usize> RodState<W> {
    /// A state at rest at the origin.
    pub fn origin() -> Self {
        Self {
            rotation: [1.0, 0.0, 0.0, 0.0],
            position: [0.0; 3],
            force: [0.0; 3],
            moment: [0.0; 3],
            d: [[0.0; W]; 12],
        }
    }

    pub(super) fn rows(&self, first: usize) -> Lanes<W> {
        [self.d[first], self.d[first + 1], self.d[first + 2]]
    }

    fn set_rows(&mut self, first: usize, lanes: &Lanes<W>) {
        self.d[first..first + 3].copy_from_slice(lanes);
        for row in &mut self.d[first..first + 3] {
            row[0] = 0.0;
        }
    }
}

/// [`super::advance`] of any width.
pub(super) fn advance<const W: usize>(piece: &Piece, load: f64, state: &mut RodState<W>) {
    #[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, as was just asked.
        unsafe { advance_avx2(piece, load, state) };
        return;
    }
    dispatch(piece, load, state);
}

/// The same kernel compiled for four lanes at a time. No fused multiply-add: both builds give equal bits.
#[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
#[target_feature(enable = "avx2")]
fn advance_avx2<const W: usize>(piece: &Piece, load: f64, state: &mut RodState<W>) {
    dispatch(piece, load, state);
}

#[inline(always)]
fn dispatch<const W: usize>(piece: &Piece, load: f64, state: &mut RodState<W>) {
    match &piece.laws {
        LawTable::Slender(laws) => run(piece, laws, load, state),
        LawTable::Shearable(laws) => run(piece, laws, load, state),
        LawTable::Coupled(laws) => run(piece, laws, load, state),
    }
}

/// Entry `stage` of step `step` in a table that holds one entry or one for every stage.
#[inline(always)]
pub(super) fn entry<T>(table: &[T], step: usize, stage: usize) -> &T {
    if table.len() == 1 { &table[0] } else { &table[step * STAGES + stage] }
}

/// A quantity `a` that turns with the start frame, with its change: `Rᵀ a` and `Rᵀ(δa - δθ × a)`.
#[inline(always)]
pub(super) fn localised<const W: usize>(
    r0: &Matrix,
    a: &[f64; 3],
    da: &Lanes<W>,
    dtheta: &Lanes<W>,
) -> Lanes<W> {
    let mut local = apply_transposed_lanes(r0, &add(da, &cross_lanes(a, dtheta)));
    let value = apply_transposed(r0, a);
    for i in 0..3 {
        local[i][0] = value[i];
    }
    local
}

/// A stretch without distributed load: the wrench is conserved, only the pose has a rate.
struct Unloaded<'a, L, const W: usize> {
    laws: &'a [L],
    force: Lanes<W>,
    moment: Lanes<W>,
}

impl<L: Law, const W: usize> Rate<POSE_ROWS, W> for Unloaded<'_, L, W> {
    #[inline(always)]
    fn rate(&self, step: usize, stage: usize, y: &State<POSE_ROWS, W>) -> State<POSE_ROWS, W> {
        let moment = conserved_moment(&[y[4], y[5], y[6]], &self.force, &self.moment);
        pose_rate(&[y[0], y[1], y[2], y[3]], &self.force, &moment, entry(self.laws, step, stage)).0
    }
}

/// A stretch with distributed load: force and moment have rates too.
struct Loaded<'a, L, const W: usize> {
    laws: &'a [L],
    samples: &'a [LoadSample],
    load: f64,
    r0: Matrix,
    dtheta: Lanes<W>,
}

impl<L: Law, const W: usize> Rate<FULL_ROWS, W> for Loaded<'_, L, W> {
    #[inline(always)]
    fn rate(&self, step: usize, stage: usize, y: &State<FULL_ROWS, W>) -> State<FULL_ROWS, W> {
        let q = [y[0], y[1], y[2], y[3]];
        let force = [y[7], y[8], y[9]];
        let moment = [y[10], y[11], y[12]];
        let (rate, r, along) = pose_rate(&q, &force, &moment, entry(self.laws, step, stage));
        let sample = entry(self.samples, step, stage);
        let (dead, section) = sample.localised(self.load, &self.r0, &self.dtheta);
        wrench_rate(&rate, &q, &r, &along, &force, &dead, &section)
    }
}

/// A stretch on an elastic foundation, which acts in full whatever the load.
struct Founded<'a, L, const W: usize> {
    loaded: Loaded<'a, L, W>,
    footing: Footing<'a, W>,
}

impl<L: Law, const W: usize> Rate<FULL_ROWS, W> for Founded<'_, L, W> {
    #[inline(always)]
    fn rate(&self, step: usize, stage: usize, y: &State<FULL_ROWS, W>) -> State<FULL_ROWS, W> {
        let Loaded { laws, samples, load, r0, dtheta } = &self.loaded;
        let q = [y[0], y[1], y[2], y[3]];
        let force = [y[7], y[8], y[9]];
        let moment = [y[10], y[11], y[12]];
        let (rate, r, along) = pose_rate(&q, &force, &moment, entry(laws, step, stage));
        let sample = match samples.is_empty() {
            true => LoadSample::default(),
            false => *entry(samples, step, stage),
        };
        let (mut dead, section) = sample.localised(*load, r0, dtheta);
        dead[0] = add(&dead[0], &self.footing.force(step, stage, &[y[4], y[5], y[6]]));
        if let Some(moment) = self.footing.moment(step, stage, &q) {
            dead[1] = add(&dead[1], &moment);
        }
        wrench_rate(&rate, &q, &r, &along, &force, &dead, &section)
    }
}

/// Pose and wrench at the end of a stretch whose wrench has a rate, in its start frame.
#[inline(always)]
pub(super) fn through<const W: usize>(
    piece: &Piece,
    force: &Lanes<W>,
    moment: &Lanes<W>,
    system: &impl Rate<FULL_ROWS, W>,
) -> (State<POSE_ROWS, W>, Lanes<W>, Lanes<W>) {
    let h = piece.length / piece.steps as f64;
    let mut y: State<FULL_ROWS, W> = [[0.0; W]; FULL_ROWS];
    y[0][0] = 1.0;
    y[7..10].copy_from_slice(force);
    y[10..13].copy_from_slice(moment);
    let mut rates = ode::workspace();
    for i in 0..piece.steps {
        y = ode::step(&y, h, i, system, &mut rates);
    }
    let mut pose = [[0.0; W]; POSE_ROWS];
    pose.copy_from_slice(&y[..POSE_ROWS]);
    (pose, [y[7], y[8], y[9]], [y[10], y[11], y[12]])
}

#[inline(always)]
fn run<L: Law, const W: usize>(piece: &Piece, laws: &[L], load: f64, state: &mut RodState<W>) {
    let (r0, _) = rotation(&state.rotation);
    let dtheta0 = state.rows(0);
    let force0 = localised(&r0, &state.force, &state.rows(6), &dtheta0);
    let moment0 = localised(&r0, &state.moment, &state.rows(9), &dtheta0);
    let loaded = Loaded { laws, samples: &piece.loads, load, r0, dtheta: dtheta0 };
    let (pose, force, moment) = if let Some(foundation) = &piece.foundation {
        let start = (state.position, state.rows(3));
        let footing = Footing { foundation, r0, dtheta: dtheta0, start, load };
        through(piece, &force0, &moment0, &Founded { loaded, footing })
    } else if piece.loads.is_empty() {
        let system = Unloaded { laws, force: force0, moment: moment0 };
        let h = piece.length / piece.steps as f64;
        let mut y: State<POSE_ROWS, W> = [[0.0; W]; POSE_ROWS];
        y[0][0] = 1.0;
        let mut rates = ode::workspace();
        for i in 0..piece.steps {
            y = ode::step(&y, h, i, &system, &mut rates);
        }
        let moment = conserved_moment(&[y[4], y[5], y[6]], &force0, &moment0);
        (y, force0, moment)
    } else {
        through(piece, &force0, &moment0, &loaded)
    };
    globalise(&r0, &pose, &force, &moment, state);
}

/// Puts the end of a piece, found in the piece's start frame, back into global axes.
#[inline(always)]
pub(super) fn globalise<const W: usize>(
    r0: &Matrix,
    pose: &State<POSE_ROWS, W>,
    force: &Lanes<W>,
    moment: &Lanes<W>,
    state: &mut RodState<W>,
) {
    let q = [pose[0][0], pose[1][0], pose[2][0], pose[3][0]];
    let two = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    // δθ = 2 Im(δq q⁻¹), in the start frame.
    let mut turning = [[0.0; W]; 3];
    for l in 0..W {
        let (dw, dx, dy, dz) = (pose[0][l], pose[1][l], pose[2][l], pose[3][l]);
        turning[0][l] = two * (q[0] * dx - q[1] * dw - (dy * q[3] - dz * q[2]));
        turning[1][l] = two * (q[0] * dy - q[2] * dw - (dz * q[1] - dx * q[3]));
        turning[2][l] = two * (q[0] * dz - q[3] * dw - (dx * q[2] - dy * q[1]));
    }
    let dtheta0 = state.rows(0);
    let arm = apply(r0, &[pose[4][0], pose[5][0], pose[6][0]]);
    let dtheta = add(&dtheta0, &apply_lanes(r0, &turning));
    // δp = δp0 + δθ0 × (R0 p) + R0 δp.
    let shift = apply_lanes(r0, &[pose[4], pose[5], pose[6]]);
    let dposition = add(&state.rows(3), &sub(&shift, &cross_lanes(&arm, &dtheta0)));
    let global = |a: &Lanes<W>| {
        let value = apply(r0, &[a[0][0], a[1][0], a[2][0]]);
        (value, sub(&apply_lanes(r0, a), &cross_lanes(&value, &dtheta0)))
    };
    let (force, dforce) = global(force);
    let (moment, dmoment) = global(moment);
    state.force = force;
    state.moment = moment;
    for i in 0..3 {
        state.position[i] += arm[i];
    }
    state.rotation = unit_product(&state.rotation, &q);
    state.set_rows(0, &dtheta);
    state.set_rows(3, &dposition);
    state.set_rows(6, &dforce);
    state.set_rows(9, &dmoment);
}

/// The quaternion product `a b`, brought to length one.
pub(super) fn unit_product(a: &[f64; 4], b: &[f64; 4]) -> [f64; 4] {
    let vector = cross(&[a[1], a[2], a[3]], &[b[1], b[2], b[3]]);
    let q = [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + b[0] * a[1] + vector[0],
        a[0] * b[2] + b[0] * a[2] + vector[1],
        a[0] * b[3] + b[0] * a[3] + vector[2],
    ];
    let scale = 1.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    [q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale]
}

#[cfg(test)]
pub(crate) mod tests;
