//! Shared by the tests: the jobs in `tests/jobs/`, and LinuxCNC's own interpreter.
#![allow(dead_code, reason = "each test file uses its part")]

pub mod fanuc;
pub mod mpf;
pub mod owed;
pub mod sinumerik;

use std::path::{Path, PathBuf};
use std::process::Command;

use proptest::prelude::*;
#[cfg(not(target_arch = "wasm32"))]
use proptest::test_runner::TestRunner;
use touchpath::form::{Finding, Value};
use touchpath::import::{Imported, TraceRow};
use touchpath::job::{JobError, Plan, from_json, plan};
use touchpath::text::{Part, Text};

/// Numbers and names in the message of a finding, in order, without the words around them: for tests that do not depend on the sentence.
pub fn values(finding: &Finding) -> Vec<String> {
    fn of(text: &Text, found: &mut Vec<String>) {
        for part in text.values() {
            match part {
                Part::Verbatim(value) => found.push(value.clone()),
                Part::Text(text) => of(text, found),
            }
        }
    }
    let mut found = Vec::new();
    of(&finding.said, &mut found);
    found
}

/// A sequence of numbers from 0 to 1, the same in every run.
pub struct Draws(pub u64);

impl Draws {
    pub fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    pub fn of(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize % count
    }
}

/// Whether a block consists only of words of a letter and a number, after its block number and a block skip.
fn is_plain(mut code: &str) -> bool {
    let digits = |text: &str| {
        text.bytes()
            .take_while(|b| b.is_ascii_digit() || *b == b'.')
            .count()
    };
    while !code.is_empty() {
        let rest = code[1..].trim_start_matches([' ', '\t']);
        code = match code.as_bytes()[0] {
            b' ' | b'\t' => rest,
            b'/' => &code[1 + digits(&code[1..])..],
            letter if b"NGXYZF".contains(&letter.to_ascii_uppercase()) => {
                let unsigned = rest.strip_prefix(['-', '+']).unwrap_or(rest);
                match digits(unsigned) {
                    0 => return false,
                    length => &unsigned[length..],
                }
            }
            _ => return false,
        }
    }
    true
}

/// A program with a comment after every such block: the meaning is the same, but its reader reads it word by word.
pub fn with_comments(text: &str) -> String {
    text.split_inclusive('\n')
        .map(|line| {
            match line
                .strip_suffix('\n')
                .filter(|code| code.is_ascii() && is_plain(code) && !code.trim().is_empty())
            {
                Some(code) => format!("{code} ;\n"),
                None => line.to_owned(),
            }
        })
        .collect()
}

/// Jobs of the repository: name and value.
pub fn jobs() -> Vec<(String, Value)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/jobs");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("tests/jobs")
        .map(|e| e.expect("entry").path())
        .collect();
    paths.sort();
    paths
        .into_iter()
        .map(|path| {
            let text = std::fs::read_to_string(&path).expect("a job file");
            let name = path
                .file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned();
            (name, from_json(&text).expect("a job file is JSON"))
        })
        .collect()
}

/// The job without limits of its results: the values that an interpreter reads without a part are implausible.
pub fn unlimited(job: &Value) -> Value {
    ["position", "size", "angle", "residual"]
        .iter()
        .fold(job.clone(), |job, limit| {
            with(&job, &format!("limits.{limit}"), Value::Null)
        })
}

/// Jobs of the repository, without limits.
pub fn unlimited_jobs() -> Vec<(String, Value)> {
    jobs()
        .into_iter()
        .map(|(name, job)| (name, unlimited(&job)))
        .collect()
}

/// The plan of a job; panics without one.
pub fn planned(job: &Value) -> Plan {
    plan(job).unwrap_or_else(|e| panic!("{:#?}", e.findings))
}

/// Code and path of every error of a refused job.
pub fn refused(job: &Value) -> Vec<String> {
    let error = touchpath::job::plan(job).expect_err("refused");
    let errors = error
        .findings
        .iter()
        .filter(|finding| finding.level == touchpath::form::Level::Error);
    errors
        .map(|finding| format!("{} {}", finding.code, finding.path))
        .collect()
}

