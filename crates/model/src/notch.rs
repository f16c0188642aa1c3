//! Notches: how the height of a flexure hinge runs along it.

use crate::At;

/// The height of a beam with a notch on both sides: least in the middle of the notch, that of the rim outside of it.
///
/// Where a rounding meets the rim its slope is infinite, h - h_rim ~ -√u with the distance u from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Notch {
    /// The form.
    pub shape: NotchShape,
    /// t, the least height, m.
    pub thickness: f64,
    /// Where the middle of the notch is. None: the notch is the whole beam.
    pub center: Option<At>,
}

/// The forms of notches, with the names of the flexure literature (Paros and Weisbord 1965; Smith et al. 1997;
/// Lobontiu 2003).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotchShape {
    /// Half circles: h = t + 2 r (1 - √(1 - (x/r)²)), x counted from the middle.
    Circular {
        /// r, m; the notch is 2 r long.
        radius: f64,
    },
    /// Half ellipses: h = t + 2 b (1 - √(1 - (x/a)²)).
    Elliptic {
        /// a, half the notch's length, m.
        along: f64,
        /// b, the depth of each side, m.
        across: f64,
    },
    /// Quarter circles at both ends and height t between them: h = t + 2 r (1 - √(1 - (1 - u/r)²)) within r of an
    /// end, u counted from there.
    CornerFilleted {
        /// r, m.
        radius: f64,
        /// Length of the notch, fillets included, m. None: that of the beam.
        length: Option<f64>,
    },
}

/// How often the distance from an infinite slope is halved. An integral over √u within the last one errs by
/// 2^-27 of what the rounding contributes.
const HALVINGS: i32 = 18;
/// How often the distance from the thinnest place is halved, where the height doubles over √(thickness × radius). The
/// same for every notch, so that the pieces of two notches that differ a little correspond.
const TOWARDS_THE_MIDDLE: i32 = 8;

impl Notch {
    /// Length of the notch (m) on a beam of the given length.
    pub fn length(&self, beam: f64) -> f64 {
        match self.shape {
            NotchShape::Circular { radius } => 2.0 * radius,
            NotchShape::Elliptic { along, .. } => 2.0 * along,
            NotchShape::CornerFilleted { length, .. } => length.unwrap_or(beam),
        }
    }

    /// Arc length of its middle (m).
    pub fn middle(&self, beam: f64) -> f64 {
        self.center.map_or(0.5 * beam, |at| at.arc_length(beam))
    }

    /// The height outside of the notch, m.
    pub fn rim(&self) -> f64 {
        self.thickness + 2.0 * self.rounding().1
    }

    /// Half axes of the rounding, along and across the beam.
    fn rounding(&self) -> (f64, f64) {
        match self.shape {
            NotchShape::Circular { radius } | NotchShape::CornerFilleted { radius, .. } => (radius, radius),
            NotchShape::Elliptic { along, across } => (along, across),
        }
    }

    /// h at arc length `s`, m.
    pub fn height(&self, s: f64, beam: f64) -> f64 {
        let (along, across) = self.rounding();
        let inside = 0.5 * self.length(beam) - (s - self.middle(beam)).abs();
        // Written in the distance from the end, so that nothing is lost where the slope is infinite.
        let x = (inside / along).clamp(0.0, 1.0);
        self.thickness + 2.0 * across * (1.0 - (x * (2.0 - x)).sqrt())
    }

    /// Arc lengths (m) between which the height is smooth on the scale of their distance: towards an infinite slope
    /// and towards the thin middle they come closer in proportion. Integrals over powers of 1/h reach 1e-9 with
    /// four steps of order 8 on each piece, 1e-5 with one.
    pub(crate) fn breaks(&self, beam: f64) -> Vec<f64> {
        let (along, _) = self.rounding();
        let (half, middle) = (0.5 * self.length(beam), self.middle(beam));
        let mut inside = vec![0.0, along];
        inside.extend((1..=HALVINGS).map(|k| along * 0.5f64.powi(k)));
        inside.extend((1..=TOWARDS_THE_MIDDLE).map(|k| along * (1.0 - 0.5f64.powi(k))));
        inside.iter().flat_map(|u| [middle - half + u, middle + half - u]).collect()
    }
}
