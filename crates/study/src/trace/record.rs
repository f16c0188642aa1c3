//! Points of a path as they are reported.

use super::problem::Traced;
use crate::solve::{CRITICAL, SPINS};
use flexura_continuation::{Crossing as Met, Place};
use flexura_equilibrium::Equilibrium;
use flexura_model::{BeamPoint, Output, ProbeTarget, Target};
use flexura_nonlinear::System;
use flexura_post::{OutputValue, Values};
use flexura_solution::{Branch, Crossing, Direction, PointKind, Solution, TracePoint};
use flexura_spatial::Twist;
use std::cell::Cell;

/// Samples of beams where only outputs are wanted.
const FEW: usize = 2;
/// Size of the step by which a direction is sampled.
const SHIFT: f64 = 1e-5;

/// A shape at every point up to so many sections, at every second beyond, at every third beyond twice as many, and so on: a
/// document of a long path stays of a size that can be read.
const SECTIONS: usize = 10_000;

/// What is read off at every point.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reading {
    pub values: Values,
    /// How far every watched quantity is from its value.
    pub left: Vec<Option<f64>>,
    /// What to know of the state.
    pub warnings: Vec<String>,
}

/// Reads outputs and watched quantities.
pub(crate) struct Reader {
    /// Events and stops.
    pub watched: Vec<Target>,
    /// Samples along each beam of a state that is kept.
    pub samples: usize,
    /// Samples along each beam of a shape; zero for no shapes.
    pub shapes: usize,
    /// Sections of all shapes so far, and points since the last one.
    pub shaped: Cell<(usize, usize)>,
}

impl Reader {
    /// Places on beams that the watched quantities look at.
    pub fn places(&self) -> Vec<BeamPoint> {
        let probes = self.watched.iter().flat_map(|target| &target.output.probes);
        probes
            .filter_map(|probe| match probe.target {
                ProbeTarget::Beam(beam, at) => Some(BeamPoint { beam, at }),
                _ => None,
            })
            .collect()
    }

    /// Outputs and watched quantities of the present state.
    pub fn read(&self, traced: &mut Traced<'_>) -> Reading {
        let prepared = &mut traced.prepared;
        let model = prepared.problem.model();
        let outputs: Vec<&Output> =
            model.outputs.iter().chain(self.watched.iter().map(|target| &target.output)).collect();
        let probes = || outputs.iter().flat_map(|output| &output.probes);
        let energies = probes().any(|probe| probe.quantity == flexura_model::Quantity::Energy);
        let beams: Vec<usize> = probes()
            .filter_map(|probe| match probe.target {
                ProbeTarget::Beam(beam, _) => Some(beam.0),
                _ => None,
            })
            .collect();
        let mut solution = prepared.problem.sampled(FEW, energies, |beam| beams.contains(&beam));
        // Those of the mechanism itself are said of the whole trace.
        let mut warnings = flexura_solution::summed_up(prepared.problem.warnings_here());
        if let Some((cable, push)) = prepared.problem.slack_cable() {
            warnings.push(format!(
                "{cable} would have to push with {push:.4e} N to have its length: it is slack there, and the path is not that of a cable"
            ));
        }
        prepared.add_tangents(&mut solution, &[]);
        Reading { warnings, ..self.read_from(prepared.problem.model(), &solution) }
    }

    fn read_from(&self, model: &flexura_model::Model, solution: &Solution) -> Reading {
        let left = self
            .watched
            .iter()
            .map(|target| {
                let value = flexura_post::one_output(model, solution, &target.output).ok()?.value;
                match value {
                    OutputValue::Number(v) => Some(v - target.value),
                    OutputValue::Vector(_) => None,
                }
            })
            .collect();
        Reading { values: flexura_post::output_values(model, solution), left, warnings: Vec::new() }
    }

    /// The whole present state.
    pub fn whole(&self, traced: &mut Traced<'_>, index: Option<usize>, error: f64) -> Solution {
        let mut solution = traced.prepared.problem.solution(self.samples);
        traced.prepared.add_tangents(&mut solution, &[]);
        solution.error_estimate = error;
        solution.unstable_directions = index;
        solution.stable = index.map(|count| count == 0);
        solution.stability_reason = match index {
            Some(_) => None,
            None => Some(traced.undecided.clone().unwrap_or_else(|| CRITICAL.to_string())),
        };
        solution
    }

    /// Adds the present state with few samples to its point, if it is its turn.
    pub fn add_shape(&self, traced: &mut Traced<'_>, point: &mut TracePoint) {
        let (sections, since) = self.shaped.get();
        if self.shapes == 0 || since < sections / SECTIONS {
            self.shaped.set((sections, since + 1));
            return;
        }
        let shape = traced.prepared.problem.sampled(self.shapes, true, |_| true);
        let own: usize = shape.beams.iter().map(|beam| beam.samples.len()).sum();
        self.shaped.set((sections + own.max(1), 0));
        point.shape = Some(Box::new(shape));
    }

