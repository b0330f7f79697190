//! SINUMERIK: its words after those of structures, by its programming manual.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::LineAction;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::machine::Machine;
use crate::import::toolpath::script::statement::{structure, without_label};
use crate::import::toolpath::script::variables::Value;
use crate::import::toolpath::writes;
use crate::num::decimal;

/// Words of jumps.
const JUMPS: [&str; 4] = ["GOTOF", "GOTOB", "GOTOC", "GOTO"];

impl Machine {
    pub(super) fn sinumerik(&mut self, line: &[u8], here: Place, next: Place) -> LineAction {
        let code = without_label(line);
        if code.is_empty() {
            return LineAction::AsWritten;
        }
        let mut cursor = Cursor::new(code, 0, &self.variables);
        if let Some(word) = structure(code, self.variables.grammar) {
            return self.structure_word(word.keyword, code, word.rest, here);
        }
        if cursor.eat("IF") {
            let holds = cursor.value().and_then(Value::holds);
            return match jump(&mut cursor) {
                Some(label) => self.goto_label(&label, holds, next),
                None => LineAction::AsWritten,
            };
        }
        if let Some(label) = jump(&mut cursor) {
            return self.goto_label(&label, Some(true), next);
        }
        if cursor.eat("CASE") {
            let at = cursor.at;
            return self.case(code, at, next);
        }
        if cursor.eat("DEF") {
            let at = cursor.at;
            return self.define(code, at);
        }
        let is_inside = !self.frames.is_empty();
        if cursor.eat("RET") || is_inside && (cursor.eat("M17") || cursor.eat("M99")) {
            return match self.is_guarded() {
                true => self.may_leave(),
                false => self
                    .leave()
                    .map_or(LineAction::AsWritten, LineAction::Leave),
            };
        }
        if let Some(step) = self.plain_word(code) {
            return step;
        }
        self.call_by_name(code, next)
            .unwrap_or_else(|| self.assignments(code))
    }

    fn goto_label(&mut self, label: &str, holds: Option<bool>, next: Place) -> LineAction {
        let to = self.index.target(label, next.line);
        self.jump(to, holds, next)
    }

    /// `CASE R1 OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`.
    fn case(&mut self, code: &[u8], at: usize, next: Place) -> LineAction {
        let mut cursor = Cursor::new(code, at, &self.variables);
        let value = cursor.value().and_then(Value::number);
        let mut is_known = cursor.eat("OF") && value.is_some();
        while is_known && !cursor.is_done() {
            let constant = if cursor.eat("DEFAULT") {
                value
            } else {
                cursor.value().and_then(Value::number)
            };
            match jump(&mut cursor) {
                Some(label) if constant == value => {
                    return self.goto_label(&label, Some(true), next);
                }
                label => is_known = label.is_some(),
            }
        }
        if is_known {
            return LineAction::Skip;
        }
        // It may continue at any of the labels.
        self.leap(None, next);
        LineAction::Astray
    }

    /// `DEF REAL A, B=5, C[3]=SET(1, 2)`.
    fn define(&mut self, code: &[u8], at: usize) -> LineAction {
        const TYPES: [&str; 7] = ["REAL", "INT", "BOOL", "CHAR", "STRING", "AXIS", "FRAME"];
        const LONGEST: usize = 1000;
        let mut defined: Vec<(Key, Value)> = Vec::new();
        let mut cursor = Cursor::new(code, at, &self.variables);
        let kind = TYPES.into_iter().find(|kind| cursor.eat(kind));
        let is_number = matches!(kind, Some("REAL" | "INT" | "BOOL"));
        if kind == Some("STRING") {
            cursor.index();
        }
        while let Some(name) = cursor.name() {
            let index = cursor.index();
            let is_set = cursor.eat("=");
            let list = if is_set && cursor.eat("SET") {
                cursor.arguments().unwrap_or_default()
            } else {
                Vec::new()
            };
            let first = if is_set && list.is_empty() {
                cursor.value().unwrap_or(Value::Unknown)
            } else {
                Value::Number(0.0)
            };
            let first = if is_number { first } else { Value::Unknown };
            let size = index
                .filter(|index| !index.is_empty())
                .and_then(|index| index.trim_matches(['[', ']']).parse::<usize>().ok());
            match size {
                Some(size) => defined.extend((0..size.min(LONGEST)).map(|i| {
                    let element = [name, format!("[{i}]").as_bytes()].concat();
                    let value = list.get(i).copied().unwrap_or(first);
                    (Key::capitals(&element), value)
                })),
                None => defined.push((Key::capitals(name), first)),
            }
            if !cursor.eat(",") {
                break;
            }
        }
        for (key, value) in defined {
            self.variables.define(key, value);
        }
        LineAction::Skip
    }

