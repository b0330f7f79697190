//! Triple wall external corner: ENCY / SprutCAM type 16.
//!
//! Two walls and the top side of a block, each touched once.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, CornerAngle, Dimensions, Outside, Shape, Triple, field, words};
use crate::form::{Section, Seen, form};
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "triple-wall-external-corner",
    title: "Triple wall external corner",
    says: "The outside corner of a part and its top: X, Y and Z of the corner.",
    also: "outside corner edge wall top Z stock part vise",
    name: "CORNER",
    source: "ENCY/SprutCAM type 16",
    probes: Subject::TripleOutside,
    number: Some(16),
    most_touches: 3,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: outside, clearance 1 from wall 1 and clearance 2 from wall 2, top clearance above the top side",
        "To clearance 1 from the point of wall 1, touch, and back",
        "Back to the start",
        "To clearance 2 from the point of wall 2, touch, and back",
        "Back to the start",
        "To the top clearance over the point of the top side, touch, and back",
        "Back to the start",
        "Up by the feed distance",
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::LAST_LIFT,
        words::START_OUTSIDE,
        words::WALLS,
        "The distances to the touches are ours: the source has the touch points only.",
        words::PLANES,
    ],
    read: |def, section| ency::read(def, section, "triple wall external corner probing", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 16.
    pub struct Form {
        /// The corner, on the top side.
        origin: Vec3 = field::origin("Corner on the top side"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// Between the walls, in the material.
        angle: f64 = field::angle(),
        /// From the top side down to the ball centre at the touches of the walls.
        depth: f64 = field::depth(),
        /// From wall 1 to the ball centre where its touch begins.
        clearance1: f64 = field::clearance("clearance1", "Clearance 1", 15.0, "CmdPrm.Flt[-56]"),
        /// From wall 2 to the ball centre where its touch begins.
        clearance2: f64 = field::clearance("clearance2", "Clearance 2", 15.0, "CmdPrm.Flt[-57]"),
        /// From the top side to the ball centre where its touch begins, and where the ball crosses.
        top_clearance: f64 = field::clearance("topClearance", "Top clearance", 10.0, "CmdPrm.Flt[-58]").seen(Seen::Upright),
        /// From the corner along wall 1 to its touch.
        distance1: f64 = field::distance("distance1", "Distance 1", 15.0),
        /// From the corner along wall 2 to its touch.
        distance2: f64 = field::distance("distance2", "Distance 2", 15.0),
        /// From wall 1 inwards to the touch on the top side.
        top_distance1: f64 = field::distance("topDistance1", "Top distance 1", 15.0),
        /// From wall 2 inwards to the touch on the top side.
        top_distance2: f64 = field::distance("topDistance2", "Top distance 2", 15.0),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let outside = Outside {
        depth: form.depth,
        distances: [form.distance1, form.distance2],
        inwards: [form.top_distance1, form.top_distance2],
    };
    let shape = Shape::Triple(Triple {
        angle: CornerAngle::of(form.angle),
        clearances: [form.clearance1, form.clearance2, form.top_clearance],
        outside: Some(outside),
    });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
