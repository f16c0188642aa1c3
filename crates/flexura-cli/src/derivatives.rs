//! Sensitivities and compliances as a person reads them.

use crate::quantity::{number, quantity};
use crate::screen::{BOLD, DIM, styled};
use crate::table::Table;
use flexura::model::{Model, ProbeTarget};
use flexura::post::{Dependence, Evaluation, Scales, dependences, place_name};
use flexura::solution::Solution;

/// Columns of one table; further parameters go into a table of their own.
const COLUMNS: usize = 4;
/// What lies so far below the diagonal of a compliance is rounding noise.
const NOISE: f64 = 1e-10;

/// The table of outputs by parameters: derivative, and per cent of the output per cent of the parameter in brackets.
pub fn sensitivities(model: &Model, solution: &Solution, evaluation: &Evaluation) -> String {
    let list = dependences(model, solution, evaluation);
    let scales = Scales::of(solution);
    let mut names: Vec<&str> = Vec::new();
    for dependence in &list {
        if !names.contains(&dependence.parameter.as_str()) {
            names.push(&dependence.parameter);
        }
    }
    let mut text = String::new();
    for columns in names.chunks(COLUMNS) {
        let headings: Vec<String> = std::iter::once("sensitivities".to_owned())
            .chain(columns.iter().map(|p| format!("by {p}")))
            .collect();
        let mut table = Table::new(&headings.iter().map(String::as_str).collect::<Vec<_>>());
        let outputs = evaluation.outputs.iter().map(|output| (output.name.clone(), output.unit.clone()));
        let found = model.unknowns.iter().map(|unknown| {
            let parameter = &model.parameters[unknown.parameter];
            (format!("parameter.{}", parameter.name), parameter.unit.clone())
        });
        for (output, unit) in outputs.chain(found) {
            let row: Vec<&Dependence> = columns
                .iter()
                .filter_map(|p| list.iter().find(|d| d.output == output && d.parameter == *p))
                .collect();
            let components = row.first().map_or(0, |dependence| dependence.derivative.len());
            for component in 0..components {
                let name = match components {
                    3 => format!("{output}.{}", ["x", "y", "z"][component]),
                    _ => output.clone(),
                };
                let cells = row.iter().map(|dependence| {
                    let value = parameter(model, &dependence.parameter);
                    cell(dependence, component, value, &unit, &scales)
                });
                table.row(std::iter::once(name).chain(cells).collect());
            }
        }
        text += &format!("\n{}", table.render());
    }
    if !text.is_empty() {
        text +=
            &format!("{}\n", styled(DIM, "  in brackets: per cent of the output per cent of the parameter"));
    }
    text
}

fn parameter(model: &Model, name: &str) -> f64 {
    model.parameters.iter().find(|parameter| parameter.name == name).map_or(0.0, |parameter| parameter.value)
}

fn cell(dependence: &Dependence, component: usize, value: f64, unit: &str, scales: &Scales) -> String {
    let slope = dependence.derivative[component];
    if slope == 0.0 || (value != 0.0 && scales.hides(slope * value, unit)) {
        return "0".to_owned();
    }
    let slope = quantity(slope, &dependence.unit, 5);
    match dependence.elasticity[component] {
        Some(elasticity) => format!("{slope} ({})", number(elasticity, 3)),
        None => slope,
    }
}

/// The compliances of some places.
pub fn compliances(model: &Model, solution: &Solution, places: &[ProbeTarget]) -> String {
    let mut text = String::new();
    for tangent in solution.tangents.iter().filter(|tangent| places.contains(&tangent.target)) {
        let Some(matrix) = &tangent.compliance else { continue };
        let heading = format!("compliance of {}", place_name(model, &tangent.target));
        let mut table = Table::new(&["motion", "by fx [N]", "fy", "fz", "mx [N·m]", "my", "mz"]);
        for (i, name) in ["x [m]", "y", "z", "rx [rad]", "ry", "rz"].into_iter().enumerate() {
            let entry = |j: usize| {
                let size = (matrix[(i, i)] * matrix[(j, j)]).abs().sqrt();
                let value = matrix[(i, j)];
                if value.abs() < NOISE * size { "0".to_owned() } else { number(value, 5) }
            };
            table.row(std::iter::once(name.to_owned()).chain((0..6).map(entry)).collect());
        }
        text += &format!("\n{}\n{}", styled(BOLD, &heading), table.render());
    }
    text
}
