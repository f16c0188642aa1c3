//! The second variation as a matrix for others: to be changed along a direction, and its vectors read as steps of the state.

use super::assemble::{Motions, Numbers, Target, vector};
use super::mesh::Cut;
use crate::held::Held;
use crate::system::Equilibrium;
use flexura_nonlinear::{Breakdown, Symmetric, System};
use flexura_spatial::{Twist, Vector3};
use nalgebra::Vector6;

/// How section moments change along beams, per unit of what changes them.
pub struct Rate {
    /// For each span, for each of its stretches, at both ends.
    moments: Vec<Vec<[Vector3<f64>; 2]>>,
}

/// The second variation at one state.
pub struct Variation {
    matrix: Symmetric,
    cuts: Vec<Cut>,
    numbers: Vec<Numbers>,
    columns: Vec<Target>,
}

impl Variation {
    /// Number of its unknowns.
    pub fn size(&self) -> usize {
        self.matrix.size()
    }

    /// Were both made of as many stretches?
    pub fn fits(&self, other: &Self) -> bool {
        self.size() == other.size()
            && self.cuts.iter().zip(&other.cuts).all(|(a, b)| a.forms.len() == b.forms.len())
    }

    /// The rate between two states `width` apart on either side.
    pub fn rate(minus: &Self, plus: &Self, width: f64) -> Rate {
        let spans = minus.cuts.iter().zip(&plus.cuts).map(|(minus, plus)| {
            let forms = minus.forms.iter().zip(&plus.forms);
            forms
                .map(|(a, b)| [0, 1].map(|i| (b.section_moments[i] - a.section_moments[i]) / (2.0 * width)))
                .collect()
        });
        Rate { moments: spans.collect() }
    }

    /// Adds `factor` times the matrix times `x`.
    pub fn multiply(&self, factor: f64, x: &[f64], out: &mut [f64]) {
        self.matrix.for_each(|i, j, value| out[i] += factor * value * x[j]);
    }

    /// Factorises the matrix for [`Variation::solve`].
    ///
    /// # Errors
    /// It has no inverse: the state is critical.
    pub fn factorise(&mut self) -> Result<(), Breakdown> {
        let inertia = self.matrix.factorise()?;
        if inertia.zero > 0 { Err(Breakdown::Singular) } else { Ok(()) }
    }

    /// Solves in place.
    pub fn solve(&mut self, x: &mut [f64]) {
        self.matrix.solve(x);
    }
}

impl Equilibrium {
    /// The second variation at the present state, every smooth stretch of a beam cut into `parts` at least.
    ///
    /// # Errors
    /// A number overflows.
    pub fn variation(&mut self, parts: usize) -> Result<Variation, Breakdown> {
        self.variation_with(parts, None)
    }

    /// The same with wrenches that have changed while the shape stays: `rate` times `by`. The state holds the changed wrenches.
    ///
    /// # Errors
    /// A number overflows.
    pub fn stressed_variation(&mut self, parts: usize, rate: &Rate, by: f64) -> Result<Variation, Breakdown> {
        let kept: Vec<Vec<[Vector3<f64>; 2]>> = rate
            .moments
            .iter()
            .map(|span| span.iter().map(|ends| ends.map(|moment| moment * by)).collect())
            .collect();
        self.variation_with(parts, Some(&kept))
    }

    fn variation_with(
        &mut self,
        parts: usize,
        kept: Option<&[Vec<[Vector3<f64>; 2]>]>,
    ) -> Result<Variation, Breakdown> {
        // Levels of force, by which beams are cut, are those of the last evaluation.
        self.residual()?;
        let (_, cuts, numbers) = self.second_variation(parts, kept)?;
        let total = self.layout.interface + numbers.iter().map(Numbers::count).sum::<usize>();
        let own: Vec<[usize; 2]> = numbers.iter().map(Numbers::slots).collect();
        let (_, columns, ..) = self.targets(&own, total);
        Ok(Variation { matrix: self.second.symmetric.clone(), cuts, numbers, columns })
    }

    /// A step of the state without its motions: what is left is the change of all wrenches and multipliers.
    pub fn wrench_part(&self, step: &[f64]) -> Vec<f64> {
        let mut part = vec![0.0; step.len()];
        for (_, unknown, count) in self.number_slots() {
            part[unknown..unknown + count].copy_from_slice(&step[unknown..unknown + count]);
        }
        part
    }

    /// Why the mechanism has no second variation; None where it has one.
    pub fn without_energy(&self) -> Option<String> {
        self.undecided()
    }

    /// How bodies move in a vector of the second variation at this state, and the places along every beam that it was cut at: arc
    /// length (m), motion of the axis (m) and turning (rad).
    pub fn motions_of(&self, variation: &Variation, x: &[f64]) -> (Vec<Twist>, Vec<Vec<(f64, Twist)>>) {
        let length = self.lowered.scale.length;
        let value = |plain: usize| variation.columns[plain].at.map_or(0.0, |at| x[at]);
        let six = |first: usize| Vector6::from_fn(|i, _| value(first + i));
        let twist = |v: Vector6<f64>| Twist {
            angular: Vector3::new(v[0], v[1], v[2]),
            linear: Vector3::new(v[3], v[4], v[5]) * length,
        };
        let bodies =
            (0..self.model.bodies.len()).map(|body| twist(six(self.layout.nodes[body].unknown))).collect();
        let mut beams = vec![Vec::new(); self.model.beams.len()];
        for (span, (cut, own)) in variation.cuts.iter().zip(&variation.numbers).enumerate() {
            let (slots, description) = (&self.layout.spans[span], &self.lowered.spans[span]);
            let moved = |held: &Held, unknown: usize| {
                let mut list = Motions::new();
                self.target_columns(held, unknown, |unknown, Twist { angular, linear }| {
                    list.push((unknown, vector(angular, linear)));
                });
                list.iter().map(|(unknown, x)| x * value(*unknown)).sum::<Vector6<f64>>()
            };
            let places = &mut beams[description.beam];
            for (k, form) in cut.forms.iter().enumerate() {
                if k == 0 {
                    let start = self.held_by(&description.start, &slots.start);
                    places.push((form.s[0], twist(moved(&start, slots.start.unknown))));
                }
                let end = match (own.pose(k), &description.end) {
                    (Some(pose), _) => six(pose),
                    (None, Some(end)) => moved(&self.held_by(end, &slots.end), slots.end.unknown),
                    (None, None) => continue,
                };
                places.push((form.s[1], twist(end)));
            }
        }
        beams.iter_mut().for_each(|places| places.sort_by(|a, b| a.0.total_cmp(&b.0)));
        (bodies, beams)
    }
}
