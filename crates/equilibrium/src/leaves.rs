//! Torsion of wide leaves, of which a rod whose sections warp freely knows too little: what has to be said beside a result.
//!
//! Where a clamp keeps a section from warping, a thin strip of width w and length L is stiffer in torsion by 1/(1 - tanh(μ/2)/(μ/2))
//! between two clamps and by 1/(1 - tanh(μ)/μ) behind one, with μ = L √(GJ/(E Cw)) = 4 √(3G/E) L/w (V. Z. Vlasov, *Thin-walled Elastic
//! Beams*, 1961). Twisted far, its outer fibres stretch: the torque grows by (E/G) (w² k1/t)²/120 of itself, and under a tension σ by
//! σ/(4G) (w/t)² (A. E. Green, Proc. R. Soc. A 154 (1936) 430).

use crate::system::Equilibrium;
use flexura_model::{Beam, End, JointKind, Mount, Quantity, Shape};
use flexura_spatial::Vector3;

/// Width over thickness from which a rectangle counts as thin.
const THIN: f64 = 5.0;
/// μ from which the ends' layers, a quarter of the width each, no longer matter.
const LONG: f64 = 30.0;
/// Part of the largest moment along a beam from which its torque is in play.
const TWISTED: f64 = 0.01;
/// Part of the torque from which what is left out is said.
const TOLD: f64 = 0.01;

/// A strip: width and thickness, m; E and G, Pa.
struct Strip {
    width: f64,
    thickness: f64,
    young: f64,
    shear: f64,
}

/// What a beam carries at most: torque and moment in N·m, tension in N.
#[derive(Default)]
struct Carried {
    torque: f64,
    moment: f64,
    tension: f64,
}

/// Does this end keep its section from warping? At another beam's end or side it may go on.
fn is_blocked(end: Option<&End>) -> bool {
    end.is_some_and(|end| end.hold.kind == JointKind::Weld && !matches!(end.mount, Mount::Beam(_)))
}

/// How much stiffer in torsion than with sections that warp freely.
fn stiffening(mu: f64, blocked: usize) -> f64 {
    match blocked {
        0 => 1.0,
        1 => 1.0 / (1.0 - mu.tanh() / mu),
        _ => 1.0 / (1.0 - (0.5 * mu).tanh() / (0.5 * mu)),
    }
}

impl Equilibrium {
    /// Leaves whose torsion at the present state, or whose stiffness that outputs ask for, is not that of free warping or small twist.
    pub(crate) fn leaf_warnings(&self, warnings: &mut Vec<String>) {
        let asks_for_stiffness = self.model.outputs.iter().flat_map(|output| &output.probes).any(|probe| {
            let of_tangent = [Quantity::Compliance, Quantity::Stiffness, Quantity::CenterOfCompliance];
            of_tangent.contains(&probe.quantity)
        });
        for (i, beam) in self.model.beams.iter().enumerate() {
            let Some(strip) = self.strip(beam) else { continue };
            let carried = self.carried_by(i);
            let is_twisted = carried.torque > TWISTED * carried.moment && carried.torque > 0.0;
            let mu =
                4.0 * (3.0 * strip.shear / strip.young).sqrt() * self.lowered.beams[i].length / strip.width;
            let blocked = [&beam.start, &beam.end].into_iter().filter(|end| is_blocked(end.as_ref())).count();
            if (is_twisted || asks_for_stiffness) && blocked > 0 && mu < LONG {
                let (factor, ends) = (stiffening(mu, blocked), if blocked == 2 { "clamps" } else { "clamp" });
                let why = if is_twisted { "it is twisted" } else { "stiffnesses are asked for" };
                warnings.push(format!(
                    "beam.{}: {why}, and its {ends} keep so wide a leaf from warping (μ = 4 √(3G/E) L/w = {mu:.3}): in torsion it \
                     is about {factor:.3} times as stiff as this result has it, whose sections warp freely; a section of \
                     shape = \"stiffness\" with a larger GJ takes that into account",
                    beam.name
                ));
            }
            if is_twisted {
                self.far_twist(i, &strip, &carried, warnings);
            }
        }
    }

