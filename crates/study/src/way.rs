//! The way from one load to the full one: quick steps where the path is plain, and pseudo-arclength where it is not.
//!
//! `nonlinear::follow_on` takes the steps as long as the path is plain. Where it is blocked, a walker of `continuation` takes over
//! on a fine mesh: it passes branch points straight on, finds folds, and hands back once it is well beyond.

use crate::Progress;
use crate::ending::Ending;
use flexura_continuation::{Advance, Parameters, Problem, Refusal, Special, Tangent, WalkOptions, Walker};
use flexura_equilibrium::{Equilibrium, Stability};
use flexura_nonlinear::{Breakdown, PathBlock, PathEnd, PathOptions, PathWork, System, follow_on};

/// Mesh accuracy of a closer look.
const CAREFUL_MESH: f64 = 1e-10;
/// How a closer look with load steps is taken, if the walker gets nowhere.
const CAREFUL_PATH: PathOptions = PathOptions {
    first_response: 0.4,
    largest_correction: 0.3,
    largest_contraction: 0.3,
    least_agreement: 0.7,
    largest_phase: 1.0,
    point_tolerance: 1e-4,
    largest_turning: 0.7,
    shortest_step: 1e-11,
    crossing_step: 1e-7,
    largest_deviation: 0.3,
    steps: 3000,
    leaves_crossings: false,
    patience: 600,
    least_growth: 2e-3,
};
/// How the walker follows.
const WALK: WalkOptions = WalkOptions {
    tolerance: 1e-10,
    largest_change: 0.25,
    largest_parameter: 0.1,
    shortest: 1e-7,
    farthest: 0.3,
    aim: 0.05,
    least_cosine: 0.75,
    aimed_cosine: 0.94,
    // Short load steps do that better.
    rounds_corners: false,
};
/// Steps of the walker without anything special after which it hands back, and most of them.
const CLEAN: usize = 6;
const MOST_WALKED: usize = 2000;
/// How often the walker may take over.
const HANDOVERS: usize = 40;
/// Way to the edge of a law, relative to a length, at which a path counts as ending there.
pub(crate) const AT_EDGE: f64 = 1e-4;
/// Load fractions that are the same, as a part of themselves.
const SAME: f64 = 1e-4;
/// Change of the state with the load, both as parts of themselves, from which a point counts as a fold; the least way (L) that
/// the state has gone, for that.
const STEEP: f64 = 100.0;
const GONE: f64 = 1e-3;
/// Imperfection of a branch point beyond which no symmetry makes it; where one does, mirrored terms cancel to the last digit.
const SYMMETRIC: f64 = 1e-15;
/// Step by which a direction is carried to another layout.
const SHIFT: f64 = 1e-5;
/// Load fraction so near the full one that it is the full one.
const FULL: f64 = 1.0 - 1e-12;

/// What a walk came to.
enum Walked {
    /// To the full load.
    Complete,
    /// Past what was in the way, to this load.
    Beyond(f64),
    /// To a fold.
    Fold(f64),
    /// It could not go on from this load.
    Stuck(f64),
}

/// The equations with the load fraction as parameter.
struct ByLoad<'a>(&'a mut Equilibrium);

impl Problem for ByLoad<'_> {
    type System = Equilibrium;

    fn system(&mut self) -> &mut Equilibrium {
        self.0
    }

    fn parameters(&self) -> Parameters {
        [self.0.load_fraction(), 0.0]
    }

    fn set_parameters(&mut self, values: Parameters) -> Result<(), Refusal> {
        self.0.set_load(values[0]);
        Ok(())
    }

    fn index(&mut self) -> Option<usize> {
        match self.0.stability() {
            Ok(Stability::Unstable(count)) => Some(count),
            _ => None,
        }
    }
}

/// A problem on its way to the full load.
pub(crate) struct Way<'a> {
    pub problem: &'a mut Equilibrium,
    pub options: PathOptions,
    pub work: PathWork,
    pub progress: &'a mut dyn FnMut(Progress),
    /// Was what looked like a branch point on the last walk not quite one?
    imperfect: bool,
}

impl<'a> Way<'a> {
    /// A way that nothing has been gone of.
    pub fn new(
        problem: &'a mut Equilibrium,
        options: PathOptions,
        progress: &'a mut dyn FnMut(Progress),
    ) -> Self {
        Self { problem, options, work: PathWork::default(), progress, imperfect: false }
    }

    /// May a walk have passed the bend of an imperfection as if it were a branch point?
    fn is_doubtful(&self, walked: &Walked) -> bool {
        self.imperfect || matches!(walked, Walked::Fold(_))
    }

    /// From the solution at the load `from` to the full load; the work done stands in `work`.
    ///
    /// # Errors
    /// What ended it; the problem stands where it ended.
    pub fn go(&mut self, from: f64) -> Result<(), Ending> {
        let end = self.follow(from, &self.options.clone());
        self.go_on(from, end)
    }

