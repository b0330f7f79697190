//! Every job of `tests/jobs/` as snapshots: path, table and results in `tests/snapshots/<job>.snap`, and the program for every control in
//! `tests/snapshots/<control>/<job>.snap`. A changed byte is seen in review.
//! New snapshots are made by `INSTA_UPDATE=always cargo test --lib golden`.

use std::fmt::Write;

use touchpath::control::{Form, POSTS, PostDef};
use touchpath::form::{Finding, Value};

fn triple(p: [f64; 3]) -> String {
    p.map(|x| touchpath::num::decimal(x, 6)).join(" ")
}

fn value(x: Option<f64>) -> String {
    x.map_or("null".to_owned(), |x| touchpath::num::decimal(x, 6))
}

fn listed(findings: &[Finding]) -> String {
    let lines = findings.iter().map(|f| format!("{:?} {} {}: {}\n", f.level, f.code, f.path, f.message));
    lines.collect()
}

fn snapshot(folder: &str, name: &str, text: &str) {
    insta::with_settings!({ snapshot_path => folder, prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!(name, text);
    });
}

#[test]
fn jobs_as_they_were() {
    let jobs = crate::common::jobs();
    assert!(jobs.len() >= 10);
    for (name, job) in jobs {
        let plan = crate::common::planned(&job);
        let mut text = String::new();
        for touch in &plan.touches {
            writeln!(text, "touch {} vector {} group {}", triple(touch.point), triple(touch.vector), touch.group).unwrap();
        }
        for step in &plan.moves {
            let touch = step.touch.map_or("-".to_owned(), |k| k.to_string());
            writeln!(text, "{} {} {} step {} touch {touch}", step.kind, triple(step.to), step.feed, step.step).unwrap();
        }
        writeln!(text, "length {} time {}", value(Some(plan.length)), value(Some(plan.time))).unwrap();
        for row in &plan.table {
            writeln!(
                text,
                "{} {} {:?} | {} | {:?} {:?}",
                row.code, row.type_name, row.value, row.meaning, row.field, row.touch
            )
            .unwrap();
        }
        for row in &plan.results {
            let numbers = [row.nominal, row.value, row.deviation, row.uncertainty, row.truth].map(value).join(" ");
            writeln!(text, "{} {} {numbers}", row.code, row.unit).unwrap();
        }
        text.push_str(&listed(&plan.findings));
        text.push_str(&plan.program.text);
        snapshot("../snapshots", &name, &text);
    }
}

/// The job for another control, in the form that it takes; its work offset where it has one.
fn put_out_for(job: &Value, post: &PostDef) -> Value {
    let cycle = job.get("cycle").and_then(|c| c.get("type"));
    let def = touchpath::cycle::CYCLES.iter().find(|c| cycle == Some(&Value::Text(c.key.to_owned()))).unwrap();
    let form = Form::ALL.into_iter().find(|form| (post.serves)(def.probes, *form).is_ok()).unwrap_or(Form::Moves);
    let mut job = crate::common::with(job, "control.post", Value::Text(post.key.to_owned()));
    job = crate::common::with(&job, "control.form", Value::Text(form.word().to_owned()));
    if post.work_offsets == 0 {
        job = crate::common::with(&job, "control.workOffset", Value::Null);
    }
    job
}

#[test]
fn programs_of_every_control_as_they_were() {
    for (name, job) in crate::common::jobs() {
        // Those that have no other form than their macros stand below.
        let takes_moves = |post: &&&PostDef| post.own.is_none() || post.read.is_some();
        for post in POSTS.iter().filter(takes_moves) {
            let text = match touchpath::job::plan(&put_out_for(&job, post)) {
                Ok(plan) => {
                    let rules = plan.safety.iter().filter(|row| row.holds != Some(true));
                    let rules: String =
                        rules.map(|row| format!("rule {} {:?}: {}\n", row.rule, row.holds, row.message)).collect();
                    format!("{:?}\n{rules}{}", plan.program.proof, plan.program.text)
                }
                Err(error) => listed(&error.findings),
            };
            snapshot(&format!("../snapshots/{}", post.key), &name, &text);
        }
    }
}

#[test]
fn programs_of_the_controls_own_macros_as_they_were() {
    for (name, job) in crate::common::jobs() {
        for post in POSTS.iter().filter(|post| post.own.is_some()) {
            let job = crate::common::with(&put_out_for(&job, post), "control.form", Value::Text(Form::Cycle.word().to_owned()));
            let text = match touchpath::job::plan(&job) {
                Ok(plan) => {
                    let moves = plan.moves.iter().map(|step| format!("{} {} {}\n", step.kind, triple(step.to), step.feed));
                    format!("{}{}{}", moves.collect::<String>(), listed(&plan.findings), plan.program.text)
                }
                Err(error) => listed(&error.findings),
            };
            snapshot(&format!("../snapshots/{}-cycle", post.key), &name, &text);
        }
    }
}
