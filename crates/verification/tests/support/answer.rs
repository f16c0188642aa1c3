//! What a solve says, in a form that can be turned, scaled, read backwards and compared.

use super::transform::about_face;
use flexura_expression::Formula;
use flexura_model::{At, BeamId, Model, Output, Probe, ProbeTarget, Quantity};
use flexura_spatial::{Pose, Wrench};
use flexura_testkit::{assert_close, assert_close_vec};
use flexura_verification::solve;

/// A place along a beam: fraction of the length, pose, internal wrench.
pub type Place = (f64, Pose, Wrench);

/// Everything that must not depend on how the mechanism is described.
#[derive(Clone, Debug)]
pub struct Answer {
    pub bodies: Vec<Pose>,
    pub beams: Vec<Vec<Place>>,
    /// Coordinates, and the wrench on the child.
    pub joints: Vec<(Vec<f64>, Wrench)>,
    pub tensions: Vec<f64>,
    pub energy: f64,
}

impl Answer {
    pub fn of(model: &Model) -> Self {
        let solution = solve(model, 1e-11).unwrap_or_else(|error| panic!("{error}"));
        let beams = solution.beams.iter().map(|beam| {
            beam.samples.iter().map(|sample| (sample.s / beam.length, sample.pose, sample.wrench)).collect()
        });
        Self {
            beams: beams.collect(),
            joints: solution.joints.iter().map(|joint| (joint.coordinates.clone(), joint.wrench)).collect(),
            tensions: solution.springs.iter().map(|spring| spring.tension).collect(),
            energy: solution.energy,
            bodies: solution.bodies,
        }
    }

    pub fn moved(&self, motion: &Pose) -> Self {
        let mut new = self.clone();
        new.bodies.iter_mut().for_each(|pose| *pose = *motion * *pose);
        for (_, pose, wrench) in new.beams.iter_mut().flatten() {
            *pose = *motion * *pose;
            *wrench = wrench.rotated(&motion.rotation);
        }
        new.joints.iter_mut().for_each(|(_, wrench)| *wrench = wrench.rotated(&motion.rotation));
        new
    }

    /// In units of length and force that are 1/a and 1/b as large.
    pub fn in_units(&self, a: f64, b: f64) -> Self {
        let mut new = self.clone();
        let scale = |wrench: &mut Wrench| {
            wrench.force *= b;
            wrench.moment *= a * b;
        };
        new.bodies.iter_mut().for_each(|pose| pose.position *= a);
        for (_, pose, wrench) in new.beams.iter_mut().flatten() {
            pose.position *= a;
            scale(wrench);
        }
        new.joints.iter_mut().for_each(|(_, wrench)| scale(wrench));
        new.tensions.iter_mut().for_each(|tension| *tension *= b);
        new.energy *= a * b;
        new
    }

    /// With one beam read from its other end: the part before is then the part beyond.
    pub fn reversed(&self, beam: usize) -> Self {
        let mut new = self.clone();
        let turn = about_face();
        let backwards =
            self.beams[beam].iter().rev().map(|(at, pose, wrench)| (1.0 - at, *pose * turn, -*wrench));
        new.beams[beam] = backwards.collect();
        new
    }

    /// Without the places of one beam where a force acts: there the internal force jumps, and a sample is the one
    /// or the other side of it, depending on where the beam begins.
    pub fn without_places(mut self, beam: usize, fractions: &[f64]) -> Self {
        self.beams[beam].retain(|place| fractions.iter().all(|at| (place.0 - at).abs() > 1e-9));
        self
    }

    /// Are they the same, to `tolerance` in the given units of length and force?
    #[track_caller]
    pub fn assert_same(&self, other: &Self, length: f64, force: f64, tolerance: f64) {
        let same_pose = |a: &Pose, b: &Pose, what: &str| {
            assert_close_vec(&a.position, &b.position, tolerance * length, what);
            assert_close(a.rotation.angle_to(&b.rotation), 0.0, tolerance, what);
        };
        let same_wrench = |a: &Wrench, b: &Wrench, what: &str| {
            assert_close_vec(&a.force, &b.force, tolerance * force, what);
            assert_close_vec(&a.moment, &b.moment, tolerance * force * length, what);
        };
        assert_eq!(self.bodies.len(), other.bodies.len());
        for (a, b) in self.bodies.iter().zip(&other.bodies) {
            same_pose(a, b, "body");
        }
        assert_eq!(self.beams.len(), other.beams.len());
        for (i, (a, b)) in self.beams.iter().zip(&other.beams).enumerate() {
            assert_eq!(a.len(), b.len(), "samples of beam {i}");
            for (a, b) in a.iter().zip(b) {
                assert_close(a.0, b.0, 1e-12, "place");
                same_pose(&a.1, &b.1, &format!("beam {i} at {}", a.0));
                same_wrench(&a.2, &b.2, &format!("beam {i} at {}", a.0));
            }
        }
        assert_eq!(self.joints.len(), other.joints.len());
        for (a, b) in self.joints.iter().zip(&other.joints) {
            assert_eq!(a.0.len(), b.0.len());
            // Angles all: the mechanism's joints turn.
            a.0.iter().zip(&b.0).for_each(|(a, b)| assert_close(*a, *b, tolerance, "coordinate"));
            same_wrench(&a.1, &b.1, "joint");
        }
        assert_eq!(self.tensions.len(), other.tensions.len());
        for (a, b) in self.tensions.iter().zip(&other.tensions) {
            assert_close(*a, *b, tolerance * force, "tension");
        }
    }
}

/// Asks for samples of a beam at these fractions of its length.
pub fn ask_for(model: &mut Model, beam: usize, fractions: &[f64]) {
    let probes = fractions.iter().map(|&fraction| Probe {
        target: ProbeTarget::Beam(BeamId(beam), At::Fraction(fraction)),
        quantity: Quantity::Position,
        component: 0,
    });
    model.outputs.push(Output {
        name: format!("samples-{}", model.outputs.len()),
        unit: "m".to_string(),
        formulas: vec![Formula::slot(0)],
        probes: probes.collect(),
    });
}
