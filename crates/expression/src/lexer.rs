//! Text to tokens.

use crate::ExpressionError;
use std::ops::Range;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Token {
    Number(f64),
    /// An identifier, or one of the unit signs % and °.
    Name,
    /// A quoted text; the span includes the quotes.
    Quoted,
    /// One of + - * / ^ ( ) [ ] , .
    Sign(char),
    End,
}

#[derive(Clone, Debug)]
pub(crate) struct Spanned {
    pub token: Token,
    pub span: Range<usize>,
}

/// Tokens of `text[range]`, spans counted in `text`, closed by [`Token::End`].
pub(crate) fn tokens(text: &str, range: Range<usize>) -> Result<Vec<Spanned>, ExpressionError> {
    let mut list = Vec::new();
    let mut at = range.start;
    let end = range.end;
    while at < end {
        let rest = &text[at..end];
        let Some(first) = rest.chars().next() else { break };
        let (token, length) = if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        } else if first.is_ascii_digit()
            || (first == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit()))
        {
            number(rest, at)?
        } else if first.is_alphabetic() || first == '_' {
            let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            (Token::Name, length)
        } else if first == '%' || first == '°' {
            (Token::Name, first.len_utf8())
        } else if first == '"' || first == '\'' {
            let Some(close) = rest[1..].find(first) else {
                return Err(ExpressionError::new(format!("the quote {first} is not closed"), at..end));
            };
            (Token::Quoted, close + 2)
        } else if "+-*/^()[],.".contains(first) {
            (Token::Sign(first), 1)
        } else if first == '·' || first == '⋅' || first == '×' {
            (Token::Sign('*'), first.len_utf8())
        } else if first == '−' {
            (Token::Sign('-'), first.len_utf8())
        } else {
            let shown: String = first.escape_default().collect();
            let shown = if first.is_control() { shown } else { first.to_string() };
            let error = ExpressionError::new(
                format!("`{shown}` has no meaning in an expression"),
                at..at + first.len_utf8(),
            );
            return Err(match instead(first) {
                Some(hint) => error.with_hint(hint),
                None => error,
            });
        };
        list.push(Spanned { token, span: at..at + length });
        at += length;
    }
    list.push(Spanned { token: Token::End, span: end..end });
    Ok(list)
}

/// What to write in the place of a sign that people use elsewhere.
fn instead(sign: char) -> Option<&'static str> {
    match sign {
        '⁻' | '⁺' | '⁰'..='⁹' | '¹' | '²' | '³' => {
            Some("a power is written with `^`: `mm^2`, `s^-1`")
        }
        '÷' | '∕' | '⁄' => Some("a quotient is written with `/`"),
        '√' => Some("a root is written `sqrt(...)`"),
        '=' => Some("an expression is one side only"),
        '{' | '}' => Some("brackets of an expression are round; `{...}` is for the names of repeated tables"),
        _ => None,
    }
}

/// A number at the beginning of `rest`. An exponent needs a digit, so that `2 em` stays a number and a name.
fn number(rest: &str, at: usize) -> Result<(Token, usize), ExpressionError> {
    let bytes = rest.as_bytes();
    let digits = |mut i: usize| {
        while bytes.get(i).is_some_and(u8::is_ascii_digit) {
            i += 1;
        }
        i
    };
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length = digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        if exponent > length + 1 + sign {
            length = exponent;
        }
    }
    match rest[..length].parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((Token::Number(value), length)),
        _ => Err(ExpressionError::new(
            format!("`{}` is too large for a number", &rest[..length]),
            at..at + length,
        )),
    }
}
