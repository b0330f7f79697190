//! External rectangle: ENCY / SprutCAM type 8.
//!
//! A block, touched from outside, one touch a wall.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, RectangleProtected, Shape, words};
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "external-rectangle",
    title: "External rectangle",
    name: "BLOCK",
    source: "ENCY/SprutCAM type 8",
    probes: Subject::Block,
    own_feeds: false,
    number: Some(8),
    most_touches: 4,
    doc: "docs/cycles/external-rectangle.md",
    fields: RectangleProtected::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(RectangleProtected::read(section), shape, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: over the centre, top clearance above the top side",
        words::OVER,
        words::DOWN,
        words::TOUCH,
        words::UP,
        words::BACK,
        "Steps 2 to 6 three times more, once for each touch point that is left",
        words::LIFT,
    ],
    readings: &[words::HEIGHTS, words::NORMAL, words::FEEDS, words::COMPENSATION, words::RECTANGLE, words::COSINE_OUTSIDE],
    read: |section| {
        let form = RectangleProtected::read(section);
        ency::read(section, &DEF, "external rectangle probing", form, shape)
    },
};

fn shape(form: &RectangleProtected) -> Box<dyn Shape> {
    form.shape(false)
}
