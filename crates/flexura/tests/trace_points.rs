//! Points of a trace: what is kept with them, where branches start and stop, events, and parameters of every kind.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use flexura::solution::{BranchEnd, PointKind, Status, TracePoint};
use support::{Run, bundled, run, traced};

const PUSH: &str = "parameter = \"push\"\nrange = [0, 25]";

fn strip(more: &str) -> String {
    bundled("strip_on_slope.toml", &format!("{PUSH}\n{more}"))
}

fn last(run: &Run) -> &TracePoint {
    run.trace.branches[0].points.last().unwrap()
}

/// The state that is kept with a point is that point's, also where something special lay in the step before it.
#[test]
fn kept_states_are_those_of_their_points() {
    let mut kept = 0;
    for steps in [13, 21, 34, 40, 41, 42, 43, 55, 70] {
        let text = bundled(
            "strip_on_slope.toml",
            &format!(
                "{PUSH}\nsteps = {steps}\nbranches = true\nevent = [\"output.w = -push/90\", \"output.u1 = -0.1\", \"output.u1 = -0.2\"]"
            ),
        );
        for slope in ["0 deg", "90 deg"] {
            let found = traced(&text, &[("slope", slope)], 1e-8);
            for point in found.points() {
                let Some(solution) = &point.solution else { continue };
                let middle = solution.beams[0].samples.iter().find(|s| (s.s - 0.0762).abs() < 1e-9).unwrap();
                let (state, read) = (middle.pose.position.z / 0.1524, found.value(point, "w"));
                assert!(
                    (state - read).abs() < 1e-7,
                    "{steps} {slope} {:?} at {}: {state} {read}",
                    point.kind,
                    point.parameter
                );
                kept += usize::from(point.kind == PointKind::Regular);
            }
        }
    }
    assert!(kept > 30, "{kept}");
}

#[test]
fn branches_end_where_a_stop_says() {
    let by_value = traced(&strip("stop = \"output.w = -0.25\""), &[], 1e-9);
    assert_eq!(by_value.trace.branches[0].ends[1], BranchEnd::Stop);
    assert!((by_value.value(last(&by_value), "w") + 0.25).abs() < 1e-10);
    assert_eq!(last(&by_value).kind, PointKind::End);
    let lee = |more: &str| {
        traced(
            &bundled("lee_frame.toml", &format!("parameter = \"load\"\nrange = [0, 2.5]\n{more}")),
            &[],
            1e-9,
        )
    };
    for (stop, count, load) in [("fold", 1, 1.85567), ("fold 2", 2, -0.94144), ("event 1", 1, 1.85567)] {
        let found = run(
            &bundled(
                "lee_frame.toml",
                &format!("parameter = \"load\"\nrange = [-2, 2.5]\nstart = 0\nstop = \"{stop}\""),
            ),
            &[],
            1e-9,
        );
        let end = last(&found);
        assert_eq!(found.trace.branches[0].ends[1], BranchEnd::Stop, "{stop}");
        assert_eq!((end.kind.clone(), found.folds(0).len()), (PointKind::Fold, count));
        assert!((end.parameter - load).abs() < 1e-5);
    }
    // The range ends the branch before its second fold is reached: at zero on the way back.
    let found = lee("stop = \"fold 2\"");
    assert_eq!(found.trace.branches[0].ends[1], BranchEnd::Range);
    assert_eq!((last(&found).parameter, found.folds(0).len()), (0.0, 1));
}

#[test]
fn the_most_points_are_kept_to() {
    let found = run(&strip("most_points = 7"), &[], 1e-8);
    assert_eq!(found.trace.status, Status::IterationLimit);
    assert!(found.trace.reason.as_ref().unwrap().contains("most_points"));
    assert_eq!(found.trace.branches[0].points.len(), 7);
    assert_eq!(found.trace.branches[0].ends[1], BranchEnd::PointLimit);
    assert!(last(&found).solution.is_some());
}

/// An event's value may depend on the parameter; at the event both sides agree.
#[test]
fn events_are_met_where_both_sides_agree() {
    let found = traced(
        &strip(
            "event = [\"output.w = -push/100\", \"output.u1 = -0.3\", \"beam.strip[0.25].moment.y = 0 N*m\"]",
        ),
        &[],
        1e-9,
    );
    let of =
        |i: usize| -> Vec<&TracePoint> { found.points().filter(|p| p.kind == PointKind::Event(i)).collect() };
    // The line is passed on the way down from the weight's own bow, and by the bow that the push makes.
    assert_eq!((of(0).len(), of(1).len()), (2, 1));
    for point in of(0) {
        assert!((found.value(point, "w") + point.parameter / 100.0).abs() < 1e-10);
    }
    assert!((found.value(of(1)[0], "u1") + 0.3).abs() < 1e-10);
    for pair in found.trace.branches[0].points.windows(2) {
        assert!(pair[0].arc < pair[1].arc, "in the order of the path");
        assert!(pair[0].parameter < pair[1].parameter);
    }
}

