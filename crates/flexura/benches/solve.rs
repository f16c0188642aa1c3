//! Wall time and work of whole solves, printed as a table.
//!
//! `cargo bench -p flexura` prints medians, and their ratio to one integration step of order eight (values
//! only) measured in the same run, so that a slow moment of the machine shows in both. `cargo bench -p flexura --features
//! baseline -- --instructions` counts instructions per solve under valgrind's callgrind instead (the kernel
//! built for the baseline processor, which valgrind knows): the difference between two runs that do a different
//! number of solves and nothing else differently.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

use flexura::model::*;
use flexura::spatial::{Pose, Vector3, exp};
use flexura::{Prepared, model};
use flexura_mechanics::rod::{LawTable, Piece, RodKernel, RodState, Slender, advance};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};
use std::time::Instant;

/// Accuracy asked for: true relative errors stay below 1e-6 (`docs/performance.md`).
const TOLERANCE: f64 = 1e-6;

fn stiffness(ea: f64, gj: f64, ei: f64, ga: f64) -> Shape {
    let p = Profile::Constant;
    Shape::Stiffness {
        ea: p(ea),
        gj: p(gj),
        ei2: p(ei),
        ei3: p(ei),
        ga2: Some(p(ga)),
        ga3: Some(p(ga)),
        mass_per_length: None,
        rotary_inertia: None,
    }
}

fn cantilever(shape: Shape, curve: Curve, theory: BeamTheory, start: Pose, force: Vector3<f64>) -> Model {
    let mut model = Model::default();
    model.sections.push(Section { name: "section".into(), shape, plane_strain: false });
    model.beams.push(Beam {
        name: "beam".into(),
        material: None,
        section: SectionId(0),
        curve,
        frame: SectionFrame::Natural,
        theory,
        damping: 0.0,
        added_mass: 0.0,
        start: Some(End { mount: Mount::Ground, placement: Some(start), hold: JointLaw::weld() }),
        end: None,
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    model.loads.push(Load {
        name: "tip".into(),
        target: LoadTarget::Beam(BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) }),
        force,
        moment: Vector3::zeros(),
        frame: LoadFrame::Global,
    });
    model
}

const INEXTENSIBLE: BeamTheory = BeamTheory { shear: false, extension: false };

fn elastica() -> Model {
    let curve = Curve::Straight { length: 1.0 };
    cantilever(
        stiffness(1.0, 1.0, 1.0, 1.0),
        curve,
        INEXTENSIBLE,
        Pose::identity(),
        Vector3::new(0.0, 10.0, 0.0),
    )
}

/// The 45° bend: R = 100, 1 x 1, E = 1e7, ν = 0, P = 600 out of its plane.
fn bend() -> Model {
    let turned = exp(&Vector3::new(0.0, 0.0, FRAC_PI_2)) * exp(&Vector3::new(PI, 0.0, 0.0));
    cantilever(
        stiffness(1e7, 5e6 / 6.0, 1e7 / 12.0, 5e6),
        Curve::Arc { radius: 100.0, angle: FRAC_PI_4 },
        BeamTheory { shear: true, extension: true },
        Pose::new(turned, Vector3::zeros()),
        Vector3::new(0.0, 0.0, 600.0),
    )
}

/// The ten-turn spring with 5 N along its axis at the free wire end.
fn spring() -> Model {
    let (wire, radius, pitch) = (0.6985e-3_f64, 7.239e-3, 5.715e-3);
    let inertia = PI * wire.powi(4) / 4.0;
    let area = PI * wire * wire;
    let rise = pitch / TAU;
    let slant = (radius * radius + rise * rise).sqrt();
    cantilever(
        stiffness(193e9 * area, 80.8e9 * 2.0 * inertia, 193e9 * inertia, 80.8e9 * area),
        Curve::Helix { radius, pitch, turns: 10.0 },
        BeamTheory::default(),
        Pose::identity(),
        Vector3::new(rise / slant, 0.0, radius / slant) * 5.0,
    )
}

fn solve_cold(problem: &mut Prepared) {
    let outcome = problem.solve(TOLERANCE, &mut |_| {});
    assert_eq!(outcome.status, flexura::solution::Status::Converged, "{:?}", outcome.reason);
}

/// Solves alternately for the load and for 1.01 times the load, each from the last solution.
fn solve_warm(problem: &mut Prepared, force: Vector3<f64>, times: usize) {
    for i in 0..times {
        let factor = if i % 2 == 0 { 1.01 } else { 1.0 };
        problem.set_point_load(model::LoadId(0), force * factor, Vector3::zeros());
        problem.solve_from_here(TOLERANCE, &mut |_| {});
    }
}

/// A thousand loads: force to 10, moment to 1, from a fixed sequence.
fn random_loads() -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let mut state = 88_172_645_463_325_252_u64;
    let mut unit = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut vector = |largest: f64| {
        let v = Vector3::from_fn(|_, _| 2.0 * unit() - 1.0).normalize();
        v * (largest * unit())
    };
    (0..1000).map(|_| (vector(10.0), vector(1.0))).collect()
}

