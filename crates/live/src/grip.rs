//! Dragging: a point of the mechanism is led by the pointer, by the loads and drives that move it.
//!
//! What can be changed are the parameters on which only loads and drives depend, or, where a load depends on none, its own force.
//! With x the point, u the line of sight and P = I - u uᵀ, each step solves
//!
//! ```text
//!   min |P (x + J d - goal)|² + small |d|²,    J = ∂x/∂(what can be changed)
//! ```
//!
//! J comes from small warm steps when a point is grasped and follows by Broyden's update.

use crate::problems::Trouble;
use crate::request::{Answer, Way};
use crate::session::{Moved, Place, Session, Standing};
use flexura::model::{LoadTarget, Model, Mount, ProbeTarget};
use flexura::spatial::{Pose, Vector3};
use serde::Serialize;

/// Steps for one position of the pointer.
const STEPS: usize = 3;
/// Part of a range by which J is differenced.
const DIFFERENCE: f64 = 1e-4;
/// Largest change at once, as a part of a range.
const REACH: f64 = 0.2;
/// Weight of the change against the squared size of J: a rod that is pulled along its axis gives way little, and is not to be torn.
const DAMPING: f64 = 1e-3;
/// Inputs that move the point by less than this part of what the strongest does are left alone: they would have to change much.
const IDLE: f64 = 1e-3;
/// Part of the mechanism's size that counts as there.
const NEAR: f64 = 1e-4;
/// Sections at which a beam is looked at.
const SECTIONS: usize = 33;
/// Displacements of less than this part of the largest are none.
const STILL: f64 = 1e-9;

/// A place on something that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// On a body, in its axes.
    Body(usize, Vector3<f64>),
    /// On a beam's axis, by arc length.
    Beam(usize, f64),
}

/// What may be changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// By position.
    Parameter(usize),
    /// A component of a load's force.
    Force(usize, usize),
}

/// Something that can be dragged.
#[derive(Clone, Debug)]
pub struct Grip {
    name: String,
    kind: &'static str,
    spot: Spot,
    inputs: Vec<Input>,
}

/// A grip in the hand: how its point moves.
pub struct Grasp {
    grip: usize,
    /// Of each input over its range.
    columns: Vec<Vector3<f64>>,
    widths: Vec<f64>,
}

/// A grip as the page sees it.
#[derive(Serialize)]
pub struct GripDocument {
    name: String,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    body: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    beam: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    s: Option<f64>,
    position: [f64; 3],
    /// Names of the parameters that it changes; none where it changes the force itself.
    parameters: Vec<String>,
}

impl Session {
    /// What can be dragged at the present equilibrium.
    pub fn grips(&mut self) -> Vec<GripDocument> {
        self.grips = self.find_grips();
        let model = &self.base;
        let document = |grip: &Grip| {
            let (body, beam, s, position) = match grip.spot {
                Spot::Body(body, point) => (Some(model.bodies[body].name.clone()), None, None, point.into()),
                Spot::Beam(beam, s) => (None, Some(model.beams[beam].name.clone()), Some(s), [0.0; 3]),
            };
            let named = |input: &Input| match input {
                Input::Parameter(own) => Some(model.parameters[*own].name.clone()),
                Input::Force(..) => None,
            };
            let parameters = grip.inputs.iter().filter_map(named).collect();
            GripDocument { name: grip.name.clone(), kind: grip.kind, body, beam, s, position, parameters }
        };
        self.grips.iter().map(document).collect()
    }

