//! Runs the arithmetic and the jumps of a text before the reader. Known values are put into the blocks as numbers for the reader; unknown ones stay as written,
//! and the reader reports them.
//!
//! An unknown condition is not decided: the lines that it guards are read in order, and the values that they set are unknown afterwards.

use std::collections::BTreeMap;

use crate::control::iso::lex::head;
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::LineAction;
use crate::import::toolpath::frames::Axes;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::known::UnsetVariable;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::grammar::{Grammar, Keyword, Language};
use crate::import::toolpath::script::index::{Index, Subprogram};
use crate::import::toolpath::script::statement;
use crate::import::toolpath::script::variables::{Value, Variables};
use crate::import::toolpath::system::System;
use crate::import::toolpath::way::Way;
use crate::import::toolpath::writes::Variable;

/// Largest number of blocks in a run.
const MOST_BLOCKS: usize = 500_000;

/// Largest number of open structures.
const MOST_OPEN: usize = 5000;

/// A line that is never reached.
pub(super) const NOWHERE: usize = usize::MAX;

/// An open structure, by its span.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Open {
    /// One of its branches runs.
    Branch(usize),
    /// Whether its next `elseif` holds is unknown.
    ElseIf(usize),
    /// A loop, with its remaining rounds and the rounds made. It makes no further round if an unknown condition may have left it.
    Loop(usize, usize, usize),
    /// Its condition is unknown.
    Unsure(usize),
}

impl Open {
    fn span(self) -> usize {
        match self {
            Open::Branch(at) | Open::ElseIf(at) | Open::Loop(at, ..) | Open::Unsure(at) => at,
        }
    }
}

/// An active call: return position, and the uncertain structures that were open when it began.
#[derive(Debug)]
pub(super) struct Frame {
    back: Place,
    /// Whether the end of the text, or another program, is not a return.
    pub ends_by_word: bool,
    open: usize,
    /// Number of active M98 calls.
    pub inside: usize,
    unsure: usize,
    leaps: usize,
    /// Number of unknown conditions that may have returned from it: what follows in it is uncertain.
    left: usize,
    /// The line below a called file.
    end: usize,
}

/// Runs the macros of a text.
pub(in crate::import::toolpath) struct Machine {
    pub variables: Variables,
    pub index: Index,
    open: Vec<Open>,
    pub(super) frames: Vec<Frame>,
    /// Number of unknown conditions that guard this line.
    unsure: usize,
    /// Lines below that an unknown condition may have jumped to: up to them nothing is certain.
    leaps: Vec<usize>,
    blocks: usize,
    /// Remaining repetitions of the section called by a line.
    repeats: BTreeMap<usize, usize>,
    /// How often a branch that ends the program was not taken, by its line.
    spared: Vec<(usize, usize)>,
    /// Axes whose positions were computed so far.
    pub valued: Axes,
    /// Registers that the line has written.
    pub(super) written: Vec<(Variable, f64)>,
    /// Lines of subprograms that ran: from, up to.
    ran: Vec<(usize, usize)>,
    /// Whether the program is run with known inputs instead of only read.
    pub runs: bool,
    /// Subroutines that nothing in the text calls, the last first.
    uncalled: Vec<Subprogram>,
}

impl Machine {
    /// The program is the first bytes of the text; lines below may be called. `set` has the user's values of variables.
    pub fn new(
        text: &str,
        end: usize,
        grammar: &'static Grammar,
        set: &[(&str, f64)],
        files: &[(u32, String)],
    ) -> Self {
        let index = Index::of(text, grammar, files);
        let uncalled = if grammar.language.is_macro() {
            index.uncalled(end)
        } else {
            Vec::new()
        };
        Machine {
            uncalled,
            ..Machine::over(index, grammar, set)
        }
    }

