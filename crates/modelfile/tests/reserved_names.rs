//! The guide's list of names that no parameter may bear is that of the program.
#![allow(clippy::unwrap_used)]

use flexura_expression::{constant_table, function_table, reserved, unit_table};
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn the_guide_lists_every_reserved_name_and_no_other() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide.md");
    let guide = std::fs::read_to_string(path).unwrap();
    let start = guide.find("### Names of parameters").unwrap();
    let part = &guide[start..];
    let end = part.find("So a mass is called").unwrap();
    let list: String =
        part[..end].lines().filter(|line| line.starts_with("- ") || line.starts_with("  ")).collect();
    let told: BTreeSet<&str> = list.split('`').skip(1).step_by(2).collect();
    for name in &told {
        assert!(reserved(name).is_some(), "`{name}` is free");
    }
    let units = unit_table()
        .iter()
        .map(|unit| unit.symbol)
        .filter(|symbol| symbol.chars().all(char::is_alphanumeric));
    let functions = function_table().map(|(name, _)| name);
    let constants = constant_table().map(|(name, _)| name);
    for name in units.chain(functions).chain(constants) {
        assert!(told.contains(name), "`{name}` is not in the guide");
    }
    let free = part[end..].split("\n\n").next().unwrap();
    for name in ["h", "L", "t", "A", "F", "E", "I", "M", "R"] {
        assert!(free.contains(&format!("`{name}`")) && reserved(name).is_none(), "{name}");
    }
}
