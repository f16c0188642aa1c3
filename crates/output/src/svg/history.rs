//! `motion.svg`: the parameter, its rate and the outputs over time. Outputs of one unit share a panel.

use super::axis::Axis;
use super::canvas::{Canvas, Style};
use super::diagram::{draw_axes, title};
use super::{COLOURS, INK, LONG_NAME, shortened};
use crate::motion::{MotionView, per_second};
use flexura_model::Drive;
use flexura_solution::Instant;

/// Frame of a panel, px.
const FRAME: [f64; 2] = [400.0, 220.0];
/// Room for tick labels and names of axes, px.
const LEFT: f64 = 76.0;
const RIGHT: f64 = 24.0;
const BELOW: f64 = 50.0;
/// Room for the names of curves above a panel, px a line.
const LINE: f64 = 17.0;
/// Most panels besides those of the parameter, and most curves of each.
const MOST_PANELS: usize = 6;
const MOST_CURVES: usize = 6;

/// One value over time.
struct Curve {
    name: String,
    values: Vec<Option<f64>>,
}

/// Curves of one unit.
struct Panel {
    unit: String,
    curves: Vec<Curve>,
}

/// The picture of a motion, as the text of an SVG file.
pub fn motion_svg(view: &MotionView<'_>) -> String {
    let (panels, more) = panels(view);
    let rows = panels.len().div_ceil(2);
    let columns = panels.len().min(2) as f64;
    let width = columns * (LEFT + FRAME[0]) + RIGHT;
    let legends: Vec<Vec<(usize, f64)>> = panels.iter().map(|panel| flow(&panel.curves)).collect();
    let room = |row: usize| -> f64 {
        let lines = legends.iter().skip(2 * row).take(2).map(|places| places.last().map_or(1, |p| p.0 + 1));
        LINE * lines.max().unwrap_or(1) as f64 + 8.0
    };
    let top = 58.0;
    let height = top + (0..rows).map(|row| room(row) + FRAME[1] + BELOW).sum::<f64>();
    let mut canvas = Canvas::new(width, height);
    canvas.heading([LEFT, 26.0], &shortened(title(view.model), ((width - LEFT) / 9.5) as usize), 16.0);
    let mut subtitle = format!("moved by {} in time", shortened(view.parameter().0, LONG_NAME));
    if more > 0 {
        subtitle += &format!("; {more} more {} not shown", if more == 1 { "curve" } else { "curves" });
    }
    super::subtitle(&mut canvas, LEFT, view.motion.status, &subtitle);
    let mut y = top;
    for row in 0..rows {
        y += room(row);
        for column in 0..2 {
            let Some(panel) = panels.get(2 * row + column) else { continue };
            let left = LEFT + column as f64 * (LEFT + FRAME[0]);
            let frame = [left, y, FRAME[0], FRAME[1]];
            draw_legend(&mut canvas, panel, &legends[2 * row + column], frame);
            draw_panel(&mut canvas, &view.motion.instants, panel, frame);
        }
        y += FRAME[1] + BELOW;
    }
    canvas.finish()
}

/// What is shown, and how many curves are not.
fn panels(view: &MotionView<'_>) -> (Vec<Panel>, usize) {
    let instants = &view.motion.instants;
    let (name, unit) = view.parameter();
    let of = |pick: &dyn Fn(&Instant) -> Option<f64>| -> Vec<Option<f64>> {
        instants.iter().map(|instant| pick(instant).filter(|value| value.is_finite())).collect()
    };
    let one = |unit: String, name: String, values: Vec<Option<f64>>| Panel {
        unit,
        curves: vec![Curve { name, values }],
    };
    let mut panels = vec![
        one(unit.to_owned(), name.to_owned(), of(&|instant| Some(instant.value))),
        one(per_second(unit, 1), format!("rate of {name}"), of(&|instant| Some(instant.rate))),
    ];
    let first = panels.len();
    let mut add = |unit: &str, name: String, values: Vec<Option<f64>>| {
        if values.iter().all(Option::is_none) {
            return;
        }
        let curve = Curve { name: shortened(&name, LONG_NAME), values };
        match panels.iter_mut().skip(first).find(|panel| panel.unit == unit) {
            Some(panel) => panel.curves.push(curve),
            None => panels.push(Panel { unit: unit.to_owned(), curves: vec![curve] }),
        }
    };
    for (i, output) in view.model.outputs.iter().enumerate() {
        let component = |k: usize| of(&|instant| instant.outputs[i].as_ref()?.get(k).copied());
        if output.formulas.len() < 3 {
            add(&output.unit, output.name.clone(), component(0));
            continue;
        }
        let size = |values: &[Option<f64>]| values.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
        let largest = (0..3).map(|k| size(&component(k))).fold(0.0, f64::max);
        for (k, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let values = component(k);
            // Of a vector, what is not zero all the time.
            if size(&values) > 1e-9 * largest {
                add(&output.unit, format!("{}.{letter}", output.name), values);
            }
        }
    }
    if view.model.outputs.is_empty() {
        for (name, joint, k) in view.coordinates() {
            let law = &view.model.joints[joint].law;
            if matches!(law.coordinates[k].drive, Drive::Driven { .. }) {
                let angle = law.kind.coordinate_kinds()[k] == flexura_model::CoordinateKind::Angle;
                let unit = if angle { "N*m" } else { "N" };
                add(
                    unit,
                    format!("effort of {name}"),
                    of(&|instant| instant.state.joints[joint].efforts.get(k).copied()),
                );
            }
        }
    }
    let mut more: usize = panels.iter().skip(first + MOST_PANELS).map(|panel| panel.curves.len()).sum();
    panels.truncate(first + MOST_PANELS);
    for panel in &mut panels {
        more += panel.curves.len().saturating_sub(MOST_CURVES);
        panel.curves.truncate(MOST_CURVES);
    }
    (panels, more)
}

