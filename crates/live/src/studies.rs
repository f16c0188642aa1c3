//! Paths, critical loads and motions about the present values of the parameters.

use crate::problems::Trouble;
use crate::request::{Answer, AnyDocument};
use crate::session::Session;
use flexura::model::{BuckleStudy, InverseDynamicsStudy, ModesStudy, StudyKind, TraceStudy};
use flexura::{Buckled, Options, ProblemError, Vibrated, motion_view, output};

/// Sections along each beam of the shapes along a path.
const SHAPES: usize = 17;
/// Points of a path that goes straight from one end of the range to the other.
const STEPS: usize = 40;
/// How many critical values are looked for.
const CRITICAL: usize = 3;

impl Session {
    /// A study of the file.
    pub fn study(&mut self, name: &str) -> Result<Answer, Trouble> {
        let study = self.base.studies.iter().find(|study| study.name == name);
        let study = study.ok_or_else(|| Trouble::plain(format!("there is no study `{name}`")))?;
        match study.kind.clone() {
            StudyKind::Solve => self.solve(self.options.samples),
            StudyKind::Trace(study) => self.follow(name, &study),
            StudyKind::Buckle(study) => self.buckle(name, &study),
            StudyKind::Modes(study) => self.vibrate(name, &study),
            StudyKind::InverseDynamics(study) => self.travel(name, &study),
            StudyKind::Fit(_) | StudyKind::Formula(_) | StudyKind::Optimise(_) => {
                Err(Trouble::plain(format!("`{name}` has no states to show; `flexura run` does it")))
            }
        }
    }

    /// The path as a parameter goes through a range, from the present equilibrium's value.
    pub fn trace(&mut self, parameter: &str, range: [f64; 2]) -> Result<Answer, Trouble> {
        let position = self.base.parameters.iter().position(|own| own.name == parameter);
        let position =
            position.ok_or_else(|| Trouble::plain(format!("there is no parameter `{parameter}`")))?;
        let value = self.base.parameters[position].value;
        let start = if range[0] <= value && value <= range[1] { value } else { range[0] };
        let study = TraceStudy { parameter: position, range, start, steps: STEPS, ..TraceStudy::default() };
        self.follow("trace", &study)
    }

    fn follow(&mut self, name: &str, study: &TraceStudy) -> Result<Answer, Trouble> {
        let model = self.plain_model();
        let options = Options { shapes: SHAPES, ..self.options.clone() };
        let trace = flexura::trace(&model, study, &options, &mut |_| {})
            .map_err(|error| self.of_study(name, &error))?;
        let mut document = output::trace_document(&output::TraceView::new(&model, study, &trace))
            .map_err(|error| Trouble::plain(error.to_string()))?;
        if let Some(scene) = &mut document.scene {
            scene.text = Some(self.file.text().to_owned());
        }
        Ok(Answer { document: Some(AnyDocument::Trace(Box::new(document))), ..Answer::default() })
    }

    fn buckle(&mut self, name: &str, study: &BuckleStudy) -> Result<Answer, Trouble> {
        let model = self.plain_model();
        let buckled =
            Buckled::new(&model, study, &self.options).map_err(|error| self.of_study(name, &error))?;
        let mut document = buckled.document().map_err(|error| Trouble::plain(error.to_string()))?;
        document.scene.text = Some(self.file.text().to_owned());
        Ok(Answer { document: Some(AnyDocument::Buckling(Box::new(document))), ..Answer::default() })
    }

    fn vibrate(&mut self, name: &str, study: &ModesStudy) -> Result<Answer, Trouble> {
        let model = self.plain_model();
        let vibrated = Vibrated::new(&model, study, &self.options, &mut |_| {})
            .map_err(|error| self.of_study(name, &error))?;
        let mut document = vibrated.document().map_err(|error| Trouble::plain(error.to_string()))?;
        document.scene.text = Some(self.file.text().to_owned());
        Ok(Answer { document: Some(AnyDocument::Modes(Box::new(document))), ..Answer::default() })
    }

    fn travel(&mut self, name: &str, study: &InverseDynamicsStudy) -> Result<Answer, Trouble> {
        let model = self.plain_model();
        let motion = flexura::inverse_dynamics(&model, study, &self.options, &mut |_| {})
            .map_err(|error| self.of_study(name, &error))?;
        let mut document = output::motion_document(&motion_view(&model, &motion))
            .map_err(|error| Trouble::plain(error.to_string()))?;
        if let Some(scene) = &mut document.scene {
            scene.text = Some(self.file.text().to_owned());
        }
        Ok(Answer { document: Some(AnyDocument::InverseDynamics(Box::new(document))), ..Answer::default() })
    }

    /// Critical loads of the problem linearised about the unloaded mechanism, all loads and drives growing in proportion. Whether the
    /// present equilibrium is stable stands in its own document.
    pub fn stability(&mut self) -> Result<Answer, Trouble> {
        self.buckle("stability", &BuckleStudy { parameter: None, at: 0.0, count: CRITICAL })
    }

    /// What is wrong with the whole of a study is shown at its own table.
    fn of_study(&self, name: &str, error: &ProblemError) -> Trouble {
        let path = if error.path == "study" { format!("study.{name}") } else { error.path.clone() };
        Trouble::of_model(&self.file, &ProblemError { path, ..error.clone() })
    }
}
