use super::*;
use crate::*;
use nalgebra::Vector3;

/// A strip whose length, width, load and frame hang on parameters, written in code.
fn model() -> Model {
    let mut model = Model::default();
    model.sections.push(Section {
        name: "leaf".into(),
        shape: Shape::Rectangle { width: 0.02.into(), height: 0.5e-3.into() },
        plane_strain: false,
    });
    model.materials.push(Material {
        name: "steel".into(),
        young: 2e11,
        shear: 8e10,
        density: None,
        yield_strength: None,
    });
    model.beams.push(Beam {
        name: "link".into(),
        material: Some(MaterialId(0)),
        section: SectionId(0),
        curve: Curve::Straight { length: 0.1 },
        frame: SectionFrame::Natural,
        theory: BeamTheory::default(),
        damping: 0.0,
        added_mass: 0.0,
        start: Some(End { mount: Mount::Ground, placement: None, hold: JointLaw::weld() }),
        end: None,
        distributed: Vec::new(),
        foundation: Vec::new(),
    });
    model.loads.push(Load {
        name: "tip".into(),
        target: LoadTarget::Beam(BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) }),
        force: Vector3::new(0.0, 1.0, 0.0),
        moment: Vector3::zeros(),
        frame: LoadFrame::Global,
    });
    model.add_parameter("reach", 0.1, "m");
    model.add_parameter("push", 3.0, "N");
    model.add_formula("double", "2*reach + 10 mm", "m").unwrap();
    model.bind("beam.link.length", "double/2").unwrap();
    model.bind("section.leaf.width", "reach^2/(50 mm)").unwrap();
    model.bind("load.tip.force[1]", "push*cos(reach/(1 m))").unwrap();
    model
}

fn length(model: &Model) -> f64 {
    match model.beams[0].curve {
        Curve::Straight { length } => length,
        _ => f64::NAN,
    }
}

#[test]
fn numbers_follow_their_parameters_and_those_that_write_them() {
    let model = model();
    assert!((length(&model) - 0.105).abs() < 1e-16);
    let other = model.at(&[(0, 0.2)]).unwrap();
    assert!((other.parameters[2].value - 0.41).abs() < 1e-16);
    assert!((length(&other) - 0.205).abs() < 1e-16);
    assert!((other.loads[0].force.y - 3.0 * 0.2_f64.cos()).abs() < 1e-15);
    // What is given a value is no longer written by others.
    let pinned = model.at(&[(2, 0.5)]).unwrap().at(&[(0, 0.3)]).unwrap();
    assert_eq!((pinned.parameters[2].value, length(&pinned)), (0.5, 0.25));
    assert_eq!(model.validate(), []);
}

#[test]
fn parts_that_are_added_or_renamed_leave_the_others_their_rules() {
    let mut model = model();
    let mut first = model.beams[0].clone();
    first.name = "before".into();
    model.beams.insert(0, first);
    let other = model.at(&[(0, 0.2)]).unwrap();
    assert!((length(&other) - 0.105).abs() < 1e-16, "the new one has no rule");
    assert!(matches!(other.beams[1].curve, Curve::Straight { length } if (length - 0.205).abs() < 1e-16));
    model.unbind("beam.link.length");
    let loose = model.at(&[(0, 0.2)]).unwrap();
    assert!(matches!(loose.beams[1].curve, Curve::Straight { length } if (length - 0.105).abs() < 1e-16));
}

#[test]
fn what_cannot_be_bound_is_told() {
    let mut model = model();
    let told = |issue: Issue| format!("{}: {}", issue.path, issue.message);
    assert_eq!(
        told(model.bind("beam.link.lenght", "reach").unwrap_err()),
        "beam.link.lenght: there is no number here that a formula could give"
    );
    assert_eq!(
        told(model.bind("beam.link.length", "rech").unwrap_err()),
        "beam.link.length: there is no parameter `rech`"
    );
    assert_eq!(
        told(model.add_formula("new", "2*(reach", "").unwrap_err()).split(':').next(),
        Some("parameter.new")
    );
    assert_eq!(
        told(model.bind("beam.link.length", "reach*ln(0 - push/(1 N))").unwrap_err()),
        "beam.link.length: the expression gives no finite number"
    );
    assert_eq!(told(model.at(&[(7, 1.0)]).unwrap_err()), "parameter: there is no parameter 7");
}

#[test]
fn rates_are_those_of_the_formulas() {
    let model = model();
    assert_eq!(model.parameter_rates(0), [1.0, 0.0, 2.0]);
    assert!(model.depends_on(0) && model.depends_on(1) && model.depends_on(2));
    let moved = |parameter| -> Vec<String> {
        model.moved_by(parameter).unwrap().iter().map(|binding| binding.path.to_string()).collect()
    };
    assert_eq!(moved(0), ["section.leaf.width", "beam.link.length", "load.tip.force[1]"]);
    assert_eq!(moved(1), ["load.tip.force[1]"]);
    assert!(model.is_linear_in(1) && model.is_linear_in(2) && !model.is_linear_in(0));
    // Exact derivatives: of push cos(reach) by reach at 0.1 and 3.
    let Rule::Number(formula) = &*model.bindings.iter().last().unwrap().rule else { panic!("a number") };
    let slots: Vec<f64> = model.parameters.iter().map(|parameter| parameter.value).collect();
    let [value, first, second, third] = formula.along(&slots, &model.parameter_rates(0));
    let (sin, cos) = 0.1_f64.sin_cos();
    for (found, exact) in [(value, 3.0 * cos), (first, -3.0 * sin), (second, -3.0 * cos), (third, 3.0 * sin)]
    {
        assert!((found - exact).abs() < 1e-15, "{found} for {exact}");
    }
}
