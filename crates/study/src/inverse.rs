//! Known and unknown exchanged: parameters found so that results have wanted values.
//!
//! The square system is r(x, p) = 0 with targets g(x, p) = 0. Each Newton step borders the tangent J that the
//! forward problem has anyway: with u = -J⁻¹ r and V = -J⁻¹ ∂r/∂p,
//!
//! ```text
//!   S dp = -(g + ∂g/∂x u),    S = ∂g/∂p + ∂g/∂x V,    dx = u + V dp,
//! ```
//!
//! which works past folds of the forward problem too, where J changes its sign but S stays regular. Derivatives of the
//! targets are directional differences; S is only used to step, so their error does not enter the answer. The targets are led
//! from what they are at the guess to what is wanted, in as few steps as Newton's contraction allows.

use crate::family::{Family, SMALL, size_of};
use crate::sensitivity::SensitivityError;
use crate::solve::What;
use crate::{Outcome, Prepared, Progress};
use flexura_equilibrium::ProblemError;
use flexura_nonlinear::System;
use flexura_solution::Status;
use flexura_spatial::singular_values;
use nalgebra::{DMatrix, DVector};

/// Turning (rad), or relative change of a parameter, in a first correction beyond which a step of the targets is
/// shortened. Wrenches may jump: they follow the shape.
const NEAR: f64 = 0.5;
/// Part of a unit that an unknown near zero may change by at once.
const REACH: f64 = 0.05;
/// Contraction that a step must show, and that lets the old derivatives serve on.
const CONTRACTING: f64 = 0.5;
const FAST: f64 = 0.1;
/// Contraction of the last corrections that lets them serve the next targets, too.
const VERY_FAST: f64 = 0.01;
/// Shortest step of the targets, and most of them.
const SHORTEST: f64 = 1e-5;
const MOST: usize = 2000;
/// Singular values of S below this part of the largest count as zero.
const RANK: f64 = 1e-9;
/// Relative step of the differences.
const DIFFERENCE: f64 = 1e-4;

/// V, S and what they are scaled by; kept from one correction to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Border {
    along: Vec<Vec<f64>>,
    matrix: DMatrix<f64>,
    /// The last correction over the one before.
    contraction: f64,
}

/// How a correction went.
enum Corrected {
    /// Its size.
    By(f64),
    Singular(String),
    Failed(String),
}

impl From<SensitivityError> for Corrected {
    fn from(error: SensitivityError) -> Self {
        Corrected::Failed(error.to_string())
    }
}

impl Prepared {
    /// Finds the parameters: first the equilibrium at the guess, then on to the targets. The model at the end, with the
    /// values found, is [`flexura_equilibrium::Equilibrium::model`].
    pub fn solve_inverse(
        &mut self,
        family: &mut dyn Family,
        tolerance: f64,
        progress: &mut dyn FnMut(Progress),
    ) -> Outcome {
        let forward = self.solve(tolerance, progress);
        if forward.status == Status::Interrupted {
            return forward;
        }
        if forward.status != Status::Converged {
            let reason = forward.reason.unwrap_or_default();
            return Outcome {
                reason: Some(format!("at the guess of the unknown parameters: {reason}")),
                ..forward
            };
        }
        self.border = None;
        self.lead(family, tolerance, forward)
    }

    /// From the present equilibrium, which should be near, to the targets that `family`'s model has now.
    pub fn solve_inverse_from_here(&mut self, family: &mut dyn Family, tolerance: f64) -> Outcome {
        let values = self.unknown_values();
        if let Err(error) = self.put(family, &values) {
            return Outcome {
                status: Status::Stalled,
                reason: Some(error.message),
                ending: None,
                error_estimate: f64::NAN,
                path: flexura_nonlinear::PathWork::default(),
            };
        }
        let start = Outcome {
            status: Status::Converged,
            reason: None,
            ending: None,
            error_estimate: f64::NAN,
            path: flexura_nonlinear::PathWork { taken: 1, ..Default::default() },
        };
        self.lead(family, tolerance, start)
    }

    /// The values of the unknown parameters.
    pub(crate) fn unknown_values(&self) -> Vec<(usize, f64)> {
        let model = self.model();
        model.unknowns.iter().map(|u| (u.parameter, model.parameters[u.parameter].value)).collect()
    }

    /// The same with one parameter, unknown or not, at another value.
    pub(crate) fn values_with(&self, parameter: usize, value: f64) -> Vec<(usize, f64)> {
        let mut values = self.unknown_values();
        values.retain(|(other, _)| *other != parameter);
        values.push((parameter, value));
        values
    }

