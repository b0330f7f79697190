//! Word-address languages: O words of LinuxCNC, macro B of Fanuc and compatible controls.

use crate::control::iso::lex::{end_of_value, program_number};
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::LineAction;
use crate::import::toolpath::frames::Axes;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::grammar::{CENTROID, Keyword, Language};
use crate::import::toolpath::script::machine::Machine;
use crate::import::toolpath::script::statement::{
    self, Structure, aborts, begins, is_flow, o_word, without_comment,
};
use crate::import::toolpath::script::variables::Value;
use crate::import::toolpath::writes;
use crate::num::decimal;

/// Assignments of a block.
type Assigned = Vec<(Key, Value)>;

/// Letters of the arguments of a G65, with their variables.
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

/// Whether a text computes, jumps or calls: others are read as written.
pub fn is_macro(text: &str) -> bool {
    let bytes = text.as_bytes();
    let computes = memchr::memchr3(b'#', b'[', b'<', bytes).is_some();
    let has_o_words = || {
        memchr::memchr2_iter(b'o', b'O', bytes)
            .any(|at| o_word(&bytes[at..bytes.len().min(at + 40)]).is_some())
    };
    let has_calls =
        || memchr::memchr2_iter(b'g', b'G', bytes).any(|at| bytes[at + 1..].starts_with(b"65"));
    let has_probing_words = || {
        memchr::memmem::find_iter(bytes, b"M1").any(|at| {
            let own = |(word, _): &(&str, &str)| bytes[at..].starts_with(word.as_bytes());
            CENTROID.probing.iter().any(own)
        })
    };
    computes || has_o_words() || has_calls() || has_probing_words()
}

impl Machine {
    /// Whether a block of another language calls or jumps.
    pub(super) fn calls_by_words(&self, code: &[u8]) -> bool {
        let grammar = self.variables.grammar;
        let word: Vec<u8> = code
            .iter()
            .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
            .map(u8::to_ascii_uppercase)
            .collect();
        match grammar.language {
            Language::Heidenhain => matches!(word.as_slice(), [b'L', b'0'..=b'9', ..]),
            Language::Sinumerik => {
                let name = String::from_utf8_lossy(&word);
                self.index.subroutine(&name).is_some() || name.starts_with("GOTO")
            }
            _ => statement::structure(code, grammar).is_some_and(|word| word.keyword.jumps()),
        }
    }

    /// Whether a block changes the course of the program, and not only values.
    pub(super) fn turns_off(&self, code: &[u8]) -> bool {
        is_flow(code)
            || o_word(code).is_some_and(|word| word.keyword.jumps())
            || begins(code, b"G65")
            || begins(code, b"M99")
    }

    pub(super) fn macro_block(
        &mut self,
        line: &[u8],
        begin: usize,
        here: Place,
        next: Place,
        inside: usize,
    ) -> LineAction {
        let code = &line[begin..];
        match code.first().map(u8::to_ascii_uppercase) {
            // The next program begins: the called one has ended.
            Some(b'O') if program_number(code).is_some() => {
                LineAction::to(self.end_subprogram(false))
            }
            Some(b'O') => match o_word(code) {
                Some(word) => self.o_word(word, code, here, next),
                None => LineAction::AsWritten,
            },
            Some(b'(') if self.variables.is_linuxcnc() && aborts(code) && self.is_sure() => {
                LineAction::Ends
            }
            Some(b'(' | b';' | b'%') | None => LineAction::AsWritten,
            _ if is_flow(code) => self.flow(code, here, next),
            Some(b'M') if !self.variables.grammar.probing.is_empty() => {
                match probing_move(code, self.variables.grammar.probing) {
                    Some(block) => match self.words(&block, 0) {
                        LineAction::AsWritten => LineAction::Read(block),
                        step => step,
                    },
                    None => self.words(line, begin),
                }
            }
            _ => self
                .macro_word(code, next, inside)
                .unwrap_or_else(|| self.words(line, begin)),
        }
    }

