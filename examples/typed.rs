//! A job with types, checked and planned: `cargo run --example typed`.

use touchpath::job::{check, plan};
use touchpath::typed::{Control, Hole, Job, Limits, Post};

fn main() {
    let job = Job {
        cycle: Hole { diameter: Some(25.0), depth: Some(6.0), ..Hole::default() }.into(),
        control: Some(Control { post: Some(Post::Haas), work_offset: Some(Some(1)), ..Control::default() }),
        limits: Some(Limits { position: Some(Some(2.0)), ..Limits::default() }),
        ..Job::default()
    };
    let plan = plan(&job.into()).expect("this job is good");
    println!("{}: {} touches", plan.program.does, plan.touches.len());
    for result in &plan.results {
        println!("{} = {:?} {}", result.code, result.value, result.unit);
    }

    // What is wrong has its path, as in a job from JSON.
    let narrow = Job { cycle: Hole { diameter: Some(5.0), ..Hole::default() }.into(), ..Job::default() };
    for finding in check(&narrow.into()) {
        println!("{} at {}: {}", finding.code, finding.path, finding.message);
    }
}

#[test]
fn it_runs() {
    main();
}
