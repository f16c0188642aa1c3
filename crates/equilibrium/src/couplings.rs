//! Residual and tangent of what couples nodes: joints, point loads, springs.

use crate::assembly::{HoldRef, Sink, unit};
use crate::system::{Equilibrium, read_pose};
use flexura_mechanics::spring::LinearSpring;
use flexura_spatial::{Vector3, Wrench, log};

type V = Vector3<f64>;

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
        sink.add_residual(closure, &log(&error));
        sink.add_residual(closure + 3, &(child.position - held.target.position));
        if sink.matrix.is_some() {
            self.target_columns(&held, slots.coordinates.unknown, |unknown, twist| {
                sink.add(closure, unknown, &-(error * twist.angular));
                sink.add(closure + 3, unknown, &-twist.linear);
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
                    sink.add(closure, rows + i, &unit(i));
                    sink.add(closure + 3, rows + i, &unit(i).cross(&arm));
                    sink.add(closure + 3, rows + 3 + i, &unit(i));
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
        for (node, slot) in self.lowered.nodes.iter().zip(&self.layout.nodes) {
            let pose = read_pose(&self.x, slot.state);
            for (point, load, _) in &node.loads {
                let wrench = load.at(&pose.rotation) * self.load;
                let arm = pose.rotation * point;
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

    /// The spring's ends, global, nondimensional.
    pub(crate) fn spring_ends(&self, index: usize) -> [V; 2] {
        self.lowered.springs[index].ends.map(|(node, point)| self.node_pose(node).point(&point))
    }

    /// The law at the present load: the rest length moves from the initial length.
    pub(crate) fn spring_law(&self, index: usize) -> LinearSpring {
        let link = &self.lowered.springs[index];
        let rest = link.initial_length + self.load * (link.law.rest_length - link.initial_length);
        LinearSpring { rest_length: rest, ..link.law }
    }

    pub(crate) fn evaluate_springs(&self, sink: &mut Sink<'_>) {
        for (index, link) in self.lowered.springs.iter().enumerate() {
            let ends = self.spring_ends(index);
            let Some(force) = self.spring_law(index).between(&ends[0], &ends[1]) else {
                if let Some((Some(node), _)) = link.ends.iter().find(|(node, _)| node.is_some()) {
                    sink.r[self.layout.nodes[*node].unknown] = f64::NAN;
                }
                continue;
            };
            for (which, (node, _)) in link.ends.iter().enumerate() {
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
                for (other, (carrier, _)) in link.ends.iter().enumerate() {
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
    }
}
