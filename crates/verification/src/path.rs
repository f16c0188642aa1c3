//! Bundled model files, traced the way a user would.

use crate::file::File;
use flexura::{FileFamily, Options};
use flexura_model::{CriticalStudy, Model, Stop, Target, TraceStudy};
use flexura_solution::{Branch, BranchOrigin, CriticalCurve, PointKind, Status, Trace, TracePoint};

/// What is to be followed; names as in the file, values in SI.
#[derive(Clone, Copy, Debug)]
pub struct Path<'a> {
    /// The parameter that changes.
    pub parameter: &'a str,
    /// From where to where.
    pub range: [f64; 2],
    /// Where it starts. None for the first end of the range.
    pub start: Option<f64>,
    /// Least number of steps over the range.
    pub steps: usize,
    /// Most branches besides the first.
    pub branches: usize,
    /// Outputs and the values at which they are wanted.
    pub events: &'a [(&'a str, f64)],
    /// An output and a value at which branches end.
    pub until: Option<(&'a str, f64)>,
    /// The fold at which branches end, counted from 1.
    pub folds: Option<usize>,
    /// Random pushes by which other branches are looked for.
    pub guesses: usize,
    /// A parameter that breaks a symmetry, and from where it is led to its own value.
    pub imperfection: Option<(&'a str, f64)>,
    /// A second parameter, its range, and the number of the critical point to be followed as it changes.
    pub critical: Option<(&'a str, [f64; 2], usize)>,
}

/// A path that was followed to its ends.
pub struct Followed {
    model: Model,
    /// All of it.
    pub trace: Trace,
}

impl<'a> Path<'a> {
    /// The first branch alone, between two values of a parameter.
    pub fn of(parameter: &'a str, range: [f64; 2]) -> Self {
        Self {
            parameter,
            range,
            start: None,
            steps: TraceStudy::default().steps,
            branches: 0,
            events: &[],
            until: None,
            folds: None,
            guesses: 0,
            imperfection: None,
            critical: None,
        }
    }

    fn study(&self, model: &Model) -> Result<TraceStudy, String> {
        let parameter = |name: &str| {
            let found = model.parameters.iter().position(|parameter| parameter.name == name);
            found.ok_or_else(|| format!("no parameter {name}"))
        };
        let target = |(name, value): (&str, f64)| {
            let output = model.outputs.iter().find(|output| output.name == name);
            let output = output.ok_or_else(|| format!("no output {name}"))?.clone();
            Ok::<Target, String>(Target { output, value })
        };
        let mut stops = Vec::new();
        if let Some(until) = self.until {
            stops.push(Stop::Value(target(until)?));
        }
        stops.extend(self.folds.map(Stop::Fold));
        Ok(TraceStudy {
            parameter: parameter(self.parameter)?,
            range: self.range,
            start: self.start.unwrap_or(self.range[0]),
            steps: self.steps,
            branches: self.branches,
            events: self.events.iter().map(|event| target(*event)).collect::<Result<_, _>>()?,
            stops,
            guesses: self.guesses,
            imperfection: match self.imperfection {
                Some((name, from)) => Some((parameter(name)?, from)),
                None => None,
            },
            critical: match self.critical {
                Some((name, range, number)) => {
                    Some(CriticalStudy { parameter: parameter(name)?, range, number })
                }
                None => None,
            },
            ..TraceStudy::default()
        })
    }
}

impl File {
    /// Follows a path, with some parameters (SI) overridden.
    ///
    /// # Errors
    /// The model or the study is wrong, or a branch could not be followed to its end.
    pub fn trace(&self, values: &[(&str, f64)], path: &Path<'_>, tolerance: f64) -> Result<Followed, String> {
        let overrides = Self::overrides(values);
        let model = self.document.model(&overrides).map_err(|report| report.render(false))?;
        let study = path.study(&model)?;
        let mut family = FileFamily::new(&self.document, &overrides, &model);
        let options = Options { tolerance, ..Options::default() };
        let trace = flexura::trace(&model, &mut family, &study, &options, &mut |_| {})
            .map_err(|error| error.to_string())?;
        if trace.status != Status::Converged {
            let reason = trace.reason.as_deref().unwrap_or("no reason given");
            return Err(format!("{} at {values:?}: {reason}", trace.status.word()));
        }
        Ok(Followed { model, trace })
    }
}

impl Followed {
    /// The branch from rest.
    ///
    /// # Errors
    /// There is none.
    pub fn first(&self) -> Result<&Branch, String> {
        self.branch(|origin| origin == BranchOrigin::Rest)
    }

    /// The first branch that comes from such a place.
    ///
    /// # Errors
    /// There is none.
    pub fn branch(&self, wanted: impl Fn(BranchOrigin) -> bool) -> Result<&Branch, String> {
        let mut branches = self.trace.branches.iter();
        branches.find(|branch| wanted(branch.origin)).ok_or_else(|| {
            let origins: Vec<BranchOrigin> = self.trace.branches.iter().map(|branch| branch.origin).collect();
            format!("no such branch among {origins:?}; {:?}", self.trace.warnings)
        })
    }

    /// The branches that cross others.
    pub fn switched(&self) -> Vec<&Branch> {
        let is_switched = |branch: &&Branch| matches!(branch.origin, BranchOrigin::Switched { .. });
        self.trace.branches.iter().filter(is_switched).collect()
    }

    /// The curve of critical points.
    ///
    /// # Errors
    /// There is none.
    pub fn critical(&self) -> Result<&CriticalCurve, String> {
        let curve = self.trace.critical.as_ref();
        curve.ok_or_else(|| format!("no curve of critical points; {:?}", self.trace.warnings))
    }

    /// An output that is a number at a point; NaN if there is none, which no row survives.
    pub fn number(&self, point: &TracePoint, name: &str) -> f64 {
        let position = self.model.outputs.iter().position(|output| output.name == name);
        match position.and_then(|i| point.outputs[i].as_deref()) {
            Some([value]) => *value,
            _ => f64::NAN,
        }
    }
}

/// The points of a kind.
pub fn points(branch: &Branch, wanted: impl Fn(&PointKind) -> bool) -> Vec<&TracePoint> {
    branch.points.iter().filter(|point| wanted(&point.kind)).collect()
}

/// The folds of a branch.
pub fn folds(branch: &Branch) -> Vec<&TracePoint> {
    points(branch, |kind| *kind == PointKind::Fold)
}

/// The branch points of a branch.
pub fn crossings(branch: &Branch) -> Vec<&TracePoint> {
    points(branch, |kind| matches!(kind, PointKind::Branch(_)))
}

/// The points of a branch where the event with that number happens.
pub fn events(branch: &Branch, number: usize) -> Vec<&TracePoint> {
    points(branch, |kind| *kind == PointKind::Event(number))
}
