//! NC action: ENCY / SprutCAM type 1. Rows of the table, no motion.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions, field};
use crate::form::{Section, form};
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "nc-action",
    title: "NC action",
    says: "Rows of the parameter table that a postprocessor acts on; nothing moves.",
    also: "postprocessor offset report",
    name: "NC-ACTION",
    source: "ENCY/SprutCAM type 1",
    probes: Subject::Action,
    number: Some(1),
    most_touches: 0,
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    readings: &["Nothing moves. What the action does is the postprocessor's, by SubCode and properties."],
    read: |def, section| ency::read(def, section, "NC action", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 1.
    pub struct Form {
        sub_code: i32 = field::sub_code(),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    Dimensions::unmoving(&Form::read(section))
}
