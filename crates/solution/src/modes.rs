//! What a study of vibration returns.

use crate::{Direction, Solution, Trace};
use std::f64::consts::TAU;

/// Small vibrations about one state.
#[derive(Clone, Debug)]
pub struct Modes {
    /// The state, its status and warnings.
    pub solution: Solution,
    /// Is it the state at rest, without any load?
    pub at_rest: bool,
    /// The modes, lowest first; motions without stiffness among them.
    pub modes: Vec<Mode>,
    /// What takes part in shifts along x, y and z: kg.
    pub mass: [f64; 3],
    /// The same in turnings about x, y and z through the centre of that mass: kg·m².
    pub inertia: [f64; 3],
    /// Elements that beams were cut into, and their order.
    pub elements: [usize; 2],
}

impl Modes {
    /// How many modes grow.
    pub fn unstable(&self) -> usize {
        self.modes.iter().filter(|mode| mode.growth > 0.0).count()
    }
}

/// Frequencies along a path of equilibria.
#[derive(Clone, Debug)]
pub struct ModesAlong {
    /// The path.
    pub trace: Trace,
    /// For each branch, for each of its points, the modes in the order in which they were met on the branch, each followed by its
    /// shape; None where one is not among the lowest any more. Empty where the point is critical.
    pub followed: Vec<Vec<Vec<Option<Followed>>>>,
    /// For each branch where along it the number of modes that grow changes, in order.
    pub onsets: Vec<Vec<Onset>>,
}

/// Where modes begin to grow along a path, or end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onset {
    /// Value of the parameter.
    pub parameter: f64,
    /// How what grows there grows.
    pub kind: OnsetKind,
    /// Along the branch: do more grow beyond, or fewer?
    pub begins: bool,
    /// Circular frequency there, rad/s; zero of a divergence.
    pub rate: f64,
    /// Estimated relative error of the value.
    pub error_estimate: f64,
}

/// How modes begin to grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnsetKind {
    /// Swinging: two frequencies meet, or what damps a mode begins to drive it.
    Flutter,
    /// Without swinging: a frequency has come down to nothing.
    Divergence,
}

impl OnsetKind {
    /// The word that stands in the result document.
    pub fn word(self) -> &'static str {
        match self {
            OnsetKind::Flutter => "flutter",
            OnsetKind::Divergence => "divergence",
        }
    }
}

/// One mode at a point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    /// 1/s; positive where it grows.
    pub growth: f64,
    /// Circular frequency, rad/s.
    pub rate: f64,
    /// What it does.
    pub kind: ModeKind,
    /// Estimated relative error of growth and rate together.
    pub error_estimate: f64,
}

/// What a mode does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeKind {
    /// It moves without stiffness.
    Rigid,
    /// It swings for ever.
    Swinging,
    /// It grows without swinging.
    Diverging,
    /// It swings more and more.
    Flutter,
    /// It swings and dies away: it is damped, or flutters backwards in time.
    Decaying,
    /// It comes back without swinging.
    Creeping,
}

impl ModeKind {
    /// The word that stands in the result document.
    pub fn word(self) -> &'static str {
        match self {
            ModeKind::Rigid => "rigid",
            ModeKind::Swinging => "swinging",
            ModeKind::Diverging => "diverging",
            ModeKind::Flutter => "flutter",
            ModeKind::Decaying => "decaying",
            ModeKind::Creeping => "creeping",
        }
    }
}

/// One natural mode: it moves like exp((growth ± i rate) t).
#[derive(Clone, Debug)]
pub struct Mode {
    /// 1/s; positive where it grows.
    pub growth: f64,
    /// Circular frequency, rad/s.
    pub rate: f64,
    /// What it does.
    pub kind: ModeKind,
    /// Estimated relative error of growth and rate together.
    pub error_estimate: f64,
    /// ζ, where something damps: the part of |s| by which it dies away, 1 of what creeps, negative of what grows.
    pub damping_ratio: Option<f64>,
    /// Mass that moves with the shape's largest displacement, kg; kg·m² of its largest turning where nothing is displaced.
    pub generalised_mass: f64,
    /// Shares in motions of the ground, where there is an energy.
    pub shares: Option<Shares>,
    /// The shape.
    pub direction: Direction,
    /// Of a mode whose parts do not swing together: the shape a quarter of a period later.
    pub quadrature: Option<Direction>,
    /// For each beam places at which the shape passes through its rest position, m; none for beams that stand still.
    pub nodes: Vec<Vec<f64>>,
}

/// A mode's shares in motions of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Factors Γ by which shifts of the ground along x, y and z drive the mode, and turnings about x, y and z through the centre of
    /// mass: the shape's share in such a motion.
    pub participation: [f64; 6],
    /// Γ² times the generalised mass: kg three times, then kg·m².
    pub effective: [f64; 6],
}

impl Mode {
    /// ω², rad²/s², of a mode that only swings or only grows.
    pub fn square(&self) -> f64 {
        self.rate * self.rate - self.growth * self.growth
    }

    /// Frequency, Hz; None of a mode that does not swing.
    pub fn frequency(&self) -> Option<f64> {
        (!matches!(self.kind, ModeKind::Diverging | ModeKind::Creeping)).then_some(self.rate / TAU)
    }

    /// Is it a motion without stiffness?
    pub fn is_rigid(&self) -> bool {
        self.kind == ModeKind::Rigid
    }
}
