//! Finds the words of native calls that correspond to rows of the parameter table: each value is changed a little, and the changed words of the calls are
//! recorded. So the table lists only what the writer does.

use crate::form::{Checker, Value};
use crate::job::Job;
use crate::job::defaults::resolved;
use crate::job::planned::PlannedJob;
use crate::path::{CallBlock, Feature, Parameter, ParameterValue, Path};

/// Change of a value, in units of the job.
const STEP: f64 = 1.0 / 128.0;

/// Displacement of the feature, so that no two positions are equal by chance.
const ASIDE: [f64; 3] = [12.0625, -7.1875, 3.3125];

/// Codes from here down belong to the touches before dimensions are compensated.
const ORIGINAL: i32 = -200;

/// Tolerance for equal values, mm or degrees.
const NEAR: f64 = 1e-7;

/// For each row of the parameter table the words of the calls that depend on it: `P9814 D`, `CYCLE977 5`. `None` if the job's program calls no native cycles,
/// or has errors.
pub fn calls(value: &Value) -> Option<Vec<Vec<String>>> {
    let job = aside(&resolved(value)?);
    let planned = planned(&job)?;
    let base = words(&planned)?;
    let rows = table(&planned);
    let walls = matches!(
        planned.path.feature,
        Feature::Surface(_) | Feature::Corner(_)
    );
    let found = rows.iter().map(|row| {
        let followed = row
            .field
            .as_deref()
            .and_then(|field| following(&job, field, &base))
            .unwrap_or_default();
        // The position of a wall belongs to a touch.
        let place = match row.value {
            ParameterValue::Length(mm) if walls && row.touch.is_some() && row.code > ORIGINAL => {
                Some(mm)
            }
            _ => None,
        };
        let same = base
            .iter()
            .filter(|word| word.measures && place.is_some_and(|mm| (word.value - mm).abs() < NEAR));
        let mut names: Vec<String> = followed
            .into_iter()
            .chain(same.map(|word| word.name.clone()))
            .collect();
        let mut seen = Vec::new();
        names.retain(|name| {
            !seen.contains(name) && {
                seen.push(name.clone());
                true
            }
        });
        names
    });
    Some(found.collect())
}

/// A word of a call.
struct Word {
    name: String,
    /// In mm or degrees.
    value: f64,
    /// Whether the call measures.
    measures: bool,
}

fn planned(job: &Value) -> Option<PlannedJob> {
    let mut checker = Checker::default();
    let planned = PlannedJob::of(Job::read(&mut checker, job)?);
    (!checker.failed() && planned.native_rejections.is_empty()).then_some(planned)
}

/// Words of the calls; `None` if nothing is called.
fn words(planned: &PlannedJob) -> Option<Vec<Word>> {
    let (own, cycles) = (planned.path.calls.as_ref()?, planned.job.post.own?);
    let all = own.blocks.iter().flat_map(|(block, _)| {
        let measures = block.measures();
        let of = |number: u32, name: String, value: f64| Word {
            name: (cycles.word)(number, &name),
            value,
            measures,
        };
        match block {
            CallBlock::Call(number, letters) => letters
                .iter()
                .map(|(letter, x)| of(*number, letter.to_string(), x.value()))
                .collect::<Vec<Word>>(),
            CallBlock::Cycle(number, places) => places
                .iter()
                .map(|(place, x)| of(u32::from(*number), place.to_string(), x.value()))
                .collect(),
            CallBlock::MoveTo(..) | CallBlock::SaveResult(..) | CallBlock::Compute(_) => Vec::new(),
        }
    });
    Some(all.collect())
}

/// Rows of the documented cycle's table.
fn table(planned: &PlannedJob) -> Vec<Parameter> {
    let documented: Path = planned.job.cycle.plan(&planned.job.setup);
    planned
        .job
        .cycle
        .parameters(&planned.job.setup, &documented.touches)
}

/// Words that depend on a field of the job.
fn following(job: &Value, field: &str, base: &[Word]) -> Option<Vec<String>> {
    let moved = moved(job, field)?;
    // If a cycle has one value for two sides, both are changed.
    let other = match (words_of(&moved), twin(field)) {
        (None, Some(twin)) => words_of(&self::moved(&moved, &twin)?)?,
        (words, _) => words?,
    };
    let same = other.len() == base.len() && other.iter().zip(base).all(|(a, b)| a.name == b.name);
    same.then_some(())?;
    let changed = other
        .iter()
        .zip(base)
        .filter(|(a, b)| (a.value - b.value).abs() > NEAR);
    Some(changed.map(|(word, _)| word.name.clone()).collect())
}

fn words_of(job: &Value) -> Option<Vec<Word>> {
    words(&planned(job)?)
}

/// The corresponding field of the other side.
fn twin(field: &str) -> Option<String> {
    let (stem, side) = field.split_at_checked(field.len().checked_sub(1)?)?;
    match side {
        "1" => Some(format!("{stem}2")),
        "2" => Some(format!("{stem}1")),
        _ => None,
    }
}

/// The job with one number changed: a field, or a coordinate of one, `cycle.point1[0]`.
fn moved(job: &Value, field: &str) -> Option<Value> {
    let (field, index) = match field
        .strip_suffix(']')
        .and_then(|field| field.split_once('['))
    {
        Some((field, index)) => (field, index.parse::<usize>().ok()),
        None => (field, None),
    };
    let path: Vec<&str> = field.split('.').collect();
    let step = |value: &Value| {
        if let Value::Number(x) = value {
            Some(Value::Number(x + STEP))
        } else {
            None
        }
    };
    let new = match (
        path.iter().try_fold(job, |value, key| value.get(key))?,
        index,
    ) {
        (Value::List(places), Some(index)) => {
            let mut places = places.clone();
            let place = places.get_mut(index)?;
            *place = step(place)?;
            Value::List(places)
        }
        (value, _) => step(value)?,
    };
    Some(with(job, &path, &new))
}

/// The job with its feature displaced.
fn aside(job: &Value) -> Value {
    let Some(Value::List(origin)) = job.get("cycle").and_then(|cycle| cycle.get("origin")) else {
        return job.clone();
    };
    let places = origin.iter().zip(ASIDE).map(|(place, by)| match place {
        Value::Number(x) => Value::Number(x + by),
        other => other.clone(),
    });
    with(job, &["cycle", "origin"], &Value::List(places.collect()))
}

/// A job with another value at an existing path.
fn with(value: &Value, path: &[&str], new: &Value) -> Value {
    let ([key, rest @ ..], Value::Map(entries)) = (path, value) else {
        return new.clone();
    };
    let inner = |(known, value): &(String, Value)| {
        (
            known.clone(),
            if known == key {
                with(value, rest, new)
            } else {
                value.clone()
            },
        )
    };
    Value::Map(entries.iter().map(inner).collect())
}
