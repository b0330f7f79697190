//! Finds CmdPrm codes and their values in any text.
//!
//! `Int[-1]`, `Flt [-101]` or `Bol[-3]` is a code; [`value`] finds its value after it on the same line, or it is the `value` of its JSON object. Web pages
//! break the cells of a table into lines: a code without a value on its line takes the next line that is a value.

use crate::form::Value;
use crate::path::Accessor;

/// A code with its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    pub accessor: Accessor,
    pub code: i32,
    /// Value; true is 1.
    pub value: f64,
}

/// All codes of a text with their values, in order.
pub fn entries(text: &str) -> Vec<Entry> {
    let mut found = Vec::new();
    // The last code without a value on its line.
    let mut open: Option<(Accessor, i32)> = None;
    for line in text.lines() {
        let mut next = next_code(line);
        if next.is_none()
            && let Some((accessor, code)) = open
            && let Some(value) = cell(line, code)
        {
            found.push(Entry {
                accessor,
                code,
                value,
            });
            open = None;
        }
        while let Some((accessor, code, behind)) = next {
            next = next_code(behind);
            // The value comes before the next code of the line.
            let end = next.map_or(behind.len(), |(.., rest)| behind.len() - rest.len());
            let value = value(&behind[..end]);
            open = value.is_none().then_some((accessor, code));
            found.extend(value.map(|value| Entry {
                accessor,
                code,
                value,
            }));
        }
    }
    found
}

/// Value in a table cell on a separate line: a line that is only a number, or the type in the description of the cycle, `value = 7`.
fn cell(line: &str, code: i32) -> Option<f64> {
    let line = typographic(line);
    let cell = line.trim().trim_matches('|').trim();
    let kind = || {
        cell.rsplit_once("value =")
            .filter(|_| code == -1)
            .and_then(|(_, kind)| whole(kind))
    };
    whole(cell).or_else(kind)
}

/// All codes of parsed JSON at any depth: objects with a `code` and a `value`, and objects whose keys are codes.
pub fn json_entries(json: &Value) -> Vec<Entry> {
    let mut found = Vec::new();
    collect(json, 0, &mut found);
    found
}

fn collect(json: &Value, depth: usize, found: &mut Vec<Entry>) {
    const DEEPEST: usize = 32;
    match json {
        _ if depth > DEEPEST => {}
        Value::List(items) => items
            .iter()
            .for_each(|item| collect(item, depth + 1, found)),
        Value::Map(entries) => {
            let named = match json.get("code") {
                Some(Value::Text(code)) => next_code(code),
                _ => None,
            };
            if let (Some((accessor, code, _)), Some(value)) =
                (named, json.get("value").and_then(scalar))
            {
                return found.push(Entry {
                    accessor,
                    code,
                    value,
                });
            }
            for (key, inner) in entries {
                match (next_code(key), scalar(inner)) {
                    (Some((accessor, code, _)), Some(value)) => found.push(Entry {
                        accessor,
                        code,
                        value,
                    }),
                    _ => collect(inner, depth + 1, found),
                }
            }
        }
        Value::Null | Value::Flag(_) | Value::Number(_) | Value::Text(_) | Value::Other(_) => {}
    }
}

/// A parsed value as a number; true is 1.
fn scalar(value: &Value) -> Option<f64> {
    match value {
        Value::Number(x) => Some(*x).filter(|x| x.is_finite()),
        Value::Flag(on) => Some(f64::from(u8::from(*on))),
        Value::Text(text) => whole(&typographic(text)),
        Value::Null | Value::List(_) | Value::Map(_) | Value::Other(_) => None,
    }
}

/// Typographic minus signs and spaces as plain ones.
fn typographic(text: &str) -> String {
    text.replace(['\u{2212}', '\u{2013}'], "-")
        .replace(['\u{a0}', '\u{202f}', '\u{2009}'], " ")
}

