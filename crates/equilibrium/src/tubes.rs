//! Concentric tubes: one more kind of element, carried from its guide to its tip.
//!
//! Unknown are the moment M across all tubes where they leave the guide and the torques m_i there of all tubes but the
//! first; the force is known, for the load on the tip is dead. Equations: at the tip M is the load's moment, and every
//! torque has come to zero where its tube ends. At rest no tube is turned, so that all lie in one plane and carry
//! no moment; the turns grow with the load, as they would be made.

use crate::assembly::{Sink, unit};
use crate::error::ProblemError;
use crate::lower::{Carrier, Lowered};
use crate::scale::Scale;
use crate::shooting::Column;
use crate::system::Equilibrium;
use flexura_geometry::compliance;
use flexura_mechanics::rod::{Guided, RodState, TUBES, Tube, TubePiece, TubeState, advance_tubes};
use flexura_model::{BeamTheory, Model, Tubes};
use flexura_solution::{TubesSample, TubesSolution};
use flexura_spatial::{Pose, Quaternion, UnitQuaternion, Vector3, Wrench};

type V = Vector3<f64>;
/// Value, six motions of the base, three numbers of the moment, three torques.
const W: usize = 16;
const OTHERS: usize = TUBES - 1;

/// One tube, nondimensional.
#[derive(Clone, Debug)]
struct Member {
    bending: f64,
    torsion: f64,
    curvature: f64,
    /// Where its curved part begins and where it ends.
    curved: f64,
    reach: f64,
    turn: f64,
    back: f64,
}

/// Concentric tubes, nondimensional.
#[derive(Clone, Debug)]
pub(crate) struct Nest {
    pub base: Carrier,
    members: Vec<Member>,
    pub load: Wrench,
    /// Ends of the stretches on which nothing changes its law.
    pub ends: Vec<f64>,
}

/// EI, GJ of a tube, SI.
fn stiffness(model: &Model, tubes: &Tubes, index: usize) -> Result<[f64; 2], ProblemError> {
    let tube = &tubes.tubes[index];
    let material = tube.material.map(|id| &model[id]);
    let theory = BeamTheory { shear: false, extension: false };
    let found = compliance(&model[tube.section], material, theory, 0.0, tube.straight + tube.curved);
    let c = found
        .map_err(|error| {
            let path = format!("section.{}", model[tube.section].name);
            ProblemError::new(path, error.to_string(), format!("used by tubes.{}", tubes.name))
        })?
        .to_matrix();
    if c[(4, 4)] <= 0.0 {
        return Err(ProblemError::new(
            format!("tubes.{}", tubes.name),
            format!("tube {} cannot bend", index + 1),
            "give it a finite bending stiffness",
        ));
    }
    Ok([1.0 / c[(4, 4)], 1.0 / c[(3, 3)]])
}

/// Length and EI of the first tubes of a model, for its units: L of the longest, EI of the softest.
pub(crate) fn size(model: &Model) -> Result<Option<Scale>, ProblemError> {
    let mut best: Option<Scale> = None;
    for tubes in &model.tubes {
        let length = tubes.tubes.iter().map(flexura_model::Tube::reach).fold(0.0, f64::max);
        let mut soft = f64::INFINITY;
        for i in 0..tubes.tubes.len() {
            soft = soft.min(stiffness(model, tubes, i)?[0]);
        }
        if best.is_none_or(|scale| length > scale.length) {
            best = Some(Scale { length, force: soft / (length * length) });
        }
    }
    Ok(best)
}

