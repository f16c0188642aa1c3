//! A converged answer, verified by other means than those by which it was found.
//!
//! Every beam is integrated again from station to station by another method, from the model's own numbers, with everything
//! that acts between two stations worked out from the rest of the document. Bodies must be in balance, joints and holds must
//! fit and obey their laws, springs and cables theirs, and the strain energy must be the integral of what is stored.

mod actions;
mod answer;
mod cables;
mod contacts;
mod dormand;
mod joints;
mod nests;
mod rod;
mod section;
mod springs;

pub use answer::Check;

use actions::{Action, touches};
use answer::{Answer, V};
use flexura::model::{BeamPoint, Model, Mount};
use flexura::output::Document;
use flexura::spatial::{Pose, Wrench, log};
use joints::Held;
use rod::Carried;

/// Everything that was compared.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// In no order.
    pub checks: Vec<Check>,
}

impl Verdict {
    /// What is off most.
    pub fn worst(&self) -> Option<&Check> {
        // No number is worse than any.
        let size =
            |check: &Check| if check.difference.is_finite() { check.difference } else { f64::INFINITY };
        self.checks.iter().max_by(|a, b| size(a).total_cmp(&size(b)))
    }
}

/// Verifies a converged answer.
///
/// # Errors
/// Why it cannot be verified: the document does not fit the model, or the second integration broke off.
pub fn verify(model: &Model, document: &Document) -> Result<Verdict, String> {
    let answer = Answer::new(model, document)?;
    let mut actions = answer.actions();
    let mut checks = Vec::new();
    let (carried, stored) = beams(&answer, &mut actions, &mut checks)?;
    balances(&answer, &actions, &carried, &mut checks);
    joints_and_drives(&answer, &mut checks);
    springs::checks(&answer, &mut checks);
    cables::checks(&answer, &carried, &mut checks);
    for nest in &model.tubes {
        let told = document.tubes.get(&nest.name).ok_or("tubes are not in the document")?;
        nests::checks(&answer, nest, told, &mut checks)?;
    }
    couplings(&answer, &mut checks);
    energy(&answer, &carried, stored, &mut checks);
    Ok(Verdict { checks })
}

/// Places nearer than this part of the length are one.
const SAME: f64 = 1e-9;

fn acts_at(action: &Action, beam: usize, s: f64, length: f64) -> bool {
    matches!(action.on, Mount::Beam(BeamPoint { beam: id, at })
        if id.0 == beam && (at.arc_length(length) - s).abs() < SAME * length)
}

/// All that acts on a beam at `s`, about `point`.
fn acting(actions: &[Action], beam: usize, s: f64, length: f64, point: &V, loads: Option<bool>) -> Wrench {
    let here = actions.iter().filter(|action| acts_at(action, beam, s, length));
    let wanted = here.filter(|action| loads.is_none_or(|loads| action.is_load == loads));
    wanted.fold(Wrench::zero(), |sum, action| sum + Wrench::new(action.force, action.about(point)))
}

