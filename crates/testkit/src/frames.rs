//! Straight beams between rigid bodies as a mesh of cubic elements, at rest: how many natural frequencies lie below one.
//!
//! Bending about either axis by Hermite's cubics, stretching and twisting by straight lines, and the inertia that goes with these
//! shapes (J. S. Przemieniecki, *Theory of Matrix Structural Analysis*, 1968, ch. 5 and 11). Rotary inertia is that about the axis
//! alone. By Sylvester's law of inertia as many pivots of K - ω² M are negative as there are frequencies below ω. Frequencies of such
//! a mesh lie above the exact ones.

use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

type M12 = SMatrix<f64, 12, 12>;

/// Section of a beam: stiffnesses and inertia per length.
#[derive(Clone, Copy, Debug)]
pub struct FrameSection {
    /// EA.
    pub stretching: f64,
    /// GJ.
    pub twisting: f64,
    /// EI about e2 and about e3.
    pub bending: [f64; 2],
    /// Mass per length.
    pub mass: f64,
    /// Moment of inertia per length about e1.
    pub polar: f64,
}

/// A straight beam, clamped at both ends to bodies; None is the ground.
#[derive(Clone, Copy, Debug)]
pub struct FrameBeam {
    /// What its ends are clamped to, at the body's centre of mass.
    pub ends: [Option<usize>; 2],
    /// Length.
    pub length: f64,
    /// Section axes e1, e2, e3 as columns.
    pub axes: Matrix3<f64>,
    /// Its section.
    pub section: FrameSection,
}

/// A rigid body: mass, and moments of inertia about global axes through the centre of mass.
#[derive(Clone, Copy, Debug)]
pub struct FrameBody {
    /// Mass.
    pub mass: f64,
    /// Moments of inertia.
    pub inertia: [f64; 3],
}

/// Stiffness and inertia of an element of length h in (u, θ) of its two ends, local axes.
fn element(section: &FrameSection, h: f64) -> [M12; 2] {
    let (mut k, mut m) = (M12::zeros(), M12::zeros());
    for (dof, stiff, mass) in [(0, section.stretching, section.mass), (3, section.twisting, section.polar)] {
        for (i, j, sign, share) in [(0, 0, 1.0, 2.0), (6, 6, 1.0, 2.0), (0, 6, -1.0, 1.0), (6, 0, -1.0, 1.0)]
        {
            k[(dof + i, dof + j)] += sign * stiff / h;
            m[(dof + i, dof + j)] += share * mass * h / 6.0;
        }
    }
    // v with θ about e3; w with θ about e2, of which w' is the negative.
    for (shift, turn, sign, bending) in [(1, 5, 1.0, section.bending[1]), (2, 4, -1.0, section.bending[0])] {
        let at = [shift, turn, shift + 6, turn + 6];
        let by = [1.0, sign * h, 1.0, sign * h];
        let stiff = [
            [12.0, 6.0, -12.0, 6.0],
            [6.0, 4.0, -6.0, 2.0],
            [-12.0, -6.0, 12.0, -6.0],
            [6.0, 2.0, -6.0, 4.0],
        ];
        let heavy = [
            [156.0, 22.0, 54.0, -13.0],
            [22.0, 4.0, 13.0, -3.0],
            [54.0, 13.0, 156.0, -22.0],
            [-13.0, -3.0, -22.0, 4.0],
        ];
        for i in 0..4 {
            for j in 0..4 {
                k[(at[i], at[j])] += bending / h.powi(3) * stiff[i][j] * by[i] * by[j];
                m[(at[i], at[j])] += section.mass * h / 420.0 * heavy[i][j] * by[i] * by[j];
            }
        }
    }
    [k, m]
}

/// How many natural frequencies of the mesh with so many elements a beam lie below a circular frequency.
pub fn frequencies_below(bodies: &[FrameBody], beams: &[FrameBeam], elements: usize, omega: f64) -> usize {
    let inner = elements - 1;
    // Nodes of the beams first, bodies last, so that elimination fills little.
    let first_body = 6 * inner * beams.len();
    let n = first_body + 6 * bodies.len();
    let mut a = DMatrix::zeros(n, n);
    for (b, beam) in beams.iter().enumerate() {
        let [k, m] = element(&beam.section, beam.length / elements as f64);
        let local = k - m * omega * omega;
        let mut turn = M12::zeros();
        (0..4).for_each(|i| turn.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(&beam.axes.transpose()));
        let global = turn.transpose() * local * turn;
        let node = |i: usize| match i {
            0 => beam.ends[0].map(|body| first_body + 6 * body),
            i if i == elements => beam.ends[1].map(|body| first_body + 6 * body),
            i => Some(6 * (inner * b + i - 1)),
        };
        for e in 0..elements {
            let at = [node(e), node(e + 1)];
            for (i, row) in at.iter().enumerate() {
                for (j, column) in at.iter().enumerate() {
                    let (Some(row), Some(column)) = (row, column) else { continue };
                    let mut block = a.view_mut((*row, *column), (6, 6));
                    block += global.fixed_view::<6, 6>(6 * i, 6 * j);
                }
            }
        }
    }
    for (i, body) in bodies.iter().enumerate() {
        let at = first_body + 6 * i;
        for k in 0..3 {
            a[(at + k, at + k)] -= omega * omega * body.mass;
            a[(at + 3 + k, at + 3 + k)] -= omega * omega * body.inertia[k];
        }
    }
    negative_pivots(&mut a)
}

/// Negative pivots of elimination without exchanges, of a matrix that is empty far from its diagonal but in its last rows.
fn negative_pivots(a: &mut DMatrix<f64>) -> usize {
    let n = a.nrows();
    let mut negative = 0;
    for k in 0..n {
        let pivot = a[(k, k)];
        negative += usize::from(pivot < 0.0);
        let touched: Vec<usize> = (k + 1..n).filter(|i| a[(*i, k)] != 0.0).collect();
        for &j in &touched {
            let factor = a[(j, k)] / pivot;
            for &i in &touched {
                a[(i, j)] -= a[(i, k)] * factor;
            }
        }
    }
    negative
}

/// Rotation by an angle about a unit vector.
pub fn turned(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(*axis), angle).into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cantilever_has_the_frequencies_of_the_closed_form() {
        let section =
            FrameSection { stretching: 1e8, twisting: 1e8, bending: [1e4, 1.0], mass: 1.0, polar: 1.0 };
        let axes = turned(&Vector3::new(1.0, 2.0, -0.4), 0.7);
        let beam = FrameBeam { ends: [None, Some(0)], length: 1.0, axes, section };
        let body = FrameBody { mass: 0.0, inertia: [0.0; 3] };
        // (β L)² of Blevins, table 8-1.
        for (below, rate) in
            [3.516_015_268_5, 22.034_491_564_7, 61.697_214_414, 120.901_916_053].iter().enumerate()
        {
            // The hundred times stiffer direction has its first at 351.6.
            assert_eq!(frequencies_below(&[body], &[beam], 40, rate * (1.0 - 1e-4)), below);
            assert_eq!(frequencies_below(&[body], &[beam], 40, rate * (1.0 + 1e-4)), below + 1);
        }
    }
}
