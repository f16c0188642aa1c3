//! What a design optimisation returns.

use crate::{Solution, Status};

/// Designs that were found, and what was tried on the way.
#[derive(Clone, Debug)]
pub struct Optimisation {
    /// How it ended: infeasible where no start led to a design that meets all conditions.
    pub status: Status,
    /// Why it did not converge, and what to try.
    pub reason: Option<String>,
    /// Things a user should know.
    pub warnings: Vec<String>,
    /// The best design that meets all conditions; where there is none, that which misses them least.
    pub best: Option<Design>,
    /// Each start's end, in their order.
    pub starts: Vec<StartEnd>,
    /// The compromises between two objectives, from the best of the first to the best of the second.
    pub front: Vec<Design>,
    /// Designs that were left out because they have no values: the first few, and how many there were.
    pub left_out: Vec<LeftOut>,
    /// How many designs were left out.
    pub left_out_count: usize,
    /// Work counters.
    pub work: DesignWork,
    /// The equilibrium of the best design.
    pub solution: Option<Box<Solution>>,
}

/// A design with what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// Values of the parameters that may change, SI, in the order of the study.
    pub values: Vec<f64>,
    /// The objective, SI.
    pub objective: f64,
    /// The second objective of a front.
    pub other: Option<f64>,
    /// For each condition of the study the value of what is bounded, SI.
    pub conditions: Vec<f64>,
    /// What is at its bound.
    pub active: Vec<Active>,
    /// Largest miss of a condition, relative to its size; zero where all are met.
    pub violation: f64,
    /// Largest component of the gradient that no bound and no condition holds, relative to the objective's size and the ranges.
    pub stationarity: f64,
    /// Is its equilibrium stable? None where that is not decided or not asked.
    pub stable: Option<bool>,
}

/// What holds a design back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Active {
    /// What it is.
    pub what: Bound,
    /// By how much the objective changes with the bound, SI: d objective / d bound.
    pub rate: f64,
}

/// A bound of a parameter or of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Lower end of the range of a varied parameter, by its position in the study.
    Lower(usize),
    /// Upper end.
    Upper(usize),
    /// `least` of a condition, by its position in the study.
    Least(usize),
    /// `most`.
    Most(usize),
    /// `equals`.
    Equals(usize),
    /// The bound that a point of a front sets to the second objective.
    Other,
}

/// How one search ended.
#[derive(Clone, Debug)]
pub struct StartEnd {
    /// Where it began: values of the parameters that may change, SI.
    pub from: Vec<f64>,
    /// How it ended.
    pub status: Status,
    /// Why it did not converge.
    pub reason: Option<String>,
    /// Where it ended; None where not even the first design has values.
    pub design: Option<Design>,
    /// The designs on the way.
    pub history: Vec<Step>,
}

/// A design on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Values of the parameters that may change, SI.
    pub values: Vec<f64>,
    /// The objective, SI.
    pub objective: f64,
    /// Largest relative miss of a condition.
    pub violation: f64,
}

/// A design without values.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Values of the parameters that may change, SI.
    pub values: Vec<f64>,
    /// Why.
    pub reason: String,
}

/// How much work it was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DesignWork {
    /// Steps of all searches.
    pub iterations: usize,
    /// Designs that were solved.
    pub evaluations: usize,
    /// Designs whose derivatives were taken.
    pub gradients: usize,
    /// Paths that were followed.
    pub paths: usize,
}
