//! What a person reads after a trace. Branches are counted from 1.

use crate::quantity::{quantity, vector};
use crate::screen::{BAD, BOLD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::model::{Model, Output, TraceStudy};
use flexura::post::Scales;
use flexura::solution::{
    Branch, BranchEnd, BranchOrigin, CriticalCurve, Crossing, PointKind, Status, Trace, TracePoint,
};

/// Rows of a table; the files and the document hold all.
const MOST_ROWS: usize = 40;
/// Rows of the critical curve.
const CRITICAL_ROWS: usize = 12;
/// Points of two branches that differ by less than this part are one.
const SAME: f64 = 1e-6;
/// Columns for outputs, so that a row fits on a screen.
const MOST_OUTPUTS: usize = 4;

const UNDECIDED: &str = "not decided";
/// Why a single state of a mechanism whose stability can be decided has no verdict.
const NEAR_CRITICAL: &str = "stability is not decided where another critical point, or the end of the path, is so near that round-off hides \
                             the sign of a stiffness";

/// The summary as text.
pub fn render(model: &Model, study: &TraceStudy, trace: &Trace) -> String {
    let names = Names { model, study, trace, scales: scales(trace), largest: largest(model, trace) };
    let mut text = names.headline();
    for table in [names.special_points(), names.branches()] {
        if !table.is_empty() {
            text += &format!("\n{}", table.shortened(MOST_ROWS).render());
        }
    }
    text += &names.events_not_met();
    text += &names.stalls();
    if let Some(curve) = &trace.critical {
        text += &names.critical(curve);
    }
    if model.outputs.len() > MOST_OUTPUTS {
        let note = match model.outputs.len() - MOST_OUTPUTS {
            1 => "1 further output stands in the files and the document".to_owned(),
            more => format!("{more} further outputs stand in the files and the document"),
        };
        text += &format!("\n{}\n", styled(DIM, &note));
    }
    match &trace.stability_reason {
        Some(reason) => text += &format!("\nstability is not decided: {reason}\n"),
        None if text.contains(UNDECIDED) => text += &format!("\n{NEAR_CRITICAL}\n"),
        None => {}
    }
    text
}

/// The largest lengths, forces and moments of all states that are kept.
fn scales(trace: &Trace) -> Scales {
    let points = trace.branches.iter().flat_map(|branch| &branch.points);
    let kept = points.filter_map(|point| point.solution.as_ref()).map(|solution| Scales::of(solution));
    kept.fold(Scales::default(), |a, b| Scales {
        length: a.length.max(b.length),
        force: a.force.max(b.force),
        moment: a.moment.max(b.moment),
    })
}

fn largest(model: &Model, trace: &Trace) -> Vec<f64> {
    let points = || trace.branches.iter().flat_map(|branch| &branch.points);
    let of = |i: usize| {
        let values = points().filter_map(|point| point.outputs.get(i)?.as_ref()).flatten();
        values.fold(0.0f64, |largest, value| largest.max(value.abs()))
    };
    (0..model.outputs.len()).map(of).collect()
}

struct Names<'a> {
    model: &'a Model,
    study: &'a TraceStudy,
    trace: &'a Trace,
    scales: Scales,
    /// Of every output, its largest value on all branches.
    largest: Vec<f64>,
}

