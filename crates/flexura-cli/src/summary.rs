//! What a person reads after a solve.

use crate::quantity::{number, quantity, rotation, size, strain, vector};
use crate::screen::{BAD, BOLD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::post::{
    BeamPeaks, BeamSummary, CoordinateSummary, OutputResult, OutputValue, Peak, Scales, Summary,
};
use flexura::solution::Status;

/// Rows of a table; the files and the document hold all.
const MOST_ROWS: usize = 40;

/// The summary as text.
pub fn render(summary: &Summary) -> String {
    let mut text = headline(summary);
    text += &found(summary);
    let sections = [
        outputs(summary),
        beams(summary),
        bodies(summary),
        joints(summary),
        couplings(summary),
        springs(summary),
        cables(summary),
        tubes(summary),
    ];
    for section in sections.into_iter().filter(|section| !section.is_empty()) {
        text.push('\n');
        text += &section.shortened(MOST_ROWS).render();
    }
    if summary.beams.iter().any(|beam| beam.peaks.is_none()) {
        text += &format!("\n{}\n", styled(DIM, "no stress where a section is given as a stiffness"));
    }
    text += &format!("\nstrain energy  {}\n", quantity(summary.energy, "J", 5));
    if summary.status == Status::Converged {
        text += &format!("stability      {}\n", stability(summary));
    }
    text
}

/// "stable", "unstable in 2 directions", or why neither is said.
fn stability(summary: &Summary) -> String {
    match (summary.unstable_directions, &summary.stability_reason) {
        (Some(0), _) => styled(GOOD, "stable"),
        (Some(1), _) => styled(BAD, "unstable in 1 direction"),
        (Some(count), _) => styled(BAD, &format!("unstable in {count} directions")),
        (None, Some(reason)) => format!("not decided: {reason}"),
        (None, None) => "not decided".to_owned(),
    }
}

/// How far a study that did not converge has come: "stalled at 43 % of the load".
pub fn standstill(status: Status, load_fraction: f64) -> String {
    if load_fraction == 1.0 {
        return status.word().replace('_', " ");
    }
    format!("{} at {} % of the load", status.word().replace('_', " "), number(100.0 * load_fraction, 3))
}

fn headline(summary: &Summary) -> String {
    let name = title(&summary.model);
    let state = match summary.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &standstill(status, summary.load_fraction)),
    };
    let steps = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let mut work = steps(summary.newton_steps, "Newton step");
    if summary.load_steps > 1 {
        work += &format!(" over {}", steps(summary.load_steps, "load step"));
    }
    let error = if summary.error_estimate.is_finite() {
        format!("estimated relative error {}", size(summary.error_estimate))
    } else {
        "error not estimated".to_owned()
    };
    let residual = if summary.residual.is_finite() {
        format!("residual {}", size(summary.residual))
    } else {
        "no residual there".to_owned()
    };
    let mut text = format!("{name}: {state}\n");
    text += &format!("  {}\n", styled(DIM, &format!("{work}, {error}, {residual}")));
    if summary.status != Status::Converged {
        text += if summary.load_fraction < 1.0 {
            "  what follows is how far it came, not the answer\n"
        } else {
            "  what follows does not have the accuracy that was asked for\n"
        };
    }
    text
}

/// What an inverse problem was solved for: "found: push = 3.2 N".
fn found(summary: &Summary) -> String {
    if summary.found.is_empty() {
        return String::new();
    }
    let word = if summary.status == Status::Converged { "found" } else { "tried last" };
    let values = summary.found.iter();
    let list: Vec<String> =
        values.map(|(name, value, unit)| format!("{name} = {}", quantity(*value, unit, 6))).collect();
    format!("\n{} {}\n", styled(BOLD, &format!("{word}:")), list.join(", "))
}

fn outputs(summary: &Summary) -> Table {
    let mut table = Table::new(&["outputs"]);
    for output in &summary.outputs {
        table.row(vec![output.name.clone(), output_value(output, &summary.scales)]);
    }
    table
}

/// An output's value as a person reads it.
pub fn output_value(output: &OutputResult, scales: &Scales) -> String {
    let quiet = |value: f64| if scales.hides(value, &output.unit) { 0.0 } else { value };
    match output.value {
        OutputValue::Number(value) if output.is_strain => strain(value, 6),
        OutputValue::Number(value) => quantity(quiet(value), &output.unit, 6),
        OutputValue::Vector(values) => vector(values.map(quiet), &output.unit, 6),
    }
}

/// The value, or zero where it is nothing but rounding noise beside the other values of its kind.
fn quiet(value: f64, unit: &str, summary: &Summary) -> f64 {
    if summary.scales.hides(value, unit) { 0.0 } else { value }
}

