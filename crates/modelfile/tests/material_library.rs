//! Materials by the names of the library.
#![allow(clippy::unwrap_used)]

use flexura_model::{Model, known_material};
use flexura_modelfile::Document;

fn model(material: &str) -> Model {
    let text = format!(
        r#"
format = 1
[parameter]
modulus = "70 GPa"
nu = 0.25
[material.leaf]
{material}
[section.leaf]
shape = "rectangle"
width = "10 mm"
height = "1 mm"
[beam.leaf]
material = "leaf"
section = "leaf"
length = "100 mm"
start = {{ body = "ground", hold = "clamp" }}
"#
    );
    Document::parse(&text, "leaf.toml").and_then(|file| file.model(&[])).unwrap()
}

#[test]
fn the_library_gives_what_is_not_written_beside_it() {
    let known = known_material("titanium-6al-4v").unwrap();
    let plain = &model("library = \"titanium-6al-4v\"").materials[0];
    assert_eq!((plain.young, plain.density, plain.yield_strength), (114e9, Some(4430.0), Some(830e6)));
    assert_eq!(plain.shear, known.shear_with(114e9));
    let own =
        &model("library = \"titanium-6al-4v\"\ndensity = \"4500 kg/m^3\"\nshear = \"40 GPa\"").materials[0];
    assert_eq!((own.young, own.shear, own.density), (114e9, 40e9, Some(4500.0)));
}

#[test]
fn another_young_keeps_the_ratio_of_an_isotropic_material_and_follows_its_parameter() {
    let leaf = model("library = \"spring-steel\"\nyoung = \"modulus\"");
    let ratio = 206.0 / (2.0 * 81.5) - 1.0;
    let shear = |young: f64| young / (2.0 * (1.0 + ratio));
    assert!((leaf.materials[0].shear / shear(70e9) - 1.0).abs() < 1e-14);
    let moved = leaf.at(&[(0, 80e9)]).unwrap();
    assert_eq!(moved.materials[0].young, 80e9);
    assert!((moved.materials[0].shear / shear(80e9) - 1.0).abs() < 1e-14);
    // Along fibres E and G are independent of each other.
    assert_eq!(model("library = \"carbon-epoxy-ud\"\nyoung = \"modulus\"").materials[0].shear, 7.17e9);
}

#[test]
fn a_ratio_beside_the_library_gives_the_shear_modulus_and_follows_its_parameter() {
    let leaf = model("library = \"spring-steel\"\npoisson = \"nu\"");
    assert_eq!(leaf.materials[0].shear, 206e9 / 2.5);
    let moved = leaf.at(&[(1, 0.5)]).unwrap();
    assert_eq!((moved.materials[0].young, moved.materials[0].shear), (206e9, 206e9 / 3.0));
}

#[test]
fn a_material_of_the_library_is_written_out_with_its_numbers() {
    let leaf = model("library = \"peek\"");
    let text = flexura_modelfile::to_toml(&leaf).unwrap();
    let again = Document::parse(&text, "again.toml").and_then(|file| file.model(&[])).unwrap();
    assert_eq!(again.materials, leaf.materials);
}
