//! Judges whether lines of the shop may be in a program. A line is understood only if it is known to be harmless on the control. A line that may be harmful is
//! refused, and any other one is not checked.

use super::klartext;
use super::place::Place;
use super::state::{
    Coordinates, Judged, Mode, State, assigns, decides, moves_otherwise, spindle, transforms,
    writes,
};
use crate::control::iso::block::Block;
use crate::control::iso::codes::{Effect, FRAMES, Family};
use crate::control::iso::lex::{Comment, head, strip_prefix_nocase, trimmed};
use crate::control::iso::lines::split_comment;
use crate::control::iso::script::Motion;
use crate::control::{PostDef, Request};
use crate::text::{Text, text};

/// What is known about a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Judgement {
    Understood,
    Unknown,
    Refused(Text),
}

/// Judges the lines of a place in order.
pub fn judge(request: &Request<'_>, place: &Place, lines: &[String]) -> Vec<Judgement> {
    let mut state = State::new(request, place);
    let mut judged: Vec<Judgement> = lines
        .iter()
        .enumerate()
        .map(|(index, line)| {
            state.index = index;
            let known = match request.post.family {
                Family::Heidenhain => klartext::judge(&mut state, line),
                family => word_address(&mut state, line, family),
            };
            match known {
                Ok(true) => Judgement::Understood,
                Ok(false) => Judgement::Unknown,
                Err(why) => Judgement::Refused(why),
            }
        })
        .collect();
    for (mode, index, code) in &state.left {
        if !matches!(judged[*index], Judgement::Refused(_)) {
            judged[*index] = Judgement::Refused(text!(
                "{code} is still active after these lines. End them with {own}",
                code.clone(),
                state.own_code(*mode)
            ));
        }
    }
    judged
}

/// Letters of words that are understood.
const LETTERS: &[u8] = b"GMTHDSFPXYZ";

/// Letters of other axes.
const MORE_AXES: &[u8] = b"ABCUVW";

/// Codes without a row of their own that are harmless on every control.
const HARMLESS: [&str; 5] = ["M0", "M1", "M9", "G40", "G80"];

/// Words at the beginning of a line that decides the way, or calls something at every later move.
const DECIDING: [&str; 13] = [
    "IF", "WHILE", "DO", "FOR", "LOOP", "REPEAT", "REPEATB", "UNTIL", "CASE", "ELSE", "RET",
    "MCALL", "MODIN",
];

fn word_address(state: &mut State<'_>, line: &str, family: Family) -> Judged {
    let post = state.request.post;
    let sign = if family == Family::Iso { b'(' } else { b';' };
    let (code, comment) = split_comment(line, sign).map_err(|why| *why)?;
    check_comment(post, comment)?;
    let sent = !post.dialect.capitals && line.contains(['?', '!', '~']);
    if family == Family::Iso && (sent || line.contains('%')) {
        return Err(text!(
            "%, ?, ! and ~ have a meaning for the control or its sender"
        ));
    }
    let prefix = head(code.as_bytes());
    let code = unquoted(trimmed(code)).to_ascii_uppercase();
    if prefix.skips || prefix.number.is_some() || is_deciding(&code, family) {
        return Err(decides());
    }
    // The call of an O word is not followed: `o<probe_on> call`, and an Okuma's `CALL O9832`.
    let calls = code.starts_with("CALL O") || !post.dialect.capitals && code.starts_with('O');
    if family == Family::Iso && calls {
        return Ok(false);
    }
    if FRAMES.iter().any(|frame| code.starts_with(frame)) || code.starts_with("CYCLE800") {
        let ends = FRAMES.contains(&code.as_str()) || code == "CYCLE800()";
        return if ends { Ok(false) } else { Err(transforms()) };
    }
    let supa = family == Family::Sinumerik && code.contains("SUPA");
    let code = if supa { code.replace("SUPA", "") } else { code };
    let (code, assigned) = without_assigned(state, &code)?;
    let block = Block::of(&code, family);
    if [b'N', b'O'].iter().any(|letter| block.has(*letter)) || is_split(&code) {
        return Err(decides());
    }
    let rest = block.letters().all(|letter| {
        let count = block.letters().filter(|own| *own == letter).count();
        LETTERS.contains(&letter) && (count == 1 || matches!(letter, b'G' | b'M'))
    });
    let mut known = rest && assigned && is_words(&code);
    if block.letters().any(|letter| MORE_AXES.contains(&letter)) {
        state.may_move()?;
    }
    known &= tool_and_length(state, &block)?;
    let coordinates = if supa {
        Coordinates::Machine
    } else {
        Coordinates::Work
    };
    Ok(codes(state, &block, coordinates)? && known)
}

