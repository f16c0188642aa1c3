//! What the mechanism is made of, what is loose in it, and what is held twice.

use crate::coordinates::Coordinates;
use crate::error::ProblemError;
use crate::layout::CoordinateSlot;
use crate::lower::{JointOrigin, NodeOrigin};
use crate::system::Equilibrium;
use flexura_model::CoordinateKind;
use flexura_nonlinear::Matrix;
use flexura_spatial::singular_values;
use nalgebra::DMatrix;

/// What the model is: unknowns against equations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Census {
    /// What is unknown ("beam.link: wrench at its start") and how many numbers that is.
    pub unknowns: Vec<(String, usize)>,
    /// What must hold ("beam.link: clamp at its end") and how many equations that is.
    pub equations: Vec<(String, usize)>,
    /// Things a user should know.
    pub warnings: Vec<String>,
}

/// Singular values below this part of the largest count as zero.
const RANK: f64 = 1e-11;

/// Part of a null vector from which something counts as moved by it.
pub(crate) const SEEN: f64 = 1e-6;

/// Unknowns up to which a null space is found by a dense decomposition.
pub(crate) const LARGEST_DENSE: usize = 600;

/// Width over thickness from which a strip counts as wide.
const WIDE: f64 = 10.0;

/// A joint, or an end of a span.
#[derive(Clone, Copy)]
pub(crate) enum Told {
    Joint(usize),
    Hold(usize, &'static str),
}

impl Equilibrium {
    pub(crate) fn node_name(&self, node: usize) -> String {
        match self.lowered.nodes[node].origin {
            NodeOrigin::Body(i) => format!("body.{}", self.model.bodies[i].name),
            NodeOrigin::Hub { beam, s } => {
                format!("beam.{}[{}]", self.model.beams[beam].name, crate::lower::length_text(s))
            }
        }
    }

    pub(crate) fn joint_name(&self, joint: usize) -> String {
        match self.lowered.joints[joint].origin {
            JointOrigin::Joint(i) => format!("joint.{}", self.model.joints[i].name),
            JointOrigin::Hold { beam, start } => {
                let which = if start { "start" } else { "end" };
                format!("beam.{}.{which}", self.model.beams[beam].name)
            }
        }
    }

    pub(crate) fn span_name(&self, span: usize) -> String {
        format!("beam.{}", self.model.beams[self.lowered.spans[span].beam].name)
    }

    /// Unknowns and equations by name.
    pub fn census(&self) -> Census {
        let mut census = Census { warnings: self.warnings().to_vec(), ..Census::default() };
        let mut add = |unknown: String, equation: String, count: usize| {
            if count > 0 {
                census.unknowns.push((unknown, count));
                census.equations.push((equation, count));
            }
        };
        for node in 0..self.layout.nodes.len() {
            let name = self.node_name(node);
            add(format!("{name}: position and rotation"), format!("{name}: balance of force and moment"), 6);
        }
        for (i, slots) in self.layout.spans.iter().enumerate() {
            let name = self.span_name(i);
            let span = &self.lowered.spans[i];
            add(
                format!("{name}: coordinates of its start"),
                format!("{name}: effort at its start"),
                slots.start.count,
            );
            let wrench = if slots.wrench.count == 3 { "moment" } else { "force and moment" };
            let end = match (&span.end, slots.wrench.count) {
                (Some(_), _) => "position and rotation of its end".to_string(),
                (None, 3) => "no moment beyond its free end".to_string(),
                (None, _) => "no force and moment beyond its free end".to_string(),
            };
            add(format!("{name}: {wrench} at its start"), format!("{name}: {end}"), slots.wrench.count);
            add(
                format!("{name}: coordinates of its end"),
                format!("{name}: effort at its end"),
                slots.end.count,
            );
        }
        for (i, slots) in self.layout.joints.iter().enumerate() {
            let name = self.joint_name(i);
            add(
                format!("{name}: coordinates"),
                format!("{name}: effort on its coordinates"),
                slots.coordinates.count,
            );
            add(format!("{name}: force and moment"), format!("{name}: its two frames fit"), 6);
        }
        for coupling in &self.model.couplings {
            let name = format!("coupling.{}", coupling.name);
            add(format!("{name}: effort that keeps it"), format!("{name}: its relation"), 1);
        }
        for (cable, slot) in self.model.cables.iter().zip(&self.layout.ropes) {
            let name = format!("cable.{}", cable.name);
            add(format!("{name}: tension"), format!("{name}: length"), usize::from(slot.is_some()));
        }
        for (tubes, slot) in self.model.tubes.iter().zip(&self.layout.nests) {
            let name = format!("tubes.{}", tubes.name);
            add(format!("{name}: moment at the guide"), format!("{name}: moment at the tip"), 3);
            add(
                format!("{name}: torques at the guide"),
                format!("{name}: no torque at the ends of the tubes"),
                slot.count - 3,
            );
        }
        census.warnings.extend(self.wide_strips());
        census.warnings = flexura_solution::summed_up(census.warnings);
        census
    }

