//! Outputs: expressions over results.

use crate::context::{Context, Read, Reported, suggest};
use crate::format::Named;
use crate::reader::station;
use crate::tree::{Entry, Value};
use flexura_expression::{
    Binding, Dimension, Expression, ExpressionError, Kind, Reference, Segment, nearest,
};
use flexura_model::{
    At, BeamId, BodyId, JointId, JointKind, Model, Output, Probe, ProbeTarget, Quantity, SpringId,
};
use std::cell::Cell;
use std::ops::Range;

/// A quantity that can be read off: its name, dimension and components ("" for a number).
struct Readable {
    name: &'static str,
    quantity: Quantity,
    dimension: Dimension,
    components: &'static [&'static str],
}

const XYZ: &[&str] = &["x", "y", "z"];
const K: &[&str] = &["k1", "k2", "k3"];
const ONE: &[&str] = &[];

const fn readable(
    name: &'static str,
    quantity: Quantity,
    dimension: Dimension,
    components: &'static [&'static str],
) -> Readable {
    Readable { name, quantity, dimension, components }
}

const OF_BEAM: &[Readable] = &[
    readable("position", Quantity::Position, Dimension::LENGTH, XYZ),
    readable("rotation", Quantity::Rotation, Dimension::ANGLE, XYZ),
    readable("tangent", Quantity::Tangent, Dimension::NUMBER, XYZ),
    readable("force", Quantity::Force, Dimension::FORCE, XYZ),
    readable("moment", Quantity::Moment, Dimension::MOMENT, XYZ),
    readable("curvature", Quantity::Curvature, Dimension::CURVATURE, K),
    readable("stretch", Quantity::Stretch, Dimension::NUMBER, ONE),
    readable("strain", Quantity::Strain, Dimension::NUMBER, ONE),
    readable("stress", Quantity::Stress, Dimension::PRESSURE, ONE),
];
const OF_BODY: &[Readable] = &[
    readable("position", Quantity::Position, Dimension::LENGTH, XYZ),
    readable("rotation", Quantity::Rotation, Dimension::ANGLE, XYZ),
];
const OF_SLIDE: &[Readable] = &[
    readable("coordinate", Quantity::Coordinate, Dimension::LENGTH, ONE),
    readable("effort", Quantity::Effort, Dimension::FORCE, ONE),
    readable("force", Quantity::Force, Dimension::FORCE, XYZ),
    readable("moment", Quantity::Moment, Dimension::MOMENT, XYZ),
];
const OF_HINGE: &[Readable] = &[
    readable("coordinate", Quantity::Coordinate, Dimension::ANGLE, ONE),
    readable("effort", Quantity::Effort, Dimension::MOMENT, ONE),
    readable("force", Quantity::Force, Dimension::FORCE, XYZ),
    readable("moment", Quantity::Moment, Dimension::MOMENT, XYZ),
];
const OF_BALL: &[Readable] = &[
    readable("coordinate", Quantity::Coordinate, Dimension::ANGLE, XYZ),
    readable("effort", Quantity::Effort, Dimension::MOMENT, XYZ),
    readable("force", Quantity::Force, Dimension::FORCE, XYZ),
    readable("moment", Quantity::Moment, Dimension::MOMENT, XYZ),
];
const OF_WELD: &[Readable] = &[
    readable("force", Quantity::Force, Dimension::FORCE, XYZ),
    readable("moment", Quantity::Moment, Dimension::MOMENT, XYZ),
];
const OF_SPRING: &[Readable] = &[
    readable("length", Quantity::Length, Dimension::LENGTH, ONE),
    readable("tension", Quantity::Tension, Dimension::FORCE, ONE),
];
const OF_MODEL: &[Readable] = &[readable("energy", Quantity::Energy, Dimension::MOMENT, ONE)];

const ROOTS: &[&str] = &["beam", "body", "joint", "spring", "model"];

/// What a reference into the results means.
struct Meaning {
    target: ProbeTarget,
    quantity: Quantity,
    dimension: Dimension,
    /// None: all three of a vector.
    component: Option<usize>,
}

