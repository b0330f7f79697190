//! Points that are touched several times: means, spread, and their consequences.

use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{
    ending_at, import, interpret, interpret_until_stop, job, number, planned, with,
};
use crate::tests::controls::computing;
use touchpath::describe::catalog;
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, check, evaluate, plan};

fn text(word: &str) -> Value {
    Value::Text(word.to_owned())
}

fn repeated(cycle: &str, post: &str, times: f64, more: &str) -> Value {
    let one = format!(
        r#"{{ "format": 1, "name": "REPEAT", "control": {{ "post": "{post}", "form": "moves", "workOffset": 1, "report": "screen" }},
             "limits": {{ "position": 1 }}, "cycle": {cycle} {more} }}"#
    );
    with(
        &job(&one),
        "cycle.repeat",
        Value::Map(vec![
            ("times".into(), number(times)),
            ("spread".into(), number(0.02)),
        ]),
    )
}

/// Deviation of touch k of a machine with poor repeatability: a few micrometres, different for each.
fn noise(k: usize) -> f64 {
    ((k * 7 + 3) % 11) as f64 * 1e-3
}

/// Triggers of a plan, each shifted by its noise along its probing direction.
fn scattered(plan: &Plan) -> Vec<[f64; 3]> {
    let of = |(k, touch): (usize, &touchpath::job::TouchPoint)| {
        let trigger = plan.triggers[k].expect("every touch meets the part");
        [0, 1, 2].map(|axis| trigger[axis] - noise(k) * touch.vector[axis])
    };
    plan.touches.iter().enumerate().map(of).collect()
}

fn points_of(points: &[[f64; 3]]) -> Value {
    Value::List(
        points
            .iter()
            .map(|point| Value::List(point.map(Value::Number).to_vec()))
            .collect(),
    )
}

const CYCLES: [&str; 7] = [
    r#"{ "type": "hole", "diameter": 25 }"#,
    r#"{ "type": "boss", "diameter": 30, "rotation": 20 }"#,
    r#"{ "type": "hole", "diameter": 40, "variant": 1, "angularStep": 50, "stepCount": 7 }"#,
    r#"{ "type": "internal-rectangle-protected", "rotation": 33 }"#,
    r#"{ "type": "double-wall-internal-corner" }"#,
    r#"{ "type": "surface", "elevation": 60 }"#,
    r#"{ "type": "wall-angle" }"#,
];

/// LinuxCNC's interpreter with poorly repeating touches: each result equals that of a job without repeats for the means, and the spread is the largest distance
/// between touches of one point, both by hand.
#[test]
fn means_count_and_the_spread_is_told() {
    for cycle in CYCLES {
        for times in [2usize, 3] {
            let own = repeated(
                cycle,
                "linuxcnc",
                times as f64,
                r#", "part": { "offset": [0.2, 0.1, 0] }"#,
            );
            let plan = planned(&own);
            let once = with(&own, "cycle.repeat", Value::Null);
            assert_eq!(
                plan.touches.len(),
                times * planned(&once).touches.len(),
                "{cycle}"
            );
            let triggers = scattered(&plan);
            let ran = interpret(&ending_at(&plan, |k| triggers[k]))
                .unwrap_or_else(|why| panic!("{cycle}: {why}"));
            let means: Vec<[f64; 3]> = triggers
                .chunks(times)
                .map(|same| {
                    [0, 1, 2].map(|axis| same.iter().map(|p| p[axis]).sum::<f64>() / times as f64)
                })
                .collect();
            // LinuxCNC fits a circle in basic arithmetic: both get the same triggers.
            let nominal = interpret(&ending_at(&planned(&once), |k| means[k])).unwrap();
            let (spread, results) = ran.prints.split_last().expect("results");
            assert_eq!(results.len(), nominal.prints.len(), "{cycle}");
            for ((code, value), (wanted_code, wanted)) in results.iter().zip(&nominal.prints) {
                assert_eq!(code, wanted_code);
                assert!(
                    (value - wanted).abs() < 2e-6,
                    "{cycle}, {code}: {value}, of the means {wanted}"
                );
            }
            let apart = (0..plan.touches.len()).collect::<Vec<_>>();
            let apart = apart.chunks(times).map(|same| {
                let off = || same.iter().map(|k| noise(*k));
                off().fold(f64::NEG_INFINITY, f64::max) - off().fold(f64::INFINITY, f64::min)
            });
            let wanted = apart.fold(0.0, f64::max);
            assert_eq!(spread.0, "spread");
            assert!(
                (spread.1 - wanted).abs() < 2e-6,
                "{cycle}: {} apart, by hand {wanted}",
                spread.1
            );
            // And the page's results from the points.
            let rows = evaluate(&own, &points_of(&triggers)).unwrap();
            let row = rows.iter().find(|row| row.code == "spread").unwrap();
            assert!((row.value.unwrap() - wanted).abs() < 1e-6, "{cycle}");
            assert!(ran.written.is_some(), "{cycle}");
        }
    }
}

