//! The angle of a wall: a cycle of our own.
//!
//! Two touches of one wall, which ENCY's family has as a part of its corners only.

use crate::cycle::ency::{self, Dimensions, Shape, TwoTouches, field, words};
use crate::cycle::{CycleDef, REPEAT};
use crate::form::{Field, Section, form};
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "wall-angle",
    title: "Angle of a wall",
    says: "A straight wall or jaw, touched twice: how far it is turned.",
    also: "rotation skew edge fence vise jaw parallel align basic rotation",
    name: "WALL",
    source: "Touchpath",
    probes: Subject::Wall,
    most_touches: 2,
    fields: Form::FIELDS,
    sections: &[REPEAT],
    steps: &[
        "To the feed distance above the start, then down to the start: the clearance in front of the middle of the wall",
        "Along the wall, to the clearance in front of the touch point",
        "Touch, and back to the clearance; then step 2 for the other touch point",
        "Back to the start",
        "Up by the feed distance",
    ],
    readings: &[
        "The cycle is ours: two touches at one height, half the distance to either side of the middle of the wall.",
        "Across the wall nothing but its direction is measured: where it is, a Surface says.",
        words::NORMAL_OF_SURFACE,
    ],
    read: |def, section| ency::read(def, section, "", dimensions),
    ..ency::BASE
};

form! {
    /// The form of the angle of a wall.
    pub struct Form {
        /// The middle between the touches, on the wall, at their height.
        origin: Vec3 = field::origin("Middle of the wall"),
        /// Where the target vector points in the plane, out of the wall; counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// From the first touch to the second, along the wall. The longer, the smaller ± is.
        distance: f64 = Field::length("distance", "Distance of the touches", 60.0).range(0.1, 10_000.0).usual(5.0, 2000.0).group("Touches"),
        /// From the wall to the ball centre where a touch begins.
        clearance: f64 = field::clearance("clearance", "Clearance", 10.0, ""),
        /// How far above its start the cycle begins, and how far it is lifted at its end.
        feed_distance: f64 = Field::length("feedDistance", "Feed distance", 20.0).range(0.0, 1000.0).usual(1.0, 500.0).group("Clearances"),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let shape = Shape::Wall(TwoTouches { distance: form.distance, clearance: form.clearance });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
