//! Choices that a config allows, and parts that the page hides.

use crate::config::list::{list_of, some_of};
use crate::control::{POSTS, ProgramForm};
use crate::cycle::CYCLES;
use crate::form::{Checker, Field, Section, Value, form};
use crate::job::Units;
use crate::text::text;

/// Panels of the page.
const PANELS: [&str; 6] = ["form", "stage", "program", "table", "results", "checks"];

form! {
    struct AllowForm {
        set_ups: bool = Field::flag("setUps", "setUps", true),
    }
}

/// Allowed choices. `None` is no limit.
#[derive(Debug)]
pub struct Allow {
    pub cycles: Option<Vec<String>>,
    pub controls: Option<Vec<String>>,
    pub forms: Option<Vec<String>>,
    pub units: Option<Vec<String>>,
    /// Numbers from 1. `None` in the list means: measure only.
    pub work_offsets: Option<Vec<Option<f64>>>,
    /// Whether a job may have several cycles.
    pub set_ups: bool,
}

impl Allow {
    pub fn read(checker: &mut Checker, value: Option<&Value>) -> Allow {
        let mut section = Section::new(checker, value, "allow");
        section.only(
            AllowForm::FIELDS,
            &["cycles", "controls", "forms", "units", "workOffsets"],
        );
        let AllowForm { set_ups } = AllowForm::read(&mut section);
        let get = |key: &str| value.and_then(|value| value.get(key));
        let word = |words: &[&str]| words.join(", ");
        let mut words = |key: &str, known: &[&str]| {
            let one = |item: &Value| match item {
                Value::Text(word) if known.contains(&word.as_str()) => Some(word.clone()),
                _ => None,
            };
            some_of(
                checker,
                get(key),
                &format!("allow.{key}"),
                &word(known),
                one,
            )
        };
        let (cycles, controls) = (words("cycles", &cycles()), words("controls", &controls()));
        let forms = words("forms", &ProgramForm::ALL.map(ProgramForm::word));
        let units = words("units", &[Units::Mm.word(), Units::Inch.word()]);
        let work_offset = |item: &Value| match item {
            Value::Null => Some(None),
            Value::Number(n) if n.fract() == 0.0 && (1.0..=105.0).contains(n) => Some(Some(*n)),
            _ => None,
        };
        let numbers = "1 to 105, null";
        let work_offsets = some_of(
            checker,
            get("workOffsets"),
            "allow.workOffsets",
            numbers,
            work_offset,
        );
        Allow {
            cycles,
            controls,
            forms,
            units,
            work_offsets,
            set_ups,
        }
    }

    /// Whether a job may have this value under a key of its control: `post`, `form` or `workOffset`.
    pub fn takes(&self, key: &str, value: &Value) -> bool {
        let words = match key {
            "post" => &self.controls,
            "form" => &self.forms,
            _ => {
                let number = if let Value::Number(n) = value {
                    Some(*n)
                } else {
                    None
                };
                return self
                    .work_offsets
                    .as_ref()
                    .is_none_or(|all| all.contains(&number));
            }
        };
        words
            .as_ref()
            .is_none_or(|all| all.iter().any(|word| *value == Value::Text(word.clone())))
    }

    /// Reports values for a job's control that a config fills in, or gives a machine, without allowing them.
    pub fn check_choices(&self, checker: &mut Checker, config: &Value) {
        for key in ["post", "form", "workOffset"] {
            let path = format!("control.{key}");
            let refused =
                |value: Option<&Value>| value.is_some_and(|value| !self.takes(key, value));
            let rule = config.get("fields").and_then(|fields| fields.get(&path));
            if refused(rule.and_then(|rule| rule.get("value"))) {
                report(checker, format!("fields.{path}.value"));
            }
            let Some(Value::List(machines)) = config.get("machines") else {
                continue;
            };
            for (i, machine) in machines.iter().enumerate() {
                if refused(machine.get("control").and_then(|control| control.get(key))) {
                    report(checker, format!("machines[{i}].{path}"));
                }
            }
        }
    }
}

fn report(checker: &mut Checker, path: String) {
    checker.error("not-allowed", path, text!("allow does not list this value"));
}

/// Checks the hidden parts. No job is refused for them.
pub fn check_hide(checker: &mut Checker, value: Option<&Value>) {
    Section::new(checker, value, "hide").only(&[], &["cycles", "controls", "panels"]);
    for (key, known) in [
        ("cycles", cycles()),
        ("controls", controls()),
        ("panels", PANELS.to_vec()),
    ] {
        let one = |item: &Value| {
            matches!(item, Value::Text(word) if known.contains(&word.as_str())).then_some(())
        };
        list_of(
            checker,
            value.and_then(|value| value.get(key)),
            &format!("hide.{key}"),
            &known.join(", "),
            one,
        );
    }
}

fn cycles() -> Vec<&'static str> {
    CYCLES.iter().map(|def| def.key).collect()
}

fn controls() -> Vec<&'static str> {
    POSTS.iter().map(|post| post.key).collect()
}
