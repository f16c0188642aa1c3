//! The same mechanism described in other ways.

use flexura_expression::Function;
use flexura_geometry::RestShape;
use flexura_model::*;
use flexura_spatial::{Pose, Vector3, exp};
use std::f64::consts::PI;

/// The section's axes seen by who goes along the beam the other way: a half turn about e2.
pub fn about_face() -> Pose {
    Pose::new(exp(&Vector3::new(0.0, PI, 0.0)), Vector3::zeros())
}

fn constant(profile: &Profile) -> f64 {
    profile.as_constant().expect("the mechanism's distributed loads are uniform")
}

fn mapped(profiles: &[Profile; 3], f: impl Fn(Vector3<f64>) -> Vector3<f64>) -> [Profile; 3] {
    let v = f(Vector3::from_iterator(profiles.iter().map(constant)));
    [v.x, v.y, v.z].map(Profile::Constant)
}

/// The whole mechanism turned and moved by `motion`, ground, gravity and dead loads included.
pub fn moved(model: &Model, motion: &Pose) -> Model {
    let mut new = model.clone();
    let turn = |v: &Vector3<f64>| motion.rotation * v;
    new.gravity = turn(&model.gravity);
    for body in &mut new.bodies {
        body.pose = *motion * body.pose;
    }
    for beam in &mut new.beams {
        for (end, is_start) in [(&mut beam.start, true), (&mut beam.end, false)] {
            if let Some(end) = end
                && end.mount == Mount::Ground
            {
                end.placement = match end.placement {
                    None if is_start => Some(*motion),
                    None => None,
                    Some(pose) => Some(*motion * pose),
                };
            }
        }
        for load in beam.distributed.iter_mut().filter(|load| load.axes == LoadAxes::Global) {
            load.force = mapped(&load.force, |v| turn(&v));
            load.moment = mapped(&load.moment, |v| turn(&v));
        }
        for bed in beam.foundation.iter_mut().filter(|bed| bed.axes == LoadAxes::Global) {
            bed.direction = bed.direction.map(|direction| turn(&direction));
        }
    }
    for joint in &mut new.joints {
        assert!(joint.child != Mount::Ground, "not needed here");
        if joint.parent.mount == Mount::Ground {
            joint.parent.pose = *motion * joint.parent.pose;
        }
    }
    for spring in &mut new.springs {
        for end in [&mut spring.from, &mut spring.to] {
            if end.mount == Mount::Ground {
                end.point = motion.point(&end.point);
            }
        }
    }
    for load in new.loads.iter_mut().filter(|load| load.frame == LoadFrame::Global) {
        load.force = turn(&load.force);
        load.moment = turn(&load.moment);
    }
    new
}

/// The same mechanism in units of length and force that are 1/a and 1/b as large; the unit of time stays.
pub fn in_units(model: &Model, a: f64, b: f64) -> Model {
    let mut new = model.clone();
    let mass = b / a;
    new.gravity *= a;
    for material in &mut new.materials {
        material.young *= b / (a * a);
        material.shear *= b / (a * a);
        material.density = material.density.map(|density| density * mass / a.powi(3));
    }
    for section in &mut new.sections {
        match &mut section.shape {
            Shape::Rectangle { width, height } => {
                scale(width, a);
                scale(height, a);
            }
            Shape::Stiffness { ea, gj, ei2, ei3, ga2, ga3, mass_per_length, rotary_inertia: _ } => {
                scale(ea, b);
                [gj, ei2, ei3].into_iter().for_each(|profile| scale(profile, b * a * a));
                [ga2, ga3].into_iter().flatten().for_each(|profile| scale(profile, b));
                mass_per_length.iter_mut().for_each(|profile| scale(profile, mass / a));
            }
            other => panic!("not needed here: {other:?}"),
        }
    }
    for beam in &mut new.beams {
        match &mut beam.curve {
            Curve::Straight { length } => *length *= a,
            Curve::Arc { radius, .. } => *radius *= a,
            Curve::Helix { radius, pitch, .. } => {
                *radius *= a;
                *pitch *= a;
            }
            other => panic!("not needed here: {other:?}"),
        }
        for end in [&mut beam.start, &mut beam.end].into_iter().flatten() {
            end.placement.iter_mut().for_each(|pose| pose.position *= a);
        }
        for load in &mut beam.distributed {
            load.force.iter_mut().for_each(|profile| scale(profile, b / a));
            load.moment.iter_mut().for_each(|profile| scale(profile, b));
        }
        for bed in &mut beam.foundation {
            match &mut bed.law {
                FoundationLaw::Linear(profile) => scale(profile, b / (a * a)),
                FoundationLaw::Force(law) => {
                    let text = law.text().replace('u', &format!("(u*{:?})", 1.0 / a));
                    *law = Function::parse(&format!("{:?}*({text})", b / a), "u").expect("a law");
                }
            }
        }
    }
    for body in &mut new.bodies {
        body.pose.position *= a;
        body.center_of_mass *= a;
        body.mass *= mass;
    }
    for joint in &mut new.joints {
        assert_eq!(joint.law.kind, JointKind::Revolute, "not needed here");
        joint.parent.pose.position *= a;
        for law in &mut joint.law.coordinates {
            law.stiffness *= a * b;
            if let Drive::Free { effort } = &mut law.drive {
                *effort *= a * b;
            }
        }
    }
    for spring in &mut new.springs {
        let SpringLaw::Linear { stiffness, .. } = &mut spring.law else { panic!("not needed here") };
        *stiffness *= b / a;
        spring.rest_length.iter_mut().for_each(|length| *length *= a);
        for end in [&mut spring.from, &mut spring.to] {
            if let Attachment { mount: Mount::Ground | Mount::Body(_), point } = end {
                *point *= a;
            }
        }
    }
    new.masses.iter_mut().for_each(|point| point.mass *= mass);
    for load in &mut new.loads {
        load.force *= b;
        load.moment *= a * b;
        if let LoadTarget::Body { point, .. } = &mut load.target {
            *point *= a;
        }
    }
    new
}

