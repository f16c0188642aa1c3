//! Tension against stretch x = ℓ - ℓ0 or strain ε = x/ℓ0.

use super::table::MonotoneTable;
use std::sync::Arc;

/// Closer to slack than this part of ℓ0, the side on which a spring is cannot be told.
const ROUND_OFF: f64 = 1e-12;

/// How a spring resists being stretched. All but a linear spring that also pushes, and a table that says otherwise,
/// carry nothing below slack.
#[derive(Clone, Debug, PartialEq)]
pub enum TensionLaw {
    /// T = k x.
    Linear {
        /// k, N/m.
        stiffness: f64,
        /// Nothing for x < 0?
        tension_only: bool,
    },
    /// T = F (exp(k1 ε) - 1 + j)/(1 + ε) with F = A0 k2: stress k2 (exp(k1 ε) - 1 + j) on the area A0/(1 + ε) of
    /// something that keeps its volume. j = 0 is continuous at slack; with j = 1 it jumps there by F.
    Exponential {
        /// F, N.
        force: f64,
        /// k1.
        exponent: f64,
        /// j, between 0 and 1.
        jump: f64,
    },
    /// T = K ε²/(2 ε_t) up to ε_t, then K (ε - ε_t/2): once differentiable (L. Blankevoort, J. H. Kuiper, R. Huiskes and
    /// H. J. Grootenboer, *J. Biomechanics* 24 (1991) 1019, with ε_t = 2 ε_l).
    Toe {
        /// K, N per unit of strain.
        axial_stiffness: f64,
        /// ε_t.
        toe_strain: f64,
    },
    /// T(x) through given points; shared, as laws are copied at every evaluation.
    Table(Arc<MonotoneTable>),
}

/// Tension and its derivative by the length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// T, N.
    pub tension: f64,
    /// dT/dℓ, N/m.
    pub rate: f64,
}

/// Nodes and weights of ten-point Gauss quadrature on [-1, 1]; the rest by symmetry.
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_3),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_1),
];

/// The most panels that an energy is integrated over.
const MOST_PANELS: f64 = 1e4;

impl TensionLaw {
    /// Where the law begins to pull, if there is nothing before.
    fn slack_at(&self) -> Option<f64> {
        match self {
            Self::Linear { tension_only, .. } => tension_only.then_some(0.0),
            Self::Exponential { .. } | Self::Toe { .. } => Some(0.0),
            Self::Table(table) => table.slack_at(),
        }
    }

    /// Is it slack at the stretch `x`?
    pub fn is_slack(&self, x: f64) -> bool {
        self.slack_at().is_some_and(|slack| x < slack)
    }

    /// Tension and derivative at the stretch `x` from `rest_length`. At slack, to round-off, the derivative is that of the
    /// taut side unless `loose`: a mechanism at rest, where every spring is just slack, is held by its springs.
    pub fn pull(&self, x: f64, rest_length: f64, loose: bool) -> Pull {
        if let Some(slack) = self.slack_at() {
            let band = ROUND_OFF * rest_length.abs();
            if x < slack {
                let rate = if loose || x < slack - band { 0.0 } else { self.taut(slack, rest_length).rate };
                return Pull { tension: 0.0, rate };
            }
            if loose && x <= slack + band {
                return Pull { rate: 0.0, ..self.taut(x, rest_length) };
            }
        }
        self.taut(x, rest_length)
    }

    /// The law where it is not slack.
    fn taut(&self, x: f64, rest_length: f64) -> Pull {
        let strain = x / rest_length;
        match self {
            Self::Linear { stiffness, .. } => Pull { tension: stiffness * x, rate: *stiffness },
            Self::Exponential { force, exponent, jump } => {
                let thinner = force / (1.0 + strain);
                let tension = thinner * ((exponent * strain).exp_m1() + jump);
                let steeper = thinner * exponent * (exponent * strain).exp();
                Pull { tension, rate: (steeper - tension / (1.0 + strain)) / rest_length }
            }
            Self::Toe { axial_stiffness, toe_strain } => {
                let (tension, rate) = if strain < *toe_strain {
                    (0.5 * strain * strain / toe_strain, strain / toe_strain)
                } else {
                    (strain - 0.5 * toe_strain, 1.0)
                };
                Pull { tension: axial_stiffness * tension, rate: axial_stiffness * rate / rest_length }
            }
            Self::Table(table) => {
                let (tension, rate, _) = table.at(x);
                Pull { tension, rate }
            }
        }
    }

    /// ∫ T dx from where the tension vanishes. The exponential law has no elementary integral (it is an exponential
    /// integral, Ei); panels of Gauss quadrature give it to round-off.
    pub fn energy(&self, x: f64, rest_length: f64) -> f64 {
        if self.is_slack(x) {
            return 0.0;
        }
        let strain = x / rest_length;
        match self {
            Self::Linear { stiffness, .. } => 0.5 * stiffness * x * x,
            Self::Exponential { force, exponent, jump } => {
                let panels = (0.5 * exponent * strain).max(2.0 * strain).ceil().clamp(1.0, MOST_PANELS);
                let half = 0.5 * strain / panels;
                let mut sum = 0.0;
                for panel in 0..panels as usize {
                    let middle = (2 * panel + 1) as f64 * half;
                    for (node, weight) in GAUSS {
                        for at in [middle - node * half, middle + node * half] {
                            sum += weight * ((exponent * at).exp_m1() + jump) / (1.0 + at);
                        }
                    }
                }
                force * rest_length * half * sum
            }
            Self::Toe { axial_stiffness, toe_strain } => {
                let stored = if strain < *toe_strain {
                    strain.powi(3) / (6.0 * toe_strain)
                } else {
                    0.5 * strain * (strain - toe_strain) + toe_strain * toe_strain / 6.0
                };
                axial_stiffness * rest_length * stored
            }
            Self::Table(table) => table.at(x).2 - table.at(table.relaxed().unwrap_or(0.0)).2,
        }
    }
}
