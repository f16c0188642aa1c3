//! What a person reads after an optimisation.

use crate::quantity::{number, quantity, size};
use crate::screen::{BAD, DIM, GOOD, styled, title};
use crate::table::Table;
use flexura::Optimised;
use flexura::model::{Condition, Output, Where};
use flexura::output::bound_name;
use flexura::solution::{Active, Bound, Design, Status};

/// Significant digits.
const DIGITS: usize = 6;
/// Most designs that are listed of those left out, and most searches.
const MOST_LEFT_OUT: usize = 5;
const MOST_STARTS: usize = 20;

/// The summary as text.
pub fn render(optimised: &Optimised) -> String {
    let result = &optimised.result;
    let state = match result.status {
        Status::Converged => styled(GOOD, "converged"),
        status => styled(BAD, &status.word().replace('_', " ")),
    };
    let work = result.work;
    let paths = if work.paths > 0 { format!(", {} paths", work.paths) } else { String::new() };
    let about = format!(
        "{} by {}, {} of {} searches converged, {} steps, {} designs{paths}",
        if optimised.study.maximise { "greatest" } else { "least" },
        optimised.study.method.word(),
        result.starts.iter().filter(|start| start.status == Status::Converged).count(),
        result.starts.len(),
        work.iterations,
        work.evaluations
    );
    let mut text = format!("{}: {state}\n  {}\n", title(&optimised.model.name), styled(DIM, &about));
    if let Some(best) = &result.best {
        text += &parameters(optimised, best);
        text += &results(optimised, best);
    }
    text + &starts(optimised) + &front(optimised) + &left_out(optimised)
}

fn parameters(optimised: &Optimised, best: &Design) -> String {
    let heading = if optimised.result.status == Status::Infeasible { "nearest design" } else { "optimum" };
    let mut table = Table::new(&[heading, "value", "range", "held by", "objective per unit"]);
    for (i, (varied, value)) in optimised.study.vary.iter().zip(&best.values).enumerate() {
        let parameter = &optimised.model.parameters[varied.parameter];
        let shown = |value: f64, digits: usize| quantity(value, &parameter.unit, digits);
        let [low, high] = varied.range;
        let name = &parameter.name;
        let mut row =
            vec![name.clone(), shown(*value, DIGITS), format!("{} to {}", shown(low, 4), shown(high, 4))];
        row.extend(held(optimised, best, &[Bound::Lower(i), Bound::Upper(i)], &parameter.unit));
        table.row(row);
    }
    format!("\n{}", table.render())
}

/// Which of these bounds is active, and what it costs.
fn held(optimised: &Optimised, best: &Design, bounds: &[Bound], unit: &str) -> Vec<String> {
    let is_one = |active: &&Active| bounds.contains(&active.what);
    let Some(active) = best.active.iter().find(is_one) else { return Vec::new() };
    let bound = bound_name(&optimised.model, &optimised.study, active.what);
    let end = bound.rsplit('.').next().unwrap_or_default().to_owned();
    let over = &optimised.study.objective.output.unit;
    let unit = match (over.as_str(), unit) {
        ("", "") => String::new(),
        (over, "") => over.to_owned(),
        (over, under) if over == under => String::new(),
        (over, under) => {
            let over = if over.is_empty() { "1" } else { over };
            let is_one_word = under.chars().all(char::is_alphabetic);
            if is_one_word { format!("{over}/{under}") } else { format!("{over}/({under})") }
        }
    };
    vec![end, format!("{} {unit}", number(active.rate, 5)).trim_end().to_owned()]
}

