//! Files that a file includes: their tables become tables of the file that names them.
//!
//! Every text keeps byte ranges of its own, one behind the other, so that a message shows the file in which a key
//! stands. A file that is reached in two ways is taken once.

use crate::report::{Included, Problem, Report, Source, Texts, find};
use crate::tree::{self, Entry, Node, Value};
use crate::{file, syntax};
use std::ops::Range;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use toml::de::DeTable;

/// Most files of a model.
const MOST: usize = 100;

/// Where the texts of included files come from.
#[derive(Clone, Copy)]
pub(crate) enum Files<'a> {
    /// The file system.
    Disk,
    /// Texts by their paths, as seen from the folder of the first file.
    Held(&'a [(&'a str, &'a str)]),
}

/// A file on the way to the one at hand.
struct Link {
    source: Arc<Source>,
    path: PathBuf,
}

/// What has been read so far.
struct Gathering<'a> {
    main: Arc<Source>,
    files: Files<'a>,
    included: Vec<Included>,
    /// The files that are included, by what tells them apart.
    taken: Vec<PathBuf>,
    /// Where the next text begins in the byte ranges.
    next: usize,
    problems: Vec<Problem>,
}

/// The tables of a file with those of the files that it includes.
pub(crate) fn gather(
    source: Arc<Source>,
    path: &Path,
    folder: &Path,
    files: Files<'_>,
) -> Result<(Texts, Node), Report> {
    let mut root = parse(&source)?;
    let mut gathering = Gathering {
        main: source.clone(),
        files,
        included: Vec::new(),
        taken: Vec::new(),
        next: source.text.len() + 1,
        problems: Vec::new(),
    };
    let mut chain = vec![Link { source: source.clone(), path: identity(path, files) }];
    gathering.resolve(&mut root, 0, folder, &mut chain)?;
    if !gathering.problems.is_empty() {
        return Err(Report::input(gathering.problems));
    }
    let texts = Texts {
        file: source,
        folder: folder.to_path_buf(),
        included: gathering.included.into(),
        typed: None,
    };
    Ok((texts, root))
}

/// The tree of one file, whose format is known.
fn parse(source: &Arc<Source>) -> Result<Node, Report> {
    let at = |span, path: &str, message: String| Problem::at(source, span, path, message);
    if source.text.len() as u64 > file::LARGEST {
        return Err(Report::input(vec![Problem::of_file(&source.name, "the text is larger than 16 MiB")]));
    }
    let (table, errors) = DeTable::parse_recoverable(&source.text);
    if !errors.is_empty() {
        let errors: Vec<_> =
            errors.iter().map(|error| (error.span().unwrap_or(0..0), error.message())).collect();
        return Err(Report::input(syntax::problems(source, &errors)));
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
                Some(near) => format!("a model file begins with `format = 1`; is `{near}` meant to be it?"),
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
        Some(_) => Ok(root),
    }
}

