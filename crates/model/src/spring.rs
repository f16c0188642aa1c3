//! Springs and ligaments: laws, and what they run over.

use crate::{Attachment, Frame};
use flexura_spatial::Vector3;

/// A spring between two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Its name, unique among springs.
    pub name: String,
    /// One end.
    pub from: Attachment,
    /// The other end.
    pub to: Attachment,
    /// Its law, at size 1.
    pub law: SpringLaw,
    /// ℓ0 at size 1, m. None: the initial length, so that it starts relaxed.
    pub rest_length: Option<f64>,
    /// Size s of what the law was found on: a given rest length and elongations count s times, areas and forces s² times,
    /// and so stiffnesses (force per length) s times.
    pub size: f64,
    /// Tension against the rate of its length while it is not slack, N·s/m.
    pub damping: f64,
    /// What it runs over.
    pub wrap: Option<Wrap>,
}

impl Spring {
    /// A linear spring that starts relaxed.
    pub fn linear(name: impl Into<String>, from: Attachment, to: Attachment, stiffness: f64) -> Self {
        let law = SpringLaw::Linear { stiffness, tension_only: false };
        Self { name: name.into(), from, to, law, rest_length: None, size: 1.0, damping: 0.0, wrap: None }
    }
}

/// Tension T against the stretch x = ℓ - ℓ0 or the strain ε = x/ℓ0.
#[derive(Clone, Debug, PartialEq)]
pub enum SpringLaw {
    /// k x.
    Linear {
        /// k, N/m.
        stiffness: f64,
        /// Nothing below slack?
        tension_only: bool,
    },
    /// Stress k2 (exp(k1 ε) - 1) on the area A0/(1 + ε); nothing below slack.
    Exponential {
        /// A0, m².
        area: f64,
        /// k1.
        exponent: f64,
        /// k2, Pa.
        stress: f64,
        /// Whether it is continuous at slack.
        form: ExponentialForm,
    },
    /// K ε²/(2 ε_t) up to the strain ε_t, then K (ε - ε_t/2); nothing below slack.
    Toe {
        /// K, N per unit of strain.
        axial_stiffness: f64,
        /// ε_t.
        toe_strain: f64,
    },
    /// Through rows of elongation (m) and force (N).
    Table {
        /// Elongations increase.
        rows: Vec<[f64; 2]>,
    },
}

/// The exponential law near slack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExponentialForm {
    /// Stress k2 (exp(k1 ε) - 1): nothing at slack.
    Continuous,
    /// Stress k2 exp(k1 ε): jumps by A0 k2 at slack.
    Printed,
}

/// Something round that a spring runs over without friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrap {
    /// What carries it, and where on it.
    pub frame: Frame,
    /// Its shape, about the frame's origin.
    pub obstacle: Obstacle,
}

/// The shape of what a spring runs over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A sphere.
    Sphere {
        /// Radius, m.
        radius: f64,
    },
    /// A cylinder without ends.
    Cylinder {
        /// Radius, m.
        radius: f64,
        /// Unit vector, in the frame.
        axis: Vector3<f64>,
        /// The side; None: the shorter way.
        turn: Option<Turn>,
    },
}

/// To which side a path goes around a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// From `from` to `to`, right-handedly about the axis.
    Positive,
    /// The other way.
    Negative,
}
