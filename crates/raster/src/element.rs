//! The elements of our drawings, each drawn as it comes.

use crate::{RasterError, number, text};
use roxmltree::Node;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash, Transform,
};

/// Draws what stands in an element.
pub fn children(pixels: &mut Pixmap, parent: &Node<'_, '_>, transform: Transform) -> Result<(), RasterError> {
    let mut elements = parent.children().filter(Node::is_element);
    elements.try_for_each(|node| element(pixels, &node, transform))
}

fn element(pixels: &mut Pixmap, node: &Node<'_, '_>, transform: Transform) -> Result<(), RasterError> {
    let of = |name: &str| number(node, name, 0.0) as f32;
    let path = match node.tag_name().name() {
        "svg" => return children(pixels, node, transform.pre_translate(of("x"), of("y"))),
        "text" => {
            let Some(letters) = text::outlines(node) else { return Ok(()) };
            return fill(pixels, node, &letters, transform);
        }
        "rect" => rectangle(node),
        "line" => {
            let mut path = PathBuilder::new();
            path.move_to(of("x1"), of("y1"));
            path.line_to(of("x2"), of("y2"));
            path.finish()
        }
        "circle" => PathBuilder::from_circle(of("cx"), of("cy"), of("r")),
        "polyline" => polygon(node.attribute("points").unwrap_or_default()),
        "path" => curve(node.attribute("d").unwrap_or_default())?,
        other => return Err(RasterError::Unknown(format!("the element <{other}>"))),
    };
    // What has no extent is nothing to see.
    let Some(path) = path else { return Ok(()) };
    if node.tag_name().name() != "line" {
        fill(pixels, node, &path, transform)?;
    }
    stroke(pixels, node, &path, transform)
}

fn rectangle(node: &Node<'_, '_>) -> Option<Path> {
    let parent = node.parent_element()?;
    let side = |name: &str| match node.attribute(name) {
        Some("100%") => number(&parent, name, 0.0),
        _ => number(node, name, 0.0),
    } as f32;
    let corner = ["x", "y"].map(|name| number(node, name, 0.0) as f32);
    Rect::from_xywh(corner[0], corner[1], side("width"), side("height")).map(PathBuilder::from_rect)
}

fn polygon(points: &str) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (i, point) in points.split_whitespace().enumerate() {
        let (x, y) = point.split_once(',')?;
        let (x, y) = (x.parse().ok()?, y.parse().ok()?);
        if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path.finish()
}

/// Moves and cubics with absolute coordinates: "M0 0 C1 2 3 4 5 6".
fn curve(data: &str) -> Result<Option<Path>, RasterError> {
    let unknown = || RasterError::Unknown(format!("the path \"{data}\""));
    let mut path = PathBuilder::new();
    let mut rest = data.trim();
    while let Some(command) = rest.chars().next() {
        let end = rest[1..].find(|c: char| c.is_ascii_alphabetic()).map_or(rest.len(), |at| at + 1);
        let values = rest[1..end].split_whitespace().map(str::parse);
        let values: Vec<f32> = values.collect::<Result<_, _>>().map_err(|_| unknown())?;
        match (command, &values[..]) {
            ('M', [x, y]) => path.move_to(*x, *y),
            ('C', [a, b, c, d, x, y]) => path.cubic_to(*a, *b, *c, *d, *x, *y),
            _ => return Err(unknown()),
        }
        rest = &rest[end..];
    }
    Ok(path.finish())
}

fn fill(
    pixels: &mut Pixmap,
    node: &Node<'_, '_>,
    path: &Path,
    transform: Transform,
) -> Result<(), RasterError> {
    // Of what says nothing the nearest element around it says it.
    let said = node.ancestors().find_map(|around| around.attribute("fill"));
    if let Some(paint) = paint(said.unwrap_or("#000000"))? {
        pixels.fill_path(path, &paint, FillRule::Winding, transform, None);
    }
    Ok(())
}

fn stroke(
    pixels: &mut Pixmap,
    node: &Node<'_, '_>,
    path: &Path,
    transform: Transform,
) -> Result<(), RasterError> {
    let Some(paint) = node.attribute("stroke").map(paint).transpose()?.flatten() else { return Ok(()) };
    let dashes = node.attribute("stroke-dasharray").unwrap_or_default();
    let dashes: Vec<f32> = dashes.split_whitespace().filter_map(|text| text.parse().ok()).collect();
    let stroke = Stroke {
        width: number(node, "stroke-width", 1.0) as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        dash: StrokeDash::new(dashes, 0.0),
        ..Stroke::default()
    };
    pixels.stroke_path(path, &paint, &stroke, transform, None);
    Ok(())
}

/// Of "#rrggbb"; None of "none".
fn paint(colour: &str) -> Result<Option<Paint<'static>>, RasterError> {
    if colour == "none" {
        return Ok(None);
    }
    let value = colour.strip_prefix('#').filter(|digits| digits.len() == 6);
    let value = value.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    let value = value.ok_or_else(|| RasterError::Unknown(format!("the colour \"{colour}\"")))?;
    let [_, r, g, b] = value.to_be_bytes();
    let mut paint = Paint::default();
    paint.set_color(Color::from_rgba8(r, g, b, 255));
    Ok(Some(paint))
}
