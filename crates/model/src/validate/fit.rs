//! Fits and formulas: parameters and outputs that exist, enough to go by, terms that differ.

use super::Issues;
use super::study::shown;
use crate::{
    FitStudy, FormulaPiece, FormulaQuantity, FormulaSource, FormulaStudy, Measurements, Model, StudyKind,
};

impl Model {
    pub(super) fn check_fit(&self, fit: &FitStudy, path: &str, issues: &mut Issues) {
        if fit.unknowns.is_empty() {
            issues.add_with_hint(
                format!("{path}.unknown"),
                "nothing is to be found",
                "name parameters, for example `unknown = [\"young\"]`",
            );
        }
        for (i, unknown) in fit.unknowns.iter().enumerate() {
            let Some(parameter) = self.parameters.get(unknown.parameter) else {
                issues.add(format!("{path}.unknown"), "refers to a parameter that does not exist");
                continue;
            };
            let name = &parameter.name;
            if fit.unknowns[..i].iter().any(|other| other.parameter == unknown.parameter) {
                let hint = "an unknown is the same for all specimens, or has a value for each";
                issues.add_with_hint(format!("{path}.unknown"), format!("`{name}` is named twice"), hint);
            }
            self.check_found(unknown.parameter, &format!("{path}.unknown"), issues);
            let Some([low, high]) = unknown.bounds else { continue };
            let path = format!("{path}.bounds.{name}");
            if low.is_nan() || high.is_nan() || low >= high {
                let [low, high] = [shown(low, parameter), shown(high, parameter)];
                issues.add(path, format!("the lower bound {low} must be less than the upper one {high}"));
            } else if !(low..=high).contains(&parameter.value) {
                let value = shown(parameter.value, parameter);
                let hint = "widen the bounds, or give the parameter a value between them";
                issues.add_with_hint(path, format!("the first guess {value} lies outside"), hint);
            }
        }
        if !(fit.confidence > 0.0 && fit.confidence < 1.0) {
            let message = format!("must lie between 0 and 1, is {}", fit.confidence);
            issues.add_with_hint(format!("{path}.confidence"), message, "0.95 is usual");
        }
        for (output, component, noise) in &fit.noise {
            let name = self.output_name(*output, *component);
            issues.positive(format_args!("{path}.noise.{name}"), *noise);
        }
        self.check_measurements(fit, &fit.data, path, issues);
    }

    /// May a study choose this parameter's value?
    fn check_found(&self, position: usize, path: &str, issues: &mut Issues) {
        let parameter = &self.parameters[position];
        let name = &parameter.name;
        if self.unknowns.iter().any(|unknown| unknown.parameter == position) {
            let message = format!("`{name}` is found by every solve already");
            issues.add_with_hint(path, message, "take it out of [unknown], or out of this study");
        } else if parameter.is_structural {
            let message = format!(
                "`{name}` decides of which parts the mechanism is made; nothing leads from one value to the next"
            );
            issues.add_with_hint(path, message, "try its values one by one");
        } else if parameter.formula.is_some() {
            let message = format!("`{name}` follows a formula of other parameters");
            issues.add_with_hint(path, message, "name a parameter that the formula depends on");
        } else if !self.depends_on(position) {
            let message = format!("nothing in the mechanism and its outputs depends on `{name}`");
            issues.add_with_hint(path, message, "use it in the model, or name another parameter");
        }
    }

