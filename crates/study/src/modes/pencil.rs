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

/// Vectors of the start: as many as there are equal ω² where sections are round.
const BLOCK: usize = 2;
/// Vectors without a history where some are missing.
const STIR: usize = 4;
/// Vectors between two looks at what has been found.
const LOOK: usize = 4;
/// How well a Ritz pair must satisfy its equation. The error of ω² is the square of this, that of the shape, which is taken from the
/// image, this times the ratio of neighbouring θ.
pub const SHARP: f64 = 1e-8;
/// The same where shapes do not matter beyond being told apart.
pub const FAIR: f64 = 3e-7;
/// The same where ω² are wanted roughly.
const ROUGH: f64 = 1e-4;
/// Searches that may follow one another.
const TRIES: usize = 7;
/// Part of its length that may be left of a vector that says something new.
const NEW: f64 = 1e-9;
/// 1/ω² beside inertia over stiffness that is round-off.
const HELD: f64 = 1e-10;
/// Tries of a shift that lies below everything.
const SHIFTS: usize = 40;
/// How many of them may be singular, by how much farther the next one lies, and how far at least.
const SINGULAR: usize = 8;
const FARTHER: f64 = 7.3;
const STEP: f64 = 1e-6;
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
    symmetric: &'v mut Symmetric,
    random: u64,
}

/// A matrix whose pattern serves one pencil after the other as long as these have the same unknowns.
#[derive(Default)]
pub struct Bench {
    symmetric: Symmetric,
    size: usize,
    blocks: Vec<[usize; 2]>,
}

impl<'v> Shifted<'v> {
    pub fn new(vibration: &'v Vibration, bench: &'v mut Bench) -> Self {
        let blocks: Vec<_> = vibration.blocks.iter().map(|block| [block.first, block.count]).collect();
        if (bench.size, &bench.blocks) != (vibration.size, &blocks) {
            bench.symmetric.arrange(vibration.size, &vibration.blocks);
            (bench.size, bench.blocks) = (vibration.size, blocks);
        }
        Self { vibration, symmetric: &mut bench.symmetric, random: 0 }
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
                    // A shift may hit an ω², or be nothing beside stiffnesses; what is nothing beside the largest is not.
                    singular += 1;
                    if singular > SINGULAR {
                        return Err(Trouble::Massless(self.null_vector()));
                    }
                    sigma -= if singular <= 2 { 0.37 } else { FARTHER } * sigma.abs() + STEP;
                }
            }
        }
        Err(Trouble::Bottomless)
    }

    /// The `count` lowest ω² with their vectors, of length one in M, or all where there are fewer.
    pub fn lowest(&mut self, count: usize, start: &Start) -> Result<Vec<Pair>, Trouble> {
        let sigma = self.settle(start.below)?;
        let mut space = Space { starts: start.vectors.clone(), residual: start.residual, ..Space::default() };
        let mut wanted = count;
        for _ in 0..TRIES {
            let exhausted = self.grow(&mut space, wanted)?;
            let mut found = space.pairs(sigma);
            if found.len() < wanted && !exhausted {
                return Err(Trouble::Missing);
            }
            if !start.prove || found.is_empty() {
                found.truncate(count);
                return Ok(found);
            }
            let (last, counted) = self.count(&found, wanted.min(found.len()), sigma)?;
            if counted == Some(last) {
                found.truncate(count);
                return Ok(found);
            }
            if self.below(sigma)? != Some(0) {
                return Err(Trouble::Missing);
            }
            // As many as there are, be they close to the last or equal to others.
            let missing = counted.map_or(0, |counted| counted.saturating_sub(last));
            wanted = if exhausted { wanted } else { last + missing.max(1) };
            space.stir = STIR;
        }
        Err(Trouble::Missing)
    }

    /// Counts what lies below a shift beyond the first `last` of what was found, or beyond a few more, which are equal to these.
    fn count(
        &mut self,
        found: &[Pair],
        mut last: usize,
        sigma: f64,
    ) -> Result<(usize, Option<usize>), Breakdown> {
        let tied = |a: f64, b: f64| b - a <= APART * b.abs() + ROUND * (b - sigma);
        loop {
            // Where the list may be cut: between two that are not equal.
            while last < found.len() && tied(found[last - 1].0, found[last].0) {
                last += 1;
            }
            let a = found[last - 1].0;
            let gap =
                found.get(last).map_or(a + (1e-3 * (a - sigma)).max(1e-6 * a.abs()), |(b, _)| 0.5 * (a + b));
            // Where round-off makes two of motions without stiffness nothing lies between them.
            match self.below(gap)? {
                None if last < found.len() => last += 1,
                counted => return Ok((last, counted)),
            }
        }
    }

    /// Enlarges the space until it has `wanted` settled pairs; true where nothing is left to be added.
    fn grow(&mut self, space: &mut Space, wanted: usize) -> Result<bool, Trouble> {
        let most = self.vibration.size;
        let mut dead = 0;
        let mut look = (space.vectors.len() + space.stir).max(wanted) + space.starts.len().max(LOOK);
        loop {
            let known = space.starts.pop();
            let fresh = known.is_none()
                && (space.vectors.len() < BLOCK || space.stir > 0 || space.next >= space.vectors.len());
            let (candidate, before) = if let Some(x) = known {
                let x = DVector::from_vec(x);
                let length = self.length(&x);
                (x, length)
            } else if fresh {
                space.stir = space.stir.saturating_sub(1);
                let noise = self.noise();
                let mut x = self.weighed(&noise);
                self.symmetric.solve(x.as_mut_slice());
                let length = self.length(&x);
                (x, length)
            } else {
                space.next += 1;
                let rest = &mut space.rests[space.next - 1];
                (std::mem::take(&mut rest.vector), rest.whole)
            };
            if !self.take_in(space, candidate, before)? {
                dead += usize::from(fresh);
                if dead > 3 {
                    self.project(space);
                    return Ok(true);
                }
            }
            if space.vectors.len() >= most {
                self.project(space);
                return Ok(true);
            }
            if space.vectors.len() >= look {
                look += LOOK;
                self.project(space);
                if space.settled() >= wanted {
                    return Ok(false);
                }
            }
        }
    }

    /// Takes in what is new of a vector, with its image; false where nothing is. `before` is the length of what it was part of.
    fn take_in(
        &mut self,
        space: &mut Space,
        mut candidate: DVector<f64>,
        before: f64,
    ) -> Result<bool, Trouble> {
        space.across(&mut candidate);
        space.across(&mut candidate);
        let mut weighed = self.weighed(&candidate);
        let length = candidate.dot(&weighed).max(0.0).sqrt();
        if !length.is_finite() {
            return Err(Trouble::Breakdown(Breakdown::NotFinite));
        }
        if length <= NEW * before || before == 0.0 {
            return Ok(false);
        }
        candidate /= length;
        weighed /= length;
        let mut image = weighed.clone();
        self.symmetric.solve(image.as_mut_slice());
        space.vectors.push(candidate);
        space.weighed.push(weighed);
        let whole = self.length(&image);
        let mut rest = image.clone();
        let column = space.across(&mut rest);
        space.images.push(image);
        space.columns.push(column);
        space.rests.push(Rest { vector: rest, whole });
        Ok(true)
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
        // The part of an image along a later vector is that of the later one's image along the earlier: both are symmetric in M.
        let raw = DMatrix::from_fn(m, m, |i, j| space.columns[i.max(j)][i.min(j)]);
        let eigen = SymmetricEigen::new(raw);
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        // What the space does not hold of the images yet.
        let mut open = Vec::with_capacity(m - space.next);
        for j in space.next..m {
            let mut rest = std::mem::take(&mut space.rests[j].vector);
            space.across(&mut rest);
            open.push((j, self.length(&rest)));
            space.rests[j].vector = rest;
        }
        let pair = |k: usize| {
            let theta = eigen.eigenvalues[k];
            let weights = eigen.eigenvectors.column(k).into_owned();
            let missed: f64 = open.iter().map(|(j, length)| weights[*j].abs() * length).sum();
            (theta, weights, missed / theta.abs())
        };
        space.ritz = order.into_iter().map(pair).collect();
    }
}

