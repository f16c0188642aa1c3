//! A mechanism, the same mechanism told in other ways, and their answers.

pub mod answer;
pub mod mechanism;
pub mod transform;
