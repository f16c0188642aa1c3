//! `diagram.svg`: the branches over the parameter, a panel for each output.

use super::axis::Axis;
use super::canvas::{Canvas, Style};
use super::curve::{Station, Verdict, from_the_left, smooth};
use super::series::{Series, series};
use super::{COLOURS, INK, LONG_NAME, shortened};
use crate::trace::TraceView;
use flexura_model::Model;
use flexura_solution::{Branch, BranchEnd, BranchOrigin, PointKind, Trace};

/// Frames of the panels, px: of one alone, and of several.
const ALONE: [f64; 2] = [560.0, 340.0];
const ONE_OF_SEVERAL: [f64; 2] = [360.0, 250.0];
/// Room for tick labels and names of axes, px.
const LEFT: f64 = 76.0;
const RIGHT: f64 = 24.0;
const BELOW: f64 = 58.0;
const LEGEND_LINE: f64 = 20.0;
/// Branches that the legend tells apart.
const LEGEND_BRANCHES: usize = 6;

/// The bifurcation diagram of a trace, as the text of an SVG file.
pub fn diagram_svg(view: &TraceView<'_>) -> String {
    let (list, more) = series(view);
    let size = if list.len() == 1 { ALONE } else { ONE_OF_SEVERAL };
    let columns = list.len().min(2);
    let rows = list.len().div_ceil(columns.max(1));
    let width = columns as f64 * (LEFT + size[0]) + RIGHT;
    let entries = legend_entries(view.trace);
    let places = flow(&entries, LEFT, width - RIGHT);
    let lines = places.last().map_or(0, |(line, _)| line + 1);
    let top = 64.0 + LEGEND_LINE * lines as f64 + 14.0;
    let height = top + rows as f64 * (size[1] + BELOW);
    let mut canvas = Canvas::new(width, height);

    canvas.heading([LEFT, 26.0], &shortened(title(view.model), ((width - LEFT) / 9.5) as usize), 16.0);
    super::subtitle(&mut canvas, LEFT, view.trace.status, &subtitle(view, more));
    for (entry, (line, x)) in entries.iter().zip(&places) {
        draw_entry(&mut canvas, [*x, 66.0 + LEGEND_LINE * *line as f64], entry);
    }
    for (i, series) in list.iter().enumerate() {
        let (row, column) = (i / columns, i % columns);
        let left = LEFT + column as f64 * (LEFT + size[0]);
        let frame = [left, top + row as f64 * (size[1] + BELOW), size[0], size[1]];
        draw_panel(&mut canvas, view, series, frame);
    }
    canvas.finish()
}

fn subtitle(view: &TraceView<'_>, more: usize) -> String {
    let counted =
        |count: usize, one: &str, many: &str| format!("{count} {}", if count == 1 { one } else { many });
    let branches = &view.trace.branches;
    let points = branches.iter().map(|branch| branch.points.len()).sum::<usize>();
    let mut text = format!(
        "equilibria as {} changes; {}, {}",
        shortened(view.parameter().0, LONG_NAME),
        counted(branches.len(), "branch", "branches"),
        counted(points, "point", "points")
    );
    if more > 0 {
        text += &format!("; {} not shown", counted(more, "more output", "more outputs"));
    }
    text
}

fn draw_panel(canvas: &mut Canvas, view: &TraceView<'_>, series: &Series, frame: [f64; 4]) {
    let [left, top, width, height] = frame;
    let points = view.trace.branches.iter().flat_map(|branch| &branch.points);
    let values = points.map(|point| point.parameter).filter(|value| value.is_finite());
    let ends = values.fold(None, |ends: Option<[f64; 2]>, value| {
        Some(ends.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]))
    });
    let (name, unit) = view.parameter();
    let across = Axis::new(ends.unwrap_or(view.trace.range), name, unit, width, 64.0, 0.0);
    let bounds = series.bounds().unwrap_or([0.0; 2]);
    let up = Axis::new(bounds, &series.name, &series.unit, height, 40.0, series.noise);
    draw_axes(canvas, frame, &across, &up);
    let place = |parameter: f64, value: f64| {
        [left + width * across.place(parameter), top + height * (1.0 - up.place(value))]
    };

    for (b, branch) in view.trace.branches.iter().enumerate() {
        let stations: Vec<Option<Station>> = branch
            .points
            .iter()
            .zip(&series.values[b])
            .map(|(point, value)| Some(Station { arc: point.arc, at: place(point.parameter, (*value)?) }))
            .collect();
        draw_branch(canvas, branch, &stations, COLOURS[b % COLOURS.len()]);
    }
    // The marks of all branches lie over all lines.
    for (b, branch) in view.trace.branches.iter().enumerate() {
        let values = branch.points.iter().zip(&series.values[b]);
        for (point, value) in values.clone() {
            if let (Some(mark), Some(value)) = (Mark::of(&point.kind), value) {
                mark.draw(canvas, place(point.parameter, *value));
            }
        }
        let last = branch.points.len().saturating_sub(1);
        for (end, i) in branch.ends.iter().zip([0, last]) {
            if is_broken_off(end)
                && let Some((point, Some(value))) = values.clone().nth(i)
            {
                Mark::BrokenOff.draw(canvas, place(point.parameter, *value));
            }
        }
    }
}

