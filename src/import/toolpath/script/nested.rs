//! Macros with nested structures: LNC and Eding CNC.

use crate::control::native::tool_name;
use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::LineAction;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::grammar::Keyword;
use crate::import::toolpath::script::machine::Machine;
use crate::import::toolpath::script::statement::{begins, structure, without_comment};
use crate::import::toolpath::script::variables::Value;
use crate::import::toolpath::writes::{OFFSET_AXES, TABLE, Variable};

impl Machine {
    pub(super) fn nested(
        &mut self,
        line: &[u8],
        begin: usize,
        here: Place,
        next: Place,
        inside: usize,
    ) -> LineAction {
        let plain = without_comment(line, self.variables.grammar.comment);
        let code = plain.get(begin..).unwrap_or_default();
        if code.is_empty() {
            return LineAction::Skip;
        }
        if let Some(word) = structure(code, self.variables.grammar) {
            return match word.keyword {
                Keyword::Sub | Keyword::EndSub | Keyword::Call => {
                    self.o_word(word, code, here, next)
                }
                Keyword::Break => self.leaves_loop("", true),
                keyword => self.structure_word(keyword, code, word.rest, here),
            };
        }
        if let Some(step) = self.named_call(code, next, inside) {
            return step;
        }
        if let Some(step) = self.plain_word(code).or_else(|| self.register(code)) {
            return step;
        }
        match self.macro_block(plain, begin, here, next, inside) {
            // The reader understands it without its comment.
            LineAction::AsWritten if plain.len() < line.len() => LineAction::Read(plain.to_vec()),
            step => step,
        }
    }

    /// `G65 "PROBEX" A54. B10.` of an LNC: the letters from A on are #1, #2 and so on.
    fn named_call(&mut self, code: &[u8], next: Place, inside: usize) -> Option<LineAction> {
        if !begins(code, b"G65") {
            return None;
        }
        let rest = code[3..].trim_ascii_start().strip_prefix(b"\"")?;
        let end = memchr::memchr(b'"', rest)?;
        let name = String::from_utf8_lossy(&rest[..end]).into_owned();
        let key = |letter: u8| Key::Number(i32::from(letter - b'A') + 1);
        let arguments = self.letters(&rest[end + 1..], key)?;
        self.calls_file(&name, arguments, next, inside)
    }

    /// Letters with their values.
    pub(super) fn letters(
        &self,
        code: &[u8],
        key: impl Fn(u8) -> Key,
    ) -> Option<Vec<(Key, Value)>> {
        let mut cursor = Cursor::new(code, 0, &self.variables);
        let mut given = Vec::new();
        while let Some(letter) = cursor.peek() {
            letter.is_ascii_uppercase().then_some(())?;
            cursor.at += 1;
            given.push((key(letter), cursor.operand()?));
        }
        Some(given)
    }

    /// A word of an LNC that writes a register: `W_G53G59_COOR[0,54,1,#106]`, axes from 1.
    fn register(&mut self, code: &[u8]) -> Option<LineAction> {
        let mut cursor = Cursor::new(code, 0, &self.variables);
        let name = cursor.name()?.to_ascii_uppercase();
        let name = name.strip_prefix(b"W_")?;
        let values = cursor.list()?;
        // NaN converted to an integer is 0: no offset and no axis.
        let number = |at: usize| values.get(at).map_or(f64::NAN, |value| value.or_nan());
        let (which, axis) = (number(1) as i32, number(2) as usize);
        let offset = match (name, which) {
            (b"TOOL_DATA", _) => None,
            (b"G53G59_COOR", 54..=59) => Some(which - 53),
            (b"G54EXP_COOR", 1..=100) => Some(6 + 1000 * which),
            (b"G53G59_COOR" | b"G54EXP_COOR", _) => Some(0),
            _ => return None,
        };
        let written = match offset {
            None => Variable::Tool(TABLE, tool_name(number(1))),
            Some(offset @ 1..) if (1..=OFFSET_AXES).contains(&axis) => {
                Variable::Offset(offset, axis - 1)
            }
            Some(_) => Variable::AnyOffset(String::from_utf8_lossy(name).into_owned()),
        };
        let value = number(values.len().saturating_sub(1));
        let value = if self.is_sure() { value } else { f64::NAN };
        self.written.push((written, value));
        Some(LineAction::Skip)
    }
}
