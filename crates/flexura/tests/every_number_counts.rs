//! No number of a model file is ignored in silence: each that is changed changes the answer, or is refused, but for those
//! that are known to say something else.
#![allow(clippy::unwrap_used)]

use flexura::modelfile::Document;
use flexura::post::evaluate_each;
use flexura::solution::Status;
use flexura::{FileFamily, Options, solve_family};
use std::path::{Path, PathBuf};

/// Tables whose numbers are not about the equilibrium itself.
const ASIDE: &[&str] = &["output", "study", "target", "unknown"];

/// Numbers that may change nothing, with why: model, table, key.
const KNOWN: &[(&str, &str, &str, &str)] = &[];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models")
}

/// Everything that a person would read off: forces, places, stresses, outputs; None where there is no equilibrium.
fn answer(text: &str, name: &Path) -> Option<Vec<f64>> {
    let document = Document::parse(text, &name.display().to_string()).ok()?;
    let model = document.model(&[]).ok()?;
    let mut family = FileFamily::new(&document, &[], &model);
    let options = Options { samples: 3, ..Options::default() };
    let (solution, model) = solve_family(&model, &mut family, &options, &mut |_| {}).ok()?;
    if solution.status != Status::Converged {
        return None;
    }
    let evaluation = evaluate_each(&model, &solution);
    let mut numbers = vec![solution.energy, solution.load_fraction];
    for beam in &solution.beams {
        for sample in &beam.samples {
            numbers.extend(sample.pose.position.iter());
            numbers.extend(sample.wrench.force.iter());
            numbers.extend(sample.wrench.moment.iter());
            numbers.extend(sample.pose.rotation.coords.iter());
        }
    }
    for stress in evaluation.beams.iter().flatten() {
        numbers.extend([stress.peaks.von_mises.value, stress.peaks.safety_factor.unwrap_or(0.0)]);
    }
    for body in &solution.bodies {
        numbers.extend(body.position.iter());
        numbers.extend(body.rotation.coords.iter());
    }
    for joint in &solution.joints {
        numbers.extend(joint.wrench.force.iter());
        numbers.extend(joint.wrench.moment.iter());
        numbers.extend(joint.coordinates.iter().chain(&joint.efforts));
    }
    numbers.extend(solution.springs.iter().flat_map(|spring| [spring.length, spring.tension]));
    numbers.extend(solution.cables.iter().flat_map(|cable| [cable.length, cable.tension]));
    numbers.extend(solution.warnings.iter().map(|warning| warning.len() as f64));
    Some(numbers)
}

/// The number at `at` in a line times 1.3, where that is a number of its own and not zero.
fn changed(line: &str, at: usize, length: usize) -> Option<String> {
    let number: f64 = line[at..at + length].parse().ok().filter(|number| *number != 0.0)?;
    let whole = number.fract() == 0.0 && !line[at..at + length].contains('.');
    // Counts and indices stay whole.
    let other = if whole && number < 20.0 && !line.contains('"') { number + 1.0 } else { number * 1.3 };
    Some(format!("{}{other:?}{}", &line[..at], &line[at + length..]))
}

/// Where numbers stand in a line, outside of names.
fn numbers(line: &str) -> Vec<(usize, usize)> {
    let code = line.find('#').map_or(line, |comment| &line[..comment]);
    let bytes = code.as_bytes();
    let mut found = Vec::new();
    let mut at = code.find('=').map_or(0, |equals| equals + 1);
    while at < bytes.len() {
        let before = bytes[..at].last().copied().unwrap_or(b' ');
        let in_name = before.is_ascii_alphanumeric() || before == b'_' || before == b'.' || before == b'^';
        if bytes[at].is_ascii_digit() && !in_name {
            let end = code[at..]
                .find(|c: char| !(c.is_ascii_digit() || c == '.'))
                .map_or(code.len(), |length| at + length);
            found.push((at, end - at));
            at = end;
        } else {
            at += 1;
        }
    }
    found
}

#[test]
fn every_number_of_the_bundled_models_counts() {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    paths.sort();
    let mut idle = Vec::new();
    let (mut tried, mut refused) = (0, 0);
    for path in paths {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if ["lattice", "lattice_3d"].contains(&name.as_str()) {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let Some(before) = answer(&text, &path) else { continue };
        let lines: Vec<&str> = text.lines().collect();
        let mut table = String::new();
        for (i, line) in lines.iter().enumerate() {
            if line.starts_with('[') {
                table = line.trim_matches(['[', ']']).to_owned();
            }
            let kind = table.split('.').next().unwrap_or_default();
            let key = line.split('=').next().unwrap_or_default().trim();
            if !line.contains('=')
                || ASIDE.contains(&kind)
                || key == "format"
                || key == "name"
                || line.starts_with('#')
            {
                continue;
            }
            for (at, length) in numbers(line) {
                let Some(other) = changed(line, at, length) else { continue };
                let mut damaged = lines.clone();
                damaged[i] = &other;
                let after = answer(&damaged.join("\n"), &path);
                tried += 1;
                let Some(after) = after else {
                    refused += 1;
                    continue;
                };
                let scale = before.iter().chain(&after).fold(0.0f64, |a, b| a.max(b.abs()));
                let same = before.len() == after.len()
                    && before
                        .iter()
                        .zip(&after)
                        .all(|(a, b)| (a - b).abs() <= 1e-12 * a.abs().max(b.abs()).max(1e-9 * scale));
                let known =
                    KNOWN.iter().any(|(model, of, word, _)| *model == name && *of == table && *word == key);
                if same && !known {
                    idle.push(format!("{name}: [{table}] {other}"));
                }
            }
        }
    }
    println!("{tried} numbers, {refused} refused, {} without effect", idle.len());
    assert!(idle.is_empty(), "numbers without effect:\n{}", idle.join("\n"));
}

#[test]
fn parameters_that_nothing_uses_have_no_derivative_and_take_no_time() {
    let mut text = std::fs::read_to_string(folder().join("elastica.toml")).unwrap();
    let many: String = (0..1000).map(|i| format!("spare_{i} = \"{i} mm\"\n")).collect();
    text = text.replacen("[parameter]\n", &format!("[parameter]\n{many}"), 1);
    let document = Document::parse(&text, "many.toml").unwrap();
    let model = document.model(&[]).unwrap();
    let mut family = FileFamily::new(&document, &[], &model);
    let options = Options { sensitivities: true, ..Options::default() };
    let start = std::time::Instant::now();
    let (solution, model) = solve_family(&model, &mut family, &options, &mut |_| {}).unwrap();
    // Trying out every parameter makes 60 models of each, which took half a minute.
    assert!(start.elapsed().as_secs_f64() < 10.0, "{:?}", start.elapsed());
    let derivatives = solution.sensitivities.unwrap();
    assert_eq!(derivatives.parameters.len(), model.parameters.len());
    for components in &derivatives.outputs {
        for component in components {
            for (position, derivative) in derivatives.parameters.iter().zip(component) {
                let is_spare = model.parameters[*position].name.starts_with("spare_");
                assert!(*derivative == Some(0.0) || !is_spare, "{}", model.parameters[*position].name);
            }
        }
    }
    let force = model.parameters.iter().position(|parameter| parameter.name == "force").unwrap();
    assert!(derivatives.outputs.iter().flatten().any(|component| component[force] != Some(0.0)));
}
