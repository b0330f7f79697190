//! Groove: ENCY / SprutCAM type 11.
//!
//! Both walls of a groove, from its middle.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, Pairs, Shape, Side, field, words};
use crate::form::{Section, form};
use crate::geom::Vec3;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "groove",
    title: "Groove",
    says: "A slot, or the gap between two jaws: its middle and its width, touched from the middle.",
    also: "slot keyway channel gap inside width vise jaws",
    name: "GROOVE",
    source: "ENCY/SprutCAM type 11",
    probes: Subject::Groove,
    number: Some(11),
    most_touches: 2,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: &[
        "With the top clearance checked: to the feed distance above it, down to it over the middle, then down to the middle at the depth",
        "With the top clearance not checked: to the feed distance above the middle at the depth, then down to it",
        "Touch, and back to the middle, once for each touch point",
        "With the top clearance checked: up by top clearance and depth",
        "Up to the feed distance",
    ],
    readings: &[
        words::HEIGHTS,
        words::NORMAL,
        words::WAY_BACK,
        words::PAIR,
        words::COSINE_INSIDE,
        words::SINGLE,
        words::UNCHECKED,
    ],
    read: |def, section| ency::read(def, section, "groove probing", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 11.
    pub struct Form {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2.
        width: f64 = field::width("width", "Width", 30.0, "CmdPrm.Flt[-53]"),
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
        sides: vec![Side { width: form.width, clearance: None }],
        depth: form.depth,
        top: form.top_clearance,
        middle: None,
    });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
