//! Wall times, to be read and not judged: `cargo test --release -p flexura-nonlinear -- --ignored --nocapture`.

use super::*;
use std::time::Instant;

#[test]
#[ignore = "a measurement"]
fn how_long_lattices_take() {
    for (name, example) in [
        ("lattice 32 x 32", lattice([32, 32, 1])),
        ("lattice 100 x 100", lattice([100, 100, 1])),
        ("lattice 173 x 173", lattice([173, 173, 1])),
        ("lattice 20 x 20 x 20", lattice([20, 20, 20])),
        ("beams 22 x 22", beams([22, 22, 1])),
        ("beams 70 x 70", beams([70, 70, 1])),
        ("beams 15 x 15 x 15", beams([15, 15, 15])),
        ("network of 2000", network(1, 2000)),
    ] {
        let n = example.n;
        let mut laps = Vec::new();
        let mut start = Instant::now();
        let mut lap = |what: &str| {
            laps.push(format!("{what} {:.1} ms", 1e3 * start.elapsed().as_secs_f64()));
            start = Instant::now();
        };
        let mut a = example.sparse();
        lap("assembly");
        a.reset();
        for &(i, j, v) in &example.entries {
            a.add(i, j, v);
        }
        lap("again");
        a.pattern.settle();
        lap("sorting");
        a.tree = Some(Arc::new(Tree::new(&a.pattern, &a.blocks)));
        lap("symbolic");
        a.factorise().unwrap();
        lap("numeric");
        a.factorise().unwrap();
        lap("again");
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut b = example.times(&x);
        lap("(product");
        a.solve(&mut b);
        lap(") solve");
        let mut kept = Sparse::default();
        kept.clone_from(&a);
        lap("copy");
        let error = b.iter().zip(&x).fold(0.0_f64, |m, (b, x)| m.max((b - x).abs()));
        println!(
            "{name}, n = {n}: {}, {:.2} Gflop, fill {:.2} M ({:.2} M without delays), {} MB, {} delays in {} \
             fronts, error {error:.0e}",
            laps.join(", "),
            a.flops() as f64 * 1e-9,
            a.fill() as f64 * 1e-6,
            a.tree.as_ref().unwrap().fill as f64 * 1e-6,
            a.memory() >> 20,
            a.delayed(),
            a.tree.as_ref().unwrap().nodes.len(),
        );
    }
}

#[test]
#[ignore = "a measurement"]
fn where_dense_and_sparse_cost_the_same() {
    for sides in [[2, 2, 1], [3, 2, 1], [3, 3, 1], [20, 1, 1], [2, 2, 3], [4, 4, 1], [3, 3, 3], [5, 5, 1]] {
        let example = beams(sides);
        let (mut sparse, mut dense) = (example.sparse(), Dense::default());
        sparse.factorise().unwrap();
        let mut times = [0.0; 2];
        let repeats = 300;
        for _ in 0..repeats {
            let mut b = vec![1.0; example.n];
            let start = Instant::now();
            sparse.reset();
            for &(i, j, v) in &example.entries {
                sparse.add(i, j, v);
            }
            sparse.factorise().unwrap();
            sparse.solve(&mut b);
            times[0] += start.elapsed().as_secs_f64() * 1e6 / f64::from(repeats);
            let start = Instant::now();
            dense.reset(example.n);
            for &(i, j, v) in &example.entries {
                dense.add(i, j, v);
            }
            dense.factorise().unwrap();
            dense.solve(&mut b);
            times[1] += start.elapsed().as_secs_f64() * 1e6 / f64::from(repeats);
        }
        println!("beams {sides:?}, n = {}: sparse {:.0} us, dense {:.0} us", example.n, times[0], times[1]);
    }
}
