//! Materials and cross sections.

use super::named_entries;
use crate::context::{Context, Needed, Read, Reported, suggest};
use crate::format::{Key, Need, Shape as Format};
use crate::reader::Reader;
use crate::tree::{Node, Value};
use flexura_expression::{Dimension, nearest};
use flexura_model::{
    At, KnownMaterial, MATERIALS, Material, Model, Notch, NotchShape, Profile, Rule, Section, Shape, Shear,
    known_material,
};
use flexura_spatial::Matrix6;
use std::collections::BTreeMap;

pub(super) fn material(reader: &Reader<'_, '_>, name: String) -> Read<Material> {
    let known = known(reader);
    let young = reader.number("young");
    let shear = reader.number("shear");
    let poisson = reader.number("poisson");
    let density = reader.number("density");
    let yield_strength = reader.number("yield_strength");
    let known = known?;
    let (given_young, given_shear, poisson) = (young?, shear?, poisson?);
    let young = match (given_young, known) {
        (Some(young), _) => young,
        (None, Some(known)) => known.young,
        (None, None) => {
            let hint =
                "for example `young = \"207 GPa\"`, or a `library` material (`flexura materials` lists them)";
            return Err(reader.wrong_with_hint("the key `young` is missing", hint));
        }
    };
    // Another E of a material that is the same in all directions leaves Poisson's ratio as it is.
    let ratio = known.and_then(|known| match known.shear {
        Shear::Poisson(poisson) => Some(poisson),
        Shear::Modulus(shear) if known.material().is_isotropic() => Some(known.young / (2.0 * shear) - 1.0),
        Shear::Modulus(_) => None,
    });
    let poisson = match (poisson, given_shear, given_young) {
        (None, None, Some(_)) => ratio,
        _ => poisson,
    };
    let shear = match (given_shear, poisson) {
        (Some(_), Some(_)) => {
            return Err(reader.wrong_at(
                "poisson",
                "give `shear` or `poisson`, not both",
                "one follows from the other: shear = young/(2*(1 + poisson))",
            ));
        }
        (Some(shear), None) => shear,
        (None, Some(poisson)) => {
            if poisson <= -1.0 || poisson > 0.5 {
                let message = format!("Poisson's ratio must lie above -1 and at most at 0.5, is {poisson}");
                return Err(reader.wrong_at("poisson", message, "most metals have about 0.3"));
            }
            bind_shear(reader, young, poisson);
            young / (2.0 * (1.0 + poisson))
        }
        (None, None) if known.is_some() => known.map_or(f64::NAN, |known| known.shear_with(young)),
        (None, None) => {
            return Err(reader.wrong_with_hint(
                "the key `shear` (or `poisson`) is missing",
                "for example `poisson = 0.3`",
            ));
        }
    };
    let density = density?.or(known.map(|known| known.density));
    let yield_strength = yield_strength?.or(known.and_then(|known| known.yield_strength));
    Ok(Material { name, young, shear, density, yield_strength })
}

/// The entry of the library that a material takes its numbers from.
fn known(reader: &Reader<'_, '_>) -> Read<Option<&'static KnownMaterial>> {
    let Some(name) = reader.text("library")? else { return Ok(None) };
    if let Some(known) = known_material(name) {
        return Ok(Some(known));
    }
    let names: Vec<&str> = MATERIALS.iter().map(|known| known.name).collect();
    let hint = suggest(name, &names, "material of the library");
    Err(reader.wrong_at("library", format!("the library has no material `{name}`"), hint))
}

/// The rule of a shear modulus that is given by Poisson's ratio.
fn bind_shear(reader: &Reader<'_, '_>, young: f64, poisson: f64) {
    let rules = &reader.context.rules;
    let path = reader.key_path("young");
    let Some([young, poisson]) = rules.join([path.clone(), reader.key_path("poisson")], [young, poisson])
    else {
        return;
    };
    rules.put(path, Rule::Number(young.clone()));
    rules.put(reader.key_path("shear"), Rule::ShearModulus { young, poisson });
}

