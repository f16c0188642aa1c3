//! Residual and tangent of what couples nodes: joints, couplings of their coordinates, point loads, cables.

use crate::assembly::{Sink, unit};
use crate::held::HoldRef;
use crate::lower::RopeLaw;
use crate::shooting::{Pull, SegmentEnd};
use crate::system::{Equilibrium, read_pose};
use flexura_mechanics::joint::{Kinematics, MAX_FREEDOMS};
use flexura_mechanics::load::Outward;
use flexura_mechanics::spring::{SpringForce, constant_tension};
use flexura_spatial::{Vector3, Wrench, log};

type V = Vector3<f64>;

/// By how much a joint's two frames are turned and shifted against each other.
pub(crate) fn closure_error(problem: &Equilibrium, index: usize) -> (V, V) {
    let joint = &problem.lowered.joints[index];
    let slots = &problem.layout.joints[index];
    let reference = HoldRef { coordinates: &joint.coordinates, mismatch: &joint.mismatch };
    let held = problem.held(&joint.parent, &reference, &problem.configuration(&slots.coordinates));
    let child = problem.node_pose(joint.child.node) * joint.child.frame;
    (log(&(child.rotation * held.target.rotation.inverse())), child.position - held.target.position)
}

impl Equilibrium {
    pub(crate) fn evaluate_joint(&self, index: usize, sink: &mut Sink<'_>) {
        let joint = &self.lowered.joints[index];
        let slots = &self.layout.joints[index];
        let reference = HoldRef { coordinates: &joint.coordinates, mismatch: &joint.mismatch };
        let held = self.held(&joint.parent, &reference, &self.configuration(&slots.coordinates));
        let base = self.node_pose(joint.child.node);
        let child = base * joint.child.frame;
        let wrench = Wrench::new(self.triple(slots.wrench.state), self.triple(slots.wrench.state + 3));
        let closure = slots.wrench.unknown;
        let error = child.rotation * held.target.rotation.inverse();
        let kept = self.kept_rows(index);
        let keep = |v: V, first: usize| v.component_mul(&kept[first]);
        sink.add_residual(closure, &keep(log(&error), 0));
        sink.add_residual(closure + 3, &keep(child.position - held.target.position, 1));
        for row in 0..6 {
            if self.slack.get(index).is_some_and(|slack| slack[row]) {
                // The loop closes without this row; instead the wrench's component there is held at zero.
                let component = (row + 3) % 6;
                sink.r[closure + row] += self.x[slots.wrench.state + component];
                sink.add_number(closure + row, closure + component, 1.0);
            }
        }
        if sink.matrix.is_some() {
            self.target_columns(&held, slots.coordinates.unknown, |unknown, twist| {
                sink.add(closure, unknown, &keep(-(error * twist.angular), 0));
                sink.add(closure + 3, unknown, &keep(-twist.linear, 1));
            });
        }
        let wrench_column = |i: usize| {
            if i < 3 { Wrench::new(unit(i), V::zeros()) } else { Wrench::new(V::zeros(), unit(i - 3)) }
        };
        if let Some(node) = joint.child.node {
            let rows = self.layout.nodes[node].unknown;
            let arm = child.position - base.position;
            sink.add_residual(rows, &(wrench.moment + arm.cross(&wrench.force)));
            sink.add_residual(rows + 3, &wrench.force);
            if sink.matrix.is_some() {
                for i in 0..3 {
                    sink.add(closure, rows + i, &keep(unit(i), 0));
                    sink.add(closure + 3, rows + i, &keep(unit(i).cross(&arm), 1));
                    sink.add(closure + 3, rows + 3 + i, &keep(unit(i), 1));
                    sink.add(rows, rows + i, &unit(i).cross(&arm).cross(&wrench.force));
                }
                for i in 0..6 {
                    let change = wrench_column(i);
                    sink.add(rows, closure + i, &(change.moment + arm.cross(&change.force)));
                    sink.add(rows + 3, closure + i, &change.force);
                }
            }
        }
        let derivative = |f: &mut dyn FnMut(usize, Wrench)| {
            for i in 0..6 {
                f(closure + i, wrench_column(i));
            }
        };
        self.hold_rows(&held, &slots.coordinates, &joint.coordinates, &wrench, &derivative, sink);
    }

