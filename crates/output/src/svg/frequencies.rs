//! `frequencies.svg`: natural frequencies over the parameter of a path, a line for each mode.

use super::axis::Axis;
use super::canvas::{Canvas, Style};
use super::curve::{Station, from_the_left, smooth};
use super::diagram::{Mark, draw_axes, title};
use super::{COLOURS, INK, LONG_NAME, shortened};
use crate::trace::parameter_of;
use flexura_model::Model;
use flexura_solution::{Followed, ModeKind, ModesAlong};
use std::f64::consts::TAU;

/// Frame of the panel, px, and the room about it.
const SIZE: [f64; 2] = [560.0, 340.0];
const LEFT: f64 = 76.0;
const RIGHT: f64 = 90.0;
const TOP: f64 = 70.0;
const BELOW: f64 = 58.0;

/// The picture of frequencies along a path, as the text of an SVG file.
pub fn frequencies_svg(model: &Model, along: &ModesAlong) -> String {
    let trace = &along.trace;
    let hertz = |mode: &Option<Followed>| {
        mode.as_ref()
            .filter(|mode| !matches!(mode.kind, ModeKind::Diverging | ModeKind::Creeping))
            .map(|mode| mode.rate / TAU)
    };
    let (name, unit) = parameter_of(model, Some(trace.parameter));
    let mut canvas = Canvas::new(LEFT + SIZE[0] + RIGHT, TOP + SIZE[1] + BELOW);
    canvas.heading([LEFT, 26.0], &shortened(title(model), (SIZE[0] / 9.5) as usize), 16.0);
    let text = format!("natural frequencies as {} changes", shortened(name, LONG_NAME));
    super::subtitle(&mut canvas, LEFT, trace.status, &text);
    let values: Vec<f64> = along.followed.iter().flatten().flatten().filter_map(hertz).collect();
    let highest = values.iter().copied().fold(0.0, f64::max);
    let points = || trace.branches.iter().flat_map(|branch| &branch.points).map(|point| point.parameter);
    let ends = [points().fold(f64::INFINITY, f64::min), points().fold(f64::NEG_INFINITY, f64::max)];
    let ends = if ends[0] <= ends[1] { ends } else { trace.range };
    let across = Axis::new(ends, name, unit, SIZE[0], 64.0, 0.0);
    let up = Axis::new([0.0, highest], "frequency", "Hz", SIZE[1], 40.0, 0.0);
    draw_axes(&mut canvas, [LEFT, TOP, SIZE[0], SIZE[1]], &across, &up);
    let place = |parameter: f64, value: f64| {
        [LEFT + SIZE[0] * across.place(parameter), TOP + SIZE[1] * (1.0 - up.place(value))]
    };
    for (branch, rows) in trace.branches.iter().zip(&along.followed) {
        let modes = rows.iter().map(Vec::len).max().unwrap_or(0);
        for mode in 0..modes {
            let colour = COLOURS[mode % COLOURS.len()];
            let stations: Vec<Option<Station>> = branch
                .points
                .iter()
                .zip(rows)
                .map(|(point, row)| {
                    let value = row.get(mode).and_then(hertz)?;
                    Some(Station { arc: point.arc, at: place(point.parameter, value) })
                })
                .collect();
            for run in stations.split(Option::is_none) {
                let known: Vec<Station> = run.iter().flatten().copied().collect();
                canvas.curve(&from_the_left(&smooth(&known)), &Style::line(colour, 1.8));
            }
            if let Some(last) = stations.iter().rev().flatten().next() {
                let [x, y] = last.at;
                canvas.text([x + 6.0, y + 4.0], &(mode + 1).to_string(), "start", 11.0, INK);
            }
        }
        for (point, row) in branch.points.iter().zip(rows) {
            let Some(mark) = Mark::of(&point.kind) else { continue };
            row.iter()
                .filter_map(hertz)
                .for_each(|value| mark.draw(&mut canvas, place(point.parameter, value)));
        }
    }
    canvas.finish()
}
