//! What the tables of studies, and flags in their place, become.
#![allow(clippy::unwrap_used)]

use flexura_model::{
    BuckleStudy, CriticalStudy, Model, Probe, ProbeTarget, Quantity, Stop, StudyKind, Target, TraceStudy,
};
use flexura_modelfile::{Document, Flag};
use proptest::prelude::*;

const MECHANISM: &str = r#"
format = 1
[parameter]
push = "2 N"
slope = "30 deg"
depth = "20 mm"
bare = 3
[material.steel]
young = "207 GPa"
shear = "79.3 GPa"
[section.strip]
shape = "rectangle"
width = "20.32 mm"
height = "0.254 mm"
[beam.link]
material = "steel"
section = "strip"
length = "152.4 mm"
start = { body = "ground", hold = "clamp" }
end = { body = "slider", hold = "clamp" }
[body.slider]
at = ["152.4 mm", 0, 0]
[joint.way]
kind = "prismatic"
parent = { body = "ground", at = ["152.4 mm", 0, 0] }
child = "slider"
axis = [1, 0, 0]
[load.push]
body = "slider"
force = ["-push - bare", 0, "push*sin(slope)"]
[output]
w = "beam.link[0.5].position.z"
tip = "beam.link[0.5].position"
ratio = "beam.link[0.5].position.z/depth"
"#;

fn document(studies: &str) -> Document {
    Document::parse(&format!("{MECHANISM}{studies}"), "strip.toml").unwrap()
}

fn model(studies: &str) -> Model {
    document(studies).model(&[]).unwrap_or_else(|report| panic!("{report}"))
}

