//! Couplings: an equation between joint coordinates, brought into the form Σ factor q = offset.

use super::result::{Part, Walk, coordinates};
use crate::context::{Context, Needed, Read, Reported};
use crate::format::Named;
use crate::reader::Reader;
use crate::tree::Node;
use flexura_expression::{
    Binding, Dimension, Expression, ExpressionError, Formula, Kind, Reference, Segment,
};
use flexura_model::{Coupling, CouplingTerm, Drive, Joint, JointId, JointKind, ProbeTarget, Rule};
use std::cell::{Cell, RefCell};

/// Deviations and factors below this, relative to the largest terms, are round-off.
const ROUND_OFF: f64 = 1e-10;

const EXAMPLE: &str = "for example `relation = \"joint.rack.coordinate = 20 mm*joint.pinion.coordinate\"`";

pub(super) fn coupling(reader: &Reader<'_, '_>, name: String, joints: &[Joint]) -> Read<Coupling> {
    let text = reader.text("relation").needed()?;
    let (entry, _) = reader.entry("relation").ok_or(Reported)?;
    let path = reader.key_path("relation");
    let wrong = |message: String, hint: &str| reader.wrong_at("relation", message, hint);
    let signs: Vec<usize> = text.match_indices('=').map(|(i, _)| i).collect();
    let [sign] = signs[..] else {
        let message = match signs.len() {
            0 => "a relation is an equation, but there is no equals sign".to_string(),
            count => format!("a relation is one equation, but there are {count} equals signs"),
        };
        return Err(wrong(message, EXAMPLE));
    };
    let relation = Relation {
        context: reader.context,
        node: &entry.node,
        path: &path,
        joints,
        terms: RefCell::new(Vec::new()),
    };
    let left = relation.side(text, 0, sign);
    let right = relation.side(text, sign + 1, text.len());
    let ((left, left_kind, left_open), (right, right_kind, right_open)) = (left?, right?);
    if let (Kind::Of(a), Kind::Of(b)) = (left_kind, right_kind)
        && !a.agrees(&b)
    {
        return Err(wrong(format!("{a} stands on the left and {b} on the right"), "both sides must agree"));
    }
    let terms = relation.terms.borrow().clone();
    let difference = |q: &[f64]| left.evaluate(q) - right.evaluate(q);
    let Some((offset, factors)) = linear(terms.len(), &difference) else {
        return Err(wrong(
            "the relation is not linear in the coordinates".to_string(),
            "a coupling adds coordinates times constants, and a constant",
        ));
    };
    let greatest = factors.iter().fold(0.0f64, |a, b| a.max(b.abs()));
    let kept: Vec<usize> = (0..factors.len()).filter(|i| factors[*i].abs() > ROUND_OFF * greatest).collect();
    relation.bind_rules(reader, [&left_open, &right_open], &terms, &kept);
    let terms: Vec<CouplingTerm> = terms
        .iter()
        .zip(&factors)
        .filter(|(_, factor)| factor.abs() > ROUND_OFF * greatest)
        .map(|(&(joint, coordinate), &factor)| CouplingTerm { joint: JointId(joint), coordinate, factor })
        .collect();
    if terms.len() < 2 {
        let what = if terms.is_empty() { "no coordinate" } else { "only one coordinate" };
        return Err(wrong(
            format!("a coupling relates at least two coordinates, but {what} remains in this one"),
            "to hold a single coordinate, drive its joint by `coordinate`",
        ));
    }
    let driven = |term: &CouplingTerm| {
        let law = joints[term.joint.0].law.coordinates.get(term.coordinate);
        law.is_some_and(|law| matches!(law.drive, Drive::Driven { .. }))
    };
    if terms.iter().all(driven) {
        return Err(wrong(
            "every coordinate of the coupling is driven, so it can do nothing".to_string(),
            "leave at least one coordinate free",
        ));
    }
    // Zero is added so that no offset is -0.
    Ok(Coupling { name, terms, offset: 0.0 - offset })
}

/// The constant and the factors of a linear function of `count` numbers; None if it is not linear.
fn linear(count: usize, function: &dyn Fn(&[f64]) -> f64) -> Option<(f64, Vec<f64>)> {
    let mut q = vec![0.0; count];
    let constant = function(&q);
    let mut factors = Vec::with_capacity(count);
    for i in 0..count {
        q[i] = 1.0;
        factors.push(function(&q) - constant);
        q[i] = 0.0;
    }
    let scale = factors.iter().fold(constant.abs(), |a, b| a.max(b.abs()));
    if !scale.is_finite() {
        return None;
    }
    for step in [-2.7, -1.0, -0.31, 0.013, 0.57, 1.9, 11.3] {
        // Each coordinate gets a value of its own, so that products of two are found.
        let q: Vec<f64> = (0..count).map(|i| step * (1.0 + 0.37 * i as f64)).collect();
        let expected = factors.iter().zip(&q).fold(constant, |sum, (factor, q)| sum + factor * q);
        let size = scale * q.iter().fold(1.0f64, |a, b| a.max(b.abs()));
        let error = (function(&q) - expected).abs();
        // A NaN is not within the bound either.
        if error.is_nan() || error > ROUND_OFF * size {
            return None;
        }
    }
    Some((constant, factors))
}

struct Relation<'r, 'a> {
    context: &'r Context<'a>,
    node: &'r Node,
    path: &'r str,
    joints: &'r [Joint],
    /// Joint and number of each coordinate; its place here is its slot.
    terms: RefCell<Vec<(usize, usize)>>,
}

