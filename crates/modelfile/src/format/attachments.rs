//! Tables of what holds, joins, springs and loads: ends, bodies, joints, springs, masses, loads.

use super::tables::{key, table, variant};
use super::{Key, Named, Need, Shape, Table, Variants};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension as D;

const AT: Key =
    key("at", Shape::Vector(D::LENGTH), Default("[0, 0, 0]"), "[\"20 mm\", 0, 0]", "Position on the body.");
const ROTATION_KEY: Key = key(
    "rotation",
    Shape::Table(&ROTATION),
    Default("none"),
    "{ axis = [0, 1, 0], angle = \"10 deg\" }",
    "Orientation on the body.",
);
const AXIS: Key = key(
    "axis",
    Shape::Vector(D::NUMBER),
    Required,
    "[1, 0, 0]",
    "The axis, in the fixed frame; need not be of unit length.",
);

const ANGLE_KEYS: &[Key] = &[
    AXIS,
    key("coordinate", Shape::Number(D::ANGLE), Optional, "\"30 deg\"", "Drives the joint to this angle."),
    key(
        "effort",
        Shape::Number(D::MOMENT),
        Default("0"),
        "\"0.2 N*m\"",
        "Loads the joint by this moment on the child.",
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
        "limits",
        Shape::Table(&ANGLE_LIMITS),
        Optional,
        "{ range = [\"-30 deg\", \"30 deg\"] }",
        "The range of the angle.",
    ),
];
const LENGTH_KEYS: &[Key] = &[
    AXIS,
    key("coordinate", Shape::Number(D::LENGTH), Optional, "\"85 mm\"", "Drives the joint to this position."),
    key(
        "effort",
        Shape::Number(D::FORCE),
        Default("0"),
        "\"3 N\"",
        "Loads the joint by this force on the child.",
    ),
    key("stiffness", Shape::Number(D::STIFFNESS), Default("0"), "\"200 N/m\"", "A spring on the position."),
    key("rest", Shape::Number(D::LENGTH), Default("0"), "\"5 mm\"", "Where the spring is relaxed."),
    key(
        "limits",
        Shape::Table(&LENGTH_LIMITS),
        Optional,
        "{ range = [0, \"20 mm\"] }",
        "The range of the position.",
    ),
];
const BALL_KEYS: &[Key] = &[
    key(
        "coordinate",
        Shape::Vector(D::ANGLE),
        Optional,
        "[0, 0, \"30 deg\"]",
        "Drives the joint to this rotation vector.",
    ),
    key(
        "effort",
        Shape::Vector(D::MOMENT),
        Default("none"),
        "[0, 0, \"0.2 N*m\"]",
        "Loads the joint by this moment.",
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
];

pub(crate) static ANGLE_LIMITS: Table = table(
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
pub(crate) static LENGTH_LIMITS: Table = table(
    "A range that is reported when left, and pushes back when it has a stiffness.",
    &[
        key("range", Shape::Range(D::LENGTH), Required, "[0, \"20 mm\"]", "Least and greatest position."),
        key("stiffness", Shape::Number(D::STIFFNESS), Optional, "\"10 N/mm\"", "Stiffness beyond the range."),
    ],
);

pub(crate) static END: Table = Table {
    doc: "How a beam's end is held. Without `at` and `rotation`, the start sits at the body's origin in the body's axes, and the end attaches stress-free where the rest beam ends. With one of the two, the other is zero.",
    keys: &[
        key("body", Shape::Name(Named::BodyOrGround), Required, "\"ground\"", "What holds it."),
        AT,
        ROTATION_KEY,
    ],
    variants: Some(Variants {
        by: "hold",
        by_doc: "What the hold leaves free.",
        default: None,
        list: &[
            variant("clamp", "Nothing.", &[]),
            variant("weld", "Nothing; the same as `clamp`.", &[]),
            variant("pin", "Turning about the point.", BALL_KEYS),
            variant("spherical", "Turning about the point; the same as `pin`.", BALL_KEYS),
            variant("revolute", "Turning about an axis.", ANGLE_KEYS),
            variant("prismatic", "Sliding along an axis.", LENGTH_KEYS),
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
            "About the centre of mass in the body's axes; used by motion only.",
        ),
    ],
);

pub(crate) static JOINT_PLACE: Table = table(
    "A frame on a body.",
    &[key("body", Shape::Name(Named::BodyOrGround), Required, "\"ground\"", "The body."), AT, ROTATION_KEY],
);

pub(crate) static JOINT: Table = Table {
    doc: "A joint between a parent, which carries the fixed frame, and a child, which carries the moving frame. A child without a place starts at coordinate zero. Drive a joint by `coordinate` or load it by `effort`, not both.",
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
            variant("revolute", "Turning about an axis.", ANGLE_KEYS),
            variant("prismatic", "Sliding along an axis.", LENGTH_KEYS),
            variant("spherical", "Turning about a point.", BALL_KEYS),
        ],
    }),
};

pub(crate) static PLACE: Table = table(
    "A point of a body or of a beam.",
    &[
        key(
            "body",
            Shape::Name(Named::BodyOrGround),
            Optional,
            "\"ground\"",
            "The body. Give a body or a beam.",
        ),
        key("beam", Shape::Name(Named::Beam), Optional, "\"link\"", "The beam. Give a body or a beam."),
        key(
            "at",
            Shape::PointOrStation,
            Optional,
            "[\"20 mm\", 0, 0]",
            "The point on the body (its origin unless given), or the place along the beam.",
        ),
    ],
);

pub(crate) static SPRING: Table = Table {
    doc: "A spring between two points.",
    keys: &[
        key(
            "from",
            Shape::Table(&PLACE),
            Required,
            "{ body = \"ground\", at = [0, 0, \"50 mm\"] }",
            "One end.",
        ),
        key("to", Shape::Table(&PLACE), Required, "{ beam = \"link\", at = 0.5 }", "The other end."),
    ],
    variants: Some(Variants {
        by: "law",
        by_doc: "Tension against length.",
        default: Some("linear"),
        list: &[variant(
            "linear",
            "Tension in proportion to the stretch.",
            &[
                key("stiffness", Shape::Number(D::STIFFNESS), Required, "\"200 N/m\"", "Stiffness."),
                key(
                    "rest_length",
                    Shape::Number(D::LENGTH),
                    Default("the initial distance"),
                    "\"40 mm\"",
                    "Length at which it is relaxed.",
                ),
            ],
        )],
    }),
};

pub(crate) static MASS: Table = table(
    "A lumped mass on a beam.",
    &[
        key("beam", Shape::Name(Named::Beam), Required, "\"link\"", "The beam."),
        key("at", Shape::Station, Required, "0.5", "Where along it."),
        key("mass", Shape::Number(D::MASS), Required, "\"50 g\"", "The mass."),
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
