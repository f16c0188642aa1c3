//! Spectra of what is damped, and loads at which flutter and divergence set in, found along a path.

use super::modes::found;
use crate::file::File;
use crate::{Case, Row};
use flexura_solution::{Modes, OnsetKind};

pub const CASES: [Case; 2] = [
    Case {
        id: "damped_modes",
        title: "Decay and frequency: a cantilever with Kelvin-Voigt damping, the same with damping in proportion to its mass, a pendulum with a \
                damper in its hinge, a mass between a spring and a damper, swinging and creeping",
        citation: "(1 + γ s) ω² + s² = 0 for every undamped ω (S. Timoshenko, D. H. Young and W. Weaver, *Vibration Problems in \
                   Engineering*, 4th ed. (1974), ch. 1)",
        needed: "1e-9",
        run: damped,
        closed_form: None,
    },
    Case {
        id: "onset_of_flutter",
        title: "Loads at which flutter or divergence sets in, along a path: Beck's column without damping, with Kelvin-Voigt damping γ = 0.01 and \
                1e-6; Ziegler's pendulum without dampers and with small ones (the paradox); a cantilever under a tangential torque; Euler's \
                column under a dead load",
        citation: "double roots and roots on the imaginary axis to 25 digits (M. Beck, *ZAMP* 3 (1952) 225; V. V. Bolotin and N. I. Zhinzher, \
                   *Int. J. Solids Struct.* 5 (1969) 965); 7/2 - √2 and 41/28 + c²/2 (H. Ziegler, *Ing.-Arch.* 20 (1952) 49; G. Herrmann \
                   and I.-C. Jong, *J. Appl. Mech.* 32 (1965) 592)",
        needed: "1e-9",
        run: onsets,
        closed_form: None,
    },
];

const NEEDED: f64 = 1e-9;

/// Decay and circular frequency beside s.
fn both(name: &str, modes: &Modes, wanted: &[[f64; 2]]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (i, [decay, rate]) in wanted.iter().enumerate() {
        let mode = modes.modes.get(i);
        let of = |value: fn(&flexura_solution::Mode) -> f64| mode.map_or(f64::NAN, value);
        rows.push(Row::relative(format!("Re s{}, {name}", i + 1), *decay, of(|mode| mode.growth), NEEDED));
        if *rate != 0.0 {
            rows.push(Row::relative(format!("Im s{}, {name}", i + 1), *rate, of(|mode| mode.rate), NEEDED));
        }
        let ratio = -decay / decay.hypot(*rate);
        let ours = of(|mode| mode.damping_ratio.unwrap_or(f64::NAN));
        rows.push(Row::relative(format!("ζ{}, {name}", i + 1), ratio, ours, NEEDED));
    }
    rows
}

fn rod(keys: &str) -> String {
    format!(
        "[section.rod]\nshape = \"stiffness\"\nGJ = 1e4\nEI2 = 1e4\nEI3 = 1\nmass_per_length = 1\n[beam.rod]\nsection = \"rod\"\nlength = 1\n\
         extension = false\n{keys}start = {{ body = \"ground\", hold = \"clamp\" }}\n"
    )
}

fn damped() -> Result<Vec<Row>, String> {
    let modes = found(&rod("damping = 0.01\n"), 2)?;
    let kelvin = [[-0.061811816842, 3.5154718983], [-2.4275940926, 21.900356286]];
    let mut rows = both("Kelvin-Voigt", &modes, &kelvin);
    let alpha: f64 = 1.5;
    let modes = found(&format!("mass_damping = {alpha}\n{}", rod("")), 2)?;
    let held = [3.5160152685, 22.034491565].map(|omega: f64| {
        let decay: f64 = -0.5 * alpha;
        [decay, (omega * omega - decay * decay).sqrt()]
    });
    rows.extend(both("in proportion to mass", &modes, &held));
    // J θ¨ + c θ˙ + m g l θ = 0 with m = 2, l = 0.5, J = 0.5 about the hinge, and k for g.
    let pendulum = "[body.bob]\nmass = 2\ncenter_of_mass = [0.5, 0, 0]\n[joint.hinge]\nkind = \"revolute\"\nparent = \"ground\"\n\
                    child = \"bob\"\naxis = [0, 0, 1]\nstiffness = 8\ndamping = 0.6\n";
    let modes = found(pendulum, 1)?;
    rows.extend(both("hinge", &modes, &[[-0.6, (16.0_f64 - 0.36).sqrt()]]));
    // m ẍ + c ẋ + k x = 0 along a slide, once swinging, once creeping.
    let slide = |c: f64| {
        format!(
            "[body.block]\nat = [1, 0, 0]\nmass = 2\n[joint.way]\nkind = \"prismatic\"\nparent = \"ground\"\nchild = \"block\"\n\
             axis = [1, 0, 0]\n[spring.link]\nfrom = {{ body = \"ground\" }}\nto = {{ body = \"block\" }}\nstiffness = 18\ndamping = {c:?}\n"
        )
    };
    rows.extend(both("spring and damper", &found(&slide(4.0), 1)?, &[[-1.0, 8.0_f64.sqrt()]]));
    let creeps = found(&slide(20.0), 2)?;
    rows.extend(both("strong damper", &creeps, &[[-1.0, 0.0], [-9.0, 0.0]]));
    Ok(rows)
}

