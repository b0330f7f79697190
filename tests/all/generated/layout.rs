//! The JavaScript side of packed data, from the crate's own lists.

use std::fmt::Write;

use touchpath::border::coded::{DEEPEST, MOST_VALUES, OTHERS, TAGS};
use touchpath::border::packed::{FEEDS, KINDS, LEVELS, ROWS, Section, UNITS};
use touchpath::job::LONGEST_TEXT;

const HEAD: &str = "// Generated from src/border: `UPDATE=1 cargo test --lib generated` writes it. How jobs and plans cross to the module and back.
import type { Unpacked } from \"./unpacked.js\";
";

/// `moveLines` of `move_lines`; the last name of `said.meaning`.
fn property(field: &str) -> String {
    let name = field.rsplit('.').next().unwrap().trim();
    let mut parts = name.split('_');
    let first = parts.next().unwrap().to_owned();
    parts.fold(first, |name, part| {
        name + &part[..1].to_uppercase() + &part[1..]
    })
}

/// A list as the formatter prints it: on one line up to 120 characters.
fn listed(before: &str, items: &[String], brackets: (&str, &str), blank: &str) -> String {
    let (open, close) = brackets;
    let one = format!("{before}{open}{blank}{}{blank}{close};\n", items.join(", "));
    if one.len() <= 121 {
        one
    } else {
        format!("{before}{open}\n  {},\n{close};\n", items.join(",\n  "))
    }
}

fn words(text: &mut String, name: &str, words: &[String]) {
    let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    let list = listed(&format!("export const {name} = "), &words, ("[", "]"), "");
    text.push_str(&list.replace("];", "] as const;"));
}

fn numbered(text: &mut String, names: impl Iterator<Item = String>) {
    names
        .enumerate()
        .for_each(|(n, name)| writeln!(text, "export const {name} = {n};").unwrap());
}

pub fn layout() -> String {
    let mut text = HEAD.to_owned();
    text.push_str("\n/** Maximum number of values in a job, their maximum depth, and the maximum length of all its texts together in UTF-16 units. */\n");
    for (name, most) in [
        ("MOST_VALUES", MOST_VALUES),
        ("DEEPEST", DEEPEST),
        ("MOST_TEXT", LONGEST_TEXT),
    ] {
        writeln!(text, "export const {name} = {most};").unwrap();
    }
    text.push_str("\n/** Tags of values. */\n");
    numbered(
        &mut text,
        TAGS.iter().map(|tag| format!("{tag:?}").to_uppercase()),
    );
    text.push_str("\n/** Kinds of values that a job cannot have. */\n");
    numbered(&mut text, OTHERS.iter().map(|(name, _)| (*name).to_owned()));
    text.push_str("\n/** Sections of a plan. */\n");
    numbered(
        &mut text,
        Section::ALL
            .iter()
            .map(|section| format!("{section:?}").to_uppercase()),
    );
    writeln!(text, "export const SECTIONS = {};", Section::ALL.len()).unwrap();
    text.push_str("\n/** Words that are passed as their index in these lists. */\n");
    let owned = |list: &[&str]| {
        list.iter()
            .map(|word| (*word).to_owned())
            .collect::<Vec<_>>()
    };
    words(&mut text, "FEEDS", &owned(&FEEDS));
    words(&mut text, "KINDS", &owned(&KINDS));
    words(&mut text, "UNITS", &owned(&UNITS));
    let level = |level| {
        serde_json::to_string(&level)
            .unwrap()
            .trim_matches('"')
            .to_owned()
    };
    words(&mut text, "LEVELS", &LEVELS.map(level));
    text.push_str("\n/** Rows of a plan, field by field. */\n");
    for (name, fields) in ROWS {
        let fields: Vec<String> = fields
            .iter()
            .map(|(field, how, list)| {
                let (how, list) = if *how == "level" {
                    ("word", "LEVELS")
                } else {
                    (*how, *list)
                };
                format!("{}: r.{}({list})", property(field), property(how))
            })
            .collect();
        text.push_str(&listed(
            &format!("export const {name} = (r: Unpacked) => ("),
            &fields,
            ("{", "})"),
            " ",
        ));
    }
    text
}

#[test]
fn every_section_tag_and_level_is_at_its_place() {
    assert!(TAGS.iter().enumerate().all(|(at, tag)| *tag as usize == at));
    assert!(
        Section::ALL
            .iter()
            .enumerate()
            .all(|(at, section)| *section as usize == at)
    );
    assert!(
        LEVELS
            .iter()
            .enumerate()
            .all(|(at, level)| *level as usize == at)
    );
}
