//! Internal rectangle, protected: ENCY / SprutCAM type 7.
//!
//! Four touches from inside, one a wall, each entered from above, so that an island in the middle is not met.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, RectangleProtected, words};
use crate::form::Section;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "internal-rectangle-protected",
    title: "Internal rectangle, protected",
    says: "A pocket with something standing in the middle: the probe goes up and over it between the touches.",
    also: "pocket window island inside over",
    name: "POCKET",
    source: "ENCY/SprutCAM type 7",
    probes: Subject::PocketProtected,
    number: Some(7),
    most_touches: 4,
    fields: RectangleProtected::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: the centre, top clearance above the top side",
        "Steps 2 to 6 three times more, once for each touch point that is left",
    ),
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::THREE_MORE,
        words::RECTANGLE,
        words::COSINE_INSIDE,
    ],
    read: |def, section| ency::read(def, section, "internal rectangle probing protected", dimensions),
    ..ency::BASE
};

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    RectangleProtected::read(section).dimensions(true)
}