    fn find_grips(&self) -> Vec<Grip> {
        let Some(standing) = self.standing.clone().filter(Standing::is_converged) else { return Vec::new() };
        let model = &self.base;
        let mut by: Vec<(Moved, Vec<Input>)> = Vec::new();
        for parameter in 0..model.parameters.len() {
            if model.unknowns.iter().any(|unknown| unknown.parameter == parameter) {
                continue;
            }
            for moved in self.change(parameter).unwrap_or_default() {
                match by.iter_mut().find(|(other, _)| *other == moved) {
                    Some((_, inputs)) => inputs.push(Input::Parameter(parameter)),
                    None => by.push((moved, vec![Input::Parameter(parameter)])),
                }
            }
        }
        let of =
            |moved: Moved| by.iter().find(|(other, _)| *other == moved).map(|(_, inputs)| inputs.clone());
        let mut grips = Vec::new();
        for (i, load) in model.loads.iter().enumerate() {
            let inputs = match of(Moved::Load(i)) {
                Some(inputs) => inputs,
                None if load.force.norm() > 0.0 => (0..3).map(|axis| Input::Force(i, axis)).collect(),
                None => continue,
            };
            let spot = match load.target {
                LoadTarget::Body { body, point } => Spot::Body(body.0, point),
                LoadTarget::Beam(at) => {
                    self.on_beam(&standing, at.beam.0, &|length| at.at.arc_length(length))
                }
            };
            grips.push(Grip { name: load.name.clone(), kind: "load", spot, inputs });
        }
        for (moved, inputs) in &by {
            let Some(name) = self.driven_name(*moved) else { continue };
            let spot = match moved {
                Moved::Target(target) => self.led(&standing, *target),
                _ => self.lively(&standing, *moved, inputs[0]),
            };
            let Some(spot) = spot else { continue };
            // Several targets may lead one body.
            match grips.iter_mut().find(|grip| grip.kind == "drive" && grip.spot == spot) {
                Some(grip) => {
                    let further = inputs.iter().filter(|input| !grip.inputs.contains(input)).copied();
                    let further: Vec<Input> = further.collect();
                    grip.inputs.extend(further);
                }
                None => grips.push(Grip { name, kind: "drive", spot, inputs: inputs.clone() }),
            }
        }
        grips
    }

    fn driven_name(&self, moved: Moved) -> Option<String> {
        match moved {
            Moved::Load(_) => None,
            Moved::Joint(joint, _) => Some(self.base.joints[joint].name.clone()),
            Moved::Hold(beam, ..) => Some(self.base.beams[beam].name.clone()),
            Moved::Target(target) => {
                let probe = self.base.targets[target].output.probes.first()?;
                match probe.target {
                    ProbeTarget::Body(body) => Some(self.base.bodies[body.0].name.clone()),
                    ProbeTarget::Beam(beam, _) => Some(self.base.beams[beam.0].name.clone()),
                    _ => None,
                }
            }
        }
    }

    /// The place that a target is about.
    fn led(&self, standing: &Standing, target: usize) -> Option<Spot> {
        match self.base.targets[target].output.probes.first()?.target {
            ProbeTarget::Body(body) => Some(Spot::Body(body.0, Vector3::zeros())),
            ProbeTarget::Beam(beam, at) => {
                Some(self.on_beam(standing, beam.0, &|length| at.arc_length(length)))
            }
            _ => None,
        }
    }

