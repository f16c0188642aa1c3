//! What a person reads of natural modes.

use crate::quantity::{number, quantity, size};
use crate::screen::{BAD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::model::Model;
use flexura::solution::{Mode, ModeKind, Modes, Status};

/// The summary as text.
pub fn render(model: &Model, modes: &Modes) -> String {
    let name = title(&model.name);
    let solution = &modes.solution;
    let state = match solution.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &status.word().replace('_', " ")),
    };
    let about = if modes.at_rest { "about the state at rest" } else { "about the equilibrium" };
    let stability = match solution.stable {
        Some(true) => ", stable",
        Some(false) => ", unstable",
        None => "",
    };
    let [elements, order] = modes.elements;
    let cut = if elements > 0 { format!(", {elements} elements of order {order}") } else { String::new() };
    let mut text = format!("{name}: {state}\n  {}\n", styled(DIM, &format!("{about}{stability}{cut}")));
    if solution.status != Status::Converged {
        return text;
    }
    if modes.modes.is_empty() {
        return text + "\nthere are no modes\n";
    }
    let is_damped = modes.modes.iter().any(|mode| mode.damping_ratio.is_some());
    let mut table = Table::new(&[
        "modes",
        "frequency",
        "period or rate",
        "generalised mass",
        if is_damped { "damping ratio" } else { "effective mass x, y, z" },
        "relative error",
    ]);
    for (i, mode) in modes.modes.iter().enumerate() {
        table.row(row(i, mode, &modes.mass));
    }
    text += &format!("\n{}", table.render());
    let rigid = modes.modes.iter().filter(|mode| mode.is_rigid()).count();
    if rigid > 0 {
        let motions = if rigid == 1 { "motion is" } else { "motions are" };
        text += &format!("\n{rigid} {motions} without stiffness: nothing holds the mechanism against them\n");
    }
    text
}

fn row(i: usize, mode: &Mode, whole: &[f64; 3]) -> Vec<String> {
    let (frequency, rate) = match mode.kind {
        ModeKind::Rigid => ("without stiffness".to_owned(), String::new()),
        ModeKind::Diverging => ("grows".to_owned(), quantity(mode.growth, "1/s", 6)),
        ModeKind::Flutter => {
            (format!("{}, flutter", hertz(mode)), format!("grows {}", quantity(mode.growth, "1/s", 6)))
        }
        ModeKind::Creeping => ("creeps back".to_owned(), quantity(-mode.growth, "1/s", 6)),
        ModeKind::Decaying => (hertz(mode), format!("decays {}", quantity(-mode.growth, "1/s", 6))),
        ModeKind::Swinging => {
            (hertz(mode), mode.frequency().map_or(String::new(), |f| quantity(1.0 / f, "s", 5)))
        }
    };
    let turns = mode
        .direction
        .beams
        .iter()
        .flatten()
        .chain(&mode.direction.bodies)
        .all(|twist| twist.linear.norm() < 1e-6);
    let mass = quantity(mode.generalised_mass, if turns { "kg*m^2" } else { "kg" }, 5);
    let ratio = mode.damping_ratio.map(|ratio| number(ratio, 6));
    let shares = mode.shares.as_ref().map_or(String::new(), |own| {
        let part = |axis: usize| match own.effective[axis] / whole[axis] {
            part if part.is_finite() && part >= 5e-5 => format!("{} %", number(100.0 * part, 4)),
            _ => "-".to_owned(),
        };
        (0..3).map(part).collect::<Vec<_>>().join(", ")
    });
    vec![(i + 1).to_string(), frequency, rate, mass, ratio.unwrap_or(shares), size(mode.error_estimate)]
}

fn hertz(mode: &Mode) -> String {
    mode.frequency().map_or(String::new(), |frequency| quantity(frequency, "Hz", 8))
}
