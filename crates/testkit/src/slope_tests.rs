use super::*;
use crate::ivp::integrate;
use crate::planar::{self, Beam, Body, End, Mechanism};
use crate::strip::{Level, weightless};
use crate::{assert_close, assert_close_all};
use std::f64::consts::FRAC_PI_2;

fn degrees(angle: f64) -> f64 {
    angle * PI / 180.0
}

#[test]
fn level_strips_agree_with_elliptic_integrals() {
    for middle in [0.05, 0.2, 0.39] {
        let (plain, without) = (Slope::new(0.0, 0.0).at_middle(middle).unwrap(), weightless);
        assert_close(without(plain.push).unwrap().middle, middle, 1e-13, "w, weightless");
        assert_close(without(plain.push).unwrap().slide, plain.slide, 1e-13, "u1, weightless");
        for (angle, weight) in [(0.0, 0.8), (PI, -0.8)] {
            let found = Slope::new(0.8, angle).at_middle(middle).unwrap();
            let exact = Level { weight }.at_middle(middle).unwrap();
            assert_close(found.push, exact.push, 1e-11, "n");
            assert_close(found.slide, exact.slide, 1e-12, "u1");
        }
    }
    for weight in [1e-4, 0.1, 0.8, 1.6] {
        let (found, exact) = (Slope::new(weight, 0.0).fold().unwrap(), Level { weight }.fold().unwrap());
        assert_close(found.push, exact.push, 1e-12, "n");
        assert_close(found.middle, exact.middle, 1e-11, "w");
        assert_close(found.slide, exact.slide, 1e-11, "u1");
    }
}

#[test]
fn the_folds_have_their_known_pushes() {
    for (weight, angle, push) in [(0.8, 45.0, 16.8954), (1.6, 0.0, 18.3031), (1.6, 45.0, 17.2785)] {
        assert_close(Slope::new(weight, degrees(angle)).fold().unwrap().push, push, 5.1e-5, "n");
    }
    assert_close(Slope::new(0.8, FRAC_PI_2).pitchfork().unwrap(), 15.599_394_277, 5.1e-10, "wall, 0.8");
    assert_close(Slope::new(1.6, FRAC_PI_2).pitchfork().unwrap(), 15.197_576_774, 5.1e-10, "wall, 1.6");
}

#[test]
fn a_strip_a_tenth_as_heavy_as_the_unit_has_the_printed_pushes() {
    // Table 5.2 as printed, one decimal.
    for (weight, printed) in [(0.8, [17.5, 16.9, 15.5]), (1.6, [18.3, 17.3, 15.1])] {
        for (angle, printed) in [0.0, 45.0, 90.0].into_iter().zip(printed) {
            let strip = Slope { beam_weight: 0.1, ..Slope::new(weight, degrees(angle)) };
            let push = if angle < 90.0 { strip.fold().unwrap().push } else { strip.pitchfork().unwrap() };
            assert_close(push, printed, 0.05, "n");
        }
    }
}

#[test]
fn on_a_wall_the_halves_are_columns_under_different_pushes() {
    // Both halves in closed form: w = a + bs + c cos ks + d sin ks, clamped, joined smoothly with the same shear, clamped.
    for weight in [0.8, 1.6] {
        let push = Slope::new(weight, FRAC_PI_2).pitchfork().unwrap();
        let [p, q] = [(push + weight) * UNIT, push * UNIT];
        // From θ and M at the start of a half under the push p and the force across V: y, θ, M at its end.
        let half = |p: f64, [y, angle, moment, shear]: [f64; 4]| {
            let k = p.sqrt();
            let (s, c) = (0.5 * k).sin_cos();
            // M' = -p θ - V with θ' = M: θ + V/p swings.
            let swing = angle + shear / p;
            [
                y + swing * s / k + moment * (1.0 - c) / p - 0.5 * shear / p,
                swing * c + moment * s / k - shear / p,
                moment * c - k * swing * s,
                shear,
            ]
        };
        let end = |start: [f64; 4]| half(q, half(p, start));
        let (by_moment, by_shear) = (end([0.0, 0.0, 1.0, 0.0]), end([0.0, 0.0, 0.0, 1.0]));
        let determinant = by_moment[0] * by_shear[1] - by_moment[1] * by_shear[0];
        assert_close(determinant, 0.0, 1e-14, "both clamps hold");
    }
}