pub(super) fn output(context: &Context<'_>, entry: &Entry, model: &Model) -> Read<Output> {
    let path = format!("output.{}", entry.key);
    let Value::Text(text) = &entry.node.value else {
        let message = format!("expected an expression over results, found {}", entry.node.kind());
        let hint = format!("for example `{} = \"beam.link.end.position.z\"`", entry.key);
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, hint));
    };
    let expression =
        Expression::parse(text).map_err(|error| context.expression_error(&entry.node, &path, &error))?;
    let mut probes: Vec<Probe> = Vec::new();
    let mut formulas = Vec::new();
    let mut unit = String::new();
    let mut vector = false;
    for component in 0..3 {
        if component > 0 && !vector {
            break;
        }
        let silent = Cell::new(false);
        let lowered = expression.lower(&mut |reference| {
            if !matches!(&reference.segments[0].0, Segment::Name(name) if reference.segments.len() > 1 || ROOTS.contains(&name.as_str())) {
                return context.parameter(reference, text, &silent).map(Binding::Value).map_err(|mut error| {
                    if error.hint.as_deref().is_some_and(|hint| !hint.starts_with("did you mean")) {
                        error.hint = Some(format!("results begin with {}", ROOTS.join(", ")));
                    }
                    error
                });
            }
            let meaning = meaning(context, model, reference, text, &silent)?;
            vector |= meaning.component.is_none();
            let component = meaning.component.unwrap_or(component);
            let probe = Probe { target: meaning.target, quantity: meaning.quantity, component };
            let slot = probes.iter().position(|known| *known == probe).unwrap_or_else(|| {
                probes.push(probe);
                probes.len() - 1
            });
            Ok(Binding::Slot(slot, Kind::Of(meaning.dimension)))
        });
        let lowered = lowered.map_err(|error| {
            if silent.get() { Reported } else { context.expression_error(&entry.node, &path, &error) }
        })?;
        if let Some(span) = &lowered.not_finite {
            let span = context.inner(&entry.node, span);
            return Err(context.wrong(&span, &path, "the expression gives no finite number"));
        }
        unit = lowered.kind.dimension().unit();
        formulas.push(lowered.formula());
    }
    Ok(Output { name: entry.key.clone(), unit, formulas, probes })
}

/// Walks along the segments of a reference.
struct Walk<'r> {
    segments: &'r [(Segment, Range<usize>)],
    next: usize,
    whole: Range<usize>,
}

impl<'r> Walk<'r> {
    fn take(&mut self) -> Option<(&'r Segment, Range<usize>)> {
        let (segment, span) = self.segments.get(self.next)?;
        self.next += 1;
        Some((segment, span.clone()))
    }

    fn name(&mut self, what: &str, example: &str) -> Result<(&'r str, Range<usize>), ExpressionError> {
        match self.take() {
            Some((Segment::Name(name), span)) => Ok((name, span)),
            Some((Segment::Index(_), span)) => Err(ExpressionError::new(format!("expected {what}"), span)
                .with_hint(format!("for example `{example}`"))),
            None => Err(ExpressionError::new(format!("expected {what} behind this"), self.whole.clone())
                .with_hint(format!("for example `{example}`"))),
        }
    }
}

fn meaning(
    context: &Context<'_>,
    model: &Model,
    reference: &Reference,
    text: &str,
    silent: &Cell<bool>,
) -> Result<Meaning, ExpressionError> {
    let mut walk = Walk { segments: &reference.segments, next: 0, whole: reference.span.clone() };
    let (root, root_span) = walk.name("a name", "beam.link.end.position")?;
    let named = match root {
        "beam" => Named::Beam,
        "body" => Named::Body,
        "joint" => Named::Joint,
        "spring" => Named::Spring,
        "model" => return quantity(&mut walk, ProbeTarget::Model, OF_MODEL, "model.energy"),
        _ => {
            let error = ExpressionError::new(format!("`{root}` names no result"), root_span);
            return Err(error.with_hint(match nearest(root, ROOTS.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("results begin with {}", ROOTS.join(", ")),
            }));
        }
    };
    let example = match named {
        Named::Beam => "beam.link.end.position.z",
        Named::Joint => "joint.way.coordinate",
        Named::Spring => "spring.ligament.tension",
        _ => "body.slider.position.x",
    };
    let (name, span) = walk.name(&format!("the name of a {root}"), example)?;
    if named == Named::Body && name == "ground" {
        return Err(ExpressionError::new("the ground does not move", span));
    }
    let Some(position) = context.position(named, name) else {
        let (message, hint) = context.unknown_name(named, name);
        return Err(ExpressionError::new(message, span).with_hint(hint));
    };
    match named {
        Named::Beam => {
            let at = place(context, &mut walk, text, name, silent)?;
            quantity(&mut walk, ProbeTarget::Beam(BeamId(position), at), OF_BEAM, example)
        }
        Named::Joint => {
            // A joint that failed to build leaves the list short; that was recorded.
            let joint = model.joints.iter().find(|joint| joint.name == name);
            let Some(joint) = joint else {
                silent.set(true);
                return Err(ExpressionError::new(String::new(), span));
            };
            let list = match joint.law.kind {
                JointKind::Weld => OF_WELD,
                JointKind::Revolute => OF_HINGE,
                JointKind::Prismatic => OF_SLIDE,
                JointKind::Spherical => OF_BALL,
                _ => OF_WELD,
            };
            quantity(&mut walk, ProbeTarget::Joint(JointId(position)), list, example)
        }
        Named::Spring => quantity(&mut walk, ProbeTarget::Spring(SpringId(position)), OF_SPRING, example),
        _ => quantity(&mut walk, ProbeTarget::Body(BodyId(position)), OF_BODY, example),
    }
}

