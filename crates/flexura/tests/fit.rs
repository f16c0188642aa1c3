//! Parameters from measurements: truth recovered, intervals that hold it as often as they say, and what the data do not tell.

#![allow(clippy::unwrap_used)]

use flexura::model::{FitStudy, Measurements, Model, StudyKind};
use flexura::modelfile::Document;
use flexura::solution::{Fit, Status};
use flexura::{Evaluator, Options, fit};

/// A bone as a cantilever that is pulled sideways at its tip (thesis, 4.2.1): its modulus, thickness and length.
const BONE: &str = r#"
format = 1
[parameter]
young = "2 GPa"
thickness = "3.2 mm"
length = "30 mm"
pull = "1 N"
[material.bone]
young = "young"
poisson = 0.3
[section.oval]
shape = "ellipse"
width = "thickness"
height = "4.8 mm"
[beam.clavicle]
material = "bone"
section = "oval"
length = "length"
start = { body = "ground", hold = "clamp" }
[load.wire]
beam = "clavicle"
at = 1
force = [0, "pull", 0]
[output]
tip = "beam.clavicle.end.displacement.y"
slope = "beam.clavicle.end.rotation.z"
"#;

/// A ligament of the thesis (4.12): σ = k2 (exp(k1 ε) - 1), pulled along x.
const LIGAMENT: &str = r#"
format = 1
[parameter]
k1 = 8
k2 = "0.004 N/mm^2"
stretch = "2 mm"
area = "69.04 mm^2"
[body.end]
[joint.slide]
kind = "prismatic"
parent = "ground"
child = "end"
axis = [1, 0, 0]
coordinate = "stretch"
[spring.ligament]
law = "exponential"
form = "printed"
area = "area"
exponent = "k1"
stress = "k2"
from = { body = "ground", at = ["-20 mm", 0, 0] }
to = { body = "end" }
[output]
force = "joint.slide.effort"
strain = "spring.ligament.strain"
"#;

fn with_study(text: &str, study: &str) -> Model {
    let text = format!("{text}\n[study.it]\nkind = \"fit\"\n{study}\n");
    Document::parse(&text, "fit.toml").unwrap().model(&[]).unwrap()
}

fn study(model: &Model) -> FitStudy {
    match &model.studies[0].kind {
        StudyKind::Fit(fit) => fit.clone(),
        other => panic!("{other:?}"),
    }
}

/// The model's own answers with true values of parameters, in the place of what was measured.
fn measured(
    model: &Model,
    data: &Measurements,
    truth: &dyn Fn(usize) -> Vec<(&'static str, f64)>,
) -> Measurements {
    let mut evaluator = Evaluator::new(model, &[], 1e-12).unwrap();
    let mut data = data.clone();
    let place = |name: &str| model.parameters.iter().position(|p| p.name == name).unwrap();
    for row in &mut data.rows {
        let mut values: Vec<(usize, f64)> = data.set.iter().copied().zip(row.set.clone()).collect();
        values.extend(truth(row.specimen).into_iter().map(|(name, value)| (place(name), value)));
        let found = evaluator.at(&values, false).unwrap();
        let component = |(output, part): &(usize, usize)| {
            model.outputs[..*output].iter().map(|o| o.formulas.len()).sum::<usize>() + part
        };
        row.measured = data.measured.iter().map(|place| found.values[component(place)]).collect();
    }
    data
}

/// Normal deviates that are the same everywhere (G. E. P. Box, M. E. Muller, 1958, on a Weyl-multiplied counter).
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let (a, b) = (1.0 - self.uniform(), self.uniform());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}

fn noisy(data: &Measurements, deviations: &[f64], noise: &mut Noise) -> Measurements {
    let mut data = data.clone();
    for row in &mut data.rows {
        for (value, deviation) in row.measured.iter_mut().zip(deviations) {
            *value = value.map(|value| value + deviation * noise.normal());
        }
    }
    data
}

fn rows(count: usize, row: impl Fn(usize) -> String) -> String {
    (0..count).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(", ")
}

fn found(model: &Model, study: &FitStudy) -> Fit {
    let (fit, _) = fit(model, study, &Options::default()).unwrap();
    assert_eq!(fit.status, Status::Converged, "{:?}", fit.reason);
    fit
}

