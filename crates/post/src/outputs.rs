//! The outputs that a model asks for.

use crate::{BeamStress, PostError};
use flexura_model::{At, BeamId, Model, Output, Probe, ProbeTarget, Quantity};
use flexura_solution::Solution;
use flexura_spatial::{Pose, Vector3, log};

/// The value of an output, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutputValue {
    /// One number.
    Number(f64),
    /// Three components.
    Vector([f64; 3]),
}

/// An output with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputResult {
    /// Its name.
    pub name: String,
    /// SI unit as text, "" for a plain number.
    pub unit: String,
    /// Its value.
    pub value: OutputValue,
    /// It is nothing but a strain or a stretch, and a person wants to read it in µε.
    pub is_strain: bool,
}

/// Evaluates the model's outputs. `stress` runs parallel to the model's beams.
///
/// # Errors
/// [`PostError`], see there; a NaN never gets through.
pub fn evaluate_outputs(
    model: &Model,
    solution: &Solution,
    stress: &[Option<BeamStress>],
) -> Result<Vec<OutputResult>, PostError> {
    model.outputs.iter().map(|output| evaluate(output, model, solution, stress)).collect()
}

fn evaluate(
    output: &Output,
    model: &Model,
    solution: &Solution,
    stress: &[Option<BeamStress>],
) -> Result<OutputResult, PostError> {
    let reader = Reader { output: &output.name, model, solution, stress };
    let slots: Vec<f64> = output.probes.iter().map(|probe| reader.read(probe)).collect::<Result<_, _>>()?;
    let mut values = Vec::with_capacity(3);
    for formula in &output.formulas {
        let value = formula.evaluate(&slots);
        if !value.is_finite() {
            return Err(PostError::NotFinite { output: output.name.clone(), value });
        }
        values.push(value);
    }
    let value = match values[..] {
        [number] => OutputValue::Number(number),
        [x, y, z] => OutputValue::Vector([x, y, z]),
        _ => return Err(reader.no_such_quantity("a formula of that many components")),
    };
    let is_strain =
        matches!(output.probes[..], [Probe { quantity: Quantity::Strain | Quantity::Stretch, .. }])
            && value == OutputValue::Number(slots[0]);
    Ok(OutputResult { name: output.name.clone(), unit: output.unit.clone(), value, is_strain })
}

/// Reads probes on behalf of one output, which the messages name.
struct Reader<'a> {
    output: &'a str,
    model: &'a Model,
    solution: &'a Solution,
    stress: &'a [Option<BeamStress>],
}

impl Reader<'_> {
    fn read(&self, probe: &Probe) -> Result<f64, PostError> {
        let component = probe.component;
        match probe.target {
            ProbeTarget::Beam(beam, at) => self.read_beam(beam, at, probe.quantity, component),
            ProbeTarget::Body(body) => {
                let pose = self.solution.bodies.get(body.0).ok_or_else(|| self.no_such_quantity("a body"))?;
                pose_component(pose, probe.quantity, component).ok_or_else(|| self.no_such_quantity("a body"))
            }
            ProbeTarget::Joint(joint) => {
                let result = self.solution.joints.get(joint.0);
                let value = result.and_then(|joint| match probe.quantity {
                    Quantity::Coordinate => joint.coordinates.get(component).copied(),
                    Quantity::Effort => joint.efforts.get(component).copied(),
                    Quantity::Force => joint.wrench.force.get(component).copied(),
                    Quantity::Moment => joint.wrench.moment.get(component).copied(),
                    _ => None,
                });
                value.ok_or_else(|| self.no_such_quantity("a joint"))
            }
            ProbeTarget::Spring(spring) => {
                let result = self.solution.springs.get(spring.0);
                let value = result.and_then(|spring| match probe.quantity {
                    Quantity::Length => Some(spring.length),
                    Quantity::Tension => Some(spring.tension),
                    _ => None,
                });
                value.ok_or_else(|| self.no_such_quantity("a spring"))
            }
            ProbeTarget::Cable(cable) => {
                let result = self.solution.cables.get(cable.0);
                let value = result.and_then(|cable| match probe.quantity {
                    Quantity::Length => Some(cable.length),
                    Quantity::Tension => Some(cable.tension),
                    _ => None,
                });
                value.ok_or_else(|| self.no_such_quantity("a cable"))
            }
            ProbeTarget::Model => match probe.quantity {
                Quantity::Energy => Ok(self.solution.energy),
                _ => Err(self.no_such_quantity("the whole mechanism")),
            },
        }
    }

    fn read_beam(&self, id: BeamId, at: At, quantity: Quantity, component: usize) -> Result<f64, PostError> {
        let missing = || self.no_such_quantity("a beam");
        let result = self.solution.beams.get(id.0).ok_or_else(missing)?;
        let index = self.sample(id, at)?;
        let sample = &result.samples[index];
        let stress = || {
            let stress = self.stress.get(id.0).and_then(|stress| stress.as_ref());
            stress.map(|stress| stress.samples[index]).ok_or_else(|| PostError::NoStress {
                output: self.output.to_owned(),
                beam: self.model[id].name.clone(),
            })
        };
        let vector = match quantity {
            Quantity::Stretch => return Ok(sample.strain.x),
            Quantity::Strain => return Ok(stress()?.strain),
            Quantity::Stress => return Ok(stress()?.von_mises),
            Quantity::Tangent => sample.pose.rotation * Vector3::x(),
            Quantity::Force => sample.wrench.force,
            Quantity::Moment => sample.wrench.moment,
            Quantity::Curvature => sample.curvature,
            _ => return pose_component(&sample.pose, quantity, component).ok_or_else(missing),
        };
        vector.get(component).copied().ok_or_else(missing)
    }

    /// The sample at a place, which the solver has put there because an output asks for it.
    fn sample(&self, id: BeamId, at: At) -> Result<usize, PostError> {
        let result = &self.solution.beams[id.0];
        let s = at.arc_length(result.length);
        let after = result.samples.partition_point(|sample| sample.s < s);
        let near = |&index: &usize| {
            result.samples.get(index).is_some_and(|sample| (sample.s - s).abs() <= 1e-9 * result.length)
        };
        [after, after.wrapping_sub(1)].into_iter().find(near).ok_or_else(|| PostError::NoSample {
            output: self.output.to_owned(),
            beam: self.model[id].name.clone(),
            s,
        })
    }

    fn no_such_quantity(&self, target: &'static str) -> PostError {
        PostError::NoSuchQuantity { output: self.output.to_owned(), target }
    }
}

fn pose_component(pose: &Pose, quantity: Quantity, component: usize) -> Option<f64> {
    match quantity {
        Quantity::Position => pose.position.get(component).copied(),
        Quantity::Rotation => log(&pose.rotation).get(component).copied(),
        _ => None,
    }
}
