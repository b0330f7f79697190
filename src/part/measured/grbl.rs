//! A log with grbl's reports of touches: which of them count, and where they lie in the work coordinate system.
//!
//! Sources: grbl 1.1's report.c, gcode.c and motion_control.c. A touch is reported in machine coordinates. All reports are in mm, or in inch under
//! `$13=1`, whatever the program's units. The answer to `$#` ends with the last touch once more. A touch that misses raises alarm 5, which ends
//! the program.

use crate::form::Checker;
use crate::geom::Vec3;
use crate::part::measured::line::{self, Item};
use crate::part::measured::offset::{self, Shift};
use crate::part::measured::{Expected, Measured, Numbered, Stand, is_numbers, reach, stand, unclear};
use crate::text::text;

/// In more kinds of lines no log says the same.
const MOST_ECHOES: usize = 4;

/// An inch in mm.
const INCH: f64 = 25.4;

/// What a log says, in its order.
#[derive(Debug, Default)]
pub struct Log {
    /// Each with the number of its line.
    pub items: Vec<(usize, Item)>,
    /// The touches that count, by their places among the items.
    pub touches: Vec<usize>,
    /// The work offset that a user wrote as the first line; one that was sent has an answer.
    pub stated: Option<u8>,
    /// The lines with touches that do not count: they repeat one.
    repeated: Vec<usize>,
}

/// Reads a log.
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

impl Log {
    /// Everything that the lines say. A line that could be a measurement, and is no report, is an error.
    fn of(checker: &mut Checker, lines: &[Numbered<'_>]) -> Log {
        let answered = lines.get(1).is_some_and(|(_, line)| line::items(line) == [Item::Answered]);
        let stated = lines.first().and_then(|(_, line)| line::offset_alone(line)).filter(|_| !answered);
        let mut log = Log { stated, ..Log::default() };
        let mut in_answer = false;
        for &(number, line) in lines {
            let items = line::items(line);
            if items.is_empty() && is_numbers(&line::without_comments(line)) {
                unclear(checker, number, line);
            }
            for item in items {
                match item {
                    Item::Length(_) => in_answer = true,
                    Item::Touch { .. } if in_answer => {
                        in_answer = false;
                        log.repeated.push(number);
                        continue;
                    }
                    Item::Touch { .. } => log.touches.push(log.items.len()),
                    Item::Unreadable => {
                        let message = text!(
                            "The PRB report in line {line} cannot be read: it must be [PRB:x,y,z:1], or :0 at its end for a touch that missed",
                            number
                        );
                        checker.error("unclear-line", "measured", message);
                    }
                    Item::Answered => in_answer = false,
                    _ => {}
                }
                log.items.push((number, item));
            }
        }
        log
    }

    /// The touches that count: line, place, none where it missed, and what stands in front.
    fn touched(&self) -> impl Iterator<Item = (usize, Option<Vec3>, &str)> {
        self.touches.iter().filter_map(|at| match &self.items[*at] {
            (number, Item::Touch { place, contact, prefix }) => Some((*number, contact.then_some(*place), prefix.as_str())),
            _ => None,
        })
    }

    /// Leaves out what a log says twice: the same touches in lines of another kind. Where only some are there twice, that is an error.
    fn drop_echoes(&mut self, checker: &mut Checker) {
        let touched: Vec<(usize, Option<Vec3>, &str)> = self.touched().collect();
        let Some(first) = touched.first().map(|(.., prefix)| *prefix) else { return };
        let of =
            |kind: &str| touched.iter().filter(|(.., prefix)| *prefix == kind).map(|(_, place, _)| *place).collect::<Vec<_>>();
        let own = of(first);
        let mut kinds: Vec<&str> = Vec::new();
        for (.., prefix) in &touched {
            if kinds.len() <= MOST_ECHOES && !kinds.contains(prefix) {
                kinds.push(prefix);
            }
        }
        let echoed = (2..=MOST_ECHOES).contains(&kinds.len()) && kinds.iter().all(|kind| of(kind) == own);
        if !echoed {
            let twice = touched.windows(2).find(|pair| pair[0].2 != pair[1].2 && pair[0].1 == pair[1].1);
            if let Some([(one, ..), (other, ..)]) = twice {
                let message = text!(
                    "Lines {one} and {other} report the same place in two ways: whether these are two touches is not clear. Keep one report a touch",
                    *one,
                    *other
                );
                checker.error("unclear-line", "measured", message);
            }
            return;
        }
        let keep: Vec<bool> = touched.iter().map(|(.., prefix)| *prefix == first).collect();
        let mut keep = keep.into_iter();
        self.touches.retain(|_| keep.next().unwrap_or(true));
    }
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
