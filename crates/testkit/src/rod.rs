//! The rod that the reference solvers solve, and its balance equations.
//!
//! ```text
//! p' = R (e1 + c_ε F1, c_γ2 F2, c_γ3 F3)        F_i = F·e_i
//! R' = R hat(k),  k = k0(s) + (c_κ1 M1, c_κ2 M2, c_κ3 M3)
//! F' = -q(s, p)    M' = -p' × F
//! ```
//!
//! Internal force and moment act by the part beyond s on the part before, in fixed axes. (Antman, *Nonlinear
//! Problems of Elasticity*, 2nd ed. (2005), ch. 8.)

use flexura_spatial::{Pose, Quaternion, UnitQuaternion, Vector3, Wrench};

/// A function of the arc length with three components.
pub type Field = Box<dyn Fn(f64) -> Vector3<f64>>;

/// A rod with an uncoupled section that is the same everywhere.
pub struct Rod {
    /// Undeformed length, m.
    pub length: f64,
    /// (1/EA, 1/GA2, 1/GA3, 1/GJ, 1/EI2, 1/EI3); zero suppresses a strain.
    pub compliance: [f64; 6],
    /// Rest curvatures k1, k2, k3 at s, 1/m.
    pub rest: Field,
    /// Dead force per undeformed length at s, N/m.
    pub load: Field,
    /// Force per undeformed length that depends on where the axis is: q(s, p), N/m. It acts in full whatever the load.
    pub reaction: Option<Reaction>,
}

/// A force per length at s, the axis being at p.
pub type Reaction = Box<dyn Fn(f64, &Vector3<f64>) -> Vector3<f64>>;

impl Rod {
    /// A rod of uniform rest curvature without distributed load.
    pub fn uniform(length: f64, compliance: [f64; 6], rest: Vector3<f64>) -> Self {
        Self {
            length,
            compliance,
            rest: Box::new(move |_| rest),
            load: Box::new(|_| Vector3::zeros()),
            reaction: None,
        }
    }

    /// The derivative of the 13 numbers of [`State::to_array`]; the distributed load times `load_factor`.
    pub fn rates(&self, s: f64, state: &[f64; 13], load_factor: f64) -> [f64; 13] {
        let state = State::from_array(state);
        // R by q v q*/|q|², so that no step needs a unit quaternion.
        let q = state.orientation;
        let norm2 = q.norm_squared();
        let rotate = |v: Vector3<f64>| (q * Quaternion::from_imag(v) * q.conjugate()).imag() / norm2;
        let back = |v: Vector3<f64>| (q.conjugate() * Quaternion::from_imag(v) * q).imag() / norm2;
        let (f, m) = (back(state.force), back(state.moment));
        let c = &self.compliance;
        let strain = Vector3::new(1.0 + c[0] * f.x, c[1] * f.y, c[2] * f.z);
        let curvature = (self.rest)(s) + Vector3::new(c[3] * m.x, c[4] * m.y, c[5] * m.z);
        let slope = rotate(strain);
        let reaction = self.reaction.as_ref().map_or(Vector3::zeros(), |q| q(s, &state.position));
        State {
            position: slope,
            orientation: q * Quaternion::from_imag(curvature) * 0.5,
            force: -(self.load)(s) * load_factor - reaction,
            moment: -slope.cross(&state.force),
        }
        .to_array()
    }

    /// What the 13 numbers are measured by: L, 1, EI/L², EI/L, from the softest bending stiffness.
    pub(crate) fn scales(&self) -> [f64; 13] {
        let soft = self.compliance[3..].iter().copied().fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let l = self.length;
        std::array::from_fn(|i| match i {
            0..=2 => l,
            3..=6 => 1.0,
            7..=9 => 1.0 / (soft * l * l),
            _ => 1.0 / (soft * l),
        })
    }
}

/// A section's place and internal wrench.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// m.
    pub position: Vector3<f64>,
    /// A quaternion of length one up to the error of the method.
    pub orientation: Quaternion<f64>,
    /// N, in fixed axes.
    pub force: Vector3<f64>,
    /// N·m, in fixed axes.
    pub moment: Vector3<f64>,
}

impl State {
    /// From a pose and the internal wrench there.
    pub fn new(pose: &Pose, wrench: &Wrench) -> Self {
        Self {
            position: pose.position,
            orientation: *pose.rotation.quaternion(),
            force: wrench.force,
            moment: wrench.moment,
        }
    }

    /// The pose.
    pub fn pose(&self) -> Pose {
        Pose::new(UnitQuaternion::from_quaternion(self.orientation), self.position)
    }

    /// The internal wrench.
    pub fn wrench(&self) -> Wrench {
        Wrench::new(self.force, self.moment)
    }

    /// p, q = (w, x, y, z), F, M.
    pub fn to_array(self) -> [f64; 13] {
        let (p, q, f, m) = (self.position, self.orientation, self.force, self.moment);
        [p.x, p.y, p.z, q.w, q.i, q.j, q.k, f.x, f.y, f.z, m.x, m.y, m.z]
    }

    /// The inverse of [`State::to_array`].
    pub fn from_array(a: &[f64; 13]) -> Self {
        Self {
            position: Vector3::new(a[0], a[1], a[2]),
            orientation: Quaternion::new(a[3], a[4], a[5], a[6]),
            force: Vector3::new(a[7], a[8], a[9]),
            moment: Vector3::new(a[10], a[11], a[12]),
        }
    }
}
