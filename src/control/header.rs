//! The job as comments, written and read: all its values, the format, the version that wrote it, and a hash over the blocks below.

use crate::control::iso::lex::{next_line, strip_prefix_nocase, without_count};
use crate::control::shop::coded::encoded;
use crate::control::shop::place::PATH;
use crate::control::{HeaderDetail, Request, comment_char};
use crate::form::Value;
use crate::num::{format_count, push_in_full};

/// Start of a comment with values of the job.
pub const JOB_LINE: &str = "job ";

/// Start of the comment with the version that wrote the program.
pub const MADE_BY: &str = "Made by Touchpath ";

/// Start of the comment with the hash over the lines below it.
pub const HASH: &str = "Blocks below: ";

/// Placeholder of the same length as the hash, until the blocks are written.
pub const NO_HASH: &str = "0000000000000000";

/// The comments. A full header has the whole job without its name and the virtual part, a short one only the version; the hash follows. `width` is the longest
/// comment. If only capitals are possible, a small letter in a text is a plus and a capital.
pub fn lines(request: &Request<'_>, width: usize, capitals: bool) -> Vec<String> {
    let version = env!("CARGO_PKG_VERSION");
    let mut lines = match (request.header, request.job) {
        (HeaderDetail::Full, Some(job)) => {
            let mut lines = vec![format!(
                "{MADE_BY}{version} from this job, every value, defaults too:"
            )];
            lines.extend(job_lines(job, width, capitals));
            lines
        }
        _ => vec![format!("{MADE_BY}{version}")],
    };
    lines.push(format!("{HASH}{NO_HASH}"));
    lines
}

/// Replaces the placeholder by the hash.
pub fn seal(text: &mut String) {
    let mut at = 0;
    while let Some(end) = text[at..].find('\n') {
        let (line, below) = (&text[at..at + end], at + end + 1);
        if let Some(digits) = comment(line)
            .and_then(|comment| strip_prefix_nocase(comment, HASH))
            .and_then(|_| line.find(NO_HASH))
        {
            let hash = hash(&text[below..]);
            text.replace_range(at + digits..at + digits + NO_HASH.len(), &hash);
            return;
        }
        at = below;
    }
}

/// Hash over lines: line ends, trailing blanks and empty lines do not count. XXH64 as 16 hexadecimal digits.
pub fn hash(text: &str) -> String {
    let mut state = xxhash_rust::xxh64::Xxh64::new(0);
    if is_plain(text) {
        // The same bytes as line by line below.
        state.update(text.as_bytes());
        return format!("{:016X}", state.digest());
    }
    let mut rest = text;
    while !rest.is_empty() {
        let line = next_line(&mut rest).trim_end();
        if !line.is_empty() {
            state.update(line.as_bytes());
            state.update(b"\n");
        }
    }
    format!("{:016X}", state.digest())
}

/// Whether every line is non-empty, ends in a single line feed, and has no trailing blank.
fn is_plain(text: &str) -> bool {
    let filled = |at: usize| at > 0 && text.as_bytes()[at - 1] > b' ';
    text.is_ascii()
        && text.ends_with('\n')
        && memchr::memchr_iter(b'\n', text.as_bytes()).all(filled)
}

/// The job as comment lines of `path=value` words, without its name and the virtual part. A comment has at most `width` characters.
fn job_lines(job: &Value, width: usize, capitals: bool) -> Vec<String> {
    let mut words = Words {
        width,
        capitals,
        path: String::new(),
        word: String::new(),
        lines: Vec::new(),
    };
    if let Value::Map(entries) = job {
        for (key, value) in entries
            .iter()
            .filter(|(key, _)| !matches!(key.as_str(), "name" | "part"))
        {
            words.within(&[key], |words| words.push(value));
        }
    }
    words.lines
}

/// Lines of words under construction.
struct Words {
    width: usize,
    capitals: bool,
    /// Path of the value in the job.
    path: String,
    word: String,
    lines: Vec<String>,
}

