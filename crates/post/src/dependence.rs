//! How outputs depend on parameters, in units and in per cent per per cent.

use crate::{Evaluation, OutputValue, Scales};
use flexura_expression::{Expression, Quantity};
use flexura_model::{Model, Parameter};
use flexura_solution::Solution;

/// How one output depends on one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Dependence {
    /// Name of the output.
    pub output: String,
    /// Name of the parameter.
    pub parameter: String,
    /// d output / d parameter for each component, SI.
    pub derivative: Vec<f64>,
    /// Its unit as text.
    pub unit: String,
    /// d ln output / d ln parameter for each component; None where one of the two is zero.
    pub elasticity: Vec<Option<f64>>,
}

/// Every output by every parameter, outputs first; empty where the solution holds no sensitivities. An output without a
/// value, here or next to this equilibrium, has no dependence either.
pub fn dependences(model: &Model, solution: &Solution, evaluation: &Evaluation) -> Vec<Dependence> {
    let Some(sensitivities) = &solution.sensitivities else { return Vec::new() };
    let scales = Scales::of(solution);
    let mut list = Vec::new();
    for (output, components) in model.outputs.iter().zip(&sensitivities.outputs) {
        let Some(result) = evaluation.outputs.iter().find(|result| result.name == output.name) else {
            continue;
        };
        let values = match result.value {
            OutputValue::Number(value) => vec![value],
            OutputValue::Vector(values) => values.to_vec(),
        };
        for (column, &position) in sensitivities.parameters.iter().enumerate() {
            let parameter = &model.parameters[position];
            // An output has all its components or none.
            let derivative: Option<Vec<f64>> = components.iter().map(|by| by[column]).collect();
            let Some(derivative) = derivative else { continue };
            let elasticity = derivative.iter().zip(&values).map(|(slope, value)| {
                let is_nothing =
                    parameter.value == 0.0 || *value == 0.0 || scales.hides(*value, &output.unit);
                (!is_nothing).then(|| slope * parameter.value / value)
            });
            list.push(Dependence {
                output: output.name.clone(),
                parameter: parameter.name.clone(),
                elasticity: elasticity.collect(),
                unit: quotient(&output.unit, &parameter.unit),
                derivative,
            });
        }
    }
    // Of an inverse problem, how what was found depends on what was given.
    let found: Vec<&Parameter> = model.unknowns.iter().map(|u| &model.parameters[u.parameter]).collect();
    for (unknown, by) in found.iter().zip(&sensitivities.unknowns) {
        for (slope, &position) in by.iter().zip(&sensitivities.parameters) {
            let parameter = &model.parameters[position];
            let known = parameter.value != 0.0 && unknown.value != 0.0;
            list.push(Dependence {
                output: format!("parameter.{}", unknown.name),
                parameter: parameter.name.clone(),
                derivative: vec![*slope],
                unit: quotient(&unknown.unit, &parameter.unit),
                elasticity: vec![known.then(|| slope * parameter.value / unknown.value)],
            });
        }
    }
    list
}

/// The unit of a quotient, cancelled where that makes it shorter: N·m over m is N, but m over N stays.
fn quotient(over: &str, under: &str) -> String {
    let plain = match (over, under) {
        (_, "") => return over.to_owned(),
        ("", _) => "1",
        _ => over,
    };
    let written =
        if under.contains(['*', '/']) { format!("{plain}/({under})") } else { format!("{plain}/{under}") };
    // A unit binds only to a number, hence the ones.
    let one = |unit: &str| if unit.is_empty() { "1".to_owned() } else { format!("(1 {unit})") };
    let parsed = Expression::parse(&format!("{} / {}", one(over), one(under)));
    let known = parsed.and_then(|expression| expression.evaluate(&mut |_| Ok(Quantity::plain(1.0))));
    let cancelled = known.map(|quantity| quantity.kind.dimension().unit());
    cancelled.ok().filter(|unit| unit.len() < written.len()).unwrap_or(written)
}

#[cfg(test)]
mod tests {
    use super::quotient;

    #[test]
    fn units_of_quotients_are_cancelled_where_that_is_shorter() {
        let cases = [
            ("m", "N", "m/N"),
            ("N*m", "m", "N"),
            ("m", "m", ""),
            ("", "N", "1/N"),
            ("rad", "", "rad"),
            ("rad", "N", "rad/N"),
            ("Pa", "m", "Pa/m"),
            ("m", "N*m", "1/N"),
            ("rad", "N*m/rad", "rad/N/m"),
        ];
        for (over, under, unit) in cases {
            assert_eq!(quotient(over, under), unit, "{over} / {under}");
        }
    }
}
