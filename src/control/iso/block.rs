//! A block of a program, by its words and the effects of its codes.

use crate::control::iso::codes::{Effect, Family, effect};
use crate::control::iso::lex::{
    comment_at, end_of_value, head, next_word, number, trimmed, valued,
};

/// A block.
#[derive(Debug, Default)]
pub struct Block {
    /// Whether the operator may skip it.
    pub skips: bool,
    /// Its code in capitals, without block number and comments.
    pub code: String,
    /// Its comments.
    pub comment: String,
    /// Name of a tool: `T="PROBE"`.
    pub tool_name: Option<String>,
    /// Letters with their numbers; `None` for a computed value.
    words: Vec<(u8, Option<f64>)>,
    family: Option<Family>,
}

impl Block {
    /// Reads a line. Round brackets are comments, except on a SINUMERIK.
    pub fn of(line: &str, family: Family) -> Block {
        let line = trimmed(line.trim_end_matches(['\r', '\n']));
        let head = head(line.as_bytes());
        let mut rest = &line[head.end..];
        let mut block = Block {
            skips: head.skips,
            tool_name: name_of(rest),
            family: Some(family),
            ..Block::default()
        };
        let round = family == Family::Iso;
        while let Some(at) = comment_at(rest.as_bytes(), round) {
            block.code.push_str(&rest[..at]);
            let inner = &rest[at + 1..];
            let closed = inner
                .split_once(')')
                .filter(|_| rest[at..].starts_with('('));
            let (comment, behind) = closed.unwrap_or((inner, ""));
            block.comment.push_str(comment);
            rest = behind;
        }
        block.code.push_str(rest);
        block.code.make_ascii_uppercase();
        block.words = words(block.code.as_bytes());
        block
    }

    /// Whether it has nothing but a comment.
    pub fn is_blank(&self) -> bool {
        trimmed(&self.code).is_empty()
    }

    /// The letters of its words.
    pub fn letters(&self) -> impl Iterator<Item = u8> {
        self.words.iter().map(|(letter, _)| *letter)
    }

    pub fn has(&self, letter: u8) -> bool {
        self.words.iter().any(|(known, _)| *known == letter)
    }

    /// Number of the first word with a letter.
    pub fn number(&self, letter: u8) -> Option<f64> {
        self.words
            .iter()
            .find(|(known, _)| *known == letter)
            .and_then(|(_, number)| *number)
    }

    pub fn has_axes(&self) -> bool {
        (b'X'..=b'Z').any(|axis| self.has(axis))
    }

    /// Whether every axis word is 0.
    pub fn is_at_zero(&self) -> bool {
        self.words
            .iter()
            .filter(|(letter, _)| matches!(letter, b'X'..=b'Z'))
            .all(|(_, number)| *number == Some(0.0))
    }

    /// The number of a tool, as in a program: without leading zeros.
    pub fn tool(&self) -> Option<String> {
        Some(crate::num::decimal(self.number(b'T')?, 0))
    }

    /// Effects of its G and M codes, with each code.
    pub fn effects(&self) -> impl Iterator<Item = (Effect, String)> {
        self.words.iter().filter_map(|(letter, number)| {
            let number = number.filter(|_| matches!(letter, b'G' | b'M'))?;
            let effect = effect(self.family?, *letter, (10.0 * number).round() as i32)?;
            let code = crate::num::decimal(number, 1);
            Some((effect, format!("{}{code}", char::from(*letter))))
        })
    }

    /// Whether every G and M code is in the table.
    pub fn knows_codes(&self) -> bool {
        let codes = self
            .words
            .iter()
            .filter(|(letter, _)| matches!(letter, b'G' | b'M'));
        codes.count() == self.effects().count()
    }

    /// Whether it moves and sets nothing but the motion.
    pub fn only_moves(&self) -> bool {
        let is_move = |effect| {
            matches!(
                effect,
                Effect::Motion(_) | Effect::Once(_) | Effect::Nothing
            )
        };
        self.has_axes() && self.effects().all(|(effect, _)| is_move(effect))
    }

    /// Whether it has this code.
    pub fn does_code(&self, code: &str) -> bool {
        self.effects().any(|(_, own)| own == code)
    }

    /// Whether it has a code with such an effect.
    pub fn does(&self, is: impl Fn(Effect) -> bool) -> bool {
        self.effects().any(|(effect, _)| is(effect))
    }
}

fn name_of(line: &str) -> Option<String> {
    let at = line.find("T=\"").or_else(|| line.find("t=\""))?;
    let (name, _) = line[at + 3..].split_once('"')?;
    Some(name.to_owned())
}

/// The words of a block: letters with a value, outside of names and brackets.
fn words(line: &[u8]) -> Vec<(u8, Option<f64>)> {
    let mut words = Vec::new();
    let mut at = 0;
    while let Some(&letter) = line.get(at) {
        if letter.is_ascii_alphabetic() && valued(line, at) {
            let blanks = line[at + 1..].iter().take_while(|b| **b == b' ').count();
            let begin = at + 1 + blanks;
            let (value, end) = match number(line, begin) {
                Some((value, end)) => (Some(value), end),
                None => (None, end_of_value(line, begin).max(at + 1)),
            };
            words.push((letter, value));
            at = end;
        } else if letter == b' ' || letter == b'\t' {
            at += 1;
        } else {
            at = next_word(line, at);
        }
    }
    words
}

/// The variables in a code: `#101`, `#<NAME>`, `R5`.
pub fn variables(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut before = ' ';
    for (at, letter) in code.char_indices() {
        let rest = &code[at + letter.len_utf8()..];
        let count = rest.bytes().take_while(u8::is_ascii_digit).count();
        let name = rest.strip_prefix('<').and_then(|name| name.find('>'));
        let begins = letter == '#' || letter == 'R' && !before.is_ascii_alphanumeric();
        match name {
            Some(end) if letter == '#' => found.push(format!("#{}", &rest[..end + 2])),
            _ if begins && count > 0 => found.push(format!("{letter}{}", &rest[..count])),
            _ => {}
        }
        before = letter;
    }
    found
}