/// One touch of twelve is 0.03 mm from the others of its point: every control stops and writes nothing. At 0.01 mm it writes.
#[test]
fn touches_that_are_too_far_apart_stop_the_write() {
    let mut stopped = 0;
    for post in computing() {
        let plan = planned(&repeated(CYCLES[0], post, 3.0, ""));
        for bad in [1, 6, 11] {
            for off in [0.03, -0.03, 0.01] {
                let triggers: Vec<[f64; 3]> = (0..plan.touches.len())
                    .map(|k| {
                        let (point, along) = (plan.triggers[k].unwrap(), plan.touches[k].vector);
                        [0, 1, 2].map(|axis| {
                            point[axis] - if k == bad { off * along[axis] } else { 0.0 }
                        })
                    })
                    .collect();
                let good = off == 0.01;
                match post {
                    "linuxcnc" => {
                        let (ran, why) = interpret_until_stop(&ending_at(&plan, |k| triggers[k]));
                        assert_eq!(
                            (ran.written.is_some(), why.is_none()),
                            (good, good),
                            "{post} {bad} {off}: {why:?}"
                        );
                        assert!(good || why.unwrap().contains("spread is"));
                    }
                    "sinumerik" => {
                        let mut machine =
                            Machine::new(triggers.iter().map(|point| Some(*point)).collect());
                        machine.run(&read(&plan.program.text).unwrap()).unwrap();
                        assert_eq!(machine.alarm.is_none(), good, "{post} {bad} {off}");
                        assert!(
                            good || machine.message.contains("spread"),
                            "{}",
                            machine.message
                        );
                    }
                    _ => {
                        let mut control = Control::new(post == "haas", false);
                        control.contacts = triggers.clone();
                        control
                            .variables
                            .extend((5221..5224).map(|number| (number, 0.0)));
                        control.run(&plan.program.text).unwrap();
                        assert_eq!(
                            control.alarm.is_none(),
                            good,
                            "{post} {bad} {off}: {:?}",
                            control.alarm
                        );
                        assert!(
                            good || format!("{:?}", control.alarm).contains("SPREAD"),
                            "{:?}",
                            control.alarm
                        );
                    }
                }
                stopped += usize::from(!good);
            }
        }
    }
    assert_eq!(stopped, 6 * computing().len());
}

/// The mean of n touches scatters by 1/√n of one; the eccentricity of the ball moves all of them alike.
#[test]
fn the_uncertainty_is_that_of_a_mean() {
    for cycle in CYCLES {
        let once = with(
            &repeated(cycle, "linuxcnc", 1.0, ""),
            "stylus.runout",
            number(0.004),
        );
        let (one, three) = (
            planned(&once),
            planned(&with(&once, "cycle.repeat.times", number(3.0))),
        );
        let mut compared = 0;
        for row in one
            .results
            .iter()
            .filter(|row| row.uncertainty.is_some_and(|sigma| sigma > 1e-9))
        {
            let own = three
                .results
                .iter()
                .find(|own| own.code == row.code)
                .unwrap();
            let touches = |row: &touchpath::job::ResultRow| {
                let runout = row.uncertainty_runout.unwrap_or(0.0);
                (row.uncertainty.unwrap().powi(2) - runout * runout).sqrt()
            };
            assert!(
                (touches(own) - touches(row) / 3f64.sqrt()).abs() < 1e-7,
                "{cycle}, {}",
                row.code
            );
            assert!(
                (own.uncertainty_runout.unwrap() - row.uncertainty_runout.unwrap()).abs() < 1e-7,
                "{cycle}, {}",
                row.code
            );
            compared += 1;
        }
        assert!(compared > 0, "{cycle}");
        assert!(three.results.iter().any(|row| row.code == "spread"
            && row.uncertainty.is_none()
            && row.value == Some(0.0)));
    }
}

