//! Inserts the program of a job into another program: after the tool change of the probe, or after a line. The rest of the text keeps its bytes. The result is read
//! back: the inserted lines must be the job's program, and must make the same touches in the other program.

mod places;
mod state;

use serde::Serialize;

use self::places::{places, proposed};
use self::state::{State, check_below};
use crate::control::inside::{self, Put, not_read_back};
use crate::control::iso::block::{Block, variables};
use crate::control::iso::codes::Family;
use crate::control::iso::lex::{
    code, lines_of, next_line, strip_prefix_nocase, trimmed, without_number,
};
use crate::control::shop::place::{FOOT, FRAME, HEAD, PATH, Place};
use crate::control::{self, PostDef, header};
use crate::form::{Checker, Finding, Level, Value};
use crate::import::toolpath::{
    DIALECTS, KINDS, LONGEST_PROGRAM, Toolpath, control_kind, guess, read_program, too_long,
};
use crate::import::{Imported, fits, import_with, length};
use crate::job::{self, JobError};
use crate::text::{Text, text};

pub use self::places::ToolPlace;

/// A program with the program of a job in it.
#[derive(Clone, Debug, Serialize)]
pub struct Insertion {
    /// The whole text.
    pub text: String,
    /// The 0-based line of the given text after which the program is inserted.
    pub line: usize,
    /// The 0-based line of the first inserted line in the whole text.
    pub first: usize,
    /// Number of inserted lines, without the declarations at the start of a SINUMERIK program.
    pub count: usize,
    /// Tool changes of the given text, in order.
    pub places: Vec<ToolPlace>,
    /// Warnings and notes.
    pub findings: Vec<Finding>,
}

/// Longest list of variables in a message.
const MOST_LISTED: usize = 8;

/// Inserts the program of a job after the 0-based line of another program. Without a line it goes after the tool change of the probe: that of the job's
/// `control.tool`, or else of the only tool that is called a probe. An earlier inserted program of the same name is replaced.
pub fn insert(job: &Value, other: &str, line: Option<usize>) -> Result<Insertion, JobError> {
    if !fits(other, LONGEST_PROGRAM) {
        return Err(too_long(length(other)));
    }
    let plan = job::plan(job)?;
    if let Some(place) = own_lines(job) {
        let message = text!(
            "Lines at {place} cannot be inserted into another program. Remove them to insert the job",
            place
        );
        return Err(refusal("not-inserted", message));
    }
    let program = plan.program.text.as_str();
    let refuse = |message: Text| refusal("not-inserted", message);
    // Every program is for a control of the list.
    let unknown = || JobError {
        findings: Vec::new(),
    };
    let post = control::find(plan.program.post).ok_or_else(unknown)?;
    let given = lines_with_ends(other);
    let (kept, before) = without(&given, program);
    let lines: Vec<&str> = kept.iter().map(|line| given[*line]).collect();
    let numbered: Vec<(usize, &str)> = kept.iter().copied().zip(lines.iter().copied()).collect();
    let rest = lines.concat();
    let family = family_of(post, &rest).map_err(refuse)?;
    let mut found = places(&lines, family);
    let own_place = before.or_else(|| proposed(&found, tool_of(job)));
    let wanted = place(line, own_place, given.len(), &kept)?;
    let Put {
        declarations,
        lines: own,
    } = inside::put(post, program, &rest).map_err(refuse)?;
    let (above, below) = numbered.split_at(wanted + 1);
    let blocks: Vec<(usize, &str)> = own.iter().map(String::as_str).enumerate().collect();
    let [before, after] = [above, &blocks].map(|lines| State::after(lines, family));
    let restores = own.iter().any(|line| line == "M72");
    before.check(&after, restores).map_err(refuse)?;
    check_below(below, family).map_err(refuse)?;
    let first = wanted + 1 + declarations.len();
    let [prefix, tail] = composed(&lines, wanted, &declarations, &own);
    check_lines(post, &prefix, first).map_err(refuse)?;
    check_moves(post, program, &setting(above, family), &own).map_err(refuse)?;
    let mut checker = Checker::default();
    if !restores {
        note_modes(&own, &mut checker);
        note_offset(post, [before.offset, after.offset], &mut checker);
    }
    note_variables(program, &lines, &mut checker);
    found
        .iter_mut()
        .for_each(|place| place.line = kept[place.line]);
    Ok(Insertion {
        text: prefix + &tail,
        line: kept[wanted],
        first,
        count: own.len(),
        places: found,
        findings: checker.findings(),
    })
}

