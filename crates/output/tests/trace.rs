//! Documents, tables and pictures of a made-up trace.
#![allow(clippy::unwrap_used)]

#[path = "common/path.rs"]
mod path;

use flexura_model::{Model, TraceStudy};
use flexura_output::{
    OutputError, TraceView, buckling_document, critical_csv, diagram_svg, modes_csv, modes_svg, path_csv,
    shapes_svg, to_json, trace_document,
};
use flexura_post::evaluate;
use flexura_solution::{Branch, BranchOrigin, Status, Trace, TracePoint};
use path::{CRITICAL, LENGTH, buckling, direction, model, point, study, trace};
use serde_json::Value;

fn view<'a>(model: &'a Model, study: &'a TraceStudy, trace: &'a Trace) -> TraceView<'a> {
    TraceView::new(model, study, trace)
}

fn with_view<T>(trace: &Trace, then: impl FnOnce(&TraceView<'_>) -> T) -> T {
    let (model, study) = (model(), study());
    then(&view(&model, &study, trace))
}

fn json(trace: &Trace) -> Value {
    let text = with_view(trace, |view| to_json(&trace_document(view).unwrap()).unwrap());
    serde_json::from_str(&text).unwrap()
}

fn keep(name: &str, text: &str) {
    // FLEXURA_PICTURES keeps the picture for a look.
    if let Ok(folder) = std::env::var("FLEXURA_PICTURES") {
        std::fs::write(std::path::Path::new(&folder).join(name), text).unwrap();
    }
}

#[test]
fn the_document_holds_every_point_of_every_branch() {
    let document = json(&trace());
    assert_eq!((&document["study"], &document["status"]), (&"trace".into(), &"stalled".into()));
    assert_eq!((&document["parameter"], &document["range"][1]), (&"push".into(), &40.0.into()));
    assert_eq!(document["parameters"]["slope"], 1.0);
    assert_eq!(document["warnings"][0], "the strip is thin");
    assert_eq!(document["work"]["inertias"], 40);
    assert_eq!(document.get("stability_reason"), None);
    let branches = document["branches"].as_array().unwrap();
    let counts: Vec<usize> = branches.iter().map(|b| b["points"].as_array().unwrap().len()).collect();
    assert_eq!(counts, [11, 15, 7]);

    let origins: Vec<&Value> = branches.iter().map(|branch| &branch["origin"]).collect();
    assert_eq!(origins, ["rest", "branch_point", "search"]);
    assert_eq!((&branches[1]["from_branch"], &branches[1]["from_point"]), (&0.into(), &2.into()));
    assert_eq!(branches[0].get("from_branch"), None);
    assert_eq!(branches[0]["ends"], serde_json::json!(["start", "range"]));
    assert_eq!(branches[0].get("end_reasons"), None);
    assert_eq!(branches[1]["ends"][1], "stalled");
    assert!(branches[1]["end_reasons"][1].as_str().unwrap().contains("touches itself"));
}

#[test]
fn a_point_has_its_kind_outputs_verdict_and_state() {
    let document = json(&trace());
    let point = |branch: usize, number: usize| &document["branches"][branch]["points"][number];
    let start = point(0, 0);
    assert_eq!((&start["kind"], &start["parameter"]), (&"end".into(), &0.0.into()));
    assert_eq!((&start["stable"], &start["unstable_directions"]), (&true.into(), &0.into()));
    assert_eq!(start["outputs"]["middle"].as_array().unwrap().len(), 3);
    // An output without a value is null, with the reason.
    assert_eq!(start["outputs"].get("ratio, odd"), Some(&Value::Null));
    assert_eq!(start["output_reasons"], serde_json::json!({ "ratio, odd": path::NO_VALUE }));
    assert_eq!(point(0, 0)["outputs"].as_object().unwrap().len(), 4);
    assert_eq!(start["beams"]["link"]["s"].as_array().unwrap().len(), 21);
    assert!(start["beams"]["link"]["stress"].is_array());
    assert!((start["bodies"]["slider"]["position"][0].as_f64().unwrap() - LENGTH).abs() < 1e-12);
    assert!(start["joints"]["way"]["coordinates"].is_array() && start["energy"].is_number());
    assert_eq!(start.get("crossing"), None);

    let branch = point(0, 2);
    assert_eq!((&branch["kind"], &branch["crossing"]), (&"branch".into(), &"supercritical_pitchfork".into()));
    assert_eq!((&branch["stable"], &branch["unstable_directions"]), (&Value::Null, &Value::Null));
    let shape = &branch["directions"][0];
    assert_eq!(shape["beams"]["link"]["displacement"].as_array().unwrap().len(), 21);
    assert_eq!(shape["beams"]["link"]["displacement"][10][2], 1.0);
    assert!(shape["bodies"]["slider"]["turning"].is_array());
    assert_eq!(point(0, 6)["crossing"], "multiple");

    let regular = point(0, 1);
    assert_eq!((regular["kind"].as_str(), regular.get("beams")), (Some("regular"), None));
    assert_eq!(regular.get("directions"), None);
    assert_eq!(regular["error_estimate"], 3e-10);

    let event = point(1, 5);
    assert_eq!((&event["kind"], &event["event"]), (&"event".into(), &"output.w = 30 mm".into()));
    assert!(event["outputs"]["ratio, odd"].is_number());
    assert_eq!(point(1, 11)["kind"], "fold");
    assert!(point(1, 11)["beams"].is_object());
}

#[test]
fn the_critical_curve_names_both_parameters() {
    let document = json(&trace());
    let critical = &document["critical"];
    assert_eq!((&critical["parameter"], &critical["kind"]), (&"slope".into(), &"fold".into()));
    assert_eq!(critical["ends"], serde_json::json!(["range", "point_limit"]));
    let last = critical["points"].as_array().unwrap().last().unwrap();
    assert_eq!((&last["second_parameter"], &last["parameter"]), (&1.25.into(), &15.0.into()));
    assert_eq!(json(&Trace { critical: None, ..trace() }).get("critical"), None);
}

#[test]
fn a_number_that_is_none_is_refused_by_its_place() {
    let mut broken = trace();
    broken.branches[1].points[3].outputs[1] = Some(vec![f64::NAN]);
    let field = |trace: &Trace| match with_view(trace, trace_document).unwrap_err() {
        OutputError::NotFinite { field, .. } => field,
        error => panic!("{error}"),
    };
    assert_eq!(field(&broken), "branches[1].points[3].outputs.slide");
    assert!(with_view(&broken, path_csv).is_err());
    let mut broken = trace();
    broken.branches[0].points[0].solution.as_mut().unwrap().beams[0].samples[2].pose.position.x =
        f64::INFINITY;
    assert_eq!(field(&broken), "branches[0].points[0].beams.link.position[2]");

    // What broke off need not have an estimate; what converged must.
    let mut without = trace();
    without.branches[1].points[3].error_estimate = f64::NAN;
    assert_eq!(json(&without)["branches"][1]["points"][3]["error_estimate"], Value::Null);
    without.status = Status::Converged;
    assert_eq!(field(&without), "branches[1].points[3].error_estimate");
}

#[test]
fn the_state_is_written_with_the_model_that_belongs_to_it() {
    let (plain, study, trace) = (model(), study(), trace());
    let mut model = plain.clone();
    model.bind("material.steel.young", "1e9*(push + 3)*slope").unwrap();
    let document = |model: &Model| -> Value {
        let view = TraceView::new(model, &study, &trace);
        serde_json::from_str(&to_json(&trace_document(&view).unwrap()).unwrap()).unwrap()
    };
    let (bound, unbound) = (document(&model), document(&plain));
    let largest = |point: &Value| {
        let strain = point["beams"]["link"]["strain"].as_array()?;
        Some(strain.iter().map(|value| value.as_f64().unwrap()).fold(0.0, f64::max))
    };
    let mut compared = 0;
    let branches = (0..2).map(|i| (format!("/branches/{i}/points"), 1.0));
    // Of branches the traced parameter alone changes, of the critical curve both.
    for (place, slope) in branches.chain([("/critical/points".to_string(), 0.5)]) {
        let [ours, theirs] = [&bound, &unbound].map(|all| all.pointer(&place).unwrap().as_array().unwrap());
        for (a, b) in ours.iter().zip(theirs) {
            let (Some(ours), Some(theirs)) = (largest(a), largest(b)) else { continue };
            if a.get("second_parameter").is_some_and(|second| *second != slope) {
                continue;
            }
            let push = a["parameter"].as_f64().unwrap();
            let expected = theirs * 207e9 / (1e9 * (push + 3.0) * slope);
            assert!((ours - expected).abs() <= 1e-12 * expected.abs(), "{place}: {ours} for {expected}");
            compared += 1;
        }
    }
    assert!(compared >= 3, "{compared}");
}

#[test]
fn the_table_has_a_row_for_each_point() {
    let text = with_view(&trace(), path_csv).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!(
        rows[0],
        "branch,point,kind,push [N],w [m],slide [m],middle.x [m],middle.y [m],middle.z [m],\"ratio, odd\",\
         stable,unstable_directions,arc,error_estimate,detail,reason"
    );
    assert_eq!(rows.len(), 1 + 11 + 15 + 7);
    let cells: Vec<&str> = rows[1].split(',').collect();
    assert_eq!((cells[0], cells[1], cells[2], cells[3]), ("1", "1", "end", "0.0"));
    assert_eq!(cells[9..13], ["", "true", "0", "0.0"]);
    assert!(
        rows[3].starts_with("1,3,branch,9.757,")
            && rows[3].ends_with(
                ",,,0.243925,3e-10,supercritical_pitchfork,\"output `ratio` is NaN, not a finite number\""
            )
    );
    assert!(rows[17].starts_with("2,6,event,") && rows[17].ends_with(",output.w = 30 mm,"), "{}", rows[17]);
    assert!(rows[33].starts_with("3,7,end,30.0,"));

    let critical = with_view(&trace(), critical_csv).unwrap().unwrap();
    let rows: Vec<&str> = critical.lines().collect();
    assert!(rows[0].starts_with("point,slope [rad],push [N],w [m],") && rows[1].starts_with("1,0.5,18.0,"));
    assert_eq!(rows.len(), 5);
    assert!(with_view(&Trace { critical: None, ..trace() }, critical_csv).unwrap().is_none());
}

#[test]
fn buckling_is_an_equilibrium_with_modes() {
    let (model, buckling) = (model(), buckling());
    let evaluation = evaluate(&model, &buckling.solution).unwrap();
    let text = to_json(&buckling_document(&model, &buckling, &evaluation).unwrap()).unwrap();
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&document["study"], &document["status"]), (&"buckle".into(), &"converged".into()));
    assert_eq!((&document["parameter"], &document["at"]), (&"push".into(), &0.0.into()));
    let modes = document["modes"].as_array().unwrap();
    assert_eq!(modes[0]["value"], CRITICAL);
    assert_eq!(modes[0]["shape"]["beams"]["link"]["displacement"][10][2], 1.0);
    assert!(modes[1]["error_estimate"].as_f64().unwrap() > 0.0);
    assert!(document["beams"]["link"]["position"].is_array() && document["outputs"]["w"].is_number());

    let table = modes_csv(&model, &buckling).unwrap();
    assert!(table.starts_with("mode,push [N],error_estimate [N]\n1,9.757,"), "{table}");
    let all = flexura_solution::Buckling { parameter: None, ..buckling.clone() };
    assert!(modes_csv(&model, &all).unwrap().starts_with("mode,load_fraction,error_estimate\n"));
    let document = buckling_document(&model, &all, &evaluation).unwrap();
    assert_eq!(serde_json::to_value(&document).unwrap()["parameter"], Value::Null);

    let mut broken = buckling;
    broken.modes[1].direction.bodies[0].linear.x = f64::NAN;
    let error = buckling_document(&model, &broken, &evaluation).unwrap_err().to_string();
    assert!(error.contains("modes[1].bodies.slider.displacement"), "{error}");
}

