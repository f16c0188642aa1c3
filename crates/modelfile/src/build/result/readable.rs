//! What can be read off a result, and its dimension.

use flexura_expression::Dimension;
use flexura_model::{CoordinateKind, JointKind, Quantity};

/// A name behind a beam, a body and so on.
pub(in crate::build) struct Readable {
    pub name: &'static str,
    pub part: Part,
}

/// What a name stands for.
pub(in crate::build) enum Part {
    /// A number, with its component in the quantity.
    Number(Quantity, Dimension, usize),
    /// Three components of the same dimension.
    Vector(Quantity, Dimension, [&'static str; 3]),
    /// Names that follow.
    Group(Vec<Readable>),
    /// A row and a column follow.
    Matrix(Quantity),
}

pub(in crate::build) const MOTIONS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
pub(in crate::build) const LOADS: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

const XYZ: [&str; 3] = ["x", "y", "z"];

fn number(name: &'static str, quantity: Quantity, dimension: Dimension) -> Readable {
    Readable { name, part: Part::Number(quantity, dimension, 0) }
}

fn vector(name: &'static str, quantity: Quantity, dimension: Dimension) -> Readable {
    Readable { name, part: Part::Vector(quantity, dimension, XYZ) }
}

/// The dimension of an element of the compliance or the stiffness.
pub(in crate::build) fn element(quantity: Quantity, row: usize, column: usize) -> Dimension {
    let motion = |i: usize| if i < 3 { Dimension::LENGTH } else { Dimension::ANGLE };
    let load = |i: usize| if i < 3 { Dimension::FORCE } else { Dimension::MOMENT };
    match quantity {
        Quantity::Stiffness => load(row).over(&motion(column)),
        _ => motion(row).over(&load(column)),
    }
}

/// What beams and bodies have in common.
fn of_section() -> Vec<Readable> {
    vec![
        vector("position", Quantity::Position, Dimension::LENGTH),
        vector("rotation", Quantity::Rotation, Dimension::ANGLE),
        vector("displacement", Quantity::Displacement, Dimension::LENGTH),
        vector("turning", Quantity::Turning, Dimension::ANGLE),
        Readable { name: "compliance", part: Part::Matrix(Quantity::Compliance) },
        Readable { name: "stiffness", part: Part::Matrix(Quantity::Stiffness) },
        vector("center_of_compliance", Quantity::CenterOfCompliance, Dimension::LENGTH),
    ]
}

pub(super) fn of_beam() -> Vec<Readable> {
    let mut list = of_section();
    list.extend([
        vector("tangent", Quantity::Tangent, Dimension::NUMBER),
        vector("force", Quantity::Force, Dimension::FORCE),
        vector("moment", Quantity::Moment, Dimension::MOMENT),
        Readable {
            name: "curvature",
            part: Part::Vector(Quantity::Curvature, Dimension::CURVATURE, ["k1", "k2", "k3"]),
        },
        vector("foundation", Quantity::Foundation, Dimension::STIFFNESS),
        number("stretch", Quantity::Stretch, Dimension::NUMBER),
        number("strain", Quantity::Strain, Dimension::NUMBER),
        number("stress", Quantity::Stress, Dimension::PRESSURE),
    ]);
    list
}

/// Of a beam as a whole.
pub(super) fn of_whole_beam() -> Vec<Readable> {
    vec![vector("foundation_force", Quantity::FoundationForce, Dimension::FORCE)]
}

pub(super) fn of_body() -> Vec<Readable> {
    let mut list = of_section();
    let screw = vec![
        vector("axis", Quantity::ScrewAxis, Dimension::NUMBER),
        vector("point", Quantity::ScrewPoint, Dimension::LENGTH),
        number("pitch", Quantity::ScrewPitch, Dimension::PITCH),
        number("angle", Quantity::ScrewAngle, Dimension::ANGLE),
    ];
    let motion = vec![
        vector("axis", Quantity::MotionAxis, Dimension::NUMBER),
        vector("point", Quantity::MotionPoint, Dimension::LENGTH),
        number("pitch", Quantity::MotionPitch, Dimension::PITCH),
    ];
    list.push(Readable { name: "screw", part: Part::Group(screw) });
    list.push(Readable { name: "motion", part: Part::Group(motion) });
    list
}

/// The coordinates of a joint that are single numbers, by their names.
pub(in crate::build) fn coordinates(kind: JointKind) -> Vec<Readable> {
    if kind == JointKind::Spherical {
        return vec![vector("coordinate", Quantity::Coordinate, Dimension::ANGLE)];
    }
    let mut list = Vec::new();
    for (i, (name, kind)) in kind.coordinate_names().iter().zip(kind.coordinate_kinds()).enumerate() {
        let dimension = match kind {
            CoordinateKind::Angle => Dimension::ANGLE,
            CoordinateKind::Length => Dimension::LENGTH,
        };
        list.push(Readable { name, part: Part::Number(Quantity::Coordinate, dimension, i) });
    }
    if let [Readable { part: Part::Number(_, dimension, _), .. }] = list[..] {
        list.insert(0, number("coordinate", Quantity::Coordinate, dimension));
    }
    list
}

pub(super) fn of_joint(kind: JointKind) -> Vec<Readable> {
    let mut list = coordinates(kind);
    let effort = |kind: CoordinateKind| match kind {
        CoordinateKind::Angle => Dimension::MOMENT,
        CoordinateKind::Length => Dimension::FORCE,
    };
    match (kind, kind.coordinate_kinds()) {
        (_, []) => {}
        (JointKind::Spherical, _) => list.push(vector("effort", Quantity::Effort, Dimension::MOMENT)),
        (_, [only]) => list.push(number("effort", Quantity::Effort, effort(*only))),
        (_, kinds) => {
            let each = kind.coordinate_names().iter().zip(kinds).enumerate();
            let efforts = each.map(|(i, (name, kind))| Readable {
                name,
                part: Part::Number(Quantity::Effort, effort(*kind), i),
            });
            list.push(Readable { name: "effort", part: Part::Group(efforts.collect()) });
        }
    }
    list.push(vector("force", Quantity::Force, Dimension::FORCE));
    list.push(vector("moment", Quantity::Moment, Dimension::MOMENT));
    list
}

/// Of a spring or a cable.
pub(super) fn of_line() -> Vec<Readable> {
    vec![
        number("length", Quantity::Length, Dimension::LENGTH),
        number("tension", Quantity::Tension, Dimension::FORCE),
    ]
}

/// Of the tip of concentric tubes.
pub(super) fn of_tubes() -> Vec<Readable> {
    vec![
        vector("position", Quantity::Position, Dimension::LENGTH),
        vector("rotation", Quantity::Rotation, Dimension::ANGLE),
        vector("tangent", Quantity::Tangent, Dimension::NUMBER),
    ]
}

pub(super) fn of_model() -> Vec<Readable> {
    vec![number("energy", Quantity::Energy, Dimension::MOMENT)]
}
