//! Macros: the arithmetic, conditions, loops and calls of LinuxCNC's O words and of a Fanuc's macro B. What is known is put into the blocks as
//! numbers, and the reader reads these; what is not known stays as it is written, and the reader says so.
//!
//! A condition that is not known is not followed: the lines it guards are read in their order, and what they set is not known from there on.

mod flow;
mod index;
mod o_words;
mod value;

use crate::control::iso::lex::{head, program_number};
use crate::import::signs::{self, Sign};
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::control_kind::ControlKind;
use crate::import::toolpath::flow::{Flow, Step};
use crate::import::toolpath::key::Key;
use crate::import::toolpath::known::Ask;
use crate::import::toolpath::system::System;
use crate::import::toolpath::writes::{self, Variable};
use crate::num::decimal;
use index::{Index, o_word};
use value::{Cursor, Value, Variables};

/// So many blocks are run: whoever repeats more has an end.
const MOST_BLOCKS: usize = 500_000;

/// So many structures may be open: whoever jumps out of more has an end.
const MOST_OPEN: usize = 5000;

/// So deep a subprogram may call the next one.
const DEEPEST: usize = 10;

/// A line that is never reached.
const NOWHERE: usize = usize::MAX;

/// What a block assigns.
type Assigned = Vec<(Key, Value)>;

/// A structure that is open.
#[derive(Clone, Debug, PartialEq)]
enum Open {
    /// An `if` of which a branch is being run.
    Branch(String),
    /// An `if` whose next `elseif` is not known.
    ElseIf(String),
    /// A loop, with the place of its first line, and how often it runs again: not once more where an unknown condition may have left it.
    Loop(String, Place, usize),
    /// A condition that is not known.
    Unsure(String),
}

/// A call under way: where it continues, and what was open and not sure when it began.
#[derive(Debug)]
struct Frame {
    back: Place,
    linuxcnc: bool,
    open: usize,
    /// How many M98 calls were under way.
    inside: usize,
    unsure: usize,
    leaps: usize,
    /// How often an unknown condition may have gone back from it: what follows in it is not sure.
    left: usize,
}

/// Runs the macros of a text.
pub(super) struct Macros {
    variables: Variables,
    index: Index,
    open: Vec<Open>,
    frames: Vec<Frame>,
    /// How many conditions that are not known guard this line.
    unsure: usize,
    /// Lines below that an unknown condition may have jumped to: up to them nothing is sure.
    leaps: Vec<usize>,
    blocks: usize,
    /// How often a branch that ends the program was not taken, by its line.
    spared: Vec<(usize, usize)>,
    /// The registers that the line has written.
    written: Vec<(Variable, f64)>,
    /// The lines of subprograms that ran: from, up to.
    ran: Vec<(usize, usize)>,
    /// Whether the program is run with what is known, and not only read.
    runs: bool,
    /// Subroutines that nothing in the text calls, the last first.
    uncalled: Vec<(String, Place, usize)>,
}

impl Macros {
    /// None where a text has nothing of a macro. The program is its first bytes; what is below may be called. `set` is what the user knows of variables.
    pub fn of(text: &str, end: usize, set: &[(&str, f64)], kind: ControlKind) -> Option<Self> {
        let bytes = text.as_bytes();
        let computes = memchr::memchr3(b'#', b'[', b'<', bytes).is_some();
        let has_o_words = || {
            memchr::memchr2_iter(b'o', b'O', bytes)
                .any(|at| o_word(&bytes[at..bytes.len().min(at + 40)]).is_some())
        };
        let has_calls =
            || memchr::memchr2_iter(b'g', b'G', bytes).any(|at| bytes[at + 1..].starts_with(b"65"));
        (computes || has_o_words() || has_calls()).then_some(())?;
        let index = Index::of(text);
        Some(Macros {
            variables: Variables::new(
                kind.computes_like_linuxcnc().unwrap_or_else(|| {
                    matches!(signs::of(text), Some(Sign::LinuxCnc | Sign::Rs274))
                }),
                set.iter()
                    .filter_map(|(name, value)| Some((Key::named(name)?, *value)))
                    .collect(),
            ),
            uncalled: index.uncalled(end),
            index,
            open: Vec::new(),
            frames: Vec::new(),
            unsure: 0,
            leaps: Vec::new(),
            blocks: 0,
            spared: Vec::new(),
            written: Vec::new(),
            runs: false,
            ran: Vec::new(),
        })
    }

    /// The lines of a subprogram run, with the line of its name.
    fn runs(&mut self, begin: Place, end: usize) {
        const MOST_KNOWN: usize = 500;
        let lines = (begin.line.saturating_sub(1), end);
        if self.ran.len() < MOST_KNOWN && !self.ran.contains(&lines) {
            self.ran.push(lines);
        }
    }

