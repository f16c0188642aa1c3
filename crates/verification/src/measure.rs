//! Solving, and how far a solution is from a reference.

use flexura_model::Model;
use flexura_solution::{BeamSample, BeamSolution, Solution, Status};
use flexura_spatial::{Pose, Wrench};
use flexura_study::Options;
use flexura_testkit::rod::State;

/// Samples along each beam.
pub const SAMPLES: usize = 41;

/// Solves from rest.
///
/// # Errors
/// The model is wrong, or the solve did not converge to the tolerance.
pub fn solve(model: &Model, tolerance: f64) -> Result<Solution, String> {
    let options = Options { tolerance, samples: SAMPLES, ..Options::default() };
    let solution = flexura_study::solve(model, &options, &mut |_| {}).map_err(|error| error.to_string())?;
    match solution.status {
        Status::Converged => Ok(solution),
        status => Err(format!(
            "{} to {tolerance:.0e}: {}",
            status.word(),
            solution.reason.as_deref().unwrap_or("no reason given")
        )),
    }
}

/// By what errors of a beam are measured.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// L, m.
    pub length: f64,
    /// EI, the softest of bending and torsion, N·m².
    pub stiffness: f64,
}

impl Units {
    /// EI/L², N.
    pub fn force(&self) -> f64 {
        self.stiffness / self.length.powi(2)
    }

    /// EI/L, N·m.
    pub fn moment(&self) -> f64 {
        self.stiffness / self.length
    }

    /// The largest of position / L, angle / 1, force / (EI/L²), moment / (EI/L) by which `sample` differs.
    pub fn deviation(&self, sample: &BeamSample, pose: &Pose, wrench: &Wrench) -> f64 {
        let position = (sample.pose.position - pose.position).norm() / self.length;
        let angle = sample.pose.rotation.angle_to(&pose.rotation);
        let force = (sample.wrench.force - wrench.force).norm() / self.force();
        let moment = (sample.wrench.moment - wrench.moment).norm() / self.moment();
        worst([position, angle, force, moment])
    }
}

/// The largest of some magnitudes; NaN if one of them is.
pub fn worst(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |a, b| if b.is_nan() || a.is_nan() { f64::NAN } else { a.max(b) })
}

/// The largest deviation of any pose and wrench along a beam from `exact(s)`, by the beam's units.
pub fn largest_deviation(beam: &BeamSolution, units: &Units, exact: &dyn Fn(f64) -> (Pose, Wrench)) -> f64 {
    worst(beam.samples.iter().map(|sample| {
        let (pose, wrench) = exact(sample.s);
        units.deviation(sample, &pose, &wrench)
    }))
}

/// The largest distance of the axis from `exact(s)`, in lengths of the beam.
pub fn largest_distance(beam: &BeamSolution, exact: &dyn Fn(f64) -> flexura_spatial::Vector3<f64>) -> f64 {
    worst(beam.samples.iter().map(|sample| (sample.pose.position - exact(sample.s)).norm() / beam.length))
}

/// The far end of a beam.
///
/// # Errors
/// The beam has no samples.
pub fn tip(beam: &BeamSolution) -> Result<&BeamSample, String> {
    beam.samples.last().ok_or_else(|| "the beam has no samples".to_string())
}

/// The start of a beam.
///
/// # Errors
/// The beam has no samples.
pub fn root(beam: &BeamSolution) -> Result<&BeamSample, String> {
    beam.samples.first().ok_or_else(|| "the beam has no samples".to_string())
}

/// Pose and wrench of a reference state.
pub fn parts(state: &State) -> (Pose, Wrench) {
    (state.pose(), state.wrench())
}

/// The largest deviation between two solutions of one beam, sample by sample.
///
/// # Errors
/// They are sampled at different places.
pub fn apart(a: &BeamSolution, b: &BeamSolution, units: &Units) -> Result<f64, String> {
    let same = a.samples.len() == b.samples.len()
        && a.samples.iter().zip(&b.samples).all(|(p, q)| (p.s - q.s).abs() <= 1e-12 * a.length);
    if !same {
        return Err("the two solutions are sampled at different places".to_string());
    }
    let pairs = a.samples.iter().zip(&b.samples);
    Ok(worst(pairs.map(|(p, q)| units.deviation(p, &q.pose, &q.wrench))))
}
