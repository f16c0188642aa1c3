//! A neighbouring model in which bodies, beams and joints stay where they are: only loads, drives, springs, materials, sections and what
//! is distributed along beams may have other numbers. Then nothing is lowered anew but what these touch.

use crate::beam::BeamLaw;
use crate::error::ProblemError;
use crate::look::Looks;
use crate::lower::{self, Link};
use crate::mesh::SpanMesh;
use crate::system::Equilibrium;
use flexura_expression::Formula;
use flexura_model::{
    Beam, BeamId, CoordinateLaw, Distributed, Joint, Load, LoadId, Material, Model, Parameter, Section,
    Spring,
};
use flexura_nonlinear::System;
use flexura_spatial::Vector3;
use std::mem::swap;
use std::sync::Arc;

/// What is exchanged, each with its position.
#[derive(Clone, Debug, Default)]
pub(crate) struct Patch {
    parameters: Vec<(usize, f64, Option<Arc<Formula>>)>,
    targets: Vec<(usize, f64)>,
    loads: Vec<(usize, [Vector3<f64>; 2])>,
    drives: Vec<(usize, usize, CoordinateLaw)>,
    materials: Vec<(usize, Material)>,
    sections: Vec<(usize, Section)>,
    distributed: Vec<(usize, Vec<Distributed>)>,
    springs: Vec<(usize, Spring, Link)>,
    beams: Vec<(usize, Arc<BeamLaw>)>,
    meshes: Vec<(usize, SpanMesh)>,
}

/// Positions at which two lists differ; None where they are not of one length.
fn changes<'m, T: PartialEq>(
    own: &'m [T],
    other: &'m [T],
) -> Option<impl Iterator<Item = (usize, (&'m T, &'m T))>> {
    let pairs = own.iter().zip(other).enumerate();
    (own.len() == other.len()).then(|| pairs.filter(|(_, (a, b))| a != b))
}

fn same_but_value(own: &Parameter, other: &Parameter) -> bool {
    let Parameter { name, value: _, unit, formula: _, is_structural } = own;
    *name == other.name && *unit == other.unit && *is_structural == other.is_structural
}

fn same_but_strength(own: &Load, other: &Load) -> bool {
    let Load { name, target, force: _, moment: _, frame } = own;
    *name == other.name && *target == other.target && *frame == other.frame
}

fn same_but_loads(own: &Beam, other: &Beam) -> bool {
    let Beam {
        name,
        material,
        section,
        curve,
        frame,
        theory,
        start,
        end,
        distributed: _,
        foundation,
        damping,
        added_mass,
    } = own;
    *damping == other.damping
        && *added_mass == other.added_mass
        && *name == other.name
        && *material == other.material
        && *section == other.section
        && *theory == other.theory
        && *curve == other.curve
        && *frame == other.frame
        && *start == other.start
        && *end == other.end
        && *foundation == other.foundation
}

fn is_between_the_same(own: &Spring, other: &Spring) -> bool {
    let mounts = |spring: &Spring| {
        (spring.from.mount, spring.to.mount, spring.wrap.as_ref().map(|wrap| wrap.frame.mount))
    };
    own.name == other.name && mounts(own) == mounts(other)
}

/// Two lists of coordinate laws that differ in what drives, loads or relaxes them at most.
fn same_but_drives(own: &Joint, other: &Joint) -> bool {
    let Joint { name, parent, child, child_pose, law } = own;
    let alike = |(a, b): (&CoordinateLaw, &CoordinateLaw)| {
        let CoordinateLaw { drive, rest: _, stiffness, limits, damping } = a;
        std::mem::discriminant(drive) == std::mem::discriminant(&b.drive)
            && *stiffness == b.stiffness
            && *limits == b.limits
            && *damping == b.damping
    };
    *name == other.name
        && *parent == other.parent
        && *child == other.child
        && *child_pose == other.child_pose
        && law.kind == other.law.kind
        && law.axis == other.law.axis
        && law.second_axis == other.law.second_axis
        && law.contact == other.law.contact
        && law.coordinates.len() == other.law.coordinates.len()
        && law.coordinates.iter().zip(&other.law.coordinates).all(alike)
}

