//! Blocks of words: `G1 X10 F100`.

use crate::control::iso::codes::{Effect, effect};
use crate::control::iso::parse::{Cursor, Grammar, Names, Parsed, fault};
use crate::control::iso::script::{BlockKind, Modes, Motion, NodeId, Script, Words};
use crate::text::text;

/// Codes that every strict reader accepts; no letters are allowed beside them.
pub fn common(letter: u8, tenths: i32) -> Option<&'static str> {
    match (letter, tenths) {
        (b'G', 0 | 10 | 170 | 180 | 190 | 400 | 900 | 940)
        | (b'M', 0 | 30 | 40 | 50 | 90 | 300) => Some(""),
        _ => None,
    }
}

/// Codes of the RS274 family: LinuxCNC, grbl and compatible controls.
pub fn rs274(letter: u8, tenths: i32) -> Option<&'static str> {
    match (letter, tenths) {
        (b'G', 20 | 30 | 80 | 100 | 200 | 210 | 382 | 383 | 490 | 610 | 640 | 800 | 911) => {
            Some("")
        }
        (b'G', 540 | 550 | 560 | 570 | 580 | 590 | 591..=593) | (b'M', 20 | 700 | 720) => Some(""),
        (b'M', 660) => Some("ELPQ"),
        _ => common(letter, tenths),
    }
}

/// The words of a block, collected.
#[derive(Debug, Default)]
struct Block {
    words: Words,
    moves: bool,
    setting: bool,
    ends: bool,
    pauses: bool,
    halts: bool,
    allowed: &'static str,
    extended: Option<i32>,
    /// Other letters of the block: one bit each, A is the lowest.
    others: u32,
    /// Values of L, P and R.
    values: [Option<NodeId>; 3],
}

/// Letters whose values matter in a block without a motion.
const VALUED: [u8; 3] = [b'L', b'P', b'R'];

pub fn words<'t>(
    cursor: &mut Cursor<'t>,
    grammar: &Grammar,
    script: &mut Script<'t>,
) -> Parsed<BlockKind> {
    let mut block = Block::default();
    if cursor.is_done() {
        return Ok(BlockKind::Nothing);
    }
    while let Some(letter) = cursor.next() {
        let letter = letter.to_ascii_uppercase();
        if !letter.is_ascii_uppercase() {
            return fault(text!("\"{left}\" is not understood", cursor.left()));
        }
        let begin = cursor.at();
        cursor.advance(1);
        let named = cursor.next().is_some_and(|next| next.is_ascii_alphabetic());
        // `X=10+R5`: a computed position.
        let sum = grammar.names == Names::Words && matches!(letter, b'X'..=b'Z') && cursor.eat("=");
        // A word with several letters is reported as a whole.
        let value = if sum {
            cursor.value(grammar, script)
        } else {
            cursor.operand(grammar, script)
        };
        let value = value.map_err(|why| match named {
            true => Box::new(text!("\"{left}\" is not understood", cursor.from(begin))),
            false => why,
        })?;
        let counted = grammar.points
            && matches!(letter, b'F' | b'I'..=b'K' | b'X'..=b'Z')
            && script.number(value).is_some();
        if counted && !cursor.since(begin).contains(&b'.') {
            return fault(text!(
                "a number has no decimal point: \"{left}\"",
                cursor.from(begin)
            ));
        }
        block
            .add(letter, value, grammar, script)
            .map_err(|reason| text!("{reason}: \"{word}\"", *reason, cursor.word_since(begin)))?;
    }
    block.finish(script)
}

impl Block {
    fn add(
        &mut self,
        letter: u8,
        value: NodeId,
        grammar: &Grammar,
        script: &Script<'_>,
    ) -> Parsed<()> {
        let twice = |place: &mut Option<NodeId>| {
            if place.replace(value).is_some() {
                fault(text!("the block repeats a word"))
            } else {
                Ok(())
            }
        };
        match letter {
            b'X' | b'Y' | b'Z' => {
                self.moves = true;
                twice(&mut self.words.to[usize::from(letter - b'X')])
            }
            b'I' | b'J' | b'K' => twice(&mut self.words.center[usize::from(letter - b'I')]),
            b'F' => twice(&mut self.words.feed),
            b'G' | b'M' => {
                let tenths = script
                    .number(value)
                    .map(|x| (x * 10.0).round())
                    .filter(|x| (0.0..100_000.0).contains(x));
                let taken = tenths.and_then(|tenths| {
                    Some((
                        (grammar.takes)(letter, tenths as i32)?,
                        effect(grammar.family, letter, tenths as i32)?,
                    ))
                });
                match taken {
                    Some((letters, effect)) => self.code(effect, letters),
                    None => fault(text!("this code is not understood")),
                }
            }
            _ => {
                let bit = 1 << (letter - b'A');
                if self.others & bit != 0 {
                    return fault(text!("the block repeats a word"));
                }
                self.others |= bit;
                if let Some(i) = VALUED.iter().position(|known| *known == letter) {
                    self.values[i] = Some(value);
                }
                Ok(())
            }
        }
    }

