//! Places of a program for lines of the shop.

use crate::form::Choice;

/// Key of the lines in the section `machine`, and the path of their places in a job.
pub const FRAME: &str = "frame";
pub const PATH: &str = "machine.frame.";

/// A place of a program for lines of the shop.
#[derive(Debug)]
pub struct Place {
    /// Its key in the job.
    pub key: &'static str,
    /// Its name in the program.
    pub name: &'static str,
    /// Whether its lines may change the tool, move the stylus, select a work offset.
    pub tool: bool,
    pub moves: bool,
    pub offset: bool,
    /// Whether it comes before the first move.
    pub before: bool,
}

/// A place whose lines may do nothing of this.
const STILL: Place = Place {
    key: "",
    name: "",
    tool: false,
    moves: false,
    offset: false,
    before: false,
};

/// After the header.
pub const HEAD: Place = Place {
    key: "head",
    name: "head",
    tool: true,
    moves: true,
    offset: true,
    before: true,
};

/// After the lines of the head.
pub const PROBE_ON: Place = Place {
    key: "probeOn",
    name: "probe on",
    ..HEAD
};

/// After the program's checks and modes.
pub const BEFORE_FIRST_MOVE: Place = Place {
    key: "beforeFirstMove",
    name: "before the first move",
    moves: true,
    before: true,
    ..STILL
};

/// After the checks of the results.
pub const BEFORE_WRITE: Place = Place {
    key: "beforeWrite",
    name: "before the write",
    moves: true,
    ..STILL
};

/// After the results are shown.
pub const PROBE_OFF: Place = Place {
    key: "probeOff",
    name: "probe off",
    moves: true,
    ..STILL
};

/// Before the end of the program.
pub const FOOT: Place = Place {
    key: "foot",
    name: "foot",
    tool: true,
    moves: true,
    offset: true,
    ..STILL
};

/// Before the alarm, if the program stops after its first move.
pub const ON_ALARM: Place = Place {
    key: "onAlarm",
    name: "on an alarm",
    ..STILL
};

pub static PLACES: [&Place; 7] = [
    &HEAD,
    &PROBE_ON,
    &BEFORE_FIRST_MOVE,
    &BEFORE_WRITE,
    &PROBE_OFF,
    &FOOT,
    &ON_ALARM,
];

/// The places, as a form shows them.
pub const CHOICES: &[Choice] = &[
    Choice {
        value: "head",
        label: "At the top: tool change",
    },
    Choice {
        value: "probeOn",
        label: "Probe on",
    },
    Choice {
        value: "beforeFirstMove",
        label: "Before the first move",
    },
    Choice {
        value: "beforeWrite",
        label: "Before the write",
    },
    Choice {
        value: "probeOff",
        label: "Probe off",
    },
    Choice {
        value: "foot",
        label: "At the end: safe position",
    },
    Choice {
        value: "onAlarm",
        label: "Before an alarm",
    },
];

/// Usual lines of a control, by the keys of their places.
pub type Usual = &'static [(&'static str, &'static [&'static str])];
