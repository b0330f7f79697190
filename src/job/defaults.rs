//! Complete jobs with all values that a job leaves out.

use crate::control::Ask;
use crate::control::shop::place::FRAME;
use crate::cycle::{self, CycleDef, REPEAT};
use crate::form::{Default, Field, SubForm, Value};
use crate::job::cycles::{
    RELATIONS, SET_UP_FORMAT, is_set_up, names, single_cycle_job, with_size_limit,
};
use crate::job::naming::job_name;
use crate::job::sections::{ASK, FORMAT, NORMAL_RUN, SECTIONS, TOLERANCES, USUAL_SIZE, Units};
use crate::job::sized;
use crate::job::units::default_in;
use crate::num::tidy;
use crate::tolerance::plain_of_result;

/// Conversion of defaults, which are in mm, to inch.
#[derive(Clone, Copy, PartialEq)]
enum Inch {
    /// With all digits.
    Exact,
    /// With the decimals of a conversion.
    Converted,
    /// Rounded to usual numbers.
    Typed,
}

/// A complete, valid job of a type, in mm, with its default name; `None` for an unknown type.
pub fn default_job(key: &str) -> Option<Value> {
    default_job_in(key, Units::Mm)
}

/// A new job of a type: in inch with usual numbers instead of converted millimetres.
pub fn new_job(key: &str, units: Units) -> Option<Value> {
    let mut job = complete_job(cycle::find(key)?, units, Inch::Typed);
    job.put("units", Value::Text(units.word().to_owned()));
    Some(named(job))
}

/// The default job with lengths and feeds converted to `units`; the caller sets its `units`.
pub fn default_job_in(key: &str, units: Units) -> Option<Value> {
    Some(named(complete_job(
        cycle::find(key)?,
        units,
        Inch::Converted,
    )))
}

/// Default of a field in a new job in inch, in inch: the field's own, or its default with one digit, two if the first is 1.
pub fn typed_in_inch(field: &Field) -> Default {
    let metric = field.kind.is_metric();
    match (field.default, field.inch) {
        (Default::Number(_), Some(inch)) => Default::Number(inch),
        (Default::Number(x), None) if metric => Default::Number(typed(x)),
        (Default::Point(p), _) if metric => Default::Point(p.map(typed)),
        (default, _) => default,
    }
}

/// Millimetres in inch, with one digit, two if the first is 1.
fn typed(mm: f64) -> f64 {
    let inch = mm / Units::Inch.scale();
    if inch == 0.0 {
        return 0.0;
    }
    let first = inch.abs().log10().floor();
    let digits = if inch.abs() / 10f64.powf(first) < 2.0 {
        1.0
    } else {
        0.0
    };
    // An integer divided by a power of ten is as exact as a double can be.
    let places = digits - first;
    if places >= 0.0 {
        (inch * 10f64.powf(places)).round() / 10f64.powf(places)
    } else {
        (inch / 10f64.powf(-places)).round() * 10f64.powf(-places)
    }
}

/// Whether a field has the value that applies if a job leaves it out, in any units.
pub fn is_default(field: &Field, value: &Value) -> bool {
    let units = [
        (Units::Mm, Inch::Exact),
        (Units::Inch, Inch::Exact),
        (Units::Inch, Inch::Converted),
        (Units::Inch, Inch::Typed),
    ];
    let same = |(units, inch)| {
        default_values(std::slice::from_ref(field), units, inch)
            .iter()
            .all(|(_, known)| known == value)
    };
    units.into_iter().any(same)
}

/// A job with its default name.
fn named(mut job: Value) -> Value {
    let name = Value::Text(job_name(&job));
    job.put("name", name);
    job
}

/// Defaults of the fields of an inner form, in `units`.
pub fn section_defaults_in(fields: &[Field], units: Units) -> Value {
    Value::Map(default_values(fields, units, Inch::Converted))
}

