//! The list of cycles of a job of format 2: each as the job that it would be alone.

use crate::form::{Field, Value};

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

/// Whether a job has several cycles.
pub fn is_set_up(job: &Value) -> bool {
    matches!(job.get("format"), Some(Value::Number(n)) if *n == SET_UP_FORMAT) || job.get("cycles").is_some()
}

/// The job that a cycle of a set-up would be alone; what is wrong with the set-up itself is not in it.
pub fn alone(job: &Value, index: usize) -> Option<Value> {
    let (Value::Map(entries), Some(Value::List(cycles))) = (job, job.get("cycles")) else { return None };
    let Value::Map(cycle) = cycles.get(index)? else { return None };
    let name = name_of(cycles, index);
    let own = |(key, value): &(String, Value)| match key.as_str() {
        "format" | "cycle" | "cycles" | "clear" | "datum" => None,
        "part" => Some((key.clone(), part_of(value, &name))),
        _ => Some((key.clone(), value.clone())),
    };
    let mut alone = vec![("format".to_owned(), Value::Number(crate::job::FORMAT))];
    alone.extend(entries.iter().filter_map(own));
    let cycle = cycle.iter().filter(|(key, _)| key != "name").cloned().collect();
    alone.push(("cycle".to_owned(), Value::Map(cycle)));
    Some(Value::Map(alone))
}

/// The virtual part with the sizes of one cycle: `BORE.diameter` is its `diameter`.
fn part_of(part: &Value, name: &str) -> Value {
    let Value::Map(entries) = part else { return part.clone() };
    let of = |(key, value): &(String, Value)| match (key.as_str(), value) {
        ("sizes", Value::Map(sizes)) => {
            let own = sizes.iter().filter_map(|(size, value)| {
                let (of, size) = size.split_once('.')?;
                of.eq_ignore_ascii_case(name).then(|| (size.to_owned(), value.clone()))
            });
            (key.clone(), Value::Map(own.collect()))
        }
        _ => (key.clone(), value.clone()),
    };
    Value::Map(entries.iter().map(of).collect())
}

/// The name of a cycle: its own, or what its type is called, with a number where that is taken.
pub fn name_of(cycles: &[Value], index: usize) -> String {
    let given = |cycle: &Value| match cycle.get("name") {
        Some(Value::Text(name)) => Some(name.clone()),
        _ => None,
    };
    if let Some(name) = cycles.get(index).and_then(given) {
        return name;
    }
    let stem = |cycle: &Value| match cycle.get("type") {
        Some(Value::Text(key)) => crate::cycle::find(key).map_or("CYCLE", |def| def.name),
        _ => "CYCLE",
    };
    let own: String = cycles.get(index).map_or("CYCLE", stem).chars().filter(char::is_ascii_alphanumeric).collect();
    let earlier = cycles[..index.min(cycles.len())]
        .iter()
        .filter(|cycle| given(cycle).is_none() && stem(cycle) == cycles.get(index).map_or("CYCLE", stem));
    let mut number = earlier.count() + 1;
    loop {
        let name = if number == 1 { own.clone() } else { format!("{own}{number}") };
        if !cycles.iter().filter_map(given).any(|taken| taken.eq_ignore_ascii_case(&name)) {
            return name;
        }
        number += 1;
    }
}
