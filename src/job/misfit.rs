//! Whether a form can show a job: sections and lists must have the right type, while single values may be wrong.

use crate::cycle;
use crate::form::{Field, Kind, Value};
use crate::job::SECTIONS;
use crate::job::cycles::{MOST_CYCLES, is_set_up, single_cycle_job};
use crate::text::{Text, text, words};

const LINES: &str = words!("an object with lists of lines");
const POINT: &str = words!("a list of three numbers");
const SINGLE: &str = words!("a single value");
const OBJECT: &str = words!("an object");
const LIST: &str = words!("a list");

/// Reason why the form cannot show a job, as a sentence with the path; `None` if it can.
pub fn form_problem(job: &Value) -> Option<Text> {
    if !matches!(job, Value::Map(_)) {
        return Some(text!("The job must be an object"));
    }
    if is_set_up(job) {
        let Some(Value::List(cycles)) = job.get("cycles") else {
            return must_be(false, "", "cycles", LIST);
        };
        if cycles.is_empty() {
            return Some(text!(
                "A set-up has 1 to {most} cycles, not {count}",
                MOST_CYCLES,
                0
            ));
        }
        let own = |index: usize| match single_cycle_job(job, index) {
            Some(alone) => form_problem(&alone),
            None => Some(text!(
                "{path} must be {what}",
                format!("cycles[{index}]"),
                OBJECT
            )),
        };
        return (0..cycles.len()).find_map(own);
    }
    let Some(cycle @ Value::Map(_)) = job.get("cycle") else {
        return Some(text!("cycle must be an object"));
    };
    let def = match cycle.get("type") {
        Some(Value::Text(key)) => cycle::find(key),
        _ => None,
    };
    let Some(def) = def else {
        return Some(text!("cycle.type must be a known cycle"));
    };
    let sections = SECTIONS.iter().map(|form| {
        if form.key.is_empty() {
            leaves(job, "", form.fields)
        } else {
            section(job, "", form.key, form.fields)
        }
    });
    let cycles = std::iter::once_with(|| leaves(cycle, "cycle.", def.fields)).chain(
        def.sections
            .iter()
            .map(|inner| section(cycle, "cycle.", inner.key, inner.fields)),
    );
    let lists = [
        (
            cycle,
            "cycle.",
            "touches",
            is_touch as fn(&Value) -> bool,
            words!("a list of touches, each with a point and a vector of three numbers"),
        ),
        (
            cycle,
            "cycle.",
            "custom",
            is_map,
            words!("a list of custom codes"),
        ),
        (
            job.get("tool").unwrap_or(&Value::Null),
            "tool.",
            "frame",
            is_map,
            words!("a list of steps, each a turn or a mirror"),
        ),
    ];
    let lists = lists
        .into_iter()
        .map(|(place, prefix, key, fits, what)| match place.get(key) {
            Some(Value::List(items)) if items.iter().all(fits) => None,
            value => must_be(is_out(value), prefix, key, what),
        });
    let sizes = || {
        let sizes = job.get("part").and_then(|part| part.get("sizes"));
        let fits = matches!(sizes, Some(Value::Map(entries)) if entries.iter().all(|(_, size)| is_scalar(size)));
        must_be(
            fits || is_out(sizes),
            "part.",
            "sizes",
            words!("an object of numbers"),
        )
    };
    sections
        .chain(cycles)
        .chain(lists)
        .chain(std::iter::once_with(sizes))
        .find_map(|problem| problem)
}

fn must_be(holds: bool, prefix: &str, key: &str, what: &'static str) -> Option<Text> {
    (!holds).then(|| text!("{path} must be {what}", format!("{prefix}{key}"), what))
}

fn section(place: &Value, prefix: &str, key: &str, fields: &[Field]) -> Option<Text> {
    match place.get(key) {
        Some(inner @ Value::Map(_)) => leaves(inner, &format!("{prefix}{key}."), fields),
        value => must_be(is_out(value), prefix, key, OBJECT),
    }
}

fn leaves(place: &Value, prefix: &str, fields: &[Field]) -> Option<Text> {
    fields.iter().find_map(|field| {
        let value = place.get(field.key)?;
        match field.kind {
            Kind::Point | Kind::NominalPoint => must_be(is_point(value), prefix, field.key, POINT),
            Kind::Lines(_) => must_be(is_lines(value), prefix, field.key, LINES),
            _ => must_be(is_scalar(value), prefix, field.key, SINGLE),
        }
    })
}

