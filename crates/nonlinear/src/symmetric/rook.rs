//! Elimination of a dense symmetric matrix with pivots of one and two rows.
//!
//! Rook pivoting: a pivot of one row is at least α of the largest number in its row; one of two rows stands around a
//! number that is the largest in both, each diagonal being below α of it. With α = (1 + √17)/8 the growth of
//! two steps by one equals that of one step by two, and the entries of L stay below 2.8, so that signs of pivots
//! are those of a matrix close by (J. R. Bunch and L. Kaufman, "Some stable methods for calculating inertia and solving
//! symmetric linear systems", Math. Comp. 31 (1977) 163-179; C. Ashcraft, R. G. Grimes and J. G. Lewis, "Accurate
//! symmetric indefinite linear equation solvers", SIAM J. Matrix Anal. Appl. 20 (1998) 513-561).

use super::scaling::equilibrate;
use super::{Inertia, tiny};
use crate::Breakdown;
use crate::lanes::{all_finite, largest, largest_product, subtract};

const ALPHA: f64 = 0.640_388_203_202_207_6;

/// A matrix and what elimination makes of it.
pub(super) struct Rook<'a> {
    /// The upper triangle by rows; below it stand finite numbers. At the end unit upper L without its diagonal, and the
    /// inverse of D in the places of D.
    pub a: &'a mut [f64],
    /// Which unknown stands at each place.
    pub order: &'a mut [usize],
    /// Does a pivot of two rows begin here?
    pub is_pair: &'a mut [bool],
    /// By unknown.
    pub scale: &'a mut [f64],
    /// Room for a number of each row.
    pub room: &'a mut [f64],
}

/// Scales and eliminates.
pub(super) fn factorise(rook: &mut Rook) -> Result<Inertia, Breakdown> {
    #[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, as was just asked.
        return unsafe { factorise_avx2(rook) };
    }
    factorise_inline(rook)
}

/// The same compiled for four lanes at a time. No fused multiply-add: both builds give equal bits.
#[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
#[target_feature(enable = "avx2")]
fn factorise_avx2(rook: &mut Rook) -> Result<Inertia, Breakdown> {
    factorise_inline(rook)
}

enum Pivot {
    Zero,
    One(usize),
    Two(usize, usize),
}

#[inline(always)]
fn factorise_inline(rook: &mut Rook) -> Result<Inertia, Breakdown> {
    rook.equilibrate()?;
    let n = rook.order.len();
    let tiny = tiny(n);
    let mut inertia = Inertia::default();
    let (mut k, mut growth) = (0, 1.0_f64);
    while k < n {
        let (pivot, size) = rook.choose(k, tiny * growth);
        growth = growth.max(size);
        k += match pivot {
            Pivot::Zero => {
                inertia.zero += 1;
                rook.skip(k, tiny * growth);
                1
            }
            Pivot::One(i) => {
                rook.exchange(k, i);
                inertia.count(rook.a[k * n + k]);
                rook.eliminate_one(k);
                1
            }
            Pivot::Two(i, j) => {
                // `j` is not `k`, whose row holds nothing as large, so it stays where it is in the first exchange.
                rook.exchange(k, i);
                rook.exchange(k + 1, j);
                // The determinant is negative.
                inertia.positive += 1;
                inertia.negative += 1;
                rook.eliminate_two(k);
                2
            }
        };
    }
    if growth.is_finite() { Ok(inertia) } else { Err(Breakdown::NotFinite) }
}

