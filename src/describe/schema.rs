//! The JSON Schema of a job, read from the one list of fields.
//!
//! It says what a job looks like. What depends on units or on several fields together only the check knows: so ranges of lengths
//! are left to it, but for their sign.

use crate::cycle::{CYCLES, CycleDef};
use crate::form::{Field, Kind, Value};
use crate::job::{FORMAT, SECTIONS};
use crate::num::decimal;
use crate::path::MAX_TOUCHES;

/// JSON Schema (2020-12) of a job.
pub fn job_schema() -> Value {
    let mut properties = vec![("format".to_owned(), map([("const", Value::Number(FORMAT))]))];
    for (path, fields) in SECTIONS {
        let own = fields.iter().map(|f| (f.key.to_owned(), field(f)));
        match *path {
            "" => properties.extend(own),
            "part" => {
                let sizes = map([("type", text("object")), ("additionalProperties", map([("type", text("number"))]))]);
                properties.push(("part".to_owned(), object(own.chain([("sizes".to_owned(), sizes)]), &[])));
            }
            "tool" => properties.push(("tool".to_owned(), object(own.chain([("frame".to_owned(), frame())]), &[]))),
            _ => properties.push(((*path).to_owned(), object(own, &[]))),
        }
    }
    let cycles = CYCLES.iter().map(|def| cycle(def)).collect();
    properties.push(("cycle".to_owned(), map([("oneOf", Value::List(cycles))])));
    let Value::Map(job) = object(properties, &["format", "cycle"]) else { unreachable!("an object is a map") };
    let head = [
        ("$schema".to_owned(), text("https://json-schema.org/draft/2020-12/schema")),
        ("$id".to_owned(), text(&format!("urn:touchpath:job:{}", decimal(FORMAT, 0)))),
        ("title".to_owned(), text("A probing job")),
    ];
    Value::Map(head.into_iter().chain(job).collect())
}

fn cycle(def: &CycleDef) -> Value {
    let mut properties = vec![("type".to_owned(), map([("const", text(def.key))]))];
    properties.extend(def.fields.iter().map(|f| (f.key.to_owned(), field(f))));
    for section in def.sections {
        let inner = object(section.fields.iter().map(|f| (f.key.to_owned(), field(f))), &[]);
        properties.push((section.key.to_owned(), if section.optional { nullable(inner) } else { inner }));
    }
    if def.place.is_some() {
        let touch =
            object([("point".to_owned(), triple("number")), ("vector".to_owned(), triple("number"))], &["point", "vector"]);
        let list = map([
            ("type", text("array")),
            ("items", touch),
            ("minItems", Value::Number(1.0)),
            ("maxItems", Value::Number(MAX_TOUCHES as f64)),
        ]);
        properties.push(("touches".to_owned(), nullable(list)));
    }
    if def.number.is_some() {
        let code = map([("type", text("integer")), ("minimum", Value::Number(1.0))]);
        let kind = map([("enum", Value::List(["Int", "Flt", "Bol"].map(text).to_vec()))]);
        let value = map([("type", Value::List(["number", "boolean"].map(text).to_vec()))]);
        let own = [("code".to_owned(), code), ("type".to_owned(), kind), ("value".to_owned(), value)];
        let list = map([("type", text("array")), ("items", object(own, &["code", "type", "value"]))]);
        properties.push(("custom".to_owned(), nullable(list)));
    }
    object(properties, &["type"])
}

fn field(field: &Field) -> Value {
    let number = |kind: &str| {
        let mut entries = vec![("type", text(kind))];
        match field.kind {
            Kind::Angle | Kind::Count => {
                entries.push(("minimum", Value::Number(field.hard.min)));
                entries.push(("maximum", Value::Number(field.hard.max)));
            }
            // A least size above 0 differs with the units, which the schema does not know: above 0 holds in both.
            _ if field.hard.min > 0.0 || (field.hard.above && field.hard.min == 0.0) => {
                entries.push(("exclusiveMinimum", Value::Number(0.0)))
            }
            _ if field.hard.min >= 0.0 => entries.push(("minimum", Value::Number(0.0))),
            _ => {}
        }
        map(entries)
    };
    let nominal = ["number", "string"].map(text).to_vec();
    let schema = match field.kind {
        Kind::Length | Kind::Feed | Kind::Angle => number("number"),
        Kind::Count => number("integer"),
        Kind::Flag => map([("type", text("boolean"))]),
        Kind::Choice(choices) => map([("enum", Value::List(choices.iter().map(|c| text(c.value)).collect()))]),
        Kind::Code(codes) => map([("enum", Value::List(codes.iter().map(|c| Value::Number(f64::from(c.value))).collect()))]),
        Kind::Text(longest) => map([("type", text("string")), ("maxLength", Value::Number(longest as f64))]),
        Kind::Point => triple("number"),
        Kind::Nominal => map([("type", Value::List(nominal))]),
        Kind::NominalPoint => three(map([("type", Value::List(nominal))])),
    };
    let Value::Map(mut entries) = (if field.null.is_some() { nullable(schema) } else { schema }) else {
        unreachable!("a schema is a map")
    };
    entries.push(("title".to_owned(), text(field.label)));
    entries.push(("description".to_owned(), text(field.help)));
    Value::Map(entries)
}

fn frame() -> Value {
    let axis = || map([("enum", Value::List(["X", "Y", "Z"].map(text).to_vec()))]);
    let turn = object([("rot".to_owned(), axis()), ("angle".to_owned(), map([("type", text("number"))]))], &["rot", "angle"]);
    let mirror = object([("mirror".to_owned(), axis())], &["mirror"]);
    map([("type", text("array")), ("items", map([("oneOf", Value::List(vec![turn, mirror]))]))])
}

fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

fn map<'a>(entries: impl IntoIterator<Item = (&'a str, Value)>) -> Value {
    Value::Map(entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect())
}

fn nullable(schema: Value) -> Value {
    map([("anyOf", Value::List(vec![schema, map([("type", text("null"))])]))])
}

fn triple(of: &str) -> Value {
    three(map([("type", text(of))]))
}

fn three(items: Value) -> Value {
    map([("type", text("array")), ("items", items), ("minItems", Value::Number(3.0)), ("maxItems", Value::Number(3.0))])
}

fn object(properties: impl IntoIterator<Item = (String, Value)>, required: &[&str]) -> Value {
    map([
        ("type", text("object")),
        ("properties", Value::Map(properties.into_iter().collect())),
        ("required", Value::List(required.iter().map(|key| text(key)).collect())),
        ("additionalProperties", Value::Flag(false)),
    ])
}
