//! Residual and tangent.
//!
//! Pattern of the interface tangent for one span between nodes A and B (rows are equations, columns unknowns):
//!
//! ```text
//!                    pose A   q_start   wrench   x_last   q_end   pose B
//! balance of A     [   x         x         x                             ]
//! effort of start  [   x         x         x                             ]
//! closure at B     [   x         x         x        x       x        x   ]
//! chain            [   x         x         x        x                    ]
//! effort of end    [   x         x         x        x       x        x   ]
//! balance of B     [   x         x         x        x       x        x   ]
//! ```
//!
//! With one segment there is no x_last and the closure depends on the head directly; with more, the end depends
//! on x_last only. Closure rows are `log(R_end R_targetᵀ)` and `p_end - p_target`; their tangent is taken
//! before the inverse left Jacobian of the logarithm, which leaves the Newton step exactly the same because
//! that Jacobian leaves the residual itself unchanged.

use crate::held::{Held, HoldRef};
use crate::shooting::{
    Acting, MAX_COLUMNS, Plain, SegmentEnd, carry_columns, carry_plain, jump, plain, pose_of, wrench_of,
};
use crate::system::Equilibrium;
use flexura_nonlinear::{Block, Breakdown, Matrix};
use flexura_spatial::{Twist, Vector3, Wrench, log};

type V = Vector3<f64>;

/// What carrying a state with its derivatives costs beside carrying it alone.
const COLUMNS: f64 = 6.0;

pub(crate) fn unit(i: usize) -> V {
    let mut e = V::zeros();
    e[i] = 1.0;
    e
}

pub(crate) fn rows(column: &[f64; 12], first: usize) -> V {
    V::new(column[first], column[first + 1], column[first + 2])
}

/// Lists how a wrench changes along each unknown that it depends on.
pub(crate) type WrenchColumns<'a> = dyn Fn(&mut dyn FnMut(usize, Wrench)) + 'a;

impl Equilibrium {
    fn start_hold(&self, span: usize) -> Held {
        let hold = &self.lowered.spans[span].start;
        let configuration = self.configuration(&self.layout.spans[span].start);
        self.held(&hold.carrier, &HoldRef::of(hold), &configuration)
    }

    /// The state at the start of a span, before any point load there.
    pub(crate) fn head_state(&self, span: usize) -> Plain {
        let held = self.start_hold(span);
        plain(&held.target, &self.start_wrench(span))
    }

    fn start_wrench(&self, span: usize) -> Wrench {
        let slot = &self.layout.spans[span].wrench;
        let force = if self.lowered.spans[span].determinate {
            self.known_force[span] * self.load
        } else {
            self.triple(slot.state)
        };
        Wrench::new(force, self.triple(slot.state + 3))
    }

    /// Calls `f(column, unknown)` for every unknown that a span's head depends on; returns their number.
    pub(crate) fn head_unknowns(&self, span: usize, mut f: impl FnMut(usize, usize)) -> usize {
        let slots = &self.layout.spans[span];
        let mut count = 0;
        let mut visit = |first: usize, n: usize| {
            for i in 0..n {
                f(count, first + i);
                count += 1;
            }
        };
        if let Some(node) = self.lowered.spans[span].start.carrier.node {
            visit(self.layout.nodes[node].unknown, 6);
        }
        visit(slots.start.unknown, slots.start.count);
        visit(slots.wrench.unknown, slots.wrench.count);
        for slot in self.lowered.spans[span].tendons.iter().filter_map(|&rope| self.layout.ropes[rope]) {
            visit(slot.unknown, 1);
        }
        count
    }

    /// Evaluates the residual, and the tangent too if asked.
    pub(crate) fn evaluate(&mut self, tangent: bool) -> Result<(), Breakdown> {
        let mut matrix = std::mem::take(&mut self.tangent);
        let mut r = std::mem::take(&mut self.r);
        r.fill(0.0);
        if tangent {
            matrix.reset();
        }
        let mut sink = Sink { r: &mut r, matrix: tangent.then_some(&mut matrix) };
        let mut outcome = Ok(());
        for span in 0..self.lowered.spans.len() {
            outcome = outcome.and(self.evaluate_span(span, &mut sink));
        }
        for joint in 0..self.lowered.joints.len() {
            self.evaluate_joint(joint, &mut sink);
        }
        self.evaluate_gears(&mut sink);
        self.evaluate_nests(&mut sink);
        self.evaluate_node_loads(&mut sink);
        for ([moment, force], slot) in self.kick.0.iter().zip(&self.layout.nodes) {
            let part = self.kick.1 * self.load;
            sink.add_residual(slot.unknown, &(moment * part));
            sink.add_residual(slot.unknown + 3, &(force * part));
        }
        self.evaluate_drag(&mut sink);
        self.evaluate_springs(&mut sink);
        self.evaluate_ropes(&mut sink);
        if r.iter().any(|v| !v.is_finite()) {
            outcome = outcome.and(Err(Breakdown::NotFinite));
        }
        self.tangent = matrix;
        self.r = r;
        outcome
    }

