//! Small motions about a loaded equilibrium of a rod: where they stand still by themselves, the load is critical.
//!
//! In the axes of a frame that runs along with the rod (k its curvature, ν the axis' derivative, n and m force and moment), the
//! motion u, the turning φ and the changes f, g of force and moment, all as vectors, obey
//!
//! ```text
//! u' + k×u = φ×ν + C_ε (f - φ×n)      φ' + k×φ = C_κ (g - φ×m)
//! f' + k×f = 0                        g' + k×g = -(u' + k×u)×n - ν×f
//! ```
//!
//! with the compliances C of the section in these axes. (Antman, *Nonlinear Problems of Elasticity*, 2nd ed. (2005), ch. 8,
//! linearised.) Six conditions at each end make twelve equations for the twelve numbers at the start; a load is
//! critical where they become dependent, twice so where two singular values vanish.

use crate::ivp::integrate;
use flexura_spatial::Vector3;
use nalgebra::{DMatrix, SMatrix, SVector};

/// The equilibrium at one place, in the frame's axes.
#[derive(Clone, Copy, Debug)]
pub struct Prestress {
    /// p' of the loaded axis: (1, 0, 0) if it neither stretches nor shears.
    pub strain: Vector3<f64>,
    /// The frame's curvature. A round section may be seen from a frame that does not twist with it.
    pub curvature: Vector3<f64>,
    /// Force.
    pub force: Vector3<f64>,
    /// Moment.
    pub moment: Vector3<f64>,
}

/// A loaded rod.
pub struct Loaded<'a> {
    /// Length.
    pub length: f64,
    /// (1/EA, 1/GA2, 1/GA3, 1/GJ, 1/EI2, 1/EI3); zero suppresses a strain.
    pub compliance: [f64; 6],
    /// The equilibrium at s.
    pub state: &'a dyn Fn(f64) -> Prestress,
}

/// A linear condition on (u, φ, f, g) at one end.
pub type Condition = [f64; 12];

/// Conditions that the entries with these numbers vanish: 0 to 2 of u, 3 to 5 of φ, 6 to 8 of f, 9 to 11 of g.
pub fn held<const N: usize>(entries: [usize; N]) -> [Condition; N] {
    entries.map(|entry| std::array::from_fn(|i| if i == entry { 1.0 } else { 0.0 }))
}

