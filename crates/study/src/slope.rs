//! Derivatives by a parameter at a standing state: the one recipe of differences.
//!
//! The numbers of a model follow their parameters exactly ([`Model::at`]); what the residual and the outputs make of them on the
//! mesh at hand is differentiated by central differences: of order four at ±h, ±2h, or of order six at ±3h besides. The same values
//! give those of the order below, and what lies between the two bounds the error: with h a thousandth of the parameter's size the
//! fourth order is wrong by about the square of it, and the sixth by its 3/2 power. The laws of the places are made once, for the
//! state's slope and for what is read off.

use crate::Prepared;
use crate::family::Family;
use crate::sensitivity::SensitivityError;
use flexura_equilibrium::{CENTRAL, Law};
#[cfg(doc)]
use flexura_model::Model;
use flexura_nonlinear::System;

/// Differences at the first few of the places of [`CENTRAL`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Order {
    Four,
    Six,
}

impl Order {
    /// Places, weights, and weights of the order below.
    fn rule(self) -> &'static [[f64; 3]] {
        const FOUR: [[f64; 3]; 4] = [
            [1.0, 8.0 / 12.0, 0.5],
            [-1.0, -8.0 / 12.0, -0.5],
            [2.0, -1.0 / 12.0, 0.0],
            [-2.0, 1.0 / 12.0, 0.0],
        ];
        const SIX: [[f64; 3]; 6] = [
            [CENTRAL[0].0, CENTRAL[0].1, 8.0 / 12.0],
            [CENTRAL[1].0, CENTRAL[1].1, -8.0 / 12.0],
            [CENTRAL[2].0, CENTRAL[2].1, -1.0 / 12.0],
            [CENTRAL[3].0, CENTRAL[3].1, 1.0 / 12.0],
            [CENTRAL[4].0, CENTRAL[4].1, 0.0],
            [CENTRAL[5].0, CENTRAL[5].1, 0.0],
        ];
        match self {
            Order::Four => &FOUR,
            Order::Six => &SIX,
        }
    }
}

/// The laws of the mechanisms beside the present one.
pub(crate) struct Beside {
    order: Order,
    h: f64,
    /// Parallel to the places; None while one is in use.
    laws: Vec<Option<Law>>,
}

/// A derivative by a parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    /// Of the order of its places.
    pub value: f64,
    /// How far that of the order below is from it, relative to the larger of the two; zero where that is round-off.
    pub apart: f64,
}

impl Prepared {
    /// The laws at the places beside `value` of a parameter, `h` apart.
    ///
    /// # Errors
    /// A neighbouring model is none.
    pub(crate) fn beside_of(
        &mut self,
        family: &mut dyn Family,
        parameter: usize,
        value: f64,
        (order, h): (Order, f64),
    ) -> Result<Beside, SensitivityError> {
        let mut laws = Vec::with_capacity(order.rule().len());
        for [place, ..] in order.rule() {
            laws.push(Some(family.law(&self.problem, &self.values_with(parameter, value + place * h))?));
        }
        Ok(Beside { order, h, laws })
    }

    /// Does something under each of the laws; the present law is put back.
    fn under_each<T>(
        &mut self,
        beside: &mut Beside,
        mut there: impl FnMut(&mut Self, f64) -> Result<T, SensitivityError>,
    ) -> Result<Vec<T>, SensitivityError> {
        let rule = beside.order.rule();
        let mut found = Vec::with_capacity(rule.len());
        for ([place, ..], slot) in rule.iter().zip(&mut beside.laws) {
            let Some(law) = slot.take() else { continue };
            let own = self.problem.exchange(law);
            let outcome = there(self, place * beside.h);
            *slot = Some(self.problem.exchange(own));
            found.push(outcome?);
        }
        Ok(found)
    }

    /// The step of the state per unit of the parameter, `-J⁻¹ ∂r/∂p`, with the tangent last factorised.
    ///
    /// # Errors
    /// Beside the state a number overflows.
    pub(crate) fn state_slope_of(&mut self, beside: &mut Beside) -> Result<Vec<f64>, SensitivityError> {
        let mut kept = Vec::new();
        self.problem.store(&mut kept);
        let n = self.problem.unknowns();
        let (rule, h) = (beside.order.rule(), beside.h);
        let steps = self.under_each(beside, |prepared, _| {
            let outcome = prepared.problem.residual();
            let mut step = vec![0.0; n];
            prepared.problem.newton_step(&mut step);
            prepared.problem.restore(&kept);
            outcome?;
            Ok(step)
        });
        self.problem.restore(&kept);
        let mut sum = vec![0.0; n];
        for ([_, weight, _], step) in rule.iter().zip(&steps?) {
            sum.iter_mut().zip(step).for_each(|(s, d)| *s += weight / h * d);
        }
        Ok(sum)
    }

    /// The same for what is read off, while the state moves along `along` with the parameter. None of what has no value
    /// somewhere beside; what is below `noise` times its size is nothing.
    ///
    /// # Errors
    /// Beside the state a number overflows, or nothing can be read off.
    pub(crate) fn slopes_of(
        &mut self,
        beside: &mut Beside,
        along: &[f64],
        noise: f64,
        read: impl Fn(&mut Self) -> Result<Vec<Option<f64>>, SensitivityError>,
    ) -> Result<Vec<Option<Slope>>, SensitivityError> {
        let mut kept = Vec::new();
        self.problem.store(&mut kept);
        let (rule, h) = (beside.order.rule(), beside.h);
        let all = self.under_each(beside, |prepared, by| {
            let step: Vec<f64> = along.iter().map(|v| v * by).collect();
            prepared.problem.retract(&step);
            let values = read(prepared);
            prepared.problem.restore(&kept);
            values
        });
        self.problem.restore(&kept);
        let all = all?;
        let count = all.first().map_or(0, Vec::len);
        let slope = |k: usize| {
            let (mut value, mut below, mut level) = (0.0, 0.0, 0.0_f64);
            for ([_, own, other], values) in rule.iter().zip(&all) {
                let y = values[k]?;
                value += own / h * y;
                below += other / h * y;
                level = level.max(y.abs());
            }
            let size = f64::abs(value).max(f64::abs(below)).max(f64::MIN_POSITIVE);
            let apart = (f64::abs(value - below) - noise * level).max(0.0) / size;
            Some(Slope { value, apart })
        };
        Ok((0..count).map(slope).collect())
    }

    /// [`Prepared::state_slope_of`] without a use for the laws.
    ///
    /// # Errors
    /// As there, and where a neighbouring model is none.
    pub(crate) fn state_slope(
        &mut self,
        family: &mut dyn Family,
        parameter: usize,
        value: f64,
        h: f64,
    ) -> Result<Vec<f64>, SensitivityError> {
        let mut beside = self.beside_of(family, parameter, value, (Order::Six, h))?;
        self.state_slope_of(&mut beside)
    }
}
