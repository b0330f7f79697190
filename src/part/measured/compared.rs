//! Print-outs of measuring cycles: actual values with their nominal ones. No line names a result: kind and nominal value identify it.
//!
//! Sources. Renishaw's macro O9730 in the edition for Haas, one result a line: `SIZE D 40.0000 ACTUAL 40.0132 TOL 0.5000 DEV 0.0132`, `POSN X …`, `ANG …`;
//! DPRNT prints blanks as `*`. HEIDENHAIN's TNC guide, "Recording the results of measurement": the log of cycle 421 (Q281), with the same labels under `Nominal
//! values:` and under `Actual values:`. The labels of other HEIDENHAIN cycles are not printed there: those for a length, a width and an angle are recalled [R].

use std::borrow::Cow;
use std::ops::Range;

use crate::form::Checker;
use crate::formula::{ResultDef, Role};
use crate::num::decimal;
use crate::part::measured::{Form, MeasurementContext, line};
use crate::text::text;

/// Largest rounding error: both print four decimals.
const LAST_DIGIT: f64 = 6e-4;

/// Kind of a compared value.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Size,
    /// Coordinate along this axis: `X`, `Y` or `Z`, as in G17.
    Place(char),
    Angle,
    /// Value with an unknown label.
    Unknown,
}

impl Kind {
    fn fits(self, def: &ResultDef) -> bool {
        match self {
            Kind::Size => def.role == Role::Size,
            Kind::Place(axis) => match def.role {
                Role::Abscissa => axis == 'X',
                Role::Ordinate => axis == 'Y',
                Role::Level => axis == 'Z',
                Role::Reading => def
                    .code
                    .rsplit_once('.')
                    .is_some_and(|(_, of)| of.eq_ignore_ascii_case(&axis.to_string())),
                _ => false,
            },
            Kind::Angle => def.role.is_angle(),
            Kind::Unknown => false,
        }
    }
}

/// An actual value and its nominal one, in the unit of the text.
struct Compared<'t> {
    /// Line of the actual value, from 0.
    line: usize,
    text: &'t str,
    kind: Kind,
    nominal: f64,
    actual: f64,
}

/// Print-out of one cycle.
struct Print<'t> {
    found: Vec<Compared<'t>>,
    /// Its lines, which contain nothing else.
    lines: Vec<usize>,
    /// mm in a unit of length.
    scale: f64,
}

/// Lines of Renishaw's macros.
fn renishaw(text: &str, scale: f64) -> impl Iterator<Item = Print<'_>> {
    let compared = |(line, text): (usize, &'_ str)| {
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
        Some((line, kind, number(nominal)?, number(after)?))
    };
    text.lines().enumerate().filter_map(move |numbered| {
        let (line, kind, nominal, actual) = compared(numbered)?;
        Some(Print {
            found: vec![Compared {
                line,
                text: numbered.1,
                kind,
                nominal,
                actual,
            }],
            lines: vec![line],
            scale,
        })
    })
}

/// Logs of HEIDENHAIN's cycles (`TCHPR421.TXT`).
fn heidenhain<'t>(text: &'t str, scale: f64, expected: &MeasurementContext<'_>) -> Vec<Print<'t>> {
    let lines: Vec<&str> = text.lines().collect();
    let begins: Vec<usize> = (0..lines.len())
        .filter(|i| lines[*i].trim_start().starts_with("Measuring log"))
        .collect();
    let ends = begins.iter().skip(1).copied().chain([lines.len()]);
    let plain = |line: &usize| Form::of(lines[*line], expected).is_none();
    let log = |(begin, end): (&usize, usize)| {
        let (found, unit) = log(&lines, *begin..end);
        Print {
            found,
            lines: (*begin..end).filter(plain).collect(),
            scale: unit.unwrap_or(scale),
        }
    };
    begins.iter().zip(ends).map(log).collect()
}