/// The next code of a text and the text after its bracket.
fn next_code(text: &str) -> Option<(Accessor, i32, &str)> {
    for (at, _) in text.match_indices('[') {
        let before = text[..at].trim_end().as_bytes();
        let Some(start) = before.len().checked_sub(3) else {
            continue;
        };
        let accessor = Accessor::CMD_PRM
            .into_iter()
            .find(|a| before[start..].eq_ignore_ascii_case(a.word().as_bytes()));
        let whole =
            start == 0 || !(before[start - 1].is_ascii_alphanumeric() || before[start - 1] == b'_');
        let Some(accessor) = accessor.filter(|_| whole) else {
            continue;
        };
        // No code is longer than a dozen characters.
        let after = &text[at + 1..];
        let Some(end) = after.bytes().take(16).position(|b| b == b']') else {
            continue;
        };
        let code = &after[..end];
        if let Ok(number) = code.trim().parse::<i32>() {
            return Some((accessor, number, &after[code.len() + 1..]));
        }
    }
    None
}

/// Value after a code: in a table row the first cell that is a number; else the text after an equals sign or a colon; else the first number. Typographic minus
/// signs count as minus signs.
fn value(text: &str) -> Option<f64> {
    let text = typographic(text);
    let text = text.trim_start_matches(['"', '\'', ' ']).trim_end();
    if let Some(separator) = ['\t', '|', ';', ',']
        .into_iter()
        .find(|c| text.starts_with(*c))
    {
        return text
            .split(separator)
            .find_map(|cell| whole(cell.trim().trim_matches(['"', '\''])));
    }
    let assigned = text
        .split_once('=')
        .or_else(|| text.strip_prefix(':').map(|rest| ("", rest)));
    if let Some((_, right)) = assigned {
        return whole(right.split(';').next().unwrap_or(right)).or_else(|| first(right));
    }
    whole(text).or_else(|| first(text))
}

/// A text that is a number or a truth value: decimal point or comma, thousands separated by spaces.
fn whole(text: &str) -> Option<f64> {
    let text = text.trim();
    match text.to_ascii_lowercase().as_str() {
        "true" => return Some(1.0),
        "false" => return Some(0.0),
        _ => {}
    }
    let (sign, digits) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest.trim_start()),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    if !digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') || digits.len() > 400 {
        return None;
    }
    let groups: Vec<&str> = digits.split(' ').collect();
    let grouped = groups[1..].iter().enumerate().all(|(i, group)| {
        let last = i + 2 == groups.len();
        let whole = group.split(['.', ',']).next().unwrap_or_default();
        whole.len() == 3 && whole.bytes().all(|b| b.is_ascii_digit()) && (last || whole == *group)
    });
    let plain = grouped.then(|| groups.concat().replace(',', "."))?;
    crate::num::read(&plain)
        .filter(|x| x.is_finite())
        .map(|x| sign * x)
}

/// The first number or truth value of a text.
fn first(text: &str) -> Option<f64> {
    let lower = text.to_ascii_lowercase();
    let truth = |word: &str| {
        lower.match_indices(word).map(|(at, _)| at).find(|&at| {
            let edge = |c: Option<char>| c.is_none_or(|c| !c.is_ascii_alphanumeric());
            edge(lower[..at].chars().next_back()) && edge(lower[at + word.len()..].chars().next())
        })
    };
    let truths = [(truth("true"), 1.0), (truth("false"), 0.0)];
    let all = truths
        .into_iter()
        .filter_map(|(at, value)| Some((at?, value)))
        .chain(number(text));
    all.min_by_key(|(at, _)| *at).map(|(_, value)| value)
}

