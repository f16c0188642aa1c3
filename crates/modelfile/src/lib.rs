//! A TOML mechanism file, read into a [`Model`]: units, expressions, names, and messages that show the place.
//!
//! ```
//! let text = r#"
//! format = 1
//! [parameter]
//! push = "2 N"
//! [material.steel]
//! young = "207 GPa"
//! poisson = 0.3
//! [section.wire]
//! shape = "circle"
//! diameter = "1 mm"
//! [beam.link]
//! material = "steel"
//! section = "wire"
//! length = "100 mm"
//! start = { body = "ground", hold = "clamp" }
//! [load.tip]
//! beam = "link"
//! at = 1
//! force = [0, 0, "-push"]
//! "#;
//! let document = flexura_modelfile::Document::parse(text, "cantilever.toml")?;
//! let model = document.model(&[("push".to_string(), "3 N".to_string())])?;
//! assert_eq!(model.loads[0].force.z, -3.0);
//! # Ok::<(), flexura_modelfile::Report>(())
//! ```
//!
//! Absent on purpose: anything that solves, and anything that prints.

mod build;
mod context;
mod file;
mod format;
mod include;
mod json;
mod parameters;
mod reader;
mod reference;
mod repeat;
mod report;
mod rules;
mod schema;
mod syntax;
mod tree;
mod typed;
mod write;

pub use reference::reference_markdown;
pub use report::{Problem, Report, ReportKind, Severity};
pub use schema::schema;
pub use typed::Flag;
pub use write::to_toml;

use context::{Context, Reported, suggest};
use flexura_model::Model;
use include::Files;
use report::{Source, Texts};
use std::path::Path;
use std::sync::Arc;
use tree::Node;

/// A model file whose text has been understood as TOML. The model is made of it by [`Document::model`],
/// as often as wanted, each time with other overrides.
#[derive(Clone, Debug)]
pub struct Document {
    texts: Texts,
    root: Node,
}

impl Document {
    /// Reads a model file.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Report> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = file::read(path, &name)?;
        Self::new(text, path.parent().unwrap_or(Path::new("")), name, Files::Disk)
    }

    /// Understands a text as a model file; `file_name` is shown in messages, and files that the text names
    /// are looked for in its folder.
    pub fn parse(text: &str, file_name: &str) -> Result<Self, Report> {
        let folder = Path::new(file_name).parent().unwrap_or(Path::new(""));
        Self::new(text.to_string(), folder, file_name.to_string(), Files::Disk)
    }

    /// The same, where the files that the text includes are not on disk but in `parts`: their paths, as seen from the
    /// folder of the file, and their texts.
    pub fn parse_with(text: &str, file_name: &str, parts: &[(&str, &str)]) -> Result<Self, Report> {
        Self::new(text.to_string(), Path::new(""), file_name.to_string(), Files::Held(parts))
    }

    fn new(text: String, folder: &Path, name: String, files: Files<'_>) -> Result<Self, Report> {
        let path = Path::new(&name).to_path_buf();
        let source = Arc::new(Source { name, text });
        let (texts, root) = include::gather(source, &path, folder, files)?;
        Ok(Self { texts, root })
    }

    /// The model, with some parameters overridden: each is a name and a text such as "3", "3 N" or "2*other".
    pub fn model(&self, overrides: &[(String, String)]) -> Result<Model, Report> {
        self.build(overrides, |model, context| match model {
            Some(model) => Ok(model),
            None => Err(context.into_report()),
        })
    }

    /// What looks unintended although the model can be made: things that nothing uses, angles of many turns without a
    /// unit, and what [`Model::doubts`] finds.
    pub fn warnings(&self) -> Vec<Problem> {
        self.build(&[], |model, context| match model {
            Some(model) => build::warnings(&context, &model),
            None => Vec::new(),
        })
    }

    /// Builds the model and hands it on with what was found on the way.
    fn build<T>(
        &self,
        overrides: &[(String, String)],
        then: impl FnOnce(Option<Model>, Context<'_>) -> T,
    ) -> T {
        let mut context = Context::new(&self.texts, &self.root);
        build::parameters(&mut context, overrides);
        context.is_overridden = !overrides.is_empty();
        match repeat::expand(&context) {
            Err(Reported) => then(None, context),
            Ok(None) => {
                let model = build::model(&context);
                then(model, context)
            }
            Ok(Some(expanded)) => {
                let context = context.over(&expanded);
                let model = build::model(&context);
                then(model, context)
            }
        }
    }

    /// The names of the parameters, in the order of the file.
    pub fn parameter_names(&self) -> Vec<&str> {
        parameters::declared(&self.root).iter().map(|declared| declared.name).collect()
    }

    /// Where a key stands in the file, for messages about a finished model: the byte range of the deepest
    /// thing on the way to `path`, such as `body.slider`.
    pub fn problem(&self, path: &str, message: &str, hint: Option<&str>) -> Problem {
        let mut problem = match self.root.locate(path) {
            Some(span) => self.texts.problem(span, path, message),
            None => Problem { path: path.to_string(), ..Problem::of_file(&self.texts.file.name, message) },
        };
        problem.hint = hint.map(str::to_string);
        problem
    }

    /// A report of problems found in a finished model, by [`Document::problem`].
    pub fn report(&self, problems: Vec<Problem>) -> Report {
        Report::input(problems)
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.texts.file.text
    }

    /// The paths of the files that it includes, directly or not, in the order in which they are read.
    pub fn included(&self) -> impl Iterator<Item = &str> {
        self.texts.included.iter().map(|part| part.source.name.as_str())
    }

    /// The text of the file with the tables of the files that it includes written out, so that it needs them no more:
    /// the file's own text where it includes none.
    pub fn whole_text(&self) -> std::borrow::Cow<'_, str> {
        if self.texts.included.is_empty() {
            self.text().into()
        } else {
            write::written_out(&self.root).into()
        }
    }
}

/// The nearest of some names, for hints in the same words elsewhere.
pub fn suggestion(name: &str, names: &[&str], kind: &str) -> String {
    suggest(name, names, kind)
}
