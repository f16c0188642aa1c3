//! Walking along the segments of a reference into the results.

use super::readable::{LOADS, MOTIONS, Part, Readable, element};
use crate::context::suggest;
use flexura_expression::{Dimension, ExpressionError, Reference, Segment, nearest};
use flexura_model::{ProbeTarget, Quantity};
use std::ops::Range;

/// What a reference into the results means.
pub(in crate::build) struct Meaning {
    pub target: ProbeTarget,
    pub quantity: Quantity,
    pub dimension: Dimension,
    /// None: all three of a vector.
    pub component: Option<usize>,
}

/// Walks along the segments of a reference.
pub(in crate::build) struct Walk<'r> {
    segments: &'r [(Segment, Range<usize>)],
    next: usize,
    pub whole: Range<usize>,
}

impl<'r> Walk<'r> {
    pub(in crate::build) fn new(reference: &'r Reference) -> Self {
        Self { segments: &reference.segments, next: 0, whole: reference.span.clone() }
    }

    pub(in crate::build) fn take(&mut self) -> Option<(&'r Segment, Range<usize>)> {
        let (segment, span) = self.segments.get(self.next)?;
        self.next += 1;
        Some((segment, span.clone()))
    }

    /// Is this name next?
    pub(in crate::build) fn is_next(&self, name: &str) -> bool {
        matches!(self.segments.get(self.next), Some((Segment::Name(next), _)) if next == name)
    }

    pub(in crate::build) fn name(
        &mut self,
        what: &str,
        example: &str,
    ) -> Result<(&'r str, Range<usize>), ExpressionError> {
        match self.take() {
            Some((Segment::Name(name), span)) => Ok((name, span)),
            Some((Segment::Index(_), span)) => Err(ExpressionError::new(format!("expected {what}"), span)
                .with_hint(format!("for example `{example}`"))),
            None => Err(ExpressionError::new(format!("expected {what} behind this"), self.whole.clone())
                .with_hint(format!("for example `{example}`"))),
        }
    }

    /// Nothing may follow.
    pub(in crate::build) fn end(&mut self, what: &str) -> Result<(), ExpressionError> {
        match self.take() {
            Some((_, span)) => Err(ExpressionError::new(format!("nothing can follow {what}"), span)),
            None => Ok(()),
        }
    }

    /// The quantity that the next segments name.
    pub(in crate::build) fn quantity(
        &mut self,
        target: ProbeTarget,
        list: &[Readable],
        example: &str,
    ) -> Result<Meaning, ExpressionError> {
        let (name, span) = self.name("a quantity", example)?;
        let Some(found) = list.iter().find(|readable| readable.name == name) else {
            let names: Vec<&str> = list.iter().map(|readable| readable.name).collect();
            let hint = match nearest(name, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None if names.len() > 8 => format!("there are {}", names.join(", ")),
                None => suggest(name, &names, "quantity"),
            };
            return Err(
                ExpressionError::new(format!("there is no quantity `{name}` here"), span).with_hint(hint)
            );
        };
        let (quantity, dimension, component) = match &found.part {
            Part::Number(quantity, dimension, component) => {
                self.single(found.name)?;
                (*quantity, *dimension, Some(*component))
            }
            Part::Vector(quantity, dimension, components) => {
                (*quantity, *dimension, self.component(found.name, components)?)
            }
            Part::Group(inner) => {
                if self.next == self.segments.len() {
                    let names: Vec<&str> = inner.iter().map(|readable| readable.name).collect();
                    let error =
                        ExpressionError::new(format!("`{name}` has several parts"), self.whole.clone());
                    return Err(error.with_hint(format!("write behind it one of {}", dotted(&names))));
                }
                return self.quantity(target, inner, example);
            }
            Part::Matrix(quantity) => {
                let stiffness = *quantity == Quantity::Stiffness;
                let (rows, columns) = if stiffness { (LOADS, MOTIONS) } else { (MOTIONS, LOADS) };
                let row = self.index(found.name, "row", &rows)?;
                let column = self.index(found.name, "column", &columns)?;
                self.end("the column of a matrix")?;
                (*quantity, element(*quantity, row, column), Some(6 * row + column))
            }
        };
        Ok(Meaning { target, quantity, dimension, component })
    }

    fn single(&mut self, name: &str) -> Result<(), ExpressionError> {
        let error = match self.take() {
            None => return Ok(()),
            Some((Segment::Name(part), span)) => {
                ExpressionError::new(format!("`{name}` has no component `{part}`"), span)
            }
            Some((Segment::Index(_), span)) => ExpressionError::new(format!("`{name}` takes no index"), span),
        };
        Err(error.with_hint("it is a single number"))
    }

    fn component(&mut self, name: &str, components: &[&str]) -> Result<Option<usize>, ExpressionError> {
        let hint = || format!("the components are {}", components.join(", "));
        let component = match self.take() {
            None => return Ok(None),
            Some((Segment::Name(part), span)) => {
                let found = components.iter().position(|component| component == part);
                found.ok_or_else(|| {
                    ExpressionError::new(format!("`{name}` has no component `{part}`"), span)
                        .with_hint(hint())
                })?
            }
            Some((Segment::Index(_), span)) => {
                return Err(ExpressionError::new(format!("`{name}` takes no index"), span).with_hint(hint()));
            }
        };
        self.end("a component")?;
        Ok(Some(component))
    }

    fn index(&mut self, matrix: &str, what: &str, names: &[&str; 6]) -> Result<usize, ExpressionError> {
        let hint = || format!("the {what}s are {}", names.join(", "));
        match self.take() {
            Some((Segment::Name(name), span)) => {
                names.iter().position(|known| known == name).ok_or_else(|| {
                    ExpressionError::new(format!("`{matrix}` has no {what} `{name}`"), span).with_hint(hint())
                })
            }
            Some((Segment::Index(_), span)) => {
                Err(ExpressionError::new(format!("expected a {what} of `{matrix}`"), span).with_hint(hint()))
            }
            None => {
                let message = format!("expected a {what} of `{matrix}` behind this");
                Err(ExpressionError::new(message, self.whole.clone()).with_hint(hint()))
            }
        }
    }
}

/// `.a`, `.b`, `.c`.
fn dotted(names: &[&str]) -> String {
    names.iter().map(|name| format!("`.{name}`")).collect::<Vec<_>>().join(", ")
}
