//! HEIDENHAIN's touch probe cycles 4xx and 14xx, by their Q parameters. The texts are ours, based on the control's dialog.

use super::rows::{Is, Row, Shape, Words};
use super::{Argument, CORRECTED, Call, Mark, angle, length, plain};
use crate::path::Quantity;

/// All Q parameters of the cycles; each cycle names its own.
const Q: [Argument; 62] = [
    angle("Q247", "step angle between touches"),
    length("Q260", "clearance height"),
    length("Q261", "height of the ball's centre at the touches"),
    length("Q262", "nominal diameter").positive(),
    length("Q263", "first point, first axis"),
    length("Q264", "first point, second axis"),
    length("Q265", "second point, first axis"),
    length("Q266", "second point, second axis"),
    plain("Q267", "direction of the touch: −1 or +1").within(-1.0, 1.0),
    plain("Q272", "measuring axis: 1 first, 2 second, 3 tool axis").within(1.0, 3.0),
    length("Q273", "centre, first axis"),
    length("Q274", "centre, second axis"),
    length("Q275", "largest size"),
    length("Q276", "smallest size"),
    length("Q277", "largest size"),
    length("Q278", "smallest size"),
    length("Q279", "tolerance of the centre, first axis"),
    length("Q280", "tolerance of the centre, second axis"),
    plain("Q281", "log: 0 none, 1 file, 2 stop and screen").within(0.0, 2.0),
    length("Q282", "first side"),
    length("Q283", "second side"),
    length("Q284", "largest first side"),
    length("Q285", "smallest first side"),
    length("Q286", "largest second side"),
    length("Q287", "smallest second side"),
    length("Q288", "largest size"),
    length("Q289", "smallest size"),
    length("Q294", "first point, third axis"),
    plain("Q301", "1: lifts to the clearance height between touches").within(0.0, 1.0),
    plain(
        "Q303",
        "where the value goes: 0 datum table, 1 preset table",
    ),
    plain("Q305", "row of the table; 0 is the active datum"),
    angle("Q307", "angle that the wall shall have"),
    plain("Q309", "1: stops out of tolerance"),
    length("Q310", "offset of the second touch"),
    length("Q311", "nominal width"),
    plain("Q312", "axis that compensates: 4 A, 5 B, 6 C"),
    length("Q320", "set-up clearance, added to that of the probe table"),
    length("Q321", "centre, first axis"),
    length("Q322", "centre, second axis"),
    length("Q323", "first side"),
    length("Q324", "second side"),
    angle("Q325", "angle of the first touch"),
    length("Q326", "spacing, first axis"),
    length("Q327", "spacing, second axis"),
    length("Q328", "start, first axis"),
    length("Q329", "start, second axis"),
    plain("Q330", CORRECTED),
    length("Q331", "value that the first axis shall get"),
    length("Q332", "value that the second axis shall get"),
    length("Q333", "value that the tool axis shall get"),
    plain("Q337", "1: sets the rotary axis to zero"),
    plain("Q365", "way between touches: 0 straight, 1 on an arc").within(0.0, 1.0),
    angle("Q380", "reference angle"),
    plain("Q381", "1: one more touch along the tool axis").within(0.0, 1.0),
    length("Q382", "its place, first axis"),
    length("Q383", "its place, second axis"),
    length("Q384", "its place, third axis"),
    length("Q405", "value that the centre shall get"),
    plain("Q423", "number of touches: 3 or 4").within(3.0, 4.0),
    plain("Q350", "kind of measurement"),
    plain("Q351", "extent of measurement"),
    length("Q359", "correction of the length"),
];

const POST: &str = "a post that the maker of the CAM system publishes, and posted programs";

const fn cycle(name: &'static str, title: &'static str) -> Call {
    Call {
        name,
        title,
        arguments: &Q,
        shared: &[],
        needs: &[],
        excludes: &[],
        mark: Mark::Sourced,
        source: POST,
    }
}

const fn recalled(name: &'static str, title: &'static str) -> Call {
    Call {
        mark: Mark::Recalled,
        source: "recalled: title only",
        ..cycle(name, title)
    }
}