#[test]
fn a_strip_that_stretches_buckles_at_its_shorter_length() {
    let strip = Slope { stretch: 1e-3, ..Slope::new(0.0, FRAC_PI_2) };
    let load = strip.pitchfork().unwrap() * UNIT;
    assert_close(load * (1.0 - 1e-3 * load), 4.0 * PI * PI, 1e-11, "N (1 - N/EA) = 4π²");
}

#[test]
fn a_strip_with_everything_closes_by_extrapolation() {
    for angle in [0.0, 0.8, 2.5] {
        let strip = Slope { weight: 0.8, beam_weight: 0.9, angle, stretch: 2e-4 };
        let y = strip.point(&strip.curve(), 0.25).unwrap();
        let (s, c) = angle.sin_cos();
        let rates = |_: f64, y: &[f64; 6]| {
            let (sine, cosine) = y[2].sin_cos();
            let length = 1.0 + 2e-4 * (y[4] * cosine + y[5] * sine);
            let (dx, dy) = (length * cosine, length * sine);
            [dx, dy, y[3], dy * y[4] - dx * y[5], 0.9 * UNIT * s, 0.9 * UNIT * c]
        };
        // Push and weights balance the clamp's force along the strip.
        let along = -(y[PUSH] + 1.7 * s) * UNIT;
        let mut middle = integrate(rates, [0.0, 0.0, 0.0, y[MOMENT], along, y[SHEAR]], 0.0, 0.5, 32)[32].1;
        middle[4] += 0.8 * UNIT * s;
        middle[5] += 0.8 * UNIT * c;
        let end = integrate(rates, middle, 0.5, 1.0, 32)[32].1;
        assert_close_all(&[middle[1], end[1], end[2]], &[0.25, 0.0, 0.0], 1e-12, "middle, end, its angle");
        assert_close(end[0] - 1.0, strip.shape(&y).slide, 1e-12, "u1");
        assert_close(end[4], -y[PUSH] * UNIT, 1e-12, "the push");
    }
}

#[test]
fn a_mechanism_of_two_beams_and_two_bodies_has_the_same_shape() {
    let strip = Slope { stretch: 1e-4, ..Slope::new(0.8, degrees(120.0)) };
    let beam =
        |start: End, end: End| Beam { length: 0.5, bending: 1.0, stretch: 1e-4, curvature: 0.0, start, end };
    let at = |f: f64| Mechanism {
        beams: vec![
            beam(End::clamp(None, [0.0; 3]), End::clamp(Some(0), [0.0; 3])),
            beam(End::clamp(Some(0), [0.0; 3]), End::clamp(Some(1), [0.0; 3])),
        ],
        bodies: vec![
            Body {
                rest: [0.5, 0.0, 0.0],
                held: [None; 3],
                load: [-0.8 * UNIT * f * degrees(120.0).sin(), -0.8 * UNIT * f * degrees(120.0).cos(), 0.0],
            },
            Body {
                rest: [1.0, 0.0, 0.0],
                held: [None, Some(0.0), Some(0.0)],
                load: [-17.0 * UNIT * f, 0.0, 0.0],
            },
        ],
    };
    let found = planar::solve(&at, 20).unwrap();
    let shape = strip.at_middle(found.poses[0][1]).unwrap();
    assert_close(shape.push, 17.0, 1e-10, "n");
    assert_close(shape.slide, found.poses[1][0] - 1.0, 1e-12, "u1");
}

#[test]
fn the_crossing_slopes_are_found() {
    let wide = [degrees(60.0), degrees(85.0)];
    let crossing = crossing_slope([0.8, 1.6], wide).unwrap();
    assert_close(crossing.to_degrees(), 72.748, 5.1e-4, "n(0.8) = n(1.6)");
    let top = highest_weight(crossing, [0.8, 1.6]).unwrap();
    assert_close(turning_slope(top, wide).unwrap(), crossing, 1e-9, "both ways to the top");
    let turning = [0.8, 1.6].map(|weight| turning_slope(weight, wide).unwrap().to_degrees());
    assert_close_all(&turning, &[75.748_4, 69.810_3], 5e-4, "dn/dW = 0");
}
