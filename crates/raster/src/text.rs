//! Lines of text as outlines of their letters.

use crate::number;
use roxmltree::Node;
use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// The letters of a `<text>` element in the drawing's axes; None where nothing is written.
pub fn outlines(node: &Node<'_, '_>) -> Option<Path> {
    let is_bold = node.attribute("font-weight") == Some("bold");
    let font = if is_bold { dejavu::sans::bold() } else { dejavu::sans::regular() };
    let face = Face::parse(font, 0).ok()?;
    let size = number(node, "font-size", 12.0) as f32 / f32::from(face.units_per_em());
    let text = node.text().unwrap_or_default();
    let mut letters = Letters { path: PathBuilder::new(), at: 0.0 };
    for character in text.chars() {
        // Letters that the font lacks show its empty box.
        let glyph = face.glyph_index(character).unwrap_or(GlyphId(0));
        face.outline_glyph(glyph, &mut letters);
        letters.at += f32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
    }
    let before = match node.attribute("text-anchor") {
        Some("middle") => 0.5,
        Some("end") => 1.0,
        _ => 0.0,
    } * letters.at;
    let place = place(node).pre_scale(size, -size).pre_translate(-before, 0.0);
    letters.path.finish()?.transform(place)
}

/// Where the line begins and how it runs: `x` and `y`, or "translate(x y) rotate(degrees)".
fn place(node: &Node<'_, '_>) -> Transform {
    let numbers = |text: &str, word: &str| -> Vec<f32> {
        let inside = text.split_once(word).and_then(|(_, rest)| Some(rest.split_once(')')?.0));
        inside.unwrap_or_default().split_whitespace().filter_map(|number| number.parse().ok()).collect()
    };
    let text = node.attribute("transform").unwrap_or_default();
    match (&numbers(text, "translate(")[..], &numbers(text, "rotate(")[..]) {
        ([x, y], [angle]) => Transform::from_translate(*x, *y).pre_rotate(*angle),
        _ => Transform::from_translate(number(node, "x", 0.0) as f32, number(node, "y", 0.0) as f32),
    }
}

/// Outlines side by side, in units of the font, y upwards.
struct Letters {
    path: PathBuilder,
    at: f32,
}

impl OutlineBuilder for Letters {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.at + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.at + x, y);
    }

    fn quad_to(&mut self, a: f32, b: f32, x: f32, y: f32) {
        self.path.quad_to(self.at + a, b, self.at + x, y);
    }

    fn curve_to(&mut self, a: f32, b: f32, c: f32, d: f32, x: f32, y: f32) {
        self.path.cubic_to(self.at + a, b, self.at + c, d, self.at + x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