/// What an image has beyond the space as it was.
struct Rest {
    /// Empty once it was taken in.
    vector: DVector<f64>,
    /// Length of the image.
    whole: f64,
}

/// With what a search begins.
pub struct Start {
    /// A shift that is thought to lie below all ω².
    pub below: f64,
    /// Vectors like those wanted.
    pub vectors: Vec<Vec<f64>>,
    /// Are they to be counted? Else one of several equal ones may be missing.
    pub prove: bool,
    /// How well they are to satisfy their equations.
    pub residual: f64,
}

impl Start {
    /// A rough look with nothing but a shift.
    pub fn look(below: f64) -> Self {
        Self { below, vectors: Vec::new(), prove: false, residual: ROUGH }
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
    /// Parts of each image along the vectors up to its own.
    columns: Vec<Vec<f64>>,
    rests: Vec<Rest>,
    /// Vectors to be taken in first.
    starts: Vec<Vec<f64>>,
    /// How well a pair must satisfy its equation.
    residual: f64,
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
    /// Takes out of x what lies along the vectors, and gives its parts.
    fn across(&self, x: &mut DVector<f64>) -> Vec<f64> {
        let take = |(q, mq): (&DVector<f64>, &DVector<f64>)| {
            let part = mq.dot(x);
            x.axpy(-part, q, 1.0);
            part
        };
        self.vectors.iter().zip(&self.weighed).map(take).collect()
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
        let is_settled = |pair: &&(f64, DVector<f64>, f64)| pair.0 > self.floor && pair.2 <= self.residual;
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
