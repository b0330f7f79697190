//! Whether a probing move is a touch or watched positioning: the program shows it afterwards.
//!
//! A touch without a contact, or a positioning move with one, leads away. So it is a positioning move if the first condition after it, before the next motion,
//! checks for a contact and then leaves: by a jump, a call, an alarm or an end. This reading is ours \[I\]: a program may do otherwise.
//!
//! Without variables a positioning move is a `G38.3` after which the next motion is a `G38.2` or `G38.3`, or the program ends: a probing move that begins in
//! contact is an alarm.

use crate::control::iso::lex::{code, head, lines_of, next_line, trimmed};
use crate::geom::AXIS_NAMES;

/// Whether a block contains the code of a probing move.
pub(super) fn has_probing_code(line: &[u8]) -> bool {
    let measures = |at: usize| {
        line[at..].get(..5).is_some_and(|word| {
            word[..4].eq_ignore_ascii_case(b"MEAS") || word[..4].eq_ignore_ascii_case(b"MEAW")
        })
    };
    memchr::memchr2_iter(b'G', b'g', line)
        .any(|at| matches!(line[at + 1..], [b'3', b'8', b'.', ..] | [b'3', b'1', ..]))
        || memchr::memchr2_iter(b'M', b'm', line).any(measures)
}

/// Behaviour of a program after a probing move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct AfterProbe {
    /// It checks for a contact.
    pub checks_contact: bool,
    /// It leaves after a contact: watched positioning.
    pub watched: bool,
    /// It reads the end of the move.
    pub reads: bool,
    /// The next motion is an alarm after a contact.
    pub chained: bool,
    /// It may check: a subprogram is called first, or a condition about the measurement leads to an unknown target.
    pub may_ask: bool,
}

/// Behaviour after a probing move, from the lines below its block.
pub(super) fn after_probe(line: &[u8], below: &str) -> AfterProbe {
    let lines = next_lines(below);
    let turn = lines.iter().position(|line| moves(line) || calls(line));
    let before = &lines[..turn.unwrap_or(lines.len())];
    // After a move that may miss, the current position is that of a positioning move.
    let may_miss = is_free_to_miss(line);
    let axis = single_axis(line);
    let reads = before.iter().any(|line| reads_place(line, may_miss, axis));
    let Some(at) = before
        .iter()
        .position(|line| asks(line))
        .or_else(|| asks_by_name(before))
    else {
        // A touch that is checked after its retract.
        let later = until_next_probe(&lines);
        let asked = later.iter().rposition(|line| asks(line));
        // Two touches may be compared with each other.
        let compared = || asks_for(&lines, &kept_in(&lines, later.len()));
        if let Some(at) = asks_by_name(later)
            .filter(|_| reads)
            .or(asked)
            .or_else(compared)
        {
            let leads_out = leads_to_alarm(&lines[at], lines.get(at + 1), below);
            return AfterProbe {
                checks_contact: leads_out,
                may_ask: !leads_out,
                reads,
                ..AfterProbe::default()
            };
        }
        let chained =
            !reads && is_free_to_miss(line) && begins_free(lines.get(before.len()), before);
        return AfterProbe {
            reads,
            chained,
            checks_contact: chained,
            watched: chained,
            may_ask: !reads && lines.get(before.len()).is_some_and(|line| calls(line)),
        };
    };
    let condition = &before[at];
    // A miss of G38.2 and G38.4 is an alarm: they are not positioning.
    let must = |at: usize| matches!(line[at + 1..], [b'3', b'8', b'.', b'2' | b'4', ..]);
    let touches = memchr::memchr2_iter(b'G', b'g', line).any(must) || !asks_for_contact(condition);
    let leaves_then = match condition.find("GOTO").or_else(|| condition.find("THEN")) {
        Some(_) => true,
        None => lines.get(at + 1).is_some_and(|line| leaves(line)),
    };
    AfterProbe {
        checks_contact: true,
        watched: !touches && leaves_then,
        reads,
        ..AfterProbe::default()
    }
}

/// Codes of the lines that run next: an unconditional jump continues at its block below.
fn next_lines(below: &str) -> Vec<String> {
    const MOST_LINES: usize = 16;
    const MOST_RAW: usize = 200;
    let (mut lines, mut rest) = (Vec::new(), below);
    for _ in 0..MOST_RAW {
        if rest.is_empty() || lines.len() == MOST_LINES {
            break;
        }
        let line = code_of(next_line(&mut rest));
        match line.strip_prefix("GOTO").map(|label| block_of(rest, label)) {
            Some(Some(block)) => rest = block,
            _ if line.is_empty() => {}
            _ => lines.push(line),
        }
    }
    lines
}

