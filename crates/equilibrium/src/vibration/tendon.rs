//! Tendons in channels along a beam: what they add to the sections of its elements.
//!
//! A tendon at d in the section runs along w = ν + κ × d + d', so that its length is ∫ |w| ds. Under the tension T its part of the
//! section's wrench is T g with g = ∂|w|/∂(ν, κ) = (u, d × u), u = w/|w|; a change of strain e changes that by T H e with H the second
//! derivative, and a change of the tension, where the length is given, by g.

use super::Vibration;
use super::cut::Elements;
use crate::beam::ScaledLaw;
use crate::system::Equilibrium;
use flexura_mechanics::rod::{ChannelSample, Coupled, rod_share};
use flexura_spatial::{Matrix3, Matrix6, Vector3, Vector6, hat};

type V = Vector3<f64>;

/// A tendon in one section, in the section's axes.
#[derive(Clone, Debug)]
pub(super) struct Thread {
    /// Position of the cable.
    pub rope: usize,
    /// g.
    pub along: Vector6<f64>,
    /// T H.
    pub stiffness: Matrix6<f64>,
}

impl Equilibrium {
    /// Tendons in a section of a span, nondimensional, and what of the wrench (n, m) there the beam itself carries.
    pub(super) fn threads_at(
        &self,
        span: usize,
        s: f64,
        local: &ScaledLaw,
        [n, m]: [V; 2],
    ) -> (Vec<Thread>, [V; 2]) {
        let description = &self.lowered.spans[span];
        let length = self.lowered.scale.length;
        let here: Vec<(usize, ChannelSample, f64)> = description
            .channels
            .iter()
            .filter(|channel| channel.holds([s, s]))
            .map(|channel| {
                let mut place = channel.at(s);
                place.offset = place.offset.map(|offset| offset / length);
                let rope = description.tendons[channel.tendon];
                (rope, place, self.tension(rope))
            })
            .collect();
        if here.is_empty() {
            return (Vec::new(), [n, m]);
        }
        let coupled = Coupled {
            k0: local.k0.into(),
            compliance: std::array::from_fn(|i| std::array::from_fn(|j| local.compliance[(i, j)])),
        };
        let tendons: Vec<(ChannelSample, f64)> =
            here.iter().map(|(_, place, tension)| (*place, *tension)).collect();
        let [own, turned] = rod_share(&coupled, &[n.into(), m.into()], &tendons).map(V::from);
        let c = &local.compliance;
        let strain = V::x() + c.fixed_view::<3, 3>(0, 0) * own + c.fixed_view::<3, 3>(0, 3) * turned;
        let curvature = local.k0 + c.fixed_view::<3, 3>(3, 0) * own + c.fixed_view::<3, 3>(3, 3) * turned;
        let threads = here.iter().map(|(rope, place, tension)| {
            let arm = V::new(0.0, place.offset[0], place.offset[1]);
            let w = strain + curvature.cross(&arm) + V::new(0.0, place.slope[0], place.slope[1]);
            let (u, size) = (w.normalize(), w.norm());
            let across = (Matrix3::identity() - u * u.transpose()) * (*tension / size);
            // δw = δν - d × δκ.
            let turn = -hat(&arm);
            let mut stiffness = Matrix6::zeros();
            stiffness.fixed_view_mut::<3, 3>(0, 0).copy_from(&across);
            stiffness.fixed_view_mut::<3, 3>(0, 3).copy_from(&(across * turn));
            stiffness.fixed_view_mut::<3, 3>(3, 0).copy_from(&(turn.transpose() * across));
            stiffness.fixed_view_mut::<3, 3>(3, 3).copy_from(&(turn.transpose() * across * turn));
            let moment = arm.cross(&u);
            let along = Vector6::new(u.x, u.y, u.z, moment.x, moment.y, moment.z);
            Thread { rope: *rope, along, stiffness }
        });
        (threads.collect(), [own, turned])
    }

    /// How tensions that are unknown go with the motions of a span: the length's derivative, in rows and columns alike.
    pub(super) fn add_threads(&self, span: usize, own: &Elements, vibration: &mut Vibration) {
        let order = own.rule.order;
        let mut entries = Vec::new();
        for (e, element) in own.list.iter().enumerate() {
            for (rope, length) in &element.threads {
                let Some(row) = self.layout.ropes[*rope].and_then(|slot| vibration.columns[slot.unknown])
                else {
                    continue;
                };
                for node in 0..=order {
                    let part = length.fixed_rows::<6>(6 * node);
                    for (unknown, x) in self.node_motions(span, own, e, node) {
                        let value = part.dot(&x);
                        if let (Some(at), true) = (vibration.columns[unknown], value != 0.0) {
                            entries.extend([(row, at, value), (at, row, value)]);
                        }
                    }
                }
            }
        }
        vibration.stiffness.extend(entries);
    }
}
