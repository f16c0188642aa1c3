//! Spectra where loads have no energy.

use super::modes::{compared, found};
use crate::{Case, Row};
use flexura_solution::ModeKind;

pub const CASES: [Case; 2] = [
    Case {
        id: "modes_without_energy",
        title: "Beck's column at PL²/EI = 10, below its flutter load; a round cantilever under a tangential torque TL/EI = 1, which flutters \
            under any",
        citation: "power series in 25 digits (M. Beck, *ZAMP* 3 (1952) 225)",
        needed: "1e-8",
        run: spectra,
        closed_form: None,
    },
    Case {
        id: "flutter_loads",
        title: "Loads at which two modes meet and flutter begins: Beck's column, Leipholz's and Hauger's under loads along the axis, a \
                cantilever with EI2 = 2 EI3 under a tangential torque, Ziegler's double pendulum of rigid bodies",
        citation: "double roots of power series in 25 digits, and 7/2 - √2 (H. Ziegler, *Ing.-Arch.* 20 (1952) 49; M. Beck, *ZAMP* 3 \
                   (1952) 225; H. Leipholz, *ZAMP* 13 (1962) 581)",
        needed: "1e-8",
        run: loads,
        closed_form: None,
    },
];

/// A title, the file by its load, a range around the critical load, and the load and rate that are wanted.
type Loaded<'a> = (&'a str, &'a dyn Fn(f64) -> String, [f64; 2], [f64; 2]);

fn cantilever(section: &str, load: &str) -> String {
    format!(
        "[section.rod]\nshape = \"stiffness\"\n{section}\nmass_per_length = 1\n[beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\n\
         start = {{ body = \"ground\", hold = \"clamp\" }}\n[load.tip]\nbeam = \"rod\"\nat = 1.0\n{load}\n"
    )
}

fn spectra() -> Result<Vec<Row>, String> {
    let planar = "GJ = 1e4\nEI2 = 1e4\nEI3 = 1";
    let push = "force = [-10, 0, 0]\nframe = \"local\"";
    let modes = found(&cantilever(planar, push), 3)?;
    let mut rows = compared("Beck's column", &modes, &[5.1757622613, 18.586794893, 57.853034497], 1.0);
    let growing = modes.unstable();
    rows.push(Row::absolute("modes that grow, Beck's column", 0.0, growing as f64, 0.0));
    let torque = "moment = [1, 0, 0]\nframe = \"local\"";
    let modes = found(&cantilever("GJ = 0.8\nEI2 = 1\nEI3 = 1", torque), 2)?;
    for (mode, sign, kind) in modes
        .modes
        .iter()
        .zip([1.0, -1.0])
        .zip([ModeKind::Flutter, ModeKind::Decaying])
        .map(|((m, s), k)| (m, s, k))
    {
        rows.push(Row::relative(format!("ω, {}", kind.word()), 3.5131118669, mode.rate, 1e-8));
        rows.push(Row::relative(format!("growth, {}", kind.word()), sign * 0.54122022255, mode.growth, 1e-8));
        rows.push(Row::absolute(
            format!("is {}", kind.word()),
            1.0,
            f64::from(u8::from(mode.kind == kind)),
            0.0,
        ));
    }
    Ok(rows)
}

/// (ω1² - ω2²)² and the mean of both, of the two lowest modes: smooth in the load where they meet, and negative beyond.
fn meeting(text: &str) -> Result<[f64; 2], String> {
    let modes = found(text, 2)?;
    let [a, b] =
        [0, 1].map(|i| modes.modes.get(i).map(|mode| (mode.square(), 2.0 * mode.growth * mode.rate)));
    let (Some((a, aside)), Some((b, _))) = (a, b) else { return Err("fewer than two modes".to_string()) };
    Ok([(a - b).powi(2) - 4.0 * aside * aside, 0.5 * (a + b)])
}

