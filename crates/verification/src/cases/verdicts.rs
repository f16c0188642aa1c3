//! Where no stability is claimed: loads that have no energy.

use crate::file::File;
use crate::path::Path;
use crate::{Case, Row};
use flexura_solution::PointKind;

pub const CASES: [Case; 2] = [
    DECIDED,
    Case {
        id: "undecided_stability",
        title: "A follower force on a cantilever (`follower_cantilever.toml`) and a moment of constant direction on a free tip \
            (`roll_up.toml`): no count of unstable directions at any load but none, and the reason said; the same moment \
            on an end that turns about one axis only (`hockling_shaft.toml`) is decided",
        citation: "H. Ziegler, *Principles of Structural Stability* (1968): such loads do work that depends on the way, and \
               what is unstable shows in motion only",
        needed: "never a verdict, always the reason",
        run,
        closed_form: None,
    },
];

const DECIDED: Case = Case {
    id: "stability_by_motion",
    title: "Beck's column with a mass (`beck_column.toml`), at a hundredth below and above PL²/EI = 20.0509536 without damping and 10.9661117 with \
            γ = 0.01: stable and unstable, of an equilibrium and along a path, and by what it is decided",
    citation: "M. Beck, *ZAMP* 3 (1952) 225; V. V. Bolotin and N. I. Zhinzher, *Int. J. Solids Struct.* 5 (1969) 965",
    needed: "verdicts right",
    run: by_motion,
    closed_form: None,
};

fn by_motion() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/beck_column.toml"))?;
    let mut rows = Vec::new();
    for (damping, load) in [(0.0, 20.050953619), (0.01, 10.966111659)] {
        let at = |part: f64| file.solve(&[("damping", damping), ("push", part * load)], 1e-8);
        let (below, above) = (at(0.99)?.solution, at(1.01)?.solution);
        let says = |solution: &flexura_solution::Solution| {
            solution.warnings.iter().any(|warning| warning.contains("decided by the lowest modes"))
        };
        let wrong = [
            below.stable != Some(true),
            above.stable != Some(false),
            above.unstable_directions != Some(1),
            !says(&below),
            !says(&above),
        ];
        let path = Path::of("push", [0.9 * load, 1.1 * load]);
        let followed = file.trace(&[("damping", damping)], &path, 1e-8)?;
        let points = &followed.first()?.points;
        let astray = points.iter().filter(|point| point.stable != Some(point.parameter < load)).count();
        let count = wrong.into_iter().filter(|wrong| *wrong).count() + astray;
        rows.push(Row::vanishing(format!("wrong verdicts, γ = {damping}"), count as f64, 0.0));
    }
    Ok(rows)
}

/// Points with a load and a verdict, and whether the reason is given, with these words, by the trace and by its last state.
fn look(text: &str, parameter: &str, range: [f64; 2], words: &str) -> Result<[f64; 2], String> {
    let followed = File::new(text)?.trace(&[], &Path::of(parameter, range), 1e-8)?;
    let points = &followed.first()?.points;
    let decided = points
        .iter()
        .filter(|point| point.parameter != 0.0 && matches!(point.kind, PointKind::Regular | PointKind::End))
        .filter(|point| point.unstable_directions.is_some() || point.stable.is_some());
    let state = points.last().and_then(|point| point.solution.as_deref());
    let state = state.ok_or("the last state is not kept")?;
    let says = |reason: &Option<String>| reason.as_deref().is_some_and(|reason| reason.contains(words));
    let both = says(&followed.trace.stability_reason)
        && says(&state.stability_reason)
        && state.stable.is_none()
        && state.unstable_directions.is_none();
    Ok([decided.count() as f64, if both { 0.0 } else { 1.0 }])
}

fn run() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (text, parameter, top, words, what) in [
        (
            include_str!("../../../../models/follower_cantilever.toml"),
            "force",
            10.0,
            "load.jet: a force that follows what it acts on",
            "follower force",
        ),
        (
            include_str!("../../../../models/roll_up.toml"),
            "turns",
            0.8,
            "load.tip: a moment that keeps its direction",
            "moment on a free tip",
        ),
    ] {
        let [decided, silent] = look(text, parameter, [0.0, top], words)?;
        rows.push(Row::vanishing(format!("points with a verdict, {what}"), decided, 0.0));
        rows.push(Row::vanishing(format!("is the reason missing, {what}"), silent, 0.0));
    }
    let shaft = File::new(include_str!("../../../../models/hockling_shaft.toml"))?;
    let followed = shaft.trace(&[], &Path::of("torque", [0.0, 0.1]), 1e-8)?;
    let open = followed.first()?.points.iter().filter(|point| point.unstable_directions.is_none()).count();
    rows.push(Row::vanishing("points without a verdict, moment about a fixed axis", open as f64, 0.0));
    let reason = if followed.trace.stability_reason.is_some() { 1.0 } else { 0.0 };
    rows.push(Row::vanishing("reasons against one", reason, 0.0));
    Ok(rows)
}