    /// The sampled section nearest to a place.
    fn on_beam(&self, standing: &Standing, beam: usize, at: &dyn Fn(f64) -> f64) -> Spot {
        let solution = Session::glance(&mut standing.clone(), SECTIONS, Some(beam));
        let wanted = at(solution.beams[beam].length);
        let sections = solution.beams[beam].samples.iter().map(|sample| sample.s);
        let nearest = sections.min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()));
        Spot::Beam(beam, nearest.unwrap_or(wanted))
    }

    /// The place on what a drive moves that moves most; where nothing of that moves, of all bodies and ends of beams.
    fn lively(&self, standing: &Standing, moved: Moved, input: Input) -> Option<Spot> {
        let model = &self.base;
        let own: Vec<Spot> = match moved {
            Moved::Joint(joint, _) => match model.joints[joint].child {
                Mount::Body(body) => points_of(model, body.0),
                Mount::Beam(at) => self.along(standing, at.beam.0),
                Mount::Ground => Vec::new(),
            },
            Moved::Hold(beam, ..) => self.along(standing, beam),
            Moved::Load(_) | Moved::Target(_) => return None,
        };
        let all = || {
            let bodies = (0..model.bodies.len()).flat_map(|body| points_of(model, body));
            bodies
                .chain((0..model.beams.len()).flat_map(|beam| self.along(standing, beam)))
                .collect::<Vec<_>>()
        };
        let (place, _) = self.nudged(input, DIFFERENCE);
        let changed = self.model_at(&place).ok()?;
        let mut after = standing.clone();
        if !self.put(&mut after, &changed) {
            return None;
        }
        let size = self.units().0;
        let most = |spots: Vec<Spot>| {
            let travel = |spot: &Spot| {
                let shift = where_is(&mut after.clone(), *spot)? - where_is(&mut standing.clone(), *spot)?;
                Some((*spot, shift.norm()))
            };
            spots
                .iter()
                .filter_map(travel)
                .filter(|(_, far)| *far > STILL * size)
                .max_by(|a, b| a.1.total_cmp(&b.1))
        };
        most(own).or_else(|| most(all())).map(|(spot, _)| spot)
    }

    /// Start, middle and end of a beam.
    fn along(&self, standing: &Standing, beam: usize) -> Vec<Spot> {
        [0.0, 0.5, 1.0].into_iter().map(|t| self.on_beam(standing, beam, &|length| t * length)).collect()
    }

    /// The place with an input changed by a part of its range, and that range's width.
    fn nudged(&self, input: Input, part: f64) -> (Place, f64) {
        let mut place = self.place.clone();
        let width = self.width(input);
        self.add(&mut place, input, part * width);
        (place, width)
    }

    fn width(&self, input: Input) -> f64 {
        match input {
            Input::Parameter(own) => {
                let [a, b] = crate::ranges::range_of(self, own);
                b - a
            }
            Input::Force(load, _) => self.base.loads[load].force.norm().max(self.units().1),
        }
    }

    fn add(&self, place: &mut Place, input: Input, change: f64) {
        match input {
            Input::Parameter(own) => {
                let own = &self.base.parameters[own];
                place.set(&own.name, own.value + change);
            }
            Input::Force(load, axis) => {
                let known = place.forces.iter().find(|(other, _)| *other == load);
                let mut force = known.map_or(self.base.loads[load].force, |(_, force)| *force);
                force[axis] += change;
                place.push(load, force);
            }
        }
    }

    /// Moves a grip to the line of sight through a point, or as near as it gets.
    pub fn drag(
        &mut self,
        grip: usize,
        to: [f64; 3],
        eye: [f64; 3],
        samples: usize,
    ) -> Result<Answer, Trouble> {
        let Some(chosen) = self.grips.get(grip).cloned() else {
            return Err(Trouble::plain("there is no such grip".to_owned()));
        };
        let (to, eye) = (Vector3::from(to), Vector3::from(eye));
        let Some(eye) = eye.try_normalize(0.0).filter(|_| to.iter().all(|x| x.is_finite())) else {
            return Err(Trouble::plain("the pointer is nowhere".to_owned()));
        };
        if self.grasp.as_ref().is_none_or(|grasp| grasp.grip != grip) {
            self.grasp = Some(self.grasped(grip, &chosen));
        }
        let size = self.units().0;
        let (mut way, mut reason, mut is_there) = (Way::Near, None, false);
        for _ in 0..STEPS {
            let Some(here) = self.whereabouts(chosen.spot) else { break };
            let miss = across(&(to - here), &eye);
            is_there = miss.norm() < NEAR * size;
            if is_there {
                break;
            }
            let Some(grasp) = self.grasp.take() else { break };
            let change = towards(&grasp, &miss, &eye);
            let mut place = self.place.clone();
            for ((input, change), width) in chosen.inputs.iter().zip(&change).zip(&grasp.widths) {
                self.add(&mut place, *input, change * width);
            }
            (way, reason) = self.go(place)?;
            if way != Way::Near {
                break;
            }
            let there = self.whereabouts(chosen.spot).unwrap_or(here);
            self.grasp = Some(learnt(grasp, &change, &(there - here)));
        }
        Ok(Answer { way: Some(way), reason, is_there: Some(is_there), ..self.answer(samples)? })
    }

    fn whereabouts(&mut self, spot: Spot) -> Option<Vector3<f64>> {
        where_is(self.standing.as_mut()?, spot)
    }

    /// How the point moves with every input.
    fn grasped(&mut self, grip: usize, chosen: &Grip) -> Grasp {
        let widths: Vec<f64> = chosen.inputs.iter().map(|input| self.width(*input)).collect();
        let columns = chosen.inputs.iter().map(|input| self.column(chosen.spot, *input)).collect();
        Grasp { grip, columns, widths }
    }

    fn column(&self, spot: Spot, input: Input) -> Vector3<f64> {
        let moved = || {
            let (place, _) = self.nudged(input, DIFFERENCE);
            let model = self.model_at(&place).ok()?;
            let mut before = self.standing.clone()?;
            let mut after = before.clone();
            let is_there = self.put(&mut after, &model);
            let shift = where_is(&mut after, spot)? - where_is(&mut before, spot)?;
            is_there.then_some(shift / DIFFERENCE)
        };
        moved().unwrap_or_else(Vector3::zeros)
    }
}

