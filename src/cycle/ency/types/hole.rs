//! Hole: ENCY / SprutCAM type 3.
//!
//! All touches from the centre, which the ball enters from above or goes to straight away.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Circle, Dimensions, Shape, Variant, field, words};
use crate::form::{Section, form};
use crate::geom::Vec3;
use crate::path::{MAX_TOUCHES, Subject};

pub static DEF: CycleDef = CycleDef {
    key: "hole",
    title: "Hole",
    says: "A bore or a ring: centre and diameter, touched from its middle.",
    also: "bore ring inside diameter circle",
    name: "BORE",
    source: "ENCY/SprutCAM type 3",
    probes: Subject::Hole,
    number: Some(3),
    most_touches: MAX_TOUCHES,
    fields: Form::FIELDS,
    place: Some(|section, picks, plane| ency::place(section, dimensions, picks, plane)),
    steps: words::FROM_CENTRE,
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
    read: |def, section| ency::read(def, section, "hole probing", dimensions),
    ..ency::BASE
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

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    let form = Form::read(section);
    let shape = Shape::Circle(Circle {
        internal: true,
        diameter: form.diameter,
        variant: Variant::of(form.variant, form.start_angle, form.angular_step, form.step_count),
        depth: form.depth,
        top: form.top_clearance,
        clearance: None,
    });
    Dimensions::of(&form, (form.origin, form.rotation), form.feed_distance, shape)
}
