//! Natural frequencies of straight rods and columns.

use crate::file::File;
use crate::{Case, Row};
use flexura::Options;
use flexura_solution::{Modes, Solution};
use std::f64::consts::PI;

/// The closed forms and series that the references are worked out from.
const BLEVINS: &str = "roots of the characteristic equations to 22 digits (R. D. Blevins, *Formulas for Natural Frequency and Mode Shape* \
                       (1979), table 8-1)";

pub const CASES: [Case; 5] = [
    Case {
        id: "modes_of_beams",
        title: "Modes of a Euler-Bernoulli beam: clamped-free, clamped-clamped, free-free, clamped-hinged, hinged-hinged, clamped-guided; \
                with a tip mass and with a tip body",
        citation: BLEVINS,
        needed: "1e-8",
        run: beams,
        closed_form: None,
    },
    Case {
        id: "modes_of_timoshenko_beams",
        title: "Modes of a Timoshenko beam with r/L = 0.05, five kinds of ends",
        citation: "matrix exponentials in 22 digits of the equations of T. C. Huang, *J. Appl. Mech.* 28 (1961) 579",
        needed: "1e-8",
        run: timoshenko,
        closed_form: None,
    },
    Case {
        id: "modes_of_bars",
        title: "Modes of bars in stretching and torsion, free and with an end mass of their own mass",
        citation: "x = (2n - 1) π/2 and x tan x = 1 (Blevins (1979), table 8-16)",
        needed: "1e-8",
        run: bars,
        closed_form: None,
    },
    Case {
        id: "modes_of_columns",
        title: "Modes of columns under half and 0.99 of their first buckling load, and of a standing heavy column at g = 5 EI/ρAL³",
        citation: "hinged (kπ)² √(1 - P/(kπ)²); the others from characteristic equations and a power series in 22 digits",
        needed: "1e-8",
        run: columns,
        closed_form: None,
    },
    Case {
        id: "modes_of_tapered_beams",
        title: "Modes of a tapered cantilever: wedge and cone, c = 0.5",
        citation: "collocation of order 28 and 36, equations of H. H. Mabie and C. B. Rogers, *J. Acoust. Soc. Am.* 51 (1972) 1771",
        needed: "1e-8",
        run: tapered,
        closed_form: None,
    },
];

/// How far circular frequencies may be off, relatively.
pub(super) const NEEDED: f64 = 1e-8;

/// The lowest modes of a file's text.
pub(super) fn found(text: &str, count: usize) -> Result<Modes, String> {
    File::new(&format!("format = 1\nname = \"modes\"\n{text}"))?.modes(&[], count, &Options::default())
}

/// The same about the equilibrium next to another.
pub(super) fn found_near(text: &str, count: usize, from: Solution) -> Result<Modes, String> {
    let options = Options { from: Some(Box::new(from)), ..Options::default() };
    File::new(&format!("format = 1\nname = \"modes\"\n{text}"))?.modes(&[], count, &options)
}

/// Circular frequencies beside references, times `unit`.
pub(super) fn compared(name: &str, modes: &Modes, wanted: &[f64], unit: f64) -> Vec<Row> {
    let swinging: Vec<f64> =
        modes.modes.iter().filter(|mode| !mode.is_rigid()).map(|mode| mode.rate).collect();
    let row = |(i, wanted): (usize, &f64)| {
        let ours = swinging.get(i).map_or(f64::NAN, |rate| rate / unit);
        Row::relative(format!("ω{}, {name}", i + 1), *wanted, ours, NEEDED)
    };
    wanted.iter().enumerate().map(row).collect()
}

