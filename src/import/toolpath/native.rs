//! Calls of native cycles: named from the table of calls, with the meaning of every argument and contradictions between them.

use serde::Serialize;

use crate::control::edition::Edition;
use crate::control::heidenhain::read::{Given, assignments};
use crate::control::iso::lex::number;
use crate::control::native::{self, Argument, Call};
use crate::form::{Value, printable};
use crate::import::call_to_job::CallContext;
use crate::import::toolpath::Toolpath;
use crate::num::decimal;

/// Largest number of listed calls.
const MOST_CALLS: usize = 10_000;

/// A call of a native cycle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NativeCall {
    /// The 0-based line in its file.
    pub line: u32,
    /// Its file: 0 is the program, higher numbers are files of subprograms, counted from 1.
    pub file: u32,
    /// Notation in programs: `G65 P9814`, `TCH PROBE 412`, `CYCLE977`.
    pub name: String,
    /// Its measurement or effect; `None` for an unknown call.
    pub title: Option<&'static str>,
    /// How well it is known: `sourced` or `recalled`.
    pub mark: Option<&'static str>,
    /// Source of the facts.
    pub source: Option<&'static str>,
    /// Its arguments in their order.
    pub arguments: Vec<NativeArgument>,
    /// Contradictions between arguments: `X and Y exclude each other`.
    pub contradictions: Vec<String>,
    /// The call as a job, if it is a documented cycle and gives enough.
    #[serde(skip)]
    pub job: Option<Value>,
}

/// An argument of a call.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NativeArgument {
    /// Letter, Q number, or position between the commas.
    pub name: String,
    /// `None` if it is not a number or is computed from unknown values.
    pub value: Option<f64>,
    /// Meaning; `None` if it is unknown.
    pub meaning: Option<&'static str>,
    /// `length`, `angle`, `feed` or `none`.
    pub unit: Option<&'static str>,
    /// Values that the control accepts, if known: `0 to 1`, `more than 0`.
    pub range: Option<String>,
}

/// Lists a call and returns its kind. `arguments`: names and values. `place`: position of the stylus in the program's units; NaN is unknown.
pub(super) fn listed(
    path: &mut Toolpath,
    line: usize,
    name: &str,
    arguments: Vec<(String, f64)>,
    place: [f64; 3],
) -> Option<&'static Call> {
    let call = if path.centroid {
        native::find_centroid(name)
    } else {
        native::find_of(path.edition, name)
    };
    let metric = path.metric.unwrap_or(true);
    let post = match name {
        _ if name.starts_with("G65 P88") => Some("brother"),
        _ if name.starts_with("CALL O") => Some("okuma"),
        _ if name.starts_with("G65 P98") && path.edition == Edition::Mazak => Some("mazak"),
        _ => None,
    };
    let job = call.filter(|_| !path.centroid).and_then(|call| {
        CallContext {
            name: call.name,
            post,
            edition: path.edition,
            arguments: &arguments,
            place,
            metric,
        }
        .job()
    });
    if path.calls.len() == MOST_CALLS {
        return call;
    }
    let argument = |(name, value): (String, f64)| {
        let known = call.and_then(|call| call.argument(&name));
        NativeArgument {
            value: (!value.is_nan()).then_some(value),
            meaning: known.map(|argument| argument.meaning),
            unit: known.map(|argument| argument.unit.word()),
            range: known.and_then(Argument::range_words),
            name,
        }
    };
    let arguments: Vec<NativeArgument> = arguments.into_iter().map(argument).collect();
    path.calls.push(NativeCall {
        line: line as u32,
        file: 0,
        // A Brother and an Okuma write the same calls differently.
        name: match call {
            Some(call)
                if !["G65 P88", "CALL O"]
                    .iter()
                    .any(|other| name.starts_with(other)) =>
            {
                call.name.to_owned()
            }
            _ => printable(name),
        },
        title: call.map(|call| call.title),
        mark: call.map(|call| call.mark.word()),
        source: call.map(|call| call.source),
        contradictions: call.map_or_else(Vec::new, |call| {
            contradictions(call, &arguments, path.edition)
        }),
        job,
        arguments,
    });
    call
}

