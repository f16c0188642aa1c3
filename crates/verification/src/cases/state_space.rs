//! Linear models for control beside the response of the whole mechanism.

use crate::{Case, Row};
use flexura::modelfile::Document;
use flexura::{Options, StateSpaceRequest, state_space};
use flexura_model::ModesStudy;
use flexura_solution::StateSpace;

pub const CASES: [Case; 1] = [Case {
    id: "state_space",
    title: "State space of a cantilever with six modes: tip response up to the sixth frequency, residues, static gain",
    citation: "receptance L³ (sin β cosh β - cos β sinh β)/(EI β³ (1 + cos β cosh β)) (R. E. D. Bishop and D. C. Johnson, *The Mechanics \
               of Vibration* (1960), table 7.1); residues 4/m of all modes",
    needed: "1e-6",
    run: response,
    closed_form: None,
}];

const NEEDED: f64 = 1e-6;
/// Frequencies, rad/s in units of √(EI/ρAL⁴), between those of the modes.
const PLACES: [f64; 6] = [1.0, 10.0, 40.0, 55.0, 80.0, 100.0];

fn ask(residual_vectors: Option<usize>) -> Result<StateSpace, String> {
    let text = "format = 1\nname = \"cantilever\"\n[section.rod]\nshape = \"stiffness\"\nGJ = 0.8\nEI2 = 40\nEI3 = 1\nmass_per_length = 1\n\
                rotary_inertia = [1e-3, 0, 0]\n[beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\n\
                start = { body = \"ground\", hold = \"clamp\" }\n[load.tip]\nbeam = \"rod\"\nat = 1\nforce = [0, 0, 0]\n\
                [output]\ntip = \"beam.rod.end.displacement.y\"\n";
    let file = Document::parse(text, "cantilever.toml").map_err(|report| report.render(false))?;
    let model = file.model(&[]).map_err(|report| report.render(false))?;
    let request = StateSpaceRequest {
        inputs: vec!["load.tip.force.y".to_string()],
        outputs: vec!["tip".to_string()],
        damping_ratio: 0.0,
        residual_vectors,
    };
    let study = ModesStudy { count: 6, at_rest: true, path: None };
    state_space(&model, &study, &request, &Options::default(), &mut |_| {}).map_err(|error| error.to_string())
}

fn response() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (asked, title) in [(None, "residual vectors by themselves"), (Some(3), "three residual vectors")] {
        let space = ask(asked)?;
        for omega in PLACES {
            let beta: f64 = omega.sqrt();
            let exact = (beta.sin() * beta.cosh() - beta.cos() * beta.sinh())
                / (beta.powi(3) * (1.0 + beta.cos() * beta.cosh()));
            let found = space.response(omega).ok_or("a pole between modes")?[0][0][0];
            rows.push(Row::relative(format!("response at {omega}, {title}"), exact, found, NEEDED));
        }
    }
    let plain = ask(Some(0))?;
    let still = plain.response(0.0).ok_or("a pole at standstill")?[0][0][0];
    rows.push(Row::relative("static gain, static correction alone", 1.0 / 3.0, still, NEEDED));
    let n = plain.squares.len();
    for (i, name) in [(0, "first"), (1, "second")] {
        let residue = plain.c[0][i] * plain.b[n + i][0];
        rows.push(Row::relative(format!("residue of the {name} mode"), 4.0, residue, NEEDED));
    }
    Ok(rows)
}
