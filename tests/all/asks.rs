//! The question before the write: values on the screen, M0, cycle start writes, reset leaves everything as it was.

use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{import, interpret, job, number, on_virtual_part, planned, with};
use crate::tests::set_ups::computed::{faces, on_part, run as run_calls};
use touchpath::control::POSTS;
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, check, check_program, plan};

const WRITING: [&str; 4] = ["linuxcnc", "sinumerik", "fanuc", "haas"];

/// A bore of 25 H7 that a part has this much larger.
fn bore(post: &str, ask: &str, larger: f64) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": "25 H7" }}, "part": {{ "offset": [1, 0.5, 0], "sizes": {{ "diameter": {larger} }} }},
            "control": {{ "post": "{post}", "workOffset": 1, "ask": "{ask}" }} }}"#
    ))
}

/// Blocks of the program from its last touch to its write.
fn before_the_write(plan: &Plan) -> String {
    let text = &plan.program.text;
    let write = ["\nG10 ", "\n$P_UIFR", "\n#5221="]
        .into_iter()
        .find_map(|word| text.find(word));
    let write = write.expect("it writes");
    let touch = ["G38.2", "MEAS=1", "G31"]
        .into_iter()
        .filter_map(|word| text[..write].rfind(word))
        .max();
    text[touch.expect("it touches")..write].to_owned()
}

/// A simulated Fanuc or Haas above the part, at the touches of the virtual part.
fn control(post: &str, plan: &Plan) -> Control {
    let mut control = Control::new(post == "haas", false);
    control.at = [0.0, 0.0, 200.0];
    control.contacts = plan.triggers.iter().flatten().copied().collect();
    let origins = (5221..5224).map(|origin| (origin, 0.0));
    control.variables.extend(origins);
    control
}

/// The simulated controls, at the touches of the virtual part. Number of waits, and whether a work offset was written.
fn run(post: &str, plan: &Plan, text: &str) -> (usize, bool) {
    if post == "sinumerik" {
        let mut machine = Machine::new(plan.triggers.clone());
        machine
            .run(&read(text).expect("a program"))
            .expect("it runs");
        return (machine.waits, machine.writes > 0);
    }
    let mut control = control(post, plan);
    control
        .run(text)
        .unwrap_or_else(|why| panic!("{post}: {why}\n{text}"));
    assert_eq!(control.alarm, None, "{post}");
    (control.stops, !control.writes.is_empty())
}

#[test]
fn a_program_waits_between_its_results_and_its_write() {
    for post in WRITING {
        let never = planned(&bore(post, "never", 0.0));
        assert!(!before_the_write(&never).contains("\nM0\n"), "{post}");
        let plan = planned(&bore(post, "always", 0.0));
        let before = before_the_write(&plan);
        assert!(before.contains("\nM0\n"), "{post}\n{before}");
        assert!(
            before
                .to_lowercase()
                .contains("cycle start writes the work offset"),
            "{post}"
        );
        // The values are on the screen before the program waits.
        let shows = before.to_lowercase().find("diameter").expect("a value");
        assert!(shows < before.rfind("\nM0\n").expect("it waits"), "{post}");
        let rule = plan
            .safety
            .iter()
            .find(|row| row.rule == "asked-before-write");
        assert_eq!(rule.and_then(|row| row.holds), Some(true), "{post}");
        assert!(
            never
                .safety
                .iter()
                .all(|row| row.rule != "asked-before-write")
        );
        // Started again at every block, also after a reset while it waits.
        let asking = bore(post, "always", 0.0);
        let rows = check_program(&asking, &plan.program.text)
            .expect("it is read")
            .expect("it is understood");
        assert!(
            rows.iter().all(|row| row.holds != Some(false)),
            "{post}: {rows:?}"
        );
        if post == "linuxcnc" {
            let ran = interpret(&on_virtual_part(&plan)).expect("it runs");
            assert!(
                ran.messages
                    .iter()
                    .any(|message| message.contains("Cycle start writes")),
                "{:?}",
                ran.messages
            );
            assert_eq!(ran.offsets_after_moves.last(), Some(&[1.0, 0.5, 0.0]));
        } else {
            let (waits, wrote) = run(post, &plan, &plan.program.text);
            assert!(waits > 0 && wrote, "{post} {waits}");
            // Results are not shown again.
            assert!(
                waits <= run(post, &never, &never.program.text).0 + 1,
                "{post}"
            );
        }
    }
}