#[test]
fn the_modulus_and_the_length_that_made_the_data_are_found() {
    let columns = "columns = [\"pull [N]\", \"tip [mm]\", \"slope [deg]\"]";
    let pulls = rows(12, |i| format!("{}, 0, 0", 0.5 * (i + 1) as f64));
    let text = format!(
        "unknown = [\"young\", \"length\"]\nnoise = {{ tip = \"0.01 mm\", slope = \"0.05 deg\" }}\ndata = {{ {columns}, rows = [{pulls}] }}"
    );
    let model = with_study(BONE, &text);
    let mut study = study(&model);
    study.data = measured(&model, &study.data, &|_| vec![("young", 2.7816e9), ("length", 33e-3)]);
    let fit = found(&model, &study);
    assert!((fit.estimates[0].value / 2.7816e9 - 1.0).abs() < 1e-6, "{:?}", fit.estimates);
    assert!((fit.estimates[1].value / 33e-3 - 1.0).abs() < 1e-6);
    assert!(fit.warnings.is_empty(), "{:?}", fit.warnings);
    assert!(fit.measured.iter().all(|m| m.r_squared.unwrap() > 1.0 - 1e-10));
}

#[test]
fn a_ligament_is_found_by_its_force_and_by_its_logarithm() {
    // Eight samples share the law and differ by their areas, as those of Table 4.2 do.
    let areas = [73.22, 83.99, 52.69, 81.02, 104.5, 73.8, 50.68, 22.29];
    let columns = "columns = [\"stretch [mm]\", \"area [mm^2]\", \"force [N]\", \"specimen\"]";
    let all = rows(8 * 12, |i| {
        let (sample, k) = (i / 12, i % 12);
        format!(
            "{}, {}, 0, \"{}\"",
            0.8 * (k + 1) as f64,
            areas[sample],
            ["A", "B", "C", "D", "E", "F", "G", "H"][sample]
        )
    });
    let model =
        with_study(LIGAMENT, &format!("unknown = [\"k1\", \"k2\"]\ndata = {{ {columns}, rows = [{all}] }}"));
    let mut own = study(&model);
    own.data = measured(&model, &own.data, &|_| vec![("k1", 9.4377), ("k2", 2500.0)]);
    let fit = found(&model, &own);
    assert!((fit.estimates[0].value - 9.4377).abs() < 1e-6 * 9.4, "{:?}", fit.estimates);
    assert!((fit.estimates[1].value - 2500.0).abs() < 1e-6 * 2500.0);
    // The two pull against each other: raising one must lower the other.
    assert!(fit.correlation[0][1].unwrap() < -0.9);

    // (4.13): log σ = k1 ε + log k2 is linear in k1 and log k2, so that it needs no guess.
    let text = LIGAMENT.replace("[output]\n", "[output]\nlog_force = \"ln(joint.slide.effort/(1 N))\"\n");
    let columns = columns.replace("force [N]", "log_force");
    let model =
        with_study(&text, &format!("unknown = [\"k1\", \"k2\"]\ndata = {{ {columns}, rows = [{all}] }}"));
    let mut own = study(&model);
    own.data = measured(&model, &own.data, &|_| vec![("k1", 9.4377), ("k2", 2500.0)]);
    let fit = found(&model, &own);
    assert!((fit.estimates[0].value - 9.4377).abs() < 1e-6 * 9.4);
    assert!((fit.estimates[1].value - 2500.0).abs() < 1e-6 * 2500.0);
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    // 500 draws with 2 % noise on both outputs; 95 % within 93 to 97 %, three standard deviations of the count being 2.9 %.
    let columns = "columns = [\"pull [N]\", \"tip [mm]\", \"slope [deg]\"]";
    let pulls = rows(8, |i| format!("{}, 0, 0", (i + 1) as f64));
    let text = format!(
        "unknown = [\"young\", \"length\"]\nnoise = {{ tip = \"0.02 mm\", slope = \"0.1 deg\" }}\ndata = {{ {columns}, rows = [{pulls}] }}"
    );
    let model = with_study(BONE, &text);
    let mut own = study(&model);
    let truth = [2.7816e9, 31e-3];
    let exact = measured(&model, &own.data, &|_| vec![("young", truth[0]), ("length", truth[1])]);
    let mut noise = Noise(7);
    let mut inside = [0, 0];
    for _ in 0..500 {
        own.data = noisy(&exact, &[0.02e-3, 0.1_f64.to_radians()], &mut noise);
        let fit = found(&model, &own);
        for (count, (estimate, truth)) in inside.iter_mut().zip(fit.estimates.iter().zip(truth)) {
            let [low, high] = estimate.interval.unwrap();
            *count += usize::from(low <= truth && truth <= high);
        }
    }
    for count in inside {
        assert!((465..=485).contains(&count), "{inside:?} of 500");
    }
}

