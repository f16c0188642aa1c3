//! No mode is missed: random mechanisms against a mesh of 40 cubic elements a beam, which knows nothing of the solver; and frequencies
//! do not depend on axes, places, cuts or units.
//!
//! 20 mechanisms are compared each time, all 200 by `cargo nextest run -p flexura --test modes_counted --run-ignored all`.

use flexura::model::ModesStudy;
use flexura::modelfile::Document;
use flexura::{Options, modes};
use flexura_testkit::frames::{FrameBeam, FrameBody, FrameSection, frequencies_below, turned};
use nalgebra::{Matrix3, Rotation3, Vector3};
use std::fmt::Write;

type V = Vector3<f64>;

/// Modes that are asked for.
const COUNT: usize = 10;

/// S. Vigna's splitmix64.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn axis(&mut self) -> V {
        V::from_fn(|_, _| self.between(-1.0, 1.0)).normalize()
    }
}

/// Straight beams between bodies, the first from the ground.
struct Mechanism {
    bodies: Vec<FrameBody>,
    places: Vec<V>,
    beams: Vec<FrameBeam>,
    /// Where each beam starts.
    starts: Vec<V>,
}

fn mechanism(seed: u64) -> Mechanism {
    let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d).wrapping_add(1));
    let mut made =
        Mechanism { bodies: Vec::new(), places: Vec::new(), beams: Vec::new(), starts: Vec::new() };
    let count = 1 + (random.unit() * 4.0) as usize;
    for i in 0..count {
        let axes = turned(&random.axis(), random.between(0.0, 3.0));
        let length = random.between(0.3, 1.5);
        let soft = random.between(0.5, 3.0);
        let section = FrameSection {
            stretching: random.between(3e3, 3e4),
            twisting: random.between(0.5, 2.0),
            bending: [soft * random.between(1.0, 9.0), soft],
            mass: random.between(0.5, 2.0),
            polar: random.between(0.01, 0.05),
        };
        let from = (i > 0).then(|| (random.unit() * made.places.len() as f64) as usize);
        let start = from.map_or(V::zeros(), |body| made.places[body]);
        // Some loops are closed to the ground.
        let closes = i > 0 && random.unit() < 0.4;
        let end = if closes { None } else { Some(made.bodies.len()) };
        made.beams.push(FrameBeam { ends: [from, end], length, axes, section });
        made.starts.push(start);
        if !closes {
            let mut moment = || random.between(0.001, 0.05);
            let inertia = [moment(), moment(), moment()];
            // No moment of inertia is larger than the sum of the others.
            let most = inertia.iter().sum::<f64>() / 2.0;
            let inertia = inertia.map(|moment| moment.min(0.99 * most));
            made.bodies.push(FrameBody { mass: random.between(0.0, 0.5), inertia });
            made.places.push(start + axes.column(0) * length);
        }
    }
    made
}

fn list(v: &V, unit: f64) -> String {
    format!("[{:e}, {:e}, {:e}]", v.x * unit, v.y * unit, v.z * unit)
}

fn hold(body: Option<usize>, at: &V, axes: &Matrix3<f64>, unit: f64) -> String {
    let turn = Rotation3::from_matrix_unchecked(*axes).scaled_axis();
    let (name, at) = body.map_or(("ground".to_owned(), *at), |body| (format!("b{body}"), V::zeros()));
    let angle = turn.norm();
    let axis = if angle > 0.0 { turn / angle } else { V::x() };
    format!(
        "{{ body = \"{name}\", hold = \"clamp\", at = {}, rotation = {{ axis = {}, angle = {angle:e} }} }}",
        list(&at, unit),
        list(&axis, 1.0)
    )
}

/// How a mechanism is written: moved, lengths by a unit, every beam cut in two.
#[derive(Clone, Copy)]
struct Writing {
    turn: Matrix3<f64>,
    shift: V,
    unit: f64,
    is_cut: bool,
}

const PLAIN: Writing = Writing {
    turn: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
    shift: V::new(0.0, 0.0, 0.0),
    unit: 1.0,
    is_cut: false,
};

