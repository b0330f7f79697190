//! Difference between machine and work coordinates during the touches of a log, and the active work offset.
//!
//! Sources: grbl 1.1's report.c: `WCO` is the active one of G54 … G59, plus G92, plus the tool length along Z; and gcode.c: M2 and M30 activate G54. A status
//! report contains `WCO` only from time to time. Missing or contradicting values are asked for.

use crate::form::Checker;
use crate::geom::Vec3;
use crate::part::measured::line::Item;
use crate::part::measured::log::Log;
use crate::text::{Text, text};

/// Machine minus work coordinates, and their source. Lengths as the log has them.
#[derive(Clone, Debug)]
pub struct MachineOffset {
    /// Machine minus work coordinates.
    pub by: Vec3,
    /// The report that it comes from, for a message.
    pub source: Text,
    /// Active work offset, 1 = G54, if it is known.
    pub offset: Option<u8>,
}

/// Answer to `$#`, each entry with its line.
#[derive(Clone, Debug, Default)]
struct OffsetReport {
    offsets: [Option<Vec3>; 9],
    added: Option<Vec3>,
    length: Option<Vec3>,
}

impl OffsetReport {
    /// Whether any entry is there.
    fn begun(&self) -> bool {
        self.offsets.iter().any(Option::is_some)
    }

    /// Machine minus work coordinates for a work offset.
    fn sum(&self, offset: u8) -> Option<Vec3> {
        Some(
            self.offsets
                .get(usize::from(offset) - 1)
                .copied()
                .flatten()?
                + self.added?
                + self.length?,
        )
    }

    /// Adds an entry. Returns the previous one if it differs.
    fn take(&mut self, item: &Item) -> Option<Vec3> {
        let (slot, value) = match item {
            Item::Offset(number, value) => (self.offsets.get_mut(usize::from(*number) - 1)?, value),
            Item::Added(value) => (&mut self.added, value),
            Item::Length(value) => (&mut self.length, value),
            _ => return None,
        };
        slot.replace(*value).filter(|known| known != value)
    }
}

/// Evidence collected line by line.
#[derive(Debug, Default)]
struct OffsetEvidence {
    active: Option<u8>,
    /// `WCO` during the touches, with its line.
    shift: Option<(Vec3, usize)>,
    /// `WCO` after the last touch.
    late: Option<(Vec3, usize)>,
    answer: OffsetReport,
    /// Whether a touch was sent, so that an end sent after it comes after the touch.
    probing: bool,
    /// Whether offsets have changed: later lines give no earlier values.
    closed: bool,
    /// A line that contradicts earlier ones.
    contradicts: Option<usize>,
}

/// Finds the shift; missing or contradicting values are errors.
pub fn find(checker: &mut Checker, log: &Log, inches: Option<bool>) -> Option<MachineOffset> {
    let gathered = OffsetEvidence::of(log)?;
    if let Some(line) = gathered.contradicts {
        let message = text!(
            "Line {line} changes the work offset, or says another one than the lines before it: which one the touches were made in is not clear. Give the log of one run",
            line
        );
        checker.error("work-offset-unclear", "measured", message);
        return None;
    }
    // A sum of three rounded numbers.
    let rounding = if inches == Some(true) { 2.5e-4 } else { 2.5e-3 };
    let same = |a: Vec3, b: Vec3| (a - b).abs().max_element() < rounding;
    let answer = &gathered.answer;
    let active = gathered.active.or_else(|| {
        let (by, _) = gathered.shift?;
        let mut fitting =
            (1..=9).filter(|offset| answer.sum(*offset).is_some_and(|sum| same(sum, by)));
        fitting.next().filter(|_| fitting.next().is_none())
    });
    let reported = gathered
        .shift
        .or(gathered.late.filter(|_| active == Some(1)));
    let summed = active.and_then(|offset| answer.sum(offset));
    match (reported, summed) {
        (Some((by, line)), Some(sum)) if !same(sum, by) => {
            let message = text!(
                "WCO in line {line} does not match {offset}, G92 and TLO in the answer to $#: which one was active during the run is unclear",
                line,
                word(active.unwrap_or(1))
            );
            checker.error("work-offset-unclear", "measured", message);
            None
        }
        (Some((by, line)), _) => Some(MachineOffset {
            by,
            source: text!("WCO in line {line}", line),
            offset: active,
        }),
        (None, Some(by)) => {
            let source = text!(
                "{offset}, G92 and TLO in the answer to $#",
                word(active.unwrap_or(1))
            );
            Some(MachineOffset {
                by,
                source,
                offset: active,
            })
        }
        (None, None) => {
            checker.error("work-offset-needed", "measured", needed(&gathered, active));
            None
        }
    }
}

