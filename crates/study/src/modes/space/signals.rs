//! Names of inputs and outputs.

use crate::ProblemError;
use flexura_equilibrium::{Equilibrium, Vibration};
use flexura_model::{Model, Output, ProbeTarget, Quantity};
use flexura_solution::Signal;
use flexura_spatial::{Vector3, Wrench};

const AXES: [&str; 3] = ["x", "y", "z"];

/// What drives the mechanism.
#[derive(Clone, Debug)]
pub struct Input {
    pub signal: Signal,
    source: Source,
}

#[derive(Clone, Debug)]
enum Source {
    /// A load's place, and a wrench per unit of the input.
    Load(usize, Wrench),
    /// Acceleration of the ground along an axis.
    Ground(usize),
}

impl Input {
    /// What a unit of it does on the unknowns of the pencil.
    pub fn drive(&self, problem: &Equilibrium, vibration: &Vibration) -> Vec<f64> {
        match &self.source {
            Source::Load(load, wrench) => problem.drive_by_load(vibration, *load, wrench),
            Source::Ground(axis) => problem.drive_by_ground(vibration, *axis),
        }
    }
}

/// How an output is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Its change.
    Change,
    Velocity,
    Acceleration,
}

/// A number that comes out.
#[derive(Clone, Debug)]
pub struct Wanted {
    pub signal: Signal,
    pub output: usize,
    pub component: usize,
    pub measure: Measure,
}

fn named(name: String, unit: &str) -> Signal {
    Signal { name, unit: unit.to_string() }
}

fn wrong(message: String, hint: impl Into<String>) -> ProblemError {
    ProblemError::new("study", message, hint)
}

fn ground(axis: usize) -> Input {
    Input {
        signal: named(format!("ground.acceleration.{}", AXES[axis]), "m/s^2"),
        source: Source::Ground(axis),
    }
}

fn component(model: &Model, load: usize, is_moment: bool, axis: usize) -> Input {
    let mut unit = Vector3::zeros();
    unit[axis] = 1.0;
    let (wrench, word, si) = if is_moment {
        (Wrench::new(Vector3::zeros(), unit), "moment", "N*m")
    } else {
        (Wrench::new(unit, Vector3::zeros()), "force", "N")
    };
    let name = format!("load.{}.{word}.{}", model.loads[load].name, AXES[axis]);
    Input { signal: named(name, si), source: Source::Load(load, wrench) }
}

/// The inputs by their names.
pub fn inputs(model: &Model, names: &[String]) -> Result<Vec<Input>, ProblemError> {
    if names.is_empty() {
        let mut all = Vec::new();
        for (i, load) in model.loads.iter().enumerate() {
            let forces = (0..3).filter(|axis| load.force[*axis] != 0.0).map(|axis| (false, axis));
            let moments = (0..3).filter(|axis| load.moment[*axis] != 0.0).map(|axis| (true, axis));
            all.extend(forces.chain(moments).map(|(is_moment, axis)| component(model, i, is_moment, axis)));
        }
        return Ok(if all.is_empty() { (0..3).map(ground).collect() } else { all });
    }
    names.iter().map(|name| input(model, name)).collect()
}

fn input(model: &Model, name: &str) -> Result<Input, ProblemError> {
    let unknown = || {
        let loads: Vec<String> =
            model.loads.iter().map(|load| format!("`load.{}.force.x`", load.name)).collect();
        let first = loads.first().map_or(String::new(), |load| format!("{load} or "));
        wrong(format!("has no input `{name}`"), format!("write {first}`ground.acceleration.x`"))
    };
    let parts: Vec<&str> = name.split('.').collect();
    let axis = |letter: &str| AXES.iter().position(|axis| *axis == letter).ok_or_else(unknown);
    let load = |name: &str| model.loads.iter().position(|load| load.name == name).ok_or_else(unknown);
    match parts[..] {
        ["ground", "acceleration", letter] => Ok(ground(axis(letter)?)),
        ["load", name, "force", letter] => Ok(component(model, load(name)?, false, axis(letter)?)),
        ["load", name, "moment", letter] => Ok(component(model, load(name)?, true, axis(letter)?)),
        // In proportion: 1 is the load as it stands in the file.
        ["load", own] => {
            let load = load(own)?;
            let wrench = Wrench::new(model.loads[load].force, model.loads[load].moment);
            if wrench.force.norm() + wrench.moment.norm() == 0.0 {
                return Err(wrong(
                    format!("has an input `{name}` that does nothing: the load is zero"),
                    format!("name a component: `{name}.force.x`"),
                ));
            }
            Ok(Input { signal: named(name.to_string(), ""), source: Source::Load(load, wrench) })
        }
        _ => Err(unknown()),
    }
}

