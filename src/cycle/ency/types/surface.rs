//! Surface: ENCY / SprutCAM type 2.
//!
//! One touch along the target vector, on a wall, a top side or anything between.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, Point, Shape, field, words};
use crate::form::{Field, Section, form};
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "surface",
    title: "Surface",
    says: "One touch of a face, a wall or the top, in X, Y or Z: where it is.",
    also: "face plane top edge Z single point height parallels vise jaw",
    name: "SURFACE",
    source: "ENCY/SprutCAM type 2",
    probes: Subject::Surface,
    number: Some(2),
    most_touches: 1,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: the clearance in front of the touch point along its target vector",
        "Touch",
        "Back to the start",
        "Up by the feed distance",
    ],
    readings: &[
        "The clearance is measured from the surface to the ball centre; the feed distance is along the tool axis.",
        words::NORMAL_OF_SURFACE,
        words::COMPENSATION,
        "The measured point is the nominal one, moved along the target vector: across it nothing is measured.",
        "Rotation and elevation are ours: the source has the target vector only.",
    ],
    read: |def, section| ency::read(def, section, "surface probing", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 2.
    pub struct Form {
        /// The touch point, on the surface.
        origin: Vec3 = field::origin("Touch point"),
        /// Where the target vector points in the plane; counter-clockwise positive.
        rotation: f64 = field::rotation(),
        /// How steeply the target vector points up from the plane: 90 is a top side, 0 a wall.
        elevation: f64 = Field::angle("elevation", "Elevation", 90.0).range(0.0, 90.0).group("Place"),
        /// From the surface to the ball centre where the touch begins.
        clearance: f64 = field::clearance("clearance", "Clearance", 10.0, "CmdPrm.Flt[-56]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let shape = Shape::Point(Point { clearance: form.clearance, elevation: form.elevation });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
