//! Tolerances of results: the reaction of a program, and the findings of the page.

use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{import, interpret_until_stop, job, on_virtual_part, planned, with};
use crate::tests::controls::{calling, computing, of_moves, without};
use touchpath::form::{Level, Value};
use touchpath::job::{JobError, Plan, RESULT_CODES, convert_units, default_job, evaluate, plan};

/// A bore of 25 mm with H7, which is 25 to 25.021 mm, on a part whose bore is larger by `off`.
fn bore(post: &str, offset: &str, then: &str, off: f64) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": 25 }}, "control": {{ "post": "{post}", "workOffset": {offset} }},
            "part": {{ "sizes": {{ "diameter": {off} }} }}, "tolerances": {{ "diameter": {{ "tolerance": "H7", "action": "{then}" }} }} }}"#
    ))
}

fn text_at<'v>(job: &'v Value, keys: &[&str]) -> &'v str {
    match keys.iter().try_fold(job, |at, key| at.get(key)) {
        Some(Value::Text(text)) => text,
        other => panic!("{keys:?}: {other:?}"),
    }
}

/// End of the program on its virtual part: the alarm, whether it writes, and its messages.
fn run(plan: &Plan) -> (bool, bool, String) {
    match plan.program.post {
        "linuxcnc" => {
            let (ran, error) = interpret_until_stop(&on_virtual_part(plan));
            let said = error
                .clone()
                .unwrap_or_else(|| format!("{:?}", ran.messages));
            (
                error.is_some(),
                !plan.program.writes.is_empty() && ran.written.is_some(),
                said,
            )
        }
        "sinumerik" => {
            let mut machine = Machine::new(plan.triggers.clone());
            machine.run(&read(&plan.program.text).unwrap()).unwrap();
            (
                machine.alarm.is_some(),
                machine.writes > 0,
                machine.messages.join("\n"),
            )
        }
        post => {
            let mut control = Control::new(post == "haas", false);
            control.contacts = plan.triggers.iter().flatten().copied().collect();
            for origin in [5221, 5222, 5223] {
                control.variables.insert(origin, 100.0);
            }
            control.run(&plan.program.text).unwrap();
            let said = control
                .alarm
                .clone()
                .unwrap_or_else(|| control.messages.join("\n"));
            (control.alarm.is_some(), !control.writes.is_empty(), said)
        }
    }
}

#[test]
fn a_result_out_of_its_tolerance_stops_the_program_or_is_marked_or_only_judged() {
    for post in computing() {
        // Within, above and below 25 to 25.021 mm; by hand.
        for (off, good) in [
            (0.0205, true),
            (0.0005, true),
            (0.0215, false),
            (-0.0005, false),
        ] {
            for (offset, writes) in [("1", true), ("null", false)] {
                let case = format!("{post}, {off}, {offset}");
                let (alarm, wrote, said) = run(&planned(&bore(post, offset, "stop", off)));
                assert_eq!(
                    (alarm, wrote),
                    (!good, writes && good),
                    "stop: {case}: {said}"
                );
                assert_eq!(
                    good,
                    !said.to_lowercase().contains("diameter out")
                        && !said.contains("not 25 to 25.021"),
                    "{case}: {said}"
                );
                let (alarm, wrote, said) = run(&planned(&bore(post, offset, "mark", off)));
                assert_eq!((alarm, wrote), (false, writes), "mark: {case}: {said}");
                assert_eq!(
                    !good,
                    said.to_lowercase().contains("diameter out")
                        || said.contains("not 25 to 25.021"),
                    "{case}: {said}"
                );
                let (alarm, wrote, _) = run(&planned(&bore(post, offset, "go", off)));
                assert_eq!((alarm, wrote), (false, writes), "go: {case}");
            }
        }
    }
}

