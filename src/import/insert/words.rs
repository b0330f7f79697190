//! Words of a block, read without knowing its control.

use crate::control::iso::lex::{comment_at, trimmed, without_number};

/// A line's blocks in capitals, and its comment.
pub fn parted(line: &str) -> (String, &str) {
    let line = trimmed(line.trim_end_matches(['\r', '\n']));
    let line = match line.strip_prefix('/') {
        Some(_) => line,
        None => without_number(line),
    };
    let named = line.contains('"') && line.to_ascii_uppercase().contains("T=\"");
    let at = if named {
        None
    } else {
        comment_at(line.as_bytes(), true)
    };
    let (code, comment) = line.split_at(at.unwrap_or(line.len()));
    // `(PROBE) T24 M6`
    let behind = comment
        .strip_prefix('(')
        .and_then(|inner| inner.split_once(')'))
        .map_or("", |(_, behind)| behind);
    (format!("{code} {behind}").to_ascii_uppercase(), comment)
}

/// The digits after a letter, if the letter begins a word.
pub fn number_of(code: &str, letter: char) -> Option<&str> {
    words(code)
        .find(|(known, _)| *known == letter)
        .map(|(_, value)| &value[..value.bytes().take_while(u8::is_ascii_digit).count()])
        .filter(|digits| !digits.is_empty())
}

/// Whether a block has a code such as M6, with or without leading zeros.
pub fn has_code(code: &str, letter: char, number: u32) -> bool {
    words(code).any(|(known, value)| {
        known == letter && value.split_once('.').is_none() && value.parse() == Ok(number)
    })
}

/// The words of a block: a letter and its value. The value of `X#5` or `X=R1` is empty.
pub fn words(code: &str) -> impl Iterator<Item = (char, &str)> {
    let part = |c: char| c.is_ascii_alphabetic() || c == '_' || c == '#' || c == '<' || c == '$';
    code.match_indices(|c: char| c.is_ascii_alphabetic())
        .filter(move |(at, _)| !code[..*at].ends_with(part))
        .filter(move |(at, _)| {
            !code[at + 1..].starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        })
        .filter_map(move |(at, letter)| {
            let value = code[at + 1..].trim_start();
            let end = value
                .find(|c: char| !c.is_ascii_digit() && c != '.' && c != '-' && c != '+')
                .unwrap_or(value.len());
            Some((letter.chars().next()?, &value[..end]))
        })
}

/// The variables in a block: `#101`, `#<NAME>`, `R5`.
pub fn variables(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut before = ' ';
    for (at, letter) in code.char_indices() {
        let behind = &code[at + letter.len_utf8()..];
        let count = behind.bytes().take_while(u8::is_ascii_digit).count();
        let name = behind.strip_prefix('<').and_then(|name| name.find('>'));
        let begins = letter == '#' || letter == 'R' && !before.is_ascii_alphanumeric();
        match name {
            Some(end) if letter == '#' => found.push(format!("#{}", &behind[..end + 2])),
            _ if begins && count > 0 => found.push(format!("{letter}{}", &behind[..count])),
            _ => {}
        }
        before = letter;
    }
    found
}
