//! One line of a sender's log: grbl's reports in it, and blocks sent to grbl.
//!
//! Sources: grbl 1.1's interface document and its report.c: reports are in square brackets or between `<` and `>`. Additions of grblHAL and FluidNC (further
//! axes, `WCS:`, G59.1 to G59.3) are read likewise. Senders may put a prompt or a time before a report; these are ignored.

use crate::geom::Vec3;
use crate::num::read_digits;

/// An item of a line. Lengths as grbl reports them: mm, or inch under `$13=1`.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// `[PRB:x,y,z:1]` in machine coordinates, with the text before it, without digits.
    Touch {
        place: Vec3,
        contact: bool,
        prefix: String,
    },
    /// `WCO:`: machine minus work coordinates.
    Shift(Vec3),
    /// Position of the idle machine, in machine or work coordinates.
    Stands { place: Vec3, work: bool },
    /// `[G54:x,y,z]`, 1 = G54.
    Offset(u8, Vec3),
    /// `[G92:x,y,z]`.
    Added(Vec3),
    /// `[TLO:z]`, or with three axes.
    Length(Vec3),
    /// The active work offset, reported or selected by a block.
    Active { offset: u8, sent: bool },
    /// `$13=`: whether reports are in inch.
    Inches(bool),
    /// The answer to a line: a report under way has ended.
    Answered,
    /// End of a program: the work offset may change here, to G54 on grbl.
    Ended,
    /// A change of offsets: a block with G10, G92, G43.1 or G49, `$RST`, or a restart.
    Changes,
    /// A jog or homing.
    Moves,
    /// A block with a position.
    Travels,
    /// A block with a touch. Its report comes later: senders are some lines ahead.
    Probes,
    /// An alarm or an error; `in_contact` for a probing move that began in contact, `ALARM:4`.
    Trouble { in_contact: bool },
    /// A report of a touch that cannot be read.
    Unreadable,
}

/// All items of a line in order, with the reports first.
pub fn items(line: &str) -> Vec<Item> {
    let line = &*without_comments(line);
    let mut found: Vec<Item> = line
        .match_indices("PRB:")
        .map(|(at, key)| touch(&line[..at], &line[at + key.len()..]))
        .collect();
    settings(line, &mut found);
    status(line, &mut found);
    let plain = without_reports(line);
    let plain = plain.trim();
    let says = |word: &str| plain.contains(word);
    if plain == "ok" || plain.ends_with(" ok") {
        found.push(Item::Answered);
    }
    if says("ALARM:") || says("error:") || line.contains("[MSG:ERR") {
        let in_contact = plain.split("ALARM:").skip(1).any(|number| {
            number
                .strip_prefix('4')
                .is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
        });
        found.push(Item::Trouble { in_contact });
    }
    if line.contains("Pgm End") || line.contains("Program End") {
        found.push(Item::Ended);
    }
    // Greeting after a restart.
    if says("$RST=") || (line.contains("rbl") && line.contains("for help]")) {
        found.extend([Item::Changes, Item::Ended]);
    }
    if says("$J=") || says("$H") {
        found.push(Item::Moves);
    } else if let Some(words) = block(plain) {
        sent(&words, &mut found);
    }
    found
}

/// A line without the text in parentheses.
pub fn without_comments(line: &str) -> String {
    let mut out = String::with_capacity(line.len());
    let mut rest = line;
    while let Some((before, after)) = rest.split_once('(') {
        let Some((_, after)) = after.split_once(')') else {
            break;
        };
        out.push_str(before);
        out.push(' ');
        rest = after;
    }
    out + rest
}

/// Whether a line has the prompt of a sender before a sent block.
pub fn is_sent(line: &str) -> bool {
    line.contains('>')
}

/// The work offset of a line that consists of its word only.
pub fn offset_alone(line: &str) -> Option<u8> {
    line.trim().strip_prefix(['G', 'g']).and_then(offset_number)
}

