//! Elimination of the inner states of a chain of shooting segments, at a cost linear in their number.
//!
//! The unknowns of a chain are its head unknowns u (what moves its first state) and the states
//! x_1 .. x_m at the inner nodes, twelve numbers each. Each segment but the last gives twelve equations:
//!
//! ```text
//!   u     x_1    x_2    x_3   ...
//! [ -H     I                     ]   = g_0
//! [       -B_1    I              ]   = g_1
//! [              -B_2    I       ]   = g_2
//! ```
//!
//! x_1 .. x_{m-1} are eliminated one after another. What is known of x_i, `P u + Q x_i = c`, is stacked on
//! the next row, and the 24 x 12 column of x_i is factorised with partial pivoting over both. Plain
//! recursion x_{i+1} = B_i x_i would grow like the product of the B_i; choosing pivots from both rows keeps
//! growing and decaying directions apart and is stable for well-posed problems (S. J. Wright, "Stable parallel
//! algorithms for two-point boundary value problems", SIAM J. Sci. Stat. Comput. 13 (1992)).

use crate::Breakdown;

/// Numbers in a state.
pub const BLOCK: usize = 12;
/// A square block, rows first.
pub type Block = [[f64; BLOCK]; BLOCK];

const TALL: usize = 2 * BLOCK;

/// One eliminated state: the factorised column, and what its pivot rows say of u and the next state.
#[derive(Clone, Debug)]
struct Link {
    order: [usize; TALL],
    /// L below the diagonal, U on and above it.
    column: [[f64; BLOCK]; TALL],
    next: Block,
    head: Vec<[f64; BLOCK]>,
    known: [f64; BLOCK],
}

/// The elimination of one chain.
#[derive(Clone, Debug, Default)]
pub struct Chain {
    links: Vec<Link>,
    head_columns: usize,
    /// P and Q of the relation that is left, by rows.
    pub left_head: Vec<Vec<f64>>,
    /// Q.
    pub left_state: Vec<[f64; BLOCK]>,
    positive: bool,
}

impl Chain {
    /// Starts a chain: `x_1 = H u + g_0`, H given by rows.
    pub fn start(&mut self, head: &[Vec<f64>]) {
        self.links.clear();
        self.positive = true;
        self.head_columns = head[0].len();
        self.left_head = head.iter().map(|row| row.iter().map(|v| -v).collect()).collect();
        self.left_state = vec![[0.0; BLOCK]; BLOCK];
        for (i, row) in self.left_state.iter_mut().enumerate() {
            row[i] = 1.0;
        }
    }

    /// Eliminates the last state by the next segment, `x_{i+1} = B x_i + g_i`.
    pub fn extend(&mut self, b: &Block) -> Result<(), Breakdown> {
        let nu = self.head_columns;
        let mut column = [[0.0; BLOCK]; TALL];
        let mut next = [[0.0; BLOCK]; TALL];
        let mut head = vec![vec![0.0; nu]; TALL];
        for i in 0..BLOCK {
            column[i] = self.left_state[i];
            head[i].copy_from_slice(&self.left_head[i]);
            for j in 0..BLOCK {
                column[BLOCK + i][j] = -b[i][j];
            }
            next[BLOCK + i][i] = 1.0;
        }
        let mut order: [usize; TALL] = std::array::from_fn(|i| i);
        for k in 0..BLOCK {
            let mut pivot = k;
            for i in k + 1..TALL {
                if column[i][k].abs() > column[pivot][k].abs() {
                    pivot = i;
                }
            }
            let largest = column[pivot][k];
            if !largest.is_finite() {
                return Err(Breakdown::NotFinite);
            }
            if largest.abs() < 1e-300 {
                return Err(Breakdown::Singular);
            }
            if pivot != k {
                column.swap(k, pivot);
                next.swap(k, pivot);
                head.swap(k, pivot);
                order.swap(k, pivot);
                self.positive = !self.positive;
            }
            if largest < 0.0 {
                self.positive = !self.positive;
            }
            let (top, bottom) = column.split_at_mut(k + 1);
            let (next_top, next_bottom) = next.split_at_mut(k + 1);
            let (head_top, head_bottom) = head.split_at_mut(k + 1);
            for ((row, next_row), head_row) in bottom.iter_mut().zip(next_bottom).zip(head_bottom) {
                let factor = row[k] / top[k][k];
                row[k] = factor;
                if factor == 0.0 {
                    continue;
                }
                for j in k + 1..BLOCK {
                    row[j] -= factor * top[k][j];
                }
                for j in 0..BLOCK {
                    next_row[j] -= factor * next_top[k][j];
                }
                for (to, from) in head_row.iter_mut().zip(&head_top[k]) {
                    *to -= factor * from;
                }
            }
        }
        let mut link = Link {
            order,
            column,
            next: [[0.0; BLOCK]; BLOCK],
            head: Vec::with_capacity(nu),
            known: [0.0; BLOCK],
        };
        link.next.copy_from_slice(&next[..BLOCK]);
        for j in 0..nu {
            link.head.push(std::array::from_fn(|i| head[i][j]));
        }
        self.left_state.copy_from_slice(&next[BLOCK..]);
        for (to, from) in self.left_head.iter_mut().zip(&head[BLOCK..]) {
            to.copy_from_slice(from);
        }
        self.links.push(link);
        Ok(())
    }

    /// Number of eliminated states.
    pub fn eliminated(&self) -> usize {
        self.links.len()
    }

    /// Is the product of the pivots, with the sign of their permutations, positive?
    pub fn is_positive(&self) -> bool {
        self.positive
    }

    /// Takes the gaps g_0, g_1, ... through the elimination; returns c of `P u + Q x = c`.
    pub fn reduce(&mut self, gaps: &[[f64; BLOCK]]) -> [f64; BLOCK] {
        let mut known = gaps[0];
        for (link, gap) in self.links.iter_mut().zip(&gaps[1..]) {
            let stacked = |i: usize| if i < BLOCK { known[i] } else { gap[i - BLOCK] };
            let mut rhs: [f64; TALL] = std::array::from_fn(|i| stacked(link.order[i]));
            for k in 0..BLOCK {
                let top = rhs[k];
                for i in k + 1..TALL {
                    rhs[i] -= link.column[i][k] * top;
                }
            }
            link.known.copy_from_slice(&rhs[..BLOCK]);
            known.copy_from_slice(&rhs[BLOCK..]);
        }
        known
    }

    /// The eliminated states from u and the last one, in order, after [`Chain::reduce`].
    pub fn back_substitute(&self, head: &[f64], last: &[f64; BLOCK], states: &mut [[f64; BLOCK]]) {
        let mut next = *last;
        for (link, state) in self.links.iter().zip(states.iter_mut()).rev() {
            let mut x = link.known;
            for (column, u) in link.head.iter().zip(head) {
                for i in 0..BLOCK {
                    x[i] -= column[i] * u;
                }
            }
            for i in 0..BLOCK {
                for j in 0..BLOCK {
                    x[i] -= link.next[i][j] * next[j];
                }
            }
            for i in (0..BLOCK).rev() {
                for j in i + 1..BLOCK {
                    x[i] -= link.column[i][j] * x[j];
                }
                x[i] /= link.column[i][i];
            }
            *state = x;
            next = x;
        }
    }
}

#[cfg(test)]
mod tests;
