//! What drives a pencil from outside, as vectors of its unknowns.

use super::Vibration;
use crate::system::Equilibrium;
use flexura_model::{LoadFrame, LoadTarget};
use flexura_spatial::{Matrix3, Vector3, Vector6, Wrench};

type V = Vector3<f64>;

impl Equilibrium {
    /// What a small wrench (N, N·m) does on the unknowns of a pencil at the place of a point load, in the axes in which this load is
    /// given: K x - ω² M x = b.
    pub fn drive_by_load(&self, vibration: &Vibration, load: usize, wrench: &Wrench) -> Vec<f64> {
        let mut out = vec![0.0; vibration.size];
        let scale = self.lowered.scale;
        let Some(load) = self.model.loads.get(load) else { return out };
        let turned = |rotation: &Matrix3<f64>, v: &V| match load.frame {
            LoadFrame::Global => *v,
            LoadFrame::Local => rotation * v,
        };
        let six = |rotation: &Matrix3<f64>, arm: &V| -> Vector6<f64> {
            let force = turned(rotation, &wrench.force) / scale.force;
            let moment = turned(rotation, &wrench.moment) / (scale.force * scale.length) + arm.cross(&force);
            Vector6::new(moment.x, moment.y, moment.z, force.x, force.y, force.z)
        };
        let mut add = |plain: usize, value: f64| {
            if let Some(at) = vibration.columns[plain] {
                out[at] += value;
            }
        };
        match &load.target {
            LoadTarget::Body { body, point } => {
                let rotation = self.node_pose(Some(body.0)).rotation.to_rotation_matrix().into_inner();
                let b = six(&rotation, &(rotation * point / scale.length));
                let first = self.layout.nodes[body.0].unknown;
                (0..6).for_each(|i| add(first + i, b[i]));
            }
            LoadTarget::Beam(point) => {
                let whole = self.lowered.beams[point.beam.0].length;
                let s = point.at.arc_length(whole);
                let tiny = 1e-9 * whole;
                let spans = || vibration.spans.iter().enumerate();
                let place = spans().find_map(|(span, own)| {
                    let is_own = self.lowered.spans[span].beam == point.beam.0;
                    let e = own
                        .list
                        .iter()
                        .position(|element| s <= element.s[1] + tiny && s >= element.s[0] - tiny)?;
                    is_own.then_some((span, own, e))
                });
                let Some((span, own, e)) = place else { return out };
                let element = &own.list[e];
                let x = (2.0 * (s - element.s[0]) / (element.s[1] - element.s[0]) - 1.0).clamp(-1.0, 1.0);
                let nearest = if x < 0.0 { 0 } else { own.rule.order };
                let b = six(&element.rotations[nearest], &V::zeros());
                for (node, weight) in own.rule.weights_at(x).into_iter().enumerate() {
                    for (unknown, motion) in self.node_motions(span, own, e, node) {
                        add(unknown, weight * motion.dot(&b));
                    }
                }
            }
        }
        out
    }

    /// What an acceleration of 1 m/s² of the ground along an axis does on the unknowns of a pencil in motions relative to the ground.
    pub fn drive_by_ground(&self, vibration: &Vibration, axis: usize) -> Vec<f64> {
        let unit = vibration.length * vibration.unit;
        vibration.rigid[axis].iter().map(|value| -value / unit).collect()
    }
}