/// Whether a value is missing or null, so that the default applies. A value that could not be passed fits everywhere: the check reports it.
fn is_out(value: Option<&Value>) -> bool {
    matches!(value, None | Some(Value::Null | Value::Other(_)))
}

/// Whether a value is a scalar. A truncated last entry of a long list counts as one.
fn is_scalar(value: &Value) -> bool {
    !matches!(value, Value::List(_) | Value::Map(_))
}

fn is_map(value: &Value) -> bool {
    matches!(value, Value::Map(_) | Value::Other(_))
}

fn is_point(value: &Value) -> bool {
    match value {
        Value::List(items) => items.len() == 3 && items.iter().all(is_scalar),
        value => matches!(value, Value::Other(_)),
    }
}

/// Whether a value has lists of single values, or is null.
fn is_lines(value: &Value) -> bool {
    match value {
        Value::Map(entries) => entries.iter().all(|(_, lines)| match lines {
            Value::List(lines) => lines.iter().all(is_scalar),
            lines => is_scalar(lines),
        }),
        value => is_out(Some(value)),
    }
}

fn is_touch(value: &Value) -> bool {
    matches!(value, Value::Other(_))
        || ["point", "vector"]
            .iter()
            .all(|key| value.get(key).is_some_and(is_point))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_fits_whose_sections_and_lists_are_what_they_are() {
        let said = |text: &str| {
            form_problem(&crate::job::from_json(text).unwrap()).map(|text| text.english())
        };
        let of = |rest: &str| said(&format!(r#"{{ "cycle": {{ "type": "hole" }}, {rest} }}"#));
        for fits in [
            r#""name": 5"#,
            r#""feeds": null"#,
            r#""feeds": { "work": "x" }"#,
            r#""part": { "sizes": { "depth": "" } }"#,
        ] {
            assert_eq!(of(fits), None, "{fits}");
        }
        for (broken, why) in [
            (r#""name": []"#, "name must be a single value"),
            (r#""feeds": 7"#, "feeds must be an object"),
            (
                r#""feeds": { "work": {} }"#,
                "feeds.work must be a single value",
            ),
            (
                r#""part": { "offset": [1, 2] }"#,
                "part.offset must be a list of three numbers",
            ),
            (
                r#""part": { "sizes": { "depth": [] } }"#,
                "part.sizes must be an object of numbers",
            ),
            (
                r#""tool": { "frame": [1] }"#,
                "tool.frame must be a list of steps, each a turn or a mirror",
            ),
        ] {
            assert_eq!(of(broken).as_deref(), Some(why), "{broken}");
        }
        for (broken, why) in [
            ("[]", "The job must be an object"),
            (r#"{ "cycle": 5 }"#, "cycle must be an object"),
            (
                r#"{ "cycle": { "type": "well" } }"#,
                "cycle.type must be a known cycle",
            ),
            (
                r#"{ "cycle": { "type": "hole", "custom": {} } }"#,
                "cycle.custom must be a list of custom codes",
            ),
            (
                r#"{ "cycle": { "type": "hole", "touches": [{ "point": [0, 0, 0] }] } }"#,
                "cycle.touches must be a list of touches, each with a point and a vector of three numbers",
            ),
            (
                r#"{ "cycle": { "type": "hole", "properties": [] } }"#,
                "cycle.properties must be an object",
            ),
        ] {
            assert_eq!(said(broken).as_deref(), Some(why), "{broken}");
        }
        let touch = |point: Value| {
            Value::Map(vec![
                ("point".to_owned(), point.clone()),
                ("vector".to_owned(), point),
            ])
        };
        let cut = || Value::Other("more values than in any job");
        let touches = vec![
            touch(Value::List(vec![cut(), cut(), cut()])),
            touch(cut()),
            cut(),
        ];
        let cycle = [
            ("type".to_owned(), Value::Text("hole".to_owned())),
            ("touches".to_owned(), Value::List(touches)),
        ];
        assert_eq!(
            form_problem(&Value::Map(vec![(
                "cycle".to_owned(),
                Value::Map(cycle.to_vec())
            )])),
            None
        );
    }
}
