//! Places by name: what is typed behind `--compliance`.

use crate::expression::{Dimension, Expression, Kind, Quantity, Segment, nearest};
use crate::geometry::RestShape;
use crate::model::{At, Beam, BeamId, BodyId, Model, ProbeTarget};
use crate::modelfile::suggestion;

const HINT: &str =
    "a place is `body.NAME`, `beam.NAME.start`, `beam.NAME.end`, `beam.NAME[0.5]` or `beam.NAME[30 mm]`";

/// The body or place on a beam that a text names as an output would: `body.stage`, `beam.link.end`, `beam.link[0.5]`,
/// `beam.link[30 mm]`.
///
/// # Errors
/// One sentence with the nearest name.
pub fn place(model: &Model, text: &str) -> Result<ProbeTarget, String> {
    let text = text.trim();
    let wrong = |why: &str| format!("`{text}` is no place: {why}");
    let parsed = Expression::parse(text).map_err(|error| wrong(&format!("{}; {HINT}", error.message)))?;
    let segments = match parsed.references().into_iter().find(|reference| reference.span == (0..text.len())) {
        Some(reference) => reference.segments.iter().map(|(segment, _)| segment).collect::<Vec<_>>(),
        None => return Err(wrong(HINT)),
    };
    match segments[..] {
        [Segment::Name(kind), Segment::Name(name)] if kind == "body" => {
            let names: Vec<&str> = model.bodies.iter().map(|body| body.name.as_str()).collect();
            let position = position(name, &names, "body")?;
            Ok(ProbeTarget::Body(BodyId(position)))
        }
        [Segment::Name(kind), Segment::Name(name), at] if kind == "beam" => {
            let names: Vec<&str> = model.beams.iter().map(|beam| beam.name.as_str()).collect();
            let position = position(name, &names, "beam")?;
            let at = match at {
                Segment::Name(end) if end == "start" => At::Fraction(0.0),
                Segment::Name(end) if end == "end" => At::Fraction(1.0),
                Segment::Name(other) => {
                    let near =
                        nearest(other, ["start", "end"]).map(|near| format!("did you mean `{near}`? "));
                    return Err(wrong(&format!("{}{HINT}", near.unwrap_or_default())));
                }
                Segment::Index(index) => on_beam(&model.beams[position], index).map_err(|why| wrong(&why))?,
            };
            Ok(ProbeTarget::Beam(BeamId(position), at))
        }
        [Segment::Name(kind), Segment::Name(_)] if kind == "beam" => {
            Err(wrong(&format!("a place on the beam is missing; {HINT}")))
        }
        [Segment::Name(kind), ..] => match nearest(kind, ["body", "beam"]).filter(|near| near != kind) {
            Some(near) => Err(wrong(&format!("did you mean `{near}`? {HINT}"))),
            None => Err(wrong(HINT)),
        },
        _ => Err(wrong(HINT)),
    }
}

fn position(name: &str, names: &[&str], kind: &str) -> Result<usize, String> {
    names
        .iter()
        .position(|known| *known == name)
        .ok_or_else(|| format!("there is no {kind} `{name}`; {}", suggestion(name, names, kind)))
}

/// A fraction of the length, or a length, that lies on the beam.
fn on_beam(beam: &Beam, index: &Expression) -> Result<At, String> {
    let found = index
        .evaluate(&mut |reference| {
            Err(crate::expression::ExpressionError::new(
                "only numbers can stand here",
                reference.span.clone(),
            ))
        })
        .map_err(|error| error.message)?;
    let length = RestShape::new(&beam.curve, &beam.frame).map(|shape| shape.length());
    match found {
        Quantity { value, kind: Kind::Plain | Kind::Of(Dimension::NUMBER) } => {
            if (0.0..=1.0).contains(&value) {
                Ok(At::Fraction(value))
            } else {
                Err("a plain number is a fraction of the length, from 0 to 1; a length needs a unit".into())
            }
        }
        Quantity { value, kind: Kind::Of(Dimension::LENGTH) } => match length {
            // As far as the last digits of a length may be off.
            Ok(length) if value > length * (1.0 + 1e-9) || value.is_nan() || value < 0.0 => {
                Err(format!("beam `{}` is {length} m long", beam.name))
            }
            _ => Ok(At::Length(value)),
        },
        Quantity { kind: Kind::Of(dimension), .. } => {
            Err(format!("a place on a beam is a fraction or a length, not {dimension}"))
        }
    }
}
