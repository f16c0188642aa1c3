//! What a residual costs: its square, or less where it is large.

/// A loss ρ of the squared residual z = (r/scale)²; the cost is ½ scale² Σ ρ(z), and ρ(z) ≈ z for small z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// ρ = z: least squares.
    Squares,
    /// ρ = z up to 1, then 2√z - 1: squares near, absolute values far (P. J. Huber, 1964).
    Huber(f64),
    /// ρ = 2(√(1 + z) - 1), the same without a corner.
    SoftL1(f64),
    /// ρ = ln(1 + z): what lies far hardly counts.
    Cauchy(f64),
}

impl Loss {
    /// The residual beyond which it stops counting in full.
    pub fn scale(self) -> f64 {
        match self {
            Loss::Squares => 1.0,
            Loss::Huber(scale) | Loss::SoftL1(scale) | Loss::Cauchy(scale) => scale,
        }
    }

    /// ρ, ρ' and ρ'' at z.
    fn at(self, z: f64) -> [f64; 3] {
        match self {
            Loss::Squares => [z, 1.0, 0.0],
            Loss::Huber(_) if z <= 1.0 => [z, 1.0, 0.0],
            Loss::Huber(_) => [2.0 * z.sqrt() - 1.0, z.powf(-0.5), -0.5 * z.powf(-1.5)],
            Loss::SoftL1(_) => {
                let t = 1.0 + z;
                [2.0 * z / (1.0 + t.sqrt()), t.powf(-0.5), -0.5 * t.powf(-1.5)]
            }
            Loss::Cauchy(_) => {
                let t = 1.0 + z;
                [z.ln_1p(), 1.0 / t, -1.0 / (t * t)]
            }
        }
    }

    /// ½ scale² ρ((r/scale)²).
    pub fn cost(self, residual: f64) -> f64 {
        let scale = self.scale();
        0.5 * scale * scale * self.at((residual / scale).powi(2))[0]
    }

    /// How much a residual counts beside what it would by least squares: ρ'.
    pub fn weight(self, residual: f64) -> f64 {
        self.at((residual / self.scale()).powi(2))[1]
    }

    /// By how much the pull ρ' r of a residual grows with it: ρ' + 2 ρ'' z.
    pub fn bend(self, residual: f64) -> f64 {
        let z = (residual / self.scale()).powi(2);
        let [_, first, second] = self.at(z);
        first + 2.0 * second * z
    }

    /// Factors of a row of residual and Jacobian whose least-squares step is the Newton step of this loss up to second derivatives
    /// of the residual (B. Triggs et al., Bundle adjustment, 2000, section 4.3).
    pub(super) fn factors(self, residual: f64) -> [f64; 2] {
        let z = (residual / self.scale()).powi(2);
        let [_, first, second] = self.at(z);
        // Where the loss bends down, the row would pull the wrong way: little is left of it.
        let curve = (first + 2.0 * second * z).max(1e-8 * first).sqrt();
        [first / curve, curve]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_the_slopes_of_the_costs() {
        for loss in [Loss::Squares, Loss::Huber(0.7), Loss::SoftL1(0.7), Loss::Cauchy(0.7)] {
            for r in [1e-3, 0.3, 0.9, 5.0] {
                let h = 1e-4 * r;
                let ahead = |n: f64| loss.cost(r + n * h) - loss.cost(r - n * h);
                let slope = (8.0 * ahead(1.0) - ahead(2.0)) / (12.0 * h);
                assert!((slope - loss.weight(r) * r).abs() < 1e-9 * r, "{loss:?} at {r}");
                // J'r of the scaled row is the gradient.
                let [residual, row] = loss.factors(r);
                assert!((residual * row - loss.weight(r)).abs() < 1e-12);
            }
        }
    }
}
