//! Cables (tendons): routed through points without friction, pulled by a tension or kept at a length.

use crate::{At, Attachment, BeamId, Profile};

/// A cable without friction, weight or stiffness in bending: its tension T is the same everywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Cable {
    /// Its name, unique among cables.
    pub name: String,
    /// What it runs through, from its anchored start to its anchored end; at least two guides, or one channel.
    pub route: Vec<Guide>,
    /// What is given.
    pub law: CableLaw,
}

/// What a cable runs through; straight from one guide to the next.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// An eyelet, or an anchor at the two ends.
    Point(Attachment),
    /// A channel along a beam, at an offset from its axis: the cable follows the curve p(s) + y(s) e2 + z(s) e3.
    Channel {
        /// The beam.
        beam: BeamId,
        /// Where the cable enters and leaves the channel; it may run towards the beam's start.
        between: [At; 2],
        /// y and z against s, m.
        offset: [Profile; 2],
    },
}

/// What is given of a cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CableLaw {
    /// T, N.
    Tension(f64),
    /// The length from anchor to anchor, m; T is found.
    Length(f64),
}