    pub(crate) fn evaluate_node_loads(&self, sink: &mut Sink<'_>) {
        self.evaluate_spin(sink);
        for (node, slot) in self.lowered.nodes.iter().zip(&self.layout.nodes) {
            let pose = read_pose(&self.x, slot.state);
            for (point, load, _) in &node.loads {
                let mut wrench = load.at(&pose.rotation) * self.load;
                let arm = pose.rotation * point;
                if let Some(outward) = &load.outward {
                    wrench.force += outward.force(&(pose.position + arm)) * self.load;
                    self.pull_outwards(outward, &arm, slot.unknown, sink);
                }
                sink.add_residual(slot.unknown, &(wrench.moment + arm.cross(&wrench.force)));
                sink.add_residual(slot.unknown + 3, &wrench.force);
                if sink.matrix.is_some() {
                    for i in 0..3 {
                        let change = load.change(&pose.rotation, &unit(i)) * self.load;
                        let moved = unit(i).cross(&arm).cross(&wrench.force);
                        let column = slot.unknown + i;
                        sink.add(slot.unknown, column, &(change.moment + arm.cross(&change.force) + moved));
                        sink.add(slot.unknown + 3, column, &change.force);
                    }
                }
            }
        }
    }

    /// How centrifugal force on a mass, `arm` away from a node's origin, changes with the node's motion.
    fn pull_outwards(&self, outward: &Outward, arm: &V, node: usize, sink: &mut Sink<'_>) {
        if sink.matrix.is_none() {
            return;
        }
        for i in 0..6 {
            let shift = if i < 3 { unit(i).cross(arm) } else { unit(i - 3) };
            let change = outward.change(&shift) * self.load;
            sink.add(node, node + i, &arm.cross(&change));
            sink.add(node + 3, node + i, &change);
        }
    }

    /// A drag that holds every node back to where it was: `-κ` times its turning and shift since; and coordinates too, if
    /// they are held back.
    pub(crate) fn evaluate_drag(&self, sink: &mut Sink<'_>) {
        let (anchors, strength) = &self.drag;
        for (anchor, slot) in anchors.iter().zip(&self.layout.nodes) {
            let pose = read_pose(&self.x, slot.state);
            let turn = log(&(pose.rotation * anchor.rotation.inverse()));
            sink.add_residual(slot.unknown, &(-turn * *strength));
            sink.add_residual(slot.unknown + 3, &((anchor.position - pose.position) * *strength));
            for i in 0..6 {
                sink.add_number(slot.unknown + i, slot.unknown + i, -strength);
            }
        }
        for ((coordinates, slot), anchor) in self.coordinate_slots().zip(&self.held_back) {
            let mut gone = [0.0; MAX_FREEDOMS];
            coordinates.step(anchor, &self.configuration(slot), &mut gone[..slot.count]);
            for (i, gone) in gone.iter().enumerate().take(slot.count) {
                // Here a row is minus the effort that acts.
                sink.r[slot.unknown + i] += strength * gone;
                sink.add_number(slot.unknown + i, slot.unknown + i, *strength);
            }
        }
    }

    /// What pulls between these points has no direction, as where two have met: the state is refused.
    pub(crate) fn refuse(&self, ends: &[(Option<usize>, V)], sink: &mut Sink<'_>) {
        if let Some((Some(node), _)) = ends.iter().find(|(node, _)| node.is_some()) {
            sink.r[self.layout.nodes[*node].unknown] = f64::NAN;
        }
    }

    /// Forces along a line between two points on nodes.
    pub(crate) fn pull(
        &self,
        on: &[(Option<usize>, V); 2],
        ends: &[V; 2],
        force: &SpringForce,
        sink: &mut Sink<'_>,
    ) {
        for (which, (node, _)) in on.iter().enumerate() {
            let Some(node) = *node else { continue };
            let rows = self.layout.nodes[node].unknown;
            let sign = if which == 0 { 1.0 } else { -1.0 };
            let arm = ends[which] - self.node_pose(Some(node)).position;
            let f = force.force * sign;
            sink.add_residual(rows, &arm.cross(&f));
            sink.add_residual(rows + 3, &f);
            if sink.matrix.is_none() {
                continue;
            }
            for i in 0..3 {
                sink.add(rows, rows + i, &unit(i).cross(&arm).cross(&f));
            }
            for (other, (carrier, _)) in on.iter().enumerate() {
                let Some(carrier) = *carrier else { continue };
                let columns = self.layout.nodes[carrier].unknown;
                let lever = ends[other] - self.node_pose(Some(carrier)).position;
                let towards = if other == 1 { sign } else { -sign };
                for i in 0..6 {
                    let motion = if i < 3 { unit(i).cross(&lever) } else { unit(i - 3) };
                    let change = force.tangent * motion * towards;
                    sink.add(rows, columns + i, &arm.cross(&change));
                    sink.add(rows + 3, columns + i, &change);
                }
            }
        }
    }

    /// The tension of a cable at the present load and state.
    pub(crate) fn tension(&self, rope: usize) -> f64 {
        match (self.lowered.ropes[rope].law, self.layout.ropes[rope]) {
            (_, Some(slot)) => self.x[slot.state],
            (RopeLaw::Tension(tension), None) => self.load * tension,
            (RopeLaw::Length(_), None) => 0.0,
        }
    }

