//! Tool offsets that a program corrects from a measured size or height: `wear` of a tolerance.

use crate::control::corrections::{CorrectionSettings, correction};
use crate::control::native_run::CorrectsTools;
use crate::form::{Checker, Field, Finding, Section, SubForm, Value, form};
use crate::formula::{ResultRow, Wear};
use crate::num::decimal;
use crate::path::Path;
use crate::text::{Text, text};

form! {
    /// Correction of a tool by a measured size.
    pub struct WearForm {
        /// The number of its offset.
        tool: Option<i32> = Field::count("tool", "Tool offset", 1, 1, 999).null_by_default(),
        /// How much of the error it is corrected by, percent.
        percent: i32 = Field::count("percent", "Percent of the error", 100, 1, 100),
        /// The error up to which it stays.
        dead_band: f64 = Field::length("deadBand", "Dead band", 0.0).range(0.0, 1.0),
        /// Of how many parts the mean of the errors counts. Empty: each part corrects it, which only macros do.
        parts: Option<i32> = Field::count("parts", "Mean of parts", 3, 2, 99).null_by_default().null_means("each part"),
        /// With a mean: where its values are kept from part to part. For a macro the first of two tool offsets, of no tool; for moves the first of two variables,
        /// such as 520 for #520 and #521, or 90 for R90 and R91.
        store: Option<i32> = Field::count("store", "Stored in", 1, 1, 998).null_by_default().null_means("no mean"),
    }
}

/// Form inside that of a tolerance.
pub const WEAR: SubForm = SubForm {
    key: "wear",
    fields: WearForm::FIELDS,
    optional: true,
};

/// Tools that the tolerances of a job correct, each with the code of its result. Faulty ones are left out: reading the tolerances reports them.
pub fn of(tolerances: Option<&Value>, scale: f64) -> Vec<(String, Wear)> {
    let Some(Value::Map(entries)) = tolerances else {
        return Vec::new();
    };
    let one = |(code, given): &(String, Value)| {
        Some((code.to_ascii_lowercase(), read(given, "", (scale, "")).0?))
    };
    entries.iter().filter_map(one).collect()
}

/// Tolerances of a set-up that belong to one of its cycles, by their codes in that cycle. The name of an only cycle may be left out.
pub fn of_cycle(tolerances: Option<&Value>, name: &str, only: bool) -> Value {
    let Some(Value::Map(entries)) = tolerances else {
        return Value::Null;
    };
    let own = entries.iter().filter_map(|(full, given)| {
        let named = full
            .split_once('.')
            .filter(|(of, _)| of.eq_ignore_ascii_case(name))
            .map(|(_, code)| code);
        let code = named.or(only.then_some(full.as_str()))?;
        Some((code.to_owned(), given.clone()))
    });
    Value::Map(own.collect())
}

