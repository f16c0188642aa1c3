//! Sweeps: the samples by their columns.

use super::{components, list, text};
use crate::read::ReadError;
use crate::{Named, SampleColumn, SweepView, sweep_svg};
use serde::Deserialize;
use serde_json::Value;

/// The names in a sweep, in their order.
#[derive(Deserialize)]
pub struct Names {
    vary: Named<Value>,
    samples: Vec<SampleNames>,
}

#[derive(Deserialize)]
struct SampleNames {
    unknowns: Option<Named<Value>>,
    outputs: Named<Value>,
}

pub fn sweep(document: &Value, names: &Names) -> Result<Vec<String>, ReadError> {
    let samples = list(document, "samples");
    let unit = |kind: &str, name: &str| text(&document["scene"]["units"][kind], name).to_owned();
    let column = |name: String, unit: String, value: &dyn Fn(&Value) -> Option<f64>| SampleColumn {
        name,
        unit,
        values: samples.iter().map(value).collect(),
    };
    let mut varied = Vec::new();
    for (name, _) in &names.vary.0 {
        let unit = unit("parameters", name);
        varied.push(column(name.clone(), unit, &|sample| sample["parameters"][name.as_str()].as_f64()));
    }
    let mut found = Vec::new();
    let unknowns = names.samples.iter().find_map(|sample| sample.unknowns.as_ref());
    for (name, _) in unknowns.into_iter().flat_map(|list| &list.0) {
        let value = |sample: &Value| sample["unknowns"][name.as_str()].as_f64();
        found.push(column(name.clone(), unit("parameters", name), &value));
    }
    for (name, _) in names.samples.first().into_iter().flat_map(|sample| &sample.outputs.0) {
        let value = |sample: &Value| components(&sample["outputs"][name.as_str()]);
        let width = samples.iter().find_map(value).map_or(0, |components| components.len());
        for k in 0..width {
            let shown = if width == 3 { format!("{name}.{}", ["x", "y", "z"][k]) } else { name.clone() };
            found.push(column(shown, unit("outputs", name), &|sample| value(sample)?.get(k).copied()));
        }
    }
    if found.is_empty() {
        found.push(column("strain energy".to_owned(), "J".to_owned(), &|sample| sample["energy"].as_f64()));
    }
    let failed = samples.iter().filter(|sample| text(sample, "status") != "converged").count();
    let view = SweepView { model: text(document, "model"), varied, found, failed };
    Ok(vec![sweep_svg(&view)])
}
