//! The study as a smooth problem in the unit box of the ranges, everything scaled by its own size.

use crate::certificate::{self, Row};
use crate::evaluate::{Designs, Numbers};
use flexura_model::OptimiseStudy;
use flexura_solution::{Active, Bound, Design};
use std::rc::Rc;

/// Designs whose numbers are kept.
const KEPT: usize = 8;
/// Part of the objective's own value that its size is at least; most of it may be a constant.
const FLOOR: f64 = 1e-3;
/// Part of its value that an objective changes by over the ranges through round-off alone.
const IDLE: f64 = 1e-10;
/// How near to its bound something counts as held by it, relative to its size.
const HELD: f64 = 1e-6;

/// What is made least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Goal {
    /// The first objective.
    First,
    /// The second one.
    Second,
    /// The first, where the second is at most this (at least, where it is to be greatest).
    Under(f64),
    /// The miss of the conditions.
    Feasible,
}

/// `sign (value - bound) / size`, at most zero, or zero for an equality.
#[derive(Clone, Copy, Debug)]
struct Limit {
    reading: usize,
    sign: f64,
    bound: f64,
    size: f64,
    what: Bound,
}

/// A design in scaled numbers.
#[derive(Clone, Debug)]
pub(crate) struct Scaled {
    pub f: f64,
    /// Equalities, then inequalities.
    pub c: Vec<f64>,
    /// Derivatives of f and of each of c by the coordinates of the box.
    pub slopes: Option<(Vec<f64>, Vec<Vec<f64>>)>,
    pub numbers: Rc<Numbers>,
}

/// The problem, with the last designs.
pub(crate) struct Problem<'m> {
    pub study: &'m OptimiseStudy,
    pub designs: Designs<'m>,
    pub goal: Goal,
    limits: Vec<Limit>,
    /// Of the two objectives, made at the first design with derivatives.
    sizes: Option<[f64; 2]>,
    kept: Vec<(Vec<u64>, Option<Rc<Numbers>>)>,
    /// Of the worst objective and violation so far, for designs without values.
    pub worst: f64,
}

impl<'m> Problem<'m> {
    pub fn new(study: &'m OptimiseStudy, designs: Designs<'m>) -> Self {
        let mut limits = Vec::new();
        for (i, condition) in study.conditions.iter().enumerate() {
            let limit = |sign, bound, what| Limit { reading: 1 + i, sign, bound, size: f64::NAN, what };
            limits.extend(condition.equals.map(|bound| limit(1.0, bound, Bound::Equals(i))));
            limits.extend(condition.least.map(|bound| limit(-1.0, bound, Bound::Least(i))));
            limits.extend(condition.most.map(|bound| limit(1.0, bound, Bound::Most(i))));
        }
        limits.sort_by_key(|limit| !matches!(limit.what, Bound::Equals(_)));
        Self { study, designs, goal: Goal::First, limits, sizes: None, kept: Vec::new(), worst: 1.0 }
    }

    pub fn dimensions(&self) -> usize {
        self.study.vary.len()
    }

    /// How many equalities and inequalities the present goal has.
    pub fn counts(&self) -> [usize; 2] {
        if self.goal == Goal::Feasible {
            return [0, 0];
        }
        let equal = self.limits.iter().filter(|limit| matches!(limit.what, Bound::Equals(_))).count();
        [equal, self.limits.len() - equal + usize::from(matches!(self.goal, Goal::Under(_)))]
    }

    /// Values of the parameters at a point of the box.
    pub fn values(&self, u: &[f64]) -> Vec<f64> {
        let pairs = self.study.vary.iter().zip(u);
        pairs
            .map(|(varied, u)| {
                let [low, high] = varied.range;
                // The ends are met to the last bit.
                if *u >= 1.0 { high } else { low + u.max(0.0) * (high - low) }
            })
            .collect()
    }

    /// The point of the box.
    pub fn point(&self, values: &[f64]) -> Vec<f64> {
        let pairs = self.study.vary.iter().zip(values);
        pairs.map(|(varied, x)| (x - varied.range[0]) / (varied.range[1] - varied.range[0])).collect()
    }

