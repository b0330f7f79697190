//! Renishaw's macros, and those of Haas that call them.

use super::{Argument, CORRECTED, Call, Mark, angle, feed, length, plain};

/// Letters of every measuring macro. A letter is given only if it is wanted: its presence may stop the program.
const SHARED: [Argument; 11] = [
    length(
        "Q",
        "how far the touch searches behind the nominal surface, by the ball's centre; 5 mm unless it is given",
    ),
    length("H", "tolerance of the size"),
    length(
        "M",
        "tolerance of the position, the whole zone: half of it to each side",
    ),
    angle("B", "tolerance of the angle"),
    plain("T", CORRECTED),
    plain("F", "share of the error that the correction takes").within(0.0, 1.0),
    length("V", "error up to which nothing is corrected"),
    plain("W", "prints: 1 the next feature, 2 the next part").within(1.0, 2.0),
    plain(
        "S",
        "work offset that is written: 1 to 6 for G54 to G59, 101 and following for G54.1 P1, on a Haas 154.01 for G154 P1",
    ),
    length("U", "error above which the program stops"),
    plain("E", "tool offset whose value is added to the size"),
];

const CLEARANCE: Argument = length(
    "R",
    "side clearance, from the surface of the ball; negative: inside, over an island or a protection zone",
);
const HEIGHT: Argument = length(
    "Z",
    "height of the touches, absolute: the feature is outside, or one to go down beside",
);
const SOURCE: &str = "the maker's macros (interface), and posts that write them";

const fn measures(name: &'static str, title: &'static str, arguments: &'static [Argument]) -> Call {
    Call {
        name,
        title,
        arguments,
        shared: &SHARED,
        needs: &[],
        excludes: &[],
        mark: Mark::Sourced,
        source: SOURCE,
    }
}

const fn moves(name: &'static str, title: &'static str, arguments: &'static [Argument]) -> Call {
    Call {
        name,
        title,
        arguments,
        shared: &[],
        needs: &[],
        excludes: &[],
        mark: Mark::Sourced,
        source: SOURCE,
    }
}

const X: Argument = length("X", "place along X");
const Y: Argument = length("Y", "place along Y");
const Z: Argument = length("Z", "place along Z");
const PLACES: [Argument; 5] = [
    X,
    Y,
    Z,
    feed("F", "feed"),
    plain("M", "1: a contact sets a flag and does not stop").within(1.0, 1.0),
];
const SURFACE: [Argument; 3] = [
    length("X", "place of the surface along X"),
    length("Y", "place of the surface along Y"),
    length("Z", "place of the surface along Z"),
];
const WIDTHS: [Argument; 4] = [
    length("X", "width along X").positive(),
    length("Y", "width along Y").positive(),
    HEIGHT,
    CLEARANCE,
];
const ROUND: [Argument; 3] = [length("D", "diameter").positive(), HEIGHT, CLEARANCE];
const CORNER: [Argument; 4] = [
    length("X", "place of the wall across X"),
    length("Y", "place of the wall across Y"),
    length("I", "way along X to a second touch of the Y wall"),
    length("J", "way along Y to a second touch of the X wall"),
];
const THREE: [Argument; 6] = [
    angle("A", "direction of the first touch"),
    angle(
        "B",
        "direction of the second touch; in this macro no tolerance",
    ),
    angle("C", "direction of the third touch"),
    length("D", "diameter").positive(),
    HEIGHT,
    CLEARANCE,
];
const WALL: [Argument; 4] = [
    length("X", "place of the wall along X"),
    length("Y", "place of the wall along Y"),
    length("D", "distance of the two touches").positive(),
    angle(
        "A",
        "nominal angle; 90 for a wall across X and 0 for one across Y unless it is given",
    ),
];
const PITCH: [Argument; 7] = [
    angle("A", "direction of the first hole"),
    plain("B", "number of holes; in this macro no tolerance"),
    length("C", "pitch diameter").positive(),
    length("D", "diameter of the holes").positive(),
    length("K", "absolute height of the touches, in holes"),
    HEIGHT,
    CLEARANCE,
];
const TURNED: [Argument; 2] = [
    angle("A", "direction of the touch, from X+"),
    length(
        "D",
        "distance from the start to the surface along that direction",
    ),
];
const TURNED_WIDTH: [Argument; 4] = [
    angle(
        "A",
        "angle of the wall's line; the touches are at 90 degrees to it",
    ),
    length("D", "width").positive(),
    HEIGHT,
    CLEARANCE,
];
const BETWEEN: [Argument; 5] = [
    length("X", "distance along X"),
    length("Y", "distance along Y"),
    length("Z", "distance along Z"),
    angle("A", "angle of the line between the features"),
    length("D", "distance of the features"),
];
const FOURTH: [Argument; 3] = [
    length("X", "distance of the two touches along X"),
    length("Y", "distance of the two touches along Y"),
    length("Z", "height of the touched surface"),
];
const STOCK: [Argument; 6] = [
    length("X", "surface across X"),
    length("Y", "surface across Y"),
    length("Z", "surface across Z"),
    length("I", "a further place"),
    length("J", "a further place"),
    length("K", "a further place"),
];
const MEAN: [Argument; 6] = [
    plain("T", CORRECTED),
    plain("M", "tool offsets that keep the values"),
    plain("C", "number of parts for the mean, 3 unless it is given"),
    length("V", "error up to which nothing is corrected"),
    plain("F", "share of the error"),
    length("Z", "what the error is counted from"),
];
const CALIBRATES: [Argument; 3] = [
    length("D", "diameter of the ring or pin"),
    length("Z", "height, on a pin"),
    length("R", "side clearance, on a pin"),
];
const CALIBRATES_LENGTH: [Argument; 2] = [
    plain("T", "tool of the probe, by its offset"),
    length("Z", "place of the surface"),
];

