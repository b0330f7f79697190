//! Numbers of a Fanuc and compatible controls: program numbers, and the digits of a position.
//!
//! Ours, and marked [I] in the docs: which digits of a name are a number, the length of the comment. Recalled and not verified on a control [R]: that the list
//! of programs shows the comment of the O line, and that parameter 3202 usually protects 8000 to 9999.

use crate::control::{Request, comment_text};
use crate::form::Checker;
use crate::formula::ResultCheck;
use crate::num::decimal;
use crate::text::text;

/// Number if none is chosen.
const DEFAULT: i32 = 1000;

/// Comment of a program whose job has no number. An inserted program has no number.
pub(super) const NOT_CHOSEN: &str =
    "No number was chosen: this may replace a program O1000 of the control";

/// Digits of a constant. More are an alarm on some controls.
pub(super) const DIGITS: usize = 8;

/// First number that is usually protected.
const PROTECTED: i32 = 8000;

/// Longest name on the O line: the control lists no more.
const LONGEST_NAME: usize = 31;

/// Longest text of an alarm, characters.
pub(super) const LONGEST_ALARM: usize = 26;

/// First label of the exits for results beyond their limits, and the number of their first alarm.
pub(super) const RESULTS: (usize, usize) = (9061, 31);

/// Decimals of a constant: it has at most eight digits, including a zero before the point.
pub(super) fn decimals(x: f64) -> usize {
    let whole = x.abs().max(1.0).log10().floor() as usize + 1;
    DIGITS.saturating_sub(whole)
}

/// A constant with its decimal point.
fn constant(x: f64) -> String {
    let text = decimal(x, decimals(x));
    if text.contains('.') {
        text
    } else {
        format!("{text}.")
    }
}

/// Deviation of a result in this variable from its expected value, and its limit, in units of the program.
pub(super) fn deviation(variable: &str, check: &ResultCheck, unit: f64) -> (String, String) {
    let [limit, expected] = [check.limit, check.expected].map(|x| constant(x / unit));
    let off = match expected.as_str() {
        "0." => variable.to_owned(),
        text if text.starts_with('-') => format!("{variable}-[{text}]"),
        text => format!("{variable}-{text}"),
    };
    (off, limit)
}

/// Number of the program for this number and name of a job.
pub fn number(given: Option<i32>, name: &str) -> i32 {
    given.or_else(|| of_name(name)).unwrap_or(DEFAULT)
}

/// Number that the job gives the program: its own, or that of its name.
pub(super) fn chosen(request: &Request<'_>) -> Option<i32> {
    request.number.or_else(|| of_name(request.name))
}

/// The four digits at the end of a name: after nothing, a letter or `_`. After D or X they are a size.
fn of_name(name: &str) -> Option<i32> {
    // As in the program, so that a program that is read back has the same number.
    let name = comment_text(name);
    let (before, digits) = name.split_at_checked(name.len().checked_sub(4)?)?;
    let follows = match before.chars().next_back() {
        None | Some('_') => true,
        Some(c) => c.is_ascii_alphabetic() && !matches!(c, 'D' | 'd' | 'X' | 'x'),
    };
    let number = digits
        .bytes()
        .all(|b| b.is_ascii_digit())
        .then(|| digits.parse().ok())
        .flatten();
    number.filter(|n| follows && *n > 0)
}

/// `O1000(POCKET-80X50)`: the number, and the name as the list of programs shows it.
pub(super) fn line(request: &Request<'_>) -> String {
    let name: String = request
        .name
        .chars()
        .take(LONGEST_NAME)
        .map(listed)
        .collect();
    let (number, name) = (number(request.number, request.name), name.trim());
    if name.is_empty() {
        format!("O{number:04}")
    } else {
        format!("O{number:04}({name})")
    }
}

/// A character of the name that every control accepts. A comma could begin a command, such as `MSG,`.
fn listed(c: char) -> char {
    match c.to_ascii_uppercase() {
        c @ ('A'..='Z' | '0'..='9' | ' ' | '.' | '=' | '-') => c,
        _ => '_',
    }
}

/// Reports a number that the control may refuse.
pub(super) fn check(request: &Request<'_>, checker: &mut Checker) {
    let Some((number, path)) = high(request) else {
        return;
    };
    let message = text!(
        "Program numbers 8000 to 9999 are usually protected (parameter 3202): the control may refuse O{number}. Use a number below 8000",
        number
    );
    checker.warning("number-protected", path, message);
}

/// Reports a number that a control with macros may use for one of them: the program would overwrite it. Our choice.
pub(super) fn check_macros(request: &Request<'_>, checker: &mut Checker) {
    let Some((number, path)) = high(request) else {
        return;
    };
    let message = text!(
        "Program numbers 8000 to 9999 belong to macros: O{number} may replace one. Use a number below 8000",
        number
    );
    checker.warning("number-protected", path, message);
}

/// A chosen number above those of users' programs, and its field.
fn high(request: &Request<'_>) -> Option<(i32, &'static str)> {
    let number = chosen(request).filter(|n| *n >= PROTECTED)?;
    Some((
        number,
        if request.number.is_some() {
            "control.number"
        } else {
            "name"
        },
    ))
}

/// Checks that no position needs more digits than a number may have.
pub(super) fn check_digits(request: &Request<'_>, checker: &mut Checker) {
    let decimals = request.post.decimals(request.scale);
    let limit = 10f64.powi(DIGITS as i32 - decimals as i32) * request.scale;
    let touches = request
        .path
        .touches
        .iter()
        .map(|touch| touch.contact(request.setup.radius) - touch.vector * touch.search);
    let places = request.path.moves.iter().map(|step| step.to).chain(touches);
    let farthest = places
        .map(|place| place.abs().max_element())
        .fold(0.0, f64::max);
    if farthest >= limit {
        let message = text!(
            "A position is {far} from the origin: it must be within {limit}, since some controls take at most {digits} digits",
            checker.length(farthest),
            checker.length(limit),
            DIGITS
        );
        checker.error("too-many-digits", "cycle", message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_in_a_name_is_no_program_number() {
        for (name, number) in [
            ("O2201", 2201),
            ("BORE2201", 2201),
            ("2201", 2201),
            ("BORE_0042", 42),
            ("o9001", 9001),
        ] {
            assert_eq!(of_name(name), Some(number), "{name}");
        }
        for name in [
            "BORE-D25",
            "BORE-D1200",
            "POCKET-80X1500",
            "WEB-1200",
            "O220",
            "O22011",
            "O0000",
            "2201A",
            "",
            "\u{c4}220",
            "\u{e9}2",
        ] {
            assert_eq!(of_name(name), None, "{name}");
        }
    }
}
