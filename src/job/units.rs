//! Converts a job to other units: lengths, feeds, and values with tolerances. The geometry stays the same.

use crate::cycle;
use crate::form::{Field, Finding, Level, Value};
use crate::job::JobError;
use crate::job::cycles::{is_set_up, name_of, single_cycle_job};
use crate::job::dependencies;
use crate::job::sections::{SECTIONS, TOLERANCES, Units};
use crate::job::wear::WEAR;
use crate::text::text;
use crate::tolerance;

/// Target of a conversion: factor and decimals.
#[derive(Clone, Copy)]
struct Target {
    factor: f64,
    decimals: i32,
}

impl Target {
    const fn of(units: Units) -> Target {
        match units {
            Units::Mm => Target {
                factor: Units::Inch.scale(),
                decimals: 4,
            },
            Units::Inch => Target {
                factor: 1.0 / Units::Inch.scale(),
                decimals: 6,
            },
        }
    }

    /// A number of the job itself. The repeatability of a probe can be 0.00025 mm: small numbers keep three more decimals.
    fn number(self, x: f64) -> f64 {
        let small = (x * self.factor).abs() < 1e-3;
        self.rounded(
            x,
            if small {
                self.decimals + 3
            } else {
                self.decimals
            },
        )
    }

    /// A number in a text that is copied into the program.
    fn printed(self, x: f64) -> f64 {
        self.rounded(x, self.decimals)
    }

    /// The converted number with `decimals`; zero is not negative. A number that is too large to be converted is unchanged.
    fn rounded(self, x: f64, decimals: i32) -> f64 {
        let step = 10f64.powi(decimals);
        let rounded = (x * self.factor * step).round() / step;
        if rounded.is_finite() {
            rounded + 0.0
        } else {
            x
        }
    }
}

/// A default of the catalog, which is in mm, in `units`.
pub(super) fn default_in(mm: f64, units: Units) -> f64 {
    match units {
        Units::Mm => mm,
        Units::Inch => Target::of(units).number(mm),
    }
}

/// The units with this word.
///
/// # Errors
///
/// `unknown-value` at `units` for any other word than `mm` and `inch`.
pub(crate) fn known_units(word: &str) -> Result<Units, JobError> {
    Units::named(word).ok_or_else(|| {
        let message = text!("Units are \"mm\" or \"inch\"");
        JobError {
            findings: vec![Finding::new(
                Level::Error,
                "unknown-value",
                "units",
                message,
            )],
        }
    })
}

/// The job in `units`, `mm` or `inch`: lengths and feeds with 4 decimals in mm and 6 in inch (three more below 0.001), angles unchanged. The job may have
/// errors: anything but a number or a text with a tolerance is unchanged. Custom codes are not converted, because their meaning is unknown.
pub fn convert_units(job: &Value, units: &str) -> Result<Value, JobError> {
    let units = known_units(units)?;
    let mut job = job.clone();
    if !matches!(job, Value::Map(_)) || Units::of(&job) == units {
        return Ok(job);
    }
    let to = Target::of(units);
    for form in SECTIONS {
        let section = if form.key.is_empty() {
            Some(&mut job)
        } else {
            job.get_mut(form.key)
        };
        convert_fields(section, form.fields, to);
    }
    convert_tolerances(job.get_mut(TOLERANCES), to);
    if is_set_up(&job) {
        return Ok(convert_set_up(&job, units, to));
    }
    let def = match job.get("cycle").and_then(|c| c.get("type")) {
        Some(Value::Text(key)) => cycle::find(key),
        _ => None,
    };
    if let Some(def) = def {
        convert_fields(job.get_mut("cycle"), def.fields, to);
        for section in def.sections {
            convert_fields(
                job.get_mut("cycle").and_then(|c| c.get_mut(section.key)),
                section.fields,
                to,
            );
        }
        convert_fields(
            job.get_mut("part").and_then(|p| p.get_mut("sizes")),
            def.fields,
            to,
        );
    }
    if let Some(Value::List(touches)) = job.get_mut("cycle").and_then(|c| c.get_mut("touches")) {
        for point in touches
            .iter_mut()
            .filter_map(|touch| touch.get_mut("point"))
        {
            convert(point, to);
        }
    }
    job.put("units", Value::Text(units.word().to_owned()));
    Ok(job)
}

/// Converts the cycles of a set-up, each as a single cycle, and the other entries.
fn convert_set_up(job: &Value, units: Units, to: Target) -> Value {
    let mut converted = job.clone();
    if let Some(clear) = converted.get_mut("clear") {
        convert(clear, to);
    }
    let count = if let Some(Value::List(cycles)) = job.get("cycles") {
        cycles.len()
    } else {
        0
    };
    for index in 0..count {
        let single =
            single_cycle_job(job, index).and_then(|alone| convert_units(&alone, units.word()).ok());
        let (Some(single), Some(Value::List(cycles))) = (single, converted.get_mut("cycles"))
        else {
            continue;
        };
        let (Some(Value::Map(own)), Some(Value::Map(cycle))) =
            (single.get("cycle"), cycles.get_mut(index))
        else {
            continue;
        };
        for (key, value) in own {
            if let Some((_, place)) = cycle.iter_mut().find(|(known, _)| known == key) {
                place.clone_from(value);
            }
        }
        let sizes = single
            .get("part")
            .and_then(|part| part.get("sizes"))
            .cloned();
        let (Some(Value::Map(sizes)), Some(Value::List(cycles))) = (sizes, job.get("cycles"))
        else {
            continue;
        };
        let name = name_of(cycles, index);
        let Some(Value::Map(all)) = converted
            .get_mut("part")
            .and_then(|part| part.get_mut("sizes"))
        else {
            continue;
        };
        for (key, value) in sizes {
            let named = |known: &str| {
                known
                    .split_once('.')
                    .is_some_and(|(of, size)| of.eq_ignore_ascii_case(&name) && size == key)
            };
            if let Some((_, place)) = all.iter_mut().find(|(known, _)| named(known)) {
                *place = value;
            }
        }
    }
    converted.put("units", Value::Text(units.word().to_owned()));
    converted
}

