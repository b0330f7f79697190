//! Double wall external corner: ENCY / SprutCAM type 14.
//!
//! Both walls of an outside corner, each touched once or more, from one start point outside.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Corner, CornerAngle, Dimensions, Shape, field, words};
use crate::form::{Section, form};
use crate::geom::Vec3;
use crate::path::{MAX_TOUCHES, Subject};

pub static DEF: CycleDef = CycleDef {
    key: "double-wall-external-corner",
    title: "Double wall external corner",
    says: "The outside corner of a part: where its two walls meet, and the angle of each wall that is touched twice.",
    also: "outside corner edge wall angle rotation skew stock part vise",
    name: "CORNER",
    source: "ENCY/SprutCAM type 14",
    probes: Subject::CornerOutside,
    number: Some(14),
    most_touches: MAX_TOUCHES,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: clearance 1 from wall 1 and clearance 2 from wall 2, outside",
        "To clearance 1 from the first point of wall 1, touch, and back",
        "If wall 1 has more points: to clearance 1 from the next one, touch, and back",
        "Step 3 until every point of wall 1 is touched",
        "Back to the start",
        "To clearance 2 from the first point of wall 2, touch, and back",
        "If wall 2 has more points: to clearance 2 from the next one, touch, and back",
        "Step 7 until every point of wall 2 is touched",
        "Back to the start",
        "Up by the feed distance",
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::ALONG,
        words::COMPENSATION,
        words::COUNTED,
        words::START_OUTSIDE,
        words::WALLS,
        "The distances from the corner to the first touches are ours: the source has the touch points only.",
        words::LINES,
        words::TURN,
    ],
    read: |def, section| ency::read(def, section, "double wall external corner probing", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 14.
    pub struct Form {
        /// The corner, at the level of the touches.
        origin: Vec3 = field::origin("Corner at touch level"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// Between the walls, in the material.
        angle: f64 = field::angle(),
        /// From wall 1 to the ball centre where its touches begin.
        clearance1: f64 = field::clearance("clearance1", "Clearance 1", 15.0, "CmdPrm.Flt[-56]"),
        /// From wall 2 to the ball centre where its touches begin.
        clearance2: f64 = field::clearance("clearance2", "Clearance 2", 15.0, "CmdPrm.Flt[-57]"),
        /// From the corner along wall 1 to its first touch.
        distance1: f64 = field::distance("distance1", "Distance 1", 15.0),
        /// From the corner along wall 2 to its first touch.
        distance2: f64 = field::distance("distance2", "Distance 2", 15.0),
        /// How many touches wall 1 has.
        count1: i32 = field::count("count1", "First wall measure count", 2, "CmdPrm.Int[-63]"),
        /// How many touches wall 2 has.
        count2: i32 = field::count("count2", "Second wall measure count", 2, "CmdPrm.Int[-64]"),
        /// Between the touches of wall 1, along it, away from the corner.
        step1: f64 = field::distance("step1", "Step 1", 20.0).code("CmdPrm.Flt[-65]"),
        /// Between the touches of wall 2, along it, away from the corner.
        step2: f64 = field::distance("step2", "Step 2", 20.0).code("CmdPrm.Flt[-67]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let shape = Shape::Corner(Corner {
        internal: false,
        angle: CornerAngle::of(form.angle),
        clearances: [form.clearance1, form.clearance2],
        counts: [form.count1.max(1) as usize, form.count2.max(1) as usize],
        steps: [form.step1, form.step2],
        distances: Some([form.distance1, form.distance2]),
    });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
