//! Programs for Fanuc and Haas, run on a simulated control (`common/fanuc.rs`): on the virtual part, with unexpected contacts, with missing ones, and in states
//! in which nothing may move.

use crate::common::fanuc::Control;
use crate::common::{number, with};
use touchpath::form::Value;
use touchpath::job::Plan;

/// Every job of the repository that they support.
fn plans() -> Vec<(String, Value, Plan)> {
    let put = |job: &Value, post: &str, offset: f64| {
        let job = with(
            job,
            "control",
            Value::Map(vec![("post".to_owned(), Value::Text(post.to_owned()))]),
        );
        with(
            &job,
            "control.workOffset",
            if offset > 0.0 {
                number(offset)
            } else {
                Value::Null
            },
        )
    };
    let mut jobs = crate::common::unlimited_jobs();
    let (_, seed) = jobs
        .iter()
        .find(|(name, _)| name == "circles-seed")
        .unwrap();
    // Its work offset is selected and not written.
    let measures_only = with(
        &with(seed, "cycle.transferPosition", number(0.0)),
        "cycle.confirmRotation",
        number(0.0),
    );
    jobs.push(("circles-measured-only".to_owned(), measures_only));
    jobs.into_iter()
        .flat_map(|(name, job)| {
            [("fanuc", 3.0), ("fanuc", 0.0), ("haas", 9.0), ("haas", 0.0)].map(|(post, offset)| {
                let job = put(&job, post, offset);
                let plan = touchpath::job::plan(&job).ok()?;
                Some((format!("{name} {post} {offset}"), job, plan))
            })
        })
        .flatten()
        .collect()
}

fn control(job: &Value, plan: &Plan) -> Control {
    let mut control = Control::new(
        plan.program.post == "haas",
        job.get("units") == Some(&Value::Text("inch".to_owned())),
    );
    control.contacts = plan.triggers.iter().flatten().copied().collect();
    if let Some(start) = stated_start(plan) {
        control.at = start;
    }
    for offset in [3, 9] {
        for axis in 0..3 {
            control
                .variables
                .insert(origin(offset) + axis, 50.0 * axis as f64 - 17.0);
        }
    }
    control
}

/// Start position of the stylus in the header.
fn stated_start(plan: &Plan) -> Option<[f64; 3]> {
    let text = plan.program.text.replace(")\n(", " ");
    let (_, rest) = text.split_once("THE STYLUS IS TAKEN TO BE AT ")?;
    let mut words = rest
        .split(' ')
        .map(|word| word[1..].parse::<f64>().unwrap());
    Some([words.next()?, words.next()?, words.next()?])
}

/// From the tables of both controls: G56 of a Fanuc is #5261, G154 P3 of a Haas #14041.
fn origin(offset: i64) -> i64 {
    if offset == 3 { 5261 } else { 14_041 }
}

fn clean(plan: &Plan) -> bool {
    plan.triggers.iter().all(Option::is_some)
        && !plan
            .findings
            .iter()
            .any(|f| f.code == "wrong-wall" || f.code == "edge-contact")
}

