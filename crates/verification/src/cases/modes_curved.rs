//! Natural frequencies of rods that are curved at rest, and of rods bent by their loads.

use super::modes::{compared, found, found_near, merged};
use crate::file::File;
use crate::{Case, Row};
use flexura_solution::Modes;
use std::f64::consts::{PI, TAU};

/// The two methods by which loaded rods and mechanisms were worked out.
pub(super) const TWO_METHODS: &str = "collocation of two orders along every rod, and the determinant of an eighth-order Runge-Kutta \
                                      method on some of the modes";

pub const CASES: [Case; 4] = [
    Case {
        id: "modes_of_arcs",
        title: "Modes in and out of the plane: half a ring clamped at both ends, a ring clamped at one section, a free ring",
        citation: "n²(n² - 1)²/(n² + 1) and n²(n² - 1)²/(n² + EI/GJ) (A. E. H. Love, *Mathematical Theory of Elasticity*, 4th ed. \
                   (1927), §293); the others by matrix exponentials and collocation",
        needed: "1e-8",
        run: arcs,
        closed_form: None,
    },
    Case {
        id: "modes_of_springs",
        title: "Modes of a helical spring of 7.6 turns: with two shear stiffnesses, without shear, clamped-free",
        citation: "matrix exponentials of the equations of D. Pearson and W. H. Wittrick, *Int. J. Mech. Sci.* 28 (1986) 83, with 12 \
                   and 24 segments",
        needed: "1e-8",
        run: springs,
        closed_form: None,
    },
    Case {
        id: "modes_about_loads",
        title: "Modes of a cantilever bent by a tip force PL²/EI = 2, of the same with the load as the weight of a body, of a heavy strip \
                at wL³/EI = 5",
        citation: TWO_METHODS,
        needed: "1e-8",
        run: loaded,
        closed_form: None,
    },
    Case {
        id: "modes_of_buckled_strips",
        title: "Modes of a clamped-clamped strip, buckled by shortening its distance of ends by 0.01, 0.1 and 0.3 L",
        citation: TWO_METHODS,
        needed: "1e-8",
        run: buckled,
        closed_form: None,
    },
];

const RING: &str =
    "[section.ring]\nshape = \"stiffness\"\nGJ = \"1/1.3\"\nEI2 = 1\nEI3 = 1\nmass_per_length = 1\n";

fn arcs() -> Result<Vec<Row>, String> {
    let arc = |angle: &str, ends: &str| {
        format!(
            "{RING}[beam.arc]\nsection = \"ring\"\nextension = false\ncurve = {{ kind = \"arc\", radius = 1, angle = \"{angle}\" }}\n{ends}"
        )
    };
    let ground =
        "start = { body = \"ground\", hold = \"clamp\" }\nend = { body = \"ground\", hold = \"clamp\" }\n";
    let base = "start = { body = \"base\", hold = \"clamp\" }\nend = { body = \"base\", hold = \"clamp\" }\n[body.base]\n";
    let half = merged(
        &[4.3844299972, 9.6518967496, 17.921789894, 27.523889904],
        &[1.8193439766, 5.2508599037, 11.024570973, 18.908771248],
    );
    let ring = merged(
        &[0.56642128697, 1.5952032722, 3.3845855385, 5.7549247217],
        &[0.40595000914, 0.9325578672, 2.0972385021, 3.9023709217],
    );
    let mut rows = compared("half ring", &found(&arc("180 deg", ground), half.len())?, &half, 1.0);
    rows.extend(compared(
        "ring held at one section",
        &found(&arc("360 deg", ground), ring.len())?,
        &ring,
        1.0,
    ));
    let free = |n: f64, by: f64| (n * n * (n * n - 1.0).powi(2) / (n * n + by)).sqrt();
    let mut wanted: Vec<f64> = [2.0, 3.0, 4.0].iter().flat_map(|n| [free(*n, 1.0); 2]).collect();
    wanted.extend([2.0, 3.0, 4.0].iter().flat_map(|n| [free(*n, 1.3); 2]));
    wanted.sort_by(f64::total_cmp);
    let modes = found(&arc("360 deg", base), 12)?;
    rows.extend(compared("free ring", &modes, &wanted, 1.0));
    let rigid = modes.modes.iter().filter(|mode| mode.is_rigid()).count();
    rows.push(Row::absolute("motions without stiffness, free ring", 6.0, rigid as f64, 0.0));
    Ok(rows)
}