/// 25 H7 is 25 to 25.021 mm; its middle is that of the virtual part unless it states a size.
#[test]
fn it_waits_outside_the_tolerance_only() {
    for post in ["sinumerik", "fanuc", "haas"] {
        let usual = run(
            post,
            &planned(&bore(post, "never", 0.01)),
            &planned(&bore(post, "never", 0.01)).program.text,
        )
        .0;
        for (larger, asks) in [
            (0.01, false),
            (0.0205, false),
            (0.0215, true),
            (-0.0005, true),
        ] {
            let plan = planned(&bore(post, "outside", larger));
            let (waits, wrote) = run(post, &plan, &plan.program.text);
            assert!(wrote, "{post} {larger}");
            assert_eq!(waits > usual, asks, "{post} {larger}: {waits} {usual}");
        }
    }
    for (larger, asks) in [(0.01, false), (0.0215, true)] {
        let plan = planned(&bore("linuxcnc", "outside", larger));
        let ran = interpret(&on_virtual_part(&plan)).expect("it runs");
        let shown = ran
            .messages
            .iter()
            .any(|message| message.contains("Cycle start writes"));
        assert_eq!(shown, asks, "{larger}: {:?}", ran.messages);
    }
}

/// Reset while the program waits, then a start at every later block: nothing is written. Judges: the tests' own Fanuc and Haas; a reset clears #1 to #33.
#[test]
fn a_reset_at_the_question_leaves_everything_as_it_was() {
    for post in ["fanuc", "haas"] {
        let plan = planned(&bore(post, "always", 0.0));
        let lines: Vec<&str> = plan.program.text.lines().collect();
        let waits = lines
            .iter()
            .position(|line| *line == "M0")
            .expect("it waits");
        let mut control = control(post, &plan);
        let mut until = lines[..waits].to_vec();
        until.push("M30");
        until.extend(&lines[waits..]);
        control
            .run(&(until.join("\n") + "\n"))
            .unwrap_or_else(|why| panic!("{post}: {why}"));
        assert!(control.writes.is_empty());
        let first = lines
            .iter()
            .rposition(|line| line.starts_with("G31"))
            .expect("a touch");
        for start in first + 1..lines.len() - 1 {
            let mut again = Control::new(post == "haas", false);
            again.at = control.at;
            again.variables.clone_from(&control.variables);
            (1..=33).for_each(|local| {
                again.variables.insert(local, 0.0);
            });
            let _ = again.run(&(lines[start..].join("\n") + "\n"));
            assert!(
                again.writes.is_empty(),
                "{post}: started at {}",
                lines[start]
            );
        }
    }
}

#[test]
fn a_question_that_cannot_be_asked_is_reported() {
    let found = |job: &Value| -> Vec<String> {
        let all = match plan(job) {
            Ok(plan) => plan.findings,
            Err(error) => error.findings,
        };
        all.into_iter()
            .map(|f| f.code)
            .filter(|code| code.starts_with("ask-"))
            .collect()
    };
    let text = |text: &str| Value::Text(text.to_owned());
    for post in WRITING {
        assert!(found(&bore(post, "always", 0.0)).is_empty(), "{post}");
    }
    let fanuc = bore("fanuc", "always", 0.0);
    assert_eq!(
        found(&with(&fanuc, "control.workOffset", Value::Null)),
        ["ask-unused"]
    );
    let native = |post: &str, ask: &str| with(&bore(post, ask, 0.0), "control.form", text("cycle"));
    for (post, ask, wanted) in [
        ("sinumerik", "always", "ask-unsupported"),
        ("fanuc", "outside", "ask-unsupported"),
        ("heidenhain", "outside", "ask-unsupported"),
    ] {
        assert_eq!(found(&native(post, ask)), [wanted], "{post}");
    }
    // 1411 corrects the active preset itself; if it only measures, there is nothing to ask.
    for (transfer, wanted) in [("1", "ask-unsupported"), ("0", "ask-unused")] {
        let circles = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "transferPosition": {transfer}, "confirmRotation": 0 }},
                "control": {{ "post": "heidenhain", "form": "cycle", "ask": "always" }} }}"#
        ));
        assert_eq!(found(&circles), [wanted], "{transfer}");
    }
    let measures = with(
        &native("mazak", "always"),
        "control.workOffset",
        Value::Null,
    );
    assert_eq!(found(&measures), ["ask-unused"]);
    assert!(found(&native("haas", "always")).is_empty());
    assert_eq!(
        found(&with(&fanuc, "control.report", text("log"))),
        ["ask-unsupported"]
    );
    let plain = with(
        &bore("fanuc", "outside", 0.0),
        "cycle.diameter",
        number(25.0),
    );
    assert_eq!(found(&plain), ["ask-unsupported"]);
    let wrong = check(&with(&fanuc, "control.ask", text("sometimes")));
    assert!(
        wrong
            .iter()
            .any(|f| (f.code.as_str(), f.path.as_str()) == ("unknown-value", "control.ask"))
    );
}

