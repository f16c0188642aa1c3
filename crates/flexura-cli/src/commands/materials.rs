//! `flexura materials [NAME]`

use crate::arguments::MaterialsArguments;
use crate::failure::Failure;
use crate::screen;
use crate::table::Table;
use flexura::model::{KnownMaterial, MATERIALS, known_material};
use serde_json::{Value, json};

pub fn run(arguments: &MaterialsArguments) -> Result<(), Failure> {
    let found: Vec<&KnownMaterial> = match &arguments.name {
        None => MATERIALS.iter().collect(),
        Some(name) => vec![known_material(name).ok_or_else(|| unknown(name))?],
    };
    if arguments.json {
        let entries: serde_json::Map<String, Value> =
            found.iter().map(|known| (known.name.to_owned(), entry(known))).collect();
        return screen::print(&format!("{}\n", Value::Object(entries)));
    }
    let mut table =
        Table::new(&["materials", "E / GPa", "G / GPa", "kg/m^3", "yield / MPa", "at / C", "what", "source"]);
    for known in found {
        let material = known.material();
        let giga = |value: f64| {
            format!("{:.4}", 1e-9 * value).trim_end_matches('0').trim_end_matches('.').to_owned()
        };
        table.row(vec![
            known.name.to_owned(),
            giga(material.young),
            giga(material.shear),
            format!("{}", known.density),
            known.yield_strength.map_or_else(|| "-".to_owned(), |strength| format!("{}", 1e-6 * strength)),
            format!("{}", known.temperature),
            known.what.to_owned(),
            known.source.to_owned(),
        ]);
    }
    screen::print(&format!(
        "{}\nIn a model: [material.leaf] with library = \"spring-steel\"; what stands beside it takes the place of its numbers.\n",
        table.render()
    ))
}

fn unknown(name: &str) -> Failure {
    let hint = match flexura::expression::nearest(name, MATERIALS.iter().map(|known| known.name)) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "`flexura materials` lists them".to_owned(),
    };
    Failure::Input(format!("the library has no material `{name}`; {hint}"))
}

/// One entry, SI.
fn entry(known: &KnownMaterial) -> Value {
    let material = known.material();
    json!({
        "what": known.what,
        "young": material.young,
        "shear": material.shear,
        "density": known.density,
        "yield_strength": known.yield_strength,
        "temperature_celsius": known.temperature,
        "source": known.source,
    })
}
