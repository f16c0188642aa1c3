//! The lowest ω² of a pencil K x = ω² M x with M semidefinite, proved to be all of them.
//!
//! Below a shift σ that lies under every ω² the matrix K - σ M is positive on all that its constraints allow, and (K - σ M)⁻¹ M has
//! eigenvalues 1/(ω² - σ), the largest for the lowest ω². A block Krylov space, orthonormal with respect to M, finds them (T. Ericsson
//! and A. Ruhe, *Math. Comp.* 35 (1980) 1251; B. Nour-Omid and others, *Math. Comp.* 48 (1987) 663, for M that is only semidefinite).
//! Such a space can overlook one of several that are equal; the inertia of K - σ M above the last of them counts how many there are,
//! and as long as some are missing the space grows by vectors that have nothing to do with it.

use flexura_equilibrium::Vibration;
use flexura_nonlinear::{Breakdown, Symmetric};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Vectors of the start.
const BLOCK: usize = 4;
/// Vectors between two looks at what has been found.
const LOOK: usize = 6;
/// How well a Ritz pair must satisfy its equation.
const RESIDUAL: f64 = 1e-10;
/// Part of its length that may be left of a vector that says something new.
const NEW: f64 = 1e-9;
/// 1/ω² beside inertia over stiffness that is round-off.
const HELD: f64 = 1e-10;
/// Tries of a shift that lies below everything.
const SHIFTS: usize = 40;
/// Relative distance of ω² that count as two.
const APART: f64 = 1e-7;
/// The same beside their distance from the shift.
const ROUND: f64 = 1e-9;

/// Why there are no modes.
#[derive(Debug)]
pub enum Trouble {
    Breakdown(Breakdown),
    /// Something moves without stiffness and without inertia: as a vector of the pencil.
    Massless(Vec<f64>),
    /// The same by its name.
    Loose(Option<String>),
    /// Nothing that moves has a mass.
    Weightless,
    /// The lowest ω² would be -∞: something without inertia gives way.
    Bottomless,
    /// The count and what was found do not agree.
    Missing,
}

impl From<Breakdown> for Trouble {
    fn from(breakdown: Breakdown) -> Self {
        Trouble::Breakdown(breakdown)
    }
}

/// An ω² and its vector.
pub type Pair = (f64, Vec<f64>);

/// Factorises K - σ M for one shift after another.
pub struct Shifted<'v> {
    vibration: &'v Vibration,
    symmetric: Symmetric,
    random: u64,
}

impl<'v> Shifted<'v> {
    pub fn new(vibration: &'v Vibration) -> Self {
        let mut symmetric = Symmetric::default();
        symmetric.arrange(vibration.size, &vibration.blocks);
        Self { vibration, symmetric, random: 0 }
    }

    /// How many ω² lie below σ; None where that cannot be told.
    pub fn below(&mut self, sigma: f64) -> Result<Option<usize>, Breakdown> {
        self.symmetric.reset();
        for &(i, j, value) in &self.vibration.stiffness {
            self.symmetric.add(i, j, value);
        }
        for &(i, j, value) in &self.vibration.inertia {
            self.symmetric.add(i, j, -sigma * value);
        }
        let inertia = self.symmetric.factorise()?;
        Ok(if inertia.zero > 0 { None } else { inertia.negative.checked_sub(self.vibration.multipliers) })
    }

    fn weighed(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut out = DVector::zeros(x.len());
        self.vibration.inertia.iter().for_each(|&(i, j, value)| out[i] += value * x[j]);
        out
    }

    /// Its length in M.
    fn length(&self, x: &DVector<f64>) -> f64 {
        x.dot(&self.weighed(x)).max(0.0).sqrt()
    }

