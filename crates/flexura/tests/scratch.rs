use flexura::modelfile::Document;
use flexura::{Prepared};
fn index(text: &str) -> (flexura::solution::Status, String) {
    let model = Document::parse(text, "x.toml").map_err(|e| e.render(false)).unwrap().model(&[]).map_err(|e| e.render(false)).unwrap();
    let mut p = Prepared::new(&model).map_err(|e| e.message).unwrap();
    let o = p.solve(1e-9, &mut |_| {});
    let s = p.problem().stability();
    (o.status, format!("{s:?} tip {:?}", p.problem().tip()))
}
fn column(n: f64, end: &str) -> String {
    format!(r#"
format = 1
[section.s]
shape = "stiffness"
EA = "1e4 N"
GJ = "0.8 N*m^2"
EI2 = "1 N*m^2"
EI3 = "3 N*m^2"
[beam.b]
section = "s"
length = "1 m"
start = {{ body = "ground", hold = "clamp" }}
{end}
"#) + &if end.is_empty() { format!("[load.p]\nbeam = \"b\"\nat = 1\nforce = [{}, 0, 0]\n", -n) } else {
    format!("[body.slider]\nat = [1, 0, 0]\n[joint.way]\nkind = \"prismatic\"\nparent = {{ body = \"ground\", at = [1,0,0] }}\nchild = \"slider\"\naxis = [1,0,0]\n[load.p]\nbody = \"slider\"\nforce = [{}, 0, 0]\n", -n) }
}
#[test]
fn columns() {
    let pi2 = std::f64::consts::PI.powi(2);
    for f in [0.9, 1.1, 2.9, 3.1, 8.9, 9.1, 26.9, 27.1] {
        println!("free {f}: {:?}", index(&column(f * pi2 / 4.0, "")));
    }
    for f in [0.9, 1.1, 2.02, 2.1, 2.9, 3.1, 3.9, 4.1] {
        println!("clamped {f}: {:?}", index(&column(f * pi2 * 4.0, "end = { body = \"slider\", hold = \"clamp\" }")));
    }
    for name in std::fs::read_dir("../../models").unwrap() {
        let path = name.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") && !path.display().to_string().contains("lattice") {
            let text = std::fs::read_to_string(&path).unwrap();
            println!("{}: {:?}", path.display(), index(&text));
        }
    }
}
