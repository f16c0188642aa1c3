use super::*;
use crate::DenseSymmetric;
use crate::sparse::tests::examples::{Example, Numbers, beams, lattice, network};
use nalgebra::{DMatrix, SymmetricEigen};

/// The matrix with what is below the diagonal on both sides.
fn mirrored(example: &Example) -> Example {
    let mut entries = Vec::new();
    for &(i, j, v) in example.entries.iter().filter(|e| e.0 >= e.1) {
        entries.push((i, j, v));
        if i != j {
            entries.push((j, i, v));
        }
    }
    Example { entries, ..example.clone() }
}

fn assembled(example: &Example) -> SparseSymmetric {
    let mut sparse = SparseSymmetric::default();
    sparse.arrange(example.n, &example.blocks);
    assemble(&mut sparse, example);
    sparse
}

fn assemble(sparse: &mut SparseSymmetric, example: &Example) {
    sparse.reset();
    for &(i, j, v) in &example.entries {
        sparse.add(i, j, v);
    }
}

fn dense(example: &Example) -> DenseSymmetric {
    let mut dense = DenseSymmetric::default();
    dense.arrange(example.n);
    for &(i, j, v) in &example.entries {
        dense.add(i, j, v);
    }
    dense
}

fn wave(n: usize) -> Vec<f64> {
    (0..n).map(|i| (i as f64).sin()).collect()
}

/// Factorises an example both ways, compares inertias, with those of the eigenvalues too where these cost little, and
/// looks at the residual of a solution.
fn compare(example: &Example) -> SparseSymmetric {
    let n = example.n;
    let mut sparse = assembled(example);
    let inertia = sparse.factorise().unwrap();
    assert_eq!(dense(example).factorise(), Ok(inertia));
    assert_eq!(inertia.zero, 0);
    if n < 150 {
        let mut full = DMatrix::<f64>::zeros(n, n);
        example.entries.iter().for_each(|&(i, j, v)| full[(i, j)] += v);
        let eigenvalues = SymmetricEigen::new(full).eigenvalues;
        assert_eq!(inertia.positive, eigenvalues.iter().filter(|v| **v > 0.0).count());
    }
    let b = example.times(&wave(n));
    let mut x = b.clone();
    sparse.solve(&mut x);
    let error = residual(&sparse.pattern, &x, &b, &mut Vec::new(), &mut Vec::new());
    assert!(error < REFINED, "{error:.1e}");
    sparse
}

/// A matrix of `n` unknowns in one block each on a line.
fn line(n: usize, entries: &[(usize, usize, f64)]) -> Example {
    let blocks = (0..n).map(|i| BlockPlace { first: i, count: 1, place: [i as f64, 0.0, 0.0] }).collect();
    Example { n, blocks, entries: entries.to_vec() }
}

/// Beams that no node holds: six motions meet no resistance.
fn floating(sides: [usize; 3]) -> Example {
    let mut example = beams(sides);
    example.entries.truncate(example.entries.len() - 6);
    mirrored(&example)
}

#[test]
fn networks_with_empty_diagonal_blocks_have_the_inertia_of_dense_matrices() {
    let mut delayed = 0;
    for seed in 0..40 {
        delayed += compare(&mirrored(&network(seed, 3 + seed as usize / 3))).delayed();
    }
    assert!(delayed > 100);
}

#[test]
fn lattices_have_the_inertia_of_dense_matrices() {
    let mut delayed = 0;
    for sides in [[2, 1, 1], [9, 1, 1], [5, 4, 1], [3, 3, 2]] {
        delayed += compare(&mirrored(&beams(sides))).delayed();
        compare(&mirrored(&lattice(sides)));
    }
    assert!(delayed > 20);
}

#[test]
fn parts_without_connection_are_factorised_side_by_side() {
    let mut all = Example::default();
    for seed in 0..5 {
        let part = network(seed, 5 + seed as usize);
        all.entries.extend(part.entries.iter().map(|&(i, j, v)| (i + all.n, j + all.n, v)));
        all.blocks.extend(part.blocks.iter().map(|b| BlockPlace { first: b.first + all.n, ..*b }));
        all.n += part.n;
    }
    compare(&mirrored(&all));
    // Blocks need not cover the unknowns.
    all.blocks.truncate(4);
    compare(&mirrored(&all));
}

#[test]
fn one_block_is_a_dense_matrix() {
    let mut numbers = Numbers(9);
    for n in [1, 2, 17, 70, 101] {
        let blocks = vec![BlockPlace { first: 0, count: n, place: [0.0; 3] }];
        let entries = (0..n * n).map(|k| (k / n, k % n, numbers.next())).collect();
        compare(&mirrored(&Example { n, blocks, entries }));
    }
}

