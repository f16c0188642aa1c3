//! The six-rod parallel continuum robot: forward kinematics of inverse kinematics.

use crate::{Case, Row};
use flexura::model::{Curve, Model};
use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::{Prepared, ProblemError};

pub const CASES: [Case; 1] = [Case {
    id: "six_rod_robot",
    title: "Six-rod robot (`six_rod_robot.toml`): lengths from the plate's pose, pose from the lengths, lengths again, \
            on the way of the plate from (0, .02, .48) to (0, .12, .58) m; balance of the plate",
    citation: "the two problems undo each other; C. B. Black, J. Till, D. C. Rucker, *IEEE Trans. Robotics* 34 (2018) 29",
    needed: "1e-8",
    run,
    closed_form: None,
}];

const TOLERANCE: f64 = 1e-11;

fn run() -> Result<Vec<Row>, String> {
    let text = include_str!("../../../../models/six_rod_robot.toml");
    let document = Document::parse(text, "six_rod_robot.toml").map_err(|report| report.render(false))?;
    let base = document.model(&[]).map_err(|report| report.render(false))?;
    let rods = base.unknowns.clone();
    let put = |model: &mut Model, lengths: &[(usize, f64)], part: f64| {
        model.targets[1].value = 0.02 + 0.1 * part;
        model.targets[2].value = 0.48 + 0.1 * part;
        for (parameter, length) in lengths {
            model.parameters[*parameter].value = *length;
            if let Some(rod) = rods.iter().position(|u| u.parameter == *parameter) {
                model.beams[rod].curve = Curve::Straight { length: *length };
            }
        }
    };
    let lengths_of = |model: &Model| -> Vec<(usize, f64)> {
        rods.iter().map(|u| (u.parameter, model.parameters[u.parameter].value)).collect()
    };
    let inverse = |prepared: &mut Prepared, part: f64| -> Result<Vec<(usize, f64)>, String> {
        let mut family = |values: &[(usize, f64)]| -> Result<Model, ProblemError> {
            let mut model = base.clone();
            put(&mut model, values, part);
            Ok(model)
        };
        let outcome = prepared.solve_inverse_from_here(&mut family, TOLERANCE);
        if outcome.status != Status::Converged {
            return Err(outcome.reason.unwrap_or_default());
        }
        Ok(lengths_of(prepared.model()))
    };
    let mut prepared = Prepared::new(&base).map_err(|error| error.message)?;
    if prepared.solve(TOLERANCE, &mut |_| {}).status != Status::Converged {
        return Err("the robot does not settle at the guess".to_string());
    }
    let mut rows = Vec::new();
    for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let lengths = inverse(&mut prepared, part)?;
        // Forward from rest, with these lengths: no memory of the pose.
        let mut model = base.clone();
        put(&mut model, &lengths, part);
        let mut forward = Prepared::new(&model).map_err(|error| error.message)?;
        let outcome = forward.solve(TOLERANCE, &mut |_| {});
        if outcome.status != Status::Converged {
            return Err(outcome.reason.unwrap_or_default());
        }
        let solution = forward.solution(&outcome, 2);
        let plate = solution.bodies[0];
        let wanted = [0.0, model.targets[1].value, model.targets[2].value];
        let off = plate.position.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let turned = plate.rotation.angle();
        rows.push(Row::vanishing(format!("pose at {part}, m and rad"), off.max(turned), 1e-8));
        let again = inverse(&mut forward, part)?;
        let apart = again.iter().zip(&lengths).map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max);
        rows.push(Row::vanishing(format!("lengths at {part}, m"), apart, 1e-8));
        // The rods' ends balance on the plate, which nothing else holds.
        let ends = solution.beams.iter().filter_map(|beam| beam.samples.last());
        let (mut force, mut moment) = (0.0 * plate.position, 0.0 * plate.position);
        for end in ends {
            let arm = end.pose.position - plate.position;
            force += end.wrench.force;
            moment += end.wrench.moment + arm.cross(&end.wrench.force);
        }
        rows.push(Row::vanishing(
            format!("balance at {part}, N and N m"),
            force.norm().max(moment.norm()),
            1e-9,
        ));
    }
    Ok(rows)
}
