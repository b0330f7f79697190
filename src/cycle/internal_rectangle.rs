//! Internal rectangle: ENCY / SprutCAM type 6.
//!
//! Four touches from the centre, one a wall.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Feature, Pairs, Shape, Side, field};
use crate::geom::Vec3;
use crate::spec::form;

pub static DEF: CycleDef = CycleDef {
    key: "internal-rectangle",
    title: "Internal rectangle",
    source: "ENCY/SprutCAM type 6",
    number: Some(6),
    doc: "docs/cycles/internal-rectangle.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(&*Form::read(section).shape(), picks, plane)),
    steps: &[
        "With the top clearance checked: to the feed distance above it, down to it over the centre, then down to the centre at the depth",
        "With the top clearance not checked: to the feed distance above the centre at the depth, then down to it",
        "Touch, and back to the centre, once for each touch point",
        "With the top clearance checked: up by top clearance and depth",
        "Up to the feed distance",
    ],
    readings: &[
        "Clearances are measured from the wall to the ball centre, heights are of the ball centre.",
        "The target vector is the outward normal of the wall: from the material into free space.",
        "Where the source names no feed, ways back use the long link feed.",
        "Touch point 1 is the wall in the first direction, 2 its opposite, 3 the wall a quarter turn counter-clockwise from 1, \
         4 its opposite.",
        "The control adds the ball radius along the probing direction, so a turned feature reads too wide: by (W - d)(1/cos t - 1) \
         for a width W, a ball diameter d and a turn t.",
        "The top clearance that is not checked is left out of the parameter table: how the source stores it is not documented.",
    ],
    read: |section| {
        let form = Box::new(Form::read(section));
        ency::read(section, form)
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

impl Feature for Form {
    fn kind(&self) -> (i32, &'static str) {
        (6, "internal rectangle probing")
    }

    fn copy(&self) -> Box<dyn Feature> {
        Box::new(self.clone())
    }

    fn shape(&self) -> Box<dyn Shape> {
        let side = |key: (&'static str, &'static str), width, clearance| Side { width_key: key, width, clearance };
        Box::new(Pairs {
            internal: true,
            sides: vec![side(("width1", "Width 1"), self.width1, None), side(("width2", "Width 2"), self.width2, None)],
            depth: self.depth,
            top: self.top_clearance,
            middle: None,
        })
    }
}