/// `[0.5]`, `[30 mm]`, `.start` or `.end` behind a beam.
fn place(
    context: &Context<'_>,
    walk: &mut Walk<'_>,
    text: &str,
    beam: &str,
    silent: &Cell<bool>,
) -> Result<At, ExpressionError> {
    let hint = format!(
        "for example `beam.{beam}[0.5]`, `beam.{beam}[30 mm]`, `beam.{beam}.start` or `beam.{beam}.end`"
    );
    match walk.take() {
        Some((Segment::Name(name), _)) if name == "start" => Ok(At::Fraction(0.0)),
        Some((Segment::Name(name), _)) if name == "end" => Ok(At::Fraction(1.0)),
        Some((Segment::Index(index), span)) => {
            let found = index.evaluate(&mut |reference| context.parameter(reference, text, silent))?;
            let at = station(found).filter(|_| found.value.is_finite());
            let at = at.ok_or_else(|| {
                let message =
                    format!("a place on a beam is a fraction or a length, found {}", found.kind.dimension());
                ExpressionError::new(message, span.clone()).with_hint(hint)
            })?;
            if let At::Fraction(fraction) = at
                && !(0.0..=1.0).contains(&fraction)
            {
                return Err(ExpressionError::new(
                    format!("the place {fraction} is not on beam `{beam}`"),
                    span,
                )
                .with_hint(
                    "a plain number is a fraction of the length, from 0 to 1; a length needs a unit",
                ));
            }
            Ok(at)
        }
        Some((Segment::Name(_), span)) => {
            Err(ExpressionError::new("expected a place on the beam", span).with_hint(hint))
        }
        None => Err(ExpressionError::new("expected a place on the beam behind this", walk.whole.clone())
            .with_hint(hint)),
    }
}

fn quantity(
    walk: &mut Walk<'_>,
    target: ProbeTarget,
    list: &'static [Readable],
    example: &str,
) -> Result<Meaning, ExpressionError> {
    let (name, span) = walk.name("a quantity", example)?;
    let Some(found) = list.iter().find(|readable| readable.name == name) else {
        let names: Vec<&str> = list.iter().map(|readable| readable.name).collect();
        let hint = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => suggest(name, &names, "quantity"),
        };
        return Err(ExpressionError::new(format!("there is no quantity `{name}` here"), span).with_hint(hint));
    };
    let component = match walk.take() {
        None if found.components.is_empty() => Some(0),
        None => None,
        Some((Segment::Name(part), span)) => {
            let Some(component) = found.components.iter().position(|component| component == part) else {
                let error = ExpressionError::new(format!("`{}` has no component `{part}`", found.name), span);
                return Err(error.with_hint(match found.components {
                    [] => "it is a single number".to_string(),
                    components => format!("the components are {}", components.join(", ")),
                }));
            };
            Some(component)
        }
        Some((Segment::Index(_), span)) => {
            let hint = match found.components {
                [] => "it is a single number".to_string(),
                components => format!("the components are {}", components.join(", ")),
            };
            return Err(
                ExpressionError::new(format!("`{}` takes no index", found.name), span).with_hint(hint)
            );
        }
    };
    if let Some((_, span)) = walk.take() {
        return Err(ExpressionError::new("nothing can follow a component", span));
    }
    Ok(Meaning { target, quantity: found.quantity, dimension: found.dimension, component })
}
