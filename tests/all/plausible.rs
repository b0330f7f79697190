//! Checks of a program before it writes: plausible results, and every touch made in this run.

use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{ending_at, interpret_until_stop, job, number, on_virtual_part, planned, with};
use crate::tests::controls::skipping;
use touchpath::control::{POSTS, ProgramForm};
use touchpath::cycle::CYCLES;
use touchpath::form::Value;
use touchpath::job::{Plan, check, check_program, default_job, evaluate};

/// A hole of 40 mm at the origin, touched at +X, −X, +Y and −Y with a ball of 6 mm.
fn hole(post: &str, offset: &str, more: &str) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": 40 }}, "control": {{ "post": "{post}", "workOffset": {offset} }}{more} }}"#
    ))
}

/// Ball centre at each touch with a chip of 4 mm on the first wall: by hand, 17 − 4 and 17 from the centre.
fn with_a_chip(plan: &Plan) -> Vec<[f64; 3]> {
    let z = plan.triggers[0].unwrap()[2];
    vec![
        [13.0, 0.0, z],
        [-17.0, 0.0, z],
        [0.0, 17.0, z],
        [0.0, -17.0, z],
    ]
}

/// The circle through (13, 0), (−17, 0) and (0, ±17) with the least Σ(x² + y² − 2ax − c)², by hand: the mean of x is −1, Sxx = 454, and with
/// w = x² + y² (169, 289, 289, 289; mean 259) Sxw = 13·169 − 17·289 − 4·(−1)·259 = −1680: a = Sxw/(2·Sxx) = −1.85022,
/// r² = 259 + 2a + a² = 258.722, and the diameter with the ball is 2·16.0849 + 6 = 38.1697.
const CHIP: (f64, f64) = (-1.850_22, 38.1697);

/// A Fanuc or Haas with these contacts.
fn fanuc(plan: &Plan, contacts: Vec<[f64; 3]>) -> Control {
    let mut control = Control::new(plan.program.post == "haas", false);
    control.contacts = contacts;
    for origin in [5221, 5222, 5223] {
        control.variables.insert(origin, 100.0);
    }
    control
}

fn result(plan: &Plan, control: &Control, code: &str) -> f64 {
    let list = plan
        .program
        .text
        .lines()
        .find_map(|line| line.strip_prefix("(RESULTS: "))
        .unwrap();
    let entry = list
        .trim_end_matches(')')
        .split(", ")
        .find(|entry| entry.ends_with(&format!("= {code}")))
        .unwrap();
    control.variables[&entry.split(' ').next().unwrap()[1..].parse().unwrap()]
}

#[test]
fn a_chip_on_the_first_wall_stops_a_fanuc_and_a_haas_before_the_write() {
    for post in skipping() {
        let plan = planned(&hole(post, "1", ""));
        let mut control = fanuc(&plan, with_a_chip(&plan));
        control.run(&plan.program.text).unwrap();
        assert!(
            control
                .alarm
                .as_deref()
                .is_some_and(|alarm| alarm.contains("DIAMETER OFF")),
            "{post}: {:?}",
            control.alarm
        );
        assert!(control.writes.is_empty(), "{post}");
        // The results can still be read.
        assert!((result(&plan, &control, "CENTER.X") - CHIP.0).abs() < 1e-4);
        assert!((result(&plan, &control, "DIAMETER") - CHIP.1).abs() < 1e-3);
        // The good part is written, and a program that only measures raises no alarm: it shows a message and waits.
        let mut good = fanuc(&plan, plan.triggers.iter().flatten().copied().collect());
        good.run(&plan.program.text).unwrap();
        assert_eq!(
            (good.alarm.as_deref(), good.writes.len()),
            (None, 2),
            "{post}"
        );
        let measures = planned(&hole(post, "null", ""));
        let mut control = fanuc(&measures, with_a_chip(&measures));
        control.run(&measures.program.text).unwrap();
        assert_eq!(
            (control.alarm.as_deref(), control.stops),
            (None, 3),
            "{post}: diameter, residual, and the end"
        );
    }
}