    /// `o<name> call [5]`, `o1 if [#2 GT 0]` and similar words.
    pub(super) fn o_word(
        &mut self,
        word: Structure,
        code: &[u8],
        here: Place,
        next: Place,
    ) -> LineAction {
        let value = Cursor::new(code, word.rest, &self.variables).bracketed();
        match word.keyword {
            Keyword::Sub => LineAction::to(self.index.below_definition(here.line)),
            Keyword::EndSub | Keyword::Return
                if !self.frames.last().is_some_and(|frame| frame.ends_by_word) =>
            {
                LineAction::AsWritten
            }
            Keyword::Return if self.is_guarded() => self.may_leave(),
            Keyword::EndSub | Keyword::Return => {
                let back = self.leave();
                let is_returned = !code[word.rest..].trim_ascii().is_empty();
                self.returns(value, is_returned);
                back.map_or(LineAction::AsWritten, LineAction::Leave)
            }
            Keyword::Call => self.o_call(code, &word, next),
            Keyword::Break => self.leaves_loop(&word.label, true),
            Keyword::Continue => self.leaves_loop(&word.label, false),
            keyword => self.structure(keyword, value, here),
        }
    }

    /// Return value of a subroutine. The interpreter sets both variables to 0 if no value is returned.
    fn returns(&mut self, value: Option<Value>, is_returned: bool) {
        let none = if is_returned {
            Value::Unknown
        } else {
            Value::Number(0.0)
        };
        for (name, value) in [
            ("_value", value.unwrap_or(none)),
            (
                "_value_returned",
                Value::Number(f64::from(u8::from(is_returned))),
            ),
        ] {
            let value = if self.is_sure() {
                value
            } else {
                Value::Unknown
            };
            self.variables.set(Key::Name(name.to_owned()), value);
        }
    }

    fn o_call(&mut self, code: &[u8], word: &Structure, next: Place) -> LineAction {
        let mut arguments = Vec::new();
        let mut cursor = Cursor::new(code, word.rest, &self.variables);
        while cursor.peek() == Some(b'[') {
            let Some(value) = cursor.bracketed() else {
                break;
            };
            arguments.push((Key::Number(arguments.len() as i32 + 1), value));
        }
        let is_understood = cursor.peek() != Some(b'[');
        let own = self
            .index
            .subroutine(&word.label)
            .map(|own| (own.begin, own.end))
            .filter(|_| is_understood && self.may_call());
        let Some((begin, end)) = own else {
            // It may set any variable except the local ones.
            self.variables.forget_shared();
            return LineAction::AsWritten;
        };
        self.runs(begin, end);
        self.enter(next, true, 0, arguments);
        LineAction::Enter(begin)
    }

    /// `IF[…]GOTO 10`, `IF[…]THEN#1=2`, `WHILE[…]DO1`, `END1`, `GOTO 10`.
    fn flow(&mut self, mut code: &[u8], here: Place, next: Place) -> LineAction {
        let mut cursor = Cursor::new(code, 0, &self.variables);
        while cursor.eat("IF") {
            let holds = cursor.bracketed().and_then(Value::holds);
            if !cursor.eat("THEN") {
                let goes = cursor.eat("GOTO");
                let label = cursor.operand().and_then(Value::number).filter(|_| goes);
                return self.goto(label, holds, next);
            }
            code = code[cursor.at..].trim_ascii_start();
            if holds != Some(true) || !is_flow(code) {
                return self.then(code, holds, next);
            }
            cursor = Cursor::new(code, 0, &self.variables);
        }
        if cursor.eat("GOTO") {
            let label = cursor.operand().and_then(Value::number);
            return self.goto(label, Some(true), next);
        }
        let Some(word) = statement::structure(code, self.variables.grammar) else {
            return LineAction::AsWritten;
        };
        let value = Cursor::new(code, word.rest, &self.variables).bracketed();
        self.structure(word.keyword, value, here)
    }

    fn goto(&mut self, label: Option<f64>, holds: Option<bool>, next: Place) -> LineAction {
        let to = label.and_then(|label| self.block_number(label, next));
        self.jump(to, holds, next)
    }

    /// Block with a number, for a jump from above `next`.
    fn block_number(&self, number: f64, next: Place) -> Option<Place> {
        self.index.target(&decimal(number.trunc(), 0), next.line)
    }

