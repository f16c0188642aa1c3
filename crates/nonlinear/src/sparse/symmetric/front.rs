//! Elimination within one symmetric front: a dense matrix of which the leading rows and columns are complete.
//!
//! Only the upper triangle is held, by rows. Rows are taken in panels, with pivots of one and two rows from the
//! panel; what a panel does to the rows behind it is then done in one product of matrices, tile by tile, on and
//! above the diagonal. A row without a pivot in its panel is set aside, tried again once others are gone, then with
//! all that are left side by side, and at last left over for the parent.

use crate::lanes::{largest, subtract};
use crate::sparse::front::{ROWS, product};
use crate::symmetric::{Inertia, exchange, inverse_of_two};

/// Rows of a panel.
const PANEL: usize = 32;
/// Numbers in L are at most this, which bounds growth (I. S. Duff and J. K. Reid, "The multifrontal solution of indefinite
/// sparse symmetric linear equations", ACM Trans. Math. Softw. 9 (1983) 302-325).
const LARGEST: f64 = 50.0;
/// A pivot that makes them no larger than this is taken at once.
const GOOD: f64 = 4.0;

/// A front and the unknowns of its rows and columns.
pub(super) struct Front<'a> {
    /// The upper triangle by rows; below it stands anything.
    pub a: &'a mut [f64],
    pub unknowns: &'a mut [u32],
    /// Rows and columns, the leading ones, in which nothing is missing.
    pub complete: usize,
    /// The largest number in pivot rows so far.
    pub growth: f64,
    /// Below this part of it a row is zero.
    pub tiny: f64,
    /// One more for each pivot row: does a pivot of two rows begin here?
    pub is_pair: &'a mut Vec<bool>,
    /// The signs of the pivots are added to it.
    pub inertia: &'a mut Inertia,
}

/// What elimination needs beside the front.
#[derive(Debug, Default)]
pub(super) struct Bench {
    /// The pivot rows to the right of the panel by tiles.
    right: Vec<f64>,
    /// One tile of L.
    left: Vec<[f64; ROWS]>,
}

impl Bench {
    /// Bytes held.
    pub fn memory(&self) -> usize {
        crate::sparse::bytes(&self.right) + crate::sparse::bytes(&self.left)
    }
}

/// Eliminates as many complete rows as have a pivot, and returns their number. They lead then, unit upper L without its
/// diagonal and the inverse of D stand in their places, and the rest has become the remainder.
pub(super) fn eliminate(front: &mut Front, bench: &mut Bench) -> usize {
    #[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, as was just asked.
        return unsafe { eliminate_avx2(front, bench) };
    }
    eliminate_by::<4>(front, bench)
}

/// The same compiled for four lanes at a time. No fused multiply-add: both builds give equal bits.
#[cfg(all(target_arch = "x86_64", not(feature = "baseline")))]
#[target_feature(enable = "avx2")]
fn eliminate_avx2(front: &mut Front, bench: &mut Bench) -> usize {
    eliminate_by::<8>(front, bench)
}

/// `C` is the number of columns in a tile.
#[inline(always)]
fn eliminate_by<const C: usize>(front: &mut Front, bench: &mut Bench) -> usize {
    let m = front.unknowns.len();
    let (mut first, mut tried) = (0, 0);
    while first < front.complete {
        let remaining = front.complete - first;
        let width = if tried < remaining { PANEL.min(remaining - tried) } else { remaining };
        let mut panel = Panel { front, m, first, end: first + width };
        let pivots = panel.eliminate();
        panel.finish::<C>(pivots, bench);
        first += pivots;
        if pivots > 0 {
            tried = 0;
        } else if width == remaining {
            break;
        } else {
            tried += width;
        }
        // What was set aside goes behind the rows that have not been tried.
        let failed = width - pivots;
        let end = front.complete - if pivots > 0 { 0 } else { tried - failed };
        for k in (0..failed).rev() {
            let (p, q) = (first + k, end - (failed - k));
            if p != q {
                front.unknowns.swap(p, q);
                exchange(front.a, m, p, q);
            }
        }
    }
    first
}

enum Pivot {
    Zero,
    One(usize),
    Two(usize),
}

/// Rows `first..end` of a front. Within the panel both sides of the diagonal are held.
struct Panel<'a, 'b> {
    front: &'a mut Front<'b>,
    m: usize,
    first: usize,
    end: usize,
}