/// A grid with four neighbours has the eigenvalues 4 - 2 cos(iπ/(p+1)) - 2 cos(jπ/(q+1)).
#[test]
fn as_many_eigenvalues_are_below_a_shift_as_there_are_negative_pivots() {
    let [p, q] = [37, 52];
    let angle = |i: usize, n: usize| (std::f64::consts::PI * i as f64 / (n + 1) as f64).cos();
    for shift in [-0.1, 0.003, 1.2, 3.7, 4.4, 7.0, 8.1] {
        let mut sparse = SparseSymmetric::default();
        let blocks: Vec<BlockPlace> = (0..p * q)
            .map(|k| BlockPlace { first: k, count: 1, place: [(k / q) as f64, (k % q) as f64, 0.0] })
            .collect();
        sparse.arrange(p * q, &blocks);
        for k in 0..p * q {
            sparse.add(k, k, 4.0 - shift);
            let others = [(k % q + 1 < q).then_some(k + 1), (k / q + 1 < p).then_some(k + q)];
            for other in others.into_iter().flatten() {
                sparse.add(k, other, -1.0);
                sparse.add(other, k, -1.0);
            }
        }
        let eigenvalues =
            (0..p * q).map(|k| 4.0 - 2.0 * angle(1 + k / q, p) - 2.0 * angle(1 + k % q, q) - shift);
        let negative = eigenvalues.filter(|v| *v < 0.0).count();
        assert_eq!(sparse.factorise(), Ok(Inertia { positive: p * q - negative, negative, zero: 0 }));
    }
}

#[test]
fn the_cost_is_half_of_the_unsymmetric_one_and_the_signs_agree() {
    for example in [lattice([30, 30, 1]), beams([25, 25, 1]), beams([5, 5, 5])].map(|e| mirrored(&e)) {
        let (mut sparse, mut lu) = (assembled(&example), example.sparse());
        let inertia = sparse.factorise().unwrap();
        lu.factorise().unwrap();
        assert_eq!(lu.is_positive(), inertia.negative % 2 == 0);
        assert!((sparse.flops() as f64) < 0.55 * lu.flops() as f64);
        assert!((sparse.fill() as f64) < 0.52 * lu.fill() as f64);
    }
}

#[test]
fn scales_that_differ_by_many_orders_of_magnitude_do_not_change_the_inertia() {
    for (seed, example) in [lattice([9, 8, 1]), beams([7, 6, 1]), network(3, 30)].iter().enumerate() {
        let mut example = mirrored(example);
        let inertia = assembled(&example).factorise();
        let mut numbers = Numbers(seed as u64);
        let scale: Vec<f64> = (0..example.n).map(|_| 10_f64.powf(6.0 * numbers.next())).collect();
        example.entries.iter_mut().for_each(|e| e.2 *= scale[e.0] * scale[e.1]);
        assert_eq!(assembled(&example).factorise(), inertia);
    }
}

#[test]
fn zero_eigenvalues_are_counted() {
    let inertia = |example: &Example| assembled(example).factorise().unwrap();
    let of = |positive, negative, zero| Inertia { positive, negative, zero };
    // Nothing, an empty row, equal rows, a constraint that is said twice.
    assert_eq!(inertia(&line(3, &[])), of(0, 0, 3));
    assert_eq!(inertia(&line(3, &[(0, 0, 1.0), (1, 1, -1.0)])), of(1, 1, 1));
    assert_eq!(inertia(&line(2, &[(0, 0, 1.0), (0, 1, 2.0), (1, 0, 2.0), (1, 1, 4.0)])), of(1, 0, 1));
    let twice = [(0, 1, 1.0), (1, 0, 1.0), (0, 2, 3.0), (2, 0, 3.0)];
    assert_eq!(inertia(&line(3, &twice)), of(1, 1, 1));
    for sides in [[3, 3, 1], [12, 12, 1], [20, 20, 1], [3, 3, 3], [5, 5, 5], [200, 1, 1]] {
        let example = floating(sides);
        let zeros = inertia(&example);
        assert_eq!(zeros.zero, 6, "{sides:?}");
        // One node held: the six become positive.
        let mut held = example.clone();
        held.entries.extend((0..6).map(|k| (k, k, 1.0)));
        assert_eq!(inertia(&held), of(zeros.positive + 6, zeros.negative, 0));
    }
}

#[test]
fn a_null_vector_is_found_by_inverse_iteration() {
    let example = floating([6, 6, 1]);
    let mut sparse = assembled(&example);
    assert_eq!(sparse.factorise().unwrap().zero, 6);
    let mut x = wave(example.n);
    for _ in 0..2 {
        sparse.solve(&mut x);
        let size = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        x.iter_mut().for_each(|x| *x /= size);
    }
    assert!(example.times(&x).iter().all(|v| v.abs() < 1e-12));
}