impl Names<'_> {
    fn headline(&self) -> String {
        let name = title(&self.model.name);
        let state = match self.trace.status {
            Status::Converged => styled(GOOD, "converged"),
            status => styled(BAD, &status.word().replace('_', " ")),
        };
        let counted = |count: usize, what: &str, many: &str| {
            format!("{count} {}", if count == 1 { what } else { many })
        };
        let work = self.trace.work;
        let words = [
            counted(self.trace.branches.len(), "branch", "branches"),
            counted(work.points, "point", "points"),
            counted(work.newton_steps, "Newton step", "Newton steps"),
        ];
        format!("{name}: {state}\n  {}\n", styled(DIM, &words.join(", ")))
    }

    fn value(&self, parameter: usize, value: f64) -> String {
        quantity(value, &self.model.parameters[parameter].unit, 6)
    }

    fn parameter(&self, value: f64) -> String {
        self.value(self.trace.parameter, value)
    }

    fn outputs(&self) -> &[Output] {
        &self.model.outputs[..self.model.outputs.len().min(MOST_OUTPUTS)]
    }

    fn output_cells(&self, point: &TracePoint) -> Vec<String> {
        let cells = self.outputs().iter().enumerate().map(|(i, output)| {
            // Where symmetry makes something zero, what is left is an error.
            let noise = self.noise(output, self.largest[i], point.error_estimate);
            let quiet = |value: f64| if value.abs() < noise { 0.0 } else { value };
            match point.outputs.get(i).and_then(Option::as_deref) {
                Some([x, y, z]) => vector([*x, *y, *z].map(quiet), &output.unit, 5),
                Some([value]) => quantity(quiet(*value), &output.unit, 6),
                _ => "-".to_owned(),
            }
        });
        cells.collect()
    }

    /// Below which a value of an output says nothing, beside the largest that it has and what else has its unit.
    fn noise(&self, output: &Output, largest: f64, error: f64) -> f64 {
        let absolute = match output.unit.as_str() {
            "m" => error * self.scales.length,
            "N" => error * self.scales.force,
            "N*m" => error * self.scales.moment,
            "rad" => error.max(1e-14),
            "" => 1e-10,
            _ => 0.0,
        };
        absolute.max(1e-10 * largest)
    }

    fn special_points(&self) -> Table {
        let parameter = &self.model.parameters[self.trace.parameter].name;
        let names = self.outputs().iter().map(|output| output.name.as_str());
        let headings: Vec<&str> =
            ["special points", "branch", parameter].into_iter().chain(names).chain(["stability"]).collect();
        let mut table = Table::new(&headings);
        for (b, branch) in self.trace.branches.iter().enumerate() {
            for (p, point) in branch.points.iter().enumerate() {
                if !point.kind.is_special() || self.is_told(branch.origin, point) {
                    continue;
                }
                let mut row =
                    vec![self.kind(&point.kind), (b + 1).to_string(), self.parameter(point.parameter)];
                row.extend(self.output_cells(point));
                row.push(verdict(branch, p));
                table.row(row);
            }
        }
        table
    }

    /// Is it the point from which its branch comes, which is told with the other branch?
    fn is_told(&self, origin: BranchOrigin, point: &TracePoint) -> bool {
        let BranchOrigin::Switched { branch, point: number } = origin else { return false };
        let other = self.trace.branches.get(branch).and_then(|branch| branch.points.get(number));
        let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
        other.is_some_and(|other| {
            let values = point.outputs.iter().flatten().flatten();
            let others = other.outputs.iter().flatten().flatten();
            matches!(point.kind, PointKind::Branch(_))
                && same(point.parameter, other.parameter)
                // Noise beside zero may differ.
                && values.zip(others).all(|(a, b)| same(*a, *b) || (a - b).abs() < point.error_estimate)
        })
    }

    fn kind(&self, kind: &PointKind) -> String {
        match kind {
            PointKind::Branch(crossing) => crossing_words(*crossing),
            PointKind::Event(position) => match self.study.events.get(*position) {
                Some(event) => event.output.name.clone(),
                None => "event".to_owned(),
            },
            other => other.word().to_owned(),
        }
    }

    fn branches(&self) -> Table {
        let mut table = Table::new(&["branches", "from", "points", "first end", "last end"]);
        for (b, branch) in self.trace.branches.iter().enumerate() {
            let mut row =
                vec![(b + 1).to_string(), self.origin(branch.origin), branch.points.len().to_string()];
            let points = [branch.points.first(), branch.points.last()];
            row.extend(points.into_iter().zip(&branch.ends).map(|(point, end)| match point {
                Some(point) => format!("{}, {}", self.parameter(point.parameter), end_words(end)),
                None => end_words(end).to_owned(),
            }));
            table.row(row);
        }
        table
    }

    fn origin(&self, origin: BranchOrigin) -> String {
        match origin {
            BranchOrigin::Rest => "rest".to_owned(),
            BranchOrigin::Switched { branch, point } => {
                let known = self.trace.branches.get(branch).and_then(|branch| branch.points.get(point));
                let place = known
                    .map_or_else(String::new, |point| format!(" at {}", self.parameter(point.parameter)));
                format!("branch {}{place}", branch + 1)
            }
            BranchOrigin::Search => "search".to_owned(),
            BranchOrigin::Imperfection => "an imperfection".to_owned(),
        }
    }

    /// Events that were asked for and lie on no branch.
    fn events_not_met(&self) -> String {
        let points = || self.trace.branches.iter().flat_map(|branch| &branch.points);
        let is_met = |event: usize| points().any(|point| point.kind == PointKind::Event(event));
        let missing = self.study.events.iter().enumerate().filter(|(i, _)| !is_met(*i));
        let text: String = missing.map(|(_, event)| format!("  not met: {}\n", event.output.name)).collect();
        if text.is_empty() { text } else { format!("\n{text}") }
    }

    /// Why branches could not be followed further.
    fn stalls(&self) -> String {
        let mut text = String::new();
        for (b, branch) in self.trace.branches.iter().enumerate() {
            for (end, point) in branch.ends.iter().zip([branch.points.first(), branch.points.last()]) {
                let Some(reason) = end.reason() else { continue };
                let place = point
                    .map_or_else(String::new, |point| format!(" at {}", self.parameter(point.parameter)));
                text += &format!("  branch {} stalled{place}: {reason}\n", b + 1);
            }
        }
        if text.is_empty() { text } else { format!("\n{text}") }
    }

    fn critical(&self, curve: &CriticalCurve) -> String {
        let second = &self.model.parameters[curve.parameter].name;
        let first = &self.model.parameters[self.trace.parameter].name;
        let heading = format!("critical {first} by {second}: {}", self.kind(&curve.kind));
        let names = self.outputs().iter().map(|output| output.name.as_str());
        let headings: Vec<&str> = [second.as_str(), first].into_iter().chain(names).collect();
        let mut table = Table::new(&headings);
        let last = curve.points.len().saturating_sub(1);
        let step = last.div_ceil(CRITICAL_ROWS - 1).max(1);
        for (i, (value, point)) in curve.points.iter().enumerate() {
            if i % step == 0 || i == last {
                let mut row = vec![self.value(curve.parameter, *value), self.parameter(point.parameter)];
                row.extend(self.output_cells(point));
                table.row(row);
            }
        }
        let ends = format!("{}, {}", end_words(&curve.ends[0]), end_words(&curve.ends[1]));
        let points = format!("  {} points; ends: {ends}", curve.points.len());
        let reasons: String = curve
            .ends
            .iter()
            .filter_map(BranchEnd::reason)
            .map(|reason| format!("  stalled: {reason}\n"))
            .collect();
        format!("\n{}\n{}{}\n{reasons}", styled(BOLD, &heading), table.render(), styled(DIM, &points))
    }
}

