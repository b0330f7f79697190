//! Calls of smaller controls.

use super::{Argument, Call, Mark, Unit, angle, length, plain};

const MACROS: &str = "the maker's own macro set for a CAM system";

const OFFSET: Argument = plain("A", "work offset that is written: 54 is G54, 54.5 the fifth of the extended ones");

const fn lnc(name: &'static str, title: &'static str, arguments: &'static [Argument]) -> Call {
    Call { name, title, arguments, shared: &[], needs: &[], excludes: &[], mark: Mark::Sourced, source: MACROS }
}

const SINGLE: [Argument; 2] = [OFFSET, length("B", "distance to the surface, signed")];
const BORE: [Argument; 3] = [OFFSET, length("B", "diameter"), length("Q", "overtravel")];
const BOSS: [Argument; 3] = [OFFSET, length("B", "diameter"), length("C", "way down")];
const WEB: [Argument; 3] = [OFFSET, length("B", "width"), length("C", "way down")];
const SLOT: [Argument; 2] = [OFFSET, length("B", "width")];
const POCKET: [Argument; 3] = [OFFSET, length("B", "width along X"), length("C", "width along Y")];
const BLOCK: [Argument; 4] = [OFFSET, length("B", "width along X"), length("C", "width along Y"), length("D", "way down")];
const INSIDE: [Argument; 3] = [OFFSET, plain("B", "corner, 1 to 4"), length("C", "distance")];
const OUTSIDE: [Argument; 4] = [OFFSET, plain("B", "corner, 1 to 4"), length("C", "distance"), length("D", "way down")];
const PLACE: [Argument; 3] = [length("X", "place along X"), length("Y", "place along Y"), length("Z", "place along Z")];

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
    lnc("G65 \"PROBERECTANGULARPOCKET\"", "rectangular pocket", &POCKET),
    lnc("G65 \"PROBERECTANGULARBOSS\"", "rectangular boss", &BLOCK),
    lnc("G65 \"PROBEINSIDECORNER\"", "inside corner", &INSIDE),
    lnc("G65 \"PROBEOUTSIDECORNER\"", "outside corner", &OUTSIDE),
    lnc("G65 \"PROTECTEDMOVE\"", "protected positioning move", &PLACE),
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
    length("E", "way down from the top to the touches; of M465 the distance of the two touches"),
    length("H", "way down before probing"),
    length("C", "clearance"),
    angle("Q", "angle that is added to the one in force"),
    Argument { name: "F", meaning: "feed of the touches", unit: Unit::Feed },
    Argument { name: "K", meaning: "feed of the way between", unit: Unit::Feed },
    plain("L", "how often the last touch is repeated"),
    length("R", "way back from a touch"),
    plain("S", "1: the place becomes the origin"),
    length("D", "diameter of the ball"),
    plain("I", "1: the input of the probe is inverted"),
];

const fn carvera(name: &'static str, title: &'static str, needs: &'static [&'static str]) -> Call {
    Call { name, title, arguments: &RADII, shared: &[], needs, excludes: &[], mark: Mark::Sourced, source: FIRMWARE }
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