impl Panel<'_, '_> {
    /// Eliminates within the rows of the panel only; returns the number of pivots. D and D L stand in the pivot rows.
    #[inline(always)]
    fn eliminate(&mut self) -> usize {
        let (m, first) = (self.m, self.first);
        for i in first..self.end {
            for j in i + 1..self.end {
                self.front.a[j * m + i] = self.front.a[i * m + j];
            }
        }
        let (mut k, mut left) = (first, self.end);
        while k < left {
            k += match self.choose(k) {
                None => {
                    left -= 1;
                    self.exchange(k, left, k);
                    0
                }
                Some(Pivot::Zero) => {
                    let row = &mut self.front.a[k * m + k..(k + 1) * m];
                    row[0] = (self.front.tiny * self.front.growth).copysign(row[0]);
                    row[1..].fill(0.0);
                    self.front.inertia.zero += 1;
                    self.front.is_pair.push(false);
                    1
                }
                Some(Pivot::One(r)) => {
                    self.exchange(k, r, k);
                    self.front.inertia.count(self.front.a[k * m + k]);
                    self.front.is_pair.push(false);
                    self.eliminate_one(k);
                    1
                }
                Some(Pivot::Two(r)) => {
                    self.exchange(k + 1, r, k);
                    let a = &self.front.a[k * m + k..];
                    let determinant = a[0] * a[m + 1] - a[1] * a[1];
                    // The second sign is that of the determinant beside the first.
                    let one = if a[0] == 0.0 { 1.0 } else { a[0] };
                    self.front.inertia.count(one);
                    self.front.inertia.count(if determinant < 0.0 { -one } else { one });
                    self.front.is_pair.extend([true, false]);
                    self.eliminate_two(k);
                    2
                }
            };
        }
        k - first
    }

    /// A pivot for row `k`: itself alone, the row that it touches most in the panel, or both.
    #[inline(always)]
    fn choose(&mut self, k: usize) -> Option<Pivot> {
        let (m, end) = (self.m, self.end);
        let row = &self.front.a[k * m..(k + 1) * m];
        let a = row[k].abs();
        let (near, far) = (largest(&row[k + 1..end]), largest(&row[end..]));
        let all = near.max(far);
        if a.max(all) <= self.front.tiny * self.front.growth {
            return Some(Pivot::Zero);
        }
        if all <= GOOD * a {
            self.front.growth = self.front.growth.max(a).max(all);
            return Some(Pivot::One(k));
        }
        let one = all / a;
        let at = row[k + 1..end].iter().position(|v| v.abs() == near).filter(|_| near > 0.0);
        let Some(r) = at.map(|at| k + 1 + at) else {
            if one > LARGEST {
                return None;
            }
            self.front.growth = self.front.growth.max(all);
            return Some(Pivot::One(k));
        };
        let here = largest(&row[k + 1..r]).max(largest(&row[r + 1..end])).max(far);
        let other = &self.front.a[r * m..(r + 1) * m];
        let there = largest(&other[k + 1..r]).max(largest(&other[r + 1..]));
        let (b, c) = (near, other[r].abs());
        let beyond = b.max(there);
        let other_one = beyond / c;
        let determinant = (row[k] * other[r] - b * b).abs();
        let two = (c * here + b * there).max(b * here + a * there) / determinant;
        let growth = self.front.growth;
        let (size, pivot) = if other_one <= GOOD || (other_one <= one && other_one <= two) {
            (other_one, Pivot::One(r))
        } else if two <= one {
            (two, Pivot::Two(r))
        } else {
            (one, Pivot::One(k))
        };
        if size > LARGEST || size.is_nan() {
            return None;
        }
        self.front.growth = match pivot {
            Pivot::One(i) if i == k => growth.max(all),
            Pivot::One(_) => growth.max(beyond).max(c),
            _ => growth.max(all).max(beyond).max(c),
        };
        Some(pivot)
    }

    /// Exchanges rows and columns `p` and `q` of the panel, of which `from` is the first that is not eliminated.
    #[inline(always)]
    fn exchange(&mut self, p: usize, q: usize, from: usize) {
        let (p, q) = (p.min(q), p.max(q));
        if p == q {
            return;
        }
        let m = self.m;
        self.front.unknowns.swap(p, q);
        let (upper, lower) = self.front.a.split_at_mut(q * m);
        upper[p * m + from..(p + 1) * m].swap_with_slice(&mut lower[from..m]);
        for i in 0..self.end {
            self.front.a.swap(i * m + p, i * m + q);
        }
    }