/// A job from JSON text.
pub fn job(text: &str) -> Value {
    from_json(text).expect("JSON")
}

/// Content of a text; `job` is null for a program of moves.
#[derive(Debug)]
pub struct Read {
    pub job: Value,
    pub trace: Option<TraceRow>,
    pub findings: Vec<Finding>,
}

/// Reads a text.
pub fn import(text: &str) -> Result<Read, JobError> {
    Ok(match touchpath::import::import(text)? {
        Imported::Job { job, findings } => Read {
            job,
            trace: None,
            findings,
        },
        Imported::Moves { trace, findings } => Read {
            job: Value::Null,
            trace: Some(trace),
            findings,
        },
    })
}

/// The job with another value at a path such as `cycle.width1`.
pub fn with(job: &Value, path: &str, value: Value) -> Value {
    let (key, rest) = path
        .split_once('.')
        .map_or((path, None), |(k, r)| (k, Some(r)));
    let mut entries = match job {
        Value::Map(entries) => entries.clone(),
        _ => Vec::new(),
    };
    let inner = match rest {
        None => value,
        Some(rest) => with(job.get(key).unwrap_or(&Value::Map(Vec::new())), rest, value),
    };
    entries.retain(|(k, _)| k != key);
    entries.push((key.to_owned(), inner));
    Value::Map(entries)
}

pub fn number(x: f64) -> Value {
    Value::Number(x)
}

pub fn point(p: [f64; 3]) -> Value {
    Value::List(p.map(Value::Number).to_vec())
}

/// A number of the job, or the default.
pub fn number_at(job: &Value, path: &str, default: f64) -> f64 {
    let mut at = Some(job);
    for key in path.split('.') {
        at = at.and_then(|v| v.get(key));
    }
    match at {
        Some(Value::Number(x)) => *x,
        _ => default,
    }
}

/// A canonical move of the interpreter.
#[derive(Clone, Debug, PartialEq)]
pub struct Canon {
    pub kind: &'static str,
    pub to: [f64; 3],
    pub feed: f64,
    /// Centre, and whether it runs counter-clockwise.
    pub arc: Option<([f64; 3], bool)>,
}

/// Result of the interpreter for a program.
#[derive(Clone, Debug, Default)]
pub struct Interpreted {
    pub moves: Vec<Canon>,
    pub prints: Vec<(String, f64)>,
    /// First offset that is set after the last move, number and X, Y, Z: the write of the program, if it has one.
    pub written: Option<(usize, [f64; 3])>,
    /// Rotation of that offset.
    pub rotation: Option<f64>,
    /// Every offset set after the last move and before the modes are restored.
    pub offsets_after_moves: Vec<[f64; 3]>,
    /// Every such rotation.
    pub rotations_after_moves: Vec<f64>,
    pub inch: bool,
    /// Messages on the screen that are no results.
    pub messages: Vec<String>,
}

/// Runs a program through LinuxCNC's interpreter. The error is its message for a refused program.
pub fn interpret(program: &str) -> Result<Interpreted, String> {
    match interpret_until_stop(program) {
        (ran, None) => Ok(ran),
        (_, Some(why)) => Err(why),
    }
}

/// Result of the interpreter up to the end of a program or up to an error, and the error.
pub fn interpret_until_stop(program: &str) -> (Interpreted, Option<String>) {
    let (text, error) = run_interpreter(program);
    (read(&text), error.map(|why| format!("{text}{why}")))
}

/// A program for LinuxCNC whose touches end at these positions, by number: a probing move of the interpreter ends at its target.
pub fn ending_at(plan: &Plan, place: impl Fn(usize) -> [f64; 3]) -> String {
    let mut lines: Vec<String> = plan.program.text.lines().map(str::to_owned).collect();
    for (index, step) in plan
        .moves
        .iter()
        .enumerate()
        .filter(|(_, step)| step.kind == "touch")
    {
        let [x, y, z] = place(step.touch.expect("a touch has its number"));
        lines[usize::try_from(plan.program.move_lines[index]).expect("a line")] =
            format!("G38.2 X{x:.7} Y{y:.7} Z{z:.7} F150");
    }
    lines.join("\n") + "\n"
}

