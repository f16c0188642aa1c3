//! Motions in time: velocities, accelerations and forces against closed forms.
#![allow(clippy::unwrap_used, reason = "a test may fail where it stands")]

mod moving;

use flexura::solution::Status;
use flexura::spatial::{Matrix3, Vector3, exp};
use flexura_testkit::exoskeleton::Exoskeleton;
use flexura_testkit::four_bar::FourBar;
use flexura_testkit::{assert_close, assert_close_all, assert_close_vec, leg};
use moving::{bundled, moved};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// (3.11) to (3.13) at every time of the swing, both sides of the jumps of acceleration among them.
#[test]
fn the_leg_takes_the_forces_of_its_equations() {
    let run = bundled("knee_leg", &[], "flexion");
    let inertia = leg::MASS * 0.37 * 0.37 / 12.0;
    let outputs = ["f_r", "f_theta", "tau_a"].map(|name| run.numbers(name).unwrap());
    assert_eq!(run.motion.instants.len(), 403);
    for (t, instant) in run.motion.instants.iter().enumerate() {
        let at = [instant.value, instant.rate, instant.acceleration];
        let expected = leg::forces(at, inertia);
        for (values, expected) in outputs.iter().zip(expected) {
            assert_close(values[t], expected, 1e-10, "force");
        }
    }
    assert!(run.motion.error_estimate < 1e-10, "{}", run.motion.error_estimate);
}

/// f_r and f_θ at 30° and 90° of the swing, N.
#[test]
fn the_leg_takes_known_forces_at_30_and_90_degrees() {
    let study = "[study.at]\nkind = \"inverse_dynamics\"\nparameter = \"theta\"\nrate = \"80 deg/s\"\nfrom = \"30 deg\"\nto = \"90 deg\"\nsamples = 2\n";
    let text = format!("{}\n{study}", moving::text("knee_leg"));
    let run = moved(&text, &[], "at");
    let [f_r, f_theta] = ["f_r", "f_theta"].map(|name| run.numbers(name).unwrap());
    assert_close_all(&f_r, &[-19.5022033, -37.7098983], 5e-8, "f_r");
    assert_close_all(&f_theta, &[-30.4948939, 0.2326858], 5e-8, "f_theta");
}

/// The knots of the trapezoid: -5°, 15°, 95°, 115° at 0, 0.5, 1.5 and 2 s, with the acceleration before and after each jump.
#[test]
fn a_trapezoid_passes_its_knots_and_shows_both_sides_of_its_jumps() {
    let run = bundled("knee_leg", &[], "flexion");
    let at = |time: f64| -> Vec<[f64; 3]> {
        let instants = run.motion.instants.iter().filter(|instant| (instant.time - time).abs() < 1e-12);
        instants.map(|i| [i.value.to_degrees(), i.rate.to_degrees(), i.acceleration.to_degrees()]).collect()
    };
    for (time, expected) in [
        (0.0, vec![[-5.0, 0.0, 160.0]]),
        (0.5, vec![[15.0, 80.0, 160.0], [15.0, 80.0, 0.0]]),
        (1.0, vec![[55.0, 80.0, 0.0]]),
        (1.5, vec![[95.0, 80.0, 0.0], [95.0, 80.0, -160.0]]),
        (2.0, vec![[115.0, 0.0, -160.0]]),
    ] {
        let found = at(time);
        assert_eq!(found.len(), expected.len(), "{time}: {found:?}");
        for (found, expected) in found.iter().zip(&expected) {
            assert_close_all(found, expected, 1e-11, "knot");
        }
    }
}

fn exoskeleton(density: f64) -> (flexura::Moved, Exoskeleton) {
    let run = bundled("knee_exoskeleton", &[("density", &format!("{density} kg/m"))], "flexion");
    let links = Exoskeleton::lined_up(0.40, 0.37, density, leg::MASS * 0.37 * 0.37 / 12.0);
    (run, links)
}

/// The loop through the position in which its links line up, against its equations solved in the plane.
#[test]
fn the_exoskeleton_passes_the_singular_position_with_the_forces_of_its_loop() {
    let (run, links) = exoskeleton(0.5);
    assert_eq!(run.motion.status, Status::Converged);
    let outputs = ["f_r", "f_theta", "tau_a"].map(|name| run.numbers(name).unwrap());
    for (t, instant) in run.motion.instants.iter().enumerate() {
        let expected = links.forces([instant.value, instant.rate, instant.acceleration]);
        // Near the singular position round-off of the loop is as much larger as the forces are.
        let near = instant.value.abs().min(1.0);
        for (values, expected) in outputs.iter().zip(expected) {
            assert_close(values[t], expected, 1e-10 / (near * near), "force");
        }
    }
}

