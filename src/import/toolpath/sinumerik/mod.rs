//! SINUMERIK: R parameters and variables, conditions, loops, jumps and subprograms of the same text. What is known is put into the blocks as numbers, and the
//! reader reads these.
//!
//! Words and operators are those of the control's programming manual. A condition that is not known is not followed: the lines it guards are read in their
//! order, and what they set is not known from there on.

mod index;
mod value;

use crate::control::iso::lex::{comment_at, head};
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::{Flow, Step};
use crate::import::toolpath::known::Ask;
use crate::import::toolpath::system::System;
use crate::import::toolpath::writes::{self, Variable};
use crate::num::decimal;
use index::{Index, Structure};
use value::{Cursor, Variables};

/// So many blocks are run: whoever repeats more has an end.
const MOST_BLOCKS: usize = 500_000;

/// So many conditions and loops may be open: whoever jumps out of more has an end.
const MOST_OPEN: usize = 5000;

/// So deep a subprogram may call the next one.
const DEEPEST: usize = 10;

/// A line that is never reached.
const NOWHERE: usize = usize::MAX;

/// A loop that runs: the line of its first word, and, of a FOR, the variable.
struct Loop {
    line: usize,
    variable: Option<String>,
}

/// A call under way.
struct Frame {
    back: Place,
    loops: usize,
    unsure: usize,
}

/// Runs the arithmetic and the jumps of a text.
pub(super) struct Sinumerik {
    variables: Variables,
    index: Index,
    loops: Vec<Loop>,
    frames: Vec<Frame>,
    /// The lines that close the conditions and loops that are open and not known.
    unsure: Vec<usize>,
    /// The first lines of the conditions among them: the reader counts them until their ENDIF.
    unknown: Vec<usize>,
    /// Lines below that an unknown condition may have jumped to: up to them nothing is sure.
    leaps: Vec<usize>,
    blocks: usize,
    /// Whether the program is run with what is known, and not only read.
    runs: bool,
    /// The registers that the line has written.
    written: Vec<(Variable, f64)>,
    ran: Vec<(usize, usize)>,
}

impl Sinumerik {
    pub fn new(text: &str, set: &[(&str, f64)]) -> Self {
        Sinumerik {
            variables: Variables::new(set),
            index: Index::of(text),
            loops: Vec::new(),
            frames: Vec::new(),
            unsure: Vec::new(),
            unknown: Vec::new(),
            leaps: Vec::new(),
            blocks: 0,
            runs: false,
            written: Vec::new(),
            ran: Vec::new(),
        }
    }

    fn is_sure(&self) -> bool {
        self.unsure.is_empty() && self.leaps.is_empty()
    }

    fn block(&mut self, code: &str, here: Place, next: Place) -> Step {
        let mut cursor = Cursor::new(code);
        if cursor.eat("IF") {
            let holds = cursor.value(&mut self.variables);
            return match jump(&mut cursor) {
                Some(label) => self.goto(label, holds, next),
                None => self.branch(holds, here),
            };
        }
        if let Some(label) = jump(&mut Cursor::new(code)) {
            return self.goto(label, Some(1.0), next);
        }
        if cursor.eat("CASE") {
            return self.case(cursor, next);
        }
        if let Some(step) = self.structure(code, here, next) {
            return step;
        }
        if cursor.eat("DEF") {
            return self.define(cursor.rest);
        }
        if cursor.eat("RET") || !self.frames.is_empty() && (cursor.eat("M17") || cursor.eat("M99"))
        {
            return match self.is_sure() {
                true => self.leave().map_or(Step::AsWritten, Step::Leave),
                false => Step::AsWritten,
            };
        }
        if cursor.eat("STOPRE") || cursor.eat("MSG") || cursor.eat("PROC") || cursor.eat("EXTERN") {
            return Step::Done;
        }
        if cursor.eat("SETAL") {
            return if self.is_sure() {
                Step::Ends
            } else {
                Step::AsWritten
            };
        }
        self.call(code, next).unwrap_or_else(|| self.words(code))
    }

