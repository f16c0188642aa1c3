//! Arches and beams that snap through under a given load: folds, and branch points before them.

use crate::file::File;
use crate::path::{Followed, Path, counted, crossings, events, folds};
use crate::{Case, Row};
use flexura_solution::{Branch, BranchEnd, Crossing, PointKind, TracePoint};
use flexura_testkit::arches::{Arch, Crown};
use flexura_testkit::snaps::Bistable;
use std::f64::consts::PI;

const METHOD: &str = "Taylor series along both halves, the crown's height leading (`testkit/src/arches.rs`); the phenomenon: Y. C. \
                      Fung and A. Kaplan, NACA TN 2840 (1952)";

pub const CASES: [Case; 3] = [
    Case {
        id: "shallow_arch",
        title: "Shallow hinged arch of 30° under a load at its crown, 3 mm thick, R = 100 mm (`shallow_arch.toml`): both folds \
                of its snap-through, 23.3549 and -0.2256 EI/R²; unstable in one direction between them",
        citation: METHOD,
        needed: "1e-8 of EI/R² and R",
        run: thick,
        closed_form: None,
    },
    Case {
        id: "shallow_arch_sway",
        title: "The same arch, 2 mm thick: it sways to a side at 35.8026 EI/R², before the fold at 36.5065, and stands \
                upright again past the other fold, at -15.2660; the swaying branch joins the two and comes back as its \
                mirror image; all counts of unstable directions",
        citation: METHOD,
        needed: "1e-8 of EI/R² and R",
        run: thin,
        closed_form: None,
    },
    Case {
        id: "bistable_folds",
        title: "`bistable_beam.toml`: greatest and least force of the S-shaped beam, as folds under a given force; where no force \
                is needed when the shuttle is led, unstable and stable; the stable bowed shapes between two pitchforks",
        citation: "Taylor series along the beam (`testkit/src/snaps.rs`)",
        needed: "1e-8 of EI/L² and L",
        run: bistable,
        closed_form: None,
    },
];

const ARCH: &str = include_str!("../../../../models/shallow_arch.toml");
const HALF: f64 = PI / 12.0;

/// Everything that happens until the crown is down by 2.2 times its height, in units of EI and R.
fn reference(thickness: f64) -> Result<flexura_testkit::arches::Snap, String> {
    let arch = Arch {
        radius: 1.0,
        half_angle: HALF,
        bending: 1.0,
        stretch: (thickness / 0.1).powi(2) / 12.0,
        hinged: [true; 2],
    };
    arch.snap(1.9 * (1.0 - HALF.cos())).map_err(|error| format!("{error:?}"))
}

fn compare(
    what: &str,
    wanted: &[Crown],
    followed: &Followed,
    points: &[&TracePoint],
) -> Result<Vec<Row>, String> {
    if wanted.len() != points.len() {
        return Err(format!("{} times {what} instead of {}", points.len(), wanted.len()));
    }
    let mut rows = Vec::new();
    for (crown, point) in wanted.iter().zip(points) {
        rows.push(Row::absolute(format!("{what}: load, EI/R²"), crown.load, point.parameter, 1e-8));
        rows.push(Row::absolute("drop, R", crown.drop, followed.number(point, "drop"), 1e-8));
        rows.push(Row::vanishing("sway, R", followed.number(point, "sway"), 1e-8));
    }
    Ok(rows)
}

fn thick() -> Result<Vec<Row>, String> {
    let path = Path { start: Some(0.0), ..Path::of("load", [-5.0, 40.0]) };
    let followed = File::new(ARCH)?.trace(&[], &path, 1e-10)?;
    let branch = followed.first()?;
    let mut rows = compare("fold", &reference(3e-3)?.folds, &followed, &folds(branch))?;
    rows.push(Row::vanishing("branch points", crossings(branch).len() as f64, 0.0));
    rows.push(counted(branch, &[0, 1, 0]));
    Ok(rows)
}

fn thin() -> Result<Vec<Row>, String> {
    let file = File::new(ARCH)?;
    let wanted = reference(2e-3)?;
    let half = [("drop", 0.04)];
    let path = Path { start: Some(0.0), branches: 1, events: &half, ..Path::of("load", [-30.0, 60.0]) };
    let followed = file.trace(&[("thickness", 2e-3)], &path, 1e-10)?;
    let branch = followed.first()?;
    let mut rows = compare("fold", &wanted.folds, &followed, &folds(branch))?;
    rows.extend(compare("branch point", &wanted.branch_points, &followed, &crossings(branch))?);
    rows.push(pitchforks(&crossings(branch), Crossing::SubcriticalPitchfork));
    rows.push(counted(branch, &[0, 1, 2, 1, 0]));
    let swaying = closed(&followed)?;
    rows.push(counted(swaying, &[1]));
    let both: Vec<Crown> = [0, 1, 0].iter().filter_map(|i| wanted.branch_points.get(*i).copied()).collect();
    rows.extend(compare("the swaying branch crosses", &both, &followed, &crossings(swaying))?);
    rows.extend(mirrored(&followed, swaying, &["sway", "turning"])?);
    Ok(rows)
}

