//! Jobs from text: a dump of a CAM system's parameters, or a program.

mod call_to_job;
mod codes;
mod dialect_markers;
mod dump;
pub mod insert;
mod klartext;
mod program;
pub mod toolpath;

/// Kind of a move in a program.
pub use crate::control::trace::Kind as TraceKind;
pub use dump::recognises as is_dump;
pub use program::{TraceMove, TraceRow};
pub use toolpath::{Toolpath, read_program};

use crate::control::inside;
use crate::cycle::CycleDef;
use crate::form::{Finding, Level, Value};
use crate::job::{JobError, LONGEST_TEXT, SECTIONS};
use crate::text::{Text, text};

/// Result of reading a text.
#[derive(Debug)]
pub enum Imported {
    /// A job, complete or made from parameters.
    Job {
        /// It may have errors: the check reports them.
        job: Value,
        /// Notes about ignored and unknown parts.
        findings: Vec<Finding>,
    },
    /// The moves of a program without a job.
    Moves {
        /// The moves, to be drawn.
        trace: TraceRow,
        /// Notes about ignored and unknown parts.
        findings: Vec<Finding>,
    },
}

impl Imported {
    /// The job; `None` for a program of moves.
    pub fn job(&self) -> Option<&Value> {
        match self {
            Imported::Job { job, .. } => Some(job),
            Imported::Moves { .. } => None,
        }
    }

    /// The moves of a program without a job.
    pub fn trace(&self) -> Option<&TraceRow> {
        match self {
            Imported::Job { .. } => None,
            Imported::Moves { trace, .. } => Some(trace),
        }
    }

    /// Notes about ignored and unknown parts.
    pub fn findings(&self) -> &[Finding] {
        match self {
            Imported::Job { findings, .. } | Imported::Moves { findings, .. } => findings,
        }
    }
}

/// Makes a job from a text: a job (JSON), a dump of CmdPrm codes (text, CSV, JSON, or copied from a log), a program for any control that was written here, or a
/// Klartext or ISO program with cycle 1411. For any other program the moves are read, without a job.
pub fn import(text: &str) -> Result<Imported, JobError> {
    check_length(text)?;
    let plain = text.strip_prefix('\u{feff}').unwrap_or(text);
    import_with(plain, crate::job::from_json(plain).ok().as_ref())
}

fn check_length(text: &str) -> Result<(), JobError> {
    if fits(text, LONGEST_TEXT) {
        Ok(())
    } else {
        Err(too_long(length(text)))
    }
}

/// Length of a text in UTF-16 units, as JavaScript counts it.
fn length(text: &str) -> usize {
    text.encode_utf16().count()
}

/// Whether a text has at most `most` UTF-16 units. It never has more of them than bytes.
pub(crate) fn fits(text: &str, most: usize) -> bool {
    text.len() <= most || length(text) <= most
}

/// Refusal of a text with this number of UTF-16 units.
pub fn too_long(units: usize) -> JobError {
    let message = text!(
        "This text has {size} million characters: a job is made of at most {most} million",
        millions(units),
        LONGEST_TEXT / 1_000_000
    );
    refused_as_too_long(message)
}

fn millions(units: usize) -> String {
    crate::num::decimal(units as f64 / 1e6, 1)
}

fn refused_as_too_long(message: Text) -> JobError {
    JobError {
        findings: vec![Finding::new(Level::Error, "text-too-long", "", message)],
    }
}

/// Makes a job from a text that is already parsed, if it is JSON.
pub fn import_with(text: &str, json: Option<&Value>) -> Result<Imported, JobError> {
    check_length(text)?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // An inserted program is restored, and read without the rest of the text.
    let alone = inside::alone(text);
    let text = alone.as_deref().unwrap_or(text);
    if let Some(json) = json.filter(|json| matches!(json, Value::Map(_) | Value::List(_))) {
        let codes = codes::json_entries(json);
        let dump = codes.iter().any(|e| e.code == -1);
        // A text that is a job by its keys is taken unchanged: nothing of a user's work is lost, the check reports faults.
        if matches!(json, Value::Map(_))
            && (json.get("cycle").is_some() || json.get("cycles").is_some() || !dump)
        {
            return Ok(Imported::Job {
                job: json.clone(),
                findings: crate::job::check(json),
            });
        }
        if dump {
            return dump::import(&codes);
        }
    }
    if program::says_job(text) || klartext::recognises(text) {
        program::check_signs(text)?;
    }
    if program::says_job(text) {
        return if klartext::recognises(text) {
            klartext::import_with_header(text)
        } else {
            program::import(text)
        };
    }
    if dump::recognises(text) {
        return dump::import(&codes::entries(text));
    }
    // A text that only looks like a program of moves may be a Klartext one whose comments mention them.
    klartext::import(text).or_else(|error| program::trace(text).unwrap_or(Err(error)))
}

