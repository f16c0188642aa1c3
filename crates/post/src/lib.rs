//! What a solution means: stresses, strains, safety, and the outputs that the user asked for.
//!
//! Everything here is computed from a [`Model`] and a [`Solution`] alone; no solver is involved. Strain
//! energy is not computed but taken over from the solution, which integrates it with the beam.

mod dependence;
mod outputs;
mod place;
mod screw;
mod strain;
mod stress;
mod summary;
mod whole;

pub use dependence::{Dependence, dependences};
pub use flexura_geometry::SectionStress;
pub use outputs::{OutputResult, OutputValue, evaluate_outputs};
pub use place::place_name;
pub use screw::{Screw, center_of_compliance, finite_screw, instantaneous_screw};
pub use strain::large_strain;
pub use stress::{BeamPeaks, BeamStress, Peak, beam_stress};
pub use summary::{
    BeamSummary, BodySummary, CoordinateSummary, JointSummary, OutputSummary, Scales, Summary, TubesSummary,
    summarise,
};

pub use whole::{beam_mass, beam_peak, model_mass, peak_between};

use flexura_model::{Model, Output, ProbeTarget, Quantity};
use flexura_solution::Solution;

/// Everything that is derived from a solution, in the order of the model's lists.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// One for each beam; None where the section is given as a stiffness and has no outer fibre.
    pub beams: Vec<Option<BeamStress>>,
    /// One for each output that has a value.
    pub outputs: Vec<OutputResult>,
    /// One for each output that has none, which says why.
    pub without_value: Vec<PostError>,
}

/// The outputs of a path's point or of a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values {
    /// For each output its components (one or three), SI; None where it has no value.
    pub outputs: Vec<Option<Vec<f64>>>,
    /// Outputs without a value, by their positions, and why.
    pub reasons: Vec<(usize, String)>,
}

/// [`each_output`] as numbers alone.
pub fn output_values(model: &Model, solution: &Solution) -> Values {
    let mut values = Values::default();
    for (position, result) in each_output(model, solution).into_iter().enumerate() {
        values.outputs.push(match result.map(|result| result.value) {
            Ok(OutputValue::Number(number)) => Some(vec![number]),
            Ok(OutputValue::Vector(vector)) => Some(vector.to_vec()),
            Err(error) => {
                values.reasons.push((position, error.to_string()));
                None
            }
        });
    }
    values
}

/// The outputs of a solution alone; stresses only where an output asks for them.
///
/// # Errors
/// As [`evaluate`].
pub fn outputs(model: &Model, solution: &Solution) -> Result<Vec<OutputResult>, PostError> {
    outputs_of(model, solution, model.outputs.iter()).into_iter().collect()
}

/// [`outputs`], each for itself: one without a value does not take the others along.
pub fn each_output(model: &Model, solution: &Solution) -> Vec<Result<OutputResult, PostError>> {
    outputs_of(model, solution, model.outputs.iter())
}

/// An output that is not one of the model's.
///
/// # Errors
/// As [`evaluate`].
pub fn one_output(model: &Model, solution: &Solution, output: &Output) -> Result<OutputResult, PostError> {
    let mut results = outputs_of(model, solution, std::iter::once(output));
    results.pop().unwrap_or(Err(PostError::NotFinite { output: output.name.clone(), value: f64::NAN }))
}

/// The values of the targets' expressions.
///
/// # Errors
/// As [`evaluate`].
pub fn targets(model: &Model, solution: &Solution) -> Result<Vec<f64>, PostError> {
    let results = outputs_of(model, solution, model.targets.iter().map(|target| &target.output));
    results
        .into_iter()
        .map(|result| {
            Ok(match result?.value {
                OutputValue::Number(value) => value,
                OutputValue::Vector(vector) => vector[0],
            })
        })
        .collect()
}

fn outputs_of<'a>(
    model: &'a Model,
    solution: &Solution,
    outputs: impl Iterator<Item = &'a Output> + Clone,
) -> Vec<Result<OutputResult, PostError>> {
    let stressed = |beam: usize| {
        outputs.clone().flat_map(|output| &output.probes).any(|probe| {
            matches!(probe.target, ProbeTarget::Beam(id, _) if id.0 == beam)
                && (matches!(probe.quantity, Quantity::Stress | Quantity::Strain) || probe.quantity.is_peak())
        })
    };
    let beams = model.beams.iter().zip(&solution.beams).enumerate();
    let stress: Vec<_> = beams
        .map(|(i, (beam, result))| if stressed(i) { beam_stress(model, beam, result) } else { None })
        .collect();
    outputs.map(|output| outputs::evaluate(output, model, solution, &stress)).collect()
}

