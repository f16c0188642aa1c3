//! What the page asks, and what it is told. SI units; places in metres, global axes.

use crate::grip::GripDocument;
use crate::problems::{ProblemDocument, Trouble};
use crate::ranges::range_of;
use crate::session::Session;
use flexura::model::StudyKind;
use flexura::output::{BucklingDocument, Document, InverseDynamicsDocument, ModesDocument, TraceDocument};
use serde::{Deserialize, Serialize};

/// Samples along each beam unless a request says otherwise, as `flexura solve` has them.
const SAMPLES: usize = 101;

fn samples() -> usize {
    SAMPLES
}

/// One request.
#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    /// Understands a text as a model file. What was open stays open where something is wrong with it.
    Open {
        /// The model file.
        text: String,
        /// How messages call it.
        name: String,
        /// Parameters by name, with values as they are typed.
        #[serde(default)]
        set: Vec<(String, String)>,
        /// Are the file's unknowns to be found? Else they keep the values of the file.
        #[serde(default = "yes")]
        inverse: bool,
    },
    /// The equilibrium from rest.
    Solve {
        /// Samples along each beam.
        #[serde(default = "samples")]
        samples: usize,
    },
    /// The equilibrium for other values of parameters, from where it stands.
    Step {
        /// Parameters by name, SI.
        #[serde(default)]
        values: Vec<(String, f64)>,
        /// Parameters by name, with values as they are typed.
        #[serde(default)]
        set: Vec<(String, String)>,
        /// Samples along each beam; zero for no document.
        #[serde(default = "samples")]
        samples: usize,
    },
    /// What can be dragged.
    Grips {},
    /// Moves a grip to where the pointer is, or as near as it gets.
    Drag {
        /// Position in the list of grips.
        grip: usize,
        /// A point under the pointer.
        to: [f64; 3],
        /// Unit vector of the line of sight through it.
        eye: [f64; 3],
        /// Samples along each beam.
        #[serde(default = "samples")]
        samples: usize,
    },
    /// Forces that were dragged get their values of the file again.
    Release {},
    /// A study of the file.
    Study {
        /// Its name.
        name: String,
    },
    /// The path of equilibria as a parameter changes.
    Trace {
        /// Its name.
        parameter: String,
        /// From where to where, SI.
        range: [f64; 2],
    },
    /// Is the present equilibrium stable, and which loads are critical?
    Stability {},
}

fn yes() -> bool {
    true
}

/// The answer to any request; fields that say nothing are left out.
#[derive(Default, Serialize)]
pub struct Answer {
    /// What is wrong, or looks so. Where anything is wrong, nothing else was done.
    pub problems: Vec<ProblemDocument>,
    /// What was opened.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub opened: Option<Opened>,
    /// A result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub document: Option<AnyDocument>,
    /// How the result was come by.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub way: Option<Way>,
    /// Why the equilibrium that was asked for is not shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Is what is dragged where the pointer is?
    #[serde(skip_serializing_if = "Option::is_none")]
    pub is_there: Option<bool>,
    /// Values of all parameters now, SI.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub values: Option<Vec<(String, f64)>>,
    /// What can be dragged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grips: Option<Vec<GripDocument>>,
}

impl From<Trouble> for Answer {
    fn from(trouble: Trouble) -> Self {
        Self { problems: trouble.0, ..Self::default() }
    }
}

/// How an equilibrium was come by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// From the one before, which changed gradually.
    Near,
    /// Nothing was near: from rest.
    Rest,
    /// There is none: the one before is kept.
    Kept,
}

/// The documents, as `--json` prints them.
#[derive(Serialize)]
#[serde(untagged)]
pub enum AnyDocument {
    /// Of a solve.
    Solve(Box<Document>),
    /// Of a path.
    Trace(Box<TraceDocument>),
    /// Of critical loads.
    Buckling(Box<BucklingDocument>),
    /// Natural modes.
    Modes(Box<ModesDocument>),
    /// Of a motion in time.
    InverseDynamics(Box<InverseDynamicsDocument>),
}

/// What a page needs to know about a model that was opened.
#[derive(Serialize)]
pub struct Opened {
    /// The model's title.
    pub model: String,
    /// Its parameters.
    pub parameters: Vec<ParameterDocument>,
    /// Its studies: name and kind.
    pub studies: Vec<(String, &'static str)>,
    /// Has it unknowns that a solve finds?
    pub has_unknowns: bool,
}

/// A parameter with a range in which moving it makes sense.
#[derive(Serialize)]
pub struct ParameterDocument {
    name: String,
    value: f64,
    unit: String,
    range: [f64; 2],
    is_found: bool,
    /// Does it decide of which parts the mechanism is made? Then it is moved in whole steps.
    is_structural: bool,
}

impl Opened {
    /// Of a session.
    pub fn of(session: &Session) -> Self {
        let model = &session.base;
        let parameters = model.parameters.iter().enumerate().map(|(i, parameter)| ParameterDocument {
            name: parameter.name.clone(),
            value: parameter.value,
            unit: parameter.unit.clone(),
            range: range_of(session, i),
            is_structural: parameter.is_structural,
            is_found: model.unknowns.iter().any(|unknown| unknown.parameter == i),
        });
        let word = |kind: &StudyKind| kind.word();
        Self {
            model: model.name.clone(),
            parameters: parameters.collect(),
            studies: model.studies.iter().map(|study| (study.name.clone(), word(&study.kind))).collect(),
            has_unknowns: session.has_unknowns,
        }
    }
}