/// Every beam: intervals, and its ends on what holds them. Beams that hold on to beams come first.
fn beams(
    answer: &Answer,
    actions: &mut Vec<Action>,
    checks: &mut Vec<Check>,
) -> Result<(Vec<Vec<Carried>>, Option<f64>), String> {
    let count = answer.model.beams.len();
    // What a beam exerts on its supports is read off its first and last station, so that these come first for all.
    let mut supports = Vec::new();
    let mut done = vec![false; count];
    // A support's action on a beam must be known before that beam's own ends are read: leaves of the tree first.
    for _ in 0..=count {
        for beam in 0..count {
            let waits = (0..count).any(|other| {
                let on = |end: &Option<flexura::model::End>| {
                    end.as_ref().is_some_and(|end| matches!(end.mount, Mount::Beam(p) if p.beam.0 == beam))
                };
                !done[other]
                    && other != beam
                    && (on(&answer.model.beams[other].start) || on(&answer.model.beams[other].end))
            });
            if done[beam] || waits {
                continue;
            }
            let [start, end] = end_wrenches(answer, beam, actions)
                .ok_or_else(|| format!("beam.{} has no section", answer.model.beams[beam].name))?;
            let stations = &answer.beams[beam];
            let (first, last) = (stations[0].pose.position, stations[stations.len() - 1].pose.position);
            let described = &answer.model.beams[beam];
            if let Some(hold) = &described.start {
                let (force, moment) = (start.force, start.moment);
                actions.push(Action { on: hold.mount, point: first, force, moment, is_load: false });
            }
            if let Some(hold) = &described.end {
                let (force, moment) = (-end.force, -end.moment);
                actions.push(Action { on: hold.mount, point: last, force, moment, is_load: false });
            }
            supports.push((beam, start, end));
            done[beam] = true;
        }
    }
    if supports.len() < count {
        return Err("beams hold on to each other in a circle".to_owned());
    }
    let held: Vec<Option<f64>> =
        supports.iter().map(|(beam, start, end)| holds(answer, *beam, start, end, checks)).collect();
    let carried =
        (0..count).map(|beam| intervals(answer, beam, actions, checks)).collect::<Result<_, _>>()?;
    Ok((carried, held.into_iter().sum()))
}

/// What the support at the start gets from the beam, and what the support at the end exerts on it.
fn end_wrenches(answer: &Answer, beam: usize, actions: &[Action]) -> Option<[Wrench; 2]> {
    let (rod, stations) = (&answer.rods[beam], &answer.beams[beam]);
    let (first, last) = (stations.first()?, stations.last()?);
    // The first station stands behind what is attached there and before loads, the last before all.
    let start = rod.total(first, SAME * rod.length)?
        + acting(actions, beam, 0.0, rod.length, &first.pose.position, Some(false));
    let end = rod.total(last, (1.0 - SAME) * rod.length)?
        - acting(actions, beam, rod.length, rod.length, &last.pose.position, None);
    Some([start, end])
}

/// The ends against what holds them; what the springs of the holds store, where their coordinates can be told.
fn holds(answer: &Answer, beam: usize, start: &Wrench, end: &Wrench, checks: &mut Vec<Check>) -> Option<f64> {
    let (rod, stations) = (&answer.rods[beam], &answer.beams[beam]);
    let described = rod.beam;
    let ends = [
        (&described.start, stations[0].pose, -*start, "start"),
        (&described.end, stations[stations.len() - 1].pose, *end, "end"),
    ];
    let mut stored = Some(0.0);
    for (hold, moving, wrench, word) in ends {
        let name = format!("beam.{}.{word}", described.name);
        let Some(hold) = hold else {
            let off = (wrench.force.norm() / rod.force).max(wrench.moment.norm() / rod.moment);
            checks.push(Check { what: format!("free end {name}"), difference: off });
            continue;
        };
        let placement = hold.placement.or_else(|| match word {
            "start" => Some(Pose::identity()),
            _ => {
                let rest = rod.home(answer, 0)? * rod.far_end();
                Some(answer.at_rest(&hold.mount, 0)?.inverse() * rest)
            }
        });
        let Some(placement) = placement else {
            stored = None;
            continue;
        };
        let fixed = answer.carried(&hold.mount) * placement;
        let held = Held {
            name,
            law: &hold.hold,
            pose: fixed.inverse() * moving,
            wrench: wrench.rotated(&fixed.rotation.inverse()),
            coordinates: None,
            geared: Vec::new(),
        };
        held.check(answer, checks);
        let here = held.values().map(|values| joints::energy(&hold.hold, &values));
        stored = stored.zip(here).map(|(sum, here)| sum + here);
    }
    stored
}

