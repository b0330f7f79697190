//! Native calls as rows: a generated call is read back unchanged, and foreign calls are read with their additional words.

use std::collections::BTreeMap;

use super::klartext_cycles::blocks;
use super::own_cycles::own;
use crate::common::{Draws, number, point as list, with};
use touchpath::form::Value;
use touchpath::job::plan;

/// A random job of a feature that native cycles support: any position, size and side, with or without a work offset.
fn drawn(draws: &mut Draws, cycle: &'static str, post: &str) -> Value {
    let mut length = |low: f64, high: f64| number((draws.of(low, high) * 1000.0).round() / 1000.0);
    let origin = vec![
        length(-90.0, 90.0),
        length(-90.0, 90.0),
        length(-20.0, 20.0),
    ];
    let mut changes = vec![("cycle.origin", Value::List(origin))];
    match cycle {
        "surface" => changes.push(("cycle.clearance", length(6.0, 15.0))),
        "hole" | "hole-protected" | "boss" => changes.push(("cycle.diameter", length(40.0, 90.0))),
        "web" | "groove" | "groove-protected" => changes.push(("cycle.width", length(40.0, 90.0))),
        _ => changes.extend([
            ("cycle.width1", length(60.0, 90.0)),
            ("cycle.width2", length(40.0, 50.0)),
        ]),
    }
    if cycle != "surface" {
        changes.push(("cycle.depth", length(4.0, 12.0)));
    }
    let [quarter, level, row] = [4, 3, 3].map(|of| draws.below(of) as f64);
    match cycle {
        "surface" if level == 0.0 => changes.push(("cycle.elevation", number(90.0))),
        "surface" => changes.extend([
            ("cycle.elevation", number(0.0)),
            (
                "cycle.rotation",
                number([0.0, 90.0, 180.0, -90.0][quarter as usize]),
            ),
        ]),
        "web" | "groove" | "groove-protected" => {
            changes.push(("cycle.rotation", number(90.0 * (quarter % 2.0))));
        }
        _ => {}
    }
    let offset = if row == 0.0 { Value::Null } else { number(row) };
    changes.push(("control.workOffset", offset));
    own(cycle, post, &changes)
}

/// Measuring cycles of a program: number, and values by position.
fn measuring_calls(text: &str) -> Vec<(u32, Vec<(u32, f64)>)> {
    let calls = text
        .lines()
        .filter_map(|line| line.strip_prefix("CYCLE")?.split_once('('));
    let given = |arguments: &str| {
        let arguments = arguments.trim_end_matches(')').split(',').zip(1..);
        arguments
            .filter_map(|(value, place)| Some((place, value.parse().ok()?)))
            .collect()
    };
    calls
        .map(|(number, arguments)| (number.parse().unwrap(), given(arguments)))
        .collect()
}

/// Measuring macros of a program: number, and values by letter.
fn macro_calls(text: &str) -> Vec<(u32, Vec<(u32, f64)>)> {
    let calls = text
        .lines()
        .filter_map(|line| line.strip_prefix("G65 P")?.split_once(' '));
    let given = |letters: &str| {
        let words = letters.split(' ').filter_map(|word| {
            let letter = word.chars().next()?;
            Some((u32::from(letter), word[1..].parse().ok()?))
        });
        words.collect()
    };
    let all = calls.map(|(number, letters)| (number.parse().unwrap(), given(letters)));
    all.filter(|(number, _)| !matches!(number, 8810 | 8832 | 8833))
        .collect()
}

