//! Generated files are committed, and this test finds them stale: `UPDATE=1 cargo test --lib generated` writes them.

mod controls;
mod layout;
mod macro_calls;
mod structs;
mod surface;
mod typescript;
mod words;

use std::fmt::Write;
use std::path::Path;

use crate::common::{job, with};
use touchpath::control::native::{Argument, SETS, Unit};
use touchpath::control::safety::RULES;
use touchpath::cycle::{CYCLES, CycleDef};
use touchpath::describe::catalog;
use touchpath::form::{CODES, Default, Field, Kind, Value};
use touchpath::formula::RELATIONS;
use touchpath::import::toolpath::{PROGRAM_POSTS, program_post_title};
use touchpath::job::{ParameterRow, ResultRow, default_job, plan, planned};
use touchpath::num::decimal;
use touchpath::view::scene::Projection;
use touchpath::view::{Legend, svg};

fn keep(path: &str, text: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("UPDATE").is_some() {
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(&file, text).unwrap();
    }
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(
        kept == text,
        "{path} is stale: run `UPDATE=1 cargo test --lib generated`"
    );
}

/// Contents of `touchpath explain`: the meaning of each finding, the requirement and reason of each rule.
fn codes_of_the_command() -> String {
    let quoted = |text: &str| serde_json::to_string(text).unwrap();
    let key = |name: &str| {
        if name.contains('-') {
            quoted(name)
        } else {
            name.to_owned()
        }
    };
    let mut text = "// Generated: UPDATE=1 cargo test --lib generated\n\n/** What each code of a finding means. */\nexport const CODES: Record<string, string> = {\n".to_owned();
    for (code, meaning) in CODES {
        writeln!(text, "  {}: {},", key(code), quoted(meaning)).unwrap();
    }
    text.push_str("};\n\n/** What each safety rule asks, and why. */\nexport const RULES: Record<string, readonly [string, string]> = {\n");
    for rule in RULES {
        writeln!(
            text,
            "  {}: [{}, {}],",
            key(rule.name),
            quoted(rule.requirement),
            quoted(rule.why)
        )
        .unwrap();
    }
    text + "};\n"
}

/// The table of calls, set by set. Accepted values of an argument, if known.
fn taken(argument: &Argument) -> String {
    argument
        .range_words()
        .map_or_else(String::new, |range| format!(" ({range})"))
}

fn calls_page() -> String {
    let mut page = "# Native cycles

What programs call, and what each argument means, as [programs you have](programs-you-have.md) are explained. Lengths are in the program's units, angles in degrees. *Recalled* is not verified on a control.
"
    .to_owned();
    for (set, calls) in SETS {
        writeln!(page, "\n## {set}\n\n| call | what | needs | arguments | mark | source |\n|---|---|---|---|---|---|").unwrap();
        for call in calls {
            let excludes = call
                .excludes
                .iter()
                .map(|(a, b)| format!("not {a} with {b}"));
            let needs: Vec<String> = call
                .needs
                .iter()
                .map(|names| names.replace(' ', " or "))
                .chain(excludes)
                .collect();
            // Notes on all calls of a set are below it.
            let own = if call.arguments.len() > 25 {
                "those below"
            } else {
                ""
            };
            let words: Vec<String> = call
                .arguments
                .iter()
                .map(|a| format!("{} {}{}", a.name, a.meaning, taken(a)))
                .collect();
            let words = if own.is_empty() {
                words.join("; ")
            } else {
                own.to_owned()
            };
            let shared = if call.shared.is_empty() {
                ""
            } else {
                "; and those below"
            };
            let needs = needs.join(", ");
            writeln!(
                page,
                "| `{}` | {} | {needs} | {words}{shared} | {} | {} |",
                call.name,
                call.title,
                call.mark.word(),
                call.source
            )
            .unwrap();
        }
        let common = calls
            .iter()
            .find_map(|call| match (call.shared, call.arguments) {
                ([], all) if all.len() > 25 => Some(all),
                ([], _) => None,
                (shared, _) => Some(shared),
            });
        if let Some(common) = common {
            page.push_str("\n| argument | meaning | unit |\n|---|---|---|\n");
            for argument in common {
                let unit = if argument.unit == Unit::None {
                    ""
                } else {
                    argument.unit.word()
                };
                writeln!(
                    page,
                    "| {} | {}{} | {unit} |",
                    argument.name,
                    argument.meaning,
                    taken(argument)
                )
                .unwrap();
            }
        }
    }
    page
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
        Kind::Acceleration => "mm/s²",
        Kind::Time => "ms",
        Kind::Angle => "°",
        Kind::Count
        | Kind::Code(_)
        | Kind::Flag
        | Kind::Choice(_)
        | Kind::Text(_)
        | Kind::Lines(_) => "",
    }
}

