//! Inertia that beams carry besides their own, against closed forms of the clamped bar EI = ρA = L = 1 without shear and rotary inertia
//! (R. D. Blevins, *Formulas for Natural Frequency and Mode Shape*, 1979, tables 8-1 and 8-8).

use flexura::model::ModesStudy;
use flexura::modelfile::{Document, to_toml};
use flexura::{Options, modes};

/// Rates in the plane of EI3, of a bar that is much stiffer across it.
fn rates(keys: &str, more: &str, mass: f64) -> Vec<f64> {
    let text = format!(
        "format = 1\nname = \"bar\"\n[section.bar]\nshape = \"stiffness\"\nGJ = 1e6\nEI2 = 1e6\nEI3 = 1\nmass_per_length = {mass}\n\
         rotary_inertia = [1e-3, 0, 0]\n[beam.bar]\nsection = \"bar\"\nlength = 1\nextension = false\n{keys}\n\
         start = {{ body = \"ground\", hold = \"clamp\" }}\n{more}\n"
    );
    let model = Document::parse(&text, "bar.toml").expect("a good file").model(&[]).expect("a good model");
    // What is written is read back as the same.
    let written = to_toml(&model).expect("a model that files can hold");
    let again =
        Document::parse(&written, "again.toml").expect("a good file").model(&[]).expect("a good model");
    assert_eq!((&again.beams, &again.masses), (&model.beams, &model.masses));
    let study = ModesStudy { count: 4, at_rest: true, path: None };
    let found = modes(&model, &study, &Options::default(), &mut |_| {}).expect("a sound model");
    found.modes.iter().map(|mode| mode.rate).collect()
}

fn close(found: &[f64], wanted: &[f64]) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() <= 1e-8 * wanted, "{found} instead of {wanted}");
    }
}

#[test]
fn added_mass_moves_with_a_beam_like_its_own() {
    let wanted = [3.516_015_268_5, 22.034_491_564_7, 61.697_214_414, 120.901_916_053];
    close(&rates("added_mass = 0.75", "", 0.25), &wanted);
}

#[test]
fn a_lumped_mass_at_the_tip_turns_with_its_inertia() {
    // 1 + cos β cosh β + m β (cos β sinh β - sin β cosh β) - J β³ (cos β sinh β + sin β cosh β) + m J β⁴ (1 - cos β cosh β) = 0.
    let (mass, inertia) = (0.5, 0.02);
    let more = format!("[mass.tip]\nbeam = \"bar\"\nat = 1\nmass = {mass}\ninertia = [0, 0, {inertia}]");
    let found = rates("", &more, 1.0);
    close(&found, &[1.959_346_204_3, 11.201_764_478, 28.784_629_181, 66.327_419_528]);
    for rate in found {
        let b: f64 = rate.sqrt();
        let (c, s, ch, sh) = (b.cos(), b.sin(), b.cosh(), b.sinh());
        let value = 1.0 + c * ch + mass * b * (c * sh - s * ch) - inertia * b.powi(3) * (c * sh + s * ch)
            + mass * inertia * b.powi(4) * (1.0 - c * ch);
        assert!(value.abs() < 1e-6 * ch * b.powi(4), "{rate}: {value}");
    }
}
