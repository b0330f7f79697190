//! Inserts a program into another one, and restores it. The inserted lines are its blocks between two comments, without tape marks, program number and end.
//!
//! That a declaration (`DEF`) must come before every other block of a SINUMERIK program, and that a Fanuc finds a label anywhere in a program, is recalled [R].

use std::ops::Range;

use crate::control::header::{self, HASH, HeaderLines, NO_HASH};
use crate::control::iso::lex::{lines_of, program_number, strip_prefix_nocase};
use crate::control::number::NOT_CHOSEN;
use crate::control::{PostDef, find};
use crate::num::push_count;
use crate::text::{Text, text};

/// First and last comment of an inserted program. The first one also names the set of its labels, unless it is the first set.
pub const BEGINS: &str = "Touchpath begins";
const LABEL_SET: &str = ", label set ";
pub const ENDS: &str = "Touchpath ends";

/// How a control's program is inserted into another one.
#[derive(Clone, Copy, Debug)]
pub struct Inside {
    /// Last block of a program.
    pub end: &'static str,
    /// Block that replaces the end and jumps over the exits below it, and the label after them. `None` if nothing follows the end.
    pub jump: Option<(&'static str, &'static str)>,
    /// Beginning of a declaration, which goes to the start of the other program. Empty without declarations.
    pub declares: &'static str,
    pub labels: Labels,
}

/// Labels of a program, which are unique in the whole of the other one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Labels {
    None,
    /// `o12 if` and `o<tp_exit> call` of LinuxCNC.
    OWords,
    /// `N9001` and `GOTO 9001`.
    Numbers,
    /// `TP_STOP:`, and the variable `TP_MOVE`.
    Names,
}

/// A control whose programs have no exits below their end, no labels and no declarations.
pub const PLAIN: Inside = Inside {
    end: "M30",
    jump: None,
    declares: "",
    labels: Labels::None,
};

/// Controls with numbered labels, and exits below the end.
pub const NUMBERED: Inside = Inside {
    jump: Some(("GOTO 9000", "N9000")),
    labels: Labels::Numbers,
    ..PLAIN
};

/// Number of label sets, and the distance between the numbers of two sets.
const MOST: usize = 100;
const APART: usize = 100;

/// The lines to insert into another program.
#[derive(Clone, Debug)]
pub struct Put {
    /// Lines for the start of the other program.
    pub declarations: Vec<String>,
    pub lines: Vec<String>,
}

/// The lines of a program to insert into another one, with labels that the other one does not have. The header's hash is over these lines.
pub fn put(post: &PostDef, program: &str, other: &str) -> Result<Put, Text> {
    let Some(inside) = post.inside else {
        return Err(text!(
            "{control} numbers every block, and inserted lines would change the numbers after them. Save the program separately and call it",
            post.title
        ));
    };
    let about_number = comment(post, NOT_CHOSEN);
    let own = |line: &&str| {
        let is_number = program_number(line.as_bytes()).is_some() || *line == about_number;
        !line.is_empty() && *line != "%" && !is_number
    };
    let lines: Vec<&str> = lines_of(program).filter(own).collect();
    let set = free_set(&inside, &lines, other)?;
    let lines = lines
        .into_iter()
        .map(|line| relabelled(inside.labels, line, set as isize));
    let (declarations, mut lines): (Vec<String>, Vec<String>) =
        lines.partition(|line| is_declaration(post, line));
    // Without exits below it the end is the last block: LinuxCNC's subprograms, above the first move, have one as well.
    let ends = |line: &String| line == inside.end;
    let end = match inside.jump {
        Some(_) => lines.iter().position(ends),
        None => lines.iter().rposition(ends),
    };
    match (end, inside.jump) {
        (Some(end), _) if end + 1 == lines.len() => {
            lines.pop();
        }
        (Some(end), Some((jump, label))) => {
            lines[end] = relabelled(inside.labels, jump, set as isize);
            lines.push(relabelled(inside.labels, label, set as isize));
        }
        _ => return Err(not_read_back()),
    }
    let begins = match set {
        0 => comment(post, BEGINS),
        _ => comment(post, &format!("{BEGINS}{LABEL_SET}{}", set + 1)),
    };
    let mut sealed = format!("{begins}\n{}\n", unsealed(&lines.join("\n")));
    header::seal(&mut sealed);
    let mut lines: Vec<String> = lines_of(&sealed).map(str::to_owned).collect();
    lines.push(comment(post, ENDS));
    Ok(Put {
        declarations,
        lines,
    })
}

