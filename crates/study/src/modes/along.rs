//! Frequencies along a path of equilibria, followed by their shapes.
//!
//! The path is that of a trace, through folds and past branch points. At each of its points the modes are found, and each carries on
//! that mode of the point before whose shape is most like its own, measured by the mass that moves (the modal assurance criterion of
//! R. J. Allemang, *Sound and Vibration* 37 (2003) 14). So frequencies that cross keep their names, and those that only come near (veer)
//! exchange their shapes gradually.

use super::onset::Sight;
use super::{Aim, Bench, Spectrum, Trouble, explain, onset, reading, refuse, spectrum};
use crate::{ModelFamily, Options, Prepared, ProblemError, TraceProgress, trace};
use flexura_equilibrium::{Equilibrium, Footing};
use flexura_model::{Model, ModesPath, ModesStudy, TraceStudy};
use flexura_nonlinear::{Breakdown, PathOptions};
use flexura_solution::{Followed, ModesAlong, PointKind, Solution, Status, Trace};

/// Sections along each beam of the shapes from which points are found again.
const SECTIONS: usize = 33;
/// Places along each beam at which shapes are compared.
const PLACES: usize = 16;
/// Likeness from which a mode carries on another.
const ALIKE: f64 = 0.3;

/// Natural frequencies along a path of equilibria.
///
/// # Errors
/// As [`trace`], and a mechanism without inertia.
pub fn modes_along(
    model: &Model,
    study: &ModesStudy,
    path: ModesPath,
    options: &Options,
    progress: &mut dyn FnMut(TraceProgress<'_>),
) -> Result<ModesAlong, ProblemError> {
    crate::trace::check_study(model, flexura_model::StudyKind::Modes(*study))?;
    let way = TraceStudy {
        parameter: path.parameter,
        range: path.range,
        start: path.range[0],
        steps: path.steps,
        ..TraceStudy::default()
    };
    let shaped = Options {
        shapes: options.shapes.max(SECTIONS),
        samples: options.samples.max(SECTIONS),
        ..options.clone()
    };
    let mut trace = trace(model, &way, &shaped, &mut |told| progress(told))?;
    let mut walk = Walk { model, study, options, prepared: None, near: None, bench: Bench::default() };
    let mut followed = Vec::with_capacity(trace.branches.len());
    let mut onsets = Vec::with_capacity(trace.branches.len());
    let mut astray = 0;
    for branch in &trace.branches {
        let mut tracks = Tracks::default();
        let mut list = Vec::with_capacity(branch.points.len());
        let mut last: Option<&Solution> = None;
        let mut before: Option<(f64, Sight)> = None;
        let mut met = Vec::new();
        for point in &branch.points {
            if options.interrupt.is_raised() {
                list.push(Vec::new());
                continue;
            }
            let own = point.solution.as_deref().or(point.shape.as_deref());
            last = own.or(last);
            let found = match last {
                Some(from) => walk.at(path.parameter, point.parameter, from)?,
                None => None,
            };
            let Some((spectrum, signatures)) = found else {
                list.push(Vec::new());
                continue;
            };
            let row = reading::rates(spectrum);
            let sight = Sight::of(spectrum);
            let counted = point.unstable_directions.filter(|_| spectrum.has_energy);
            astray += usize::from(counted.is_some_and(|counted| counted.min(row.len()) != sight.growing()));
            list.push(tracks.carry_on(row, signatures));
            // At a critical point a mode neither grows nor swings; what sets in there lies between its neighbours.
            if matches!(point.kind, PointKind::Fold | PointKind::Branch(_)) {
                continue;
            }
            if let (Some((value, other)), Some(from)) = (&before, last)
                && sight.growing() != other.growing()
                && *value != point.parameter
            {
                met.extend(onset::locate([*value, point.parameter], [other, &sight], &mut |value| {
                    Ok(walk.at(path.parameter, value, from)?.map(|(spectrum, _)| Sight::of(spectrum)))
                })?);
            }
            before = Some((point.parameter, sight));
        }
        followed.push(list);
        onsets.push(met);
    }
    if options.interrupt.is_raised() && trace.status == Status::Converged {
        trace.status = Status::Interrupted;
        trace.reason = Some("interrupted before all modes were found".to_string());
    }
    warn(&mut trace, &followed, astray);
    Ok(ModesAlong { trace, followed, onsets })
}

fn warn(trace: &mut Trace, followed: &[Vec<Vec<Option<Followed>>>], astray: usize) {
    let points =
        trace.branches.iter().zip(followed).flat_map(|(branch, list)| branch.points.iter().zip(list));
    let missing = points
        .filter(|(point, row)| row.is_empty() && matches!(point.kind, PointKind::Regular | PointKind::End))
        .count();
    if missing > 0 {
        trace.warnings.push(format!("at {missing} points of the path no modes were found"));
    }
    if astray > 0 {
        trace.warnings.push(format!(
            "at {astray} points the number of modes that grow is not that of the unstable directions: they are all but critical"
        ));
    }
}

struct Walk<'a> {
    model: &'a Model,
    study: &'a ModesStudy,
    options: &'a Options,
    prepared: Option<Prepared>,
    /// What was found at the point before.
    near: Option<Spectrum>,
    bench: Bench,
}

/// A spectrum, with the shapes by which its modes are told again.
type Seen<'s> = (&'s Spectrum, Vec<Vec<f64>>);

