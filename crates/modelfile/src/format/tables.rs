//! Tables of what a mechanism is made of: file, materials, sections, beams, curves.

use super::attachments::{BODY, LOAD, MASS};
use super::foundation::FOUNDATION;
use super::joints::{END, JOINT};
use super::relations::{CABLE, COUPLING, UNKNOWN};
use super::sections::SECTION;
use super::springs::SPRING;
use super::studies::STUDY;
use super::tubes::TUBES;
use super::{Key, Named, Need, Shape, Table, Variant, Variants};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension as D;

pub(super) const fn key(
    name: &'static str,
    shape: Shape,
    need: Need,
    example: &'static str,
    doc: &'static str,
) -> Key {
    Key { name, shape, need, doc, example }
}

pub(super) const fn variant(name: &'static str, doc: &'static str, keys: &'static [Key]) -> Variant {
    Variant { name, doc, keys }
}

pub(super) const fn table(doc: &'static str, keys: &'static [Key]) -> Table {
    Table { doc, keys, variants: None }
}

pub(super) const FIRST_COORDINATE: Key =
    key("x", Shape::Function(D::LENGTH), Required, "\"10 mm*cos(t)\"", "First coordinate.");
pub(super) const SECOND_COORDINATE: Key =
    key("y", Shape::Function(D::LENGTH), Required, "\"5 mm*sin(t)\"", "Second coordinate.");
pub(super) const PARAMETER: Key =
    key("parameter", Shape::Text, Default("\"t\""), "\"u\"", "The parameter's name in the expressions.");
pub(super) const PARAMETER_RANGE: Key = key(
    "range",
    Shape::Range(D::NUMBER),
    Required,
    "[0, \"2*pi\"]",
    "First and last value of the parameter; it bears their unit.",
);

pub(crate) static FILE: Table = table(
    "A compliant mechanism.",
    &[
        key("format", Shape::Version, Required, "1", "The version of the format."),
        key("name", Shape::Text, Default("\"\""), "\"sensor attachment\"", "A title for people."),
        key(
            "include",
            Shape::Texts,
            Default("nothing"),
            "[\"parts/materials.toml\"]",
            "Model files whose tables become tables of this one; paths as seen from the folder of the file that names them. Each \
             begins with `format = 1`, may include others, and is taken once. Nothing may be given twice.",
        ),
        key(
            "gravity",
            Shape::Vector(D::ACCELERATION),
            Default("none"),
            "[0, 0, \"-9.80665 m/s^2\"]",
            "Gravity in global axes.",
        ),
        key(
            "mass_damping",
            Shape::Number(D::FREQUENCY),
            Default("0"),
            "\"0.5 1/s\"",
            "Damping in proportion to inertia: everything that moves is held back by this times its momentum.",
        ),
        key(
            "spin",
            Shape::Table(&SPIN),
            Optional,
            "{ axis = [0, 0, 1], rate = \"100 rad/s\" }",
            "The whole mechanism turns at a steady rate, and is described in axes that turn with it: centrifugal forces load it, and gyroscopic ones act in its modes. Gravity and dead loads turn along.",
        ),
        key(
            "parameter",
            Shape::NamedNumbers,
            Optional,
            "{ push = \"3 N\" }",
            "Named numbers that expressions may use; they may refer to each other in any order, and be overridden by `--set`.",
        ),
        key("material", Shape::NamedTables(&MATERIAL), Optional, "{ steel = { ... } }", "Materials."),
        key("section", Shape::NamedTables(&SECTION), Optional, "{ strip = { ... } }", "Cross sections."),
        key("beam", Shape::NamedTables(&BEAM), Optional, "{ link = { ... } }", "Flexible beams."),
        key(
            "body",
            Shape::NamedTables(&BODY),
            Optional,
            "{ slider = { ... } }",
            "Rigid bodies; `ground` is there without being named.",
        ),
        key(
            "joint",
            Shape::NamedTables(&JOINT),
            Optional,
            "{ way = { ... } }",
            "Joints between bodies or beams.",
        ),
        key(
            "coupling",
            Shape::NamedTables(&COUPLING),
            Optional,
            "{ mesh = { ... } }",
            "Linear relations between joint coordinates.",
        ),
        key(
            "spring",
            Shape::NamedTables(&SPRING),
            Optional,
            "{ ligament = { ... } }",
            "Springs between two points.",
        ),
        key("cable", Shape::NamedTables(&CABLE), Optional, "{ flexor = { ... } }", "Cables (tendons)."),
        key(
            "tubes",
            Shape::NamedTables(&TUBES),
            Optional,
            "{ robot = { ... } }",
            "Concentric pre-curved tubes.",
        ),
        key("mass", Shape::NamedTables(&MASS), Optional, "{ sensor = { ... } }", "Lumped masses on beams."),
        key("load", Shape::NamedTables(&LOAD), Optional, "{ push = { ... } }", "Forces and moments."),
        key(
            "output",
            Shape::NamedOutputs,
            Optional,
            "{ w = \"beam.link.end.position.z\" }",
            "What to read off a result.",
        ),
        key(
            "unknown",
            Shape::Unknowns(&UNKNOWN),
            Optional,
            "{ push = { guess = \"1 N\" } }",
            "An inverse problem: parameters to be found, as many as there are targets.",
        ),
        key(
            "target",
            Shape::NamedTargets,
            Optional,
            "{ \"body.slider.position.x\" = \"140 mm\" }",
            "Wanted values of results; each key is an expression over results as in [output], or over `output.NAME`.",
        ),
        key(
            "study",
            Shape::NamedTables(&STUDY),
            Optional,
            "{ buckling = { ... } }",
            "What is to be done: an equilibrium, a path of equilibria, critical loads.",
        ),
    ],
);

