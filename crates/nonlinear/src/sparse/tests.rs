use super::*;
use crate::Dense;
use std::time::Instant;

/// A linear congruential generator: the same numbers on every machine.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The entries of a lattice of blocks of six that touch their next neighbours.
fn lattice(sides: [usize; 3]) -> (Vec<BlockPlace>, Vec<(usize, usize)>) {
    let number = |i: usize, j: usize, k: usize| (i * sides[1] + j) * sides[2] + k;
    let (mut blocks, mut pairs) = (Vec::new(), Vec::new());
    for i in 0..sides[0] {
        for j in 0..sides[1] {
            for k in 0..sides[2] {
                let me = number(i, j, k);
                blocks.push(BlockPlace { first: 6 * me, count: 6, place: [i as f64, j as f64, k as f64] });
                pairs.push((me, me));
                for (di, dj, dk) in [(1, 0, 0), (0, 1, 0), (0, 0, 1)] {
                    if i + di < sides[0] && j + dj < sides[1] && k + dk < sides[2] {
                        pairs.push((me, number(i + di, j + dj, k + dk)));
                        pairs.push((number(i + di, j + dj, k + dk), me));
                    }
                }
            }
        }
    }
    (blocks, pairs)
}

#[test]
#[ignore = "a measurement"]
fn how_long_lattices_take() {
    for sides in [[32, 32, 1], [100, 100, 1], [173, 173, 1], [20, 20, 20]] {
        let (blocks, pairs) = lattice(sides);
        let n = 6 * blocks.len();
        let mut a = Sparse::default();
        a.arrange(n, &blocks);
        let fill = |a: &mut Sparse| {
            let mut numbers = Numbers(1);
            for &(p, q) in &pairs {
                for i in 0..6 {
                    for j in 0..6 {
                        let strong = if p == q && i == j { 3.0 } else { 0.0 };
                        a.add(6 * p + i, 6 * q + j, numbers.next() + strong);
                    }
                }
            }
        };
        let t = Instant::now();
        fill(&mut a);
        let first = t.elapsed();
        let t = Instant::now();
        a.reset();
        fill(&mut a);
        let again = t.elapsed();
        let t = Instant::now();
        a.pattern.settle();
        let settle = t.elapsed();
        let t = Instant::now();
        a.tree = Some(Arc::new(Tree::new(&a.pattern, &a.blocks)));
        let symbolic = t.elapsed();
        let t = Instant::now();
        a.factorise().unwrap();
        let numeric1 = t.elapsed();
        let t = Instant::now();
        a.factorise().unwrap();
        let numeric = t.elapsed();
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut b = vec![0.0; n];
        a.for_each(|i, j, v| b[i] += v * x[j]);
        let t = Instant::now();
        a.solve(&mut b);
        let solve = t.elapsed();
        let error = b.iter().zip(&x).fold(0.0_f64, |m, (b, x)| m.max((b - x).abs()));
        println!(
            "{sides:?}: assembly {first:.1?} then {again:.1?}, settle {settle:.1?}, symbolic {symbolic:.1?}, \
             numeric {numeric1:.1?} then {numeric:.1?} ({:.2} Gflop, {:.1} Gflop/s), solve {solve:.1?}, \
             fill {:.1}M, memory {} MB, scratch {} MB, delayed {}, error {error:.1e}, fronts {}, nodes",
            a.flops() as f64 * 1e-9,
            a.flops() as f64 * 1e-9 / numeric.as_secs_f64(),
            a.fill() as f64 * 1e-6,
            a.memory() >> 20,
            a.scratch.memory() >> 20,
            a.delayed(),
            a.tree.as_ref().unwrap().nodes.len(),
        );
    }
}

/// Beams between the nodes of a square lattice: a node's pose has equilibrium in its rows and an empty diagonal
/// block; a beam's wrench has a compliance, singular along the axis.
fn beams(side: usize) -> (usize, Vec<BlockPlace>, Vec<(usize, usize, f64)>) {
    let mut numbers = Numbers(7);
    let (mut blocks, mut entries) = (Vec::new(), Vec::new());
    let mut n = 0;
    let mut block = |place: [f64; 3]| {
        blocks.push(BlockPlace { first: n, count: 6, place });
        n += 6;
        n - 6
    };
    let nodes: Vec<usize> = (0..side * side).map(|k| block([(k / side) as f64, (k % side) as f64, 0.0])).collect();
    for i in 0..side {
        for j in 0..side {
            for (di, dj) in [(1, 0), (0, 1)] {
                if i + di >= side || j + dj >= side {
                    continue;
                }
                let (from, to) = (nodes[i * side + j], nodes[(i + di) * side + j + dj]);
                let at = block([i as f64 + 0.5 * di as f64, j as f64 + 0.5 * dj as f64, 0.0]);
                let (x, y) = (di as f64, dj as f64);
                for k in 0..6 {
                    let compliance = if k == 3 + dj { 0.0 } else if k < 3 { 1.0 } else { 0.3 };
                    for l in 0..6 {
                        let v = if k == l { compliance } else { 0.1 * compliance * numbers.next() };
                        entries.push((at + k, at + l, -v));
                    }
                    entries.push((at + k, from + k, -1.0));
                    entries.push((at + k, to + k, 1.0));
                    entries.push((from + k, at + k, 1.0));
                    entries.push((to + k, at + k, -1.0));
                }
                // The lever arm.
                for (k, l, v) in [(3, 2, -y), (4, 2, x), (5, 0, y), (5, 1, -x)] {
                    entries.push((at + k, from + l, v));
                    entries.push((from + l, at + k, -v));
                }
            }
        }
    }
    for k in 0..6 {
        entries.push((nodes[0] + k, nodes[0] + k, 1.0));
    }
    (n, blocks, entries)
}