#[test]
fn profiles_are_those_of_a_second_search() {
    let columns = "columns = [\"stretch [mm]\", \"force [N]\"]";
    let pulls = rows(10, |i| format!("{}, 0", (i + 1) as f64));
    let text = format!(
        "unknown = [\"k1\", \"k2\"]\nintervals = \"profile\"\ndata = {{ {columns}, rows = [{pulls}] }}"
    );
    let model = with_study(LIGAMENT, &text);
    let mut own = study(&model);
    let exact = measured(&model, &own.data, &|_| vec![("k1", 9.4377), ("k2", 2500.0)]);
    own.data = noisy(&exact, &[0.8], &mut Noise(3));
    let all = found(&model, &own);
    let sum = |fit: &Fit| fit.scatter.powi(2) * fit.freedom as f64;
    let t = 2.306; // Student, 8 degrees of freedom
    for (k, name) in ["k1", "k2"].iter().enumerate() {
        let [low, high] = all.estimates[k].profile.unwrap().map(Option::unwrap);
        let [linear_low, linear_high] = all.estimates[k].interval.unwrap();
        assert!(low < all.estimates[k].value && all.estimates[k].value < high);
        // Not symmetric, as the law is not linear.
        assert!((high - linear_high).abs() + (low - linear_low).abs() > 1e-3 * (high - low));
        for end in [low, high] {
            // The other one fitted anew with this one as given.
            let mut fixed = model.clone();
            let place = fixed.parameters.iter().position(|p| p.name == *name).unwrap();
            fixed.set(&[(place, end)]).unwrap();
            let mut rest = own.clone();
            rest.profile = false;
            rest.unknowns.retain(|unknown| unknown.parameter != place);
            let other = found(&fixed, &rest);
            let grown = sum(&other) - sum(&all);
            let wanted = t * t * all.scatter.powi(2);
            assert!((grown / wanted - 1.0).abs() < 2e-3, "{name} {end}: {grown} {wanted}");
        }
    }
}

#[test]
fn what_the_data_do_not_see_is_named() {
    // In small bending only E t³ counts: raising E by 1 % and lowering t by a third of it leaves everything.
    let text = BONE
        .replace("width = \"thickness\"\nheight = \"4.8 mm\"", "width = \"thickness\"\nheight = \"1e6*mm\"");
    let text = text.replace("[beam.clavicle]", "[beam.clavicle]\nshear = false\nextension = false");
    let columns = "columns = [\"pull [N]\", \"tip [mm]\"]";
    let pulls = rows(6, |i| format!("{}, {}", 1e3 * (i + 1) as f64, 0.1 * (i + 1) as f64));
    let text = text.replace("height = \"1e6*mm\"", "height = \"4 mm\"");
    let model = with_study(
        &text,
        &format!("unknown = [\"young\", \"thickness\"]\ndata = {{ {columns}, rows = [{pulls}] }}"),
    );
    let mut own = study(&model);
    for (i, row) in own.data.rows.iter_mut().enumerate() {
        row.set[0] = 0.01 * (i + 1) as f64;
    }
    own.data = measured(&model, &own.data, &|_| vec![("young", 2.7816e9), ("thickness", 3e-3)]);
    let fit = found(&model, &own);
    assert_eq!(fit.unseen.len(), 1, "{:?}", fit.unseen);
    let parts = &fit.unseen[0].parts;
    let of = |k: usize| parts.iter().find(|(i, _)| *i == k).unwrap().1;
    assert!((of(1) / of(0) + 1.0 / 3.0).abs() < 1e-4, "{parts:?}");
    assert!(fit.estimates.iter().all(|estimate| estimate.standard_error.is_none()));
    assert!(
        fit.warnings.iter().any(|w| w.contains("do not see") && w.contains("0.333 %")),
        "{:?}",
        fit.warnings
    );
}