    #[inline(always)]
    fn eliminate_one(&mut self, k: usize) {
        let m = self.m;
        let (upper, lower) = self.front.a[..self.end * m].split_at_mut((k + 1) * m);
        let top = &upper[k * m..];
        let inverse = 1.0 / top[k];
        for (j, row) in lower.chunks_exact_mut(m).enumerate() {
            let factor = top[k + 1 + j] * inverse;
            if factor != 0.0 {
                subtract(&mut row[k + 1..], factor, &top[k + 1..]);
            }
        }
    }

    #[inline(always)]
    fn eliminate_two(&mut self, k: usize) {
        let m = self.m;
        let (upper, lower) = self.front.a[..self.end * m].split_at_mut((k + 2) * m);
        let (one, two) = upper[k * m..].split_at(m);
        let inverse = inverse_of_two(one[k], one[k + 1], two[k + 1]);
        for (j, row) in lower.chunks_exact_mut(m).enumerate() {
            let j = k + 2 + j;
            let first = inverse[0] * one[j] + inverse[1] * two[j];
            let second = inverse[1] * one[j] + inverse[2] * two[j];
            if first != 0.0 || second != 0.0 {
                for ((to, a), b) in row[k + 2..].iter_mut().zip(&one[k + 2..]).zip(&two[k + 2..]) {
                    *to -= first * a + second * b;
                }
            }
        }
    }

    /// Takes the pivots of the panel through the rows behind it, and puts L and the inverse of D in their rows.
    #[inline(always)]
    fn finish<const C: usize>(&mut self, pivots: usize, bench: &mut Bench) {
        if pivots == 0 {
            return;
        }
        let (m, first, end) = (self.m, self.first, self.end);
        let Bench { right, left } = bench;
        let tiles = (m - end).div_ceil(C);
        right.resize(tiles * pivots * C, 0.0);
        for (t, tile) in right.chunks_exact_mut(pivots * C).enumerate() {
            let start = end + t * C;
            let count = C.min(m - start);
            for (k, to) in tile.as_chunks_mut::<C>().0.iter_mut().enumerate() {
                *to = [0.0; C];
                to[..count].copy_from_slice(&self.front.a[(first + k) * m + start..][..count]);
            }
        }
        self.divide(pivots);

        left.resize(pivots, [0.0; ROWS]);
        let a = &mut *self.front.a;
        for i in (end..m).step_by(ROWS) {
            let count = ROWS.min(m - i);
            for (k, to) in left.iter_mut().enumerate() {
                *to = [0.0; ROWS];
                to[..count].copy_from_slice(&a[(first + k) * m + i..][..count]);
            }
            // Tiles on the diagonal write below it too, where nobody reads.
            let on = (i - end) / C;
            for (t, tile) in right.chunks_exact(pivots * C).enumerate().skip(on) {
                let start = end + t * C;
                let product = product::<C>(left, tile.as_chunks::<C>().0);
                for (r, from) in product[..count].iter().enumerate() {
                    let row = &mut a[(i + r) * m + start..];
                    if let Some(to) = row.first_chunk_mut::<C>()
                        && start + C <= m
                    {
                        for c in 0..C {
                            to[c] -= from[c];
                        }
                    } else {
                        for (to, from) in row[..m - start].iter_mut().zip(from) {
                            *to -= from;
                        }
                    }
                }
            }
        }
    }