    /// A machine over the positions of a program.
    pub fn over(index: Index, grammar: &'static Grammar, set: &[(&str, f64)]) -> Self {
        Machine {
            variables: Variables::new(grammar, set),
            uncalled: Vec::new(),
            index,
            open: Vec::new(),
            frames: Vec::new(),
            unsure: 0,
            leaps: Vec::new(),
            blocks: 0,
            repeats: BTreeMap::new(),
            spared: Vec::new(),
            valued: 0,
            written: Vec::new(),
            runs: false,
            ran: Vec::new(),
        }
    }

    fn language(&self) -> Language {
        self.variables.grammar.language
    }

    /// Records that the lines of a subprogram run, with the line of its name.
    pub(super) fn runs(&mut self, begin: Place, end: usize) {
        const MOST_KNOWN: usize = 500;
        let lines = (begin.line.saturating_sub(1), end);
        if self.ran.len() < MOST_KNOWN && !self.ran.contains(&lines) {
            self.ran.push(lines);
        }
    }

    /// Whether assignments of a block are certain.
    pub fn is_sure(&self) -> bool {
        self.unsure == 0 && self.leaps.is_empty()
    }

    /// Whether an unknown condition of this call guards the block: a jump in it may not be made, and the lines that it skips may run.
    pub(super) fn is_guarded(&self) -> bool {
        let (unsure, leaps) = self
            .frames
            .last()
            .map_or((0, 0), |frame| (frame.unsure + frame.left, frame.leaps));
        self.unsure > unsure || self.leaps.len() > leaps
    }

    /// Runs a part of a block that is guarded by an unknown condition.
    pub(super) fn guarded<T>(&mut self, is_unknown: bool, run: impl FnOnce(&mut Self) -> T) -> T {
        let guards = usize::from(is_unknown);
        self.unsure += guards;
        let done = run(self);
        self.unsure = self.unsure.saturating_sub(guards);
        done
    }

    /// Up to a line nothing is certain in this call: each line once, however often a loop repeats it.
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

    /// The program may continue at a position: up to it nothing is certain. A repetition by a jump back may set any variable again.
    pub(super) fn leap(&mut self, to: Option<Place>, next: Place) -> LineAction {
        match to {
            Some(below) if below.line >= next.line => {
                self.leaps_to(below.line);
                LineAction::MayJump(below.line)
            }
            // After a jump back it continues when its rounds are over.
            Some(_) => {
                self.forget();
                LineAction::Way(Way::LoopLeft(self.valued))
            }
            None => {
                self.forget();
                self.leaps_to(NOWHERE);
                LineAction::AsWritten
            }
        }
    }

    /// A conditional jump. If the condition is unknown, or an unknown one guards the jump, it is not made: the lines are read in order.
    pub fn jump(&mut self, to: Option<Place>, holds: Option<bool>, next: Place) -> LineAction {
        match (holds, to) {
            (Some(false), _) => return LineAction::Skip,
            (Some(true), Some(to)) if !self.is_guarded() => return LineAction::JumpTo(to),
            // One of the two branches ends: the program follows the other one.
            (None, Some(to)) if self.runs && self.index.leads_out(to) && self.spares() => {
                return LineAction::BranchEnds(None);
            }
            _ => {}
        }
        // A jump that is made to an unknown block.
        let is_astray = holds == Some(true) && to.is_none() && !self.is_guarded();
        let leap = self.leap(to, next);
        if is_astray { LineAction::Astray } else { leap }
    }

    /// Whether the ending branch of a line may be skipped once more: a loop that only it ends would not end.
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

    /// Whether the call in a line repeats its section once more.
    pub fn repeats(&mut self, here: Place, times: usize) -> bool {
        let left = self.repeats.entry(here.line).or_insert(times);
        if *left == 0 {
            self.repeats.remove(&here.line);
            return false;
        }
        *left -= 1;
        true
    }

    /// Whether one more call is possible.
    pub fn may_call(&self) -> bool {
        self.frames.len() < self.variables.grammar.deepest
    }