impl Rook<'_> {
    /// Brings the largest number of each row to about one.
    #[inline(always)]
    fn equilibrate(&mut self) -> Result<(), Breakdown> {
        let n = self.order.len();
        if !all_finite(self.a) {
            return Err(Breakdown::NotFinite);
        }
        let sweep = |weight: &[f64], largest: &mut [f64]| {
            largest.fill(0.0);
            for (i, row) in self.a.chunks_exact(n).enumerate() {
                let own = weight[i];
                largest[i] = largest[i].max(largest_product(&row[i..], &weight[i..]));
                for (to, v) in largest[i + 1..].iter_mut().zip(&row[i + 1..]) {
                    let v = v.abs() * own;
                    *to = if v > *to { v } else { *to };
                }
            }
        };
        equilibrate(|i| self.a[i * n + i], sweep, self.scale, self.room);
        for (i, row) in self.a.chunks_exact_mut(n).enumerate() {
            let own = self.scale[i];
            for (v, other) in row[i..].iter_mut().zip(&self.scale[i..]) {
                *v = *v * own * other;
            }
        }
        Ok(())
    }

    /// The next pivot among the rows from `k` on, and the largest number in its rows.
    #[inline(always)]
    fn choose(&self, k: usize, limit: f64) -> (Pivot, f64) {
        let n = self.order.len();
        let (mut i, mut diagonal) = (k, self.a[k * n + k].abs());
        let (mut largest, mut j) = self.strongest(k, i);
        if diagonal.max(largest) <= limit {
            return (Pivot::Zero, 0.0);
        }
        if diagonal >= ALPHA * largest {
            return (Pivot::One(i), diagonal.max(largest));
        }
        loop {
            let (beyond, next) = self.strongest(k, j);
            diagonal = self.a[j * n + j].abs();
            if diagonal >= ALPHA * beyond {
                return (Pivot::One(j), diagonal.max(beyond));
            }
            // Until here each row has held more than the one before, so this comes to an end.
            if beyond <= largest {
                return (Pivot::Two(i, j), largest);
            }
            (i, largest, j) = (j, beyond, next);
        }
    }

    /// The largest magnitude beside the diagonal in row `i`, from place `k` on, and where it is.
    #[inline(always)]
    fn strongest(&self, k: usize, i: usize) -> (f64, usize) {
        let n = self.order.len();
        let (mut best, mut place) = (-1.0, i);
        for j in k..i {
            let v = self.a[j * n + i].abs();
            if v > best {
                (best, place) = (v, j);
            }
        }
        let row = &self.a[i * n + i + 1..(i + 1) * n];
        let right = largest(row);
        if right > best {
            let at = row.iter().position(|v| v.abs() == right);
            (best, place) = (right, at.map_or(i, |at| i + 1 + at));
        }
        (best.max(0.0), place)
    }

    #[inline(always)]
    fn exchange(&mut self, p: usize, q: usize) {
        if p != q {
            self.order.swap(p, q);
            exchange(self.a, self.order.len(), p, q);
        }
    }

    /// Makes a pivot of the row at `k`, which has nothing in it.
    #[inline(always)]
    fn skip(&mut self, k: usize, size: f64) {
        let n = self.order.len();
        let row = &mut self.a[k * n + k..(k + 1) * n];
        row[0] = 1.0 / size.copysign(row[0]);
        row[1..].fill(0.0);
        self.is_pair[k] = false;
    }

    #[inline(always)]
    fn eliminate_one(&mut self, k: usize) {
        let n = self.order.len();
        self.is_pair[k] = false;
        let (upper, lower) = self.a.split_at_mut((k + 1) * n);
        let top = &mut upper[k * n..];
        let inverse = 1.0 / top[k];
        for (i, row) in lower.chunks_exact_mut(n).enumerate() {
            let i = k + 1 + i;
            let factor = top[i] * inverse;
            if factor != 0.0 {
                subtract(&mut row[i..], factor, &top[i..]);
            }
        }
        top[k] = inverse;
        for v in &mut top[k + 1..] {
            *v *= inverse;
        }
    }

    #[inline(always)]
    fn eliminate_two(&mut self, k: usize) {
        let n = self.order.len();
        (self.is_pair[k], self.is_pair[k + 1]) = (true, false);
        let (upper, lower) = self.a.split_at_mut((k + 2) * n);
        let (one, two) = upper[k * n..].split_at_mut(n);
        let inverse = inverse_of_two(one[k], one[k + 1], two[k + 1]);
        for (i, row) in lower.chunks_exact_mut(n).enumerate() {
            let i = k + 2 + i;
            let first = inverse[0] * one[i] + inverse[1] * two[i];
            let second = inverse[1] * one[i] + inverse[2] * two[i];
            if first != 0.0 || second != 0.0 {
                for ((to, a), b) in row[i..].iter_mut().zip(&one[i..]).zip(&two[i..]) {
                    *to -= first * a + second * b;
                }
            }
        }
        (one[k], one[k + 1], two[k + 1]) = (inverse[0], inverse[1], inverse[2]);
        for (a, b) in one[k + 2..].iter_mut().zip(&mut two[k + 2..]) {
            (*a, *b) = (inverse[0] * *a + inverse[1] * *b, inverse[1] * *a + inverse[2] * *b);
        }
    }
}

/// Exchanges row and column `p` with `q` > `p` in the upper triangle of a matrix of `n` rows.
#[inline(always)]
pub(crate) fn exchange(a: &mut [f64], n: usize, p: usize, q: usize) {
    for i in 0..p {
        a.swap(i * n + p, i * n + q);
    }
    a.swap(p * n + p, q * n + q);
    for i in p + 1..q {
        a.swap(p * n + i, i * n + q);
    }
    let (upper, lower) = a.split_at_mut(q * n);
    upper[p * n + q + 1..(p + 1) * n].swap_with_slice(&mut lower[q + 1..n]);
}

/// The inverse of \[\[a, b\], \[b, c\]\], b not zero: its diagonal at either end and what stands beside it between. Divided
/// by b first, nothing overflows.
#[inline(always)]
pub(crate) fn inverse_of_two(a: f64, b: f64, c: f64) -> [f64; 3] {
    let (p, q) = (a / b, c / b);
    let part = 1.0 / (b * (p * q - 1.0));
    [q * part, -part, p * part]
}