    /// D and D L become the inverse of D and L.
    #[inline(always)]
    fn divide(&mut self, pivots: usize) {
        let m = self.m;
        let is_pair = &self.front.is_pair[self.front.is_pair.len() - pivots..];
        let mut k = 0;
        while k < pivots {
            let at = self.first + k;
            let (one, two) = self.front.a[at * m..].split_at_mut(m);
            if is_pair[k] {
                let inverse = inverse_of_two(one[at], one[at + 1], two[at + 1]);
                (one[at], one[at + 1], two[at + 1]) = (inverse[0], inverse[1], inverse[2]);
                for (a, b) in one[at + 2..].iter_mut().zip(&mut two[at + 2..m]) {
                    (*a, *b) = (inverse[0] * *a + inverse[1] * *b, inverse[1] * *a + inverse[2] * *b);
                }
                k += 2;
            } else {
                let inverse = 1.0 / one[at];
                one[at] = inverse;
                for v in &mut one[at + 1..] {
                    *v *= inverse;
                }
                k += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The upper triangle of a front of `m` rows. The first ones touch nothing complete, the next ones have no
    /// diagonal.
    fn example(m: usize, complete: usize, weak: usize, empty: usize) -> Vec<f64> {
        let mut a = vec![0.0; m * m];
        for i in 0..m {
            for j in i..m {
                let is_zero = i < weak && j < complete || i == j && i < weak + empty;
                a[i * m + j] = if is_zero { 0.0 } else { ((i * i + 7 * i * j + 3 * j * j + 1) as f64).sin() };
            }
        }
        a
    }

    struct Done {
        pivots: usize,
        unknowns: Vec<u32>,
        is_pair: Vec<bool>,
        inertia: Inertia,
    }

    fn run(a: &mut [f64], m: usize, complete: usize, f: fn(&mut Front, &mut Bench) -> usize) -> Done {
        let mut unknowns: Vec<u32> = (0..m as u32).collect();
        let (mut is_pair, mut inertia) = (Vec::new(), Inertia::default());
        let mut front = Front {
            a,
            unknowns: &mut unknowns,
            complete,
            growth: 1.0,
            tiny: 1e-14,
            is_pair: &mut is_pair,
            inertia: &mut inertia,
        };
        let pivots = f(&mut front, &mut Bench::default());
        Done { pivots, unknowns, is_pair, inertia }
    }

    const SIZES: [[usize; 4]; 7] = [
        [1, 1, 0, 0],
        [7, 3, 1, 1],
        [61, 40, 0, 10],
        [150, 101, 7, 40],
        [133, 133, 0, 133],
        [150, 40, 40, 0],
        [97, 96, 33, 30],
    ];

    #[test]
    fn both_builds_give_equal_bits() {
        for [m, complete, weak, empty] in SIZES {
            let (mut one, mut other) = (example(m, complete, weak, empty), example(m, complete, weak, empty));
            let first = run(&mut one, m, complete, eliminate);
            let second = run(&mut other, m, complete, eliminate_by::<4>);
            assert_eq!((first.pivots, first.unknowns), (second.pivots, second.unknowns));
            for i in 0..m {
                let (one, other) = (&one[i * m + i..(i + 1) * m], &other[i * m + i..(i + 1) * m]);
                assert!(one.iter().zip(other).all(|(a, b)| a.to_bits() == b.to_bits()));
            }
        }
    }

    /// Lᵀ D L and what is left must be what was there.
    #[test]
    fn factors_and_remainder_give_the_front_back_and_weak_rows_are_left_over() {
        for [m, complete, weak, empty] in SIZES {
            let before = example(m, complete, weak, empty);
            let mut a = before.clone();
            let Done { pivots, unknowns, is_pair, inertia } = run(&mut a, m, complete, eliminate);
            assert_eq!(pivots, complete - weak);
            assert_eq!(inertia.positive + inertia.negative, pivots);
            assert!(unknowns[pivots..complete].iter().all(|&j| (j as usize) < weak));
            // L by rows and D L, from the inverse of D.
            let (mut l, mut dl) = (vec![0.0; pivots * m], vec![0.0; pivots * m]);
            let mut k = 0;
            while k < pivots {
                let next = k + if is_pair[k] { 2 } else { 1 };
                for r in k..next {
                    l[r * m + next..(r + 1) * m].copy_from_slice(&a[r * m + next..(r + 1) * m]);
                    l[r * m + r] = 1.0;
                }
                if is_pair[k] {
                    let [p, q, r] = inverse_of_two(a[k * m + k], a[k * m + k + 1], a[(k + 1) * m + k + 1]);
                    for j in k..m {
                        let (one, two) = (l[k * m + j], l[(k + 1) * m + j]);
                        (dl[k * m + j], dl[(k + 1) * m + j]) = (p * one + q * two, q * one + r * two);
                    }
                } else {
                    for j in k..m {
                        dl[k * m + j] = l[k * m + j] / a[k * m + k];
                    }
                }
                k = next;
            }
            assert!(l.iter().all(|l| l.abs() <= 1.0001 * LARGEST));
            for i in 0..m {
                for j in i..m {
                    let product: f64 = (0..pivots).map(|k| l[k * m + i] * dl[k * m + j]).sum();
                    let rest = if i >= pivots { a[i * m + j] } else { 0.0 };
                    let (p, q) = (unknowns[i] as usize, unknowns[j] as usize);
                    let there = before[p.min(q) * m + p.max(q)];
                    assert!((product + rest - there).abs() < 1e-10, "{m} {i} {j}");
                }
            }
        }
    }
}
