//! How outputs depend on parameters at an equilibrium.
//!
//! The equilibrium r(x, p) = 0 moves with a parameter by `dx/dp = -J⁻¹ ∂r/∂p`, J factorised once. The load, geometry,
//! material or drive behind p enters r through sections, rest shapes and places, so ∂r/∂p is the derivative
//! of the residual at a standing state, and with the direction (dx/dp, 1) an output is a function of one number whose
//! derivative at zero is wanted. No equilibrium is solved again; the differences are those of `slope.rs`, of order four where that is
//! enough. What is left of them is about 1e-11 of the derivative.

use crate::Prepared;
use crate::family::{Family, SMALL, size_of};
use crate::slope::{Order, Slope};
use crate::solve::What;
use flexura_equilibrium::ProblemError;
use flexura_model::Model;
use flexura_nonlinear::{Breakdown, System};
use flexura_post::{OutputValue, PostError};
use flexura_solution::{Sensitivities, Solution};
use flexura_spatial::{Twist, Vector3};
use nalgebra::{DMatrix, DVector};

/// Relative step of differences of order four, and their relative distance from those of order two that is good enough: they are then
/// wrong by some 1e-11.
const LIGHT: f64 = 1e-3;
const NEAR: f64 = 3e-6;
/// First relative step of those of order six, and by how much the next ones are shorter.
const FIRST: f64 = 2e-3;
const SHORTER: f64 = 0.25;
/// Relative difference of the orders four and six that is good enough: the sixth is then wrong by some 1e-12. How many steps are
/// tried.
const AGREED: f64 = 1e-8;
const TRIES: i32 = 5;
/// Round-off of what is read off, beside its size, over the first step.
const ROUND: f64 = 1e-13;
/// Parameters that a warning names.
const TOLD: usize = 5;

/// Why derivatives cannot be had.
#[derive(Clone, Debug)]
pub enum SensitivityError {
    /// The tangent has no inverse at the equilibrium.
    Tangent(Breakdown),
    /// A neighbouring model is none.
    Model(ProblemError),
    /// An output has no value.
    Output(PostError),
}

impl std::fmt::Display for SensitivityError {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            SensitivityError::Tangent(Breakdown::Interrupted) => {
                formatter.write_str("no sensitivities: interrupted")
            }
            SensitivityError::Tangent(_) => {
                formatter.write_str("no sensitivities: the equilibrium is at a fold or branch point")
            }
            SensitivityError::Model(error) => {
                write!(formatter, "no sensitivities: {} {}", error.path, error.message)
            }
            SensitivityError::Output(error) => write!(formatter, "no sensitivities: {error}"),
        }
    }
}

impl SensitivityError {
    /// Why one parameter alone is left out: what is wrong with the mechanisms next to this one.
    fn of_neighbours(self) -> String {
        match self {
            SensitivityError::Tangent(Breakdown::Interrupted) => "interrupted".to_string(),
            SensitivityError::Tangent(_) => {
                "the mechanism next to this one gives no sound numbers".to_string()
            }
            SensitivityError::Model(error) => error.message,
            SensitivityError::Output(error) => error.to_string(),
        }
    }
}

/// What to know of sensitivities that are not there.
pub(crate) fn warnings(model: &Model, solution: &Solution, found: &Sensitivities) -> Vec<String> {
    let name = |parameter: usize| format!("`{}`", model.parameters[parameter].name);
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for (parameter, reason) in &found.left_out {
        match reasons.iter_mut().find(|(known, _)| known == reason) {
            Some((_, names)) => names.push(name(*parameter)),
            None => reasons.push((reason, vec![name(*parameter)])),
        }
    }
    let mut warnings: Vec<String> = reasons
        .into_iter()
        .map(|(reason, names)| format!("no sensitivities to {}: {reason}", listed(names)))
        .collect();
    let values = flexura_post::each_output(model, solution);
    for (output, components) in values.iter().zip(&found.outputs) {
        let Ok(output) = output else { continue };
        let lacks = |column: &usize| components.iter().any(|component| component[*column].is_none());
        let names: Vec<String> =
            (0..found.parameters.len()).filter(lacks).map(|column| name(found.parameters[column])).collect();
        if !names.is_empty() {
            let (names, output) = (listed(names), &output.name);
            warnings.push(format!(
                "no sensitivity of `{output}` to {names}: next to this equilibrium it has no value"
            ));
        }
    }
    warnings
}

