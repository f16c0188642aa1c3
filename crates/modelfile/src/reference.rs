//! The page of all keys, made from the format's descriptor.

use crate::format::{FILE, Key, Need, Shape, Table};
use flexura_expression::{constant_table, function_table, unit_table};

/// The reference of the model file's keys, units and functions, in Markdown.
pub fn reference_markdown() -> String {
    let mut page = String::from(
        "# The model file\n\n\
         A TOML file. Every number is a plain number in SI units and radians, a text with a unit\n\
         (`\"20.32 mm\"`), or an expression of parameters (`\"2*push + 1 N\"`). A unit stands directly behind\n\
         a number. Dimensions are checked: a plain number may stand for any dimension, two numbers with\n\
         units must agree. Where a quantity may vary along a beam, it may be an expression of the arc length\n\
         `s` (metres); if that mentions no unit at all, it is in SI units, and so is\n\
         `s` within a function that takes a plain number (`\"5 mm*cos(30*s)\"`).\n\n",
    );
    let mut done: Vec<&'static Table> = Vec::new();
    section(&mut page, "The file", &FILE);
    let mut open: Vec<(String, &'static Table)> = below("", &FILE);
    open.reverse();
    while let Some((title, table)) = open.pop() {
        if done.iter().any(|known| std::ptr::eq(*known, table)) {
            continue;
        }
        done.push(table);
        section(&mut page, &format!("`{title}`"), table);
        let mut inner = below(&title, table);
        inner.reverse();
        open.extend(inner);
    }
    page.push_str(REPEATING);
    page.push_str(RESULTS);
    page.push_str(EVENTS);
    words(&mut page);
    page
}

fn below(title: &str, table: &'static Table) -> Vec<(String, &'static Table)> {
    let path = |name: &str| if title.is_empty() { name.to_string() } else { format!("{title}.{name}") };
    let inner = |key: &'static Key| {
        let named = matches!(key.shape, Shape::NamedTables(_) | Shape::Unknowns(_));
        let title = if named { format!("{}.NAME", key.name) } else { key.name.to_string() };
        Some((path(&title), key.shape.table()?))
    };
    table.all_keys().filter_map(inner).collect()
}

fn section(page: &mut String, title: &str, table: &'static Table) {
    page.push_str(&format!("## {title}\n\n{}\n\n", table.doc));
    if !table.keys.is_empty() {
        rows(page, table.keys);
    }
    let Some(variants) = &table.variants else { return };
    let default = variants.default.map_or(String::new(), |default| format!(" Default: `\"{default}\"`."));
    page.push_str(&format!("`{}`: {}{default}\n\n", variants.by, variants.by_doc));
    for variant in variants.list {
        page.push_str(&format!("### `{} = \"{}\"`\n\n{}\n\n", variants.by, variant.name, variant.doc));
        if !variant.keys.is_empty() {
            rows(page, variant.keys);
        }
    }
}

fn rows(page: &mut String, keys: &[Key]) {
    page.push_str("| key | what | needed | example | |\n|---|---|---|---|---|\n");
    for key in keys {
        let need = match key.need {
            Need::Required => "yes".to_string(),
            Need::Along => "yes, here or in `along`".to_string(),
            Need::Optional => "no".to_string(),
            Need::Default(default) => format!("default: {default}"),
        };
        let cells = [
            format!("`{}`", key.name),
            key.shape.describe(),
            need,
            format!("`{}`", key.example),
            key.doc.to_string(),
        ];
        page.push_str(&format!("| {} |\n", cells.map(|cell| cell.replace('|', "\\|")).join(" | ")));
        if let Shape::Choice(choices) = key.shape {
            for (word, doc) in choices {
                page.push_str(&format!("| | `\"{word}\"` | | | {doc} |\n"));
            }
        }
    }
    page.push('\n');
}

