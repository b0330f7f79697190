//! External rectangle: ENCY / SprutCAM type 8.
//!
//! A block, touched from outside, one touch a wall.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, RectangleProtected, words};
use crate::form::Section;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "external-rectangle",
    title: "External rectangle",
    says: "A block or an island from outside: centre, length and width.",
    also: "island block stock part outside vise",
    name: "BLOCK",
    source: "ENCY/SprutCAM type 8",
    probes: Subject::Block,
    number: Some(8),
    most_touches: 4,
    fields: RectangleProtected::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: over the centre, top clearance above the top side",
        "Steps 2 to 6 three times more, once for each touch point that is left",
    ),
    readings: &[words::HEIGHTS, words::NORMAL, words::FEEDS, words::COMPENSATION, words::RECTANGLE, words::COSINE_OUTSIDE],
    read: |def, section| ency::read(def, section, "external rectangle probing", dimensions),
    ..ency::BASE
};

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    RectangleProtected::read(section).dimensions(false)
}