/// A call that is read back as a job gives a program with the same words, for any feature at any position. Words for limits and the log are
/// not compared.
#[test]
fn the_words_of_random_calls_are_read_as_they_were_written() {
    use touchpath::import::toolpath::{RunInputs, run_program};
    let kinds = [
        "hole",
        "hole-protected",
        "boss",
        "groove",
        "groove-protected",
        "web",
        "internal-rectangle",
        "internal-rectangle-protected",
        "external-rectangle",
        "surface",
    ];
    type Calls = fn(&str) -> Vec<(u32, Vec<(u32, f64)>)>;
    // Word that distinguishes kinds of calls, words of limits, and number of kinds.
    let of_limits: &[u32] = &[
        275, 276, 277, 278, 279, 280, 281, 284, 285, 286, 287, 288, 289, 309,
    ];
    let sets: [(&str, Calls, u32, &[u32], usize); 3] = [
        ("heidenhain", blocks, 0, of_limits, 15),
        ("sinumerik", measuring_calls, 1, &[], 20),
        ("brother", macro_calls, 0, &[72, 77, 87], 3),
    ];
    for (post, calls, kind, of_limits, count) in sets {
        let mut draws = Draws(1129);
        let mut called: BTreeMap<(u32, i64), usize> = BTreeMap::new();
        for round in 0..600 {
            let cycle = kinds[round % kinds.len()];
            let job = drawn(&mut draws, cycle, post);
            let Ok(first) = plan(&job) else { continue };
            // Calls and the moves to them, without checks of the probe, whose branches would stay open.
            let code = first.program.text.lines().filter_map(|line| match post {
                "heidenhain" => Some(line).filter(|line| !line.contains(" ; ")),
                _ => line.strip_prefix("MEAS=1 ").or_else(|| {
                    let kept = ["G71", "G17", "CYCLE", "G21", "G65"]
                        .iter()
                        .any(|word| line.starts_with(word));
                    kept.then_some(line)
                }),
            });
            let bare: String = code.map(|line| format!("{line}\n")).collect();
            let start = first.moves[0].to;
            let run = run_program(
                &bare,
                &RunInputs {
                    start: Some([start[0], start[1], start[2]]),
                    ..RunInputs::default()
                },
            );
            let again = run.calls.iter().find_map(|call| call.job.clone());
            let again =
                again.unwrap_or_else(|| panic!("{post} {cycle} {job:?}: {:?}\n{bare}", run.calls));
            let again = if post == "heidenhain" {
                with(&again, "overtravel", number(5.0))
            } else {
                again
            };
            let again = with(&again, "control.form", Value::Text("cycle".to_owned()));
            let again =
                plan(&again).unwrap_or_else(|error| panic!("{post} {cycle}: {error:?}\n{again:?}"));
            let of_feature = |text: &str| -> (u32, Vec<(u32, i64)>) {
                let (number, given) = calls(text).swap_remove(0);
                let safe = if post == "sinumerik" {
                    [9, 7][usize::from(number == 978)]
                } else {
                    0
                };
                let kept = given
                    .into_iter()
                    .filter(|(word, _)| !of_limits.contains(word) && *word != safe);
                (
                    number,
                    kept.map(|(word, value)| (word, (value * 1000.0).round() as i64))
                        .collect(),
                )
            };
            let (wanted, read) = (
                of_feature(&first.program.text),
                of_feature(&again.program.text),
            );
            assert_eq!(
                read, wanted,
                "{post} {cycle} {job:?}\n{bare}\n{}",
                again.program.text
            );
            let kind = wanted
                .1
                .iter()
                .find(|(word, _)| *word == kind)
                .map_or(0, |(_, value)| *value);
            *called.entry((wanted.0, kind)).or_default() += 1;
        }
        // Every kind of call, many times.
        assert!(
            called.len() == count && called.values().all(|times| *times >= 5),
            "{post}: {called:?}"
        );
    }
}

/// Foreign calls with words that our programs never write. A call that no job can reproduce makes no job.
#[test]
fn a_foreign_call_is_read_with_the_words_that_it_has() {
    use touchpath::import::toolpath::{RunInputs, run_program};
    let run = |text: &str| {
        let start = Some([40.0, 3.0, 200.0]);
        run_program(
            text,
            &RunInputs {
                start,
                ..RunInputs::default()
            },
        )
    };
    let job_of = |text: &str| run(text).calls.iter().find_map(|call| call.job.clone());
    let klartext = |cycle: &str| format!("BEGIN PGM A MM\nTCH PROBE {cycle}\nEND PGM A MM\n");
    let siemens = |call: &str| format!("G71 G90\nG0 X40 Y3 Z-5\n{call}\n");
    // Three touches 60° apart: a job of 421 has four.
    let hole = "421 Q273=+0 Q274=+0 Q262=+40 Q325=+0 Q261=-5 Q320=+4 Q260=+20 Q301=+0";
    assert_eq!(job_of(&klartext(&format!("{hole} Q247=+60 Q423=+3"))), None);
    assert!(job_of(&klartext(&format!("{hole} Q247=+90 Q423=+4"))).is_some());
    // Straight from touch to touch, not on an arc.
    let arcs = |text: &str| run(text).arcs.len();
    assert_eq!(
        arcs(&klartext(&format!("{hole} Q247=+90 Q423=+4 Q365=+0"))),
        0
    );
    assert_eq!(
        arcs(&klartext(&format!("{hole} Q247=+90 Q423=+4 Q365=+1"))),
        3
    );
    // An arc of many turns is no link move between two touches.
    assert_eq!(
        arcs(&klartext(&format!(
            "{hole} Q247=+1000000000 Q423=+4 Q365=+1"
        ))),
        0
    );
    // 425 with a retract between the walls moves over an island: no generated program does that without writing.
    let slot = "425 Q328=+0 Q329=+0 Q310=+0 Q272=+1 Q261=-5 Q260=+20 Q311=+60";
    assert!(job_of(&klartext(slot)).is_some());
    assert_eq!(job_of(&klartext(&format!("{slot} Q320=+4 Q301=+1"))), None);
    // An unknown centre in the call is not the stylus position.
    let bore = |centre: &str| {
        siemens(&format!(
            "CYCLE977(101,10001,,1,30,,,7,5,0,1,1,,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,{centre})"
        ))
    };
    assert_eq!(job_of(&bore("11,R77,15")), None);
    assert_eq!(job_of(&bore("11,,15")), None);
    assert_eq!(job_of(&bore("11,10")), None);
    let origin = |job: Value| {
        job.get("cycle")
            .and_then(|cycle| cycle.get("origin"))
            .cloned()
    };
    assert_eq!(
        job_of(&bore("11,10,15")).and_then(origin),
        Some(list([10.0, 15.0, 5.0]))
    );
    // CYCLE978 without its variant is run, but makes no job.
    let wall = siemens("CYCLE978(,,,1,10,5,5,1,2,1,,,0)");
    assert_eq!(job_of(&wall), None);
    assert!(run(&wall).len() > 2, "{:?}", run(&wall).kind);
}
