//! The lowest ω² of a pencil K x = ω² M x without an energy: K has no symmetry, and ω² may be complex.
//!
//! A block Krylov space of (K - σ M)⁻¹ M as in `pencil`, of which the projection is no longer symmetric (W. E. Arnoldi, *Quart. Appl.
//! Math.* 9 (1951) 17). No inertia counts what is there; instead everything nearer to the shift than what is asked for must have
//! settled, from a start of several vectors. The same space serves the quadratic pencils of `damped`.

use super::pencil::Trouble;
use flexura_equilibrium::Vibration;
use flexura_nonlinear::{Breakdown, Matrix};
use flexura_spatial::eigenvalues;
use nalgebra::{Complex, DMatrix, DVector};

/// Vectors of the largest space, besides so many for each eigenvalue.
pub(super) const MOST: usize = 50;
pub(super) const PER: usize = 12;
/// Vectors of the start, and between two looks.
const BLOCK: usize = 4;
const LOOK: usize = 6;
/// How well a pair must satisfy its equation.
const RESIDUAL: f64 = 1e-10;
/// Part of its length that may be left of a vector that says something new.
const NEW: f64 = 1e-9;
/// Part of ω² that may be imaginary by round-off.
const REAL: f64 = 1e-7;

/// ω² = -s² with its vector: real and imaginary parts.
#[derive(Clone, Debug)]
pub struct Wave {
    pub square: Complex<f64>,
    /// s itself where one of ±s alone is meant, and where it is not s² that is real for what swings.
    pub rate: Option<Complex<f64>>,
    pub vector: [Vec<f64>; 2],
}

impl Wave {
    /// ω² that elements must resolve: of what does not swing none.
    pub fn size(&self) -> f64 {
        match self.rate {
            Some(s) if s.im == 0.0 => 0.0,
            Some(s) => s.norm_sqr(),
            None => self.square.re,
        }
    }
}

/// What a Krylov space is made of: an operator whose eigenvalues θ are large for what lies near a shift, and the product that tells
/// its vectors apart.
pub(super) trait Operator {
    /// Length of its vectors.
    fn size(&self) -> usize;
    /// W x, with x·W y the product.
    fn weighed(&self, x: &DVector<f64>) -> DVector<f64>;
    /// What it makes of a vector, given with W times the same.
    fn apply(&mut self, x: &DVector<f64>, weighed: &DVector<f64>) -> DVector<f64>;
}

/// (K - σ M)⁻¹ M.
struct Inverse<'v> {
    vibration: &'v Vibration,
    /// K - σ M, factorised.
    matrix: Matrix,
}

impl<'v> Inverse<'v> {
    fn new(vibration: &'v Vibration, sigma: f64) -> Result<Self, Trouble> {
        let mut matrix = Matrix::default();
        matrix.arrange(vibration.size, &vibration.blocks);
        matrix.reset();
        for &(i, j, value) in &vibration.stiffness {
            matrix.add(i, j, value);
        }
        for &(i, j, value) in &vibration.inertia {
            matrix.add(i, j, -sigma * value);
        }
        matrix.factorise()?;
        Ok(Self { vibration, matrix })
    }
}

impl Operator for Inverse<'_> {
    fn size(&self) -> usize {
        self.vibration.size
    }

    fn weighed(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut out = DVector::zeros(x.len());
        self.vibration.inertia.iter().for_each(|&(i, j, value)| out[i] += value * x[j]);
        out
    }

    fn apply(&mut self, _: &DVector<f64>, weighed: &DVector<f64>) -> DVector<f64> {
        let mut image = weighed.clone();
        self.matrix.solve(image.as_mut_slice());
        image
    }
}

/// The `count` ω² nearest to σ, those of a conjugate pair both counted, and their vectors.
pub fn nearest(vibration: &Vibration, count: usize, sigma: f64) -> Result<Vec<Wave>, Trouble> {
    let is_enough = |found: &[Ritz]| found.len() >= count;
    let most = (MOST + PER * count).min(vibration.size);
    let found = largest(Inverse::new(vibration, sigma)?, count, most, &is_enough)?;
    let wave = |(theta, vector): Ritz| {
        let mut square = Complex::new(sigma, 0.0) + Complex::new(1.0, 0.0) / theta;
        if square.im.abs() <= REAL * square.re.abs() {
            square.im = 0.0;
        }
        Wave { square, rate: None, vector }
    };
    Ok(found.into_iter().map(wave).collect())
}

/// An eigenvalue of an operator with its vector, real and imaginary parts.
pub(super) type Ritz = (Complex<f64>, [Vec<f64>; 2]);

