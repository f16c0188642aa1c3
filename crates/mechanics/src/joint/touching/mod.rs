//! A surface of the child that touches one of the parent, in space: the thesis's bio-joint in its general form (Chapter III).
//! It slides there without friction, with five freedoms, or rolls along a path, with one.

mod closest;
mod law;
mod path;

pub use law::TouchingLaw;
pub(super) use path::Path;
pub use path::RollingPath;

use super::spherical::{Spherical, vector};
use super::{Configuration, ContactError, ContactState, Kinematics, MAX_FREEDOMS};
use closest::{closest, retracted};
use flexura_geometry::dual::vector::{Rows, Triple, difference, dot, moving, scaled, tangents};
use flexura_spatial::{Pose, Twist, UnitQuaternion, Vector3, exp, log};
use std::sync::Arc;

/// A contact that slides: the configuration is the rotation vector of R, as a ball joint keeps it, and the host's place in units of a
/// length. H is the identity on turnings in F's axes with the host's place kept, and moves that place along its tangents t1, t2 with R kept.
#[derive(Clone, Debug)]
pub(super) struct Touching {
    pub law: Arc<TouchingLaw>,
    home: Configuration,
    /// Lengths are in units of this many metres.
    unit: f64,
}

/// The rows of a rotation.
fn rows(rotation: &UnitQuaternion<f64>) -> Rows<f64> {
    let matrix = rotation.to_rotation_matrix();
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}

fn nowhere() -> Twist {
    Twist { angular: Vector3::repeat(f64::NAN), linear: Vector3::repeat(f64::NAN) }
}

/// 1/κ; None where straight.
fn radius(curvature: f64) -> Option<f64> {
    if curvature == 0.0 { None } else { Some(1.0 / curvature) }
}

impl Touching {
    /// The contact nearest to the initial poses, `offset` in SI, is home.
    pub fn new(law: Arc<TouchingLaw>, unit: f64, offset: &Pose) -> Result<Self, ContactError> {
        let host = closest(&law, &rows(&offset.rotation), &offset.position.into())?;
        let mut made = Self { law, home: Configuration::default(), unit };
        made.home = made.stored(&log(&offset.rotation), &host);
        Ok(made)
    }

    fn stored(&self, turned: &Vector3<f64>, host: &Triple<f64>) -> Configuration {
        let [x, y, z] = host.map(|x| x / self.unit);
        [turned.x, turned.y, turned.z, x, y, z, 0.0]
    }

    fn rotation(configuration: &Configuration) -> UnitQuaternion<f64> {
        exp(&vector(configuration))
    }

    /// m.
    fn host(&self, configuration: &Configuration) -> Triple<f64> {
        [3, 4, 5].map(|i: usize| configuration[i] * self.unit)
    }

    fn tangents(&self, host: &Triple<f64>) -> [Triple<f64>; 2] {
        tangents(&self.law.hosting().normal(host))
    }

    /// Units of a coordinate's step.
    fn step_unit(&self, i: usize) -> f64 {
        if i < 3 { 1.0 } else { self.unit }
    }

    /// Where and how the surfaces touch, SI.
    pub fn contact(&self, configuration: &Configuration) -> Option<ContactState> {
        let rotation = rows(&Self::rotation(configuration));
        let place = self.law.place(&rotation, &self.host(configuration))?;
        let [child, parent] = self.law.surfaces();
        let sense = self.law.sense;
        Some(ContactState {
            points: [place.child.into(), place.parent.into()],
            normal: Vector3::from(place.normal) * sense,
            direction: Vector3::zeros(),
            parameters: [child.parameters(&place.child), parent.parameters(&place.parent)],
            radii: [
                radius(child.curvatures(&place.child).most),
                radius(sense * parent.curvatures(&place.parent).most),
            ],
            travel: [0.0; 2],
            rates: [0.0; 2],
            fits: self.law.fits(&rotation, &place),
        })
    }
}

