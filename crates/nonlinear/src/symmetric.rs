//! Symmetric matrices, of either or no sign, and how many eigenvalues of each sign they have.
//!
//! A = Lᵀ D L, up to scaling and an exchange of unknowns, with unit triangular L and D made of blocks of one and two
//! rows. By Sylvester's law of inertia A has as many positive, negative and zero eigenvalues as D. Blocks of two
//! are needed because a constraint has nothing on its diagonal to divide by.

mod dense;
mod rook;
mod scaling;

pub use dense::DenseSymmetric;

use crate::{BlockPlace, Breakdown};

/// Beside the largest number about, a pivot below this part of it is zero.
pub(crate) const TINY: f64 = 1e-14;

/// Numbers of positive, negative and (numerically) zero eigenvalues.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inertia {
    /// Of positive eigenvalues.
    pub positive: usize,
    /// Of negative eigenvalues.
    pub negative: usize,
    /// Of eigenvalues that cannot be told from zero.
    pub zero: usize,
}

impl Inertia {
    /// Counts the sign of a pivot.
    #[inline(always)]
    pub(crate) fn count(&mut self, pivot: f64) {
        if pivot < 0.0 {
            self.negative += 1;
        } else {
            self.positive += 1;
        }
    }
}

/// A symmetric matrix and its factorisation, storage kept from one use to the next.
///
/// [`Symmetric::arrange`] tells the layout, [`Symmetric::reset`] and [`Symmetric::add`] assemble, and
/// [`Symmetric::factorise`] gives the inertia and the factors for [`Symmetric::solve`]. Entries are added on both sides
/// of the diagonal. Where the sides differ the matrix is the mean of them, (A + Aᵀ)/2.
#[derive(Debug)]
pub enum Symmetric {
    /// All entries of one triangle, row by row.
    Dense(DenseSymmetric),
}

impl Default for Symmetric {
    fn default() -> Self {
        Self::Dense(DenseSymmetric::default())
    }
}

impl Clone for Symmetric {
    fn clone(&self) -> Self {
        match self {
            Self::Dense(dense) => Self::Dense(dense.clone()),
        }
    }

    fn clone_from(&mut self, from: &Self) {
        match (self, from) {
            (Self::Dense(to), Self::Dense(from)) => to.clone_from(from),
        }
    }
}

impl Symmetric {
    /// Makes it an `n` x `n` matrix of zeros whose unknowns come in `blocks`. To be called whenever the unknowns
    /// change, and then only: a sparse matrix forgets its pattern.
    pub fn arrange(&mut self, n: usize, _blocks: &[BlockPlace]) {
        match self {
            Self::Dense(dense) => dense.reset(n),
        }
    }

    /// Sets all entries to zero and starts a new assembly. The factors stay as long as the size does.
    pub fn reset(&mut self) {
        match self {
            Self::Dense(dense) => dense.reset(dense.size()),
        }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        match self {
            Self::Dense(dense) => dense.size(),
        }
    }

    /// Adds to an entry of A, one side of the diagonal at a time.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        match self {
            Self::Dense(dense) => dense.add(row, column, value),
        }
    }

    /// Calls `f(row, column, value)` for the entries of (A + Aᵀ)/2 on both sides of the diagonal, which factorisation
    /// leaves as they are; of a dense matrix for those that are not zero. What has been added to a new entry of a
    /// sparse matrix since its last factorisation may come in several pieces.
    pub fn for_each(&self, f: impl FnMut(usize, usize, f64)) {
        match self {
            Self::Dense(dense) => dense.for_each(f),
        }
    }

    /// Factorises and counts the signs of the eigenvalues. Fails only where an entry is not a finite number. The
    /// matrix being scaled to largest entries of about one in each row, a pivot is zero if it and all that is left
    /// of its row are below 1e-14 of the largest pivot before it.
    pub fn factorise(&mut self) -> Result<Inertia, Breakdown> {
        match self {
            Self::Dense(dense) => dense.factorise(),
        }
    }

    /// Solves in place. Zero pivots count as 1e-14 of the largest before them, with the sign that round-off left
    /// them, so that a few solutions from a generic start give a null vector by inverse iteration. Without factors
    /// the result is not a number.
    pub fn solve(&mut self, b: &mut [f64]) {
        match self {
            Self::Dense(dense) => dense.solve(b),
        }
    }
}

#[cfg(test)]
mod tests;
