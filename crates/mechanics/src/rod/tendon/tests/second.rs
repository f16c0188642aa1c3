//! The same rod with tendons, written a second time: global axes throughout, dual numbers, lengths and
//! elastic energy as components of the state, Newton's method on the strain.

use crate::rod::propagate::tests::dual::ROWS;
use num_dual::{Dual64, DualNum};

type D = Dual64;

/// Force and moment of a dead load per length.
pub const LOAD: [[f64; 3]; 2] = [[0.1, -0.6, 0.4], [0.2, 0.1, -0.3]];

/// A rod of one law with two tendons.
pub struct Second {
    pub compliance: [[f64; 6]; 6],
    pub k0: [f64; 3],
    pub length: f64,
    pub steps: usize,
    pub load: f64,
    /// Offset (y, z) and slope of each tendon at s.
    pub channels: fn(f64) -> [[f64; 4]; 2],
}

/// q, p, F, M, both lengths, elastic energy.
pub type Full = [D; 16];

fn cross(a: &[D; 3], b: &[D; 3]) -> [D; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// v turned by q, or back where `sign` is -1.
fn turned(q: &[D], v: &[D; 3], sign: f64) -> [D; 3] {
    let norm2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    let im = [q[1] * sign, q[2] * sign, q[3] * sign];
    let t = cross(&im, v);
    let tt = cross(&im, &t);
    std::array::from_fn(|i| v[i] + (q[0] * t[i] + tt[i]) * 2.0 / norm2)
}

impl Second {
    /// (u, d × u, |w|) and Gᵀ (1 - u uᵀ) G/|w| of the tendon at `c`.
    fn tendon(&self, c: &[f64; 4], e: &[D; 6]) -> ([D; 6], D, [[D; 6]; 6]) {
        let [y, z, dy, dz] = *c;
        let w = [e[0] + e[4] * z - e[5] * y, e[1] - e[3] * z + dy, e[2] + e[3] * y + dz];
        let size = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        let u = w.map(|x| x / size);
        // The columns of G.
        let g: [[f64; 3]; 6] =
            [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0., -z, y], [z, 0., 0.], [-y, 0., 0.]];
        let pull: [D; 6] = std::array::from_fn(|i| u[0] * g[i][0] + u[1] * g[i][1] + u[2] * g[i][2]);
        let h = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let dot: f64 = (0..3).map(|l| g[i][l] * g[j][l]).sum();
                (-(pull[i] * pull[j]) + dot) / size
            })
        });
        (pull, size, h)
    }

    /// The strain, the rod's own wrench and both |w|.
    fn strain(&self, s: f64, total: &[D; 6], t: &[D; 2]) -> ([D; 6], [D; 6], [D; 2]) {
        let places = (self.channels)(s);
        let rest = [1.0, 0.0, 0.0, self.k0[0], self.k0[1], self.k0[2]];
        let mut e = rest.map(D::from);
        for round in 0..14 {
            let found: Vec<_> = places.iter().map(|c| self.tendon(c, &e)).collect();
            let own: [D; 6] = std::array::from_fn(|i| total[i] - found[0].0[i] * t[0] - found[1].0[i] * t[1]);
            let soft =
                |a: &[D; 6], i: usize| (0..6).fold(D::from(0.0), |sum, j| sum + a[j] * self.compliance[i][j]);
            if round == 13 {
                return (e, own, [found[0].1, found[1].1]);
            }
            let mut a = [[D::from(0.0); 7]; 6];
            for i in 0..6 {
                for j in 0..6 {
                    let column: [D; 6] =
                        std::array::from_fn(|l| found[0].2[l][j] * t[0] + found[1].2[l][j] * t[1]);
                    a[i][j] = soft(&column, i) + if i == j { 1.0 } else { 0.0 };
                }
                a[i][6] = soft(&own, i) + rest[i] - e[i];
            }
            for i in 0..6 {
                let pivot = a[i];
                for r in (0..6).filter(|r| *r != i) {
                    let factor = a[r][i] / pivot[i];
                    for l in 0..7 {
                        a[r][l] -= factor * pivot[l];
                    }
                }
            }
            for i in 0..6 {
                e[i] += a[i][6] / a[i][i];
            }
        }
        unreachable!()
    }

    fn rate(&self, s: f64, y: &Full, tensions: &[D; 2]) -> Full {
        let (force, moment) = ([y[7], y[8], y[9]], [y[10], y[11], y[12]]);
        let (n, m) = (turned(&y[..4], &force, -1.0), turned(&y[..4], &moment, -1.0));
        let total = [n[0], n[1], n[2], m[0], m[1], m[2]];
        let (e, own, advance) = self.strain(s, &total, tensions);
        let k = [e[3], e[4], e[5]];
        let (w, v) = (y[0], [y[1], y[2], y[3]]);
        let vk = cross(&v, &k);
        let along = turned(&y[..4], &[e[0], e[1], e[2]], 1.0);
        let arm = cross(&along, &force);
        let mut out = [D::from(0.0); 16];
        out[0] = (v[0] * k[0] + v[1] * k[1] + v[2] * k[2]) * -0.5;
        for i in 0..3 {
            out[1 + i] = (w * k[i] + vk[i]) * 0.5;
            out[4 + i] = along[i];
            out[7 + i] = D::from(-self.load * LOAD[0][i]);
            out[10 + i] = -arm[i] - self.load * LOAD[1][i];
        }
        out[13] = advance[0];
        out[14] = advance[1];
        let rest = [1.0, 0.0, 0.0, self.k0[0], self.k0[1], self.k0[2]];
        out[15] = (0..6).fold(D::from(0.0), |sum, i| sum + own[i] * (e[i] - rest[i]) * 0.5);
        out
    }

    /// The state at the end.
    pub fn propagate(&self, start: Full, tensions: &[D; 2]) -> Full {
        let h = self.length / self.steps as f64;
        let mut y = start;
        for step in 0..self.steps {
            let mut rates: Vec<Full> = Vec::new();
            let mut at = y;
            for (stage, row) in ROWS.iter().enumerate() {
                let s = (step as f64 + crate::ode::NODES[stage]) * h;
                rates.push(self.rate(s, &at, tensions));
                at = std::array::from_fn(|i| {
                    row.iter().fold(y[i], |sum, (j, c)| sum + rates[*j][i] * (c * h))
                });
            }
            y = at;
        }
        y
    }
}
