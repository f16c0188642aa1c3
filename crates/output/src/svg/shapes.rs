//! `shapes.svg`: the mechanism's shapes along a path, coloured along the parameter, or the shapes in which it buckles.

use super::axis::{Axis, shown};
use super::canvas::{Canvas, Style};
use super::diagram::{Mark, title};
use super::gradient::{BAR, draw_bar, gradient};
use super::layout::{LEGEND_LINE, Panel, Sheet};
use super::scene::{Knot, Scene};
use super::{COLOURS, FAINT, INK, LONG_NAME, draw_axes, marks, pieces, shortened, subtitle};
use crate::trace::{TraceView, parameter_of};
use flexura_model::Model;
use flexura_solution::{Buckling, Direction, ModeKind, Modes, Solution, Status};
use flexura_spatial::{Pose, Twist, Vector3, exp};
use std::f64::consts::TAU;

/// Shapes between the special ones that are drawn at most.
const MOST: usize = 40;
/// The largest displacement of a mode, as a part of the mechanism's size.
const AMPLITUDE: f64 = 0.12;
/// Most by which a curve turns between two knots, rad.
const TURN: f64 = 0.3;

/// A state of the path as it is drawn.
struct State {
    scene: Scene,
    parameter: f64,
    is_unstable: bool,
    mark: Option<Mark>,
}

/// The picture of the states that a trace has kept, as the text of an SVG file.
pub fn shapes_svg(view: &TraceView<'_>) -> String {
    let states = chosen(states(view));
    let values = || states.iter().map(|state| state.parameter);
    let ends = [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)];
    let ends = if ends[0].is_finite() && ends[1].is_finite() { ends } else { view.trace.range };
    let (name, unit) = view.parameter();
    let scale = Axis::new(ends, name, unit, BAR, 34.0, 0.0);
    let is_there = |mark: &Mark| states.iter().any(|state| state.mark == Some(*mark));
    let mut entries = vec![Entry::Rest];
    entries.extend(Mark::ALL.into_iter().filter(is_there).map(Entry::Mark));
    if states.iter().any(|state| state.is_unstable) {
        entries.push(Entry::Unstable);
    }
    if let Some(first) = states.first() {
        let strings = [
            (!first.scene.springs.is_empty(), Entry::Spring),
            (!first.scene.cables.is_empty(), Entry::Cable),
        ];
        entries.extend(strings.into_iter().filter(|(is_there, _)| *is_there).map(|(_, entry)| entry));
    }
    let bounds = joined(states.iter().map(|state| &state.scene));
    let sheet = Sheet::of(bounds, BAR + 40.0 + LEGEND_LINE * entries.len() as f64);
    let mut canvas = Canvas::new(sheet.width, sheet.height);
    let shown = shortened(name, LONG_NAME);
    let text = format!("shapes as {shown} changes; displacements to scale");
    head(&mut canvas, &sheet, view.model, view.trace.status, &text);

    let colour = |value: f64| {
        let [low, high] = ends;
        gradient(if high > low { (value - low) / (high - low) } else { 0.0 })
    };
    for panel in &sheet.panels {
        draw_axes(&mut canvas, &sheet, panel);
        let Some(first) = states.first() else { continue };
        draw_rest(&mut canvas, panel, &first.scene);
        for state in states.iter().filter(|state| state.mark.is_none()) {
            let dashes = if state.is_unstable { "6 4" } else { "" };
            draw_state(&mut canvas, panel, &state.scene, &colour(state.parameter), 1.5, dashes);
        }
        for state in states.iter().filter(|state| state.mark.is_some()) {
            draw_state(&mut canvas, panel, &state.scene, INK, 4.0, "");
            draw_state(&mut canvas, panel, &state.scene, &colour(state.parameter), 2.2, "");
        }
        draw_ground(&mut canvas, panel, &first.scene);
        if let Some(last) = states.last() {
            marks::names_of_strings(&mut canvas, panel, &last.scene);
        }
        for state in &states {
            if let (Some(mark), Some(at)) = (state.mark, most_moved(panel, &state.scene)) {
                mark.draw(&mut canvas, at);
            }
        }
    }
    let [x, y] = sheet.legend;
    draw_bar(&mut canvas, [x, y], &scale, ends);
    draw_legend(&mut canvas, [x, y + BAR + 40.0], &entries);
    canvas.finish()
}

