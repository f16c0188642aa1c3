//! The stiffness of a short stretch of beam in its two end poses, from its transfer map.
//!
//! With x = (turning, shift) of an end and w = (moment, force) of the part beyond on the part before, both in the
//! exponential coordinates of a canonical pair, the map of small changes from start A to end B
//!
//! ```text
//!   x_B = P x_A + Q w_A        w_B = R x_A + S w_A
//! ```
//!
//! is symplectic: PᵀR and QᵀS are symmetric and PᵀS - RᵀQ = I. With D = Q S⁻¹, the compliance of the stretch clamped at A under dead
//! loads at B, its second variation is
//!
//! ```text
//!   E = ½ (x_B - P x_A)ᵀ D⁻¹ (x_B - P x_A) + x_Bᵀ R x_A - ½ x_Aᵀ RᵀP x_A
//! ```
//!
//! D is positive for a stretch that is short enough, but only semidefinite where the beam does not stretch, bend or twist in some
//! way: there a compliance of 10⁻⁸ of the softest is put in its place.

use crate::mesh::Stretch;
use crate::shooting::{Acting, Plain, Pull, SegmentEnd, carry_columns, pose_of};
use flexura_spatial::{Matrix3, Matrix6, Vector3};

type V = Vector3<f64>;

/// The stiffness of one stretch, and what it was found at.
pub(super) struct Form {
    /// Blocks of E: of A with itself, of B with A, of B with itself.
    pub aa: Matrix6<f64>,
    pub ba: Matrix6<f64>,
    pub bb: Matrix6<f64>,
    /// Arc lengths of A and B, m.
    pub s: [f64; 2],
    /// The moments at both ends, in the section's axes.
    pub section_moments: [V; 2],
    /// The state at B, before what jumps there.
    pub end: Plain,
}

/// Compliance, as a part of the softest, of what has none.
const STIFF: f64 = 1e-8;

fn section_moment(state: &Plain) -> V {
    pose_of(state).rotation.inverse() * V::from(state.moment)
}

fn half_hat(v: &[f64; 3]) -> Matrix3<f64> {
    Matrix3::new(0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0) * 0.5
}

impl Form {
    /// Carries a stretch, which may consist of several pieces, from `start`; `soft` is the largest compliance along it. None where
    /// it is not stable by itself.
    pub fn new(
        pieces: &[Stretch],
        soft: f64,
        (load, pulls): (f64, &[Pull]),
        start: &Plain,
        end: &mut SegmentEnd,
    ) -> Option<Self> {
        // Neither a load that keeps its direction nor a foundation goes along when all is moved.
        let directed = pieces.iter().any(|stretch| {
            let loads = &stretch.piece.loads;
            stretch.piece.foundation.is_some()
                || loads.iter().any(|l| l.dead_force != [0.0; 3] || l.dead_moment != [0.0; 3])
        });
        let acting = Acting { jumps: &[], load, pulls };
        let length: f64 = pieces.iter().map(|stretch| stretch.piece.length).sum();
        let s_ends = [pieces.first()?.s[0], pieces.last()?.s[1]];
        let (mut p, mut q) = (Matrix6::zeros(), Matrix6::zeros());
        let (mut r, mut s) = (Matrix6::zeros(), Matrix6::zeros());
        end.seed(if directed { 0 } else { 6 });
        carry_columns(pieces, &acting, &[], start, end);
        // Rows of a column: turning, shift, force, moment; of ours: turning, shift and moment, force.
        let wrenches = &end.columns[end.count - 6..end.count];
        for j in 0..6 {
            let column = &wrenches[(j + 3) % 6];
            for i in 0..6 {
                q[(i, j)] = column[i];
                s[(i, j)] = column[6 + (i + 3) % 6];
            }
        }
        if directed {
            for j in 0..6 {
                for i in 0..6 {
                    p[(i, j)] = end.columns[j][i];
                    r[(i, j)] = end.columns[j][6 + (i + 3) % 6];
                }
            }
        } else {
            // Moved together with its wrench a rod moves as a whole; less what turning the wrench alone does.
            let reach = V::from(end.state.position) - V::from(start.position);
            let (force, moment) = (V::from(start.force), V::from(start.moment));
            for j in 0..3 {
                let mut axis = V::zeros();
                axis[j] = 1.0;
                let mut back = nalgebra::Vector6::zeros();
                back.fixed_rows_mut::<3>(0).copy_from(&-axis.cross(&moment));
                back.fixed_rows_mut::<3>(3).copy_from(&-axis.cross(&force));
                let (mut motion, mut wrench) = (q * back, s * back);
                let rigid = [
                    (axis, axis.cross(&V::from(end.state.moment))),
                    (axis.cross(&reach), axis.cross(&V::from(end.state.force))),
                ];
                for (k, (x, w)) in rigid.iter().enumerate() {
                    for i in 0..3 {
                        motion[3 * k + i] += x[i];
                        wrench[3 * k + i] += w[i];
                    }
                }
                p.set_column(j, &motion);
                r.set_column(j, &wrench);
                p[(3 + j, 3 + j)] = 1.0;
            }
        }
        // From plain changes of the moment to those that belong to exponential coordinates: δM + ½ M × θ.
        let (before, after) = (half_hat(&start.moment), half_hat(&end.state.moment));
        let turned: nalgebra::Matrix6x3<f64> = q.fixed_columns::<3>(0) * before;
        let mut part = p.fixed_columns_mut::<3>(0);
        part -= turned;
        let turned: nalgebra::Matrix6x3<f64> = s.fixed_columns::<3>(0) * before;
        let mut part = r.fixed_columns_mut::<3>(0);
        part -= turned;
        let turned: nalgebra::Matrix3x6<f64> = after * p.fixed_rows::<3>(0);
        let mut part = r.fixed_rows_mut::<3>(0);
        part += turned;
        let turned: nalgebra::Matrix3x6<f64> = after * q.fixed_rows::<3>(0);
        let mut part = s.fixed_rows_mut::<3>(0);
        part += turned;
        // D S = Q, by columns of the transposes.
        let d = s.transpose().lu().solve(&q.transpose())?;
        let least = STIFF * soft * length;
        let d = (d + d.transpose()) * 0.5 + Matrix6::identity() * least;
        let stiffness = d.cholesky()?.inverse();
        let (turned, rp) = (stiffness * p, r.tr_mul(&p));
        Some(Self {
            aa: p.tr_mul(&turned) - (rp + rp.transpose()) * 0.5,
            ba: r - turned,
            bb: stiffness,
            s: s_ends,
            section_moments: [section_moment(start), section_moment(&end.state)],
            end: end.state,
        })
    }
}

#[cfg(test)]
mod tests;
