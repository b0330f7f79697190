//! Internal rectangle: ENCY / SprutCAM type 6.
//!
//! Four touches from the centre, one a wall.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Pairs, Shape, Side, field, words};
use crate::form::form;
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "internal-rectangle",
    title: "Internal rectangle",
    name: "POCKET",
    source: "ENCY/SprutCAM type 6",
    probes: Subject::Pocket,
    own_feeds: false,
    number: Some(6),
    most_touches: 4,
    doc: "docs/cycles/internal-rectangle.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(Form::read(section), shape, picks, plane)),
    steps: &[
        "With the top clearance checked: to the feed distance above it, down to it over the centre, then down to the centre at the depth",
        "With the top clearance not checked: to the feed distance above the centre at the depth, then down to it",
        "Touch, and back to the centre, once for each touch point",
        "With the top clearance checked: up by top clearance and depth",
        "Up to the feed distance",
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::WAY_BACK,
        words::THREE_MORE,
        words::RECTANGLE,
        words::COSINE_INSIDE,
        words::UNCHECKED,
    ],
    read: |section| {
        let form = Form::read(section);
        ency::read(section, &DEF, "internal rectangle probing", form, shape)
    },
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

fn shape(form: &Form) -> Box<dyn Shape> {
    let side = |key: (&'static str, &'static str), width, clearance| Side { width_key: key, width, clearance };
    Box::new(Pairs {
        internal: true,
        sides: vec![side(("width1", "Width 1"), form.width1, None), side(("width2", "Width 2"), form.width2, None)],
        depth: form.depth,
        top: form.top_clearance,
        middle: None,
    })
}
