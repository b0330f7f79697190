//! Web, three points: ENCY / SprutCAM type 10.
//!
//! A rib, touched on both sides and on top.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, Pairs, Shape, Side, field, words};
use crate::form::{Section, Seen, form};
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "web-three-points",
    title: "Web, three points",
    says: "A rib from both sides and on top: its middle, its width and its height.",
    also: "rib ridge bar wall outside width top Z",
    name: "WEB",
    source: "ENCY/SprutCAM type 10",
    probes: Subject::WebTop,
    number: Some(10),
    most_touches: 3,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: the middle clearance above the middle touch point",
        "At the height of the start, across to the side clearance from the left touch point",
        "Down to the level of the touch",
        "Touch, and back to where the touch began",
        "Up to the height of the start",
        "Back to the start",
        "Steps 2 to 6 for the right touch point",
        "Touch the middle point, and back",
        "Up by the feed distance",
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::FEEDS,
        words::COMPENSATION,
        "The source's steps name a top clearance that this cycle has no code for: the ball crosses at the height of the start, the middle \
         clearance above the top side.",
        "The left touch point is the one against the first direction, the right one in it.",
        words::COSINE_OUTSIDE,
        words::SINGLE,
    ],
    read: |def, section| ency::read(def, section, "web probing (three points)", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 10.
    pub struct Form {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From the left touch point to the right one.
        width: f64 = field::width("width", "Width", 30.0, "CmdPrm.Flt[-53]"),
        /// From the top side down to the ball centre at the left and the right touch.
        depth: f64 = field::depth(),
        /// From the wall to the ball centre where the left and the right touch begin.
        side_clearance: f64 = field::clearance("sideClearance", "Side clearance", 8.0, "CmdPrm.Flt[-56]"),
        /// From the top side to the ball centre where the middle touch begins, and where the ball crosses.
        middle_clearance: f64 = field::clearance("middleClearance", "Middle clearance", 10.0, "CmdPrm.Flt[-57]").seen(Seen::Upright),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let shape = Shape::Pairs(Pairs {
        internal: false,
        sides: vec![Side { width: form.width, clearance: Some(form.side_clearance) }],
        depth: form.depth,
        top: Some(form.middle_clearance),
        middle: Some(form.middle_clearance),
    });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
