//! Spans cut into elements, with the state at their points.

use super::Detail;
use super::element::{self, Point};
use super::rule::Rule;
use crate::beam::BeamLaw;
use crate::mesh::Stretch;
use crate::shooting::{Acting, Plain, carry_plain, carry_through, jump, pose_of};
use crate::system::Equilibrium;
use flexura_nonlinear::Breakdown;
use flexura_spatial::{Matrix3, Vector3};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

type V = Vector3<f64>;

/// Angle through which a section turns along an element at most, at rest or bent, rad.
const TURN: f64 = 2.5;
/// The same of what dies away from an end under a force or on a foundation.
const GROWTH: f64 = 5.0;
/// Elements that a stretch has at least along which the law varies.
const VARYING: f64 = 2.0;
/// Most elements of a span.
const MOST: usize = 2000;
/// Places along a smooth stretch at which it is looked at.
const LOOKS: usize = 9;

/// One element.
#[derive(Clone, Debug)]
pub(super) struct Element {
    /// Arc lengths of its ends, m.
    pub s: [f64; 2],
    /// The tangent; see [`element::tangent`].
    pub tangent: DMatrix<f64>,
    /// What rates add to it per time of damping, of beams that have one; see [`element::viscous`].
    pub viscous: Option<DMatrix<f64>>,
    /// For each tendon in it how its length goes with the motions of the nodes.
    pub threads: Vec<(usize, DVector<f64>)>,
    /// Where its nodes are.
    pub places: Vec<V>,
    /// Orientation of its nodes.
    pub rotations: Vec<Matrix3<f64>>,
}

/// A span as elements.
#[derive(Clone, Debug)]
pub(super) struct Elements {
    pub rule: Arc<Rule>,
    pub list: Vec<Element>,
    /// Components of the wrench that are unknowns at each Gauss point.
    pub kept: usize,
    /// First of the span's own unknowns in the plain tangent.
    pub first: usize,
    /// Is the last node's motion one of them?
    pub free: bool,
    /// The state at the start, before any load there, and at the end, after it.
    pub ends: [Plain; 2],
}

impl Elements {
    /// Unknowns of an element besides its first node's motion and, of a held last one, its last node's.
    fn own(&self) -> usize {
        let p = self.rule.order;
        6 * p + self.kept * p
    }

    pub fn count(&self) -> usize {
        self.own() * self.list.len() - if self.free { 0 } else { 6 }
    }

    /// Where the motion of a node of an element stands; None at held ends.
    pub fn node(&self, element: usize, node: usize) -> Option<usize> {
        let p = self.rule.order;
        let start = self.first + self.own() * element;
        match node {
            0 => Some(start.checked_sub(6)?).filter(|_| element > 0),
            node if node < p => Some(start + 6 * (node - 1)),
            _ if element + 1 < self.list.len() || self.free => Some(start + 6 * (p - 1) + self.kept * p),
            _ => None,
        }
    }

    /// Where the first kept component of the wrenches of an element stands.
    pub fn wrenches(&self, element: usize) -> usize {
        self.first + self.own() * element + 6 * (self.rule.order - 1)
    }

    pub fn multipliers(&self) -> usize {
        self.kept * self.rule.order * self.list.len()
    }
}

/// A place at which the state is wanted.
struct Wanted {
    s: f64,
    state: Plain,
}

/// All nodes and points of elements: by turns, for between two nodes lies one point.
fn wanted(borders: &[f64], rule: &Rule, state: Plain) -> Vec<Wanted> {
    let mut wanted = Vec::new();
    for pair in borders.windows(2) {
        let at = |x: &f64| pair[0] + (pair[1] - pair[0]) * 0.5 * (1.0 + x);
        for (node, point) in rule.nodes.iter().zip(&rule.points) {
            wanted.push(Wanted { s: at(node), state });
            wanted.push(Wanted { s: at(point), state });
        }
        wanted.push(Wanted { s: pair[1], state });
    }
    wanted
}