/// The program for the virtual part of the plan.
pub fn on_virtual_part(plan: &Plan) -> String {
    ending_at(plan, |k| {
        plan.triggers[k].expect("every touch meets the part")
    })
}

/// The canonical calls, one per line.
pub fn canonical(program: &str) -> Vec<String> {
    run_interpreter(program)
        .0
        .lines()
        .map(str::to_owned)
        .collect()
}

/// Command of LinuxCNC's interpreter.
fn interpreter() -> PathBuf {
    let command = std::env::var("RS274")
        .map(PathBuf::from)
        .unwrap_or_else(|_| {
            let target = std::env::var("CARGO_TARGET_DIR")
                .unwrap_or_else(|_| format!("{}/target", env!("CARGO_MANIFEST_DIR")));
            PathBuf::from(target).join("tools/linuxcnc/rs274")
        });
    assert!(
        command.exists(),
        "LinuxCNC's interpreter is not set up: run `npm run test:setup` once"
    );
    command
}

/// A folder for the files of one run.
fn own_folder() -> PathBuf {
    let folder = std::env::temp_dir().join(format!(
        "touchpath-{}-{:?}",
        std::process::id(),
        std::thread::current().id()
    ));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Result of LinuxCNC's screens for each program when it is loaded: `ok`, or the reason of a refusal.
pub fn preview(programs: &[&str]) -> Vec<String> {
    let command = interpreter();
    let root = command.parent().expect("its folder");
    let folder = own_folder();
    let paths = programs.iter().enumerate().map(|(i, text)| {
        let path = folder.join(format!("{i}.ngc"));
        std::fs::write(&path, text).expect("a file");
        path
    });
    let paths: Vec<PathBuf> = paths.collect();
    let libraries = format!("{0}/usr/lib:{0}/usr/lib/x86_64-linux-gnu", root.display());
    let output = Command::new("python3")
        .arg(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/tests/common/preview.py"
        ))
        .arg(root)
        .args(&paths)
        .env("LD_LIBRARY_PATH", libraries)
        .env("HOME", &folder)
        .output()
        .expect("Python runs");
    std::fs::remove_dir_all(&folder).expect("the folder goes");
    let said: Vec<String> = String::from_utf8_lossy(&output.stdout)
        .lines()
        .map(str::to_owned)
        .collect();
    assert_eq!(
        said.len(),
        programs.len(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    said
}

fn run_interpreter(program: &str) -> (String, Option<String>) {
    let command = interpreter();
    let folder = own_folder();
    let file = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).expect("a file");
        path
    };
    let output = Command::new(command)
        .arg("-t")
        .arg(file("tool.tbl", "T1 P1 D6 Z0\n"))
        .arg("-v")
        .arg(file("empty.var", ""))
        .arg("-g")
        // The command alone simulates no machine: it would treat a program as a preview.
        .arg(file("program.ngc", &program.replace("#<_task>", "1")))
        // It maps its tool table from the home folder: two parallel runs would share it and crash.
        .env("HOME", &folder)
        .stdin(std::process::Stdio::null())
        .output()
        .expect("the interpreter runs");
    std::fs::remove_dir_all(&folder).expect("the folder goes");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let error =
        (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned());
    (text, error)
}

