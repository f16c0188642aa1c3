//! The outputs that a model asks for.

use crate::place::place_name;
use crate::screw::{center_of_compliance, finite_screw, instantaneous_screw};
use crate::whole::{beam_mass, beam_peak, model_mass};
use crate::{BeamStress, PostError};
use flexura_model::{
    At, BeamId, BodyId, Drive, JointLaw, Model, Mount, Output, Probe, ProbeTarget, Quantity,
};
use flexura_solution::{ContactSolution, Rates, Solution, TangentSolution};
use flexura_spatial::{Matrix6, Pose, Vector3, log};

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

pub(crate) fn evaluate(
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
            let is_blocked =
                |(probe, slot): (&Probe, &f64)| probe.quantity == Quantity::Compliance && *slot == 0.0;
            if let Some(error) = output.probes.iter().zip(&slots).find(|pair| is_blocked(*pair)) {
                return Err(reader.blocked(error.0));
            }
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

fn of_contact(contact: &ContactSolution, quantity: Quantity, component: usize) -> Option<f64> {
    match quantity {
        Quantity::ContactPoint => contact.point.get(component).copied(),
        Quantity::ContactNormal => contact.normal.get(component).copied(),
        Quantity::ContactForce => Some(contact.force),
        Quantity::ContactFriction => contact.friction.get(component).copied(),
        Quantity::ContactOnChild => contact.points[0].get(component).copied(),
        Quantity::ContactOnParent => contact.points[1].get(component).copied(),
        Quantity::ContactParameter => contact.parameters.as_flattened().get(component).copied(),
        // A straight boundary has no radius that could be written down.
        Quantity::ContactRadius => contact.radii.get(component).map(|radius| radius.unwrap_or(f64::INFINITY)),
        Quantity::ContactTravel => contact.travel.get(component).copied(),
        Quantity::ContactRate => contact.rates.get(component).copied(),
        _ => None,
    }
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
            ProbeTarget::Body(body) => self.read_body(body, probe.quantity, component),
            ProbeTarget::Joint(joint) => {
                let result = self.solution.joints.get(joint.0);
                if let Quantity::Velocity | Quantity::Acceleration = probe.quantity {
                    let motion = self.rates()?.joints.get(joint.0);
                    let values = motion.map(|motion| match probe.quantity {
                        Quantity::Velocity => &motion.velocities,
                        _ => &motion.accelerations,
                    });
                    let value = values.and_then(|values| values.get(component)).copied();
                    return value.ok_or_else(|| self.no_such_quantity("a joint"));
                }
                let value = result.and_then(|joint| match probe.quantity {
                    Quantity::Coordinate => joint.coordinates.get(component).copied(),
                    Quantity::Effort => joint.efforts.get(component).copied(),
                    Quantity::Force => joint.wrench.force.get(component).copied(),
                    Quantity::Moment => joint.wrench.moment.get(component).copied(),
                    quantity => joint.contact.and_then(|contact| of_contact(&contact, quantity, component)),
                });
                value.ok_or_else(|| self.no_such_quantity("a joint"))
            }
            ProbeTarget::Spring(spring) => {
                let result = self.solution.springs.get(spring.0);
                let value = result.and_then(|spring| match probe.quantity {
                    Quantity::Length => Some(spring.length),
                    Quantity::Tension => Some(spring.tension),
                    // Of a spring of rest length zero there is none, which is told as any other number that is not finite.
                    Quantity::Strain => Some(spring.strain.unwrap_or(f64::NAN)),
                    Quantity::Stress => spring.stress,
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
            ProbeTarget::Tubes(tubes) => {
                let tip = self.solution.tubes.get(tubes.0).and_then(|tubes| tubes.samples.last());
                let value = tip.and_then(|tip| match probe.quantity {
                    Quantity::Tangent => (tip.pose.rotation * Vector3::x()).get(component).copied(),
                    quantity => pose_component(&tip.pose, quantity, component),
                });
                value.ok_or_else(|| self.no_such_quantity("the tip of concentric tubes"))
            }
            ProbeTarget::Model => match probe.quantity {
                Quantity::Energy => Ok(self.solution.energy),
                Quantity::Mass => model_mass(self.model, self.solution)
                    .ok_or_else(|| self.no_such_quantity("the whole mechanism")),
                Quantity::Parameter => {
                    let parameter = self.model.parameters.get(component);
                    parameter
                        .map(|parameter| parameter.value)
                        .ok_or_else(|| self.no_such_quantity("the mechanism"))
                }
                _ => Err(self.no_such_quantity("the whole mechanism")),
            },
        }
    }

    fn read_body(&self, body: BodyId, quantity: Quantity, component: usize) -> Result<f64, PostError> {
        let missing = || self.no_such_quantity("a body");
        let pose = self.solution.bodies.get(body.0).ok_or_else(missing)?;
        let initial = &self.model.bodies.get(body.0).ok_or_else(missing)?.pose;
        let no_turning =
            || PostError::NoTurning { output: self.output.to_owned(), body: self.model[body].name.clone() };
        let target = ProbeTarget::Body(body);
        let screw = match quantity {
            Quantity::ScrewAngle => return Ok(moved(initial, pose, Quantity::Turning).norm()),
            Quantity::ScrewAxis | Quantity::ScrewPoint | Quantity::ScrewPitch => finite_screw(initial, pose),
            Quantity::MotionAxis | Quantity::MotionPoint | Quantity::MotionPitch => {
                instantaneous_screw(&pose.position, &self.tangent(target)?.motion)
            }
            Quantity::Displacement | Quantity::Turning => {
                return moved(initial, pose, quantity).get(component).copied().ok_or_else(missing);
            }
            Quantity::Compliance | Quantity::Stiffness | Quantity::CenterOfCompliance => {
                return self.read_compliance(target, &pose.position, quantity, component);
            }
            Quantity::Velocity
            | Quantity::AngularVelocity
            | Quantity::Acceleration
            | Quantity::AngularAcceleration => {
                let motion = self.rates()?.bodies.get(body.0).ok_or_else(missing)?;
                let vector = match quantity {
                    Quantity::Velocity => motion.velocity.linear,
                    Quantity::AngularVelocity => motion.velocity.angular,
                    Quantity::Acceleration => motion.acceleration.linear,
                    _ => motion.acceleration.angular,
                };
                return vector.get(component).copied().ok_or_else(missing);
            }
            _ => return pose_component(pose, quantity, component).ok_or_else(missing),
        };
        let screw = screw.ok_or_else(no_turning)?;
        match quantity {
            Quantity::ScrewAxis | Quantity::MotionAxis => {
                screw.axis.get(component).copied().ok_or_else(missing)
            }
            Quantity::ScrewPoint | Quantity::MotionPoint => {
                screw.point.get(component).copied().ok_or_else(missing)
            }
            _ => Ok(screw.pitch),
        }
    }

    /// A compliance that is zero, by which something was divided.
    fn blocked(&self, probe: &Probe) -> PostError {
        let mounted = |mount: Mount| match (probe.target, mount) {
            (ProbeTarget::Body(body), Mount::Body(other)) => body == other,
            (ProbeTarget::Beam(beam, _), Mount::Beam(point)) => beam == point.beam,
            _ => false,
        };
        let drives =
            |law: &JointLaw| law.coordinates.iter().any(|law| matches!(law.drive, Drive::Driven { .. }));
        let driver = self
            .model
            .joints
            .iter()
            .find(|joint| drives(&joint.law) && (mounted(joint.child) || mounted(joint.parent.mount)));
        PostError::Blocked {
            output: self.output.to_owned(),
            motion: ["x", "y", "z", "rx", "ry", "rz"][(probe.component / 6).min(5)],
            place: place_name(self.model, &probe.target),
            why: match driver {
                Some(joint) => format!("joint.{} drives it", joint.name),
                None => "it is held".to_owned(),
            },
        }
    }

    fn rates(&self) -> Result<&Rates, PostError> {
        self.solution.rates.as_deref().ok_or_else(|| PostError::NoMotion { output: self.output.to_owned() })
    }

    fn tangent(&self, target: ProbeTarget) -> Result<&TangentSolution, PostError> {
        self.solution.tangents.iter().find(|tangent| tangent.target == target).ok_or_else(|| {
            PostError::NoCompliance {
                output: self.output.to_owned(),
                why: "there is no tangent here: the solve did not converge, or ended at a fold or branch point",
            }
        })
    }

    fn read_compliance(
        &self,
        target: ProbeTarget,
        position: &Vector3<f64>,
        quantity: Quantity,
        component: usize,
    ) -> Result<f64, PostError> {
        let none = |why| PostError::NoCompliance { output: self.output.to_owned(), why };
        let compliance =
            self.tangent(target)?.compliance.as_ref().ok_or_else(|| none("it has no compliance"))?;
        match quantity {
            Quantity::CenterOfCompliance => {
                let centre = center_of_compliance(compliance)
                    .ok_or_else(|| none("nothing turns there, so there is no centre of compliance"))?;
                Ok((position + centre)[component.min(2)])
            }
            Quantity::Compliance => Ok(compliance[(component / 6, component % 6)]),
            _ => {
                let stiffness = stiffness(compliance).ok_or_else(|| {
                    none("a motion is blocked altogether there, so its stiffness is infinite")
                })?;
                Ok(stiffness[(component / 6, component % 6)])
            }
        }
    }

    fn read_beam(&self, id: BeamId, at: At, quantity: Quantity, component: usize) -> Result<f64, PostError> {
        let missing = || self.no_such_quantity("a beam");
        let result = self.solution.beams.get(id.0).ok_or_else(missing)?;
        if quantity == Quantity::Mass {
            return beam_mass(self.model, &self.model[id], result.length).ok_or_else(missing);
        }
        if quantity.is_peak() {
            return self.peak(id, quantity);
        }
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
            Quantity::Foundation => sample.foundation,
            Quantity::FoundationForce => result.foundation_force,
            Quantity::Displacement | Quantity::Turning => moved(&sample.rest_pose, &sample.pose, quantity),
            Quantity::Compliance | Quantity::Stiffness | Quantity::CenterOfCompliance => {
                let position = sample.pose.position;
                return self.read_compliance(ProbeTarget::Beam(id, at), &position, quantity, component);
            }
            _ => return pose_component(&sample.pose, quantity, component).ok_or_else(missing),
        };
        vector.get(component).copied().ok_or_else(missing)
    }

    fn peak(&self, id: BeamId, quantity: Quantity) -> Result<f64, PostError> {
        let beam = &self.model[id];
        let stress = self.stress.get(id.0).and_then(|stress| stress.as_ref());
        let stress = stress
            .ok_or_else(|| PostError::NoStress { output: self.output.to_owned(), beam: beam.name.clone() })?;
        let samples = &self.solution.beams[id.0].samples;
        beam_peak(self.model, beam, samples, stress, quantity)
            .ok_or_else(|| PostError::NoStrength { output: self.output.to_owned(), beam: beam.name.clone() })
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

/// Shift of the origin, or rotation vector of the turning, from one pose to another.
fn moved(from: &Pose, to: &Pose, quantity: Quantity) -> Vector3<f64> {
    match quantity {
        Quantity::Displacement => to.position - from.position,
        _ => log(&(to.rotation * from.rotation.inverse())),
    }
}

/// The inverse of a compliance, by way of rows and columns of like size: metres and radians differ by orders. None where
/// a motion is blocked.
fn stiffness(compliance: &Matrix6<f64>) -> Option<Matrix6<f64>> {
    let size = compliance.diagonal().map(|c| c.abs().sqrt());
    if size.min() <= 1e-12 * size.fixed_rows::<3>(0).amax().min(size.fixed_rows::<3>(3).amax()) {
        return None;
    }
    let scaled = Matrix6::from_fn(|i, j| compliance[(i, j)] / (size[i] * size[j]));
    let inverse = scaled.try_inverse()?;
    Some(Matrix6::from_fn(|i, j| inverse[(i, j)] / (size[i] * size[j])))
}

fn pose_component(pose: &Pose, quantity: Quantity, component: usize) -> Option<f64> {
    match quantity {
        Quantity::Position => pose.position.get(component).copied(),
        Quantity::Rotation => log(&pose.rotation).get(component).copied(),
        _ => None,
    }
}
