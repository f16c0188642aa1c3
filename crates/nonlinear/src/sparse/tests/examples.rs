//! Matrices to try.

use super::*;

/// A linear congruential generator: the same numbers on every machine.
pub struct Numbers(pub u64);

impl Numbers {
    /// Between -1 and 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Below `n`.
    pub fn pick(&mut self, n: usize) -> usize {
        ((0.5 + 0.5 * self.next()) * n as f64) as usize
    }
}

#[derive(Clone, Default)]
pub struct Example {
    pub n: usize,
    pub blocks: Vec<BlockPlace>,
    /// No place twice.
    pub entries: Vec<(usize, usize, f64)>,
}

impl Example {
    /// The matrix, assembled.
    pub fn sparse(&self) -> Sparse {
        let mut sparse = Sparse::default();
        sparse.arrange(self.n, &self.blocks);
        for &(i, j, v) in &self.entries {
            sparse.add(i, j, v);
        }
        sparse
    }

    pub fn transposed(&self) -> Self {
        Self { entries: self.entries.iter().map(|&(i, j, v)| (j, i, v)).collect(), ..self.clone() }
    }

    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut b = vec![0.0; self.n];
        for &(i, j, v) in &self.entries {
            b[i] += v * x[j];
        }
        b
    }

    /// A new block; gives its first unknown.
    fn block(&mut self, count: usize, place: [f64; 3]) -> usize {
        self.blocks.push(BlockPlace { first: self.n, count, place });
        self.n += count;
        self.n - count
    }

    /// Random numbers in all entries between two blocks.
    fn fill(&mut self, numbers: &mut Numbers, rows: (usize, usize), columns: (usize, usize)) {
        for i in 0..rows.1 {
            self.entries.extend((0..columns.1).map(|j| (rows.0 + i, columns.0 + j, numbers.next())));
        }
    }
}

fn points(sides: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..sides[0] * sides[1] * sides[2])
        .map(move |k| [k / sides[2] / sides[1], k / sides[2] % sides[1], k % sides[2]])
}

/// The number of the next point along an axis, if there is one.
fn next(sides: [usize; 3], point: [usize; 3], axis: usize) -> Option<usize> {
    let mut to = point;
    to[axis] += 1;
    (to[axis] < sides[axis]).then_some((to[0] * sides[1] + to[1]) * sides[2] + to[2])
}

/// Blocks of six on a lattice, full of random numbers between next neighbours.
pub fn lattice(sides: [usize; 3]) -> Example {
    let mut numbers = Numbers(1);
    let mut example = Example::default();
    for point in points(sides) {
        let me = example.block(6, point.map(|x| x as f64));
        let before = example.entries.len();
        example.fill(&mut numbers, (me, 6), (me, 6));
        for i in 0..6 {
            example.entries[before + 7 * i].2 += 3.0;
        }
        for axis in 0..3 {
            if let Some(other) = next(sides, point, axis) {
                example.fill(&mut numbers, (me, 6), (6 * other, 6));
                example.fill(&mut numbers, (6 * other, 6), (me, 6));
            }
        }
    }
    example
}

/// Beams between the nodes of a lattice, one node held by springs, which are the last six entries. A node's pose
/// has equilibrium in its rows and nothing in its diagonal block; a beam's wrench has a compliance, none along the
/// axis.
pub fn beams(sides: [usize; 3]) -> Example {
    let mut numbers = Numbers(7);
    let mut example = Example::default();
    for point in points(sides) {
        example.block(6, point.map(|x| x as f64));
    }
    for (k, point) in points(sides).enumerate() {
        for axis in 0..3 {
            let Some(other) = next(sides, point, axis) else { continue };
            let (from, to) = (6 * k, 6 * other);
            let mut middle = point.map(|x| x as f64);
            middle[axis] += 0.5;
            let at = example.block(6, middle);
            let entries = &mut example.entries;
            for i in 0..6 {
                let compliance = if i == 3 + axis { 0.0 } else { [1.0, 0.3][i / 3] };
                for j in 0..6 {
                    let v = if i == j { compliance } else { 0.1 * compliance * numbers.next() };
                    entries.push((at + i, at + j, -v));
                }
                entries.extend([(at + i, from + i, -1.0), (at + i, to + i, 1.0)]);
                entries.extend([(from + i, at + i, 1.0), (to + i, at + i, -1.0)]);
            }
            // The lever arm.
            let (y, z) = ((axis + 1) % 3, (axis + 2) % 3);
            for (i, j, v) in [(3 + y, z, 1.0), (3 + z, y, -1.0)] {
                entries.extend([(at + i, from + j, v), (from + j, at + i, -v)]);
            }
        }
    }
    example.entries.extend((0..6).map(|k| (k, k, 1.0)));
    example
}

/// Bodies at random places, tied to their nearest by blocks of random size: some compliant, some that are
/// constraints with nothing in their diagonal block, some with a pattern that is not symmetric.
pub fn network(seed: u64, bodies: usize) -> Example {
    let mut numbers = Numbers(seed);
    let mut example = Example::default();
    for k in 0..bodies {
        let place = std::array::from_fn(|_| numbers.next());
        let body = example.block(6, place);
        if k % 5 == 0 {
            example.fill(&mut numbers, (body, 6), (body, 6));
        }
    }
    let mut constrained = vec![false; bodies];
    for k in 0..bodies {
        let here = example.blocks[k].place;
        let far =
            |i: &usize| (0..3).map(|axis| (example.blocks[*i].place[axis] - here[axis]).powi(2)).sum::<f64>();
        let mut others: Vec<usize> = (0..bodies).filter(|&i| i != k).collect();
        others.sort_by(|a, b| far(a).total_cmp(&far(b)));
        for &other in others.iter().take(2) {
            let there = example.blocks[other].place;
            let place = std::array::from_fn(|axis| 0.5 * (here[axis] + there[axis]));
            let kind = numbers.pick(4);
            let is_constraint = kind == 0 && !constrained[k] && !constrained[other];
            let count = if is_constraint { 3 + numbers.pick(3) } else { 6 + numbers.pick(13) };
            let tie = example.block(count, place);
            if is_constraint {
                (constrained[k], constrained[other]) = (true, true);
            } else {
                example.fill(&mut numbers, (tie, count), (tie, count));
            }
            for body in [k, other] {
                example.fill(&mut numbers, (tie, count), (6 * body, 6));
                if kind != 3 || body == k {
                    example.fill(&mut numbers, (6 * body, 6), (tie, count));
                }
            }
        }
    }
    example
}
