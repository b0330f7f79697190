//! Hole, protected: ENCY / SprutCAM type 4.
//!
//! Each touch is entered from above, so that an island in the middle is not met.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, RoundProtected, words};
use crate::form::Section;
use crate::path::{MAX_TOUCHES, Subject};

pub static DEF: CycleDef = CycleDef {
    key: "hole-protected",
    title: "Hole, protected",
    says: "A bore with something standing in the middle: the probe goes up and over it between the touches.",
    also: "bore ring island inside diameter circle over",
    name: "BORE",
    source: "ENCY/SprutCAM type 4",
    probes: Subject::HoleProtected,
    number: Some(4),
    most_touches: MAX_TOUCHES,
    fields: RoundProtected::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &words::protected(
        "To the feed distance above the start, then down to the start: the centre, top clearance above the top side",
        "Steps 2 to 6 once more for each touch point that is left",
    ),
    readings: words::ROUND_PROTECTED,
    read: |def, section| ency::read(def, section, "hole probing protected", dimensions),
    ..ency::BASE
};

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    RoundProtected::read(section).dimensions(true)
}
