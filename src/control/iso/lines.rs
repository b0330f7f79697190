//! A program line by line: comments, numbers of blocks, jumps by name.

use std::collections::BTreeMap;

use crate::control::iso::parse::{Parsed, fault};
use crate::control::iso::script::{BLANKS, Script, Trouble, What};
use crate::geom::AXIS_NAMES;
use crate::text::{Text, text};

/// A comment of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Comment<'t> {
    /// What begins it: `(` or `;`. Some comments do something, and only after one of them.
    pub sign: u8,
    /// It, without brackets or sign.
    pub text: &'t str,
}

/// The code of a line and its comment. A sign inside a text begins none.
pub fn split_comment(line: &str, sign: u8) -> Parsed<(&str, Option<Comment<'_>>)> {
    let comment = |sign: u8, text| Some(Comment { sign, text });
    let Some(first) = memchr::memchr3(sign, b';', b'"', line.as_bytes()) else { return Ok((line, None)) };
    let mut quoted = false;
    for (at, b) in line.bytes().enumerate().skip(first) {
        match b {
            b'"' => quoted = !quoted,
            b';' if !quoted => return Ok((&line[..at], comment(b, trimmed(&line[at + 1..])))),
            _ if b != sign || quoted => {}
            b'(' => {
                let inner = trimmed(&line[at + 1..]);
                let inner =
                    inner.strip_suffix(')').ok_or_else(|| text!("a comment is not closed, or there is code after it"))?;
                if inner.bytes().any(|b| b == b')' || b == b'(') {
                    return fault(text!("two comments are in one line, or one in another"));
                }
                return Ok((&line[..at], comment(b, inner)));
            }
            _ => {}
        }
    }
    Ok((line, None))
}

/// Where the header says that the ball is before the start: `The stylus is taken to be at X0 Y0 Z100 before the start`.
pub fn stated_start(comment: &str) -> Option<[f64; 3]> {
    const HEAD: &str = "The stylus is taken to be at ";
    let words = comment.get(HEAD.len()..).filter(|_| comment[..HEAD.len()].eq_ignore_ascii_case(HEAD))?;
    let mut place = [None; 3];
    for word in words.split(' ').take(3) {
        let axis = AXIS_NAMES.iter().position(|name| word.starts_with(name))?;
        place[axis] = crate::num::read(&word[1..]).filter(|x| x.is_finite());
    }
    Some([place[0]?, place[1]?, place[2]?])
}

/// What a control reads a line as: its number, its code, its comment.
pub type Block<'f, 't> = dyn FnMut(&mut Script<'t>, usize, &'t str, Option<Comment<'t>>) -> Parsed<()> + 'f;

/// So many lines that are not understood are listed: after them a text is no program of this control, and is not read on.
const MOST_TROUBLES: usize = 200;

/// Reads line by line: `block` gets the code and the comment of each line. The lines that are not understood are listed.
pub fn lines<'t>(text: &'t str, sign: u8, script: &mut Script<'t>, block: &mut Block<'_, 't>) -> Result<(), Vec<Trouble>> {
    let mut troubles = Vec::new();
    let code = |line: &str| !line.is_empty() && !line.starts_with(['(', ';']);
    let hides = hides(text);
    let mut begun = false;
    // Whether something stands in front of a carriage return that no line feed has followed yet.
    let mut returned = false;
    let mut rest = text;
    for line in 0.. {
        if rest.is_empty() || troubles.len() == MOST_TROUBLES {
            break;
        }
        let full = next_line(&mut rest);
        if hides && self::hides(full) {
            troubles.push(Trouble { line, message: hidden(), understood: false });
            continue;
        }
        let trimmed = trimmed(full);
        // grbl ends a line there, LinuxCNC does not: `;\r` would hide from it what stands behind.
        if returned && !trimmed.is_empty() {
            let message = text!("a carriage return without a line feed: not every control ends a line there");
            troubles.push(Trouble { line, message, understood: false });
            returned = false;
            continue;
        }
        returned = (returned || !trimmed.is_empty()) && text[..text.len() - rest.len()].ends_with('\r');
        // A tape sign stands before a program and after it: what stands after another is not loaded.
        if let Some(behind) = trimmed.strip_prefix('%') {
            if !is_tape_name(behind) {
                troubles.push(Trouble { line, message: text!("there is code after the final %"), understood: false });
            } else if begun && rest.split(['\n', '\r']).any(|line| code(self::trimmed(line))) {
                troubles.push(Trouble { line, message: text!("% ends the program here"), understood: false });
            }
            continue;
        }
        begun |= !trimmed.is_empty() && !trimmed.starts_with(';');
        let read = split_comment(full, sign).and_then(|(code, comment)| {
            if let Some(comment) = comment {
                script.start = script.start.or_else(|| stated_start(comment.text));
            }
            block(script, line, self::trimmed(code), comment)
        });
        if let Err(message) = read {
            troubles.push(Trouble { line, message: *message, understood: false });
        }
    }
    if troubles.is_empty() { Ok(()) } else { Err(troubles) }
}