#[test]
fn on_the_virtual_part_the_program_computes_the_results_that_are_shown() {
    let (mut compared, mut deviating, mut written, mut waited_selected) = (0, 0, 0, 0);
    for (name, job, plan) in plans().into_iter().filter(|(.., plan)| clean(plan)) {
        for (included, full_circle) in [(true, true), (false, false), (true, false)] {
            let mut control = control(&job, &plan);
            (control.length_included, control.full_circle) = (included, full_circle);
            let before = control.variables.clone();
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{name}: {e}\n{}", plan.program.text));
            assert_eq!(control.alarm, None, "{name}\n{}", plan.program.text);
            // M30 may clear the results: the program waits before it, so that they can be read.
            let waits = !plan.touches.is_empty();
            assert_eq!(control.stops, usize::from(waits), "{name}");
            waited_selected += usize::from(waits && !name.ends_with(" 0"));
            let header: Vec<&str> = plan
                .program
                .text
                .lines()
                .filter_map(|l| l.strip_prefix("(RESULTS: "))
                .collect();
            assert_eq!(header.is_empty(), plan.touches.is_empty(), "{name}");
            for entry in header
                .iter()
                .flat_map(|line| line.trim_end_matches(')').split(", "))
            {
                let (variable, code) = entry.split_once(" = ").unwrap();
                let held = control.variables[&variable[1..].parse().unwrap()];
                let row = plan
                    .results
                    .iter()
                    .find(|r| r.code.eq_ignore_ascii_case(code))
                    .unwrap_or_else(|| panic!("{name}: {code}"));
                // Constants of eight digits.
                assert!(
                    (held - row.value.unwrap()).abs() < 2e-5,
                    "{name}: {variable} = {held}, {code} is {:?}",
                    row.value
                );
                compared += 1;
                deviating += usize::from(row.deviation.is_some_and(|d| d.abs() > 0.01));
            }
            // The origin moves by the measured minus the nominal value, once per axis.
            let offset = match job.get("control").and_then(|c| c.get("workOffset")) {
                Some(Value::Number(n)) => *n as i64,
                _ => {
                    assert!(control.writes.is_empty(), "{name}");
                    continue;
                }
            };
            let mut axes = control.writes.clone();
            axes.dedup();
            assert_eq!(axes.len(), control.writes.len(), "{name}");
            for code in ["center.x", "center.y", "corner.x", "corner.y", "height"] {
                let Some(row) = plan.results.iter().find(|r| r.code == code) else {
                    continue;
                };
                let axis = match code.as_bytes()[code.len() - 1] {
                    b'x' => 0,
                    b'y' => 1,
                    _ => 2,
                };
                let place = origin(offset) + axis;
                let moved = control.variables[&place] - before[&place];
                let deviation = row.value.unwrap() - row.nominal.unwrap();
                assert!(
                    (moved - deviation).abs() < 2e-5,
                    "{name}: {code} {moved} {deviation}"
                );
                written += usize::from(moved != 0.0);
            }
        }
    }
    assert!(
        compared > 300 && deviating > 20 && written > 8 && waited_selected > 0,
        "{compared} {deviating} {written} {waited_selected}"
    );
}

/// For any move that a contact stops: the alarm is raised, #149 has the move, nothing is written, and the ball moves only up, and not after a contact in an
/// upward move.
#[test]
fn a_contact_ends_the_program_and_names_the_move() {
    let mut lifted = 0;
    for (name, job, plan) in plans().into_iter().filter(|(.., plan)| clean(plan)) {
        for (i, step) in plan
            .moves
            .iter()
            .enumerate()
            .filter(|(_, step)| step.kind == "position")
        {
            let mut control = control(&job, &plan);
            control.blocked = Some(i as f64 + 1.0);
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            let alarm = control
                .alarm
                .clone()
                .unwrap_or_else(|| panic!("{name}: move {} {step:?}", i + 1));
            assert!(
                alarm == "1 CONTACT IN MOVE #149" || alarm == "M78",
                "{name}: {alarm}"
            );
            assert_eq!(
                (control.variables[&149], control.writes.len()),
                (i as f64 + 1.0, 0),
                "{name}"
            );
            let stopped = control
                .path
                .iter()
                .rposition(|(_, probing)| *probing)
                .unwrap();
            let exits = &control.path[stopped + 1..];
            let up = i > 0 && step.to[2] > plan.moves[i - 1].to[2] + 0.011;
            assert!(exits.len() <= 1, "{name}: {exits:?}");
            if let [(lift, _)] = exits {
                assert!(!up && alarm != "M78", "{name}: move {}", i + 1);
                assert_eq!(control.at, *lift);
                lifted += 1;
            }
        }
    }
    assert!(lifted > 100, "{lifted}");
}

