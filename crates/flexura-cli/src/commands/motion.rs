//! Studies of the kind `inverse_dynamics`, which only a file can hold.

use super::study_failure;
use crate::answer::{Answer, StudyDocument, Task, unwritable};
use crate::failure::Failure;
use crate::motion_summary;
use crate::progress::MotionMeter;
use flexura::model::InverseDynamicsStudy;
use flexura::motion_view;
use flexura::output::{OutputError, motion_csv, motion_document, motion_svg};
use flexura::solution::InverseDynamics;

/// A motion in time of a file's model.
pub fn study(task: &Task, name: &str, study: &InverseDynamicsStudy) -> Result<Answer, Failure> {
    let model = &task.model;
    let mut meter = MotionMeter::new(task.is_quiet);
    let moved = flexura::inverse_dynamics(model, study, &task.options, &mut |progress| {
        meter.update(progress);
    });
    meter.finish();
    let motion = moved.map_err(|error| study_failure(&task.file, name, &error))?;

    let refused = |error: OutputError| unwritable(failure(&motion), &error.to_string());
    let view = motion_view(model, &motion);
    let mut document = None;
    let mut files = Vec::new();
    if task.wants_document() {
        document = Some(StudyDocument::InverseDynamics(Box::new(motion_document(&view).map_err(refused)?)));
        if task.wants_files() {
            files.push(("motion.csv", motion_csv(&view).map_err(refused)?));
            files.push(("motion.svg", motion_svg(&view)));
        }
    }
    Ok(Answer {
        document,
        files,
        summary: motion_summary::render(model, &motion),
        without_value: Vec::new(),
        warnings: motion.warnings.clone(),
        failure: failure(&motion),
        growing: None,
    })
}

fn failure(motion: &InverseDynamics) -> Option<Failure> {
    let reason = motion.reason.as_deref().unwrap_or("the motion could not be gone through");
    Failure::of(motion.status, Some(reason))
}
