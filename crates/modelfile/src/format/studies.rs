//! The tables of studies.

use super::design::OPTIMISE;
use super::fit::{FIT, FORMULA};
use super::motion::MOTION;
use super::tables::{key, table, variant};
use super::{Need, Shape, Table, Variants};
use Need::{Default, Optional, Required};

pub(crate) static STUDY: Table = Table {
    doc: "What is to be done with the mechanism; `flexura run FILE NAME` does it.",
    keys: &[],
    variants: Some(Variants {
        by: "kind",
        by_doc: "What is done.",
        default: None,
        list: &[
            variant("solve", "The equilibrium, forward or inverse.", &[]),
            variant(
                "trace",
                "The path of equilibria as one parameter changes, through folds, with branch points and stability. Not for an inverse problem.",
                &[
                    key("parameter", Shape::Parameter, Required, "\"push\"", "The parameter that changes."),
                    key(
                        "range",
                        Shape::AnyRange,
                        Required,
                        "[\"0 N\", \"40 N\"]",
                        "Values between which the path is followed; the first may be the larger.",
                    ),
                    key(
                        "start",
                        Shape::AnyNumber,
                        Default("the first end of the range"),
                        "\"10 N\"",
                        "Where the path starts, from rest under the loads of this value; from inside the range it is followed both ways.",
                    ),
                    key(
                        "steps",
                        Shape::Count,
                        Default("40"),
                        "100",
                        "About how many points a path has at least that goes straight from one end of the range to the other.",
                    ),
                    key("most_points", Shape::Count, Default("2000"), "500", "Most points of one branch."),
                    key(
                        "branches",
                        Shape::FlagOrCount,
                        Default("false"),
                        "true",
                        "Follow the branches that are met at branch points, and those that they meet: at most so many, 20 for `true`.",
                    ),
                    key(
                        "event",
                        Shape::Texts,
                        Optional,
                        "[\"output.w = 10 mm\", \"joint.way.effort = 0\"]",
                        "Points to be found: where a result has a value.",
                    ),
                    key(
                        "stop",
                        Shape::Texts,
                        Optional,
                        "[\"fold 2\", \"output.w = 30 mm\"]",
                        "Where a branch ends besides the ends of the range: an event, or a fold, branch point or event by its number.",
                    ),
                    key(
                        "guesses",
                        Shape::Count,
                        Default("0"),
                        "20",
                        "Random pushes at both ends of the range by which branches are looked for that hang together with no other.",
                    ),
                    key(
                        "imperfection",
                        Shape::Table(&IMPERFECTION),
                        Optional,
                        "{ parameter = \"slope\", from = \"100 deg\" }",
                        "A further way to such branches.",
                    ),
                    key(
                        "critical",
                        Shape::Table(&CRITICAL),
                        Optional,
                        "{ parameter = \"weight\", range = [\"0 N\", \"2 N\"] }",
                        "Follow a fold or branch point as a second parameter changes.",
                    ),
                ],
            ),
            variant(
                "buckle",
                "Critical loads and shapes of the problem linearised about an equilibrium. Not for an inverse problem.",
                &[
                    key(
                        "parameter",
                        Shape::Parameter,
                        Default("all loads and drives in proportion"),
                        "\"push\"",
                        "The parameter whose critical values are wanted.",
                    ),
                    key(
                        "at",
                        Shape::AnyNumber,
                        Default("0"),
                        "\"2 N\"",
                        "The parameter's value at the equilibrium; without a parameter, the fraction of the load.",
                    ),
                    key(
                        "count",
                        Shape::Count,
                        Default("3"),
                        "5",
                        "How many critical values, those nearest to `at` first.",
                    ),
                ],
            ),
            variant(
                "modes",
                "Natural frequencies and shapes of small vibrations about an equilibrium, or along a path of them. Not for an inverse problem.",
                &[
                    key("count", Shape::Count, Default("6"), "10", "How many, the lowest first."),
                    key(
                        "at_rest",
                        Shape::Flag,
                        Default("false"),
                        "true",
                        "About the state at rest without any load, in place of the equilibrium.",
                    ),
                    key(
                        "parameter",
                        Shape::Parameter,
                        Optional,
                        "\"push\"",
                        "The parameter along whose path the frequencies are followed.",
                    ),
                    key(
                        "range",
                        Shape::AnyRange,
                        Optional,
                        "[\"0 N\", \"40 N\"]",
                        "Values between which the path is followed; the first may be the larger.",
                    ),
                    key(
                        "steps",
                        Shape::Count,
                        Default("40"),
                        "100",
                        "About how many points the path has, at least.",
                    ),
                ],
            ),
            variant(
                "inverse_dynamics",
                "A motion in time through one parameter that drives a rigid mechanism: velocities, accelerations, and the forces and efforts that it takes.",
                &MOTION,
            ),
            variant(
                "fit",
                "Unknown parameters from measurements: estimates with their intervals, correlations, and what the data do not tell.",
                &FIT,
            ),
            variant(
                "formula",
                "A polynomial that repeats an output over a trace or a grid, for the controller of a robot; `flexura formula` writes it as TOML, CSV, C or Rust.",
                &FORMULA,
            ),
            variant(
                "optimise",
                "Parameters that make an objective least or greatest, under bounds and constraints.",
                &OPTIMISE,
            ),
        ],
    }),
};

static IMPERFECTION: Table = table(
    "A parameter that breaks a symmetry. From the given value it is led to its own, which ends on a branch that the symmetry hides.",
    &[
        key(
            "parameter",
            Shape::Parameter,
            Required,
            "\"slope\"",
            "The parameter; another than the one that is traced.",
        ),
        key("from", Shape::AnyNumber, Required, "\"100 deg\"", "The value that it is led from."),
    ],
);

static CRITICAL: Table = table(
    "A fold or branch point that is followed in two parameters.",
    &[
        key(
            "parameter",
            Shape::Parameter,
            Required,
            "\"weight\"",
            "The second parameter; the path starts at its own value.",
        ),
        key("range", Shape::AnyRange, Required, "[\"0 N\", \"2 N\"]", "Values between which it changes."),
        key(
            "number",
            Shape::Count,
            Default("1"),
            "2",
            "Which of the folds and branch points of all branches, in their order.",
        ),
    ],
);
