//! The meridian of a surface of revolution, as q(z) = r², which stays smooth where the surface is closed by a pole.
//!
//! A rounded pole has r ~ √(z - z0), whose slope is infinite; q ~ z - z0 is not. Points are therefore joined by a spline
//! of r². An expression's r is squared exactly, except where it ends in a pole: there its derivatives cancel or overflow, so
//! that q is replaced by its Chebyshev series if that converges to round-off (Trefethen, *Approximation Theory and
//! Approximation Practice*, ch. 3 and 4).

use super::error::SurfaceError;
use crate::FunctionSpline;
use flexura_expression::Function;
use flexura_model::RevolutionProfile;
use std::f64::consts::PI;

/// Places at which a profile is looked at.
const LOOKS: usize = 257;
/// Longest series that is tried.
const LONGEST: usize = 128;

/// q(z) between two ends.
#[derive(Clone, Debug)]
pub(super) struct Profile {
    kind: Kind,
    range: [f64; 2],
    widest: f64,
}

#[derive(Clone, Debug)]
enum Kind {
    Spline(FunctionSpline),
    Radius(Function),
    Series([Vec<f64>; 4]),
}

impl Profile {
    pub fn new(profile: &RevolutionProfile) -> Result<Self, SurfaceError> {
        let mut made = match profile {
            RevolutionProfile::Points(points) => through(points)?,
            RevolutionProfile::Radius { radius, range: [from, to] } => {
                if !(from.is_finite() && to.is_finite() && from < to) {
                    return Err(SurfaceError::Range { from: *from, to: *to });
                }
                Self { kind: Kind::Radius(radius.clone()), range: [*from, *to], widest: 0.0 }
            }
        };
        let [from, to] = made.range;
        let place = |i: usize| from + (to - from) * i as f64 / (LOOKS - 1) as f64;
        let radius = |z: f64| match profile {
            RevolutionProfile::Radius { radius, .. } => radius.value(z),
            // The spline's, negative where it is below zero.
            RevolutionProfile::Points(_) => {
                let q = made.jet(z)[0];
                q.abs().sqrt() * q.signum()
            }
        };
        let radii: Vec<f64> = (0..LOOKS).map(|i| radius(place(i))).collect();
        let widest = radii.iter().copied().fold(0.0, f64::max);
        for (i, r) in radii.iter().enumerate() {
            let end = i == 0 || i == LOOKS - 1;
            if !(r.is_finite() && (*r > 0.0 || end && *r >= -1e-9 * widest)) {
                return Err(SurfaceError::Radius { z: place(i), radius: *r });
            }
        }
        let pole = radii[0].min(radii[LOOKS - 1]) <= 1e-7 * widest;
        if let (RevolutionProfile::Radius { radius, .. }, true) = (profile, pole)
            && let Some(series) = series(radius, made.range)
        {
            made.kind = Kind::Series(series);
        }
        made.widest = widest;
        Ok(made)
    }

    /// q and its first three derivatives by z.
    pub fn jet(&self, z: f64) -> [f64; 4] {
        match &self.kind {
            Kind::Spline(spline) => spline.jet(z),
            Kind::Radius(radius) => {
                let [r, d1, d2, d3] = radius.jet(z);
                [r * r, 2.0 * r * d1, 2.0 * (d1 * d1 + r * d2), 2.0 * (3.0 * d1 * d2 + r * d3)]
            }
            Kind::Series(series) => {
                let [from, to] = self.range;
                let x = (2.0 * z - from - to) / (to - from);
                std::array::from_fn(|k| clenshaw(&series[k], x))
            }
        }
    }

    /// First and last z, m.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// The largest radius, m.
    pub fn widest(&self) -> f64 {
        self.widest
    }

    /// The angle of the meridian's outward normal above the plane across the axis: from -π/2 to π/2 on a closed convex one.
    pub fn slope_angle(&self, z: f64) -> f64 {
        let [q, dq, ..] = self.jet(z);
        (-dq).atan2(2.0 * q.max(0.0).sqrt())
    }

    /// The nearest to p of places along the meridian in its direction; within the ends, beyond which q means nothing.
    pub fn nearest(&self, p: &[f64; 3]) -> [f64; 3] {
        let [from, to] = self.range;
        let across = p[0].hypot(p[1]);
        let along = if across > 0.0 { [p[0] / across, p[1] / across] } else { [1.0, 0.0] };
        let mut best = (f64::INFINITY, [0.0; 2]);
        for i in 0..LOOKS {
            // Closer together towards the ends, where poles are.
            let z = 0.5 * (from + to) - 0.5 * (to - from) * (PI * i as f64 / (LOOKS - 1) as f64).cos();
            let radius = self.jet(z)[0].max(0.0).sqrt();
            let distance = (radius - across).hypot(z - p[2]);
            if distance < best.0 {
                best = (distance, [radius, z]);
            }
        }
        let (_, [radius, z]) = best;
        [radius * along[0], radius * along[1], z]
    }