/// Tool that a tolerance corrects, with findings; `None` without one, or with an error. `at` is the path of the tolerance.
pub fn read(
    tolerance: &Value,
    at: &str,
    (scale, unit): (f64, &'static str),
) -> (Option<Wear>, Vec<Finding>) {
    let mut checker = Checker::default();
    (checker.scale, checker.unit) = (scale, unit);
    let Some(form) = Section::new(&mut checker, Some(tolerance), at).sub(&WEAR, WearForm::read)
    else {
        return (None, checker.findings());
    };
    let at = |key: &str| format!("{at}.wear.{key}");
    if matches!(tolerance.get("wear"), Some(Value::Map(_)))
        && tolerance
            .get("wear")
            .and_then(|wear| wear.get("tool"))
            .is_none()
    {
        checker.error(
            "missing",
            at("tool"),
            text!("wear needs the number of the tool offset"),
        );
    }
    match (form.parts, form.store) {
        _ if checker.failed() => {}
        (Some(_), None) => {
            let message = text!(
                "The mean of several parts needs store: where its values are kept from part to part"
            );
            checker.error("missing", at("store"), message);
        }
        (None, Some(_)) => {
            checker.error(
                "missing",
                at("parts"),
                text!("store keeps the values of several parts: specify their number in parts"),
            );
        }
        _ => {}
    }
    let wear = form.tool.filter(|_| !checker.failed()).map(|tool| Wear {
        tool,
        share: f64::from(form.percent) / 100.0,
        length: false,
        sense: 0.0,
        dead_band: form.dead_band,
        mean: form.parts.zip(form.store),
    });
    (wear, checker.findings())
}

/// Reports how a program of moves corrects each tool, if every part is like the virtual one.
#[inline(never)]
pub fn report_means(
    path: &Path,
    rows: &[ResultRow],
    settings: CorrectionSettings<'_>,
    checker: &mut Checker,
) {
    for (row, own) in rows.iter().zip(path.formula.results.iter().enumerate()) {
        let Some((correction, value)) = correction(settings, own).zip(row.value) else {
            continue;
        };
        let error = value - own.1.nominal;
        let (result, off) = (Text::words(own.1.meaning), checker.length(error));
        let about = Text::words(correction.about);
        let message = if error.abs() > correction.check.limit {
            text!(
                "{result} is off by {error}: the program stops with an alarm, and the error does not count for tool {tool}",
                result,
                off,
                correction.wear.tool
            )
        } else if error.abs() <= correction.wear.dead_band.max(1e-9) {
            text!(
                "{result} is off by {error}: {parts} parts like this one leave the {wear} of tool {tool} as it is",
                result,
                off,
                correction.parts,
                about,
                correction.wear.tool
            )
        } else {
            text!(
                "{result} is off by {error}: after {parts} parts like this one the program changes the {wear} of tool {tool} by {change}",
                result,
                off,
                correction.parts,
                about,
                correction.wear.tool,
                checker.length(error * correction.factor)
            )
        };
        checker.info("tool-corrected", "tolerances", message);
    }
}

/// Reports the correction of each tool offset by macros on the virtual part. A size that deviates by `limit` or more stops its macro.
pub fn report_macros(
    path: &Path,
    rows: &[ResultRow],
    (own, limit): (CorrectsTools, Option<f64>),
    checker: &mut Checker,
) {
    for (row, def) in rows.iter().zip(&path.formula.results) {
        let Some(wear) = def.tolerance.and_then(|tolerance| tolerance.wear) else {
            continue;
        };
        let Some(error) = row.value.map(|value| value - def.nominal) else {
            continue;
        };
        let (result, tool) = (Text::words(def.meaning), wear.tool);
        let off = checker.length(error);
        let beyond = limit.is_some_and(|limit| error.abs() >= limit);
        let message = if own == CorrectsTools::WholeError && beyond {
            text!(
                "{result} is off by {error}: the cycle stops the program, and may have corrected DR of tool {tool} by then",
                result,
                off,
                tool
            )
        } else if own == CorrectsTools::WholeError {
            text!(
                "{result} is off by {error}: the cycle corrects DR of tool {tool}, also within the tolerance",
                result,
                off,
                tool
            )
        } else if beyond {
            text!(
                "{result} is off by {error}: the macro stops with an alarm. Tool offset {tool} stays, unless the program is continued",
                result,
                off,
                tool
            )
        } else if error.abs() < 1e-9 {
            text!(
                "{result} is as large as the nominal part's: tool offset {tool} stays",
                result,
                tool
            )
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
                "{result} deviates by {error}: the macro stores that in offset {store}, and corrects tool offset {tool} by {percent} % of the mean of {parts} parts",
                result,
                off,
                store,
                tool,
                decimal(100.0 * wear.share, 0),
                parts
            )
        } else {
            text!(
                "{result} is off by {error}: the macro corrects tool offset {tool} by {percent} % of that, {correction}",
                result,
                off,
                tool,
                decimal(100.0 * wear.share, 0),
                checker.length(error * wear.share)
            )
        };
        checker.info("tool-corrected", "tolerances", message);
    }
}
