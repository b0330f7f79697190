//! Internal rectangle: ENCY / SprutCAM type 6.
//!
//! Four touches from the centre, one a wall.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, Pairs, Shape, Side, field, words};
use crate::form::{Section, form};
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "internal-rectangle",
    title: "Internal rectangle",
    says: "A pocket: centre, length and width, touched from its middle.",
    also: "pocket window inside",
    name: "POCKET",
    source: "ENCY/SprutCAM type 6",
    probes: Subject::Pocket,
    number: Some(6),
    most_touches: 4,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: words::FROM_CENTRE,
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::WAY_BACK,
        words::THREE_MORE,
        words::RECTANGLE,
        words::COSINE_INSIDE,
        words::UNCHECKED,
    ],
    read: |def, section| ency::read(def, section, "internal rectangle probing", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 6.
    pub struct Form {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2, along the first direction of the rectangle.
        width1: f64 = field::width("width1", "Width 1", 80.0, "CmdPrm.Flt[-53]"),
        /// From touch point 3 to touch point 4, along the second direction.
        width2: f64 = field::width("width2", "Width 2", 50.0, "CmdPrm.Flt[-54]"),
        depth: f64 = field::depth(),
        top_clearance: Option<f64> = field::entry_clearance(),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let shape = Shape::Pairs(Pairs {
        internal: true,
        sides: [form.width1, form.width2].map(|width| Side { width, clearance: None }).into(),
        depth: form.depth,
        top: form.top_clearance,
        middle: None,
    });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
