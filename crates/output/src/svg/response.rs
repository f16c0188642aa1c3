//! `response.svg`: magnitude and phase of a linear model's responses over frequency, both axes of the first logarithmic.

use super::canvas::{Canvas, Style};
use super::diagram::title;
use super::{COLOURS, INK, shortened};
use flexura_model::Model;
use flexura_solution::StateSpace;
use std::f64::consts::TAU;

/// Frames of the panels, px, and the room about them.
const WIDTH: f64 = 560.0;
const HEIGHTS: [f64; 2] = [260.0, 120.0];
const LEFT: f64 = 76.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 64.0;
const BETWEEN: f64 = 26.0;
/// Places across.
const PLACES: usize = 900;
/// Most lines.
const MOST: usize = 6;
/// Decades below the first mode and above the last.
const AROUND: [f64; 2] = [1.0, 0.3];
/// Most decades of the magnitude.
const DECADES: f64 = 9.0;

/// A range of decimal logarithms along a panel.
struct Decades {
    ends: [f64; 2],
}

impl Decades {
    fn place(&self, logarithm: f64) -> f64 {
        (logarithm - self.ends[0]) / (self.ends[1] - self.ends[0])
    }

    /// Whole decades, with their labels.
    fn ticks(&self) -> Vec<(f64, String)> {
        let [low, high] = self.ends.map(|end| end.ceil() as i32);
        let step = ((high - low) / 8 + 1) as usize;
        let label =
            |k: i32| if (-2..=3).contains(&k) { format!("{}", 10f64.powi(k)) } else { format!("1e{k}") };
        (low..=high)
            .step_by(step)
            .map(|k| (f64::from(k), label(k)))
            .filter(|(at, _)| *at <= self.ends[1])
            .collect()
    }
}

/// The picture of the frequency response, as the text of an SVG file.
pub fn response_svg(model: &Model, space: &StateSpace) -> String {
    let mut canvas = Canvas::new(
        LEFT + WIDTH + RIGHT,
        TOP + HEIGHTS[0] + BETWEEN + HEIGHTS[1] + 58.0 + 16.0 * MOST as f64,
    );
    canvas.heading([LEFT, 26.0], &shortened(title(model), (WIDTH / 9.5) as usize), 16.0);
    super::subtitle(&mut canvas, LEFT, space.solution.status, "frequency response");
    let rates: Vec<f64> = space.squares[..space.modes]
        .iter()
        .filter(|square| **square > 0.0)
        .map(|square| square.sqrt())
        .collect();
    let first = rates.iter().copied().fold(f64::INFINITY, f64::min);
    let last = rates.iter().copied().fold(0.0, f64::max);
    if last == 0.0 {
        return canvas.finish();
    }
    let across = Decades { ends: [(first / TAU).log10() - AROUND[0], (last / TAU).log10() + AROUND[1]] };
    let places: Vec<f64> = (0..=PLACES)
        .map(|i| across.ends[0] + (across.ends[1] - across.ends[0]) * i as f64 / PLACES as f64)
        .collect();
    let rows: Vec<(f64, Vec<Vec<[f64; 2]>>)> = places
        .into_iter()
        .filter_map(|place| Some((place, space.response(TAU * 10f64.powf(place))?)))
        .collect();
    let pairs: Vec<(usize, usize)> =
        (0..space.outputs.len()).flat_map(|k| (0..space.inputs.len()).map(move |u| (k, u))).collect();
    let size = |[re, im]: [f64; 2]| re.hypot(im);
    // What answers by round-off alone has no line.
    let largest = |(k, u): &(usize, usize)| rows.iter().map(|(_, row)| size(row[*k][*u])).fold(0.0, f64::max);
    let peak = pairs.iter().map(largest).fold(0.0, f64::max);
    let told: Vec<(usize, usize)> =
        pairs.into_iter().filter(|pair| largest(pair) > 1e-12 * peak).take(MOST).collect();
    let shown = |value: [f64; 2]| Some(size(value)).filter(|size| *size > 0.0).map(f64::log10);
    let values: Vec<f64> =
        rows.iter().flat_map(|(_, row)| told.iter().filter_map(|(k, u)| shown(row[*k][*u]))).collect();
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = values.iter().copied().fold(f64::INFINITY, f64::min).max(high - DECADES);
    let up = Decades { ends: [low - 0.2, (high + 0.2).max(low + 1.0)] };
    let frames = [[LEFT, TOP, WIDTH, HEIGHTS[0]], [LEFT, TOP + HEIGHTS[0] + BETWEEN, WIDTH, HEIGHTS[1]]];
    let turns: Vec<(f64, String)> =
        [-180.0, -90.0, 0.0, 90.0, 180.0].map(|at| (at, format!("{at}°"))).to_vec();
    axes(&mut canvas, frames[0], &across, (&up.ticks(), &|at| up.place(at)), "magnitude, SI");
    axes(&mut canvas, frames[1], &across, (&turns, &|at| (at + 180.0) / 360.0), "phase");
    canvas.text([LEFT + 0.5 * WIDTH, frames[1][1] + HEIGHTS[1] + 31.0], "frequency, Hz", "middle", 11.5, INK);
    for (i, (k, u)) in told.iter().enumerate() {
        let style = Style::line(COLOURS[i % COLOURS.len()], 1.6);
        let line =
            |value: &dyn Fn([f64; 2]) -> Option<f64>, [x, y, width, height]: [f64; 4]| -> Vec<[f64; 2]> {
                let each = rows.iter().filter_map(|(place, row)| {
                    let at = value(row[*k][*u])?.clamp(0.0, 1.0);
                    Some([x + width * across.place(*place), y + height * (1.0 - at)])
                });
                each.collect()
            };
        let magnitude = line(&|value| shown(value).map(|value| up.place(value)), frames[0]);
        canvas.polyline(magnitude.into_iter(), &style);
        let phase = line(&|[re, im]| Some((im.atan2(re).to_degrees() + 180.0) / 360.0), frames[1]);
        canvas.polyline(phase.into_iter(), &style);
        let y = frames[1][1] + HEIGHTS[1] + 52.0 + 16.0 * i as f64;
        canvas.line([LEFT, y - 4.0], [LEFT + 22.0, y - 4.0], &style);
        let (output, input) = (&space.outputs[*k], &space.inputs[*u]);
        let text = format!("{} [{}] by {} [{}]", output.name, output.unit, input.name, input.unit);
        canvas.text([LEFT + 28.0, y], &shortened(&text, 84), "start", 11.0, INK);
    }
    canvas.finish()
}

/// Ticks up a panel, and where each stands.
type Upwards<'a> = (&'a [(f64, String)], &'a dyn Fn(f64) -> f64);

fn axes(canvas: &mut Canvas, frame: [f64; 4], across: &Decades, (ticks, place): Upwards<'_>, label: &str) {
    let [left, top, width, height] = frame;
    canvas.ground(frame);
    let grid = Style::line("#e9e9e9", 0.8);
    for (value, label) in across.ticks() {
        let x = left + width * across.place(value);
        canvas.line([x, top], [x, top + height], &grid);
        canvas.text([x, top + height + 14.0], &label, "middle", 10.5, "#444444");
    }
    for (value, label) in ticks {
        let y = top + height * (1.0 - place(*value));
        canvas.line([left, y], [left + width, y], &grid);
        canvas.text([left - 5.0, y + 3.5], label, "end", 10.5, "#444444");
    }
    canvas.upright([left - 50.0, top + 0.5 * height], label, 11.5);
}
