//! Probe on/off: ENCY / SprutCAM type 0. Rows of the table, no motion.

use crate::cycle::CycleDef;
use crate::cycle::ency::{self, Dimensions};
use crate::form::{Field, Section, form};
use crate::path::Subject;

pub static DEF: CycleDef = CycleDef {
    key: "probe-on-off",
    title: "Probe on/off",
    says: "Switches the probe on or off in a postprocessor; nothing moves.",
    also: "switch activate",
    name: "PROBE-ON-OFF",
    source: "ENCY/SprutCAM type 0",
    probes: Subject::Switch,
    number: Some(0),
    most_touches: 0,
    fields: Form::FIELDS,
    sections: &[],
    readings: &[
        "Nothing moves, so that a program of plain moves states its modes and ends. How a machine's probe is switched on is up \
                 to its builder, and is not guessed.",
    ],
    read: |def, section| ency::read(def, section, "probe on/off", dimensions),
    ..ency::BASE
};

form! {
    /// The form of type 0.
    pub struct Form {
        /// Whether the probe is switched on or off.
        on: bool = Field::flag("on", "On", true).code("CmdPrm.Bol[-3]").group("Postprocessor"),
    }
}

fn dimensions(section: &mut Section<'_, '_>) -> Dimensions {
    Dimensions::unmoving(&Form::read(section))
}
