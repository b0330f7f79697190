//! The list of cycles of a job of format 2: each as the job that it would be alone.

use crate::cycle;
use crate::form::{Field, Value};
use crate::job::sections::{TOLERANCES, USUAL_SIZE, Units};
use crate::job::sized;
use crate::num::tidy;

/// The format of a job with several cycles.
pub const SET_UP_FORMAT: f64 = 2.0;

/// The most cycles of a set-up.
pub const MOST_CYCLES: usize = 100;

/// The most characters of the name of a cycle.
pub const LONGEST_NAME: usize = 12;

/// Names that programs use for something else.
pub const RESERVED: [&str; 2] = ["away", "tp"];

/// The height between cycles.
pub const CLEAR: Field = Field::length("clear", "Height between cycles", 50.0)
    .range(-1e6, 1e6)
    .null_by_default()
    .null_means("as high as the highest cycle begins and ends")
    .help("Height along the tool axis at which the ball centre goes from one cycle to the next.");

/// The keys of `datum`: what is written into abscissa, ordinate and tool axis of the work offset, and into its rotation.
pub const DATUM: [&str; 4] = ["x", "y", "z", "rotation"];

/// The key of a job that holds what is computed of the results of its cycles.
pub const RELATIONS: &str = "relations";

/// Whether programs of every control can print it in front of a result.
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

/// The job that a cycle of a set-up would be alone; what is wrong with the set-up itself is not in it.
pub fn alone(job: &Value, index: usize) -> Option<Value> {
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

/// Adds the size limit to a set-up that leaves it out and has a size with a tolerance. One limit holds for all cycles, so the widest tolerance decides.
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

/// The name of a cycle, as [`names`] has it.
pub fn name_of(cycles: &[Value], index: usize) -> String {
    names(cycles).swap_remove(index)
}

/// The names of all cycles: its own each, or what its type is called, with the first number from 2 where that is taken.
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
    // How far the numbers of each stem have come.
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
