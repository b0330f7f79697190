//! Boss: ENCY / SprutCAM type 5.
//!
//! A stud, touched from outside.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Circle, Feature, Shape, Variant, field};
use crate::geom::Vec3;
use crate::spec::form;

pub static DEF: CycleDef = CycleDef {
    key: "boss",
    title: "Boss",
    source: "ENCY/SprutCAM type 5",
    number: Some(5),
    doc: "docs/cycles/boss.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: Some(|section, picks, plane| ency::place(&*Form::read(section).shape(), picks, plane)),
    steps: &[
        "To the feed distance above the start, then down to the start: over the centre, top clearance above the top side",
        "Over the place the side clearance away from the touch point, at the height of the start",
        "Down by top clearance and depth",
        "Touch, and back to where the touch began",
        "Up by top clearance and depth",
        "Back to the start",
        "Steps 2 to 6 once more for each touch point that is left",
        "Up by the feed distance",
    ],
    readings: &[
        "Clearances are measured from the wall to the ball centre, heights are of the ball centre.",
        "The target vector is the outward normal of the wall: from the material into free space.",
        "Sideways returns use the long link feed and the last lift the return feed: the source names no feed there.",
        "With *Compensate dimensions* on, the points from code -100 are ball-centre positions; the source only says \"toolpath \
         shift with tool compensation\". The points from code -200 never move.",
        "Rectangular: touch point 2 lies opposite 1, 3 a quarter turn counter-clockwise from 1, 4 opposite 3.",
        "Angular: touch point k lies at start angle + (k - 1) angular steps, counter-clockwise from the first direction.",
        "The circle is one of least squares through the ball centres, larger or smaller by the ball radius. Programs of plain \
         arithmetic take its normal equations.",
    ],
    read: |section| {
        let form = Box::new(Form::read(section));
        ency::read(section, form)
    },
};

form! {
    /// The form of type 5.
    pub struct Form {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        diameter: f64 = field::diameter(),
        depth: f64 = field::depth(),
        variant: i32 = field::variant(),
        start_angle: f64 = field::start_angle(),
        angular_step: f64 = field::angular_step(),
        step_count: i32 = field::step_count(),
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
        (5, "boss probing")
    }

    fn copy(&self) -> Box<dyn Feature> {
        Box::new(self.clone())
    }

    fn shape(&self) -> Box<dyn Shape> {
        let variant = match self.variant {
            0 => Variant::Rectangular,
            _ => Variant::Angular { start: self.start_angle, step: self.angular_step, count: self.step_count.max(1) as usize },
        };
        Box::new(Circle {
            internal: false,
            diameter: self.diameter,
            variant,
            depth: self.depth,
            top: Some(self.top_clearance),
            clearance: Some(self.side_clearance),
        })
    }
}
