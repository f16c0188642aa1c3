//! Loops of rigid bodies that are held more often than they need, but close nonetheless.
//!
//! A planar four-bar with four hinges is the common case: seen in space, its closure conditions repeat each other, and
//! equilibrium alone cannot tell how the hinges share forces across the plane. In the tangent at rest that shows as
//! null vectors made of joint wrenches only. For each one a closure row is left out and the
//! wrench's component that would enforce it is held at zero. That gives one set of wrenches in
//! equilibrium; the one of least norm (forces, and moments over L) is its projection across the null space
//! of the balance equations. Whether the rows left out are fulfilled is checked at the end.

use crate::couplings::closure_error;
use crate::diagnose::{SEEN, null_space_of};
use crate::system::Equilibrium;
use flexura_nonlinear::System;
use nalgebra::DMatrix;

/// Part of the largest force below which a cable counts as just taut.
const SLACK: f64 = 1e-7;
/// Closure error, relative to L and 1, from which a loop counts as not closing.
const OPEN: f64 = 1e-6;

impl Equilibrium {
    /// Leaves out closure rows that repeat others, if that is all that makes the tangent singular.
    pub(crate) fn find_slack(&mut self) -> bool {
        let mut null = self.null_space();
        let wrenches: Vec<usize> = self.layout.joints.iter().map(|slots| slots.wrench.unknown).collect();
        let owner = |unknown: usize| wrenches.iter().position(|w| (*w..w + 6).contains(&unknown));
        let foreign = |v: &Vec<f64>| v.iter().enumerate().any(|(i, x)| x.abs() > SEEN && owner(i).is_none());
        if null.is_empty() || null.iter().any(foreign) {
            return false;
        }
        let mut slack = vec![[false; 6]; wrenches.len()];
        let mut named = vec![false; wrenches.len()];
        for vector in &null {
            for (i, value) in vector.iter().enumerate() {
                if value.abs() > SEEN
                    && let Some(joint) = owner(i)
                {
                    named[joint] = true;
                }
            }
        }
        // Elimination with complete pivoting: the components that can be held at zero together.
        while let Some((k, i)) = largest(&null) {
            let Some(joint) = owner(i) else { return false };
            // Unknown: force, moment. Closure row: turning, shift.
            slack[joint][(i - wrenches[joint] + 3) % 6] = true;
            let pivot = null.swap_remove(k);
            for other in &mut null {
                let factor = other[i] / pivot[i];
                other.iter_mut().zip(&pivot).for_each(|(o, p)| *o -= factor * p);
            }
        }
        self.slack = slack;
        if self.linearise().is_err() {
            self.slack.clear();
            return false;
        }
        let names: Vec<String> = (0..named.len()).filter(|j| named[*j]).map(|j| self.joint_name(j)).collect();
        self.redundancy = Some(format!(
            "{} hold each other more often than the loop needs; it closes nonetheless, and among all forces in balance \
             those of least norm are given",
            names.join(", ")
        ));
        self.lowered.warnings.extend(self.redundancy.clone());
        self.held_twice = names;
        true
    }

    /// Takes back the warning that a loop closes though it is held too often: under load it does not. Returns the names of what
    /// holds it.
    pub fn withdraw_redundancy(&mut self) -> Vec<String> {
        if let Some(warning) = self.redundancy.take() {
            self.lowered.warnings.retain(|other| *other != warning);
        }
        self.held_twice.clone()
    }

    /// Replaces the wrenches of joints by those of least norm.
    pub(crate) fn least_norm(&mut self) {
        if self.slack.is_empty() {
            return;
        }
        // A factorised tangent is still needed by what goes on from here, with the residual that belongs to it.
        let (kept, r) = (self.tangent.clone(), self.r.clone());
        let evaluated = self.evaluate(true);
        let fresh = std::mem::replace(&mut self.tangent, kept);
        self.r = r;
        if evaluated.is_err() {
            return;
        }
        let joints = self.layout.joints.clone();
        let closures: Vec<usize> =
            joints.iter().flat_map(|j| j.wrench.unknown..j.wrench.unknown + 6).collect();
        let rows: Vec<usize> = (0..self.layout.interface).filter(|i| !closures.contains(i)).collect();
        // Rows of zeros make it tall enough for all of its null vectors.
        let height = rows.len().max(closures.len());
        let mut matrix = DMatrix::zeros(height, closures.len());
        let place = |list: &[usize], n: usize| {
            let mut place = vec![None; n];
            list.iter().enumerate().for_each(|(i, at)| place[*at] = Some(i));
            place
        };
        let (row, column) = (place(&rows, self.layout.interface), place(&closures, self.layout.interface));
        fresh.for_each(|i, j, value| {
            if let (Some(i), Some(j)) = (row[i], column[j]) {
                matrix[(i, j)] += value;
            }
        });
        let places: Vec<usize> = joints.iter().flat_map(|j| j.wrench.state..j.wrench.state + 6).collect();
        for vector in null_space_of(matrix) {
            let along: f64 = vector.iter().zip(&places).map(|(v, at)| v * self.x[*at]).sum();
            vector.iter().zip(&places).for_each(|(v, at)| self.x[*at] -= along * v);
        }
    }

    /// The joint at which a loop that was closed at rest stands open, and by how much (m, rad).
    pub fn open_loop(&self) -> Option<(String, f64, f64)> {
        (0..self.slack.len()).filter(|j| self.slack[*j].contains(&true)).find_map(|joint| {
            let (turn, shift) = closure_error(self, joint);
            (turn.norm() > OPEN || shift.norm() > OPEN)
                .then(|| (self.joint_name(joint), shift.norm() * self.lowered.scale.length, turn.norm()))
        })
    }
}

impl Equilibrium {
    /// A cable that would have to push to have its length, and with how much (N).
    pub fn slack_cable(&self) -> Option<(String, f64)> {
        let force = self.lowered.scale.force;
        let pushes = (0..self.lowered.ropes.len()).find(|&i| {
            self.layout.ropes[i].is_some()
                && self.tension(i)
                    < -SLACK * self.courses.iter().map(|course| course.most.force).fold(1.0, f64::max)
        })?;
        Some((format!("cable.{}", self.model.cables[pushes].name), -self.tension(pushes) * force))
    }
}

/// Vector and place of the largest number.
fn largest(null: &[Vec<f64>]) -> Option<(usize, usize)> {
    let all =
        null.iter().enumerate().flat_map(|(k, v)| v.iter().enumerate().map(move |(i, x)| (k, i, x.abs())));
    all.max_by(|a, b| a.2.total_cmp(&b.2)).map(|(k, i, _)| (k, i))
}
