//! What verbs say of the same mechanism, side by side.

use crate::command::Ran;
use crate::finding::{Finding, Kind};
use flexura::output::{Document, Value as Output};
use serde_json::Value;

/// Differences of outputs, relative to the largest of their kind, that are none.
const SAME: f64 = 1e-5;
/// The least EI/L² and EI/L that are drawn, N and N·m: where all that is carried is less, it is round-off.
const LEAST_FORCE: f64 = 1e-13;
const LEAST_MOMENT: f64 = 1e-17;
/// How near to its end a stall must be to what it names, as a part of the load.
const NEAR: f64 = 0.02;

/// An output's numbers; none where it has no value.
fn numbers(output: &Option<Output>) -> Vec<f64> {
    match output {
        Some(Output::Number(value)) => vec![*value],
        Some(Output::Vector(vector)) => vector.to_vec(),
        None => Vec::new(),
    }
}

/// The largest distance, force and moment in a document.
fn sizes(document: &Document) -> [f64; 3] {
    let largest = |lists: &mut dyn Iterator<Item = &[f64; 3]>| {
        lists.flat_map(|vector| vector.iter()).map(|value| value.abs()).fold(0.0, f64::max)
    };
    let beams = || document.beams.0.iter().map(|(_, beam)| beam);
    let joints = || document.joints.0.iter().map(|(_, joint)| joint);
    let bodies = document.bodies.0.iter().map(|(_, body)| &body.position);
    [
        largest(&mut beams().flat_map(|beam| &beam.position).chain(bodies)),
        largest(&mut beams().flat_map(|beam| &beam.force).chain(joints().map(|joint| &joint.force))),
        largest(&mut beams().flat_map(|beam| &beam.moment).chain(joints().map(|joint| &joint.moment))),
    ]
}

/// The first output that differs, by kinds: outputs whose names end alike are measured by the largest of them.
fn differing(document: &Document, other: impl Fn(&str) -> Option<Vec<f64>>) -> Option<String> {
    let [length, force, moment] = sizes(document);
    let kind = |name: &str| name.rsplit('_').next().unwrap_or(name).to_owned();
    let size = |ending: &str| {
        let alike = document.outputs.0.iter().filter(|(name, _)| kind(name) == ending);
        alike.flat_map(|(_, output)| numbers(output)).map(f64::abs).fold(0.0, f64::max)
    };
    for (name, output) in &document.outputs.0 {
        let (ours, Some(theirs)) = (numbers(output), other(name)) else { continue };
        let unit = match kind(name).as_str() {
            "turned" | "angle" | "first" | "second" => 1.0,
            "coordinate" => length.min(1.0).max(size("coordinate")),
            "pull" | "force" => force.max(size(&kind(name))).max(LEAST_FORCE),
            "root" => moment.max(force * length).max(LEAST_MOMENT),
            "energy" => size("energy"),
            ending => length.max(size(ending)),
        };
        // Turns beyond half a turn read either way.
        if kind(name) == "turned" && ours.iter().map(|v| v * v).sum::<f64>().sqrt() > 3.1 {
            continue;
        }
        for (a, b) in ours.iter().zip(&theirs) {
            if !((a - b).abs() <= SAME * unit) {
                return Some(format!("{name} is {a:e} and {b:e}"));
            }
        }
    }
    None
}