pub static CALLS: [Call; 30] = [
    cycle("TCH PROBE 400", "basic rotation by two touches"),
    recalled("TCH PROBE 401", "basic rotation by two holes"),
    recalled("TCH PROBE 402", "basic rotation by two studs"),
    cycle("TCH PROBE 403", "rotary axis set by two touches"),
    recalled("TCH PROBE 404", "basic rotation set"),
    recalled("TCH PROBE 405", "rotation by a hole's centre"),
    cycle("TCH PROBE 408", "centre of a slot as datum"),
    cycle("TCH PROBE 409", "centre of a ridge as datum"),
    cycle("TCH PROBE 410", "centre of a rectangular pocket as datum"),
    cycle("TCH PROBE 411", "centre of a rectangular stud as datum"),
    cycle("TCH PROBE 412", "centre of a hole (inside circle) as datum"),
    cycle(
        "TCH PROBE 413",
        "centre of a stud (outside circle) as datum",
    ),
    recalled("TCH PROBE 414", "outside corner as datum"),
    recalled("TCH PROBE 415", "inside corner as datum"),
    recalled("TCH PROBE 416", "centre of a pitch circle as datum"),
    cycle("TCH PROBE 417", "surface across the tool axis as datum"),
    recalled(
        "TCH PROBE 418",
        "crossing of lines between four holes as datum",
    ),
    cycle("TCH PROBE 419", "one axis as datum"),
    cycle("TCH PROBE 420", "angle of a wall"),
    cycle("TCH PROBE 421", "hole, measured"),
    cycle("TCH PROBE 422", "stud, measured"),
    cycle("TCH PROBE 423", "rectangular pocket, measured"),
    cycle("TCH PROBE 424", "rectangular stud, measured"),
    cycle("TCH PROBE 425", "width of a slot"),
    cycle("TCH PROBE 426", "width of a ridge"),
    cycle("TCH PROBE 427", "one coordinate, measured"),
    recalled("TCH PROBE 430", "pitch circle, measured"),
    recalled("TCH PROBE 431", "plane by three touches"),
    Call {
        source: "the control's manual, cycle 1411",
        ..cycle("TCH PROBE 1411", "two circles: position and rotation")
    },
    Call {
        source: "the control's manual, cycle 1493",
        ..cycle(
            "TCH PROBE 1493",
            "touches of the next cycle along a line (extrusion)",
        )
    },
];

/// The row of a cycle that is read both ways.
pub fn row(number: u16) -> Option<&'static Row> {
    ROWS.iter().find(|row| row.number == number)
}

/// Positions of the touches: height, set-up clearance, clearance height.
const TOUCHES: Words = &[(261, Is::Center(2)), (320, Is::SetUp), (260, Is::High)];
const LIFTS: Words = &[(301, Is::Lifts)];
/// Centre of a feature, in a cycle that writes and in one that only measures.
const WRITTEN: Words = &[(321, Is::Center(0)), (322, Is::Center(1))];
const MEASURED: Words = &[(273, Is::Center(0)), (274, Is::Center(1))];
/// A circle.
const CIRCLE: Words = &[(262, Is::Size(0)), (325, Is::Start), (247, Is::Step)];
/// A width and its axis.
const WIDTH: Words = &[(311, Is::Size(0)), (272, Is::Axis)];
/// A contact, and the measurement of its coordinate.
const CONTACT: Words = &[(263, Is::Center(0)), (264, Is::Center(1))];
const DIRECTION: Words = &[(272, Is::Axis), (267, Is::Towards)];
/// Written row, and the touch along the tool axis, which is not made.
const TO_ROW: Words = &[(305, Is::Row)];
const CENTER: Words = &[(331, Is::Gets(0)), (332, Is::Gets(1))];
const COORDINATE: Words = &[(405, Is::GetsAlong)];
const PRESET: Words = &[(303, Is::Preset)];
const NO_TOP: Words = &[
    (381, Is::No),
    (382, ZERO),
    (383, ZERO),
    (384, ZERO),
    (333, ZERO),
];
/// A coordinate that has no meaning without that touch.
const ZERO: Is = Is::Always(Quantity::Length(0.0));
const SPREAD: Words = &[(423, Is::Count), (365, Is::Arcs)];
/// Limits of a cycle that only measures, and the tool that it corrects.
const PLACE: Words = &[(279, Is::Off), (280, Is::Off)];
const LOG: Words = &[(281, Is::Log)];
const ASKS_BOTH: Words = &[
    (
        309,
        Is::Stops {
            sizes: true,
            places: true,
        },
    ),
    (330, Is::Tool),
];
const ASKS_SIZE: Words = &[
    (
        309,
        Is::Stops {
            sizes: true,
            places: false,
        },
    ),
    (330, Is::Tool),
];
const ASKS_PLACE: Words = &[
    (
        309,
        Is::Stops {
            sizes: false,
            places: true,
        },
    ),
    (330, Is::Tool),
];
const OF_WIDTH: Words = &[(288, Is::Largest(0)), (289, Is::Smallest(0))];

const ROUND: Words = &[
    (151, Is::Center(0)),
    (152, Is::Center(1)),
    (153, Is::Size(0)),
];
const SIDES: Words = &[
    (151, Is::Center(0)),
    (152, Is::Center(1)),
    (154, Is::Size(0)),
    (155, Is::Size(1)),
];
const ACROSS: Words = &[(157, Is::Along), (156, Is::Size(0))];

const fn of(
    number: u16,
    head: &'static str,
    (shape, inside, writes): (Shape, bool, bool),
    words: &'static [Words],
    results: Words,
) -> Row {
    Row {
        number,
        head,
        shape,
        inside,
        writes: Some(writes),
        words,
        also: &[],
        results,
    }
}