/// A control that reads on while it waits would write before the operator answers: such a program is not understood.
#[test]
fn nothing_is_written_while_it_waits() {
    for (post, halt) in [
        ("linuxcnc", "M66 E0 L0"),
        ("sinumerik", "STOPRE"),
        ("fanuc", "G53"),
        ("haas", "G103 P1"),
    ] {
        let asking = bore(post, "always", 0.0);
        let text = planned(&asking).program.text;
        let waits = format!("\nM0\n{halt}\n");
        assert_eq!(text.matches(&waits).count(), 1, "{post}\n{text}");
        let changed = text.replace(&waits, "\nM0\n");
        let read = check_program(&asking, &changed).expect("it is read");
        assert!(
            read.is_err() || read.is_ok_and(|rows| rows.iter().any(|row| row.holds == Some(false))),
            "{post}"
        );
    }
}

/// A result of a set-up that has a second register is compared where the program reads it.
#[test]
fn results_of_a_set_up_are_asked() {
    let set_up = std::fs::read_to_string("examples/set-ups/two-holes.json").expect("a job");
    for post in ["sinumerik", "linuxcnc"] {
        let given = with(&job(&set_up), "control.post", Value::Text(post.to_owned()));
        let given = with(&given, "control.workOffset", number(2.0));
        let given = with(&given, "control.ask", Value::Text("outside".to_owned()));
        for action in ["go", "mark", "stop"] {
            let tolerance = job(&format!(
                r#"{{ "BOTH.Q994": {{ "tolerance": "±0.1", "action": "{action}" }} }}"#
            ));
            planned(&with(&given, "tolerances", tolerance));
        }
    }
}

/// Part before the question, and part after it.
fn halves<'t>(text: &'t str, wait: &str) -> [&'t str; 2] {
    let (before, after) = text
        .split_once(wait)
        .unwrap_or_else(|| panic!("{wait}\n{text}"));
    [before, after]
}

/// Calls of measuring macros.
fn macros(text: &str) -> Vec<&str> {
    let called = |line: &&str| line.contains("98") || line.contains("88");
    let lines = text
        .lines()
        .filter(|line| line.starts_with("G65 P") || line.starts_with("CALL O"));
    lines.filter(called).collect()
}

/// Renishaw's macros measure and write in one call. So they measure without S first, and again with it: a reset at the question leaves everything as it was, and a
/// start behind it measures again.
#[test]
fn macros_measure_without_a_write_first() {
    for post in ["fanuc", "haas", "mazak", "brother", "hurco", "okuma"] {
        let ask = |ask: &str| {
            with(
                &bore(post, ask, 0.0),
                "control.form",
                Value::Text("cycle".to_owned()),
            )
        };
        let plan = planned(&ask("always"));
        let text = &plan.program.text;
        let [before, after] = halves(text, "\nM0\n");
        assert!(!after.contains("\nM0\n"), "{post}: shown once\n{text}");
        let writes = |line: &&str| line.contains(" S1.") || line.contains(" PS=1.");
        let [first, again] = [before, after].map(macros);
        assert_eq!(
            first.iter().filter(|line| writes(line)).count(),
            0,
            "{text}"
        );
        assert_eq!(
            again.iter().filter(|line| writes(line)).count(),
            1,
            "{text}"
        );
        // Behind the question the program is that of a job that never asks, but for the probe, which is on already, and a move up.
        let never = planned(&ask("never")).program.text;
        let never = macros(&never);
        let on = usize::from(post != "hurco");
        assert_eq!(again[1..], never[on..], "{post}");
        assert!(
            again[0].contains("98") || again[0].contains("8810"),
            "{post}: {again:?}"
        );
        assert!(
            plan.findings
                .iter()
                .any(|finding| finding.code == "measured-twice"),
            "{post}"
        );
        let back = import(text).expect("it is read");
        assert!(
            back.findings
                .iter()
                .all(|finding| finding.code != "program-differs"),
            "{post}: {:?}",
            back.findings
        );
        assert_eq!(planned(&back.job).program.text, *text, "{post}");
        // The moves of the plan are those of the first run.
        let begins = before.lines().count() as i32 + 1;
        let lines = plan.program.move_lines.iter().filter(|line| **line >= 0);
        assert!(
            lines.clone().count() > 0 && lines.clone().all(|line| *line < begins),
            "{post}"
        );
    }
}