/// Ground, grid, ticks and names of a panel.
pub fn draw_axes(canvas: &mut Canvas, frame: [f64; 4], across: &Axis, up: &Axis) {
    let [left, top, width, height] = frame;
    canvas.ground(frame);
    let grid = Style::line("#e9e9e9", 0.8);
    for (value, label) in across.ticks() {
        let x = left + width * across.place(value);
        canvas.line([x, top], [x, top + height], &grid);
        canvas.text([x, top + height + 14.0], &label, "middle", 10.5, "#444444");
    }
    for (value, label) in up.ticks() {
        let y = top + height * (1.0 - up.place(value));
        canvas.line([left, y], [left + width, y], &grid);
        canvas.text([left - 5.0, y + 3.5], &label, "end", 10.5, "#444444");
    }
    canvas.text([left + 0.5 * width, top + height + 31.0], &across.label, "middle", 11.5, INK);
    canvas.upright([left - 50.0, top + 0.5 * height], &up.label, 11.5);
}

/// A smooth line through the points that have a value, in one style as long as the verdict is one.
fn draw_branch(canvas: &mut Canvas, branch: &Branch, stations: &[Option<Station>], colour: &'static str) {
    let mut first = 0;
    for run in stations.split(Option::is_none) {
        let known: Vec<Station> = run.iter().flatten().copied().collect();
        let pieces = smooth(&known);
        let points = &branch.points[first..first + run.len()];
        let verdict = |i: usize| Verdict::between(&points[i], &points[i + 1]);
        let mut start = 0;
        while start < pieces.len() {
            let goes_on = |i: &usize| verdict(*i) == verdict(start) && !points[*i].kind.is_critical();
            let more = (start + 1..pieces.len()).take_while(goes_on).count();
            let end = start + 1 + more;
            // Halves of a symmetric branch may lie on each other: dashes that begin at the same end cover each other and
            // do not fill each other's gaps.
            canvas.curve(&from_the_left(&pieces[start..end]), &verdict(start).style(colour));
            start = end;
        }
        first += run.len() + 1;
    }
}

fn is_broken_off(end: &BranchEnd) -> bool {
    matches!(end, BranchEnd::Stalled(_) | BranchEnd::PointLimit | BranchEnd::Interrupted)
}

/// The symbol of a special point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    Fold,
    Branch,
    Event,
    BrokenOff,
}

impl Mark {
    /// All, in the order of the legend.
    pub const ALL: [Mark; 4] = [Mark::Fold, Mark::Branch, Mark::Event, Mark::BrokenOff];

    /// That of a point, if it is special.
    pub fn of(kind: &PointKind) -> Option<Self> {
        match kind {
            PointKind::Fold => Some(Mark::Fold),
            PointKind::Branch(_) => Some(Mark::Branch),
            PointKind::Event(_) => Some(Mark::Event),
            PointKind::Regular | PointKind::End => None,
        }
    }

