//! Motions in time: the balance of power, velocities against differences in time, joints of several coordinates, and what is refused.
#![allow(clippy::unwrap_used, reason = "a test may fail where it stands")]

mod moving;

use flexura::Moved;
use flexura::solution::Status;
use flexura::spatial::{Vector3, log};
use flexura_testkit::{assert_close, assert_close_vec};
use moving::{moved, tried};

/// Weights of differences of order eight at 1 .. 4 steps.
const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// What stands at the middle of nine equally spaced times, differentiated.
fn slope(step: f64, at: impl Fn(usize) -> f64, middle: usize) -> f64 {
    WEIGHTS.iter().enumerate().map(|(k, w)| w * (at(middle + k + 1) - at(middle - k - 1))).sum::<f64>() / step
}

/// Power of drives and gravity is the rate of kinetic and strain energy; velocities and accelerations are the rates of poses and
/// velocities, of bodies as of joint coordinates. Relative to the largest power and motion.
fn check_balance(run: &Moved, tolerance: f64) {
    let instants = &run.motion.instants;
    let step = instants[1].time - instants[0].time;
    let power = instants.iter().map(|i| i.drive_power.abs().max(i.gravity_power.abs())).fold(1e-3, f64::max);
    let mut largest = 0.0_f64;
    for middle in 4..instants.len() - 4 {
        let here = &instants[middle];
        let rate = slope(step, |i| instants[i].kinetic_energy + instants[i].state.energy, middle);
        assert_close(here.drive_power + here.gravity_power, rate, tolerance * power, "power");
        for (b, body) in here.bodies().iter().enumerate() {
            let vector = |pick: &dyn Fn(usize) -> Vector3<f64>| {
                Vector3::from_fn(|k, _| slope(step, |i| pick(i)[k], middle))
            };
            let velocity = vector(&|i| instants[i].state.bodies[b].position);
            // The rotation vector from here differentiates to the angular velocity.
            let turned = here.state.bodies[b].rotation.inverse();
            let angular = vector(&|i| log(&(instants[i].state.bodies[b].rotation * turned)));
            let acceleration = vector(&|i| instants[i].bodies()[b].velocity.linear);
            let angular_acceleration = vector(&|i| instants[i].bodies()[b].velocity.angular);
            let fast = 1.0 + angular.norm() + velocity.norm();
            assert_close_vec(&body.velocity.linear, &velocity, tolerance * fast, "velocity");
            assert_close_vec(&body.velocity.angular, &angular, tolerance * fast, "angular velocity");
            assert_close_vec(
                &body.acceleration.linear,
                &acceleration,
                tolerance * fast * fast,
                "acceleration",
            );
            assert_close_vec(
                &body.acceleration.angular,
                &angular_acceleration,
                tolerance * fast * fast,
                "angular acceleration",
            );
            largest = largest.max(angular.norm());
        }
        for (j, joint) in here.joints().iter().enumerate() {
            for (k, velocity) in joint.velocities.iter().enumerate() {
                let at = |i: usize| instants[i].state.joints[j].coordinates[k];
                // A rotation vector turns over at half a turn.
                if (middle - 4..middle + 4).any(|i| (at(i + 1) - at(i)).abs() > 1.0) {
                    continue;
                }
                let rate = slope(step, at, middle);
                assert_close(*velocity, rate, tolerance * (1.0 + rate.abs()), "velocity of a coordinate");
                let change = slope(step, |i| instants[i].joints()[j].velocities[k], middle);
                assert_close(
                    joint.accelerations[k],
                    change,
                    tolerance * (1.0 + change.abs()),
                    "its acceleration",
                );
            }
        }
    }
    assert!(largest > 0.1, "nothing turns");
}

const BODY: &str = r#"
format = 1
gravity = ["1 m/s^2", "-3 m/s^2", "-9 m/s^2"]
[parameter]
p = "0"
[body.top]
at = ["0.1 m", "-0.2 m", "0.3 m"]
mass = "1.3 kg"
center_of_mass = ["30 mm", "-10 mm", "150 mm"]
inertia = [[0.02, 0.003, -0.004], [0.003, 0.03, 0.005], [-0.004, 0.005, 0.04]]
"#;

