//! Tables of cross sections.

use super::tables::{key, variant};
use super::{Key, Need, Shape, Table, Variants};
use Need::{Along, Default, Optional, Required};
use flexura_expression::Dimension as D;

const MASS_PER_LENGTH: Key = key(
    "mass_per_length",
    Shape::Profile(D::MASS_PER_LENGTH),
    Default("massless"),
    "\"20 g/m\"",
    "Mass per length.",
);

pub(crate) static SECTION: Table = Table {
    doc: "A cross section: e2 runs along the width, e3 along the height. Every dimension may be an expression of the arc length s.",
    keys: &[
        key(
            "plane_strain",
            Shape::Flag,
            Default("false"),
            "true",
            "The strip is too wide to contract sideways: bending stiffness E/(1 - poisson^2).",
        ),
        key(
            "along",
            Shape::Along,
            Optional,
            "[{ at = 0, width = \"20 mm\" }, { at = 1, width = \"10 mm\" }]",
            "Dimensions that vary along the beam, straight lines between the rows.",
        ),
    ],
    variants: Some(Variants {
        by: "shape",
        by_doc: "The shape.",
        default: None,
        list: &[
            variant(
                "rectangle",
                "A solid rectangle.",
                &[
                    key("width", Shape::Notched(D::LENGTH), Along, "\"20.32 mm\"", "Along e2."),
                    key("height", Shape::Notched(D::LENGTH), Along, "\"0.254 mm\"", "Along e3."),
                ],
            ),
            variant(
                "circle",
                "A solid circle.",
                &[key("diameter", Shape::Notched(D::LENGTH), Along, "\"1.397 mm\"", "Diameter.")],
            ),
            variant(
                "tube",
                "A round tube.",
                &[
                    key("outer_diameter", Shape::Profile(D::LENGTH), Along, "\"3 mm\"", "Outer diameter."),
                    key("inner_diameter", Shape::Profile(D::LENGTH), Along, "\"2 mm\"", "Inner diameter."),
                ],
            ),
            variant(
                "ellipse",
                "A solid ellipse.",
                &[
                    key("width", Shape::Profile(D::LENGTH), Along, "\"20 mm\"", "Full axis along e2."),
                    key("height", Shape::Profile(D::LENGTH), Along, "\"10 mm\"", "Full axis along e3."),
                ],
            ),
            variant(
                "stiffness",
                "Stiffnesses given directly: GJ, EI2, EI3, EA for a beam that stretches, GA2 and GA3 for one that shears, or `matrix`. No stress is reported.",
                &[
                    key(
                        "EA",
                        Shape::Stiffness(D::FORCE),
                        Optional,
                        "\"1e6 N\"",
                        "Axial stiffness; beams with `extension = false` need none.",
                    ),
                    key(
                        "GJ",
                        Shape::Stiffness(D::BENDING_STIFFNESS),
                        Along,
                        "\"0.5 N*m^2\"",
                        "Torsional stiffness.",
                    ),
                    key(
                        "EI2",
                        Shape::Stiffness(D::BENDING_STIFFNESS),
                        Along,
                        "\"0.7 N*m^2\"",
                        "Stiffness of bending about e2.",
                    ),
                    key(
                        "EI3",
                        Shape::Stiffness(D::BENDING_STIFFNESS),
                        Along,
                        "\"0.7 N*m^2\"",
                        "Stiffness of bending about e3.",
                    ),
                    key(
                        "GA2",
                        Shape::Stiffness(D::FORCE),
                        Optional,
                        "\"4e5 N\"",
                        "Shear stiffness along e2, shear factor included.",
                    ),
                    key(
                        "GA3",
                        Shape::Stiffness(D::FORCE),
                        Optional,
                        "\"4e5 N\"",
                        "Shear stiffness along e3, shear factor included.",
                    ),
                    key(
                        "matrix",
                        Shape::Matrix6,
                        Optional,
                        "[[1e6, 0, 0, 0, 0, 0], ...]",
                        "The full symmetric stiffness, from (stretch, shear 2, shear 3, twist, bending 2, bending 3) to (F1, F2, F3, M1, M2, M3), instead of the keys above.",
                    ),
                    MASS_PER_LENGTH,
                    key(
                        "rotary_inertia",
                        Shape::Profiles(D::ROTARY_INERTIA),
                        Default("none"),
                        "[\"3e-6 kg*m\", \"2e-6 kg*m\", \"1e-6 kg*m\"]",
                        "Moments of inertia per length about e1, e2 and e3.",
                    ),
                ],
            ),
        ],
    }),
};

const THICKNESS: Key = key(
    "thickness",
    Shape::Number(D::LENGTH),
    Required,
    "\"0.5 mm\"",
    "The least height, in the middle of the notch.",
);
const CENTER: Key = key(
    "at",
    Shape::Station,
    Default("the middle of a beam that is as long as the notch"),
    "\"10 mm\"",
    "Where the middle of the notch is; outside of the notch the height is that of its rim.",
);

pub(super) static NOTCH: Table = Table {
    doc: "The notch of a flexure hinge, on both sides alike: how the height h runs with the distance x from its middle.",
    keys: &[THICKNESS, CENTER],
    variants: Some(Variants {
        by: "notch",
        by_doc: "The form.",
        default: None,
        list: &[
            variant(
                "circular",
                "Half circles: h = t + 2 r (1 - sqrt(1 - (x/r)^2)), with the thickness t; the notch is 2 r long and t + 2 r high at its rim.",
                &[key("radius", Shape::Number(D::LENGTH), Required, "\"2 mm\"", "r.")],
            ),
            variant(
                "elliptic",
                "Half ellipses: h = t + 2 b (1 - sqrt(1 - (x/a)^2)); the notch is 2 a long and t + 2 b high at its rim.",
                &[
                    key(
                        "semi_axis_along",
                        Shape::Number(D::LENGTH),
                        Required,
                        "\"4 mm\"",
                        "a, along the beam.",
                    ),
                    key("semi_axis_across", Shape::Number(D::LENGTH), Required, "\"1 mm\"", "b, across it."),
                ],
            ),
            variant(
                "corner_filleted",
                "A straight thin part between quarter circles at both ends; t + 2 r high at its rim.",
                &[
                    key("radius", Shape::Number(D::LENGTH), Required, "\"1 mm\"", "r, of the fillets."),
                    key(
                        "length",
                        Shape::Number(D::LENGTH),
                        Default("that of the beam"),
                        "\"8 mm\"",
                        "Length of the notch, fillets included.",
                    ),
                ],
            ),
        ],
    }),
};