    /// A subprogram of the same text: `MEASURE(5, R1)`.
    fn call_by_name(&mut self, code: &[u8], next: Place) -> Option<LineAction> {
        let mut cursor = Cursor::new(code, 0, &self.variables);
        let name = String::from_utf8_lossy(cursor.name()?).into_owned();
        let own = self
            .index
            .subroutine(&name)
            .filter(|_| self.may_call() && self.is_sure())?
            .clone();
        let given = if cursor.peek() == Some(b'(') {
            cursor.arguments()?
        } else {
            Vec::new()
        };
        cursor.is_done().then_some(())?;
        let value = |i: usize| given.get(i).copied().unwrap_or(Value::Number(0.0));
        let names = own.parameters.iter().enumerate();
        let arguments = names.map(|(i, name)| (Key::capitals(name.as_bytes()), value(i)));
        let arguments = arguments.collect();
        self.runs(own.begin, own.end);
        self.enter(next, false, 0, arguments);
        Some(LineAction::Enter(own.begin))
    }

    /// A block of words: known values in it become numbers, and its assignments are made.
    fn assignments(&mut self, code: &[u8]) -> LineAction {
        if !code.contains(&b'=') {
            return LineAction::AsWritten;
        }
        let mut out: Vec<u8> = Vec::with_capacity(code.len());
        let (mut known, mut assigns, mut at) = (true, false, 0);
        while let Some(sign) = code.get(at).copied() {
            if sign == b'"' {
                let end = memchr::memchr(b'"', &code[at + 1..]);
                let end = end.map_or(code.len(), |end| at + end + 2);
                out.extend_from_slice(&code[at..end]);
                at = end;
                continue;
            }
            let before = at;
            let mut cursor = Cursor::new(code, at, &self.variables);
            let name = if sign.is_ascii_whitespace() {
                None
            } else {
                cursor.name()
            };
            let Some(name) = name else {
                out.push(sign);
                at += 1;
                continue;
            };
            let key = cursor.index_of(name);
            at = cursor.at;
            if cursor.peek() != Some(b'=') || code.get(cursor.at + 1) == Some(&b'=') {
                out.extend_from_slice(&code[before..at]);
                continue;
            }
            cursor.at += 1;
            if is_address(name) {
                let (wrap, value) = address(&mut cursor);
                let Some(value) = value else {
                    // The reader reports text that is not understood.
                    out.extend_from_slice(&code[before..]);
                    break;
                };
                let is_plain = code[at..cursor.at].iter().all(|b| !b.is_ascii_alphabetic());
                if let ([axis @ b'X'..=b'Z'], false) = (name, is_plain) {
                    self.valued |= 1 << (axis - b'X');
                }
                at = cursor.at;
                // An unknown value is written as a variable: the reader treats it as computed.
                let value = value
                    .number()
                    .map_or("R0".to_owned(), |value| decimal(value, 9));
                let text = wrap.map_or_else(|| value.clone(), |wrap| format!("{wrap}({value})"));
                out.extend_from_slice(
                    format!(" {}={text} ", String::from_utf8_lossy(name)).as_bytes(),
                );
                continue;
            }
            assigns = true;
            // CTRANS( … ): a whole frame, which is not followed.
            let is_frame = name.starts_with(b"$P_") && cursor.peek() == Some(b'C');
            let value = if is_frame {
                cursor.at = code.len();
                Some(Value::Unknown)
            } else {
                cursor.value()
            };
            at = cursor.at;
            let (Some(value), false) = (value, key == Key::Unknown) else {
                // It may be any of them, or the text is not understood.
                self.forget();
                return LineAction::AsWritten;
            };
            known &= value != Value::Unknown;
            self.assign(key, value);
        }
        match out.trim_ascii().is_empty() {
            true if assigns && known => LineAction::Skip,
            true if assigns => LineAction::AsWritten,
            _ => LineAction::Read(out.trim_ascii().to_vec()),
        }
    }

    fn assign(&mut self, key: Key, value: Value) {
        let value = if self.is_sure() {
            value
        } else {
            Value::Unknown
        };
        if let Key::Name(name) = &key
            && let Some(variable) = writes::of_name(name)
        {
            self.written.push((variable, value.or_nan()));
        }
        self.variables.set(key, value);
    }
}

/// Target label of a jump: `GOTOF END`, `GOTOB`, `GOTO`.
fn jump(cursor: &mut Cursor<'_>) -> Option<String> {
    JUMPS.iter().any(|word| cursor.eat(word)).then_some(())?;
    Some(String::from_utf8_lossy(cursor.name()?).into_owned())
}

/// Value of an address, or one in `IC( )`, `AC( )`, `DC( )`.
fn address(cursor: &mut Cursor<'_>) -> (Option<&'static str>, Option<Value>) {
    for wrap in ["IC", "AC", "DC", "ACP", "ACN"] {
        if cursor.eat(wrap) {
            return (Some(wrap), cursor.bracketed());
        }
    }
    (None, cursor.value())
}

/// Whether an assignment is to an address of the control instead of a variable.
fn is_address(word: &[u8]) -> bool {
    const WORDS: [&[u8]; 15] = [
        b"RPL", b"CR", b"AR", b"AP", b"RP", b"MEAS", b"MEAW", b"SPOS", b"SPOSA", b"RND", b"RNDM",
        b"CHF", b"CHR", b"TURN", b"ANG",
    ];
    let is_letter = word
        .first()
        .is_some_and(|b| b.is_ascii_alphabetic() && *b != b'R');
    let is_numbered = word.len() <= 3 && word[1..].iter().all(u8::is_ascii_digit);
    is_letter && is_numbered || WORDS.contains(&word)
}