fn scale(profile: &mut Profile, factor: f64) {
    match profile {
        Profile::Constant(value) => *value *= factor,
        Profile::Table { value, .. } => value.iter_mut().for_each(|value| *value *= factor),
        Profile::Function(_) | Profile::Notch(_) => panic!("not needed here"),
    }
}

fn flipped(at: At) -> At {
    match at {
        At::Fraction(fraction) => At::Fraction(1.0 - fraction),
        At::Length(_) => panic!("not needed here"),
    }
}

fn body_pose(model: &Model, body: Mount) -> Pose {
    match body {
        Mount::Ground => Pose::identity(),
        Mount::Body(id) => model[id].pose,
        Mount::Beam(_) => panic!("not needed here"),
    }
}

/// Where a beam lies when nothing is loaded: its start, global, and its shape.
fn rest(model: &Model, beam: usize) -> (Pose, RestShape) {
    let description = &model.beams[beam];
    let start = description.start.as_ref().expect("all beams have a start");
    let shape = RestShape::new(&description.curve, &description.frame).expect("a good curve");
    (body_pose(model, start.mount) * start.placement.unwrap_or(Pose::identity()), shape)
}

/// One beam described from its other end. Its curve is uniform, so that it reads the same both ways.
pub fn reversed(model: &Model, beam: usize) -> Model {
    let mut new = model.clone();
    let turn = about_face();
    let (start_pose, shape) = rest(model, beam);
    let old = &model.beams[beam];
    let start = old
        .start
        .clone()
        .map(|end| End { placement: Some(body_pose(model, end.mount).inverse() * start_pose * turn), ..end });
    let far = start_pose * shape.pose(shape.length()) * turn;
    let end = old.end.clone().map(|end| {
        assert!(end.placement.is_none(), "not needed here");
        End { placement: Some(body_pose(model, end.mount).inverse() * far), ..end }
    });
    new.beams[beam].start = end;
    new.beams[beam].end = start;
    let seen = |v: &Vector3<f64>| turn.rotation.inverse() * v;
    for load in new.beams[beam].distributed.iter_mut().filter(|load| load.axes == LoadAxes::Section) {
        load.force = mapped(&load.force, |v| seen(&v));
        load.moment = mapped(&load.moment, |v| seen(&v));
    }
    for bed in &mut new.beams[beam].foundation {
        bed.between = [flipped(bed.between[1]), flipped(bed.between[0])];
        if bed.axes == LoadAxes::Section {
            bed.direction = bed.direction.map(|direction| seen(&direction));
        }
    }
    // A section of its own, read from the other end.
    let mut section = model[old.section].clone();
    section.name = "read_backwards".to_string();
    if let Shape::Rectangle { width: Profile::Table { at, value }, .. } = &mut section.shape {
        *at = at.iter().rev().map(|at| flipped(*at)).collect();
        value.reverse();
    }
    new.sections.push(section);
    new.beams[beam].section = SectionId(new.sections.len() - 1);
    for load in &mut new.loads {
        if let LoadTarget::Beam(point) = &mut load.target
            && point.beam.0 == beam
        {
            point.at = flipped(point.at);
            if load.frame == LoadFrame::Local {
                load.force = seen(&load.force);
                load.moment = seen(&load.moment);
            }
        }
    }
    for mass in new.masses.iter_mut().filter(|mass| mass.point.beam.0 == beam) {
        mass.point.at = flipped(mass.point.at);
    }
    for spring in &mut new.springs {
        for end in [&mut spring.from, &mut spring.to] {
            if let Mount::Beam(point) = &mut end.mount
                && point.beam.0 == beam
            {
                point.at = flipped(point.at);
            }
        }
    }
    new
}