    /// What the legend calls it.
    pub fn name(self) -> &'static str {
        match self {
            Mark::Fold => "fold",
            Mark::Branch => "branch point",
            Mark::Event => "event",
            Mark::BrokenOff => "not followed further",
        }
    }

    pub fn draw(self, canvas: &mut Canvas, [x, y]: [f64; 2]) {
        let outline = Style::line("#ffffff", 1.0);
        match self {
            Mark::Fold => canvas.circle([x, y], 4.4, INK, &outline),
            Mark::Branch => {
                let half = 4.2;
                let corners =
                    [[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]];
                canvas.polygon(&corners, INK, &outline);
            }
            Mark::Event => canvas.circle([x, y], 4.2, "#ffffff", &Style::line(INK, 1.5)),
            Mark::BrokenOff => {
                let stroke = Style::line(INK, 1.6);
                canvas.line([x - 4.0, y - 4.0], [x + 4.0, y + 4.0], &stroke);
                canvas.line([x - 4.0, y + 4.0], [x + 4.0, y - 4.0], &stroke);
            }
        }
    }
}

/// What the legend explains.
enum Entry {
    Line(Verdict),
    Mark(Mark),
    Branch { number: usize, words: String },
}

impl Entry {
    fn words(&self) -> &str {
        match self {
            Entry::Line(Verdict::Stable) => "stable",
            Entry::Line(Verdict::Unstable) => "unstable",
            Entry::Line(Verdict::Undecided) => "stability not decided",
            Entry::Mark(mark) => mark.name(),
            Entry::Branch { words, .. } => words,
        }
    }

    /// Room for its symbol, px.
    fn symbol(&self) -> f64 {
        if matches!(self, Entry::Mark(_)) { 14.0 } else { 32.0 }
    }
}

fn legend_entries(trace: &Trace) -> Vec<Entry> {
    let pairs = || trace.branches.iter().flat_map(|branch| branch.points.windows(2));
    let verdicts = [Verdict::Stable, Verdict::Unstable, Verdict::Undecided].into_iter();
    let mut entries: Vec<Entry> = verdicts
        .filter(|verdict| pairs().any(|pair| Verdict::between(&pair[0], &pair[1]) == *verdict))
        .map(Entry::Line)
        .collect();
    let there = |mark: &Mark| match mark {
        Mark::BrokenOff => trace.branches.iter().flat_map(|branch| &branch.ends).any(is_broken_off),
        mark => {
            let mut points = trace.branches.iter().flat_map(|branch| &branch.points);
            points.any(|point| Mark::of(&point.kind) == Some(*mark))
        }
    };
    entries.extend(Mark::ALL.into_iter().filter(there).map(Entry::Mark));
    if (2..=LEGEND_BRANCHES).contains(&trace.branches.len()) {
        entries.extend(trace.branches.iter().enumerate().map(|(number, branch)| Entry::Branch {
            number,
            words: format!("{}: {}", number + 1, origin(branch.origin)),
        }));
    }
    entries
}

/// Where a branch comes from, in few words.
fn origin(origin: BranchOrigin) -> String {
    match origin {
        BranchOrigin::Rest => "from rest".to_owned(),
        BranchOrigin::Switched { branch, .. } => format!("from branch {}", branch + 1),
        BranchOrigin::Search => "found by search".to_owned(),
        BranchOrigin::Imperfection => "by an imperfection".to_owned(),
    }
}

/// Line and left edge (px) of each entry, as words flow. Branches begin a line of their own.
fn flow(entries: &[Entry], left: f64, right: f64) -> Vec<(usize, f64)> {
    let (mut line, mut x) = (0, left);
    let mut places = Vec::new();
    let mut is_among_branches = false;
    for entry in entries {
        let width = entry.symbol() + 6.2 * entry.words().chars().count() as f64 + 20.0;
        let is_branch = matches!(entry, Entry::Branch { .. });
        if x > left && (x + width - 20.0 > right || is_branch != is_among_branches) {
            (line, x) = (line + 1, left);
        }
        is_among_branches = is_branch;
        places.push((line, x));
        x += width;
    }
    places
}

fn draw_entry(canvas: &mut Canvas, [x, y]: [f64; 2], entry: &Entry) {
    let (from, to) = ([x, y], [x + 26.0, y]);
    match entry {
        Entry::Line(verdict) => canvas.line(from, to, &verdict.style(INK)),
        Entry::Mark(mark) => mark.draw(canvas, [x + 5.0, y]),
        Entry::Branch { number, .. } => {
            canvas.line(from, to, &Style::line(COLOURS[number % COLOURS.len()], 2.6));
        }
    }
    canvas.text([x + entry.symbol(), y + 4.0], entry.words(), "start", 11.5, INK);
}

/// The name of a model for a heading.
pub fn title(model: &Model) -> &str {
    if model.name.is_empty() { "mechanism" } else { &model.name }
}