    /// The statement after THEN.
    fn then(&mut self, rest: &[u8], holds: Option<bool>, next: Place) -> LineAction {
        if holds == Some(false) {
            return LineAction::Skip;
        }
        if is_flow(rest) {
            return self.leap(None, next);
        }
        match self.guarded(holds.is_none(), |machine| machine.words(rest, 0)) {
            LineAction::Skip => LineAction::Skip,
            LineAction::Ends => LineAction::Ends,
            _ => LineAction::AsWritten,
        }
    }

    /// `G65 P100 A5. Z-3.` and `M99`: into a macro in the same text and back; `None` for any other block.
    fn macro_word(&mut self, code: &[u8], next: Place, inside: usize) -> Option<LineAction> {
        if begins(code, b"G65") {
            return self.macro_call(code, next, inside);
        }
        let own = self
            .frames
            .last()
            .is_some_and(|frame| !frame.ends_by_word && frame.inside == inside);
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
        // To a block of the calling program, by its number.
        let to = block.map_or(Some(back), |number| self.block_number(number?, back));
        if to.is_none() {
            self.leap(None, back);
        }
        Some(LineAction::Leave(to.unwrap_or(back)))
    }

    /// `None` if the text has no such program, repeats the call, or the arguments are not understood.
    fn macro_call(&mut self, code: &[u8], next: Place, inside: usize) -> Option<LineAction> {
        let mut arguments: Vec<(Key, Value)> = Vec::new();
        let mut program = None;
        let mut centers = [0; 3];
        let mut cursor = Cursor::new(code, 3, &self.variables);
        while let Some(letter) = cursor.peek().filter(u8::is_ascii_uppercase) {
            cursor.at += 1;
            let value = cursor.operand()?;
            match (letter, ARGUMENTS.iter().find(|(known, _)| *known == letter)) {
                (b'P', _) => program = value.number(),
                (b'L', _) if value == Value::Number(1.0) => {}
                // I, J and K may occur ten times: #4 to #6, then #7 to #9, and so on.
                (b'I'..=b'K', Some((_, first))) => {
                    let times = centers[usize::from(letter - b'I')];
                    centers[usize::from(letter - b'I')] += 1;
                    if times == 10 {
                        return None;
                    }
                    arguments.push((Key::Number(first + 3 * times), value));
                }
                (_, Some((_, variable)))
                    if arguments
                        .iter()
                        .all(|(known, _)| *known != Key::Number(*variable)) =>
                {
                    arguments.push((Key::Number(*variable), value));
                }
                _ => return None,
            }
        }
        let (begin, end) = self
            .index
            .program(program? as u32)
            .filter(|_| self.may_call())?;
        self.runs(begin, end);
        self.enter(next, false, inside, arguments);
        Some(LineAction::Enter(begin))
    }

    /// A block of words: known values in it become numbers, and its assignments are made.
    pub(super) fn words(&mut self, line: &[u8], begin: usize) -> LineAction {
        let computes = |b: &u8| matches!(b, b'#' | b'[' | b'@' | b'{');
        if !line[begin..].iter().any(computes) {
            return LineAction::AsWritten;
        }
        let Some((out, sets, valued)) = self.expanded(line, begin) else {
            // Its assignments may be to any variable.
            if line.contains(&b'=') {
                self.forget();
            }
            return LineAction::AsWritten;
        };
        self.valued |= valued;
        let linuxcnc = self.variables.is_linuxcnc();
        // On LinuxCNC all take effect after the block; for a Fanuc that is unknown here.
        let sure = self.is_sure() && (sets.len() < 2 || linuxcnc);
        // An alarm with a message: the program stops.
        let alarm = !linuxcnc && sets.iter().any(|(key, _)| *key == Key::Number(3000));
        if alarm && self.is_sure() {
            return LineAction::Ends;
        }
        let known = sure
            && sets
                .iter()
                .all(|(key, value)| *value != Value::Unknown && *key != Key::Unknown);
        let assigns = !sets.is_empty();
        for (key, value) in sets {
            let value = if sure { value } else { Value::Unknown };
            if let Key::Number(number) = key
                && let Some(variable) = writes::of_number(number, linuxcnc)
            {
                self.written.push((variable, value.or_nan()));
            }
            self.variables.set(key, value);
        }
        match out[begin..].trim_ascii().is_empty() {
            // Another finding reports the division by zero.
            true if assigns && (known || self.variables.has_divided()) => LineAction::Skip,
            // The reader reports an assignment of an unknown value. It would treat `@` as a polar radius.
            true if assigns && self.variables.grammar.language == Language::Lnc => {
                LineAction::Read(b"#0=#0".to_vec())
            }
            true if assigns => LineAction::AsWritten,
            _ => LineAction::Read(out),
        }
    }

