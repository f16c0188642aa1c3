//! What the tangent at an equilibrium says: how a body or a place on a beam gives way to a small load there, and how
//! it moves as the load grows.

use crate::system::Equilibrium;
use flexura_model::{BeamPoint, Mount, ProbeTarget};
use flexura_nonlinear::{Breakdown, System};
use flexura_solution::TangentSolution;
use flexura_spatial::{Matrix6, Twist, Vector3};

/// Part of the load by which the motion along the load is found, by differences of order six.
const PART: f64 = 1e-2;
/// Part of the largest compliance below which another one cannot be told from nothing. A strip whose thickness is a
/// hundred thousandth of its length stretches by 8e-12 of what it bends.
const ROUND_OFF: f64 = 1e-13;

impl Equilibrium {
    /// The node of a body, or of a place on a beam at which there is one.
    fn node_of_target(&self, target: ProbeTarget) -> Option<usize> {
        match target {
            ProbeTarget::Body(id) => Some(id.0),
            ProbeTarget::Beam(beam, at) => self.lowered.hub_at(&BeamPoint { beam, at }),
            _ => None,
        }
    }

    /// Turning and shift of a node in a step, SI.
    fn motion_in(&self, node: usize, step: &[f64]) -> Twist {
        let at = self.layout.nodes[node].unknown;
        let triple = |i: usize| Vector3::new(step[at + i], step[at + i + 1], step[at + i + 2]);
        Twist { angular: triple(0), linear: triple(3) * self.lowered.scale.length }
    }

    /// The step of the state per unit of the load fraction at an equilibrium: all loads, drives and misfits grow in
    /// proportion. The tangent must have been factorised there.
    pub fn response(&mut self) -> Result<Vec<f64>, Breakdown> {
        let n = self.unknowns();
        let load = self.load;
        let mut kept = Vec::new();
        self.store(&mut kept);
        let mut sum = vec![0.0; n];
        let mut step = vec![0.0; n];
        for (factor, weight) in CENTRAL {
            self.set_load(load + factor * PART);
            let outcome = self.residual();
            self.newton_step(&mut step);
            self.set_load(load);
            self.restore(&kept);
            outcome?;
            sum.iter_mut().zip(&step).for_each(|(s, d)| *s += weight / PART * d);
        }
        Ok(sum)
    }

    /// Compliances and motions of bodies and places on beams at the present equilibrium.
    ///
    /// A unit dead force and moment on the origin of each changes only its balance; the tangent's answer is the motion.
    ///
    /// # Errors
    /// The tangent has no inverse there.
    pub fn tangents(&mut self, targets: &[ProbeTarget]) -> Result<Vec<TangentSolution>, Breakdown> {
        if targets.is_empty() {
            return Ok(Vec::new());
        }
        self.linearise()?;
        let along = self.response()?;
        let scale = self.lowered.scale;
        let mut step = vec![0.0; self.unknowns()];
        let mut all = Vec::with_capacity(targets.len());
        for &target in targets {
            let Some(node) = self.node_of_target(target) else { continue };
            let row = self.layout.nodes[node].unknown;
            let mut compliance = Matrix6::zeros();
            for column in 0..6 {
                self.r.fill(0.0);
                self.gaps.iter_mut().flatten().for_each(|gap| *gap = [0.0; 12]);
                // Rows: moment, then force; columns of the compliance: force, then moment.
                self.r[row + (column + 3) % 6] =
                    if column < 3 { 1.0 / scale.force } else { 1.0 / scale.moment() };
                self.newton_step(&mut step);
                let motion = self.motion_in(node, &step);
                for i in 0..3 {
                    compliance[(i, column)] = motion.linear[i];
                    compliance[(3 + i, column)] = motion.angular[i];
                }
            }
            clear_round_off(&mut compliance, scale.length);
            let motion = self.motion_in(node, &along);
            all.push(TangentSolution { target, compliance: Some(compliance), motion });
        }
        Ok(all)
    }

    /// How every body moves in a step of the state: motion of its origin (m) and turning (rad).
    pub fn body_motions(&self, step: &[f64]) -> Vec<Twist> {
        (0..self.model.bodies.len()).map(|node| self.motion_in(node, step)).collect()
    }

    /// Can compliances be had of this place? On a beam only where a node was put when the problem was prepared.
    pub fn has_node(&self, mount: Mount) -> bool {
        match mount {
            Mount::Ground => false,
            Mount::Body(_) => true,
            Mount::Beam(point) => self.lowered.hub_at(&point).is_some(),
        }
    }
}

/// What is round-off beside the largest entry is nothing: a motion that is driven or held gives way by exactly zero.
/// Entries are compared as if lengths were counted in `length` (m).
fn clear_round_off(compliance: &mut Matrix6<f64>, length: f64) {
    // Motion per load: m/N, 1/N, 1/N, 1/(N m); times these factors all are in m/N.
    let factor = |i: usize, j: usize| match (i < 3, j < 3) {
        (true, true) => 1.0,
        (false, false) => length * length,
        _ => length,
    };
    let size = |i: usize, j: usize, value: f64| value.abs() * factor(i, j);
    let mut largest = 0.0f64;
    for j in 0..6 {
        for i in 0..6 {
            largest = largest.max(size(i, j, compliance[(i, j)]));
        }
    }
    for j in 0..6 {
        for i in 0..6 {
            if size(i, j, compliance[(i, j)]) < ROUND_OFF * largest {
                compliance[(i, j)] = 0.0;
            }
        }
    }
}

/// Places and weights of central differences of order six for a first derivative.
pub const CENTRAL: [(f64, f64); 6] = [
    (1.0, 45.0 / 60.0),
    (-1.0, -45.0 / 60.0),
    (2.0, -9.0 / 60.0),
    (-2.0, 9.0 / 60.0),
    (3.0, 1.0 / 60.0),
    (-3.0, -1.0 / 60.0),
];
