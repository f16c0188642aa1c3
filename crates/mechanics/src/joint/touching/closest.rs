//! The contact nearest to a rough pose: the orientation is kept, and what is left of the gap is along the normal.
//!
//! As the host's place goes over its surface, M's origin goes over a surface whose normal is the contact's. What is
//! sought is the foot on it of where the origin should be: the place with the smallest gap.

use super::law::{Host, TouchingLaw};
use crate::joint::ContactError;
use flexura_geometry::dual::Dual;
use flexura_geometry::dual::vector::{
    Rows, Triple, back, constant, difference, dot, moving, norm, scaled, sum, tangents, turned,
};

/// How many of the places are refined.
const REFINED: usize = 10;
const STEPS: usize = 60;

/// The host's place for a child under the rotation R with its origin at p (m) as near as can be.
pub(super) fn closest(
    law: &TouchingLaw,
    rotation: &Rows<f64>,
    origin: &Triple<f64>,
) -> Result<Triple<f64>, ContactError> {
    let host = law.hosting();
    let near = match law.host {
        Host::Parent => *origin,
        Host::Child => scaled(-1.0, &back(rotation, origin)),
    };
    let mut places: Vec<(f64, Triple<f64>)> = Vec::new();
    for place in host.places(&near) {
        let Some(contact) = law.place(rotation, &place) else { continue };
        let gap = difference(origin, &contact.position());
        let along = dot(&gap, &contact.normal);
        let across = dot(&gap, &gap) - along * along;
        places.push((across + 1e-2 * along * along, place));
    }
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best: Option<(f64, Triple<f64>)> = None;
    let mut cut: Option<f64> = None;
    for (_, start) in places.into_iter().take(REFINED) {
        let Some((gap, found)) = refine(law, rotation, origin, start) else { continue };
        let Some(place) = law.place(rotation, &found) else { continue };
        if !law.fits(rotation, &place) {
            cut = cut.or(Some(law.relative(rotation, &place).least));
        } else if best.is_none_or(|(least, _)| gap < least) {
            best = Some((gap, found));
        }
    }
    match (best, cut) {
        (Some((_, found)), _) => Ok(found),
        (None, Some(curvature)) => Err(ContactError::Cuts { curvature }),
        (None, None) => Err(ContactError::NoContact),
    }
}

/// Newton's method on t_i·(origin - p) = 0. Returns the gap and the host's place.
fn refine(
    law: &TouchingLaw,
    rotation: &Rows<f64>,
    origin: &Triple<f64>,
    mut host: Triple<f64>,
) -> Option<(f64, Triple<f64>)> {
    let surface = law.hosting();
    let size = law.child.size().min(law.parent.size());
    let still: Rows<Dual<1>> = rotation.map(|row| constant(&row));
    let wanted: Triple<Dual<1>> = constant(origin);
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let own = tangents(&surface.normal(&host));
        let mut misfit = [0.0; 2];
        let mut slope = [[0.0; 2]; 2];
        let mut gap = 0.0;
        for j in 0..2 {
            let at = moving(&host, &own[j]);
            let place = law.place(&still, &at)?;
            let arm = difference(&wanted, &place.position());
            let across = tangents(&surface.normal(&at)).map(|t| match law.host {
                Host::Parent => t,
                Host::Child => turned(&still, &t),
            });
            for i in 0..2 {
                let part = dot(&arm, &across[i]);
                misfit[i] = part.value;
                slope[i][j] = part.rates[0];
            }
            gap = norm(&arm.map(|x| x.value));
        }
        let size_of = misfit[0].hypot(misfit[1]);
        if size_of <= 1e-16 * size || size_of >= last && size_of <= 1e-12 * (size + gap) {
            return Some((gap, host));
        }
        last = size_of;
        let [[a, b], [c, d]] = slope;
        let det = a * d - b * c;
        let step = [-(d * misfit[0] - b * misfit[1]) / det, -(a * misfit[1] - c * misfit[0]) / det];
        let long = step[0].hypot(step[1]);
        if !long.is_finite() {
            return None;
        }
        // A plane or a cylinder has no end, and nothing changes along it.
        let factor = if surface.is_rounded() { (0.3 * surface.size() / long).min(1.0) } else { 1.0 };
        host = retracted(law, &host, &[factor * step[0], factor * step[1]])?;
    }
    None
}

/// The host's place after a step along its tangents: on the surface straight below, and otherwise on it where it is nearest.
pub(super) fn retracted(law: &TouchingLaw, host: &Triple<f64>, step: &[f64]) -> Option<Triple<f64>> {
    let surface = law.hosting();
    let n = surface.normal(host);
    let [t1, t2] = tangents(&n);
    let aside = sum(host, &sum(&scaled(step[0], &t1), &scaled(step[1], &t2)));
    surface.along(&aside, &n).or_else(|| surface.foot(&aside))
}