const LAW: &str = "\n[study.go]\nkind = \"inverse_dynamics\"\nparameter = \"p\"\nvalue = \"1.3*sin(3*t) + 0.4*t\"\nduration = \"1 s\"\nsamples = 201\n";

fn body_in(joint: &str) -> String {
    let frame = "parent = { body = \"ground\", at = [\"0.1 m\", \"-0.2 m\", \"0.3 m\"] }\nchild = \"top\"\n";
    format!("{BODY}\n[joint.j]\n{frame}{joint}\n{LAW}")
}

#[test]
fn a_universal_joint_balances_its_power() {
    let joint = "kind = \"universal\"\naxis = [0, 0, 1]\nsecond_axis = [1, 0, 0]\n\
                 first = { coordinate = \"2*p\" }\nsecond = { coordinate = \"0.7*p^2 - 0.3*p\" }";
    check_balance(&moved(&body_in(joint), &[], "go"), 2e-8);
}

/// A screw: the nut turns with the driven shaft, on which it slides, and a coupling leads it along; its forces do no work.
#[test]
fn a_screw_balances_its_power() {
    let joint = "kind = \"revolute\"\naxis = [0, 0, 1]\ncoordinate = \"3*p\"\n\
                 \n[body.nut]\nmass = \"0.7 kg\"\ncenter_of_mass = [\"20 mm\", 0, \"5 mm\"]\ninertia = [1e-4, 2e-4, 3e-4]\n\
                 \n[joint.spline]\nkind = \"prismatic\"\nparent = \"top\"\nchild = \"nut\"\naxis = [0, 0, 1]\n\
                 \n[joint.screw]\nkind = \"cylindrical\"\nparent = { body = \"ground\", at = [\"0.1 m\", \"-0.2 m\", \"0.3 m\"] }\n\
                 child = { body = \"nut\", at = [\"0.1 m\", \"-0.2 m\", \"0.3 m\"] }\naxis = [0, 0, 1]\n\
                 \n[coupling.thread]\nrelation = \"joint.screw.position = 0.02 m * joint.screw.angle\"\n";
    let run = moved(&body_in(joint), &[], "go");
    check_balance(&run, 2e-8);
    for instant in &run.motion.instants {
        assert_close(instant.joints()[2].velocities[1], 0.06 * instant.rate, 1e-12, "lead");
    }
}

/// A slider crank with a spring at its slider, in a plane that is askew.
#[test]
fn a_slider_crank_with_a_spring_balances_its_power() {
    let text = r#"
format = 1
gravity = ["2 m/s^2", "-9 m/s^2", "3 m/s^2"]
[parameter]
p = "0.3"
[body.crank]
rotation = { axis = [0, 0, 1], angle = "0.9 rad" }
mass = "0.4 kg"
center_of_mass = ["20 mm", 0, "5 mm"]
inertia = [1e-4, 2e-4, 3e-4]
[body.rod]
at = ["50 mm * cos(0.9)", "50 mm * sin(0.9)", 0]
rotation = { axis = [0, 0, 1], angle = "-asin(50/120*sin(0.9))" }
mass = "0.6 kg"
center_of_mass = ["60 mm", "10 mm", "-5 mm"]
inertia = [1e-4, 2e-4, 3e-4]
[body.slider]
at = ["50 mm * cos(0.9) + 120 mm * sqrt(1 - (50/120*sin(0.9))^2)", 0, 0]
mass = "0.9 kg"
[joint.crank]
kind = "revolute"
parent = "ground"
child = "crank"
axis = [0, 0, 1]
coordinate = "p"
[joint.pin]
kind = "spherical"
parent = { body = "crank", at = ["50 mm", 0, 0] }
child = "rod"
[joint.wrist]
kind = "universal"
parent = "slider"
child = { body = "rod", at = ["120 mm", 0, 0] }
axis = [0, 0, 1]
second_axis = [0, 1, 0]
[joint.way]
kind = "prismatic"
parent = "ground"
child = "slider"
axis = [1, 0, 0]
[spring.hold]
from = { body = "ground", at = ["0.3 m", "20 mm", 0] }
to = { body = "slider", at = [0, 0, 0] }
law = "linear"
stiffness = "80 N/m"
rest_length = "0.1 m"
[study.go]
kind = "inverse_dynamics"
parameter = "p"
value = "4*t + 0.5*sin(6*t)"
duration = "2 s"
samples = 401
"#;
    let run = moved(text, &[], "go");
    check_balance(&run, 2e-8);
    // Two revolutions of the crank: the slider's way is that of the closed form.
    for instant in &run.motion.instants {
        let angle = 0.9 + instant.value;
        let ratio: f64 = 50.0 / 120.0 * angle.sin();
        let x = 0.05 * angle.cos() + 0.12 * (1.0 - ratio * ratio).sqrt();
        assert_close(instant.state.bodies[2].position.x, x, 1e-13, "slider");
        let slope =
            -0.05 * angle.sin() - 0.12 * ratio * (50.0 / 120.0) * angle.cos() / (1.0 - ratio * ratio).sqrt();
        assert_close(instant.joints()[3].velocities[0], slope * instant.rate, 1e-11, "its velocity");
    }
}

