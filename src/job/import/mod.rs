//! A job from text: a dump of a CAM system's parameters, or a program.

mod codes;
mod dump;
mod klartext;
mod sinumerik;

pub use dump::recognises as is_dump;

use crate::job::JobError;
use crate::spec::{Finding, Value};

/// A job made of a text, and what had to be said about it.
#[derive(Debug)]
pub struct Imported {
    /// The job.
    pub job: Value,
    /// Notes: what was passed over, what could not be known.
    pub findings: Vec<Finding>,
}

/// Longest text that is read.
const LONGEST: usize = 4_000_000;

/// Makes a job of a text that is not a job itself: a dump of CmdPrm codes (text, CSV, JSON, or as it was copied from a log), a
/// SINUMERIK program of ours, or a Klartext or ISO program with cycle 1411.
pub fn import(text: &str) -> Result<Imported, JobError> {
    let text = &text[..text.floor_char_boundary(LONGEST)];
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if sinumerik::says_job(text) {
        sinumerik::import(text)
    } else if dump::recognises(text) {
        dump::import(text)
    } else {
        // What only looks like a SINUMERIK program may be a Klartext one whose comments mention it.
        klartext::import(text).or_else(|error| if sinumerik::recognises(text) { sinumerik::import(text) } else { Err(error) })
    }
}

/// Sets a value at a path such as `cycle.touches[2].point[0]`, making what is not there. Nothing is set where the path leads
/// through a value that is none of these.
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
        let at = entries.iter().position(|(k, _)| k == key).unwrap_or_else(|| {
            entries.push((key.to_owned(), Value::Map(Vec::new())));
            entries.len() - 1
        });
        &mut entries[at].1
    } else {
        return;
    };
    if let Some(inner) = rest.strip_prefix('[') {
        let Some((index, after)) = inner.split_once(']') else { return };
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
        let Value::List(items) = touches else { panic!("{touches:?}") };
        assert_eq!(items.len(), 2);
        let Some(Value::List(point)) = items[1].get("point") else { panic!("{items:?}") };
        assert_eq!(point[2], Value::Number(7.0));
        assert_eq!(job.get("cycle").unwrap().get("origin"), Some(&Value::List(vec![Value::Number(1.0)])));
    }
}