#[test]
#[ignore = "a measurement"]
fn where_dense_and_sparse_cost_the_same() {
    for side in [2, 3, 4, 5, 6, 7] {
        let (n, blocks, entries) = beams(side);
        let (mut sparse, mut dense) = (Sparse::default(), Dense::default());
        sparse.arrange(n, &blocks);
        let mut times = [[0.0; 3]; 2];
        let repeats = 200;
        for k in 0..repeats + 1 {
            let t = Instant::now();
            sparse.reset();
            for &(i, j, v) in &entries {
                sparse.add(i, j, v);
            }
            let t1 = Instant::now();
            sparse.factorise().unwrap();
            let t2 = Instant::now();
            let mut b = vec![1.0; n];
            sparse.solve(&mut b);
            let t3 = Instant::now();
            dense.reset(n);
            for &(i, j, v) in &entries {
                dense.add(i, j, v);
            }
            let t4 = Instant::now();
            dense.factorise().unwrap();
            let t5 = Instant::now();
            dense.solve(&mut b);
            let t6 = Instant::now();
            if k > 0 {
                for (i, t) in [t1 - t, t2 - t1, t3 - t2, t4 - t3, t5 - t4, t6 - t5].iter().enumerate() {
                    times[i / 3][i % 3] += t.as_secs_f64() * 1e6 / repeats as f64;
                }
            }
        }
        println!("{n}: {times:.1?} us");
    }
}

#[test]
#[ignore = "a measurement"]
fn how_well_beams_are_solved() {
    for side in [4, 10, 30, 70] {
        let (n, blocks, entries) = beams(side);
        let mut a = Sparse::default();
        a.arrange(n, &blocks);
        for &(i, j, v) in &entries {
            a.add(i, j, v);
        }
        let t = Instant::now();
        let end = a.factorise();
        let numeric = t.elapsed();
        let t = Instant::now();
        let again = a.factorise();
        println!("{side}: {n} {end:?} {again:?} {numeric:.1?} {:.1?} delayed {} static {} fill {} Gflop {}", t.elapsed(), a.delayed(), a.tree.as_ref().unwrap().fill, a.fill(), a.flops() as f64*1e-9);
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut b = vec![0.0; n];
        a.for_each(|i, j, v| b[i] += v * x[j]);
        let right = b.clone();
        a.solve(&mut b);
        for round in 0..3 {
        let mut r = right.clone();
        a.for_each(|i, j, v| r[i] -= v * b[j]);
        let residual = r.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let error = b.iter().zip(&x).fold(0.0_f64, |m, (b, x)| m.max((b - x).abs()));
        println!("   {round}: error {error:.1e} residual {residual:.1e}");
        a.solve(&mut r);
        for (b,r) in b.iter_mut().zip(&r) { *b += r; }
        }
        if n < 2000 {
            let mut d = Dense::default();
            d.reset(n);
            for &(i, j, v) in &entries { d.row_mut(i)[j] += v; }
            println!("dense {:?} {} {}", d.factorise(), d.is_positive(), a.is_positive());
            let mut b = right.clone();
            d.solve(&mut b);
            let error = b.iter().zip(&x).fold(0.0_f64, |m, (b, x)| m.max((b - x).abs()));
            println!("   dense error {error:.1e}");
        }
    }
}

#[test]
#[ignore = "x"]
fn floating() {
    for side in [2, 3, 5, 10, 20, 40] {
        let (n, blocks, mut entries) = beams(side);
        entries.truncate(entries.len() - 6);
        let mut a = Sparse::default();
        a.arrange(n, &blocks);
        for &(i, j, v) in &entries {
            a.add(i, j, v);
        }
        let end = a.factorise();
        let mut dd = None;
        if n < 2000 {
            let mut d = Dense::default();
            d.reset(n);
            for &(i, j, v) in &entries { d.row_mut(i)[j] += v; }
            dd = Some(d.factorise());
        }
        println!("{n}: {end:?} {dd:?}");
    }
}