fn text(made: &Mechanism, how: Writing) -> String {
    let unit = how.unit;
    let mut text = String::from("format = 1\nname = \"random frame\"\n");
    let moved = |place: &V| how.turn * place + how.shift;
    for (i, (body, place)) in made.bodies.iter().zip(&made.places).enumerate() {
        // The body's own axes turn with everything; its inertia is given in them.
        let turn = Rotation3::from_matrix_unchecked(how.turn).scaled_axis();
        let angle = turn.norm();
        let axis = if angle > 0.0 { turn / angle } else { V::x() };
        let [x, y, z] = body.inertia.map(|moment| moment * unit * unit);
        let _ = write!(
            text,
            "[body.b{i}]\nat = {}\nrotation = {{ axis = {}, angle = {angle:e} }}\nmass = {:e}\ninertia = [{x:e}, {y:e}, {z:e}]\n",
            list(&moved(place), unit),
            list(&axis, 1.0),
            body.mass
        );
    }
    for (i, (beam, start)) in made.beams.iter().zip(&made.starts).enumerate() {
        let section = &beam.section;
        // Forces go like the length, so that frequencies stay: EI with its cube, EA with the length.
        let bending = unit.powi(3);
        let _ = write!(
            text,
            "[section.s{i}]\nshape = \"stiffness\"\nEA = {:e}\nGJ = {:e}\nEI2 = {:e}\nEI3 = {:e}\nmass_per_length = {:e}\nrotary_inertia = [{:e}, 0, 0]\n",
            section.stretching * unit,
            section.twisting * bending,
            section.bending[0] * bending,
            section.bending[1] * bending,
            section.mass / unit,
            section.polar * unit
        );
        // On the ground in global axes, on a body in its own.
        let axes = |body: Option<usize>| if body.is_some() { beam.axes } else { how.turn * beam.axes };
        let end = start + beam.axes.column(0) * beam.length;
        let first = hold(beam.ends[0], &moved(start), &axes(beam.ends[0]), unit);
        let last = hold(beam.ends[1], &moved(&end), &axes(beam.ends[1]), unit);
        if how.is_cut {
            let middle = moved(&(start + beam.axes.column(0) * (0.37 * beam.length)));
            let turned = how.turn * beam.axes;
            let here = Rotation3::from_matrix_unchecked(turned).scaled_axis();
            let _ = write!(
                text,
                "[body.cut{i}]\nat = {}\nrotation = {{ axis = {}, angle = {:e} }}\n",
                list(&middle, unit),
                list(&here.normalize(), 1.0),
                here.norm()
            );
            for (part, share, from, to) in [
                ("a", 0.37, first.clone(), format!("{{ body = \"cut{i}\", hold = \"clamp\" }}")),
                ("b", 0.63, format!("{{ body = \"cut{i}\", hold = \"clamp\" }}"), last.clone()),
            ] {
                let length = share * beam.length * unit;
                let _ = write!(
                    text,
                    "[beam.r{i}{part}]\nsection = \"s{i}\"\nlength = {length:e}\nstart = {from}\nend = {to}\n"
                );
            }
            continue;
        }
        let length = beam.length * unit;
        let _ = write!(
            text,
            "[beam.r{i}]\nsection = \"s{i}\"\nlength = {length:e}\nstart = {first}\nend = {last}\n"
        );
    }
    text
}

fn rates(made: &Mechanism, how: Writing) -> Vec<f64> {
    let text = text(made, how);
    let file = Document::parse(&text, "frame.toml").unwrap_or_else(|report| panic!("{report:?}\n{text}"));
    let model = file.model(&[]).unwrap_or_else(|report| panic!("{report:?}\n{text}"));
    let study = ModesStudy { count: COUNT, at_rest: true, path: None };
    let found = modes(&model, &study, &Options::default(), &mut |_| {})
        .unwrap_or_else(|error| panic!("{error}\n{text}"));
    found.modes.iter().map(|mode| mode.rate).collect()
}

fn compare(seeds: std::ops::Range<u64>) {
    for seed in seeds {
        let made = mechanism(seed);
        let rates = rates(&made, PLAIN);
        assert_eq!(rates.len(), COUNT, "mechanism {seed}");
        // Between frequencies that lie apart by more than the mesh is off.
        let gaps = (0..COUNT - 1).filter(|k| rates[k + 1] > 1.03 * rates[*k]);
        let mut compared = 0;
        for k in gaps {
            let omega = (rates[k] * rates[k + 1]).sqrt();
            let counted = frequencies_below(&made.bodies, &made.beams, 40, omega);
            assert_eq!(counted, k + 1, "mechanism {seed} below {omega}: {rates:?}");
            compared += 1;
        }
        assert!(compared >= 3, "mechanism {seed}: {rates:?}");
    }
}

#[test]
fn twenty_random_mechanisms_have_as_many_modes_as_their_meshes() {
    compare(0..20);
}

#[test]
#[ignore = "all of them take a while; see the head of this file"]
fn two_hundred_random_mechanisms_have_as_many_modes_as_their_meshes() {
    compare(0..200);
}

#[test]
fn frequencies_do_not_depend_on_axes_places_cuts_or_units() {
    for seed in 0..6 {
        let made = mechanism(seed);
        let plain = rates(&made, PLAIN);
        let turn = turned(&V::new(0.3, -1.0, 0.6), 1.1);
        let others = [
            ("turned", Writing { turn, ..PLAIN }),
            ("moved", Writing { shift: V::new(3.0, -2.0, 7.0), ..PLAIN }),
            ("cut", Writing { is_cut: true, ..PLAIN }),
            ("in other units", Writing { unit: 1e-3, ..PLAIN }),
        ];
        for (name, how) in others {
            for (a, b) in plain.iter().zip(rates(&made, how)) {
                assert!((a - b).abs() <= 1e-9 * a, "mechanism {seed} {name}: {b} instead of {a}");
            }
        }
    }
}
