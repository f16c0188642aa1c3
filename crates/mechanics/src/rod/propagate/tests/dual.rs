//! The derivative lanes against dual numbers carried through the same discrete map, written a second time.

use super::{laws, piece, start};
use crate::ode::STAGES;
use crate::rod::{LawTable, RodState, advance};
use num_dual::{Dual64, DualNum};

type D = Dual64;

/// Rows of the order-eight tableau, one for each stage and one for the result; zeros left out.
pub(crate) const ROWS: [&[(usize, f64)]; STAGES] = [
    &[(0, 0.05260015195876773)],
    &[(0, 0.0197250569845379), (1, 0.0591751709536137)],
    &[(0, 0.02958758547680685), (2, 0.08876275643042054)],
    &[(0, 0.2413651341592667), (2, -0.8845494793282861), (3, 0.924834003261792)],
    &[(0, 0.037037037037037035), (3, 0.17082860872947386), (4, 0.12546768756682242)],
    &[(0, 0.037109375), (3, 0.17025221101954405), (4, 0.06021653898045596), (5, -0.017578125)],
    &[
        (0, 0.03709200011850479),
        (3, 0.17038392571223998),
        (4, 0.10726203044637328),
        (5, -0.015319437748624402),
        (6, 0.008273789163814023),
    ],
    &[
        (0, 0.6241109587160757),
        (3, -3.3608926294469414),
        (4, -0.868219346841726),
        (5, 27.59209969944671),
        (6, 20.154067550477894),
        (7, -43.48988418106996),
    ],
    &[
        (0, 0.47766253643826434),
        (3, -2.4881146199716677),
        (4, -0.590290826836843),
        (5, 21.230051448181193),
        (6, 15.279233632882423),
        (7, -33.28821096898486),
        (8, -0.020331201708508627),
    ],
    &[
        (0, -0.9371424300859873),
        (3, 5.186372428844064),
        (4, 1.0914373489967295),
        (5, -8.149787010746927),
        (6, -18.52006565999696),
        (7, 22.739487099350505),
        (8, 2.4936055526796523),
        (9, -3.0467644718982196),
    ],
    &[
        (0, 2.273310147516538),
        (3, -10.53449546673725),
        (4, -2.0008720582248625),
        (5, -17.9589318631188),
        (6, 27.94888452941996),
        (7, -2.8589982771350235),
        (8, -8.87285693353063),
        (9, 12.360567175794303),
        (10, 0.6433927460157636),
    ],
    &[
        (0, 0.054293734116568765),
        (5, 4.450312892752409),
        (6, 1.8915178993145003),
        (7, -5.801203960010585),
        (8, 0.3111643669578199),
        (9, -0.1521609496625161),
        (10, 0.20136540080403034),
        (11, 0.04471061572777259),
    ],
];

pub(crate) fn cross(a: &[D; 3], b: &[D; 3]) -> [D; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn matrix(q: &[D; 4]) -> [[D; 3]; 3] {
    let [w, x, y, z] = *q;
    let n = w * w + x * x + y * y + z * z;
    let entry = |a: D| a / n;
    [
        [entry(w * w + x * x - y * y - z * z), entry((x * y - w * z) * 2.0), entry((x * z + w * y) * 2.0)],
        [entry((x * y + w * z) * 2.0), entry(w * w - x * x + y * y - z * z), entry((y * z - w * x) * 2.0)],
        [entry((x * z - w * y) * 2.0), entry((y * z + w * x) * 2.0), entry(w * w - x * x - y * y + z * z)],
    ]
}

pub(crate) fn times(r: &[[D; 3]; 3], a: &[D; 3]) -> [D; 3] {
    std::array::from_fn(|i| r[i][0] * a[0] + r[i][1] * a[1] + r[i][2] * a[2])
}

pub(crate) fn transposed(r: &[[D; 3]; 3]) -> [[D; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| r[j][i]))
}

/// (compliance 6 x 6, rest curvature) of a uniform law.
fn law(table: &LawTable) -> ([[f64; 6]; 6], [f64; 3]) {
    let diagonal =
        |d: [f64; 6]| std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }));
    match table {
        LawTable::Slender(l) => {
            let b = l[0].bend;
            (diagonal([l[0].stretch, 0.0, 0.0, b[0], b[1], b[2]]), l[0].k0)
        }
        LawTable::Shearable(l) => {
            let (s, b) = (l[0].shear, l[0].bend);
            (diagonal([s[0], s[1], s[2], b[0], b[1], b[2]]), l[0].k0)
        }
        LawTable::Coupled(l) => (l[0].compliance, l[0].k0),
    }
}