    fn check_measurements(&self, fit: &FitStudy, data: &Measurements, path: &str, issues: &mut Issues) {
        let path = format!("{path}.data");
        let exist = data.set.iter().all(|p| *p < self.parameters.len())
            && data.measured.iter().all(|(output, component)| {
                self.outputs.get(*output).is_some_and(|output| *component < output.formulas.len())
            });
        if !exist {
            issues.add(path, "refers to a parameter or output that does not exist");
            return;
        }
        let fits = data.rows.iter().all(|row| {
            row.set.len() == data.set.len()
                && row.measured.len() == data.measured.len()
                && row.specimen < data.specimens.len()
        });
        let numbers = data.rows.iter().flat_map(|row| row.set.iter().chain(row.measured.iter().flatten()));
        if !fits || numbers.clone().any(|v| !v.is_finite()) {
            issues.add(path, "its rows must hold a finite number for each of its columns");
            return;
        }
        if let Some(row) = data.rows.iter().find(|row| row.weight.is_nan() || row.weight < 0.0) {
            let message = format!("line {}: a weight must not be negative, is {}", row.line, row.weight);
            issues.add(path, message);
            return;
        }
        for (i, position) in data.set.iter().enumerate() {
            let name = &self.parameters[*position].name;
            if fit.unknowns.iter().any(|unknown| unknown.parameter == *position) {
                let message = format!("`{name}` is a column of the data and is to be found from them too");
                issues.add_with_hint(
                    path.clone(),
                    message,
                    "take it out of the unknown ones, or out of the data",
                );
            }
            if data.set[..i].contains(position) {
                issues.add(path.clone(), format!("two columns set `{name}`"));
            }
        }
        if data.measured.is_empty() {
            let names: Vec<&str> = self.outputs.iter().map(|output| output.name.as_str()).collect();
            let hint = format!("outputs of the model: {}", names.join(", "));
            issues.add_with_hint(path.clone(), "no column is an output, so that nothing was measured", hint);
            return;
        }
        let values = data.rows.iter().flat_map(|row| row.measured.iter().flatten()).count();
        let common = fit.unknowns.iter().filter(|unknown| !unknown.is_per_specimen).count();
        let own = (fit.unknowns.len() - common) * data.specimens.len();
        if values < common + own {
            let message =
                format!("{values} measured values are too few for {} unknown numbers", common + own);
            issues.add_with_hint(path.clone(), message, "measure more, or look for fewer parameters");
        }
        self.check_scales(fit, data, &path, issues);
    }

    /// Residuals of different units cannot be added before they are divided by what is known of their noise.
    fn check_scales(&self, fit: &FitStudy, data: &Measurements, path: &str, issues: &mut Issues) {
        let without = data
            .measured
            .iter()
            .find(|(output, component)| !fit.noise.iter().any(|(o, c, _)| (o, c) == (output, component)));
        let units = data.measured.iter().map(|(output, _)| self.outputs[*output].unit.as_str());
        let first = units.clone().next();
        let several = units.clone().any(|unit| Some(unit) != first);
        if let Some((output, component)) = without
            && (several || !fit.noise.is_empty() && data.measured.len() > 1)
        {
            let name = self.output_name(*output, *component);
            let message = format!("nothing says how `{name}` counts beside the other measured outputs");
            let hint = format!("give its standard deviation: `noise = {{ {name} = ... }}`");
            issues.add_with_hint(path, message, hint);
        }
    }

    /// An output's name, with its component where it has several.
    pub fn output_name(&self, output: usize, component: usize) -> String {
        let Some(output) = self.outputs.get(output) else { return String::new() };
        match output.formulas.len() {
            1 => output.name.clone(),
            _ => format!("{}.{}", output.name, ["x", "y", "z"].get(component).unwrap_or(&"")),
        }
    }

    pub(super) fn check_formula(&self, study: &FormulaStudy, path: &str, issues: &mut Issues) {
        let has = |(output, component): (usize, usize)| {
            self.outputs.get(output).is_some_and(|output| component < output.formulas.len())
        };
        if !has(study.output) {
            issues.add(format!("{path}.output"), "refers to an output that does not exist");
        }
        let units = study.variables.iter().map(|variable| &variable.unit).chain([&study.unit]);
        for unit in units {
            issues.positive(format_args!("{path}.of"), unit.factor);
        }
        if study.variables.is_empty() {
            issues.add_with_hint(
                format!("{path}.of"),
                "nothing goes into the formula",
                "name parameters or outputs",
            );
        }
        for (i, variable) in study.variables.iter().enumerate() {
            let exists = match variable.of {
                FormulaQuantity::Parameter(position) => position < self.parameters.len(),
                FormulaQuantity::Output(output, component) => has((output, component)),
            };
            if !exists {
                issues.add(format!("{path}.of[{i}]"), "refers to a parameter or output that does not exist");
            }
            if study.variables[..i].iter().any(|other| other.of == variable.of) {
                issues.add(format!("{path}.of[{i}]"), "goes in twice");
            }
            if variable.range.is_some_and(|[low, high]| low.is_nan() || high.is_nan() || low >= high) {
                issues.add(format!("{path}.range"), "its first value must be less than its second");
            }
        }
        self.check_source(study, path, issues);
        if study.pieces.is_empty() {
            issues.add(format!("{path}.pieces"), "the formula has no terms");
        }
        if study.pieces.len() > 1 && study.variables.len() != 1 {
            let hint = "make a formula of one variable, or leave the pieces out";
            issues.add_with_hint(
                format!("{path}.pieces"),
                "a formula in several variables has one piece",
                hint,
            );
        }
        for (i, piece) in study.pieces.iter().enumerate() {
            let last = i + 1 == study.pieces.len();
            self.check_piece(study, piece, (i, last), path, issues);
        }
    }