    pub fn enter(
        &mut self,
        back: Place,
        ends_by_word: bool,
        inside: usize,
        arguments: Vec<(Key, Value)>,
    ) {
        let (open, unsure, leaps) = (self.open.len(), self.unsure, self.leaps.len());
        self.variables.enter(arguments);
        self.frames.push(Frame {
            back,
            ends_by_word,
            open,
            inside,
            unsure,
            leaps,
            left: 0,
            end: usize::MAX,
        });
    }

    /// Returns from a call; `None` outside of calls.
    pub fn leave(&mut self) -> Option<Place> {
        let frame = self.frames.pop()?;
        self.variables.leave();
        self.open.truncate(frame.open);
        self.unsure = frame.unsure;
        self.leaps.truncate(frame.leaps);
        Some(frame.back)
    }

    /// It may return from the call here or not: what follows in it is uncertain.
    pub(super) fn may_leave(&mut self) -> LineAction {
        let Some(frame) = self.frames.last_mut() else {
            return LineAction::AsWritten;
        };
        frame.left += 1;
        self.unsure += 1;
        LineAction::MayLeave(frame.back.line)
    }

    /// Closes everything above a level of the stack.
    fn close_to(&mut self, length: usize) {
        while self.open.len() > length {
            if let Some(Open::Unsure(_)) = self.open.pop() {
                self.unsure = self.unsure.saturating_sub(1);
            }
        }
    }

    /// Opens a structure. One of the same span that a jump has left is closed.
    fn opens(&mut self, open: Open) {
        if let Some((at, _)) = self.opened(open.span()) {
            self.close_to(at);
        }
        self.unsure += usize::from(matches!(open, Open::Unsure(_)));
        self.open.push(open);
    }

    /// The open structure of a span in this call, and its index on the stack.
    fn opened(&self, span: usize) -> Option<(usize, Open)> {
        let first = self.frames.last().map_or(0, |frame| frame.open);
        let own = self.open.get(first..)?;
        let at = own.iter().rposition(|open| open.span() == span)?;
        Some((first + at, own[at]))
    }

    fn unsure_begins(&mut self, span: usize) -> LineAction {
        self.opens(Open::Unsure(span));
        LineAction::Way(match self.index.span(span).keyword {
            Keyword::If => Way::Begins,
            _ => Way::LoopBegins,
        })
    }

    /// A word of a structure, with the value of its condition or count.
    pub(super) fn structure(
        &mut self,
        keyword: Keyword,
        value: Option<Value>,
        here: Place,
    ) -> LineAction {
        let Some(span) = self.index.span_at(here.line) else {
            // The end of a loop without a start: it may set anything.
            if matches!(
                keyword,
                Keyword::EndWhile | Keyword::EndRepeat | Keyword::EndFor | Keyword::EndLoop
            ) {
                self.forget();
            }
            return LineAction::AsWritten;
        };
        let is_end = self
            .index
            .span(span)
            .end
            .is_some_and(|(end, _)| end == here);
        match keyword {
            Keyword::If => self.if_(span, value.and_then(Value::holds)),
            Keyword::ElseIf => match self.opened(span) {
                Some((at, Open::ElseIf(_))) => {
                    self.close_to(at);
                    self.unsure_begins(span)
                }
                _ => self.next_branch(span, false),
            },
            Keyword::Else => self.next_branch(span, true),
            Keyword::EndIf => self.structure_ends(span),
            // The `while` of a `do` continues if it holds, an UNTIL if it does not.
            Keyword::While if is_end => self.do_ends(span, value.and_then(Value::holds)),
            Keyword::Until => self.do_ends(span, value.and_then(Value::holds).map(|holds| !holds)),
            Keyword::Do => self.loop_begins(span, usize::MAX),
            Keyword::While | Keyword::For => self.while_(span, value.and_then(Value::holds)),
            Keyword::Loop => self.while_(span, Some(true)),
            Keyword::Repeat => match value {
                Some(Value::Number(times)) if times >= 1.0 => {
                    self.loop_begins(span, times as usize)
                }
                Some(Value::Number(_)) => self.below(span),
                _ => self.unsure_begins(span),
            },
            Keyword::EndRepeat => self.again(span),
            Keyword::EndWhile | Keyword::EndFor | Keyword::EndLoop => self.loop_ends(span),
            _ => LineAction::AsWritten,
        }
    }