/// Cycles that programs call and that are read as jobs. [S: posted programs for the order of the words and the heads, the control's pages for meaning]
#[rustfmt::skip]
pub static ROWS: [Row; 15] = [
    of(412, "DATUM INSIDE CIRCLE", (Shape::Bore, true, true),
        &[WRITTEN, CIRCLE, TOUCHES, LIFTS, TO_ROW, CENTER, PRESET, NO_TOP, SPREAD], ROUND),
    of(413, "DATUM OUTSIDE CIRCLE", (Shape::Bore, false, true),
        &[WRITTEN, CIRCLE, TOUCHES, LIFTS, TO_ROW, CENTER, PRESET, NO_TOP, SPREAD], ROUND),
    Row { also: SPREAD, ..of(421, "MEASURE HOLE", (Shape::Bore, true, false),
        &[MEASURED, CIRCLE, TOUCHES, LIFTS, &[(275, Is::Largest(0)), (276, Is::Smallest(0))], PLACE, LOG, ASKS_BOTH], ROUND) },
    Row { also: SPREAD, ..of(422, "MEAS. CIRCLE OUTSIDE", (Shape::Bore, false, false),
        &[MEASURED, CIRCLE, TOUCHES, LIFTS, &[(277, Is::Largest(0)), (278, Is::Smallest(0))], PLACE, LOG, ASKS_BOTH], ROUND) },
    of(410, "DATUM INSIDE RECTAN.", (Shape::Rectangle, true, true),
        &[WRITTEN, &[(323, Is::Size(0)), (324, Is::Size(1))], TOUCHES, LIFTS, TO_ROW, CENTER, PRESET, NO_TOP], SIDES),
    of(411, "DATUM OUTS. RECTAN.", (Shape::Rectangle, false, true),
        &[WRITTEN, &[(323, Is::Size(0)), (324, Is::Size(1))], TOUCHES, LIFTS, TO_ROW, CENTER, PRESET, NO_TOP], SIDES),
    of(423, "MEAS. RECTAN. INSIDE", (Shape::Rectangle, true, false), &[MEASURED, SIDES_OF, TOUCHES, LIFTS, OF_SIDES, PLACE, LOG, ASKS_BOTH], SIDES),
    of(424, "MEAS. RECTAN. OUTS.", (Shape::Rectangle, false, false), &[MEASURED, SIDES_OF, TOUCHES, LIFTS, OF_SIDES, PLACE, LOG, ASKS_BOTH], SIDES),
    of(408, "SLOT CENTER REF PT", (Shape::Width, true, true),
        &[WRITTEN, WIDTH, TOUCHES, LIFTS, TO_ROW, COORDINATE, PRESET, NO_TOP], &[]),
    of(409, "RIDGE CENTER REF PT", (Shape::Width, false, true),
        &[WRITTEN, WIDTH, TOUCHES, TO_ROW, COORDINATE, PRESET, NO_TOP], &[]),
    Row { also: &[(320, Is::SetUp), (301, Is::Lifts)], ..of(425, "MEASURE INSIDE WIDTH", (Shape::Width, true, false),
        &[&[(328, Is::Center(0)), (329, Is::Center(1)), (310, Is::Beside), (272, Is::Axis), (261, Is::Center(2)), (260, Is::High), (311, Is::Size(0))],
            OF_WIDTH, LOG, ASKS_SIZE], ACROSS) },
    of(426, "MEASURE RIDGE WIDTH", (Shape::Width, false, false),
        &[&[(263, Is::Edge(0, 0)), (264, Is::Edge(0, 1)), (265, Is::Edge(1, 0)), (266, Is::Edge(1, 1)), (272, Is::Axis)], TOUCHES, &[(311, Is::Size(0))],
            OF_WIDTH, LOG, ASKS_SIZE], ACROSS),
    of(417, "DATUM IN TS AXIS", (Shape::Surface, false, true),
        &[CONTACT, &[(294, Is::Center(2)), (320, Is::SetUp), (260, Is::High)], TO_ROW, &[(333, Is::GetsAlong)], PRESET], &[]),
    of(419, "DATUM IN ONE AXIS", (Shape::Surface, false, true),
        &[CONTACT, TOUCHES, DIRECTION, TO_ROW, &[(333, Is::GetsAlong)], PRESET], &[]),
    of(427, "MEASURE COORDINATE", (Shape::Surface, false, false),
        &[CONTACT, &[(261, Is::Center(2)), (320, Is::SetUp)], DIRECTION, &[(260, Is::High)], LOG, &[(288, Is::Highest), (289, Is::Lowest)], ASKS_PLACE],
        &[(160, Is::Along)]),
];

const SIDES_OF: Words = &[(282, Is::Size(0)), (283, Is::Size(1))];
const OF_SIDES: Words = &[
    (284, Is::Largest(0)),
    (285, Is::Smallest(0)),
    (286, Is::Largest(1)),
    (287, Is::Smallest(1)),
];
