//! What spins: shapes under centrifugal force, and modes in a frame that turns.

use super::modes::{compared, found};
use crate::file::File;
use crate::{Case, Row};

pub const CASES: [Case; 2] = [
    Case {
        id: "spinning_shapes",
        title: "Centrifugal force: a heavy arm that stretches, a tip mass on a massless one, a body with inertia on a hinge away from the axis",
        citation: "EA u'' + ρA Ω² (x + u) = 0, of which J. C. Simo and L. Vu-Quoc, *CMAME* 66 (1988) 125, print the linear part; balance of \
                   moments about the hinge with -½ Ω·J Ω",
        needed: "1e-9",
        run: shapes,
        closed_form: None,
    },
    Case {
        id: "spinning_modes",
        title: "Modes in a frame that turns: flapping of a rotating cantilever, whirling of a hinged Rayleigh shaft above two of its critical \
                speeds (forward and backward, in the frame's own axes), a body on a hinge",
        citation: "power series in 25 digits (A. D. Wright and others, *J. Appl. Mech.* 49 (1982) 197); quadratic equation of each sine; second \
                   derivative of the energy in the frame",
        needed: "1e-9",
        run: modes,
        closed_form: None,
    },
];

const NEEDED: f64 = 1e-9;

/// A body of mass 2 with J = diag(0.3, 0.2, 0.1), 1 below its hinge, in a frame that turns at 3 about z; by the angle at which it stands,
/// the hinge's distance from the axis and the square of its circular frequency.
fn bob(angle: f64) -> (String, f64) {
    let (g, rate, mass, [a, b, c]) = (9.81, 3.0_f64, 2.0, [0.3, 0.2, 0.1]);
    let (sin, cos) = angle.sin_cos();
    let square = rate * rate;
    let away = (mass * g * sin - square * (a - c) * sin * cos) / (mass * square * cos) - sin;
    let bent = mass * (g * cos - square * cos * cos + square * (away + sin) * sin)
        - square * (a - c) * (cos * cos - sin * sin);
    let text = format!(
        "gravity = [0, 0, {g:?}]\nspin = {{ axis = [0, 0, 1], rate = {rate:?} }}\n[body.bob]\nat = [{away:?}, 0, 0]\nmass = {mass:?}\n\
         center_of_mass = [0, 0, 1]\ninertia = [{a:?}, {b:?}, {c:?}]\n[joint.hinge]\nkind = \"revolute\"\nparent = {{ body = \"ground\", \
         at = [{away:?}, 0, 0] }}\nchild = \"bob\"\naxis = [0, 1, 0]\n[output]\nangle = \"joint.hinge.angle\"\n"
    );
    (text, (bent / (mass + b)).sqrt())
}

fn shapes() -> Result<Vec<Row>, String> {
    let arm = "format = 1\nname = \"arm\"\nspin = { axis = [0, 0, 1], rate = 6 }\n[section.arm]\nshape = \"stiffness\"\nEA = 2.8e7\nGA2 = 1e7\n\
               GA3 = 1e7\nGJ = 1.4e4\nEI2 = 1.4e4\nEI3 = 1.4e4\nmass_per_length = 1.2\nrotary_inertia = [1.2e-3, 6e-4, 6e-4]\n[beam.arm]\n\
               section = \"arm\"\nlength = 10\nshear = true\nstart = { body = \"ground\", hold = \"clamp\" }\n[output]\n\
               x = \"beam.arm.end.position.x\"\n";
    let k = 6.0 * (1.2_f64 / 2.8e7).sqrt();
    let stretched = (k * 10.0).tan() / k;
    let x = |text: &str, name: &str| -> Result<f64, String> {
        Ok(File::new(text)?.solve(&[], 1e-10)?.number(name))
    };
    let mut rows = vec![Row::relative("stretch of a heavy arm", stretched - 10.0, x(arm, "x")? - 10.0, 1e-8)];
    // EA u/L = m Ω² (L + u)
    let tip = "format = 1\nname = \"tip\"\nspin = { axis = [0, 0, 1], rate = 2, through = [-1, 0, 0] }\n[section.arm]\nshape = \"stiffness\"\n\
               EA = 100\nGJ = 1\nEI2 = 1\nEI3 = 1\n[beam.arm]\nsection = \"arm\"\nlength = 1\n\
               start = { body = \"ground\", hold = \"clamp\" }\n[mass.tip]\nbeam = \"arm\"\nat = 1.0\nmass = 3\n[output]\n\
               x = \"beam.arm.end.position.x\"\n";
    rows.push(Row::relative("tip mass", (100.0 + 12.0) / 88.0, x(tip, "x")?, NEEDED));
    let (text, _) = bob(0.6);
    let angle = x(&format!("format = 1\nname = \"bob\"\n{text}"), "angle")?;
    rows.push(Row::relative("angle of a body", 0.6, angle, NEEDED));
    Ok(rows)
}

fn modes() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (rate, wanted) in [
        (1.0, [3.681646814, 22.181011151, 61.841762587]),
        (3.0, [4.7972785324, 23.320263674, 62.984967481]),
        (6.0, [7.3603730193, 26.809081679, 66.683914382]),
        (12.0, [13.170150488, 37.603112331, 79.614478489]),
    ] {
        let text = format!(
            "spin = {{ axis = [0, 0, 1], rate = {rate:?} }}\n[section.rod]\nshape = \"stiffness\"\nGJ = 1e4\nEI2 = 1\nEI3 = 1e4\n\
             mass_per_length = 1\n[beam.rod]\nsection = \"rod\"\nlength = 1\nextension = false\n\
             start = {{ body = \"ground\", hold = \"clamp\" }}\n"
        );
        rows.extend(compared(&format!("flapping at {rate}"), &found(&text, 3)?, &wanted, 1.0));
    }
    let pin = "hold = \"universal\", axis = [0, 1, 0], second_axis = [0, 0, 1]";
    let shaft = format!(
        "spin = {{ axis = [1, 0, 0], rate = 20 }}\n[section.rod]\nshape = \"stiffness\"\nEA = 1e8\nGJ = 1e4\nEI2 = 1\nEI3 = 1\n\
         mass_per_length = 1\nrotary_inertia = [0.005, 0.0025, 0.0025]\n[beam.rod]\nsection = \"rod\"\nlength = 1\n\
         start = {{ body = \"ground\", {pin} }}\nend = {{ body = \"ground\", {pin} }}\n"
    );
    // In axes that turn along, forward whirling is slower by the rate, and backward whirling faster.
    let [back, forward] = [[-9.2803405005, 10.243535067], [-35.909746992, 39.502953486]];
    let mut wanted: Vec<f64> = back.iter().chain(&forward).map(|omega: &f64| (omega - 20.0).abs()).collect();
    wanted.sort_by(f64::total_cmp);
    let whirling = found(&shaft, 4)?;
    rows.extend(compared("whirling", &whirling, &wanted, 1.0));
    rows.push(Row::vanishing("modes that grow, whirling", whirling.unstable() as f64, 0.0));
    let (text, rate) = bob(0.6);
    rows.extend(compared("body on a hinge", &found(&text, 1)?, &[rate], 1.0));
    Ok(rows)
}
