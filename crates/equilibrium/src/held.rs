//! A frame that a node carries through a joint, and how it moves.

use crate::assembly::unit;
use crate::lower::{Carrier, Hold};
use crate::system::Equilibrium;
use flexura_mechanics::joint::{Configuration, Kinematics, MAX_FREEDOMS};
use flexura_spatial::{Pose, Twist, UnitQuaternion, Vector3, Wrench};

type V = Vector3<f64>;

/// A frame carried by a node through a joint, and how it moves.
pub(crate) struct Held {
    /// Node that carries it, with the node's origin.
    pub node: Option<(usize, V)>,
    /// Where the joint's moving frame is.
    pub moving: Pose,
    /// The same with what is left of the mismatch.
    pub target: Pose,
    /// Columns of H of the unknown coordinates, global.
    pub subspace: [Twist; MAX_FREEDOMS],
    pub count: usize,
    /// F's axes, in which changes of H are given.
    pub fixed: UnitQuaternion<f64>,
}

impl Held {
    /// How the target moves when the carrying node moves along its unknown `i` (three turnings, three shifts).
    pub fn by_node(&self, i: usize) -> Twist {
        match self.node {
            Some((_, origin)) if i < 3 => {
                Twist { angular: unit(i), linear: unit(i).cross(&(self.target.position - origin)) }
            }
            Some(_) => Twist { angular: V::zeros(), linear: unit(i - 3) },
            None => Twist { angular: V::zeros(), linear: V::zeros() },
        }
    }

    /// How the target moves along coordinate `i`.
    pub fn by_coordinate(&self, i: usize) -> Twist {
        let h = &self.subspace[i];
        let lever = self.target.position - self.moving.position;
        Twist { angular: h.angular, linear: h.linear + h.angular.cross(&lever) }
    }

    /// Number of unknowns that move the target: of its node, then coordinates.
    pub fn motions(&self) -> usize {
        self.count + if self.node.is_some() { 6 } else { 0 }
    }

    /// How the target moves along the `i`-th of them.
    pub fn motion(&self, i: usize) -> Twist {
        match (self.node.is_some(), i) {
            (true, 0..6) => self.by_node(i),
            (true, _) => self.by_coordinate(i - 6),
            (false, _) => self.by_coordinate(i),
        }
    }

    pub fn arm(&self) -> V {
        self.node.map_or(V::zeros(), |(_, origin)| self.target.position - origin)
    }

    /// `H_iᵀ W` for the wrench `w` about the target's origin.
    pub fn effort(&self, i: usize, w: &Wrench) -> f64 {
        let lever = self.target.position - self.moving.position;
        let h = &self.subspace[i];
        h.angular.dot(&(w.moment + lever.cross(&w.force))) + h.linear.dot(&w.force)
    }
}

/// What a hold and a joint have in common.
pub(crate) struct HoldRef<'a> {
    pub coordinates: &'a crate::coordinates::Coordinates,
    pub mismatch: &'a Twist,
}

impl<'a> HoldRef<'a> {
    pub fn of(hold: &'a Hold) -> Self {
        Self { coordinates: &hold.coordinates, mismatch: &hold.mismatch }
    }
}

fn is_zero(twist: &Twist) -> bool {
    twist.angular == V::zeros() && twist.linear == V::zeros()
}

impl Equilibrium {
    pub(crate) fn held(&self, carrier: &Carrier, hold: &HoldRef<'_>, configuration: &Configuration) -> Held {
        let base = self.node_pose(carrier.node);
        let fixed = base * carrier.frame;
        let coordinates = hold.coordinates;
        let moving = fixed * coordinates.joint.pose(configuration);
        let left = 1.0 - self.load;
        let target = if left == 0.0 || is_zero(hold.mismatch) {
            moving
        } else {
            let twist = Twist { angular: hold.mismatch.angular * left, linear: hold.mismatch.linear * left };
            moving * Pose::exp(&twist)
        };
        let mut subspace = [Twist { angular: V::zeros(), linear: V::zeros() }; MAX_FREEDOMS];
        let count = coordinates.unknowns();
        for (i, h) in subspace.iter_mut().enumerate().take(count) {
            let local = coordinates.subspace(configuration, i);
            *h = Twist { angular: fixed.rotation * local.angular, linear: fixed.rotation * local.linear };
        }
        Held {
            node: carrier.node.map(|n| (n, base.position)),
            moving,
            target,
            subspace,
            count,
            fixed: fixed.rotation,
        }
    }
}
