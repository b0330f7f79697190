//! Changes a number of a job by dragging: a slightly larger value, and the value after a drag.

use crate::cycle;
use crate::form::{Field, Kind, Value};
use crate::job::sections::{self, Units};

/// A field of a job with a number.
#[derive(Clone, Copy, Debug)]
pub struct NumberField {
    field: &'static Field,
    units: Units,
    /// Its value in the job's units.
    pub value: f64,
}

impl NumberField {
    /// By its path, such as `cycle.width1`; in a set-up in the active cycle. `None` if no field with that path has a number.
    pub fn of(job: &Value, path: &str, hand: usize) -> Option<Self> {
        let (section, key) = path.split_once('.')?;
        let place = match job.get("cycles") {
            Some(Value::List(cycles)) if section == "cycle" => cycles.get(hand)?,
            _ => job.get(section)?,
        };
        let fields = match place.get("type") {
            Some(Value::Text(cycle)) if section == "cycle" => cycle::find(cycle)?.fields,
            _ => sections::section(section)?.fields,
        };
        let field = fields.iter().find(|field| field.key == key)?;
        match place.get(key)? {
            Value::Number(value) => Some(NumberField {
                field,
                units: Units::of(job),
                value: *value,
            }),
            _ => None,
        }
    }

    /// Change for a trial, in its units.
    pub fn little(&self) -> f64 {
        let least = match self.units {
            Units::Mm => 0.1,
            Units::Inch => 0.004,
        };
        (self.value.abs() * 0.01).max(least)
    }

    /// Value after a change: a multiple of the largest power of ten that is finer than a pixel, within the field's range.
    pub fn changed(&self, change: f64, pixels_a_unit: f64) -> f64 {
        let step = 10f64.powf((-pixels_a_unit.log10()).floor());
        let scale = match self.field.kind {
            Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Nominal => self.units.scale(),
            _ => 1.0,
        };
        let range = self.field.hard;
        let least = range.min / scale + if range.above { step } else { 0.0 };
        let value = crate::num::within(
            ((self.value + change) / step).round() * step,
            least,
            range.max / scale,
        );
        // Without rounding noise.
        (value * 1e6).round() / 1e6
    }
}

/// The job with another number in a field.
pub fn with_number(job: &Value, path: &str, hand: usize, number: f64) -> Value {
    let mut job = job.clone();
    let several = job.get("cycles").is_some();
    let entry = path.split('.').try_fold(&mut job, |place, key| {
        let key = if several && key == "cycle" {
            "cycles"
        } else {
            key
        };
        let Value::Map(entries) = place else {
            return None;
        };
        let (_, value) = entries.iter_mut().rev().find(|(k, _)| k == key)?;
        match value {
            Value::List(cycles) => cycles.get_mut(hand),
            value => Some(value),
        }
    });
    if let Some(entry) = entry {
        *entry = Value::Number(number);
    }
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(units: &str, width: &str) -> Value {
        let text =
            format!(r#"{{ "units": "{units}", "cycle": {{ "type": "web", "width": {width} }} }}"#);
        crate::job::from_json(&text).unwrap()
    }

    #[test]
    fn a_drag_gives_round_values_within_the_range_of_the_field() {
        let web = job("mm", "30");
        let width = NumberField::of(&web, "cycle.width", 0).unwrap();
        assert_eq!((width.value, width.little()), (30.0, 0.3));
        assert_eq!(width.changed(1.26, 4.0), 31.3);
        assert_eq!(width.changed(1.264, 40.0), 31.26);
        assert_eq!(width.changed(7.0, 0.4), 37.0);
        assert_eq!(width.changed(-99.0, 40.0), 0.001);
        let inch = job("inch", "0.1");
        let width = NumberField::of(&inch, "cycle.width", 0).unwrap();
        assert_eq!(width.little(), 0.004);
        assert_eq!(width.changed(1e9, 40.0), 393.700787);
    }

    #[test]
    fn only_a_number_of_a_known_field_is_dragged() {
        let web = job("mm", "\"30H7\"");
        for path in [
            "cycle.width",
            "cycle.depths",
            "cycle",
            "part.sizes.width",
            "nowhere.at",
            "",
        ] {
            assert!(NumberField::of(&web, path, 0).is_none(), "{path}");
        }
        assert_eq!(
            with_number(&job("mm", "30"), "cycle.width", 0, 31.0),
            job("mm", "31")
        );
    }
}
