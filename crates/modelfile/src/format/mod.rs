//! The model file's format, written once: the reader, the JSON Schema and the reference page all follow it.
//!
//! The statics in the files beside this one say which keys there are, what stands behind each, its dimension, whether it
//! is needed, and give an example. What a builder does with the values is not said here.

mod attachments;
mod contacts;
mod design;
mod fit;
mod foundation;
mod joints;
mod motion;
mod relations;
mod sections;
mod springs;
mod studies;
mod tables;
mod tubes;

use flexura_expression::Dimension;
pub(crate) use tables::*;

/// A table of the file.
#[derive(Debug)]
pub(crate) struct Table {
    pub doc: &'static str,
    pub keys: &'static [Key],
    /// Further keys that depend on the value of one.
    pub variants: Option<Variants>,
}

#[derive(Debug)]
pub(crate) struct Variants {
    /// The key that tells them apart; a text, one of the names in `list`.
    pub by: &'static str,
    pub by_doc: &'static str,
    /// The one that is meant when the key is missing; None: the key is required.
    pub default: Option<&'static str>,
    pub list: &'static [Variant],
}

#[derive(Debug)]
pub(crate) struct Variant {
    pub name: &'static str,
    pub doc: &'static str,
    pub keys: &'static [Key],
}

#[derive(Debug)]
pub(crate) struct Key {
    pub name: &'static str,
    pub shape: Shape,
    pub need: Need,
    pub doc: &'static str,
    /// As it would be written behind the equals sign.
    pub example: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Need {
    Required,
    Optional,
    /// What is meant when it is missing, in words or as it would be written.
    Default(&'static str),
    /// Required here or in every row of `along`.
    Along,
}

/// Things that other things refer to by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Named {
    Material,
    Section,
    Beam,
    Body,
    /// A body or the ground.
    BodyOrGround,
    Joint,
    Spring,
    Cable,
    Tubes,
}

impl Named {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Named::Material => "material",
            Named::Section => "section",
            Named::Beam => "beam",
            Named::Body | Named::BodyOrGround => "body",
            Named::Joint => "joint",
            Named::Spring => "spring",
            Named::Cable => "cable",
            Named::Tubes => "tubes",
        }
    }

    /// One such thing, within a sentence.
    pub(crate) fn noun(self) -> &'static str {
        match self {
            Named::Tubes => "set of tubes",
            other => other.word(),
        }
    }
}

