//! Tables of what rolls and slides on what.

use super::tables::{FIRST_COORDINATE, PARAMETER, PARAMETER_RANGE, SECOND_COORDINATE, key, variant};
use super::{Key, Need, Shape, Table, Variants};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension as D;

const OUTSIDE: Key = key(
    "outside",
    Shape::Choice(&[
        ("left", "On the left along growing parameter."),
        ("right", "On the right along growing parameter."),
    ]),
    Default("around a closed curve; on the right of an open one"),
    "\"left\"",
    "On which side of it the outside of the body lies.",
);
const ARC: Key = key(
    "range",
    Shape::Range(D::ANGLE),
    Default("all of it"),
    "[\"180 deg\", \"360 deg\"]",
    "First and last parameter, if it is an arc only.",
);

pub(crate) static BOUNDARY: Table = Table {
    doc: "The boundary of a body in the plane of a joint, in the x and y of its frame.",
    keys: &[],
    variants: Some(Variants {
        by: "kind",
        by_doc: "The curve.",
        default: None,
        list: &[
            variant(
                "ellipse",
                "About the frame's origin; the parameter is the eccentric angle t of (a cos t, b sin t).",
                &[
                    key(
                        "semi_axes",
                        Shape::Range(D::LENGTH),
                        Required,
                        "[\"2 cm\", \"1 cm\"]",
                        "a along x and b along y.",
                    ),
                    ARC,
                ],
            ),
            variant(
                "circle",
                "About the frame's origin; the parameter is the angle from x.",
                &[key("radius", Shape::Number(D::LENGTH), Required, "\"8 mm\"", "Its radius."), ARC],
            ),
            variant(
                "line",
                "A straight line; the parameter is the distance from its point, growing to the left as one looks against the normal from outside.",
                &[
                    key(
                        "point",
                        Shape::Range(D::LENGTH),
                        Default("[0, 0]"),
                        "[0, \"5 mm\"]",
                        "A point of it.",
                    ),
                    key(
                        "normal",
                        Shape::Range(D::NUMBER),
                        Required,
                        "[0, 1]",
                        "Points away from the body; need not be of unit length.",
                    ),
                    key(
                        "range",
                        Shape::Range(D::LENGTH),
                        Default("without end"),
                        "[\"-20 mm\", \"20 mm\"]",
                        "First and last parameter.",
                    ),
                ],
            ),
            variant(
                "arcs",
                "Circular arcs that join smoothly; the parameter is the arc length.",
                &[
                    key(
                        "point",
                        Shape::Range(D::LENGTH),
                        Default("[0, 0]"),
                        "[\"5 mm\", 0]",
                        "Where the first begins.",
                    ),
                    key(
                        "direction",
                        Shape::Range(D::NUMBER),
                        Default("[1, 0]"),
                        "[0, 1]",
                        "The direction in which it begins.",
                    ),
                    key(
                        "arcs",
                        Shape::Pairs,
                        Required,
                        "[[\"32 mm\", \"30 deg\"], [\"21 mm\", \"90 deg\"]]",
                        "Radius and angle of each; a positive angle bends to the left.",
                    ),
                    OUTSIDE,
                ],
            ),
            variant(
                "points",
                "A smooth curve (C2 cubic spline) through points; the parameter is the length of the chords, m.",
                &[
                    key(
                        "points",
                        Shape::PlanePoints,
                        Optional,
                        "[[\"10 mm\", 0], [0, \"8 mm\"], [\"-10 mm\", 0], [0, \"-8 mm\"]]",
                        "The points. Give them here or in a file.",
                    ),
                    key(
                        "file",
                        Shape::Text,
                        Optional,
                        "\"outline.csv\"",
                        "A CSV file with the columns x, y, beside the model file.",
                    ),
                    key(
                        "unit",
                        Shape::Text,
                        Default("\"m\""),
                        "\"mm\"",
                        "The unit of the numbers in the file.",
                    ),
                    key(
                        "closed",
                        Shape::Flag,
                        Default("true"),
                        "false",
                        "The curve leads back from the last point to the first.",
                    ),
                    OUTSIDE,
                ],
            ),
            variant(
                "expression",
                "(x(t), y(t)).",
                &[
                    FIRST_COORDINATE,
                    SECOND_COORDINATE,
                    PARAMETER,
                    PARAMETER_RANGE,
                    key(
                        "closed",
                        Shape::Flag,
                        Default("false"),
                        "true",
                        "The last point is the first, and the curve is smooth there.",
                    ),
                    OUTSIDE,
                ],
            ),
        ],
    }),
};

const TRAVEL: &str = "An expression of the joint's coordinate `q`; zero at q = 0.";

