//! What a motion in time returns.

use crate::{Solution, Status};
use flexura_spatial::{Twist, Vector3, Wrench};

/// A motion in time, and the forces that it takes.
#[derive(Clone, Debug)]
pub struct InverseDynamics {
    /// Position of the parameter in the model's parameters.
    pub parameter: usize,
    /// Converged where the whole motion was gone through.
    pub status: Status,
    /// Why not, and what to try.
    pub reason: Option<String>,
    /// Things a user should know though all went well.
    pub warnings: Vec<String>,
    /// The times in order. Where the acceleration jumps there are two of one time: just before it and just after.
    pub instants: Vec<Instant>,
    /// Estimated largest error of the motion by the parameter and its second derivative, relative to their sizes.
    pub error_estimate: f64,
    /// Work counters.
    pub work: MotionWork,
}

/// How much work a motion was; counts, so that they repeat exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MotionWork {
    /// Times that were looked at.
    pub instants: usize,
    /// Newton steps, full and simplified.
    pub newton_steps: usize,
    /// Tangents factorised.
    pub factorisations: usize,
    /// Residuals evaluated without a tangent.
    pub residuals: usize,
}

/// A mechanism at one time of its motion.
#[derive(Clone, Debug)]
pub struct Instant {
    /// s.
    pub time: f64,
    /// Value of the parameter, SI.
    pub value: f64,
    /// Its rate, SI per second.
    pub rate: f64,
    /// Its second derivative by time, SI per second squared.
    pub acceleration: f64,
    /// For each output its components (one or three), SI; None where it has no value.
    pub outputs: Vec<Option<Vec<f64>>>,
    /// Outputs without a value, by their positions, and why.
    pub output_reasons: Vec<(usize, String)>,
    /// Poses, velocities, wrenches and efforts: the balance of the forces of inertia with all others.
    pub state: Solution,
    /// Power of all driven joint coordinates, Σ effort × velocity, W.
    pub drive_power: f64,
    /// Power of gravity, W.
    pub gravity_power: f64,
    /// Kinetic energy, J.
    pub kinetic_energy: f64,
}

impl Instant {
    /// How the bodies move, one for each.
    pub fn bodies(&self) -> &[BodyMotion] {
        self.state.rates.as_ref().map_or(&[], |rates| &rates.bodies)
    }

    /// How the coordinates of the joints move, one for each joint.
    pub fn joints(&self) -> &[JointMotion] {
        self.state.rates.as_ref().map_or(&[], |rates| &rates.joints)
    }
}

/// How a mechanism moves in time.
#[derive(Clone, Debug, Default)]
pub struct Rates {
    /// One for each body.
    pub bodies: Vec<BodyMotion>,
    /// One for each joint.
    pub joints: Vec<JointMotion>,
}

/// How a body moves.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion {
    /// Velocity of its origin (m/s) and angular velocity (rad/s), global axes.
    pub velocity: Twist,
    /// Acceleration of its origin (m/s²) and angular acceleration (rad/s²), global axes.
    pub acceleration: Twist,
    /// Of its centre of mass, m/s², global axes.
    pub center_acceleration: Vector3<f64>,
    /// The force -m a of inertia at its centre of mass and the moment -(I α + ω × I ω) about it, global axes.
    pub inertia: Wrench,
}

/// How the coordinates of a joint move.
#[derive(Clone, Debug, Default)]
pub struct JointMotion {
    /// m/s and rad/s.
    pub velocities: Vec<f64>,
    /// m/s² and rad/s².
    pub accelerations: Vec<f64>,
}
