//! O words of LinuxCNC: branches, loops, subroutines; and the loops of macro B, which run likewise.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::{Flow, Step};
use crate::import::toolpath::key::Key;
use crate::import::toolpath::macros::index::{Keyword, o_word};
use crate::import::toolpath::macros::value::{Cursor, Value};
use crate::import::toolpath::macros::{DEEPEST, Macros, NOWHERE, Open};

impl Macros {
    /// `o<name> call [5]`, `o1 if [#2 GT 0]` and their kin.
    pub(super) fn o_word(&mut self, code: &[u8], here: Place, next: Place) -> Step {
        let Some((label, keyword, rest)) = o_word(code) else {
            return Step::AsWritten;
        };
        let value = Cursor::new(code, rest, &self.variables).bracketed();
        match keyword {
            Keyword::Sub => Step::to(self.index.find(&label, &[Keyword::EndSub], here.line)),
            Keyword::EndSub | Keyword::Return
                if !self.frames.last().is_some_and(|frame| frame.linuxcnc) =>
            {
                Step::AsWritten
            }
            Keyword::Return if self.is_guarded() => self.may_leave(),
            Keyword::EndSub | Keyword::Return => {
                let back = self.leave();
                // The interpreter sets both to 0 where no value is returned.
                let is_returned = !code[rest..].trim_ascii().is_empty();
                let returned = f64::from(u8::from(is_returned));
                let none = if is_returned {
                    Value::Unknown
                } else {
                    Value::Number(0.0)
                };
                for (name, value) in [
                    ("_value", value.unwrap_or(none)),
                    ("_value_returned", Value::Number(returned)),
                ] {
                    let value = if self.is_sure() {
                        value
                    } else {
                        Value::Unknown
                    };
                    self.variables.set(Key::Name(name.to_owned()), value);
                }
                back.map_or(Step::AsWritten, Step::Leave)
            }
            Keyword::Call => self.call(code, &label, rest, next),
            Keyword::If => self.branch(label, value, here),
            Keyword::ElseIf if self.open.last() == Some(&Open::ElseIf(label.clone())) => {
                self.open.pop();
                self.unsure_begins(label);
                Step::Condition
            }
            // The branch before it was run.
            Keyword::ElseIf | Keyword::Else
                if self.open.last() == Some(&Open::Branch(label.clone())) =>
            {
                self.open.pop();
                Step::to(self.index.find(&label, &[Keyword::EndIf], here.line))
            }
            Keyword::ElseIf | Keyword::Else => Step::AsWritten,
            Keyword::EndIf if self.open.last() == Some(&Open::Branch(label.clone())) => {
                self.open.pop();
                Step::Done
            }
            Keyword::EndIf => self.unsure_ends(&label),
            _ => self.loop_word(label, keyword, value, here, next),
        }
    }

    /// The words of loops, with their condition or count.
    fn loop_word(
        &mut self,
        label: String,
        keyword: Keyword,
        value: Option<Value>,
        here: Place,
        next: Place,
    ) -> Step {
        match keyword {
            Keyword::Do => self.begins(label, here, usize::MAX),
            Keyword::While if self.index.closes_do(&label, here.line) => {
                let ends = matches!(self.open.last(), Some(Open::Loop(_, _, 0)));
                match (self.loop_of(&label), value.filter(|_| !ends)) {
                    (Some(begin), Some(Value::Number(truth))) if truth != 0.0 => Step::Go(begin),
                    (Some(_), known) => {
                        self.open.pop();
                        if matches!(known, Some(Value::Number(_))) {
                            return Step::Done;
                        }
                        // What it sets, and what it moves by a distance, may be another after the next round.
                        self.forget();
                        Step::LoopEnds
                    }
                    (None, _) => Step::AsWritten,
                }
            }
            Keyword::While => self.while_(label, value, here),
            Keyword::Repeat => match value {
                Some(Value::Number(times)) if times >= 1.0 => {
                    self.begins(label, next, times as usize)
                }
                Some(Value::Number(_)) => {
                    Step::to(self.index.find(&label, &[Keyword::EndRepeat], here.line))
                }
                _ => self.unsure_begins(label),
            },
            Keyword::EndWhile => self.end_of_loop(&label),
            Keyword::EndRepeat => self.again(&label),
            // It may leave the loop here, or a round of it.
            Keyword::Break | Keyword::Continue if self.is_guarded() => {
                self.leaps_to(NOWHERE);
                if keyword == Keyword::Break {
                    self.may_end(&label);
                }
                Step::AsWritten
            }
            Keyword::Break => self.out_of(&label, here),
            Keyword::Continue => {
                let Some((own, ..)) = self.loop_around(&label) else {
                    return Step::AsWritten;
                };
                self.open.truncate(own + 1);
                Step::to(self.index.closing_word(&label, here.line))
            }
            _ => Step::AsWritten,
        }
    }

    fn call(&mut self, code: &[u8], label: &str, rest: usize, next: Place) -> Step {
        let mut arguments = Vec::new();
        let mut cursor = Cursor::new(code, rest, &self.variables);
        while cursor.peek() == Some(b'[') {
            let Some(value) = cursor.bracketed() else {
                break;
            };
            arguments.push((arguments.len() as i32 + 1, value));
        }
        let understood = !matches!(cursor.peek(), Some(b'['));
        let Some((begin, end)) = self
            .index
            .subroutine(label)
            .filter(|_| understood && self.frames.len() < DEEPEST)
        else {
            // It may set any variable but the locals here.
            self.variables.forget_shared();
            return Step::AsWritten;
        };
        self.runs(begin, end);
        self.enter(next, true, 0, arguments);
        Step::Enter(begin)
    }

