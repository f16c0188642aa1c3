//! The names of places, as outputs write them.

use flexura_model::{At, Model, ProbeTarget};

/// What an output calls it: `body.stage`, `beam.link.start`, `beam.link[0.5]`, `beam.link[0.03 m]`, `joint.way`.
pub fn place_name(model: &Model, target: &ProbeTarget) -> String {
    match *target {
        ProbeTarget::Beam(id, at) => {
            let beam = format!("beam.{}", word(&model[id].name));
            match at {
                At::Fraction(0.0) => format!("{beam}.start"),
                At::Fraction(1.0) => format!("{beam}.end"),
                At::Fraction(fraction) => format!("{beam}[{fraction}]"),
                At::Length(s) => format!("{beam}[{s} m]"),
            }
        }
        ProbeTarget::Body(id) => format!("body.{}", word(&model[id].name)),
        ProbeTarget::Joint(id) => format!("joint.{}", word(&model[id].name)),
        ProbeTarget::Spring(id) => format!("spring.{}", word(&model[id].name)),
        ProbeTarget::Cable(id) => format!("cable.{}", word(&model[id].name)),
        ProbeTarget::Tubes(id) => format!("tubes.{}", word(&model[id].name)),
        ProbeTarget::Model => "model".to_owned(),
    }
}

/// A name in quotes unless it is a plain word.
fn word(name: &str) -> String {
    let is_plain = name.chars().all(|c| c.is_alphanumeric() || c == '_')
        && name.chars().next().is_some_and(|c| !c.is_ascii_digit());
    if is_plain { name.to_owned() } else { format!("\"{name}\"") }
}
