//! Concentric tubes, from a model file to the answer.

use crate::{Case, Row};
use flexura::modelfile::Document;
use flexura::solution::{Solution, Status};
use flexura::{Options, solve};
use flexura_testkit::tubes::TwoTubes;

pub const CASES: [Case; 2] = [
    Case {
        id: "two_tubes",
        title: "Two concentric tubes of constant rest curvature, turned against each other by up to 160°: their angle \
                and torque all along",
        citation: "the pendulum's elliptic functions (P. E. Dupont et al., *IEEE Trans. Robotics* 26 (2010) 209-225)",
        needed: "1e-9",
        run: two,
        closed_form: None,
    },
    Case {
        id: "one_tube",
        title: "One tube of rest curvature under a tip force, as concentric tubes and as a beam",
        citation: "the beam's solution, from another part of the program",
        needed: "1e-9 L",
        run: one,
        closed_form: None,
    },
];

const LENGTH: f64 = 0.09;
const EI: [f64; 2] = [4e-3, 7e-3];
const GJ: [f64; 2] = [3.1e-3, 5.4e-3];
const CURVATURE: [f64; 2] = [14.0, 9.0];

fn sections() -> String {
    let each = |name: &str, i: usize| {
        format!(
            "[section.{name}]\nshape = \"stiffness\"\nEA = \"inf\"\nGJ = {}\nEI2 = {}\nEI3 = {}\n",
            GJ[i], EI[i], EI[i]
        )
    };
    format!("format = 1\n{}{}", each("inner", 0), each("outer", 1))
}

fn solved(text: &str) -> Result<Solution, String> {
    let document = Document::parse(text, "tubes.toml").map_err(|report| report.render(false))?;
    let model = document.model(&[]).map_err(|report| report.render(false))?;
    let options = Options { tolerance: 1e-11, ..Options::default() };
    let solution = solve(&model, &options, &mut |_| {}).map_err(|error| error.message)?;
    match solution.status {
        Status::Converged => Ok(solution),
        _ => Err(solution.reason.unwrap_or_default()),
    }
}

fn two() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for degrees in [20.0_f64, 90.0, 160.0] {
        let reference = TwoTubes {
            bending: EI,
            torsion: GJ,
            curvature: CURVATURE,
            length: LENGTH,
            tip_angle: degrees.to_radians(),
        };
        let turn = reference.angle(0.0);
        let tube = |name: &str, i: usize, turn: f64| {
            format!(
                "{{ section = \"{name}\", curved = {LENGTH}, curvature = {}, rotation = {turn:e} }}",
                CURVATURE[i]
            )
        };
        let text = format!(
            "{}[tubes.robot]\nbase = {{ body = \"ground\" }}\ntube = [{}, {}]\n",
            sections(),
            tube("inner", 0, 0.0),
            tube("outer", 1, turn)
        );
        let solution = solved(&text)?;
        let (mut angle, mut torque) = (0.0_f64, 0.0_f64);
        let soft = 1.0 / GJ[0] + 1.0 / GJ[1];
        for sample in &solution.tubes[0].samples {
            let here = sample.angles.iter().find(|(i, _)| *i == 1).map_or(f64::NAN, |(_, a)| *a);
            angle = angle.max((here - reference.angle(sample.s)).abs());
            // θ' = m/GJ_2 - (-m)/GJ_1, as the torques of the two balance.
            let m = sample.torques.iter().find(|(i, _)| *i == 1).map_or(f64::NAN, |(_, m)| *m);
            torque = torque.max((m * soft - reference.twist(sample.s)).abs() * LENGTH);
        }
        rows.push(Row::vanishing(format!("angle at {degrees}°, rad"), angle, 1e-9));
        rows.push(Row::vanishing(format!("torque at {degrees}°, as twist over the length"), torque, 1e-9));
    }
    Ok(rows)
}

fn one() -> Result<Vec<Row>, String> {
    let force = "force = [0, \"-0.4 N\", \"0.7 N\"]";
    let tubes = format!(
        "{}[tubes.robot]\nbase = {{ body = \"ground\", at = [0.01, 0.02, 0], rotation = {{ axis = [0, 0, 1], angle = \"25 deg\" }} }}\n{force}\ntube = [{{ section = \"inner\", curved = {LENGTH}, curvature = 14, rotation = \"40 deg\" }}]\n",
        sections()
    );
    let beam = format!(
        "{}[body.unused]\n[joint.weld]\nkind = \"weld\"\nparent = \"ground\"\nchild = \"unused\"\n[beam.tube]\nsection = \"inner\"\nextension = false\nstart = {{ body = \"ground\", hold = \"clamp\", at = [0.01, 0.02, 0], rotation = {{ quat_wxyz = {} }} }}\n[beam.tube.curve]\nkind = \"arc\"\nradius = {:e}\nangle = {:e}\n[load.tip]\nbeam = \"tube\"\nat = 1\n{force}\n",
        sections(),
        turned(),
        1.0 / 14.0,
        14.0 * LENGTH
    );
    let (tubes, beam) = (solved(&tubes)?, solved(&beam)?);
    let tip = tubes.tubes[0].samples.last().ok_or("no samples")?;
    let end = beam.beams[0].samples.last().ok_or("no samples")?;
    let off = (tip.pose.position - end.pose.position).norm() / LENGTH;
    let turned = tip.pose.rotation.angle_to(&end.pose.rotation);
    let start = (tubes.tubes[0].samples[0].wrench.moment - beam.beams[0].samples[0].wrench.moment).norm();
    Ok(vec![
        Row::vanishing("tip, over the length and rad", off.max(turned), 1e-9),
        Row::vanishing("moment at the guide, in EI/L", start * LENGTH / EI[0], 1e-9),
        Row::vanishing("strain energy, relative", (tubes.energy - beam.energy).abs() / beam.energy, 1e-9),
    ])
}

/// 25° about z, then 40° about the axis.
fn turned() -> String {
    let (a, b) = (12.5_f64.to_radians(), 20_f64.to_radians());
    let (w, x, y, z) = (a.cos() * b.cos(), a.cos() * b.sin(), a.sin() * b.sin(), a.sin() * b.cos());
    format!("[{w:?}, {x:?}, {y:?}, {z:?}]")
}
