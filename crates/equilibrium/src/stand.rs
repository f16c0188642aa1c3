//! Putting the mechanism where an earlier result has it, and pushing it off its path.

use crate::course::{Course, Mark};
use crate::lower::{JointOrigin, NodeOrigin};
use crate::system::{Equilibrium, write_pose};
use flexura_mechanics::joint::{Kinematics, MAX_FREEDOMS};
use flexura_nonlinear::System;
use flexura_solution::{BeamSample, Solution};
use flexura_spatial::{Pose, Vector3, Wrench};

impl Equilibrium {
    /// Puts the mechanism where a result of this or a neighbouring model has it, under the full load. What the result
    /// does not hold is filled in: between samples by straight lines, so that a few corrections lead back to equilibrium.
    pub fn stand(&mut self, solution: &Solution) {
        self.rest();
        let scale = self.lowered.scale;
        for (i, span) in self.lowered.spans.iter().enumerate() {
            let Some(beam) = solution.beams.get(span.beam) else { continue };
            let mut course = Course::default();
            for sample in beam.samples.iter().filter(|s| s.s >= span.s[0] && s.s <= span.s[1]) {
                let wrench = scale.wrench_in(&self.whole(span.beam, sample, solution));
                let (force, moment) = (wrench.force.norm(), wrench.moment.norm());
                course.most.force = course.most.force.max(force);
                course.most.moment = course.most.moment.max(moment);
                course.marks.push(Mark { s: sample.s, force, moment });
            }
            self.courses[i] = course;
        }
        let counts: Vec<usize> = self.cutters().map(|mut cutter| cutter.segments()).collect();
        self.remesh(&counts);
        self.stand_on_same_mesh(solution);
    }

    /// The same without a mesh of its own, so that the state can be compared with others.
    pub fn stand_on_same_mesh(&mut self, solution: &Solution) {
        let scale = self.lowered.scale;
        let mut x = vec![0.0; self.layout.state];
        let mut poses = Vec::with_capacity(self.lowered.nodes.len());
        for (node, slot) in self.lowered.nodes.iter().zip(&self.layout.nodes) {
            let pose = match node.origin {
                NodeOrigin::Body(i) => solution.bodies.get(i).map(|pose| scale.pose_in(pose)),
                NodeOrigin::Hub { beam, s } => {
                    self.at(solution, beam, s).map(|(pose, _)| scale.pose_in(&pose))
                }
            };
            let pose = pose.unwrap_or(node.initial);
            write_pose(&mut x, slot.state, &pose);
            poses.push(pose);
        }
        let pose_of = |node: Option<usize>| node.map_or(Pose::identity(), |n| poses[n]);
        for (span, slots) in self.lowered.spans.iter().zip(&self.layout.spans) {
            let ends = [(0, Some(&span.start), &slots.start), (1, span.end.as_ref(), &slots.end)];
            for (which, hold, slot) in ends {
                let (Some(hold), Some((pose, wrench))) = (hold, self.at(solution, span.beam, span.s[which]))
                else {
                    continue;
                };
                let fixed = pose_of(hold.carrier.node) * hold.carrier.frame;
                let q = hold.coordinates.joint.nearest(&(fixed.inverse() * scale.pose_in(&pose)));
                x[slot.state..slot.state + q.len()].copy_from_slice(&q);
                if which == 0 {
                    write_wrench(&mut x, slots.wrench.state, &scale.wrench_in(&wrench));
                }
            }
            for (k, inner) in slots.inner.iter().enumerate() {
                let index = self.layout.spans.iter().position(|s| std::ptr::eq(s, slots)).unwrap_or(0);
                let s = self.meshes[index].start_of(k + 1);
                if let Some((pose, wrench)) = self.at(solution, span.beam, s) {
                    write_pose(&mut x, inner.state, &scale.pose_in(&pose));
                    write_wrench(&mut x, inner.state + 7, &scale.wrench_in(&wrench));
                }
            }
        }
        for (joint, slots) in self.lowered.joints.iter().zip(&self.layout.joints) {
            let fixed = pose_of(joint.parent.node) * joint.parent.frame;
            let child = pose_of(joint.child.node) * joint.child.frame;
            let mut q = joint.coordinates.joint.nearest(&(fixed.inverse() * child));
            let wrench = match joint.origin {
                JointOrigin::Joint(i) => solution.joints.get(i).map(|result| {
                    let kinds = joint.coordinates.kind.freedoms();
                    if result.coordinates.len() == kinds {
                        // As the user reads them: turns beyond half a turn are kept.
                        let units = joint.coordinates.units;
                        let values: Vec<f64> =
                            result.coordinates.iter().zip(units).map(|(v, u)| v / u).collect();
                        q = joint.coordinates.joint.configuration(&values);
                    }
                    result.wrench
                }),
                JointOrigin::Hold { beam, start } => solution.beams.get(beam).and_then(|b| {
                    let sample = if start { b.samples.first() } else { b.samples.last() }?;
                    let whole = self.whole(beam, sample, solution);
                    Some(if start { -whole } else { whole })
                }),
            };
            let slot = slots.coordinates.state;
            x[slot..slot + q.len()].copy_from_slice(&q);
            if let Some(wrench) = wrench {
                write_wrench(&mut x, slots.wrench.state, &scale.wrench_in(&wrench));
            }
        }
        for ((gear, slot), multiplier) in
            self.lowered.gears.iter().zip(&self.layout.gears).zip(&solution.couplings)
        {
            x[slot.state] = multiplier * gear.unit / scale.moment();
        }
        for (slot, tubes) in self.layout.nests.iter().zip(&solution.tubes) {
            let Some(sample) = tubes.samples.first() else { continue };
            let moment = scale.wrench_in(&sample.wrench).moment;
            x[slot.state..slot.state + 3].copy_from_slice(moment.as_slice());
            for (i, (_, torque)) in sample.torques.iter().enumerate().skip(1).take(slot.count - 3) {
                x[slot.state + 2 + i] = torque / scale.moment();
            }
        }
        for (slot, cable) in self.layout.ropes.iter().zip(&solution.cables) {
            if let Some(slot) = slot {
                x[slot.state] = cable.tension / scale.force;
            }
        }
        self.x = x;
        self.set_load(1.0);
    }