/// Near θ = 0 the force along the leg changes its sign, and the jump grows with the mass of the links.
#[test]
fn the_force_along_the_leg_changes_its_sign_where_the_links_line_up() {
    let jump = |density: f64| {
        let (run, _) = exoskeleton(density);
        let f_r = run.numbers("f_r").unwrap();
        let after = run.motion.instants.iter().position(|instant| instant.value > 0.0).unwrap();
        [f_r[after - 1], f_r[after]]
    };
    let [none, light, heavy] = [0.0, 0.5, 1.0].map(jump);
    assert!(light[0] > 39.0 && light[1] < -24.0, "{light:?}");
    assert!(heavy[0] > light[0] && heavy[1] < light[1], "{heavy:?}");
    let ratio = (heavy[0] - heavy[1]) / (light[0] - light[1]);
    assert!((ratio - 2.0).abs() < 0.01, "{ratio}");
    // Without mass there is nothing to see: the leg itself has no jump.
    assert!((none[0] - none[1]).abs() < 1.0, "{none:?}");
}

/// A body with a product of inertia on a shaft, sped up: with I_O about the shaft's bearing,
/// F = m a - m g and M_O = I_O α + ω × I_O ω - c × m g.
#[test]
fn a_skew_rotor_loads_its_bearing_as_eulers_equations_say() {
    let text = r#"
format = 1
gravity = ["1.5 m/s^2", "-2 m/s^2", "-9 m/s^2"]
[parameter]
turned = "0 deg"
[body.rotor]
at = ["0.1 m", "0.2 m", "0.3 m"]
mass = "2.5 kg"
center_of_mass = ["30 mm", "-10 mm", "50 mm"]
inertia = [[0.02, 0.003, -0.004], [0.003, 0.03, 0.005], [-0.004, 0.005, 0.04]]
[joint.shaft]
kind = "revolute"
parent = { body = "ground", at = ["0.1 m", "0.2 m", "0.3 m"] }
child = "rotor"
axis = [0, 0, 1]
coordinate = "turned"
[study.spin]
kind = "inverse_dynamics"
parameter = "turned"
value = "0.3 + 5*t + 3*t^2"
duration = "1.5 s"
samples = 31
"#;
    let run = moved(text, &[], "spin");
    let (mass, center) = (2.5, Vector3::new(0.03, -0.01, 0.05));
    let about_center = Matrix3::new(0.02, 0.003, -0.004, 0.003, 0.03, 0.005, -0.004, 0.005, 0.04);
    // Steiner.
    let about_bearing =
        about_center + (Matrix3::identity() * center.norm_squared() - center * center.transpose()) * mass;
    let gravity = Vector3::new(1.5, -2.0, -9.0);
    for instant in &run.motion.instants {
        let t = instant.time;
        let (angle, rate, acceleration) = (0.3 + 5.0 * t + 3.0 * t * t, 5.0 + 6.0 * t, 6.0);
        let turn = *exp(&(Vector3::z() * angle)).to_rotation_matrix().matrix();
        let arm = turn * center;
        let inertia = turn * about_bearing * turn.transpose();
        let (omega, alpha) = (Vector3::z() * rate, Vector3::z() * acceleration);
        let shift = alpha.cross(&arm) + omega.cross(&omega.cross(&arm));
        let force = (shift - gravity) * mass;
        let moment = inertia * alpha + omega.cross(&(inertia * omega)) - arm.cross(&gravity) * mass;
        let shaft = &instant.state.joints[0];
        assert_close_vec(&shaft.wrench.force, &force, 1e-9, "force");
        assert_close_vec(&shaft.wrench.moment, &moment, 1e-9, "moment");
        assert_close(shaft.efforts[0], moment.z, 1e-9, "effort");
        let body = &instant.bodies()[0];
        assert_close_vec(&body.velocity.angular, &omega, 1e-11, "angular velocity");
        assert_close_vec(&body.acceleration.angular, &alpha, 1e-9, "angular acceleration");
        assert_close_vec(&body.center_acceleration, &shift, 1e-9, "acceleration of the centre");
    }
}

