//! How far the slider of the pushed strip comes in for a wanted deflection of its middle: one curve for all slopes, nearly.

use super::pushed_strip::{FILE, against_gravity};
use crate::file::File;
use crate::path::{Followed, Path, events};
use crate::{Case, Row};
use flexura_solution::{Branch, BranchOrigin};
use flexura_testkit::slide_law::{Cubic, slides, spread};
use std::f64::consts::PI;

pub const CASES: [Case; 1] = [Case {
    id: "slide_law",
    title: "(5.5): slide of the pushed strip as a function of its middle's deflection, from 0.03 to 0.39 L, with the weight 0.8 \
            π²EI/4L² on slopes of 0, 45° and 90°, against the deflection and with it (`strip_on_slope.toml`); how \
            nearly they are one curve; the cubic that fits them best, its error 0.026 L, and that of the printed one with \
            its sign mended, 0.028 L; -π²w²/4L for small deflections",
    citation: "the thesis, (5.5); Taylor series along both halves (`testkit/src/slide_law.rs`)",
    needed: "1e-8 L of every slide; spread within 0.0017 L to both sides of the middle; 1e-6 of the coefficients",
    run,
    closed_form: None,
}];

const WEIGHT: f64 = 0.8;
const SLOPES: [f64; 3] = [0.0, 0.25 * PI, 0.5 * PI];

/// The slides at the deflections, all on one branch to one side.
fn read(followed: &Followed, branch: &Branch, side: f64, wanted: &[(&str, f64)]) -> Result<Vec<f64>, String> {
    let mut found = Vec::new();
    for (number, (_, w)) in wanted.iter().enumerate().filter(|(_, (_, w))| w * side > 0.0) {
        match events(branch, number)[..] {
            [point] => found.push(followed.number(point, "u1")),
            ref points => return Err(format!("the deflection {w} is met {} times", points.len())),
        }
    }
    Ok(found)
}

/// For every slope the slides with the weight against the deflection, then those with it.
fn columns(middles: &[f64]) -> Result<Vec<Vec<f64>>, String> {
    // An output that depends on the push would have the model made anew for every value of it.
    let file = File::new(&FILE.replace("n = \"push\"\n", ""))?;
    let both = middles.iter().map(|w| ("w", *w)).chain(middles.iter().map(|w| ("w", -w)));
    let wanted: Vec<(&str, f64)> = both.collect();
    let mut columns = Vec::new();
    for slope in SLOPES {
        let values = [("weight", WEIGHT), ("slope", slope)];
        // With a smaller deflection against the weight the push would be greater, and the strip as led at 100° has fallen over.
        let (top, steps) = (30.0, 30);
        if slope < 0.5 * PI {
            let followed = against_gravity(&file, &values, top, |path| Path {
                events: &wanted,
                range: [0.0, top],
                steps,
                ..path
            })?;
            let lone = followed.branch(|origin| origin == BranchOrigin::Imperfection)?;
            columns.push(read(&followed, lone, 1.0, &wanted)?);
            columns.push(read(&followed, followed.first()?, -1.0, &wanted)?);
        } else {
            let path = Path { branches: 1, events: &wanted, steps, ..Path::of("push", [14.0, top]) };
            let followed = file.trace(&values, &path, 1e-10)?;
            let branches = followed.switched();
            let [branch] = branches[..] else { return Err(format!("{} branches", branches.len())) };
            columns.push(read(&followed, branch, 1.0, &wanted)?);
            columns.push(read(&followed, branch, -1.0, &wanted)?);
        }
    }
    Ok(columns)
}

fn run() -> Result<Vec<Row>, String> {
    let middles: Vec<f64> = (0..=18).map(|i| 0.03 + 0.02 * f64::from(i)).collect();
    let exact = slides(WEIGHT, &middles, &SLOPES).map_err(|error| format!("{error:?}"))?;
    let columns = columns(&middles)?;
    let ours: Vec<Vec<f64>> =
        (0..middles.len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
    let mut rows = Vec::new();
    for (i, middle) in middles.iter().enumerate().filter(|(i, _)| i % 4 == 2) {
        for (j, (exact, ours)) in exact[i].iter().zip(&ours[i]).enumerate() {
            let way = if j % 2 == 0 { "against" } else { "with" };
            let slope = SLOPES[j / 2].to_degrees();
            rows.push(Row::absolute(
                format!("slide at {middle:.2}, {slope:.0}°, {way} gravity"),
                *exact,
                *ours,
                1e-8,
            ));
        }
    }
    let apart = exact.iter().flatten().zip(ours.iter().flatten()).map(|(a, b)| (a - b).abs());
    rows.push(Row::vanishing("largest difference of all slides", apart.fold(0.0, f64::max), 1e-8));
    let width = spread(&ours);
    rows.push(Row::absolute("width of the band, L", spread(&exact), width, 1e-8));
    rows.push(Row::vanishing("half of it", 0.5 * width, 1.75e-3));
    let fits = [&exact, &ours].map(|slides| Cubic::fit(&middles, slides));
    let [Some(wanted), Some(fit)] = fits else { return Err("no cubic fits".to_string()) };
    for (power, (wanted, ours)) in wanted.coefficients.iter().zip(fit.coefficients).enumerate() {
        rows.push(Row::relative(format!("coefficient of w^{}", power + 1), *wanted, ours, 1e-6));
    }
    let printed = Cubic { coefficients: [-0.85, 5.3, -18.0] };
    rows.push(Row::absolute(
        "error of the fit, L",
        wanted.error(&middles, &exact),
        fit.error(&middles, &ours),
        1e-8,
    ));
    rows.push(Row::absolute(
        "error of the printed cubic, L",
        printed.error(&middles, &exact),
        printed.error(&middles, &ours),
        1e-8,
    ));
    rows.push(small()?);
    Ok(rows)
}

/// The weightless strip a little past its buckling: the slide's part of -π²w²/4, without what grows with the deflection.
fn small() -> Result<Row, String> {
    let wanted = [("w", 0.01), ("w", 0.02)];
    let path = Path { branches: 1, events: &wanted, steps: 20, ..Path::of("push", [15.5, 16.5]) };
    let followed = File::new(FILE)?.trace(&[("weight", 0.0)], &path, 1e-10)?;
    let branches = followed.switched();
    let [branch] = branches[..] else { return Err(format!("{} branches", branches.len())) };
    let slides = read(&followed, branch, 1.0, &wanted)?;
    let part = |i: usize| -slides[i] / (0.5 * PI * wanted[i].1).powi(2);
    Ok(Row::absolute("slide over -π²w²/4 in the limit", 1.0, (4.0 * part(0) - part(1)) / 3.0, 1e-6))
}
