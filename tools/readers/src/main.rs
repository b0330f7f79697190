//! Reads a program with each crate in turn, round by round, and prints a line each: its name, and the microseconds of the clock (lower
//! quartile), or `refused`. Each gives what it has: Touchpath moves with places and feeds, the others words.

use std::hint::black_box;
use std::time::Instant;

/// A reader by its name: whether it takes the program.
type Reader = (&'static str, fn(&str) -> bool);

const READERS: [Reader; 3] = [
    ("touchpath", |text| !touchpath::import::read_program(text, None).kind.is_empty()),
    ("gcode", |text| gcode::parse(text).is_ok()),
    ("g-code", |text| g_code::parse::file_parser(text).is_ok()),
];

fn main() {
    let path = std::env::args().nth(1).expect("a file");
    let text = std::fs::read_to_string(path).expect("a file that can be read");
    let rounds = (400_000 / text.len()).clamp(5, 200);
    let mut times = READERS.map(|_| Vec::new());
    for _ in 0..rounds {
        for ((_, read), times) in READERS.iter().zip(&mut times) {
            let start = Instant::now();
            black_box(read(black_box(&text)));
            times.push(start.elapsed().as_nanos());
        }
    }
    for ((name, read), mut times) in READERS.into_iter().zip(times) {
        times.sort_unstable();
        let micros = times[times.len() / 4] as f64 / 1000.0;
        println!("{name} {}", if read(&text) { format!("{micros:.1}") } else { "refused".to_owned() });
    }
}
