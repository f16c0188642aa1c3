//! One branch followed one way: points, what is special on it, and why it ends.

use super::TraceProgress;
use super::ends::{kind, stalled, why_short};
use super::problem::{Snapshot, Traced};
use super::record::{Reader, Reading, crossing, decide, regular};
use flexura_continuation::{Advance, Place, Point, Special, Stall, Tangent, Walker, between, sharpen};
use flexura_model::{Stop, TraceStudy};
use flexura_nonlinear::{Interrupt, System};
use flexura_solution::{BranchEnd, PointKind, TracePoint};

/// A branch point that was met, for later.
#[derive(Clone)]
pub(crate) struct Met {
    /// Position among the leg's points.
    pub at: usize,
    /// None where nothing will start from it.
    pub snapshot: Option<Snapshot>,
    pub point: Point,
    pub branches: Vec<Tangent>,
    pub fold: bool,
    /// Critical directions.
    pub kernel: Vec<Vec<f64>>,
    /// The direction of the path on which it was met.
    pub tangent: Tangent,
}

/// What following came to.
pub(crate) struct Leg {
    pub points: Vec<TracePoint>,
    pub met: Vec<Met>,
    pub end: BranchEnd,
    pub refused: usize,
}

/// What the walker's first point is.
pub(crate) enum First {
    /// The start of the branch.
    Start,
    /// The first point behind a branch point, at which this was read.
    Beyond(Reading),
}

/// How legs are followed.
pub(crate) struct Follower<'s> {
    pub study: &'s TraceStudy,
    pub reader: Reader,
    /// Number of watched quantities that are events; the others are stops.
    pub events: usize,
    pub tolerance: f64,
    pub progress: &'s mut dyn FnMut(TraceProgress<'_>),
    /// Number of the branch, for progress.
    pub branch: usize,
    /// Points of the leg that progress has told of.
    pub told: usize,
    /// Ends the trace once it is raised.
    pub interrupt: Interrupt,
    /// Events and stops that were seen to be passed but could not be placed.
    pub missed: std::cell::Cell<usize>,
    /// What there is to know of the states on the path, with the parameter where each was first said.
    pub remarks: std::cell::RefCell<Vec<(f64, String)>>,
}

/// Regular points between two whose whole state is kept.
const KEPT: usize = 8;
/// A parameter that lies outside its range by so little is at its end.
const EDGE: f64 = 1e-9;
/// The same where nothing can be had at the end itself.
const ARRIVED: f64 = 1e-6;
/// Most tries to find where a quantity has a value.
const TRIES: usize = 60;
/// Accuracy of a mesh beside the tolerance, to begin with.
pub(crate) const FINER: f64 = 0.2;
/// An error that is below this part of the tolerance is found anew at every so many points only.
const SAFE: f64 = 0.05;
const CHECKED: usize = 4;
/// Most refinements at one point.
const REFINEMENTS: usize = 6;

/// By how much half as long steps reduce the error, at least.
const GAIN: f64 = 32.0;

/// Error of a critical point that was found on the path's own mesh only.
const COARSE: f64 = 1e-6;

/// Something on the way between two points.
enum Passed {
    Special(Special),
    Watched(usize, Place),
}

