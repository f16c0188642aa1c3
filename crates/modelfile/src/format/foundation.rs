//! The table of an elastic foundation.

use super::tables::{key, table};
use super::{Need, Shape, Table};
use Need::{Default, Optional};
use flexura_expression::Dimension as D;

pub(crate) static FOUNDATION: Table = table(
    "What pushes a beam back to where it lies in the undeformed mechanism. Give `stiffness` or `force`.",
    &[
        key(
            "stiffness",
            Shape::Profile(D::PRESSURE),
            Optional,
            "\"1 kN/m^2\"",
            "Restoring force per length and displacement: a number, or an expression of s.",
        ),
        key(
            "force",
            Shape::Function(D::STIFFNESS),
            Optional,
            "\"2e3*u + 5e7*u^3\"",
            "Restoring force per length as an expression of the displacement u, zero at u = 0. Needs `direction`.",
        ),
        key(
            "direction",
            Shape::Vector(D::NUMBER),
            Default("all directions alike"),
            "[0, 1, 0]",
            "The only direction in which it acts; u is the displacement along it.",
        ),
        key(
            "axes",
            Shape::Choice(&[
                ("global", "global axes"),
                ("section", "the axes e1, e2, e3 of the section in the undeformed mechanism"),
            ]),
            Default("\"global\""),
            "\"section\"",
            "The axes in which the direction is given.",
        ),
        key("from", Shape::Station, Default("0"), "0.2", "Where along the beam it begins."),
        key("to", Shape::Station, Default("1"), "\"80 mm\"", "Where it ends."),
    ],
);
