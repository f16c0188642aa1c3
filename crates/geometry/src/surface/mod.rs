//! Surfaces of bodies, as the places where a function is zero: f(x) = 0, with f > 0 outside; x in metres.
//!
//! The outward unit normal is n = ∇f/|∇f|. Along a tangent v it changes by S v = (H v - n (n·H v))/|∇f|, with H = ∇∇f: the
//! shape operator, whose eigenvalues are the principal curvatures, positive where the body is convex (do Carmo,
//! *Differential Geometry of Curves and Surfaces*, 3-2, with n outwards). Everything is evaluated over [`Scalar`], so that
//! exact derivatives can be had with dual numbers.

mod error;
mod heights;
mod parameters;
mod profile;
mod support;

pub use error::SurfaceError;

use crate::dual::Scalar;
use crate::dual::vector::{Triple, difference, dot, norm, scaled, tangents, turned, unit};
use flexura_model::Surface;
use flexura_spatial::Vector3;
use heights::Heights;
use profile::Profile;

/// A surface that has been checked.
#[derive(Clone, Debug)]
pub struct ImplicitSurface {
    kind: Kind,
    rounded: bool,
    fit: Option<Fit>,
}

#[derive(Clone, Debug)]
enum Kind {
    Ellipsoid([f64; 3]),
    Cylinder([f64; 2]),
    Plane,
    Revolution(Profile),
    Heights(Heights),
}

/// How well a surface goes through the points that it was fitted to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Root of the mean square of the points' distances, m.
    pub rms: f64,
    /// The largest distance, m.
    pub largest: f64,
    /// Number of points.
    pub points: usize,
}

/// Curvatures at a place, 1/m: positive where the body is convex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvatures {
    /// The smaller one.
    pub least: f64,
    /// The larger one.
    pub most: f64,
}

/// Eigenvalues of a symmetric 2 × 2 matrix.
pub fn eigenvalues([[a, b], [_, c]]: [[f64; 2]; 2]) -> Curvatures {
    let (middle, radius) = (0.5 * (a + c), (0.5 * (a - c)).hypot(b));
    Curvatures { least: middle - radius, most: middle + radius }
}