/// A frame on the ground that depends on the parameter is led as a drive is: x = 0.1 p², and the body on it turns by p.
#[test]
fn a_base_that_moves_with_the_parameter_carries_its_body() {
    let joint = "kind = \"revolute\"\nparent = { body = \"ground\", at = [\"0.1 m + 0.1 m * p^2\", \"-0.2 m\", \"0.3 m\"] }\n\
                 child = { body = \"top\", at = [0, 0, 0] }\naxis = [0, 0, 1]\ncoordinate = \"p\"";
    let run = moved(&format!("{BODY}\n[joint.j]\n{joint}\n{LAW}"), &[], "go");
    for instant in &run.motion.instants {
        let [p, rate, second] = [instant.value, instant.rate, instant.acceleration];
        let body = &instant.bodies()[0];
        let velocity = Vector3::new(0.2 * p * rate, 0.0, 0.0);
        let acceleration = Vector3::new(0.2 * (p * second + rate * rate), 0.0, 0.0);
        assert_close_vec(&body.velocity.linear, &velocity, 1e-12, "velocity");
        assert_close_vec(&body.acceleration.linear, &acceleration, 1e-10, "acceleration");
        assert_close_vec(&body.velocity.angular, &(Vector3::z() * rate), 1e-12, "angular velocity");
        let gravity = Vector3::new(1.0, -3.0, -9.0);
        let force = (body.center_acceleration - gravity) * 1.3;
        assert_close_vec(&instant.state.joints[0].wrench.force, &force, 1e-10, "force");
    }
}

/// A motion over a small part of what the mechanism can do is as exact as one over all of it.
#[test]
fn a_short_way_costs_no_digits() {
    let law =
        "trapezoid = { from = \"10 deg\", to = \"10.001 deg\", duration = \"0.1 s\", ramp = \"0.03 s\" }";
    let text = moving::text("knee_leg").replace(
        "[study.flexion]",
        &format!("[study.short]\nkind = \"inverse_dynamics\"\nparameter = \"theta\"\n{law}\n[study.flexion]"),
    );
    let run = moved(&text, &[], "short");
    let f_r = run.numbers("f_r").unwrap();
    for (instant, f_r) in run.motion.instants.iter().zip(f_r) {
        let expected =
            flexura_testkit::leg::forces([instant.value, instant.rate, instant.acceleration], 0.0)[0];
        assert_close(f_r, expected, 1e-9, "f_r");
    }
}

