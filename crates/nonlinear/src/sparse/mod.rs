//! Sparse LU of matrices whose unknowns come in blocks that have a place in space.
//!
//! The order of elimination comes from nested dissection of the blocks by their places (A. George 1973, see
//! `ordering.rs`). The elimination is multifrontal (I. S. Duff and J. K. Reid, "The multifrontal solution of
//! indefinite sparse symmetric linear equations", ACM Trans. Math. Softw. 9 (1983) 302-325, here for unsymmetric
//! values on a symmetric pattern): each step gathers its unknowns and all that they touch in a small dense
//! matrix, its front, eliminates there with the pivoting of a dense LU, and hands the remainder to the next
//! front up the tree. Pivots are sought among the rows that are complete in the front; where those are weak
//! beside the others the unknown is left to the parent, so that the zero diagonals of constraints do no harm.
//!
//! It is deterministic: equal entries in an equal pattern give equal bits, on any x86-64 processor, and the sign of
//! the determinant is that of an exact count of exchanges.
//!
//! Symmetric matrices have factors of their own at half the cost (`symmetric/`).
//!
//! Absent: several threads, factors out of memory, orderings of graphs without places better than cuts by distance,
//! columns scaled, estimates of the condition, and static pivoting; a matrix with many weak pivots moves them up the
//! tree at the price of larger fronts.

mod factors;
mod front;
mod ordering;
mod pattern;
mod symbolic;
mod symmetric;

use crate::Breakdown;
use factors::{Factors, Scratch};
use pattern::Pattern;
use std::sync::Arc;
use symbolic::Tree;

pub use symmetric::SparseSymmetric;

/// Solutions that leave a larger part of a row than this are refined. Lattices of 10,000 beams leave 1e-12 to 1e-11
/// by the weakest pivots that are let pass, and 1e-15 after one step.
const REFINED: f64 = 1e-12;

/// Consecutive unknowns that belong together, and where they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlockPlace {
    /// The first of them.
    pub first: usize,
    /// How many there are.
    pub count: usize,
    /// Where they are; only which coordinates are larger than others counts.
    pub place: [f64; 3],
}

/// A square sparse matrix and its factorisation, storage kept from one use to the next.
#[derive(Debug, Default)]
pub struct Sparse {
    blocks: Vec<BlockPlace>,
    pattern: Pattern,
    /// Of the present pattern.
    tree: Option<Arc<Tree>>,
    factors: Factors,
    /// Do the factors belong to the values that are assembled?
    current: bool,
    scratch: Scratch,
    work: [Vec<f64>; 4],
}

impl Clone for Sparse {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, from: &Self) {
        self.blocks.clone_from(&from.blocks);
        self.pattern.clone_from(&from.pattern);
        self.tree.clone_from(&from.tree);
        self.factors.clone_from(&from.factors);
        self.current = from.current;
    }
}

impl Sparse {
    /// Makes it an `n` x `n` matrix of zeros whose unknowns come in `blocks`, and forgets which entries there are.
    pub fn arrange(&mut self, n: usize, blocks: &[BlockPlace]) {
        cover(n, blocks, &mut self.blocks);
        self.pattern.arrange(n);
        self.tree = None;
        self.factors.clear();
        self.current = false;
    }

    /// Sets all entries to zero and starts a new assembly. The factors stay.
    pub fn reset(&mut self) {
        self.pattern.reset();
        self.current = false;
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.pattern.size()
    }