pub(crate) static SLIDE: Table = Table {
    doc: "How the child slides as it rolls. The travel of the contact on the child is that on the parent (the roll) and the slide.",
    keys: &[],
    variants: Some(Variants {
        by: "kind",
        by_doc: "The law.",
        default: None,
        list: &[
            variant("none", "Rolling without slip.", &[]),
            variant("pure", "Sliding only: the contact stays where it is on the parent.", &[]),
            variant(
                "velocity",
                "With a constant velocity at a constant rate of the coordinate.",
                &[
                    key(
                        "velocity",
                        Shape::Number(D::VELOCITY),
                        Required,
                        "\"1.309 mm/s\"",
                        "Sliding velocity.",
                    ),
                    key(
                        "rate",
                        Shape::Number(D::ANGULAR_VELOCITY),
                        Required,
                        "\"15 deg/s\"",
                        "Rate of the coordinate.",
                    ),
                ],
            ),
            variant(
                "ratio",
                "Roll and slide in a constant ratio.",
                &[key("ratio", Shape::Number(D::NUMBER), Required, "1.7", "Roll per slide.")],
            ),
            variant(
                "law",
                "Given by the coordinate.",
                &[key("slide", Shape::Function(D::LENGTH), Required, "\"2 mm*sin(q)\"", TRAVEL)],
            ),
            variant(
                "table",
                "Interpolated by a C2 cubic spline.",
                &[key(
                    "rows",
                    Shape::Pairs,
                    Required,
                    "[[0, 0], [\"30 deg\", \"2 mm\"], [\"60 deg\", \"3 mm\"]]",
                    "Rows of coordinate and slide, the coordinate increasing.",
                )],
            ),
            variant(
                "measured",
                "Roll and slide are both given, as measured.",
                &[
                    key("roll", Shape::Function(D::LENGTH), Required, "\"20 mm*q\"", TRAVEL),
                    key("slide", Shape::Function(D::LENGTH), Required, "\"12 mm*q\"", TRAVEL),
                ],
            ),
            variant(
                "stepped",
                "No slip, but the travel in explicit steps of the coordinate, each with the radius of curvature at its beginning: of first order in the step, to be compared with.",
                &[key(
                    "step",
                    Shape::Number(D::ANGLE),
                    Required,
                    "\"15 deg\"",
                    "The step of the coordinate.",
                )],
            ),
        ],
    }),
};

const SEMI_AXES: Key = key(
    "semi_axes",
    Shape::Vector(D::LENGTH),
    Required,
    "[\"9.2 mm\", \"3.1 mm\", \"2.3 mm\"]",
    "Along x, y and z.",
);

pub(crate) static SURFACE: Table = Table {
    doc: "The surface of a body, about the origin of its frame.",
    keys: &[],
    variants: Some(Variants {
        by: "kind",
        by_doc: "The surface.",
        default: None,
        list: &[
            variant("ellipsoid", "With its axes along x, y and z.", &[SEMI_AXES]),
            variant(
                "sphere",
                "About the origin.",
                &[key("radius", Shape::Number(D::LENGTH), Required, "\"12 mm\"", "Its radius.")],
            ),
            variant(
                "cylinder",
                "Elliptic, along z, without end.",
                &[key(
                    "semi_axes",
                    Shape::Range(D::LENGTH),
                    Required,
                    "[\"2.6 mm\", \"6.6 mm\"]",
                    "Along x and y.",
                )],
            ),
            variant("plane", "z = 0, with the outside at positive z.", &[]),
            variant(
                "revolution",
                "A meridian turned about z; where its radius ends at zero the surface has a pole. Give `points`, or `radius` with `range`.",
                &[
                    key(
                        "points",
                        Shape::Pairs,
                        Optional,
                        "[[\"-5 mm\", 0], [\"-2 mm\", \"3 mm\"], [\"1 mm\", \"3.5 mm\"], [\"5 mm\", 0]]",
                        "Rows of z and radius, z increasing, joined by a C2 spline of the radius squared.",
                    ),
                    key(
                        "radius",
                        Shape::Function(D::LENGTH),
                        Optional,
                        "\"4 mm - 20 1/m*z^2\"",
                        "The radius as an expression of `z`.",
                    ),
                    key(
                        "range",
                        Shape::Range(D::LENGTH),
                        Optional,
                        "[\"-5 mm\", \"5 mm\"]",
                        "First and last z of the expression.",
                    ),
                ],
            ),
            variant(
                "heights",
                "Measured points over an ellipsoid, to which a smooth surface is fitted.",
                &[
                    SEMI_AXES,
                    key(
                        "points",
                        Shape::Points,
                        Optional,
                        "[[\"9 mm\", 0, 0], [0, \"3 mm\", 0]]",
                        "The points. Give them here or in a file.",
                    ),
                    key(
                        "file",
                        Shape::Text,
                        Optional,
                        "\"condyle.csv\"",
                        "A CSV file with the columns x, y, z, beside the model file.",
                    ),
                    key(
                        "unit",
                        Shape::Text,
                        Default("\"m\""),
                        "\"mm\"",
                        "The unit of the numbers in the file.",
                    ),
                    key(
                        "degree",
                        Shape::Count,
                        Default("4"),
                        "6",
                        "Degree of the polynomial in x, y and z that is fitted by least squares.",
                    ),
                ],
            ),
        ],
    }),
};
