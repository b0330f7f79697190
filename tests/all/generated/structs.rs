//! The TypeScript types of plans and other results, printed from the crate's structs with their doc comments.

use std::fmt::Write;
use std::path::Path;

use touchpath::control::safety::RULES;
use touchpath::form::CODES;
use touchpath::job::RESULT_CODES;

use syn::{Attribute, Expr, Fields, GenericArgument, Item, Lit, Meta, PathArguments, Type};

/// Files of the types, in the order in which they are printed.
const SOURCES: &[(&str, &[&str])] = &[
    ("src/form/finding.rs", &["Level", "Finding"]),
    (
        "src/job/rows.rs",
        &[
            "TouchPoint",
            "Arc",
            "Move",
            "ParameterValue",
            "ParameterRow",
            "ResultRow",
            "ResultWords",
            "ProofRow",
            "SafetyRow",
            "ProgramText",
            "DatumRow",
            "Plan",
        ],
    ),
    ("src/job/measure.rs", &["Measurement"]),
    ("src/control/trace.rs", &["Kind"]),
    ("src/import/program.rs", &["TraceMove", "TraceRow"]),
    (
        "src/describe/catalog.rs",
        &[
            "DefaultEntry",
            "ChoiceEntry",
            "WhenEntry",
            "FieldEntry",
            "CycleSectionEntry",
            "CycleEntry",
            "SectionEntry",
            "RelationEntry",
            "SupportEntry",
            "UsualLines",
            "PostEntry",
            "RuleEntry",
            "CodeGroup",
            "Catalog",
        ],
    ),
];

