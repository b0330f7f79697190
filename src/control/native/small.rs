//! Calls of smaller controls.

use super::{Argument, Call, Mark, angle, feed, length, plain};

const MACROS: &str = "the maker's own macro set for a CAM system";

const OFFSET: Argument = plain(
    "A",
    "work offset that is written: 54 is G54, 54.5 the fifth of the extended ones",
);

const fn lnc(name: &'static str, title: &'static str, arguments: &'static [Argument]) -> Call {
    Call {
        name,
        title,
        arguments,
        shared: &[],
        needs: &[],
        excludes: &[],
        mark: Mark::Sourced,
        source: MACROS,
    }
}

const SINGLE: [Argument; 2] = [OFFSET, length("B", "distance to the surface, signed")];
const BORE: [Argument; 3] = [OFFSET, length("B", "diameter"), length("Q", "overtravel")];
const BOSS: [Argument; 3] = [OFFSET, length("B", "diameter"), length("C", "way down")];
const WEB: [Argument; 3] = [OFFSET, length("B", "width"), length("C", "way down")];
const SLOT: [Argument; 2] = [OFFSET, length("B", "width")];
const POCKET: [Argument; 3] = [
    OFFSET,
    length("B", "width along X"),
    length("C", "width along Y"),
];
const BLOCK: [Argument; 4] = [
    OFFSET,
    length("B", "width along X"),
    length("C", "width along Y"),
    length("D", "way down"),
];
const INSIDE: [Argument; 3] = [
    OFFSET,
    plain("B", "corner, 1 to 4"),
    length("C", "distance"),
];
const OUTSIDE: [Argument; 4] = [
    OFFSET,
    plain("B", "corner, 1 to 4"),
    length("C", "distance"),
    length("D", "way down"),
];
const PLACE: [Argument; 3] = [
    length("X", "place along X"),
    length("Y", "place along Y"),
    length("Z", "place along Z"),
];

pub static LNC: [Call; 14] = [
    lnc("G65 \"PROBEX\"", "single surface across X", &SINGLE),
    lnc("G65 \"PROBEY\"", "single surface across Y", &SINGLE),
    lnc("G65 \"PROBEZ\"", "single surface across Z", &SINGLE),
    lnc("G65 \"PROBEBORE\"", "bore", &BORE),
    lnc("G65 \"PROBECIRCULARBOSS\"", "circular boss", &BOSS),
    lnc("G65 \"PROBEXWEB\"", "web across X", &WEB),
    lnc("G65 \"PROBEYWEB\"", "web across Y", &WEB),
    lnc("G65 \"PROBESLOTX\"", "slot across X", &SLOT),
    lnc("G65 \"PROBESLOTY\"", "slot across Y", &SLOT),
    lnc(
        "G65 \"PROBERECTANGULARPOCKET\"",
        "rectangular pocket",
        &POCKET,
    ),
    lnc("G65 \"PROBERECTANGULARBOSS\"", "rectangular boss", &BLOCK),
    lnc("G65 \"PROBEINSIDECORNER\"", "inside corner", &INSIDE),
    lnc("G65 \"PROBEOUTSIDECORNER\"", "outside corner", &OUTSIDE),
    lnc(
        "G65 \"PROTECTEDMOVE\"",
        "protected positioning move",
        &PLACE,
    ),
];

const STARTS: [Argument; 10] = [
    length("J", "start along X, machine coordinates"),
    length("K", "start along Y, machine coordinates"),
    length("L", "start along Z, machine coordinates"),
    length("Z", "height of the touches"),
    length("H", "width or diameter"),
    length("I", "length"),
    plain("W", "work offset that is written, from 0"),
    length("O", "overtravel"),
    length("T", "clearance to the surface"),
    length("C", "clearance to the corner"),
];

const fn rrf(name: &'static str, title: &'static str) -> Call {
    Call {
        name,
        title,
        arguments: &STARTS,
        shared: &[],
        needs: &[],
        excludes: &[],
        mark: Mark::Sourced,
        source: "the macro set's own files",
    }
}

pub static MILLENNIUM: [Call; 14] = [
    rrf("G6500", "hole, asked for step by step"),
    rrf("G6500.1", "hole, three touches"),
    rrf("G6501", "boss, asked for step by step"),
    rrf("G6501.1", "circular boss"),
    rrf("G6502", "rectangular pocket, asked for step by step"),
    rrf("G6502.1", "rectangular pocket"),
    rrf("G6503", "rectangular block, asked for step by step"),
    rrf("G6503.1", "rectangular block"),
    rrf("G6504.1", "web, along one axis"),
    rrf("G6505.1", "pocket along one axis"),
    rrf("G6508", "outside corner, asked for step by step"),
    rrf("G6508.1", "outside corner"),
    rrf("G6510", "single surface, asked for step by step"),
    rrf("G6510.1", "single surface"),
];

const FIRMWARE: &str = "the firmware's own source and its test of the cycles";