    /// The end of a condition.
    fn structure_ends(&mut self, span: usize) -> LineAction {
        match self.opened(span) {
            Some((at, Open::Unsure(_))) => {
                self.close_to(at);
                LineAction::Way(Way::Ends)
            }
            Some((at, _)) => {
                self.close_to(at);
                LineAction::Skip
            }
            None => LineAction::Skip,
        }
    }

    /// The line below the end of a structure; without one the block is read as written.
    fn below(&self, span: usize) -> LineAction {
        LineAction::to(self.index.span(span).end.map(|(_, below)| below))
    }

    fn if_(&mut self, span: usize, holds: Option<bool>) -> LineAction {
        match holds {
            Some(true) => {
                self.opens(Open::Branch(span));
                LineAction::Skip
            }
            Some(false) => self.other_branch(span),
            None => {
                let below = self.index.span(span).end.map(|(_, below)| below);
                let is_left = self.runs && self.index.is_ending(span) && self.spares();
                match below.filter(|_| is_left) {
                    Some(below) => LineAction::BranchEnds(Some(below)),
                    None => self.unsure_begins(span),
                }
            }
        }
    }

    /// The first further branch with a true condition, or the end of the `if`.
    fn other_branch(&mut self, span: usize) -> LineAction {
        for branch in &self.index.span(span).branches {
            let (here, below) = (branch.here, branch.below);
            let holds = match &branch.condition {
                Some(condition) => Cursor::new(condition, 0, &self.variables)
                    .value()
                    .and_then(Value::holds),
                None => Some(true),
            };
            match holds {
                Some(false) => {}
                Some(true) => {
                    self.opens(Open::Branch(span));
                    return LineAction::JumpTo(below);
                }
                // From there on it is unknown which of them runs.
                None => {
                    self.opens(Open::ElseIf(span));
                    return LineAction::JumpTo(here);
                }
            }
        }
        self.below(span)
    }

    /// A further branch is reached from the one above it: that one ran, or it is unknown whether it did.
    fn next_branch(&mut self, span: usize, otherwise: bool) -> LineAction {
        match self.opened(span) {
            Some((at, Open::Branch(_))) => {
                self.close_to(at);
                self.below(span)
            }
            Some((_, Open::Unsure(_))) => LineAction::Way(Way::Branches { otherwise }),
            _ => LineAction::AsWritten,
        }
    }

    /// A loop begins with this number of rounds.
    fn loop_begins(&mut self, span: usize, times: usize) -> LineAction {
        match self.opened(span) {
            Some((at, Open::Loop(..))) => self.close_to(at + 1),
            _ => self.opens(Open::Loop(span, times, 0)),
        }
        LineAction::Skip
    }

    /// A loop with its condition at the beginning.
    fn while_(&mut self, span: usize, holds: Option<bool>) -> LineAction {
        if holds == Some(true) {
            return self.loop_begins(span, usize::MAX);
        }
        if let Some((at, Open::Loop(..))) = self.opened(span) {
            self.close_to(at);
        }
        match holds {
            Some(_) => self.below(span),
            None => self.unsure_begins(span),
        }
    }

    /// The end of a loop with its condition at the beginning.
    fn loop_ends(&mut self, span: usize) -> LineAction {
        match self.opened(span) {
            Some((at, Open::Loop(_, 0, _))) => {
                self.close_to(at);
                self.forget();
                LineAction::Way(Way::LoopLeft(self.valued))
            }
            Some((at, Open::Loop(_, times, rounds))) => {
                self.close_to(at);
                self.open.push(Open::Loop(span, times, rounds + 1));
                LineAction::JumpTo(self.index.span(span).begin)
            }
            _ => self.unsure_loop_ends(span),
        }
    }