impl OffsetEvidence {
    /// `None` if a log has no touch.
    fn of(log: &Log) -> Option<OffsetEvidence> {
        let (first, last) = (*log.touches.first()?, *log.touches.last()?);
        let mut found = OffsetEvidence::default();
        for (i, (number, item)) in log.items.iter().enumerate() {
            if i < first {
                found.before(*number, item);
                found.active = found.active.or(log.stated);
            } else if i <= last {
                found.during(*number, item);
            } else {
                found.after(*number, item);
            }
        }
        Some(found)
    }

    fn before(&mut self, number: usize, item: &Item) {
        match item {
            Item::Active { offset, sent } => {
                if self.active != Some(*offset) && (*sent || self.active.is_some()) {
                    self.shift = None;
                }
                self.active = Some(*offset);
            }
            Item::Shift(by) => self.shift = Some((*by, number)),
            Item::Probes => self.probing = true,
            Item::Ended if self.probing || self.active == Some(1) => {}
            Item::Ended => (self.active, self.shift) = (None, None),
            Item::Changes => (self.shift, self.answer) = (None, OffsetReport::default()),
            _ => {
                self.answer.take(item);
            }
        }
    }

    fn during(&mut self, number: usize, item: &Item) {
        let contradicts = match item {
            Item::Active { offset, sent } => {
                let known = self.active.replace(*offset);
                known != Some(*offset) && (*sent || known.is_some())
            }
            Item::Shift(by) => self
                .shift
                .replace((*by, number))
                .is_some_and(|(known, _)| known != *by),
            Item::Changes => true,
            _ => self.answer.take(item).is_some(),
        };
        if contradicts {
            self.contradicts.get_or_insert(number);
        }
    }

    fn after(&mut self, number: usize, item: &Item) {
        match item {
            _ if self.closed => {}
            Item::Changes => self.closed = true,
            Item::Shift(by) => {
                self.late.get_or_insert((*by, number));
            }
            _ => {
                if self.answer.take(item).is_some() {
                    self.contradicts.get_or_insert(number);
                }
            }
        }
    }
}

/// Missing values, and the remedy.
fn needed(gathered: &OffsetEvidence, active: Option<u8>) -> Text {
    match (active, gathered.late) {
        (Some(offset), _) => text!(
            "The touches are in machine coordinates. {offset} was active, but the answer to $# is not complete: paste all of it, with {offset}, G92 and TLO",
            word(offset)
        ),
        (None, Some((_, line))) => text!(
            "The touches are in machine coordinates, and WCO in line {line} was reported after the last of them, when the end of the program may have made G54 active. Write the work offset that the program ran in as the first line: G54 … G59. If it is not G54, paste the answer to $# as well",
            line
        ),
        (None, None) if gathered.answer.begun() => text!(
            "The touches are in machine coordinates. The answer to $# is there, but not which work offset was active: write it as the first line, G54 … G59"
        ),
        (None, None) => text!(
            "The touches are in machine coordinates, and the text does not state the work offset. Type $# and paste the answer, and write the work offset of the program as the first line, G54 … G59; or paste a status report with WCO: from before the touches"
        ),
    }
}

/// Word of a work offset.
pub fn word(offset: u8) -> String {
    match offset {
        7.. => format!("G59.{}", offset - 6),
        _ => format!("G{}", 53 + offset),
    }
}
