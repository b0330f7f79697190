//! Fills in the values that a job leaves out.

use crate::config::allow::Allow;
use crate::config::{Config, field_at};
use crate::control::{self, POSTS, ProgramForm};
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
        job.put("units", Value::Text(units));
    }
    let units = Units::of(&job);
    let first = match job.get("cycles") {
        Some(Value::List(cycles)) => cycles.first(),
        _ => job.get("cycle"),
    };
    let def = first.and_then(type_of);
    // The sections around the cycle are filled in for every cycle.
    let Value::Map(values) = values(config, def.unwrap_or(cycle::CYCLES[0]), units) else {
        return job;
    };
    for (key, value) in &values {
        if key != "cycle" {
            complete(&mut job, key, value);
        }
    }
    if let Value::Map(entries) = &mut job {
        for (key, cycle) in entries {
            match (key.as_str(), cycle) {
                ("cycle", cycle) => fill_cycle(config, cycle, units),
                ("cycles", Value::List(cycles)) => cycles
                    .iter_mut()
                    .for_each(|cycle| fill_cycle(config, cycle, units)),
                _ => {}
            }
        }
    }
    choose_control(config, &mut job, def);
    job
}

fn fill_cycle(config: &Config, cycle: &mut Value, units: Units) {
    let Some(def) = type_of(cycle) else { return };
    if let Some(Value::Map(own)) = values(config, def, units).get("cycle") {
        // An optional form that is not used stays unused.
        let unused = |key: &str| {
            let optional = def
                .sections
                .iter()
                .any(|form| form.key == key && form.optional);
            optional && !matches!(cycle.get(key), Some(Value::Map(_)))
        };
        let own: Vec<_> = own
            .iter()
            .filter(|(key, _)| key != "type" && !unused(key))
            .cloned()
            .collect();
        own.iter()
            .for_each(|(key, value)| complete(cycle, key, value));
    }
}

/// The first allowed value, if the default is not allowed.
fn first(allowed: Option<&[String]>, default: &str) -> Option<String> {
    let allowed = allowed?;
    if allowed.iter().any(|word| word == default) {
        None
    } else {
        allowed.first().cloned()
    }
}

/// Chooses the control settings that a job leaves out, if the defaults are not allowed.
fn choose_control(config: &Config, job: &mut Value, def: Option<&'static CycleDef>) {
    let mut control = job
        .get("control")
        .cloned()
        .unwrap_or_else(|| Value::Map(Vec::new()));
    if control.get("post").is_none()
        && let Some(post) = post_for(config, def, control.get("form"))
    {
        control.put("post", text(post));
    }
    if let (None, Some(Value::Text(post))) = (control.get("form"), control.get("post")) {
        // Moves are the default.
        let form = forms(config, def, post)
            .next()
            .filter(|form| *form != ProgramForm::Moves);
        form.into_iter()
            .for_each(|form| control.put("form", text(form.word())));
    }
    if control.get("workOffset").is_none()
        && let Some(allowed) = config
            .allow
            .work_offsets
            .as_ref()
            .filter(|allowed| !allowed.contains(&None))
        && let Some(Some(number)) = allowed.first()
        && !def.is_some_and(|def| sets_preset(&control, def))
    {
        control.put("workOffset", Value::Number(*number));
    }
    if control != Value::Map(Vec::new()) {
        job.put("control", control);
    }
}

/// Allowed program forms of a control for a cycle.
fn forms(
    config: &Config,
    def: Option<&'static CycleDef>,
    post: &str,
) -> impl Iterator<Item = ProgramForm> {
    let allowed = |form: &ProgramForm| config.allow.takes("form", &text(form.word()));
    let served = control::find(post).zip(def);
    let serves = move |form: &ProgramForm| {
        served.is_some_and(|(post, def)| (post.supports)(def.probes, *form).is_ok())
    };
    ProgramForm::ALL.into_iter().filter(allowed).filter(serves)
}

/// Control of a job that names no control: the default, or else the first allowed control that supports the cycle in this form, or in any allowed form. `None` if the
/// default applies.
fn post_for<'a>(
    config: &'a Config,
    def: Option<&'static CycleDef>,
    form: Option<&Value>,
) -> Option<&'a str> {
    let Allow {
        controls,
        forms: limited,
        ..
    } = &config.allow;
    if controls.is_none() && limited.is_none() {
        return None;
    }
    let default = POSTS[0].key;
    let all: Vec<&str> = match controls {
        Some(keys) => {
            let first = keys.iter().filter(|key| *key == default);
            first.chain(keys).map(String::as_str).collect()
        }
        None => POSTS.iter().map(|post| post.key).collect(),
    };
    let fits = |key: &&&str| {
        forms(config, def, key).any(|word| form.is_none_or(|form| *form == text(word.word())))
    };
    all.iter().find(fits).or(all.first()).copied()
}

/// Whether the native cycle of a job sets the active preset, so that the job names no work offset.
pub fn writes_itself(job: &Value) -> bool {
    let def = job.get("cycle").and_then(type_of);
    job.get("control")
        .zip(def)
        .is_some_and(|(control, def)| sets_preset(control, def))
}

fn sets_preset(control: &Value, def: &CycleDef) -> bool {
    let Some(Value::Text(key)) = control.get("post") else {
        return false;
    };
    let own = control.get("form") == Some(&text(ProgramForm::Cycle.word()));
    own && control::find(key).is_some_and(|post| (post.cycle_sets_preset)(def.probes))
}

fn text(word: &str) -> Value {
    Value::Text(word.to_owned())
}

/// Values that the config fills in for a job with a cycle of this type, as such a job in `units`.
pub fn values(config: &Config, def: &'static CycleDef, units: Units) -> Value {
    let cycle = Value::Map(vec![("type".to_owned(), text(def.key))]);
    let mut job = Value::Map(vec![
        ("units".to_owned(), text(config.units.word())),
        ("cycle".to_owned(), cycle),
    ]);
    for rule in &config.rules {
        if let Some(value) = rule
            .value
            .as_ref()
            .filter(|_| field_at(&rule.path, def).is_some())
        {
            put_at(&mut job, &rule.path, value);
        }
    }
    let mut job = convert_units(&job, units.word()).unwrap_or(job);
    if let Value::Map(entries) = &mut job {
        entries.retain(|(key, _)| key != "units");
    }
    job
}

/// Definition of a cycle, if its type is known.
pub fn type_of(cycle: &Value) -> Option<&'static CycleDef> {
    match cycle.get("type") {
        Some(Value::Text(key)) => cycle::find(key),
        _ => None,
    }
}

/// Adds a value under a missing key. If both values are objects, only missing keys are added.
fn complete(place: &mut Value, key: &str, value: &Value) {
    match (place.get_mut(key), value) {
        (None, _) => place.put(key, value.clone()),
        (Some(there), Value::Map(inner)) => inner
            .iter()
            .for_each(|(key, value)| complete(there, key, value)),
        (Some(_), _) => {}
    }
}

/// Puts a value at a path, and creates the objects on the way.
fn put_at(place: &mut Value, path: &str, value: &Value) {
    let Some((key, rest)) = path.split_once('.') else {
        return place.put(path, value.clone());
    };
    if place.get(key).is_none() {
        place.put(key, Value::Map(Vec::new()));
    }
    if let Some(inner) = place.get_mut(key) {
        put_at(inner, rest, value);
    }
}