fn read(text: &str) -> Interpreted {
    let mut found = Interpreted::default();
    let mut feed = 0.0;
    let mut plane = [0, 1, 2];
    let mut given_back = false;
    for line in text.lines() {
        if let Some((name, value)) = line.split_once('=').filter(|_| !line.contains("N.....")) {
            found
                .prints
                .push((name.to_owned(), value.parse().unwrap_or(f64::NAN)));
            continue;
        }
        let Some((word, rest)) = line
            .split_once("N..... ")
            .and_then(|(_, call)| call.split_once('('))
        else {
            continue;
        };
        let numbers: Vec<f64> = rest
            .trim_end_matches(')')
            .split(',')
            .filter_map(|n| n.trim().parse().ok())
            .collect();
        // Messages on the screen: one result, or several with their names.
        let message = rest.trim_matches(['"', ')']);
        if word == "MESSAGE" && message.contains('=') {
            let pairs: Vec<(&str, &str)> = message
                .split(' ')
                .filter_map(|pair| pair.split_once('='))
                .collect();
            let number = |value: &str| value.parse().unwrap_or(f64::NAN);
            found.prints.extend(
                pairs
                    .into_iter()
                    .map(|(name, value)| (name.to_owned(), number(value))),
            );
            continue;
        }
        if word == "MESSAGE" {
            found.messages.push(rest.to_owned());
        }
        let kind = match word {
            "STRAIGHT_TRAVERSE" => "rapid",
            "STRAIGHT_FEED" => "feed",
            "STRAIGHT_PROBE" => "probe",
            "SELECT_PLANE" => {
                plane = match rest.trim_end_matches(')') {
                    "CANON_PLANE_XZ" => [2, 0, 1],
                    "CANON_PLANE_YZ" => [1, 2, 0],
                    _ => [0, 1, 2],
                };
                continue;
            }
            "ARC_FEED" => "arc",
            "SET_FEED_RATE" => {
                feed = numbers[0];
                continue;
            }
            "SET_G5X_OFFSET" => {
                if !given_back {
                    found
                        .offsets_after_moves
                        .push([numbers[1], numbers[2], numbers[3]]);
                }
                found
                    .written
                    .get_or_insert((numbers[0] as usize, [numbers[1], numbers[2], numbers[3]]));
                continue;
            }
            "SET_XY_ROTATION" => {
                if !given_back {
                    found.rotations_after_moves.push(numbers[0]);
                }
                found.rotation.get_or_insert(numbers[0]);
                continue;
            }
            // M72 restores the previous system, starting with its units or its path control.
            "SET_MOTION_CONTROL_MODE" | "SET_FEED_MODE" => {
                given_back = !found.moves.is_empty();
                continue;
            }
            "USE_LENGTH_UNITS" => {
                given_back = !found.moves.is_empty();
                found.inch |= rest.contains("INCHES");
                continue;
            }
            _ => continue,
        };
        (found.written, found.rotation) = (None, None);
        found.offsets_after_moves.clear();
        found.rotations_after_moves.clear();
        given_back = false;
        if kind == "arc" {
            // First and second end, first and second axis of the centre, turn, end along the tool axis.
            let place = |first: f64, second: f64| {
                let mut p = [0.0; 3];
                (p[plane[0]], p[plane[1]], p[plane[2]]) = (first, second, numbers[5]);
                p
            };
            let arc = Some((place(numbers[2], numbers[3]), numbers[4] > 0.0));
            found.moves.push(Canon {
                kind,
                to: place(numbers[0], numbers[1]),
                feed,
                arc,
            });
            continue;
        }
        found.moves.push(Canon {
            kind,
            to: [numbers[0], numbers[1], numbers[2]],
            feed,
            arc: None,
        });
    }
    found
}

/// Runs a program with the ball at the job's start position.
pub fn interpret_from(program: &str, job: &Value) -> Result<Interpreted, String> {
    let start = match job.get("cycle").and_then(|c| c.get("start")) {
        Some(Value::List(items)) => [0, 1, 2].map(|i| {
            if let Value::Number(x) = items[i] {
                x
            } else {
                f64::NAN
            }
        }),
        _ => [
            0.0,
            0.0,
            if job.get("units") == Some(&Value::Text("inch".into())) {
                100.0 / 25.4
            } else {
                100.0
            },
        ],
    };
    let unit = if program.lines().any(|l| l == "G20") {
        "G20"
    } else {
        "G21"
    };
    let [x, y, z] = start;
    let mut ran = interpret(&format!(
        "{unit} G90\nG0 X{x:.9} Y{y:.9} Z{z:.9}\n{program}"
    ))?;
    ran.moves.remove(0);
    Ok(ran)
}

