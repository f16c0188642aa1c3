//! Tables of concentric tubes.

use super::joints::ROTATION;
use super::tables::{key, table};
use super::{Named, Need, Shape, Table};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension as D;

pub(crate) static TUBES: Table = table(
    "Concentric tubes: one to four, each inside the next, pre-curved in front, turning and sliding in each other without friction. They neither stretch nor shear.",
    &[
        key(
            "base",
            Shape::Placed(&BASE),
            Required,
            "{ body = \"ground\", at = [0, 0, \"50 mm\"] }",
            "The mouth of their guide, on a body or on the ground; they leave it along the frame's x axis.",
        ),
        key(
            "tube",
            Shape::Tables(&TUBE),
            Required,
            "[{ material = \"nitinol\", section = \"inner\", straight = \"200 mm\", curved = \"60 mm\", radius = \"80 mm\" }]",
            "The tubes, the innermost first; it must reach at least as far as any other.",
        ),
        key(
            "force",
            Shape::Vector(D::FORCE),
            Default("none"),
            "[0, 0, \"-0.2 N\"]",
            "Dead force on the tip of the innermost, global axes.",
        ),
        key(
            "moment",
            Shape::Vector(D::MOMENT),
            Default("none"),
            "[\"2 N*mm\", 0, 0]",
            "Dead moment there, global axes.",
        ),
    ],
);

static BASE: Table = table(
    "A frame on a body or on the ground.",
    &[
        key("body", Shape::Name(Named::BodyOrGround), Required, "\"ground\"", "The body."),
        key(
            "at",
            Shape::Vector(D::LENGTH),
            Default("[0, 0, 0]"),
            "[\"20 mm\", 0, 0]",
            "The origin, in the body's axes.",
        ),
        key(
            "rotation",
            Shape::Table(&ROTATION),
            Default("none"),
            "{ axis = [0, 1, 0], angle = \"-90 deg\" }",
            "Orientation in the body's axes.",
        ),
    ],
);

static TUBE: Table = table(
    "A round tube, straight at its back and of constant rest curvature in front. Give `radius` or `curvature`, or neither where it is straight.",
    &[
        key(
            "material",
            Shape::Name(Named::Material),
            Optional,
            "\"nitinol\"",
            "Its material; only a section given as a stiffness needs none.",
        ),
        key(
            "section",
            Shape::Name(Named::Section),
            Required,
            "\"inner\"",
            "Its cross section: a circle, a tube, or a stiffness with EI2 = EI3, the same all along.",
        ),
        key("straight", Shape::Number(D::LENGTH), Default("0"), "\"200 mm\"", "Length of the straight part."),
        key("curved", Shape::Number(D::LENGTH), Default("0"), "\"60 mm\"", "Length of the curved part."),
        key(
            "radius",
            Shape::Number(D::LENGTH),
            Optional,
            "\"80 mm\"",
            "Rest radius of curvature; the tube bends towards +y of the base where it is not turned.",
        ),
        key(
            "curvature",
            Shape::Number(D::CURVATURE),
            Optional,
            "\"12 1/m\"",
            "Rest curvature, instead of the radius; negative bends towards -y.",
        ),
        key(
            "rotation",
            Shape::Number(D::ANGLE),
            Default("0"),
            "\"30 deg\"",
            "Turn of its back end about the axis.",
        ),
        key(
            "translation",
            Shape::Number(D::LENGTH),
            Default("0"),
            "\"-20 mm\"",
            "Where its back end is on the axis: zero at the guide's mouth, negative in the guide, which keeps it straight.",
        ),
    ],
);
