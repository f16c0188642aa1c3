//! A model with other values of its parameters is the one that its file makes with them, to the last bit.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]
use flexura_model::Model;
use flexura_modelfile::{Document, to_toml};
use std::path::PathBuf;
use std::sync::Arc;

fn models() -> Vec<PathBuf> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    assert!(files.len() > 60, "{}", files.len());
    files
}

/// Everything but the rules, which are the same, as text.
fn whole(model: &Model) -> String {
    let mut model = model.clone();
    model.bindings = Arc::default();
    format!("{model:#?}")
}

/// The same without studies, which stay what they were when a parameter changes.
fn text(model: &Model) -> String {
    let mut model = model.clone();
    model.studies.clear();
    whole(&model)
}

/// The first lines that differ.
fn difference(a: &str, b: &str) -> String {
    let pair = a.lines().zip(b.lines()).enumerate().find(|(_, (a, b))| a != b);
    pair.map_or("lengths".to_string(), |(i, (a, b))| format!("line {i}: {a} | {b}"))
}

#[test]
fn values_put_into_a_model_make_what_its_file_makes() {
    let mut structural = Vec::new();
    let mut compared = 0;
    let mut refused = 0;
    for path in models() {
        let name = path.file_stem().unwrap().to_string_lossy().to_string();
        let document = Document::read(&path).unwrap();
        let Ok(model) = document.model(&[]) else { panic!("{name}") };
        assert_eq!(text(&model), text(&model.at(&[]).unwrap()), "{name}: unchanged");
        for (i, parameter) in model.parameters.iter().enumerate() {
            if parameter.is_structural {
                structural.push(format!("{name}: {}", parameter.name));
                continue;
            }
            for value in [parameter.value * 1.07 + 0.003, parameter.value * 0.93, -parameter.value] {
                let overrides = [(parameter.name.clone(), format!("{value:e} {}", parameter.unit))];
                let read = document.model(&overrides);
                let made = model.at(&[(i, value)]);
                match (read, made) {
                    (Ok(read), Ok(made)) => {
                        let (a, b) = (text(&read), text(&made));
                        assert!(a == b, "{name} {} = {value}: {}", parameter.name, difference(&a, &b));
                        compared += 1;
                    }
                    // What no model can be is told by one or the other's check.
                    (Err(_), Ok(made)) => {
                        assert!(!made.validate_mechanism().is_empty(), "{name} {} = {value}", parameter.name);
                        refused += 1;
                    }
                    (Err(_), Err(_)) => refused += 1,
                    (Ok(_), Err(issue)) => panic!("{name} {} = {value}: {issue:?}", parameter.name),
                }
            }
        }
    }
    println!("{compared} compared, {refused} refused, structural: {structural:#?}");
    assert!(compared > 500, "{compared}");
    // How often something is repeated decides of which parts a mechanism is made.
    assert_eq!(structural, ["lattice: n", "lattice_3d: n"]);
}