/// Whether what stands behind a tape sign is no code: nothing, a comment, a number, or the name of an archive, `_N_PART_MPF`.
fn is_tape_name(behind: &str) -> bool {
    let Ok((code, _)) = split_comment(behind, b'(') else { return false };
    let code = trimmed(code);
    let name = code.strip_prefix("_N_").unwrap_or_default();
    let named = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
    code.bytes().all(|b| b.is_ascii_digit()) || !name.is_empty() && name.bytes().all(named)
}

/// Takes the next line off a text, without its end: a line feed, a carriage return, or both, as editors count lines.
pub fn next_line<'t>(rest: &mut &'t str) -> &'t str {
    let text = *rest;
    match memchr::memchr2(b'\n', b'\r', text.as_bytes()) {
        Some(at) => {
            *rest = &text[at + if text[at..].starts_with("\r\n") { 2 } else { 1 }..];
            &text[..at]
        }
        None => {
            *rest = "";
            text
        }
    }
}

/// Whether a text has a vertical tab, a form feed or a NUL: no control takes one for a blank, and LinuxCNC's interpreter ends a line at a NUL.
pub fn hides(text: &str) -> bool {
    memchr::memchr3(0x0b, 0x0c, 0, text.as_bytes()).is_some()
}

/// What is wrong with such a line.
pub fn hidden() -> Text {
    text!("a vertical tab, a form feed or a NUL: controls do not take it as a blank")
}

/// The lines with a semicolon, for a control that has no such comments.
pub fn with_semicolons(text: &str) -> Vec<Trouble> {
    let mut troubles = Vec::new();
    let mut rest = text;
    // Nearly always there is none.
    for line in 0.. {
        if memchr::memchr(b';', rest.as_bytes()).is_none() || troubles.len() == MOST_TROUBLES {
            break;
        }
        if next_line(&mut rest).contains(';') {
            let message = text!("a semicolon begins no comment on this control: it may end the block");
            troubles.push(Trouble { line, message, understood: false });
        }
    }
    troubles
}

/// A text without the blanks around it: spaces and tabs, as controls have them. Nearly always there are none.
pub fn trimmed(text: &str) -> &str {
    match text.as_bytes() {
        [] => text,
        [first, .., last] if first.is_ascii_graphic() && last.is_ascii_graphic() => text,
        _ => text.trim_matches(BLANKS),
    }
}

/// What stands after a beginning, in small letters or capitals.
pub fn after<'t>(text: &'t str, beginning: &str) -> Option<&'t str> {
    let same = text.get(..beginning.len())?.eq_ignore_ascii_case(beginning);
    same.then(|| &text[beginning.len()..])
}

/// Jumps and calls by name, resolved when everything is read.
#[derive(Debug, Default)]
pub struct Targets<'t> {
    /// Labels and subroutines, and where they stand.
    pub known: Vec<(&'t [u8], usize)>,
    /// Blocks that go somewhere, and where to.
    pub wanted: Vec<(usize, &'t [u8])>,
}

/// In place of a place: the name is there more than once.
const TWICE: u32 = u32::MAX;

impl Targets<'_> {
    /// Puts the targets in. Each must be there once; `below` is whether it has to stand below the jump.
    pub fn resolve(&self, script: &mut Script<'_>, below: bool) -> Result<(), Vec<Trouble>> {
        let mut troubles = Vec::new();
        let names: Vec<Vec<u8>> = self.known.iter().map(|(name, _)| name.to_ascii_lowercase()).collect();
        let mut places: BTreeMap<&[u8], u32> = BTreeMap::new();
        for (name, (_, place)) in names.iter().zip(&self.known) {
            places.entry(name).and_modify(|known| *known = TWICE).or_insert(*place as u32);
        }
        for (from, name) in &self.wanted {
            let message = match places.get(name.to_ascii_lowercase().as_slice()) {
                None => text!("the target of this jump does not exist"),
                Some(&TWICE) => text!("the target of this jump exists more than once"),
                Some(&to) if below && to as usize <= *from => text!("a forward jump whose label is only above it"),
                Some(&to) => {
                    match &mut script.blocks[*from].what {
                        What::Jump(target) | What::JumpIf(_, target) | What::JumpUnless(_, target) | What::Call(target, _) => {
                            *target = to as usize;
                        }
                        _ => {}
                    }
                    continue;
                }
            };
            troubles.push(Trouble { line: script.blocks[*from].line, message, understood: true });
        }
        if troubles.is_empty() { Ok(()) } else { Err(troubles) }
    }
}

/// A block without its number, `N10`.
pub fn without_number(code: &str) -> &str {
    let rest = code.strip_prefix('N').map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    match rest {
        Some(rest) if rest.len() + 1 < code.len() && rest.starts_with(' ') => rest.trim_start_matches(BLANKS),
        _ => code,
    }
}
