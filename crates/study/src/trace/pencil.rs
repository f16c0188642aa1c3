//! The second variation and its rate along a load, at an equilibrium whose shape is kept.
//!
//! How wide the difference is that gives the rate follows from what it finds: a part of the nearest critical value, so that neither
//! the round-off of a small difference nor what a large one bends tells, whatever the size of the load that the model names.

use super::ritz;
use crate::family::size_of;
use crate::{Family, Prepared, ProblemError};
use flexura_equilibrium::{Rate, Variation};
use flexura_model::BuckleStudy;
use flexura_nonlinear::{Breakdown, NewtonEnd, NewtonOptions, System, converge};

/// Most that the state changes along which section moments are differenced.
const CHANGE: f64 = 1e-2;
/// By how much more the wrenches change where the shape is kept: the second variation is all but linear in them.
const STRESS: f64 = 30.0;
/// Step of the state's slope, as a part of the difference.
const SLOPE: f64 = 1e-2;
/// The difference as a part of the nearest critical value, and of the value about which the problem is linearised.
const PART: f64 = 0.1;
/// How far a difference may be from that, as a factor.
const NEAR: f64 = 4.0;
/// Differences that are tried.
const TRIES: usize = 40;
/// Factors by which one that fails is made smaller, and one that shows nothing larger.
const SMALLER: f64 = 0.1;
const LARGER: f64 = 1e3;
/// How much smaller and larger than where it began.
const SMALLEST: f64 = 1e-14;
const LARGEST: f64 = 1e18;
/// Part by which the nearest values of two differences may differ.
const SAME: f64 = 1e-2;
/// Steps of the load to a fraction of it.
const LOAD_STEPS: usize = 20;

/// Why there is no pencil.
pub(super) enum Failure {
    /// The equilibrium is itself critical.
    Critical,
    /// The states beside it have no sound numbers.
    Breakdown,
    Problem(ProblemError),
}

impl From<Breakdown> for Failure {
    fn from(_: Breakdown) -> Self {
        Failure::Breakdown
    }
}

/// H0 factorised, and the two sides of the difference.
pub(super) struct Pencil {
    pub base: Variation,
    sides: [Variation; 2],
    width: f64,
    work: Vec<f64>,
}

impl Pencil {
    /// `x ← -H0⁻¹ H1 x`, whose eigenvalues are 1/μ.
    fn apply(&mut self, x: &mut [f64]) {
        self.work.clear();
        self.work.resize(x.len(), 0.0);
        let factor = -0.5 / self.width;
        self.sides[0].multiply(-factor, x, &mut self.work);
        self.sides[1].multiply(factor, x, &mut self.work);
        x.copy_from_slice(&self.work);
        self.base.solve(x);
    }

    /// The μ nearest to zero, on either side, with their vectors.
    pub fn nearest(&mut self, count: usize) -> Vec<(f64, Vec<f64>)> {
        let size = self.base.size();
        ritz::smallest(&mut |x| self.apply(x), size, count)
    }
}

impl Prepared {
    /// The equilibrium under a fraction of all loads and drives.
    pub(super) fn part_of_load(
        &mut self,
        fraction: f64,
        tolerance: f64,
    ) -> Result<crate::Outcome, ProblemError> {
        self.problem.rest();
        if let Some(outcome) = self.overloaded() {
            return Ok(outcome);
        }
        let newton = NewtonOptions { tolerance: 1e-9, iterations: 30, nearest: f64::INFINITY };
        for i in 1..=LOAD_STEPS {
            self.problem.set_load(fraction * i as f64 / LOAD_STEPS as f64);
            self.problem.renew();
            if !matches!(converge(&mut self.problem, &newton), NewtonEnd::Converged { .. }) {
                if self.problem.is_interrupted() {
                    return Ok(self.interrupted(flexura_nonlinear::PathWork::default()));
                }
                return Err(ProblemError::new(
                    "study",
                    format!("finds no equilibrium under {fraction} of the load"),
                    "choose a smaller value of `at`",
                ));
            }
        }
        Ok(self.finish(tolerance, flexura_nonlinear::PathWork::default(), f64::INFINITY))
    }

    /// The width of the difference that belongs to the nearest critical value; None where there is no such value.
    pub(super) fn difference(
        &mut self,
        family: &mut dyn Family,
        study: &BuckleStudy,
        parts: usize,
    ) -> Result<Option<f64>, Failure> {
        let begin = match study.parameter {
            Some(parameter) => size_of(self.problem.model(), parameter, self.problem.units(), 1.0),
            None => 1.0,
        };
        let mut width = PART * begin;
        // A load may be named small, a motion has a size of its own.
        let mut failed = if self.is_moved(family, study, width) { begin } else { f64::INFINITY };
        for _ in 0..TRIES {
            let mut pencil = match self.pencil(family, study, parts, width) {
                Ok(pencil) => pencil,
                Err(failure) if matches!(failure, Failure::Critical) || self.problem.is_interrupted() => {
                    return Err(failure);
                }
                Err(failure) => {
                    failed = width;
                    width *= SMALLER;
                    if width < SMALLEST * begin {
                        return Err(failure);
                    }
                    continue;
                }
            };
            let Some(nearest) = pencil.nearest(1).first().map(|(value, _)| value.abs()) else {
                // Nothing, or nothing yet.
                width *= LARGER;
                if width >= failed || width > LARGEST * begin {
                    return Ok(None);
                }
                continue;
            };
            let wanted = PART * nearest.max(PART * study.at.abs());
            if wanted > LARGEST * begin {
                return Ok(None);
            }
            if (width / NEAR..=width * NEAR).contains(&wanted) || wanted > width && NEAR * width >= failed {
                // What round-off makes of nothing is another value for another difference.
                let mut other = self.pencil(family, study, parts, 0.5 * width)?;
                let again = other.nearest(1).first().map_or(0.0, |(value, _)| value.abs());
                return Ok(((again - nearest).abs() <= SAME * nearest).then_some(width));
            }
            width = if wanted < failed { wanted } else { (width * failed).sqrt() };
        }
        Ok(None)
    }

