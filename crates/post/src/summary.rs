//! What a person reads after a solve, as plain data; how it is set on the screen is the command's matter.

use crate::{BeamPeaks, Evaluation, OutputResult};
use flexura_model::{CoordinateKind, Model, Tubes};
use flexura_solution::{Solution, Status, TubesSolution};
use flexura_spatial::{Vector3, log};

/// The summary of one solve.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Name of the model; may be empty.
    pub model: String,
    /// How the study ended.
    pub status: Status,
    /// Why, when it did not converge.
    pub reason: Option<String>,
    /// Fraction of the full load that was reached.
    pub load_fraction: f64,
    /// Largest scaled residual.
    pub residual: f64,
    /// Estimated largest relative error.
    pub error_estimate: f64,
    /// Newton steps.
    pub newton_steps: usize,
    /// Load steps.
    pub load_steps: usize,
    /// The parameters that were solved for: name, value (SI), unit.
    pub found: Vec<(String, f64, String)>,
    /// Outputs in the model's order.
    pub outputs: Vec<OutputSummary>,
    /// Beams in the model's order.
    pub beams: Vec<BeamSummary>,
    /// Bodies in the model's order.
    pub bodies: Vec<BodySummary>,
    /// Joints in the model's order.
    pub joints: Vec<JointSummary>,
    /// Springs: name, length (m), tension (N), strain (none where the rest length is zero).
    pub springs: Vec<(String, f64, f64, Option<f64>)>,
    /// Couplings: name, effort per factor (of the unit of the coordinates' efforts over that of the factors).
    pub couplings: Vec<(String, f64)>,
    /// Cables: name, length (m), tension (N).
    pub cables: Vec<(String, f64, f64)>,
    /// Concentric tubes in the model's order.
    pub tubes: Vec<TubesSummary>,
    /// Strain energy, J.
    pub energy: f64,
    /// Number of unstable directions of the equilibrium; None where that is not decided.
    pub unstable_directions: Option<usize>,
    /// Why it is not decided.
    pub stability_reason: Option<String>,
    /// Things to know though the solve went well.
    pub warnings: Vec<String>,
    /// How large lengths, forces and moments are here, so that rounding noise can be told from values.
    pub scales: Scales,
}

/// The largest length (m), force (N) and moment (N·m) of a result.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scales {
    /// Longest beam or set of tubes, or remotest body.
    pub length: f64,
    /// Largest internal or joint force.
    pub force: f64,
    /// Largest internal or joint moment, or torque of a tube.
    pub moment: f64,
}

impl Scales {
    /// The scales of a solution.
    pub fn of(solution: &Solution) -> Self {
        scales(solution)
    }

    /// Is a value of that unit nothing but rounding noise beside the other values of its kind?
    pub fn hides(&self, value: f64, unit: &str) -> bool {
        let scale = match unit {
            "m" => self.length,
            "N" => self.force,
            "N*m" => self.moment,
            _ => 0.0,
        };
        value.abs() < 1e-12 * scale
    }
}

/// An output as a person reads it.
pub type OutputSummary = OutputResult;

/// A beam's largest values.
#[derive(Clone, Debug)]
pub struct BeamSummary {
    /// Its name.
    pub name: String,
    /// Its undeformed length, m.
    pub length: f64,
    /// Largest strain and stresses. None where the section is given as a stiffness.
    pub peaks: Option<BeamPeaks>,
    /// Has its material a yield strength?
    pub has_yield_strength: bool,
}

/// Where a body came to rest.
#[derive(Clone, Debug)]
pub struct BodySummary {
    /// Its name.
    pub name: String,
    /// Global position, m.
    pub position: Vector3<f64>,
    /// Rotation vector from the global axes, rad.
    pub rotation: Vector3<f64>,
    /// How far it moved, m.
    pub displacement: f64,
}

/// A joint's state.
#[derive(Clone, Debug)]
pub struct JointSummary {
    /// Its name.
    pub name: String,
    /// Its coordinates in the kind's order.
    pub coordinates: Vec<CoordinateSummary>,
    /// Force of the parent on the child, global, N.
    pub force: Vector3<f64>,
    /// Moment of the parent on the child, global, N·m.
    pub moment: Vector3<f64>,
}

/// A joint's coordinate.
#[derive(Clone, Copy, Debug)]
pub struct CoordinateSummary {
    /// What it is called; "" where it is the joint's only one.
    pub name: &'static str,
    /// m or rad.
    pub value: f64,
    /// "m" or "rad".
    pub unit: &'static str,
    /// N or N·m.
    pub effort: f64,
    /// "N" or "N*m".
    pub effort_unit: &'static str,
}

/// Concentric tubes, as far as they have come out of their guide.
#[derive(Clone, Debug)]
pub struct TubesSummary {
    /// Their name.
    pub name: String,
    /// Length from the guide to the tip, m.
    pub length: f64,
    /// Global position of the tip, m.
    pub tip: Vector3<f64>,
    /// Torque about the axis at the guide, one for each tube, N·m; zero for one that ends inside the guide.
    pub torques: Vec<f64>,
}