#[test]
fn a_start_inside_the_range_is_followed_both_ways() {
    let inside = traced(&strip("start = 17"), &[], 1e-9);
    let whole = traced(&strip(""), &[], 1e-9);
    let branch = &inside.trace.branches[0];
    assert_eq!(branch.ends, [BranchEnd::Range, BranchEnd::Range]);
    assert_eq!((branch.points[0].parameter, last(&inside).parameter), (0.0, 25.0));
    let ends = |run: &Run| [run.value(&run.trace.branches[0].points[0], "w"), run.value(last(run), "w")];
    for (a, b) in ends(&inside).iter().zip(ends(&whole)) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    assert_eq!(branch.points.iter().filter(|p| p.parameter == 17.0).count(), 1, "the start stands once");
}

/// Every point of a path along any parameter is the solution of the model with that value.
#[test]
fn paths_along_loads_geometry_and_material_are_solutions() {
    let cases = [
        ("push", "[0, 20]"),
        ("weight", "[0.8, 2]"),
        ("slope", "[\"0 deg\", \"60 deg\"]"),
        ("length", "[\"152.4 mm\", \"120 mm\"]"),
        ("height", "[\"0.254 mm\", \"0.3 mm\"]"),
        ("width", "[\"20.32 mm\", \"15 mm\"]"),
        ("young", "[\"207 GPa\", \"150 GPa\"]"),
        ("fall", "[\"9.80665 m/s^2\", \"3 m/s^2\"]"),
    ];
    for (name, range) in cases {
        let text =
            bundled("strip_on_slope.toml", &format!("parameter = \"{name}\"\nrange = {range}\nsteps = 6"));
        // Of a strip that is well bent: a fixed unit, so that geometry and material tell.
        let text = text.replace("unit = \"pi^2*young*width*height^3/(48*length^2)\"", "unit = \"51 mN\"");
        let found = traced(&text, &[("push", "18")], 1e-10);
        let points = &found.trace.branches[0].points;
        let unit = &found.model.parameters[found.study.parameter].unit;
        for point in [&points[points.len() / 2], &points[points.len() - 1]] {
            let value = format!("{:e} {unit}", point.parameter);
            let document = flexura::modelfile::Document::parse(&text, "model.toml").unwrap();
            let mut overrides = vec![(name.to_string(), value.clone())];
            if name != "push" {
                overrides.push(("push".to_string(), "18".to_string()));
            }
            let model = document.model(&overrides).unwrap();
            let options = flexura::Options { tolerance: 1e-11, ..flexura::Options::default() };
            let solution = flexura::solve(&model, &options, &mut |_| {}).unwrap();
            assert_eq!(solution.status, Status::Converged);
            let middle = solution.beams[0]
                .samples
                .iter()
                .find(|s| (s.s / solution.beams[0].length - 0.5).abs() < 1e-9);
            let w = middle.unwrap().pose.position.z / solution.beams[0].length;
            assert!(
                (w - found.value(point, "w")).abs() < 1e-8,
                "{name} = {value}: {w} {}",
                found.value(point, "w")
            );
            assert_eq!(solution.unstable_directions, point.unstable_directions);
        }
    }
}

#[test]
fn where_a_parameter_makes_no_model_the_reason_is_said() {
    for (name, range) in [
        ("length", "[\"200 mm\", \"-50 mm\"]"),
        ("height", "[\"1 mm\", \"-1 mm\"]"),
        ("young", "[\"207 GPa\", \"-7 GPa\"]"),
    ] {
        let text = bundled("euler_clamped_clamped.toml", &format!("parameter = \"{name}\"\nrange = {range}"))
            .replace("effort = \"push*EI/length^2\"", "effort = \"0 N\"");
        let found = run(&text, &[], 1e-8);
        assert_eq!(found.trace.status, Status::Stalled, "{name}");
        let reason = found.trace.reason.as_ref().unwrap();
        assert!(reason.contains("other values make no sound model"), "{name}: {reason}");
        // It comes near the end of what is possible before it gives up.
        let (first, end) = (found.trace.branches[0].points[0].parameter, last(&found).parameter);
        assert!(end > 0.0 && end < 0.1 * first, "{name}: stopped at {end}");
    }
}