/// Whether a LinuxCNC program watches its positioning.
pub fn watches(plan: &Plan) -> bool {
    plan.program.text.contains("G38.3")
}

/// Compares the interpreter's moves with the plan's: units, positions within half a last digit of its print, kinds, feeds, number. An approach from an unknown
/// position takes two or three moves; a watched arc is made of straight pieces on it.
pub fn compare_moves(
    plan: &Plan,
    search: impl Fn(usize) -> f64,
    ran: &Interpreted,
) -> Result<(), String> {
    if ran.inch != plan.results.iter().any(|r| r.unit == "inch") {
        return Err("the program runs in the other units".to_owned());
    }
    let known_start = plan.results.iter().any(|r| r.code == "Q950");
    let Some(first) = plan.moves.first() else {
        return if ran.moves.is_empty() {
            Ok(())
        } else {
            Err("moves run where none is planned".to_owned())
        };
    };
    if known_start {
        return compare_rest(plan, &search, &ran.moves, 0);
    }
    // Up if the stylus is lower, across, down.
    let mut why = "the first place is not reached".to_owned();
    for steps in [3, 2] {
        let Some((approach, rest)) = ran.moves.split_at_checked(steps) else {
            continue;
        };
        let near =
            (0..3).all(|axis| (approach[steps - 1].to[axis] - first.to[axis]).abs() < 1.01e-4);
        let kinds = approach
            .iter()
            .all(|m| matches!(m.kind, "feed" | "rapid") || (watches(plan) && m.kind == "probe"));
        if near && kinds {
            match compare_rest(plan, &search, rest, 1) {
                Ok(()) => return Ok(()),
                Err(other) => why = other,
            }
        }
    }
    Err(why)
}

fn compare_rest(
    plan: &Plan,
    search: &impl Fn(usize) -> f64,
    moves: &[Canon],
    from: usize,
) -> Result<(), String> {
    let distance =
        |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    let inch = if plan.results.iter().any(|r| r.unit == "inch") {
        25.4
    } else {
        1.0
    };
    let watched = watches(plan);
    let known_start = plan.results.iter().any(|r| r.code == "Q950");
    let mut rest = moves.iter();
    let mut at = from.checked_sub(1).map(|i| plan.moves[i].to);
    for (i, step) in plan.moves.iter().enumerate().skip(from) {
        let mut to = step.to;
        if step.kind == "touch" {
            let k = step.touch.expect("a touch");
            let vector = plan.touches[k].vector;
            to = [0, 1, 2].map(|axis| to[axis] - search(k) * vector[axis]);
        }
        loop {
            let canon = rest.next().ok_or(format!("move {i} is missing"))?;
            let near = (0..3).all(|axis| (canon.to[axis] - to[axis]).abs() < 1.01e-4);
            let short = at.is_none_or(|at| distance(at, canon.to) * inch < 0.31);
            let kinds: &[&str] = match (step.kind, step.feed, &step.arc) {
                ("touch", ..) => &["probe"],
                ("position", ..) if watched && short => &["feed", "probe"],
                ("position", ..) if watched => &["probe"],
                (.., Some(_)) => &["arc"],
                // A rapid with a stated rate runs as a feed move.
                (_, "rapid", None) if known_start => &["rapid", "feed"],
                (_, "rapid", None) => &["rapid"],
                (.., None) => &["feed"],
            };
            if !kinds.contains(&canon.kind) {
                return Err(format!(
                    "move {i} runs as {}, planned as {kinds:?}",
                    canon.kind
                ));
            }
            if let (Some(arc), Some((center, counter_clockwise))) = (&step.arc, canon.arc)
                && ((0..3).any(|axis| (center[axis] - arc.center[axis]).abs() > 2.1e-4)
                    || counter_clockwise != (arc.sweep > 0.0))
            {
                return Err(format!("move {i} runs about {center:?}, planned {arc:?}"));
            }
            at = Some(canon.to);
            if near {
                break;
            }
            let Some(arc) = step.arc.as_ref().filter(|_| watched) else {
                return Err(format!(
                    "move {i} runs to {:?}, planned to {to:?}",
                    canon.to
                ));
            };
            if (distance(canon.to, arc.center) - distance(step.to, arc.center)).abs() > 2e-4 {
                return Err(format!("move {i} leaves its arc at {:?}", canon.to));
            }
        }
    }
    match rest.next() {
        Some(canon) => Err(format!("{canon:?} is not planned")),
        None => Ok(()),
    }
}

