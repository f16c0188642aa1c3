//! Measurements and a model as residuals of the unknown parameters.
//!
//! A residual is (model - measured)/σ · √weight. Variables are the unknown numbers divided by their size, so that they are about
//! one: first those that all specimens share, then those of each specimen.

use crate::conditions::{Answer, Conditions};
use crate::least_squares::Residuals;
use flexura_model::{FitStudy, Model};
use flexura_study::{Interrupt, ProblemError};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// One unknown number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Variable {
    pub parameter: usize,
    /// Position in the evaluator's parameters.
    pub column: usize,
    pub specimen: Option<usize>,
    pub guess: f64,
    pub size: f64,
    pub bounds: [f64; 2],
}

/// A measured value that counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub row: usize,
    /// Position in the measured columns.
    pub column: usize,
}

pub(crate) struct Problem<'m> {
    pub study: &'m FitStudy,
    pub variables: Vec<Variable>,
    conditions: Conditions,
    /// The condition of each row; rows with the same values share one.
    condition: Vec<usize>,
    /// Positions of the measured columns in the components of all outputs.
    components: Vec<usize>,
    /// Names of the measured columns.
    names: Vec<String>,
    /// σ of each measured column.
    noise: Vec<f64>,
    /// Rows that count.
    pub is_active: Vec<bool>,
    /// Rows that had no answer when they were last asked, and why.
    pub failed: Vec<(usize, String)>,
    pub asked: usize,
}

impl<'m> Problem<'m> {
    pub fn new(
        model: &'m Model,
        study: &'m FitStudy,
        tolerance: f64,
        interrupt: &Interrupt,
    ) -> Result<Self, ProblemError> {
        let data = &study.data;
        let parameters: Vec<usize> = study.unknowns.iter().map(|unknown| unknown.parameter).collect();
        let variables = variables(model, study);
        let has_own = study.unknowns.iter().any(|unknown| unknown.is_per_specimen);
        let mut known: BTreeMap<(Vec<u64>, usize), usize> = BTreeMap::new();
        let mut condition = Vec::with_capacity(data.rows.len());
        for row in &data.rows {
            let bits = row.set.iter().map(|value| value.to_bits()).collect();
            let next = known.len();
            condition.push(*known.entry((bits, if has_own { row.specimen } else { 0 })).or_insert(next));
        }
        let conditions = Conditions::new(model, &parameters, known.len(), tolerance, interrupt)?;
        let before =
            |output: usize| model.outputs[..output].iter().map(|output| output.formulas.len()).sum::<usize>();
        let components = data.measured.iter().map(|(output, component)| before(*output) + component);
        let noise = data.measured.iter().map(|place| {
            let given = study.noise.iter().find(|(output, component, _)| (*output, *component) == *place);
            given.map_or(1.0, |(.., noise)| *noise)
        });
        Ok(Self {
            study,
            variables,
            conditions,
            condition,
            components: components.collect(),
            names: data.measured.iter().map(|(o, c)| model.output_name(*o, *c)).collect(),
            noise: noise.collect(),
            is_active: data.rows.iter().map(|row| row.weight > 0.0).collect(),
            failed: Vec::new(),
            asked: 0,
        })
    }

