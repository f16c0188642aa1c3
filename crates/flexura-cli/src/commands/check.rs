//! `flexura check FILE`

use super::{file_failure, problem_failure, warn_about};
use crate::arguments::CheckArguments;
use crate::failure::Failure;
use crate::quantity::quantity;
use crate::screen::{self, BAD, GOOD, styled};
use crate::table::Table;
use flexura::Census;
use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::output::{Named, to_json};
use serde::Serialize;

pub fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    let arguments = &arguments.model;
    let file = Document::read(&arguments.file).map_err(|report| file_failure(&report))?;
    let model = file.model(&arguments.overrides).map_err(|report| file_failure(&report))?;
    let census = flexura::check(&model).map_err(|error| problem_failure(&file, &error))?;
    if arguments.json {
        let text = to_json(&CheckDocument::new(&model, &census))
            .map_err(|error| Failure::Machine(error.to_string()))?;
        screen::print_table(&text)?;
    } else if !arguments.quiet {
        screen::print(&render(&model, &census))?;
    }
    if !arguments.quiet {
        warn_about(&file, &census.warnings);
    }
    Ok(())
}

fn total(items: &[(String, usize)]) -> usize {
    items.iter().map(|(_, count)| count).sum()
}

fn render(model: &Model, census: &Census) -> String {
    let (unknowns, equations) = (total(&census.unknowns), total(&census.equations));
    let name = screen::title(&model.name);
    let verdict = if unknowns == equations {
        styled(GOOD, "as many as there are equations")
    } else {
        styled(BAD, &format!("but {equations} equations"))
    };
    let mut text = format!("{name}: {unknowns} unknowns, {verdict}\n");
    for (heading, items) in [("unknowns", &census.unknowns), ("equations", &census.equations)] {
        let mut table = Table::new(&[heading]);
        for (what, count) in items {
            table.row(vec![what.clone(), count.to_string()]);
        }
        add(&mut text, &table);
    }
    let mut parameters = Table::new(&["parameters"]);
    for parameter in &model.parameters {
        parameters.row(vec![parameter.name.clone(), quantity(parameter.value, &parameter.unit, 6)]);
    }
    add(&mut text, &parameters);
    text += &inverse(model);
    let mut outputs = Table::new(&["outputs", "unit"]);
    for output in &model.outputs {
        let unit = if output.unit.is_empty() { "plain number" } else { &output.unit };
        let shape = if output.formulas.len() == 3 { "3 x " } else { "" };
        outputs.row(vec![output.name.clone(), format!("{shape}{unit}")]);
    }
    add(&mut text, &outputs);
    let mut studies = Table::new(&["studies", "kind"]);
    for study in &model.studies {
        studies.row(vec![study.name.clone(), study.kind.word().to_owned()]);
    }
    add(&mut text, &studies);
    text
}

/// What an inverse problem looks for, and from what.
fn inverse(model: &Model) -> String {
    if model.unknowns.is_empty() && model.targets.is_empty() {
        return String::new();
    }
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut text = format!(
        "\ninverse problem: {} to be found from {}\n",
        counted(model.unknowns.len(), "parameter"),
        counted(model.targets.len(), "target")
    );
    let mut unknowns = Table::new(&["to be found", "guess", "within"]);
    for unknown in &model.unknowns {
        let parameter = &model.parameters[unknown.parameter];
        let shown = |value: f64| quantity(value, &parameter.unit, 6);
        let range = unknown.range.map(|[low, high]| format!("{} to {}", shown(low), shown(high)));
        unknowns.row(vec![parameter.name.clone(), shown(parameter.value), range.unwrap_or_default()]);
    }
    add(&mut text, &unknowns);
    let mut targets = Table::new(&["targets", "wanted"]);
    for target in &model.targets {
        targets.row(vec![target.output.name.clone(), quantity(target.value, &target.output.unit, 6)]);
    }
    add(&mut text, &targets);
    text
}

