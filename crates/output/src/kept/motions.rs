//! Motions in time: the parameter and the outputs over time.

use super::states::solution;
use super::{Make, components, list, model_of, number, text};
use crate::read::{ReadError, status_of};
use crate::scene::SceneDocument;
use crate::{MotionView, motion_svg};
use flexura_solution::{Instant, InverseDynamics, MotionWork};
use serde_json::{Map, Value, json};

pub fn motion(document: &Value, make: &mut Make<'_>) -> Result<Vec<String>, ReadError> {
    let model = model_of(document, &[], make)?;
    let name = text(document, "parameter");
    let Some(parameter) = model.parameters.iter().position(|own| own.name == name) else {
        return Err(ReadError::OtherMechanism(format!("its parameter `{name}` is not in the model file")));
    };
    let times = list(document, "times");
    let at = |key: &str, i: usize| list(document, key).get(i).and_then(Value::as_f64).unwrap_or(f64::NAN);
    let instant = |i: usize| -> Result<Instant, ReadError> {
        let outputs = model
            .outputs
            .iter()
            .map(|output| list(&document["outputs"], &output.name).get(i).and_then(components));
        Ok(Instant {
            time: at("times", i),
            value: at("value", i),
            rate: at("rate", i),
            acceleration: at("acceleration", i),
            outputs: outputs.collect(),
            output_reasons: Vec::new(),
            state: solution(&state(document, i, times.len()), SceneDocument::default(), &model)?,
            drive_power: at("drive_power", i),
            gravity_power: at("gravity_power", i),
            kinetic_energy: at("kinetic_energy", i),
        })
    };
    let motion = InverseDynamics {
        parameter,
        status: status_of(text(document, "status"))?,
        reason: None,
        warnings: Vec::new(),
        instants: (0..times.len()).map(instant).collect::<Result<_, _>>()?,
        error_estimate: number(document, "error_estimate"),
        work: MotionWork::default(),
    };
    Ok(vec![motion_svg(&MotionView { model: &model, motion: &motion })])
}

/// Bodies and joints at one of so many times; what moves in time is made of nothing else.
fn state(document: &Value, i: usize, count: usize) -> Value {
    let at = |kind: &str, keys: &[&str]| -> Value {
        let all = document.get(kind).and_then(Value::as_object).into_iter().flatten();
        let one = |series: &Value| -> Map<String, Value> {
            let lists = keys.iter().map(|key| (*key, list(series, key)));
            let there = lists.filter(|(_, list)| list.len() == count);
            there.map(|(key, list)| (key.to_owned(), list[i].clone())).collect()
        };
        all.map(|(name, series)| (name.clone(), Value::Object(one(series)))).collect::<Map<_, _>>().into()
    };
    json!({
        "beams": {},
        "bodies": at("bodies", &["position", "rotation"]),
        "joints": at("joints", &["coordinates", "efforts", "force", "moment"]),
        "energy": 0.0,
    })
}