    fn branch(&mut self, label: String, condition: Option<Value>, here: Place) -> Step {
        match condition {
            Some(Value::Number(truth)) if truth != 0.0 => {
                self.open.push(Open::Branch(label));
                Step::Done
            }
            Some(Value::Number(_)) => self.other_branch(label, here),
            _ => match self
                .index
                .ending_branch(&label, here.line)
                .filter(|_| self.spares())
            {
                Some(below) => Step::BranchEnds(Some(below)),
                None => self.unsure_begins(label),
            },
        }
    }

    /// The first branch below whose condition holds, or the end of the `if`.
    fn other_branch(&mut self, label: String, here: Place) -> Step {
        let mut from = here.line;
        while let Some(branch) = self.index.branch_below(&label, from) {
            let condition = match branch.keyword {
                Keyword::ElseIf => Cursor::new(&branch.condition, 0, &self.variables).bracketed(),
                Keyword::Else => Some(Value::Number(1.0)),
                _ => return Step::Go(branch.below),
            };
            let (here, below) = (branch.here, branch.below);
            match condition {
                Some(Value::Number(0.0)) => from = here.line,
                Some(Value::Number(_)) => {
                    self.open.push(Open::Branch(label));
                    return Step::Go(below);
                }
                // From there on it is not known which of them is run.
                _ => {
                    self.open.push(Open::ElseIf(label));
                    return Step::Go(here);
                }
            }
        }
        Step::AsWritten
    }

    fn unsure_begins(&mut self, label: String) -> Step {
        self.open.push(Open::Unsure(label));
        self.unsure += 1;
        Step::AsWritten
    }

    fn unsure_ends(&mut self, label: &str) -> Step {
        if matches!(self.open.last(), Some(Open::Unsure(own)) if own == label) {
            self.open.pop();
            self.unsure = self.unsure.saturating_sub(1);
        }
        Step::AsWritten
    }

    /// A loop begins, and runs so many times.
    fn begins(&mut self, label: String, begin: Place, times: usize) -> Step {
        match self.loop_around(&label) {
            Some((own, known, _)) if known == begin => self.open.truncate(own + 1),
            around => {
                // One of the same label that was left by a jump is over.
                self.open
                    .truncate(around.map_or(self.open.len(), |(own, ..)| own));
                self.open.push(Open::Loop(label, begin, times));
            }
        }
        Step::Done
    }

    pub(super) fn while_(&mut self, label: String, condition: Option<Value>, here: Place) -> Step {
        if matches!(condition, Some(Value::Number(truth)) if truth != 0.0) {
            return self.begins(label, here, usize::MAX);
        }
        if self.loop_of(&label) == Some(here) {
            self.open.pop();
        }
        match condition {
            Some(Value::Number(_)) => {
                Step::to(self.index.find(&label, &[Keyword::EndWhile], here.line))
            }
            _ => self.unsure_begins(label),
        }
    }

    /// Where the innermost structure begins, where it is this loop.
    fn loop_of(&self, label: &str) -> Option<Place> {
        match self.open.last() {
            Some(Open::Loop(own, begin, _)) if own == label => Some(*begin),
            _ => None,
        }
    }

    /// The loop of this label around what is open in this call: its index among the open structures, where it begins, how often it runs again.
    fn loop_around(&self, label: &str) -> Option<(usize, Place, usize)> {
        let first = self.frames.last().map_or(0, |frame| frame.open);
        self.open
            .iter()
            .enumerate()
            .skip(first)
            .rev()
            .find_map(|(at, open)| match open {
                Open::Loop(own, begin, times) if own == label => Some((at, *begin, *times)),
                _ => None,
            })
    }

    /// An unknown condition may have ended a loop: it makes no further round, which would be as unknown as this one.
    fn may_end(&mut self, label: &str) {
        if let Some((own, ..)) = self.loop_around(label)
            && let Some(Open::Loop(_, _, times)) = self.open.get_mut(own)
        {
            *times = 0;
        }
    }

    /// The end of a loop with a condition at its beginning.
    pub(super) fn end_of_loop(&mut self, label: &str) -> Step {
        match (self.loop_of(label), self.open.last()) {
            (Some(_), Some(Open::Loop(_, _, 0))) => {
                self.open.pop();
                self.forget();
                Step::LoopEnds
            }
            (Some(begin), _) => Step::Go(begin),
            (None, _) => self.unsure_loop_ends(label),
        }
    }

    /// What another round may set is not known, nor what it would set in a branch that this one did not run.
    fn unsure_loop_ends(&mut self, label: &str) -> Step {
        self.forget();
        self.unsure_ends(label)
    }

    /// The end of a `repeat`.
    fn again(&mut self, label: &str) -> Step {
        match self.open.last_mut() {
            Some(Open::Loop(own, begin, times)) if own == label => {
                let may_have_ended = *times == 0;
                let (begin, left) = (*begin, times.saturating_sub(1));
                *times = left;
                if left > 0 {
                    return Step::Go(begin);
                }
                self.open.pop();
                if may_have_ended {
                    self.forget();
                    return Step::LoopEnds;
                }
                Step::Done
            }
            _ => self.unsure_loop_ends(label),
        }
    }

    /// Out of a loop, whatever is open in it.
    fn out_of(&mut self, label: &str, here: Place) -> Step {
        let end = self.index.end_of_loop(label, here.line);
        if let (Some((own, ..)), Some(_)) = (self.loop_around(label), end) {
            self.open.truncate(own);
        }
        Step::to(end)
    }
}
