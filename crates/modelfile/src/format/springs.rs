//! The table of springs, with their laws and what they run over.

use super::joints::{BEAM_OR_BODY, BODY_OR_BEAM, OFFSET, POINT_OR_STATION, ROTATION_KEY};
use super::tables::{key, table, variant};
use super::{Need, Shape, Table, Variants};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension as D;

static PLACE: Table =
    table("A point of a body or of a beam.", &[BODY_OR_BEAM, BEAM_OR_BODY, POINT_OR_STATION, OFFSET]);

static WRAP: Table = table(
    "A sphere or a cylinder that a spring runs over without friction, on the shortest path: straight where that clears it, else along two tangents and the surface between them. Both ends must lie outside.",
    &[
        BODY_OR_BEAM,
        BEAM_OR_BODY,
        POINT_OR_STATION,
        OFFSET,
        ROTATION_KEY,
        key("sphere", Shape::Number(D::LENGTH), Optional, "\"8 mm\"", "Radius of a sphere about the point."),
        key(
            "cylinder",
            Shape::Number(D::LENGTH),
            Optional,
            "\"5 mm\"",
            "Radius of a cylinder without ends, its axis through the point.",
        ),
        key(
            "axis",
            Shape::Vector(D::NUMBER),
            Default("[0, 0, 1]"),
            "[0, 1, 0]",
            "Of a cylinder: its axis, in the axes of what carries it, turned by `rotation`.",
        ),
        key(
            "turn",
            Shape::Choice(&[
                ("positive", "from `from` to `to` right-handedly about the axis"),
                ("negative", "the other way"),
            ]),
            Default("the shorter way"),
            "\"positive\"",
            "Of a cylinder: the side for good, so that the path may go on beyond half a turn. It is straight where the line between the ends is clear on that side.",
        ),
    ],
);

pub(crate) static SPRING: Table = Table {
    doc: "A spring, ligament or elastic band between two points. ℓ is the length of its course, ℓ0 the rest length, ε = (ℓ - ℓ0)/ℓ0 the strain.",
    keys: &[
        key(
            "from",
            Shape::Table(&PLACE),
            Required,
            "{ body = \"ground\", at = [0, 0, \"50 mm\"] }",
            "One end.",
        ),
        key("to", Shape::Table(&PLACE), Required, "{ beam = \"link\", at = 0.5 }", "The other end."),
        key(
            "rest_length",
            Shape::Number(D::LENGTH),
            Default("the initial length"),
            "\"40 mm\"",
            "Length from which the stretch counts.",
        ),
        key(
            "size",
            Shape::Number(D::NUMBER),
            Default("1"),
            "1.1",
            "Size of the animal relative to the one that the numbers are of: a given `rest_length` and elongations count `size` times, areas and forces its square, stiffnesses (N/m) `size` times.",
        ),
        key(
            "damping",
            Shape::Number(D::DAMPING),
            Default("0"),
            "\"2 N*s/m\"",
            "Tension against the rate of its length, while it is not slack.",
        ),
        key(
            "wrap",
            Shape::Table(&WRAP),
            Optional,
            "{ body = \"humerus\", sphere = \"8 mm\" }",
            "What it runs over.",
        ),
    ],
    variants: Some(Variants {
        by: "law",
        by_doc: "Tension against length.",
        default: Some("linear"),
        list: &[
            variant(
                "linear",
                "Tension in proportion to the stretch.",
                &[
                    key("stiffness", Shape::Number(D::STIFFNESS), Required, "\"200 N/m\"", "Stiffness."),
                    key(
                        "tension_only",
                        Shape::Flag,
                        Default("false"),
                        "true",
                        "Carries nothing when it is shorter than its rest length.",
                    ),
                ],
            ),
            variant(
                "exponential",
                "Soft tissue that stiffens: stress k2 (exp(k1 ε) - 1) on the area A0/(1 + ε). Carries nothing below slack.",
                &[
                    key("area", Shape::Number(D::AREA), Required, "\"50 mm^2\"", "A0, the area at rest."),
                    key("exponent", Shape::Number(D::NUMBER), Required, "9.4377", "k1."),
                    key("stress", Shape::Number(D::PRESSURE), Required, "\"0.0025 N/mm^2\"", "k2."),
                    key(
                        "form",
                        Shape::Choice(&[
                            ("continuous", "stress k2 (exp(k1 ε) - 1), nothing at slack"),
                            ("printed", "stress k2 exp(k1 ε), which jumps by A0 k2 at slack"),
                        ]),
                        Default("\"continuous\""),
                        "\"printed\"",
                        "The law near slack.",
                    ),
                ],
            ),
            variant(
                "toe",
                "A ligament with a toe: K ε²/(2 ε_t) up to the strain ε_t, then K (ε - ε_t/2). Carries nothing below slack.",
                &[
                    key(
                        "axial_stiffness",
                        Shape::Number(D::FORCE),
                        Required,
                        "\"2000 N\"",
                        "K, the force per unit of strain of the straight part; K/ℓ0 is its stiffness in N/m.",
                    ),
                    key(
                        "toe_strain",
                        Shape::Number(D::NUMBER),
                        Required,
                        "0.06",
                        "ε_t, the strain at which the straight part begins; twice the ε_l of knee models.",
                    ),
                ],
            ),
            variant(
                "table",
                "Measured: once differentiable through rows, never falling, straight on beyond the last. Below the first it carries nothing if that has no force, else goes straight on.",
                &[key(
                    "rows",
                    Shape::ForceRows,
                    Required,
                    "[[0, 0], [\"2 mm\", \"5 N\"], [\"3 mm\", \"12 N\"]]",
                    "Elongation from the rest length, and tension.",
                )],
            ),
        ],
    }),
};
