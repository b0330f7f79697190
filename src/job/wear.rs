//! Tools that a macro corrects by what it measures: `wear` of a tolerance.

use crate::form::{Checker, Value};
use crate::formula::{ResultRow, Wear};
use crate::num::decimal;
use crate::path::Path;
use crate::text::{Text, text};

/// The highest number of a tool offset.
pub const MOST_TOOLS: i32 = 999;

/// The most parts of a mean.
pub const MOST_PARTS: i32 = 99;

/// The keys of one.
pub const KEYS: [&str; 5] = ["tool", "share", "deadBand", "parts", "store"];

/// The most that an error may be without a correction, mm.
pub const WIDEST_BAND: f64 = 1.0;

/// What the tolerances of a job say of tools, each by the code of its result: only what is sound, the rest is reported where tolerances are read.
pub fn of(tolerances: Option<&Value>, scale: f64) -> Vec<(String, Wear)> {
    let Some(Value::Map(entries)) = tolerances else { return Vec::new() };
    let mut silent = Checker::default();
    let one = |(code, given): &(String, Value)| {
        let wear = given.get("wear").filter(|wear| !matches!(wear, Value::Null))?;
        Some((code.to_ascii_lowercase(), values(&mut silent, wear, "", scale)?))
    };
    entries.iter().filter_map(one).collect()
}

/// The tolerances of a set-up that are those of one of its cycles, by the codes that they have there. The name of an only cycle may be left out.
pub fn of_cycle(tolerances: Option<&Value>, name: &str, only: bool) -> Value {
    let Some(Value::Map(entries)) = tolerances else { return Value::Null };
    let own = entries.iter().filter_map(|(full, given)| {
        let named = full.split_once('.').filter(|(of, _)| of.eq_ignore_ascii_case(name)).map(|(_, code)| code);
        let code = named.or(only.then_some(full.as_str()))?;
        Some((code.to_owned(), given.clone()))
    });
    Value::Map(own.collect())
}

/// The values of one, lengths in mm. Reports what is wrong with them.
pub fn values(checker: &mut Checker, wear: &Value, at: &str, scale: f64) -> Option<Wear> {
    let mut good = true;
    let mut number = |key: &str, low: f64, high: f64, whole: bool| -> Option<f64> {
        let given = wear.get(key).filter(|given| !matches!(given, Value::Null))?;
        let path = format!("{at}.{key}");
        match given {
            Value::Number(x) if (low..=high).contains(x) && (!whole || x.fract() == 0.0) => return Some(*x),
            Value::Number(_) if whole => {
                let message = text!(
                    "{path} must be a whole number from {low} to {high}",
                    path.clone(),
                    decimal(low, 0),
                    decimal(high, 0)
                );
                checker.error("out-of-range", path, message);
            }
            Value::Number(_) => {
                let message = text!("{path} must be {low} to {high}", path.clone(), decimal(low, 4), decimal(high, 4));
                checker.error("out-of-range", path, message);
            }
            other => {
                checker.error("wrong-type", path.clone(), text!("{path} must be a number, not {given}", path, other.noun()))
            }
        }
        good = false;
        None
    };
    let tool = number("tool", 1.0, f64::from(MOST_TOOLS), true);
    let share = number("share", 0.01, 1.0, false);
    let band = number("deadBand", 0.0, WIDEST_BAND / scale + 1e-9, false);
    let parts = number("parts", 2.0, f64::from(MOST_PARTS), true);
    let store = number("store", 1.0, f64::from(MOST_TOOLS - 1), true);
    let tool_missing = wear.get("tool").is_none_or(|given| matches!(given, Value::Null));
    if tool_missing {
        checker.error("missing", format!("{at}.tool"), text!("wear needs the number of the tool offset"));
        return None;
    }
    if parts.is_some() != store.is_some() && good {
        let (missing, message) = match parts {
            Some(_) => (
                "store",
                text!(
                    "The mean of several parts needs store, a tool offset that no tool has: the macro keeps its values there"
                ),
            ),
            None => ("parts", text!("store keeps the values of several parts: parts says of how many")),
        };
        checker.error("missing", format!("{at}.{missing}"), message);
        return None;
    }
    let mean = parts.zip(store).map(|(parts, store)| (parts as i32, store as i32));
    good.then_some(Wear { tool: tool? as i32, share: share.unwrap_or(1.0), dead_band: band.unwrap_or(0.0) * scale, mean })
}

/// What becomes of the tools on the virtual part. `limit`: a size that is off by more stops its macro.
pub fn report(path: &Path, rows: &[ResultRow], limit: Option<f64>, checker: &mut Checker) {
    for (row, def) in rows.iter().zip(&path.formula.results) {
        let Some(wear) = def.tolerance.and_then(|tolerance| tolerance.wear) else { continue };
        let Some(error) = row.value.map(|value| value - def.nominal) else { continue };
        let (result, tool) = (Text::words(def.meaning), wear.tool);
        let off = checker.length(error);
        let message = if limit.is_some_and(|limit| error.abs() >= limit) {
            text!(
                "{result} is off by {error}: the macro stops with an alarm. Tool offset {tool} stays, unless the program is continued",
                result,
                off,
                tool
            )
        } else if error.abs() < 1e-9 {
            text!("{result} is as large as the nominal part's: tool offset {tool} stays", result, tool)
        } else if error.abs() <= wear.dead_band {
            text!(
                "{result} is off by {error}, no more than the dead band of {band}: tool offset {tool} stays",
                result,
                off,
                checker.length(wear.dead_band),
                tool
            )
        } else if let Some((parts, store)) = wear.mean {
            text!(
                "{result} is off by {error}: the macro keeps that in offset {store}, and corrects tool offset {tool} by {share} × the mean of {parts} parts",
                result,
                off,
                store,
                tool,
                decimal(wear.share, 4),
                parts
            )
        } else {
            text!(
                "{result} is off by {error}: the macro corrects tool offset {tool} by {share} × that, {correction}",
                result,
                off,
                tool,
                decimal(wear.share, 4),
                checker.length(error * wear.share)
            )
        };
        checker.info("tool-corrected", "tolerances", message);
    }
}
