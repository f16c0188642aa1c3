//! Stress and strain of a section under its internal force and moment.
//!
//! Axial stress `σ = F1/A + M2 z/I2 - M3 y/I3` and the shear stress of Saint-Venant torsion. The shear
//! stress of the transverse forces is left out: it is of the order of thickness over length, and vanishes
//! at the outer fibres where bending is worst.

use super::compliance::{WideAxis, wide_axis};
use super::properties::{Properties, Solid, poisson};
use super::torsion::{rectangle_long_profile, rectangle_short_profile};
use flexura_model::{Material, Section};
use flexura_spatial::Vector3;
use std::f64::consts::PI;

/// What a section feels at its outer fibre; stresses in Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionStress {
    /// F1/A, signed.
    pub axial: f64,
    /// Largest bending stress, not negative.
    pub bending: f64,
    /// Largest torsion shear stress, not negative.
    pub torsion: f64,
    /// Largest von Mises stress over the outline.
    pub von_mises: f64,
    /// Largest surface strain along the beam over the outline, by magnitude.
    pub strain: f64,
    /// The part of `strain` that bending alone would give: what an inextensible beam feels.
    pub bending_strain: f64,
}

/// The stresses at arc length `s` (m) of a beam of the given length, under the internal force (N) and
/// moment (N·m) in the section's axes. None for stiffness sections, without a material, and for impossible
/// dimensions.
///
/// Von Mises `√(σ² - σσ' + σ'² + 3τ²)` is the largest over the outline: on a rectangle along all sides with
/// the torsion shear that acts there (zero at a corner, largest in the middle of the long sides; where bending
/// and torsion compete the worst point lies between and is interpolated, to about 0.5 %), on a circle or a
/// tube exact, on an ellipse by a search along the boundary. σ' = ν σ_bending across a strip in plane strain,
/// otherwise zero. Torsion shear: Timoshenko and Goodier (1970), ch. 10.
pub fn peak_stress(
    section: &Section,
    material: Option<&Material>,
    s: f64,
    length: f64,
    force: &Vector3<f64>,
    moment: &Vector3<f64>,
) -> Option<SectionStress> {
    let material = material?;
    let solid = Solid::at(&section.shape, s, length).ok()??;
    let nu = poisson(material);
    let state = State::new(&solid, section.plane_strain, material.young, nu, force, moment)?;
    let mut peak = SectionStress {
        axial: state.axial,
        bending: 0.0,
        torsion: 0.0,
        von_mises: 0.0,
        strain: 0.0,
        bending_strain: 0.0,
    };
    match solid {
        Solid::Rectangle { width, height } => rectangle(&state, width, height, &mut peak),
        Solid::Tube { outer, .. } => round(&state, 0.5 * outer, &mut peak),
        Solid::Ellipse { width, height } => ellipse(&state, 0.5 * width, 0.5 * height, &mut peak),
    }
    Some(peak)
}

/// Stress gradients of one section.
struct State {
    properties: Properties,
    axial: f64,
    /// σ = axial + slope_z z - slope_y y.
    slope_z: f64,
    slope_y: f64,
    moment1: f64,
    young: f64,
    nu: f64,
    plane: Option<WideAxis>,
}

impl State {
    fn new(
        solid: &Solid,
        plane_strain: bool,
        young: f64,
        nu: f64,
        force: &Vector3<f64>,
        moment: &Vector3<f64>,
    ) -> Option<Self> {
        let properties = solid.properties(nu);
        let plane = if plane_strain { Some(wide_axis(solid).ok()?) } else { None };
        Some(Self {
            properties,
            axial: force.x / properties.area,
            slope_z: moment.y / properties.i2,
            slope_y: moment.z / properties.i3,
            moment1: moment.x,
            young,
            nu,
            plane,
        })
    }

    /// Takes the point (y, z) with torsion shear `tau` into the peaks.
    fn visit(&self, y: f64, z: f64, tau: f64, peak: &mut SectionStress) {
        let (about2, about3) = (self.slope_z * z, -self.slope_y * y);
        let bending = about2 + about3;
        let stress = self.axial + bending;
        // Plate bending holds the strip's width: a stress across it, and a smaller strain along it.
        let plate = match self.plane {
            None => 0.0,
            Some(WideAxis::E2) => about2,
            Some(WideAxis::E3) => about3,
        };
        let cross = self.nu * plate;
        let bending_strain = (bending - self.nu * cross) / self.young;
        let mises = (stress * stress - stress * cross + cross * cross + 3.0 * tau * tau).sqrt();
        peak.bending = peak.bending.max(bending.abs());
        peak.torsion = peak.torsion.max(tau.abs());
        peak.von_mises = peak.von_mises.max(mises);
        peak.bending_strain = peak.bending_strain.max(bending_strain.abs());
        peak.strain = peak.strain.max((self.axial / self.young + bending_strain).abs());
    }
}

