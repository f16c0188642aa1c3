//! The same walk over joints and holds: axes, coordinates, what touches what.

use super::visit::{Item, Part, Step, Visit, direction, function, number, numbers, optional, placed, rows};
use crate::{
    Boundary, BoundaryCurve, Contact, CoordinateLaw, Drive, Frame, Joint, JointKind, JointLaw, Limits,
    RevolutionProfile, Rolling, RollingCoordinate, Slide, Surface, SurfaceMotion, Surfaces,
};

pub(super) fn joints(v: &mut impl Visit, joints: &mut [Joint]) {
    for Joint { name, parent, child, child_pose, law: own } in joints {
        v.within(Step::Named("joint", name), |v| {
            let Frame { mount, pose } = parent;
            v.within(Step::Key("parent"), |v| placed(v, mount, Some(pose)));
            v.within(Step::Key("child"), |v| placed(v, child, child_pose.as_mut()));
            law(v, own, "rotation", Part::Drive);
        });
    }
}

/// Of a joint or a hold; `turning` is the key of what acts on a rotation vector beside displacements, `part` what its drives are.
pub(super) fn law(v: &mut impl Visit, law: &mut JointLaw, turning: &'static str, part: Part) {
    let JointLaw { kind, axis, second_axis, contact, coordinates } = law;
    match kind {
        JointKind::Weld
        | JointKind::Spherical
        | JointKind::Free
        | JointKind::Contact
        | JointKind::SurfaceRolling => {}
        // The second axis of the others is chosen by the first, and turns with it.
        JointKind::Revolute | JointKind::Prismatic | JointKind::Cylindrical => {
            direction(v, "axis", axis);
            direction(v, "second_axis", second_axis);
        }
        JointKind::Universal => {
            direction(v, "axis", axis);
            direction(v, "second_axis", second_axis);
        }
        JointKind::Planar | JointKind::Rolling(_) => {
            direction(v, "axis", axis);
            direction(v, "x_axis", second_axis);
        }
    }
    let names = kind.coordinate_names();
    for (i, coordinate) in coordinates.iter_mut().enumerate() {
        match kind {
            JointKind::Spherical => of_coordinate(v, coordinate, part, Some(i)),
            JointKind::Contact => {
                v.within(Step::Key("rotation"), |v| of_coordinate(v, coordinate, part, Some(i)))
            }
            JointKind::Free if i >= 3 => {
                v.within(Step::Key(turning), |v| of_coordinate(v, coordinate, part, Some(i - 3)));
            }
            JointKind::Weld
            | JointKind::Revolute
            | JointKind::Prismatic
            | JointKind::SurfaceRolling
            | JointKind::Rolling(RollingCoordinate::Turning | RollingCoordinate::Angle) => {
                of_coordinate(v, coordinate, part, None);
            }
            JointKind::Cylindrical
            | JointKind::Universal
            | JointKind::Planar
            | JointKind::Free
            | JointKind::Rolling(RollingCoordinate::Arc) => {
                let name = names.get(i).copied().unwrap_or_default();
                v.within(Step::Key(name), |v| of_coordinate(v, coordinate, part, None));
            }
        }
    }
    match contact.as_deref_mut() {
        None => {}
        Some(Contact::Rolling(rolling)) => of_rolling(v, rolling),
        Some(Contact::Surfaces(surfaces)) => of_surfaces(v, surfaces),
    }
}

/// Of one coordinate; `component` where it is one of a rotation vector.
fn of_coordinate(v: &mut impl Visit, law: &mut CoordinateLaw, part: Part, component: Option<usize>) {
    let CoordinateLaw { drive, stiffness, rest, damping, limits } = law;
    let of = |v: &mut _, key, value: &mut f64| one(v, key, component, value);
    v.part(part);
    match drive {
        Drive::Free { effort } => of(v, "effort", effort),
        Drive::Driven { coordinate } => of(v, "coordinate", coordinate),
    }
    of(v, "rest", rest);
    v.part(Part::Other);
    number(v, "stiffness", stiffness);
    number(v, "damping", damping);
    if let Some(Limits { range, stiffness }) = limits {
        v.within(Step::Key("limits"), |v| {
            numbers(v, "range", range);
            optional(v, "stiffness", stiffness);
        });
    }
}

