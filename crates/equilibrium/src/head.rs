//! The first segment of a span, with its derivatives along the unknowns that its start depends on.
//!
//! Nodes and coordinates act through the start's pose alone. So the kernel carries at most the derivatives along
//! the six motions of that pose and the six numbers of the wrench, and the rest is their combination. Where nothing along
//! the segment has a direction of its own (no dead load, no foundation), not even the motions are carried: a rod that is moved
//! with its wrench moves as a whole, so the change with the wrench standing still is the rigid motion less what turning
//! the wrench does. A tendon goes with its sections, and its length does not change when they move as a whole.

use crate::held::Held;
use crate::mesh::Stretch;
use crate::shooting::{Acting, Column, MAX_COLUMNS, SegmentEnd, carry_columns, plain};
use crate::system::Equilibrium;
use flexura_spatial::{Twist, Vector3, Wrench};

type V = Vector3<f64>;

impl Equilibrium {
    /// Carries the first segment of a span: `end` holds its state and its derivatives along the head unknowns.
    pub(crate) fn carry_head(
        &self,
        span: usize,
        held: &Held,
        wrench: &Wrench,
        segment: &[Stretch],
        acting: &Acting<'_>,
        end: &mut SegmentEnd,
    ) {
        let jumps = acting.jumps;
        let first = &self.meshes[span].first_jumps;
        let wrenches = self.layout.spans[span].wrench.count;
        let motions = held.motions();
        let start = plain(&held.target, wrench);
        if motions == 0 {
            end.seed(12 - wrenches);
            carry_columns(segment, acting, first, &start, end);
            return;
        }
        let dead = |list: &[usize]| list.iter().any(|&j| jumps[j].load.dead != Wrench::zero());
        let directed = dead(first)
            || segment.iter().any(|stretch| {
                let loads = &stretch.piece.loads;
                stretch.piece.foundation.is_some()
                    || dead(&stretch.jumps)
                    || loads.iter().any(|l| l.dead_force != [0.0; 3] || l.dead_moment != [0.0; 3])
            });
        let mut columns = [[0.0; 12]; MAX_COLUMNS];
        let mut lengths = vec![[0.0; 1 + MAX_COLUMNS]; acting.pulls.len()];
        let carried = if directed { 12 } else { 6 };
        if directed {
            end.seed(0);
            carry_columns(segment, acting, first, &start, end);
            for (i, column) in columns.iter_mut().enumerate().take(motions) {
                let motion = held.motion(i);
                let twist = [motion.angular, motion.linear];
                *column = combine(&end.columns[..6], |k| twist[k / 3][k % 3]);
                for (to, from) in lengths.iter_mut().zip(&end.lengths) {
                    to[1 + i] = (0..6).map(|k| from[1 + k] * twist[k / 3][k % 3]).sum();
                }
            }
        } else {
            end.seed(6);
            carry_columns(segment, acting, first, &start, end);
            let state = &end.state;
            let (reach, force, moment) =
                (V::from(state.position) - held.target.position, V::from(state.force), V::from(state.moment));
            for (i, column) in columns.iter_mut().enumerate().take(motions) {
                let Twist { angular, linear } = held.motion(i);
                let back = [-angular.cross(&wrench.force), -angular.cross(&wrench.moment)];
                *column = combine(&end.columns[..6], |k| back[k / 3][k % 3]);
                for (to, from) in lengths.iter_mut().zip(&end.lengths) {
                    to[1 + i] = (0..6).map(|k| from[1 + k] * back[k / 3][k % 3]).sum();
                }
                let rigid =
                    [angular, linear + angular.cross(&reach), angular.cross(&force), angular.cross(&moment)];
                for (k, value) in column.iter_mut().enumerate() {
                    *value += rigid[k / 3][k % 3];
                }
            }
        }
        // Of a wrench whose force is known only the moment is an unknown; it stands last, before the tensions.
        let kept = carried - wrenches..end.count;
        end.count = motions + kept.len();
        columns[motions..end.count].copy_from_slice(&end.columns[kept.clone()]);
        end.columns[..end.count].copy_from_slice(&columns[..end.count]);
        for (to, from) in lengths.iter_mut().zip(&end.lengths) {
            to[0] = from[0];
            to[1 + motions..=end.count].copy_from_slice(&from[1 + kept.start..=kept.end]);
        }
        end.lengths = lengths;
    }
}

fn combine(columns: &[Column], factor: impl Fn(usize) -> f64) -> Column {
    let mut sum = [0.0; 12];
    for (k, column) in columns.iter().enumerate() {
        let factor = factor(k);
        if factor != 0.0 {
            for (to, from) in sum.iter_mut().zip(column) {
                *to += factor * from;
            }
        }
    }
    sum
}
