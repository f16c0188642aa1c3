//! What a fit to measurements returns, and what a formula that repeats an output does.

use crate::Status;

/// Parameters found from measurements.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Converged at a minimum of the residuals.
    pub status: Status,
    /// Why it did not converge.
    pub reason: Option<String>,
    /// What to know though it went well.
    pub warnings: Vec<String>,
    /// Estimates: those that are the same for all specimens, then those of each specimen.
    pub estimates: Vec<Estimate>,
    /// Correlations between estimates; None of one that the data do not determine.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// Combinations of estimates that the data do not see.
    pub unseen: Vec<Unseen>,
    /// Parallel to the rows of the measurements.
    pub rows: Vec<FittedRow>,
    /// Rows that could not be used: position, and why.
    pub left_out: Vec<(usize, String)>,
    /// Parallel to the specimens of the measurements.
    pub specimens: Vec<SpecimenFit>,
    /// Means over specimens of what each of them has its own value of.
    pub spread: Vec<Spread>,
    /// Parallel to the measured outputs.
    pub measured: Vec<MeasuredFit>,
    /// Standard deviation of the residuals, as the estimates leave it: SI, or in standard deviations of the noise where that is given.
    pub scatter: f64,
    /// Is the scatter in standard deviations of a given noise?
    pub is_relative: bool,
    /// Measured values less estimates.
    pub freedom: usize,
    /// What it took.
    pub work: FitWork,
}

/// A parameter that was found.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Position in the model's parameters.
    pub parameter: usize,
    /// Of which specimen; None: of all.
    pub specimen: Option<usize>,
    /// Where the search began, SI.
    pub guess: f64,
    /// What was found, SI.
    pub value: f64,
    /// Its standard error, SI; None where the data do not determine it.
    pub standard_error: Option<f64>,
    /// Its confidence interval by the linearised problem, SI.
    pub interval: Option<[f64; 2]>,
    /// The same by profile likelihood, where it was asked for; None of an end that lies beyond the bounds or all measure.
    pub profile: Option<[Option<f64>; 2]>,
    /// Does it stand at one of its bounds?
    pub is_at_bound: bool,
}

/// Changes of estimates that together change nothing that was measured.
#[derive(Clone, Debug)]
pub struct Unseen {
    /// Position of an estimate and its change, relative to its value (or to one unit where that is zero); the largest is 1.
    pub parts: Vec<(usize, f64)>,
    /// How far it may go within the confidence, relative; None: without end.
    pub reach: Option<f64>,
}

/// One row of the measurements beside what the model says.
#[derive(Clone, Debug)]
pub struct FittedRow {
    /// What the model says of each measured output, SI; empty of a row that was left out.
    pub computed: Vec<Option<f64>>,
    /// How much each value counts beside least squares: less than 1 where the loss takes it for an outlier.
    pub weights: Vec<f64>,
}

/// How a specimen agrees with the others.
#[derive(Clone, Debug)]
pub struct SpecimenFit {
    /// Its measured values.
    pub values: usize,
    /// Root mean square of its residuals, as [`Fit::scatter`].
    pub scatter: f64,
    /// How far it is from what the others predict, beside how far it may be at the confidence asked for: more than 1 is outside.
    /// None where the others predict nothing.
    pub distance: Option<f64>,
    /// Was it left out for that?
    pub is_rejected: bool,
}

/// Values over specimens.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    /// Position in the model's parameters.
    pub parameter: usize,
    /// Mean over the specimens that count, SI.
    pub mean: f64,
    /// Standard deviation over them, SI; zero of one.
    pub deviation: f64,
    /// How many count.
    pub count: usize,
}

/// How well a measured output is met.
#[derive(Clone, Copy, Debug)]
pub struct MeasuredFit {
    /// Values that count.
    pub count: usize,
    /// Root mean square of its residuals, SI.
    pub deviation: f64,
    /// Largest residual, SI, and its row.
    pub largest: (f64, usize),
    /// 1 - Σ residual²/Σ (measured - mean)²; None where nothing varies.
    pub r_squared: Option<f64>,
}

/// Counts of work.
#[derive(Clone, Copy, Debug, Default)]
pub struct FitWork {
    /// Steps of the search.
    pub iterations: usize,
    /// Equilibria that were found.
    pub solves: usize,
    /// Equilibria whose derivatives were worked out.
    pub derivatives: usize,
}

/// A formula that repeats an output.
#[derive(Clone, Debug)]
pub struct ResponseFormula {
    /// Converged where it was fitted to all that was asked for.
    pub status: Status,
    /// Why not.
    pub reason: Option<String>,
    /// What to know though it went well.
    pub warnings: Vec<String>,
    /// One after another.
    pub pieces: Vec<ResponsePiece>,
    /// What was met: variables, the model's value and the formula's, in the units of the study.
    pub points: Vec<ResponsePoint>,
    /// Where the model gave nothing: what was asked, and why.
    pub left_out: Vec<(String, String)>,
    /// 1 - Σ error²/Σ (value - mean)² over all points, as they count; None where nothing varies.
    pub r_squared: Option<f64>,
    /// Root mean square error, as they count.
    pub deviation: f64,
    /// Largest error, and the position of its point.
    pub largest: (f64, usize),
}

/// One piece of a formula.
#[derive(Clone, Debug)]
pub struct ResponsePiece {
    /// Where it begins and ends along the first variable, in its unit.
    pub range: [f64; 2],
    /// Coefficients of its terms, in the units of the study.
    pub coefficients: Vec<f64>,
    /// Points in it.
    pub count: usize,
    /// As of the whole formula.
    pub r_squared: Option<f64>,
    /// Largest error.
    pub largest: f64,
}

/// A point of a formula.
#[derive(Clone, Debug)]
pub struct ResponsePoint {
    /// What goes in.
    pub variables: Vec<f64>,
    /// What the model says.
    pub value: f64,
    /// What the formula says.
    pub formula: f64,
    /// How much it counts: the part of the range that it stands for, along a trace.
    pub weight: f64,
}