fn complete_job(def: &CycleDef, units: Units, inch: Inch) -> Value {
    let default_values = |fields: &[Field]| default_values(fields, units, inch);
    let mut job = vec![("format".to_owned(), Value::Number(FORMAT))];
    for SubForm {
        key: path, fields, ..
    } in SECTIONS.iter().filter(|form| !form.optional)
    {
        if path.is_empty() {
            job.extend(default_values(fields));
        } else {
            let mut entries = default_values(fields);
            // A form starts with the cycle's default control; a job that leaves it out gets the reader's default.
            if *path == "control" && inch != Inch::Exact {
                for (key, value) in [
                    ("post", def.default_control.0),
                    ("form", def.default_control.1),
                ] {
                    entries.retain(|(k, _)| k != key);
                    entries.push((key.to_owned(), Value::Text(value.to_owned())));
                }
            }
            if *path == "tool" {
                entries.push(("frame".to_owned(), Value::List(Vec::new())));
            }
            if *path == "part" {
                entries.push(("sizes".to_owned(), Value::Map(Vec::new())));
            }
            job.push(((*path).to_owned(), Value::Map(entries)));
        }
    }
    let mut entries = vec![("type".to_owned(), Value::Text(def.key.to_owned()))];
    entries.extend(default_values(def.fields));
    // A cycle without repetitions omits the key, so that its program equals one from before repetitions existed.
    for section in def
        .sections
        .iter()
        .filter(|section| section.key != REPEAT.key)
    {
        let value = if section.optional {
            Value::Null
        } else {
            Value::Map(default_values(section.fields))
        };
        entries.push((section.key.to_owned(), value));
    }
    job.push(("cycle".to_owned(), Value::Map(entries)));
    Value::Map(job)
}

/// A job with all values: missing ones have their defaults. `None` without a known cycle.
pub fn resolved(job: &Value) -> Option<Value> {
    if is_set_up(job) {
        let limited = with_size_limit(job);
        return resolved_set_up(limited.as_ref().unwrap_or(job));
    }
    let Some(Value::Text(key)) = job.get("cycle").and_then(|c| c.get("type")) else {
        return None;
    };
    let units = Units::of(job);
    let def = cycle::find(key)?;
    let mut whole = complete_job(def, units, Inch::Exact);
    // A given optional form has all its fields.
    let given = |place: Option<&Value>, form: &SubForm| {
        matches!(place?.get(form.key), Some(Value::Map(_))).then(|| {
            let values = default_values(form.fields, units, Inch::Exact);
            Value::Map(vec![(form.key.to_owned(), Value::Map(values))])
        })
    };
    for form in def.sections {
        if let Some(values) = given(job.get("cycle"), form) {
            overlay(&mut whole, &Value::Map(vec![("cycle".to_owned(), values)]));
        }
    }
    for form in SECTIONS.iter().filter(|form| form.optional) {
        if let Some(values) = given(Some(job), form) {
            overlay(&mut whole, &values);
        }
    }
    overlay(&mut whole, job);
    put_sized(&mut whole, job, def, units);
    if let Value::Map(entries) = &mut whole {
        let left_out = |key: &str, value: &Value| {
            let optional = |form: &SubForm| form.optional && form.key == key;
            *value == Value::Null && SECTIONS.iter().any(optional)
        };
        entries.retain(|(key, value)| key != TOLERANCES && !left_out(key, value));
        entries.extend(plain_tolerances(job));
        entries
            .iter_mut()
            .filter(|(key, _)| key == "control")
            .for_each(|(_, control)| leave_usual(control));
        entries
            .iter_mut()
            .filter(|(key, _)| key == "machine")
            .for_each(|(_, machine)| leave_no_lines(machine));
    }
    Some(whole)
}

/// Writes sizes with a tolerance in characters that every control accepts in a comment, and adds the resulting size limit.
fn put_sized(whole: &mut Value, job: &Value, def: &CycleDef, units: Units) {
    let Some(cycle) = whole.get_mut("cycle") else {
        return;
    };
    let sized = sized::of(def, cycle, units.scale());
    for one in &sized {
        cycle.put(one.field.key, Value::Text(plain_of_result(&one.text)));
    }
    let given = job.get("limits").and_then(|limits| limits.get("size"));
    if let (None, Some(limit), Some(limits)) = (
        given,
        sized::size_limit(&sized, USUAL_SIZE),
        whole.get_mut("limits"),
    ) {
        limits.put("size", Value::Number(tidy(limit / units.scale())));
    }
}

/// Omits a normal run and the first probe input, so that programs stay the same as before there was a choice.
fn leave_usual(control: &mut Value) {
    let Value::Map(entries) = control else { return };
    let never = Value::Text(Ask::Never.word().to_owned());
    entries.retain(|(key, value)| {
        !(key == "probeInput" && *value == Value::Number(1.0) || key == ASK && *value == never)
    });
    if entries
        .iter()
        .any(|(key, value)| key == "run" && *value == Value::Text(NORMAL_RUN.to_owned()))
    {
        entries.retain(|(key, value)| {
            key != "run" && !(key == "lift" && *value == Value::Number(0.0))
        });
    }
}

/// Removes the shop's lines if there are none.
fn leave_no_lines(machine: &mut Value) {
    if let Value::Map(entries) = machine {
        let none = |value: &Value| match value {
            Value::Map(places) => places.is_empty(),
            value => *value == Value::Null,
        };
        entries.retain(|(key, value)| key != FRAME || !none(value));
    }
}