fn states(view: &TraceView<'_>) -> Vec<State> {
    let mut states = Vec::new();
    for (b, branch) in view.trace.branches.iter().enumerate() {
        for (p, point) in branch.points.iter().enumerate() {
            let Some(solution) = &point.solution else { continue };
            states.push(State {
                scene: Scene::new(view.model_at(b, p), solution),
                parameter: point.parameter,
                is_unstable: point.stable == Some(false),
                mark: Mark::of(&point.kind),
            });
        }
    }
    states
}

/// All special states, and of the others so many as can still be told apart, evenly.
fn chosen(states: Vec<State>) -> Vec<State> {
    let plain = states.iter().filter(|state| state.mark.is_none()).count();
    let step = plain.div_ceil(MOST).max(1);
    let mut number = 0;
    states
        .into_iter()
        .filter(|state| {
            number += usize::from(state.mark.is_none());
            state.mark.is_some() || (number - 1) % step == 0
        })
        .collect()
}

/// The picture of the modes on the equilibrium about which the problem was linearised; `model` has the parameter's value
/// there.
pub fn modes_svg(model: &Model, buckling: &Buckling) -> String {
    let (name, unit) = parameter_of(model, buckling.parameter);
    let what = match buckling.parameter {
        Some(_) => format!("critical values of {}", shortened(name, LONG_NAME)),
        None => "critical fractions of the load".to_owned(),
    };
    let base = format!("at {}", shown(buckling.at, unit, 4));
    let modes = buckling.modes.iter().map(|mode| (shown(mode.value, unit, 5), &mode.direction));
    shapes_on(model, &buckling.solution, [what, base], modes.collect())
}

/// The picture of natural modes on the state about which they swing.
pub fn vibration_svg(model: &Model, modes: &Modes) -> String {
    let base = if modes.at_rest { "at rest" } else { "at the equilibrium" };
    let list = modes.modes.iter().map(|mode| {
        let text = match mode.kind {
            ModeKind::Rigid => "without stiffness".to_owned(),
            ModeKind::Diverging => format!("grows, {}", shown(mode.growth, "1/s", 5)),
            ModeKind::Creeping => format!("creeps, {}", shown(-mode.growth, "1/s", 5)),
            ModeKind::Flutter => format!("flutter, {}", shown(mode.rate / TAU, "Hz", 5)),
            ModeKind::Swinging | ModeKind::Decaying => shown(mode.rate / TAU, "Hz", 5),
        };
        (text, &mode.direction)
    });
    shapes_on(model, &modes.solution, ["natural modes".to_owned(), base.to_owned()], list.collect())
}

/// Shapes on a state, each with its name; `words` say what they are, and what the state is.
fn shapes_on(
    model: &Model,
    solution: &Solution,
    [what, state]: [String; 2],
    shapes: Vec<(String, &Direction)>,
) -> String {
    let base = Scene::new(model, solution);
    let [low, high] = base.bounds();
    let size = (high - low).max();
    let scenes: Vec<Scene> = shapes
        .iter()
        .map(|(_, direction)| Scene::new(model, &displaced(solution, direction, size)))
        .collect();
    let mut entries = vec![Entry::Base(state)];
    entries.extend(shapes.iter().enumerate().map(|(i, (name, direction))| {
        let only_turns = largest(direction, |twist| twist.linear) == 0.0;
        let remark = if only_turns { " (turns only)" } else { "" };
        Entry::Mode(i, format!("{}: {name}{remark}", i + 1))
    }));
    let bounds = joined(scenes.iter().chain([&base]));
    let sheet = Sheet::of(bounds, LEGEND_LINE * (entries.len() + 1) as f64);
    let mut canvas = Canvas::new(sheet.width, sheet.height);
    let text = format!("{what}; displacements not to scale");
    head(&mut canvas, &sheet, model, solution.status, &text);
    for panel in &sheet.panels {
        draw_axes(&mut canvas, &sheet, panel);
        draw_state(&mut canvas, panel, &base, FAINT, 3.0, "");
        for (i, scene) in scenes.iter().enumerate() {
            draw_state(&mut canvas, panel, scene, COLOURS[i % COLOURS.len()], 2.0, "");
        }
        draw_ground(&mut canvas, panel, &base);
    }
    draw_legend(&mut canvas, sheet.legend, &entries);
    canvas.finish()
}

