//! The keys of studies that meet data: fits, and formulas that repeat an answer.

use super::tables::{key, table};
use super::{Key, Need, Shape, Table};
use Need::{Default, Optional, Required};
use flexura_expression::Dimension;

/// Words for what a residual costs.
pub(crate) static LOSSES: [(&str, &str); 4] = [
    ("squares", "Least squares."),
    ("huber", "Squares up to 1.345 standard deviations, absolute values beyond."),
    ("soft_l1", "The same without a corner."),
    ("cauchy", "Logarithms: what lies far hardly counts."),
];

/// Words for what the ends of intervals are found by.
pub(crate) static INTERVALS: [(&str, &str); 2] = [
    ("linear", "The problem linearised at the estimates."),
    (
        "profile",
        "Besides, the likelihood while all other parameters are fitted anew: right where the problem is not linear, and slower.",
    ),
];

/// Keys of a study of the kind `fit`.
pub(crate) static FIT: [Key; 9] = [
    key(
        "data",
        Shape::Data(&DATA),
        Required,
        "\"bone.csv\"",
        "The measurements: a CSV file beside the model, or a table. Its columns bear the names of parameters, which are set for the row, and of outputs, which were measured (`tip.y` for a component), with their units as in `pull [N]`; `specimen` and `weight` may stand beside them.",
    ),
    key(
        "unknown",
        Shape::Texts,
        Optional,
        "[\"young\"]",
        "Parameters to be found, the same for all specimens; their own values are the first guess.",
    ),
    key("per_specimen", Shape::Texts, Optional, "[\"young\"]", "Parameters to be found for each specimen."),
    key(
        "bounds",
        Shape::NamedRanges,
        Optional,
        "{ young = [\"1 GPa\", \"10 GPa\"] }",
        "Values between which parameters are looked for.",
    ),
    key(
        "noise",
        Shape::NamedValues,
        Optional,
        "{ tip = \"0.1 mm\" }",
        "Standard deviations of measured outputs. Needed where several are measured, so that they count as they should; the scatter of the residuals is told beside them.",
    ),
    key("loss", Shape::Choice(&LOSSES), Default("\"squares\""), "\"huber\"", "What a residual costs."),
    key(
        "intervals",
        Shape::Choice(&INTERVALS),
        Default("\"linear\""),
        "\"profile\"",
        "What the intervals of the estimates are found by.",
    ),
    key(
        "confidence",
        Shape::Number(Dimension::NUMBER),
        Default("0.95"),
        "0.99",
        "Probability that an interval holds the true value.",
    ),
    key(
        "reject",
        Shape::Flag,
        Default("false"),
        "true",
        "Leave out specimens that lie outside what the others predict; they are named in any case.",
    ),
];

static DATA: Table = table(
    "Measurements in the model file itself.",
    &[
        key(
            "columns",
            Shape::Texts,
            Required,
            "[\"pull [N]\", \"tip [mm]\"]",
            "What the columns are, as in the first line of a file.",
        ),
        key(
            "rows",
            Shape::Rows,
            Required,
            "[[1, 0.42], [2, 0.85]]",
            "One measurement each; \"\" where nothing was measured.",
        ),
    ],
);

/// Keys of a study of the kind `formula`.
pub(crate) static FORMULA: [Key; 9] = [
    key(
        "output",
        Shape::Text,
        Required,
        "\"slide [mm]\"",
        "The output that the formula gives, in SI units or in that of the brackets.",
    ),
    key(
        "of",
        Shape::Texts,
        Required,
        "[\"theta [deg]\", \"psi [deg]\"]",
        "What goes into it: parameters or outputs, in SI units or those of the brackets.",
    ),
    key(
        "trace",
        Shape::Text,
        Optional,
        "\"attach\"",
        "The trace along whose first branch the model is asked.",
    ),
    key(
        "vary",
        Shape::NamedGrids,
        Optional,
        "{ theta = [\"-40 deg\", \"40 deg\", 9] }",
        "In place of a trace, the grid on which it is asked: from, to, and how many values of each parameter.",
    ),
    key(
        "range",
        Shape::NamedRanges,
        Optional,
        "{ theta = [\"0 deg\", \"45 deg\"] }",
        "Values of what goes in between which the formula is fitted.",
    ),
    key("degree", Shape::Count, Optional, "3", "All products of powers up to this degree."),
    key(
        "terms",
        Shape::Texts,
        Optional,
        "[\"theta\", \"theta*abs(psi)\", \"theta^3\"]",
        "In place of `degree`: its terms, each a product of powers of what goes in, or of absolute values.",
    ),
    key(
        "constant",
        Shape::Flag,
        Default("true"),
        "false",
        "Has a formula that is given by its degree a constant?",
    ),
    key(
        "pieces",
        Shape::Tables(&PIECE),
        Optional,
        "[{ to = \"45 deg\", degree = 1 }, { degree = 2 }]",
        "In place of `degree` and `terms`: one formula after another along what goes in.",
    ),
];

static PIECE: Table = table(
    "One piece of a formula.",
    &[
        key("to", Shape::AnyNumber, Optional, "\"45 deg\"", "Where it ends; the last has no end."),
        key("degree", Shape::Count, Optional, "2", "All powers up to this one."),
        key("terms", Shape::Texts, Optional, "[\"theta\", \"theta^3\"]", "In place of `degree`."),
        key("constant", Shape::Flag, Default("true"), "false", "Has it a constant?"),
    ],
);
