//! Cables that run in channels along beams.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::model::{Cable, CableLaw, Guide, Model};
use flexura::modelfile::Document;
use flexura::post::OutputValue;
use flexura::solution::{Solution, Status};
use flexura::{Equilibrium, Options, solve_model};

const ROBOT: &str = r#"
format = 1
gravity = [0, 0, -9.81]
[material.steel]
young = "200 GPa"
shear = "77 GPa"
density = "7850 kg/m^3"
[section.rod]
shape = "circle"
diameter = "1.2 mm"
[beam.rod]
material = "steel"
section = "rod"
length = "200 mm"
start = { body = "ground", hold = "clamp" }
[cable.straight]
tension = "5 N"
route = [{ beam = "rod", from = 0, to = 1, offset = ["6 mm", "2 mm"] }]
[cable.winding]
tension = "3 N"
route = [
    { body = "ground", at = ["-30 mm", "5 mm", 0] },
    { beam = "rod", from = 0, to = 0.8, offset = ["6 mm * cos(20*s/(1 m))", "6 mm * sin(20*s/(1 m))"] },
    { body = "ground", at = ["150 mm", "60 mm", "80 mm"] },
]
[load.tip]
beam = "rod"
at = 1.0
force = ["0.05 N", "-0.2 N", "0.1 N"]
"#;

fn read(text: &str) -> Model {
    match Document::parse(text, "test.toml").and_then(|document| document.model(&[])) {
        Ok(model) => model,
        Err(errors) => panic!("{errors}"),
    }
}

fn solve(model: &Model) -> Solution {
    solve_to(1e-11, model)
}

