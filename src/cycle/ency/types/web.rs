//! Web: ENCY / SprutCAM type 9.
//!
//! A rib, touched on both sides.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, PairProtected, Shape, words};
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "web",
    title: "Web",
    name: "WEB",
    source: "ENCY/SprutCAM type 9",
    probes: Subject::Web,
    own_feeds: false,
    number: Some(9),
    most_touches: 2,
    doc: "docs/cycles/web.md",
    fields: PairProtected::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(PairProtected::read(section), shape, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: over the middle, top clearance above the top side",
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
        words::COSINE_OUTSIDE,
        words::SINGLE,
    ],
    read: |section| {
        let form = PairProtected::read(section);
        ency::read(section, &DEF, "web probing", form, shape)
    },
};

fn shape(form: &PairProtected) -> Box<dyn Shape> {
    form.shape(false)
}
