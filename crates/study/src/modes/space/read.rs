//! Outputs along a small motion.

use super::signals::Wanted;
use crate::ProblemError;
use flexura_equilibrium::{CENTRAL, Swing};
use flexura_model::Model;
use flexura_post::{OutputValue, one_output};
use flexura_solution::Solution;
use flexura_spatial::{Pose, Twist, exp};

/// How far the largest motion goes for the differences, rad or lengths of the mechanism.
const STEP: f64 = 2e-3;

/// Reads outputs beside an equilibrium.
pub struct Reader {
    solution: Solution,
}

impl Reader {
    pub fn new(solution: &Solution) -> Self {
        Self { solution: solution.clone() }
    }

    /// Derivatives of outputs along a motion, by central differences of order six of what `post` reads off the moved state.
    pub fn along(
        &self,
        model: &Model,
        swing: &Swing,
        length: f64,
        wanted: &[Wanted],
    ) -> Result<Vec<f64>, ProblemError> {
        let size = |twist: &Twist| twist.angular.norm().max(twist.linear.norm() / length);
        let beams: Vec<Vec<Twist>> = self
            .solution
            .beams
            .iter()
            .enumerate()
            .map(|(i, beam)| beam.samples.iter().map(|sample| swing.beam(i, sample.s)).collect())
            .collect();
        let most = beams.iter().flatten().chain(&swing.bodies).map(size).fold(0.0, f64::max);
        let mut out = vec![0.0; wanted.len()];
        if most == 0.0 {
            return Ok(out);
        }
        let h = STEP / most;
        let mut moved = self.solution.clone();
        for (place, weight) in CENTRAL {
            let by = place * h;
            let shift = |pose: &Pose, twist: &Twist| Pose {
                rotation: exp(&(twist.angular * by)) * pose.rotation,
                position: pose.position + twist.linear * by,
            };
            for ((to, from), twists) in moved.beams.iter_mut().zip(&self.solution.beams).zip(&beams) {
                for ((to, from), twist) in to.samples.iter_mut().zip(&from.samples).zip(twists) {
                    to.pose = shift(&from.pose, twist);
                }
            }
            for ((to, from), twist) in moved.bodies.iter_mut().zip(&self.solution.bodies).zip(&swing.bodies) {
                *to = shift(from, twist);
            }
            for (out, wanted) in out.iter_mut().zip(wanted) {
                let output = &model.outputs[wanted.output];
                let value = one_output(model, &moved, output).map_err(|error| {
                    ProblemError::new(format!("output.{}", output.name), error.to_string(), "leave it out")
                })?;
                *out += weight / h
                    * match value.value {
                        OutputValue::Number(value) => value,
                        OutputValue::Vector(vector) => vector[wanted.component],
                    };
            }
        }
        Ok(out)
    }
}
