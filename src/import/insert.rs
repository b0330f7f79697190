//! Puts the program of a job into another program: behind the tool change of the probe, or behind a line. The rest of the text keeps its bytes. Both are read
//! back: the inserted lines must be the job's program, and its moves in the other program must be those of the program alone.

use std::ops::Range;

use serde::Serialize;

use crate::control::inside::{self, Put};
use crate::control::iso::lex::{
    comment_at, lines_of, next_line, strip_prefix_nocase, trimmed, without_number,
};
use crate::control::{self, PostDef, header};
use crate::form::{Checker, Finding, Level, Value};
use crate::import::toolpath::{
    KINDS, LONGEST_PROGRAM, Toolpath, control_kind, guess, read_program, too_long,
};
use crate::import::{Imported, fits, import_with, length};
use crate::job::{self, JobError};
use crate::text::{Text, text};

/// A program with the program of a job in it.
#[derive(Clone, Debug, Serialize)]
pub struct Insertion {
    /// The whole text.
    pub text: String,
    /// The 0-based line of the first inserted line.
    pub first: usize,
    /// Number of inserted lines, without the declarations at the start of a SINUMERIK program.
    pub count: usize,
    /// Tool changes of the other program, in order.
    pub places: Vec<ToolPlace>,
    /// Warnings and notes.
    pub findings: Vec<Finding>,
}

/// A place in a program: behind a tool change and the activation of the tool's length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToolPlace {
    /// The 0-based line behind which a program can be put.
    pub line: usize,
    /// The tool as the program names it: `24`, `PROBE`; null if it does not.
    pub tool: Option<String>,
    /// Whether a name or a comment says that the tool is a probe.
    pub probe: bool,
}

/// Longest list of variables in a message.
const MOST_LISTED: usize = 8;

/// Puts the program of a job behind the 0-based line of another program. Without a line it goes behind the tool change of the probe: the job's
/// `control.tool`, or else the first tool that is called a probe. A program of the same name that was put there before is replaced.
pub fn insert(job: &Value, other: &str, line: Option<usize>) -> Result<Insertion, JobError> {
    if !fits(other, LONGEST_PROGRAM) {
        return Err(too_long(length(other)));
    }
    let program = job::plan(job)?.program;
    let refuse = |message: Text| refusal("not-inserted", message);
    // Every program is for a control of the list.
    let Some(post) = control::find(program.post) else {
        return Err(JobError {
            findings: Vec::new(),
        });
    };
    let (mut lines, before) = without(&lines_with_ends(other), &program.text);
    let rest = lines.concat();
    let mut checker = Checker::default();
    check_language(post, &rest).map_err(refuse)?;
    let places = places(&lines);
    let wanted = line.or(before).or_else(|| proposed(&places, tool_of(job)));
    let Some(wanted) = wanted else {
        let message = text!("No tool change of a probe is found: choose the line");
        return Err(refusal("no-place", message));
    };
    if wanted >= lines.len() {
        let message = text!(
            "There is no line {line}: the program has {count}",
            wanted + 1,
            lines.len()
        );
        return Err(refusal("no-place", message));
    }
    let Put {
        declarations,
        lines: own,
    } = inside::put(post, &program.text, &rest).map_err(refuse)?;
    let end = if rest.contains("\r\n") { "\r\n" } else { "\n" };
    let ended = |own: &[String]| {
        own.iter()
            .map(|line| format!("{line}{end}"))
            .collect::<String>()
    };
    let closed = |line: &str| line.ends_with(['\n', '\r']);
    let mut inserted = ended(&own);
    if !closed(lines[wanted]) {
        inserted = format!("{end}{}", inserted.trim_end_matches(['\r', '\n']));
    }
    let declared = ended(&declarations);
    let head = declaration_line(&lines).min(wanted + 1);
    lines.insert(wanted + 1, &inserted);
    lines.insert(head, &declared);
    let first = wanted + 1 + declarations.len();
    let prefix = lines[..wanted + 3].concat();
    let text = lines.concat();
    check_read_back(post, &program.text, &prefix, first..first + own.len()).map_err(refuse)?;
    note_modes(&own, &mut checker);
    note_variables(&program.text, &rest, &mut checker);
    Ok(Insertion {
        text,
        first,
        count: own.len(),
        places,
        findings: checker.findings(),
    })
}

