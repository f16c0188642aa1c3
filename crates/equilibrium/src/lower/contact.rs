//! What is asked of a contact before anything is solved, and how it is told.

use super::length_text;
use crate::coordinates::Coordinates;
use crate::error::ProblemError;
use flexura_mechanics::joint::ContactError;
use flexura_model::{Contact, CoordinateKind, Joint};
use flexura_spatial::Twist;

/// Boundaries this far apart, relative to their size, are a rounded number and no mistake.
const ROUNDED: f64 = 1e-6;

/// A contact that makes no sense, in the words of the model file.
pub(super) fn problem(joint: &Joint, error: &ContactError) -> ProblemError {
    let path = format!("joint.{}", joint.name);
    let (key, hint) = match error {
        ContactError::Boundary { which: "child", .. } => ("child_curve", "mend the child's boundary"),
        ContactError::Boundary { .. } => ("parent_curve", "mend the parent's boundary"),
        ContactError::Missing => ("kind", "give both of its boundaries or surfaces"),
        ContactError::NotConvex => ("by", "use `by = \"angle\"` or `by = \"arc\"`"),
        ContactError::BothStraight => {
            ("parent_curve", "make one of the two a curve, or use a prismatic joint")
        }
        ContactError::TooCurved { .. } => (
            "concave",
            "make the hollow wider than the child, or let them only slide: `slide = { kind = \"pure\" }`",
        ),
        ContactError::NoContact => {
            ("start", "turn the child so that the two can touch, or say where they do with `start`")
        }
        ContactError::StartOutside { .. } => ("start", "give parameters that lie on the two boundaries"),
        ContactError::TravelAtZero { .. }
        | ContactError::VelocityByArc
        | ContactError::SlideNumber { .. }
        | ContactError::SlideTable => ("slide", "see the reference page on rolling joints"),
        ContactError::Surface { which: "child", .. } => ("child_surface", "mend the child's surface"),
        ContactError::Surface { .. } => ("parent_surface", "mend the parent's surface"),
        ContactError::NoneRounded => {
            ("child_surface", "give one of the two a small curvature in its straight direction: an ellipsoid")
        }
        ContactError::Cuts { .. } => ("concave", "make the hollow wider than the child, in both directions"),
        ContactError::NoAxis | ContactError::AxisAlongNormal => {
            ("about", "give an axis across the normal of the contact")
        }
        ContactError::RollingRange { .. } => ("range", "for example `range = [\"-90 deg\", \"90 deg\"]`"),
        ContactError::Conforming { .. } => (
            "slide",
            "give the two different curvatures, or let them only slide: `slide = { kind = \"pure\" }`",
        ),
    };
    ProblemError::new(format!("{path}.{key}"), error.to_string(), hint)
}

/// Do the boundaries touch, and does a drive stay on them?
pub(super) fn check(
    joint: &Joint,
    law: &Contact,
    coordinates: &Coordinates,
    mismatch: &Twist,
    apart: f64,
) -> Result<(), ProblemError> {
    let path = format!("joint.{}", joint.name);
    let close = match law {
        Contact::Rolling(rolling) => rolling.close,
        Contact::Surfaces(surfaces) => surfaces.close,
    };
    let turned = mismatch.angular.norm();
    if !close && (mismatch.linear.norm() > ROUNDED || turned > ROUNDED) {
        let turn = if turned > ROUNDED {
            format!(" and turned by {:.4} deg", turned.to_degrees())
        } else {
            String::new()
        };
        return Err(ProblemError::new(
            path,
            format!(
                "the two bodies do not touch in the initial poses: they are {}{turn} apart",
                length_text(apart)
            ),
            "move the child, or let `close = true` bring them together",
        ));
    }
    if let Some((value, range)) = coordinates.driven_beyond() {
        let text = |v: f64| match coordinates.kind.coordinate_kinds()[0] {
            CoordinateKind::Angle => format!("{:.4} deg", v.to_degrees()),
            CoordinateKind::Length => length_text(v),
        };
        return Err(ProblemError::new(
            format!("{path}.coordinate"),
            format!(
                "the {} of {} lies beyond the end of a boundary or of the slide law: there is contact from {} to {}",
                coordinates.kind.coordinate_names()[0],
                text(value),
                text(range[0]),
                text(range[1])
            ),
            "drive it within this range, or give longer boundaries",
        ));
    }
    Ok(())
}