/// X, Y and Z of a line with these words and no others: `X1.2 Y3.4 Z5.6`, in any order, also `X=1.2` and with blanks between letter, sign and digits. A name
/// and a count may come first: `TOUCH 1 X…`. `None` for any other line.
pub fn letters(line: &str) -> Option<[f64; 3]> {
    let begin = line.char_indices().find(|(at, c)| {
        let before = line[..*at].chars().next_back();
        matches!(c.to_ascii_uppercase(), 'X' | 'Y' | 'Z')
            && !before.is_some_and(|c| c.is_alphanumeric() || c == '.')
    })?;
    let (name, mut rest) = line.split_at(begin.0);
    let plain = |word: &str| {
        word.chars().all(char::is_alphabetic) || word.chars().all(|c| c.is_ascii_digit())
    };
    if !name.split([' ', '\t', ':', ',', ';']).all(plain) {
        return None;
    }
    let mut found = [None; 3];
    loop {
        rest = rest.trim_start_matches([' ', '\t', ',', ';']);
        let Some(letter) = rest.chars().next() else {
            break;
        };
        let axis = ['X', 'Y', 'Z']
            .iter()
            .position(|axis| *axis == letter.to_ascii_uppercase())?;
        rest = rest[1..]
            .trim_start()
            .strip_prefix('=')
            .unwrap_or(&rest[1..]);
        let (value, after) = number(rest)?;
        if found[axis].replace(value).is_some()
            || after.starts_with(|c: char| c.is_alphanumeric() && !"XYZxyz".contains(c))
        {
            return None;
        }
        rest = after;
    }
    Some([found[0]?, found[1]?, found[2]?])
}

/// The number at the start of a text, and the rest: blanks may come before the number and after its sign, as DPRNT prints them.
pub fn number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim_start_matches([' ', '\t']);
    let (sign, digits) = match text.as_bytes().first()? {
        b'-' => (-1.0, text[1..].trim_start_matches([' ', '\t'])),
        b'+' => (1.0, text[1..].trim_start_matches([' ', '\t'])),
        _ => (1.0, text),
    };
    let (value, length) = read_digits(digits.as_bytes())?;
    (value <= 1e6).then_some((sign * value, &digits[length..]))
}

/// Numbers separated by commas, and the rest.
fn axes(mut text: &str) -> Option<(Vec<f64>, &str)> {
    let mut found = Vec::new();
    loop {
        let (value, rest) = number(text)?;
        found.push(value);
        match rest.strip_prefix(',') {
            Some(more) => text = more,
            None => return Some((found, rest)),
        }
    }
}

/// The first three of at least three numbers, followed by one of `ends`.
fn place<'a>(text: &'a str, ends: &[char]) -> Option<(Vec3, &'a str)> {
    let (found, rest) = axes(text)?;
    let [x, y, z, ..] = found[..] else {
        return None;
    };
    (rest.is_empty() || rest.starts_with(ends)).then_some((Vec3::new(x, y, z), rest))
}

/// Number of characters before a report that are examined.
const LONGEST_PREFIX: usize = 60;

/// A report of a touch, from the text before and after its `PRB:`.
fn touch(before: &str, after: &str) -> Item {
    let read = || {
        let (place, rest) = place(after, &[':'])?;
        let (contact, end) = match rest.as_bytes() {
            [b':', b'1', ..] => (true, &rest[2..]),
            [b':', b'0', ..] => (false, &rest[2..]),
            _ => return None,
        };
        let prefix = before.strip_suffix('[').unwrap_or(before);
        let whole = (end.starts_with(']') || !before.ends_with('['))
            && !end.starts_with(|c: char| c.is_alphanumeric());
        let near = prefix
            .char_indices()
            .rev()
            .take(LONGEST_PREFIX)
            .last()
            .map_or(0, |(at, _)| at);
        let prefix = prefix[near..]
            .chars()
            .filter(|c| !c.is_ascii_digit())
            .collect::<String>()
            .trim()
            .to_owned();
        whole.then_some(Item::Touch {
            place,
            contact,
            prefix,
        })
    };
    read().unwrap_or(Item::Unreadable)
}