fn range(field: &Field) -> String {
    match field.kind {
        Kind::Flag | Kind::Choice(_) | Kind::Text(_) | Kind::Lines(_) => String::new(),
        Kind::Code(codes) => codes
            .iter()
            .map(|c| format!("{} {}", c.value, c.label))
            .collect::<Vec<_>>()
            .join("; "),
        Kind::Length
        | Kind::Feed
        | Kind::Acceleration
        | Kind::Time
        | Kind::Angle
        | Kind::Count
        | Kind::Point
        | Kind::Nominal
        | Kind::NominalPoint => {
            let from = if field.hard.above { "above" } else { "from" };
            format!(
                "{from} {} to {}",
                decimal(field.hard.min, 4),
                decimal(field.hard.max, 4)
            )
        }
    }
}

/// The default job in the isometric view: the same scene as on the page, with numbers on the touches.
fn picture(def: &CycleDef) -> Option<String> {
    let planned = planned(&default_job(def.key).unwrap()).unwrap();
    if planned.path.moves.is_empty() {
        return None;
    }
    let title = format!("{}: the path of the default job", def.title);
    let picture = planned.picture(Projection::Isometric, 1.0, None);
    let legend = Legend {
        title: &title,
        names: &picture.names,
        deviates: false,
    };
    Some(svg(&picture.scene, &legend))
}

/// The set-ups of `examples/set-ups` as in `docs/set-ups.md`: on the nominal part.
fn set_up_pictures() -> Vec<(&'static str, String)> {
    let examples = [
        (
            "vise",
            include_str!("../../examples/set-ups/vise.json"),
            "A vise: top, bore and a side",
        ),
        (
            "two-holes",
            include_str!("../../examples/set-ups/two-holes.json"),
            "A fixture: plate and two holes",
        ),
        (
            "first-article",
            include_str!("../../examples/set-ups/first-article.json"),
            "Five sizes: bore, stud, pocket and rib",
        ),
    ];
    let picture = |(name, text, title)| {
        let nominal = with(&job(text), "part", Value::Map(Vec::new()));
        let picture = planned(&nominal)
            .unwrap()
            .picture(Projection::Isometric, 1.0, None);
        (
            name,
            svg(
                &picture.scene,
                &Legend {
                    title,
                    names: &picture.names,
                    deviates: false,
                },
            ),
        )
    };
    examples.into_iter().map(picture).collect()
}

/// Codes of the fields with this prefix: the axes of a point have one each.
fn codes_of(rows: &[ParameterRow], field: &str) -> String {
    let axes = rows
        .iter()
        .filter(|row| row.field.as_deref().is_some_and(|of| of.starts_with(field)));
    axes.map(|row| format!("`{}`", row.code))
        .collect::<Vec<_>>()
        .join(", ")
}

