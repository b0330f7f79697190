//! The state of a program at a place: what is active there, and what the blocks below it rely on.

use super::words::{has_code, parted, words};
use crate::control::iso::lex::{strip_prefix_nocase, trimmed, without_number};
use crate::control::{header, inside};
use crate::text::{Text, text};

/// Codes of one group: the last of them is active.
const GROUPS: [&[&str]; 3] = [
    &["G90", "G91"],
    &["G93", "G94", "G95"],
    &["G17", "G18", "G19"],
];

/// Codes that move, rotate, scale or mirror the coordinate system, and those that end it.
const TRANSFORMS: [(&[&str], &[&str]); 4] = [
    (&["G68", "G68.2", "G68.3", "G68.4"], &["G69", "G69.1"]),
    (&["G51"], &["G50"]),
    (&["G51.1"], &["G50.1"]),
    (&["G16"], &["G15"]),
];

/// Frames of a SINUMERIK.
const FRAMES: [&str; 8] = [
    "ATRANS", "AROT", "ASCALE", "AMIRROR", "TRANS", "ROT", "SCALE", "MIRROR",
];

/// Codes of a motion. A canned cycle has its own.
const MOTIONS: [&str; 7] = ["G0", "G1", "G2", "G3", "G28", "G30", "G31"];

/// The G codes of a block, without leading zeros.
fn codes(code: &str) -> Vec<String> {
    let number = |value: &str| value.trim_start_matches('0').to_owned();
    words(code)
        .filter(|(letter, _)| *letter == 'G')
        .map(|(_, value)| match number(value) {
            short if short.is_empty() || short.starts_with('.') => format!("G0{short}"),
            short => format!("G{short}"),
        })
        .collect()
}

fn is_axis(letter: char) -> bool {
    matches!(letter, 'X' | 'Y' | 'Z')
}

/// Whether an axis word of a block is anything but 0.
fn shifts(code: &str) -> bool {
    let is_zero = |value: &str| crate::num::read(value).is_some_and(|value| value == 0.0);
    words(code).any(|(letter, value)| (is_axis(letter) || letter == 'R') && !is_zero(value))
}

/// The 0-based line of a shift, a rotation, a scale or a mirror that is active after these lines.
fn transformed(lines: &[&str], sinumerik: bool) -> Option<usize> {
    let mut active: Vec<(&str, usize)> = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let (code, _) = parted(line);
        let mut set = |kind: &'static str, on: bool| {
            active.retain(|(known, _)| *known != kind);
            if on {
                active.push((kind, index));
            }
        };
        let own = codes(&code);
        let has = |list: &[&str]| own.iter().any(|code| list.contains(&code.as_str()));
        let axes = words(&code).any(|(letter, _)| is_axis(letter));
        for (begins, ends) in TRANSFORMS {
            if has(ends) {
                set(begins[0], false);
            }
            if has(begins) {
                set(begins[0], true);
            }
        }
        if has(&["G52"]) && axes {
            set("G52", shifts(&code));
        }
        if has(&["G92"]) && axes {
            set("G92", true);
        }
        if has(&["G92.1", "G92.2"]) {
            set("G92", false);
        }
        // On other controls these are work offsets.
        if sinumerik && has(&["G58", "G59"]) && axes {
            set("G58", true);
        }
        if has(&["G10"]) && words(&code).any(|(letter, _)| letter == 'R') && has_code(&code, 'L', 2)
        {
            let rotated = words(&code).any(|(letter, value)| {
                letter == 'R' && crate::num::read(value).is_none_or(|value| value != 0.0)
            });
            set("G10", rotated);
        }
        // A SINUMERIK's brackets are no comments.
        let plain = without_number(trimmed(line)).to_ascii_uppercase();
        if let Some(rest) = plain.strip_prefix("CYCLE800(") {
            set("CYCLE800", !rest.starts_with(')'));
        }
        if let Some(rest) = FRAMES.iter().find_map(|frame| plain.strip_prefix(frame)) {
            let rest = rest.split(';').next().unwrap_or(rest);
            set("FRAME", !rest.trim().is_empty());
        }
    }
    active.first().map(|(_, line)| *line)
}

