//! A uniform planar beam carried along by its Taylor series.
//!
//! ```text
//! x' = (1+ε) cos θ   y' = (1+ε) sin θ   θ' = κ + M/EI   M' = y' Fx - x' Fy   F' = -q   ε = (Fx cos θ + Fy sin θ)/EA
//! ```
//!
//! F and M act by the part beyond s on the part before. (Series: Corliss and Chang, *ACM Trans. Math. Softw.* 8 (1982) 114.)

const ORDER: usize = 18;

/// What the beam is like, the same everywhere.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// EI.
    pub bending: f64,
    /// 1/EA; zero for a beam that does not stretch.
    pub stretch: f64,
    /// Rest curvature κ.
    pub curvature: f64,
    /// Dead load q per undeformed length.
    pub load: [f64; 2],
}

/// x, y, θ, M, Fx, Fy at one place.
pub type Station = [f64; 6];

impl Section {
    /// A straight beam that does not stretch, of EI = 1, without load.
    pub fn unit() -> Self {
        Self { bending: 1.0, stretch: 0.0, curvature: 0.0, load: [0.0; 2] }
    }

    /// The station `length` further on, in `steps` equal steps of order 18.
    pub fn carry(&self, from: Station, length: f64, steps: usize) -> Station {
        let h = length / steps as f64;
        (0..steps).fold(from, |station, _| self.step(station, h))
    }

    fn step(&self, at: Station, h: f64) -> Station {
        let [fx, fy] = [at[4], at[5]];
        let [qx, qy] = self.load;
        let mut series = [[0.0; ORDER + 1]; 4];
        let (mut c, mut s) = ([0.0; ORDER + 1], [0.0; ORDER + 1]);
        let mut length = [0.0; ORDER + 1];
        let mut slope = [0.0; ORDER + 1];
        let (mut dx, mut dy) = ([0.0; ORDER + 1], [0.0; ORDER + 1]);
        for i in 0..4 {
            series[i][0] = at[i];
        }
        (s[0], c[0]) = at[2].sin_cos();
        for k in 0..ORDER {
            let n = (k + 1) as f64;
            // The force has two terms, F - q h.
            let before = |terms: &[f64]| if k == 0 { 0.0 } else { terms[k - 1] };
            let tension = fx * c[k] + fy * s[k] - qx * before(&c) - qy * before(&s);
            length[k] = self.stretch * tension + if k == 0 { 1.0 } else { 0.0 };
            slope[k] = series[3][k] / self.bending + if k == 0 { self.curvature } else { 0.0 };
            let product = |a: &[f64], b: &[f64]| -> f64 {
                a[..=k].iter().zip(b[..=k].iter().rev()).map(|(a, b)| a * b).sum()
            };
            if self.stretch == 0.0 {
                (dx[k], dy[k]) = (c[k], s[k]);
            } else {
                (dx[k], dy[k]) = (product(&length, &c), product(&length, &s));
            }
            series[0][k + 1] = dx[k] / n;
            series[1][k + 1] = dy[k] / n;
            series[2][k + 1] = slope[k] / n;
            series[3][k + 1] = (dy[k] * fx - dx[k] * fy - before(&dy) * qx + before(&dx) * qy) / n;
            c[k + 1] = -product(&s, &slope) / n;
            s[k + 1] = product(&c, &slope) / n;
        }
        let sum = |terms: &[f64]| terms.iter().rev().fold(0.0, |sum, term| sum * h + term);
        [sum(&series[0]), sum(&series[1]), sum(&series[2]), sum(&series[3]), fx - qx * h, fy - qy * h]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{assert_close, assert_close_all};

    #[test]
    fn extrapolation_goes_the_same_way() {
        let section = Section { bending: 1.3, stretch: 0.02, curvature: 0.7, load: [0.4, -2.0] };
        let start = [0.1, -0.2, 0.5, 1.5, -3.0, 2.0];
        let rates = |_: f64, y: &[f64; 6]| {
            let (s, c) = y[2].sin_cos();
            let length = 1.0 + 0.02 * (y[4] * c + y[5] * s);
            let (dx, dy) = (length * c, length * s);
            [dx, dy, 0.7 + y[3] / 1.3, dy * y[4] - dx * y[5], -0.4, 2.0]
        };
        let path = crate::ivp::integrate(rates, start, 0.0, 2.0, 64);
        let found = section.carry(start, 2.0, 24);
        assert_close_all(&found, &path[64].1, 1e-13, "station");
        let there_and_back = section.carry(found, -2.0, 24);
        assert_close_all(&there_and_back, &start, 1e-13, "there and back");
    }

    #[test]
    fn a_small_weight_bends_a_cantilever_as_small_deflection_theory_says() {
        let q = 1e-6;
        let section = Section { load: [0.0, -q], ..Section::unit() };
        // At the clamp M = -q L²/2 and F = -q L.
        let tip = section.carry([0.0, 0.0, 0.0, -0.5 * q, 0.0, -q], 1.0, 4);
        assert_close(tip[1] / q, -0.125, 1e-12, "q L⁴/8EI");
        assert_close(tip[2] / q, -1.0 / 6.0, 1e-12, "q L³/6EI");
        assert_close(tip[3] / q, 0.0, 1e-12, "no moment");
    }
}
