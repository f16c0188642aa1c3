//! `beams.csv`: one row for each sample of each beam.

use crate::OutputError;
use crate::document::section_quaternions;
use flexura_model::{Model, visible};
use flexura_post::Evaluation;
use flexura_solution::Solution;
use std::fmt::Write;

const HEADER: &str = "beam,s[m],x[m],y[m],z[m],qw,qx,qy,qz,Fx[N],Fy[N],Fz[N],Mx[N*m],My[N*m],Mz[N*m],\
k1[1/m],k2[1/m],k3[1/m],stretch,strain,stress[Pa]";
/// Force of an elastic foundation; only where any beam has one.
const FOUNDATION: &str = ",qx[N/m],qy[N/m],qz[N/m]";

/// The table of all beams' samples. Strain and stress are left empty for a section given as a stiffness, and the force of an elastic
/// foundation for a beam without one.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn beams_csv(model: &Model, solution: &Solution, evaluation: &Evaluation) -> Result<String, OutputError> {
    let mut text = String::from(HEADER);
    let founded = model.beams.iter().any(|beam| !beam.foundation.is_empty());
    if founded {
        text.push_str(FOUNDATION);
    }
    text.push('\n');
    for ((beam, result), stress) in model.beams.iter().zip(&solution.beams).zip(&evaluation.beams) {
        let name = quoted(&beam.name);
        let rotations = section_quaternions(result.samples.iter().map(|sample| &sample.pose.rotation));
        for (i, sample) in result.samples.iter().enumerate() {
            text.push_str(&name);
            let [position, force, moment, curvature]: [[f64; 3]; 4] = [
                sample.pose.position.into(),
                sample.wrench.force.into(),
                sample.wrench.moment.into(),
                sample.curvature.into(),
            ];
            let groups: [&[f64]; 7] =
                [&[sample.s], &position, &rotations[i], &force, &moment, &curvature, &[sample.strain.x]];
            for value in groups.into_iter().flatten() {
                push(&mut text, *value, &beam.name, i)?;
            }
            match stress {
                Some(stress) => {
                    push(&mut text, stress.samples[i].strain, &beam.name, i)?;
                    push(&mut text, stress.samples[i].von_mises, &beam.name, i)?;
                }
                None => text.push_str(",,"),
            }
            if founded && beam.foundation.is_empty() {
                text.push_str(",,,");
            } else if founded {
                for value in sample.foundation.iter() {
                    push(&mut text, *value, &beam.name, i)?;
                }
            }
            text.push('\n');
        }
    }
    Ok(text)
}

fn push(text: &mut String, value: f64, beam: &str, sample: usize) -> Result<(), OutputError> {
    if !value.is_finite() {
        return Err(OutputError::NotFinite { field: format!("beams.{beam} at sample {sample}"), value });
    }
    text.push(',');
    // Debug prints the shortest text that reads back as the same number, with an exponent where that is
    // shorter; writing to a String cannot fail.
    let _ = write!(text, "{value:?}");
    Ok(())
}

/// A row of a table: cells with commas between them, ending in a line break.
pub fn csv_line(cells: &[String]) -> String {
    cells.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",") + "\n"
}

/// A cell, in quotes where it needs them. Spreadsheets take what begins with `=`, `+`, `-` or `@` for a formula: unless it is a
/// number it gets an apostrophe, which they take for the sign of a text.
pub(crate) fn quoted(cell: &str) -> String {
    let cell = visible(cell);
    let is_formula = cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err();
    let sign = if is_formula { "'" } else { "" };
    if cell.contains([',', '"']) {
        format!("\"{sign}{}\"", cell.replace('"', "\"\""))
    } else {
        format!("{sign}{cell}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_no_formula_and_holds_nothing_unseen() {
        let cases = [
            ("-0.05", "-0.05"),
            ("+1e-3", "+1e-3"),
            ("-inf", "-inf"),
            ("=1+1", "'=1+1"),
            ("-2+3", "'-2+3"),
            ("@sum(a, b)", "\"'@sum(a, b)\""),
            ("a \"word\"", "\"a \"\"word\"\"\""),
            ("\u{1b}[2J\n", "\\u001B[2J\\u000A"),
        ];
        for (cell, written) in cases {
            assert_eq!(quoted(cell), written);
        }
        assert_eq!(csv_line(&["a,b".to_owned(), "1.0".to_owned()]), "\"a,b\",1.0\n");
    }
}
