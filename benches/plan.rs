//! How long a form edit takes to become a whole plan, natively. `npm run bench` runs this beside the same in WebAssembly.
//! Prints one line a job: name, touches, nanoseconds.
//!
//! With `--count=read` it counts nothing itself: it does this stage of each job once inside of [`counted`], for callgrind. `--warm=3` does it that
//! often before, and `--skip=9` leaves the first jobs out of what is counted. It prints how many bytes the programs have that were counted.
#![allow(missing_docs, reason = "a bench is a program")]

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    let (options, jobs): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let option = |name: &str| {
        options
            .iter()
            .find_map(|option| option.strip_prefix(name)?.strip_prefix('='))
    };
    let number = |name: &str| option(name).and_then(|text| text.parse().ok()).unwrap_or(0);
    match option("--count") {
        Some(stage) => count(&jobs, stage, number("--warm"), number("--skip")),
        None => time(&jobs),
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn time(jobs: &[String]) {
    use std::hint::black_box;
    use std::time::Instant;
    use touchpath::job::{from_json, plan};

    for entry in jobs {
        let (name, text) = entry.split_once('=').expect("name=job");
        let job = from_json(text).expect("a job");
        let touches = plan(&job).expect("a plan").touches.len();
        // The median of 21 rounds, each long enough to be measured well.
        let mut rounds: Vec<u128> = (0..21)
            .map(|_| {
                let start = Instant::now();
                for _ in 0..200 {
                    black_box(plan(black_box(&job)).expect("a plan"));
                }
                start.elapsed().as_nanos() / 200
            })
            .collect();
        rounds.sort_unstable();
        println!("{name} {touches} {}", rounds[rounds.len() / 2]);
        // The parts of it, each as the least of 21 rounds.
        touchpath::job::stages(&job, 100, |stage, work| {
            let least = (0..21).map(|_| {
                let start = Instant::now();
                work();
                start.elapsed().as_nanos() / 100
            });
            println!(
                "  {stage}: {name} {touches} {}",
                least.min().expect("there are rounds")
            );
        });
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn count(jobs: &[String], wanted: &str, warm: usize, skip: usize) {
    let jobs: Vec<_> = jobs
        .iter()
        .map(|text| touchpath::job::from_json(text).expect("a job"))
        .collect();
    for (at, job) in jobs.iter().enumerate() {
        touchpath::job::stages(job, 1, |stage, work| {
            if stage == wanted {
                (0..warm).for_each(|_| work());
                if at < skip { work() } else { counted(work) }
            }
        });
    }
    // Only now: a plan reads its program, too.
    let bytes = |job| {
        touchpath::job::plan(job)
            .expect("a plan")
            .program
            .text
            .len()
    };
    println!("{}", jobs[skip..].iter().map(bytes).sum::<usize>());
}

/// What callgrind counts: `--toggle-collect=*counted*`.
#[cfg(not(target_arch = "wasm32"))]
#[inline(never)]
fn counted(work: &mut dyn FnMut()) {
    work();
    std::hint::black_box(());
}
