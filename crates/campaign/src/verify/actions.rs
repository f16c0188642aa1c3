//! Everything that acts on bodies, on the ground and on places of beams.

use super::answer::{Answer, V};
use super::{cables, springs};
use flexura::model::{JointKind, LoadFrame, LoadTarget, Mount};

/// A force at a point, and a moment.
#[derive(Clone, Debug)]
pub struct Action {
    pub on: Mount,
    /// Global, m.
    pub point: V,
    pub force: V,
    pub moment: V,
    /// Is it a load, a weight or a lump, which stands as a jump inside a beam's span?
    pub is_load: bool,
}

impl Action {
    fn new(on: Mount, point: V, force: V) -> Self {
        Self { on, point, force, moment: V::zeros(), is_load: false }
    }

    /// Its moment about a point.
    pub fn about(&self, point: &V) -> V {
        self.moment + (self.point - point).cross(&self.force)
    }
}

impl Answer<'_> {
    /// All actions but those of beams on what holds their ends, which depend on these.
    pub fn actions(&self) -> Vec<Action> {
        let mut actions = self.loads();
        for (joint, described) in self.model.joints.iter().zip(self.joint_documents()) {
            let Some(told) = described else { continue };
            let (force, moment) = (V::from(told.force), V::from(told.moment));
            let child = joint.child_pose.or_else(|| {
                let fixed = self.at_rest(&joint.parent.mount, 0)? * joint.parent.pose;
                Some(self.at_rest(&joint.child, 0)?.inverse() * fixed)
            });
            let Some(child) = child else { continue };
            let point = (self.carried(&joint.child) * child).position;
            actions.push(Action { moment, ..Action::new(joint.child, point, force) });
            actions.push(Action { moment: -moment, ..Action::new(joint.parent.mount, point, -force) });
        }
        for spring in 0..self.model.springs.len() {
            actions.extend(springs::actions(self, spring));
        }
        for cable in 0..self.model.cables.len() {
            actions.extend(cables::actions(self, cable));
        }
        for nest in &self.model.tubes {
            let Some(told) = self.document.tubes.get(&nest.name) else { continue };
            if let (Some(p), Some(f), Some(m)) =
                (told.position.first(), told.force.first(), told.moment.first())
            {
                let (force, moment) = (V::from(*f), V::from(*m));
                actions.push(Action { moment, ..Action::new(nest.base.mount, V::from(*p), force) });
            }
        }
        actions
    }

    pub fn joint_documents(&self) -> impl Iterator<Item = Option<&flexura::output::JointDocument>> {
        self.model.joints.iter().map(|joint| self.document.joints.get(&joint.name))
    }

    fn loads(&self) -> Vec<Action> {
        let mut actions = Vec::new();
        for load in &self.model.loads {
            let (on, point) = match load.target {
                LoadTarget::Body { body, point } => (Mount::Body(body), point),
                LoadTarget::Beam(point) => (Mount::Beam(point), V::zeros()),
            };
            let pose = self.carried(&on);
            let (mut force, mut moment) = (load.force, load.moment);
            if load.frame == LoadFrame::Local {
                (force, moment) = (pose.rotation * force, pose.rotation * moment);
            }
            actions.push(Action { on, point: pose.point(&point), force, moment, is_load: true });
        }
        for mass in &self.model.masses {
            let on = Mount::Beam(mass.point);
            let weight = self.model.gravity * mass.mass;
            actions.push(Action { is_load: true, ..Action::new(on, self.carried(&on).position, weight) });
        }
        for (i, body) in self.model.bodies.iter().enumerate().filter(|(_, body)| body.mass != 0.0) {
            let point = self.bodies[i].point(&body.center_of_mass);
            let on = Mount::Body(flexura::model::BodyId(i));
            actions.push(Action { is_load: true, ..Action::new(on, point, self.model.gravity * body.mass) });
        }
        actions
    }
}

/// Is it a kind whose wrench is known where nothing but the joint's own law is looked at?
pub fn touches(kind: JointKind) -> bool {
    matches!(kind, JointKind::Rolling(_) | JointKind::Contact | JointKind::SurfaceRolling)
}
