//! Texts with expressions in braces.

use super::Indices;
use crate::context::{Context, Read, Reported};
use crate::tree::Node;
use flexura_expression::{Binding, Expression, ExpressionError, Formula, Kind, nearest};
use std::cell::Cell;
use std::ops::Range;

/// Values further from a whole number than this are none.
const WHOLE: f64 = 1e-6;

/// A text with places to fill.
pub(super) struct Pattern(Vec<Piece>);

enum Piece {
    Literal(String),
    /// The expression over the indices, and where it stands.
    Value(Formula, Range<usize>),
}

/// What stands in braces gave no whole number.
pub(super) struct NotWhole {
    pub range: Range<usize>,
    pub value: f64,
}

impl Pattern {
    /// The text for these values of the indices.
    pub(super) fn fill(&self, slots: &[f64]) -> Result<String, NotWhole> {
        use std::fmt::Write;
        let mut text = String::new();
        for piece in &self.0 {
            match piece {
                Piece::Literal(literal) => text.push_str(literal),
                Piece::Value(formula, range) => {
                    let value = formula.evaluate(slots);
                    let whole = value.round();
                    if !value.is_finite() || (value - whole).abs() > WHOLE || whole.abs() > 1e15 {
                        return Err(NotWhole { range: range.clone(), value });
                    }
                    let _ = write!(text, "{}", whole as i64);
                }
            }
        }
        Ok(text)
    }
}

/// The first pair of braces of a text.
pub(super) fn braces(text: &str) -> Option<Range<usize>> {
    let open = text.find('{')?;
    let close = text[open..].find('}')? + open;
    Some(open..close + 1)
}

/// May the name have been made of a template's name?
pub(crate) fn stands_for(template: &str, name: &str) -> bool {
    // How much of the name may have been made of what lies behind in the template.
    let mut made = vec![0];
    let mut rest = template;
    while let Some(range) = braces(rest) {
        let mut further = Vec::new();
        for end in made {
            let Some(behind) = name[end..].strip_prefix(&rest[..range.start]) else { continue };
            let number = behind.strip_prefix('-').unwrap_or(behind);
            let digits = number.bytes().take_while(u8::is_ascii_digit).count();
            let start = name.len() - number.len();
            further.extend(start + 1..=start + digits);
        }
        further.sort_unstable();
        further.dedup();
        made = further;
        rest = &rest[range.end..];
    }
    made.iter().any(|end| &name[*end..] == rest)
}

/// Understands a text of a template.
pub(super) fn pattern(
    context: &Context<'_>,
    indices: &Indices,
    node: &Node,
    path: &str,
    text: &str,
) -> Read<Pattern> {
    let wrong = |range: Range<usize>, message: &str, hint: &str| {
        context.wrong_with_hint(&context.inner(node, &range), path, message, hint)
    };
    let mut pieces = Vec::new();
    let mut at = 0;
    while let Some(offset) = text[at..].find(['{', '}']) {
        let open = at + offset;
        if text[open..].starts_with('}') {
            let hint = "an expression of the indices stands in braces: `{i+1}`";
            return Err(wrong(open..open + 1, "there is no `{` before this `}`", hint));
        }
        let Some(length) = text[open + 1..].find(['{', '}']) else {
            return Err(wrong(open..open + 1, "this brace is not closed", "close it: `{i}`"));
        };
        let close = open + 1 + length;
        if text[close..].starts_with('{') {
            return Err(wrong(open..open + 1, "this brace is not closed before the next", "close it: `{i}`"));
        }
        pieces.push(Piece::Literal(text[at..open].to_string()));
        let formula = formula(context, indices, node, path, &text[open + 1..close], open + 1)?;
        pieces.push(Piece::Value(formula, open..close + 1));
        at = close + 1;
    }
    pieces.push(Piece::Literal(text[at..].to_string()));
    Ok(Pattern(pieces))
}

/// The expression in a pair of braces, which stands at `from` in the text.
fn formula(
    context: &Context<'_>,
    indices: &Indices,
    node: &Node,
    path: &str,
    text: &str,
    from: usize,
) -> Read<Formula> {
    let silent = Cell::new(false);
    let complain = |error: ExpressionError| {
        if silent.get() {
            return Reported;
        }
        let span = error.span.start + from..error.span.end + from;
        context.expression_error(node, path, &ExpressionError { span, ..error })
    };
    if text.trim().is_empty() {
        let error = ExpressionError::new("there is nothing in these braces", 0..0);
        return Err(complain(error.with_hint("write an expression of the indices: `{i}`")));
    }
    let expression = Expression::parse(text).map_err(&complain)?;
    let lowered = expression.lower(&mut |reference| {
        let name = reference.name();
        if let Some(slot) = name.and_then(|name| indices.slot(name)) {
            return Ok(Binding::Slot(slot, Kind::Plain));
        }
        match name {
            Some(name) if !context.parameters.contains_key(name) => {
                let names = indices.names();
                let known = names.iter().copied().chain(context.parameters.keys().map(String::as_str));
                let hint = match nearest(name, known.take(1000)).filter(|near| near.len() > 1) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("the indices of this table are {}", names.join(", ")),
                };
                let message = format!("there is no index or parameter `{name}`");
                Err(ExpressionError::new(message, reference.span.clone()).with_hint(hint))
            }
            _ => {
                reference.name().into_iter().for_each(|name| context.rules.fix_name(name));
                context.parameter(reference, text, &silent).map(Binding::Value)
            }
        }
    });
    let lowered = lowered.map_err(&complain)?;
    let dimension = lowered.kind.dimension();
    if !dimension.is_number() {
        let error =
            ExpressionError::new(format!("expected a whole number, found {dimension}"), 0..text.len());
        return Err(complain(error.with_hint("write the unit behind the braces: `{i}*10 mm`")));
    }
    Ok(lowered.formula())
}

#[cfg(test)]
mod tests {
    use super::stands_for;

    #[test]
    fn names_are_traced_to_their_template() {
        for (template, name, expected) in [
            ("n_{i}_{j}", "n_3_14", true),
            ("n_{i}_{j}", "n_3_-14", true),
            ("n_{i}_{j}", "n_3_", false),
            ("n_{i}_{j}", "n_3_4x", false),
            ("{i}{j}_end", "314_end", true),
            ("{i}{j}_end", "3_end", false),
            ("plain", "plain", true),
            ("ü{i}é", "ü7é", true),
        ] {
            assert_eq!(stands_for(template, name), expected, "{template} {name}");
        }
        assert!(!stands_for(&"{i}".repeat(60), &format!("{}x", "1".repeat(190))));
    }
}