/// A top, and a bore that follows its height.
const BORE_BELOW_TOP: &str = r#"{ "format": 2, "control": { "form": "cycle", "ask": "always", "workOffset": 3 }, "limits": { "position": 1 }, "cycles": [
    { "name": "TOP", "type": "surface", "origin": [-35, 0, 0] },
    { "name": "BORE", "type": "hole", "diameter": 25, "origin": [0, 0, "=TOP.z"] } ] }"#;

const ONE_BORE: &str = r#"{ "format": 1, "control": { "form": "cycle", "ask": "always", "workOffset": 3 },
    "cycle": { "type": "hole", "diameter": 25, "origin": [0, 0, 0] } }"#;

/// The simulated machine touches the same points twice, on a displaced part, also where a cycle follows a result.
#[test]
fn a_program_that_measures_first_touches_everything_twice() {
    for (post, text) in [
        ("fanuc", BORE_BELOW_TOP),
        ("haas", BORE_BELOW_TOP),
        ("mazak", BORE_BELOW_TOP),
        ("heidenhain", ONE_BORE),
    ] {
        let offset = [0.3, -0.2, 0.1];
        let job = on_part(text, post, false, offset);
        let def = POSTS.iter().find(|def| def.key == post).expect("a control");
        let asking = planned(&job);
        let ran = run_calls(&asking, def, 1.0, &faces(true, offset));
        assert_eq!(ran.stopped, None, "{post}");
        let half = ran.contacts.len() / 2;
        assert!(half >= 4 && ran.contacts.len() == 2 * half, "{post}");
        for (one, other) in ran.contacts[..half].iter().zip(&ran.contacts[half..]) {
            for axis in 0..3 {
                assert!(
                    (one[axis] - other[axis]).abs() < 1e-6,
                    "{post}: {one:?} {other:?}"
                );
            }
        }
        if post == "heidenhain" {
            let rows = ran.rows.iter().map(|(n, row)| (*n, row.as_str()));
            assert_eq!(rows.collect::<Vec<_>>(), [(412, "3"), (247, "3")]);
        }
        // All moves are made twice.
        let once = planned(&with(&job, "control.ask", Value::Text("never".to_owned())));
        assert!((asking.length - 2.0 * once.length).abs() < 1e-6, "{post}");
        assert!((asking.time - 2.0 * once.time).abs() < 1e-9, "{post}");
    }
}

