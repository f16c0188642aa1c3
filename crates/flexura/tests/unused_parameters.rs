//! Parameters that nothing uses.
#![allow(clippy::unwrap_used)]

use flexura::modelfile::Document;
use flexura::{Options, solve_model};
use std::path::Path;

#[test]
fn parameters_that_nothing_uses_have_no_derivative_and_take_no_time() {
    let mut text =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/elastica.toml"))
            .unwrap();
    let many: String = (0..1000).map(|i| format!("spare_{i} = \"{i} mm\"\n")).collect();
    text = text.replacen("[parameter]\n", &format!("[parameter]\n{many}"), 1);
    let document = Document::parse(&text, "many.toml").unwrap();
    let model = document.model(&[]).unwrap();
    let options = Options { sensitivities: true, ..Options::default() };
    let start = std::time::Instant::now();
    let (solution, model) = solve_model(&model, &options, &mut |_| {}).unwrap();
    // Trying out every parameter makes 60 models of each, which took half a minute.
    assert!(start.elapsed().as_secs_f64() < 10.0, "{:?}", start.elapsed());
    let derivatives = solution.sensitivities.unwrap();
    assert_eq!(derivatives.parameters.len(), model.parameters.len());
    for components in &derivatives.outputs {
        for component in components {
            for (position, derivative) in derivatives.parameters.iter().zip(component) {
                let is_spare = model.parameters[*position].name.starts_with("spare_");
                assert!(*derivative == Some(0.0) || !is_spare, "{}", model.parameters[*position].name);
            }
        }
    }
    let force = model.parameters.iter().position(|parameter| parameter.name == "force").unwrap();
    assert!(derivatives.outputs.iter().flatten().any(|component| component[force] != Some(0.0)));
}
