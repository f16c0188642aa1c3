pub(crate) mod dual;

use super::*;

fn slender(stretch: f64) -> LawTable {
    LawTable::Slender(vec![Slender { k0: [0.3, -0.5, 0.8], stretch, bend: [1.3, 1.0, 0.4] }])
}

pub(crate) fn laws() -> Vec<LawTable> {
    let mut compliance = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..6 {
            compliance[i][j] = 0.05 / (1.0 + (i + j) as f64) + if i == j { 0.7 } else { 0.0 };
        }
    }
    vec![
        slender(0.0),
        slender(0.02),
        LawTable::Shearable(vec![Shearable {
            k0: [0.0, 0.2, -0.1],
            shear: [0.01, 0.03, 0.02],
            bend: [1.3, 1.0, 0.4],
        }]),
        LawTable::Coupled(vec![Coupled { k0: [0.1, 0.0, -0.4], compliance }]),
    ]
}

pub(crate) fn piece(laws: LawTable, loaded: bool) -> Piece {
    let loads = if loaded {
        vec![LoadSample {
            dead_force: [0.1, -0.6, 0.4],
            dead_moment: [0.2, 0.1, -0.3],
            section_force: [0.5, 0.2, -0.2],
            section_moment: [-0.1, 0.3, 0.1],
        }]
    } else {
        Vec::new()
    };
    Piece { length: 1.2, steps: 3, laws, loads, foundation: None }
}

pub(crate) fn start<const W: usize>() -> RodState<W> {
    let norm = 30.0_f64.sqrt();
    RodState {
        rotation: [1.0 / norm, 2.0 / norm, -3.0 / norm, 4.0 / norm],
        position: [0.3, -2.0, 1.0],
        force: [0.7, -1.1, 0.4],
        moment: [-0.2, 0.5, 0.9],
        d: [[0.0; W]; 12],
    }
}

/// The state after turning by `theta`, moving by `p`, and adding to the wrench.
pub(crate) fn moved(base: &RodState<1>, x: &[f64; 12]) -> RodState<1> {
    let angle = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
    let s = if angle == 0.0 { 0.5 } else { (0.5 * angle).sin() / angle };
    let mut out = *base;
    out.rotation = unit_product(&[(0.5 * angle).cos(), s * x[0], s * x[1], s * x[2]], &base.rotation);
    for i in 0..3 {
        out.position[i] += x[3 + i];
        out.force[i] += x[6 + i];
        out.moment[i] += x[9 + i];
    }
    out
}

/// (small turning, position, force, moment) from `a` to `b`.
pub(crate) fn difference(a: &RodState<1>, b: &RodState<1>) -> [f64; 12] {
    let conjugate = [a.rotation[0], -a.rotation[1], -a.rotation[2], -a.rotation[3]];
    let q = unit_product(&b.rotation, &conjugate);
    let mut out = [0.0; 12];
    for i in 0..3 {
        out[i] = 2.0 * q[1 + i] * q[0].signum();
        out[3 + i] = b.position[i] - a.position[i];
        out[6 + i] = b.force[i] - a.force[i];
        out[9 + i] = b.moment[i] - a.moment[i];
    }
    out
}

/// Central differences of order six: an error of about 1e-11 at this step on these smooth maps.
#[test]
fn derivative_lanes_are_the_derivative_of_the_discrete_map() {
    for laws in laws() {
        for loaded in [false, true] {
            let piece = piece(laws.clone(), loaded);
            let mut lanes: RodState<16> = start();
            for i in 0..12 {
                lanes.d[i][1 + i] = 1.0;
            }
            advance(&piece, 0.8, &mut lanes);
            let end_at = |column: usize, x: f64| {
                let mut change = [0.0; 12];
                change[column] = x;
                let mut state = moved(&start(), &change);
                advance(&piece, 0.8, &mut state);
                state
            };
            for column in 0..12 {
                let h = 4e-3;
                let centre = end_at(column, 0.0);
                let d = |x: f64| difference(&centre, &end_at(column, x));
                let samples = [d(h), d(-h), d(2.0 * h), d(-2.0 * h), d(3.0 * h), d(-3.0 * h)];
                for row in 0..12 {
                    let f = |i: usize| samples[i][row];
                    let expected = (45.0 * (f(0) - f(1)) - 9.0 * (f(2) - f(3)) + (f(4) - f(5))) / (60.0 * h);
                    let got = lanes.d[row][1 + column];
                    // 2 sin(θ/2) stands for θ in `difference`: odd, cubic, so it cancels in this formula.
                    assert!(
                        (got - expected).abs() < 1e-10,
                        "{laws:?} loaded {loaded}: row {row} column {column}: {got} against {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn fewer_lanes_give_the_same_value() {
    for laws in laws() {
        for loaded in [false, true] {
            let piece = piece(laws.clone(), loaded);
            let mut plain: RodState<1> = start();
            let mut wide: RodState<8> = start();
            advance(&piece, 1.0, &mut plain);
            advance(&piece, 1.0, &mut wide);
            assert_eq!(plain.position, wide.position);
            assert_eq!(plain.moment, wide.moment);
        }
    }
}

#[test]
fn both_builds_of_the_kernel_give_equal_bits() {
    for laws in laws() {
        let piece = piece(laws, true);
        let (mut chosen, mut plain): (RodState<8>, RodState<8>) = (start(), start());
        chosen.d[9][1] = 1.0;
        plain.d[9][1] = 1.0;
        advance(&piece, 1.0, &mut chosen);
        dispatch(&piece, 1.0, &mut plain);
        assert_eq!(chosen.d, plain.d);
        assert_eq!(chosen.rotation, plain.rotation);
    }
}

#[test]
fn an_unloaded_piece_conserves_the_wrench_about_the_origin() {
    for laws in laws() {
        let piece = piece(laws, false);
        let before: RodState<1> = start();
        let mut after = before;
        advance(&piece, 1.0, &mut after);
        for i in 0..3 {
            let about = |s: &RodState<1>| s.moment[i] + cross(&s.position, &s.force)[i];
            assert!((about(&before) - about(&after)).abs() < 1e-14);
            assert!((before.force[i] - after.force[i]).abs() < 1e-15);
        }
    }
}

#[test]
fn distributed_load_and_conserved_wrench_agree_when_the_load_is_zero() {
    for laws in laws() {
        let free = piece(laws.clone(), false);
        let mut zero = piece(laws, false);
        zero.loads = vec![LoadSample::default()];
        zero.steps = 12;
        let free = Piece { steps: 12, ..free };
        let (mut a, mut b): (RodState<1>, RodState<1>) = (start(), start());
        advance(&free, 1.0, &mut a);
        advance(&zero, 1.0, &mut b);
        for i in 0..3 {
            assert!((a.position[i] - b.position[i]).abs() < 1e-12);
            assert!((a.moment[i] - b.moment[i]).abs() < 1e-12);
        }
    }
}
