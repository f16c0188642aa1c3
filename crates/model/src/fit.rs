//! Parameters from measurements, and formulas that repeat a model's answer.

/// Unknown parameters are to be found from measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct FitStudy {
    /// What was measured.
    pub data: Measurements,
    /// What is to be found.
    pub unknowns: Vec<FitUnknown>,
    /// Standard deviations of the measurements (SI), for each column of [`Measurements::measured`] that has one: (output,
    /// component, value).
    pub noise: Vec<(usize, usize, f64)>,
    /// What a residual costs.
    pub loss: FitLoss,
    /// Are the ends of the intervals found by fitting all other parameters anew, besides those of the linearised problem?
    pub profile: bool,
    /// Probability that an interval holds the true value.
    pub confidence: f64,
    /// Are specimens that lie outside what the others predict left out?
    pub reject: bool,
}

/// A parameter that is to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitUnknown {
    /// Position in [`crate::Model::parameters`], whose value is the first guess.
    pub parameter: usize,
    /// Values between which it is, SI.
    pub bounds: Option<[f64; 2]>,
    /// Has each specimen its own value?
    pub is_per_specimen: bool,
}

/// What a residual costs, beside its size: large ones count less than their squares.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FitLoss {
    /// Least squares.
    #[default]
    Squares,
    /// Squares up to 1.345 standard deviations, absolute values beyond.
    Huber,
    /// The same without a corner.
    SoftL1,
    /// Logarithms: what lies far hardly counts.
    Cauchy,
}

impl FitLoss {
    /// All of them.
    pub const ALL: [FitLoss; 4] = [FitLoss::Squares, FitLoss::Huber, FitLoss::SoftL1, FitLoss::Cauchy];

    /// The word that stands in the model file.
    pub fn word(self) -> &'static str {
        match self {
            FitLoss::Squares => "squares",
            FitLoss::Huber => "huber",
            FitLoss::SoftL1 => "soft_l1",
            FitLoss::Cauchy => "cauchy",
        }
    }
}

/// A table of measurements.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measurements {
    /// Where it was read, for messages.
    pub source: String,
    /// Parameters that each row sets: positions in [`crate::Model::parameters`].
    pub set: Vec<usize>,
    /// Outputs that were measured: position in [`crate::Model::outputs`], and component of a vector (0 for a number).
    pub measured: Vec<(usize, usize)>,
    /// Names of the specimens; one without a name where the table tells none apart.
    pub specimens: Vec<String>,
    /// One measurement each.
    pub rows: Vec<MeasuredRow>,
}

/// One row of a table of measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredRow {
    /// Its line in the table, counted from 1.
    pub line: usize,
    /// Values of the parameters, SI.
    pub set: Vec<f64>,
    /// Values that were measured, SI; None where there is none.
    pub measured: Vec<Option<f64>>,
    /// Position of its specimen.
    pub specimen: usize,
    /// How often its squares count.
    pub weight: f64,
}

/// A formula is to repeat an output over a trace or a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaStudy {
    /// What it gives: position of the output and component.
    pub output: (usize, usize),
    /// In which unit.
    pub unit: FormulaUnit,
    /// What goes in.
    pub variables: Vec<FormulaVariable>,
    /// Where the model is asked.
    pub source: FormulaSource,
    /// Pieces one after another along the first variable; several only of a formula in one.
    pub pieces: Vec<FormulaPiece>,
}

/// What goes into a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaVariable {
    /// Parameter or output.
    pub of: FormulaQuantity,
    /// In which unit it goes in.
    pub unit: FormulaUnit,
    /// Values between which the formula is fitted, SI; None: all there are.
    pub range: Option<[f64; 2]>,
}

/// The unit of a number in a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaUnit {
    /// As it is written, "" for a plain number.
    pub text: String,
    /// In SI units.
    pub factor: f64,
}

/// A number of a model that goes into a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormulaQuantity {
    /// Position of a parameter.
    Parameter(usize),
    /// Position and component of an output.
    Output(usize, usize),
}

