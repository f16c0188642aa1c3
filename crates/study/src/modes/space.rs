//! The linear model of a mechanism about an equilibrium, for control.
//!
//! Of K x + D ẋ + M ẍ = b u the lowest modes are kept, φᵀ M φ = 1, and what the others yield statically goes into the feedthrough:
//!
//! ```text
//!   q̈ + Φᵀ D Φ q̇ + Ω² q = Φᵀ b u      y = c Φ q + (c K⁻¹ b - Σ (c φ)(φᵀ b)/ω²) u
//! ```
//!
//! (R. R. Craig and A. J. Kurdila, *Fundamentals of Structural Dynamics*, 2nd ed., 2006, ch. 12). Residual vectors K⁻¹b, K⁻¹M K⁻¹b, …
//! may join the modes as further coordinates: then the response and as many derivatives by ω² are right at standstill too. Where
//! something moves without stiffness K - σ M with a σ below zero takes the place of K.

mod read;
mod signals;
mod whole;

use super::pencil::{Bench, SHARP, Start, Trouble};
use super::{Aim, Spectrum, counted, explain, refuse, spectrum, stand};
use crate::{Options, ProblemError, Progress};
use flexura_equilibrium::{Equilibrium, Vibration};
use flexura_model::{Model, ModesStudy, StudyKind};
use flexura_nonlinear::{Breakdown, Symmetric};
use flexura_solution::{Solution, StateSpace, Status};
use nalgebra::{DMatrix, SymmetricEigen};
use read::Reader;
use signals::{Input, Measure, Wanted};
use whole::{Place, Reduced};

/// Part of a residual vector that must be new.
const NEW: f64 = 1e-7;
/// Where below zero a mechanism with motions without stiffness is looked at, beside its first ω².
const BELOW: f64 = -0.1;
/// How near the reduced response comes where nothing says how many residual vectors it has, and how many it has at most.
const NEAR: f64 = 1e-6;
const MOST: usize = 3;

/// What is asked of a linear model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StateSpaceRequest {
    /// `load.NAME`, `load.NAME.force.x`, `load.NAME.moment.z`, `ground.acceleration.y`; none: of every load the components that it has,
    /// or the three accelerations where there is no load.
    pub inputs: Vec<String>,
    /// `NAME`, `NAME.x`, `NAME.velocity`, `NAME.x.acceleration`; none: all outputs of the model.
    pub outputs: Vec<String>,
    /// Damping of every mode beside what the model has, as a part of critical damping.
    pub damping_ratio: f64,
    /// Residual vectors for each input; None: the fewest, up to three, by which the response comes within 1e-6 of the whole one.
    pub residual_vectors: Option<usize>,
}

/// Vectors of a pencil, orthonormal in M, that diagonalise K.
struct Basis {
    squares: Vec<f64>,
    vectors: Vec<Vec<f64>>,
    modes: usize,
}

/// The linear model about the equilibrium of a study of modes, with its `count` modes.
///
/// # Errors
/// As [`super::modes`]; inputs and outputs that there are not; a mechanism without an energy.
pub fn state_space(
    model: &Model,
    study: &ModesStudy,
    request: &StateSpaceRequest,
    options: &Options,
    progress: &mut dyn FnMut(Progress),
) -> Result<StateSpace, ProblemError> {
    crate::trace::check_study(model, StudyKind::Modes(*study))?;
    check(request)?;
    let inputs = signals::inputs(model, &request.inputs)?;
    let (mut prepared, mut solution, _) = stand(model, study, options, progress)?;
    if solution.status != Status::Converged {
        return Ok(empty(solution));
    }
    let problem = prepared.problem();
    refuse(problem)?;
    let outputs = signals::outputs(model, &request.outputs, &mut solution.warnings)?;
    let mut bench = Bench::default();
    let built = spectrum(problem, &mut bench, study.count, None, Aim::Frequencies)
        .and_then(|found| Builder::new(problem, &found, &solution, study.count, &mut bench, &inputs));
    let builder = match built {
        Ok(builder) => builder,
        Err(Trouble::Breakdown(Breakdown::Interrupted)) => {
            solution.status = Status::Interrupted;
            solution.reason = Some("interrupted before the modes were found".to_string());
            return Ok(empty(solution));
        }
        Err(trouble) => return Err(explain(&trouble)),
    };
    if !builder.vibration.has_energy {
        return Err(ProblemError::new(
            "study",
            "gives no state space: where there is no energy, modes do not decouple",
            "leave follower loads out, or read the complex modes",
        ));
    }
    builder.build(solution, request, &outputs)
}