#[test]
fn the_sides_of_the_diagonal_are_averaged() {
    // Unsymmetric, and with a pattern that is not symmetric.
    let example = network(7, 20);
    let mut mean = example.clone();
    mean.entries = Vec::new();
    for &(i, j, v) in &example.entries {
        mean.entries.extend([(i, j, 0.5 * v), (j, i, 0.5 * v)]);
    }
    let mut sparse = compare(&mean);
    let inertia = sparse.factorise();
    assert_eq!(assembled(&example).factorise(), inertia);
    let (x, mut product) = (wave(example.n), vec![0.0; example.n]);
    assembled(&example).for_each(|i, j, v| product[i] += v * x[j]);
    assert!(mean.times(&x).iter().zip(&product).all(|(a, b)| (a - b).abs() < 1e-12));
}

#[test]
fn a_pattern_is_used_again_with_other_values_and_other_calls() {
    let example = mirrored(&beams([6, 5, 1]));
    let mut sparse = assembled(&example);
    let mut numbers = Numbers(2);
    for round in 0..6 {
        let mut present = example.clone();
        present.entries.iter_mut().for_each(|e| e.2 *= 1.0 + 0.5 * ((e.0 + e.1) as f64 + round as f64).sin());
        if round == 3 {
            for k in 0..30 {
                let v = numbers.next();
                present.entries.extend([(7 * k, 400 - 11 * k, v), (400 - 11 * k, 7 * k, v)]);
            }
        }
        assemble(&mut sparse, &present);
        let inertia = sparse.factorise();
        assert_eq!(inertia, dense(&present).factorise());
        assert_eq!(inertia, assembled(&present).factorise());
        let x = wave(example.n);
        let mut b = present.times(&x);
        sparse.solve(&mut b);
        assert!(b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-9));
        // Factors outlive the entries.
        let mut b = present.times(&x);
        sparse.reset();
        sparse.solve(&mut b);
        assert!(b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-8));
    }
}

#[test]
fn a_matrix_gives_equal_bits_whenever_it_is_factorised() {
    let example = mirrored(&network(11, 60));
    let solve = |sparse: &mut SparseSymmetric| {
        let mut b = wave(example.n);
        sparse.solve(&mut b);
        b.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
    };
    let mut sparse = assembled(&example);
    sparse.factorise().unwrap();
    let first = solve(&mut sparse);
    sparse.factorise().unwrap();
    assert_eq!(first, solve(&mut sparse));
    let mut turned = example.clone();
    turned.entries.reverse();
    assemble(&mut sparse, &turned);
    sparse.factorise().unwrap();
    assert_eq!(first, solve(&mut sparse));
    let mut kept = assembled(&mirrored(&beams([3, 3, 1])));
    kept.factorise().unwrap();
    kept.clone_from(&sparse);
    assert_eq!(first, solve(&mut kept));
}

#[test]
fn weak_pivots_are_mended_by_one_refinement() {
    let example = mirrored(&beams([41, 41, 1]));
    let mut sparse = assembled(&example);
    sparse.factorise().unwrap();
    let b = example.times(&wave(example.n));
    let error = |x: &[f64]| residual(&sparse.pattern, x, &b, &mut Vec::new(), &mut Vec::new());
    let mut rough = b.clone();
    let mut gathered = Vec::new();
    sparse.factors.solve(&mut rough, &mut gathered);
    let before = error(&rough);
    let mut r = b.clone();
    example.times(&rough).iter().zip(&mut r).for_each(|(product, r)| *r -= product);
    sparse.factors.solve(&mut r, &mut gathered);
    rough.iter_mut().zip(&r).for_each(|(x, r)| *x += r);
    assert!(before > 1e-14 && before < 1e-10 && error(&rough) < 1e-14, "{before:.1e}");
}

#[test]
fn what_is_no_number_is_refused_and_leaves_no_factors() {
    for wrong in [f64::NAN, f64::INFINITY] {
        let mut example = mirrored(&beams([4, 4, 1]));
        let mut sparse = assembled(&example);
        sparse.factorise().unwrap();
        example.entries[100].2 = wrong;
        assemble(&mut sparse, &example);
        assert_eq!(sparse.factorise(), Err(Breakdown::NotFinite));
        let mut b = wave(example.n);
        sparse.solve(&mut b);
        assert!(b.iter().all(|v| v.is_nan()));
    }
}

#[test]
fn nothing_has_no_eigenvalues() {
    let mut sparse = SparseSymmetric::default();
    for _ in 0..2 {
        assert_eq!(sparse.factorise(), Ok(Inertia::default()));
        sparse.solve(&mut []);
        sparse.arrange(0, &[]);
    }
}