fn one(v: &mut impl Visit, key: &'static str, component: Option<usize>, value: &mut f64) {
    match component {
        None => number(v, key, value),
        Some(k) => v.within(Step::Key(key), |v| v.at(Step::Index(k), Item::Number(value))),
    }
}

fn of_rolling(v: &mut impl Visit, rolling: &mut Rolling) {
    let Rolling { child, parent, concave: _, start, slide, close: _ } = rolling;
    for (key, Boundary { curve, outside: _ }) in [("child_curve", child), ("parent_curve", parent)] {
        v.within(Step::Key(key), |v| boundary(v, curve));
    }
    if let Some(start) = start {
        numbers(v, "start", start);
    }
    v.within(Step::Key("slide"), |v| match slide {
        Slide::None | Slide::Pure => {}
        Slide::Velocity { velocity, rate } => {
            number(v, "velocity", velocity);
            number(v, "rate", rate);
        }
        Slide::Ratio { ratio } => number(v, "ratio", ratio),
        Slide::Function(slide) => function(v, "slide", slide),
        Slide::Table(list) => rows(v, "rows", list),
        Slide::Measured { roll, slide } => {
            function(v, "roll", roll);
            function(v, "slide", slide);
        }
        Slide::Stepped { step } => number(v, "step", step),
    });
}

fn boundary(v: &mut impl Visit, curve: &mut BoundaryCurve) {
    match curve {
        BoundaryCurve::Ellipse { semi_axes, range } => {
            numbers(v, "semi_axes", semi_axes);
            if let Some(range) = range {
                numbers(v, "range", range);
            }
        }
        BoundaryCurve::Line { point, normal, range } => {
            numbers(v, "point", point);
            numbers(v, "normal", normal);
            if let Some(range) = range {
                numbers(v, "range", range);
            }
        }
        BoundaryCurve::Arcs { point, direction, arcs } => {
            numbers(v, "point", point);
            numbers(v, "direction", direction);
            rows(v, "arcs", arcs);
        }
        BoundaryCurve::Points { points, closed: _ } => rows(v, "points", points),
        BoundaryCurve::Expression { position: [x, y], range, closed: _ } => {
            function(v, "x", x);
            function(v, "y", y);
            numbers(v, "range", range);
        }
    }
}

fn of_surfaces(v: &mut impl Visit, surfaces: &mut Surfaces) {
    let Surfaces { child, parent, concave: _, motion, range, close: _ } = surfaces;
    for (key, of) in [("child_surface", child), ("parent_surface", parent)] {
        v.within(Step::Key(key), |v| surface(v, of));
    }
    match motion {
        SurfaceMotion::Sliding => {}
        SurfaceMotion::Rolling { about } | SurfaceMotion::Osculating { about } => {
            direction(v, "about", about);
        }
    }
    numbers(v, "range", range);
}

fn surface(v: &mut impl Visit, surface: &mut Surface) {
    match surface {
        Surface::Plane => {}
        Surface::Ellipsoid { semi_axes } => numbers(v, "semi_axes", semi_axes.iter_mut()),
        Surface::Cylinder { semi_axes } => numbers(v, "semi_axes", semi_axes),
        Surface::Revolution { profile } => match profile {
            RevolutionProfile::Points(points) => rows(v, "points", points),
            RevolutionProfile::Radius { radius, range } => {
                function(v, "radius", radius);
                numbers(v, "range", range);
            }
        },
        Surface::Heights { semi_axes, points, degree: _ } => {
            numbers(v, "semi_axes", semi_axes.iter_mut());
            rows(v, "points", points.iter_mut().map(|point| point.iter_mut()));
        }
    }
}