/// A round wire's section by its stiffnesses, with `shear` times G A.
pub(super) fn round(diameter: f64, [young, modulus]: [f64; 2], density: f64, shear: f64) -> String {
    let area = PI * diameter.powi(2) / 4.0;
    let second = PI * diameter.powi(4) / 64.0;
    let (ga, ei, gj) = (shear * modulus * area, young * second, 2.0 * modulus * second);
    let rotary = density * second;
    format!(
        "shape = \"stiffness\"\nEA = {:?}\nGA2 = {ga:?}\nGA3 = {ga:?}\nGJ = {gj:?}\nEI2 = {ei:?}\nEI3 = {ei:?}\nmass_per_length = {:?}\n\
         rotary_inertia = [{:?}, {rotary:?}, {rotary:?}]\n",
        young * area,
        density * area,
        2.0 * rotary
    )
}

fn springs() -> Result<Vec<Row>, String> {
    let young = 206e9;
    let pitch = TAU * 5e-3 * 8.5744_f64.to_radians().tan();
    let spring = |shear: f64, theory: &str, end: &str| {
        format!(
            "[section.wire]\n{}[beam.spring]\nsection = \"wire\"\ncurve = {{ kind = \"helix\", radius = 5e-3, pitch = {pitch:?}, turns = 7.6 }}\n\
             {theory}\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n{end}\n",
            round(1e-3, [young, young / 2.6], 7900.0, shear)
        )
    };
    let both = "end = { body = \"ground\", hold = \"clamp\" }";
    let cases: [(&str, f64, &str, &str, &[f64]); 4] = [
        (
            "GA 0.9",
            0.9,
            "shear = true",
            both,
            &[393.40559384, 395.98510859, 462.73687983, 525.5681882, 863.58508476, 876.75934031],
        ),
        (
            "GA/1.1",
            1.0 / 1.1,
            "shear = true",
            both,
            &[393.40945673, 395.98890828, 462.74896994, 525.5687025, 863.59707906, 876.77146631],
        ),
        (
            "no shear",
            0.9,
            "extension = false",
            both,
            &[393.90868255, 396.49287573, 463.96435182, 525.62278086, 865.07834992, 878.35881843],
        ),
        ("clamped-free", 0.9, "shear = true", "", &[73.553371636, 73.886552471, 230.69515857, 263.3259926]),
    ];
    let mut rows = Vec::new();
    for (name, shear, theory, end, wanted) in cases {
        rows.extend(compared(name, &found(&spring(shear, theory, end), wanted.len())?, wanted, TAU));
    }
    Ok(rows)
}

/// A strip with EI3 = ρA = L = 1 whose torsion alone has inertia.
fn strip(sideways: f64) -> String {
    format!(
        "[section.strip]\nshape = \"stiffness\"\nGJ = 0.8\nEI2 = {sideways}\nEI3 = 1\nmass_per_length = 1\nrotary_inertia = [1e-3, 0, 0]\n\
         [beam.strip]\nsection = \"strip\"\nlength = 1\nextension = false\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n"
    )
}

fn tip(name: &str, modes: &Modes, wanted: [f64; 2]) -> Vec<Row> {
    let last = modes.solution.beams[0].samples.last();
    let ours = last.map_or([f64::NAN; 2], |sample| [sample.pose.position.x, sample.pose.position.y]);
    let row = |i: usize| Row::absolute(format!("tip {}, {name}", ["x", "y"][i]), wanted[i], ours[i], 1e-8);
    vec![row(0), row(1)]
}

