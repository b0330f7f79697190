//! Macros: the arithmetic, conditions, loops and calls of LinuxCNC's O words and of a Fanuc's macro B. What is known is put into the blocks as
//! numbers, and the reader reads these; what is not known stays as it is written, and the reader says so.
//!
//! A condition that is not known is not followed: the lines it guards are read in their order, and what they set is not known from there on.

mod index;
mod value;

use std::borrow::Cow;

use crate::control::iso::lex::head;
use crate::import::toolpath::calls::Place;
use crate::num::decimal;
use index::{Index, Keyword, o_word};
use value::{Cursor, Key, Sure, Value, Variables};

/// So many blocks are run: whoever repeats more has an end.
const MOST_BLOCKS: usize = 500_000;

/// So deep a subprogram may call the next one.
const DEEPEST: usize = 10;

/// The number of no block.
const NOWHERE: u32 = u32::MAX;

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

/// A structure that is open.
#[derive(Clone, Debug, PartialEq)]
enum Open {
    /// An `if` of which a branch is being run.
    Branch(String),
    /// A loop, with the place of its first line, and how often it runs again.
    Loop(String, Place, usize),
    /// A condition that is not known.
    Unsure(String),
}

/// A call under way: where it continues, and how many structures and M98 calls were open.
#[derive(Debug)]
struct Frame {
    back: Place,
    open: usize,
    inside: usize,
    linuxcnc: bool,
    /// How many unknown conditions guarded the call.
    unsure: usize,
    /// How many may have gone back from it: what follows in it is not sure.
    left: usize,
}

/// What becomes of a line.
pub(super) enum Step<'l> {
    /// It is read, with the numbers in it.
    Read(Cow<'l, [u8]>),
    /// It is done.
    Done,
    /// The program continues elsewhere.
    Go(Place),
    /// The program has run for too long.
    Stop,
}

/// Runs the macros of a text.
pub(super) struct Macros {
    variables: Variables,
    index: Index,
    open: Vec<Open>,
    frames: Vec<Frame>,
    /// How many conditions that are not known guard this line.
    unsure: usize,
    /// Numbers of blocks that an unknown condition may have jumped to: up to them nothing is sure.
    leaps: Vec<u32>,
    blocks: usize,
    /// The lines of subprograms that ran: from, up to.
    ran: Vec<(usize, usize)>,
    /// How many subroutines were shown, or are called, of those that nothing may call.
    shown: usize,
}

impl Macros {
    /// None where a text has nothing of a macro.
    pub fn of(text: &str) -> Option<Self> {
        let bytes = text.as_bytes();
        let computes = memchr::memchr3(b'#', b'[', b'<', bytes).is_some();
        let has_o_words =
            || memchr::memchr2_iter(b'o', b'O', bytes).any(|at| o_word(&bytes[at..bytes.len().min(at + 40)]).is_some());
        (computes || has_o_words()).then_some(())?;
        let index = Index::of(text);
        Some(Macros {
            variables: Variables::new(index.linuxcnc),
            index,
            open: Vec::new(),
            frames: Vec::new(),
            unsure: 0,
            leaps: Vec::new(),
            blocks: 0,
            ran: Vec::new(),
            shown: 0,
        })
    }

    /// The first subroutine that nothing has called: its name, and where it begins, from which it comes back to `end`. Its arguments are not known.
    pub fn uncalled(&mut self, end: Place) -> Option<(String, Place)> {
        const MOST_SHOWN: usize = 100;
        let subs = self.index.subroutines();
        let own = subs.iter().take(MOST_SHOWN).skip(self.shown).position(|(_, begin, _)| !self.has_run(begin.line))?;
        self.shown += own + 1;
        let (label, begin, last) = subs[self.shown - 1].clone();
        self.runs(begin, last);
        (self.open, self.frames, self.unsure) = (Vec::new(), Vec::new(), 0);
        self.frames.push(Frame { back: end, open: 0, inside: 0, linuxcnc: true, unsure: 0, left: 0 });
        self.variables.enter((1..=30).map(|number| (number, Value::Unknown)).collect());
        Some((label, begin))
    }

    /// Whether a line ran where it was called.
    pub fn has_run(&self, line: usize) -> bool {
        self.ran.iter().any(|(from, to)| (*from..=*to).contains(&line))
    }