/// A path that ends with an unwatched retract: the control waits for standstill before the check, because its alarm would stop the ball during the retract.
#[test]
fn a_control_that_reads_ahead_asks_when_the_last_retract_is_done() {
    let short = |post: &str, then: &str| {
        let job = job(&format!(
            r#"{{ "format": 1, "control": {{ "post": "{post}" }}, "cycle": {{ "type": "surface", "elevation": 50, "feedDistance": 0 }},
                "tolerances": {{ "deviation": {{ "tolerance": "±0.001", "action": "{then}" }} }} }}"#
        ));
        let text = planned(&job).program.text;
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let retract = lines
            .iter()
            .rposition(|line| line.starts_with("G1 X"))
            .unwrap();
        lines[retract + 1].clone()
    };
    for (post, halt) in [("fanuc", "G53"), ("haas", "G103 P1")] {
        assert_eq!(short(post, "stop"), halt, "{post}");
        assert_ne!(short(post, "mark"), halt, "{post}: a message stops nothing");
    }
}

/// A program without actions equals that of a job without tolerances, except for its header.
#[test]
fn a_tolerance_that_nothing_follows_from_changes_no_block() {
    for post in computing() {
        let with_it = with(
            &bore(post, "1", "go", 0.0),
            "control.header",
            Value::Text("short".to_owned()),
        );
        let Value::Map(entries) = &with_it else {
            unreachable!()
        };
        let without = Value::Map(
            entries
                .iter()
                .filter(|(key, _)| key != "tolerances")
                .cloned()
                .collect(),
        );
        assert_eq!(
            planned(&with_it).program.text,
            planned(&without).program.text,
            "{post}"
        );
    }
}

/// The uncertainty of a diameter of four touches with 1 µm each is 1 µm by hand: |∂d/∂each| is 1/2, so σ = √(4/4)·1 µm = 1 µm, and the band is 2 µm.
#[test]
fn a_verdict_says_whether_the_uncertainty_leaves_it_open() {
    let verdict = |off: f64| {
        let job = with(
            &bore("linuxcnc", "null", "go", off),
            "stylus.repeatability",
            Value::Number(0.001),
        );
        let row = planned(&job)
            .results
            .into_iter()
            .find(|row| row.code == "diameter")
            .unwrap();
        assert!((row.uncertainty.unwrap() - 0.001).abs() < 1e-6, "{row:?}");
        assert_eq!(
            row.limits.map(|ends| ends.map(|x| (x * 1e6).round() / 1e6)),
            Some([25.0, 25.021])
        );
        row.verdict.unwrap()
    };
    for (off, says) in [
        (0.0105, "good"),
        (0.0025, "good"),
        (0.0015, "good within ±"),
        (0.0195, "good within ±"),
        (0.021, "good within ±"),
        (-0.0015, "out within ±"),
        (0.0225, "out within ±"),
        (0.0235, "out"),
        (-0.0025, "out"),
    ] {
        assert_eq!(verdict(off), says, "{off}");
    }
}

#[test]
fn measured_values_are_judged_likewise() {
    let job = bore("fanuc", "null", "stop", 0.0);
    let rows = |diameter: f64| {
        let text = format!("center.x=0\ncenter.y=0\ndiameter={diameter}\nresidual=0");
        evaluate(&job, &Value::Text(text))
            .unwrap()
            .into_iter()
            .find(|row| row.code == "diameter")
            .unwrap()
            .verdict
    };
    assert_eq!(rows(25.01).as_deref(), Some("good"));
    assert_eq!(rows(25.04).as_deref(), Some("out"));
    assert_eq!(rows(26.0).as_deref(), Some("implausible"));
}