fn refusal(code: &str, message: Text) -> JobError {
    JobError {
        findings: vec![Finding::new(Level::Error, code, "", message)],
    }
}

/// The index among the kept lines of the line after which a program is inserted: the given one, or else the own one.
fn place(
    line: Option<usize>,
    own: Option<usize>,
    count: usize,
    kept: &[usize],
) -> Result<usize, JobError> {
    if let Some(line) = line.filter(|line| *line >= count) {
        let message = text!(
            "There is no line {line}: the program has {count}",
            line.saturating_add(1),
            count
        );
        return Err(refusal("no-place", message));
    }
    // A line inside an earlier inserted program means the line above that program.
    let left = |line: usize| kept.iter().rposition(|own| *own <= line);
    line.map_or(own, left).ok_or_else(|| {
        let message = text!("No tool change of a probe is found, or several are: choose the line");
        refusal("no-place", message)
    })
}

/// The whole text up to the end of the inserted lines, and the rest of it.
fn composed(lines: &[&str], place: usize, declarations: &[String], own: &[String]) -> [String; 2] {
    let windows = lines.iter().any(|line| line.ends_with("\r\n"));
    let end = if windows { "\r\n" } else { "\n" };
    let ended = |own: &[String]| -> String { own.iter().flat_map(|line| [line, end]).collect() };
    let mut inserted = ended(own);
    if !lines[place].ends_with(['\n', '\r']) {
        inserted = format!("{end}{}", inserted.trim_end_matches(['\r', '\n']));
    }
    let head = declaration_line(&lines[..=place]);
    let above = [
        lines[..head].concat(),
        ended(declarations),
        lines[head..=place].concat(),
        inserted,
    ];
    [above.concat(), lines[place + 1..].concat()]
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

/// The lines without an earlier program of the same name, and among them the index of the line above it.
fn without(lines: &[&str], program: &str) -> (Vec<usize>, Option<usize>) {
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
        let mut kept: Vec<usize> = (0..range.start)
            .filter(|line| !inside::declares(&said, set, lines[*line]))
            .collect();
        let at = kept.len().checked_sub(1);
        kept.extend(range.end..lines.len());
        return (kept, at);
    }
    ((0..lines.len()).collect(), None)
}

/// The family of a control; refuses a program in the language of another one.
fn family_of(post: &PostDef, other: &str) -> Result<Family, Text> {
    let own = control_kind::dialect_of(post.key);
    if own.is_some_and(|own| own != guess::guessed(other)) {
        return Err(text!(
            "Your program is in another language than that of {control}",
            post.title
        ));
    }
    Ok(if own == Some(DIALECTS[1]) {
        Family::Sinumerik
    } else {
        Family::Iso
    })
}

/// The path of the shop's lines that may change the tool, its length or the work offset of the other program.
fn own_lines(job: &Value) -> Option<String> {
    let frame = job.get("machine")?.get(FRAME)?;
    let used = |place: &&Place| matches!(frame.get(place.key), Some(Value::List(lines)) if !lines.is_empty());
    let place = [&HEAD, &FOOT].into_iter().find(used)?;
    Some(format!("{PATH}{}", place.key))
}

fn tool_of(job: &Value) -> Option<String> {
    match job.get("control")?.get("tool")? {
        Value::Number(number) => Some(crate::num::decimal(*number, 0)),
        _ => None,
    }
}

/// Number of the lines that come before the first block of a SINUMERIK program: its name, comments, `PROC`, declarations. In an archive the last program counts.
fn declaration_line(lines: &[&str]) -> usize {
    let head = ["%", ";", "PROC", "EXTERN", "DEF "];
    let code = |line: &str| without_number(trimmed(line.trim_end_matches(['\r', '\n']))).to_owned();
    let is_head = |line: &&str| {
        let line = code(line);
        line.is_empty()
            || head
                .iter()
                .any(|word| strip_prefix_nocase(&line, word).is_some())
    };
    let begin = lines
        .iter()
        .rposition(|line| line.starts_with("%_N_"))
        .unwrap_or(0);
    let own = &lines[begin..];
    let first = own.iter().position(|line| !is_head(line));
    let last = own[..first.unwrap_or(own.len())]
        .iter()
        .rposition(|line| !code(line).is_empty());
    begin + last.map_or(0, |last| last + 1)
}

