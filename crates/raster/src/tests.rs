// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use super::{RasterError, png};
use tiny_skia::Pixmap;

fn drawing(inside: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"30\" fill=\"#222222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{inside}</svg>\n"
    )
}

fn pixels(inside: &str, scale: f64) -> Pixmap {
    Pixmap::decode_png(&png(&drawing(inside), scale).unwrap()).unwrap()
}

fn at(pixels: &Pixmap, x: u32, y: u32) -> [u8; 3] {
    let pixel = pixels.pixel(x, y).unwrap();
    [pixel.red(), pixel.green(), pixel.blue()]
}

/// Smallest and largest x and y of what is not white.
fn extent(pixels: &Pixmap) -> [u32; 4] {
    let mut extent = [u32::MAX, 0, u32::MAX, 0];
    for y in 0..pixels.height() {
        for x in 0..pixels.width() {
            if at(pixels, x, y) != [255; 3] {
                extent = [extent[0].min(x), extent[1].max(x), extent[2].min(y), extent[3].max(y)];
            }
        }
    }
    extent
}

#[test]
fn elements_are_where_the_drawing_has_them_at_every_scale() {
    let inside = "<rect x=\"4\" y=\"6\" width=\"10\" height=\"5\" fill=\"#b2182b\"/>\n\
                  <circle cx=\"30\" cy=\"20\" r=\"5\" fill=\"#0072b2\" stroke=\"none\"/>\n\
                  <line x1=\"2\" y1=\"25\" x2=\"12\" y2=\"25\" stroke=\"#009e73\" stroke-width=\"2\"/>\n\
                  <path d=\"M20 5 C22 5 28 5 30 5\" fill=\"none\" stroke=\"#e69f00\" stroke-width=\"2\"/>\n\
                  <svg x=\"20\" y=\"8\" width=\"10\" height=\"4\"><rect width=\"100%\" height=\"100%\" fill=\"#000000\"/></svg>";
    for scale in [1, 3] {
        let pixels = pixels(inside, f64::from(scale));
        assert_eq!([pixels.width(), pixels.height()], [40 * scale, 30 * scale]);
        let at = |x: u32, y: u32| at(&pixels, x * scale, y * scale);
        assert_eq!(at(8, 8), [0xb2, 0x18, 0x2b]);
        assert_eq!(at(30, 20), [0, 0x72, 0xb2]);
        assert_eq!(at(7, 25), [0, 0x9e, 0x73]);
        assert_eq!(at(25, 5), [0xe6, 0x9f, 0]);
        assert_eq!(at(25, 10), [0, 0, 0]);
        assert_eq!([at(17, 8), at(30, 27), at(1, 1)], [[255; 3]; 3]);
    }
}

#[test]
fn dashes_leave_gaps() {
    let line = |dashes: &str| {
        let line = "<line x1=\"2\" y1=\"15\" x2=\"38\" y2=\"15\" stroke=\"#000000\" stroke-width=\"1\"";
        pixels(&format!("{line} {dashes}/>"), 2.0)
    };
    let dark = |pixels: &Pixmap| (0..80).filter(|x| at(pixels, *x, 30)[0] < 128).count();
    let (whole, dashed) = (dark(&line("")), dark(&line("stroke-dasharray=\"5 4\"")));
    assert!(whole > 65 && dashed > 20 && dashed < whole - 10, "{whole} {dashed}");
}

#[test]
fn text_stands_at_its_anchor_and_runs_upwards_where_it_should() {
    let text = |attributes: &str| extent(&pixels(&format!("<text {attributes}>mm</text>"), 4.0));
    let start = text("x=\"20\" y=\"20\" text-anchor=\"start\" font-size=\"8\"");
    let end = text("x=\"20\" y=\"20\" text-anchor=\"end\" font-size=\"8\"");
    let middle = text("x=\"20\" y=\"20\" text-anchor=\"middle\" font-size=\"8\"");
    assert!(start[0] >= 80 && end[1] <= 80, "{start:?} {end:?}");
    assert!((middle[0] + middle[1]).abs_diff(160) <= 6, "{middle:?}");
    // Letters stand on their line.
    assert!(start[3].abs_diff(80) <= 1 && start[2] < 70, "{start:?}");
    let [left, right, top, bottom] =
        text("transform=\"translate(20 15) rotate(-90)\" text-anchor=\"middle\" font-size=\"8\"");
    assert!(
        bottom - top > right - left && (top + bottom).abs_diff(120) <= 6,
        "{left} {right} {top} {bottom}"
    );
}

#[test]
fn what_is_not_known_is_refused_and_not_left_out() {
    for (inside, word) in [
        ("<ellipse rx=\"3\" ry=\"2\"/>", "ellipse"),
        ("<path d=\"M0 0 A1 1 0 0 0 2 2\"/>", "path"),
        ("<rect width=\"3\" height=\"3\" fill=\"red\"/>", "colour"),
    ] {
        let error = png(&drawing(inside), 1.0).unwrap_err();
        assert!(matches!(&error, RasterError::Unknown(what) if what.contains(word)), "{error}");
    }
    assert!(matches!(png("<svg", 1.0), Err(RasterError::Xml(_))));
    assert!(matches!(png("<svg width=\"40\" height=\"1e9\"/>", 1.0), Err(RasterError::Size(..))));
    assert!(matches!(png("<svg width=\"40\"/>", 1.0), Err(RasterError::Size(..))));
}
