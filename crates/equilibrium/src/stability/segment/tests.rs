//! The stiffness of a stretch against differences of the carried state, and what Hamilton's equations promise.

use super::*;
use flexura_mechanics::rod::{
    Channel, ChannelSample, Coupled, LawTable, LoadSample, Piece, Shearable, Slender,
};
use flexura_spatial::{Pose, Twist, Wrench, exp, left_jacobian, log};
use nalgebra::{SMatrix, SVector};

type Matrix12 = SMatrix<f64, 12, 12>;
type Vector12 = SVector<f64, 12>;

/// Numbers in (-1, 1) that look random and repeat (S. Vigna's splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self, size: f64) -> V {
        V::new(self.next(), self.next(), self.next()) * size
    }
}

/// A stretch with what acts on it.
struct Case {
    name: &'static str,
    stretch: Stretch,
    pulls: Vec<Pull>,
    /// Has every wrench a strain, so that the clamped stiffness exists?
    regular: bool,
    /// Does it shear, so that this stiffness is moderate?
    soft: bool,
}

const LENGTH: f64 = 0.35;
const STEPS: usize = 12;
const K0: [f64; 3] = [0.3, -0.8, 1.1];

fn coupled() -> Coupled {
    // A Aᵀ with a full A: any positive compliance.
    let a = Matrix6::from_fn(|i, j| {
        let size = if i < 3 { 0.12 } else { 1.0 };
        size * (if i == j { 1.0 } else { 0.3 * ((3 * i + 5 * j) as f64).sin() })
    });
    let c = a * a.transpose();
    Coupled { k0: K0, compliance: std::array::from_fn(|i| std::array::from_fn(|j| c[(i, j)])) }
}

fn cases() -> Vec<Case> {
    let bend = [1.3, 1.0, 0.4];
    let slender = |stretch| LawTable::Slender(vec![Slender { k0: K0, stretch, bend }]);
    let straight = LawTable::Slender(vec![Slender { k0: [0.0; 3], stretch: 0.0, bend }]);
    let shearable = || LawTable::Shearable(vec![Shearable { k0: K0, shear: [0.02, 0.05, 0.03], bend }]);
    let weight = LoadSample { dead_force: [0.7, -1.9, 1.2], ..LoadSample::default() };
    let case = |name, laws: LawTable, loads, regular| Case {
        soft: !matches!(laws, LawTable::Slender(_)),
        name,
        stretch: Stretch {
            look: crate::look::Look::default(),
            s: [0.0, LENGTH],
            piece: Piece { length: LENGTH, steps: STEPS, laws, loads, foundation: None },
            channels: Vec::new(),
            jumps: Vec::new(),
        },
        pulls: Vec::new(),
        regular,
    };
    let mut all = vec![
        case("slender", slender(0.0), Vec::new(), true),
        case("straight", straight, Vec::new(), false),
        case("stretching", slender(0.05), Vec::new(), true),
        case("shearable", shearable(), Vec::new(), true),
        case("coupled", LawTable::Coupled(vec![coupled()]), Vec::new(), true),
        case("slender under its weight", slender(0.0), vec![weight], true),
        case("shearable under its weight", shearable(), vec![weight], true),
    ];
    let mut tendons = case("two tendons", LawTable::Coupled(vec![coupled()]), vec![weight], true);
    let channel = |tendon, offset, slope| Channel { tendon, samples: vec![ChannelSample { offset, slope }] };
    tendons.stretch.channels = vec![channel(0, [0.1, 0.02], [0.0; 2]), channel(1, [-0.05, 0.06], [0.0; 2])];
    tendons.pulls = [0.9, 0.4].map(|tension| Pull { tension, unknown: false }).to_vec();
    all.push(tendons);
    all
}

fn state(pose: &Pose, wrench: &Wrench) -> Plain {
    crate::shooting::plain(pose, wrench)
}

fn random_state(random: &mut Random) -> Plain {
    let pose = Pose::new(exp(&random.vector(2.0)), random.vector(1.0));
    state(&pose, &Wrench::new(random.vector(1.5), random.vector(0.8)))
}

