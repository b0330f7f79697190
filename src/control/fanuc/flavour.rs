//! What differs between a Fanuc and a Haas.

use crate::path::STATED_RAPID;

/// What differs between the two.
#[derive(Debug)]
pub(super) struct Flavour {
    /// The length of the active tool.
    pub length: &'static str,
    /// What a rapid runs at where it is watched, mm/min.
    pub rapid: f64,
    /// After a positioning move, in its block.
    pub free: &'static str,
    /// After a touch, in its block.
    pub touch: &'static str,
    /// A block that keeps the control from evaluating what stands after it until the motion before it is done.
    pub halt: &'static str,
    /// The block that lets it read ahead again, at the end.
    pub free_again: Option<&'static str>,
    /// Whether the end of the program may clear the common variables.
    pub forgets: bool,
    /// What the program refuses to move in, in words.
    pub refuses: &'static str,
    /// States in which nothing moves, beside other units.
    pub states: &'static [&'static str],
}

pub(super) static PLAIN: Flavour = Flavour {
    length: "#[2000+#4111]+#[2200+#4111]",
    rapid: STATED_RAPID,
    free: "",
    touch: "",
    halt: "G53",
    free_again: None,
    forgets: true,
    refuses: "Nothing moves in other units, without G43 and an H from 1 to 200, in polar coordinates, under a rotation, a tilted plane, a scale or a mirror",
    // The two tables of lengths have 200 places each.
    states: &[
        "#4008 NE 43",
        "#4111 LT 1",
        "#4111 GT 200",
        "#4017 EQ 16",
        "#4016 EQ 68",
        "#4016 EQ 68.2",
        "#4016 EQ 68.3",
        "#4016 EQ 68.4",
        "#4011 EQ 51",
        "#4022 EQ 51.1",
    ],
};
pub(super) static WITH_ALARMS: Flavour = Flavour {
    length: "#5083",
    rapid: 2400.0,
    free: " M78",
    touch: " M79",
    halt: "G103 P1",
    free_again: Some("G103"),
    forgets: false,
    refuses: "Nothing moves in other units, without G43, under a rotation or a scale. A mirror, G254 and G268 are not asked: switch them off",
    states: &["#4008 NE 43", "#4016 EQ 68", "#4011 EQ 51"],
};
