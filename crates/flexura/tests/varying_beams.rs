//! Beams whose section, shape or load varies strongly, jumps or has a steep flank: the mesh follows them, whatever they are.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use flexura::model::Model;
use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::spatial::{Pose, Vector3};
use flexura::{Options, solve};
use flexura_testkit::collocation::{self, Mesh, Tip};
use flexura_testkit::rod::Rod;

fn read(text: &str) -> Model {
    match Document::parse(text, "test.toml").and_then(|document| document.model(&[])) {
        Ok(model) => model,
        Err(errors) => panic!("{errors}"),
    }
}

#[track_caller]
fn solved(text: &str) -> Solution {
    let solution = solve(&read(text), &Options::default(), &mut |_| {}).unwrap();
    assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
    assert!(solution.error_estimate <= 1e-8);
    solution
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} against {expected}");
}

/// A cantilever, EI = 1 N·m², 1 m long.
fn loaded(load: &str) -> Solution {
    solved(&format!(
        r#"
format = 1
[section.s]
shape = "stiffness"
EA = 1e6
GJ = 1
EI2 = 1
EI3 = 1
[beam.b]
section = "s"
length = 1
start = {{ body = "ground", hold = "clamp" }}
distributed = {load}
"#
    ))
}

/// Root force and tip displacement along y.
fn sag(solution: &Solution) -> [f64; 2] {
    let samples = &solution.beams[0].samples;
    let tip = samples.last().unwrap();
    [samples[0].wrench.force.y, tip.pose.position.y - tip.rest_pose.position.y]
}

/// Linear theory: a load of 0.1 N/m from a to the end of the cantilever, w = q (1/8 - a³/6 + a⁴/24)/EI.
fn partial_load(a: f64) -> f64 {
    -0.1 * (1.0 / 8.0 - a.powi(3) / 6.0 + a.powi(4) / 24.0)
}

#[test]
fn a_jump_in_a_distributed_load_is_found_wherever_it_is() {
    for a in [0.1, 0.5, 1.0 / 3.0, 0.0123, 0.987_654_321] {
        let [force, tip] = sag(&loaded(&format!("{{ force = [0, \"-0.1*(1 + sign(s - {a}))/2\", 0] }}")));
        assert_near(force, -0.1 * (1.0 - a), 1e-9);
        // The deflection is that of linear theory but for the square of the slope.
        assert_near(tip, partial_load(a), 3e-4 * partial_load(a).abs());
    }
}

#[test]
fn a_load_from_a_place_on_is_the_same_as_one_that_jumps_there() {
    for a in [0.1, 0.5, 1.0 / 3.0] {
        let jumping = sag(&loaded(&format!("{{ force = [0, \"-0.1*(1 + sign(s - {a}))/2\", 0] }}")));
        for keys in [
            format!("from = {a}"),
            format!("from = \"{a} m\", to = 1"),
            format!("from = {a}, to = \"1000 mm\""),
        ] {
            let partial = sag(&loaded(&format!("{{ force = [0, -0.1, 0], {keys} }}")));
            assert_near(partial[0], jumping[0], 1e-12);
            assert_near(partial[1], jumping[1], 1e-11);
        }
        // And the rest of it up to there.
        let rest = sag(&loaded(&format!(
            "[{{ force = [0, -0.1, 0], from = {a} }}, {{ force = [0, \"-0.1 + 0*s\", 0], to = {a} }}]"
        )));
        let whole = sag(&loaded("{ force = [0, -0.1, 0] }"));
        assert_near(rest[0], whole[0], 1e-10);
        assert_near(rest[1], whole[1], 1e-10);
    }
}