    /// The end of a loop with its condition there.
    fn do_ends(&mut self, span: usize, goes_on: Option<bool>) -> LineAction {
        let Some((at, Open::Loop(_, times, _))) = self.opened(span) else {
            return self.unsure_loop_ends(span);
        };
        match goes_on.filter(|_| times > 0) {
            Some(true) => {
                self.close_to(at + 1);
                LineAction::JumpTo(self.index.span(span).begin)
            }
            known => {
                self.close_to(at);
                if known.is_some() {
                    return LineAction::Skip;
                }
                // Its assignments, and its moves by a distance, may differ after the next round.
                self.forget();
                LineAction::Way(Way::LoopLeft(self.valued))
            }
        }
    }

    /// The end of a loop that runs a number of times.
    fn again(&mut self, span: usize) -> LineAction {
        let Some((at, Open::Loop(_, times, rounds))) = self.opened(span) else {
            return self.unsure_loop_ends(span);
        };
        if times > 1 {
            self.close_to(at);
            self.open.push(Open::Loop(span, times - 1, rounds + 1));
            return LineAction::JumpTo(self.index.span(span).below);
        }
        self.close_to(at);
        if times == 0 {
            self.forget();
            return LineAction::Way(Way::LoopLeft(self.valued));
        }
        LineAction::Skip
    }

    /// Assignments of further rounds are unknown, and so are those of a branch that this round did not run.
    fn unsure_loop_ends(&mut self, span: usize) -> LineAction {
        self.forget();
        if let Some((at, Open::Unsure(_))) = self.opened(span) {
            self.close_to(at);
            return LineAction::Way(Way::LoopEnds(self.valued));
        }
        LineAction::AsWritten
    }

    /// Leaves a loop with a label (true), or continues with its next round.
    pub(super) fn leaves_loop(&mut self, label: &str, is_break: bool) -> LineAction {
        let first = self.frames.last().map_or(0, |frame| frame.open);
        let own = |open: &Open| {
            let span = self.index.span(open.span());
            span.keyword != Keyword::If && span.label == label
        };
        let Some(at) = self.open[first..]
            .iter()
            .rposition(own)
            .map(|at| first + at)
        else {
            // The line below the loop that an unknown condition leaves.
            return self.leap(None, Place { at: 0, line: 0 });
        };
        let span = self.open[at].span();
        // It may leave the loop here, or one of its rounds.
        if self.is_guarded() {
            self.leaps_to(NOWHERE);
            // It makes no further round, which would be as unknown as this one.
            if let Open::Loop(_, times, _) = &mut self.open[at]
                && is_break
            {
                *times = 0;
            }
            return LineAction::AsWritten;
        }
        let end = self.index.span(span).end;
        if is_break {
            if end.is_some() {
                self.close_to(at);
            }
            return LineAction::to(end.map(|(_, below)| below));
        }
        self.close_to(at + 1);
        LineAction::to(end.map(|(here, _)| here))
    }

    /// Sets a variable, if that is certain. For an unknown value the reader reports that it is computed.
    pub(super) fn sets(&mut self, key: Key, value: Value) -> LineAction {
        let value = if self.is_sure() {
            value
        } else {
            Value::Unknown
        };
        self.variables.set(key, value);
        match value {
            Value::Unknown => LineAction::AsWritten,
            _ => LineAction::Skip,
        }
    }

    /// A word of a structure, with the text after it.
    pub(super) fn structure_word(
        &mut self,
        keyword: Keyword,
        code: &[u8],
        rest: usize,
        here: Place,
    ) -> LineAction {
        let value = match keyword {
            Keyword::For => self.counts(code, rest, here),
            _ => Cursor::new(code, rest, &self.variables).value(),
        };
        self.structure(keyword, value, here)
    }

