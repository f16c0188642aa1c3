//! The drawings that flexura writes as SVG, as PNG: for documents, slides and machines that show no SVG.
//!
//! This is no renderer of whatever SVG: it knows the few elements that our drawings are made of, and refuses others, so that
//! nothing is left out unseen. Letters come from a font of its own, so that a picture looks the same on every machine.
//!
//! ```text
//! SVG text -> roxmltree -> element by element (element.rs) -> tiny-skia's pixels -> PNG
//!                                      text.rs: letters as outlines
//! ```

mod element;
mod text;

use roxmltree::{Document, Node};
use tiny_skia::{Pixmap, Transform};

/// No side of a picture is longer than this, px.
const LONGEST: f64 = 16_384.0;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    /// The text is no XML.
    #[error("the drawing cannot be read: {0}")]
    Xml(#[from] roxmltree::Error),
    /// It holds what none of our drawings holds.
    #[error("the drawing holds {0}, which cannot be drawn as pixels")]
    Unknown(String),
    /// Its sides.
    #[error("a picture of {0:.0} by {1:.0} pixels cannot be made")]
    Size(f64, f64),
    /// PNG could not be written.
    #[error("the picture cannot be written: {0}")]
    Writing(String),
}

/// The bytes of a PNG file; `scale` is in pixels per unit of the drawing.
///
/// # Errors
/// The text is no drawing of flexura, or too large for a picture.
pub fn png(svg: &str, scale: f64) -> Result<Vec<u8>, RasterError> {
    let document = Document::parse(svg)?;
    let root = document.root_element();
    let [width, height] = ["width", "height"].map(|name| scale * number(&root, name, f64::NAN));
    let is_possible = |side: f64| (1.0..=LONGEST).contains(&side);
    if root.tag_name().name() != "svg" || !is_possible(width) || !is_possible(height) {
        return Err(RasterError::Size(width, height));
    }
    let pixels = Pixmap::new(width.ceil() as u32, height.ceil() as u32);
    let mut pixels = pixels.ok_or(RasterError::Size(width, height))?;
    element::children(&mut pixels, &root, Transform::from_scale(scale as f32, scale as f32))?;
    pixels.encode_png().map_err(|error| RasterError::Writing(error.to_string()))
}

/// A number of an element; the other value where it has none.
fn number(node: &Node<'_, '_>, name: &str, other: f64) -> f64 {
    node.attribute(name).and_then(|text| text.parse().ok()).unwrap_or(other)
}

#[cfg(test)]
mod tests;
