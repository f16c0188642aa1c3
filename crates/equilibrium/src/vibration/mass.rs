//! What has inertia, at the nodes of elements and on bodies.

use super::cut::Elements;
use crate::beam::BeamLaw;
use crate::stability::Motions;
use crate::system::Equilibrium;
use flexura_spatial::{Matrix3, Matrix6, Vector3, Vector6, hat};

type V = Vector3<f64>;

/// Inertia of something rigid, nondimensional.
pub(super) struct Lump {
    /// In (turning, shift) at `place`, global axes: kinetic energy is half the quadratic form of their rates.
    pub block: Matrix6<f64>,
    /// Where the shift is taken.
    pub place: V,
    /// Is it the inertia of a body or of a mass on a node, whose centrifugal force is among the node's loads?
    pub on_node: bool,
    /// How `place` moves along each unknown of the plain tangent.
    pub motions: Motions,
}

impl Lump {
    /// A mass whose centre is `arm` away from `place`, with moments of inertia about that centre.
    fn new(mass: f64, arm: &V, inertia: &Matrix3<f64>, place: V, motions: Motions) -> Self {
        let lever = hat(arm) * mass;
        let mut block = Matrix6::zeros();
        block.fixed_view_mut::<3, 3>(0, 0).copy_from(&(inertia - lever * hat(arm)));
        block.fixed_view_mut::<3, 3>(0, 3).copy_from(&lever);
        block.fixed_view_mut::<3, 3>(3, 0).copy_from(&-lever);
        block.fixed_view_mut::<3, 3>(3, 3).copy_from(&(Matrix3::identity() * mass));
        Self { block, place, on_node: false, motions }
    }

    /// 2 ∫ Nᵀ [a ×] N dm, with N how its particles move with (turning, shift): what turning the frame at a rate of 1 about the axis
    /// does to rates. Antisymmetric.
    pub fn gyroscopic(&self, axis: &V) -> Matrix6<f64> {
        let lever: Matrix3<f64> = self.block.fixed_view::<3, 3>(0, 3).into_owned();
        let inertia: Matrix3<f64> = self.block.fixed_view::<3, 3>(0, 0).into_owned();
        let second = Matrix3::identity() * (0.5 * inertia.trace()) - inertia;
        let turn = hat(axis);
        let mut out = Matrix6::zeros();
        out.fixed_view_mut::<3, 3>(0, 0).copy_from(&(hat(&(second * axis)) * 2.0));
        out.fixed_view_mut::<3, 3>(0, 3).copy_from(&(lever * turn * 2.0));
        out.fixed_view_mut::<3, 3>(3, 0).copy_from(&(turn * lever.transpose() * 2.0));
        out.fixed_view_mut::<3, 3>(3, 3).copy_from(&(turn * (2.0 * self.mass())));
        out
    }

    /// -∂(force, moment) of what spins at a rate of 1 about the axis, for what has its centre at its place.
    pub fn centrifugal(&self, axis: &V) -> Matrix6<f64> {
        let inertia: Matrix3<f64> = self.block.fixed_view::<3, 3>(0, 0).into_owned();
        let mut out = Matrix6::zeros();
        for i in 0..3 {
            let mut unit = V::zeros();
            unit[i] = 1.0;
            let change = hat(&unit) * inertia - inertia * hat(&unit);
            out.fixed_view_mut::<3, 1>(0, i).copy_from(&-(change * axis).cross(axis));
            out.fixed_view_mut::<3, 1>(3, 3 + i).copy_from(&((axis * axis.dot(&unit) - unit) * self.mass()));
        }
        out
    }

    pub fn mass(&self) -> f64 {
        self.block[(3, 3)]
    }

    /// Mass times the place of its centre.
    pub fn moment(&self) -> V {
        let lever = self.block.fixed_view::<3, 3>(0, 3);
        self.place * self.mass() + V::new(lever[(2, 1)], lever[(0, 2)], lever[(1, 0)])
    }

    /// How it moves when all is shifted along an axis (0 to 2), or turned about one (3 to 5) through `center`.
    pub fn as_a_whole(&self, axis: usize, center: &V) -> Vector6<f64> {
        let mut unit = V::zeros();
        unit[axis % 3] = 1.0;
        let (turn, shift) =
            if axis < 3 { (V::zeros(), unit) } else { (unit, unit.cross(&(self.place - center))) };
        Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z)
    }
}

impl Equilibrium {
    /// Mass of 1, kg: that of everything; 1 kg where nothing has any.
    pub(super) fn mass_unit(&self) -> f64 {
        let bodies: f64 = self.model.bodies.iter().map(|body| body.mass).sum();
        let lumped: f64 = self.model.masses.iter().map(|mass| mass.mass).sum();
        let beams: f64 =
            self.lowered.beams.iter().map(|law| law.mass_at(0.5 * law.length).0 * law.length).sum();
        let all = bodies + lumped + beams;
        if all > 0.0 && all.is_finite() { all } else { 1.0 }
    }