    /// Strips so wide that they cannot contract sideways when bent.
    fn wide_strips(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        for beam in &self.model.beams {
            let section = &self.model[beam.section];
            let flexura_model::Shape::Rectangle { width, height } = &section.shape else { continue };
            let (Some(a), Some(b)) = (width.as_constant(), height.as_constant()) else { continue };
            let ratio = if a > b { a / b } else { b / a };
            if ratio > WIDE && !section.plane_strain {
                warnings.push(format!(
                    "section.{}: the strip of beam.{} is {ratio:.0} times as wide as it is thick; bent about its wide \
                     side it stiffens towards E/(1-ν²), which plane_strain = true takes into account",
                    section.name, beam.name
                ));
            }
        }
        warnings
    }

    /// An orthonormal basis of the null space of the tangent at the present state.
    pub(crate) fn null_space(&mut self) -> Vec<Vec<f64>> {
        // A factorised matrix is spoilt; evaluate it once more and leave it whole.
        let _ = self.evaluate(true);
        let n = self.layout.interface;
        if n > LARGEST_DENSE {
            return sparse_null_space(&mut self.tangent, n);
        }
        let mut matrix = DMatrix::zeros(n, n);
        self.tangent.for_each(|i, j, value| matrix[(i, j)] += value);
        null_space_of(matrix)
    }

    /// The null space of the tangent, in the model's words.
    pub(crate) fn explain_singular(&self, null: &[Vec<f64>]) -> ProblemError {
        let motion = null.iter().fold(vec![0.0_f64; self.layout.interface], |mut m, v| {
            m.iter_mut().zip(v).for_each(|(m, v)| *m = m.max(v.abs()));
            m
        });
        let part = |unknown: usize, count: usize| {
            motion[unknown..unknown + count].iter().fold(0.0_f64, |m, v| m.max(*v))
        };
        let mut loose = Vec::new();
        for (i, slot) in self.layout.nodes.iter().enumerate() {
            if part(slot.unknown, 6) > SEEN {
                loose.push(self.node_name(i));
            }
        }
        for (i, slots) in self.layout.spans.iter().enumerate() {
            if slots.start.count > 0 && part(slots.start.unknown, slots.start.count) > SEEN {
                loose.push(format!("{}.start", self.span_name(i)));
            }
            if slots.end.count > 0 && part(slots.end.unknown, slots.end.count) > SEEN {
                loose.push(format!("{}.end", self.span_name(i)));
            }
        }
        let mut twice = Vec::new();
        for (i, slots) in self.layout.joints.iter().enumerate() {
            let count = slots.coordinates.count;
            if count > 0 && part(slots.coordinates.unknown, count) > SEEN {
                loose.push(self.joint_name(i));
            }
            if part(slots.wrench.unknown, 6) > SEEN {
                twice.push(self.joint_name(i));
            }
        }
        for (coupling, slot) in self.model.couplings.iter().zip(&self.layout.gears) {
            if part(slot.unknown, 1) > SEEN {
                twice.push(format!("coupling.{}", coupling.name));
            }
        }
        for (cable, slot) in self.model.cables.iter().zip(&self.layout.ropes) {
            if slot.is_some_and(|slot| part(slot.unknown, 1) > SEEN) {
                twice.push(format!("cable.{}", cable.name));
            }
        }
        for (i, slots) in self.layout.spans.iter().enumerate() {
            if part(slots.wrench.unknown, slots.wrench.count) > SEEN {
                twice.push(self.span_name(i));
            }
        }
        twice.dedup();
        for (tubes, slot) in self.model.tubes.iter().zip(&self.layout.nests) {
            if part(slot.unknown, slot.count) > SEEN {
                twice.push(format!("tubes.{}", tubes.name));
            }
        }
        if !loose.is_empty() {
            return ProblemError::new(
                loose[0].clone(),
                format!("can move without resistance: {}", loose.join(", ")),
                "hold it with a beam, a joint to the ground or a spring, or give the joint a stiffness",
            );
        }
        if !twice.is_empty() {
            return ProblemError::new(
                twice[0].clone(),
                format!("over-constrained loop; the forces cannot be told apart of: {}", twice.join(", ")),
                "free one of the joints, or let a beam of the loop stretch and bend",
            );
        }
        unnamed()
    }

