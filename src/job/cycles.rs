//! The cycles of a job in format 2, each as a job of its own.

use crate::cycle;
use crate::form::{Field, Value};
use crate::job::sections::{TOLERANCES, USUAL_SIZE, Units};
use crate::job::sized;
use crate::num::tidy;

/// The format of a job with several cycles.
pub const SET_UP_FORMAT: f64 = 2.0;

/// Largest number of cycles in a set-up.
pub const MOST_CYCLES: usize = 100;

/// Longest name of a cycle, characters.
pub const LONGEST_NAME: usize = 12;

/// Names that programs use otherwise.
pub const RESERVED: [&str; 2] = ["away", "tp"];

/// Clearance plane between cycles.
pub const CLEAR: Field = Field::length("clear", "Height between cycles", 50.0)
    .range(-1e6, 1e6)
    .null_by_default()
    .null_means("as high as the highest cycle begins and ends")
    .help("Height along the tool axis at which the ball centre goes from one cycle to the next.");

/// Keys of `datum`: sources of abscissa, ordinate, tool axis and rotation of the work offset.
pub const DATUM: [&str; 4] = ["x", "y", "z", "rotation"];

/// Key of a job with the relations between results.
pub const RELATIONS: &str = "relations";

/// Whether programs of every control can print the name before a result.
pub fn is_name(name: &str) -> bool {
    let plain = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric());
    plain
        && name.len() <= LONGEST_NAME
        && !RESERVED.iter().any(|word| name.eq_ignore_ascii_case(word))
}

/// Whether a job has several cycles.
pub fn is_set_up(job: &Value) -> bool {
    matches!(job.get("format"), Some(Value::Number(n)) if *n == SET_UP_FORMAT)
        || job.get("cycles").is_some()
}

/// The job of a single cycle of a set-up, without faults of the set-up itself.
pub fn single_cycle_job(job: &Value, index: usize) -> Option<Value> {
    let (Value::Map(entries), Some(Value::List(cycles))) = (job, job.get("cycles")) else {
        return None;
    };
    let Value::Map(cycle) = cycles.get(index)? else {
        return None;
    };
    let own = |(key, value): &(String, Value)| match key.as_str() {
        "format" | "cycle" | "cycles" | "clear" | "datum" | RELATIONS | TOLERANCES => None,
        "part" if value.get("sizes").is_some() => {
            Some((key.clone(), part_of(value, &name_of(cycles, index))))
        }
        _ => Some((key.clone(), value.clone())),
    };
    let mut alone = vec![("format".to_owned(), Value::Number(crate::job::FORMAT))];
    alone.extend(entries.iter().filter_map(own));
    let cycle = cycle
        .iter()
        .filter(|(key, _)| key != "name")
        .cloned()
        .collect();
    alone.push(("cycle".to_owned(), Value::Map(cycle)));
    Some(Value::Map(alone))
}

/// Adds the size limit to a set-up that leaves it out and has a size with a tolerance. One limit applies to all cycles, so the widest tolerance decides.
pub fn with_size_limit(set_up: &Value) -> Option<Value> {
    let limits = set_up.get("limits");
    let Some(Value::List(cycles)) = set_up.get("cycles") else {
        return None;
    };
    if limits.is_some_and(|given| given.get("size").is_some()) {
        return None;
    }
    let scale = Units::of(set_up).scale();
    let sized: Vec<sized::Sized> = cycles
        .iter()
        .filter_map(|cycle| match cycle.get("type") {
            Some(Value::Text(key)) => Some(sized::of(cycle::find(key)?, cycle, scale)),
            _ => None,
        })
        .flatten()
        .collect();
    let limit = Value::Number(tidy(sized::size_limit(&sized, USUAL_SIZE)? / scale));
    let mut limits = limits.cloned().unwrap_or(Value::Map(Vec::new()));
    limits.put("size", limit);
    let mut whole = set_up.clone();
    whole.put("limits", limits);
    Some(whole)
}

/// The virtual part with the sizes of one cycle: `BORE.diameter` is its `diameter`.
fn part_of(part: &Value, name: &str) -> Value {
    let Value::Map(entries) = part else {
        return part.clone();
    };
    let of = |(key, value): &(String, Value)| match (key.as_str(), value) {
        ("sizes", Value::Map(sizes)) => {
            let own = sizes.iter().filter_map(|(size, value)| {
                let (of, size) = size.split_once('.')?;
                of.eq_ignore_ascii_case(name)
                    .then(|| (size.to_owned(), value.clone()))
            });
            (key.clone(), Value::Map(own.collect()))
        }
        _ => (key.clone(), value.clone()),
    };
    Value::Map(entries.iter().map(of).collect())
}

/// Name of a cycle, as in [`names`].
pub fn name_of(cycles: &[Value], index: usize) -> String {
    names(cycles).swap_remove(index)
}

/// Names of all cycles: the given one, or the name of the type, with the first free number from 2 if that is taken.
pub fn names(cycles: &[Value]) -> Vec<String> {
    let given = |cycle: &Value| match cycle.get("name") {
        Some(Value::Text(name)) => Some(name.clone()),
        _ => None,
    };
    let stem = |cycle: &Value| match cycle.get("type") {
        Some(Value::Text(key)) => crate::cycle::find(key).map_or("CYCLE", |def| def.name),
        _ => "CYCLE",
    };
    let mut names: Vec<Option<String>> = cycles.iter().map(given).collect();
    // Last used number of each stem.
    let mut numbers: Vec<(&str, usize)> = Vec::new();
    for (i, cycle) in cycles
        .iter()
        .enumerate()
        .filter(|(_, cycle)| given(cycle).is_none())
    {
        let stem = stem(cycle);
        let own: String = stem.chars().filter(char::is_ascii_alphanumeric).collect();
        let at = numbers
            .iter()
            .position(|(known, _)| *known == stem)
            .unwrap_or_else(|| {
                numbers.push((stem, 0));
                numbers.len() - 1
            });
        let name = loop {
            numbers[at].1 += 1;
            let name = if numbers[at].1 == 1 {
                own.clone()
            } else {
                format!("{own}{}", numbers[at].1)
            };
            if !names
                .iter()
                .flatten()
                .any(|taken| taken.eq_ignore_ascii_case(&name))
            {
                break name;
            }
        };
        names[i] = Some(name);
    }
    names.into_iter().flatten().collect()
}
