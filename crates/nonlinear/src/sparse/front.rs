//! Elimination within one front: a dense matrix of which the leading rows and columns are complete.
//!
//! Columns are taken in panels. A panel is eliminated by itself, held by columns, with pivots from its complete
//! rows; what it does to the columns behind it is then done in one product of matrices, tile by tile, which stays
//! in registers. A column whose best complete row is too weak beside the rest is set aside, tried again once
//! others are gone, and at last left over for the parent.

use crate::lanes::largest;

/// Columns of a panel.
const PANEL: usize = 32;
/// Rows of a tile.
pub(super) const ROWS: usize = 4;
/// A pivot is at least this part of the largest number in its column, which bounds growth by 1 + 1 / this.
const THRESHOLD: f64 = 0.01;
/// Below this part of the largest number about, a pivot is no pivot.
pub(super) const TINY: f64 = 1e-14;

/// A front and the unknowns of its rows and columns.
pub(super) struct Front<'a> {
    /// By rows.
    pub a: &'a mut [f64],
    pub rows: &'a mut [u32],
    pub columns: &'a mut [u32],
    /// Rows and columns, the leading ones, in which nothing is missing.
    pub complete: usize,
    /// What is below is no pivot.
    pub limit: f64,
}

/// What elimination needs beside the front.
#[derive(Debug, Default)]
pub(super) struct Bench {
    /// The panel by columns.
    panel: Vec<f64>,
    /// Its unit lower triangle by rows.
    corner: Vec<f64>,
    /// The rows to the right of the panel by tiles.
    right: Vec<f64>,
    /// One tile of the rows below.
    left: Vec<[f64; ROWS]>,
}

impl Bench {
    /// Bytes held.
    pub fn memory(&self) -> usize {
        super::bytes(&self.panel)
            + super::bytes(&self.corner)
            + super::bytes(&self.right)
            + super::bytes(&self.left)
    }
}

/// Eliminates as many complete columns as have a pivot, and returns their number. These rows and columns lead
/// then, L without its unit diagonal and U stand in their places, and the rest has become the remainder.
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
    let m = front.rows.len();
    let (mut first, mut tried) = (0, 0);
    while first + tried < front.complete {
        let width = PANEL.min(front.complete - first - tried);
        let height = m - first;
        bench.panel.resize(width * height, 0.0);
        for (i, row) in front.a[first * m..].chunks_exact(m).enumerate() {
            for (j, &value) in row[first..first + width].iter().enumerate() {
                bench.panel[j * height + i] = value;
            }
        }
        let pivots = eliminate_panel(front, first, width, &mut bench.panel);
        for (i, row) in front.a[first * m..].chunks_exact_mut(m).enumerate() {
            for (j, value) in row[first..first + width].iter_mut().enumerate() {
                *value = bench.panel[j * height + i];
            }
        }
        if pivots > 0 {
            update::<C>(front.a, m, first, pivots, width, bench);
        }
        first += pivots;
        // What was set aside goes behind the columns that have not been tried.
        let failed = width - pivots;
        let end = front.complete - if pivots > 0 { 0 } else { tried };
        for k in (0..failed).rev() {
            swap_columns(front, first + k, end - (failed - k), 0..m);
        }
        tried = if pivots > 0 { 0 } else { tried + failed };
    }
    first
}

fn swap_columns(front: &mut Front, i: usize, j: usize, rows: std::ops::Range<usize>) {
    if i != j {
        let m = front.rows.len();
        front.columns.swap(i, j);
        for k in rows {
            front.a.swap(k * m + i, k * m + j);
        }
    }
}

/// Eliminates within the columns of a panel only; returns the number of pivots.
#[inline(always)]
fn eliminate_panel(front: &mut Front, first: usize, width: usize, panel: &mut [f64]) -> usize {
    let m = front.rows.len();
    let (height, complete) = (m - first, front.complete - first);
    let (mut k, mut left) = (0, width);
    while k < left {
        let column = &panel[k * height..(k + 1) * height];
        let best = largest(&column[k..complete]);
        if best < front.limit || best < THRESHOLD * largest(&column[complete..]) {
            left -= 1;
            swap_columns(front, first + k, first + left, 0..first);
            if k < left {
                let (head, tail) = panel.split_at_mut(left * height);
                head[k * height..(k + 1) * height].swap_with_slice(&mut tail[..height]);
            }
            continue;
        }
        let pivot = column[k..complete].iter().position(|v| v.abs() == best).map_or(k, |i| i + k);
        if pivot != k {
            let (upper, lower) = front.a.split_at_mut((first + pivot) * m);
            upper[(first + k) * m..(first + k + 1) * m].swap_with_slice(&mut lower[..m]);
            front.rows.swap(first + k, first + pivot);
            for column in panel.chunks_exact_mut(height) {
                column.swap(k, pivot);
            }
        }
        let (head, tail) = panel.split_at_mut((k + 1) * height);
        let column = &mut head[k * height..];
        let inverse = 1.0 / column[k];
        for v in &mut column[k + 1..] {
            *v *= inverse;
        }
        for other in tail.chunks_exact_mut(height) {
            let factor = other[k];
            if factor != 0.0 {
                for (to, from) in other[k + 1..].iter_mut().zip(&column[k + 1..]) {
                    *to -= factor * from;
                }
            }
        }
        k += 1;
    }
    k
}

