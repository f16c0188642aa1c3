//! Models that are built in code are checked like those of files: what makes no sense is refused with its place, and nothing panics.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::model::{At, BeamId, BeamPoint, LoadTarget, Model, Mount, SectionId};
use flexura::modelfile::Document;
use flexura::solution::Status;
use flexura::spatial::Vector3;
use flexura::{Options, Prepared, solve};

const SOUND: &str = r#"
format = 1
[section.s]
shape = "stiffness"
EA = 1e5
GJ = 1
EI2 = 1
EI3 = 1
[body.stage]
at = [1, 0, 0]
[joint.hinge]
kind = "revolute"
axis = [0, 0, 1]
stiffness = 1
parent = "ground"
child = "stage"
[beam.b]
section = "s"
length = 1
start = { body = "ground", hold = "clamp" }
end = { body = "stage", hold = "pin" }
[load.l]
beam = "b"
at = 0.5
force = [0, 0.1, 0]
"#;

fn sound() -> Model {
    Document::parse(SOUND, "test.toml").unwrap().model(&[]).unwrap()
}

/// The path and the words with which a change is refused.
fn refused(change: impl FnOnce(&mut Model)) -> String {
    let mut model = sound();
    change(&mut model);
    let error = solve(&model, &Options::default(), &mut |_| {}).unwrap_err();
    assert!(Prepared::new(&model).is_err());
    format!("{}: {}", error.path, error.message)
}

#[test]
fn what_makes_no_sense_is_refused_and_does_not_panic() {
    let solution = solve(&sound(), &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged);
    let on = |beam, at| LoadTarget::Beam(BeamPoint { beam: BeamId(beam), at });
    let section = refused(|m| m.beams[0].section = SectionId(7));
    assert_eq!(section, "beam.b.section: refers to a section that does not exist");
    let missing = refused(|m| m.loads[0].target = on(3, At::Fraction(0.5)));
    assert_eq!(missing, "load.l.at: refers to a beam that does not exist");
    let beyond = refused(|m| m.loads[0].target = on(0, At::Length(1.5)));
    assert!(beyond.starts_with("load.l.at: the place") && beyond.contains("beam `b`"), "{beyond}");
    let axis = refused(|m| m.joints[0].law.axis = Vector3::new(0.0, 0.0, 2.0));
    assert_eq!(axis, "joint.hinge.axis: the axis must be a unit vector");
    let law = refused(|m| m.joints[0].law.coordinates.clear());
    assert!(law.starts_with("joint.hinge"), "{law}");
    let child = refused(|m| m.joints[0].child = Mount::Body(flexura::model::BodyId(9)));
    assert_eq!(child, "joint.hinge.child.body: refers to a body that does not exist");
    let force = refused(|m| m.loads[0].force.x = f64::NAN);
    assert!(force.starts_with("load.l.force"), "{force}");
    let output = refused(|m| {
        let wanted = "hinge = \"joint.hinge.coordinate\"";
        let text = format!("{SOUND}[output]\n{wanted}\n");
        *m = Document::parse(&text, "test.toml").unwrap().model(&[]).unwrap();
        m.joints.clear();
    });
    assert!(output.starts_with("output.hinge"), "{output}");
}
