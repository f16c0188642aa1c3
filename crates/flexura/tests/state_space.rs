//! Linear models about an equilibrium, against closed forms of the cantilever EI = ρA = L = 1 without shear and rotary inertia
//! (R. D. Blevins, *Formulas for Natural Frequency and Mode Shape*, 1979, table 8-1; R. E. D. Bishop and D. C. Johnson, *The Mechanics of
//! Vibration*, 1960, table 7.1 for the receptance of its tip).

use flexura::model::ModesStudy;
use flexura::modelfile::Document;
use flexura::solution::StateSpace;
use flexura::{Options, ProblemError, StateSpaceRequest, state_space};
use nalgebra::Complex;

/// β L of the first modes.
const BETAS: [f64; 4] =
    [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613, 10.995_540_734_875_467];

fn cantilever(more: &str) -> String {
    format!(
        "format = 1\nname = \"cantilever\"\n[section.strip]\nshape = \"stiffness\"\nGJ = 0.8\nEI2 = 40\nEI3 = 1\nmass_per_length = 1\n\
         rotary_inertia = [1e-3, 0, 0]\n[beam.strip]\nsection = \"strip\"\nlength = 1\nextension = false\n\
         start = {{ body = \"ground\", hold = \"clamp\" }}\n{more}\n[load.tip]\nbeam = \"strip\"\nat = 1\nforce = [0, \"1e-9 N\", 0]\n\
         [output]\ntip = \"beam.strip.end.displacement.y\"\nplace = \"beam.strip.end.position\"\nforce = \"beam.strip.start.force\"\n"
    )
}

fn ask(text: &str, request: &StateSpaceRequest, count: usize) -> Result<StateSpace, ProblemError> {
    ask_about(text, request, ModesStudy { count, at_rest: true, path: None })
}

fn ask_about(text: &str, request: &StateSpaceRequest, study: ModesStudy) -> Result<StateSpace, ProblemError> {
    let model =
        Document::parse(text, "cantilever.toml").expect("a good file").model(&[]).expect("a good model");
    state_space(&model, &study, request, &Options::default(), &mut |_| {})
}

fn request(inputs: &[&str], outputs: &[&str]) -> StateSpaceRequest {
    StateSpaceRequest {
        inputs: inputs.iter().map(|name| name.to_string()).collect(),
        outputs: outputs.iter().map(|name| name.to_string()).collect(),
        ..StateSpaceRequest::default()
    }
}

/// c (ω² + A₂)⁻¹ b + d without damping.
fn response(space: &StateSpace, square: f64) -> f64 {
    let n = space.squares.len();
    let modal: f64 = (0..n).map(|i| space.c[0][i] * space.b[n + i][0] / (space.squares[i] - square)).sum();
    modal + space.d[0][0]
}

fn close(found: f64, wanted: f64, relative: f64) {
    assert!((found - wanted).abs() <= relative * wanted.abs(), "{found} instead of {wanted}");
}

#[test]
fn residues_of_a_cantilever_are_those_of_its_normalised_shapes() {
    let space = ask(&cantilever(""), &request(&["load.tip.force.y"], &["tip"]), 8).expect("a sound model");
    let n = space.squares.len();
    for beta in BETAS {
        let i = (0..n)
            .min_by(|i, j| {
                let off = |i: usize| (space.squares[i] - beta.powi(4)).abs();
                off(*i).total_cmp(&off(*j))
            })
            .expect("a mode");
        close(space.squares[i], beta.powi(4), 1e-8);
        // The tip moves by twice the root mean square of the shape, whichever mode.
        close(space.c[0][i] * space.b[n + i][0], 4.0, 1e-7);
    }
    // At standstill what is left out is in the feedthrough.
    close(response(&space, 0.0), 1.0 / 3.0, 1e-9);
}

#[test]
fn the_reduced_response_with_residual_vectors_is_the_receptance_of_the_tip() {
    let mut wanted = request(&["load.tip.force.y"], &["tip"]);
    wanted.residual_vectors = Some(0);
    let plain = ask(&cantilever(""), &wanted, 6).expect("a sound model");
    wanted.residual_vectors = Some(3);
    let space = ask(&cantilever(""), &wanted, 6).expect("a sound model");
    let exact = |square: f64| {
        let beta = square.powf(0.25);
        (beta.sin() * beta.cosh() - beta.cos() * beta.sinh())
            / (beta.powi(3) * (1.0 + beta.cos() * beta.cosh()))
    };
    let last = space.squares[..space.modes].iter().copied().fold(0.0, f64::max);
    let mut worst = [0.0_f64; 2];
    for i in 1..200 {
        let square = last * (f64::from(i) / 200.0).powi(2);
        if space.squares.iter().any(|own| (own / square - 1.0).abs() < 1e-3) {
            continue;
        }
        let whole = exact(square);
        // Beside the response itself, or the deflection at standstill where that is larger.
        let size = whole.abs().max(1.0 / 3.0);
        worst[0] = worst[0].max((response(&plain, square) - whole).abs() / size);
        worst[1] = worst[1].max((response(&space, square) - whole).abs() / size);
    }
    assert!(worst[1] < 1e-6, "{worst:?}");
    assert!(worst[0] > 1e-6 && worst[0] < 1e-2, "{worst:?}");
    assert!(space.error_estimate.expect("compared") < 1e-6);
}

