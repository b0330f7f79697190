//! Compares the position of the machine in a log with the end of the program.

use crate::part::measured::MeasurementContext;
use crate::part::measured::line::Item;
use crate::part::measured::log::Log;
use crate::part::measured::offset::MachineOffset;
use crate::text::{Text, text};

/// Distance from the end of the program, mm, within which the machine counts as being there: its steps are rounded.
const ROUNDED: f64 = 0.05;

/// Reason to doubt that the machine is at the end of the program; `None` if the log gives none. `scale` is mm in a unit of the log.
pub fn away(
    log: &Log,
    shift: &MachineOffset,
    scale: f64,
    expected: &MeasurementContext<'_>,
) -> Option<Text> {
    let (first, last) = (*log.touches.first()?, *log.touches.last()?);
    let mut ended = false;
    let mut stands = None;
    for (i, (number, item)) in log.items.iter().enumerate().skip(first) {
        match item {
            Item::Trouble { .. } => {
                return Some(text!("line {line} is an alarm or an error", *number));
            }
            Item::Ended => ended = true,
            Item::Changes | Item::Moves if i > last => {
                return Some(text!(
                    "line {line} moves the machine or changes an offset after the touches",
                    *number
                ));
            }
            Item::Travels if ended && i > last => {
                return Some(text!(
                    "line {line} moves the machine after the end of the program",
                    *number
                ));
            }
            Item::Stands { place, work } if i > last => stands = Some((*number, *place, *work)),
            _ => {}
        }
    }
    let (number, place, work) = stands?;
    let end = expected.path.moves.last()?.to;
    let at = if work { place } else { place - shift.by };
    // After its end a program's work coordinates are those of G54.
    let comparable = !work || shift.offset == Some(1);
    (comparable && (at * scale).distance(end) > ROUNDED).then(|| {
        text!(
            "line {line} shows it at another position than the end of the program",
            number
        )
    })
}