    /// Whether what a block sets is set for sure.
    fn is_sure(&self) -> bool {
        self.unsure == 0 && self.leaps.is_empty()
    }

    /// Whether an unknown condition of this call guards the block: a jump in it may not be made, and what it jumps over may run.
    fn is_guarded(&self) -> bool {
        let (unsure, leaps) = self
            .frames
            .last()
            .map_or((0, 0), |frame| (frame.unsure + frame.left, frame.leaps));
        self.unsure > unsure || self.leaps.len() > leaps
    }

    /// What becomes of a block, whose words begin at `begin`.
    fn block(
        &mut self,
        line: &[u8],
        begin: usize,
        here: Place,
        next: Place,
        inside: usize,
    ) -> Step {
        let code = &line[begin..];
        match code.first().map(u8::to_ascii_uppercase) {
            // The next program begins: the one that was called is over.
            Some(b'O') if program_number(code).is_some() => Step::to(self.fall_out(false)),
            Some(b'O') => self.o_word(code, here, next),
            Some(b'(') if self.variables.linuxcnc && aborts(code) && self.is_sure() => Step::Ends,
            Some(b'(' | b';' | b'%') | None => Step::AsWritten,
            _ if self.index.is_flow(code) => self.flow(code, here, next),
            _ => self
                .macro_word(code, next, inside)
                .unwrap_or_else(|| self.words(line, begin)),
        }
    }

    /// Up to a line nothing is sure, in this call: each line once, however often a loop comes by.
    fn leaps_to(&mut self, line: usize) {
        let own = self
            .frames
            .last()
            .map_or(0, |frame| frame.leaps)
            .min(self.leaps.len());
        if !self.leaps[own..].contains(&line) {
            self.leaps.push(line);
        }
    }

    /// Whether the branch of a line that ends the program may be left once more: a loop that only it ends would not end.
    fn spares(&mut self) -> bool {
        const MOST_SPARED: usize = 1000;
        let line = self.variables.line;
        let times = match self.spared.iter_mut().find(|(known, _)| *known == line) {
            Some((_, times)) => times,
            None => {
                self.spared.push((line, 0));
                &mut self.spared.last_mut().expect("just pushed").1
            }
        };
        *times += 1;
        self.runs && *times <= MOST_SPARED
    }

    fn enter(&mut self, back: Place, linuxcnc: bool, inside: usize, arguments: Vec<(i32, Value)>) {
        let (open, unsure, leaps) = (self.open.len(), self.unsure, self.leaps.len());
        self.variables.enter(arguments);
        self.frames.push(Frame {
            back,
            linuxcnc,
            open,
            inside,
            unsure,
            leaps,
            left: 0,
        });
    }

    /// Back from a call; none outside of calls.
    fn leave(&mut self) -> Option<Place> {
        let frame = self.frames.pop()?;
        self.variables.leave();
        self.open.truncate(frame.open);
        self.unsure = frame.unsure;
        self.leaps.truncate(frame.leaps);
        Some(frame.back)
    }

    /// It may go back from the call here, or not: what follows in it is not sure.
    fn may_leave(&mut self) -> Step {
        if let Some(frame) = self.frames.last_mut() {
            frame.left += 1;
            self.unsure += 1;
        }
        Step::AsWritten
    }

    /// A block of words: what is known in it becomes numbers, and what it assigns is set.
    fn words(&mut self, line: &[u8], begin: usize) -> Step {
        if memchr::memchr2(b'#', b'[', &line[begin..]).is_none() {
            return Step::AsWritten;
        }
        let Some((out, sets)) = self.expanded(line, begin) else {
            // What it assigns may be to any variable.
            if line.contains(&b'=') {
                self.forget();
            }
            return Step::AsWritten;
        };
        // On LinuxCNC all take effect after the block; of a Fanuc that is not known here.
        let sure = self.is_sure() && (sets.len() < 2 || self.variables.linuxcnc);
        // An alarm with a message: the program stops.
        let alarm =
            !self.variables.linuxcnc && sets.iter().any(|(key, _)| *key == Key::Number(3000));
        if alarm && self.is_sure() {
            return Step::Ends;
        }
        let known = sure
            && sets
                .iter()
                .all(|(key, value)| *value != Value::Unknown && *key != Key::Unknown);
        let assigns = !sets.is_empty();
        for (key, value) in sets {
            let value = if sure { value } else { Value::Unknown };
            if let Key::Number(number) = key
                && let Some(variable) = writes::of_number(number, self.variables.linuxcnc)
            {
                let value = value.number().unwrap_or(f64::NAN);
                self.written.push((variable, value));
            }
            self.variables.set(key, value);
        }
        match out[begin..].trim_ascii().is_empty() {
            // What divides by zero is reported by itself.
            true if assigns && (known || self.variables.has_divided()) => Step::Done,
            // Of what gets no known value the reader says that it computes.
            true if assigns => Step::AsWritten,
            _ => Step::Read(out),
        }
    }

