//! Reads grbl programs, which consist of words: grbl has no variables and no conditions.

use crate::control::iso::codes::Family;
use crate::control::iso::lex::{self, Comment};
use crate::control::iso::line_cache::ReaderId;
use crate::control::iso::lines::{self, Blocks};
use crate::control::iso::parse::{Cursor, Grammar, Names, Parsed, WORD_OPERATORS, fault};
use crate::control::iso::script::{ReadError, Script};
use crate::control::iso::targets::Targets;
use crate::control::iso::words;
use crate::text::text;

static GRAMMAR: Grammar = Grammar {
    brackets: (b'[', b']'),
    points: false,
    names: Names::Hash,
    operators: WORD_OPERATORS,
    system: |_| None,
    family: Family::Iso,
    takes: words::rs274,
};

struct Program;

impl<'t> Blocks<'t> for Program {
    fn block(
        &mut self,
        script: &mut Script<'t>,
        _: &mut Targets<'t>,
        line: usize,
        code: &'t str,
        _: Option<Comment<'t>>,
    ) -> Parsed<()> {
        if code.contains(['#', '[', '=']) {
            return fault(text!("this control has no variables"));
        }
        if code.is_empty() || code == "%" {
            return Ok(());
        }
        let what = words::words(
            &mut Cursor::new(lex::without_number(code)),
            &GRAMMAR,
            script,
        )?;
        script.push(line, what);
        Ok(())
    }
}

pub fn read(text: &str) -> Result<Script<'_>, Vec<ReadError>> {
    let mut script = Script::with_room_for(text);
    script.begins_free = true;
    lines::lines(
        text,
        (ReaderId::Grbl, b'('),
        &mut script,
        &mut Targets::default(),
        &mut Program,
    )?;
    Ok(script)
}
