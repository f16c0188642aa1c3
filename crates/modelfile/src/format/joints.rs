//! Tables of joints and of the holds of beam ends: kinds, coordinates, and the places that they connect.

use super::contacts::{BOUNDARY, SLIDE, SURFACE};
use super::tables::{key, table, variant};
use super::{Key, Named, Need, Shape, Table, Variants};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension as D;

pub(super) const BODY_OR_BEAM: Key =
    key("body", Shape::Name(Named::BodyOrGround), Optional, "\"ground\"", "The body. Give a body or a beam.");
pub(super) const BEAM_OR_BODY: Key =
    key("beam", Shape::Name(Named::Beam), Optional, "\"link\"", "The beam. Give a body or a beam.");
pub(super) const POINT_OR_STATION: Key = key(
    "at",
    Shape::PointOrStation,
    Optional,
    "[\"20 mm\", 0, 0]",
    "The point on the body (its origin unless given), or the place along the beam.",
);
pub(super) const OFFSET: Key = key(
    "offset",
    Shape::Vector(D::LENGTH),
    Default("[0, 0, 0]"),
    "[0, \"2 mm\", 0]",
    "On a beam: the point, in the section's axes e1, e2, e3.",
);
pub(super) const ROTATION_KEY: Key = key(
    "rotation",
    Shape::Table(&ROTATION),
    Default("none"),
    "{ axis = [0, 1, 0], angle = \"10 deg\" }",
    "Orientation in the body's axes, or in those of the beam's section.",
);
const AXIS: Key = key(
    "axis",
    Shape::Vector(D::NUMBER),
    Required,
    "[1, 0, 0]",
    "The axis, in the fixed frame; need not be of unit length.",
);

macro_rules! angle_keys {
    ($($first:expr),*) => {
        &[
            $($first,)*
            key("coordinate", Shape::Number(D::ANGLE), Optional, "\"30 deg\"", "Drives it to this angle."),
            key(
                "effort",
                Shape::Number(D::MOMENT),
                Default("0"),
                "\"0.2 N*m\"",
                "Loads it by this moment on the child.",
            ),
            key(
                "stiffness",
                Shape::Number(D::ANGULAR_STIFFNESS),
                Default("0"),
                "\"0.69 N*m/rad\"",
                "A spring on the angle.",
            ),
            key("rest", Shape::Number(D::ANGLE), Default("0"), "\"10 deg\"", "Where the spring is relaxed."),
            key(
                "damping",
                Shape::Number(D::ANGULAR_DAMPING),
                Default("0"),
                "\"0.01 N*m*s/rad\"",
                "Moment against its angular velocity.",
            ),
            key(
                "limits",
                Shape::Table(&ANGLE_LIMITS),
                Optional,
                "{ range = [\"-30 deg\", \"30 deg\"] }",
                "The range of the angle.",
            ),
        ]
    };
}
macro_rules! length_keys {
    ($($first:expr)?) => {
        &[
            $($first,)?
            key(
                "coordinate",
                Shape::Number(D::LENGTH),
                Optional,
                "\"85 mm\"",
                "Drives it to this position.",
            ),
            key(
                "effort",
                Shape::Number(D::FORCE),
                Default("0"),
                "\"3 N\"",
                "Loads it by this force on the child.",
            ),
            key(
                "stiffness",
                Shape::Number(D::STIFFNESS),
                Default("0"),
                "\"200 N/m\"",
                "A spring on the position.",
            ),
            key("rest", Shape::Number(D::LENGTH), Default("0"), "\"5 mm\"", "Where the spring is relaxed."),
            key(
                "damping",
                Shape::Number(D::DAMPING),
                Default("0"),
                "\"2 N*s/m\"",
                "Force against its velocity.",
            ),
            key(
                "limits",
                Shape::Table(&LENGTH_LIMITS),
                Optional,
                "{ range = [0, \"20 mm\"] }",
                "The range of the position.",
            ),
        ]
    };
}

