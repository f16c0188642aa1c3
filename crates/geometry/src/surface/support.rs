//! Places on a surface: with a given normal, beside a given point, and below one.

use super::{ImplicitSurface, Kind};
use crate::dual::Scalar;
use crate::dual::vector::{Triple, constant, difference, dot, norm, scaled, sum, tangents, unit, values};
use nalgebra::Matrix4;

/// Most steps of Newton's method.
const STEPS: usize = 60;
/// Shares of the heights through which a support point is followed from the ellipsoid, if it must be.
const WAYPOINTS: usize = 16;

impl ImplicitSurface {
    /// The place x whose outward normal is along m: λ ∇f(x) = m, f(x) = 0, λ > 0. Derivatives of m carry over exactly. None
    /// where there is none, or where the surface is not curved in both directions.
    pub fn support<T: Scalar>(&self, m: &Triple<T>) -> Option<Triple<T>> {
        if let Kind::Ellipsoid(axes) = &self.kind {
            // x = D² m/|D m| with D = diag(axes).
            let stretched: Triple<T> = std::array::from_fn(|i| T::from(axes[i]) * m[i]);
            let over = T::from(1.0) / norm(&stretched);
            return Some(std::array::from_fn(|i| over * T::from(axes[i]) * stretched[i]));
        }
        let start = self.support_start(&values(m))?;
        let lambda = norm(&values(m)) / norm(&self.gradient(&start));
        let inverse = self.bordered(&start, lambda, 1.0).try_inverse()?;
        // At the solution one step with the tangent of the values makes the derivatives exact.
        let at: Triple<T> = constant(&start);
        let misfit = difference(m, &scaled(T::from(lambda), &self.gradient(&at)));
        let [x, y, z, _] = times(&inverse, &misfit, -self.value(&at));
        let found = sum(&at, &[x, y, z]);
        self.contains(&values(&found)).then_some(found)
    }

    /// The rate of the support point x of m when m changes by v.
    pub fn support_rate<T: Scalar>(&self, x: &Triple<T>, m: &Triple<T>, v: &Triple<T>) -> Option<Triple<T>> {
        if let Kind::Ellipsoid(axes) = &self.kind {
            // (D² v - x (x·v))/h, with h = |D m| and x = D² m/h.
            let stretched: Triple<T> = std::array::from_fn(|i| T::from(axes[i]) * m[i]);
            let over = T::from(1.0) / norm(&stretched);
            let share = dot(x, v);
            return Some(std::array::from_fn(|i| {
                over * (T::from(axes[i] * axes[i]) * v[i]) - over * share * x[i]
            }));
        }
        // [λH ∇f; ∇fᵀ 0] [dx; dλ] = [v; 0], solved for the values and corrected for their derivatives.
        let gradient = self.gradient(x);
        let lambda = norm(m) / norm(&gradient);
        let inverse = self.bordered(&values(x), lambda.value(), 1.0).try_inverse()?;
        let first = times(&inverse, &values(v), 0.0);
        let [y0, y1, y2, slope] = first.map(T::from);
        let y = [y0, y1, y2];
        let bent = scaled(lambda, &self.hessian(x, &y));
        let misfit = difference(&difference(v, &bent), &scaled(slope, &gradient));
        let [x, y, z, _] = times(&inverse, &misfit, -dot(&gradient, &y));
        Some(sum(&[y0, y1, y2], &[x, y, z]))
    }