/// The equilibrium moved along a direction, so far that it can be seen in a mechanism of that size.
fn displaced(solution: &Solution, direction: &Direction, size: f64) -> Solution {
    let most = largest(direction, |twist| twist.linear);
    let amount = if most > 0.0 { AMPLITUDE * size / most } else { 0.5 };
    let moved = |pose: &Pose, twist: &Twist| {
        Pose::new(exp(&(twist.angular * amount)) * pose.rotation, pose.position + twist.linear * amount)
    };
    let mut solution = solution.clone();
    for (beam, twists) in solution.beams.iter_mut().zip(&direction.beams) {
        for (sample, twist) in beam.samples.iter_mut().zip(twists) {
            sample.pose = moved(&sample.pose, twist);
        }
    }
    for (pose, twist) in solution.bodies.iter_mut().zip(&direction.bodies) {
        *pose = moved(pose, twist);
    }
    solution
}

fn largest(direction: &Direction, part: fn(&Twist) -> Vector3<f64>) -> f64 {
    let twists = direction.beams.iter().flatten().chain(&direction.bodies);
    twists.map(|twist| part(twist).norm()).fold(0.0, f64::max)
}

/// The box around all of them.
fn joined<'a>(scenes: impl Iterator<Item = &'a Scene>) -> [Vector3<f64>; 2] {
    let bounds = scenes.map(Scene::bounds);
    bounds.reduce(|[a, b], [low, high]| [a.inf(&low), b.sup(&high)]).unwrap_or([Vector3::zeros(); 2])
}

fn head(canvas: &mut Canvas, sheet: &Sheet, model: &Model, status: Status, text: &str) {
    let room = (sheet.width - sheet.left) / 9.5;
    canvas.heading([sheet.left, 26.0], &shortened(title(model), room as usize), 16.0);
    subtitle(canvas, sheet.left, status, text);
}

fn draw_rest(canvas: &mut Canvas, panel: &Panel, scene: &Scene) {
    let style = Style::line(FAINT, 1.2).dashed("5 4");
    for beam in &scene.beams {
        canvas.curve(&pieces(panel, &thinned(&beam.initial)), &style);
    }
    for body in &scene.bodies {
        for arm in &body.arms {
            canvas.line(panel.point(&body.initial), panel.point(&arm.initial), &style);
        }
    }
}

fn draw_state(
    canvas: &mut Canvas,
    panel: &Panel,
    scene: &Scene,
    colour: &str,
    width: f64,
    dashes: &'static str,
) {
    let style = |width: f64| Style::line(colour.to_owned(), width).dashed(dashes);
    for spring in &scene.springs {
        canvas.polyline(spring.course.iter().map(|point| panel.point(point)), &style(0.4 * width));
    }
    for cable in &scene.cables {
        canvas.polyline(cable.course.iter().map(|point| panel.point(point)), &style(0.5 * width));
    }
    for body in &scene.bodies {
        let at = panel.point(&body.deformed);
        for arm in &body.arms {
            canvas.line(at, panel.point(&arm.deformed), &style(0.9 * width));
        }
        canvas.circle(at, 0.9 * width, colour, &Style::line(colour.to_owned(), 0.5));
    }
    for beam in &scene.beams {
        canvas.curve(&pieces(panel, &thinned(&beam.deformed)), &style(width));
    }
    for outline in scene.outlines.iter().filter(|outline| !outline.is_grounded) {
        canvas.polyline(outline.deformed.iter().map(|point| panel.point(point)), &style(0.5 * width));
    }
}