static SPIN: Table = table(
    "A steady turning of the whole mechanism.",
    &[
        key(
            "axis",
            Shape::Vector(D::NUMBER),
            Required,
            "[0, 0, 1]",
            "The direction of the line about which it turns, right-handedly; need not be of unit length.",
        ),
        key("rate", Shape::Number(D::ANGULAR_VELOCITY), Required, "\"100 rad/s\"", "How fast."),
        key(
            "through",
            Shape::Vector(D::LENGTH),
            Default("[0, 0, 0]"),
            "[0, \"20 mm\", 0]",
            "A point of the line.",
        ),
    ],
);

/// What every named table may have; it is gone before the table is read.
pub(crate) const REPEAT: Key = key(
    "repeat",
    Shape::Repeat,
    Optional,
    "{ i = 10, j = [1, 5] }",
    "Makes a table for every combination of the indices; `{i}` in the name and in texts becomes a number.",
);

pub(crate) static MATERIAL: Table = table(
    "A linear elastic material: isotropic with `poisson`; with `shear`, E and G stand for themselves, as along the fibres of a composite.",
    &[
        key(
            "library",
            Shape::Text,
            Optional,
            "\"spring-steel\"",
            "A material that `flexura materials` lists; what stands beside it takes the place of its numbers.",
        ),
        key(
            "young",
            Shape::Number(D::PRESSURE),
            Optional,
            "\"207 GPa\"",
            "Young's modulus; needed without `library`.",
        ),
        key("shear", Shape::Number(D::PRESSURE), Optional, "\"79.3 GPa\"", "Shear modulus."),
        key(
            "poisson",
            Shape::Number(D::NUMBER),
            Optional,
            "0.3",
            "Poisson's ratio, above -1 and at most 0.5.",
        ),
        key("density", Shape::Number(D::DENSITY), Default("massless"), "\"7630 kg/m^3\"", "Density."),
        key(
            "yield_strength",
            Shape::Number(D::PRESSURE),
            Optional,
            "\"1.1 GPa\"",
            "Yield strength; enables the safety factor.",
        ),
    ],
);

