//! Files with very many names are read in time that grows with their number.
#![allow(clippy::unwrap_used)]

use flexura_modelfile::Document;
use std::fmt::Write;
use std::time::Instant;

const REST: &str = r#"
[material.steel]
young = "200 GPa"
poisson = 0.3
[section.wire]
shape = "circle"
diameter = "1 mm"
[beam.wire]
material = "steel"
section = "wire"
length = "100 mm"
start = { body = "ground", hold = "clamp" }
"#;

/// Parameters each of which refers to the one before, outputs, materials, sections: `count` of each, used by nothing.
fn text(count: usize) -> String {
    let mut text = "format = 1\n[parameter]\np0 = \"1 N\"\n".to_string();
    for i in 1..count {
        writeln!(text, "p{i} = \"p{} + 1 N\"", i - 1).unwrap();
    }
    text.push_str(REST);
    for i in 0..count {
        writeln!(
            text,
            "[material.m{i}]\nyoung = 1e9\npoisson = 0.3\n[section.s{i}]\nshape = \"circle\"\ndiameter = 1e-3"
        )
        .unwrap();
    }
    text.push_str("[output]\n");
    for i in 0..count {
        writeln!(text, "o{i} = \"beam.wire.end.position.z\"").unwrap();
    }
    text
}

#[test]
fn many_names_that_nothing_uses_are_told_together() {
    let document = Document::parse(&text(1000), "x.toml").unwrap();
    let warnings: Vec<String> = document.warnings().into_iter().map(|warning| warning.message).collect();
    assert_eq!(
        warnings,
        [
            // Each but the last is used by the next one.
            "the parameter `p999` is never used",
            "1000 materials are never used: `m0`, `m1`, `m2` and 997 more",
            "1000 sections are never used: `s0`, `s1`, `s2` and 997 more",
        ]
    );
    // A chain that nothing uses does not matter.
    let model = document.model(&[]).unwrap();
    assert!((0..1000).all(|parameter| !model.depends_on(parameter)));
}

#[test]
fn parameters_matter_that_something_uses_through_others() {
    let text = format!(
        "format = 1\n[parameter]\na = \"1 N\"\nb = \"2*a\"\nc = \"3 N\"\nd = \"c\"\nn = 2\nx = 1\n{REST}
[load.\"push_{{i}}\"]\nrepeat = {{ i = \"n\" }}\nbeam = \"wire\"\nat = 1\nforce = [0, 0, \"b\"]\n"
    );
    let document = Document::parse(&text, "x.toml").unwrap();
    assert_eq!(document.parameter_names(), ["a", "b", "c", "d", "n", "x"]);
    let matter = |overrides: &[(String, String)]| -> Vec<bool> {
        let model = document.model(overrides).unwrap();
        (0..6).map(|parameter| model.depends_on(parameter)).collect()
    };
    assert_eq!(matter(&[]), [true, true, false, false, true, false]);
    // An override may bring in another one, in place of that by which it was written.
    let set = [("b".to_string(), "2*d".to_string())];
    assert_eq!(matter(&set), [false, true, true, true, true, false]);
}

#[test]
fn the_time_of_many_names_grows_with_their_number() {
    let time = |count: usize| {
        let text = text(count);
        let start = Instant::now();
        let document = Document::parse(&text, "x.toml").unwrap();
        document.model(&[]).unwrap_or_else(|report| panic!("{report}"));
        assert!(!document.warnings().is_empty());
        start.elapsed().as_secs_f64()
    };
    // Eight times as many: 64 times as long if every name were compared with every other. The best of two, as other work
    // on the machine may take its time.
    let best = |count: usize| time(count).min(time(count));
    let (few, many) = (best(2_500), best(20_000));
    assert!(many < 24.0 * few.max(1e-3), "{few} s for 2,500 names of each kind, {many} s for 20,000");
}