fn positive(names: &[&'static str], values: &[f64]) -> Result<(), SurfaceError> {
    for (axis, value) in names.iter().zip(values) {
        if !(value.is_finite() && *value > 0.0) {
            return Err(SurfaceError::Axis { axis, value: *value });
        }
    }
    Ok(())
}

impl ImplicitSurface {
    /// Checks a surface, and fits it if it is made of points.
    ///
    /// # Errors
    /// [`SurfaceError`]: a size, a profile or points that make no surface.
    pub fn new(surface: &Surface) -> Result<Self, SurfaceError> {
        let plain = |kind, rounded| Self { kind, rounded, fit: None };
        Ok(match surface {
            Surface::Ellipsoid { semi_axes } => {
                positive(&["x", "y", "z"], semi_axes.as_slice())?;
                plain(Kind::Ellipsoid((*semi_axes).into()), true)
            }
            Surface::Cylinder { semi_axes } => {
                positive(&["x", "y"], semi_axes)?;
                plain(Kind::Cylinder(*semi_axes), false)
            }
            Surface::Plane => plain(Kind::Plane, false),
            Surface::Revolution { profile } => {
                let profile = Profile::new(profile)?;
                let rounded = profile.is_rounded();
                plain(Kind::Revolution(profile), rounded)
            }
            Surface::Heights { semi_axes, points, degree } => {
                positive(&["x", "y", "z"], semi_axes.as_slice())?;
                let heights = Heights::fitted((*semi_axes).into(), points, *degree)?;
                plain(Kind::Heights(heights), false).measured(points, *degree)?
            }
        })
    }

    /// Distances of the points, and whether the surface is curved outwards where they are.
    fn measured(mut self, points: &[Vector3<f64>], degree: usize) -> Result<Self, SurfaceError> {
        let (mut square, mut largest, mut rounded) = (0.0, 0.0_f64, true);
        for (index, point) in points.iter().enumerate() {
            let point: [f64; 3] = (*point).into();
            let foot = self.foot(&point).ok_or(SurfaceError::NoFoot { index, degree })?;
            let distance = norm(&difference(&point, &foot));
            square += distance * distance;
            largest = largest.max(distance);
            rounded &= self.curvatures(&foot).least > 0.0;
        }
        let count = points.len();
        self.fit = Some(Fit { rms: (square / count as f64).sqrt(), largest, points: count });
        self.rounded = rounded;
        Ok(self)
    }

    /// Is it curved outwards in both directions everywhere, so that every normal belongs to one place? (Of a surface through
    /// points: wherever it was measured.)
    pub fn is_rounded(&self) -> bool {
        self.rounded
    }

    /// How well it fits the points it was made of.
    pub fn fit(&self) -> Option<Fit> {
        self.fit
    }

    /// A length to compare with, m; infinite of a plane.
    pub fn size(&self) -> f64 {
        match &self.kind {
            Kind::Ellipsoid(axes) | Kind::Heights(Heights { axes, .. }) => {
                axes.iter().copied().fold(0.0, f64::max)
            }
            Kind::Cylinder([a, b]) => a.max(*b),
            Kind::Plane => f64::INFINITY,
            Kind::Revolution(profile) => {
                let [from, to] = profile.range();
                profile.widest().max(0.5 * (to - from))
            }
        }
    }

    /// Does the surface reach as far as a place on it? Only profiles end.
    pub fn contains(&self, x: &Triple<f64>) -> bool {
        match &self.kind {
            Kind::Revolution(profile) => {
                let [from, to] = profile.range();
                let hair = 1e-12 * (to - from);
                x[2] >= from - hair && x[2] <= to + hair
            }
            _ => x.iter().all(|x| x.is_finite()),
        }
    }

    /// f(x).
    pub fn value<T: Scalar>(&self, x: &Triple<T>) -> T {
        match &self.kind {
            Kind::Ellipsoid(axes) => sum_of_squares(x, axes) - T::from(1.0),
            Kind::Cylinder(axes) => sum_of_squares(&x[..2], axes) - T::from(1.0),
            Kind::Plane => x[2],
            Kind::Revolution(profile) => {
                let [q, d1, ..] = profile.jet(x[2].value());
                x[0] * x[0] + x[1] * x[1] - x[2].lift(q, d1)
            }
            Kind::Heights(heights) => heights.value(x, 1.0),
        }
    }

    /// ∇f.
    pub fn gradient<T: Scalar>(&self, x: &Triple<T>) -> Triple<T> {
        let two = T::from(2.0);
        match &self.kind {
            Kind::Ellipsoid(a) => std::array::from_fn(|i| T::from(2.0 / (a[i] * a[i])) * x[i]),
            Kind::Cylinder([a, b]) => {
                [T::from(2.0 / (a * a)) * x[0], T::from(2.0 / (b * b)) * x[1], T::from(0.0)]
            }
            Kind::Plane => [T::from(0.0), T::from(0.0), T::from(1.0)],
            Kind::Revolution(profile) => {
                let [_, d1, d2, _] = profile.jet(x[2].value());
                [two * x[0], two * x[1], -x[2].lift(d1, d2)]
            }
            Kind::Heights(heights) => heights.gradient(x, 1.0),
        }
    }

    /// H v = ∇∇f v.
    pub fn hessian<T: Scalar>(&self, x: &Triple<T>, v: &Triple<T>) -> Triple<T> {
        let two = T::from(2.0);
        match &self.kind {
            Kind::Ellipsoid(a) => std::array::from_fn(|i| T::from(2.0 / (a[i] * a[i])) * v[i]),
            Kind::Cylinder([a, b]) => {
                [T::from(2.0 / (a * a)) * v[0], T::from(2.0 / (b * b)) * v[1], T::from(0.0)]
            }
            Kind::Plane => [T::from(0.0); 3],
            Kind::Revolution(profile) => {
                let [_, _, d2, d3] = profile.jet(x[2].value());
                [two * v[0], two * v[1], -(x[2].lift(d2, d3) * v[2])]
            }
            Kind::Heights(heights) => turned(&heights.hessian(x, 1.0), v),
        }
    }

    /// The outward unit normal at a place on the surface.
    pub fn normal<T: Scalar>(&self, x: &Triple<T>) -> Triple<T> {
        unit(&self.gradient(x))
    }

    /// S v: how the normal changes along a tangent v (1/m times the unit of v).
    pub fn normal_rate<T: Scalar>(&self, x: &Triple<T>, v: &Triple<T>) -> Triple<T> {
        let gradient = self.gradient(x);
        let size = norm(&gradient);
        let n = scaled(T::from(1.0) / size, &gradient);
        let bend = self.hessian(x, v);
        scaled(T::from(1.0) / size, &difference(&bend, &scaled(dot(&n, &bend), &n)))
    }

    /// t_i·S t_j for two vectors across the normal.
    pub fn shape(&self, x: &Triple<f64>, [t1, t2]: &[Triple<f64>; 2]) -> [[f64; 2]; 2] {
        let [s1, s2] = [self.normal_rate(x, t1), self.normal_rate(x, t2)];
        let across = 0.5 * (dot(t1, &s2) + dot(t2, &s1));
        [[dot(t1, &s1), across], [across, dot(t2, &s2)]]
    }

    /// Principal curvatures at a place on the surface.
    pub fn curvatures(&self, x: &Triple<f64>) -> Curvatures {
        eigenvalues(self.shape(x, &tangents(&self.normal(x))))
    }
}

/// Σ (x/a)².
fn sum_of_squares<T: Scalar>(x: &[T], axes: &[f64]) -> T {
    x.iter().zip(axes).fold(T::from(0.0), |sum, (x, a)| sum + T::from(1.0 / (a * a)) * *x * *x)
}

#[cfg(test)]
mod tests;