/// q, p, F, M in global axes throughout, unlike the kernel, which works in the start frame and conserves the
/// wrench: the two discrete maps agree to their truncation error, which the step count makes negligible.
fn propagate(start: [D; 13], table: &LawTable, length: f64, steps: usize, loaded: bool) -> [D; 13] {
    let (compliance, k0) = law(table);
    let sample = piece(table.clone(), true).loads[0];
    let factor = if loaded { 0.8 } else { 0.0 };
    let rate = |y: &[D; 13]| -> [D; 13] {
        let r = matrix(&[y[0], y[1], y[2], y[3]]);
        let back = transposed(&r);
        let (force, moment) = ([y[7], y[8], y[9]], [y[10], y[11], y[12]]);
        let (n, m) = (times(&back, &force), times(&back, &moment));
        let load = [n[0], n[1], n[2], m[0], m[1], m[2]];
        let strain: [D; 6] =
            std::array::from_fn(|i| (0..6).fold(D::from(0.0), |sum, j| sum + load[j] * compliance[i][j]));
        let nu = [strain[0] + 1.0, strain[1], strain[2]];
        let k: [D; 3] = std::array::from_fn(|i| strain[3 + i] + k0[i]);
        let (w, v) = (y[0], [y[1], y[2], y[3]]);
        let vk = cross(&v, &k);
        let along = times(&r, &nu);
        let follower = |a: &[f64; 3]| times(&r, &a.map(D::from));
        let (qf, qm) = (follower(&sample.section_force), follower(&sample.section_moment));
        let arm = cross(&along, &force);
        let mut out = [D::from(0.0); 13];
        out[0] = (v[0] * k[0] + v[1] * k[1] + v[2] * k[2]) * -0.5;
        for i in 0..3 {
            out[1 + i] = (w * k[i] + vk[i]) * 0.5;
            out[4 + i] = along[i];
            out[7 + i] = (qf[i] + sample.dead_force[i]) * -factor;
            out[10 + i] = (qm[i] + sample.dead_moment[i]) * -factor - arm[i];
        }
        out
    };
    let h = length / steps as f64;
    let mut y = start;
    for _ in 0..steps {
        let mut rates: Vec<[D; 13]> = Vec::new();
        let mut at = y;
        for row in ROWS {
            rates.push(rate(&at));
            at = std::array::from_fn(|i| row.iter().fold(y[i], |sum, (j, c)| sum + rates[*j][i] * (c * h)));
        }
        y = at;
    }
    y
}

#[test]
fn derivative_lanes_agree_with_dual_numbers() {
    const STEPS: usize = 24;
    for table in laws() {
        for loaded in [false, true] {
            let mut lanes: RodState<16> = start();
            for i in 0..12 {
                lanes.d[i][1 + i] = 1.0;
            }
            let mut fine = piece(table.clone(), loaded);
            fine.steps = STEPS;
            advance(&fine, 0.8, &mut lanes);
            let base: RodState<1> = start();
            for column in 0..12 {
                let mut y = [D::from(0.0); 13];
                let e = |i: usize| if i == column { 1.0 } else { 0.0 };
                // A small global turning δ moves the quaternion by ½ (0, δ) q.
                let q = base.rotation;
                let turn = [e(0), e(1), e(2)];
                let dq = [
                    -0.5 * (turn[0] * q[1] + turn[1] * q[2] + turn[2] * q[3]),
                    0.5 * (turn[0] * q[0] + turn[1] * q[3] - turn[2] * q[2]),
                    0.5 * (turn[1] * q[0] + turn[2] * q[1] - turn[0] * q[3]),
                    0.5 * (turn[2] * q[0] + turn[0] * q[2] - turn[1] * q[1]),
                ];
                for i in 0..4 {
                    y[i] = D::new(q[i], dq[i]);
                }
                for i in 0..3 {
                    y[4 + i] = D::new(base.position[i], e(3 + i));
                    y[7 + i] = D::new(base.force[i], e(6 + i));
                    y[10 + i] = D::new(base.moment[i], e(9 + i));
                }
                let end = propagate(y, &table, fine.length, STEPS, loaded);
                // δθ = 2 Im(δq q⁻¹).
                let (q, d): ([f64; 4], [f64; 4]) =
                    (std::array::from_fn(|i| end[i].re), std::array::from_fn(|i| end[i].eps));
                let two = 2.0 / q.iter().map(|v| v * v).sum::<f64>();
                let theta = [
                    two * (q[0] * d[1] - q[1] * d[0] - (d[2] * q[3] - d[3] * q[2])),
                    two * (q[0] * d[2] - q[2] * d[0] - (d[3] * q[1] - d[1] * q[3])),
                    two * (q[0] * d[3] - q[3] * d[0] - (d[1] * q[2] - d[2] * q[1])),
                ];
                for row in 0..12 {
                    let expected = if row < 3 { theta[row] } else { end[1 + row].eps };
                    let got = lanes.d[row][1 + column];
                    assert!(
                        (got - expected).abs() < 1e-10,
                        "{table:?} loaded {loaded}: row {row} column {column}: {got} against {expected}"
                    );
                }
            }
            assert!((lanes.position[0] - base.position[0]).abs() > 0.01, "the piece must lead somewhere");
        }
    }
}

#[test]
fn dual_numbers_differentiate() {
    assert!((D::new(2.0, 1.0).powi(3).eps - 12.0).abs() < 1e-14);
}
