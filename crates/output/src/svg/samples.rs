//! The picture of a sweep. What was found over what was varied: over one parameter as lines through the samples, over two as a
//! line for each value of the first, over more as a line for each sample across upright axes, one for each quantity.

use super::axis::Axis;
use super::canvas::{Canvas, Style};
use super::diagram::draw_axes;
use super::gradient::{self, gradient};
use super::{COLOURS, FAINT, INK, LOAD, shortened};

/// Frame of a panel and of the upright axes, px.
const FRAME: [f64; 2] = [380.0, 250.0];
const UPRIGHT: [f64; 2] = [118.0, 330.0];
/// Room for tick labels and names of axes, px.
const LEFT: f64 = 76.0;
const RIGHT: f64 = 30.0;
const TOP: f64 = 76.0;
const BELOW: f64 = 58.0;
/// Room for the bar of colours with its labels, px.
const COLOURED: f64 = 130.0;
/// Most panels, and most upright axes.
const MOST: usize = 6;
const MOST_UPRIGHT: usize = 10;

/// One quantity of every sample.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleColumn {
    /// What it is called.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// One for each sample; None where it has none.
    pub values: Vec<Option<f64>>,
}

/// The samples of a sweep, by columns.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepView<'a> {
    /// The model's name.
    pub model: &'a str,
    /// The parameters, the slowest first.
    pub varied: Vec<SampleColumn>,
    /// What came out.
    pub found: Vec<SampleColumn>,
    /// How many samples did not converge.
    pub failed: usize,
}

/// The picture of a sweep, as the text of an SVG file.
pub fn sweep_svg(view: &SweepView<'_>) -> String {
    match &view.varied[..] {
        [across] => panels(view, across, None),
        [by, across] => panels(view, across, Some(by)),
        _ => upright(view),
    }
}

fn bounds(values: &[Option<f64>]) -> Option<[f64; 2]> {
    let mut known = values.iter().flatten().copied().filter(|value| value.is_finite());
    let first = known.next()?;
    Some(known.fold([first; 2], |[low, high], value| [low.min(value), high.max(value)]))
}

fn head(canvas: &mut Canvas, view: &SweepView<'_>, width: f64, not_shown: usize) {
    let title = if view.model.is_empty() { "mechanism" } else { view.model };
    canvas.heading([LEFT, 26.0], &shortened(title, ((width - LEFT) / 9.5) as usize), 16.0);
    let count = view.varied.first().map_or(0, |column| column.values.len());
    let mut text = format!("{count} samples");
    if not_shown > 0 {
        text +=
            &format!("; {not_shown} more {} not shown", if not_shown == 1 { "output" } else { "outputs" });
    }
    let colour = if view.failed > 0 { LOAD } else { "#666666" };
    if view.failed > 0 {
        text = format!("{} did not converge; {text}", view.failed);
    }
    canvas.text([LEFT, 44.0], &text, "start", 11.0, colour);
}

/// A panel for each quantity that has values.
fn panels(view: &SweepView<'_>, across: &SampleColumn, by: Option<&SampleColumn>) -> String {
    let known: Vec<&SampleColumn> =
        view.found.iter().filter(|column| bounds(&column.values).is_some()).collect();
    let shown = &known[..known.len().min(MOST)];
    let columns = shown.len().clamp(1, 2);
    let rows = shown.len().div_ceil(columns).max(1);
    let plots = columns as f64 * (LEFT + FRAME[0]) + RIGHT;
    let width = plots + if by.is_some() { COLOURED } else { 0.0 };
    let mut canvas = Canvas::new(width, TOP + rows as f64 * (FRAME[1] + BELOW));
    head(&mut canvas, view, width, known.len() - shown.len());
    for (i, column) in shown.iter().enumerate() {
        let (row, place) = (i / columns, i % columns);
        let left = LEFT + place as f64 * (LEFT + FRAME[0]);
        let frame = [left, TOP + row as f64 * (FRAME[1] + BELOW), FRAME[0], FRAME[1]];
        draw_panel(&mut canvas, frame, across, column, by);
    }
    if let Some(by) = by
        && let Some(ends) = bounds(&by.values)
    {
        let scale = Axis::new(ends, &by.name, &by.unit, gradient::BAR, 34.0, 0.0);
        gradient::draw_bar(&mut canvas, [plots + 6.0, TOP], &scale, ends);
    }
    canvas.finish()
}