impl Equilibrium {
    /// The states of a span at arc lengths in order, before what jumps there, and that at its end after all.
    fn states_at(&self, span: usize, places: &mut [Wanted]) -> Plain {
        let description = &self.lowered.spans[span];
        let law = &self.lowered.beams[description.beam];
        let mesh = &self.meshes[span];
        let pulls = self.pulls(span);
        let acting = Acting { jumps: &description.jumps, load: self.load, pulls: &pulls };
        let tiny = 1e-13 * law.length;
        let mut state = self.head_state(span);
        let mut next = 0;
        while next < places.len() && places[next].s <= description.s[0] + tiny {
            places[next].state = state;
            next += 1;
        }
        for &j in &mesh.first_jumps {
            jump(&description.jumps[j], self.load, &mut state);
        }
        for (k, segment) in mesh.segments.iter().enumerate() {
            if k > 0 {
                state = self.inner_state(self.layout.spans[span].inner[k - 1].state);
            }
            for stretch in segment {
                let start = state;
                let density = stretch.piece.steps as f64 / (stretch.s[1] - stretch.s[0]);
                let mut at = stretch.s[0];
                while next < places.len() && places[next].s <= stretch.s[1] + tiny {
                    let s = places[next].s.min(stretch.s[1]);
                    if s - at > tiny {
                        let steps = ((density * (s - at)).ceil() as usize).max(1);
                        let part = Stretch::new(law, description, [at, s], steps, Vec::new());
                        carry_through(&part, &acting, &mut state);
                        at = s;
                    }
                    places[next].state = state;
                    next += 1;
                }
                state = start;
                carry_plain(std::slice::from_ref(stretch), &acting, &mut state);
            }
        }
        while next < places.len() {
            places[next].state = state;
            next += 1;
        }
        state
    }

    fn point(&self, span: usize, law: &BeamLaw, s: f64, state: &Plain) -> Point {
        let local = law.scaled_law(s);
        let pose = pose_of(state);
        let rotation = pose.rotation.to_rotation_matrix().into_inner();
        let (force, moment) = (V::from(state.force), V::from(state.moment));
        let whole = [rotation.tr_mul(&force), rotation.tr_mul(&moment)];
        let (threads, [n, m]) = self.threads_at(span, s, &local, whole);
        let c = &local.compliance;
        let strain = c.fixed_view::<3, 3>(0, 0) * n + c.fixed_view::<3, 3>(0, 3) * m + V::x();
        let load = law.scaled_load(s);
        let follower = [load.section_force, load.section_moment].map(|q| rotation * V::from(q) * self.load);
        let place = V::from(state.position);
        Point {
            rotation,
            axis: rotation * strain,
            force,
            moment,
            compliance: local.compliance,
            foundation: law.foundation_slope(s, &place),
            follower,
            threads,
        }
    }

    /// Phase (rad) of a smooth stretch of a span: what its elements must resolve.
    fn phase_of(&self, span: usize, [a, b]: [f64; 2], detail: &Detail) -> f64 {
        let law = &self.lowered.beams[self.lowered.spans[span].beam];
        let scale = law.scale;
        let whole = (b - a) / scale.length;
        let level = self.courses[span].over([a, b]);
        let unit = self.square_unit();
        let (mut turn, mut growth, mut wave) = (0.0_f64, 0.0_f64, 0.0_f64);
        let looks = if law.is_even() { 1 } else { LOOKS };
        for i in 0..looks {
            let s = a + (b - a) * (i as f64 + 0.5) / looks as f64;
            let local = law.scaled_law(s);
            let c = &local.compliance;
            let soft = c[(4, 4)].max(c[(5, 5)]);
            let softest = soft.max(c[(3, 3)]);
            turn = turn.max(local.k0.norm() + softest * level.moment);
            let (mass, rotary) = self.scaled_inertia(law, s);
            let square = detail.square / unit;
            let bend = (square * mass * soft).powf(0.25);
            let twist = (square * rotary[0] * c[(3, 3)]).sqrt();
            let stretch = (square * mass * c[(0, 0)].max(c[(1, 1)]).max(c[(2, 2)])).sqrt();
            wave = wave.max(bend).max(twist).max(stretch);
            let push = law.foundation_slope(s, &V::zeros()).amax().max(level.foundation);
            growth = growth.max((soft * level.force).sqrt()).max((push * soft).powf(0.25));
        }
        let varying = if law.is_even() { 0.0 } else { VARYING };
        (turn * whole / TURN).max(growth * whole / GROWTH).max(wave * whole / detail.phase).max(varying)
    }

