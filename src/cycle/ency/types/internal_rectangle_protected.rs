//! Internal rectangle, protected: ENCY / SprutCAM type 7.
//!
//! Four touches from inside, one a wall, each entered from above, so that an island in the middle is not met.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, RectangleProtected, Shape, words};
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "internal-rectangle-protected",
    title: "Internal rectangle, protected",
    name: "POCKET",
    source: "ENCY/SprutCAM type 7",
    probes: Subject::PocketProtected,
    own_feeds: false,
    number: Some(7),
    most_touches: 4,
    doc: "docs/cycles/internal-rectangle-protected.md",
    fields: RectangleProtected::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(RectangleProtected::read(section), shape, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: the centre, top clearance above the top side",
        words::OVER,
        words::DOWN,
        words::TOUCH,
        words::UP,
        words::BACK,
        "Steps 2 to 6 three times more, once for each touch point that is left",
        words::LIFT,
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::THREE_MORE,
        words::RECTANGLE,
        words::COSINE_INSIDE,
    ],
    read: |section| {
        let form = RectangleProtected::read(section);
        ency::read(section, &DEF, "internal rectangle probing protected", form, shape)
    },
};

fn shape(form: &RectangleProtected) -> Box<dyn Shape> {
    form.shape(true)
}
