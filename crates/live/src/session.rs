//! A model that is open: its text, the values of its parameters, and the equilibrium at which it stands.

use crate::grip::{Grasp, Grip};
use crate::problems::{ProblemDocument, Trouble};
use crate::request::{Answer, AnyDocument, Way};
use flexura::model::{CoordinateLaw, Drive, Model};
use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::spatial::Vector3;
use flexura::{ModelFamily, Options, Outcome, Prepared, output, post};

/// Shortest part of a change of values that is tried before an equilibrium is looked for from rest.
const SHORTEST: f64 = 1.0 / 256.0;
/// Most parts of one change.
const MOST_PARTS: usize = 64;
/// Relative change of a parameter by which is found out what depends on it.
const LITTLE: f64 = 1e-3;

/// What can be moved: parameters by name, SI, and dragged forces by the position of their load, N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    pub values: Vec<(String, f64)>,
    pub forces: Vec<(usize, Vector3<f64>)>,
}

impl Place {
    /// Gives a parameter a value.
    pub fn set(&mut self, name: &str, value: f64) {
        self.values.retain(|(other, _)| other != name);
        self.values.push((name.to_owned(), value));
    }

    /// Gives a load a force.
    pub fn push(&mut self, load: usize, force: Vector3<f64>) {
        self.forces.retain(|(other, _)| *other != load);
        self.forces.push((load, force));
    }
}

/// An equilibrium, or how far the way to it led.
#[derive(Clone)]
pub struct Standing {
    pub prepared: Prepared,
    pub outcome: Outcome,
}

impl Standing {
    pub fn is_converged(&self) -> bool {
        self.outcome.status == Status::Converged
    }
}

/// The open model.
pub struct Session {
    pub file: Document,
    /// The model as the file gives it.
    source: Model,
    /// The model at the present values.
    pub base: Model,
    pub options: Options,
    pub has_unknowns: bool,
    pub standing: Option<Standing>,
    pub place: Place,
    pub grips: Vec<Grip>,
    pub grasp: Option<Grasp>,
    typed: Vec<(String, String)>,
    is_inverse: bool,
}

impl Session {
    /// Understands a text and prepares what it describes.
    pub fn open(text: &str, name: &str, set: &[(String, String)], is_inverse: bool) -> Result<Self, Trouble> {
        let file = Document::parse(text, name).map_err(|report| Trouble::of_report(&report, text))?;
        let mut source = file.model(set).map_err(|report| Trouble::of_report(&report, text))?;
        let has_unknowns = !source.unknowns.is_empty();
        if !is_inverse {
            forget_unknowns(&mut source);
        }
        let base = source.clone();
        // What is loose or held twice shows here, before anything is solved.
        Prepared::new(&base).map_err(|error| Trouble::of_model(&file, &error))?;
        Ok(Self {
            file,
            source,
            base,
            options: Options::default(),
            has_unknowns,
            standing: None,
            place: Place::default(),
            grips: Vec::new(),
            grasp: None,
            typed: set.to_vec(),
            is_inverse,
        })
    }

    /// What looks unintended in the text.
    pub fn warnings(&self) -> Vec<ProblemDocument> {
        self.file.warnings().iter().map(|problem| ProblemDocument::new(problem, self.file.text())).collect()
    }

    /// The present values as the file's family takes them.
    pub fn overrides(&self) -> Vec<(String, String)> {
        self.overrides_at(&self.place)
    }

    fn overrides_at(&self, place: &Place) -> Vec<(String, String)> {
        let mut overrides = self.typed.clone();
        for (name, value) in &place.values {
            let unit = self.base.parameters.iter().find(|own| own.name == *name).map(|own| own.unit.as_str());
            overrides.retain(|(other, _)| other != name);
            overrides.push((name.clone(), format!("{value:e} {}", unit.unwrap_or_default())));
        }
        overrides
    }

    /// The model at other values: its numbers follow from the parameters. Where more than numbers does, the text is read again.
    pub fn model_at(&self, place: &Place) -> Result<Model, Trouble> {
        let position = |name: &str| self.source.parameters.iter().position(|own| own.name == name);
        let values = place.values.iter().filter_map(|(name, value)| Some((position(name)?, *value)));
        let mut model = match self.source.at(&values.collect::<Vec<_>>()) {
            Ok(model) => model,
            Err(_) => self.read_at(place)?,
        };
        for (load, force) in &place.forces {
            if let Some(load) = model.loads.get_mut(*load) {
                load.force = *force;
            }
        }
        Ok(model)
    }

