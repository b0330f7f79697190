//! Complete jobs: every value that a job leaves out.

use crate::cycle::{self, CycleDef};
use crate::form::{Default, Field, Kind, Value};
use crate::job::naming::job_name;
use crate::job::sections::{FORMAT, SECTIONS, Units};
use crate::job::units::default_in;

/// A complete, valid job of a type, in mm, named by what it measures; none for an unknown type.
pub fn default_job(key: &str) -> Option<Value> {
    default_job_in(key, Units::Mm)
}

/// The same with lengths and feeds in `units`; the job's own units stay to be set.
pub fn default_job_in(key: &str, units: Units) -> Option<Value> {
    let mut job = cycle::find(key).map(|def| complete_job(def, units, true))?;
    let name = Value::Text(job_name(&job));
    if let Value::Map(entries) = &mut job
        && let Some((_, place)) = entries.iter_mut().find(|(key, _)| key == "name")
    {
        *place = name;
    }
    Some(job)
}

/// The defaults of the fields of a form inside a cycle's form, likewise.
pub fn section_defaults_in(fields: &[Field], units: Units) -> Value {
    Value::Map(default_values(fields, units, true))
}

fn complete_job(def: &CycleDef, units: Units, short: bool) -> Value {
    let default_values = |fields: &[Field]| default_values(fields, units, short);
    let mut job = vec![("format".to_owned(), Value::Number(FORMAT))];
    for (path, fields) in SECTIONS {
        if path.is_empty() {
            job.extend(default_values(fields));
        } else {
            let mut entries = default_values(fields);
            // A form begins with the cycle's own control; what a job leaves out is the reader's default.
            if *path == "control" && short {
                for (key, value) in [("post", def.home.0), ("form", def.home.1)] {
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
    for section in def.sections {
        let value = if section.optional { Value::Null } else { Value::Map(default_values(section.fields)) };
        entries.push((section.key.to_owned(), value));
    }
    job.push(("cycle".to_owned(), Value::Map(entries)));
    Value::Map(job)
}

/// A job with every value: what it does not say has the value that stands in. None where it has no known cycle.
pub fn resolved(job: &Value) -> Option<Value> {
    let Some(Value::Text(key)) = job.get("cycle").and_then(|c| c.get("type")) else { return None };
    let units = Units::of(job);
    let def = cycle::find(key)?;
    let mut whole = complete_job(def, units, false);
    for section in def.sections {
        // A form inside the form that is there has all its fields.
        if matches!(job.get("cycle").and_then(|c| c.get(section.key)), Some(Value::Map(_))) {
            let values = Value::Map(default_values(section.fields, units, false));
            overlay(&mut whole, &Value::Map(vec![("cycle".to_owned(), Value::Map(vec![(section.key.to_owned(), values)]))]));
        }
    }
    overlay(&mut whole, job);
    Some(whole)
}

/// Puts what `over` says over what is there; lists are taken whole.
fn overlay(under: &mut Value, over: &Value) {
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

/// Default values in `units`: as people write them, or in full.
fn default_values(fields: &[Field], units: Units, short: bool) -> Vec<(String, Value)> {
    let rounded = |x: f64| if short { default_in(x, units) } else { x / units.scale() };
    let value = |field: &Field| match field.default {
        Default::Number(x) => match field.kind {
            Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Nominal => Value::Number(rounded(x)),
            Kind::Time | Kind::Angle | Kind::Count | Kind::Code(_) | Kind::Flag | Kind::Choice(_) | Kind::Text(_) => {
                Value::Number(x)
            }
            Kind::Point | Kind::NominalPoint => Value::Number(x),
        },
        Default::Flag(b) => Value::Flag(b),
        Default::Text(text) => Value::Text(text.to_owned()),
        Default::Point(p) => Value::List(p.map(|x| Value::Number(rounded(x))).to_vec()),
        Default::Null => Value::Null,
    };
    fields.iter().map(|field| (field.key.to_owned(), value(field))).collect()
}