/// Names of which only the first few are told.
fn listed(mut names: Vec<String>) -> String {
    let more = names.len().saturating_sub(TOLD);
    if more > 1 {
        names.truncate(TOLD);
        names.push(format!("{more} more"));
    }
    match names.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => names.concat(),
    }
}

impl From<Breakdown> for SensitivityError {
    fn from(breakdown: Breakdown) -> Self {
        SensitivityError::Tangent(breakdown)
    }
}

impl From<ProblemError> for SensitivityError {
    fn from(error: ProblemError) -> Self {
        SensitivityError::Model(error)
    }
}

impl From<PostError> for SensitivityError {
    fn from(error: PostError) -> Self {
        SensitivityError::Output(error)
    }
}

impl Prepared {
    /// The outputs of the present state, components one after another, SI; those without a value as None.
    ///
    /// # Errors
    /// Compliances are asked for where the tangent has no inverse.
    pub fn outputs(&mut self) -> Result<Vec<Option<f64>>, SensitivityError> {
        let mut values = self.outputs_here()?;
        values.truncate(values.len() - self.problem.model().targets.len());
        Ok(values)
    }

    /// The outputs of the present state, components one after another, those without a value as None; then by how much each
    /// target is missed.
    pub(crate) fn outputs_here(&mut self) -> Result<Vec<Option<f64>>, SensitivityError> {
        let solution = self.light_solution(What::Both)?;
        let model = self.problem.model();
        let mut values = Vec::new();
        for (output, result) in model.outputs.iter().zip(flexura_post::each_output(model, &solution)) {
            match result.map(|result| result.value) {
                Ok(OutputValue::Number(v)) => values.push(Some(v)),
                Ok(OutputValue::Vector(v)) => values.extend(v.map(Some)),
                Err(_) => values.extend(output.formulas.iter().map(|_| None)),
            }
        }
        let targets = flexura_post::targets(model, &solution)?;
        values.extend(targets.iter().zip(&model.targets).map(|(value, target)| Some(value - target.value)));
        Ok(values)
    }