#[test]
fn a_specimen_that_is_not_like_the_others_is_named_and_left_out() {
    let columns = "columns = [\"pull [N]\", \"tip [mm]\", \"specimen\"]";
    let all = rows(6 * 8, |i| format!("{}, 0, \"bone {}\"", (i % 8 + 1) as f64 * 0.5, i / 8));
    let base = format!("data = {{ {columns}, rows = [{all}] }}");
    for (key, reject) in [("unknown", true), ("per_specimen", true), ("unknown", false)] {
        let model = with_study(BONE, &format!("{key} = [\"young\"]\nreject = {reject}\n{base}"));
        let mut own = study(&model);
        // Between specimens the modulus differs by 2 %, but the third one is twice as stiff.
        let modulus = |specimen: usize| match specimen {
            2 => 5.6e9,
            other => 2.8e9 * (1.0 + 0.02 * (other as f64 - 2.5)),
        };
        let exact = measured(&model, &own.data, &|specimen| vec![("young", modulus(specimen))]);
        own.data = noisy(&exact, &[2e-6], &mut Noise(11));
        let fit = found(&model, &own);
        let outside: Vec<usize> =
            (0..6).filter(|s| fit.specimens[*s].distance.is_some_and(|d| d > 1.0)).collect();
        assert!(outside.contains(&2), "{key}: {:?}", fit.specimens);
        assert_eq!(fit.specimens[2].is_rejected, reject);
        assert!(fit.warnings.iter().any(|w| w.contains("bone 2")), "{:?}", fit.warnings);
        let others: Vec<f64> = (0..6).filter(|s| !fit.specimens[*s].is_rejected).map(modulus).collect();
        let mean = others.iter().sum::<f64>() / others.len() as f64;
        if key == "per_specimen" {
            assert_eq!(fit.spread[0].count, others.len());
            assert!((fit.spread[0].mean / mean - 1.0).abs() < 2e-3, "{:?}", fit.spread);
            assert!((fit.estimates[2].value / 5.6e9 - 1.0).abs() < 1e-2);
        } else if reject {
            assert!((fit.estimates[0].value / mean - 1.0).abs() < 1e-2, "{:?}", fit.estimates);
        }
    }
}

#[test]
fn outliers_hardly_count_under_a_robust_loss_and_bounds_hold() {
    let columns = "columns = [\"pull [N]\", \"tip [mm]\"]";
    let pulls = rows(20, |i| format!("{}, 0", 0.2 * (i + 1) as f64));
    let base = format!("unknown = [\"young\"]\ndata = {{ {columns}, rows = [{pulls}] }}");
    let mut values = Vec::new();
    for loss in ["squares", "huber", "soft_l1", "cauchy"] {
        let model = with_study(BONE, &format!("loss = \"{loss}\"\n{base}"));
        let mut own = study(&model);
        let exact = measured(&model, &own.data, &|_| vec![("young", 2.7816e9)]);
        own.data = noisy(&exact, &[1e-6], &mut Noise(5));
        for i in [3, 9] {
            own.data.rows[i].measured[0] = own.data.rows[i].measured[0].map(|value| 1.5 * value);
        }
        let fit = found(&model, &own);
        values.push((fit.estimates[0].value / 2.7816e9 - 1.0).abs());
        if loss != "squares" {
            assert!(fit.rows[9].weights[0] < 0.2, "{loss}: {:?}", fit.rows[9]);
        }
    }
    assert!(values[0] > 5e-3 && values[1..].iter().all(|v| *v < 2e-3), "{values:?}");

    let model = with_study(BONE, &format!("bounds = {{ young = [\"1 GPa\", \"2.5 GPa\"] }}\n{base}"));
    let mut own = study(&model);
    own.data = measured(&model, &own.data, &|_| vec![("young", 2.7816e9)]);
    let fit = found(&model, &own);
    assert!(fit.estimates[0].is_at_bound && (fit.estimates[0].value - 2.5e9).abs() < 1.0);
    assert!(fit.warnings.iter().any(|w| w.contains("bounds")), "{:?}", fit.warnings);
}

