//! The module that is kept for the page must give the solver's own answers: each model is solved by both, and poses must agree
//! within the sum of both estimates of the error.

use flexura_live::Live;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const SAMPLES: usize = 11;
/// Round-off, where an estimate says less: relative to the length and to one turn.
const ROUND_OFF: f64 = 1e-12;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn models() -> Vec<PathBuf> {
    let list = std::fs::read_dir(root().join("models")).expect("the models are there");
    let mut paths: Vec<PathBuf> = list.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    // A page finds no other files: those that include some come to it written out.
    paths.retain(|path| {
        std::fs::read_to_string(path).is_ok_and(|text| !text.lines().any(|line| line.starts_with("include")))
    });
    paths.sort();
    paths
}

/// What the solver itself answers.
fn native(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).expect("a model");
    let name = path.file_name().expect("a name").to_string_lossy().into_owned();
    let mut live = Live::default();
    let mut ask = |request: Value| -> Value {
        serde_json::from_str(&live.answer(&request.to_string())).expect("answers are JSON")
    };
    let opened = ask(json!({ "do": "open", "text": text, "name": name }));
    if opened["opened"].is_null() { opened } else { ask(json!({ "do": "solve", "samples": SAMPLES })) }
}

/// The keys of a document, which tell whether both write the same one.
fn shape(value: &Value, path: &str, into: &mut Vec<String>) {
    if let Value::Object(map) = value {
        for (key, value) in map {
            let path = format!("{path}.{key}");
            shape(value, &path, into);
            into.push(path);
        }
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().map(|list| list.iter().map(number).collect()).unwrap_or_default()
}

/// Positions and rotations of all beams and bodies.
fn poses(document: &Value) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    let of = |kind: &str| document[kind].as_object().cloned().unwrap_or_default();
    for (_, beam) in of("beams").into_iter().chain(of("tubes")) {
        positions.extend(beam["position"].as_array().into_iter().flatten().map(numbers));
        rotations.extend(beam["rotation"].as_array().into_iter().flatten().map(numbers));
    }
    for (_, body) in of("bodies") {
        positions.push(numbers(&body["position"]));
        rotations.push(numbers(&body["rotation"]));
    }
    (positions, rotations)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The longest beam or tube or the remotest body, which errors of positions are measured by.
fn length(document: &Value) -> f64 {
    let of = |kind: &str| document[kind].as_object().cloned().unwrap_or_default();
    let ends = of("beams")
        .into_iter()
        .chain(of("tubes"))
        .filter_map(|(_, beam)| numbers(&beam["s"]).last().copied());
    let longest = ends.fold(0.0, f64::max);
    let bodies = of("bodies");
    let far = bodies.values().map(|body| distance(&numbers(&body["position"]), &[0.0; 3]));
    if longest > 0.0 { longest } else { far.fold(0.0, f64::max).max(f64::MIN_POSITIVE) }
}

/// What of two answers is not the same.
fn difference(own: &Value, kept: &Value) -> Option<String> {
    let (a, b) = (&own["document"], &kept["document"]);
    if a.is_null() || b.is_null() {
        return (own != kept).then(|| format!("{own} against {kept}"));
    }
    let (mut x, mut y) = (Vec::new(), Vec::new());
    shape(a, "", &mut x);
    shape(b, "", &mut y);
    if let Some(key) = x.iter().find(|key| !y.contains(key)).or_else(|| y.iter().find(|key| !x.contains(key)))
    {
        return Some(format!("only one of them has {key}"));
    }
    for key in ["status", "stable", "unstable_directions"] {
        if a[key] != b[key] {
            return Some(format!("{key}: {} against {}", a[key], b[key]));
        }
    }
    if a["status"] != "converged" {
        let far = (number(&a["load_fraction"]) - number(&b["load_fraction"])).abs();
        return (far > 1e-6)
            .then(|| format!("they reach {} and {} of the load", a["load_fraction"], b["load_fraction"]));
    }
    let bound = number(&a["error_estimate"]) + number(&b["error_estimate"]) + ROUND_OFF;
    let ((p, q), (r, s)) = (poses(a), poses(b));
    if (p.len(), q.len()) != (r.len(), s.len()) {
        return Some("they have not the same samples".to_owned());
    }
    let far = p.iter().zip(&r).map(|(p, r)| distance(p, r)).fold(0.0, f64::max) / length(a);
    // A quaternion and its opposite are the same rotation; half of the angle between is what they differ by.
    let opposite = |s: &[f64]| s.iter().map(|x| -x).collect::<Vec<_>>();
    let turn = q
        .iter()
        .zip(&s)
        .map(|(q, s)| 2.0 * distance(q, s).min(distance(q, &opposite(s))))
        .fold(0.0, f64::max);
    (!(far <= bound && turn <= bound)).then(|| {
        format!(
            "positions differ by {far:.1e} of the length, rotations by {turn:.1e}; {bound:.1e} is allowed"
        )
    })
}

#[test]
#[ignore = "needs Node"]
fn the_kept_module_gives_the_solvers_answers() {
    let module = root().join("crates/report/src/live.wasm.gz");
    let models = models();
    let child = Command::new("node")
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/answers.mjs"))
        .arg(&module)
        .arg(SAMPLES.to_string())
        .args(&models)
        .stdout(Stdio::piped())
        .spawn()
        .expect("Node runs the module; `cargo xtask test` installs it");
    let own: Vec<Value> = models.iter().map(|path| native(path)).collect();
    let output = child.wait_with_output().expect("Node ends");
    let text = String::from_utf8(output.stdout).expect("text");
    let kept: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(kept.len(), models.len(), "Node did not get through all models");
    let stale: Vec<String> = own
        .iter()
        .zip(&kept)
        .filter_map(|(own, kept)| {
            let why = match kept["answer"].get("broken") {
                Some(broken) => Some(format!("it broke off: {broken}")),
                None => difference(own, &kept["answer"]),
            };
            why.map(|why| format!("{}: {why}", kept["name"].as_str().unwrap_or_default()))
        })
        .collect();
    assert!(
        stale.is_empty(),
        "crates/report/src/live.wasm.gz is stale; renew it with `cargo xtask live`\n{}",
        stale.join("\n")
    );
    let converged = own.iter().filter(|own| own["document"]["status"] == "converged").count();
    assert!(converged > models.len() / 2, "{converged} models converged");
}

#[test]
fn an_answer_that_is_off_by_more_than_the_estimates_is_told() {
    let own = native(&root().join("models/elastica.toml"));
    assert_eq!(difference(&own, &own), None);
    let mut other = own.clone();
    let tip = &mut other["document"]["beams"]["rod"]["position"][SAMPLES - 1][1];
    *tip = json!(number(tip) + 1e-7);
    assert!(difference(&own, &other).is_some_and(|why| why.starts_with("positions differ by 1.0e-7")));
    let mut other = own.clone();
    other["document"]["stable"] = json!(false);
    assert!(difference(&own, &other).is_some_and(|why| why.starts_with("stable")));
    let mut other = own.clone();
    other["document"].as_object_mut().expect("a document").remove("energy");
    assert!(difference(&own, &other).is_some_and(|why| why.contains("energy")));
}