/// Crank, coupler and rocker with masses: [`FourBar`].
const FOUR_BAR: &str = r#"
format = 1
gravity = [0, "-9.81 m/s^2", 0]
[parameter]
crank = "90 deg"
hold = "0 N*m/rad"
[body.crank]
mass = "0.2 kg"
center_of_mass = [0, "20 mm", 0]
inertia = [0, 0, 3e-5]
[body.coupler]
at = [0, "40 mm", 0]
mass = "0.3 kg"
center_of_mass = ["50 mm", "15 mm", 0]
inertia = [0, 0, 2e-4]
[body.rocker]
at = ["100 mm", 0, 0]
mass = "0.25 kg"
center_of_mass = [0, "30 mm", 0]
inertia = [0, 0, 8e-5]
[joint.a]
kind = "revolute"
parent = "ground"
child = "crank"
axis = [0, 0, 1]
coordinate = "crank - 90 deg"
[joint.b]
kind = "revolute"
parent = { body = "crank", at = [0, "40 mm", 0] }
child = "coupler"
axis = [0, 0, 1]
[joint.c]
kind = "revolute"
parent = { body = "coupler", at = ["100 mm", "20 mm", 0] }
child = { body = "rocker", at = [0, "60 mm", 0] }
axis = [0, 0, 1]
[joint.d]
kind = "revolute"
parent = { body = "ground", at = ["100 mm", 0, 0] }
child = "rocker"
axis = [0, 0, 1]
stiffness = "hold"
[output]
torque = "joint.a.effort"
power = "joint.a.effort * joint.a.velocity"
speed = "body.coupler.velocity"
hub = "body.rocker.angular_acceleration.z - joint.d.acceleration"
[study.turn]
kind = "inverse_dynamics"
parameter = "crank"
rate = "2*pi*1 rad/s"
from = "90 deg"
to = "450 deg"
samples = 73
[study.swing]
kind = "inverse_dynamics"
parameter = "crank"
value = "pi/2 + 1.2*sin(5*t) + 0.3*t^2"
duration = "2 s"
samples = 201
"#;

fn bars() -> FourBar {
    FourBar { crank: 0.04, coupler: 0.1f64.hypot(0.02), rocker: 0.06, ground: 0.1 }
}

#[test]
fn a_four_bar_moves_as_its_vector_loop() {
    for study in ["turn", "swing"] {
        let run = moved(FOUR_BAR, &[], study);
        for instant in &run.motion.instants {
            let [coupler, rocker] = bars().moved([instant.value, instant.rate, instant.acceleration]);
            let scale = 1.0 + instant.rate * instant.rate;
            for (body, [_, rate, acceleration]) in [(1, coupler), (2, rocker)] {
                let motion = &instant.bodies()[body];
                assert_close(motion.velocity.angular.z, rate, 1e-11 * scale, "rate");
                assert_close(motion.acceleration.angular.z, acceleration, 2e-10 * scale, "acceleration");
            }
            let d = &instant.joints()[3];
            assert_close(d.velocities[0], rocker[1], 1e-11 * scale, "velocity of the joint");
            assert_close(d.accelerations[0], rocker[2], 2e-10 * scale, "acceleration of the joint");
            let angle = instant.state.joints[3].coordinates[0] + FRAC_PI_2 - rocker[0];
            assert_close((angle / TAU - (angle / TAU).round()).abs(), 0.0, 1e-12, "angle of the rocker");
        }
    }
}

