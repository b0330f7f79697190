//! A log with grbl's reports of touches: which of them count, and where they lie in the work coordinate system.
//!
//! Sources: grbl 1.1's report.c, gcode.c and motion_control.c. A touch is reported in machine coordinates. All reports are in mm, or in inch under
//! `$13=1`, whatever the program's units. The answer to `$#` ends with the last touch once more. A touch that misses raises alarm 5, which ends
//! the program.

use crate::form::Checker;
use crate::geom::Vec3;
use crate::part::measured::line::Item;
use crate::part::measured::log::Log;
use crate::part::measured::offset::{self, Shift};
use crate::part::measured::{Expected, Measured, Numbered, Stand, reach, stand};
use crate::text::text;

/// An inch in mm.
const INCH: f64 = 25.4;

pub fn read(checker: &mut Checker, lines: &[Numbered<'_>], expected: &Expected<'_>) -> Measured {
    let before = checker.count();
    let mut log = Log::of(checker, lines);
    log.drop_echoes(checker);
    check_count(checker, &log, expected);
    let inches = inches(checker, &log);
    let shift = offset::find(checker, &log, inches);
    let Some(shift) = shift.filter(|_| checker.count() == before) else { return Measured::default() };
    let Some((points, scale)) = placed(checker, &log, &shift, inches, expected) else { return Measured::default() };
    say_shift(checker, &shift, scale);
    say_missed(checker, &log, expected);
    let away = stand::away(&log, &shift, scale, expected);
    Measured { points, results: None, stand: Some(Stand { offset: shift.offset, away }) }
}

/// One report a touch is needed. A miss ends a program, so that it is the last one.
fn check_count(checker: &mut Checker, log: &Log, expected: &Expected<'_>) {
    let (given, touches) = (log.touches.len(), expected.path.touches.len());
    let miss = log.touched().position(|(_, place, _)| place.is_none());
    if let Some((number, ..)) = miss.filter(|at| at + 1 < given).and_then(|at| log.touched().nth(at)) {
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
        text!("PRB reports: {count}, touches: {touches}. Give the log of one run only", given, touches)
    } else {
        text!("PRB reports: {count}, touches: {touches}. The log must reach from the first touch to the last", given, touches)
    };
    let message = match log.repeated.as_slice() {
        [] => message,
        repeated => text!(
            "{message}. Not counted, since in the answer to $# the last touch is repeated: line {lines}",
            message,
            repeated.iter().take(5).map(usize::to_string).collect::<Vec<_>>().join(", ")
        ),
    };
    checker.error("wrong-count", "measured", message);
}

/// Whether reports are in inch, as far as the log says.
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

/// The points in work coordinates, mm, and the mm in a unit of the reports.
fn placed(
    checker: &mut Checker,
    log: &Log,
    shift: &Shift,
    inches: Option<bool>,
    expected: &Expected<'_>,
) -> Option<(Vec<Option<Vec3>>, f64)> {
    let points = |scale: f64| {
        let mut points = vec![None; expected.path.touches.len()];
        for ((touch, ..), (_, place, _)) in expected.path.searches().zip(log.touched()) {
            points[touch] = place.map(|place| (place - shift.by) * scale);
        }
        points
    };
    let fits = |scale: f64| reach::out_of_reach(&points(scale), expected).next().is_none();
    let inch_job = checker.scale != 1.0;
    let scale = match inches {
        Some(true) => INCH,
        Some(false) => 1.0,
        // Nothing to place.
        None if log.touched().all(|(_, place, _)| place.is_none()) => 1.0,
        None => match (fits(1.0), fits(INCH)) {
            (true, true) if inch_job => {
                let message = text!(
                    "The reports can be in mm or in inch, both are in reach of the touches: add a line $13=0 (mm) or $13=1 (inch), as the answer to $$ says it"
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
                    "The log does not say $13: the reports are read in inch, since in mm they are out of reach of the touches"
                );
                checker.warning("units-found", "measured", message);
                INCH
            }
            (true, false) if inch_job => {
                let message = text!(
                    "The log does not say $13: the reports are read in mm, since in inch they are out of reach of the touches"
                );
                checker.warning("units-found", "measured", message);
                1.0
            }
            _ => 1.0,
        },
    };
    Some((points(scale), scale))
}

/// By what the reports were converted.
fn say_shift(checker: &mut Checker, shift: &Shift, scale: f64) {
    let by = ["X", "Y", "Z"].iter().zip(shift.by.to_array()).map(|(axis, by)| format!("{axis}{}", crate::num::decimal(by, 4)));
    let message = text!(
        "Converted from machine coordinates by {source}: {offset} ({unit})",
        shift.source.clone(),
        by.collect::<Vec<_>>().join(" "),
        if scale == 1.0 { "mm".to_owned() } else { "inch".to_owned() }
    );
    checker.info("converted", "measured", message);
}

/// The touches without contact, and those that were not made after one.
fn say_missed(checker: &mut Checker, log: &Log, expected: &Expected<'_>) {
    for ((touch, ..), (number, place, _)) in expected.path.searches().zip(log.touched()) {
        if place.is_none() {
            let message =
                text!("Touch {touch} made no contact (line {line}): results that need it are unknown", touch + 1, number);
            checker.warning("touch-missed", format!("measured[{touch}]"), message);
        }
    }
    let (made, touches) = (log.touches.len(), expected.path.touches.len());
    if made < touches {
        let message = text!("The program stopped at the miss: {made} of its {touches} touches were made", made, touches);
        checker.warning("touch-missed", "measured", message);
    }
}
