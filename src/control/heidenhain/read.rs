//! Reads Klartext and its DIN/ISO form: blocks, their words, and the values of `Q…=`.

use crate::control::iso::lex::{code, lines_of, without_count, without_number};
use crate::form::{Value, printable};

/// Whether a block contains this word.
pub fn says(blocks: &[String], word: &str) -> bool {
    blocks
        .iter()
        .any(|b| b.split_whitespace().any(|w| w.eq_ignore_ascii_case(word)))
}

/// A word of ISO programming: a letter and a number, a program name, or the end sign.
pub fn is_iso_word(word: &str) -> bool {
    let number = |text: &str| crate::num::read(text).is_some();
    word.starts_with('%')
        || (word.starts_with(|c: char| c.is_ascii_alphabetic()) && number(&word[1..]))
        || word == "PROBE"
}

/// Whether a block moves, or may call something that moves.
pub fn moves(words: &[&str]) -> bool {
    const PATHS: [&str; 16] = [
        "L", "LN", "LP", "C", "CR", "CT", "CP", "CTP", "CHF", "RND", "APPR", "DEP", "FL", "FLT",
        "FC", "FCT",
    ];
    let number = |word: &str| {
        word.get(1..)
            .and_then(|number| crate::num::read(&number.replace(',', ".")))
    };
    let axis = |word: &str| {
        word.starts_with(['X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W']) && number(word).is_some()
    };
    // G4 is a dwell, G79 calls a cycle.
    let code = |word: &str| {
        let code = number(word).filter(|_| word.starts_with('G'));
        code.is_some_and(|code| {
            matches!(
                code,
                0.0 | 1.0 | 2.0 | 3.0 | 5.0 | 6.0 | 7.0 | 10.0..=16.0 | 79.0
            )
        })
    };
    match words {
        ["CALL", ..] | ["CYCL", "CALL", ..] => true,
        [first, ..] => {
            PATHS.contains(first)
                || axis(first)
                || code(first)
                || words.iter().all(|w| is_iso_word(w)) && words.iter().any(|w| code(w))
        }
        [] => false,
    }
}

/// A block in a message.
pub fn shown(block: &str) -> String {
    printable(&block.chars().take(60).collect::<String>())
}

/// Change of the work coordinate system that a block states, and whether it begins: a block may also end it.
pub fn transforms(words: &[&str]) -> Option<(&'static str, bool)> {
    // Zero, a bare axis and a reset change nothing; neither does a scale of 1.
    let value = |word: &&str| {
        word.trim_start_matches(|c: char| c.is_ascii_alphabetic() || c == '+')
            .to_owned()
    };
    let changes = |words: &[&str], none: f64| {
        let numbers: Vec<Option<f64>> = words
            .iter()
            .map(|word| crate::num::read(&value(word).replace(',', ".")))
            .collect();
        !words.contains(&"RESET")
            && numbers
                .iter()
                .any(|number| number.is_some_and(|number| number != none))
    };
    match words {
        ["CYCL", "DEF", cycle, rest @ ..] => {
            let (number, part) = cycle.split_once('.')?;
            let kind = ["7", "8", "10", "11", "19", "26"]
                .into_iter()
                .find(|known| *known == number)?;
            // The first part is a title.
            match (kind, part) {
                (_, "0") => None,
                ("8", _) => Some((kind, !rest.is_empty())),
                ("11" | "26", _) => Some((kind, changes(rest, 1.0))),
                ("7", _) => Some((
                    kind,
                    rest.iter().any(|word| word.starts_with('#')) || changes(rest, 0.0),
                )),
                _ => Some((kind, changes(rest, 0.0))),
            }
        }
        ["TRANS", what, rest @ ..] => {
            let kind = ["DATUM", "MIRROR", "ROTATION", "SCALE"]
                .into_iter()
                .find(|known| known == what)?;
            let axes = kind == "MIRROR" && !rest.is_empty() && !rest.contains(&"RESET");
            Some((
                kind,
                axes || rest.contains(&"TABLE")
                    || changes(rest, if kind == "SCALE" { 1.0 } else { 0.0 }),
            ))
        }
        ["PLANE", kind, ..] => Some(("PLANE", *kind != "RESET")),
        // DIN/ISO: datum shift, rotation, scale, mirror, tilt.
        [code, rest @ ..] => {
            let kind = ["G54", "G73", "G72", "G28", "G80"]
                .into_iter()
                .find(|known| known == code)?;
            Some((
                kind,
                if kind == "G28" {
                    !rest.is_empty()
                } else {
                    changes(rest, if kind == "G72" { 1.0 } else { 0.0 })
                },
            ))
        }
        [] => None,
    }
}