    /// Arc lengths (m) at which the elements of a span begin and end.
    fn borders(&self, span: usize, detail: &Detail) -> Vec<f64> {
        let description = &self.lowered.spans[span];
        let mut borders = vec![description.s[0]];
        for pair in description.inside(&self.lowered.beams[description.beam]).windows(2) {
            let parts = self.phase_of(span, [pair[0], pair[1]], detail).ceil().clamp(1.0, MOST as f64);
            let at = |i: usize| pair[0] + (pair[1] - pair[0]) * (i as f64 / parts);
            borders.extend((1..parts as usize).map(at));
            borders.push(pair[1]);
        }
        borders
    }

    /// Cuts a span whose own unknowns begin at `first`.
    pub(super) fn elements(
        &self,
        span: usize,
        rule: &Arc<Rule>,
        detail: &Detail,
        first: usize,
    ) -> Result<Elements, Breakdown> {
        let description = &self.lowered.spans[span];
        let law = &self.lowered.beams[description.beam];
        let state = self.head_state(span);
        let mut wanted = wanted(&self.borders(span, detail), rule, state);
        let end = self.states_at(span, &mut wanted);
        let per = 2 * rule.order + 1;
        let mut found = Vec::with_capacity(wanted.len() / per);
        let mut kept = [false; 6];
        for part in wanted.chunks(per) {
            let points: Vec<Point> =
                part.iter().skip(1).step_by(2).map(|at| self.point(span, law, at.s, &at.state)).collect();
            let beam = law.length / law.scale.length;
            for point in &points {
                let own = element::kept(&point.compliance, beam);
                (0..6).for_each(|i| kept[i] |= own[i]);
            }
            found.push(points);
        }
        let mut list = Vec::with_capacity(found.len());
        for (part, points) in wanted.chunks(per).zip(&found) {
            let s = [part[0].s, part[per - 1].s];
            let length = (s[1] - s[0]) / law.scale.length;
            let tangent = element::tangent(rule, length, points, &kept).ok_or(Breakdown::Singular)?;
            if !tangent.iter().all(|value| value.is_finite()) {
                return Err(Breakdown::NotFinite);
            }
            let viscous = if self.damping_of(description.beam) > 0.0 {
                Some(element::viscous(rule, length, points, &kept).ok_or(Breakdown::Singular)?)
            } else {
                None
            };
            let threads = element::lengths(rule, length, points);
            let nodes = || part.iter().step_by(2);
            let places = nodes().map(|at| V::from(at.state.position)).collect();
            let rotations =
                nodes().map(|at| pose_of(&at.state).rotation.to_rotation_matrix().into_inner()).collect();
            list.push(Element { s, tangent, viscous, threads, places, rotations });
        }
        let mut elements = Elements {
            rule: rule.clone(),
            list,
            kept: kept.iter().filter(|kept| **kept).count(),
            first,
            free: description.end.is_none(),
            ends: [state, end],
        };
        self.follow_points(span, &mut elements);
        Ok(elements)
    }

    /// Point loads on the span that follow the section: -δu·(θ × f) - δθ·(θ × m) at the node where they act.
    fn follow_points(&self, span: usize, elements: &mut Elements) {
        let description = &self.lowered.spans[span];
        let tiny = 1e-9 * self.lowered.beams[description.beam].length;
        let order = elements.rule.order;
        for jump in description.jumps.iter().filter(|jump| jump.load.follows()) {
            let Some(element) = elements.list.iter_mut().find(|element| jump.s <= element.s[1] + tiny) else {
                continue;
            };
            let node = if jump.s <= element.s[0] + tiny { 0 } else { order };
            let rotation = element.rotations[node];
            let [force, moment] = [jump.load.follower.force, jump.load.follower.moment]
                .map(|load| flexura_spatial::hat(&(rotation * load * self.load)));
            for i in 0..3 {
                for j in 0..3 {
                    element.tangent[(6 * node + i, 6 * node + j)] += moment[(i, j)];
                    element.tangent[(6 * node + 3 + i, 6 * node + j)] += force[(i, j)];
                }
            }
        }
    }
}
