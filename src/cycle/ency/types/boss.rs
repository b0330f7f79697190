//! Boss: ENCY / SprutCAM type 5.
//!
//! A stud, touched from outside.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, RoundProtected, Shape, words};
use crate::path::{MAX_TOUCHES, Subject};

pub static DEF: CycleDef = CycleDef {
    key: "boss",
    title: "Boss",
    name: "BOSS",
    source: "ENCY/SprutCAM type 5",
    probes: Subject::Boss,
    own_feeds: false,
    number: Some(5),
    most_touches: MAX_TOUCHES,
    doc: "docs/cycles/boss.md",
    fields: RoundProtected::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(RoundProtected::read(section), shape, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: over the centre, top clearance above the top side",
        words::OVER,
        words::DOWN,
        words::TOUCH,
        words::UP,
        words::BACK,
        "Steps 2 to 6 once more for each touch point that is left",
        words::LIFT,
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        words::AS_MANY,
        words::RECTANGULAR,
        words::ANGULAR,
        words::VARIANT,
        words::CIRCLE,
    ],
    read: |section| {
        let form = RoundProtected::read(section);
        ency::read(section, &DEF, "boss probing", form, shape)
    },
};

fn shape(form: &RoundProtected) -> Box<dyn Shape> {
    form.shape(false)
}