/// A probe that signals at the start of a touch, falsely or because it has not settled, would take its start for the wall.
#[test]
fn a_signal_at_the_start_of_a_touch_is_no_wall() {
    let mut seen = 0;
    for (name, job, plan) in plans().into_iter().filter(|(.., plan)| clean(plan)) {
        for (i, _) in plan
            .moves
            .iter()
            .enumerate()
            .filter(|(_, step)| step.kind == "touch")
        {
            let mut control = control(&job, &plan);
            control.early = Some(i as f64 + 1.0);
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(
                control.alarm.as_deref(),
                Some("1 CONTACT IN MOVE #149"),
                "{name}: move {}",
                i + 1
            );
            assert_eq!(
                (control.variables[&149], control.writes.len()),
                (i as f64 + 1.0, 0),
                "{name}"
            );
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen}");
}

/// A missed touch ends the program; on a Fanuc the ball retracts first.
#[test]
fn a_missed_touch_writes_nothing() {
    for (name, job, plan) in plans()
        .into_iter()
        .filter(|(.., plan)| clean(plan) && !plan.touches.is_empty())
    {
        for missed in 0..plan.touches.len() {
            let mut control = control(&job, &plan);
            control.contacts.remove(missed);
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            let alarm = control
                .alarm
                .clone()
                .unwrap_or_else(|| panic!("{name}: touch {missed}"));
            assert!(
                alarm == "2 NO CONTACT IN TOUCH #149" || alarm == "M79" || alarm == "M78",
                "{name}: {alarm}"
            );
            assert_eq!(control.writes.len(), 0, "{name}");
            let highest = plan.moves.iter().map(|m| m.to[2]).fold(f64::MIN, f64::max);
            assert!(
                alarm.starts_with('M') || control.at[2] > highest - 1e-3,
                "{name}: {:?}",
                control.at
            );
        }
    }
}

#[test]
fn nothing_moves_where_the_control_is_not_as_it_must_be() {
    for (name, job, plan) in plans()
        .into_iter()
        .filter(|(.., plan)| !plan.moves.is_empty())
    {
        let inch = job.get("units") == Some(&Value::Text("inch".to_owned()));
        let common = [
            (4006, if inch { 21.0 } else { 20.0 }),
            (4008, 49.0),
            (4008, 44.0),
            (4008, 43.4),
            (4011, 51.0),
            (4016, 68.0),
        ];
        let fanuc = [
            (4016, 68.2),
            (4016, 68.3),
            (4016, 68.4),
            (4017, 16.0),
            (4022, 51.1),
            (4111, 0.0),
            (4111, 201.0),
        ];
        let haas = plan.program.post == "haas";
        for (code, value) in common
            .into_iter()
            .chain(fanuc.into_iter().filter(|_| !haas))
        {
            let mut control = control(&job, &plan);
            control
                .modal
                .iter_mut()
                .find(|(known, _)| *known == code)
                .unwrap()
                .1 = value;
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            // Each cause has its own alarm.
            let number = match (code, value) {
                (4006, _) => "11 SET THE UNITS TO",
                (4008, _) => "12 G43 IS NOT ACTIVE",
                (4111, 0.0) => "13 NO H NUMBER",
                (4111, _) => "14 H NUMBER",
                (4017, _) => "15 POLAR",
                (4016, 68.0) => {
                    if haas {
                        "13 ROTATION G68"
                    } else {
                        "16 ROTATION G68"
                    }
                }
                (4016, _) => "17 TILTED PLANE",
                (4011, _) => {
                    if haas {
                        "14 SCALING G51"
                    } else {
                        "18 SCALING G51"
                    }
                }
                _ => "19 MIRROR G51.1",
            };
            assert!(
                control
                    .alarm
                    .as_deref()
                    .is_some_and(|alarm| alarm.starts_with(number)),
                "{name} {code}: {:?}",
                control.alarm
            );
            assert!(
                control.path.is_empty() && control.writes.is_empty(),
                "{name}"
            );
        }
        // A stylus that is not at the job's start.
        if stated_start(&plan).is_some() {
            let mut control = control(&job, &plan);
            control.at[2] -= 20.0;
            control.run(&plan.program.text).unwrap();
            assert_eq!(
                (control.alarm.as_deref(), control.path.len()),
                (Some("4 STYLUS NOT AT STATED START"), 0),
                "{name}"
            );
        }
    }
}

/// Plans with moves that do not state the position of the stylus before them.
fn from_anywhere() -> impl Iterator<Item = (String, Value, Plan)> {
    plans()
        .into_iter()
        .filter(|(.., plan)| clean(plan) && !plan.moves.is_empty() && stated_start(plan).is_none())
}

/// A stylus below the first position does not move; from above it keeps its height in the plane, and then moves down.
#[test]
fn the_way_to_the_first_place_is_across_and_down_or_none() {
    let mut seen = 0;
    for (name, job, plan) in from_anywhere() {
        let first = plan.moves[0].to;
        for (above, included, length) in [
            (55.0, true, 121.5),
            (55.0, true, -155.0),
            (155.0, false, 121.5),
            (-1.0, true, 121.5),
            (-40.0, true, -155.0),
            (40.0, false, 121.5),
            (156.0, true, -155.0),
            (-40.0, false, -155.0),
            (1.0, false, -155.0),
        ] {
            let mut control = control(&job, &plan);
            (control.length_included, control.length) = (included, length);
            control.at[2] = first[2] + above;
            let start = control.at;
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            // It must be high enough for a control whose coordinates include the length, and for one that excludes it.
            let needed = if included { -length } else { length };
            if above < f64::max(needed, 0.0) {
                assert_eq!(
                    (control.alarm.as_deref(), control.path.len()),
                    (Some("4 STYLUS TOO LOW TO START"), 0),
                    "{name}"
                );
                continue;
            }
            assert_eq!(control.alarm, None, "{name} {above} {included} {length}");
            let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-3);
            for (made, wanted) in control
                .path
                .iter()
                .zip([[first[0], first[1], start[2]], first])
            {
                assert!(near(made.0, wanted), "{name}: {:?} {wanted:?}", made.0);
            }
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}

/// The height of the stylus is unknown before the first descent is done: a control that excludes the length retracted downwards there.
#[test]
fn a_contact_in_the_first_descent_stops_where_it_is() {
    let mut seen = 0;
    for (name, job, plan) in from_anywhere() {
        let first = plan.moves[0].to;
        for (included, above) in [(true, 60.0), (false, 60.0), (false, 1.0)] {
            let mut control = control(&job, &plan);
            control.length_included = included;
            control.at[2] = first[2] + 200.0;
            let contact = [first[0], first[1], first[2] + above];
            control.contacts.insert(0, contact);
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            let alarm = if control.haas {
                "M78"
            } else {
                "1 CONTACT IN MOVE #149"
            };
            assert_eq!(
                (control.alarm.as_deref(), control.at),
                (Some(alarm), contact),
                "{name} {included} {above}"
            );
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}

/// Sums of lengths and heights are rounded, by the control to its increments too: a program can be run again from the height at which it ended.
#[test]
fn a_program_that_ended_may_be_run_again() {
    let job = touchpath::job::default_job("double-wall-internal-corner").unwrap();
    let job = with(
        &with(&job, "control.post", Value::Text("fanuc".to_owned())),
        "control.workOffset",
        Value::Null,
    );
    let plan = crate::common::planned(&job);
    let height = plan.moves[0].to[2];
    for k in 0..200 {
        let mut control = control(&job, &plan);
        control.length = 100.0 + f64::from(k) * 0.137;
        control.at = [15.0, 15.0, height - 1e-4];
        control.run(&plan.program.text).unwrap();
        assert_eq!(control.alarm, None, "{}", control.length);
    }
}

/// The manual of a Haas requires G31 below 2500 mm/min, 100 inch/min.
#[test]
fn a_haas_probes_below_the_limit_of_its_manual() {
    let job = |units: &str, approach: Value| {
        let job = touchpath::job::default_job("hole").unwrap();
        let job = touchpath::job::convert_units(&job, units).unwrap();
        with(
            &with(&job, "control.post", Value::Text("haas".to_owned())),
            "feeds.approach",
            approach,
        )
    };
    for (units, limit) in [("mm", 2500.0), ("inch", 100.0)] {
        let rapid = crate::common::planned(&job(units, Value::Null));
        let feeds = rapid
            .program
            .text
            .lines()
            .filter(|line| line.starts_with("G31"));
        let feeds: Vec<f64> = feeds
            .flat_map(|line| line.split(' ').find_map(|word| word.strip_prefix('F')))
            .map(|feed| feed.parse().unwrap())
            .collect();
        assert!(
            feeds.len() > 5 && feeds.iter().all(|feed| *feed < limit),
            "{feeds:?}"
        );
        let too_fast = |plan: &Plan| plan.findings.iter().any(|f| f.code == "probing-too-fast");
        assert!(!too_fast(&rapid));
        assert!(too_fast(&crate::common::planned(&job(
            units,
            number(limit)
        ))));
        assert!(!too_fast(&crate::common::planned(&job(
            units,
            number(limit - 1.0)
        ))));
    }
}

/// A program becomes the job again, although its header is in capitals.
#[test]
fn a_program_is_read_back_as_its_job() {
    for (name, job, plan) in plans() {
        let read =
            crate::common::import(&plan.program.text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let warnings: Vec<_> = read
            .findings
            .iter()
            .filter(|f| f.level != touchpath::form::Level::Info)
            .collect();
        assert!(warnings.is_empty(), "{name}: {warnings:?}");
        let part = job.get("part").cloned().unwrap_or(Value::Map(Vec::new()));
        let back = crate::common::planned(&with(&read.job, "part", part));
        assert_eq!(
            (back.moves, back.results, back.program.text),
            (plan.moves, plan.results, plan.program.text),
            "{name}"
        );
    }
    // Small letters of a tolerance are not lost: a shaft is not a hole.
    let circles = r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "diameter1": "20h7", "diameter2": "20H7" },
        "control": { "post": "fanuc" } }"#;
    let text = crate::common::planned(&touchpath::job::from_json(circles).unwrap())
        .program
        .text;
    assert!(
        text.contains("CYCLE.DIAMETER1=20+H7") && text.contains("CYCLE.DIAMETER2=20H7"),
        "{text}"
    );
    let cycle = crate::common::import(&text)
        .unwrap()
        .job
        .get("cycle")
        .unwrap()
        .clone();
    assert_eq!(
        cycle.get("diameter1"),
        Some(&Value::Text("20h7".to_owned()))
    );
    assert_eq!(
        cycle.get("diameter2"),
        Some(&Value::Text("20H7".to_owned()))
    );
}

#[test]
fn what_these_controls_cannot_do_is_refused() {
    let found = |changes: &[(&str, Value)]| -> Vec<String> {
        let job = touchpath::job::default_job("internal-rectangle-protected").unwrap();
        let job = with(&job, "control.post", Value::Text("fanuc".to_owned()));
        let job = changes
            .iter()
            .fold(job, |job, (path, value)| with(&job, path, value.clone()));
        let findings = touchpath::job::check(&job);
        findings
            .into_iter()
            .filter(|f| f.level == touchpath::form::Level::Error)
            .map(|f| f.code)
            .collect()
    };
    assert_eq!(found(&[]), [""; 0]);
    assert_eq!(
        found(&[("plane", Value::Text("G18".to_owned()))]),
        ["plane-unsupported"]
    );
    assert_eq!(found(&[("overtravel", number(0.1))]), ["search-too-short"]);
    let near = |clearance: f64| {
        let job = touchpath::job::default_job("surface").unwrap();
        let job = with(&job, "control.post", Value::Text("fanuc".to_owned()));
        let findings = touchpath::job::check(&with(&job, "cycle.clearance", number(clearance)));
        findings
            .into_iter()
            .any(|f| f.level == touchpath::form::Level::Error && f.code == "touch-too-short")
    };
    assert_eq!((near(3.03), near(3.19), near(3.21)), (true, true, false));
    let far = |x: f64| {
        found(&[(
            "cycle.origin",
            Value::List(vec![number(x), number(0.0), number(0.0)]),
        )])
    };
    assert_eq!(
        (far(-9900.0).as_slice(), far(-10_000.0).as_slice()),
        (&[][..], &["too-many-digits".to_owned()][..])
    );
    assert_eq!(
        found(&[("control.protection", Value::Text("none".to_owned()))]),
        ["protection-unsupported"]
    );
    assert_eq!(
        found(&[("control.form", Value::Text("cycle".to_owned()))]),
        [""; 0],
        "the macros"
    );
    // G54.1 P48 and G154 P99 are the last ones.
    assert_eq!(
        (
            found(&[("control.workOffset", number(54.0))]),
            found(&[("control.workOffset", number(55.0))])
        ),
        (vec![], vec!["work-offset-unsupported".to_owned()])
    );
    assert_eq!(
        found(&[
            ("control.workOffset", number(105.0)),
            ("control.post", Value::Text("haas".to_owned()))
        ]),
        [""; 0]
    );
}

/// The control shows 26 characters of an alarm and has no braces or brackets: checked for every job and control, also in comments.
#[test]
fn alarms_are_short_and_signs_are_the_controls() {
    let mut alarms = 0;
    for post in crate::tests::controls::skipping() {
        for (name, job) in crate::common::jobs() {
            let job = with(
                &with(&job, "control.post", Value::Text(post.to_owned())),
                "control.form",
                Value::Text("moves".to_owned()),
            );
            let Ok(plan) = touchpath::job::plan(&job) else {
                continue;
            };
            for line in plan.program.text.lines() {
                assert!(!line.contains(['{', '}']), "{name} {post}: {line}");
                if let Some((_, says)) = line
                    .split_once('(')
                    .filter(|(code, _)| code.starts_with("#3000=") || code.starts_with("#3006="))
                {
                    assert!(
                        says.trim_end_matches(')').len() <= 26,
                        "{name} {post}: {line}"
                    );
                    alarms += 1;
                }
            }
        }
    }
    assert!(alarms > 500, "{alarms}");
}