fn add(text: &mut String, table: &Table) {
    if !table.is_empty() {
        text.push('\n');
        *text += &table.render();
    }
}

#[derive(Serialize)]
struct CheckDocument<'a> {
    flexura: &'static str,
    model: &'a str,
    study: &'static str,
    unknowns: usize,
    equations: usize,
    unknown_counts: Named<usize>,
    equation_counts: Named<usize>,
    parameters: Named<f64>,
    /// Of an inverse problem: the parameters to be found with their guesses.
    #[serde(skip_serializing_if = "Option::is_none")]
    guesses: Option<Named<f64>>,
    /// Of an inverse problem: the wanted values.
    #[serde(skip_serializing_if = "Option::is_none")]
    targets: Option<Named<f64>>,
    /// The studies in the file, by name: their kinds.
    #[serde(skip_serializing_if = "Option::is_none")]
    studies: Option<Named<&'static str>>,
    warnings: &'a [String],
}

impl<'a> CheckDocument<'a> {
    fn new(model: &'a Model, census: &'a Census) -> Self {
        let parameters = model.parameters.iter();
        let is_inverse = !model.unknowns.is_empty() || !model.targets.is_empty();
        let unknowns = model.unknowns.iter().map(|unknown| &model.parameters[unknown.parameter]);
        let targets = model.targets.iter().map(|target| (target.output.name.clone(), target.value));
        Self {
            flexura: env!("CARGO_PKG_VERSION"),
            model: &model.name,
            study: "check",
            unknowns: total(&census.unknowns),
            equations: total(&census.equations),
            unknown_counts: Named(census.unknowns.clone()),
            equation_counts: Named(census.equations.clone()),
            parameters: Named(
                parameters.map(|parameter| (parameter.name.clone(), parameter.value)).collect(),
            ),
            guesses: is_inverse.then(|| Named(unknowns.map(|p| (p.name.clone(), p.value)).collect())),
            targets: is_inverse.then(|| Named(targets.collect())),
            studies: (!model.studies.is_empty())
                .then(|| Named(model.studies.iter().map(|s| (s.name.clone(), s.kind.word())).collect())),
            warnings: &census.warnings,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura::model::{Output, Study, StudyKind, Target, Unknown};

    const ELASTICA: &str = include_str!("../../../../models/elastica.toml");

    fn elastica() -> Model {
        Document::parse(ELASTICA, "elastica.toml").and_then(|file| file.model(&[])).unwrap()
    }

    #[test]
    fn an_inverse_problem_tells_what_is_looked_for() {
        let mut model = elastica();
        assert_eq!(inverse(&model), "");
        let census = flexura::check(&model).unwrap();
        let text = to_json(&CheckDocument::new(&model, &census)).unwrap();
        assert!(!text.contains("guesses") && !text.contains("targets"));

        model.unknowns.push(Unknown { parameter: 0, range: Some([0.0, 50.0]) });
        let output = Output { name: "beam.rod.end.position.y".into(), ..model.outputs[0].clone() };
        model.targets.push(Target { output, value: 0.5 });
        let text = render(&model, &census);
        for words in [
            "1 parameter to be found from 1 target",
            "force",
            "0 N to 50 N",
            "beam.rod.end.position.y",
            "500 mm",
        ] {
            assert!(text.contains(words), "{words}: {text}");
        }
        let text = to_json(&CheckDocument::new(&model, &census)).unwrap();
        assert!(!text.contains("studies"));
        assert!(text.contains("\"guesses\": {\n    \"force\": 10.0"), "{text}");
    }
    #[test]
    fn the_studies_of_the_file_are_listed() {
        let mut model = elastica();
        let census = flexura::check(&model).unwrap();
        model.studies.push(Study { name: "equilibrium".into(), kind: StudyKind::Solve });
        assert!(render(&model, &census).contains("\n  equilibrium  solve\n"));
        let text = to_json(&CheckDocument::new(&model, &census)).unwrap();
        assert!(text.contains("\"equilibrium\": \"solve\""), "{text}");
    }
}