pub(super) fn section(reader: &Reader<'_, '_>, name: String) -> Read<Section> {
    let plane_strain = reader.flag("plane_strain");
    let along = along(reader);
    let dimensions = Dimensions { reader, along: along? };
    let shape = match reader.variant {
        "rectangle" => {
            let (width, height) = (dimensions.get("width"), dimensions.get("height"));
            Shape::Rectangle { width: width?, height: height? }
        }
        "ellipse" => {
            let (width, height) = (dimensions.get("width"), dimensions.get("height"));
            Shape::Ellipse { width: width?, height: height? }
        }
        "circle" => Shape::Circle { diameter: dimensions.get("diameter")? },
        "tube" => {
            let (outer, inner) = (dimensions.get("outer_diameter"), dimensions.get("inner_diameter"));
            Shape::Tube { outer_diameter: outer?, inner_diameter: inner? }
        }
        "stiffness" if reader.has("matrix") => matrix_section(reader, &dimensions)?,
        "stiffness" => {
            let [gj, ei2, ei3] = ["GJ", "EI2", "EI3"].map(|key| dimensions.stiffness(key));
            let ea = dimensions.optional("EA");
            let [ga2, ga3, mass] = ["GA2", "GA3", "mass_per_length"].map(|key| dimensions.optional(key));
            let rotary = reader.profiles("rotary_inertia");
            Shape::Stiffness {
                // Only beams that do not stretch may have such a section, which `check_stretch` sees to.
                ea: ea?.unwrap_or(Profile::Constant(f64::INFINITY)),
                gj: gj?,
                ei2: ei2?,
                ei3: ei3?,
                ga2: ga2?,
                ga3: ga3?,
                mass_per_length: mass?,
                rotary_inertia: rotary?.map(Box::new),
            }
        }
        _ => return Err(Reported),
    };
    Ok(Section { name, shape, plane_strain: plane_strain?.unwrap_or(false) })
}

/// Dimensions of a section, given once or in the rows of `along`.
struct Dimensions<'r, 'c, 'a> {
    reader: &'r Reader<'c, 'a>,
    along: BTreeMap<&'static str, Profile>,
}

impl Dimensions<'_, '_, '_> {
    fn optional(&self, key: &str) -> Read<Option<Profile>> {
        match self.along.get(key) {
            Some(_) if self.reader.has(key) => Err(self.reader.wrong_at(
                key,
                format!("`{key}` is given here and in `along`"),
                "give it in one place only",
            )),
            Some(profile) => Ok(Some(profile.clone())),
            None => match self.reader.entry(key) {
                Some((entry, Key { shape: shape @ Format::Notched(_), .. }))
                    if matches!(entry.node.value, Value::Table(_)) =>
                {
                    let table = shape.table().ok_or(Reported)?;
                    let path = self.reader.key_path(key);
                    notch(&Reader::open(self.reader.context, entry, table, &path)?).map(Some)
                }
                _ => self.reader.profile(key),
            },
        }
    }

    /// A stiffness that every beam needs, with what it is for where it is missing.
    fn stiffness(&self, key: &str) -> Read<Profile> {
        self.optional(key)?.ok_or_else(|| missing_stiffness(self.reader, key))
    }

    fn get(&self, key: &str) -> Read<Profile> {
        self.optional(key)?.ok_or_else(|| self.reader.missing_key(key))
    }
}

fn missing_stiffness(reader: &Reader<'_, '_>, name: &str) -> Reported {
    let Some(key) = reader.keys().iter().find(|key| key.name == name) else {
        return reader.missing_key(name);
    };
    let purpose = match name {
        "EA" => "it resists stretching; beams with `extension = false` need none",
        "GJ" => "it resists twisting, also where nothing seems to twist",
        "EI2" => "it resists bending about e2",
        _ => "it resists bending about e3",
    };
    let message = format!("the key `{name}` is missing: {purpose}");
    reader.wrong_with_hint(
        message,
        format!("for example `{name} = {}`, or `{name} = inf` if it is rigid", key.example),
    )
}