    /// A jump to a label under a condition. Where that is not known it is not made.
    fn goto(&mut self, label: &str, holds: Option<f64>, next: Place) -> Step {
        let holds = holds.filter(|holds| !holds.is_nan());
        if holds == Some(0.0) {
            return Step::Done;
        }
        let to = self.index.label(label, next.line);
        match (holds, to) {
            (Some(_), Some(to)) if self.is_sure() => return Step::Go(to),
            (None, Some(to)) if self.runs && self.index.leads_out(to) => {
                return Step::BranchEnds(None);
            }
            _ => {}
        }
        let below = to.filter(|to| to.line >= next.line);
        if below.is_none() {
            self.variables.forget();
        }
        let astray = holds.is_some() && to.is_none() && self.is_sure();
        let line = below.map_or(NOWHERE, |to| to.line);
        if !self.leaps.contains(&line) {
            self.leaps.push(line);
        }
        if astray {
            return Step::Astray;
        }
        below.map_or(Step::AsWritten, |to| Step::MayJump(to.line))
    }

    /// `CASE R1 OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`.
    fn case(&mut self, mut cursor: Cursor<'_>, next: Place) -> Step {
        let value = cursor.value(&mut self.variables);
        let mut known = cursor.eat("OF") && value.is_some_and(|value| !value.is_nan());
        while known && !cursor.rest.trim().is_empty() {
            let is_default = cursor.eat("DEFAULT");
            let constant = if is_default {
                None
            } else {
                cursor.value(&mut self.variables)
            };
            let Some(label) = jump(&mut cursor) else {
                known = false;
                break;
            };
            if is_default || constant == value {
                return self.goto(label, Some(1.0), next);
            }
        }
        if known {
            return Step::Done;
        }
        // It may go on at any of the labels.
        self.variables.forget();
        if !self.leaps.contains(&NOWHERE) {
            self.leaps.push(NOWHERE);
        }
        Step::Astray
    }

    /// `IF` with `ENDIF`.
    fn branch(&mut self, holds: Option<f64>, here: Place) -> Step {
        let Some((other, end)) = self.index.branches(here.line) else {
            return Step::AsWritten;
        };
        match holds.filter(|holds| !holds.is_nan()) {
            Some(0.0) => Step::Go(other.unwrap_or(end)),
            Some(_) => Step::Done,
            None if self.runs && other.is_none() && self.index.ends_before(here.line, end.line) => {
                Step::BranchEnds(Some(end))
            }
            None => {
                self.unsure.push(end.line);
                if !self.unknown.contains(&here.line) {
                    self.unknown.push(here.line);
                }
                Step::AsWritten
            }
        }
    }

    /// Whether the condition that a line closes, or whose ELSE it is, is not known.
    fn is_unknown(&self, line: usize) -> bool {
        self.index
            .begin(line)
            .is_none_or(|begin| self.unknown.contains(&begin.line))
    }

    /// The words of conditions and loops behind their first one.
    fn structure(&mut self, code: &str, here: Place, next: Place) -> Option<Step> {
        let mut cursor = Cursor::new(code);
        let structure = Structure::of(code)?;
        Some(match structure {
            Structure::If => return None,
            // The branch before it was run.
            Structure::Else if !self.is_unknown(here.line) => {
                self.index.end(here.line).map_or(Step::AsWritten, Step::Go)
            }
            Structure::EndIf if !self.is_unknown(here.line) => Step::Done,
            Structure::EndIf => {
                let begin = self.index.begin(here.line);
                self.unknown
                    .retain(|line| begin.is_none_or(|begin| begin.line != *line));
                Step::AsWritten
            }
            Structure::Else => Step::AsWritten,
            Structure::While => {
                cursor.eat("WHILE");
                let holds = cursor.value(&mut self.variables);
                self.begins(holds, here, None)
            }
            Structure::Loop | Structure::Repeat => self.begins(Some(1.0), here, None),
            Structure::For => {
                cursor.eat("FOR");
                self.for_(cursor, here)
            }
            Structure::EndWhile | Structure::EndLoop | Structure::EndFor => {
                match self.own_loop(here.line) {
                    Some(begin) => Step::Go(begin),
                    None => self.unsure_loop_ends(),
                }
            }
            Structure::Until => {
                cursor.eat("UNTIL");
                let holds = cursor
                    .value(&mut self.variables)
                    .filter(|holds| !holds.is_nan());
                match (self.own_loop(here.line), holds) {
                    (Some(begin), Some(0.0)) => Step::Go(begin),
                    (Some(_), Some(_)) => {
                        self.loops.pop();
                        Step::Go(next)
                    }
                    (Some(_), None) => {
                        self.loops.pop();
                        self.variables.forget();
                        Step::LoopEnds
                    }
                    (None, _) => self.unsure_loop_ends(),
                }
            }
        })
    }