/// As many knots as a curve needs that turns by little between two of them: there are many shapes in one picture.
fn thinned(knots: &[Knot]) -> Vec<Knot> {
    let mut kept: Vec<Knot> = Vec::new();
    for (i, knot) in knots.iter().enumerate() {
        let is_end = i == 0 || i + 1 == knots.len();
        // Looked at from one knot further on, so that the piece itself stays within the bound.
        let turns =
            |next: &Knot| kept.last().is_some_and(|last| last.derivative.angle(&next.derivative) > TURN);
        if is_end || knots.get(i + 1).is_some_and(turns) {
            kept.push(*knot);
        }
    }
    kept
}

/// What holds the mechanism to the ground.
fn draw_ground(canvas: &mut Canvas, panel: &Panel, scene: &Scene) {
    for outline in scene.outlines.iter().filter(|outline| outline.is_grounded) {
        canvas.polyline(outline.deformed.iter().map(|point| panel.point(point)), &Style::line(INK, 1.4));
    }
    for support in &scene.supports {
        marks::support(canvas, panel, support);
    }
    for joint in scene.joints.iter().filter(|joint| joint.is_grounded) {
        marks::joint(canvas, panel, joint);
    }
}

/// Where on the sheet the point lies that has moved farthest; of a mechanism that has not moved, the middle of a beam.
fn most_moved(panel: &Panel, scene: &Scene) -> Option<[f64; 2]> {
    let beams = scene.beams.iter().flat_map(|beam| {
        let pairs = beam.initial.iter().zip(&beam.deformed);
        pairs.map(|(before, now)| ((now.point - before.point).norm(), now.point))
    });
    let bodies = scene.bodies.iter().map(|body| ((body.deformed - body.initial).norm(), body.deformed));
    let farthest = beams.chain(bodies).max_by(|a, b| a.0.total_cmp(&b.0));
    let [low, high] = scene.bounds();
    let moved =
        farthest.filter(|(distance, _)| *distance > 1e-6 * (high - low).max()).map(|(_, point)| point);
    let middle = || {
        let beam = scene.beams.iter().max_by_key(|beam| beam.deformed.len())?;
        Some(beam.deformed.get(beam.deformed.len() / 2)?.point)
    };
    Some(panel.point(&moved.or_else(middle)?))
}

/// What the legend explains.
enum Entry {
    Rest,
    Mark(Mark),
    Unstable,
    Spring,
    Cable,
    Base(String),
    Mode(usize, String),
}

fn draw_legend(canvas: &mut Canvas, origin: [f64; 2], entries: &[Entry]) {
    for (i, entry) in entries.iter().enumerate() {
        let [x, y] = [origin[0], origin[1] + 10.0 + LEGEND_LINE * i as f64];
        let (left, right) = ([x, y], [x + 26.0, y]);
        let label = match entry {
            Entry::Rest => {
                canvas.line(left, right, &Style::line(FAINT, 1.2).dashed("5 4"));
                "initial shape"
            }
            Entry::Mark(mark) => {
                canvas.line(left, right, &Style::line(INK, 4.0));
                canvas.line(left, right, &Style::line(gradient(0.6), 2.2));
                mark.draw(canvas, [x + 13.0, y]);
                mark.name()
            }
            Entry::Unstable => {
                canvas.line(left, right, &Style::line(gradient(0.6), 1.5).dashed("6 4"));
                "unstable"
            }
            Entry::Spring => {
                canvas.line(left, right, &Style::line(gradient(0.6), 0.6));
                "spring"
            }
            Entry::Cable => {
                canvas.line(left, right, &Style::line(gradient(0.6), 0.8));
                "cable"
            }
            Entry::Base(label) => {
                canvas.line(left, right, &Style::line(FAINT, 3.0));
                label
            }
            Entry::Mode(i, label) => {
                canvas.line(left, right, &Style::line(COLOURS[i % COLOURS.len()], 2.0));
                label
            }
        };
        canvas.text([x + 34.0, y + 4.0], label, "start", 11.5, INK);
    }
}