/// The first set of labels that the other program does not have.
fn free_set(inside: &Inside, lines: &[&str], other: &str) -> Result<usize, Text> {
    let jump = inside.jump.map_or("", |(jump, _)| jump);
    let labels: Vec<Label> = lines
        .iter()
        .copied()
        .chain([jump])
        .flat_map(|line| labels_in(inside.labels, line))
        .collect();
    let mut taken = [false; MOST];
    for other in lines_of(other).flat_map(|line| labels_in(inside.labels, line)) {
        for own in &labels {
            if let Some(set) = own.sets_to(&other).filter(|set| *set < MOST) {
                taken[set] = true;
            }
        }
    }
    taken.iter().position(|taken| !taken).ok_or_else(|| {
        text!(
            "No labels are free: your program uses all {count} sets of them",
            MOST
        )
    })
}

/// Refusal of lines that are not the job's program.
pub fn not_read_back() -> Text {
    text!("Read back, the inserted lines are not the job's program")
}

/// The programs inserted into a text: their lines, from the first to the last comment, and the set of their labels.
pub fn ranges(text: &str) -> Vec<(Range<usize>, usize)> {
    let mut found = Vec::new();
    // Most texts have none.
    if ![BEGINS, &BEGINS.to_ascii_uppercase()]
        .iter()
        .any(|words| text.contains(words))
    {
        return found;
    }
    let mut begun = None;
    for (index, line) in lines_of(text).enumerate() {
        let Some(comment) = header::comment(line) else {
            continue;
        };
        if let Some(set) = strip_prefix_nocase(comment, BEGINS) {
            let set = match strip_prefix_nocase(set, LABEL_SET) {
                None => set.is_empty().then_some(0),
                Some(set) => set
                    .trim()
                    .parse()
                    .ok()
                    .and_then(|set: usize| set.checked_sub(1)),
            };
            begun = set.filter(|set| *set < MOST).map(|set| (index, set));
        } else if comment.eq_ignore_ascii_case(ENDS)
            && let Some((first, set)) = begun.take()
        {
            found.push((first..index + 1, set));
        }
    }
    found
}

/// Whether a line is a declaration of this control.
pub fn is_declaration(post: &PostDef, line: &str) -> bool {
    post.inside
        .is_some_and(|inside| !inside.declares.is_empty() && line.starts_with(inside.declares))
}

/// Whether a line declares the variables of an inserted program with this set of labels.
pub fn declares(program: &str, set: usize, line: &str) -> bool {
    post_of(&header::read(program)).is_some_and(|post| {
        is_declaration(post, line)
            && post
                .inside
                .is_some_and(|inside| is_of_set(inside.labels, line, set))
    })
}

