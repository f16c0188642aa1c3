use super::*;
use crate::bend45;
use crate::elastica::Elastica;
use crate::helix::HelixByWrench;
use crate::ivp::follower_end;
use crate::{assert_close, assert_close_vec};
use flexura_spatial::{Vector3, exp};
use std::f64::consts::{FRAC_PI_2, TAU};

const INEXTENSIBLE: [f64; 6] = [0.0, 0.0, 0.0, 1.3, 1.0, 1.0];

fn mesh(elements: usize, degree: usize) -> Mesh {
    Mesh { elements, degree }
}

fn dead(force: Vector3<f64>) -> impl Fn(f64) -> Tip {
    move |fraction| Tip::Dead(Wrench::new(force * fraction, Vector3::zeros()))
}

#[test]
fn the_planar_elastica_comes_back() {
    let rod = Rod::uniform(1.0, INEXTENSIBLE, Vector3::zeros());
    for load in [1.0, 10.0] {
        let tip = dead(Vector3::new(0.0, load, 0.0));
        let found = solve(&rod, &Pose::identity(), &tip, 4, mesh(2, 20)).expect("converges");
        let exact = Elastica::dead(load, FRAC_PI_2);
        for s in [0.0, 0.3, 0.77, 1.0] {
            let [x, y] = exact.at(s).position;
            assert_close_vec(&found.at(s).position, &Vector3::new(x, y, 0.0), 2e-13, "shape");
            assert_close(found.at(s).moment.z, exact.at(s).curvature, 2e-12, "moment");
        }
    }
}

#[test]
fn a_follower_force_agrees_with_the_integration_from_the_tip() {
    let rod = Rod::uniform(2.0, [0.01, 0.02, 0.02, 1.3, 1.0, 0.7], Vector3::new(0.2, 0.1, 0.5));
    let wrench = Wrench::new(Vector3::new(-0.5, 1.0, 0.8), Vector3::new(0.3, 0.0, -0.4));
    let tip = |fraction| Tip::Follower(wrench * fraction);
    let found = solve(&rod, &Pose::identity(), &tip, 4, mesh(2, 18)).expect("converges");
    let exact = follower_end(&rod, &wrench, 48);
    assert_close_vec(&found.tip().position, &exact.tip().position, 1e-12, "tip");
    assert_close(found.tip().pose().rotation.angle_to(&exact.tip().rotation), 0.0, 1e-12, "turn");
    assert_close_vec(&found.root().moment, &exact.root.moment, 1e-11, "clamp");
}

#[test]
fn an_extensible_rod_between_two_poses_is_the_helix_exactly() {
    let helix = HelixByWrench {
        bending_stiffness: 1.0,
        torsion_stiffness: 1.0 / 1.3,
        axial_stiffness: 40.0,
        bend: 1.4,
        torsion: 0.6,
        twist: 0.9,
    };
    let rod = Rod::uniform(1.0, [1.0 / 40.0, 0.0, 0.0, 1.3, 1.0, 1.0], Vector3::zeros());
    let tip = |f: f64| {
        let part = HelixByWrench { bend: 1.4 * f.max(1e-12), torsion: 0.6 * f, twist: 0.9 * f, ..helix };
        Tip::Pose(part.pose(1.0))
    };
    let found = solve(&rod, &Pose::identity(), &tip, 6, mesh(1, 24)).expect("converges");
    for s in [0.0, 0.2, 0.6, 1.0] {
        let state = found.at(s);
        assert_close_vec(&state.position, &helix.pose(s).position, 1e-13, "shape");
        assert_close_vec(&state.force, &helix.force(), 1e-11, "force");
        assert_close_vec(&state.moment, &helix.moment(s), 1e-11, "moment");
    }
}

#[test]
fn clamped_ends_with_a_twist_converge_to_eleven_digits() {
    let rod = Rod::uniform(1.0, [1e-4, 0.0, 0.0, 1.3, 1.0, 0.6], Vector3::new(0.0, 0.0, 0.8));
    let rest = rest_poses(&rod, 64)[64].1;
    let target = Pose::new(exp(&Vector3::new(0.9, 0.3, 1.6)), Vector3::new(0.7, 0.35, -0.1));
    let screw = (rest.inverse() * target).log();
    let tip = |f: f64| {
        Tip::Pose(
            rest * Pose::exp(&flexura_spatial::Twist {
                angular: screw.angular * f,
                linear: screw.linear * f,
            }),
        )
    };
    let coarse = solve(&rod, &Pose::identity(), &tip, 10, mesh(2, 20)).expect("converges");
    let fine = solve(&rod, &Pose::identity(), &tip, 10, mesh(2, 28)).expect("converges");
    for s in [0.0, 0.3, 0.5, 0.8, 1.0] {
        assert_close_vec(&coarse.at(s).position, &fine.at(s).position, 1e-12, "shape");
        assert_close_vec(&coarse.at(s).moment, &fine.at(s).moment, 1e-10, "moment");
    }
    assert_close_vec(&fine.tip().position, &target.position, 1e-14, "held");
    // No load between the ends: force constant, moment balanced by it.
    let (a, b) = (fine.root(), fine.tip());
    assert_close_vec(&a.force, &b.force, 1e-10, "force");
    let balance = a.moment - b.moment - (b.position - a.position).cross(&a.force);
    assert_close_vec(&balance, &Vector3::zeros(), 1e-10, "moment");
}