pub(crate) fn lower(model: &Model, lowered: &Lowered, tubes: &Tubes) -> Result<Nest, ProblemError> {
    let scale = lowered.scale;
    let bend = scale.moment() * scale.length;
    let mut members = Vec::new();
    for (i, tube) in tubes.tubes.iter().enumerate() {
        let [bending, torsion] = stiffness(model, tubes, i)?;
        members.push(Member {
            bending: bending / bend,
            torsion: torsion / bend,
            curvature: tube.curvature * scale.length,
            curved: (tube.straight + tube.translation) / scale.length,
            reach: tube.reach() / scale.length,
            turn: tube.rotation,
            back: -tube.translation / scale.length,
        });
    }
    let tip = members[0].reach;
    let mut ends: Vec<f64> = members.iter().flat_map(|m| [m.curved, m.reach]).collect();
    ends.retain(|s| *s > 1e-12 * tip && *s < tip * (1.0 - 1e-12));
    ends.push(tip);
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|a, b| (*a - *b).abs() < 1e-12 * tip);
    let base = Carrier { node: lowered.node_of(tubes.base.mount), frame: scale.pose_in(&tubes.base.pose) };
    let load = scale.wrench_in(&Wrench::new(tubes.force, tubes.moment));
    Ok(Nest { base, members, load, ends })
}

impl Nest {
    pub fn others(&self) -> usize {
        self.members.len() - 1
    }

    pub fn tip(&self) -> f64 {
        self.members[0].reach
    }

    /// Turning along the axis, for the number of steps.
    fn turning(&self, a: f64, b: f64) -> f64 {
        let sharpest = self.members.iter().map(|m| m.curvature.abs()).fold(0.0, f64::max);
        (b - a) * (1.0 + 2.0 * sharpest + self.load.force.norm().sqrt() + self.load.moment.norm())
    }

    /// Steps of every stretch for an error of about `accuracy`.
    pub fn steps(&self, accuracy: f64) -> Vec<usize> {
        let starts = std::iter::once(0.0).chain(self.ends.iter().copied());
        let steps = starts.zip(&self.ends).map(|(a, b)| {
            let turning = self.turning(a, *b);
            let step = (accuracy / (3e-9 * turning.max(1.0))).powf(0.125).min(1.0);
            ((turning / step).ceil() as usize).clamp(2, 100_000)
        });
        steps.collect()
    }

    fn is_here(member: &Member, b: f64) -> bool {
        member.reach >= b * (1.0 - 1e-12)
    }

    fn rest(member: &Member, a: f64) -> [f64; 3] {
        let curved = a >= member.curved - 1e-12 * member.reach;
        [0.0, 0.0, if curved { member.curvature } else { 0.0 }]
    }

    fn piece(&self, a: f64, b: f64, stretch: [f64; 2], steps: usize) -> TubePiece {
        let tube = |m: &Member| Tube {
            bending: m.bending,
            torsion: m.torsion,
            rest: vec![Self::rest(m, stretch[0])],
        };
        let other = |i: usize| self.members.get(1 + i).filter(|m| Self::is_here(m, stretch[1])).map(tube);
        TubePiece {
            length: b - a,
            steps,
            first: tube(&self.members[0]),
            others: std::array::from_fn(other),
            loads: Vec::new(),
        }
    }

    fn stretches(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        std::iter::once(0.0).chain(self.ends.iter().copied()).zip(&self.ends).map(|(a, b)| [a, *b])
    }
}

/// The tip with its derivatives along the unknowns that it depends on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tip {
    pub pose: Option<Pose>,
    pub columns: Vec<(usize, Column)>,
}