    /// The same from the text.
    fn read_at(&self, place: &Place) -> Result<Model, Trouble> {
        let mut model = self
            .file
            .model(&self.overrides_at(place))
            .map_err(|report| Trouble::of_report(&report, self.file.text()))?;
        if !self.is_inverse {
            forget_unknowns(&mut model);
        }
        Ok(model)
    }

    /// The model at the present values, nothing in it to be found.
    pub fn plain_model(&self) -> Model {
        let mut model = self.base.clone();
        forget_unknowns(&mut model);
        model
    }

    /// L (m) and EI/L² (N) of the mechanism.
    pub fn units(&self) -> (f64, f64) {
        let here = self.standing.as_ref().map(|standing| standing.prepared.clone());
        here.or_else(|| Prepared::new(&self.base).ok()).map_or((1.0, 1.0), |mut here| here.problem().units())
    }

    /// The equilibrium from rest.
    pub fn solve(&mut self, samples: usize) -> Result<Answer, Trouble> {
        let model = self.model_at(&self.place)?;
        let standing = self.cold(&model)?;
        self.stand(standing, self.place.clone());
        Ok(Answer { way: Some(Way::Rest), ..self.answer(samples)? })
    }

    /// The equilibrium at other values, from where it stands.
    pub fn step(
        &mut self,
        values: &[(String, f64)],
        typed: &[(String, String)],
        samples: usize,
    ) -> Result<Answer, Trouble> {
        let mut wanted = self.place.clone();
        values.iter().for_each(|(name, value)| wanted.set(name, *value));
        for (name, value) in self.read(typed)? {
            wanted.set(&name, value);
        }
        self.grasp = None;
        let (way, reason) = self.go(wanted)?;
        Ok(Answer { way: Some(way), reason, ..self.answer(samples)? })
    }

    /// The file's own forces again.
    pub fn release(&mut self) -> Result<Answer, Trouble> {
        let wanted = Place { forces: Vec::new(), ..self.place.clone() };
        self.grasp = None;
        let (way, reason) = self.go(wanted)?;
        Ok(Answer { way: Some(way), reason, ..self.answer(self.options.samples)? })
    }

    /// Values of parameters that were typed, SI.
    fn read(&self, typed: &[(String, String)]) -> Result<Vec<(String, f64)>, Trouble> {
        if typed.is_empty() {
            return Ok(Vec::new());
        }
        let mut overrides = self.overrides();
        overrides.retain(|(name, _)| typed.iter().all(|(other, _)| other != name));
        overrides.extend(typed.iter().cloned());
        let model =
            self.file.model(&overrides).map_err(|report| Trouble::of_report(&report, self.file.text()))?;
        let value = |name: &str| model.parameters.iter().find(|own| own.name == name).map(|own| own.value);
        Ok(typed.iter().filter_map(|(name, _)| Some((name.clone(), value(name)?))).collect())
    }

    /// Moves to other values: in one step, in several, or, where nothing is near, from rest. Where there is no equilibrium it
    /// stays where it is, and says why.
    pub fn go(&mut self, wanted: Place) -> Result<(Way, Option<String>), Trouble> {
        let model = self.model_at(&wanted)?;
        if let Some(start) = self.standing.as_ref().filter(|standing| standing.is_converged())
            && let Some(standing) = self.near(start, &wanted, &model)
        {
            self.stand(standing, wanted);
            return Ok((Way::Near, None));
        }
        let standing = self.cold(&model)?;
        let reason = standing.outcome.reason.clone();
        if standing.is_converged() || self.standing.as_ref().is_none_or(|before| !before.is_converged()) {
            self.stand(standing, wanted);
            return Ok((Way::Rest, reason));
        }
        Ok((Way::Kept, reason))
    }

    fn stand(&mut self, mut standing: Standing, place: Place) {
        self.base = standing.prepared.problem().model().clone();
        self.standing = Some(standing);
        self.place = place;
    }

