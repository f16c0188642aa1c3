//! Design optimisation: parameters that may change, ranges the right way round, bounds that can be met.

use super::Issues;
use super::study::{at_least, shown};
use crate::{Condition, Model, OptimiseStudy, Quantity, Reading, StudyKind, Varied, Wanted, Where};

impl Model {
    pub(super) fn check_design(&self, study: &OptimiseStudy, path: &str, issues: &mut Issues) {
        if study.vary.is_empty() {
            issues.add_with_hint(
                format!("{path}.vary"),
                "nothing may change, so there is nothing to be chosen",
                "name a parameter and its range: `vary = { thickness = { range = [\"0.1 mm\", \"2 mm\"] } }`",
            );
        }
        let before = issues.0.len();
        for (i, varied) in study.vary.iter().enumerate() {
            self.check_varied(varied, &study.vary[..i], path, issues);
        }
        let word = if study.maximise { "maximise" } else { "minimise" };
        let may_vary = !study.vary.is_empty() && issues.0.len() == before;
        self.check_reading(&study.objective, &format!("{path}.{word}"), issues);
        if may_vary && !self.hangs_on(&study.objective, &study.vary) {
            issues.add_with_hint(
                format!("{path}.{word}"),
                "the objective depends on no parameter that may change",
                "name a result, or let a parameter change that it depends on",
            );
        }
        for (i, condition) in study.conditions.iter().enumerate() {
            self.check_condition(condition, &format!("{path}.constraints[{i}]"), issues);
        }
        if let Some(front) = &study.front {
            let path = format!("{path}.pareto");
            self.check_reading(&front.other, &path, issues);
            if front.points < 3 {
                issues.add_with_hint(
                    format!("{path}.points"),
                    format!("must be at least 3, is {}", front.points),
                    "two points are the ends of the front, at each of which one objective is best",
                );
            }
            let (one, two) = (&study.objective, &front.other);
            let is_same = one.at == two.at
                && one.output.formulas == two.output.formulas
                && one.output.probes == two.output.probes;
            if is_same || one == two {
                issues.add_with_hint(
                    path,
                    "the two objectives are the same, so there is no compromise between them",
                    "name another result as the second objective, or leave `pareto` out",
                );
            }
        }
        at_least(study.starts, 1, &format!("{path}.starts"), issues);
        at_least(study.most_iterations, 1, &format!("{path}.most_iterations"), issues);
        if !(study.tolerance > 0.0 && study.tolerance <= 1e-2) {
            issues.add_with_hint(
                format!("{path}.tolerance"),
                format!("must be between 1e-12 and 0.01, is {}", study.tolerance),
                "it is relative to the ranges and to what is bounded; 1e-8 is usual",
            );
        }
    }

    fn check_varied(&self, varied: &Varied, before: &[Varied], path: &str, issues: &mut Issues) {
        let Some(parameter) = self.parameter_of(varied.parameter, path, issues) else { return };
        let name = &parameter.name;
        let path = format!("{path}.vary.{name}");
        if before.iter().any(|other| other.parameter == varied.parameter) {
            issues.add(path.clone(), format!("the parameter `{name}` is named twice"));
        }
        if parameter.is_structural {
            issues.add_with_hint(
                path.clone(),
                format!("`{name}` decides of which parts the mechanism is made, so that no derivative leads from one value to the next"),
                "vary a number, and compare the numbers of parts by `flexura sweep`",
            );
        }
        if parameter.formula.is_some() {
            issues.add_with_hint(
                path.clone(),
                format!("`{name}` is written by other parameters and has no value of its own to change"),
                "vary the parameters that it is written by",
            );
        }
        if self.unknowns.iter().any(|unknown| unknown.parameter == varied.parameter) {
            issues.add_with_hint(
                path.clone(),
                format!("`{name}` is an unknown, which every solve finds anew"),
                "vary another parameter; a constraint may bound this one",
            );
        }
        if self.parameters.get(varied.parameter).is_some() && !self.matters(varied.parameter) {
            issues.add_with_hint(
                path.clone(),
                format!("nothing in the mechanism depends on `{name}`"),
                "write it into the number that is to be chosen, as in `height = \"thickness\"`",
            );
        }
        let [low, high] = varied.range;
        let path = format!("{path}.range");
        if !issues.finite(&path, low) || !issues.finite(&path, high) {
            return;
        }
        let [from, to] = [shown(low, parameter), shown(high, parameter)];
        if low == high {
            issues.add_with_hint(
                path,
                format!("both ends of the range are {from}"),
                "give two different values, or take the parameter out of `vary`",
            );
        } else if low > high {
            issues.add_with_hint(
                path,
                format!("the range is reversed: {from} is more than {to}"),
                "write the smaller value first",
            );
        } else if !(low..=high).contains(&varied.guess) {
            let guess = shown(varied.guess, parameter);
            issues.add_with_hint(
                format!("{}.guess", path.trim_end_matches(".range")),
                format!("the search would begin at {guess}, which is not in the range {from} to {to}"),
                "choose a guess in the range; without one it is the value of the parameter, or the middle",
            );
        }
    }

