//! Robots against closed forms, differences and energy.

use super::robot::{Robot, RobotTube};
use super::*;
use flexura_testkit::tubes::TwoTubes;
use flexura_testkit::{assert_close, check_jacobian};
use nalgebra::DMatrix;
use std::f64::consts::{FRAC_PI_2, PI};

fn tube(bending: f64, torsion: f64, curvature: f64, reach: f64, turn: f64, back: f64) -> RobotTube {
    RobotTube { bending, torsion, rest: [0.0, 0.0, curvature], reach, turn, back }
}

/// Three tubes that end one after the other, in guides, with a force on the tip.
fn robot() -> Robot {
    Robot {
        tubes: vec![
            tube(1.0, 0.77, 1.1, 1.0, 0.4, 0.3),
            tube(2.2, 1.7, 0.8, 0.7, -0.9, 0.2),
            tube(4.1, 3.2, 0.4, 0.35, 1.3, 0.1),
        ],
        force: [0.2, -0.3, 0.5],
        steps: 8,
    }
}

#[test]
fn two_tubes_turn_against_each_other_as_a_pendulum() {
    let form = TwoTubes {
        bending: [1.0, 2.5],
        torsion: [0.8, 1.9],
        curvature: [1.5, 1.1],
        length: 0.9,
        tip_angle: 1.3,
    };
    let turn = form.angle(0.0);
    let tubes = [0, 1].map(|i| {
        let turn = if i == 0 { 0.3 } else { 0.3 + turn };
        tube(form.bending[i], form.torsion[i], form.curvature[i], form.length, turn, 0.0)
    });
    let robot = Robot { tubes: tubes.to_vec(), force: [0.0; 3], steps: 24 };
    let x = robot.equilibrium();
    let soft = 1.0 / form.torsion[0] + 1.0 / form.torsion[1];
    assert_close(x[3], form.twist(0.0) / soft, 1e-11, "the torque at the guide");
    let state = robot.shoot(&x).states[0];
    for part in [0.25, 0.5, 0.75, 1.0] {
        let mut state = state;
        let mut piece = robot.pieces().remove(0);
        piece.length *= part;
        advance_tubes(&piece, 1.0, &mut state);
        let s = part * form.length;
        assert_close(state.angle[0][0], form.angle(s), 1e-11, "θ");
        assert_close(state.torque[0][0], form.twist(s) / soft, 1e-11, "m");
        assert_close(state.first_torque()[0], -form.twist(s) / soft, 1e-11, "-m");
    }
}

#[test]
fn tubes_that_cannot_twist_share_the_weighted_mean_of_their_curvatures() {
    let stiff = f64::INFINITY;
    let tubes = vec![
        tube(1.0, stiff, 1.1, 1.0, 0.4, 0.3),
        tube(2.2, stiff, 0.8, 1.0, -0.9, 0.2),
        tube(4.1, stiff, 0.4, 1.0, 2.3, 0.1),
    ];
    let (mut y, mut z) = (0.0, 0.0);
    for t in &tubes {
        // Rest curvature about e3 bends towards e2, which the tube's turn takes round.
        y += t.bending / 7.3 * t.rest[2] * t.turn.cos();
        z += t.bending / 7.3 * t.rest[2] * t.turn.sin();
    }
    let robot = Robot { tubes, force: [0.0; 3], steps: 12 };
    // Torques change no angle: they follow from the ends alone, and the moment is nowhere.
    let mut state = robot.shoot(&[0.0; 5]).states[0];
    advance_tubes(&robot.pieces()[0], 1.0, &mut state);
    let kappa = y.hypot(z);
    let aside = (1.0 - kappa.cos()) / kappa;
    let expected = [kappa.sin() / kappa, aside * y / kappa, aside * z / kappa];
    for i in 0..3 {
        assert_close(state.rod.position[i], expected[i], 1e-13, "the tip of the arc");
    }
}

#[test]
fn it_does_not_matter_which_tube_is_called_the_first() {
    let mut a = robot();
    a.tubes.iter_mut().for_each(|t| t.reach = 0.8);
    a.tubes[1].rest = [0.4, -0.3, 0.9];
    a.steps = 16;
    let mut b = a.clone();
    b.tubes.rotate_left(1);
    let (x, y) = (a.equilibrium(), b.equilibrium());
    let (first, second) = (a.shoot(&x), b.shoot(&y));
    let (p, q) = (first.states.last().unwrap(), second.states.last().unwrap());
    for i in 0..3 {
        assert_close(p.rod.position[i], q.rod.position[i], 1e-12, "the tip");
        assert_close(x[i], y[i], 1e-12, "the moment at the guide");
    }
    assert_close(p.first_torque()[0], q.torque[1][0], 1e-13, "no torque at the end");
    assert_close(first.states[0].first_torque()[0], y[4], 1e-12, "the torque in a's first tube");
}

