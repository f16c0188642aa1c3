//! What is written of fits and formulas: documents, tables, pictures, and formulas as code.

mod code;
mod fit;
mod formula;
mod table;

pub use code::{formula_c, formula_csv, formula_rust, formula_toml};
pub use fit::{
    EstimateDocument, FitDocument, FitWorkDocument, LeftOutDocument, MeasuredDocument, SpecimenDocument,
    SpreadDocument, UnseenDocument, fit_document,
};
pub use formula::{FormulaDocument, FormulaPieceDocument, FormulaVariableDocument, formula_document};
pub use table::{fit_csv, points_csv};

use flexura_model::{FitStudy, FormulaQuantity, FormulaStudy, Model};
use flexura_solution::{Fit, ResponseFormula};

/// A fit with what belongs to it.
#[derive(Clone, Copy, Debug)]
pub struct FitView<'a> {
    /// The model that the study was asked of.
    pub model: &'a Model,
    /// What was asked.
    pub study: &'a FitStudy,
    /// What came out.
    pub fit: &'a Fit,
    /// The model with the estimates that are the same for all specimens.
    pub fitted: &'a Model,
}

impl FitView<'_> {
    /// Name and unit of a measured column.
    pub(crate) fn measured(&self, column: usize) -> (String, &str) {
        let (output, component) = self.study.data.measured[column];
        let unit = self.model.outputs.get(output).map_or("", |output| output.unit.as_str());
        (self.model.output_name(output, component), unit)
    }

    /// Measured less computed, SI; None where there is nothing to compare.
    pub(crate) fn residual(&self, row: usize, column: usize) -> Option<f64> {
        let computed = self.fit.rows.get(row)?.computed.get(column).copied().flatten()?;
        Some(self.study.data.rows[row].measured[column]? - computed)
    }
}

/// A formula with what belongs to it.
#[derive(Clone, Copy, Debug)]
pub struct FormulaView<'a> {
    /// The study's name, which the formula bears in code.
    pub name: &'a str,
    /// The model that was asked.
    pub model: &'a Model,
    /// What was asked.
    pub study: &'a FormulaStudy,
    /// What came out.
    pub formula: &'a ResponseFormula,
}

impl FormulaView<'_> {
    /// The output's name.
    pub fn output(&self) -> String {
        self.model.output_name(self.study.output.0, self.study.output.1)
    }

    /// The names of what goes in.
    pub fn variables(&self) -> Vec<String> {
        let name = |of: &FormulaQuantity| match of {
            FormulaQuantity::Parameter(position) => {
                self.model.parameters.get(*position).map_or(String::new(), |parameter| parameter.name.clone())
            }
            FormulaQuantity::Output(output, component) => self.model.output_name(*output, *component),
        };
        self.study.variables.iter().map(|variable| name(&variable.of)).collect()
    }

    /// Smallest and largest value of each variable among the points, in its unit.
    pub fn ranges(&self) -> Vec<[f64; 2]> {
        let range = |k: usize| {
            let values = self.formula.points.iter().map(|point| point.variables[k]);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        };
        (0..self.study.variables.len()).map(range).collect()
    }

    /// The terms of a piece as they would be written.
    pub fn terms(&self, piece: usize) -> Vec<String> {
        let names = self.variables();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        self.study.pieces[piece].terms.iter().map(|term| term.text(&names)).collect()
    }

    /// A piece as a sum, with so many digits: `18.2*w^3 + 5.31*w^2 - 0.85*w`.
    pub fn sum(&self, piece: usize, digits: usize) -> String {
        let mut text = String::new();
        for (term, coefficient) in self.terms(piece).iter().zip(&self.formula.pieces[piece].coefficients) {
            let size = short(coefficient.abs(), digits);
            let part = if term == "1" { size } else { format!("{size}*{term}") };
            let sign = if *coefficient < 0.0 { "-" } else { "+" };
            match (text.is_empty(), sign) {
                (true, "-") => text = format!("-{part}"),
                (true, _) => text = part,
                _ => text += &format!(" {sign} {part}"),
            }
        }
        text
    }
}

/// A number with so many digits, without zeros behind them.
fn short(value: f64, digits: usize) -> String {
    format!("{value:.*e}", digits.saturating_sub(1)).parse::<f64>().map_or(String::new(), |value| {
        let plain = format!("{value}");
        if plain.len() > digits + 6 { format!("{value:e}") } else { plain }
    })
}