const RADII: [Argument; 14] = [
    length("X", "way of the touches along X, from the middle"),
    length("Y", "way of the touches along Y, from the middle"),
    length("Z", "way of the touch along Z"),
    length(
        "E",
        "way down from the top to the touches; of M465 the distance of the two touches",
    ),
    length("H", "way down before probing"),
    length("C", "clearance"),
    angle("Q", "angle that is added to the one in force"),
    feed("F", "feed of the touches"),
    feed("K", "feed of the way between"),
    plain("L", "how often the last touch is repeated"),
    length("R", "way back from a touch"),
    plain("S", "1: the place becomes the origin"),
    length("D", "diameter of the ball"),
    plain("I", "1: the input of the probe is inverted"),
];

const fn carvera(name: &'static str, title: &'static str, needs: &'static [&'static str]) -> Call {
    Call {
        name,
        title,
        arguments: &RADII,
        shared: &[],
        needs,
        excludes: &[],
        mark: Mark::Sourced,
        source: FIRMWARE,
    }
}

pub static CARVERA: [Call; 7] = [
    carvera("M460", "calibrates the ball", &["X Y"]),
    carvera("M461", "bore or pocket, from its middle", &["X Y"]),
    carvera("M462", "boss or block, from above its middle", &["X Y"]),
    carvera("M463", "inside corner", &["X", "Y"]),
    carvera("M464", "outside corner", &["X", "Y"]),
    carvera("M465", "angle of a wall, two touches", &["X Y"]),
    carvera("M466", "single axis", &["X Y Z"]),
];

const AXIS: Argument = plain("A", "axis: 1 X, 2 Y, 3 Z").within(1.0, 3.0);
const BOTH: Argument = plain("C", "1: both axes, one after the other").within(1.0, 1.0);
const SEARCH: Argument = length("Q", "how far the touch searches behind the nominal surface");
const DOWN: Argument = length("Z", "height of the touches, absolute: to go down beside it");
const ASIDE: Argument = length("R", "side clearance; negative: inside, over an island");
const ALONG_X: Argument = length("X", "surface or width along X");
const ALONG_Y: Argument = length("Y", "surface or width along Y");
const PLACES: [Argument; 7] = [
    plain("A", "1: X is given").within(1.0, 1.0),
    plain("B", "2: Y is given").within(2.0, 2.0),
    plain("C", "3: Z is given").within(3.0, 3.0),
    length("X", "place along X"),
    length("Y", "place along Y"),
    length("Z", "place along Z"),
    feed("F", "feed"),
];
const ONE: [Argument; 5] = [
    AXIS,
    ALONG_X,
    ALONG_Y,
    length("Z", "surface across Z"),
    SEARCH,
];
const WIDTH: [Argument; 7] = [AXIS, BOTH, ALONG_X, ALONG_Y, SEARCH, DOWN, ASIDE];
const ROUND: [Argument; 4] = [length("D", "diameter").positive(), SEARCH, DOWN, ASIDE];
const WALLS: [Argument; 3] = [
    length("X", "place of the wall across X"),
    length("Y", "place of the wall across Y"),
    SEARCH,
];
const SLOPE: [Argument; 6] = [
    AXIS,
    ALONG_X,
    ALONG_Y,
    length("D", "distance of the two touches").positive(),
    SEARCH,
    angle("B", "tolerance of the angle"),
];
const OFFSETS: [Argument; 1] = [plain(
    "S",
    "work offset that is written: 1 to 6, of the largest edition to 18",
)
.within(1.0, 18.0)];

const fn centroid(
    name: &'static str,
    title: &'static str,
    arguments: &'static [Argument],
    needs: &'static [&'static str],
) -> Call {
    Call {
        name,
        title,
        arguments,
        shared: &OFFSETS,
        needs,
        excludes: &[],
        mark: Mark::Sourced,
        source: "the documentation of the macros, which must be installed",
    }
}

/// Macros with Renishaw's numbers but other meanings: a letter names the axis, and a slot and a hole have their own numbers.
pub static CENTROID: [Call; 11] = [
    centroid(
        "G65 P9810",
        "protected positioning move",
        &PLACES,
        &["X Y Z"],
    ),
    centroid("G65 P9811", "single surface", &ONE, &["A", "X Y Z"]),
    centroid(
        "G65 P9812",
        "web, or with C1 a block",
        &WIDTH,
        &["A", "X Y"],
    ),
    centroid(
        "G65 P9813",
        "slot, or with C1 a rectangular pocket",
        &WIDTH,
        &["A", "X Y"],
    ),
    centroid("G65 P9814", "boss, four touches", &ROUND, &["D"]),
    centroid("G65 P9815", "inside corner", &WALLS, &["X", "Y"]),
    centroid("G65 P9816", "outside corner", &WALLS, &["X", "Y"]),
    centroid("G65 P9817", "hole, four touches", &ROUND, &["D"]),
    centroid(
        "G65 P9843",
        "angle of a wall, two touches",
        &SLOPE,
        &["A", "X Y", "D"],
    ),
    centroid("G65 P9832", "switches the probe on", &[], &[]),
    centroid(
        "G65 P9833",
        "switches the probe off, and shows the error",
        &[],
        &[],
    ),
];
