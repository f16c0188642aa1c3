//! What a system of equations must be able to do.

/// Why a residual or tangent could not be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Breakdown {
    /// A number overflowed: the state is far from any solution.
    NotFinite,
    /// The tangent has no inverse.
    Singular,
    /// Somebody asked for the end.
    Interrupted,
}

/// A square system r(x; λ) = 0 on a manifold, with a load fraction λ that leads from a known solution at
/// λ = 0 to the wanted one at λ = 1.
///
/// The system keeps its state x, its last residual and its last factorised tangent J. Steps are vectors in
/// the tangent space; they are nondimensional, so that 1 is a large change.
pub trait System {
    /// Number of unknowns and of equations.
    fn unknowns(&self) -> usize;

    /// Sets λ.
    fn set_load(&mut self, fraction: f64);

    /// Evaluates r at the present state.
    fn residual(&mut self) -> Result<(), Breakdown>;

    /// Evaluates r and J at the present state, and factorises J.
    fn linearise(&mut self) -> Result<(), Breakdown>;

    /// Did somebody ask for the end? Then there are no more tangents: [`Breakdown::Interrupted`].
    fn is_interrupted(&self) -> bool {
        false
    }

    /// Is there a factorised tangent of a state that may be near?
    fn has_tangent(&self) -> bool {
        false
    }

    /// The sign of det J at the last tangent. It changes where a path passes a fold or a branch point.
    fn orientation(&self) -> bool;

    /// `step = -J⁻¹ r` with the last residual and the last tangent, which may be of different states.
    fn newton_step(&mut self, step: &mut [f64]);

    /// Keeps the last tangent for [`System::kept_step`], as long as the number of unknowns stays.
    fn keep_tangent(&mut self);

    /// [`System::newton_step`] with the tangent that was kept.
    fn kept_step(&mut self, step: &mut [f64]);

    /// The scaled scalar product of two steps.
    fn product(&self, a: &[f64], b: &[f64]) -> f64;

    /// Moves the state along `step`.
    fn retract(&mut self, step: &[f64]);

    /// The size of a step: the largest scaled change.
    fn size(&self, step: &[f64]) -> f64;

    /// The largest turning (rad) in a step; what lies beyond π cannot be told from its complement.
    fn turning(&self, step: &[f64]) -> f64;

    /// Copies the state out.
    fn store(&self, state: &mut Vec<f64>);

    /// Puts a stored state back.
    fn restore(&mut self, state: &[f64]);

    /// The step that leads from one stored state to another.
    fn difference(&self, from: &[f64], to: &[f64], step: &mut [f64]);

    /// Tells the system the tangent of the path at rest, so that it can judge [`System::phase`].
    fn expect(&mut self, response: &[f64]);

    /// A measure that grows by at most π between two neighbouring sign changes of one eigenvalue of J as the load
    /// grows: steps that raise it by less cannot pass two of them unseen.
    fn phase(&self, load: f64) -> f64;

    /// Called where a point of the path is reached: lets the system renew its discretisation there. True if
    /// states stored before no longer fit.
    fn renew(&mut self) -> bool;

    /// Has more work been done than the caller allows?
    fn is_exhausted(&self) -> bool {
        false
    }
}

/// One entry of the tangent to which a number is added, so that it has an inverse where the tangent itself has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lift {
    /// Number of the equation.
    pub row: usize,
    /// Number of the unknown.
    pub column: usize,
}

/// A system whose tangent can be lifted: J' = J + σ e_row e_columnᵀ, with σ of the size of the row's entries.
///
/// Where J has lost one rank, J' has full rank if the column is one that the null vector moves and the row one that
/// the left null vector does not miss. Bordered systems [J e_row; e_columnᵀ 0] are solved with J' alone.
pub trait Liftable: System {
    /// Equations that may be lifted.
    fn lift_rows(&self) -> Vec<usize>;

    /// Unknowns that may be lifted are the first ones; this is their number.
    fn lift_columns(&self) -> usize;

    /// Lifts the tangents that are made from now on, or leaves them as they are.
    fn set_lift(&mut self, lift: Option<Lift>);

    /// σ of the last tangent; zero without a lift.
    fn lifted_by(&self) -> f64;

    /// `step = J'⁻¹ e_row` with the last tangent.
    fn unit_step(&mut self, row: usize, step: &mut [f64]);

    /// `step = J'⁻¹ W² x` with the last tangent, W the weights of [`System::product`], every unknown standing for the equation of its
    /// number: a step of inverse iteration.
    fn inverse_step(&mut self, x: &[f64], step: &mut [f64]);
}
