//! Groove: ENCY / SprutCAM type 11.
//!
//! Both walls of a groove, from its middle.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Feature, Pairs, Shape, Side, field};
use crate::geom::Vec3;
use crate::spec::form;

pub static DEF: CycleDef = CycleDef {
    key: "groove",
    title: "Groove",
    source: "ENCY/SprutCAM type 11",
    number: Some(11),
    doc: "docs/cycles/groove.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(&*Form::read(section).shape(), picks, plane)),
    steps: &[
        "With the top clearance checked: to the feed distance above it, down to it over the middle, then down to the middle at the depth",
        "With the top clearance not checked: to the feed distance above the middle at the depth, then down to it",
        "Touch, and back to the middle, once for each touch point",
        "With the top clearance checked: up by top clearance and depth",
        "Up to the feed distance",
    ],
    readings: &[
        "Clearances are measured from the wall to the ball centre, heights are of the ball centre.",
        "The target vector is the outward normal of the wall: from the material into free space.",
        "Where the source names no feed, ways back use the long link feed.",
        "Touch point 1 is the wall in the first direction, 2 its opposite.",
        "The control adds the ball radius along the probing direction, so a turned feature reads too wide: by (W - d)(1/cos t - 1) \
         for a width W, a ball diameter d and a turn t.",
        "One pair of walls says where its middle is across them only. The other coordinate of the middle is the nominal one, and is not \
         given where the walls are parallel to an axis.",
        "The top clearance that is not checked is left out of the parameter table: how the source stores it is not documented.",
    ],
    read: |section| {
        let form = Box::new(Form::read(section));
        ency::read(section, form)
    },
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

impl Feature for Form {
    fn kind(&self) -> (i32, &'static str) {
        (11, "groove probing")
    }

    fn copy(&self) -> Box<dyn Feature> {
        Box::new(self.clone())
    }

    fn shape(&self) -> Box<dyn Shape> {
        Box::new(Pairs {
            internal: true,
            sides: vec![Side { width_key: ("width", "Width"), width: self.width, clearance: None }],
            depth: self.depth,
            top: self.top_clearance,
            middle: None,
        })
    }
}