/// The first number of a text and its position. A comma between two digits is a decimal comma.
fn number(text: &str) -> Option<(usize, f64)> {
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let word = |i: usize| i > 0 && (bytes[i - 1].is_ascii_alphanumeric() || bytes[i - 1] == b'_');
    let mut at = (0..bytes.len()).find(|&i| digit(i) && !word(i))?;
    if at > 0 && bytes[at - 1] == b'.' {
        at -= 1;
    }
    let start = if at > 0 && matches!(bytes[at - 1], b'-' | b'+') {
        at - 1
    } else {
        at
    };
    let mut end = at;
    while digit(end) || (matches!(bytes.get(end), Some(b'.' | b',')) && digit(end + 1)) {
        end += 1;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'-' | b'+')));
        if digit(end + 1 + sign) {
            end += 1 + sign;
            while digit(end) {
                end += 1;
            }
        }
    }
    let parsed = crate::num::read(&text[start..end].replace(',', ".")).filter(|x| x.is_finite())?;
    Some((start, parsed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_the_forms_people_have() {
        for (text, value) in [
            ("CmdPrm.Flt[-50] = 12.5", 12.5),
            ("CmdPrm. Flt [-50] = 12,5", 12.5),
            ("cmdprm.flt[ -50 ]: 12.5 ; comment 7", 12.5),
            ("Flt[-50] 12.5", 12.5),
            ("CmdPrm.Flt[-50],Double,12.5,\"Feed distance 2\"", 12.5),
            ("CmdPrm.Flt[-50];Double;12,5;Feed distance", 12.5),
            ("| CmdPrm.Flt[-50] | Double | 1.25e1 |", 12.5),
            ("Flt[-50]=.125E+2", 12.5),
        ] {
            assert_eq!(
                entries(text),
                [Entry {
                    accessor: Accessor::Flt,
                    code: -50,
                    value
                }],
                "{text}"
            );
        }
        for (text, value) in [
            ("Flt[-50] (Width 1, from 2) = 64", 64.0),
            ("Flt[-50]\tDouble\tWidth 1\t64", 64.0),
            ("Flt[-50] = \u{2212}5", -5.0),
            ("Flt[-50] = - 5 ; x", -5.0),
            ("Flt[-50] = 1 064,5", 1064.5),
            ("Flt[-50] = 64 mm", 64.0),
        ] {
            assert_eq!(
                entries(text),
                [Entry {
                    accessor: Accessor::Flt,
                    code: -50,
                    value
                }],
                "{text}"
            );
        }
        // Tables broken as on the pages of the documentation, with values inserted.
        let page = "CmdPrm.Int[-1] |\nInteger |\nProbing cycle type: Internal rectangle probing protected value = 7 |\nCmdPrm. Flt [-50] |\nDouble |\nFeed distance, 1 of 2 |\n20,5 |\nCmdPrm.Flt[-51]\n12\n13\nCmdPrm.Flt[-53] |\nWidth 1 |\n";
        let read: Vec<(i32, f64)> = entries(page)
            .iter()
            .map(|entry| (entry.code, entry.value))
            .collect();
        assert_eq!(read, [(-1, 7.0), (-50, 20.5), (-51, 12.0)]);
        assert!(entries("TouchPoint[1] = 2.5").is_empty());
        assert_eq!(value(" = True"), Some(1.0));
        assert_eq!(value(",Boolean,false,On"), Some(0.0));
        assert_eq!(value("= -12"), Some(-12.0));
        assert_eq!(value(" | Double | Feed distance |"), None);
        assert_eq!(
            entries("Int[-1]=7 Flt[-50]=3 Flt[x]=1 [-3] Flt[99999999999]=1").len(),
            2
        );
    }

    #[test]
    fn json_is_read_as_json() {
        let read = |text: &str| -> Vec<(i32, f64)> {
            let json = crate::job::from_json(text).unwrap();
            let mut read: Vec<_> = json_entries(&json)
                .iter()
                .map(|e| (e.code, e.value))
                .collect();
            // The order of an object's keys does not matter.
            read.sort_by_key(|(code, _)| -code);
            read
        };
        // A decimal comma inside a text does not end the value; braces inside a text do not end the object.
        assert_eq!(
            read(r#"[{ "code": "CmdPrm.Flt[-50]", "meaning": "a } b", "value": "12,5" }]"#),
            [(-50, 12.5)]
        );
        assert_eq!(
            read(r#"{ "rows": [{ "a": { "code": "CmdPrm.Int[-1]", "value": 7 } }] }"#),
            [(-1, 7.0)]
        );
        assert_eq!(
            read(r#"[{"code":"CmdPrm.Int[-1]","value":7},{"value":2.5,"code":"CmdPrm.Flt[-50]"}]"#),
            [(-1, 7.0), (-50, 2.5)]
        );
        assert_eq!(
            read(r#"{"CmdPrm.Int[-1]":7,"CmdPrm.Bol[-3]":true}"#),
            [(-1, 7.0), (-3, 1.0)]
        );
        assert_eq!(read(r#"{"x":{"CmdPrm.Int[-1]":"x"}}"#), []);
    }
}