const BALL_KEYS: &[Key] = &[
    key(
        "coordinate",
        Shape::Vector(D::ANGLE),
        Optional,
        "[0, 0, \"30 deg\"]",
        "Drives it to this rotation vector.",
    ),
    key(
        "effort",
        Shape::Vector(D::MOMENT),
        Default("none"),
        "[0, 0, \"0.2 N*m\"]",
        "Loads it by this moment.",
    ),
    key(
        "stiffness",
        Shape::Number(D::ANGULAR_STIFFNESS),
        Default("0"),
        "\"0.69 N*m/rad\"",
        "A spring on each component of the rotation vector.",
    ),
    key(
        "rest",
        Shape::Vector(D::ANGLE),
        Default("none"),
        "[0, 0, \"10 deg\"]",
        "Where the spring is relaxed.",
    ),
    key(
        "damping",
        Shape::Number(D::ANGULAR_DAMPING),
        Default("0"),
        "\"0.01 N*m*s/rad\"",
        "Moment against its angular velocity, alike about all axes.",
    ),
];

static ANGLE: Table = table("What drives, loads or springs an angle.", angle_keys!());
static LENGTH: Table = table("What drives, loads or springs a position.", length_keys!());
static BALL: Table = table("What drives, loads or springs a rotation vector.", BALL_KEYS);

const fn angle(name: &'static str, doc: &'static str) -> Key {
    key(name, Shape::Table(&ANGLE), Default("free"), "{ coordinate = \"30 deg\" }", doc)
}
const fn length(name: &'static str, doc: &'static str) -> Key {
    key(name, Shape::Table(&LENGTH), Default("free"), "{ stiffness = \"200 N/m\", rest = \"5 mm\" }", doc)
}
const fn ball(name: &'static str, doc: &'static str) -> Key {
    key(name, Shape::Table(&BALL), Default("free"), "{ stiffness = \"0.69 N*m/rad\" }", doc)
}

const REVOLUTE: &[Key] = angle_keys!(AXIS);
const PRISMATIC: &[Key] = length_keys!(AXIS);
const CYLINDRICAL: &[Key] =
    &[AXIS, angle("angle", "Turning about the axis."), length("position", "Sliding along the axis.")];
