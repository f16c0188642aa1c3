//! Near a point where the tangent loses one rank, everything happens on a surface of two numbers.
//!
//! With the equation `row` and the unknown `column` of a lift, r(x, p) + μ e_row = 0 has a regular solution x for every
//! value of ξ = x_column and p: the bordered matrix [J e_row; e_columnᵀ 0] has an inverse where J has none. What is left of the equations is one
//! number, μ(ξ, p) (Lyapunov and Schmidt; W. Govaerts, *Numerical Methods for Bifurcations of Dynamical Equilibria*, 2000, ch. 3).
//! Solutions are its zeros; a fold has μ = μ_ξ = 0, a branch point μ = μ_ξ = μ_p = 0. With a = J'⁻¹ e_row,
//! v = -J'⁻¹ ∂r/∂p, J' = J + σ e_row e_columnᵀ:
//!
//! ```text
//!   μ_ξ = σ - 1/a_c      μ_p = v_c/a_c      x_ξ = a/a_c      x_p = v - x_ξ v_c        (c = column)
//! ```

use crate::corrector::Miss;
use crate::problem::{Point, Problem, central_slope, slope};
use flexura_nonlinear::{Breakdown, Lift, Liftable, System};

/// μ, its first derivatives and those of the state, at a point of the surface.
#[derive(Clone, Debug)]
pub(crate) struct Value {
    pub mu: f64,
    /// Along ξ and both parameters.
    pub slope: [f64; 3],
    /// How the state moves along ξ and both parameters.
    pub along: [Vec<f64>; 3],
    pub point: Point,
}

/// How a lift is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Choice {
    /// By the largest entry of the tangent's inverse.
    Largest,
    /// By the direction that gives way most, in the measure of the unknowns: where stiff parts have large entries, too.
    Null,
}

/// The surface of one lift.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub lift: Lift,
    /// Is the second parameter asked for?
    pub both: bool,
}

/// Steps of inverse iteration.
const ITERATIONS: usize = 8;
/// How much more it counts that a solution is all null direction than that it is large.
const SHARE: i32 = 4;
/// Rows that are tried as the lifted one.
const TRIED: usize = 48;
const MOST: usize = 12;
/// Size of corrections on the surface, and what round-off may leave.
const TOLERANCE: f64 = 1e-12;
const ROUND_OFF: f64 = 1e-9;

impl Surface {
    /// Chooses row and column from the tangent at the present point, which should be near a critical one. None if no lift makes
    /// the tangent regular.
    pub fn choose<P: Problem>(problem: &mut P, both: bool, by: Choice) -> Option<Self> {
        let system = problem.system();
        system.set_lift(None);
        let rows = system.lift_rows();
        let columns = system.lift_columns();
        let mut step = vec![0.0; system.unknowns()];
        if system.linearise().is_ok() {
            let mut best = (0.0, Lift { row: 0, column: 0 });
            let tried = rows.iter().step_by(rows.len().div_ceil(TRIED).max(1));
            if by == Choice::Largest {
                // Near the critical point every solution is mostly null vector, and most of all those of the rows that the left null
                // vector sees.
                for &row in tried {
                    system.unit_step(row, &mut step);
                    for (column, value) in step[..columns].iter().enumerate() {
                        if value.abs() > best.0 {
                            best = (value.abs(), Lift { row, column });
                        }
                    }
                }
                return (best.0 > 0.0).then_some(Self { lift: best.1, both });
            }
            let null = null_direction(system, &mut step);
            let size = |column: usize, step: &[f64]| step[column].abs() * unit_size(system, column);
            let column = (0..columns).max_by(|a, b| size(*a, &null).total_cmp(&size(*b, &null)))?;
            // The row whose solution is most of all that direction: what other rows move a lot may be stiff, not critical.
            let length = system.product(&null, &null);
            for &row in tried {
                system.unit_step(row, &mut step);
                let along = system.product(&null, &step) / length;
                let share = along * along * length / system.product(&step, &step);
                let value = if share.is_nan() { 0.0 } else { share.powi(SHARE) * along.abs() };
                if value > best.0 {
                    best = (value, Lift { row, column });
                }
            }
            return (best.0 > 0.0).then_some(Self { lift: best.1, both });
        }
        // At the very point: any lift that makes the tangent regular shows both null vectors.
        for &row in &rows {
            for column in (0..columns).step_by(columns.div_ceil(TRIED).max(1)) {
                let lift = Lift { row, column };
                if let Some(better) = (Self { lift, both }).improved(problem) {
                    return Some(better);
                }
            }
        }
        None
    }

