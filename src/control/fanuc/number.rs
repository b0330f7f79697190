//! The number of a program, and the name beside it.
//!
//! Ours, and marked [I] in the docs: which digits of a name are a number, the length of the comment. Recalled and not verified on a control, [R]: that the list of
//! programs shows the comment of the O line, and that parameter 3202 usually protects 8000 to 9999.

use crate::control::{Request, comment_text};
use crate::form::Checker;
use crate::text::text;

/// The number where none is chosen.
const DEFAULT: i32 = 1000;

/// The first number that is usually protected.
const PROTECTED: i32 = 8000;

/// The most characters of the name on the O line: the control lists no more.
const LONGEST_NAME: usize = 31;

/// The number of the program of a job with this number and this name.
pub fn number(given: Option<i32>, name: &str) -> i32 {
    given.or_else(|| of_name(name)).unwrap_or(DEFAULT)
}

/// The number that the job gives the program: its own, else that of its name.
pub(super) fn chosen(request: &Request<'_>) -> Option<i32> {
    request.number.or_else(|| of_name(request.name))
}

/// The four digits that a name ends in: alone, or after a letter or `_`. After D or X they are a size.
fn of_name(name: &str) -> Option<i32> {
    // As the program has it, so that a program that is read back has the same number.
    let name = comment_text(name);
    let (before, digits) = name.split_at_checked(name.len().checked_sub(4)?)?;
    let follows = match before.chars().next_back() {
        None | Some('_') => true,
        Some(c) => c.is_ascii_alphabetic() && !matches!(c, 'D' | 'd' | 'X' | 'x'),
    };
    let number = digits.bytes().all(|b| b.is_ascii_digit()).then(|| digits.parse().ok()).flatten();
    number.filter(|n| follows && *n > 0)
}

/// `O1000(POCKET-80X50)`: the number, and the name as the list of programs shows it.
pub(super) fn line(request: &Request<'_>) -> String {
    let name: String = request.name.chars().take(LONGEST_NAME).map(listed).collect();
    let (number, name) = (number(request.number, request.name), name.trim());
    if name.is_empty() { format!("O{number:04}") } else { format!("O{number:04}({name})") }
}

/// A character of the name as every control takes it. A comma could begin a command, such as `MSG,`.
fn listed(c: char) -> char {
    match c.to_ascii_uppercase() {
        c @ ('A'..='Z' | '0'..='9' | ' ' | '.' | '=' | '-') => c,
        _ => '_',
    }
}

/// A number that the control may refuse.
pub(super) fn check(request: &Request<'_>, checker: &mut Checker) {
    let Some(number) = chosen(request).filter(|n| *n >= PROTECTED) else { return };
    let path = if request.number.is_some() { "control.number" } else { "name" };
    let message = text!(
        "Program numbers 8000 to 9999 are usually protected (parameter 3202): the control may refuse O{number}. Use a number below 8000",
        number
    );
    checker.warning("number-protected", path, message);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_in_a_name_is_no_program_number() {
        for (name, number) in [("O2201", 2201), ("BORE2201", 2201), ("2201", 2201), ("BORE_0042", 42), ("o9001", 9001)] {
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
