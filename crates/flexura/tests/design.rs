//! Design optimisation against closed forms, published optima and brute force.

#![allow(clippy::unwrap_used)]

use flexura::model::{Model, StudyKind};
use flexura::modelfile::{Document, to_toml};
use flexura::solution::{Bound, Design, PointKind, Status};
use flexura::{Error, Optimised, Options, optimise_file, solve_model, trace};

fn models(name: &str) -> String {
    format!("{}/../../models/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn found(name: &str, study: &str) -> Optimised {
    optimise_file(models(name), &[], Some(study), &Options::default()).unwrap()
}

/// A model of the repository with a study in place of its own, or behind them.
fn with_study(name: &str, study: &str) -> Result<Optimised, String> {
    let text = std::fs::read_to_string(models(name)).unwrap();
    let text = text.split("[study.light]").next().unwrap();
    let model = Document::parse(&format!("{text}\n{study}"), name).unwrap().model(&[]).unwrap();
    let StudyKind::Optimise(study) = model.studies.last().unwrap().kind.clone() else { panic!("no study") };
    Optimised::new(&model, &study, &Options::default(), &mut |_| {}).map_err(|error| error.message)
}

/// A study over parameters alone, beside a cantilever that they do not move.
fn of_formula(parameters: &str, study: &str) -> Optimised {
    let text = format!(
        r#"
format = 1
[parameter]
{parameters}
[section.rod]
shape = "stiffness"
EA = inf
GJ = 1
EI2 = 1
EI3 = 1
[beam.rod]
section = "rod"
length = 1
start = {{ body = "ground", hold = "clamp" }}
[study.best]
kind = "optimise"
{study}
"#
    );
    let model = Document::parse(&text, "formula.toml").unwrap().model(&[]).unwrap();
    let StudyKind::Optimise(study) = model.studies[0].kind.clone() else { panic!("no study") };
    Optimised::new(&model, &study, &Options::default(), &mut |_| {}).unwrap()
}

fn best(optimised: &Optimised) -> &Design {
    assert_eq!(optimised.result.status, Status::Converged, "{:?}", optimised.result.reason);
    optimised.result.best.as_ref().unwrap()
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} against {b}");
}

/// h = (4 F L³/(E b w))^(1/3), and dm/dw = -m/(3w).
#[test]
fn the_lightest_cantilever_is_that_of_small_deflections() {
    let optimised = found("lightest_cantilever", "light");
    let thickness = (4.0 * 0.125 * 0.2_f64.powi(3) / (200e9 * 0.02 * 1e-4)).cbrt();
    let mass = 7800.0 * 0.02 * 0.2 * thickness;
    let best = best(&optimised);
    close(best.values[0], thickness, 1e-6);
    close(best.objective, mass, 1e-6);
    let active = best.active.iter().find(|active| active.what == Bound::Most(0)).unwrap();
    close(active.rate, -mass / (3.0 * 1e-4), 1e-5);
    assert!(optimised.result.solution.as_ref().unwrap().status == Status::Converged);
}

/// m³ w = (ρ b L)³ 4 F L³/(E b) on the whole front, whose points are evenly spaced in w.
#[test]
fn the_front_of_mass_and_sag_has_the_product_of_small_deflections() {
    let optimised = found("lightest_cantilever", "front");
    best(&optimised);
    let front = &optimised.result.front;
    assert_eq!(front.len(), 9);
    let product = (7800.0_f64 * 0.02 * 0.2).powi(3) * 4.0 * 0.125 * 0.2_f64.powi(3) / (200e9 * 0.02);
    for point in front {
        // The theory neglects (w/L)² beside one.
        let neglected = 2.0 * (point.other.unwrap() / 0.2).powi(2);
        close(point.objective.powi(3) * point.other.unwrap(), product, 1e-6 + neglected);
    }
    let sag = |i: usize| front[i].other.unwrap();
    for i in 1..9 {
        close(sag(i), sag(0) + (sag(8) - sag(0)) * i as f64 / 8.0, 1e-6);
    }
    close(front[0].values[0], 1e-3, 1e-9);
    close(front[8].values[0], 6e-3, 1e-6);
}

