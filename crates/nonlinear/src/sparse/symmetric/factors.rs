//! The numeric phase: symmetric fronts put together and eliminated up the tree, and the solves with what is kept of
//! them.

use super::front::{Bench, Front, eliminate};
use crate::Breakdown;
use crate::lanes::{all_finite, dot, subtract};
use crate::sparse::factors::{Run, find_runs};
use crate::sparse::pattern::Pattern;
use crate::sparse::symbolic::Tree;
use crate::symmetric::{Inertia, equilibrate, tiny};

/// What is kept of one front.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Rows of the front.
    size: usize,
    /// The leading ones are eliminated here.
    pivots: usize,
    /// Where its unknowns begin in the list.
    list: usize,
    /// Where its numbers begin: the pivot rows, each from its diagonal on.
    numbers: usize,
    /// Where its pivots begin among all.
    first: usize,
}

/// A factorisation P S A S Pᵀ = Lᵀ D L with powers of two in S, held by fronts.
#[derive(Debug, Default)]
pub(super) struct Factors {
    pieces: Vec<Piece>,
    unknowns: Vec<u32>,
    /// L, and the inverse of D in the places of D.
    numbers: Vec<f64>,
    /// By pivot: does one of two rows begin here?
    is_pair: Vec<bool>,
    scale: Vec<f64>,
    pub inertia: Inertia,
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
        self.unknowns.clone_from(&from.unknowns);
        self.numbers.clone_from(&from.numbers);
        self.is_pair.clone_from(&from.is_pair);
        self.scale.clone_from(&from.scale);
        (self.inertia, self.flops, self.delayed) = (from.inertia, from.flops, from.delayed);
    }
}

/// A remainder that waits for its parent.
#[derive(Clone, Copy, Debug)]
struct Remainder {
    /// Where its unknowns begin in the list.
    list: usize,
    size: usize,
    /// The leading ones are delayed pivots.
    delayed: usize,
    /// Where its numbers begin on the stack: its rows, each from its diagonal on.
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
    place: Vec<u32>,
    largest: Vec<f64>,
    runs: Vec<Run>,
    bench: Bench,
}

impl Scratch {
    /// Bytes held.
    pub fn memory(&self) -> usize {
        crate::sparse::bytes(&self.front)
            + crate::sparse::bytes(&self.stack)
            + crate::sparse::bytes(&self.place)
            + crate::sparse::bytes(&self.largest)
            + self.bench.memory()
    }
}