    fn evaluate_span(&mut self, span: usize, sink: &mut Sink<'_>) -> Result<(), Breakdown> {
        let columns = if sink.matrix.is_some() { COLUMNS } else { 1.0 };
        self.effort.0 += columns * (self.meshes[span].steps() + self.meshes[span].segments.len()) as f64;
        let held = self.start_hold(span);
        let wrench = self.start_wrench(span);
        let head = plain(&held.target, &wrench);
        let mut ends = std::mem::take(&mut self.ends[span]);
        let mut gaps = std::mem::take(&mut self.gaps[span]);
        let (load, derive) = (self.load, sink.matrix.is_some());
        let pulls = self.pulls(span);
        {
            let mesh = &self.meshes[span];
            let jumps = &self.lowered.spans[span].jumps;
            let acting = Acting { jumps, load, pulls: &pulls };
            let mut level = crate::mesh::Level::default();
            for (k, (segment, end)) in mesh.segments.iter().zip(&mut ends).enumerate() {
                let first: &[usize] = if k == 0 { &mesh.first_jumps } else { &[] };
                let start =
                    if k == 0 { head } else { self.inner_state(self.layout.spans[span].inner[k - 1].state) };
                if derive {
                    if k == 0 {
                        self.carry_head(span, &held, &wrench, segment, &acting, end);
                    } else {
                        end.seed(0);
                        carry_columns(segment, &acting, first, &start, end);
                    }
                } else {
                    end.state = start;
                    for &j in first {
                        jump(&jumps[j], load, &mut end.state);
                    }
                    let lengths = carry_plain(segment, &acting, &mut end.state);
                    end.lengths.resize(lengths.len(), [0.0; 1 + MAX_COLUMNS]);
                    end.lengths.iter_mut().zip(&lengths).for_each(|(to, from)| to[0] = from[0]);
                }
                let size = |v: &[f64; 3]| V::from(*v).norm();
                level.force = level.force.max(size(&start.force)).max(size(&end.state.force));
                level.moment = level.moment.max(size(&start.moment)).max(size(&end.state.moment));
                let law = &self.lowered.beams[self.lowered.spans[span].beam];
                if law.founded.is_nonlinear() {
                    let last = segment.last().map_or(mesh.start_of(k), |stretch| stretch.s[1]);
                    for (s, state) in [(mesh.start_of(k), &start), (last, &end.state)] {
                        let [up, down] = law.foundation_slopes(s, &V::from(state.position));
                        level.foundation = level.foundation.max(up - down);
                    }
                }
                if k + 1 < mesh.segments.len() {
                    let next = self.inner_state(self.layout.spans[span].inner[k].state);
                    gaps[k] = gap(&end.state, &next);
                }
            }
            level.tendons = self.tendon_moment(span);
            self.levels[span] = level;
        }
        let outcome = if derive { self.eliminate(span, &ends, sink) } else { Ok(()) };
        self.start_rows(span, &held, &wrench, sink);
        let last = &ends[ends.len() - 1];
        self.end_rows(span, last, sink);
        self.tendon_rows(span, &ends, sink);
        self.ends[span] = ends;
        self.gaps[span] = gaps;
        outcome
    }

