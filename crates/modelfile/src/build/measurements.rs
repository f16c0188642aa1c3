//! A table of measurements: from a CSV file, or from the model file itself.

use super::fit::texts;
use super::result::Built;
use crate::context::{Context, Read, Reported, suggest};
use crate::reader::Reader;
use crate::tree::{Node, Value};
use flexura_expression::{Dimension, Expression, ExpressionError, Kind};
use flexura_model::{MeasuredRow, Measurements, Model};

/// More rows than this are taken for another file.
const MOST_ROWS: usize = 1_000_000;

/// The names that a table may bear.
pub(super) struct Known<'k> {
    parameters: Vec<(&'k str, Option<Dimension>)>,
    outputs: Vec<(&'k str, usize, Dimension)>,
}

impl<'k> Known<'k> {
    pub fn new(context: &Context<'_>, model: &'k Model, outputs: &'k [Built]) -> Self {
        let dimension = |name: &str| match context.parameters.get(name).copied().flatten()?.kind {
            Kind::Of(dimension) => Some(dimension),
            // Declared without a unit, it takes any.
            Kind::Plain => None,
        };
        let parameters =
            model.parameters.iter().map(|parameter| (parameter.name.as_str(), dimension(&parameter.name)));
        let outputs = outputs
            .iter()
            .map(|built| (built.output.name.as_str(), built.output.formulas.len(), built.kind.dimension()));
        Self { parameters: parameters.collect(), outputs: outputs.collect() }
    }

    pub fn parameter(&self, name: &str) -> Option<usize> {
        self.parameters.iter().position(|(known, _)| *known == name)
    }

    pub fn parameter_names(&self) -> Vec<&str> {
        self.parameters.iter().map(|(name, _)| *name).collect()
    }

    pub fn parameter_dimension(&self, position: usize) -> Option<Dimension> {
        self.parameters.get(position).and_then(|(_, dimension)| *dimension)
    }

    /// An output, or a component of one: `tip.y`.
    pub fn output(&self, name: &str) -> Option<(usize, usize)> {
        let find = |name: &str, vector: bool| {
            self.outputs.iter().position(|(known, parts, _)| *known == name && (*parts > 1) == vector)
        };
        if let Some(position) = find(name, false) {
            return Some((position, 0));
        }
        let (name, component) = name.rsplit_once('.')?;
        let component = ["x", "y", "z"].iter().position(|letter| *letter == component)?;
        find(name, true).map(|position| (position, component))
    }

    pub fn output_names(&self) -> Vec<String> {
        let parts = |(name, parts, _): &(&str, usize, Dimension)| match parts {
            1 => vec![name.to_string()],
            _ => ["x", "y", "z"].map(|letter| format!("{name}.{letter}")).to_vec(),
        };
        self.outputs.iter().flat_map(parts).collect()
    }

    pub fn output_dimension(&self, position: usize) -> Dimension {
        self.outputs.get(position).map_or(Dimension::NUMBER, |(.., dimension)| *dimension)
    }

    /// All names of columns.
    fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = self.parameters.iter().map(|(name, _)| (*name).to_string()).collect();
        names.extend(self.output_names());
        names.extend(["specimen".to_string(), "weight".to_string()]);
        names
    }
}

/// What a column is, and the factor of its unit.
enum Column {
    Set(usize, f64),
    Measured((usize, usize), f64),
    Specimen,
    Weight,
}

/// A name with a unit behind it in brackets: `pull [N]`.
pub(super) fn split_unit(text: &str) -> (&str, Option<&str>) {
    let text = text.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some(inner) = text.strip_suffix(close)
            && let Some((name, unit)) = inner.rsplit_once(open)
        {
            return (name.trim_end(), Some(unit.trim()));
        }
    }
    (text, None)
}

/// The factor and the dimension of a unit; an empty one and `-` are those of a plain number.
pub(super) fn unit(text: &str) -> Result<(f64, Dimension), String> {
    if text.is_empty() || text == "-" || text == "1" {
        return Ok((1.0, Dimension::NUMBER));
    }
    let quantity = evaluate(&format!("1 {text}")).map_err(|error| match error.hint {
        Some(hint) => format!("`{text}` is no unit; {hint}"),
        None => format!("`{text}` is no unit"),
    })?;
    Ok(quantity)
}

fn evaluate(text: &str) -> Result<(f64, Dimension), ExpressionError> {
    let unbound = |span| ExpressionError::new("only a number and a unit can stand here", span);
    let quantity =
        Expression::parse(text)?.evaluate(&mut |reference| Err(unbound(reference.span.clone())))?;
    Ok((quantity.value, quantity.kind.dimension()))
}

/// The table as texts: the first line, and rows with the numbers of their lines.
struct Grid {
    source: String,
    header: Vec<String>,
    rows: Vec<(usize, Vec<String>)>,
}