/// The load between two at which the two lowest modes meet, and their frequency there: halved to a small interval, then by the
/// polynomial through seven loads in it.
fn meets(text: &dyn Fn(f64) -> String, [mut low, mut high]: [f64; 2]) -> Result<[f64; 2], String> {
    const POINTS: usize = 7;
    while high - low > 0.02 * high {
        let middle = 0.5 * (low + high);
        if meeting(&text(middle))?[0] > 0.0 { low = middle } else { high = middle }
    }
    let (center, half) = (0.5 * (low + high), 0.5 * (high - low));
    let at: Vec<f64> = (0..POINTS)
        .map(|i| center + half * (std::f64::consts::PI * (i as f64 + 0.5) / POINTS as f64).cos())
        .collect();
    let values = at.iter().map(|load| meeting(&text(*load))).collect::<Result<Vec<_>, _>>()?;
    let through = |which: usize, load: f64| -> f64 {
        let part = |i: usize| {
            let others = (0..POINTS).filter(|j| *j != i);
            values[i][which] * others.map(|j| (load - at[j]) / (at[i] - at[j])).product::<f64>()
        };
        (0..POINTS).map(part).sum()
    };
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if through(0, middle) > 0.0 { low = middle } else { high = middle }
    }
    Ok([low, through(1, low).max(0.0).sqrt()])
}

fn loads() -> Result<Vec<Row>, String> {
    let planar = "GJ = 1e4\nEI2 = 1e4\nEI3 = 1";
    let along = |force: String| {
        let rod = cantilever(planar, "");
        let rod = rod.replace("[load.tip]\nbeam = \"rod\"\nat = 1.0\n", "");
        format!("{rod}distributed = {{ force = [{force}, 0, 0], frame = \"section\" }}\n")
    };
    let tip = |p: f64| cantilever(planar, &format!("force = [{:?}, 0, 0]\nframe = \"local\"", -p));
    let uniform = |q: f64| along(format!("{:?}", -q));
    let linear = |q: f64| along(format!("\"{:?}*(1 - s)\"", -q));
    let torque = |t: f64| {
        cantilever("GJ = 0.8\nEI2 = 2\nEI3 = 1", &format!("moment = [{t:?}, 0, 0]\nframe = \"local\""))
    };
    let pendulum = |p: f64| {
        format!(
            "[body.first]\nmass = 2\ncenter_of_mass = [1, 0, 0]\n[body.second]\nat = [1, 0, 0]\nmass = 1\ncenter_of_mass = [1, 0, 0]\n\
             [joint.foot]\nkind = \"revolute\"\nparent = \"ground\"\nchild = \"first\"\naxis = [0, 0, 1]\nstiffness = 1\n\
             [joint.knee]\nkind = \"revolute\"\nparent = {{ body = \"first\", at = [1, 0, 0] }}\nchild = \"second\"\naxis = [0, 0, 1]\nstiffness = 1\n\
             [load.tip]\nbody = \"second\"\nat = [1, 0, 0]\nforce = [{:?}, 0, 0]\nframe = \"local\"\n",
            -p
        )
    };
    let cases: [Loaded<'_>; 5] = [
        ("Beck", &tip, [10.0, 25.0], [20.050953619, 11.015557641]),
        ("Leipholz", &uniform, [20.0, 50.0], [40.053736515, 11.030216995]),
        ("Hauger", &linear, [80.0, 180.0], [150.6415954, 11.485713611]),
        ("tangential torque", &torque, [0.8, 2.2], [1.6381405433, 4.1943608366]),
        ("Ziegler", &pendulum, [1.0, 2.5], [3.5 - 2.0_f64.sqrt(), f64::NAN]),
    ];
    let mut rows = Vec::new();
    for (name, text, range, [load, rate]) in cases {
        let found = meets(text, range)?;
        rows.push(Row::relative(format!("load, {name}"), load, found[0], 1e-8));
        if rate.is_finite() {
            // Where modes meet their frequency goes with the square root of the load: its mean does not.
            rows.push(Row::relative(format!("ω, {name}"), rate, found[1], 1e-8));
        }
    }
    Ok(rows)
}