#[test]
fn a_steep_flank_and_a_spike_of_a_distributed_load_have_their_integral() {
    // ∫ of -0.05 (1 + tanh((s - a)/w)) is -0.1 (1 - a) to e^(-2a/w).
    for (a, w) in [(0.1, 1e-3), (0.1, 1e-5), (0.61803, 1e-4), (0.3, 1e-7)] {
        let [force, _] = sag(&loaded(&format!("{{ force = [0, \"-0.1*(1 + tanh((s - {a})/{w}))/2\", 0] }}")));
        assert_near(force, -0.1 * (1.0 - a), 1e-9);
    }
    // A bell of 0.1 N in all.
    for (a, w) in [(0.137, 1e-4), (0.5, 1e-3), (0.7654, 1e-6)] {
        let force = format!("{{ force = [0, \"-0.1/{w}/sqrt(pi)*exp(-((s - {a})/{w})^2)\", 0] }}");
        let [force, tip] = sag(&loaded(&force));
        assert_near(force, -0.1, 1e-9);
        // As a point load at a, F a² (3 - a)/6; the square of the slope aside.
        let linear: f64 = -0.1 * a * a * (3.0 - a) / 6.0;
        assert_near(tip, linear, 2e-3 * linear.abs());
    }
}

#[test]
fn a_kink_of_a_distributed_load_costs_no_accuracy() {
    // Triangles: ∫ max(0, 1 - |s - 0.4|/0.3) = 0.3.
    let [force, _] = sag(&loaded("{ force = [0, \"-0.1*max(0, 1 - abs(s - 0.4)/0.3)\", 0] }"));
    assert_near(force, -0.03, 1e-10);
    let [force, _] = sag(&loaded("{ force = [0, \"-0.1*sqrt(abs(s - 0.3))\", 0] }"));
    let exact = -0.1 * (2.0 / 3.0) * (0.3f64.powf(1.5) + 0.7f64.powf(1.5));
    assert_near(force, exact, 1e-9);
}

fn taper(tip: f64, extension: bool) -> Solution {
    solved(&format!(
        r#"
format = 1
[material.m]
young = "1 MPa"
poisson = 0.5
[section.s]
shape = "circle"
along = [{{ at = 0, diameter = "10 mm" }}, {{ at = 1, diameter = "{tip} mm" }}]
[beam.b]
material = "m"
section = "s"
length = "0.2 m"
extension = {extension}
start = {{ body = "ground", hold = "clamp" }}
distributed = {{ force = [0, 0, "-1e-4 N/m"] }}
"#
    ))
}

/// How far the tip sags: θ' = M/EI, M' = q x cos θ (1 + ε), w' = sin θ (1 + ε), ε = q x sin θ/EA, x from the tip to the clamp, by
/// Runge and Kutta's formula of order four in ln d, in which steps are equal; θ vanishes at the clamp.
fn taper_from_the_tip(tip: f64, extension: bool) -> f64 {
    let (young, q, length, root, tip) = (1e6, 1e-4, 0.2, 10e-3, tip * 1e-3);
    let slope = (root - tip) / length;
    let steps = 6000;
    let (from, to) = (f64::ln(tip), f64::ln(root));
    let h = (to - from) / f64::from(steps);
    let rate = |u: f64, [angle, moment, _]: [f64; 3]| {
        let d = u.exp();
        let (x, ds) = ((d - tip) / slope, d / slope);
        let (area, inertia) = (std::f64::consts::PI * d * d / 4.0, std::f64::consts::PI * d.powi(4) / 64.0);
        let strain = if extension { q * x * angle.sin() / (young * area) } else { 0.0 };
        let stretched = (1.0 + strain) * ds;
        [-moment / (young * inertia) * ds, q * x * angle.cos() * stretched, angle.sin() * stretched]
    };
    let shoot = |angle: f64| {
        let mut y = [angle, 0.0, 0.0];
        for i in 0..steps {
            let u = from + f64::from(i) * h;
            let moved = |k: [f64; 3], part: f64| std::array::from_fn(|j| y[j] + part * h * k[j]);
            let a = rate(u, y);
            let b = rate(u + 0.5 * h, moved(a, 0.5));
            let c = rate(u + 0.5 * h, moved(b, 0.5));
            let d = rate(u + h, moved(c, 1.0));
            y = std::array::from_fn(|j| y[j] + h / 6.0 * (a[j] + 2.0 * b[j] + 2.0 * c[j] + d[j]));
        }
        y
    };
    let (mut before, mut angle) = (0.0, 1e-2);
    for _ in 0..8 {
        let (first, second) = (shoot(before)[0], shoot(angle)[0]);
        if second.abs() < 1e-15 || first == second {
            break;
        }
        (before, angle) = (angle, angle - second * (angle - before) / (second - first));
    }
    shoot(angle)[2]
}

