//! Studies: parameters that exist, ranges with two ends, counts from one.

use super::Issues;
use crate::{
    BuckleStudy, CriticalStudy, Issue, Model, ModesStudy, Parameter, Stop, Study, StudyKind, Target,
    TraceStudy,
};

impl Model {
    /// Everything that is wrong with a study of this model, which need not be one of its own list. Paths begin with
    /// `study.NAME`.
    pub fn study_issues(&self, study: &Study) -> Vec<Issue> {
        let mut issues = Issues(Vec::new());
        let path = format!("study.{}", study.name);
        match &study.kind {
            StudyKind::Solve => {}
            StudyKind::Trace(trace) => {
                self.check_forward(&path, "traced", &mut issues);
                self.check_trace(trace, &path, &mut issues);
            }
            StudyKind::Buckle(buckle) => {
                self.check_forward(&path, "asked for critical loads", &mut issues);
                self.check_buckle(buckle, &path, &mut issues);
            }
            StudyKind::Modes(modes) => {
                self.check_forward(&path, "asked for its modes", &mut issues);
                self.check_modes(modes, &path, &mut issues);
            }
            StudyKind::InverseDynamics(motion) => {
                self.check_forward(&path, "moved in time", &mut issues);
                self.check_motion(motion, &path, &mut issues);
            }
            StudyKind::Fit(fit) => self.check_fit(fit, &path, &mut issues),
            StudyKind::Formula(formula) => {
                self.check_forward(&path, "repeated by a formula", &mut issues);
                self.check_formula(formula, &path, &mut issues);
            }
            StudyKind::Optimise(study) => self.check_design(study, &path, &mut issues),
        }
        issues.0
    }

    pub(super) fn check_studies(&self, issues: &mut Issues) {
        issues.names("study", self.studies.iter().map(|study| study.name.as_str()));
        for study in &self.studies {
            issues.0.extend(self.study_issues(study));
        }
    }

    /// An unknown parameter is found anew by every solve, so nothing can be followed beside it.
    pub(super) fn check_forward(&self, path: &str, what: &str, issues: &mut Issues) {
        let unknown = self.unknowns.first().and_then(|unknown| self.parameters.get(unknown.parameter));
        if unknown.is_none() && self.targets.is_empty() {
            return;
        }
        let message = match unknown {
            Some(unknown) => format!(
                "an inverse problem cannot be {what}: its unknown `{}` has no value before it is solved",
                unknown.name
            ),
            None => format!("an inverse problem cannot be {what}"),
        };
        let hint = "take [unknown] and [target] out and give the parameters their values in [parameter]";
        issues.add_with_hint(format!("{path}.kind"), message, hint);
    }

    fn check_trace(&self, trace: &TraceStudy, path: &str, issues: &mut Issues) {
        let Some(parameter) = self.parameter_of(trace.parameter, path, issues) else { return };
        if check_ends(trace.range, parameter, &format!("{path}.range"), issues) {
            let [low, high] = ordered(trace.range);
            let within = format!("{} to {}", shown(low, parameter), shown(high, parameter));
            if !(low..=high).contains(&trace.start) {
                issues.add_with_hint(
                    format!("{path}.start"),
                    format!(
                        "the path would start at {}, which is not in the range {within}",
                        shown(trace.start, parameter)
                    ),
                    "choose a start in the range, or leave it out to start at the first end",
                );
            }
        }
        at_least(trace.steps, 1, &format!("{path}.steps"), issues);
        at_least(trace.most_points, 2, &format!("{path}.most_points"), issues);
        for (i, event) in trace.events.iter().enumerate() {
            self.check_event(event, &format!("{path}.event[{i}]"), issues);
        }
        for (i, stop) in trace.stops.iter().enumerate() {
            let path = format!("{path}.stop[{i}]");
            match stop {
                Stop::Value(event) => self.check_event(event, &path, issues),
                Stop::Fold(0) | Stop::Branch(0) | Stop::Event(0) => {
                    issues.add_with_hint(
                        path,
                        "folds, branch points and events are counted from 1",
                        "`fold 1` is the first",
                    );
                }
                Stop::Fold(_) | Stop::Branch(_) | Stop::Event(_) => {}
            }
        }
        if let Some((second, from)) = trace.imperfection {
            self.check_imperfection(trace, second, from, &format!("{path}.imperfection"), issues);
        }
        if let Some(critical) = trace.critical {
            self.check_critical(trace, critical, &format!("{path}.critical"), issues);
        }
    }

