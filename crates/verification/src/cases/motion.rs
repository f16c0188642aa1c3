//! Motions in time: a leg at a knee, the same with an exoskeleton, a four-bar.

use crate::file::File;
use crate::measure::worst;
use crate::{Case, Row};
use flexura_model::{MotionLaw, Pace, Sampling, Until};
use flexura_solution::InverseDynamics;
use flexura_testkit::exoskeleton::Exoskeleton;
use flexura_testkit::four_bar::FourBar;
use flexura_testkit::leg;
use std::f64::consts::{FRAC_PI_2, TAU};

pub const CASES: [Case; 3] = [
    Case {
        id: "knee_leg",
        title: "Lower leg that swings at a knee which turns and shifts, -5° to 115° with 80°/s and ramps of 0.5 s \
                (`knee_leg.toml`): forces along and across the leg",
        citation: "(3.11) to (3.13) with Table 3.5 in closed form (`testkit/src/leg.rs`)",
        needed: "1e-6; reached to 1e-10",
        run: swing,
        closed_form: None,
    },
    Case {
        id: "knee_exoskeleton",
        title: "The same with an exoskeleton of two links (`knee_exoskeleton.toml`), through the position in which they line up: \
                the force along the leg changes its sign there, and its jump grows with their mass. The printed 39 N and -24 N \
                cannot be compared, since the place of the hinges and J are not given",
        citation: "planar loop differentiated by hand, balance of each link (`testkit/src/exoskeleton.rs`)",
        needed: "1e-8 away from the singular position",
        run: exoskeleton,
        closed_form: None,
    },
    Case {
        id: "four_bar_motion",
        title: "Rigid four-bar whose crank turns once a second (`rigid_four_bar.toml`): velocity and acceleration of the rocker",
        citation: "vector loop in closed form (R. L. Norton, *Design of Machinery*, chapters 6 and 7; `testkit/src/four_bar.rs`)",
        needed: "1e-9",
        run: four_bar,
        closed_form: None,
    },
];

fn law() -> MotionLaw {
    let [from, to, speed] = [-5.0f64, 115.0, 80.0].map(f64::to_radians);
    MotionLaw::Trapezoid { from, to, pace: Pace::Speed(speed), ramp: 0.5 }
}

fn of<'a>(
    file: &File,
    motion: &'a InverseDynamics,
    name: &str,
) -> Result<impl Fn(usize) -> f64 + 'a, String> {
    let position = file.output(name)?;
    Ok(move |t: usize| match motion.instants[t].outputs[position].as_deref() {
        Some([value]) => *value,
        _ => f64::NAN,
    })
}

fn swing() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/knee_leg.toml"))?;
    let motion = file.moved(&[], "theta", law(), Sampling::Step(5e-3))?;
    let (f_r, f_theta, tau) =
        (of(&file, &motion, "f_r")?, of(&file, &motion, "f_theta")?, of(&file, &motion, "tau_a")?);
    let inertia = leg::MASS * 0.37 * 0.37 / 12.0;
    let off = worst(motion.instants.iter().enumerate().map(|(t, instant)| {
        let expected = leg::forces([instant.value, instant.rate, instant.acceleration], inertia);
        worst(
            [f_r(t), f_theta(t), tau(t)]
                .into_iter()
                .zip(expected)
                .map(|(ours, reference)| (ours - reference).abs()),
        )
    }));
    let [from, to] = [30f64, 90.0].map(f64::to_radians);
    let rate = 80f64.to_radians();
    let steady = MotionLaw::Constant { from, rate, until: Until::Value(to) };
    let motion = file.moved(&[], "theta", steady, Sampling::Count(2))?;
    let (f_r, f_theta) = (of(&file, &motion, "f_r")?, of(&file, &motion, "f_theta")?);
    Ok(vec![
        Row::absolute("f_r at 30°, N", -19.5022033, f_r(0), 1e-6),
        Row::absolute("f_θ at 30°, N", -30.4948939, f_theta(0), 1e-6),
        Row::absolute("f_r at 90°, N", -37.7098983, f_r(1), 1e-6),
        Row::absolute("f_θ at 90°, N", 0.2326858, f_theta(1), 1e-6),
        Row::vanishing("f_r, f_θ and τ_a at all times, N and N·m", off, 1e-10),
    ])
}

fn exoskeleton() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/knee_exoskeleton.toml"))?;
    let mut rows = Vec::new();
    let mut jumps = Vec::new();
    for density in [0.5, 1.0] {
        let motion = file.moved(&[("density", density)], "theta", law(), Sampling::Count(101))?;
        let (f_r, f_theta) = (of(&file, &motion, "f_r")?, of(&file, &motion, "f_theta")?);
        let links = Exoskeleton::lined_up(0.40, 0.37, density, leg::MASS * 0.37 * 0.37 / 12.0);
        let all = || motion.instants.iter().enumerate();
        let off = worst(all().filter(|(_, instant)| instant.value.abs() > 0.02).map(|(t, instant)| {
            let [along, across, _] = links.forces([instant.value, instant.rate, instant.acceleration]);
            (f_r(t) - along).abs().max((f_theta(t) - across).abs())
        }));
        rows.push(Row::vanishing(format!("f_r and f_θ with {density} kg/m, N"), off, 1e-8));
        let after = all().find(|(_, instant)| instant.value > 0.0).map_or(1, |(t, _)| t);
        if !(f_r(after - 1) > 0.0 && f_r(after) < 0.0) {
            return Err(format!("no change of sign: {} and {}", f_r(after - 1), f_r(after)));
        }
        jumps.push(f_r(after - 1) - f_r(after));
    }
    rows.push(Row::absolute(
        "jump of f_r with 1 kg/m over that with 0.5 kg/m",
        2.0,
        jumps[1] / jumps[0],
        0.01,
    ));
    Ok(rows)
}

fn four_bar() -> Result<Vec<Row>, String> {
    let file = File::new(include_str!("../../../../models/rigid_four_bar.toml"))?;
    let turn = MotionLaw::Constant { from: 0.0, rate: TAU, until: Until::Duration(1.0) };
    let motion = file.moved(&[], "crank", turn, Sampling::Count(73))?;
    let bars = FourBar { crank: 0.04, coupler: 0.1f64.hypot(0.02), rocker: 0.06, ground: 0.1 };
    let (mut velocity, mut acceleration) = (0.0_f64, 0.0_f64);
    for instant in &motion.instants {
        // The file's crank turns clockwise from where it stands upright.
        let [_, [_, rate, second]] = bars.moved([FRAC_PI_2 - instant.value, -instant.rate, 0.0]);
        let ours = &instant.joints()[3];
        velocity = velocity.max((ours.velocities[0] - rate).abs() / TAU);
        acceleration = acceleration.max((ours.accelerations[0] - second).abs() / (TAU * TAU));
    }
    Ok(vec![
        Row::vanishing("velocity of the rocker by that of the crank", velocity, 1e-9),
        Row::vanishing("acceleration of the rocker by the crank's velocity squared", acceleration, 1e-9),
    ])
}
