//! Studies as a Rust user would write them, each wrong in one way.

use flexura_model::{
    BuckleStudy, CriticalStudy, Model, Output, Parameter, Stop, Study, StudyKind, Target, TraceStudy, Unknown,
};

fn model(studies: Vec<StudyKind>) -> Model {
    let parameter = |name: &str, value: f64, unit: &str| Parameter {
        name: name.into(),
        value,
        unit: unit.into(),
        ..Parameter::default()
    };
    let named = studies.into_iter().enumerate().map(|(i, kind)| Study { name: format!("s{i}"), kind });
    Model {
        parameters: vec![
            parameter("push", 2.0, "N"),
            parameter("slope", std::f64::consts::FRAC_PI_6, "rad"),
            parameter("plain", 1.0, ""),
        ],
        studies: named.collect(),
        ..Model::default()
    }
}

fn good() -> TraceStudy {
    TraceStudy { range: [0.0, 40.0], ..TraceStudy::default() }
}

/// Path and message of everything that is wrong with a trace.
fn wrong(change: impl Fn(&mut TraceStudy)) -> Vec<String> {
    let mut trace = good();
    change(&mut trace);
    told(&model(vec![StudyKind::Trace(trace)]))
}

fn told(model: &Model) -> Vec<String> {
    model.validate().into_iter().map(|issue| format!("{}: {}", issue.path, issue.message)).collect()
}

#[test]
fn sound_studies_have_no_issue() {
    let backwards = TraceStudy { range: [40.0, 0.0], start: 10.0, ..good() };
    let rich = TraceStudy {
        stops: vec![Stop::Fold(1), Stop::Branch(2), Stop::Event(3)],
        imperfection: Some((1, 0.6)),
        critical: Some(CriticalStudy { parameter: 1, range: [0.0, 1.0], number: 1 }),
        ..good()
    };
    let buckle = BuckleStudy { parameter: None, at: 0.0, count: 3 };
    let kinds = [good(), backwards, rich].map(StudyKind::Trace);
    let more = [StudyKind::Solve, StudyKind::Buckle(buckle)];
    assert_eq!(told(&model(kinds.into_iter().chain(more).collect())), [""; 0]);
}

#[test]
fn each_mistake_of_a_trace_is_found_where_it_is() {
    assert_eq!(wrong(|t| t.parameter = 9), ["study.s0.parameter: refers to a parameter that does not exist"]);
    assert_eq!(wrong(|t| t.range = [0.0, 0.0]), ["study.s0.range: both ends of the range are 0 N"]);
    assert_eq!(wrong(|t| t.range[1] = f64::NAN), ["study.s0.range: must be a finite number, is NaN"]);
    assert_eq!(
        wrong(|t| t.start = 50.0),
        ["study.s0.start: the path would start at 50 N, which is not in the range 0 N to 40 N"]
    );
    assert_eq!(wrong(|t| t.steps = 0), ["study.s0.steps: must be at least 1, is 0"]);
    assert_eq!(wrong(|t| t.most_points = 1), ["study.s0.most_points: must be at least 2, is 1"]);
    assert_eq!(
        wrong(|t| t.stops = vec![Stop::Fold(1), Stop::Branch(0)]),
        ["study.s0.stop[1]: folds, branch points and events are counted from 1"]
    );
    let output = Output { name: "x".into(), unit: String::new(), formulas: Vec::new(), probes: Vec::new() };
    let event = Target { output, value: f64::INFINITY };
    assert_eq!(
        wrong(|t| t.events = vec![event.clone()]),
        [
            "study.s0.event[0]: an event must have one formula",
            "study.s0.event[0]: must be a finite number, is inf"
        ]
    );
    let imperfection = wrong(|t| t.imperfection = Some((0, 1.0)));
    assert_eq!(
        imperfection,
        [
            "study.s0.imperfection.parameter: `push` is the parameter that is traced and cannot be the imperfection too"
        ]
    );
    assert_eq!(
        wrong(|t| t.imperfection = Some((1, std::f64::consts::FRAC_PI_6))),
        ["study.s0.imperfection.from: the imperfection begins at 30 deg, the value that `slope` has anyway"]
    );
    let critical = |parameter, range, number| CriticalStudy { parameter, range, number };
    assert_eq!(
        wrong(|t| t.critical = Some(critical(2, [1.0, 1.0], 0))),
        [
            "study.s0.critical.number: must be at least 1, is 0",
            "study.s0.critical.range: both ends of the range are 1"
        ]
    );
    assert_eq!(
        wrong(|t| t.critical = Some(critical(1, [0.6, 1.0], 1))),
        [
            "study.s0.critical.range: the critical point is followed from `slope` = 30 deg, which is not in the range"
        ]
    );
}

#[test]
fn each_mistake_of_buckling_is_found_where_it_is() {
    let buckle =
        |parameter, at, count| told(&model(vec![StudyKind::Buckle(BuckleStudy { parameter, at, count })]));
    assert_eq!(buckle(Some(7), 0.0, 3), ["study.s0.parameter: refers to a parameter that does not exist"]);
    assert_eq!(buckle(None, f64::NAN, 3), ["study.s0.at: must be a finite number, is NaN"]);
    assert_eq!(buckle(None, 0.0, 0), ["study.s0.count: must be at least 1, is 0"]);
}

#[test]
fn names_of_studies_are_given_once() {
    let mut model = model(vec![StudyKind::Solve; 2]);
    model.studies[1].name = "s0".into();
    assert_eq!(told(&model), ["study.s0: the name `s0` is given twice"]);
}

#[test]
fn an_inverse_problem_is_only_solved() {
    let buckle = BuckleStudy { parameter: None, at: 0.0, count: 3 };
    let mut model = model(vec![StudyKind::Solve, StudyKind::Trace(good()), StudyKind::Buckle(buckle)]);
    model.unknowns.push(Unknown { parameter: 1, range: None });
    let told = model.studies.iter().flat_map(|study| model.study_issues(study));
    let told: Vec<String> = told.map(|issue| format!("{}: {}", issue.path, issue.message)).collect();
    assert_eq!(
        told,
        [
            "study.s1.kind: an inverse problem cannot be traced: its unknown `slope` has no value before it is solved",
            "study.s2.kind: an inverse problem cannot be asked for critical loads: its unknown `slope` has no value before it is solved"
        ]
    );
}