impl Follower<'_> {
    /// Follows from the walker's present point, which is reported first.
    pub fn follow(&mut self, traced: &mut Traced<'_>, walker: &mut Walker, first: First) -> Leg {
        let mut leg = Leg { points: Vec::new(), met: Vec::new(), end: BranchEnd::Range, refused: 0 };
        self.told = 0;
        leg.end = self.walk(traced, walker, first, &mut leg);
        leg.end = self.ended(leg.end);
        self.tell(&leg);
        leg.refused = walker.work().refused;
        leg
    }

    /// Where somebody asked for the end no step succeeds; that is no standstill.
    pub fn ended(&self, end: BranchEnd) -> BranchEnd {
        let is_interrupted = self.interrupt.is_raised() && matches!(end, BranchEnd::Stalled(_));
        if is_interrupted { BranchEnd::Interrupted } else { end }
    }

    fn walk(
        &mut self,
        traced: &mut Traced<'_>,
        walker: &mut Walker,
        first: First,
        leg: &mut Leg,
    ) -> BranchEnd {
        let mut error = match self.check_mesh(traced, walker) {
            Ok(error) => error,
            Err(stall) => return stalled(&stall),
        };
        let mut before = self.read(traced, walker);
        let mut start = walker.here().clone();
        self.remark(traced.axes[0].value(start.point.parameters[0]), &before.warnings);
        let from_start = matches!(first, First::Start);
        let mut point =
            regular(traced.axes[0].value(start.point.parameters[0]), &start, before.clone(), error);
        decide(traced, &mut point);
        match first {
            First::Start => {
                point.kind = PointKind::End;
                self.keep(traced, walker, &mut point);
            }
            First::Beyond(reading) => {
                self.reader.add_shape(traced, &mut point);
                // What lies between the branch point and the first point beyond it.
                let passed = self.watched(traced, walker, &reading, &before, 1.0);
                for (which, place) in passed {
                    if self.report(traced, walker, Passed::Watched(which, place), error, leg) {
                        return BranchEnd::Stop;
                    }
                }
            }
        }
        leg.points.push(point);
        let mut since_kept = 0;
        let mut steps = 0;
        // Where the place stands in the leg that a loop is to come back to, and steps since then.
        let (mut start_at, mut since_start) = (0, 0);
        let begins = start.point.parameters[0];
        let edge = if begins > 0.5 { 1.0 } else { 0.0 };
        let mut away = (begins - edge).abs() > ARRIVED;
        loop {
            let known = leg.points.len();
            if leg.points.len() >= self.study.most_points {
                self.close(traced, walker, leg);
                return BranchEnd::PointLimit;
            }
            let specials = match walker.advance(traced) {
                Advance::To(specials) => specials,
                Advance::Stalled(stall) => {
                    self.close(traced, walker, leg);
                    return self.end_at(traced, walker, leg, &stall, away);
                }
            };
            steps += 1;
            since_start += 1;
            let scaled = walker.here().point.parameters[0];
            let beyond = !(-EDGE..=1.0 + EDGE).contains(&scaled);
            let limit = if scaled > 0.5 { 1.0 } else { 0.0 };
            // The end at which the leg begins is no end before the leg has been away from it.
            away |= (scaled - edge).abs() > ARRIVED;
            let arrives = (scaled - limit).abs() <= EDGE && (away || limit != edge);
            let last = if beyond || arrives {
                match walker.at_parameter(traced, limit) {
                    Ok(place) => Some(place),
                    Err(stall) => {
                        self.close(traced, walker, leg);
                        return self.end_at(traced, walker, leg, &stall, away);
                    }
                }
            } else {
                None
            };
            let reading = match &last {
                Some(_) => self.reader.read(traced),
                None => {
                    if error > SAFE * self.tolerance || steps % CHECKED == 0 {
                        match self.check_mesh(traced, walker) {
                            Ok(found) => error = found,
                            Err(stall) => {
                                self.close(traced, walker, leg);
                                return stalled(&stall);
                            }
                        }
                    }
                    self.read(traced, walker)
                }
            };
            let value = if last.is_some() { limit } else { scaled };
            self.remark(traced.axes[0].value(value), &reading.warnings);
            let inside = |special: &Special| (-EDGE..=1.0 + EDGE).contains(&special.point.parameters[0]);
            let mut passed: Vec<(f64, Passed)> = Vec::new();
            for special in specials.into_iter().filter(inside) {
                let part = walker.part_of(traced, &special.point);
                passed.push((part, Passed::Special(special)));
            }
            let whole = last.as_ref().map_or(1.0, |place| walker.part_of(traced, &place.point));
            for (watched, place) in self.watched(traced, walker, &before, &reading, whole) {
                let part = walker.part_of(traced, &place.point);
                passed.push((part, Passed::Watched(watched, place)));
            }
            passed.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut last_part = None;
            for (part, passed) in passed {
                if let Some(before) = last_part.replace(part) {
                    // A regular point between two others tells what each of them changes.
                    self.report_between(traced, walker, 0.5 * (before + part), error, leg);
                }
                if self.report(traced, walker, passed, error, leg) {
                    return BranchEnd::Stop;
                }
            }
            if self.interrupt.is_raised() {
                return self.interrupted(traced, walker, leg, known);
            }
            // What was passed has led away from the point, and forces there are not those here.
            if last_part.is_some() && walker.here().point.restore(traced).is_ok() {
                let _ = traced.problem().residual();
            }
            if let Some(place) = last {
                let _ = place.point.restore(traced);
                let mut point = regular(traced.axes[0].value(limit), &place, reading, error);
                decide(traced, &mut point);
                point.kind = PointKind::End;
                self.keep(traced, walker, &mut point);
                leg.points.push(point);
                return BranchEnd::Range;
            }
            let here = walker.here().clone();
            if since_start > 3 && walker.passes(traced, &start.point, &start.tangent) {
                if from_start {
                    if let Some(point) = leg.points.get(start_at).cloned() {
                        leg.points.push(TracePoint { arc: here.arc, ..point });
                    }
                } else {
                    // The loop has come back to the branch point behind which the leg began.
                    while leg.points.last().is_some_and(|point| point.kind == PointKind::Regular) {
                        leg.points.pop();
                    }
                }
                return BranchEnd::Closed;
            }
            if start.point.state.len() != here.point.state.len() {
                // Points of another layout cannot be compared; a loop is seen the next time round.
                start = here.clone();
                (start_at, since_start) = (leg.points.len(), 0);
            }
            let mut point = regular(traced.axes[0].value(scaled), &here, reading.clone(), error);
            decide(traced, &mut point);
            since_kept += 1;
            if since_kept == KEPT {
                since_kept = 0;
                self.keep(traced, walker, &mut point);
            } else {
                self.reader.add_shape(traced, &mut point);
            }
            leg.points.push(point);
            self.tell(leg);
            before = reading;
            if self.renew(traced, walker).is_err() {
                self.close(traced, walker, leg);
                return stalled(&Stall::Short);
            }
        }
    }

    /// Tells of the points that are new.
    fn tell(&mut self, leg: &Leg) {
        let found = leg.points.get(self.told..).unwrap_or_default();
        let Some(last) = found.last() else { return };
        let (branch, points, parameter) = (self.branch, leg.points.len(), last.parameter);
        (self.progress)(TraceProgress { branch, points, parameter, found });
        self.told = points;
    }

    /// Takes back what an interrupted step has left behind the `known` points.
    fn interrupted(
        &self,
        traced: &mut Traced<'_>,
        walker: &mut Walker,
        leg: &mut Leg,
        known: usize,
    ) -> BranchEnd {
        leg.points.truncate(known);
        leg.met.retain(|met| met.at < known);
        self.close(traced, walker, leg);
        BranchEnd::Interrupted
    }

    /// Why a leg ends that cannot go on: at the very end of the range there may be no regular point, for a load that goes to nothing can
    /// leave something free.
    fn end_at(
        &self,
        traced: &mut Traced<'_>,
        walker: &Walker,
        leg: &Leg,
        stall: &Stall,
        away: bool,
    ) -> BranchEnd {
        let at = leg.points.last().map_or(0.5, |point| traced.axes[0].scaled(point.parameter));
        if away && at.abs().min((at - 1.0).abs()) <= ARRIVED {
            return BranchEnd::Range;
        }
        match stall {
            Stall::Short => match why_short(traced, walker.here()) {
                Some(why) => BranchEnd::Stalled(why),
                None => stalled(stall),
            },
            Stall::Parameter(_) => stalled(stall),
        }
    }

    /// The mesh follows the forces.
    fn renew(&mut self, traced: &mut Traced<'_>, walker: &mut Walker) -> Result<(), Stall> {
        // Events have led away from the point.
        walker.here().point.restore(traced).map_err(|_| Stall::Short)?;
        traced.problem().weigh();
        let tangent = traced.renew(&walker.here().tangent);
        if tangent.is_some() {
            traced.problem().weigh();
            walker.polish(traced, tangent)?;
        }
        Ok(())
    }

    /// The error of the present point, after the mesh has been refined until it is small enough.
    fn check_mesh(&mut self, traced: &mut Traced<'_>, walker: &mut Walker) -> Result<f64, Stall> {
        let mut best = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let mut step = vec![0.0; traced.problem().unknowns()];
            if traced.problem().mesh_correction(&mut step).is_err() {
                return Err(Stall::Short);
            }
            let error = walker.across(traced.problem(), &step) + 1e-13;
            if error <= self.tolerance || error > 0.5 * best {
                return Ok(error);
            }
            best = error;
            let accuracy = traced.problem().mesh_accuracy() * (0.3 * self.tolerance / error).clamp(1e-4, 0.5);
            traced.refine(accuracy);
            walker.polish(traced, None)?;
        }
        Ok(best)
    }

    fn read(&self, traced: &mut Traced<'_>, walker: &mut Walker) -> Reading {
        if traced.prepared.asks_for_tangents() {
            walker.disturbed();
        }
        self.reader.read(traced)
    }

    /// Keeps warnings of a point on the path, each kind once.
    fn remark(&self, value: f64, warnings: &[String]) {
        let mut remarks = self.remarks.borrow_mut();
        for warning in warnings {
            if !remarks.iter().any(|(_, known)| kind(known) == kind(warning)) {
                remarks.push((value, warning.clone()));
            }
        }
    }

    /// Adds the whole state to a point at which the problem stands.
    fn keep(&self, traced: &mut Traced<'_>, walker: &mut Walker, point: &mut TracePoint) {
        if traced.prepared.asks_for_tangents() {
            walker.disturbed();
        }
        let solution = self.reader.whole(traced, point.unstable_directions, point.error_estimate);
        point.solution = Some(Box::new(solution));
    }

    /// The last point is the end: it is kept as a whole.
    fn close(&self, traced: &mut Traced<'_>, walker: &mut Walker, leg: &mut Leg) {
        let Some(point) = leg.points.last_mut() else { return };
        if point.kind == PointKind::Regular && walker.here().point.restore(traced).is_ok() {
            point.kind = PointKind::End;
            if point.solution.is_none() {
                self.keep(traced, walker, point);
            }
        }
    }

    /// Where watched quantities pass their values in the last step, up to `whole` of it.
    fn watched(
        &self,
        traced: &mut Traced<'_>,
        walker: &mut Walker,
        before: &Reading,
        after: &Reading,
        whole: f64,
    ) -> Vec<(usize, Place)> {
        let mut found = Vec::new();
        for (i, pair) in before.left.iter().zip(&after.left).enumerate() {
            let (Some(a), Some(b)) = pair else { continue };
            // Zero at the start of a step, up to round-off, was seen at the end of the one before.
            if (a * b >= 0.0 && *b != 0.0) || a.abs() <= 1e-12 * b.abs() {
                continue;
            }
            match self.zero(traced, walker, i, (*a, *b), whole) {
                Some(place) => found.push((i, place)),
                None => self.missed.set(self.missed.get() + 1),
            }
        }
        found
    }

    /// The place within the last step where a watched quantity has its value, by the Illinois rule.
    fn zero(
        &self,
        traced: &mut Traced<'_>,
        walker: &mut Walker,
        which: usize,
        (mut fa, mut fb): (f64, f64),
        whole: f64,
    ) -> Option<Place> {
        let size = fa.abs().max(fb.abs());
        let (mut a, mut b) = (0.0, whole);
        let mut side = 0;
        let mut best = None;
        for _ in 0..TRIES {
            let part = (a * fb - b * fa) / (fb - fa);
            if walker.glance(traced, part).is_err() {
                walker.between(traced, part).ok()?;
            }
            let f = self.read(traced, walker).left[which]?;
            best = Some(part);
            if f.abs() <= 1e-13 * size || (b - a).abs() < 1e-13 {
                break;
            }
            if f * fb > 0.0 {
                (b, fb) = (part, f);
                if side == 1 {
                    fa *= 0.5;
                }
                side = 1;
            } else {
                (a, fa) = (part, f);
                if side == -1 {
                    fb *= 0.5;
                }
                side = -1;
            }
        }
        walker.between(traced, best?).ok()
    }

    /// Reports what was passed; true if the leg stops there.
    fn report(
        &self,
        traced: &mut Traced<'_>,
        walker: &mut Walker,
        mut passed: Passed,
        mut error: f64,
        leg: &mut Leg,
    ) -> bool {
        walker.disturbed();
        let part = match &passed {
            Passed::Special(special) => walker.part_of(traced, &special.point),
            Passed::Watched(_, place) => walker.part_of(traced, &place.point),
        };
        let mut mesh = None;
        if let Passed::Special(special) = &mut passed {
            // The walk goes on with the mesh that it has here.
            if walker.here().point.restore(traced).is_ok() {
                mesh = Some(traced.problem().mesh());
            }
            error = self.sharpened(traced, special);
        }
        let (at, kind, index) = match &passed {
            Passed::Special(special) => {
                let kind = special.crossing.map_or(PointKind::Fold, |met| PointKind::Branch(crossing(met)));
                (&special.point, kind, None)
            }
            Passed::Watched(i, place) if *i < self.events => {
                (&place.point, PointKind::Event(*i), place.index)
            }
            Passed::Watched(_, place) => (&place.point, PointKind::End, place.index),
        };
        if at.restore(traced).is_err() {
            return false;
        }
        let reading = self.reader.read(traced);
        let arc = walker.arc_at(part);
        let mut point = TracePoint {
            parameter: traced.axes[0].value(at.parameters[0]),
            arc,
            kind,
            outputs: reading.values.outputs,
            output_reasons: reading.values.reasons,
            error_estimate: error,
            stable: index.map(|count| count == 0),
            unstable_directions: index,
            solution: None,
            shape: None,
            directions: Vec::new(),
        };
        self.keep(traced, walker, &mut point);
        if let Passed::Special(special) = &passed {
            point.directions =
                special.kernel.iter().map(|step| self.reader.direction(traced.problem(), step)).collect();
            leg.met.push(Met {
                at: leg.points.len(),
                snapshot: (self.study.branches > 0 || self.study.critical.is_some())
                    .then(|| traced.snapshot()),
                point: special.point.clone(),
                branches: special.branches.clone(),
                fold: special.crossing.is_none(),
                kernel: special.kernel.clone(),
                tangent: walker.here().tangent.clone(),
            });
        }
        leg.points.push(point);
        if let Some(mesh) = mesh
            && walker.here().point.restore(traced).is_ok()
        {
            traced.put_mesh(mesh);
        }
        self.stops(&passed, leg)
    }

    /// Finds a critical point again on finer meshes, until it stands still; the error that is left. Where a tangent loses its
    /// rank depends on the mesh even where the state does not.
    fn sharpened(&self, traced: &mut Traced<'_>, special: &mut Special) -> f64 {
        let mut error = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            traced.finer();
            let Ok(found) = sharpen(traced, special) else { return error.min(COARSE) };
            let moved = between(traced, &special.point, &found.point).size(traced.problem());
            *special = found;
            error = moved / GAIN + 1e-13;
            if error <= self.tolerance {
                break;
            }
        }
        error
    }

    /// Reports the regular point at a part of the last step.
    fn report_between(
        &self,
        traced: &mut Traced<'_>,
        walker: &mut Walker,
        part: f64,
        error: f64,
        leg: &mut Leg,
    ) {
        if let Ok(place) = walker.between(traced, part) {
            let reading = self.read(traced, walker);
            let value = traced.axes[0].value(place.point.parameters[0]);
            let mut point = TracePoint { arc: walker.arc_at(part), ..regular(value, &place, reading, error) };
            decide(traced, &mut point);
            self.reader.add_shape(traced, &mut point);
            leg.points.push(point);
        }
    }

    /// Is the last point of the leg one at which it is to stop?
    fn stops(&self, passed: &Passed, leg: &Leg) -> bool {
        if let Passed::Watched(i, _) = passed
            && *i >= self.events
        {
            return true;
        }
        let count =
            |wanted: &dyn Fn(&PointKind) -> bool| leg.points.iter().filter(|p| wanted(&p.kind)).count();
        let last = leg.points.last().map(|p| &p.kind);
        self.study.stops.iter().any(|stop| match stop {
            Stop::Value(_) => false,
            Stop::Fold(n) => last == Some(&PointKind::Fold) && count(&|k| *k == PointKind::Fold) >= *n,
            Stop::Branch(n) => {
                let is_branch = |k: &PointKind| matches!(k, PointKind::Branch(_));
                last.is_some_and(is_branch) && count(&is_branch) >= *n
            }
            Stop::Event(n) => count(&|k| !matches!(k, PointKind::Regular | PointKind::End)) >= *n,
        })
    }
}