    /// A small motion along a step of the state, sampled like a whole state.
    pub fn direction(&self, problem: &mut Equilibrium, step: &[f64]) -> Direction {
        let mut kept = Vec::new();
        problem.store(&mut kept);
        let size = problem.size(step).max(f64::MIN_POSITIVE);
        let mut sides = Vec::with_capacity(2);
        for sign in [1.0, -1.0] {
            let small: Vec<f64> = step.iter().map(|s| sign * SHIFT / size * s).collect();
            problem.retract(&small);
            sides.push(problem.sampled(self.samples, false, |_| true));
            problem.restore(&kept);
        }
        let twist = |up: &flexura_spatial::Pose, down: &flexura_spatial::Pose| Twist {
            angular: flexura_spatial::log(&(up.rotation * down.rotation.inverse())),
            linear: up.position - down.position,
        };
        let beams = sides[0].beams.iter().zip(&sides[1].beams).map(|(up, down)| {
            up.samples.iter().zip(&down.samples).map(|(u, d)| twist(&u.pose, &d.pose)).collect::<Vec<_>>()
        });
        let mut direction = Direction {
            beams: beams.collect(),
            bodies: sides[0].bodies.iter().zip(&sides[1].bodies).map(|(u, d)| twist(u, d)).collect(),
        };
        normalise(&mut direction, problem.units().0);
        direction
    }
}

/// The largest displacement one metre; where it is nothing beside the turning, the largest turning one radian.
pub(crate) fn normalise(direction: &mut Direction, length: f64) -> f64 {
    let twists = || direction.beams.iter().flatten().chain(&direction.bodies);
    let shift = twists().map(|t| t.linear.norm()).fold(0.0, f64::max);
    let turn = twists().map(|t| t.angular.norm()).fold(0.0, f64::max);
    let size = if shift > 1e-6 * turn * length { shift } else { turn };
    if size > 0.0 {
        for twist in direction.beams.iter_mut().flatten().chain(&mut direction.bodies) {
            twist.linear /= size;
            twist.angular /= size;
        }
    }
    size
}

pub(crate) fn crossing(met: Met) -> Crossing {
    match met {
        Met::SupercriticalPitchfork => Crossing::SupercriticalPitchfork,
        Met::SubcriticalPitchfork => Crossing::SubcriticalPitchfork,
        Met::Pitchfork => Crossing::Pitchfork,
        Met::Transcritical => Crossing::Transcritical,
        Met::Multiple(count) => Crossing::Multiple(count),
    }
}

/// Outputs that have no value at some points, each with the reason at the first of them.
pub(crate) fn without_value(branches: &[Branch]) -> Vec<String> {
    let points = || branches.iter().flat_map(|branch| &branch.points);
    let mut first: Vec<(usize, &str, usize)> = Vec::new();
    for (output, reason) in points().flat_map(|point| &point.output_reasons) {
        match first.iter_mut().find(|(known, ..)| known == output) {
            Some((.., count)) => *count += 1,
            None => first.push((*output, reason, 1)),
        }
    }
    let all = points().count();
    first.iter().map(|(_, reason, count)| format!("{reason}; so it is at {count} of {all} points")).collect()
}

/// A regular point.
pub(crate) fn regular(value: f64, place: &Place, reading: Reading, error: f64) -> TracePoint {
    TracePoint {
        parameter: value,
        arc: place.arc,
        kind: PointKind::Regular,
        outputs: reading.values.outputs,
        output_reasons: reading.values.reasons,
        error_estimate: error,
        stable: place.index.map(|count| count == 0),
        unstable_directions: place.index,
        solution: None,
        shape: None,
        directions: Vec::new(),
    }
}

/// Where no energy says whether the present state is stable, its lowest modes do, if it has an inertia.
pub(crate) fn decide(traced: &mut Traced<'_>, point: &mut TracePoint) {
    let is_held = traced.problem().spins() && point.unstable_directions.is_some_and(|count| count > 0);
    if is_held {
        traced.undecided.get_or_insert_with(|| SPINS.to_string());
    } else if traced.undecided.is_none() || point.unstable_directions.is_some() || traced.is_massless {
        return;
    }
    let count = crate::modes::unstable_by_motion(traced.problem());
    traced.is_massless |= count.is_none();
    traced.by_motion |= count.is_some();
    point.unstable_directions = count;
    point.stable = count.map(|count| count == 0);
}