    /// A loop begins, or its next round.
    fn begins(&mut self, holds: Option<f64>, here: Place, variable: Option<String>) -> Step {
        let Some(end) = self.index.end(here.line) else {
            return Step::AsWritten;
        };
        let running = self.loops.last().is_some_and(|own| own.line == here.line);
        match holds.filter(|holds| !holds.is_nan()) {
            Some(0.0) => {
                if running {
                    self.loops.pop();
                }
                Step::Go(end)
            }
            Some(_) => {
                if !running {
                    self.loops.push(Loop {
                        line: here.line,
                        variable,
                    });
                }
                Step::Done
            }
            None => {
                if running {
                    self.loops.pop();
                }
                self.unsure.push(end.line);
                Step::AsWritten
            }
        }
    }

    /// `FOR I=1 TO 5`: counts up by one.
    fn for_(&mut self, mut cursor: Cursor<'_>, here: Place) -> Step {
        let Some(name) = cursor.variable(&mut self.variables) else {
            return self.begins(None, here, None);
        };
        let first = if cursor.eat("=") {
            cursor.value(&mut self.variables)
        } else {
            None
        };
        let last = if cursor.eat("TO") {
            cursor.value(&mut self.variables)
        } else {
            None
        };
        let (Some(first), Some(last)) = (first, last) else {
            return self.begins(None, here, None);
        };
        let running = self
            .loops
            .last()
            .is_some_and(|own| own.line == here.line && own.variable.is_some());
        let now = if running {
            self.variables.get(&name) + 1.0
        } else {
            first
        };
        self.variables.set(&name, now);
        let holds = if now.is_nan() || last.is_nan() {
            f64::NAN
        } else {
            f64::from(u8::from(now <= last))
        };
        self.begins(Some(holds), here, Some(name))
    }

    /// Where the innermost loop begins, where this line closes it.
    fn own_loop(&self, line: usize) -> Option<Place> {
        let begin = self.index.begin(line)?;
        self.loops
            .last()
            .filter(|own| own.line == begin.line)
            .map(|_| begin)
    }

    /// What another round may set is not known.
    fn unsure_loop_ends(&mut self) -> Step {
        self.variables.forget();
        Step::AsWritten
    }

    /// `DEF REAL A, B=5, C[3]`.
    fn define(&mut self, rest: &str) -> Step {
        let mut cursor = Cursor::new(rest);
        let types = ["REAL", "INT", "BOOL", "CHAR", "STRING", "AXIS", "FRAME"];
        let kind = types.into_iter().find(|kind| cursor.eat(kind));
        if kind == Some("STRING") {
            cursor.index(&mut self.variables);
        }
        while let Some(name) = cursor.word() {
            let is_list = cursor.rest.starts_with('[');
            let size = cursor.index(&mut self.variables);
            let set = cursor.eat("=");
            let list = if set && is_list && cursor.eat("SET") && cursor.eat("(") {
                self.list(&mut cursor)
            } else {
                Vec::new()
            };
            let first = if set && list.is_empty() {
                cursor.value(&mut self.variables).unwrap_or(f64::NAN)
            } else {
                0.0
            };
            let known = if matches!(kind, Some("REAL" | "INT" | "BOOL")) {
                first
            } else {
                f64::NAN
            };
            match size
                .as_deref()
                .and_then(|size| size.trim_matches(['[', ']']).parse::<usize>().ok())
                .filter(|_| is_list)
            {
                Some(size) => (0..size.min(1000)).for_each(|i| {
                    let value = list.get(i).copied().unwrap_or(known);
                    self.variables.define(&format!("{name}[{i}]"), value);
                }),
                None => self.variables.define(name, known),
            }
            if !cursor.eat(",") {
                break;
            }
        }
        Step::Done
    }

