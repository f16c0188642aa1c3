//! A parameter on which only loads and drives depend, and these linearly: the model need not be made again.
//!
//! The rules of the model say whether that is so (`Family::is_line`); two models give the straight lines.

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
    fn of(model: &Model) -> Self {
        let laws = model.joints.iter().flat_map(|joint| &joint.law.coordinates);
        Self {
            parameters: model.parameters.iter().map(|p| p.value).collect(),
            loads: model.loads.iter().map(|load| [load.force, load.moment]).collect(),
            drives: laws.map(|law| [drive_value(law), law.rest]).collect(),
        }
    }
}

impl Line {
    /// The line through models at two values.
    pub fn through([(a, first), (b, last)]: [(f64, &Model); 2]) -> Self {
        Self { from: a, width: b - a, ends: [Numbers::of(first), Numbers::of(last)] }
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