    /// Removes the inner states but the last; what is left stands in the rows of the last.
    fn eliminate(&mut self, span: usize, ends: &[SegmentEnd], sink: &mut Sink<'_>) -> Result<(), Breakdown> {
        let Some(last) = self.layout.spans[span].inner.last().copied() else { return Ok(()) };
        let mut chain = std::mem::take(&mut self.chains[span]);
        let turned = |k: usize, column: &[f64; 12]| {
            let next = self.inner_state(self.layout.spans[span].inner[k].state);
            let error = pose_of(&next).rotation * pose_of(&ends[k].state).rotation.inverse();
            let mut out = *column;
            out[..3].copy_from_slice((error * rows(column, 0)).as_slice());
            out
        };
        let count = ends[0].count;
        let columns: Vec<[f64; 12]> = ends[0].columns[..count].iter().map(|c| turned(0, c)).collect();
        let head: Vec<Vec<f64>> = (0..12).map(|i| columns.iter().map(|c| c[i]).collect()).collect();
        chain.start(&head);
        let mut outcome = Ok(());
        for k in 1..ends.len() - 1 {
            let mut block: Block = [[0.0; 12]; 12];
            for (j, column) in ends[k].columns[..12].iter().enumerate() {
                let column = turned(k, column);
                for i in 0..12 {
                    block[i][j] = column[i];
                }
            }
            outcome = outcome.and(chain.extend(&block));
        }
        if let Some(matrix) = sink.matrix.as_deref_mut() {
            for i in 0..12 {
                let row = last.unknown + i;
                self.head_unknowns(span, |k, unknown| matrix.add(row, unknown, chain.left_head[i][k]));
                for j in 0..12 {
                    matrix.add(row, last.unknown + j, chain.left_state[i][j]);
                }
            }
        }
        self.chains[span] = chain;
        outcome
    }

    /// Effort at the start, and what the span's start exerts on the node that carries it: +F, +M.
    fn start_rows(&self, span: usize, held: &Held, wrench: &Wrench, sink: &mut Sink<'_>) {
        let slots = &self.layout.spans[span];
        let hold = &self.lowered.spans[span].start;
        // The joint's wrench, parent on child, is what holds the beam: minus the internal wrench.
        let on_child = -*wrench;
        let derivative = |f: &mut dyn FnMut(usize, Wrench)| {
            for i in 0..slots.wrench.count {
                let row = 6 - slots.wrench.count + i;
                let change = if row < 3 {
                    Wrench::new(unit(row), V::zeros())
                } else {
                    Wrench::new(V::zeros(), unit(row - 3))
                };
                f(slots.wrench.unknown + i, -change);
            }
        };
        self.hold_rows(held, &slots.start, &hold.coordinates, &on_child, &derivative, sink);
    }

    /// What must hold at the end of a span.
    fn end_rows(&self, span: usize, last: &SegmentEnd, sink: &mut Sink<'_>) {
        let slots = &self.layout.spans[span];
        let description = &self.lowered.spans[span];
        let wrench = wrench_of(&last.state);
        let single = slots.inner.is_empty();
        let mut unknowns = [0usize; MAX_COLUMNS];
        let count = match slots.inner.last() {
            None => self.head_unknowns(span, |k, unknown| unknowns[k] = unknown),
            Some(inner) => {
                for (i, u) in unknowns.iter_mut().enumerate().take(12) {
                    *u = inner.unknown + i;
                }
                12
            }
        };
        debug_assert!(!single || sink.matrix.is_none() || count == last.count);
        let columns = || unknowns[..count].iter().copied().zip(&last.columns[..count]);
        let base = slots.wrench.unknown;
        let Some(hold) = &description.end else {
            // Free: nothing beyond. A determinate span's force vanishes by construction.
            let skip = 6 - slots.wrench.count;
            let all = [wrench.force, wrench.moment];
            for i in skip..6 {
                sink.r[base + i - skip] += all[i / 3][i % 3];
                if let Some(matrix) = sink.matrix.as_deref_mut() {
                    for (unknown, column) in columns() {
                        matrix.add(base + i - skip, unknown, column[6 + i]);
                    }
                }
            }
            return;
        };
        let held = self.held(&hold.carrier, &HoldRef::of(hold), &self.configuration(&slots.end));
        let end = pose_of(&last.state);
        let error = end.rotation * held.target.rotation.inverse();
        sink.add_residual(base, &log(&error));
        sink.add_residual(base + 3, &(end.position - held.target.position));
        if sink.matrix.is_some() {
            for (unknown, column) in columns() {
                sink.add(base, unknown, &rows(column, 0));
                sink.add(base + 3, unknown, &rows(column, 3));
            }
            self.target_columns(&held, slots.end.unknown, |unknown, twist| {
                sink.add(base, unknown, &-(error * twist.angular));
                sink.add(base + 3, unknown, &-twist.linear);
            });
        }
        let derivative = |f: &mut dyn FnMut(usize, Wrench)| {
            for (unknown, column) in columns() {
                f(unknown, Wrench::new(rows(column, 6), rows(column, 9)));
            }
        };
        self.hold_rows(&held, &slots.end, &hold.coordinates, &wrench, &derivative, sink);
    }

    /// Calls `f(unknown, motion of the target)` for the node and coordinates that move a held frame.
    pub(crate) fn target_columns(&self, held: &Held, coordinates: usize, mut f: impl FnMut(usize, Twist)) {
        if let Some((node, _)) = held.node {
            for i in 0..6 {
                f(self.layout.nodes[node].unknown + i, held.by_node(i));
            }
        }
        for i in 0..held.count {
            f(coordinates + i, held.by_coordinate(i));
        }
    }

