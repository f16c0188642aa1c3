//! Spans carried from node to node, with their derivatives.
//!
//! The head of a span depends on at most eighteen unknowns: six of the node that carries it, up to six
//! coordinates of its hold, six of its start wrench. Of these the kernel carries at most the twelve of a start
//! pose and start wrench, from which the others follow; later segments start from a state of twelve unknowns.
//! A tendon whose length is given adds its tension. The kernel carries as many derivative lanes as there are, rounded
//! up to four, eight, twelve, sixteen or twenty-four.

use crate::lower::Jump;
use crate::mesh::Stretch;
use flexura_mechanics::rod::{RodKernel, RodState, advance, advance_tendons};
use flexura_spatial::{Pose, Quaternion, UnitQuaternion, Vector3, Wrench};

/// Most tendons of unknown tension along one span: with the twelve numbers of a start they fill the widest kernel.
pub(crate) const MAX_TENSIONS: usize = 11;

/// Most unknowns that a segment depends on.
pub(crate) const MAX_COLUMNS: usize = 18 + MAX_TENSIONS;

/// Derivative of (turning, position, force, moment) along one unknown.
pub(crate) type Column = [f64; 12];

/// A plain state.
pub(crate) type Plain = RodState<1>;

/// The end of a segment with its derivatives along the unknowns of its start.
#[derive(Clone, Debug)]
pub(crate) struct SegmentEnd {
    pub state: Plain,
    pub columns: [Column; MAX_COLUMNS],
    pub count: usize,
    /// Force and moment at the end of every stretch, the larger of before and after what jumps there.
    pub met: Vec<[f64; 2]>,
    /// Length of each of the span's tendons along the segment, with its derivatives from place 1 on.
    pub lengths: Vec<[f64; 1 + MAX_COLUMNS]>,
}

/// A tendon's tension, and whether it is an unknown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pull {
    pub tension: f64,
    pub unknown: bool,
}

/// What acts along a span besides its distributed loads.
#[derive(Clone, Copy)]
pub(crate) struct Acting<'a> {
    pub jumps: &'a [Jump],
    pub load: f64,
    /// Of each of the span's tendons.
    pub pulls: &'a [Pull],
}

impl SegmentEnd {
    /// Starts derivatives along the numbers `first..12` of (turning, position, force, moment).
    pub fn seed(&mut self, first: usize) {
        self.count = 12 - first;
        for (i, column) in self.columns[..self.count].iter_mut().enumerate() {
            *column = [0.0; 12];
            column[first + i] = 1.0;
        }
    }

    pub fn new() -> Self {
        Self {
            state: Plain::origin(),
            columns: [[0.0; 12]; MAX_COLUMNS],
            count: 0,
            met: Vec::new(),
            lengths: Vec::new(),
        }
    }
}

/// A state of the given pose and wrench.
pub(crate) fn plain(pose: &Pose, wrench: &Wrench) -> Plain {
    let q = pose.rotation.quaternion();
    RodState {
        rotation: [q.w, q.i, q.j, q.k],
        position: pose.position.into(),
        force: wrench.force.into(),
        moment: wrench.moment.into(),
        d: [[0.0; 1]; 12],
    }
}

pub(crate) fn pose_of(state: &Plain) -> Pose {
    let [w, x, y, z] = state.rotation;
    Pose::new(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)), Vector3::from(state.position))
}

pub(crate) fn wrench_of(state: &Plain) -> Wrench {
    Wrench::new(Vector3::from(state.force), Vector3::from(state.moment))
}

/// Takes the state past a point load: `F(s+) = F(s-) - f`, `M(s+) = M(s-) - m`.
pub(crate) fn jump<const W: usize>(jump: &Jump, load: f64, state: &mut RodState<W>) {
    let [w, x, y, z] = state.rotation;
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let wrench = jump.load.at(&rotation);
    for i in 0..3 {
        state.force[i] -= load * wrench.force[i];
        state.moment[i] -= load * wrench.moment[i];
    }
    if let Some(outward) = &jump.load.outward {
        let pull = outward.force(&Vector3::from(state.position));
        for i in 0..3 {
            state.force[i] -= load * pull[i];
        }
        for l in 1..W {
            let change = outward.change(&Vector3::new(state.d[3][l], state.d[4][l], state.d[5][l]));
            for i in 0..3 {
                state.d[6 + i][l] -= load * change[i];
            }
        }
    }
    if W > 1 && jump.load.follows() {
        for l in 1..W {
            let turning = Vector3::new(state.d[0][l], state.d[1][l], state.d[2][l]);
            let change = jump.load.change(&rotation, &turning);
            for i in 0..3 {
                state.d[6 + i][l] -= load * change.force[i];
                state.d[9 + i][l] -= load * change.moment[i];
            }
        }
    }
}

/// Takes the state along one stretch, without what jumps at its end, and adds to `lengths` what each tendon measures.
/// `tensions` and `lengths` run parallel to the span's tendons.
fn carry_stretch<const W: usize>(
    stretch: &Stretch,
    load: f64,
    tensions: &[[f64; W]],
    state: &mut RodState<W>,
    lengths: &mut [[f64; W]],
) where
    RodState<W>: RodKernel<W>,
{
    if stretch.channels.is_empty() {
        advance(&stretch.piece, load, state);
    } else {
        advance_tendons(&stretch.piece, &stretch.channels, tensions, load, state, lengths);
    }
}

