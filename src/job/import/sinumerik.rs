//! Reads back a SINUMERIK program that was written here: its header says the job, its blocks are read and compared with it.

use crate::job::form::FORMAT;
use crate::job::import::{Imported, set};
use crate::job::mpf::{self, Program, Purpose, Step};
use crate::job::{JobError, Plan};
use crate::post::JOB_LINE;
use crate::spec::{Checker, Value};

/// How far a written place may lie from a planned one: a digit of the last decimal, in the program's units.
const SAME: f64 = 1.1e-4;

/// How many lines that are not understood are told.
const MOST_TROUBLES: usize = 20;

/// Whether a text is a SINUMERIK program.
pub fn recognises(text: &str) -> bool {
    text.contains("MEAS=1") || text.contains("$AC_MEA") || text.contains("CYCLE977")
}

/// Makes a job of a program. A program that does not say its job, or is not of the language's part that is known here, is refused.
pub fn import(text: &str) -> Result<Imported, JobError> {
    let mut checker = Checker::default();
    let program = match mpf::read(text) {
        Ok(program) => program,
        Err(troubles) => {
            for trouble in troubles.iter().take(MOST_TROUBLES) {
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
    for trouble in program.troubles() {
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
        .collect();
    let text = |path: &str| lines.iter().find(|(p, _)| *p == path).map(|(_, v)| v.clone());
    let Some(Value::Text(_)) = text("cycle.type") else { return None };
    // What the header does not say, the job did not say either: the defaults stand in, as they did.
    let mut job = Value::Map(vec![("format".to_owned(), Value::Number(FORMAT))]);
    for (path, value) in lines {
        // The header has no other places.
        if !path.is_empty()
            && path.len() < 80
            && path.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'[' | b']' | b'_'))
        {
            set(&mut job, path, value);
        }
    }
    Some(job)
}

/// Tells where the blocks are not those of the job: somebody changed them, or the header.
fn compare(program: &Program, plan: &Plan, checker: &mut Checker) {
    let inch = plan.results.iter().any(|r| r.unit == "inch");
    if program.says(if inch { "G71" } else { "G70" }) {
        checker.warning("moves-differ", "units", "The program runs in other units than its header says");
    }
    let steps = match program.moves() {
        Ok(steps) => steps,
        Err(trouble) => return checker.warning("moves-differ", "", format!("Line {}: {}", trouble.line, trouble.message)),
    };
    let planned: Vec<_> =
        plan.moves.iter().zip(&plan.program.move_lines).filter(|(_, line)| **line >= 0).map(|(step, _)| step).collect();
    let mut read = steps.iter().peekable();
    for step in planned {
        let touch = step.touch.filter(|_| step.kind == "touch").map(|k| plan.touches[k].vector);
        let arrived = |s: &Step| match touch {
            // A touch goes on behind its contact, along its vector.
            Some(vector) => {
                let over: [f64; 3] = [0, 1, 2].map(|i| step.to[i] - s.to[i]);
                let along: f64 = (0..3).map(|i| over[i] * vector[i]).sum();
                s.purpose == Purpose::Touch && along > 0.0 && (0..3).all(|i| (over[i] - along * vector[i]).abs() < SAME)
            }
            None => s.purpose != Purpose::Touch && (0..3).all(|i| (s.to[i] - step.to[i]).abs() < SAME),
        };
        let mut line = None;
        let found = loop {
            let Some(next) = read.next() else { break false };
            line.get_or_insert(next.line);
            if arrived(next) {
                break true;
            }
            // Arcs are made of several straight moves.
            if step.arc.is_none() {
                break false;
            }
        };
        if !found {
            let place = line.map_or("The end".to_owned(), |line| format!("Line {line}"));
            let message = format!("{place}: this is not the move that the header's job has here; the job is the header's");
            return checker.warning("moves-differ", "", message);
        }
    }
    if let Some(more) = read.next() {
        let message = format!("Line {}: the job of the header has no such move; the job is the header's", more.line);
        checker.warning("moves-differ", "", message);
    }
}
