//! The units that numbers have inside the solver.

use flexura_spatial::{Pose, Wrench};

/// Length and force that are 1 inside. Moments scale by their product.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    /// m.
    pub length: f64,
    /// N.
    pub force: f64,
}

impl Scale {
    pub fn moment(&self) -> f64 {
        self.force * self.length
    }

    pub fn pose_in(&self, pose: &Pose) -> Pose {
        Pose::new(pose.rotation, pose.position / self.length)
    }

    pub fn pose_out(&self, pose: &Pose) -> Pose {
        Pose::new(pose.rotation, pose.position * self.length)
    }

    pub fn wrench_in(&self, wrench: &Wrench) -> Wrench {
        Wrench::new(wrench.force / self.force, wrench.moment / self.moment())
    }

    pub fn wrench_out(&self, wrench: &Wrench) -> Wrench {
        Wrench::new(wrench.force * self.force, wrench.moment * self.moment())
    }
}
