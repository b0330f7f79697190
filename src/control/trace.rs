//! What a program does, whatever it was written in.

use serde::Serialize;

use crate::control::iso::script::Modes;

/// A place, in the units of the program and the work coordinate system.
pub type Place = [f64; 3];

/// What a program does when it runs: every motion, what each probing move leads to, what it computes and what it writes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// The motions, in order.
    pub steps: Vec<Step>,
    /// The modes that the program has stated before the first motion.
    pub modes: Modes,
    /// Motions in other modes than that one: their 0-based lines and those modes, the first few.
    pub changed: Vec<(usize, Modes)>,
    /// The line of the first block that switches the spindle on.
    pub spun: Option<usize>,
    /// The results that it gives out: code and value.
    pub outputs: Vec<(String, f64)>,
    /// What it writes to work offsets.
    pub writes: Vec<Write>,
    /// Where the ball reads to be in the written work offset after all writes, and by how much that is turned.
    pub written: Option<Written>,
    /// The lines of native cycles.
    pub natives: Vec<usize>,
    /// Whether the program comes to its end.
    pub ends: bool,
}

impl Trace {
    /// The lines of the touches, in order.
    pub fn touch_lines(&self) -> impl Iterator<Item = usize> {
        self.steps
            .iter()
            .filter(|step| step.kind == Kind::Touch)
            .map(|step| step.line)
    }

    /// A block writes these axes of a work offset, and its rotation.
    pub fn wrote(&mut self, line: usize, number: i32, axes: [bool; 3], turn: bool) {
        let after = self.steps.len();
        let own = (0..3)
            .filter(|axis| axes[*axis])
            .map(Some)
            .chain(turn.then_some(None));
        self.writes.extend(own.map(|axis| Write {
            line,
            number,
            axis,
            after,
        }));
    }
}

/// One motion that the program makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The 0-based line that makes it; of a subroutine the line that calls it.
    pub line: usize,
    /// Where it begins; an axis that no block has named before is not a number.
    pub from: Place,
    /// Where it ends without a contact.
    pub to: Place,
    /// Which axes of that place the program has named.
    pub known: [bool; 3],
    pub kind: Kind,
    /// The feed; none is a rapid.
    pub feed: Option<f64>,
    /// Whether its own block states that feed.
    pub own_feed: bool,
    /// Centre, and whether it runs clockwise, where it is an arc.
    pub arc: Option<(Place, bool)>,
    /// What a contact leads to, where the move is watched.
    pub contact: Ending,
    /// What a miss leads to, where the move must touch.
    pub miss: Ending,
    /// What a probing move leads to if the probe is still deflected from the motion before it; `None` if that was watched.
    pub stuck: Option<Ending>,
}

impl Step {
    /// Whether the probe is watched in it.
    pub fn probes(&self) -> bool {
        matches!(self.kind, Kind::Watched | Kind::Touch | Kind::Unchecked)
    }
}

/// What a motion does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// As fast as the control can; the probe is not watched.
    Rapid,
    /// At a feed; the probe is not watched.
    Feed,
    /// Watched: a contact ends the program.
    Watched,
    /// A touch: a miss ends the program.
    Touch,
    /// A probing move without a check: the program continues with and without a contact.
    Unchecked,
}

/// What the program comes to after a probing move that went the other way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The program continues, or the move does not probe.
    GoesOn,
    /// The control stops with an alarm at the present position.
    ControlStops,
    /// The program stops itself with an alarm.
    Exit {
        /// The line of the alarm.
        line: usize,
        /// Whether it lifts before, straight up the tool axis.
        lifts: bool,
        /// Whether it moves in any other way before.
        strays: bool,
        /// Whether it writes to a work offset before.
        writes: bool,
    },
}

impl Ending {
    /// Whether the program comes to a stop.
    pub fn stops(self) -> bool {
        self != Ending::GoesOn
    }
}

/// One write to a work offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Write {
    /// Its 0-based line.
    pub line: usize,
    /// The number of the offset, 1 = G54.
    pub number: i32,
    /// The axis, or none for the rotation.
    pub axis: Option<usize>,
    /// How many motions were made before it.
    pub after: usize,
}

/// What a written work offset comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Written {
    /// A place in the system as it was.
    pub place: Place,
    /// What it reads afterwards.
    pub reading: Place,
    /// By how much the system was turned about the tool axis, degrees.
    pub turn: f64,
}
