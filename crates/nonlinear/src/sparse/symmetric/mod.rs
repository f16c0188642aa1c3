//! Sparse LᵀDL of symmetric matrices, of either or no sign: the same fronts as the LU's, of which one triangle is held.
//!
//! Pivots stand on the diagonal, alone or in pairs, so that the signs of the eigenvalues can be counted. A row whose
//! diagonal is too weak beside what it touches, and that has no partner among the complete rows with which it is not,
//! is left to the parent. A row in which nothing is left is a zero eigenvalue wherever it is met.

mod factors;
mod front;

use super::pattern::Pattern;
use super::symbolic::Tree;
use super::{BlockPlace, REFINED, bytes, cover};
use crate::Breakdown;
use crate::symmetric::Inertia;
use factors::{Factors, Scratch};
use std::sync::Arc;

/// A sparse symmetric matrix and its factorisation, storage kept from one use to the next.
#[derive(Debug, Default)]
pub struct SparseSymmetric {
    blocks: Vec<BlockPlace>,
    /// The upper triangle of (A + Aᵀ)/2.
    pattern: Pattern,
    /// Of the present pattern.
    tree: Option<Arc<Tree>>,
    factors: Factors,
    /// Do the factors belong to the values that are assembled?
    current: bool,
    scratch: Scratch,
    work: [Vec<f64>; 4],
}

impl Clone for SparseSymmetric {
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

impl SparseSymmetric {
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

    /// Adds to an entry of A, one side of the diagonal at a time. It is fast as long as the sequence of calls is that
    /// of the last assembly.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let value = if row == column { value } else { 0.5 * value };
        self.pattern.add(row.min(column), row.max(column), value);
    }

    /// Calls `f(row, column, value)` for every entry of (A + Aᵀ)/2; what has been added to a new entry since the
    /// last factorisation may come in several pieces.
    pub fn for_each(&self, mut f: impl FnMut(usize, usize, f64)) {
        self.pattern.for_each(|i, j, value| {
            f(i, j, value);
            if i != j {
                f(j, i, value);
            }
        });
    }

    /// Factorises; the entries stay. See [`crate::Symmetric::factorise`].
    pub fn factorise(&mut self) -> Result<Inertia, Breakdown> {
        self.current = false;
        if self.pattern.settle() {
            self.tree = None;
        }
        let (pattern, blocks) = (&self.pattern, &self.blocks);
        let tree = self.tree.get_or_insert_with(|| Arc::new(Tree::new(pattern, blocks)));
        self.factors.compute(&self.pattern, tree, &mut self.scratch)?;
        self.current = true;
        Ok(self.factors.inertia)
    }

    /// Solves in place, with one step of refinement where weak pivots have spoilt the solution, none is zero and the
    /// entries are still those that were factorised. See [`crate::Symmetric::solve`].
    pub fn solve(&mut self, b: &mut [f64]) {
        if !self.factors.is_complete(self.size()) {
            b.fill(f64::NAN);
            return;
        }
        let [x, r, sizes, gathered] = &mut self.work;
        x.clear();
        x.extend_from_slice(b);
        self.factors.solve(x, gathered);
        let may_refine = self.current && self.factors.inertia.zero == 0;
        if may_refine && residual(&self.pattern, x, b, r, sizes) > REFINED {
            self.factors.solve(r, gathered);
            for (x, correction) in x.iter_mut().zip(r) {
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

/// r = b - A x of a matrix whose upper triangle is given, and how large it is beside what it is a difference of: the
/// largest |r| / (|A| |x| + |b|) of a row.
fn residual(pattern: &Pattern, x: &[f64], b: &[f64], r: &mut Vec<f64>, sizes: &mut Vec<f64>) -> f64 {
    r.clear();
    r.extend_from_slice(b);
    sizes.clear();
    sizes.extend(b.iter().map(|b| b.abs()));
    for i in 0..b.len() {
        let (columns, values) = pattern.row(i);
        let mut enter = |i: usize, product: f64| {
            r[i] -= product;
            sizes[i] += product.abs();
        };
        for (&j, &value) in columns.iter().zip(values) {
            let j = j as usize;
            enter(i, value * x[j]);
            if i != j {
                enter(j, value * x[i]);
            }
        }
    }
    let parts = r.iter().zip(sizes.iter()).filter(|(_, size)| **size > 0.0);
    parts.fold(0.0, |m, (r, size)| m.max(r.abs() / size))
}

#[cfg(test)]
mod tests;
