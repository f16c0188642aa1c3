//! The solution in SI units, sampled along the beams.

use crate::shooting::{Plain, carry_plain, jump, pose_of, wrench_of};
use crate::system::Equilibrium;
use flexura_mechanics::joint::Kinematics;
use flexura_mechanics::rod::advance;
use flexura_model::ProbeTarget;
use flexura_solution::{
    BeamSample, BeamSolution, CableSolution, JointSolution, Solution, SpringSolution, Status, Work,
};
use flexura_spatial::{Pose, Wrench};

/// Nodes and weights of three-point Gauss quadrature on [0, 1].
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

impl Equilibrium {
    /// Reads the present state off. `samples` places along each beam, ends included, besides those that
    /// outputs ask for and those where something jumps.
    pub fn solution(&mut self, samples: usize) -> Solution {
        let residual = self.residual_size();
        Solution { residual, ..self.sampled(samples, true, |_| true) }
    }

    /// The same without what was not asked for: only some beams have samples, and the strain energy, which takes an
    /// integration of its own, may be left out. The residual is not evaluated.
    pub fn sampled(&mut self, samples: usize, energies: bool, wanted: impl Fn(usize) -> bool) -> Solution {
        let scale = self.lowered.scale;
        self.least_norm();
        let mut energy = 0.0;
        let mut beams = Vec::with_capacity(self.model.beams.len());
        for beam in 0..self.model.beams.len() {
            if !energies && !wanted(beam) {
                let length = self.lowered.beams[beam].length;
                beams.push(BeamSolution { samples: Vec::new(), length });
                continue;
            }
            let (solution, strain_energy) = self.sample_beam(beam, samples.max(2), energies);
            energy += strain_energy;
            beams.push(solution);
        }
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
                    (base.rotation * h.angular).dot(&wrench.moment)
                        + (base.rotation * h.linear).dot(&wrench.force)
                        + held[i] * scale.moment() / joint.coordinates.units[i]
                        - self.geared(index, i)
                })
                .collect();
            joints.push(JointSolution {
                coordinates: joint.coordinates.values(&configuration, self.load),
                efforts,
                wrench,
            });
        }
        let mut springs = Vec::new();
        for i in 0..self.lowered.springs.len() {
            let ends = self.spring_ends(i);
            let law = self.spring_law(i);
            let length = (ends[1] - ends[0]).norm();
            energy += law.energy(length) * scale.moment();
            springs.push(SpringSolution {
                ends: ends.map(|p| p * scale.length),
                length: length * scale.length,
                tension: law.stiffness * (length - law.rest_length) * scale.force,
            });
        }
        for (span, slots) in self.lowered.spans.iter().zip(&self.layout.spans) {
            energy +=
                span.start.coordinates.energy(&self.configuration(&slots.start), self.load) * scale.moment();
            if let Some(end) = &span.end {
                energy += end.coordinates.energy(&self.configuration(&slots.end), self.load) * scale.moment();
            }
        }
        let mut warnings = self.warnings().to_vec();
        warnings.extend(self.state_warnings());
        Solution {
            status: Status::Converged,
            reason: None,
            load_fraction: self.load,
            residual: f64::NAN,
            error_estimate: 0.0,
            warnings,
            work: Work {
                integration_steps: self.total_steps(),
                segments: self.segments(),
                ..Work::default()
            },
            beams,
            bodies,
            joints,
            springs,
            couplings: self.multipliers(),
            cables: self.cables(),
            tangents: Vec::new(),
            sensitivities: None,
            found: Vec::new(),
            energy,
            stable: None,
            unstable_directions: None,
            stability_reason: Some("stability is not decided by this version".to_string()),
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

    fn cables(&self) -> Vec<CableSolution> {
        let scale = self.lowered.scale;
        let mut cables = Vec::with_capacity(self.lowered.ropes.len());
        for (index, rope) in self.lowered.ropes.iter().enumerate() {
            let mut course: Vec<flexura_spatial::Vector3<f64>> = Vec::new();
            let mut length = 0.0;
            for line in &rope.lines {
                let ends = line.map(|(node, point)| self.node_pose(node).point(&point) * scale.length);
                length += (ends[1] - ends[0]).norm();
                if course.last() != Some(&ends[0]) {
                    course.push(ends[0]);
                }
                course.push(ends[1]);
            }
            cables.push(CableSolution { course, length, tension: self.tension(index) * scale.force });
        }
        cables
    }

    /// Where a beam is sampled, m.
    fn places(&self, beam: usize, samples: usize) -> Vec<f64> {
        let length = self.lowered.beams[beam].length;
        let mut places: Vec<f64> = (0..samples).map(|i| length * i as f64 / (samples - 1) as f64).collect();
        for output in self.model.outputs.iter().chain(self.model.targets.iter().map(|t| &t.output)) {
            for probe in &output.probes {
                if let ProbeTarget::Beam(id, at) = probe.target
                    && id.0 == beam
                {
                    places.push(at.arc_length(length).clamp(0.0, length));
                }
            }
        }
        for span in self.lowered.spans.iter().filter(|s| s.beam == beam) {
            places.extend(span.s);
            places.extend(span.jumps.iter().map(|j| j.s));
        }
        places.extend(self.lowered.beams[beam].breaks());
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| (*a - *b).abs() < 1e-12 * length);
        if let Some(last) = places.last_mut() {
            *last = length;
        }
        places
    }

    /// Samples of one beam and its strain energy in joules.
    fn sample_beam(&self, beam: usize, samples: usize, energies: bool) -> (BeamSolution, f64) {
        let law = &self.lowered.beams[beam];
        let places = self.places(beam, samples);
        let tiny = 1e-12 * law.length;
        let mut out = BeamSolution { samples: Vec::with_capacity(places.len()), length: law.length };
        let mut energy = 0.0;
        for (index, span) in self.lowered.spans.iter().enumerate().filter(|(_, s)| s.beam == beam) {
            let mesh = &self.meshes[index];
            let mut state = self.head_state(index);
            if span.s[0] <= tiny {
                out.samples.push(self.sample(beam, 0.0, &state));
            }
            for &j in &mesh.first_jumps {
                jump(&span.jumps[j], self.load, &mut state);
            }
            for (k, segment) in mesh.segments.iter().enumerate() {
                if k > 0 {
                    state = self.inner_state(self.layout.spans[index].inner[k - 1].state);
                }
                for stretch in segment {
                    let start = state;
                    let density = stretch.piece.steps as f64 / (stretch.s[1] - stretch.s[0]);
                    let mut at = stretch.s[0];
                    let mut to = |s: f64, state: &mut Plain| {
                        if s - at > 1e-14 * law.length {
                            let steps = ((density * (s - at)).ceil() as usize).max(1);
                            advance(&law.piece(at, s, steps), self.load, state);
                            at = s;
                        }
                    };
                    let mut a = stretch.s[0];
                    let inside =
                        places.iter().filter(|s| **s > stretch.s[0] + tiny && **s <= stretch.s[1] + tiny);
                    for &b in inside {
                        let b = b.min(stretch.s[1]);
                        // Energy by three-point Gauss on parts of at most a quarter of a step.
                        let parts = if energies { ((b - a) * density * 4.0).ceil().max(1.0) } else { 0.0 };
                        for part in 0..parts as usize {
                            let h = (b - a) / parts;
                            for (node, weight) in GAUSS {
                                let s = a + h * (part as f64 + node);
                                to(s, &mut state);
                                energy += h * weight * self.energy_density(beam, s, &state);
                            }
                        }
                        to(b, &mut state);
                        out.samples.push(self.sample(beam, b, &state));
                        a = b;
                    }
                    // The stretch itself gives the state that the next one starts from, jumps included.
                    state = start;
                    carry_plain(std::slice::from_ref(stretch), &span.jumps, self.load, &mut state);
                }
            }
        }
        (out, energy)
    }

    fn sample(&self, beam: usize, s: f64, state: &Plain) -> BeamSample {
        let law = &self.lowered.beams[beam];
        let scale = self.lowered.scale;
        let pose = scale.pose_out(&pose_of(state));
        let wrench = scale.wrench_out(&wrench_of(state));
        let local = wrench.rotated(&pose.rotation.inverse());
        let inset = s.clamp(1e-12 * law.length, (1.0 - 1e-12) * law.length);
        let here = law.law_at(inset);
        let (strain, curvature) = here.strain(&local.force, &local.moment);
        let rest_pose = self.lowered.beam_rest[beam] * scale.pose_in(&law.shape.pose(s));
        BeamSample {
            s,
            pose,
            rest_pose: scale.pose_out(&rest_pose),
            wrench,
            curvature,
            rest_curvature: here.k0,
            strain,
        }
    }

    /// ½ (n, m) · C (n, m), J/m.
    fn energy_density(&self, beam: usize, s: f64, state: &Plain) -> f64 {
        let scale = self.lowered.scale;
        let pose: Pose = pose_of(state);
        let local = scale.wrench_out(&wrench_of(state)).rotated(&pose.rotation.inverse());
        let here = self.lowered.beams[beam].law_at(s);
        let (strain, curvature) = here.strain(&local.force, &local.moment);
        0.5 * (local.force.dot(&strain) + local.moment.dot(&(curvature - here.k0)))
    }
}
