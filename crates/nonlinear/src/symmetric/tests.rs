use super::*;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use proptest::prelude::*;

/// A linear congruential generator: the same numbers on every machine.
struct Numbers(u64);

impl Numbers {
    /// Between -1 and 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| self.next())
    }

    fn orthogonal(&mut self, n: usize) -> DMatrix<f64> {
        self.matrix(n, n).qr().q()
    }
}

fn assembled(a: &DMatrix<f64>) -> Symmetric {
    let mut symmetric = Symmetric::default();
    symmetric.arrange(a.nrows(), &[]);
    assemble(&mut symmetric, a);
    symmetric
}

fn assemble(symmetric: &mut Symmetric, a: &DMatrix<f64>) {
    symmetric.reset();
    for i in 0..a.nrows() {
        for j in 0..a.ncols() {
            symmetric.add(i, j, a[(i, j)]);
        }
    }
}

fn inertia(a: &DMatrix<f64>) -> Inertia {
    assembled(a).factorise().unwrap()
}

fn signs<'a>(values: impl IntoIterator<Item = &'a f64>) -> Inertia {
    let mut inertia = Inertia::default();
    for &value in values {
        if value == 0.0 {
            inertia.zero += 1;
        } else {
            inertia.count(value);
        }
    }
    inertia
}

/// Solves for a known vector with numbers of the sizes given; the largest residual beside what it is a difference of.
fn backward_error(a: &DMatrix<f64>, sizes: &DVector<f64>) -> f64 {
    let mut symmetric = assembled(a);
    symmetric.factorise().unwrap();
    let mut numbers = Numbers(17);
    let b = a * sizes.map(|size| size * numbers.next());
    let mut x = b.clone();
    symmetric.solve(x.as_mut_slice());
    let size = a.abs() * x.abs() + b.abs();
    (a * x - b).abs().component_div(&size).max()
}

fn ones(n: usize) -> DVector<f64> {
    DVector::from_element(n, 1.0)
}

/// Poses in a chain with springs between neighbours and some of their own, stiff in one direction by `stiff`, and
/// constraints on every other one with nothing, or a little compliance, on their diagonal.
fn mechanism(seed: u64, poses: usize, stiff: f64) -> DMatrix<f64> {
    let mut numbers = Numbers(seed);
    let constraints = 3;
    let n = 6 * poses + constraints * (poses / 2);
    let mut a = DMatrix::zeros(n, n);
    for k in 0..poses {
        let count = if k + 1 < poses { 12 } else { 6 };
        let turn = numbers.orthogonal(count);
        let values = DVector::from_fn(count, |i, _| if i == 0 { stiff } else { numbers.next() });
        let block = &turn * DMatrix::from_diagonal(&values) * turn.transpose();
        let mut part = a.view_mut((6 * k, 6 * k), (count, count));
        part += 0.5 * (&block + block.transpose());
    }
    for k in 0..poses / 2 {
        let (row, g) = (6 * poses + constraints * k, numbers.matrix(constraints, 12.min(6 * poses - 12 * k)));
        a.view_mut((row, 12 * k), g.shape()).copy_from(&g);
        a.view_mut((12 * k, row), (g.ncols(), constraints)).copy_from(&g.transpose());
        if k % 3 == 2 {
            a[(row, row)] = -0.01;
        }
    }
    a
}

#[test]
fn mechanisms_have_the_inertia_of_their_eigenvalues() {
    for seed in 0..60 {
        let a = mechanism(seed, 1 + seed as usize / 4, 10_f64.powi(seed as i32 % 7));
        let eigenvalues = SymmetricEigen::new(a.clone()).eigenvalues;
        assert!(eigenvalues.amin() > 1e-12 * eigenvalues.amax());
        assert_eq!(inertia(&a), signs(&eigenvalues));
        assert!(backward_error(&a, &ones(a.nrows())) < 1e-13);
    }
}

#[test]
fn scales_that_differ_by_many_orders_of_magnitude_do_not_change_the_inertia() {
    for seed in 0..30 {
        let a = mechanism(seed, 2 + seed as usize / 3, 100.0);
        let expected = signs(&SymmetricEigen::new(a.clone()).eigenvalues);
        let mut numbers = Numbers(seed);
        for orders in [3.0, 7.0] {
            let scale = DVector::from_fn(a.nrows(), |_, _| 10_f64.powf(orders * numbers.next()));
            let scaled = DMatrix::from_fn(a.nrows(), a.nrows(), |i, j| (a[(i, j)] * scale[i]) * scale[j]);
            assert_eq!(inertia(&scaled), expected);
            assert!(backward_error(&scaled, &scale.map(|s| 1.0 / s)) < 1e-13);
        }
    }
}