    /// The same after the first steps from the load `start` have come to an end.
    ///
    /// # Errors
    /// As [`Way::go`].
    pub fn go_on(&mut self, start: f64, first: PathEnd) -> Result<(), Ending> {
        let (mut from, mut end) = (start, Some(first));
        for _ in 0..HANDOVERS {
            let end = end.take().unwrap_or_else(|| self.follow(from, &self.options.clone()));
            let (load, by) = match end {
                PathEnd::Complete => return Ok(()),
                PathEnd::Singular => (from, PathBlock::Short),
                PathEnd::Blocked { load, by } => (load, by),
            };
            match by {
                PathBlock::Work => return Err(self.tired(load)),
                PathBlock::Interrupted => return Err(Ending::Interrupted { load }),
                _ => {}
            }
            let walked = self.walk(load);
            if by == PathBlock::Crossing && start == 0.0 && self.is_doubtful(&walked) {
                // A tiny imperfection makes a bend of a branch point: short steps follow that, and long ones must not pass it.
                let mut here = self.problem.clone();
                let work = self.work;
                self.problem.rest();
                let options = PathOptions { leaves_crossings: false, ..self.options };
                (self.work.crossing, self.work.crossings) = (None, 0);
                match self.follow(0.0, &options) {
                    PathEnd::Complete => return Ok(()),
                    PathEnd::Blocked { .. } if self.problem.is_interrupted() => {
                        return Err(Ending::Interrupted { load });
                    }
                    _ => {
                        here.set_counts(self.problem.counts());
                        *self.problem = here;
                        (self.work.crossing, self.work.crossings) = (work.crossing, work.crossings);
                    }
                }
            }
            match walked {
                Walked::Complete => return Ok(()),
                _ if self.problem.is_interrupted() => return Err(Ending::Interrupted { load }),
                Walked::Beyond(load) => from = load,
                Walked::Fold(load) => return Err(self.fold(load)),
                Walked::Stuck(load) if self.problem.is_exhausted() => return Err(self.tired(load)),
                Walked::Stuck(load) => return self.again(start, load),
            }
        }
        let load = self.problem.load_fraction();
        Err(self.tired(load))
    }

    /// Quick steps from the load `from`.
    pub fn follow(&mut self, from: f64, options: &PathOptions) -> PathEnd {
        let progress = &mut *self.progress;
        let mut report =
            |load: f64, steps: usize| progress(Progress { load_fraction: load, load_steps: steps });
        follow_on(self.problem, from, options, &mut self.work, &mut report)
    }

    /// A path that neither quick steps nor the walker can follow: once more from its start, on a fine mesh, in short steps.
    fn again(&mut self, start: f64, reached: f64) -> Result<(), Ending> {
        if start > 0.0 || self.problem.is_boundless() {
            return Err(self.why(reached));
        }
        let (mut before, crossings) = (self.problem.clone(), (self.work.crossing, self.work.crossings));
        self.problem.refine_path(CAREFUL_MESH);
        self.problem.rest();
        self.problem.refine_path(f64::INFINITY);
        let load = match self.follow(0.0, &CAREFUL_PATH) {
            PathEnd::Complete => return Ok(()),
            PathEnd::Blocked { load, by: PathBlock::Work } => return Err(self.tired(load)),
            PathEnd::Blocked { load, .. } if load > reached * (1.0 + 1e-6) => match self.walk(load) {
                Walked::Complete => return Ok(()),
                Walked::Fold(load) => return Err(self.fold(load)),
                Walked::Beyond(load) | Walked::Stuck(load) => load,
            },
            PathEnd::Blocked { load, .. } => load,
            PathEnd::Singular => 0.0,
        };
        // What it took for a branch point may be where it ended.
        (self.work.crossing, self.work.crossings) = crossings;
        if load < reached {
            // It came less far.
            before.set_counts(self.problem.counts());
            *self.problem = before;
        }
        Err(self.why(load.max(reached)))
    }

    fn tired(&mut self, load: f64) -> Ending {
        if self.problem.is_boundless() {
            return self.why(load);
        }
        Ending::Work { load, steps: self.work.taken + self.work.refused, crossings: self.work.crossings }
    }

    fn fold(&mut self, load: f64) -> Ending {
        if self.work.crossing.is_some_and(|crossing| crossing > load * (1.0 - SAME)) {
            // It was this fold.
            (self.work.crossing, self.work.crossings) = (None, 0);
        }
        Ending::Fold { load, driven: self.problem.is_driven() }
    }

    /// By how much of itself the state changes when the load does, from the tangent at the present state: large next to a fold.
    fn steepness(&mut self) -> f64 {
        let load = self.problem.load_fraction();
        let (mut here, mut there) = (vec![0.0; self.problem.unknowns()], vec![0.0; self.problem.unknowns()]);
        let part = 1e-6 * load.max(1e-3);
        let mut changes = || -> Result<(), Breakdown> {
            self.problem.linearise()?;
            self.problem.newton_step(&mut here);
            self.problem.set_load(load + part);
            self.problem.residual()?;
            self.problem.newton_step(&mut there);
            Ok(())
        };
        let changed = changes();
        self.problem.set_load(load);
        if changed.is_err() {
            return 0.0;
        }
        let slope: Vec<f64> = there.iter().zip(&here).map(|(b, a)| (b - a) / part).collect();
        load * self.problem.moved_by(&slope) / self.problem.gone().max(GONE)
    }

