//! Studies of the kind `optimise`.

use super::Writer;
use super::tree::{Table, Value};
use flexura_model::{Condition, OptimiseStudy, Optimiser, Reading, Where};

impl Writer<'_> {
    pub(super) fn design(&self, study: &OptimiseStudy, table: &mut Table) {
        let standard = OptimiseStudy::default();
        let count = |count: usize| Value::plain(&count.to_string());
        table.put(goal(study.maximise), self.reading(&study.objective));
        let mut vary = Table::default();
        for varied in &study.vary {
            let mut inner = Table::default();
            inner.put("range", Value::List(varied.range.map(Value::number).to_vec()));
            inner.put("guess", Value::number(varied.guess));
            vary.put(self.names.get(varied.parameter).copied().unwrap_or_default(), Value::Table(inner));
        }
        table.put("vary", Value::Table(vary));
        if !study.conditions.is_empty() {
            let list = study.conditions.iter().map(|condition| self.condition(condition)).collect();
            table.put("constraints", Value::List(list));
        }
        if study.stable {
            table.put("stable", Value::plain("true"));
        }
        if study.starts != standard.starts {
            table.put("starts", count(study.starts));
        }
        if study.seed != standard.seed {
            table.put("seed", Value::plain(&study.seed.to_string()));
        }
        if study.method != Optimiser::Sqp {
            table.put("method", Value::text(study.method.word()));
        }
        if let Some(front) = &study.front {
            let mut inner = Table::default();
            inner.put(goal(front.maximise), self.reading(&front.other));
            inner.put("points", count(front.points));
            table.put("pareto", Value::Table(inner));
        }
        if study.tolerance != standard.tolerance {
            table.put("tolerance", Value::number(study.tolerance));
        }
        if study.most_iterations != standard.most_iterations {
            table.put("most_iterations", count(study.most_iterations));
        }
    }

    fn reading(&self, reading: &Reading) -> Value {
        if reading.at == Where::Equilibrium {
            return Value::text(&self.text_of(reading));
        }
        let mut inner = Table::default();
        self.put_reading(reading, &mut inner);
        Value::Table(inner)
    }

    fn put_reading(&self, reading: &Reading, table: &mut Table) {
        table.put("output", Value::text(&self.text_of(reading)));
        if let Where::Path { study, point, .. } = &reading.at {
            table.put("over", Value::text(study));
            table.put("point", Value::text(&point.text()));
        }
    }

    /// What was read bears its text as its name.
    fn text_of(&self, reading: &Reading) -> String {
        match reading.output.name.as_str() {
            "" => self.expression(&reading.output),
            name => name.to_string(),
        }
    }

    fn condition(&self, condition: &Condition) -> Value {
        let mut inner = Table::default();
        self.put_reading(&condition.reading, &mut inner);
        for (key, value) in
            [("least", condition.least), ("most", condition.most), ("equals", condition.equals)]
        {
            inner.put_some(key, value.map(Value::number));
        }
        Value::Table(inner)
    }
}

fn goal(maximise: bool) -> &'static str {
    if maximise { "maximise" } else { "minimise" }
}