fn refusal(code: &str, message: Text) -> JobError {
    JobError {
        findings: vec![Finding::new(Level::Error, code, "", message)],
    }
}

/// Lines with their ends.
fn lines_with_ends(text: &str) -> Vec<&str> {
    let mut rest = text;
    let mut lines = Vec::new();
    while !rest.is_empty() {
        let whole = rest;
        next_line(&mut rest);
        lines.push(&whole[..whole.len() - rest.len()]);
    }
    lines
}

/// The lines without an earlier program of the same name, and the line before it.
fn without<'t>(lines: &[&'t str], program: &str) -> (Vec<&'t str>, Option<usize>) {
    let name = header::read(program).name;
    for (range, set) in inside::ranges(&lines.concat()) {
        let said = lines[range.clone()].concat();
        let same = header::read(&said)
            .name
            .zip(name)
            .is_some_and(|(a, b)| a.eq_ignore_ascii_case(b));
        if !same {
            continue;
        }
        let declared = |line: &&&str| inside::declares(&said, set, line);
        let above: Vec<&str> = lines[..range.start]
            .iter()
            .filter(|line| !declared(line))
            .copied()
            .collect();
        let at = above.len().checked_sub(1);
        return ([&above[..], &lines[range.end..]].concat(), at);
    }
    (lines.to_vec(), None)
}

/// Refuses a program in the language or in the units of another control.
fn check_language(post: &PostDef, other: &str) -> Result<(), Text> {
    let own = control_kind::dialect_of(post.key);
    let dialect = guess::guessed(other);
    if own.is_some_and(|own| own != dialect) {
        return Err(text!(
            "Your program is in another language than that of {control}",
            post.title
        ));
    }
    Ok(())
}

fn tool_of(job: &Value) -> Option<String> {
    match job.get("control")?.get("tool")? {
        Value::Number(number) => Some(crate::num::decimal(*number, 0)),
        _ => None,
    }
}

/// The place behind the tool of the job, or else behind the first probe.
fn proposed(places: &[ToolPlace], tool: Option<String>) -> Option<usize> {
    let own = |place: &&ToolPlace| tool.is_some() && place.tool == tool;
    let probe = |place: &&ToolPlace| place.probe;
    let found = places
        .iter()
        .find(own)
        .or_else(|| places.iter().find(probe));
    found.map(|place| place.line)
}

/// A line's blocks in capitals, and its comments.
fn parted(line: &str) -> (String, &str) {
    let line = without_number(trimmed(line.trim_end_matches(['\r', '\n'])));
    let quoted = line.contains('"') && line.to_ascii_uppercase().contains("T=\"");
    let at = if quoted {
        None
    } else {
        comment_at(line.as_bytes(), true)
    };
    let (code, comment) = line.split_at(at.unwrap_or(line.len()));
    // `(PROBE) T24 M6`
    let code = match comment
        .strip_prefix('(')
        .and_then(|inner| inner.split_once(')'))
    {
        Some((_, behind)) => format!("{code} {behind}"),
        None => code.to_owned(),
    };
    (code.to_ascii_uppercase(), comment)
}

/// The number behind a letter in a block, if the letter begins a word.
fn word(code: &str, letter: char) -> Option<&str> {
    let part = |c: char| c.is_ascii_alphabetic() || c == '_' || c == '#' || c == '<';
    code.match_indices(letter)
        .filter(|(at, _)| !code[..*at].ends_with(part))
        .find_map(|(at, _)| {
            let digits = &code[at + 1..];
            let count = digits.bytes().take_while(u8::is_ascii_digit).count();
            (count > 0).then(|| &digits[..count])
        })
}

/// Whether a block has a code such as M6, with or without leading zeros.
fn has_code(code: &str, letter: char, number: u32) -> bool {
    code.match_indices(letter).any(|(at, _)| {
        let digits = &code[at + 1..];
        let count = digits.bytes().take_while(u8::is_ascii_digit).count();
        digits[..count].parse() == Ok(number) && !digits[count..].starts_with('.')
    })
}

