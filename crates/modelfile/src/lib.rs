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
use report::{Source, Texts};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use toml::de::DeTable;
use tree::{Node, Value};

/// A model file whose text has been understood as TOML. The model is made of it by [`Document::model`],
/// as often as wanted, each time with other overrides.
#[derive(Clone, Debug)]
pub struct Document {
    texts: Texts,
    folder: PathBuf,
    root: Node,
}

impl Document {
    /// Reads a model file.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Report> {
        let path = path.as_ref();
        let name = path.display().to_string();
        let text = file::read(path, &name)?;
        Self::new(text, name, path.parent().unwrap_or(Path::new("")).to_path_buf())
    }

    /// Understands a text as a model file; `file_name` is shown in messages, and files that the text names
    /// are looked for in its folder.
    pub fn parse(text: &str, file_name: &str) -> Result<Self, Report> {
        let folder = Path::new(file_name).parent().unwrap_or(Path::new("")).to_path_buf();
        Self::new(text.to_string(), file_name.to_string(), folder)
    }

    fn new(text: String, name: String, folder: PathBuf) -> Result<Self, Report> {
        let source = Arc::new(Source { name, text });
        let at = |span, path: &str, message: String| Problem::at(&source, span, path, message);
        if source.text.len() as u64 > file::LARGEST {
            return Err(Report::input(vec![Problem::of_file(
                &source.name,
                "the text is larger than 16 MiB",
            )]));
        }
        let (table, errors) = DeTable::parse_recoverable(&source.text);
        if !errors.is_empty() {
            let errors: Vec<_> =
                errors.iter().map(|error| (error.span().unwrap_or(0..0), error.message())).collect();
            return Err(Report::input(syntax::problems(&source, &errors)));
        }
        let root = Node { span: table.span(), value: Value::Table(tree::entries(table.get_ref())) };
        match root.get("format") {
            _ if root.entries().is_empty() => {
                let problem = Problem::of_file(&source.name, "the file is empty")
                    .hint("a model file begins with `format = 1`");
                Err(Report::input(vec![problem]))
            }
            None => {
                let hint = match flexura_expression::nearest(
                    "format",
                    root.entries().iter().map(|entry| entry.key.as_str()),
                ) {
                    Some(near) => {
                        format!("a model file begins with `format = 1`; is `{near}` meant to be it?")
                    }
                    None => "a model file begins with `format = 1`".to_string(),
                };
                Err(Report::input(vec![at(0..0, "", "the key `format` is missing".into()).hint(hint)]))
            }
            Some(entry) if !matches!(entry.node.value, Value::Number(1.0)) => {
                let shown = source.text.get(entry.node.span.clone()).unwrap_or_default();
                let message = format!("the format {shown} is not known");
                let problem =
                    at(entry.node.span.clone(), "format", message).hint("this program reads `format = 1`");
                Err(Report::input(vec![problem]))
            }
            Some(_) => Ok(Self { texts: Texts { file: source, typed: None }, folder, root }),
        }
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
        let mut context = Context::new(&self.texts, &self.folder, &self.root);
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
}

/// The nearest of some names, for hints in the same words elsewhere.
pub fn suggestion(name: &str, names: &[&str], kind: &str) -> String {
    suggest(name, names, kind)
}