/// What stands behind a key.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Shape {
    /// A finite number.
    Number(Dimension),
    /// Three numbers.
    Vector(Dimension),
    /// Two numbers.
    Range(Dimension),
    /// Four numbers.
    Quaternion,
    /// A number or an expression of s.
    Profile(Dimension),
    /// The same, or the table of a notch.
    Notched(Dimension),
    /// A number or an expression of s, where `inf` is allowed.
    Stiffness(Dimension),
    /// Three numbers or expressions of s.
    Profiles(Dimension),
    /// Six rows of six numbers.
    Matrix6,
    /// Three numbers or three rows of three.
    Inertia,
    /// An expression of the curve's parameter.
    Function(Dimension),
    /// A fraction of the length, or a length.
    Station,
    /// A point on a body, or a place along a beam.
    PointOrStation,
    /// Any text.
    Text,
    /// true or false.
    Flag,
    /// One of these words.
    Choice(&'static [(&'static str, &'static str)]),
    /// The name of something.
    Name(Named),
    /// The name of a body, or a table that places a frame on it or on a beam.
    Placed(&'static Table),
    /// A table.
    Table(&'static Table),
    /// A table, or a list of such tables.
    Tables(&'static Table),
    /// A table of named tables.
    NamedTables(&'static Table),
    /// A table of named numbers.
    NamedNumbers,
    /// A table of named expressions over results.
    NamedOutputs,
    /// The indices of a repeated table.
    Repeat,
    /// A table of unknown parameters.
    Unknowns(&'static Table),
    /// A table of values, named by expressions over results.
    NamedTargets,
    /// A formula over results, or a table that says where it is read.
    Reading(&'static Table),
    /// The name of a parameter.
    Parameter,
    /// A whole number that is not negative.
    Count,
    /// true, false, or such a number.
    FlagOrCount,
    /// A text, or a list of texts.
    Texts,
    /// A number of the dimension of something else.
    AnyNumber,
    /// Two such numbers.
    AnyRange,
    /// Such numbers by the names of what they are of.
    NamedValues,
    /// Two such numbers each.
    NamedRanges,
    /// Two such numbers and how many.
    NamedGrids,
    /// The name of a file of measurements, or the table itself.
    Data(&'static Table),
    /// Rows of numbers or texts.
    Rows,
    /// Two numbers, each of the dimension of something else.
    AnyPair,
    /// Such a number per second.
    AnyRate,
    /// An expression of the time whose value is such a number.
    AnyFunction,
    /// Rows of a time and such a number.
    Knots,
    /// Two expressions of joint coordinates with an equals sign between them.
    Equation,
    /// Three lengths, or two lengths or expressions of s.
    Offset,
    /// A list of points.
    Points,
    /// A list of points in a plane.
    PlanePoints,
    /// Rows of two numbers whose dimensions depend on something else.
    Pairs,
    /// Rows of elongation and force.
    ForceRows,
    /// Rows of dimensions along the beam, keys as in the same table.
    Along,
    /// The number 1.
    Version,
}

impl Shape {
    /// The table that may stand behind the key.
    pub(crate) fn table(&self) -> Option<&'static Table> {
        match self {
            Shape::Notched(_) => Some(&sections::NOTCH),
            Shape::Table(table)
            | Shape::Tables(table)
            | Shape::Placed(table)
            | Shape::Reading(table)
            | Shape::NamedTables(table)
            | Shape::Data(table)
            | Shape::Unknowns(table) => Some(table),
            _ => None,
        }
    }

    pub(crate) fn dimension(&self) -> Dimension {
        match self {
            Shape::Number(d)
            | Shape::Vector(d)
            | Shape::Range(d)
            | Shape::Profile(d)
            | Shape::Notched(d)
            | Shape::Stiffness(d)
            | Shape::Profiles(d)
            | Shape::Function(d) => *d,
            Shape::Offset => Dimension::LENGTH,
            _ => Dimension::NUMBER,
        }
    }

    /// What it is, for the reference page.
    pub(crate) fn describe(&self) -> String {
        let dimension = self.dimension();
        let numbers = |count: &str, plural: &str| match dimension.unit().as_str() {
            "" => format!("{count} {plural}"),
            unit => format!("{count} {plural} ({unit})"),
        };
        match self {
            Shape::Number(_) => dimension.to_string(),
            Shape::Vector(_) => numbers("three", "numbers"),
            Shape::Range(_) => numbers("two", "numbers"),
            Shape::Quaternion => "four numbers".into(),
            Shape::Profile(_) => format!("{dimension} or an expression of s"),
            Shape::Notched(_) => format!("{dimension}, an expression of s, or the table of a notch"),
            Shape::Stiffness(_) => format!("{dimension}, `inf`, or an expression of s"),
            Shape::Profiles(_) => numbers("three", "numbers or expressions of s"),
            Shape::Matrix6 => "six rows of six numbers".into(),
            Shape::Inertia => "three moments of inertia (kg*m^2), or three rows of three".into(),
            Shape::Function(_) => format!("an expression of the parameter; {dimension}"),
            Shape::Station => "a fraction of the length, or a length with a unit".into(),
            Shape::PointOrStation => "a point on the body, or a place along the beam".into(),
            Shape::Text => "a text".into(),
            Shape::Flag => "true or false".into(),
            Shape::Choice(words) => {
                words.iter().map(|(word, _)| format!("\"{word}\"")).collect::<Vec<_>>().join(" or ")
            }
            Shape::Name(named) => format!("the name of a {}", named.word()),
            Shape::Placed(_) => "the name of a body, or a table".into(),
            Shape::Table(_) => "a table".into(),
            Shape::Tables(_) => "a table, or a list of tables".into(),
            Shape::NamedTables(_) => "named tables".into(),
            Shape::NamedNumbers => "named numbers".into(),
            Shape::NamedOutputs => "named expressions".into(),
            Shape::Repeat => "indices, each with a count or its first and last value".into(),
            Shape::Unknowns(_) => "named tables".into(),
            Shape::NamedTargets => "numbers, named by expressions over results".into(),
            Shape::Reading(_) => "a formula over results, or a table".into(),
            Shape::Parameter => "the name of a parameter".into(),
            Shape::Count => "a whole number".into(),
            Shape::FlagOrCount => "true, false or a whole number".into(),
            Shape::Texts => "a text, or a list of texts".into(),
            Shape::AnyNumber => "a number of the parameter's dimension".into(),
            Shape::AnyRange => "two numbers of the parameter's dimension".into(),
            Shape::NamedValues => "numbers by names".into(),
            Shape::NamedRanges => "two numbers each, by names".into(),
            Shape::NamedGrids => "from, to and how many, by names".into(),
            Shape::Data(_) => "the name of a CSV file, or a table".into(),
            Shape::Rows => "a list of rows, each a list of numbers or texts".into(),
            Shape::AnyPair => "two numbers, each of its curve's dimension".into(),
            Shape::AnyRate => "a number of the parameter's dimension per second".into(),
            Shape::AnyFunction => "an expression of t of the parameter's dimension".into(),
            Shape::Knots => "a list of knots, each a time and a number of the parameter's dimension".into(),
            Shape::Equation => "an equation between joint coordinates".into(),
            Shape::Offset => "three lengths, or two lengths or expressions of s".into(),
            Shape::Points => "a list of points, each three numbers (m)".into(),
            Shape::PlanePoints => "a list of points, each two numbers (m)".into(),
            Shape::Pairs => "a list of rows, each two numbers".into(),
            Shape::ForceRows => "a list of rows, each an elongation (m) and a force (N)".into(),
            Shape::Along => "a list of rows, each `at` and the dimensions there".into(),
            Shape::Version => "the number 1".into(),
        }
    }

    /// How an error names what it wanted.
    pub(crate) fn wanted(&self) -> String {
        match self {
            Shape::Name(_) | Shape::Choice(_) | Shape::Parameter => "a text".into(),
            Shape::Vector(_) | Shape::Profiles(_) => "a list of 3 numbers".into(),
            Shape::Range(_) | Shape::AnyRange | Shape::AnyPair => "a list of 2 numbers".into(),
            Shape::Quaternion => "a list of 4 numbers".into(),
            other => other.describe(),
        }
    }
}

impl Table {
    /// Every key of the table, whatever the variant.
    pub(crate) fn all_keys(&self) -> impl Iterator<Item = &'static Key> {
        let variants = self.variants.iter().flat_map(|variants| variants.list.iter());
        self.keys.iter().chain(variants.flat_map(|variant| variant.keys.iter()))
    }
}
