//! A model for every value of its parameters.

use flexura_equilibrium::ProblemError;
use flexura_model::Model;

/// Makes the model again with other values of some parameters: position in [`Model::parameters`] and value (SI).
/// Parameters that are not mentioned keep the value that they have in the model at hand.
pub trait Family {
    /// The model with these values.
    ///
    /// # Errors
    /// The values make no sound model: a length that is negative, say.
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError>;

    /// May the model depend on this parameter? Where it does not for certain, nothing has to be tried out.
    fn depends_on(&mut self, _parameter: usize) -> bool {
        true
    }
}

impl<F: FnMut(&[(usize, f64)]) -> Result<Model, ProblemError>> Family for F {
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError> {
        self(values)
    }
}

/// How large a change of a parameter is: its own size, but at least the given part of what its unit has for one in
/// this model: the longest beam for a length, EI/L² for a force. A parameter may be zero, or become so.
pub(crate) fn size_of(model: &Model, parameter: usize, (length, force): (f64, f64), part: f64) -> f64 {
    let parameter = &model.parameters[parameter];
    let one = match parameter.unit.as_str() {
        "m" => length,
        "N" => force,
        "N*m" => force * length,
        "N/m" => force / length,
        "" | "rad" => 1.0,
        _ if parameter.value != 0.0 => 0.0,
        _ => 1.0,
    };
    parameter.value.abs().max(part * one)
}

/// Part of a unit below which the size of a parameter does not matter.
pub(crate) const SMALL: f64 = 1e-3;
