use super::*;
use crate::Dense;

pub(in crate::sparse) mod examples;
mod growth;

use examples::{Example, Numbers, beams, lattice, network};

/// Solves an example both ways and compares solutions, beside the condition, and signs.
fn compare(example: &Example) -> Sparse {
    let n = example.n;
    let mut sparse = example.sparse();
    let mut dense = Dense::default();
    dense.reset(n);
    for &(i, j, v) in &example.entries {
        dense.add(i, j, v);
    }
    let norm = (0..n).map(|i| dense.row(i).iter().map(|v| v.abs()).sum::<f64>()).fold(0.0, f64::max);
    dense.factorise().unwrap();
    sparse.factorise().unwrap();
    assert_eq!(sparse.is_positive(), dense.is_positive());
    let mut inverse = vec![0.0; n];
    for j in 0..n {
        let mut unit = vec![0.0; n];
        unit[j] = 1.0;
        dense.solve(&mut unit);
        for (sum, v) in inverse.iter_mut().zip(&unit) {
            *sum += v.abs();
        }
    }
    let condition = norm * inverse.iter().fold(0.0, |m, v| v.max(m));
    let mut numbers = Numbers(5);
    let x: Vec<f64> = (0..n).map(|_| numbers.next()).collect();
    let mut b = example.times(&x);
    sparse.solve(&mut b);
    let mut c = example.transposed().times(&x);
    sparse.solve_transposed(&mut c);
    for ((b, c), x) in b.iter().zip(&c).zip(&x) {
        assert!((b - x).abs() < 1e-14 * condition, "{b} for {x}, condition {condition:.1e}");
        assert!((c - x).abs() < 1e-14 * condition, "{c} for {x}, condition {condition:.1e}");
    }
    sparse
}

/// A matrix of `n` unknowns in one block each on a line.
fn line(n: usize, entries: &[(usize, usize, f64)]) -> Example {
    let blocks = (0..n).map(|i| BlockPlace { first: i, count: 1, place: [i as f64, 0.0, 0.0] }).collect();
    Example { n, blocks, entries: entries.to_vec() }
}

#[test]
fn networks_with_empty_diagonal_blocks_are_solved_like_dense_matrices() {
    let (mut delayed, mut positive) = (0, 0);
    for seed in 0..40 {
        let sparse = compare(&network(seed, 3 + seed as usize / 2));
        delayed += sparse.delayed();
        positive += usize::from(sparse.is_positive());
    }
    assert!(delayed > 100);
    assert!((5..35).contains(&positive));
}

#[test]
fn lattices_of_beams_are_solved_like_dense_matrices() {
    for sides in [[2, 1, 1], [9, 1, 1], [5, 4, 1], [3, 3, 2]] {
        compare(&beams(sides));
        compare(&lattice(sides));
    }
}

#[test]
fn parts_without_connection_are_solved_side_by_side() {
    let mut all = Example::default();
    for seed in 0..6 {
        let part = network(seed, 5 + seed as usize);
        all.entries.extend(part.entries.iter().map(|&(i, j, v)| (i + all.n, j + all.n, v)));
        all.blocks.extend(part.blocks.iter().map(|b| BlockPlace { first: b.first + all.n, ..*b }));
        all.n += part.n;
    }
    compare(&all);
}

#[test]
fn blocks_need_not_cover_the_unknowns_nor_have_places() {
    let mut example = network(3, 12);
    for block in &mut example.blocks {
        block.place = [f64::NAN, 0.0, 1.0];
    }
    compare(&example);
    example.blocks.truncate(4);
    compare(&example);
    example.blocks.clear();
    compare(&example);
}

#[test]
fn one_block_is_a_dense_matrix() {
    let mut numbers = Numbers(9);
    for n in [1, 2, 17, 70, 101] {
        let mut example = Example { n, ..Example::default() };
        example.blocks.push(BlockPlace { first: 0, count: n, place: [0.0; 3] });
        example.entries.extend((0..n * n).map(|k| (k / n, k % n, numbers.next())));
        compare(&example);
    }
}