const REPEATING: &str = "## Repeating\n\n\
    Every named table may have `repeat`, which names indices and makes a table for every combination of them: `{ i = 10 }` runs \
    from 0 to 9, `{ i = [1, 10] }` from 1 to 10, and the numbers may be expressions of parameters. In the table's name and in \
    every text inside, an expression in braces is replaced by its value, a whole number.\n\n\
    ```toml\n\
    [body.\"n_{i}_{j}\"]\n\
    repeat = { i = \"cells + 1\", j = 3 }\n\
    at = [\"{i}*10 mm\", \"{j}*10 mm\", 0]\n\n\
    [beam.\"h_{i}_{j}\"]\n\
    repeat = { i = \"cells\", j = 3 }\n\
    material = \"steel\"\n\
    section = \"strip\"\n\
    length = \"10 mm\"\n\
    start = { body = \"n_{i}_{j}\", hold = \"clamp\" }\n\
    end = { body = \"n_{i+1}_{j}\", hold = \"clamp\" }\n\
    ```\n\n";

const RESULTS: &str = "## Results in `[output]` and `[target]`\n\n\
    | what | quantities |\n|---|---|\n\
    | `beam.NAME[0.5]`, `beam.NAME[30 mm]`, `beam.NAME.start`, `beam.NAME.end` | `position`, `rotation`, `tangent`, `force`, `moment` (each `.x`, `.y`, `.z`), `curvature` (`.k1`, `.k2`, `.k3`), `stretch`, `strain`, `stress` |\n\
    | `body.NAME` | `position`, `rotation` (each `.x`, `.y`, `.z`); `screw.axis`, `screw.point` (each `.x`, `.y`, `.z`), `screw.pitch`, `screw.angle`: the finite screw from the undeformed pose; `motion.axis`, `motion.point` (each `.x`, `.y`, `.z`), `motion.pitch`: the instantaneous screw |\n\
    | both | `displacement`, `turning` since the undeformed mechanism (each `.x`, `.y`, `.z`), `compliance.ROW.COLUMN` (rows `x` `y` `z` `rx` `ry` `rz`, columns `fx` `fy` `fz` `mx` `my` `mz`), `stiffness.ROW.COLUMN` (rows `fx` ..., columns `x` ...), `center_of_compliance` (`.x`, `.y`, `.z`) |\n\
    | `joint.NAME` | `coordinate` and `effort` of a joint with one coordinate, each `.x`, `.y`, `.z` of a spherical one; otherwise the coordinate by its name, `angle`, `position`, `x`, `first` ..., and `effort.NAME`; `force`, `moment` (each `.x`, `.y`, `.z`) |\n\
    | `spring.NAME`, `cable.NAME` | `length`, `tension` |\n\
    | `spring.NAME` | `strain` from its rest length; `stress` of an exponential one |\n\
    | `tubes.NAME` | of the tip: `position`, `rotation`, `tangent` (each `.x`, `.y`, `.z`) |\n\
    | `model` | `energy` |\n\
    | `output.NAME` | in `[target]` and in events only: that output; of a vector `.x`, `.y`, `.z` |\n\n\
    A vector without a component gives three numbers. A name that is no plain word is quoted: `beam.\"left-arm\".end.position`. The coordinates of a free joint are `x`, `y`, `z` and the rotation vector `rx`, `ry`, `rz`.\n\n";

const EVENTS: &str = "## Events\n\n\
    An event of a trace is an equation such as `output.w = 10 mm`: on the left an expression over results as in `[target]`, a single \
    number; on the right a value, which may be an expression of parameters. A `stop` is an event, or one of\n\n\
    | stop | where a branch ends |\n|---|---|\n\
    | `fold`, `fold 2` | at its first fold, at its second |\n\
    | `branch`, `branch 2` | at its first branch point, at its second |\n\
    | `event`, `event 2` | at the first point of any kind that is not regular, at the second |\n\n";

fn words(page: &mut String) {
    page.push_str("## Units\n\n| unit | prefixes | in SI |\n|---|---|---|\n");
    for unit in unit_table() {
        let prefixes: Vec<&str> =
            unit.prefixes.iter().map(|(name, _)| *name).filter(|name| *name != "μ").collect();
        let si = unit.dimension.unit();
        page.push_str(&format!("| `{}` | {} | {} {si} |\n", unit.symbol, prefixes.join(" "), unit.factor));
    }
    page.push_str("\n## Functions and constants\n\n| name | what |\n|---|---|\n");
    for (name, doc) in function_table() {
        page.push_str(&format!("| `{name}` | {doc} |\n"));
    }
    for (name, value) in constant_table() {
        page.push_str(&format!("| `{name}` | {value} |\n"));
    }
}