#[test]
fn a_small_weight_bends_a_cantilever_as_small_deflection_theory_says() {
    let weight = 1e-5;
    let mut rod = Rod::uniform(1.0, INEXTENSIBLE, Vector3::zeros());
    rod.load = Box::new(move |_| Vector3::new(0.0, -weight, 0.0));
    let found = solve(&rod, &Pose::identity(), &dead(Vector3::zeros()), 1, mesh(1, 16)).expect("converges");
    assert_close(found.tip().position.y / weight, -0.125, 1e-9, "qL⁴/8EI");
    assert_close(found.root().force.y / weight, -1.0, 1e-9, "qL");
    assert_close(found.root().moment.z / weight, -0.5, 1e-9, "qL²/2");
}

#[test]
fn a_pinned_end_carries_no_moment() {
    let rod = Rod::uniform(1.0, [1e-3, 0.0, 0.0, 1.3, 1.0, 1.0], Vector3::new(0.0, 0.0, 0.5));
    let rest = rest_poses(&rod, 64)[64].1.position;
    let to = rest + Vector3::new(-0.1, 0.05, 0.1);
    let tip = |f: f64| Tip::Pinned { position: rest + (to - rest) * f, moment: Vector3::zeros() };
    let found = solve(&rod, &Pose::identity(), &tip, 5, mesh(1, 24)).expect("converges");
    assert_close_vec(&found.tip().position, &to, 1e-14, "held");
    assert_close_vec(&found.tip().moment, &Vector3::zeros(), 1e-12, "free to turn");
}

#[test]
fn the_45_degree_bend_has_all_printed_digits() {
    for reference in bend45::REFERENCES.iter().filter(|r| r.converged) {
        let found = solve(
            &bend45::rod(reference.torsion_constant),
            &bend45::clamp(),
            &dead(Vector3::new(0.0, 0.0, reference.load)),
            6,
            mesh(2, 20),
        )
        .expect("converges");
        let displacement = found.tip().position - bend45::tip();
        assert_close_vec(&displacement, &reference.displacement, 9e-5, reference.source);
    }
}

#[test]
fn a_rolled_up_beam_closes() {
    let rod = Rod::uniform(1.0, INEXTENSIBLE, Vector3::zeros());
    let tip = |f: f64| Tip::Dead(Wrench::new(Vector3::zeros(), Vector3::new(0.0, 0.0, TAU * f)));
    let found = solve(&rod, &Pose::identity(), &tip, 8, mesh(2, 20)).expect("converges");
    assert_close_vec(&found.tip().position, &Vector3::zeros(), 1e-12, "closed");
}

#[test]
fn varying_rest_curvature_and_load_balance_globally_and_converge() {
    let rod = || Rod {
        length: 1.5,
        compliance: [1e-3, 2e-3, 2e-3, 1.3, 1.0, 0.7],
        rest: Box::new(|s| Vector3::new(0.4 * s, 0.2, (2.0 * s).sin())),
        load: Box::new(|s| Vector3::new(0.1, -1.0 - s, 0.4 * s * s)),
        reaction: None,
    };
    let tip = |f: f64| Tip::Follower(Wrench::new(Vector3::new(0.2, 0.1, 0.5), Vector3::y()) * f);
    let coarse = solve(&rod(), &Pose::identity(), &tip, 4, mesh(1, 24)).expect("converges");
    let fine = solve(&rod(), &Pose::identity(), &tip, 4, mesh(2, 20)).expect("converges");
    for s in [0.0, 0.4, 0.75, 1.1, 1.5] {
        assert_close_vec(&coarse.at(s).position, &fine.at(s).position, 1e-12, "shape");
        assert_close_vec(&coarse.at(s).moment, &fine.at(s).moment, 1e-12, "moment");
    }
    // ∫q ds is known, and the moment of the load is the sum over the shape (Simpson's rule).
    let (root, end) = (fine.root(), fine.tip());
    let total = Vector3::new(0.15, -1.5 - 1.125, 0.4 * 1.5f64.powi(3) / 3.0);
    assert_close_vec(&(root.force - end.force), &total, 1e-13, "force");
    let n = 400;
    let moment = (0..=n)
        .map(|i| {
            let s = 1.5 * f64::from(i) / f64::from(n);
            let weight = if i == 0 || i == n { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            fine.at(s).position.cross(&(rod().load)(s)) * (weight * 1.5 / f64::from(n) / 3.0)
        })
        .sum::<Vector3<f64>>();
    let balance = root.moment - end.moment - end.position.cross(&end.force) - moment;
    assert_close_vec(&balance, &Vector3::zeros(), 1e-9, "moment");
}
