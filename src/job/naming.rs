//! The default name of a job.

use crate::cycle;
use crate::form::{Field, Kind, Value};
use crate::num::decimal;
use crate::tolerance;

/// Decimals of a size in a name. At most three: four digits at the end could be read as the number of a program.
const DECIMALS: usize = 3;

/// Name by the measured feature, with its main sizes in the job's units: `BORE-D25`, `POCKET-80X50`, `CORNER-90`; without sizes if one of them is not a number.
/// It consists of capitals, digits, `-` and `_`, which every control accepts. A job without a known cycle is `PROBE`.
pub fn job_name(job: &Value) -> String {
    if let Some(Value::List(cycles)) = job.get("cycles") {
        return format!("SETUP-{}", cycles.len());
    }
    let cycle = job.get("cycle");
    let Some(Value::Text(key)) = cycle.and_then(|cycle| cycle.get("type")) else {
        return "PROBE".to_owned();
    };
    let Some(def) = cycle::find(key) else {
        return "PROBE".to_owned();
    };
    let sizes = def
        .fields
        .iter()
        .filter(|field| field.size)
        .map(|field| size(field, cycle.and_then(|cycle| cycle.get(field.key))));
    let Some(mut sizes) = sizes.collect::<Option<Vec<String>>>() else {
        return def.name.to_owned();
    };
    sizes.dedup();
    match sizes.is_empty() {
        true => def.name.to_owned(),
        false => format!("{}-{}", def.name, sizes.join("X")),
    }
}

/// A size in a name: `D12_5`, `80`.
fn size(field: &Field, value: Option<&Value>) -> Option<String> {
    let size = match value? {
        Value::Number(x) => *x,
        Value::Text(text) => {
            tolerance::toleranced(text).or_else(|| tolerance::parse(text, 1.0).ok()?.nominal)?
        }
        _ => return None,
    };
    let written = (size.is_finite() && size.abs() < 1e5)
        .then(|| decimal(size.abs(), DECIMALS).replace('.', "_"))?;
    let round = field.kind != Kind::Angle && field.key.starts_with("diameter");
    // Names are upper case: h7 of a shaft would read as H7 of a hole.
    let class = match value? {
        Value::Text(text)
            if field.kind == Kind::Length && !text.contains(|c: char| c.is_ascii_lowercase()) =>
        {
            tolerance::class_of(text).unwrap_or_default()
        }
        _ => "",
    };
    let letter = if round { "D" } else { "" };
    Some(format!("{letter}{written}{class}"))
}
