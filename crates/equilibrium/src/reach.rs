//! What is beyond the reach of the method, said before any work is done.

use crate::mesh::{MOST_STEPS, Stretch};
use crate::system::Equilibrium;

impl Equilibrium {
    /// Why the present mesh is not to be worked on: a load or a law that would want more steps than are made.
    pub fn beyond_reach(&self) -> Option<String> {
        (0..self.meshes.len()).find_map(|span| self.span_beyond_reach(span))
    }

    /// Is a mesh cut off, so that no result on it means anything?
    pub(crate) fn is_overfull(&self) -> bool {
        self.meshes.iter().any(|mesh| mesh.is_overfull)
    }

    fn span_beyond_reach(&self, index: usize) -> Option<String> {
        let (span, mesh) = (&self.lowered.spans[index], &self.meshes[index]);
        let law = &self.lowered.beams[span.beam];
        let name = &self.model.beams[span.beam].name;
        if !mesh.is_overfull {
            return None;
        }
        let length = |stretch: &Stretch| (stretch.s[1] - stretch.s[0]) / law.scale.length;
        let turns = mesh.stretches().map(|s| length(s) * s.look.bend).sum::<f64>() / std::f64::consts::TAU;
        if mesh.steps() >= MOST_STEPS && turns > 0.1 * MOST_STEPS as f64 {
            return Some(format!(
                "beam.{name}: its unstressed shape winds {turns:.0} times round, which would take more than {MOST_STEPS} integration \
                 steps; check its numbers"
            ));
        }
        if mesh.steps() >= MOST_STEPS {
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