fn beams(summary: &Summary) -> Table {
    let has_safety = summary.beams.iter().any(|beam| beam.has_yield_strength);
    let has_stress = summary.beams.iter().any(|beam| beam.peaks.is_some());
    let mut headings = vec!["beams", "length"];
    if has_stress {
        headings.extend(["largest strain", "axial", "bending", "torsion", "von Mises", "at"]);
    }
    if has_safety {
        headings.push("safety");
    }
    let mut table = Table::new(&headings);
    let mut beams: Vec<&BeamSummary> = summary.beams.iter().collect();
    if beams.len() > MOST_ROWS {
        // What is shown of a network is what is strained most.
        let strain = |beam: &BeamSummary| beam.peaks.as_ref().map_or(0.0, |peaks| peaks.strain.value.abs());
        beams.sort_by(|a, b| strain(b).total_cmp(&strain(a)));
    }
    for beam in beams {
        let mut row = vec![beam.name.clone(), quantity(beam.length, "m", 4)];
        match &beam.peaks {
            Some(peaks) => row.extend(beam_row(beam, peaks, has_safety)),
            None if has_stress => row.extend(headings[2..].iter().map(|_| "-".to_owned())),
            None => {}
        }
        table.row(row);
    }
    table
}

fn beam_row(beam: &BeamSummary, peaks: &BeamPeaks, has_safety: bool) -> Vec<String> {
    let pascal = |peak: Peak| {
        // Rounding noise of a stress beside the others is none.
        let is_noise = peak.value.abs() < 1e-10 * peaks.von_mises.value.abs();
        quantity(if is_noise { 0.0 } else { peak.value }, "Pa", 4)
    };
    let mut row = vec![
        strain(peaks.strain.value, 4),
        pascal(peaks.axial),
        pascal(peaks.bending),
        pascal(peaks.torsion),
        pascal(peaks.von_mises),
        format!("s = {}", quantity(peaks.von_mises.s, "m", 4)),
    ];
    if has_safety {
        row.push(match peaks.safety_factor {
            Some(factor) if factor >= 1000.0 => "> 1000".to_owned(),
            Some(factor) if factor < 1.0 => format!("{} (yields)", number(factor, 3)),
            Some(factor) => number(factor, 3),
            None if beam.has_yield_strength => "unstressed".to_owned(),
            None => "no yield strength".to_owned(),
        });
    }
    row
}

fn bodies(summary: &Summary) -> Table {
    let mut table = Table::new(&["bodies", "position", "rotation", "moved by"]);
    for body in &summary.bodies {
        table.row(vec![
            body.name.clone(),
            vector(<[f64; 3]>::from(body.position).map(|c| quiet(c, "m", summary)), "m", 6),
            rotation(body.rotation.into()),
            quantity(quiet(body.displacement, "m", summary), "m", 4),
        ]);
    }
    table
}

fn joints(summary: &Summary) -> Table {
    let mut table = Table::new(&["joints", "coordinate", "effort", "force", "moment"]);
    for joint in &summary.joints {
        let values = |pick: &dyn Fn(&CoordinateSummary) -> String| {
            let named = joint.coordinates.iter().map(|coordinate| match coordinate.name {
                "" => pick(coordinate),
                name => format!("{name} {}", pick(coordinate)),
            });
            named.collect::<Vec<_>>().join("; ")
        };
        table.row(vec![
            joint.name.clone(),
            values(&|q| quantity(quiet(q.value, q.unit, summary), q.unit, 5)),
            values(&|q| quantity(quiet(q.effort, q.effort_unit, summary), q.effort_unit, 5)),
            vector(<[f64; 3]>::from(joint.force).map(|c| quiet(c, "N", summary)), "N", 4),
            vector(<[f64; 3]>::from(joint.moment).map(|c| quiet(c, "N*m", summary)), "N*m", 4),
        ]);
    }
    table
}

fn springs(summary: &Summary) -> Table {
    let mut table = Table::new(&["springs", "length", "tension", "strain"]);
    for (name, length, tension, strain) in &summary.springs {
        let strain = strain.map_or("-".to_string(), |strain| number(strain, 4));
        table.row(vec![name.clone(), quantity(*length, "m", 5), quantity(*tension, "N", 5), strain]);
    }
    table
}

fn couplings(summary: &Summary) -> Table {
    let mut table = Table::new(&["couplings", "effort per factor (SI)"]);
    for (name, multiplier) in &summary.couplings {
        table.row(vec![name.clone(), number(*multiplier, 5)]);
    }
    table
}

fn cables(summary: &Summary) -> Table {
    let mut table = Table::new(&["cables", "length", "tension"]);
    for (name, length, tension) in &summary.cables {
        table.row(vec![name.clone(), quantity(*length, "m", 5), quantity(*tension, "N", 5)]);
    }
    table
}