    fn check_imperfection(
        &self,
        trace: &TraceStudy,
        second: usize,
        from: f64,
        path: &str,
        issues: &mut Issues,
    ) {
        let Some(parameter) = self.second_parameter(trace, second, path, "be the imperfection", issues)
        else {
            return;
        };
        let path = format!("{path}.from");
        if issues.finite(path.clone(), from) && from == parameter.value {
            issues.add_with_hint(
                path,
                format!(
                    "the imperfection begins at {}, the value that `{}` has anyway",
                    shown(from, parameter),
                    parameter.name
                ),
                "give a value that breaks the symmetry; from there it is led back to the model's own",
            );
        }
    }

    fn check_critical(&self, trace: &TraceStudy, critical: CriticalStudy, path: &str, issues: &mut Issues) {
        at_least(critical.number, 1, &format!("{path}.number"), issues);
        let what = "be the second parameter of the critical points";
        let Some(parameter) = self.second_parameter(trace, critical.parameter, path, what, issues) else {
            return;
        };
        let path = format!("{path}.range");
        if check_ends(critical.range, parameter, &path, issues) {
            let [low, high] = ordered(critical.range);
            if !(low..=high).contains(&parameter.value) {
                let own = shown(parameter.value, parameter);
                issues.add_with_hint(
                    path,
                    format!(
                        "the critical point is followed from `{}` = {own}, which is not in the range",
                        parameter.name
                    ),
                    "widen the range, or give the parameter a value in it",
                );
            }
        }
    }

    fn check_buckle(&self, buckle: &BuckleStudy, path: &str, issues: &mut Issues) {
        if let Some(parameter) = buckle.parameter {
            self.parameter_of(parameter, path, issues);
        }
        issues.finite(format_args!("{path}.at"), buckle.at);
        at_least(buckle.count, 1, &format!("{path}.count"), issues);
    }

    fn check_modes(&self, modes: &ModesStudy, path: &str, issues: &mut Issues) {
        at_least(modes.count, 1, &format!("{path}.count"), issues);
        let Some(along) = modes.path else { return };
        at_least(along.steps, 1, &format!("{path}.steps"), issues);
        let Some(parameter) = self.parameter_of(along.parameter, path, issues) else { return };
        check_ends(along.range, parameter, &format!("{path}.range"), issues);
        if modes.at_rest {
            issues.add_with_hint(
                format!("{path}.at_rest"),
                "a path leads through equilibria, not along the state at rest",
                "leave out `at_rest`, or `parameter` and `range`",
            );
        }
    }

    pub(super) fn parameter_of(
        &self,
        position: usize,
        path: &str,
        issues: &mut Issues,
    ) -> Option<&Parameter> {
        let parameter = self.parameters.get(position);
        if parameter.is_none() {
            issues.add(format!("{path}.parameter"), "refers to a parameter that does not exist");
        }
        parameter
    }

    /// A parameter beside the one that is traced.
    fn second_parameter(
        &self,
        trace: &TraceStudy,
        position: usize,
        path: &str,
        what: &str,
        issues: &mut Issues,
    ) -> Option<&Parameter> {
        let parameter = self.parameter_of(position, path, issues)?;
        if position == trace.parameter {
            let message =
                format!("`{}` is the parameter that is traced and cannot {what} too", parameter.name);
            issues.add_with_hint(format!("{path}.parameter"), message, "name another parameter");
            return None;
        }
        Some(parameter)
    }

    fn check_event(&self, event: &Target, path: &str, issues: &mut Issues) {
        if event.output.formulas.len() != 1 {
            issues.add(path, "an event must have one formula");
        }
        self.check_probes(&event.output.probes, path, issues);
        issues.finite(path, event.value);
    }
}

/// Are the ends of a range two different numbers?
fn check_ends([from, to]: [f64; 2], parameter: &Parameter, path: &str, issues: &mut Issues) -> bool {
    if !issues.finite(path, from) || !issues.finite(path, to) {
        return false;
    }
    if from == to {
        let message = format!("both ends of the range are {}", shown(from, parameter));
        issues.add_with_hint(path, message, "give two different values; the first may be the larger");
    }
    from != to
}

pub(super) fn at_least(count: usize, least: usize, path: &str, issues: &mut Issues) {
    if count < least {
        issues.add(path, format!("must be at least {least}, is {count}"));
    }
}

fn ordered([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

/// A value of a parameter with its unit, angles in degrees.
pub(super) fn shown(value: f64, parameter: &Parameter) -> String {
    if parameter.unit == "rad" {
        // Degrees that were typed come back as they were.
        return format!("{} deg", (value.to_degrees() * 1e9).round() / 1e9);
    }
    format!("{value} {}", parameter.unit).trim_end().to_owned()
}
