//! Groove, protected: ENCY / SprutCAM type 12.
//!
//! Both walls of a groove, each touch entered from above.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, PairProtected, Shape, words};
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "groove-protected",
    title: "Groove, protected",
    name: "GROOVE",
    source: "ENCY/SprutCAM type 12",
    probes: Subject::GrooveProtected,
    own_feeds: false,
    number: Some(12),
    most_touches: 2,
    doc: "docs/cycles/groove-protected.md",
    fields: PairProtected::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(PairProtected::read(section), shape, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: the middle, top clearance above the top side",
        words::OVER,
        words::DOWN,
        words::TOUCH,
        words::UP,
        words::BACK,
        "Steps 2 to 6 for the second touch point",
        words::LIFT,
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::PAIR,
        words::COSINE_INSIDE,
        words::SINGLE,
    ],
    read: |section| {
        let form = PairProtected::read(section);
        ency::read(section, &DEF, "groove probing protected", form, shape)
    },
};

fn shape(form: &PairProtected) -> Box<dyn Shape> {
    form.shape(true)
}
