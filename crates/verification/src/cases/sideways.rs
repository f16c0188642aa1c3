//! Strips on edge that leave the plane in which they are bent: a cantilever and a frame.

use crate::file::File;
use crate::path::{Path, crossings, miscounted};
use crate::{Case, Row};
use flexura_testkit::lateral;
use std::f64::consts::FRAC_PI_2;

pub const CASES: [Case; 2] = [
    Case {
        id: "lateral_strip",
        title: "Lateral buckling of a strip cantilever under a load at its tip, stiff in its plane (`lateral_strip.toml`): \
                4.0126 √(EI2 GJ)/L²; unstable directions on both sides",
        citation: "twice the first zero of J_{-1/4} (A. G. M. Michell, *Phil. Mag.* 48 (1899) 298; S. P. Timoshenko and J. M. Gere, \
                   *Theory of Elastic Stability*, 2nd ed. (1961), §6.3: 4.013)",
        needed: "1e-8; the digits printed",
        run: cantilever,
        closed_form: None,
    },
    Case {
        id: "frame_end_moments",
        title: "Right-angle frame under end moments (`frame_end_moments.toml`), closing and opening the corner: \
                (π/L)√(EI2 GJ) = 622.21 N·mm with EI3 without bound; with the true EI3 the legs bend to arcs first, \
                622.2217 and 622.2219 N·mm. Opened further, the corner twists as well, at 631.47 N·mm",
        citation: "J. H. Argyris et al., *Comput. Methods Appl. Mech. Eng.* 20 (1979) 105; with EI3 small motions of two \
                   arcs (`testkit/src/lateral.rs`)",
        needed: "1e-8; the digits printed",
        run: frame,
        closed_form: None,
    },
];

fn cantilever() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/lateral_strip.toml"))?;
    let followed = file.trace(&[], &Path::of("load", [0.0, 5.0]), 1e-10)?;
    let found = crossings(followed.first()?);
    let [point] = found[..] else { return Err(format!("{} branch points", found.len())) };
    let exact = lateral::cantilever();
    Ok(vec![
        Row::relative("load L²/√(EI2 GJ)", exact, point.parameter, 1e-8),
        Row::absolute("load, as printed", 4.013, point.parameter, 5e-4),
        miscounted(followed.first()?, |load| usize::from(load > exact)),
    ])
}

fn frame() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/frame_end_moments.toml");
    let young = 71.24e9;
    let [soft, stiff] = [[0.03, 0.6e-3], [0.6e-3, 0.03]].map(|[b, h]: [f64; 2]| young * b * h.powi(3) / 12.0);
    let torsion = young / 2.62 * 2.16e-12;
    let length = 0.24;
    let plain = lateral::frame(soft, torsion, length);
    let bent = lateral::bent_frame([soft, stiff], torsion, length, FRAC_PI_2);
    let true_text = text.replace("EI3 = \"inf\"", "EI3 = \"young*0.6 mm*(30 mm)^3/12\"");
    if true_text == text {
        return Err("the file's EI3 is another one".to_string());
    }
    let mut rows = Vec::new();
    for (sign, bent, way) in [(1.0, bent[0], "closing"), (-1.0, bent[1], "opening")] {
        for (text, wanted, what) in
            [(text, plain, "EI3 without bound"), (&true_text, bent.ok_or("no critical moment")?, "EI3 true")]
        {
            let path = Path::of("moment", [0.0, 0.63 * sign]);
            let followed = File::new(text)?.trace(&[], &path, 1e-10)?;
            let found = crossings(followed.first()?);
            let [point] = found[..] else { return Err(format!("{way}: {} branch points", found.len())) };
            let ours = sign * point.parameter;
            rows.push(Row::relative(format!("moment {way}, {what}"), wanted, ours, 1e-8));
            if what == "EI3 without bound" {
                rows.push(Row::absolute("moment, N·mm, as printed", 622.21, 1e3 * ours, 5e-3));
            }
            rows.push(miscounted(followed.first()?, |moment| usize::from(sign * moment > wanted)));
        }
    }
    rows.extend(twisted(text, [soft, f64::INFINITY], torsion, plain)?);
    Ok(rows)
}

/// The second branch point of the opening frame, at which its legs move to opposite sides; and none of the closing one.
fn twisted(text: &str, bending: [f64; 2], torsion: f64, first: f64) -> Result<Vec<Row>, String> {
    let file = File::new(text)?;
    let mut rows = Vec::new();
    for sign in [1.0, -1.0] {
        let exact =
            lateral::twisted_frame(bending, torsion, 0.24, FRAC_PI_2, sign).ok_or("no critical moment")?;
        let followed = file.trace(&[], &Path::of("moment", [0.0, 0.7 * sign]), 1e-10)?;
        let found = crossings(followed.first()?);
        if exact < 0.7 {
            let [_, point] = found[..] else { return Err(format!("{} branch points", found.len())) };
            rows.push(Row::relative("moment that twists the corner", exact, sign * point.parameter, 1e-8));
        }
        rows.push(miscounted(followed.first()?, |moment| {
            usize::from(sign * moment > first) + usize::from(sign * moment > exact)
        }));
    }
    Ok(rows)
}