impl Equilibrium {
    /// What a model changes; None where it differs in anything else, or has other laws along a beam with channels.
    ///
    /// # Errors
    /// A beam has no sound law.
    pub(crate) fn patch(&self, model: &Model) -> Option<Result<Patch, ProblemError>> {
        let own = &self.model;
        if own.differs_in_parts(model) || self.lowered.beams.iter().any(|law| law.is_softened()) {
            return None;
        }
        let mut patch = Patch::default();
        for (i, (a, b)) in changes(&own.parameters, &model.parameters)? {
            same_but_value(a, b).then_some(())?;
            patch.parameters.push((i, b.value, b.formula.clone()));
        }
        let targets = own.targets.iter().zip(&model.targets).enumerate();
        patch.targets =
            targets.filter(|(_, (a, b))| a.value != b.value).map(|(i, (_, b))| (i, b.value)).collect();
        for (i, (a, b)) in changes(&own.loads, &model.loads)? {
            same_but_strength(a, b).then_some(())?;
            patch.loads.push((i, [b.force, b.moment]));
        }
        for (i, (a, b)) in changes(&own.joints, &model.joints)? {
            same_but_drives(a, b).then_some(())?;
            for (k, (_, law)) in changes(&a.law.coordinates, &b.law.coordinates)? {
                patch.drives.push((i, k, *law));
            }
        }
        for (i, (a, b)) in changes(&own.springs, &model.springs)? {
            is_between_the_same(a, b).then_some(())?;
            match lower::link(&self.lowered, b) {
                Ok(link) => patch.springs.push((i, b.clone(), link)),
                Err(error) => return Some(Err(error)),
            }
        }
        for (i, (a, b)) in changes(&own.beams, &model.beams)? {
            same_but_loads(a, b).then_some(())?;
            patch.distributed.push((i, b.distributed.clone()));
        }
        let materials = changes(&own.materials, &model.materials)?;
        patch.materials = materials.map(|(i, (_, b))| (i, b.clone())).collect();
        let sections = changes(&own.sections, &model.sections)?;
        patch.sections = sections.map(|(i, (_, b))| (i, b.clone())).collect();
        self.patch_laws(model, patch).transpose()
    }

    /// The same with laws and meshes of the beams that it touches.
    fn patch_laws(&self, model: &Model, mut patch: Patch) -> Result<Option<Patch>, ProblemError> {
        if patch.materials.is_empty() && patch.sections.is_empty() && patch.distributed.is_empty() {
            return Ok(Some(patch));
        }
        if !model.tubes.is_empty() {
            return Ok(None);
        }
        for (i, beam) in model.beams.iter().enumerate() {
            let touched = patch.sections.iter().any(|(section, _)| *section == beam.section.0)
                || patch.materials.iter().any(|(m, _)| beam.material.is_some_and(|own| own.0 == *m))
                || patch.distributed.iter().any(|(own, _)| *own == i);
            if !touched {
                continue;
            }
            let old = &self.lowered.beams[i];
            let mut law = BeamLaw::new(model, BeamId(i))?;
            law.set_scale(self.lowered.scale);
            law.founded.rest = old.founded.rest;
            lower::bounded(model, &law, i)?;
            for (k, span) in self.lowered.spans.iter().enumerate().filter(|(_, span)| span.beam == i) {
                // Where something appears, vanishes or meets, the whole model is lowered, which says so.
                let mesh = self.meshes[k].under((old, span), (&law, span));
                let Some(mesh) = mesh.filter(|_| span.channels.is_empty()) else { return Ok(None) };
                patch.meshes.push((k, mesh));
            }
            patch.beams.push((i, Arc::new(law)));
        }
        Ok(Some(patch))
    }

    /// Exchanges what stands in the patch; it then holds what was there. Driven coordinates move to where they are wanted.
    pub(crate) fn exchange_patch(&mut self, patch: &mut Patch) {
        for (i, value, formula) in &mut patch.parameters {
            swap(&mut self.model.parameters[*i].value, value);
            swap(&mut self.model.parameters[*i].formula, formula);
        }
        for (i, value) in &mut patch.targets {
            swap(&mut self.model.targets[*i].value, value);
        }
        for (i, wrench) in &mut patch.loads {
            let load = &self.model.loads[*i];
            let own = [load.force, load.moment];
            self.put_point_load(LoadId(*i), wrench[0], wrench[1]);
            *wrench = own;
        }
        for (i, k, law) in &mut patch.drives {
            let own = self.model.joints[*i].law.coordinates[*k];
            self.set_coordinate_law(*i, *k, *law);
            *law = own;
        }
        patch.materials.iter_mut().for_each(|(i, own)| swap(&mut self.model.materials[*i], own));
        patch.sections.iter_mut().for_each(|(i, own)| swap(&mut self.model.sections[*i], own));
        patch.distributed.iter_mut().for_each(|(i, own)| swap(&mut self.model.beams[*i].distributed, own));
        for (i, spring, link) in &mut patch.springs {
            swap(&mut self.model.springs[*i], spring);
            swap(&mut self.lowered.springs[*i], link);
        }
        patch.beams.iter_mut().for_each(|(i, own)| swap(&mut self.lowered.beams[*i], own));
        for (i, own) in &mut patch.meshes {
            swap(&mut self.meshes[*i], own);
            Looks::clear(&mut self.looks[*i]);
        }
        if !(patch.loads.is_empty() && patch.meshes.is_empty()) {
            self.sum_known_forces();
        }
        if !patch.drives.is_empty() {
            self.set_load(self.load);
        }
    }
}
