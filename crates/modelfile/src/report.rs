//! What is wrong with an input: a list of problems, each with its place, shown as a compiler would.

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use flexura_model::{visible, visible_lines};
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Problems beyond this many are counted only.
pub(crate) const MOST: usize = 30;
/// Longer lines are not shown.
const LONGEST_LINE: usize = 4_000;

/// Is the input wrong, or could it not be read?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReportKind {
    /// The input is wrong.
    Input,
    /// The machine failed to hand over the input.
    Io,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Nothing can be solved.
    Error,
    /// Something that looks unintended.
    Warning,
}

/// A text that problems point into.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Source {
    pub name: String,
    pub text: String,
}

/// A file that the first one includes, and where its text begins in the byte ranges.
#[derive(Clone, Debug)]
pub(crate) struct Included {
    pub start: usize,
    pub source: Arc<Source>,
    pub folder: PathBuf,
}

/// The text of the file and, as if they stood behind it, those of the files that it includes and what was typed on the
/// command line: byte ranges beyond the file belong to these. The byte between two texts belongs to none.
#[derive(Clone, Debug)]
pub(crate) struct Texts {
    pub file: Arc<Source>,
    pub folder: PathBuf,
    pub included: Arc<[Included]>,
    pub typed: Option<Arc<Source>>,
}

/// The text in which a byte range lies, and the range within it.
pub(crate) fn find<'s>(
    file: &'s Arc<Source>,
    included: &'s [Included],
    span: &Range<usize>,
) -> (&'s Arc<Source>, Range<usize>) {
    match included.iter().rfind(|part| part.start <= span.start) {
        Some(part) => (&part.source, span.start - part.start..span.end.max(span.start) - part.start),
        None => (file, span.clone()),
    }
}

impl Texts {
    /// Where the typed text begins.
    pub(crate) fn typed_start(&self) -> usize {
        match self.included.last() {
            Some(part) => part.start + part.source.text.len() + 1,
            None => self.file.text.len() + 1,
        }
    }

    fn find(&self, span: &Range<usize>) -> (&Arc<Source>, Range<usize>) {
        let start = self.typed_start();
        match &self.typed {
            Some(typed) if span.start >= start => (typed, span.start - start..span.end - start),
            _ => find(&self.file, &self.included, span),
        }
    }

    /// Does what stands at a byte range stand in a file that is included?
    pub(crate) fn is_included(&self, span: &Range<usize>) -> bool {
        self.included.first().is_some_and(|part| part.start <= span.start) && span.start < self.typed_start()
    }

    /// The folder in which files are looked for that are named at a byte range.
    pub(crate) fn folder(&self, span: &Range<usize>) -> &Path {
        let part = self.included.iter().rfind(|part| part.start <= span.start);
        part.filter(|_| self.is_included(span)).map_or(&self.folder, |part| &part.folder)
    }

    /// What stands at a byte range.
    pub(crate) fn get(&self, span: &Range<usize>) -> Option<&str> {
        let (source, span) = self.find(span);
        source.text.get(span)
    }

    /// A problem at a byte range. What was typed has no key in the file, so none is named there.
    pub(crate) fn problem(&self, span: Range<usize>, path: &str, message: impl Into<String>) -> Problem {
        let (source, within) = self.find(&span);
        let is_typed = self.typed.as_ref().is_some_and(|typed| Arc::ptr_eq(source, typed));
        let offset = span.start - within.start;
        Problem { offset, ..Problem::at(source, within, if is_typed { "" } else { path }, message) }
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Error or warning.
    pub severity: Severity,
    /// The file, or `--set` for an override.
    pub file: String,
    /// Line, from 1; 0 where the problem is not in a line.
    pub line: usize,
    /// Column in characters, from 1; 0 where the problem is not in a line.
    pub column: usize,
    /// Byte range in the file.
    pub span: Range<usize>,
    /// The key: `beam.link.length`; empty where there is none.
    pub path: String,
    /// The text that stands there, shortened.
    pub value: String,
    /// What is wrong, one sentence.
    pub message: String,
    /// What to do about it, if that is clear.
    pub hint: Option<String>,
    pub(crate) source: Option<Arc<Source>>,
    /// Where the text begins in the byte ranges of all texts.
    pub(crate) offset: usize,
}

impl Problem {
    /// A problem at a place in a text.
    pub(crate) fn at(
        source: &Arc<Source>,
        span: Range<usize>,
        path: &str,
        message: impl Into<String>,
    ) -> Self {
        let text = &source.text;
        let start = floor(text, span.start);
        let end = floor(text, span.end.max(span.start));
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let mut value: String = text[start..end].chars().take(60).collect();
        if value.len() < end - start {
            value.push_str("...");
        }
        Self {
            severity: Severity::Error,
            file: source.name.clone(),
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            span: start..end,
            path: path.to_string(),
            value,
            // An empty name would be read as nothing.
            message: message.into().replace("``", "of an empty name"),
            hint: None,
            source: Some(source.clone()),
            offset: 0,
        }
    }

