//! What is made of every job of `tests/jobs/`, as snapshots: a changed byte is seen in review.
//!
//! - `<job>.snap`: path, table, results, findings, and the program for LinuxCNC.
//! - `<control>/<job>.snap`: the program for another control, `<control>-cycle/` for its native cycles.
//! - `<control>/refused.snap`: the jobs that a control refuses, and why.
//! - `programs.snap`: hashes of the jobs' own programs.
//! - `<control>.snap`: a control whose programs are nearly those of another one, as what differs.
//!
//! The values of the job in a program's header are in the first program of each control, and are cut in the others; so is our version, and the numbers of
//! Klartext's blocks. New snapshots are made by `INSTA_UPDATE=always cargo test --lib golden`.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;

use similar::{ChangeTag, TextDiff};
use touchpath::control::{POSTS, PostDef, ProgramForm};
use touchpath::form::{Finding, Value};

/// Controls whose programs are nearly those of another control: key and form of both.
const KIN: [(&str, &str); 7] = [
    ("grblhal", "grbl"),
    ("fluidnc", "grblhal"),
    ("haas-cycle", "fanuc-cycle"),
    ("mazak-cycle", "fanuc-cycle"),
    ("brother-cycle", "fanuc-cycle"),
    ("hurco-cycle", "fanuc-cycle"),
    ("okuma-cycle", "fanuc-cycle"),
];

/// The control whose programs are listed with the path of their job.
const FIRST: &str = "linuxcnc";

fn triple(p: [f64; 3]) -> String {
    p.map(|x| touchpath::num::decimal(x, 6)).join(" ")
}

fn value(x: Option<f64>) -> String {
    x.map_or("null".to_owned(), |x| touchpath::num::decimal(x, 6))
}

fn listed(findings: &[Finding]) -> String {
    let lines = findings
        .iter()
        .map(|f| format!("{:?} {} {}: {}\n", f.level, f.code, f.path, f.message));
    lines.collect()
}

/// Output of a control for a job: its program with the findings, or the reason of its refusal.
type Made = Result<String, String>;

/// Path, table, results and findings of a job.
fn path_of(job: &Value) -> String {
    let plan = crate::common::planned(job);
    let mut text = String::new();
    for touch in &plan.touches {
        writeln!(
            text,
            "touch {} vector {} group {}",
            triple(touch.point),
            triple(touch.vector),
            touch.group
        )
        .unwrap();
    }
    for step in &plan.moves {
        let touch = step.touch.map_or("-".to_owned(), |k| k.to_string());
        writeln!(
            text,
            "{} {} {} step {} touch {touch}",
            step.kind,
            triple(step.to),
            step.feed,
            step.step
        )
        .unwrap();
    }
    writeln!(
        text,
        "length {} time {}",
        value(Some(plan.length)),
        value(Some(plan.time))
    )
    .unwrap();
    for row in &plan.table {
        let meaning = format!("{} | {:?} {:?}", row.meaning, row.field, row.touch);
        writeln!(
            text,
            "{} {} {:?} | {meaning}",
            row.code, row.type_name, row.value
        )
        .unwrap();
    }
    for row in &plan.results {
        let numbers = [
            row.nominal,
            row.value,
            row.deviation,
            row.uncertainty,
            row.truth,
        ]
        .map(value)
        .join(" ");
        writeln!(text, "{} {} {numbers}", row.code, row.unit).unwrap();
    }
    text + &listed(&plan.findings)
}

/// The job for another control, in this form; with its work offset if that exists there.
fn put_out_for(job: &Value, post: &PostDef, form: ProgramForm) -> Value {
    let mut job = crate::common::with(job, "control.post", Value::Text(post.key.to_owned()));
    job = crate::common::with(&job, "control.form", Value::Text(form.word().to_owned()));
    if post.work_offsets == 0 {
        job = crate::common::with(&job, "control.workOffset", Value::Null);
    }
    job
}