/// The path from rest against the answer of a solve.
pub fn with_trace(document: &Document, trace: &Ran) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut find = |kind: Kind, detail: String| {
        findings.push(Finding { kind, words: trace.words.clone(), detail });
    };
    let told: Value = match serde_json::from_str(&trace.out) {
        Ok(told) => told,
        Err(error) => {
            find(Kind::Code, format!("no document: {error}"));
            return findings;
        }
    };
    let points = told["branches"][0]["points"].as_array().cloned().unwrap_or_default();
    let of_kind = |kind: &str| -> Vec<f64> {
        let some = points.iter().filter(|point| point["kind"] == kind);
        some.filter_map(|point| point["parameter"].as_f64()).collect()
    };
    let (folds, branches) = (of_kind("fold"), of_kind("branch"));
    let last = points.last();
    let reached = last.and_then(|point| point["parameter"].as_f64()).unwrap_or(0.0);
    let through = told["branches"][0]["ends"][1] == "range" && reached > 0.999_999;
    let why =
        told["branches"][0]["end_reasons"][1].as_str().or(told["reason"].as_str()).unwrap_or("no reason");
    if document.status == "converged" {
        if let Some(fold) = folds.first() {
            find(Kind::PastAFold, format!("converged, and the trace has a fold at {fold:.4}"));
        } else if through
            && let Some(last) = last
            && let Some(what) = differing(document, |name| output_of(last, name))
        {
            find(Kind::PathDiffers, format!("{what} ({} branch points on the way)", branches.len()));
        } else if !through {
            find(Kind::TraceLost, format!("solve converged; the trace ends at {reached:.4}: {why}"));
        }
        return findings;
    }
    let path = Path { folds, branches, reached, through, why: why.to_owned() };
    if let Some((kind, detail)) = cause(document, &path) {
        find(kind, detail);
    }
    findings
}

/// The trace's first branch.
struct Path {
    folds: Vec<f64>,
    branches: Vec<f64>,
    reached: f64,
    through: bool,
    why: String,
}

/// Is what a solve that did not converge says of the cause true of the path?
fn cause(document: &Document, path: &Path) -> Option<(Kind, String)> {
    let Path { folds, branches, reached, through, why } = path;
    let at = document.load_fraction.unwrap_or(1.0);
    let said = document.reason.clone().unwrap_or_default();
    let status = &document.status;
    let near = |places: &[f64]| places.iter().any(|place| (place - at).abs() < NEAR);
    // Another reason may say that neither was found.
    let fold = said.contains("at a fold");
    if status == "accuracy_limit" {
        return Some((Kind::Accuracy, said));
    }
    let detail = if *through && folds.is_empty() {
        format!("{status} at {at:.4}; the trace goes through: {said}")
    } else if fold && !near(folds) {
        let has = format!("the trace has folds at {folds:.4?} and ends at {reached:.4}");
        format!("{status} at {at:.4} says a fold; {has}: {why}")
    } else if said.contains("branch points, at each") && !fold && !near(branches) {
        format!("{status} at {at:.4} says a branch point; the trace has them at {branches:.4?}")
    } else {
        return None;
    };
    Some((Kind::WrongCause, detail))
}

fn output_of(point: &Value, name: &str) -> Option<Vec<f64>> {
    match &point["outputs"][name] {
        Value::Array(list) => list.iter().map(Value::as_f64).collect(),
        Value::Number(number) => number.as_f64().map(|number| vec![number]),
        _ => None,
    }
}

/// The last row of a sweep, which is at the full load, against the answer of a solve.
pub fn with_sweep(document: &Document, sweep: &Ran) -> Vec<Finding> {
    let find =
        |detail: String| vec![Finding { kind: Kind::SweepDiffers, words: sweep.words.clone(), detail }];
    let mut lines = sweep.out.lines();
    let (Some(head), Some(last)) = (lines.next(), sweep.out.lines().last()) else {
        return find("no table".to_owned());
    };
    let head = fields(head);
    let row = fields(last);
    let cell = |name: &str| {
        let at = head.iter().position(|title| title == name || title.starts_with(&format!("{name} ")));
        at.and_then(|at| row.get(at).cloned())
    };
    let status = cell("status").unwrap_or_default();
    if status != document.status {
        return find(format!("solve says {}, sweep says {status}", document.status));
    }
    if document.status != "converged" {
        return Vec::new();
    }
    let other = |name: &str| -> Option<Vec<f64>> {
        if let Some(value) = cell(name) {
            return value.parse().ok().map(|value| vec![value]);
        }
        ["x", "y", "z"].iter().map(|axis| cell(&format!("{name}.{axis}"))?.parse().ok()).collect()
    };
    differing(document, other).map_or_else(Vec::new, find)
}

/// The fields of a line of a CSV file.
fn fields(line: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => all.push(String::new()),
            c => all.last_mut().into_iter().for_each(|field| field.push(c)),
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quoted_field_may_hold_commas() {
        assert_eq!(fields("a,\"b, c\",d"), ["a", "b, c", "d"]);
    }
}
