//! What the shop's lines do: whether they may be in a program, by the table of codes that every reader uses.

use super::klartext;
use super::place::Place;
use super::state::{Coordinates, Judged, Mode, State, assigns, decides, transforms};
use crate::control::Request;
use crate::control::iso::block::Block;
use crate::control::iso::codes::{Effect, FRAMES, Family};
use crate::control::iso::lex::{head, strip_prefix_nocase, trimmed};
use crate::control::iso::script::Motion;
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
    let mut state = State {
        request,
        place,
        raised: false,
        left: Vec::new(),
    };
    let mut judged: Vec<Judgement> = lines
        .iter()
        .enumerate()
        .map(|(index, line)| {
            let known = match request.post.family {
                Family::Heidenhain => klartext::judge(&mut state, index, line),
                family => word_address(&mut state, index, &Block::of(line, family), line),
            };
            match known {
                Ok(true) => Judgement::Understood,
                Ok(false) => Judgement::Unknown,
                Err(why) => Judgement::Refused(why),
            }
        })
        .collect();
    for (_, index, code) in state.left {
        if matches!(judged[index], Judgement::Understood) {
            judged[index] = Judgement::Refused(text!(
                "{code} is still active after these lines. End them with the opposite code",
                code
            ));
        }
    }
    judged
}

fn probes() -> Text {
    text!("Only straight moves are possible here: no probing, no arcs, no cycles")
}

/// Words at the beginning of a line that decides the way.
const DECIDING: [&str; 11] = [
    "IF", "WHILE", "DO", "FOR", "LOOP", "REPEAT", "UNTIL", "CASE", "ELSE", "RET", "%",
];

/// Names of assigned words that are no variables.
const ADDRESSES: [&str; 7] = ["T", "D", "S", "M", "H", "SPOS", "SPOSA"];

fn word_address(state: &mut State<'_>, index: usize, block: &Block, line: &str) -> Judged {
    let code = &unquoted(trimmed(&block.code));
    let aborts = strip_prefix_nocase(&block.comment, "ABORT").is_some();
    if aborts || head(line.as_bytes()).number.is_some() || is_deciding(code) {
        return Err(decides());
    }
    if code
        .match_indices('=')
        .any(|(at, _)| !is_address(&code[..at]))
    {
        return Err(assigns());
    }
    if FRAMES.iter().any(|frame| code.starts_with(frame)) || code.starts_with("CYCLE800") {
        return Err(transforms());
    }
    let mut known = is_words(&code.replace("SUPA", ""));
    let mut coordinates = match code.contains("SUPA") {
        true => Coordinates::Machine,
        false => Coordinates::Work,
    };
    let mut has_position = block.has_axes();
    for (effect, code) in block.effects() {
        known &= judge_effect(state, index, effect, &code)?;
        match effect {
            Effect::Machine => coordinates = Coordinates::Machine,
            Effect::Home => {
                coordinates = Coordinates::Home;
                has_position = true;
            }
            Effect::Dwell | Effect::Macro { .. } | Effect::Call(_) => has_position = false,
            _ => {}
        }
    }
    known &= block.knows_codes();
    if block.has(b'T') {
        state.tool()?;
    }
    if let (Family::Sinumerik, Some(edge)) = (state.request.post.family, block.number(b'D')) {
        state.length(index, edge != 0.0, "D0");
    }
    if has_position {
        let axes = [b'X', b'Y', b'Z'].map(|axis| {
            let number = || block.number(axis).unwrap_or(f64::NAN);
            block.has(axis).then(number)
        });
        if coordinates == Coordinates::Home && axes == [None; 3] {
            return Err(text!("Without an axis word, this code moves every axis"));
        }
        state.moves(axes, state.is_incremental(), coordinates)?;
    }
    Ok(known)
}

