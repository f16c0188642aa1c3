//! Points of an element of order p: p + 1 Gauss-Lobatto nodes, at which motions are unknown and inertia is summed up, and p Gauss
//! points, at which strains are taken.
//!
//! Both are roots of Legendre polynomials on [-1, 1]: of P_p for Gauss, of (1 - x²) P_p' for Lobatto (M. Abramowitz and I. A. Stegun,
//! *Handbook of Mathematical Functions*, 1964, 25.4.29 and 25.4.32).

use std::f64::consts::PI;

/// The points of one order, with what interpolates between them.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub order: usize,
    /// Gauss-Lobatto nodes and weights.
    pub nodes: Vec<f64>,
    pub node_weights: Vec<f64>,
    /// Gauss points and weights.
    pub points: Vec<f64>,
    pub point_weights: Vec<f64>,
    /// For each Gauss point the values of all nodes' polynomials, and their slopes.
    pub values: Vec<Vec<f64>>,
    pub slopes: Vec<Vec<f64>>,
    /// 1/∏(x_j - x_k) of each node.
    barycentric: Vec<f64>,
    /// Coefficients in the Legendre series of what has values at the nodes, as weights of these: of the last four degrees.
    pub tail: Vec<(usize, Vec<f64>)>,
}

/// P_n and P_n' at x.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value, mut slope_before, mut slope) = (1.0, x, 0.0, 1.0);
    for k in 2..=n {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k;
        let next_slope = slope_before + (2.0 * k - 1.0) * value;
        (before, value, slope_before, slope) = (value, next, slope, next_slope);
    }
    if n == 0 { (1.0, 0.0) } else { (value, slope) }
}

impl Rule {
    /// `order` is at least 2.
    pub fn new(order: usize) -> Self {
        let n = order;
        let mut points = vec![0.0; n];
        let mut point_weights = vec![0.0; n];
        for i in 0..n {
            let mut x = -((i as f64 + 0.75) / (n as f64 + 0.5) * PI).cos();
            for _ in 0..8 {
                let (value, slope) = legendre(n, x);
                x -= value / slope;
            }
            points[i] = x;
            point_weights[i] = 2.0 / ((1.0 - x * x) * legendre(n, x).1.powi(2));
        }
        let mut nodes = vec![-1.0; n + 1];
        nodes[n] = 1.0;
        for i in 1..n {
            // Roots of P' lie between those of P; P'' follows from Legendre's equation.
            let mut x = 0.5 * (points[i - 1] + points[i]);
            for _ in 0..12 {
                let (value, slope) = legendre(n, x);
                let bend = (2.0 * x * slope - (n * (n + 1)) as f64 * value) / (1.0 - x * x);
                x -= slope / bend;
            }
            nodes[i] = x;
        }
        let whole = (n * (n + 1)) as f64;
        let node_weights = nodes.iter().map(|x| 2.0 / (whole * legendre(n, *x).0.powi(2))).collect();
        let mut this = Self {
            order,
            nodes,
            node_weights,
            points,
            point_weights,
            values: Vec::new(),
            slopes: Vec::new(),
            barycentric: Vec::new(),
            tail: Vec::new(),
        };
        this.barycentric = (0..=n)
            .map(|j| {
                (0..=n).filter(|k| *k != j).map(|k| this.nodes[j] - this.nodes[k]).product::<f64>().recip()
            })
            .collect();
        // Gauss-Lobatto sums are exact for all degrees but the square of the last, which they make 2/n instead of 2/(2n + 1).
        let coefficients = |degree: usize| {
            let square = if degree == n { 2.0 / n as f64 } else { 2.0 / (2 * degree + 1) as f64 };
            let each = this.nodes.iter().zip(&this.node_weights);
            (degree, each.map(|(x, weight)| weight * legendre(degree, *x).0 / square).collect())
        };
        this.tail = (n.saturating_sub(3)..=n).map(coefficients).collect();
        (this.values, this.slopes) = this.points.iter().map(|x| this.at(*x)).unzip();
        this
    }

