//! A design's numbers, and their derivatives by the varied parameters.

use crate::path::{PathReading, SharedPath};
use flexura_model::{Model, OptimiseStudy, Output, Where};
use flexura_solution::{DesignWork, LeftOut, Solution, Status};
use flexura_study::{Evaluator, Options, ProblemError};
use std::cell::RefCell;
use std::rc::Rc;

/// Designs without values that are told one by one.
const TOLD: usize = 20;
/// What a reading is called where it stands among the outputs of a model.
pub(crate) const READING: &str = "reading";
/// Samples of a state of which nothing but the stability is wanted.
const FEWEST: usize = 2;

/// Where a reading comes from.
enum Source {
    /// Position among the outputs of the equilibrium.
    Equilibrium(usize),
    /// Position among the paths.
    Path(usize),
}

/// What a design comes to.
#[derive(Clone, Debug)]
pub(crate) struct Numbers {
    /// For each reading of the study, SI.
    pub values: Vec<f64>,
    /// For each reading, by each varied parameter, SI.
    pub slopes: Option<Vec<Vec<f64>>>,
    /// Is the equilibrium stable? None where that was not asked or is not decided.
    pub stable: Option<bool>,
}

/// Reads designs.
pub(crate) struct Designs<'m> {
    study: &'m OptimiseStudy,
    sources: Vec<Source>,
    /// Of what is read off the equilibrium, as the file writes it.
    names: Vec<String>,
    /// Of the equilibrium; None where nothing is read there.
    evaluator: Option<Evaluator>,
    paths: Vec<PathReading>,
    options: &'m Options,
    pub left_out: Vec<LeftOut>,
    pub left_out_count: usize,
    pub work: DesignWork,
    /// Has a design no verdict on its stability?
    pub undecided: bool,
}

impl<'m> Designs<'m> {
    /// Prepares what a study reads off a model.
    ///
    /// # Errors
    /// The model describes no solvable mechanism.
    pub fn new(model: &Model, study: &'m OptimiseStudy, options: &'m Options) -> Result<Self, ProblemError> {
        let vary: Vec<usize> = study.vary.iter().map(|varied| varied.parameter).collect();
        let mut base = model.clone();
        base.outputs.clear();
        let mut shared: Vec<Rc<RefCell<SharedPath>>> = Vec::new();
        let (mut sources, mut paths, mut names) = (Vec::new(), Vec::new(), Vec::new());
        for reading in study.readings() {
            match &reading.at {
                Where::Equilibrium => {
                    sources.push(Source::Equilibrium(base.outputs.len()));
                    // The text of a formula is no name that an output can have.
                    let name = format!("{READING}_{}", base.outputs.len());
                    base.outputs.push(Output { name, ..reading.output.clone() });
                    names.push(reading.output.name.clone());
                }
                Where::Path { trace, point, .. } => {
                    sources.push(Source::Path(paths.len()));
                    let known = shared.iter().find(|path| path.borrow().is_of(trace, *point)).cloned();
                    let path = known.unwrap_or_else(|| {
                        let path = SharedPath::new(model, trace, *point, options);
                        shared.push(Rc::new(RefCell::new(path)));
                        shared[shared.len() - 1].clone()
                    });
                    paths.push(PathReading::new(path, &reading.output, *point, &study.vary, options));
                }
            }
        }
        let guess: Vec<(usize, f64)> =
            study.vary.iter().map(|varied| (varied.parameter, varied.guess)).collect();
        let evaluator = if base.outputs.is_empty() && !study.stable {
            None
        } else {
            // What is unsound at the guess is told when it is evaluated.
            if base.set(&guess).is_err() || !base.validate_mechanism().is_empty() {
                base = Model { outputs: base.outputs, ..model.clone() };
            }
            let mut evaluator = Evaluator::new(&base, &vary, options.tolerance)?;
            evaluator.heed(&options.interrupt);
            evaluator.go_in_parts();
            Some(evaluator)
        };
        Ok(Self {
            study,
            sources,
            names,
            evaluator,
            paths,
            options,
            left_out: Vec::new(),
            left_out_count: 0,
            work: DesignWork::default(),
            undecided: false,
        })
    }

    pub fn is_interrupted(&self) -> bool {
        self.options.interrupt.is_raised()
    }

