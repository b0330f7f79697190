//! Triple wall internal corner: ENCY / SprutCAM type 15.
//!
//! Two walls and the floor of a pocket, each touched once from one start point inside.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, CornerAngle, Dimensions, Shape, Triple, field, words};
use crate::form::{Section, form};
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "triple-wall-internal-corner",
    title: "Triple wall internal corner",
    says: "The inside corner of two walls and a floor: X, Y and Z of the corner.",
    also: "inside corner edge wall floor Z fixture stop vise",
    name: "CORNER",
    source: "ENCY/SprutCAM type 15",
    probes: Subject::TripleInside,
    number: Some(15),
    most_touches: 3,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: each clearance away from its surface",
        "Touch the first wall, and back",
        "Touch the second wall, and back",
        "Touch the third wall, and back",
        "Up by the feed distance",
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::LAST_LIFT,
        words::FEET,
        words::WALLS,
        "By its dimensions the third wall is the floor, square to the tool axis; picked touches may have any direction.",
        words::PLANES,
    ],
    read: |def, section| ency::read(def, section, "triple wall internal corner probing", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 15.
    pub struct Form {
        /// The corner, where the walls meet the floor.
        origin: Vec3 = field::origin("Corner on the floor"),
        /// How the corner is turned about the tool axis; at 0 wall 1 runs along the ordinate. Counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// Between the walls, inside the corner.
        angle: f64 = field::angle(),
        /// From wall 1 to the ball centre where its touch begins.
        clearance1: f64 = field::clearance("clearance1", "Clearance 1", 15.0, "CmdPrm.Flt[-56]"),
        /// From wall 2 to the ball centre where its touch begins.
        clearance2: f64 = field::clearance("clearance2", "Clearance 2", 15.0, "CmdPrm.Flt[-57]"),
        /// From the floor to the ball centre where its touch begins.
        clearance3: f64 = field::clearance("clearance3", "Clearance 3", 15.0, "CmdPrm.Flt[-58]"),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let shape = Shape::Triple(Triple {
        angle: CornerAngle::of(form.angle),
        clearances: [form.clearance1, form.clearance2, form.clearance3],
        outside: None,
    });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