fn check(request: &StateSpaceRequest) -> Result<(), ProblemError> {
    let wrong = |message: &str, hint: &str| Err(ProblemError::new("study", message, hint));
    if !(request.damping_ratio >= 0.0 && request.damping_ratio.is_finite()) {
        return wrong("asks for a negative damping ratio", "write a part of critical damping, like 0.01");
    }
    if request.residual_vectors.is_some_and(|count| count > 20) {
        return wrong("asks for more than 20 residual vectors an input", "two or three are as good as all");
    }
    Ok(())
}

fn empty(solution: Solution) -> StateSpace {
    StateSpace {
        solution,
        inputs: Vec::new(),
        outputs: Vec::new(),
        squares: Vec::new(),
        modes: 0,
        residual_vectors: 0,
        a: Vec::new(),
        b: Vec::new(),
        c: Vec::new(),
        d: Vec::new(),
        error_estimate: None,
    }
}

/// The pencil with what drives it.
struct Builder<'p> {
    problem: &'p Equilibrium,
    vibration: Vibration,
    reader: Reader,
    inputs: &'p [Input],
    /// b for each input.
    drives: Vec<Vec<f64>>,
    /// Of K - σ M.
    symmetric: Symmetric,
    sigma: f64,
    basis: Basis,
}

impl<'p> Builder<'p> {
    fn new(
        problem: &'p Equilibrium,
        found: &Spectrum,
        solution: &Solution,
        count: usize,
        bench: &mut Bench,
        inputs: &'p [Input],
    ) -> Result<Self, Trouble> {
        let vibration = found.vibration.clone();
        let start = Start { below: -1.0, vectors: Vec::new(), prove: true, residual: SHARP };
        // Of what is damped or spins, the modes of stiffness and inertia alone.
        let pairs =
            if vibration.has_energy { counted(&vibration, bench, count, &start)? } else { Vec::new() };
        let is_rigid = pairs.iter().any(|(square, _)| *square == 0.0);
        let first = pairs.iter().map(|(square, _)| *square).find(|square| *square > 0.0).unwrap_or(1.0);
        let (squares, vectors): (Vec<f64>, Vec<Vec<f64>>) = pairs.into_iter().unzip();
        let drives = inputs.iter().map(|input| input.drive(problem, &vibration)).collect();
        let modes = squares.len();
        let mut this = Self {
            problem,
            vibration,
            reader: Reader::new(solution),
            inputs,
            drives,
            symmetric: Symmetric::default(),
            sigma: if is_rigid { BELOW * first } else { 0.0 },
            basis: Basis { squares, vectors, modes },
        };
        this.symmetric.arrange(this.vibration.size, &this.vibration.blocks);
        this.factorise(this.sigma)?;
        Ok(this)
    }

    /// Factorises K - σ M.
    fn factorise(&mut self, sigma: f64) -> Result<(), Breakdown> {
        self.symmetric.reset();
        for &(i, j, value) in &self.vibration.stiffness {
            self.symmetric.add(i, j, value);
        }
        for &(i, j, value) in &self.vibration.inertia {
            self.symmetric.add(i, j, -sigma * value);
        }
        if self.symmetric.factorise()?.zero > 0 { Err(Breakdown::Singular) } else { Ok(()) }
    }

    fn solved(&mut self, b: &[f64]) -> Vec<f64> {
        let mut x = b.to_vec();
        self.symmetric.solve(&mut x);
        x
    }

