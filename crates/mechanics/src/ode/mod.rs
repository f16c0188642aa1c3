//! One explicit Runge-Kutta step of order 8 in twelve stages.
//!
//! The method is the propagating formula of DOP853: P. J. Prince and J. R. Dormand, "High order embedded
//! Runge-Kutta formulae", J. Comput. Appl. Math. 7 (1981), with the coefficients of E. Hairer, S. P.
//! Nørsett and G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., section II.5. Its embedded
//! error estimates are not used: they are of order 5 and 3 and overestimate the error of the smooth
//! right-hand sides here by many orders of magnitude, which would buy steps that nobody needs. Accuracy is
//! judged by halving the steps instead (`flexura-equilibrium`, `accuracy.rs`).
//!
//! A state is `N` numbers, each with `W` lanes: lane 0 holds the value, the others its derivatives along
//! as many directions. The stepper is linear and treats all lanes alike, so what comes out in the derivative
//! lanes is the exact derivative of the discrete result.

/// `N` state components of `W` lanes: lane 0 the value, lanes 1.. its derivatives.
pub type State<const N: usize, const W: usize> = [[f64; W]; N];

/// Number of stages of [`step`], and so of coefficient samples per step.
pub const STAGES: usize = 12;

/// Where in a step each stage looks, as a fraction of the step.
pub const NODES: [f64; STAGES] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    1.0 / 3.0,
    0.25,
    4.0 / 13.0,
    127.0 / 195.0,
    0.6,
    6.0 / 7.0,
    1.0,
];

/// Weights of the stages in the result.
pub const WEIGHTS: [f64; STAGES] = [
    0.054293734116568765,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    0.3111643669578199,
    -0.1521609496625161,
    0.20136540080403034,
    0.04471061572777259,
];

/// `y + h (c_0 k_0 + c_1 k_1 + ...)` with the terms named; every lane alike.
macro_rules! combine {
    ($y:expr, $h:expr, $($c:literal * $k:expr),+ $(,)?) => {{
        let mut out = *$y;
        for (i, row) in out.iter_mut().enumerate() {
            for (l, value) in row.iter_mut().enumerate() {
                *value += $h * (0.0 $(+ $c * $k[i][l])+);
            }
        }
        out
    }};
}

/// One step of size `h` from `y`; `rhs(stage, state)` is the right-hand side at the stage's place.
#[inline(always)]
pub fn step<const N: usize, const W: usize>(
    y: &State<N, W>,
    h: f64,
    mut rhs: impl FnMut(usize, &State<N, W>) -> State<N, W>,
) -> State<N, W> {
    let k0 = rhs(0, y);
    let k1 = rhs(1, &combine!(y, h, 0.05260015195876773 * k0));
    let k2 = rhs(2, &combine!(y, h, 0.0197250569845379 * k0, 0.0591751709536137 * k1));
    let k3 = rhs(3, &combine!(y, h, 0.02958758547680685 * k0, 0.08876275643042054 * k2));
    let k4 = rhs(
        4,
        &combine!(y, h, 0.2413651341592667 * k0, -0.8845494793282861 * k2, 0.924834003261792 * k3),
    );
    let k5 = rhs(
        5,
        &combine!(y, h, 0.037037037037037035 * k0, 0.17082860872947386 * k3, 0.12546768756682242 * k4),
    );
    let k6 = rhs(
        6,
        &combine!(y, h, 0.037109375 * k0, 0.17025221101954405 * k3, 0.06021653898045596 * k4, -0.017578125 * k5),
    );
    let k7 = rhs(
        7,
        &combine!(
            y,
            h,
            0.03709200011850479 * k0,
            0.17038392571223998 * k3,
            0.10726203044637328 * k4,
            -0.015319437748624402 * k5,
            0.008273789163814023 * k6,
        ),
    );
    let k8 = rhs(
        8,
        &combine!(
            y,
            h,
            0.6241109587160757 * k0,
            -3.3608926294469414 * k3,
            -0.868219346841726 * k4,
            27.59209969944671 * k5,
            20.154067550477894 * k6,
            -43.48988418106996 * k7,
        ),
    );
    let k9 = rhs(
        9,
        &combine!(
            y,
            h,
            0.47766253643826434 * k0,
            -2.4881146199716677 * k3,
            -0.590290826836843 * k4,
            21.230051448181193 * k5,
            15.279233632882423 * k6,
            -33.28821096898486 * k7,
            -0.020331201708508627 * k8,
        ),
    );
    let k10 = rhs(
        10,
        &combine!(
            y,
            h,
            -0.9371424300859873 * k0,
            5.186372428844064 * k3,
            1.0914373489967295 * k4,
            -8.149787010746927 * k5,
            -18.52006565999696 * k6,
            22.739487099350505 * k7,
            2.4936055526796523 * k8,
            -3.0467644718982196 * k9,
        ),
    );
    let k11 = rhs(
        11,
        &combine!(
            y,
            h,
            2.273310147516538 * k0,
            -10.53449546673725 * k3,
            -2.0008720582248625 * k4,
            -17.9589318631188 * k5,
            27.94888452941996 * k6,
            -2.8589982771350235 * k7,
            -8.87285693353063 * k8,
            12.360567175794303 * k9,
            0.6433927460157636 * k10,
        ),
    );
    combine!(
        y,
        h,
        0.054293734116568765 * k0,
        4.450312892752409 * k5,
        1.8915178993145003 * k6,
        -5.801203960010585 * k7,
        0.3111643669578199 * k8,
        -0.1521609496625161 * k9,
        0.20136540080403034 * k10,
        0.04471061572777259 * k11,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y' = -2 s y², y(0) = 1 has y = 1/(1 + s²).
    fn integrate(steps: usize) -> f64 {
        let h = 1.0 / steps as f64;
        let mut y: State<1, 1> = [[1.0]];
        for i in 0..steps {
            y = step(&y, h, |stage, y| [[-2.0 * (i as f64 + NODES[stage]) * h * y[0][0] * y[0][0]]]);
        }
        y[0][0]
    }

    #[test]
    fn converges_with_order_eight() {
        let error = |steps| (integrate(steps) - 0.5_f64).abs();
        let order = (error(4) / error(8)).log2();
        assert!(order > 7.5, "observed order {order}");
    }

    #[test]
    fn nodes_and_weights_integrate_polynomials_exactly_up_to_order_eight() {
        for power in 0..8 {
            let sum: f64 = (0..STAGES).map(|i| WEIGHTS[i] * NODES[i].powi(power)).sum();
            assert!((sum - 1.0 / f64::from(power + 1)).abs() < 2e-15, "power {power}");
        }
    }
}