#[test]
fn a_strong_taper_takes_no_more_work_than_a_mild_one() {
    for (tip, known) in [(0.2, 377.7735e-6), (0.1, 475.2956e-6), (0.05, 578.4730e-6), (0.02, 719.7820e-6)] {
        for extension in [false, true] {
            let solution = taper(tip, extension);
            let sample = solution.beams[0].samples.last().unwrap();
            let sag = sample.rest_pose.position.z - sample.pose.position.z;
            assert_near(sag, taper_from_the_tip(tip, extension), 2e-12);
            // Computed elsewhere, of a beam that does not stretch.
            if !extension {
                assert_near(sag, known, 6e-11);
            }
            assert!(solution.work.integration_steps < 400, "{:?}", solution.work);
            assert!(solution.work.newton_steps < 100, "{:?}", solution.work);
            assert_eq!(solution.stable, Some(true));
        }
    }
}

#[test]
fn a_soft_cone_sags_by_its_own_weight_whatever_its_tip() {
    for (radius, sag) in [(0.3, -27.2773e-3), (0.1, -26.2821e-3)] {
        let diameter = 2.0 * radius;
        let solution = solved(&format!(
            r#"
format = 1
gravity = [0, 0, "-9.81 m/s^2"]
[material.m]
young = "1 MPa"
poisson = 0.5
density = "1000 kg/m^3"
[section.s]
shape = "circle"
along = [{{ at = 0, diameter = "20 mm" }}, {{ at = 1, diameter = "{diameter} mm" }}]
[beam.b]
material = "m"
section = "s"
length = "0.2 m"
start = {{ body = "ground", hold = "clamp" }}
"#
        ));
        let sample = solution.beams[0].samples.last().unwrap();
        assert_near(sample.pose.position.z - sample.rest_pose.position.z, sag, 1e-7);
        assert!(solution.work.integration_steps < 600, "{:?}", solution.work);
        assert_eq!(solution.stable, Some(true));
    }
}

/// A cantilever of the rest shape y = t^p under a small dead force along y, EI = 1.
fn power(p: f64, force: f64) -> Solution {
    solved(&format!(
        r#"
format = 1
[section.s]
shape = "stiffness"
EA = 1e6
GJ = 1
EI2 = 1
EI3 = 1
[beam.c]
section = "s"
curve = {{ kind = "parametric", x = "t", y = "t^{p}", range = [0, 1] }}
start = {{ body = "ground", hold = "clamp" }}
[load.f]
beam = "c"
at = 1
force = [0, {force}, 0]
"#
    ))
}

#[test]
fn a_rest_curve_of_any_power_takes_the_same_work() {
    let mut works = Vec::new();
    for p in [2.0, 2.01, 2.1, 2.25, 2.5, 2.9, 3.0, 3.3] {
        let force = 1e-4;
        let solution = power(p, force);
        let sample = solution.beams[0].samples.last().unwrap();
        let moved = sample.pose.position - sample.rest_pose.position;
        // Castigliano: M = F (1 - x), and the tip goes by ∫ M (1 - x)/EI ds along y, by the midpoint rule over x.
        let n = 200_000;
        let h = 1.0 / f64::from(n);
        let linear: f64 = (0..n)
            .map(|i| {
                let x = h * (f64::from(i) + 0.5);
                h * force * (1.0 - x) * (1.0 - x) * (1.0 + (p * x.powf(p - 1.0)).powi(2)).sqrt()
            })
            .sum();
        assert_near(moved.y, linear, 1e-3 * linear);
        works.push(solution.work.integration_steps);
    }
    assert!(works.iter().all(|steps| *steps < 300), "{works:?}");
}

#[test]
fn an_unloaded_shallow_sine_arch_stays_as_it_is() {
    let solution = solved(
        r#"
format = 1
[material.steel]
young = "200 GPa"
poisson = 0.3
[section.strip]
shape = "rectangle"
width = "1 mm"
height = "5 mm"
[beam.b]
material = "steel"
section = "strip"
curve = { kind = "parametric", x = "t*100 mm", y = "3 mm*sin(pi*t)", range = [0, 1] }
start = { body = "ground", hold = "clamp" }
end = { body = "ground", hold = "clamp" }
"#,
    );
    let moved = |s: &flexura::solution::BeamSample| (s.pose.position - s.rest_pose.position).norm();
    assert!(solution.beams[0].samples.iter().all(|s| moved(s) < 1e-9));
}

