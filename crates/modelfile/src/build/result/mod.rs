//! Results: expressions over them, in outputs and targets.

mod event;
mod readable;
mod reading;
mod target;
mod walk;

pub(super) use event::{event, stop};
pub(crate) use readable::name_of;
pub(super) use readable::{Part, coordinates};
pub(super) use reading::reading;
pub(super) use target::targets;
pub(super) use walk::Walk;

use crate::context::{Context, Read, Reported};
use crate::format::Named;
use crate::reader::station;
use crate::tree::{Entry, Node, Value};
use flexura_expression::{Binding, Expression, ExpressionError, Formula, Kind, Reference, Segment, nearest};
use flexura_model::{
    At, BeamId, BodyId, CableId, JointId, Model, Output, Probe, ProbeTarget, Quantity, SpringId, TubesId,
};
use readable::{of_beam, of_body, of_joint, of_line, of_model, of_spring, of_tubes, of_whole_beam};
use std::cell::Cell;
use std::collections::BTreeMap;
use walk::Meaning;

const ROOTS: &[&str] = &["beam", "body", "joint", "spring", "cable", "tubes", "model"];

/// An output with what is known of its dimension.
#[derive(Clone)]
pub(super) struct Built {
    pub output: Output,
    pub kind: Kind,
}

pub(super) fn output(context: &Context<'_>, entry: &Entry, model: &Model) -> Read<Built> {
    let path = format!("output.{}", entry.key);
    let Value::Text(text) = &entry.node.value else {
        let message = format!("expected an expression over results, found {}", entry.node.kind());
        let hint = format!("for example `{} = \"beam.link.end.position.z\"`", entry.key);
        return Err(context.wrong_with_hint(&entry.node.span, &path, message, hint));
    };
    let results = Results { context, model, outputs: None, is_live: false, may_be_infinite: true };
    results.read(&entry.node, &path, text, entry.key.clone())
}

/// The outputs with their parameters left open, as events need them: a path changes one, and others with it.
pub(super) fn live_outputs(context: &Context<'_>, model: &Model, outputs: &[Built]) -> Vec<Built> {
    let results = Results { context, model, outputs: None, is_live: true, may_be_infinite: true };
    let count = context.count();
    let entries = context.root.get("output").map_or(&[][..], |entry| entry.node.entries());
    let by_name: BTreeMap<&str, &Entry> = entries.iter().map(|entry| (entry.key.as_str(), entry)).collect();
    let live = |built: &Built| {
        let entry = by_name.get(built.output.name.as_str())?;
        let Value::Text(text) = &entry.node.value else { return None };
        let live = results.read(&entry.node, "", text, entry.key.clone()).ok();
        // What can only be read with a parameter's value, such as a power, keeps that.
        context.forget(count);
        if live.is_none() {
            context.rules.fix_text(text);
        }
        live
    };
    outputs.iter().map(|built| live(built).unwrap_or_else(|| built.clone())).collect()
}

/// What an expression over results may refer to.
struct Results<'r, 'a> {
    context: &'r Context<'a>,
    model: &'r Model,
    /// The outputs, where they may be referred to.
    outputs: Option<&'r [Built]>,
    /// Do parameters stay open, as probes?
    is_live: bool,
    /// May a part without results be no finite number? An output then has no value, and the others are not affected.
    may_be_infinite: bool,
}

impl Results<'_, '_> {
    /// Reads the expression that stands in `node`.
    fn read(&self, node: &Node, path: &str, text: &str, name: String) -> Read<Built> {
        let context = self.context;
        let expression =
            Expression::parse(text).map_err(|error| context.expression_error(node, path, &error))?;
        let mut probes: Vec<Probe> = Vec::new();
        let mut formulas = Vec::new();
        let mut kind = Kind::Plain;
        let mut vector = false;
        for component in 0..3 {
            if component > 0 && !vector {
                break;
            }
            let silent = Cell::new(false);
            let lowered = expression.lower(&mut |reference| {
                self.bind(reference, text, component, &mut vector, &mut probes, &silent)
            });
            let lowered = lowered.map_err(|error| {
                if silent.get() { Reported } else { context.expression_error(node, path, &error) }
            })?;
            if let Some(span) = lowered.not_finite.as_ref().filter(|_| !self.may_be_infinite) {
                let span = context.inner(node, span);
                return Err(context.wrong(&span, path, "the expression gives no finite number"));
            }
            kind = lowered.kind;
            formulas.push(lowered.formula());
        }
        let unit = kind.dimension().unit();
        Ok(Built { output: Output { name, unit, formulas, probes }, kind })
    }

