//! Frames and beams that snap, by Taylor series ([`crate::planar`]) along curves of equilibria ([`crate::path`]).

use crate::path::{Curve, PathError};
use crate::planar::{Beam, Body, End, Mechanism, curve};
use crate::taylor::{Section, Station};
use std::f64::consts::{FRAC_PI_2, PI};

/// Lee's frame at one equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedFrame {
    /// The load, downwards.
    pub load: f64,
    /// What the point under it has come down.
    pub down: f64,
    /// What it has moved to the right, away from the column.
    pub right: f64,
    /// What it has turned, counterclockwise, rad.
    pub angle: f64,
}

/// Where the path of Lee's frame turns, in the order in which it is met.
#[derive(Clone, Debug)]
pub struct FrameFolds {
    /// Greatest and least load.
    pub load: Vec<LoadedFrame>,
    /// Greatest and least drop between them: the snap-back.
    pub down: Vec<LoadedFrame>,
    /// Greatest motion to the right.
    pub right: Vec<LoadedFrame>,
}

/// Lee's frame: a column and a beam of the length 120, rigidly joined, their other ends hinged; a dead load on the beam at a
/// fifth of its length from the corner. E = 720, A = 6, I = 2, so that P L²/EI = 10 P.
///
/// The path is followed past all the folds, until the load has come back to 0.5. (S. L. Lee, F. S. Manuel and E. C. Rossow,
/// *J. Eng. Mech. Div. ASCE* 94 (1968) EM2, 521, inextensible; with stretch K. H. Schweizerhof and P. Wriggers, *Comput. Methods
/// Appl. Mech. Eng.* 59 (1986) 261.)
///
/// # Errors
/// Newton's method fails.
pub fn lees_frame() -> Result<FrameFolds, PathError> {
    let curve = Curve::new(vec![1.0, 1.0, 1.0, 1.0, 120.0, 120.0], |y| {
        let [point, end] = carry_frame(y);
        vec![
            (end[0] - 120.0) / 120.0,
            (end[1] - 120.0) / 120.0,
            end[3] / 12.0,
            (120.0 - point[1] - y[DOWN]) / 120.0,
            (point[0] - 24.0 - y[RIGHT]) / 120.0,
        ]
    });
    let start = [FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0];
    let path = curve.trace(&start, LOAD, 0.4, |y| y[LOAD] > 0.5 && y[DOWN] > 80.0)?;
    let state = |y: &Vec<f64>| LoadedFrame {
        load: y[LOAD],
        down: y[DOWN],
        right: y[RIGHT],
        angle: carry_frame(y)[0][2],
    };
    let folds = |turning: usize| -> Result<Vec<LoadedFrame>, PathError> {
        Ok(curve.folds(&path, turning)?.iter().map(state).collect())
    };
    Ok(FrameFolds { load: folds(LOAD)?, down: folds(DOWN)?, right: folds(RIGHT)? })
}

// The unknowns of Lee's frame: the column's angle at its foot, the force there, the load, the motion of its point.
const LOAD: usize = 3;
const DOWN: usize = 4;
const RIGHT: usize = 5;

/// The stations of Lee's frame under the load and at the far hinge, from the foot of the column.
fn carry_frame(y: &[f64]) -> [Station; 2] {
    let member = Section { bending: 1440.0, stretch: 1.0 / 4320.0, ..Section::unit() };
    let mut corner = member.carry([0.0, 0.0, y[0], 0.0, y[1], y[2]], 120.0, 24);
    corner[2] -= FRAC_PI_2;
    let point = member.carry(corner, 24.0, 6);
    let mut beyond = point;
    beyond[5] += y[LOAD];
    [point, member.carry(beyond, 96.0, 20)]
}

/// An inclined beam between a clamp and a shuttle that is led across, half of a bistable mechanism.
#[derive(Clone, Copy, Debug)]
pub struct Bistable {
    /// Length.
    pub length: f64,
    /// The beam's rise against the shuttle's way, rad.
    pub slope: f64,
    /// EI.
    pub bending: f64,
    /// 1/EA.
    pub stretch: f64,
}

/// The shuttle at one equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shuttle {
    /// How far it has been led.
    pub travel: f64,
    /// The force that takes.
    pub force: f64,
}

/// Where a given force would snap, and where none is needed.
#[derive(Clone, Debug)]
pub struct Snap {
    /// Greatest and least force.
    pub folds: Vec<Shuttle>,
    /// The places without force past rest: unstable, then stable.
    pub zeros: Vec<Shuttle>,
}

impl Bistable {
    /// The beam of `bistable_beam.toml`: 50 mm at 5°, 0.6 x 8 mm, 1.4 GPa; metres and newtons.
    pub fn polypropylene() -> Self {
        let (young, width, height) = (1.4e9, 0.6e-3, 8e-3);
        Self {
            length: 50e-3,
            slope: PI / 36.0,
            bending: young * height * width * width * width / 12.0,
            stretch: 1.0 / (young * width * height),
        }
    }