/// How often a picture holds something.
fn count(text: &str, what: &str) -> usize {
    text.matches(what).count()
}

#[test]
fn the_diagram_has_a_panel_for_each_output_and_a_style_for_each_verdict() {
    let text = with_view(&trace(), diagram_svg);
    keep("diagram.svg", &text);
    // w, slide, middle.x and middle.z; the ratio is one too many, and middle.y never changes.
    for words in [">w / mm<", ">slide / mm<", ">middle.x / mm<", ">middle.z / mm<", ">push / N<"] {
        assert!(text.contains(words), "{words}");
    }
    assert!(!text.contains("middle.y") && text.contains("1 more output not shown"));
    for words in [
        "stable",
        "unstable",
        "stability not decided",
        "fold",
        "branch point",
        "event",
        "not followed further",
    ] {
        assert!(text.contains(&format!(">{words}<")), "{words}");
    }
    for words in [">1: from rest<", ">2: from branch 1<", ">3: found by search<", "3 branches, 33 points"] {
        assert!(text.contains(words), "{words}");
    }
    // In four panels the first branch is unstable before and behind its second branch point, the second one stable once.
    assert_eq!(count(&text, "stroke=\"#0072b2\" stroke-width=\"1.7\" stroke-dasharray=\"5 5\"/>"), 2 * 4);
    assert_eq!(count(&text, "stroke=\"#d55e00\" stroke-width=\"2.2\"/>"), 4);
    assert_eq!(count(&text, "stroke=\"#9a9a9a\" stroke-width=\"1.3\"/>"), 4 + 1);
    // The fold in four panels and the legend.
    assert_eq!(count(&text, "r=\"4.4\" fill=\"#222222\""), 5);
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

#[test]
fn one_output_gets_the_whole_picture() {
    let mut model = model();
    let mut trace = trace();
    model.outputs.truncate(1);
    trace.branches.truncate(2);
    trace.critical = None;
    for point in trace.branches.iter_mut().flat_map(|branch| &mut branch.points) {
        point.outputs.truncate(1);
    }
    let study = study();
    let text = diagram_svg(&view(&model, &study, &trace));
    keep("diagram_one.svg", &text);
    assert!(text.contains("width=\"660\"") && text.contains(">w / mm<"));
}

#[test]
fn without_outputs_the_diagram_shows_how_far_it_moved() {
    let mut model = model();
    let mut trace = trace();
    model.outputs.clear();
    for point in trace.branches.iter_mut().flat_map(|branch| &mut branch.points) {
        point.outputs.clear();
    }
    let study = study();
    let text = diagram_svg(&view(&model, &study, &trace));
    keep("diagram_moved.svg", &text);
    assert!(text.contains("largest displacement / mm"));
}

#[test]
fn pictures_of_next_to_nothing_are_pictures() {
    let (model, study) = (model(), study());
    let one = |point: TracePoint| Branch {
        origin: BranchOrigin::Rest,
        points: vec![point],
        ..trace().branches[0].clone()
    };
    let single = point(1.0, 0.0, 0.0, flexura_solution::PointKind::End, Some(0));
    for branches in
        [Vec::new(), vec![one(single.clone())], vec![Branch { points: Vec::new(), ..one(single) }]]
    {
        let trace = Trace { branches, critical: None, ..trace() };
        let view = view(&model, &study, &trace);
        for text in [diagram_svg(&view), shapes_svg(&view)] {
            assert!(text.ends_with("</svg>\n") && !text.contains("NaN") && !text.contains("inf"), "{text}");
        }
        assert!(path_csv(&view).is_ok());
    }
}

#[test]
fn shapes_along_the_path_are_coloured_and_special_ones_stand_out() {
    let text = with_view(&trace(), shapes_svg);
    keep("shapes.svg", &text);
    for words in
        ["front view (xz)", "initial shape", "fold", "branch point", "event", ">push / N<", "clamped strip"]
    {
        assert!(text.contains(words), "{words}");
    }
    // It stays in a plane: one view.
    assert!(!text.contains("top view"));
    // Two branch points, twice the same, the event and the fold, each on a dark ground.
    assert_eq!(count(&text, "fill=\"none\" stroke=\"#222222\" stroke-width=\"4\"/>"), 5);
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

#[test]
fn modes_are_drawn_on_the_base_shape() {
    let (model, buckling) = (model(), buckling());
    let text = modes_svg(&model, &buckling);
    keep("modes.svg", &text);
    for words in [">at 0 N<", ">1: 9.757 N<", ">2: 20.002 N (turns only)<", "critical values of push"] {
        assert!(text.contains(words), "{words}");
    }
    let aslant = flexura_spatial::Vector3::new(0.0, 0.6, 0.8);
    let mut spatial = buckling;
    spatial.modes[1].direction = direction();
    for twist in spatial.modes[1].direction.beams.iter_mut().flatten() {
        twist.angular =
            aslant.cross(&flexura_spatial::Vector3::x()) * twist.angular.y.abs().copysign(-twist.angular.y);
        twist.linear = aslant * twist.linear.z;
    }
    let text = modes_svg(&model, &spatial);
    keep("modes_spatial.svg", &text);
    assert!(text.contains("top view (xy)") && text.contains("side view (yz)"));
}
