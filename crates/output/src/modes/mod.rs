//! What is written of vibration: document and table.

mod along;
mod wire;

pub use along::{
    FrequenciesDocument, FrequencyBranch, FrequencyDocument, FrequencyPoint, OnsetDocument, frequencies_csv,
    frequencies_document,
};
pub use wire::{ModesDocument, VibrationDocument};

use crate::document::{
    all_finite, error_estimate, finite, output_reasons, outputs, parameters, residual, state_document, work,
};
use crate::scene::scene;
use crate::trace::{cell, inside, line, shape_document};
use crate::{Named, OutputError};
use flexura_model::Model;
use flexura_post::Evaluation;
use flexura_solution::{Mode, Modes};

/// The result document of vibration.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn modes_document(
    model: &Model,
    modes: &Modes,
    evaluation: &Evaluation,
) -> Result<ModesDocument, OutputError> {
    let solution = &modes.solution;
    let list = modes.modes.iter().enumerate();
    let list = list
        .map(|(i, mode)| mode_document(model, mode).map_err(|error| inside(&format!("modes[{i}]"), error)));
    Ok(ModesDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.name.clone(),
        study: "modes".to_owned(),
        status: solution.status.word().to_owned(),
        reason: solution.reason.clone(),
        warnings: solution.warnings.clone(),
        at_rest: modes.at_rest,
        modes: list.collect::<Result<_, _>>()?,
        moving_mass: all_finite(modes.mass, || "moving_mass".into())?,
        moving_inertia: all_finite(modes.inertia, || "moving_inertia".into())?,
        elements: modes.elements[0],
        order: modes.elements[1],
        residual: residual(solution)?,
        error_estimate: error_estimate(solution)?,
        parameters: parameters(model)?,
        outputs: outputs(model, evaluation)?,
        output_reasons: output_reasons(evaluation),
        state: state_document(model, solution, evaluation)?,
        stable: solution.stable,
        unstable_directions: solution.unstable_directions,
        stability_reason: solution.stability_reason.clone(),
        work: work(&solution.work),
        scene: scene(model, solution)?,
    })
}

fn mode_document(model: &Model, mode: &Mode) -> Result<VibrationDocument, OutputError> {
    let six = |list: &[f64; 6], name: &str| -> Result<[f64; 6], OutputError> {
        list.iter().try_for_each(|value| finite(*value, || name.to_owned()).map(drop))?;
        Ok(*list)
    };
    let shares = mode.shares.as_ref();
    let moved = model.beams.iter().zip(&mode.nodes).filter(|(_, nodes)| !nodes.is_empty());
    Ok(VibrationDocument {
        kind: mode.kind.word().to_owned(),
        frequency_hz: mode.frequency().map(|value| finite(value, || "frequency_hz".into())).transpose()?,
        rate: finite(mode.rate, || "rate".into())?,
        growth: finite(mode.growth, || "growth".into())?,
        omega_squared: finite(mode.square(), || "omega_squared".into())?,
        error_estimate: finite(mode.error_estimate, || "error_estimate".into())?,
        damping_ratio: mode
            .damping_ratio
            .map(|value| finite(value, || "damping_ratio".into()))
            .transpose()?,
        generalised_mass: finite(mode.generalised_mass, || "generalised_mass".into())?,
        participation: shares.map(|own| six(&own.participation, "participation")).transpose()?,
        effective_mass: shares.map(|own| six(&own.effective, "effective_mass")).transpose()?,
        nodes: Named::collect(moved, |(beam, nodes)| Ok((beam.name.clone(), nodes.clone())))?,
        shape: shape_document(model, &mode.direction)?,
        quadrature: mode.quadrature.as_ref().map(|shape| shape_document(model, shape)).transpose()?,
    })
}

/// `modes.csv`: a row for every mode; its nodes as the beam's name and arc length.
///
/// # Errors
/// As [`modes_document`].
pub fn vibration_csv(model: &Model, modes: &Modes) -> Result<String, OutputError> {
    let masses = ["x", "y", "z"].map(|axis| format!("effective_mass_{axis} [kg]"));
    let inertias = ["x", "y", "z"].map(|axis| format!("effective_inertia_{axis} [kg*m^2]"));
    let head = [
        "mode",
        "kind",
        "frequency [Hz]",
        "rate [rad/s]",
        "growth [1/s]",
        "error_estimate",
        "generalised_mass",
    ];
    let mut heading: Vec<String> = head.map(str::to_owned).to_vec();
    heading.extend(masses.into_iter().chain(inertias));
    heading.push("nodes [m]".to_owned());
    let mut text = line(heading);
    for (i, mode) in modes.modes.iter().enumerate() {
        let field = |part: &str| format!("modes[{i}].{part}");
        let mut row = vec![(i + 1).to_string(), mode.kind.word().to_owned()];
        row.push(match mode.frequency() {
            Some(value) => cell(value, || field("frequency_hz"))?,
            None => String::new(),
        });
        for (part, value) in [
            ("rate", mode.rate),
            ("growth", mode.growth),
            ("error_estimate", mode.error_estimate),
            ("generalised_mass", mode.generalised_mass),
        ] {
            row.push(cell(value, || field(part))?);
        }
        for axis in 0..6 {
            row.push(match &mode.shares {
                Some(own) => cell(own.effective[axis], || field("effective_mass"))?,
                None => String::new(),
            });
        }
        let beams = model.beams.iter().zip(&mode.nodes);
        let places = beams.flat_map(|(beam, places)| places.iter().map(move |s| (&beam.name, *s)));
        let told = places.map(|(name, s)| Ok(format!("{name} {}", cell(s, || field("nodes"))?)));
        row.push(told.collect::<Result<Vec<_>, OutputError>>()?.join("; "));
        text += &line(row);
    }
    Ok(text)
}
