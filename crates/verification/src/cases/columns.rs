//! Euler's columns: the loads at which they buckle, and how many directions are unstable between them.

use crate::file::File;
use crate::measure::worst;
use crate::path::{Path, counted, crossings, miscounted};
use crate::{Case, Row};
use flexura_solution::{Crossing, PointKind, TracePoint};
use flexura_spatial::Vector3;
use flexura_testkit::columns::Ends;
use flexura_testkit::elastica::Elastica;
use std::f64::consts::PI;

pub const CASES: [Case; 2] = [
    Case {
        id: "euler_columns",
        title: "Euler columns clamped-free, hinged-hinged, clamped-hinged, clamped-clamped (`euler_*.toml`): the first three \
                buckling loads, met on the straight column's path; all are supercritical pitchforks; unstable directions \
                at every point of the path; the hinged column's shapes, sines",
        citation: "π²/4, π², 20.1907, 4π² EI/L² and the next two of each: L. Euler, *De curvis elasticis* (1744); S. P. Timoshenko \
                   and J. M. Gere, *Theory of Elastic Stability*, 2nd ed. (1961), §§2.1-2.4",
        needed: "1e-8 of the loads, 1e-7 of the shapes; every count right",
        run: buckle,
        closed_form: None,
    },
    Case {
        id: "euler_post_buckled",
        title: "`euler_clamped_free.toml` past its first load, on the branch that leaves the straight path: tip at 1.5, 3 \
                and 6 times π² EI/4L², and no unstable direction",
        citation: "elliptic integrals (A. E. H. Love, *A Treatise on the Mathematical Theory of Elasticity*, 4th ed. \
                   (1927), §263)",
        needed: "1e-8 L",
        run: bend,
        closed_form: None,
    },
];

const FREE: &str = include_str!("../../../../models/euler_clamped_free.toml");

fn buckle() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for (text, ends, name) in [
        (FREE, Ends::ClampedFree, "clamped-free"),
        (include_str!("../../../../models/euler_pinned_pinned.toml"), Ends::PinnedPinned, "hinged-hinged"),
        (include_str!("../../../../models/euler_clamped_pinned.toml"), Ends::ClampedPinned, "clamped-hinged"),
        (
            include_str!("../../../../models/euler_clamped_clamped.toml"),
            Ends::ClampedClamped,
            "clamped-clamped",
        ),
    ] {
        let wanted = ends.loads(4);
        let path = Path::of("push", [1.0, wanted[2] + 0.3 * (wanted[3] - wanted[2])]);
        let followed = File::new(text)?.trace(&[], &path, 1e-10)?;
        let branch = followed.first()?;
        let found = crossings(branch);
        if found.len() != 3 {
            return Err(format!("{name}: {} branch points", found.len()));
        }
        for (i, (point, load)) in found.iter().zip(&wanted).enumerate() {
            rows.push(Row::relative(format!("load {}, {name}", i + 1), *load, point.parameter, 1e-8));
        }
        let others = found
            .iter()
            .filter(|point| point.kind != PointKind::Branch(Crossing::SupercriticalPitchfork))
            .count();
        rows.push(Row::vanishing(format!("branch points of other kinds, {name}"), others as f64, 0.0));
        rows.push(miscounted(branch, |load| ends.unstable(load)));
        rows.push(counted(branch, &[0, 1, 2, 3]));
        if ends == Ends::PinnedPinned {
            for (i, point) in found.iter().enumerate() {
                rows.push(sine(point, i + 1)?);
            }
        }
    }
    Ok(rows)
}

/// How far the direction in which the hinged column gives way is from a sine with so many half waves.
fn sine(point: &TracePoint, waves: usize) -> Result<Row, String> {
    let (Some(direction), Some(state)) = (point.directions.first(), &point.solution) else {
        return Err("no direction is reported".to_string());
    };
    let beam = &state.beams[0];
    let wave = |s: f64| (waves as f64 * PI * s / beam.length).sin();
    let pairs =
        || beam.samples.iter().zip(&direction.beams[0]).map(|(sample, twist)| (wave(sample.s), twist.linear));
    let size = pairs().map(|(wave, shift)| wave * shift.z).sum::<f64>()
        / pairs().map(|(wave, _)| wave * wave).sum::<f64>();
    let apart = worst(pairs().map(|(wave, shift)| (shift - Vector3::z() * (size * wave)).norm()));
    Ok(Row::vanishing(format!("shape {waves}, hinged-hinged, from a sine"), apart / size.abs(), 1e-7))
}

fn bend() -> Result<Vec<Row>, String> {
    let file = File::new(FREE)?;
    let first = 0.25 * PI * PI;
    let mut rows = Vec::new();
    for times in [1.5, 3.0, 6.0] {
        let path = Path { branches: 1, ..Path::of("push", [0.8 * first, times * first]) };
        let followed = file.trace(&[], &path, 1e-10)?;
        let branches = followed.switched();
        let [branch] = branches[..] else { return Err(format!("{} branches", branches.len())) };
        let tip = Elastica::dead(times * first, PI).tip();
        // One end of the branch to either side.
        for end in [branch.points.first(), branch.points.last()].into_iter().flatten() {
            let side = followed.number(end, "sway").signum();
            let row = |what: &str, wanted, ours| {
                Row::absolute(format!("{what} at {times} of the first load"), wanted, ours, 1e-8)
            };
            rows.push(row("sway", tip.position[1].abs() * side, followed.number(end, "sway")));
            rows.push(row("shortening", 1.0 - tip.position[0], followed.number(end, "shortening")));
            let unstable = end.unstable_directions.map_or(f64::NAN, |count| count as f64);
            rows.push(Row::vanishing("unstable directions there", unstable, 0.0));
        }
    }
    Ok(rows)
}
