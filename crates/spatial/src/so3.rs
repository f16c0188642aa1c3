//! The rotation group SO(3): exponential, logarithm and their tangents.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// The skew-symmetric matrix of `a`, so that `hat(a) * b = a × b`.
pub fn hat(a: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

/// The rotation by the rotation vector `v` (axis times angle, rad).
///
/// `exp(v) = (cos ½|v|, sin(½|v|) v/|v|)`, with the series of `sinc` near zero so that no direction is
/// lost for tiny angles.
pub fn exp(v: &Vector3<f64>) -> UnitQuaternion<f64> {
    let half = 0.5 * v.norm();
    let scale = if half < 1e-3 {
        let h2 = half * half;
        0.5 * (1.0 - h2 / 6.0 * (1.0 - h2 / 20.0))
    } else {
        0.5 * half.sin() / half
    };
    UnitQuaternion::from_quaternion(Quaternion::new(half.cos(), scale * v.x, scale * v.y, scale * v.z))
}

/// The rotation vector of a rotation, of length at most π. The inverse of [`exp`] on that ball.
pub fn log(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let q = rotation.quaternion();
    // q and -q are the same rotation; the one with w >= 0 has the shorter rotation vector.
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    let (w, v) = (sign * q.w, Vector3::new(q.i, q.j, q.k) * sign);
    let sine = v.norm();
    if sine < 1e-9 {
        return v * (2.0 / w);
    }
    v * (2.0 * sine.atan2(w) / sine)
}

/// `J(v)` of `exp(v + dv) = exp(J(v) dv) exp(v)` to first order: the left Jacobian of SO(3).
///
/// `J = I + (1 - cos θ)/θ² hat(v) + (θ - sin θ)/θ³ hat(v)²`, θ = |v| (Chirikjian, *Stochastic Models,
/// Information Theory, and Lie Groups*, vol. 2, eq. 10.86).
pub fn left_jacobian(v: &Vector3<f64>) -> Matrix3<f64> {
    let angle2 = v.norm_squared();
    let angle = angle2.sqrt();
    let (b, c) = if angle < 1e-2 {
        (0.5 - angle2 / 24.0 + angle2 * angle2 / 720.0, 1.0 / 6.0 - angle2 / 120.0 + angle2 * angle2 / 5040.0)
    } else {
        ((1.0 - angle.cos()) / angle2, (angle - angle.sin()) / (angle2 * angle))
    };
    let skew = hat(v);
    Matrix3::identity() + skew * b + skew * skew * c
}

/// The inverse of [`left_jacobian`], finite for |v| < 2π.
///
/// `J⁻¹ = I - ½ hat(v) + (1/θ² - (1 + cos θ)/(2 θ sin θ)) hat(v)²`.
pub fn left_jacobian_inverse(v: &Vector3<f64>) -> Matrix3<f64> {
    let angle2 = v.norm_squared();
    let angle = angle2.sqrt();
    let c = if angle < 1e-2 {
        1.0 / 12.0 + angle2 / 720.0 + angle2 * angle2 / 30240.0
    } else {
        let half = 0.5 * angle;
        (1.0 - half * half.cos() / half.sin()) / angle2
    };
    let skew = hat(v);
    Matrix3::identity() - skew * 0.5 + skew * skew * c
}

/// The rotation whose matrix has the given orthonormal, right-handed columns.
pub fn rotation_from_axes(e1: &Vector3<f64>, e2: &Vector3<f64>, e3: &Vector3<f64>) -> UnitQuaternion<f64> {
    let matrix = Matrix3::from_columns(&[*e1, *e2, *e3]);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn log_undoes_exp_up_to_half_a_turn() {
        for angle in [0.0, 1e-12, 1e-6, 9e-4, 1.1e-3, 0.5, 3.0, 3.1] {
            let v = Vector3::new(0.36, -0.48, 0.8) * angle;
            assert!((log(&exp(&v)) - v).norm() < 1e-13, "angle {angle}");
        }
    }

    #[test]
    fn left_jacobian_is_the_derivative_of_exp() {
        let d = Vector3::new(0.3, 0.9, -0.2);
        for angle in [0.0, 5e-3, 0.3, 2.5] {
            let v = Vector3::new(0.36, -0.48, 0.8) * angle;
            let h = 1e-5;
            let central = (log(&(exp(&(v + d * h)) * exp(&v).inverse()))
                - log(&(exp(&(v - d * h)) * exp(&v).inverse())))
                / (2.0 * h);
            assert!((left_jacobian(&v) * d - central).norm() < 1e-9, "angle {angle}");
            let identity = left_jacobian(&v) * left_jacobian_inverse(&v);
            assert!((identity - Matrix3::identity()).norm() < 1e-12, "angle {angle}");
        }
    }
}
