//! The numeric phase: fronts put together and eliminated up the tree, and the solves with what is kept of them.

use super::front::{Bench, Front, TINY, eliminate};
use super::pattern::Pattern;
use super::symbolic::Tree;
use crate::Breakdown;
use crate::lanes::{all_finite, dot, largest, subtract};

/// What is kept of one front.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Rows and columns of the front.
    size: usize,
    /// The leading ones are eliminated here.
    pivots: usize,
    /// Where its rows and columns begin in the lists.
    list: usize,
    /// Where its numbers begin: the pivot rows at full length, then the other rows as far as the pivots.
    numbers: usize,
}

/// A triangular factorisation P A Q = L U, held by fronts.
#[derive(Debug, Default)]
pub(super) struct Factors {
    pieces: Vec<Piece>,
    rows: Vec<u32>,
    columns: Vec<u32>,
    numbers: Vec<f64>,
    /// Powers of two that bring the largest entry of each row to between 1 and 2: they cost no digit.
    scale: Vec<f64>,
    pub positive: bool,
    /// Additions and multiplications done.
    pub flops: u64,
    /// Pivots that were handed to a parent, counted each time.
    pub delayed: usize,
}

impl Clone for Factors {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, from: &Self) {
        self.pieces.clone_from(&from.pieces);
        self.rows.clone_from(&from.rows);
        self.columns.clone_from(&from.columns);
        self.numbers.clone_from(&from.numbers);
        self.scale.clone_from(&from.scale);
        (self.positive, self.flops, self.delayed) = (from.positive, from.flops, from.delayed);
    }
}

/// A remainder that waits for its parent.
#[derive(Clone, Copy, Debug)]
struct Remainder {
    /// Where its rows and columns begin in the lists.
    list: usize,
    size: usize,
    /// The leading ones are delayed pivots.
    delayed: usize,
    /// Where its numbers begin on the stack.
    stack: usize,
    /// The largest number in the pivot rows of its front and those below.
    growth: f64,
}

/// Storage that lives through a factorisation only, kept from one to the next.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    front: Vec<f64>,
    stack: Vec<f64>,
    waiting: Vec<Remainder>,
    row_at: Vec<u32>,
    column_at: Vec<u32>,
    runs: Vec<Run>,
    bench: Bench,
}

impl Scratch {
    /// Bytes held.
    pub fn memory(&self) -> usize {
        super::bytes(&self.front)
            + super::bytes(&self.stack)
            + super::bytes(&self.row_at)
            + super::bytes(&self.column_at)
            + self.bench.memory()
    }
}

/// Neighbouring columns of a child that are neighbours in the parent too.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub from: usize,
    pub to: usize,
    pub count: usize,
}