/// Why an output cannot be followed through small motions; None where it can.
fn unreadable(output: &Output) -> Option<String> {
    let readable = |target: ProbeTarget, quantity: Quantity| {
        let carried = matches!(target, ProbeTarget::Beam(..) | ProbeTarget::Body(_));
        let motion = matches!(
            quantity,
            Quantity::Position
                | Quantity::Rotation
                | Quantity::Tangent
                | Quantity::Displacement
                | Quantity::Turning
        );
        carried && motion || quantity == Quantity::Mass
    };
    let is_still = !output.probes.iter().any(|probe| probe.quantity != Quantity::Mass);
    if is_still {
        return Some("does not move".to_string());
    }
    let fine = output.probes.iter().all(|probe| readable(probe.target, probe.quantity));
    (!fine).then(|| "depends on more than positions and rotations of beams and bodies".to_string())
}

/// The outputs by their names; without names all that can be followed, and a warning of the others.
pub fn outputs(
    model: &Model,
    names: &[String],
    warnings: &mut Vec<String>,
) -> Result<Vec<Wanted>, ProblemError> {
    let mut all = Vec::new();
    if names.is_empty() {
        for (i, output) in model.outputs.iter().enumerate() {
            match unreadable(output) {
                Some(why) => {
                    warnings.push(format!("the state space leaves out `{}`, which {why}", output.name))
                }
                None => all.extend(components(output, i, None, Measure::Change)),
            }
        }
    }
    for name in names {
        let mut parts: Vec<&str> = name.split('.').collect();
        let measure = match parts.last() {
            Some(&"velocity") => Measure::Velocity,
            Some(&"acceleration") => Measure::Acceleration,
            _ => Measure::Change,
        };
        if measure != Measure::Change {
            parts.pop();
        }
        let axis = parts.get(1).map(|letter| AXES.iter().position(|axis| axis == letter));
        let found = model.outputs.iter().position(|output| parts.first() == Some(&output.name.as_str()));
        let (Some(i), false, false) = (found, axis == Some(None), parts.len() > 2) else {
            let known: Vec<String> =
                model.outputs.iter().map(|output| format!("`{}`", output.name)).collect();
            return Err(wrong(
                format!("has no output `{name}`"),
                format!("outputs are {}; `.velocity` and `.acceleration` may follow", known.join(", ")),
            ));
        };
        let output = &model.outputs[i];
        if let Some(why) = unreadable(output) {
            return Err(wrong(format!("cannot follow `{}`, which {why}", output.name), "leave it out"));
        }
        if axis.is_some() && output.formulas.len() == 1 {
            return Err(wrong(format!("has no output `{name}`"), format!("`{}` is a number", output.name)));
        }
        all.extend(components(output, i, axis.flatten(), measure));
    }
    if all.is_empty() {
        return Err(wrong(
            "has nothing to put out: no output reads a position or rotation".to_string(),
            "write one under [output], like tip = \"beam.NAME.end.position\"",
        ));
    }
    Ok(all)
}

fn components(output: &Output, position: usize, only: Option<usize>, measure: Measure) -> Vec<Wanted> {
    let (suffix, per) = match measure {
        Measure::Change => ("", ""),
        Measure::Velocity => (".velocity", "/s"),
        Measure::Acceleration => (".acceleration", "/s^2"),
    };
    let unit = if output.unit.is_empty() && !per.is_empty() { "1" } else { output.unit.as_str() };
    let unit = format!("{unit}{per}");
    let is_vector = output.formulas.len() > 1;
    let each = (0..output.formulas.len()).filter(|k| only.is_none_or(|only| only == *k)).map(|component| {
        let letter = if is_vector { format!(".{}", AXES[component]) } else { String::new() };
        let signal = named(format!("{}{letter}{suffix}", output.name), &unit);
        Wanted { signal, output: position, component, measure }
    });
    each.collect()
}
