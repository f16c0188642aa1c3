//! Bundled model files, traced the way a user would.

use crate::Row;
use crate::file::File;
use flexura::Options;
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
        let options = Options { tolerance, ..Options::default() };
        let trace =
            flexura::trace(&model, &study, &options, &mut |_| {}).map_err(|error| error.to_string())?;
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

/// The points of a branch where nothing happens, its ends among them.
fn regular(branch: &Branch) -> impl Iterator<Item = &TracePoint> {
    branch.points.iter().filter(|point| matches!(point.kind, PointKind::Regular | PointKind::End))
}

/// How many regular points of a branch have another count of unstable directions than `unstable` says for their parameter.
pub fn miscounted(branch: &Branch, unstable: impl Fn(f64) -> usize) -> Row {
    let wrong = regular(branch).filter(|point| point.unstable_directions != Some(unstable(point.parameter)));
    Row::vanishing("points where the unstable directions are miscounted", wrong.count() as f64, 0.0)
}

/// A row that holds if the unstable directions along a branch are counted like this, one after the other. Where two of its
/// critical points lie so near each other that no regular point is between them, one count may be left out.
pub fn counted(branch: &Branch, wanted: &[usize]) -> Row {
    let mut counts: Vec<_> = regular(branch).map(|point| point.unstable_directions).collect();
    counts.dedup();
    let mut rest = wanted.iter().map(|count| Some(*count));
    let in_order = counts.iter().all(|count| rest.any(|wanted| wanted == *count));
    let ends = [counts.first(), counts.last()].map(|end| end.copied().flatten());
    let whole = ends == [wanted.first(), wanted.last()].map(|end| end.copied())
        && counts.iter().flatten().max() == wanted.iter().max()
        && counts.len() + 1 >= wanted.len();
    let name = format!("unstable directions along the path are not {wanted:?}");
    Row::vanishing(name, if in_order && whole { 0.0 } else { 1.0 }, 0.0)
}
