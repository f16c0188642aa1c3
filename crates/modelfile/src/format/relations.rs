//! Tables of couplings, cables and inverse problems.

use super::joints::{BEAM_OR_BODY, BODY_OR_BEAM, POINT_OR_STATION};
use super::tables::{key, table};
use super::{Need, Shape, Table};
use Need::{Optional, Required};
use flexura_expression::Dimension as D;

pub(crate) static COUPLING: Table = table(
    "A linear relation between joint coordinates, as gears, racks and screws make. It is kept by efforts that do no work.",
    &[key(
        "relation",
        Shape::Equation,
        Required,
        "\"joint.rack.coordinate = 20 mm*joint.pinion.coordinate\"",
        "An equation, linear in the coordinates: `joint.NAME.coordinate`, or by the coordinate's name `joint.NAME.angle`, `.position`, `.x`, `.first` and so on.",
    )],
);

pub(crate) static CABLE: Table = table(
    "A cable (tendon) without friction, weight or stiffness in bending; its tension is the same everywhere. Give `tension` or `length`.",
    &[
        key("tension", Shape::Number(D::FORCE), Optional, "\"10 N\"", "Its tension."),
        key(
            "length",
            Shape::Number(D::LENGTH),
            Optional,
            "\"0.2 m\"",
            "Its length from anchor to anchor; the tension is found.",
        ),
        key(
            "route",
            Shape::Tables(&GUIDE),
            Required,
            "[{ body = \"ground\" }, { beam = \"finger\", from = 0, to = 1, offset = [\"4 mm\", 0] }]",
            "What it runs through, straight from one to the next; at its first and last point it is anchored. At least two points, or a channel.",
        ),
    ],
);

static GUIDE: Table = table(
    "A point of a body or of a beam's section (an eyelet), or with `from` and `to` a channel along a beam.",
    &[
        BODY_OR_BEAM,
        BEAM_OR_BODY,
        POINT_OR_STATION,
        key("from", Shape::Station, Optional, "0", "Where it enters a channel along the beam."),
        key("to", Shape::Station, Optional, "1", "Where it leaves the channel."),
        key(
            "offset",
            Shape::Offset,
            Optional,
            "[0, \"4 mm\", 0]",
            "On a beam, from its axis: of a point three lengths along e1, e2, e3; of a channel two along e2 and e3, which may be expressions of s.",
        ),
    ],
);

pub(crate) static UNKNOWN: Table = table(
    "A parameter that is to be found, so that the targets are met.",
    &[
        key(
            "guess",
            Shape::AnyNumber,
            Optional,
            "\"1 N\"",
            "Where the search begins; the value in [parameter] unless given.",
        ),
        key("range", Shape::AnyRange, Optional, "[\"0 N\", \"10 N\"]", "The range that must not be left."),
    ],
);
