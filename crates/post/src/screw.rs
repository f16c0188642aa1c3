//! Screws and compliances as a designer of flexures reads them.

use flexura_spatial::{Matrix3, Matrix6, Pose, Twist, Vector3, log};

/// A screw: a turning about an axis with a travel along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Unit vector along the axis.
    pub axis: Vector3<f64>,
    /// The point of the axis nearest to where the body's origin is, m.
    pub point: Vector3<f64>,
    /// Travel along the axis per turning, m/rad.
    pub pitch: f64,
    /// Turning, rad (of an instantaneous screw: per unit of what drives it).
    pub angle: f64,
}

/// Turnings relative to shifts (1/m times length) below this count as no turning at all.
const NO_TURNING: f64 = 1e-12;

/// The screw that takes a body from one pose to another (Chasles' theorem): with R = exp(θ u) its turning and d the
/// shift of its origin, the travel is u·d, and the axis passes through the point c with (I - R) c = p1 - R p0 - (u·d) u.
/// Of all such c the one nearest to the origin's present place p1 is given. None for a pure translation.
pub fn finite_screw(from: &Pose, to: &Pose) -> Option<Screw> {
    let turn = log(&(to.rotation * from.rotation.inverse()));
    let angle = turn.norm();
    let shift = to.position - from.position;
    if angle <= NO_TURNING * (1.0 + shift.norm()) {
        return None;
    }
    let axis = turn / angle;
    let across = shift - axis * axis.dot(&shift);
    // Halfway between the two places, and from there across by half the shift's cotangent of the half angle.
    let middle = from.position + across * 0.5 + axis * axis.dot(&shift);
    let centre = middle + axis.cross(&across) * (0.5 / (0.5 * angle).tan());
    Some(Screw { axis, point: nearest(&centre, &axis, &to.position), pitch: axis.dot(&shift) / angle, angle })
}

/// The instantaneous screw of a motion of the origin, at `position`, by `linear` while it turns by `angular`:
/// the axis runs along ω through p + ω × v / |ω|². None for a pure translation.
pub fn instantaneous_screw(position: &Vector3<f64>, motion: &Twist) -> Option<Screw> {
    let angle = motion.angular.norm();
    if angle == 0.0 || angle <= NO_TURNING * motion.linear.norm() {
        return None;
    }
    let axis = motion.angular / angle;
    let point = position + motion.angular.cross(&motion.linear) / (angle * angle);
    Some(Screw { axis, point, pitch: axis.dot(&motion.linear) / angle, angle })
}

fn nearest(point: &Vector3<f64>, axis: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    point + axis * axis.dot(&(to - point))
}

/// The point, relative to where a compliance was taken, at which its coupling block is symmetric (J. Loncaric, "Normal
/// forms of stiffness and compliance matrices", IEEE J. Robotics Autom. 3 (1987) 567-572). With motions (x, θ) and loads
/// (f, m), moving the point of reference by d turns the block x-by-m into `B + θm-block`: `B' = B - hat(d) D`,
/// D the block θ-by-m, and B' is symmetric for `(tr D I - D) d = axial part of B`. None where that has no solution: a
/// motion without any compliance in turning.
pub fn center_of_compliance(compliance: &Matrix6<f64>) -> Option<Vector3<f64>> {
    let b: Matrix3<f64> = compliance.fixed_view::<3, 3>(0, 3).into();
    let d: Matrix3<f64> = compliance.fixed_view::<3, 3>(3, 3).into();
    let matrix = Matrix3::identity() * d.trace() - d;
    let axial = Vector3::new(b[(2, 1)] - b[(1, 2)], b[(0, 2)] - b[(2, 0)], b[(1, 0)] - b[(0, 1)]);
    if !matrix.iter().all(|value| value.is_finite()) {
        return None;
    }
    let svd = matrix.svd(true, true);
    // In a planar mechanism nothing is said about the direction across the plane: the solution of least norm.
    let largest = svd.singular_values.max();
    if largest == 0.0 {
        return None;
    }
    svd.solve(&axial, 1e-9 * largest).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura_spatial::{exp, hat};

    #[test]
    fn a_turning_about_a_point_has_its_centre_there() {
        let centre = Vector3::new(0.3, -0.2, 0.0);
        for angle in [1e-6, 0.3, 2.0, 3.1] {
            let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
            let rotation = exp(&(axis * angle));
            let from = Pose::new(exp(&Vector3::new(0.1, 0.2, 0.3)), Vector3::new(1.0, 2.0, -0.5));
            let travel = 0.4;
            let to = Pose::new(
                rotation * from.rotation,
                centre + rotation * (from.position - centre) + axis * travel,
            );
            let screw = finite_screw(&from, &to).unwrap();
            let off = screw.point - centre;
            assert!((off - axis * axis.dot(&off)).norm() < 1e-8 / angle.clamp(1e-3, 1.0), "{angle}: {off}");
            assert!((screw.axis - axis).norm() < 1e-8 && (screw.angle - angle).abs() < 1e-12);
            assert!((screw.pitch * angle - travel).abs() < 1e-8);
        }
        assert!(finite_screw(&Pose::identity(), &Pose::translation(Vector3::x())).is_none());
    }

    #[test]
    fn the_instantaneous_axis_does_not_move_across_itself() {
        let motion = Twist { angular: Vector3::new(0.2, 0.1, -0.4), linear: Vector3::new(1.0, -2.0, 0.3) };
        let position = Vector3::new(0.5, 0.1, 0.2);
        let screw = instantaneous_screw(&position, &motion).unwrap();
        let there = motion.linear + motion.angular.cross(&(screw.point - position));
        assert!((there - motion.angular * screw.pitch).norm() < 1e-14);
    }

    /// A compliance made symmetric at a known point and then seen from elsewhere.
    #[test]
    fn the_centre_of_compliance_comes_back() {
        let a = Matrix3::new(2.0, 0.1, 0.2, 0.1, 3.0, -0.3, 0.2, -0.3, 1.5);
        let b = Matrix3::new(0.2, 0.1, 0.0, 0.1, -0.3, 0.05, 0.0, 0.05, 0.1);
        let d = Matrix3::new(0.7, 0.1, 0.0, 0.1, 0.9, 0.2, 0.0, 0.2, 1.3);
        let centre = Vector3::new(0.3, -0.6, 0.8);
        // Motion at the origin from that at the centre: x0 = x + hat(-c)ᵀ.., loads likewise.
        let h = hat(&centre);
        let mut at_centre = Matrix6::zeros();
        at_centre.fixed_view_mut::<3, 3>(0, 0).copy_from(&a);
        at_centre.fixed_view_mut::<3, 3>(0, 3).copy_from(&b);
        at_centre.fixed_view_mut::<3, 3>(3, 0).copy_from(&b.transpose());
        at_centre.fixed_view_mut::<3, 3>(3, 3).copy_from(&d);
        // x0 = x + c × θ (from the centre back to the origin), and m = m0 - c × f.
        let mut motion = Matrix6::identity();
        motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&h);
        let seen = motion * at_centre * motion.transpose();
        let found = center_of_compliance(&seen).unwrap();
        assert!((found - centre).norm() < 1e-12, "{found}");
    }
}
