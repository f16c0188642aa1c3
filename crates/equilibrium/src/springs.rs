//! Springs: their laws at the present load, their courses, and what they add to residual and tangent.

use crate::assembly::{Sink, unit};
use crate::lower::{Link, Wrapping};
use crate::system::Equilibrium;
use flexura_mechanics::spring::{Around, PathError, Spring, TensionLaw};
use flexura_model::SpringLaw;
use flexura_solution::SpringSolution;
use flexura_spatial::{Matrix3, Pose, Vector3};

type V = Vector3<f64>;
type Ends = [(Option<usize>, V); 2];

/// Where the ends of a spring are (global), and its course if that is not straight.
pub(crate) struct Course {
    pub ends: [V; 2],
    pub length: f64,
    pub around: Option<Around>,
}

impl Wrapping {
    /// The ends in the obstacle's frame.
    pub fn local(&self, carrier: &Pose, poses: &[Pose; 2], ends: &Ends) -> [V; 2] {
        let frame = (*carrier * self.carrier.frame).inverse();
        [0, 1].map(|i| frame.point(&poses[i].point(&ends[i].1)))
    }
}

/// What acts on the three nodes of a wrapped spring, and where.
struct Wrapped<'a> {
    /// Of the ends and the obstacle; None: the ground.
    nodes: [Option<usize>; 3],
    /// From the three nodes' origins to the ends, and from the obstacle's node to both ends.
    arms: [V; 2],
    levers: [V; 2],
    /// On the ends; the obstacle gets the opposite of both.
    forces: [V; 2],
    /// -d force by the ends' motion relative to the obstacle, global axes.
    stiffness: &'a [[Matrix3<f64>; 2]; 2],
}

impl Equilibrium {
    /// The law at the present load: the rest length moves from the length at which the spring is relaxed initially, and a jump
    /// grows from nothing.
    pub(crate) fn spring_law(&self, index: usize) -> Spring {
        let Link { law, rest_length: [from, to], is_loose, .. } = &self.lowered.springs[index];
        let law = match *law {
            TensionLaw::Exponential { force, exponent, jump } => {
                TensionLaw::Exponential { force, exponent, jump: jump * self.load }
            }
            ref other => other.clone(),
        };
        Spring { law, rest_length: from + self.load * (to - from), is_loose: *is_loose }
    }

    /// Ends and course, nondimensional.
    pub(crate) fn spring_course(&self, index: usize) -> Result<Course, PathError> {
        let link = &self.lowered.springs[index];
        let poses = link.ends.map(|(node, _)| self.node_pose(node));
        let ends = [0, 1].map(|i| poses[i].point(&link.ends[i].1));
        let around = match &link.wrap {
            None => None,
            Some(wrap) => {
                let [a, b] = wrap.local(&self.node_pose(wrap.carrier.node), &poses, &link.ends);
                wrap.obstacle.around(&a, &b)?
            }
        };
        let length = around.as_ref().map_or_else(|| (ends[1] - ends[0]).norm(), |around| around.length);
        Ok(Course { ends, length, around })
    }

    pub(crate) fn evaluate_springs(&self, sink: &mut Sink<'_>) {
        for (index, link) in self.lowered.springs.iter().enumerate() {
            let law = self.spring_law(index);
            match self.spring_course(index) {
                Ok(Course { ends, around: None, .. }) => match law.between(&ends[0], &ends[1]) {
                    Some(force) => self.pull(&link.ends, &ends, &force, sink),
                    None => self.refuse(&link.ends, sink),
                },
                Ok(Course { ends, around: Some(around), .. }) => {
                    if let Some(wrap) = &link.wrap {
                        self.pull_around(link, wrap, &law, &ends, &around, sink);
                    }
                }
                Err(_) => {
                    let obstacle = link.wrap.as_ref().map(|wrap| (wrap.carrier.node, V::zeros()));
                    let on: Vec<_> = link.ends.iter().copied().chain(obstacle).collect();
                    self.refuse(&on, sink);
                }
            }
        }
    }

    /// Tension T along a path of length ℓ(a, b): with a and b the ends in the obstacle's frame, -T ∂ℓ/∂a and -T ∂ℓ/∂b act on
    /// the ends, and the opposite of both, where they act, on what carries the obstacle.
    pub(crate) fn pull_around(
        &self,
        link: &Link,
        wrap: &Wrapping,
        law: &Spring,
        ends: &[V; 2],
        around: &Around,
        sink: &mut Sink<'_>,
    ) {
        let pull = law.pull(around.length);
        let nodes = [link.ends[0].0, link.ends[1].0, wrap.carrier.node];
        let axes = (self.node_pose(nodes[2]) * wrap.carrier.frame).rotation.to_rotation_matrix();
        let axes = axes.matrix();
        let gradient = around.gradient.map(|g| axes * g);
        let stiffness = [0, 1].map(|i| {
            [0, 1].map(|j| {
                gradient[i] * gradient[j].transpose() * pull.rate
                    + axes * around.hessian[i][j] * axes.transpose() * pull.tension
            })
        });
        let obstacle = self.node_pose(nodes[2]).position;
        Wrapped {
            nodes,
            arms: [0, 1].map(|i| ends[i] - self.node_pose(nodes[i]).position),
            levers: ends.map(|end| end - obstacle),
            forces: gradient.map(|g| g * -pull.tension),
            stiffness: &stiffness,
        }
        .add(|node| self.layout.nodes[node].unknown, sink);
    }

