//! Trace of a program, independent of its language.

use serde::Serialize;

use crate::control::iso::script::{Modes, Part, ToolRegister};

/// A position, in the units of the program and the work coordinate system.
pub type Place = [f64; 3];

/// Effects of a program when it runs: every motion, the consequence of each probing move, computed values and writes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// The motions, in order.
    pub steps: Vec<Step>,
    /// Modes that the program has stated before the first motion.
    pub modes: Modes,
    /// Motions in other modes than the first one: 0-based lines and modes, the first few.
    pub changed: Vec<(usize, Modes)>,
    /// Line of the first block that switches the spindle on.
    pub spindle_line: Option<usize>,
    /// Results that it reports: code and value.
    pub outputs: Vec<(String, f64)>,
    /// Writes to work offsets and tools.
    pub writes: Vec<TableWrite>,
    /// Reading of the ball centre in the written work offset after all writes, and the rotation of the system.
    pub written: Option<OffsetEffect>,
    /// Lines of native cycles.
    pub natives: Vec<usize>,
    /// Whether the program reaches its end.
    pub ends: bool,
}

impl Trace {
    /// Lines of the touches, in order.
    pub fn touch_lines(&self) -> impl Iterator<Item = usize> {
        self.steps
            .iter()
            .filter(|step| step.kind == Kind::Touch)
            .map(|step| step.line)
    }

    /// Motions after this many native cycles.
    pub fn after_native(&self, count: usize) -> impl Iterator<Item = &Step> {
        let line = count.checked_sub(1).and_then(|last| self.natives.get(last));
        self.steps
            .iter()
            .filter(move |step| line.is_none_or(|line| step.line > *line))
    }

    /// Records what a block writes.
    pub fn wrote(&mut self, line: usize, written: Written) {
        let after = self.steps.len();
        let mut add = |what| self.writes.push(TableWrite { line, what, after });
        match written {
            Written::Part(Part::Origin(number, axis)) => {
                add(WrittenValue::Offset(number, Some(axis)));
            }
            Written::Part(Part::Turn(number, _)) => add(WrittenValue::Offset(number, None)),
            Written::Part(Part::Tool(register)) => add(WrittenValue::Tool(register)),
            Written::Offset(number, axes, turn) => {
                let own = (0..3).filter(|axis| axes[*axis]).map(Some);
                own.chain(turn.then_some(None))
                    .for_each(|axis| add(WrittenValue::Offset(number, axis)));
            }
        }
    }
}

/// One motion of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The 0-based line of the motion; in a subroutine the line of the call.
    pub line: usize,
    /// Start; NaN for an axis that no block has named before.
    pub from: Place,
    /// End without a contact.
    pub to: Place,
    /// Axes of the end that the program has named.
    pub known: [bool; 3],
    pub kind: Kind,
    /// Feed; `None` is a rapid.
    pub feed: Option<f64>,
    /// Whether its own block states the feed.
    pub states_feed: bool,
    /// Centre of an arc, and whether it is clockwise.
    pub arc: Option<(Place, bool)>,
    /// Consequence of a contact, if the move is watched.
    pub contact: ProbeConsequence,
    /// Consequence of a miss, if the move must touch.
    pub miss: ProbeConsequence,
    /// Consequence if the probe is still deflected from the previous motion; `None` if that was watched.
    pub still_deflected: Option<ProbeConsequence>,
}

impl Step {
    /// Whether the probe is watched during the motion.
    pub fn probes(&self) -> bool {
        matches!(self.kind, Kind::Watched | Kind::Touch | Kind::Unchecked)
    }
}

/// Kind of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// At the rapid rate; the probe is not watched.
    Rapid,
    /// At a feed; the probe is not watched.
    Feed,
    /// Watched: a contact ends the program.
    Watched,
    /// A touch: a miss ends the program.
    Touch,
    /// A probing move without a check: the program continues with or without a contact.
    Unchecked,
}

/// Consequence of a probing move with the unexpected outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProbeConsequence {
    /// The program continues, or the move does not probe.
    Continues,
    /// The control stops with an alarm at the present position.
    ControlStops,
    /// The program stops with its own alarm.
    Exit {
        /// Line of the alarm.
        line: usize,
        /// Whether it lifts before, straight along the tool axis.
        lifts: bool,
        /// Whether it moves in any other direction before.
        moves_sideways: bool,
        /// Whether it writes a work offset or a tool before.
        writes: bool,
    },
}

impl ProbeConsequence {
    /// Whether the program stops.
    pub fn stops(self) -> bool {
        self != ProbeConsequence::Continues
    }
}

/// What a block writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Written {
    /// One value.
    Part(Part),
    /// Axes of a work offset, 1 = G54, and its rotation.
    Offset(i32, [bool; 3], bool),
}

/// A value that a program writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrittenValue {
    /// Number of a work offset, 1 = G54, and its axis; `None` is the rotation.
    Offset(i32, Option<usize>),
    Tool(ToolRegister),
}

/// One write to a work offset or a tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableWrite {
    /// Its 0-based line.
    pub line: usize,
    pub what: WrittenValue,
    /// Number of motions before it.
    pub after: usize,
}

/// Effect of the writes to a work offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetEffect {
    /// A position in the previous system.
    pub place: Place,
    /// Its reading afterwards.
    pub reading: Place,
    /// Rotation of the system about the tool axis, degrees.
    pub turn: f64,
}