#[test]
fn a_chip_on_the_first_wall_stops_a_sinumerik_before_the_write() {
    let plan = planned(&hole("sinumerik", "1", ""));
    let run = |plan: &Plan, triggers: Vec<Option<[f64; 3]>>| {
        let mut machine = Machine::new(triggers);
        machine.run(&read(&plan.program.text).unwrap()).unwrap();
        machine
    };
    let chip = |plan: &Plan| with_a_chip(plan).into_iter().map(Some).collect();
    let stopped = run(&plan, chip(&plan));
    assert!(
        stopped.message.starts_with("diameter is 38.169"),
        "{}",
        stopped.message
    );
    assert_eq!((stopped.alarm, stopped.writes), (Some(65_000.0), 0));
    assert_eq!(run(&plan, plan.triggers.clone()).writes, 2);
    let measures = planned(&hole("sinumerik", "null", ""));
    let told = run(&measures, chip(&measures));
    assert_eq!(
        (told.alarm, told.message.starts_with("center.x=-1.85")),
        (None, true),
        "{}",
        told.message
    );
}

#[test]
fn a_chip_on_the_first_wall_stops_linuxcnc_before_the_write() {
    let plan = planned(&hole("linuxcnc", "1", ""));
    let (ran, error) = interpret_until_stop(&ending_at(&plan, |k| with_a_chip(&plan)[k]));
    let error = error.expect("it stops");
    assert!(
        error.contains("diameter is 38.169") && error.contains("more than 0.5 from 40"),
        "{error}"
    );
    assert_eq!(ran.offsets_after_moves.len(), 0, "nothing is written");
    let shown = ran
        .prints
        .iter()
        .find(|(code, _)| code == "center.x")
        .unwrap()
        .1;
    assert!((shown - CHIP.0).abs() < 1e-4, "the results stay readable");
    assert!(
        interpret_until_stop(&on_virtual_part(&plan))
            .0
            .written
            .is_some()
    );
    let measures = planned(&hole("linuxcnc", "null", ""));
    let (_, error) = interpret_until_stop(&ending_at(&measures, |k| with_a_chip(&measures)[k]));
    assert_eq!(error, None, "it only says so");
}