#[test]
fn an_exchange_of_rows_and_a_change_of_sign_turn_the_determinant() {
    let mut example = beams([4, 4, 1]);
    let sign = compare(&example).is_positive();
    for entry in &mut example.entries {
        entry.0 = [1, 0].get(entry.0).copied().unwrap_or(entry.0);
    }
    assert_eq!(compare(&example).is_positive(), !sign);
    for entry in &mut example.entries {
        if entry.1 == 20 {
            entry.2 = -entry.2;
        }
    }
    assert_eq!(compare(&example).is_positive(), sign);
}

#[test]
fn rows_may_differ_by_hundreds_of_orders_of_magnitude() {
    let mut example = beams([4, 3, 1]);
    let n = example.n;
    let x: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
    for entry in &mut example.entries {
        entry.2 *= [1e-280, 1.0, 1e250, 1e-20][entry.0 % 4];
    }
    let mut b = example.times(&x);
    let mut sparse = example.sparse();
    sparse.factorise().unwrap();
    sparse.solve(&mut b);
    for (b, x) in b.iter().zip(&x) {
        assert!((b - x).abs() < 1e-10);
    }
}

#[test]
fn what_has_no_inverse_is_refused() {
    let singular = |example: &Example| assert_eq!(example.sparse().factorise(), Err(Breakdown::Singular));
    // Empty, an empty row, an empty column, two columns in one row, equal rows.
    singular(&line(3, &[]));
    singular(&line(3, &[(0, 0, 1.0), (1, 1, 1.0), (1, 2, 1.0)]));
    singular(&line(2, &[(0, 0, 1.0), (1, 0, 1.0)]));
    singular(&line(3, &[(0, 0, 1.0), (1, 1, 1.0), (2, 0, 1.0)]));
    singular(&line(3, &[(0, 0, 1.0), (0, 1, 2.0), (1, 0, 1.0), (1, 1, 2.0), (2, 2, 1.0)]));
    // A part that hangs on nothing.
    let mut part = beams([5, 5, 1]);
    part.entries.retain(|e| e.0 >= 6 || e.1 >= 6);
    singular(&part);
    // A lattice that floats: its pivots vanish only up to round-off.
    for side in [3, 12, 25] {
        let mut floating = beams([side, side, 1]);
        floating.entries.truncate(floating.entries.len() - 6);
        singular(&floating);
    }
    // After a failure there are no factors.
    let mut sparse = line(2, &[(0, 0, 1.0), (1, 0, 1.0)]).sparse();
    assert!(sparse.factorise().is_err());
    let mut b = [1.0, 1.0];
    sparse.solve(&mut b);
    assert!(b.iter().all(|v| v.is_nan()));
}

#[test]
fn what_is_no_number_is_refused() {
    for wrong in [f64::NAN, f64::INFINITY] {
        let mut example = beams([4, 4, 1]);
        example.entries[100].2 = wrong;
        assert_eq!(example.sparse().factorise(), Err(Breakdown::NotFinite));
    }
}

#[test]
fn nothing_has_a_positive_determinant() {
    let mut sparse = Sparse::default();
    for _ in 0..2 {
        assert_eq!(sparse.factorise(), Ok(()));
        assert!(sparse.is_positive());
        sparse.solve(&mut []);
        sparse.arrange(0, &[]);
    }
}

