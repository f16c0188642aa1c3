//! The right-angle frame that buckles out of its plane.

use crate::file::File;
use crate::path::{Path, counted, crossings};
use crate::{Case, Row};

pub const CASES: [Case; 1] = [Case {
    id: "right_angle_frame",
    title: "Right-angle frame, 240 mm, 0.6 x 30 mm, in-plane end force with a thousandth sideways, by plain load steps \
            through its buckling to 2 N (`right_angle_frame.toml`); critical load by a Southwell plot with a sideways part \
            so small that no displacement is large, and as the branch point of the frame that stays in its plane. Torsion \
            constant bh³/3 = 2.16 mm⁴, EI3 true (1.0875 N) or without bound (1.0868 N)",
    citation: "1.088 N: J. H. Argyris et al., *Comput. Methods Appl. Mech. Eng.* 20 (1979) 105 and J. C. Simo and L. \
               Vu-Quoc, ibid. 58 (1986) 79. Under end moments: `frame_end_moments`",
    needed: "half of the last digit printed with EI3 true; 2e-3 with EI3 without bound",
    run,
    closed_form: None,
}];

const CRITICAL: f64 = 1.088;

/// Where load over deflection falls to zero (R. V. Southwell, *Proc. R. Soc. A* 135 (1932) 601), by a parabola.
fn southwell(file: &File) -> Result<f64, String> {
    let loads = [1.084, 1.085, 1.086];
    let mut stiffness = [0.0; 3];
    for (slot, load) in stiffness.iter_mut().zip(loads) {
        let answer = file.solve(&[("push", load), ("sideways", 1e-7)], 1e-10)?;
        *slot = 1e-7 * load / answer.number("sideways_travel");
    }
    let weight = |i: usize| -> f64 {
        (0..3).filter(|&j| j != i).map(|j| -stiffness[j] / (stiffness[i] - stiffness[j])).product()
    };
    Ok((0..3).map(|i| loads[i] * weight(i)).sum())
}

fn run() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/right_angle_frame.toml");
    let stiff = text.replace("\"young*0.6 mm*(30 mm)^3/12\"", "\"inf\"");
    let file = File::new(text)?;
    let followed = file.trace(&[("sideways", 0.0)], &Path::of("push", [0.0, 1.5]), 1e-10)?;
    let found = crossings(followed.first()?);
    let [point] = found[..] else { return Err(format!("{} branch points", found.len())) };
    let plotted = southwell(&file)?;
    let mut rows = vec![
        Row::absolute("branch point, N, EI3 true", CRITICAL, point.parameter, 5e-4),
        Row::absolute("branch point against Southwell plot, N", plotted, point.parameter, 1e-6),
        counted(followed.first()?, &[0, 1]),
        Row::absolute("critical load, N, EI3 true", CRITICAL, plotted, 5e-4),
        Row::absolute("critical load, N, EI3 without bound", CRITICAL, southwell(&File::new(&stiff)?)?, 2e-3),
    ];
    // With a thousandth sideways the frame leaves its plane gradually: hardly before the critical load, far past it.
    let at = |push: f64| file.solve(&[("push", push)], 1e-8).map(|answer| answer.number("sideways_travel"));
    let (before, after) = (at(0.9)?, at(1.2)?);
    rows.push(Row::vanishing("sideways travel at 0.9 N, m, of 0.24", before, 5e-4));
    rows.push(Row::vanishing("its part of that at 1.2 N", before / after, 0.02));
    // It goes on without failing; the same answer in one path or after a finer one.
    for push in [1.0, 1.088, 1.5, 2.0] {
        let rough = at(push)?;
        let fine = file.solve(&[("push", push)], 1e-10)?.number("sideways_travel");
        rows.push(Row::scaled(format!("sideways travel at {push} N, finer"), fine, rough, 0.24, 1e-7));
    }
    Ok(rows)
}
