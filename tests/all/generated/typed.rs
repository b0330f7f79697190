//! The Rust types of a job, printed from the one list of fields.

use std::collections::BTreeMap;
use std::fmt::Write;

use touchpath::cycle::CYCLES;
use touchpath::form::{Choice, Field, Kind, SubForm};
use touchpath::job::{FORMAT, SECTIONS};

const HEAD: &str = "// Generated from the crate's one list of fields: `UPDATE=1 cargo test --lib generated` writes it.

use std::collections::BTreeMap;

use super::{CustomCode, FrameStep, Given, Nominal, PickedTouch, map, of};
use crate::form::Value;
";

/// `internal-rectangle` or `workOffset` as the name of a type.
fn type_name(key: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    key.split('-').map(capital).collect()
}

/// `workOffset` as the name of a field.
fn field_name(key: &str) -> String {
    let mut name = String::new();
    for c in key.chars() {
        if c.is_ascii_uppercase() {
            name.push('_');
        }
        name.push(c.to_ascii_lowercase());
    }
    if matches!(name.as_str(), "return" | "type") { name + "_" } else { name }
}

/// How a type becomes a loose value.
fn given(name: &str, value: &str) -> String {
    format!("impl Given for {name} {{\n    fn given(&self) -> Value {{ {value} }}\n}}\n")
}

/// What is printed, and the enums of choices that it needs, by name.
#[derive(Default)]
struct Printed {
    text: String,
    choices: BTreeMap<String, &'static [Choice]>,
}

impl Printed {
    fn type_of(&mut self, field: &Field) -> String {
        let own = match field.kind {
            Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Time | Kind::Angle => "f64".to_owned(),
            Kind::Count | Kind::Code(_) => "i32".to_owned(),
            Kind::Flag => "bool".to_owned(),
            Kind::Text(_) => "String".to_owned(),
            Kind::Point => "[f64; 3]".to_owned(),
            Kind::Nominal => "Nominal".to_owned(),
            Kind::NominalPoint => "[Nominal; 3]".to_owned(),
            Kind::Choice(choices) => {
                let name = type_name(field.key);
                let values = |list: &[Choice]| list.iter().map(|choice| choice.value).collect::<Vec<_>>();
                let known = self.choices.insert(name.clone(), choices);
                assert!(known.is_none_or(|known| values(known) == values(choices)), "two choices are called {name}");
                name
            }
        };
        if field.null.is_some() { format!("Option<{own}>") } else { own }
    }

    /// A struct of these fields, with the entries that it has besides.
    fn form(&mut self, name: &str, about: &str, fields: &[Field], more: &[(&str, String, &str)]) {
        let mut members: Vec<(&str, String, String)> = Vec::new();
        for field in fields {
            let null = field.null.map(|means| format!(" `Some(None)`: {means}.")).unwrap_or_default();
            members.push((field.key, self.type_of(field), format!("{}{null}", field.help.trim())));
        }
        members.extend(more.iter().map(|(key, of, help)| (*key, of.clone(), (*help).to_owned())));
        let text = &mut self.text;
        writeln!(text, "\n/// {about}\n#[derive(Clone, Debug, Default, PartialEq)]\npub struct {name} {{").unwrap();
        for (key, of, help) in &members {
            writeln!(text, "    /// {help}\n    pub {}: Option<{of}>,", field_name(key)).unwrap();
        }
        let entries: Vec<String> =
            members.iter().map(|(key, ..)| format!("(\"{key}\", of(&self.{}))", field_name(key))).collect();
        write!(text, "}}\n\n{}", given(name, &format!("map([{}])", entries.join(", ")))).unwrap();
    }

    /// The type of a form inside a form, printed once.
    fn inner(&mut self, section: &SubForm, printed: &mut Vec<&'static str>) -> (&'static str, String, &'static str) {
        let name = type_name(section.key);
        if !printed.contains(&section.key) {
            printed.push(section.key);
            self.form(&name, &format!("What cycles have as `{}`.", section.key), section.fields, &[]);
        }
        if section.optional {
            (section.key, format!("Option<{name}>"), "`Some(None)`: none.")
        } else {
            (section.key, name, "Left out: the defaults.")
        }
    }
}

