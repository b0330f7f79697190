//! Web: ENCY / SprutCAM type 9.
//!
//! A rib, touched on both sides.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, PairProtected, words};
use crate::form::Section;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "web",
    title: "Web",
    says: "A rib from both sides: its middle and its width.",
    also: "rib ridge bar wall outside width",
    name: "WEB",
    source: "ENCY/SprutCAM type 9",
    probes: Subject::Web,
    number: Some(9),
    most_touches: 2,
    fields: PairProtected::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: over the middle, top clearance above the top side",
        "Steps 2 to 6 for the second touch point",
    ),
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::PAIR,
        words::COSINE_OUTSIDE,
        words::SINGLE,
    ],
    read: |def, section| ency::read(def, section, "web probing", dimensions),
    ..ency::BASE
};

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    PairProtected::read(section).dimensions(false)
}
