//! What a motion of rigid parts asks of the problem: how much of a step is motion, what moves most, and where the joints are.

use crate::system::{Equilibrium, read_pose};
use flexura_nonlinear::System;
use flexura_spatial::log;

/// What moves most in a step of the state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mover {
    /// Position of the body.
    pub body: Option<usize>,
    /// Shift of its origin, m, and turning, rad.
    pub motion: [f64; 2],
    /// The free joint coordinate that moves most: joint and coordinate.
    pub coordinate: Option<(usize, usize)>,
}

impl Equilibrium {
    /// Coordinates of every joint of the model, SI.
    pub fn joint_coordinates(&self) -> Vec<Vec<f64>> {
        let joints = self.lowered.joints.iter().zip(&self.layout.joints).take(self.model.joints.len());
        joints
            .map(|(joint, slots)| {
                joint.coordinates.values(&self.configuration(&slots.coordinates), self.load)
            })
            .collect()
    }

    /// Size of the motion in a step of the state, wrenches and multipliers left out: shifts count by the unit of length, turnings
    /// by the radian.
    pub fn motion_size(&self, step: &[f64]) -> f64 {
        let poses = self.layout.nodes.iter().map(|slot| slot.unknown..slot.unknown + 6);
        let joints = self.layout.joints.iter().map(|slots| &slots.coordinates);
        let coordinates = joints.map(|slot| slot.unknown..slot.unknown + slot.count);
        let mut largest = 0.0_f64;
        for value in poses.chain(coordinates).flatten().map(|i| step[i].abs()) {
            // `max` would hide a NaN.
            if value > largest || value.is_nan() {
                largest = value;
            }
        }
        largest
    }

    /// How far the mechanism has moved since a stored state, as [`Equilibrium::motion_size`] counts.
    pub fn moved_since(&self, state: &[f64]) -> f64 {
        let mut now = Vec::new();
        self.store(&mut now);
        let mut step = vec![0.0; self.unknowns()];
        self.difference(state, &now, &mut step);
        self.motion_size(&step)
    }

    /// The body, and the free joint coordinate, that have moved most since a stored state.
    pub fn mover_since(&self, state: &[f64]) -> Mover {
        let mut mover = Mover::default();
        let mut largest = 0.0;
        for (i, slot) in self.layout.nodes.iter().take(self.model.bodies.len()).enumerate() {
            let (before, now) = (read_pose(state, slot.state), read_pose(&self.x, slot.state));
            let turn = log(&(now.rotation * before.rotation.inverse())).norm();
            let shift = (now.position - before.position).norm();
            if shift.max(turn) > largest {
                largest = shift.max(turn);
                mover.body = Some(i);
                mover.motion = [shift * self.lowered.scale.length, turn];
            }
        }
        let mut now = Vec::new();
        self.store(&mut now);
        let mut step = vec![0.0; self.unknowns()];
        self.difference(state, &now, &mut step);
        let mut largest = 0.0;
        for (i, (joint, slots)) in self.lowered.joints.iter().zip(&self.layout.joints).enumerate() {
            let slot = &slots.coordinates;
            let coordinates = (0..self.model.joints.get(i).map_or(0, |joint| joint.law.coordinates.len()))
                .filter_map(|k| Some((k, joint.coordinates.unknown_of(k).filter(|k| *k < slot.count)?)));
            for (k, unknown) in coordinates {
                let size = step[slot.unknown + unknown].abs();
                if size > largest {
                    largest = size;
                    mover.coordinate = Some((i, k));
                }
            }
        }
        mover
    }
}
