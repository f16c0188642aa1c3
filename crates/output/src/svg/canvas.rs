//! SVG text, piece by piece. Coordinates are pixels, y downwards.

use flexura_model::visible;
use std::borrow::Cow;
use std::fmt::Write;

/// How a line looks.
#[derive(Clone)]
pub struct Style {
    colour: Cow<'static, str>,
    width: f64,
    dashes: &'static str,
}

impl Style {
    pub fn line(colour: impl Into<Cow<'static, str>>, width: f64) -> Self {
        Self { colour: colour.into(), width, dashes: "" }
    }

    pub fn dashed(mut self, dashes: &'static str) -> Self {
        self.dashes = dashes;
        self
    }

    fn attributes(&self) -> String {
        let mut text = format!("stroke=\"{}\" stroke-width=\"{}\"", self.colour, self.width);
        if !self.dashes.is_empty() {
            let _ = write!(text, " stroke-dasharray=\"{}\"", self.dashes);
        }
        text
    }
}

/// An SVG drawing in the making.
pub struct Canvas {
    text: String,
}

impl Canvas {
    pub fn new(width: f64, height: f64) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" \
             fill=\"#222222\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
        );
        Self { text }
    }

    /// An element as it stands.
    pub fn raw(&mut self, element: &str) {
        self.text.push_str(element);
        self.text.push('\n');
    }

    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], style: &Style) {
        self.raw(&format!(
            "<line x1=\"{:.2}\" y1=\"{:.2}\" x2=\"{:.2}\" y2=\"{:.2}\" {}/>",
            from[0],
            from[1],
            to[0],
            to[1],
            style.attributes()
        ));
    }

    pub fn polyline(&mut self, points: impl Iterator<Item = [f64; 2]>, style: &Style) {
        self.path(points, "none", style);
    }

    /// Cubic Bézier curves, each beginning where the one before ends.
    pub fn curve(&mut self, pieces: &[[[f64; 2]; 4]], style: &Style) {
        let Some([[x, y], ..]) = pieces.first() else { return };
        let mut path = format!("M{x:.2} {y:.2}");
        for [_, a, b, end] in pieces {
            let _ =
                write!(path, " C{:.2} {:.2} {:.2} {:.2} {:.2} {:.2}", a[0], a[1], b[0], b[1], end[0], end[1]);
        }
        self.raw(&format!("<path d=\"{path}\" fill=\"none\" {}/>", style.attributes()));
    }

    pub fn polygon(&mut self, points: &[[f64; 2]], fill: &str, style: &Style) {
        let closed = points.iter().chain(points.first()).copied();
        self.path(closed, fill, style);
    }

    fn path(&mut self, points: impl Iterator<Item = [f64; 2]>, fill: &str, style: &Style) {
        let mut list = String::new();
        for [x, y] in points {
            let _ = write!(list, "{x:.2},{y:.2} ");
        }
        self.raw(&format!(
            "<polyline points=\"{}\" fill=\"{fill}\" {}/>",
            list.trim_end(),
            style.attributes()
        ));
    }

    pub fn circle(&mut self, centre: [f64; 2], radius: f64, fill: &str, style: &Style) {
        self.raw(&format!(
            "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{radius}\" fill=\"{fill}\" {}/>",
            centre[0],
            centre[1],
            style.attributes()
        ));
    }

    /// A heading, bold.
    pub fn heading(&mut self, at: [f64; 2], text: &str, size: f64) {
        self.raw(&format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"{size}\" font-weight=\"bold\">{}</text>",
            at[0],
            at[1],
            escape(text)
        ));
    }

    /// A line of text that runs upwards, its middle at a place.
    pub fn upright(&mut self, at: [f64; 2], text: &str, size: f64) {
        self.raw(&format!(
            "<text transform=\"translate({:.1} {:.1}) rotate(-90)\" text-anchor=\"middle\" font-size=\"{size}\">{}</text>",
            at[0],
            at[1],
            escape(text)
        ));
    }

    /// The ground of a view.
    pub fn ground(&mut self, [x, y, width, height]: [f64; 4]) {
        self.raw(&format!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#fcfcfc\" stroke=\"#bbbbbb\"/>"
        ));
    }

    /// A line of text. `anchor`: start, middle or end.
    pub fn text(&mut self, at: [f64; 2], text: &str, anchor: &str, size: f64, colour: &str) {
        self.raw(&format!(
            "<text x=\"{:.2}\" y=\"{:.2}\" text-anchor=\"{anchor}\" font-size=\"{size}\" fill=\"{colour}\">{}</text>",
            at[0],
            at[1],
            escape(text)
        ));
    }

    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

/// Text as XML wants it; what cannot be seen, some of which XML cannot hold, is written out.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in visible(text).chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            character => escaped.push(character),
        }
    }
    escaped
}
