//! Internal rectangle, protected: ENCY / SprutCAM type 7.
//!
//! Four touches from inside, one a wall, each entered from above, so that an island in the middle is not met.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Feature, Pairs, Shape, Side, field};
use crate::geom::Vec3;
use crate::spec::form;

pub static DEF: CycleDef = CycleDef {
    key: "internal-rectangle-protected",
    title: "Internal rectangle, protected",
    source: "ENCY/SprutCAM type 7",
    number: Some(7),
    doc: "docs/cycles/internal-rectangle-protected.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(&*Form::read(section).shape(), picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: the centre, top clearance above the top side",
        "Over the place the side clearance away from the touch point, at the height of the start",
        "Down by top clearance and depth",
        "Touch, and back to where the touch began",
        "Up by top clearance and depth",
        "Back to the start",
        "Steps 2 to 6 three times more, once for each touch point that is left",
        "Up by the feed distance",
    ],
    readings: &[
        "Clearances are measured from the wall to the ball centre, heights are of the ball centre.",
        "The target vector is the outward normal of the wall: from the material into free space.",
        "Sideways returns use the long link feed and the last lift the return feed: the source names no feed there.",
        "With *Compensate dimensions* on, the points from code -100 are ball-centre positions; the source only says \"toolpath \
         shift with tool compensation\". The points from code -200 never move.",
        "Touch point 1 is the wall in the first direction, 2 its opposite, 3 the wall a quarter turn counter-clockwise from 1, \
         4 its opposite.",
        "The control adds the ball radius along the probing direction, so a turned feature reads too wide: by (W - d)(1/cos t - 1) \
         for a width W, a ball diameter d and a turn t.",
    ],
    read: |section| {
        let form = Box::new(Form::read(section));
        ency::read(section, form)
    },
};

form! {
    /// The form of type 7.
    pub struct Form {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        /// From touch point 1 to touch point 2, along the first direction of the rectangle.
        width1: f64 = field::width("width1", "Width 1", 80.0, "CmdPrm.Flt[-53]"),
        /// From touch point 3 to touch point 4, along the second direction.
        width2: f64 = field::width("width2", "Width 2", 50.0, "CmdPrm.Flt[-54]"),
        depth: f64 = field::depth(),
        top_clearance: f64 = field::top_clearance(),
        /// From the wall to the ball centre where touches 1 and 2 begin.
        side_clearance1: f64 = field::clearance("sideClearance1", "Side clearance 1", 8.0, "CmdPrm.Flt[-56]"),
        /// From the wall to the ball centre where touches 3 and 4 begin.
        side_clearance2: f64 = field::clearance("sideClearance2", "Side clearance 2", 8.0, "CmdPrm.Flt[-57]"),
        feed_distance: f64 = field::feed_distance(),
        compensate_dimensions: bool = field::compensate(),
        sub_code: i32 = field::sub_code(),
    }
}

impl Feature for Form {
    fn kind(&self) -> (i32, &'static str) {
        (7, "internal rectangle probing protected")
    }

    fn copy(&self) -> Box<dyn Feature> {
        Box::new(self.clone())
    }

    fn shape(&self) -> Box<dyn Shape> {
        let side = |key: (&'static str, &'static str), width, clearance| Side { width_key: key, width, clearance };
        Box::new(Pairs {
            internal: true,
            sides: vec![
                side(("width1", "Width 1"), self.width1, Some(("sideClearance1", "Side clearance 1", self.side_clearance1))),
                side(("width2", "Width 2"), self.width2, Some(("sideClearance2", "Side clearance 2", self.side_clearance2))),
            ],
            depth: self.depth,
            top: Some(self.top_clearance),
            middle: None,
        })
    }
}
