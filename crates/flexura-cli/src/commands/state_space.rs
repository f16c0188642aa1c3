//! `flexura modes FILE --state-space OUT`

use super::study_failure;
use crate::answer::{Task, unwritable};
use crate::arguments::ModesArguments;
use crate::failure::Failure;
use crate::{files, screen};
use flexura::model::{ModesStudy, visible};
use flexura::output::{
    OutputError, response_svg, state_space_csv, state_space_document, state_space_mat, to_json,
};
use flexura::solution::StateSpace;
use flexura::{StateSpaceRequest, state_space};
use std::path::Path;

/// Difference from the whole response from which more modes are advised.
const COARSE: f64 = 1e-3;

/// What a file is to hold.
#[derive(Clone, Copy)]
enum Form {
    Json,
    Csv,
    Mat,
    Svg,
}

impl Form {
    fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().and_then(|end| end.to_str()) {
            Some("json") => Ok(Self::Json),
            Some("csv") => Ok(Self::Csv),
            Some("mat") => Ok(Self::Mat),
            Some("svg") => Ok(Self::Svg),
            _ => Err(Failure::Input(format!(
                "--state-space does not know what to write into {}: its name should end in .json, .csv, .mat or .svg",
                visible(&path.display().to_string())
            ))),
        }
    }
}

/// Finds the linear model and writes it in each form that was asked for.
pub fn write(task: &Task, name: &str, study: &ModesStudy, arguments: &ModesArguments) -> Result<(), Failure> {
    let forms = arguments.state_space.iter().map(|path| Ok((path.as_path(), Form::of(path)?)));
    let forms: Vec<(&Path, Form)> = forms.collect::<Result<_, Failure>>()?;
    let request = StateSpaceRequest {
        inputs: arguments.input.clone(),
        outputs: arguments.measure.clone(),
        damping_ratio: arguments.damping_ratio.unwrap_or(0.0),
        residual_vectors: arguments.residual_vectors,
    };
    let space = state_space(&task.model, study, &request, &task.options, &mut |_| {})
        .map_err(|error| study_failure(&task.file, name, &error))?;
    let refused = |error: OutputError| unwritable(None, &error.to_string());
    for (path, form) in forms {
        match form {
            Form::Json => {
                let document = state_space_document(&task.model, &space).map_err(refused)?;
                files::replace(path, to_json(&document).map_err(refused)?)?;
            }
            Form::Csv => files::replace(path, state_space_csv(&space).map_err(refused)?)?,
            Form::Mat => files::replace(path, state_space_mat(&space).map_err(refused)?)?,
            Form::Svg => files::replace(path, response_svg(&task.model, &space))?,
        }
    }
    if !task.is_quiet {
        tell(&space);
    }
    Ok(())
}

fn tell(space: &StateSpace) {
    space
        .solution
        .warnings
        .iter()
        .filter(|text| text.starts_with("the state space"))
        .for_each(|text| screen::warn(text));
    if let Some(error) = space.error_estimate {
        let advice = if error > COARSE { "; more modes or residual vectors come nearer" } else { "" };
        let added = match space.residual_vectors {
            0 => String::new(),
            1 => " with a residual vector for each input".to_string(),
            count => format!(" with {count} residual vectors for each input"),
        };
        screen::note(&format!(
            "state space: {} states{added}, up to its last mode off by {error:.0e} of the response{advice}",
            space.a.len()
        ));
    }
}
