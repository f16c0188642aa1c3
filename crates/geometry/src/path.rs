//! Curves that are traced by a parameter: the point and its first three derivatives.

use crate::spline::Spline;
use flexura_expression::Function;
use flexura_spatial::Vector3;

/// A curve x(t), metres, over any parameter t.
#[derive(Clone, Debug)]
pub(crate) enum Path {
    /// Given by expressions.
    Parametric {
        position: [Function; 3],
        /// First and last parameter value, and those between at which a coordinate is not smooth.
        knots: Vec<f64>,
    },
    /// Through points.
    Spline(Spline),
    /// Circular arcs in the plane, by arc length.
    Arcs(Arcs),
    /// (a cos t, b sin t, 0).
    Ellipse { semi_axes: [f64; 2], range: [f64; 2] },
}

/// A coordinate of a cell may leave its polynomial of degree 7 by this part of the cell's size: what is narrower than the
/// distance of the nodes would leave it by more.
const RESOLVED: f64 = 1e-2;

impl Path {
    /// A curve given by expressions.
    pub fn parametric(position: &[Function; 3], [from, to]: [f64; 2]) -> Self {
        let mut knots = vec![from, to];
        knots.extend(position.iter().flat_map(|function| function.breaks(from, to)));
        knots.sort_by(f64::total_cmp);
        knots.dedup_by(|later, earlier| *later - *earlier < 1e-12 * (to - from));
        Path::Parametric { position: position.clone(), knots }
    }

    /// Is it certain that nothing happens between two parameter values that a few places there do not show, but for what moves
    /// no point by more than `tiny` (m)?
    pub fn is_resolved(&self, [a, b]: [f64; 2], tiny: f64) -> bool {
        let Path::Parametric { position, .. } = self else { return true };
        let variations = position.each_ref().map(|f| f.variation(a, b));
        let chord = (self.jet(b)[0] - self.jet(a)[0]).norm();
        variations.iter().map(|v| v.remainder).sum::<f64>() <= RESOLVED * chord
            || variations.iter().map(|v| v.hidden_slope() * (b - a)).sum::<f64>() <= tiny
    }

    /// The parameter values between which the path is smooth, the ends included.
    pub fn knots(&self) -> Vec<f64> {
        match self {
            Path::Parametric { knots, .. } => knots.clone(),
            Path::Ellipse { range, .. } => range.to_vec(),
            Path::Spline(spline) => spline.knots().to_vec(),
            Path::Arcs(arcs) => arcs.knots.clone(),
        }
    }

    /// x(t) and its first three derivatives.
    pub fn jet(&self, t: f64) -> [Vector3<f64>; 4] {
        match self {
            Path::Parametric { position, .. } => {
                let [x, y, z] = [position[0].jet(t), position[1].jet(t), position[2].jet(t)];
                std::array::from_fn(|i| Vector3::new(x[i], y[i], z[i]))
            }
            Path::Spline(spline) => spline.jet(t),
            Path::Arcs(arcs) => arcs.jet(t),
            Path::Ellipse { semi_axes: [a, b], .. } => {
                let (sin, cos) = t.sin_cos();
                let [x, y] = [a * cos, b * sin];
                let [u, v] = [-a * sin, b * cos];
                [
                    Vector3::new(x, y, 0.0),
                    Vector3::new(u, v, 0.0),
                    Vector3::new(-x, -y, 0.0),
                    Vector3::new(-u, -v, 0.0),
                ]
            }
        }
    }

    /// The local geometry at parameter `t`.
    pub fn local(&self, t: f64) -> Local {
        Local::new(&self.jet(t))
    }
}

/// Circular arcs that join smoothly.
#[derive(Clone, Debug)]
pub(crate) struct Arcs {
    /// Arc length at the joints, the ends included.
    knots: Vec<f64>,
    /// For each arc: point and direction (angle) at its beginning, curvature.
    pieces: Vec<([f64; 2], f64, f64)>,
}

impl Arcs {
    /// Radius (m) and angle (rad, positive to the left) of each arc, all radii positive.
    pub fn new(mut point: [f64; 2], mut direction: f64, arcs: &[[f64; 2]]) -> Self {
        let (mut knots, mut pieces) = (vec![0.0], Vec::new());
        let mut s = 0.0;
        for [radius, angle] in arcs {
            let curvature = angle.signum() / radius;
            pieces.push((point, direction, curvature));
            s += radius * angle.abs();
            knots.push(s);
            let end = direction + angle;
            point[0] += (end.sin() - direction.sin()) / curvature;
            point[1] -= (end.cos() - direction.cos()) / curvature;
            direction = end;
        }
        Self { knots, pieces }
    }

    fn jet(&self, t: f64) -> [Vector3<f64>; 4] {
        let i = self.knots.partition_point(|knot| *knot <= t).saturating_sub(1).min(self.pieces.len() - 1);
        let (point, direction, curvature) = self.pieces[i];
        let (sin, cos) = (direction + curvature * (t - self.knots[i])).sin_cos();
        let (sin0, cos0) = direction.sin_cos();
        [
            Vector3::new(point[0] + (sin - sin0) / curvature, point[1] - (cos - cos0) / curvature, 0.0),
            Vector3::new(cos, sin, 0.0),
            Vector3::new(-sin, cos, 0.0) * curvature,
            Vector3::new(-cos, -sin, 0.0) * (curvature * curvature),
        ]
    }
}

/// The geometry of a curve at one place, independent of the parameter but for the speed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    /// x, m.
    pub position: Vector3<f64>,
    /// |dx/dt|.
    pub speed: f64,
    /// Unit tangent T.
    pub tangent: Vector3<f64>,
    /// dT/ds, 1/m: points to the centre of curvature, its length is the curvature.
    pub bend: Vector3<f64>,
    /// Torsion τ = ẋ·(ẍ×x⃛)/|ẋ×ẍ|², 1/m; not finite where the curvature vanishes.
    pub torsion: f64,
}

impl Local {
    /// From x and its first three derivatives with respect to any parameter.
    pub fn new(jet: &[Vector3<f64>; 4]) -> Self {
        let [position, d1, d2, d3] = jet;
        let speed = d1.norm();
        let tangent = d1 / speed;
        let binormal = d1.cross(d2);
        // (ẋ × ẍ) × ẋ / |ẋ|⁴ is the part of ẍ across the tangent over |ẋ|².
        let bend = binormal.cross(&tangent) / (speed * speed * speed);
        let torsion = binormal.dot(d3) / binormal.norm_squared();
        Self { position: *position, speed, tangent, bend, torsion }
    }

    /// Is every derivative finite?
    pub fn is_finite(&self) -> bool {
        self.position.iter().all(|x| x.is_finite())
            && self.speed.is_finite()
            && (self.speed == 0.0 || self.bend.iter().all(|x| x.is_finite()))
    }
}