/// Two lists of frequencies in order, as far as both go.
pub(super) fn merged(a: &[f64], b: &[f64]) -> Vec<f64> {
    let end = |list: &[f64]| list.iter().copied().fold(0.0, f64::max);
    let last = end(a).min(end(b));
    let mut all: Vec<f64> = a.iter().chain(b).copied().filter(|value| *value <= last).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// A section that bends in one plane only, within the frequencies looked at.
const PLANAR: &str = "[section.rod]\nshape = \"stiffness\"\nEA = 1e7\nGJ = 1e7\nEI2 = 1e7\nEI3 = 1\nmass_per_length = 1\n\
                      rotary_inertia = [1, 0, 0]\n";

const AWAY: &str = "body = \"ground\", at = [1, 0, 0]";

fn beams() -> Result<Vec<Row>, String> {
    let clamp = "start = { body = \"ground\", hold = \"clamp\" }";
    let hinge = "start = { body = \"ground\", hold = \"revolute\", axis = [0, 0, 1] }";
    let free_start = "start = { body = \"base\", hold = \"clamp\" }";
    let guided = format!("end = {{ {AWAY}, hold = \"prismatic\", axis = [0, 1, 0] }}");
    let end = |hold: &str| format!("end = {{ {AWAY}, {hold} }}");
    let clamped = end("hold = \"clamp\"");
    let hinged = end("hold = \"revolute\", axis = [0, 0, 1]");
    let both = [22.373285448, 61.672822868, 120.90339173, 199.85944813];
    let cases: [(&str, &str, &str, &str, [f64; 4]); 6] = [
        ("clamped-free", "", clamp, "", [3.5160152685, 22.034491565, 61.697214414, 120.90191605]),
        ("clamped-clamped", "", clamp, &clamped, both),
        ("free-free", "[body.base]\n", free_start, "", both),
        ("clamped-hinged", "", clamp, &hinged, [15.418205717, 49.964862032, 104.24769646, 178.26972949]),
        ("hinged-hinged", "", hinge, &hinged, [1.0, 4.0, 9.0, 16.0].map(|n| n * PI * PI)),
        ("clamped-guided", "", clamp, &guided, [5.593321362, 30.225847932, 74.638883825, 138.79131189]),
    ];
    let mut rows = Vec::new();
    for (name, body, start, end, wanted) in cases {
        let text = format!("{PLANAR}{body}[beam.rod]\nsection = \"rod\"\nlength = 1\n{start}\n{end}\n");
        let modes = found(&text, 4)?;
        rows.extend(compared(name, &modes, &wanted, 1.0));
        let rigid = modes.modes.iter().filter(|mode| mode.is_rigid()).count();
        let loose = if name == "free-free" { 6.0 } else { 0.0 };
        rows.push(Row::absolute(format!("motions without stiffness, {name}"), loose, rigid as f64, 0.0));
    }
    for (mass, inertia, wanted) in [
        (0.5, 0.02, &[1.9593462043, 11.201764478, 28.784629181, 66.327419528][..]),
        (1.0, 0.0, &[1.5572978612, 16.250085158, 50.895842831][..]),
    ] {
        let text = format!(
            "{PLANAR}[body.tip]\nat = [1, 0, 0]\nmass = {mass}\ninertia = [0, 0, {inertia}]\n[beam.rod]\nsection = \"rod\"\nlength = 1\n\
             {clamp}\nend = {{ body = \"tip\", hold = \"clamp\" }}\n"
        );
        rows.extend(compared(&format!("tip body m = {mass}, J = {inertia}"), &found(&text, 4)?, wanted, 1.0));
    }
    Ok(rows)
}

fn timoshenko() -> Result<Vec<Row>, String> {
    let ga = 5.0 / 6.0 * 400.0 / 2.6;
    let section = format!(
        "[section.rod]\nshape = \"stiffness\"\nEA = 400\nGJ = 1e7\nEI2 = 1e7\nEI3 = 1\nGA2 = {ga:?}\nGA3 = 1e9\nmass_per_length = 1\n\
         rotary_inertia = [0.0025, 0, 0.0025]\n"
    );
    let hinge = "hold = \"revolute\", axis = [0, 0, 1]";
    let clamp = "hold = \"clamp\"";
    let cases = [
        ("CC", clamp, Some(clamp), [18.837082775, 44.329997783, 75.076813421, 108.45751181]),
        ("CF", clamp, None, [3.435274962, 19.103623277, 46.603139872, 78.902217535]),
        ("CH", clamp, Some(hinge), [13.855750449, 39.101521652, 70.533450728, 105.05147412]),
        ("HH", hinge, Some(hinge), [9.4105979232, 33.549430531, 65.646658298, 101.38352121]),
        ("FF", "", None, [20.33741794, 48.927279377, 83.153894782, 119.30650997]),
    ];
    let mut rows = Vec::new();
    for (name, start, end, wanted) in cases {
        let (body, start) = match start {
            "" => ("[body.base]\n", "start = { body = \"base\", hold = \"clamp\" }".to_string()),
            hold => ("", format!("start = {{ body = \"ground\", {hold} }}")),
        };
        let end = end.map_or(String::new(), |hold| format!("end = {{ {AWAY}, {hold} }}"));
        let text = format!(
            "{section}{body}[beam.rod]\nsection = \"rod\"\nlength = 1\nshear = true\n{start}\n{end}\n"
        );
        let modes = found(&text, 8)?;
        // Stretching, with EA = 400 and one mass, swings between them.
        let stretching = match name {
            "CF" => vec![10.0 * PI, 30.0 * PI],
            _ => vec![20.0 * PI],
        };
        let wanted = merged(&wanted, &[&stretching[..], &[wanted[3]]].concat());
        let wanted: Vec<f64> = wanted.into_iter().fold(Vec::new(), |mut list, value| {
            if list.last().is_none_or(|last: &f64| (value - last).abs() > 1e-9) {
                list.push(value);
            }
            list
        });
        rows.extend(compared(name, &modes, &wanted, 1.0));
    }
    Ok(rows)
}

fn bars() -> Result<Vec<Row>, String> {
    let free = [1.0, 3.0, 5.0, 7.0].map(|n| n * PI / 2.0);
    let loaded = [0.86033358902, 3.4256184595, 6.4372981792, 9.5293344054];
    let stretch = "EA = 1\nGJ = 1e6\nEI2 = 1e6\nEI3 = 1e6\nmass_per_length = 1";
    let twist = "EA = 1e6\nGJ = 1\nEI2 = 1e6\nEI3 = 1e6\nrotary_inertia = [1, 0, 0]";
    let mut rows = Vec::new();
    for (name, section, body) in
        [("stretching", stretch, "mass = 1"), ("torsion", twist, "inertia = [1, 0, 0]")]
    {
        for (end, wanted) in [(None, free), (Some(body), loaded)] {
            let (tip, hold, what) = match end {
                Some(body) => (
                    format!("[body.tip]\nat = [1, 0, 0]\n{body}\n"),
                    "end = { body = \"tip\", hold = \"clamp\" }",
                    "with an end mass",
                ),
                None => (String::new(), "", "free"),
            };
            let text = format!(
                "[section.rod]\nshape = \"stiffness\"\n{section}\n{tip}[beam.rod]\nsection = \"rod\"\nlength = 1\n\
                 start = {{ body = \"ground\", hold = \"clamp\" }}\n{hold}\n"
            );
            rows.extend(compared(&format!("{name}, {what}"), &found(&text, 4)?, &wanted, 1.0));
        }
    }
    Ok(rows)
}

fn columns() -> Result<Vec<Row>, String> {
    let clamp = "hold = \"clamp\"";
    let hinge = "hold = \"revolute\", axis = [0, 0, 1]";
    let euler =
        |push: f64| [1.0, 2.0, 3.0].map(|k: f64| (k * PI).powi(2) * (1.0 - push / (k * PI).powi(2)).sqrt());
    let section = "[section.rod]\nshape = \"stiffness\"\nGJ = 1e7\nEI2 = 1e7\nEI3 = 1\nmass_per_length = 1\n";
    let mut rows = Vec::new();
    for (name, part, push, hold, wanted) in [
        ("clamped-clamped", 0.5, 4.0 * PI * PI, clamp, [15.951287605, 53.762642907, 112.53422334]),
        ("clamped-clamped", 0.99, 4.0 * PI * PI, clamp, [2.2787567869, 44.57127912, 103.67117761]),
        ("hinged-hinged", 0.5, PI * PI, hinge, euler(0.5 * PI * PI)),
        ("hinged-hinged", 0.99, PI * PI, hinge, euler(0.99 * PI * PI)),
    ] {
        let text = format!(
            "{section}[body.head]\nat = [1, 0, 0]\n[joint.way]\nkind = \"prismatic\"\n\
             parent = {{ body = \"ground\", at = [1, 0, 0] }}\nchild = \"head\"\naxis = [-1, 0, 0]\neffort = {:?}\n[beam.rod]\n\
             section = \"rod\"\nlength = 1\nextension = false\nstart = {{ body = \"ground\", {hold} }}\nend = {{ body = \"head\", {hold} }}\n",
            part * push
        );
        rows.extend(compared(&format!("{name}, {part} of its load"), &found(&text, 3)?, &wanted, 1.0));
    }
    for (part, wanted) in [
        (0.5, [2.5345602161, 21.105172355, 60.919443045]),
        (0.99, [0.36621645255, 20.149443588, 60.147518066]),
    ] {
        let push = -part * PI * PI / 4.0;
        let text = format!(
            "{section}[beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\nstart = {{ body = \"ground\", {clamp} }}\n\
             [load.tip]\nbeam = \"rod\"\nat = 1.0\nforce = [{push:?}, 0, 0]\n"
        );
        rows.extend(compared(&format!("clamped-free, {part} of its load"), &found(&text, 3)?, &wanted, 1.0));
    }
    let heavy = format!(
        "gravity = [-5, 0, 0]\n{section}[beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\nstart = {{ body = \"ground\", {clamp} }}\n"
    );
    rows.extend(compared("heavy", &found(&heavy, 3)?, &[2.1184859439, 21.029280625, 60.676188249], 1.0));
    Ok(rows)
}

fn tapered() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (name, [bend, mass], wanted) in [
        ("wedge", ["(1 - 0.5*s)^3", "1 - 0.5*s"], [3.8237848473, 18.317260904, 47.26482701]),
        ("cone", ["(1 - 0.5*s)^4", "(1 - 0.5*s)^2"], [4.6251502524, 19.547613181, 48.578899334]),
    ] {
        let text = format!(
            "[section.rod]\nshape = \"stiffness\"\nGJ = 1\nEI2 = \"{bend}\"\nEI3 = \"{bend}\"\nmass_per_length = \"{mass}\"\n[beam.rod]\n\
             section = \"rod\"\nlength = 1\nextension = false\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n"
        );
        // In both planes alike.
        let twice: Vec<f64> = wanted.iter().flat_map(|rate| [*rate; 2]).collect();
        rows.extend(compared(name, &found(&text, 6)?, &twice, 1.0));
    }
    Ok(rows)
}
