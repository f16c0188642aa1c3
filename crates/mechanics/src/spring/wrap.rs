//! The shortest path between two points around a sphere or a cylinder, its length ℓ, and the first and second derivatives
//! of ℓ by the two points. Points are in the obstacle's frame: the sphere's centre, or a point of the cylinder's axis, is the origin.
//!
//! In the plane of a circle of radius r, with a and b the points, A and B their distances from the centre, γ the angle from
//! a to b, the path leaves the straight line where γ > φ_a + φ_b, φ_a = acos(r/A), and is then a tangent, an arc and a tangent:
//!
//! ```text
//! λ = √(A² - r²) + √(B² - r²) + r (γ - φ_a - φ_b)
//! ```
//!
//! With l_a = √(A² - r²), â = a/A and e_a the direction across it in which γ grows:
//!
//! ```text
//! ∂λ/∂a = (l_a â - r e_a)/A                                   a unit vector along the tangent
//! ∂²λ/∂a² = r²/(l_a A²) â âᵀ + l_a/A² e_a e_aᵀ + r/A² (â e_aᵀ + e_a âᵀ),    ∂²λ/∂a∂b = 0
//! ```
//!
//! On a sphere the plane turns with the points; with n its normal, second derivatives gain (l_a + r cot γ)/A² n nᵀ and
//! -r/(A B sin γ) n nᵀ, those of the angle between two directions. A cylinder's surface and the tangent planes unroll into
//! a plane, in which the path is straight: ℓ = √(λ² + z²), λ being the planar length across the axis and z the distance along it.

use flexura_model::Turn;
use flexura_spatial::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

type V = Vector3<f64>;

/// Sine of the angle at the centre of a sphere below which points count as opposite each other.
const OPPOSITE: f64 = 1e-9;

/// An end that is no deeper inside than this part of the radius is on the rim: places are rounded numbers.
const RIM: f64 = 1e-9;
/// Least tangent, relative to the radius: on the rim itself the second derivative r²/(l A²) has no bound.
const LEAST_TANGENT: f64 = 1e-9;

/// The largest turn between two points of a course, rad.
const ARC_STEP: f64 = PI / 36.0;

/// What the path goes around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A sphere about the origin.
    Sphere {
        /// r, m.
        radius: f64,
    },
    /// A cylinder about an axis through the origin, without ends.
    Cylinder {
        /// r, m.
        radius: f64,
        /// Unit vector.
        axis: V,
        /// The side, for good: the angle from a to b about the axis is then counted from 0 to 2π; None: the shorter way.
        turn: Option<Turn>,
    },
}

/// Why there is no path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathError {
    /// An end is neither outside nor on the rim.
    Inside {
        /// 0 or 1.
        end: usize,
        /// From the centre or the axis, m.
        distance: f64,
    },
    /// The ends are on opposite sides of a sphere: every way around is as short.
    Opposite,
}

/// A path that touches the obstacle.
#[derive(Clone, Copy, Debug)]
pub struct Around {
    /// ℓ, m.
    pub length: f64,
    /// ∂ℓ/∂a, ∂ℓ/∂b.
    pub gradient: [V; 2],
    /// Second derivatives.
    pub hessian: [[Matrix3<f64>; 2]; 2],
    arc: Arc,
}

/// The part on the surface: r (cos θ u + sin θ v) + height(θ), θ from `from` to `to`.
#[derive(Clone, Copy, Debug)]
struct Arc {
    radius: f64,
    u: V,
    v: V,
    from: f64,
    to: f64,
    /// At `from`, and its growth with θ.
    height: [V; 2],
}

/// The planar problem; vectors lie in the plane.
struct Planar {
    length: f64,
    /// l_a, l_b; A, B; φ_a, φ_b.
    tangents: [f64; 2],
    distances: [f64; 2],
    arccos: [f64; 2],
    /// â, b̂ and e_a, e_b.
    outward: [V; 2],
    across: [V; 2],
}

impl Obstacle {
    /// r, m.
    pub fn radius(&self) -> f64 {
        match self {
            Self::Sphere { radius } | Self::Cylinder { radius, .. } => *radius,
        }
    }

    /// The same obstacle in other units of length.
    pub fn scaled(&self, factor: f64) -> Self {
        match *self {
            Self::Sphere { radius } => Self::Sphere { radius: radius * factor },
            Self::Cylinder { radius, axis, turn } => Self::Cylinder { radius: radius * factor, axis, turn },
        }
    }

    /// The path from `a` to `b`; None where it is straight.
    ///
    /// # Errors
    /// Where there is no path, or none that is shortest.
    pub fn around(&self, a: &V, b: &V) -> Result<Option<Around>, PathError> {
        match *self {
            Self::Sphere { radius } => around_sphere(radius, a, b),
            Self::Cylinder { radius, axis, turn } => around_cylinder(radius, &axis, turn, a, b),
        }
    }
}

impl Around {
    /// Points of the course from `a` to `b`, in the obstacle's frame.
    pub fn course(&self, a: &V, b: &V) -> Vec<V> {
        let Arc { radius, u, v, from, to, height } = self.arc;
        let steps = ((to - from) / ARC_STEP).ceil().max(1.0) as usize;
        let on_surface = (0..=steps).map(|i| {
            let turn = (to - from) * i as f64 / steps as f64;
            let (sin, cos) = (from + turn).sin_cos();
            (u * cos + v * sin) * radius + height[0] + height[1] * turn
        });
        std::iter::once(*a).chain(on_surface).chain(std::iter::once(*b)).collect()
    }