    /// The tendons along a span at the present load and state.
    pub(crate) fn pulls(&self, span: usize) -> Vec<Pull> {
        let tendons = self.lowered.spans[span].tendons.iter();
        tendons
            .map(|&rope| Pull { tension: self.tension(rope), unknown: self.layout.ropes[rope].is_some() })
            .collect()
    }

    /// Σ T d of the tendons along a span.
    pub(crate) fn tendon_moment(&self, span: usize) -> f64 {
        let span = &self.lowered.spans[span];
        span.channels.iter().map(|c| c.reach * self.tension(span.tendons[c.tendon]).abs()).sum()
    }

    /// What the channels of a span add to the length of cables whose length is given.
    pub(crate) fn tendon_rows(&self, span: usize, ends: &[SegmentEnd], sink: &mut Sink<'_>) {
        for (i, &rope) in self.lowered.spans[span].tendons.iter().enumerate() {
            let Some(slot) = self.layout.ropes[rope] else { continue };
            // Such a span is one segment.
            let length = &ends[0].lengths[i];
            sink.r[slot.unknown] += length[0];
            if sink.matrix.is_some() {
                self.head_unknowns(span, |k, unknown| sink.add_number(slot.unknown, unknown, length[1 + k]));
            }
        }
    }

    /// Cables: a constant tension T along every line of the course; where the length is given instead,
    /// `ℓ = ℓ_rest + λ (ℓ_wanted - ℓ_rest)` finds T. What runs in channels is the spans' part.
    pub(crate) fn evaluate_ropes(&self, sink: &mut Sink<'_>) {
        for (index, rope) in self.lowered.ropes.iter().enumerate() {
            let tension = self.tension(index);
            let unknown = self.layout.ropes[index].map(|slot| slot.unknown);
            let mut length = 0.0;
            for line in &rope.lines {
                let ends = line.map(|(node, point)| self.node_pose(node).point(&point));
                let Some(force) = constant_tension(tension, &ends) else {
                    self.refuse(line, sink);
                    continue;
                };
                length += force.length;
                self.pull(line, &ends, &force, sink);
                let Some(unknown) = unknown else { continue };
                let along = (ends[1] - ends[0]) / force.length;
                for (which, (node, _)) in line.iter().enumerate() {
                    let Some(node) = *node else { continue };
                    let rows = self.layout.nodes[node].unknown;
                    let u = if which == 0 { along } else { -along };
                    let arm = ends[which] - self.node_pose(Some(node)).position;
                    // dF/dT on the node, and minus the same is how the length changes when the node moves.
                    let moment = arm.cross(&u);
                    sink.add(rows, unknown, &moment);
                    sink.add(rows + 3, unknown, &u);
                    for i in 0..3 {
                        sink.add_number(unknown, rows + i, -moment[i]);
                        sink.add_number(unknown, rows + 3 + i, -u[i]);
                    }
                }
            }
            if let (RopeLaw::Length([rest, wanted]), Some(unknown)) = (rope.law, unknown) {
                sink.r[unknown] += length - (rest + self.load * (wanted - rest));
            }
        }
    }

    /// Couplings: `Σ factor (q - q_rest) = λ (offset - Σ factor q_rest)`, kept by efforts factor × multiplier.
    pub(crate) fn evaluate_gears(&self, sink: &mut Sink<'_>) {
        for (gear, slot) in self.lowered.gears.iter().zip(&self.layout.gears) {
            let [rest, wanted] = gear.offset;
            sink.r[slot.unknown] -= rest + self.load * (wanted - rest);
            for &(joint, coordinate, factor) in &gear.terms {
                let coordinates = &self.lowered.joints[joint].coordinates;
                let slots = &self.layout.joints[joint].coordinates;
                let q = coordinates.joint.coordinates(&self.configuration(slots))[coordinate];
                sink.r[slot.unknown] += factor * q;
                if let Some(i) = coordinates.unknown_of(coordinate) {
                    let row = slots.unknown + i;
                    sink.r[row] -= factor * self.x[slot.state];
                    sink.add_number(slot.unknown, row, factor);
                    sink.add_number(row, slot.unknown, -factor);
                }
            }
        }
    }

    /// One where a closure row of a joint stands, zero where the loop closes without it: turning, then shift.
    fn kept_rows(&self, joint: usize) -> [V; 2] {
        let Some(slack) = self.slack.get(joint) else { return [V::repeat(1.0); 2] };
        let one = |row: usize| if slack[row] { 0.0 } else { 1.0 };
        [V::new(one(0), one(1), one(2)), V::new(one(3), one(4), one(5))]
    }
}
