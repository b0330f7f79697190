//! Hole: ENCY / SprutCAM type 3.
//!
//! All touches from the centre, which the ball enters from above or goes to straight away.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Circle, Feature, Shape, Variant, field};
use crate::geom::Vec3;
use crate::spec::form;

pub static DEF: CycleDef = CycleDef {
    key: "hole",
    title: "Hole",
    source: "ENCY/SprutCAM type 3",
    number: Some(3),
    doc: "docs/cycles/hole.md",
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
        "Rectangular: touch point 2 lies opposite 1, 3 a quarter turn counter-clockwise from 1, 4 opposite 3.",
        "Angular: touch point k lies at start angle + (k - 1) angular steps, counter-clockwise from the first direction.",
        "The circle is one of least squares through the ball centres, larger or smaller by the ball radius. Programs of plain \
         arithmetic take its normal equations.",
        "The top clearance that is not checked is left out of the parameter table: how the source stores it is not documented.",
    ],
    read: |section| {
        let form = Box::new(Form::read(section));
        ency::read(section, form)
    },
};

form! {
    /// The form of type 3.
    pub struct Form {
        origin: Vec3 = field::top_centre(),
        rotation: f64 = field::rotation(),
        diameter: f64 = field::diameter(),
        depth: f64 = field::depth(),
        variant: i32 = field::variant(),
        start_angle: f64 = field::start_angle(),
        angular_step: f64 = field::angular_step(),
        step_count: i32 = field::step_count(),
        top_clearance: Option<f64> = field::entry_clearance(),
        feed_distance: f64 = field::feed_distance(),
        sub_code: i32 = field::sub_code(),
    }
}

impl Feature for Form {
    fn kind(&self) -> (i32, &'static str) {
        (3, "hole probing")
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
            internal: true,
            diameter: self.diameter,
            variant,
            depth: self.depth,
            top: self.top_clearance,
            clearance: None,
        })
    }
}
