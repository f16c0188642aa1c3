//! Fitted laws: the slide of the pushed strip (5.5), where a heavier sensor needs less, and moduli of bones from bending tests.

use super::Fact;
use flexura::modelfile::Document;
use flexura::{Options, fit, formula};
use flexura_model::{Model, StudyKind};
use flexura_testkit::slide_law::{Cubic, slides, spread};
use flexura_testkit::slope::turning_slope;
use std::f64::consts::PI;

const STRIP: &str = include_str!("../../../../models/strip_on_slope.toml");
const BONES: &str = include_str!("../../../../models/bone_bending.toml");
/// The sensor's weight in Table 5.2, π²EI/4L².
const WEIGHT: f64 = 0.8;
const SLOPES: [f64; 3] = [0.0, 0.25 * PI, 0.5 * PI];

pub(super) fn facts() -> Result<Vec<Fact>, String> {
    let mut facts = Vec::new();
    cubics(&mut facts)?;
    turning(&mut facts)?;
    bones(&mut facts)?;
    Ok(facts)
}

/// A bundled model with its studies, which [`crate::file::File`] leaves out.
fn with_studies(text: &str) -> Result<Model, String> {
    let model = Document::parse(text, "model.toml").and_then(|document| document.model(&[]));
    model.map_err(|report| report.render(false))
}

/// The band of all slopes at a few deflections, the cubic over 39 of them, and that of the model's own study.
fn cubics(facts: &mut Vec<Fact>) -> Result<(), String> {
    let exact = |middles: &[f64]| slides(WEIGHT, middles, &SLOPES).map_err(|error| format!("{error:?}"));
    for middle in [0.1, 0.3, 0.39] {
        facts.push((format!("band {middle}"), spread(&exact(&[middle])?)));
    }
    let middles: Vec<f64> = (1..=39).map(|i| 0.01 * f64::from(i)).collect();
    let rows = exact(&middles)?;
    let cubic = Cubic::fit(&middles, &rows).ok_or("no cubic fits")?;
    facts.extend((1..).zip(cubic.coefficients).map(|(power, c)| (format!("cubic w^{power}"), c)));
    facts.push(("size of cubic w^1".into(), cubic.coefficients[0].abs()));
    facts.push(("cubic error".into(), cubic.error(&middles, &rows)));

    let model = with_studies(STRIP)?;
    let study = model.studies.iter().find_map(|study| match &study.kind {
        StudyKind::Formula(study) => Some(study.clone()),
        _ => None,
    });
    let law = formula(&model, &study.ok_or("no formula")?, &Options::default(), &mut |_| {})
        .map_err(|error| error.to_string())?;
    let piece = law.pieces.first().ok_or("no piece")?;
    // Downwards its deflection is negative.
    let signs = [-1.0, 1.0, -1.0];
    let terms = (1..).zip(piece.coefficients.iter().zip(signs));
    facts.extend(terms.map(|(power, (c, sign))| (format!("formula w^{power}"), sign * c)));
    facts.push(("formula error".into(), law.largest.0));
    facts.push(("formula R2".into(), law.r_squared.unwrap_or(f64::NAN)));
    Ok(())
}

/// The slopes on which a little more weight neither raises nor lowers the fold.
fn turning(facts: &mut Vec<Fact>) -> Result<(), String> {
    for weight in [WEIGHT, 2.0 * WEIGHT] {
        let slope = turning_slope(weight, [60.0, 85.0].map(f64::to_radians));
        let slope = slope.ok_or_else(|| format!("no turning slope of the weight {weight}"))?;
        facts.push((format!("turning {weight}"), slope.to_degrees()));
    }
    Ok(())
}

/// 4.2.1: mean and deviation of Young's modulus over the made-up bones, GPa.
fn bones(facts: &mut Vec<Fact>) -> Result<(), String> {
    let model = with_studies(BONES)?;
    let study = model.studies.iter().find_map(|study| match &study.kind {
        StudyKind::Fit(study) => Some(study.clone()),
        _ => None,
    });
    let (fitted, _) =
        fit(&model, &study.ok_or("no fit")?, &Options::default()).map_err(|error| error.to_string())?;
    let spread = fitted.spread.first().ok_or("no spread")?;
    facts.push(("bones mean".into(), 1e-9 * spread.mean));
    facts.push(("bones deviation".into(), 1e-9 * spread.deviation));
    Ok(())
}