    /// The values of `SET(1, R2, 3)`, behind its bracket.
    fn list(&mut self, cursor: &mut Cursor<'_>) -> Vec<f64> {
        const MOST: usize = 1000;
        let mut values = Vec::new();
        while values.len() < MOST && !cursor.eat(")") {
            let Some(value) = cursor.value(&mut self.variables) else {
                break;
            };
            values.push(value);
            cursor.eat(",");
        }
        values
    }

    /// A subprogram of the same text: `MEASURE(5, R1)`.
    fn call(&mut self, code: &str, next: Place) -> Option<Step> {
        let mut cursor = Cursor::new(code);
        let name = cursor.word()?;
        let (begin, parameters, last) = self
            .index
            .subprogram(name)
            .filter(|_| self.frames.len() < DEEPEST && self.is_sure())?;
        let mut given = Vec::new();
        if cursor.eat("(") {
            while !cursor.eat(")") {
                if cursor.eat(",") {
                    given.push(0.0);
                    continue;
                }
                given.push(cursor.value(&mut self.variables)?);
                cursor.eat(",");
            }
        }
        cursor.rest.trim().is_empty().then_some(())?;
        self.variables.enter();
        for (i, name) in parameters.iter().enumerate() {
            self.variables
                .define(name, given.get(i).copied().unwrap_or(0.0));
        }
        if self.ran.len() < 500 {
            self.ran.push((begin.line.saturating_sub(1), last));
        }
        self.frames.push(Frame {
            back: next,
            loops: self.loops.len(),
            unsure: self.unsure.len(),
        });
        Some(Step::Enter(begin))
    }

    fn leave(&mut self) -> Option<Place> {
        let frame = self.frames.pop()?;
        self.variables.leave();
        self.loops.truncate(frame.loops);
        self.unsure.truncate(frame.unsure);
        Some(frame.back)
    }

    /// A block of words: what is known in it becomes numbers, and what it assigns is set.
    fn words(&mut self, code: &str) -> Step {
        if !code.contains('=') {
            return Step::AsWritten;
        }
        let mut out = String::with_capacity(code.len());
        let mut cursor = Cursor::new(code);
        let (mut known, mut assigns) = (true, false);
        while let Some(sign) = cursor.rest.chars().next() {
            if sign == '"' {
                let end = cursor.rest[1..]
                    .find('"')
                    .map_or(cursor.rest.len(), |end| end + 2);
                out.push_str(&cursor.rest[..end]);
                cursor.rest = &cursor.rest[end..];
                continue;
            }
            let before = cursor.rest;
            let word = cursor.word();
            let Some(word) = word else {
                out.push(sign);
                cursor.rest = &before[sign.len_utf8()..];
                continue;
            };
            let index = cursor.index(&mut self.variables);
            let assigned = cursor.rest.trim_start();
            if !assigned.starts_with('=') || assigned.starts_with("==") {
                out.push_str(&before[..before.len() - cursor.rest.len()]);
                continue;
            }
            cursor.rest = &assigned[1..];
            if is_address(word) {
                let (wrap, value) = self.address(&mut cursor);
                let Some(value) = value else {
                    // What is not understood the reader reports.
                    out.push_str(before);
                    break;
                };
                // What is not known stands there as a variable, which the reader knows for one.
                let value = if value.is_nan() {
                    "R0".to_owned()
                } else {
                    decimal(value, 9)
                };
                let text = wrap.map_or_else(|| value.clone(), |wrap| format!("{wrap}({value})"));
                out.push_str(&format!(" {word}={text} "));
                continue;
            }
            assigns = true;
            match self.assign(word, index, &mut cursor) {
                Some(value) => known &= !value.is_nan(),
                None => {
                    // It may be any of them, or the text is not understood.
                    self.variables.forget();
                    return Step::AsWritten;
                }
            }
        }
        match out.trim().is_empty() {
            true if assigns && known => Step::Done,
            true if assigns => Step::AsWritten,
            _ => Step::Read(out.trim().as_bytes().to_vec()),
        }
    }