#[test]
fn as_few_residual_vectors_join_as_bring_the_response_within_a_millionth() {
    let wanted = request(&["load.tip.force.y"], &["tip"]);
    let space = ask(&cantilever(""), &wanted, 6).expect("a sound model");
    let added = space.residual_vectors;
    assert!((1..=3).contains(&added) && space.solution.warnings.is_empty(), "{added}");
    assert!(space.error_estimate.expect("compared") <= 1e-6);
    let last = space.squares[..space.modes].iter().copied().fold(0.0, f64::max);
    for i in 1..100 {
        let square = last * (f64::from(i) / 100.0).powi(2);
        let beta = square.powf(0.25);
        let exact = (beta.sin() * beta.cosh() - beta.cos() * beta.sinh())
            / (beta.powi(3) * (1.0 + beta.cos() * beta.cosh()));
        let apart = (response(&space, square) - exact).abs();
        assert!(apart < 1e-6 * exact.abs().max(1.0 / 3.0), "{apart:e} at {square}");
    }
    // One fewer would not do.
    let fewer = StateSpaceRequest { residual_vectors: Some(added - 1), ..wanted.clone() };
    let fewer = ask(&cantilever(""), &fewer, 6).expect("a sound model");
    assert_eq!(fewer.residual_vectors, added - 1);
    assert!(fewer.error_estimate.expect("compared") > 1e-6);
}

#[test]
fn an_acceleration_is_compared_as_what_it_is() {
    // Nothing of an acceleration goes through by static correction, so that modes alone are far off.
    let modes = StateSpaceRequest {
        residual_vectors: Some(0),
        ..request(&["load.tip.force.y"], &["tip", "tip.acceleration"])
    };
    let plain = ask(&cantilever(""), &modes, 6).expect("a sound model");
    assert!(plain.error_estimate.expect("compared") > 1e-4);
    let space =
        ask(&cantilever(""), &StateSpaceRequest { residual_vectors: None, ..modes }, 6).expect("sound");
    assert!(space.error_estimate.expect("compared") <= 1e-6);
    for omega in [1.0_f64, 10.0, 40.0, 80.0, 150.0, 250.0] {
        let [of_place, of_rate] = [0, 1].map(|k| space.response(omega).expect("no pole")[k][0][0]);
        close(of_rate, -omega * omega * of_place, 1e-6);
    }
}

/// The platform of six rods, loaded by nothing, with a plate of 0.2 kg.
fn platform() -> String {
    let text = include_str!("../../../models/six_rod_robot.toml");
    let (text, _) = text.split_once("\n[unknown]").expect("an inverse problem");
    let text = text.replace("poisson = 0.305", "poisson = 0.305\ndensity = \"7800 kg/m^3\"").replace(
        "[body.plate]\n",
        "[body.plate]\nmass = \"0.2 kg\"\ninertia = [\"5e-4 kg*m^2\", \"5e-4 kg*m^2\", \"1e-3 kg*m^2\"]\n",
    );
    format!(
        "{text}\n[load.push]\nbody = \"plate\"\nforce = [\"1e-6 N\", \"1e-6 N\", \"1e-6 N\"]\n\
         [load.side]\nbody = \"plate\"\nat = [\"60 mm\", \"30 mm\", 0]\nforce = [\"1e-6 N\", \"1e-6 N\", \"1e-6 N\"]\n\
         [output]\nplate = \"body.plate.position\"\n"
    )
}

/// The largest difference of the undamped responses up to a circular frequency, beside the largest of each output.
fn apart(near: &StateSpace, whole: &StateSpace, last: f64) -> f64 {
    let mut worst = 0.0_f64;
    for i in 0..20 {
        let omega = last * (f64::from(i) + 0.37) / 20.0;
        let [near, whole] = [near, whole].map(|space| space.response(omega).expect("no pole"));
        for u in 0..whole[0].len() {
            let size = whole.iter().map(|row| row[u][0].abs()).fold(0.0, f64::max);
            for (near, whole) in near.iter().zip(&whole) {
                worst = worst.max((near[u][0] - whole[u][0]).abs() / size);
            }
        }
    }
    worst
}