fn kernel<const W: usize>(times: usize)
where
    RodState<W>: RodKernel<W>,
{
    let law = Slender { k0: [0.0; 3], stretch: 0.0, bend: [1.3, 1.0, 1.0] };
    let piece = Piece {
        length: 1.0,
        steps: 4,
        laws: LawTable::Slender(vec![law]),
        loads: Vec::new(),
        foundation: None,
    };
    for i in 0..times {
        let mut state: RodState<W> = RodState::origin();
        state.force = [0.1, 1.0 + 1e-9 * i as f64, 0.2];
        state.moment = [0.1, 0.2, 1.0];
        for l in 1..W.min(4) {
            state.d[8 + l][l] = 1.0;
        }
        advance(&piece, 1.0, &mut state);
        std::hint::black_box(&state);
    }
}

/// A case: its name, and a way to do it `times` times; the unit of the count is one solve.
struct Case {
    name: &'static str,
    run: Box<dyn FnMut(usize)>,
    per_run: f64,
}

fn case(name: &'static str, run: impl FnMut(usize) + 'static) -> Case {
    Case { name, run: Box::new(run), per_run: 1.0 }
}

fn cold(name: &'static str, model: &Model) -> Case {
    let mut problem = Prepared::new(model).expect("the model is sound");
    case(name, move |times| (0..times).for_each(|_| solve_cold(&mut problem)))
}

fn warm(name: &'static str, model: &Model) -> Case {
    let mut problem = Prepared::new(model).expect("the model is sound");
    solve_cold(&mut problem);
    let force = model.loads[0].force;
    case(name, move |times| solve_warm(&mut problem, force, times))
}

fn chain(name: &'static str, segments: usize) -> Case {
    let mut problem = Prepared::new(&elastica()).expect("the model is sound");
    problem.problem().force_segments(Some(segments));
    case(name, move |times| {
        for _ in 0..times {
            problem.linearise().expect("a straight cantilever is regular");
        }
    })
}

fn cases() -> Vec<Case> {
    let steps = |name, run: fn(usize)| Case { name, run: Box::new(run), per_run: 4.0 };
    let mut random = Prepared::new(&{
        let mut model = elastica();
        model.sections[0].shape = stiffness(1.0, 1.0 / 1.3, 1.0, 1.0);
        model
    })
    .expect("the model is sound");
    let loads = random_loads();
    let thousand = case("1000 random end wrenches, all", move |times| {
        for _ in 0..times {
            for (force, moment) in &loads {
                random.set_point_load(model::LoadId(0), *force, *moment);
                random.solve(TOLERANCE, &mut |_| {});
            }
        }
    });
    vec![
        steps("integration step, values only", kernel::<1>),
        steps("integration step, 3 derivatives", kernel::<4>),
        steps("integration step, 6 derivatives", kernel::<8>),
        steps("integration step, 15 derivatives", kernel::<16>),
        cold("elastica (10), cold", &elastica()),
        warm("elastica (10), warm", &elastica()),
        cold("45° bend, cold", &bend()),
        warm("45° bend, warm", &bend()),
        cold("ten-turn spring, cold", &spring()),
        warm("ten-turn spring, warm", &spring()),
        thousand,
        chain("tangent of 10 segments", 10),
        chain("tangent of 100 segments", 100),
        chain("tangent of 1000 segments", 1000),
    ]
}

/// Median over batches of the time of one run, seconds.
fn time(case: &mut Case) -> f64 {
    (case.run)(1);
    let start = Instant::now();
    (case.run)(2);
    let once = start.elapsed().as_secs_f64() / 2.0;
    let batch = ((2e-3 / once).ceil() as usize).max(1);
    let mut times: Vec<f64> = (0..15)
        .map(|_| {
            let start = Instant::now();
            (case.run)(batch);
            start.elapsed().as_secs_f64() / batch as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2] / case.per_run
}

/// Instructions that callgrind counts for the case done `times` times, set-up included.
fn instructions(index: usize, times: usize) -> Option<u64> {
    let program = std::env::current_exe().ok()?;
    let output = std::process::Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["--case", &index.to_string(), "--times", &times.to_string()])
        .output()
        .ok()?;
    let text = String::from_utf8_lossy(&output.stderr);
    let line = text.lines().find(|line| line.contains("Collected"))?;
    line.rsplit(' ').next()?.parse().ok()
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| {
        let at = arguments.iter().position(|a| a == name)?;
        arguments.get(at + 1)?.parse::<usize>().ok()
    };
    let mut cases = cases();
    if let (Some(index), Some(times)) = (value("--case"), value("--times")) {
        (cases[index].run)(times);
        return;
    }
    if arguments.iter().any(|a| a == "--instructions") {
        println!("| case | instructions |\n|---|---|");
        for (index, case) in cases.iter().enumerate() {
            match (instructions(index, 2), instructions(index, 4)) {
                (Some(few), Some(more)) if more > few => {
                    println!("| {} | {:.0} |", case.name, (more - few) as f64 / 2.0 / case.per_run);
                }
                _ => println!("| {} | no valgrind |", case.name),
            }
        }
        return;
    }
    println!("| case | time | in steps |\n|---|---|---|");
    let unit = time(&mut cases[0]);
    for case in &mut cases {
        let seconds = time(case);
        println!("| {} | {:.2} µs | {:.1} |", case.name, seconds * 1e6, seconds / unit);
    }
}