/// A section without EA is for beams that do not stretch: the first beam that does is named.
pub(super) fn check_stretch(context: &Context<'_>, model: &Model) {
    for entry in named_entries(context, "section") {
        let is = |key: &str, word: &str| {
            entry
                .node
                .get(key)
                .is_some_and(|entry| matches!(&entry.node.value, Value::Text(text) if text == word))
        };
        let along = entry.node.get("along").map(|along| &along.node.value);
        let in_rows =
            matches!(along, Some(Value::List(rows)) if rows.iter().any(|row| row.get("EA").is_some()));
        let direct = is("shape", "stiffness") && entry.node.get("matrix").is_none();
        if !direct || in_rows || entry.node.get("EA").is_some() {
            continue;
        }
        let stretches = model.beams.iter().find(|beam| {
            beam.theory.extension && model.sections.get(beam.section.0).is_some_and(|s| s.name == entry.key)
        });
        if let Some(beam) = stretches {
            let message = format!(
                "the key `EA` is missing: it resists stretching, and beam `{}` may stretch",
                beam.name
            );
            let hint = "for example `EA = \"1e6 N\"`; or give the beam `extension = false`";
            context.wrong_with_hint(&entry.key_span, &format!("section.{}", entry.key), message, hint);
        }
    }
}

fn notch(table: &Reader<'_, '_>) -> Read<Profile> {
    let thickness = table.number("thickness").needed();
    let center = table.station("at");
    let shape = match table.variant {
        "circular" => NotchShape::Circular { radius: table.number("radius").needed()? },
        "elliptic" => {
            let (along, across) = (table.number("semi_axis_along"), table.number("semi_axis_across"));
            NotchShape::Elliptic { along: along.needed()?, across: across.needed()? }
        }
        "corner_filleted" => {
            let (radius, length) = (table.number("radius"), table.number("length"));
            NotchShape::CornerFilleted { radius: radius.needed()?, length: length? }
        }
        _ => return Err(Reported),
    };
    Ok(Profile::Notch(Notch { shape, thickness: thickness?, center: center? }))
}

/// Reads the rows of `along`: every row has `at` and the same keys as the first.
fn along(reader: &Reader<'_, '_>) -> Read<BTreeMap<&'static str, Profile>> {
    let Some((entry, at_key)) = reader.entry("along") else { return Ok(BTreeMap::new()) };
    let context = reader.context;
    let path = reader.key_path("along");
    let Value::List(rows) = &entry.node.value else {
        let message = format!("expected a list of rows, found {}", entry.node.kind());
        return Err(context.wrong_with_hint(
            &entry.node.span,
            &path,
            message,
            format!("for example `along = {}`", at_key.example),
        ));
    };
    if rows.len() < 2 {
        return Err(context.wrong(
            &entry.node.span,
            &path,
            format!("`along` needs at least 2 rows, found {}", rows.len()),
        ));
    }
    let keys: Vec<&'static Key> = reader
        .keys()
        .iter()
        .copied()
        .filter(|key| matches!(key.shape, Format::Profile(_) | Format::Notched(_) | Format::Stiffness(_)))
        .collect();
    let mut places: Vec<At> = Vec::new();
    let mut columns: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    let mut result = Ok(());
    for (i, row) in rows.iter().enumerate() {
        let path = format!("{path}[{i}]");
        if !matches!(row.value, Value::Table(_)) {
            result = Err(context.wrong(
                &row.span,
                &path,
                format!("expected a row such as {{ at = 0, {} = ... }}, found {}", keys[0].name, row.kind()),
            ));
            continue;
        }
        match row.get("at") {
            Some(at) => match reader.station_in(&at.node, &format!("{path}.at"), at_key) {
                Ok(at) => places.push(at),
                Err(Reported) => result = Err(Reported),
            },
            None => {
                result = Err(context.wrong_with_hint(
                    &row.span,
                    &path,
                    "the key `at` is missing",
                    "for example `at = 0.5`",
                ))
            }
        }
        for cell in row.entries().iter().filter(|cell| cell.key != "at") {
            let path = format!("{path}.{}", cell.key);
            let Some(key) = keys.iter().find(|key| key.name == cell.key) else {
                let names: Vec<&str> = keys.iter().map(|key| key.name).chain(["at"]).collect();
                let hint = nearest(&cell.key, names).map(|near| format!("did you mean `{near}`?"));
                let mut problem =
                    context.problem(&cell.key_span, &path, format!("`{}` is not a known key here", cell.key));
                problem.hint = hint;
                result = Err(context.record(problem));
                continue;
            };
            match reader.profile_in(&cell.node, &path, key) {
                Ok(Profile::Constant(value)) => columns.entry(key.name).or_default().push(value),
                Ok(_) => {
                    result = Err(context.wrong(
                        &cell.node.span,
                        &path,
                        "a row of `along` must hold a constant, not an expression of s",
                    ))
                }
                Err(Reported) => result = Err(Reported),
            }
        }
        if result.is_ok() && columns.values().any(|column| column.len() != i + 1) {
            result = Err(context.wrong(&row.span, &path, "every row of `along` must have the same keys"));
        }
        if result.is_err() {
            // Later rows would only repeat what follows from this one.
            break;
        }
    }
    result?;
    Ok(columns.into_iter().map(|(key, value)| (key, Profile::Table { at: places.clone(), value })).collect())
}