/// Whether a code of a line is understood, or why it cannot be there.
fn judge_effect(state: &mut State<'_>, index: usize, effect: Effect, code: &str) -> Judged {
    let request = state.request;
    match effect {
        Effect::Motion(Motion::Rapid | Motion::Straight)
        | Effect::Exact(_)
        | Effect::LengthGiven { .. }
        | Effect::Dwell
        | Effect::CycleEnds
        | Effect::Machine
        | Effect::Home
        | Effect::Halt
        | Effect::Ahead
        | Effect::Pause
        | Effect::Turn(false)
        | Effect::Polar(false)
        | Effect::Nothing => {}
        Effect::Plane(plane) => state.mode(Mode::Plane, index, plane == request.plane, code),
        Effect::Metric(metric) => {
            state.mode(Mode::Units, index, metric == (request.scale == 1.0), code)
        }
        Effect::Absolute(absolute) => state.mode(Mode::Distance, index, absolute, code),
        Effect::PerMinute(per_minute) => state.mode(Mode::Feed, index, per_minute, code),
        Effect::Spindle(on) => state.mode(Mode::Spindle, index, !on, code),
        Effect::Length(on) => state.length(index, on, code),
        Effect::Tool => return state.tool(),
        Effect::Offset(_) | Effect::OffsetOf(_) if state.place.offset => {}
        Effect::Offset(_) | Effect::OffsetOf(_) => {
            return Err(text!(
                "A work offset must be selected at the top, at \"probe on\" or at the end"
            ));
        }
        Effect::Call(97) | Effect::Return | Effect::End => return Err(decides()),
        Effect::Macro { .. } if code.starts_with("G66") => return Err(probes()),
        Effect::Macro { .. } | Effect::Call(_) | Effect::Sets | Effect::ProbeFeed => {
            return Ok(false);
        }
        Effect::Motion(_)
        | Effect::Once(_)
        | Effect::Contact(_)
        | Effect::Curve { .. }
        | Effect::ControlPoints(_)
        | Effect::Cycle
        | Effect::ThereAndBack => return Err(probes()),
        Effect::Setting
        | Effect::Shift(_)
        | Effect::Turn(true)
        | Effect::Polar(true)
        | Effect::Transform { .. }
        | Effect::Elsewhere
        | Effect::Diameter(_)
        | Effect::CentersAbsolute(_) => return Err(transforms()),
        Effect::Keep { .. } | Effect::Forget | Effect::GiveBack => {
            return Err(text!("The program itself saves and restores the modes"));
        }
    }
    Ok(true)
}

/// A code without the texts in its quotes.
fn unquoted(code: &str) -> String {
    code.split('"').step_by(2).collect::<Vec<_>>().join("\"\"")
}

/// Whether a line decides the way of the program, or is a label.
fn is_deciding(code: &str) -> bool {
    // `O<PROBE_ON> CALL` is a call, any other O word is not.
    if let Some(label) = code.strip_prefix('O') {
        let word = label
            .trim_start_matches(|c: char| c != ' ' && c != '>')
            .trim_start_matches(['>', ' ']);
        return !word.starts_with("CALL");
    }
    let length = code
        .find(|c: char| !c.is_ascii_alphabetic() && c != '%')
        .unwrap_or(code.len());
    DECIDING.contains(&&code[..length])
        || code.starts_with("END")
        || code.contains("GOTO")
        || code.contains(':')
}

/// Whether the name before `=` is a word of the block, not a variable.
fn is_address(before: &str) -> bool {
    let is_name = |c: char| c.is_ascii_alphanumeric() || "_$#[]<>,".contains(c);
    let name = &before[before.trim_end_matches(is_name).len()..];
    ADDRESSES.contains(&name.trim_end_matches(|c: char| c.is_ascii_digit()))
}

/// Whether a code consists of letters with numbers, and of assigned words.
fn is_words(code: &str) -> bool {
    let mut rest = trimmed(code);
    while let Some(letter) = rest.chars().next() {
        let address = ADDRESSES
            .iter()
            .filter_map(|name| rest.strip_prefix(name)?.strip_prefix('='))
            .next();
        let value = match address {
            Some(quoted) if quoted.starts_with('"') => {
                let Some((_, after)) = quoted[1..].split_once('"') else {
                    return false;
                };
                rest = after.trim_start();
                continue;
            }
            Some(value) => value,
            None if letter.is_ascii_uppercase() => rest[1..].trim_start(),
            None => return false,
        };
        let after = value.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        if after.len() == value.len() {
            return false;
        }
        rest = after.trim_start();
    }
    true
}
