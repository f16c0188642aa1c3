//! What elements leave of a shape, and a shape on other elements.

use super::Vibration;
use crate::system::Equilibrium;
use flexura_spatial::{Matrix3, Vector3, Vector6};

type V = Vector3<f64>;

impl Equilibrium {
    /// Part of ω² of a mode that its elements may not resolve, beside ω² x·M x.
    ///
    /// What an eigenvalue misses is the energy of what its vector misses (G. Strang and G. J. Fix, *An Analysis of the Finite Element
    /// Method*, 1973, ch. 6). Energies of the degrees of a smooth shape fall at least as fast from one to the next but one as they
    /// did before, so that the last four degrees tell those that are missing.
    pub fn unresolved(&self, vibration: &Vibration, x: &[f64], square: f64) -> f64 {
        let whole: f64 = vibration.inertia.iter().map(|(i, j, value)| value * x[*i] * x[*j]).sum();
        let mut energy = [0.0; 4];
        for (span, own) in vibration.spans.iter().enumerate() {
            let law = &self.lowered.beams[self.lowered.spans[span].beam];
            let order = own.rule.order;
            for (e, element) in own.list.iter().enumerate() {
                let [a, b] = element.s;
                let middle = 0.5 * (a + b);
                let half = 0.5 * (b - a) / law.scale.length;
                let compliance = law.scaled_law(middle).compliance;
                let mass = self.scaled_inertia(law, middle).0;
                let inverse: Matrix3<f64> = element.rotations[order / 2].transpose();
                let nodes: Vec<Vector6<f64>> = (0..=order)
                    .map(|node| {
                        let motions = self.node_motions(span, own, e, node);
                        motions
                            .iter()
                            .map(|(i, motion)| motion * vibration.columns[*i].map_or(0.0, |at| x[at]))
                            .sum()
                    })
                    .collect();
                let skipped = 4 - own.rule.tail.len();
                for ((degree, weights), energy) in own.rule.tail.iter().zip(&mut energy[skipped..]) {
                    let degree = *degree;
                    let last: Vector6<f64> =
                        nodes.iter().zip(weights).map(|(node, weight)| node * *weight).sum();
                    let turn = inverse * V::new(last[0], last[1], last[2]);
                    let slope = (degree * (degree + 1)) as f64 / half;
                    for i in 0..3 {
                        let soft = compliance[(3 + i, 3 + i)];
                        if soft > 0.0 {
                            *energy += slope * turn[i] * turn[i] / soft;
                        }
                    }
                    // Waves of stretching: their energy beside that of motion grows with the degree.
                    let shift = V::new(last[3], last[4], last[5]).norm_squared();
                    let per = (degree * degree) as f64 / 4.0;
                    *energy += per * square.abs() * mass * half * shift * 2.0 / (2 * degree + 1) as f64;
                }
            }
        }
        let missed: f64 =
            energy[2..].iter().zip(&energy).map(|(last, before)| last * (last / before).min(1.0)).sum();
        if square == 0.0 || whole <= 0.0 { 0.0 } else { missed / (square.abs() * whole) }
    }

    /// A vector of one pencil as one of another, of the same mechanism with other elements: its motions, without wrenches;
    /// zero where the two are not cut at the same places.
    pub fn vector_carried(&self, from: &Vibration, x: &[f64], to: &Vibration) -> Vec<f64> {
        let mut out = vec![0.0; to.size];
        let is_alike = from.layout.interface == to.layout.interface && from.spans.len() == to.spans.len();
        if !is_alike {
            return out;
        }
        let both = from.columns.iter().zip(&to.columns).take(to.layout.interface);
        for (from, to) in both {
            if let (Some(from), Some(to)) = (from, to) {
                out[*to] = x[*from];
            }
        }
        let swing = self.swing(from, x);
        for (span, own) in to.spans.iter().enumerate() {
            let beam = self.lowered.spans[span].beam;
            for (e, element) in own.list.iter().enumerate() {
                let [a, b] = element.s;
                for (node, at) in own.rule.nodes.iter().enumerate().skip(1) {
                    let Some(first) = own.node(e, node) else { continue };
                    let twist = swing.beam(beam, a + (b - a) * 0.5 * (1.0 + at));
                    let shift = twist.linear / to.length;
                    let values = twist.angular.iter().chain(shift.iter());
                    for (i, value) in values.enumerate() {
                        if let Some(column) = to.columns[first + i] {
                            out[column] = *value;
                        }
                    }
                }
            }
        }
        out
    }
}
