//! Beams on elastic foundations: energy and work, balance, stability however beams are cut, scaling, parts and combinations.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used, clippy::panic)]

use flexura::modelfile::Document;
use flexura::post::{self, OutputValue};
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};
use flexura_testkit::foundation::{Cantilever, hinged_column};
use std::f64::consts::PI;

fn solved(text: &str, values: &[(&str, f64)], tolerance: f64) -> (Solution, Vec<(String, Vec<f64>)>) {
    let overrides: Vec<(String, String)> =
        values.iter().map(|(name, value)| (name.to_string(), format!("{value:e}"))).collect();
    let document = Document::parse(text, "model.toml").unwrap_or_else(|report| panic!("{report}\n{text}"));
    let model = document.model(&overrides).unwrap_or_else(|report| panic!("{report}\n{text}"));
    let options = Options { tolerance, samples: 11, ..Options::default() };
    let solution = solve(&model, &options, &mut |_| {}).unwrap_or_else(|error| panic!("{error:?}\n{text}"));
    assert_eq!(solution.status, Status::Converged, "{:?}\n{text}", solution.reason);
    let outputs =
        post::evaluate(&model, &solution).unwrap().outputs.into_iter().map(|output| match output.value {
            OutputValue::Number(number) => (output.name, vec![number]),
            OutputValue::Vector(vector) => (output.name, vector.to_vec()),
        });
    (solution, outputs.collect())
}

fn value(outputs: &[(String, Vec<f64>)], name: &str) -> Vec<f64> {
    outputs.iter().find(|(known, _)| known == name).unwrap().1.clone()
}

const SECTION: &str = "
[section.rod]
shape = \"stiffness\"
EA = 400
GJ = 0.7
EI2 = 1
EI3 = 1.4
";

