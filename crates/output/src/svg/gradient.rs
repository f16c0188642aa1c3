//! A range of values as colours, with the bar that explains them.

use super::INK;
use super::axis::Axis;
use super::canvas::{Canvas, Style};

/// From the first to the last value of the parameter; dark to light, and told apart without colours too.
const GRADIENT: [[f64; 3]; 5] = [
    [68.0, 1.0, 84.0],
    [65.0, 68.0, 135.0],
    [42.0, 120.0, 142.0],
    [34.0, 168.0, 132.0],
    [122.0, 196.0, 76.0],
];
/// Height of the bar of colours, px.
pub const BAR: f64 = 180.0;

/// The colour at a place between 0 and 1.
pub fn gradient(place: f64) -> String {
    let last = GRADIENT.len() - 1;
    let place = place.clamp(0.0, 1.0) * last as f64;
    let below = (place.floor() as usize).min(last - 1);
    let part = place - below as f64;
    let [r, g, b] = [0, 1, 2].map(|k| {
        let mixed = GRADIENT[below][k] * (1.0 - part) + GRADIENT[below + 1][k] * part;
        mixed.round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The bar of colours with the parameter beside it.
pub fn draw_bar(canvas: &mut Canvas, [x, y]: [f64; 2], scale: &Axis, [low, high]: [f64; 2]) {
    const STRIPES: usize = 48;
    let row = |value: f64| y + BAR * (1.0 - scale.place(value));
    let (bottom, top) = (row(low), row(high));
    let height = (bottom - top) / STRIPES as f64;
    for i in 0..STRIPES {
        let colour = gradient((i as f64 + 0.5) / STRIPES as f64);
        // A little more than its share, so that no seam shows.
        canvas.raw(&format!(
            "<rect x=\"{x:.1}\" y=\"{:.2}\" width=\"14\" height=\"{:.2}\" fill=\"{colour}\"/>",
            bottom - (i + 1) as f64 * height,
            height + 0.4
        ));
    }
    let ticks = scale.ticks();
    for (value, label) in ticks.iter().filter(|(value, _)| (low..=high).contains(value)) {
        canvas.line([x + 14.0, row(*value)], [x + 18.0, row(*value)], &Style::line("#444444", 0.8));
        canvas.text([x + 22.0, row(*value) + 3.5], label, "start", 10.5, "#444444");
    }
    canvas.text([x, y + BAR + 16.0], &scale.label, "start", 11.5, INK);
}
