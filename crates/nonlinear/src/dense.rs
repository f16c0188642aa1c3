//! Dense LU with row-scaled partial pivoting, for the small system that is left after block elimination.

use crate::Breakdown;

/// A square matrix and its factorisation, storage kept from one use to the next.
#[derive(Debug, Default)]
pub struct Dense {
    n: usize,
    a: Vec<f64>,
    order: Vec<usize>,
    scale: Vec<f64>,
    work: Vec<f64>,
    positive: bool,
}

impl Clone for Dense {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, from: &Self) {
        (self.n, self.positive) = (from.n, from.positive);
        self.a.clone_from(&from.a);
        self.order.clone_from(&from.order);
        self.scale.clone_from(&from.scale);
    }
}

impl Dense {
    /// Makes it an `n` x `n` matrix of zeros.
    pub fn reset(&mut self, n: usize) {
        self.n = n;
        self.a.clear();
        self.a.resize(n * n, 0.0);
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.n
    }

    /// Row `i`, before factorisation.
    #[inline]
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.a[i * self.n..(i + 1) * self.n]
    }

    /// Row `i`, before factorisation.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.a[i * self.n..(i + 1) * self.n]
    }

    /// Adds to an entry, before factorisation.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.row_mut(row)[column] += value;
    }

    /// Factorises in place. Singular when a pivot is below 1e-14 of its row's largest entry.
    pub fn factorise(&mut self) -> Result<(), Breakdown> {
        let n = self.n;
        self.order.clear();
        self.order.extend(0..n);
        self.scale.clear();
        self.positive = true;
        for i in 0..n {
            let largest = self.a[i * n..(i + 1) * n].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            if !largest.is_finite() {
                return Err(Breakdown::NotFinite);
            }
            if largest == 0.0 {
                return Err(Breakdown::Singular);
            }
            self.scale.push(1.0 / largest);
        }
        for k in 0..n {
            let (mut pivot, mut best) = (k, -1.0);
            for i in k..n {
                let candidate = self.a[i * n + k].abs() * self.scale[i];
                if candidate > best {
                    (pivot, best) = (i, candidate);
                }
            }
            if !best.is_finite() {
                return Err(Breakdown::NotFinite);
            }
            if best < 1e-14 {
                return Err(Breakdown::Singular);
            }
            if pivot != k {
                let (upper, lower) = self.a.split_at_mut(pivot * n);
                upper[k * n..(k + 1) * n].swap_with_slice(&mut lower[..n]);
                self.order.swap(k, pivot);
                self.scale.swap(k, pivot);
                self.positive = !self.positive;
            }
            let (upper, lower) = self.a.split_at_mut((k + 1) * n);
            let top = &upper[k * n..];
            if top[k] < 0.0 {
                self.positive = !self.positive;
            }
            let inverse = 1.0 / top[k];
            for row in lower.chunks_exact_mut(n) {
                let factor = row[k] * inverse;
                row[k] = factor;
                if factor != 0.0 {
                    for (to, from) in row[k + 1..].iter_mut().zip(&top[k + 1..n]) {
                        *to -= factor * from;
                    }
                }
            }
        }
        Ok(())
    }

    /// Is the determinant positive?
    pub fn is_positive(&self) -> bool {
        self.positive
    }

    /// Solves in place.
    pub fn solve(&mut self, b: &mut [f64]) {
        let n = self.n;
        self.work.clear();
        self.work.extend(self.order.iter().map(|&i| b[i]));
        for i in 1..n {
            let sum: f64 = self.a[i * n..i * n + i].iter().zip(&self.work).map(|(l, x)| l * x).sum();
            self.work[i] -= sum;
        }
        for i in (0..n).rev() {
            let row = &self.a[i * n..(i + 1) * n];
            let sum: f64 = row[i + 1..].iter().zip(&self.work[i + 1..]).map(|(u, x)| u * x).sum();
            self.work[i] = (self.work[i] - sum) / row[i];
        }
        b.copy_from_slice(&self.work);
    }

    /// Solves Aᵀ x = b in place: with P A = L U, forward with Uᵀ and back with Lᵀ, along the rows of both.
    pub fn solve_transposed(&mut self, b: &mut [f64]) {
        let n = self.n;
        for i in 0..n {
            let row = &self.a[i * n..(i + 1) * n];
            let x = b[i] / row[i];
            b[i] = x;
            for (to, u) in b[i + 1..].iter_mut().zip(&row[i + 1..]) {
                *to -= x * u;
            }
        }
        for i in (1..n).rev() {
            let x = b[i];
            for (to, l) in b[..i].iter_mut().zip(&self.a[i * n..]) {
                *to -= x * l;
            }
        }
        self.work.clear();
        self.work.extend_from_slice(b);
        for (&i, &x) in self.order.iter().zip(&self.work) {
            b[i] = x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_system_whose_rows_differ_by_twenty_orders_of_magnitude() {
        let rows = [[0.0, 2.0, 1.0], [1e-20, 3e-20, -1e-20], [4e10, 1e10, 2e10]];
        let x = [1.0, -2.0, 3.0];
        let mut dense = Dense::default();
        dense.reset(3);
        let mut b = [0.0; 3];
        for i in 0..3 {
            dense.row_mut(i).copy_from_slice(&rows[i]);
            b[i] = rows[i].iter().zip(&x).map(|(a, x)| a * x).sum();
        }
        dense.factorise().unwrap();
        dense.solve(&mut b);
        for i in 0..3 {
            assert!((b[i] - x[i]).abs() < 1e-13);
        }
    }

    #[test]
    fn solves_with_the_transpose_what_a_transposed_matrix_solves() {
        for n in [1, 2, 7, 30] {
            let mut matrices = [Dense::default(), Dense::default()];
            matrices.iter_mut().for_each(|dense| dense.reset(n));
            for i in 0..n {
                for j in 0..n {
                    let v = ((1 + i * i + 5 * i * j + 3 * j) as f64).sin() * [1.0, 1e6, 1e-3][i % 3];
                    matrices[0].add(i, j, v);
                    matrices[1].add(j, i, v);
                }
            }
            let mut solutions = [(); 2].map(|()| (0..n).map(|i| (i as f64).cos()).collect::<Vec<_>>());
            matrices.iter_mut().for_each(|dense| dense.factorise().unwrap());
            matrices[0].solve_transposed(&mut solutions[0]);
            matrices[1].solve(&mut solutions[1]);
            let largest = solutions[1].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            for (x, y) in solutions[0].iter().zip(&solutions[1]) {
                assert!((x - y).abs() < 1e-11 * largest);
            }
        }
    }

    #[test]
    fn tells_the_sign_of_the_determinant_and_refuses_a_singular_matrix() {
        let mut dense = Dense::default();
        for (rows, positive) in [([[0.0, 1.0], [1.0, 0.0]], false), ([[2.0, 1.0], [1.0, 2.0]], true)] {
            dense.reset(2);
            dense.row_mut(0).copy_from_slice(&rows[0]);
            dense.row_mut(1).copy_from_slice(&rows[1]);
            dense.factorise().unwrap();
            assert_eq!(dense.is_positive(), positive);
        }
        dense.reset(2);
        dense.row_mut(0).copy_from_slice(&[1.0, 2.0]);
        dense.row_mut(1).copy_from_slice(&[2.0, 4.0]);
        assert_eq!(dense.factorise(), Err(Breakdown::Singular));
    }
}