/// Problem 71 of W. Hock and K. Schittkowski, Test Examples for Nonlinear Programming Codes, 1981.
#[test]
fn a_published_problem_has_its_published_optimum() {
    let range = |name: &str, guess: f64| format!("{name} = {{ range = [1, 5], guess = {guess} }}");
    let vary = [range("a", 1.0), range("b", 5.0), range("c", 5.0), range("d", 1.0)].join(", ");
    let study = format!(
        "minimise = \"a*d*(a + b + c) + c\"\nvary = {{ {vary} }}\nconstraints = [\
         {{ output = \"a*b*c*d\", least = 25 }}, {{ output = \"a^2 + b^2 + c^2 + d^2\", equals = 40 }}]"
    );
    let optimised = of_formula("a = 1\nb = 5\nc = 5\nd = 1", &study);
    let best = best(&optimised);
    for (own, published) in best.values.iter().zip([1.0, 4.7429994, 3.8211503, 1.3794082]) {
        close(*own, published, 1e-6);
    }
    close(best.objective, 17.0140173, 1e-8);
}

const ROUGH: &str = "minimise = \"(a - 0.3)^2 + (b - 0.2)^2 - 0.2*cos(20*(a - 0.3)) - 0.2*cos(20*(b - 0.2))\"\n\
                     vary = { a = { range = [-1, 1] }, b = { range = [-1, 1] } }\n";

/// The waves have a minimum about every 0.31; the lowest is (0.3, 0.2), where the objective is -0.4.
#[test]
fn many_starts_and_evolution_find_the_lowest_of_many_minima() {
    let one = of_formula("a = -0.9\nb = 0.9", ROUGH);
    assert!(best(&one).objective > -0.39, "the first start already finds the lowest");
    for further in ["starts = 100", "method = \"cma_es\"\nseed = 3"] {
        let optimised = of_formula("a = -0.9\nb = 0.9", &format!("{ROUGH}{further}"));
        let best = best(&optimised);
        assert!((best.values[0] - 0.3).abs() < 1e-6 && (best.values[1] - 0.2).abs() < 1e-6, "{best:?}");
        close(best.objective, -0.4, 1e-9);
    }
}

/// Even the thickest strip sags by more than is asked for: the design that misses it least is that one.
#[test]
fn a_constraint_that_nothing_meets_is_told_with_the_least_miss() {
    let optimised = with_study(
        "lightest_cantilever",
        "[study.light]\nkind = \"optimise\"\nminimise = \"model.mass\"\nstarts = 3\n\
         vary = { thickness = { range = [\"0.5 mm\", \"6 mm\"] } }\n\
         constraints = [{ output = \"sag\", most = \"1 um\" }]\n",
    );
    let result = optimised.unwrap().result;
    assert_eq!(result.status, Status::Infeasible);
    let reason = result.reason.unwrap();
    assert!(reason.contains("none of the searches") && reason.contains("`output.sag`"), "{reason}");
    let nearest = result.best.unwrap();
    close(nearest.values[0], 6e-3, 1e-9);
    let sag = 4.0 * 0.125 * 0.2_f64.powi(3) / (200e9 * 0.02 * 6e-3_f64.powi(3));
    close(nearest.violation, (sag - 1e-6) / 1e-6, 1e-5);
}

#[test]
fn an_objective_that_nothing_changes_is_refused() {
    let refused = with_study(
        "lightest_cantilever",
        "[study.light]\nkind = \"optimise\"\nminimise = \"beam.strip.start.position.x + 1 m\"\n\
         vary = { thickness = { range = [\"0.5 mm\", \"6 mm\"] } }\n",
    );
    assert_eq!(refused.unwrap_err(), "the objective depends on no parameter that may change");
}

