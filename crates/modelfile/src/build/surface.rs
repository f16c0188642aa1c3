//! Surfaces that touch.

use super::contact::pairs;
use super::curve::points;
use super::joint::{coordinate, rotation_vector};
use crate::context::{Needed, Read, Reported};
use crate::reader::Reader;
use flexura_expression::{Dimension, Kind};
use flexura_model::{
    Contact, CoordinateLaw, Curve, JointKind, JointLaw, RevolutionProfile, Surface, SurfaceMotion, Surfaces,
};
use flexura_spatial::Vector3;
use std::f64::consts::PI;

/// Degree of the polynomial of measured heights unless given.
const DEGREE: usize = 4;

/// The keys of what acts on the angle of a rolling motion.
const OF_ANGLE: [&str; 5] = ["coordinate", "effort", "stiffness", "rest", "limits"];

pub(super) fn touching(reader: &Reader<'_, '_>) -> Read<JointLaw> {
    let surfaces = ["child_surface", "parent_surface"].map(|key| match reader.table(key) {
        Ok(Some(table)) => surface(&table),
        // A missing surface was recorded on opening the joint's table.
        Ok(None) | Err(Reported) => Err(Reported),
    });
    let (concave, close) = (reader.flag("concave"), reader.flag("close"));
    let (motion, coordinates) = motion(reader)?;
    let range = reader.numbers::<2>("range");
    let kind = match motion {
        SurfaceMotion::Sliding => JointKind::Contact,
        SurfaceMotion::Rolling { .. } | SurfaceMotion::Osculating { .. } => JointKind::SurfaceRolling,
    };
    let [child, parent] = surfaces;
    let surfaces = Surfaces {
        child: child?,
        parent: parent?,
        concave: concave?.unwrap_or(false),
        motion,
        range: range?.map_or([-PI, PI], |range| range.map(|quantity| quantity.value)),
        close: close?.unwrap_or(false),
    };
    let contact = Some(Box::new(Contact::Surfaces(surfaces)));
    Ok(JointLaw { contact, coordinates, ..JointLaw::free(kind, Vector3::z()) })
}

/// How the child moves, and what acts on its coordinates.
fn motion(reader: &Reader<'_, '_>) -> Read<(SurfaceMotion, Vec<CoordinateLaw>)> {
    let word = reader.choice("motion")?.unwrap_or("sliding");
    let about = reader.direction("about")?;
    if word == "sliding" {
        if let Some(key) = OF_ANGLE.into_iter().chain(["about", "range"]).find(|key| reader.has(key)) {
            let message = format!("`{key}` is for a motion that rolls, but this one slides freely");
            let hint = "add `motion = \"rolling\"`, or use the table `rotation` for what acts on the turning";
            return Err(reader.wrong_at(key, message, hint));
        }
        let mut laws = match reader.table("rotation")? {
            Some(table) => rotation_vector(&table)?,
            None => vec![CoordinateLaw::default(); 3],
        };
        laws.extend([CoordinateLaw::default(); 2]);
        return Ok((SurfaceMotion::Sliding, laws));
    }
    if reader.has("rotation") {
        let message = "`rotation` is for a motion that slides freely, but this one rolls";
        return Err(reader.wrong_at(
            "rotation",
            message,
            "write what acts on the angle into the joint's own table",
        ));
    }
    let Some(about) = about else {
        return Err(reader.wrong_with_hint("the key `about` is missing", "for example `about = [0, 1, 0]`"));
    };
    let motion = match word {
        "rolling" => SurfaceMotion::Rolling { about },
        _ => SurfaceMotion::Osculating { about },
    };
    Ok((motion, vec![coordinate(reader)?]))
}

fn surface(reader: &Reader<'_, '_>) -> Read<Surface> {
    match reader.variant {
        "ellipsoid" => Ok(Surface::Ellipsoid { semi_axes: reader.vector("semi_axes").needed()? }),
        "sphere" => {
            let radius = reader.number("radius").needed()?;
            let all = [0, 1, 2].map(|i| reader.key_path(&format!("semi_axes[{i}]")));
            reader.context.rules.rename(&reader.key_path("radius"), &all);
            Ok(Surface::Ellipsoid { semi_axes: Vector3::repeat(radius) })
        }
        "cylinder" => {
            let semi_axes = reader.numbers::<2>("semi_axes").needed()?;
            Ok(Surface::Cylinder { semi_axes: semi_axes.map(|quantity| quantity.value) })
        }
        "plane" => Ok(Surface::Plane),
        "revolution" => Ok(Surface::Revolution { profile: profile(reader)? }),
        "heights" => {
            let semi_axes = reader.vector("semi_axes").needed();
            let degree = reader.count("degree");
            let Curve::Points { points } = points(reader)? else { return Err(Reported) };
            Ok(Surface::Heights { semi_axes: semi_axes?, points, degree: degree?.unwrap_or(DEGREE) })
        }
        _ => Err(Reported),
    }
}

fn profile(reader: &Reader<'_, '_>) -> Read<RevolutionProfile> {
    match (reader.has("points"), reader.entry("radius")) {
        (true, None) => {
            if reader.has("range") {
                let message = "`range` is for a radius that is given by an expression";
                return Err(reader.wrong_at("range", message, "the points say themselves where they end"));
            }
            Ok(RevolutionProfile::Points(pairs(reader, "points", [Dimension::LENGTH; 2])?))
        }
        (false, Some((entry, format))) => {
            let path = reader.key_path("radius");
            let kind = Kind::Of(Dimension::LENGTH);
            let radius = reader.function_in(&entry.node, &path, &format.shape.dimension(), "z", kind);
            let Some(range) = reader.numbers::<2>("range")? else {
                let hint = "for example `range = [\"-5 mm\", \"5 mm\"]`";
                return Err(reader.wrong_with_hint("the key `range` is missing", hint));
            };
            Ok(RevolutionProfile::Radius { radius: radius?, range: range.map(|quantity| quantity.value) })
        }
        (false, None) => {
            Err(reader
                .wrong_with_hint("the key `points` (or `radius`) is missing", "give rows of z and radius"))
        }
        (true, Some(_)) => {
            Err(reader.wrong_at("radius", "give `points` or `radius`, not both", "remove one of the two"))
        }
    }
}