/// Every kind of rule: directions, second axes, the three ways to write a rotation, ratios, rows, functions, notches.
const EVERY_KIND: &str = r#"
format = 1
gravity = [0, "0.1*g0", "-g0"]
[parameter]
p = 1.1
q = "p*p - 0.2"
g0 = "9.8 m/s^2"
size = "20 mm"
half = "size/2"
swing = "0.3 rad"
nu = 0.3
exponent = 2
[material.steel]
young = "p*200 GPa"
poisson = "nu"
density = "7800*q"
[section.leaf]
shape = "rectangle"
width = "size*(1 + q*s/(1 m))"
height = { notch = "elliptic", thickness = "half/20", semi_axis_along = "half", semi_axis_across = "half/3", at = "0.4*p" }
[section.rows]
shape = "circle"
along = [{ at = 0, diameter = "half/9" }, { at = "0.4*p", diameter = "half/8" }, { at = 1, diameter = "half/10" }]
[section.hollow]
shape = "tube"
outer_diameter = "half/5"
inner_diameter = "half/7"
[section.stiff]
shape = "stiffness"
matrix = [["p*1e5",0,0,0,0,0],[0,1e5,0,0,0,0],[0,0,1e5,0,0,0],[0,0,0,"q",0,0],[0,0,0,0,1,0],[0,0,0,0,0,"2*p"]]
[body.a]
at = ["size", 0, "half"]
rotation = { axis = [0, "p", 1], angle = "swing" }
mass = "p*0.1"
inertia = ["1e-4*p", 2e-4, 2e-4]
[body.b]
at = [0, "size", 0]
rotation = { rpy = ["swing", "2*swing", 0.1] }
inertia = [["1e-4*p", 0, 0], [0, 2e-4, 0], [0, 0, 2e-4]]
[body.c]
rotation = { quat_wxyz = ["cos(swing/2)", "sin(swing/2)", 0, 0] }
[body.d]
at = [0, 0, "5*size"]
[beam.leaf]
material = "steel"
section = "leaf"
length = "5*size"
start = { body = "ground", at = ["half", 0, 0], rotation = { axis = [0, 0, 1], angle = "swing" }, hold = "revolute", axis = [0, "p", "q"], stiffness = "p*3" }
end = { body = "a", hold = "free", x = { stiffness = "p*1e3" }, turning = { stiffness = "p", rest = [0, "swing/9", 0] } }
distributed = { force = [0, "p*s", "2 N/m*q"], from = "0.1*p", to = "0.9" }
foundation = { stiffness = "p*1e3", direction = [0, "p", 1] }
[beam.arc]
material = "steel"
section = "rows"
curve = { kind = "helix", radius = "size", pitch = "half", turns = "swing*4" }
frame = { kind = "frenet", offset = "swing" }
start = { body = "ground", hold = "clamp" }
[beam.curved]
section = "stiff"
curve = { kind = "curvature", k1 = 0, k2 = "p*s", k3 = "q", length = "size" }
start = { body = "ground", hold = "clamp" }
[beam.path]
section = "stiff"
curve = { kind = "parametric", x = "size*t", y = "half*t^2", z = "0 m", range = [0, "p"] }
frame = { kind = "direction", along = [0, "q", 1] }
start = { body = "ground", hold = "clamp" }
end = { beam = "leaf", at = "0.3*p", offset = [0, "half/20", 0], hold = "pin" }
[joint.u]
kind = "universal"
parent = "b"
child = "ground"
axis = ["p", "q", 0]
second_axis = [0, 0, "p"]
first = { stiffness = "2*p", limits = { range = ["-swing", "swing*2"], stiffness = "p" } }
second = { effort = "p" }
[joint.r]
kind = "revolute"
parent = "ground"
child = "c"
axis = [0, "q", "p"]
coordinate = "swing"
[joint.slide]
kind = "prismatic"
parent = { body = "ground", at = ["size", 0, 0] }
child = "d"
axis = [0, 0, 1]
[joint.wheel]
kind = "rolling"
parent = "ground"
child = "e"
child_curve = { kind = "circle", radius = "size" }
parent_curve = { kind = "line", normal = [0, 1] }
slide = { kind = "ratio", ratio = "3*p" }
close = true
[body.e]
at = [0, "size", 0]
[coupling.screw]
relation = "joint.slide.coordinate = p*size*joint.u.first + half"
[spring.s]
from = { body = "ground", at = [0, 0, "size"] }
to = { beam = "leaf", at = "size", offset = [0, 0, "half/9"] }
law = "table"
rows = [[0, 0], ["half", "p*1 N"], ["2*half", "p*5 N"]]
rest_length = "p*half"
size = "q"
[spring.wrapped]
from = { body = "ground", at = [0, 0, "-size"] }
to = { body = "a" }
law = "exponential"
area = "1e-6*p"
exponent = "q"
stress = "1e5*p"
wrap = { body = "ground", cylinder = "half/9", axis = [0, "p", 1] }
[cable.c]
tension = "p*2 N"
route = [{ body = "ground" }, { beam = "leaf", from = 0.1, to = "0.9", offset = ["half/10", "half/20*p"] }]
[tubes.robot]
base = { body = "ground", at = [0, 0, "half"], rotation = { axis = [0, 1, "p"], angle = "swing" } }
tube = { material = "steel", section = "hollow", straight = "size", curved = "2*size", radius = "3*size", rotation = "swing", translation = "-half" }
force = [0, "p", 0]
[mass.m]
beam = "leaf"
at = "0.5*p"
mass = "0.01*p"
[load.l]
body = "a"
at = ["half", 0, 0]
force = ["p", 0, "2 N*q"]
[load.m]
beam = "leaf"
at = "p*0.5"
moment = [0, "p", 0]
[output]
half = "body.a.position.x/p + half"
power = "(body.a.position.x)^exponent*0"
[unknown]
g1 = { guess = "p", range = ["-p", "3*p"] }
[target]
"body.a.position.z + half" = "half*g1"
"#;