    fn check_source(&self, study: &FormulaStudy, path: &str, issues: &mut Issues) {
        match &study.source {
            FormulaSource::Trace(position) => {
                let trace = match self.studies.get(*position).map(|study| &study.kind) {
                    Some(StudyKind::Trace(trace)) => trace,
                    _ => return issues.add(format!("{path}.trace"), "refers to a trace that does not exist"),
                };
                for variable in &study.variables {
                    let FormulaQuantity::Parameter(position) = variable.of else { continue };
                    if position != trace.parameter {
                        let name = self.parameters.get(position).map_or("", |p| p.name.as_str());
                        let message = format!("`{name}` does not change along the trace");
                        let hint = "name the traced parameter, or outputs";
                        issues.add_with_hint(format!("{path}.of"), message, hint);
                    }
                }
            }
            FormulaSource::Grid(axes) => {
                for (i, (position, values)) in axes.iter().enumerate() {
                    let Some(parameter) = self.parameters.get(*position) else {
                        issues.add(format!("{path}.vary"), "refers to a parameter that does not exist");
                        continue;
                    };
                    let path = format!("{path}.vary.{}", parameter.name);
                    self.check_found(*position, &path, issues);
                    if values.is_empty() || values.iter().any(|value| !value.is_finite()) {
                        issues.add(path.clone(), "needs finite values");
                    }
                    if axes[..i].iter().any(|(other, _)| other == position) {
                        issues.add(path, "is varied twice");
                    }
                }
                for variable in &study.variables {
                    let FormulaQuantity::Parameter(position) = variable.of else { continue };
                    if axes.iter().all(|(other, _)| *other != position) {
                        let name = self.parameters.get(position).map_or("", |p| p.name.as_str());
                        let hint = format!("add `{name}` to `vary`, or take it out of `of`");
                        issues.add_with_hint(format!("{path}.of"), format!("`{name}` is not varied"), hint);
                    }
                }
            }
        }
    }

    fn check_piece(
        &self,
        study: &FormulaStudy,
        piece: &FormulaPiece,
        (i, last): (usize, bool),
        path: &str,
        issues: &mut Issues,
    ) {
        let path = format!("{path}.pieces[{i}]");
        if piece.terms.is_empty() {
            issues.add_with_hint(path.clone(), "the formula has no terms", "give it a `degree`, or `terms`");
        }
        for (k, term) in piece.terms.iter().enumerate() {
            if piece.terms[..k].contains(term) {
                issues.add(format!("{path}.terms[{k}]"), "a term stands twice");
            }
            let sound = term.factors.iter().all(|f| f.variable < study.variables.len() && f.power > 0);
            if !sound {
                issues.add(format!("{path}.terms[{k}]"), "refers to a variable that does not go in");
            }
        }
        match (piece.to, last) {
            (None, false) => issues.add_with_hint(
                path,
                "only the last piece goes on without an end",
                "say where the others end: `to = ...`",
            ),
            (Some(_), true) => {
                issues.add_with_hint(path, "the last piece has no end", "leave `to` out, or give a `range`");
            }
            (Some(to), false) => {
                let before = i.checked_sub(1).and_then(|i| study.pieces[i].to);
                if !to.is_finite() || before.is_some_and(|before| to <= before) {
                    issues.add(path, "pieces must end one after another");
                }
            }
            (None, true) => {}
        }
    }
}
