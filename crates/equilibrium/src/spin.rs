//! What a frame that spins does: centrifugal forces in statics, and gyroscopic ones in vibration.
//!
//! Bodies and masses are pulled at their centres by m ω × ((x - c) × ω), and bodies turned by (I ω) × ω, with I about the centre; a beam
//! likewise along its length (`flexura_mechanics::rod::Spinning`). All of it has the energy -½ ∫ ρ |ω × (x - c)|² dV.

use crate::assembly::{Sink, unit};
use crate::beam::BeamLaw;
use crate::lower::NodeOrigin;
use crate::scale::Scale;
use crate::system::{Equilibrium, read_pose};
use flexura_mechanics::load::Outward;
use flexura_mechanics::ode::STAGES;
use flexura_mechanics::rod::Spinning;
use flexura_model::{Model, Spin};
use flexura_spatial::{Matrix3, Vector3, hat};

type V = Vector3<f64>;

/// The pull on a mass (kg), nondimensional; None where nothing spins.
pub(crate) fn outward(model: &Model, scale: &Scale, mass: f64) -> Option<Outward> {
    let spin = model.spin.filter(|spin| spin.rate != 0.0 && mass != 0.0)?;
    let mass = mass * spin.rate * spin.rate * scale.length / scale.force;
    Some(Outward { mass, axis: spin.axis, through: spin.through / scale.length })
}

impl BeamLaw {
    /// Does it spin, with a mass?
    pub fn spins(&self) -> bool {
        self.spin().is_some_and(|spin| spin.rate != 0.0) && self.mass_at(0.5 * self.length).0 != 0.0
    }

    /// Mass and moments of inertia per length times the square of the rate, nondimensional.
    fn spun(&self, spin: &Spin, s: f64) -> (f64, [f64; 3]) {
        let (mass, rotary) = self.mass_at(s);
        let square = spin.rate * spin.rate / self.scale.force;
        (mass * square * self.scale.length * self.scale.length, rotary.map(|moment| moment * square))
    }

    /// How strongly it is pulled outwards at `s` per distance from the line about which all turns, nondimensional.
    pub fn outward_slope(&self, s: f64) -> f64 {
        self.spin().filter(|_| self.spins()).map_or(0.0, |spin| self.spun(&spin, s).0)
    }

    /// What the kernel reads of it between `a` and `b` (m).
    pub fn spinning(&self, a: f64, b: f64, steps: usize) -> Option<Spinning> {
        let spin = self.spin().filter(|_| self.spins())?;
        let inertia = if self.is_uniform() {
            vec![self.spun(&spin, 0.5 * (a + b))]
        } else {
            (0..steps * STAGES).map(|i| self.spun(&spin, crate::beam::stage(a, b, steps, i))).collect()
        };
        let through = spin.through / self.scale.length;
        Some(Spinning { axis: spin.axis.into(), through: through.into(), inertia })
    }
}

impl Equilibrium {
    /// Moments on bodies by their own inertia: I ω × ω.
    pub(crate) fn evaluate_spin(&self, sink: &mut Sink<'_>) {
        let Some(spin) = self.model.spin.filter(|spin| spin.rate != 0.0) else { return };
        let scale = self.lowered.scale;
        for (node, slot) in self.lowered.nodes.iter().zip(&self.layout.nodes) {
            let NodeOrigin::Body(body) = node.origin else { continue };
            let inertia = self.model.bodies[body].inertia;
            if inertia == Matrix3::zeros() {
                continue;
            }
            let rotation = read_pose(&self.x, slot.state).rotation.to_rotation_matrix().into_inner();
            let square = self.load * spin.rate * spin.rate / scale.moment();
            let turned = rotation * inertia * rotation.transpose() * square;
            sink.add_residual(slot.unknown, &(turned * spin.axis).cross(&spin.axis));
            if sink.matrix.is_some() {
                for i in 0..3 {
                    let change = hat(&unit(i)) * turned - turned * hat(&unit(i));
                    sink.add(slot.unknown, slot.unknown + i, &(change * spin.axis).cross(&spin.axis));
                }
            }
        }
    }

    /// Does the frame spin in which it is described?
    pub fn spins(&self) -> bool {
        self.spun().is_some()
    }

    /// How the frame spins at the present load.
    pub(crate) fn spun(&self) -> Option<Spun> {
        let spin = self.model.spin.filter(|spin| spin.rate != 0.0 && self.load > 0.0)?;
        Some(Spun { axis: spin.axis, rate: spin.rate * self.load.sqrt() })
    }
}

/// A frame that spins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spun {
    pub axis: V,
    /// rad/s.
    pub rate: f64,
}
