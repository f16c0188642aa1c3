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

/// `y + c_0 r_0 + c_1 r_1 + ...` over the rates named by their stage, every lane alike.
macro_rules! combine {
    ($y:expr, $rates:expr, $(($j:literal, $c:literal)),+) => {{
        let mut out = *$y;
        for (i, row) in out.iter_mut().enumerate() {
            for (l, value) in row.iter_mut().enumerate() {
                *value += 0.0 $(+ $c * $rates[$j][i][l])+;
            }
        }
        out
    }};
}

/// A right-hand side. A trait rather than a closure: a closure is compiled for the baseline processor even
/// inside a function that is compiled for AVX2, and would not be inlined there.
pub trait Rate<const N: usize, const W: usize> {
    /// The rate of `state` at the place of stage `stage` in step `step`. Mark it `#[inline(always)]`.
    fn rate(&self, step: usize, stage: usize, state: &State<N, W>) -> State<N, W>;
}

/// Room for the rates of the stages (each times the step).
pub type Workspace<const N: usize, const W: usize> = [State<N, W>; STAGES];

/// An empty workspace.
#[inline(always)]
pub fn workspace<const N: usize, const W: usize>() -> Workspace<N, W> {
    [[[0.0; W]; N]; STAGES]
}

/// Step number `index`, of size `h`, from `y`.
#[inline(always)]
pub fn step<const N: usize, const W: usize>(
    y: &State<N, W>,
    h: f64,
    index: usize,
    system: &impl Rate<N, W>,
    rates: &mut Workspace<N, W>,
) -> State<N, W> {
    // One copy of the right-hand side in a loop: twelve copies would not fit the instruction cache.
    let mut at = *y;
    for stage in 0..STAGES {
        let mut rate = system.rate(index, stage, &at);
        for row in &mut rate {
            for value in row {
                *value *= h;
            }
        }
        rates[stage] = rate;
        at = match stage {
            0 => combine!(y, rates, (0, 0.05260015195876773)),
            1 => combine!(y, rates, (0, 0.0197250569845379), (1, 0.0591751709536137)),
            2 => combine!(y, rates, (0, 0.02958758547680685), (2, 0.08876275643042054)),
            3 => {
                combine!(y, rates, (0, 0.2413651341592667), (2, -0.8845494793282861), (3, 0.924834003261792))
            }
            4 => combine!(
                y,
                rates,
                (0, 0.037037037037037035),
                (3, 0.17082860872947386),
                (4, 0.12546768756682242)
            ),
            5 => combine!(
                y,
                rates,
                (0, 0.037109375),
                (3, 0.17025221101954405),
                (4, 0.06021653898045596),
                (5, -0.017578125)
            ),
            6 => combine!(
                y,
                rates,
                (0, 0.03709200011850479),
                (3, 0.17038392571223998),
                (4, 0.10726203044637328),
                (5, -0.015319437748624402),
                (6, 0.008273789163814023)
            ),
            7 => combine!(
                y,
                rates,
                (0, 0.6241109587160757),
                (3, -3.3608926294469414),
                (4, -0.868219346841726),
                (5, 27.59209969944671),
                (6, 20.154067550477894),
                (7, -43.48988418106996)
            ),
            8 => combine!(
                y,
                rates,
                (0, 0.47766253643826434),
                (3, -2.4881146199716677),
                (4, -0.590290826836843),
                (5, 21.230051448181193),
                (6, 15.279233632882423),
                (7, -33.28821096898486),
                (8, -0.020331201708508627)
            ),
            9 => combine!(
                y,
                rates,
                (0, -0.9371424300859873),
                (3, 5.186372428844064),
                (4, 1.0914373489967295),
                (5, -8.149787010746927),
                (6, -18.52006565999696),
                (7, 22.739487099350505),
                (8, 2.4936055526796523),
                (9, -3.0467644718982196)
            ),
            10 => combine!(
                y,
                rates,
                (0, 2.273310147516538),
                (3, -10.53449546673725),
                (4, -2.0008720582248625),
                (5, -17.9589318631188),
                (6, 27.94888452941996),
                (7, -2.8589982771350235),
                (8, -8.87285693353063),
                (9, 12.360567175794303),
                (10, 0.6433927460157636)
            ),
            _ => combine!(
                y,
                rates,
                (0, 0.054293734116568765),
                (5, 4.450312892752409),
                (6, 1.8915178993145003),
                (7, -5.801203960010585),
                (8, 0.3111643669578199),
                (9, -0.1521609496625161),
                (10, 0.20136540080403034),
                (11, 0.04471061572777259)
            ),
        };
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Quotient {
        h: f64,
    }

    impl Rate<1, 1> for Quotient {
        fn rate(&self, step: usize, stage: usize, y: &State<1, 1>) -> State<1, 1> {
            [[-2.0 * (step as f64 + NODES[stage]) * self.h * y[0][0] * y[0][0]]]
        }
    }

    /// y' = -2 s y², y(0) = 1 has y = 1/(1 + s²).
    fn integrate(steps: usize) -> f64 {
        let h = 1.0 / steps as f64;
        let mut y: State<1, 1> = [[1.0]];
        for i in 0..steps {
            y = step(&y, h, i, &Quotient { h }, &mut workspace());
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