#[test]
fn the_plan_says_what_the_program_would_do_on_the_virtual_part() {
    let said = |then: &str, off: f64, offset: &str| {
        let plan = planned(&bore("sinumerik", offset, then, off));
        plan.findings
            .into_iter()
            .find(|finding| finding.code == "out-of-tolerance")
            .map(|finding| finding.message)
    };
    let stops = said("stop", 0.03, "1").unwrap();
    assert!(
        stops.contains("writes nothing") && stops.contains("25.03 mm, not 25 mm to 25.021 mm"),
        "{stops}"
    );
    assert!(
        said("stop", 0.03, "null")
            .unwrap()
            .starts_with("On this part the program stops with an alarm: ")
    );
    assert!(said("mark", 0.03, "1").unwrap().contains("marks"));
    assert_eq!(
        [
            said("go", 0.03, "1"),
            said("stop", 0.01, "1"),
            said("mark", 0.02, "1")
        ],
        [None, None, None]
    );
}

/// In a set-up results have the names of their cycles, and each cycle acts on its own.
#[test]
fn every_cycle_of_a_set_up_has_its_own() {
    let job = |left: f64, right: f64| {
        job(&format!(
            r#"{{ "format": 2, "control": {{ "post": "linuxcnc", "workOffset": 1 }}, "cycles": [
                {{ "name": "LEFT", "type": "hole", "diameter": 25, "origin": [-40, 0, -5] }},
                {{ "name": "RIGHT", "type": "hole", "diameter": 25, "origin": [40, 0, -5] }} ],
               "tolerances": {{ "LEFT.diameter": {{ "tolerance": "±0.05", "action": "mark" }}, "right.diameter": {{ "tolerance": "25H7", "action": "stop" }} }},
               "part": {{ "sizes": {{ "LEFT.diameter": {left}, "RIGHT.diameter": {right} }} }} }}"#
        ))
    };
    let of = |left: f64, right: f64| {
        let plan = planned(&job(left, right));
        let verdicts: Vec<Option<String>> = plan
            .results
            .iter()
            .filter(|row| row.code == "diameter")
            .map(|row| row.verdict.clone())
            .collect();
        let (alarm, wrote, said) = run(&plan);
        (
            verdicts
                .into_iter()
                .flatten()
                .collect::<Vec<_>>()
                .join(", "),
            alarm,
            wrote,
            said,
        )
    };
    let (verdicts, alarm, wrote, _) = of(0.0, 0.01);
    assert_eq!(
        (verdicts.as_str(), alarm, wrote),
        ("good, good", false, true)
    );
    let (verdicts, alarm, wrote, said) = of(0.06, 0.01);
    assert_eq!(
        (verdicts.as_str(), alarm, wrote),
        ("out, good", false, true)
    );
    assert!(
        said.contains("LEFT.diameter") && said.contains("not 24.95 to 25.05"),
        "{said}"
    );
    let (verdicts, alarm, wrote, said) = of(0.0, 0.04);
    assert_eq!(
        (verdicts.as_str(), alarm, wrote),
        ("good, out", true, false)
    );
    assert!(said.contains("RIGHT.diameter"), "{said}");
}

/// The job with this tolerance of the diameter.
fn with_tolerance(given: &str) -> Value {
    with(
        &bore("linuxcnc", "1", "stop", 0.0),
        "tolerances",
        job(given),
    )
}

fn findings(job: &Value) -> Vec<(Level, String, String)> {
    let findings = match plan(job) {
        Ok(plan) => plan.findings,
        Err(JobError { findings, .. }) => findings,
    };
    findings
        .into_iter()
        .map(|finding| (finding.level, finding.code, finding.path))
        .collect()
}