/// Round-off on the diagonals of constraints is not taken for a compliance.
#[test]
fn soft_parts_beside_the_constraints_that_hold_them_keep_their_signs() {
    for seed in 0..20 {
        let poses = 2 + seed as usize / 3;
        let mut a = mechanism(seed, poses, 1.0);
        let constraints = 6 * poses..a.nrows();
        constraints.clone().for_each(|i| a[(i, i)] = 0.0);
        let expected = signs(&SymmetricEigen::new(a.clone()).eigenvalues);
        for orders in [4, 8, 12] {
            let mut soft = a.clone();
            let mut part = soft.view_mut((0, 0), (6 * poses, 6 * poses));
            part *= 10_f64.powi(-orders);
            constraints.clone().for_each(|i| soft[(i, i)] = 1e-17 * (i as f64).sin());
            assert_eq!(inertia(&soft), expected);
        }
    }
}

#[test]
fn a_soft_direction_beside_a_stiff_one_that_no_scaling_removes_keeps_its_sign() {
    for soft in [1e-11, -1e-11] {
        for seed in 0..20 {
            let n = 12;
            let turn = Numbers(seed).orthogonal(n);
            let values = DVector::from_fn(n, |i, _| if i == 0 { soft } else { 1.0 / (1.0 + i as f64) });
            let a = &turn * DMatrix::from_diagonal(&values) * turn.transpose();
            assert_eq!(inertia(&a), signs(&values));
        }
    }
}

#[test]
fn what_has_nothing_on_its_diagonal_is_factorised() {
    let mut numbers = Numbers(8);
    for n in [2, 3, 10, 41, 90] {
        let full = numbers.matrix(n, n);
        let a = DMatrix::from_fn(n, n, |i, j| if i == j { 0.0 } else { full[(i, j)] + full[(j, i)] });
        assert_eq!(inertia(&a), signs(&SymmetricEigen::new(a.clone()).eigenvalues));
        assert!(backward_error(&a, &ones(a.nrows())) < 1e-13);
        // Only multipliers and what they hold.
        let mut hold = DMatrix::zeros(2 * n, 2 * n);
        hold.view_mut((n, 0), (n, n)).copy_from(&full);
        hold.view_mut((0, n), (n, n)).copy_from(&full.transpose());
        assert_eq!(inertia(&hold), Inertia { positive: n, negative: n, zero: 0 });
        assert!(backward_error(&hold, &ones(2 * n)) < 1e-13);
    }
}

#[test]
fn the_sides_of_the_diagonal_are_averaged() {
    let mut numbers = Numbers(4);
    let a = numbers.matrix(20, 20);
    let mean = 0.5 * (&a + a.transpose());
    let (mut one, mut other) = (assembled(&a), assembled(&mean));
    let mut seen = DMatrix::zeros(20, 20);
    one.for_each(|i, j, v| seen[(i, j)] += v);
    assert!((&seen - &mean).amax() < 1e-15);
    assert_eq!(one.factorise(), other.factorise());
    // The entries outlive factorisation.
    let mut after = DMatrix::zeros(20, 20);
    one.for_each(|i, j, v| after[(i, j)] += v);
    assert_eq!(seen, after);
}

#[test]
fn zero_eigenvalues_are_counted() {
    let zeros = |n| Inertia { zero: n, ..Inertia::default() };
    assert_eq!(inertia(&DMatrix::zeros(0, 0)), zeros(0));
    assert_eq!(inertia(&DMatrix::zeros(5, 5)), zeros(5));
    let mut numbers = Numbers(3);
    for seed in 0..40 {
        // A mechanism with constraints that say the same twice, as each pose being held by one point more often
        // than needed, and one pose that nothing holds.
        let a = mechanism(seed, 2 + seed as usize / 5, 1e3);
        let (n, poses) = (a.nrows(), 2 + seed as usize / 5);
        let expected = inertia(&a);
        assert_eq!(expected.zero, 0);
        let mut wider = DMatrix::zeros(n + 5, n + 5);
        wider.view_mut((0, 0), (n, n)).copy_from(&a);
        for k in 0..2 {
            let row = 6 * poses + 2 * k % (n - 6 * poses);
            let combined = a.row(row) * numbers.next() + a.row(6 * poses + 1) * numbers.next();
            for j in 0..6 * poses {
                wider[(n + k, j)] = combined[j];
                wider[(j, n + k)] = combined[j];
            }
        }
        let found = inertia(&wider);
        assert_eq!(found, Inertia { zero: 5, ..expected }, "{seed}");
    }
}

