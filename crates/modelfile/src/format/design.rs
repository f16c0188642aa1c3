//! The tables of design optimisation.

use super::tables::{key, table};
use super::{Key, Need, Shape, Table};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension;

pub(super) static OPTIMISE: [Key; 11] = [
    key(
        "minimise",
        Shape::Reading(&READING),
        Optional,
        "\"model.mass\"",
        "What is made least: the name of an output, or a formula over results. Either this or `maximise`.",
    ),
    key("maximise", Shape::Reading(&READING), Optional, "\"output.tilt\"", "What is made greatest."),
    key(
        "vary",
        Shape::Unknowns(&VARIED),
        Required,
        "{ thickness = { range = [\"0.1 mm\", \"2 mm\"] } }",
        "The parameters that may change, by their names.",
    ),
    key(
        "constraints",
        Shape::Tables(&CONSTRAINT),
        Optional,
        "[{ output = \"beam.link.max_stress\", most = \"500 MPa\" }]",
        "What must hold at the optimum.",
    ),
    key("stable", Shape::Flag, Default("false"), "true", "Refuse designs whose equilibrium is unstable."),
    key(
        "starts",
        Shape::Count,
        Default("1"),
        "8",
        "From how many designs is searched: the guess, and others that fill the ranges evenly.",
    ),
    key("seed", Shape::Count, Default("0"), "1", "Another seed draws other starts."),
    key(
        "method",
        Shape::Choice(&[
            ("sqp", "sequential quadratic programming, by exact derivatives"),
            ("cma_es", "an evolution strategy for rough landscapes, whose end is made exact by the other"),
        ]),
        Default("\"sqp\""),
        "\"cma_es\"",
        "How is searched.",
    ),
    key(
        "pareto",
        Shape::Table(&PARETO),
        Optional,
        "{ minimise = \"output.sag\", points = 11 }",
        "A second objective: the front of compromises between the two.",
    ),
    key(
        "tolerance",
        Shape::Number(Dimension::NUMBER),
        Default("1e-8"),
        "1e-6",
        "How well the conditions of an optimum must hold, relative to the ranges and to what is bounded.",
    ),
    key("most_iterations", Shape::Count, Default("200"), "50", "Most steps of one search."),
];

static READING: Table = table(
    "A number that is read off a design, at its equilibrium or at a point of a path.",
    &[
        key(
            "output",
            Shape::Text,
            Required,
            "\"output.force\"",
            "The name of an output, or a formula over results.",
        ),
        OVER,
        POINT,
    ],
);

static VARIED: Table = table(
    "A parameter that may change.",
    &[
        key(
            "range",
            Shape::AnyRange,
            Required,
            "[\"0.1 mm\", \"2 mm\"]",
            "Its bounds, the smaller one first.",
        ),
        key(
            "guess",
            Shape::AnyNumber,
            Default("its own value, or the middle of the range"),
            "\"0.5 mm\"",
            "Where the first search begins.",
        ),
    ],
);

static CONSTRAINT: Table = table(
    "What must hold of a number.",
    &[
        key(
            "output",
            Shape::Text,
            Required,
            "\"beam.link.max_stress\"",
            "The name of an output, or a formula over results.",
        ),
        OVER,
        POINT,
        key("least", Shape::AnyNumber, Optional, "\"2 N\"", "It must not be less."),
        key("most", Shape::AnyNumber, Optional, "\"500 MPa\"", "It must not be more."),
        key("equals", Shape::AnyNumber, Optional, "\"2 N\"", "It must be this."),
    ],
);

const OVER: Key = key(
    "over",
    Shape::Text,
    Default("the equilibrium of the design"),
    "\"path\"",
    "A study of the kind `trace`: the number is read along its path.",
);

const POINT: Key = key(
    "point",
    Shape::Text,
    Default("the greatest under `most`, `equals` and `minimise`, the least under `least` and `maximise`"),
    "\"fold 1\"",
    "Which point of that path: \"greatest\" or \"least\", between its points too, or a fold by its number.",
);

static PARETO: Table = table(
    "The second objective of a front.",
    &[
        key(
            "minimise",
            Shape::Reading(&READING),
            Optional,
            "\"output.sag\"",
            "The second objective, to be least. Either this or `maximise`.",
        ),
        key(
            "maximise",
            Shape::Reading(&READING),
            Optional,
            "\"output.reach\"",
            "The second objective, to be greatest.",
        ),
        key("points", Shape::Count, Default("11"), "21", "How many points of the front, both ends included."),
    ],
);