fn contradictions(call: &Call, arguments: &[NativeArgument], edition: Edition) -> Vec<String> {
    let given = |name: &str| arguments.iter().any(|argument| argument.name == name);
    // A measuring macro of Renishaw's shares these letters with the others. 9835 needs T and M, and T of a rectangle is a distance.
    let own = !call.shared.is_empty()
        && call
            .argument("T")
            .is_some_and(|t| t.meaning == native::CORRECTED);
    let edition = if own { edition.excludes() } else { &[] };
    let pairs = call
        .excludes
        .iter()
        .chain(edition.iter().filter(|pair| !call.excludes.contains(pair)));
    let both = pairs.filter(|(a, b)| given(a) && given(b));
    let missing = call
        .needs
        .iter()
        .filter(|names| !names.split(' ').any(given));
    let both = both.map(|(a, b)| format!("{a} and {b} exclude each other"));
    let outside = arguments.iter().filter_map(|given| {
        let (known, value) = (call.argument(&given.name)?, given.value?);
        let range = known.range_words().filter(|_| !known.takes(value))?;
        Some(format!(
            "{} is {}: {range} is possible",
            given.name,
            decimal(value, 4)
        ))
    });
    both.chain(missing.map(|names| format!("{} is missing", names.replace(' ', " or "))))
        .chain(outside)
        .collect()
}

/// Letters and values of a block after its first word: `G65 P9814 D25. Z-5.`
pub(super) fn letters(code: &[u8]) -> Vec<(String, f64)> {
    let mut found: Vec<(String, f64)> = Vec::new();
    let mut at = 0;
    while at < code.len() {
        match code[at] {
            b'(' | b';' => break,
            letter if letter.is_ascii_alphabetic() => {
                at += 1;
                let (value, end) = number(code, at).unwrap_or((f64::NAN, at));
                let name = char::from(letter.to_ascii_uppercase()).to_string();
                if found.iter().all(|(known, _)| *known != name) {
                    found.push((name, value));
                }
                at = end;
            }
            b'"' => {
                at += 1 + code[at + 1..]
                    .iter()
                    .position(|b| *b == b'"')
                    .map_or(code.len() - at, |end| end + 1)
            }
            _ => at += 1,
        }
    }
    found
}

/// The Q parameters of a block, by their numbers. `known` has the value of a parameter.
pub(super) fn q_parameters(text: &str, known: impl Fn(u32) -> f64) -> Vec<(u32, f64)> {
    let value = |given: Given| match given {
        Given::Value(Value::Number(x)) => x,
        Given::Parameter(number, false) => known(number),
        Given::Parameter(number, true) => -known(number),
        _ => f64::NAN,
    };
    assignments(text)
        .into_iter()
        .map(|(number, given)| (number, value(given)))
        .collect()
}

/// Arguments of `CYCLE977(1101,,,1,…)` by their positions from 1, without empty ones.
pub(super) fn places(code: &[u8]) -> Vec<(String, f64)> {
    let Some(open) = code.iter().position(|b| *b == b'(') else {
        return Vec::new();
    };
    let inner = &code[open + 1..];
    let inner = &inner[..inner
        .iter()
        .rposition(|b| *b == b')')
        .unwrap_or(inner.len())];
    let mut found = Vec::new();
    for (i, part) in inner.split(|b| *b == b',').enumerate().take(60) {
        let part = part.trim_ascii();
        if !part.is_empty() && part != b"\"\"" {
            let value = number(part, 0)
                .filter(|(_, end)| *end == part.len())
                .map_or(f64::NAN, |(x, _)| x);
            found.push(((i + 1).to_string(), value));
        }
    }
    found
}
