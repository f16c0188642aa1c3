//! What is written of a motion in time: document and table.

mod document;
mod table;
mod wire;

pub use document::motion_document;
pub use table::motion_csv;
pub use wire::{
    BodySeries, CableSeries, InverseDynamicsDocument, JointSeries, MotionWorkDocument, Series, SpringSeries,
};

use flexura_model::Model;
use flexura_solution::InverseDynamics;

/// A motion with the model that it belongs to.
#[derive(Clone, Copy, Debug)]
pub struct MotionView<'a> {
    /// The model that the study was asked of.
    pub model: &'a Model,
    /// What came out.
    pub motion: &'a InverseDynamics,
}

impl<'a> MotionView<'a> {
    /// Name and unit of the parameter.
    pub(crate) fn parameter(&self) -> (&'a str, &'a str) {
        let parameter = &self.model.parameters[self.motion.parameter];
        (&parameter.name, &parameter.unit)
    }

    /// Names of all coordinates, each with its joint and its number in the joint: `knee`, or `knee.angle` where there are several.
    pub(crate) fn coordinates(&self) -> Vec<(String, usize, usize)> {
        let joints = self.model.joints.iter().enumerate();
        joints
            .flat_map(|(j, joint)| {
                let names = joint.law.kind.coordinate_names();
                names.iter().enumerate().map(move |(k, name)| {
                    let shown =
                        if names.len() > 1 { format!("{}.{name}", joint.name) } else { joint.name.clone() };
                    (shown, j, k)
                })
            })
            .collect()
    }
}

/// An SI unit per second, or per second squared.
pub(crate) fn per_second(unit: &str, power: usize) -> String {
    let over = if power == 1 { "s" } else { "s^2" };
    match unit {
        "" => format!("1/{over}"),
        unit => format!("{unit}/{over}"),
    }
}
