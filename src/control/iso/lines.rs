//! Reads a program line by line for the strict readers: a line that a control would read differently is refused.

use crate::control::iso::lex::{self, Comment, comment_at, hides, lines_of, next_line, trimmed};
use crate::control::iso::line_cache::{Checkpoint, LineCache, ReaderId};
use crate::control::iso::parse::{Parsed, fault};
use crate::control::iso::script::{ReadError, Script};
use crate::control::iso::targets::{BackReference, Targets};
use crate::geom::AXIS_NAMES;
use crate::text::{Text, text};

/// The code of a line and its comment. A sign inside quotes does not begin one.
pub fn split_comment(line: &str, sign: u8) -> Parsed<(&str, Option<Comment<'_>>)> {
    let Some(at) = comment_at(line.as_bytes(), sign == b'(') else {
        return Ok((line, None));
    };
    let (code, behind) = (&line[..at], trimmed(&line[at + 1..]));
    let sign = line.as_bytes()[at];
    if sign == b';' {
        return Ok((code, Some(Comment { sign, text: behind })));
    }
    let inner = behind
        .strip_suffix(')')
        .ok_or_else(|| text!("a comment is not closed, or there is code after it"))?;
    if inner.bytes().any(|b| b == b')' || b == b'(') {
        return fault(text!("two comments are in one line, or one in another"));
    }
    Ok((code, Some(Comment { sign, text: inner })))
}

/// Start of the ball in the header: `The stylus is taken to be at X0 Y0 Z100 before the start`.
pub fn stated_start(comment: &str) -> Option<[f64; 3]> {
    const HEAD: &str = "The stylus is taken to be at ";
    let words = comment
        .get(HEAD.len()..)
        .filter(|_| comment[..HEAD.len()].eq_ignore_ascii_case(HEAD))?;
    let mut place = [None; 3];
    for word in words.split(' ').take(3) {
        let axis = AXIS_NAMES.iter().position(|name| word.starts_with(name))?;
        place[axis] = crate::num::read(&word[1..]).filter(|x| x.is_finite());
    }
    Some([place[0]?, place[1]?, place[2]?])
}

/// Start of the comment with the tool of the probe.
pub const PROBE_TOOL: &str = "The probe is tool ";

/// Number of the tool in the header: `The probe is tool 7`.
fn stated_tool(comment: &str) -> Option<f64> {
    crate::num::read(lex::strip_prefix_nocase(comment, PROBE_TOOL)?)
}

/// Reader of the lines of one control.
pub trait Blocks<'t> {
    /// Reads a line: number, code, comment. The result depends only on its text and on [`Targets::place`], or [`Targets::depends`] is set.
    fn block(
        &mut self,
        script: &mut Script<'t>,
        targets: &mut Targets<'t>,
        line: usize,
        code: &'t str,
        comment: Option<Comment<'t>>,
    ) -> Parsed<()>;

    /// Carries out [`Targets::later`] after the last block.
    fn later(
        &mut self,
        _: &mut Script<'t>,
        _: &mut Targets<'t>,
        _: BackReference<'t>,
    ) -> Parsed<()> {
        Ok(())
    }
}

/// Largest number of listed lines that are not understood. After them the text is not a program of this control, and reading stops.
const MOST_TROUBLES: usize = 200;