/// Every cycle that touches, on every control with programs of moves: proven, with the parameter table as without repeats, and the program's header becomes the
/// job again.
#[test]
fn every_cycle_repeats_on_every_control_that_is_given_moves() {
    let all = catalog();
    let mut planned_jobs = 0;
    for entry in all.cycles.iter().filter(|entry| entry.max_touches > 0) {
        assert!(
            entry.sections.iter().any(|section| section.key == "repeat"),
            "{}",
            entry.key
        );
        for post in &all.posts {
            for form in ["moves", "cycle"] {
                let once = format!(
                    r#"{{ "format": 1, "control": {{ "post": "{}", "form": "{form}" }}, "cycle": {{ "type": "{}" }} }}"#,
                    post.id, entry.key
                );
                let Ok(one) = plan(&job(&once)) else { continue };
                let own = with(
                    &job(&once),
                    "cycle.repeat",
                    Value::Map(vec![("times".into(), number(3.0))]),
                );
                if form == "cycle" {
                    let findings = check(&own);
                    assert!(
                        findings
                            .iter()
                            .any(|f| f.code == "repeat-unsupported" && f.path == "cycle.repeat"),
                        "{findings:?}"
                    );
                    continue;
                }
                let three = planned(&own);
                assert_eq!(three.touches.len(), 3 * one.touches.len());
                // The table is the cycle's: each row of a touch has the first one of its point.
                for (row, own) in one.table.iter().zip(&three.table) {
                    assert_eq!(
                        (&row.code, &row.value),
                        (&own.code, &own.value),
                        "{} on {}",
                        entry.key,
                        post.id
                    );
                    assert_eq!(
                        row.touch.map(|k| one.touches[k].point),
                        own.touch.map(|k| three.touches[k].point),
                        "{}",
                        row.code
                    );
                    assert!(own.touch.is_none_or(|k| k % 3 == 0), "{}", row.code);
                }
                assert_eq!(three.table.len(), one.table.len());
                let again = import(&three.program.text).unwrap().job;
                assert_eq!(
                    again
                        .get("cycle")
                        .and_then(|c| c.get("repeat"))
                        .and_then(|r| r.get("times")),
                    Some(&number(3.0))
                );
                planned_jobs += 1;
            }
        }
    }
    assert!(planned_jobs > 60, "{planned_jobs}");
}

/// The form errors of 1411 come from the means, and a finding about a picked touch has the number of the pick.
#[test]
fn what_is_beyond_the_formula_is_of_the_points() {
    let circles = r#"{ "type": "probing-two-circles", "probePoints": 4 }"#;
    let own = repeated(circles, "linuxcnc", 3.0, "");
    let plan = planned(&own);
    let triggers = scattered(&plan);
    let means: Vec<[f64; 3]> = triggers
        .chunks(3)
        .map(|same| [0, 1, 2].map(|axis| same.iter().map(|p| p[axis]).sum::<f64>() / 3.0))
        .collect();
    let form = |job: &Value, points: &[[f64; 3]]| {
        let rows = evaluate(job, &points_of(points)).unwrap();
        ["form1", "form2"].map(|code| {
            rows.iter()
                .find(|row| row.code == code)
                .and_then(|row| row.value)
                .expect("a form error")
        })
    };
    let (three, once) = (
        form(&own, &triggers),
        form(&with(&own, "cycle.repeat", Value::Null), &means),
    );
    for (own, wanted) in three.iter().zip(once) {
        assert!(
            wanted > 1e-4 && (own - wanted).abs() < 1e-6,
            "{own}, of the means {wanted}"
        );
    }
    let picks =
        r#"{ "type": "surface", "touches": [{ "point": [0, 0, 0], "vector": [0, 0, 1] }] }"#;
    let hole = r#"{ "type": "hole", "diameter": 6.03, "touches": [
        { "point": [3.015, 0, -10], "vector": [-1, 0, 0] }, { "point": [-3.015, 0, -10], "vector": [1, 0, 0] },
        { "point": [0, 3.015, -10], "vector": [0, -1, 0] }, { "point": [0, -3.015, -10], "vector": [0, 1, 0] }] }"#;
    assert!(
        check(&repeated(picks, "linuxcnc", 3.0, ""))
            .iter()
            .all(|f| f.level != Level::Error)
    );
    let paths = |job: &Value| {
        let of = |f: touchpath::form::Finding| {
            (f.code == "touch-close" || f.code == "touch-too-short").then_some(f.path)
        };
        check(job).into_iter().filter_map(of).collect::<Vec<_>>()
    };
    let tight = repeated(hole, "linuxcnc", 3.0, "");
    let (many, one) = (
        paths(&tight),
        paths(&with(&tight, "cycle.repeat", Value::Null)),
    );
    assert!(
        !one.is_empty() && one.iter().all(|path| path.starts_with("cycle.touches[")),
        "{one:?}"
    );
    assert_eq!(many, one);
}

