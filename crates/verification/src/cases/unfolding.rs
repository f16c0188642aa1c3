//! Folds of the pushed strip in two parameters: what a weight makes of its pitchfork, and when a heavier sensor lowers the
//! push that is needed.

use super::pushed_strip::{FILE, against_gravity};
use crate::file::File;
use crate::path::Path;
use crate::{Case, Row};
use flexura_testkit::roots::root;
use flexura_testkit::slope::{Slope, crossing_slope, highest_weight};
use flexura_testkit::strip::{Level, unfolded};

pub const CASES: [Case; 3] = [
    Case {
        id: "unfolded_pitchfork",
        title: "The weightless strip's pitchfork unfolded by a weight against the deflection on level ground: its fold followed \
                from the weight 0.01 to 0.001 and 0.1 π²EI/4L² (`strip_on_slope.toml`), and how it tends to \
                n = 16 + 6 (W/2π)^(2/3)",
        citation: "elliptic integrals; W. T. Koiter, *On the Stability of Elastic Equilibrium* (1945), on imperfections of a \
                   stable symmetric branch point",
        needed: "1e-7 of n and w at every weight; 1e-4 of the law's factor in the limit",
        run: law,
        closed_form: None,
    },
    Case {
        id: "fold_curves",
        title: "Push at the fold as a function of the weight, 0.2 to 2 π²EI/4L², on slopes of 0, 45° and 72.748°; on the last one \
                it has its greatest value between 0.8 and 1.6",
        citation: "Taylor series along both halves (`testkit/src/slope.rs`)",
        needed: "1e-7 of n; 1e-3 of the weight at the top",
        run: curves,
        closed_form: None,
    },
    Case {
        id: "crossing_slope",
        title: "Slope from which on the sensor of weight 1.6 needs less push than that of 0.8: folds of both followed from 65° to \
                80°, where they cross. Printed is 45°, where the heavier one needs more",
        citation: "72.748°, Taylor series along both halves (`testkit/src/slope.rs`); 45°: the thesis",
        needed: "1e-5 degrees",
        run: crossing,
        closed_form: None,
    },
];

/// Some numbers at one value of the second parameter.
type At = (f64, [f64; 2]);

/// The push and the deflection at the fold on a slope, as the second parameter goes through its range.
fn curve(weight: f64, slope: f64, second: (&str, [f64; 2]), steps: usize) -> Result<Vec<At>, String> {
    let file = File::new(FILE)?;
    let critical = Some((second.0, second.1, 1));
    let followed = against_gravity(&file, &[("weight", weight), ("slope", slope)], 18.0, |path| Path {
        critical,
        steps,
        ..path
    })?;
    let points = &followed.critical()?.points;
    let reached = [points.first(), points.last()].map(|end| end.map_or(f64::NAN, |(value, _)| *value));
    if reached.iter().zip(second.1).any(|(value, wanted)| (value - wanted).abs() > 1e-9) {
        return Err(format!("the curve goes from {} to {}", reached[0], reached[1]));
    }
    Ok(points.iter().map(|(value, point)| (*value, [point.parameter, followed.number(point, "w")])).collect())
}

/// The push at a value between those of the curve: a polynomial through the six points around it.
fn between(curve: &[At], value: f64) -> f64 {
    let after = curve.partition_point(|(at, _)| *at < value);
    let first = after.saturating_sub(3).min(curve.len().saturating_sub(6));
    let near = &curve[first..(first + 6).min(curve.len())];
    let weight = |i: usize| -> f64 {
        let others = (0..near.len()).filter(|j| *j != i);
        others.map(|j| (value - near[j].0) / (near[i].0 - near[j].0)).product()
    };
    (0..near.len()).map(|i| near[i].1[0] * weight(i)).sum()
}

fn law() -> Result<Vec<Row>, String> {
    let range = [1e-3, 0.1];
    let found = curve(0.01, 0.0, ("weight", range), 16)?;
    let mut rows = Vec::new();
    for (weight, [push, middle]) in &found {
        let exact = Level { weight: *weight }.fold().ok_or("no fold")?;
        rows.push(Row::absolute(format!("n at the weight {weight:.4}"), exact.push, *push, 1e-7));
        rows.push(Row::absolute(format!("w at the weight {weight:.4}"), exact.middle, *middle, 1e-7));
    }
    // What is left out of the law is of the relative order W^(2/3).
    let part = |weight: f64| {
        let at = found.iter().find(|(value, _)| (value - weight).abs() < 1e-9 * weight);
        at.map_or(f64::NAN, |(_, [push, _])| (push - 16.0) / (unfolded(weight).push - 16.0))
    };
    let ([a, b], ratio) = ([1e-3, 1e-2].map(part), 10f64.powf(2.0 / 3.0));
    let limit = (ratio * a - b) / (ratio - 1.0);
    rows.push(Row::absolute("factor of the law in the limit, of 6/(2π)^(2/3)", 1.0, limit, 1e-4));
    let order = ((b - 1.0) / (a - 1.0)).log10();
    rows.push(Row::absolute("order of what is left out", 2.0 / 3.0, order, 0.01));
    Ok(rows)
}

fn curves() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for degrees in [0.0, 45.0, 72.748_f64] {
        let slope = degrees.to_radians();
        let found = curve(1.0, slope, ("weight", [0.2, 2.0]), 12)?;
        let every = found.len().div_ceil(4);
        for (weight, [push, middle]) in found.iter().step_by(every).chain(found.last()) {
            let exact = Slope::new(*weight, slope).fold().map_err(|error| format!("{error:?}"))?;
            let what = format!("at the weight {weight:.4} on {degrees}°");
            rows.push(Row::absolute(format!("n {what}"), exact.push, *push, 1e-7));
            rows.push(Row::absolute(format!("w {what}"), exact.middle, *middle, 1e-7));
        }
        if degrees > 45.0 {
            // Differences of order two around the greatest value.
            let h = 0.02;
            let rate = |weight: f64| between(&found, weight + h) - between(&found, weight - h);
            let ours = root(rate, 0.8, 1.6).unwrap_or(f64::NAN);
            let exact = highest_weight(slope, [0.8, 1.6]).ok_or("no greatest value")?;
            rows.push(Row::absolute(
                format!("weight that needs the greatest push on {degrees}°"),
                exact,
                ours,
                1e-3,
            ));
        }
    }
    Ok(rows)
}

fn crossing() -> Result<Vec<Row>, String> {
    let range = [65.0, 80.0].map(f64::to_radians);
    let [light, heavy] = [0.8, 1.6].map(|weight| curve(weight, 70f64.to_radians(), ("slope", range), 12));
    let (light, heavy) = (light?, heavy?);
    let apart = |slope: f64| between(&light, slope) - between(&heavy, slope);
    let ours = root(apart, range[0], range[1]).ok_or("they do not cross")?.to_degrees();
    let exact = crossing_slope([0.8, 1.6], range).ok_or("the second method has no crossing")?.to_degrees();
    let mut rows = vec![
        Row::absolute("crossing slope, degrees", exact, ours, 1e-5),
        Row::absolute("the same to three places, degrees", 72.748, ours, 5e-4),
    ];
    for (curve, weight) in [(&light, 0.8), (&heavy, 1.6)] {
        let push = Slope::new(weight, exact.to_radians()).fold().map_err(|error| format!("{error:?}"))?.push;
        rows.push(Row::absolute(
            format!("n there for {weight}"),
            push,
            between(curve, exact.to_radians()),
            1e-7,
        ));
    }
    Ok(rows)
}
