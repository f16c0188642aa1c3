//! The equations that decide how branches leave a point at which several directions become critical at once.
//!
//! What is left of r(x, p) = 0 where the tangent loses k ranks are k equations g(ξ, λ) = 0 for the k amplitudes ξ of its kernel and the
//! change λ of the parameter (Lyapunov and Schmidt). Near the point they are
//!
//! ```text
//!   g = λ a + λ² e + λ A ξ + Q(ξ, ξ) + C(ξ, ξ, ξ)
//! ```
//!
//! of which differences of g give every coefficient. Branches are its zeros on a small sphere |ξ| = ε: Q decides where there is no symmetry,
//! C where there is one (M. Golubitsky, I. Stewart and D. G. Schaeffer, *Singularities and Groups in Bifurcation Theory* II, 1988, ch. XIII).

use crate::multiple::inverse;

/// g in units in which the sphere and the differences have length one.
#[derive(Clone, Debug)]
pub(crate) struct Algebraic {
    /// a and e.
    along: [Vec<f64>; 2],
    /// Columns of A.
    mixed: Vec<Vec<f64>>,
    /// Products of two or three amplitudes, each with its coefficients.
    products: Vec<(Vec<usize>, Vec<f64>)>,
}

/// Half of a branch: the direction of its amplitudes, of length one, and the change of the parameter.
#[derive(Clone, Debug)]
pub(crate) struct Half {
    pub amplitudes: Vec<f64>,
    pub parameter: f64,
}

/// Change of the parameter at which products are measured.
const BESIDE: f64 = 0.02;
/// Newton steps from one start, and the longest in the amplitudes.
const STEPS: usize = 40;
const LONGEST: f64 = 0.3;
/// What is left of the equations beside their terms at a zero. Differences are not better; where directions form a family, no other Newton
/// step is to choose among them.
const LEFT: f64 = 3e-4;
/// Largest change of the parameter, in the length of its differences, of which they still tell.
const FARTHEST: f64 = 300.0;
/// Cosine of the angle between directions that are one.
const SAME: f64 = 0.98;
/// Starts on the circle of two amplitudes, and for each amplitude of more.
const AROUND: usize = 32;
const EACH: usize = 100;

impl Algebraic {
    /// From the values of g, all on the scale of the differences. None where one of them cannot be had.
    pub fn by_differences(
        count: usize,
        mut value: impl FnMut(&[f64], f64) -> Option<Vec<f64>>,
    ) -> Option<Self> {
        let unit = |which: &[(usize, f64)]| -> Vec<f64> {
            let mut at = vec![0.0; count];
            which.iter().for_each(|(i, sign)| at[*i] = *sign);
            at
        };
        // Even and odd parts of g in what changes sign from `up` to `down`.
        let parts = |up: Vec<f64>, down: Vec<f64>| -> [Vec<f64>; 2] {
            [1.0, -1.0].map(|sign| up.iter().zip(&down).map(|(u, d)| 0.5 * (u + sign * d)).collect())
        };
        let none = vec![0.0; count];
        let [bent, along] = parts(value(&none, 1.0)?, value(&none, -1.0)?);
        let mut found = Self { along: [along, bent], mixed: Vec::new(), products: Vec::new() };
        for i in 0..count {
            let mut sides = Vec::new();
            for sign in [1.0, -1.0] {
                let at = unit(&[(i, sign)]);
                let [_, odd] = parts(value(&at, 1.0)?, value(&at, -1.0)?);
                sides.push(odd);
            }
            let [_, column] = parts(sides.swap_remove(0), sides.swap_remove(0));
            found.mixed.push(column);
        }
        // Where amplitudes do not see each other the tangent stays critical unless the parameter moves as well.
        let mut value = |at: &[f64]| -> Option<Vec<f64>> {
            let moved: Vec<f64> = found
                .driven(at)
                .iter()
                .zip(&found.along[1])
                .map(|(d, e)| BESIDE * (d + BESIDE * e))
                .collect();
            Some(less(value(at, BESIDE)?, &moved))
        };
        let mut products: Vec<(Vec<usize>, Vec<f64>)> = Vec::new();
        for i in 0..count {
            let [even, odd] = parts(value(&unit(&[(i, 1.0)]))?, value(&unit(&[(i, -1.0)]))?);
            products.push((vec![i, i], even));
            products.push((vec![i, i, i], odd));
        }
        for i in 0..count {
            for j in 0..i {
                // Of (1, 1) and (1, -1) only what both amplitudes do together is left.
                let mut left = Vec::new();
                for sign in [1.0, -1.0] {
                    let (at, back) = (unit(&[(i, 1.0), (j, sign)]), unit(&[(i, -1.0), (j, -sign)]));
                    let known = parts(sum(&products, &at), sum(&products, &back));
                    let [even, odd] = parts(value(&at)?, value(&back)?);
                    left.push([less(even, &known[0]), less(odd, &known[1])]);
                }
                let [up, down] = [left.swap_remove(0), left.swap_remove(0)];
                let [_, pair] = parts(up[0].clone(), down[0].clone());
                // Odd parts: x²y changes its sign with y, x y² does not.
                let [second, first] = parts(up[1].clone(), down[1].clone());
                products.push((vec![i, j], pair));
                products.push((vec![i, i, j], first));
                products.push((vec![i, j, j], second));
            }
        }
        for i in 0..count {
            for j in 0..i {
                for k in 0..j {
                    let (at, back) =
                        (unit(&[(i, 1.0), (j, 1.0), (k, 1.0)]), unit(&[(i, -1.0), (j, -1.0), (k, -1.0)]));
                    let [_, known] = parts(sum(&products, &at), sum(&products, &back));
                    let [_, odd] = parts(value(&at)?, value(&back)?);
                    products.push((vec![i, j, k], less(odd, &known)));
                }
            }
        }
        found.products = products;
        Some(found)
    }