impl Words {
    /// Runs `push` at an inner path and returns to the outer one.
    fn within(&mut self, parts: &[&str], push: impl FnOnce(&mut Self)) {
        let outside = self.path.len();
        parts.iter().for_each(|part| self.path.push_str(part));
        push(self);
        self.path.truncate(outside);
    }

    fn push(&mut self, value: &Value) {
        match value {
            Value::Map(entries) if !entries.is_empty() => {
                entries
                    .iter()
                    .for_each(|(key, inner)| self.within(&[".", key], |words| words.push(inner)));
            }
            Value::Text(line) if self.path.starts_with(PATH) => self.push_line(line),
            Value::List(items) => {
                self.write(value);
                let nested = self.path.starts_with(PATH)
                    || items
                        .iter()
                        .any(|item| matches!(item, Value::Map(_) | Value::List(_)));
                // A list that is too long for a line is written value by value.
                if items.is_empty() || (!nested && self.word.len() + JOB_LINE.len() <= self.width) {
                    return self.keep();
                }
                let each = |(i, inner): (usize, &Value)| {
                    self.within(&["[", &format_count(i), "]"], |words| words.push(inner))
                };
                items.iter().enumerate().for_each(each);
            }
            value => {
                self.write(value);
                self.keep();
            }
        }
    }

    /// A line of the shop. A long one continues in words with `+=`.
    fn push_line(&mut self, line: &str) {
        let code = encoded(line, self.capitals);
        let (mut sign, mut rest) = ("=", code.as_str());
        loop {
            let room = self.width - JOB_LINE.len() - self.path.len() - sign.len();
            let mut end = room.min(rest.len());
            // `+A` and `@28` are not cut.
            if end < rest.len() {
                let tail = &rest[end.saturating_sub(2)..end];
                end -= tail.find(['+', '@']).map_or(0, |at| tail.len() - at);
            }
            self.word.clear();
            [&self.path, sign, &rest[..end]]
                .into_iter()
                .for_each(|part| self.word.push_str(part));
            self.keep();
            (sign, rest) = ("+=", &rest[end..]);
            if rest.is_empty() {
                return;
            }
        }
    }

    /// Writes the word of a value.
    fn write(&mut self, value: &Value) {
        // Words outside the cycle belong to choices: the reader recognises them in capitals, too.
        let own = ["cycle.", "cycles[", "datum.", "relations", "tolerances."]
            .iter()
            .any(|own| self.path.starts_with(own));
        let marked =
            self.capitals && own && !self.path.ends_with("].type") && self.path != "cycle.type";
        self.word.clear();
        self.word.push_str(&self.path);
        self.word.push('=');
        push_value(&mut self.word, value, marked);
    }

    /// Appends the word to the last line, or starts a new line if that is full.
    fn keep(&mut self) {
        let lead = match self.lines.last_mut() {
            Some(line) if line.len() + 1 + self.word.len() <= self.width => " ",
            _ => {
                self.lines.push(String::with_capacity(self.width));
                JOB_LINE
            }
        };
        if let Some(line) = self.lines.last_mut() {
            line.push_str(lead);
            line.push_str(&self.word);
        }
    }
}

/// A value in a word: without spaces or anything that could end a comment.
fn push_value(word: &mut String, value: &Value, capitals: bool) {
    match value {
        Value::Map(_) => word.push_str("{}"),
        Value::List(items) => {
            word.push('[');
            for (i, item) in items.iter().enumerate() {
                word.push_str(if i > 0 { "," } else { "" });
                push_value(word, item, capitals);
            }
            word.push(']');
        }
        Value::Null | Value::Other(_) => word.push_str("null"),
        Value::Flag(on) => word.push_str(if *on { "true" } else { "false" }),
        // In full, so that it reads back as the same number; never −0.
        Value::Number(x) => push_in_full(word, x + 0.0),
        Value::Text(text) => {
            for c in text.chars().filter(|c| *c != ' ') {
                match c {
                    ',' => word.push('.'),
                    'a'..='z' if capitals => {
                        word.push('+');
                        word.push(c.to_ascii_uppercase());
                    }
                    '@' | '?' => word.push(c),
                    c => word.push(comment_char(c)),
                }
            }
        }
    }
}

