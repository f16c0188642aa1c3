//! A model and a result document side by side, and what differences are measured by.

use super::rod::Rod;
use flexura::model::{Attachment, BeamPoint, Frame, Model, Mount};
use flexura::output::{BodyDocument, Document};
use flexura::spatial::{Pose, Quaternion, UnitQuaternion, Vector3, Wrench};

pub type V = Vector3<f64>;

/// A beam's section as the document tells it: where it is and what the beam itself carries there, just before s.
#[derive(Clone, Copy, Debug)]
pub struct Station {
    pub s: f64,
    pub pose: Pose,
    pub wrench: Wrench,
}

/// What is compared.
#[derive(Clone, Debug)]
pub struct Check {
    /// What should vanish, or agree.
    pub what: String,
    /// How far it does not, relative to what the error estimate counts by.
    pub difference: f64,
}

/// A model with its answer.
pub struct Answer<'a> {
    pub model: &'a Model,
    pub document: &'a Document,
    pub bodies: Vec<Pose>,
    pub beams: Vec<Vec<Station>>,
    pub rods: Vec<Rod<'a>>,
    /// The largest beam or distance, m.
    pub length: f64,
    /// The largest force that is carried, or EI/L² that there is, N.
    pub force: f64,
    /// The same of moments, N·m.
    pub moment: f64,
}

pub fn pose(position: &[f64; 3], rotation: &[f64; 4]) -> Pose {
    let [w, x, y, z] = *rotation;
    Pose::new(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)), V::from(*position))
}

impl<'a> Answer<'a> {
    /// # Errors
    /// What of the document does not fit the model.
    pub fn new(model: &'a Model, document: &'a Document) -> Result<Self, String> {
        let mut bodies = Vec::new();
        for body in &model.bodies {
            let BodyDocument { position, rotation } = document
                .bodies
                .get(&body.name)
                .ok_or_else(|| format!("body.{} is not in the document", body.name))?;
            bodies.push(pose(position, rotation));
        }
        let mut beams = Vec::new();
        for beam in &model.beams {
            let told = document
                .beams
                .get(&beam.name)
                .ok_or_else(|| format!("beam.{} is not in the document", beam.name))?;
            let stations = (0..told.s.len()).map(|i| Station {
                s: told.s[i],
                pose: pose(&told.position[i], &told.rotation[i]),
                wrench: Wrench::new(V::from(told.force[i]), V::from(told.moment[i])),
            });
            beams.push(stations.collect::<Vec<_>>());
        }
        let mut answer =
            Self { model, document, bodies, beams, rods: Vec::new(), length: 0.0, force: 0.0, moment: 0.0 };
        for beam in 0..model.beams.len() {
            let rod = Rod::new(&answer, beam)?;
            answer.rods.push(rod);
        }
        answer.measure();
        Ok(answer)
    }

    fn measure(&mut self) {
        for (rod, stations) in self.rods.iter_mut().zip(&self.beams) {
            rod.measure(stations);
            self.length = self.length.max(rod.length);
            self.force = self.force.max(rod.force);
            self.moment = self.moment.max(rod.moment);
        }
        for nest in self.document.tubes.0.iter().map(|(_, nest)| nest) {
            let reach = nest.s.last().copied().unwrap_or(0.0);
            self.length = self.length.max(reach);
            for moment in &nest.moment {
                self.moment = self.moment.max(V::from(*moment).norm());
            }
        }
        if self.length == 0.0 {
            let points = self.model.bodies.iter().map(|body| body.pose.position.norm());
            self.length = points.fold(0.0, f64::max);
            let grounds = self.model.springs.iter().flat_map(|spring| [&spring.from, &spring.to]);
            self.length = grounds.map(|end| end.point.norm()).fold(self.length, f64::max);
        }
        let joints = self.document.joints.0.iter().map(|(_, joint)| joint);
        for joint in joints {
            self.force = self.force.max(V::from(joint.force).norm());
            self.moment = self.moment.max(V::from(joint.moment).norm());
        }
        for (_, spring) in &self.document.springs.0 {
            self.force = self.force.max(spring.tension.abs());
        }
        for (_, cable) in &self.document.cables.0 {
            self.force = self.force.max(cable.tension.abs());
        }
        for body in &self.model.bodies {
            self.force = self.force.max(body.mass * self.model.gravity.norm());
        }
        self.moment = self.moment.max(self.force * self.length);
        // Where nothing has a size, one in SI is as good as any.
        for size in [&mut self.length, &mut self.force, &mut self.moment] {
            if *size == 0.0 {
                *size = 1.0;
            }
        }
    }

    /// Where what carries something is now.
    pub fn carried(&self, mount: &Mount) -> Pose {
        match mount {
            Mount::Ground => Pose::identity(),
            Mount::Body(id) => self.bodies[id.0],
            Mount::Beam(point) => self.station(point).pose,
        }
    }

    /// Where it is in the undeformed mechanism; None where that hangs on itself.
    pub fn at_rest(&self, mount: &Mount, depth: usize) -> Option<Pose> {
        match mount {
            Mount::Ground => Some(Pose::identity()),
            Mount::Body(id) => Some(self.model[*id].pose),
            Mount::Beam(point) => {
                let rod = self.rods.get(point.beam.0)?;
                let home = rod.home(self, depth + 1)?;
                Some(home * rod.shape.pose(point.at.arc_length(rod.length)))
            }
        }
    }

    /// The station at a place of a beam.
    pub fn station(&self, point: &BeamPoint) -> &Station {
        let rod = &self.rods[point.beam.0];
        let s = point.at.arc_length(rod.length);
        let stations = &self.beams[point.beam.0];
        stations.iter().min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs())).unwrap_or(&stations[0])
    }

    pub fn frame(&self, frame: &Frame) -> Pose {
        self.carried(&frame.mount) * frame.pose
    }

    pub fn point(&self, attachment: &Attachment) -> V {
        self.carried(&attachment.mount).point(&attachment.point)
    }
}