/// Canonical coordinates beside a state: turning θ and shift, and J_l(θ)ᵀ M and force, of which (θ, J_lᵀ M) are conjugate since
/// a virtual turning is J_l(θ) dθ.
fn beside(at: &Plain, z: &Vector12) -> Plain {
    let turn = V::new(z[0], z[1], z[2]);
    let pose = pose_of(at);
    let moved = Pose::new(exp(&turn) * pose.rotation, pose.position + V::new(z[3], z[4], z[5]));
    let moment = V::from(at.moment) + V::new(z[6], z[7], z[8]);
    let plain = left_jacobian(&turn).transpose().try_inverse().expect("a small turning") * moment;
    state(&moved, &Wrench::new(V::from(at.force) + V::new(z[9], z[10], z[11]), plain))
}

fn coordinates(of: &Plain, at: &Plain) -> Vector12 {
    let (here, home) = (pose_of(of), pose_of(at));
    let turn = log(&(here.rotation * home.rotation.inverse()));
    let shift = here.position - home.position;
    let moment = left_jacobian(&turn).transpose() * V::from(of.moment) - V::from(at.moment);
    let force = V::from(of.force) - V::from(at.force);
    Vector12::from_iterator(turn.iter().chain(shift.iter()).chain(moment.iter()).chain(force.iter()).copied())
}

fn carried(case: &Case, load: f64, start: &Plain) -> Plain {
    let mut end = *start;
    let acting = Acting { jumps: &[], load, pulls: &case.pulls };
    crate::shooting::carry_through(&case.stretch, &acting, &mut end);
    end
}

/// The transfer map of canonical coordinates by differences of order four.
fn transfer(case: &Case, load: f64, start: &Plain) -> Matrix12 {
    let end = carried(case, load, start);
    let h = 2e-3;
    let mut t = Matrix12::zeros();
    for j in 0..12 {
        let at = |steps: f64| {
            let z = Vector12::ith(j, steps * h);
            coordinates(&carried(case, load, &beside(start, &z)), &end)
        };
        let column = ((at(1.0) - at(-1.0)) * 8.0 - (at(2.0) - at(-2.0))) / (12.0 * h);
        t.set_column(j, &column);
    }
    t
}

fn blocks(t: &Matrix12) -> [Matrix6<f64>; 4] {
    [(0, 0), (0, 6), (6, 0), (6, 6)].map(|(i, j)| t.fixed_view::<6, 6>(i, j).into_owned())
}

fn form(case: &Case, load: f64, start: &Plain) -> Form {
    let soft = 1.3;
    Form::new(std::slice::from_ref(&case.stretch), soft, (load, &case.pulls), start, &mut SegmentEnd::new())
        .expect("a short stretch")
}

#[test]
fn the_transfer_map_is_symplectic() {
    let mut random = Random(3);
    for case in &cases() {
        for _ in 0..6 {
            let start = random_state(&mut random);
            let [p, q, r, s] = blocks(&transfer(case, 0.8, &start));
            let misses = [
                p.transpose() * s - r.transpose() * q - Matrix6::identity(),
                p.transpose() * r - r.transpose() * p,
                q.transpose() * s - s.transpose() * q,
            ];
            for miss in misses {
                assert!(miss.amax() < 2e-9, "{}: {:.1e}", case.name, miss.amax());
            }
        }
    }
}

#[test]
fn a_load_that_follows_the_section_is_not_symplectic() {
    // That the test above can fail.
    let mut case = cases().remove(0);
    case.stretch.piece.loads = vec![LoadSample { section_force: [0.0, 2.0, 0.0], ..LoadSample::default() }];
    let [p, _, r, _] = blocks(&transfer(&case, 1.0, &random_state(&mut Random(4))));
    assert!((p.transpose() * r - r.transpose() * p).amax() > 1e-2);
}