/// The fold load of a frame goes with Young's modulus; Lee, Manuel and Rossow (1968) have 1.85567 at 720.
#[test]
fn a_wanted_fold_load_takes_its_part_of_the_modulus() {
    let study = "[study.snap]\nkind = \"trace\"\nparameter = \"load\"\nrange = [0, 4]\n\
                 [study.light]\nkind = \"optimise\"\nminimise = \"young\"\nvary = { young = { range = [500, 1500] } }\n\
                 constraints = [{ output = \"load\", over = \"snap\", point = \"fold 1\", least = 2.5 }]\n";
    let optimised = with_study("lee_frame", study).unwrap();
    let best = best(&optimised);
    close(best.values[0], 720.0 * 2.5 / 1.85567, 3e-6);
    // d young / d load = young/load.
    let active = best.active.iter().find(|active| active.what == Bound::Least(0)).unwrap();
    close(active.rate, best.values[0] / 2.5, 1e-6);
}

#[test]
fn the_model_at_the_optimum_reads_back_with_its_study() {
    let optimised = found("lightest_cantilever", "light");
    let model =
        Document::parse(&to_toml(&optimised.model).unwrap(), "best.toml").unwrap().model(&[]).unwrap();
    assert_eq!(model.parameters[0].value, optimised.value("thickness").unwrap());
    let StudyKind::Optimise(again) = &model.studies[0].kind else { panic!("no study") };
    let again = Optimised::new(&model, again, &Options::default(), &mut |_| {}).unwrap();
    close(best(&again).objective, best(&optimised).objective, 1e-9);
}

#[test]
fn a_study_that_is_not_there_is_told() {
    let missing = optimise_file(models("lee_frame"), &[], None, &Options::default()).unwrap_err();
    assert!(missing.to_string().contains("the file has no study of the kind `optimise`"), "{missing}");
    let other = optimise_file(models("lee_frame"), &[], Some("path"), &Options::default()).unwrap_err();
    assert!(matches!(other, Error::File(_)) && other.to_string().contains("not of the kind"), "{other}");
}

fn read(name: &str) -> Model {
    Document::read(models(name)).unwrap().model(&[]).unwrap()
}

/// Outputs of an equilibrium reached from rest; None where there is none or it is unstable.
fn outputs(model: &Model, values: &[(&str, f64)]) -> Option<Vec<f64>> {
    let values: Vec<(usize, f64)> =
        values.iter().map(|(name, value)| (model.parameter(name).unwrap(), *value)).collect();
    let (solution, model) = solve_model(&model.at(&values).ok()?, &Options::default(), &mut |_| {}).ok()?;
    if solution.status != Status::Converged || solution.stable == Some(false) {
        return None;
    }
    let values = flexura::post::output_values(&model, &solution).outputs;
    values.into_iter().map(|value| value.map(|value| value[0])).collect()
}

/// Where a function changes from negative to positive.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..15 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// By brute force: for each thickness of a grid the travel that presses with 2 N, and of the safety there the first thickness from below
/// that has enough, by bisection between two of the grid.
#[test]
fn the_thinnest_clamp_is_that_of_a_grid() {
    let optimised = found("thinnest_clamp", "thin");
    let best = best(&optimised);
    let model = read("thinnest_clamp");
    let safety = |thickness: f64| {
        let at = |travel: f64| outputs(&model, &[("thickness", thickness), ("travel", travel)]);
        let travel = root(5e-3, 12e-3, |travel| at(travel).map_or(f64::NAN, |values| values[0] - 2.0));
        at(travel).map_or((-1.0, travel), |values| (values[1] - 3.0, travel))
    };
    let grid: Vec<f64> = (0..10).map(|i| 0.13e-3 + 0.005e-3 * f64::from(i)).collect();
    let first = grid.iter().position(|thickness| safety(*thickness).0 >= 0.0).unwrap();
    let thickness = root(grid[first - 1], grid[first], |thickness| safety(thickness).0);
    close(best.values[0], thickness, 1e-4);
    close(best.values[1], safety(thickness).1, 1e-4);
    assert_eq!(best.stable, Some(true));
    // What was refused on the way is told with its values and its reason.
    let result = &optimised.result;
    assert!(result.left_out_count > 0 && result.left_out.iter().all(|left| left.reason.contains("unstable")));
}

