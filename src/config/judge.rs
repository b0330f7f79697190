//! Refusals of a job by a config.

use crate::config::space::{ProbePart, Space, beyond, enters, pieces};
use crate::config::{Config, Rule, at, field_at, fill};
use crate::control;
use crate::cycle;
use crate::form::{Checker, Field, Finding, Kind, Value, printable};
use crate::geom::AXIS_NAMES;
use crate::job::{PlannedJob, Units, is_set_up, resolved, single_cycle_job, writes_any};
use crate::num::decimal;
use crate::text::{Part, Text, text};
use crate::tolerance;

/// Largest difference of converted values that counts as equal, mm or degrees.
const NEAR: f64 = 2e-5;

/// The same for feeds, mm/min: 3.937 inch/min are 100 mm/min.
const NEAR_FEED: f64 = 1e-3;

/// Largest difference between values of a field that counts as equal, in the unit of the job.
fn near(field: &Field, scale: f64) -> f64 {
    match field.kind {
        Kind::Feed | Kind::Acceleration => NEAR_FEED / scale,
        kind if kind.is_metric() => NEAR / scale,
        _ => NEAR,
    }
}

/// See [`Config::judge`].
pub fn judge(config: &Config, job: &Value, planned: Option<&PlannedJob>) -> Vec<Finding> {
    let units = Units::of(job);
    let mut checker = Checker::in_units(units.scale(), units.word());
    if is_set_up(job) {
        if !config.allow.set_ups {
            checker.error(
                "not-allowed",
                "cycles",
                text!("{portal} allows jobs of one cycle only", config.who()),
            );
        }
        let count = if let Some(Value::List(cycles)) = job.get("cycles") {
            cycles.len()
        } else {
            0
        };
        for index in 0..count {
            let Some(single) = single_cycle_job(job, index) else {
                continue;
            };
            judge_single(
                config,
                &single,
                &format!("cycles[{index}]"),
                index == 0,
                planned,
                &mut checker,
            );
        }
    } else {
        judge_single(config, job, "cycle", true, planned, &mut checker);
    }
    if let Some(planned) = planned {
        judge_space(config, planned, &mut checker);
    }
    config
        .own
        .iter()
        .for_each(|finding| checker.adopt(finding.clone()));
    checker.findings()
}

/// Judges a job with one cycle. `place` is the path of its cycle; `around`: whether the sections around the cycle are judged, too.
fn judge_single(
    config: &Config,
    job: &Value,
    place: &str,
    around: bool,
    planned: Option<&PlannedJob>,
    checker: &mut Checker,
) {
    let whole = resolved(job);
    let whole = whole.as_ref().unwrap_or(job);
    let in_place = |path: &str| match path.strip_prefix("cycle") {
        Some(rest) => format!("{place}{rest}"),
        None => path.to_owned(),
    };
    let allow = &config.allow;
    let of_cycle = |key: &str| cycle::find(key).map(|def| def.title);
    let of_control = |key: &str| control::find(key).map(|post| post.title);
    let itself = |_: &str| None;
    judge_word(
        config,
        whole,
        "cycle.type",
        allow.cycles.as_deref(),
        of_cycle,
        &in_place,
        checker,
    );
    if around {
        judge_word(
            config,
            whole,
            "control.post",
            allow.controls.as_deref(),
            of_control,
            &in_place,
            checker,
        );
        judge_word(
            config,
            whole,
            "control.form",
            allow.forms.as_deref(),
            itself,
            &in_place,
            checker,
        );
        judge_word(
            config,
            whole,
            "units",
            allow.units.as_deref(),
            itself,
            &in_place,
            checker,
        );
        judge_offset(config, whole, planned, checker);
    }
    let Some(def) = whole.get("cycle").and_then(fill::type_of) else {
        return;
    };
    let values = fill::values(config, def, Units::of(job));
    for rule in config
        .rules
        .iter()
        .filter(|rule| around || rule.path.starts_with("cycle."))
    {
        let Some(field) = field_at(&rule.path, def) else {
            continue;
        };
        let value = at(whole, &rule.path);
        if let Some(message) = refusal(config, rule, field, value, at(&values, &rule.path), checker)
        {
            let code = if rule.locked && rule.value.is_some() {
                "locked"
            } else {
                "not-allowed"
            };
            checker.error(code, in_place(&rule.path), message);
        }
    }
}