#[test]
fn what_is_no_tolerance_is_said_at_its_place() {
    for (given, code, path) in [
        (
            r#"{ "diameter": { "tolerance": "H77" } }"#,
            "not-a-tolerance",
            "tolerances.diameter.tolerance",
        ),
        (
            r#"{ "diameter": { "tolerance": "25" } }"#,
            "not-a-tolerance",
            "tolerances.diameter.tolerance",
        ),
        (
            r#"{ "center.x": { "tolerance": "H7" } }"#,
            "not-a-tolerance",
            "tolerances.center.x.tolerance",
        ),
        (
            r#"{ "diameter": { "tolerance": 0.02 } }"#,
            "wrong-type",
            "tolerances.diameter.tolerance",
        ),
        (
            r#"{ "diameter": { "action": "stop" } }"#,
            "missing",
            "tolerances.diameter.tolerance",
        ),
        (
            r#"{ "diameter": { "tolerance": "H7", "action": "halt" } }"#,
            "unknown-value",
            "tolerances.diameter.action",
        ),
        (
            r#"{ "diameter": { "tolerance": "H7", "else": 1 } }"#,
            "unknown-key",
            "tolerances.diameter.else",
        ),
        (
            r#"{ "diameter": "H7" }"#,
            "wrong-type",
            "tolerances.diameter",
        ),
        (
            r#"{ "width": { "tolerance": "H7" } }"#,
            "tolerance-unknown",
            "tolerances.width",
        ),
        (
            r#"{ "diameter": { "tolerance": "±0.6" } }"#,
            "tolerance-beyond-limit",
            "tolerances.diameter.tolerance",
        ),
        (
            r#"{ "diameter": { "tolerance": "                                                                 H7" } }"#,
            "text-too-long",
            "tolerances.diameter.tolerance",
        ),
        (r#"[1]"#, "wrong-type", "tolerances"),
    ] {
        let found = findings(&with_tolerance(given));
        assert!(
            found.contains(&(Level::Error, code.to_owned(), path.to_owned())),
            "{given}: {found:?}"
        );
    }
    let elsewhere = findings(&with_tolerance(
        r#"{ "diameter": { "tolerance": "25.2H7" } }"#,
    ));
    assert!(
        elsewhere
            .iter()
            .any(|(level, code, _)| *level == Level::Warning && code == "tolerance-elsewhere"),
        "{elsewhere:?}"
    );
    assert_eq!(
        findings(&with_tolerance("null")),
        findings(&with_tolerance("{}"))
    );
}

/// For a program that cannot compare, actions are refused, and the page judges the results.
#[test]
fn a_control_that_cannot_compare_is_not_asked_to() {
    let moves = without(&of_moves(), &computing())
        .into_iter()
        .map(|post| (post, "moves"));
    for (post, form) in moves.chain(calling().into_iter().map(|post| (post, "cycle"))) {
        for then in ["mark", "stop"] {
            let job = with(
                &bore(post, "null", then, 0.0),
                "control.form",
                Value::Text(form.to_owned()),
            );
            let found = findings(&job);
            let wanted = (
                Level::Error,
                "tolerance-unsupported".to_owned(),
                "tolerances.diameter.action".to_owned(),
            );
            assert!(found.contains(&wanted), "{post}: {found:?}");
        }
        let job = with(
            &bore(post, "null", "go", 0.01),
            "control.form",
            Value::Text(form.to_owned()),
        );
        let row = planned(&job)
            .results
            .into_iter()
            .find(|row| row.code == "diameter");
        assert!(
            row.is_none_or(|row| row.value.is_none() || row.verdict.as_deref() == Some("good")),
            "{post}"
        );
    }
    let circles = with(
        &default_job("probing-two-circles").unwrap(),
        "tolerances",
        job(r#"{ "Q966": { "tolerance": "H7" } }"#),
    );
    assert!(
        findings(&circles)
            .iter()
            .any(|(_, code, _)| code == "tolerance-unsupported")
    );
}

#[test]
fn tolerances_come_back_from_the_header_of_a_program_and_in_other_units() {
    for post in computing() {
        let plan = planned(&bore(post, "1", "stop", 0.0));
        let back = import(&plan.program.text).unwrap().job;
        assert_eq!(
            text_at(&back, &["tolerances", "diameter", "tolerance"]),
            "H7",
            "{post}"
        );
        assert_eq!(planned(&back).program.text, plan.program.text, "{post}");
        // Characters that a comment cannot contain are written differently and read back.
        let signs = r#"{ "diameter": { "tolerance": "25 ±0,02" }, "center.x": { "tolerance": "+0.1/-.2", "action": "mark" } }"#;
        let plan = planned(&with(
            &bore(post, "1", "stop", 0.0),
            "tolerances",
            job(signs),
        ));
        let again = planned(&import(&plan.program.text).unwrap().job);
        assert_eq!(again.program.text, plan.program.text, "{post}");
        let limits = |plan: &Plan| {
            plan.results
                .iter()
                .map(|row| row.limits)
                .collect::<Vec<_>>()
        };
        assert_eq!(limits(&again), limits(&plan), "{post}");
        assert_eq!(limits(&plan).iter().flatten().count(), 2);
    }
    let mm = with(
        &bore("linuxcnc", "1", "stop", 0.0),
        "tolerances",
        job(
            r#"{ "diameter": { "tolerance": "25±0.0254" }, "center.x": { "tolerance": "-0.254..0.254" } }"#,
        ),
    );
    let inch = convert_units(&mm, "inch").unwrap();
    assert_eq!(
        text_at(&inch, &["tolerances", "diameter", "tolerance"]),
        "0.984252±0.001"
    );
    let limits = |job: &Value| {
        let rows = planned(job).results;
        let of = |code: &str| {
            rows.iter()
                .find(|row| row.code == code)
                .unwrap()
                .limits
                .unwrap()
        };
        [of("diameter"), of("center.x")].concat()
    };
    for (a, b) in limits(&mm).iter().zip(limits(&inch)) {
        assert!((a - b * 25.4).abs() < 1e-4, "{a} {b}");
    }
    // An angle is the same in any units.
    let wall = default_job("wall-angle").unwrap();
    let wall = with(
        &wall,
        "tolerances",
        job(r#"{ "rotation": { "tolerance": "±0.5" } }"#),
    );
    assert_eq!(
        text_at(
            &convert_units(&wall, "inch").unwrap(),
            &["tolerances", "rotation", "tolerance"]
        ),
        "±0.5"
    );
    // The conversion by name covers every angle.
    for code in RESULT_CODES.iter().filter(|code| !code.starts_with('Q')) {
        let angle = code.ends_with("rotation") || code.ends_with("angle") || *code == "table.turn";
        let lengths = [
            "center",
            "corner",
            "point",
            "offset",
            "diameter",
            "residual",
            "spread",
            "width",
            "height",
            "deviation",
            "form",
            "preset",
            "distance",
            "difference",
            "mean",
            "distance",
            "difference",
            "mean",
        ];
        assert!(
            angle || lengths.iter().any(|length| code.starts_with(length)),
            "{code} is neither"
        );
    }
}

/// One size limit holds for all cycles of a set-up: the widest tolerance of any cycle decides.
#[test]
fn a_set_up_without_a_size_limit_has_room_for_its_widest_tolerance() {
    let set_up = |first: &str, second: &str, limits: &str| {
        job(&format!(
            r#"{{ "format": 2, "units": "mm", "control": {{ "post": "haas", "workOffset": 1 }}, {limits} "cycles": [
                {{ "type": "hole", "diameter": "{first}" }},
                {{ "type": "internal-rectangle", "width1": "{second}", "origin": [100, 0, 0] }} ] }}"#
        ))
    };
    // By hand: 1.5 mm of the tolerance plus 0.5 mm.
    for (first, second) in [("25 H7", "60 ±1.5"), ("25 +1.5 -0.2", "60 H7")] {
        let free = set_up(first, second, "");
        let given = set_up(first, second, r#""limits": { "size": 2 },"#);
        assert_eq!(planned(&free).program.text, planned(&given).program.text);
    }
}

/// A hole with this text as its size, on a control, with further fields.
fn hole(size: &str, post: &str, more: &str) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": {size} }}, "limits": {{ "size": 0.5 }},
            "control": {{ "post": "{post}", "header": "short" }} {more} }}"#
    ))
}

