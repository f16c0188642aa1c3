//! Pictures. `shape.svg`: the initial and the deformed shape, in the one plane of a mechanism that stays in a plane, else in
//! the three principal views and an isometric one.
//!
//! The principal views stand as in an engineering drawing and share one scale:
//!
//! ```text
//!   top  (x, y)   legend        isometric
//!   front(x, z)   side (y, z)
//! ```
//!
//! so x lines up between top and front, z between front and side.

mod axis;
mod canvas;
mod curve;
mod diagram;
mod fitted;
mod frequencies;
mod gradient;
mod history;
mod layout;
mod marks;
mod outlines;
mod response;
mod samples;
mod scene;
mod series;
mod shapes;
mod stack;

pub use diagram::diagram_svg;
pub use fitted::{fit_svg, formula_svg};
pub use frequencies::frequencies_svg;
pub use history::motion_svg;
pub use response::response_svg;
pub use samples::{SampleColumn, SweepView, sweep_svg};
pub use shapes::{modes_svg, shapes_svg, vibration_svg};
pub use stack::stacked;

use canvas::{Canvas, Style};
use flexura_model::Model;
use flexura_solution::{Solution, Status};
use flexura_spatial::Vector3;
use layout::{Panel, Sheet};
pub(crate) use scene::initial_pose;
use scene::{Knot, Scene};

/// Colours that readers with any kind of colour vision tell apart (Okabe and Ito).
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const INK: &str = "#222222";
const FAINT: &str = "#9a9a9a";
const LOAD: &str = "#b2182b";
const CABLE: &str = "#7b3294";
const SPRING: &str = "#666666";
/// Boundaries of what moves.
const MOVING: &str = "#555555";
const FOUNDATION: &str = "#ece0c8";
/// Characters of names at axes and curves, and beside bodies.
const LONG_NAME: usize = 44;
const BODY_NAME: usize = 24;
/// Width of the band that stands for a foundation, px.
const BAND: f64 = 14.0;
/// Beams that the legend names one by one.
const LEGEND_BEAMS: usize = 6;

/// The picture of a solution, as the text of an SVG file.
pub fn shape_svg(model: &Model, solution: &Solution) -> String {
    let scene = Scene::new(model, solution);
    let entries = legend_entries(&scene);
    let sheet = Sheet::of(scene.bounds(), layout::LEGEND_LINE * entries.len() as f64);
    let mut canvas = Canvas::new(sheet.width, sheet.height);

    let title = if model.name.is_empty() { "mechanism" } else { &model.name };
    let room = (sheet.width - sheet.left) / 9.5;
    canvas.heading([sheet.left, 26.0], &shortened(title, room as usize), 16.0);
    let state = match solution.status {
        Status::Converged => "in equilibrium".to_owned(),
        _ => format!("{:.3} % of the load", 100.0 * solution.load_fraction),
    };
    subtitle(&mut canvas, sheet.left, solution.status, &format!("{state}; displacements to scale"));

    for panel in &sheet.panels {
        draw_axes(&mut canvas, &sheet, panel);
        draw_scene(&mut canvas, panel, &scene);
    }
    draw_legend(&mut canvas, sheet.legend, &entries);
    canvas.finish()
}

/// The line below the title. A picture of what did not converge says so first, and in the colour of warnings.
fn subtitle(canvas: &mut Canvas, left: f64, status: Status, text: &str) {
    let (text, colour) = match status {
        Status::Converged => (text.to_owned(), "#666666"),
        status => (format!("not converged, {}; {text}", status.word().replace('_', " ")), LOAD),
    };
    canvas.text([left, 44.0], &text, "start", 11.0, colour);
}

fn draw_axes(canvas: &mut Canvas, sheet: &Sheet, panel: &Panel) {
    let [x, y, width, height] = panel.frame;
    canvas.ground(panel.frame);
    canvas.heading([x, y - 8.0], panel.title, 12.0);
    let names = ["x", "y", "z"];
    let Some(axes) = panel.axes else {
        triad(canvas, panel, names);
        return;
    };
    let grid = Style::line("#e9e9e9", 0.8);
    for (value, label) in sheet.ticks(0, panel) {
        let at = panel.horizontal(value);
        canvas.line([at, y], [at, y + height], &grid);
        canvas.text([at, y + height + 14.0], &label, "middle", 10.5, "#444444");
    }
    for (value, label) in sheet.ticks(1, panel) {
        let at = panel.vertical(value);
        canvas.line([x, at], [x + width, at], &grid);
        canvas.text([x - 5.0, at + 3.5], &label, "end", 10.5, "#444444");
    }
    let [across, up] = axes.map(|axis| format!("{} / {}", names[axis], sheet.unit));
    canvas.text([x + 0.5 * width, y + height + 30.0], &across, "middle", 11.5, INK);
    canvas.upright([x - 44.0, y + 0.5 * height], &up, 11.5);
}