/// What of a vector is seen.
fn across(v: &Vector3<f64>, eye: &Vector3<f64>) -> Vector3<f64> {
    v - eye * eye.dot(v)
}

/// The damped step, as parts of the ranges. By the push-through identity a 3 × 3 system is enough:
/// d = Jᵀ (J Jᵀ + λ I)⁻¹ miss.
fn towards(grasp: &Grasp, miss: &Vector3<f64>, eye: &Vector3<f64>) -> Vec<f64> {
    let mut seen: Vec<Vector3<f64>> = grasp.columns.iter().map(|column| across(column, eye)).collect();
    let strongest = seen.iter().map(Vector3::norm).fold(0.0, f64::max);
    for column in seen.iter_mut().filter(|column| column.norm() < IDLE * strongest) {
        *column = Vector3::zeros();
    }
    let mut matrix = flexura::spatial::Matrix3::zeros();
    for column in &seen {
        matrix += column * column.transpose();
    }
    let size = matrix.trace();
    if size.is_nan() || size <= 0.0 {
        return vec![0.0; seen.len()];
    }
    for i in 0..3 {
        matrix[(i, i)] += DAMPING * size;
    }
    let Some(inverse) = matrix.try_inverse() else { return vec![0.0; seen.len()] };
    let pull = inverse * miss;
    let change: Vec<f64> = seen.iter().map(|column| column.dot(&pull)).collect();
    let largest = change.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
    let short = if largest > REACH { REACH / largest } else { 1.0 };
    change.into_iter().map(|own| own * short).collect()
}

/// Broyden's update: J += (Δx - J d) dᵀ / |d|².
fn learnt(mut grasp: Grasp, change: &[f64], shift: &Vector3<f64>) -> Grasp {
    let square: f64 = change.iter().map(|own| own * own).sum();
    if square > 0.0 {
        let mut foreseen = Vector3::zeros();
        for (column, own) in grasp.columns.iter().zip(change) {
            foreseen += column * *own;
        }
        let surprise = (shift - foreseen) / square;
        for (column, own) in grasp.columns.iter_mut().zip(change) {
            *column += surprise * *own;
        }
    }
    grasp
}

fn where_is(standing: &mut Standing, spot: Spot) -> Option<Vector3<f64>> {
    match spot {
        Spot::Body(body, point) => {
            let solution = Session::glance(standing, 2, None);
            solution.bodies.get(body).map(|pose: &Pose| pose.point(&point))
        }
        Spot::Beam(beam, s) => {
            let solution = Session::glance(standing, SECTIONS, Some(beam));
            let sections = solution.beams.get(beam)?.samples.iter();
            let nearest = sections.min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()));
            nearest.map(|sample| sample.pose.position)
        }
    }
}

/// Points of a body: its origin, its centre of mass, and what is fixed on it.
fn points_of(model: &Model, body: usize) -> Vec<Spot> {
    let is_own = |mount: &Mount| matches!(mount, Mount::Body(own) if own.0 == body);
    let mut points = vec![Vector3::zeros(), model.bodies[body].center_of_mass];
    for joint in &model.joints {
        if is_own(&joint.parent.mount) {
            points.push(joint.parent.pose.position);
        }
        if let (true, Some(pose)) = (is_own(&joint.child), joint.child_pose) {
            points.push(pose.position);
        }
    }
    for end in model.beams.iter().flat_map(|beam| beam.start.iter().chain(&beam.end)) {
        if let (true, Some(pose)) = (is_own(&end.mount), end.placement) {
            points.push(pose.position);
        }
    }
    for load in &model.loads {
        if let LoadTarget::Body { body: own, point } = load.target
            && own.0 == body
        {
            points.push(point);
        }
    }
    points.into_iter().map(|point| Spot::Body(body, point)).collect()
}