    fn product(entries: &[(usize, usize, f64)], x: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; x.len()];
        entries.iter().for_each(|&(i, j, value)| out[i] += value * x[j]);
        out
    }

    /// Adds the residual vectors to the modes.
    fn add_residuals(&mut self, count: usize) {
        let mut fresh: Vec<Vec<f64>> = Vec::new();
        let mut layer = self.drives.clone();
        for _ in 0..count {
            for b in &mut layer {
                let mut x = self.solved(b);
                let before = dot(&x, &Self::product(&self.vibration.inertia, &x)).max(0.0).sqrt();
                for _ in 0..2 {
                    let heavy = Self::product(&self.vibration.inertia, &x);
                    for known in self.basis.vectors.iter().chain(&fresh) {
                        let part = dot(known, &heavy);
                        x.iter_mut().zip(known).for_each(|(x, known)| *x -= part * known);
                    }
                }
                let size = dot(&x, &Self::product(&self.vibration.inertia, &x)).max(0.0).sqrt();
                if size > NEW * before {
                    x.iter_mut().for_each(|x| *x /= size);
                    // The next is made of what is new alone: the modes would drown it.
                    *b = Self::product(&self.vibration.inertia, &x);
                    fresh.push(x);
                } else {
                    b.fill(0.0);
                }
            }
        }
        if fresh.is_empty() {
            return;
        }
        let stiff: Vec<Vec<f64>> =
            fresh.iter().map(|x| Self::product(&self.vibration.stiffness, x)).collect();
        let small = DMatrix::from_fn(fresh.len(), fresh.len(), |i, j| {
            0.5 * (dot(&fresh[i], &stiff[j]) + dot(&fresh[j], &stiff[i]))
        });
        let eigen = SymmetricEigen::new(small);
        for (k, square) in eigen.eigenvalues.iter().enumerate() {
            let mut x = vec![0.0; self.vibration.size];
            for (weight, vector) in eigen.eigenvectors.column(k).iter().zip(&fresh) {
                x.iter_mut().zip(vector).for_each(|(x, value)| *x += weight * value);
            }
            self.basis.squares.push(*square);
            self.basis.vectors.push(x);
        }
    }

    /// What outputs change by along a vector of the pencil, SI.
    fn read(&self, wanted: &[Wanted], x: &[f64]) -> Result<Vec<f64>, ProblemError> {
        let swing = self.problem.swing(&self.vibration, x);
        self.reader.along(self.problem.model(), &swing, self.vibration.length, wanted)
    }

    /// Readings by each input's answer of the pencil as it is factorised.
    fn answers(&mut self, wanted: &[Wanted]) -> Result<Vec<Vec<f64>>, ProblemError> {
        let drives = self.drives.clone();
        drives
            .iter()
            .map(|b| {
                let x = self.solved(b);
                self.read(wanted, &x)
            })
            .collect()
    }

    /// The response of the whole pencil where the reduced one is held beside it. Leaves K - σ M factorised as it was.
    fn whole(&mut self, wanted: &[Wanted]) -> Result<Vec<Place>, ProblemError> {
        let mut found = Vec::new();
        for square in whole::places(&self.basis.squares[..self.basis.modes]) {
            if self.factorise(square).is_ok() {
                found.push(Place { square, readings: self.answers(wanted)? });
            }
        }
        self.factorise(self.sigma).map_err(|error| explain(&Trouble::Breakdown(error)))?;
        Ok(found)
    }

    /// The response with so many residual vectors, which join the modes in the basis. `known` are readings of the modes, `still` those
    /// of the whole pencil at σ.
    fn reduce(
        &mut self,
        count: usize,
        wanted: &[Wanted],
        known: &[Vec<f64>],
        still: &[Vec<f64>],
    ) -> Result<Reduced, ProblemError> {
        self.basis.squares.truncate(self.basis.modes);
        self.basis.vectors.truncate(self.basis.modes);
        self.add_residuals(count);
        let mut readings = known.to_vec();
        for x in &self.basis.vectors[self.basis.modes..] {
            readings.push(self.read(wanted, x)?);
        }
        let shares: Vec<Vec<f64>> =
            self.drives.iter().map(|b| self.basis.vectors.iter().map(|x| dot(x, b)).collect()).collect();
        let mut feedthrough = still.to_vec();
        for (rest, shares) in feedthrough.iter_mut().zip(&shares) {
            for ((reading, share), square) in readings.iter().zip(shares).zip(&self.basis.squares) {
                let part = share / (square - self.sigma);
                rest.iter_mut().zip(reading).for_each(|(rest, reading)| *rest -= part * reading);
            }
        }
        Ok(Reduced { readings, shares, feedthrough })
    }

    /// The response with as many residual vectors as were asked for, or as few as bring it near; how many, and how near.
    fn nearest(
        &mut self,
        asked: Option<usize>,
        wanted: &[Wanted],
        warnings: &mut Vec<String>,
    ) -> Result<(Reduced, usize, Option<f64>), ProblemError> {
        let whole = self.whole(wanted)?;
        let still = self.answers(wanted)?;
        let known: Vec<Vec<f64>> =
            self.basis.vectors.iter().map(|x| self.read(wanted, x)).collect::<Result<_, _>>()?;
        let mut count = asked.unwrap_or(0);
        loop {
            let reduced = self.reduce(count, wanted, &known, &still)?;
            let error = whole::apart(&whole, &reduced, &self.basis.squares, wanted, self.drives.len());
            let is_near = error.is_none_or(|error| error <= NEAR);
            if asked.is_none() && !is_near && count < MOST {
                count += 1;
                continue;
            }
            if let (None, Some(error), false) = (asked, error, is_near) {
                warnings.push(format!(
                    "the state space is off by {error:.0e} of the response even with {count} residual vectors an input; \
                     more modes come nearer"
                ));
            }
            return Ok((reduced, count, error));
        }
    }

    fn build(
        mut self,
        mut solution: Solution,
        request: &StateSpaceRequest,
        wanted: &[Wanted],
    ) -> Result<StateSpace, ProblemError> {
        let (reduced, residual_vectors, error_estimate) =
            self.nearest(request.residual_vectors, wanted, &mut solution.warnings)?;
        let Reduced { readings, shares, feedthrough } = reduced;
        let (n, unit) = (self.basis.vectors.len(), self.vibration.unit);
        // q of 1 m·√kg moves by this much of a vector that is one in M.
        let size = 1.0 / (self.vibration.length * self.vibration.mass.sqrt());
        let squares: Vec<f64> = self.basis.squares.iter().map(|square| square * unit).collect();
        let drag = self.drag(&squares, request.damping_ratio);
        let mut a = vec![vec![0.0; 2 * n]; 2 * n];
        for i in 0..n {
            a[i][n + i] = 1.0;
            a[n + i][i] = -squares[i];
            (0..n).for_each(|j| a[n + i][n + j] = -drag[(i, j)]);
        }
        let mut b = vec![vec![0.0; self.drives.len()]; 2 * n];
        for (u, shares) in shares.iter().enumerate() {
            for (i, share) in shares.iter().enumerate() {
                b[n + i][u] = share * unit / size;
            }
        }
        let mut c = Vec::with_capacity(wanted.len());
        let mut d = Vec::with_capacity(wanted.len());
        for (k, output) in wanted.iter().enumerate() {
            let shape: Vec<f64> = readings.iter().map(|reading| size * reading[k]).collect();
            let weighed = |rows: &[Vec<f64>], column: usize| -> f64 {
                shape.iter().zip(rows).map(|(shape, row)| shape * row[column]).sum()
            };
            let still = vec![0.0; n];
            let (row, through): (Vec<f64>, Vec<f64>) = match output.measure {
                Measure::Change => {
                    ([shape.clone(), still].concat(), feedthrough.iter().map(|rest| rest[k]).collect())
                }
                Measure::Velocity => ([still, shape.clone()].concat(), vec![0.0; self.drives.len()]),
                Measure::Acceleration => (
                    (0..2 * n).map(|j| weighed(&a[n..], j)).collect(),
                    (0..self.drives.len()).map(|u| weighed(&b[n..], u)).collect(),
                ),
            };
            c.push(row);
            d.push(through);
        }
        Ok(StateSpace {
            solution,
            inputs: self.inputs.iter().map(|input| input.signal.clone()).collect(),
            outputs: wanted.iter().map(|output| output.signal.clone()).collect(),
            squares,
            modes: self.basis.modes,
            residual_vectors,
            a,
            b,
            c,
            d,
            error_estimate,
        })
    }

    /// Φᵀ (D + G) Φ of the rates, 1/s, with 2 ζ ω on its diagonal besides.
    fn drag(&self, squares: &[f64], ratio: f64) -> DMatrix<f64> {
        let n = squares.len();
        let mut drag = DMatrix::zeros(n, n);
        let entries: Vec<_> =
            self.vibration.damping.iter().chain(&self.vibration.gyroscopic).copied().collect();
        if !entries.is_empty() {
            let moved: Vec<Vec<f64>> =
                self.basis.vectors.iter().map(|x| Self::product(&entries, x)).collect();
            let rate = self.vibration.unit.sqrt();
            drag = DMatrix::from_fn(n, n, |i, j| rate * dot(&self.basis.vectors[i], &moved[j]));
        }
        for (i, square) in squares.iter().enumerate() {
            drag[(i, i)] += 2.0 * ratio * square.max(0.0).sqrt();
        }
        drag
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
