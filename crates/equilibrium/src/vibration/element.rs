//! The tangent of one element in the motions of its nodes and the wrenches at its Gauss points.
//!
//! With a small turning θ and shift u of the section, both in global axes, and the changes of strain in its own axes
//!
//! ```text
//!   γ = Rᵀ (u' - θ × p')      κ = Rᵀ θ'
//! ```
//!
//! virtual work δW = ∫ F·(δu' - δθ × p') + M·δθ' - q·δu - q_M·δθ ds changes by
//!
//! ```text
//!   ∫ n·δγ + m·δκ + (θ × F)·(δu' - δθ × p') + (θ × M)·δθ' - F·(δθ × u')      n, m = C⁻¹ (γ, κ)
//!     + δu·K u - δu·(θ × q) - δθ·(θ × q_M) ds
//! ```
//!
//! K is the slope of foundations; q and q_M in the last two terms are those loads that follow the section. Where C is small beside
//! the bending, or nothing at all, the change of the wrench is an unknown of its own with the equation γ - C n = 0, so that
//! neither an axis that does not stretch nor a very stiff one costs digits. Strains are taken at p Gauss points of an element of order
//! p, which for even a stiff law neither locks nor leaves a motion without strain (O. C. Zienkiewicz and R. L. Taylor, *The Finite
//! Element Method*, vol. 1, 5th ed., 2000, ch. 12).

use super::rule::Rule;
use super::tendon::Thread;
use flexura_spatial::{Matrix3, Matrix6, Vector3, hat};
use nalgebra::{DMatrix, DVector};

type V = Vector3<f64>;

/// Of a section: what its small motions meet. Nondimensional, global axes.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub rotation: Matrix3<f64>,
    /// p', the axis's rate.
    pub axis: V,
    pub force: V,
    pub moment: V,
    /// Strains per wrench, in the section's axes.
    pub compliance: Matrix6<f64>,
    /// Slope of foundations.
    pub foundation: Matrix3<f64>,
    /// Force and moment per length that follow the section.
    pub follower: [V; 2],
    /// Tendons in channels there.
    pub threads: Vec<Thread>,
}

/// Compliance in stretching and shear, beside that in bending times the square of the length, below which the wrench is an
/// unknown of its own.
const STIFF: f64 = 1e-4;

/// Which components of the wrench are unknowns, along a beam of this length.
pub(super) fn kept(compliance: &Matrix6<f64>, length: f64) -> [bool; 6] {
    let soft = (3..6).map(|i| compliance[(i, i)]).fold(0.0, f64::max);
    let small = |i: usize| compliance[(i, i)] < STIFF * soft * if i < 3 { length * length } else { 1.0 };
    let coupled = (0..6).any(|i| (0..6).any(|j| i != j && compliance[(i, j)] != 0.0));
    if coupled && (0..6).any(small) { [true; 6] } else { std::array::from_fn(small) }
}

/// The inverse of the compliance among components that are no unknowns.
fn stiffness(compliance: &Matrix6<f64>, kept: &[bool; 6]) -> Option<Matrix6<f64>> {
    let part = Matrix6::from_fn(|i, j| match (kept[i] || kept[j], i == j) {
        (true, true) => 1.0,
        (true, false) => 0.0,
        _ => compliance[(i, j)],
    });
    let mut inverse = part.try_inverse()?;
    (0..6).filter(|i| kept[*i]).for_each(|i| inverse[(i, i)] = 0.0);
    Some(inverse)
}

fn add3(a: &mut DMatrix<f64>, row: usize, column: usize, block: &Matrix3<f64>) {
    for i in 0..3 {
        for j in 0..3 {
            a[(row + i, column + j)] += block[(i, j)];
        }
    }
}

/// Changes of strain by the motion (turning, shift) of a node, whose polynomial has this value and slope at the point.
fn strain(point: &Point, value: f64, slope: f64) -> Matrix6<f64> {
    let inverse = point.rotation.transpose();
    let mut strain = Matrix6::zeros();
    strain.fixed_view_mut::<3, 3>(0, 0).copy_from(&(inverse * hat(&point.axis) * value));
    strain.fixed_view_mut::<3, 3>(0, 3).copy_from(&(inverse * slope));
    strain.fixed_view_mut::<3, 3>(3, 0).copy_from(&(inverse * slope));
    strain
}

/// How the lengths of tendons in an element go with the motions of its nodes.
pub(super) fn lengths(rule: &Rule, length: f64, points: &[Point]) -> Vec<(usize, DVector<f64>)> {
    let mut all: Vec<(usize, DVector<f64>)> = Vec::new();
    for (g, point) in points.iter().enumerate() {
        let weight = 0.5 * length * rule.point_weights[g];
        for thread in &point.threads {
            let at = all.iter().position(|(rope, _)| *rope == thread.rope).unwrap_or_else(|| {
                all.push((thread.rope, DVector::zeros(6 * rule.nodes.len())));
                all.len() - 1
            });
            for (j, (value, slope)) in rule.values[g].iter().zip(&rule.slopes[g]).enumerate() {
                let change = strain(point, *value, slope * 2.0 / length).tr_mul(&thread.along) * weight;
                let mut part = all[at].1.fixed_rows_mut::<6>(6 * j);
                part += change;
            }
        }
    }
    all
}

