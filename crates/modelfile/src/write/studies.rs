//! The tables of studies.

use super::Writer;
use super::tree::{Table, Value};
use flexura_model::{
    BuckleStudy, InverseDynamicsStudy, ModesStudy, MotionLaw, Pace, Sampling, Stop, StudyKind, Target,
    TraceStudy, Until,
};

impl Writer<'_> {
    pub(super) fn studies(&self, text: &mut String) {
        for study in &self.model.studies {
            let mut table = Table::default();
            table.put("kind", Value::text(study.kind.word()));
            match &study.kind {
                StudyKind::Solve => {}
                StudyKind::Trace(trace) => self.trace(trace, &mut table),
                StudyKind::Buckle(buckle) => self.buckle(buckle, &mut table),
                StudyKind::Modes(modes) => self.modes(modes, &mut table),
                StudyKind::InverseDynamics(motion) => self.motion(motion, &mut table),
                StudyKind::Fit(fit) => self.fit(fit, &mut table),
                StudyKind::Formula(formula) => self.formula(formula, &mut table),
                StudyKind::Optimise(design) => self.design(design, &mut table),
            }
            text.push_str(&table.section("study", &study.name));
        }
    }

    pub(super) fn parameter(&self, position: usize) -> Value {
        Value::text(self.names.get(position).copied().unwrap_or_default())
    }

    fn event(&self, event: &Target) -> Value {
        // What was read bears its equation as its name.
        if event.output.name.contains('=') {
            return Value::text(&event.output.name);
        }
        Value::text(&format!("{} = {:?}", self.expression(&event.output), event.value))
    }

    fn trace(&self, trace: &TraceStudy, table: &mut Table) {
        let standard = TraceStudy::default();
        let pair = |range: &[f64; 2]| Value::List(range.map(Value::number).to_vec());
        let count = |count: usize| Value::plain(&count.to_string());
        table.put("parameter", self.parameter(trace.parameter));
        table.put("range", pair(&trace.range));
        if trace.start != trace.range[0] {
            table.put("start", Value::number(trace.start));
        }
        for (key, own, usual) in [
            ("steps", trace.steps, standard.steps),
            ("most_points", trace.most_points, standard.most_points),
            ("branches", trace.branches, standard.branches),
            ("guesses", trace.guesses, standard.guesses),
        ] {
            if own != usual {
                table.put(key, count(own));
            }
        }
        if !trace.events.is_empty() {
            table.put("event", Value::List(trace.events.iter().map(|event| self.event(event)).collect()));
        }
        let stop = |stop: &Stop| match stop {
            Stop::Value(event) => self.event(event),
            Stop::Fold(number) => Value::text(&format!("fold {number}")),
            Stop::Branch(number) => Value::text(&format!("branch {number}")),
            Stop::Event(number) => Value::text(&format!("event {number}")),
        };
        if !trace.stops.is_empty() {
            table.put("stop", Value::List(trace.stops.iter().map(stop).collect()));
        }
        if let Some((parameter, from)) = trace.imperfection {
            let mut inner = Table::default();
            inner.put("parameter", self.parameter(parameter));
            inner.put("from", Value::number(from));
            table.put("imperfection", Value::Table(inner));
        }
        if let Some(critical) = &trace.critical {
            let mut inner = Table::default();
            inner.put("parameter", self.parameter(critical.parameter));
            inner.put("range", pair(&critical.range));
            inner.put("number", count(critical.number));
            table.put("critical", Value::Table(inner));
        }
    }

    fn buckle(&self, buckle: &BuckleStudy, table: &mut Table) {
        table.put_some("parameter", buckle.parameter.map(|position| self.parameter(position)));
        table.put("at", Value::number(buckle.at));
        table.put("count", Value::plain(&buckle.count.to_string()));
    }

    fn modes(&self, modes: &ModesStudy, table: &mut Table) {
        table.put("count", Value::plain(&modes.count.to_string()));
        if modes.at_rest {
            table.put("at_rest", Value::flag(true));
        }
        if let Some(path) = &modes.path {
            table.put("parameter", self.parameter(path.parameter));
            table.put("range", Value::List(path.range.map(Value::number).to_vec()));
            table.put("steps", Value::plain(&path.steps.to_string()));
        }
    }

    fn motion(&self, motion: &InverseDynamicsStudy, table: &mut Table) {
        table.put("parameter", self.parameter(motion.parameter));
        match &motion.law {
            MotionLaw::Trapezoid { from, to, pace, ramp } => {
                let mut inner = Table::default();
                inner.put("from", Value::number(*from));
                inner.put("to", Value::number(*to));
                match pace {
                    Pace::Speed(speed) => inner.put("speed", Value::number(*speed)),
                    Pace::Duration(duration) => inner.put("duration", Value::number(*duration)),
                }
                inner.put("ramp", Value::number(*ramp));
                table.put("trapezoid", Value::Table(inner));
            }
            MotionLaw::Knots(knots) => {
                let row = |row: &[f64; 2]| Value::List(row.map(Value::number).to_vec());
                table.put("knots", Value::List(knots.iter().map(row).collect()));
            }
            MotionLaw::Function { value, duration } => {
                table.put("value", Value::text(value.text()));
                table.put("duration", Value::number(*duration));
            }
            MotionLaw::Constant { from, rate, until } => {
                table.put("rate", Value::number(*rate));
                table.put("from", Value::number(*from));
                match until {
                    Until::Value(to) => table.put("to", Value::number(*to)),
                    Until::Duration(duration) => table.put("duration", Value::number(*duration)),
                }
            }
        }
        match motion.sampling {
            Sampling::Count(count) => table.put("samples", Value::plain(&count.to_string())),
            Sampling::Step(step) => table.put("step", Value::number(step)),
        }
    }
}
