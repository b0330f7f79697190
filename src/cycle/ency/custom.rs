//! Custom codes: positive numbers with a meaning in the user's postprocessor only. They go into the table unchanged.

use crate::form::{Section, Value};
use crate::path::{Accessor, Parameter, ParameterValue};
use crate::text::text;

/// Largest number of custom codes in a cycle.
pub const MOST: usize = 200;
/// Highest custom code.
pub const HIGHEST: f64 = 1e6;

/// A custom code, added to the table unchanged.
#[derive(Clone, Debug)]
pub struct Custom {
    code: i32,
    accessor: Accessor,
    value: ParameterValue,
}

impl Custom {
    /// The row in the table. Numbers are not converted, because their unit is unknown.
    pub fn row(&self) -> Parameter {
        Parameter {
            code: self.code,
            accessor: self.accessor,
            type_name: match self.accessor {
                Accessor::Int => "Integer",
                Accessor::Bol => "Boolean",
                Accessor::Flt | Accessor::Q => "Double",
            },
            value: self.value.clone(),
            meaning: text!("Custom code"),
            field: Some("cycle.custom".to_owned()),
            touch: None,
        }
    }
}

/// Reads `custom`: a list of `{ code, type, value }`, each code once. Reports every problem.
pub fn read(section: &mut Section<'_, '_>) -> Vec<Custom> {
    let place = section.at("custom");
    let items = match section.get("custom") {
        None | Some(Value::Null) => return Vec::new(),
        Some(Value::List(items)) if items.len() <= MOST => items,
        Some(_) => {
            let message = text!(
                "custom must be a list of at most {most} codes { code, type, value }",
                MOST
            );
            section.checker.error("wrong-type", place, message);
            return Vec::new();
        }
    };
    let mut codes: Vec<Custom> = Vec::new();
    for (i, item) in items.iter().enumerate() {
        let path = format!("{place}[{i}]");
        if let Value::Map(entries) = item {
            for (key, _) in entries
                .iter()
                .filter(|(key, _)| !matches!(key.as_str(), "code" | "type" | "value"))
            {
                let message = text!(
                    "A custom code has only code, type and value, no \"{key}\"",
                    crate::form::printable(key)
                );
                section.checker.error(
                    "unknown-key",
                    format!("{path}.{}", crate::form::printable(key)),
                    message,
                );
            }
        }
        let code = match item.get("code") {
            Some(Value::Number(n)) if n.fract() == 0.0 && (1.0..=HIGHEST).contains(n) => *n as i32,
            _ => {
                let message = text!(
                    "A custom code is a whole number from 1 to 1000000: negative ones are the system's"
                );
                section
                    .checker
                    .error("wrong-code", format!("{path}.code"), message);
                continue;
            }
        };
        let accessor = match item.get("type") {
            Some(Value::Text(word)) => Accessor::CMD_PRM.into_iter().find(|a| a.word() == word),
            _ => None,
        };
        let value = match (accessor, item.get("value")) {
            (Some(Accessor::Int), Some(Value::Number(n)))
                if n.fract() == 0.0 && n.abs() <= f64::from(i32::MAX) =>
            {
                ParameterValue::Whole(*n as i32)
            }
            (Some(Accessor::Flt), Some(Value::Number(x))) if x.is_finite() => {
                ParameterValue::Number(*x)
            }
            (Some(Accessor::Bol), Some(Value::Flag(on))) => ParameterValue::Flag(*on),
            _ => {
                let message = text!(
                    "A custom code has a type (Int, Flt or Bol) and a matching value: a whole number, a number, true or false"
                );
                section.checker.error("wrong-type", path, message);
                continue;
            }
        };
        if codes.iter().any(|c| c.code == code) {
            section.checker.error(
                "code-twice",
                format!("{path}.code"),
                text!("Code {code} is there twice", code),
            );
            continue;
        }
        codes.push(Custom {
            code,
            accessor: accessor.unwrap_or(Accessor::Flt),
            value,
        });
    }
    codes
}
