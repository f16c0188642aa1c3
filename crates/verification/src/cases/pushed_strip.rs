//! The strip between a clamp and a slider, pushed together, with a weight at its middle: how it bows, and from which push on
//! it bows against the weight (Table 5.2).

use crate::file::File;
use crate::path::{Followed, Path, counted, crossings, events, folds};
use crate::{Case, Row};
use flexura_solution::{Branch, BranchOrigin, Crossing, PointKind, TracePoint};
use flexura_testkit::slope::Slope;
use flexura_testkit::strip::{Level, Shape, weightless};
use std::f64::consts::FRAC_PI_2;

const METHOD: &str = "elliptic integrals on level ground, Taylor series along both halves elsewhere \
                      (`testkit/src/strip.rs`, `slope.rs`)";

pub const CASES: [Case; 4] = [
    Case {
        id: "pushed_strip",
        title: "Weightless clamped-sliding strip past its buckling at 16 π²EI/4L² (`strip_on_slope.toml`, `weight=0`), n = 17, \
                20, 25: deflection of the middle and slide, on both sides",
        citation: "K(k) = π√n/8, w = 8k/(π√n), u1 = 2E/K - 2 (A. E. H. Love, *A Treatise on the Mathematical Theory of \
                   Elasticity*, 4th ed. (1927), §263)",
        needed: "1e-8 L, 1e-8 of the buckling load",
        run: without_weight,
        closed_form: None,
    },
    Case {
        id: "sensor_strip",
        title: "Table 5.2: a sensor of weight 0.8 or 1.6 π²EI/4L² on the strip, on slopes of 0, 45° and 90° \
                (`strip_on_slope.toml`): push from which it bows against the weight, deflection and slide there. A fold of \
                the branch that hangs together with no other, reached by leading the slope from 100° to its own, and once by search; the \
                pitchfork at 90°",
        citation: METHOD,
        needed: "1e-7",
        run: sensor,
        closed_form: None,
    },
    Case {
        id: "sensor_strip_printed",
        title: "The same with a strip that itself weighs 0.1 π²EI/4L²: n = 17.5, 16.9, 15.5 for the weight 0.8 and 18.3, 17.3, \
                15.1 for 1.6, on 0, 45° and 90°",
        citation: "the thesis, Table 5.2 (a weightless strip would have 15.6 and 15.2 at 90°); and Taylor series",
        needed: "half of the last digit printed; 1e-7 against Taylor series",
        run: printed,
        closed_form: None,
    },
    Case {
        id: "sensor_strip_variants",
        title: "The same strip with weight along it only (`beam_weight=0.8`), with weights along the axis that help or \
                hinder the push (90°), and one that stretches, 5.08 mm thick",
        citation: METHOD,
        needed: "1e-7",
        run: variants,
        closed_form: None,
    },
];

pub(super) const FILE: &str = include_str!("../../../../models/strip_on_slope.toml");
/// Length of the file's strip, m.
const LENGTH: f64 = 0.1524;

fn without_weight() -> Result<Vec<Row>, String> {
    let pushes = [("n", 17.0), ("n", 20.0), ("n", 25.0)];
    let path = Path { branches: 1, steps: 20, events: &pushes, ..Path::of("push", [14.0, 26.0]) };
    let followed = File::new(FILE)?.trace(&[("weight", 0.0)], &path, 1e-10)?;
    let branches = followed.switched();
    let [branch] = branches[..] else { return Err(format!("{} branches", branches.len())) };
    let mut rows = vec![
        Row::relative("buckling load", 16.0, pitchfork(followed.first()?)?, 1e-8),
        counted(followed.first()?, &[0, 1]),
        counted(branch, &[0]),
    ];
    for (number, (_, push)) in pushes.iter().enumerate() {
        let exact = weightless(*push).ok_or("it has not buckled")?;
        let [left, right] = events(branch, number)[..] else {
            return Err(format!("the push {push} is not met once on both sides"));
        };
        for (point, middle) in [(left, exact.middle), (right, -exact.middle)] {
            let (w, side) = (followed.number(point, "w"), followed.number(left, "w").signum());
            rows.push(Row::absolute(format!("w at {push}"), middle * side, w, 1e-8));
            rows.push(Row::absolute("slide", exact.slide, followed.number(point, "u1"), 1e-8));
        }
    }
    Ok(rows)
}