pub(super) fn measurements(reader: &Reader<'_, '_>, known: &Known<'_>) -> Read<Measurements> {
    let Some((entry, _)) = reader.entry("data") else { return Err(Reported) };
    let grid = match &entry.node.value {
        Value::Text(file) => of_file(reader, file)?,
        Value::Table(_) => inline(reader)?,
        _ => {
            let message = format!("expected the name of a CSV file, or a table, found {}", entry.node.kind());
            return Err(reader.wrong_at("data", message, "for example `data = \"bone.csv\"`"));
        }
    };
    let columns = columns(reader, known, &grid)?;
    rows(reader, known, grid, &columns)
}

fn of_file(reader: &Reader<'_, '_>, file: &str) -> Read<Grid> {
    let text = super::curve::read(reader, "data", file)?;
    let text = text.trim_start_matches('\u{feff}');
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or("");
    let delimiter = ['\t', ';', ','].into_iter().find(|sign| first.contains(*sign)).unwrap_or(',');
    let mut csv = csv::ReaderBuilder::new()
        .delimiter(delimiter as u8)
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let mut grid = Grid { source: file.to_string(), header: Vec::new(), rows: Vec::new() };
    for record in csv.records() {
        let record = record.map_err(|error| {
            reader.wrong_at("data", format!("{file}: {error}"), "a table has one row a line")
        })?;
        let line = record.position().map_or(0, |position| position.line() as usize);
        let mut cells: Vec<String> = record.iter().map(str::to_string).collect();
        if cells.iter().all(String::is_empty) {
            continue;
        }
        if grid.header.is_empty() {
            grid.header = cells;
            continue;
        }
        if delimiter != ',' {
            // Where columns are divided by something else, the comma may stand for the decimal point.
            cells.iter_mut().filter(|cell| cell.matches(',').count() == 1).for_each(|cell| {
                if cell.replace(',', ".").parse::<f64>().is_ok() {
                    *cell = cell.replace(',', ".");
                }
            });
        }
        grid.rows.push((line, cells));
        if grid.rows.len() > MOST_ROWS {
            let message = format!("{file} has more than {MOST_ROWS} rows");
            return Err(reader.wrong_at("data", message, "take fewer of them"));
        }
    }
    Ok(grid)
}

fn inline(reader: &Reader<'_, '_>) -> Read<Grid> {
    let table = reader.table("data")?.ok_or(Reported)?;
    let header = texts(&table, "columns")?.into_iter().map(|(_, _, text)| text.to_string()).collect();
    let Some((entry, key)) = table.entry("rows") else { return Err(Reported) };
    let wrong = |node: &Node, path: &str| {
        let message = format!("expected a number or a text, found {}", node.kind());
        Err(reader.context.wrong_with_hint(
            &node.span,
            path,
            message,
            format!("for example `rows = {}`", key.example),
        ))
    };
    let path = table.key_path("rows");
    let Value::List(list) = &entry.node.value else { return wrong(&entry.node, &path) };
    let mut rows = Vec::with_capacity(list.len());
    for (i, row) in list.iter().enumerate() {
        let path = format!("{path}[{i}]");
        let Value::List(cells) = &row.value else { return wrong(row, &path) };
        let mut texts = Vec::with_capacity(cells.len());
        for cell in cells {
            match &cell.value {
                Value::Number(value) => texts.push(format!("{value:?}")),
                Value::Text(text) => texts.push(text.clone()),
                _ => return wrong(cell, &path),
            }
        }
        rows.push((i + 1, texts));
    }
    Ok(Grid { source: "data".to_string(), header, rows })
}

fn columns(reader: &Reader<'_, '_>, known: &Known<'_>, grid: &Grid) -> Read<Vec<Column>> {
    if grid.header.is_empty() {
        let message = format!("{} is empty", grid.source);
        return Err(reader.wrong_at(
            "data",
            message,
            "its first line names the columns: `pull [N], tip [mm]`",
        ));
    }
    let mut all: Vec<Read<Column>> = Vec::new();
    for (i, header) in grid.header.iter().enumerate() {
        let told = |message: String, hint: String| {
            reader.wrong_at("data", format!("{}, column {}: {message}", grid.source, i + 1), hint)
        };
        all.push(column(known, header).map_err(|(message, hint)| told(message, hint)));
        if grid.header[..i].contains(header) {
            all.push(Err(told(format!("`{header}` stands twice"), "take one of them out".to_string())));
        }
    }
    all.into_iter().collect()
}

