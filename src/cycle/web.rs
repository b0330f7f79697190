//! Web: ENCY / SprutCAM type 9.
//!
//! A rib, touched on both sides.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Feature, Pairs, Shape, Side, field};
use crate::geom::Vec3;
use crate::spec::form;

pub static DEF: CycleDef = CycleDef {
    key: "web",
    title: "Web",
    source: "ENCY/SprutCAM type 9",
    number: Some(9),
    doc: "docs/cycles/web.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(&*Form::read(section).shape(), picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: over the middle, top clearance above the top side",
        "Over the place the side clearance away from the touch point, at the height of the start",
        "Down by top clearance and depth",
        "Touch, and back to where the touch began",
        "Up by top clearance and depth",
        "Back to the start",
        "Steps 2 to 6 for the second touch point",
        "Up by the feed distance",
    ],
    readings: &[
        "Clearances are measured from the wall to the ball centre, heights are of the ball centre.",
        "The target vector is the outward normal of the wall: from the material into free space.",
        "Sideways returns use the long link feed and the last lift the return feed: the source names no feed there.",
        "With *Compensate dimensions* on, the points from code -100 are ball-centre positions; the source only says \"toolpath \
         shift with tool compensation\". The points from code -200 never move.",
        "Touch point 1 is the wall in the first direction, 2 its opposite.",
        "The control takes the ball radius off along the probing direction, so a turned feature reads too wide: by (W + d)(1/cos t - 1) \
         for a width W, a ball diameter d and a turn t.",
        "One pair of walls says where its middle is across them only. The other coordinate of the middle is the nominal one, and is not \
         given where the walls are parallel to an axis.",
    ],
    read: |section| {
        let form = Box::new(Form::read(section));
        ency::read(section, form)
    },
};

form! {
    /// The form of type 9.
    pub struct Form {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2.
        width: f64 = field::width("width", "Width", 30.0, "CmdPrm.Flt[-53]"),
        depth: f64 = field::depth(),
        top_clearance: f64 = field::top_clearance(),
        /// From the wall to the ball centre where touches begin.
        side_clearance: f64 = field::clearance("sideClearance", "Side clearance", 8.0, "CmdPrm.Flt[-56]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl Feature for Form {
    fn kind(&self) -> (i32, &'static str) {
        (9, "web probing")
    }

    fn copy(&self) -> Box<dyn Feature> {
        Box::new(self.clone())
    }

    fn shape(&self) -> Box<dyn Shape> {
        Box::new(Pairs {
            internal: false,
            sides: vec![Side {
                width_key: ("width", "Width"),
                width: self.width,
                clearance: Some(("sideClearance", "Side clearance", self.side_clearance)),
            }],
            depth: self.depth,
            top: Some(self.top_clearance),
            middle: None,
        })
    }
}
