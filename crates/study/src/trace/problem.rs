//! A mechanism whose parameters change, as `continuation` sees it.

use super::line::Line;
use crate::Prepared;
use crate::family::Family;
use flexura_continuation::{Parameters, Problem, Refusal, Tangent};
use flexura_equilibrium::{Equilibrium, Law, Mesh, Stability};
use flexura_model::Model;
use flexura_nonlinear::System;

/// A parameter as `continuation` has it: `value = origin + span × scaled`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    /// Position in the model's parameters.
    pub parameter: usize,
    pub origin: f64,
    pub span: f64,
}

impl Axis {
    pub fn value(&self, scaled: f64) -> f64 {
        // Never a negative zero.
        self.origin + self.span * scaled + 0.0
    }

    pub fn scaled(&self, value: f64) -> f64 {
        (value - self.origin) / self.span
    }
}

/// Laws that are kept: those of the last parameters, which differences come back to.
const KEPT: usize = 3;

pub(crate) struct Traced<'a> {
    pub prepared: Prepared,
    family: &'a mut dyn Family,
    /// The parameter that is traced, and a second one.
    pub axes: [Axis; 2],
    parameters: Parameters,
    laws: Vec<Kept>,
    /// Where only loads and drives depend on the first parameter.
    line: Option<Line>,
    /// Why stability is not decided.
    pub undecided: Option<String>,
    /// Do modes decide where that is so?
    pub by_motion: bool,
    /// Has it been seen that they do not?
    pub is_massless: bool,
    /// Is the second parameter another one than the first?
    pub both: bool,
}

/// A law that was put away.
struct Kept {
    /// Of these parameters.
    of: Parameters,
    /// Where only what differs was exchanged: good while these stand.
    beside: Parameters,
    law: Law,
}

/// Everything that has to be put back to be at a point again, whatever the layout is by then.
#[derive(Clone)]
pub(crate) struct Snapshot {
    problem: Equilibrium,
    parameters: Parameters,
}

impl<'a> Traced<'a> {
    /// `prepared` stands at the values that the axes have at (`parameters`).
    pub fn new(
        prepared: Prepared,
        family: &'a mut dyn Family,
        axes: [Axis; 2],
        parameters: Parameters,
        both: bool,
    ) -> Self {
        let mut this = Self {
            prepared,
            family,
            axes,
            parameters,
            laws: Vec::new(),
            line: None,
            undecided: None,
            by_motion: false,
            is_massless: false,
            both,
        };
        this.find_line();
        this
    }

    /// Looks whether the model need not be made anew for every value.
    fn find_line(&mut self) {
        self.line = None;
        if self.both || !self.family.is_line(self.axes[0].parameter) {
            return;
        }
        if let (Ok(first), Ok(last)) = (self.model_at([0.0; 2]), self.model_at([1.0, 0.0])) {
            self.line = Some(Line::through([(0.0, &first), (1.0, &last)]));
        }
    }

    pub fn problem(&mut self) -> &mut Equilibrium {
        &mut self.prepared.problem
    }

    /// The model at these parameters.
    ///
    /// # Errors
    /// The values make no sound model.
    pub fn model_at(&mut self, values: Parameters) -> Result<Model, Refusal> {
        let list = self.list(values);
        self.family.model(&list).map_err(|error| Refusal::Parameter(error.message))
    }

    /// Parameters of the model and their values, SI.
    fn list(&self, values: Parameters) -> Vec<(usize, f64)> {
        let axes = self.axes.iter().zip(values).take(if self.both { 2 } else { 1 });
        axes.map(|(axis, value)| (axis.parameter, axis.value(value))).collect()
    }

    /// The model with other values of any parameters (SI).
    ///
    /// # Errors
    /// The values make no sound model.
    pub fn model_with(&mut self, values: &[(usize, f64)]) -> Result<Model, String> {
        self.family.model(values).map_err(|error| error.message)
    }