const UNIVERSAL: &[Key] = &[
    key(
        "axis",
        Shape::Vector(D::NUMBER),
        Required,
        "[1, 0, 0]",
        "The first axis, in the fixed frame; need not be of unit length.",
    ),
    key(
        "second_axis",
        Shape::Vector(D::NUMBER),
        Required,
        "[0, 1, 0]",
        "The axis that the first turning carries along, as it stands at zero; at right angles to the first.",
    ),
    angle("first", "Turning about the first axis."),
    angle("second", "Turning about the second axis."),
];
const PLANAR: &[Key] = &[
    key(
        "axis",
        Shape::Vector(D::NUMBER),
        Required,
        "[0, 0, 1]",
        "The plane's normal, in the fixed frame; need not be of unit length.",
    ),
    key(
        "x_axis",
        Shape::Vector(D::NUMBER),
        Default("the fixed frame's x axis (its y axis where the normal is x), turned into the plane"),
        "[1, 0, 0]",
        "The direction of x, at right angles to the normal.",
    ),
    length("x", "Sliding along x."),
    length("y", "Sliding along y, which is the normal times x."),
    angle("angle", "Turning about the normal."),
];
const ROLLING: &[Key] = angle_keys!(
    key(
        "axis",
        Shape::Vector(D::NUMBER),
        Default("[0, 0, 1]"),
        "[0, 0, 1]",
        "The normal of the plane in which the boundaries lie, in the fixed frame; need not be of unit length.",
    ),
    key(
        "x_axis",
        Shape::Vector(D::NUMBER),
        Default("the fixed frame's x axis (its y axis where the normal is x), turned into the plane"),
        "[1, 0, 0]",
        "The direction of x, at right angles to the normal.",
    ),
    key(
        "child_curve",
        Shape::Table(&BOUNDARY),
        Required,
        "{ kind = \"ellipse\", semi_axes = [\"2 cm\", \"1 cm\"] }",
        "The moving boundary, in the child's frame.",
    ),
    key(
        "parent_curve",
        Shape::Table(&BOUNDARY),
        Required,
        "{ kind = \"line\", normal = [0, 1] }",
        "The fixed boundary, in the parent's frame.",
    ),
    key(
        "concave",
        Shape::Flag,
        Default("false"),
        "true",
        "The child lies within the parent's curve and touches it from there.",
    ),
    key(
        "start",
        Shape::AnyPair,
        Default("where the initial poses bring the two closest"),
        "[\"-90 deg\", \"90 deg\"]",
        "Where they touch at coordinate zero: the parameter of the child's curve, then that of the parent's.",
    ),
    key(
        "by",
        Shape::Choice(&[
            ("angle", "By how much the child has turned."),
            (
                "turning",
                "By how much the child has turned against the contact's normal; its boundary must be convex."
            ),
            ("arc", "How far the contact has travelled on the child."),
        ]),
        Default("\"angle\""),
        "\"turning\"",
        "What the coordinate is. One that is an arc is driven or loaded in the table `arc`.",
    ),
    length("arc", "With `by = \"arc\"`: what drives, loads or springs the arc."),
    key(
        "slide",
        Shape::Table(&SLIDE),
        Default("{ kind = \"none\" }"),
        "{ kind = \"ratio\", ratio = 1.7 }",
        "How the child slides as it rolls.",
    ),
    key(
        "close",
        Shape::Flag,
        Default("false"),
        "true",
        "Bodies that do not touch in the initial poses are brought together.",
    )
);
const CONTACT: &[Key] = angle_keys!(
    key(
        "child_surface",
        Shape::Table(&SURFACE),
        Required,
        "{ kind = \"ellipsoid\", semi_axes = [\"9.2 mm\", \"3.1 mm\", \"2.3 mm\"] }",
        "The moving surface, in the child's frame.",
    ),
    key(
        "parent_surface",
        Shape::Table(&SURFACE),
        Required,
        "{ kind = \"sphere\", radius = \"12 mm\" }",
        "The fixed surface, in the parent's frame.",
    ),
    key(
        "concave",
        Shape::Flag,
        Default("false"),
        "true",
        "The child lies within the parent's surface and touches it from there.",
    ),
    key(
        "motion",
        Shape::Choice(&[
            ("sliding", "Free, without friction: the contact carries a normal force only."),
            ("rolling", "Without slip and spin about a given axis; one angle."),
            ("osculating", "Without slip and spin, the contact travelling across a given axis; one angle."),
        ]),
        Default("\"sliding\""),
        "\"rolling\"",
        "How the child moves on the parent. One that rolls has an angle, which the joint's own keys drive or load.",
    ),
    key(
        "about",
        Shape::Vector(D::NUMBER),
        Optional,
        "[0, 1, 0]",
        "Of a rolling motion: the axis, in the fixed frame. Its part along the normal is left out.",
    ),
    key(
        "range",
        Shape::Range(D::ANGLE),
        Default("half a turn both ways"),
        "[\"-60 deg\", \"60 deg\"]",
        "Of a rolling motion: least and greatest angle.",
    ),
    ball("rotation", "Of a sliding motion: the rotation vector from the fixed to the moving frame."),
    key(
        "close",
        Shape::Flag,
        Default("false"),
        "true",
        "Bodies that do not touch in the initial poses are brought together.",
    )
);
const FREE: &[Key] = &[
    length("x", "Along the fixed frame's x."),
    length("y", "Along the fixed frame's y."),
    length("z", "Along the fixed frame's z."),
    ball("rotation", "The rotation vector from the fixed to the moving frame."),
];
const FREE_HOLD: &[Key] = &[
    length("x", "Along the fixed frame's x."),
    length("y", "Along the fixed frame's y."),
    length("z", "Along the fixed frame's z."),
    ball(
        "turning",
        "The rotation vector from the fixed to the moving frame; `rotation` places the fixed frame.",
    ),
];

static ANGLE_LIMITS: Table = table(
    "A range that is reported when left, and pushes back when it has a stiffness.",
    &[
        key(
            "range",
            Shape::Range(D::ANGLE),
            Required,
            "[\"-30 deg\", \"30 deg\"]",
            "Least and greatest angle.",
        ),
        key(
            "stiffness",
            Shape::Number(D::ANGULAR_STIFFNESS),
            Optional,
            "\"10 N*m/rad\"",
            "Stiffness beyond the range.",
        ),
    ],
);
static LENGTH_LIMITS: Table = table(
    "A range that is reported when left, and pushes back when it has a stiffness.",
    &[
        key("range", Shape::Range(D::LENGTH), Required, "[0, \"20 mm\"]", "Least and greatest position."),
        key("stiffness", Shape::Number(D::STIFFNESS), Optional, "\"10 N/mm\"", "Stiffness beyond the range."),
    ],
);