impl Relation<'_, '_> {
    /// One side of the equation, a part of the text.
    fn side(&self, text: &str, from: usize, to: usize) -> Read<(Formula, Kind, Expression)> {
        let part = &text[from..to];
        let silent = Cell::new(false);
        let complain = |error: ExpressionError| {
            if silent.get() {
                return Reported;
            }
            let span = error.span.start + from..error.span.end + from;
            let moved = ExpressionError { span, ..error };
            self.context.expression_error(self.node, self.path, &moved)
        };
        let expression = Expression::parse(part).map_err(&complain)?;
        let lowered =
            expression.lower(&mut |reference| self.bind(reference, part, &silent)).map_err(&complain)?;
        if let Some(span) = &lowered.not_finite {
            let error = ExpressionError::new("the expression gives no finite number", span.clone());
            return Err(complain(error));
        }
        let kind = lowered.kind;
        Ok((lowered.formula(), kind, expression))
    }

    /// The rules of factors and offset, where parameters stand in the relation.
    fn bind_rules(
        &self,
        reader: &Reader<'_, '_>,
        sides: [&Expression; 2],
        terms: &[(usize, usize)],
        kept: &[usize],
    ) {
        let rules = &self.context.rules;
        let with = |one: Option<(usize, usize)>| -> Option<[Formula; 2]> {
            let side = |expression: &Expression| {
                rules.open_with(expression, &mut |reference| {
                    let silent = Cell::new(false);
                    let (joint, coordinate, _) = self.coordinate(reference, &silent).ok()?;
                    Some(if one == Some((joint, coordinate)) { 1.0 } else { 0.0 })
                })
            };
            let [left, right] = sides;
            Some([side(left)?, side(right)?])
        };
        let has_parameter = |sides: &[Formula; 2]| sides.iter().any(|side| side.slots().next().is_some());
        let Some(without) = with(None) else {
            sides.into_iter().for_each(|side| rules.fix(side));
            return;
        };
        let all: Vec<[Formula; 2]> = terms.iter().filter_map(|term| with(Some(*term))).collect();
        if !has_parameter(&without) && !all.iter().any(has_parameter) {
            return;
        }
        for (number, term) in kept.iter().enumerate() {
            if let Some(with) = all.get(*term) {
                let rule = Rule::Factor { with: with.clone(), without: without.clone() };
                rules.put(reader.key_path(&format!("factor[{number}]")), rule);
            }
        }
        rules.put(reader.key_path("offset"), Rule::Offset(without));
    }

    fn bind(
        &self,
        reference: &Reference,
        text: &str,
        silent: &Cell<bool>,
    ) -> Result<Binding, ExpressionError> {
        if reference.segments.len() == 1 {
            return self.context.parameter(reference, text, silent).map(Binding::Value);
        }
        let (joint, coordinate, dimension) = self.coordinate(reference, silent)?;
        let mut terms = self.terms.borrow_mut();
        let slot = terms.iter().position(|term| *term == (joint, coordinate)).unwrap_or_else(|| {
            terms.push((joint, coordinate));
            terms.len() - 1
        });
        Ok(Binding::Slot(slot, Kind::Of(dimension)))
    }

    fn coordinate(
        &self,
        reference: &Reference,
        silent: &Cell<bool>,
    ) -> Result<(usize, usize, Dimension), ExpressionError> {
        let example = "joint.pinion.angle";
        let whole = reference.span.clone();
        let mut walk = Walk::new(reference);
        let (root, span) = walk.name("a name", example)?;
        if root != "joint" {
            let error = ExpressionError::new("a coupling can only use the coordinates of joints", span);
            return Err(error.with_hint(format!("for example `{example}`")));
        }
        let (name, span) = walk.name("the name of a joint", example)?;
        let Some(position) = self.context.position(Named::Joint, name) else {
            if self.context.is_told(&self.node.span, self.path) {
                return Err(ExpressionError::new(String::new(), span));
            }
            let (message, hint) = self.context.unknown_name(Named::Joint, name);
            return Err(ExpressionError::new(message, span).with_hint(hint));
        };
        let Some(joint) = self.joints.get(position).filter(|joint| joint.name == name) else {
            silent.set(true);
            return Err(ExpressionError::new(String::new(), span));
        };
        let kind = joint.law.kind;
        let no_vector = || {
            let message = format!("the rotation vector of joint `{name}` cannot be coupled");
            let hint =
                "its components are no turns about axes; couple revolute, cylindrical or universal joints";
            ExpressionError::new(message, whole.clone()).with_hint(hint)
        };
        match kind {
            JointKind::Weld => {
                return Err(ExpressionError::new(
                    format!("joint `{name}` is a weld, it has no coordinate"),
                    span,
                ));
            }
            JointKind::Spherical | JointKind::Contact => return Err(no_vector()),
            JointKind::Free => {
                let turning = |part: &str| part.starts_with('r');
                if let Some((Segment::Name(part), _)) = reference.segments.get(2)
                    && turning(part)
                {
                    return Err(no_vector());
                }
            }
            _ => {}
        }
        let list = coordinates(kind);
        let meaning = walk.quantity(ProbeTarget::Joint(JointId(position)), &list, example)?;
        debug_assert!(list.iter().all(|readable| matches!(readable.part, Part::Number(..))));
        Ok((position, meaning.component.unwrap_or(0), meaning.dimension))
    }
}
