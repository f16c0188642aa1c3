//! Pictures of fits and formulas: what was measured with the model's curve, and the residuals below.

use super::axis::Axis;
use super::canvas::{Canvas, Style};
use super::diagram::draw_axes;
use super::{COLOURS, INK, LOAD, shortened};
use crate::fitting::{FitView, FormulaView};

/// Frames of the upper and the lower panel, px, and the room around them.
const WIDTH: f64 = 400.0;
const UPPER: f64 = 240.0;
const LOWER: f64 = 120.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 30.0;
const TOP: f64 = 76.0;
const GAP: f64 = 52.0;
/// Most panels side by side, and most specimens in the legend.
const MOST: usize = 3;
const NAMED: usize = 10;

/// Dots over x: value, what the model or formula says, and the colour's number.
struct Dot {
    x: f64,
    value: f64,
    curve: f64,
    group: usize,
    counts: bool,
}

struct Column {
    across: (String, String),
    up: (String, String),
    dots: Vec<Dot>,
}

fn bounds(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let mut known = values.filter(|value| value.is_finite());
    let first = known.next()?;
    Some(known.fold([first; 2], |[low, high], value| [low.min(value), high.max(value)]))
}

/// Colours of groups: those of all pictures, then darker ones.
fn colour(group: usize) -> &'static str {
    const MORE: [&str; 4] = [INK, "#7f3b08", "#542788", "#666666"];
    match group % (COLOURS.len() + MORE.len()) {
        group if group < COLOURS.len() => COLOURS[group],
        group => MORE[group - COLOURS.len()],
    }
}

fn draw(canvas: &mut Canvas, column: &Column, left: f64, lines: bool) {
    let Some(ends) = bounds(column.dots.iter().map(|dot| dot.x)) else { return };
    let Some(range) = bounds(column.dots.iter().flat_map(|dot| [dot.value, dot.curve])) else { return };
    let horizontal = || Axis::new(ends, &column.across.0, &column.across.1, WIDTH, 64.0, 0.0);
    let noise = 1e-12 * range[0].abs().max(range[1].abs());
    let vertical = Axis::new(range, &column.up.0, &column.up.1, UPPER, 40.0, noise);
    let frame = [left, TOP, WIDTH, UPPER];
    draw_axes(canvas, frame, &horizontal(), &vertical);
    let axis = horizontal();
    let place = |x: f64, y: f64| [left + WIDTH * axis.place(x), TOP + UPPER * (1.0 - vertical.place(y))];
    let groups = column.dots.iter().map(|dot| dot.group).max().map_or(0, |last| last + 1);
    for group in (0..groups).filter(|_| lines) {
        let mut own: Vec<&Dot> = column.dots.iter().filter(|dot| dot.group == group).collect();
        own.sort_by(|a, b| a.x.total_cmp(&b.x));
        let points = own.iter().filter(|dot| dot.curve.is_finite()).map(|dot| place(dot.x, dot.curve));
        canvas.polyline(points, &Style::line(colour(group), 1.4));
    }
    for dot in &column.dots {
        let fill = if dot.counts { colour(dot.group) } else { "#ffffff" };
        canvas.circle(place(dot.x, dot.value), 2.6, fill, &Style::line(colour(dot.group), 0.8));
    }
    let residual = |dot: &Dot| dot.value - dot.curve;
    let Some([low, high]) = bounds(column.dots.iter().map(residual)) else { return };
    let reach = low.abs().max(high.abs()).max(f64::MIN_POSITIVE);
    let top = TOP + UPPER + GAP;
    let vertical = Axis::new([-reach, reach], "residual", &column.up.1, LOWER, 34.0, 0.0);
    draw_axes(canvas, [left, top, WIDTH, LOWER], &horizontal(), &vertical);
    let place = |x: f64, y: f64| [left + WIDTH * axis.place(x), top + LOWER * (1.0 - vertical.place(y))];
    canvas.line(place(ends[0], 0.0), place(ends[1], 0.0), &Style::line("#999999", 0.8).dashed("4 3"));
    for dot in column.dots.iter().filter(|dot| residual(dot).is_finite()) {
        let fill = if dot.counts { colour(dot.group) } else { "#ffffff" };
        canvas.circle(place(dot.x, residual(dot)), 2.4, fill, &Style::line(colour(dot.group), 0.8));
    }
}

