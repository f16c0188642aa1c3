//! The rod's differential equations, one equation a commented line.
//!
//! State in the start frame of a piece: unit quaternion q of the section, axis position p, and, where there
//! are distributed loads, internal force F and moment M. Lane 0 holds values, the other lanes derivatives.
//!
//! R depends on the direction of q only (it is divided by |q|²), and q' is linear in q, so the length of q
//! neither matters nor needs correcting: its derivative lanes stay the exact derivative of the discrete map.

use super::constitutive::Law;
use crate::ode::State;

/// A vector of `W` lanes per component.
pub type Lanes<const W: usize> = [[f64; W]; 3];

/// Rows 0..4 of a state: the quaternion (w, x, y, z); rows 4..7: the position.
pub const POSE_ROWS: usize = 7;
/// A state with force (rows 7..10) and moment (rows 10..13).
pub const FULL_ROWS: usize = 13;

#[inline(always)]
pub(super) fn value<const W: usize>(a: &Lanes<W>) -> [f64; 3] {
    [a[0][0], a[1][0], a[2][0]]
}

#[inline(always)]
pub(super) fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a × b` for a plain vector `a`, lane by lane of `b`.
#[inline(always)]
pub(super) fn cross_lanes<const W: usize>(a: &[f64; 3], b: &Lanes<W>) -> Lanes<W> {
    let mut out = [[0.0; W]; 3];
    for l in 0..W {
        out[0][l] = a[1] * b[2][l] - a[2] * b[1][l];
        out[1][l] = a[2] * b[0][l] - a[0] * b[2][l];
        out[2][l] = a[0] * b[1][l] - a[1] * b[0][l];
    }
    out
}

#[inline(always)]
pub(super) fn add<const W: usize>(a: &Lanes<W>, b: &Lanes<W>) -> Lanes<W> {
    let mut out = *a;
    for i in 0..3 {
        for l in 0..W {
            out[i][l] += b[i][l];
        }
    }
    out
}

#[inline(always)]
pub(super) fn sub<const W: usize>(a: &Lanes<W>, b: &Lanes<W>) -> Lanes<W> {
    let mut out = *a;
    for i in 0..3 {
        for l in 0..W {
            out[i][l] -= b[i][l];
        }
    }
    out
}

/// A rotation matrix, rows first.
pub(super) type Matrix = [[f64; 3]; 3];

/// R(q) for a quaternion of any length.
#[inline(always)]
pub(super) fn rotation(q: &[f64; 4]) -> (Matrix, f64) {
    let [w, x, y, z] = *q;
    let two = 2.0 / (w * w + x * x + y * y + z * z);
    let (xx, yy, zz) = (two * x * x, two * y * y, two * z * z);
    let (xy, xz, yz) = (two * x * y, two * x * z, two * y * z);
    let (wx, wy, wz) = (two * w * x, two * w * y, two * w * z);
    (
        [
            [1.0 - yy - zz, xy - wz, xz + wy],
            [xy + wz, 1.0 - xx - zz, yz - wx],
            [xz - wy, yz + wx, 1.0 - xx - yy],
        ],
        two,
    )
}

#[inline(always)]
pub(super) fn apply(r: &Matrix, a: &[f64; 3]) -> [f64; 3] {
    [
        r[0][0] * a[0] + r[0][1] * a[1] + r[0][2] * a[2],
        r[1][0] * a[0] + r[1][1] * a[1] + r[1][2] * a[2],
        r[2][0] * a[0] + r[2][1] * a[1] + r[2][2] * a[2],
    ]
}

#[inline(always)]
pub(super) fn apply_transposed(r: &Matrix, a: &[f64; 3]) -> [f64; 3] {
    [
        r[0][0] * a[0] + r[1][0] * a[1] + r[2][0] * a[2],
        r[0][1] * a[0] + r[1][1] * a[1] + r[2][1] * a[2],
        r[0][2] * a[0] + r[1][2] * a[1] + r[2][2] * a[2],
    ]
}

#[inline(always)]
pub(super) fn apply_lanes<const W: usize>(r: &Matrix, a: &Lanes<W>) -> Lanes<W> {
    let mut out = [[0.0; W]; 3];
    for (row, r) in out.iter_mut().zip(r) {
        for l in 0..W {
            row[l] = r[0] * a[0][l] + r[1] * a[1][l] + r[2] * a[2][l];
        }
    }
    out
}

#[inline(always)]
pub(super) fn apply_transposed_lanes<const W: usize>(r: &Matrix, a: &Lanes<W>) -> Lanes<W> {
    let mut out = [[0.0; W]; 3];
    for (i, row) in out.iter_mut().enumerate() {
        for l in 0..W {
            row[l] = r[0][i] * a[0][l] + r[1][i] * a[1][l] + r[2][i] * a[2][l];
        }
    }
    out
}

/// The internal wrench in the section's axes, with its changes there.
pub(super) struct SectionWrench<const W: usize> {
    /// R(q).
    pub r: Matrix,
    /// δφ, the section's turning in its own axes.
    pub dphi: Lanes<W>,
    /// n = Rᵀ F and m = Rᵀ M.
    pub value: [[f64; 3]; 2],
    /// δn and δm; lane 0 is of no use.
    pub change: [Lanes<W>; 2],
}

/// The wrench (F, M) at the section of orientation `q`, turned into the section's axes.
///
/// `force` and `moment` hold values in lane 0 and derivatives beyond.
#[inline(always)]
pub(super) fn section_wrench<const W: usize>(
    q: &[[f64; W]; 4],
    force: &Lanes<W>,
    moment: &Lanes<W>,
) -> SectionWrench<W> {
    let qv = [q[0][0], q[1][0], q[2][0], q[3][0]];
    let (r, two) = rotation(&qv);
    let n = apply_transposed(&r, &value(force));
    let m = apply_transposed(&r, &value(moment));

    // δφ = 2 Im(q⁻¹ δq): the section's turning, in its own axes.
    let v = [qv[1], qv[2], qv[3]];
    let mut dphi = [[0.0; W]; 3];
    for l in 0..W {
        let (dw, dx, dy, dz) = (q[0][l], q[1][l], q[2][l], q[3][l]);
        dphi[0][l] = two * (qv[0] * dx - v[0] * dw - (v[1] * dz - v[2] * dy));
        dphi[1][l] = two * (qv[0] * dy - v[1] * dw - (v[2] * dx - v[0] * dz));
        dphi[2][l] = two * (qv[0] * dz - v[2] * dw - (v[0] * dy - v[1] * dx));
    }
    // δ(Rᵀ F) = Rᵀ δF + n × δφ, and the same for M.
    let dn = add(&apply_transposed_lanes(&r, force), &cross_lanes(&n, &dphi));
    let dm = add(&apply_transposed_lanes(&r, moment), &cross_lanes(&m, &dphi));
    SectionWrench { r, dphi, value: [n, m], change: [dn, dm] }
}

/// Rate of the pose whose strain is (ν, k) with changes (δν, δk) in lanes 1.., in the piece's start frame,
/// and the axis rate p' that the wrench balance needs.
#[inline(always)]
pub(super) fn strained_rate<const W: usize>(
    q: &[[f64; W]; 4],
    r: &Matrix,
    dphi: &Lanes<W>,
    (nu, k): &([f64; 3], [f64; 3]),
    (dnu, dk): &(Lanes<W>, Lanes<W>),
) -> (State<POSE_ROWS, W>, Lanes<W>) {
    let qv = [q[0][0], q[1][0], q[2][0], q[3][0]];
    let v = [qv[1], qv[2], qv[3]];
    let mut rate = [[0.0; W]; POSE_ROWS];
    // q' = ½ q k, and δq' = ½ (δq k + q δk), in quaternion products.
    for l in 0..W {
        let (dw, dx, dy, dz) = (q[0][l], q[1][l], q[2][l], q[3][l]);
        let (a, b, c) = (dk[0][l], dk[1][l], dk[2][l]);
        rate[0][l] = -0.5 * (dx * k[0] + dy * k[1] + dz * k[2] + v[0] * a + v[1] * b + v[2] * c);
        rate[1][l] = 0.5 * (dw * k[0] + dy * k[2] - dz * k[1] + qv[0] * a + v[1] * c - v[2] * b);
        rate[2][l] = 0.5 * (dw * k[1] + dz * k[0] - dx * k[2] + qv[0] * b + v[2] * a - v[0] * c);
        rate[3][l] = 0.5 * (dw * k[2] + dx * k[1] - dy * k[0] + qv[0] * c + v[0] * b - v[1] * a);
    }
    rate[0][0] = -0.5 * (v[0] * k[0] + v[1] * k[1] + v[2] * k[2]);
    rate[1][0] = 0.5 * (qv[0] * k[0] + v[1] * k[2] - v[2] * k[1]);
    rate[2][0] = 0.5 * (qv[0] * k[1] + v[2] * k[0] - v[0] * k[2]);
    rate[3][0] = 0.5 * (qv[0] * k[2] + v[0] * k[1] - v[1] * k[0]);

    // p' = R ν, and δp' = R (δν + δφ × ν).
    let stretch = sub(dnu, &cross_lanes(nu, dphi));
    let mut along = apply_lanes(r, &stretch);
    let axis = apply(r, nu);
    for i in 0..3 {
        along[i][0] = axis[i];
        rate[4 + i] = along[i];
    }
    (rate, along)
}

/// Rate of the pose under the internal wrench (F, M) at the section, all in the piece's start frame, and the
/// rotation and axis rate that the wrench balance needs.
///
/// `force` and `moment` hold values in lane 0 and derivatives beyond.
#[inline(always)]
pub(super) fn pose_rate<L: Law, const W: usize>(
    q: &[[f64; W]; 4],
    force: &Lanes<W>,
    moment: &Lanes<W>,
    law: &L,
) -> (State<POSE_ROWS, W>, Matrix, Lanes<W>) {
    let section = section_wrench(q, force, moment);
    let strain = law.strain(&section.value[0], &section.value[1]);
    let change = law.strain_change(&section.change[0], &section.change[1]);
    let (rate, along) = strained_rate(q, &section.r, &section.dphi, &strain, &change);
    (rate, section.r, along)
}

/// M at the section from the conserved moment: M + p × F is constant where no distributed load acts.
#[inline(always)]
pub(super) fn conserved_moment<const W: usize>(
    p: &Lanes<W>,
    force: &Lanes<W>,
    moment0: &Lanes<W>,
) -> Lanes<W> {
    let (pv, fv) = (value(p), value(force));
    // δM = δM0 - δp × F - p × δF = δM0 + F × δp - p × δF.
    let mut m = sub(&add(moment0, &cross_lanes(&fv, p)), &cross_lanes(&pv, force));
    let moved = cross(&pv, &fv);
    for i in 0..3 {
        m[i][0] = moment0[i][0] - moved[i];
    }
    m
}

/// F' = -q_F and M' = -q_M - p' × F for the distributed load `(q_F, q_M)` given partly in the start frame
/// (`dead`, its derivative lanes already filled) and partly in the section's axes (`section`).
#[inline(always)]
pub(super) fn wrench_rate<const W: usize>(
    rate: &State<POSE_ROWS, W>,
    q: &[[f64; W]; 4],
    r: &Matrix,
    along: &Lanes<W>,
    force: &Lanes<W>,
    dead: &[Lanes<W>; 2],
    section: &[[f64; 3]; 2],
) -> State<FULL_ROWS, W> {
    let mut out = [[0.0; W]; FULL_ROWS];
    out[..POSE_ROWS].copy_from_slice(rate);
    let qv = [q[0][0], q[1][0], q[2][0], q[3][0]];
    let two = 2.0 / (qv[0] * qv[0] + qv[1] * qv[1] + qv[2] * qv[2] + qv[3] * qv[3]);
    // δθ = 2 Im(δq q⁻¹): the section's turning in the start frame, for loads that follow it.
    let mut dtheta = [[0.0; W]; 3];
    for l in 0..W {
        let (dw, dx, dy, dz) = (q[0][l], q[1][l], q[2][l], q[3][l]);
        dtheta[0][l] = two * (qv[0] * dx - qv[1] * dw - (dy * qv[3] - dz * qv[2]));
        dtheta[1][l] = two * (qv[0] * dy - qv[2] * dw - (dz * qv[1] - dx * qv[3]));
        dtheta[2][l] = two * (qv[0] * dz - qv[3] * dw - (dx * qv[2] - dy * qv[1]));
    }
    for (part, base) in [(0, POSE_ROWS), (1, POSE_ROWS + 3)] {
        let follower = apply(r, &section[part]);
        // δ(R q) = δθ × R q.
        let turned = cross_lanes(&follower, &dtheta);
        for i in 0..3 {
            for l in 1..W {
                out[base + i][l] = turned[i][l] - dead[part][i][l];
            }
            out[base + i][0] = -follower[i] - dead[part][i][0];
        }
    }
    let (fv, av) = (value(force), value(along));
    // -p' × F, and its change -δp' × F - p' × δF = F × δp' - p' × δF.
    let arm = sub(&cross_lanes(&fv, along), &cross_lanes(&av, force));
    let moved = cross(&av, &fv);
    for i in 0..3 {
        for l in 1..W {
            out[POSE_ROWS + 3 + i][l] += arm[i][l];
        }
        out[POSE_ROWS + 3 + i][0] -= moved[i];
    }
    out
}