    fn widths(&self) -> Vec<f64> {
        self.study.vary.iter().map(|varied| varied.range[1] - varied.range[0]).collect()
    }

    /// The design at a point of the box; None where it has no values.
    pub fn at(&mut self, u: &[f64], slopes: bool) -> Option<Scaled> {
        let numbers = self.numbers(u, slopes || self.sizes.is_none())?;
        self.set_sizes(&numbers);
        let scaled = self.scaled(&numbers);
        self.worst = self.worst.max(scaled.f.abs());
        Some(scaled)
    }

    fn numbers(&mut self, u: &[f64], slopes: bool) -> Option<Rc<Numbers>> {
        let key: Vec<u64> = u.iter().map(|u| u.to_bits()).collect();
        if let Some(place) = self.kept.iter().position(|(known, _)| *known == key) {
            let enough = |numbers: &Option<Rc<Numbers>>| {
                numbers.as_ref().is_none_or(|numbers| !slopes || numbers.slopes.is_some())
            };
            if enough(&self.kept[place].1) {
                return self.kept[place].1.clone();
            }
            self.kept.remove(place);
        }
        let x = self.values(u);
        let numbers = self.designs.read(&x, slopes).map(Rc::new);
        if self.kept.len() == KEPT {
            self.kept.remove(0);
        }
        self.kept.push((key, numbers.clone()));
        numbers
    }

    /// The sizes of everything, from the first design that has values.
    fn set_sizes(&mut self, numbers: &Numbers) {
        let (None, Some(slopes)) = (self.sizes, &numbers.slopes) else { return };
        let widths = self.widths();
        let reach = |reading: usize| {
            let parts = slopes[reading].iter().zip(&widths).map(|(slope, width)| (slope * width).abs());
            parts.fold(0.0, f64::max)
        };
        let some = |size: f64| if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let of = |reading: usize| some(reach(reading).max(FLOOR * numbers.values[reading].abs()));
        self.sizes = Some([of(0), of(numbers.values.len() - 1)]);
        for limit in &mut self.limits {
            limit.size = match limit.bound.abs() {
                0.0 => some(reach(limit.reading).max(numbers.values[limit.reading].abs())),
                bound => bound,
            };
        }
    }

    /// Reading, sign and size of what is made least.
    fn objective(&self) -> (usize, f64, f64) {
        let [first, second] = self.sizes.unwrap_or([1.0, 1.0]);
        let sign = |maximise: bool| if maximise { -1.0 } else { 1.0 };
        match (self.goal, &self.study.front) {
            (Goal::Second, Some(front)) => (1 + self.study.conditions.len(), sign(front.maximise), second),
            _ => (0, sign(self.study.maximise), first),
        }
    }

    /// The limits of the present goal.
    fn present_limits(&self) -> Vec<Limit> {
        let mut limits = self.limits.clone();
        if let (Goal::Under(bound), Some(front)) = (self.goal, &self.study.front) {
            let [_, size] = self.sizes.unwrap_or([1.0, 1.0]);
            let sign = if front.maximise { -1.0 } else { 1.0 };
            let reading = 1 + self.study.conditions.len();
            limits.push(Limit { reading, sign, bound, size, what: Bound::Other });
        }
        limits
    }

    fn scaled(&self, numbers: &Rc<Numbers>) -> Scaled {
        let limits = self.present_limits();
        let widths = self.widths();
        let (reading, sign, size) = self.objective();
        let value = |limit: &Limit| limit.sign * (numbers.values[limit.reading] - limit.bound) / limit.size;
        let c: Vec<f64> = limits.iter().map(value).collect();
        let f = sign * numbers.values[reading] / size;
        let slopes = numbers.slopes.as_ref().map(|slopes| {
            let row = |reading: usize, factor: f64| -> Vec<f64> {
                slopes[reading].iter().zip(&widths).map(|(slope, width)| factor * slope * width).collect()
            };
            let rows = limits.iter().map(|limit| row(limit.reading, limit.sign / limit.size)).collect();
            (row(reading, sign / size), rows)
        });
        let scaled = Scaled { f, c, slopes, numbers: numbers.clone() };
        if self.goal == Goal::Feasible { self.miss(&limits, scaled) } else { scaled }
    }