/// The form in which a control supports this cycle: moves if possible.
fn served(job: &Value, post: &PostDef) -> ProgramForm {
    let cycle = job.get("cycle").and_then(|c| c.get("type"));
    let def = touchpath::cycle::CYCLES
        .iter()
        .find(|c| cycle == Some(&Value::Text(c.key.to_owned())))
        .unwrap();
    ProgramForm::ALL
        .into_iter()
        .find(|form| (post.supports)(def.probes, *form).is_ok())
        .unwrap_or(ProgramForm::Moves)
}

/// A program of moves, with its proof and the rules that do not hold.
fn of_moves(job: &Value, post: &PostDef) -> Made {
    let plan = touchpath::job::plan(&put_out_for(job, post, served(job, post)))
        .map_err(|error| listed(&error.findings))?;
    let rules = plan.safety.iter().filter(|row| row.holds != Some(true));
    let rules: String = rules
        .map(|row| format!("rule {} {:?}: {}\n", row.rule, row.holds, row.message))
        .collect();
    Ok(format!(
        "{:?}\n{rules}{}",
        plan.program.proof, plan.program.text
    ))
}

/// A program of native cycles, with their moves and the findings.
fn of_cycles(job: &Value, post: &PostDef) -> Made {
    let plan = touchpath::job::plan(&put_out_for(job, post, ProgramForm::Cycle))
        .map_err(|error| listed(&error.findings))?;
    let moves = plan
        .moves
        .iter()
        .map(|step| format!("{} {} {}\n", step.kind, triple(step.to), step.feed));
    Ok(format!(
        "{}{}{}",
        moves.collect::<String>(),
        listed(&plan.findings),
        plan.program.text
    ))
}

/// Without the parts common to all programs of the control: version, values of the job, numbers of Klartext's blocks.
fn cut(program: &str) -> String {
    let mut text = String::new();
    let mut values = false;
    for line in program.lines() {
        let line = line.trim_start_matches(|c: char| c.is_ascii_digit());
        let line = line.strip_prefix(' ').unwrap_or(line);
        let folded = line.to_lowercase();
        values &= !folded.contains("blocks below");
        if !values {
            let _ = writeln!(text, "{line}");
        }
        values |= folded.contains("from this job, every value");
    }
    text
}

/// Without the version, which changes with each release.
fn unversioned(text: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    text.replace(version, "VERSION")
        .replace(&version.to_uppercase(), "VERSION")
}

/// FNV-1a of a text's bytes.
fn fnv(text: &str) -> String {
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    });
    format!("{hash:016x}")
}

/// Without the name of the control.
fn unnamed(text: &str, post: &PostDef) -> String {
    let names = [
        post.title.to_owned(),
        post.title.to_uppercase(),
        post.key.to_owned(),
        post.key.to_uppercase(),
    ];
    names.iter().fold(text.to_owned(), |text, name| {
        text.replace(name.as_str(), "NAME")
    })
}

/// Output of each control and form for each job.
fn made() -> BTreeMap<String, (&'static PostDef, BTreeMap<String, Made>)> {
    let jobs = crate::common::jobs();
    assert!(jobs.len() >= 10);
    let mut all = BTreeMap::new();
    for post in POSTS {
        // A control with only macros is listed with the macros.
        if post.own.is_none() || post.read.is_some() {
            let programs = jobs
                .iter()
                .map(|(name, job)| (name.clone(), of_moves(job, post)))
                .collect();
            all.insert(post.key.to_owned(), (*post, programs));
        }
        if post.own.is_some() {
            let programs = jobs
                .iter()
                .map(|(name, job)| (name.clone(), of_cycles(job, post)))
                .collect();
            all.insert(format!("{}-cycle", post.key), (*post, programs));
        }
    }
    all
}