/// Gathers the summary of a solve.
pub fn summarise(model: &Model, solution: &Solution, evaluation: &Evaluation) -> Summary {
    let beams = model.beams.iter().zip(&solution.beams).zip(&evaluation.beams);
    let joints = model.joints.iter().zip(&solution.joints);
    Summary {
        model: model.name.clone(),
        status: solution.status,
        reason: solution.reason.clone(),
        load_fraction: solution.load_fraction,
        residual: solution.residual,
        error_estimate: solution.error_estimate,
        newton_steps: solution.work.newton_steps,
        load_steps: solution.work.load_steps,
        found: solution
            .found
            .iter()
            .map(|(position, value)| {
                let parameter = &model.parameters[*position];
                (parameter.name.clone(), *value, parameter.unit.clone())
            })
            .collect(),
        outputs: evaluation.outputs.clone(),
        beams: beams
            .map(|((beam, result), stress)| BeamSummary {
                name: beam.name.clone(),
                length: result.length,
                peaks: stress.as_ref().map(|stress| stress.peaks),
                has_yield_strength: beam.material.is_some_and(|id| model[id].yield_strength.is_some()),
            })
            .collect(),
        bodies: model
            .bodies
            .iter()
            .zip(&solution.bodies)
            .map(|(body, pose)| BodySummary {
                name: body.name.clone(),
                position: pose.position,
                rotation: log(&pose.rotation),
                displacement: (pose.position - body.pose.position).norm(),
            })
            .collect(),
        joints: joints
            .map(|(joint, result)| {
                let kind = joint.law.kind;
                let is_only = kind.freedoms() == 1;
                let values = result.coordinates.iter().zip(&result.efforts);
                let names = kind.coordinate_kinds().iter().zip(kind.coordinate_names());
                let coordinates = values.zip(names).take(kind.named_coordinates()).map(
                    |((value, effort), (kind, name))| {
                        let (unit, effort_unit) = coordinate_units(*kind);
                        let name = if is_only { "" } else { *name };
                        CoordinateSummary { name, value: *value, unit, effort: *effort, effort_unit }
                    },
                );
                JointSummary {
                    name: joint.name.clone(),
                    coordinates: coordinates.collect(),
                    force: result.wrench.force,
                    moment: result.wrench.moment,
                }
            })
            .collect(),
        springs: model
            .springs
            .iter()
            .zip(&solution.springs)
            .map(|(spring, result)| (spring.name.clone(), result.length, result.tension, result.strain))
            .collect(),
        couplings: model
            .couplings
            .iter()
            .zip(&solution.couplings)
            .map(|(coupling, multiplier)| (coupling.name.clone(), *multiplier))
            .collect(),
        cables: model
            .cables
            .iter()
            .zip(&solution.cables)
            .map(|(cable, result)| (cable.name.clone(), result.length, result.tension))
            .collect(),
        tubes: model.tubes.iter().zip(&solution.tubes).filter_map(tubes_summary).collect(),
        energy: solution.energy,
        unstable_directions: solution.unstable_directions,
        stability_reason: solution.stability_reason.clone(),
        warnings: solution.warnings.clone(),
        scales: scales(solution),
    }
}

fn tubes_summary((tubes, result): (&Tubes, &TubesSolution)) -> Option<TubesSummary> {
    let (base, tip) = (result.samples.first()?, result.samples.last()?);
    let torque = |tube: usize| base.torques.iter().find(|(number, _)| *number == tube).map_or(0.0, |t| t.1);
    Some(TubesSummary {
        name: tubes.name.clone(),
        length: tip.s,
        tip: tip.pose.position,
        torques: (0..tubes.tubes.len()).map(torque).collect(),
    })
}

fn scales(solution: &Solution) -> Scales {
    let samples = solution.beams.iter().flat_map(|beam| &beam.samples).map(|sample| sample.wrench);
    let tubes = || solution.tubes.iter().flat_map(|tubes| &tubes.samples);
    let samples = samples.chain(tubes().map(|sample| sample.wrench));
    let wrenches = samples.chain(solution.joints.iter().map(|joint| joint.wrench));
    let mut scales = Scales::default();
    for wrench in wrenches {
        scales.force = scales.force.max(wrench.force.norm());
        scales.moment = scales.moment.max(wrench.moment.norm());
    }
    let torques = tubes().flat_map(|sample| &sample.torques).map(|(_, torque)| torque.abs());
    scales.moment = torques.fold(scales.moment, f64::max);
    let lengths = solution.beams.iter().map(|beam| beam.length).chain(tubes().map(|sample| sample.s));
    scales.length =
        lengths.chain(solution.bodies.iter().map(|pose| pose.position.norm())).fold(0.0, f64::max);
    scales
}

/// Units of a coordinate and of its effort.
fn coordinate_units(kind: CoordinateKind) -> (&'static str, &'static str) {
    match kind {
        CoordinateKind::Angle => ("rad", "N*m"),
        CoordinateKind::Length => ("m", "N"),
    }
}
