//! Stress and strain along a beam, and where they are largest.

use flexura_geometry::{SectionStress, peak_stress};
use flexura_model::{Beam, Model};
use flexura_solution::{BeamSample, BeamSolution};
use flexura_spatial::Vector3;

/// Stress and strain of one beam.
#[derive(Clone, Debug)]
pub struct BeamStress {
    /// Largest values over the section, one for each sample of the beam.
    pub samples: Vec<SectionStress>,
    /// Largest values over the beam.
    pub peaks: BeamPeaks,
}

/// The value of largest magnitude along a beam, and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The value with its sign; strain, or stress in Pa.
    pub value: f64,
    /// Undeformed arc length, m.
    pub s: f64,
}

/// The largest values along a beam. They need not stand at the same place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamPeaks {
    /// Surface strain.
    pub strain: Peak,
    /// Stress of the axial force.
    pub axial: Peak,
    /// Stress of both bending moments at the outer fibre.
    pub bending: Peak,
    /// Shear stress of the torsion moment.
    pub torsion: Peak,
    /// Equivalent stress.
    pub von_mises: Peak,
    /// Yield strength over the largest von Mises stress. None without a yield strength or without stress.
    pub safety_factor: Option<f64>,
}

/// Stress and strain at every sample of a beam. None where the section has no outer fibre, or no sample.
pub fn beam_stress(model: &Model, beam: &Beam, result: &BeamSolution) -> Option<BeamStress> {
    let material = beam.material.map(|id| &model[id]);
    let section = &model[beam.section];
    let samples: Vec<SectionStress> = result
        .samples
        .iter()
        .map(|sample| {
            let (force, moment) = local_wrench(sample);
            let mut stress = peak_stress(section, material, sample.s, result.length, &force, &moment)?;
            if !beam.theory.extension {
                // The axial force is there and stresses the section, but the beam does not stretch.
                stress.strain = stress.bending_strain;
            }
            Some(stress)
        })
        .collect::<Option<_>>()?;
    if samples.is_empty() {
        return None;
    }
    let peak = |pick: fn(&SectionStress) -> f64| {
        let mut best = Peak { value: pick(&samples[0]), s: result.samples[0].s };
        for (stress, sample) in samples.iter().zip(&result.samples) {
            if pick(stress).abs() > best.value.abs() {
                best = Peak { value: pick(stress), s: sample.s };
            }
        }
        best
    };
    let von_mises = peak(|stress| stress.von_mises);
    let safety_factor = material
        .and_then(|material| material.yield_strength)
        .filter(|_| von_mises.value > 0.0)
        .map(|strength| strength / von_mises.value)
        .filter(|factor| factor.is_finite());
    let peaks = BeamPeaks {
        strain: peak(|stress| stress.strain),
        axial: peak(|stress| stress.axial),
        bending: peak(|stress| stress.bending),
        torsion: peak(|stress| stress.torsion),
        von_mises,
        safety_factor,
    };
    Some(BeamStress { samples, peaks })
}

/// Internal force and moment in the section's own axes e1, e2, e3.
fn local_wrench(sample: &BeamSample) -> (Vector3<f64>, Vector3<f64>) {
    let local = sample.wrench.rotated(&sample.pose.rotation.inverse());
    (local.force, local.moment)
}
