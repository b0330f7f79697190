//! SINUMERIK's measuring cycles, by the places of their arguments (Operate style, up to 29).

use super::{Argument, Call, Mark, angle, length, plain};

const SOURCE: &str = "two generators of the control's own strings, and posts that write them";

const HOLE: [Argument; 21] = [
    plain(
        "1",
        "variant: units 1 hole, 2 shaft, 3 groove, 4 web, 5 and 6 rectangle in- and outside; hundreds: corrects; thousands: protection zone",
    ),
    plain(
        "2",
        "where the correction goes: 9000 active offset, 10000 + n for n of the settable ones",
    ),
    plain("4", "probe data set").within(1.0, 10.0),
    length("5", "diameter or width").positive(),
    length("6", "first side of a rectangle").positive(),
    length("7", "second side of a rectangle").positive(),
    length("8", "measuring path: as far before as behind the surface").positive(),
    length("9", "safe area: by how much the place may be off"),
    angle("10", "angle of the first touch").within(-359.0, 359.0),
    length("11", "way down to the touches, positive"),
    length("12", "protection zone, first axis"),
    length("13", "protection zone, second axis"),
    plain("14", "measuring axis of a groove or web: 1 first, 2 second").within(1.0, 2.0),
    plain("15", "number of measurements at a place"),
    length("19", "tolerance"),
    length("20", "upper limit"),
    length("21", "lower limit"),
    length("22", "experience or zero-offset range"),
    plain("27", "1: the centre is at 0, 0; 11: it follows"),
    length("28", "centre, first axis"),
    length("29", "centre, second axis"),
];

const EDGE: [Argument; 8] = [
    plain("1", "variant: 0 measures, 100 corrects"),
    plain("2", "where the correction goes"),
    plain("4", "probe data set").within(1.0, 10.0),
    length("5", "place of the surface"),
    length("6", "measuring path"),
    length("7", "safe area"),
    plain("8", "axis: 1 first, 2 second, 3 tool axis").within(1.0, 3.0),
    plain("9", "direction: 1 plus, 2 minus").within(1.0, 2.0),
];

const ANGLE: [Argument; 8] = [
    plain("1", "variant: 105"),
    plain("2", "where the correction goes"),
    plain("4", "probe data set").within(1.0, 10.0),
    length("8", "measuring path"),
    angle("9", "safe area"),
    plain(
        "10",
        "axes: 201 measures X and steps along Y, 102 the other way, 103 on a tilted face",
    ),
    plain("11", "direction: 1 plus, 2 minus"),
    length("12", "distance of the two touches"),
];

const fn cycle(name: &'static str, title: &'static str, arguments: &'static [Argument]) -> Call {
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

const fn recalled(name: &'static str, title: &'static str) -> Call {
    Call {
        mark: Mark::Recalled,
        source: "recalled: title only",
        ..cycle(name, title, &[])
    }
}

pub static CALLS: [Call; 8] = [
    recalled("CYCLE961", "corner"),
    cycle("CYCLE977", "hole, shaft, groove, web or rectangle", &HOLE),
    cycle("CYCLE978", "single surface", &EDGE),
    recalled("CYCLE979", "hole or shaft by a segment"),
    cycle("CYCLE998", "angle of a wall, two touches", &ANGLE),
    recalled("CYCLE976", "calibrates the probe"),
    recalled("CYCLE996", "measures rotary axes"),
    recalled("CYCLE997", "ball"),
];