/// The codes of a block, and its move.
fn codes(state: &mut State<'_>, block: &Block, mut coordinates: Coordinates) -> Judged {
    let post = state.request.post;
    // Where G54 is no work offset, other G codes differ as well.
    let differs = !(post.work_offset_word)(1).starts_with("G54") && post.work_offsets > 0;
    let mut known = block.knows_codes();
    let (mut motion, mut position, mut is_foreign) = (false, block.has_axes(), false);
    for (effect, code) in block.effects() {
        if differs
            && !["G0", "G1", "G4", "G90", "G91"].contains(&code.as_str())
            && code.starts_with('G')
        {
            let offset = (post.work_offset_word)(1);
            if offset.split(' ').next() == Some(code.as_str()) {
                state.offset()?;
            }
            is_foreign = true;
            continue;
        }
        known &= effect_of(state, block, effect, &code)?;
        match effect {
            Effect::Machine => coordinates = Coordinates::Machine,
            Effect::Home => (coordinates, position) = (Coordinates::Home, true),
            Effect::Motion(_) => motion = true,
            Effect::Macro { .. } | Effect::Call(_) => position = false,
            _ => {}
        }
    }
    if is_foreign {
        if position {
            state.may_move()?;
        }
        return Ok(false);
    }
    // `G4 X1.` waits on a Fanuc and its kin; any other axis word moves.
    let waits = block.does(|effect| effect == Effect::Dwell)
        && post.dialect.capitals
        && ![b'Y', b'Z'].iter().any(|axis| block.has(*axis));
    if position && (motion || !waits) {
        let axes = [b'X', b'Y', b'Z'].map(|axis| {
            let number = || block.number(axis).unwrap_or(f64::NAN);
            block.has(axis).then(number)
        });
        let others = block.letters().any(|letter| MORE_AXES.contains(&letter));
        known &= match coordinates {
            Coordinates::Home if others || post.family == Family::Sinumerik => false,
            // A stored position, or the second reference point, need not be the top.
            Coordinates::Home if !post.dialect.capitals || !block.does_code("G28") => {
                state.moves(axes, state.is_incremental(), coordinates)?;
                false
            }
            _ => state.moves(axes, state.is_incremental(), coordinates)?,
        };
    }
    Ok(known && !(waits && motion))
}

/// Beginnings of comments that LinuxCNC obeys.
const ACTING: [&str; 9] = [
    "ABORT,",
    "PY,",
    "PYRUN,",
    "PYRELOAD",
    "LOG,",
    "LOGOPEN",
    "LOGAPPEND",
    "LOGCLOSE",
    "PROBEOPEN",
];

/// Beginning of the comments around an inserted program.
const OWN: &str = "Touchpath";

/// Whether the comment of a line is one on this control, without an effect.
fn check_comment(post: &PostDef, comment: Option<Comment<'_>>) -> Result<(), Text> {
    let Some(Comment { sign, text }) = comment else {
        return Ok(());
    };
    let (open, close) = post.dialect.comment;
    if post.dialect.capitals && sign == b';' {
        return Err(text!(
            "\";\" ends a block on this control. Write a comment as {comment}",
            format!("{open}TEXT{close}")
        ));
    }
    let begins = |word: &str| strip_prefix_nocase(text, word).is_some();
    let acts = !post.dialect.capitals && ACTING.iter().any(|word| begins(word));
    if acts || begins(OWN) {
        return Err(text!(
            "This comment has an effect on the control, or is one of the program's own"
        ));
    }
    Ok(())
}

/// The tool, and its length: after the program's checks they must not change.
fn tool_and_length(state: &mut State<'_>, block: &Block) -> Judged {
    if block.has(b'T') {
        state.tool(block.number(b'T'))?;
    }
    let length = block.has(b'H') || block.does(|effect| matches!(effect, Effect::Length(_)));
    let edge = state.request.post.family == Family::Sinumerik && block.has(b'D');
    if edge {
        state.length(block.number(b'D') != Some(0.0), "D0")?;
    } else if block.has(b'D') {
        return Ok(false);
    }
    let calls = block.does(|effect| matches!(effect, Effect::Macro { .. } | Effect::Call(_)));
    if !length || calls {
        return Ok(true);
    }
    let activates = block.does(|effect| effect == Effect::Length(true));
    if block.has(b'H') && !activates {
        return Ok(false);
    }
    match (block.number(b'H'), state.request.tool) {
        (Some(own), Some(tool)) if own != f64::from(tool) => Err(state.other_tool()),
        _ => Ok(true),
    }
}