pub(crate) static BEAM: Table = table(
    "A flexible beam. Give `length` (straight along the x axis of its start frame) or `curve`.",
    &[
        key(
            "material",
            Shape::Name(Named::Material),
            Optional,
            "\"steel\"",
            "Its material; only a section given as a stiffness needs none.",
        ),
        key("section", Shape::Name(Named::Section), Required, "\"strip\"", "Its cross section."),
        key("length", Shape::Number(D::LENGTH), Optional, "\"152.4 mm\"", "Length of a straight beam."),
        key(
            "curve",
            Shape::Table(&CURVE),
            Optional,
            "{ kind = \"arc\", radius = \"10 mm\", angle = \"90 deg\" }",
            "The stress-free shape. It is moved rigidly so that its start frame, e1 its tangent, is the beam's start frame.",
        ),
        key(
            "frame",
            Shape::Table(&FRAME),
            Default("{ kind = \"natural\" }"),
            "{ kind = \"direction\", along = [0, 0, 1] }",
            "How the section's axes run along the curve.",
        ),
        key(
            "start",
            Shape::Table(&END),
            Optional,
            "{ body = \"ground\", hold = \"clamp\" }",
            "Where s = 0 is held; without it the start is free.",
        ),
        key(
            "end",
            Shape::Table(&END),
            Optional,
            "{ body = \"slider\", hold = \"clamp\" }",
            "Where s = L is held; without it the end is free.",
        ),
        key("shear", Shape::Flag, Default("false"), "true", "Sections may shear against the axis."),
        key("extension", Shape::Flag, Default("true"), "false", "The axis may stretch."),
        key(
            "damping",
            Shape::Number(D::TIME),
            Default("0"),
            "\"0.1 ms\"",
            "Time τ of a damping within the material: forces and moments are those of the strains plus τ times their rates. A mode of circular frequency ω has the damping ratio τ ω/2.",
        ),
        key(
            "added_mass",
            Shape::Number(D::MASS_PER_LENGTH),
            Default("0"),
            "\"0.1 kg/m\"",
            "Mass per undeformed length that moves with the beam besides its section's and does not weigh, as of a fluid around it.",
        ),
        key(
            "distributed",
            Shape::Tables(&DISTRIBUTED),
            Optional,
            "{ force = [0, 0, \"-2 N/m\"] }",
            "Loads per undeformed length.",
        ),
        key(
            "foundation",
            Shape::Tables(&FOUNDATION),
            Optional,
            "{ stiffness = \"1 kN/m^2\", direction = [0, 1, 0] }",
            "Elastic foundations: forces per undeformed length that grow with the displacement.",
        ),
    ],
);

pub(crate) static CURVE: Table = Table {
    doc: "A stress-free shape.",
    keys: &[],
    variants: Some(Variants {
        by: "kind",
        by_doc: "The kind of curve.",
        default: None,
        list: &[
            variant(
                "arc",
                "A circular arc that bends towards +e2.",
                &[
                    key("radius", Shape::Number(D::LENGTH), Required, "\"50 mm\"", "Radius."),
                    key("angle", Shape::Number(D::ANGLE), Required, "\"90 deg\"", "Angle swept."),
                ],
            ),
            variant(
                "helix",
                "A helix, e2 pointing to its axis; positive pitch is right-handed.",
                &[
                    key("radius", Shape::Number(D::LENGTH), Required, "\"7.239 mm\"", "Radius."),
                    key("pitch", Shape::Number(D::LENGTH), Required, "\"5.715 mm\"", "Rise per turn."),
                    key(
                        "turns",
                        Shape::Number(D::ANGLE),
                        Required,
                        "10",
                        "Number of turns: a plain number, or an angle with its unit.",
                    ),
                ],
            ),
            variant(
                "parametric",
                "A curve given by its coordinates as functions of a parameter.",
                &[
                    FIRST_COORDINATE,
                    SECOND_COORDINATE,
                    key("z", Shape::Function(D::LENGTH), Default("0"), "\"1 mm*t\"", "Third coordinate."),
                    PARAMETER,
                    PARAMETER_RANGE,
                ],
            ),
            variant(
                "points",
                "A smooth curve (cubic spline) through points.",
                &[
                    key(
                        "points",
                        Shape::Points,
                        Optional,
                        "[[0, 0, 0], [\"10 mm\", 0, 0], [\"20 mm\", \"5 mm\", 0]]",
                        "The points. Give them here or in a file.",
                    ),
                    key(
                        "file",
                        Shape::Text,
                        Optional,
                        "\"points.csv\"",
                        "A CSV file with the columns x, y, z, beside the model file.",
                    ),
                    key(
                        "unit",
                        Shape::Text,
                        Default("\"m\""),
                        "\"mm\"",
                        "The unit of the numbers in the file.",
                    ),
                ],
            ),
            variant(
                "curvature",
                "Given by its curvatures.",
                &[
                    key(
                        "k1",
                        Shape::Profile(D::CURVATURE),
                        Default("0"),
                        "\"2 1/m\"",
                        "Twist rate about e1.",
                    ),
                    key("k2", Shape::Profile(D::CURVATURE), Default("0"), "\"2 1/m\"", "Curvature about e2."),
                    key(
                        "k3",
                        Shape::Profile(D::CURVATURE),
                        Default("0"),
                        "\"2 + 30*s\"",
                        "Curvature about e3.",
                    ),
                    key("length", Shape::Number(D::LENGTH), Required, "\"100 mm\"", "Length."),
                ],
            ),
        ],
    }),
};