    /// Warnings about the state: springs beyond their tables, coordinates beyond their limits.
    pub(crate) fn state_warnings(&self) -> Vec<String> {
        let mut warnings = self.spring_warnings();
        for (coordinates, slot, name) in self.told_coordinates() {
            let kinds = coordinates.kind.coordinate_kinds();
            let words = coordinates.kind.coordinate_names();
            for (i, value, range) in coordinates.beyond_limits(&self.configuration(slot)) {
                let text = |v: f64| match kinds[i] {
                    CoordinateKind::Angle => format!("{:.4} deg", v.to_degrees()),
                    CoordinateKind::Length => crate::lower::length_text(v),
                };
                warnings.push(format!(
                    "{}: its {} is {}, outside its limits {} and {}",
                    self.name_of(name),
                    words[i],
                    text(value),
                    text(range[0]),
                    text(range[1])
                ));
            }
        }
        self.contact_warnings(&mut warnings);
        self.leaf_warnings(&mut warnings);
        warnings
    }

    /// Every joint and hold: its coordinates, where they stand, and what is called by [`Equilibrium::name_of`].
    pub(crate) fn told_coordinates(&self) -> impl Iterator<Item = (&Coordinates, &CoordinateSlot, Told)> {
        let joints = self.lowered.joints.iter().zip(&self.layout.joints).enumerate();
        let joints =
            joints.map(|(i, (joint, slots))| (&joint.coordinates, &slots.coordinates, Told::Joint(i)));
        let spans = self.lowered.spans.iter().zip(&self.layout.spans).enumerate();
        let holds = spans.flat_map(|(i, (span, slots))| {
            let end = span.end.as_ref();
            let end = end.map(|end| (&end.coordinates, &slots.end, Told::Hold(i, "end")));
            std::iter::once((&span.start.coordinates, &slots.start, Told::Hold(i, "start"))).chain(end)
        });
        joints.chain(holds)
    }

    /// What a joint or hold is called.
    pub(crate) fn name_of(&self, told: Told) -> String {
        match told {
            Told::Joint(i) => self.joint_name(i),
            Told::Hold(span, end) => format!("{}.{end}", self.span_name(span)),
        }
    }
}

/// Orthonormal vectors that a square matrix takes to (nearly) nothing.
pub(crate) fn null_space_of(matrix: DMatrix<f64>) -> Vec<Vec<f64>> {
    let n = matrix.ncols();
    let Some(svd) = singular_values(matrix, false, true) else { return Vec::new() };
    let Some(vt) = svd.v_t else { return Vec::new() };
    let largest = svd.singular_values.max();
    let small = svd.singular_values.iter().enumerate().filter(|(_, value)| **value <= RANK * largest);
    small.map(|(k, _)| (0..n).map(|j| vt[(k, j)]).collect()).collect()
}

/// Null vectors of a large matrix by inverse iteration with a slightly shifted one; some of them, if they are many.
fn sparse_null_space(matrix: &mut Matrix, n: usize) -> Vec<Vec<f64>> {
    const VECTORS: usize = 8;
    const SHIFT: f64 = 1e-8;
    let mut entries = Vec::new();
    let mut scale = vec![0.0_f64; n];
    matrix.for_each(|i, j, value| {
        entries.push((i, j, value));
        scale[i] = scale[i].max(value.abs());
    });
    for (i, size) in scale.iter().enumerate() {
        matrix.add(i, i, SHIFT * size.max(1e-3));
    }
    if matrix.factorise().is_err() {
        return Vec::new();
    }
    let start = |k: usize| -> Vec<f64> { (0..n).map(|i| ((i * (2 * k + 3) + k) as f64).sin()).collect() };
    let mut vectors: Vec<Vec<f64>> = (0..VECTORS).map(start).collect();
    for _ in 0..4 {
        for k in 0..VECTORS {
            let (done, rest) = vectors.split_at_mut(k);
            let v = &mut rest[0];
            v.iter_mut().zip(&scale).for_each(|(v, s)| *v *= s.max(1e-3));
            matrix.solve(v);
            for other in done.iter() {
                let along: f64 = other.iter().zip(v.iter()).map(|(a, b)| a * b).sum();
                v.iter_mut().zip(other).for_each(|(v, o)| *v -= along * o);
            }
            let length = v.iter().map(|v| v * v).sum::<f64>().sqrt();
            v.iter_mut().for_each(|v| *v /= length);
        }
    }
    // What the matrix does not take to nothing is no null vector.
    vectors.retain(|v| {
        let mut image = vec![0.0; n];
        entries.iter().for_each(|(i, j, value)| image[*i] += value * v[*j]);
        image.iter().zip(&scale).all(|(x, s)| x.abs() <= 1e-6 * s)
    });
    vectors
}

fn unnamed() -> ProblemError {
    ProblemError::new(
        "model",
        "has no unique equilibrium at rest: its tangent has no inverse",
        "look for something that is not held, or held twice",
    )
}
