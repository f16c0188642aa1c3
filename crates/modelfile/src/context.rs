//! What every reader shares: the text, the parameters, the names, and the problems found so far.

use crate::format::Named;
use crate::repeat::{Copies, Expanded};
use crate::report::{MOST, Problem, Report, Texts};
use crate::rules::Rules;
use crate::tree::{Node, Value};
use flexura_expression::{
    Binding, Expression, ExpressionError, Kind, Lowered, Quantity, Reference, function_table, nearest,
    respelled,
};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A problem has been recorded; whoever gets this need not say more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reported;

pub(crate) type Read<T> = Result<T, Reported>;

/// Turns "missing" into [`Reported`] where a key is required: that was recorded on opening the table.
pub(crate) trait Needed<T> {
    fn needed(self) -> Read<T>;
}

impl<T> Needed<T> for Read<Option<T>> {
    fn needed(self) -> Read<T> {
        self?.ok_or(Reported)
    }
}

/// A parameter's value; None where it is wrong, which has been recorded.
pub(crate) type Parameters = BTreeMap<String, Option<Quantity>>;

pub(crate) struct Context<'a> {
    pub texts: &'a Texts,
    pub root: &'a Node,
    pub parameters: Parameters,
    names: BTreeMap<Named, BTreeMap<&'a str, usize>>,
    problems: RefCell<Vec<Problem>>,
    count: Cell<usize>,
    used: RefCell<BTreeSet<(&'static str, String)>>,
    copies: Option<&'a Copies>,
    /// Are parameters overridden?
    pub is_overridden: bool,
    /// How often the same place was wrong in the copies of a table, by its byte range.
    alike: RefCell<BTreeMap<(usize, usize), usize>>,
    /// Names of parameters that cannot be told from units, constants and functions; each was recorded.
    pub misnamed: BTreeSet<String>,
    /// What can be read but is hardly meant: place, path, message, hint. Only so many are kept.
    doubts: RefCell<Vec<Doubt>>,
    /// How numbers follow from parameters.
    pub rules: Rules,
}

/// Something that can be read but is hardly meant.
#[derive(Clone, Debug)]
pub(crate) struct Doubt {
    pub span: Range<usize>,
    pub path: String,
    pub message: String,
    pub hint: String,
}

impl<'a> Context<'a> {
    pub(crate) fn new(texts: &'a Texts, root: &'a Node) -> Self {
        Self {
            texts,
            root,
            parameters: Parameters::new(),
            names: names(root),
            problems: RefCell::new(Vec::new()),
            count: Cell::new(0),
            used: RefCell::new(BTreeSet::new()),
            copies: None,
            is_overridden: false,
            alike: RefCell::new(BTreeMap::new()),
            misnamed: BTreeSet::new(),
            doubts: RefCell::new(Vec::new()),
            rules: Rules::new(root),
        }
    }

