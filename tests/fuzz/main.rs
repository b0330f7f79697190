//! The laws as a fuzzer: whole jobs over every cycle, control, plane and unit, and mutated dumps, programs and measured points for every reader. A job that
//! breaks a law is stored in `target/fuzz/` and reported.
//!
//! `FUZZ_JOBS` sets the number of jobs (0 by default: a plain `cargo test` runs no jobs), `FUZZ_SEED` the start of the fresh ones. `npm run fuzz` runs until it is
//! stopped.

#[path = "../common/mod.rs"]
mod common;
mod draw;
mod jobs;
mod readers;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use draw::Draw;
use touchpath::form::Value;

/// Seed of every run.
const FIXED: u64 = 20_261_121;

/// Number of jobs for this seed.
struct Share {
    seed: u64,
    jobs: u64,
}

/// Number of times that each law was tested.
type Tally = BTreeMap<String, u64>;

fn main() {
    let asked = |name: &str| {
        std::env::var(name)
            .ok()
            .and_then(|text| text.parse::<u64>().ok())
    };
    let count = asked("FUZZ_JOBS").unwrap_or(0);
    if count == 0 {
        println!("fuzz: FUZZ_JOBS is not set: nothing is run");
        return;
    }
    let now = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .map_or(1, |d| d.as_nanos() as u64);
    let fresh = asked("FUZZ_SEED").unwrap_or(now);
    println!("fuzz: {count} jobs, seeds {FIXED} and {fresh} (FUZZ_SEED={fresh} runs them again)");
    // A panic is caught and reported with its job; its message is printed once, there.
    std::panic::set_hook(Box::new(|_| {}));
    let start = Instant::now();
    let fixed = Share {
        seed: FIXED,
        jobs: count / 4,
    };
    let (mut tally, known) = run(&fixed);
    // The jobs that are the same in every run decide whether a law is tested often enough, so no run fails by chance.
    let idle = idle(&tally, fixed.jobs);
    let (drawn, new) = run(&Share {
        seed: fresh,
        jobs: count - fixed.jobs,
    });
    add(&mut tally, drawn);
    let failed = known + new;
    for (law, times) in &tally {
        println!("  {times:>9}  {law}");
    }
    println!(
        "fuzz: {count} jobs in {:.1} s, {failed} failures",
        start.elapsed().as_secs_f64()
    );
    for law in &idle {
        println!("fuzz: {law} was hardly asked: the law says nothing");
    }
    if failed > 0 || !idle.is_empty() {
        std::process::exit(1);
    }
}

fn add(tally: &mut Tally, more: Tally) {
    for (law, times) in more {
        *tally.entry(law).or_insert(0) += times;
    }
}

/// Laws and kinds of jobs that too few jobs reached.
fn idle(tally: &Tally, count: u64) -> Vec<String> {
    let least = count / 2000;
    let catalog = touchpath::describe::catalog();
    let kinds = catalog.cycles.iter().map(|c| format!("planned {}", c.key));
    let posts = catalog
        .posts
        .iter()
        .map(|p| format!("planned for {}", p.id));
    let laws = [
        "inch and mm",
        "dump and job",
        "program and job",
        "remembered lines",
        "mutated text",
        "measured points",
        "planned as a set-up",
        "planned with relations",
        "planned with relations that are followed",
        "planned with consequences",
        "planned with places that follow",
        "planned with rotations that follow",
        "planned with sizes that follow",
        "planned with tools that are corrected",
        "planned with tools that moves correct",
        "planned with repeated touches",
    ]
    .map(str::to_owned);
    let others = ["G17", "G18", "G19", "mm", "inch", "checked", "none"]
        .map(|word| format!("planned in {word}"));
    kinds
        .chain(posts)
        .chain(laws)
        .chain(others)
        .filter(|name| tally.get(name).copied().unwrap_or(0) < least)
        .collect()
}

/// Runs a share of the jobs on every core; returns the number of tests of each law and the number of failures.
fn run(share: &Share) -> (Tally, usize) {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get()) as u64;
    let (tally, failures) = (Mutex::new(Tally::new()), Mutex::new(0usize));
    let catalog = touchpath::describe::catalog();
    std::thread::scope(|scope| {
        for thread in 0..threads {
            let (tally, failures, catalog) = (&tally, &failures, &catalog);
            scope.spawn(move || {
                let mut own = Tally::new();
                for index in (thread..share.jobs).step_by(threads as usize) {
                    let mut draw =
                        Draw::new(share.seed ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
                    let job = jobs::whole(catalog, &mut draw, index);
                    let result =
                        catch_unwind(AssertUnwindSafe(|| jobs::laws(&job, &mut draw, &mut own)));
                    let why = match result {
                        Ok(Ok(())) => continue,
                        Ok(Err(why)) => why,
                        Err(panic) => format!("panic: {}", message(&*panic)),
                    };
                    let mut failures = failures.lock().expect("no thread panics with it");
                    *failures += 1;
                    if *failures <= 20 {
                        println!(
                            "fuzz: job {index} of seed {}: {why}\n      kept as {}",
                            share.seed,
                            keep(&job, share.seed, index)
                        );
                    }
                }
                add(&mut tally.lock().expect("no thread panics with it"), own);
            });
        }
    });
    (
        tally.into_inner().expect("every thread has ended"),
        failures.into_inner().expect("every thread has ended"),
    )
}

fn message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()))
        .unwrap_or_else(|| "no message".to_owned())
}

/// Writes a job that broke a law to a file, so that it can be run again.
fn keep(job: &Value, seed: u64, index: u64) -> String {
    let folder = std::env::var("CARGO_TARGET_DIR")
        .unwrap_or_else(|_| format!("{}/target", env!("CARGO_MANIFEST_DIR")));
    let path = format!("{folder}/fuzz/{seed}-{index}.json");
    let kept = std::fs::create_dir_all(format!("{folder}/fuzz"))
        .and_then(|()| std::fs::write(&path, jobs::json(job)));
    kept.map_or_else(|why| format!("nothing: {why}"), |()| path)
}