/// Actual values of one log, and its unit: mm in a unit of length. A value follows its label on the same line or the next.
fn log<'t>(lines: &[&'t str], range: Range<usize>) -> (Vec<Compared<'t>>, Option<f64>) {
    let (mut section, mut label) = ("", "");
    let (mut nominals, mut found, mut unit) = (Vec::new(), Vec::new(), None);
    for line in range {
        let (name, value) = lines[line]
            .rsplit_once(':')
            .map_or(("", lines[line]), |(name, value)| (name.trim(), value));
        if !name.is_empty() {
            label = name;
        }
        let Some(value) = number(value) else {
            if name.ends_with("values")
                || ["Deviations", "Further measuring results"].contains(&name)
            {
                section = name;
            }
            continue;
        };
        if label.starts_with("Type of dimension") {
            unit = Some(if value == 1.0 { 25.4 } else { 1.0 });
        } else if section == "Nominal values" {
            nominals.push((label, value));
        } else if section == "Actual values" {
            let at = nominals.iter().position(|(of, _)| *of == label);
            // Without a nominal value it belongs to no result, and is reported.
            let nominal = at.map_or(f64::NAN, |at| nominals.remove(at).1);
            found.push(Compared {
                line,
                text: label,
                kind: labelled(label),
                nominal,
                actual: value,
            });
        }
    }
    (found, unit)
}

/// Kind of a value by its HEIDENHAIN label. The first three labels are printed in the guide, the others are recalled [R].
fn labelled(label: &str) -> Kind {
    let has = |word: &str| label.contains(word);
    if has("reference axis") {
        Kind::Place('X')
    } else if has("minor axis") {
        Kind::Place('Y')
    } else if has("Diameter") || has("ength") || has("idth") {
        Kind::Size
    } else if has("ngle") {
        Kind::Angle
    } else {
        Kind::Unknown
    }
}

/// The number at the start of a text, after blanks.
fn number(text: &str) -> Option<f64> {
    line::number(text.trim_start()).map(|(number, _)| number)
}

/// The text with such values as results of the job: `diameter=40.0132`. A value without a result in the job is an error: it belongs to another part.
pub fn as_results<'t>(
    checker: &mut Checker,
    text: &'t str,
    expected: &MeasurementContext<'_>,
) -> Cow<'t, str> {
    let mut prints: Vec<Print<'_>> = Vec::new();
    if text.contains("ACTUAL") {
        prints.extend(renishaw(text, checker.scale));
    }
    if text.contains("Actual values") {
        prints.extend(heidenhain(text, checker.scale, expected));
    }
    if prints.is_empty() {
        return Cow::Borrowed(text);
    }
    let formula = &expected.path.formula;
    let mut taken = vec![false; formula.results.len()];
    let mut lines: Vec<Cow<'_, str>> = text.lines().map(Cow::Borrowed).collect();
    for print in prints {
        print
            .lines
            .iter()
            .for_each(|line| lines[*line] = Cow::Borrowed(""));
        for Compared {
            line,
            text,
            kind,
            nominal,
            actual,
        } in print.found
        {
            let unit = if kind == Kind::Angle {
                1.0
            } else {
                print.scale
            };
            let is = |def: &ResultDef| {
                kind.fits(def) && (def.nominal / unit - nominal).abs() < LAST_DIGIT
            };
            let found = (0..taken.len()).find(|i| !taken[*i] && is(&formula.results[*i]));
            // A repeated value belongs to another run; reading the results reports it.
            let Some(i) = found.or_else(|| formula.results.iter().position(is)) else {
                let message = text!(
                    "Line {line} has a nominal value that no result of this job has: \"{text}\". Is it from this job?",
                    line + 1,
                    text.trim().chars().take(60).collect::<String>()
                );
                checker.error("unclear-line", "measured", message);
                continue;
            };
            taken[i] = true;
            let actual = if kind == Kind::Angle {
                actual
            } else {
                actual * print.scale / checker.scale
            };
            lines[line] = Cow::Owned(format!(
                "{}={}",
                formula.code(&formula.results[i]),
                decimal(actual, 6)
            ));
        }
    }
    Cow::Owned(lines.join("\n"))
}