/// Reports a word that is not among the allowed ones.
fn judge_word(
    config: &Config,
    job: &Value,
    path: &str,
    allowed: Option<&[String]>,
    title: fn(&str) -> Option<&'static str>,
    in_place: &dyn Fn(&str) -> String,
    checker: &mut Checker,
) {
    let (Some(allowed), Some(Value::Text(word))) = (allowed, at(job, path)) else {
        return;
    };
    if allowed.contains(word) {
        return;
    }
    let shown = |word: &String| title(word).map_or_else(|| printable(word), str::to_owned);
    let list = allowed.iter().map(shown).collect::<Vec<_>>().join(", ");
    let message = text!(
        "{portal} does not allow {given}: it allows {list}",
        config.who(),
        shown(word),
        list
    );
    checker.error("not-allowed", in_place(path), message);
}

/// Judges the written offset. A native cycle that sets the active preset names no work offset: it is allowed if any work offset is.
fn judge_offset(config: &Config, job: &Value, planned: Option<&PlannedJob>, checker: &mut Checker) {
    let Some(allowed) = &config.allow.work_offsets else {
        return;
    };
    let post = match at(job, "control.post") {
        Some(Value::Text(key)) => control::find(key),
        _ => None,
    };
    let shown = |number: Option<f64>| -> Part {
        let Some(number) = number else {
            return text!("measuring only").into();
        };
        let word = post.filter(|post| number >= 1.0 && number <= f64::from(post.work_offsets));
        word.map_or_else(
            || decimal(number, 0),
            |post| (post.work_offset_word)(number as i32),
        )
        .into()
    };
    let given = match at(job, "control.workOffset") {
        Some(Value::Number(number)) => Some(*number),
        Some(Value::Null) | None => None,
        Some(_) => return,
    };
    let own = given.is_none() && fill::writes_itself(job);
    let writes = given.is_some() || planned.is_some_and(writes_any);
    if own && (!writes || allowed.iter().any(Option::is_some)) || !own && allowed.contains(&given) {
        return;
    }
    let word = |number: &Option<f64>| match shown(*number) {
        Part::Verbatim(word) => word,
        Part::Text(words) => words.english(),
    };
    let list = allowed.iter().map(word).collect::<Vec<_>>().join(", ");
    let given = if own {
        text!("writing a preset").into()
    } else {
        shown(given)
    };
    let message = text!(
        "{portal} does not allow {given}: it allows {list}",
        config.who(),
        given,
        list
    );
    checker.error("not-allowed", "control.workOffset", message);
}

/// Reason why a value is refused; `None` if it is allowed. `wanted` is the config's value in the job's units.
fn refusal(
    config: &Config,
    rule: &Rule,
    field: &'static Field,
    value: Option<&Value>,
    wanted: Option<&Value>,
    checker: &Checker,
) -> Option<Text> {
    let near = near(field, checker.scale);
    let with_reason = |message: Text| {
        if rule.reason.is_empty() {
            message
        } else {
            text!("{message}: {reason}", message, rule.reason.clone())
        }
    };
    if let Some(wanted) = wanted.filter(|_| rule.locked) {
        // An optional form that is not used has no value.
        let same = value.is_none_or(|value| same(value, wanted, near));
        return (!same).then(|| {
            with_reason(text!(
                "{portal} fixes {label} at {value}",
                config.who(),
                field.label,
                shown(field, wanted, checker)
            ))
        });
    }
    // A value without limit, an unknown one or an uncalled tool is not between two numbers.
    let number = match value {
        Some(Value::Number(number)) => *number,
        Some(Value::Null) => f64::NAN,
        Some(Value::Text(text)) if tolerance::toleranced(text).is_some() => {
            tolerance::toleranced(text)?
        }
        // A value that follows a result is known only at the machine.
        Some(Value::Text(text))
            if (rule.least, rule.most) != (None, None)
                && text.trim_start_matches(' ').starts_with('=') =>
        {
            return Some(with_reason(text!(
                "{portal} bounds {label}: it cannot follow a result",
                config.who(),
                field.label
            )));
        }
        _ => return None,
    };
    let factor = if field.kind.is_metric() {
        config.units.scale() / checker.scale
    } else {
        1.0
    };
    let (least, most) = (
        rule.least.map(|x| x * factor),
        rule.most.map(|x| x * factor),
    );
    let within = |x: Option<f64>, way: f64| x.is_none_or(|x| (number - x) * way >= -near);
    let outside = !(within(least, 1.0) && within(most, -1.0));
    let limit = |x: f64| shown(field, &Value::Number(x), checker);
    let message = match (least, most) {
        _ if !outside => return None,
        (Some(least), Some(most)) => {
            text!(
                "{portal} allows {label} from {min} to {max}",
                config.who(),
                field.label,
                limit(least),
                limit(most)
            )
        }
        (Some(least), None) => text!(
            "{portal} allows {label} of {min} and more",
            config.who(),
            field.label,
            limit(least)
        ),
        (None, Some(most)) => text!(
            "{portal} allows {label} of {max} and less",
            config.who(),
            field.label,
            limit(most)
        ),
        (None, None) => return None,
    };
    Some(with_reason(message))
}