    /// Is the meridian curved outwards everywhere: r r'' < 0 with r² r r'' = (2 q q'' - q'²)/4?
    pub fn is_rounded(&self) -> bool {
        let [from, to] = self.range;
        (0..LOOKS).all(|i| {
            let [q, d1, d2, _] = self.jet(from + (to - from) * i as f64 / (LOOKS - 1) as f64);
            2.0 * q * d2 - d1 * d1 < 0.0
        })
    }

    /// About where the normal has the given angle; None clearly beyond the ends.
    pub fn where_normal(&self, angle: f64) -> Option<f64> {
        let [mut low, mut high] = self.range;
        if !(self.slope_angle(low) <= angle + 1e-6 && self.slope_angle(high) >= angle - 1e-6) {
            return None;
        }
        let size = high - low;
        while high - low > 1e-9 * size {
            let middle = 0.5 * (low + high);
            if self.slope_angle(middle) < angle {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(0.5 * (low + high))
    }
}

fn through(points: &[[f64; 2]]) -> Result<Profile, SurfaceError> {
    if let Some(index) = points.iter().position(|point| !point.iter().all(|x| x.is_finite())) {
        return Err(SurfaceError::PointNotFinite { index });
    }
    if points.len() < 3 {
        return Err(SurfaceError::TooFewProfilePoints { count: points.len() });
    }
    if let Some(index) = points.windows(2).position(|pair| pair[0][0] >= pair[1][0]) {
        return Err(SurfaceError::ProfileOrder { index });
    }
    if let Some([z, radius]) = points.iter().find(|[_, r]| *r < 0.0) {
        return Err(SurfaceError::Radius { z: *z, radius: *radius });
    }
    let squares: Vec<[f64; 2]> = points.iter().map(|[z, r]| [*z, r * r]).collect();
    let order = SurfaceError::ProfileOrder { index: 0 };
    let spline = FunctionSpline::new(&squares).ok_or(order)?;
    let range = spline.range();
    Ok(Profile { kind: Kind::Spline(spline), range, widest: 0.0 })
}

/// Chebyshev coefficients of q and its first three derivatives by z; None where they do not fall to round-off.
fn series(radius: &Function, [from, to]: [f64; 2]) -> Option<[Vec<f64>; 4]> {
    let half = 0.5 * (to - from);
    let mut count = 16;
    while count <= LONGEST {
        let values: Vec<f64> = (0..=count)
            .map(|i| {
                let x = (PI * i as f64 / count as f64).cos();
                radius.value(0.5 * (from + to) + half * x).max(0.0).powi(2)
            })
            .collect();
        let coefficients = interpolated(&values);
        let largest = coefficients.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        let needed = coefficients.iter().rposition(|c| c.abs() > 4e-16 * largest).unwrap_or(0);
        if largest.is_finite() && needed + 4 <= count {
            let first = coefficients[..=needed].to_vec();
            let slope = |of: &[f64]| derivative(of, half);
            let (second, third) = (slope(&first), slope(&slope(&first)));
            let fourth = slope(&third);
            return Some([first, second, third, fourth]);
        }
        count *= 2;
    }
    None
}

/// Coefficients of the polynomial through values at the places cos(π i/n).
fn interpolated(values: &[f64]) -> Vec<f64> {
    let n = values.len() - 1;
    (0..=n)
        .map(|k| {
            let term = |i: usize| {
                let end = if i == 0 || i == n { 0.5 } else { 1.0 };
                end * values[i] * (PI * (i * k % (2 * n)) as f64 / n as f64).cos()
            };
            let sum: f64 = (0..=n).map(term).sum();
            sum * if k == 0 || k == n { 1.0 } else { 2.0 } / n as f64
        })
        .collect()
}

/// Coefficients of the derivative: c'_{k-1} = c'_{k+1} + 2 k c_k.
fn derivative(coefficients: &[f64], half: f64) -> Vec<f64> {
    let n = coefficients.len();
    let mut slope = vec![0.0; n + 1];
    for k in (1..n).rev() {
        slope[k - 1] = slope[k + 1] + 2.0 * k as f64 * coefficients[k];
    }
    slope[0] *= 0.5;
    slope.truncate(n.saturating_sub(1).max(1));
    slope.iter().map(|c| c / half).collect()
}

fn clenshaw(coefficients: &[f64], x: f64) -> f64 {
    let (mut one, mut two) = (0.0, 0.0);
    for c in coefficients.iter().skip(1).rev() {
        (one, two) = (c + 2.0 * x * one - two, one);
    }
    coefficients[0] + x * one - two
}