/// Whether an ISO word belongs to a job.
pub fn wanted_iso(word: &str) -> bool {
    matches!(word, "G17" | "G18" | "G19" | "G70" | "G71")
        || word
            .strip_prefix('T')
            .is_some_and(|n| n.parse::<i32>().is_ok())
}

/// Logical blocks of a program, without comments, block numbers and continuation signs.
pub fn blocks(text: &str) -> Vec<String> {
    numbered_blocks(text)
        .into_iter()
        .map(|(_, block)| block)
        .collect()
}

/// Logical blocks, each with the 0-based line in which it begins. `~` continues a block over blank lines and comments. It may also end a comment on the next
/// line, as the manual prints it.
pub fn numbered_blocks(text: &str) -> Vec<(usize, String)> {
    let mut blocks: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    // Whether the last block has several lines.
    let mut long = false;
    for (number, line) in lines_of(text).map(str::trim).enumerate() {
        let continued = line.ends_with('~');
        if long && (line.is_empty() || line.starts_with(';')) {
            goes_on |= continued;
            continue;
        }
        let line = line.trim_end_matches('~');
        // `*` ends an ISO block.
        let line = code(line, false).trim().trim_end_matches('*').trim_end();
        if goes_on {
            let (_, block) = blocks
                .last_mut()
                .expect("a continuation line follows a block");
            block.push(' ');
            block.push_str(line);
        } else {
            blocks.push((number, without_count(without_number(line)).to_owned()));
        }
        long = goes_on || continued;
        goes_on = continued;
    }
    blocks
}

/// The value of `Q…=`.
#[derive(Debug)]
pub enum Given {
    /// A number, or a text in quotes.
    Value(Value),
    /// PREDEF: the value in GLOBAL DEF.
    Predef,
    /// A Q parameter, and whether it is negated.
    Parameter(u32, bool),
    /// None of these.
    Unreadable,
}

/// `+Q1980`, `-Q5`.
fn parameter(text: &str) -> Option<Given> {
    let name = text.strip_prefix(['+', '-']).unwrap_or(text);
    let number = name.strip_prefix(['Q', 'q'])?.parse().ok()?;
    Some(Given::Parameter(number, text.starts_with('-')))
}

/// Every `Q1116=+10` and `QS1116="10H7"` of a block.
pub fn assignments(block: &str) -> Vec<(u32, Given)> {
    let mut found = Vec::new();
    let mut rest = block;
    while let Some(at) = rest.find(['Q', 'q']) {
        rest = &rest[at + 1..];
        let name = rest.strip_prefix(['S', 's']).unwrap_or(rest);
        let digits = name.len() - name.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let Ok(number) = name[..digits].parse::<u32>() else {
            continue;
        };
        let Some(value) = name[digits..].trim_start().strip_prefix('=') else {
            continue;
        };
        let value = value.trim_start();
        let (text, quoted) = match value.strip_prefix('"') {
            Some(inside) => (inside.split('"').next().unwrap_or_default(), true),
            // `*` ends an ISO block.
            None => (
                value
                    .split(|c: char| c.is_whitespace() || c == '*')
                    .next()
                    .unwrap_or_default(),
                false,
            ),
        };
        rest = &value[(text.len() + 2 * usize::from(quoted)).min(value.len())..];
        let plain = text.replace(',', ".");
        let given = match crate::num::read(&plain) {
            _ if quoted => Given::Value(Value::Text(plain)),
            Some(x) if x.is_finite() => Given::Value(Value::Number(x)),
            _ if plain.eq_ignore_ascii_case("PREDEF") => Given::Predef,
            _ => parameter(&plain).unwrap_or(Given::Unreadable),
        };
        found.push((number, given));
    }
    found
}
