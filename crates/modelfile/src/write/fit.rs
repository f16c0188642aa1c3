//! The tables of studies that meet data.

use super::Writer;
use super::tree::{Table, Value};
use flexura_model::{
    FitLoss, FitStudy, FormulaPiece, FormulaQuantity, FormulaSource, FormulaStudy, FormulaUnit, Measurements,
};

impl Writer<'_> {
    pub(super) fn fit(&self, fit: &FitStudy, table: &mut Table) {
        table.put("data", Value::Table(self.measurements(&fit.data)));
        let range = |range: &[f64; 2]| Value::List(range.map(Value::number).to_vec());
        let mut bounds = Table::default();
        for (key, is_own) in [("unknown", false), ("per_specimen", true)] {
            let unknowns = fit.unknowns.iter().filter(|unknown| unknown.is_per_specimen == is_own);
            let names: Vec<Value> = unknowns.map(|unknown| self.parameter(unknown.parameter)).collect();
            if !names.is_empty() {
                table.put(key, Value::List(names));
            }
        }
        for unknown in &fit.unknowns {
            let name = self.names.get(unknown.parameter).copied().unwrap_or_default();
            bounds.put_some(name, unknown.bounds.as_ref().map(range));
        }
        if !bounds.is_empty() {
            table.put("bounds", Value::Table(bounds));
        }
        let mut noise = Table::default();
        for (output, component, value) in &fit.noise {
            noise.put(&self.model.output_name(*output, *component), Value::number(*value));
        }
        if !noise.is_empty() {
            table.put("noise", Value::Table(noise));
        }
        if fit.loss != FitLoss::Squares {
            table.put("loss", Value::text(fit.loss.word()));
        }
        if fit.profile {
            table.put("intervals", Value::text("profile"));
        }
        table.put("confidence", Value::number(fit.confidence));
        if fit.reject {
            table.put("reject", Value::flag(true));
        }
    }

    fn measurements(&self, data: &Measurements) -> Table {
        let in_unit = |name: &str, unit: &str| match unit {
            "" => Value::text(name),
            unit => Value::text(&format!("{name} [{unit}]")),
        };
        let mut columns: Vec<Value> = Vec::new();
        for position in &data.set {
            columns.push(
                self.model
                    .parameters
                    .get(*position)
                    .map_or(Value::text(""), |parameter| in_unit(&parameter.name, &parameter.unit)),
            );
        }
        for (output, component) in &data.measured {
            let unit = self.model.outputs.get(*output).map_or("", |output| output.unit.as_str());
            columns.push(in_unit(&self.model.output_name(*output, *component), unit));
        }
        let has_specimens = data.specimens != [String::new()];
        let has_weights = data.rows.iter().any(|row| row.weight != 1.0);
        if has_specimens {
            columns.push(Value::text("specimen"));
        }
        if has_weights {
            columns.push(Value::text("weight"));
        }
        let mut rows = Vec::with_capacity(data.rows.len());
        for row in &data.rows {
            let mut cells: Vec<Value> = row.set.iter().map(|value| Value::number(*value)).collect();
            cells.extend(row.measured.iter().map(|value| value.map_or(Value::text(""), Value::number)));
            if has_specimens {
                cells.push(Value::text(&data.specimens[row.specimen]));
            }
            if has_weights {
                cells.push(Value::number(row.weight));
            }
            rows.push(Value::List(cells));
        }
        let mut table = Table::default();
        table.put("columns", Value::List(columns));
        table.put("rows", Value::List(rows));
        table
    }

    pub(super) fn formula(&self, study: &FormulaStudy, table: &mut Table) {
        let in_unit = |name: &str, unit: &FormulaUnit| match unit.text.as_str() {
            "" => Value::text(name),
            text => Value::text(&format!("{name} [{text}]")),
        };
        let name = |of: &FormulaQuantity| match of {
            FormulaQuantity::Parameter(position) => {
                self.names.get(*position).copied().unwrap_or_default().to_string()
            }
            FormulaQuantity::Output(output, component) => self.model.output_name(*output, *component),
        };
        let (output, component) = study.output;
        table.put("output", in_unit(&self.model.output_name(output, component), &study.unit));
        let names: Vec<String> = study.variables.iter().map(|variable| name(&variable.of)).collect();
        let of = names.iter().zip(&study.variables).map(|(name, variable)| in_unit(name, &variable.unit));
        table.put("of", Value::List(of.collect()));
        match &study.source {
            FormulaSource::Trace(position) => {
                let trace = self.model.studies.get(*position).map_or("", |study| study.name.as_str());
                table.put("trace", Value::text(trace));
            }
            FormulaSource::Grid(axes) => {
                let mut grid = Table::default();
                for (parameter, values) in axes {
                    let ends = values.first().zip(values.last());
                    let (from, to) = ends.map_or((0.0, 0.0), |(from, to)| (*from, *to));
                    let count = Value::plain(&values.len().to_string());
                    let list = vec![Value::number(from), Value::number(to), count];
                    grid.put(self.names.get(*parameter).copied().unwrap_or_default(), Value::List(list));
                }
                table.put("vary", Value::Table(grid));
            }
        }
        let mut ranges = Table::default();
        for (name, variable) in names.iter().zip(&study.variables) {
            let range = variable.range.map(|range| Value::List(range.map(Value::number).to_vec()));
            ranges.put_some(name, range);
        }
        if !ranges.is_empty() {
            table.put("range", Value::Table(ranges));
        }
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let terms = |piece: &FormulaPiece| {
            Value::List(piece.terms.iter().map(|term| Value::text(&term.text(&names))).collect())
        };
        match &study.pieces[..] {
            [only] => table.put("terms", terms(only)),
            pieces => {
                let piece = |piece: &FormulaPiece| {
                    let mut inner = Table::default();
                    inner.put_some("to", piece.to.map(Value::number));
                    inner.put("terms", terms(piece));
                    Value::Table(inner)
                };
                table.put("pieces", Value::List(pieces.iter().map(piece).collect()));
            }
        }
    }
}