    /// What ends a path that is no fold, by what the present state is near to.
    fn why(&mut self, load: f64) -> Ending {
        let ends = self.problem.contact_ends();
        if !ends.is_empty() {
            return Ending::Boundary { load, ends };
        }
        let edges = self.problem.edges(AT_EDGE);
        if edges.iter().any(|edge| self.problem.turns_back_at(edge)) {
            return Ending::Corner { load, edges };
        }
        if self.problem.is_boundless() {
            return Ending::Unreachable { load, force: self.problem.largest_force() };
        }
        if self.steepness() > STEEP {
            return self.fold(load);
        }
        match self.problem.loose_here() {
            Some(error) => Ending::Loss { load, what: error.message },
            None => Ending::Short { load },
        }
    }

    /// Along the path by pseudo-arclength, from a point near it at `from`, until it is well past what is in the way.
    fn walk(&mut self, from: f64) -> Walked {
        self.imperfect = false;
        let finer = self.problem.mesh_accuracy().min(CAREFUL_MESH);
        self.problem.set_mesh_accuracy(finer);
        self.problem.weigh();
        let walked = self.walk_on(from);
        self.problem.weigh_for_the_way();
        walked
    }

    fn walk_on(&mut self, from: f64) -> Walked {
        let mut by_load = ByLoad(self.problem);
        let Ok(mut walker) = Walker::start(&mut by_load, WALK, 1.0) else { return Walked::Stuck(from) };
        let (mut clean, mut furthest) = (0, from);
        for _ in 0..MOST_WALKED {
            if by_load.0.is_exhausted() || by_load.0.is_boundless() {
                break;
            }
            let Advance::To(specials) = walker.advance(&mut by_load) else { break };
            self.work.taken += 1;
            let here = walker.here().point.parameters[0];
            clean = if specials.is_empty() { clean + 1 } else { 0 };
            if let Some(fold) = first_fold(&specials) {
                let _ = fold.point.restore(&mut by_load);
                return Walked::Fold(fold.point.parameters[0]);
            }
            self.imperfect |= specials.iter().any(|special| special.imperfection > SYMMETRIC);
            for met in specials.iter().filter(|special| special.point.parameters[0] < 1.0) {
                self.work.crossing.get_or_insert(met.point.parameters[0]);
                self.work.crossings += 1;
            }
            if here >= FULL {
                return match walker.at_parameter(&mut by_load, 1.0) {
                    Ok(_) => Walked::Complete,
                    Err(_) => Walked::Stuck(furthest),
                };
            }
            if here < furthest - 1e-3 {
                // It turns back without a fold: at a corner.
                break;
            }
            furthest = furthest.max(here);
            (self.progress)(Progress { load_fraction: here, load_steps: self.work.taken });
            if walker.here().point.restore(&mut by_load).is_err() {
                break;
            }
            if clean >= CLEAN {
                return Walked::Beyond(here);
            }
            if by_load.0.residual().is_err() || renew(&mut by_load, &mut walker).is_err() {
                break;
            }
        }
        let _ = walker.here().point.restore(&mut by_load);
        let load = by_load.0.load_fraction();
        Walked::Stuck(load)
    }
}

/// A fold that lies before the full load.
fn first_fold(specials: &[Special]) -> Option<&Special> {
    specials.iter().find(|special| special.crossing.is_none() && special.point.parameters[0] < 1.0)
}

/// The mesh follows the forces.
fn renew(by_load: &mut ByLoad<'_>, walker: &mut Walker) -> Result<(), flexura_continuation::Stall> {
    let problem = &mut *by_load.0;
    problem.weigh();
    if problem.wants_segments() {
        let tangent = cut_anew(problem, &walker.here().tangent);
        problem.weigh();
        return walker.polish(by_load, Some(tangent));
    }
    if problem.wants_steps() {
        problem.renew();
        problem.weigh();
        return walker.polish(by_load, None);
    }
    Ok(())
}

/// Cuts the spans anew, which changes the layout of the state; the direction in the new layout.
pub(crate) fn cut_anew(problem: &mut Equilibrium, tangent: &Tangent) -> Tangent {
    let mut moved = problem.clone();
    problem.renew();
    let small: Vec<f64> = tangent.step.iter().map(|t| t * SHIFT).collect();
    moved.retract(&small);
    moved.take_segments_of(problem);
    let (mut here, mut there) = (Vec::new(), Vec::new());
    problem.store(&mut here);
    moved.store(&mut there);
    let mut step = vec![0.0; problem.unknowns()];
    problem.difference(&here, &there, &mut step);
    step.iter_mut().for_each(|s| *s /= SHIFT);
    Tangent { step, parameter: tangent.parameter }
}