impl Factors {
    /// Forgets what is there.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.unknowns.clear();
        self.numbers.clear();
        self.is_pair.clear();
        self.scale.clear();
        (self.inertia, self.flops, self.delayed) = (Inertia::default(), 0, 0);
    }

    /// Is there a factorisation of a matrix of `n` rows?
    pub fn is_complete(&self, n: usize) -> bool {
        self.scale.len() == n
    }

    /// Factorises a matrix of which the pattern holds the upper triangle. Nothing is left on failure.
    pub fn compute(
        &mut self,
        pattern: &Pattern,
        tree: &Tree,
        scratch: &mut Scratch,
    ) -> Result<(), Breakdown> {
        self.clear();
        scratch.stack.clear();
        scratch.waiting.clear();
        scratch.place.resize(pattern.size(), 0);
        // Half of what an unsymmetric matrix needs; a few delayed pivots must not make the largest list grow to twice
        // its length.
        let fill = (tree.fill + pattern.size()) / 2;
        self.numbers.reserve(fill + fill / 64);
        self.unknowns.reserve(tree.rows + tree.rows / 64);
        scratch.stack.reserve(tree.stack / 2 + tree.stack / 16);
        let done = self
            .equilibrate(pattern, &mut scratch.largest)
            .and_then(|()| (0..tree.nodes.len()).try_for_each(|i| self.eliminate(pattern, tree, i, scratch)));
        if done.is_err() {
            self.clear();
        }
        done
    }

    /// Brings the largest number of each row to about one.
    fn equilibrate(&mut self, pattern: &Pattern, largest: &mut Vec<f64>) -> Result<(), Breakdown> {
        let n = pattern.size();
        if (0..n).any(|i| !all_finite(pattern.row(i).1)) {
            return Err(Breakdown::NotFinite);
        }
        let diagonal = |i: usize| {
            // The first of what stands in the upper triangle.
            let (columns, values) = pattern.row(i);
            if columns.first() == Some(&(i as u32)) { values[0] } else { 0.0 }
        };
        let sweep = |weight: &[f64], largest: &mut [f64]| {
            largest.fill(0.0);
            for i in 0..n {
                let (columns, values) = pattern.row(i);
                let (own, mut most) = (weight[i], largest[i]);
                for (&j, &value) in columns.iter().zip(values) {
                    let j = j as usize;
                    most = most.max(value.abs() * weight[j]);
                    largest[j] = largest[j].max(value.abs() * own);
                }
                largest[i] = most;
            }
        };
        self.scale.resize(n, 1.0);
        largest.resize(n, 0.0);
        equilibrate(diagonal, sweep, &mut self.scale, largest);
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
        let Scratch { front, stack, waiting, place, runs, bench, .. } = scratch;
        let node = &tree.nodes[i];
        let children = waiting.len() - node.children;
        let list = self.unknowns.len();
        // With the delayed pivots in front, the unknowns of each child are here in the order that they have there.
        for child in &waiting[children..] {
            self.unknowns.extend_from_within(child.list..child.list + child.delayed);
        }
        self.unknowns.extend(&tree.unknowns[node.own.clone()]);
        let complete = self.unknowns.len() - list;
        self.unknowns.extend(&tree.unknowns[node.boundary.clone()]);
        let m = self.unknowns.len() - list;
        for (k, &unknown) in self.unknowns[list..].iter().enumerate() {
            place[unknown as usize] = k as u32;
        }

        front.clear();
        front.resize(m * m, 0.0);
        for &(row, slot) in &tree.entries[node.entries.clone()] {
            let row = row as usize;
            let (column, value) = pattern.entry(slot as usize);
            let (p, q) = (place[row] as usize, place[column] as usize);
            front[p.min(q) * m + p.max(q)] += value * self.scale[row] * self.scale[column];
        }
        for child in &waiting[children..] {
            let unknowns = &self.unknowns[child.list..][..child.size];
            find_runs(unknowns, place, runs);
            let (mut from, mut run) = (&stack[child.stack..], 0);
            for (k, &row) in unknowns.iter().enumerate() {
                let to = &mut front[place[row as usize] as usize * m..][..m];
                if runs[run].from + runs[run].count == k {
                    run += 1;
                }
                for run in &runs[run..] {
                    let start = run.from.max(k);
                    let count = run.from + run.count - start;
                    let to = &mut to[run.to + start - run.from..][..count];
                    for (to, from) in to.iter_mut().zip(&from[start - k..][..count]) {
                        *to += from;
                    }
                }
                from = &from[child.size - k..];
            }
        }
        let growth = waiting[children..].iter().fold(1.0_f64, |m, child| m.max(child.growth));
        if let Some(child) = waiting.get(children) {
            stack.truncate(child.stack);
            waiting.truncate(children);
        }

        let first = self.is_pair.len();
        let mut dense = Front {
            a: front,
            unknowns: &mut self.unknowns[list..],
            complete,
            growth,
            tiny: tiny(pattern.size()),
            is_pair: &mut self.is_pair,
            inertia: &mut self.inertia,
        };
        let pivots = eliminate(&mut dense, bench);
        let growth = dense.growth;
        self.flops += (m - pivots..m).map(|k| (k + k * (k + 1)) as u64).sum::<u64>();
        self.delayed += complete - pivots;
        let numbers = self.numbers.len();
        for k in 0..pivots {
            self.numbers.extend_from_slice(&front[k * m + k..(k + 1) * m]);
        }
        // Where nothing is missing some row always has a pivot, among numbers.
        if node.is_root && pivots < complete || !all_finite(&self.numbers[numbers..]) {
            return Err(Breakdown::NotFinite);
        }
        self.pieces.push(Piece { size: m, pivots, list, numbers, first });
        if !node.is_root {
            waiting.push(Remainder {
                list: list + pivots,
                size: m - pivots,
                delayed: complete - pivots,
                stack: stack.len(),
                growth,
            });
            for k in pivots..m {
                stack.extend_from_slice(&front[k * m + k..(k + 1) * m]);
            }
        }
        Ok(())
    }

    /// Overwrites `y` by A⁻¹ y.
    pub fn solve(&self, y: &mut [f64], gathered: &mut Vec<f64>) {
        for (y, scale) in y.iter_mut().zip(&self.scale) {
            *y *= scale;
        }
        for piece in &self.pieces {
            let unknowns = &self.unknowns[piece.list..][..piece.size];
            let is_pair = &self.is_pair[piece.first..][..piece.pivots];
            gathered.clear();
            gathered.extend(unknowns.iter().map(|&i| y[i as usize]));
            let mut rows = &self.numbers[piece.numbers..];
            let mut k = 0;
            while k < piece.pivots {
                let (one, rest) = rows.split_at(piece.size - k);
                let x = gathered[k];
                if is_pair[k] {
                    let (two, rest) = rest.split_at(piece.size - k - 1);
                    let z = gathered[k + 1];
                    for ((to, a), b) in gathered[k + 2..].iter_mut().zip(&one[2..]).zip(&two[1..]) {
                        *to -= x * a + z * b;
                    }
                    gathered[k] = one[0] * x + one[1] * z;
                    gathered[k + 1] = one[1] * x + two[0] * z;
                    (rows, k) = (rest, k + 2);
                } else {
                    subtract(&mut gathered[k + 1..], x, &one[1..]);
                    gathered[k] = one[0] * x;
                    (rows, k) = (rest, k + 1);
                }
            }
            for (&i, &value) in unknowns.iter().zip(gathered.iter()) {
                y[i as usize] = value;
            }
        }
        for piece in self.pieces.iter().rev() {
            let Piece { size, pivots, .. } = *piece;
            let unknowns = &self.unknowns[piece.list..][..size];
            let is_pair = &self.is_pair[piece.first..][..pivots];
            gathered.clear();
            gathered.extend(unknowns.iter().map(|&i| y[i as usize]));
            let mut end = piece.numbers + pivots * size - pivots * pivots.saturating_sub(1) / 2;
            for k in (0..pivots).rev() {
                let row = &self.numbers[end - (size - k)..end];
                end -= size - k;
                // What stands beside the diagonal of a pair is D's.
                let next = if is_pair[k] { 2 } else { 1 };
                gathered[k] -= dot(&row[next..], &gathered[k + next..]);
            }
            for (&i, &value) in unknowns[..pivots].iter().zip(gathered.iter()) {
                y[i as usize] = value;
            }
        }
        for (y, scale) in y.iter_mut().zip(&self.scale) {
            *y *= scale;
        }
    }

    /// Numbers held.
    pub fn fill(&self) -> usize {
        self.numbers.len()
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        crate::sparse::bytes(&self.pieces)
            + crate::sparse::bytes(&self.unknowns)
            + crate::sparse::bytes(&self.numbers)
            + crate::sparse::bytes(&self.is_pair)
            + crate::sparse::bytes(&self.scale)
    }
}