impl Factors {
    /// Forgets what is there.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.rows.clear();
        self.columns.clear();
        self.numbers.clear();
        self.scale.clear();
        (self.positive, self.flops, self.delayed) = (true, 0, 0);
    }

    /// Is there a factorisation of a matrix of `n` rows?
    pub fn is_complete(&self, n: usize) -> bool {
        self.scale.len() == n
    }

    /// Factorises. Nothing is left on failure.
    pub fn compute(
        &mut self,
        pattern: &Pattern,
        tree: &Tree,
        scratch: &mut Scratch,
    ) -> Result<(), Breakdown> {
        self.clear();
        scratch.stack.clear();
        scratch.waiting.clear();
        scratch.row_at.resize(pattern.size(), 0);
        scratch.column_at.resize(pattern.size(), 0);
        // A few delayed pivots must not make the largest list grow to twice its length.
        self.numbers.reserve(tree.fill + tree.fill / 64);
        self.rows.reserve(tree.rows + tree.rows / 64);
        self.columns.reserve(tree.rows + tree.rows / 64);
        scratch.stack.reserve(tree.stack + tree.stack / 64);
        let done = self
            .weigh(pattern)
            .and_then(|()| (0..tree.nodes.len()).try_for_each(|i| self.eliminate(pattern, tree, i, scratch)));
        match done {
            Ok(()) => self.positive = self.sign(&mut scratch.row_at),
            Err(_) => self.clear(),
        }
        done
    }

    fn weigh(&mut self, pattern: &Pattern) -> Result<(), Breakdown> {
        for i in 0..pattern.size() {
            let values = pattern.row(i).1;
            if values.iter().any(|v| !v.is_finite()) {
                return Err(Breakdown::NotFinite);
            }
            let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            if largest == 0.0 {
                return Err(Breakdown::Singular);
            }
            // 2^-e for a number of exponent e, by the exponent's bits.
            let exponent = largest.to_bits() >> 52;
            self.scale.push(f64::from_bits((2046 - exponent).clamp(1, 2046) << 52));
        }
        Ok(())
    }

    /// Puts front `i` together, eliminates what can be and leaves the remainder on the stack.
    fn eliminate(
        &mut self,
        pattern: &Pattern,
        tree: &Tree,
        i: usize,
        scratch: &mut Scratch,
    ) -> Result<(), Breakdown> {
        let Scratch { front, stack, waiting, row_at, column_at, runs, bench } = scratch;
        let node = &tree.nodes[i];
        let children = waiting.len() - node.children;
        let list = self.rows.len();
        self.rows.extend(&tree.unknowns[node.own.clone()]);
        self.columns.extend(&tree.unknowns[node.own.clone()]);
        for child in &waiting[children..] {
            let delayed = child.list..child.list + child.delayed;
            self.rows.extend_from_within(delayed.clone());
            self.columns.extend_from_within(delayed);
        }
        let complete = self.rows.len() - list;
        self.rows.extend(&tree.unknowns[node.boundary.clone()]);
        self.columns.extend(&tree.unknowns[node.boundary.clone()]);
        let m = self.rows.len() - list;
        for k in 0..m {
            row_at[self.rows[list + k] as usize] = k as u32;
            column_at[self.columns[list + k] as usize] = k as u32;
        }

        front.clear();
        front.resize(m * m, 0.0);
        for &(row, slot) in &tree.entries[node.entries.clone()] {
            let (row, slot) = (row as usize, slot as usize);
            let (column, value) = pattern.entry(slot);
            front[row_at[row] as usize * m + column_at[column] as usize] += value * self.scale[row];
        }
        for child in &waiting[children..] {
            let (rows, columns) = (&self.rows[child.list..], &self.columns[child.list..]);
            find_runs(&columns[..child.size], column_at, runs);
            let numbers = stack[child.stack..].chunks_exact(child.size);
            for (from, &row) in numbers.zip(&rows[..child.size]) {
                let to = &mut front[row_at[row as usize] as usize * m..][..m];
                for run in runs.iter() {
                    let from = &from[run.from..][..run.count];
                    for (to, from) in to[run.to..][..run.count].iter_mut().zip(from) {
                        *to += from;
                    }
                }
            }
        }
        let mut growth = waiting[children..].iter().fold(1.0_f64, |m, child| m.max(child.growth));
        if let Some(child) = waiting.get(children) {
            stack.truncate(child.stack);
            waiting.truncate(children);
        }

        let pivots = eliminate(
            &mut Front {
                a: front,
                rows: &mut self.rows[list..],
                columns: &mut self.columns[list..],
                complete,
                limit: TINY * growth,
            },
            bench,
        );
        self.flops += (m - pivots..m).map(|k| (k + 2 * k * k) as u64).sum::<u64>();
        self.delayed += complete - pivots;
        if node.is_root && pivots < complete {
            return Err(if all_finite(front) { Breakdown::Singular } else { Breakdown::NotFinite });
        }
        let numbers = self.numbers.len();
        self.numbers.extend_from_slice(&front[..pivots * m]);
        for row in front[pivots * m..].chunks_exact(m) {
            self.numbers.extend_from_slice(&row[..pivots]);
        }
        if !all_finite(&self.numbers[numbers..]) {
            return Err(Breakdown::NotFinite);
        }
        // What is left of large numbers that cancel is no pivot either.
        growth = growth.max(largest(&front[..pivots * m]));
        if node.is_root && front.iter().step_by(m + 1).any(|v| v.abs() < TINY * growth) {
            return Err(Breakdown::Singular);
        }
        self.pieces.push(Piece { size: m, pivots, list, numbers });
        if !node.is_root {
            waiting.push(Remainder {
                list: list + pivots,
                size: m - pivots,
                delayed: complete - pivots,
                stack: stack.len(),
                growth,
            });
            for row in front[pivots * m..].chunks_exact(m) {
                stack.extend_from_slice(&row[pivots..]);
            }
        }
        Ok(())
    }

    /// The sign of the determinant: that of the permutation of rows to columns, times those of the pivots.
    fn sign(&self, row_of: &mut [u32]) -> bool {
        let mut positive = true;
        for piece in &self.pieces {
            for k in 0..piece.pivots {
                row_of[self.columns[piece.list + k] as usize] = self.rows[piece.list + k];
                positive ^= self.numbers[piece.numbers + k * (piece.size + 1)] < 0.0;
            }
        }
        // A cycle of even length turns the sign. What has been seen maps to itself.
        for start in 0..row_of.len() {
            while row_of[start] as usize != start {
                let next = row_of[start] as usize;
                row_of.swap(start, next);
                positive = !positive;
            }
        }
        positive
    }

    /// Overwrites `y` and writes A⁻¹ y to `x`.
    pub fn solve(&self, y: &mut [f64], x: &mut [f64], gathered: &mut Vec<f64>) {
        for (y, scale) in y.iter_mut().zip(&self.scale) {
            *y *= scale;
        }
        for piece in &self.pieces {
            let Piece { size, pivots, list, numbers } = *piece;
            let rows = &self.rows[list..list + size];
            gathered.clear();
            gathered.extend(rows.iter().map(|&i| y[i as usize]));
            let (done, rest) = gathered.split_at_mut(pivots);
            let (upper, lower) = self.numbers[numbers..].split_at(pivots * size);
            for (k, row) in upper.chunks_exact(size).enumerate() {
                done[k] -= dot(&row[..k], &done[..k]);
            }
            if pivots > 0 {
                for (row, to) in lower.chunks_exact(pivots).zip(rest) {
                    *to -= dot(row, done);
                }
            }
            for (&i, &value) in rows.iter().zip(gathered.iter()) {
                y[i as usize] = value;
            }
        }
        for piece in self.pieces.iter().rev() {
            let Piece { size, pivots, list, numbers } = *piece;
            let columns = &self.columns[list..list + size];
            gathered.clear();
            gathered.extend(self.rows[list..list + pivots].iter().map(|&i| y[i as usize]));
            gathered.extend(columns[pivots..].iter().map(|&i| x[i as usize]));
            let (done, rest) = gathered.split_at_mut(pivots);
            let upper = &self.numbers[numbers..][..pivots * size];
            // As much as can be is done forward through memory, which is faster.
            for (to, row) in done.iter_mut().zip(upper.chunks_exact(size)) {
                *to -= dot(&row[pivots..], rest);
            }
            for (k, row) in upper.chunks_exact(size).enumerate().rev() {
                let value = (done[k] - dot(&row[k + 1..pivots], &done[k + 1..])) / row[k];
                done[k] = value;
                x[columns[k] as usize] = value;
            }
        }
    }

    /// Overwrites `y` and writes A⁻ᵀ y to `x`: with P S A Q = L U, forward with Uᵀ by columns and back with Lᵀ by rows.
    pub fn solve_transposed(&self, y: &mut [f64], x: &mut [f64], gathered: &mut Vec<f64>) {
        for piece in &self.pieces {
            let Piece { size, pivots, list, numbers } = *piece;
            let columns = &self.columns[list..list + size];
            gathered.clear();
            gathered.extend(columns.iter().map(|&i| y[i as usize]));
            for (k, row) in self.numbers[numbers..][..pivots * size].chunks_exact(size).enumerate() {
                let value = gathered[k] / row[k];
                gathered[k] = value;
                subtract(&mut gathered[k + 1..], value, &row[k + 1..]);
            }
            for (&i, &value) in columns.iter().zip(gathered.iter()) {
                y[i as usize] = value;
            }
        }
        for piece in self.pieces.iter().rev() {
            let Piece { size, pivots, list, numbers } = *piece;
            let rows = &self.rows[list..list + size];
            gathered.clear();
            gathered.extend(self.columns[list..list + pivots].iter().map(|&i| y[i as usize]));
            let (upper, lower) = self.numbers[numbers..].split_at(pivots * size);
            if pivots > 0 {
                for (row, &i) in lower.chunks_exact(pivots).zip(&rows[pivots..]) {
                    subtract(gathered, x[i as usize], row);
                }
            }
            for (k, row) in upper.chunks_exact(size).enumerate().rev() {
                let (before, value) = gathered.split_at_mut(k);
                subtract(before, value[0], &row[..k]);
                x[rows[k] as usize] = value[0];
            }
        }
        for (x, scale) in x.iter_mut().zip(&self.scale) {
            *x *= scale;
        }
    }

    /// Numbers held.
    pub fn fill(&self) -> usize {
        self.numbers.len()
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        super::bytes(&self.pieces)
            + super::bytes(&self.rows)
            + super::bytes(&self.columns)
            + super::bytes(&self.numbers)
            + super::bytes(&self.scale)
    }
}

pub(super) fn find_runs(columns: &[u32], column_at: &[u32], runs: &mut Vec<Run>) {
    runs.clear();
    for (from, &column) in columns.iter().enumerate() {
        let to = column_at[column as usize] as usize;
        match runs.last_mut() {
            Some(run) if run.to + run.count == to => run.count += 1,
            _ => runs.push(Run { from, to, count: 1 }),
        }
    }
}