    /// The wrench of the beam and the tendons in its channels together at a sample; SI.
    fn whole(&self, beam: usize, sample: &BeamSample, solution: &Solution) -> Wrench {
        let mut whole = sample.wrench;
        let spans = self.lowered.spans.iter().filter(|span| span.beam == beam);
        for (span, channel) in spans.flat_map(|span| span.channels.iter().map(move |c| (span, c))) {
            // A sample shows what is before it, the first one what is behind.
            let before = sample.s > channel.s[0] || sample.s == 0.0;
            let Some(cable) = solution.cables.get(span.tendons[channel.tendon]) else { continue };
            if channel.s[0] <= sample.s && sample.s <= channel.s[1] && before {
                let place = channel.at(sample.s);
                let offset = Vector3::new(0.0, place.offset[0], place.offset[1]);
                let slope = Vector3::new(0.0, place.slope[0], place.slope[1]);
                let along = Vector3::x() + sample.strain + sample.curvature.cross(&offset) + slope;
                let pull = along.normalize() * cable.tension;
                whole = whole + Wrench::new(pull, offset.cross(&pull)).rotated(&sample.pose.rotation);
            }
        }
        whole
    }

    /// Pose and whole wrench at `s` (m), by straight lines between the samples; SI.
    fn at(&self, solution: &Solution, beam: usize, s: f64) -> Option<(Pose, Wrench)> {
        let samples = &solution.beams.get(beam)?.samples;
        let after = samples.partition_point(|sample| sample.s <= s);
        let first = samples.get(after.saturating_sub(1))?;
        let second = samples.get(after).unwrap_or(first);
        let width = second.s - first.s;
        let t = if width > 0.0 { (s - first.s) / width } else { 0.0 };
        let mix = |a: Vector3<f64>, b: Vector3<f64>| a * (1.0 - t) + b * t;
        let between = (first.pose.rotation.inverse() * second.pose.rotation).powf(t);
        let (a, b) = (self.whole(beam, first, solution), self.whole(beam, second, solution));
        Some((
            Pose::new(first.pose.rotation * between, mix(first.pose.position, second.pose.position)),
            Wrench::new(mix(a.force, b.force), mix(a.moment, b.moment)),
        ))
    }

    /// Wrenches on every node besides the loads, to push the mechanism off its path: `part` of them acts.
    pub fn set_kick(&mut self, wrenches: Vec<[Vector3<f64>; 2]>, part: f64) {
        self.kick = (wrenches, part);
    }

    /// Changes how much of the kick acts.
    pub fn set_kick_part(&mut self, part: f64) {
        self.kick.1 = part;
    }

    /// Puts a drag on every node that holds it back where it is now; a strength of zero takes it off.
    pub fn set_drag(&mut self, strength: f64) {
        let poses = self.layout.nodes.iter().map(|slot| crate::system::read_pose(&self.x, slot.state));
        self.drag = if strength > 0.0 { (poses.collect(), strength) } else { (Vec::new(), 0.0) };
        self.held_back.clear();
    }

    /// The same, with a drag on the coordinates of all joints and holds too, so that nothing moves without resistance.
    pub fn set_whole_drag(&mut self, strength: f64) {
        self.set_drag(strength);
        if strength > 0.0 {
            self.held_back = self.coordinate_slots().map(|(_, slot)| self.configuration(slot)).collect();
        }
    }

    /// How far nodes and coordinates have gone against the drag: the largest shift over L, or turning in radians.
    pub fn dragged(&self) -> f64 {
        let poses = self.layout.nodes.iter().map(|slot| crate::system::read_pose(&self.x, slot.state));
        let each = poses.zip(&self.drag.0).map(|(pose, anchor)| {
            let turn = pose.rotation.angle_to(&anchor.rotation);
            (pose.position - anchor.position).norm().max(turn)
        });
        let coordinates =
            self.coordinate_slots().zip(&self.held_back).map(|((coordinates, slot), anchor)| {
                let mut gone = [0.0; MAX_FREEDOMS];
                coordinates.step(anchor, &self.configuration(slot), &mut gone[..slot.count]);
                gone.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()))
            });
        coordinates.fold(each.fold(0.0, f64::max), f64::max)
    }

    /// Number of nodes, and how strong a wrench bends what is tied to each: force and moment, nondimensional.
    pub fn node_strengths(&self) -> Vec<[f64; 2]> {
        let mut strengths = vec![[0.0_f64; 2]; self.lowered.nodes.len()];
        for span in &self.lowered.spans {
            let [force, moment] = self.lowered.beams[span.beam].wrench_unit;
            let nodes = [span.start.carrier.node, span.end.as_ref().and_then(|end| end.carrier.node)];
            for node in nodes.into_iter().flatten() {
                strengths[node][0] = strengths[node][0].max(force);
                strengths[node][1] = strengths[node][1].max(moment);
            }
        }
        strengths
    }
}

fn write_wrench(x: &mut [f64], at: usize, wrench: &Wrench) {
    x[at..at + 3].copy_from_slice(wrench.force.as_slice());
    x[at + 3..at + 6].copy_from_slice(wrench.moment.as_slice());
}