    /// `FOR I=1 TO 5`: counts up by one until the last value is passed.
    fn counts(&mut self, code: &[u8], rest: usize, here: Place) -> Option<Value> {
        let mut cursor = Cursor::new(code, rest, &self.variables);
        let key = cursor.key()?;
        let first = cursor.eat("=").then(|| cursor.value())??;
        let last = cursor.eat("TO").then(|| cursor.value())??;
        let is_understood = cursor.is_done();
        let now = match self.is_running(here) {
            true => Value::of(self.variables.get(&key).or_nan() + 1.0),
            false => first,
        };
        let now = if self.is_sure() { now } else { Value::Unknown };
        self.variables.set(key, now);
        let (now, last) = (now.number()?, last.number()?);
        // Another step, `BY 2`, is not followed.
        is_understood.then_some(())?;
        Some(Value::Number(f64::from(u8::from(now <= last))))
    }

    /// Whether a loop runs, so that its next round begins.
    fn is_running(&self, here: Place) -> bool {
        let span = self.index.span_at(here.line);
        let open = span.and_then(|span| self.opened(span));
        matches!(open, Some((_, Open::Loop(..))))
    }

    /// Calls a file by its name; `None` if there is no such file.
    pub(super) fn calls_file(
        &mut self,
        name: &str,
        arguments: Vec<(Key, Value)>,
        next: Place,
        inside: usize,
    ) -> Option<LineAction> {
        let file = self.index.file_named(name).filter(|_| self.may_call())?;
        let (begin, end) = (file.begin, file.end);
        self.runs(begin, end);
        self.enter(next, false, inside, arguments);
        if let Some(frame) = self.frames.last_mut() {
            frame.end = end;
        }
        Some(LineAction::Enter(begin))
    }

    /// Ends the structures that end before a line by its indentation: the next round of a loop, or the end of an unknown condition. Each call ends those up to
    /// the first of these; `None` if nothing is left to end.
    pub fn dedents(&mut self, line: usize) -> Option<LineAction> {
        while let Some(open) = self.open.last().copied() {
            let span = open.span();
            let ends_here = |(end, below): (Place, Place)| end == below && end.line == line;
            if !self.index.span(span).end.is_some_and(ends_here) {
                break;
            }
            let step = match open {
                Open::Loop(..) => self.loop_ends(span),
                Open::Unsure(_) if self.index.span(span).keyword != Keyword::If => {
                    self.unsure_loop_ends(span)
                }
                _ => self.structure_ends(span),
            };
            match step {
                LineAction::Way(way) => return Some(LineAction::Again(way)),
                LineAction::JumpTo(_) => return Some(step),
                _ => {}
            }
        }
        None
    }

    /// Rounds that the innermost loop of this call has made; for one that begins on this line 0.
    pub(super) fn rounds(&self, here: Place) -> Value {
        let own = self.index.span_at(here.line);
        let begins = own.is_some_and(|span| {
            self.index.span(span).keyword != Keyword::If && self.opened(span).is_none()
        });
        if begins {
            return Value::Number(0.0);
        }
        let first = self.frames.last().map_or(0, |frame| frame.open);
        let innermost = self.open[first..].iter().rev().find_map(|open| match open {
            Open::Loop(_, _, rounds) => Some(Value::Number(*rounds as f64)),
            Open::Unsure(span) if self.index.span(*span).keyword != Keyword::If => {
                Some(Value::Unknown)
            }
            _ => None,
        });
        innermost.unwrap_or(Value::Unknown)
    }

    /// A block with a word that stops the program or has no effect here.
    pub(super) fn plain_word(&self, code: &[u8]) -> Option<LineAction> {
        let grammar = self.variables.grammar;
        let word = Cursor::new(code, 0, &self.variables).name()?;
        let is = |words: &[&str]| {
            words
                .iter()
                .any(|known| known.as_bytes().eq_ignore_ascii_case(word))
        };
        if is(grammar.ignored) {
            return Some(LineAction::Skip);
        }
        is(grammar.alarms).then(|| {
            if self.is_sure() {
                LineAction::Ends
            } else {
                LineAction::AsWritten
            }
        })
    }