#[test]
fn every_kind_of_rule_gives_what_the_file_gives() {
    let document = Document::parse(EVERY_KIND, "every_kind.toml").unwrap();
    let model = document.model(&[]).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let mut paths: Vec<&str> = model.bindings.iter().map(|binding| &*binding.path).collect();
    paths.sort_unstable();
    println!("{} rules: {paths:#?}", paths.len());
    for (i, parameter) in model.parameters.iter().enumerate() {
        // An exponent on which a dimension hangs, and it alone, keeps its value.
        assert_eq!(parameter.is_structural, ["exponent"].contains(&&*parameter.name), "{}", parameter.name);
        if parameter.is_structural {
            continue;
        }
        for factor in [1.0, 1.01, 0.97, 1.1] {
            let value = parameter.value * factor;
            let overrides = [(parameter.name.clone(), format!("{value:e} {}", parameter.unit))];
            let read = document.model(&overrides).unwrap();
            let made = model.at(&[(i, value)]);
            let (a, b) = (text(&read), text(&made.unwrap()));
            assert!(a == b, "{} = {value}: {}", parameter.name, difference(&a, &b));
        }
    }
}

/// Unit vectors and quaternions are made so again when they are read, which may change their last digit.
fn nearly(a: &str, b: &str) -> Result<(), String> {
    let numbers = |text: &str| -> Vec<String> {
        text.split(|c: char| !(c.is_alphanumeric() || "+-._".contains(c))).map(str::to_string).collect()
    };
    let (left, right) = (numbers(a), numbers(b));
    for (x, y) in left.iter().zip(&right) {
        let alike = match (x.parse::<f64>(), y.parse::<f64>()) {
            (Ok(x), Ok(y)) => x == y || (x - y).abs() <= 4e-16 * x.abs().max(1e-3),
            _ => x == y,
        };
        if !alike {
            return Err(format!("{x} | {y}: {}", difference(a, b)));
        }
    }
    if left.len() == right.len() { Ok(()) } else { Err("lengths".to_string()) }
}

#[test]
fn a_model_that_is_written_out_reads_back_as_the_same() {
    let mut all: Vec<(String, Document)> =
        models().iter().map(|path| (path.display().to_string(), Document::read(path).unwrap())).collect();
    all.push(("every kind".to_string(), Document::parse(EVERY_KIND, "every_kind.toml").unwrap()));
    let mut moved = 0;
    for (name, document) in all {
        let model = document.model(&[]).unwrap();
        let written = to_toml(&model).unwrap_or_else(|issue| panic!("{name}: {issue:?}"));
        let again = Document::parse(&written, "written.toml")
            .and_then(|document| document.model(&[]))
            .unwrap_or_else(|report| panic!("{name}: {}\n{written}", report.render(false)));
        let plain = |model: &Model| {
            let mut model = model.clone();
            // Of a written copy of a repeated table nothing hangs on the count any more.
            model.parameters.iter_mut().for_each(|parameter| parameter.is_structural = false);
            whole(&model)
        };
        nearly(&plain(&model), &plain(&again)).unwrap_or_else(|why| panic!("{name}: {why}\n{written}"));
        // The rules are kept too: both follow a parameter alike.
        for (i, parameter) in model.parameters.iter().enumerate().filter(|(_, p)| !p.is_structural) {
            let value = [(i, parameter.value * 1.01)];
            if let (Ok(a), Ok(b)) = (model.at(&value), again.at(&value)) {
                nearly(&plain(&a), &plain(&b))
                    .unwrap_or_else(|why| panic!("{name} {}: {why}", parameter.name));
                moved += 1;
            }
        }
    }
    assert!(moved > 200, "{moved}");
}
