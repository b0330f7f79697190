//! What measuring cycles print themselves: an actual value beside its nominal one. No line names a result: its kind and its nominal value say which one it is.
//!
//! Sources. Renishaw's macro O9730 of the edition for Haas, a line a result: `SIZE D 40.0000 ACTUAL 40.0132 TOL 0.5000 DEV 0.0132`, `POSN X …`, `ANG …`;
//! DPRNT prints blanks as `*`. HEIDENHAIN's TNC guide, "Recording the results of measurement": the log of cycle 421 (Q281), the same labels under
//! `Nominal values:` and under `Actual values:`. The labels of other HEIDENHAIN cycles are not printed there: those for a length, a width and an angle are recalled.

use std::borrow::Cow;
use std::ops::Range;

use crate::form::Checker;
use crate::formula::{ResultDef, Role};
use crate::num::decimal;
use crate::part::measured::{Expected, line};
use crate::text::text;

/// Both print four decimals.
const LAST_DIGIT: f64 = 6e-4;

/// What a line is of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Size,
    /// Of this axis: `X`, `Y` or `Z`, as in G17.
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

/// An actual value beside its nominal one, in the unit of the text.
struct Compared<'t> {
    /// The line of the actual value, from 0.
    line: usize,
    text: &'t str,
    kind: Kind,
    nominal: f64,
    actual: f64,
}

/// What a text prints, in mm where it says so itself; with the lines that say nothing else.
struct Print<'t> {
    found: Vec<Compared<'t>>,
    lines: Range<usize>,
    /// mm a unit of length.
    scale: f64,
}

/// Renishaw's lines.
fn renishaw(text: &str, scale: f64) -> Vec<Print<'_>> {
    let of = |(line, text): (usize, &'_ str)| {
        let plain = text.replace('*', " ");
        let (word, rest) = plain.trim_start().split_once(' ')?;
        let (before, after) = rest.split_once("ACTUAL")?;
        let before = before.trim_start();
        let letter = before.chars().next()?;
        let (kind, nominal) = match (word, letter) {
            ("SIZE", 'D' | 'X' | 'Y' | 'Z') => (Kind::Size, &before[1..]),
            ("POSN", 'X' | 'Y' | 'Z') => (Kind::Place(letter), &before[1..]),
            ("ANG", _) => (Kind::Angle, before),
            _ => return None,
        };
        Some((line, kind, first(nominal)?, first(after)?))
    };
    let lines = text.lines().enumerate().filter_map(|line| of(line).map(|found| (line.1, found)));
    let print = |(text, (line, kind, nominal, actual))| Print {
        found: vec![Compared { line, text, kind, nominal, actual }],
        lines: line..line + 1,
        scale,
    };
    lines.map(print).collect()
}

/// The logs of HEIDENHAIN's cycles: `TCHPR421.TXT`. A value stands behind its label or on the next line.
fn heidenhain(text: &str, scale: f64) -> Vec<Print<'_>> {
    const BEGINS: &str = "Measuring log";
    const INCH: &str = "Type of dimension";
    let lines: Vec<&str> = text.lines().collect();
    let begins: Vec<usize> = (0..lines.len()).filter(|i| lines[*i].trim_start().starts_with(BEGINS)).collect();
    let log = |(n, begin): (usize, &usize)| {
        let end = begins.get(n + 1).map_or(lines.len(), |next| *next);
        let mut print = Print { found: Vec::new(), lines: *begin..end, scale };
        let (mut section, mut label, mut nominals) = ("", "", Vec::new());
        for (line, text) in lines.iter().enumerate().take(end).skip(begin + 1) {
            let (name, value) = text.rsplit_once(':').map_or(("", *text), |(name, value)| (name.trim(), value));
            if !name.is_empty() {
                label = name;
            }
            let Some(value) = first(value) else {
                if name.ends_with("values") || ["Deviations", "Further measuring results"].contains(&name) {
                    section = name;
                }
                continue;
            };
            if label.starts_with(INCH) {
                print.scale = if value == 1.0 { 25.4 } else { 1.0 };
            }
            let Some(kind) = labelled(label) else { continue };
            match section {
                "Nominal values" => nominals.push((label, value)),
                "Actual values" => {
                    let Some(at) = nominals.iter().position(|(of, _)| *of == label) else { continue };
                    let (_, nominal) = nominals.remove(at);
                    print.found.push(Compared { line, text, kind, nominal, actual: value });
                }
                _ => {}
            }
        }
        print
    };
    begins.iter().enumerate().map(log).collect()
}

/// What a HEIDENHAIN cycle calls a value. The first three are printed in the guide, the others are recalled.
fn labelled(label: &str) -> Option<Kind> {
    let has = |word: &str| label.contains(word);
    match () {
        () if has("reference axis") => Some(Kind::Place('X')),
        () if has("minor axis") => Some(Kind::Place('Y')),
        () if has("Diameter") || has("ength") || has("idth") => Some(Kind::Size),
        () if has("ngle") => Some(Kind::Angle),
        () => None,
    }
}

/// The number that a text begins with, behind blanks.
fn first(text: &str) -> Option<f64> {
    line::number(text.trim_start()).map(|(number, _)| number)
}

/// The text with such values as results of the job: `diameter=40.0132`. One of no result of the job is an error: it is of another part.
pub fn as_results<'t>(checker: &mut Checker, text: &'t str, expected: &Expected<'_>) -> Cow<'t, str> {
    let prints = match () {
        () if text.contains("ACTUAL") => renishaw(text, checker.scale),
        () if text.contains("Actual values") => heidenhain(text, checker.scale),
        () => return Cow::Borrowed(text),
    };
    let formula = &expected.path.formula;
    let mut taken = vec![false; formula.results.len()];
    let mut lines: Vec<Cow<'_, str>> = text.lines().map(Cow::Borrowed).collect();
    for print in prints {
        lines[print.lines].fill(Cow::Borrowed(""));
        for Compared { line, text, kind, nominal, actual } in print.found {
            let unit = if kind == Kind::Angle { 1.0 } else { print.scale };
            let is = |def: &ResultDef| kind.fits(def) && (def.nominal / unit - nominal).abs() < LAST_DIGIT;
            let found = (0..taken.len()).find(|i| !taken[*i] && is(&formula.results[*i]));
            // One that comes again is another run, of which the results say it.
            let Some(i) = found.or_else(|| formula.results.iter().position(is)) else {
                let message = text!(
                    "Line {line} is of a nominal value that no result of this job has: \"{text}\". Is it from this job?",
                    line + 1,
                    text.trim().chars().take(60).collect::<String>()
                );
                checker.error("unclear-line", "measured", message);
                continue;
            };
            taken[i] = true;
            let actual = if kind == Kind::Angle { actual } else { actual * print.scale / checker.scale };
            lines[line] = Cow::Owned(format!("{}={}", formula.code(&formula.results[i]), decimal(actual, 6)));
        }
    }
    Cow::Owned(lines.join("\n"))
}
