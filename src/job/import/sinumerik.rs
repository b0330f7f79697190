//! Reads back a SINUMERIK program that was written here: its header says the job, and its blocks are compared with those that the job
//! makes.

use crate::control::{JOB_LINE, MADE_BY};
use crate::cycle;
use crate::form::{Checker, Value};
use crate::job::import::{Imported, has_place, set};
use crate::job::mpf::{self, Program};
use crate::job::sections::FORMAT;
use crate::job::{JobError, Plan};

/// How many lines that are not understood, or not safe, are listed.
const MOST_TOLD: usize = 20;

/// How many lines of a header are read.
const MOST_LINES: usize = 2000;

/// Whether a text is a SINUMERIK program.
pub fn recognises(text: &str) -> bool {
    text.contains("MEAS=1") || text.contains("$AC_MEA") || text.contains("CYCLE977")
}

/// Whether its header says a job.
pub fn says_job(text: &str) -> bool {
    let says = |line: &str| {
        let words = line.trim_start_matches(|c: char| c == ';' || c.is_whitespace()).strip_prefix(JOB_LINE);
        words.is_some_and(|words| words.starts_with("cycle.type = ") || words.split(' ').any(|w| w.starts_with("cycle.type=")))
    };
    text.lines().filter(|line| line.starts_with(';')).any(says)
}

/// Makes a job of a program. A program that does not say its job, or is not of the language's part that is known here, is refused.
pub fn import(text: &str) -> Result<Imported, JobError> {
    let mut checker = Checker::default();
    let program = match mpf::read(text) {
        Ok(program) => program,
        Err(troubles) => {
            for trouble in troubles.iter().take(MOST_TOLD) {
                checker.error("not-understood", "", format!("Line {}: {}", trouble.line, trouble.message));
            }
            return Err(JobError { findings: checker.findings() });
        }
    };
    let Some(mut job) = told(&program, &mut checker) else {
        let message = "The program does not say which job it is: only programs that were written here can be read back";
        checker.error("nothing-to-import", "", message);
        return Err(JobError { findings: checker.findings() });
    };
    if let Some(name) = program.comments.iter().find_map(|c| c.strip_prefix("Job: ")) {
        set(&mut job, "name", Value::Text(name.to_owned()));
    }
    let version = program.comments.iter().find_map(|c| c.strip_prefix(MADE_BY)?.split(' ').next());
    if let Some(version) = version.filter(|version| *version != env!("CARGO_PKG_VERSION")) {
        let version = crate::form::printable(version);
        let message = format!(
            "Version {version} wrote this program, and {} reads it: blocks may differ where only the versions do",
            env!("CARGO_PKG_VERSION")
        );
        checker.info("other-version", "", message);
    }
    for trouble in program.troubles().into_iter().take(MOST_TOLD) {
        checker.warning("unsafe-program", "", format!("Line {}: {}", trouble.line, trouble.message));
    }
    match crate::job::plan(&job) {
        Ok(plan) => compare(&program, &plan, &mut checker),
        Err(_) => checker.warning("header-unsound", "", "The job that the header says has errors: see its findings"),
    }
    checker.info("part-not-in-program", "part", "A program does not say how the part lies: the nominal one is taken");
    Ok(Imported { job, findings: checker.findings() })
}

/// What the header says: `job path=value path=value`, or, as version 0.1.0 wrote it, `job path = value`.
fn told(program: &Program, checker: &mut Checker) -> Option<Value> {
    let mut lines: Vec<(&str, &str)> = Vec::new();
    for comment in program.comments.iter().filter_map(|c| c.strip_prefix(JOB_LINE)).take(MOST_LINES) {
        match comment.split_once(" = ") {
            Some((path, value)) => lines.push((path.trim(), value.trim())),
            None => lines.extend(comment.split(' ').filter_map(|word| word.split_once('='))),
        }
    }
    let find = |path: &str| lines.iter().find(|(p, _)| *p == path).map(|(_, v)| *v);
    let def = cycle::find(find("cycle.type")?)?;
    let format = find("format").and_then(|v| v.parse::<f64>().ok()).unwrap_or(FORMAT);
    let mut job = Value::Map(vec![("format".to_owned(), Value::Number(format))]);
    let mut unknown = 0;
    for (path, text) in lines.iter().filter(|(path, _)| *path != "format") {
        if has_place(def, path) {
            set(&mut job, path, value(text));
        } else {
            unknown += 1;
        }
    }
    if unknown > 0 {
        let message =
            format!("The header has {unknown} values that a job of this cycle has no place for: they are passed over");
        checker.warning("header-unknown", "", message);
    }
    Some(job)
}

/// A value of the header. A number is finite; whatever is none is text, and the check reports it.
fn value(text: &str) -> Value {
    match text {
        "true" => Value::Flag(true),
        "false" => Value::Flag(false),
        "null" => Value::Null,
        "{}" => Value::Map(Vec::new()),
        "[]" => Value::List(Vec::new()),
        _ => match text.strip_prefix('[').and_then(|inner| inner.strip_suffix(']')) {
            Some(inner) => Value::List(inner.split(',').take(3).map(value).collect()),
            None => match text.parse::<f64>() {
                Ok(x) if x.is_finite() => Value::Number(x),
                _ => Value::Text(text.to_owned()),
            },
        },
    }
}

/// Reports where the blocks are not those that the header's job makes, one for one: they were changed, or the header was.
fn compare(program: &Program, plan: &Plan, checker: &mut Checker) {
    let Ok(wanted) = mpf::read(&plan.program.text) else {
        let message = "The header says a job for another control: its blocks cannot be compared with the program's, which may have been changed";
        checker.warning("program-differs", "control.post", message);
        return;
    };
    let pairs = program.blocks.iter().zip(&wanted.blocks);
    let differs = pairs.filter(|(a, b)| a.statement != b.statement).map(|(a, _)| a.line).next();
    let (count, expected) = (program.blocks.len(), wanted.blocks.len());
    let line = match differs {
        Some(line) => Some(line),
        None if count > expected => Some(program.blocks[expected].line),
        None => None,
    };
    let message = match line {
        Some(line) => format!(
            "Line {line} is not what the job of the header makes there: the program, or its header, was changed. The job is the header's, \
             and what was changed in the program is not in it"
        ),
        None if count < expected => "The end of the program is missing. The job is the header's".to_owned(),
        None => return,
    };
    checker.warning("program-differs", "", message);
}