    /// The springs' states, SI, and their energy, nondimensional.
    pub(crate) fn spring_solutions(&self) -> (Vec<SpringSolution>, f64) {
        let scale = &self.lowered.scale;
        let mut energy = 0.0;
        let mut springs = Vec::with_capacity(self.lowered.springs.len());
        for (index, link) in self.lowered.springs.iter().enumerate() {
            let law = self.spring_law(index);
            // Without a course the state is no equilibrium; then there is the line between the ends.
            let course = self.spring_course(index).unwrap_or_else(|_| {
                let ends = [0, 1].map(|i| self.node_pose(link.ends[i].0).point(&link.ends[i].1));
                Course { ends, length: (ends[1] - ends[0]).norm(), around: None }
            });
            let tension = law.pull(course.length).tension * scale.force;
            energy += law.energy(course.length);
            let strain = law.strain(course.length);
            let described = &self.model.springs[index];
            let stress = match described.law {
                SpringLaw::Exponential { area, .. } => {
                    strain.map(|strain| tension * (1.0 + strain) / (area * described.size.powi(2)))
                }
                _ => None,
            };
            let points = match (&course.around, &link.wrap) {
                (Some(around), Some(wrap)) => {
                    let carrier = self.node_pose(wrap.carrier.node);
                    let frame = carrier * wrap.carrier.frame;
                    let inside = frame.inverse();
                    around
                        .course(&inside.point(&course.ends[0]), &inside.point(&course.ends[1]))
                        .iter()
                        .map(|point| frame.point(point) * scale.length)
                        .collect()
                }
                _ => Vec::new(),
            };
            springs.push(SpringSolution {
                ends: course.ends.map(|end| end * scale.length),
                length: course.length * scale.length,
                tension,
                strain,
                stress,
                is_slack: law.is_slack(course.length),
                course: points,
            });
        }
        (springs, energy)
    }

    /// Springs stretched beyond what their tables say.
    pub(crate) fn spring_warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        for (index, described) in self.model.springs.iter().enumerate() {
            let (law, Ok(course)) = (self.spring_law(index), self.spring_course(index)) else { continue };
            let TensionLaw::Table(table) = &law.law else { continue };
            let stretch = course.length - law.rest_length;
            if stretch > table.last() {
                let text = |length: f64| crate::lower::length_text(length * self.lowered.scale.length);
                warnings.push(format!(
                    "spring.{}: is stretched by {}, beyond the last row of its table at {}; there it goes straight on",
                    described.name,
                    text(stretch),
                    text(table.last())
                ));
            }
        }
        warnings
    }
}

impl Wrapped<'_> {
    /// Adds forces and moments to the rows of the nodes, and how they change with the nodes' motion. Turning and shift of
    /// what carries the obstacle move the ends relative to it by the opposite of the motion that it would give them.
    fn add(&self, at: impl Fn(usize) -> usize, sink: &mut Sink<'_>) {
        let rows = self.nodes.map(|node| node.map(&at));
        let mut moment = V::zeros();
        for i in 0..2 {
            moment -= self.levers[i].cross(&self.forces[i]);
            if let Some(rows) = rows[i] {
                sink.add_residual(rows, &self.arms[i].cross(&self.forces[i]));
                sink.add_residual(rows + 3, &self.forces[i]);
            }
        }
        if let Some(rows) = rows[2] {
            sink.add_residual(rows, &moment);
            sink.add_residual(rows + 3, &-(self.forces[0] + self.forces[1]));
        }
        if sink.matrix.is_none() {
            return;
        }
        for (moving, columns) in rows.iter().enumerate() {
            let Some(columns) = *columns else { continue };
            for column in 0..6 {
                let (turn, shift) =
                    if column < 3 { (unit(column), V::zeros()) } else { (V::zeros(), unit(column - 3)) };
                // The ends' own motion, and that relative to the obstacle.
                let own =
                    [0, 1].map(|i| if i == moving { shift + turn.cross(&self.arms[i]) } else { V::zeros() });
                let carried = self
                    .levers
                    .map(|lever| if moving == 2 { shift + turn.cross(&lever) } else { V::zeros() });
                let relative = [own[0] - carried[0], own[1] - carried[1]];
                let change = [0, 1].map(|i| {
                    let turned = if moving == 2 { turn.cross(&self.forces[i]) } else { V::zeros() };
                    turned - self.stiffness[i][0] * relative[0] - self.stiffness[i][1] * relative[1]
                });
                let origin = if moving == 2 { shift } else { V::zeros() };
                let mut moment = V::zeros();
                for i in 0..2 {
                    moment -= (own[i] - origin).cross(&self.forces[i]) + self.levers[i].cross(&change[i]);
                    if let Some(rows) = rows[i] {
                        let arm = if i == moving { turn.cross(&self.arms[i]) } else { V::zeros() };
                        let moment = arm.cross(&self.forces[i]) + self.arms[i].cross(&change[i]);
                        sink.add(rows, columns + column, &moment);
                        sink.add(rows + 3, columns + column, &change[i]);
                    }
                }
                if let Some(rows) = rows[2] {
                    sink.add(rows, columns + column, &moment);
                    sink.add(rows + 3, columns + column, &-(change[0] + change[1]));
                }
            }
        }
    }
}
