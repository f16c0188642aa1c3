//! What a solve says to have ended its way is what the path in a parameter of the load shows: its first fold, or none.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail where it stands")]

mod support;

use flexura::modelfile::Document;
use flexura::solution::{PointKind, Status};
use flexura::{Options, solve};

/// Numbers that look random and repeat (Sebastiano Vigna's splitmix64).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A crown that moves in a plane on two springs and a leaf, pushed down obliquely: it snaps through, or not.
fn mechanism(seed: u64) -> String {
    let mut random = Random(seed);
    let height = random.between(0.15, 0.6);
    let [left, right] = [random.between(-1.3, -0.7), random.between(0.7, 1.3)];
    let [k, l] = [random.between(5.0, 20.0), random.between(5.0, 20.0)];
    let [x, y] = [random.between(-0.3, 0.3), -random.between(0.3, 2.5)];
    let (length, bending) = (random.between(0.5, 1.0), 10.0_f64.powf(random.between(-4.0, -0.7)));
    format!(
        r#"
format = 1
[parameter]
f = 1
[section.leaf]
shape = "stiffness"
EA = 1
GJ = 1
EI2 = 1
EI3 = {bending}
[body.crown]
at = [0, {height}, 0]
[joint.plane]
kind = "planar"
parent = {{ body = "ground", at = [0, {height}, 0] }}
child = "crown"
axis = [0, 0, 1]
[spring.left]
from = {{ body = "ground", at = [{left}, 0, 0] }}
to = {{ body = "crown" }}
stiffness = {k}
[spring.right]
from = {{ body = "ground", at = [{right}, 0, 0] }}
to = {{ body = "crown" }}
stiffness = {l}
[beam.leaf]
section = "leaf"
length = {length}
start = {{ body = "ground", at = [{}, {height}, 0], hold = "clamp" }}
end = {{ body = "crown", hold = "clamp" }}
[load.push]
body = "crown"
force = ["{x}*f", "{y}*f", 0]
[study.path]
kind = "trace"
parameter = "f"
range = [0.001, 1]
"#,
        -length
    )
}

#[test]
fn a_solve_ends_at_the_first_fold_of_the_traced_path_or_at_the_full_load() {
    let (mut folds, mut arrived) = (0, 0);
    for seed in 0..16 {
        let text = mechanism(seed);
        let model =
            Document::parse(&text, "model.toml").unwrap_or_else(|r| panic!("{r}")).model(&[]).unwrap();
        let solution = solve(&model, &Options::default(), &mut |_| {}).unwrap();
        let run = support::run(&text, &[], 1e-8);
        let points = &run.trace.branches[0].points;
        let fold = points.iter().find(|point| point.kind == PointKind::Fold).map(|point| point.parameter);
        match fold {
            None => {
                assert_eq!(solution.status, Status::Converged, "seed {seed}: {:?}", solution.reason);
                let last = points.last().unwrap().solution.as_ref().unwrap().bodies[0].position;
                assert!((last - solution.bodies[0].position).norm() < 1e-6, "seed {seed}");
                arrived += 1;
            }
            Some(fold) => {
                let reason = solution.reason.unwrap_or_default();
                assert!(
                    reason.contains("fold"),
                    "seed {seed}: a fold at {fold}, {:?}: {reason}",
                    solution.status
                );
                assert!(
                    (solution.load_fraction - fold).abs() < 1e-5,
                    "seed {seed}: {} {fold}",
                    solution.load_fraction
                );
                folds += 1;
            }
        }
    }
    assert!(folds >= 3 && arrived >= 3, "{folds} folds, {arrived} arrived");
}