    fn bind(
        &self,
        reference: &Reference,
        text: &str,
        component: usize,
        vector: &mut bool,
        probes: &mut Vec<Probe>,
        silent: &Cell<bool>,
    ) -> Result<Binding, ExpressionError> {
        let is_result = match &reference.segments[0].0 {
            Segment::Name(name) => reference.segments.len() > 1 || ROOTS.contains(&name.as_str()),
            Segment::Index(_) => false,
        };
        if !is_result {
            let quantity = self.context.parameter(reference, text, silent).map_err(|mut error| {
                let output = reference.name().filter(|name| self.has_output(name));
                if let Some(name) = output {
                    error.hint = Some(format!("did you mean `output.{name}`?"));
                } else if error.hint.as_deref().is_some_and(|hint| !hint.starts_with("did you mean")) {
                    error.hint = Some(self.roots());
                }
                error
            })?;
            let position = self.model.parameters.iter().position(|p| reference.name() == Some(&p.name));
            return Ok(match position.filter(|_| self.is_live) {
                Some(component) => {
                    let target = ProbeTarget::Model;
                    let probe = Probe { target, quantity: Quantity::Parameter, component };
                    Binding::Slot(slot(probes, probe), quantity.kind)
                }
                None => Binding::Value(quantity),
            });
        }
        if let (Some(outputs), Segment::Name(root)) = (self.outputs, &reference.segments[0].0)
            && root == "output"
        {
            let (output, kind, part) = self.output(outputs, reference, silent)?;
            *vector |= part.is_none();
            let part = part.unwrap_or(component).min(output.formulas.len() - 1);
            let slots: Vec<usize> = output.probes.iter().map(|probe| slot(probes, *probe)).collect();
            let formula: Formula = output.formulas[part].renamed(&slots);
            return Ok(Binding::Formula(formula, kind));
        }
        let meaning = self.meaning(reference, text, silent)?;
        *vector |= meaning.component.is_none();
        let component = meaning.component.unwrap_or(component);
        let probe = Probe { target: meaning.target, quantity: meaning.quantity, component };
        Ok(Binding::Slot(slot(probes, probe), Kind::Of(meaning.dimension)))
    }

    fn has_output(&self, name: &str) -> bool {
        self.outputs.is_some_and(|outputs| outputs.iter().any(|built| built.output.name == name))
    }

    fn roots(&self) -> String {
        let more = if self.outputs.is_some() { ", output" } else { "" };
        format!("results begin with {}{more}", ROOTS.join(", "))
    }

    fn meaning(
        &self,
        reference: &Reference,
        text: &str,
        silent: &Cell<bool>,
    ) -> Result<Meaning, ExpressionError> {
        let context = self.context;
        let mut walk = Walk::new(reference);
        let (root, root_span) = walk.name("a name", "beam.link.end.position")?;
        let named = match root {
            "beam" => Named::Beam,
            "body" => Named::Body,
            "joint" => Named::Joint,
            "spring" => Named::Spring,
            "cable" => Named::Cable,
            "tubes" => Named::Tubes,
            "model" => return walk.quantity(ProbeTarget::Model, &of_model(), "model.energy"),
            "output" => {
                let error = ExpressionError::new("an output cannot refer to another output", root_span);
                return Err(error.with_hint("repeat its expression; a [target] may refer to it"));
            }
            _ => {
                let error = ExpressionError::new(format!("`{root}` names no result"), root_span);
                return Err(error.with_hint(match nearest(root, ROOTS.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => self.roots(),
                }));
            }
        };
        let example = match named {
            Named::Beam => "beam.link.end.position.z",
            Named::Joint => "joint.way.coordinate",
            Named::Spring => "spring.ligament.tension",
            Named::Cable => "cable.flexor.tension",
            Named::Tubes => "tubes.robot.position.z",
            _ => "body.slider.position.x",
        };
        let (name, span) = walk.name(&format!("the name of a {}", named.noun()), example)?;
        if named == Named::Body && name == "ground" {
            return Err(ExpressionError::new("the ground does not move", span));
        }
        let Some(position) = context.position(named, name) else {
            let (message, hint) = context.unknown_name(named, name);
            return Err(ExpressionError::new(message, span).with_hint(hint));
        };
        match named {
            Named::Beam => {
                let whole = of_whole_beam().iter().any(|readable| walk.is_next(readable.name));
                let (at, list) = if whole {
                    (At::Fraction(0.0), of_whole_beam())
                } else {
                    (place(context, &mut walk, text, name, silent)?, of_beam())
                };
                let meaning = walk.quantity(ProbeTarget::Beam(BeamId(position), at), &list, example)?;
                let of_foundation =
                    matches!(meaning.quantity, Quantity::Foundation | Quantity::FoundationForce);
                // A beam that failed to build leaves the list short; that was recorded.
                let beam = self.model.beams.get(position).filter(|beam| beam.name == name);
                if of_foundation && beam.is_some_and(|beam| beam.foundation.is_empty()) {
                    let error = ExpressionError::new(format!("beam `{name}` has no foundation"), walk.whole);
                    return Err(error.with_hint("give it one: `foundation = { stiffness = \"1 kN/m^2\" }`"));
                }
                Ok(meaning)
            }
            Named::Joint => {
                // A joint that failed to build leaves the list short; that was recorded.
                let joint = self.model.joints.get(position).filter(|joint| joint.name == name);
                let Some(joint) = joint else {
                    silent.set(true);
                    return Err(ExpressionError::new(String::new(), span));
                };
                walk.quantity(ProbeTarget::Joint(JointId(position)), &of_joint(&joint.law), example)
            }
            Named::Spring => {
                let Some(spring) = self.model.springs.get(position).filter(|spring| spring.name == name)
                else {
                    silent.set(true);
                    return Err(ExpressionError::new(String::new(), span));
                };
                walk.quantity(ProbeTarget::Spring(SpringId(position)), &of_spring(&spring.law), example)
            }
            Named::Cable => walk.quantity(ProbeTarget::Cable(CableId(position)), &of_line(), example),
            Named::Tubes => walk.quantity(ProbeTarget::Tubes(TubesId(position)), &of_tubes(), example),
            _ => walk.quantity(ProbeTarget::Body(BodyId(position)), &of_body(), example),
        }
    }
}

/// The slot of a probe, a new one if it has none yet.
fn slot(probes: &mut Vec<Probe>, probe: Probe) -> usize {
    probes.iter().position(|known| *known == probe).unwrap_or_else(|| {
        probes.push(probe);
        probes.len() - 1
    })
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
            context.rules.fix(index);
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
