//! Words of work offsets on a Fanuc and compatible controls.

use crate::control::Request;
use crate::form::Checker;
use crate::text::text;

/// G54 to G59.
pub(super) const STANDARD: i32 = 6;

/// Offsets after G59, called by `G54.1 P`.
pub(super) const MORE: i32 = 48;

/// `G54` … `G59`, `G54.1 P1` ….
pub(super) fn word(number: i32) -> String {
    match number {
        ..=STANDARD => format!("G{}", 53 + number),
        _ => format!("G54.1 P{}", number - STANDARD),
    }
}

/// S of Renishaw's macros: 1 to 6 for G54 to G59, 101 and following for G54.1 P1 [S].
pub(super) fn letter(number: i32) -> f64 {
    f64::from(if number <= STANDARD {
        number
    } else {
        100 + number - STANDARD
    })
}

/// Reports a work offset that not every control has.
pub(super) fn check_optional(request: &Request<'_>, checker: &mut Checker) {
    let optional =
        |number: i32| number > STANDARD && (request.post.work_offset_word)(number) == word(number);
    if request.work_offset.is_some_and(optional) {
        let message = text!("G54.1 P1 to P48 are an option: a control without it raises an alarm");
        checker.warning("offset-optional", "control.workOffset", message);
    }
}