/// The driving torque from the rate of energy: crank, coupler and rocker as the closed form moves them. Only one torque does
/// work, so that it is known.
#[test]
fn a_four_bars_torque_is_that_of_the_power_balance() {
    let run = moved(FOUR_BAR, &[("hold", "0.8 N*m/rad")], "turn");
    let torque = run.numbers("torque").unwrap();
    let bars = bars();
    // Kinetic, potential and strain energy at an angle of the crank that turns at `TAU`.
    let energy = |angle: f64| {
        let [coupler, rocker] = bars.moved([angle, TAU, 0.0]);
        let tip = [0.04 * angle.cos(), 0.04 * angle.sin()];
        let tilt = coupler[0] - 0.02f64.atan2(0.1);
        let arm = [0.05 * tilt.cos() - 0.015 * tilt.sin(), 0.05 * tilt.sin() + 0.015 * tilt.cos()];
        let speed = [-tip[1] * TAU - arm[1] * coupler[1], tip[0] * TAU + arm[0] * coupler[1]];
        let kinetic = 0.5 * (0.2 * 0.02 * 0.02 + 3e-5) * TAU * TAU
            + 0.5 * (0.3 * (speed[0] * speed[0] + speed[1] * speed[1]) + 2e-4 * coupler[1] * coupler[1])
            + 0.5 * (0.25 * 0.03 * 0.03 + 8e-5) * rocker[1] * rocker[1];
        let height = 0.2 * 0.5 * tip[1] + 0.3 * (tip[1] + arm[1]) + 0.25 * 0.03 * rocker[0].sin();
        let turned = rocker[0] - FRAC_PI_2;
        kinetic + 9.81 * height + 0.5 * 0.8 * turned * turned
    };
    let h = 2e-3;
    for (instant, torque) in run.motion.instants.iter().zip(torque) {
        let at = |k: f64| energy(instant.value + k * h);
        let slope =
            (45.0 * (at(1.0) - at(-1.0)) - 9.0 * (at(2.0) - at(-2.0)) + (at(3.0) - at(-3.0))) / (60.0 * h);
        assert_close(torque, slope, 1e-9, "torque");
    }
}

const PENDULUM: &str = r#"
format = 1
gravity = [0, "-9.81 m/s^2", 0]
[parameter]
angle = "0 deg"
[body.bob]
at = [0, "-0.4 m", 0]
mass = "1.5 kg"
[joint.pivot]
kind = "revolute"
parent = "ground"
child = { body = "bob", at = [0, "0.4 m", 0] }
axis = [0, 0, 1]
coordinate = "angle"
[output]
torque = "joint.pivot.effort"
pull = "joint.pivot.force"
"#;

fn pendulum(study: &str) -> flexura::Moved {
    let text =
        format!("{PENDULUM}\n[study.swing]\nkind = \"inverse_dynamics\"\nparameter = \"angle\"\n{study}\n");
    moved(&text, &[], "swing")
}

/// m l² φ̈ + m g l sin φ.
fn check_pendulum(run: &flexura::Moved, expected: impl Fn(f64) -> [f64; 3]) {
    let torque = run.numbers("torque").unwrap();
    for (instant, torque) in run.motion.instants.iter().zip(torque) {
        let [angle, rate, acceleration] = expected(instant.time);
        assert_close(instant.value, angle, 1e-13, "angle");
        assert_close(instant.rate, rate, 1e-12, "rate");
        assert_close(instant.acceleration, acceleration, 1e-11, "acceleration");
        let wanted = 1.5 * 0.16 * acceleration + 1.5 * 9.81 * 0.4 * angle.sin();
        assert_close(torque, wanted, 1e-10, "torque");
        // Along the rod: m l φ̇² + m g cos φ towards the pivot.
        let pull = instant.state.joints[0].wrench.force;
        let along = -pull.x * angle.sin() + pull.y * angle.cos();
        assert_close(along, 1.5 * 0.4 * rate * rate + 1.5 * 9.81 * angle.cos(), 1e-10, "pull");
    }
}

#[test]
fn a_pendulum_follows_an_expression_of_time() {
    let run = pendulum("value = \"50 deg * sin(2*pi*t) + 0.1 rad * t^3\"\nduration = \"1.2 s\"");
    let a = 50f64.to_radians();
    check_pendulum(&run, |t| {
        let (sin, cos) = (TAU * t).sin_cos();
        [a * sin + 0.1 * t * t * t, a * TAU * cos + 0.3 * t * t, -a * TAU * TAU * sin + 0.6 * t]
    });
}

/// There and back: by symmetry the spline is at rest in the middle, so that each half is 3 t² - 2 t³.
#[test]
fn a_pendulum_follows_a_spline_through_knots() {
    let run = pendulum("knots = [[1, 0], [\"2 s\", \"60 deg\"], [3, 0]]\nstep = \"0.13 s\"");
    let v = PI / 3.0;
    assert_eq!(run.motion.instants.len(), 17);
    check_pendulum(&run, |time| {
        let back = time > 2.0;
        let t = if back { 3.0 - time } else { time - 1.0 };
        let sign = if back { -1.0 } else { 1.0 };
        [v * t * t * (3.0 - 2.0 * t), sign * 6.0 * v * t * (1.0 - t), 6.0 * v * (1.0 - 2.0 * t)]
    });
}