/// The control in a header.
fn post_of(said: &HeaderLines<'_>) -> Option<&'static PostDef> {
    let is_post = |(path, _): &&(&str, &str)| path.eq_ignore_ascii_case("control.post");
    let (_, key) = said.values.iter().find(is_post)?;
    find(&key.to_ascii_lowercase())
}

/// The first program that was inserted into a text, restored; `None` without one. Its header's hash is right if the inserted lines are unchanged.
pub fn alone(text: &str) -> Option<String> {
    let (range, set) = ranges(text).into_iter().next()?;
    let all: Vec<&str> = lines_of(text).collect();
    let own = &all[range.start + 1..range.end - 1];
    let body = own.join("\n") + "\n";
    let said = header::read(&body);
    let post = post_of(&said)?;
    let inside = post.inside?;
    let declared = |line: &&&str| is_declaration(post, line) && is_of_set(inside.labels, line, set);
    let above = all[..range.start].iter().filter(declared);
    let head = 1 + own.iter().position(|line| hash_of(line).is_some())?;
    let lines = own[..head].iter().chain(above).chain(&own[head..]);
    let mut lines: Vec<String> = lines
        .map(|line| relabelled(inside.labels, line, -(set as isize)))
        .collect();
    // Blank lines keep the numbers of the lines.
    let blanks = (range.start + 1 + own.len()).saturating_sub(lines.len());
    let jump = inside.jump.and_then(|(jump, label)| {
        let at = lines.iter().position(|line| line == jump)?;
        (lines.last()? == label).then_some(at)
    });
    match jump {
        Some(at) => {
            lines.pop();
            lines[at] = inside.end.to_owned();
        }
        None => lines.push(inside.end.to_owned()),
    }
    let mut text = "\n".repeat(blanks) + &lines.join("\n") + "\n";
    if said.unchanged == Some(true) {
        text = unsealed(&text);
        header::seal(&mut text);
    }
    Some(text)
}

fn comment(post: &PostDef, words: &str) -> String {
    let (open, close) = post.dialect.comment;
    let words = if post.dialect.capitals {
        words.to_ascii_uppercase()
    } else {
        words.to_owned()
    };
    format!("{open}{words}{close}")
}

/// The place of the hash in a line.
fn hash_of(line: &str) -> Option<Range<usize>> {
    let hash = strip_prefix_nocase(header::comment(line)?, HASH)?;
    let begin = line.find(hash)?;
    (hash.len() == NO_HASH.len()).then(|| begin..begin + NO_HASH.len())
}

/// A text with the placeholder in place of its hash.
fn unsealed(text: &str) -> String {
    let mut at = 0;
    let mut hash = lines_of(text).filter_map(|line| {
        let begin = at;
        at += line.len() + 1;
        hash_of(line).map(|hash| begin + hash.start..begin + hash.end)
    });
    let place = hash.next();
    let mut text = text.to_owned();
    if let Some(place) = place {
        text.replace_range(place, NO_HASH);
    }
    text
}

/// The number of a label in a line. In `TP_STOP` and `o<tp_exit>` it is the number of the set, and 0 is not written.
struct Label {
    place: Range<usize>,
    is_name: bool,
    number: usize,
}

impl Label {
    /// The distance between the numbers of two sets.
    fn apart(&self) -> usize {
        if self.is_name { 1 } else { APART }
    }

    /// How many sets higher the other label is, if it is this one in another set.
    fn sets_to(&self, other: &Label) -> Option<usize> {
        let far = other.number.checked_sub(self.number)?;
        (self.is_name == other.is_name && far.is_multiple_of(self.apart()))
            .then(|| far / self.apart())
    }
}

/// The position after these characters.
fn skip(text: &str, at: usize, what: &[char]) -> usize {
    text.len() - text[at..].trim_start_matches(what).len()
}

/// The digits from a position on.
fn digits(text: &str, from: usize) -> Range<usize> {
    let count = text[from..].bytes().take_while(u8::is_ascii_digit).count();
    from..from + count
}

/// The position after the O of an O word, which may follow a block number.
fn after_o(capitals: &str, begin: usize) -> Option<usize> {
    let begin = match capitals[begin..].strip_prefix('N') {
        Some(_) => {
            let number = digits(capitals, skip(capitals, begin + 1, &[' ']));
            skip(capitals, number.end, &[' ', '\t'])
        }
        None => begin,
    };
    capitals[begin..]
        .starts_with('O')
        .then(|| skip(capitals, begin + 1, &[' ']))
}

/// The labels in a line, and the jumps to them. Capitals and small letters are the same.
fn labels_in(labels: Labels, line: &str) -> Vec<Label> {
    let capitals = line.to_ascii_uppercase();
    // `/N10 O1 IF`
    let begin = skip(&capitals, 0, &[' ', '\t', '/']);
    let numbered = |from: usize| {
        let place = digits(&capitals, skip(&capitals, from, &[' ']));
        let number = capitals[place.clone()].parse().ok()?;
        Some(Label {
            place,
            is_name: false,
            number,
        })
    };
    // `TP_`, or `TP2_` in another set.
    let named = |from: usize| {
        let place = digits(&capitals, from);
        let written = capitals[place.clone()].parse().unwrap_or(1_usize);
        capitals[place.end..].starts_with('_').then_some(Label {
            place,
            is_name: true,
            number: written.saturating_sub(1),
        })
    };
    match labels {
        Labels::None => Vec::new(),
        _ if capitals[begin..].starts_with(['(', ';']) => Vec::new(),
        Labels::OWords => after_o(&capitals, begin)
            .and_then(|at| match capitals[at..].strip_prefix("<TP") {
                Some(_) => named(at + "<TP".len()),
                None => numbered(at),
            })
            .into_iter()
            .collect(),
        Labels::Numbers => {
            let own = capitals[begin..].starts_with('N').then_some(begin + 1);
            let jumps = capitals
                .match_indices("GOTO")
                .map(|(at, word)| at + word.len());
            own.into_iter().chain(jumps).filter_map(numbered).collect()
        }
        Labels::Names => {
            let part = |c: char| c.is_ascii_alphanumeric() || c == '_';
            capitals
                .match_indices("TP")
                .filter(|(at, _)| !capitals[..*at].ends_with(part))
                .filter_map(|(at, word)| named(at + word.len()))
                .collect()
        }
    }
}

/// Whether a line has a name of this set.
fn is_of_set(labels: Labels, line: &str, set: usize) -> bool {
    labels_in(labels, line)
        .iter()
        .any(|label| label.is_name && label.number == set)
}

/// A line whose labels are moved by this many sets.
fn relabelled(labels: Labels, line: &str, sets: isize) -> String {
    let mut out = String::with_capacity(line.len());
    let mut from = 0;
    for label in labels_in(labels, line) {
        out.push_str(&line[from..label.place.start]);
        from = label.place.end;
        let far = sets * label.apart() as isize;
        match label.number.saturating_add_signed(far) {
            0 if label.is_name => {}
            number => push_count(&mut out, number + usize::from(label.is_name)),
        }
    }
    out.push_str(&line[from..]);
    out
}