#[test]
fn a_platform_of_six_inputs_takes_residual_vectors_for_each() {
    let ask = |count, residual_vectors| {
        let study = ModesStudy { count, at_rest: false, path: None };
        let wanted = StateSpaceRequest { residual_vectors, ..request(&[], &["plate"]) };
        ask_about(&platform(), &wanted, study).expect("a sound model")
    };
    let whole = ask(30, Some(2));
    let warned =
        |space: &StateSpace| space.solution.warnings.iter().any(|text| text.starts_with("the state space"));
    // Three modes of the plate on its rods, far below those of the rods themselves.
    let space = ask(3, None);
    assert_eq!((space.inputs.len(), space.outputs.len()), (6, 3));
    let last = space.squares[2].sqrt();
    let (error, found) = (space.error_estimate.expect("compared"), apart(&space, &whole, last));
    assert!(!warned(&space) && (1..=3).contains(&space.residual_vectors), "{}", space.residual_vectors);
    assert!(error <= 1e-6 && found < 1e-6, "{error:e} {found:e}");
    // The sixth is one of many rods' that lie together: what is left out is too near to be replaced, and that is said.
    let space = ask(6, None);
    let last = space.squares[..6].iter().copied().fold(0.0, f64::max).sqrt();
    assert!(warned(&space) && space.residual_vectors == 3, "{:?}", space.solution.warnings);
    assert!(space.error_estimate.expect("compared") > 1e-6 && apart(&space, &whole, last) > 1e-6);
}

#[test]
fn an_acceleration_of_the_ground_drives_modes_by_their_effective_masses() {
    let space =
        ask(&cantilever(""), &request(&["ground.acceleration.y"], &["tip"]), 8).expect("a sound model");
    let n = space.squares.len();
    for beta in BETAS {
        let i = (0..n).find(|i| (space.squares[*i] / beta.powi(4) - 1.0).abs() < 1e-6).expect("a mode");
        let sigma = (beta.sinh() - beta.sin()) / (beta.cosh() + beta.cos());
        close(space.b[n + i][0].powi(2), 4.0 * sigma * sigma / (beta * beta), 1e-7);
    }
}

#[test]
fn damping_of_beams_and_of_modes_stands_in_the_rates() {
    let mut wanted = request(&["load.tip.force.y"], &["tip", "tip.velocity", "tip.acceleration"]);
    wanted.damping_ratio = 0.02;
    wanted.residual_vectors = Some(0);
    let damped = cantilever("damping = \"1e-3 s\"");
    let space = ask(&damped, &wanted, 4).expect("a sound model");
    let n = space.squares.len();
    for i in 0..n {
        let square = space.squares[i];
        // Kelvin and Voigt: moments grow by τ κ̇, so that a mode's rate is held by τ ω².
        close(-space.a[n + i][n + i], 1e-3 * square + 0.04 * square.sqrt(), 1e-7);
        assert_eq!((space.c[1][i], space.c[1][n + i]), (0.0, space.c[0][i]));
    }
    let lifted: f64 = (0..n).map(|i| space.c[0][i] * space.b[n + i][0]).sum();
    close(space.d[2][0], lifted, 1e-12);
    assert_eq!(space.outputs[2].unit, "m/s^2");
}

#[test]
fn a_damped_response_is_the_receptance_with_a_complex_stiffness() {
    let time = 2e-3;
    let mut wanted = request(&["load.tip.force.y"], &["tip"]);
    wanted.residual_vectors = Some(3);
    let space = ask(&cantilever("damping = \"2e-3 s\""), &wanted, 6).expect("a sound model");
    let last = space.squares[..space.modes].iter().copied().fold(0.0, f64::max).sqrt();
    let one = Complex::new(1.0, 0.0);
    for i in 1..60 {
        let omega = last * f64::from(i) / 60.0;
        // Moments κ + τ κ̇: the stiffness is 1 + iωτ.
        let stiff = one + Complex::new(0.0, omega * time);
        let beta = (Complex::new(omega * omega, 0.0) / stiff).powf(0.25);
        let exact = (beta.sin() * beta.cosh() - beta.cos() * beta.sinh())
            / (stiff * beta.powi(3) * (one + beta.cos() * beta.cosh()));
        let [re, im] = space.response(omega).expect("no pole")[0][0];
        let apart = (re - exact.re).hypot(im - exact.im);
        let size = exact.re.hypot(exact.im).max(1.0 / 3.0);
        assert!(apart < 1e-6 * size, "{omega}: {re} + {im} i instead of {exact}");
    }
}

#[test]
fn what_is_not_there_is_told_with_what_is() {
    let told = |request: &StateSpaceRequest| ask(&cantilever(""), request, 4).expect_err("wrong").to_string();
    assert!(told(&request(&["load.top.force.y"], &[])).contains("has no input `load.top.force.y`"));
    assert!(told(&request(&[], &["top"])).contains("has no output `top`"));
    assert!(told(&request(&[], &["force"])).contains("cannot follow `force`"));
    let negative = StateSpaceRequest { damping_ratio: -0.1, ..request(&[], &[]) };
    assert!(told(&negative).contains("negative damping ratio"));
}