    /// Does a change by `by` move something that is driven, or change lengths or angles?
    fn is_moved(&mut self, family: &mut dyn Family, study: &BuckleStudy, by: f64) -> bool {
        let parameters = &self.problem.model().parameters;
        if study.parameter.is_some_and(|p| matches!(parameters[p].unit.as_str(), "m" | "rad")) {
            return true;
        }
        let (mut kept, mut moved) = (Vec::new(), Vec::new());
        self.problem.store(&mut kept);
        match study.parameter {
            Some(parameter) => {
                // Where there is no such model the difference will say so.
                let values = self.values_with(parameter, study.at + by);
                let Ok(law) = family.law(&self.problem, &values) else { return false };
                let own = self.problem.exchange(law);
                self.problem.store(&mut moved);
                self.problem.exchange(own);
            }
            None => {
                let load = self.problem.load_fraction();
                self.problem.set_load(load + by);
                self.problem.store(&mut moved);
                self.problem.set_load(load);
            }
        }
        self.problem.restore(&kept);
        moved != kept
    }

    /// Cut into `parts` stretches a smooth part of a beam at least, by a difference of the given width.
    pub(super) fn pencil(
        &mut self,
        family: &mut dyn Family,
        study: &BuckleStudy,
        parts: usize,
        width: f64,
    ) -> Result<Pencil, Failure> {
        let mut base = self.problem.variation(parts).map_err(|_| Failure::Critical)?;
        base.factorise().map_err(|_| Failure::Critical)?;
        self.problem.linearise().map_err(|_| Failure::Critical)?;
        let along = match study.parameter {
            Some(parameter) => {
                self.state_slope(family, parameter, study.at, SLOPE * width).map_err(|error| match error {
                    crate::SensitivityError::Model(error) => Failure::Problem(error),
                    _ => Failure::Breakdown,
                })?
            }
            None => self.problem.response().map_err(|_| Failure::Critical)?,
        };
        let mut sides = |prepared: &mut Self,
                         step: &[f64],
                         width: f64,
                         stressed: Option<&Rate>|
         -> Result<_, Failure> {
            let minus = prepared.beside(family, study, parts, step, -width, stressed)?;
            let plus = prepared.beside(family, study, parts, step, width, stressed)?;
            if minus.fits(&base) && plus.fits(&base) { Ok([minus, plus]) } else { Err(Failure::Breakdown) }
        };
        // How section moments change on the way, then the same wrenches with the shape as it is.
        let size = self.problem.size(&along);
        let short = (width / STRESS).min(if size > 0.0 { CHANGE / size } else { f64::INFINITY });
        let moved = sides(self, &along, short, None)?;
        let rate = Variation::rate(&moved[0], &moved[1], short);
        let sides = sides(self, &self.problem.wrench_part(&along), width, Some(&rate))?;
        Ok(Pencil { base, sides, width, work: Vec::new() })
    }

    /// The second variation beside the present state: `by` times the step away, at a parameter that differs by `by`. With the rate
    /// of the section moments the shape is kept.
    fn beside(
        &mut self,
        family: &mut dyn Family,
        study: &BuckleStudy,
        parts: usize,
        step: &[f64],
        by: f64,
        stressed: Option<&Rate>,
    ) -> Result<Variation, Failure> {
        let mut kept = Vec::new();
        self.problem.store(&mut kept);
        let load = self.problem.load_fraction();
        let own = match study.parameter {
            Some(parameter) => {
                let values = self.values_with(parameter, study.at + by);
                let law = family.law(&self.problem, &values).map_err(Failure::Problem)?;
                Some(self.problem.exchange(law))
            }
            None => {
                self.problem.set_load(load + by);
                None
            }
        };
        if stressed.is_some() {
            // Drives stay where they are, too.
            self.problem.restore(&kept);
        }
        let step: Vec<f64> = step.iter().map(|s| s * by).collect();
        self.problem.retract(&step);
        let side = match stressed {
            Some(rate) => self.problem.stressed_variation(parts, rate, by),
            None => self.problem.variation(parts),
        };
        match own {
            Some(own) => {
                self.problem.exchange(own);
            }
            None => self.problem.set_load(load),
        }
        self.problem.restore(&kept);
        Ok(side?)
    }
}