/// Reads line by line and lists the lines that are not understood.
pub fn lines<'t>(
    text: &'t str,
    (hand, sign): (ReaderId, u8),
    script: &mut Script<'t>,
    targets: &mut Targets<'t>,
    reader: &mut dyn Blocks<'t>,
) -> Result<(), Vec<ReadError>> {
    let mut memory = LineCache::take();
    let mut troubles = Vec::new();
    let code = |line: &str| !line.is_empty() && !line.starts_with(['(', ';']);
    let hidden_any = hides(text);
    let mut begun = false;
    // Whether there was text before a carriage return without a line feed.
    let mut returned = false;
    let mut rest = text;
    for line in 0.. {
        if rest.is_empty() || troubles.len() == MOST_TROUBLES {
            break;
        }
        let full = next_line(&mut rest);
        let returns = text.as_bytes()[..text.len() - rest.len()].ends_with(b"\r");
        let place = (hand, targets.place);
        // The line was read before, and it is correct.
        if !returned
            && let Some(begins) = memory
                .as_mut()
                .and_then(|memory| memory.put((line, full), place, script, targets))
        {
            (returned, begun) = (returns, begun || begins);
            if let Err(message) = later(reader, script, targets) {
                troubles.push(ReadError {
                    line,
                    message: *message,
                    understood: false,
                });
            }
            continue;
        }
        if hidden_any && hides(full) {
            troubles.push(ReadError {
                line,
                message: hidden(),
                understood: false,
            });
            continue;
        }
        let trimmed = trimmed(full);
        // grbl ends a line there, LinuxCNC does not: `;\r` would hide the rest of the line from it.
        if returned && !trimmed.is_empty() {
            let message =
                text!("a carriage return without a line feed: not every control ends a line there");
            troubles.push(ReadError {
                line,
                message,
                understood: false,
            });
            returned = false;
            continue;
        }
        returned = (returned || !trimmed.is_empty()) && returns;
        // A tape sign starts a program and ends it: text after the second one is not loaded.
        if let Some(behind) = trimmed.strip_prefix('%') {
            if !is_tape_name(behind) {
                troubles.push(ReadError {
                    line,
                    message: text!("there is code after the final %"),
                    understood: false,
                });
            } else if begun && lines_of(rest).any(|line| code(lex::trimmed(line))) {
                troubles.push(ReadError {
                    line,
                    message: text!("% ends the program here"),
                    understood: false,
                });
            }
            continue;
        }
        let begins = !trimmed.is_empty() && !trimmed.starts_with(';');
        begun |= begins;
        let before = Checkpoint::of(script, targets);
        targets.depends = trimmed.is_empty();
        let read = split_comment(full, sign).and_then(|(code, comment)| {
            if let Some(start) = comment.and_then(|comment| stated_start(comment.text)) {
                // Only the first of them counts.
                targets.depends = true;
                script.start.get_or_insert(start);
            }
            if let Some(tool) = comment.and_then(|comment| stated_tool(comment.text)) {
                targets.depends = true;
                script.tool.get_or_insert(tool);
            }
            reader.block(script, targets, line, lex::trimmed(code), comment)
        });
        if read.is_ok()
            && !targets.depends
            && let Some(memory) = &mut memory
        {
            memory.keep(full, (place, begins), before, script, targets);
        }
        // A fault after it is reported after it.
        if let Err(message) = later(reader, script, targets).and(read) {
            troubles.push(ReadError {
                line,
                message: *message,
                understood: false,
            });
        }
    }
    LineCache::give_back(memory);
    script.asked = Vec::new();
    if troubles.is_empty() {
        Ok(())
    } else {
        Err(troubles)
    }
}

fn later<'t>(
    reader: &mut dyn Blocks<'t>,
    script: &mut Script<'t>,
    targets: &mut Targets<'t>,
) -> Parsed<()> {
    targets
        .later
        .take()
        .map_or(Ok(()), |later| reader.later(script, targets, later))
}

/// Whether the text after a tape sign is not code: empty, a comment, a number, or the name of an archive, `_N_PART_MPF`.
fn is_tape_name(behind: &str) -> bool {
    let Ok((code, _)) = split_comment(behind, b'(') else {
        return false;
    };
    let code = trimmed(code);
    let name = code.strip_prefix("_N_").unwrap_or_default();
    let named = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
    code.bytes().all(|b| b.is_ascii_digit()) || !name.is_empty() && name.bytes().all(named)
}

/// Fault of such a line.
pub fn hidden() -> Text {
    text!("a vertical tab, a form feed or a NUL: controls do not read it as a blank")
}

/// Lines with a semicolon, for a control without such comments.
pub fn with_semicolons(text: &str) -> Vec<ReadError> {
    let mut troubles = Vec::new();
    let mut rest = text;
    // Most texts have no semicolon.
    for line in 0.. {
        if memchr::memchr(b';', rest.as_bytes()).is_none() || troubles.len() == MOST_TROUBLES {
            break;
        }
        if next_line(&mut rest).contains(';') {
            let message =
                text!("a semicolon begins no comment on this control: it may end the block");
            troubles.push(ReadError {
                line,
                message,
                understood: false,
            });
        }
    }
    troubles
}