/// Answers to `$#`, `$G` and `$$`.
fn settings(line: &str, found: &mut Vec<Item>) {
    for (at, _) in line.match_indices('[') {
        let Some(body) = report(&line[at..], *b"[]").map(|end| &line[at + 1..at + end]) else {
            continue;
        };
        let Some((key, rest)) = body.split_once(':') else {
            continue;
        };
        let whole = || place(rest, &[]).map(|(place, _)| place);
        match key {
            "GC" => {
                let active = rest
                    .split_whitespace()
                    .find_map(|word| word.strip_prefix('G').and_then(offset_number));
                found.extend(active.map(|offset| Item::Active {
                    offset,
                    sent: false,
                }));
            }
            "G92" => found.extend(whole().map(Item::Added)),
            "TLO" => {
                let along_z =
                    || axes(rest).filter(|(found, rest)| found.len() == 1 && rest.is_empty());
                found.extend(
                    whole()
                        .or_else(|| Some(Vec3::new(0.0, 0.0, along_z()?.0[0])))
                        .map(Item::Length),
                );
            }
            _ => {
                let number = key.strip_prefix('G').and_then(offset_number);
                found.extend(number.and_then(|number| Some(Item::Offset(number, whole()?))));
            }
        }
    }
    if let Some((_, rest)) = line.split_once("$13=") {
        match rest.as_bytes() {
            [b'0', rest @ ..] if !rest.first().is_some_and(u8::is_ascii_digit) => {
                found.push(Item::Inches(false))
            }
            [b'1', rest @ ..] if !rest.first().is_some_and(u8::is_ascii_digit) => {
                found.push(Item::Inches(true))
            }
            _ => {}
        }
    }
}

/// Values of a status report, or of a single `WCO:`.
fn status(line: &str, found: &mut Vec<Item>) {
    let of = |key: &str| {
        line.split_once(key)
            .and_then(|(_, rest)| place(rest, &['|', '>', ' ', ']']))
            .map(|(place, _)| place)
    };
    found.extend(of("WCO:").map(Item::Shift));
    if let Some((_, rest)) = line.split_once("WCS:G") {
        let end = rest.find(['|', '>']).unwrap_or(rest.len());
        found.extend(offset_number(&rest[..end]).map(|offset| Item::Active {
            offset,
            sent: false,
        }));
    }
    if line.contains("<Idle|") {
        found.extend(of("MPos:").map(|place| Item::Stands { place, work: false }));
        found.extend(of("WPos:").map(|place| Item::Stands { place, work: true }));
    }
}

/// Number of a work offset, 1 = G54, from the digits of its word.
fn offset_number(digits: &str) -> Option<u8> {
    ["54", "55", "56", "57", "58", "59", "59.1", "59.2", "59.3"]
        .iter()
        .position(|known| *known == digits)
        .map(|i| i as u8 + 1)
}

/// End of the report at the start of a text; `None` if another report begins before its end.
fn report(text: &str, [open, close]: [u8; 2]) -> Option<usize> {
    let end = 1 + text
        .bytes()
        .skip(1)
        .position(|byte| byte == open || byte == close)?;
    (text.as_bytes()[end] == close).then_some(end)
}

/// A line without texts in brackets and status reports.
fn without_reports(line: &str) -> String {
    let mut out = String::with_capacity(line.len());
    let mut rest = line;
    while let Some(at) = rest.find(['[', '<']) {
        let (before, from) = rest.split_at(at);
        out.push_str(before);
        let bracket = from.starts_with('[');
        let end = report(from, if bracket { *b"[]" } else { *b"<>" })
            .filter(|end| bracket || from[..*end].contains('|'));
        if end.is_none() {
            out.push(' ');
        }
        rest = &from[end.unwrap_or(0) + 1..];
    }
    out + rest
}

/// Words of a block at the end of a line, after any other text; `None` without a block. Text after a semicolon and an `ok` do not belong to it; `$N0=G54`
/// stores a block for later.
fn block(line: &str) -> Option<Vec<(char, f64)>> {
    let line = line
        .split(';')
        .next()
        .filter(|line| !line.contains('$'))?
        .trim_end();
    let line = line
        .strip_suffix("ok")
        .map_or(line, |line| line.trim_end_matches([' ', '\t', ':']));
    let starts = line.char_indices().filter(|(at, c)| {
        c.is_ascii_alphabetic()
            && !line[..*at]
                .chars()
                .next_back()
                .is_some_and(|c| c.is_alphanumeric() || c == '.' || c == '$')
    });
    starts
        .take(MOST_STARTS)
        .find_map(|(at, _)| words(&line[at..]))
}

/// After this number of other words no block is searched for.
const MOST_STARTS: usize = 12;

fn words(mut text: &str) -> Option<Vec<(char, f64)>> {
    let mut found = Vec::new();
    while let Some(letter) = text.chars().next() {
        if !letter.is_ascii_alphabetic() {
            return None;
        }
        let (value, rest) = number(&text[1..])?;
        found.push((letter.to_ascii_uppercase(), value));
        text = rest.trim_start();
    }
    (!found.is_empty()).then_some(found)
}