/// One beam from station to station.
fn intervals(
    answer: &Answer,
    beam: usize,
    actions: &[Action],
    checks: &mut Vec<Check>,
) -> Result<Vec<Carried>, String> {
    let (rod, stations) = (&answer.rods[beam], &answer.beams[beam]);
    let broke = |s: f64| format!("the second integration of beam.{} broke off at s = {s} m", rod.beam.name);
    let mut worst = [0.0_f64; 4];
    let mut all = Vec::new();
    for (i, pair) in stations.windows(2).enumerate() {
        let (from, to) = (&pair[0], &pair[1]);
        let tiny = SAME * rod.length;
        let inside = if i == 0 { tiny } else { from.s - tiny };
        let before = rod.total(from, inside).ok_or_else(|| broke(from.s))?;
        let point = from.pose.position;
        let jump = acting(actions, beam, from.s, rod.length, &point, (i == 0).then_some(true));
        let carried = rod.carry(from, &(before - jump), to.s).map_err(broke)?;
        let wanted = rod.total(to, to.s - tiny).ok_or_else(|| broke(to.s))?;
        let turned = log(&(carried.pose.rotation.inverse() * to.pose.rotation)).norm();
        let moved = (carried.pose.position - to.pose.position).norm() / rod.length;
        let force = (carried.total.force - wanted.force).norm() / rod.force;
        let moment = (carried.total.moment - wanted.moment).norm() / rod.moment;
        for (worst, here) in worst.iter_mut().zip([moved, turned, force, moment]) {
            *worst = if here.is_finite() { worst.max(here) } else { f64::INFINITY };
        }
        all.push(carried);
    }
    for (what, difference) in ["position", "rotation", "force", "moment"].into_iter().zip(worst) {
        checks.push(Check {
            what: format!("second integration of beam.{}: {what}", rod.beam.name),
            difference,
        });
    }
    Ok(all)
}

/// Every body, and the whole mechanism.
fn balances(answer: &Answer, actions: &[Action], carried: &[Vec<Carried>], checks: &mut Vec<Check>) {
    for (i, pose) in answer.bodies.iter().enumerate() {
        let here = actions.iter().filter(|action| matches!(action.on, Mount::Body(id) if id.0 == i));
        let (mut force, mut moment, mut arm) = (V::zeros(), V::zeros(), 0.0_f64);
        for action in here {
            force += action.force;
            moment += action.about(&pose.position);
            arm = arm.max((action.point - pose.position).norm() * action.force.norm());
        }
        let off = (force.norm() / answer.force).max(moment.norm() / answer.moment.max(arm));
        checks.push(Check {
            what: format!("balance of body.{}", answer.model.bodies[i].name),
            difference: off,
        });
    }
    // What the ground gets, from outside and from what is spread along beams, and the loads.
    let (mut force, mut moment, mut arm) = (V::zeros(), V::zeros(), answer.moment);
    let on_ground = |action: &&Action| action.on == Mount::Ground;
    for action in actions.iter().filter(on_ground) {
        force -= action.force;
        moment -= action.about(&V::zeros());
        arm = arm.max(action.point.norm() * action.force.norm());
    }
    for action in actions.iter().filter(|action| action.is_load) {
        force += action.force;
        moment += action.about(&V::zeros());
        arm = arm.max(action.point.norm() * action.force.norm());
    }
    for (beam, intervals) in carried.iter().enumerate() {
        let (rod, stations) = (&answer.rods[beam], &answer.beams[beam]);
        for (i, (pair, end)) in stations.windows(2).zip(intervals).enumerate() {
            let tiny = SAME * rod.length;
            let inside = if i == 0 { tiny } else { pair[0].s - tiny };
            let Some(before) = rod.total(&pair[0], inside) else { continue };
            let p = pair[0].pose.position;
            let start = before - acting(actions, beam, pair[0].s, rod.length, &p, (i == 0).then_some(true));
            force += start.force - end.total.force;
            let about = |wrench: &Wrench, p: &V| wrench.moment + p.cross(&wrench.force);
            moment += about(&start, &p) - about(&end.total, &end.pose.position);
        }
    }
    for nest in &answer.model.tubes {
        force += nest.force;
        let Some(told) = answer.document.tubes.get(&nest.name) else { continue };
        let tip = told.position.last().map_or(V::zeros(), |p| V::from(*p));
        moment += nest.moment + tip.cross(&nest.force);
    }
    let off = (force.norm() / answer.force).max(moment.norm() / arm);
    checks.push(Check { what: "balance of the whole mechanism".to_owned(), difference: off });
}

