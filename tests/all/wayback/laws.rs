//! For any job and any part: a machine's reports give the results of its points.

use crate::common::{law, point, with};
use crate::tests::laws::whole_job;
use proptest::prelude::*;
use touchpath::form::Value;
use touchpath::job::{ResultRow, Triple, evaluate, measure, plan, planned};

/// As grbl prints it, in mm or in inch.
fn report(place: Triple, inch: bool) -> (String, Triple) {
    let (unit, places) = if inch { (25.4, 4) } else { (1.0, 3) };
    let texts = place.map(|x| format!("{:.places$}", x / unit));
    let read = [0, 1, 2].map(|i| texts[i].parse::<f64>().unwrap() * unit);
    (texts.join(","), read)
}

/// Random jobs on displaced parts, a random work offset, mm or inch: the log gives the results of its reported points, and after the block the measured datum
/// reads its nominal value.
#[test]
fn a_log_gives_what_its_points_give() {
    let place = || proptest::array::uniform3(-300.0..300.0f64);
    let blocks = std::cell::Cell::new(0);
    law(
        400,
        60,
        (whole_job(), place(), 1..=6u8, any::<bool>(), any::<bool>()),
        |(job, wco, offset, inch, inch_job)| {
            let job = with(&job, "control", crate::common::job(r#"{ "post": "grbl" }"#));
            let job = if inch_job {
                touchpath::job::convert_units(&job, "inch").unwrap()
            } else {
                job
            };
            let Ok(predicted) = plan(&job) else {
                return Ok(false);
            };
            let scale = if inch_job { 25.4 } else { 1.0 };
            let Some(triggers) = predicted
                .triggers
                .iter()
                .copied()
                .collect::<Option<Vec<Triple>>>()
            else {
                return Ok(false);
            };
            if triggers.is_empty() {
                return Ok(false);
            }
            let (wco_text, wco) = report(wco, inch);
            // Touches are reported in the order of the moves.
            let order = predicted
                .moves
                .iter()
                .filter(|m| m.kind == "touch")
                .map(|m| m.touch.unwrap());
            let mut points = triggers.clone();
            let mut log = format!("$13={}\nG{}\nWCO:{wco_text}\n", u8::from(inch), 53 + offset);
            for k in order {
                let (text, read) = report([0, 1, 2].map(|i| triggers[k][i] * scale + wco[i]), inch);
                log += &format!("[PRB:{text}:1]\nok\n");
                points[k] = [0, 1, 2].map(|i| (read[i] - wco[i]) / scale);
            }
            let list = Value::List(points.iter().map(|p| point(*p)).collect());
            let Ok(rows) = evaluate(&job, &list) else {
                return Ok(false);
            };
            let found = match measure(&job, &Value::Text(log.clone())) {
                Ok(found) => found,
                Err(error) => {
                    return Err(TestCaseError::fail(format!("{log}\n{:#?}", error.findings)));
                }
            };
            // A circle of touches at one position amplifies the last bits of a log.
            let apart = |a: &Triple, b: &Triple| {
                (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt() > 0.1
            };
            let close = (1..points.len())
                .any(|i| points[..i].iter().any(|other| !apart(other, &points[i])));
            let noise = |x: f64| if close { 1e-5 } else { 1e-6 } * (1.0 + x.abs());
            for (a, b) in rows.iter().zip(&found.results) {
                prop_assert_eq!(&a.code, &b.code);
                prop_assert_eq!(a.value.is_some(), b.value.is_some());
                if let (Some(a), Some(b)) = (a.value, b.value) {
                    prop_assert!((a - b).abs() < noise(a), "{} {}", a, b);
                }
            }
            let Some(block) = found.block else {
                return Ok(true);
            };
            blocks.set(blocks.get() + 1);
            prop_assert!(block.len() <= 70 && block.is_ascii(), "{}", block);
            let words: Vec<&str> = block.split(' ').collect();
            prop_assert_eq!(
                &words[..3],
                &[if inch_job { "G20" } else { "G21" }, "G10", "L20"]
            );
            prop_assert_eq!(words[3], format!("P{offset}"));
            // The datum from the results: the measured position moves to its nominal one by the change of the displayed end position.
            let planned = planned(&job).unwrap();
            let datum = planned.path.formula.datum.unwrap();
            let end = predicted.moves.last().unwrap().to;
            for (i, place) in datum.place.iter().enumerate() {
                let axis = planned.job.setup.plane.axes()[i];
                let word = words[4..]
                    .iter()
                    .find(|word| word.starts_with(["X", "Y", "Z"][axis]));
                let Some(variable) = place.and_then(|place| place.measured) else {
                    prop_assert!(word.is_none(), "{}", block);
                    continue;
                };
                let reads: f64 = word.expect("a word").get(1..).unwrap().parse().unwrap();
                prop_assert!(
                    word.unwrap()
                        .split_once('.')
                        .is_none_or(|(_, decimals)| decimals.len() <= 4),
                    "{}",
                    block
                );
                let Some(at) = planned
                    .path
                    .formula
                    .results
                    .iter()
                    .position(|r| r.variable == Some(variable))
                else {
                    continue;
                };
                let measured = found.results[at].value.unwrap();
                // The machine is at end + WCO; G10 L20 sets the offset to that position minus `reads`; the datum is at measured + WCO.
                let machine = end[axis] + wco[axis] / scale;
                let new_offset = machine - reads;
                let now = measured + wco[axis] / scale - new_offset;
                prop_assert!(
                    (now - place.unwrap().nominal / scale).abs() < 6e-5,
                    "{} reads {}",
                    block,
                    now
                );
            }
            Ok(true)
        },
    );
    assert!(blocks.get() > 30, "only {} blocks", blocks.get());
}

/// Printed results give rows with these values, like points.
#[test]
fn printed_results_give_their_rows() {
    law(900, 80, (whole_job(), any::<bool>()), |(job, dprnt)| {
        let Ok(predicted) = plan(&job) else {
            return Ok(false);
        };
        let planned = planned(&job).unwrap();
        let defs = planned
            .path
            .formula
            .results
            .iter()
            .filter(|def| def.variable.is_some());
        let rows = defs.filter_map(|def| {
            predicted
                .results
                .iter()
                .find(|row| row.code == def.code && row.value.is_some())
        });
        let rows: Vec<&ResultRow> = rows.collect();
        if rows.is_empty() {
            return Ok(false);
        }
        let printed = |row: &&ResultRow| match (dprnt, row.value.unwrap()) {
            (true, x) => format!("{} = {x:10.6}\n", row.code.to_uppercase().replace('.', " ")),
            (false, x) => format!("{}={x:.6}\n", row.code),
        };
        let text: String = rows.iter().map(printed).collect();
        let found = match measure(&job, &Value::Text(text.clone())) {
            Ok(found) => found,
            Err(error) => {
                return Err(TestCaseError::fail(format!(
                    "{text}\n{:#?}",
                    error.findings
                )));
            }
        };
        prop_assert!(found.points.is_empty() && found.block.is_none());
        for row in rows {
            let read = found
                .results
                .iter()
                .find(|read| read.code == row.code)
                .unwrap();
            prop_assert!((row.value.unwrap() - read.value.unwrap()).abs() < 1e-6);
            prop_assert!((row.deviation.unwrap() - read.deviation.unwrap()).abs() < 1e-6);
            prop_assert_eq!(row.limits, read.limits);
        }
        Ok(true)
    });
}

/// Any lines of a log may be lost or repeated: it is refused, or gives the same points and no other block.
#[test]
fn a_log_with_lines_lost_or_twice_is_refused_or_gives_the_same() {
    let pocket = super::pocket();
    let answer = "[G54:-200.000,-150.000,-60.000]\n[G55:-10.000,0.000,0.000]\n[G92:0.000,0.000,0.000]\n[TLO:0.000]\n\
        [PRB:0.000,0.000,0.000:0]\nok\n";
    let log = format!("{answer}{}", super::UGS);
    let whole = super::measured(&pocket, &log);
    let lines: Vec<&str> = log.lines().collect();
    let times = prop_oneof![1 => Just(0usize), 12 => Just(1), 1 => Just(2)];
    law(
        2000,
        300,
        proptest::collection::vec(times, lines.len()),
        |times| {
            let text: String = lines
                .iter()
                .zip(&times)
                .flat_map(|(line, n)| std::iter::repeat_n(format!("{line}\n"), *n))
                .collect();
            let Ok(found) = measure(&pocket, &Value::Text(text.clone())) else {
                return Ok(false);
            };
            prop_assert_eq!(&found.points, &whole.points, "{}", text);
            prop_assert!(
                found.block.is_none() || found.block == whole.block,
                "{}\n{:?}",
                text,
                found.block
            );
            Ok(true)
        },
    );
}

/// Touches are reported in the order of their moves: those of every job are made in their order, as texts with a point per line require.
#[test]
fn touches_are_made_in_their_order() {
    for (name, job) in crate::common::jobs() {
        let Ok(plan) = plan(&job) else { continue };
        let made: Vec<usize> = plan
            .moves
            .iter()
            .filter(|m| m.kind == "touch")
            .map(|m| m.touch.unwrap())
            .collect();
        assert_eq!(made, (0..plan.touches.len()).collect::<Vec<_>>(), "{name}");
    }
}