/// "stable", "unstable (2)"; at a fold or branch point, what it is before and behind.
fn verdict(branch: &Branch, position: usize) -> String {
    let word = |point: &TracePoint| match (point.stable?, point.unstable_directions) {
        (true, _) => Some("stable".to_owned()),
        (false, Some(count)) => Some(format!("unstable ({count})")),
        (false, None) => Some("unstable".to_owned()),
    };
    let point = &branch.points[position];
    if let Some(word) = word(point) {
        return word;
    }
    let unknown = UNDECIDED.to_owned();
    if !point.kind.is_critical() {
        return unknown;
    }
    // A state too near to the point for a verdict is passed over, another critical point is not; a branch's end has one side only.
    let side = |points: &mut dyn Iterator<Item = &TracePoint>| {
        let mut points = points.take_while(|point| !point.kind.is_critical()).peekable();
        let beside = points.peek().is_some();
        points.find_map(word).or(beside.then(|| unknown.clone()))
    };
    let neighbour = |at: Option<usize>| at.and_then(|at| branch.points.get(at)).map(|_| unknown.clone());
    let before = side(&mut branch.points[..position].iter().rev()).or(neighbour(position.checked_sub(1)));
    let after = side(&mut branch.points[position + 1..].iter()).or(neighbour(Some(position + 1)));
    match (before, after) {
        (Some(before), Some(after)) if before == after => before,
        (Some(before), Some(after)) => format!("{before} → {after}"),
        (one, other) => one.or(other).unwrap_or(unknown),
    }
}

fn crossing_words(crossing: Crossing) -> String {
    match crossing {
        Crossing::SupercriticalPitchfork => "pitchfork, supercritical".to_owned(),
        Crossing::SubcriticalPitchfork => "pitchfork, subcritical".to_owned(),
        Crossing::Pitchfork => "pitchfork".to_owned(),
        Crossing::Transcritical => "transcritical crossing".to_owned(),
        Crossing::Multiple(count) => format!("branch point, {count} directions"),
    }
}

