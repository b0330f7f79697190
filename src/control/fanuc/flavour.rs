//! What differs between a Fanuc and a Haas.

use crate::path::STATED_RAPID;

#[derive(Debug)]
pub(super) struct Flavour {
    /// The variable with the length of the active tool.
    pub length: &'static str,
    /// What a rapid runs at where it is watched, mm/min.
    pub rapid: f64,
    /// What follows a positioning move in its block.
    pub free: &'static str,
    /// What follows a touch in its block.
    pub touch: &'static str,
    /// A block that keeps the control from evaluating later blocks until the motion before it is done.
    pub halt: &'static str,
    /// The block that lets it read ahead again, at the end.
    pub free_again: Option<&'static str>,
    /// Whether the end of the program may clear the common variables.
    pub forgets: bool,
    /// What the program refuses to move in, in words.
    pub refuses: &'static str,
    /// States in which nothing moves, beside other units, each with what its alarm says: at most 26 characters.
    pub states: &'static [(&'static str, &'static str)],
    /// The variable of the origin of the first work offset beyond G59, along X.
    pub more_origins: usize,
    /// What the block that turns the spindle has after M19, before the angle; `None` if M19 turns to the one angle that is set in the control.
    pub angle: Option<&'static str>,
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
        ("#4008 NE 43", NO_LENGTH),
        ("#4111 LT 1", "NO H NUMBER IS ACTIVE"),
        ("#4111 GT 200", "H NUMBER IS ABOVE 200"),
        ("#4017 EQ 16", "POLAR COORDINATES ACTIVE"),
        ("#4016 EQ 68", ROTATED),
        ("#4016 EQ 68.2", TILTED),
        ("#4016 EQ 68.3", TILTED),
        ("#4016 EQ 68.4", TILTED),
        ("#4011 EQ 51", SCALED),
        ("#4022 EQ 51.1", "MIRROR G51.1 IS ACTIVE"),
    ],
    more_origins: 7001,
    angle: None,
};

const NO_LENGTH: &str = "G43 IS NOT ACTIVE";
const ROTATED: &str = "ROTATION G68 IS ACTIVE";
const TILTED: &str = "TILTED PLANE IS ACTIVE";
const SCALED: &str = "SCALING G51 IS ACTIVE";

pub(super) static WITH_ALARMS: Flavour = Flavour {
    length: "#5083",
    rapid: 2400.0,
    free: " M78",
    touch: " M79",
    halt: "G103 P1",
    free_again: Some("G103"),
    forgets: false,
    refuses: "Nothing moves in other units, without G43, under a rotation or a scale. A mirror, G254 and G268 are not asked: switch them off",
    states: &[
        ("#4008 NE 43", NO_LENGTH),
        ("#4016 EQ 68", ROTATED),
        ("#4011 EQ 51", SCALED),
    ],
    more_origins: 14_001,
    angle: Some(" R"),
};