    /// A block with numbers in place of known values, its assignments, and the axes with computed positions; `None` if it is not understood.
    fn expanded(&self, line: &[u8], begin: usize) -> Option<(Vec<u8>, Assigned, Axes)> {
        let language = self.variables.grammar.language;
        let (mut out, mut sets, mut valued) = (line[..begin].to_vec(), Vec::new(), 0);
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
                b'@' if language == Language::Lnc => sets.push(cursor.assignment()?),
                letter if letter.is_ascii_alphabetic() => {
                    cursor.at += 1;
                    out.push(letter);
                    if !cursor.computes() {
                        continue;
                    }
                    let value = cursor.in_word();
                    if let axis @ b'X'..=b'Z' = letter.to_ascii_uppercase() {
                        valued |= 1 << (axis - b'X');
                    }
                    if language == Language::RepRap {
                        // An unknown value is written as a macro variable: the reader treats it as computed.
                        match value {
                            Some(Value::Number(x)) => number(&mut out, x),
                            _ => out.extend_from_slice(b"[#0]"),
                        }
                        cursor = Cursor::new(line, closing(line, from + 1), &self.variables);
                        continue;
                    }
                    match value? {
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
        Some((out, sets, valued))
    }
}

/// `M115 /X20 P15 F100 L1` as a G31: axis, feed, and meaning of a contact. With L1 a contact has no meaning.
fn probing_move(code: &[u8], probing: &[(&str, &str)]) -> Option<Vec<u8>> {
    let (word, meaning) = probing.iter().find(|(word, _)| {
        code.get(..word.len())
            .is_some_and(|begin| begin.eq_ignore_ascii_case(word.as_bytes()))
    })?;
    let code = without_comment(&code[word.len()..], Some("("));
    let rest = code.trim_ascii_start().strip_prefix(b"/")?;
    let (axis, rest) = rest.split_first()?;
    let mut block = vec![b'G', b'3', b'1', b' ', *axis];
    let value = value_end(rest);
    // Without a value it moves to a limit.
    block.extend_from_slice(if value == 0 { b"[#0]" } else { &rest[..value] });
    let mut rest = &rest[value..];
    let mut may_miss = false;
    while let Some((letter, after)) = rest.trim_ascii_start().split_first() {
        let end = value_end(after);
        match letter.to_ascii_uppercase() {
            b'F' => block.extend_from_slice(&[b" F", &after[..end]].concat()),
            b'L' => may_miss = after[..end].trim_ascii() == b"1",
            b'P' | b'Q' => {}
            _ => return None,
        }
        rest = &after[end..];
    }
    if !may_miss {
        block.push(b' ');
        block.extend_from_slice(meaning.as_bytes());
    }
    Some(block)
}

/// End of the value at the start of a text: a number, a variable, brackets, with a sign.
fn value_end(text: &[u8]) -> usize {
    let signed = text
        .iter()
        .take_while(|b| matches!(b, b' ' | b'-' | b'+'))
        .count();
    match text.get(signed) {
        Some(b'#' | b'[') => end_of_value(text, signed),
        Some(b'0'..=b'9' | b'.') => {
            let digits = text[signed..].iter();
            signed
                + digits
                    .take_while(|b| b.is_ascii_digit() || **b == b'.')
                    .count()
        }
        _ => 0,
    }
}

/// Position after the closing brace of the next opening one.
fn closing(line: &[u8], from: usize) -> usize {
    let mut depth = 0;
    let end = line[from..].iter().position(|b| {
        depth += match b {
            b'{' => 1,
            b'}' => -1,
            _ => 0,
        };
        depth == 0 && *b == b'}'
    });
    end.map_or(line.len(), |end| from + end + 1)
}

/// A number in a word, with its point: a Fanuc counts one without in the smallest step.
fn number(out: &mut Vec<u8>, x: f64) {
    let mut text = decimal(x, 9);
    if !text.contains('.') {
        text.push('.');
    }
    out.extend_from_slice(text.as_bytes());
}
