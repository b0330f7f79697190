//! A program from a job, and why there is none: `cargo run --example program`.

use touchpath::job::{JobError, from_json, plan};

fn main() {
    let bore = r#"{ "format": 1, "cycle": { "type": "hole", "diameter": 25 }, "control": { "post": "fanuc", "workOffset": 1 } }"#;
    let plan = from_json(bore)
        .and_then(|job| plan(&job))
        .expect("this job is good");
    println!("{}", plan.program.text);
    println!(
        "{}: {:.1} mm in {:.2} min",
        plan.program.does, plan.length, plan.time
    );

    // What would break the probe has no program: every reason, with the field it is about.
    let deep = r#"{ "format": 1, "cycle": { "type": "hole", "diameter": 5 } }"#;
    let JobError { findings } = from_json(deep)
        .and_then(|job| touchpath::job::plan(&job))
        .expect_err("a ball of 6 in a hole of 5");
    for finding in findings {
        println!(
            "{:?} {} at {}: {}",
            finding.level, finding.code, finding.path, finding.message
        );
    }
}

#[test]
fn it_runs() {
    main();
}
