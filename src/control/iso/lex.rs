//! Lexical elements of a program: lines, blanks, comments, block numbers, words and values. Every reader uses them.

use crate::control::iso::script::BLANKS;
use crate::num::{read, read_digits};

/// End of the line that begins at `at`, and start of the next one. A line ends at a line feed, a carriage return, or both, as editors count lines.
pub fn line_end(text: &[u8], at: usize) -> (usize, usize) {
    let end = memchr::memchr2(b'\n', b'\r', &text[at..]).map_or(text.len(), |length| at + length);
    (
        end,
        if text[end..].starts_with(b"\r\n") {
            end + 2
        } else {
            (end + 1).min(text.len())
        },
    )
}

/// Takes the next line from a text, without its line end.
pub fn next_line<'t>(rest: &mut &'t str) -> &'t str {
    let text = *rest;
    let (end, next) = line_end(text.as_bytes(), 0);
    *rest = &text[next..];
    &text[..end]
}

pub fn lines_of(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || (!rest.is_empty()).then(|| next_line(&mut rest)))
}

/// Whether a text has a vertical tab, a form feed or a NUL. No control treats one as a blank, and LinuxCNC's interpreter ends a line at a NUL.
pub fn hides(text: &str) -> bool {
    memchr::memchr3(0x0b, 0x0c, 0, text.as_bytes()).is_some()
}

/// A text without surrounding blanks: spaces and tabs, as on controls. Most texts have no blanks around them.
pub fn trimmed(text: &str) -> &str {
    match text.as_bytes() {
        [] => text,
        [first, .., last] if first.is_ascii_graphic() && last.is_ascii_graphic() => text,
        _ => text.trim_matches(BLANKS),
    }
}

/// The rest of a text after a prefix in small letters or capitals.
pub fn strip_prefix_nocase<'t>(text: &'t str, beginning: &str) -> Option<&'t str> {
    let same = text.get(..beginning.len())?.eq_ignore_ascii_case(beginning);
    same.then(|| &text[beginning.len()..])
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Comment<'t> {
    /// Its first character, `(` or `;`: some comments have an effect only after one of them.
    pub sign: u8,
    /// The text without its brackets or sign.
    pub text: &'t str,
}

/// Start of the first comment of a line: at a `;`, or at a `(` if it begins a comment. A sign inside quotes does not.
pub fn comment_at(line: &[u8], round: bool) -> Option<usize> {
    let first = if round {
        memchr::memchr3(b'(', b';', b'"', line)
    } else {
        memchr::memchr2(b';', b'"', line)
    }?;
    let mut quoted = false;
    line[first..]
        .iter()
        .position(|b| {
            quoted ^= *b == b'"';
            (*b == b';' || round && *b == b'(') && !quoted
        })
        .map(|at| first + at)
}

/// The line up to its first comment.
pub fn code(line: &str, round: bool) -> &str {
    &line[..comment_at(line.as_bytes(), round).unwrap_or(line.len())]
}

/// The part of a block before its words.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlockPrefix {
    /// `/`: with block skip on, the control omits the block.
    pub skips: bool,
    /// The number of the block, `N10` or `:10`.
    pub number: Option<u32>,
    /// Byte at which the words begin.
    pub end: usize,
}

/// The part of a block before its words. An `N` without digits, or with a decimal point after them, is a word.
pub fn head(line: &[u8]) -> BlockPrefix {
    let mut head = BlockPrefix::default();
    while let Some(sign @ (b'/' | b':' | b'N' | b'n')) = line.get(head.end) {
        let begin = head.end + 1;
        let digits = line[begin..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count();
        let end = begin + digits;
        if sign.is_ascii_alphabetic() && (digits == 0 || line.get(end) == Some(&b'.')) {
            break;
        }
        if *sign == b'/' {
            head.skips = true;
        } else {
            head.number = parse_digits(&line[begin..end]);
        }
        head.end = end
            + line[end..]
                .iter()
                .take_while(|b| matches!(b, b' ' | b'\t'))
                .count();
    }
    head
}

/// A block without its number: `N10 G1`.
pub fn without_number(code: &str) -> &str {
    let head = head(code.as_bytes());
    if head.skips { code } else { &code[head.end..] }
}

/// A Klartext block without its number, which has no letter: `12 TCH PROBE`, `12 ; a comment`.
pub fn without_count(line: &str) -> &str {
    let rest = line.trim_start_matches(|c: char| c.is_ascii_digit());
    if rest.is_empty() || rest.starts_with(char::is_whitespace) {
        rest.trim_start()
    } else {
        line
    }
}

/// Number of a program on its own line: `O100 (A COMMENT)`.
pub fn program_number(line: &[u8]) -> Option<u32> {
    let [b'O' | b'o', rest @ ..] = line else {
        return None;
    };
    let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    let alone = matches!(
        rest[digits..].trim_ascii_start().first(),
        None | Some(b'(' | b';')
    );
    parse_digits(&rest[..digits]).filter(|_| alone)
}

/// The number of these digits, or the largest possible one if they exceed it.
fn parse_digits(digits: &[u8]) -> Option<u32> {
    let more = |sum: u32, digit: &u8| {
        sum.saturating_mul(10)
            .saturating_add(u32::from(digit - b'0'))
    };
    (!digits.is_empty()).then(|| digits.iter().fold(0, more))
}

/// A sign or a number of a block: `X1.0` and `X 1` are equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Token {
    /// A non-blank sign, in capitals.
    Sign(u8),
    /// A number without its sign.
    Number(f64),
}