    /// Numbers in (-1, 1) without a pattern (S. Vigna's splitmix64).
    fn noise(&mut self) -> DVector<f64> {
        DVector::from_fn(self.vibration.size, |_, _| {
            self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.random;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
    }

    /// A null vector of the factorised matrix.
    fn null_vector(&mut self) -> Vec<f64> {
        let mut x = self.noise();
        for _ in 0..3 {
            self.symmetric.solve(x.as_mut_slice());
            let size = x.amax();
            if size > 0.0 {
                x /= size;
            }
        }
        x.as_slice().to_vec()
    }

    /// Factorises at a shift below every ω², `hint` or lower.
    fn settle(&mut self, hint: f64) -> Result<f64, Trouble> {
        let mut sigma = hint;
        let mut singular = 0;
        for _ in 0..SHIFTS {
            match self.below(sigma)? {
                Some(0) => return Ok(sigma),
                Some(_) => sigma = if sigma < 0.0 { 4.0 * sigma } else { -1e-3 * (1.0 + sigma) },
                None => {
                    // A shift may hit an ω²; two do not.
                    singular += 1;
                    if singular > 2 {
                        return Err(Trouble::Massless(self.null_vector()));
                    }
                    sigma -= 0.37 * sigma.abs() + 1e-6;
                }
            }
        }
        Err(Trouble::Bottomless)
    }

    /// The `count` lowest ω² with their vectors, of length one in M, or all where there are fewer; `hint` is thought to lie
    /// below them.
    pub fn lowest(&mut self, count: usize, hint: f64) -> Result<Vec<Pair>, Trouble> {
        let sigma = self.settle(hint)?;
        let mut space = Space::default();
        let mut tries = 0;
        loop {
            let exhausted = self.grow(&mut space, count + 1, BLOCK)?;
            let mut found = space.pairs(sigma);
            if found.len() < count && !exhausted {
                return Err(Trouble::Missing);
            }
            // Where the list may be cut: between two that are not equal.
            let mut last = count.min(found.len());
            let tied = |a: f64, b: f64| b - a <= APART * b.abs() + ROUND * (b - sigma);
            let counted = loop {
                while last > 0 && last < found.len() && tied(found[last - 1].0, found[last].0) {
                    last += 1;
                }
                let gap = match (last.checked_sub(1).map(|i| found[i].0), found.get(last)) {
                    (Some(a), Some((b, _))) => 0.5 * (a + b),
                    (Some(a), None) => a + (1e-3 * (a - sigma)).max(1e-6 * a.abs()),
                    (None, _) => return Ok(Vec::new()),
                };
                // Where round-off makes two of motions without stiffness nothing lies between them.
                match self.below(gap)? {
                    None if last < found.len() => last += 1,
                    counted => break counted,
                }
            };
            if counted == Some(last) {
                found.truncate(count);
                return Ok(found);
            }
            tries += 1;
            if tries > 6 {
                return Err(Trouble::Missing);
            }
            if self.below(sigma)? != Some(0) {
                return Err(Trouble::Missing);
            }
            space.stir = BLOCK;
        }
    }

    /// Enlarges the space until it has `wanted` settled pairs; true where nothing is left to be added.
    fn grow(&mut self, space: &mut Space, wanted: usize, block: usize) -> Result<bool, Trouble> {
        let most = self.vibration.size;
        let mut dead = 0;
        let mut since = 0;
        let target = space.vectors.len() + LOOK.min(wanted);
        loop {
            let fresh = space.vectors.len() < block || space.stir > 0 || space.next >= space.vectors.len();
            let mut candidate = if fresh {
                space.stir = space.stir.saturating_sub(1);
                let mut x = {
                    let noise = self.noise();
                    self.weighed(&noise)
                };
                self.symmetric.solve(x.as_mut_slice());
                x
            } else {
                space.next += 1;
                space.images[space.next - 1].clone()
            };
            let before = self.length(&candidate);
            for _ in 0..2 {
                for (q, mq) in space.vectors.iter().zip(&space.weighed) {
                    let part = mq.dot(&candidate);
                    candidate.axpy(-part, q, 1.0);
                }
            }
            let weighed = self.weighed(&candidate);
            let length = candidate.dot(&weighed).max(0.0).sqrt();
            if !length.is_finite() {
                return Err(Trouble::Breakdown(Breakdown::NotFinite));
            }
            if length <= NEW * before || before == 0.0 {
                if fresh {
                    dead += 1;
                }
                if dead > 3 {
                    self.project(space);
                    return Ok(true);
                }
                continue;
            }
            candidate /= length;
            let weighed = weighed / length;
            let mut image = weighed.clone();
            self.symmetric.solve(image.as_mut_slice());
            space.add(candidate, weighed, image);
            since += 1;
            if since >= LOOK && space.vectors.len() >= target.max(wanted + 2) {
                since = 0;
                self.project(space);
                if space.settled() >= wanted {
                    return Ok(false);
                }
            }
            if space.vectors.len() >= most {
                self.project(space);
                return Ok(true);
            }
        }
    }

    /// Eigenvalues of what (K - σ M)⁻¹ M does within the space.
    fn project(&self, space: &mut Space) {
        let m = space.vectors.len();
        let largest =
            |list: &[(usize, usize, f64)]| list.iter().map(|(.., value)| value.abs()).fold(0.0, f64::max);
        // What is held moves by round-off, as if its ω² were enormous.
        space.floor = HELD * largest(&self.vibration.inertia) / largest(&self.vibration.stiffness);
        if m == 0 {
            return;
        }
        let raw = DMatrix::from_fn(m, m, |i, j| space.weighed[i].dot(&space.images[j]));
        let eigen = SymmetricEigen::new((&raw + raw.transpose()) * 0.5);
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        // What the space does not hold of the images yet.
        let open: Vec<(usize, f64)> = (space.next..m)
            .map(|j| {
                let mut rest = space.images[j].clone();
                for (q, mq) in space.vectors.iter().zip(&space.weighed) {
                    let part = mq.dot(&rest);
                    rest.axpy(-part, q, 1.0);
                }
                (j, self.length(&rest))
            })
            .collect();
        let pair = |k: usize| {
            let theta = eigen.eigenvalues[k];
            let weights = eigen.eigenvectors.column(k).into_owned();
            let missed: f64 = open.iter().map(|(j, length)| weights[*j].abs() * length).sum();
            (theta, weights, missed / theta.abs())
        };
        space.ritz = order.into_iter().map(pair).collect();
    }
}

/// A Krylov space, orthonormal with respect to M.
#[derive(Default)]
struct Space {
    vectors: Vec<DVector<f64>>,
    /// M times each.
    weighed: Vec<DVector<f64>>,
    /// (K - σ M)⁻¹ M times each.
    images: Vec<DVector<f64>>,
    /// Whose image is the next to be taken in.
    next: usize,
    /// How many vectors without a history are to be taken in first.
    stir: usize,
    /// 1/(ω² - σ) that is round-off.
    floor: f64,
    /// 1/(ω² - σ), largest first, with weights of the vectors, and by how much the pair misses its equation.
    ritz: Vec<(f64, DVector<f64>, f64)>,
}

impl Space {
    fn add(&mut self, vector: DVector<f64>, weighed: DVector<f64>, image: DVector<f64>) {
        self.vectors.push(vector);
        self.weighed.push(weighed);
        self.images.push(image);
    }

    fn combined(&self, of: &[DVector<f64>], weights: &DVector<f64>) -> DVector<f64> {
        let mut sum = DVector::zeros(of.first().map_or(0, DVector::len));
        for (x, weight) in of.iter().zip(weights.iter()) {
            sum.axpy(*weight, x, 1.0);
        }
        sum
    }

    /// How many of the largest are settled, without a gap.
    fn settled(&self) -> usize {
        let is_settled = |pair: &&(f64, DVector<f64>, f64)| pair.0 > self.floor && pair.2 <= RESIDUAL;
        self.ritz.iter().take_while(is_settled).count()
    }

    /// The settled pairs.
    fn pairs(&self, sigma: f64) -> Vec<Pair> {
        let settled = &self.ritz[..self.settled()];
        settled
            .iter()
            .map(|(theta, weights, _)| {
                let mut x = self.combined(&self.images, weights);
                x /= *theta;
                (sigma + 1.0 / theta, x.as_slice().to_vec())
            })
            .collect()
    }
}
