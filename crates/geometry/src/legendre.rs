//! Gauss-Legendre nodes and the integral of a smooth function as a Legendre series.

use std::sync::LazyLock;

/// Number of nodes, and of coefficients of a series.
pub(crate) const NODES: usize = 16;

/// Nodes and weights on [-1, 1], with the table of P_j at the nodes.
pub(crate) struct Rule {
    /// Increasing.
    pub nodes: [f64; NODES],
    /// Positive, sum 2.
    pub weights: [f64; NODES],
    /// `polynomials[i][j]` = P_j(nodes[i]).
    polynomials: [[f64; NODES]; NODES],
}

/// The 16-point rule, exact for polynomials of degree 31.
pub(crate) static RULE: LazyLock<Rule> = LazyLock::new(Rule::new);

impl Rule {
    /// Newton's method on P_16 from Tricomi's first guess; weights 2/((1 - x²) P'(x)²).
    fn new() -> Self {
        let n = NODES as f64;
        let mut rule =
            Rule { nodes: [0.0; NODES], weights: [0.0; NODES], polynomials: [[0.0; NODES]; NODES] };
        for i in 0..NODES {
            let mut x = -((i as f64 + 0.75) / (n + 0.5) * std::f64::consts::PI).cos();
            let mut slope = 1.0;
            for _ in 0..8 {
                let values = polynomials(x);
                slope = n * (values[NODES - 1] - x * values[NODES]) / (1.0 - x * x);
                x -= values[NODES] / slope;
            }
            rule.nodes[i] = x;
            rule.weights[i] = 2.0 / ((1.0 - x * x) * slope * slope);
            rule.polynomials[i].copy_from_slice(&polynomials(x)[..NODES]);
        }
        rule
    }

    /// The Legendre series of the function with the given values at the nodes.
    pub fn series(&self, values: &[f64; NODES]) -> [f64; NODES] {
        let mut series = [0.0; NODES];
        for (j, coefficient) in series.iter_mut().enumerate() {
            let sum: f64 = (0..NODES).map(|i| self.weights[i] * values[i] * self.polynomials[i][j]).sum();
            *coefficient = sum * (j as f64 + 0.5);
        }
        series
    }
}

/// P_0 .. P_16 at x.
fn polynomials(x: f64) -> [f64; NODES + 1] {
    let mut p = [1.0; NODES + 1];
    p[1] = x;
    for j in 1..NODES {
        let k = j as f64;
        p[j + 1] = ((2.0 * k + 1.0) * x * p[j] - k * p[j - 1]) / (k + 1.0);
    }
    p
}

/// A function on [-1, 1] known by its Legendre series: its integral from -1, and its tail.
#[derive(Clone, Debug)]
pub(crate) struct Integral {
    series: [f64; NODES],
}

impl Integral {
    /// From the integrand's values at the nodes of [`RULE`].
    pub fn new(values: &[f64; NODES]) -> Self {
        Self { series: RULE.series(values) }
    }

    /// ∫ from -1 to x, by ∫P_j = (P_{j+1} - P_{j-1})/(2j + 1).
    pub fn to(&self, x: f64) -> f64 {
        let p = polynomials(x);
        let mut sum = 0.0;
        for j in (1..NODES).rev() {
            sum += self.series[j] * (p[j + 1] - p[j - 1]) / (2.0 * j as f64 + 1.0);
        }
        sum + self.series[0] * (x + 1.0)
    }

    /// ∫ from -1 to 1.
    pub fn whole(&self) -> f64 {
        2.0 * self.series[0]
    }

    /// The integrand at x.
    pub fn rate(&self, x: f64) -> f64 {
        let p = polynomials(x);
        (0..NODES).rev().map(|j| self.series[j] * p[j]).sum()
    }

    /// How far the series is from having converged: its last coefficients.
    pub fn tail(&self) -> f64 {
        self.series[NODES - 1].abs() + self.series[NODES - 2].abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_integrates_polynomials_of_degree_31_exactly() {
        for degree in 0..=31 {
            let sum: f64 = (0..NODES).map(|i| RULE.weights[i] * RULE.nodes[i].powi(degree)).sum();
            let exact = if degree % 2 == 0 { 2.0 / (degree as f64 + 1.0) } else { 0.0 };
            assert!((sum - exact).abs() < 1e-15, "degree {degree}: {sum} against {exact}");
        }
    }

    #[test]
    fn the_integral_of_a_cosine_is_a_sine() {
        let values = RULE.nodes.map(f64::cos);
        let integral = Integral::new(&values);
        for x in [-1.0f64, -0.3, 0.0, 0.77, 1.0] {
            assert!((integral.to(x) - (x.sin() + 1f64.sin())).abs() < 1e-15);
            assert!((integral.rate(x) - x.cos()).abs() < 4e-15);
        }
        assert!((integral.whole() - 2.0 * 1f64.sin()).abs() < 1e-15 && integral.tail() < 1e-14);
    }
}
