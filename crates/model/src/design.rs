//! Design optimisation: parameters that make an objective least or greatest, and what must hold meanwhile.

use crate::{Output, TraceStudy};

/// What a study of the kind `optimise` does.
#[derive(Clone, Debug, PartialEq)]
pub struct OptimiseStudy {
    /// What is made least or greatest.
    pub objective: Reading,
    /// Is it made greatest?
    pub maximise: bool,
    /// The parameters that may change.
    pub vary: Vec<Varied>,
    /// What must hold at the optimum.
    pub conditions: Vec<Condition>,
    /// Is a design refused whose equilibrium is unstable?
    pub stable: bool,
    /// From how many designs the search begins; the first is the guess, the others fill the ranges evenly.
    pub starts: usize,
    /// Which of the random numbers are drawn.
    pub seed: u64,
    /// How is searched.
    pub method: Optimiser,
    /// A second objective, and how many points of the front between the two are wanted.
    pub front: Option<Front>,
    /// Largest step and violation at the end, relative to the ranges and to the sizes of what is bounded.
    pub tolerance: f64,
    /// Most steps of one search.
    pub most_iterations: usize,
}

/// A parameter that may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Varied {
    /// Position in [`crate::Model::parameters`].
    pub parameter: usize,
    /// Its bounds, SI, the smaller one first.
    pub range: [f64; 2],
    /// Where the first search begins, SI.
    pub guess: f64,
}

/// A number that is read off a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What is read; it has one formula, in which parameters stay open. Its name is the text of the file.
    pub output: Output,
    /// Of which equilibrium.
    pub at: Where,
}

/// Of which equilibrium of a design something is read.
#[derive(Clone, Debug, PartialEq)]
pub enum Where {
    /// Of that which a solve reaches.
    Equilibrium,
    /// Of a point of the path that a study of the kind `trace` follows.
    Path {
        /// Name of the study.
        study: String,
        /// What it asks.
        trace: Box<TraceStudy>,
        /// Which point.
        point: Wanted,
    },
}

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Where the number is greatest, between the points of the path too.
    Greatest,
    /// Where it is least.
    Least,
    /// The n-th fold, counted from 1.
    Fold(usize),
}

/// What must hold of a number; at least one of the three is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// The number.
    pub reading: Reading,
    /// It must not be less, SI.
    pub least: Option<f64>,
    /// It must not be more, SI.
    pub most: Option<f64>,
    /// It must be this, SI.
    pub equals: Option<f64>,
}

/// The compromises between two objectives.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    /// The second objective.
    pub other: Reading,
    /// Is it to be greatest?
    pub maximise: bool,
    /// How many points, both ends included.
    pub points: usize,
}

/// A way of searching.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Optimiser {
    /// Sequential quadratic programming, by derivatives.
    #[default]
    Sqp,
    /// The evolution strategy with an adapted covariance, without derivatives; what it finds is made exact by the other.
    CmaEs,
}

impl Optimiser {
    /// The word that stands in the model file.
    pub fn word(self) -> &'static str {
        match self {
            Optimiser::Sqp => "sqp",
            Optimiser::CmaEs => "cma_es",
        }
    }
}

impl Wanted {
    /// How the model file writes it.
    pub fn text(self) -> String {
        match self {
            Wanted::Greatest => "greatest".to_string(),
            Wanted::Least => "least".to_string(),
            Wanted::Fold(number) => format!("fold {number}"),
        }
    }
}

impl OptimiseStudy {
    /// All that is read off a design: the objective, then the conditions, then the second objective.
    pub fn readings(&self) -> impl Iterator<Item = &Reading> {
        let other = self.front.iter().map(|front| &front.other);
        std::iter::once(&self.objective).chain(self.conditions.iter().map(|c| &c.reading)).chain(other)
    }
}

impl Default for OptimiseStudy {
    fn default() -> Self {
        let output =
            Output { name: String::new(), unit: String::new(), formulas: Vec::new(), probes: Vec::new() };
        Self {
            objective: Reading { output, at: Where::Equilibrium },
            maximise: false,
            vary: Vec::new(),
            conditions: Vec::new(),
            stable: false,
            starts: 1,
            seed: 0,
            method: Optimiser::Sqp,
            front: None,
            tolerance: 1e-8,
            most_iterations: 200,
        }
    }
}
