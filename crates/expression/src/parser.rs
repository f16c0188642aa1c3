//! Tokens to the postfix list, by operator precedence (Pratt).
//!
//! The unit grammar: directly behind a number, `factor (('*' | '/' | nothing) factor)*` with
//! `factor = symbol ['^' exponent]`, as far as the names are units. Since no parameter bears the name of a
//! unit, `1 N*m` is a product of units and `1 N*push` is a product of a force and a parameter.

use crate::expression::{Binary, CONSTANTS, Call, Item, Node};
use crate::lexer::{Spanned, Token, tokens};
use crate::spelling::respelled;
use crate::unit::symbols;
use crate::{Dimension, Expression, ExpressionError, Kind, Reference, Segment, Unit, nearest, unit};
use std::ops::Range;

/// Longest text, bytes.
const LONGEST: usize = 20_000;
/// Deepest nesting; each level costs stack in the parser.
const DEEPEST: usize = 100;

const SUM: u8 = 10;
const PRODUCT: u8 = 20;
const MINUS: u8 = 25;
const POWER: u8 = 30;

pub(crate) fn parse(text: &str, variable: Option<&str>) -> Result<Expression, ExpressionError> {
    if text.len() > LONGEST {
        return Err(ExpressionError::new(
            format!("the expression is {} bytes long; at most {LONGEST} are allowed", text.len()),
            0..0,
        ));
    }
    parse_range(text, 0..text.len(), variable, 0)
}

