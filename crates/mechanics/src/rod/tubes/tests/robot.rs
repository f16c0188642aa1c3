//! One robot of concentric tubes, solved by shooting from the guide to the tip.

use super::*;
use nalgebra::{DMatrix, DVector};

/// A tube of a robot: uniform, from the guide to `reach`.
#[derive(Clone, Copy, Debug)]
pub struct RobotTube {
    pub bending: f64,
    pub torsion: f64,
    pub rest: [f64; 3],
    pub reach: f64,
    pub turn: f64,
    pub back: f64,
}

/// Tubes, tube 1 first, with a dead force on the tip; the guide ends at the origin along x.
#[derive(Clone, Debug)]
pub struct Robot {
    pub tubes: Vec<RobotTube>,
    pub force: [f64; 3],
    /// Steps for each stretch.
    pub steps: usize,
}

/// Lanes: 1..=3 the moment at the guide, 4..=6 torques of tubes 2.. there, 7..=10 turns, 11..=13 the tip's force.
pub const W: usize = 16;

/// What shooting finds.
pub struct Shot {
    /// The states at the guide, at the end of every stretch.
    pub states: Vec<TubeState<W>>,
    /// Moment at the tip, and the torque at the end of each tube beside the first.
    pub residual: Vec<[f64; W]>,
}

impl Robot {
    /// Moment and torques, and the turns and force of the robot itself.
    pub fn parameters(&self, x: &[f64]) -> Vec<f64> {
        x.iter().copied().chain(self.tubes.iter().map(|t| t.turn)).chain(self.force).collect()
    }

    /// The stretches between ends of tubes.
    pub fn pieces(&self) -> Vec<TubePiece> {
        let mut ends: Vec<f64> = self.tubes.iter().map(|t| t.reach).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let mut from = 0.0;
        let mut pieces = Vec::new();
        for end in ends {
            let tube = |t: &RobotTube| Tube { bending: t.bending, torsion: t.torsion, rest: vec![t.rest] };
            let present = |i: usize| self.tubes.get(1 + i).filter(|t| t.reach >= end).map(tube);
            pieces.push(TubePiece {
                length: end - from,
                steps: self.steps,
                first: tube(&self.tubes[0]),
                others: std::array::from_fn(present),
                loads: Vec::new(),
            });
            from = end;
        }
        pieces
    }

    /// Shoots with the moment and torques `x`.
    pub fn shoot(&self, x: &[f64]) -> Shot {
        let mut guide: RodState<W> = RodState::origin();
        guide.force = self.force;
        guide.moment = [x[0], x[1], x[2]];
        let mut torque = [[0.0; W]; OTHERS];
        for i in 0..3 {
            guide.d[6 + i][11 + i] = 1.0;
            guide.d[9 + i][1 + i] = 1.0;
        }
        for i in 0..self.tubes.len() - 1 {
            torque[i][0] = x[3 + i];
            torque[i][4 + i] = 1.0;
        }
        let guided = |i: usize| {
            self.tubes.get(i).map(|t| {
                let mut turn = [0.0; W];
                turn[0] = t.turn;
                turn[7 + i] = 1.0;
                Guided { turn, back: t.back, torsion: t.torsion }
            })
        };
        let others = std::array::from_fn(|i| guided(1 + i));
        let mut state = TubeState::leave_guide(&guide, &guided(0).unwrap(), &others, &torque);
        let mut states = vec![state];
        for piece in self.pieces() {
            advance_tubes(&piece, 1.0, &mut state);
            states.push(state);
        }
        let mut residual = Vec::new();
        for i in 0..3 {
            let mut row = state.rod.d[9 + i];
            row[0] = state.rod.moment[i];
            residual.push(row);
        }
        // Beyond its end the torque of a tube stands still.
        residual.extend_from_slice(&state.torque[..self.tubes.len() - 1]);
        Shot { states, residual }
    }

    /// The tangent of the residual by moment and torques.
    pub fn tangent(&self, shot: &Shot) -> DMatrix<f64> {
        let n = shot.residual.len();
        DMatrix::from_fn(n, n, |i, j| shot.residual[i][1 + j])
    }

    /// The equilibrium near `x`, by Newton's method.
    pub fn solve(&self, x: &[f64]) -> Vec<f64> {
        let mut x = DVector::from_column_slice(x);
        for _ in 0..40 {
            let shot = self.shoot(x.as_slice());
            let residual = DVector::from_iterator(x.len(), shot.residual.iter().map(|r| r[0]));
            let step = self.tangent(&shot).lu().solve(&residual).unwrap();
            x -= &step;
            if step.norm() < 1e-14 {
                return x.as_slice().to_vec();
            }
        }
        panic!("no equilibrium")
    }

    /// The equilibrium reached from straight, unturned tubes by turning and loading them step by step.
    pub fn equilibrium(&self) -> Vec<f64> {
        let mut x = vec![0.0; 2 + self.tubes.len()];
        for i in 1..=8 {
            let part = f64::from(i) / 8.0;
            let mut robot = self.clone();
            robot.force = robot.force.map(|f| f * part);
            robot.tubes.iter_mut().for_each(|t| t.turn *= part);
            x = robot.solve(&x);
        }
        x
    }
}
