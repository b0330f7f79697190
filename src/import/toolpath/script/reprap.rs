//! RepRapFirmware's meta commands, by its documentation: names, expressions in braces, structures by indentation.

use crate::import::toolpath::calls::Place;
use crate::import::toolpath::flow::LineAction;
use crate::import::toolpath::key::Key;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::grammar::Keyword;
use crate::import::toolpath::script::machine::Machine;
use crate::import::toolpath::script::statement::{begins, structure, without_comment};
use crate::import::toolpath::script::variables::Value;

impl Machine {
    pub(super) fn reprap(&mut self, line: &[u8], here: Place, next: Place) -> LineAction {
        let code = without_comment(line, None);
        if code.is_empty() {
            return LineAction::AsWritten;
        }
        let rounds = self.rounds(here);
        self.variables
            .set(Key::Name("iterations".to_owned()), rounds);
        if let Some(word) = structure(code, self.variables.grammar) {
            let value = Cursor::new(code, word.rest, &self.variables).value();
            return match word.keyword {
                Keyword::Break => self.leaves_loop("", true),
                Keyword::Continue => self.leaves_loop("", false),
                keyword => self.structure(keyword, value, here),
            };
        }
        if let Some(step) = self.plain_word(code) {
            return step;
        }
        if begins(code, b"M99") && !self.frames.is_empty() {
            if self.is_guarded() {
                return self.may_leave();
            }
            return self
                .leave()
                .map_or(LineAction::AsWritten, LineAction::Leave);
        }
        self.file_call(code, next)
            .or_else(|| self.named_value(code))
            .unwrap_or_else(|| self.words(code, 0))
    }

    /// `M98 P"probe.g" X5`, and a code that is a file: `G6550 X5` runs G6550.g. Its letters are `param.X` there.
    fn file_call(&mut self, code: &[u8], next: Place) -> Option<LineAction> {
        let is_word = |b: &&u8| b.is_ascii_alphanumeric() || **b == b'.';
        let word = &code[..code.iter().take_while(is_word).count()];
        let (name, rest) = if begins(code, b"M98") {
            let rest = code[3..].trim_ascii_start().strip_prefix(b"P\"")?;
            let end = memchr::memchr(b'"', rest)?;
            (&rest[..end], &rest[end + 1..])
        } else {
            matches!(word, [b'G' | b'g' | b'M' | b'm', ..])
                .then_some((word, &code[word.len()..]))?
        };
        let name = String::from_utf8_lossy(name).into_owned();
        self.index.file_named(&name)?;
        let key = |letter: u8| Key::Name(format!("param.{}", char::from(letter)));
        let arguments = self.letters(rest, key)?;
        self.calls_file(&name, arguments, next, 0)
    }

    /// `var x = 5`, `global x = 5`, `set var.x = 6`.
    fn named_value(&mut self, code: &[u8]) -> Option<LineAction> {
        let mut cursor = Cursor::new(code, 0, &self.variables);
        let scope = ["var", "global", "set"]
            .into_iter()
            .find(|word| cursor.eat(word))?;
        let key = match (scope, cursor.key()?) {
            ("set", key) => key,
            (scope, Key::Name(name)) => Key::Name(format!("{scope}.{name}")),
            (_, key) => key,
        };
        let value = cursor.eat("=").then(|| cursor.value()).flatten();
        let is_whole = cursor.is_done();
        let value = value.filter(|_| is_whole).unwrap_or(Value::Unknown);
        if let (Key::Name(name), false) = (&key, is_whole) {
            // A list of values, which is not followed.
            self.variables.forget_elements(name);
        }
        Some(self.sets(key, value))
    }
}
