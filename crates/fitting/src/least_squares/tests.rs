//! Problems with known minima.

use super::*;

/// Residuals by a function, the Jacobian by complex step's real cousin: central differences of order four, near round-off here.
struct By<F: Fn(&DVector<f64>) -> Option<DVector<f64>>>(F);

impl<F: Fn(&DVector<f64>) -> Option<DVector<f64>>> Residuals for By<F> {
    fn at(&mut self, x: &DVector<f64>, jacobian: bool) -> Option<(DVector<f64>, Option<DMatrix<f64>>)> {
        let residuals = (self.0)(x)?;
        if !jacobian {
            return Some((residuals, None));
        }
        let mut matrix = DMatrix::zeros(residuals.len(), x.len());
        for k in 0..x.len() {
            let h = 1e-3 * x[k].abs().max(0.1);
            let by = |n: f64| {
                let mut beside = x.clone();
                beside[k] += n * h;
                (self.0)(&beside)
            };
            let column = ((by(1.0)? - by(-1.0)?) * 8.0 - (by(2.0)? - by(-2.0)?)) / (12.0 * h);
            matrix.set_column(k, &column);
        }
        Some((residuals, Some(matrix)))
    }
}

fn options(n: usize) -> LeastSquaresOptions {
    LeastSquaresOptions {
        bounds: vec![[f64::NEG_INFINITY, f64::INFINITY]; n],
        loss: Loss::Squares,
        step: 1e-12,
        uncertainty: 0.0,
        iterations: 200,
    }
}

fn vector(values: &[f64]) -> DVector<f64> {
    DVector::from_row_slice(values)
}

#[test]
fn a_bent_valley_is_followed_to_its_end() {
    // H. H. Rosenbrock (1960), from the usual start.
    let mut valley = By(|x: &DVector<f64>| Some(vector(&[10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]])));
    let found = least_squares(&mut valley, &vector(&[-1.2, 1.0]), &options(2));
    assert_eq!(found.end, LeastSquaresEnd::Converged);
    assert!((found.x - vector(&[1.0, 1.0])).norm() < 1e-10);
    assert!(found.evaluations[1] < found.evaluations[0]);
}

#[test]
fn a_singular_minimum_is_approached() {
    // M. J. D. Powell (1962): J is singular at the minimum, zero.
    let mut powell = By(|x: &DVector<f64>| {
        Some(vector(&[
            x[0] + 10.0 * x[1],
            5.0_f64.sqrt() * (x[2] - x[3]),
            (x[1] - 2.0 * x[2]).powi(2),
            10.0_f64.sqrt() * (x[0] - x[3]).powi(2),
        ]))
    });
    let found = least_squares(&mut powell, &vector(&[3.0, -1.0, 0.0, 1.0]), &options(4));
    assert!(found.x.norm() < 1e-4 && found.cost < 1e-16, "{found:?}");
}

#[test]
fn nonlinear_regression_has_its_certified_digits() {
    // NIST StRD Misra1a (1978), certified: b1 = 238.94212918, b2 = 5.5015643181e-4, sum of squares 0.12455138894.
    let x = [77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0];
    let y =
        [10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78];
    let (size1, size2) = (500.0, 1e-4);
    let mut misra = By(|b: &DVector<f64>| {
        let law = |x: f64| size1 * b[0] * (1.0 - (-size2 * b[1] * x).exp());
        Some(DVector::from_iterator(x.len(), x.iter().zip(y).map(|(x, y)| law(*x) - y)))
    });
    let found = least_squares(&mut misra, &vector(&[1.0, 1.0]), &options(2));
    assert!((found.x[0] * size1 - 238.942_129_18).abs() < 1e-6, "{found:?}");
    assert!((found.x[1] * size2 - 5.501_564_318_1e-4).abs() < 1e-12);
    assert!((2.0 * found.cost - 0.124_551_388_94).abs() < 1e-10);
}

#[test]
fn bounds_hold_and_the_others_go_on() {
    let mut bowl = By(|x: &DVector<f64>| Some(vector(&[x[0] + x[1] - 3.0, x[0] - x[1] - 1.0])));
    let mut bounded = options(2);
    bounded.bounds = vec![[0.0, 1.0], [0.0, 10.0]];
    let found = least_squares(&mut bowl, &vector(&[5.0, 5.0]), &bounded);
    assert_eq!(found.end, LeastSquaresEnd::Converged);
    // With x0 = 1 the best x1 is that of the mean of 2 and 0.
    assert!((found.x - vector(&[1.0, 1.0])).norm() < 1e-10);
    // From outside, and with the minimum inside.
    bounded.bounds = vec![[0.0, 4.0], [0.0, 4.0]];
    let found = least_squares(&mut bowl, &vector(&[-5.0, 9.0]), &bounded);
    assert!((found.x - vector(&[2.0, 1.0])).norm() < 1e-10);
}

#[test]
fn an_outlier_hardly_moves_a_robust_fit() {
    let y = [1.0, 2.0, 3.0, 4.0, 5.0, 60.0, 7.0, 8.0];
    let mut line = By(|b: &DVector<f64>| {
        Some(DVector::from_iterator(y.len(), (1..).zip(y).map(|(x, y)| b[0] + b[1] * f64::from(x) - y)))
    });
    let squares = least_squares(&mut line, &vector(&[0.5, 0.5]), &options(2));
    assert!((squares.x[1] - 1.0).abs() > 0.5);
    for (loss, near) in [(Loss::Huber(0.01), 1e-2), (Loss::SoftL1(0.01), 2e-2), (Loss::Cauchy(0.01), 1e-4)] {
        let found =
            least_squares(&mut line, &vector(&[0.5, 0.5]), &LeastSquaresOptions { loss, ..options(2) });
        assert!((found.x - vector(&[0.0, 1.0])).norm() < near, "{loss:?} {}", near);
    }
}

#[test]
fn where_nothing_has_a_value_steps_are_shortened() {
    // ln x = 2 from 0.1: the first step is long, and x must stay positive.
    let mut logarithm = By(|x: &DVector<f64>| (x[0] > 0.0).then(|| vector(&[x[0].ln() + 2.0])));
    let found = least_squares(&mut logarithm, &vector(&[1.0]), &options(1));
    assert!((found.x[0] - (-2.0_f64).exp()).abs() < 1e-9, "{found:?}");
    let found = least_squares(&mut logarithm, &vector(&[-1.0]), &options(1));
    assert_eq!(found.end, LeastSquaresEnd::NoStart);
}