fn draw_panel(
    canvas: &mut Canvas,
    frame: [f64; 4],
    across: &SampleColumn,
    column: &SampleColumn,
    by: Option<&SampleColumn>,
) {
    let [left, top, width, height] = frame;
    let (Some(ends), Some(range)) = (bounds(&across.values), bounds(&column.values)) else { return };
    let horizontal = Axis::new(ends, &across.name, &across.unit, width, 64.0, 0.0);
    let noise = 1e-9 * range[0].abs().max(range[1].abs());
    let vertical = Axis::new(range, &column.name, &column.unit, height, 40.0, noise);
    draw_axes(canvas, frame, &horizontal, &vertical);
    for (value, samples) in groups(by, across.values.len()) {
        let colour = match (value, by.and_then(|by| bounds(&by.values))) {
            (Some(value), Some(ends)) => gradient(part(value, ends)),
            _ => COLOURS[0].to_owned(),
        };
        let mut places: Vec<(f64, Option<[f64; 2]>)> = samples
            .into_iter()
            .filter_map(|i| {
                let x = across.values[i]?;
                let at =
                    |y: f64| [left + width * horizontal.place(x), top + height * (1.0 - vertical.place(y))];
                Some((x, column.values[i].map(at)))
            })
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        for run in places.split(|(_, at)| at.is_none()).filter(|run| run.len() > 1) {
            canvas.polyline(run.iter().filter_map(|(_, at)| *at), &Style::line(colour.clone(), 1.6));
        }
        for (x, at) in places {
            match at {
                Some(at) => canvas.circle(at, 2.6, &colour, &Style::line("#ffffff", 0.6)),
                None => cross(canvas, [left + width * horizontal.place(x), top + height - 6.0]),
            }
        }
    }
}

/// Samples that have one value of a parameter, in the order of these values; all of them where there is none.
fn groups(by: Option<&SampleColumn>, count: usize) -> Vec<(Option<f64>, Vec<usize>)> {
    let Some(by) = by else { return vec![(None, (0..count).collect())] };
    let mut groups: Vec<(Option<f64>, Vec<usize>)> = Vec::new();
    for (i, value) in by.values.iter().enumerate() {
        match groups.iter_mut().find(|(known, _)| known == value) {
            Some((_, samples)) => samples.push(i),
            None => groups.push((*value, vec![i])),
        }
    }
    groups
}

/// A sample without a value.
fn cross(canvas: &mut Canvas, [x, y]: [f64; 2]) {
    for side in [-3.0, 3.0] {
        canvas.line([x - 3.0, y - side], [x + 3.0, y + side], &Style::line(LOAD, 1.2));
    }
}

/// Where a value lies between two ends, from 0 to 1.
fn part(value: f64, [low, high]: [f64; 2]) -> f64 {
    if high > low { (value - low) / (high - low) } else { 0.5 }
}