    /// Values of the nodes' polynomials at x in [-1, 1], by the barycentric formula (J.-P. Berrut and L. N. Trefethen, *SIAM Rev.* 46
    /// (2004) 501).
    pub fn weights_at(&self, x: f64) -> Vec<f64> {
        if let Some(hit) = self.nodes.iter().position(|node| *node == x) {
            return (0..self.nodes.len()).map(|j| if j == hit { 1.0 } else { 0.0 }).collect();
        }
        let mut values: Vec<f64> =
            self.nodes.iter().zip(&self.barycentric).map(|(node, weight)| weight / (x - node)).collect();
        let sum = values.iter().sum::<f64>().recip();
        values.iter_mut().for_each(|value| *value *= sum);
        values
    }

    /// Values and slopes of the nodes' polynomials at x in [-1, 1].
    pub fn at(&self, x: f64) -> (Vec<f64>, Vec<f64>) {
        let n = self.nodes.len();
        let (mut values, mut slopes) = (vec![1.0; n], vec![0.0; n]);
        for j in 0..n {
            for k in (0..n).filter(|k| *k != j) {
                let width = self.nodes[j] - self.nodes[k];
                slopes[j] = (slopes[j] * (x - self.nodes[k]) + values[j]) / width;
                values[j] *= (x - self.nodes[k]) / width;
            }
        }
        (values, slopes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ x^k over [-1, 1].
    fn exact(k: i32) -> f64 {
        if k % 2 == 0 { 2.0 / f64::from(k + 1) } else { 0.0 }
    }

    #[test]
    fn both_rules_integrate_polynomials_as_far_as_they_should() {
        for order in [2, 3, 8, 14, 20] {
            let rule = Rule::new(order);
            let sum = |at: &[f64], weights: &[f64], k: i32| -> f64 {
                at.iter().zip(weights).map(|(x, w)| w * x.powi(k)).sum()
            };
            for k in 0..2 * order as i32 {
                let gauss = sum(&rule.points, &rule.point_weights, k);
                let lobatto = sum(&rule.nodes, &rule.node_weights, k);
                assert!((gauss - exact(k)).abs() < 1e-13, "Gauss {order}: {k}");
                assert!((lobatto - exact(k)).abs() < 1e-13, "Lobatto {order}: {k}");
            }
            let beyond = sum(&rule.points, &rule.point_weights, 2 * order as i32);
            assert!((beyond - exact(2 * order as i32)).abs() > 1e-16);
        }
    }

    #[test]
    fn polynomials_are_interpolated_with_their_slopes() {
        let rule = Rule::new(7);
        let of = |x: f64| 1.0 - 2.0 * x + 0.5 * x.powi(6);
        let values: Vec<f64> = rule.nodes.iter().map(|x| of(*x)).collect();
        for x in [-0.9, 0.13, 1.0] {
            let (weights, slopes) = rule.at(x);
            let dot = |w: &[f64]| w.iter().zip(&values).map(|(w, v)| w * v).sum::<f64>();
            assert!((dot(&weights) - of(x)).abs() < 1e-13);
            assert!((dot(&rule.weights_at(x)) - of(x)).abs() < 1e-13);
            assert!((dot(&slopes) - (3.0 * x.powi(5) - 2.0)).abs() < 1e-12);
        }
    }
    #[test]
    fn the_tail_holds_the_last_coefficients_of_a_series() {
        let rule = Rule::new(7);
        let values: Vec<f64> = rule
            .nodes
            .iter()
            .map(|x| 0.3 * legendre(7, *x).0 - 2.0 * legendre(6, *x).0 + legendre(3, *x).0)
            .collect();
        for ((_, weights), wanted) in rule.tail.iter().zip([0.0, 0.0, -2.0, 0.3]) {
            let found: f64 = weights.iter().zip(&values).map(|(w, v)| w * v).sum();
            assert!((found - wanted).abs() < 1e-13);
        }
    }
}