/// The signs and numbers of a block.
pub fn tokens(code: &str) -> Vec<Token> {
    let bytes = code.as_bytes();
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let digits = bytes[at..]
            .iter()
            .take_while(|b| b.is_ascii_digit() || **b == b'.')
            .count();
        let end = at + digits.max(1);
        match code.get(at..end).filter(|_| digits > 0).and_then(read) {
            Some(number) => tokens.push(Token::Number(number)),
            None => {
                let signs = bytes[at..end].iter().filter(|b| !b.is_ascii_whitespace());
                tokens.extend(signs.map(|b| Token::Sign(b.to_ascii_uppercase())));
            }
        }
        at = end;
    }
    tokens
}

/// Whether only blanks and comments precede a word.
pub fn is_first_word(line: &[u8], begin: usize, at: usize) -> bool {
    let mut before = line[begin..at].trim_ascii();
    while before.first() == Some(&b'(') {
        before = before[end_of(before, 0, b')')..].trim_ascii();
    }
    before.is_empty()
}

/// A number and its end.
pub fn number(line: &[u8], at: usize) -> Option<(f64, usize)> {
    let negative = line.get(at) == Some(&b'-');
    let first = at + usize::from(matches!(line.get(at), Some(b'-' | b'+')));
    let (size, length) = read_digits(line.get(first..)?)?;
    Some((if negative { -size } else { size }, first + length))
}

/// Position after the closing bracket, or the end of the line if no bracket closes.
pub fn end_of(line: &[u8], at: usize, close: u8) -> usize {
    line[at..]
        .iter()
        .position(|b| *b == close)
        .map_or(line.len(), |n| at + n + 1)
}

/// Position after a value that is not a plain number. Brackets are matched.
pub fn end_of_value(line: &[u8], at: usize) -> usize {
    let mut depth = 0usize;
    for (n, b) in line.iter().enumerate().skip(at) {
        match b {
            b'[' | b'(' | b'<' => depth += 1,
            b']' | b')' | b'>' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return n + 1;
                }
            }
            b' ' | b'\t' | b';' if depth == 0 => return n,
            // `#5` ends at the next word.
            b if depth == 0 && n > at && line[at] == b'#' && b.is_ascii_alphabetic() => return n,
            _ => {}
        }
    }
    line.len()
}

/// Start of the next word after something that is not a word: a letter with a value, outside of brackets and comments.
pub fn next_word(line: &[u8], at: usize) -> usize {
    let mut depth = 0usize;
    for n in at + 1..line.len() {
        match line[n - 1] {
            b'[' | b'(' | b'<' => depth += 1,
            b']' | b')' | b'>' => depth = depth.saturating_sub(1),
            b';' => break,
            before if before.is_ascii_alphabetic() || before == b'_' => continue,
            _ => {}
        }
        if depth == 0 && line[n].is_ascii_alphabetic() && valued(line, n) {
            return n;
        }
    }
    line.len()
}

/// Whether a value may follow a letter.
pub fn valued(line: &[u8], at: usize) -> bool {
    line.get(at + 1)
        .is_some_and(|next| next.is_ascii_digit() || b".+-=#[ ".contains(next))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_as_editors_count_them() {
        let lines: Vec<&str> = lines_of("G0\r\nG1\rG2\n\nG3").collect();
        assert_eq!(lines, ["G0", "G1", "G2", "", "G3"]);
        assert_eq!(lines_of("").count() + lines_of("\r\n").count(), 1);
        assert_eq!(line_end(b"G0\r\nG1", 0), (2, 4));
        assert_eq!(line_end(b"G0\r\nG1", 4), (6, 6));
    }

    #[test]
    fn a_comment_begins_outside_of_texts() {
        for (line, round, plain) in [
            ("G0 X1 ; (a", "G0 X1 ", "G0 X1 "),
            ("G0 (a) ; b", "G0 ", "G0 (a) "),
            ("MSG(\"a;(b\") ; c", "MSG", "MSG(\"a;(b\") "),
            ("\"a;b\" (c)", "\"a;b\" ", "\"a;b\" (c)"),
            ("G0", "G0", "G0"),
        ] {
            assert_eq!(
                (code(line, true), code(line, false)),
                (round, plain),
                "{line}"
            );
        }
    }

    #[test]
    fn the_head_of_a_block() {
        for (line, skips, number, words) in [
            ("/N10 G1", true, Some(10), "G1"),
            ("n020G1411", false, Some(20), "G1411"),
            (":5 G1", false, Some(5), "G1"),
            ("/2 N3 X1", true, Some(3), "X1"),
            ("N99999999999 X1", false, Some(u32::MAX), "X1"),
            ("N X1", false, None, "N X1"),
            ("N1.5", false, None, "N1.5"),
            ("12 G1", false, None, "12 G1"),
            ("", false, None, ""),
        ] {
            let head = head(line.as_bytes());
            assert_eq!(
                (head.skips, head.number, &line[head.end..]),
                (skips, number, words),
                "{line}"
            );
        }
        assert_eq!(
            without_number("/N10 G1"),
            "/N10 G1",
            "a strict reader sees what skips a block"
        );
        assert_eq!(
            (
                without_count("12 TCH PROBE"),
                without_count("12"),
                without_count("12X")
            ),
            ("TCH PROBE", "", "12X")
        );
    }

    #[test]
    fn a_program_number_is_alone_in_its_line() {
        let number = |line: &str| program_number(line.as_bytes());
        assert_eq!(
            (number("O0100 (A)"), number("o7"), number("O7 ; A")),
            (Some(100), Some(7), Some(7))
        );
        assert_eq!(
            (
                number("O7 sub"),
                number("O<a> call"),
                number("O"),
                number("X1")
            ),
            (None, None, None, None)
        );
    }
}