pub(crate) static END: Table = Table {
    doc: "How a beam's end is held, by a body or by the section of another beam. Without `at` and `rotation` on a body, and without `offset` and `rotation` on a beam, the start sits at the origin in the axes of what holds it, and the end attaches stress-free where the rest beam ends. With one of the two, the other is zero.",
    keys: &[BODY_OR_BEAM, BEAM_OR_BODY, POINT_OR_STATION, OFFSET, ROTATION_KEY],
    variants: Some(Variants {
        by: "hold",
        by_doc: "What the hold leaves free.",
        default: None,
        list: &[
            variant("clamp", "Nothing.", &[]),
            variant("weld", "Nothing; the same as `clamp`.", &[]),
            variant("pin", "Turning about the point.", BALL_KEYS),
            variant("spherical", "Turning about the point; the same as `pin`.", BALL_KEYS),
            variant("revolute", "Turning about an axis.", REVOLUTE),
            variant("prismatic", "Sliding along an axis.", PRISMATIC),
            variant("cylindrical", "Turning about an axis and sliding along it.", CYLINDRICAL),
            variant("universal", "Turning about two axes at right angles.", UNIVERSAL),
            variant("planar", "Sliding in a plane and turning about its normal.", PLANAR),
            variant("free", "Everything; for springs on the coordinates.", FREE_HOLD),
        ],
    }),
};

pub(crate) static ROTATION: Table = table(
    "An orientation: `axis` and `angle`, or `quat_wxyz`, or `rpy`.",
    &[
        key(
            "axis",
            Shape::Vector(D::NUMBER),
            Optional,
            "[0, 1, 0]",
            "Axis of the turn; need not be of unit length.",
        ),
        key("angle", Shape::Number(D::ANGLE), Optional, "\"10 deg\"", "Angle of the turn."),
        key("quat_wxyz", Shape::Quaternion, Optional, "[1, 0, 0, 0]", "A unit quaternion, real part first."),
        key(
            "rpy",
            Shape::Vector(D::ANGLE),
            Optional,
            "[0, 0, \"90 deg\"]",
            "Roll, pitch, yaw: Rz(yaw) Ry(pitch) Rx(roll).",
        ),
    ],
);

static JOINT_PLACE: Table = table(
    "A frame on a body, or on the section of a beam.",
    &[BODY_OR_BEAM, BEAM_OR_BODY, POINT_OR_STATION, OFFSET, ROTATION_KEY],
);

pub(crate) static JOINT: Table = Table {
    doc: "A joint between a parent, which carries the fixed frame, and a child, which carries the moving frame. A child without a place on it starts at coordinate zero. Drive a coordinate by `coordinate` or load it by `effort`, not both. A joint of several coordinates has a table for each, which bears its name.",
    keys: &[
        key(
            "parent",
            Shape::Placed(&JOINT_PLACE),
            Required,
            "\"ground\"",
            "Carries the fixed frame; at its origin unless placed.",
        ),
        key(
            "child",
            Shape::Placed(&JOINT_PLACE),
            Required,
            "\"slider\"",
            "Carries the moving frame; where the fixed frame is initially unless placed.",
        ),
    ],
    variants: Some(Variants {
        by: "kind",
        by_doc: "What the joint leaves free.",
        default: None,
        list: &[
            variant("weld", "Nothing.", &[]),
            variant("revolute", "Turning about an axis; its coordinate is an angle.", REVOLUTE),
            variant("prismatic", "Sliding along an axis; its coordinate is a position.", PRISMATIC),
            variant("cylindrical", "Turning about an axis and sliding along it.", CYLINDRICAL),
            variant("universal", "Turning about two axes at right angles, as a Cardan joint.", UNIVERSAL),
            variant("spherical", "Turning about a point.", BALL_KEYS),
            variant("planar", "Sliding in a plane and turning about its normal.", PLANAR),
            variant("free", "Everything; for springs on the coordinates, or to drive a body.", FREE),
            variant(
                "rolling",
                "A boundary of the child rolls and slides on one of the parent, in a plane; a child without a place has its boundary about its origin.",
                ROLLING,
            ),
            variant(
                "contact",
                "A surface of the child touches one of the parent; a child without a place has its surface about its origin. The first contact is found from the initial poses.",
                CONTACT,
            ),
        ],
    }),
};
