//! What is beyond the reach of the method, said before any work is done.

use crate::mesh::{MOST_STEPS, Stretch};
use crate::system::Equilibrium;

/// ∫√(F/EI) ds and ∫M/EI ds beyond which a load is taken for a mistake.
const LARGEST_PHASE: f64 = 1e4;

impl Equilibrium {
    /// Why the present mesh is not to be worked on: a load or a law that would want more steps than are made.
    pub fn beyond_reach(&self) -> Option<String> {
        let spans = || (0..self.meshes.len()).find_map(|span| self.span_beyond_reach(span));
        self.node_beyond_reach().or_else(spans)
    }

    /// A force on a body that no beam, at its stiffest, could be meant to carry.
    fn node_beyond_reach(&self) -> Option<String> {
        let stiffest = (0..self.meshes.len()).map(|span| self.span_strength(span)).fold(0.0, f64::max);
        let most = LARGEST_PHASE * LARGEST_PHASE * stiffest;
        let force = |node: &crate::lower::Node| -> f64 {
            node.loads.iter().map(|(_, load, _)| load.dead.force.norm() + load.follower.force.norm()).sum()
        };
        let node = self.lowered.nodes.iter().position(|node| {
            // A number that is none is no sound load either.
            stiffest > 0.0 && (force(node) > most || force(node).is_nan())
        })?;
        Some(format!(
            "{}: the load is more than a hundred million times what bends the stiffest beam, EI/L²; check its unit and the sections' \
             dimensions",
            self.node_name(node)
        ))
    }

    /// EI/L² of a span where it is stiffest, nondimensional.
    pub(crate) fn span_strength(&self, index: usize) -> f64 {
        let span = &self.lowered.spans[index];
        let law = &self.lowered.beams[span.beam];
        let length = law.length / law.scale.length;
        let soft = match span.is_even(law) {
            true => law.soft(),
            false => {
                self.meshes[index].stretches().map(|stretch| stretch.look.soft).fold(law.soft(), f64::min)
            }
        };
        1.0 / (soft * length * length)
    }

    /// Is a mesh cut off, so that no result on it means anything?
    pub(crate) fn is_overfull(&self) -> bool {
        self.meshes.iter().any(|mesh| mesh.cut.is_overfull)
    }

    fn span_beyond_reach(&self, index: usize) -> Option<String> {
        let (span, mesh) = (&self.lowered.spans[index], &self.meshes[index]);
        let law = &self.lowered.beams[span.beam];
        let name = &self.model.beams[span.beam].name;
        let sizes = [self.span_phase(index, 1.0), self.span_turning(index)];
        // A number that is none is no sound load either.
        if !sizes.iter().all(|size| *size <= LARGEST_PHASE) {
            return Some(format!(
                "beam.{name}: the load is more than a hundred million times what bends the beam, EI/L²; check its unit and the \
                 section's dimensions"
            ));
        }
        if !mesh.cut.is_overfull {
            return None;
        }
        let length = |stretch: &Stretch| (stretch.s[1] - stretch.s[0]) / law.scale.length;
        let turns = mesh.stretches().map(|s| length(s) * s.look.bend).sum::<f64>() / std::f64::consts::TAU;
        if turns > 0.1 * MOST_STEPS as f64 {
            return Some(format!(
                "beam.{name}: its unstressed shape winds {turns:.0} times round, which would take more than {MOST_STEPS} integration \
                 steps; check its numbers"
            ));
        }
        if mesh.cut.wanted >= MOST_STEPS {
            return Some(format!(
                "beam.{name}: it is loaded, or bedded, so hard for its stiffness that more than {MOST_STEPS} integration steps would be \
                 needed along it; check the units and the section's dimensions"
            ));
        }
        let narrowest = mesh.stretches().min_by(|a, b| length(a).total_cmp(&length(b)))?;
        Some(format!(
            "beam.{name}: its shape, section or loads vary too quickly with `s` to be integrated, about s = {:.6e} m; write them smoother, \
             or as a table",
            narrowest.s[0]
        ))
    }
}
