//! What a picture of a mechanism needs besides its states: sections, rest shapes, holds, joints with their axes and
//! boundaries, springs, cables, loads, and what every number is measured in. SI units, quaternions as (w, x, y, z).

mod beside;
mod build;
mod contact;
mod sections;

pub use beside::scene_beside;
pub use build::{loads, scene};
pub(crate) use contact::boundaries;

use crate::Named;
use serde::{Deserialize, Serialize};

/// A mechanism as it is drawn; where things are follows from a state.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct SceneDocument {
    /// SI unit of every output and parameter; "" for a plain number.
    pub units: UnitsDocument,
    /// Global axes, m/s².
    pub gravity: [f64; 3],
    /// Sections and rest shapes.
    pub beams: Named<BeamScene>,
    /// Where bodies are before anything is loaded.
    pub bodies: Named<BodyScene>,
    /// Joints.
    pub joints: Named<JointScene>,
    /// Springs.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub springs: Named<SpringScene>,
    /// Cables.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub cables: Named<CableScene>,
    /// Concentric tubes.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub tubes: Named<TubesScene>,
    /// Masses on beams.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub masses: Named<MassScene>,
    /// Point forces and moments.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub loads: Named<LoadScene>,
    /// The model file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
}

/// SI units as text.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct UnitsDocument {
    /// Of outputs.
    pub outputs: Named<String>,
    /// Of parameters.
    pub parameters: Named<String>,
}

/// A place fixed on something: on a body, on a beam's section, or, where neither is named, on the ground.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct PlaceDocument {
    /// Name of the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Name of the beam.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beam: Option<String>,
    /// Arc length on the beam, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub s: Option<f64>,
    /// In the axes of what carries it, m.
    pub position: [f64; 3],
    /// Relative to the axes of what carries it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 4]>,
}

/// A beam: its section along it, and where it lies at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeamScene {
    /// Name of its section.
    pub section: String,
    /// "rectangle", "circle", "tube", "ellipse" or "stiffness".
    pub shape: String,
    /// Name of its material.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Pa.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_strength: Option<f64>,
    /// Where the dimensions are given, m; straight lines between.
    pub stations: Vec<f64>,
    /// Along e2, m; one number where it is the same everywhere, none for a section given as a stiffness.
    pub width: Vec<f64>,
    /// Along e3, m.
    pub height: Vec<f64>,
    /// Inner diameter of a tube, m.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inner: Vec<f64>,
    /// Arc lengths of the rest shape, m.
    pub s: Vec<f64>,
    /// The axis before anything was loaded, global, m.
    pub position: Vec<[f64; 3]>,
    /// Of the section there.
    pub rotation: Vec<[f64; 4]>,
    /// What holds its start; none is a free end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<HoldScene>,
    /// What holds its end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub end: Option<HoldScene>,
    /// Loads per length.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub distributed: Vec<DistributedScene>,
    /// Elastic foundations.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub foundations: Vec<FoundationScene>,
}

/// What holds the end of a beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HoldScene {
    /// Kind of joint; "weld" is a clamp.
    pub kind: String,
    /// Unit axis in the axes of what holds it.
    pub axis: [f64; 3],
    /// What holds it.
    pub place: PlaceDocument,
}

/// A load per length, at a few places along the beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DistributedScene {
    /// "global" or "section".
    pub frame: String,
    /// m.
    pub s: Vec<f64>,
    /// N/m.
    pub force: Vec<[f64; 3]>,
    /// N·m/m.
    pub moment: Vec<[f64; 3]>,
}

/// An elastic foundation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundationScene {
    /// From where to where, m.
    pub between: [f64; 2],
    /// Unit vector along which it acts; none: in all directions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// "global" or "section": the axes of the direction.
    pub frame: String,
}

/// A body before anything is loaded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyScene {
    /// Global, m.
    pub position: [f64; 3],
    /// (w, x, y, z).
    pub rotation: [f64; 4],
    /// kg.
    pub mass: f64,
    /// In the body's axes, m.
    pub center_of_mass: [f64; 3],
}

/// A joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointScene {
    /// Its kind, in the words of the model file.
    pub kind: String,
    /// The fixed frame F on the parent.
    pub parent: PlaceDocument,
    /// The moving frame M on the child.
    pub child: PlaceDocument,
    /// Unit axis in F's axes.
    pub axis: [f64; 3],
    /// A second unit axis in F's axes.
    pub second_axis: [f64; 3],
    /// Is one of its coordinates driven?
    pub driven: bool,
    /// What touches what, of rolling and contact joints: the child's boundary in M's axes and the parent's in F's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub boundaries: Option<BoundariesScene>,
}

/// Two boundaries that touch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundariesScene {
    /// The moving one.
    pub child: BoundaryScene,
    /// The fixed one.
    pub parent: BoundaryScene,
}

/// A boundary as it is drawn, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "shape", rename_all = "snake_case")]
pub enum BoundaryScene {
    /// A polygon along a curve.
    Curve {
        /// Its corners; the last is the first where the curve is closed.
        points: Vec<[f64; 3]>,
    },
    /// A straight line without ends.
    Line {
        /// A point of it.
        point: [f64; 3],
        /// Unit vector along it.
        direction: [f64; 3],
    },
    /// z = 0, without ends.
    Plane {},
    /// A cylinder along z without ends.
    Cylinder {
        /// Along x and y, m.
        semi_axes: [f64; 2],
    },
    /// A net of points: `rows` lists of equally many points, each list around the z axis and closed.
    Net {
        /// How many lists.
        rows: usize,
        /// List after list.
        points: Vec<[f64; 3]>,
    },
}

/// A spring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpringScene {
    /// One end.
    pub from: PlaceDocument,
    /// The other end.
    pub to: PlaceDocument,
    /// "linear", "exponential", "toe" or "table".
    pub law: String,
    /// What it runs over.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrap: Option<WrapScene>,
}

/// Something round that a spring runs over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WrapScene {
    /// Where its middle is.
    pub place: PlaceDocument,
    /// m.
    pub radius: f64,
    /// Of a cylinder without ends, in the axes of its place; none: a sphere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
}

/// A cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CableScene {
    /// Points it runs through; of a channel, places along the beam's sections.
    pub route: Vec<PlaceDocument>,
    /// Positions in `route` of its anchors and eyelets.
    pub eyelets: Vec<usize>,
}

/// Concentric tubes, the innermost first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TubesScene {
    /// The mouth of their guide, x along the tubes.
    pub base: PlaceDocument,
    /// The tubes.
    pub tubes: Vec<TubeScene>,
    /// Dead force on the tip of the first, global, N.
    pub force: [f64; 3],
    /// Dead moment there, global, N·m.
    pub moment: [f64; 3],
}

/// One of concentric tubes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TubeScene {
    /// Where it ends on the common axis, m.
    pub reach: f64,
    /// Outer diameter, m; none for a section given as a stiffness.
    pub outer: Option<f64>,
}

/// A mass on a beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassScene {
    /// Where it sits.
    pub place: PlaceDocument,
    /// kg.
    pub mass: f64,
}

/// A point force and moment, all of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadScene {
    /// Where it acts.
    pub place: PlaceDocument,
    /// N.
    pub force: [f64; 3],
    /// N·m.
    pub moment: [f64; 3],
    /// "global" or "local".
    pub frame: String,
}

/// Force and moment of a load, N and N·m, where they differ from those of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoadDocument {
    /// N.
    pub force: [f64; 3],
    /// N·m.
    pub moment: [f64; 3],
}