/// How many branch points are of another kind.
fn pitchforks(points: &[&TracePoint], kind: Crossing) -> Row {
    let others = points.iter().filter(|point| point.kind != PointKind::Branch(kind));
    Row::vanishing("branch points of other kinds", others.count() as f64, 0.0)
}

/// The one branch that crosses the first and comes back to itself.
fn closed(followed: &Followed) -> Result<&Branch, String> {
    match followed.switched()[..] {
        [branch] if branch.ends == [BranchEnd::Closed, BranchEnd::Closed] => Ok(branch),
        ref branches => Err(format!("not one closed branch but {}", branches.len())),
    }
}

/// On a branch that is its own mirror image the event happens twice, with opposite values of what the mirror turns.
fn mirrored(followed: &Followed, branch: &Branch, names: &[&str]) -> Result<Vec<Row>, String> {
    let [a, b] = events(branch, 0)[..] else { return Err("the event does not happen twice".to_string()) };
    let row = |name: &&str| {
        let [a, b] = [a, b].map(|point| followed.number(point, name));
        Row::absolute(format!("{name} and its mirror image"), a, -b, 1e-8)
    };
    let mut rows: Vec<Row> = names.iter().map(row).collect();
    rows.push(Row::relative("parameter at both", a.parameter, b.parameter, 1e-8));
    Ok(rows)
}

fn bistable() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/bistable_beam.toml");
    let (length, slope) = (50e-3, 5f64.to_radians());
    let beam = Bistable::polypropylene();
    let unit = beam.bending / (length * length);
    let wanted = beam.snap(7.2e-3).map_err(|error| format!("{error:?}"))?;
    let mut rows = Vec::new();
    // Where no force is needed, the shuttle being led.
    let file = File::new(text)?;
    let path = Path { branches: 1, events: &[("force", 0.0)], ..Path::of("travel", [0.0, 7.2e-3]) };
    let led = file.trace(&[], &path, 1e-10)?;
    // Rest is one, too.
    let zeros: Vec<_> =
        events(led.first()?, 0).into_iter().filter(|point| point.parameter > 1e-6 * length).collect();
    if zeros.len() != wanted.zeros.len() {
        return Err(format!("{} places without force", zeros.len()));
    }
    for (zero, point) in wanted.zeros.iter().zip(zeros) {
        rows.push(Row::scaled("travel without force", zero.travel, point.parameter, length, 1e-8));
    }
    rows.push(pitchforks(&crossings(led.first()?), Crossing::SupercriticalPitchfork));
    rows.push(counted(led.first()?, &[0, 1, 0]));
    // Between the two the beam bows; halfway it is a mirror image of itself and needs no force.
    let bowed = closed(&led)?;
    rows.push(counted(bowed, &[0]));
    for point in events(bowed, 0) {
        let halfway = length * slope.sin();
        rows.push(Row::scaled(
            "travel of the bowed beam without force",
            halfway,
            point.parameter,
            length,
            1e-8,
        ));
    }
    rows.extend(mirrored(&led, bowed, &["guide_moment"])?);
    // The same beam under a given force.
    let given = text
        .replace("coordinate = \"travel\"", "effort = \"force\"")
        .replace("travel = \"2 mm\"", "force = \"0 N\"")
        .replace("force = \"joint.guide.effort\"", "travel = \"joint.guide.coordinate\"");
    let path = Path { start: Some(0.0), branches: 1, ..Path::of("force", [-0.3, 0.6]) };
    let followed = File::new(&given)?.trace(&[], &path, 1e-10)?;
    let branch = followed.first()?;
    let found = folds(branch);
    if found.len() != wanted.folds.len() {
        return Err(format!("{} folds", found.len()));
    }
    for (fold, point) in wanted.folds.iter().zip(found) {
        rows.push(Row::scaled("fold: force", fold.force, point.parameter, unit, 1e-8));
        rows.push(Row::scaled("travel", fold.travel, followed.number(point, "travel"), length, 1e-8));
    }
    rows.push(pitchforks(&crossings(branch), Crossing::SubcriticalPitchfork));
    rows.push(counted(branch, &[0, 1, 2, 1, 0]));
    rows.push(counted(closed(&followed)?, &[1]));
    // Led or given, it is the same equilibrium.
    for (led, given) in crossings(led.first()?).iter().zip(crossings(branch)) {
        let travel = followed.number(given, "travel");
        rows.push(Row::scaled("branch point: travel, given the force", led.parameter, travel, length, 1e-8));
    }
    Ok(rows)
}