impl Gathering<'_> {
    /// Puts the tables of all included files before those of `root`, whose text begins at `start`.
    fn resolve(
        &mut self,
        root: &mut Node,
        start: usize,
        folder: &Path,
        chain: &mut Vec<Link>,
    ) -> Result<(), Report> {
        let Value::Table(entries) = &mut root.value else { return Ok(()) };
        let included = entries.iter().position(|entry| entry.key == "include").map(|i| entries.remove(i));
        let mut own = std::mem::take(entries);
        let mut all: Vec<Entry> = Vec::new();
        if let (Some(entry), Some(source)) = (included, chain.last().map(|link| link.source.clone())) {
            for (name, span) in names(&entry, &source)? {
                if let Some(part) = self.part(name, &span, &source, folder, chain)? {
                    self.merge(&mut all, part, "");
                }
            }
        }
        for entry in &mut own {
            shift_entry(entry, start);
        }
        self.merge(&mut all, own, "");
        *entries = all;
        Ok(())
    }

    /// The tables of one included file. None: it is there already.
    fn part(
        &mut self,
        name: &str,
        span: &Range<usize>,
        source: &Arc<Source>,
        folder: &Path,
        chain: &mut Vec<Link>,
    ) -> Result<Option<Vec<Entry>>, Report> {
        let path = folder.join(name);
        let refused = |message: String, hint: String| {
            Report::input(vec![Problem::at(source, span.clone(), "include", message).hint(hint)])
        };
        let own = identity(&path, self.files);
        if let Some(first) = chain.iter().position(|link| link.path == own) {
            let names: Vec<&str> = chain[first..].iter().map(|link| link.source.name.as_str()).collect();
            let message = match names.as_slice() {
                [first, _, ..] => {
                    format!("the files include each other in a circle: {} -> {first}", names.join(" -> "))
                }
                _ => "the file includes itself".to_string(),
            };
            return Err(refused(message, "put what both need into a file of its own".to_string()));
        }
        if self.taken.contains(&own) {
            return Ok(None);
        }
        if self.taken.len() == MOST {
            let message = format!("a model may have at most {MOST} files besides the first");
            return Err(refused(message, "put some of them together".to_string()));
        }
        let text = read(&path, self.files)
            .map_err(|why| refused(format!("cannot read `{name}`: {why}"), way(chain)))?;
        self.taken.push(own.clone());
        let part = Arc::new(Source { name: path.display().to_string(), text });
        let start = self.next;
        self.next += part.text.len() + 1;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        self.included.push(Included { start, source: part.clone(), folder: folder.clone() });
        let mut root = parse(&part)?;
        chain.push(Link { source: part, path: own });
        self.resolve(&mut root, start, &folder, chain)?;
        chain.pop();
        let Value::Table(mut entries) = root.value else { return Ok(None) };
        // Every file says for itself which format it has.
        entries.retain(|entry| entry.key != "format");
        Ok(Some(entries))
    }

    /// Adds tables to tables; what is given twice is told with both places.
    fn merge(&mut self, into: &mut Vec<Entry>, from: Vec<Entry>, path: &str) {
        for entry in from {
            let Some(first) = into.iter_mut().find(|other| other.key == entry.key) else {
                into.push(entry);
                continue;
            };
            let path = if path.is_empty() { entry.key.clone() } else { format!("{path}.{}", entry.key) };
            match (&mut first.node.value, entry.node.value) {
                (Value::Table(into), Value::Table(from)) => self.merge(into, from, &path),
                _ => self.twice(&first.key_span, &entry.key_span, &path),
            }
        }
    }

    fn twice(&mut self, first: &Range<usize>, second: &Range<usize>, path: &str) {
        let (source, within) = find(&self.main, &self.included, first);
        let line = source.text[..within.start].matches('\n').count() + 1;
        let hint = format!("it stands first in {}, line {line}; remove one of the two", source.name);
        let (source, within) = find(&self.main, &self.included, second);
        let problem = Problem::at(source, within, path, format!("the key `{path}` is given twice"));
        self.problems.push(problem.hint(hint));
    }
}

/// The names in `include`, with their places.
fn names<'e>(entry: &'e Entry, source: &Arc<Source>) -> Result<Vec<(&'e str, Range<usize>)>, Report> {
    let wrong = |node: &Node, message: String| {
        let hint = "for example `include = [\"parts/materials.toml\"]`, as seen from the folder of this file";
        Report::input(vec![Problem::at(source, node.span.clone(), "include", message).hint(hint)])
    };
    let list = match &entry.node.value {
        Value::List(list) => list.iter().collect(),
        _ => vec![&entry.node],
    };
    let name = |node: &'e Node| match &node.value {
        Value::Text(text) if text.trim().is_empty() => Err(wrong(node, "this names no file".to_string())),
        Value::Text(text) => Ok((text.as_str(), node.span.clone())),
        _ => Err(wrong(node, format!("expected the name of a file, found {}", node.kind()))),
    };
    list.into_iter().map(name).collect()
}

/// Which files led to the last one, for a hint.
fn way(chain: &[Link]) -> String {
    let hint = "the path is relative to the folder of the file that includes it";
    match chain {
        [] | [_] => hint.to_string(),
        chain => {
            let names: Vec<&str> = chain.iter().map(|link| link.source.name.as_str()).collect();
            format!("{hint}; the way here is {}", names.join(" -> "))
        }
    }
}

fn read(path: &Path, files: Files<'_>) -> Result<String, String> {
    match files {
        Files::Disk => file::included(path),
        Files::Held(held) => {
            let wanted = plain(path);
            let found = held.iter().find(|(name, _)| plain(Path::new(name)) == wanted);
            found.map(|(_, text)| (*text).to_string()).ok_or_else(|| "there is no such file".to_string())
        }
    }
}

/// What tells a file apart from others, whatever way it is reached.
fn identity(path: &Path, files: Files<'_>) -> PathBuf {
    let plain = plain(path);
    match files {
        Files::Disk => std::fs::canonicalize(path).unwrap_or(plain),
        Files::Held(_) => plain,
    }
}

/// A path without `.` and `..`, as far as that is possible.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if plain.file_name().is_some() => {
                plain.pop();
            }
            part => plain.push(part),
        }
    }
    plain
}

/// Moves the byte ranges to where the text stands.
fn shift(node: &mut Node, by: usize) {
    node.span = node.span.start + by..node.span.end + by;
    match &mut node.value {
        Value::List(list) => list.iter_mut().for_each(|node| shift(node, by)),
        Value::Table(entries) => entries.iter_mut().for_each(|entry| shift_entry(entry, by)),
        _ => {}
    }
}

fn shift_entry(entry: &mut Entry, by: usize) {
    entry.key_span = entry.key_span.start + by..entry.key_span.end + by;
    shift(&mut entry.node, by);
}
