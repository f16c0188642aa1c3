//! Polynomials of degree 20 in place of curvatures, as the thesis fits them to its rest shapes (2.3.1 and 2.3.3).

use super::Fact;

/// Points along the curve, evenly spaced in arc length.
const POINTS: usize = 2001;
const DEGREE: usize = 20;

pub(super) fn facts() -> Result<Vec<Fact>, String> {
    let ellipse = |t: f64| {
        // 10 and 5: half of the way round is 24.22, the whole 48.44.
        let (dx, dy) = (-10.0 * t.sin(), 5.0 * t.cos());
        let speed = dx.hypot(dy);
        (speed, 50.0 / speed.powi(3))
    };
    let spatial = |t: f64| {
        let first = [25.0 * t.cos(), 20.0 * (2.0 * t).sin(), 60.0 * (3.0 * t).sin()];
        let second = [-25.0 * t.sin(), 40.0 * (2.0 * t).cos(), 180.0 * (3.0 * t).cos()];
        let cross = [
            first[1] * second[2] - first[2] * second[1],
            first[2] * second[0] - first[0] * second[2],
            first[0] * second[1] - first[1] * second[0],
        ];
        let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        (size(first), size(cross) / size(first).powi(3))
    };
    let (around, quarter) = (std::f64::consts::TAU, std::f64::consts::FRAC_PI_2);
    Ok(vec![
        ("fit ellipse %".into(), 100.0 * worst(&curvature(ellipse, around))),
        ("fit space curve %".into(), 100.0 * worst(&curvature(spatial, quarter))),
    ])
}

/// The curvature at evenly spaced arc lengths of a curve that has a speed and a curvature at every parameter from 0 to `end`.
fn curvature(curve: impl Fn(f64) -> (f64, f64), end: f64) -> Vec<f64> {
    const STEPS: usize = 40_000;
    let step = end / STEPS as f64;
    // Arc length at every step, by Simpson's rule.
    let mut lengths = vec![0.0];
    for i in 0..STEPS {
        let t = i as f64 * step;
        let part = curve(t).0 + 4.0 * curve(t + 0.5 * step).0 + curve(t + step).0;
        lengths.push(lengths[i] + part * step / 6.0);
    }
    let whole = lengths[STEPS];
    let at = |i: usize| {
        let wanted = whole * i as f64 / (POINTS - 1) as f64;
        let next = lengths.partition_point(|length| *length < wanted).clamp(1, STEPS);
        let part = (wanted - lengths[next - 1]) / (lengths[next] - lengths[next - 1]);
        curve((next as f64 - 1.0 + part) * step).1
    };
    (0..POINTS).map(at).collect()
}

/// The largest error of the best polynomial in the sense of least squares, relative to the largest value; by polynomials that
/// are orthogonal on the points (G. E. Forsythe, *J. SIAM* 5 (1957) 74).
fn worst(values: &[f64]) -> f64 {
    let count = values.len();
    let x: Vec<f64> = (0..count).map(|i| 2.0 * i as f64 / (count - 1) as f64 - 1.0).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (mut before, mut now) = (vec![0.0; count], vec![1.0; count]);
    let (mut rest, mut last) = (values.to_vec(), 1.0);
    for degree in 0..=DEGREE {
        let norm = dot(&now, &now);
        let part = dot(&now, &rest) / norm;
        rest.iter_mut().zip(&now).for_each(|(rest, now)| *rest -= part * now);
        let shifted: Vec<f64> = now.iter().zip(&x).map(|(now, x)| now * x).collect();
        let alpha = dot(&shifted, &now) / norm;
        let beta = if degree == 0 { 0.0 } else { norm / last };
        let next = (0..count).map(|i| (x[i] - alpha) * now[i] - beta * before[i]).collect();
        (before, now, last) = (now, next, norm);
    }
    let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    largest(&rest) / largest(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_its_own_fit() {
        let cubic: Vec<f64> =
            (0..201).map(|i| f64::from(i) / 100.0 - 1.0).map(|x| 1.0 + x - 3.0 * x.powi(3)).collect();
        assert!(worst(&cubic) < 1e-13);
        let corner: Vec<f64> = (0..201).map(|i| (f64::from(i) / 100.0 - 1.0).abs()).collect();
        assert!(worst(&corner) > 1e-3);
    }

    #[test]
    fn the_ellipse_has_its_length_and_curvatures() {
        let curve = curvature(|_| (2.0, 0.5), 1.0);
        assert!(curve.len() == POINTS && curve.iter().all(|curvature| *curvature == 0.5));
    }
}