    /// The lines of a subprogram run, with the line of its name.
    fn runs(&mut self, begin: Place, end: usize) {
        const MOST_KNOWN: usize = 500;
        let lines = (begin.line.saturating_sub(1), end);
        if self.ran.len() < MOST_KNOWN && !self.ran.contains(&lines) {
            self.ran.push(lines);
        }
    }

    fn sure(&self) -> Sure {
        if self.unsure == 0 && self.leaps.is_empty() { Sure::Yes } else { Sure::No }
    }

    /// What becomes of the line at `here`; `inside` is how many M98 calls are under way.
    pub fn step<'l>(&mut self, line: &'l [u8], here: Place, next: Place, inside: usize) -> Step<'l> {
        self.blocks += 1;
        if self.blocks > MOST_BLOCKS {
            return Step::Stop;
        }
        let head = head(line);
        if let Some(number) = head.number {
            self.leaps.retain(|leap| *leap != number);
        }
        let code = &line[head.end..];
        if head.skips {
            // With block skip on, the control leaves it out.
            self.unsure += 1;
            let step = match self.index.is_flow(code) {
                true => Step::Read(Cow::Borrowed(line)),
                false => self.block(line, head.end, here, next, inside),
            };
            self.unsure -= 1;
            if self.index.is_flow(code) {
                self.leap(None, next);
            }
            return step;
        }
        self.block(line, head.end, here, next, inside)
    }

    /// What becomes of a block, whose words begin at `begin`.
    fn block<'l>(&mut self, line: &'l [u8], begin: usize, here: Place, next: Place, inside: usize) -> Step<'l> {
        let code = &line[begin..];
        match code.first().map(u8::to_ascii_uppercase) {
            Some(b'O') => self.o_word(line, code, here, next),
            Some(b'I' | b'W' | b'G' | b'E' | b'D') if self.index.is_flow(code) => self.flow(line, code, here, next),
            Some(b'M') if self.returns(code, inside) => self.leave(),
            Some(b'(' | b';' | b'%') | None => Step::Read(Cow::Borrowed(line)),
            _ => match self.macro_call(code, next, inside) {
                Some(step) => step,
                None => {
                    let step = self.words(line, begin);
                    if self.calls_out(code) {
                        self.variables.forget();
                    }
                    step
                }
            },
        }
    }

    /// Whether a block calls what is not in this text: that may set any variable.
    fn calls_out(&self, code: &[u8]) -> bool {
        let called = |word: &str| code.windows(word.len()).any(|code| code.eq_ignore_ascii_case(word.as_bytes()));
        let number = || {
            let at = code.iter().position(|b| b.eq_ignore_ascii_case(&b'P'))?;
            Cursor::new(code, at + 1, &self.variables).operand()?.number()
        };
        ["G65", "G66", "M198"].into_iter().any(called)
            || called("M98") && number().is_none_or(|number| self.index.program(number as u32 % 10_000).is_none())
    }

    /// Whether a block goes back from a macro that G65 called.
    fn returns(&self, code: &[u8], inside: usize) -> bool {
        let own = self.frames.last().is_some_and(|frame| !frame.linuxcnc && frame.inside == inside);
        own && code[1..].starts_with(b"99") && !code.get(3).is_some_and(u8::is_ascii_digit)
    }

    /// Back from a call.
    fn leave<'l>(&mut self) -> Step<'l> {
        let Some(frame) = self.frames.pop() else { return Step::Done };
        self.variables.leave();
        self.open.truncate(frame.open);
        self.unsure = self.unsure.saturating_sub(frame.left);
        Step::Go(frame.back)
    }

    fn enter<'l>(&mut self, to: Place, frame: Frame, arguments: Vec<(i32, Value)>) -> Step<'l> {
        self.variables.enter(arguments);
        self.frames.push(frame);
        Step::Go(to)
    }

    /// `G65 P100 A5. Z-3.`: into a program of the same text; none where there is none, or it is called more than once.
    fn macro_call<'l>(&mut self, code: &[u8], next: Place, inside: usize) -> Option<Step<'l>> {
        code.get(..3).filter(|word| word.eq_ignore_ascii_case(b"G65"))?;
        let mut arguments = Vec::new();
        let (mut program, mut times) = (None, 1.0);
        let mut cursor = Cursor::new(code, 3, &self.variables);
        while let Some(letter) = cursor.peek().filter(u8::is_ascii_uppercase) {
            cursor.at += 1;
            let value = cursor.operand()?;
            match (letter, ARGUMENTS.iter().find(|(known, _)| *known == letter)) {
                (b'P', _) => program = value.number(),
                (b'L', _) => times = value.number()?,
                // Letters that come again are counted on: I, J, K of the other kind of arguments.
                (_, Some((_, variable))) if arguments.iter().all(|(known, _)| known != variable) => {
                    arguments.push((*variable, value));
                }
                _ => return None,
            }
        }
        let (begin, end) = self.index.program(program? as u32)?;
        if times != 1.0 || self.frames.len() >= DEEPEST {
            return None;
        }
        self.runs(begin, end);
        let frame = Frame { back: next, open: self.open.len(), inside, linuxcnc: false, unsure: self.unsure, left: 0 };
        Some(self.enter(begin, frame, arguments))
    }

    /// A block of words: what is known in it becomes numbers, and what it assigns is set.
    fn words<'l>(&mut self, line: &'l [u8], begin: usize) -> Step<'l> {
        if memchr::memchr2(b'#', b'[', &line[begin..]).is_none() {
            return Step::Read(Cow::Borrowed(line));
        }
        let mut out = line[..begin].to_vec();
        let mut sets: Vec<(Key, Value)> = Vec::new();
        let mut cursor = Cursor::new(line, begin, &self.variables);
        while let Some(sign) = line.get(cursor.at).copied() {
            let from = cursor.at;
            match sign {
                b';' => break,
                b'(' => cursor.at = line[from..].iter().position(|b| *b == b')').map_or(line.len(), |length| from + length + 1),
                b'#' => match assignment(&mut cursor) {
                    Some(set) => sets.push(set),
                    None => return self.not_understood(line),
                },
                letter if letter.is_ascii_alphabetic() => {
                    cursor.at += 1;
                    out.push(letter);
                    if !cursor.computes() {
                        continue;
                    }
                    match cursor.operand() {
                        Some(Value::Number(x)) => number(&mut out, x),
                        Some(Value::Empty) => drop(out.pop()),
                        Some(Value::Unknown) => out.extend_from_slice(&line[from + 1..cursor.at]),
                        None => return self.not_understood(line),
                    }
                }
                sign => {
                    cursor.at += 1;
                    out.push(sign);
                }
            }
        }
        let (sure, known) = (self.sure(), sets.iter().all(|(key, value)| *value != Value::Unknown && *key != Key::Unknown));
        let assigns = !sets.is_empty();
        // On LinuxCNC all take effect after the block; of a Fanuc that is not known here.
        let sure = if sets.len() > 1 && !self.variables.linuxcnc { Sure::No } else { sure };
        sets.into_iter().for_each(|(key, value)| self.variables.set(key, value, sure));
        match out[begin..].trim_ascii().is_empty() {
            // Of what gets no known value the reader says that it computes.
            true if assigns && known && sure == Sure::Yes => Step::Done,
            true if assigns => Step::Read(Cow::Borrowed(line)),
            _ => Step::Read(Cow::Owned(out)),
        }
    }

    /// A block that is not understood is read as it is written; what it assigns may be to any variable.
    fn not_understood<'l>(&mut self, line: &'l [u8]) -> Step<'l> {
        if line.contains(&b'=') {
            self.variables.forget();
        }
        Step::Read(Cow::Borrowed(line))
    }

    /// `o<name> call [5]`, `o1 if [#2 GT 0]` and their kin.
    fn o_word<'l>(&mut self, line: &'l [u8], code: &[u8], here: Place, next: Place) -> Step<'l> {
        let Some((label, keyword, rest)) = o_word(code) else { return Step::Read(Cow::Borrowed(line)) };
        let value = |macros: &Self| Cursor::new(code, rest, &macros.variables).bracketed();
        match keyword {
            Keyword::Sub => {
                self.index.find(&label, &[Keyword::EndSub], here.line).map_or(Step::Read(Cow::Borrowed(line)), Step::Go)
            }
            Keyword::EndSub | Keyword::Return => {
                let Some(frame) = self.frames.last_mut().filter(|frame| frame.linuxcnc) else {
                    return Step::Read(Cow::Borrowed(line));
                };
                // It may go back here.
                if keyword == Keyword::Return && self.unsure > frame.unsure + frame.left {
                    frame.left += 1;
                    self.unsure += 1;
                    return Step::Read(Cow::Borrowed(line));
                }
                let given = value(self).unwrap_or(Value::Unknown);
                let step = self.leave();
                let sure = self.sure();
                self.variables.set(Key::Name("_value".to_owned()), given, sure);
                step
            }
            Keyword::Call => self.call(line, code, &label, rest, next),
            Keyword::If => self.branch(line, label, value(self), here),
            Keyword::ElseIf | Keyword::Else if self.open.last() == Some(&Open::Branch(label.clone())) => {
                // The branch before it was run.
                self.open.pop();
                self.index.find(&label, &[Keyword::EndIf], here.line).map_or(Step::Read(Cow::Borrowed(line)), Step::Go)
            }
            Keyword::ElseIf | Keyword::Else => Step::Read(Cow::Borrowed(line)),
            Keyword::EndIf => match self.open.last() {
                Some(Open::Branch(own)) if *own == label => {
                    self.open.pop();
                    Step::Done
                }
                _ => self.unsure_ends(line, &label),
            },
            _ => self.loop_word(line, (label, keyword), value(self), here, next),
        }
    }

    /// The words of loops, with the condition or count that stands behind.
    fn loop_word<'l>(
        &mut self,
        line: &'l [u8],
        (label, keyword): (String, Keyword),
        value: Option<Value>,
        here: Place,
        next: Place,
    ) -> Step<'l> {
        let as_written = Step::Read(Cow::Borrowed(line));
        match keyword {
            Keyword::Do => self.begins(label, here, usize::MAX),
            Keyword::While if self.index.closes_do(&label, here.line) => match (self.loop_of(&label), value) {
                (Some(begin), Some(Value::Number(truth))) if truth != 0.0 => Step::Go(begin),
                (Some(_), Some(Value::Number(_))) => {
                    self.open.pop();
                    Step::Done
                }
                // What it sets and what it moves by a distance may be another after the next round: the reader knows that of the end of a loop.
                (Some(_), _) => {
                    self.open.pop();
                    self.variables.forget();
                    Step::Read(Cow::Borrowed(b"o1 endwhile"))
                }
                (None, _) => as_written,
            },
            Keyword::While => self.while_(line, label, value, here, &[Keyword::EndWhile]),
            Keyword::Repeat => match value {
                Some(Value::Number(times)) if times >= 1.0 => self.begins(label, next, times as usize),
                Some(Value::Number(_)) => {
                    self.index.find(&label, &[Keyword::EndRepeat], here.line).map_or(as_written, Step::Go)
                }
                _ => self.unsure_begins(line, label),
            },
            Keyword::EndWhile => match self.loop_of(&label) {
                Some(begin) => Step::Go(begin),
                None => self.unsure_ends(line, &label),
            },
            Keyword::EndRepeat => self.again(line, &label),
            Keyword::Break if self.unsure == 0 => self.out_of(line, &label, here),
            Keyword::Continue if self.unsure == 0 => match self.loop_around(&label) {
                // A `repeat` counts its rounds at its end.
                Some((own, begin, usize::MAX)) => {
                    self.open.truncate(own + 1);
                    Step::Go(begin)
                }
                _ => as_written,
            },
            // It may leave the loop here, or a round of it.
            _ => {
                self.leaps.push(NOWHERE);
                as_written
            }
        }
    }

    fn call<'l>(&mut self, line: &'l [u8], code: &[u8], label: &str, rest: usize, next: Place) -> Step<'l> {
        let Some((begin, end)) = self.index.subroutine(label).filter(|_| self.frames.len() < DEEPEST) else {
            self.variables.forget();
            return Step::Read(Cow::Borrowed(line));
        };
        let mut arguments = Vec::new();
        let mut cursor = Cursor::new(code, rest, &self.variables);
        while cursor.peek() == Some(b'[') {
            let Some(value) = cursor.bracketed() else { return Step::Read(Cow::Borrowed(line)) };
            arguments.push((arguments.len() as i32 + 1, value));
        }
        self.runs(begin, end);
        let frame = Frame { back: next, open: self.open.len(), inside: 0, linuxcnc: true, unsure: self.unsure, left: 0 };
        self.enter(begin, frame, arguments)
    }

    /// An `if`, or an `elseif` that is come to.
    fn branch<'l>(&mut self, line: &'l [u8], label: String, condition: Option<Value>, here: Place) -> Step<'l> {
        match condition {
            Some(Value::Number(truth)) if truth != 0.0 => {
                self.open.push(Open::Branch(label));
                Step::Done
            }
            Some(Value::Number(_)) => self.other_branch(line, label, here),
            _ => self.unsure_begins(line, label),
        }
    }

    /// The first branch below whose condition holds, or the end of the `if`.
    fn other_branch<'l>(&mut self, line: &'l [u8], label: String, here: Place) -> Step<'l> {
        let mut from = here.line;
        while let Some((keyword, condition, below)) = self.index.branch_below(&label, from) {
            match keyword {
                Keyword::ElseIf => match Cursor::new(&condition, 0, &self.variables).bracketed() {
                    Some(Value::Number(0.0)) => from = below.line - 1,
                    Some(Value::Number(_)) => {
                        self.open.push(Open::Branch(label));
                        return Step::Go(below);
                    }
                    // From there on it is not known which of them is run.
                    _ => {
                        self.open.push(Open::Unsure(label));
                        self.unsure += 1;
                        return Step::Go(below);
                    }
                },
                Keyword::Else => {
                    self.open.push(Open::Branch(label));
                    return Step::Go(below);
                }
                _ => return Step::Go(below),
            }
        }
        Step::Read(Cow::Borrowed(line))
    }

    fn unsure_begins<'l>(&mut self, line: &'l [u8], label: String) -> Step<'l> {
        self.open.push(Open::Unsure(label));
        self.unsure += 1;
        Step::Read(Cow::Borrowed(line))
    }

    fn unsure_ends<'l>(&mut self, line: &'l [u8], label: &str) -> Step<'l> {
        if matches!(self.open.last(), Some(Open::Unsure(own)) if own == label) {
            self.open.pop();
            self.unsure = self.unsure.saturating_sub(1);
        }
        Step::Read(Cow::Borrowed(line))
    }

    /// A loop begins, and runs so many times.
    fn begins<'l>(&mut self, label: String, begin: Place, times: usize) -> Step<'l> {
        match self.loop_around(&label) {
            Some((own, known, _)) if known == begin => self.open.truncate(own + 1),
            around => {
                // One of the same label that was left by a jump is over.
                self.open.truncate(around.map_or(self.open.len(), |(own, ..)| own));
                self.open.push(Open::Loop(label, begin, times));
            }
        }
        Step::Done
    }

    fn while_<'l>(
        &mut self,
        line: &'l [u8],
        label: String,
        condition: Option<Value>,
        here: Place,
        ends: &[Keyword],
    ) -> Step<'l> {
        match condition {
            Some(Value::Number(truth)) if truth != 0.0 => self.begins(label, here, usize::MAX),
            Some(Value::Number(_)) => {
                if self.loop_of(&label).is_some() {
                    self.open.pop();
                }
                self.index.find(&label, ends, here.line).map_or(Step::Read(Cow::Borrowed(line)), Step::Go)
            }
            _ => {
                if self.loop_of(&label).is_some() {
                    self.open.pop();
                }
                self.unsure_begins(line, label)
            }
        }
    }

    /// Where the innermost structure begins, where it is this loop.
    fn loop_of(&self, label: &str) -> Option<Place> {
        match self.open.last() {
            Some(Open::Loop(own, begin, _)) if own == label => Some(*begin),
            _ => None,
        }
    }

    /// The loop of this label around all that is open: how many structures are around it, where it begins, how often it runs again.
    fn loop_around(&self, label: &str) -> Option<(usize, Place, usize)> {
        self.open.iter().enumerate().rev().find_map(|(at, open)| match open {
            Open::Loop(own, begin, times) if own == label => Some((at, *begin, *times)),
            _ => None,
        })
    }

    /// The end of a `repeat`.
    fn again<'l>(&mut self, line: &'l [u8], label: &str) -> Step<'l> {
        match self.open.last_mut() {
            Some(Open::Loop(own, begin, times)) if own == label => {
                *times -= 1;
                let (begin, left) = (*begin, *times);
                if left > 0 {
                    return Step::Go(begin);
                }
                self.open.pop();
                Step::Done
            }
            _ => self.unsure_ends(line, label),
        }
    }

    /// Out of a loop, whatever is open in it.
    fn out_of<'l>(&mut self, line: &'l [u8], label: &str, here: Place) -> Step<'l> {
        let own = self.loop_around(label).map(|(own, ..)| own);
        let end = self.index.find(label, &[Keyword::EndWhile, Keyword::EndRepeat], here.line);
        match own.zip(end) {
            Some((own, end)) => {
                self.open.truncate(own);
                Step::Go(end)
            }
            None => Step::Read(Cow::Borrowed(line)),
        }
    }

    /// `IF[…]GOTO 10`, `IF[…]THEN#1=2`, `WHILE[…]DO1`, `END1`, `GOTO 10`.
    fn flow<'l>(&mut self, line: &'l [u8], code: &[u8], here: Place, next: Place) -> Step<'l> {
        let as_written = Step::Read(Cow::Borrowed(line));
        let mut cursor = Cursor::new(code, 0, &self.variables);
        if cursor.eat("IF") {
            let Some(condition) = cursor.bracketed() else { return as_written };
            let holds = condition.number().map(|truth| truth != 0.0);
            if cursor.eat("THEN") {
                return self.then(line, code.len() - cursor.at, holds, here, next);
            }
            let goes = cursor.eat("GOTO");
            let label = cursor.operand().and_then(Value::number).filter(|_| goes);
            return match (holds, label) {
                (Some(false), _) => Step::Done,
                (Some(true), Some(label)) => self.index.block(label as u32, next).map_or(as_written, Step::Go),
                (_, label) => {
                    self.leap(label, next);
                    as_written
                }
            };
        }
        if cursor.eat("GOTO") {
            let label = cursor.operand().and_then(Value::number);
            if label.is_none() {
                self.leap(None, next);
            }
            return label.and_then(|label| self.index.block(label as u32, next)).map_or(as_written, Step::Go);
        }
        if cursor.eat("END") {
            let Some(label) = cursor.operand().and_then(Value::number) else { return as_written };
            return match self.loop_of(&index::do_label(label)) {
                Some(begin) => Step::Go(begin),
                None => self.unsure_ends(line, &index::do_label(label)),
            };
        }
        let condition = if cursor.eat("WHILE") { cursor.bracketed() } else { Some(Value::Number(1.0)) };
        let does = cursor.eat("DO");
        let Some(label) = cursor.operand().and_then(Value::number).filter(|_| does) else { return as_written };
        self.while_(line, index::do_label(label), condition, here, &[Keyword::EndWhile])
    }

    /// It may continue at a block: up to that nothing is sure. What a jump back repeats may set any variable again.
    fn leap(&mut self, label: Option<f64>, next: Place) {
        let below = label
            .map(|label| label as u32)
            .filter(|label| self.index.block(*label, next).is_some_and(|place| place.line >= next.line));
        if below.is_none() {
            self.variables.forget();
        }
        self.leaps.push(below.unwrap_or(NOWHERE));
    }

    /// What stands behind THEN, so many signs from the end of the line.
    fn then<'l>(&mut self, line: &'l [u8], left: usize, holds: Option<bool>, here: Place, next: Place) -> Step<'l> {
        if holds == Some(false) {
            return Step::Done;
        }
        let rest = line[line.len() - left..].trim_ascii_start();
        if self.index.is_flow(rest) {
            return match holds {
                Some(_) => self.flow(rest, rest, here, next),
                None => {
                    self.leap(None, next);
                    Step::Read(Cow::Borrowed(line))
                }
            };
        }
        let inside = usize::from(holds.is_none());
        self.unsure += inside;
        let step = self.words(rest, 0);
        self.unsure -= inside;
        match step {
            Step::Done => Step::Done,
            _ => Step::Read(Cow::Borrowed(line)),
        }
    }
}

/// `#5=…`: the variable and its value.
fn assignment(cursor: &mut Cursor<'_>) -> Option<(Key, Value)> {
    let key = cursor.key()?;
    cursor.eat("=").then_some(())?;
    Some((key, cursor.expression()?))
}

/// A number as a word has it, with its point: a Fanuc counts one without in the smallest step.
fn number(out: &mut Vec<u8>, x: f64) {
    let mut text = decimal(x, 9);
    if !text.contains('.') {
        text.push('.');
    }
    out.extend_from_slice(text.as_bytes());
}
