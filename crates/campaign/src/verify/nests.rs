//! Concentric tubes, from station to station.
//!
//! All tubes share the axis; with k the curvature of the first and θ_i the turn of tube i against it,
//! `k_23 = (M_23 + Σ EI_i R(θ_i) κ_i e3) / Σ EI_i`, and no torque passes between tubes:
//! `τ_i' = -(k_i × m_i)_1` with m_i = EI_i (k_i - κ_i) what tube i carries, in its own axes.

use super::answer::{Answer, Check, V, pose};
use super::dormand::integrate;
use super::rod::in_section;
use super::section;
use flexura::model::{BeamTheory, Tubes};
use flexura::output::TubesDocument;
use flexura::spatial::{Quaternion, UnitQuaternion, Wrench, log};

const MOST: usize = 4;
/// p, q, F, M, turns, torques.
const N: usize = 13 + 2 * MOST;

/// One tube: EI, GJ, rest curvature, where its curved part begins, where it ends.
struct Member {
    bending: f64,
    torsion: f64,
    curvature: f64,
    curved: f64,
    reach: f64,
}

/// The tubes from station to station, and at their ends.
pub fn checks(
    answer: &Answer,
    nest: &Tubes,
    told: &TubesDocument,
    checks: &mut Vec<Check>,
) -> Result<(), String> {
    let members = members(answer, nest)?;
    let length = members[0].reach;
    let unit = members.iter().map(|member| member.bending).fold(f64::INFINITY, f64::min) / length;
    let largest = told.moment.iter().map(|m| V::from(*m).norm()).fold(0.0, f64::max);
    let moment = largest.max(unit).max(nest.force.norm() * length);
    let force = (unit / length).max(nest.force.norm());
    let mut scale = [0.0; N];
    for (i, value) in scale.iter_mut().enumerate() {
        *value = match i {
            0..=2 => length,
            3..=6 => 1.0,
            7..=9 => force,
            10..=12 => moment,
            _ if i < 13 + MOST => 1.0,
            _ => moment,
        };
    }
    let state = |i: usize| state(told, members.len(), i);
    let mut worst = 0.0_f64;
    for i in 1..told.s.len() {
        let ends = [told.s[i - 1], told.s[i]];
        let middle = 0.5 * (ends[0] + ends[1]);
        let end = integrate(|_, y| rates(&members, middle, y), ends, state(i - 1), &scale, 1e-13)
            .map_err(|s| format!("the second integration of tubes.{} broke off at s = {s} m", nest.name))?;
        let wanted = state(i);
        let here = |y: &[f64; N]| pose(&[y[0], y[1], y[2]], &[y[3], y[4], y[5], y[6]]);
        let (a, b) = (here(&end), here(&wanted));
        worst = worst.max(log(&(a.rotation.inverse() * b.rotation)).norm());
        for k in (0..3).chain(7..N) {
            let absent = k >= 13
                && members.get((k - 13) % MOST).is_none_or(|member| member.reach < ends[1] - 1e-9 * length);
            if !absent {
                worst = worst.max((end[k] - wanted[k]).abs() / scale[k]);
            }
        }
    }
    checks.push(Check { what: format!("second integration of tubes.{}", nest.name), difference: worst });
    ends(answer, nest, told, &members, [force, moment], checks);
    Ok(())
}

fn members(answer: &Answer, nest: &Tubes) -> Result<Vec<Member>, String> {
    let mut members = Vec::new();
    for tube in &nest.tubes {
        let theory = BeamTheory { shear: false, extension: false };
        let material = tube.material.map(|id| &answer.model[id]);
        let whole = tube.straight + tube.curved;
        let c = section::compliance(&answer.model[tube.section], material, theory, 0.0, whole)
            .ok_or("a tube has no stiffness")?;
        members.push(Member {
            bending: 1.0 / c[(4, 4)],
            torsion: 1.0 / c[(3, 3)],
            curvature: tube.curvature,
            curved: tube.straight + tube.translation,
            reach: tube.reach(),
        });
    }
    Ok(members)
}