    /// From rest.
    fn cold(&self, model: &Model) -> Result<Standing, Trouble> {
        let mut prepared = Prepared::new(model).map_err(|error| Trouble::of_model(&self.file, &error))?;
        let tolerance = self.options.tolerance;
        let outcome = if model.unknowns.is_empty() {
            prepared.solve(tolerance, &mut |_| {})
        } else {
            prepared.solve_inverse(&mut ModelFamily::new(model), tolerance, &mut |_| {})
        };
        Ok(Standing { prepared, outcome })
    }

    /// From an equilibrium to the one at other values, in as few parts as the way needs.
    fn near(&self, start: &Standing, wanted: &Place, whole: &Model) -> Option<Standing> {
        let mut here: Option<Standing> = None;
        let from = self.now(wanted);
        let (mut part, mut step) = (0.0, 1.0_f64);
        for _ in 0..MOST_PARTS {
            let next = (part + step).min(1.0);
            let at = mixed(&from, wanted, next);
            let between = if next < 1.0 { Some(self.model_at(&at).ok()?) } else { None };
            let mut ahead = here.as_ref().unwrap_or(start).clone();
            if self.put(&mut ahead, between.as_ref().unwrap_or(whole)) {
                if next >= 1.0 {
                    return Some(ahead);
                }
                (here, part, step) = (Some(ahead), next, 2.0 * step);
            } else {
                step *= 0.5;
                if step < SHORTEST {
                    return None;
                }
            }
        }
        None
    }

    /// Puts a neighbouring model under a state and corrects that; false where no equilibrium is near.
    pub fn put(&self, standing: &mut Standing, model: &Model) -> bool {
        let tolerance = self.options.tolerance;
        let Standing { prepared, outcome } = standing;
        if model.unknowns.is_empty() {
            if prepared.adopt(model).is_err() {
                return false;
            }
            *outcome = prepared.solve_near_here(tolerance);
        } else {
            *outcome = prepared.solve_inverse_from_here(&mut ModelFamily::new(model), tolerance);
        }
        outcome.status == Status::Converged
    }

    /// The present values of what another place names.
    fn now(&self, wanted: &Place) -> Place {
        let value = |name: &str| {
            let own = self.base.parameters.iter().find(|own| own.name == name);
            own.map_or(f64::NAN, |own| own.value)
        };
        let force = |load: usize| self.base.loads.get(load).map_or_else(Vector3::zeros, |load| load.force);
        let mut now = Place::default();
        wanted.values.iter().for_each(|(name, _)| now.set(name, value(name)));
        wanted.forces.iter().for_each(|(load, _)| now.push(*load, force(*load)));
        now
    }

    /// The present equilibrium as an answer, with a document unless nobody wants samples.
    pub fn answer(&mut self, samples: usize) -> Result<Answer, Trouble> {
        let values = self.base.parameters.iter().map(|own| (own.name.clone(), own.value)).collect();
        let document = if samples == 0 { None } else { Some(self.document(samples)?) };
        Ok(Answer { values: Some(values), document, ..Answer::default() })
    }

    fn document(&mut self, samples: usize) -> Result<AnyDocument, Trouble> {
        let Some(standing) = &mut self.standing else {
            return Err(Trouble::plain("nothing was solved yet".to_owned()));
        };
        let model = &self.base;
        let options = Options { samples, ..self.options.clone() };
        let mut solution = standing.prepared.told(&standing.outcome, &options);
        let evaluation = post::evaluate_each(model, &solution);
        if standing.is_converged() {
            solution.warnings.extend(post::large_strain(model, &solution, &evaluation));
        }
        solution.warnings.extend(evaluation.without_value.iter().map(ToString::to_string));
        let mut document = output::document(model, &solution, &evaluation)
            .map_err(|error| Trouble::plain(error.to_string()))?;
        document.scene.text = Some(self.file.text().to_owned());
        Ok(AnyDocument::Solve(Box::new(document)))
    }

    /// The state with few samples.
    pub fn glance(standing: &mut Standing, samples: usize, beam: Option<usize>) -> Solution {
        standing.prepared.problem().sampled(samples, false, |own| Some(own) == beam)
    }