/// Whether a job with this cycle can have a value at `path`, such as `cycle.touches[2].point`.
fn has_place(def: &CycleDef, path: &str) -> bool {
    let mut plain = String::new();
    let mut rest = path;
    while let Some((before, inner)) = rest.split_once('[') {
        let Some((index, after)) = inner.split_once(']') else {
            return false;
        };
        let most = match before {
            "cycle.touches" => crate::path::MAX_TOUCHES,
            "cycle.custom" => 200,
            "tool.frame" => 50,
            _ => 3,
        };
        if !index.parse::<usize>().is_ok_and(|i| i < most) {
            return false;
        }
        plain.push_str(before);
        plain.push_str("[]");
        rest = after;
    }
    plain.push_str(rest);
    // A point may be given axis by axis.
    let plain = plain.as_str();
    let whole = plain.strip_suffix("[]").unwrap_or(plain);
    let known = |section: &str, fields: &[crate::form::Field]| {
        let key = if section.is_empty() {
            Some(whole)
        } else {
            whole
                .strip_prefix(section)
                .and_then(|k| k.strip_prefix('.'))
        };
        key.is_some_and(|key| fields.iter().any(|f| f.key == key))
    };
    SECTIONS
        .iter()
        .any(|form| form.key != "part" && known(form.key, form.fields))
        || known("cycle", def.fields)
        || def.sections.iter().any(|s| {
            plain.strip_prefix("cycle.") == Some(s.key)
                || known(&format!("cycle.{}", s.key), s.fields)
        })
        || (def.place.is_some()
            && matches!(
                whole,
                "cycle.touches" | "cycle.touches[].point" | "cycle.touches[].vector"
            ))
        || (def.number.is_some()
            && matches!(
                plain,
                "cycle.custom"
                    | "cycle.custom[].code"
                    | "cycle.custom[].type"
                    | "cycle.custom[].value"
            ))
        || matches!(
            plain,
            "cycle.type"
                | "tool.frame"
                | "tool.frame[].rot"
                | "tool.frame[].angle"
                | "tool.frame[].mirror"
        )
}

/// Sets a value at a path such as `cycle.touches[2].point[0]` and creates missing parts. Nothing is set if the path leads through another kind of value.
fn set(job: &mut Value, path: &str, value: Value) {
    const MOST: usize = 1000;
    let (key, rest) = match path.find(['.', '[']) {
        Some(at) => (&path[..at], &path[at..]),
        None => (path, ""),
    };
    let place = if let (Value::List(items), Ok(index)) = (&mut *job, key.parse::<usize>()) {
        if index >= MOST {
            return;
        }
        while items.len() <= index {
            items.push(Value::Map(Vec::new()));
        }
        &mut items[index]
    } else if let Value::Map(entries) = job {
        let at = entries
            .iter()
            .position(|(k, _)| k == key)
            .unwrap_or_else(|| {
                entries.push((key.to_owned(), Value::Map(Vec::new())));
                entries.len() - 1
            });
        &mut entries[at].1
    } else {
        return;
    };
    if let Some(inner) = rest.strip_prefix('[') {
        let Some((index, after)) = inner.split_once(']') else {
            return;
        };
        if !matches!(place, Value::List(_)) {
            *place = Value::List(Vec::new());
        }
        set(place, &format!("{index}{after}"), value);
    } else if let Some(inner) = rest.strip_prefix('.') {
        if !matches!(place, Value::Map(_)) {
            *place = Value::Map(Vec::new());
        }
        set(place, inner, value);
    } else {
        *place = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_make_what_is_not_there() {
        let mut job = Value::Map(Vec::new());
        set(&mut job, "cycle.touches[1].point[2]", Value::Number(7.0));
        set(&mut job, "cycle.origin", Value::Flag(true));
        set(&mut job, "cycle.origin[0]", Value::Number(1.0));
        set(&mut job, "cycle.touches[99999].point", Value::Null);
        let touches = job.get("cycle").and_then(|c| c.get("touches")).unwrap();
        let Value::List(items) = touches else {
            panic!("{touches:?}")
        };
        assert_eq!(items.len(), 2);
        let Some(Value::List(point)) = items[1].get("point") else {
            panic!("{items:?}")
        };
        assert_eq!(point[2], Value::Number(7.0));
        assert_eq!(
            job.get("cycle").unwrap().get("origin"),
            Some(&Value::List(vec![Value::Number(1.0)]))
        );
    }
}