    /// Applies the effect of a code; `letters` are allowed beside it.
    fn code(&mut self, effect: Effect, letters: &'static str) -> Parsed<()> {
        let modes = &mut self.words.modes;
        match effect {
            Effect::Motion(motion) | Effect::Once(motion) | Effect::Contact(motion) => {
                // A code that only gives the meaning of a contact may come before or after the motion.
                self.words.motion = Some(match (self.words.motion, motion) {
                    (None, motion) => motion,
                    (Some(Motion::MayTouch), Motion::MustTouch | Motion::MustBeFree) => motion,
                    (Some(Motion::MustTouch | Motion::MustBeFree), Motion::MayTouch) => {
                        self.words.motion.unwrap_or(motion)
                    }
                    _ => return fault(text!("two motions are in one block")),
                });
            }
            Effect::Plane(plane) => modes.plane = Some(plane),
            Effect::Metric(metric) => modes.metric = Some(metric),
            Effect::Absolute(absolute) => modes.absolute = Some(absolute),
            Effect::CentersAbsolute(absolute) => modes.arcs_incremental = Some(!absolute),
            Effect::PerMinute(per_minute) => modes.per_minute = Some(per_minute),
            Effect::Spindle(on) => modes.spindle = Some(on),
            Effect::Exact(exact) => modes.exact = Some(exact),
            Effect::Length(counts) => modes.length = Some(counts),
            // Earlier modes are no longer valid.
            Effect::GiveBack => {
                *modes = Modes {
                    restored: Some(true),
                    ..Modes::NONE
                }
            }
            Effect::Offset(number) => modes.offset = Some(number),
            Effect::OffsetOf(from) => (self.extended, self.allowed) = (Some(from), letters),
            Effect::Setting => self.setting = true,
            Effect::End => self.ends = true,
            Effect::Pause => self.pauses = true,
            Effect::Halt | Effect::Ahead | Effect::Machine => {
                (self.halts, self.allowed) = (true, letters)
            }
            Effect::Nothing
            | Effect::Keep { .. }
            | Effect::CycleEnds
            | Effect::Diameter(false)
            | Effect::Turn(false)
            | Effect::Polar(false) => self.allowed = letters,
            _ => return fault(text!("this code is not understood")),
        }
        Ok(())
    }

    fn value(&self, letter: u8) -> Option<NodeId> {
        self.values[VALUED.iter().position(|known| *known == letter)?]
    }

    fn finish(mut self, script: &mut Script<'_>) -> Parsed<BlockKind> {
        if let Some(from) = self.extended {
            let number = self.value(b'P').and_then(|node| script.number(node));
            let number = number
                .filter(|n| (1.0..=99.0).contains(n))
                .ok_or_else(|| text!("a work offset without its number"))?;
            self.words.modes.offset = Some(from + number as i32);
        }
        let allowed = if self.setting { "LPR" } else { self.allowed };
        let mut others = self.others;
        while others != 0 {
            let letter = (b'A' + others.trailing_zeros() as u8) as char;
            if !allowed.contains(letter) {
                return fault(text!("the word {letter} is not understood here", letter));
            }
            others &= others - 1;
        }
        if self.setting {
            let whole = |letter: u8| {
                self.value(letter)
                    .and_then(|node| script.number(node))
                    .map(|x| x as i32)
            };
            let number = whole(b'P')
                .filter(|n| (1..=999).contains(n))
                .ok_or_else(|| text!("G10 without the number of a work offset"))?;
            return match whole(b'L') {
                Some(20) if self.value(b'R').is_none() => {
                    Ok(BlockKind::Reading(number, self.words.to))
                }
                Some(2) => Ok(BlockKind::Origin(number, self.words.to, self.value(b'R'))),
                _ => fault(text!("G10 is understood with L2 and L20")),
            };
        }
        match (self.moves, self.words.motion) {
            (true, None) => fault(text!("a block with axis words must state its motion")),
            (false, Some(_)) => fault(text!("a motion without axis words")),
            (false, None) if self.words.feed.is_some() => fault(text!("a feed without a motion")),
            (false, None) if self.ends => Ok(BlockKind::End),
            (false, None) if self.pauses && self.words.modes == Modes::NONE => Ok(BlockKind::Pause),
            _ if self.pauses => fault(text!("this code must be alone in its block")),
            (false, None) if self.halts && self.words.modes == Modes::NONE => Ok(BlockKind::Halt),
            (true, _) if self.halts => Ok(BlockKind::Elsewhere(
                self.words.to.map(|node| node.is_some()),
            )),
            _ if self.halts => fault(text!("this code must be alone in its block")),
            (true, _) if self.ends => fault(text!("a motion in the last block")),
            _ => Ok(BlockKind::Words(self.words)),
        }
    }
}