fn column(known: &Known<'_>, header: &str) -> Result<Column, (String, String)> {
    let (name, unit_text) = split_unit(header);
    let plain = |column| match unit_text {
        Some(unit) => Err((format!("`{name}` has no unit, but `{unit}` is written"), "leave it out".into())),
        None => Ok(column),
    };
    match name {
        "specimen" => return plain(Column::Specimen),
        "weight" => return plain(Column::Weight),
        _ => {}
    }
    let parameter = known.parameter(name);
    let dimension = match (parameter, known.output(name)) {
        (Some(position), _) => known.parameter_dimension(position),
        (None, Some((output, _))) => Some(known.output_dimension(output)),
        (None, None) => {
            let names = known.names();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let message = format!("`{name}` is neither a parameter nor an output of the model");
            let hint = suggest(name, &names, "column");
            let join = if hint.ends_with('?') { "" } else { ";" };
            return Err((
                message,
                format!("{hint}{join} take the column out if it is not meant for the fit"),
            ));
        }
    };
    let factor = match (unit_text, dimension) {
        (Some(text), wanted) => {
            let (factor, dimension) = unit(text)
                .map_err(|message| (message, "write it as in a model file: `[N*m]`".to_string()))?;
            if let Some(wanted) = wanted
                && !wanted.agrees(&dimension)
            {
                let message = format!("`{name}` is {wanted}, but `{text}` is {dimension}");
                return Err((message, format!("for example `{name} [{}]`", wanted.unit())));
            }
            factor
        }
        (None, Some(wanted)) if !wanted.unit().is_empty() => {
            let message = format!("`{name}` is {wanted}, and has no unit here");
            return Err((message, format!("write it behind the name: `{name} [{}]`", wanted.unit())));
        }
        (None, _) => 1.0,
    };
    Ok(match (parameter, known.output(name)) {
        (Some(position), _) => Column::Set(position, factor),
        (None, Some(place)) => Column::Measured(place, factor),
        (None, None) => Column::Weight,
    })
}

fn rows(reader: &Reader<'_, '_>, known: &Known<'_>, grid: Grid, columns: &[Column]) -> Read<Measurements> {
    let mut data = Measurements { source: grid.source.clone(), ..Measurements::default() };
    for column in columns {
        match column {
            Column::Set(position, _) => data.set.push(*position),
            Column::Measured(place, _) => data.measured.push(*place),
            Column::Specimen | Column::Weight => {}
        }
    }
    if !columns.iter().any(|column| matches!(column, Column::Specimen)) {
        data.specimens.push(String::new());
    }
    let mut all = Ok(());
    for (line, cells) in &grid.rows {
        match row(known, &grid.header, columns, cells, &mut data.specimens) {
            Ok(row) => data.rows.push(MeasuredRow { line: *line, ..row }),
            Err((message, hint)) => {
                let message = format!("{}, line {line}: {message}", grid.source);
                all = Err(reader.wrong_at("data", message, hint));
                if reader.context.is_full() {
                    break;
                }
            }
        }
    }
    if data.rows.is_empty() && all.is_ok() {
        let message = format!("{} holds no rows", grid.source);
        return Err(reader.wrong_at("data", message, "write one measurement a line"));
    }
    all.map(|()| data)
}

fn row(
    known: &Known<'_>,
    header: &[String],
    columns: &[Column],
    cells: &[String],
    specimens: &mut Vec<String>,
) -> Result<MeasuredRow, (String, String)> {
    if cells.len() != columns.len() {
        let message = format!("expected {} cells, found {}", columns.len(), cells.len());
        return Err((
            message,
            "every row has a cell for each column; it may be empty where nothing was measured".into(),
        ));
    }
    let mut row = MeasuredRow { line: 0, set: Vec::new(), measured: Vec::new(), specimen: 0, weight: 1.0 };
    for ((column, cell), header) in columns.iter().zip(cells).zip(header) {
        let value = |factor, dimension| number(cell, header, factor, dimension);
        match column {
            Column::Set(position, factor) if !cell.is_empty() => {
                row.set.push(value(*factor, known.parameter_dimension(*position))?);
            }
            Column::Set(..) => {
                let message = format!("`{header}` has no value");
                return Err((message, "a parameter's column needs one in every row".into()));
            }
            Column::Measured(_, _) if cell.is_empty() => row.measured.push(None),
            Column::Measured((output, _), factor) => {
                row.measured.push(Some(value(*factor, Some(known.output_dimension(*output)))?));
            }
            Column::Specimen => {
                row.specimen = specimens.iter().position(|known| known == cell).unwrap_or_else(|| {
                    specimens.push(cell.clone());
                    specimens.len() - 1
                });
            }
            Column::Weight => row.weight = value(1.0, Some(Dimension::NUMBER))?,
        }
    }
    if row.measured.iter().all(Option::is_none) && columns.iter().any(|c| matches!(c, Column::Measured(..))) {
        return Err(("nothing was measured".into(), "fill it, or take the line out".into()));
    }
    Ok(row)
}

/// A number in the unit of its column, or with a unit of its own.
fn number(
    cell: &str,
    header: &str,
    factor: f64,
    dimension: Option<Dimension>,
) -> Result<f64, (String, String)> {
    let wrong = || {
        let shown: String = cell.chars().take(40).collect();
        let message = format!("`{shown}` is no finite number of the column `{header}`");
        (message, "write plain numbers, with a point for the decimals".to_string())
    };
    if let Ok(value) = cell.parse::<f64>() {
        let value = value * factor;
        return if value.is_finite() { Ok(value) } else { Err(wrong()) };
    }
    match evaluate(cell) {
        Ok((value, own)) if value.is_finite() && dimension.is_none_or(|wanted| wanted.agrees(&own)) => {
            Ok(value)
        }
        _ => Err(wrong()),
    }
}
