//! Bundled model files, solved the way a user would.

use flexura::modelfile::Document;
use flexura::post::{self, Evaluation, OutputValue};
use flexura::{Options, inverse_dynamics, solve_model};
use flexura_model::{InverseDynamicsStudy, Model, ModesPath, ModesStudy, MotionLaw, Sampling};
use flexura_solution::{InverseDynamics, Modes, ModesAlong, Solution, Status};

/// What bundled models include.
const PARTS: &[(&str, &str)] = &[
    ("parts/flexonic_node.toml", include_str!("../../../models/parts/flexonic_node.toml")),
    ("parts/flexonic_corner.toml", include_str!("../../../models/parts/flexonic_corner.toml")),
    ("parts/flexonic_camera.toml", include_str!("../../../models/parts/flexonic_camera.toml")),
    ("node_camera.toml", include_str!("../../../models/node_camera.toml")),
];

/// A model file, with what a case adds to it.
pub struct File {
    pub(crate) document: Document,
}

/// A solved file.
pub struct Answer {
    pub model: Model,
    pub solution: Solution,
    pub evaluation: Evaluation,
}

impl File {
    /// From the text of a model file, without its studies: a case says itself what is done, with values that these need not
    /// allow.
    ///
    /// # Errors
    /// The text is wrong.
    pub fn new(text: &str) -> Result<Self, String> {
        let document = Document::parse_with(&without_studies(text), "model.toml", PARTS)
            .map_err(|report| report.render(false))?;
        Ok(Self { document })
    }

    /// Forward or inverse, with some parameters (SI) overridden.
    ///
    /// # Errors
    /// The model is wrong, or the solve did not converge to the tolerance.
    pub fn solve(&self, values: &[(&str, f64)], tolerance: f64) -> Result<Answer, String> {
        self.solve_with(values, &Options { tolerance, samples: 3, ..Options::default() })
    }

    /// The same with options.
    ///
    /// # Errors
    /// As [`File::solve`].
    pub fn solve_with(&self, values: &[(&str, f64)], options: &Options) -> Result<Answer, String> {
        let overrides = Self::overrides(values);
        let model = self.document.model(&overrides).map_err(|report| report.render(false))?;
        let (solution, model) =
            solve_model(&model, options, &mut |_| {}).map_err(|error| error.to_string())?;
        if solution.status != Status::Converged {
            let reason = solution.reason.as_deref().unwrap_or("no reason given");
            return Err(format!("{} at {values:?}: {reason}", solution.status.word()));
        }
        let evaluation = post::evaluate(&model, &solution).map_err(|error| error.to_string())?;
        Ok(Answer { model, solution, evaluation })
    }

    /// The lowest modes, with some parameters (SI) overridden.
    ///
    /// # Errors
    /// The model is wrong, or its equilibrium was not found.
    pub fn modes(&self, values: &[(&str, f64)], count: usize, options: &Options) -> Result<Modes, String> {
        let model = self.document.model(&Self::overrides(values)).map_err(|report| report.render(false))?;
        let study = ModesStudy { count, ..ModesStudy::default() };
        let modes =
            flexura::modes(&model, &study, options, &mut |_| {}).map_err(|error| error.to_string())?;
        match modes.solution.status {
            Status::Converged => Ok(modes),
            status => Err(format!("{}: {}", status.word(), modes.solution.reason.unwrap_or_default())),
        }
    }

    /// The lowest modes along a parameter (SI).
    ///
    /// # Errors
    /// The model is wrong, or its path was not followed to the end.
    pub fn modes_along(
        &self,
        parameter: &str,
        range: [f64; 2],
        steps: usize,
        count: usize,
    ) -> Result<ModesAlong, String> {
        let model = self.document.model(&[]).map_err(|report| report.render(false))?;
        let parameter =
            model.parameters.iter().position(|p| p.name == parameter).ok_or("no such parameter")?;
        let path = ModesPath { parameter, range, steps };
        let study = ModesStudy { count, path: Some(path), ..ModesStudy::default() };
        let options = Options { samples: 3, ..Options::default() };
        let along = flexura::modes_along(&model, &study, path, &options, &mut |_| {})
            .map_err(|error| error.to_string())?;
        match along.trace.status {
            Status::Converged => Ok(along),
            status => Err(format!("{}: {}", status.word(), along.trace.reason.unwrap_or_default())),
        }
    }

    /// Through a motion in time, with some parameters (SI) overridden.
    ///
    /// # Errors
    /// The model is wrong, or the motion was not gone through to its end.
    pub fn moved(
        &self,
        values: &[(&str, f64)],
        parameter: &str,
        law: MotionLaw,
        sampling: Sampling,
    ) -> Result<InverseDynamics, String> {
        let overrides = Self::overrides(values);
        let model = self.document.model(&overrides).map_err(|report| report.render(false))?;
        let parameter =
            model.parameters.iter().position(|p| p.name == parameter).ok_or("no such parameter")?;
        let study = InverseDynamicsStudy { parameter, law, sampling };
        let motion = inverse_dynamics(&model, &study, &Options::default(), &mut |_| {})
            .map_err(|error| error.to_string())?;
        match motion.status {
            Status::Converged => Ok(motion),
            status => Err(format!("{}: {}", status.word(), motion.reason.unwrap_or_default())),
        }
    }

    /// The position of an output.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn output(&self, name: &str) -> Result<usize, String> {
        let model = self.document.model(&[]).map_err(|report| report.render(false))?;
        model.outputs.iter().position(|o| o.name == name).ok_or_else(|| format!("no output {name}"))
    }

    /// Parameters as the file has them.
    pub(crate) fn overrides(values: &[(&str, f64)]) -> Vec<(String, String)> {
        values.iter().map(|(name, value)| ((*name).to_string(), format!("{value:e}"))).collect()
    }
}

impl Answer {
    /// An output that is a number; NaN if there is none, which no row survives.
    pub fn number(&self, name: &str) -> f64 {
        match self.output(name) {
            Some(OutputValue::Number(value)) => value,
            _ => f64::NAN,
        }
    }

    /// An output that is a vector; NaN if there is none.
    pub fn vector(&self, name: &str) -> [f64; 3] {
        match self.output(name) {
            Some(OutputValue::Vector(value)) => [value[0], value[1], value[2]],
            _ => [f64::NAN; 3],
        }
    }

    /// The value of a parameter, of an unknown the one found; NaN if there is none.
    pub fn parameter(&self, name: &str) -> f64 {
        self.model.parameters.iter().find(|p| p.name == name).map_or(f64::NAN, |p| p.value)
    }

    fn output(&self, name: &str) -> Option<OutputValue> {
        self.evaluation.outputs.iter().find(|output| output.name == name).map(|output| output.value)
    }
}

/// The text without the tables that describe studies.
fn without_studies(text: &str) -> String {
    let mut kept = true;
    let lines = text.lines().filter(|line| {
        if line.starts_with('[') {
            kept = !line.starts_with("[study.");
        }
        kept
    });
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// A file with an inverse problem added: parameters with their guesses, outputs with the values wanted.
pub fn asking(text: &str, unknowns: &[(&str, f64)], targets: &[(&str, f64)]) -> String {
    let mut text = format!("{text}\n[unknown]\n");
    for (name, guess) in unknowns {
        text += &format!("{name} = {{ guess = {guess:e} }}\n");
    }
    text += "[target]\n";
    for (output, value) in targets {
        text += &format!("\"output.{output}\" = {value:e}\n");
    }
    text
}