/// Compares a SINUMERIK program's path with the plan's: purposes, positions within its last digit, numbers, and lines. An arc may be made of straight pieces
/// that end on it.
pub fn compare_mpf(
    plan: &Plan,
    search: impl Fn(usize) -> f64,
    program: &crate::common::mpf::Program,
) -> Result<(), String> {
    use crate::common::mpf::Purpose;
    let steps = program.moves().map_err(|t| format!("{t:?}"))?;
    let mut read = steps.iter().peekable();
    for (i, planned) in plan.moves.iter().enumerate() {
        let wanted = match planned.kind {
            "touch" => Purpose::Touch,
            "back" => Purpose::Back,
            _ => Purpose::Position,
        };
        let mut to = planned.to;
        if let (Some(k), Purpose::Touch) = (planned.touch, wanted) {
            to = [0, 1, 2].map(|axis| to[axis] - search(k) * plan.touches[k].vector[axis]);
        }
        let near =
            |a: &[f64; 3], b: [f64; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1.01e-4);
        let first = *read.peek().ok_or(format!("move {i} is missing"))?;
        if plan.program.move_lines[i] + 1 != first.line as i32 {
            return Err(format!(
                "move {i} is in line {}, not {}",
                first.line,
                plan.program.move_lines[i] + 1
            ));
        }
        loop {
            let step = read.next().ok_or(format!("move {i} is missing"))?;
            if step.purpose != wanted || (wanted != Purpose::Back && step.number != Some(i + 1)) {
                return Err(format!(
                    "move {i} is read as {step:?}, planned as {planned:?}"
                ));
            }
            if near(&step.to, to) {
                break;
            }
            let Some(arc) = &planned.arc else {
                return Err(format!("move {i} runs to {:?}, planned to {to:?}", step.to));
            };
            let from = |p: [f64; 3]| {
                (0..3)
                    .map(|axis| (p[axis] - arc.center[axis]).powi(2))
                    .sum::<f64>()
                    .sqrt()
            };
            if (from(step.to) - from(planned.to)).abs() > 2e-4 {
                return Err(format!("move {i} leaves its arc at {:?}", step.to));
            }
        }
    }
    match read.next() {
        Some(step) => Err(format!("{step:?} is not planned")),
        None => Ok(()),
    }
}

/// Tests a law with a number of cases. Each case returns whether it reached its assertions, and at least `least` must: a law that hardly any case reaches
/// proves nothing. Because random cases can fall short by chance, up to four times as many are tried.
#[cfg(not(target_arch = "wasm32"))]
pub fn law<S: Strategy>(
    cases: u32,
    least: usize,
    strategy: S,
    ask: impl Fn(S::Value) -> Result<bool, TestCaseError>,
) {
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let reached = std::cell::Cell::new(0);
    let mut runner = TestRunner::new(config.clone());
    for _ in 0..4 {
        let result = runner.run(&strategy, |case| {
            reached.set(reached.get() + usize::from(ask(case)?));
            Ok(())
        });
        result.unwrap_or_else(|why| panic!("{why}"));
        if reached.get() >= least {
            return;
        }
        // A runner that has run all its cases runs no more.
        runner = TestRunner::new_with_rng(config.clone(), runner.new_rng());
    }
    panic!(
        "only {} of {} cases reached the assertions, at least {least} of {cases} should",
        reached.get(),
        4 * cases
    );
}
