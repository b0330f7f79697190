//! Differences between Fanuc and Haas.

use crate::path::STATED_RAPID;

#[derive(Debug)]
pub(super) struct Flavour {
    /// The variable with the length of the active tool.
    pub length: &'static str,
    /// Feed of a watched rapid, mm/min.
    pub rapid: f64,
    /// Suffix of a positioning block.
    pub positioning_suffix: &'static str,
    /// Suffix of a touch block.
    pub touch: &'static str,
    /// A block that keeps the control from evaluating later blocks before the motion before it has ended.
    pub halt: &'static str,
    /// The block that allows reading ahead again, at the end.
    pub free_again: Option<&'static str>,
    /// Whether the end of the program may clear the common variables.
    pub forgets: bool,
    /// Variable with the tool: the last T word of a Fanuc, the tool in the spindle of a Haas.
    pub tool: &'static str,
    /// States in which the program does not move, in words.
    pub refuses: &'static str,
    /// States in which nothing moves, besides other units, each with the text of its alarm: at most 26 characters.
    pub states: &'static [(&'static str, &'static str)],
    /// Variable with the X origin of the first work offset after G59.
    pub more_origins: usize,
    /// Words after M19 and before the angle, in the block that orients the spindle; `None` if M19 orients to the one angle set in the control.
    pub angle: Option<&'static str>,
}

pub(super) static PLAIN: Flavour = Flavour {
    tool: "#4120",
    length: "#[2000+#4111]+#[2200+#4111]",
    rapid: STATED_RAPID,
    positioning_suffix: "",
    touch: "",
    halt: "G53",
    free_again: None,
    forgets: true,
    refuses: "Nothing moves in other units, without G43 and an H from 1 to 200, in polar coordinates, under a rotation, a tilted plane, a scale or a mirror",
    // The two tables of lengths have 200 entries each.
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
    tool: "#3026",
    length: "#5083",
    rapid: 2400.0,
    positioning_suffix: " M78",
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
