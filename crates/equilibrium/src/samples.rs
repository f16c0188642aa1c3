//! Samples along beams and the courses of cables, in SI units.

use crate::beam::LocalLaw;
use crate::channel::TendonChannel;
use crate::extract::GAUSS;
use crate::lower::{Course, Span};
use crate::mesh::Stretch;
use crate::shooting::{Acting, Plain, carry_plain, carry_through, jump, pose_of, wrench_of};
use crate::system::Equilibrium;
use flexura_mechanics::rod::{ChannelSample, Coupled, rod_share};
use flexura_model::ProbeTarget;
use flexura_solution::{BeamSample, BeamSolution, CableSolution};
use flexura_spatial::{Vector3, Wrench};

/// Into how many parts a beam is cut to look for its largest stress, however many samples are wanted.
const PEAK_PARTS: usize = 100;

/// Channels along a stretch, with the tension (N) in each.
type Threads<'a> = [(&'a TendonChannel, f64)];

impl Equilibrium {
    pub(crate) fn cables(&self, beams: &[BeamSolution]) -> Vec<CableSolution> {
        let scale = self.lowered.scale;
        let channels = self.channel_lengths();
        let mut cables = Vec::with_capacity(self.lowered.ropes.len());
        for (index, rope) in self.lowered.ropes.iter().enumerate() {
            let mut course: Vec<Vector3<f64>> = Vec::new();
            let mut add = |point: Vector3<f64>| {
                // Where a line meets a channel both give the same point, but for round-off.
                if course.last().is_none_or(|last| (last - point).norm() > 1e-9 * scale.length) {
                    course.push(point);
                }
            };
            let mut length = channels[index] * scale.length;
            for part in &rope.course {
                match part {
                    Course::Line(line) => {
                        let ends = rope.lines[*line]
                            .map(|(node, point)| self.node_pose(node).point(&point) * scale.length);
                        length += (ends[1] - ends[0]).norm();
                        ends.into_iter().for_each(&mut add);
                    }
                    Course::Channel { beam, between: [from, to], route } => {
                        let tiny = 1e-12 * route.length;
                        let inside = |s: f64| s >= from.min(*to) - tiny && s <= from.max(*to) + tiny;
                        let samples = beams[*beam].samples.iter().filter(|sample| inside(sample.s));
                        let mut points: Vec<_> =
                            samples.map(|sample| sample.pose.point(&route.point(sample.s))).collect();
                        if from > to {
                            points.reverse();
                        }
                        points.into_iter().for_each(&mut add);
                    }
                }
            }
            cables.push(CableSolution { course, length, tension: self.tension(index) * scale.force });
        }
        cables
    }

