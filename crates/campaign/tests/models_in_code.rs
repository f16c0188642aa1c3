//! Models as a program would build them, sound and broken: the broken are refused with a place, whatever is broken, and none panics.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::model::{
    At, BeamId, BeamPoint, BodyId, CableLaw, Guide, Load, LoadFrame, LoadTarget, MaterialId, Model, Mount,
    Profile, SectionId,
};
use flexura::modelfile::Document;
use flexura::spatial::Vector3;
use flexura::{Prepared, solve};
use flexura_campaign::mechanism;

const MODELS: u64 = 1000;
/// The most ways of breaking a model that are tried.
const WAYS: usize = 24;

/// Breaks something. False where the model has nothing of the kind.
fn broken(model: &mut Model, way: usize, which: usize) -> bool {
    fn one<T>(list: &mut [T], which: usize) -> Option<&mut T> {
        let count = list.len().max(1);
        list.get_mut(which % count)
    }
    let nowhere = Mount::Body(BodyId(1000));
    let beyond = BeamPoint { beam: BeamId(0), at: At::Fraction(1.5) };
    let load = |target| Load {
        name: "broken".into(),
        target,
        force: Vector3::zeros(),
        moment: Vector3::zeros(),
        frame: LoadFrame::Global,
    };
    let (beams, bodies) = (model.beams.len(), model.bodies.len());
    let change = match way {
        0 => one(&mut model.beams, which).map(|beam| beam.section = SectionId(1000)),
        1 => one(&mut model.beams, which).map(|beam| beam.material = Some(MaterialId(1000))),
        2 => one(&mut model.beams, which)
            .and_then(|beam| beam.start.as_mut().or(beam.end.as_mut()))
            .map(|end| end.mount = nowhere),
        3 => one(&mut model.beams, which)
            .and_then(|beam| beam.start.as_mut().or(beam.end.as_mut()))
            .map(|end| end.mount = Mount::Beam(BeamPoint { beam: BeamId(beams), at: At::Fraction(0.5) })),
        4 => one(&mut model.joints, which).map(|joint| joint.child = nowhere),
        5 => one(&mut model.joints, which).map(|joint| joint.parent.mount = nowhere),
        6 => one(&mut model.joints, which)
            .filter(|joint| joint.law.kind.freedoms() > 0)
            .map(|joint| joint.law.coordinates.clear()),
        7 => one(&mut model.joints, which)
            .map(|joint| joint.law.coordinates.resize(9, flexura::model::CoordinateLaw::default())),
        8 => one(&mut model.joints, which).map(|joint| joint.parent.pose.position.y = f64::INFINITY),
        9 => one(&mut model.joints, which)
            .and_then(|joint| joint.law.coordinates.first_mut())
            .map(|law| law.stiffness = f64::NAN),
        10 => one(&mut model.springs, which).map(|spring| spring.from.mount = nowhere),
        11 => one(&mut model.springs, which).map(|spring| spring.to.point.z = f64::NAN),
        12 => one(&mut model.springs, which).map(|spring| spring.size = f64::NAN),
        13 => one(&mut model.cables, which).map(|cable| cable.law = CableLaw::Tension(f64::NAN)),
        14 => one(&mut model.cables, which).and_then(|cable| cable.route.first_mut()).map(|guide| {
            *guide = Guide::Channel {
                beam: BeamId(beams),
                between: [At::Fraction(0.0), At::Fraction(1.0)],
                offset: [Profile::Constant(0.0), Profile::Constant(0.0)],
            }
        }),
        15 => one(&mut model.bodies, which).map(|body| body.mass = -1.0),
        16 => one(&mut model.bodies, which).map(|body| body.pose.position.x = f64::NAN),
        17 => one(&mut model.materials, which).map(|material| material.young = 0.0),
        18 => one(&mut model.loads, which).map(|load| load.force.x = f64::NAN),
        19 => (beams > 0).then(|| model.loads.push(load(LoadTarget::Beam(beyond)))),
        20 => {
            model.loads.push(load(LoadTarget::Body { body: BodyId(bodies), point: Vector3::zeros() }));
            Some(())
        }
        21 => one(&mut model.beams, which)
            .and_then(|beam| beam.distributed.first_mut())
            .map(|load| load.force[0] = Profile::Constant(f64::NAN)),
        22 => one(&mut model.couplings, which)
            .and_then(|coupling| coupling.terms.first_mut())
            .map(|term| term.joint.0 = 1000),
        _ => {
            model.gravity.z = f64::NAN;
            Some(())
        }
    };
    change.is_some()
}

#[test]
fn broken_models_are_refused_whatever_is_broken_and_sound_ones_are_not() {
    let (mut sound, mut refused) = (0, 0);
    for seed in 1..=MODELS {
        let text = mechanism(seed).text;
        let Ok(model) = Document::parse(&text, "drawn.toml").and_then(|document| document.model(&[])) else {
            panic!("seed {seed} is no model")
        };
        assert_eq!(model.validate(), [], "seed {seed}");
        sound += 1;
        for way in 0..WAYS {
            let mut changed = model.clone();
            if !broken(&mut changed, way, seed as usize) {
                continue;
            }
            let Err(error) = Prepared::new(&changed) else {
                panic!("seed {seed}, way {way}: taken for sound")
            };
            assert!(!error.path.is_empty() && !error.message.is_empty(), "seed {seed}, way {way}: {error:?}");
            assert_eq!(solve(&changed, &flexura::Options::default(), &mut |_| {}).unwrap_err(), error);
            refused += 1;
        }
    }
    assert!(sound + refused >= 10_000, "{sound} {refused}");
}