/// Differences between the programs of a control and those of another one.
fn differences(
    own: &BTreeMap<String, Made>,
    post: &PostDef,
    other: &BTreeMap<String, Made>,
    of: &PostDef,
) -> String {
    let mut text = String::new();
    for (name, made) in own {
        let plain = |made: &Made, post: &PostDef| match made {
            Ok(program) => unnamed(&cut(program), post),
            Err(why) => format!("refused\n{}", unnamed(why, post)),
        };
        let (before, after) = (plain(&other[name], of), plain(made, post));
        if before == after {
            continue;
        }
        let _ = writeln!(text, "== {name}");
        for change in TextDiff::from_lines(&before, &after).iter_all_changes() {
            let sign = match change.tag() {
                ChangeTag::Delete => '-',
                ChangeTag::Insert => '+',
                ChangeTag::Equal => continue,
            };
            let _ = write!(text, "{sign} {change}");
        }
    }
    if text.is_empty() {
        "nothing but the name\n".to_owned()
    } else {
        text
    }
}

/// The snapshots and their names.
#[derive(Default)]
struct Snapshots(BTreeSet<String>);

impl Snapshots {
    fn assert(&mut self, folder: &str, name: &str, text: &str) {
        let path = Path::new("../snapshots").join(folder);
        insta::with_settings!({ snapshot_path => path, prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!(name, unversioned(text));
        });
        self.0
            .insert(Path::new(folder).join(name).to_string_lossy().into_owned());
    }
}

#[test]
fn jobs_and_programs_as_they_were() {
    let all = made();
    let mut snapshots = Snapshots::default();
    for (name, job) in crate::common::jobs() {
        let program = match &all[FIRST].1[&name] {
            Ok(program) => cut(program),
            Err(why) => why.clone(),
        };
        snapshots.assert("", &name, &format!("{}{program}", path_of(&job)));
    }
    // The package's tests compare the programs of the module with these.
    let hash = |(name, job): (String, Value)| {
        format!(
            "{name} {}\n",
            fnv(&unversioned(&crate::common::planned(&job).program.text))
        )
    };
    let hashes: String = crate::common::jobs().into_iter().map(hash).collect();
    snapshots.assert(
        "",
        "programs",
        &format!("Hashes of the jobs' own programs:\n{hashes}"),
    );
    for (folder, (post, programs)) in &all {
        if let Some((_, of)) = KIN.iter().find(|(kin, _)| kin == folder) {
            let (base, other) = &all[*of];
            let text = format!(
                "What the programs say otherwise than those of {of}:\n{}",
                differences(programs, post, other, base)
            );
            snapshots.assert("", folder, &text);
            continue;
        }
        let mut refused = String::new();
        let mut whole = true;
        for (name, made) in programs {
            match made {
                Ok(program) => {
                    // The first one is complete.
                    let text = if std::mem::take(&mut whole) {
                        program.clone()
                    } else {
                        cut(program)
                    };
                    if folder != FIRST {
                        snapshots.assert(folder, name, &text);
                    } else if text == *program {
                        snapshots.assert(folder, "header", &text);
                    }
                }
                Err(why) => {
                    let _ = write!(refused, "== {name}\n{why}");
                }
            }
        }
        if !refused.is_empty() && folder != FIRST {
            snapshots.assert(folder, "refused", &refused);
        }
    }
    let left = left_over(&snapshots.0);
    assert!(
        left.is_empty(),
        "no job makes these snapshots any more, remove them: {}",
        left.join(" ")
    );
}

/// Snapshots of this test that nothing generates.
fn left_over(made: &BTreeSet<String>) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots");
    let mut left = Vec::new();
    let mut folders = vec![folder.clone()];
    while let Some(inner) = folders.pop() {
        for entry in std::fs::read_dir(inner).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path
                .strip_prefix(&folder)
                .expect("inside")
                .with_extension("")
                .to_string_lossy()
                .into_owned();
            if path.extension().is_some_and(|kind| kind == "snap") && !made.contains(&name) {
                left.push(name);
            }
        }
    }
    left.sort();
    left
}