pub static CALLS: [Call; 22] = [
    moves(
        "G65 P9801",
        "calibrates the probe's length",
        &CALIBRATES_LENGTH,
    ),
    moves(
        "G65 P9802",
        "calibrates the stylus offset in X and Y",
        &CALIBRATES,
    ),
    moves("G65 P9803", "calibrates the ball's radius", &CALIBRATES),
    moves(
        "G65 P9804",
        "calibrates the ball's radius by directions",
        &CALIBRATES,
    ),
    Call {
        needs: &["X Y Z"],
        ..moves("G65 P9810", "protected positioning move", &PLACES)
    },
    Call {
        needs: &["X Y Z"],
        excludes: &[("S", "T"), ("T", "M"), ("S", "H")],
        ..measures("G65 P9811", "single surface", &SURFACE)
    },
    Call {
        needs: &["X Y"],
        excludes: &[("X", "Y")],
        ..measures("G65 P9812", "web or slot", &WIDTHS)
    },
    Call {
        needs: &["D"],
        ..measures("G65 P9814", "hole or boss, four touches", &ROUND)
    },
    Call {
        needs: &["X", "Y"],
        excludes: &[("X", "H")],
        ..measures("G65 P9815", "inside corner", &CORNER)
    },
    Call {
        needs: &["X", "Y"],
        excludes: &[("X", "H")],
        ..measures("G65 P9816", "outside corner", &CORNER)
    },
    Call {
        excludes: &[("X", "Y")],
        needs: &["X Y"],
        ..measures(
            "G65 P9817",
            "fourth axis by two touches along X or Y",
            &FOURTH,
        )
    },
    Call {
        excludes: &[("X", "Y")],
        needs: &["X Y"],
        ..measures(
            "G65 P9818",
            "fourth axis by two touches, the other way",
            &FOURTH,
        )
    },
    Call {
        needs: &["C", "D"],
        ..measures("G65 P9819", "holes or bosses on a pitch circle", &PITCH)
    },
    measures(
        "G65 P9820",
        "stock: largest and smallest of several touches",
        &STOCK,
    ),
    Call {
        needs: &["A", "D"],
        excludes: &[("S", "H"), ("T", "M"), ("S", "T")],
        ..measures("G65 P9821", "turned surface", &TURNED)
    },
    Call {
        needs: &["A", "D"],
        ..measures("G65 P9822", "turned web or slot", &TURNED_WIDTH)
    },
    Call {
        needs: &["A", "B", "C", "D"],
        ..measures("G65 P9823", "hole or boss, three touches", &THREE)
    },
    moves("G65 P9832", "switches the probe on", &[]),
    moves("G65 P9833", "switches the probe off", &[]),
    Call {
        excludes: &[
            ("S", "T"),
            ("T", "M"),
            ("S", "H"),
            ("Z", "X"),
            ("Z", "Y"),
            ("A", "X"),
            ("A", "Y"),
        ],
        ..measures(
            "G65 P9834",
            "from feature to feature; alone it keeps the last one",
            &BETWEEN,
        )
    },
    moves(
        "G65 P9835",
        "corrects a tool by the mean of several parts",
        &MEAN,
    ),
    Call {
        needs: &["X Y", "D"],
        excludes: &[("X", "Y")],
        ..measures("G65 P9843", "angle of a wall, two touches", &WALL)
    },
];