/// Tolerances of results, except those of angles.
fn convert_tolerances(tolerances: Option<&mut Value>, to: Target) {
    let Some(Value::Map(entries)) = tolerances else {
        return;
    };
    for (key, given) in entries {
        let code = key.rsplit_once('.').map_or(key.as_str(), |(_, code)| code);
        let angle = ANGLES.iter().any(|angle| code.eq_ignore_ascii_case(angle));
        if let Some(Value::Text(text)) = given.get_mut("tolerance").filter(|_| !angle) {
            *text = tolerance::convert_of_result(text, |x| to.printed(x));
        }
        convert_fields(given.get_mut(WEAR.key), WEAR.fields, to);
    }
}

/// Codes of results that are angles, or their last parts.
const ANGLES: [&str; 2] = ["angle", "rotation"];

fn convert_fields(section: Option<&mut Value>, fields: &[Field], to: Target) {
    let Some(section) = section else { return };
    for field in fields {
        if let Some(value) = section
            .get_mut(field.key)
            .filter(|_| field.kind.is_metric())
        {
            match value {
                Value::Text(text) if field.size && tolerance::toleranced(text).is_some() => {
                    *text = tolerance::convert_size(text, |x| to.printed(x));
                }
                _ => convert(value, to),
            }
        }
    }
}

fn convert(value: &mut Value, to: Target) {
    match value {
        Value::Number(x) => *x = to.number(*x),
        Value::Text(text) => {
            let followed = dependencies::convert(text, |x| to.number(x));
            if let Some(converted) =
                followed.or_else(|| tolerance::convert(text, |x| to.printed(x)))
            {
                *text = converted;
            }
        }
        Value::List(items) => items.iter_mut().for_each(|item| convert(item, to)),
        Value::Null | Value::Flag(_) | Value::Map(_) | Value::Other(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::default_job;

    fn number(job: &Value, section: &str, key: &str) -> f64 {
        match job.get(section).and_then(|s| s.get(key)) {
            Some(Value::Number(x)) => *x,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_job_comes_back_as_it_was() {
        for def in cycle::CYCLES {
            let job = default_job(def.key).unwrap();
            let inch = convert_units(&job, "inch").unwrap();
            assert_eq!(number(&inch, "stylus", "diameter"), 0.23622);
            let back = convert_units(&inch, "mm").unwrap();
            assert_eq!(back, job, "{}", def.key);
            assert_eq!(convert_units(&job, "mm").unwrap(), job);
        }
        assert!(convert_units(&Value::Null, "cm").is_err());
        assert_eq!(convert_units(&Value::Null, "inch").unwrap(), Value::Null);
    }

    #[test]
    fn a_small_repeatability_comes_back_as_it_was() {
        for (mm, inch) in [
            (0.001, 0.00003937),
            (0.00025, 0.000009843),
            (0.0001, 0.000003937),
            (0.03, 0.001181),
        ] {
            let mut job = default_job("boss").unwrap();
            job.get_mut("stylus")
                .unwrap()
                .put("repeatability", Value::Number(mm));
            let converted = convert_units(&job, "inch").unwrap();
            assert_eq!(number(&converted, "stylus", "repeatability"), inch);
            assert_eq!(
                number(
                    &convert_units(&converted, "mm").unwrap(),
                    "stylus",
                    "repeatability"
                ),
                mm
            );
        }
    }

    #[test]
    fn values_with_tolerances_keep_their_size() {
        let mut job = default_job("probing-two-circles").unwrap();
        let cycle = job.get_mut("cycle").unwrap();
        cycle.put("diameter1", Value::Text("10H7".to_owned()));
        cycle.put("diameter2", Value::Text("20+0,05-0.02".to_owned()));
        cycle.put(
            "point1",
            Value::List(
                ["?10", "-30@-30.02", "no value"]
                    .map(|t| Value::Text(t.to_owned()))
                    .to_vec(),
            ),
        );
        let inch = convert_units(&job, "inch").unwrap();
        let text = |key: &str| inch.get("cycle").and_then(|c| c.get(key)).cloned().unwrap();
        assert_eq!(text("diameter1"), Value::Text("0.393701H7".to_owned()));
        assert_eq!(
            text("diameter2"),
            Value::Text("0.787402+0.001969-0.000787".to_owned())
        );
        let points = ["?0.393701", "-1.181102@-1.18189", "no value"]
            .map(|t| Value::Text(t.to_owned()))
            .to_vec();
        assert_eq!(text("point1"), Value::List(points));
        let back = convert_units(&inch, "mm").unwrap();
        assert_eq!(
            back.get("cycle").and_then(|c| c.get("diameter1")),
            Some(&Value::Text("10H7".to_owned()))
        );
    }
}
