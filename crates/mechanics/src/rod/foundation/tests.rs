use super::*;
use crate::ode::NODES;
use crate::rod::propagate::tests::{difference, laws, moved, piece, start};
use crate::rod::{Channel, ChannelSample, Piece, RodKernel, RodState, advance, advance_tendons};

/// A foundation with all it can have: a full K, a hardening and a softening law along directions that turn.
fn foundation(length: f64, steps: usize) -> Foundation {
    let places = (0..steps * STAGES)
        .map(|i| length * ((i / STAGES) as f64 + NODES[i % STAGES]) / steps as f64)
        .collect::<Vec<_>>();
    let samples = places.iter().map(|s| FoundationSample {
        rest: [0.2 + 0.9 * s, -2.1 + 0.1 * s * s, 0.8 - 0.2 * s],
        stiffness: [[3.0 + s, 0.4, -0.2], [0.4, 2.0, 0.5 * s], [-0.2, 0.5 * s, 1.0]],
    });
    let law = |text: &str| Resistance { force: Function::parse(text, "u").unwrap(), length: 0.5, unit: 1.6 };
    let along = |a: f64| places.iter().map(|s| [(a + s).cos(), (a + s).sin(), 0.0]).collect();
    let (first, second) = (law("2*u + 5*u^3"), law("-1.5*sin(u) + 0.3*u"));
    let spin = Spinning {
        axis: [0.6, 0.0, 0.8],
        through: [0.3, -0.1, 0.2],
        inertia: places.iter().map(|s| (0.3 + 0.2 * s, [0.06, 0.02 + 0.02 * s, 0.04])).collect(),
    };
    Foundation {
        samples: samples.collect(),
        resistances: vec![(first, along(0.3)), (second, along(1.9))],
        spin: Some(spin),
    }
}

fn on_foundation(piece: Piece) -> Piece {
    Piece { foundation: Some(foundation(piece.length, piece.steps)), ..piece }
}

/// Carries along a piece, with a tendon if asked.
fn carry<const W: usize>(piece: &Piece, tendon: bool, state: &mut RodState<W>)
where
    RodState<W>: RodKernel<W>,
{
    if tendon {
        let channel =
            Channel { tendon: 0, samples: vec![ChannelSample { offset: [0.05, -0.04], slope: [0.0; 2] }] };
        let mut tension = [0.0; W];
        tension[0] = 1.5;
        advance_tendons(piece, &[channel], &[tension], 0.8, state, &mut [[0.0; W]]);
    } else {
        advance(piece, 0.8, state);
    }
}

/// Central differences of order six, as for the kernel without a foundation.
#[test]
fn derivative_lanes_are_the_derivative_of_the_discrete_map() {
    for (laws, (loaded, tendon)) in laws()
        .into_iter()
        .flat_map(|laws| [(false, false), (true, false), (true, true)].map(|c| (laws.clone(), c)))
    {
        let piece = on_foundation(piece(laws.clone(), loaded));
        let mut lanes: RodState<16> = start();
        for i in 0..12 {
            lanes.d[i][1 + i] = 1.0;
        }
        carry(&piece, tendon, &mut lanes);
        for column in 0..12 {
            let h = 4e-3;
            let end_at = |x: f64| {
                let mut change = [0.0; 12];
                change[column] = x;
                let mut state = moved(&start(), &change);
                carry(&piece, tendon, &mut state);
                state
            };
            let centre = end_at(0.0);
            let d = |x: f64| difference(&centre, &end_at(x));
            let samples = [d(h), d(-h), d(2.0 * h), d(-2.0 * h), d(3.0 * h), d(-3.0 * h)];
            for row in 0..12 {
                let f = |i: usize| samples[i][row];
                let expected = (45.0 * (f(0) - f(1)) - 9.0 * (f(2) - f(3)) + (f(4) - f(5))) / (60.0 * h);
                let got = lanes.d[row][1 + column];
                assert!(
                    (got - expected).abs() < 2e-10 * expected.abs().max(1.0),
                    "{laws:?} loaded {loaded} tendon {tendon}: row {row} column {column}: {got} against {expected}"
                );
            }
        }
    }
}

#[test]
fn a_foundation_without_stiffness_is_none() {
    for laws in laws() {
        let plain = Piece { steps: 8, ..piece(laws, true) };
        let mut empty = foundation(plain.length, plain.steps);
        empty.samples.iter_mut().for_each(|sample| sample.stiffness = [[0.0; 3]; 3]);
        empty.resistances.clear();
        empty.spin = None;
        let founded = Piece { foundation: Some(empty), ..plain.clone() };
        let (mut a, mut b): (RodState<1>, RodState<1>) = (start(), start());
        advance(&plain, 0.8, &mut a);
        advance(&founded, 0.8, &mut b);
        assert_eq!(a.position, b.position);
        assert_eq!(a.moment, b.moment);
    }
}

/// The map of small changes of (turning, position) and (moment, force) is symplectic, as it comes from an energy: for two
/// changes a and b, δx_a·δw_b - δx_b·δw_a is the same at both ends. With plain changes of the moment it has the part
/// -M·(θ_a × θ_b) besides.
#[test]
fn the_foundation_comes_from_an_energy() {
    for laws in laws() {
        let fine = on_foundation(Piece { steps: 24, ..piece(laws, false) });
        let mut lanes: RodState<16> = start();
        for i in 0..12 {
            lanes.d[i][1 + i] = 1.0;
        }
        let before = lanes;
        advance(&fine, 1.0, &mut lanes);
        let form = |state: &RodState<16>, a: usize, b: usize| {
            let column =
                |j: usize, first: usize| -> [f64; 3] { std::array::from_fn(|i| state.d[first + i][1 + j]) };
            let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
            let work = |a: usize, b: usize| dot(column(a, 0), column(b, 9)) + dot(column(a, 3), column(b, 6));
            work(a, b)
                - work(b, a)
                - dot(state.moment, crate::rod::balance::cross(&column(a, 0), &column(b, 0)))
        };
        for (a, b) in (0..12).flat_map(|a| (0..a).map(move |b| (a, b))) {
            let (start, end) = (form(&before, a, b), form(&lanes, a, b));
            assert!((start - end).abs() < 1e-9, "{a} {b}: {start} against {end}");
        }
    }
}
