//! The lowest ω² of a pencil K x = ω² M x without an energy: K has no symmetry, and ω² may be complex.
//!
//! A block Krylov space of (K - σ M)⁻¹ M as in `pencil`, of which the projection is no longer symmetric (W. E. Arnoldi, *Quart. Appl.
//! Math.* 9 (1951) 17). No inertia counts what is there; instead everything nearer to the shift than what is asked for must have
//! settled, from a start of several vectors.

use super::pencil::Trouble;
use flexura_equilibrium::Vibration;
use flexura_nonlinear::{Breakdown, Matrix};
use flexura_spatial::eigenvalues;
use nalgebra::{Complex, DMatrix, DVector};

/// Vectors of the start, and between two looks.
const BLOCK: usize = 4;
const LOOK: usize = 6;
/// How well a pair must satisfy its equation.
const RESIDUAL: f64 = 1e-10;
/// Part of its length that may be left of a vector that says something new.
const NEW: f64 = 1e-9;
/// Part of ω² that may be imaginary by round-off.
const REAL: f64 = 1e-7;

/// ω² with its vector: real and imaginary parts.
#[derive(Clone, Debug)]
pub struct Wave {
    pub square: Complex<f64>,
    pub vector: [Vec<f64>; 2],
}

/// The `count` ω² nearest to σ, those of a conjugate pair both counted, and their vectors.
pub fn nearest(vibration: &Vibration, count: usize, sigma: f64) -> Result<Vec<Wave>, Trouble> {
    let n = vibration.size;
    let mut matrix = Matrix::default();
    matrix.arrange(n, &vibration.blocks);
    matrix.reset();
    for &(i, j, value) in &vibration.stiffness {
        matrix.add(i, j, value);
    }
    for &(i, j, value) in &vibration.inertia {
        matrix.add(i, j, -sigma * value);
    }
    matrix.factorise()?;
    let weighed = |x: &DVector<f64>| {
        let mut out = DVector::zeros(n);
        vibration.inertia.iter().for_each(|&(i, j, value)| out[i] += value * x[j]);
        out
    };
    let length = |x: &DVector<f64>| x.dot(&weighed(x)).max(0.0).sqrt();
    let mut space: Vec<DVector<f64>> = Vec::new();
    let mut heavy: Vec<DVector<f64>> = Vec::new();
    let mut images: Vec<DVector<f64>> = Vec::new();
    let (mut next, mut dead, mut since) = (0, 0, 0);
    loop {
        let fresh = space.len() < BLOCK || next >= space.len();
        let mut candidate = if fresh {
            let seed = space.len() + 7 * dead;
            let noise = DVector::from_fn(n, |i, _| ((2.4 * i as f64 + 0.7) * (seed as f64 + 1.3)).sin());
            let mut x = weighed(&noise);
            matrix.solve(x.as_mut_slice());
            x
        } else {
            next += 1;
            images[next - 1].clone()
        };
        let before = length(&candidate);
        for _ in 0..2 {
            for (q, mq) in space.iter().zip(&heavy) {
                let part = mq.dot(&candidate);
                candidate.axpy(-part, q, 1.0);
            }
        }
        let size = length(&candidate);
        if !size.is_finite() {
            return Err(Breakdown::NotFinite.into());
        }
        let spent = size <= NEW * before || before == 0.0;
        if spent && fresh {
            dead += 1;
        }
        if !spent {
            candidate /= size;
            let mass = weighed(&candidate);
            let mut image = mass.clone();
            matrix.solve(image.as_mut_slice());
            space.push(candidate);
            heavy.push(mass);
            images.push(image);
            since += 1;
        }
        let exhausted = dead > 3 || space.len() >= n;
        if exhausted || since >= LOOK && space.len() > count + 2 {
            since = 0;
            let open: Vec<(usize, f64)> = (next..space.len())
                .map(|j| {
                    let mut rest = images[j].clone();
                    for (q, mq) in space.iter().zip(&heavy) {
                        let part = mq.dot(&rest);
                        rest.axpy(-part, q, 1.0);
                    }
                    (j, length(&rest))
                })
                .collect();
            let found = project(&heavy, &images, &open, count, sigma).ok_or(Trouble::Missing)?;
            if found.len() >= count || exhausted {
                return Ok(found);
            }
        }
    }
}

/// Settled pairs of the projection, nearest first.
fn project(
    heavy: &[DVector<f64>],
    images: &[DVector<f64>],
    open: &[(usize, f64)],
    count: usize,
    sigma: f64,
) -> Option<Vec<Wave>> {
    let m = images.len();
    let small = DMatrix::from_fn(m, m, |i, j| heavy[i].dot(&images[j]));
    let mut all: Vec<Complex<f64>> = eigenvalues(small.clone())?.iter().copied().collect();
    all.sort_by(|a, b| b.re.hypot(b.im).total_cmp(&a.re.hypot(a.im)).then(b.im.total_cmp(&a.im)));
    let mut found = Vec::new();
    for theta in all {
        let size = theta.re.hypot(theta.im);
        if found.len() >= count || size == 0.0 {
            break;
        }
        let weights = eigenvector(&small, theta)?;
        let missed: f64 = open.iter().map(|(j, length)| weights[*j].re.hypot(weights[*j].im) * length).sum();
        if missed > RESIDUAL * size {
            break;
        }
        let mut square = Complex::new(sigma, 0.0) + Complex::new(1.0, 0.0) / theta;
        if square.im.abs() <= REAL * square.re.abs() {
            square.im = 0.0;
        }
        let mut vector = [vec![0.0; images[0].len()], vec![0.0; images[0].len()]];
        for (image, weight) in images.iter().zip(weights.iter()) {
            let weight = weight / theta;
            for (i, value) in image.iter().enumerate() {
                vector[0][i] += weight.re * value;
                vector[1][i] += weight.im * value;
            }
        }
        found.push(Wave { square, vector });
    }
    Some(found)
}

/// By inverse iteration; a real vector for a real eigenvalue.
fn eigenvector(matrix: &DMatrix<f64>, theta: Complex<f64>) -> Option<DVector<Complex<f64>>> {
    let m = matrix.nrows();
    let near = theta * Complex::new(1.0 + 1e-13, 0.0) + Complex::new(1e-300, 0.0);
    let shifted = matrix.map(|value| Complex::new(value, 0.0)) - DMatrix::identity(m, m) * near;
    let factors = shifted.lu();
    let mut x = DVector::from_fn(m, |i, _| Complex::new(1.0 + (1.7 * i as f64).sin(), 0.0));
    for _ in 0..3 {
        x = factors.solve(&x)?;
        let size = x.iter().map(|value| value.norm_sqr()).sum::<f64>().sqrt();
        if size.is_nan() || size == 0.0 {
            return None;
        }
        x /= Complex::new(size, 0.0);
    }
    // Its largest component real: what swings together then has no imaginary part.
    let largest = x.iter().max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr())).copied()?;
    let turn = largest.conj() / Complex::new(largest.norm_sqr().sqrt(), 0.0);
    Some(x.map(|value| value * turn))
}