/// Words for a probe in names and comments.
const PROBES: [&str; 10] = [
    "PROBE", "TASTER", "TASTKOPF", "RENISHAW", "OMP4", "OMP6", "ЩУП", "щуп", "测头", "測頭",
];

fn says_probe(text: &str) -> bool {
    let text = text.to_ascii_uppercase();
    PROBES.iter().any(|word| text.contains(word))
}

/// The tool changes of a program: M6, or a T with a name. The place is behind the block that activates the tool's length (G43, G44, G56, D), if it comes before
/// the next tool change.
fn places(lines: &[&str]) -> Vec<ToolPlace> {
    let mut places: Vec<ToolPlace> = Vec::new();
    let mut tool: Option<String> = None;
    let mut said = false;
    let mut length = true;
    let mut open = false;
    for (index, line) in lines.iter().enumerate() {
        let (code, comment) = parted(line);
        let name = code
            .split_once("T=\"")
            .and_then(|(_, name)| name.split_once('"'));
        if let Some((name, _)) = name {
            tool = Some(name.to_owned());
        } else if let Some(number) = word(&code, 'T') {
            tool = Some(number.trim_start_matches('0').to_owned());
        }
        let blank = trimmed(&code).is_empty();
        if blank {
            // A comment around a tool change is about its tool.
            said |= says_probe(comment);
            if let Some(place) = places.last_mut().filter(|_| open) {
                place.probe |= says_probe(comment);
            }
            continue;
        }
        let changes = has_code(&code, 'M', 6) || name.is_some();
        if changes {
            let again =
                name.is_none() && places.last().is_some_and(|last| open && last.tool == tool);
            let probe = said || says_probe(comment) || tool.as_deref().is_some_and(says_probe);
            if again {
                // `T="PROBE"` and its M6.
                if let Some(last) = places.last_mut() {
                    last.line = index;
                }
            } else {
                places.push(ToolPlace {
                    line: index,
                    tool: tool.clone(),
                    probe,
                });
            }
            length = false;
            open = true;
        } else {
            open = false;
        }
        if let Some(place) = places.last_mut().filter(|_| !length) {
            let lengths = [('G', 43), ('G', 44), ('G', 56)];
            let active = lengths
                .iter()
                .any(|(letter, code_of)| has_code(&code, *letter, *code_of));
            if active || word(&code, 'D').is_some_and(|_| !code.contains('=')) {
                place.line = index;
                length = true;
            }
        }
        // A block with nothing but the T belongs to the change below it.
        said &= !changes && word(&code, 'T').is_some();
    }
    places
}

/// Number of the lines that come before the first block of a SINUMERIK program: its name, comments, `PROC`, declarations.
fn declaration_line(lines: &[&str]) -> usize {
    let head = ["%", ";", "PROC", "EXTERN", "DEF "];
    let is_head = |line: &&str| {
        let line = trimmed(line.trim_end_matches(['\r', '\n']));
        line.is_empty()
            || head
                .iter()
                .any(|word| strip_prefix_nocase(line, word).is_some())
    };
    let first = lines.iter().position(|line| !is_head(line));
    let last = lines[..first.unwrap_or(lines.len())]
        .iter()
        .rposition(|line| !line.trim().is_empty());
    last.map_or(0, |last| last + 1)
}