/// The whole file.
pub fn typed() -> String {
    let mut out = Printed { text: HEAD.to_owned(), ..Printed::default() };
    let mut printed = Vec::new();
    for def in CYCLES {
        let mut more: Vec<(&str, String, &str)> = Vec::new();
        for section in def.sections {
            let inner = out.inner(section, &mut printed);
            more.push(inner);
        }
        if def.place.is_some() {
            let help = "The Job Assignment's own picks: they replace the points that the dimensions give.";
            more.push(("touches", "Vec<PickedTouch>".to_owned(), help));
        }
        if def.number.is_some() {
            more.push(("custom", "Vec<CustomCode>".to_owned(), "Codes of the user's own."));
        }
        out.form(&type_name(def.key), &format!("{}: {}.", def.title, def.source), def.fields, &more);
    }
    let text = &mut out.text;
    text.push_str("\n/// A cycle with its dimensions.\n#[derive(Clone, Debug, PartialEq)]\npub enum Cycle {\n");
    for def in CYCLES {
        writeln!(text, "    /// {}.\n    {1}({1}),", def.title, type_name(def.key)).unwrap();
    }
    text.push_str("}\n\nimpl Given for Cycle {\n    fn given(&self) -> Value {\n        let (key, mut value) = match self {\n");
    for def in CYCLES {
        writeln!(text, "            Cycle::{}(cycle) => (\"{}\", cycle.given()),", type_name(def.key), def.key).unwrap();
    }
    text.push_str(
        "        };\n        if let Value::Map(entries) = &mut value {\n            entries.insert(0, (\"type\".to_owned(), Value::Text(key.to_owned())));\n        }\n        value\n    }\n}\n",
    );
    for def in CYCLES {
        let name = type_name(def.key);
        write!(text, "\nimpl From<{name}> for Cycle {{\n    fn from(cycle: {name}) -> Cycle {{ Cycle::{name}(cycle) }}\n}}\n")
            .unwrap();
    }
    let first = type_name(CYCLES[0].key);
    write!(
        text,
        "\nimpl Default for Cycle {{\n    fn default() -> Cycle {{\n        Cycle::{first}({first}::default())\n    }}\n}}\n"
    )
    .unwrap();
    job(&mut out);
    choices(&mut out);
    out.text
}

fn job(out: &mut Printed) {
    for (path, fields) in SECTIONS.iter().filter(|(path, _)| !path.is_empty()) {
        let more: &[(&str, String, &str)] = match *path {
            "tool" => &[("frame", "Vec<FrameStep>".to_owned(), "The active frame's steps, in order.")],
            "part" => {
                &[("sizes", "BTreeMap<String, f64>".to_owned(), "By how much a size of the part differs, by the field's key.")]
            }
            _ => &[],
        };
        out.form(&type_name(path), &format!("The section `{path}` of a job."), fields, more);
    }
    let (_, general) = SECTIONS.iter().find(|(path, _)| path.is_empty()).unwrap();
    let mut members = String::new();
    let mut entries = vec![format!("(\"format\", Some({FORMAT}.given()))")];
    for field in *general {
        let of = out.type_of(field);
        writeln!(members, "    /// {}\n    pub {}: Option<{of}>,", field.help.trim(), field_name(field.key)).unwrap();
        entries.push(format!("(\"{}\", of(&self.{}))", field.key, field_name(field.key)));
    }
    for (path, _) in SECTIONS.iter().filter(|(path, _)| !path.is_empty()) {
        writeln!(members, "    /// Left out: the defaults.\n    pub {}: Option<{}>,", field_name(path), type_name(path))
            .unwrap();
        entries.push(format!("(\"{path}\", of(&self.{}))", field_name(path)));
    }
    members.push_str("    /// What is probed.\n    pub cycle: Cycle,\n");
    entries.push("(\"cycle\", Some(self.cycle.given()))".to_owned());
    let map = given("Job", &format!("map([{}])", entries.join(", ")));
    let head = "/// A probing job.\n#[derive(Clone, Debug, Default, PartialEq)]\npub struct Job {";
    write!(out.text, "\n{head}\n{members}}}\n\n{map}").unwrap();
}

fn choices(out: &mut Printed) {
    for (name, choices) in std::mem::take(&mut out.choices) {
        let text = &mut out.text;
        writeln!(text, "\n/// One of a fixed set of words.\n#[derive(Clone, Copy, Debug, PartialEq, Eq)]\npub enum {name} {{")
            .unwrap();
        for choice in choices {
            writeln!(text, "    /// `{}`.\n    {},", choice.value, type_name(choice.value)).unwrap();
        }
        let words: Vec<String> =
            choices.iter().map(|choice| format!("{name}::{} => \"{}\"", type_name(choice.value), choice.value)).collect();
        write!(text, "}}\n\n{}", given(&name, &format!("Value::Text(match self {{ {} }}.to_owned())", words.join(", "))))
            .unwrap();
    }
}
