//! From a motion in time to its document.

use super::MotionView;
use super::wire::{
    BodySeries, CableSeries, InverseDynamicsDocument, JointSeries, MotionWorkDocument, Series, SpringSeries,
};
use crate::document::{
    finite, finite_list, finite_vectors, parameters, reasons_by_name, section_quaternions,
};
use crate::scene::scene;
use crate::{Named, OutputError};
use flexura_model::Output;
use flexura_solution::{BodyMotion, Instant, JointMotion, JointSolution};
use flexura_spatial::Vector3;

/// The result document of a motion in time.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn motion_document(view: &MotionView<'_>) -> Result<InverseDynamicsDocument, OutputError> {
    let (model, motion) = (view.model, view.motion);
    let instants = &motion.instants;
    let list = |field: &str, pick: fn(&Instant) -> f64| finite_list(field, instants.iter().map(pick));
    Ok(InverseDynamicsDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.name.clone(),
        study: "inverse_dynamics".to_owned(),
        status: motion.status.word().to_owned(),
        reason: motion.reason.clone(),
        warnings: motion.warnings.clone(),
        parameter: view.parameter().0.to_owned(),
        parameters: parameters(model)?,
        error_estimate: finite(motion.error_estimate, || "error_estimate".into())?,
        times: list("times", |instant| instant.time)?,
        value: list("value", |instant| instant.value)?,
        rate: list("rate", |instant| instant.rate)?,
        acceleration: list("acceleration", |instant| instant.acceleration)?,
        outputs: Named::collect(model.outputs.iter().enumerate(), |(i, output)| {
            Ok((output.name.clone(), output_series(instants, i, output)?))
        })?,
        output_reasons: reasons_by_name(model, instants.iter().flat_map(|instant| &instant.output_reasons)),
        bodies: Named::collect(model.bodies.iter().enumerate(), |(i, body)| {
            Ok((body.name.clone(), body_series(instants, i, &format!("bodies.{}", body.name))?))
        })?,
        joints: Named::collect(model.joints.iter().enumerate(), |(i, joint)| {
            let names = joint.law.kind.coordinate_names();
            let names = if names.len() > 1 { names } else { &[] };
            let path = format!("joints.{}", joint.name);
            Ok((joint.name.clone(), joint_series(instants, i, names, &path)?))
        })?,
        springs: Named::collect(model.springs.iter().enumerate(), |(i, spring)| {
            let path = |field: &str| format!("springs.{}.{field}", spring.name);
            let states = || instants.iter().map(|instant| &instant.state.springs[i]);
            let series = SpringSeries {
                length: finite_list(&path("length"), states().map(|state| state.length))?,
                tension: finite_list(&path("tension"), states().map(|state| state.tension))?,
            };
            Ok((spring.name.clone(), series))
        })?,
        cables: Named::collect(model.cables.iter().enumerate(), |(i, cable)| {
            let path = |field: &str| format!("cables.{}.{field}", cable.name);
            let states = || instants.iter().map(|instant| &instant.state.cables[i]);
            let series = CableSeries {
                length: finite_list(&path("length"), states().map(|state| state.length))?,
                tension: finite_list(&path("tension"), states().map(|state| state.tension))?,
            };
            Ok((cable.name.clone(), series))
        })?,
        drive_power: list("drive_power", |instant| instant.drive_power)?,
        gravity_power: list("gravity_power", |instant| instant.gravity_power)?,
        kinetic_energy: list("kinetic_energy", |instant| instant.kinetic_energy)?,
        energy: list("energy", |instant| instant.state.energy)?,
        work: MotionWorkDocument {
            instants: motion.work.instants,
            newton_steps: motion.work.newton_steps,
            factorisations: motion.work.factorisations,
            residuals: motion.work.residuals,
        },
        scene: instants.first().map(|instant| scene(model, &instant.state)).transpose()?,
    })
}

fn output_series(instants: &[Instant], i: usize, output: &Output) -> Result<Series, OutputError> {
    let path = |t: usize| format!("outputs.{}[{t}]", output.name);
    let values = || instants.iter().map(|instant| instant.outputs[i].as_deref()).enumerate();
    if output.formulas.len() == 3 {
        let vectors = values().map(|(t, value)| match value {
            Some([x, y, z]) => crate::document::all_finite([*x, *y, *z], || path(t)).map(Some),
            _ => Ok(None),
        });
        return Ok(Series::Vectors(vectors.collect::<Result<_, _>>()?));
    }
    let numbers = values().map(|(t, value)| match value {
        Some([number, ..]) => finite(*number, || path(t)).map(Some),
        _ => Ok(None),
    });
    Ok(Series::Numbers(numbers.collect::<Result<_, _>>()?))
}

fn body_series(instants: &[Instant], i: usize, path: &str) -> Result<BodySeries, OutputError> {
    let poses = || instants.iter().map(|instant| &instant.state.bodies[i]);
    let vectors = |field: &str, pick: fn(&BodyMotion) -> Vector3<f64>| {
        finite_vectors(path, field, instants.iter().map(|instant| pick(&instant.bodies()[i]).into()))
    };
    let rotations = section_quaternions(poses().map(|pose| &pose.rotation));
    Ok(BodySeries {
        position: finite_vectors(path, "position", poses().map(|pose| pose.position.into()))?,
        rotation: finite_vectors(path, "rotation", rotations.into_iter())?,
        velocity: vectors("velocity", |body| body.velocity.linear)?,
        angular_velocity: vectors("angular_velocity", |body| body.velocity.angular)?,
        acceleration: vectors("acceleration", |body| body.acceleration.linear)?,
        angular_acceleration: vectors("angular_acceleration", |body| body.acceleration.angular)?,
    })
}

fn joint_series(
    instants: &[Instant],
    i: usize,
    names: &[&str],
    path: &str,
) -> Result<JointSeries, OutputError> {
    let rows = |field: &str, pick: &dyn Fn(&Instant) -> Vec<f64>| -> Result<Vec<Vec<f64>>, OutputError> {
        let each = instants.iter().enumerate();
        each.map(|(t, instant)| finite_list(&format!("{path}.{field}[{t}]"), pick(instant).into_iter()))
            .collect()
    };
    let states = |field: &str, pick: fn(&JointSolution) -> &Vec<f64>| {
        rows(field, &|instant| pick(&instant.state.joints[i]).clone())
    };
    let motions = |field: &str, pick: fn(&JointMotion) -> &Vec<f64>| {
        rows(field, &|instant| pick(&instant.joints()[i]).clone())
    };
    let wrenches = || instants.iter().map(|instant| instant.state.joints[i].wrench);
    let contact = |instant: &Instant| instant.state.joints[i].contact.map(|contact| contact.point.into());
    let contacts = instants.iter().filter_map(contact);
    Ok(JointSeries {
        names: names.iter().map(|name| (*name).to_owned()).collect(),
        coordinates: states("coordinates", |joint| &joint.coordinates)?,
        velocities: motions("velocities", |joint| &joint.velocities)?,
        accelerations: motions("accelerations", |joint| &joint.accelerations)?,
        efforts: states("efforts", |joint| &joint.efforts)?,
        force: finite_vectors(path, "force", wrenches().map(|wrench| wrench.force.into()))?,
        moment: finite_vectors(path, "moment", wrenches().map(|wrench| wrench.moment.into()))?,
        contact_point: finite_vectors(path, "contact_point", contacts)?,
    })
}