fn matrix_section(reader: &Reader<'_, '_>, dimensions: &Dimensions<'_, '_, '_>) -> Read<Shape> {
    let both = reader.keys().iter().find(|key| {
        matches!(key.shape, Format::Stiffness(_))
            && (reader.has(key.name) || dimensions.along.contains_key(key.name))
    });
    if let Some(key) = both {
        debug_assert!(matches!(key.need, Need::Along | Need::Optional));
        return Err(reader.wrong_at(
            key.name,
            format!("give `matrix` or `{}`, not both", key.name),
            "the matrix holds all stiffnesses",
        ));
    }
    let matrix = matrix(reader);
    let mass_per_length = dimensions.optional("mass_per_length");
    let rotary_inertia = reader.profiles("rotary_inertia");
    Ok(Shape::StiffnessMatrix {
        matrix: Box::new(matrix?),
        mass_per_length: mass_per_length?,
        rotary_inertia: rotary_inertia?.map(Box::new),
    })
}

fn matrix(reader: &Reader<'_, '_>) -> Read<Matrix6<f64>> {
    let (entry, key) = reader.entry("matrix").ok_or(Reported)?;
    let path = reader.key_path("matrix");
    let rows: &[Node] = match &entry.node.value {
        Value::List(rows) if rows.len() == 6 => rows,
        Value::List(rows) => {
            let message = format!("expected 6 rows of 6 numbers, found {} rows", rows.len());
            return Err(reader.context.wrong(&entry.node.span, &path, message));
        }
        _ => {
            let message = format!("expected 6 rows of 6 numbers, found {}", entry.node.kind());
            return Err(reader.context.wrong(&entry.node.span, &path, message));
        }
    };
    let mut matrix = Matrix6::zeros();
    let mut result = Ok(());
    for (i, row) in rows.iter().enumerate() {
        // Force on strain is N, force on curvature and moment on strain N·m, moment on curvature N·m².
        let dimensions = [0, 1, 2, 3, 4, 5].map(|j| match (i < 3, j < 3) {
            (true, true) => Dimension::FORCE,
            (false, false) => Dimension::BENDING_STIFFNESS,
            _ => Dimension::MOMENT,
        });
        match reader.numbers_in(row, &format!("{path}[{i}]"), key, &dimensions) {
            Ok(values) => {
                for (j, quantity) in values.iter().enumerate() {
                    matrix[(i, j)] = quantity.value;
                }
            }
            Err(Reported) => result = Err(Reported),
        }
    }
    result.map(|()| matrix)
}