    /// The derivative of g by the amplitudes, one column each.
    fn derivatives(&self, at: &[f64], parameter: f64) -> Vec<Vec<f64>> {
        let mut columns: Vec<Vec<f64>> =
            self.mixed.iter().map(|column| column.iter().map(|c| parameter * c).collect()).collect();
        for (which, coefficients) in &self.products {
            for (place, &i) in which.iter().enumerate() {
                let others = which.iter().enumerate().filter(|(other, _)| *other != place);
                let product: f64 = others.map(|(_, j)| at[*j]).product();
                columns[i].iter_mut().zip(coefficients).for_each(|(s, c)| *s += product * c);
            }
        }
        columns
    }

    /// What the parameter alone multiplies, a + A ξ.
    fn driven(&self, at: &[f64]) -> Vec<f64> {
        let mut sum = self.along[0].clone();
        for (column, amplitude) in self.mixed.iter().zip(at) {
            sum.iter_mut().zip(column).for_each(|(s, c)| *s += amplitude * c);
        }
        sum
    }

    /// The zeros on the sphere, by Newton's method from many starts; more of them than `most` are a family and none is complete.
    pub fn halves(&self, most: usize) -> Vec<Half> {
        let mut found: Vec<Half> = Vec::new();
        for start in starts(self.mixed.len()) {
            if let Some(half) = self.zero(start) {
                let same = |other: &Half| dot(&other.amplitudes, &half.amplitudes) > SAME;
                if !found.iter().any(same) {
                    found.push(half);
                }
            }
            if found.len() > most {
                break;
            }
        }
        found
    }

    fn zero(&self, mut at: Vec<f64>) -> Option<Half> {
        let k = at.len();
        let (alone, driven) = (sum(&self.products, &at), self.driven(&at));
        let mut parameter = -dot(&alone, &driven) / dot(&driven, &driven);
        if !parameter.is_finite() {
            return None;
        }
        for _ in 0..STEPS {
            let (alone, driven) = (sum(&self.products, &at), self.driven(&at));
            let terms = size(&alone) + parameter.abs() * size(&driven);
            let value: Vec<f64> = (0..k)
                .map(|i| alone[i] + parameter * driven[i] + parameter * parameter * self.along[1][i])
                .collect();
            if size(&value) <= LEFT * terms && (dot(&at, &at) - 1.0).abs() <= LEFT {
                return (parameter.abs() <= FARTHEST).then_some(Half { amplitudes: at, parameter });
            }
            // Equations: g, and the sphere.
            let mut columns = self.derivatives(&at, parameter);
            columns.iter_mut().zip(&at).for_each(|(column, z)| column.push(2.0 * z));
            let mut last: Vec<f64> = (0..k).map(|i| driven[i] + 2.0 * parameter * self.along[1][i]).collect();
            last.push(0.0);
            columns.push(last);
            let mut right = value;
            right.push(dot(&at, &at) - 1.0);
            let inverse = inverse(columns)?;
            let step: Vec<f64> = inverse.chunks(k + 1).map(|row| -dot(row, &right)).collect();
            let longest = step[..k].iter().fold(0.0_f64, |m, s| m.max(s.abs()));
            let part = (LONGEST / longest).min(1.0);
            at.iter_mut().zip(&step).for_each(|(z, s)| *z += part * s);
            parameter += part * step[k];
            if !parameter.is_finite() {
                return None;
            }
        }
        None
    }
}

