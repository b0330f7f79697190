//! Every job of `tests/jobs/` as a snapshot: path, table, results and program. A changed byte is seen in review.
//! New snapshots are made by `INSTA_UPDATE=always cargo test --test golden`.
#![cfg(not(target_arch = "wasm32"))]

mod common;

use std::fmt::Write;

fn triple(p: [f64; 3]) -> String {
    p.map(|x| touchpath::num::decimal(x, 6)).join(" ")
}

fn value(x: Option<f64>) -> String {
    x.map_or("null".to_owned(), |x| touchpath::num::decimal(x, 6))
}

#[test]
fn jobs_as_they_were() {
    let jobs = common::jobs();
    assert!(jobs.len() >= 10);
    for (name, job) in jobs {
        let plan = common::planned(&job);
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
        for finding in &plan.findings {
            writeln!(text, "{:?} {} {}: {}", finding.level, finding.code, finding.path, finding.message).unwrap();
        }
        text.push_str(&plan.program.text);
        insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!(name, text);
        });
    }
}