    /// Gives a variable the value that follows; none where it is not known which, or the value is not understood.
    fn assign(
        &mut self,
        word: &str,
        index: Option<String>,
        cursor: &mut Cursor<'_>,
    ) -> Option<f64> {
        let frame = word.starts_with("$P_") && cursor.rest.trim_start().starts_with('C');
        let value = if frame {
            // CTRANS( … ): a whole frame, which is not followed.
            cursor.rest = "";
            f64::NAN
        } else {
            cursor.value(&mut self.variables)?
        };
        let index = index?;
        let name = match word {
            "R" if index.len() > 2 => format!("R{}", &index[1..index.len() - 1]),
            word => format!("{word}{index}"),
        };
        let value = if self.is_sure() { value } else { f64::NAN };
        if let Some(variable) = writes::of_name(&name) {
            self.written.push((variable, value));
        }
        self.variables.set(&name, value);
        Some(value)
    }

    /// What stands behind the sign of an address: a value, or one in `IC( )`, `AC( )`, `DC( )`.
    fn address(&mut self, cursor: &mut Cursor<'_>) -> (Option<&'static str>, Option<f64>) {
        let before = cursor.rest;
        for wrap in ["IC", "AC", "DC", "ACP", "ACN"] {
            if cursor.eat(wrap) && cursor.eat("(") {
                let value = cursor.value(&mut self.variables);
                return (Some(wrap), if cursor.eat(")") { value } else { None });
            }
            cursor.rest = before;
        }
        (None, cursor.value(&mut self.variables))
    }
}

impl Flow for Sinumerik {
    fn step(&mut self, line: &[u8], here: Place, next: Place, _inside: usize) -> Step {
        self.blocks += 1;
        if self.blocks > MOST_BLOCKS || self.unsure.len() + self.loops.len() > MOST_OPEN {
            return Step::Stop;
        }
        self.variables.line = here.line;
        self.leaps.retain(|leap| *leap != here.line);
        self.unsure.retain(|end| *end != here.line);
        let head = head(line);
        let code = &line[head.end..];
        let code = &code[..comment_at(code, false).unwrap_or(code.len())];
        if code.is_empty() {
            return Step::AsWritten;
        }
        let text = String::from_utf8_lossy(code).to_ascii_uppercase();
        // A label stands in front.
        let code = index::without_label(text.trim());
        if head.skips {
            self.unsure.push(NOWHERE);
            let step = self.block(code, here, next);
            self.unsure.pop();
            return if matches!(step, Step::Read(_)) {
                step
            } else {
                Step::AsWritten
            };
        }
        if code.is_empty() {
            Step::AsWritten
        } else {
            self.block(code, here, next)
        }
    }

    fn forget(&mut self) {
        self.variables.forget();
    }

    fn fall_out(&mut self, _at_end: bool) -> Option<Place> {
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
        self.variables.system = system.of_sinumerik();
    }

    fn asks(&self) -> Vec<Ask> {
        self.variables.asks()
    }

    fn written(&mut self) -> Vec<(Variable, f64)> {
        std::mem::take(&mut self.written)
    }

    fn uncalled(&mut self, _end: Place) -> Option<(String, Place)> {
        None
    }
}

/// The label that a jump goes to: `GOTOF END`, `GOTOB`, `GOTO`.
fn jump<'b>(cursor: &mut Cursor<'b>) -> Option<&'b str> {
    const WORDS: [&str; 4] = ["GOTOF", "GOTOB", "GOTOC", "GOTO"];
    WORDS
        .into_iter()
        .any(|word| cursor.eat(word))
        .then(|| cursor.word())
        .flatten()
}

/// Whether what is assigned is an address of the control, and no variable.
fn is_address(word: &str) -> bool {
    const WORDS: [&str; 15] = [
        "RPL", "CR", "AR", "AP", "RP", "MEAS", "MEAW", "SPOS", "SPOSA", "RND", "RNDM", "CHF",
        "CHR", "TURN", "ANG",
    ];
    let mut bytes = word.bytes();
    let letter = bytes
        .next()
        .is_some_and(|b| b.is_ascii_alphabetic() && b != b'R');
    letter && bytes.all(|b| b.is_ascii_digit()) && word.len() <= 3 || WORDS.contains(&word)
}
