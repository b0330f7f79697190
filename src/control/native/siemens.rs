//! SINUMERIK's measuring cycles, by the positions of their arguments (Operate style, up to 29).

use super::rows::{Is, Row, Shape, Words};
use super::{Argument, Call, Mark, angle, length, plain};
use crate::path::Quantity;

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

const fn number(x: f64) -> Is {
    Is::Always(Quantity::Plain(x))
}

const fn length_of(x: f64) -> Is {
    Is::Always(Quantity::Length(x))
}

const PATH: Words = &[
    (8, Is::SetUp),
    (9, Is::Safe),
    (10, Is::Turn),
    (11, Is::Down),
    (12, Is::Zone(0)),
];
/// Tolerances of every call, then the words of a correction.
const TOLERANCES: Words = &[
    (15, number(1.0)),
    (18, number(0.0)),
    (19, length_of(1.01)),
    (20, length_of(1.01)),
    (21, length_of(-1.01)),
    (22, Is::Writing(Quantity::Length(0.34))),
    (23, Is::Writing(Quantity::Plain(1.0))),
    (24, Is::Writing(Quantity::Plain(0.0))),
];
const CENTRE: Words = &[
    (26, number(1.0)),
    (27, number(11.0)),
    (28, Is::Stated(0)),
    (29, Is::Stated(1)),
];
const MIDDLE: Words = &[(26, number(1.0)), (27, number(11.0)), (28, Is::StatedAlong)];
/// Target of the write, and the probe data set.
const OFFSET: Words = &[(2, Is::Row), (4, number(1.0))];
const SIZE: Words = &[(5, Is::Size(0))];
const SIDES: Words = &[(6, Is::Size(0)), (7, Is::Size(1))];
const SECOND: Words = &[(13, Is::Zone(1))];
const AXIS: Words = &[(14, Is::Axis)];

const fn feature((shape, inside): (Shape, bool), words: &'static [Words], results: Words) -> Row {
    Row {
        number: 977,
        head: "",
        shape,
        inside,
        writes: None,
        words,
        also: &[],
        results,
    }
}

const ROUND: Words = &[(5, Is::Center(0)), (6, Is::Center(1)), (4, Is::Size(0))];
const ACROSS: Words = &[(5, Is::Along), (4, Is::Size(0))];
const BOTH: Words = &[(5, Is::Center(0)), (6, Is::Center(1))];

/// CYCLE977 by its kinds, and CYCLE978. [S: two generators that copy the control's own editor; the storage of the results of a rectangle and a width is ours]
#[rustfmt::skip]
pub static ROWS: [Row; 7] = [
    feature((Shape::Bore, true), &[&[(1, Is::Variant(1))], OFFSET, SIZE, PATH, TOLERANCES, CENTRE], ROUND),
    feature((Shape::Bore, false), &[&[(1, Is::Variant(2))], OFFSET, SIZE, PATH, TOLERANCES, CENTRE], ROUND),
    feature((Shape::Width, true), &[&[(1, Is::Variant(3))], OFFSET, SIZE, PATH, AXIS, TOLERANCES, MIDDLE], ACROSS),
    feature((Shape::Width, false), &[&[(1, Is::Variant(4))], OFFSET, SIZE, PATH, AXIS, TOLERANCES, MIDDLE], ACROSS),
    feature((Shape::Rectangle, true), &[&[(1, Is::Variant(5))], OFFSET, SIDES, PATH, SECOND, TOLERANCES, CENTRE], BOTH),
    feature((Shape::Rectangle, false), &[&[(1, Is::Variant(6))], OFFSET, SIDES, PATH, SECOND, TOLERANCES, CENTRE], BOTH),
    Row {
        number: 978,
        words: &[&[(1, Is::Variant(0))], OFFSET, SURFACE],
        ..feature((Shape::Surface, false), &[], &[])
    },
];

/// A surface, with the tolerances of its call.
#[rustfmt::skip]
const SURFACE: Words = &[
    (5, Is::Along), (6, Is::SetUp), (7, Is::Safe), (8, Is::Axis), (9, Is::Facing), (10, number(1.0)),
    (13, number(0.0)), (14, length_of(1.01)), (15, length_of(1.01)), (16, length_of(-1.01)),
    (17, Is::Writing(Quantity::Length(0.34))), (18, Is::Writing(Quantity::Plain(1.0))), (19, Is::Writing(Quantity::Plain(0.0))),
    (21, number(1.0)), (22, number(1.0)),
];