    /// Stands where another prepared problem of the same axes stands.
    pub fn take(&mut self, prepared: Prepared, parameters: Parameters) {
        self.exchange(prepared, self.axes, parameters, self.both);
    }

    /// Stands where another prepared problem stands, in other axes; returns the one before.
    pub fn exchange(
        &mut self,
        mut prepared: Prepared,
        axes: [Axis; 2],
        parameters: Parameters,
        both: bool,
    ) -> Prepared {
        let counts = self.prepared.problem.counts();
        prepared.problem.set_counts(counts);
        self.laws.clear();
        let same = self.axes == axes && self.both == both;
        (self.axes, self.parameters, self.both) = (axes, parameters, both);
        let before = std::mem::replace(&mut self.prepared, prepared);
        if !same {
            self.find_line();
        }
        before
    }

    pub fn snapshot(&mut self) -> Snapshot {
        Snapshot { problem: self.prepared.problem.clone(), parameters: self.parameters }
    }

    pub fn go_back(&mut self, snapshot: &Snapshot) {
        // Counts go on.
        let counts = self.prepared.problem.counts();
        self.prepared.problem = snapshot.problem.clone();
        self.prepared.problem.set_counts(counts);
        self.parameters = snapshot.parameters;
        self.laws.clear();
    }

    /// Lets the mesh grow with the forces; the direction in the new layout if that has changed, else None.
    pub fn renew(&mut self, tangent: &Tangent) -> Option<Tangent> {
        let problem = &mut self.prepared.problem;
        if !problem.wants_segments() {
            if problem.wants_steps() {
                problem.renew();
                self.laws.clear();
            }
            return None;
        }
        self.laws.clear();
        Some(crate::way::cut_anew(problem, tangent))
    }

    /// Makes the steps half as long.
    pub fn finer(&mut self) {
        self.laws.clear();
        self.prepared.problem.halve_steps();
    }

    /// Puts a mesh back that was taken at the present parameters.
    pub fn put_mesh(&mut self, mesh: Mesh) {
        self.laws.clear();
        self.prepared.problem.set_mesh(mesh);
    }

    /// Makes a mesh of another accuracy.
    pub fn refine(&mut self, accuracy: f64) {
        self.laws.clear();
        self.prepared.problem.set_mesh_accuracy(accuracy);
    }
}

impl Problem for Traced<'_> {
    type System = Equilibrium;

    fn system(&mut self) -> &mut Equilibrium {
        &mut self.prepared.problem
    }

    fn parameters(&self) -> Parameters {
        self.parameters
    }

    fn set_parameters(&mut self, values: Parameters) -> Result<(), Refusal> {
        if values == self.parameters {
            // What is driven stands in the state, which may have been another one's.
            let load = self.prepared.problem.load_fraction();
            self.prepared.problem.set_load(load);
            return Ok(());
        }
        if let Some(line) = &self.line {
            line.apply(&mut self.prepared.problem, values[0]);
            let load = self.prepared.problem.load_fraction();
            self.prepared.problem.set_load(load);
            self.parameters = values;
            return Ok(());
        }
        let fits = |kept: &Kept| kept.of == values && (kept.law.is_whole() || kept.beside == self.parameters);
        let law = match self.laws.iter().position(fits) {
            Some(position) => self.laws.swap_remove(position).law,
            None => {
                let list = self.list(values);
                let law = self.family.law_anew(&self.prepared.problem, &list);
                law.map_err(|error| Refusal::Parameter(error.message))?
            }
        };
        let old = self.prepared.problem.exchange(law);
        if self.laws.len() == KEPT {
            self.laws.remove(0);
        }
        self.laws.push(Kept { of: self.parameters, beside: values, law: old });
        self.parameters = values;
        Ok(())
    }

    fn index(&mut self) -> Option<usize> {
        match self.prepared.problem.stability() {
            Ok(Stability::Unstable(count)) => Some(count),
            Ok(Stability::Undecided(reason)) => {
                self.undecided.get_or_insert(reason);
                None
            }
            Err(_) => None,
        }
    }
}