/// Effects of a sent block on offsets and positions.
fn sent(words: &[(char, f64)], found: &mut Vec<Item>) {
    let is = |letter: char, value: f64| {
        words
            .iter()
            .any(|(l, x)| *l == letter && (x - value).abs() < 1e-6)
    };
    for (_, value) in words.iter().filter(|(letter, _)| *letter == 'G') {
        found.extend(
            offset_number(&crate::num::decimal(*value, 1))
                .map(|offset| Item::Active { offset, sent: true }),
        );
    }
    if [10.0, 92.0, 92.1, 92.2, 92.3, 43.0, 43.1, 43.2, 49.0]
        .iter()
        .any(|g| is('G', *g))
    {
        found.push(Item::Changes);
    } else if [38.2, 38.3, 38.4, 38.5].iter().any(|g| is('G', *g)) {
        found.push(Item::Probes);
    } else if [28.0, 30.0].iter().any(|g| is('G', *g))
        || words
            .iter()
            .any(|(letter, _)| matches!(letter, 'X' | 'Y' | 'Z'))
    {
        found.push(Item::Travels);
    }
    if is('M', 2.0) || is('M', 30.0) {
        found.push(Item::Ended);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Examples as grbl 1.1's interface document prints them.
    #[test]
    fn reports_say_what_they_say() {
        let at = Vec3::new;
        let status = "<Idle|MPos:5.000,2.000,0.000|Bf:15,128|FS:0,0|WCO:1.000,-2.500,0.000>";
        assert_eq!(
            items(status),
            [
                Item::Shift(at(1.0, -2.5, 0.0)),
                Item::Stands {
                    place: at(5.0, 2.0, 0.0),
                    work: false
                }
            ]
        );
        assert_eq!(
            items("<Run|WPos:5.000,2.000,0.000|WCS:G59.1>"),
            [Item::Active {
                offset: 7,
                sent: false
            }]
        );
        assert_eq!(
            items("[GC:G0 G55 G17 G21 G90 G94 M5 M9 T0 F0 S0]"),
            [Item::Active {
                offset: 2,
                sent: false
            }]
        );
        assert_eq!(
            items("[G54:1.000,2.000,-3.000] / [G92:0.000,0.000,0.500] / [TLO:-4.000] / ok"),
            [
                Item::Offset(1, at(1.0, 2.0, -3.0)),
                Item::Added(at(0.0, 0.0, 0.5)),
                Item::Length(at(0.0, 0.0, -4.0)),
                Item::Answered
            ]
        );
        assert_eq!(items("[G28:1.000,2.000,0.000]"), []);
        assert_eq!(items("$13=1 (report inches, bool)"), [Item::Inches(true)]);
        assert_eq!(items("$130=200.000"), []);
        let touch = Item::Touch {
            place: at(0.0, 0.0, 1.492),
            contact: true,
            prefix: "<<<".to_owned(),
        };
        assert_eq!(items("<<< [PRB:0.000,0.000,1.492:1]"), [touch]);
    }

    /// A block counts anywhere in the line of a sender, prose does not.
    #[test]
    fn blocks_are_found_behind_any_prompt() {
        for line in [
            "G55",
            ">>> G55",
            "[12:31:02] > n10 g55",
            "SEND: G55 ; second vise",
            "G55 < ok",
            "G21G55",
            ">G21G55:ok",
        ] {
            assert!(
                items(line).contains(&Item::Active {
                    offset: 2,
                    sent: true
                }),
                "{line}"
            );
        }
        for line in [
            "$N0=G55",
            "Job in G55 done",
            "(G55)",
            "[echo: G55]",
            "G5.5",
            "G550",
        ] {
            assert!(
                !items(line)
                    .iter()
                    .any(|item| matches!(item, Item::Active { .. })),
                "{line}"
            );
        }
        assert_eq!(items(">>> G38.2 Z-5 F100"), [Item::Probes]);
        assert_eq!(items(">>> G10 L20 P1 X0"), [Item::Changes]);
        assert_eq!(items(">>> $J=G91 X10 F500"), [Item::Moves]);
        for (line, in_contact) in [
            ("ALARM:5", false),
            ("ALARM:4", true),
            ("< ALARM:4 (Probe fail)", true),
            ("ALARM:45", false),
        ] {
            assert_eq!(items(line), [Item::Trouble { in_contact }], "{line}");
        }
    }
}