/// Reads the inserted lines back: they must be the job's program. `prefix` is the whole text up to their end.
fn check_lines(post: &PostDef, prefix: &str, first: usize) -> Result<(), Text> {
    let declares = |line: &&str| inside::is_declaration(post, line);
    let declarations: Vec<&str> = lines_of(prefix).filter(declares).collect();
    let own: Vec<&str> = lines_of(prefix).skip(first).collect();
    let region = [declarations, own].concat().join("\n") + "\n";
    match import_with(&region, None) {
        Ok(Imported::Job { findings, .. })
            if findings.iter().all(|finding| finding.level == Level::Info) =>
        {
            Ok(())
        }
        _ => Err(not_read_back()),
    }
}

/// The lines above a place that set its state: without plain moves, of which a reader keeps only so many, and without other inserted programs, at whose exits a
/// reader without jumps would stop.
fn setting<'t>(above: &[(usize, &'t str)], family: Family) -> Vec<&'t str> {
    let lines: Vec<&str> = above.iter().map(|(_, line)| *line).collect();
    let others = inside::ranges(&lines.concat());
    let is_other = |index: usize| others.iter().any(|(range, _)| range.contains(&index));
    let own = lines
        .iter()
        .enumerate()
        .filter(|(index, line)| !is_other(*index) && !Block::of(line, family).only_moves());
    own.map(|(_, line)| *line).collect()
}

/// Reads the inserted lines in the state of the place: they must make the touches of the job's program.
fn check_moves(post: &PostDef, program: &str, above: &[&str], own: &[String]) -> Result<(), Text> {
    let dialect = control_kind::dialect_of(post.key);
    let text = format!("{}\n{}\n", above.concat(), own.join("\n"));
    let [alone, whole] = [program, &text].map(|text| read_program(text, dialect));
    if let Some((own, other)) = alone.metric.zip(whole.metric)
        && own != other
    {
        return Err(text!(
            "Your program is in {other}, and the job in {own}",
            if other { "mm" } else { "inch" },
            if own { "mm" } else { "inch" }
        ));
    }
    let probing = |path: &Toolpath, first: usize| -> Vec<[f64; 3]> {
        let is_own =
            |k: &usize| KINDS[path.kind[*k] as usize] == "probe" && path.line[*k] as usize >= first;
        let moves = (0..path.kind.len()).filter(is_own);
        moves.map(|k| path.end(k).to_array()).collect()
    };
    let [planned, read] = [probing(&alone, 0), probing(&whole, above.len())];
    // Positions that are unknown in one of them cannot differ.
    let apart = |(a, b): (&f64, &f64)| (a - b).abs() > 1e-6;
    let differs = planned
        .iter()
        .flatten()
        .zip(read.iter().flatten())
        .any(apart);
    if differs || planned.len() != read.len() {
        return Err(not_read_back());
    }
    Ok(())
}

/// Notes the modes that are active after the inserted lines.
fn note_modes(own: &[String], checker: &mut Checker) {
    let is_word = |word: &str| {
        word.strip_prefix(['G', 'M'])
            .is_some_and(|number| crate::num::read(number).is_some())
    };
    let mut modes: Vec<&str> = Vec::new();
    for word in own
        .iter()
        .filter(|line| line.split(' ').all(is_word))
        .flat_map(|line| line.split(' '))
    {
        if !["M0", "M2", "M30", "G53"].contains(&word) && !modes.contains(&word) {
            modes.push(word);
        }
    }
    if !modes.is_empty() {
        let message = text!("Active after the inserted lines: {modes}", modes.join(" "));
        checker.info("modes-set", "", message);
    }
}

/// Warns of another work offset than the one before the inserted lines.
fn note_offset(post: &PostDef, offsets: [Option<i32>; 2], checker: &mut Checker) {
    if let [Some(before), Some(after)] = offsets
        && before != after
    {
        let message = text!(
            "{after} is active after the inserted lines, and {before} before them",
            (post.work_offset_word)(after),
            (post.work_offset_word)(before)
        );
        checker.warning("modes-set", "", message);
    }
}

/// Warns of variables that the program sets and the other one uses.
fn note_variables(program: &str, other: &[&str], checker: &mut Checker) {
    let set: Vec<String> = lines_of(program)
        .filter(|line| line.contains('='))
        .filter_map(|line| {
            variables(&code(line, true).to_ascii_uppercase())
                .into_iter()
                .next()
        })
        .collect();
    let mut shared: Vec<String> = Vec::new();
    for line in other.iter().filter(|line| line.contains(['#', 'R', 'r'])) {
        for name in variables(&code(line, true).to_ascii_uppercase()) {
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
