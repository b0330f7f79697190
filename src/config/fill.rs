//! A job with the config's values where it says nothing.

use crate::config::{Allow, Config, field_at};
use crate::control::{self, Form, POSTS};
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
        // A form inside the form that is not used stays so.
        let unused = |key: &str| {
            let optional = def.sections.iter().any(|form| form.key == key && form.optional);
            optional && !matches!(cycle.get(key), Some(Value::Map(_)))
        };
        let own: Vec<_> = own.iter().filter(|(key, _)| key != "type" && !unused(key)).cloned().collect();
        own.iter().for_each(|(key, value)| complete(cycle, key, value));
    }
}

/// The first of what is allowed, where the default is not.
fn first(allowed: Option<&[String]>, default: &str) -> Option<String> {
    let allowed = allowed?;
    if allowed.iter().any(|word| word == default) { None } else { allowed.first().cloned() }
}

/// The control of a job that names none: the default or the first that is allowed, if it takes the cycle in a form that is allowed. Of a job whose control
/// takes its cycle in other forms than moves, the first of these.
fn choose_control(config: &Config, job: &mut Value, def: Option<&'static CycleDef>) {
    let mut chosen = match job.get("control") {
        None => Vec::new(),
        Some(Value::Map(entries)) => entries.clone(),
        Some(_) => return,
    };
    let said =
        |chosen: &[(String, Value)], key: &str| chosen.iter().find(|(known, _)| known == key).map(|(_, value)| value.clone());
    let text = |word: &str| Value::Text(word.to_owned());
    let Allow { controls, forms, work_offsets, .. } = &config.allow;
    let allowed = |form: Form| forms.as_ref().is_none_or(|words| words.iter().any(|word| word == form.word()));
    let serves = |key: &str, form: Form| {
        let post = control::find(key).zip(def);
        allowed(form) && post.is_some_and(|(post, def)| (post.serves)(def.probes, form).is_ok())
    };
    let form = said(&chosen, "form");
    let fits = |key: &str| {
        let named = |word: Form| form.as_ref().is_none_or(|form| *form == text(word.word()));
        Form::ALL.into_iter().any(|word| named(word) && serves(key, word))
    };
    if said(&chosen, "post").is_none() && (controls.is_some() || forms.is_some()) {
        let known = || POSTS.iter().map(|post| post.key);
        let may = |key: &&str| controls.as_ref().is_none_or(|keys| keys.iter().any(|known| known == key));
        let all: Vec<&str> = match controls {
            // The default goes before what is allowed beside it.
            Some(keys) => known().take(1).filter(may).chain(keys.iter().map(String::as_str)).collect(),
            None => known().collect(),
        };
        if let Some(key) = all.iter().find(|key| fits(key)).or(all.first()) {
            chosen.push(("post".to_owned(), text(key)));
        }
    }
    if let (None, Some(Value::Text(post))) = (&form, said(&chosen, "post"))
        && let Some(form) = Form::ALL.into_iter().find(|form| serves(&post, *form)).filter(|form| *form != Form::Moves)
    {
        chosen.push(("form".to_owned(), text(form.word())));
    }
    let whole = Value::Map(chosen.clone());
    if said(&chosen, "workOffset").is_none()
        && let Some(allowed) = work_offsets
        && !allowed.contains(&None)
        && let Some(Some(number)) = allowed.first()
        && !def.is_some_and(|def| itself(&whole, def))
    {
        chosen.push(("workOffset".to_owned(), Value::Number(*number)));
    }
    if !chosen.is_empty() {
        put(job, "control", Value::Map(chosen));
    }
}

/// Whether the control of a job writes its active preset by itself in its own cycle, so that no work offset is named.
pub fn writes_itself(job: &Value) -> bool {
    let def = job.get("cycle").and_then(type_of);
    job.get("control").zip(def).is_some_and(|(control, def)| itself(control, def))
}

fn itself(control: &Value, def: &CycleDef) -> bool {
    let Some(Value::Text(key)) = control.get("post") else { return false };
    let own = matches!(control.get("form"), Some(Value::Text(form)) if form == Form::Cycle.word());
    own && control::find(key).is_some_and(|post| (post.own_preset)(def.probes))
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
