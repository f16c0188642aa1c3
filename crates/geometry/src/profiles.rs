//! Rest shapes given by their curvatures k1(s), k2(s), k3(s).

use crate::ShapeError;
use crate::constant::uniform_pose;
use flexura_model::Profile;
use flexura_spatial::{Pose, Twist, Vector3};

/// Steps are halved at most this often.
const DEPTH: usize = 24;
/// Two half steps must agree with the whole one to this, relative to the length and in rad.
const TOLERANCE: f64 = 2e-15;

/// Curvature profiles, with the stress-free pose at the ends of steps short enough to be exact.
#[derive(Clone, Debug)]
pub(crate) struct Profiles {
    curvature: [Profile; 3],
    length: f64,
    /// Arc length and pose at the start of every step.
    poses: Vec<(f64, Pose)>,
}

impl Profiles {
    /// The shape of the given curvatures; `breaks` are the arc lengths at which they have kinks.
    pub fn new(curvature: &[Profile; 3], length: f64, breaks: &[f64]) -> Result<Self, ShapeError> {
        for i in 0..=64 {
            let s = length * f64::from(i) / 64.0;
            for (profile, what) in curvature.iter().zip(["k1", "k2", "k3"]) {
                if !profile.value(s, length).is_finite() {
                    return Err(ShapeError::LawNotFinite { what, s });
                }
            }
        }
        let mut shape = Self { curvature: curvature.clone(), length, poses: Vec::new() };
        let mut poses = vec![(0.0, Pose::identity())];
        let mut pose = Pose::identity();
        let mut from = 0.0;
        for to in breaks.iter().copied().chain(std::iter::once(length)) {
            shape.integrate(from, to, 0, &mut pose, &mut poses);
            from = to;
        }
        poses.pop();
        shape.poses = poses;
        Ok(shape)
    }

    /// By how much (rad) the shape may turn between two arc lengths without that a few places show it.
    pub fn hidden_turn(&self, a: f64, b: f64) -> f64 {
        let hidden = self.curvature.iter().filter_map(|k| k.variation(a, b)).map(|v| v.hidden());
        hidden.sum::<f64>() * (b - a)
    }

    /// (k1, k2, k3) at `s`.
    pub fn curvature(&self, s: f64) -> Vector3<f64> {
        Vector3::from_fn(|i, _| self.curvature[i].value(s, self.length))
    }

    /// (k1, k2, k3) if they are the same everywhere.
    pub fn uniform(&self) -> Option<Vector3<f64>> {
        let [k1, k2, k3] = &self.curvature;
        Some(Vector3::new(k1.as_constant()?, k2.as_constant()?, k3.as_constant()?))
    }

    /// The section's pose at `s` in the start frame.
    pub fn pose(&self, s: f64) -> Pose {
        if let Some(k) = self.uniform() {
            return uniform_pose(&k, s);
        }
        let i = self.poses.partition_point(|(start, _)| *start <= s).saturating_sub(1);
        let (start, pose) = &self.poses[i];
        *pose * self.step(*start, s - start)
    }

    /// Advances `pose` from one arc length to another, in steps that agree with their halves.
    fn integrate(&self, from: f64, to: f64, depth: usize, pose: &mut Pose, poses: &mut Vec<(f64, Pose)>) {
        let h = to - from;
        let whole = self.step(from, h);
        let halves = self.step(from, 0.5 * h) * self.step(from + 0.5 * h, 0.5 * h);
        let gap = (whole.inverse() * halves).log();
        let converged = gap.angular.norm() <= TOLERANCE
            && gap.linear.norm() <= TOLERANCE * self.length.max(h)
            && self.hidden_turn(from, to) <= TOLERANCE;
        if converged || depth == DEPTH {
            *pose = *pose * halves;
            poses.push((to, *pose));
        } else {
            let middle = from + 0.5 * h;
            self.integrate(from, middle, depth + 1, pose, poses);
            self.integrate(middle, to, depth + 1, pose, poses);
        }
    }

    /// One step of the sixth-order Magnus method for X' = X hat(k, e1) in SE(3), with three Gauss points.
    ///
    /// Blanes, Casas, Oteo and Ros, *Physics Reports* 470 (2009) 151, for X' = A X; here the
    /// factor stands on the right, which turns the sign of every commutator.
    fn step(&self, from: f64, h: f64) -> Pose {
        let offset = 0.15f64.sqrt();
        let at = |c: f64| Algebra(Twist { angular: self.curvature(from + c * h), linear: Vector3::x() }) * h;
        let (a1, a2, a3) = (at(0.5 - offset), at(0.5), at(0.5 + offset));
        let b0 = a2;
        let b1 = (a3 - a1) * (15f64.sqrt() / 3.0);
        let b2 = (a3 - a2 * 2.0 + a1) * (10.0 / 3.0);
        let c1 = b0.bracket(&b1);
        let c2 = b0.bracket(&(b2 * 2.0 + c1)) * (-1.0 / 60.0);
        let omega = b0 + b2 * (1.0 / 12.0) + (b0 * -20.0 - b2 + c1).bracket(&(b1 + c2)) * (1.0 / 240.0);
        Pose::exp(&omega.0)
    }
}

/// An element of se(3) with the commutator of the matrices that multiply from the right.
#[derive(Clone, Copy)]
struct Algebra(Twist);

impl Algebra {
    /// The commutator for X' = X A: minus that of the matrices.
    fn bracket(&self, other: &Algebra) -> Algebra {
        let (a, b) = (&self.0, &other.0);
        Algebra(Twist {
            angular: b.angular.cross(&a.angular),
            linear: b.angular.cross(&a.linear) - a.angular.cross(&b.linear),
        })
    }
}

impl std::ops::Add for Algebra {
    type Output = Algebra;
    fn add(self, other: Algebra) -> Algebra {
        Algebra(Twist { angular: self.0.angular + other.0.angular, linear: self.0.linear + other.0.linear })
    }
}

impl std::ops::Sub for Algebra {
    type Output = Algebra;
    fn sub(self, other: Algebra) -> Algebra {
        self + other * -1.0
    }
}

impl std::ops::Mul<f64> for Algebra {
    type Output = Algebra;
    fn mul(self, factor: f64) -> Algebra {
        Algebra(Twist { angular: self.0.angular * factor, linear: self.0.linear * factor })
    }
}
