//! What is to be done with a mechanism: the studies that stand in its file.

use crate::{FitStudy, FormulaStudy, InverseDynamicsStudy, OptimiseStudy, Target};

/// A named study.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Its name, unique among studies.
    pub name: String,
    /// What is done.
    pub kind: StudyKind,
}

/// Kinds of studies.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "a model has a handful of studies")]
pub enum StudyKind {
    /// The equilibrium, forward or inverse.
    Solve,
    /// A path of equilibria.
    Trace(TraceStudy),
    /// Critical loads and shapes of the linearised problem.
    Buckle(BuckleStudy),
    /// Natural frequencies and shapes.
    Modes(ModesStudy),
    /// Velocities, accelerations and forces of a motion in time.
    InverseDynamics(InverseDynamicsStudy),
    /// Parameters from measurements.
    Fit(FitStudy),
    /// A formula that repeats an output.
    Formula(FormulaStudy),
    /// Parameters that make an objective least or greatest under constraints.
    Optimise(OptimiseStudy),
}

impl StudyKind {
    /// The word that stands in the model file.
    pub fn word(&self) -> &'static str {
        match self {
            StudyKind::Solve => "solve",
            StudyKind::Trace(_) => "trace",
            StudyKind::Buckle(_) => "buckle",
            StudyKind::Modes(_) => "modes",
            StudyKind::InverseDynamics(_) => "inverse_dynamics",
            StudyKind::Fit(_) => "fit",
            StudyKind::Formula(_) => "formula",
            StudyKind::Optimise(_) => "optimise",
        }
    }
}

/// A path of equilibria as one parameter changes.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceStudy {
    /// Position in [`crate::Model::parameters`].
    pub parameter: usize,
    /// Values between which the path is followed, SI; the first may be the larger.
    pub range: [f64; 2],
    /// Where it starts, SI: from rest under the loads of this value. The first end of the range, or a value inside it, from
    /// which both directions are followed.
    pub start: f64,
    /// About how many points a path that goes straight from one end of the range to the other has, at least.
    pub steps: usize,
    /// Most points of one branch.
    pub most_points: usize,
    /// Most branches that are followed besides the first: those met at branch points, and what they meet.
    pub branches: usize,
    /// Points to be found: where an output has a value.
    pub events: Vec<Target>,
    /// Where a branch ends besides the ends of the range.
    pub stops: Vec<Stop>,
    /// Random pushes by which branches that hang together with no other are looked for, at both ends of the range.
    pub guesses: usize,
    /// A parameter that breaks a symmetry, and the value (SI) from which it is led to its own.
    pub imperfection: Option<(usize, f64)>,
    /// A critical point to be followed as a second parameter changes.
    pub critical: Option<CriticalStudy>,
}

/// Where a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// Where an output has a value.
    Value(Target),
    /// At the n-th fold, counted from 1.
    Fold(usize),
    /// At the n-th branch point.
    Branch(usize),
    /// At the n-th point of any kind that is not regular, user events among them.
    Event(usize),
}

/// A fold or branch point followed in two parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalStudy {
    /// The second parameter: position in [`crate::Model::parameters`].
    pub parameter: usize,
    /// Values between which it changes, SI; the path starts at the value that the model has.
    pub range: [f64; 2],
    /// Which fold or branch point of all branches found, in their order, counted from 1.
    pub number: usize,
}

/// Critical loads about an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuckleStudy {
    /// Position in [`crate::Model::parameters`]; None for all loads and drives in proportion.
    pub parameter: Option<usize>,
    /// Value (SI), or load fraction, of the equilibrium about which the problem is linearised.
    pub at: f64,
    /// How many critical values, those nearest to `at` first.
    pub count: usize,
}

/// Natural frequencies and shapes of small vibrations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModesStudy {
    /// How many, the lowest first; motions without stiffness come before them and are not counted.
    pub count: usize,
    /// About the state at rest, without any load, instead of about the equilibrium.
    pub at_rest: bool,
    /// Over the path of equilibria as a parameter changes, instead of about one of them.
    pub path: Option<ModesPath>,
}

/// The path along which frequencies are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModesPath {
    /// Position in [`crate::Model::parameters`].
    pub parameter: usize,
    /// Values between which the path is followed, SI; the first may be the larger.
    pub range: [f64; 2],
    /// About how many points it has, at least.
    pub steps: usize,
}

impl Default for ModesStudy {
    fn default() -> Self {
        Self { count: 6, at_rest: false, path: None }
    }
}

impl Default for TraceStudy {
    fn default() -> Self {
        Self {
            parameter: 0,
            range: [0.0, 1.0],
            start: 0.0,
            steps: 40,
            most_points: 2000,
            branches: 0,
            events: Vec::new(),
            stops: Vec::new(),
            guesses: 0,
            imperfection: None,
            critical: None,
        }
    }
}