/// The global axes in the lower left corner of a view that is in no plane of theirs.
fn triad(canvas: &mut Canvas, panel: &Panel, names: [&str; 3]) {
    const LENGTH: f64 = 26.0;
    let [x, y, _, height] = panel.frame;
    let from = [x + 30.0, y + height + 16.0];
    for (name, axis) in names.into_iter().zip([Vector3::x(), Vector3::y(), Vector3::z()]) {
        let along = panel.direction(&axis);
        let place = |length: f64| [from[0] + length * along[0], from[1] + length * along[1]];
        marks::arrow(canvas, from, place(LENGTH), "#444444");
        let [x, y] = place(LENGTH + 9.0);
        canvas.text([x, y + 3.5], name, "middle", 10.5, "#444444");
    }
}

fn draw_scene(canvas: &mut Canvas, panel: &Panel, scene: &Scene) {
    for foundation in &scene.foundations {
        canvas.curve(&pieces(panel, foundation), &Style::line(FOUNDATION, BAND));
    }
    let initial = Style::line(FAINT, 1.2).dashed("5 4");
    for body in &scene.bodies {
        for arm in &body.arms {
            canvas.line(panel.point(&body.initial), panel.point(&arm.initial), &initial);
        }
    }
    for beam in &scene.beams {
        canvas.curve(&pieces(panel, &beam.initial), &initial);
    }
    for outline in scene.outlines.iter().filter(|outline| !outline.is_grounded) {
        canvas.polyline(outline.initial.iter().map(|point| panel.point(point)), &initial);
    }
    for outline in &scene.outlines {
        let colour = if outline.is_grounded { INK } else { MOVING };
        let style = Style::line(colour, if outline.is_surface { 0.7 } else { 1.6 });
        canvas.polyline(outline.deformed.iter().map(|point| panel.point(point)), &style);
    }
    for spring in &scene.springs {
        marks::spring(canvas, panel, spring);
    }
    let arm_style = Style::line("#555555", 2.6);
    for body in &scene.bodies {
        for arm in &body.arms {
            canvas.line(panel.point(&body.deformed), panel.point(&arm.deformed), &arm_style);
        }
    }
    for (i, beam) in scene.beams.iter().enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        canvas.curve(&pieces(panel, &beam.deformed), &Style::line(colour, 2.4));
        for (around, knots) in beam.sleeves.iter().enumerate().filter(|(_, knots)| **knots > 1) {
            let style = Style::line(colour, 2.4 + 1.8 * (1.0 + around as f64));
            canvas.curve(&pieces(panel, &beam.deformed[..*knots]), &style);
        }
    }
    for cable in &scene.cables {
        marks::cable(canvas, panel, cable);
    }
    for support in &scene.supports {
        marks::support(canvas, panel, support);
    }
    for joint in &scene.joints {
        marks::joint(canvas, panel, joint);
    }
    for mass in &scene.masses {
        marks::mass(canvas, panel, mass);
    }
    for load in &scene.loads {
        marks::load(canvas, panel, load);
    }
    let mut labels: Vec<[f64; 2]> = Vec::new();
    for body in &scene.bodies {
        marks::body(canvas, panel, body, &scene.joints, &mut labels);
    }
}

/// The Bézier curves that have the beam's direction at each sample: four points each.
fn pieces(panel: &Panel, knots: &[Knot]) -> Vec<[[f64; 2]; 4]> {
    let piece = |pair: &[Knot]| {
        let third = (pair[1].s - pair[0].s) / 3.0;
        let (leaving, arriving) =
            (pair[0].point + pair[0].derivative * third, pair[1].point - pair[1].derivative * third);
        [pair[0].point, leaving, arriving, pair[1].point].map(|point| panel.point(&point))
    };
    knots.windows(2).map(piece).collect()
}