    /// How much of each cable runs in channels, nondimensional.
    fn channel_lengths(&self) -> Vec<f64> {
        let mut lengths = vec![0.0; self.lowered.ropes.len()];
        for (index, span) in self.lowered.spans.iter().enumerate().filter(|(_, s)| !s.tendons.is_empty()) {
            let mesh = &self.meshes[index];
            let pulls = self.pulls(index);
            let acting = Acting { jumps: &span.jumps, load: self.load, pulls: &pulls };
            for (k, segment) in mesh.segments.iter().enumerate() {
                let mut state = match k {
                    0 => self.head_state(index),
                    _ => self.inner_state(self.layout.spans[index].inner[k - 1].state),
                };
                for &j in mesh.first_jumps.iter().filter(|_| k == 0) {
                    jump(&span.jumps[j], self.load, &mut state);
                }
                let along = carry_plain(segment, &acting, &mut state);
                for (&rope, length) in span.tendons.iter().zip(&along) {
                    lengths[rope] += length[0];
                }
            }
        }
        lengths
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
                    if probe.quantity.is_peak() {
                        let place = |i: usize| length * i as f64 / PEAK_PARTS as f64;
                        places.extend((0..=PEAK_PARTS).map(place));
                    }
                    places.push(at.arc_length(length).clamp(0.0, length));
                }
            }
        }
        let watched = self.watched.iter().filter(|point| point.beam.0 == beam);
        places.extend(watched.map(|point| point.at.arc_length(length).clamp(0.0, length)));
        for span in self.lowered.spans.iter().filter(|s| s.beam == beam) {
            places.extend(span.s);
            places.extend(span.jumps.iter().map(|j| j.s));
            places.extend(span.channels.iter().flat_map(|channel| channel.breaks()));
        }
        places.extend_from_slice(self.lowered.beams[beam].breaks());
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| (*a - *b).abs() < 1e-12 * length);
        if let Some(last) = places.last_mut() {
            *last = length;
        }
        places
    }

    /// Samples of one beam, and its strain energy with that of its foundation in joules.
    pub(crate) fn sample_beam(&self, beam: usize, samples: usize, energies: bool) -> (BeamSolution, f64) {
        let law = &self.lowered.beams[beam];
        let places = self.places(beam, samples);
        let tiny = 1e-12 * law.length;
        let mut out = BeamSolution {
            samples: Vec::with_capacity(places.len()),
            length: law.length,
            foundation_force: Vector3::zeros(),
        };
        let mut energy = 0.0;
        // The whole force of a foundation is an integral as the energy is.
        let integrals = energies || !law.founded.is_empty();
        for (index, span) in self.lowered.spans.iter().enumerate().filter(|(_, s)| s.beam == beam) {
            let mesh = &self.meshes[index];
            let pulls = self.pulls(index);
            let acting = Acting { jumps: &span.jumps, load: self.load, pulls: &pulls };
            let mut state = self.head_state(index);
            if span.s[0] <= tiny {
                let threads = self.threads(span, mesh.segments[0][0].s);
                out.samples.push(self.sample(beam, 0.0, &state, &threads));
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
                    let threads = self.threads(span, stretch.s);
                    let density = stretch.piece.steps as f64 / (stretch.s[1] - stretch.s[0]);
                    let mut at = stretch.s[0];
                    let mut to = |s: f64, state: &mut Plain| {
                        if s - at > 1e-14 * law.length {
                            let steps = ((density * (s - at)).ceil() as usize).max(1);
                            carry_through(
                                &Stretch::new(law, span, [at, s], steps, Vec::new()),
                                &acting,
                                state,
                            );
                            at = s;
                        }
                    };
                    // Energy by three-point Gauss on parts of at most a quarter of a step.
                    let stored = |a: f64, b: f64, state: &mut Plain, to: &mut dyn FnMut(f64, &mut Plain)| {
                        let parts = ((b - a) * density * 4.0).ceil().max(1.0);
                        let h = (b - a) / parts;
                        let mut sum = (0.0, Vector3::zeros());
                        for part in 0..parts as usize {
                            for (node, weight) in GAUSS {
                                let s = a + h * (part as f64 + node);
                                to(s, state);
                                let (density, force) = self.densities(beam, s, state, &threads);
                                sum = (sum.0 + h * weight * density, sum.1 + force * (h * weight));
                            }
                        }
                        sum
                    };
                    let mut a = stretch.s[0];
                    let mut is_end_wanted = false;
                    let inside =
                        places.iter().filter(|s| **s > stretch.s[0] + tiny && **s <= stretch.s[1] + tiny);
                    for &b in inside {
                        is_end_wanted = b >= stretch.s[1] - tiny;
                        if is_end_wanted {
                            break;
                        }
                        if integrals {
                            let (part, force) = stored(a, b, &mut state, &mut to);
                            energy += part;
                            out.foundation_force += force;
                        }
                        to(b, &mut state);
                        out.samples.push(self.sample(beam, b, &state, &threads));
                        a = b;
                    }
                    if integrals && stretch.s[1] - a > tiny {
                        let (part, force) = stored(a, stretch.s[1], &mut state, &mut to);
                        energy += part;
                        out.foundation_force += force;
                    }
                    // The stretch itself gives the state at its end, and that from which the next one starts.
                    state = start;
                    carry_through(stretch, &acting, &mut state);
                    if is_end_wanted {
                        out.samples.push(self.sample(beam, stretch.s[1], &state, &threads));
                    }
                    for &j in &stretch.jumps {
                        jump(&span.jumps[j], self.load, &mut state);
                    }
                }
            }
        }
        (out, energy)
    }

    /// The channels along a stretch, with the tension (N) in each.
    fn threads<'a>(&self, span: &'a Span, s: [f64; 2]) -> Vec<(&'a TendonChannel, f64)> {
        let force = self.lowered.scale.force;
        let channels = span.channels.iter().filter(|channel| channel.holds(s));
        channels.map(|channel| (channel, self.tension(span.tendons[channel.tendon]) * force)).collect()
    }

    /// What the beam itself carries of the section's wrench at `s`, in the section's axes, with its strain and curvature; SI.
    fn share(
        &self,
        law: &LocalLaw,
        s: f64,
        state: &Plain,
        threads: &Threads<'_>,
    ) -> (Wrench, Vector3<f64>, Vector3<f64>) {
        let whole = self.lowered.scale.wrench_out(&wrench_of(state));
        let whole = whole.rotated(&pose_of(state).rotation.inverse());
        let own = if threads.is_empty() {
            whole
        } else {
            let compliance = law.compliance.to_matrix();
            let coupled = Coupled {
                k0: law.k0.into(),
                compliance: std::array::from_fn(|i| std::array::from_fn(|j| compliance[(i, j)])),
            };
            let tendons: Vec<(ChannelSample, f64)> =
                threads.iter().map(|(channel, tension)| (channel.at(s), *tension)).collect();
            let [force, moment] = rod_share(&coupled, &[whole.force.into(), whole.moment.into()], &tendons);
            Wrench::new(force.into(), moment.into())
        };
        let (strain, curvature) = law.strain(&own.force, &own.moment);
        (own, strain, curvature)
    }

    fn sample(&self, beam: usize, s: f64, state: &Plain, threads: &Threads<'_>) -> BeamSample {
        let law = &self.lowered.beams[beam];
        let scale = self.lowered.scale;
        let pose = scale.pose_out(&pose_of(state));
        let inset = s.clamp(1e-12 * law.length, (1.0 - 1e-12) * law.length);
        let local = law.law_at(inset);
        let (own, strain, curvature) = self.share(&local, inset, state, threads);
        let whole = scale.wrench_out(&wrench_of(state));
        let rest_pose = self.lowered.beam_rest[beam] * scale.pose_in(&law.shape.pose(s));
        BeamSample {
            s,
            pose,
            rest_pose: scale.pose_out(&rest_pose),
            wrench: if threads.is_empty() { whole } else { own.rotated(&pose.rotation) },
            curvature,
            rest_curvature: local.k0,
            strain,
            // Where a foundation ends, what is before it counts.
            foundation: law.foundation_at((s - 1e-12 * law.length).max(0.0), &pose.position).0,
        }
    }

    /// Energy of the beam and its foundation, ½ (n, m) · C (n, m) + ∫ f du (J/m), and force of the foundation (N/m).
    fn densities(&self, beam: usize, s: f64, state: &Plain, threads: &Threads<'_>) -> (f64, Vector3<f64>) {
        let law = &self.lowered.beams[beam];
        let local = law.law_at(s);
        let (own, strain, curvature) = self.share(&local, s, state, threads);
        let own = 0.5 * (own.force.dot(&strain) + own.moment.dot(&(curvature - local.k0)));
        let position = Vector3::from(state.position) * self.lowered.scale.length;
        let (force, pushed) = law.foundation_at(s, &position);
        (own + pushed, force)
    }
}
