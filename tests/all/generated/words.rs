//! Every text of the crate, as a list for the translations.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use touchpath::describe::{FieldEntry, catalog};

/// The file: a JSON list of English templates.
pub fn words() -> String {
    let mut found = BTreeSet::new();
    scan(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("src"),
        &mut found,
    );
    let listed = found.len();
    assert!(listed > 300, "{listed} texts are marked in the sources");
    described(&mut found);
    assert!(found.len() > listed + 300);
    let said = found.into_iter().filter(|text| has_words(text));
    let lines: Vec<String> = said
        .map(|text| format!("  {}", serde_json::to_string(&text).unwrap()))
        .collect();
    format!("[\n{}\n]\n", lines.join(",\n"))
}

/// Whether a text has words: braces, numbers, codes and single letters are the same in every language.
fn has_words(template: &str) -> bool {
    let outside: String = template
        .split('{')
        .map(|piece| piece.split_once('}').map_or(piece, |(_, rest)| rest))
        .collect();
    let mut words = outside.split(|c: char| !c.is_ascii_alphabetic());
    words.any(|word| word.len() > 1 && word.chars().any(|c| c.is_ascii_lowercase()))
}

/// Texts in `text!` and `words!` of the sources.
fn scan(folder: &Path, found: &mut BTreeSet<String>) {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            scan(&path, found);
        } else if path.file_name().unwrap() != "text.rs" {
            let source = std::fs::read_to_string(&path).unwrap();
            for mark in ["text!(", "words!("] {
                for (at, _) in source.match_indices(mark) {
                    let rest = source[at + mark.len()..].trim_start();
                    let text: syn::LitStr = syn::parse_str(literal(rest))
                        .unwrap_or_else(|_| panic!("{path:?}: {rest:.60}"));
                    found.insert(text.value());
                }
            }
        }
    }
}

/// The string literal at the beginning of a source.
fn literal(source: &str) -> &str {
    let mut escaped = false;
    let end = source.char_indices().skip(1).find(|(_, c)| {
        let ends = *c == '"' && !escaped;
        escaped = *c == '\\' && !escaped;
        ends
    });
    end.map_or(source, |(end, _)| &source[..=end])
}

/// Texts of the catalog: titles, labels, helps, choices, steps, rules.
fn described(found: &mut BTreeSet<String>) {
    let catalog = catalog();
    let mut add = |text: &str| {
        found.insert(text.to_owned());
    };
    let mut field = |field: &FieldEntry| {
        [field.label, field.help, field.group]
            .into_iter()
            .for_each(&mut add);
        field.null.map(&mut add);
        field.choices.iter().for_each(|choice| add(choice.label));
    };
    for cycle in &catalog.cycles {
        cycle.fields.iter().for_each(&mut field);
        cycle
            .sections
            .iter()
            .flat_map(|section| &section.fields)
            .for_each(&mut field);
    }
    catalog
        .sections
        .iter()
        .flat_map(|section| &section.fields)
        .for_each(&mut field);
    for cycle in &catalog.cycles {
        [cycle.title, cycle.says, cycle.also]
            .into_iter()
            .for_each(&mut add);
        cycle.steps.iter().for_each(|step| add(step));
    }
    for post in &catalog.posts {
        post.cycles
            .iter()
            .filter_map(|cycle| cycle.reason)
            .for_each(&mut add);
    }
    catalog
        .rules
        .iter()
        .for_each(|rule| [rule.says, rule.why].into_iter().for_each(&mut add));
    catalog
        .code_groups
        .iter()
        .for_each(|group| add(group.title));
}

#[test]
fn codes_and_numbers_need_no_words() {
    assert!(
        ["Width 1", "{a} mm at {b}", "not {a}"]
            .into_iter()
            .all(has_words)
    );
    assert!(
        !["G54 X{x}", "{touch}: {status}", "SET_UP"]
            .into_iter()
            .any(has_words)
    );
}