    /// Balance and effort rows of a joint or hold whose carrier is the parent: the parent feels minus the wrench,
    /// and `Hᵀ W = τ`. `derivative` lists how W changes along the unknowns that it depends on.
    pub(crate) fn hold_rows(
        &self,
        held: &Held,
        slot: &crate::layout::CoordinateSlot,
        coordinates: &crate::coordinates::Coordinates,
        wrench: &Wrench,
        derivative: &WrenchColumns<'_>,
        sink: &mut Sink<'_>,
    ) {
        if let Some((node, _)) = held.node {
            let base = self.layout.nodes[node].unknown;
            let arm = held.arm();
            // Rows of a node: moment about its origin first, then force, as its unknowns are turning and shift.
            sink.add_residual(base, &-(wrench.moment + arm.cross(&wrench.force)));
            sink.add_residual(base + 3, &-wrench.force);
            if sink.matrix.is_some() {
                derivative(&mut |unknown, change| {
                    sink.add(base, unknown, &-(change.moment + arm.cross(&change.force)));
                    sink.add(base + 3, unknown, &-change.force);
                });
                self.target_columns(held, slot.unknown, |unknown, twist| {
                    // The arm turns with the node but does not change when the node only shifts.
                    let shifts = twist.angular == V::zeros() && (base + 3..base + 6).contains(&unknown);
                    if !shifts {
                        sink.add(base, unknown, &-twist.linear.cross(&wrench.force));
                    }
                });
            }
        }
        if held.count == 0 {
            return;
        }
        let configuration = self.configuration(slot);
        let (tau, slope) = coordinates.efforts(&configuration, self.load);
        let lever = held.target.position - held.moving.position;
        let about = wrench.moment + lever.cross(&wrench.force);
        for i in 0..held.count {
            let row = slot.unknown + i;
            sink.r[row] += held.effort(i, wrench) - tau[i];
            if sink.matrix.is_none() {
                continue;
            }
            derivative(&mut |unknown, change| sink.add_number(row, unknown, held.effort(i, &change)));
            let h = &held.subspace[i];
            // H and the lever turn with whatever carries F, and the lever with M.
            let turned = |axis: &V, lines: bool| {
                let lines = if lines {
                    axis.cross(&h.angular).dot(&about) + axis.cross(&h.linear).dot(&wrench.force)
                } else {
                    0.0
                };
                lines + h.angular.dot(&axis.cross(&lever).cross(&wrench.force))
            };
            if let Some((node, _)) = held.node {
                for k in 0..3 {
                    sink.add_number(row, self.layout.nodes[node].unknown + k, turned(&unit(k), true));
                }
            }
            for (j, other) in held.subspace.iter().enumerate().take(held.count) {
                let change = coordinates.subspace_change(&configuration, i, j);
                let lines = (held.fixed * change.angular).dot(&about)
                    + (held.fixed * change.linear).dot(&wrench.force);
                sink.add_number(row, slot.unknown + j, turned(&other.angular, false) + lines - slope[i][j]);
            }
        }
    }
}

/// `-(next ⊟ end)`: what is still missing from the step of the next state.
fn gap(end: &Plain, next: &Plain) -> [f64; 12] {
    let turn = log(&(pose_of(next).rotation * pose_of(end).rotation.inverse()));
    let mut g = [0.0; 12];
    for i in 0..3 {
        g[i] = -turn[i];
        g[3 + i] = end.position[i] - next.position[i];
        g[6 + i] = end.force[i] - next.force[i];
        g[9 + i] = end.moment[i] - next.moment[i];
    }
    g
}

/// Where residual and, if wanted, tangent go.
pub(crate) struct Sink<'a> {
    pub r: &'a mut [f64],
    pub matrix: Option<&'a mut Matrix>,
}

impl Sink<'_> {
    pub fn add_residual(&mut self, row: usize, v: &V) {
        for i in 0..3 {
            self.r[row + i] += v[i];
        }
    }

    pub fn add(&mut self, row: usize, column: usize, v: &V) {
        if let Some(matrix) = self.matrix.as_deref_mut() {
            for i in 0..3 {
                matrix.add(row + i, column, v[i]);
            }
        }
    }

    pub fn add_number(&mut self, row: usize, column: usize, v: f64) {
        if let Some(matrix) = self.matrix.as_deref_mut() {
            matrix.add(row, column, v);
        }
    }
}