fn trace_of(model: &Model, position: usize) -> &TraceStudy {
    match &model.studies[position].kind {
        StudyKind::Trace(trace) => trace,
        other => panic!("{other:?}"),
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

#[test]
fn a_trace_has_sensible_defaults() {
    let model =
        model("[study.path]\nkind = \"trace\"\nparameter = \"push\"\nrange = [\"1 N\", \"0.04 kN\"]\n");
    assert_eq!(model.studies[0].name, "path");
    assert_eq!(*trace_of(&model, 0), TraceStudy { range: [1.0, 40.0], start: 1.0, ..TraceStudy::default() });
}

#[test]
fn every_key_of_a_trace_is_read() {
    let model = model(
        r#"
[study.equilibrium]
kind = "solve"
[study.path]
kind = "trace"
parameter = "slope"
range = ["pi/2", "30 deg - 30 deg"]
start = "45 deg"
steps = "40 + 60"
most_points = 500
branches = true
event = ["output.w = depth/2", "joint.way.coordinate + beam.link.end.position.x - output.tip.x = -0.01", "output.w/depth = 1", "output.ratio = 0.5"]
stop = ["fold", "fold 2", " branch  1 ", "event 3", "output.tip.z = 30 mm"]
guesses = 20
imperfection = { parameter = "push", from = "0.1 N" }
critical = { parameter = "depth", range = ["30 mm", "10 mm"], number = 2 }
"#,
    );
    assert_eq!(model.studies[0].kind, StudyKind::Solve);
    let trace = trace_of(&model, 1);
    assert_eq!(trace.parameter, 1);
    assert!(close(trace.range[0], std::f64::consts::FRAC_PI_2) && trace.range[1] == 0.0);
    assert!(close(trace.start, std::f64::consts::FRAC_PI_4));
    assert_eq!((trace.steps, trace.most_points, trace.branches, trace.guesses), (100, 500, 20, 20));
    assert_eq!(trace.imperfection, Some((0, 0.1)));
    assert_eq!(trace.critical, Some(CriticalStudy { parameter: 2, range: [0.03, 0.01], number: 2 }));

    let events: Vec<(&str, f64, usize)> = trace
        .events
        .iter()
        .map(|event| (event.output.name.as_str(), event.value, event.output.probes.len()))
        .collect();
    // A value that hangs on a parameter is brought to the left, where the parameter is read at every point.
    assert_eq!(events[0], ("output.w = depth/2", 0.0, 2));
    let parameter =
        |component| Probe { target: ProbeTarget::Model, quantity: Quantity::Parameter, component };
    let output = &trace.events[0].output;
    assert_eq!((output.probes[1], output.unit.as_str()), (parameter(2), "m"));
    assert!(close(output.formulas[0].evaluate(&[0.03, 0.02]), 0.02));
    assert!(matches!(output.probes[0].target, ProbeTarget::Beam(..)));
    assert_eq!((output.probes[0].quantity, output.probes[0].component), (Quantity::Position, 2));
    // An output brings all of its components along.
    assert_eq!((events[1].1, events[1].2), (-0.01, 5));
    let output = &trace.events[2].output;
    assert_eq!((output.probes[1], trace.events[2].value), (parameter(2), 1.0));
    assert!(close(output.formulas[0].evaluate(&[0.01, 0.04]), 0.25));
    // And so within an output that an event refers to.
    let Target { output, value } = &trace.events[3];
    assert!(output.probes.contains(&parameter(2)) && *value == 0.5);

    assert_eq!(trace.stops[..4], [Stop::Fold(1), Stop::Fold(2), Stop::Branch(1), Stop::Event(3)]);
    let Stop::Value(target) = &trace.stops[4] else { panic!("{:?}", trace.stops[4]) };
    assert_eq!((target.output.name.as_str(), target.value), ("output.tip.z = 30 mm", 0.03));
}

#[test]
fn one_text_stands_for_a_list_of_one() {
    let text = "[study.path]\nkind = \"trace\"\nparameter = \"bare\"\nrange = [\"1 N\", 2]\nstop = \"fold 3\"\nevent = \"output.w = 0\"\nbranches = 4\n";
    let model = model(text);
    let trace = trace_of(&model, 0);
    assert_eq!((&trace.stops[..], trace.events.len(), trace.branches), (&[Stop::Fold(3)][..], 1, 4));
    // A parameter without a unit takes any.
    assert_eq!(trace.range, [1.0, 2.0]);
}

#[test]
fn buckling_is_about_a_parameter_or_about_all_loads() {
    let text = "[study.all]\nkind = \"buckle\"\n[study.one]\nkind = \"buckle\"\nparameter = \"push\"\nat = \"1 N\"\ncount = 5\n";
    let kinds: Vec<StudyKind> = model(text).studies.into_iter().map(|study| study.kind).collect();
    let expected = [
        BuckleStudy { parameter: None, at: 0.0, count: 3 },
        BuckleStudy { parameter: Some(0), at: 1.0, count: 5 },
    ];
    assert_eq!(kinds, expected.map(StudyKind::Buckle));
}

#[test]
fn studies_are_repeated_like_every_named_table() {
    let text = "[study.\"to_{i}\"]\nrepeat = { i = [1, 3] }\nkind = \"trace\"\nparameter = \"push\"\nrange = [0, \"{i}*10 N\"]\n";
    let model = model(text);
    let ends: Vec<(&str, f64)> = model
        .studies
        .iter()
        .enumerate()
        .map(|(i, study)| (study.name.as_str(), trace_of(&model, i).range[1]))
        .collect();
    assert_eq!(ends, [("to_1", 10.0), ("to_2", 20.0), ("to_3", 30.0)]);
}

#[test]
fn a_neighbouring_model_keeps_the_studies_though_a_range_loses_its_length() {
    let text = "[study.path]\nkind = \"trace\"\nparameter = \"depth\"\nrange = [\"depth\", \"30 mm\"]\n";
    let document = document(text);
    let base = document.model(&[]).unwrap();
    let other = [("depth".to_string(), "30 mm".to_string())];
    let beside = base.at(&[(2, 0.03)]).unwrap();
    assert_eq!((&beside.studies, beside.parameters[2].value), (&base.studies, 0.03));
    // With other values of its parameters a study of the file may have lost its meaning; that is told where it is done.
    assert!(document.model(&other).is_ok());
}

#[test]
fn a_power_that_needs_its_parameter_keeps_its_value_in_an_output() {
    let text = "cubed = \"body.slider.position.x^bare\"\n[study.path]\nkind = \"trace\"\nparameter = \"push\"\nrange = [0, 1]\nevent = \"output.cubed = 1 m^3\"\n";
    let model = model(text);
    let event = &trace_of(&model, 0).events[0];
    assert!(close(event.output.formulas[0].evaluate(&[2.0]), 8.0) && event.output.probes.len() == 1);
}

fn flags(list: &[(&'static str, &str)]) -> Vec<Flag> {
    let value = |value: &str| (!value.is_empty()).then(|| value.to_owned());
    list.iter().map(|(flag, text)| (*flag, value(text))).collect()
}

#[test]
fn flags_are_read_as_the_table_of_a_study() {
    let table = r#"
[study.trace]
kind = "trace"
parameter = "push"
range = ["0 N", "max(10 N, 40 N)"]
start = "1 N"
steps = 80
most_points = 300
branches = true
event = ["output.w = 1 mm", "joint.way.effort = 0"]
stop = ["fold 2"]
guesses = 7
imperfection = { parameter = "slope", from = "100 deg" }
critical = { parameter = "depth", range = ["10 mm", "30 mm"], number = 2 }
"#;
    let typed = flags(&[
        ("parameter", "push"),
        ("range", "0 N:max(10 N, 40 N)"),
        ("start", "1 N"),
        ("steps", "80"),
        ("most-points", "300"),
        ("branches", ""),
        ("event", "output.w = 1 mm"),
        ("event", "joint.way.effort = 0"),
        ("stop", "fold 2"),
        ("guesses", "7"),
        ("imperfection", "slope = 100 deg"),
        ("critical", "depth=10 mm : 30 mm"),
        ("critical-number", "2"),
    ]);
    let written = document(table);
    // The file has a study of that name already; this one gets another.
    let model = written.with_study("trace", &typed).unwrap().model(&[]).unwrap_or_else(|r| panic!("{r}"));
    assert_eq!(model.studies.len(), 2);
    assert_eq!(trace_of(&model, 1), trace_of(&model, 0));
    assert_eq!(model.studies[1].name, "trace_");

    let none = document("").with_study("buckle", &[]).unwrap().model(&[]).unwrap();
    assert_eq!(none.studies[0].kind, StudyKind::Buckle(BuckleStudy { parameter: None, at: 0.0, count: 3 }));
}

/// What is said of flags, as it is shown.
fn refusal(kind: &str, typed: &[(&'static str, &str)]) -> String {
    let found = document("").with_study(kind, &flags(typed)).and_then(|document| document.model(&[]));
    found.unwrap_err().render(false)
}

#[test]
fn a_mistake_in_a_flag_is_shown_where_it_was_typed() {
    let shown = refusal("trace", &[("parameter", "pusch"), ("range", "0 N:40 N")]);
    let expected = "error: there is no parameter `pusch`\n\
                    --> command line:1:19\n  |\n1 | trace --parameter pusch --range \"0 N:40 N\"\n  |                   ^^^^^\n  |\n\
                    \x20 = help: did you mean `push`?\n";
    assert_eq!(shown.replace("\n ", "\n"), expected.replace("\n ", "\n"));

    let shown = refusal("trace", &[("parameter", "push"), ("range", "0 N:40 mm"), ("stop", "fould 2")]);
    assert!(
        shown.contains("expected a force (N), found a length (m)") && shown.contains("did you mean `fold`?"),
        "{shown}"
    );
    assert!(shown.contains("--stop \"fould 2\"") && !shown.contains("study."), "{shown}");
}

#[test]
fn flags_of_another_form_are_refused() {
    let good = [("parameter", "push"), ("range", "0:40")];
    let cases = [
        ("range", "0 N", "two ends with a colon between them"),
        ("range", "0 N:1 N:5", "this has 3 parts"),
        ("imperfection", "slope", "no equals sign"),
        ("critical", "slope=1", "--critical weight=\"0 N:2 N\""),
        ("critical", "0:1", "no equals sign"),
        ("critical", "push=0:1", "is the parameter that is traced"),
        ("start", "50 N", "not in the range 0 N to 40 N"),
        ("steps", "2.5", "expected a whole number, found 2.5"),
        ("steps", "-1", "expected a whole number, found -1"),
        ("branches", "many", "expected true, false or a whole number, found \"many\""),
        ("event", "output.v = 1 mm", "did you mean `w`?"),
        ("event", "", "expected an event, found true or false"),
        ("range", "4:4", "both ends of the range are 4 N"),
    ];
    for (flag, value, words) in cases {
        let mut typed: Vec<(&'static str, &str)> =
            good.into_iter().filter(|(name, _)| *name != flag).collect();
        typed.push((flag, value));
        let shown = refusal("trace", &typed);
        assert!(shown.contains(words), "{flag} {value}: {shown}");
    }
    let shown = refusal("buckle", &[("at", "2 N")]);
    assert!(shown.contains("it is a fraction of the load"), "{shown}");
}

const STUDIES: &str = r#"
[study."path_{i}"]
repeat = { i = 2 }
kind = "trace"
parameter = "push"
range = ["{i} N", "depth/(1 mm)*1 N"]
start = "3 N"
steps = 40
most_points = "10*bare"
branches = true
event = ["output.w = depth/2", "output.tip.x - joint.way.coordinate = 0.1"]
stop = ["fold {i+1}", "event 3", "output.ratio = 0.5"]
guesses = 3
imperfection = { parameter = "slope", from = "100 deg" }
critical = { parameter = "depth", range = ["10 mm", "30 mm"], number = 2 }
[study.buckling]
kind = "buckle"
parameter = "push"
at = "1 N"
count = 2
"#;

fn check(text: &str) {
    match Document::parse(text, "mutilated.toml").and_then(|document| document.model(&[])) {
        Ok(model) => assert!(model.validate().is_empty()),
        Err(report) => {
            for problem in report.problems() {
                assert!(text.get(problem.span.clone()).is_some());
            }
            assert!(report.render(true).starts_with('\u{1b}'));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn mutilated_studies_never_panic(
        edits in prop::collection::vec((0usize..STUDIES.len(), 0u8..4, any::<u8>(), 0usize..STUDIES.len()), 1..5)
    ) {
        let mut bytes = STUDIES.as_bytes().to_vec();
        for (place, what, byte, other) in edits {
            let place = place % bytes.len();
            match what {
                0 => { bytes.remove(place); }
                1 => bytes.insert(place, byte),
                2 => bytes[place] = byte,
                _ => {
                    let from = other % bytes.len();
                    let piece: Vec<u8> = bytes[from..(from + 20).min(bytes.len())].to_vec();
                    bytes.splice(place..place, piece);
                }
            }
        }
        check(&format!("{MECHANISM}{}", String::from_utf8_lossy(&bytes)));
    }

    #[test]
    fn values_of_studies_exchanged_for_others_never_panic(
        line in 0usize..STUDIES.lines().count(),
        value in prop::sample::select(vec![
            "1", "-1", "0", "inf", "nan", "1e300", "2.5", "\"\"", "\"x\"", "\"1 N\"", "\"=\"", "\"=1\"", "\"output.w=\"", "[]", "[1, 2, 3]",
            "[[1]]", "{}", "{ parameter = 3 }", "true", "1979-05-27", "[\"fold\", 3]", "\"output.tip = 1 mm\"", "\"push = push\"",
            "\"output.w^bare = 1\"", "\"beam.link[depth].position.x = depth\"", "[\"1 N\", \"1/0\"]", "\"é = ü\"",
        ]),
    ) {
        let text: Vec<String> = STUDIES.lines().enumerate().map(|(i, old)| match old.split_once(" = ") {
            Some((key, _)) if i == line => format!("{key} = {value}"),
            _ => old.to_string(),
        }).collect();
        check(&format!("{MECHANISM}{}", text.join("\n")));
    }

    #[test]
    fn strange_flags_never_panic(
        flag in prop::sample::select(vec![
            "parameter", "range", "start", "steps", "branches", "event", "stop", "imperfection", "critical", "critical-number",
        ]),
        value in "[a-z0-9=:.,()\\[\\] '\"é-]{0,12}",
    ) {
        let good = [("parameter", "push"), ("range", "0:1"), ("critical", "slope=0:1")];
        let mut typed: Vec<Flag> = good
            .into_iter()
            .filter(|(name, _)| *name != flag)
            .map(|(name, value)| (name, Some(value.to_owned())))
            .collect();
        typed.push((flag, Some(value)));
        let document = Document::parse(&format!("{MECHANISM}{STUDIES}"), "x.toml").unwrap();
        match document.with_study("trace", &typed).and_then(|document| document.model(&[])) {
            Ok(model) => prop_assert_eq!(model.studies.len(), 4),
            Err(report) => prop_assert!(report.render(false).starts_with("error: ")),
        }
    }
}
