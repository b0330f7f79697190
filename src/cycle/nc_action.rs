//! NC action: ENCY / SprutCAM type 1. Rows of the table, no motion.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Feature, Shape, Still, field};
use crate::spec::form;

pub static DEF: CycleDef = CycleDef {
    key: "nc-action",
    title: "NC action",
    source: "ENCY/SprutCAM type 1",
    number: Some(1),
    doc: "docs/cycles/nc-action.md",
    fields: Form::FIELDS,
    sections: &[ency::PROPERTIES],
    home: ("linuxcnc", "moves"),
    place: None,
    steps: &[],
    readings: &["Nothing moves. What the action does is the postprocessor's, by SubCode and properties."],
    read: |section| {
        let form = Box::new(Form::read(section));
        ency::read(section, form)
    },
};

form! {
    /// The form of type 1.
    pub struct Form {
        sub_code: i32 = field::sub_code(),
    }
}

impl Feature for Form {
    fn kind(&self) -> (i32, &'static str) {
        (1, "NC action")
    }

    fn copy(&self) -> Box<dyn Feature> {
        Box::new(self.clone())
    }

    fn shape(&self) -> Box<dyn Shape> {
        Box::new(Still)
    }
}
