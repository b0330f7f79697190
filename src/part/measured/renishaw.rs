//! What Renishaw's measuring macros print by their letter `W`: a line a result, by its kind, its nominal and its actual value.
//!
//! Source: macro O9730 of the edition for Haas. `SIZE D 40.0000 ACTUAL 40.0132 TOL 0.5000 DEV 0.0132`, `POSN X …`, `ANG …`; DPRNT prints blanks as `*`.
//! A line says no name of a result: its kind and its nominal value say which of the job it is.

use std::borrow::Cow;

use crate::form::Checker;
use crate::formula::{ResultDef, Role};
use crate::num::decimal;
use crate::part::measured::{Expected, line};
use crate::text::text;

/// The macros print four decimals.
const LAST_DIGIT: f64 = 6e-4;

/// What a line is of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Size,
    /// Of this axis: `X`, `Y` or `Z`, which these macros know as those of G17.
    Place(char),
    Angle,
}

impl Kind {
    fn fits(self, def: &ResultDef) -> bool {
        match self {
            Kind::Size => def.role == Role::Size,
            Kind::Place(axis) => match def.role {
                Role::Abscissa => axis == 'X',
                Role::Ordinate => axis == 'Y',
                Role::Level => axis == 'Z',
                Role::Reading => def.code.rsplit_once('.').is_some_and(|(_, of)| of.eq_ignore_ascii_case(&axis.to_string())),
                _ => false,
            },
            Kind::Angle => def.role.is_angle(),
        }
    }
}

/// A line's kind, its nominal and its actual value.
fn printed(line: &str) -> Option<(Kind, f64, f64)> {
    let line = line.replace('*', " ");
    let line = line.trim_start();
    let (word, rest) = line.split_once(' ')?;
    let (before, after) = rest.split_once("ACTUAL")?;
    let before = before.trim_start();
    let letter = before.chars().next()?;
    let (kind, nominal) = match (word, letter) {
        ("SIZE", 'D' | 'X' | 'Y' | 'Z') => (Kind::Size, &before[1..]),
        ("POSN", 'X' | 'Y' | 'Z') => (Kind::Place(letter), &before[1..]),
        ("ANG", _) => (Kind::Angle, before),
        _ => return None,
    };
    let number = |text: &str| line::number(text.trim_start()).map(|(number, _)| number);
    Some((kind, number(nominal)?, number(after)?))
}

/// The text with such lines as results of the job: `diameter=40.0132`. One of no result of the job is an error: it is of another part.
pub fn as_results<'t>(checker: &mut Checker, text: &'t str, expected: &Expected<'_>) -> Cow<'t, str> {
    if !text.contains("ACTUAL") {
        return Cow::Borrowed(text);
    }
    let formula = &expected.path.formula;
    let mut taken = vec![false; formula.results.len()];
    let mut lines = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let Some((kind, nominal, actual)) = printed(line) else {
            lines.push(Cow::Borrowed(line));
            continue;
        };
        let is = |def: &ResultDef| {
            let unit = if def.role.is_angle() { 1.0 } else { checker.scale };
            kind.fits(def) && (def.nominal / unit - nominal).abs() < LAST_DIGIT
        };
        let found = (0..taken.len()).find(|i| !taken[*i] && is(&formula.results[*i]));
        // One that comes again is another run, of which the results say it.
        let found = found.or_else(|| formula.results.iter().position(is));
        match found {
            Some(i) => {
                taken[i] = true;
                lines.push(Cow::Owned(format!("{}={}", formula.code(&formula.results[i]), decimal(actual, 6))));
            }
            None => {
                let message = text!(
                    "Line {line} is of a nominal value that no result of this job has: \"{text}\". Is it from this job?",
                    number + 1,
                    line.trim().chars().take(60).collect::<String>()
                );
                checker.error("unclear-line", "measured", message);
                lines.push(Cow::Borrowed(""));
            }
        }
    }
    Cow::Owned(lines.join("\n"))
}