    /// Treatment of a block, whose code begins at `begin`.
    fn block(
        &mut self,
        line: &[u8],
        begin: usize,
        here: Place,
        next: Place,
        inside: usize,
    ) -> LineAction {
        match self.language() {
            Language::Sinumerik => self.sinumerik(&statement::capitals(line), here, next),
            Language::RepRap => self.reprap(line, here, next),
            Language::Heidenhain => self.heidenhain(line, here, next),
            Language::Lnc | Language::Eding => self.nested(line, begin, here, next, inside),
            _ => self.macro_block(line, begin, here, next, inside),
        }
    }

    /// Registers of the control that the last line has written as variables, with their values: NaN is unknown.
    pub fn written(&mut self) -> Vec<(Variable, f64)> {
        std::mem::take(&mut self.written)
    }

    /// Lines with a division by zero.
    pub fn divisions(&self) -> Vec<u32> {
        self.variables.divisions()
    }

    /// Begins a block on a line; false if the run is too long.
    pub fn begins_block(&mut self, line: usize) -> bool {
        self.blocks += 1;
        self.variables.line = line;
        self.leaps.retain(|leap| *leap != line);
        self.blocks <= MOST_BLOCKS && self.open.len() <= MOST_OPEN
    }

    /// Treatment of the line at `here`; `inside` is the number of active M98 calls.
    pub fn step(&mut self, line: &[u8], here: Place, next: Place, inside: usize) -> LineAction {
        if !self.begins_block(here.line) {
            return LineAction::Stop;
        }
        if let Some(step) = self.dedents(here.line) {
            return step;
        }
        // A called file has ended.
        if self
            .frames
            .last()
            .is_some_and(|frame| frame.end <= here.line)
            && let Some(back) = self.leave()
        {
            return LineAction::Leave(back);
        }
        let head = head(line);
        if !head.skips {
            return self.block(line, head.end, here, next, inside);
        }
        // With block skip on, the control omits it.
        if self.turns_off(&line[head.end..]) {
            return self.leap(None, next);
        }
        if self.calls_by_words(&line[head.end..]) {
            self.leap(None, next);
            return LineAction::Astray;
        }
        let step = self.guarded(true, |machine| {
            machine.block(line, head.end, here, next, inside)
        });
        match step {
            LineAction::JumpTo(_) | LineAction::Skip if self.language() == Language::Sinumerik => {
                LineAction::AsWritten
            }
            step => step,
        }
    }

    /// Forgets all variables: something else may have set them.
    pub fn forget(&mut self) {
        self.variables.forget();
    }

    /// Forgets the variables that calls share: a macro was called, and its locals are separate.
    pub fn forget_shared(&mut self) {
        match self.language() {
            Language::Sinumerik => self.variables.forget(),
            _ => self.variables.forget_shared(),
        }
    }

    /// The lines of a subprogram end without a return, at the end of the text or at the next program.
    pub fn end_subprogram(&mut self, at_end: bool) -> Option<Place> {
        self.frames
            .last()
            .filter(|frame| at_end || !frame.ends_by_word)?;
        self.leave()
    }

    /// Whether a line ran where it was called.
    pub fn has_run(&self, line: usize) -> bool {
        self.language() == Language::Heidenhain
            || self
                .ran
                .iter()
                .any(|(from, to)| (*from..=*to).contains(&line))
    }

    /// Whether lines run because something called them.
    pub fn is_inside(&self) -> bool {
        !self.frames.is_empty()
    }

    /// Sets the values of the control before the next block.
    pub fn set_system(&mut self, system: System) {
        self.runs = true;
        self.variables.system = system;
    }

    /// Variables that were read before anything set them.
    pub fn asks(&self) -> Vec<UnsetVariable> {
        self.variables.asks()
    }

    /// The next subroutine that nothing calls: name, and start. It returns to `end`.
    pub fn uncalled(&mut self, end: Place) -> Option<(String, Place)> {
        let own = self.uncalled.pop()?;
        while !self.frames.is_empty() {
            self.leave();
        }
        (self.unsure, self.leaps, self.open) = (0, Vec::new(), Vec::new());
        self.runs(own.begin, own.end);
        self.enter(end, true, 0, Vec::new());
        self.variables.enter_uncalled();
        Some((own.name, own.begin))
    }
}
