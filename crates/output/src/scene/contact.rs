//! Boundaries of rolling and contact joints as they are drawn.

use super::{BoundariesScene, BoundaryScene};
use crate::OutputError;
use crate::document::{all_finite, finite_vectors};
use flexura_geometry::{Contour, ImplicitSurface};
use flexura_model::{Boundary, Contact, JointLaw, RevolutionProfile, Surface};
use flexura_spatial::Vector3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Chords of a curve.
const CHORDS: usize = 96;
/// Points around the axis of a net, and lists of them.
const AROUND: usize = 32;
const ROWS: usize = 17;

/// Of rolling and contact joints whose boundaries make sense.
pub(crate) fn boundaries(path: &str, law: &JointLaw) -> Result<Option<BoundariesScene>, OutputError> {
    let path = format!("{path}.boundaries");
    let pair = match law.contact.as_deref() {
        Some(Contact::Rolling(rolling)) => {
            let axes = [law.second_axis, law.axis.cross(&law.second_axis)];
            [curve(&path, &rolling.child, axes)?, curve(&path, &rolling.parent, axes)?]
        }
        Some(Contact::Surfaces(surfaces)) => {
            [surface(&path, &surfaces.child)?, surface(&path, &surfaces.parent)?]
        }
        None => return Ok(None),
    };
    let [child, parent] = pair;
    Ok(child.zip(parent).map(|(child, parent)| BoundariesScene { child, parent }))
}

/// A curve in the plane of two unit axes.
fn curve(
    path: &str,
    boundary: &Boundary,
    [x, y]: [Vector3<f64>; 2],
) -> Result<Option<BoundaryScene>, OutputError> {
    let Ok(contour) = Contour::new(boundary) else { return Ok(None) };
    let inside = |[a, b]: [f64; 2]| x * a + y * b;
    if contour.length().is_none() {
        let Some(at) = contour.at(0.0) else { return Ok(None) };
        let field = || path.to_owned();
        return Ok(Some(BoundaryScene::Line {
            point: all_finite(inside(at.point).into(), field)?,
            direction: all_finite(inside(at.tangent()).into(), field)?,
        }));
    }
    let points = contour.polyline(CHORDS, 0.0, 0.0).into_iter().map(|point| inside(point).into());
    Ok(Some(BoundaryScene::Curve { points: finite_vectors(path, "points", points)? }))
}

fn surface(path: &str, surface: &Surface) -> Result<Option<BoundaryScene>, OutputError> {
    let rows: Vec<f64> = match surface {
        Surface::Plane => return Ok(Some(BoundaryScene::Plane {})),
        Surface::Cylinder { semi_axes } => {
            let semi_axes = all_finite(*semi_axes, || path.to_owned())?;
            return Ok(Some(BoundaryScene::Cylinder { semi_axes }));
        }
        // By latitude; the poles themselves have no longitude.
        Surface::Ellipsoid { .. } | Surface::Heights { .. } => {
            let end = FRAC_PI_2 * (1.0 - 1e-6);
            (0..ROWS).map(|i| end * (2.0 * i as f64 / (ROWS - 1) as f64 - 1.0)).collect()
        }
        Surface::Revolution { profile } => {
            let [from, to] = ends(profile);
            // Closer together towards the ends, where a rounded profile closes.
            let level = |i: usize| 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / (ROWS - 1) as f64).cos();
            (0..ROWS).map(|i| from + (to - from) * level(i)).collect()
        }
    };
    let Ok(checked) = ImplicitSurface::new(surface) else { return Ok(None) };
    let mut points = Vec::with_capacity(rows.len() * AROUND);
    let mut told = 0;
    for v in rows {
        let ring = (0..AROUND).map(|i| checked.point([TAU * i as f64 / AROUND as f64, v]));
        // Heights were measured on a part of the surface only; where the fit has no place, nothing is drawn.
        let Some(ring) = ring.collect::<Option<Vec<_>>>() else { continue };
        told += 1;
        points.extend(ring);
    }
    let points = finite_vectors(path, "points", points.into_iter())?;
    Ok((told > 1).then_some(BoundaryScene::Net { rows: told, points }))
}

fn ends(profile: &RevolutionProfile) -> [f64; 2] {
    match profile {
        RevolutionProfile::Radius { range, .. } => *range,
        RevolutionProfile::Points(points) => {
            [points.first(), points.last()].map(|point| point.map_or(0.0, |[z, _]| *z))
        }
    }
}