    /// Derivatives of all outputs and of all body poses with respect to parameters, at the present equilibrium. Of an
    /// inverse problem only the given parameters count: the unknown ones move with them so that the targets are kept.
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn sensitivities(
        &mut self,
        family: &mut dyn Family,
        parameters: &[usize],
    ) -> Result<Sensitivities, SensitivityError> {
        let model = self.problem.model();
        let components: Vec<usize> = model.outputs.iter().map(|output| output.formulas.len()).collect();
        let outputs: usize = components.iter().sum();
        let (bodies, targets) = (model.bodies.len(), model.targets.len());
        let unknown: Vec<usize> = model.unknowns.iter().map(|u| u.parameter).collect();
        let mut given: Vec<usize> = parameters.iter().copied().filter(|p| !unknown.contains(p)).collect();
        let (mut columns, mut left_out) = (Vec::new(), Vec::new());
        self.problem.linearise()?;
        let mut idle: Option<Vec<Option<f64>>> = None;
        for &parameter in unknown.iter().chain(&given) {
            if !family.depends_on(parameter) {
                if idle.is_none() {
                    // Nothing changes, but an output without a value has no derivative either.
                    let values = self.outputs_here()?;
                    idle = Some(values.iter().map(|value| value.map(|_| 0.0)).collect());
                }
                let still = Twist { angular: Vector3::zeros(), linear: Vector3::zeros() };
                columns.push((idle.clone().unwrap_or_default(), vec![still; bodies]));
                continue;
            }
            let value = self.problem.model().parameters[parameter].value;
            let size = size_of(self.problem.model(), parameter, self.problem.units(), SMALL);
            let (slopes, along) = match self.slopes(family, parameter, value, size) {
                Ok(found) => found,
                // The targets cannot be kept without what keeps them.
                Err(error) if unknown.contains(&parameter) => return Err(error),
                Err(error) => {
                    left_out.push((parameter, error.of_neighbours()));
                    continue;
                }
            };
            let twists = self.problem.body_motions(&along);
            columns.push((slopes, twists));
        }
        given.retain(|parameter| left_out.iter().all(|(out, _)| out != parameter));
        // What an unknown parameter must do so that the targets are kept while a given one moves.
        let given_columns = columns.split_off(unknown.len());
        let missed = |slopes: &[Option<f64>], i: usize| slopes[outputs + i].unwrap_or(0.0);
        let matrix = DMatrix::from_fn(targets, unknown.len(), |i, k| missed(&columns[k].0, i)).lu();
        let mut result = Sensitivities {
            parameters: given.clone(),
            outputs: components.iter().map(|n| vec![Vec::new(); *n]).collect(),
            unknowns: vec![Vec::new(); unknown.len()],
            left_out,
            bodies: vec![Vec::new(); bodies],
        };
        for (mut slopes, mut twists) in given_columns {
            if targets > 0 {
                let right = DVector::from_fn(targets, |i, _| -missed(&slopes, i));
                let follow = matrix.solve(&right).ok_or(Breakdown::Singular)?;
                for ((by, (along, turns)), list) in follow.iter().zip(&columns).zip(&mut result.unknowns) {
                    list.push(*by);
                    for (slope, along) in slopes.iter_mut().zip(along) {
                        *slope = slope.zip(*along).map(|(slope, along)| slope + by * along);
                    }
                    for (twist, turn) in twists.iter_mut().zip(turns) {
                        twist.angular += turn.angular * *by;
                        twist.linear += turn.linear * *by;
                    }
                }
            }
            let mut slopes = slopes.into_iter();
            for component in result.outputs.iter_mut().flatten() {
                component.push(slopes.next().flatten());
            }
            for (list, twist) in result.bodies.iter_mut().zip(twists) {
                list.push(twist);
            }
        }
        Ok(result)
    }

    /// Derivatives of the outputs, and of the state, along one parameter; None of those that have no value somewhere beside it.
    fn slopes(
        &mut self,
        family: &mut dyn Family,
        parameter: usize,
        value: f64,
        size: f64,
    ) -> Result<(Vec<Option<f64>>, Vec<f64>), SensitivityError> {
        let mut tries = vec![(Order::Four, LIGHT * size, NEAR)];
        tries.extend((0..TRIES).map(|i| (Order::Six, FIRST * size * SHORTER.powi(i), AGREED)));
        let mut best: Vec<Option<Slope>> = Vec::new();
        let mut along = Vec::new();
        for (attempt, (order, h, good)) in tries.into_iter().enumerate() {
            // What was read off may have factorised other tangents.
            if attempt == 0 || self.asks_for_tangents() {
                self.problem.linearise()?;
            }
            let mut beside = self.beside_of(family, parameter, value, (order, h))?;
            along = self.state_slope_of(&mut beside)?;
            // Round-off of a difference goes with 1/h.
            let noise = if order == Order::Four { ROUND * FIRST / LIGHT } else { ROUND } / size;
            let slopes = self.slopes_of(&mut beside, &along, noise, Self::outputs_here)?;
            // The orders are not to be compared with each other.
            if attempt < 2 {
                best = slopes;
            } else {
                for (best, slope) in best.iter_mut().zip(slopes) {
                    *best = best.zip(slope).map(|(old, new)| if new.apart < old.apart { new } else { old });
                }
            }
            if best.iter().flatten().all(|slope| slope.apart < good) {
                break;
            }
        }
        Ok((best.iter().map(|slope| slope.map(|slope| slope.value)).collect(), along))
    }
}