fn tubes(summary: &Summary) -> Table {
    let mut table = Table::new(&["tubes", "tip", "length", "torque at the base"]);
    for tubes in &summary.tubes {
        let torque = |torque: &f64| quantity(quiet(*torque, "N*m", summary), "N*m", 4);
        table.row(vec![
            tubes.name.clone(),
            vector(<[f64; 3]>::from(tubes.tip).map(|c| quiet(c, "m", summary)), "m", 6),
            quantity(tubes.length, "m", 5),
            tubes.torques.iter().map(torque).collect::<Vec<_>>().join("; "),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura::model::{Cable, CableLaw, Coupling, Frame, Mount, SectionId, Tube, Tubes};
    use flexura::modelfile::Document;
    use flexura::post::{evaluate, summarise};
    use flexura::solution::{CableSolution, TubesSample, TubesSolution};
    use flexura::spatial::{Pose, Vector3, Wrench};

    const ELASTICA: &str = include_str!("../../../models/elastica.toml");

    #[test]
    fn the_verdict_on_stability_stands_behind_the_energy() {
        let model = Document::parse(ELASTICA, "elastica.toml").and_then(|file| file.model(&[])).unwrap();
        let mut solution = flexura::solve(&model, &flexura::Options::default(), &mut |_| {}).unwrap();
        let mut says = |count: Option<usize>, reason: Option<&str>, status: Status, wanted: &str| {
            solution.unstable_directions = count;
            solution.stability_reason = reason.map(str::to_owned);
            solution.status = status;
            let text = render(&summarise(&model, &solution, &evaluate(&model, &solution).unwrap()));
            let behind = text.split_once("\nstrain energy  ").and_then(|(_, rest)| rest.split_once('\n'));
            let plain = behind.map(|(_, rest)| {
                ["[1m", "[31m", "[32m", "[0m"]
                    .iter()
                    .fold(rest.to_owned(), |text, style| text.replace(&format!("\u{1b}{style}"), ""))
            });
            assert_eq!(plain.as_deref(), Some(wanted), "{text}");
        };
        says(Some(0), None, Status::Converged, "stability      stable\n");
        says(Some(1), None, Status::Converged, "stability      unstable in 1 direction\n");
        says(Some(2), None, Status::Converged, "stability      unstable in 2 directions\n");
        let reason = Some("load.jet: it follows the tip");
        says(None, reason, Status::Converged, "stability      not decided: load.jet: it follows the tip\n");
        says(None, reason, Status::Stalled, "");
    }

    #[test]
    fn what_was_found_stands_before_everything_else() {
        let mut model = Document::parse(ELASTICA, "elastica.toml").and_then(|file| file.model(&[])).unwrap();
        let mut solution = flexura::solve(&model, &flexura::Options::default(), &mut |_| {}).unwrap();
        let text = |model: &_, solution: &_| {
            render(&summarise(model, solution, &evaluate(model, solution).unwrap()))
        };
        let plain = text(&model, &solution);
        assert!(
            !plain.contains("found")
                && !plain.contains("cables")
                && !plain.contains("couplings")
                && !plain.contains("tubes")
        );

        solution.found = vec![(0, 3.2)];
        model.cables.push(Cable { name: "tendon".into(), route: Vec::new(), law: CableLaw::Tension(3.0) });
        solution.cables.push(CableSolution { course: Vec::new(), length: 0.25, tension: 3.0 });
        model.couplings.push(Coupling { name: "gear".into(), terms: Vec::new(), offset: 0.0 });
        solution.couplings.push(0.5);
        let tube = Tube {
            material: None,
            section: SectionId(0),
            straight: 0.0,
            curved: 0.2,
            curvature: 0.0,
            rotation: 0.0,
            translation: 0.0,
        };
        model.tubes.push(Tubes {
            name: "robot".into(),
            base: Frame { mount: Mount::Ground, pose: Pose::identity() },
            tubes: vec![tube.clone(), tube],
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
        });
        let sample = |s: f64| TubesSample {
            s,
            pose: Pose::translation(Vector3::new(s, 0.0, 0.0)),
            wrench: Wrench::zero(),
            curvature: Vector3::zeros(),
            angles: vec![(0, 0.0), (1, 0.1)],
            torques: vec![(0, -0.012), (1, 0.012)],
        };
        solution.tubes.push(TubesSolution { samples: vec![sample(0.0), sample(0.2)] });
        let full = text(&model, &solution);
        let found = full.find("force = 3.2 N").unwrap();
        assert!(full.contains("found:") && found < full.find("outputs").unwrap(), "{full}");
        let robot = "robot  (200, 0, 0) mm  200 mm  -12 mN·m; 12 mN·m";
        for words in ["tendon  250 mm  3 N", "gear", "effort per factor", "torque at the base", robot] {
            assert!(full.contains(words), "{words}: {full}");
        }
        solution.status = Status::Stalled;
        assert!(text(&model, &solution).contains("tried last:"));
    }
}
