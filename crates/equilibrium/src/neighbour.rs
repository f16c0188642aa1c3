//! The same mechanism with slightly other numbers: the state stays, the law under it changes.

use crate::error::ProblemError;
use crate::look::Looks;
use crate::lower::{self, Lowered};
use crate::mesh::{Cutter, SpanMesh};
use crate::patch::Patch;
use crate::system::Equilibrium;
use flexura_model::{BeamPoint, Model, ProbeTarget, Quantity};
use flexura_nonlinear::System;
use flexura_spatial::Vector3;
use std::sync::Arc;

/// The law of a model in the units, and on the mesh, of the problem that it was made for; good for the law that stood there then.
#[derive(Clone, Debug)]
pub struct Law(Kind);

#[derive(Clone, Debug)]
enum Kind {
    Whole(Box<Whole>),
    /// Where every part stays.
    Patch(Box<Patch>),
}

#[derive(Clone, Debug)]
struct Whole {
    model: Model,
    lowered: Lowered,
    meshes: Vec<SpanMesh>,
    known_force: Vec<Vector3<f64>>,
}

impl Law {
    /// Does it hold everything, so that it may be put under any law of its problem?
    pub fn is_whole(&self) -> bool {
        matches!(self.0, Kind::Whole(_))
    }
}

/// Places on beams whose compliance an output asks for.
pub(crate) fn probes(model: &Model) -> Vec<BeamPoint> {
    let all = model.outputs.iter().chain(model.targets.iter().map(|t| &t.output));
    all.flat_map(|output| &output.probes)
        .filter(|probe| {
            matches!(
                probe.quantity,
                Quantity::Compliance | Quantity::Stiffness | Quantity::CenterOfCompliance
            )
        })
        .filter_map(|probe| match probe.target {
            ProbeTarget::Beam(beam, at) => Some(BeamPoint { beam, at }),
            _ => None,
        })
        .collect()
}

impl Equilibrium {
    /// The law of a neighbouring model, in this problem's units and on its mesh, so that [`Equilibrium::exchange`] can
    /// put it under the present state.
    ///
    /// # Errors
    /// A model that cannot be prepared, or one that is made of other parts.
    pub fn neighbour(&self, model: &Model) -> Result<Law, ProblemError> {
        match self.patch(model) {
            Some(patch) => Ok(Law(Kind::Patch(Box::new(patch?)))),
            None => self.neighbour_whole(model),
        }
    }

    /// The same with everything in it, to be put under whatever law of this problem stands by then.
    ///
    /// # Errors
    /// As [`Equilibrium::neighbour`].
    pub fn neighbour_whole(&self, model: &Model) -> Result<Law, ProblemError> {
        self.law_of(model.clone(), |_, _| None)
    }

    /// The same for a model in which something may happen along its beams where nothing did, or in another order: a load with a
    /// step grows from nothing, two loads pass each other. Such spans are cut anew into as many segments, so that the law is
    /// the same to the accuracy of the mesh only, and no difference of such laws is worth more.
    ///
    /// # Errors
    /// As [`Equilibrium::neighbour`].
    pub fn neighbour_anew(&self, model: &Model) -> Result<Law, ProblemError> {
        if let Some(patch) = self.patch(model) {
            return Ok(Law(Kind::Patch(Box::new(patch?))));
        }
        self.law_of(model.clone(), |lowered, index| {
            let (span, own) = (&lowered.spans[index], &self.lowered.spans[index]);
            let part = (span.s[1] - span.s[0]) / (own.s[1] - own.s[0]);
            let moved = |s: &f64| span.s[0] + part * (s - own.s[0]);
            let mut ends: Vec<f64> = self.meshes[index].ends().iter().map(moved).collect();
            if let Some(last) = ends.last_mut() {
                *last = span.s[1];
            }
            let law = &lowered.beams[span.beam];
            let (course, accuracy) = (&self.courses[index], self.accuracy);
            let mut cutter = Cutter { law, span, looks: &mut Looks::default(), course, accuracy };
            let mesh = cutter.build_between(&ends);
            (mesh.segments.len() == ends.len()).then_some(mesh)
        })
    }

    /// The law of a model; `anew` makes the mesh of a span on which other things happen.
    fn law_of(
        &self,
        model: Model,
        anew: impl Fn(&Lowered, usize) -> Option<SpanMesh>,
    ) -> Result<Law, ProblemError> {
        let mut lowered = lower::lower(&model, &self.probes, Some(&self.lowered))?;
        lowered.warnings.clone_from(&self.lowered.warnings);
        let alike = lowered.nodes.len() == self.lowered.nodes.len()
            && lowered.joints.len() == self.lowered.joints.len()
            && lowered.gears.len() == self.lowered.gears.len()
            && lowered.ropes.len() == self.lowered.ropes.len()
            && lowered.nests.len() == self.lowered.nests.len()
            && lowered
                .nests
                .iter()
                .zip(&self.lowered.nests)
                .all(|(a, b)| a.ends.len() == b.ends.len() && a.others() == b.others())
            && lowered.spans.len() == self.lowered.spans.len()
            && lowered.spans.iter().zip(&self.lowered.spans).all(|(a, b)| {
                a.determinate == b.determinate
                    && a.tendons == b.tendons
                    && a.channels.len() == b.channels.len()
                    && a.start.coordinates.unknowns() == b.start.coordinates.unknowns()
                    && a.end.as_ref().map(|e| e.coordinates.unknowns())
                        == b.end.as_ref().map(|e| e.coordinates.unknowns())
            });
        let meshes = alike.then(|| {
            let spans = lowered.spans.iter().zip(&self.lowered.spans).zip(&self.meshes).enumerate();
            let moved = spans.map(|(i, ((span, own), mesh))| {
                let (law, own_law) = (&lowered.beams[span.beam], &self.lowered.beams[own.beam]);
                // Nothing has changed that the mesh knows of.
                if Arc::ptr_eq(law, own_law) && span.is_laid_out_as(own) {
                    return Some(mesh.clone());
                }
                mesh.under((own_law, own), (law, span)).or_else(|| anew(&lowered, i))
            });
            moved.collect::<Option<Vec<_>>>()
        });
        let Some(meshes) = meshes.flatten() else {
            return Err(ProblemError::new(
                "model",
                "changes its parts when a parameter changes a little: something appears, vanishes or meets",
                "move loads, springs and breaks of sections apart, so that they keep their order",
            ));
        };
        let known_force = crate::prepare::known_forces(&lowered, &meshes);
        Ok(Law(Kind::Whole(Box::new(Whole { model, lowered, meshes, known_force }))))
    }

    /// Puts another law under the present state and returns the one that was there. Driven coordinates move to where
    /// the new law wants them; everything else stays.
    pub fn exchange(&mut self, mut law: Law) -> Law {
        match &mut law.0 {
            Kind::Whole(whole) => self.exchange_whole(whole),
            Kind::Patch(patch) => self.exchange_patch(patch),
        }
        law
    }

    fn exchange_whole(&mut self, law: &mut Whole) {
        std::mem::swap(&mut self.model, &mut law.model);
        std::mem::swap(&mut self.lowered, &mut law.lowered);
        std::mem::swap(&mut self.meshes, &mut law.meshes);
        std::mem::swap(&mut self.known_force, &mut law.known_force);
        self.looks.iter_mut().for_each(Looks::clear);
        let load = self.load;
        self.set_load(load);
    }
}
