//! Symmetric matrices, of either or no sign, and how many eigenvalues of each sign they have.
//!
//! A = Lᵀ D L, up to scaling and an exchange of unknowns, with unit triangular L and D made of blocks of one and two
//! rows. By Sylvester's law of inertia A has as many positive, negative and zero eigenvalues as D. Blocks of two
//! are needed because a constraint has nothing on its diagonal to divide by.

mod dense;
mod rook;
mod scaling;

pub use dense::DenseSymmetric;
pub(crate) use rook::{exchange, inverse_of_two};
pub(crate) use scaling::equilibrate;

use crate::{BlockPlace, Breakdown, SparseSymmetric};

/// Matrices of more unknowns are sparse. For lattices of beams, assembly, factorisation and one solution cost the same
/// at about 75 unknowns (15 us); at 120 the sparse matrix takes 25 to 35 us and the dense one 55 us, at 240 it is 50
/// against 210 us. Where the difference is microseconds the dense one stays, for all rows may give its pivots.
const LARGEST_DENSE: usize = 100;

/// A pivot below this part of the largest number about is zero, in a matrix of `n` rows: round-off adds up like √n. Of
/// lattices that float, with up to 64,000 unknowns, what should be zero is left with at most half of this.
pub(crate) fn tiny(n: usize) -> f64 {
    1e-14 * (1.0 + n as f64 / 100.0).sqrt()
}

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
    /// The entries of one triangle that were added to.
    Sparse(Box<SparseSymmetric>),
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
            Self::Sparse(sparse) => Self::Sparse(sparse.clone()),
        }
    }

    fn clone_from(&mut self, from: &Self) {
        match (self, from) {
            (Self::Dense(to), Self::Dense(from)) => to.clone_from(from),
            (Self::Sparse(to), Self::Sparse(from)) => to.clone_from(from),
            (to, from) => *to = from.clone(),
        }
    }
}

impl Symmetric {
    /// Makes it an `n` x `n` matrix of zeros whose unknowns come in `blocks`. To be called whenever the unknowns
    /// change, and then only: a sparse matrix forgets its pattern.
    pub fn arrange(&mut self, n: usize, blocks: &[BlockPlace]) {
        if n <= LARGEST_DENSE {
            if let Self::Sparse(_) = self {
                *self = Self::default();
            }
        } else if let Self::Dense(_) = self {
            *self = Self::Sparse(Box::default());
        }
        match self {
            Self::Dense(dense) => dense.arrange(n),
            Self::Sparse(sparse) => sparse.arrange(n, blocks),
        }
    }

    /// Sets all entries to zero and starts a new assembly. The factors stay.
    pub fn reset(&mut self) {
        match self {
            Self::Dense(dense) => dense.reset(),
            Self::Sparse(sparse) => sparse.reset(),
        }
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        match self {
            Self::Dense(dense) => dense.size(),
            Self::Sparse(sparse) => sparse.size(),
        }
    }

    /// Adds to an entry of A, one side of the diagonal at a time.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        match self {
            Self::Dense(dense) => dense.add(row, column, value),
            Self::Sparse(sparse) => sparse.add(row, column, value),
        }
    }

    /// Calls `f(row, column, value)` for the entries of (A + Aᵀ)/2 on both sides of the diagonal, which factorisation
    /// leaves as they are; of a dense matrix for those that are not zero. What has been added to a new entry of a
    /// sparse matrix since its last factorisation may come in several pieces.
    pub fn for_each(&self, f: impl FnMut(usize, usize, f64)) {
        match self {
            Self::Dense(dense) => dense.for_each(f),
            Self::Sparse(sparse) => sparse.for_each(f),
        }
    }

    /// Factorises and counts the signs of the eigenvalues. Fails only where an entry is not a finite number. The
    /// matrix being scaled to a largest entry of about one in each row, an eigenvalue is zero where all that
    /// elimination leaves of a row is below about 1e-14 of the largest pivot before it.
    pub fn factorise(&mut self) -> Result<Inertia, Breakdown> {
        match self {
            Self::Dense(dense) => dense.factorise(),
            Self::Sparse(sparse) => sparse.factorise(),
        }
    }

    /// Solves in place. A zero pivot counts as the largest number that would have been taken for zero, with the sign
    /// that round-off gave it, so that a few solutions from a generic start give a null vector by inverse iteration.
    /// Without factors the result is not a number.
    pub fn solve(&mut self, b: &mut [f64]) {
        match self {
            Self::Dense(dense) => dense.solve(b),
            Self::Sparse(sparse) => sparse.solve(b),
        }
    }
}

#[cfg(test)]
mod tests;
