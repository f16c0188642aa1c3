//! What a diagram shows over the parameter: outputs, or how far the mechanism has moved.

use crate::trace::TraceView;
use flexura_model::Model;
use flexura_post::Scales;
use flexura_solution::{Solution, TracePoint};

/// Most panels of a diagram.
pub const MOST: usize = 4;

/// One value of every point.
pub struct Series {
    /// What it is called.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// For each branch, for each of its points; None where there is none.
    pub values: Vec<Vec<Option<f64>>>,
    /// Differences below this are noise.
    pub noise: f64,
}

impl Series {
    /// Smallest and largest value; None where there is none at all.
    pub fn bounds(&self) -> Option<[f64; 2]> {
        let mut values = self.values.iter().flatten().filter_map(|value| *value);
        let first = values.next()?;
        Some(values.fold([first; 2], |[low, high], value| [low.min(value), high.max(value)]))
    }

    fn changes(&self) -> bool {
        self.bounds().is_some_and(|[low, high]| high - low > self.noise.max(1e-9 * high.abs().max(low.abs())))
    }
}

/// What is shown, and how much more there would be.
pub fn series(view: &TraceView<'_>) -> (Vec<Series>, usize) {
    let scales = scales(view);
    let noise = |unit: &str| {
        1e-8 * match unit {
            "m" => scales.length,
            "N" => scales.force,
            "N*m" => scales.moment,
            "rad" | "" => 1.0,
            _ => 0.0,
        }
    };
    let mut list: Vec<Series> = Vec::new();
    for (i, output) in view.model.outputs.iter().enumerate() {
        let of = |name: String, component: usize| Series {
            name,
            unit: output.unit.clone(),
            values: each_point(view, |_, _, point| point.outputs.get(i)?.as_ref()?.get(component).copied()),
            noise: noise(&output.unit),
        };
        if output.formulas.len() < 3 {
            list.push(of(output.name.clone(), 0));
            continue;
        }
        // Of a vector, what changes.
        let components = ["x", "y", "z"].into_iter().enumerate();
        let components = components.map(|(k, letter)| of(format!("{}.{letter}", output.name), k));
        list.extend(components.filter(Series::changes));
    }
    list.retain(|series| series.bounds().is_some());
    if list.is_empty() {
        let moved = |branch: usize, number: usize, point: &TracePoint| {
            Some(largest_displacement(view.model_at(branch, number), point.solution.as_ref()?))
        };
        let values = each_point(view, moved);
        let name = "largest displacement".to_owned();
        list.push(Series { name, unit: "m".to_owned(), values, noise: noise("m") });
    }
    let more = list.len().saturating_sub(MOST);
    list.truncate(MOST);
    (list, more)
}

fn each_point(
    view: &TraceView<'_>,
    value: impl Fn(usize, usize, &TracePoint) -> Option<f64>,
) -> Vec<Vec<Option<f64>>> {
    let branches = view.trace.branches.iter().enumerate();
    branches
        .map(|(b, branch)| {
            let points = branch.points.iter().enumerate();
            points.map(|(p, point)| value(b, p, point).filter(|value| value.is_finite())).collect()
        })
        .collect()
}

/// The largest lengths, forces and moments of all states that are kept.
pub fn scales(view: &TraceView<'_>) -> Scales {
    let points = view.trace.branches.iter().flat_map(|branch| &branch.points);
    let kept = points.filter_map(|point| point.solution.as_ref()).map(|solution| Scales::of(solution));
    kept.fold(Scales::default(), |a, b| Scales {
        length: a.length.max(b.length),
        force: a.force.max(b.force),
        moment: a.moment.max(b.moment),
    })
}

/// How far a body, or an end of a beam or tube, has moved at most.
fn largest_displacement(model: &Model, solution: &Solution) -> f64 {
    let ends =
        solution.beams.iter().flat_map(|beam| beam.samples.first().into_iter().chain(beam.samples.last()));
    let ends = ends.map(|sample| (sample.pose.position - sample.rest_pose.position).norm());
    let bodies = model.bodies.iter().zip(&solution.bodies);
    let bodies = bodies.map(|(body, pose)| (pose.position - body.pose.position).norm());
    ends.chain(bodies).fold(0.0, f64::max)
}