fn end_words(end: &BranchEnd) -> &'static str {
    match end {
        BranchEnd::Range => "end of the range",
        BranchEnd::Stop => "stop",
        BranchEnd::Closed => "closed loop",
        BranchEnd::Start => "start",
        BranchEnd::PointLimit => "most points",
        BranchEnd::Stalled(_) => "stalled",
        BranchEnd::Interrupted => "interrupted",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura::model::Target;
    use flexura::modelfile::Document;
    use flexura::solution::TraceWork;

    const ELASTICA: &str = include_str!("../../../models/elastica.toml");

    fn point(force: f64, kind: PointKind, unstable: Option<usize>) -> TracePoint {
        TracePoint {
            parameter: force,
            arc: force,
            kind,
            outputs: vec![Some(vec![0.1 * force]), None],
            output_reasons: vec![(1, "output `b` is inf".into())],
            error_estimate: 1e-10,
            stable: unstable.map(|count| count == 0),
            unstable_directions: unstable,
            solution: None,
            shape: None,
            directions: Vec::new(),
        }
    }

    fn branch(origin: BranchOrigin, points: Vec<TracePoint>, last: BranchEnd) -> Branch {
        Branch { origin, points, ends: [BranchEnd::Start, last] }
    }

    /// A path through a pitchfork, and a branch that folds, meets an event and is lost.
    fn trace() -> Trace {
        let crossing = || PointKind::Branch(Crossing::SupercriticalPitchfork);
        let first = vec![
            point(0.0, PointKind::End, Some(0)),
            point(2.0, crossing(), None),
            point(4.0, PointKind::Regular, Some(1)),
            point(5.0, PointKind::Branch(Crossing::Multiple(2)), None),
            point(6.0, PointKind::End, Some(3)),
        ];
        let second = vec![
            point(2.0, crossing(), None),
            point(3.0, PointKind::Event(0), Some(0)),
            point(3.5, PointKind::Fold, None),
            point(3.2, PointKind::End, Some(1)),
        ];
        let curve = CriticalCurve {
            parameter: 0,
            kind: PointKind::Fold,
            points: (0..40)
                .map(|i| (f64::from(i), point(10.0 + f64::from(i), PointKind::Regular, None)))
                .collect(),
            ends: [BranchEnd::Range, BranchEnd::Stalled("it has gone".into())],
        };
        Trace {
            parameter: 0,
            range: [0.0, 6.0],
            status: Status::Stalled,
            reason: None,
            warnings: Vec::new(),
            stability_reason: None,
            branches: vec![
                branch(BranchOrigin::Rest, first, BranchEnd::Range),
                branch(
                    BranchOrigin::Switched { branch: 0, point: 1 },
                    second,
                    BranchEnd::Stalled("the tangent has no inverse".into()),
                ),
            ],
            critical: Some(curve),
            work: TraceWork { points: 9, newton_steps: 33, ..TraceWork::default() },
        }
    }

    fn text(trace: &Trace) -> String {
        let model = Document::parse(ELASTICA, "elastica.toml").and_then(|file| file.model(&[])).unwrap();
        let event = |value: f64| {
            let output = Output { name: format!("output.rise = {value} m"), ..model.outputs[0].clone() };
            Target { output, value }
        };
        let study = TraceStudy { events: vec![event(0.3), event(0.9)], ..TraceStudy::default() };
        render(&model, &study, trace)
    }

    #[test]
    fn special_points_stand_in_a_table_with_the_change_of_stability() {
        let text = text(&trace());
        let lines: Vec<String> =
            text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        for line in [
            "2 branches, 9 points, 33 Newton steps",
            "pitchfork, supercritical 1 2 N 200 mm - - stable → unstable (1)",
            "branch point, 2 directions 1 5 N 500 mm - - unstable (1) → unstable (3)",
            "output.rise = 0.3 m 2 3 N 300 mm - - stable",
            "fold 2 3.5 N 350 mm - - stable → unstable (1)",
            "1 rest 5 0 N, start 6 N, end of the range",
            "2 branch 1 at 2 N 4 2 N, start 3.2 N, stalled",
            "not met: output.rise = 0.9 m",
            "branch 2 stalled at 3.2 N: the tangent has no inverse",
            "stalled: it has gone",
        ] {
            assert!(lines.iter().any(|found| found.contains(line)), "{line}:\n{text}");
        }
        // The pitchfork is told once, and of the critical curve some rows.
        assert_eq!(text.matches("supercritical").count(), 1);
        assert!(text.contains("40 points") && text.lines().count() < 40, "{text}");
    }

    #[test]
    fn between_two_critical_points_the_stability_is_not_known() {
        let mut trace = trace();
        trace.branches[0].points.remove(2);
        let text = text(&trace);
        for words in ["stable → not decided\n", "not decided → unstable (3)\n"] {
            assert!(text.contains(words), "{words}:\n{text}");
        }
    }

    #[test]
    fn what_is_not_decided_is_told_with_the_reason() {
        let mut trace = trace();
        (trace.critical, trace.status) = (None, Status::Converged);
        trace.stability_reason = Some("a load follows the tip".into());
        for point in trace.branches.iter_mut().flat_map(|branch| &mut branch.points) {
            (point.stable, point.unstable_directions) = (None, None);
        }
        let text = text(&trace);
        assert!(text.contains("elastica") && text.contains("converged"));
        assert!(text.contains("stability is not decided: a load follows the tip"));
        assert_eq!(text.matches("not decided\n").count(), 4, "{text}");
    }

    #[test]
    fn a_path_without_anything_special_has_no_table_of_it() {
        let mut trace = trace();
        trace.critical = None;
        trace.branches.truncate(1);
        trace.branches[0].points.retain(|point| !point.kind.is_special());
        let text = text(&trace);
        assert!(!text.contains("special") && text.contains("1 branch,") && text.contains("branches"));
    }
}
