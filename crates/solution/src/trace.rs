//! What a path of equilibria and a buckling study return.

use crate::{Solution, Status};
use flexura_spatial::Twist;

/// A path of equilibria in one parameter, or several that hang together.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Position of the parameter in the model's parameters.
    pub parameter: usize,
    /// Values between which it was followed, SI.
    pub range: [f64; 2],
    /// Converged where every branch ended as was asked for.
    pub status: Status,
    /// Why not, and what to try.
    pub reason: Option<String>,
    /// Things a user should know though all went well.
    pub warnings: Vec<String>,
    /// Why stability is nowhere decided; None where it is.
    pub stability_reason: Option<String>,
    /// The branches, the one that starts at rest first.
    pub branches: Vec<Branch>,
    /// Followed critical points.
    pub critical: Option<CriticalCurve>,
    /// Work counters.
    pub work: TraceWork,
}

/// How much work a trace was; counts, so that they repeat exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TraceWork {
    /// Points on all branches.
    pub points: usize,
    /// Steps tried and given up.
    pub refused: usize,
    /// Newton steps, full and simplified.
    pub newton_steps: usize,
    /// Tangents factorised.
    pub factorisations: usize,
    /// Residuals evaluated without a tangent.
    pub residuals: usize,
    /// Inertias counted.
    pub inertias: usize,
}

/// A smooth curve of equilibria.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Where it comes from.
    pub origin: BranchOrigin,
    /// Its points in order.
    pub points: Vec<TracePoint>,
    /// Why it ends where it does, at its first and at its last point.
    pub ends: [BranchEnd; 2],
}

/// Where a branch comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BranchOrigin {
    /// The equilibrium reached from rest.
    Rest,
    /// A branch point of another branch.
    Switched {
        /// Number of the other branch.
        branch: usize,
        /// Number of its point.
        point: usize,
    },
    /// An equilibrium found by random pushes and deflation.
    Search,
    /// An imperfection that was led away.
    Imperfection,
}

/// Why a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub enum BranchEnd {
    /// The end of the range.
    Range,
    /// A stop that was asked for.
    Stop,
    /// It has come back to its first point.
    Closed,
    /// It starts here.
    Start,
    /// The most points that were allowed.
    PointLimit,
    /// It cannot be followed further, and why.
    Stalled(String),
    /// Somebody asked for the end.
    Interrupted,
}

/// One equilibrium of a path.
#[derive(Clone, Debug)]
pub struct TracePoint {
    /// Value of the parameter, SI.
    pub parameter: f64,
    /// Way along the branch in the measure of the path's steps, from its first point.
    pub arc: f64,
    /// What is special about it.
    pub kind: PointKind,
    /// For each output its components (one or three), SI; None where it has no value.
    pub outputs: Vec<Option<Vec<f64>>>,
    /// Outputs without a value, by their positions, and why.
    pub output_reasons: Vec<(usize, String)>,
    /// Estimated largest error of poses and wrenches, relative to L, 1, EI/L², EI/L.
    pub error_estimate: f64,
    /// Is it a stable equilibrium? None where that is not decided, as at a fold or branch point itself.
    pub stable: Option<bool>,
    /// Number of unstable directions. None where that is not decided.
    pub unstable_directions: Option<usize>,
    /// The whole state, at ends and special points, and at some others along the way.
    pub solution: Option<Box<Solution>>,
    /// At other points, where shapes were asked for: the state with fewer samples, without derivatives.
    pub shape: Option<Box<Solution>>,
    /// At folds and branch points: the directions in which the mechanism gives way without resistance.
    pub directions: Vec<Direction>,
}

/// What is special about a point.
#[derive(Clone, Debug, PartialEq)]
pub enum PointKind {
    /// Nothing.
    Regular,
    /// A fold (limit point): the parameter turns back.
    Fold,
    /// Branches cross here.
    Branch(Crossing),
    /// Something that was asked for: position in the study's events.
    Event(usize),
    /// The first or last point of its branch.
    End,
}

/// How branches cross.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// A symmetric branch crosses; the shapes appear as the parameter leaves the branch that loses its stability.
    SupercriticalPitchfork,
    /// The same, but they exist before the crossing: the mechanism snaps.
    SubcriticalPitchfork,
    /// A pitchfork of which neither can be said.
    Pitchfork,
    /// Two branches cross, neither of which turns back.
    Transcritical,
    /// Several directions give way at once, of which this many.
    Multiple(usize),
}

/// A small motion: of every sample of every beam, and of every body. The largest displacement is one metre, or the
/// largest turning one radian where nothing is displaced.
#[derive(Clone, Debug, Default)]
pub struct Direction {
    /// Runs parallel to the samples of the point's solution.
    pub beams: Vec<Vec<Twist>>,
    /// One for each body.
    pub bodies: Vec<Twist>,
}

/// A critical point followed in a second parameter.
#[derive(Clone, Debug)]
pub struct CriticalCurve {
    /// Position of the second parameter.
    pub parameter: usize,
    /// Fold or branch point that it starts from.
    pub kind: PointKind,
    /// Its points: the critical value stands in `point.parameter`, the second parameter's beside it.
    pub points: Vec<(f64, TracePoint)>,
    /// Why it ends where it does, at its first and last point.
    pub ends: [BranchEnd; 2],
}

/// Critical loads of the problem linearised about an equilibrium.
#[derive(Clone, Debug)]
pub struct Buckling {
    /// Position of the parameter; None for all loads and drives in proportion.
    pub parameter: Option<usize>,
    /// Its value (SI), or the load fraction, at the equilibrium.
    pub at: f64,
    /// The equilibrium, its status and warnings.
    pub solution: Solution,
    /// The critical values, nearest first.
    pub modes: Vec<BucklingMode>,
}

/// One critical load.
#[derive(Clone, Debug)]
pub struct BucklingMode {
    /// Value of the parameter (SI), or load fraction.
    pub value: f64,
    /// Estimated error of the value.
    pub error_estimate: f64,
    /// How the mechanism gives way.
    pub direction: Direction,
}
