//! Two numbers for a place on a surface, and places all over it.
//!
//! | surface | first | second |
//! |---|---|---|
//! | ellipsoid, heights | longitude of (x/a, y/b, z/c), rad | its latitude, rad |
//! | cylinder | the same longitude, rad | z, m |
//! | revolution | longitude, rad | z, m |
//! | plane | x, m | y, m |

use super::{ImplicitSurface, Kind};
use crate::dual::Scalar;
use crate::dual::vector::{Triple, unit};
use std::f64::consts::{PI, TAU};

/// Places spread over a closed surface, and around an axis.
const PLACES: usize = 240;
const AROUND: usize = 32;
const LEVELS: usize = 12;

impl ImplicitSurface {
    /// Semi-axes that x, y and z are divided by before their angles are taken.
    fn axes(&self) -> [f64; 3] {
        match &self.kind {
            Kind::Ellipsoid(axes) => *axes,
            Kind::Heights(heights) => heights.axes,
            Kind::Cylinder([a, b]) => [*a, *b, 1.0],
            Kind::Plane | Kind::Revolution(_) => [1.0; 3],
        }
    }

    fn has_latitude(&self) -> bool {
        matches!(self.kind, Kind::Ellipsoid(_) | Kind::Heights(_))
    }

    /// The parameters of a place on the surface.
    pub fn parameters(&self, x: &Triple<f64>) -> [f64; 2] {
        if matches!(self.kind, Kind::Plane) {
            return [x[0], x[1]];
        }
        let a = self.axes();
        let z: [f64; 3] = std::array::from_fn(|i| x[i] / a[i]);
        let second = if self.has_latitude() { z[2].atan2(z[0].hypot(z[1])) } else { x[2] };
        [z[1].atan2(z[0]), second]
    }

    /// How the parameters change when the place moves by v. With ρ² = x² + y² (all divided by the semi-axes): longitude
    /// (x dy - y dx)/ρ², latitude (ρ dz - z dρ)/(ρ² + z²) with dρ = (x dx + y dy)/ρ. Not finite at a pole.
    pub fn parameters_rate<T: Scalar>(&self, x: &Triple<T>, v: &Triple<T>) -> [T; 2] {
        if matches!(self.kind, Kind::Plane) {
            return [v[0], v[1]];
        }
        let a = self.axes();
        let [x, y, z]: Triple<T> = std::array::from_fn(|i| x[i] * T::from(1.0 / a[i]));
        let [dx, dy, dz]: Triple<T> = std::array::from_fn(|i| v[i] * T::from(1.0 / a[i]));
        let square = x * x + y * y;
        let longitude = (x * dy - y * dx) / square;
        if !self.has_latitude() {
            return [longitude, dz];
        }
        let radius = square.sqrt();
        let latitude = (radius * dz - z * (x * dx + y * dy) / radius) / (square + z * z);
        [longitude, latitude]
    }

    /// The place with given parameters; None where there is none.
    pub fn point(&self, [u, v]: [f64; 2]) -> Option<Triple<f64>> {
        let (sin, cos) = u.sin_cos();
        let a = self.axes();
        match &self.kind {
            Kind::Ellipsoid(_) | Kind::Heights(_) => {
                let on: Triple<f64> = [a[0] * v.cos() * cos, a[1] * v.cos() * sin, a[2] * v.sin()];
                if matches!(self.kind, Kind::Ellipsoid(_)) { Some(on) } else { self.along(&on, &unit(&on)) }
            }
            Kind::Cylinder(_) => Some([a[0] * cos, a[1] * sin, v]),
            Kind::Plane => Some([u, v, 0.0]),
            Kind::Revolution(profile) => {
                let radius = profile.jet(v)[0].max(0.0).sqrt();
                let place = [radius * cos, radius * sin, v];
                self.contains(&place).then_some(place)
            }
        }
    }

    /// Places all over the surface; near a point where the surface has no end.
    pub fn places(&self, near: &Triple<f64>) -> Vec<Triple<f64>> {
        let turn = |i: usize| -PI + TAU * (i as f64 + 0.5) / AROUND as f64;
        let parameters: Vec<[f64; 2]> = match &self.kind {
            Kind::Plane => vec![[near[0], near[1]]],
            Kind::Cylinder(_) => (0..AROUND).map(|i| [turn(i), near[2]]).collect(),
            Kind::Revolution(profile) => {
                let [from, to] = profile.range();
                let level = |k: usize| {
                    0.5 * (from + to) - 0.5 * (to - from) * (PI * (k as f64 + 0.5) / LEVELS as f64).cos()
                };
                (0..LEVELS).flat_map(|k| (0..AROUND).map(move |i| [turn(i), level(k)])).collect()
            }
            // Fibonacci's lattice: equal areas of the sphere.
            Kind::Ellipsoid(_) | Kind::Heights(_) => {
                let golden = PI * (3.0 - 5.0_f64.sqrt());
                let height = |i: usize| 1.0 - (2 * i + 1) as f64 / PLACES as f64;
                (0..PLACES).map(|i| [golden * i as f64, height(i).asin()]).collect()
            }
        };
        parameters.into_iter().filter_map(|at| self.point(at)).collect()
    }
}