    /// The same context over a tree in which repeated tables are written out.
    pub(crate) fn over<'b>(self, expanded: &'b Expanded) -> Context<'b>
    where
        'a: 'b,
    {
        Context {
            root: &expanded.root,
            names: names(&expanded.root),
            copies: Some(&expanded.copies),
            is_overridden: self.is_overridden,
            texts: self.texts,
            parameters: self.parameters,
            problems: self.problems,
            count: self.count,
            used: self.used,
            alike: self.alike,
            misnamed: self.misnamed,
            doubts: self.doubts,
            rules: self.rules,
        }
    }

    /// Does the path lead into a copy of a repeated table?
    pub(crate) fn is_copy(&self, path: &str) -> bool {
        self.copies.is_some_and(|copies| copies.is_copy(path))
    }

    /// Was the same told of another copy of the table?
    pub(crate) fn is_told(&self, span: &Range<usize>, path: &str) -> bool {
        self.is_copy(path) && self.alike.borrow().contains_key(&(span.start, span.end))
    }

    /// Records a problem; beyond the most that are kept, it is only counted.
    pub(crate) fn record(&self, problem: Problem) -> Reported {
        if self.is_copy(&problem.path) {
            // A mistake of the template is told once, however many copies have it.
            let mut alike = self.alike.borrow_mut();
            let count = alike.entry(problem.place()).or_insert(0);
            *count += 1;
            if *count > 1 {
                return Reported;
            }
        }
        let full = self.is_full();
        self.count.set(self.count.get() + 1);
        // The list is sorted by place only later, hence some slack.
        if !full {
            self.problems.borrow_mut().push(problem);
        }
        Reported
    }

    /// Are there so many problems that further ones are only counted?
    pub(crate) fn is_full(&self) -> bool {
        self.count.get() >= 4 * MOST
    }

    pub(crate) fn problem(&self, span: &Range<usize>, path: &str, message: impl Into<String>) -> Problem {
        let copy = self.copies.and_then(|copies| copies.values(path));
        // Finding line and column takes a walk through the text; not where no one will see them.
        if self.is_told(span, path) {
            let mut problem = Problem::of_file(&self.texts.file.name, message);
            (problem.path, problem.span) = (path.to_string(), span.clone());
            return problem;
        }
        if self.is_full() {
            return Problem::of_file(&self.texts.file.name, message);
        }
        let mut problem = self.texts.problem(span.clone(), path, message);
        if let Some(values) = copy {
            problem.message.push_str(&format!(" (for {values})"));
        }
        problem
    }

    /// Notes what can be read but is hardly meant, once for each place.
    pub(crate) fn doubt(&self, doubt: Doubt) {
        let mut doubts = self.doubts.borrow_mut();
        if doubts.len() < 4 * MOST && doubts.iter().all(|other| other.span != doubt.span) {
            doubts.push(doubt);
        }
    }

    /// What was noted, as warnings.
    pub(crate) fn doubts(&self) -> Vec<Problem> {
        let warning = |doubt: &Doubt| {
            let problem = self.texts.problem(doubt.span.clone(), &doubt.path, doubt.message.clone());
            problem.hint(doubt.hint.clone()).warning()
        };
        self.doubts.borrow().iter().map(warning).collect()
    }

    /// Records a problem of the model file.
    pub(crate) fn wrong(&self, span: &Range<usize>, path: &str, message: impl Into<String>) -> Reported {
        self.record(self.problem(span, path, message))
    }

    pub(crate) fn wrong_with_hint(
        &self,
        span: &Range<usize>,
        path: &str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Reported {
        self.record(self.problem(span, path, message).hint(hint))
    }

    pub(crate) fn any_problem(&self) -> bool {
        self.count.get() > 0
    }

    /// How many problems there are, for [`Context::forget`].
    pub(crate) fn count(&self) -> usize {
        self.count.get()
    }

    /// Drops the problems that were recorded since there were so many.
    pub(crate) fn forget(&self, count: usize) {
        self.count.set(count);
        self.problems.borrow_mut().truncate(count);
    }

    /// What was found, in the order of the file.
    pub(crate) fn into_report(self) -> Report {
        let count = self.count.get();
        let alike = self.alike.into_inner();
        let mut problems = self.problems.into_inner();
        for problem in &mut problems {
            let count = alike.get(&problem.place()).copied().unwrap_or(1);
            if count > 1 && problem.message.ends_with(')') {
                problem.message.pop();
                let copies = if count == 2 { "another copy" } else { "more copies" };
                let how_many = if count == 2 { String::new() } else { format!("{} ", count - 1) };
                problem.message.push_str(&format!("; and so in {how_many}{copies})"));
            }
        }
        let kept = problems.len();
        problems.sort_by_key(|problem| {
            let is_elsewhere =
                problem.source.as_ref().is_none_or(|source| source.name != self.texts.file.name);
            (is_elsewhere && problem.offset == 0, problem.place())
        });
        // One mistake may be met twice, as in an output of three components.
        problems.dedup();
        let count = count - (kept - problems.len());
        Report::input_of(problems, count)
    }

    /// Names that something refers to, by kind.
    pub(crate) fn is_used(&self, word: &'static str, name: &str) -> bool {
        self.used.borrow().contains(&(word, name.to_string()))
    }

    pub(crate) fn mark_used(&self, word: &'static str, name: &str) {
        self.used.borrow_mut().insert((word, name.to_string()));
    }

    pub(crate) fn position(&self, named: Named, name: &str) -> Option<usize> {
        self.mark_used(named.word(), name);
        let key = if named == Named::BodyOrGround { Named::Body } else { named };
        self.names.get(&key).and_then(|names| names.get(name)).copied()
    }

    pub(crate) fn names(&self, named: Named) -> Vec<&'a str> {
        let key = if named == Named::BodyOrGround { Named::Body } else { named };
        let mut names: Vec<&str> =
            self.names.get(&key).map(|names| names.keys().copied().collect()).unwrap_or_default();
        if named == Named::BodyOrGround {
            names.push("ground");
        }
        names
    }

    /// There is nothing of this name.
    pub(crate) fn unknown_name(&self, named: Named, name: &str) -> (String, String) {
        let word = named.noun();
        if self.is_full() {
            return (String::new(), String::new());
        }
        (format!("there is no {word} `{name}`"), suggest(name, &self.names(named), word))
    }

    /// The value of a parameter; an error with a hint if there is none. `silent` is set where its own
    /// mistake was recorded before.
    pub(crate) fn parameter(
        &self,
        reference: &Reference,
        text: &str,
        silent: &Cell<bool>,
    ) -> Result<Quantity, ExpressionError> {
        let Some(name) = reference.name() else {
            let shown = &text[reference.span.clone()];
            return Err(ExpressionError::new(
                format!("`{shown}` cannot be used here"),
                reference.span.clone(),
            )
            .with_hint(
                "results such as `body.slider.position.x` can only be used in [output], [target] and the events of studies",
            ));
        };
        self.mark_used("parameter", name);
        match self.parameters.get(name) {
            Some(Some(quantity)) => Ok(*quantity),
            Some(None) => {
                silent.set(true);
                Err(ExpressionError::new(String::new(), reference.span.clone()))
            }
            None => {
                if self.is_full() {
                    return Err(ExpressionError::new(String::new(), reference.span.clone()));
                }
                let names: Vec<&str> = self.parameters.keys().map(String::as_str).collect();
                Err(no_parameter(name, &names, reference.span.clone()))
            }
        }
    }

    /// Records what is wrong with an expression that stands in `node`.
    pub(crate) fn expression_error(&self, node: &Node, path: &str, error: &ExpressionError) -> Reported {
        // Of a parameter that bears the name of a unit it was told where it is declared.
        if let Value::Text(text) = &node.value
            && text.get(error.span.clone()).is_some_and(|name| self.misnamed.contains(name))
        {
            return Reported;
        }
        let span = self.inner(node, &error.span);
        let mut problem = self.problem(&span, path, error.message.clone());
        problem.hint = error.hint.clone();
        self.record(problem)
    }

    /// The byte range in the file of a range within a text value. Where escapes make the two differ, the
    /// whole value.
    pub(crate) fn inner(&self, node: &Node, range: &Range<usize>) -> Range<usize> {
        let Value::Text(text) = &node.value else { return node.span.clone() };
        let Some(raw) = self.texts.get(&node.span) else { return node.span.clone() };
        let Some(offset) = raw.find(text.as_str()).filter(|_| !text.is_empty()) else {
            return node.span.clone();
        };
        let start = node.span.start + offset + range.start;
        let end = node.span.start + offset + range.end;
        if start == end { start.saturating_sub(1).max(node.span.start)..end.max(start) } else { start..end }
    }

    /// Parses and binds an expression of parameters, and perhaps of a variable.
    pub(crate) fn lower(
        &self,
        node: &Node,
        path: &str,
        text: &str,
        variable: Option<(&str, Kind)>,
    ) -> Read<Lowered> {
        let parsed = match variable {
            Some((name, _)) => Expression::parse_with_variable(text, name),
            None => Expression::parse(text),
        };
        let expression = parsed.map_err(|error| self.expression_error(node, path, &error))?;
        let silent = Cell::new(false);
        let lowered = expression.lower(&mut |reference| match variable {
            Some((name, kind)) if reference.name() == Some(name) => Ok(Binding::Variable(kind)),
            _ => self.parameter(reference, text, &silent).map(Binding::Value),
        });
        let lowered = lowered.map_err(|error| {
            if silent.get() {
                return Reported;
            }
            self.expression_error(node, path, &error)
        })?;
        self.rules.record(path, &expression, variable.map(|(name, _)| name));
        Ok(lowered)
    }

    /// [`Context::lower`], trying the variable as a plain number in SI units, then with its dimension; only the
    /// last failure is reported.
    pub(crate) fn lower_either(
        &self,
        node: &Node,
        path: &str,
        text: &str,
        variable: &str,
        kind: Kind,
    ) -> Read<Lowered> {
        if let Ok(expression) = Expression::parse_with_variable(text, variable) {
            let silent = Cell::new(false);
            let lower = |kind: Kind| {
                expression.lower(&mut |reference| match reference.name() {
                    Some(name) if name == variable => Ok(Binding::Variable(kind)),
                    _ => self.parameter(reference, text, &silent).map(Binding::Value),
                })
            };
            let plain = lower(Kind::Plain);
            if silent.get() {
                return Err(Reported);
            }
            if let Ok(plain) = plain {
                // `cos(30*s)` can only be meant for a plain number, whatever stands before it.
                let accepted = plain.kind == Kind::Plain
                    || plain.constant().is_some()
                    || lower(kind).is_err_and(|error| is_call(&text[error.span.clone()]));
                if accepted {
                    self.rules.record(path, &expression, Some(variable));
                    return Ok(plain);
                }
            }
        }
        self.lower(node, path, text, Some((variable, kind)))
    }

    /// A constant: a number, or an expression of parameters.
    pub(crate) fn quantity(&self, node: &Node, path: &str, infinite: bool) -> Read<Option<Quantity>> {
        let quantity = match &node.value {
            Value::Number(value) => Quantity::plain(*value),
            Value::Text(text) => {
                let lowered = self.lower(node, path, text, None)?;
                if let Some(span) = &lowered.not_finite {
                    let span = self.inner(node, span);
                    return Err(self.wrong(&span, path, "the expression gives no finite number"));
                }
                Quantity { value: lowered.constant().unwrap_or(f64::NAN), kind: lowered.kind }
            }
            _ => return Ok(None),
        };
        if quantity.value.is_nan() {
            return Err(self.wrong(&node.span, path, "NaN is not a number"));
        }
        if quantity.value.is_infinite() && !infinite {
            return Err(self.wrong(&node.span, path, "must be a finite number"));
        }
        Ok(Some(quantity))
    }
}