/// The largest eigenvalues of an operator with their vectors, those of a conjugate pair both counted, until there are enough; fewer
/// where there are no more, or where a space of `most` vectors shows no more. The first look is at `count` and two vectors more.
pub(super) fn largest<O: Operator>(
    operator: O,
    count: usize,
    most: usize,
    is_enough: &dyn Fn(&[Ritz]) -> bool,
) -> Result<Vec<Ritz>, Trouble> {
    let mut space = Space { operator, vectors: Vec::new(), heavy: Vec::new(), images: Vec::new(), next: 0 };
    let (mut dead, mut since) = (0, 0);
    loop {
        let is_fresh = space.vectors.len() < BLOCK || space.next >= space.vectors.len();
        if space.grow(is_fresh, dead)? {
            since += 1;
        } else {
            dead += usize::from(is_fresh);
        }
        let exhausted = dead > 3 || space.vectors.len() >= most;
        if exhausted || since >= LOOK && space.vectors.len() > count + 2 {
            since = 0;
            let open = space.open();
            match project(&space.heavy, &space.images, &open, is_enough) {
                Some(found) if exhausted || is_enough(&found) => return Ok(found),
                None if exhausted => return Err(Trouble::Missing),
                _ => {}
            }
        }
    }
}

/// A Krylov space, orthonormal in the operator's product.
struct Space<O> {
    operator: O,
    vectors: Vec<DVector<f64>>,
    /// W times each.
    heavy: Vec<DVector<f64>>,
    /// What the operator makes of each.
    images: Vec<DVector<f64>>,
    /// Whose image is the next to be taken in.
    next: usize,
}

impl<O: Operator> Space<O> {
    fn length(&self, x: &DVector<f64>) -> f64 {
        x.dot(&self.operator.weighed(x)).max(0.0).sqrt()
    }

    /// Without what lies along the vectors so far.
    fn across(&self, mut x: DVector<f64>) -> DVector<f64> {
        for (q, mq) in self.vectors.iter().zip(&self.heavy) {
            let part = mq.dot(&x);
            x.axpy(-part, q, 1.0);
        }
        x
    }

    /// Takes in the next image, or a vector without a history; false where it says nothing new.
    fn grow(&mut self, is_fresh: bool, dead: usize) -> Result<bool, Trouble> {
        let candidate = if is_fresh {
            let seed = (self.vectors.len() + 7 * dead) as f64 + 1.3;
            let noise = DVector::from_fn(self.operator.size(), |i, _| ((2.4 * i as f64 + 0.7) * seed).sin());
            let weighed = self.operator.weighed(&noise);
            self.operator.apply(&noise, &weighed)
        } else {
            self.next += 1;
            self.images[self.next - 1].clone()
        };
        let before = self.length(&candidate);
        let mut candidate = self.across(self.across(candidate));
        let size = self.length(&candidate);
        if !size.is_finite() {
            return Err(Breakdown::NotFinite.into());
        }
        if size <= NEW * before || before == 0.0 {
            return Ok(false);
        }
        candidate /= size;
        let heavy = self.operator.weighed(&candidate);
        let image = self.operator.apply(&candidate, &heavy);
        self.vectors.push(candidate);
        self.heavy.push(heavy);
        self.images.push(image);
        Ok(true)
    }

    /// What the space does not hold of the images yet.
    fn open(&self) -> Vec<(usize, f64)> {
        let rest = |j: usize| (j, self.length(&self.across(self.images[j].clone())));
        (self.next..self.vectors.len()).map(rest).collect()
    }
}

/// Settled pairs of the projection, nearest first.
fn project(
    heavy: &[DVector<f64>],
    images: &[DVector<f64>],
    open: &[(usize, f64)],
    is_enough: &dyn Fn(&[Ritz]) -> bool,
) -> Option<Vec<Ritz>> {
    let m = images.len();
    let small = DMatrix::from_fn(m, m, |i, j| heavy[i].dot(&images[j]));
    let mut all: Vec<Complex<f64>> = eigenvalues(small.clone())?.iter().copied().collect();
    all.sort_by(|a, b| b.re.hypot(b.im).total_cmp(&a.re.hypot(a.im)).then(b.im.total_cmp(&a.im)));
    let mut found = Vec::new();
    for theta in all {
        let size = theta.re.hypot(theta.im);
        if size == 0.0 || is_enough(&found) {
            break;
        }
        let Some(weights) = eigenvector(&small, theta) else { break };
        let missed: f64 = open.iter().map(|(j, length)| weights[*j].re.hypot(weights[*j].im) * length).sum();
        if missed > RESIDUAL * size {
            break;
        }
        let mut vector = [vec![0.0; images[0].len()], vec![0.0; images[0].len()]];
        for (image, weight) in images.iter().zip(weights.iter()) {
            let weight = weight / theta;
            for (i, value) in image.iter().enumerate() {
                vector[0][i] += weight.re * value;
                vector[1][i] += weight.im * value;
            }
        }
        found.push((theta, vector));
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
