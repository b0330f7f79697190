//! Kind of a block, before anything in it is computed: a word of a structure, an end, a jump.

use crate::control::iso::lex::{comment_at, end_of_value, head};
use crate::import::toolpath::script::grammar::{Grammar, Keyword, Language, O_WORDS};

/// A word of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    pub keyword: Keyword,
    /// Label of the structure; empty if structures are nested and have no labels.
    pub label: String,
    /// Start of the rest in the code: a condition, a count, arguments.
    pub rest: usize,
}

/// Effect of a block on the course of the program.
#[derive(Clone, Debug, PartialEq)]
pub enum Turn {
    /// Ends the program: with an alarm (true), or as planned.
    Ends(bool),
    /// Returns to a caller.
    Back,
    /// Jumps to a block; unconditionally (true), or under a condition.
    Jumps(String, bool),
    /// Jumps to an unknown block.
    Somewhere,
}

/// The word of a structure at the start of a block. The code is without its number, on a SINUMERIK without its label.
pub fn structure(code: &[u8], grammar: &Grammar) -> Option<Structure> {
    if !grammar.words.is_empty() {
        return nested(code, grammar);
    }
    match code.first()?.to_ascii_uppercase() {
        b'O' => o_word(code),
        b'E' | b'W' | b'D' => numbered(code),
        _ => None,
    }
}

/// An O word; `None` with a computed label.
pub fn o_word(code: &[u8]) -> Option<Structure> {
    let rest = code.get(1..)?;
    let length = match rest.first()? {
        b'<' => rest.iter().position(|b| *b == b'>')? + 1,
        _ => rest
            .iter()
            .take_while(|b| b.is_ascii_digit() || **b == b' ')
            .count(),
    };
    let plain = rest[..length]
        .iter()
        .filter(|b| !b.is_ascii_whitespace())
        .map(|b| char::from(b.to_ascii_lowercase()));
    let label: String = plain.collect();
    let begin = skip_blanks(code, 1 + length);
    let letters = letters(&code[begin..]);
    let word = &code[begin..begin + letters];
    let (_, keyword) = O_WORDS
        .iter()
        .find(|(name, _)| word.eq_ignore_ascii_case(name.as_bytes()))?;
    (!label.is_empty()).then_some(Structure {
        keyword: *keyword,
        label,
        rest: begin + letters,
    })
}

/// `WHILE[…]DO1`, `DO1`, `END1`.
fn numbered(code: &[u8]) -> Option<Structure> {
    let is = |word: &[u8]| {
        code.get(..word.len())
            .is_some_and(|begin| begin.eq_ignore_ascii_case(word))
    };
    let number = |from: usize| {
        let digits = &code[skip_blanks(code, from)..];
        let digits = &digits[..digits.iter().take_while(|b| b.is_ascii_digit()).count()];
        let number: u32 = std::str::from_utf8(digits).ok()?.parse().ok()?;
        Some(format!("do{number}"))
    };
    if is(b"END") {
        return Some(Structure {
            keyword: Keyword::EndWhile,
            label: number(3)?,
            rest: code.len(),
        });
    }
    let (rest, does) = if is(b"WHILE") {
        let begin = skip_blanks(code, 5);
        (code.get(begin) == Some(&b'[')).then_some(())?;
        (begin, skip_blanks(code, end_of_value(code, begin)))
    } else {
        (0, 0)
    };
    let follows = code.get(does..does + 2)?.eq_ignore_ascii_case(b"DO");
    Some(Structure {
        keyword: if rest == 0 {
            Keyword::Loop
        } else {
            Keyword::While
        },
        label: number(does + 2).filter(|_| follows)?,
        rest,
    })
}

/// A word of a nested structure. `IF` with a jump and `REPEAT` with a label are not.
fn nested(code: &[u8], grammar: &Grammar) -> Option<Structure> {
    let length = name(code).len();
    let (_, keyword) = grammar
        .words
        .iter()
        .find(|(word, _)| word.as_bytes().eq_ignore_ascii_case(&code[..length]))?;
    let jumps = *keyword == Keyword::If
        && code
            .windows(4)
            .any(|word| word.eq_ignore_ascii_case(b"GOTO"));
    let is_labelled = *keyword == Keyword::Do && !code[length..].trim_ascii().is_empty();
    let is_statement =
        *keyword == Keyword::If && grammar.language.is_macro() && has_statement(&code[length..]);
    (!jumps && !is_labelled && !is_statement).then_some(())?;
    let mut own = Structure {
        keyword: *keyword,
        label: String::new(),
        rest: length,
    };
    if matches!(keyword, Keyword::Sub | Keyword::Call) {
        let begin = skip_blanks(code, length);
        let called = name(&code[begin..]);
        own.label = String::from_utf8_lossy(called).to_ascii_lowercase();
        own.rest = begin + called.len();
    }
    Some(own)
}