/// Types that TypeScript can state more exactly than the struct.
const EXACT: &[(&str, &str)] = &[
    (
        "Move.feed",
        r#""approach" | "longLink" | "work" | "retract" | "return" | "rapid""#,
    ),
    ("Move.kind", r#""position" | "touch" | "back""#),
    ("DatumRow.axis", r#""x" | "y" | "z" | "rotation""#),
    ("Finding.code", "FindingCode"),
    ("SafetyRow.rule", "RuleName"),
    ("ResultRow.code", "ResultCode"),
    ("ResultRow.verdict", "Verdict | null"),
    ("ResultRow.unit", r#""mm" | "inch" | "deg" | """#),
    (
        "ProgramText.writes",
        r#"("X" | "Y" | "Z" | "rotation" | "preset X" | "preset Y" | "preset Z" | "basic rotation" | "table offset")[]"#,
    ),
    ("TraceRow.units", r#""mm" | "inch" | null"#),
    ("ChoiceEntry.value", "string | number"),
    (
        "FieldEntry.kind",
        r#""number" | "count" | "flag" | "choice" | "code" | "text" | "point" | "nominal" | "nominalPoint" | "lines""#,
    ),
    (
        "FieldEntry.unit",
        r#""length" | "feed" | "acceleration" | "time" | "angle" | "none""#,
    ),
    ("CycleEntry.type", r#"Cycle["type"]"#),
    ("RelationEntry.type", r#"Relation["type"]"#),
    ("RelationEntry.results", "ResultCode[]"),
    ("SupportEntry.type", r#"Cycle["type"]"#),
    ("SupportEntry.form", r#""moves" | "cycle""#),
    ("PostEntry.id", "PostId"),
    ("Catalog.format", "1"),
];

const HEAD: &str =
    "// Generated from the crate's structs: `UPDATE=1 cargo test --lib generated` writes it.

import type { Cycle, PostId, Relation, Vec3 } from \"./job-types.js\";
import type { Message } from \"./said.js\";

/** A whole number. @asType integer */
export type Integer = number;
";

/// The verdict of the whole workpiece includes the reaction of the control.
const VERDICT: &str = r#"
/** Verdict of a tolerance or limit on a value. */
export type Judged =
  | "good"
  | "rework"
  | "scrap"
  | "undefined"
  | "implausible"
  | "good within ±"
  | "out"
  | "out within ±";

/** The verdict of a value, or of the whole workpiece (`Q183`), with the reaction of the control. */
export type Verdict = Judged | `${Judged}: ${string}`;
"#;

/// The file.
pub fn types() -> String {
    let mut text = HEAD.to_owned();
    names(
        &mut text,
        "Every code of a finding; docs/findings.md says what each means.",
        "FindingCode",
        CODES.iter().map(|c| c.0),
    );
    names(
        &mut text,
        "Every safety rule.",
        "RuleName",
        RULES.iter().map(|rule| rule.name),
    );
    names(
        &mut text,
        "Every code of a result.",
        "ResultCode",
        RESULT_CODES.iter().copied(),
    );
    text.push_str(VERDICT);
    for (path, names) in SOURCES {
        let source =
            std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
        let file = syn::parse_file(&source).unwrap();
        for name in *names {
            let item = file.items.iter().find(|item| {
                matches!(item, Item::Struct(s) if s.ident == name)
                    || matches!(item, Item::Enum(e) if e.ident == name)
            });
            match item.unwrap_or_else(|| panic!("{path} has no {name}")) {
                Item::Struct(item) => interface(&mut text, item),
                Item::Enum(item) => union(&mut text, item),
                _ => unreachable!("found as one of these"),
            }
        }
    }
    text
}

/// A type of words.
fn names<'a>(text: &mut String, about: &str, name: &str, words: impl Iterator<Item = &'a str>) {
    let words: String = words.map(|word| format!("\n  | \"{word}\"")).collect();
    write!(text, "\n/** {about} */\nexport type {name} ={words};\n").unwrap();
}

fn interface(text: &mut String, item: &syn::ItemStruct) {
    let name = item.ident.to_string();
    let camel = renames(&item.attrs).as_deref() == Some("camelCase");
    write!(
        text,
        "\n{}export interface {} {{\n",
        doc(&item.attrs, ""),
        exported(&name)
    )
    .unwrap();
    let Fields::Named(fields) = &item.fields else {
        panic!("{name} has named fields")
    };
    for field in &fields.named {
        let own = field.ident.as_ref().unwrap().to_string();
        let key =
            renamed(&field.attrs).unwrap_or_else(|| if camel { camel_case(&own) } else { own });
        let exact = EXACT
            .iter()
            .find(|(place, _)| *place == format!("{name}.{key}"));
        let own_type = || {
            if composed(&field.attrs) {
                "string".to_owned()
            } else {
                type_of(&field.ty)
            }
        };
        let kind = exact.map_or_else(own_type, |(_, exact)| (*exact).to_owned());
        writeln!(text, "{}  {key}: {kind};", doc(&field.attrs, "  ")).unwrap();
    }
    text.push_str("}\n");
}

fn union(text: &mut String, item: &syn::ItemEnum) {
    let lowercase = renames(&item.attrs).as_deref() == Some("lowercase");
    let variants = item.variants.iter().map(|variant| match &variant.fields {
        Fields::Unnamed(inner) => type_of(&inner.unnamed[0].ty),
        _ if lowercase => format!("\"{}\"", variant.ident.to_string().to_lowercase()),
        _ => "null".to_owned(),
    });
    let mut variants: Vec<String> = variants.collect();
    let mut seen = Vec::new();
    variants.retain(|v| {
        !seen.contains(v) && {
            seen.push(v.clone());
            true
        }
    });
    let own = item.ident.to_string();
    let name = exported(&own);
    write!(
        text,
        "\n{}export type {name} = {};\n",
        doc(&item.attrs, ""),
        variants.join(" | ")
    )
    .unwrap();
}

/// Names that are too general outside their module.
fn exported(name: &str) -> &str {
    if name == "Kind" { "TraceKind" } else { name }
}

fn type_of(ty: &Type) -> String {
    match ty {
        Type::Reference(reference) => type_of(&reference.elem),
        Type::Slice(slice) => format!("{}[]", grouped(type_of(&slice.elem))),
        Type::Array(array) => {
            let Expr::Lit(length) = &array.len else {
                panic!("a length is a number")
            };
            let Lit::Int(length) = &length.lit else {
                panic!("a length is a number")
            };
            let element = type_of(&array.elem);
            match (element.as_str(), length.base10_parse::<usize>().unwrap()) {
                ("number", 3) => "Vec3".to_owned(),
                (_, n) => format!("[{}]", vec![element; n].join(", ")),
            }
        }
        Type::Path(path) => {
            let last = path.path.segments.last().unwrap();
            let inner = || match &last.arguments {
                PathArguments::AngleBracketed(arguments) => match &arguments.args[0] {
                    GenericArgument::Type(ty) => type_of(ty),
                    _ => panic!("not a type that is known here"),
                },
                _ => panic!("not a type that is known here"),
            };
            match last.ident.to_string().as_str() {
                "f64" => "number".to_owned(),
                "usize" | "i32" | "u8" => "Integer".to_owned(),
                "bool" => "boolean".to_owned(),
                "String" | "str" => "string".to_owned(),
                "Text" => "Message".to_owned(),
                "Triple" => "Vec3".to_owned(),
                "Vec" => format!("{}[]", grouped(inner())),
                "Option" => format!("{} | null", inner()),
                other => exported(other).to_owned(),
            }
        }
        _ => panic!("a type without one in TypeScript"),
    }
}

fn grouped(ty: String) -> String {
    if ty.contains(" | ") {
        format!("({ty})")
    } else {
        ty
    }
}

fn doc(attributes: &[Attribute], indent: &str) -> String {
    let lines: Vec<String> = attributes
        .iter()
        .filter_map(|attribute| match &attribute.meta {
            Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
                Expr::Lit(text) => match &text.lit {
                    Lit::Str(text) => Some(text.value().trim().to_owned()),
                    _ => None,
                },
                _ => None,
            },
            _ => None,
        })
        .collect();
    // A link to an item of the crate becomes its name.
    let text = lines
        .join(" ")
        .replace("[`CODES`](crate::form::CODES)", "those in docs/findings.md");
    if text.is_empty() {
        String::new()
    } else {
        format!("{indent}/** {text} */\n")
    }
}

/// The value of `#[serde(rename = "…")]` or `#[serde(rename_all = "…")]`.
fn serde_value(attributes: &[Attribute], key: &str) -> Option<String> {
    let mut found = None;
    for attribute in attributes.iter().filter(|a| a.path().is_ident("serde")) {
        attribute
            .parse_nested_meta(|meta| {
                if let Ok(value) = meta.value() {
                    let value = value.parse::<syn::LitStr>()?.value();
                    found = if meta.path.is_ident(key) {
                        Some(value)
                    } else {
                        found.take()
                    };
                }
                Ok(())
            })
            .unwrap();
    }
    found
}

/// Whether JavaScript receives a text as a composed string.
fn composed(attributes: &[Attribute]) -> bool {
    serde_value(attributes, "serialize_with").is_some_and(|by| by == "in_english")
}

fn renames(attributes: &[Attribute]) -> Option<String> {
    serde_value(attributes, "rename_all")
}

fn renamed(attributes: &[Attribute]) -> Option<String> {
    serde_value(attributes, "rename")
}

fn camel_case(name: &str) -> String {
    let mut words = name.split('_');
    let first = words.next().unwrap().to_owned();
    words.fold(first, |text, word| {
        text + &word[..1].to_uppercase() + &word[1..]
    })
}