fn draw_panel(canvas: &mut Canvas, instants: &[Instant], panel: &Panel, frame: [f64; 4]) {
    let [left, top, width, height] = frame;
    let ends = [instants.first(), instants.last()].map(|instant| instant.map_or(0.0, |instant| instant.time));
    let across = Axis::new(ends, "time", "s", width, 64.0, 0.0);
    let values = || panel.curves.iter().flat_map(|curve| curve.values.iter().flatten().copied());
    let bounds = match values().next() {
        Some(first) => values().fold([first; 2], |[low, high], value| [low.min(value), high.max(value)]),
        None => [0.0; 2],
    };
    let name = match &panel.curves[..] {
        [only] => only.name.as_str(),
        _ => quantity(&panel.unit),
    };
    let largest = bounds[0].abs().max(bounds[1].abs());
    let up = Axis::new(bounds, name, &panel.unit, height, 36.0, 1e-9 * largest);
    draw_axes(canvas, frame, &across, &up);
    for (i, curve) in panel.curves.iter().enumerate() {
        let points: Vec<Option<[f64; 2]>> = instants
            .iter()
            .zip(&curve.values)
            .map(|(instant, value)| {
                let (x, y) = (across.place(instant.time), up.place((*value)?));
                Some([left + width * x, top + height * (1.0 - y)])
            })
            .collect();
        let style = Style::line(COLOURS[i % COLOURS.len()], 2.0);
        for run in points.split(Option::is_none).filter(|run| run.len() > 1) {
            canvas.polyline(run.iter().flatten().copied(), &style);
        }
    }
}

/// What values of a unit are called where several share an axis.
fn quantity(unit: &str) -> &'static str {
    match unit {
        "N" => "force",
        "N*m" => "moment",
        "m" => "length",
        "rad" => "angle",
        "m/s" | "rad/s" => "velocity",
        "m/s^2" | "rad/s^2" => "acceleration",
        "W" => "power",
        _ => "value",
    }
}

/// Line and place (px) of each name, as words flow over a panel.
fn flow(curves: &[Curve]) -> Vec<(usize, f64)> {
    let (mut line, mut x) = (0, 0.0);
    let mut places = Vec::new();
    for curve in curves {
        let width = 46.0 + 6.2 * curve.name.chars().count() as f64;
        if x > 0.0 && x + width - 14.0 > FRAME[0] {
            (line, x) = (line + 1, 0.0);
        }
        places.push((line, x));
        x += width;
    }
    places
}

fn draw_legend(canvas: &mut Canvas, panel: &Panel, places: &[(usize, f64)], frame: [f64; 4]) {
    // The name of a curve that is alone stands at its axis.
    if panel.curves.len() < 2 {
        return;
    }
    let lines = places.last().map_or(0, |place| place.0) as f64;
    for (i, (curve, (line, x))) in panel.curves.iter().zip(places).enumerate() {
        let at = [frame[0] + x, frame[1] - 10.0 - LINE * (lines - *line as f64)];
        canvas.line(at, [at[0] + 20.0, at[1]], &Style::line(COLOURS[i % COLOURS.len()], 2.6));
        canvas.text([at[0] + 26.0, at[1] + 4.0], &curve.name, "start", 11.5, INK);
    }
}