/// A bent rod on a hardening and a softening law, under a dead force that is `f` times as large as said.
fn bent() -> String {
    format!(
        "format = 1
[parameter]
f = 1
{SECTION}
[beam.rod]
section = \"rod\"
curve = {{ kind = \"arc\", radius = 0.8, angle = 1.2 }}
start = {{ body = \"ground\", hold = \"clamp\", rotation = {{ axis = [1, 2, -1], angle = 0.7 }} }}
foundation = [
  {{ force = \"2*u + 90*u^3\", direction = [0.2, 1, 0.4] }},
  {{ force = \"3*sin(2*u)\", direction = [0, 1, -1], axes = \"section\", from = 0.3 }},
  {{ stiffness = \"1 + 2*s\", to = 0.8 }},
]
[load.tip]
beam = \"rod\"
at = 1
force = [\"1.5*f\", \"-2*f\", \"3*f\"]
[output]
work = \"1.5*beam.rod.end.displacement.x - 2*beam.rod.end.displacement.y + 3*beam.rod.end.displacement.z\"
energy = \"model.energy\"
total = \"beam.rod.foundation_force\"
balance = \"beam.rod.end.force - beam.rod.start.force + beam.rod.foundation_force\"
before = \"beam.rod[0.3].foundation\"
"
    )
}

/// U(1) - U(0) = ∫ f dy = y(1) - ∫ y df, by Gauss quadrature with five points on four parts.
#[test]
fn the_energy_is_the_work_of_the_loads() {
    let text = bent();
    let at = |f: f64| {
        let (_, outputs) = solved(&text, &[("f", f)], 1e-11);
        (value(&outputs, "work")[0], value(&outputs, "energy")[0])
    };
    let nodes = [0.0, 0.538_469_310_105_683_1, 0.906_179_845_938_664];
    let weights = [128.0 / 225.0, 0.478_628_670_499_366_5, 0.236_926_885_056_189_1];
    let mut sum = 0.0;
    for middle in [0.125, 0.375, 0.625, 0.875] {
        for (node, weight) in nodes.iter().zip(&weights) {
            for sign in if *node == 0.0 { vec![1.0] } else { vec![1.0, -1.0] } {
                sum += 0.125 * weight * at(middle + 0.125 * sign * node).0;
            }
        }
    }
    let (work, energy) = at(1.0);
    assert!(energy > 0.5, "{energy}");
    assert!((work - sum - energy).abs() < 1e-8 * energy, "{} against {energy}", work - sum);
}

/// F(L) - F(0) = -∫ q ds, where no other load acts along the beam; and the sum of the samples tells the same roughly.
#[test]
fn the_whole_force_is_in_balance_with_those_at_the_ends() {
    let (solution, outputs) = solved(&bent(), &[], 1e-11);
    let total = value(&outputs, "total");
    assert!(total.iter().map(|x| x * x).sum::<f64>().sqrt() > 0.5, "{total:?}");
    for part in value(&outputs, "balance") {
        assert!(part.abs() < 1e-8, "{part}");
    }
    let samples = &solution.beams[0].samples;
    let sum: f64 =
        samples.windows(2).map(|p| 0.5 * (p[1].s - p[0].s) * (p[0].foundation + p[1].foundation).y).sum();
    assert!((sum - total[1]).abs() < 0.1 * total[1].abs(), "{sum} against {}", total[1]);
    // Where a foundation begins, what is before it counts: the law across is not there yet.
    let at = samples.iter().position(|s| (s.s / solution.beams[0].length - 0.3).abs() < 1e-9).unwrap();
    assert_eq!(value(&outputs, "before"), samples[at].foundation.as_slice());
}

/// A hinged column that is pushed with `push`, in π² EI/L², on one or two laws, made in different ways.
fn column(how: &str, laws: &str, push: f64) -> String {
    let section = "[section.rod]\nshape = \"stiffness\"\nEA = inf\nGJ = 1\nEI2 = 1\nEI3 = 40\n";
    let hinge = "hold = \"revolute\", axis = [0, 1, 0]";
    let foot = format!("{{ body = \"ground\", {hinge} }}");
    let head = format!("{{ body = \"head\", {hinge} }}");
    let beam = |name: &str, length: f64, start: &str, end: &str| {
        let end = if end.is_empty() { String::new() } else { format!("end = {end}\n") };
        format!(
            "[beam.{name}]\nsection = \"rod\"\nlength = {length}\nstart = {start}\n{end}foundation = {laws}\n"
        )
    };
    let beams = match how {
        "whole" => beam("a", 1.0, &foot, &head),
        // From the head to the foot.
        "reversed" => {
            let turned = "rotation = { axis = [0, 1, 0], angle = \"180 deg\" }";
            beam(
                "a",
                1.0,
                &format!("{{ body = \"head\", {hinge}, {turned} }}"),
                &format!("{{ body = \"ground\", {hinge}, at = [0, 0, 0], {turned} }}"),
            )
        }
        "spliced" => {
            beam("a", 0.37, &foot, "")
                + &beam("b", 0.63, "{ beam = \"a\", at = 1.0, hold = \"clamp\" }", &head)
        }
        "joined" => {
            let knot = "{ body = \"knot\", hold = \"clamp\" }";
            format!(
                "[body.knot]\nat = [0.6, 0, 0]\n{}{}",
                beam("a", 0.6, &foot, knot),
                beam("b", 0.4, knot, &head)
            )
        }
        _ => {
            let spring = "[spring.none]\nstiffness = 1e-9\nfrom = { body = \"ground\", at = [0.2, 5, 5] }\nto = { beam = \"a\", at = 0.3 }\n";
            beam("a", 1.0, &foot, &head) + spring
        }
    };
    format!(
        "format = 1\n{section}[body.head]\nat = [1, 0, 0]\n[joint.way]\nkind = \"prismatic\"\nparent = {{ body = \"ground\", at = [1, 0, 0] }}\n\
         child = \"head\"\naxis = [-1, 0, 0]\neffort = {}\n{beams}",
        push * PI * PI
    )
}

#[test]
fn the_count_does_not_depend_on_how_a_column_is_cut() {
    for bed in [1.0, 15.0, 200.0] {
        let loads: Vec<f64> =
            hinged_column(bed * PI.powi(4), 4).iter().map(|(load, _)| load / (PI * PI)).collect();
        let laws = format!("{{ stiffness = {}, direction = [0, 0, 1] }}", bed * PI.powi(4));
        for how in ["whole", "reversed", "spliced", "joined", "hub"] {
            for wanted in 0..4_usize {
                let below = if wanted == 0 { 0.0 } else { loads[wanted - 1] };
                let push = 0.5 * (below + loads[wanted]);
                let (solution, _) = solved(&column(how, &laws, push), &[], 1e-9);
                let count = solution.unstable_directions;
                assert_eq!(
                    count,
                    Some(wanted),
                    "{how}, bed {bed}, push {push}: {:?}",
                    solution.stability_reason
                );
            }
        }
    }
}

/// What pulls the column away by k u, k in π⁴ EI/L⁴, bends it without any push in every half wave with m⁴ < k.
#[test]
fn a_law_that_pulls_away_counts_against_the_column() {
    for how in ["whole", "spliced", "joined"] {
        for (pull, wanted) in [(0.5, 0), (8.0, 1), (40.0, 2), (200.0, 3)] {
            let laws = format!("{{ force = \"-{}*sin(u)\", direction = [0, 0, 1] }}", pull * PI.powi(4));
            let (solution, _) = solved(&column(how, &laws, 0.0), &[], 1e-9);
            assert_eq!(
                solution.unstable_directions,
                Some(wanted),
                "{how}, {pull}: {:?}",
                solution.stability_reason
            );
        }
        // Half of it pulls and half pushes back: nothing is left.
        let law = |sign: &str| format!("{{ force = \"{sign}3000*u\", direction = [0, 0, 1] }}");
        let (solution, _) = solved(&column(how, &format!("[{}, {}]", law("-"), law("")), 0.9), &[], 1e-9);
        assert_eq!(solution.unstable_directions, Some(0), "{how}");
    }
}

/// The half of a beam that is on a foundation, as a part of a whole and as a beam of its own.
#[test]
fn a_foundation_along_a_part_is_that_of_a_beam_of_its_own() {
    let load = |beam: &str| {
        format!(
            "[load.tip]\nbeam = \"{beam}\"\nat = 1\nforce = [-1, 2, 3]\n[output]\np = \"beam.{beam}.end.position\"\n"
        )
    };
    let clamp = "start = { body = \"ground\", hold = \"clamp\" }";
    let whole = format!(
        "format = 1\n{SECTION}[beam.a]\nsection = \"rod\"\nlength = 1\n{clamp}\nfoundation = {{ stiffness = 30, from = 0.4 }}\n{}",
        load("a")
    );
    let two = format!(
        "format = 1\n{SECTION}[beam.a]\nsection = \"rod\"\nlength = 0.4\n{clamp}\n[beam.b]\nsection = \"rod\"\nlength = 0.6\n\
         start = {{ beam = \"a\", at = 1.0, hold = \"clamp\" }}\nfoundation = {{ stiffness = 30 }}\n{}",
        load("b")
    );
    let (one, other) = (solved(&whole, &[], 1e-10).1, solved(&two, &[], 1e-10).1);
    for (a, b) in value(&one, "p").iter().zip(&value(&other, "p")) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

/// All in directions alike is the same as three directions at right angles, turned or not; and stiffness as a law.
#[test]
fn directions_add_up() {
    let text = |foundation: &str| {
        format!(
            "format = 1\n{SECTION}[beam.a]\nsection = \"rod\"\nlength = 1\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n\
             foundation = {foundation}\n[load.tip]\nbeam = \"a\"\nat = 1\nforce = [-1, 2, 3]\nmoment = [0.5, 0, 0]\n\
             [output]\np = \"beam.a.end.position\"\nq = \"beam.a.end.foundation\"\nu = \"model.energy\"\n"
        )
    };
    let base = solved(&text("{ stiffness = 25 }"), &[], 1e-10).1;
    let triple = |law: &str, axes: &str| {
        let one = |d: &str| format!("{{ {law}, direction = [{d}], axes = \"{axes}\" }}");
        format!("[{}, {}, {}]", one("2, 1, 2"), one("1, 2, -2"), one("-2, 2, 1"))
    };
    for (law, axes) in
        [("stiffness = 25", "global"), ("stiffness = 25", "section"), ("force = \"25*u\"", "global")]
    {
        let other = solved(&text(&triple(law, axes)), &[], 1e-10).1;
        for ((name, a), (_, b)) in base.iter().zip(&other) {
            for (a, b) in a.iter().zip(b) {
                assert!((a - b).abs() < 1e-8, "{law} {axes} {name}: {a} {b}");
            }
        }
    }
}

/// Almost all of a stiff cantilever lies still: what happens at the tip is that of an endless one, and the mesh is cut.
#[test]
fn a_boundary_layer_is_resolved_in_several_segments() {
    let text = "format = 1\n[parameter]\nk = 1\n[section.unit]\nshape = \"stiffness\"\nEA = inf\nGJ = 1\nEI2 = 1\nEI3 = 1\n\
         [beam.a]\nsection = \"unit\"\nlength = 1\nstart = { body = \"ground\", hold = \"clamp\" }\n\
         foundation = { stiffness = \"k\", direction = [0, 1, 0] }\n[load.tip]\nbeam = \"a\"\nat = 1\nforce = [0, 1e-3, 0]\n\
         [output]\ny = \"beam.a.end.displacement.y/1e-3\"\n";
    for bl in [12.0_f64, 20.0, 40.0, 90.0] {
        let k = 4.0 * bl.powi(4);
        let (solution, outputs) = solved(text, &[("k", k)], 1e-10);
        assert!(solution.work.segments > 1, "{}", solution.work.segments);
        assert_eq!(solution.unstable_directions, Some(0));
        // F/(2 b³ EI) of the half-infinite beam.
        let endless = 0.5 / bl.powi(3);
        assert!((Cantilever::new(k, 1.0, 0.0).deflection(1.0) / endless - 1.0).abs() < 1e-8);
        assert!((value(&outputs, "y")[0] / endless - 1.0).abs() < 1e-6, "{bl}: {outputs:?}");
    }
}

/// L and the section in proportion to a size, I to its fourth power, and the meat's load q = -k x along them: a tip force moves the tip
/// by 1/size, a moment by 1/size², and the meat's part is the same for k in proportion to 1/size.
#[test]
fn a_larger_bone_is_displaced_less_by_the_same_pull() {
    let text = "format = 1
[parameter]
size = 1
force = 0
moment = 0
meat = 0
[material.bone]
young = \"2.7816 GPa\"
poisson = 0.3
[section.oval]
shape = \"ellipse\"
width = \"size*3.2 mm\"
height = \"size*4.8 mm\"
[beam.bone]
material = \"bone\"
section = \"oval\"
length = \"size*30 mm\"
extension = false
start = { body = \"ground\", hold = \"clamp\" }
distributed = { force = [0, \"-1e-3*meat*s/size\", 0] }
[load.tip]
beam = \"bone\"
at = 1
force = [0, \"1e-3*force\", 0]
moment = [0, 0, \"1e-5*moment\"]
[output]
y = \"beam.bone.end.displacement.y\"
";
    let y = |size: f64, loads: [f64; 3]| {
        let [force, moment, meat] = loads;
        let values = [("size", size), ("force", force), ("moment", moment), ("meat", meat)];
        value(&solved(text, &values, 1e-12).1, "y")[0]
    };
    let base = |size: f64| y(size, [0.0, 0.0, 40.0]);
    for (loads, power, reduction) in [([1.0, 0.0, 40.0], 1, 0.090_909), ([0.0, 1.0, 40.0], 2, 0.173_554)] {
        // What is cubic in the loads is about 1e-9 of it here.
        let part = |size: f64| y(size, loads) - base(size);
        let ratio = part(1.1) / part(1.0);
        assert!((ratio * 1.1_f64.powi(power) - 1.0).abs() < 1e-6, "{ratio}");
        assert!((1.0 - ratio - reduction).abs() < 1e-5);
    }
    assert!((base(1.1) / base(1.0) - 1.0).abs() < 1e-6);
}

/// A tendon and a foundation together: what the tendon does not pull, the foundation alone decides.
#[test]
fn a_tendon_may_run_along_a_beam_on_a_foundation() {
    let text = |tendon: &str| {
        format!(
            "format = 1\n[parameter]\npull = 0\n{SECTION}[beam.a]\nsection = \"rod\"\nlength = 1\nstart = {{ body = \"ground\", hold = \"clamp\" }}\n\
             foundation = {{ stiffness = 60, direction = [0, 0, 1] }}\n[load.tip]\nbeam = \"a\"\nat = 1\nforce = [0, 1, 2]\n{tendon}\
             [output]\nz = \"beam.a.end.position.z\"\n"
        )
    };
    let tendon =
        "[cable.t]\ntension = \"pull\"\nroute = [{ beam = \"a\", from = 0, to = 1, offset = [0, 0.05] }]\n";
    let plain = value(&solved(&text(""), &[], 1e-10).1, "z")[0];
    let (slack, pulled) =
        (solved(&text(tendon), &[], 1e-10).1, solved(&text(tendon), &[("pull", 20.0)], 1e-10).1);
    assert!((value(&slack, "z")[0] - plain).abs() < 1e-8);
    let z = value(&pulled, "z")[0];
    assert!((z - plain).abs() > 0.02, "{z} {plain}");
}
