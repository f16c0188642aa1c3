//! What a verification case is, and what it returns.

/// Solves a case and compares.
pub type Run = fn() -> Result<Vec<Row>, String>;

/// Solves a case to a tolerance and holds the true error against the solver's estimate of it.
pub type Weigh = fn(f64) -> Result<Vec<Estimate>, String>;

/// One line of the verification table.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// A short name, unique, lower_snake_case.
    pub id: &'static str,
    /// What is solved, in a few words.
    pub title: &'static str,
    /// Where the reference comes from.
    pub citation: &'static str,
    /// How close the answer must be, in words.
    pub needed: &'static str,
    /// Solves the case and compares.
    pub run: Run,
    /// Weighs the solver's error estimate. None where there is no closed form.
    pub closed_form: Option<Weigh>,
}

/// One comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What is compared.
    pub quantity: String,
    /// The reference's value, in the quantity's own unit.
    pub reference: f64,
    /// Our value.
    pub ours: f64,
    /// How far they are apart, a magnitude, on the scale that the tolerance is meant for.
    pub difference: f64,
    /// The largest difference allowed.
    pub tolerance: f64,
    /// The solver's own estimate of its error, relative to L, 1, EI/L² and EI/L.
    pub estimate: Option<f64>,
}

impl Row {
    /// Two numbers that may differ by `tolerance` times `scale`.
    pub fn scaled(
        quantity: impl Into<String>,
        reference: f64,
        ours: f64,
        scale: f64,
        tolerance: f64,
    ) -> Self {
        Self {
            quantity: quantity.into(),
            reference,
            ours,
            difference: ((ours - reference) / scale).abs(),
            tolerance,
            estimate: None,
        }
    }

    /// Two numbers that may differ by `tolerance`.
    pub fn absolute(quantity: impl Into<String>, reference: f64, ours: f64, tolerance: f64) -> Self {
        Self::scaled(quantity, reference, ours, 1.0, tolerance)
    }

    /// Two numbers that may differ by `tolerance` times the reference.
    pub fn relative(quantity: impl Into<String>, reference: f64, ours: f64, tolerance: f64) -> Self {
        Self::scaled(quantity, reference, ours, reference, tolerance)
    }

    /// Something that should be zero and is `difference` at most.
    pub fn vanishing(quantity: impl Into<String>, difference: f64, tolerance: f64) -> Self {
        Self::absolute(quantity, 0.0, difference, tolerance)
    }

    /// The same row with the solver's estimate.
    pub fn with_estimate(self, estimate: f64) -> Self {
        Self { estimate: Some(estimate), ..self }
    }

    /// Is it within its tolerance? A NaN is not.
    pub fn passes(&self) -> bool {
        self.difference <= self.tolerance && self.reference.is_finite() && self.ours.is_finite()
    }
}

/// A solve's true error beside the solver's estimate of it; both relative to L, 1, EI/L² and EI/L.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Which solve.
    pub what: String,
    /// Largest deviation of any pose or wrench along the beam from the closed form.
    pub error: f64,
    /// What the solver says.
    pub estimate: f64,
}

impl Estimate {
    /// Is the true error within ten times the estimate, and the estimate within the tolerance asked for?
    pub fn is_honest(&self, tolerance: f64) -> bool {
        self.error <= 10.0 * self.estimate && self.estimate <= tolerance
    }
}
