//! Values measured on a real machine, in any copied form: points, results, or the log of a sender.

mod compared;
mod end_state;
mod grbl;
mod line;
mod log;
mod offset;
mod points;
mod reach;
mod results;

use crate::form::{Checker, Value};
use crate::geom::Vec3;
use crate::path::Path;
use crate::text::{Text, text};

/// Context that measured values belong to.
#[derive(Clone, Debug)]
pub struct MeasurementContext<'a> {
    /// Path with the touches.
    pub path: &'a Path,
    /// Radius of the ball, mm.
    pub radius: f64,
    /// Names of the program in the job and on the control: a printed text may begin with one.
    pub names: [String; 2],
    /// Variables in which native cycles save results, such as `Q153`, with the indices of the results.
    pub kept: Vec<(String, usize)>,
}

#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// Ball centres, one for each touch, mm in the work coordinate system; `None` if a touch missed. Empty if the text gives results.
    pub points: Vec<Option<Vec3>>,
    /// Values of the formula's results, if the text gives these instead of touches; mm or degrees.
    pub results: Option<Vec<Option<f64>>>,
    /// Position of the machine, if the log gives it.
    pub stand: Option<EndState>,
}

/// State of the machine after the touches, from a log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EndState {
    /// The work offset in which the touches were made, 1 = G54; `None` if the log does not say.
    pub offset: Option<u8>,
    /// Reason to doubt that the machine is at the end of the program; `None` if the log gives none.
    pub reason: Option<Text>,
}

/// A line of a text with its number, from 1.
type Numbered<'a> = (usize, &'a str);

/// Reads measured values: a list of `[X, Y, Z]` or `{x, y, z}`, or text. A text is one of
/// - points, one a line: CSV, LinuxCNC's PROBEOPEN log, or `X1.2 Y3.4 Z5.6`, in the job's units;
/// - results, one `center.x=1.2345` a line, in the job's units and degrees, or as Renishaw's and HEIDENHAIN's cycles print them;
/// - a log with grbl's `[PRB:x,y,z:1]`, in machine coordinates, and with the work offset.
///
/// Every problem is reported at `measured` or `measured[i]`. A text with two forms is refused: a choice would be a guess.
pub fn read(checker: &mut Checker, value: &Value, expected: &MeasurementContext<'_>) -> Measured {
    match value {
        Value::List(items) => Measured {
            points: points::list(checker, items),
            ..Measured::default()
        },
        Value::Text(text) => read_text(checker, text, expected),
        other => {
            let message = text!(
                "Measured points must be a list of [X, Y, Z] or text with one point a line, not {given}",
                other.noun()
            );
            checker.error("wrong-type", "measured", message);
            Measured::default()
        }
    }
}

/// Reports a wrong number of points, if reading found no fault, and points that their touches cannot have reached.
pub fn check(checker: &mut Checker, measured: &Measured, expected: &MeasurementContext<'_>) {
    let (given, touches) = (measured.points.len(), expected.path.touches.len());
    if measured.results.is_none() && given != touches && !checker.failed() {
        let message = text!(
            "Points given: {count}, touches: {touches}. One ball centre a touch is needed, in their order",
            given,
            touches
        );
        checker.error("wrong-count", "measured", message);
    }
    reach::check(checker, &measured.points, expected);
}

fn read_text(checker: &mut Checker, text: &str, expected: &MeasurementContext<'_>) -> Measured {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let text = &*compared::as_results(checker, text, expected);
    // A line that starts with # is a comment, unless it is a variable: `#138 = 25.013`.
    let is_variable = |line: &str| {
        let mut kept = expected
            .kept
            .iter()
            .filter_map(|(variable, _)| line.strip_prefix(variable.as_str()));
        kept.any(|rest| !rest.starts_with(|c: char| c.is_ascii_alphanumeric()))
    };
    let is_comment = |line: &str| line.starts_with('#') && !is_variable(line);
    let lines: Vec<Numbered<'_>> = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty() && !is_comment(line))
        .collect();
    let of = |form: Form| {
        lines
            .iter()
            .find(|(_, line)| Form::of(line, expected) == Some(form))
            .map(|(number, _)| *number)
    };
    let [log, mut results, letters] = [Form::Log, Form::Result, Form::Letters].map(of);
    if log.is_some() {
        // A sender lists other values, too.
        results = lines
            .iter()
            .find(|(_, line)| results::known(&line::without_comments(line), expected))
            .map(|(number, _)| *number);
    }
    let mut forms = [log, results, letters].into_iter().flatten();
    if let (Some(one), Some(other)) = (forms.next(), forms.next()) {
        let message = text!(
            "Lines {one} and {other} are of different kinds: give results, points, or grbl's PRB reports, and not two of them",
            one,
            other
        );
        checker.error("mixed-forms", "measured", message);
        return Measured::default();
    }
    if log.is_some() {
        return grbl::read(checker, &lines, expected);
    }
    if results.is_some() {
        return results::read(checker, &lines, expected);
    }
    let points = if letters.is_some() {
        points::letters(checker, &lines)
    } else {
        points::lines(checker, text)
    };
    Measured {
        points,
        ..Measured::default()
    }
}

/// Form of a line with measured values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// grbl's report of a touch.
    Log,
    /// `center.x=1.2345`.
    Result,
    /// `X1.2 Y3.4 Z5.6`.
    Letters,
}

impl Form {
    /// `None` for plain numbers, and for a line without a measurement.
    fn of(text: &str, expected: &MeasurementContext<'_>) -> Option<Form> {
        let bare = line::without_comments(text);
        if bare.contains("PRB:") {
            Some(Form::Log)
        } else if line::letters(&bare).is_some() && !line::is_sent(&bare) {
            Some(Form::Letters)
        } else if !results::pairs(&bare).is_empty() || results::known(&bare, expected) {
            Some(Form::Result)
        } else {
            None
        }
    }
}

/// Whether a line consists of numbers: it could be a point.
fn is_numbers(line: &str) -> bool {
    line.contains(|c: char| c.is_ascii_digit())
        && line
            .chars()
            .all(|c| c.is_ascii_digit() || c.is_whitespace() || "+-.,;".contains(c))
}

/// Reports a line that may be a measurement but matches none of the forms around it.
fn unclear(checker: &mut Checker, number: usize, line: &str) {
    let message = text!(
        "Line {line} may be a measurement but does not match the lines around it: \"{text}\". Remove it, or paste only the measurements",
        number,
        line.chars().take(60).collect::<String>()
    );
    checker.error("unclear-line", "measured", message);
}