/// Whether two values are equal.
fn same(one: &Value, other: &Value, near: f64) -> bool {
    match (one, other) {
        (Value::Number(a), Value::Number(b)) => (a - b).abs() <= near,
        (Value::List(a), Value::List(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b, near))
        }
        _ => one == other,
    }
}

/// A value in a message.
fn shown(field: &Field, value: &Value, checker: &Checker) -> Part {
    let number = |x: f64| {
        decimal(
            x,
            if field.kind.is_metric() && checker.scale != 1.0 {
                6
            } else {
                4
            },
        )
    };
    match value {
        Value::Number(x) => format!("{}{}", number(*x), checker.unit_of(field.kind)).into(),
        Value::Text(text) => printable(text).into(),
        Value::Null => Text::words(field.null.unwrap_or("null")).into(),
        Value::List(items) => {
            let all = items.iter().map(|item| {
                if let Value::Number(x) = item {
                    number(*x)
                } else {
                    String::new()
                }
            });
            all.collect::<Vec<_>>().join(" ").into()
        }
        Value::Flag(true) => "true".to_owned().into(),
        Value::Flag(false) => "false".to_owned().into(),
        // Lines of a program by their places.
        Value::Map(places) => {
            let lines = places.iter().flat_map(|(_, lines)| match lines {
                Value::List(lines) => lines.as_slice(),
                _ => &[],
            });
            let texts = lines.filter_map(|line| match line {
                Value::Text(text) => Some(printable(text)),
                _ => None,
            });
            texts.collect::<Vec<_>>().join(" | ").into()
        }
        Value::Other(_) => String::new().into(),
    }
}

/// Checks the path against the travel of the machine and its keep-out zones.
fn judge_space(config: &Config, planned: &PlannedJob, checker: &mut Checker) {
    let PlannedJob { job, path, .. } = planned;
    let place = |index: usize| match path.member_of_move(index) {
        Some(cycle) if !path.cycles.is_empty() => format!("cycles[{cycle}]"),
        _ => "cycle".to_owned(),
    };
    let Space { travel, keep_out } = &config.space;
    if travel.is_none() && keep_out.is_empty() {
        return;
    }
    let pieces = pieces(path);
    for found in travel.iter().flat_map(|travel| beyond(&pieces, travel)) {
        let (axis, at) = (AXIS_NAMES[found.axis], checker.length(found.place));
        let (number, limit) = (found.index + 1, checker.length(found.limit));
        let message = if found.search {
            text!(
                "The search in move {number} reaches {axis} {place}, beyond the travel limit {limit}",
                number,
                axis,
                at,
                limit
            )
        } else {
            text!(
                "Move {number} moves the ball centre to {axis} {place}, beyond the travel limit {limit}",
                number,
                axis,
                at,
                limit
            )
        };
        checker.error("beyond-travel", place(found.index), message);
    }
    for zone in keep_out {
        let Some((index, part)) = enters(&pieces, zone, path.frame.w, job.setup.radius, &job.shape)
        else {
            continue;
        };
        let (number, name) = (index + 1, zone.name.clone());
        let message = match part {
            ProbePart::Ball => text!(
                "In move {number} the ball enters the keep-out zone {zone}",
                number,
                name
            ),
            ProbePart::Shank => text!(
                "In move {number} the stylus enters the keep-out zone {zone}",
                number,
                name
            ),
            ProbePart::Body => text!(
                "In move {number} the probe body enters the keep-out zone {zone}",
                number,
                name
            ),
        };
        checker.error("keep-out", place(index), message);
    }
}
