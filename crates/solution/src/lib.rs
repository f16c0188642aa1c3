//! What a solve returns. Outputs read this and never a solver.
//!
//! Lists run parallel to the model's lists: `beams[i]` belongs to `model.beams[i]`. SI units, global axes
//! unless said otherwise. `F` and `M` act, by the part beyond s, on the part before s.

mod contact;
mod design;
mod fit;
mod modes;
mod motion;
mod space;
mod trace;
mod warnings;
mod words;

pub use contact::ContactSolution;
pub use design::{Active, Bound, Design, DesignWork, LeftOut, Optimisation, StartEnd, Step};
pub use fit::{
    Estimate, Fit, FitWork, FittedRow, MeasuredFit, ResponseFormula, ResponsePiece, ResponsePoint,
    SpecimenFit, Spread, Unseen,
};
pub use modes::{Followed, Mode, ModeKind, Modes, ModesAlong, Onset, OnsetKind, Shares};
pub use motion::{BodyMotion, Instant, InverseDynamics, JointMotion, MotionWork, Rates};
pub use space::{Signal, StateSpace};
pub use trace::{
    Branch, BranchEnd, BranchOrigin, Buckling, BucklingMode, CriticalCurve, Crossing, Direction, PointKind,
    Trace, TracePoint, TraceWork,
};
pub use warnings::summed_up;

use flexura_model::ProbeTarget;
use flexura_spatial::{Matrix6, Pose, Twist, Vector3, Wrench};

/// How a study ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// An equilibrium to the wanted tolerance.
    Converged,
    /// Load stepping came to a halt before the full load: a fold, usually.
    Stalled,
    /// The work limit was reached first.
    IterationLimit,
    /// The tangent has no inverse where the study stands.
    Singular,
    /// A loop that closed at rest does not close under load.
    Inconsistent,
    /// The wanted accuracy lies below what double precision gives here.
    AccuracyLimit,
    /// Somebody asked for the end before it was reached.
    Interrupted,
    /// No design was found that meets all that is asked.
    Infeasible,
}

impl Status {
    /// The word that stands in the result document.
    pub fn word(self) -> &'static str {
        match self {
            Status::Converged => "converged",
            Status::Stalled => "stalled",
            Status::IterationLimit => "iteration_limit",
            Status::Singular => "singular",
            Status::Inconsistent => "inconsistent",
            Status::AccuracyLimit => "accuracy_limit",
            Status::Interrupted => "interrupted",
            Status::Infeasible => "infeasible",
        }
    }
}

/// How much work a study was; counts, so that they repeat exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Newton steps, full and simplified.
    pub newton_steps: usize,
    /// Tangents factorised.
    pub factorisations: usize,
    /// Residuals evaluated without a tangent.
    pub residuals: usize,
    /// Load steps taken, 1 when the full load was reached at once.
    pub load_steps: usize,
    /// Load steps tried and given up.
    pub rejected_steps: usize,
    /// Integration steps of the final mesh, over all beams.
    pub integration_steps: usize,
    /// Shooting segments of the final mesh, over all beams.
    pub segments: usize,
}

/// One equilibrium, or how far the way to it went.
#[derive(Clone, Debug)]
pub struct Solution {
    /// How it ended.
    pub status: Status,
    /// Why, and what to try, when it did not converge.
    pub reason: Option<String>,
    /// Fraction of the full load that was reached; 1 when converged.
    pub load_fraction: f64,
    /// Largest scaled residual of the equilibrium equations.
    pub residual: f64,
    /// Estimated largest error of poses and wrenches, relative to L, 1, EI/L², EI/L.
    pub error_estimate: f64,
    /// Things a user should know though the solve went well.
    pub warnings: Vec<String>,
    /// Work counters.
    pub work: Work,
    /// One for each beam.
    pub beams: Vec<BeamSolution>,
    /// One for each body.
    pub bodies: Vec<Pose>,
    /// One for each joint.
    pub joints: Vec<JointSolution>,
    /// One for each spring.
    pub springs: Vec<SpringSolution>,
    /// One for each coupling: λ, so that its effort on a coordinate is factor × λ.
    pub couplings: Vec<f64>,
    /// One for each cable.
    pub cables: Vec<CableSolution>,
    /// One for each set of concentric tubes.
    pub tubes: Vec<TubesSolution>,
    /// Small motions and compliances of what an output or the caller asked for.
    pub tangents: Vec<TangentSolution>,
    /// Of every output by every parameter, if asked for.
    pub sensitivities: Option<Sensitivities>,
    /// The parameters that were solved for: position in the model's parameters, value (SI).
    pub found: Vec<(usize, f64)>,
    /// How it moves in time; None of an equilibrium.
    pub rates: Option<Box<Rates>>,
    /// Strain energy of beams and springs, J.
    pub energy: f64,
    /// Is it a stable equilibrium? None where that is not decided.
    pub stable: Option<bool>,
    /// Number of unstable directions. None where that is not decided.
    pub unstable_directions: Option<usize>,
    /// Why stability is not decided.
    pub stability_reason: Option<String>,
}