    pub fn start(&self) -> DVector<f64> {
        DVector::from_iterator(self.variables.len(), self.variables.iter().map(|v| v.guess / v.size))
    }

    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.variables.iter().map(|v| v.bounds.map(|bound| bound / v.size)).collect()
    }

    /// The measured values that count, in the order of the residuals.
    pub fn places(&self) -> Vec<Place> {
        let rows = self.study.data.rows.iter().enumerate().filter(|(row, _)| self.is_active[*row]);
        let places = |(row, measured): (usize, &flexura_model::MeasuredRow)| {
            let columns = measured.measured.iter().enumerate().filter(|(_, value)| value.is_some());
            columns.map(move |(column, _)| Place { row, column }).collect::<Vec<_>>()
        };
        rows.flat_map(places).collect()
    }

    /// σ/√weight of a measured value.
    pub fn unit_of(&self, place: Place) -> f64 {
        self.noise[place.column] / self.study.data.rows[place.row].weight.sqrt()
    }

    /// What the model says in some rows; errors by row.
    pub fn answers(
        &mut self,
        x: &DVector<f64>,
        rows: &[usize],
        derivatives: bool,
    ) -> Vec<Result<Answer, String>> {
        let data = &self.study.data;
        let mut asked: Vec<(usize, Vec<(usize, f64)>)> = Vec::new();
        let mut position: BTreeMap<usize, usize> = BTreeMap::new();
        let mut of_row = Vec::with_capacity(rows.len());
        for row in rows {
            let condition = self.condition[*row];
            let next = asked.len();
            let place = *position.entry(condition).or_insert(next);
            if place == next {
                let measured = &data.rows[*row];
                let mut values: Vec<(usize, f64)> =
                    data.set.iter().copied().zip(measured.set.iter().copied()).collect();
                let own = |v: &&Variable| v.specimen.is_none_or(|specimen| specimen == measured.specimen);
                let unknown = self.variables.iter().zip(x.iter()).filter(|(v, _)| own(v));
                values.extend(unknown.map(|(v, x)| (v.parameter, x * v.size)));
                asked.push((condition, values));
            }
            of_row.push(place);
        }
        let answers = self.conditions.answers(&asked, derivatives);
        of_row.into_iter().map(|place| answers[place].clone()).collect()
    }

    /// What the model says of a row's measured outputs.
    pub fn computed(&self, answer: &Answer) -> Vec<Option<f64>> {
        self.components.iter().map(|component| answer.values.get(*component).copied().flatten()).collect()
    }

    /// Has somebody asked for the end?
    pub fn is_interrupted_now(&self) -> bool {
        self.conditions.is_interrupted()
    }

    pub fn solves(&self) -> [usize; 2] {
        [self.conditions.solves, self.conditions.derivatives]
    }

    fn active(&self) -> Vec<usize> {
        (0..self.is_active.len()).filter(|row| self.is_active[*row]).collect()
    }

    /// The part of one row in residuals and Jacobian.
    fn fill(
        &self,
        row: usize,
        answer: &Answer,
        residuals: &mut Vec<f64>,
        jacobian: &mut Vec<Vec<f64>>,
    ) -> Result<(), String> {
        let measured = &self.study.data.rows[row];
        for (column, value) in measured.measured.iter().enumerate() {
            let Some(value) = value else { continue };
            let component = self.components[column];
            let name = &self.names[column];
            let computed = answer.values[component]
                .filter(|v| v.is_finite())
                .ok_or_else(|| format!("`{name}` has no value there"))?;
            let unit = self.unit_of(Place { row, column });
            residuals.push((computed - value) / unit);
            if answer.slopes.is_empty() {
                continue;
            }
            let mut slopes = vec![0.0; self.variables.len()];
            for (slope, variable) in slopes.iter_mut().zip(&self.variables) {
                if variable.specimen.is_none_or(|specimen| specimen == measured.specimen) {
                    let own = answer.slopes[component][variable.column];
                    let own = own.ok_or_else(|| format!("`{name}` has no derivative there"))?;
                    *slope = own * variable.size / unit;
                }
            }
            jacobian.push(slopes);
        }
        Ok(())
    }
}

impl Residuals for Problem<'_> {
    fn at(&mut self, x: &DVector<f64>, jacobian: bool) -> Option<(DVector<f64>, Option<DMatrix<f64>>)> {
        self.asked += 1;
        let rows = self.active();
        let answers = self.answers(x, &rows, jacobian);
        self.failed.clear();
        let (mut residuals, mut slopes) = (Vec::new(), Vec::new());
        for (row, answer) in rows.iter().zip(answers) {
            let filled = answer.and_then(|answer| self.fill(*row, &answer, &mut residuals, &mut slopes));
            if let Err(reason) = filled {
                self.failed.push((*row, reason));
            }
        }
        if !self.failed.is_empty() || residuals.is_empty() {
            return None;
        }
        let matrix =
            jacobian.then(|| DMatrix::from_fn(residuals.len(), self.variables.len(), |i, k| slopes[i][k]));
        Some((DVector::from_vec(residuals), matrix))
    }

    fn is_interrupted(&self) -> bool {
        self.conditions.is_interrupted()
    }
}

fn variables(model: &Model, study: &FitStudy) -> Vec<Variable> {
    let mut all = Vec::new();
    for is_own in [false, true] {
        for (column, unknown) in study.unknowns.iter().enumerate() {
            if unknown.is_per_specimen != is_own {
                continue;
            }
            let guess = model.parameters[unknown.parameter].value;
            let bounds = unknown.bounds.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            let width = bounds[1] - bounds[0];
            let size = match guess.abs() {
                guess if guess > 0.0 => guess,
                _ if width.is_finite() && width > 0.0 => width,
                _ => 1.0,
            };
            let variable =
                |specimen| Variable { parameter: unknown.parameter, column, specimen, guess, size, bounds };
            match is_own {
                false => all.push(variable(None)),
                true => all.extend((0..study.data.specimens.len()).map(|specimen| variable(Some(specimen)))),
            }
        }
    }
    all
}