    fn lead(&mut self, family: &mut dyn Family, tolerance: f64, outcome: Outcome) -> Outcome {
        let outcome = self.lead_on(family, tolerance, outcome);
        if outcome.status == Status::Converged || !self.problem.is_interrupted() {
            return outcome;
        }
        // Whatever the last steps made of that.
        let reason = "interrupted on the way from the guess to the targets".to_string();
        Outcome { status: Status::Interrupted, reason: Some(reason), error_estimate: f64::NAN, ..outcome }
    }

    fn lead_on(&mut self, family: &mut dyn Family, tolerance: f64, mut outcome: Outcome) -> Outcome {
        let stop = |status, reason: String, outcome: Outcome| Outcome {
            status,
            reason: Some(reason),
            error_estimate: f64::NAN,
            ..outcome
        };
        let wanted: Vec<f64> = self.model().targets.iter().map(|t| t.value).collect();
        // Asked for where the whole way cannot be gone at once.
        let mut start: Option<Vec<f64>> = None;
        let (mut part, mut step) = (0.0, 1.0_f64);
        let mut steps = 0;
        while part < 1.0 {
            let next = if part + step > 1.0 - 1e-9 { 1.0 } else { part + step };
            if next < 1.0 && start.is_none() {
                start = match self.targets_here() {
                    Ok(values) => Some(values),
                    Err(error) => return stop(Status::Stalled, error.to_string(), outcome),
                };
            }
            let goal: Vec<f64> = match &start {
                Some(start) if next < 1.0 => {
                    start.iter().zip(&wanted).map(|(a, b)| a + next * (b - a)).collect()
                }
                _ => wanted.clone(),
            };
            let mut kept = Vec::new();
            self.problem.store(&mut kept);
            let values = self.unknown_values();
            steps += 1;
            let loose = if next < 1.0 { 1e-4 } else { tolerance.max(1e-9) };
            match self.approach(family, &goal, loose) {
                Corrected::By(_) => {
                    part = next;
                    step *= 2.0;
                }
                Corrected::Singular(names) => {
                    return stop(
                        Status::Singular,
                        format!("the unknown parameters cannot be told apart by the targets: {names}"),
                        outcome,
                    );
                }
                Corrected::Failed(reason) => {
                    self.border = None;
                    self.problem.restore(&kept);
                    if let Err(error) = self.put(family, &values) {
                        return stop(Status::Stalled, error.message, outcome);
                    }
                    step *= 0.5;
                    if step < SHORTEST || steps > MOST {
                        return stop(
                            Status::Stalled,
                            format!(
                                "{:.2} % of the way from the guess to the targets can be gone: {reason}; start from another \
                                 guess, or ask for what the mechanism can reach",
                                100.0 * part
                            ),
                            outcome,
                        );
                    }
                }
            }
        }
        outcome.path.taken += steps - 1;
        self.settle(family, &wanted, tolerance, outcome)
    }

    /// The last digits: the mesh for the wanted accuracy, and the targets met on it.
    fn settle(
        &mut self,
        family: &mut dyn Family,
        wanted: &[f64],
        tolerance: f64,
        outcome: Outcome,
    ) -> Outcome {
        let mut last = outcome;
        for _ in 0..4 {
            // However far that is; the tangent of the last corrections serves on.
            last = self.finish(tolerance, last.path, f64::MAX);
            if last.status != Status::Converged {
                return last;
            }
            match self.approach(family, wanted, tolerance) {
                // On the mesh that has proved its accuracy, the answer moved by less than the accuracy.
                Corrected::By(moved) if moved <= 10.0 * tolerance => {
                    if self.border.as_ref().is_some_and(|border| border.contraction > VERY_FAST) {
                        self.border = None;
                    }
                    return last;
                }
                Corrected::By(_) => {}
                Corrected::Singular(reason) | Corrected::Failed(reason) => {
                    return Outcome { status: Status::Stalled, reason: Some(reason), ..last };
                }
            }
        }
        let reason = "the parameters keep moving by more than the tolerance when the mesh is made for them; ask for a larger tolerance";
        Outcome::without(Status::AccuracyLimit, reason.to_string(), last.error_estimate, last.path)
    }