/// A beam's state at its samples.
#[derive(Clone, Debug, Default)]
pub struct BeamSolution {
    /// Samples, from 0 to the beam's length, increasing; every place that an output asks for is one.
    pub samples: Vec<BeamSample>,
    /// Length L of the undeformed axis, m.
    pub length: f64,
    /// Force of its elastic foundation on all of it, global, N; zero without one.
    pub foundation_force: Vector3<f64>,
}

/// The state of a beam at one place.
#[derive(Clone, Copy, Debug)]
pub struct BeamSample {
    /// Undeformed arc length, m.
    pub s: f64,
    /// Pose of the section in the global frame, deformed.
    pub pose: Pose,
    /// Pose of the section in the global frame before anything was loaded.
    pub rest_pose: Pose,
    /// Internal force (N, global) and moment (N·m, global) of the beam itself at the section's axis. What tendons in its
    /// channels carry is not part of it: where one is anchored, its pull is a load on the beam.
    pub wrench: Wrench,
    /// k1, k2, k3 of the deformed beam, 1/m.
    pub curvature: Vector3<f64>,
    /// k1, k2, k3 of the rest shape, 1/m.
    pub rest_curvature: Vector3<f64>,
    /// ε, γ2, γ3.
    pub strain: Vector3<f64>,
    /// Force of an elastic foundation per undeformed length, global, N/m; zero without one.
    pub foundation: Vector3<f64>,
}

/// A joint's state.
#[derive(Clone, Debug)]
pub struct JointSolution {
    /// Coordinates, m and rad.
    pub coordinates: Vec<f64>,
    /// Efforts along the coordinates, N and N·m.
    pub efforts: Vec<f64>,
    /// What the parent exerts on the child, at M's origin, in global axes.
    pub wrench: Wrench,
    /// Of a rolling or contact joint.
    pub contact: Option<ContactSolution>,
}

/// A spring's state.
#[derive(Clone, Debug, Default)]
pub struct SpringSolution {
    /// Its two ends, global, m.
    pub ends: [Vector3<f64>; 2],
    /// Length along its course, m.
    pub length: f64,
    /// Tension, N.
    pub tension: f64,
    /// Stretch per rest length. None where that is zero.
    pub strain: Option<f64>,
    /// Tension per present area, Pa. None where the law knows no area.
    pub stress: Option<f64>,
    /// Too long to carry anything?
    pub is_slack: bool,
    /// Where it touches what it runs over: its course from end to end, global, m; else empty.
    pub course: Vec<Vector3<f64>>,
}

/// A cable's state.
#[derive(Clone, Debug)]
pub struct CableSolution {
    /// Its course, global, m; channels are sampled.
    pub course: Vec<Vector3<f64>>,
    /// Length from anchor to anchor, m.
    pub length: f64,
    /// Tension, N.
    pub tension: f64,
}

/// Concentric tubes along their common axis, from where they leave the guide to the tip of the first.
#[derive(Clone, Debug, Default)]
pub struct TubesSolution {
    /// Samples, s increasing.
    pub samples: Vec<TubesSample>,
}

/// The common axis at one place.
#[derive(Clone, Debug)]
pub struct TubesSample {
    /// Arc length from where the tubes leave the guide, m.
    pub s: f64,
    /// Pose of the first tube's section, global.
    pub pose: Pose,
    /// Force and moment that all tubes carry together, on the part before s, global.
    pub wrench: Wrench,
    /// k1, k2, k3 of the first tube, 1/m.
    pub curvature: Vector3<f64>,
    /// Turn of each tube that is there relative to the first: its number and angle, rad.
    pub angles: Vec<(usize, f64)>,
    /// Torque that each tube that is there carries about the axis: its number and N·m.
    pub torques: Vec<(usize, f64)>,
}

/// How one body or station moves when the equilibrium is disturbed a little.
#[derive(Clone, Copy, Debug)]
pub struct TangentSolution {
    /// Of what: a body or a place on a beam.
    pub target: ProbeTarget,
    /// Motion (x, y, z, rx, ry, rz) of its origin per dead load (fx, .. mz) there, global axes: m/N, rad/N, m/(N·m),
    /// rad/(N·m). None where only the motion was asked for.
    pub compliance: Option<Matrix6<f64>>,
    /// Motion of its origin (m) and turning (rad) per unit of the load fraction, all loads and drives growing in
    /// proportion.
    pub motion: Twist,
}

/// Derivatives of outputs with respect to parameters.
#[derive(Clone, Debug, Default)]
pub struct Sensitivities {
    /// Positions in the model's parameters.
    pub parameters: Vec<usize>,
    /// For each output of the model, for each of its components, for each of these parameters: d output / d
    /// parameter, SI; None where the output has no value, here or next to it.
    pub outputs: Vec<Vec<Vec<Option<f64>>>>,
    /// Of an inverse problem: for each unknown parameter, for each of these (given) parameters, d unknown / d given while
    /// the targets are kept.
    pub unknowns: Vec<Vec<f64>>,
    /// Parameters that are left out because mechanisms next to this one make no sense, with the reason.
    pub left_out: Vec<(usize, String)>,
    /// For each body, for each of these parameters: motion of its origin and turning per unit.
    pub bodies: Vec<Vec<Twist>>,
}