/// The 0-based line that keeps the place after these lines from being reached exactly once: an end, a jump without a condition, or the beginning of a structure
/// that is still open. Inserted programs are skipped: they jump to their own end.
fn bars(lines: &[&str]) -> Option<usize> {
    let mut open: Vec<(usize, bool)> = Vec::new();
    let mut bar = None;
    let mut inside = false;
    for (index, line) in lines.iter().enumerate() {
        let plain = trimmed(line);
        if is_marker(plain, inside::BEGINS) || is_marker(plain, inside::ENDS) {
            inside = is_marker(plain, inside::BEGINS);
        }
        if inside {
            continue;
        }
        let (code, _) = parted(line);
        let code = trimmed(code.trim_start_matches('/'));
        // `o100 while`, `o<name> sub`
        let (is_o, blocks) = match code.strip_prefix('O') {
            Some(label) => (
                true,
                label
                    .trim_start_matches(|c: char| c != ' ' && c != '>')
                    .trim_start_matches(['>', ' ']),
            ),
            None => (false, code),
        };
        let word = blocks
            .split(|c: char| !c.is_ascii_alphanumeric())
            .next()
            .unwrap_or("");
        let jumps = code.contains("GOTO");
        let begins = match word {
            "SUB" | "DO" => is_o,
            "WHILE" | "REPEAT" | "IF" | "FOR" | "LOOP" => !jumps && !code.contains("THEN"),
            _ => false,
        };
        let ends_do = is_o && word == "WHILE" && open.last().is_some_and(|(_, is_do)| *is_do);
        if ends_do || word.starts_with("END") || word == "UNTIL" {
            open.pop();
        } else if begins {
            open.push((index, word == "DO"));
        } else if open.is_empty() {
            let ends = ["M30", "M2", "M02", "M99", "M17", "RET"].contains(&word);
            let jumps = word.starts_with("GOTO");
            bar = bar.or((ends || jumps).then_some(index));
        }
    }
    bar.or(open.first().map(|(index, _)| *index))
}

fn is_marker(line: &str, words: &str) -> bool {
    header::comment(line).is_some_and(|comment| strip_prefix_nocase(comment, words).is_some())
}

/// The last code of a group in these lines.
fn last(group: &[&str], lines: &[&str]) -> Option<String> {
    lines.iter().rev().find_map(|line| {
        codes(&parted(line).0)
            .into_iter()
            .rev()
            .find(|code| group.contains(&code.as_str()))
    })
}

/// The last work offset that these lines select: `G54`, `G54.1 P3`, `G154 P2`, `G15 H2`, `G505`.
pub fn offset(lines: &[&str]) -> Option<String> {
    lines.iter().rev().find_map(|line| {
        let (code, _) = parted(line);
        let of = |letter| words(&code).find(|(known, _)| *known == letter);
        let own = codes(&code).into_iter().rev().find(|code| {
            let number = code.strip_prefix('G').and_then(crate::num::read);
            number.is_some_and(|n| {
                (54.0..60.0).contains(&n) || n == 154.0 || (505.0..600.0).contains(&n)
            }) || code == "G15" && of('H').is_some()
        })?;
        let number = ['P', 'H']
            .into_iter()
            .find_map(of)
            .filter(|_| !own.starts_with("G5") || own == "G54.1");
        Some(number.map_or(own.clone(), |(letter, value)| {
            format!("{own} {letter}{value}")
        }))
    })
}

/// What depends on the control.
#[derive(Clone, Copy, Debug)]
pub struct Habits {
    /// Whether G58 and G59 shift the coordinate system.
    pub sinumerik: bool,
    /// Whether the inserted lines end with the modes before them.
    pub restores: bool,
}

/// Refuses a place at which the inserted lines, or the blocks below them, would do something else.
pub fn check(lines: &[&str], place: usize, own: &[&str], habits: Habits) -> Result<(), Text> {
    let above = &lines[..=place];
    if let Some(line) = bars(above) {
        return Err(text!(
            "The place is not reached exactly once, because of line {line} of your program",
            line + 1
        ));
    }
    if let Some(line) = transformed(above, habits.sinumerik) {
        return Err(text!(
            "A shift, a rotation, a scale or a mirror of line {line} is active there",
            line + 1
        ));
    }
    for group in GROUPS.iter().filter(|_| !habits.restores) {
        if let (Some(before), Some(after)) = (last(group, above), last(group, own))
            && before != after
        {
            return Err(text!(
                "{before} is active there, and {after} after the inserted lines",
                before,
                after
            ));
        }
    }
    let (mut motion, mut feed) = (false, false);
    for (index, line) in lines.iter().enumerate().skip(place + 1) {
        let (code, _) = parted(line);
        let own = codes(&code);
        motion |= own.iter().any(|code| {
            MOTIONS.contains(&code.as_str())
                || ["G38.", "G7", "G8"]
                    .iter()
                    .any(|begin| code.starts_with(begin) && code.len() > 2)
        });
        feed |= words(&code).any(|(letter, _)| letter == 'F');
        let moves = words(&code).any(|(letter, _)| is_axis(letter))
            && !own.iter().any(|code| {
                ["G43", "G44", "G52", "G92", "G10", "G4", "G65", "G66"].contains(&code.as_str())
            });
        let cuts = own
            .iter()
            .any(|code| ["G1", "G2", "G3"].contains(&code.as_str()));
        if moves && !motion || cuts && !feed {
            return Err(text!(
                "Line {line} of your program states no motion code or no feed: it would have those of the inserted lines",
                index + 1
            ));
        }
        if feed && motion || strip_prefix_nocase(trimmed(&code), "M30").is_some() {
            break;
        }
    }
    Ok(())
}
