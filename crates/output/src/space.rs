//! What is written of a linear model: document, table, and a file for MATLAB and `scipy.io.loadmat`.

use crate::document::{error_estimate, finite, parameters};
use crate::trace::{cell, headed, line};
use crate::{Named, OutputError};
use flexura_model::Model;
use flexura_solution::{Signal, StateSpace};
use serde::Serialize;

/// ẋ = A x + B u, y = C x + D u.
#[derive(Clone, Debug, Serialize)]
pub struct StateSpaceDocument {
    /// Version of flexura that wrote it.
    pub flexura: String,
    /// The model's name.
    pub model: String,
    /// The study.
    pub study: String,
    /// Of the equilibrium: "converged", or how else it ended.
    pub status: String,
    /// Why it did not converge, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Things to know though it went well.
    pub warnings: Vec<String>,
    /// Names and units of the states: modal coordinates, then their rates.
    pub states: Vec<SignalDocument>,
    /// Of the inputs.
    pub inputs: Vec<SignalDocument>,
    /// Of the outputs, which are changes from the equilibrium.
    pub outputs: Vec<SignalDocument>,
    /// How many of the coordinates are modes; the others are residual vectors.
    pub modes: usize,
    /// Residual vectors for each input.
    pub residual_vectors: usize,
    /// ω² of the coordinates, rad²/s².
    pub omega_squared: Vec<f64>,
    /// Rows of A.
    pub a: Vec<Vec<f64>>,
    /// Rows of B.
    pub b: Vec<Vec<f64>>,
    /// Rows of C.
    pub c: Vec<Vec<f64>>,
    /// Rows of D.
    pub d: Vec<Vec<f64>>,
    /// Largest difference from the undamped response of the whole mechanism up to the last mode, beside the response's size.
    pub response_error: Option<f64>,
    /// Estimated largest relative error of the equilibrium.
    pub error_estimate: Option<f64>,
    /// The parameters.
    pub parameters: Named<f64>,
}

/// A name with its SI unit.
#[derive(Clone, Debug, Serialize)]
pub struct SignalDocument {
    /// The name.
    pub name: String,
    /// SI unit, "" for a plain number.
    pub unit: String,
}

fn states(space: &StateSpace) -> Vec<Signal> {
    let n = space.squares.len();
    let signal = |name: String, unit: &str| Signal { name, unit: unit.to_owned() };
    let coordinates = (1..=n).map(|i| signal(format!("q{i}"), "m*kg^0.5"));
    coordinates.chain((1..=n).map(|i| signal(format!("q{i}.rate"), "m*kg^0.5/s"))).collect()
}

fn matrix(rows: &[Vec<f64>], name: &str) -> Result<Vec<Vec<f64>>, OutputError> {
    for (i, row) in rows.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            finite(*value, || format!("{name}[{i}][{j}]"))?;
        }
    }
    Ok(rows.to_vec())
}

/// The document of a linear model.
///
/// # Errors
/// [`OutputError::NotFinite`] names the first number that is NaN or infinite.
pub fn state_space_document(model: &Model, space: &StateSpace) -> Result<StateSpaceDocument, OutputError> {
    let list = |signals: &[Signal]| -> Vec<SignalDocument> {
        let each =
            signals.iter().map(|own| SignalDocument { name: own.name.clone(), unit: own.unit.clone() });
        each.collect()
    };
    let solution = &space.solution;
    Ok(StateSpaceDocument {
        flexura: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.name.clone(),
        study: "state_space".to_owned(),
        status: solution.status.word().to_owned(),
        reason: solution.reason.clone(),
        warnings: solution.warnings.clone(),
        states: list(&states(space)),
        inputs: list(&space.inputs),
        outputs: list(&space.outputs),
        modes: space.modes,
        residual_vectors: space.residual_vectors,
        omega_squared: matrix(std::slice::from_ref(&space.squares), "omega_squared")?.concat(),
        a: matrix(&space.a, "a")?,
        b: matrix(&space.b, "b")?,
        c: matrix(&space.c, "c")?,
        d: matrix(&space.d, "d")?,
        response_error: space.error_estimate.filter(|error| error.is_finite()),
        error_estimate: error_estimate(solution)?,
        parameters: parameters(model)?,
    })
}

