//! A model file as a family of models: other values of its parameters make other models.

use crate::ProblemError;
use crate::model::{Model, Parameter, Study};
use crate::modelfile::Document;

/// A model file with overrides, from which models with any values of the parameters are made.
pub struct FileFamily<'a> {
    document: &'a Document,
    overrides: Vec<(String, String)>,
    parameters: Vec<Parameter>,
    studies: Vec<Study>,
    /// Which parameters the model depends on, once it was asked.
    matter: Option<Vec<bool>>,
}

impl<'a> FileFamily<'a> {
    /// The family of the models that `document` makes; `model` is the one made with the overrides. The others have its
    /// studies.
    pub fn new(document: &'a Document, overrides: &[(String, String)], model: &Model) -> Self {
        Self {
            document,
            overrides: overrides.to_vec(),
            parameters: model.parameters.clone(),
            studies: model.studies.clone(),
            matter: None,
        }
    }
}

impl flexura_study::Family for FileFamily<'_> {
    fn model(&mut self, values: &[(usize, f64)]) -> Result<Model, ProblemError> {
        let mut overrides = self.overrides.clone();
        for (position, value) in values {
            let parameter = &self.parameters[*position];
            overrides.retain(|(name, _)| *name != parameter.name);
            // The shortest text that reads back as the same number, with the SI unit.
            overrides.push((parameter.name.clone(), format!("{value:e} {}", parameter.unit)));
        }
        self.document.model_beside(&overrides, &self.studies).map_err(|report| {
            let names: Vec<&str> = values.iter().map(|(p, _)| self.parameters[*p].name.as_str()).collect();
            ProblemError::new(
                format!("parameter.{}", names.first().unwrap_or(&"")),
                format!("other values make no sound model: {}", first_message(&report.render(false))),
                "choose another guess or a range",
            )
        })
    }

    fn depends_on(&mut self, parameter: usize) -> bool {
        let (document, overrides) = (self.document, &self.overrides);
        let matter = self.matter.get_or_insert_with(|| document.parameters_that_matter(overrides));
        matter.get(parameter).copied().unwrap_or(true)
    }
}

/// The first line of a report.
fn first_message(report: &str) -> &str {
    report.lines().next().unwrap_or_default().trim_start_matches("error: ")
}