#[test]
fn the_tangent_of_a_robot_agrees_with_differences() {
    let robot = robot();
    let x = robot.equilibrium();
    let shot = robot.shoot(&x);
    let n = x.len();
    // Moment, torques, turns, force.
    let lanes: Vec<usize> = (1..=5).chain(7..=9).chain(11..=13).collect();
    let analytic = DMatrix::from_fn(n + 3, lanes.len(), |i, j| {
        let tip = &shot.states.last().unwrap().rod;
        if i < n { shot.residual[i][lanes[j]] } else { tip.d[3 + i - n][lanes[j]] }
    });
    let f = |v: &[f64]| {
        let mut moved = robot.clone();
        for i in 0..3 {
            moved.tubes[i].turn = v[5 + i];
            moved.force[i] = v[8 + i];
        }
        let shot = moved.shoot(&v[..5]);
        shot.residual.iter().map(|r| r[0]).chain(shot.states.last().unwrap().rod.position).collect()
    };
    check_jacobian(f, &robot.parameters(&x), &analytic, 1e-11);
}

/// Elastic energy, guides included, less the work of the tip's force.
fn potential(robot: &Robot) -> f64 {
    let x = robot.equilibrium();
    let shot = robot.shoot(&x);
    let base = &shot.states[0];
    let mut energy = 0.0;
    let torques = [base.first_torque()[0], base.torque[0][0], base.torque[1][0]];
    for (t, m) in robot.tubes.iter().zip(torques) {
        energy += 0.5 * t.back * m * m / t.torsion;
    }
    for (piece, state) in robot.pieces().iter().zip(&shot.states) {
        let mut y = [Dual64::from(0.0); 20];
        for i in 0..4 {
            y[i] = Dual64::from(state.rod.rotation[i]);
        }
        for i in 0..3 {
            y[4 + i] = Dual64::from(state.rod.position[i]);
            y[7 + i] = Dual64::from(state.rod.force[i]);
            y[10 + i] = Dual64::from(state.rod.moment[i]);
            y[13 + i] = Dual64::from(state.angle[i][0]);
            y[16 + i] = Dual64::from(state.torque[i][0]);
        }
        energy += second::propagate(piece, 1.0, y)[19].re;
    }
    let tip = shot.states.last().unwrap().rod.position;
    energy - (0..3).map(|i| tip[i] * robot.force[i]).sum::<f64>()
}

/// The hand that turns tube i at the far end of the guide holds it with the torque -m_i: dΠ/dα_i = -m_i.
#[test]
fn the_energy_changes_by_the_work_of_the_turning_hands() {
    let robot = robot();
    let x = robot.equilibrium();
    let base = robot.shoot(&x).states[0];
    let torques = [base.first_torque()[0], base.torque[0][0], base.torque[1][0]];
    for (i, torque) in torques.into_iter().enumerate() {
        let at = |turn: f64| {
            let mut moved = robot.clone();
            moved.tubes[i].turn += turn;
            potential(&moved)
        };
        let h = 0.02;
        let mut slope = 0.0;
        for (j, weight) in [0.8, -0.2, 4.0 / 105.0, -1.0 / 280.0].into_iter().enumerate() {
            let step = h * (j as f64 + 1.0);
            slope += weight * (at(step) - at(-step)) / h;
        }
        assert!(torque.abs() > 0.01);
        assert_close(slope, -torque, 1e-10, "dΠ/dα");
    }
}

/// Tubes held opposite: the tangent is singular where √c L = π/2, and with guides where
/// |β| √c tan(√c L) = 1 (Dupont et al. 2010, section V).
#[test]
fn opposite_tubes_snap_at_the_length_of_the_closed_form() {
    for back in [0.0, 0.25] {
        let form = TwoTubes {
            bending: [1.0, 2.5],
            torsion: [0.8, 1.9],
            curvature: [1.5, 1.1],
            length: 1.0,
            tip_angle: PI,
        };
        let determinant = |length: f64| {
            let tubes = [0, 1].map(|i| {
                let turn = PI * i as f64;
                tube(form.bending[i], form.torsion[i], form.curvature[i], length, turn, back)
            });
            let robot = Robot { tubes: tubes.to_vec(), force: [0.0; 3], steps: 24 };
            let shot = robot.shoot(&[0.0; 4]);
            assert!(shot.residual.iter().all(|r| r[0].abs() < 1e-14), "opposite is an equilibrium");
            robot.tangent(&shot).determinant()
        };
        let root = form.rate().sqrt();
        let (mut low, mut high) = (0.1, form.snapping_length() * 1.5);
        assert!(determinant(low) > 0.0 && determinant(high) < 0.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if determinant(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        if back == 0.0 {
            assert_close(low * root, FRAC_PI_2, 1e-11, "√c L");
        } else {
            assert_close(back * root * (low * root).tan(), 1.0, 1e-11, "|β| √c tan √c L");
        }
    }
}