/// The position of every named thing in its list, by kind.
fn names(root: &Node) -> BTreeMap<Named, BTreeMap<&str, usize>> {
    let mut names = BTreeMap::new();
    let kinds = [
        Named::Material,
        Named::Section,
        Named::Beam,
        Named::Body,
        Named::Joint,
        Named::Spring,
        Named::Cable,
        Named::Tubes,
    ];
    for named in kinds {
        let entries = root.get(named.word()).map_or(&[][..], |entry| entry.node.entries());
        let positions = entries.iter().enumerate().map(|(i, entry)| (entry.key.as_str(), i)).collect();
        names.insert(named, positions);
    }
    names
}

/// Does the text begin with the call of a function?
fn is_call(text: &str) -> bool {
    function_table()
        .any(|(name, _)| text.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('(')))
}

/// A name that no parameter bears; it may be a unit in another spelling, as in `N/mm2`.
pub(crate) fn no_parameter(name: &str, names: &[&str], span: Range<usize>) -> ExpressionError {
    match respelled(name) {
        Some(written) => ExpressionError::new(format!("there is no parameter and no unit `{name}`"), span)
            .with_hint(format!("did you mean `{written}`?")),
        None => ExpressionError::new(format!("there is no parameter `{name}`"), span).with_hint(suggest(
            name,
            names,
            "parameter",
        )),
    }
}

/// "did you mean ...", or what there is.
pub(crate) fn suggest(name: &str, names: &[&str], word: &str) -> String {
    // Among very many names, comparing each would take longer than the hint is worth.
    if let Some(near) = nearest(name, names.iter().copied().take(2000)) {
        return format!("did you mean `{near}`?");
    }
    match names {
        [] => format!("the file defines no {word}"),
        [only] => format!("the only {word} is `{only}`"),
        _ if names.len() <= 8 => {
            let list: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            format!("there are {}", list.join(", "))
        }
        _ => format!("the file defines {} of the kind {word}", names.len()),
    }
}