/// The tolerances of a job in characters that a comment of any control accepts. `None` for a job without tolerances.
fn plain_tolerances(job: &Value) -> Option<(String, Value)> {
    let Some(Value::Map(entries)) = job
        .get(TOLERANCES)
        .filter(|given| !matches!(given, Value::Map(none) if none.is_empty()))
    else {
        return None;
    };
    let plain = |(key, given): &(String, Value)| {
        let mut given = given.clone();
        if let Value::Map(entries) = &mut given {
            entries.retain(|(key, value)| key != "wear" || !matches!(value, Value::Null));
        }
        if let Value::Map(entries) = &mut given
            && let Some((_, Value::Text(text))) =
                entries.iter_mut().find(|(key, _)| key == "tolerance")
        {
            *text = plain_of_result(text);
        }
        (key.clone(), given)
    };
    Some((
        TOLERANCES.to_owned(),
        Value::Map(entries.iter().map(plain).collect()),
    ))
}

/// A job with several cycles, each with its name and all values.
fn resolved_set_up(job: &Value) -> Option<Value> {
    let Some(Value::List(cycles)) = job.get("cycles") else {
        return None;
    };
    let mut whole = None;
    let mut all = Vec::with_capacity(cycles.len());
    for (index, name) in names(cycles).into_iter().enumerate() {
        let Value::Map(single) = resolved(&single_cycle_job(job, index)?)? else {
            return None;
        };
        let Some((_, Value::Map(mut cycle))) =
            single.iter().find(|(key, _)| key == "cycle").cloned()
        else {
            return None;
        };
        cycle.insert(0, ("name".to_owned(), Value::Text(name)));
        all.push(Value::Map(cycle));
        whole.get_or_insert(single);
    }
    let mut entries = whole?;
    for (key, value) in &mut entries {
        match key.as_str() {
            "format" => *value = Value::Number(SET_UP_FORMAT),
            "part" => value.clone_from(job.get("part").unwrap_or(&Value::Null)),
            _ => {}
        }
    }
    entries.retain(|(key, _)| key != "cycle");
    entries.push((
        "clear".to_owned(),
        job.get("clear").cloned().unwrap_or(Value::Null),
    ));
    // A Fanuc may have no braces for an empty one.
    let datum = job
        .get("datum")
        .filter(|datum| !matches!(datum, Value::Map(none) if none.is_empty()));
    entries.extend(datum.map(|datum| ("datum".to_owned(), datum.clone())));
    entries.push(("cycles".to_owned(), Value::List(all)));
    let relations = job
        .get(RELATIONS)
        .filter(|given| matches!(given, Value::List(list) if !list.is_empty()));
    entries.extend(relations.map(|relations| (RELATIONS.to_owned(), relations.clone())));
    entries.extend(plain_tolerances(job));
    Some(Value::Map(entries))
}

/// Overlays a value with another one; lists are replaced as a whole.
pub(super) fn overlay(under: &mut Value, over: &Value) {
    let (Value::Map(entries), Value::Map(given)) = (&mut *under, over) else {
        *under = over.clone();
        return;
    };
    for (key, value) in given {
        match entries.iter_mut().find(|(k, _)| k == key) {
            Some((_, place)) => overlay(place, value),
            None => entries.push((key.clone(), value.clone())),
        }
    }
}

/// Default values in `units`.
fn default_values(fields: &[Field], units: Units, inch: Inch) -> Vec<(String, Value)> {
    let value = |field: &Field| match default_of(field, units, inch) {
        Default::Number(x) => Value::Number(x),
        Default::Flag(b) => Value::Flag(b),
        Default::Text(text) => Value::Text(text.to_owned()),
        Default::Point(p) => Value::List(p.map(Value::Number).to_vec()),
        Default::Null => Value::Null,
    };
    fields
        .iter()
        .map(|field| (field.key.to_owned(), value(field)))
        .collect()
}

/// Default of a field in `units`.
fn default_of(field: &Field, units: Units, inch: Inch) -> Default {
    let converted = |x: f64| {
        if inch == Inch::Exact {
            x / units.scale()
        } else {
            default_in(x, units)
        }
    };
    match field.default {
        _ if inch == Inch::Typed && units == Units::Inch => typed_in_inch(field),
        Default::Number(x) if field.kind.is_metric() => Default::Number(converted(x)),
        Default::Point(p) if field.kind.is_metric() => Default::Point(p.map(converted)),
        default => default,
    }
}