/// g of the amplitudes alone, by the products known so far.
fn sum(products: &[(Vec<usize>, Vec<f64>)], at: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; at.len()];
    for (which, coefficients) in products {
        let product: f64 = which.iter().map(|i| at[*i]).product();
        sum.iter_mut().zip(coefficients).for_each(|(s, c)| *s += product * c);
    }
    sum
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn size(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn less(mut a: Vec<f64>, b: &[f64]) -> Vec<f64> {
    a.iter_mut().zip(b).for_each(|(a, b)| *a -= b);
    a
}

/// Directions all over the sphere: even ones on a circle, else those along and between the axes and some that are neither.
fn starts(count: usize) -> Vec<Vec<f64>> {
    if count == 2 {
        let angle = |i: usize| std::f64::consts::TAU * (i as f64 + 0.25) / (AROUND as f64);
        return (0..AROUND).map(|i| vec![angle(i).cos(), angle(i).sin()]).collect();
    }
    let mut all: Vec<Vec<f64>> = vec![Vec::new()];
    for _ in 0..count {
        let longer = |start: &Vec<f64>| [0.0, 1.0, -1.0].map(|w| start.iter().copied().chain([w]).collect());
        all = all.iter().flat_map(longer).collect();
    }
    // Fractional parts of multiples of roots fill the cube evenly.
    let root = |j: usize| (2.0 + j as f64 + 0.5 * (j * j) as f64).sqrt();
    all.extend(
        (1..=EACH * count).map(|i| (0..count).map(|j| 2.0 * (i as f64 * root(j)).fract() - 1.0).collect()),
    );
    all.retain(|start| size(start) > 0.1);
    for start in &mut all {
        let length = size(start);
        start.iter_mut().for_each(|v| *v /= length);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(halves: &[Half]) -> Vec<i32> {
        let angle = |half: &Half| half.amplitudes[1].atan2(half.amplitudes[0]).to_degrees().round() as i32;
        let mut angles: Vec<i32> = halves.iter().map(angle).collect();
        angles.sort_unstable();
        angles
    }

    /// Two pitchforks apart from each other: each alone, and both together in two ways.
    #[test]
    fn two_that_do_not_see_each_other_lean_in_eight_ways() {
        let g = |z: &[f64], s: f64| {
            Some(vec![s * z[0] - 2.0 * z[0].powi(3), 0.5 * s * z[1] - z[1].powi(3) + 1e-3 * s * s * z[1]])
        };
        let found = Algebraic::by_differences(2, g).unwrap().halves(10);
        assert_eq!(degrees(&found), [-135, -90, -45, 0, 45, 90, 135, 180]);
        assert!(found.iter().all(|half| half.parameter > 0.5), "{found:?}");
    }

    /// Folds of two halves at once: the path, on which both turn back together, and the one on which they do so in turn.
    #[test]
    fn two_folds_at_once_cross() {
        let g = |z: &[f64], s: f64| Some(vec![s - z[0] * z[0], s - z[1] * z[1]]);
        let found = Algebraic::by_differences(2, g).unwrap().halves(10);
        assert_eq!(degrees(&found), [-135, -45, 45, 135]);
    }

    /// Without symmetry the squares decide: λ x + x y = 0, λ y + x² - y² / 2 = 0 has the lines y = -λ with x² = 3/2 λ², and x = 0 with
    /// y = 2 λ.
    #[test]
    fn squares_decide_where_nothing_is_symmetric() {
        let g = |z: &[f64], s: f64| {
            Some(vec![s * z[0] + z[0] * z[1], s * z[1] + z[0] * z[0] - 0.5 * z[1] * z[1]])
        };
        let found = Algebraic::by_differences(2, g).unwrap().halves(10);
        let leaning = 1.0_f64.atan2(1.5_f64.sqrt()).to_degrees().round() as i32;
        assert_eq!(degrees(&found), [leaning - 180, -90, -leaning, leaning, 90, 180 - leaning]);
    }

    #[test]
    fn what_is_round_gives_a_family() {
        let g = |z: &[f64], s: f64| {
            let square = z[0] * z[0] + z[1] * z[1];
            Some(vec![z[0] * (s - square), z[1] * (s - square)])
        };
        assert!(Algebraic::by_differences(2, g).unwrap().halves(10).len() > 10);
    }

    /// Three pitchforks that see each other through x y z as well.
    #[test]
    fn three_lean_in_all_their_ways() {
        let g = |z: &[f64], s: f64| {
            let b = 0.05;
            Some(vec![
                s * z[0] - z[0].powi(3) + b * z[1] * z[2] * z[0],
                s * z[1] - z[1].powi(3) + b * z[1] * z[2] * z[0],
                s * z[2] - z[2].powi(3) - b * z[1] * z[2] * z[0],
            ])
        };
        let found = Algebraic::by_differences(3, g).unwrap().halves(28);
        assert_eq!(found.len(), 26, "{found:?}");
        for half in &found {
            let left = g(&half.amplitudes, half.parameter).unwrap();
            assert!(left.iter().all(|v| v.abs() < 1e-3), "{half:?} {left:?}");
        }
    }
}