    /// A problem of a file as a whole.
    pub(crate) fn of_file(file: &str, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            file: file.to_string(),
            line: 0,
            column: 0,
            span: 0..0,
            path: String::new(),
            value: String::new(),
            message: message.into(),
            hint: None,
            source: None,
            offset: 0,
        }
    }

    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    pub(crate) fn warning(mut self) -> Self {
        self.severity = Severity::Warning;
        self
    }

    /// Its byte range among all texts, by its two ends.
    pub(crate) fn place(&self) -> (usize, usize) {
        (self.offset + self.span.start, self.offset + self.span.end)
    }

    /// The problem as a compiler would show it, with the line it stands in.
    pub fn render(&self, colour: bool) -> String {
        let level = match self.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let (message, path, file) = (visible_lines(&self.message), visible(&self.path), visible(&self.file));
        let mut group = Group::with_title(level.primary_title(&*message));
        let line = self.source.as_ref().map(|source| self.line_of(source));
        match (&self.source, line) {
            (Some(source), Some(line)) if line.len() <= LONGEST_LINE => {
                let text = &source.text[line.clone()];
                let from = self.span.start - line.start;
                // A span over several lines is shown by its first line.
                let to = (self.span.end - line.start).clamp(from, line.len());
                let to = visible_lines(&text[..to]).len();
                let from = visible_lines(&text[..from]).len();
                let mut annotation = AnnotationKind::Primary.span(from..to);
                if !self.path.is_empty() {
                    annotation = annotation.label(&*path);
                }
                let snippet = Snippet::source(visible_lines(text))
                    .line_start(self.line)
                    .path(&*file)
                    .annotation(annotation);
                group = group.element(snippet);
            }
            _ => {
                let mut origin = Origin::path(&*file);
                if self.line > 0 {
                    origin = origin.line(self.line).char_column(self.column);
                }
                group = group.element(origin);
            }
        }
        let hint = self.hint.as_deref().map(visible_lines);
        if let Some(hint) = &hint {
            group = group.element(Level::HELP.message(&**hint));
        }
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        renderer.decor_style(DecorStyle::Ascii).render(&[group])
    }

    /// The byte range of the line in which the problem begins.
    fn line_of(&self, source: &Source) -> Range<usize> {
        let text = &source.text;
        let start = text[..self.span.start].rfind('\n').map_or(0, |i| i + 1);
        let end = text[self.span.start..].find('\n').map_or(text.len(), |i| self.span.start + i);
        let end = if text[start..end].ends_with('\r') { end - 1 } else { end };
        start.min(end)..end.max(self.span.start)
    }
}

/// The nearest character boundary at or before a byte.
fn floor(text: &str, byte: usize) -> usize {
    let mut byte = byte.min(text.len());
    while !text.is_char_boundary(byte) {
        byte -= 1;
    }
    byte
}

/// Why an input cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    kind: ReportKind,
    problems: Vec<Problem>,
    omitted: usize,
}

impl Report {
    pub(crate) fn input(problems: Vec<Problem>) -> Self {
        let count = problems.len();
        Self::input_of(problems, count)
    }

    /// Some problems of `count`.
    pub(crate) fn input_of(mut problems: Vec<Problem>, count: usize) -> Self {
        let omitted = count.saturating_sub(MOST);
        problems.truncate(MOST);
        Self { kind: ReportKind::Input, problems, omitted }
    }

    pub(crate) fn one(kind: ReportKind, problem: Problem) -> Self {
        Self { kind, problems: vec![problem], omitted: 0 }
    }

    /// Is the input wrong, or could it not be read?
    pub fn kind(&self) -> ReportKind {
        self.kind
    }

    /// What is wrong, at least one problem.
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// How many further problems were found but not kept.
    pub fn omitted(&self) -> usize {
        self.omitted
    }

    /// All problems as a compiler would show them.
    pub fn render(&self, colour: bool) -> String {
        let mut text: Vec<String> = self.problems.iter().map(|problem| problem.render(colour)).collect();
        if self.omitted > 0 {
            text.push(format!("... and {} more", self.omitted));
        }
        text.join("\n\n") + "\n"
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Report {}
