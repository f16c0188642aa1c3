//! A fold or branch point followed in a second parameter.

use super::branches::{Collection, walk_options};
use super::leg::Follower;
use super::problem::{Axis, Traced};
use flexura_continuation::{CriticalWalker, Point};
use flexura_model::{CriticalStudy, Model, TraceStudy};
use flexura_solution::{BranchEnd, CriticalCurve, PointKind, TracePoint};

/// Accuracy of the mesh beside the tolerance: differences of the critical conditions see its error.
const FINER: f64 = 0.01;

/// The second axis: from the range of the critical study, or none.
pub(crate) fn second_axis(study: &TraceStudy, first: Axis) -> Axis {
    match &study.critical {
        Some(critical) => Axis {
            parameter: critical.parameter,
            origin: critical.range[0],
            span: critical.range[1] - critical.range[0],
        },
        None => Axis { parameter: first.parameter, origin: 0.0, span: 1.0 },
    }
}

impl Axis {
    /// Where the model's own value lies.
    pub fn scaled_or_zero(&self, model: &Model) -> f64 {
        let value = model.parameters.get(self.parameter).map_or(0.0, |parameter| parameter.value);
        if self.span != 0.0 { self.scaled(value) } else { 0.0 }
    }
}

/// The curve through the wanted critical point, to both ends of the second parameter's range.
pub(crate) fn follow(
    traced: &mut Traced<'_>,
    follower: &mut Follower<'_>,
    wanted: &CriticalStudy,
    collection: &mut Collection,
) -> Option<CriticalCurve> {
    let Some(known) = collection.known.get(wanted.number.max(1) - 1) else {
        let count = collection.known.len();
        let found = if count == 1 { "1 was".to_string() } else { format!("{count} were") };
        collection
            .warnings
            .push(format!("there is no critical point number {} to follow: {found} found", wanted.number));
        return None;
    };
    let point = &collection.branches[known.branch].points[known.at];
    let kind = point.kind.clone();
    if known.met.kernel.len() > 1 {
        collection.warnings.push(
            "a point at which several directions give way at once cannot be followed in a second parameter"
                .to_string(),
        );
        return None;
    }
    let (met, fold) = (known.met.clone(), known.met.fold);
    let snapshot = met.snapshot.as_ref()?;
    let largest = walk_options(follower).largest_parameter;
    let mut sides: Vec<(Vec<(f64, TracePoint)>, BranchEnd)> = Vec::new();
    for sense in [-1.0, 1.0] {
        traced.go_back(snapshot);
        traced.refine(follower.tolerance * FINER);
        sides.push(side(traced, follower, &met.point, fold, &kind, largest, sense));
    }
    let (plus, last) = sides.pop()?;
    let (minus, first) = sides.pop()?;
    let mut points: Vec<(f64, TracePoint)> = minus.into_iter().skip(1).rev().collect();
    points.extend(plus);
    Some(CriticalCurve { parameter: wanted.parameter, kind, points, ends: [first, last] })
}

fn side(
    traced: &mut Traced<'_>,
    follower: &mut Follower<'_>,
    at: &Point,
    fold: bool,
    kind: &PointKind,
    largest: f64,
    sense: f64,
) -> (Vec<(f64, TracePoint)>, BranchEnd) {
    let mut points = Vec::new();
    let stalled = || BranchEnd::Stalled("the critical point cannot be followed further".to_string());
    let Ok(mut walker) = CriticalWalker::start(traced, at, fold, largest, sense) else {
        return (points, stalled());
    };
    points.push(report(traced, follower, &walker, kind));
    let outside = |second: f64| if sense > 0.0 { second >= 1.0 } else { second <= 0.0 };
    if outside(at.parameters[1]) {
        return (points, BranchEnd::Range);
    }
    while points.len() < follower.study.most_points {
        let before = walker.clone();
        if walker.advance(traced).is_err() {
            return (points, stalled());
        }
        let second = walker.point().parameters[1];
        let limit = if second > 1.0 { Some(1.0) } else { (second < 0.0).then_some(0.0) };
        if let Some(limit) = limit {
            return match walker.at_second(traced, &before, limit) {
                Ok(last) => {
                    points.push(report(traced, follower, &last, kind));
                    (points, BranchEnd::Range)
                }
                Err(_) => (points, stalled()),
            };
        }
        points.push(report(traced, follower, &walker, kind));
        (follower.progress)(super::TraceProgress {
            branch: follower.branch,
            points: points.len(),
            parameter: traced.axes[0].value(walker.point().parameters[0]),
            found: &[],
        });
    }
    (points, BranchEnd::PointLimit)
}

fn report(
    traced: &mut Traced<'_>,
    follower: &Follower<'_>,
    walker: &CriticalWalker,
    kind: &PointKind,
) -> (f64, TracePoint) {
    let _ = walker.point().restore(traced);
    let [first, second] = walker.point().parameters;
    let reading = follower.reader.read(traced);
    let mut point = TracePoint {
        parameter: traced.axes[0].value(first),
        arc: 0.0,
        kind: kind.clone(),
        outputs: reading.values.outputs,
        output_reasons: reading.values.reasons,
        error_estimate: follower.tolerance,
        stable: None,
        unstable_directions: None,
        solution: None,
        shape: None,
        directions: Vec::new(),
    };
    follower.reader.add_shape(traced, &mut point);
    // The ends of the range are met exactly.
    let second = if (second - second.round()).abs() <= 1e-11 { second.round() } else { second };
    (traced.axes[1].value(second), point)
}
