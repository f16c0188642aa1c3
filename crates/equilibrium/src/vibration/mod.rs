//! Stiffness and inertia of an equilibrium, or of the state at rest, as matrices of finite size.
//!
//! Beams are cut into elements of high order (`cut`, `rule`) on the solved shape: the tangent of virtual work (`element`) holds all that
//! the exact rod's has, so that natural frequencies converge like the square of what the polynomials of an element leave of a mode,
//! and nothing but the number of elements and their order stands between them and those of the rod. Joints, springs, cables, loads and
//! couplings add what they add to the tangent of the equilibrium. The unknowns are
//!
//! ```text
//!            motions    wrenches and multipliers
//!          [    K             Bᵀ      ]           [ M  0 ]
//!          [    B            -C       ]     ω²    [ 0  0 ]
//! ```
//!
//! with C the small or vanishing compliance of beams that are all but rigid in stretching or shear. Where there is an energy K is
//! symmetric, and for a shift σ the number of negative eigenvalues of the whole less σ M, less the number of rows below, is the
//! number of ω² below σ (J. Nocedal and S. J. Wright, *Numerical Optimization*, 2nd ed., 2006, theorem 16.3): the count by which
//! W. H. Wittrick and F. W. Williams, *Q. J. Mech. Appl. Math.* 24 (1971) 263, make sure that no mode is missed.
//!
//! Inertia is that of the axis's shift and of the sections' turning, ½ ∫ ρA |u̇|² + Ω·J Ω ds by Gauss-Lobatto sums, and of bodies and
//! lumped masses. Hubs have none.

mod assemble;
mod cut;
mod damping;
mod drive;
mod element;
mod mass;
mod rule;
mod shape;
mod tail;
mod tendon;

pub use shape::Swing;

use crate::layout::Layout;
use cut::Elements;
use flexura_nonlinear::BlockPlace;

/// How finely beams are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detail {
    /// Order of the elements, 2 at least.
    pub order: usize,
    /// Elements are so short that no wave of ω² up to this (rad²/s²) turns through more than [`Detail::phase`] in one of them.
    pub square: f64,
    /// rad.
    pub phase: f64,
}

/// Stiffness and inertia about one state, nondimensional but for [`Vibration::unit`].
#[derive(Clone, Debug)]
pub struct Vibration {
    /// Number of unknowns.
    pub size: usize,
    /// How many of them are wrenches and multipliers.
    pub multipliers: usize,
    /// Entries of the stiffness: row, column, value; several of one place add up.
    pub stiffness: Vec<(usize, usize, f64)>,
    /// The same of the inertia, which is symmetric.
    pub inertia: Vec<(usize, usize, f64)>,
    /// The same of what resists the rates of motions, none where nothing does: time in units of 1/√unit. In rows of wrenches
    /// it is the rate's part of a damped strain, so that it is symmetric among vectors that satisfy these rows alone:
    /// for modes of the undamped pencil xᵢ·D xⱼ is the modal damping matrix.
    pub damping: Vec<(usize, usize, f64)>,
    /// The same of what a spinning frame does to the rates, antisymmetric; none where nothing spins.
    pub gyroscopic: Vec<(usize, usize, f64)>,
    /// Is the stiffness the second variation of an energy?
    pub has_energy: bool,
    /// Inertia times the shifts of everything along x, y and z, then its turnings about these axes through the centre of mass.
    pub rigid: [Vec<f64>; 6],
    /// What takes part in them: mass (kg) three times, then moments of inertia about the centre of mass (kg·m²).
    pub whole: [f64; 6],
    /// ω² of 1, rad²/s².
    pub unit: f64,
    /// Mass of 1, kg, and length of 1, m.
    pub mass: f64,
    /// m.
    pub length: f64,
    /// The unknowns in blocks with their places, for the elimination's order.
    pub blocks: Vec<BlockPlace>,
    /// Number of elements.
    pub elements: usize,
    columns: Vec<Option<usize>>,
    spans: Vec<Elements>,
    layout: Layout,
}