/// A line for each sample across one axis for each quantity, coloured by the first that was found.
fn upright(view: &SweepView<'_>) -> String {
    let all = view.varied.iter().chain(&view.found);
    let known: Vec<&SampleColumn> = all.filter(|column| bounds(&column.values).is_some()).collect();
    let shown = &known[..known.len().min(MOST_UPRIGHT)];
    let axes: Vec<Axis> = shown
        .iter()
        .map(|column| {
            let range = bounds(&column.values).unwrap_or([0.0, 1.0]);
            Axis::new(range, &column.name, &column.unit, UPRIGHT[1], 40.0, 0.0)
        })
        .collect();
    let width = LEFT + RIGHT + UPRIGHT[0] * shown.len().max(2) as f64;
    let mut canvas = Canvas::new(width, TOP + 24.0 + UPRIGHT[1] + 20.0);
    head(&mut canvas, view, width, known.len() - shown.len());
    let x = |i: usize| LEFT + UPRIGHT[0] * i as f64;
    let y = |axis: &Axis, value: f64| TOP + 24.0 + UPRIGHT[1] * (1.0 - axis.place(value));
    let leading = view.found.first().or(view.varied.first());
    for sample in 0..view.varied.first().map_or(0, |column| column.values.len()) {
        let colour = leading.and_then(|column| {
            let ends = bounds(&column.values)?;
            Some(gradient(part(column.values.get(sample).copied().flatten()?, ends)))
        });
        let places: Vec<Option<[f64; 2]>> = shown
            .iter()
            .zip(&axes)
            .enumerate()
            .map(|(i, (column, axis))| Some([x(i), y(axis, column.values.get(sample).copied().flatten()?)]))
            .collect();
        // What did not converge ends at the last parameter, and is dashed.
        let style = match colour {
            Some(colour) => Style::line(colour, 1.2),
            None => Style::line(FAINT, 1.2).dashed("3 3"),
        };
        for run in places.split(Option::is_none).filter(|run| run.len() > 1) {
            canvas.polyline(run.iter().flatten().copied(), &style);
        }
    }
    for (i, axis) in axes.iter().enumerate() {
        canvas.line([x(i), TOP + 24.0], [x(i), TOP + 24.0 + UPRIGHT[1]], &Style::line(INK, 1.2));
        for (value, label) in axis.ticks() {
            let y = y(axis, value);
            canvas.line([x(i) - 4.0, y], [x(i), y], &Style::line(INK, 0.8));
            canvas.text([x(i) - 6.0, y + 3.5], &label, "end", 10.0, "#444444");
        }
        let lower = 11.0 * (i % 2) as f64;
        canvas.text([x(i), TOP + 2.0 + lower], &shortened(&axis.label, 26), "middle", 10.5, INK);
    }
    canvas.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, values: &[Option<f64>]) -> SampleColumn {
        SampleColumn { name: name.to_owned(), unit: "N".to_owned(), values: values.to_vec() }
    }

    fn view(varied: Vec<SampleColumn>, found: Vec<SampleColumn>, failed: usize) -> String {
        sweep_svg(&SweepView { model: "swept", varied, found, failed })
    }

    #[test]
    fn one_parameter_makes_a_line_that_breaks_where_a_sample_failed() {
        let push = column("push", &[0.0, 1.0, 2.0, 3.0, 4.0].map(Some));
        let lift = column("lift", &[Some(0.0), Some(1.0), None, Some(3.0), Some(4.0)]);
        let text = view(vec![push], vec![lift, column("nothing", &[None; 5])], 1);
        assert_eq!(text.matches("<polyline").count(), 2);
        assert_eq!(text.matches("<circle").count(), 4);
        assert!(text.contains("1 did not converge; 5 samples"), "{text}");
        assert!(text.contains("push / N") && text.contains("lift / N") && !text.contains("nothing"));
    }

    #[test]
    fn two_parameters_make_a_line_for_each_value_of_the_first_and_a_bar_that_explains_them() {
        let by = column("by", &[1.0, 1.0, 1.0, 5.0, 5.0, 5.0].map(Some));
        let push = column("push", &[2.0, 0.0, 1.0, 2.0, 0.0, 1.0].map(Some));
        let lift = column("lift", &[3.0, 1.0, 2.0, 6.0, 4.0, 5.0].map(Some));
        let text = view(vec![by, push], vec![lift], 0);
        assert_eq!(text.matches("<polyline").count(), 2);
        // In the order of the parameter, whatever that of the samples.
        let line = text.lines().find(|line| line.starts_with("<polyline")).unwrap_or_default();
        let xs: Vec<f64> = line
            .split('"')
            .nth(1)
            .unwrap_or_default()
            .split(' ')
            .filter_map(|point| point.split_once(',')?.0.parse().ok())
            .collect();
        assert!(xs.len() == 3 && xs.is_sorted(), "{line}");
        assert!(text.contains(">by / N<"));
    }

    #[test]
    fn more_parameters_make_a_line_for_each_sample_across_an_axis_for_each_quantity() {
        let values = |factor: f64| [1.0, 2.0, 3.0, 4.0].map(|value| Some(factor * value));
        let varied = vec![column("a", &values(1.0)), column("b", &values(2.0)), column("c", &values(3.0))];
        let found = column("found", &[Some(1.0), Some(2.0), None, Some(3.0)]);
        let text = view(varied, vec![found], 1);
        let lines: Vec<&str> = text.lines().filter(|line| line.starts_with("<polyline")).collect();
        assert_eq!(lines.len(), 4);
        assert_eq!(lines.iter().filter(|line| line.contains("stroke-dasharray")).count(), 1);
        let corners = |line: &&str| line.split('"').nth(1).unwrap_or_default().split(' ').count();
        assert_eq!(lines.iter().map(corners).collect::<Vec<_>>(), [4, 4, 3, 4]);
    }
}
