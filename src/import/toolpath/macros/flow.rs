//! Macro B of Fanuc and its kin: jumps, conditions, and calls with arguments.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::{Flow, Step};
use crate::import::toolpath::macros::index::do_label;
use crate::import::toolpath::macros::value::{Cursor, Value};
use crate::import::toolpath::macros::{DEEPEST, Macros, NOWHERE};

/// The letters of the arguments of a G65, and the variables that they set.
const ARGUMENTS: [(u8, i32); 21] = [
    (b'A', 1),
    (b'B', 2),
    (b'C', 3),
    (b'I', 4),
    (b'J', 5),
    (b'K', 6),
    (b'D', 7),
    (b'E', 8),
    (b'F', 9),
    (b'H', 11),
    (b'M', 13),
    (b'Q', 17),
    (b'R', 18),
    (b'S', 19),
    (b'T', 20),
    (b'U', 21),
    (b'V', 22),
    (b'W', 23),
    (b'X', 24),
    (b'Y', 25),
    (b'Z', 26),
];

/// Whether a block begins with this code: `M99`, not `M990`.
fn begins(code: &[u8], word: &[u8; 3]) -> bool {
    code.get(..3)
        .is_some_and(|begin| begin.eq_ignore_ascii_case(word))
        && !code.get(3).is_some_and(u8::is_ascii_digit)
}

/// Whether a block begins with a call of a macro, or goes back from one.
pub fn calls(code: &[u8]) -> bool {
    begins(code, b"G65") || begins(code, b"M99")
}

impl Macros {
    /// `IF[…]GOTO 10`, `IF[…]THEN#1=2`, `WHILE[…]DO1`, `END1`, `GOTO 10`.
    pub(super) fn flow(&mut self, mut code: &[u8], here: Place, next: Place) -> Step {
        let mut cursor = Cursor::new(code, 0, &self.variables);
        while cursor.eat("IF") {
            let holds = cursor
                .bracketed()
                .and_then(Value::number)
                .map(|truth| truth != 0.0);
            if !cursor.eat("THEN") {
                let goes = cursor.eat("GOTO");
                let label = cursor.operand().and_then(Value::number).filter(|_| goes);
                return self.goto(label, holds, next);
            }
            code = code[cursor.at..].trim_ascii_start();
            if holds != Some(true) || !self.index.is_flow(code) {
                return self.then(code, holds, next);
            }
            cursor = Cursor::new(code, 0, &self.variables);
        }
        if cursor.eat("GOTO") {
            let label = cursor.operand().and_then(Value::number);
            return self.goto(label, Some(true), next);
        }
        if cursor.eat("END") {
            let label = cursor.operand().and_then(Value::number);
            return label.map_or(Step::AsWritten, |label| self.end_of_loop(&do_label(label)));
        }
        let condition = if cursor.eat("WHILE") {
            cursor.bracketed()
        } else {
            Some(Value::Number(1.0))
        };
        let does = cursor.eat("DO");
        let label = cursor.operand().and_then(Value::number).filter(|_| does);
        label.map_or(Step::AsWritten, |label| {
            self.while_(do_label(label), condition, here)
        })
    }

    /// A jump to a block under a condition. Where the condition is not known, or an unknown one guards the jump, it is not made: the lines are read in
    /// their order.
    fn goto(&mut self, label: Option<f64>, holds: Option<bool>, next: Place) -> Step {
        if holds == Some(false) {
            return Step::Done;
        }
        let to = label.and_then(|label| self.index.block(label as u32, next));
        if holds == Some(true) && to.is_some() && !self.is_guarded() {
            return Step::to(to);
        }
        // One of the two ways ends: the other one is the program's.
        if self.runs
            && holds.is_none()
            && to.is_some_and(|to| self.index.leads_out(to))
            && self.spares()
        {
            return Step::BranchEnds(None);
        }
        // A jump that is made to a block that is not known.
        let astray = holds == Some(true) && to.is_none() && !self.is_guarded();
        let leap = self.leap(to, next);
        if astray { Step::Astray } else { leap }
    }

    /// It may continue at a place: up to that nothing is sure. What a jump back repeats may set any variable again.
    pub(super) fn leap(&mut self, to: Option<Place>, next: Place) -> Step {
        let below = to.filter(|place| place.line >= next.line);
        if below.is_none() {
            self.forget();
        }
        self.leaps_to(below.map_or(NOWHERE, |place| place.line));
        below.map_or(Step::AsWritten, |place| Step::MayJump(place.line))
    }

    /// The statement after THEN.
    fn then(&mut self, rest: &[u8], holds: Option<bool>, next: Place) -> Step {
        if holds == Some(false) {
            return Step::Done;
        }
        if self.index.is_flow(rest) {
            return self.leap(None, next);
        }
        let guards = usize::from(holds.is_none());
        self.unsure += guards;
        let step = self.words(rest, 0);
        self.unsure -= guards;
        if matches!(step, Step::Done) {
            Step::Done
        } else {
            Step::AsWritten
        }
    }

    /// `G65 P100 A5. Z-3.` and `M99`: into a macro of the same text and back; none for any other block.
    pub(super) fn macro_word(&mut self, code: &[u8], next: Place, inside: usize) -> Option<Step> {
        if begins(code, b"G65") {
            return self.macro_call(code, next, inside);
        }
        let own = self
            .frames
            .last()
            .is_some_and(|frame| !frame.linuxcnc && frame.inside == inside);
        if !own || !begins(code, b"M99") {
            return None;
        }
        if self.is_guarded() {
            return Some(self.may_leave());
        }
        let mut cursor = Cursor::new(code, 3, &self.variables);
        let block = if cursor.eat("P") {
            Some(cursor.operand().and_then(Value::number))
        } else {
            None
        };
        let back = self.leave()?;
        // To a block of the program that called, by its number.
        let to = block.map_or(Some(back), |number| self.index.block(number? as u32, back));
        if to.is_none() {
            self.leap(None, back);
        }
        Some(Step::Leave(to.unwrap_or(back)))
    }

    /// None where the text has no such program, it is called more than once, or its arguments are not understood.
    fn macro_call(&mut self, code: &[u8], next: Place, inside: usize) -> Option<Step> {
        let mut arguments = Vec::new();
        let mut program = None;
        let mut centers = [0; 3];
        let mut cursor = Cursor::new(code, 3, &self.variables);
        while let Some(letter) = cursor.peek().filter(u8::is_ascii_uppercase) {
            cursor.at += 1;
            let value = cursor.operand()?;
            match (letter, ARGUMENTS.iter().find(|(known, _)| *known == letter)) {
                (b'P', _) => program = value.number(),
                (b'L', _) if value == Value::Number(1.0) => {}
                // I, J and K may come ten times: #4 to #6, then #7 to #9, and so on.
                (b'I'..=b'K', Some((_, first))) => {
                    let times = centers[usize::from(letter - b'I')];
                    centers[usize::from(letter - b'I')] += 1;
                    if times == 10 {
                        return None;
                    }
                    arguments.push((first + 3 * times, value));
                }
                (_, Some((_, variable)))
                    if arguments.iter().all(|(known, _)| known != variable) =>
                {
                    arguments.push((*variable, value));
                }
                _ => return None,
            }
        }
        let (begin, end) = self
            .index
            .program(program? as u32)
            .filter(|_| self.frames.len() < DEEPEST)?;
        self.runs(begin, end);
        self.enter(next, false, inside, arguments);
        Some(Step::Enter(begin))
    }
}