    /// The loads, drives and targets that depend on a parameter; None where something else does too.
    pub fn change(&self, parameter: usize) -> Option<Vec<Moved>> {
        let own = &self.base.parameters[parameter];
        let mut place = self.place.clone();
        place.set(&own.name, if own.value == 0.0 { LITTLE } else { own.value * (1.0 + LITTLE) });
        // Both from the file: the present model has the values found of its unknowns.
        let (before, after) = (self.model_at(&self.place).ok()?, self.model_at(&place).ok()?);
        moved(&before, &after)
    }
}

/// Something that loads or drives a mechanism, by its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moved {
    /// A point load.
    Load(usize),
    /// A coordinate of a joint.
    Joint(usize, usize),
    /// A coordinate of the hold at a beam's start (false) or end (true).
    Hold(usize, bool, usize),
    /// The value of a target of an inverse problem.
    Target(usize),
}

/// What loads or drives two models differently; None where they differ in anything else.
fn moved(a: &Model, b: &Model) -> Option<Vec<Moved>> {
    if (a.loads.len(), a.joints.len(), a.beams.len()) != (b.loads.len(), b.joints.len(), b.beams.len()) {
        return None;
    }
    let targets = a.targets.iter().zip(&b.targets).enumerate();
    let mut list: Vec<Moved> =
        targets.filter(|(_, (a, b))| a.value != b.value).map(|(i, _)| Moved::Target(i)).collect();
    let mut b = b.clone();
    for (i, (a, b)) in a.loads.iter().zip(&mut b.loads).enumerate() {
        if (a.force, a.moment) != (b.force, b.moment) {
            list.push(Moved::Load(i));
            (b.force, b.moment) = (a.force, a.moment);
        }
    }
    for (i, (a, b)) in a.joints.iter().zip(&mut b.joints).enumerate() {
        let changed = level_drives(&a.law.coordinates, &mut b.law.coordinates);
        list.extend(changed.into_iter().map(|k| Moved::Joint(i, k)));
    }
    for (i, (a, b)) in a.beams.iter().zip(&mut b.beams).enumerate() {
        for (is_end, a, b) in [(false, &a.start, &mut b.start), (true, &a.end, &mut b.end)] {
            if let (Some(a), Some(b)) = (a, b) {
                let changed = level_drives(&a.hold.coordinates, &mut b.hold.coordinates);
                list.extend(changed.into_iter().map(|k| Moved::Hold(i, is_end, k)));
            }
        }
    }
    let same = a.gravity == b.gravity
        && a.materials == b.materials
        && a.sections == b.sections
        && a.beams == b.beams
        && a.bodies == b.bodies
        && a.joints == b.joints
        && a.couplings == b.couplings
        && a.springs == b.springs
        && a.cables == b.cables
        && a.tubes == b.tubes
        && a.masses == b.masses
        && a.loads == b.loads;
    same.then_some(list)
}

/// Gives coordinates the drives of others; the positions of those that differed.
fn level_drives(a: &[CoordinateLaw], b: &mut [CoordinateLaw]) -> Vec<usize> {
    let pairs = a.iter().zip(b).enumerate();
    pairs.filter_map(|(k, (a, b))| level_drive(a, b).then_some(k)).collect()
}

/// Gives the second law the drive of the first; true where they differed.
fn level_drive(a: &CoordinateLaw, b: &mut CoordinateLaw) -> bool {
    let is_other = match (a.drive, b.drive) {
        (Drive::Free { effort: a }, Drive::Free { effort: b }) => a != b,
        (Drive::Driven { coordinate: a }, Drive::Driven { coordinate: b }) => a != b,
        _ => return false,
    };
    if is_other {
        b.drive = a.drive;
    }
    is_other
}

/// A part of the way from one place to another.
fn mixed(from: &Place, to: &Place, part: f64) -> Place {
    let mix = |a: f64, b: f64| if part >= 1.0 { b } else { a + part * (b - a) };
    let values = from.values.iter().zip(&to.values);
    let forces = from.forces.iter().zip(&to.forces);
    Place {
        values: values.map(|((_, a), (name, b))| (name.clone(), mix(*a, *b))).collect(),
        forces: forces.map(|((_, a), (load, b))| (*load, a.zip_map(b, mix))).collect(),
    }
}

fn forget_unknowns(model: &mut Model) {
    (model.unknowns, model.targets) = (Vec::new(), Vec::new());
}
