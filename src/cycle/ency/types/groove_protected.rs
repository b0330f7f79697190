//! Groove, protected: ENCY / SprutCAM type 12.
//!
//! Both walls of a groove, each touch entered from above.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, PairProtected, words};
use crate::form::Section;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "groove-protected",
    title: "Groove, protected",
    says: "A slot with something standing in it: the probe goes up and over it between the touches.",
    also: "slot keyway channel gap island inside width over",
    name: "GROOVE",
    source: "ENCY/SprutCAM type 12",
    probes: Subject::GrooveProtected,
    number: Some(12),
    most_touches: 2,
    fields: PairProtected::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: the middle, top clearance above the top side",
        "Steps 2 to 6 for the second touch point",
    ),
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::PAIR,
        words::COSINE_INSIDE,
        words::SINGLE,
    ],
    read: |def, section| ency::read(def, section, "groove probing protected", dimensions),
    ..ency::BASE
};

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    PairProtected::read(section).dimensions(true)
}