/// Reads the lines back: as a program of their own, and at their place. `prefix` is the text up to their end.
fn check_read_back(
    post: &PostDef,
    program: &str,
    prefix: &str,
    own: Range<usize>,
) -> Result<(), Text> {
    let declares = |line: &&str| inside::is_declaration(post, line);
    let alone: Vec<&str> = lines_of(prefix).filter(declares).collect();
    let region: Vec<&str> = lines_of(prefix).skip(own.start).collect();
    let region = [alone, region].concat().join("\n") + "\n";
    match import_with(&region, None) {
        Ok(Imported::Job { findings, .. })
            if findings.iter().all(|finding| finding.level == Level::Info) => {}
        _ => {
            return Err(text!(
                "Read back, the inserted lines are not the job's program"
            ));
        }
    }
    let dialect = control_kind::dialect_of(post.key);
    let [alone, whole] = [program, prefix].map(|text| read_program(text, dialect));
    if let Some((own, other)) = alone.metric.zip(whole.metric)
        && own != other
    {
        return Err(text!(
            "Your program is in {other}, and the job in {own}",
            if other { "mm" } else { "inch" },
            if own { "mm" } else { "inch" }
        ));
    }
    // The first moves depend on where the stylus is: from the last one backwards.
    let probing = |path: &Toolpath, lines: &Range<usize>| {
        let is_own = |k: &usize| {
            KINDS[path.kind[*k] as usize] == "probe" && lines.contains(&(path.line[*k] as usize))
        };
        (0..path.kind.len())
            .rev()
            .filter(is_own)
            .collect::<Vec<usize>>()
    };
    let [planned, read] = [probing(&alone, &(0..usize::MAX)), probing(&whole, &own)];
    let read_first = read.last().copied();
    for (k, at) in planned.into_iter().zip(read) {
        let [planned, read] =
            [(&alone, k), (&whole, at)].map(|(path, k)| &path.to[3 * k..3 * k + 3]);
        let apart = |(a, b): (&f64, &f64)| (a - b).abs() > 1e-6;
        if planned.iter().zip(read).any(apart) {
            return Err(text!(
                "In your program the move in line {line} does not go where it goes in the program alone: a shift, a rotation or a scale is active there",
                whole.line[at] as usize + 1
            ));
        }
    }
    let at = read_first.unwrap_or(0);
    let moved = whole
        .systems
        .iter()
        .take_while(|system| system[0] as usize <= at)
        .last()
        .is_some_and(|system| system[1..].iter().any(|x| x.abs() > 1e-9));
    if moved {
        return Err(text!(
            "A shift or a rotation of the coordinate system is active at line {line} of your program",
            own.start
        ));
    }
    Ok(())
}

/// Notes the modes that are active behind the inserted lines.
fn note_modes(own: &[String], checker: &mut Checker) {
    let is_word = |word: &str| {
        word.strip_prefix(['G', 'M'])
            .is_some_and(|number| crate::num::read(number).is_some())
    };
    let restores = own.iter().any(|line| line == "M72");
    let modes: Vec<&str> = own
        .iter()
        .filter(|line| line.split(' ').all(is_word) && !line.starts_with("M0"))
        .flat_map(|line| line.split(' '))
        .filter(|word| *word != "G53")
        .collect();
    let mut once: Vec<&str> = Vec::new();
    for word in modes {
        if !once.contains(&word) {
            once.push(word);
        }
    }
    if !once.is_empty() && !restores {
        let message = text!(
            "Behind the inserted lines these are active: {modes}",
            once.join(" ")
        );
        checker.info("modes-set", "", message);
    }
}

/// Warns of variables that the program sets and the other one uses.
fn note_variables(program: &str, other: &str, checker: &mut Checker) {
    let set: Vec<String> = lines_of(program)
        .filter(|line| line.contains('='))
        .filter_map(|line| variables(&parted(line).0).into_iter().next())
        .collect();
    let mut shared: Vec<String> = Vec::new();
    for line in lines_of(other).filter(|line| line.contains(['#', 'R', 'r'])) {
        for name in variables(&parted(line).0) {
            if shared.len() < MOST_LISTED && set.contains(&name) && !shared.contains(&name) {
                shared.push(name);
            }
        }
    }
    if !shared.is_empty() {
        let message = text!(
            "Your program uses variables that the inserted lines change: {names}",
            shared.join(", ")
        );
        checker.warning("variables-shared", "", message);
    }
}

/// The variables in a block: `#101`, `#<NAME>`, `R5`.
fn variables(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut before = ' ';
    for (at, letter) in code.char_indices() {
        let behind = &code[at + letter.len_utf8()..];
        let count = behind.bytes().take_while(u8::is_ascii_digit).count();
        let name = behind.strip_prefix('<').and_then(|name| name.find('>'));
        let begins = letter == '#' || letter == 'R' && !before.is_ascii_alphanumeric();
        match name {
            Some(end) if letter == '#' => found.push(format!("#{}", &behind[..end + 2])),
            _ if begins && count > 0 => found.push(format!("{letter}{}", &behind[..count])),
            _ => {}
        }
        before = letter;
    }
    found
}