    /// ω² of 1, rad²/s²: F/(m L).
    pub(super) fn square_unit(&self) -> f64 {
        let scale = self.lowered.scale;
        scale.force / (self.mass_unit() * scale.length)
    }

    /// Mass per length and moments of inertia per length about the section's axes, nondimensional.
    pub(super) fn scaled_inertia(&self, law: &BeamLaw, s: f64) -> (f64, [f64; 3]) {
        let (mass, rotary) = law.mass_at(s);
        let (unit, length) = (self.mass_unit(), law.scale.length);
        (mass * length / unit, rotary.map(|moment| moment / (unit * length)))
    }

    /// Everything that has inertia.
    pub(super) fn lumps(&self, spans: &[Elements]) -> Vec<Lump> {
        let mut lumps = Vec::new();
        for (span, own) in spans.iter().enumerate() {
            self.along(span, own, &mut lumps);
        }
        let (unit, length) = (self.mass_unit(), self.lowered.scale.length);
        for (node, body) in self.model.bodies.iter().enumerate() {
            let pose = self.node_pose(Some(node));
            let rotation = pose.rotation.to_rotation_matrix().into_inner();
            let inertia = rotation * body.inertia * rotation.transpose() / (unit * length * length);
            let arm = rotation * body.center_of_mass / length;
            let first = self.layout.nodes[node].unknown;
            let motions = (0..6).map(|i| (first + i, Vector6::ith(i, 1.0))).collect();
            let lump = Lump::new(body.mass / unit, &arm, &inertia, pose.position, motions);
            lumps.push(Lump { on_node: true, ..lump });
        }
        for mass in &self.model.masses {
            let beam = mass.point.beam.0;
            let whole = self.lowered.beams[beam].length;
            let s = mass.point.at.arc_length(whole);
            let tiny = 1e-9 * whole;
            let holds = |span: &usize| {
                let description = &self.lowered.spans[*span];
                description.beam == beam && s >= description.s[0] - tiny && s <= description.s[1] + tiny
            };
            let Some(span) = (0..spans.len()).find(holds) else { continue };
            let own = &spans[span];
            let Some(e) = own.list.iter().position(|element| s <= element.s[1] + tiny) else { continue };
            let node = if s <= own.list[e].s[0] + tiny { 0 } else { own.rule.order };
            let place = own.list[e].places[node];
            let motions = self.node_motions(span, own, e, node);
            let rotation = &own.list[e].rotations[node];
            let inertia = rotation * mass.inertia * rotation.transpose() / (unit * length * length);
            let lump = Lump::new(mass.mass / unit, &V::zeros(), &inertia, place, motions);
            // Where beams or bodies meet it is a load of the node.
            let near = |jump: &crate::lower::Jump| jump.load.outward.is_some() && (jump.s - s).abs() <= tiny;
            lumps.push(Lump { on_node: !self.lowered.spans[span].jumps.iter().any(near), ..lump });
        }
        lumps.retain(|lump| lump.block != Matrix6::zeros());
        lumps
    }

    /// How a node of an element moves.
    pub(super) fn node_motions(&self, span: usize, own: &Elements, element: usize, node: usize) -> Motions {
        if let Some(first) = own.node(element, node) {
            return (0..6).map(|i| (first + i, Vector6::ith(i, 1.0))).collect();
        }
        let (slots, description) = (&self.layout.spans[span], &self.lowered.spans[span]);
        match (node, &description.end) {
            (0, _) => self.end_motions(&self.held_by(&description.start, &slots.start), &slots.start),
            (_, Some(end)) => self.end_motions(&self.held_by(end, &slots.end), &slots.end),
            (_, None) => Motions::new(),
        }
    }

    /// The inertia along a span, by Gauss-Lobatto sums.
    fn along(&self, span: usize, own: &Elements, lumps: &mut Vec<Lump>) {
        let law = &self.lowered.beams[self.lowered.spans[span].beam];
        for (e, element) in own.list.iter().enumerate() {
            let [a, b] = element.s;
            let half = 0.5 * (b - a) / law.scale.length;
            // A hair inside, so that a jump at an end is seen from the element's own side.
            let inset = 1e-12 * (b - a);
            for (node, (x, weight)) in own.rule.nodes.iter().zip(&own.rule.node_weights).enumerate() {
                let s = (a + (b - a) * 0.5 * (1.0 + x)).clamp(a + inset, b - inset);
                let (mass, rotary) = self.scaled_inertia(law, s);
                let weight = half * weight;
                let rotation = &element.rotations[node];
                let turned = rotation * Matrix3::from_diagonal(&V::from(rotary)) * rotation.transpose();
                let motions = self.node_motions(span, own, e, node);
                let place = element.places[node];
                lumps.push(Lump::new(mass * weight, &V::zeros(), &(turned * weight), place, motions));
            }
        }
    }
}
