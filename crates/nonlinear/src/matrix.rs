//! A square matrix, dense or sparse as its size asks for.

use crate::{BlockPlace, Breakdown, Dense, Sparse};

/// Matrices of more unknowns are sparse. For lattices of beams, assembly, factorisation and one solution cost the
/// same at about 120 unknowns (40 us); at 240 the sparse matrix takes 80 us and the dense one 210 us, at 490 it is 280
/// against 1960 us. Where the difference is microseconds the dense one stays, for all rows may give its pivots.
const LARGEST_DENSE: usize = 200;

/// A square matrix and its factorisation, storage kept from one use to the next.
///
/// [`Matrix::arrange`] tells the layout, [`Matrix::reset`] and [`Matrix::add`] assemble, and after
/// [`Matrix::factorise`] the matrix can be asked for the sign of its determinant and for solutions, until the next
/// reset.
#[derive(Debug)]
pub enum Matrix {
    /// All entries, row by row.
    Dense(Dense),
    /// The entries that were added to.
    Sparse(Box<Sparse>),
}

impl Default for Matrix {
    fn default() -> Self {
        Self::Dense(Dense::default())
    }
}

impl Clone for Matrix {
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

impl Matrix {
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
            Self::Dense(dense) => dense.reset(n),
            Self::Sparse(sparse) => sparse.arrange(n, blocks),
        }
    }

    /// Sets all entries to zero.
    pub fn reset(&mut self) {
        match self {
            Self::Dense(dense) => dense.reset(dense.size()),
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

    /// Adds to an entry, before factorisation.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        match self {
            Self::Dense(dense) => dense.add(row, column, value),
            Self::Sparse(sparse) => sparse.add(row, column, value),
        }
    }

    /// Calls `f(row, column, value)` for the entries, before factorisation; of a dense matrix for those that are
    /// not zero.
    pub fn for_each(&self, mut f: impl FnMut(usize, usize, f64)) {
        match self {
            Self::Dense(dense) => {
                for i in 0..dense.size() {
                    for (j, &value) in dense.row(i).iter().enumerate() {
                        if value != 0.0 {
                            f(i, j, value);
                        }
                    }
                }
            }
            Self::Sparse(sparse) => sparse.for_each(f),
        }
    }

    /// Factorises. Singular when a pivot is below 1e-14 of its row's largest entry.
    pub fn factorise(&mut self) -> Result<(), Breakdown> {
        match self {
            Self::Dense(dense) => dense.factorise(),
            Self::Sparse(sparse) => sparse.factorise(),
        }
    }

    /// Is the determinant positive?
    pub fn is_positive(&self) -> bool {
        match self {
            Self::Dense(dense) => dense.is_positive(),
            Self::Sparse(sparse) => sparse.is_positive(),
        }
    }

    /// Solves in place.
    pub fn solve(&mut self, b: &mut [f64]) {
        match self {
            Self::Dense(dense) => dense.solve(b),
            Self::Sparse(sparse) => sparse.solve(b),
        }
    }

    /// Solves Aᵀ x = b in place.
    pub fn solve_transposed(&mut self, b: &mut [f64]) {
        match self {
            Self::Dense(dense) => dense.solve_transposed(b),
            Self::Sparse(sparse) => sparse.solve_transposed(b),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring of unknowns, each tied to its neighbours.
    fn fill(matrix: &mut Matrix, n: usize) {
        matrix.reset();
        for i in 0..n {
            matrix.add(i, i, 2.0);
            matrix.add(i, i, 1.5);
            matrix.add(i, (i + 1) % n, -1.0);
            matrix.add((i + 1) % n, i, -0.5);
        }
    }

    #[test]
    fn solves_the_same_way_at_every_size() {
        let mut matrix = Matrix::default();
        let mut kept = Matrix::default();
        for n in [4, LARGEST_DENSE + 1, 3, 2 * LARGEST_DENSE] {
            let blocks: Vec<BlockPlace> =
                (0..n).map(|i| BlockPlace { first: i, count: 1, place: [i as f64, 0.0, 0.0] }).collect();
            matrix.arrange(n, &blocks);
            assert_eq!(matches!(matrix, Matrix::Sparse(_)), n > LARGEST_DENSE);
            for _ in 0..2 {
                fill(&mut matrix, n);
                let (mut b, mut c) = (vec![0.0; n], vec![0.0; n]);
                matrix.for_each(|i, j, v| {
                    b[i] += v * (1.0 + j as f64);
                    c[j] += v * (1.0 + i as f64);
                });
                matrix.factorise().unwrap();
                assert!(matrix.is_positive());
                kept.clone_from(&matrix);
                for matrix in [&mut matrix, &mut kept] {
                    assert_eq!(matrix.size(), n);
                    let (mut x, mut y) = (b.clone(), c.clone());
                    matrix.solve(&mut x);
                    matrix.solve_transposed(&mut y);
                    for (i, x) in x.iter().enumerate() {
                        assert!((x - 1.0 - i as f64).abs() < 1e-12 * n as f64);
                        assert!((y[i] - 1.0 - i as f64).abs() < 1e-12 * n as f64);
                    }
                }
            }
        }
    }
}