/// All four sides, each at the places where the torsion shear is tabulated, corners and middle included.
fn rectangle(state: &State, width: f64, height: f64, peak: &mut SectionStress) {
    let (a, b) = (width.max(height), width.min(height));
    let rate = state.moment1.abs() * b / state.properties.j;
    let (long, short) = (rectangle_long_profile(a, b), rectangle_short_profile(a, b));
    // The sides z = const are the long ones when the width is the longer dimension.
    let (along_y, along_z) = if width >= height { (&long, &short) } else { (&short, &long) };
    let (y, z) = (0.5 * width, 0.5 * height);
    for sign in [-1.0, 1.0] {
        side(along_y, peak, |t, tau, peak| state.visit(t, sign * z, rate * tau, peak));
        side(along_z, peak, |t, tau, peak| state.visit(sign * y, t, rate * tau, peak));
    }
}

/// Visits one side at ± the profile's places, and puts a parabola through every largest von Mises stress
/// between two places.
fn side(profile: &[(f64, f64)], peak: &mut SectionStress, visit: impl Fn(f64, f64, &mut SectionStress)) {
    let mirrored = profile.iter().rev().map(|(t, tau)| (-t, *tau));
    let mut places: Vec<(f64, f64)> = Vec::with_capacity(2 * profile.len());
    for (t, tau) in mirrored.chain(profile.iter().skip(1).copied()) {
        // The von Mises stress of this place alone.
        let before = std::mem::replace(&mut peak.von_mises, 0.0);
        visit(t, tau, peak);
        places.push((t, peak.von_mises));
        peak.von_mises = peak.von_mises.max(before);
    }
    for three in places.windows(3) {
        let [(t0, v0), (t1, v1), (t2, v2)] = [three[0], three[1], three[2]];
        let gaps = (t1 - t0) / (t2 - t1);
        // Next to a long gap lies the part of a wide strip where the shear is constant: nothing to find.
        if v1 > v0 && v1 > v2 && gaps.max(1.0 / gaps) < 3.1 {
            let (left, right) = ((v1 - v0) / (t1 - t0), (v2 - v1) / (t2 - t1));
            let curve = (right - left) / (t2 - t0);
            let slope = left + curve * (t1 - t0);
            peak.von_mises = peak.von_mises.max(v1 - slope * slope / (4.0 * curve));
        }
    }
}

/// The torsion shear is the same all around; bending is worst across its resultant axis.
fn round(state: &State, radius: f64, peak: &mut SectionStress) {
    let tau = state.moment1 * radius / state.properties.j;
    let slope = state.slope_z.hypot(state.slope_y);
    let (y, z) = if slope > 0.0 {
        (-state.slope_y / slope * radius, state.slope_z / slope * radius)
    } else {
        (0.0, radius)
    };
    state.visit(y, z, tau, peak);
    state.visit(-y, -z, tau, peak);
}

/// On the boundary y = a cos t, z = b sin t: τ = 2 M1/(πab) √(cos²t/a² + sin²t/b²).
fn ellipse(state: &State, a: f64, b: f64, peak: &mut SectionStress) {
    const STEPS: u32 = 64;
    let scale = 2.0 * state.moment1.abs() / (PI * a * b);
    let visit = |t: f64, peak: &mut SectionStress| {
        let (sine, cosine) = t.sin_cos();
        state.visit(a * cosine, b * sine, scale * (cosine / a).hypot(sine / b), peak);
    };
    let mises = |t: f64| {
        let mut one = SectionStress { von_mises: 0.0, ..*peak };
        visit(t, &mut one);
        one.von_mises
    };
    let step = 2.0 * PI / f64::from(STEPS);
    let values: Vec<f64> = (0..STEPS).map(|i| mises(step * f64::from(i))).collect();
    let mut best = Vec::new();
    for i in 0..STEPS as usize {
        let (before, after) =
            (values[(i + STEPS as usize - 1) % STEPS as usize], values[(i + 1) % STEPS as usize]);
        if values[i] >= before && values[i] >= after {
            let t = step * i as f64;
            best.push(crate::smooth::golden_minimum(t - step, t + step, |t| -mises(t)));
        }
    }
    for t in best {
        visit(t, peak);
    }
    // Bending alone is worst where (a cos t, b sin t) is along the gradient; torsion at the minor axis.
    let along = (b * state.slope_z).atan2(-a * state.slope_y);
    for t in [along, along + PI, 0.0, 0.5 * PI, PI, 1.5 * PI] {
        visit(t, peak);
    }
}
