//! Models as a Rust user would build them, each wrong in one way.
#![allow(clippy::unwrap_used)]

use crate::*;
use flexura_expression::Function;

fn good() -> Model {
    Model {
        materials: vec![Material {
            name: "steel".into(),
            young: 207e9,
            shear: 79.3e9,
            density: None,
            yield_strength: None,
        }],
        sections: vec![Section {
            name: "wire".into(),
            shape: Shape::Circle { diameter: 1e-3.into() },
            plane_strain: false,
        }],
        beams: vec![Beam {
            name: "link".into(),
            material: Some(MaterialId(0)),
            section: SectionId(0),
            curve: Curve::Straight { length: 0.1 },
            frame: SectionFrame::Natural,
            theory: BeamTheory::default(),
            start: Some(End { mount: Mount::Ground, placement: None, hold: JointLaw::weld() }),
            end: None,
            distributed: Vec::new(),
        }],
        ..Model::default()
    }
}

fn paths(change: impl Fn(&mut Model)) -> Vec<String> {
    let mut model = good();
    change(&mut model);
    model.validate().into_iter().map(|issue| issue.path).collect()
}

#[test]
fn a_sound_model_has_no_issue() {
    assert_eq!(good().validate(), []);
}

#[test]
fn each_mistake_is_found_where_it_is() {
    let mass = |at| PointMass { name: "m".into(), point: BeamPoint { beam: BeamId(0), at }, mass: 1.0 };
    assert_eq!(paths(|m| m.materials[0].young = f64::NAN), ["material.steel.young"]);
    assert_eq!(paths(|m| m.materials[0].shear = 1e9), ["material.steel.shear"]);
    assert_eq!(paths(|m| m.materials[0].density = Some(-1.0)), ["material.steel.density"]);
    assert_eq!(paths(|m| m.beams[0].section = SectionId(7)), ["beam.link.section"]);
    assert_eq!(paths(|m| m.beams[0].material = None), ["beam.link"]);
    assert_eq!(paths(|m| m.beams[0].curve = Curve::Straight { length: 0.0 }), ["beam.link.length"]);
    assert_eq!(
        paths(|m| m.beams[0].start.as_mut().unwrap().mount = Mount::Body(BodyId(0))),
        ["beam.link.start.body"]
    );
    assert_eq!(paths(|m| m.beams.push(m.beams[0].clone())), ["beam.link"]);
    assert_eq!(paths(|m| m.beams[0].name = "a b".into()), ["beam.a b"]);
    assert_eq!(paths(|m| m.masses.push(mass(At::Length(0.2)))), ["mass.m.at"]);
    assert_eq!(paths(|m| m.masses.push(mass(At::Fraction(-0.1)))), ["mass.m.at"]);
    let taper = Function::parse("1e-3 - 0.02*s", "s").unwrap();
    let shape = Shape::Circle { diameter: Profile::Function(taper) };
    assert_eq!(paths(|m| m.sections[0].shape = shape.clone()), ["section.wire.diameter"]);
    let shape = Shape::Circle { diameter: Profile::Table { at: vec![], value: vec![] } };
    assert_eq!(paths(|m| m.sections[0].shape = shape.clone()), ["section.wire.diameter"]);
}
