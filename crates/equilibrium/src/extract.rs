//! The solution in SI units; `samples` along the beams.

use crate::system::Equilibrium;
use flexura_mechanics::joint::{ContactState, Kinematics};
use flexura_solution::{BeamSolution, ContactSolution, JointSolution, Solution, Status, Work, summed_up};
use flexura_spatial::{Pose, Wrench};

/// Nodes and weights of three-point Gauss quadrature on [0, 1].
pub(crate) const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// A contact seen globally; `fixed` is the pose of the parent's frame, `wrench` what the parent exerts on the child.
fn touched(contact: &ContactState, fixed: &Pose, wrench: &Wrench) -> ContactSolution {
    let normal = fixed.rotation * contact.normal;
    let force = wrench.force.dot(&normal);
    ContactSolution {
        point: fixed.point(&contact.points[1]),
        normal,
        points: contact.points,
        parameters: contact.parameters,
        radii: contact.radii,
        force,
        friction: wrench.force - normal * force,
        travel: contact.travel,
        rates: contact.rates,
    }
}

impl Equilibrium {
    /// Reads the present state off. `samples` places along each beam, ends included, besides those that
    /// outputs ask for and those where something jumps.
    pub fn solution(&mut self, samples: usize) -> Solution {
        let residual = self.residual_size();
        let mut warnings = self.warnings().to_vec();
        warnings.extend(self.warnings_here());
        Solution { residual, warnings: summed_up(warnings), ..self.sampled(samples, true, |_| true) }
    }

    /// What is to be said of the present state: limits passed, contacts that pull, springs beyond their tables.
    pub fn warnings_here(&mut self) -> Vec<String> {
        let state = (!self.slack.is_empty()).then(|| self.x.clone());
        self.least_norm();
        let warnings = self.state_warnings();
        if let Some(state) = state {
            self.x = state;
        }
        warnings
    }

    /// The same without what was not asked for: only some beams have samples, and the strain energy, which takes an
    /// integration of its own, may be left out. There are no warnings, and the residual is not evaluated.
    pub fn sampled(&mut self, samples: usize, energies: bool, wanted: impl Fn(usize) -> bool) -> Solution {
        let scale = self.lowered.scale;
        // What is read off has the wrenches of least norm; the state itself stays, so that a path goes on from it.
        let state = (!self.slack.is_empty()).then(|| self.x.clone());
        self.least_norm();
        let mut energy = 0.0;
        let mut beams = Vec::with_capacity(self.model.beams.len());
        for beam in 0..self.model.beams.len() {
            if !energies && !wanted(beam) {
                let length = self.lowered.beams[beam].length;
                beams.push(BeamSolution { length, ..BeamSolution::default() });
                continue;
            }
            let (solution, strain_energy) = self.sample_beam(beam, samples.max(2), energies);
            energy += strain_energy;
            beams.push(solution);
        }
        let cables = self.cables(&beams);
        let bodies = (0..self.model.bodies.len()).map(|i| scale.pose_out(&self.node_pose(Some(i)))).collect();
        let mut joints = Vec::new();
        for (index, (joint, slots)) in self.lowered.joints.iter().zip(&self.layout.joints).enumerate() {
            let configuration = self.configuration(&slots.coordinates);
            let wrench = Wrench::new(self.triple(slots.wrench.state), self.triple(slots.wrench.state + 3));
            energy += joint.coordinates.energy(&configuration, self.load) * scale.moment();
            if index >= self.model.joints.len() {
                continue;
            }
            let base = self.node_pose(joint.parent.node) * joint.parent.frame;
            let wrench = scale.wrench_out(&wrench);
            // Hᵀ W = effort - k (q - rest): the effort is what a drive must supply, or the load that was given.
            let held = joint.coordinates.push_back(&configuration, self.load);
            let efforts = (0..joint.coordinates.joint.freedoms())
                .map(|i| {
                    let h = joint.coordinates.joint.subspace(&configuration, i);
                    let unit = joint.coordinates.units[i];
                    (base.rotation * h.angular).dot(&wrench.moment) / unit
                        + (base.rotation * h.linear).dot(&wrench.force) * (scale.length / unit)
                        + held[i] * scale.moment() / joint.coordinates.units[i]
                        - self.geared(index, i)
                })
                .collect();
            joints.push(JointSolution {
                coordinates: joint.coordinates.values(&configuration, self.load),
                efforts,
                wrench,
                contact: joint
                    .coordinates
                    .joint
                    .contact(&configuration)
                    .map(|contact| touched(&contact, &scale.pose_out(&base), &wrench)),
            });
        }
        let (springs, stored) = self.spring_solutions();
        energy += stored * scale.moment();
        for (span, slots) in self.lowered.spans.iter().zip(&self.layout.spans) {
            energy +=
                span.start.coordinates.energy(&self.configuration(&slots.start), self.load) * scale.moment();
            if let Some(end) = &span.end {
                energy += end.coordinates.energy(&self.configuration(&slots.end), self.load) * scale.moment();
            }
        }
        let (tubes, stored) = self.sample_nests(samples);
        energy += stored * scale.moment();
        let couplings = self.multipliers();
        if let Some(state) = state {
            self.x = state;
        }
        Solution {
            status: Status::Converged,
            reason: None,
            load_fraction: self.load,
            residual: f64::NAN,
            error_estimate: 0.0,
            warnings: Vec::new(),
            work: Work {
                integration_steps: self.total_steps(),
                segments: self.segments(),
                ..Work::default()
            },
            beams,
            bodies,
            joints,
            springs,
            couplings,
            cables,
            tubes,
            tangents: Vec::new(),
            sensitivities: None,
            found: Vec::new(),
            energy,
            stable: None,
            unstable_directions: None,
            stability_reason: Some("stability was not asked for".to_string()),
            rates: None,
        }
    }

    /// λ of every coupling, so that its effort on a coordinate is factor × λ, SI.
    fn multipliers(&self) -> Vec<f64> {
        let moment = self.lowered.scale.moment();
        let gears = self.lowered.gears.iter().zip(&self.layout.gears);
        gears.map(|(gear, slot)| self.x[slot.state] * moment / gear.unit).collect()
    }

    /// The effort of couplings on a joint coordinate, SI.
    fn geared(&self, joint: usize, coordinate: usize) -> f64 {
        let multipliers = self.multipliers();
        let terms = self
            .model
            .couplings
            .iter()
            .zip(&multipliers)
            .flat_map(|(coupling, multiplier)| coupling.terms.iter().map(move |term| (term, multiplier)));
        terms
            .filter(|(term, _)| term.joint.0 == joint && term.coordinate == coordinate)
            .map(|(term, multiplier)| term.factor * multiplier)
            .sum()
    }
}