/// The wrenches that a regular stretch answers with: w_A = Q⁻¹ (x_B - P x_A).
#[test]
fn the_stiffness_is_that_of_the_carried_state() {
    let mut random = Random(5);
    for case in cases().iter().filter(|case| case.soft) {
        for _ in 0..6 {
            let start = random_state(&mut random);
            let [p, q, _, s] = blocks(&transfer(case, 0.8, &start));
            let inverse = q.try_inverse().expect("every wrench has a strain");
            let form = form(case, 0.8, &start);
            let wanted = [inverse * p, -inverse.transpose(), s * inverse];
            let size = wanted.iter().map(|m| m.amax()).fold(0.0, f64::max);
            for (found, wanted) in [form.aa, form.ba, form.bb].iter().zip(&wanted) {
                let error = (found - wanted).amax() / size;
                assert!(error < 1e-6, "{}: {error:.1e}", case.name);
            }
            assert!((form.aa - form.aa.transpose()).amax() < 1e-9 * size);
        }
    }
}

/// For motions that the stretch can follow E is half the work of the wrenches, whatever its law.
#[test]
fn the_energy_is_half_the_work_of_the_wrenches() {
    let mut random = Random(6);
    for case in &cases() {
        for _ in 0..6 {
            let start = random_state(&mut random);
            let [p, q, r, s] = blocks(&transfer(case, 0.8, &start));
            let form = form(case, 0.8, &start);
            let [xa, wa] = [0, 1].map(|_| nalgebra::Vector6::from_fn(|_, _| random.next()));
            let (xb, wb) = (p * xa + q * wa, r * xa + s * wa);
            let energy =
                0.5 * xa.dot(&(form.aa * xa)) + xb.dot(&(form.ba * xa)) + 0.5 * xb.dot(&(form.bb * xb));
            let work = 0.5 * (xb.dot(&wb) - xa.dot(&wa));
            assert!((energy - work).abs() < 2e-6, "{}: {energy} against {work}", case.name);
        }
    }
}

/// Two halves, their common pose eliminated, are the whole.
#[test]
fn halves_add_up_to_the_whole() {
    let mut random = Random(7);
    for case in cases().iter().filter(|case| case.regular) {
        let start = random_state(&mut random);
        let whole = form(case, 0.8, &start);
        let half = || {
            let mut part = cases().into_iter().find(|c| c.name == case.name).expect("the same case");
            part.stretch.piece.length = 0.5 * LENGTH;
            part
        };
        let first = form(&half(), 0.8, &start);
        let second = form(&half(), 0.8, &first.end);
        let middle = (first.bb + second.aa).try_inverse().expect("a stable middle");
        let joined = [
            first.aa - first.ba.transpose() * middle * first.ba,
            -second.ba * middle * first.ba,
            second.bb - second.ba * middle * second.ba.transpose(),
        ];
        let size = whole.bb.amax();
        for (found, wanted) in joined.iter().zip([whole.aa, whole.ba, whole.bb]) {
            let error = (found - wanted).amax() / size;
            assert!(error < 1e-6, "{}: {error:.1e}", case.name);
        }
    }
}

/// A stretch that moves as a whole with its wrench answers with the turned wrench: E's rows know of rigid motions.
#[test]
fn moved_as_a_whole_a_stretch_turns_its_wrench() {
    let mut random = Random(8);
    for case in cases().iter().filter(|case| case.regular && case.stretch.piece.loads.is_empty()) {
        let start = random_state(&mut random);
        let form = form(case, 0.8, &start);
        let [turn, shift] = [random.vector(1.0), random.vector(1.0)];
        let motion = |at: [f64; 3]| {
            let twist = Twist { angular: turn, linear: shift + turn.cross(&V::from(at)) };
            nalgebra::Vector6::from_iterator(twist.angular.iter().chain(twist.linear.iter()).copied())
        };
        let (xa, xb) = (motion(start.position), motion(form.end.position));
        // ½ M × θ is the change of the canonical moment that belongs to a plain change θ × M: half of it.
        let answer = |state: &Plain, sign: f64| {
            let moment = turn.cross(&V::from(state.moment)) * 0.5;
            let force = turn.cross(&V::from(state.force));
            nalgebra::Vector6::from_iterator(moment.iter().chain(force.iter()).map(|v| sign * v))
        };
        let at_start = form.aa * xa + form.ba.transpose() * xb - answer(&start, -1.0);
        let at_end = form.ba * xa + form.bb * xb - answer(&form.end, 1.0);
        let size = form.bb.amax();
        assert!(at_start.amax().max(at_end.amax()) < 1e-8 * size, "{}", case.name);
    }
}