/// The text from the block with a number on.
fn block_of<'t>(text: &'t str, number: &str) -> Option<&'t str> {
    const MOST_LINES: usize = 2000;
    let number: u32 = number.parse().ok()?;
    let mut rest = text;
    for _ in 0..MOST_LINES {
        let here = rest;
        if rest.is_empty() {
            return None;
        }
        if head(trimmed(next_line(&mut rest)).as_bytes()).number == Some(number) {
            return Some(here);
        }
    }
    None
}

/// Whether a condition leads to an alarm: in its line, in the next one, or in the lines of the block that it jumps to.
fn leads_to_alarm(condition: &str, next: Option<&String>, below: &str) -> bool {
    const NEAR: usize = 8;
    // A jump may lead to the end of the program as well.
    let is_alarm = |line: &str| line.contains("#3000=");
    if condition.contains("THEN#3000=") {
        return true;
    }
    let Some((_, label)) = condition.split_once("GOTO") else {
        return next.is_some_and(|line| is_alarm(line) || leaves(line));
    };
    let codes = lines_of(block_of(below, label).unwrap_or_default())
        .take(NEAR)
        .map(code_of);
    codes
        .take_while(|line| !line.starts_with("M99"))
        .any(|line| is_alarm(&line))
}

/// The lines up to the next probing move.
fn until_next_probe(lines: &[String]) -> &[String] {
    let next = lines
        .iter()
        .position(|line| has_probing_code(line.as_bytes()));
    &lines[..next.unwrap_or(lines.len())]
}

/// Whether a block has `G38.3`.
fn is_free_to_miss(line: &[u8]) -> bool {
    memchr::memchr2_iter(b'G', b'g', line).any(|at| line[at + 1..].starts_with(b"38.3"))
}

/// Whether the next motion is a touch, or there is none before the program ends.
fn begins_free(next: Option<&String>, before: &[String]) -> bool {
    match next {
        Some(next) => next.starts_with("G38.2") || next.starts_with("G38.3"),
        None => before
            .iter()
            .any(|line| ["M2", "M02", "M30"].contains(&line.as_str())),
    }
}

/// The last condition that reads a variable with the position of the contact: `#148=#5063-30.`, then `IF[ABS[#148]GT0.05]`. An earlier condition continues if
/// the stylus is at its expected position.
fn asks_by_name(lines: &[String]) -> Option<usize> {
    asks_for(lines, &kept_in(lines, lines.len()))
}

/// The last condition that reads one of these variables.
fn asks_for(lines: &[String], names: &[&str]) -> Option<usize> {
    lines.iter().rposition(|line| {
        line.contains("IF[") && names.iter().any(|name| reads_position(line, name))
    })
}

/// Variables that receive the position of a contact in the first lines, and those computed from them: `#4=#5061-#24`, `#7=SQRT[#4*#4]`.
fn kept_in(lines: &[String], first: usize) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let Some((name, value)) = line.split_once('=') else {
            continue;
        };
        let is_name = name
            .strip_prefix('#')
            .is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()));
        let is_contact = at < first && reads_axis(value);
        if is_name && (is_contact || names.iter().any(|known| reads_position(value, known))) {
            names.push(name);
        }
    }
    names
}

/// Whether a line reads a variable.
fn reads_position(line: &str, name: &str) -> bool {
    let ends = |at: usize| {
        !line
            .as_bytes()
            .get(at + name.len())
            .is_some_and(u8::is_ascii_digit)
    };
    line.match_indices(name).any(|(at, _)| ends(at))
}

/// The code of a line without blanks, in capitals.
fn code_of(line: &str) -> String {
    let line = trimmed(line);
    // A comment that stops LinuxCNC is an end.
    if line.strip_prefix('(').is_some_and(|text| {
        text.trim_start()
            .get(..5)
            .is_some_and(|word| word.eq_ignore_ascii_case("abort"))
    }) {
        return "M2".to_owned();
    }
    let plain = code(&line[head(line.as_bytes()).end..], true);
    plain
        .bytes()
        .filter(|b| !b.is_ascii_whitespace())
        .map(|b| char::from(b.to_ascii_uppercase()))
        .collect()
}

fn moves(line: &str) -> bool {
    line.starts_with("MEAS")
        || is_cycle(line)
        || line.starts_with(['G', 'X', 'Y', 'Z'])
            && line.contains(['X', 'Y', 'Z'])
            && !["G53", "G10", "G92"]
                .iter()
                .any(|code| line.starts_with(code))
}