fn parse_range(
    text: &str,
    range: Range<usize>,
    variable: Option<&str>,
    depth: usize,
) -> Result<Expression, ExpressionError> {
    let mut parser = Parser { text, tokens: tokens(text, range)?, next: 0, variable, items: Vec::new() };
    parser.operand_and_more(0, depth)?;
    let rest = parser.peek().clone();
    match rest.token {
        Token::End => Ok(Expression { text: text.to_string(), items: parser.items }),
        Token::Sign(')' | ']') => {
            Err(ExpressionError::new(format!("`{}` closes nothing", &text[rest.span.clone()]), rest.span))
        }
        _ => {
            let message = format!("expected an operator (+ - * / ^), found `{}`", &text[rest.span.clone()]);
            let part = rest.span.clone();
            Err(parser.with_decimal_point(ExpressionError::new(message, rest.span), part))
        }
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Spanned>,
    next: usize,
    variable: Option<&'a str>,
    items: Vec<Item>,
}

impl<'a> Parser<'a> {
    fn peek(&self) -> &Spanned {
        self.ahead(0)
    }

    fn ahead(&self, count: usize) -> &Spanned {
        // The list is never empty and its last token is End.
        &self.tokens[(self.next + count).min(self.tokens.len() - 1)]
    }

    fn take(&mut self) -> Spanned {
        let taken = self.peek().clone();
        self.next = (self.next + 1).min(self.tokens.len() - 1);
        taken
    }

    fn is_sign(&self, count: usize, sign: char) -> bool {
        self.ahead(count).token == Token::Sign(sign)
    }

    fn push(&mut self, node: Node, span: Range<usize>) {
        self.items.push(Item { node, span });
    }

    fn operand_and_more(&mut self, least: u8, depth: usize) -> Result<Range<usize>, ExpressionError> {
        if depth > DEEPEST {
            let span = self.peek().span.clone();
            return Err(ExpressionError::new(
                format!("the expression is nested more than {DEEPEST} deep"),
                span,
            ));
        }
        let mut left = self.operand(depth)?;
        loop {
            let (binary, strength) = match self.peek().token {
                Token::Sign('+') => (Binary::Add, SUM),
                Token::Sign('-') => (Binary::Subtract, SUM),
                Token::Sign('*') => (Binary::Multiply, PRODUCT),
                Token::Sign('/') => (Binary::Divide, PRODUCT),
                Token::Sign('^') => (Binary::Power, POWER),
                _ => return Ok(left),
            };
            if strength <= least {
                return Ok(left);
            }
            self.take();
            if binary == Binary::Multiply && self.is_sign(0, '*') {
                let span = self.peek().span.clone();
                return Err(ExpressionError::new("expected a value, found `*`", span)
                    .with_hint("a power is written `^`"));
            }
            // A power is right-associative: its right side may hold powers again.
            let least_right = if binary == Binary::Power { POWER - 1 } else { strength };
            let right = self.operand_and_more(least_right, depth + 1)?;
            left = left.start..right.end;
            self.push(Node::Binary(binary), left.clone());
        }
    }

    /// A number, reference, call, parenthesis or negated operand; returns its span.
    fn operand(&mut self, depth: usize) -> Result<Range<usize>, ExpressionError> {
        let first = self.take();
        match first.token {
            Token::Number(value) => self.number(value, first.span),
            Token::Name => self.name(first.span, depth),
            Token::Sign('-') => {
                let operand = self.operand_and_more(MINUS, depth + 1)?;
                let span = first.span.start..operand.end;
                self.push(Node::Negate, span.clone());
                Ok(span)
            }
            Token::Sign('+') => {
                let operand = self.operand_and_more(MINUS, depth + 1)?;
                Ok(first.span.start..operand.end)
            }
            Token::Sign('(') => {
                self.operand_and_more(0, depth + 1)?;
                let close = self.close(')', &first.span)?;
                Ok(first.span.start..close.end)
            }
            Token::End if self.items.is_empty() && self.tokens.len() == 1 => {
                Err(ExpressionError::new("the expression is empty", first.span))
            }
            Token::End => Err(ExpressionError::new("expected a value, found the end", first.span)),
            Token::Quoted | Token::Sign(_) => {
                let found = &self.text[first.span.clone()];
                Err(ExpressionError::new(format!("expected a value, found `{found}`"), first.span))
            }
        }
    }

    fn close(&mut self, sign: char, opened: &Range<usize>) -> Result<Range<usize>, ExpressionError> {
        if self.is_sign(0, sign) {
            return Ok(self.take().span);
        }
        let found = self.peek().span.clone();
        if self.peek().token == Token::End {
            let open = &self.text[opened.clone()];
            return Err(ExpressionError::new(format!("`{open}` is not closed"), opened.clone()));
        }
        let text = &self.text[found.clone()];
        let message = format!("expected `{sign}` or an operator, found `{text}`");
        let part = found.clone();
        Err(self.with_decimal_point(ExpressionError::new(message, found), part))
    }

    /// The error with a hint, if a number with a decimal comma stands in that part of the text.
    fn with_decimal_point(&self, error: ExpressionError, part: Range<usize>) -> ExpressionError {
        let comma = self.tokens.windows(3).find_map(|three| match three {
            [
                Spanned { token: Token::Number(_), span: whole },
                Spanned { token: Token::Sign(','), span: comma },
                Spanned { token: Token::Number(_), span: digits },
            ] if part.start <= comma.start
                && comma.end <= part.end
                && whole.end == comma.start
                && comma.end == digits.start =>
            {
                Some(format!("{}.{}", &self.text[whole.clone()], &self.text[digits.clone()]))
            }
            _ => None,
        });
        match comma {
            Some(written) => error.with_hint(format!("a number has a point, not a comma: write `{written}`")),
            None => error,
        }
    }

    fn name(&mut self, span: Range<usize>, depth: usize) -> Result<Range<usize>, ExpressionError> {
        let name = &self.text[span.clone()];
        if self.is_sign(0, '(') {
            return self.call(span, depth);
        }
        let dotted = self.is_sign(0, '.') || self.is_sign(0, '[');
        if !dotted && self.variable != Some(name) {
            if let Some((_, value)) = CONSTANTS.iter().find(|(constant, _)| *constant == name) {
                self.push(Node::Number(*value, Kind::Plain), span.clone());
                return Ok(span);
            }
            if unit(name).is_some() {
                return Err(ExpressionError::new(
                    format!("`{name}` is a unit and must stand directly behind a number"),
                    span,
                )
                .with_hint(format!("write `1 {name}`")));
            }
            if Call::find(name).is_some() {
                return Err(ExpressionError::new(
                    format!("`{name}` is a function and needs its arguments"),
                    span,
                )
                .with_hint(format!("write `{name}(...)`")));
            }
        }
        self.reference(span, depth)
    }

    fn reference(&mut self, first: Range<usize>, depth: usize) -> Result<Range<usize>, ExpressionError> {
        let mut segments = vec![(Segment::Name(self.text[first.clone()].to_string()), first.clone())];
        let mut end = first.end;
        loop {
            if self.is_sign(0, '.') {
                self.take();
                let part = self.take();
                let name = match part.token {
                    Token::Name => &self.text[part.span.clone()],
                    Token::Quoted => &self.text[part.span.start + 1..part.span.end - 1],
                    _ => return Err(ExpressionError::new("expected a name behind the dot", part.span)),
                };
                end = part.span.end;
                segments.push((Segment::Name(name.to_string()), part.span));
            } else if self.is_sign(0, '[') {
                let open = self.take().span;
                let index = self.index(depth + 1)?;
                let close = self.close(']', &open)?;
                end = close.end;
                segments.push((Segment::Index(index), open.start..close.end));
            } else {
                break;
            }
        }
        let span = first.start..end;
        self.push(Node::Reference(Reference { segments, span: span.clone() }), span.clone());
        Ok(span)
    }

    /// What stands in square brackets: an expression, perhaps in quotes.
    fn index(&mut self, depth: usize) -> Result<Expression, ExpressionError> {
        if self.peek().token == Token::Quoted {
            let span = self.take().span;
            return parse_range(self.text, span.start + 1..span.end - 1, self.variable, depth);
        }
        let outer = std::mem::take(&mut self.items);
        let result = self.operand_and_more(0, depth);
        let items = std::mem::replace(&mut self.items, outer);
        result.map(|_| Expression { text: self.text.to_string(), items })
    }

    fn call(&mut self, span: Range<usize>, depth: usize) -> Result<Range<usize>, ExpressionError> {
        let name = &self.text[span.clone()];
        let Some(entry) = Call::find(name) else {
            let error = ExpressionError::new(format!("there is no function `{name}`"), span);
            let hint = match name {
                "log" => {
                    Some("write `ln` for the natural logarithm, `log10` for the decimal one".to_string())
                }
                "pow" => Some("a power is written `a^b`".to_string()),
                _ => nearest(name, Call::TABLE.iter().map(|entry| entry.name))
                    .map(|near| format!("did you mean `{near}`?")),
            };
            return Err(match hint {
                Some(hint) => error.with_hint(hint),
                None => error,
            });
        };
        let open = self.take().span;
        let mut count = 0;
        if !self.is_sign(0, ')') {
            loop {
                self.operand_and_more(0, depth + 1)?;
                count += 1;
                if !self.is_sign(0, ',') {
                    break;
                }
                self.take();
            }
        }
        let close = self.close(')', &open)?;
        let whole = span.start..close.end;
        let (least, most) = entry.arguments;
        if count < least || count > most {
            let wanted = if least == most { format!("{least}") } else { format!("{least} to {most}") };
            let plural = if wanted == "1" { "" } else { "s" };
            let message = format!("`{name}` takes {wanted} argument{plural}, found {count}");
            let error = ExpressionError::new(message, whole.clone());
            return Err(if count > most { self.with_decimal_point(error, whole) } else { error });
        }
        self.push(Node::Call(entry.call, count), whole.clone());
        Ok(whole)
    }

    fn number(&mut self, value: f64, span: Range<usize>) -> Result<Range<usize>, ExpressionError> {
        let mut whole = Unit { factor: 1.0, dimension: Dimension::NUMBER };
        let mut end = span.end;
        let mut found = false;
        // `2 1/m`: the reciprocal of a unit, spelled out.
        let spelled =
            self.ahead(0).token == Token::Number(1.0) && self.is_sign(1, '/') && self.unit_at(2).is_some();
        if spelled {
            self.take();
        }
        if self.is_sign(0, '/') && self.unit_at(1).is_some() {
            // `0.0851/mm`: units only divide the number.
        } else if self.peek().token == Token::Name {
            let Some(first) = self.unit_at(0) else { return Err(self.no_unit()) };
            end = self.factor(first, &mut whole, false)?;
            found = true;
        } else {
            self.push(Node::Number(value, Kind::Plain), span.clone());
            return Ok(span);
        }
        let mut divided = false;
        loop {
            let under = self.is_sign(0, '/');
            let joined = under || self.is_sign(0, '*');
            let skip = usize::from(joined);
            let Some(next) = self.unit_at(skip) else {
                self.refuse_raised(skip)?;
                break;
            };
            if !joined && (divided || !found) {
                let span = self.peek().span.clone();
                return Err(ExpressionError::new("a unit behind `/` must be joined by `*` or `/`", span));
            }
            for _ in 0..skip {
                self.take();
            }
            divided |= under;
            found = true;
            end = self.factor(next, &mut whole, under)?;
        }
        let span = span.start..end;
        // 152.4 mm should be the double nearest to 0.1524; dividing by 1000 rounds once, multiplying twice.
        let inverse = whole.factor.recip().round();
        let exact = whole.factor < 1.0 && inverse < 1e15 && (inverse * whole.factor - 1.0).abs() < 1e-15;
        let value = if exact { value / inverse } else { value * whole.factor };
        self.push(Node::Number(value, Kind::Of(whole.dimension)), span.clone());
        Ok(span)
    }

    /// A name behind a unit that ends with a raised digit is no parameter but a unit in another spelling.
    fn refuse_raised(&mut self, count: usize) -> Result<(), ExpressionError> {
        let token = self.ahead(count);
        let raised = token.token == Token::Name && self.text[token.span.clone()].ends_with(['²', '³', '⁴']);
        if !raised {
            return Ok(());
        }
        self.next += count;
        Err(self.no_unit())
    }

    /// The unit whose symbol is the token `count` ahead, unless that is the variable, a call or a path.
    fn unit_at(&self, count: usize) -> Option<Unit> {
        let token = self.ahead(count);
        if token.token != Token::Name {
            return None;
        }
        let name = &self.text[token.span.clone()];
        let taken =
            self.variable == Some(name) || ['(', '.', '['].iter().any(|sign| self.is_sign(count + 1, *sign));
        if taken { None } else { unit(name) }
    }

    /// Takes a symbol and its exponent; returns where they end.
    fn factor(&mut self, unit: Unit, whole: &mut Unit, under: bool) -> Result<usize, ExpressionError> {
        let symbol = self.take().span;
        let mut end = symbol.end;
        let mut exponent = 1.0;
        if self.is_sign(0, '^') {
            let sign = self.take();
            let negative = self.is_sign(0, '-');
            if negative {
                self.take();
            }
            let Token::Number(value) = self.peek().token else {
                return Err(ExpressionError::new("the exponent of a unit must be a number", sign.span));
            };
            end = self.take().span.end;
            exponent = if negative { -value } else { value };
        }
        let span = symbol.start..end;
        let Some(dimension) = unit.dimension.power(exponent) else {
            return Err(ExpressionError::new("this exponent makes no unit", span));
        };
        let factor = unit.factor.powf(exponent);
        if under {
            whole.factor /= factor;
            whole.dimension = whole.dimension.over(&dimension);
        } else {
            whole.factor *= factor;
            whole.dimension = whole.dimension.times(&dimension);
        }
        if !whole.factor.is_finite() || whole.factor == 0.0 {
            return Err(ExpressionError::new("this exponent makes no unit", span));
        }
        Ok(end)
    }

    /// A name that is no unit stands directly behind a number.
    fn no_unit(&self) -> ExpressionError {
        let span = self.peek().span.clone();
        let name = &self.text[span.clone()];
        let number = &self.text[self.tokens[self.next - 1].span.clone()];
        let known = self.variable == Some(name)
            || CONSTANTS.iter().any(|(constant, _)| *constant == name)
            || ['(', '.', '['].iter().any(|sign| self.is_sign(1, *sign));
        if known {
            return ExpressionError::new(format!("expected an operator (+ - * / ^), found `{name}`"), span)
                .with_hint(format!("write `{number}*{name}`"));
        }
        let all = symbols();
        let hint = match name {
            "h" => "write `hour`".to_string(),
            "degC" | "C" | "degF" => "temperatures are in K".to_string(),
            "t" => "write `tonne`".to_string(),
            "mi" => "write it in km".to_string(),
            _ => match respelled(name) {
                Some(written) => format!("did you mean `{written}`?"),
                None => match nearest(name, all.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("to multiply, write `{number}*{name}`"),
                },
            },
        };
        ExpressionError::new(format!("there is no unit `{name}`"), span).with_hint(hint)
    }
}
