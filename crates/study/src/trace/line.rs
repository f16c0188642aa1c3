//! A parameter on which only loads and drives depend, and these linearly: the model need not be made again.
//!
//! That this is so is not assumed: models are made at three values, and everything but forces, moments, drives and rests of
//! joints must be the same in them, and these on straight lines.

use flexura_equilibrium::Equilibrium;
use flexura_model::{CoordinateLaw, Drive, LoadId, Model};
use flexura_spatial::Vector3;

/// What a model's loads and drives are.
#[derive(Clone, Debug, PartialEq)]
struct Numbers {
    parameters: Vec<f64>,
    /// Force and moment of every load.
    loads: Vec<[Vector3<f64>; 2]>,
    /// Of every joint's coordinates: what drives or loads it, and where its stiffness is relaxed.
    drives: Vec<[f64; 2]>,
}

/// The models between two values of the parameter.
pub(crate) struct Line {
    from: f64,
    width: f64,
    ends: [Numbers; 2],
}

/// Numbers that differ by no more than this part of the largest of their kind count as equal.
const EQUAL: f64 = 1e-13;

fn drive_value(law: &CoordinateLaw) -> f64 {
    match law.drive {
        Drive::Free { effort } => effort,
        Drive::Driven { coordinate } => coordinate,
    }
}

fn set_drive(law: &mut CoordinateLaw, [value, rest]: [f64; 2]) {
    match &mut law.drive {
        Drive::Free { effort } => *effort = value,
        Drive::Driven { coordinate } => *coordinate = value,
    }
    law.rest = rest;
}

impl Numbers {
    /// The numbers of a model, and the model without them as text.
    fn of(model: &Model) -> (Self, String) {
        let mut rest = model.clone();
        let numbers = Self {
            parameters: model.parameters.iter().map(|p| p.value).collect(),
            loads: model.loads.iter().map(|load| [load.force, load.moment]).collect(),
            drives: model
                .joints
                .iter()
                .flat_map(|joint| &joint.law.coordinates)
                .map(|law| [drive_value(law), law.rest])
                .collect(),
        };
        rest.parameters.iter_mut().for_each(|p| p.value = 0.0);
        rest.studies.clear();
        for load in &mut rest.loads {
            (load.force, load.moment) = (Vector3::zeros(), Vector3::zeros());
        }
        for law in rest.joints.iter_mut().flat_map(|joint| &mut joint.law.coordinates) {
            set_drive(law, [0.0; 2]);
        }
        (numbers, format!("{rest:?}"))
    }

    fn list(&self) -> impl Iterator<Item = f64> + '_ {
        let loads = self.loads.iter().flatten().flat_map(|v| [v.x, v.y, v.z]);
        self.parameters.iter().copied().chain(loads).chain(self.drives.iter().flatten().copied())
    }
}

impl Line {
    /// The line through models at three values, which must increase; None where they do not lie on one.
    pub fn through(models: [(f64, &Model); 3]) -> Option<Self> {
        let [(a, first), (b, middle), (c, last)] = models;
        let ((first, x), (middle, y), (last, z)) =
            (Numbers::of(first), Numbers::of(middle), Numbers::of(last));
        if x != y || y != z {
            return None;
        }
        let line = Self { from: a, width: c - a, ends: [first, last] };
        let [from, to] = &line.ends;
        let t = (b - a) / (c - a);
        let straight = from
            .list()
            .zip(middle.list())
            .zip(to.list())
            .all(|((u, v), w)| (u + t * (w - u) - v).abs() <= EQUAL * u.abs().max(w.abs()).max(v.abs()));
        straight.then_some(line)
    }

    /// Changes loads and drives of the problem to those at a value; the state stays, but for what is driven.
    pub fn apply(&self, problem: &mut Equilibrium, at: f64) {
        let t = (at - self.from) / self.width;
        let [from, to] = &self.ends;
        let mix = |u: f64, w: f64| if u == w { u } else { u + t * (w - u) };
        for (i, (u, w)) in from.loads.iter().zip(&to.loads).enumerate() {
            if u != w {
                let [force, moment] = [0, 1].map(|k| u[k] + (w[k] - u[k]) * t);
                problem.set_point_load(LoadId(i), force, moment);
            }
        }
        let mut position = 0;
        for joint in 0..problem.model().joints.len() {
            for coordinate in 0..problem.model().joints[joint].law.coordinates.len() {
                let (u, w) = (from.drives[position], to.drives[position]);
                position += 1;
                if u != w {
                    let mut law = problem.model().joints[joint].law.coordinates[coordinate];
                    set_drive(&mut law, [mix(u[0], w[0]), mix(u[1], w[1])]);
                    problem.set_coordinate_law(joint, coordinate, law);
                }
            }
        }
        let values: Vec<f64> = from.parameters.iter().zip(&to.parameters).map(|(u, w)| mix(*u, *w)).collect();
        problem.set_parameter_values(&values);
    }
}