fn geared(answer: &Answer, joint: usize, count: usize) -> Vec<f64> {
    let mut all = vec![0.0; count];
    for coupling in &answer.model.couplings {
        let multiplier = answer.document.couplings.get(&coupling.name).map_or(0.0, |told| told.multiplier);
        for term in coupling.terms.iter().filter(|term| term.joint.0 == joint) {
            if let Some(effort) = all.get_mut(term.coordinate) {
                *effort += term.factor * multiplier;
            }
        }
    }
    all
}

fn joints_and_drives(answer: &Answer, checks: &mut Vec<Check>) {
    for (index, joint) in answer.model.joints.iter().enumerate() {
        let Some(told) = answer.document.joints.get(&joint.name) else { continue };
        let fixed = answer.frame(&joint.parent);
        let moving = joint.child_pose.or_else(|| {
            let rest = answer.at_rest(&joint.parent.mount, 0)? * joint.parent.pose;
            // A rolling or contact joint has its boundary about the child's origin.
            if touches(joint.law.kind) {
                return Some(Pose::identity());
            }
            Some(answer.at_rest(&joint.child, 0)?.inverse() * rest)
        });
        let Some(moving) = moving else { continue };
        let moving = answer.carried(&joint.child) * moving;
        let wrench =
            Wrench::new(V::from(told.force), V::from(told.moment)).rotated(&fixed.rotation.inverse());
        let gears = geared(answer, index, joint.law.coordinates.len());
        if touches(joint.law.kind) {
            let geared = gears.first().copied().unwrap_or(0.0);
            contacts::Touching { joint, told, fixed, moving, wrench, geared }.check(answer, checks);
            continue;
        }
        let held = Held {
            name: format!("joint.{}", joint.name),
            law: &joint.law,
            pose: fixed.inverse() * moving,
            wrench,
            coordinates: Some(&told.coordinates),
            geared: gears,
        };
        held.check(answer, checks);
    }
}

fn couplings(answer: &Answer, checks: &mut Vec<Check>) {
    for coupling in &answer.model.couplings {
        let (mut sum, mut size) = (-coupling.offset, 0.0_f64);
        for term in &coupling.terms {
            let joint = &answer.model[term.joint];
            let told = answer.document.joints.get(&joint.name);
            let value =
                told.and_then(|told| told.coordinates.get(term.coordinate)).copied().unwrap_or(f64::NAN);
            sum += term.factor * value;
            let kind = joint.law.kind.coordinate_kinds()[term.coordinate];
            let unit = if kind == flexura::model::CoordinateKind::Angle { 1.0 } else { answer.length };
            size = size.max((term.factor * unit).abs());
        }
        checks.push(Check { what: format!("coupling.{}", coupling.name), difference: sum.abs() / size });
    }
}

/// The strain energy, where all that stores any is known here.
fn energy(answer: &Answer, carried: &[Vec<Carried>], held: Option<f64>, checks: &mut Vec<Check>) {
    let model = answer.model;
    let is_known = model.tubes.is_empty();
    let springs: Option<Vec<f64>> =
        model.springs.iter().map(|spring| springs::energy(answer, spring)).collect();
    let (Some(springs), Some(held)) = (springs.filter(|_| is_known), held) else { return };
    let mut sum = held + springs.iter().sum::<f64>();
    sum += carried.iter().flatten().map(|interval| interval.energy).sum::<f64>();
    for (joint, told) in model.joints.iter().zip(answer.joint_documents()) {
        let Some(told) = told else { continue };
        sum += joints::energy(&joint.law, &told.coordinates);
    }
    let told = answer.document.energy;
    let unit = told.abs().max(answer.force * answer.length * 1e-6);
    checks.push(Check { what: "strain energy".to_owned(), difference: (sum - told).abs() / unit });
}
