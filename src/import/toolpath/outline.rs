//! Headings of a program: lines that name subroutines and sections.

use serde::Serialize;

use crate::control::iso::lex::{
    lines_of, program_number, strip_prefix_nocase, trimmed, without_count, without_number,
};
use crate::form::printable;

/// Largest number of listed headings.
const MOST: usize = 1000;

/// A line that names the lines below it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Heading {
    /// Its 0-based line.
    pub line: u32,
    /// `O9810 (PROTECTED POSITION)`, `PROC EDGE`, `LBL 5`, as written.
    pub name: String,
}

/// Headings of a text in any dialect: programs by O and a number, O words, PROC and archives, labels of a HEIDENHAIN.
pub fn outline(text: &str) -> Vec<Heading> {
    let names = |line: &str| {
        let line = trimmed(line);
        let plain = trimmed(without_count(without_number(line)));
        let code = plain.as_bytes();
        let (first, named) = (code.first().map(u8::to_ascii_uppercase), |word: &str| {
            strip_prefix_nocase(plain, word).is_some()
        });
        let is = match first {
            Some(b'O') => program_number(code).is_some() || sub(code),
            Some(b'%') => line.starts_with("%_N_"),
            Some(b'P') => named("PROC "),
            Some(b'L') => named("LBL ") && trimmed(&plain[4..]) != "0",
            Some(b'B') => named("BEGIN PGM "),
            Some(b'G') => plain
                .strip_prefix("G98 L")
                .is_some_and(|label| !label.starts_with('0')),
            _ => false,
        };
        is.then(|| printable(plain))
    };
    let found = lines_of(text).enumerate().filter_map(|(line, text)| {
        Some(Heading {
            line: line as u32,
            name: names(text)?,
        })
    });
    found.take(MOST).collect()
}

/// `o<name> sub`.
fn sub(code: &[u8]) -> bool {
    let label = code[1..].iter().position(|b| *b == b'>').map_or_else(
        || {
            1 + code[1..]
                .iter()
                .take_while(|b| b.is_ascii_digit() || **b == b' ')
                .count()
        },
        |end| end + 2,
    );
    let rest = code.get(label..).unwrap_or_default().trim_ascii_start();
    rest.get(..3)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"sub"))
        && !rest.get(3).is_some_and(u8::is_ascii_alphabetic)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_the_lines_that_name_something() {
        let text = "%\nO0005 (MAIN)\nG1 X1\nN10 O<edge> sub\no<edge> endsub\no1 if [1]\no20sub\nPROC FIND(REAL A)\n%_N_PART_MPF\n7 LBL \"HOLE\"\n8 LBL 0\n\
                    N9 G98 L5 *\nN9 G98 L0 *\nO <b\u{e9}> sub\nLBLX\nPROCESS\n0 BEGIN PGM A MM\n";
        let found: Vec<(u32, String)> = outline(text)
            .into_iter()
            .map(|heading| (heading.line, heading.name))
            .collect();
        let lines: Vec<u32> = found.iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, [1, 3, 6, 7, 8, 9, 11, 13, 16], "{found:?}");
        assert_eq!(found[0].1, "O0005 (MAIN)");
        assert_eq!(outline(&"O1 sub\n".repeat(2000)).len(), MOST);
    }
}
