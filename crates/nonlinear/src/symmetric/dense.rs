//! A symmetric matrix with all its entries, and its factors.

use super::Inertia;
use super::rook::{Rook, factorise};
use crate::Breakdown;

/// A dense symmetric matrix and its factorisation S A S = Pᵀ Lᵀ D L P with powers of two in S; storage is kept from one
/// use to the next.
#[derive(Debug, Default)]
pub struct DenseSymmetric {
    n: usize,
    /// The upper triangle of (A + Aᵀ)/2 by rows.
    a: Vec<f64>,
    /// L and the inverse of D.
    factors: Vec<f64>,
    order: Vec<usize>,
    is_pair: Vec<bool>,
    scale: Vec<f64>,
    work: Vec<f64>,
}

impl Clone for DenseSymmetric {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, from: &Self) {
        self.n = from.n;
        self.a.clone_from(&from.a);
        self.factors.clone_from(&from.factors);
        self.order.clone_from(&from.order);
        self.is_pair.clone_from(&from.is_pair);
        self.scale.clone_from(&from.scale);
    }
}

impl DenseSymmetric {
    /// Makes it an `n` x `n` matrix of zeros.
    pub fn arrange(&mut self, n: usize) {
        self.n = n;
        self.a.clear();
        self.a.resize(n * n, 0.0);
        self.order.clear();
    }

    /// Sets all entries to zero. The factors stay.
    pub fn reset(&mut self) {
        self.a.fill(0.0);
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.n
    }

    /// Adds to an entry of A, one side of the diagonal at a time.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let (first, second) = (row.min(column), row.max(column));
        self.a[first * self.n..(first + 1) * self.n][second] +=
            if row == column { value } else { 0.5 * value };
    }

    /// Calls `f(row, column, value)` for the entries of (A + Aᵀ)/2 that are not zero.
    pub fn for_each(&self, mut f: impl FnMut(usize, usize, f64)) {
        for i in 0..self.n {
            for j in 0..self.n {
                let value = self.a[i.min(j) * self.n + i.max(j)];
                if value != 0.0 {
                    f(i, j, value);
                }
            }
        }
    }

    /// Factorises; the entries stay. See [`crate::Symmetric::factorise`].
    pub fn factorise(&mut self) -> Result<Inertia, Breakdown> {
        let n = self.n;
        self.factors.clone_from(&self.a);
        self.order.clear();
        self.order.extend(0..n);
        self.is_pair.resize(n, false);
        self.scale.resize(n, 0.0);
        self.work.resize(n, 0.0);
        if n == 0 {
            return Ok(Inertia::default());
        }
        let inertia = factorise(&mut Rook {
            a: &mut self.factors,
            order: &mut self.order,
            is_pair: &mut self.is_pair,
            scale: &mut self.scale,
            room: &mut self.work,
        });
        if inertia.is_err() {
            self.order.clear();
        }
        inertia
    }

    /// Solves in place. See [`crate::Symmetric::solve`].
    pub fn solve(&mut self, b: &mut [f64]) {
        let n = self.n;
        if self.order.len() != n {
            b.fill(f64::NAN);
            return;
        }
        let y = &mut self.work;
        y.clear();
        y.extend(self.order.iter().map(|&i| b[i] * self.scale[i]));
        let row = |k: usize| &self.factors[k * n..(k + 1) * n];
        let mut k = 0;
        while k < n {
            let (done, rest) = y.split_at_mut(k + 1);
            if self.is_pair[k] {
                let (one, two) = (done[k], rest[0]);
                let (first, second) = (row(k), row(k + 1));
                for ((to, a), b) in rest[1..].iter_mut().zip(&first[k + 2..]).zip(&second[k + 2..]) {
                    *to -= one * a + two * b;
                }
                done[k] = first[k] * one + first[k + 1] * two;
                rest[0] = first[k + 1] * one + second[k + 1] * two;
                k += 2;
            } else {
                for (to, a) in rest.iter_mut().zip(&row(k)[k + 1..]) {
                    *to -= done[k] * a;
                }
                done[k] *= row(k)[k];
                k += 1;
            }
        }
        for k in (0..n).rev() {
            // What stands beside the diagonal of a pair is D's.
            let next = if self.is_pair[k] { k + 2 } else { k + 1 };
            let sum: f64 = row(k)[next..].iter().zip(&y[next..]).map(|(a, x)| a * x).sum();
            y[k] -= sum;
        }
        for (&i, y) in self.order.iter().zip(&self.work) {
            b[i] = y * self.scale[i];
        }
    }
}
