//! How a vector of the pencil moves beams and bodies.

use super::Vibration;
use crate::stability::Motions;
use crate::system::Equilibrium;
use flexura_spatial::{Twist, Vector3, Vector6};

type V = Vector3<f64>;

/// An element: arc lengths (m) of its ends, and turning and shift of its nodes.
type Part = ([f64; 2], Vec<Vector6<f64>>);

/// A small motion of everything.
#[derive(Clone, Debug)]
pub struct Swing {
    /// Of every body: turning (rad) and shift (m) of its origin.
    pub bodies: Vec<Twist>,
    /// For each beam its elements in order.
    beams: Vec<Vec<Part>>,
    rule: Vec<std::sync::Arc<super::rule::Rule>>,
    length: f64,
}

impl Swing {
    /// Arc lengths (m) along a beam, close enough that no more than one zero of the motion lies between two of them, ends included.
    pub fn places(&self, beam: usize) -> Vec<f64> {
        let parts = 3 * self.rule.first().map_or(1, |rule| rule.order);
        let mut places = vec![0.0];
        for (ends, _) in &self.beams[beam] {
            places.extend((1..=parts).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / parts as f64));
        }
        places
    }

    /// The motion of a beam's section at an arc length (m).
    pub fn beam(&self, beam: usize, s: f64) -> Twist {
        let list = &self.beams[beam];
        let k = list.partition_point(|(ends, _)| ends[1] < s).min(list.len().saturating_sub(1));
        let (Some((ends, nodes)), Some(rule)) = (list.get(k), self.rule.first()) else {
            return Twist { angular: V::zeros(), linear: V::zeros() };
        };
        let x = (2.0 * (s - ends[0]) / (ends[1] - ends[0]) - 1.0).clamp(-1.0, 1.0);
        let values = rule.weights_at(x);
        let sum: Vector6<f64> = nodes.iter().zip(&values).map(|(node, value)| node * *value).sum();
        Twist {
            angular: V::new(sum[0], sum[1], sum[2]),
            linear: V::new(sum[3], sum[4], sum[5]) * self.length,
        }
    }
}

impl Equilibrium {
    /// Lengths of the beams, m.
    pub fn beam_lengths(&self) -> Vec<f64> {
        self.lowered.beams.iter().map(|law| law.length).collect()
    }

    /// Mass per length (kg/m) of a beam at an arc length (m), and its largest moment of inertia per length (kg·m).
    pub fn inertia_of(&self, beam: usize, s: f64) -> (f64, f64) {
        let (mass, rotary) = self.lowered.beams[beam].mass_at(s);
        (mass, rotary.into_iter().fold(0.0, f64::max))
    }

    /// Why this version has no stiffness and inertia of the mechanism; None where it has.
    pub fn without_vibration(&self) -> Option<String> {
        let tubes = self.model.tubes.first()?;
        Some(format!(
            "tubes.{}: concentric tubes turn within each other, and the modes of such a bundle are not built yet",
            tubes.name
        ))
    }

    /// What moves most in a vector of the pencil, by its path.
    pub fn loosest(&self, vibration: &Vibration, x: &[f64]) -> Option<String> {
        let swing = self.swing(vibration, x);
        let size = |twist: &Twist| twist.angular.norm() + twist.linear.norm() / vibration.length;
        let bodies = swing.bodies.iter().zip(&self.model.bodies);
        let mut all: Vec<(f64, String)> =
            bodies.map(|(twist, body)| (size(twist), format!("body.{}", body.name))).collect();
        for (i, beam) in self.model.beams.iter().enumerate() {
            let length = self.lowered.beams[i].length;
            let most =
                [0.0, 0.5, 1.0].map(|at| size(&swing.beam(i, at * length))).into_iter().fold(0.0, f64::max);
            // What a body moves alike is the body's.
            all.push((0.99 * most, format!("beam.{}", beam.name)));
        }
        let most = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        (most.0 > 0.0).then_some(most.1)
    }

    /// How bodies and beams move in a vector of the pencil at this state.
    pub fn swing(&self, vibration: &Vibration, x: &[f64]) -> Swing {
        let length = vibration.length;
        let value = |plain: usize| vibration.columns[plain].map_or(0.0, |at| x[at]);
        let along = |motions: &Motions| -> Vector6<f64> {
            motions.iter().map(|(unknown, x)| x * value(*unknown)).sum()
        };
        let bodies = (0..self.model.bodies.len()).map(|body| {
            let first = vibration.layout.nodes[body].unknown;
            let v = Vector6::from_fn(|i, _| value(first + i));
            Twist { angular: V::new(v[0], v[1], v[2]), linear: V::new(v[3], v[4], v[5]) * length }
        });
        let mut beams = vec![Vec::new(); self.model.beams.len()];
        for (span, own) in vibration.spans.iter().enumerate() {
            let list = &mut beams[self.lowered.spans[span].beam];
            for (e, element) in own.list.iter().enumerate() {
                let nodes = (0..=own.rule.order).map(|node| along(&self.node_motions(span, own, e, node)));
                list.push((element.s, nodes.collect()));
            }
        }
        for list in &mut beams {
            list.sort_by(|a: &Part, b| a.0[0].total_cmp(&b.0[0]));
        }
        let rule = vibration.spans.first().map(|own| own.rule.clone()).into_iter().collect();
        Swing { bodies: bodies.collect(), beams, rule, length }
    }
}