impl Loaded<'_> {
    fn rates(&self, s: f64, y: &[f64; 12]) -> [f64; 12] {
        let part = |i: usize| Vector3::new(y[3 * i], y[3 * i + 1], y[3 * i + 2]);
        let [u, turn, f, g] = [part(0), part(1), part(2), part(3)];
        let Prestress { strain, curvature, force, moment } = (self.state)(s);
        let c = &self.compliance;
        let soft = |first: usize, v: Vector3<f64>| {
            Vector3::new(c[first] * v.x, c[first + 1] * v.y, c[first + 2] * v.z)
        };
        let moved = turn.cross(&strain) + soft(0, f - turn.cross(&force));
        let turned = soft(3, g - turn.cross(&moment));
        let all = [
            moved - curvature.cross(&u),
            turned - curvature.cross(&turn),
            -curvature.cross(&f),
            -curvature.cross(&g) - moved.cross(&force) - strain.cross(&f),
        ];
        std::array::from_fn(|i| all[i / 3][i % 3])
    }

    /// The matrix that takes (u, φ, f, g) from the start to the end, in `steps` steps of order 12.
    pub fn transfer(&self, steps: usize) -> SMatrix<f64, 12, 12> {
        let columns = (0..12).map(|j| {
            let start = std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 });
            SVector::from(integrate(|s, y| self.rates(s, y), start, 0.0, self.length, steps)[steps].1)
        });
        SMatrix::from_columns(&columns.collect::<Vec<_>>())
    }

    /// The singular values, ascending, of the conditions at both ends on the twelve numbers at the start.
    pub fn singular_values(&self, start: &[Condition], end: &[Condition], steps: usize) -> Vec<f64> {
        let transfer = self.transfer(steps);
        let rows = start.len() + end.len();
        let mut matrix = DMatrix::zeros(rows, 12);
        for (i, row) in start.iter().enumerate() {
            matrix.row_mut(i).copy_from_slice(row);
        }
        for (i, row) in end.iter().enumerate() {
            matrix.row_mut(start.len() + i).copy_from(&(SVector::from(*row).transpose() * transfer));
        }
        let mut values: Vec<f64> = matrix.singular_values().iter().copied().collect();
        values.sort_by(f64::total_cmp);
        values
    }

    /// The determinant of the conditions, six at each end.
    pub fn determinant(&self, start: &[Condition; 6], end: &[Condition; 6], steps: usize) -> f64 {
        let transfer = self.transfer(steps);
        SMatrix::<f64, 12, 12>::from_fn(|i, j| {
            if i < 6 { start[i][j] } else { (0..12).map(|l| end[i - 6][l] * transfer[(l, j)]).sum() }
        })
        .determinant()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::columns::Ends;
    use crate::roots::root;
    use std::f64::consts::PI;

    const CLAMP: [usize; 6] = [0, 1, 2, 3, 4, 5];

    fn column(load: f64, compliance: [f64; 6], ends: [[Condition; 6]; 2]) -> f64 {
        let state = |_: f64| Prestress {
            strain: Vector3::new(1.0 - compliance[0] * load, 0.0, 0.0),
            curvature: Vector3::zeros(),
            force: Vector3::new(-load, 0.0, 0.0),
            moment: Vector3::zeros(),
        };
        Loaded { length: 1.0, compliance, state: &state }.determinant(&ends[0], &ends[1], 24)
    }

    #[test]
    fn columns_buckle_at_eulers_loads() {
        // Bending about e2 in the plane of e3; about e3 ten times as stiff.
        let compliance = [0.0, 0.0, 0.0, 1.3, 1.0, 0.1];
        let free = held([6, 7, 8, 9, 10, 11]);
        let slider = held([6, 1, 2, 3, 4, 5]);
        let pin = held([6, 1, 2, 3, 10, 5]);
        for (ends, last, kind) in [
            (held(CLAMP), free, Ends::ClampedFree),
            (held([0, 1, 2, 3, 10, 5]), pin, Ends::PinnedPinned),
            (held(CLAMP), pin, Ends::ClampedPinned),
            (held(CLAMP), slider, Ends::ClampedClamped),
            (held(CLAMP), held([6, 1, 8, 3, 4, 5]), Ends::ClampedGuided),
        ] {
            for load in kind.loads(3) {
                let at = |load: f64| column(load, compliance, [ends, last]);
                let found = root(at, load - 0.3, load + 0.3).unwrap();
                assert_close(found, load, 1e-9, "Euler's load");
            }
        }
    }

    #[test]
    fn a_column_that_stretches_buckles_at_its_shorter_length() {
        // P (1 - P/EA) = π²/4 (Timoshenko and Gere, *Theory of Elastic Stability*, 2nd ed. (1961), §2.17).
        let compliance = [0.02, 0.0, 0.0, 1.3, 1.0, 0.1];
        let ends = [held(CLAMP), held([6, 7, 8, 9, 10, 11])];
        let found = root(|load| column(load, compliance, ends), 2.0, 3.0).unwrap();
        assert_close(found * (1.0 - 0.02 * found), 0.25 * PI * PI, 1e-11, "clamped-free");
    }

    #[test]
    fn a_bar_with_a_circular_axis_buckles_sideways_at_timoshenkos_moment() {
        // Timoshenko and Gere, §7.10: hinged across its plane, twist held, bent at its ends by M, which closes it:
        // M = (B + C)/2R ± √[((B - C)/2R)² + (π/α)² B C/R²], with B = EI2, C = GJ and α the angle of the arc.
        let (b, c, radius, angle) = (1.0f64, 0.7f64, 0.8f64, 1.1f64);
        let compliance = [0.0, 0.0, 0.0, 1.0 / c, 1.0 / b, 0.0];
        let [start, end] = [held([0, 1, 2, 3, 10, 5]), held([6, 7, 2, 3, 10, 11])];
        let at = |moment: f64| {
            let state = |_: f64| Prestress {
                strain: Vector3::x(),
                curvature: Vector3::new(0.0, 0.0, 1.0 / radius),
                force: Vector3::zeros(),
                moment: Vector3::new(0.0, 0.0, moment),
            };
            Loaded { length: radius * angle, compliance, state: &state }.determinant(&start, &end, 16)
        };
        let middle = 0.5 * (b + c) / radius;
        let root_part =
            ((0.5 * (b - c) / radius).powi(2) + (PI / angle).powi(2) * b * c / (radius * radius)).sqrt();
        for moment in [middle + root_part, middle - root_part] {
            assert_close(at(moment), 0.0, 1e-14, "critical");
            assert!(at(moment - 0.1) * at(moment + 0.1) < 0.0);
        }
    }
}
