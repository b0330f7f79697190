//! Generated files are committed, and this test finds them stale: `UPDATE=1 cargo test --test generated` writes them.
#![cfg(not(target_arch = "wasm32"))]

use std::fmt::Write;
use std::path::Path;

use touchpath::cycle::{CYCLES, CycleDef};
use touchpath::job::{catalog, default_job, plan};
use touchpath::num::decimal;
use touchpath::spec::{Default, Field, Kind};

fn keep(path: &str, text: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("UPDATE").is_some() {
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(&file, text).unwrap();
    }
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(kept == text, "{path} is stale: run `UPDATE=1 cargo test --test generated`");
}

fn value(field: &Field) -> String {
    match field.default {
        Default::Number(x) => decimal(x, 4),
        Default::Flag(b) => b.to_string(),
        Default::Text(t) => format!("`{t}`"),
        Default::Point(p) => p.map(|x| decimal(x, 4)).join(", "),
        Default::Null => "null".to_owned(),
    }
}

fn unit(field: &Field) -> &'static str {
    match field.kind {
        Kind::Length | Kind::Point | Kind::Nominal | Kind::NominalPoint => "mm",
        Kind::Feed => "mm/min",
        Kind::Angle => "°",
        Kind::Count | Kind::Code(_) | Kind::Flag | Kind::Choice(_) | Kind::Text(_) => "",
    }
}

fn range(field: &Field) -> String {
    match field.kind {
        Kind::Flag | Kind::Choice(_) | Kind::Text(_) => String::new(),
        Kind::Code(codes) => codes.iter().map(|c| format!("{} {}", c.value, c.label)).collect::<Vec<_>>().join("; "),
        Kind::Length | Kind::Feed | Kind::Angle | Kind::Count | Kind::Point | Kind::Nominal | Kind::NominalPoint => {
            let from = if field.hard.above { "above" } else { "from" };
            format!("{from} {} to {}", decimal(field.hard.min, 4), decimal(field.hard.max, 4))
        }
    }
}

fn manual(def: &CycleDef) -> String {
    let mut page = format!("# {}\n\n{}. In a job: `\"type\": \"{}\"`.\n\n", def.title, def.source, def.key);
    page.push_str("## Steps\n\nThe documented steps, in our words. A move's `step` is a number of this list.\n\n");
    for (i, step) in def.steps.iter().enumerate() {
        writeln!(page, "{}. {step}.", i + 1).unwrap();
    }
    page.push_str("\n## Fields\n\nLengths are in the job's units; ranges and defaults are given in mm.\n\n");
    page.push_str("| key | name | unit | range | default | code | what it does |\n|---|---|---|---|---|---|---|\n");
    let sections = def.sections.iter().flat_map(|s| s.fields.iter().map(move |f| (format!("{}.{}", s.key, f.key), f)));
    for (key, field) in def.fields.iter().map(|f| (f.key.to_owned(), f)).chain(sections) {
        let code = if field.code.is_empty() { String::new() } else { format!("`{}`", field.code) };
        writeln!(
            page,
            "| `{key}` | {} | {} | {} | {} | {code} | {} |",
            field.label,
            unit(field),
            range(field),
            value(field),
            field.help
        )
        .unwrap();
    }
    page.push_str("\n## Results\n\n| code | unit | what it is |\n|---|---|---|\n");
    for row in &plan(&default_job(def.key).unwrap()).unwrap().results {
        writeln!(
            page,
            "| `{}` | {} | {} |",
            row.code,
            match row.unit {
                "deg" => "°",
                unit => unit,
            },
            row.meaning
        )
        .unwrap();
    }
    page.push_str("\n## Our reading\n\nThe source does not say these; they are ours.\n\n");
    for reading in def.readings {
        writeln!(page, "- {reading}").unwrap();
    }
    page.push_str("\n<!-- Generated from the crate: `UPDATE=1 cargo test --test generated`. -->\n");
    page
}

#[test]
fn the_manual_is_what_the_crate_says() {
    for def in CYCLES {
        keep(def.doc, &manual(def));
    }
    assert_eq!(catalog().cycles.len(), CYCLES.len());
}
