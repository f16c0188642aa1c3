//! Strains beyond what a linear material and a beam of small strains stand for.

use crate::Evaluation;
use flexura_model::Model;
use flexura_solution::Solution;

/// The largest strain that is taken without a word.
const LARGE: f64 = 0.05;

/// A warning where beams are strained by more than 5 %: which most, how much, and how many others. A section that is
/// given as a stiffness has no outer fibre; of it the stretch of the axis counts.
pub fn large_strain(model: &Model, solution: &Solution, evaluation: &Evaluation) -> Option<String> {
    let strain =
        |(result, stress): (&flexura_solution::BeamSolution, &Option<crate::BeamStress>)| match stress {
            Some(stress) => stress.peaks.strain.value.abs(),
            None => result.samples.iter().map(|sample| sample.strain.x.abs()).fold(0.0, f64::max),
        };
    let strains = solution.beams.iter().zip(&evaluation.beams).map(strain);
    let mut large: Vec<(usize, f64)> = strains.enumerate().filter(|(_, strain)| *strain > LARGE).collect();
    large.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (most, strain) = *large.first()?;
    let others = match large.len() {
        1 => String::new(),
        2 => format!(", and that of beam.{}", model.beams[large[1].0].name),
        count => format!(", and those of {} other beams", count - 1),
    };
    Some(format!(
        "the strain of beam.{} reaches {:.1} %{others}: beyond 5 % hardly any material is linear, and sections change their shape",
        model.beams[most].name,
        100.0 * strain
    ))
}
