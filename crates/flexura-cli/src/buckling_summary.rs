//! What a person reads after buckling.

use crate::quantity::{number, quantity, size};
use crate::screen::{BAD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::model::{BuckleStudy, Model};
use flexura::solution::{Buckling, Status};

/// The summary as text.
pub fn render(model: &Model, study: &BuckleStudy, buckling: &Buckling) -> String {
    let name = title(&model.name);
    let state = match buckling.solution.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &status.word().replace('_', " ")),
    };
    let parameter = buckling.parameter.map(|position| &model.parameters[position]);
    let value = |value: f64, digits: usize| match parameter {
        Some(parameter) => quantity(value, &parameter.unit, digits),
        None => number(value, digits),
    };
    let about = match parameter {
        Some(parameter) => format!("linearised at {} = {}", parameter.name, value(buckling.at, 6)),
        None => format!("linearised at {} of the load", value(buckling.at, 6)),
    };
    let work = buckling.solution.work.newton_steps;
    let mut text = format!("{name}: {state}\n  {}\n", styled(DIM, &format!("{about}, {work} Newton steps")));
    if buckling.solution.status != Status::Converged {
        return text;
    }
    if buckling.modes.is_empty() {
        return text + "\nno critical value was found\n";
    }
    let heading = match parameter {
        Some(parameter) => format!("critical {}", parameter.name),
        None => "critical fraction of the load".to_owned(),
    };
    let mut table = Table::new(&["modes", &heading, "relative error of the linearised value"]);
    for (i, mode) in buckling.modes.iter().enumerate() {
        let relative =
            if mode.value == 0.0 { mode.error_estimate } else { mode.error_estimate / mode.value.abs() };
        table.row(vec![(i + 1).to_string(), value(mode.value, 8), size(relative)]);
    }
    text += &format!("\n{}", table.render());
    if buckling.modes.len() < study.count {
        text +=
            &format!("\nof {} critical values asked for, {} were found\n", study.count, buckling.modes.len());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura::modelfile::Document;
    use flexura::solution::{BucklingMode, Direction};

    const ELASTICA: &str = include_str!("../../../models/elastica.toml");

    #[test]
    fn critical_values_bear_their_unit_and_their_error() {
        let model = Document::parse(ELASTICA, "elastica.toml").and_then(|file| file.model(&[])).unwrap();
        let solution = flexura::solve(&model, &flexura::Options::default(), &mut |_| {}).unwrap();
        let mode = |value: f64| BucklingMode { value, error_estimate: 1e-9, direction: Direction::default() };
        let modes = vec![mode(2.4674011), mode(22.20661)];
        let mut buckling = Buckling { parameter: Some(0), at: 1.0, solution, modes };
        let study = BuckleStudy { parameter: Some(0), at: 1.0, count: 2 };
        let text = render(&model, &study, &buckling);
        for words in ["linearised at force = 1 N", "critical force", "2.4674011 N", "4.1e-10"] {
            assert!(text.contains(words), "{words}: {text}");
        }
        assert!(!text.contains("asked for"));

        buckling.parameter = None;
        let text = render(&model, &BuckleStudy { parameter: None, count: 3, ..study }, &buckling);
        for words in
            ["linearised at 1 of the load", "critical fraction", "2.4674011 ", "of 3 critical values"]
        {
            assert!(text.contains(words), "{words}: {text}");
        }
        buckling.modes.clear();
        assert!(render(&model, &study, &buckling).contains("no critical value"));
        buckling.solution.status = Status::Stalled;
        assert!(!render(&model, &study, &buckling).contains("no critical value"));
    }
}