const SHARED_ON_MAZAK: [Argument; 11] = [
    length(
        "Q",
        "how far the touch searches behind the nominal surface, by the ball's centre; 10 mm unless it is given, 5 along Z",
    ),
    SHARED[1],
    SHARED[2],
    SHARED[3],
    SHARED[4],
    SHARED[5],
    SHARED[6],
    SHARED[7],
    plain(
        "S",
        "work offset that is written: 1 to 6 for G54 to G59, 7 for the WPC, 101 to 400 for G54.1 P1 to P300",
    ),
    SHARED[9],
    SHARED[10],
];
const ON_MAZAK: &str =
    "one shop's program for this edition, written with the macros and the maker's manual";

const fn on_mazak(
    name: &'static str,
    title: &'static str,
    arguments: &'static [Argument],
    needs: &'static [&'static str],
) -> Call {
    Call {
        shared: &SHARED_ON_MAZAK,
        needs,
        source: ON_MAZAK,
        ..measures(name, title, arguments)
    }
}

const CALIBRATES_ON_MAZAK: [Argument; 6] = [
    plain(
        "K",
        "what: 0 centre of a ring, 1 length, 2 stylus offset, 3 and radii, 4 and radii by direction, 5 all of it on a sphere; −3 and −4 without the offset",
    )
    .within(-4.0, 5.0),
    length("D", "diameter of the ring or sphere").positive(),
    length("B", "diameter of the ball; in this macro no tolerance").positive(),
    length("Z", "place of the surface, or of the sphere's centre"),
    plain(
        "T",
        "tool of the probe, with its suffix: 1.01 is 1 A, 1.24 is 1 Z",
    ),
    plain("M", "180: finds the true centre first, by half a turn of the spindle")
        .within(180.0, 180.0),
];
const RECTANGLE: [Argument; 6] = [
    length("D", "side along X").positive(),
    length("E", "side along Y").positive(),
    plain(
        "A",
        "side with two touches: 11 X+, 12 Y+, 13 X−, 14 Y−; 14 unless it is given",
    )
    .within(11.0, 14.0),
    length(
        "T",
        "distance of these two touches, a quarter of the side unless it is given; in this macro no tool",
    )
    .positive(),
    HEIGHT,
    CLEARANCE,
];
const SQUARES: [Argument; 3] = [
    plain("K", "2: two touches along Z, apart along X"),
    length("X", "distance of the two touches along X").positive(),
    length("Z", "height of the touched surface"),
];

/// Calls that differ in the edition A-4013-0113 for Mazak.
pub static MAZAK: [Call; 3] = [
    on_mazak(
        "G65 P9801",
        "calibrates the probe",
        &CALIBRATES_ON_MAZAK,
        &["K", "B"],
    ),
    on_mazak(
        "G65 P9817",
        "rectangle: four sides and its angle",
        &RECTANGLE,
        &["D", "E"],
    ),
    on_mazak(
        "G65 P9818",
        "turns the B axis until a surface is square",
        &SQUARES,
        &["K", "X", "Z"],
    ),
];

const SCREEN: [Argument; 4] = [
    plain(
        "A",
        "what: 0 to 2 tool length, 10 bore, 11 boss, 12 and 13 rectangle in- and outside, 14 and 16 web in X and Y, 15 and 17 pocket, 18 and 19 corner out- and inside, 20 surface, 21 vice corner",
    ),
    plain(
        "W",
        "work offset that is written: 54 to 59, 110 to 129, 154.01 to 154.99",
    ),
    length("D", "size"),
    length("Z", "way down, negative"),
];
const EDITION: [Argument; 5] = [
    plain(
        "A",
        "what: 1 bore, 2 boss, 3 slot, 4 web, 5 to 9 surface in X+, X−, Y+, Y−, Z, 10 calibration, 12 and 13 tool, 14 and 15 corner in- and outside, 16 middle of a block, 17 and 18 vice, 19 to 25 tools",
    ),
    plain("S", "work offset that is written: 54 to 59, 110 to 155"),
    length("D", "diameter").positive(),
    length("Z", "way down, negative"),
    plain("B", "corner, 1 to 4"),
];

pub static HAAS: [Call; 2] = [
    Call {
        needs: &["A"],
        ..moves(
            "G65 P9995",
            "probing screen: measures and writes the work offset",
            &SCREEN,
        )
    },
    Call {
        needs: &["A"],
        ..moves(
            "G65 P9023",
            "probing screen of another edition: its numbers are not those of P9995",
            &EDITION,
        )
    },
];