fn solve_to(tolerance: f64, model: &Model) -> Solution {
    let options = Options { tolerance, ..Options::default() };
    let solution = flexura::solve(model, &options, &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    solution
}

fn tip(solution: &Solution) -> flexura::spatial::Vector3<f64> {
    solution.beams[0].samples.last().unwrap().pose.position
}

/// Many eyelets, straight between them, are the channel in the limit; the polygon errs by the square of its sides.
#[test]
fn many_point_guides_converge_to_the_channel_with_order_two() {
    let channel = "route = [{ beam = \"rod\", from = 0, to = 1, offset = [\"6 mm\", \"2 mm\"] }]";
    let whole = solve(&read(ROBOT));
    let miss = |count: usize| {
        let points: Vec<String> = (0..=count)
            .map(|i| {
                let at = i as f64 / count as f64;
                format!("{{ beam = \"rod\", at = {at:?}, offset = [0, \"6 mm\", \"2 mm\"] }}")
            })
            .collect();
        let text = ROBOT.replace(channel, &format!("route = [{}]", points.join(", ")));
        assert_ne!(text, ROBOT);
        let solution = solve(&read(&text));
        let length = solution.cables[0].length - whole.cables[0].length;
        [(tip(&solution) - tip(&whole)).norm(), length.abs()]
    };
    let (coarse, fine) = (miss(16), miss(32));
    for (a, b) in coarse.iter().zip(&fine) {
        let order = (a / b).log2();
        assert!((order - 2.0).abs() < 0.1, "order {order}: {coarse:?} and {fine:?}");
    }
}

/// Straight parts and channels: the length that a pull makes asks for that pull.
#[test]
fn a_cable_of_the_length_that_a_pull_gives_has_that_tension() {
    let mut model = read(ROBOT);
    let pulled = solve(&model);
    for (cable, result) in model.cables.iter_mut().zip(&pulled.cables) {
        cable.law = CableLaw::Length(result.length);
    }
    let kept = solve(&model);
    assert!((tip(&kept) - tip(&pulled)).norm() < 1e-10 * 0.2);
    for (a, b) in kept.cables.iter().zip(&pulled.cables) {
        assert!((a.tension - b.tension).abs() < 1e-8 * b.tension, "{} and {}", a.tension, b.tension);
        assert!((a.length - b.length).abs() < 1e-11);
        assert_eq!(a.course.len(), b.course.len());
    }
}

/// Loads of a hundred and of three hundred times the rod's EI/L², with a tendon of given length, whose span stays one
/// shooting segment where another would be cut into three.
#[test]
fn a_tendon_of_given_length_holds_a_strongly_loaded_rod() {
    for (force, tolerance) in [(50.0, 1e-9), (150.0, 1e-8)] {
        let text = ROBOT.replace(
            "[\"0.05 N\", \"-0.2 N\", \"0.1 N\"]",
            &format!("[\"{force} N\", \"-{} N\", \"{} N\"]", 0.1 * force, 0.03 * force),
        );
        assert_ne!(text, ROBOT);
        let mut model = read(&text);
        model.cables.truncate(1);
        let pulled = solve_to(tolerance, &model);
        model.cables[0].law = CableLaw::Length(pulled.cables[0].length);
        let kept = solve_to(tolerance, &model);
        assert!((kept.cables[0].tension - 5.0).abs() < 1e-3, "{}", kept.cables[0].tension);
        assert!((tip(&kept) - tip(&pulled)).norm() < 1e-7, "{force} N");
    }
}

/// The work of both tensions has one second derivative: ∂ℓ_1/∂T_2 = ∂ℓ_2/∂T_1.
#[test]
fn how_one_tension_changes_the_other_length_is_reciprocal() {
    let model = read(ROBOT);
    let with = |which: usize, change: f64| {
        let mut model = model.clone();
        let CableLaw::Tension(tension) = &mut model.cables[which].law else { panic!() };
        *tension += change;
        solve(&model).cables[1 - which].length
    };
    let slope = |which: usize| {
        let h = 0.05;
        let d = |h: f64| (with(which, h) - with(which, -h)) / (2.0 * h);
        (4.0 * d(h) - d(2.0 * h)) / 3.0
    };
    let (first, second) = (slope(1), slope(0));
    assert!(first.abs() > 1e-6, "the test must measure something: {first}");
    assert!((first - second).abs() < 1e-6 * first.abs(), "{first} and {second}");
}

/// Where the support holds, the anchored tendon is inside: the reaction is the load alone, and the beam's own force is
/// less by the pull.
#[test]
fn a_beam_reports_what_it_carries_itself() {
    let mut model = read(ROBOT);
    model.cables.truncate(1);
    let solution = solve(&model);
    let first = &solution.beams[0].samples[0];
    let local = first.pose.rotation.inverse() * first.wrench.force;
    assert!(local.x < -4.9, "the tendon presses the rod together: {local}");
    let last = solution.beams[0].samples.last().unwrap();
    let axis = last.pose.rotation.inverse() * last.wrench.force;
    assert!((axis.x + 5.0).abs() < 0.3, "{axis}");
    // The course runs along the channel, at its offset.
    let course = &solution.cables[0].course;
    assert!(course.len() >= solution.beams[0].samples.len());
    assert!((course[0] - flexura::spatial::Vector3::new(0.0, 6e-3, 2e-3)).norm() < 1e-12);
}

/// Two channels that meet are one, however they are written, and a channel may be run backwards.
#[test]
fn a_channel_may_be_cut_and_reversed() {
    let one = solve(&read(ROBOT));
    let mut model = read(ROBOT);
    let Cable { route, .. } = &mut model.cables[0];
    let Guide::Channel { beam, offset, .. } = route[0].clone() else { panic!() };
    let part = |from: f64, to: f64| Guide::Channel {
        beam,
        between: [from, to].map(flexura::model::At::Fraction),
        offset: offset.clone(),
    };
    *route = vec![part(1.0, 0.6), part(0.6, 0.0)];
    let two = solve(&model);
    assert!((tip(&one) - tip(&two)).norm() < 1e-12);
    assert!((one.cables[0].length - two.cables[0].length).abs() < 1e-12);
}

fn refused(text: &str) -> String {
    Equilibrium::new(&read(text)).unwrap_err().to_string()
}

#[test]
fn channels_that_make_no_sense_are_refused() {
    let point = "{ body = \"ground\", at = [0, \"6 mm\", 0] },\n    { beam";
    let message =
        refused(&ROBOT.replace("{ body = \"ground\", at = [\"-30 mm\", \"5 mm\", 0] },\n    { beam", point));
    assert!(message.contains("coincide"), "{message}");
    let curved = ROBOT
        .replace("length = \"200 mm\"", "curve = { kind = \"arc\", radius = \"5 mm\", angle = \"90 deg\" }");
    let message = refused(&curved);
    assert!(message.contains("beyond the centre about which beam.rod is curved"), "{message}");
}

/// Outputs by parameters of tendons, pulled and kept, against differences of whole solves.
#[test]
fn sensitivities_see_tendons() {
    let text = ROBOT
        .replace("tension = \"5 N\"", "tension = \"pull\"")
        .replace("tension = \"3 N\"", "length = \"wound\"")
        .replace("[\"6 mm\", \"2 mm\"]", "[\"aside\", \"2 mm\"]")
        + "[parameter]\npull = \"5 N\"\nwound = \"240 mm\"\naside = \"6 mm\"\n\
           [output]\ntip = \"beam.rod.end.position\"\nlength = \"cable.straight.length\"\n\
           tension = \"cable.winding.tension\"\nmoment = \"beam.rod.start.moment\"\n";
    let document = Document::parse(&text, "test.toml").unwrap();
    let solve = |overrides: &[(String, String)], sensitivities| {
        let model = document.model(overrides).unwrap();
        let options = Options { tolerance: 1e-12, samples: 3, sensitivities, ..Options::default() };
        let (solution, model) = solve_model(&model, &options, &mut |_| {}).unwrap();
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let evaluation = flexura::post::evaluate(&model, &solution).unwrap();
        let flat = |value| match value {
            OutputValue::Number(v) => vec![v],
            OutputValue::Vector(v) => v.to_vec(),
        };
        let values: Vec<f64> = evaluation.outputs.iter().flat_map(|o| flat(o.value)).collect();
        (values, solution, model)
    };
    let (base, solution, model) = solve(&[], true);
    let found = solution.sensitivities.unwrap();
    let whole = |by: &Vec<Option<f64>>| by.iter().copied().collect::<Option<Vec<f64>>>().unwrap();
    let flat: Vec<Vec<f64>> = found.outputs.iter().flatten().map(whole).collect();
    assert_eq!((model.parameters.len(), base.len()), (3, 8));
    for (p, parameter) in model.parameters.iter().enumerate() {
        let h = 1e-3 * parameter.value;
        let at = |factor: f64| {
            let text = format!("{:e} {}", parameter.value + factor * h, parameter.unit);
            solve(&[(parameter.name.clone(), text)], false).0
        };
        let s = [1.0, -1.0, 2.0, -2.0].map(at);
        for i in 0..base.len() {
            let difference = (8.0 * (s[0][i] - s[1][i]) - (s[2][i] - s[3][i])) / (12.0 * h);
            let size = difference.abs().max(base[i].abs() / parameter.value);
            let error = (flat[i][p] - difference).abs();
            assert!(error <= 1e-6 * size, "{i} by {}: {} against {difference}", parameter.name, flat[i][p]);
        }
    }
}

/// A result puts the mechanism back where it was, its tendons pulling.
#[test]
fn a_result_with_tendons_can_be_started_from() {
    let mut model = read(ROBOT);
    model.cables.truncate(1);
    let pulled = solve(&model);
    for law in [model.cables[0].law, CableLaw::Length(pulled.cables[0].length)] {
        model.cables[0].law = law;
        let solution = solve(&model);
        let mut problem = Equilibrium::new(&model).unwrap();
        problem.stand(&solution);
        let size = problem.residual_size();
        assert!(size < 1e-6, "{size}");
    }
}

/// A channel on the axis of a rod that does not stretch has one length, whatever the rod does.
#[test]
fn a_tendon_that_nothing_can_lengthen_is_named() {
    let text = ROBOT
        .replace("tension = \"5 N\"", "length = \"190 mm\"")
        .replace("[\"6 mm\", \"2 mm\"]", "[0, 0]")
        .replace("length = \"200 mm\"", "length = \"200 mm\"\nextension = false");
    let solution = flexura::solve(&read(&text), &Options::default(), &mut |_| {});
    let message = match solution {
        Err(error) => error.to_string(),
        Ok(solution) => {
            assert_ne!(solution.status, Status::Converged);
            solution.reason.unwrap_or_default()
        }
    };
    assert!(message.contains("cable.straight"), "{message}");
}