#[test]
fn assembly_follows_calls_that_change() {
    let example = beams([6, 5, 1]);
    let mut sparse = example.sparse();
    sparse.factorise().unwrap();
    let mut numbers = Numbers(2);
    let extra: Vec<_> = (0..30).map(|k| (7 * k, 400 - 11 * k, numbers.next())).collect();
    let half = example.entries.len() / 2;
    // The same, in another order, with less, with more than ever, with less again, each one twice.
    let mut sequences = vec![example.entries.clone(); 5];
    sequences[1].reverse();
    sequences[2].remove(half);
    sequences[3].splice(half..half, extra);
    for sequence in &sequences {
        for _ in 0..2 {
            sparse.reset();
            for &(i, j, v) in sequence {
                sparse.add(i, j, v);
            }
            let present = Example { entries: sequence.clone(), ..example.clone() };
            let x: Vec<f64> = (0..example.n).map(|i| (i as f64).sin()).collect();
            let mut b = present.times(&x);
            let mut product = vec![0.0; example.n];
            sparse.for_each(|i, j, v| product[i] += v * x[j]);
            assert!(b.iter().zip(&product).all(|(a, b)| (a - b).abs() < 1e-12));
            sparse.factorise().unwrap();
            let mut fresh = present.sparse();
            fresh.factorise().unwrap();
            assert_eq!(sparse.is_positive(), fresh.is_positive());
            sparse.solve(&mut b);
            assert!(b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-9));
        }
    }
}

#[test]
fn a_matrix_gives_equal_bits_whenever_it_is_factorised() {
    let example = network(11, 60);
    let solve = |sparse: &mut Sparse| {
        let mut b: Vec<f64> = (0..example.n).map(|i| (i as f64).sin()).collect();
        sparse.solve(&mut b);
        b.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
    };
    let mut sparse = example.sparse();
    sparse.factorise().unwrap();
    let first = solve(&mut sparse);
    assert_eq!(first, solve(&mut sparse));
    // Again with the storage of before, and put together in another order.
    sparse.factorise().unwrap();
    assert_eq!(first, solve(&mut sparse));
    sparse.reset();
    for &(i, j, v) in example.entries.iter().rev() {
        sparse.add(i, j, v);
    }
    sparse.factorise().unwrap();
    assert_eq!(first, solve(&mut sparse));
    let mut turned =
        Example { entries: example.entries.iter().rev().copied().collect(), ..example.clone() }.sparse();
    turned.factorise().unwrap();
    assert_eq!(first, solve(&mut turned));
    // A copy over another matrix.
    let mut kept = beams([3, 3, 1]).sparse();
    kept.factorise().unwrap();
    kept.clone_from(&sparse);
    assert_eq!(first, solve(&mut kept));
}

#[test]
fn factors_outlive_the_entries() {
    let example = beams([8, 8, 1]);
    let x: Vec<f64> = (0..example.n).map(|i| (i as f64).sin()).collect();
    let mut b = example.times(&x);
    let mut sparse = example.sparse();
    sparse.factorise().unwrap();
    sparse.reset();
    sparse.add(0, 0, 1.0);
    sparse.solve(&mut b);
    assert!(b.iter().zip(&x).all(|(b, x)| (b - x).abs() < 1e-8));
}

#[test]
fn weak_pivots_are_mended_by_one_refinement() {
    let example = beams([70, 70, 1]);
    let mut sparse = example.sparse();
    sparse.factorise().unwrap();
    let x: Vec<f64> = (0..example.n).map(|i| (i as f64).sin()).collect();
    let b = example.times(&x);
    let mut solution = b.clone();
    sparse.solve(&mut solution);
    let mut r = vec![0.0; example.n];
    assert!(residual(&sparse.pattern, &solution, &b, &mut r) < 1e-14);
    let mut turned = example.transposed().times(&x);
    let right = turned.clone();
    sparse.solve_transposed(&mut turned);
    assert!(residual_transposed(&sparse.pattern, &turned, &right, &mut r, &mut Vec::new()) < 1e-14);
    let mut other = example.transposed().sparse();
    other.pattern.settle();
    assert!(residual(&other.pattern, &turned, &right, &mut r) < 1e-14);
    // Without it.
    sparse.current = false;
    let mut rough = b.clone();
    sparse.solve(&mut rough);
    let backward = residual(&sparse.pattern, &rough, &b, &mut r);
    assert!(backward > REFINED && backward < 1e-9, "{backward:.1e}");
}
