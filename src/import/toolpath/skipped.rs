//! Lines that a run does not follow, with their reasons.

use crate::import::toolpath::count::{Count, count};
use crate::text::{Text, text};

/// Reason why a line is not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Skip {
    /// Its condition is unknown: both branches are read, or neither.
    Condition,
    /// It sets a variable to an unknown value.
    Value,
    /// It calls something outside the text.
    Call,
    /// It jumps to an unknown target.
    Jump,
    /// It runs a canned cycle.
    Canned,
    /// It is not understood.
    Words,
    /// The run has become too long.
    Endless,
}

/// All reasons, in the order of the report.
const ALL: [Skip; 7] = [
    Skip::Condition,
    Skip::Value,
    Skip::Call,
    Skip::Jump,
    Skip::Canned,
    Skip::Words,
    Skip::Endless,
];

/// Lines that were not followed, by reason.
#[derive(Default)]
pub(super) struct Skipped([Count; 7]);

impl Skip {
    fn text(self) -> Text {
        match self {
            Skip::Condition => text!("The result of these conditions is unknown"),
            Skip::Value => text!("These variables get an unknown value"),
            Skip::Call => {
                text!("The called program is not in this text: positions after it are unknown")
            }
            Skip::Jump => text!("The target of the jump is unknown"),
            Skip::Canned => text!("Canned cycles are not followed"),
            Skip::Words => text!("Lines that are not understood are not followed"),
            Skip::Endless => {
                text!("The run ends here: it has made as many blocks as are followed")
            }
        }
    }
}

impl Skipped {
    pub fn count(&mut self, why: Skip, line: usize) {
        count(&mut self.0[why as usize], line);
    }

    /// Lines with possible events that are not seen: their writes are unknown.
    pub fn unread(&self) -> impl Iterator<Item = u32> {
        [Skip::Call, Skip::Jump, Skip::Words, Skip::Endless]
            .into_iter()
            .flat_map(|why| self.0[why as usize].lines.iter().copied())
    }

    /// The lines of each reason, and its text.
    pub fn into_counts(self) -> impl Iterator<Item = (Count, Text)> {
        self.0
            .into_iter()
            .zip(ALL)
            .map(|(count, why)| (count, why.text()))
    }
}