#[test]
fn rows_without_an_equilibrium_are_left_out_with_their_reason() {
    // The strip between its ends snaps through at a fold: beyond it no equilibrium is reached from rest.
    let text = std::fs::read_to_string(format!("{}/../../models/lee_frame.toml", env!("CARGO_MANIFEST_DIR")));
    let text = text.unwrap().split("[study").next().unwrap().to_string();
    let model = Document::parse(&text, "lee.toml").unwrap().model(&[]).unwrap();
    let own: Vec<&str> = model.parameters.iter().map(|p| p.name.as_str()).collect();
    assert!(own.contains(&"load"), "{own:?}");
    let young = text.lines().find(|line| line.trim_start().starts_with("young")).unwrap().to_string();
    let text = text.replace("[parameter]\n", "[parameter]\nmodulus = 1\n");
    let value = young.split('=').nth(1).unwrap().trim().trim_matches('"').to_string();
    let text = text.replace(&young, &format!("young = \"modulus*{value}\""));
    let columns = "columns = [\"load [N]\", \"down [m]\"]";
    let model = with_study(
        &text,
        &format!(
            "unknown = [\"modulus\"]\ndata = {{ {columns}, rows = [[0.5, 0.02], [0.8, 0.04], [1e9, 0.3], [1.1, 0.06]] }}"
        ),
    );
    let mut own = study(&model);
    let rows = own.data.rows.clone();
    own.data.rows.remove(2);
    own.data = measured(&model, &own.data, &|_| vec![("modulus", 1.05)]);
    own.data.rows.insert(2, rows[2].clone());
    let fit = found(&model, &own);
    assert_eq!(fit.left_out.len(), 1);
    assert_eq!(fit.left_out[0].0, 2);
    assert!(fit.warnings.iter().any(|w| w.starts_with("line 3 left out")), "{:?}", fit.warnings);
    assert!((fit.estimates[0].value - 1.05).abs() < 1e-6, "{:?}", fit.estimates);
}

#[test]
fn a_calibration_is_fitted_piece_by_piece() {
    // (4.16) of the thesis: the force of a motor by its voltage, 1.82 V² - 0.27 V + 0.09 up to one volt and 3.37 V - 1.73 beyond.
    let text = LIGAMENT
        .replace("[parameter]\n", "[parameter]\nvolt = 1\na = \"1 N\"\nb = \"1 N\"\nc = \"1 N\"\n")
        .replace("[output]\n", "[output]\nmotor = \"a*volt^2 + b*volt + c\"\n");
    let low = |v: f64| 1.82 * v * v - 0.27 * v + 0.09;
    let high = |v: f64| 3.37 * v - 1.73;
    let mut noise = Noise(2);
    let mut row = |v: f64, force: f64| format!("[{v}, {}]", force + 1e-3 * noise.normal());
    let lows: Vec<String> = (1..=20).map(|i| f64::from(i) * 0.05).map(|v| row(v, low(v))).collect();
    let highs: Vec<String> = (1..=20).map(|i| 1.0 + f64::from(i) * 0.2).map(|v| row(v, high(v))).collect();
    for (rows, unknown, truth) in [
        (lows, "[\"a\", \"b\", \"c\"]", vec![1.82, -0.27, 0.09]),
        (highs, "[\"b\", \"c\"]", vec![3.37, -1.73]),
    ] {
        let text = if truth.len() == 2 { text.replace("a = \"1 N\"", "a = \"0 N\"") } else { text.clone() };
        let data = format!("data = {{ columns = [\"volt\", \"motor [N]\"], rows = [{}] }}", rows.join(", "));
        let model = with_study(&text, &format!("unknown = {unknown}\n{data}"));
        let fit = found(&model, &study(&model));
        for (estimate, truth) in fit.estimates.iter().zip(truth) {
            let [low, high] = estimate.interval.unwrap();
            // Twice the interval: this is one draw.
            assert!((estimate.value - truth).abs() < high - low, "{:?} {truth}", estimate);
        }
    }
}