    /// The angle about the centre or the axis over which it touches, rad.
    pub fn contact(&self) -> f64 {
        self.arc.to - self.arc.from
    }
}

fn outside(radius: f64, distances: [f64; 2]) -> Result<(), PathError> {
    match distances.iter().position(|distance| distance.is_nan() || *distance < radius * (1.0 - RIM)) {
        Some(end) => Err(PathError::Inside { end, distance: distances[end] }),
        None => Ok(()),
    }
}

/// None where the straight line clears the circle, which lies across `normal`; `angle` from a to b about it.
fn planar(radius: f64, points: [&V; 2], distances: [f64; 2], normal: &V, angle: f64) -> Option<Planar> {
    let tangents =
        distances.map(|d| ((d - radius) * (d + radius)).max(0.0).sqrt().max(LEAST_TANGENT * radius));
    let arccos = [0, 1].map(|i| tangents[i].atan2(radius));
    let arc = angle - arccos[0] - arccos[1];
    if arc <= 0.0 {
        return None;
    }
    let outward = [points[0] / distances[0], points[1] / distances[1]];
    let across = [normal.cross(&outward[0]), -normal.cross(&outward[1])];
    let length = tangents[0] + tangents[1] + radius * arc;
    Some(Planar { length, tangents, distances, arccos, outward, across })
}

impl Planar {
    fn gradient(&self, radius: f64) -> [V; 2] {
        [0, 1].map(|i| (self.outward[i] * self.tangents[i] - self.across[i] * radius) / self.distances[i])
    }

    fn curvature(&self, radius: f64) -> [Matrix3<f64>; 2] {
        [0, 1].map(|i| {
            let (l, square) = (self.tangents[i], self.distances[i].powi(2));
            let (a, e) = (self.outward[i], self.across[i]);
            let mixed = a * e.transpose();
            a * a.transpose() * (radius * radius / (l * square))
                + e * e.transpose() * (l / square)
                + (mixed + mixed.transpose()) * (radius / square)
        })
    }

    fn arc(&self, radius: f64, angle: f64, height: [V; 2]) -> Arc {
        let to = angle - self.arccos[1];
        Arc { radius, u: self.outward[0], v: self.across[0], from: self.arccos[0], to, height }
    }
}

fn around_sphere(radius: f64, a: &V, b: &V) -> Result<Option<Around>, PathError> {
    let distances = [a.norm(), b.norm()];
    outside(radius, distances)?;
    let cross = a.cross(b);
    let angle = cross.norm().atan2(a.dot(b));
    let sine = cross.norm() / (distances[0] * distances[1]);
    if sine < OPPOSITE {
        return if angle < 1.0 { Ok(None) } else { Err(PathError::Opposite) };
    }
    let normal = cross / cross.norm();
    let Some(path) = planar(radius, [a, b], distances, &normal, angle) else { return Ok(None) };
    let sideways = normal * normal.transpose();
    let [mut aa, mut bb] = path.curvature(radius);
    aa += sideways * ((path.tangents[0] + radius / angle.tan()) / distances[0].powi(2));
    bb += sideways * ((path.tangents[1] + radius / angle.tan()) / distances[1].powi(2));
    let ab = sideways * (-radius / (distances[0] * distances[1] * sine));
    Ok(Some(Around {
        length: path.length,
        gradient: path.gradient(radius),
        hessian: [[aa, ab], [ab, bb]],
        arc: path.arc(radius, angle, [V::zeros(); 2]),
    }))
}

fn around_cylinder(
    radius: f64,
    axis: &V,
    turn: Option<Turn>,
    a: &V,
    b: &V,
) -> Result<Option<Around>, PathError> {
    let heights = [axis.dot(a), axis.dot(b)];
    let (flat_a, flat_b) = (a - axis * heights[0], b - axis * heights[1]);
    let distances = [flat_a.norm(), flat_b.norm()];
    outside(radius, distances)?;
    let signed = axis.dot(&flat_a.cross(&flat_b)).atan2(flat_a.dot(&flat_b));
    let sign = match turn {
        Some(Turn::Positive) => 1.0,
        Some(Turn::Negative) => -1.0,
        None if signed < 0.0 => -1.0,
        None => 1.0,
    };
    let normal = axis * sign;
    // With the axis on the wrong side of the line between the ends, the way there is more than half a turn.
    let angle = if sign * signed < 0.0 { TAU - signed.abs() } else { signed.abs() };
    let Some(path) = planar(radius, [&flat_a, &flat_b], distances, &normal, angle) else { return Ok(None) };
    let rise = heights[1] - heights[0];
    let length = path.length.hypot(rise);
    let flat = path.gradient(radius);
    let along = [-*axis, *axis];
    let gradient = [0, 1].map(|i| (flat[i] * path.length + along[i] * rise) / length);
    let curved = path.curvature(radius);
    let hessian = [0, 1].map(|i| {
        [0, 1].map(|j| {
            let own = if i == j { curved[i] * path.length } else { Matrix3::zeros() };
            (flat[i] * flat[j].transpose() + along[i] * along[j].transpose()
                - gradient[i] * gradient[j].transpose()
                + own)
                / length
        })
    });
    let slope = rise / path.length;
    let height = [axis * (heights[0] + slope * path.tangents[0]), axis * (slope * radius)];
    Ok(Some(Around { length, gradient, hessian, arc: path.arc(radius, angle, height) }))
}
