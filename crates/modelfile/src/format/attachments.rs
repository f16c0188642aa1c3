//! Tables of bodies, masses and loads.

use super::joints::ROTATION;
use super::tables::{key, table};
use super::{Named, Need, Shape, Table};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension as D;

pub(crate) static BODY: Table = table(
    "A rigid body in its initial pose.",
    &[
        key(
            "at",
            Shape::Vector(D::LENGTH),
            Default("[0, 0, 0]"),
            "[\"152.4 mm\", 0, 0]",
            "Initial position.",
        ),
        key(
            "rotation",
            Shape::Table(&ROTATION),
            Default("none"),
            "{ axis = [0, 1, 0], angle = \"10 deg\" }",
            "Initial orientation.",
        ),
        key("mass", Shape::Number(D::MASS), Default("massless"), "\"0.3 kg\"", "Mass."),
        key(
            "center_of_mass",
            Shape::Vector(D::LENGTH),
            Default("[0, 0, 0]"),
            "[0, 0, \"5 mm\"]",
            "Centre of mass in the body's axes.",
        ),
        key(
            "inertia",
            Shape::Inertia,
            Default("0"),
            "[1e-5, 1e-5, 2e-5]",
            "About the centre of mass in the body's axes; used by motion and modes.",
        ),
    ],
);

pub(crate) static MASS: Table = table(
    "A lumped mass on a beam.",
    &[
        key("beam", Shape::Name(Named::Beam), Required, "\"link\"", "The beam."),
        key("at", Shape::Station, Required, "0.5", "Where along it."),
        key("mass", Shape::Number(D::MASS), Required, "\"50 g\"", "The mass."),
        key(
            "inertia",
            Shape::Inertia,
            Default("0"),
            "[1e-6, 2e-6, 2e-6]",
            "About its centre in the axes of the beam's section; used by modes.",
        ),
    ],
);

pub(crate) static LOAD: Table = table(
    "A force and a moment on a body or a beam.",
    &[
        key("body", Shape::Name(Named::Body), Optional, "\"slider\"", "The body. Give a body or a beam."),
        key("beam", Shape::Name(Named::Beam), Optional, "\"link\"", "The beam. Give a body or a beam."),
        key(
            "at",
            Shape::PointOrStation,
            Optional,
            "1",
            "The point on the body (its origin unless given), or the place along the beam.",
        ),
        key("force", Shape::Vector(D::FORCE), Default("none"), "[\"-push\", 0, 0]", "Force."),
        key("moment", Shape::Vector(D::MOMENT), Default("none"), "[0, 0, \"0.1 N*m\"]", "Moment."),
        key(
            "frame",
            Shape::Choice(&[
                ("global", "dead: constant in global axes"),
                ("local", "follower: turns with the body or the section"),
            ]),
            Default("\"global\""),
            "\"local\"",
            "Dead or follower.",
        ),
    ],
);