    /// The best lift at the present point, which is critical, seen from one that makes its tangent regular: the left null vector is
    /// ψ_i = (J'⁻¹ e_i)_column, the right one J'⁻¹ e_row.
    pub fn improved<P: Problem>(&self, problem: &mut P) -> Option<Self> {
        let system = problem.system();
        system.set_lift(Some(self.lift));
        let outcome = system.linearise();
        system.set_lift(None);
        outcome.ok()?;
        let mut step = vec![0.0; system.unknowns()];
        system.unit_step(self.lift.row, &mut step);
        let columns = system.lift_columns();
        let column = (0..columns).max_by(|a, b| step[*a].abs().total_cmp(&step[*b].abs()))?;
        let rows = system.lift_rows();
        let mut best = (0.0, self.lift.row);
        for &row in rows.iter().step_by(rows.len().div_ceil(TRIED).max(1)) {
            system.unit_step(row, &mut step);
            let value = step[self.lift.column].abs();
            if value > best.0 {
                best = (value, row);
            }
        }
        (best.0 > 0.0).then_some(Self { lift: Lift { row: best.1, column }, both: self.both })
    }

    /// Newton on the surface from the present state at fixed ξ and parameters.
    pub fn settle<P: Problem>(&self, problem: &mut P) -> Result<Value, Miss> {
        problem.system().set_lift(Some(self.lift));
        let outcome = self.settle_lifted(problem);
        problem.system().set_lift(None);
        outcome
    }

    fn settle_lifted<P: Problem>(&self, problem: &mut P) -> Result<Value, Miss> {
        let Lift { row, column } = self.lift;
        let n = problem.system().unknowns();
        let (mut u, mut a) = (vec![0.0; n], vec![0.0; n]);
        let mut before = f64::INFINITY;
        for count in 0..=MOST {
            let system = problem.system();
            system.linearise()?;
            system.newton_step(&mut u);
            system.unit_step(row, &mut a);
            let (top, scale) = (u[column], a[column]);
            u.iter_mut().zip(&a).for_each(|(u, a)| *u -= a / scale * top);
            let size = system.size(&u);
            if !size.is_finite() {
                return Err(Breakdown::NotFinite.into());
            }
            if size <= TOLERANCE || (size <= ROUND_OFF && size > 0.3 * before) {
                system.retract(&u);
                return self.value(problem, top / scale, &a);
            }
            if size > 0.7 * before || count == MOST {
                return Err(Miss::NotContracting);
            }
            system.retract(&u);
            before = size;
        }
        Err(Miss::NotContracting)
    }

    fn value<P: Problem>(&self, problem: &mut P, mu: f64, a: &[f64]) -> Result<Value, Miss> {
        let column = self.lift.column;
        let scale = a[column];
        let lifted = problem.system().lifted_by();
        let along_xi: Vec<f64> = a.iter().map(|a| a / scale).collect();
        let mut value = Value {
            mu,
            slope: [lifted - 1.0 / scale, 0.0, 0.0],
            along: [along_xi, Vec::new(), Vec::new()],
            point: Point::here(problem),
        };
        for which in 0..if self.both { 2 } else { 1 } {
            let mut v = match central_slope(problem, which) {
                Ok(v) => v,
                // At the end of what a parameter may be, one side must do.
                Err(_) => {
                    problem.system().residual()?;
                    slope(problem, which)?
                }
            };
            let top = v[column];
            value.slope[1 + which] = top / scale;
            v.iter_mut().zip(&value.along[0]).for_each(|(v, x)| *v -= x * top);
            value.along[1 + which] = v;
        }
        Ok(value)
    }

    /// The point of the surface at a small way from `from`, along ξ and the parameters.
    pub fn at<P: Problem>(&self, problem: &mut P, from: &Value, way: [f64; 3]) -> Result<Value, Miss> {
        let n = problem.system().unknowns();
        let mut step = vec![0.0; n];
        for (along, by) in from.along.iter().zip(way) {
            if by != 0.0 {
                step.iter_mut().zip(along).for_each(|(s, v)| *s += v * by);
            }
        }
        problem.system().restore(&from.point.state);
        problem.system().retract(&step);
        let parameters = from.point.parameters;
        problem.set_parameters([parameters[0] + way[1], parameters[1] + way[2]])?;
        self.settle(problem)
    }
}

/// The direction in which the tangent gives way most, by inverse iteration.
fn null_direction<S: Liftable>(system: &mut S, step: &mut [f64]) -> Vec<f64> {
    let mut x: Vec<f64> = (0..step.len()).map(|i| 1.0 + (1.7 * i as f64).sin()).collect();
    for _ in 0..ITERATIONS {
        system.inverse_step(&x, step);
        let length = system.product(step, step).sqrt();
        x.iter_mut().zip(&*step).for_each(|(x, s)| *x = s / length);
    }
    x
}

/// The size of a step that changes one unknown by one.
fn unit_size<S: Liftable>(system: &S, column: usize) -> f64 {
    let mut unit = vec![0.0; system.unknowns()];
    unit[column] = 1.0;
    system.size(&unit)
}
