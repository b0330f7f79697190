//! What a control will measure on a displaced part, and what follows from what it measured: `cargo run --example measured`.

use touchpath::form::Value;
use touchpath::job::{from_json, measure, plan};

fn main() {
    let pocket = r#"{ "format": 1, "cycle": { "type": "internal-rectangle", "width1": 80, "width2": 50 },
        "part": { "offset": [0.1, -0.2, 0], "sizes": { "width1": 0.04 } } }"#;
    let job = from_json(pocket).expect("this is a job");
    for row in plan(&job).expect("this job is good").results {
        println!(
            "{:10} {:?} {}, ± {:?} at one sigma",
            row.code, row.value, row.unit, row.uncertainty
        );
    }

    // The ball centres as the machine printed them, in work coordinates and in the order of the touches: 37.1 − (−36.9) + 6 is 80 wide.
    let printed = Value::Text("37.1,0,-10\n-36.9,0,-10\n0,22.2,-10\n0,-21.8,-10".to_owned());
    let found = measure(&job, &printed).expect("four points");
    for row in &found.results {
        println!(
            "{:10} {:?} {}, {:?} off",
            row.code, row.value, row.unit, row.deviation
        );
    }
    let width = found
        .results
        .iter()
        .find(|row| row.code == "width1")
        .and_then(|row| row.value);
    assert!(width.is_some_and(|width| (width - 80.0).abs() < 1e-9));
}

#[test]
fn it_runs() {
    main();
}
