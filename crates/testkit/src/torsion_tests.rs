use super::*;
use crate::assert_close;
use crate::perturbation::{Condition, Loaded, Prestress, held};
use flexura_spatial::Vector3;
use nalgebra::SMatrix;
use std::f64::consts::PI;

const ROUND: [f64; 6] = [0.0, 0.0, 0.0, 1.3, 1.0, 1.0];

fn shaft(torque: f64) -> Prestress {
    Prestress {
        strain: Vector3::x(),
        curvature: Vector3::zeros(),
        force: Vector3::zeros(),
        moment: Vector3::new(torque, 0.0, 0.0),
    }
}

fn singular(torque: f64, start: [Condition; 6], end: [Condition; 6]) -> Vec<f64> {
    let state = |_: f64| shaft(torque);
    Loaded { length: 1.0, compliance: ROUND, state: &state }.singular_values(&start, &end, 16)
}

#[test]
fn the_printed_numbers_come_out() {
    assert_close(hockling(), 8.986_819, 5e-7, "T L/EI");
    assert_close(hockling() * 71240.0 * 0.0833 / 240.0, 222.21, 5e-3, "hockling torque");
    assert_close(michell_twist(1.3, 1.0) / 360f64.to_radians(), 2.2517, 5e-5, "turns at ν = 0.3");
}

#[test]
fn a_blocked_shaft_hockles_in_two_directions_and_not_before() {
    let [start, end] = [held([0, 1, 2, 3, 4, 5]), held([6, 1, 2, 9, 4, 5])];
    let values = singular(hockling(), start, end);
    assert!(values[1] < 1e-12 && values[2] > 1e-2, "{values:?}");
    assert!((1..44).all(|i| singular(0.2 * f64::from(i), start, end)[0] > 1e-3));
}

#[test]
fn greenhills_shaft_needs_moments_of_constant_direction() {
    let [start, end] = [held([0, 1, 2, 3, 10, 11]), held([6, 1, 2, 9, 10, 11])];
    let values = singular(greenhill(), start, end);
    assert!(values[1] < 1e-12 && values[2] > 1e-2, "{values:?}");
    assert!((1..31).all(|i| singular(0.2 * f64::from(i), start, end)[0] > 1e-3));
}

/// Moment across that follows the tilt about the drive's fork at the angle `fork`: g = T (φ·a)(a × e1).
fn hooked(torque: f64, fork: f64, along: [usize; 2]) -> [Condition; 6] {
    let (s, c) = fork.sin_cos();
    let mut conditions = held([along[0], 1, 2, along[1], 10, 11]);
    // a × e1 = (0, s, -c) for a = (0, c, s).
    for (row, part) in [(4, s), (5, -c)] {
        conditions[row][4] = -torque * part * c;
        conditions[row][5] = -torque * part * s;
    }
    conditions
}

#[test]
fn between_universal_joints_a_half_of_greenhills_torque_is_enough() {
    assert_close(universal(0.0).unwrap(), PI, 1e-12, "parallel forks");
    assert_close(universal(PI).unwrap(), PI, 1e-12, "turned by a half");
    assert_close(universal_determinant(TAU, 0.0), 0.0, 1e-12, "Greenhill's is the second");
    for between in [0.0, 0.4, 0.5 * PI, 2.0] {
        let critical = universal(between).unwrap();
        let both = |torque: f64| {
            singular(torque, hooked(torque, 0.3, [0, 3]), hooked(torque, 0.3 + between, [6, 9]))
        };
        let values = both(critical);
        assert!(values[0] < 1e-11 && values[1] > 1e-2, "{between} {values:?}");
        assert!((1..31).all(|i| both(0.1 * f64::from(i))[0] > 1e-4));
    }
}

fn ring(torsion: f64) -> Prestress {
    Prestress {
        strain: Vector3::x(),
        curvature: Vector3::new(0.0, 0.0, 1.0),
        force: Vector3::new(0.0, 0.0, torsion),
        moment: Vector3::new(torsion, 0.0, 1.0),
    }
}

#[test]
fn a_closed_ring_buckles_in_two_directions_at_michells_twist() {
    // The torsional moment is GJ times the twist per length, and the length is 2πR.
    let moment = michell_twist(1.0, 1.0 / 1.3) / (1.3 * TAU);
    assert_close(moment, 3f64.sqrt(), 1e-15, "√3 EI/R");
    let values = |torsion: f64| {
        let state = |_: f64| ring(torsion);
        let transfer = Loaded { length: TAU, compliance: ROUND, state: &state }.transfer(48);
        let mut values: Vec<f64> =
            (transfer - SMatrix::identity()).singular_values().iter().copied().collect();
        values.sort_by(f64::total_cmp);
        values
    };
    // Six rigid motions and the roll are always free.
    for part in [0.0, 0.5, 0.9, 1.1] {
        let values = values(part * moment);
        assert!(values[6] < 1e-12 && values[7] > 0.1, "{values:?}");
    }
    let values = values(moment);
    assert!(values[8] < 1e-12 && values[9] > 1.0, "{values:?}");
}

#[test]
fn half_a_ring_on_a_common_axis_buckles_in_one_direction() {
    let [start, end] = [held([0, 1, 2, 3, 4, 5]), held([0, 7, 2, 3, 10, 5])];
    let values = |torsion: f64| {
        let state = |_: f64| ring(torsion);
        Loaded { length: PI, compliance: ROUND, state: &state }.singular_values(&start, &end, 24)
    };
    let critical = values(3f64.sqrt());
    assert!(critical[0] < 1e-13 && critical[1] > 0.4, "{critical:?}");
    assert!((0..17).all(|i| values(0.1 * f64::from(i))[0] > 0.03));
}