    /// Newton to the goal; the size of the first correction when it has converged.
    fn approach(&mut self, family: &mut dyn Family, goal: &[f64], tolerance: f64) -> Corrected {
        let mut first = None;
        let mut before = f64::INFINITY;
        for _ in 0..30 {
            // A mesh of other segments has other unknowns.
            let n = self.problem.unknowns();
            let fits = self.border.as_ref().is_some_and(|b| b.along.iter().all(|v| v.len() == n));
            let fresh = !(fits && self.problem.has_tangent());
            if fresh {
                self.border = None;
            }
            if fresh && let Err(end) = self.renew_border(family) {
                return end;
            }
            let size =
                match self.correct_once(family, goal, if first.is_none() { NEAR } else { f64::INFINITY }) {
                    Corrected::By(size) => size,
                    Corrected::Failed(_) if !fresh => {
                        self.border = None;
                        continue;
                    }
                    end => return end,
                };
            let moved = *first.get_or_insert(size);
            let mut rate = 1.0;
            if let Some(border) = &mut self.border {
                // What served before to this rate is taken to do so again.
                let known = if before.is_finite() { size / before } else { border.contraction };
                if known > 0.0 {
                    rate = known.clamp(VERY_FAST, 1.0);
                }
                border.contraction = known;
            }
            // What is left is so much less than the correction that was made.
            if rate * size <= 0.1 * tolerance {
                return Corrected::By(moved);
            }
            if size > CONTRACTING * before {
                // Round-off ends the contraction where everything that can be reached is reached.
                if size <= tolerance.max(1e-10) {
                    return Corrected::By(moved);
                }
                if fresh {
                    return Corrected::Failed("the corrections do not get smaller".to_string());
                }
            }
            if size > FAST * before {
                self.border = None;
            }
            before = size;
        }
        Corrected::Failed("too many corrections".to_string())
    }

    /// One correction of state and parameters.
    fn correct_once(&mut self, family: &mut dyn Family, goal: &[f64], nearest: f64) -> Corrected {
        let Some(border) = self.border.take() else { return Corrected::Failed("no tangent".to_string()) };
        let n = self.problem.unknowns();
        let mut step = vec![0.0; n];
        if self.problem.residual().is_err() {
            return Corrected::Failed("a number overflowed".to_string());
        }
        self.problem.newton_step(&mut step);
        let left = match self.targets_after(&step) {
            Ok(values) => DVector::from_iterator(goal.len(), goal.iter().zip(&values).map(|(a, b)| a - b)),
            Err(error) => return error.into(),
        };
        let Some(change) = border.matrix.clone().lu().solve(&left) else {
            return Corrected::Failed("the border has no inverse".to_string());
        };
        for (along, dp) in border.along.iter().zip(change.iter()) {
            step.iter_mut().zip(along).for_each(|(s, v)| *s += v * dp);
        }
        let values = self.unknown_values();
        let relative = |sizes: Vec<f64>| {
            change.iter().zip(&sizes).map(|(dp, size)| (dp / size).abs()).fold(0.0, f64::max)
        };
        let size = self.problem.size(&step).max(relative(self.parameter_sizes(SMALL)));
        let reach = self.problem.turning(&step).max(relative(self.parameter_sizes(REACH)));
        if !size.is_finite() || reach > nearest {
            self.border = Some(border);
            return Corrected::Failed(format!("a correction of {reach:.1e} is needed"));
        }
        let mut moved = Vec::with_capacity(values.len());
        for ((unknown, (parameter, value)), dp) in
            self.model().unknowns.clone().iter().zip(&values).zip(change.iter())
        {
            let next = value + dp;
            if let Some([low, high]) = unknown.range
                && (next < low - 1e-9 * (high - low) || next > high + 1e-9 * (high - low))
            {
                let parameter = &self.model().parameters[*parameter];
                let unit = if parameter.unit.is_empty() { "" } else { " " };
                return Corrected::Failed(format!(
                    "the parameter `{}` would leave its range with {next:.6e}{unit}{}",
                    parameter.name, parameter.unit
                ));
            }
            moved.push((*parameter, next));
        }
        self.problem.retract(&step);
        if let Err(error) = self.put(family, &moved) {
            return Corrected::Failed(error.message);
        }
        self.border = Some(border);
        Corrected::By(size)
    }