/// The matrices as one table: rows are the rates of the states, then the outputs; columns the states, then the inputs.
///
/// # Errors
/// As [`state_space_document`].
pub fn state_space_csv(space: &StateSpace) -> Result<String, OutputError> {
    let states = states(space);
    let mut heading = vec!["row".to_owned()];
    heading.extend(states.iter().chain(&space.inputs).map(|own| headed(&own.name, &own.unit)));
    let mut text = line(heading);
    let rates = states
        .iter()
        .map(|own| Signal { name: format!("d({})/dt", own.name), unit: format!("{}/s", own.unit) });
    let names: Vec<Signal> = rates.chain(space.outputs.iter().cloned()).collect();
    let left = space.a.iter().chain(&space.c);
    let right = space.b.iter().chain(&space.d);
    for (own, (left, right)) in names.iter().zip(left.zip(right)) {
        let mut row = vec![headed(&own.name, &own.unit)];
        for value in left.iter().chain(right) {
            row.push(cell(*value, || own.name.clone())?);
        }
        text += &line(row);
    }
    Ok(text)
}

/// A file of level 4 (The MathWorks, *MAT-File Format*, "Level 4 MAT-files"): matrices `A`, `B`, `C`, `D`, `omega_squared` and `modes`,
/// and as rows of letters `states`, `inputs`, `outputs` with `state_units`, `input_units` and `output_units`.
///
/// # Errors
/// As [`state_space_document`].
pub fn state_space_mat(space: &StateSpace) -> Result<Vec<u8>, OutputError> {
    let mut file = Vec::new();
    let (n, inputs) = (space.a.len(), space.inputs.len());
    numbers(&mut file, "A", &matrix(&space.a, "a")?, n);
    numbers(&mut file, "B", &matrix(&space.b, "b")?, inputs);
    numbers(&mut file, "C", &matrix(&space.c, "c")?, n);
    numbers(&mut file, "D", &matrix(&space.d, "d")?, inputs);
    let squares = matrix(std::slice::from_ref(&space.squares), "omega_squared")?;
    numbers(&mut file, "omega_squared", &squares, space.squares.len());
    numbers(&mut file, "modes", &[vec![space.modes as f64]], 1);
    for (name, signals) in [("state", &states(space)), ("input", &space.inputs), ("output", &space.outputs)] {
        let list = |of: fn(&Signal) -> &str| signals.iter().map(of).collect::<Vec<_>>();
        letters(&mut file, &format!("{name}s"), &list(|own| &own.name));
        letters(&mut file, &format!("{name}_units"), &list(|own| &own.unit));
    }
    Ok(file)
}

/// The head of a matrix; `kind` is 0 for numbers in doubles, 1 for letters.
fn head(file: &mut Vec<u8>, name: &str, kind: i32, rows: usize, columns: usize) {
    for value in [kind, rows as i32, columns as i32, 0, name.len() as i32 + 1] {
        file.extend(value.to_le_bytes());
    }
    file.extend(name.as_bytes());
    file.push(0);
}

fn numbers(file: &mut Vec<u8>, name: &str, rows: &[Vec<f64>], columns: usize) {
    head(file, name, 0, rows.len(), columns);
    for j in 0..columns {
        rows.iter().for_each(|row| file.extend(row[j].to_le_bytes()));
    }
}

/// Words, one a row, filled up with blanks.
fn letters(file: &mut Vec<u8>, name: &str, words: &[&str]) {
    let columns = words.iter().map(|word| word.chars().count()).max().unwrap_or(0).max(1);
    head(file, name, 1, words.len(), columns);
    let rows: Vec<Vec<char>> =
        words.iter().map(|word| word.chars().chain(std::iter::repeat(' ')).take(columns).collect()).collect();
    for j in 0..columns {
        // What is no letter of ASCII has no code there.
        let code = |letter: char| if letter.is_ascii() { f64::from(letter as u32) } else { f64::from(b'?') };
        rows.iter().for_each(|row| file.extend(code(row[j]).to_le_bytes()));
    }
}