/// Where a model is asked.
#[derive(Clone, Debug, PartialEq)]
pub enum FormulaSource {
    /// Along the first branch of a trace: position in [`crate::Model::studies`].
    Trace(usize),
    /// On a grid: parameters with their values, SI.
    Grid(Vec<(usize, Vec<f64>)>),
}

/// One piece of a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaPiece {
    /// Where it ends along the first variable, SI; None of the last.
    pub to: Option<f64>,
    /// Its terms.
    pub terms: Vec<FormulaTerm>,
}

/// A product of powers of the variables.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FormulaTerm {
    /// Its factors; none for the constant.
    pub factors: Vec<FormulaFactor>,
}

/// A power of a variable, or of its absolute value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FormulaFactor {
    /// Position in [`FormulaStudy::variables`].
    pub variable: usize,
    /// Its power, from 1 on.
    pub power: u32,
    /// Does the sign count for nothing?
    pub is_absolute: bool,
}

impl FormulaTerm {
    /// Its value.
    pub fn value(&self, variables: &[f64]) -> f64 {
        let factor = |factor: &FormulaFactor| {
            let base = variables[factor.variable];
            let base = if factor.is_absolute { base.abs() } else { base };
            base.powi(i32::try_from(factor.power).unwrap_or(i32::MAX))
        };
        self.factors.iter().map(factor).product()
    }

    /// All products of powers whose sum is at most `degree`, of `variables` variables, lower ones first.
    pub fn up_to(degree: u32, variables: usize, constant: bool) -> Vec<Self> {
        let mut all = vec![vec![0; variables]];
        for variable in 0..variables {
            let mut next = Vec::new();
            for powers in &all {
                let used: u32 = powers.iter().sum();
                for power in 0..=degree - used {
                    let mut powers = powers.clone();
                    powers[variable] = power;
                    next.push(powers);
                }
            }
            all = next;
        }
        all.sort_by_key(|powers| (powers.iter().sum::<u32>(), std::cmp::Reverse(powers.clone())));
        let term = |powers: Vec<u32>| {
            let used = powers.iter().enumerate().filter(|(_, power)| **power > 0);
            let factors =
                used.map(|(variable, power)| FormulaFactor { variable, power: *power, is_absolute: false });
            FormulaTerm { factors: factors.collect() }
        };
        all.into_iter().map(term).filter(|term| constant || !term.factors.is_empty()).collect()
    }

    /// As it would be written: `theta*abs(psi)^2`; 1 for the constant.
    pub fn text(&self, names: &[&str]) -> String {
        let factor = |factor: &FormulaFactor| {
            let name = names.get(factor.variable).copied().unwrap_or_default();
            let base = if factor.is_absolute { format!("abs({name})") } else { name.to_owned() };
            if factor.power == 1 { base } else { format!("{base}^{}", factor.power) }
        };
        match self.factors.len() {
            0 => "1".to_owned(),
            _ => self.factors.iter().map(factor).collect::<Vec<_>>().join("*"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_products_of_a_degree_are_there_once() {
        let text = |terms: Vec<FormulaTerm>| {
            terms.iter().map(|term| term.text(&["x", "y"])).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(text(FormulaTerm::up_to(2, 2, true)), "1 x y x^2 x*y y^2");
        assert_eq!(text(FormulaTerm::up_to(3, 1, false)), "x x^2 x^3");
        // C(n + d, d) of them.
        assert_eq!(FormulaTerm::up_to(4, 3, true).len(), 35);
    }

    #[test]
    fn a_term_takes_powers_and_absolute_values() {
        let factor = |variable, power, is_absolute| FormulaFactor { variable, power, is_absolute };
        let term = FormulaTerm { factors: vec![factor(0, 3, false), factor(1, 1, true)] };
        assert_eq!(term.value(&[-2.0, -5.0]), -40.0);
        assert_eq!(term.text(&["theta", "psi"]), "theta^3*abs(psi)");
        assert_eq!(FormulaTerm::default().value(&[7.0]), 1.0);
    }
}