impl Walk<'_> {
    /// The modes at a value of the parameter, found again from a shape nearby, with what tells their shapes; None where the point is critical.
    fn at(
        &mut self,
        parameter: usize,
        value: f64,
        from: &Solution,
    ) -> Result<Option<Seen<'_>>, ProblemError> {
        use crate::Family;
        let model = ModelFamily::new(self.model).model(&[(parameter, value)])?;
        if let Some(prepared) = &mut self.prepared {
            prepared.adopt(&model)?;
        } else {
            let mut problem = Equilibrium::new(&model)?;
            problem.heed(&self.options.interrupt);
            problem.footing()?;
            problem.rest();
            let mut prepared =
                Prepared { problem, path: PathOptions::default(), border: None, footing: Footing::Firm };
            refuse(prepared.problem())?;
            self.prepared = Some(prepared);
        }
        let Some(prepared) = &mut self.prepared else { return Ok(None) };
        if prepared.solve_near(from, self.options.tolerance).is_none() {
            return Ok(None);
        }
        match spectrum(
            &mut prepared.problem,
            &mut self.bench,
            self.study.count,
            self.near.as_ref(),
            Aim::Frequencies,
        ) {
            Ok(found) => {
                let tell = |wave: &super::Wave| signature(&prepared.problem, &found, &wave.vector[0]);
                let signatures = found.waves.iter().map(tell).collect();
                Ok(Some((&*self.near.insert(found), signatures)))
            }
            Err(Trouble::Breakdown(Breakdown::Interrupted) | Trouble::Missing) => Ok(None),
            Err(trouble) => Err(explain(&trouble)),
        }
    }
}

/// Displacements and turnings at places that do not depend on how beams were cut, weighed by what moves there.
fn signature(problem: &Equilibrium, found: &Spectrum, x: &[f64]) -> Vec<f64> {
    let swing = problem.swing(&found.vibration, x);
    let mut list = Vec::new();
    for (beam, length) in problem.beam_lengths().iter().enumerate() {
        for i in 0..PLACES {
            let s = length * (i as f64 + 0.5) / PLACES as f64;
            let (mass, rotary) = problem.inertia_of(beam, s);
            let twist = swing.beam(beam, s);
            let part = (length / PLACES as f64).sqrt();
            list.extend(twist.linear.iter().map(|value| value * mass.sqrt() * part));
            list.extend(twist.angular.iter().map(|value| value * rotary.sqrt() * part));
        }
    }
    for (body, twist) in problem.model().bodies.iter().zip(&swing.bodies) {
        list.extend(twist.linear.iter().map(|value| value * body.mass.sqrt()));
        list.extend((0..3).map(|i| twist.angular[i] * body.inertia[(i, i)].max(0.0).sqrt()));
    }
    // Masses alone may be all that moves.
    if list.iter().all(|value| *value == 0.0) {
        list.extend(x);
    }
    list
}

/// |a·b|² / |a|²|b|².
fn likeness(a: &[f64], b: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = dot(a, a) * dot(b, b);
    if size > 0.0 { dot(a, b).powi(2) / size } else { 0.0 }
}

/// Shapes by which modes are known again.
#[derive(Default)]
struct Tracks {
    shapes: Vec<Vec<f64>>,
}

impl Tracks {
    /// Gives every mode the place of the one that it carries on, or a new one.
    fn carry_on(&mut self, row: Vec<Followed>, signatures: Vec<Vec<f64>>) -> Vec<Option<Followed>> {
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (i, own) in signatures.iter().enumerate() {
            for (j, shape) in self.shapes.iter().enumerate() {
                pairs.push((likeness(own, shape), i, j));
            }
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut place: Vec<Option<usize>> = vec![None; row.len()];
        let mut taken = vec![false; self.shapes.len()];
        for (alike, i, j) in pairs {
            if alike >= ALIKE && place[i].is_none() && !taken[j] {
                (place[i], taken[j]) = (Some(j), true);
            }
        }
        let mut out = vec![None; self.shapes.len()];
        for ((mode, own), place) in row.into_iter().zip(signatures).zip(place) {
            match place {
                Some(j) => {
                    self.shapes[j] = own;
                    out[j] = Some(mode);
                }
                None => {
                    self.shapes.push(own);
                    out.push(Some(mode));
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flexura_solution::ModeKind;

    fn mode(rate: f64) -> Followed {
        Followed { growth: 0.0, rate, kind: ModeKind::Swinging, error_estimate: 0.0 }
    }

    #[test]
    fn frequencies_that_cross_keep_their_places() {
        let mut tracks = Tracks::default();
        let first = tracks.carry_on(vec![mode(1.0), mode(2.0)], vec![vec![1.0, 0.1], vec![0.0, 1.0]]);
        assert_eq!(first.iter().flatten().map(|mode| mode.rate).collect::<Vec<_>>(), [1.0, 2.0]);
        // The second is the lower one now, and a third appears.
        let shapes = vec![vec![0.1, -1.0], vec![-1.0, 0.0], vec![0.0, 0.0]];
        let second = tracks.carry_on(vec![mode(1.4), mode(1.6), mode(9.0)], shapes);
        assert_eq!(second.iter().flatten().map(|mode| mode.rate).collect::<Vec<_>>(), [1.6, 1.4, 9.0]);
    }
}