impl Equilibrium {
    /// The state where the tubes leave the guide, with the unknown behind each lane.
    fn mouth(&self, index: usize) -> (TubeState<W>, Vec<usize>, Pose) {
        let (nest, slot) = (&self.lowered.nests[index], &self.layout.nests[index]);
        let pose = self.node_pose(nest.base.node) * nest.base.frame;
        let q = pose.rotation.quaternion();
        let force = nest.load.force * self.load;
        let mut guide: RodState<W> = RodState::origin();
        guide.rotation = [q.w, q.i, q.j, q.k];
        guide.position = pose.position.into();
        guide.force = force.into();
        guide.moment = std::array::from_fn(|i| self.x[slot.state + i]);
        guide.d = [[0.0; W]; 12];
        let mut unknowns = Vec::new();
        if let Some(node) = nest.base.node {
            let arm = pose.position - self.node_pose(Some(node)).position;
            for i in 0..6 {
                unknowns.push(self.layout.nodes[node].unknown + i);
                let lane = unknowns.len();
                let linear = if i < 3 { unit(i).cross(&arm) } else { unit(i - 3) };
                for k in 0..3 {
                    guide.d[k][lane] = if i < 3 && k == i { 1.0 } else { 0.0 };
                    guide.d[3 + k][lane] = linear[k];
                }
            }
        }
        let mut torque = [[0.0; W]; OTHERS];
        for i in 0..slot.count {
            unknowns.push(slot.unknown + i);
            let lane = unknowns.len();
            if i < 3 {
                guide.d[9 + i][lane] = 1.0;
            } else {
                torque[i - 3][0] = self.x[slot.state + i];
                torque[i - 3][lane] = 1.0;
            }
        }
        let guided = |member: &Member| {
            let mut turn = [0.0; W];
            turn[0] = self.load * member.turn;
            Guided { turn, back: member.back, torsion: member.torsion }
        };
        let others = std::array::from_fn(|i| nest.members.get(1 + i).map(guided));
        (TubeState::leave_guide(&guide, &guided(&nest.members[0]), &others, &torque), unknowns, pose)
    }

    pub(crate) fn evaluate_nests(&mut self, sink: &mut Sink<'_>) {
        for index in 0..self.lowered.nests.len() {
            let (mut state, unknowns, base) = self.mouth(index);
            let (nest, slot) = (&self.lowered.nests[index], self.layout.nests[index]);
            for (stretch, steps) in nest.stretches().zip(&self.tube_steps[index]) {
                advance_tubes(&nest.piece(stretch[0], stretch[1], stretch, *steps), self.load, &mut state);
            }
            let moment = nest.load.moment * self.load;
            for i in 0..3 {
                sink.r[slot.unknown + i] += state.rod.moment[i] - moment[i];
            }
            for i in 0..nest.others() {
                sink.r[slot.unknown + 3 + i] += state.torque[i][0];
            }
            for (lane, unknown) in unknowns.iter().enumerate() {
                for i in 0..3 {
                    sink.add_number(slot.unknown + i, *unknown, state.rod.d[9 + i][1 + lane]);
                }
                for i in 0..nest.others() {
                    sink.add_number(slot.unknown + 3 + i, *unknown, state.torque[i][1 + lane]);
                }
            }
            // The base feels what the tubes carry where they leave it.
            if let Some(node) = nest.base.node {
                let rows = self.layout.nodes[node].unknown;
                let arm = base.position - self.node_pose(Some(node)).position;
                let force = nest.load.force * self.load;
                let moment = V::new(self.x[slot.state], self.x[slot.state + 1], self.x[slot.state + 2]);
                sink.add_residual(rows, &(moment + arm.cross(&force)));
                sink.add_residual(rows + 3, &force);
                for i in 0..3 {
                    sink.add(rows, rows + i, &unit(i).cross(&arm).cross(&force));
                    sink.add(rows, slot.unknown + i, &unit(i));
                }
            }
            let tip = &mut self.tips[index];
            tip.pose = Some(pose_of(&state));
            if sink.matrix.is_some() {
                tip.columns = unknowns
                    .iter()
                    .enumerate()
                    .map(|(lane, unknown)| (*unknown, std::array::from_fn(|i| state.rod.d[i][1 + lane])))
                    .collect();
            }
        }
    }

