//! What a person reads after a formula was fitted.

use crate::quantity::{number, size};
use crate::screen::{BAD, DIM, GOOD, styled, title};
use flexura::output::FormulaView;
use flexura::solution::Status;

/// Digits of coefficients on the screen.
const DIGITS: usize = 6;

/// The summary as text.
pub fn render(view: &FormulaView<'_>) -> String {
    let found = view.formula;
    let state = match found.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &status.word().replace('_', " ")),
    };
    let unit = |unit: &str| if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
    let output = format!("{}{}", view.output(), unit(&view.study.unit.text));
    let mut text = format!("{}: {state}\n", title(&view.model.name));
    let about = format!("{} points, {} left out", found.points.len(), found.left_out.len());
    text += &format!("  {}\n", styled(DIM, &about));
    for (i, piece) in found.pieces.iter().enumerate() {
        let [from, to] = piece.range;
        if found.pieces.len() > 1 {
            text += &format!("\nfrom {} to {}\n", number(from, DIGITS), number(to, DIGITS));
        } else {
            text += "\n";
        }
        text += &format!("  {output} = {}\n", view.sum(i, DIGITS));
    }
    text += "\n";
    for ((name, variable), [low, high]) in
        view.variables().iter().zip(&view.study.variables).zip(view.ranges())
    {
        let unit = unit(&variable.unit.text);
        text += &format!("  {name}{unit} from {} to {}\n", number(low, DIGITS), number(high, DIGITS));
    }
    let r_squared = found.r_squared.map_or(String::new(), |r| format!("R² = {r:.8}, "));
    let names = view.variables();
    let at = found.points.get(found.largest.1).map_or(String::new(), |point| {
        let places =
            names.iter().zip(&point.variables).map(|(name, v)| format!("{name} = {}", number(*v, 4)));
        format!(" at {}", places.collect::<Vec<_>>().join(", "))
    });
    text += &format!(
        "\n{r_squared}rms error {}{}, largest error {}{}{at}\n",
        size(found.deviation),
        unit(&view.study.unit.text),
        size(found.largest.0),
        unit(&view.study.unit.text)
    );
    text
}