    /// Adds to an entry. It is fast as long as the sequence of calls is that of the last assembly.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.pattern.add(row, column, value);
    }

    /// Calls `f(row, column, value)` for every entry; what has been added to a new entry since the last
    /// factorisation may come in several pieces.
    pub fn for_each(&self, f: impl FnMut(usize, usize, f64)) {
        self.pattern.for_each(f);
    }

    /// Factorises; the entries stay. Singular when a pivot that no front could do without is below 1e-14 of the
    /// largest number in the pivot rows before it, each row having been scaled to a largest entry of about one.
    pub fn factorise(&mut self) -> Result<(), Breakdown> {
        self.current = false;
        if self.pattern.settle() {
            self.tree = None;
        }
        let (pattern, blocks) = (&self.pattern, &self.blocks);
        let tree = self.tree.get_or_insert_with(|| Arc::new(Tree::new(pattern, blocks)));
        self.factors.compute(&self.pattern, tree, &mut self.scratch)?;
        self.current = true;
        Ok(())
    }

    /// Is the determinant positive?
    pub fn is_positive(&self) -> bool {
        self.factors.positive
    }

    /// Solves in place, with one step of refinement where weak pivots have spoilt the solution and the entries are
    /// still those that were factorised. Without factors the result is not a number.
    pub fn solve(&mut self, b: &mut [f64]) {
        self.solve_by(b, Factors::solve, |pattern, x, b, r, _| residual(pattern, x, b, r));
    }

    /// Solves Aᵀ x = b in place, like [`Sparse::solve`].
    pub fn solve_transposed(&mut self, b: &mut [f64]) {
        self.solve_by(b, Factors::solve_transposed, residual_transposed);
    }

    #[inline(always)]
    fn solve_by(
        &mut self,
        b: &mut [f64],
        solve: impl Fn(&Factors, &mut [f64], &mut [f64], &mut Vec<f64>),
        residual: impl Fn(&Pattern, &[f64], &[f64], &mut [f64], &mut Vec<f64>) -> f64,
    ) {
        if !self.factors.is_complete(self.size()) {
            b.fill(f64::NAN);
            return;
        }
        let [y, x, correction, gathered] = &mut self.work;
        y.clear();
        y.extend_from_slice(b);
        x.resize(b.len(), 0.0);
        correction.resize(b.len(), 0.0);
        solve(&self.factors, y, x, gathered);
        if self.current && residual(&self.pattern, x, b, y, gathered) > REFINED {
            solve(&self.factors, y, correction, gathered);
            for (x, correction) in x.iter_mut().zip(correction) {
                *x += *correction;
            }
        }
        b.copy_from_slice(x);
    }

    /// Numbers held in the factors.
    pub fn fill(&self) -> usize {
        self.factors.fill()
    }

    /// Additions and multiplications of the last factorisation.
    pub fn flops(&self) -> u64 {
        self.factors.flops
    }

    /// Pivots that were too weak where they were first tried; one counts again in each front that it passes.
    pub fn delayed(&self) -> usize {
        self.factors.delayed
    }

    /// Bytes held, with what a factorisation needs for its own use.
    pub fn memory(&self) -> usize {
        bytes(&self.blocks)
            + self.pattern.memory()
            + self.tree.as_ref().map_or(0, |tree| tree.memory())
            + self.factors.memory()
            + self.scratch.memory()
            + self.work.iter().map(bytes).sum::<usize>()
    }
}

/// Each unknown in one block, whatever was given, in order.
fn cover(n: usize, blocks: &[BlockPlace], whole: &mut Vec<BlockPlace>) {
    whole.clear();
    let mut sorted = blocks.to_vec();
    sorted.sort_by_key(|block| block.first);
    let mut next = 0;
    for block in sorted {
        let (first, end) = (block.first.clamp(next, n), (block.first + block.count).min(n));
        if next < first {
            whole.push(BlockPlace { first: next, count: first - next, place: block.place });
        }
        if first < end {
            whole.push(BlockPlace { first, count: end - first, place: block.place });
            next = end;
        } else {
            next = first;
        }
    }
    if next < n {
        let place = whole.last().map_or([0.0; 3], |block| block.place);
        whole.push(BlockPlace { first: next, count: n - next, place });
    }
}

/// r = b - A x, and how large it is beside what it is a difference of: the largest |r| / (|A| |x| + |b|) of a row.
fn residual(pattern: &Pattern, x: &[f64], b: &[f64], r: &mut [f64]) -> f64 {
    let mut worst = 0.0_f64;
    for (i, (r, &b)) in r.iter_mut().zip(b).enumerate() {
        let (columns, values) = pattern.row(i);
        let (mut rest, mut size) = (b, b.abs());
        for (&j, &value) in columns.iter().zip(values) {
            let product = value * x[j as usize];
            rest -= product;
            size += product.abs();
        }
        *r = rest;
        if size > 0.0 {
            worst = worst.max(rest.abs() / size);
        }
    }
    worst
}

/// [`residual`] of Aᵀ x = b.
fn residual_transposed(pattern: &Pattern, x: &[f64], b: &[f64], r: &mut [f64], sizes: &mut Vec<f64>) -> f64 {
    r.copy_from_slice(b);
    sizes.clear();
    sizes.extend(b.iter().map(|b| b.abs()));
    for (i, &x) in x.iter().enumerate() {
        let (columns, values) = pattern.row(i);
        for (&j, &value) in columns.iter().zip(values) {
            let product = value * x;
            r[j as usize] -= product;
            sizes[j as usize] += product.abs();
        }
    }
    let parts = r.iter().zip(sizes.iter()).filter(|(_, size)| **size > 0.0).map(|(r, size)| r.abs() / size);
    parts.fold(0.0, f64::max)
}

fn bytes<T>(v: &Vec<T>) -> usize {
    v.capacity() * size_of::<T>()
}

#[cfg(test)]
mod tests;
