//! How long a form edit takes to become a whole plan, natively. `npm run bench` runs this beside the same in WebAssembly.
//! Prints one line a job: name, touches, nanoseconds.
#![allow(missing_docs, reason = "a bench is a program")]

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    use std::hint::black_box;
    use std::time::Instant;
    use touchpath::job::{from_json, plan};

    for entry in std::env::args().skip(1).filter(|a| !a.starts_with("--")) {
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
            println!("  {stage}: {name} {touches} {}", least.min().expect("there are rounds"));
        });
    }
}
