//! NC action: ENCY / SprutCAM type 1. Rows of the table, no motion.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Still, field};
use crate::form::form;
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "nc-action",
    title: "NC action",
    name: "NC-ACTION",
    source: "ENCY/SprutCAM type 1",
    probes: Subject::Action,
    own_feeds: false,
    number: Some(1),
    most_touches: 0,
    doc: "docs/cycles/nc-action.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: None,
    steps: &[],
    readings: &["Nothing moves. What the action does is the postprocessor's, by SubCode and properties."],
    read: |section| {
        let form = Form::read(section);
        ency::read(section, &DEF, "NC action", form, |_| Box::new(Still))
    },
};

form! {
    /// The form of type 1.
    pub struct Form {
        sub_code: i32 = field::sub_code(),
    }
}