    /// [λH ∇f; ∇fᵀ 0]; `share` as of heights.
    fn bordered(&self, x: &Triple<f64>, lambda: f64, share: f64) -> Matrix4<f64> {
        let mut matrix = Matrix4::zeros();
        let gradient = self.gradient_of(x, share);
        let hessian = match &self.kind {
            Kind::Heights(heights) => heights.hessian(x, share),
            // Symmetric: rows are columns.
            _ => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| self.hessian(x, &axis)),
        };
        for i in 0..3 {
            for j in 0..3 {
                matrix[(i, j)] = lambda * hessian[i][j];
            }
            matrix[(3, i)] = gradient[i];
            matrix[(i, 3)] = gradient[i];
        }
        matrix
    }

    fn gradient_of(&self, x: &Triple<f64>, share: f64) -> Triple<f64> {
        match &self.kind {
            Kind::Heights(heights) => heights.gradient(x, share),
            _ => self.gradient(x),
        }
    }

    fn value_of(&self, x: &Triple<f64>, share: f64) -> f64 {
        match &self.kind {
            Kind::Heights(heights) => heights.value(x, share),
            _ => self.value(x),
        }
    }

    /// The support point of a direction, to round-off.
    fn support_start(&self, m: &Triple<f64>) -> Option<Triple<f64>> {
        if !m.iter().all(|x| x.is_finite()) || !self.is_rounded() {
            return None;
        }
        match &self.kind {
            Kind::Revolution(profile) => {
                let across = m[0].hypot(m[1]);
                let z = profile.where_normal(m[2].atan2(across))?;
                let radius = profile.jet(z)[0].max(0.0).sqrt();
                let along = if across > 0.0 { [m[0] / across, m[1] / across] } else { [0.0; 2] };
                self.support_newton(m, [radius * along[0], radius * along[1], z], 1.0)
            }
            Kind::Heights(heights) => {
                let a = &heights.axes;
                let reach = norm(&[a[0] * m[0], a[1] * m[1], a[2] * m[2]]);
                let start: Triple<f64> = std::array::from_fn(|i| a[i] * a[i] * m[i] / reach);
                self.support_newton(m, start, 1.0).or_else(|| {
                    (1..=WAYPOINTS)
                        .try_fold(start, |x, i| self.support_newton(m, x, i as f64 / WAYPOINTS as f64))
                })
            }
            Kind::Ellipsoid(_) => self.support(m),
            Kind::Cylinder(_) | Kind::Plane => None,
        }
    }

    /// Newton's method on λ∇f = m, f = 0. What it finds must be a place where the normal is along m and the surface is convex.
    fn support_newton(&self, m: &Triple<f64>, start: Triple<f64>, share: f64) -> Option<Triple<f64>> {
        let size = self.size();
        let mut x = start;
        let mut lambda = norm(m) / norm(&self.gradient_of(&x, share));
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let gradient = self.gradient_of(&x, share);
            let misfit = difference(m, &scaled(lambda, &gradient));
            let inverse = self.bordered(&x, lambda, share).try_inverse()?;
            let [dx, dy, dz, slope] = times(&inverse, &misfit, -self.value_of(&x, share));
            let longest = norm(&[dx, dy, dz]);
            // No further than a part of the body at once.
            let factor = (0.3 * size / longest).min(1.0);
            x = sum(&x, &scaled(factor, &[dx, dy, dz]));
            lambda += factor * slope;
            if !longest.is_finite() {
                return None;
            }
            if longest <= 1e-15 * size || longest >= last && longest <= 1e-11 * size {
                let turn = difference(&unit(m), &unit(&self.gradient_of(&x, share)));
                return (norm(&turn) < 1e-9).then_some(x);
            }
            last = longest;
        }
        None
    }

    /// The place on the surface at x + s n with the smallest |s|, by Newton's method from s = 0. None where the line misses the
    /// surface, or meets it from behind.
    pub fn along(&self, x: &Triple<f64>, n: &Triple<f64>) -> Option<Triple<f64>> {
        let size = self.size();
        let mut s = 0.0;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let at = sum(x, &scaled(s, n));
            let slope = dot(&self.gradient(&at), n);
            let step = -self.value(&at) / slope;
            if !(slope > 0.0) || !step.is_finite() {
                return None;
            }
            s += step;
            let small = step.abs();
            if small <= 1e-16 * size || small >= last && small <= 1e-13 * size {
                return Some(sum(x, &scaled(s, n)));
            }
            last = small;
        }
        None
    }

    /// A place of the surface near x, along the gradients on the way.
    pub fn settled(&self, mut x: Triple<f64>) -> Option<Triple<f64>> {
        let size = self.size();
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let gradient = self.gradient(&x);
            let share = -self.value(&x) / dot(&gradient, &gradient);
            let step = scaled(share, &gradient);
            let long = norm(&step);
            if !long.is_finite() {
                return None;
            }
            x = sum(&x, &scaled((0.5 * size / long).min(1.0), &step));
            if long <= 1e-16 * size || long >= last && long <= 1e-13 * size {
                return Some(x);
            }
            last = long;
        }
        None
    }

    /// The place on the surface below a point p: p - x is along the normal. From the place to which the gradients lead (of a
    /// profile, the nearest of some), by steps (1 + g S)⁻¹ of the misfit across the normal, g being the height of p.
    pub fn foot(&self, p: &Triple<f64>) -> Option<Triple<f64>> {
        let size = self.size();
        let mut x = match &self.kind {
            Kind::Revolution(profile) => profile.nearest(p),
            _ => self.settled(*p)?,
        };
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let n = self.normal(&x);
            let [t1, t2] = tangents(&n);
            let arm = difference(p, &x);
            let height = dot(&arm, &n);
            let [[a, b], [_, c]] = self.shape(&x, &[t1, t2]);
            let (a, b, c) = (1.0 + height * a, height * b, 1.0 + height * c);
            let misfit = [dot(&arm, &t1), dot(&arm, &t2)];
            let long = misfit[0].hypot(misfit[1]);
            if long <= 1e-15 * size || long >= last && long <= 1e-11 * size {
                return Some(x);
            }
            last = long;
            let determinant = a * c - b * b;
            // Deep below a hollow the foot is not the nearest place; then down the misfit itself.
            let step = if determinant > 1e-6 && a > 0.0 {
                [(c * misfit[0] - b * misfit[1]) / determinant, (a * misfit[1] - b * misfit[0]) / determinant]
            } else {
                misfit
            };
            let factor = (0.3 * size / step[0].hypot(step[1])).min(1.0);
            let aside = sum(&scaled(factor * step[0], &t1), &scaled(factor * step[1], &t2));
            x = self.settled(sum(&x, &aside))?;
        }
        None
    }
}

fn times<T: Scalar>(matrix: &Matrix4<f64>, v: &Triple<T>, last: T) -> [T; 4] {
    std::array::from_fn(|i| {
        T::from(matrix[(i, 0)]) * v[0]
            + T::from(matrix[(i, 1)]) * v[1]
            + T::from(matrix[(i, 2)]) * v[2]
            + T::from(matrix[(i, 3)]) * last
    })
}