    /// Does the mechanism, or anything that is read off it, follow a parameter?
    fn matters(&self, parameter: usize) -> bool {
        self.depends_on(parameter)
            || self.studies.iter().any(|study| match &study.kind {
                StudyKind::Optimise(study) => study.readings().any(|reading| self.reads(reading, parameter)),
                _ => false,
            })
    }

    /// Does a reading name a parameter that follows this one?
    fn reads(&self, reading: &Reading, parameter: usize) -> bool {
        let rates = self.parameter_rates(parameter);
        let probes = reading.output.probes.iter();
        probes
            .filter(|probe| probe.quantity == Quantity::Parameter)
            .any(|probe| rates.get(probe.component).is_some_and(|rate| *rate != 0.0))
    }

    /// May a reading depend on one of the parameters, as far as can be told without solving?
    fn hangs_on(&self, reading: &Reading, vary: &[Varied]) -> bool {
        let has_result = reading.output.probes.iter().any(|probe| probe.quantity != Quantity::Parameter)
            || reading.at != Where::Equilibrium;
        vary.iter().any(|varied| {
            varied.parameter >= self.parameters.len()
                || (has_result && self.depends_on(varied.parameter))
                || self.reads(reading, varied.parameter)
        })
    }

    fn check_reading(&self, reading: &Reading, path: &str, issues: &mut Issues) {
        if reading.output.formulas.len() != 1 {
            issues.add(path, "must have one formula");
        }
        self.check_probes(&reading.output.probes, path, issues);
        if let Where::Path { trace, point, .. } = &reading.at {
            self.check_forward(path, "followed along a path", issues);
            if trace.parameter >= self.parameters.len() {
                issues.add(path, "the path follows a parameter that does not exist");
            }
            if *point == Wanted::Fold(0) {
                issues.add_with_hint(path, "folds are counted from 1", "`fold 1` is the first");
            }
        }
    }

    fn check_condition(&self, condition: &Condition, path: &str, issues: &mut Issues) {
        self.check_reading(&condition.reading, path, issues);
        let bounds = [("least", condition.least), ("most", condition.most), ("equals", condition.equals)];
        for (key, value) in bounds {
            if let Some(value) = value {
                issues.finite(format_args!("{path}.{key}"), value);
            }
        }
        match (condition.least, condition.most, condition.equals) {
            (None, None, None) => issues.add_with_hint(
                path,
                "nothing is asked of this result",
                "give `most`, `least` or `equals`",
            ),
            (Some(_), _, Some(_)) | (_, Some(_), Some(_)) => issues.add_with_hint(
                path,
                "a result that must have a value needs no bounds",
                "give `equals`, or `least` and `most`",
            ),
            (Some(least), Some(most), None) if least > most => {
                let unit = &condition.reading.output.unit;
                issues.add_with_hint(
                    path,
                    format!("at least {least} {unit} and at most {most} {unit} exclude each other"),
                    "write the smaller value as `least`",
                );
            }
            _ => {}
        }
    }
}