impl Kinematics for Touching {
    fn home(&self) -> Configuration {
        self.home
    }
    fn pose(&self, configuration: &Configuration) -> Pose {
        let rotation = Self::rotation(configuration);
        match self.law.place(&rows(&rotation), &self.host(configuration)) {
            Some(place) => Pose::new(rotation, Vector3::from(place.position()) / self.unit),
            // Beyond the end of a surface there is no pose; the state is refused.
            None => Pose::translation(Vector3::repeat(f64::NAN)),
        }
    }
    fn subspace(&self, configuration: &Configuration, i: usize) -> Twist {
        let rotation = rows(&Self::rotation(configuration));
        let column = self.law.column(&rotation, &self.host(configuration), i);
        column.map_or_else(nowhere, |linear| Twist {
            angular: if i < 3 { Vector3::from(law::axis::<f64>(i)) } else { Vector3::zeros() },
            linear: Vector3::from(linear) * (self.step_unit(i) / self.unit),
        })
    }
    fn subspace_change(&self, configuration: &Configuration, i: usize, j: usize) -> Twist {
        let rotation = rows(&Self::rotation(configuration));
        let change = self.law.column_change(&rotation, &self.host(configuration), i, j);
        change.map_or_else(nowhere, |linear| Twist {
            angular: Vector3::zeros(),
            linear: Vector3::from(linear) * (self.step_unit(i) * self.step_unit(j) / self.unit),
        })
    }
    /// R turns by the first three; the host's place moves along its tangents and returns to the surface straight below (the
    /// orthographic retraction: Absil and Malick, "Projection-like retractions on matrix manifolds", SIAM J. Optim. 22 (2012)), of
    /// which `step` is the inverse.
    fn moved(&self, configuration: &Configuration, step: &[f64]) -> Configuration {
        let turned = vector(&Spherical.moved(configuration, step));
        let aside = [step[3] * self.unit, step[4] * self.unit];
        let host = retracted(&self.law, &self.host(configuration), &aside);
        self.stored(&turned, &host.unwrap_or([f64::NAN; 3]))
    }
    fn step(&self, from: &Configuration, to: &Configuration) -> [f64; MAX_FREEDOMS] {
        let mut step = Spherical.step(from, to);
        let host = self.host(from);
        let way = difference(&self.host(to), &host);
        for (i, tangent) in self.tangents(&host).iter().enumerate() {
            step[3 + i] = dot(tangent, &way) / self.unit;
        }
        step
    }
    fn coordinates(&self, configuration: &Configuration) -> [f64; MAX_FREEDOMS] {
        let mut coordinates = Spherical.coordinates(configuration);
        let [u, v] = self.law.hosting().parameters(&self.host(configuration));
        (coordinates[3], coordinates[4]) = (u, v);
        coordinates
    }
    fn configuration(&self, coordinates: &[f64]) -> Configuration {
        let turned = vector(&Spherical.configuration(coordinates));
        let host = self.law.hosting().point([coordinates[3], coordinates[4]]);
        self.stored(&turned, &host.unwrap_or([f64::NAN; 3]))
    }
    /// The rotation as of a spherical joint; efforts on the parameters act along the tangents by ∂(u, v)/∂x·t.
    fn generalised(
        &self,
        configuration: &Configuration,
        tau: &[f64; MAX_FREEDOMS],
        slope: &[f64; MAX_FREEDOMS],
    ) -> ([f64; MAX_FREEDOMS], [[f64; MAX_FREEDOMS]; MAX_FREEDOMS]) {
        let (mut value, mut tangent) = Spherical.generalised(configuration, tau, slope);
        let surface = self.law.hosting();
        let host = self.host(configuration);
        let across = self.tangents(&host);
        // A pole, where parameters are singular, does not matter to parameters on which nothing acts.
        let acts = |a: &usize| tau[3 + a] != 0.0 || slope[3 + a] != 0.0;
        let along = across.map(|t| surface.parameters_rate(&host, &scaled(self.unit, &t)));
        for a in (0..2).filter(acts) {
            for i in 0..2 {
                value[3 + i] += tau[3 + a] * along[i][a];
            }
            for j in 0..2 {
                let at = moving(&host, &scaled(self.unit, &across[j]));
                let carried = tangents(&surface.normal(&at));
                for i in 0..2 {
                    let way = carried[i].map(|x| x * self.unit.into());
                    let bend = surface.parameters_rate(&at, &way)[a].rates[0];
                    tangent[3 + i][3 + j] += tau[3 + a] * bend + slope[3 + a] * along[i][a] * along[j][a];
                }
            }
        }
        (value, tangent)
    }
    fn nearest(&self, pose: &Pose) -> Configuration {
        let origin = pose.position * self.unit;
        match closest(&self.law, &rows(&pose.rotation), &origin.into()) {
            Ok(host) => self.stored(&log(&pose.rotation), &host),
            Err(_) => self.stored(&log(&pose.rotation), &[f64::NAN; 3]),
        }
    }
}

#[cfg(test)]
mod path_tests;
#[cfg(test)]
pub(super) mod samples;
#[cfg(test)]
mod tests;