/// Stresses, strains and outputs of a solution.
///
/// # Errors
/// [`PostError`] where an output asks for something that is not there or comes out as no finite number.
pub fn evaluate(model: &Model, solution: &Solution) -> Result<Evaluation, PostError> {
    let mut evaluation = evaluate_each(model, solution);
    if evaluation.without_value.is_empty() {
        Ok(evaluation)
    } else {
        Err(evaluation.without_value.swap_remove(0))
    }
}

/// [`evaluate`] of each output for itself: one without a value does not take the others along.
pub fn evaluate_each(model: &Model, solution: &Solution) -> Evaluation {
    let beams: Vec<_> = model
        .beams
        .iter()
        .zip(&solution.beams)
        .map(|(beam, result)| beam_stress(model, beam, result))
        .collect();
    let mut evaluation = Evaluation { beams, outputs: Vec::new(), without_value: Vec::new() };
    for output in &model.outputs {
        match outputs::evaluate(output, model, solution, &evaluation.beams) {
            Ok(result) => evaluation.outputs.push(result),
            Err(error) => evaluation.without_value.push(error),
        }
    }
    evaluation
}

/// An output that has no value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PostError {
    /// A formula gave NaN or an infinity.
    #[error(
        "output `{output}` is {value}, not a finite number (a division by zero, or the root of a negative number?)"
    )]
    NotFinite {
        /// Name of the output.
        output: String,
        /// What came out.
        value: f64,
    },
    /// A division by the compliance of a motion that nothing gives way to.
    #[error(
        "output `{output}` divides by the compliance of {place} along {motion}, which is zero: {why}; a stiffness under a drive is \
         the derivative of its effort, which `--sensitivity` gives"
    )]
    Blocked {
        /// Name of the output.
        output: String,
        /// Where.
        place: String,
        /// The motion: x, y, z, rx, ry or rz.
        motion: &'static str,
        /// Why it is blocked.
        why: String,
    },
    /// Stress or strain of a section that has no shape.
    #[error(
        "output `{output}` asks for stress or strain in beam `{beam}`, whose section is given as a stiffness and has no outer fibre"
    )]
    NoStress {
        /// Name of the output.
        output: String,
        /// Name of the beam.
        beam: String,
    },
    /// Safety of a beam whose material has no yield strength.
    #[error("output `{output}` asks for the safety of beam `{beam}`, whose material has no `yield_strength`")]
    NoStrength {
        /// Name of the output.
        output: String,
        /// Name of the beam.
        beam: String,
    },
    /// The solution holds no sample where an output looks.
    #[error("output `{output}` looks at s = {s} m of beam `{beam}`, where the solution has no sample")]
    NoSample {
        /// Name of the output.
        output: String,
        /// Name of the beam.
        beam: String,
        /// Arc length, m.
        s: f64,
    },
    /// A screw axis of a body that does not turn.
    #[error(
        "output `{output}` asks for the screw axis of body `{body}`, which only shifts and does not turn"
    )]
    NoTurning {
        /// Name of the output.
        output: String,
        /// Name of the body.
        body: String,
    },
    /// A compliance that the solution does not hold, or a stiffness where something does not give way at all.
    #[error("output `{output}`: {why}")]
    NoCompliance {
        /// Name of the output.
        output: String,
        /// Why there is none.
        why: &'static str,
    },
    /// A velocity or acceleration where nothing moves in time.
    #[error(
        "output `{output}` asks for a velocity or acceleration, which only a study of the kind `inverse_dynamics` knows"
    )]
    NoMotion {
        /// Name of the output.
        output: String,
    },
    /// A quantity that its target does not have.
    #[error("output `{output}` asks for a quantity that {target} does not have")]
    NoSuchQuantity {
        /// Name of the output.
        output: String,
        /// What it looks at.
        target: &'static str,
    },
}

impl PostError {
    /// Name of the output.
    pub fn output(&self) -> &str {
        match self {
            PostError::NotFinite { output, .. }
            | PostError::Blocked { output, .. }
            | PostError::NoStress { output, .. }
            | PostError::NoStrength { output, .. }
            | PostError::NoSample { output, .. }
            | PostError::NoTurning { output, .. }
            | PostError::NoCompliance { output, .. }
            | PostError::NoMotion { output }
            | PostError::NoSuchQuantity { output, .. } => output,
        }
    }
}
