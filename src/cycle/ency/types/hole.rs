//! Hole: ENCY / SprutCAM type 3.
//!
//! All touches from the centre, which the ball enters from above or goes to straight away.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Circle, Shape, Variant, field, words};
use crate::form::form;
use crate::geom::Vec3;
use crate::path::{MAX_TOUCHES, Subject};

pub static DEF: CycleDef = CycleDef {
    key: "hole",
    title: "Hole",
    name: "BORE",
    source: "ENCY/SprutCAM type 3",
    probes: Subject::Hole,
    own_feeds: false,
    number: Some(3),
    most_touches: MAX_TOUCHES,
    doc: "docs/cycles/hole.md",
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
        words::AS_MANY,
        words::RECTANGULAR,
        words::ANGULAR,
        words::VARIANT,
        words::CIRCLE,
        words::UNCHECKED,
    ],
    read: |section| {
        let form = Form::read(section);
        ency::read(section, &DEF, "hole probing", form, shape)
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

fn shape(form: &Form) -> Box<dyn Shape> {
    let variant = match form.variant {
        0 => Variant::Rectangular,
        _ => Variant::Angular { start: form.start_angle, step: form.angular_step, count: form.step_count.max(1) as usize },
    };
    Box::new(Circle {
        internal: true,
        diameter: form.diameter,
        variant,
        depth: form.depth,
        top: form.top_clearance,
        clearance: None,
    })
}
