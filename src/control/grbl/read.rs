//! Reads grbl programs: words alone. grbl has no variables and no conditions.

use crate::control::iso::codes;
use crate::control::iso::parse::{self, Cursor, Grammar, Names, WORD_OPERATORS};
use crate::control::iso::script::{Script, Trouble};

static GRAMMAR: Grammar = Grammar {
    brackets: (b'[', b']'),
    points: false,
    names: Names::Hash,
    operators: WORD_OPERATORS,
    system: |_| None,
    code: codes::rs274,
};

/// Reads a program.
pub fn read(text: &str) -> Result<Script<'_>, Vec<Trouble>> {
    let mut script = Script::default();
    parse::lines(text, b'(', &mut script, |script, line, code, _| {
        if code.contains(['#', '[', '=']) {
            return Err("grbl has no variables".to_owned());
        }
        if code.is_empty() || code == "%" {
            return Ok(());
        }
        let what = parse::words(&mut Cursor::new(parse::without_number(code)), &GRAMMAR, script)?;
        script.push(line, what);
        Ok(())
    })?;
    Ok(script)
}