/// Whether a code of a line is understood, or why it cannot be there.
fn effect_of(state: &mut State<'_>, block: &Block, effect: Effect, code: &str) -> Judged {
    let request = state.request;
    match effect {
        Effect::Motion(Motion::Rapid | Motion::Straight)
        | Effect::Dwell
        | Effect::Machine
        | Effect::Home
        | Effect::Turn(false)
        | Effect::Polar(false) => {}
        Effect::Plane(plane) => state.mode(Mode::Plane, plane == request.plane, code),
        Effect::Metric(metric) => state.mode(Mode::Units, metric == (request.scale == 1.0), code),
        Effect::Absolute(absolute) => state.mode(Mode::Distance, absolute, code),
        Effect::PerMinute(per_minute) => state.mode(Mode::Feed, per_minute, code),
        Effect::Spindle(true) => return Err(spindle()),
        // M5 may release an oriented spindle.
        Effect::Spindle(false) => return Ok(state.may_release_spindle()),
        Effect::Length(on) => {
            state.length(on, code)?;
            return Ok(["G43", "G49"].contains(&code));
        }
        Effect::LengthGiven { .. } => {
            state.length(true, code)?;
            return Ok(false);
        }
        Effect::Tool => state.tool(None)?,
        // Other controls use these numbers for other things.
        Effect::Offset(_)
            if code.starts_with("G1")
                && !(request.post.work_offset_word)(7).starts_with("G154") =>
        {
            return Ok(false);
        }
        Effect::Offset(_) | Effect::OffsetOf(_) => state.offset()?,
        Effect::Call(97) | Effect::Return | Effect::End => return Err(decides()),
        Effect::Macro { .. } if code.starts_with("G66") => return Err(moves_otherwise()),
        Effect::Motion(_) | Effect::Once(_) | Effect::Cycle | Effect::ThereAndBack => {
            return Err(moves_otherwise());
        }
        Effect::Setting => return Err(writes()),
        Effect::Shift(_) if block.is_at_zero() && block.has_axes() => return Ok(false),
        Effect::Shift(_) | Effect::Turn(true) | Effect::Polar(true) | Effect::Transform { .. } => {
            return Err(transforms());
        }
        // Codes of LinuxCNC, and the look-ahead of a Haas.
        Effect::Keep { .. } | Effect::Forget | Effect::GiveBack
            if !request.post.dialect.capitals =>
        {
            return Err(text!("The program itself sets and restores this mode"));
        }
        Effect::Ahead => return Err(text!("The program itself sets and restores this mode")),
        Effect::Pause if state.is_before_write() => {
            return Err(text!("Set control.ask for a stop before the write"));
        }
        _ => return Ok(HARMLESS.contains(&code)),
    }
    Ok(true)
}

/// A code without the texts in its quotes.
fn unquoted(code: &str) -> String {
    code.split('"').step_by(2).collect::<Vec<_>>().join("\"\"")
}

/// Whether a line decides the way of the program, or is a label. `O<PROBE_ON> CALL` is a call.
fn is_deciding(code: &str, family: Family) -> bool {
    let length = code
        .find(|c: char| !c.is_ascii_alphabetic())
        .unwrap_or(code.len());
    let is_label = family == Family::Iso && code.starts_with('O') && !code.contains("CALL");
    is_label
        || DECIDING.contains(&&code[..length])
        || code.starts_with("END")
        || code.starts_with("M96")
        || code.contains("GOTO")
        || code.contains(':')
}

/// Whether a number has a blank inside: `M3 0` is M30 on a control that drops blanks.
fn is_split(code: &str) -> bool {
    let is_number = |c: char| c.is_ascii_digit() || c == '.';
    code.split(' ')
        .collect::<Vec<_>>()
        .windows(2)
        .any(|words| words[0].ends_with(is_number) && words[1].starts_with(is_number))
}

/// A code with `X5` in place of `X=5`, without other words like `T="PROBE"` and `SPOS=90`, and whether it had only a tool among them. Assigned variables are
/// refused.
fn without_assigned(state: &mut State<'_>, code: &str) -> Result<(String, bool), Text> {
    let (mut rest, mut only) = (code.to_owned(), true);
    while let Some(at) = rest.find('=') {
        let is_name = |c: char| c.is_ascii_alphanumeric() || "_$#[]<>,".contains(c);
        let begin = rest[..at].trim_end_matches(is_name).len();
        let end = rest[at + 1..]
            .find(' ')
            .map_or(rest.len(), |end| at + 1 + end);
        let (name, value) = (rest[begin..at].to_owned(), rest[at + 1..end].to_owned());
        let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let address = letters.len() == 1 && !["R", "Q", "#"].contains(&letters);
        let setting = ["ADIS", "FP", "HP"].contains(&name.as_str())
            || name.starts_with("SPOS")
            || name.starts_with("$A_");
        if !(address || setting) {
            return Err(assigns());
        }
        if name == "T" {
            state.tool(crate::num::read(&value))?;
            rest.replace_range(begin..end, "");
        } else {
            only = false;
            if name.starts_with("SPOS") {
                state.may_move()?;
            }
            let is_word = letters == name && address;
            let word = if is_word {
                format!("{name}{value}")
            } else {
                String::new()
            };
            rest.replace_range(begin..end, &word);
        }
    }
    Ok((rest, only))
}

/// Whether a code consists of letters with numbers.
fn is_words(code: &str) -> bool {
    let mut rest = trimmed(code);
    while let Some(letter) = rest.chars().next() {
        let value = match letter.is_ascii_uppercase() {
            true => rest[1..].trim_start(),
            false => return false,
        };
        let after = value.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        if after.len() == value.len() {
            return false;
        }
        rest = after.trim_start();
    }
    true
}