/// What a line of the legend shows.
enum Entry {
    Initial,
    Beam { name: String, colour: &'static str },
    MoreBeams(usize),
    Foundation,
    Body,
    Spring,
    Cable,
    Contact { is_grounded: bool },
    Support,
    Load,
    Mass,
    Gravity(String),
}

fn legend_entries(scene: &Scene) -> Vec<Entry> {
    let mut entries = vec![Entry::Initial];
    for (i, beam) in scene.beams.iter().take(LEGEND_BEAMS).enumerate() {
        entries.push(Entry::Beam { name: beam.name.clone(), colour: COLOURS[i % COLOURS.len()] });
    }
    if scene.beams.len() > LEGEND_BEAMS {
        entries.push(Entry::MoreBeams(scene.beams.len() - LEGEND_BEAMS));
    }
    if !scene.foundations.is_empty() {
        entries.push(Entry::Foundation);
    }
    if !scene.bodies.is_empty() {
        entries.push(Entry::Body);
    }
    if !scene.springs.is_empty() {
        entries.push(Entry::Spring);
    }
    if !scene.cables.is_empty() {
        entries.push(Entry::Cable);
    }
    if scene.outlines.iter().any(|outline| !outline.is_grounded) {
        entries.push(Entry::Contact { is_grounded: false });
    }
    if scene.outlines.iter().any(|outline| outline.is_grounded) {
        entries.push(Entry::Contact { is_grounded: true });
    }
    if !scene.supports.is_empty() || scene.joints.iter().any(|joint| joint.is_grounded) {
        entries.push(Entry::Support);
    }
    if !scene.loads.is_empty() {
        entries.push(Entry::Load);
    }
    if !scene.masses.is_empty() {
        entries.push(Entry::Mass);
    }
    if scene.gravity != Vector3::zeros() {
        let parts = scene.gravity.map(|part| axis::number(part, 3));
        entries.push(Entry::Gravity(format!("gravity ({}, {}, {}) m/s²", parts.x, parts.y, parts.z)));
    }
    entries
}

fn draw_legend(canvas: &mut Canvas, origin: [f64; 2], entries: &[Entry]) {
    for (i, entry) in entries.iter().enumerate() {
        let [x, y] = [origin[0], origin[1] + 10.0 + layout::LEGEND_LINE * i as f64];
        let (left, right, middle) = ([x, y], [x + 26.0, y], [x + 13.0, y]);
        let label = match entry {
            Entry::Initial => {
                canvas.line(left, right, &Style::line(FAINT, 1.2).dashed("5 4"));
                "initial shape".to_owned()
            }
            Entry::Beam { name, colour } => {
                canvas.line(left, right, &Style::line(*colour, 2.4));
                shortened(name, 20)
            }
            Entry::MoreBeams(count) => format!("and {count} more"),
            Entry::Foundation => {
                // Its round ends reach as far as the other lines do.
                let [left, right] = [left[0] + 0.5 * BAND, right[0] - 0.5 * BAND].map(|x| [x, y]);
                canvas.line(left, right, &Style::line(FOUNDATION, BAND));
                "foundation".to_owned()
            }
            Entry::Body => {
                marks::diamond(canvas, middle, true);
                "rigid body".to_owned()
            }
            Entry::Spring => {
                marks::zigzag(canvas, left, right);
                "spring".to_owned()
            }
            Entry::Contact { is_grounded } => {
                let colour = if *is_grounded { INK } else { MOVING };
                canvas.line(left, right, &Style::line(colour, 1.6));
                if *is_grounded { "boundary on the ground" } else { "moving boundary" }.to_owned()
            }
            Entry::Cable => {
                canvas.line(left, right, &Style::line(CABLE, 1.2));
                marks::eyelet(canvas, middle);
                "cable".to_owned()
            }
            Entry::Support => {
                marks::clamp(canvas, [x + 10.0, y], [1.0, 0.0], 7.0);
                "support".to_owned()
            }
            Entry::Load => {
                marks::arrow(canvas, left, right, LOAD);
                "load".to_owned()
            }
            Entry::Mass => {
                canvas.circle(middle, 3.4, INK, &Style::line("#ffffff", 0.8));
                "mass".to_owned()
            }
            Entry::Gravity(text) => text.clone(),
        };
        let indent = if matches!(entry, Entry::Gravity(_)) { 0.0 } else { 34.0 };
        canvas.text([x + indent, y + 4.0], &label, "start", 11.5, INK);
    }
}

/// A name of at most that many characters.
fn shortened(name: &str, longest: usize) -> String {
    if name.chars().count() <= longest {
        name.to_owned()
    } else {
        name.chars().take(longest.saturating_sub(1)).chain(['…']).collect()
    }
}
