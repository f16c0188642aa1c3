//! Contacts in the result document.

use crate::OutputError;
use crate::document::{all_finite, finite};
use flexura_solution::ContactSolution;
use serde::{Deserialize, Serialize};

/// Where and how the two bodies of a joint touch.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct ContactDocument {
    /// The contact, global, m.
    pub point: [f64; 3],
    /// Unit normal from the parent to the child, global.
    pub normal: [f64; 3],
    /// Normal force, N; negative where something must pull to keep the two together.
    pub force: f64,
    /// What the parent exerts on the child across the normal, global, N.
    pub friction: [f64; 3],
    /// How far the contact has rolled on the parent since coordinate zero, m.
    pub roll: f64,
    /// How far the child has slid since coordinate zero, m.
    pub slide: f64,
    /// Change of the roll per unit of the coordinate.
    pub roll_rate: f64,
    /// Change of the slide per unit of the coordinate.
    pub slide_rate: f64,
    /// The contact on the child.
    pub child: SideDocument,
    /// The contact on the parent.
    pub parent: SideDocument,
}

/// A contact seen from one of the two bodies.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct SideDocument {
    /// In the axes of the joint's frame on that body, m.
    pub point: [f64; 3],
    /// The boundary's own parameters; a curve has only the first.
    pub parameters: [f64; 2],
    /// Radius of curvature in the direction of travel, m: negative where hollow, null where straight.
    pub radius: Option<f64>,
}

impl ContactDocument {
    /// # Errors
    /// A number that is not finite, with its path.
    pub(crate) fn new(path: &str, contact: &ContactSolution) -> Result<Self, OutputError> {
        let number = |value: f64, name: &str| finite(value, || format!("{path}.{name}"));
        let vector = |value: [f64; 3], name: &str| all_finite(value, || format!("{path}.{name}"));
        let side = |which: usize, name: &str| -> Result<SideDocument, OutputError> {
            let radius = contact.radii[which].map(|radius| number(radius, name)).transpose()?;
            let parameters = contact.parameters[which];
            number(parameters[0], name)?;
            number(parameters[1], name)?;
            Ok(SideDocument { point: vector(contact.points[which].into(), name)?, parameters, radius })
        };
        Ok(Self {
            point: vector(contact.point.into(), "point")?,
            normal: vector(contact.normal.into(), "normal")?,
            force: number(contact.force, "force")?,
            friction: vector(contact.friction.into(), "friction")?,
            roll: number(contact.travel[0], "roll")?,
            slide: number(contact.travel[1], "slide")?,
            roll_rate: number(contact.rates[0], "roll_rate")?,
            slide_rate: number(contact.rates[1], "slide_rate")?,
            child: side(0, "child")?,
            parent: side(1, "parent")?,
        })
    }

    pub(crate) fn solution(&self) -> ContactSolution {
        ContactSolution {
            point: self.point.into(),
            normal: self.normal.into(),
            points: [self.child.point.into(), self.parent.point.into()],
            parameters: [self.child.parameters, self.parent.parameters],
            radii: [self.child.radius, self.parent.radius],
            force: self.force,
            friction: self.friction.into(),
            travel: [self.roll, self.slide],
            rates: [self.roll_rate, self.slide_rate],
        }
    }
}