/// One half of a cosine beam, 3 mm by 60 µm, whose middle is pushed down and does not turn.
fn half_cosine(drop: f64) -> Solution {
    solved(&format!(
        r#"
format = 1
[parameter]
h = "60 um"
L = "3 mm"
[material.si]
young = "169 GPa"
poisson = 0.28
[section.strip]
shape = "rectangle"
width = "10 um"
height = "480 um"
[body.shuttle]
at = ["L/2", "h", 0]
[joint.guide]
kind = "prismatic"
parent = {{ body = "ground", at = ["L/2", "h", 0] }}
child = "shuttle"
axis = [0, -1, 0]
coordinate = "{drop} um"
[beam.left]
material = "si"
section = "strip"
start = {{ body = "ground", hold = "clamp" }}
end = {{ body = "shuttle", hold = "clamp" }}
[beam.left.curve]
kind = "curvature"
k3 = "h/2*(2*pi/L)^2*cos(2*pi*s/L)"
length = "L/2*(1+(pi*h/L)^2/4)"
"#
    ))
}

/// Its force by collocation of the whole equations of the rod, with neither shooting nor a mesh that adapts.
fn half_cosine_by_collocation(drop: f64) -> f64 {
    let (h, span, young) = (60e-6, 3e-3, 169e9);
    let (width, height) = (10e-6, 480e-6);
    let (area, inertia) = (width * height, height * f64::powi(width, 3) / 12.0);
    let pi = std::f64::consts::PI;
    let length = 0.5 * span * (1.0 + (pi * h / span).powi(2) / 4.0);
    let stiff = 1.0 / (young * inertia);
    let rod = Rod {
        length,
        compliance: [1.0 / (young * area), 0.0, 0.0, stiff, stiff, stiff],
        rest: Box::new(move |s| {
            Vector3::new(0.0, 0.0, 0.5 * h * (2.0 * pi / span).powi(2) * (2.0 * pi * s / span).cos())
        }),
        load: Box::new(|_| Vector3::zeros()),
        reaction: None,
    };
    let rest = flexura_testkit::ivp::rest_poses(&rod, 4000).last().unwrap().1;
    let down = Vector3::new(0.0, -drop, 0.0);
    let tip = |part: f64| Tip::Pose(Pose::new(rest.rotation, rest.position + down * part));
    let mesh = Mesh { elements: 2, degree: 16 };
    let bent = collocation::solve(&rod, &Pose::identity(), &tip, 24, mesh).unwrap();
    // By the part beyond on the part before: what pushes the middle down pushes the end with it.
    -bent.tip().force.y
}

#[test]
fn a_cosine_beam_pushed_through_has_the_forces_of_the_whole_rod_equations() {
    for drop in [0.755, 5.0, 15.0] {
        let solution = half_cosine(drop);
        let effort = solution.joints[0].efforts[0];
        let exact = half_cosine_by_collocation(drop * 1e-6);
        assert_near(effort, exact, 2e-6 * exact.abs().max(1e-3));
    }
}

#[test]
fn a_section_and_a_foundation_with_kinks_are_followed() {
    // 1/EI = 1 + 4 max(0, s - 0.3): tip under a moment M turns by ∫M/EI.
    let solution = solved(
        r#"
format = 1
[section.s]
shape = "stiffness"
EA = 1e6
GJ = 1
EI2 = 1
EI3 = "1/(1 + 4*max(0, s - 0.3))"
[beam.b]
section = "s"
length = 1
start = { body = "ground", hold = "clamp" }
[load.m]
beam = "b"
at = 1
moment = [0, 0, 0.1]
"#,
    );
    let tip = solution.beams[0].samples.last().unwrap();
    let angle = tip.pose.rotation.angle();
    assert_near(angle, 0.1 * (1.0 + 2.0 * 0.49), 1e-10);
}