fn loaded() -> Result<Vec<Row>, String> {
    let strip = strip(2.0);
    let force = |target: &str| format!("[load.tip]\n{target}\nforce = [0, -2, 0]\n");
    let body = "end = { body = \"tip\", hold = \"clamp\" }\n[body.tip]\nat = [1, 0, 0]\nmass = 1\ninertia = [0.02, 0.01, 0.015]\n";
    let bent = [0.83935827917, -0.4934574804];
    let cases = [
        (
            "tip force",
            format!("{strip}{}", force("beam = \"strip\"\nat = 1.0")),
            [4.2724864701, 5.3400015225, 21.399512038, 30.223016415, 48.360351736, 58.791477541],
            bent,
        ),
        (
            "weight of a body",
            format!("{strip}{body}{}", force("body = \"tip\"")),
            [1.8988467329, 2.3676188567, 6.4420870371, 11.401370557, 18.746975408, 25.688325291],
            bent,
        ),
        (
            "own weight",
            format!("gravity = [0, -5, 0]\n{strip}"),
            [4.1158308972, 5.2789053905, 21.620359423, 30.572769066, 46.601048643, 58.301863621],
            [0.84665717995, -0.49590504462],
        ),
    ];
    let mut rows = Vec::new();
    for (name, text, wanted, at) in &cases {
        let modes = found(text, 6)?;
        rows.extend(compared(name, &modes, wanted, 1.0));
        rows.extend(tip(name, &modes, *at));
    }
    Ok(rows)
}

fn buckled() -> Result<Vec<Row>, String> {
    let strip =
        format!("{}end = {{ body = \"head\", hold = \"clamp\" }}\n[body.head]\nat = [1, 0, 0]\n", strip(3.0));
    let way = "[joint.way]\nkind = \"prismatic\"\nparent = { body = \"ground\", at = [1, 0, 0] }\nchild = \"head\"\naxis = [-1, 0, 0]\n";
    let mut rows = Vec::new();
    for (shortening, push, rise, wanted) in [
        (
            0.01,
            39.676926538,
            0.063462721765,
            [30.022899186, 44.326772063, 74.510434648, 95.428339582, 96.941746609],
        ),
        (
            0.1,
            41.570255793,
            0.19492431138,
            [23.361951532, 43.887343084, 75.755677798, 88.786890927, 132.16162555],
        ),
        (
            0.3,
            46.61212088,
            0.31431261295,
            [19.822121357, 41.831322229, 72.157002737, 78.916525824, 117.45936142],
        ),
    ] {
        // Found with a push aside, then held by its ends alone.
        let aside = "[load.aside]\nbeam = \"strip\"\nat = 0.5\nforce = [0, 0.5, 0]\n";
        let pushed = format!("format = 1\nname = \"strip\"\n{strip}{way}effort = {push:?}\n{aside}");
        let near = File::new(&pushed)?.solve(&[], 1e-8)?;
        let held = format!("{strip}{way}coordinate = {shortening:?}\n{}", aside.replace("0.5, 0]", "0, 0]"));
        let modes = found_near(&held, 5, near.solution)?;
        let name = format!("shortened by {shortening}");
        rows.extend(compared(&name, &modes, &wanted, 1.0));
        let middle = modes.solution.beams[0].samples.iter().find(|sample| (sample.s - 0.5).abs() < 1e-9);
        let ours = middle.map_or(f64::NAN, |sample| sample.pose.position.y);
        rows.push(Row::absolute(format!("rise, {name}"), rise, ours, 1e-8));
        rows.push(Row::relative(format!("push, {name}"), push, modes.solution.joints[0].efforts[0], 1e-8));
    }
    Ok(rows)
}
