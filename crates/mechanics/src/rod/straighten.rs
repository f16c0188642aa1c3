//! A piece whose shape is kept while its moments change.

use super::{LawTable, Piece};
use crate::ode::{NODES, STAGES};

impl Piece {
    /// The piece stays as it is bent: the curvature that a change of the section moment would cause is taken out of the rest curvature.
    /// `change` is the change at both ends, in the section's axes; between them it is taken to go in a straight line. Nor does it
    /// stretch: what a change of length does beside bending grows without bound as pieces become short. Couplings of stretching
    /// with bending stay.
    pub fn straighten(&mut self, change: &[[f64; 3]; 2]) {
        let (steps, at) =
            (self.steps, |i: usize| ((i / STAGES) as f64 + NODES[i % STAGES]) / self.steps as f64);
        let moment = |i: usize| -> [f64; 3] {
            std::array::from_fn(|k| change[0][k] + at(i) * (change[1][k] - change[0][k]))
        };
        let stages = steps * STAGES;
        match &mut self.laws {
            LawTable::Slender(laws) => {
                spread(laws, stages);
                for (i, law) in laws.iter_mut().enumerate() {
                    let moment = moment(i);
                    (0..3).for_each(|k| law.k0[k] -= law.bend[k] * moment[k]);
                    law.stretch = 0.0;
                }
            }
            LawTable::Shearable(laws) => {
                spread(laws, stages);
                for (i, law) in laws.iter_mut().enumerate() {
                    let moment = moment(i);
                    (0..3).for_each(|k| law.k0[k] -= law.bend[k] * moment[k]);
                    law.shear[0] = 0.0;
                }
            }
            LawTable::Coupled(laws) => {
                spread(laws, stages);
                for (i, law) in laws.iter_mut().enumerate() {
                    let moment = moment(i);
                    for k in 0..3 {
                        law.k0[k] -= (0..3).map(|j| law.compliance[3 + k][3 + j] * moment[j]).sum::<f64>();
                    }
                }
            }
        }
    }
}

/// One law for every stage.
fn spread<L: Copy>(laws: &mut Vec<L>, stages: usize) {
    if let [law] = laws[..] {
        laws.resize(stages, law);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rod::{RodState, Slender, advance};

    #[test]
    fn a_bent_piece_keeps_its_shape_under_another_moment() {
        let law = Slender { k0: [0.3, -0.2, 0.8], stretch: 0.0, bend: [1.2, 1.0, 0.4] };
        let mut piece = Piece {
            length: 0.3,
            steps: 2,
            laws: LawTable::Slender(vec![law]),
            loads: Vec::new(),
            foundation: None,
        };
        let mut bent = RodState::<1>::origin();
        bent.moment = [0.1, 0.5, -0.4];
        let mut same = bent;
        advance(&piece, 1.0, &mut bent);
        // The moment keeps its direction in space, so its change turns in the section's axes; the axes at the end say how.
        let change = [0.02, -0.03, 0.05];
        let [w, x, y, z] = bent.rotation;
        let q = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        let at_end: [f64; 3] = (q.inverse() * nalgebra::Vector3::from(change)).into();
        piece.straighten(&[change, at_end]);
        (0..3).for_each(|k| same.moment[k] += change[k]);
        advance(&piece, 1.0, &mut same);
        for k in 0..3 {
            assert!((same.position[k] - bent.position[k]).abs() < 2e-5);
        }
        for k in 0..4 {
            assert!((same.rotation[k] - bent.rotation[k]).abs() < 1e-4);
        }
    }
}