/// The page's statement about the virtual part equals the behaviour of the program.
#[test]
fn the_plan_says_where_the_program_would_stop() {
    let found = |part: &str, offset: &str, limits: &str| {
        let job = hole(
            "fanuc",
            offset,
            &format!(r#", "part": {part}, "limits": {limits}"#),
        );
        let plan = planned(&job);
        let finding = plan
            .findings
            .iter()
            .find(|finding| finding.code == "implausible")
            .map(|finding| finding.message.clone());
        let row = plan
            .results
            .iter()
            .find(|row| row.verdict.as_deref() == Some("implausible"))
            .map(|row| row.code.clone());
        assert_eq!(finding.is_some(), row.is_some());
        finding
    };
    let larger = r#"{ "sizes": { "diameter": 0.6 } }"#;
    assert_eq!(
        found(r#"{ "sizes": { "diameter": 0.4 } }"#, "1", "{}"),
        None
    );
    assert!(
        found(larger, "1", "{}")
            .is_some_and(|text| text.contains("stops with an alarm") && text.contains("40.6 mm"))
    );
    assert!(found(larger, "null", "{}").is_some_and(|text| text.contains("reports")));
    assert_eq!(found(larger, "1", r#"{ "size": 0.7 }"#), None);
    assert_eq!(found(larger, "1", r#"{ "size": null }"#), None);
    // Without a limit a part may be anywhere within the search.
    let shifted = r#"{ "offset": [3, 0, 0] }"#;
    assert_eq!(found(shifted, "1", "{}"), None);
    assert!(found(shifted, "1", r#"{ "position": 2.5 }"#).is_some());
}

/// Four touches on a circle, one of them 0.5 mm off: 2·r·e of each is ±2·17·0.125 in turn, so the root mean square of e is 0.125.
#[test]
fn the_residual_is_the_root_mean_square_distance_from_the_circle() {
    let geometric = hole("grbl", "null", "");
    let plan = planned(&geometric);
    let z = plan.triggers[0].unwrap()[2];
    let measured = |job: &Value, e: f64| {
        let points = [
            [17.0 - e, 0.0, z],
            [-17.0, 0.0, z],
            [0.0, 17.0, z],
            [0.0, -17.0, z],
        ];
        let rows = evaluate(
            job,
            &Value::List(points.iter().map(|p| crate::common::point(*p)).collect()),
        )
        .unwrap();
        let row = rows.into_iter().find(|row| row.code == "residual").unwrap();
        (row.value.unwrap(), row.verdict)
    };
    for job in [geometric, hole("linuxcnc", "null", "")] {
        assert!(measured(&job, 0.0).0 < 1e-5);
        let (residual, verdict) = measured(&job, 0.5);
        assert!((residual - 0.125).abs() < 2e-3, "{residual}");
        assert_eq!(verdict.as_deref(), Some("implausible"));
        assert_eq!(measured(&job, 0.3).1, None);
    }
}

/// Three touches on a wall at 0, 20 and 40 mm, the middle one 0.3 mm off the line: the least-squares line is 0.1 from the outer ones and 0.2 from the middle
/// one.
#[test]
fn the_residual_of_a_wall_is_the_root_mean_square_distance_from_its_line() {
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "double-wall-internal-corner", "count1": 3, "step1": 20 },
        "control": { "post": "linuxcnc", "workOffset": 1 } }"#,
    );
    let plan = planned(&job);
    let points: Vec<Value> = plan
        .triggers
        .iter()
        .enumerate()
        .map(|(k, trigger)| {
            let [x, y, z] = trigger.unwrap();
            crate::common::point([x + if k == 1 { 0.3 } else { 0.0 }, y, z])
        })
        .collect();
    let rows = evaluate(&job, &Value::List(points)).unwrap();
    let residual = rows.iter().find(|row| row.code == "residual1").unwrap();
    assert!(
        (residual.value.unwrap() - (0.06f64 / 3.0).sqrt()).abs() < 1e-4,
        "{residual:?}"
    );
    assert_eq!(residual.verdict.as_deref(), Some("implausible"));
    assert!(
        rows.iter().all(|row| row.code != "residual2"),
        "two touches lie on a line, whatever they are"
    );
}

fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

/// Every program that writes, restarted at every block after its first motion, with empty variables and with those of the last run.
#[test]
fn no_restart_in_the_middle_writes() {
    let mut seen = 0;
    for post in POSTS.iter().filter(|post| post.work_offsets > 0) {
        for def in CYCLES
            .iter()
            .filter(|def| (post.supports)(def.probes, ProgramForm::Moves).is_ok())
        {
            let job = with(
                &default_job(def.key).unwrap(),
                "control.post",
                text(post.key),
            );
            let job = with(
                &with(&job, "control.form", text("moves")),
                "control.workOffset",
                number(1.0),
            );
            let job = if def.key == "probing-two-circles" {
                with(&job, "cycle.transferPosition", number(1.0))
            } else {
                job
            };
            let plan = planned(&job);
            let rows = check_program(&job, &plan.program.text).unwrap().unwrap();
            let row = rows
                .iter()
                .find(|row| row.rule == "restart-writes-nothing")
                .unwrap();
            assert_eq!(row.holds, Some(true), "{} {}: {row:?}", post.key, def.key);
            seen += 1;
        }
    }
    assert!(seen >= 4 * 15, "{seen}");
}

/// The same on a simulated Fanuc and Haas, whose reader shares no code with the crate: the part was moved by 1.5 mm and 0.8 mm since the last run.
#[test]
fn a_fanuc_that_is_started_at_any_block_writes_nothing_or_everything() {
    let (mut alarms, mut starts) = (0, 0);
    for post in skipping() {
        for kind in ["internal-rectangle", "hole", "double-wall-internal-corner"] {
            let job = job(&format!(
                r#"{{ "format": 1, "cycle": {{ "type": "{kind}" }}, "control": {{ "post": "{post}", "workOffset": 1 }} }}"#
            ));
            let plan = planned(&job);
            let moved = |triggers: &[Option<[f64; 3]>]| -> Vec<[f64; 3]> {
                triggers
                    .iter()
                    .flatten()
                    .map(|[x, y, z]| [x + 1.5, y + 0.8, *z])
                    .collect()
            };
            let text: Vec<&str> = plan.program.text.lines().collect();
            let first = text
                .iter()
                .position(|line| line.starts_with("G31"))
                .unwrap();
            let mut before = fanuc(&plan, plan.triggers.iter().flatten().copied().collect());
            before.run(&plan.program.text).unwrap();
            assert_eq!(before.writes.len(), 2);
            // The very first touches may be made after the restart: then all of them are.
            let count = text[first..]
                .iter()
                .position(|line| line.ends_with("+1"))
                .unwrap()
                + first;
            for at in count + 1..text.len() {
                for left in [true, false] {
                    let mut control = fanuc(&plan, moved(&plan.triggers));
                    if left {
                        control.variables = before.variables.clone();
                    } else {
                        control
                            .variables
                            .extend((100..150).map(|vacant| (vacant, 0.0)));
                    }
                    let origins: Vec<f64> = [5221, 5222]
                        .iter()
                        .map(|origin| control.variables[origin])
                        .collect();
                    // A motion without a position is an error of the simulated run, and a stop.
                    let _ = control.run(&(text[at..].join("\n") + "\n"));
                    let now: Vec<f64> = [5221, 5222]
                        .iter()
                        .map(|origin| control.variables[origin])
                        .collect();
                    assert_eq!(
                        now,
                        origins,
                        "{post} {kind}: from line {} ({left}): {:?}",
                        at + 1,
                        control.alarm
                    );
                    alarms += usize::from(control.alarm.is_some());
                    starts += 1;
                }
            }
        }
    }
    assert!(starts > 500 && alarms * 3 > starts, "{alarms} of {starts}");
}

/// Half of sensible 1411 jobs: sums that grow from touch to touch need no variable for every point.
#[test]
fn circles_of_eight_points_fit_the_variables_of_a_fanuc_and_a_haas() {
    for post in skipping() {
        for points in [3, 4, 6, 8] {
            for more in ["", r#", "extrusion": { "points": 2, "length": -6 }"#] {
                let job = job(&format!(
                    r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "probePoints": {points}, "transferPosition": 3{more} }},
                    "control": {{ "post": "{post}", "form": "moves", "workOffset": 1 }} }}"#
                ));
                let plan =
                    touchpath::job::plan(&job).unwrap_or_else(|e| panic!("{post} {points}: {e}"));
                let mut control = fanuc(&plan, plan.triggers.iter().flatten().copied().collect());
                control.at = [0.0, 0.0, 100.0];
                control
                    .run(&plan.program.text)
                    .unwrap_or_else(|e| panic!("{e}\n{}", plan.program.text));
                assert_eq!(control.alarm, None, "{post} {points}");
                for (code, wanted) in [
                    ("Q950", -30.0),
                    ("Q953", 30.0),
                    ("Q966", 20.0),
                    ("Q967", 20.0),
                ] {
                    let list: String = plan
                        .program
                        .text
                        .lines()
                        .filter_map(|l| l.strip_prefix("(RESULTS: "))
                        .collect();
                    let entry = list
                        .split([',', ')'])
                        .find(|entry| entry.ends_with(&format!("= {code}")))
                        .unwrap()
                        .trim();
                    let held =
                        control.variables[&entry.split(' ').next().unwrap()[1..].parse().unwrap()];
                    assert!(
                        (held - wanted).abs() < 1e-4,
                        "{post} {points} {code}: {held}"
                    );
                }
            }
        }
    }
}

/// Findings about a native cycle that measures a bad result on a part with these limits.
fn own_cycle(post: &str, cycle: &str, part: &str, offset: &str) -> Vec<String> {
    let job = job(&format!(
        r#"{{ "format": 1, "control": {{ "post": "{post}", "form": "cycle", "workOffset": {offset} }}, "cycle": {cycle},
            "limits": {{ "position": 1 }}, "part": {{ {part} }} }}"#
    ));
    planned(&job)
        .findings
        .into_iter()
        .filter(|f| f.code == "implausible")
        .map(|f| f.message)
        .collect()
}