    /// Half the sum of the squares of what is missed, as the objective.
    fn miss(&self, limits: &[Limit], scaled: Scaled) -> Scaled {
        let missed: Vec<f64> = limits.iter().zip(&scaled.c).map(|(limit, c)| over(limit, *c)).collect();
        let slopes = scaled.slopes.map(|(_, rows)| {
            let sum = |k: usize| rows.iter().zip(&missed).map(|(row, m)| m * row[k]).sum();
            ((0..self.dimensions()).map(sum).collect(), Vec::new())
        });
        let f = 0.5 * missed.iter().map(|m| m * m).sum::<f64>();
        Scaled { f, c: Vec::new(), slopes, numbers: scaled.numbers }
    }

    /// Largest relative miss of a limit.
    pub fn violation(&self, numbers: &Numbers) -> f64 {
        let limits = self.present_limits();
        let value = |limit: &Limit| limit.sign * (numbers.values[limit.reading] - limit.bound) / limit.size;
        limits.iter().map(|limit| over(limit, value(limit)).abs()).fold(0.0, f64::max)
    }

    /// The condition that a design misses most, and by how much of its size.
    pub fn most_missed(&self, design: &Design) -> Option<(Bound, f64)> {
        let miss = |limit: &Limit| {
            let value = design.conditions[limit.reading - 1];
            (limit.what, over(limit, limit.sign * (value - limit.bound) / limit.size).abs())
        };
        self.limits.iter().map(miss).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The design at a point with everything that is told of it; None where it has no values.
    pub fn judge(&mut self, u: &[f64]) -> Option<Design> {
        let scaled = self.at(u, true)?;
        let limits = self.present_limits();
        let (gradient, rows) = scaled.slopes.as_ref()?;
        let mut what = Vec::new();
        let mut held = Vec::new();
        if self.goal != Goal::Feasible {
            for ((limit, c), row) in limits.iter().zip(&scaled.c).zip(rows) {
                let is_equality = matches!(limit.what, Bound::Equals(_));
                if is_equality || *c >= -HELD {
                    what.push((limit.what, -limit.sign / limit.size));
                    held.push(Row { gradient: row.clone(), is_equality });
                }
            }
        }
        for (k, (x, width)) in u.iter().zip(self.widths()).enumerate() {
            let mut unit = vec![0.0; u.len()];
            for (is_there, sign, bound) in
                [(*x <= 1e-9, -1.0, Bound::Lower(k)), (*x >= 1.0 - 1e-9, 1.0, Bound::Upper(k))]
            {
                if is_there {
                    unit[k] = sign;
                    what.push((bound, -sign / width));
                    held.push(Row { gradient: unit.clone(), is_equality: false });
                }
            }
        }
        let (multipliers, stationarity) = certificate::multipliers(gradient, &held);
        let (_, sign, size) = self.objective();
        // L = f + λ sign (g - b)/s: the least f changes by -λ sign/s with b.
        let active = what
            .iter()
            .zip(&multipliers)
            .map(|((what, by), lambda)| Active { what: *what, rate: sign * size * lambda * by });
        let numbers = &scaled.numbers;
        let conditions = self.study.conditions.len();
        Some(Design {
            values: self.values(u),
            objective: numbers.values[0],
            other: self.study.front.as_ref().map(|_| numbers.values[1 + conditions]),
            conditions: numbers.values[1..1 + conditions].to_vec(),
            active: active.collect(),
            violation: self.violation(numbers),
            stationarity,
            stable: numbers.stable,
        })
    }

    /// Does the objective not change with the parameters at all, as far as its derivatives tell?
    pub fn is_idle(&mut self, u: &[f64]) -> Option<bool> {
        let numbers = self.numbers(u, true)?;
        let slopes = numbers.slopes.as_ref()?;
        let changes = slopes[0].iter().zip(self.widths()).map(|(slope, width)| (slope * width).abs());
        Some(changes.fold(0.0, f64::max) <= IDLE * numbers.values[0].abs())
    }
}

fn over(limit: &Limit, c: f64) -> f64 {
    if matches!(limit.what, Bound::Equals(_)) { c } else { c.max(0.0) }
}