/// A trapezoid by its duration, downwards, that only just gets to its speed.
#[test]
fn a_trapezoid_may_be_given_by_its_duration_and_be_a_triangle() {
    let run = pendulum(
        "trapezoid = { from = \"40 deg\", to = \"-20 deg\", duration = \"2 s\", ramp = \"1 s\" }\nsamples = 21",
    );
    let (from, to) = (40f64.to_radians(), (-20f64).to_radians());
    assert_eq!(run.motion.instants.len(), 22);
    let instants = &run.motion.instants;
    assert_close(instants[10].acceleration, to - from, 1e-12, "before");
    assert_close(instants[11].acceleration, from - to, 1e-12, "after");
    assert_close(instants[10].rate, to - from, 1e-12, "speed");
    assert_close(instants[21].value, to, 1e-13, "end");
    assert_close(instants[21].rate, 0.0, 1e-12, "at rest");
}

/// Velocities without any mass: the forces of inertia are zero, and so are all others.
#[test]
fn a_mechanism_without_masses_has_velocities_and_no_forces() {
    let mut text = FOUR_BAR.replace("[0, \"-9.81 m/s^2\", 0]", "[0, 0, 0]");
    for line in FOUR_BAR.lines().filter(|l| l.starts_with("mass") || l.starts_with("inertia")) {
        text = text.replacen(&format!("{line}\n"), "", 1);
    }
    let run = moved(&text, &[], "turn");
    for instant in &run.motion.instants {
        let [_, rocker] = bars().moved([instant.value, instant.rate, 0.0]);
        assert_close(instant.joints()[3].velocities[0], rocker[1], 1e-10, "velocity");
        assert_close(instant.state.joints[0].efforts[0], 0.0, 1e-14, "effort");
        assert_close(instant.kinetic_energy, 0.0, 0.0, "energy");
    }
}

/// Velocities and accelerations in formulas, and in the table and the document.
#[test]
fn outputs_may_ask_for_velocities() {
    let run = moved(FOUR_BAR, &[], "swing");
    let (power, hub) = (run.numbers("power").unwrap(), run.numbers("hub").unwrap());
    let speed = run.output("speed").unwrap();
    for (t, instant) in run.motion.instants.iter().enumerate() {
        assert_close(power[t], instant.drive_power, 1e-12, "power");
        assert_close(hub[t], 0.0, 1e-8, "the rocker turns as its joint does");
        let tip = 0.04 * instant.rate;
        let expected = Vector3::new(-tip * instant.value.sin(), tip * instant.value.cos(), 0.0);
        assert_close_vec(&Vector3::from_column_slice(&speed[t]), &expected, 1e-12, "the crank's tip");
    }
    let table = flexura::output::motion_csv(&run.view()).unwrap();
    assert_eq!(table.lines().count(), 202);
    assert!(table.lines().next().unwrap().contains("speed.x [m/s]"), "{table}");
    let document = flexura::output::to_json(&run.document().unwrap()).unwrap();
    for words in [
        "\"study\": \"inverse_dynamics\"",
        "\"times\": [0.0, 0.01,",
        "\"angular_velocity\"",
        "\"drive_power\"",
    ] {
        assert!(document.contains(words), "{words}");
    }
    let picture = flexura::output::motion_svg(&run.view());
    assert!(picture.contains("rate of crank") && !picture.contains("NaN"), "{picture}");
}

/// In an equilibrium nothing has a velocity: the output is left out, and it is said why.
#[test]
fn a_velocity_has_no_value_where_nothing_moves() {
    let file = flexura::modelfile::Document::parse(FOUR_BAR, "model.toml").unwrap();
    let model = file.model(&[]).unwrap();
    let solution = flexura::solve(&model, &flexura::Options::default(), &mut |_| {}).unwrap();
    let evaluation = flexura::post::evaluate_each(&model, &solution);
    let without = &evaluation.without_value;
    assert!(evaluation.outputs.iter().all(|output| output.name == "torque"));
    assert_eq!(without.len(), 3);
    assert!(
        without[0].to_string().contains("only a study of the kind `inverse_dynamics` knows"),
        "{}",
        without[0]
    );
}