fn results(optimised: &Optimised, best: &Design) -> String {
    let mut table = Table::new(&["results", "value", "wanted", "held by", "objective per unit"]);
    let row = |output: &Output, at: &Where, value: f64, wanted: String| {
        vec![named(output, at), quantity(value, &output.unit, DIGITS), wanted]
    };
    let goal = |maximise: bool| if maximise { "greatest" } else { "least" }.to_owned();
    let objective = &optimised.study.objective;
    table.row(row(&objective.output, &objective.at, best.objective, goal(optimised.study.maximise)));
    if let (Some(front), Some(other)) = (&optimised.study.front, best.other) {
        table.row(row(&front.other.output, &front.other.at, other, goal(front.maximise)));
    }
    for (i, (condition, value)) in optimised.study.conditions.iter().zip(&best.conditions).enumerate() {
        let output = &condition.reading.output;
        let mut cells = row(output, &condition.reading.at, *value, wanted(condition));
        let bounds = [Bound::Least(i), Bound::Most(i), Bound::Equals(i)];
        cells.extend(held(optimised, best, &bounds, &output.unit));
        table.row(cells);
    }
    let mut text = format!("\n{}", table.render());
    if best.violation > optimised.study.tolerance {
        text += &format!("\nlargest miss of a constraint: {} of its size\n", size(best.violation));
    }
    text
}

fn named(output: &Output, at: &Where) -> String {
    match at {
        Where::Equilibrium => output.name.clone(),
        Where::Path { study, point, .. } => format!("{} ({} of {study})", output.name, point.text()),
    }
}

fn wanted(condition: &Condition) -> String {
    let unit = &condition.reading.output.unit;
    let bounds = [("at least", condition.least), ("at most", condition.most), ("equal to", condition.equals)];
    let given =
        bounds.iter().filter_map(|(word, bound)| Some(format!("{word} {}", quantity((*bound)?, unit, 6))));
    given.collect::<Vec<_>>().join(", ")
}

fn starts(optimised: &Optimised) -> String {
    let starts = &optimised.result.starts;
    if starts.len() < 2 {
        return String::new();
    }
    let unit = &optimised.study.objective.output.unit;
    let mut table = Table::new(&["searches", "end", "objective", "violation", "steps"]);
    for (i, start) in starts.iter().enumerate() {
        let mut row = vec![(i + 1).to_string(), start.status.word().replace('_', " ")];
        if let Some(end) = &start.design {
            row.push(quantity(end.objective, unit, DIGITS));
            row.push(if end.violation > 0.0 { size(end.violation) } else { "0".to_owned() });
            row.push(start.history.len().saturating_sub(1).to_string());
        }
        table.row(row);
    }
    format!("\n{}", table.shortened(MOST_STARTS).render())
}

fn front(optimised: &Optimised) -> String {
    let Some(front) = optimised.study.front.as_ref().filter(|_| !optimised.result.front.is_empty()) else {
        return String::new();
    };
    let (one, two) = (&optimised.study.objective.output, &front.other.output);
    let mut headings = vec!["front".to_owned(), one.name.clone(), two.name.clone()];
    let varied = || optimised.study.vary.iter().map(|varied| &optimised.model.parameters[varied.parameter]);
    headings.extend(varied().map(|parameter| parameter.name.clone()));
    let mut table = Table::new(&headings.iter().map(String::as_str).collect::<Vec<_>>());
    for (i, point) in optimised.result.front.iter().enumerate() {
        let mut row = vec![(i + 1).to_string(), quantity(point.objective, &one.unit, DIGITS)];
        row.push(point.other.map_or_else(String::new, |other| quantity(other, &two.unit, DIGITS)));
        row.extend(varied().zip(&point.values).map(|(p, value)| quantity(*value, &p.unit, DIGITS)));
        table.row(row);
    }
    format!("\n{}", table.render())
}

fn left_out(optimised: &Optimised) -> String {
    let result = &optimised.result;
    if result.left_out_count == 0 {
        return String::new();
    }
    let mut text = format!("\n{} designs were left out:\n", result.left_out_count);
    for left in result.left_out.iter().take(MOST_LEFT_OUT) {
        let values = optimised.study.vary.iter().zip(&left.values).map(|(varied, value)| {
            let parameter = &optimised.model.parameters[varied.parameter];
            format!("{} = {}", parameter.name, quantity(*value, &parameter.unit, 5))
        });
        text += &format!("  {}: {}\n", values.collect::<Vec<_>>().join(", "), left.reason);
    }
    if result.left_out_count > MOST_LEFT_OUT {
        text += "  the result document has more\n";
    }
    text
}