/// What moves under the forces of inertia is named, with what it would move by and the joint that is free.
#[test]
fn a_mechanism_that_gives_way_is_refused() {
    let text = r#"
format = 1
[parameter]
p = "0 m"
[body.cart]
[body.load]
mass = "2 kg"
[joint.way]
kind = "prismatic"
parent = "ground"
child = "cart"
axis = [1, 0, 0]
coordinate = "p"
[joint.slip]
kind = "prismatic"
parent = "cart"
child = "load"
axis = [1, 0, 0]
stiffness = "1000 N/m"
[study.go]
kind = "inverse_dynamics"
parameter = "p"
value = "0.5*t^2"
duration = "1 s"
"#;
    let error = tried(text, &[], "go").unwrap_err();
    // m a / k = 2 mm.
    assert!(error.message.contains("`p` does not decide the whole motion"), "{}", error.message);
    assert!(error.message.contains("`load` would move by 2.00e-3 m"), "{}", error.message);
    assert!(error.hint.contains("the joint `slip` is free"), "{}", error.hint);
}

#[test]
fn a_parameter_that_moves_nothing_is_refused() {
    let text = "format = 1\n[parameter]\npush = \"1 N\"\n[body.b]\nmass = \"1 kg\"\n[joint.j]\nkind = \"revolute\"\nparent = \"ground\"\nchild = \"b\"\naxis = [0, 0, 1]\ncoordinate = \"0.2 rad\"\n[load.l]\nbody = \"b\"\nforce = [\"push\", 0, 0]\n[study.go]\nkind = \"inverse_dynamics\"\nparameter = \"push\"\nrate = \"2 N/s\"\nduration = \"1 s\"\n";
    let error = tried(text, &[], "go").unwrap_err();
    assert!(error.message.contains("`push` moves nothing"), "{}", error.message);
    assert!(error.hint.contains("coordinate = \"push\""), "{}", error.hint);
}

#[test]
fn a_mass_that_changes_with_the_motion_and_a_beam_are_refused() {
    let joint = "kind = \"revolute\"\naxis = [0, 0, 1]\ncoordinate = \"p\"";
    let text = body_in(joint).replace("mass = \"1.3 kg\"", "mass = \"1.3 kg * (1 + p^2)\"");
    let error = tried(&text, &[], "go").unwrap_err();
    assert_eq!(error.path, "body.top");
    assert!(error.message.contains("changes with the parameter `p`"), "{}", error.message);

    let beam = "\n[section.s]\nshape = \"stiffness\"\nEA = \"inf\"\nGJ = 1\nEI2 = 1\nEI3 = 1\n[beam.leaf]\nsection = \"s\"\nlength = \"0.1 m\"\nstart = { body = \"top\", hold = \"clamp\" }\n";
    let error = tried(&(body_in(joint) + beam), &[], "go").unwrap_err();
    assert_eq!(error.path, "beam.leaf");
    assert!(error.message.contains("would bend under the forces of its motion"), "{}", error.message);
}

/// A slider crank whose crank is longer than its rod locks; the motion up to there is kept.
#[test]
fn a_mechanism_that_locks_ends_the_motion_with_its_place() {
    let text = r#"
format = 1
[parameter]
p = "0"
[body.crank]
[body.rod]
at = ["60 mm", 0, 0]
[body.slider]
at = ["100 mm", 0, 0]
[joint.crank]
kind = "cylindrical"
parent = "ground"
child = "crank"
axis = [0, 0, 1]
angle = { coordinate = "p" }
[joint.pin]
kind = "spherical"
parent = { body = "crank", at = ["60 mm", 0, 0] }
child = "rod"
[joint.wrist]
kind = "revolute"
parent = "slider"
child = { body = "rod", at = ["40 mm", 0, 0] }
axis = [0, 0, 1]
[joint.way]
kind = "prismatic"
parent = "ground"
child = "slider"
axis = [1, 0, 0]
[study.go]
kind = "inverse_dynamics"
parameter = "p"
rate = "1 rad/s"
duration = "1 s"
samples = 51
"#;
    let run = tried(text, &[], "go").unwrap();
    assert_eq!(run.motion.status, Status::Stalled);
    // sin p = 40/60.
    let limit = (40.0f64 / 60.0).asin();
    let last = run.motion.instants.last().unwrap().value;
    assert!(last < limit && last > limit - 0.03, "{last} {limit}");
    let reason = run.motion.reason.as_deref().unwrap();
    assert!(reason.contains("p = 0.72") && reason.contains("locks"), "{reason}");
    assert!(run.document().is_ok());
}