    /// Says by how much the stretching of fibres changes the torque, where that is seen.
    fn far_twist(&self, beam: usize, strip: &Strip, carried: &Carried, warnings: &mut Vec<String>) {
        let law = self.lowered.beams[beam].law_at(0.5 * self.lowered.beams[beam].length);
        let twist = carried.torque * law.compliance.to_matrix()[(3, 3)];
        let slenderness = strip.width / strip.thickness;
        let searle = strip.width * strip.width * twist / strip.thickness;
        let fibres = strip.young / strip.shear * searle * searle / 120.0;
        let stress = carried.tension / (strip.width * strip.thickness);
        let pull = stress / (4.0 * strip.shear) * slenderness * slenderness;
        let name = &self.model.beams[beam].name;
        if fibres > TOLD {
            warnings.push(format!(
                "beam.{name}: twisted by {:.4} deg/mm the fibres at its edges stretch (w² k1/t = {searle:.3}): so far a twist takes about \
                 {:.1} % more torque than this result has it, which leaves that out",
                1e-3 * twist.to_degrees(),
                100.0 * fibres
            ));
        }
        if pull.abs() > TOLD {
            let word = if pull > 0.0 { "stiffer" } else { "softer" };
            warnings.push(format!(
                "beam.{name}: the force along it makes so thin a strip about {:.1} % {word} in torsion, which this result leaves out",
                100.0 * pull.abs()
            ));
        }
    }

    fn strip(&self, beam: &Beam) -> Option<Strip> {
        let Shape::Rectangle { width, height } = &self.model[beam.section].shape else { return None };
        let (a, b) = (width.as_constant()?, height.as_constant()?);
        let material = &self.model[beam.material?];
        let (width, thickness) = (a.max(b), a.min(b));
        let strip = Strip { width, thickness, young: material.young, shear: material.shear };
        (width > THIN * thickness).then_some(strip)
    }

    /// At the ends of its segments.
    fn carried_by(&self, beam: usize) -> Carried {
        let scale = self.lowered.scale;
        let mut carried = Carried::default();
        for (k, _) in self.lowered.spans.iter().enumerate().filter(|(_, span)| span.beam == beam) {
            let starts = (0..self.meshes[k].segments.len()).map(|segment| self.segment_start(k, segment));
            for state in starts.chain(self.ends[k].iter().map(|end| end.state)) {
                let along = crate::shooting::pose_of(&state).rotation * Vector3::x();
                let (force, moment) = (Vector3::from(state.force), Vector3::from(state.moment));
                carried.torque = carried.torque.max(along.dot(&moment).abs() * scale.moment());
                carried.moment = carried.moment.max(moment.norm() * scale.moment());
                let tension = along.dot(&force) * scale.force;
                if tension.abs() > carried.tension.abs() {
                    carried.tension = tension;
                }
            }
        }
        carried
    }
}

#[cfg(test)]
mod tests {
    use super::stiffening;

    /// Vlasov's closed forms in another shape: T L/(GJ θ) of the field equation solved by exponentials.
    #[test]
    fn a_short_leaf_between_clamps_is_stiffer_by_the_closed_form() {
        let mu = 2.0_f64;
        // κ1 = c (1 - cosh(μ(s - ½))/cosh(μ/2)), s from 0 to 1, whose integral is the turning.
        let turning: f64 = (0..20_000)
            .map(|i| {
                let s = (f64::from(i) + 0.5) / 20_000.0;
                (1.0 - (mu * (s - 0.5)).cosh() / (0.5 * mu).cosh()) / 20_000.0
            })
            .sum();
        assert!((stiffening(mu, 2) * turning - 1.0).abs() < 1e-8);
        // Behind one clamp: half of a leaf of twice the length between two.
        assert!((stiffening(mu, 1) - stiffening(2.0 * mu, 2)).abs() < 1e-12);
        assert!(stiffening(1e4, 2) - 1.0 < 1e-3 && stiffening(mu, 0) == 1.0);
    }
}
