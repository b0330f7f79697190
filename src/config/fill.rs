//! A job with the config's values where it says nothing.

use crate::config::{Config, field_at};
use crate::control::{self, Form};
use crate::cycle::{self, CycleDef};
use crate::form::Value;
use crate::job::{Units, convert_units};

/// See [`Config::fill`].
pub fn fill(config: &Config, job: &Value) -> Value {
    let mut job = job.clone();
    let Value::Map(_) = job else { return job };
    if job.get("units").is_none()
        && let Some(units) = first(config.allow.units.as_deref(), Units::Mm.word())
    {
        put(&mut job, "units", Value::Text(units));
    }
    let units = Units::of(&job);
    let several = matches!(job.get("cycles"), Some(Value::List(_)));
    let kind = match if several { first_cycle(&job) } else { job.get("cycle") } {
        Some(cycle) => type_of(cycle),
        None => None,
    };
    // Without a cycle that is known, only what is around it is filled in.
    let def = kind.unwrap_or(cycle::CYCLES[0]);
    let Value::Map(values) = values(config, def, units) else { return job };
    for (key, value) in &values {
        if key != "cycle" {
            complete(&mut job, key, value);
        }
    }
    if let Value::Map(entries) = &mut job {
        for (key, cycle) in entries {
            match (key.as_str(), cycle) {
                ("cycle", cycle) => fill_cycle(config, cycle, units),
                ("cycles", Value::List(cycles)) => cycles.iter_mut().for_each(|cycle| fill_cycle(config, cycle, units)),
                _ => {}
            }
        }
    }
    choose_control(config, &mut job, kind);
    job
}

fn fill_cycle(config: &Config, cycle: &mut Value, units: Units) {
    let Some(def) = type_of(cycle) else { return };
    if let Some(Value::Map(own)) = values(config, def, units).get("cycle") {
        own.iter().filter(|(key, _)| key != "type").for_each(|(key, value)| complete(cycle, key, value));
    }
}

/// The first of what is allowed, where the default is not.
fn first(allowed: Option<&[String]>, default: &str) -> Option<String> {
    let allowed = allowed?;
    if allowed.iter().any(|word| word == default) { None } else { allowed.first().cloned() }
}

/// The control of a job that names none: the first that is allowed and takes the cycle. A job whose control takes its cycle in one form only has that form.
fn choose_control(config: &Config, job: &mut Value, def: Option<&'static CycleDef>) {
    let mut chosen = match job.get("control") {
        None => Vec::new(),
        Some(Value::Map(entries)) => entries.clone(),
        Some(_) => return,
    };
    let named = |chosen: &[(String, Value)], key: &str| chosen.iter().any(|(known, _)| known == key);
    let serves = |key: &str, form: Form| {
        let (Some(post), Some(def)) = (control::find(key), def) else { return false };
        (post.serves)(def.probes, form).is_ok()
    };
    let any = |key: &&String| Form::ALL.iter().any(|form| serves(key, *form));
    if !named(&chosen, "post")
        && let Some(allowed) = &config.allow.controls
        && !allowed.iter().any(|key| key == control::POSTS[0].key)
        && let Some(post) = allowed.iter().find(any).or(allowed.first())
    {
        chosen.push(("post".to_owned(), Value::Text(post.clone())));
    }
    let post = chosen.iter().find(|(key, _)| key == "post").map(|(_, post)| post.clone());
    if !named(&chosen, "form")
        && let Some(Value::Text(post)) = post
    {
        let forms = [Form::Moves, Form::Cycle];
        let fits = |form: &&Form| {
            serves(&post, **form) && config.allow.forms.as_ref().is_none_or(|all| all.iter().any(|word| word == form.word()))
        };
        if let Some(form) = forms.iter().find(fits).filter(|form| **form != Form::Moves) {
            chosen.push(("form".to_owned(), Value::Text(form.word().to_owned())));
        }
    }
    if !named(&chosen, "workOffset")
        && let Some(allowed) = &config.allow.work_offsets
        && !allowed.contains(&None)
        && let Some(Some(number)) = allowed.first()
    {
        chosen.push(("workOffset".to_owned(), Value::Number(*number)));
    }
    if !chosen.is_empty() {
        put(job, "control", Value::Map(chosen));
    }
}

/// What the config fills in of a job with a cycle of this type, as such a job in `units`.
pub fn values(config: &Config, def: &'static CycleDef, units: Units) -> Value {
    let text = |word: &str| Value::Text(word.to_owned());
    let cycle = Value::Map(vec![("type".to_owned(), text(def.key))]);
    let mut job = Value::Map(vec![("units".to_owned(), text(config.units.word())), ("cycle".to_owned(), cycle)]);
    for rule in &config.rules {
        if let Some(value) = rule.value.as_ref().filter(|_| field_at(&rule.path, def).is_some()) {
            put_at(&mut job, &rule.path, value);
        }
    }
    let mut job = convert_units(&job, units.word()).unwrap_or(job);
    if let Value::Map(entries) = &mut job {
        entries.retain(|(key, _)| key != "units");
    }
    job
}

/// The type of a cycle, where it is known.
pub fn type_of(cycle: &Value) -> Option<&'static CycleDef> {
    match cycle.get("type") {
        Some(Value::Text(key)) => cycle::find(key),
        _ => None,
    }
}

fn first_cycle(job: &Value) -> Option<&Value> {
    match job.get("cycles") {
        Some(Value::List(cycles)) => cycles.first(),
        _ => None,
    }
}

/// Puts a value under a key where there is none; of objects, what is missing in them.
fn complete(place: &mut Value, key: &str, value: &Value) {
    let Value::Map(entries) = place else { return };
    match entries.iter_mut().rev().find(|(known, _)| known == key) {
        None => entries.push((key.to_owned(), value.clone())),
        Some((_, there @ Value::Map(_))) => {
            if let Value::Map(inner) = value {
                inner.iter().for_each(|(key, value)| complete(there, key, value));
            }
        }
        Some(_) => {}
    }
}

fn put(place: &mut Value, key: &str, value: Value) {
    let Value::Map(entries) = place else { return };
    entries.retain(|(known, _)| known != key);
    entries.push((key.to_owned(), value));
}

fn put_at(place: &mut Value, path: &str, value: &Value) {
    let Some((key, rest)) = path.split_once('.') else { return put(place, path, value.clone()) };
    let Value::Map(entries) = place else { return };
    if !entries.iter().any(|(known, _)| known == key) {
        entries.push((key.to_owned(), Value::Map(Vec::new())));
    }
    if let Some((_, inner)) = entries.iter_mut().find(|(known, _)| known == key) {
        put_at(inner, rest, value);
    }
}
