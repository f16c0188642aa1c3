//! Several pictures on one sheet.

/// Pictures one below the other, as the text of one SVG file; a single one stays as it is.
pub fn stacked(pictures: &[String]) -> String {
    if let [only] = pictures {
        return only.clone();
    }
    let sizes: Vec<[f64; 2]> =
        pictures.iter().map(|picture| ["width", "height"].map(|side| of(picture, side))).collect();
    let width = sizes.iter().map(|[width, _]| *width).fold(0.0, f64::max);
    let height: f64 = sizes.iter().map(|[_, height]| height).sum();
    let mut sheet = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    let mut top = 0.0;
    for (picture, [_, height]) in pictures.iter().zip(sizes) {
        sheet += &picture.replacen("<svg ", &format!("<svg y=\"{top:.0}\" "), 1);
        top += height;
    }
    sheet + "</svg>\n"
}

/// A side of a picture, px, as its first element says.
fn of(picture: &str, side: &str) -> f64 {
    let value = picture.split_once(&format!(" {side}=\"")).and_then(|(_, rest)| rest.split_once('"'));
    value.and_then(|(value, _)| value.parse().ok()).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg::canvas::Canvas;

    #[test]
    fn pictures_stand_below_each_other_on_a_sheet_as_wide_as_the_widest() {
        let pictures = [Canvas::new(300.0, 200.0).finish(), Canvas::new(500.0, 100.0).finish()];
        let sheet = stacked(&pictures);
        assert!(sheet.contains("width=\"500\" height=\"300\""), "{sheet}");
        assert!(sheet.contains("<svg y=\"0\" xmlns") && sheet.contains("<svg y=\"200\" xmlns"), "{sheet}");
        assert_eq!(sheet.matches("<svg ").count(), sheet.matches("</svg>").count());
        assert_eq!(stacked(&pictures[..1]), pictures[0]);
    }
}
