//! Reads back a SINUMERIK program that was written here: its header says the job, and its blocks are compared with those that the job
//! makes.

use crate::job::form::FORMAT;
use crate::job::import::{Imported, set};
use crate::job::mpf::{self, Program};
use crate::job::{JobError, Plan};
use crate::post::JOB_LINE;
use crate::spec::{Checker, Value};

/// How many lines that are not understood, or that differ, are told.
const MOST_TOLD: usize = 20;

/// How many values a header may have.
const MOST_VALUES: usize = 2000;

/// Whether a text is a SINUMERIK program.
pub fn recognises(text: &str) -> bool {
    text.contains("MEAS=1") || text.contains("$AC_MEA") || text.contains("CYCLE977")
}

/// Whether its header says a job.
pub fn says_job(text: &str) -> bool {
    text.contains(&format!("{JOB_LINE}cycle.type = "))
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
            return Err(JobError { findings: checker.findings });
        }
    };
    let Some(mut job) = told(&program) else {
        let message = "The program does not say which job it is: only programs that were written here can be read back";
        checker.error("nothing-to-import", "", message);
        return Err(JobError { findings: checker.findings });
    };
    if let Some(name) = program.comments.iter().find_map(|c| c.strip_prefix("Job: ")) {
        set(&mut job, "name", Value::Text(name.to_owned()));
    }
    for trouble in program.troubles().into_iter().take(MOST_TOLD) {
        checker.warning("unsafe-program", "", format!("Line {}: {}", trouble.line, trouble.message));
    }
    match crate::job::plan(&job) {
        Ok(plan) => compare(&program, &plan, &mut checker),
        Err(_) => checker.warning("header-unsound", "", "The job that the header says has errors: see its findings"),
    }
    checker.info("part-not-in-program", "part", "A program does not say how the part lies: the nominal one is taken");
    Ok(Imported { job, findings: checker.findings })
}

/// The job of the header: lines such as `job cycle.width1 = 80`.
fn told(program: &Program) -> Option<Value> {
    let lines: Vec<(&str, Value)> = program
        .comments
        .iter()
        .filter_map(|comment| {
            let (path, value) = comment.strip_prefix(JOB_LINE)?.split_once(" = ")?;
            let value = match value.trim() {
                "true" => Value::Flag(true),
                "false" => Value::Flag(false),
                "null" => Value::Null,
                "[]" => Value::List(Vec::new()),
                "{}" => Value::Map(Vec::new()),
                text => text.parse::<f64>().map_or_else(|_| Value::Text(text.to_owned()), Value::Number),
            };
            Some((path.trim(), value))
        })
        .take(MOST_VALUES)
        .collect();
    let text = |path: &str| lines.iter().find(|(p, _)| *p == path).map(|(_, v)| v.clone());
    let Some(Value::Text(_)) = text("cycle.type") else { return None };
    // What the header does not say, the job did not say either: the defaults stand in, as they did.
    let mut job = Value::Map(vec![("format".to_owned(), Value::Number(FORMAT))]);
    for (path, value) in lines {
        // The header has no other places.
        let plain = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'[' | b']' | b'_');
        if !path.is_empty() && path.len() < 80 && path.bytes().all(plain) {
            set(&mut job, path, value);
        }
    }
    Some(job)
}

/// Tells where the blocks are not those that the header's job makes, one for one: somebody changed them, or the header.
fn compare(program: &Program, plan: &Plan, checker: &mut Checker) {
    let Ok(wanted) = mpf::read(&plan.program.text) else { return };
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
