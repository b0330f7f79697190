//! A log with grbl's reports of touches: selects the reports that count and converts them to work coordinates.
//!
//! Sources: grbl 1.1's report.c, gcode.c and motion_control.c. A touch is reported in machine coordinates. All reports are in mm, or in inch under `$13=1`,
//! whatever the program's units. The answer to `$#` ends with the last touch once more. A missed touch raises alarm 5, which ends the program. A watched
//! positioning move (`G38.3`) is reported as well, with `:0` if it made no contact; after a contact the next probing move raises alarm 4.

use crate::form::Checker;
use crate::geom::Vec3;
use crate::part::measured::line::Item;
use crate::part::measured::log::Log;
use crate::part::measured::offset::{self, MachineOffset};
use crate::part::measured::{EndState, Measured, MeasurementContext, Numbered, end_state, reach};
use crate::path::MovePurpose;
use crate::text::text;

/// A shorter positioning move is not a probing move, mm: its block has the same numbers as the previous one.
const ONE_PLACE: f64 = 1e-4;

/// An inch in mm.
const INCH: f64 = 25.4;

pub fn read(
    checker: &mut Checker,
    lines: &[Numbered<'_>],
    expected: &MeasurementContext<'_>,
) -> Measured {
    let before = checker.count();
    let mut log = Log::of(checker, lines);
    log.drop_echoes(checker);
    drop_positioning(checker, &mut log, expected);
    if checker.count() == before {
        check_count(checker, &log, expected);
    }
    let inches = inches(checker, &log);
    let shift = offset::find(checker, &log, inches);
    let Some(shift) = shift.filter(|_| checker.count() == before) else {
        return Measured::default();
    };
    let Some((points, scale)) = placed(checker, &log, &shift, inches, expected) else {
        return Measured::default();
    };
    say_shift(checker, &shift, scale);
    say_missed(checker, &log, expected);
    let away = end_state::away(&log, &shift, scale, expected);
    Measured {
        points,
        results: None,
        stand: Some(EndState {
            offset: shift.offset,
            reason: away,
        }),
    }
}

/// Reports of positioning moves before a touch, or after the last one.
#[derive(Clone, Copy, Default)]
struct Before {
    /// Number of watched straight moves, one report each.
    straight: usize,
    /// Whether there is an arc, which is reported piece by piece.
    arcs: bool,
}

impl Before {
    fn fits(self, reports: usize) -> bool {
        reports == self.straight || self.arcs && reports > self.straight
    }
}

/// Reports before each touch, in the order of the moves, and after the last one.
fn positioning(expected: &MeasurementContext<'_>) -> Vec<Before> {
    let path = expected.path;
    let (mut all, mut next) = (
        Vec::with_capacity(path.touches.len() + 1),
        Before::default(),
    );
    let mut from = path.start;
    for step in &path.moves {
        match step.purpose {
            MovePurpose::Touch(_) => all.push(std::mem::take(&mut next)),
            MovePurpose::Position if step.arc.is_some() => next.arcs = true,
            // The approach to the first position is not watched.
            MovePurpose::Position => {
                next.straight +=
                    usize::from(from.is_some_and(|from| from.distance(step.to) >= ONE_PLACE))
            }
            MovePurpose::Retract(_) | MovePurpose::Search(_) => {}
        }
        from = Some(step.to);
    }
    all.push(next);
    all
}

/// Removes the reports of positioning moves, if the log has them. They tell which touch comes next: a contact that comes too early belongs to a positioning
/// move, not to a touch.
fn drop_positioning(checker: &mut Checker, log: &mut Log, expected: &MeasurementContext<'_>) {
    let reports: Vec<(usize, bool)> = log
        .touched()
        .map(|(line, place, _)| (line, place.is_some()))
        .collect();
    let Some(((_, last), sooner)) = reports.split_last() else {
        return;
    };
    let touches = expected.path.touches.len();
    if sooner.iter().all(|(_, contact)| *contact) {
        let stopped = log
            .items
            .iter()
            .find(|(_, item)| *item == Item::Trouble { in_contact: true });
        if let Some((line, _)) = stopped {
            let message = text!(
                "The control stopped in line {line}, since a probing move began in contact: the last report may be of a positioning move. Give the log with every report, also those that end with :0",
                *line
            );
            checker.error("unclear-line", "measured", message);
        } else if !last && sooner.len() == touches {
            log.touches.pop();
        }
        return;
    }
    let before = positioning(expected);
    let (mut made, mut passed) = (0, 0);
    let mut keep = Vec::with_capacity(reports.len());
    for (i, (line, contact)) in reports.iter().enumerate() {
        let fits = before[made].fits(passed);
        let is_last = i + 1 == reports.len();
        let message = match (*contact, made < touches) {
            (true, true) if fits => {
                (made, passed) = (made + 1, 0);
                keep.push(true);
                continue;
            }
            (true, _) => text!(
                "The contact in line {line} is not at a touch of the program: a positioning move had a contact, or reports are missing. Paste the whole log of one run",
                *line
            ),
            // A miss ends the program.
            (false, true) if fits && !before[made].arcs => {
                keep.push(true);
                match is_last {
                    true => continue,
                    false => text!(
                        "The touch in line {line} missed, which ends a program, and further touches follow: give the log of one run only",
                        *line
                    ),
                }
            }
            (false, _) => {
                passed += 1;
                keep.push(false);
                continue;
            }
        };
        checker.error("unclear-line", "measured", message);
        return;
    }
    let mut keep = keep.into_iter();
    log.touches.retain(|_| keep.next().unwrap_or(true));
}

/// Checks for one report of each touch. A miss ends a program, so it must be the last one.
fn check_count(checker: &mut Checker, log: &Log, expected: &MeasurementContext<'_>) {
    let (given, touches) = (log.touches.len(), expected.path.touches.len());
    let miss = log.touched().position(|(_, place, _)| place.is_none());
    if let Some((number, ..)) = miss
        .filter(|at| at + 1 < given)
        .and_then(|at| log.touched().nth(at))
    {
        let message = text!(
            "The touch in line {line} missed, which ends a program, and further touches follow: give the log of one run only",
            number
        );
        checker.error("unclear-line", "measured", message);
        return;
    }
    if given == touches || (given < touches && miss.is_some()) {
        return;
    }
    let message = if given > touches {
        text!(
            "PRB reports: {count}, touches: {touches}. Give the log of one run only",
            given,
            touches
        )
    } else {
        text!(
            "PRB reports: {count}, touches: {touches}. The log must reach from the first touch to the last",
            given,
            touches
        )
    };
    let message = match log.repeated.as_slice() {
        [] => message,
        repeated => text!(
            "{message}. Not counted, since in the answer to $# the last touch is repeated: line {lines}",
            message,
            repeated
                .iter()
                .take(5)
                .map(usize::to_string)
                .collect::<Vec<_>>()
                .join(", ")
        ),
    };
    checker.error("wrong-count", "measured", message);
}

/// Whether reports are in inch, if the log tells.
fn inches(checker: &mut Checker, log: &Log) -> Option<bool> {
    let mut stated = log.items.iter().filter_map(|(number, item)| match item {
        Item::Inches(on) => Some((*number, *on)),
        _ => None,
    });
    let (first, inches) = stated.next()?;
    if let Some((other, _)) = stated.find(|(_, on)| *on != inches) {
        let message = text!(
            "Lines {one} and {other} disagree about $13: whether the touches are in mm or in inch is not clear. Keep the one that held during the run",
            first,
            other
        );
        checker.error("units-unclear", "measured", message);
    }
    Some(inches)
}

/// Points in work coordinates, mm, and the mm in a unit of the reports.
fn placed(
    checker: &mut Checker,
    log: &Log,
    shift: &MachineOffset,
    inches: Option<bool>,
    expected: &MeasurementContext<'_>,
) -> Option<(Vec<Option<Vec3>>, f64)> {
    let points = |scale: f64| {
        let mut points = vec![None; expected.path.touches.len()];
        for ((touch, ..), (_, place, _)) in expected.path.searches().zip(log.touched()) {
            points[touch] = place.map(|place| (place - shift.by) * scale);
        }
        points
    };
    let fits = |scale: f64| {
        reach::out_of_reach(&points(scale), expected)
            .next()
            .is_none()
    };
    let inch_job = checker.scale != 1.0;
    let scale = match inches {
        Some(true) => INCH,
        Some(false) => 1.0,
        // Nothing to convert.
        None if log.touched().all(|(_, place, _)| place.is_none()) => 1.0,
        None => match (fits(1.0), fits(INCH)) {
            (true, true) if inch_job => {
                let message = text!(
                    "The reports can be in mm or in inch, both are in reach of the touches: add the line $13=0 (mm) or $13=1 (inch) from the answer to $$"
                );
                checker.error("units-unclear", "measured", message);
                return None;
            }
            (false, false) if inch_job => {
                let message = text!(
                    "Read in mm or in inch, the reports are out of reach of the touches: are they from this job, and is the work offset that of the run?"
                );
                checker.error("too-far", "measured", message);
                return None;
            }
            (false, true) => {
                let message = text!(
                    "The log does not state $13: the reports are read in inch, since in mm they are out of reach of the touches"
                );
                checker.warning("units-found", "measured", message);
                INCH
            }
            (true, false) if inch_job => {
                let message = text!(
                    "The log does not state $13: the reports are read in mm, since in inch they are out of reach of the touches"
                );
                checker.warning("units-found", "measured", message);
                1.0
            }
            _ => 1.0,
        },
    };
    Some((points(scale), scale))
}

/// Notes the shift by which the reports were converted.
fn say_shift(checker: &mut Checker, shift: &MachineOffset, scale: f64) {
    let by = ["X", "Y", "Z"]
        .iter()
        .zip(shift.by.to_array())
        .map(|(axis, by)| format!("{axis}{}", crate::num::decimal(by, 4)));
    let message = text!(
        "Converted from machine coordinates by {source}: {offset} ({unit})",
        shift.source.clone(),
        by.collect::<Vec<_>>().join(" "),
        if scale == 1.0 {
            "mm".to_owned()
        } else {
            "inch".to_owned()
        }
    );
    checker.info("converted", "measured", message);
}

/// Reports touches without contact, and touches that were not made after one.
fn say_missed(checker: &mut Checker, log: &Log, expected: &MeasurementContext<'_>) {
    for ((touch, ..), (number, place, _)) in expected.path.searches().zip(log.touched()) {
        if place.is_none() {
            let message = text!(
                "Touch {touch} made no contact (line {line}): results that need it are unknown",
                touch + 1,
                number
            );
            checker.warning("touch-missed", format!("measured[{touch}]"), message);
        }
    }
    let (made, touches) = (log.touches.len(), expected.path.touches.len());
    if made < touches {
        let message = text!(
            "The program stopped at the miss: {made} of its {touches} touches were made",
            made,
            touches
        );
        checker.warning("touch-missed", "measured", message);
    }
}