/// One beam cut in two at a fraction of its length, the halves welded to a massless body; the second half is
/// the last beam, the body the last body. For beams of uniform section that no spring holds on to.
pub fn split(model: &Model, beam: usize, fraction: f64) -> Model {
    let mut new = model.clone();
    let (start_pose, shape) = rest(model, beam);
    let place = start_pose * shape.pose(fraction * shape.length());
    let knot = Mount::Body(BodyId(new.bodies.len()));
    new.bodies.push(Body {
        name: "knot".to_string(),
        pose: place,
        mass: 0.0,
        center_of_mass: Vector3::zeros(),
        inertia: flexura_spatial::Matrix3::zeros(),
    });
    let shorter = |curve: &Curve, part: f64| match curve {
        Curve::Straight { length } => Curve::Straight { length: length * part },
        Curve::Arc { radius, angle } => Curve::Arc { radius: *radius, angle: angle * part },
        other => panic!("not needed here: {other:?}"),
    };
    let whole = &model.beams[beam];
    let ends = [At::Fraction(0.0), At::Fraction(1.0)];
    assert!(whole.foundation.iter().all(|bed| bed.between == ends), "not needed here");
    let second = Beam {
        name: "second_half".to_string(),
        curve: shorter(&whole.curve, 1.0 - fraction),
        start: Some(End { mount: knot, placement: None, hold: JointLaw::weld() }),
        ..whole.clone()
    };
    let first = &mut new.beams[beam];
    first.curve = shorter(&whole.curve, fraction);
    first.end = Some(End { mount: knot, placement: None, hold: JointLaw::weld() });
    new.beams.push(second);
    let last = BeamId(new.beams.len() - 1);
    let points = new.loads.iter_mut().filter_map(|load| match &mut load.target {
        LoadTarget::Beam(point) => Some(point),
        LoadTarget::Body { .. } => None,
    });
    for point in points.chain(new.masses.iter_mut().map(|mass| &mut mass.point)) {
        if let (true, At::Fraction(at)) = (point.beam.0 == beam, point.at) {
            if at < fraction {
                point.at = At::Fraction(at / fraction);
            } else {
                *point = BeamPoint { beam: last, at: At::Fraction((at - fraction) / (1.0 - fraction)) };
            }
        }
    }
    new
}

/// A list in another order: what was at `order[i]` comes to place i.
fn reordered<T: Clone>(list: &[T], order: &[usize]) -> Vec<T> {
    order.iter().filter(|&&i| i < list.len()).map(|&i| list[i].clone()).collect()
}

/// Where what was at `old` has gone.
pub fn place_of(order: &[usize], old: usize, length: usize) -> usize {
    order.iter().filter(|&&i| i < length).position(|&i| i == old).expect("a permutation")
}

/// Everything in another order, by one permutation of at least as many numbers as any list is long, and under
/// other names.
pub fn permuted(model: &Model, order: &[usize]) -> Model {
    let mut new = model.clone();
    new.beams = reordered(&model.beams, order);
    new.bodies = reordered(&model.bodies, order);
    new.joints = reordered(&model.joints, order);
    new.springs = reordered(&model.springs, order);
    new.loads = reordered(&model.loads, order);
    new.masses = reordered(&model.masses, order);
    new.sections = reordered(&model.sections, order);
    let body = |body: &mut Mount| {
        if let Mount::Body(id) = body {
            *id = BodyId(place_of(order, id.0, model.bodies.len()));
        }
    };
    let on_beam = |point: &mut BeamPoint| {
        point.beam = BeamId(place_of(order, point.beam.0, model.beams.len()));
    };
    for (i, beam) in new.beams.iter_mut().enumerate() {
        beam.name = format!("z{}", 9 - i);
        beam.section = SectionId(place_of(order, beam.section.0, model.sections.len()));
        [&mut beam.start, &mut beam.end].into_iter().flatten().for_each(|end| body(&mut end.mount));
    }
    for (i, item) in new.bodies.iter_mut().enumerate() {
        item.name = format!("y{}", 9 - i);
    }
    for joint in &mut new.joints {
        joint.name = format!("x_{}", joint.name);
        body(&mut joint.parent.mount);
        body(&mut joint.child);
    }
    for spring in &mut new.springs {
        for end in [&mut spring.from, &mut spring.to] {
            match &mut end.mount {
                Mount::Beam(point) => on_beam(point),
                on => body(on),
            }
        }
    }
    for load in &mut new.loads {
        load.name = format!("w_{}", load.name);
        match &mut load.target {
            LoadTarget::Beam(point) => on_beam(point),
            LoadTarget::Body { body, .. } => {
                *body = BodyId(place_of(order, body.0, model.bodies.len()));
            }
        }
    }
    new.masses.iter_mut().for_each(|mass| on_beam(&mut mass.point));
    new
}