/// The push at the one branch point, which is a pitchfork.
fn pitchfork(branch: &Branch) -> Result<f64, String> {
    match crossings(branch)[..] {
        [point] if point.kind == PointKind::Branch(Crossing::SupercriticalPitchfork) => Ok(point.parameter),
        ref found => {
            Err(format!("no single pitchfork but {:?}", found.iter().map(|p| &p.kind).collect::<Vec<_>>()))
        }
    }
}

/// From rest to the push `top`, and on the branch bent against gravity, with the slope led to its own from 100°, where it
/// bows that way by itself.
pub(super) fn against_gravity<'a>(
    file: &File,
    values: &[(&str, f64)],
    top: f64,
    more: impl FnOnce(Path<'a>) -> Path<'a>,
) -> Result<Followed, String> {
    let path = Path {
        imperfection: Some(("slope", 100f64.to_radians())),
        steps: 20,
        ..Path::of("push", [10.0, top])
    };
    file.trace(values, &more(path), 1e-10)
}

/// The fold of the branch that hangs together with no other; stable before it, unstable in one direction past it.
fn lone_fold(followed: &Followed) -> Result<Shape, String> {
    let branch = followed.branch(|origin| origin == BranchOrigin::Imperfection)?;
    let found = folds(branch);
    let [fold] = found[..] else { return Err(format!("{} folds", found.len())) };
    let directions = |end: Option<&TracePoint>| end.and_then(|point| point.unstable_directions);
    let ends = [directions(branch.points.first()), directions(branch.points.last())];
    if ends != [Some(0), Some(1)] {
        return Err(format!("unstable directions at the ends of the branch: {ends:?}"));
    }
    let [middle, slide] = ["w", "u1"].map(|name| followed.number(fold, name));
    Ok(Shape { push: fold.parameter, middle, slide })
}

/// The same fold, on level ground, of a branch found by random pushes and deflation.
fn searched(file: &File) -> Result<Shape, String> {
    let path = Path { guesses: 3, steps: 20, ..Path::of("push", [10.0, 22.0]) };
    let followed = file.trace(&[("weight", 0.8)], &path, 1e-10)?;
    let others = followed.trace.branches.iter().filter(|branch| branch.origin == BranchOrigin::Search);
    let found: Vec<_> = others.flat_map(folds).collect();
    let [fold] = found[..] else { return Err(format!("{} folds of branches found by search", found.len())) };
    let [middle, slide] = ["w", "u1"].map(|name| followed.number(fold, name));
    Ok(Shape { push: fold.parameter, middle, slide })
}

fn compare(what: &str, exact: Shape, ours: Shape) -> [Row; 3] {
    [
        Row::absolute(format!("n {what}"), exact.push, ours.push, 1e-7),
        Row::absolute(format!("w {what}"), exact.middle, ours.middle, 1e-7),
        Row::absolute(format!("slide {what}"), exact.slide, ours.slide, 1e-7),
    ]
}