/// Whether a statement follows the condition of an `IF […] THEN` on its line.
fn has_statement(rest: &[u8]) -> bool {
    let rest = rest.trim_ascii_start();
    if rest.first() != Some(&b'[') {
        return false;
    }
    let mut depth = 0;
    let end = rest.iter().position(|b| {
        depth += match b {
            b'[' => 1,
            b']' => -1,
            _ => 0,
        };
        depth == 0
    });
    let behind = end.map_or(&[][..], |end| rest[end + 1..].trim_ascii());
    let is_then = behind
        .get(..4)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"THEN"));
    let statement = if is_then {
        behind[4..].trim_ascii()
    } else {
        &[]
    };
    statement.first().is_some_and(|b| *b != b'(')
}

/// Whether a block is a jump or loop of a Fanuc.
pub fn is_flow(code: &[u8]) -> bool {
    let follows = |word: &str, next: fn(u8) -> bool| {
        code.get(..word.len())
            .is_some_and(|begin| begin.eq_ignore_ascii_case(word.as_bytes()))
            && code[word.len()..]
                .iter()
                .find(|b| **b != b' ')
                .is_some_and(|b| next(*b))
    };
    let open = |b: u8| b == b'[';
    let digit = |b: u8| b.is_ascii_digit() || b == b'#' || b == b'[';
    follows("IF", open)
        || follows("WHILE", open)
        || follows("GOTO", digit)
        || follows("END", digit)
        || follows("DO", digit)
}

/// Effect of a block on the course of the program.
pub fn turn(code: &[u8], grammar: &Grammar) -> Option<Turn> {
    let word = name(code);
    if grammar
        .alarms
        .iter()
        .any(|alarm| alarm.as_bytes().eq_ignore_ascii_case(word))
    {
        return Some(Turn::Ends(true));
    }
    match grammar.language {
        Language::Sinumerik => sinumerik_turn(std::str::from_utf8(code).ok()?),
        _ => macro_turn(code),
    }
}

fn macro_turn(code: &[u8]) -> Option<Turn> {
    // Most blocks begin with a G code, or with an axis.
    let may = match code {
        [b'G' | b'g', next, ..] => next.eq_ignore_ascii_case(&b'O'),
        [first, ..] => matches!(first.to_ascii_uppercase(), b'M' | b'#' | b'(' | b'O' | b'I'),
        [] => false,
    };
    may.then_some(())?;
    let plain: Vec<u8> = code
        .iter()
        .filter(|b| !b.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let is = |word: &[u8]| {
        plain.starts_with(word) && !plain.get(word.len()).is_some_and(u8::is_ascii_digit)
    };
    let alarm = plain.starts_with(b"#3000=") || plain.starts_with(b"(ABORT,");
    if alarm || is(b"M2") || is(b"M02") || is(b"M30") {
        return Some(Turn::Ends(alarm));
    }
    if is(b"M99") {
        return Some(Turn::Back);
    }
    if plain.first() == Some(&b'O') {
        let back = matches!(o_word(code)?.keyword, Keyword::EndSub | Keyword::Return);
        return back.then_some(Turn::Back);
    }
    let at = plain.windows(4).position(|word| word == b"GOTO")?;
    let digits = &plain[at + 4..];
    let digits = &digits[..digits.iter().take_while(|b| b.is_ascii_digit()).count()];
    let number: Option<u32> = std::str::from_utf8(digits)
        .ok()
        .and_then(|digits| digits.parse().ok());
    match (number, at == 0 || plain.starts_with(b"IF")) {
        (Some(number), true) => Some(Turn::Jumps(number.to_string(), at == 0)),
        _ => Some(Turn::Somewhere),
    }
}

fn sinumerik_turn(code: &str) -> Option<Turn> {
    let first = code.split_whitespace().next()?;
    if matches!(first, "M2" | "M02" | "M30") {
        return Some(Turn::Ends(false));
    }
    if matches!(first, "M17" | "RET") || first.starts_with("PROC") || first.starts_with("%_N_") {
        return Some(Turn::Back);
    }
    let at = code.find("GOTO")?;
    let target = code[at + 4..]
        .trim_start_matches(['F', 'B', 'C'])
        .split_whitespace()
        .next()?;
    Some(Turn::Jumps(target.to_owned(), at == 0))
}

/// Label at the start of a SINUMERIK block in capitals: `NAME:`.
pub fn label(code: &[u8]) -> Option<&[u8]> {
    let label = name(code);
    let begins = label
        .first()
        .is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_');
    (begins && code.get(label.len()) == Some(&b':')).then_some(label)
}

/// A SINUMERIK block without its label.
pub fn without_label(code: &[u8]) -> &[u8] {
    label(code).map_or(code, |label| code[label.len() + 1..].trim_ascii_start())
}

/// A SINUMERIK block in capitals, without its number and its comment, but with its label.
pub fn capitals(line: &[u8]) -> Vec<u8> {
    let code = &line[head(line).end..];
    without_comment(code, None).to_ascii_uppercase()
}

/// A line without the comment at its end.
pub fn without_comment<'l>(line: &'l [u8], sign: Option<&str>) -> &'l [u8] {
    let end = comment_at(line, false).unwrap_or(line.len());
    let own = sign.and_then(|sign| memchr::memmem::find(&line[..end], sign.as_bytes()));
    line[..own.unwrap_or(end)].trim_ascii()
}