/// A drawing's size is a number and a tolerance: the program is the same as with both separately.
#[test]
fn a_size_that_says_its_tolerance_is_that_size_with_that_tolerance() {
    for post in computing() {
        for action in ["go", "mark", "stop"] {
            let inside = format!(r#", "tolerances": {{ "diameter": {{ "action": "{action}" }} }}"#);
            let beside = format!(
                r#", "tolerances": {{ "diameter": {{ "tolerance": "H7", "action": "{action}" }} }}"#
            );
            let one = planned(&hole(r#""25 H7""#, post, &inside));
            let other = planned(&hole("25", post, &beside));
            assert_eq!(one.program.text, other.program.text, "{post} {action}");
            assert_eq!(one.table, other.table);
        }
    }
    let plain = planned(&hole("25", "linuxcnc", ""));
    for (text, [low, high]) in [
        ("25 H7", [25.0, 25.021]),
        ("25h6", [24.987, 25.0]),
        ("Ø25 +0.021/0", [25.0, 25.021]),
        ("25 +0,021 0", [25.0, 25.021]),
        ("25 ±0.05", [24.95, 25.05]),
        ("25 -0.02", [24.98, 25.0]),
    ] {
        let plan = planned(&hole(&format!("{text:?}"), "linuxcnc", ""));
        let row = plan
            .results
            .iter()
            .find(|row| row.code == "diameter")
            .unwrap();
        assert_eq!(row.nominal, Some(25.0), "{text}");
        let limits = row.limits.unwrap();
        assert!(
            (limits[0] - low).abs() < 1e-9 && (limits[1] - high).abs() < 1e-9,
            "{text}: {limits:?}"
        );
        // A part without deviations is in the middle of the zone.
        assert!(
            (row.value.unwrap() - f64::midpoint(low, high)).abs() < 1e-9,
            "{text}"
        );
        assert_eq!(row.verdict.as_deref(), Some("good"), "{text}");
        assert_eq!(plan.moves, plain.moves, "{text}");
    }
    let drawn = planned(&hole(
        r#""25 H7""#,
        "linuxcnc",
        r#", "part": { "sizes": { "diameter": 0.03 } }"#,
    ));
    let row = drawn
        .results
        .iter()
        .find(|row| row.code == "diameter")
        .unwrap();
    assert_eq!(
        (row.value, row.verdict.as_deref()),
        (Some(25.03), Some("out"))
    );
}

/// The default limit is 0.5 mm beyond the zone.
#[test]
fn what_is_implausible_follows_from_a_size_with_a_tolerance() {
    for (units, size, part, stops) in [
        ("mm", "25 ±0.8", 1.29, false),
        ("mm", "25 ±0.8", 1.31, true),
        ("mm", "25 H7", 0.52, false),
        ("mm", "25 H7", 0.53, true),
        ("inch", "1 ±0.02", 0.0396, false),
        ("inch", "1 ±0.02", 0.0398, true),
    ] {
        let job = job(&format!(
            r#"{{ "format": 1, "units": "{units}", "cycle": {{ "type": "hole", "diameter": "{size}" }}, "control": {{ "post": "linuxcnc", "workOffset": 1 }},
                "part": {{ "sizes": {{ "diameter": {part} }} }} }}"#
        ));
        let plan = planned(&job);
        assert_eq!(run(&plan).0, stops, "{size} {part}");
        // The header contains it: the program that is read back is the same.
        let read = import(&plan.program.text).unwrap().job;
        assert_eq!(planned(&read).program.text, plan.program.text, "{size}");
    }
}

#[test]
fn a_size_with_a_tolerance_comes_back_from_every_header() {
    for post in of_moves() {
        for text in ["25 H7", "25 h6", "25 +0.021 0", "25 ±0.05", "Ø25 js6"] {
            let job = job(&format!(
                r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": "{text}" }}, "control": {{ "post": "{post}" }} }}"#
            ));
            let plan = planned(&job);
            let read = import(&plan.program.text).unwrap_or_else(|e| panic!("{post}: {e:?}"));
            let again = planned(&read.job);
            assert_eq!(again.program.text, plan.program.text, "{post} {text}");
            let of = |plan: &Plan| {
                plan.results
                    .iter()
                    .map(|row| row.limits)
                    .collect::<Vec<_>>()
            };
            assert_eq!(of(&again), of(&plan), "{post} {text}");
        }
    }
}

#[test]
fn a_size_with_a_tolerance_is_converted_named_and_judged_in_a_set_up() {
    let inch = convert_units(&hole(r#""25.4 H7""#, "fanuc", ""), "inch").unwrap();
    assert_eq!(text_at(&inch, &["cycle", "diameter"]), "1 H7");
    let back = convert_units(&inch, "mm").unwrap();
    assert_eq!(text_at(&back, &["cycle", "diameter"]), "25.4 H7");
    for (size, name) in [
        (r#""25 H7""#, "BORE-D25H7"),
        (r#""25 h6""#, "BORE-D25"),
        (r#""25 ±0.05""#, "BORE-D25"),
    ] {
        assert_eq!(touchpath::job::job_name(&hole(size, "fanuc", "")), name);
    }
    let set_up = job(
        r#"{ "format": 2, "control": { "post": "haas", "workOffset": 1 }, "cycles": [
            { "name": "LEFT", "type": "hole", "diameter": "25 H7", "origin": [-40, 0, -5] },
            { "name": "RIGHT", "type": "web", "width": "25 ±0.05", "origin": [40, 0, -5] } ],
            "tolerances": { "LEFT.diameter": { "action": "stop" } } }"#,
    );
    let plan = planned(&set_up);
    let judged: Vec<_> = plan
        .results
        .iter()
        .filter(|row| row.limits.is_some())
        .collect();
    assert_eq!(judged.len(), 2);
    assert_eq!(
        (judged[0].cycle, judged[0].limits),
        (0, Some([25.0, 25.021]))
    );
    assert_eq!(
        (judged[1].cycle, judged[1].limits),
        (1, Some([24.95, 25.05]))
    );
    let read = import(&plan.program.text).unwrap().job;
    assert_eq!(planned(&read).program.text, plan.program.text);
}

#[test]
fn a_tolerance_is_given_once_and_to_what_is_measured() {
    let found = |job: &Value| {
        findings(job)
            .into_iter()
            .filter(|(level, ..)| *level == Level::Error)
            .map(|(_, code, path)| (code, path))
            .collect::<Vec<_>>()
    };
    let of = |code: &str, path: &str| vec![(code.to_owned(), path.to_owned())];
    let twice = r#", "tolerances": { "diameter": { "tolerance": "H7" } }"#;
    assert_eq!(
        found(&hole(r#""25 H7""#, "fanuc", twice)),
        of("tolerance-unknown", "tolerances.diameter.tolerance")
    );
    let beyond = found(&hole(r#""25 ±0.6""#, "fanuc", ""));
    assert_eq!(beyond, of("tolerance-beyond-limit", "cycle.diameter"));
    let long = format!(r#""25 {}H7""#, " ".repeat(70));
    assert_eq!(found(&hole(&long, "fanuc", "")).len(), 1);
    let set_up = job(
        r#"{ "format": 2, "control": { "post": "haas" }, "limits": { "size": 0.01 }, "cycles": [
            { "type": "surface" }, { "type": "hole", "diameter": "25 ±0.05", "origin": [40, 0, -5] } ] }"#,
    );
    assert_eq!(
        found(&set_up),
        of("tolerance-beyond-limit", "cycles[1].diameter")
    );
}