/// The critical push of a strip, from its fold or, on a wall, its pitchfork; against the second method.
fn critical(
    file: &File,
    strip: &Slope,
    more: &[(&str, f64)],
    what: &str,
    rows: &mut Vec<Row>,
) -> Result<f64, String> {
    let mut values =
        vec![("weight", strip.weight), ("beam_weight", strip.beam_weight), ("slope", strip.angle)];
    values.extend_from_slice(more);
    if strip.angle < FRAC_PI_2 {
        let ours = lone_fold(&against_gravity(file, &values, 19.0, |path| path)?)?;
        let exact = strip.fold().map_err(|error| format!("{error:?}"))?;
        rows.extend(compare(what, exact, ours));
        return Ok(ours.push);
    }
    let followed = file.trace(&values, &Path { steps: 20, ..Path::of("push", [10.0, 18.0]) }, 1e-10)?;
    let ours = pitchfork(followed.first()?)?;
    let exact = strip.pitchfork().map_err(|error| format!("{error:?}"))?;
    rows.push(Row::absolute(format!("n {what}"), exact, ours, 1e-7));
    Ok(ours)
}

fn sensor() -> Result<Vec<Row>, String> {
    let file = File::new(FILE)?;
    let mut rows = Vec::new();
    for weight in [0.8, 1.6] {
        for slope in [0.0, 45.0, 90.0_f64] {
            let what = format!("for {weight} at {slope}°");
            let strip = Slope::new(weight, slope.to_radians());
            let push = critical(&file, &strip, &[], &what, &mut rows)?;
            if slope == 0.0 {
                let exact = Level { weight }.fold().ok_or("no fold")?;
                rows.push(Row::absolute(format!("n {what}, elliptic"), exact.push, push, 1e-7));
                if weight == 0.8 {
                    rows.extend(compare("of the branch that is searched for", exact, searched(&file)?));
                }
            }
        }
    }
    Ok(rows)
}

fn printed() -> Result<Vec<Row>, String> {
    let file = File::new(FILE)?;
    let mut rows = Vec::new();
    for (weight, table) in [(0.8, [17.5, 16.9, 15.5]), (1.6, [18.3, 17.3, 15.1])] {
        for (slope, digits) in [0.0, 45.0, 90.0_f64].into_iter().zip(table) {
            let what = format!("for {weight} at {slope}°");
            let strip = Slope { beam_weight: 0.1, ..Slope::new(weight, slope.to_radians()) };
            let push = critical(&file, &strip, &[], &what, &mut rows)?;
            rows.push(Row::absolute(format!("n {what}, as printed"), digits, push, 0.05));
        }
    }
    Ok(rows)
}

fn variants() -> Result<Vec<Row>, String> {
    let file = File::new(FILE)?;
    let mut rows = Vec::new();
    for slope in [0.0, 45.0, 90.0_f64] {
        let strip = Slope { beam_weight: 0.8, ..Slope::new(0.0, slope.to_radians()) };
        critical(&file, &strip, &[], &format!("of a heavy strip at {slope}°"), &mut rows)?;
    }
    let wall = Slope { beam_weight: 0.5, ..Slope::new(0.8, FRAC_PI_2) };
    critical(&file, &wall, &[], "with both weights along the axis", &mut rows)?;
    // Turned over, the same weights pull against the push.
    let exact = Slope { weight: -0.8, beam_weight: -0.5, ..wall }
        .pitchfork()
        .map_err(|error| format!("{error:?}"))?;
    let values = [("weight", 0.8), ("beam_weight", 0.5), ("slope", -FRAC_PI_2)];
    let followed = file.trace(&values, &Path { steps: 20, ..Path::of("push", [10.0, 18.0]) }, 1e-10)?;
    rows.push(Row::absolute("n with both against the push", exact, pitchfork(followed.first()?)?, 1e-7));
    let thickness = 5.08e-3;
    let stretching = File::new(&FILE.replace("extension = false", "extension = true"))?;
    for slope in [0.0, 45.0, 90.0_f64] {
        let stretch = (thickness / LENGTH).powi(2) / 12.0;
        let strip = Slope { stretch, ..Slope::new(0.8, slope.to_radians()) };
        critical(
            &stretching,
            &strip,
            &[("height", thickness)],
            &format!("stretching at {slope}°"),
            &mut rows,
        )?;
    }
    Ok(rows)
}