    /// The numbers of a design whose equilibrium is reached from rest; None where it is not, or where it does not matter.
    pub fn again_from_rest(&mut self, x: &[f64]) -> Option<Numbers> {
        let evaluator = self.evaluator.as_mut()?;
        evaluator.reset();
        self.numbers(x, false).ok()
    }

    /// The numbers of a design, SI; None where it has none, which is noted with the reason.
    pub fn read(&mut self, x: &[f64], slopes: bool) -> Option<Numbers> {
        let outcome = self.numbers(x, slopes);
        self.work.evaluations += 1;
        self.work.gradients += usize::from(slopes);
        match outcome {
            Ok(numbers) => Some(numbers),
            Err(_) if self.is_interrupted() => None,
            Err(reason) => {
                self.leave_out(x, reason);
                None
            }
        }
    }

    fn leave_out(&mut self, x: &[f64], reason: String) {
        if self.left_out.iter().any(|known| known.values == x) {
            return;
        }
        self.left_out_count += 1;
        if self.left_out.len() < TOLD {
            self.left_out.push(LeftOut { values: x.to_vec(), reason });
        }
    }

    /// Why the last design that has no values has none.
    pub fn last_reason(&self) -> String {
        self.left_out.last().map_or_else(|| "interrupted".to_string(), |left| left.reason.clone())
    }

    fn numbers(&mut self, x: &[f64], slopes: bool) -> Result<Numbers, String> {
        let given: Vec<(usize, f64)> =
            self.study.vary.iter().zip(x).map(|(varied, x)| (varied.parameter, *x)).collect();
        let mut stable = None;
        let (mut values, mut rates) = (Vec::new(), Vec::new());
        if let Some(evaluator) = &mut self.evaluator {
            (values, rates) = at_equilibrium(evaluator, &given, slopes, &self.names)?;
            if self.study.stable {
                let solution = evaluator.solution(FEWEST);
                stable = solution.stable;
                self.undecided |= stable.is_none();
                refuse_unstable(&solution)?;
            }
        }
        let mut numbers = Numbers { values: Vec::new(), slopes: slopes.then(Vec::new), stable };
        for source in &self.sources {
            let (value, slope) = match source {
                Source::Equilibrium(position) => (values[*position], rates.get(*position).cloned()),
                Source::Path(position) => self.paths[*position].read(&given, slopes, &mut self.work)?,
            };
            numbers.values.push(value);
            if let (Some(list), Some(slope)) = (&mut numbers.slopes, slope) {
                list.push(slope);
            }
        }
        Ok(numbers)
    }
}

fn refuse_unstable(solution: &Solution) -> Result<(), String> {
    match solution.unstable_directions {
        Some(count @ 1..) => Err(format!(
            "its equilibrium is unstable in {count} {}",
            if count == 1 { "direction" } else { "directions" }
        )),
        _ => Ok(()),
    }
}

type Read = (Vec<f64>, Vec<Vec<f64>>);

/// All outputs of an equilibrium; reached from the last design, and where that fails, from rest.
pub(crate) fn at_equilibrium(
    evaluator: &mut Evaluator,
    given: &[(usize, f64)],
    slopes: bool,
    names: &[String],
) -> Result<Read, String> {
    let told = |error: ProblemError| format!("{} {}", error.path, error.message).trim().to_string();
    let mut evaluation = evaluator.at(given, slopes).map_err(told)?;
    if evaluation.status != Status::Converged && evaluation.status != Status::Interrupted {
        // An inverse problem has no other way back to rest.
        evaluator.reset();
        evaluation = evaluator.at(given, slopes).map_err(told)?;
    }
    if evaluation.status != Status::Converged {
        let word = evaluation.status.word().replace('_', " ");
        return Err(evaluation.reason.map_or_else(|| word.clone(), |reason| format!("{word}: {reason}")));
    }
    let mut values = Vec::with_capacity(evaluation.values.len());
    for (value, name) in evaluation.values.iter().zip(names) {
        values.push(value.ok_or_else(|| format!("`{name}` has no value"))?);
    }
    let mut rates = Vec::with_capacity(evaluation.slopes.len());
    for (row, name) in evaluation.slopes.iter().zip(names) {
        let row: Option<Vec<f64>> = row.iter().copied().collect();
        rates.push(row.ok_or_else(|| format!("`{name}` has no derivative"))?);
    }
    Ok((values, rates))
}