/// Contents of a program's header.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeaderLines<'t> {
    /// The version that wrote it.
    pub version: Option<&'t str>,
    /// The name of the job.
    pub name: Option<&'t str>,
    /// Paths and values of the job.
    pub values: Vec<(&'t str, &'t str)>,
    /// Whether the lines below are those that the header was written for; `None` without a hash.
    pub unchanged: Option<bool>,
}

/// Largest number of words that are read from a header.
const MOST_WORDS: usize = 20_000;

/// Reads the comments of a program, whatever control it is for.
pub fn read(text: &str) -> HeaderLines<'_> {
    let mut said = HeaderLines::default();
    let mut rest = text;
    while !rest.is_empty() {
        let line = next_line(&mut rest);
        let Some(comment) = comment(line) else {
            continue;
        };
        if let Some(words) = strip_prefix_nocase(comment, JOB_LINE) {
            if said.values.len() > MOST_WORDS {
                continue;
            }
            // Version 0.1.0 wrote each value on its own line: `job path = value`.
            match words.split_once(" = ") {
                Some((path, value)) => said.values.push((path.trim(), value.trim())),
                None => said
                    .values
                    .extend(words.split(' ').filter_map(|word| word.split_once('='))),
            }
        } else if let Some(made) = strip_prefix_nocase(comment, MADE_BY) {
            said.version = said.version.or(made.split(' ').next());
        } else if let Some(name) = strip_prefix_nocase(comment, "Job:") {
            said.name = said.name.or(Some(name.trim_start()));
        } else if let Some(stated) =
            strip_prefix_nocase(comment, HASH).filter(|_| said.unchanged.is_none())
        {
            said.unchanged = Some(stated.trim().eq_ignore_ascii_case(&hash(rest)));
            // The header ends here.
            return said;
        }
    }
    said
}

/// The comment on a line, without its sign: `(…)`, `; …`, or `12 ; …` as Klartext numbers it.
pub fn comment(line: &str) -> Option<&str> {
    let line = without_count(line.trim());
    if let Some(inner) = line.strip_prefix('(') {
        return inner.strip_suffix(')');
    }
    Some(line.strip_prefix(';')?.trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_does_not_see_line_ends_and_sees_every_digit() {
        assert_eq!(hash("G1 X1\n"), hash("G1 X1  \r\n\r\n"));
        assert_ne!(hash("G1 X1\n"), hash("G1 X2\n"));
        assert_ne!(hash("G1 X1\nM2\n"), hash("M2\nG1 X1\n"));
        // Plain texts are hashed as a whole, others line by line: with the same result.
        for other in [
            "G1 X1\nM2",
            "G1 X1\n\r\rM2\n\r\r",
            "\nG1 X1\nM2\n",
            "G1 X1\r\nM2\n",
            "G1 X1 \nM2\n\n",
            "G1 X1\t\n \nM2\n",
            "G1 X1\nM2\u{2003}\n",
        ] {
            assert!(!is_plain(other), "{other:?}");
            assert_eq!(hash(other), hash("G1 X1\nM2\n"), "{other:?}");
        }
        assert!(is_plain("G1 X1\nM2\n") && !is_plain("é\n") && !is_plain(""));
        // XXH64 of an empty text with seed 0, as its specification prints it.
        assert_eq!(hash(""), "EF46DB3751D8E999");
    }

    #[test]
    fn comments_of_every_control() {
        assert_eq!(comment("(job a=1)\r"), Some("job a=1"));
        assert_eq!(comment("; job a=1"), Some("job a=1"));
        assert_eq!(comment("12 ; job a=1"), Some("job a=1"));
        assert_eq!(comment("G1 X1"), None);
    }
}