    /// Samples of all concentric tubes and their strain energy, nondimensional.
    pub(crate) fn sample_nests(&self, samples: usize) -> (Vec<TubesSolution>, f64) {
        let mut energy = 0.0;
        let mut all = Vec::with_capacity(self.lowered.nests.len());
        for (index, nest) in self.lowered.nests.iter().enumerate() {
            let (mut state, ..) = self.mouth(index);
            for (i, member) in nest.members.iter().enumerate() {
                let torque = if i == 0 { state.first_torque()[0] } else { state.torque[i - 1][0] };
                if member.torsion.is_finite() {
                    energy += 0.5 * member.back * torque * torque / member.torsion;
                }
            }
            let mut out = TubesSolution::default();
            for (stretch, steps) in nest.stretches().zip(&self.tube_steps[index]) {
                if out.samples.is_empty() {
                    out.samples.push(self.tubes_sample(nest, 0.0, stretch, &state));
                }
                let [a, b] = stretch;
                let parts = ((samples as f64 * (b - a) / nest.tip()).ceil() as usize).max(2);
                let each = steps.div_ceil(parts).max(1);
                let h = (b - a) / parts as f64;
                for k in 0..parts {
                    let from = a + h * k as f64;
                    // Three-point Gauss, from one node to the next.
                    let mut at = from;
                    for (node, weight) in crate::extract::GAUSS {
                        let next = from + h * node;
                        advance_tubes(&nest.piece(at, next, stretch, each), self.load, &mut state);
                        at = next;
                        energy += h * weight * nest.density(stretch, &state);
                    }
                    advance_tubes(&nest.piece(at, from + h, stretch, each), self.load, &mut state);
                    out.samples.push(self.tubes_sample(nest, from + h, stretch, &state));
                }
            }
            all.push(out);
        }
        (all, energy)
    }

    fn tubes_sample(&self, nest: &Nest, s: f64, stretch: [f64; 2], state: &TubeState<W>) -> TubesSample {
        let scale = self.lowered.scale;
        let pose = pose_of(state);
        let wrench = Wrench::new(V::from(state.rod.force), V::from(state.rod.moment));
        let here: Vec<usize> =
            (0..nest.members.len()).filter(|i| Nest::is_here(&nest.members[*i], stretch[1])).collect();
        let first = &nest.members[0];
        let moments = state.moments(&nest.laws(stretch));
        let rest = Nest::rest(first, stretch[0]);
        let twist = if first.torsion.is_finite() { moments[0][0] / first.torsion } else { 0.0 };
        let curvature = V::new(
            rest[0] + twist,
            rest[1] + moments[0][1] / first.bending,
            rest[2] + moments[0][2] / first.bending,
        );
        let angle = |i: usize| if i == 0 { 0.0 } else { state.angle[i - 1][0] };
        TubesSample {
            s: s * scale.length,
            pose: scale.pose_out(&pose),
            wrench: scale.wrench_out(&wrench),
            curvature: curvature / scale.length,
            angles: here.iter().map(|i| (*i, angle(*i))).collect(),
            torques: here.iter().map(|i| (*i, moments[*i][0] * scale.moment())).collect(),
        }
    }
}

impl Nest {
    fn laws(&self, stretch: [f64; 2]) -> [Option<(f64, [f64; 3])>; TUBES] {
        std::array::from_fn(|i| {
            let member = self.members.get(i).filter(|m| Self::is_here(m, stretch[1]))?;
            Some((member.bending, Self::rest(member, stretch[0])))
        })
    }

    /// Strain energy per length.
    fn density(&self, stretch: [f64; 2], state: &TubeState<W>) -> f64 {
        let moments = state.moments(&self.laws(stretch));
        let each = self.members.iter().zip(&moments).map(|(member, [torque, a, b])| {
            let twist = if member.torsion.is_finite() { torque * torque / member.torsion } else { 0.0 };
            0.5 * (twist + (a * a + b * b) / member.bending)
        });
        let here = (0..self.members.len()).map(|i| Self::is_here(&self.members[i], stretch[1]));
        each.zip(here).filter(|(_, here)| *here).map(|(energy, _)| energy).sum()
    }
}

fn pose_of(state: &TubeState<W>) -> Pose {
    let [w, x, y, z] = state.rod.rotation;
    Pose::new(UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)), V::from(state.rod.position))
}
