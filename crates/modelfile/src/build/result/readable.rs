//! What can be read off a result, and its dimension.

use flexura_expression::Dimension;
use flexura_model::{
    Boundary, BoundaryCurve, Contact, CoordinateKind, JointKind, JointLaw, Probe, ProbeTarget, Quantity,
    RollingCoordinate, SpringLaw,
};

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
    vec![
        vector("foundation_force", Quantity::FoundationForce, Dimension::FORCE),
        number("max_stress", Quantity::MaxStress, Dimension::PRESSURE),
        number("max_strain", Quantity::MaxStrain, Dimension::NUMBER),
        number("min_safety", Quantity::MinSafety, Dimension::NUMBER),
        number("mass", Quantity::Mass, Dimension::MASS),
    ]
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
    list.extend([
        vector("velocity", Quantity::Velocity, Dimension::VELOCITY),
        vector("angular_velocity", Quantity::AngularVelocity, Dimension::ANGULAR_VELOCITY),
        vector("acceleration", Quantity::Acceleration, Dimension::ACCELERATION),
        vector("angular_acceleration", Quantity::AngularAcceleration, Dimension::ANGULAR_ACCELERATION),
    ]);
    list
}

/// The coordinates of a joint that are single numbers, by their names.
pub(in crate::build) fn coordinates(kind: JointKind) -> Vec<Readable> {
    if kind == JointKind::Spherical {
        return vec![vector("coordinate", Quantity::Coordinate, Dimension::ANGLE)];
    }
    let mut list = Vec::new();
    let count = kind.named_coordinates();
    let each = kind.coordinate_names().iter().zip(kind.coordinate_kinds()).take(count);
    for (i, (name, kind)) in each.enumerate() {
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

/// What is known of a contact.
fn of_contact(law: &JointLaw, contact: &Contact) -> Vec<Readable> {
    let part = |name, quantity, dimension, component| Readable {
        name,
        part: Part::Number(quantity, dimension, component),
    };
    let (parameters, rate) = match contact {
        Contact::Rolling(rolling) => {
            let own = |boundary: &Boundary| match boundary.curve {
                BoundaryCurve::Ellipse { .. } => Dimension::ANGLE,
                BoundaryCurve::Line { .. } | BoundaryCurve::Arcs { .. } | BoundaryCurve::Points { .. } => {
                    Dimension::LENGTH
                }
                BoundaryCurve::Expression { .. } => Dimension::NUMBER,
            };
            let by_arc = law.kind == JointKind::Rolling(RollingCoordinate::Arc);
            let rate = if by_arc { Dimension::NUMBER } else { Dimension::PITCH };
            (Some([own(&rolling.child), own(&rolling.parent)]), rate)
        }
        Contact::Surfaces(_) => (None, Dimension::PITCH),
    };
    let side = |which: usize, on| {
        let mut list = vec![
            vector("point", on, Dimension::LENGTH),
            part("radius", Quantity::ContactRadius, Dimension::LENGTH, which),
        ];
        if let Some(own) = parameters {
            list.push(part("parameter", Quantity::ContactParameter, own[which], 2 * which));
        }
        Part::Group(list)
    };
    vec![
        vector("point", Quantity::ContactPoint, Dimension::LENGTH),
        vector("normal", Quantity::ContactNormal, Dimension::NUMBER),
        number("force", Quantity::ContactForce, Dimension::FORCE),
        vector("friction", Quantity::ContactFriction, Dimension::FORCE),
        part("roll", Quantity::ContactTravel, Dimension::LENGTH, 0),
        part("slide", Quantity::ContactTravel, Dimension::LENGTH, 1),
        part("roll_rate", Quantity::ContactRate, rate, 0),
        part("slide_rate", Quantity::ContactRate, rate, 1),
        Readable { name: "child", part: side(0, Quantity::ContactOnChild) },
        Readable { name: "parent", part: side(1, Quantity::ContactOnParent) },
    ]
}

pub(super) fn of_joint(law: &JointLaw) -> Vec<Readable> {
    let kind = law.kind;
    let mut list = coordinates(kind);
    list.extend(of_coordinates(kind, "effort", Quantity::Effort, [Dimension::MOMENT, Dimension::FORCE]));
    list.push(vector("force", Quantity::Force, Dimension::FORCE));
    list.push(vector("moment", Quantity::Moment, Dimension::MOMENT));
    let velocity = [Dimension::ANGULAR_VELOCITY, Dimension::VELOCITY];
    list.extend(of_coordinates(kind, "velocity", Quantity::Velocity, velocity));
    let acceleration = [Dimension::ANGULAR_ACCELERATION, Dimension::ACCELERATION];
    list.extend(of_coordinates(kind, "acceleration", Quantity::Acceleration, acceleration));
    if let Some(contact) = &law.contact {
        list.push(Readable { name: "contact", part: Part::Group(of_contact(law, contact)) });
    }
    list
}

/// Of a spring; only the exponential law knows its area.
pub(super) fn of_spring(law: &SpringLaw) -> Vec<Readable> {
    let mut list = of_line();
    list.push(number("strain", Quantity::Strain, Dimension::NUMBER));
    if let SpringLaw::Exponential { .. } = law {
        list.push(number("stress", Quantity::Stress, Dimension::PRESSURE));
    }
    list
}

/// A quantity that each coordinate has one of, with its dimensions for an angle and for a length.
fn of_coordinates(
    kind: JointKind,
    name: &'static str,
    quantity: Quantity,
    [angle, length]: [Dimension; 2],
) -> Option<Readable> {
    let dimension = |kind: CoordinateKind| match kind {
        CoordinateKind::Angle => angle,
        CoordinateKind::Length => length,
    };
    match (kind, kind.coordinate_kinds()) {
        (_, []) => None,
        (JointKind::Spherical, _) => Some(vector(name, quantity, angle)),
        (_, [only]) => Some(number(name, quantity, dimension(*only))),
        (_, kinds) => {
            let each = kind.coordinate_names().iter().zip(kinds).take(kind.named_coordinates()).enumerate();
            let parts = each.map(|(i, (name, kind))| Readable {
                name,
                part: Part::Number(quantity, dimension(*kind), i),
            });
            Some(Readable { name, part: Part::Group(parts.collect()) })
        }
    }
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
    vec![
        number("energy", Quantity::Energy, Dimension::MOMENT),
        number("mass", Quantity::Mass, Dimension::MASS),
    ]
}

/// The name of what a probe reads behind the thing that it reads it off, such as `position.x`; of the whole vector where one is
/// wanted.
pub(crate) fn name_of(probe: &Probe, law: Option<&JointLaw>, is_vector: bool) -> Option<String> {
    let list = match (probe.target, law) {
        (ProbeTarget::Beam(..), _) if probe.quantity.is_of_whole_beam() => of_whole_beam(),
        (ProbeTarget::Beam(..), _) => of_beam(),
        (ProbeTarget::Body(_), _) => of_body(),
        (ProbeTarget::Joint(_), law) => of_joint(law?),
        (ProbeTarget::Spring(_), _) => {
            let mut list = of_line();
            list.push(number("strain", Quantity::Strain, Dimension::NUMBER));
            list.push(number("stress", Quantity::Stress, Dimension::PRESSURE));
            list
        }
        (ProbeTarget::Cable(_), _) => of_line(),
        (ProbeTarget::Tubes(_), _) => of_tubes(),
        (ProbeTarget::Model, _) => of_model(),
    };
    find(&list, probe, is_vector)
}

fn find(list: &[Readable], probe: &Probe, is_vector: bool) -> Option<String> {
    list.iter().find_map(|Readable { name, part }| match part {
        Part::Number(quantity, _, component) => {
            ((*quantity, *component) == (probe.quantity, probe.component)).then(|| (*name).to_string())
        }
        Part::Vector(quantity, ..) if *quantity == probe.quantity && is_vector => Some((*name).to_string()),
        Part::Vector(quantity, _, components) if *quantity == probe.quantity => {
            components.get(probe.component).map(|component| format!("{name}.{component}"))
        }
        Part::Vector(..) => None,
        Part::Group(inner) => find(inner, probe, is_vector).map(|inner| format!("{name}.{inner}")),
        Part::Matrix(quantity) if *quantity == probe.quantity => {
            let (rows, columns) = match quantity {
                Quantity::Stiffness => (LOADS, MOTIONS),
                _ => (MOTIONS, LOADS),
            };
            Some(format!("{name}.{}.{}", rows.get(probe.component / 6)?, columns.get(probe.component % 6)?))
        }
        Part::Matrix(_) => None,
    })
}