/// Takes the pivots of a panel through the columns to its right.
#[inline(always)]
fn update<const C: usize>(
    a: &mut [f64],
    m: usize,
    first: usize,
    pivots: usize,
    width: usize,
    bench: &mut Bench,
) {
    let (height, beyond) = (m - first, first + width);
    let Bench { panel, corner, right, left } = bench;
    corner.clear();
    for i in 0..pivots {
        corner.extend((0..pivots).map(|j| panel[j * height + i]));
    }

    // U: the pivot rows, solved with the unit lower triangle.
    let tiles = (m - beyond).div_ceil(C);
    right.resize(tiles * pivots * C, 0.0);
    for (t, tile) in right.chunks_exact_mut(pivots * C).enumerate() {
        let start = beyond + t * C;
        let count = C.min(m - start);
        let tile = tile.as_chunks_mut::<C>().0;
        for i in 0..pivots {
            let row = &mut a[(first + i) * m + start..][..count];
            let mut x = [0.0; C];
            x[..count].copy_from_slice(row);
            for (l, u) in corner[i * pivots..][..i].iter().zip(&tile[..i]) {
                for c in 0..C {
                    x[c] -= l * u[c];
                }
            }
            row.copy_from_slice(&x[..count]);
            tile[i] = x;
        }
    }

    // The remainder: A - L U.
    left.resize(pivots, [0.0; ROWS]);
    for i in (pivots..height).step_by(ROWS) {
        let count = ROWS.min(height - i);
        for (j, to) in left.iter_mut().enumerate() {
            *to = [0.0; ROWS];
            to[..count].copy_from_slice(&panel[j * height + i..][..count]);
        }
        for (t, tile) in right.chunks_exact(pivots * C).enumerate() {
            let start = beyond + t * C;
            let product = product::<C>(left, tile.as_chunks::<C>().0);
            for (r, from) in product[..count].iter().enumerate() {
                let row = &mut a[(first + i + r) * m + start..];
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

/// One tile of L U.
#[inline(always)]
pub(super) fn product<const C: usize>(l: &[[f64; ROWS]], u: &[[f64; C]]) -> [[f64; C]; ROWS] {
    let mut sum = [[0.0; C]; ROWS];
    for (l, u) in l.iter().zip(u) {
        for r in 0..ROWS {
            for c in 0..C {
                sum[r][c] += l[r] * u[c];
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A front of `m` rows whose first columns vanish in the complete rows.
    fn example(m: usize, complete: usize, weak: usize) -> Vec<f64> {
        let mut a: Vec<f64> = (0..m * m).map(|k| ((k * k + 3 * k) as f64).sin()).collect();
        for i in 0..complete {
            a[i * m..i * m + weak].fill(0.0);
        }
        a
    }

    fn run(
        a: &mut [f64],
        m: usize,
        complete: usize,
        f: fn(&mut Front, &mut Bench) -> usize,
    ) -> (usize, Vec<u32>) {
        let (mut rows, mut columns): (Vec<u32>, Vec<u32>) =
            ((0..m as u32).collect(), (0..m as u32).collect());
        let mut front = Front { a, rows: &mut rows, columns: &mut columns, complete, limit: TINY };
        let pivots = f(&mut front, &mut Bench::default());
        rows.append(&mut columns);
        (pivots, rows)
    }

    #[test]
    fn both_builds_give_equal_bits() {
        for (m, complete, weak) in [(1, 1, 0), (7, 3, 1), (61, 40, 0), (150, 101, 7), (133, 133, 0)] {
            let (mut one, mut other) = (example(m, complete, weak), example(m, complete, weak));
            let first = run(&mut one, m, complete, eliminate);
            assert_eq!(first, run(&mut other, m, complete, eliminate_by::<4>));
            assert!(one.iter().zip(&other).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }

    /// Rows times columns of what is left must be what was there.
    #[test]
    fn factors_and_remainder_give_the_front_back_and_weak_columns_are_left_over() {
        for (m, complete, weak) in [(7, 3, 1), (61, 40, 0), (150, 101, 7), (150, 40, 40)] {
            let before = example(m, complete, weak);
            let mut a = before.clone();
            let (pivots, lists) = run(&mut a, m, complete, eliminate);
            assert_eq!(pivots, complete - weak);
            let (rows, columns) = lists.split_at(m);
            assert!(columns[pivots..complete].iter().all(|&j| (j as usize) < weak));
            for i in 0..m {
                for j in 0..m {
                    let steps = pivots.min(i).min(j);
                    let product: f64 = (0..steps).map(|k| a[i * m + k] * a[k * m + j]).sum();
                    let diagonal = if i < pivots && i <= j { a[i * m + j] } else { 0.0 };
                    let lower = if j < pivots && i > j { a[i * m + j] * a[j * m + j] } else { 0.0 };
                    let rest = if i >= pivots && j >= pivots { a[i * m + j] } else { 0.0 };
                    let there = before[rows[i] as usize * m + columns[j] as usize];
                    assert!((product + diagonal + lower + rest - there).abs() < 1e-11);
                }
            }
        }
    }
}