/// A tool is corrected after the question, too: before it no call names it.
#[test]
fn no_tool_is_corrected_before_the_question() {
    let wear = r#"{ "diameter": { "tolerance": "±0.05", "wear": WEAR } }"#;
    let asking = |post: &str, wear_as: &str, report: &str, ask: &str| {
        let wear = touchpath::job::from_json(&wear.replace("WEAR", wear_as)).unwrap();
        let job = with(
            &bore(post, ask, 0.0),
            "control.form",
            Value::Text("cycle".to_owned()),
        );
        let job = with(&job, "control.workOffset", Value::Null);
        let job = with(&job, "cycle.diameter", number(25.0));
        let job = with(&job, "control.report", Value::Text(report.to_owned()));
        with(&job, "tolerances", wear)
    };
    let text = planned(&asking(
        "haas",
        r#"{ "tool": 5, "percent": 50, "deadBand": 0.01 }"#,
        "screen",
        "always",
    ))
    .program
    .text;
    let [before, after] = halves(&text, "\nM0\n");
    let call = "G65 P9814 D25. Q2.";
    assert!(before.contains(&format!("{call} H0.5\n")), "{text}");
    assert!(
        after.contains(&format!("{call} T5. F0.5 V0.005 H0.5\n")),
        "{text}"
    );
    assert!(
        before.contains("(CORRECTS TOOL OFFSET 5: BY THE MACROS, AFTER THE RESULTS WERE SHOWN."),
        "{text}"
    );
    let mean = r#"{ "tool": 5, "parts": 3, "store": 20 }"#;
    let text = planned(&asking("haas", mean, "screen", "always"))
        .program
        .text;
    let [before, after] = halves(&text, "\nM0\n");
    assert!(
        !before.contains("G65 P9835") && after.contains("G65 P9835 T5."),
        "{text}"
    );
    let text = planned(&asking(
        "heidenhain",
        r#"{ "tool": 5 }"#,
        "screen",
        "always",
    ))
    .program
    .text;
    let tools: Vec<&str> = text.lines().filter(|line| line.contains("Q330=")).collect();
    assert_eq!(
        tools,
        ["    Q330=+0 ;TOOL NUMBER", "    Q330=+5 ;TOOL NUMBER"]
    );
    let [first, _] = halves(&text, "Q330=+5");
    assert!(first.contains("Q281=+2 "), "{text}");
    for (report, ask) in [("log", "always"), ("screen", "outside")] {
        for post in ["haas", "heidenhain"] {
            let error = plan(&asking(post, r#"{ "tool": 5 }"#, report, ask)).expect_err("refused");
            assert!(
                error.findings.iter().any(|f| f.code == "ask-unsupported"),
                "{post} {report} {ask}"
            );
        }
    }
}

/// A HEIDENHAIN measures by other cycles than those that write: they show their results and stop by Q281 = 2.
#[test]
fn cycles_of_a_heidenhain_measure_first() {
    let job = with(
        &bore("heidenhain", "always", 0.0),
        "control.form",
        Value::Text("cycle".to_owned()),
    );
    let text = planned(&job).program.text;
    let [before, after] = halves(&text, "TCH PROBE 412");
    let [_, measuring] = halves(before, "TCH PROBE 421");
    assert!(
        measuring.contains("Q281=+2 ") && !measuring.contains("Q305"),
        "{text}"
    );
    assert!(
        after.contains("Q305=+1 ") && !after.contains("TCH PROBE 421"),
        "{text}"
    );
    let back = import(&text).expect("it is read");
    assert!(
        back.findings
            .iter()
            .all(|finding| finding.code != "program-differs"),
        "{:?}",
        back.findings
    );
    assert_eq!(planned(&back.job).program.text, text);
    let unchecked = |ask: &str| {
        let job = with(&job, "control.ask", Value::Text(ask.to_owned()));
        let findings = planned(&job).findings;
        findings
            .iter()
            .any(|finding| finding.code == "limits-not-asked")
    };
    // It is the second measurement that is written.
    assert!(unchecked("never") && unchecked("always"));
    assert!(measuring.contains("Q309=+1 "), "{text}");
    // In a set-up not all of them can measure first; three touches are for cycles that write only.
    let three = r#"{ "format": 1, "control": { "post": "heidenhain", "form": "cycle", "ask": "ASK", "workOffset": 1 },
        "cycle": { "type": "hole", "diameter": 25, "variant": 1, "angularStep": 120, "stepCount": 3 } }"#;
    let two = r#"{ "format": 2, "control": { "post": "heidenhain", "form": "cycle", "ask": "ASK", "workOffset": 3 }, "cycles": [
        { "name": "A", "type": "surface", "origin": [-35, 0, 0] }, { "name": "B", "type": "hole", "diameter": 25 } ] }"#;
    for text in [two, three] {
        let asking = |ask: &str| crate::common::job(&text.replace("ASK", ask));
        planned(&asking("never"));
        let refused = plan(&asking("always")).expect_err("refused").findings;
        let errors = refused
            .iter()
            .filter(|finding| finding.level == Level::Error);
        let codes: Vec<&str> = errors.map(|finding| finding.code.as_str()).collect();
        assert_eq!(codes, ["ask-unsupported"], "{text}");
    }
}