/// A tolerance of the spread may reach its limit, and no farther; points of extrusion probing are not repeated.
#[test]
fn limits_of_the_spread_go_together() {
    let own = repeated(CYCLES[0], "linuxcnc", 2.0, "");
    for (tolerance, action, code) in [
        ("0..0.02", "mark", None),
        ("0..0.02", "stop", None),
        ("0..0.012", "mark", None),
        ("0..0.021", "mark", Some("tolerance-beyond-limit")),
        ("0..0.021", "go", Some("tolerance-beyond-limit")),
    ] {
        let rule = job(&format!(
            r#"{{ "spread": {{ "tolerance": "{tolerance}", "action": "{action}" }} }}"#
        ));
        let found = check(&with(&own, "tolerances", rule));
        let errors: Vec<&str> = found
            .iter()
            .filter(|f| f.level == Level::Error)
            .map(|f| f.code.as_str())
            .collect();
        assert_eq!(
            errors,
            Vec::from_iter(code),
            "{tolerance} {action}: {found:?}"
        );
    }
    // As for every result whose tolerance reaches its limit.
    let size = with(
        &own,
        "tolerances",
        job(r#"{ "diameter": { "tolerance": "±0.5", "action": "mark" } }"#),
    );
    assert!(
        check(&size).iter().all(|f| f.level != Level::Error),
        "{:?}",
        check(&size)
    );
    // The limit of the program is that of the job, for any tolerance.
    assert!(
        planned(&with(
            &own,
            "tolerances",
            job(r#"{ "spread": { "tolerance": "0..0.006", "action": "mark" } }"#)
        ))
        .program
        .text
        .contains("GT 0.02]")
    );
    let circles = job(
        r#"{ "format": 1, "control": { "post": "linuxcnc", "form": "moves" },
             "cycle": { "type": "probing-two-circles", "extrusion": { "points": 2 }, "repeat": { "times": 2 } } }"#,
    );
    assert!(
        check(&circles)
            .iter()
            .any(|f| f.code == "repeat-unsupported" && f.path == "cycle.repeat"),
        "{:?}",
        check(&circles)
    );
    assert!(plan(&with(&circles, "cycle.extrusion", Value::Null)).is_ok());
}

/// In a set-up each cycle has its own repeats, and its spread can have a tolerance like any result.
#[test]
fn a_cycle_of_a_set_up_repeats_for_itself() {
    let own = job(
        r#"{ "format": 2, "control": { "post": "linuxcnc", "report": "screen" }, "cycles": [
            { "name": "TOP", "type": "surface", "origin": [-40, 0, 0] },
            { "name": "BORE", "type": "hole", "diameter": 25, "repeat": { "times": 3 } } ],
            "tolerances": { "BORE.spread": { "tolerance": "0..0.004", "action": "stop" } } }"#,
    );
    let plan = planned(&own);
    assert_eq!(plan.touches.len(), 1 + 12);
    let triggers = |off: f64| {
        let plan = plan.clone();
        move |k: usize| {
            let (point, along) = (plan.triggers[k].unwrap(), plan.touches[k].vector);
            [0, 1, 2].map(|axis| point[axis] - if k == 5 { off * along[axis] } else { 0.0 })
        }
    };
    assert!(interpret(&ending_at(&plan, triggers(0.003))).is_ok());
    let why = interpret(&ending_at(&plan, triggers(0.006))).unwrap_err();
    assert!(why.contains("BORE.spread is"), "{why}");
    let bad = with(&own, "control.form", text("moves"));
    let bad = with(&bad, "cycles", {
        let Some(Value::List(mut cycles)) = own.get("cycles").cloned() else {
            unreachable!()
        };
        cycles[1] = with(&cycles[1], "repeat.times", number(9.0));
        Value::List(cycles)
    });
    assert!(
        check(&bad)
            .iter()
            .any(|f| f.path == "cycles[1].repeat.times" && f.code == "out-of-range"),
        "{:?}",
        check(&bad)
    );
}