/// By brute force: for each circle of a grid the largest tilt at which no rod is stressed by more than 500 MPa, by bisection, and of
/// these the largest, on a grid that is refined four times.
#[test]
fn the_largest_tilt_is_that_of_a_grid() {
    let optimised = found("robot_tilt", "tilt");
    let best = best(&optimised);
    let model = read("robot_tilt");
    let tilt = |circle: f64| {
        root(0.3, 0.42, |tilt| {
            let stresses = outputs(&model, &[("tilt", tilt), ("circle", circle)]).unwrap();
            stresses.iter().fold(0.0_f64, |most, stress| most.max(*stress)) - 500e6
        })
    };
    let (mut middle, mut width) = (0.09, 0.02);
    let mut most = 0.0;
    for _ in 0..4 {
        let grid = (0..=6).map(|i| middle + width * (f64::from(i) - 3.0) / 6.0);
        (middle, most) =
            grid.map(|circle| (circle, tilt(circle))).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        width /= 4.0;
    }
    close(best.objective, most, 1e-4);
    close(best.values[1], middle, 2e-3);
}

/// By brute force: both constraints hold the optimum, so both parameters follow from the two forces, on paths with several times the
/// points, by another method.
#[test]
fn the_gentlest_bistable_beam_is_where_both_forces_are_met() {
    let optimised = found("bistable_design", "gentle");
    let best = best(&optimised);
    let model = read("bistable_design");
    let StudyKind::Trace(mut study) = model.studies[0].kind.clone() else { panic!("no path") };
    study.steps = 150;
    let tops = |thickness: f64, slope: f64| -> [f64; 3] {
        let at = |name: &str| model.parameter(name).unwrap();
        let model = model.at(&[(at("thickness"), thickness), (at("slope"), slope)]).unwrap();
        let trace = trace(&model, &study, &Options::default(), &mut |_| {}).unwrap();
        let points = &trace.branches[0].points;
        let regular = points.iter().filter(|point| point.kind != PointKind::Fold);
        let rows: Vec<(f64, f64, f64)> = regular
            .map(|point| {
                let value = |i: usize| point.outputs[i].as_ref().unwrap()[0];
                (point.parameter, value(0), value(1))
            })
            .collect();
        let top = |pick: fn(&(f64, f64, f64)) -> f64| {
            let places: Vec<f64> = rows.iter().map(|row| row.0).collect();
            flexura::post::peak_between(&places, &rows.iter().map(pick).collect::<Vec<_>>())
        };
        [top(|row| row.1), -top(|row| -row.1), top(|row| row.2)]
    };
    // Newton's method on both forces, with differences.
    let mut at = [0.72e-3, 0.08];
    for _ in 0..4 {
        let miss = |at: [f64; 2]| {
            let tops = tops(at[0], at[1]);
            [tops[0] - 0.5, tops[1] + 0.1]
        };
        let h = [1e-3 * at[0], 1e-3 * at[1]];
        let (here, by_t, by_s) = (miss(at), miss([at[0] + h[0], at[1]]), miss([at[0], at[1] + h[1]]));
        let [a, c] = [0, 1].map(|i| (by_t[i] - here[i]) / h[0]);
        let [b, d] = [0, 1].map(|i| (by_s[i] - here[i]) / h[1]);
        let determinant = a * d - b * c;
        at[0] -= (d * here[0] - b * here[1]) / determinant;
        at[1] -= (a * here[1] - c * here[0]) / determinant;
    }
    close(best.values[0], at[0], 1e-4);
    close(best.values[1], at[1], 1e-4);
    close(best.objective, tops(at[0], at[1])[2], 1e-4);
    // Steeper leaves of the same snap force are stressed more.
    assert!(best.active.iter().any(|active| active.what == Bound::Most(1) && active.rate < 0.0));
}