    /// The folds and the places without force until the shuttle has been led by `travel`.
    ///
    /// # Errors
    /// Newton's method fails.
    pub fn snap(&self, travel: f64) -> Result<Snap, PathError> {
        let (s, c) = self.slope.sin_cos();
        let (x, y) = (self.length * c, self.length * s);
        let Self { length, slope, bending, stretch } = *self;
        let at = move |force: f64| Mechanism {
            beams: vec![Beam {
                length,
                bending,
                stretch,
                curvature: 0.0,
                start: End::clamp(None, [0.0, 0.0, slope]),
                end: End::clamp(Some(0), [0.0, 0.0, slope]),
            }],
            bodies: vec![Body {
                rest: [x, y, 0.0],
                held: [Some(x), None, Some(0.0)],
                load: [0.0, -force, 0.0],
            }],
        };
        let (curve, start) = curve(at, bending / (length * length));
        let force = start.len() - 1;
        let shuttle = |at: &[f64]| Shuttle { travel: y - at[1], force: at[force] };
        let path = curve.trace(&start, force, 3.0, |at| y - at[1] > travel)?;
        let folds = curve.folds(&path, force)?.iter().map(|at| shuttle(at)).collect();
        let mut zeros = Vec::new();
        for pair in path.windows(2).filter(|pair| pair[0].at[force] * pair[1].at[force] < 0.0) {
            let (a, b, leading) = (&pair[0].at, &pair[1].at, pair[0].leading);
            zeros.push(shuttle(&curve.where_zero(a, b, leading, |at| at[force])?));
        }
        Ok(Snap { folds, zeros })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close;
    use crate::ivp::integrate;

    #[test]
    fn lees_frame_has_the_same_folds_as_a_mechanism_of_bodies() {
        let member = |length: f64, start: End, end: End| Beam {
            length,
            bending: 1440.0,
            stretch: 1.0 / 4320.0,
            curvature: 0.0,
            start,
            end,
        };
        let hinge = |place: [f64; 3]| End { body: None, place, hinged: true };
        let clamp = |body: usize, angle: f64| End::clamp(Some(body), [0.0, 0.0, angle]);
        let at = move |load: f64| Mechanism {
            beams: vec![
                member(120.0, hinge([0.0, 0.0, FRAC_PI_2]), clamp(0, FRAC_PI_2)),
                member(24.0, clamp(0, 0.0), clamp(1, 0.0)),
                member(96.0, clamp(1, 0.0), hinge([120.0, 120.0, 0.0])),
            ],
            bodies: vec![
                Body { rest: [0.0, 120.0, 0.0], held: [None; 3], load: [0.0; 3] },
                Body { rest: [24.0, 120.0, 0.0], held: [None; 3], load: [0.0, -load, 0.0] },
            ],
        };
        let (curve, start) = curve(at, 1.0);
        let load = start.len() - 1;
        let path = curve.trace(&start, load, 16.0, |y| y[load] < 1.0 && y[4] < 70.0).unwrap();
        let mechanism = &curve.folds(&path, load).unwrap()[0];
        let frame = lees_frame().unwrap();
        assert_eq!([frame.load.len(), frame.down.len(), frame.right.len()], [2, 2, 1]);
        assert_close(frame.load[0].load, mechanism[load], 1e-13, "greatest load");
        assert_close(frame.load[0].down, 120.0 - mechanism[4], 1e-9, "down");
        assert_close(frame.load[0].right, mechanism[3] - 24.0, 1e-9, "right");
        assert_close(frame.load[0].angle, mechanism[5], 1e-11, "angle");
        // The snap-back: down to the first turn, up to the second, where the load is negative.
        assert_close(frame.down[0].down, 61.002_978_851, 5e-10, "first turn");
        assert_close(frame.down[1].down, 50.746_251_363, 5e-10, "second turn");
        assert_close(frame.load[1].load, -0.941_443_156, 5e-10, "least load");
    }

    #[test]
    fn the_bistable_beam_has_the_same_folds_by_extrapolation() {
        let beam = Bistable::polypropylene();
        let found = beam.snap(7.2e-3).unwrap();
        assert_eq!([found.folds.len(), found.zeros.len()], [2, 2]);
        let (s, c) = beam.slope.sin_cos();
        let unit = beam.bending / beam.length.powi(2);
        // Forces in EI/L², moment in EI/L, lengths in L: (Fx, Fy, M, travel).
        let slack = beam.stretch * unit;
        let end = |y: &[f64]| {
            let rates = |_: f64, at: &[f64; 4]| {
                let (sine, cosine) = at[2].sin_cos();
                let length = 1.0 + slack * (y[0] * cosine + y[1] * sine);
                let (dx, dy) = (length * cosine, length * sine);
                [dx, dy, at[3], dy * y[0] - dx * y[1]]
            };
            integrate(rates, [0.0, 0.0, beam.slope, y[2]], 0.0, 1.0, 32)[32].1
        };
        let curve = Curve::new(vec![1.0, 1.0, 1.0, 1.0], |y| {
            let at = end(y);
            vec![at[0] - c, at[2] - beam.slope, at[1] - (s - y[3])]
        });
        let start = [0.0; 4];
        for fold in &found.folds {
            let near = curve.lead(&start, 3, 0.97 * fold.travel / beam.length, 20).unwrap();
            let past = curve.lead(&near, 3, 1.03 * fold.travel / beam.length, 2).unwrap();
            let same = curve.fold(&near, &past, 3, 1).unwrap();
            assert_close(-same[1] * unit, fold.force, 1e-11, "force");
            assert_close(same[3] * beam.length, fold.travel, 1e-12, "travel");
        }
    }
}
