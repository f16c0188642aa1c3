//! What must not matter does not matter: the place and attitude of the mechanism, the units, the direction in
//! which a beam is described, cutting a beam in two, names and order.

mod support;

use flexura_spatial::{Pose, Vector3, exp};
use flexura_testkit::assert_close;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use support::answer::{Answer, ask_for};
use support::mechanism::{ARM, Draw, MAST, WHIP, mechanism};
use support::transform::{in_units, moved, permuted, place_of, reversed, split};

const TOLERANCE: f64 = 1e-9;

/// Few cases, always the same ones.
fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 12,
        rng_seed: RngSeed::Fixed(20),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

prop_compose! {
    fn draws()(strength in 0.3..1.0f64, x in 0.2..1.0f64, y in -1.0..1.0f64, z in -1.0..1.0f64) -> Draw {
        Draw { strength, direction: [x, y, z] }
    }
}

prop_compose! {
    fn motions()(
        turn in prop::array::uniform3(-1.8..1.8f64),
        shift in prop::array::uniform3(-30.0..30.0f64),
    ) -> Pose {
        Pose::new(exp(&Vector3::from(turn)), Vector3::from(shift))
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn turning_and_moving_the_whole_mechanism_turns_and_moves_the_answer(draw in draws(), motion in motions()) {
        let model = mechanism(&draw);
        let expected = Answer::of(&model).moved(&motion);
        let found = Answer::of(&moved(&model, &motion));
        found.assert_same(&expected, 1.0, 1.0, TOLERANCE);
        assert_close(found.energy, expected.energy, TOLERANCE, "energy");
    }

    #[test]
    fn other_units_give_the_same_answer_in_them(draw in draws(), length in -3..=3i32, force in -4..=6i32) {
        let (a, b) = (10f64.powi(length), 10f64.powi(force));
        let model = mechanism(&draw);
        let expected = Answer::of(&model).in_units(a, b);
        let found = Answer::of(&in_units(&model, a, b));
        found.assert_same(&expected, a, b, TOLERANCE);
        assert_close(found.energy / (a * b), expected.energy / (a * b), TOLERANCE, "energy");
    }

    #[test]
    fn a_beam_described_from_its_other_end_is_the_same_beam(draw in draws(), beam in 0..3usize) {
        prop_assert!([MAST, ARM, WHIP].contains(&beam));
        let model = mechanism(&draw);
        let jump = 1.0 - [0.3, 0.3, 0.4][beam];
        let expected = Answer::of(&model).reversed(beam).without_places(beam, &[jump]);
        let found = Answer::of(&reversed(&model, beam)).without_places(beam, &[jump]);
        found.assert_same(&expected, 1.0, 1.0, TOLERANCE);
    }

    #[test]
    fn a_beam_cut_in_two_by_a_massless_body_is_the_same_beam(
        draw in draws(),
        fraction in 0.1..0.9f64,
        beam in 0..2usize,
    ) {
        // A load at the cut itself would belong to either half.
        prop_assume!((fraction - 0.3).abs() > 1e-3);
        let mut whole = mechanism(&draw);
        let mut halves = split(&whole, beam, fraction);
        let last = halves.beams.len() - 1;
        let within: Vec<f64> = (0..=16).map(|i| f64::from(i) / 16.0).collect();
        ask_for(&mut halves, beam, &within);
        ask_for(&mut halves, last, &within);
        let first: Vec<f64> = within.iter().map(|t| t * fraction).collect();
        let second: Vec<f64> = within.iter().map(|t| fraction + t * (1.0 - fraction)).collect();
        ask_for(&mut whole, beam, &first);
        ask_for(&mut whole, beam, &second);
        let (expected, mut found) = (Answer::of(&whole), Answer::of(&halves));
        // The halves' places as fractions of the whole.
        let mut places = std::mem::take(&mut found.beams[beam]);
        places.iter_mut().for_each(|place| place.0 *= fraction);
        let mut rest = found.beams.remove(last);
        rest.iter_mut().for_each(|place| place.0 = fraction + place.0 * (1.0 - fraction));
        places.extend(rest);
        let knot = found.bodies.pop().expect("the body at the cut");
        // Compare where both were sampled.
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for place in &places {
            if let Some(same) = expected.beams[beam].iter().find(|other| (other.0 - place.0).abs() < 1e-12) {
                a.push(*place);
                b.push(*same);
            }
        }
        prop_assert!(a.len() >= 33, "only {} common places", a.len());
        found.beams[beam] = a;
        let mut expected = expected;
        let cut = expected.beams[beam].iter().find(|place| (place.0 - fraction).abs() < 1e-12).copied();
        expected.beams[beam] = b;
        found.assert_same(&expected, 1.0, 1.0, TOLERANCE);
        let cut = cut.expect("a sample at the cut");
        assert_close((knot.position - cut.1.position).norm(), 0.0, TOLERANCE, "the body at the cut");
    }

    #[test]
    fn names_and_order_do_not_matter(draw in draws(), order in Just((0..6).collect::<Vec<usize>>()).prop_shuffle()) {
        let model = mechanism(&draw);
        let expected = Answer::of(&model);
        let found = Answer::of(&permuted(&model, &order));
        let mut sorted = expected.clone();
        for old in 0..expected.beams.len() {
            sorted.beams[place_of(&order, old, expected.beams.len())] = expected.beams[old].clone();
        }
        for old in 0..expected.bodies.len() {
            sorted.bodies[place_of(&order, old, expected.bodies.len())] = expected.bodies[old];
        }
        for old in 0..expected.tensions.len() {
            sorted.tensions[place_of(&order, old, expected.tensions.len())] = expected.tensions[old];
        }
        found.assert_same(&sorted, 1.0, 1.0, TOLERANCE);
        assert_close(found.energy, expected.energy, TOLERANCE, "energy");
    }
}
