//! Paths: the diagram of the outputs, and the shapes along it.

use super::states::{scene_of, solution};
use super::{Make, components, list, model_of, number, text};
use crate::read::{ReadError, status_of};
use crate::scene::SceneDocument;
use crate::{TraceView, diagram_svg, shapes_svg};
use flexura_model::{Model, TraceStudy};
use flexura_solution::{
    Branch, BranchEnd, BranchOrigin, Crossing, PointKind, Solution, Trace, TracePoint, TraceWork,
};
use serde_json::Value;

pub fn trace(document: &Value, make: &mut Make<'_>) -> Result<Vec<String>, ReadError> {
    let model = model_of(document, &[], make)?;
    let name = text(document, "parameter");
    let Some(parameter) = model.parameters.iter().position(|own| own.name == name) else {
        return Err(ReadError::OtherMechanism(format!("its parameter `{name}` is not in the model file")));
    };
    let range = list(document, "range");
    let range = [0, 1].map(|i| range.get(i).and_then(Value::as_f64).unwrap_or(f64::NAN));
    let scene = scene_of(document)?;
    let mut points = Points { document, model: &model, scene, name };
    let branches = list(document, "branches").iter().map(|branch| points.branch(branch, make));
    let trace = Trace {
        parameter,
        range,
        status: status_of(text(document, "status"))?,
        reason: None,
        warnings: Vec::new(),
        stability_reason: None,
        branches: branches.collect::<Result<_, _>>()?,
        critical: None,
        work: TraceWork::default(),
    };
    let study = TraceStudy { parameter, range, ..TraceStudy::default() };
    let view = TraceView::new(&model, &study, &trace);
    Ok(vec![diagram_svg(&view), shapes_svg(&view)])
}

struct Points<'d> {
    document: &'d Value,
    model: &'d Model,
    scene: SceneDocument,
    name: &'d str,
}

impl Points<'_> {
    fn branch(&mut self, branch: &Value, make: &mut Make<'_>) -> Result<Branch, ReadError> {
        let from = |key: &str| branch.get(key).and_then(Value::as_u64).map(|i| i as usize);
        let origin = match (text(branch, "origin"), from("from_branch"), from("from_point")) {
            ("branch_point", Some(branch), Some(point)) => BranchOrigin::Switched { branch, point },
            ("search", ..) => BranchOrigin::Search,
            ("imperfection", ..) => BranchOrigin::Imperfection,
            _ => BranchOrigin::Rest,
        };
        let ends = list(branch, "ends");
        let end = |i: usize| end(ends.get(i).and_then(Value::as_str).unwrap_or_default());
        let points = list(branch, "points").iter().map(|point| self.point(point, make));
        Ok(Branch { origin, points: points.collect::<Result<_, _>>()?, ends: [end(0), end(1)] })
    }

    fn point(&self, point: &Value, make: &mut Make<'_>) -> Result<TracePoint, ReadError> {
        let parameter = number(point, "parameter");
        let is_kept = point.get("bodies").is_some();
        let outputs =
            self.model.outputs.iter().map(|output| components(&point["outputs"][output.name.as_str()]));
        Ok(TracePoint {
            parameter,
            arc: number(point, "arc"),
            kind: kind(point),
            outputs: outputs.collect(),
            output_reasons: Vec::new(),
            error_estimate: number(point, "error_estimate"),
            stable: point.get("stable").and_then(Value::as_bool),
            unstable_directions: None,
            solution: if is_kept { Some(Box::new(self.state(point, parameter, make)?)) } else { None },
            shape: None,
            directions: Vec::new(),
        })
    }

    /// Where the parameter changes more than loads, a point has a scene and a model of its own.
    fn state(&self, point: &Value, value: f64, make: &mut Make<'_>) -> Result<Solution, ReadError> {
        if point.get("scene").is_none() {
            return solution(point, self.scene.clone(), self.model);
        }
        let model = model_of(self.document, &[(self.name.to_owned(), value)], make)?;
        solution(point, scene_of(point)?, &model)
    }
}

fn end(word: &str) -> BranchEnd {
    match word {
        "range" => BranchEnd::Range,
        "stop" => BranchEnd::Stop,
        "closed" => BranchEnd::Closed,
        "point_limit" => BranchEnd::PointLimit,
        "stalled" => BranchEnd::Stalled(String::new()),
        "interrupted" => BranchEnd::Interrupted,
        _ => BranchEnd::Start,
    }
}

fn kind(point: &Value) -> PointKind {
    match text(point, "kind") {
        "fold" => PointKind::Fold,
        "branch" => PointKind::Branch(match text(point, "crossing") {
            "supercritical_pitchfork" => Crossing::SupercriticalPitchfork,
            "subcritical_pitchfork" => Crossing::SubcriticalPitchfork,
            "transcritical" => Crossing::Transcritical,
            "multiple" => Crossing::Multiple(2),
            _ => Crossing::Pitchfork,
        }),
        "event" => PointKind::Event(0),
        "end" => PointKind::End,
        _ => PointKind::Regular,
    }
}