/// The numbers at one station.
fn state(told: &TubesDocument, tubes: usize, i: usize) -> [f64; N] {
    let mut y = [0.0; N];
    let (p, q, f, m) = (told.position[i], told.rotation[i], told.force[i], told.moment[i]);
    y[..3].copy_from_slice(&p);
    y[3..7].copy_from_slice(&q);
    y[7..10].copy_from_slice(&f);
    y[10..13].copy_from_slice(&m);
    for k in 0..tubes {
        y[13 + k] = told.angles[k].get(i).copied().unwrap_or(0.0);
        y[13 + MOST + k] = told.torques[k].get(i).copied().unwrap_or(0.0);
    }
    y
}

fn rates(members: &[Member], s: f64, y: &[f64; N]) -> [f64; N] {
    let quaternion = Quaternion::new(y[3], y[4], y[5], y[6]);
    let rotation = UnitQuaternion::from_quaternion(quaternion);
    let force = V::new(y[7], y[8], y[9]);
    let carried = in_section(&rotation, &Wrench::new(force, V::new(y[10], y[11], y[12])));
    let here = |member: &&Member| member.reach > s;
    let rest = |member: &Member| if s > member.curved { member.curvature } else { 0.0 };
    let (mut stiff, mut bent) = (0.0, [carried[4], carried[5]]);
    for (i, member) in members.iter().enumerate().filter(|(_, member)| here(member)) {
        // κ e3 of tube i, seen in the first tube's axes e2, e3.
        let turn = y[13 + i];
        stiff += member.bending;
        bent[0] -= member.bending * rest(member) * turn.sin();
        bent[1] += member.bending * rest(member) * turn.cos();
    }
    let (k2, k3) = (bent[0] / stiff, bent[1] / stiff);
    let torque = |i: usize| y[13 + MOST + i];
    let k1 = torque(0) / members[0].torsion;
    let slope = rotation * V::x();
    let turn = quaternion * Quaternion::from_imag(V::new(k1, k2, k3)) * 0.5;
    let dm = -slope.cross(&force);
    let mut rates = [0.0; N];
    rates[..7].copy_from_slice(&[slope.x, slope.y, slope.z, turn.w, turn.i, turn.j, turn.k]);
    rates[10..13].copy_from_slice(&[dm.x, dm.y, dm.z]);
    for (i, member) in members.iter().enumerate().filter(|(_, member)| here(member)) {
        rates[13 + i] = torque(i) / member.torsion - k1;
        // k in the tube's own axes.
        let (sin, cos) = y[13 + i].sin_cos();
        let own = [k2 * cos + k3 * sin, -k2 * sin + k3 * cos];
        let carried = [member.bending * own[0], member.bending * (own[1] - rest(member))];
        rates[13 + MOST + i] = -(own[0] * carried[1] - own[1] * carried[0]);
    }
    rates
}

/// Turns at the guide, the load at the tip, and no torque where a tube ends.
fn ends(
    answer: &Answer,
    nest: &Tubes,
    told: &TubesDocument,
    members: &[Member],
    [force, moment]: [f64; 2],
    checks: &mut Vec<Check>,
) {
    let mut say = |what: &str, difference: f64| {
        checks.push(Check { what: format!("{what} of tubes.{}", nest.name), difference });
    };
    let last = told.s.len() - 1;
    say("force at the tip", (V::from(told.force[last]) - nest.force).norm() / force);
    say("moment at the tip", (V::from(told.moment[last]) - nest.moment).norm() / moment);
    // The first tube takes the load's moment about the axis, the others end free.
    for torques in told.torques.iter().skip(1) {
        say("torque at the end of a tube", torques.last().map_or(0.0, |torque| torque.abs()) / moment);
    }
    let turn = |i: usize| {
        let twist = told.torques[i].first().map_or(0.0, |torque| torque / members[i].torsion);
        nest.tubes[i].rotation - nest.tubes[i].translation * twist
    };
    for i in 1..members.len() {
        let relative = told.angles[i].first().copied().unwrap_or(0.0);
        let off = (turn(i) - turn(0) - relative).rem_euclid(std::f64::consts::TAU);
        say("turn at the guide", off.min(std::f64::consts::TAU - off));
    }
    let base = answer.frame(&nest.base);
    let first = pose(&told.position[0], &told.rotation[0]);
    let apart = base.inverse() * first;
    let roll = flexura::spatial::exp(&(V::x() * turn(0)));
    say("guide", log(&(roll.inverse() * apart.rotation)).norm().max(apart.position.norm() / answer.length));
}