#[test]
fn a_null_vector_is_found_by_inverse_iteration() {
    let mut numbers = Numbers(12);
    for n in [1, 2, 13, 60] {
        let turn = numbers.orthogonal(n);
        let values = DVector::from_fn(n, |i, _| if i == 0 { 0.0 } else { 0.5 + i as f64 - n as f64 / 3.0 });
        let a = &turn * DMatrix::from_diagonal(&values) * turn.transpose();
        let mut symmetric = assembled(&a);
        assert_eq!(symmetric.factorise(), Ok(signs(&values)));
        let mut x = DVector::from_fn(n, |_, _| numbers.next());
        for _ in 0..2 {
            symmetric.solve(x.as_mut_slice());
            x.normalize_mut();
        }
        assert!((a * &x).amax() < 1e-12 * n as f64);
        assert!((x.dot(&turn.column(0)).abs() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_matrix_is_used_again() {
    let mut symmetric = Symmetric::default();
    let mut kept = Symmetric::default();
    for seed in 0..12 {
        let a = mechanism(seed, [5, 2, 20, 3][seed as usize / 3], 10.0);
        if seed % 3 == 0 {
            symmetric.arrange(a.nrows(), &[]);
        }
        assemble(&mut symmetric, &a);
        let expected = inertia(&a);
        assert_eq!(symmetric.factorise(), Ok(expected));
        assert_eq!(symmetric.size(), a.nrows());
        assert_eq!(matches!(symmetric, Symmetric::Sparse(_)), a.nrows() > LARGEST_DENSE);
        kept.clone_from(&symmetric);
        // Factors outlive the entries.
        symmetric.reset();
        let x = DVector::from_fn(a.nrows(), |i, _| (i as f64).cos());
        let right = &a * &x;
        let solve = |symmetric: &mut Symmetric| {
            let mut b = right.clone();
            symmetric.solve(b.as_mut_slice());
            b
        };
        let found = solve(&mut symmetric);
        assert!((&a * &found - &right).amax() < 1e-10);
        assert_eq!(found, solve(&mut kept));
    }
}

#[test]
fn what_is_no_number_is_refused_and_leaves_no_factors() {
    for wrong in [f64::NAN, f64::INFINITY] {
        let mut a = mechanism(1, 4, 1.0);
        let mut symmetric = assembled(&a);
        symmetric.factorise().unwrap();
        a[(9, 4)] = wrong;
        assemble(&mut symmetric, &a);
        assert_eq!(symmetric.factorise(), Err(Breakdown::NotFinite));
        let mut b = vec![1.0; a.nrows()];
        symmetric.solve(&mut b);
        assert!(b.iter().all(|v| v.is_nan()));
    }
}

proptest! {
    /// Sylvester's law, with numbers small enough that the congruences are exact.
    #[test]
    fn a_congruence_keeps_the_inertia(
        (values, turn) in (1_usize..14).prop_flat_map(|n| (
            prop::collection::vec(-3_i32..=3, n),
            prop::collection::vec(-2_i32..=2, n * n),
        )),
        exponents in prop::collection::vec(-17_i32..=17, 14),
    ) {
        let n = values.len();
        let turn = DMatrix::from_fn(n, n, |i, j| {
            let unit = f64::from(u8::from(i == j));
            if i <= j { unit + f64::from(turn[i * n + j]) * (1.0 - unit) } else { 0.0 }
        });
        let values = DVector::from_fn(n, |i, _| f64::from(values[i]));
        let a = turn.transpose() * DMatrix::from_diagonal(&values) * &turn;
        let scaled = DMatrix::from_fn(n, n, |i, j| a[(i, j)] * 2_f64.powi(exponents[i] + exponents[j]));
        prop_assert_eq!(inertia(&a), signs(&values));
        prop_assert_eq!(inertia(&scaled), signs(&values));
    }
}
