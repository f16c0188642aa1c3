//! Derivatives by a parameter at a standing state: the one recipe of differences.
//!
//! The numbers of a model follow their parameters exactly ([`Model::at`]); what the residual and the outputs make of them on the
//! mesh at hand is differentiated by central differences of order six at ±h, ±2h, ±3h. The same values give those of order four,
//! and what lies between the two bounds the error: with h a few thousandths of the parameter's size the sixth order is wrong by
//! about the 3/2 power of it. The laws of the six places are made once, for the state's slope and for what is read off.

use crate::Prepared;
use crate::family::Family;
use crate::sensitivity::SensitivityError;
use flexura_equilibrium::{CENTRAL, Law};
#[cfg(doc)]
use flexura_model::Model;
use flexura_nonlinear::System;

/// Weights of order four at the places of [`CENTRAL`], whose own are of order six.
const FOURTH: [f64; 6] = [8.0 / 12.0, -8.0 / 12.0, -1.0 / 12.0, 1.0 / 12.0, 0.0, 0.0];

/// The laws of the mechanisms beside the present one.
pub(crate) struct Beside {
    h: f64,
    /// Parallel to the places; None while one is in use.
    laws: Vec<Option<Law>>,
}

/// A derivative by a parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    /// Of order six.
    pub value: f64,
    /// How far that of order four is from it, relative to the larger of the two; zero where that is round-off.
    pub apart: f64,
}

impl Prepared {
    /// The laws at six places beside `value` of a parameter, `h` apart.
    ///
    /// # Errors
    /// A neighbouring model is none.
    pub(crate) fn beside_of(
        &mut self,
        family: &mut dyn Family,
        parameter: usize,
        value: f64,
        h: f64,
    ) -> Result<Beside, SensitivityError> {
        let mut laws = Vec::with_capacity(CENTRAL.len());
        for (place, _) in CENTRAL {
            laws.push(Some(family.law(&self.problem, &self.values_with(parameter, value + place * h))?));
        }
        Ok(Beside { h, laws })
    }

    /// Does something under each of the laws; the present law is put back.
    fn under_each<T>(
        &mut self,
        beside: &mut Beside,
        mut there: impl FnMut(&mut Self, f64) -> Result<T, SensitivityError>,
    ) -> Result<Vec<T>, SensitivityError> {
        let mut found = Vec::with_capacity(CENTRAL.len());
        for ((place, _), slot) in CENTRAL.iter().zip(&mut beside.laws) {
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
        let h = beside.h;
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
        for ((_, weight), step) in CENTRAL.iter().zip(&steps?) {
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
        let h = beside.h;
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
            let (mut six, mut four, mut level) = (0.0, 0.0, 0.0_f64);
            for (((_, w6), w4), values) in CENTRAL.iter().zip(&FOURTH).zip(&all) {
                let y = values[k]?;
                six += w6 / h * y;
                four += w4 / h * y;
                level = level.max(y.abs());
            }
            let size = six.abs().max(four.abs()).max(f64::MIN_POSITIVE);
            let apart = ((six - four).abs() - noise * level).max(0.0) / size;
            Some(Slope { value: six, apart })
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
        let mut beside = self.beside_of(family, parameter, value, h)?;
        self.state_slope_of(&mut beside)
    }
}