/// Whether it calls one of Renishaw's macros, which begin with moves.
fn is_cycle(line: &str) -> bool {
    line.starts_with("G65P98") || line.starts_with("G65P88")
}

/// Whether it calls a subprogram, and no alarm.
fn calls(line: &str) -> bool {
    let is_call = line.starts_with('O') && line.contains("CALL")
        || ["G65", "M98", "GOSUB", "CALL"]
            .iter()
            .any(|word| line.starts_with(word));
    is_call && !leaves(line) && !is_cycle(line)
}

/// The axis that a block names, if it names only one.
fn single_axis(line: &[u8]) -> Option<usize> {
    let code = code_of(&String::from_utf8_lossy(line));
    let mut named = (0..3).filter(|axis| code.contains(AXIS_NAMES[*axis]));
    named.next().filter(|_| named.next().is_none())
}

/// Whether a line reads or sets the position of the contact, or reads that of the axes, unless `only_contact`. The position of an axis gives the end of a touch
/// that moved only this axis; after other moves it is where the program continues.
fn reads_place(line: &str, only_contact: bool, axis: Option<usize>) -> bool {
    const CONTACT: [&str; 2] = ["$AA_", "G10L20"];
    const PRESENT: [&str; 4] = ["#542", "#<_X", "#<_Y", "#<_Z"];
    let has = |words: &[&str]| words.iter().any(|word| line.contains(word));
    let is_touched = |(group, own): (u8, usize)| group == b'6' || axis == Some(own);
    line.starts_with("G92")
        || axes_read(line).any(is_touched)
        || has(&CONTACT)
        || !only_contact && has(&PRESENT)
}

/// Whether it reads a position of an axis.
fn reads_axis(line: &str) -> bool {
    axes_read(line).next().is_some()
}

/// Positions that a line reads, as group and axis: the trigger of the last probing move (#5061 to #5069), the position of the axis (#5041, on a Fanuc #5001).
fn axes_read(line: &str) -> impl Iterator<Item = (u8, usize)> {
    line.match_indices("#50")
        .filter_map(|(at, _)| match line.as_bytes()[at + 3..] {
            [
                group @ (b'0' | b'4' | b'6'),
                axis @ b'1'..=b'9',
                ref rest @ ..,
            ] if !rest.first().is_some_and(u8::is_ascii_digit) => {
                Some((group, usize::from(axis - b'1')))
            }
            _ => None,
        })
}

/// Whether it is a condition about the last probing move.
fn asks(line: &str) -> bool {
    // A Haas checks in the probing block itself. An LNC checks R_SKIP, an Eding #5067.
    const TRIGGERED: [&str; 2] = ["#5070", "R_SKIP"];
    let is_about_it = reads_axis(line) || TRIGGERED.iter().any(|name| line.contains(name));
    line.contains("IF[") && is_about_it || line.starts_with("IF") && line.contains("$AC_MEA[1]")
}

/// Whether a line is a condition that checks something else.
pub(super) fn judges(line: &[u8]) -> bool {
    let begins = memchr::memchr2_iter(b'F', b'f', line)
        .any(|at| at > 0 && line[at - 1].eq_ignore_ascii_case(&b'I'));
    begins && {
        let code = code_of(&String::from_utf8_lossy(line));
        (code.starts_with("IF") || code.starts_with('O') && code.contains("IF[")) && !asks(&code)
    }
}

/// Whether the condition holds after a contact: by #5070 and `$AC_MEA[1]`, on a Fanuc by a position that is not the target.
fn asks_for_contact(condition: &str) -> bool {
    match condition
        .split_once("#5070")
        .or_else(|| condition.split_once("$AC_MEA[1]"))
        .or_else(|| condition.split_once("#5067"))
        .or_else(|| condition.split_once("R_SKIP[0,1]"))
    {
        Some((_, rest)) => ["EQ1", "NE0", "GT0", "EQ[1", "==1", "<>0", ">0"]
            .iter()
            .any(|word| rest.starts_with(word)),
        None => ["GT", "NE", "GE"]
            .iter()
            .any(|word| condition.contains(word)),
    }
}

/// Whether a block leaves the run: an end, an alarm, a return, or a call with such a name.
fn leaves(line: &str) -> bool {
    const ENDS: [&str; 4] = ["M2", "M02", "M30", "#3000="];
    const EXITS: [&str; 6] = ["EXIT", "ABORT", "ALARM", "ERROR", "FAIL", "COLLI"];
    ENDS.iter().any(|word| line.starts_with(word))
        || line.starts_with('O')
            && (line.contains("RETURN") || EXITS.iter().any(|word| line.contains(word)))
}
