//! Point wrenches on something that turns.

use flexura_spatial::{Vector3, Wrench};

/// What acts at a point: a part that stays in global axes and a part that turns with the point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLoad {
    /// Dead part, global axes.
    pub dead: Wrench,
    /// Follower part, in the axes of the section or body.
    pub follower: Wrench,
    /// What a spinning frame does to a mass there, with its derivative by the place.
    pub outward: Option<Outward>,
}

/// Centrifugal force on a mass: m ω² (x - c - a a·(x - c)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outward {
    /// m ω².
    pub mass: f64,
    /// a, unit vector along the line about which all turns.
    pub axis: Vector3<f64>,
    /// c, a point of it.
    pub through: Vector3<f64>,
}

impl Outward {
    /// The force at a place; its derivative turns shifts into forces alike.
    pub fn force(&self, place: &Vector3<f64>) -> Vector3<f64> {
        self.change(&(place - self.through))
    }

    /// How it changes with a shift.
    pub fn change(&self, shift: &Vector3<f64>) -> Vector3<f64> {
        (shift - self.axis * self.axis.dot(shift)) * self.mass
    }
}

impl PointLoad {
    /// Nothing.
    pub fn zero() -> Self {
        Self { dead: Wrench::zero(), follower: Wrench::zero(), outward: None }
    }

    /// Does nothing act?
    pub fn is_zero(&self) -> bool {
        *self == Self::zero()
    }

    /// Does a part of it turn with what it acts on?
    pub fn follows(&self) -> bool {
        self.follower != Wrench::zero()
    }

    /// The load in global axes where the point's axes are `rotation` (section or body to global).
    pub fn at(&self, rotation: &flexura_spatial::UnitQuaternion<f64>) -> Wrench {
        self.dead + self.follower.rotated(rotation)
    }

    /// How the load changes when the point turns by the small global turning `dtheta`.
    pub fn change(&self, rotation: &flexura_spatial::UnitQuaternion<f64>, dtheta: &Vector3<f64>) -> Wrench {
        let turned = self.follower.rotated(rotation);
        Wrench::new(dtheta.cross(&turned.force), dtheta.cross(&turned.moment))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura_spatial::exp;

    #[test]
    fn change_is_the_derivative_and_a_dead_load_has_none() {
        let load = PointLoad {
            dead: Wrench::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.5, 0.0, -1.0)),
            follower: Wrench::new(Vector3::new(-2.0, 0.3, 1.0), Vector3::new(0.1, 0.9, 0.4)),
            outward: None,
        };
        let rotation = exp(&Vector3::new(0.4, 0.2, -1.0));
        let d = Vector3::new(0.2, -0.6, 0.3);
        let h = 1e-5;
        let central = (load.at(&(exp(&(d * h)) * rotation)).force
            - load.at(&(exp(&(-d * h)) * rotation)).force)
            / (2.0 * h);
        assert!((load.change(&rotation, &d).force - central).norm() < 1e-9);
        let dead = PointLoad { follower: Wrench::zero(), ..load };
        assert_eq!(dead.change(&rotation, &d), Wrench::zero());
    }
}