/// H, M and B as Renishaw's macros compare them (read in the edition for Haas): H with the size, M with twice the distance of the position from its nominal
/// one, B with both walls.
#[test]
fn renishaws_macros_stop_as_their_letters_say() {
    let hole = r#"{ "type": "hole", "diameter": 40 }"#;
    let corner = r#"{ "type": "double-wall-internal-corner" }"#;
    let stops = "On this part the native cycle stops with a message: ";
    for (cycle, part, says) in [
        (hole, r#""sizes": { "diameter": 0.4 }"#, None),
        (hole, r#""sizes": { "diameter": 0.6 }"#, Some(format!("{stops}Diameter is 40.6 mm, more than 0.5 mm from 40 mm"))),
        // 0.8 along both axes is 1.131 away, and M2. stops from 1 on.
        (hole, r#""offset": [0.8, 0, 0]"#, None),
        (hole, r#""offset": [0.8, 0.8, 0]"#, Some(format!("{stops}the measured place is 1.1314 mm off, more than 1 mm"))),
        // Only the second wall, both, and only the first.
        (
            corner,
            r#""sizes": { "angle": 3 }"#,
            Some("On this part a result is implausible, and the program does not check it: Angle between the walls is 93°, more than 1° from 90°".to_owned()),
        ),
        (corner, r#""rotation": 3"#, Some(format!("{stops}the directions of both walls are more than 1° off"))),
        (
            corner,
            r#""rotation": 3, "sizes": { "angle": 3 }"#,
            Some(
                "On this part a result is implausible, and the program does not check it: Angle between the walls is 93°, more than 1° from 90°"
                    .to_owned(),
            ),
        ),
    ] {
        let found = own_cycle("haas", cycle, part, "null");
        assert_eq!(found, Vec::from_iter(says), "{cycle} {part}");
    }
}

/// HEIDENHAIN's cycles compare the size and each axis of the centre; those that write compare nothing.
#[test]
fn heidenhains_cycles_stop_as_q309_says() {
    let hole = r#"{ "type": "hole", "diameter": 40 }"#;
    let said = |part: &str, offset: &str| own_cycle("heidenhain", hole, part, offset);
    let larger = r#""sizes": { "diameter": 0.6 }"#;
    assert_eq!(
        said(r#""offset": [0.8, 0.8, 0]"#, "null"),
        Vec::<String>::new()
    );
    let stops = "On this part the native cycle stops with a message: ";
    assert_eq!(
        said(r#""offset": [1.2, 0, 0]"#, "null"),
        [format!(
            "{stops}Centre, abscissa is 1.2 mm, more than 1 mm from 0 mm"
        )]
    );
    assert_eq!(
        said(larger, "null"),
        [format!(
            "{stops}Diameter is 40.6 mm, more than 0.5 mm from 40 mm"
        )]
    );
    let [goes_on] = &said(larger, "1")[..] else {
        panic!("it writes a bad size")
    };
    assert!(
        goes_on
            .starts_with("On this part a result is implausible, and the program does not check it"),
        "{goes_on}"
    );
}

/// Limits that a macro does not check before it writes are reported; 1411 would check its angle after the write.
#[test]
fn what_a_macro_does_not_ask_before_it_writes_is_said() {
    let unasked = |cycle: &str, rest: &str| -> Vec<String> {
        let text = format!(
            r#"{{ "format": 1, "control": {{ "post": "haas", "form": "cycle", "workOffset": 1 }}, "cycle": {cycle}{rest} }}"#
        );
        let found = check(&job(&text));
        found
            .into_iter()
            .filter(|f| f.code == "limits-not-asked")
            .map(|f| format!("{:?} {}", f.level, f.path))
            .collect()
    };
    assert_eq!(unasked(r#"{ "type": "hole" }"#, ""), [""; 0]);
    assert_eq!(
        unasked(r#"{ "type": "double-wall-internal-corner" }"#, ""),
        ["Warning limits.angle"]
    );
    // In a set-up the last cycle writes.
    let set_up = |cycles: &str| -> Vec<String> {
        let text = format!(
            r#"{{ "format": 2, "control": {{ "post": "haas", "form": "cycle", "workOffset": 1 }}, "cycles": [{cycles}] }}"#
        );
        planned(&job(&text))
            .findings
            .into_iter()
            .filter(|f| f.code == "limits-not-asked")
            .map(|f| f.path)
            .collect()
    };
    let [hole, groove, corner] = [
        r#"{ "type": "hole" }"#,
        r#"{ "type": "groove", "origin": [200, 0, 0] }"#,
        r#"{ "type": "double-wall-internal-corner", "origin": [200, 0, 0] }"#,
    ];
    assert_eq!(set_up(&format!("{hole}, {groove}")), [""; 0]);
    assert_eq!(set_up(&format!("{corner}, {hole}")), [""; 0]);
    assert_eq!(set_up(&format!("{hole}, {corner}")), ["limits.angle"]);
    let circles = r#"{ "type": "probing-two-circles", "transferPosition": 2 }"#;
    assert_eq!(unasked(circles, ""), ["Error limits.angle"]);
    assert_eq!(
        unasked(circles, r#", "limits": { "angle": null }"#),
        [""; 0]
    );
}