/// A block of HEIDENHAIN's ISO without its number and the final `*`, in capitals.
pub fn heidenhain_code(line: &[u8]) -> String {
    let code = without_comment(&line[head(line).end..], None).to_ascii_uppercase();
    let code = String::from_utf8_lossy(&code);
    code.strip_suffix('*').unwrap_or(&code).trim().to_owned()
}

/// Number of `G98 L5`.
pub fn heidenhain_label(code: &str) -> Option<u32> {
    code.strip_prefix("G98")?
        .trim_start()
        .strip_prefix('L')?
        .trim()
        .parse()
        .ok()
}

/// Effect of a block of HEIDENHAIN's ISO on the course of the program.
pub fn heidenhain_turn(code: &str) -> Option<Turn> {
    match (heidenhain_label(code), code.get(..3)) {
        (Some(0), _) => Some(Turn::Back),
        (_, Some("D14")) => Some(Turn::Ends(true)),
        (_, Some("D09" | "D10" | "D11" | "D12")) => {
            Some(Turn::Jumps(d_part(code, "P03")?.to_owned(), false))
        }
        _ if ["M2", "M02", "M30"].contains(&code) => Some(Turn::Ends(false)),
        _ => None,
    }
}

/// Operand P01, P02 or P03 of a D code.
pub fn d_part<'c>(code: &'c str, name: &str) -> Option<&'c str> {
    let (_, rest) = code.split_once(name)?;
    Some(rest.split(" P").next().unwrap_or_default().trim())
}

/// Whether a comment of LinuxCNC stops the program: `(ABORT, …)`.
pub fn aborts(code: &[u8]) -> bool {
    let word = code[1..].trim_ascii_start();
    word.get(..5)
        .is_some_and(|begin| begin.eq_ignore_ascii_case(b"abort"))
        && word[5..].trim_ascii_start().starts_with(b",")
}

/// Whether a block begins with this code: `M99`, not `M990`.
pub fn begins(code: &[u8], word: &[u8; 3]) -> bool {
    code.get(..3)
        .is_some_and(|begin| begin.eq_ignore_ascii_case(word))
        && !code.get(3).is_some_and(u8::is_ascii_digit)
}

/// Letters, digits and underscores at the start of a text.
fn name(code: &[u8]) -> &[u8] {
    let is_name = |b: &&u8| b.is_ascii_alphanumeric() || **b == b'_';
    &code[..code.iter().take_while(is_name).count()]
}

fn letters(code: &[u8]) -> usize {
    code.iter().take_while(|b| b.is_ascii_alphabetic()).count()
}

fn skip_blanks(code: &[u8], at: usize) -> usize {
    let blanks = |b: &&u8| b.is_ascii_whitespace();
    at + code[at.min(code.len())..].iter().take_while(blanks).count()
}