fn sheet(title: &str, note: &str, bad: bool, columns: &[Column], legend: &[String], lines: bool) -> String {
    let count = columns.len().max(1);
    let width = count as f64 * (LEFT + WIDTH) + RIGHT + if legend.len() > 1 { 130.0 } else { 0.0 };
    let mut canvas = Canvas::new(width, TOP + UPPER + GAP + LOWER + 58.0);
    let title = if title.is_empty() { "mechanism" } else { title };
    canvas.heading([LEFT, 26.0], &shortened(title, ((width - LEFT) / 9.5) as usize), 16.0);
    canvas.text([LEFT, 44.0], note, "start", 11.0, if bad { LOAD } else { "#666666" });
    for (i, column) in columns.iter().enumerate() {
        draw(&mut canvas, column, LEFT + i as f64 * (LEFT + WIDTH), lines);
    }
    let left = count as f64 * (LEFT + WIDTH) + 24.0;
    for (i, name) in legend.iter().enumerate().filter(|_| legend.len() > 1).take(NAMED) {
        let y = TOP + 10.0 + 18.0 * i as f64;
        canvas.circle([left, y - 4.0], 3.4, colour(i), &Style::line(colour(i), 0.8));
        canvas.text([left + 10.0, y], &shortened(name, 16), "start", 11.0, "#222222");
    }
    if legend.len() > NAMED {
        let y = TOP + 10.0 + 18.0 * NAMED as f64;
        canvas.text([left, y], &format!("and {} more", legend.len() - NAMED), "start", 11.0, "#666666");
    }
    canvas.finish()
}

/// The picture of a fit, as the text of an SVG file.
pub fn fit_svg(view: &FitView<'_>) -> String {
    let (data, fit) = (&view.study.data, view.fit);
    // Over the first parameter that changes, or over the rows.
    let changes = |k: &usize| data.rows.iter().any(|row| row.set[*k] != data.rows[0].set[*k]);
    let across = (0..data.set.len()).find(changes);
    let name = match across {
        Some(k) => {
            let parameter = &view.model.parameters[data.set[k]];
            (parameter.name.clone(), parameter.unit.clone())
        }
        None => ("line".to_owned(), String::new()),
    };
    let column = |column: usize| {
        let dot = |(i, row): (usize, &flexura_model::MeasuredRow)| {
            let is_left_out = fit.left_out.iter().any(|(left, _)| *left == i);
            let rejected = fit.specimens.get(row.specimen).is_some_and(|specimen| specimen.is_rejected);
            let computed = fit.rows.get(i).and_then(|row| row.computed.get(column).copied().flatten());
            Some(Dot {
                x: across.map_or(row.line as f64, |k| row.set[k]),
                value: row.measured[column]?,
                curve: computed.unwrap_or(f64::NAN),
                group: row.specimen,
                counts: !is_left_out && !rejected,
            })
        };
        let (up, unit) = view.measured(column);
        Column {
            across: name.clone(),
            up: (up, unit.to_owned()),
            dots: data.rows.iter().enumerate().filter_map(dot).collect(),
        }
    };
    let columns: Vec<Column> = (0..data.measured.len()).take(MOST).map(column).collect();
    let bad = fit.status != flexura_solution::Status::Converged;
    let state = if bad { format!("{}: ", fit.status.word().replace('_', " ")) } else { String::new() };
    let more = data.measured.len().saturating_sub(MOST);
    let more = if more > 0 { format!("; {more} more outputs not shown") } else { String::new() };
    let hollow = if columns.iter().any(|column| column.dots.iter().any(|dot| !dot.counts)) {
        "; hollow: left out"
    } else {
        ""
    };
    let note = format!("{state}{} rows measured, lines: the model{hollow}{more}", data.rows.len());
    sheet(&view.model.name, &note, bad, &columns, &data.specimens, true)
}

/// The picture of a formula: the model's points and the formula, over each variable.
pub fn formula_svg(view: &FormulaView<'_>) -> String {
    let found = view.formula;
    let names = view.variables();
    let is_single = names.len() == 1;
    let column = |(k, name): (usize, &String)| Column {
        across: (name.clone(), view.study.variables[k].unit.text.clone()),
        up: (view.output(), view.study.unit.text.clone()),
        dots: found
            .points
            .iter()
            .map(|point| Dot {
                x: point.variables[k],
                value: point.value,
                curve: point.formula,
                group: 0,
                counts: true,
            })
            .collect(),
    };
    let columns: Vec<Column> = names.iter().enumerate().take(MOST).map(column).collect();
    let r_squared = found.r_squared.map_or(String::new(), |r| format!("R\u{b2} = {r:.6}, "));
    let note = format!(
        "{r_squared}largest error {:.2e}; dots: the model{}",
        found.largest.0,
        if is_single { ", line: the formula" } else { "" }
    );
    let bad = found.status != flexura_solution::Status::Converged;
    sheet(&view.model.name, &note, bad, &columns, &[], is_single)
}
