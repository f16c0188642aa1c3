//! A straight rod that its end wrench bends into a helix.

use crate::build::{Stiffness, UNSHEARABLE, cantilever, load_tip};
use crate::measure::{Units, largest_deviation, solve};
use crate::{Case, Estimate, Row};
use flexura_model::{Curve, LoadFrame, Model};
use flexura_spatial::{Pose, Wrench};
use flexura_testkit::helix::HelixByWrench;

pub const CASES: [Case; 1] = [Case {
    id: "helix_by_wrench",
    title: "Straight, stretching rod bent into a helix by its end wrench, dead and follower",
    citation: "closed form: Love, *A Treatise on the Mathematical Theory of Elasticity*, 4th ed., 1927, §§270-271, \
               with the stretch added",
    needed: "1e-9, every pose and wrench",
    run,
    closed_form: Some(estimates),
}];

/// A helix and the axes in which its wrench is given.
struct Bent {
    name: &'static str,
    helix: HelixByWrench,
    frame: LoadFrame,
}

/// Stiffnesses 2.0, 1.6, 50 and length one. A dead wrench is one that the rod follows from rest without
/// a fold; a follower wrench has one equilibrium only, so that many turns are safe.
fn all() -> [Bent; 3] {
    let helix = |bend: f64, torsion: f64, twist: f64| HelixByWrench {
        bending_stiffness: 2.0,
        torsion_stiffness: 1.6,
        axial_stiffness: 50.0,
        bend,
        torsion,
        twist,
    };
    [
        Bent { name: "dead wrench, half a turn", helix: helix(2.6, 1.1, 1.6), frame: LoadFrame::Global },
        // B τ = C k1: no force.
        Bent { name: "dead moment, one turn", helix: helix(5.5, 2.0, 2.5), frame: LoadFrame::Global },
        Bent { name: "follower wrench, three turns", helix: helix(17.0, 6.5, 9.0), frame: LoadFrame::Local },
    ]
}

impl Bent {
    fn stiffness(&self) -> Stiffness {
        let (ei, gj) = (self.helix.bending_stiffness, self.helix.torsion_stiffness);
        Stiffness { ea: self.helix.axial_stiffness, ga: f64::INFINITY, gj, ei2: ei, ei3: ei }
    }

    fn model(&self) -> Model {
        let straight = Curve::Straight { length: 1.0 };
        let mut model = cantilever(self.stiffness().section(), straight, UNSHEARABLE, Pose::identity());
        let mut wrench = self.helix.tip_wrench(1.0);
        if self.frame == LoadFrame::Local {
            wrench = wrench.rotated(&self.helix.pose(1.0).rotation.inverse());
        }
        load_tip(&mut model, wrench.force, wrench.moment, self.frame);
        model
    }

    /// Largest deviation and the solver's estimate.
    fn solve(&self, tolerance: f64) -> Result<(f64, f64), String> {
        let solution = solve(&self.model(), tolerance).map_err(|error| format!("{}: {error}", self.name))?;
        let units = Units { length: 1.0, stiffness: self.stiffness().softest() };
        let exact = |s: f64| (self.helix.pose(s), Wrench::new(self.helix.force(), self.helix.moment(s)));
        Ok((largest_deviation(&solution.beams[0], &units, &exact), solution.error_estimate))
    }
}

fn run() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for bent in all() {
        let (off, estimate) = bent.solve(1e-10)?;
        let what = format!("all poses and wrenches, scaled, {}", bent.name);
        rows.push(Row::vanishing(what, off, 1e-9).with_estimate(estimate));
    }
    Ok(rows)
}

fn estimates(tolerance: f64) -> Result<Vec<Estimate>, String> {
    all()
        .iter()
        .map(|bent| {
            let (error, estimate) = bent.solve(tolerance)?;
            Ok(Estimate { what: bent.name.to_string(), error, estimate })
        })
        .collect()
}