/// What rates of the strains add to the tangent, per τ of n = C⁻¹ (γ + τ γ̇): to virtual work ∫ δγ·C⁻¹ γ̇, and γ̇ to the equation
/// γ + τ γ̇ - C n = 0 of kept components, of those that yield at all. Numbered as [`tangent`].
pub(super) fn viscous(rule: &Rule, length: f64, points: &[Point], kept: &[bool; 6]) -> Option<DMatrix<f64>> {
    let nodes = rule.order + 1;
    let listed: Vec<usize> = (0..6).filter(|i| kept[*i]).collect();
    let n = 6 * nodes + listed.len() * rule.order;
    let mut a = DMatrix::zeros(n, n);
    for (g, point) in points.iter().enumerate() {
        let weight = 0.5 * length * rule.point_weights[g];
        let slopes = rule.slopes[g].iter().map(|slope| slope * 2.0 / length);
        let stiff = stiffness(&point.compliance, kept)? * weight;
        let strains: Vec<Matrix6<f64>> =
            rule.values[g].iter().zip(slopes).map(|(value, slope)| strain(point, *value, slope)).collect();
        for (j, own) in strains.iter().enumerate() {
            let stress = stiff * own;
            for (i, other) in strains.iter().enumerate() {
                let mut block = a.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                block += other.tr_mul(&stress);
            }
            for (k, component) in listed.iter().enumerate() {
                if point.compliance[(*component, *component)] == 0.0 {
                    continue;
                }
                let row = 6 * nodes + g * listed.len() + k;
                for l in 0..6 {
                    a[(row, 6 * j + l)] += weight * own[(*component, l)];
                }
            }
        }
    }
    Some(a)
}

/// The tangent of δW of an element of nondimensional length: nodes' motions first, (turning, shift) each, then the kept
/// components at each Gauss point. None where a compliance has no inverse.
pub(super) fn tangent(rule: &Rule, length: f64, points: &[Point], kept: &[bool; 6]) -> Option<DMatrix<f64>> {
    let nodes = rule.order + 1;
    let listed: Vec<usize> = (0..6).filter(|i| kept[*i]).collect();
    let n = 6 * nodes + listed.len() * rule.order;
    let mut a = DMatrix::zeros(n, n);
    let mut strains = vec![Matrix6::zeros(); nodes];
    let mut stresses = vec![Matrix6::zeros(); nodes];
    for (g, point) in points.iter().enumerate() {
        let weight = 0.5 * length * rule.point_weights[g];
        let slopes: Vec<f64> = rule.slopes[g].iter().map(|slope| slope * 2.0 / length).collect();
        let values = &rule.values[g];
        let pulled: Matrix6<f64> = point.threads.iter().map(|thread| thread.stiffness).sum();
        let stiff = (stiffness(&point.compliance, kept)? + pulled) * weight;
        for j in 0..nodes {
            strains[j] = strain(point, values[j], slopes[j]);
            stresses[j] = stiff * strains[j];
        }
        let (force, moment) = (hat(&point.force) * weight, hat(&point.moment) * weight);
        let along = point.force.dot(&point.axis);
        let turning = (point.force * point.axis.transpose() - Matrix3::identity() * along) * weight
            + hat(&point.follower[1]) * weight;
        let shifted = point.foundation * weight;
        let follower = hat(&point.follower[0]) * weight;
        for i in 0..nodes {
            for j in 0..nodes {
                let (vv, vs, sv) = (values[i] * values[j], values[i] * slopes[j], slopes[i] * values[j]);
                let material = strains[i].tr_mul(&stresses[j]);
                let (row, column) = (6 * i, 6 * j);
                for k in 0..6 {
                    for l in 0..6 {
                        a[(row + k, column + l)] += material[(k, l)];
                    }
                }
                add3(&mut a, row, column, &(turning * vv - moment * sv));
                add3(&mut a, row, column + 3, &(force * vs));
                add3(&mut a, row + 3, column, &(follower * vv - force * sv));
                add3(&mut a, row + 3, column + 3, &(shifted * vv));
            }
            for (k, component) in listed.iter().enumerate() {
                let unknown = 6 * nodes + g * listed.len() + k;
                for l in 0..6 {
                    let value = weight * strains[i][(*component, l)];
                    a[(6 * i + l, unknown)] += value;
                    a[(unknown, 6 * i + l)] += value;
                }
            }
        }
        for (k, row) in listed.iter().enumerate() {
            for (l, column) in listed.iter().enumerate() {
                let first = 6 * nodes + g * listed.len();
                a[(first + k, first + l)] -= weight * point.compliance[(*row, *column)];
            }
        }
    }
    Some(a)
}
