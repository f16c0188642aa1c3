use flexura::model::*;
use flexura::modelfile::Document;
use flexura::solution::*;
use flexura::{FileFamily, Options};
const STRIP: &str = r#"
format = 1
gravity = [0, 0, "-1 m/s^2"]
[parameter]
n = 0
weight = 0
slope = "0 deg"
[section.s]
shape = "stiffness"
EA = "1 N"
GJ = "0.8 N*m^2"
EI2 = "1 N*m^2"
EI3 = "30 N*m^2"
[beam.b]
section = "s"
length = "1 m"
extension = false
start = { body = "ground", hold = "clamp" }
end = { body = "slider", hold = "clamp" }
[body.slider]
at = [1, 0, 0]
[joint.way]
kind = "prismatic"
parent = { body = "ground", at = [1,0,0] }
child = "slider"
axis = [1,0,0]
[load.p]
body = "slider"
force = ["-n*2.4674011002723395 N", 0, 0]
[load.w]
beam = "b"
at = 0.5
force = ["-weight*sin(slope)*2.4674011002723395 N", 0, "-weight*cos(slope)*2.4674011002723395 N"]
[output]
u1 = "joint.way.coordinate"
w = "beam.b[0.5].position.z"
"#;
fn show(t: &Trace) {
    println!("{:?} {:?} {:?} stab {:?} {:?}", t.status, t.reason, t.warnings, t.stability_reason, t.work);
    for (i, b) in t.branches.iter().enumerate() {
        println!("branch {i} {:?} {} points, ends {:?}", b.origin, b.points.len(), b.ends);
        for p in &b.points {
            if p.kind != PointKind::Regular {
                println!(
                    "  {:?} p {:.12} out {:?} idx {:?} err {:.1e}",
                    p.kind, p.parameter, p.outputs, p.unstable_directions, p.error_estimate
                );
            }
        }
    }
    if let Some(c) = &t.critical {
        println!("critical {:?} ends {:?}", c.kind, c.ends);
        for (q, p) in &c.points {
            println!("   {q} {:.12} {:?}", p.parameter, p.outputs);
        }
    }
}
fn go(text: &str, over: &[(&str, &str)], study: TraceStudy, name: &str) -> Trace {
    let over: Vec<(String, String)> = over.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect();
    let doc = Document::parse(text, "x.toml").map_err(|e| e.render(false)).unwrap();
    let model = doc.model(&over).map_err(|e| e.render(false)).unwrap();
    let mut family = FileFamily::new(&doc, &over, &model);
    let now = std::time::Instant::now();
    let t = flexura::trace(
        &model,
        &mut family,
        &study,
        &Options { tolerance: 1e-9, ..Options::default() },
        &mut |_| {},
    )
    .map_err(|e| e.message)
    .unwrap();
    println!("--- {name} in {:?}", now.elapsed());
    show(&t);
    t
}

fn buckle(path: &str, parameter: Option<&str>, at: f64) {
    let doc = Document::read(path).map_err(|e| e.render(false)).unwrap();
    let model = doc.model(&[]).map_err(|e| e.render(false)).unwrap();
    let mut family = FileFamily::new(&doc, &[], &model);
    let parameter = parameter.map(|p| model.parameters.iter().position(|q| q.name == p).unwrap());
    let now = std::time::Instant::now();
    match flexura::buckle(&model, &mut family, &BuckleStudy { parameter, at, count: 4 }, &Options::default())
    {
        Ok(b) => {
            println!("{path} {:?} in {:?}", b.solution.status, now.elapsed());
            for m in &b.modes {
                println!("   {} +- {:.1e}", m.value, m.error_estimate);
            }
        }
        Err(e) => println!("{path} {} {}", e.path, e.message),
    }
}
fn file(path: &str, parameter: &str, range: [f64; 2], study: TraceStudy) {
    let text = std::fs::read_to_string(path).unwrap();
    let doc = Document::parse(&text, path).map_err(|e| e.render(false)).unwrap();
    let model = doc.model(&[]).map_err(|e| e.render(false)).unwrap();
    let parameter = model.parameters.iter().position(|q| q.name == parameter).unwrap();
    go(&text, &[], TraceStudy { parameter, range, start: range[0], ..study }, path);
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    if a[1] == "buckle" {
        buckle(&a[2], (a[3] != "-").then_some(a[3].as_str()), a[4].parse().unwrap());
        return;
    }
    let mut s = TraceStudy { branches: a.get(5).map_or(0, |n| n.parse().unwrap()), ..TraceStudy::default() };
    if let Some(n) = a.get(6) {
        s.steps = n.parse().unwrap();
    }
    file(&a[1], &a[2], [a[3].parse().unwrap(), a[4].parse().unwrap()], s);
}
