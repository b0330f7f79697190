//! Reads the lists of a config.

use crate::form::{Checker, Value, printable};
use crate::text::{Part, text};

/// Longest list: rules of fields, machines, styli, zones, findings.
pub const MOST: usize = 200;

/// Entries of a list, each with its path. Reports a value that is not a list, and a list that is too long.
pub fn entries<'v>(
    checker: &mut Checker,
    value: Option<&'v Value>,
    path: &str,
) -> Vec<(String, &'v Value)> {
    let items = checker.list(value, path).unwrap_or_default();
    if items.len() > MOST {
        let message = text!(
            "{path} may have {most} entries, not {count}",
            path.to_owned(),
            MOST,
            items.len()
        );
        checker.error("too-long", path, message);
        return Vec::new();
    }
    items
        .iter()
        .enumerate()
        .map(|(i, item)| (format!("{path}[{i}]"), item))
        .collect()
}

/// Reads the entries of a list and reports those that `one` rejects. `known` names the valid entries.
pub fn list_of<T>(
    checker: &mut Checker,
    value: Option<&Value>,
    path: &str,
    known: &str,
    one: impl Fn(&Value) -> Option<T>,
) -> Vec<T> {
    let mut found = Vec::new();
    for (at, item) in entries(checker, value, path) {
        if let Some(entry) = one(item) {
            found.push(entry);
            continue;
        }
        let given: Part = if let Value::Text(word) = item {
            printable(word).into()
        } else {
            item.noun().into()
        };
        checker.error(
            "unknown-value",
            at.clone(),
            text!(
                "{path} must be one of {words}, not {given}",
                at,
                known.to_owned(),
                given
            ),
        );
    }
    found
}

/// Reads a list that limits a choice. An empty one would allow nothing.
pub fn some_of<T>(
    checker: &mut Checker,
    value: Option<&Value>,
    path: &str,
    known: &str,
    one: impl Fn(&Value) -> Option<T>,
) -> Option<Vec<T>> {
    if *value? == Value::List(Vec::new()) {
        let message = text!(
            "{path} must allow at least one value: omit it to allow everything",
            path.to_owned()
        );
        checker.error("missing", path, message);
    }
    Some(list_of(checker, value, path, known, one))
}