/// The first onset along a range: kind, load and rate.
fn first(text: &str, range: [f64; 2], count: usize) -> Result<(OnsetKind, f64, f64), String> {
    let file = File::new(&format!("format = 1\nname = \"onset\"\n{text}"))?;
    let along = file.modes_along("p", range, 20, count)?;
    let onset = along.onsets.first().and_then(|list| list.first()).ok_or("nothing sets in")?;
    if !onset.begins {
        return Err("more grow below".to_string());
    }
    Ok((onset.kind, onset.parameter, onset.rate))
}

/// Name, model, range, modes, what sets in, where, and at which rate.
type Onset<'a> = (&'a str, String, [f64; 2], usize, OnsetKind, f64, Option<f64>);

fn onsets() -> Result<Vec<Row>, String> {
    let tip = "[load.tip]\nbeam = \"rod\"\nat = 1.0\n";
    let beck = |damping: &str| {
        format!("[parameter]\np = 10\n{}{tip}force = [\"-p\", 0, 0]\nframe = \"local\"\n", rod(damping))
    };
    let ziegler = |c: f64| {
        format!(
            "[parameter]\np = 1\n[body.first]\nmass = 2\ncenter_of_mass = [1, 0, 0]\n[body.second]\nat = [1, 0, 0]\nmass = 1\n\
             center_of_mass = [1, 0, 0]\n[joint.foot]\nkind = \"revolute\"\nparent = \"ground\"\nchild = \"first\"\naxis = [0, 0, 1]\n\
             stiffness = 1\ndamping = {c:?}\n[joint.knee]\nkind = \"revolute\"\nparent = {{ body = \"first\", at = [1, 0, 0] }}\n\
             child = \"second\"\naxis = [0, 0, 1]\nstiffness = 1\ndamping = {c:?}\n[load.tip]\nbody = \"second\"\nat = [1, 0, 0]\n\
             force = [\"-p\", 0, 0]\nframe = \"local\"\n"
        )
    };
    let torque = format!(
        "[parameter]\np = 1\n{}{tip}moment = [\"p\", 0, 0]\nframe = \"local\"\n",
        rod("").replace("GJ = 1e4\nEI2 = 1e4", "GJ = 0.8\nEI2 = 2")
    );
    let euler = format!("[parameter]\np = 1\n{}{tip}force = [\"-p\", 0, 0]\n", rod(""));
    let quarter = 0.25 * std::f64::consts::PI.powi(2);
    let small: f64 = 1e-3;
    let cases: [Onset; 7] = [
        ("Beck", beck(""), [5.0, 25.0], 3, OnsetKind::Flutter, 20.050953619, Some(11.015557641)),
        (
            "Beck, γ = 0.01",
            beck("damping = 0.01\n"),
            [5.0, 15.0],
            2,
            OnsetKind::Flutter,
            10.966111659,
            Some(5.3997091071),
        ),
        (
            "Beck, γ = 1e-6",
            beck("damping = 1e-6\n"),
            [5.0, 15.0],
            2,
            OnsetKind::Flutter,
            10.938849346,
            Some(5.3986138277),
        ),
        ("Ziegler", ziegler(0.0), [1.0, 2.5], 2, OnsetKind::Flutter, 3.5 - 2.0_f64.sqrt(), None),
        (
            "Ziegler, small dampers",
            ziegler(small),
            [1.0, 2.5],
            2,
            OnsetKind::Flutter,
            41.0 / 28.0 + 0.5 * small * small,
            None,
        ),
        ("tangential torque", torque, [0.8, 2.2], 2, OnsetKind::Flutter, 1.6381405433, Some(4.1943608366)),
        ("Euler", euler, [1.0, 4.0], 2, OnsetKind::Divergence, quarter, None),
    ];
    let mut rows = Vec::new();
    for (name, text, range, count, kind, load, rate) in cases {
        let (ours, at, omega) = first(&text, range, count).map_err(|error| format!("{name}: {error}"))?;
        rows.push(Row::relative(format!("load, {name}"), load, at, NEEDED));
        if let Some(rate) = rate {
            rows.push(Row::relative(format!("ω, {name}"), rate, omega, NEEDED));
        }
        let told = if ours == kind { 0.0 } else { 1.0 };
        rows.push(Row::vanishing(format!("is taken for the other, {name}"), told, 0.0));
    }
    Ok(rows)
}