fn manual(def: &CycleDef) -> String {
    let mut page = format!(
        "# {}\n\n{} {}. In a job: `\"type\": \"{}\"`.\n\n",
        def.title, def.summary, def.source, def.key
    );
    if def.steps.is_empty() {
        page.push_str("Rows of the parameter table; nothing moves.\n");
    } else {
        let legend = "Green: approach and return. Grey: links. Red: touches. Blue: the ball at its contacts.";
        write!(
            page,
            "![The path of the default job]({}.svg)\n\n{legend}\n\n",
            def.key
        )
        .unwrap();
        page.push_str("## Steps\n\nThe documented steps, in our words. A move's `step` is a number of this list.\n\n");
    }
    for (i, step) in def.steps.iter().enumerate() {
        writeln!(page, "{}. {step}.", i + 1).unwrap();
    }
    let default = plan(&default_job(def.key).unwrap()).unwrap();
    let rows = planned(&default_job(def.key).unwrap()).unwrap().table();
    page.push_str(
        "\n## Fields\n\nLengths are in the job's units; ranges and defaults are given in mm.\n\n",
    );
    page.push_str("| key | name | unit | range | default | code | what it does |\n|---|---|---|---|---|---|---|\n");
    let sections = def.sections.iter().flat_map(|s| {
        s.fields
            .iter()
            .map(move |f| (format!("{}.{}", s.key, f.key), f))
    });
    for (key, field) in def
        .fields
        .iter()
        .map(|f| (f.key.to_owned(), f))
        .chain(sections)
    {
        let of_axes = codes_of(&rows, &format!("cycle.{key}["));
        // A field without a code of the source is our own way to place the touches.
        let code = if field.code.is_empty() && def.number.is_some() {
            "ours".to_owned()
        } else if !of_axes.is_empty() {
            of_axes
        } else if field.code.is_empty() {
            String::new()
        } else {
            format!("`{}`", field.code)
        };
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
    if def.place.is_some() {
        page.push_str(
            "\nBesides these: `touches`, a list of `{ \"point\": [X, Y, Z], \"vector\": [i, j, k] }`, are the Job Assignment's own picks, codes \
             -200 and following; they replace the points that the dimensions give. `custom`, a list of `{ \"code\", \"type\", \"value\" }`, are \
             the user's own positive codes.\n",
        );
    }
    let mut results: Vec<(ResultRow, String)> = default
        .results
        .into_iter()
        .map(|row| (row, String::new()))
        .collect();
    // Fields of a form inside the form.
    for section in def.sections.iter().filter(|section| section.optional) {
        let own = with(
            &default_job(def.key).unwrap(),
            &format!("cycle.{}", section.key),
            Value::Map(Vec::new()),
        );
        // If a native cycle does not support it, a program of moves does.
        let moves = with(
            &own,
            "control",
            job(r#"{ "post": "linuxcnc", "form": "moves" }"#),
        );
        for row in plan(&own).or_else(|_| plan(&moves)).unwrap().results {
            if results.iter().all(|(known, _)| known.code != row.code) {
                results.push((row, format!(" (only with `{}`)", section.key)));
            }
        }
    }
    page.push_str("\n## Results\n\n");
    page.push_str(if results.is_empty() {
        "None: nothing is measured.\n"
    } else {
        "| code | unit | what it is |\n|---|---|---|\n"
    });
    for (row, only) in &results {
        writeln!(
            page,
            "| `{}` | {} | {}{only} |",
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
    for reading in def.interpretations {
        writeln!(page, "- {reading}").unwrap();
    }
    page.push_str("\n<!-- Generated from the crate: `UPDATE=1 cargo test --lib generated`. -->\n");
    page
}

#[test]
fn the_manual_is_what_the_crate_says() {
    for def in CYCLES {
        keep(&def.doc(), &manual(def));
        if let Some(picture) = picture(def) {
            keep(&def.doc().replace(".md", ".svg"), &picture);
        }
    }
    assert_eq!(catalog().cycles.len(), CYCLES.len());
}

#[test]
fn the_pictures_of_the_set_ups_are_those_of_the_crate() {
    for (name, picture) in set_up_pictures() {
        keep(&format!("docs/set-ups/{name}.svg"), &picture);
    }
}

#[test]
fn the_manual_has_every_kind_of_relation() {
    const HEAD: &str = "| `type` | `of` | results |\n|---|---|---|\n";
    let page =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/set-ups.md"))
            .unwrap();
    let (before, rest) = page.split_once(HEAD).expect("a table of relations");
    let (_, after) = rest.split_once("\n\n").expect("text after the table");
    let rows: Vec<String> = RELATIONS.iter().map(typescript::relation_row).collect();
    keep(
        "docs/set-ups.md",
        &format!("{before}{HEAD}{}\n\n{after}", rows.join("\n")),
    );
}

#[test]
fn the_layout_of_the_border_is_that_of_the_crate() {
    keep("www/core/layout.ts", &layout::layout());
    let posts: String = PROGRAM_POSTS
        .iter()
        .map(|post| format!("  \"{post}\",\n"))
        .collect();
    let titles: String = PROGRAM_POSTS
        .iter()
        .map(|post| {
            format!(
                "  {post}: \"{}\",\n",
                program_post_title(post).expect("a name")
            )
        })
        .collect();
    let text = format!(
        "// Generated by tests/all/generated.rs: not edited by hand.\n\n/** The controls that a program can be read for. */\nexport const PROGRAM_POSTS = [\n{posts}] as const;\n\n/** Their names. */\nexport const PROGRAM_POST_TITLES: Record<\n  (typeof PROGRAM_POSTS)[number],\n  string\n> = {{\n{titles}}};\n"
    );
    keep("www/core/program-posts.ts", &text);
}

#[test]
fn the_types_of_a_job_are_those_of_the_crate() {
    keep("www/core/job-types.ts", &typescript::job_types());
}

#[test]
fn the_public_names_of_the_crate_change_in_sight() {
    let names = surface::surface();
    assert!(
        names.lines().count() > 60 && names.contains("touchpath::job::plan fn\n"),
        "{names}"
    );
    keep("tests/snapshots/public.txt", &names);
}

#[test]
fn every_code_of_a_finding_is_listed() {
    // A code that nothing reports must not stay in the list.
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut sources = String::new();
    let mut folders = vec![src.clone()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path != src.join("form/codes.rs") {
                sources.push_str(&std::fs::read_to_string(&path).unwrap());
            }
        }
    }
    let mut text = "# Findings\n\n<!-- generated: UPDATE=1 cargo test --lib generated -->\n\nEvery finding has a level, a code, a path and a message. The \
        codes below are stable; the message says the numbers, and the path where in the job.\n\n| code | meaning |\n|---|---|\n"
        .to_owned();
    assert!(CODES.is_sorted_by_key(|(code, _)| *code));
    // Some are reported by the package, the element or the command.
    let mut reporting = sources.clone();
    for file in [
        "www/core/api.ts",
        "www/host-inputs.ts",
        "www/core/cli/tasks.ts",
    ] {
        reporting.push_str(
            &std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap(),
        );
    }
    for (code, meaning) in CODES {
        assert!(
            reporting.contains(&format!("\"{code}\"")),
            "nothing reports {code}"
        );
        writeln!(text, "| `{code}` | {meaning} |").unwrap();
    }
    keep("docs/findings.md", &text);
    keep("www/core/cli/codes.ts", &codes_of_the_command());
    // Also those that no test reaches.
    let is_code = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    for report in [".error(", ".warning(", ".info("] {
        for (at, _) in sources.match_indices(report) {
            let Some(rest) = sources[at + report.len()..].trim_start().strip_prefix('"') else {
                continue;
            };
            let code: String = rest.chars().take_while(|c| is_code(*c)).collect();
            assert!(
                CODES.iter().any(|(listed, _)| *listed == code),
                "{code} is not listed"
            );
        }
    }
}

#[test]
fn the_types_of_what_comes_out_are_those_of_the_crate() {
    keep("www/core/plan-types.ts", &structs::types());
}

#[test]
fn every_text_that_needs_words_is_listed() {
    keep("www/words/core.json", &words::words());
}

#[test]
fn the_matrix_of_controls_is_that_of_the_crate() {
    keep("docs/controls.md", &controls::page());
    keep("docs/calls.md", &calls_page());
    keep("docs/table-to-calls.md", &macro_calls::page());
}
