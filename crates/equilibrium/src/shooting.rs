//! Spans carried from node to node, with their derivatives.
//!
//! The head of a span depends on at most eighteen unknowns: six of the node that carries it, up to six
//! coordinates of its hold, six of its start wrench. Of these the kernel carries at most the twelve of a start
//! pose and start wrench, from which the others follow; later segments start from a state of twelve unknowns.
//! The kernel carries as many derivative lanes as there are, rounded up to four, eight, twelve or sixteen.

use crate::lower::Jump;
use crate::mesh::Stretch;
use flexura_mechanics::rod::{RodState, advance};
use flexura_spatial::{Pose, Quaternion, UnitQuaternion, Vector3, Wrench};

/// Most unknowns that the start of a segment depends on.
pub(crate) const MAX_COLUMNS: usize = 18;

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
        Self { state: Plain::origin(), columns: [[0.0; 12]; MAX_COLUMNS], count: 0 }
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

fn carry<const W: usize>(stretches: &[Stretch], jumps: &[Jump], load: f64, state: &mut RodState<W>) {
    for stretch in stretches {
        advance(&stretch.piece, load, state);
        for &j in &stretch.jumps {
            jump(&jumps[j], load, state);
        }
    }
}

/// Values only.
pub(crate) fn carry_plain(stretches: &[Stretch], jumps: &[Jump], load: f64, state: &mut Plain) {
    carry(stretches, jumps, load, state);
}

fn carry_lanes<const W: usize>(
    stretches: &[Stretch],
    jumps: &[Jump],
    first: &[usize],
    load: f64,
    start: &Plain,
    end: &mut SegmentEnd,
) {
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
    for &j in first {
        jump(&jumps[j], load, &mut lanes);
    }
    carry(stretches, jumps, load, &mut lanes);
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
}

/// Values and derivatives: `end.columns[..end.count]` hold the start's derivatives, then the end's.
pub(crate) fn carry_columns(
    stretches: &[Stretch],
    jumps: &[Jump],
    first: &[usize],
    load: f64,
    start: &Plain,
    end: &mut SegmentEnd,
) {
    match end.count {
        0..=3 => carry_lanes::<4>(stretches, jumps, first, load, start, end),
        4..=7 => carry_lanes::<8>(stretches, jumps, first, load, start, end),
        8..=11 => carry_lanes::<12>(stretches, jumps, first, load, start, end),
        _ => carry_lanes::<16>(stretches, jumps, first, load, start, end),
    }
}