pub(crate) static FRAME: Table = Table {
    doc: "How the section's axes e2, e3 run along the curve. A curve of kind `curvature` says it itself.",
    keys: &[],
    variants: Some(Variants {
        by: "kind",
        by_doc: "The rule.",
        default: None,
        list: &[
            variant(
                "natural",
                "The curve's own choice: no turn for a straight beam, Frenet for arc and helix, rotation-minimising otherwise.",
                &[],
            ),
            variant(
                "frenet",
                "At a constant angle to the curve's normal; fails where the curve is straight.",
                &[key(
                    "offset",
                    Shape::Number(D::ANGLE),
                    Default("0"),
                    "\"30 deg\"",
                    "The angle from e2 to the normal.",
                )],
            ),
            variant(
                "rotation_minimising",
                "Turns about the axis only by `twist`.",
                &[
                    key(
                        "start",
                        Shape::Vector(D::NUMBER),
                        Default("the curve's y axis"),
                        "[0, 1, 0]",
                        "Direction of e2 at the start, in the curve's own coordinates.",
                    ),
                    key(
                        "twist",
                        Shape::Profile(D::ANGLE),
                        Optional,
                        "\"90 deg*s/100 mm\"",
                        "Turning about e1, an expression of s that begins with zero.",
                    ),
                ],
            ),
            variant(
                "direction",
                "e2 stays as near as possible to a direction.",
                &[key(
                    "along",
                    Shape::Vector(D::NUMBER),
                    Required,
                    "[0, 0, 1]",
                    "The direction, in the curve's own coordinates.",
                )],
            ),
        ],
    }),
};

pub(crate) static DISTRIBUTED: Table = table(
    "A load per undeformed length; components are numbers or expressions of s.",
    &[
        key(
            "force",
            Shape::Profiles(D::STIFFNESS),
            Default("none"),
            "[0, 0, \"-2 N/m\"]",
            "Force per length.",
        ),
        key(
            "moment",
            Shape::Profiles(D::FORCE),
            Default("none"),
            "[\"0.1 N*m/m\", 0, 0]",
            "Moment per length.",
        ),
        key(
            "frame",
            Shape::Choice(&[
                ("global", "dead: constant in global axes"),
                ("section", "follower: constant in the section's axes"),
            ]),
            Default("\"global\""),
            "\"section\"",
            "The axes in which it is given.",
        ),
        key("from", Shape::Station, Default("0"), "0.2", "Where along the beam it begins."),
        key("to", Shape::Station, Default("1"), "\"80 mm\"", "Where it ends."),
    ],
);