/// Values only, along one stretch, without what jumps at its end.
pub(crate) fn carry_through(stretch: &Stretch, acting: &Acting<'_>, state: &mut Plain) {
    let tensions: Vec<[f64; 1]> = acting.pulls.iter().map(|pull| [pull.tension]).collect();
    let mut lengths = vec![[0.0; 1]; tensions.len()];
    carry_stretch(stretch, acting.load, &tensions, state, &mut lengths);
}

/// Values only, along stretches with what jumps at their ends; the lengths of the tendons.
pub(crate) fn carry_plain(stretches: &[Stretch], acting: &Acting<'_>, state: &mut Plain) -> Vec<[f64; 1]> {
    carry_marked(stretches, acting, state, &mut Vec::new())
}

/// The same, with force and moment at the end of every stretch.
pub(crate) fn carry_marked(
    stretches: &[Stretch],
    acting: &Acting<'_>,
    state: &mut Plain,
    met: &mut Vec<[f64; 2]>,
) -> Vec<[f64; 1]> {
    met.clear();
    let tensions: Vec<[f64; 1]> = acting.pulls.iter().map(|pull| [pull.tension]).collect();
    let mut lengths = vec![[0.0; 1]; tensions.len()];
    for stretch in stretches {
        carry_stretch(stretch, acting.load, &tensions, state, &mut lengths);
        let before = if stretches.len() > 1 { sizes(state) } else { [0.0; 2] };
        for &j in &stretch.jumps {
            jump(&acting.jumps[j], acting.load, state);
        }
        if stretches.len() > 1 {
            met.push(larger(before, sizes(state)));
        }
    }
    lengths
}

/// Size of force and moment.
fn sizes<const W: usize>(state: &RodState<W>) -> [f64; 2] {
    [state.force, state.moment].map(|v| Vector3::from(v).norm())
}

fn larger(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}

fn carry_lanes<const W: usize>(
    stretches: &[Stretch],
    acting: &Acting<'_>,
    first: &[usize],
    start: &Plain,
    end: &mut SegmentEnd,
) where
    RodState<W>: RodKernel<W>,
{
    let mut lanes: RodState<W> = RodState {
        rotation: start.rotation,
        position: start.position,
        force: start.force,
        moment: start.moment,
        d: [[0.0; W]; 12],
    };
    for (j, column) in end.columns[..end.count].iter().enumerate() {
        for i in 0..12 {
            lanes.d[i][1 + j] = column[i];
        }
    }
    // Unknown tensions come last.
    let mut lane = 1 + end.count - acting.unknown_tensions();
    let mut tensions = vec![[0.0; W]; acting.pulls.len()];
    for (tension, pull) in tensions.iter_mut().zip(acting.pulls) {
        tension[0] = pull.tension;
        if pull.unknown {
            tension[lane] = 1.0;
            lane += 1;
        }
    }
    let mut lengths = vec![[0.0; W]; acting.pulls.len()];
    for &j in first {
        jump(&acting.jumps[j], acting.load, &mut lanes);
    }
    end.met.clear();
    for stretch in stretches {
        carry_stretch(stretch, acting.load, &tensions, &mut lanes, &mut lengths);
        // One stretch alone ends where the segment does.
        let before = if stretches.len() > 1 { sizes(&lanes) } else { [0.0; 2] };
        for &j in &stretch.jumps {
            jump(&acting.jumps[j], acting.load, &mut lanes);
        }
        if stretches.len() > 1 {
            end.met.push(larger(before, sizes(&lanes)));
        }
    }
    end.state = Plain {
        rotation: lanes.rotation,
        position: lanes.position,
        force: lanes.force,
        moment: lanes.moment,
        d: [[0.0; 1]; 12],
    };
    for (j, column) in end.columns[..end.count].iter_mut().enumerate() {
        for i in 0..12 {
            column[i] = lanes.d[i][1 + j];
        }
    }
    end.lengths.clear();
    for lanes in &lengths {
        let mut length = [0.0; 1 + MAX_COLUMNS];
        length[..=end.count].copy_from_slice(&lanes[..=end.count]);
        end.lengths.push(length);
    }
}

/// Values and derivatives: `end.columns[..end.count]` hold the start's derivatives, then the end's. Those along the
/// unknown tensions of tendons are put behind them.
pub(crate) fn carry_columns(
    stretches: &[Stretch],
    acting: &Acting<'_>,
    first: &[usize],
    start: &Plain,
    end: &mut SegmentEnd,
) {
    let unknown = acting.unknown_tensions();
    end.columns[end.count..end.count + unknown].fill([0.0; 12]);
    end.count += unknown;
    match end.count {
        0..=3 => carry_lanes::<4>(stretches, acting, first, start, end),
        4..=7 => carry_lanes::<8>(stretches, acting, first, start, end),
        8..=11 => carry_lanes::<12>(stretches, acting, first, start, end),
        12..=15 => carry_lanes::<16>(stretches, acting, first, start, end),
        _ => carry_lanes::<24>(stretches, acting, first, start, end),
    }
}

impl Acting<'_> {
    fn unknown_tensions(&self) -> usize {
        self.pulls.iter().filter(|pull| pull.unknown).count()
    }
}