    /// J, V and S at the present state.
    fn renew_border(&mut self, family: &mut dyn Family) -> Result<(), Corrected> {
        if let Err(breakdown) = self.problem.linearise() {
            return Err(SensitivityError::Tangent(breakdown).into());
        }
        let values = self.unknown_values();
        let sizes = self.parameter_sizes(SMALL);
        let count = values.len();
        let mut border = Border {
            along: Vec::with_capacity(count),
            matrix: DMatrix::zeros(count, count),
            contraction: 0.0,
        };
        let mut kept = Vec::new();
        self.problem.store(&mut kept);
        for (k, ((parameter, value), size)) in values.iter().zip(&sizes).enumerate() {
            let h = DIFFERENCE * size;
            let mut laws = Vec::with_capacity(2);
            for sign in [1.0, -1.0] {
                let values = self.values_with(*parameter, value + sign * h);
                laws.push((sign, family.law(&self.problem, &values).map_err(SensitivityError::Model)?));
            }
            let mut along = vec![0.0; self.problem.unknowns()];
            let mut step = along.clone();
            for (sign, law) in laws.clone() {
                let own = self.problem.exchange(law);
                let outcome = self.problem.residual();
                self.problem.newton_step(&mut step);
                self.problem.exchange(own);
                self.problem.restore(&kept);
                outcome.map_err(SensitivityError::Tangent)?;
                along.iter_mut().zip(&step).for_each(|(a, s)| *a += sign * s / (2.0 * h));
            }
            for (sign, law) in laws {
                let own = self.problem.exchange(law);
                let step: Vec<f64> = along.iter().map(|v| v * sign * h).collect();
                let values = self.targets_after(&step);
                self.problem.exchange(own);
                self.problem.restore(&kept);
                for (i, value) in values?.iter().enumerate() {
                    border.matrix[(i, k)] += sign * value / (2.0 * h);
                }
            }
            border.along.push(along);
        }
        // Targets that ask for compliances have factorised other tangents.
        if self.asks_for_tangents() && self.problem.linearise().is_err() {
            return Err(Corrected::Failed("the tangent has no inverse".to_string()));
        }
        if let Some(names) = self.not_told_apart(&border.matrix, &sizes) {
            return Err(Corrected::Singular(names));
        }
        self.border = Some(border);
        Ok(())
    }

    /// The parameters and targets in the null space of S.
    fn not_told_apart(&self, matrix: &DMatrix<f64>, sizes: &[f64]) -> Option<String> {
        let n = matrix.nrows();
        let mut scaled = matrix.clone();
        for j in 0..n {
            scaled.column_mut(j).scale_mut(sizes[j]);
        }
        for i in 0..n {
            let largest = scaled.row(i).amax();
            if largest > 0.0 {
                scaled.row_mut(i).unscale_mut(largest);
            }
        }
        let svd = singular_values(scaled, true, true)?;
        let (u, vt) = (svd.u?, svd.v_t?);
        let largest = svd.singular_values.max();
        let k = svd.singular_values.iter().position(|s| *s <= RANK * largest)?;
        let model = self.model();
        let seen = |v: f64| v.abs() > 1e-3;
        let parameters = (0..n)
            .filter(|j| seen(vt[(k, *j)]))
            .map(|j| format!("parameter.{}", model.parameters[model.unknowns[j].parameter].name));
        let targets = (0..n)
            .filter(|i| seen(u[(*i, k)]))
            .map(|i| format!("target \"{}\"", model.targets[i].output.name));
        Some(format!(
            "{} on the one side, {} on the other",
            parameters.collect::<Vec<_>>().join(", "),
            targets.collect::<Vec<_>>().join(", ")
        ))
    }

    fn parameter_sizes(&self, part: f64) -> Vec<f64> {
        let (units, model) = (self.problem.units(), self.model());
        model.unknowns.iter().map(|u| size_of(model, u.parameter, units, part)).collect()
    }

    /// Puts the model with these values under the present state.
    fn put(&mut self, family: &mut dyn Family, values: &[(usize, f64)]) -> Result<(), ProblemError> {
        let law = family.law(&self.problem, values)?;
        self.problem.exchange(law);
        Ok(())
    }

    fn targets_here(&mut self) -> Result<Vec<f64>, SensitivityError> {
        let solution = self.light_solution(What::Targets)?;
        Ok(flexura_post::targets(self.problem.model(), &solution)?)
    }

    /// The targets after a step of the state, which is taken back.
    fn targets_after(&mut self, step: &[f64]) -> Result<Vec<f64>, SensitivityError> {
        let mut kept = Vec::new();
        self.problem.store(&mut kept);
        self.problem.retract(step);
        let values = self.targets_here();
        self.problem.restore(&kept);
        values
    }
}