    /// A block with numbers in place of what is known, and what it assigns; none where it is not understood.
    fn expanded(&self, line: &[u8], begin: usize) -> Option<(Vec<u8>, Assigned)> {
        let (mut out, mut sets) = (line[..begin].to_vec(), Vec::new());
        let mut cursor = Cursor::new(line, begin, &self.variables);
        while let Some(sign) = line.get(cursor.at).copied() {
            let from = cursor.at;
            match sign {
                b';' => break,
                b'(' => {
                    cursor.at = line[from..]
                        .iter()
                        .position(|b| *b == b')')
                        .map_or(line.len(), |length| from + length + 1)
                }
                b'#' => sets.push(cursor.assignment()?),
                letter if letter.is_ascii_alphabetic() => {
                    cursor.at += 1;
                    out.push(letter);
                    if !cursor.computes() {
                        continue;
                    }
                    match cursor.in_word()? {
                        Value::Number(x) => number(&mut out, x),
                        Value::Empty => drop(out.pop()),
                        Value::Unknown => out.extend_from_slice(&line[from + 1..cursor.at]),
                    }
                }
                sign => {
                    cursor.at += 1;
                    out.push(sign);
                }
            }
        }
        Some((out, sets))
    }
}

impl Flow for Macros {
    fn written(&mut self) -> Vec<(Variable, f64)> {
        std::mem::take(&mut self.written)
    }

    fn divisions(&self) -> Vec<u32> {
        self.variables.divisions()
    }

    fn step(&mut self, line: &[u8], here: Place, next: Place, inside: usize) -> Step {
        self.blocks += 1;
        if self.blocks > MOST_BLOCKS || self.open.len() > MOST_OPEN {
            return Step::Stop;
        }
        self.variables.line = here.line;
        self.leaps.retain(|leap| *leap != here.line);
        let head = head(line);
        let code = &line[head.end..];
        if !head.skips {
            return self.block(line, head.end, here, next, inside);
        }
        // With block skip on, the control leaves it out.
        if self.index.is_flow(code)
            || o_word(code).is_some_and(|(_, keyword, _)| keyword.jumps())
            || flow::calls(code)
        {
            return self.leap(None, next);
        }
        self.unsure += 1;
        let step = self.block(line, head.end, here, next, inside);
        self.unsure = self.unsure.saturating_sub(1);
        step
    }

    fn forget(&mut self) {
        self.variables.forget();
    }

    fn forget_shared(&mut self) {
        self.variables.forget_shared();
    }

    fn fall_out(&mut self, at_end: bool) -> Option<Place> {
        self.frames
            .last()
            .filter(|frame| at_end || !frame.linuxcnc)?;
        self.leave()
    }

    fn has_run(&self, line: usize) -> bool {
        self.ran
            .iter()
            .any(|(from, to)| (*from..=*to).contains(&line))
    }

    fn is_inside(&self) -> bool {
        !self.frames.is_empty()
    }

    fn sees(&mut self, system: System) {
        self.runs = true;
        self.variables.system = system;
    }

    fn asks(&self) -> Vec<Ask> {
        self.variables.asks()
    }

    fn uncalled(&mut self, end: Place) -> Option<(String, Place)> {
        let (label, begin, last) = self.uncalled.pop()?;
        while !self.frames.is_empty() {
            self.leave();
        }
        (self.unsure, self.leaps, self.open) = (0, Vec::new(), Vec::new());
        self.runs(begin, last);
        self.enter(end, true, 0, Vec::new());
        self.variables.enter_uncalled();
        Some((label, begin))
    }
}

/// Whether a comment of LinuxCNC stops the program: `(ABORT, …)`.
fn aborts(code: &[u8]) -> bool {
    let word = code[1..].trim_ascii_start();
    word.get(..5)
        .is_some_and(|begin| begin.eq_ignore_ascii_case(b"abort"))
        && word[5..].trim_ascii_start().starts_with(b",")
}

/// A number as a word has it, with its point: a Fanuc counts one without in the smallest step.
fn number(out: &mut Vec<u8>, x: f64) {
    let mut text = decimal(x, 9);
    if !text.contains('.') {
        text.push('.');
    }
    out.extend_from_slice(text.as_bytes());
}
