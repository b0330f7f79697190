//! Boss: ENCY / SprutCAM type 5.
//!
//! A stud, touched from outside.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, RoundProtected, words};
use crate::form::Section;
use crate::path::{MAX_TOUCHES, Subject};

pub static DEF: CycleDef = CycleDef {
    key: "boss",
    title: "Boss",
    says: "A stud, pin or shaft from outside: centre and diameter.",
    also: "stud pin shaft spigot outside diameter round",
    name: "BOSS",
    source: "ENCY/SprutCAM type 5",
    probes: Subject::Boss,
    number: Some(5),
    most_touches: MAX_TOUCHES,
    fields: RoundProtected::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: over the centre, top clearance above the top side",
        "Steps 2 to 6 once more for each touch point that is left",
    ),
    readings: words::ROUND_PROTECTED,
    read: |def, section| ency::read(def, section, "boss probing", dimensions),
    ..ency::BASE
};

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    RoundProtected::read(section).dimensions(false)
}
