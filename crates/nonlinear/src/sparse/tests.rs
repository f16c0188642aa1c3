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
