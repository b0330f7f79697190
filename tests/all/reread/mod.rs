//! Changed, broken or invented programs, read back: each known failure by name.

mod foreign;

use crate::common::import;
use crate::common::{interpret_until_stop, job, number, planned, with};
use touchpath::control::trace::Kind;
use touchpath::form::{Level, Value};
use touchpath::job::{default_job, plan};

fn program(post: &str) -> String {
    let job = with(
        &default_job("internal-rectangle-protected").unwrap(),
        "control.post",
        Value::Text(post.to_owned()),
    );
    planned(&job).program.text
}

/// The codes of warnings and errors.
fn said(text: &str) -> Vec<String> {
    let findings = match import(text) {
        Ok(imported) => imported.findings,
        Err(error) => error.findings,
    };
    findings
        .into_iter()
        .filter(|f| f.level != Level::Info)
        .map(|f| f.code)
        .collect()
}

#[test]
fn numbers_without_their_point_were_read_as_the_same_number() {
    for post in ["fanuc", "haas"] {
        let text = program(post);
        assert_eq!(said(&text), [""; 0], "{post}");
        for (old, new) in [("X42.", "X42"), ("F150.", "F150"), ("Z-10.", "Z-10")] {
            assert!(text.contains(old), "{old}");
            assert_eq!(
                said(&text.replacen(old, new, 1)),
                ["not-understood"],
                "{post} {old}"
            );
        }
    }
}

#[test]
fn a_tape_sign_in_the_middle_ended_the_program_unseen() {
    for post in ["fanuc", "haas"] {
        let text = program(post);
        for place in ["M30\n", "#149=11\n"] {
            assert_eq!(
                said(&text.replacen(place, &format!("{place}%\n"), 1)),
                ["not-understood"],
                "{post} {place}"
            );
        }
    }
}

/// Code after the sign was ignored; no control does that.
#[test]
fn code_behind_a_tape_sign_was_passed_over() {
    for post in crate::tests::controls::of_moves() {
        let text = program(post);
        let text = text.strip_prefix("%\n").unwrap_or(&text);
        for first in [
            "%G0 Z-50",
            "% G0 Z-50",
            "%100 G0 Z-50",
            "%(A) G0 Z-50",
            "%_N_A_MPF G0 Z-50",
        ] {
            let found = said(&format!("{first}\n{text}"));
            assert_eq!(found, ["not-understood"], "{post} {first}");
        }
        for first in ["%", "% (A)", "%100", "%_N_A_MPF"] {
            assert_eq!(said(&format!("{first}\n{text}")), [""; 0], "{post} {first}");
        }
    }
    assert!(interpret_until_stop("%G0 Z-50\nG0 X1\nM2\n").1.is_some());
}

#[test]
fn words_of_a_job_below_the_header_overrode_it() {
    for post in crate::tests::controls::of_moves() {
        let text = program(post);
        let (open, close) = if post == "sinumerik" {
            ("; ", "")
        } else {
            ("(", ")")
        };
        let more = format!("{text}{open}job stylus.repeatability=0.9 cycle.width1=99{close}\n");
        let read = import(&more).unwrap();
        assert_eq!(
            crate::common::number_at(&read.job, "cycle.width1", 0.0),
            80.0,
            "{post}"
        );
        assert!(
            read.findings.iter().any(|f| f.code == "lines-differ"),
            "{post}: {:?}",
            read.findings
        );
    }
}

#[test]
fn another_program_number_and_comments_are_no_change() {
    let text = program("fanuc");
    assert_eq!(said(&text.replacen("O1000", "O0042", 1)), [""; 0]);
    for post in ["linuxcnc", "grbl"] {
        assert_eq!(
            said(&format!("{}; a note\n", program(post))),
            [""; 0],
            "{post}"
        );
    }
}

/// A control starts another program there.
#[test]
fn a_second_program_number_was_passed_over() {
    for post in ["fanuc", "haas"] {
        let text = program(post);
        for (old, new) in [
            ("G21", "O1001\nG21"),
            ("M30\n", "O1001\nM30\n"),
            ("M30\n", "o2\nM30\n"),
            ("O1000", "O1000\nO1001"),
        ] {
            assert!(text.contains(old), "{post} {old}");
            assert_eq!(
                said(&text.replacen(old, new, 1)),
                ["not-understood"],
                "{post} {new}"
            );
        }
    }
    let at_its_end = program("fanuc").replacen("M30\n", "M30\nO1001\n", 1);
    assert_eq!(said(&at_its_end), ["not-understood"]);
}

#[test]
fn a_fault_in_a_fanuc_program_was_said_to_be_another_control() {
    let text = program("fanuc").replacen("#100=#[2000+#4111]", "#100=#[2200+#4111]", 1);
    let found = said(&text);
    assert!(
        found.contains(&"unsafe-program".to_owned())
            || found.contains(&"program-differs".to_owned()),
        "{found:?}"
    );
    let findings = import(&text).unwrap().findings;
    assert!(
        findings.iter().all(|f| f.path != "control.post"),
        "{findings:?}"
    );
}

/// It overflowed the stack, took half a minute to look up its labels, or never ended.
#[test]
fn deep_lists_many_labels_and_endless_programs_come_back() {
    let deep = format!(
        "(job cycle.type=hole cycle.origin={}{})\nG1 X1 F1\n",
        "[".repeat(50_000),
        "]".repeat(50_000)
    );
    let found = said(&deep);
    assert!(
        found.contains(&"not-understood".to_owned())
            || found.contains(&"header-unsound".to_owned()),
        "{found:?}"
    );
    let jumps: String = (1..60_000)
        .map(|i| format!("N{i}\nGOTO {}\n", i + 1))
        .collect();
    let read = import(&format!("{jumps}N60000\nG31 X1. F1.\nM30\n")).unwrap();
    assert_eq!(read.trace.unwrap().moves.len(), 1);
    let slots: String = (0..60_000).map(|i| format!("#<v{i}>=1\n")).collect();
    let read = import(&format!("{slots}G38.2 X1 F100\nM2\n")).unwrap();
    assert_eq!(read.trace.unwrap().moves.len(), 1);
    for program in [
        "#1=0\nN1\nG31 X1. F100.\n#1=#1+1\nIF [#1 LT 900000] GOTO 1\nM30\n".to_owned(),
        "N1\nGOTO 1\nG31 X1. F1.\n".to_owned(),
    ] {
        let error = import(&program).unwrap_err();
        assert!(
            error.findings.iter().any(|f| f.code == "not-understood"),
            "{error}"
        );
    }
}

/// A comment hid a motion from the reader, but not from grbl, which ends a line at a carriage return. LinuxCNC does not.
#[test]
fn a_carriage_return_hid_a_motion() {
    for post in crate::tests::controls::of_moves() {
        let text = program(post);
        let (open, close) = if post == "sinumerik" {
            (";", "")
        } else {
            ("(", ")")
        };
        let (head, blocks) = text.split_at(
            text.find("G1 Z")
                .unwrap_or_else(|| text.find("G17").unwrap()),
        );
        for hidden in [
            format!("{open}NOTE\rG0 Z-50\r{close}\n"),
            format!("{open}NOTE{close}\rG0 Z-50\n"),
            "G90\r".to_owned(),
        ] {
            let found = said(&format!("{head}{hidden}{blocks}"));
            assert!(
                !found.is_empty() && found.iter().all(|code| code == "not-understood"),
                "{post} {hidden:?}: {found:?}"
            );
        }
        // Without text after it, it ends a line like any other.
        for end in ["\r\n", "\r\r\n", "\n\r"] {
            assert_eq!(said(&text.replace('\n', end)), [""; 0], "{post} {end:?}");
        }
    }
    // Lines count as in an editor.
    let error = import("G21\r\n\rG90\n\r\nWHAT\nG38.2 X1 F100\nM2\n").unwrap_err();
    assert!(error.findings[0].message.starts_with("Line 5,"), "{error}");
    let ran = interpret_until_stop("G21\nG0 X1 ;\rG0 X2\nM2\n").0;
    assert_eq!(
        ran.moves.iter().map(|step| step.to[0]).collect::<Vec<_>>(),
        [1.0]
    );
}

/// Each of these took from a minute to hours: the exit of every probing move was followed without need, and a series of points was read again at every point.
#[test]
fn long_exits_and_long_numbers_come_back() {
    let exit = format!("#100=1.{}\n", "+1.".repeat(390)).repeat(190);
    let probing =
        "G31 X1. F100.\nIF [#5061 NE 1.] GOTO 900\nG31 X0. F100.\nIF [#5061 NE 0.] GOTO 900\n";
    let error = import(&format!(
        "G21 G17 G90 G94\nN1\n{probing}GOTO 1\nM30\nN900\n{exit}#3000=1(X)\nM30\n"
    ))
    .unwrap_err();
    assert!(
        error.findings.iter().any(|f| f.code == "not-understood"),
        "{error}"
    );
    for post in ["linuxcnc", "heidenhain"] {
        let (cycle, form) = if post == "heidenhain" {
            ("probing-two-circles", "cycle")
        } else {
            ("hole", "moves")
        };
        let job = with(
            &default_job(cycle).unwrap(),
            "control.post",
            Value::Text(post.to_owned()),
        );
        let plan = planned(&with(&job, "control.form", Value::Text(form.to_owned())));
        let found = said(&format!("{}\n{}", plan.program.text, ".".repeat(1_900_000)));
        assert!(
            found.contains(&"not-understood".to_owned())
                || found.contains(&"program-differs".to_owned()),
            "{found:?}"
        );
    }
}

/// The approach of a program whose first position is the origin was `unchecked`.
#[test]
fn a_program_without_a_job_has_no_unchecked_move() {
    for def in touchpath::cycle::CYCLES
        .iter()
        .filter(|def| def.number.is_some_and(|n| n > 1))
    {
        for post in crate::tests::controls::of_moves() {
            let job = with(
                &default_job(def.key).unwrap(),
                "control.post",
                Value::Text(post.to_owned()),
            );
            let job = with(&job, "control.form", Value::Text("moves".to_owned()));
            let plan = planned(&with(
                &job,
                "control.header",
                Value::Text("short".to_owned()),
            ));
            let trace = import(&plan.program.text).unwrap().trace.unwrap();
            assert_eq!(
                trace
                    .moves
                    .iter()
                    .filter(|m| m.kind == Kind::Unchecked)
                    .count(),
                0,
                "{} {post}",
                def.key
            );
            assert_eq!(
                trace.moves.iter().filter(|m| m.kind == Kind::Touch).count(),
                plan.touches.len(),
                "{} {post}",
                def.key
            );
        }
    }
}

#[test]
fn a_name_of_nothing_stays_nothing() {
    for post in crate::tests::controls::of_moves() {
        let job = with(
            &default_job("hole").unwrap(),
            "control.post",
            Value::Text(post.to_owned()),
        );
        let text = planned(&with(&job, "name", Value::Text(String::new())))
            .program
            .text;
        assert_eq!(
            import(&text).unwrap().job.get("name"),
            Some(&Value::Text(String::new())),
            "{post}"
        );
    }
}

/// Good jobs that were refused as not proven or by a rule.
#[test]
fn good_jobs_are_proven() {
    let corner = with(
        &default_job("double-wall-internal-corner").unwrap(),
        "control.post",
        Value::Text("fanuc".to_owned()),
    );
    for step in [0.001, 0.05, 0.19, 0.21] {
        let job = with(&corner, "cycle.step2", number(step));
        plan(&job).unwrap_or_else(|e| panic!("{step}: {e}"));
    }
    let noisy = r#"{ "format": 1, "cycle": { "type": "web", "touches": [
        { "point": [15, 0.00004, -10], "vector": [1, 0, 0] }, { "point": [-15, -0.00004, -9.99996], "vector": [-1, 0, 0] }] } }"#;
    for (post, protection) in [
        ("grbl", "checked"),
        ("linuxcnc", "none"),
        ("linuxcnc", "checked"),
        ("sinumerik", "checked"),
        ("haas", "checked"),
    ] {
        let job = with(&job(noisy), "control.post", Value::Text(post.to_owned()));
        plan(&with(
            &job,
            "control.protection",
            Value::Text(protection.to_owned()),
        ))
        .unwrap_or_else(|e| panic!("{post}: {e}"));
    }
    let near = r#"{ "format": 1, "units": "inch", "stylus": { "diameter": 0.5 }, "control": { "post": "sinumerik" },
        "cycle": { "type": "probing-two-circles", "clearanceHeight": 3.937, "start": [-26.5504, 0, 3.937007874015748] } }"#;
    plan(&job(near)).unwrap_or_else(|e| panic!("{e}"));
}

/// Klartext: unchanged, the header's job has also the values that no block states; changed, the blocks count.
#[test]
fn a_klartext_program_keeps_what_only_its_header_says() {
    let circles = r#"{ "format": 1, "units": "inch", "stylus": { "diameter": 0.11 }, "control": { "post": "heidenhain", "form": "cycle", "tool": 7 },
        "cycle": { "type": "probing-two-circles", "point1": [-1, 0, -0.3], "point2": [1.5, 0, -0.3], "diameter1": 0.8, "diameter2": "0.75+0.001",
        "clearanceHeight": 3, "start": [0, 0, 3], "probe": { "dist": 0.4, "setUp": 0.05 } } }"#;
    let plan = planned(&job(circles));
    let text = &plan.program.text;
    let read = import(text).unwrap();
    assert_eq!(
        read.findings
            .iter()
            .map(|f| f.code.as_str())
            .collect::<Vec<_>>(),
        ["part-not-in-program"]
    );
    assert_eq!(planned(&read.job).program.text, *text);
    let at = |job: &Value, path: &str| crate::common::number_at(job, path, f64::NAN);
    assert_eq!(
        (
            at(&read.job, "stylus.diameter"),
            at(&read.job, "cycle.probe.dist")
        ),
        (0.11, 0.4)
    );
    // A diameter changed on the control, with its sign as in Klartext.
    let changed = text.replacen("Q1116=+0.8 ", "Q1116=+0.85 ", 1);
    assert_ne!(changed, *text);
    let read = import(&changed).unwrap();
    assert!(
        read.findings.iter().any(|f| f.code == "program-differs"),
        "{:?}",
        read.findings
    );
    assert!(
        !read.findings.iter().any(|f| f.code == "not-in-program"),
        "{:?}",
        read.findings
    );
    assert_eq!(
        (
            at(&read.job, "cycle.diameter1"),
            at(&read.job, "stylus.diameter")
        ),
        (0.85, 0.11)
    );
    assert_eq!(
        read.job.get("cycle").unwrap().get("diameter2"),
        Some(&Value::Text("0.75+0.001".to_owned()))
    );
    assert_eq!(
        (
            at(&read.job, "cycle.probe.dist"),
            at(&read.job, "control.tool")
        ),
        (0.4, 7.0)
    );
    // Truncated in its header, or without one, it is read like any other.
    let bare: String = text
        .lines()
        .filter(|line| !line.contains("; job "))
        .map(|line| format!("{line}\n"))
        .collect();
    let read = import(&bare).unwrap();
    assert_eq!(at(&read.job, "cycle.diameter1"), 0.8);
    assert!(read.findings.iter().any(|f| f.code == "not-in-program"));
}

/// The header's millimetres became inches, 25.4 times as long.
#[test]
fn a_klartext_program_in_other_units_converts_its_header() {
    let own = with(
        &default_job("probing-two-circles").unwrap(),
        "control.post",
        Value::Text("heidenhain".to_owned()),
    );
    let text = planned(&with(&own, "control.form", Value::Text("cycle".to_owned())))
        .program
        .text;
    let at = |job: &Value, path: &str| crate::common::number_at(job, path, f64::NAN);
    let read = import(&text.replace("CIRCLES-D20 MM", "CIRCLES-D20 INCH")).unwrap();
    assert!(
        read.findings
            .iter()
            .any(|f| f.code == "units-differ" && f.level == Level::Warning),
        "{:?}",
        read.findings
    );
    assert_eq!(read.job.get("units"), Some(&Value::Text("inch".to_owned())));
    assert_eq!(
        (
            at(&read.job, "stylus.diameter"),
            at(&read.job, "cycle.probe.dist")
        ),
        (0.23622, 0.393701)
    );
    let Some(Value::List(start)) = read.job.get("cycle").unwrap().get("start") else {
        panic!()
    };
    assert_eq!(start[2], number(3.937008));
    // Values of the blocks are in the units of the blocks.
    assert_eq!(
        at(&read.job, "cycle.diameter1"),
        at(&own, "cycle.diameter1")
    );
    // Blocks without units are in those of the header.
    let inch = planned(&with(
        &touchpath::job::convert_units(&own, "inch").unwrap(),
        "control.form",
        Value::Text("cycle".to_owned()),
    ));
    let bare: String = inch
        .program
        .text
        .lines()
        .filter(|line| !line.contains(" PGM "))
        .map(|line| format!("{line}\n"))
        .collect();
    let read = import(&bare).unwrap();
    assert_eq!(
        (read.job.get("units"), at(&read.job, "stylus.diameter")),
        (Some(&Value::Text("inch".to_owned())), 0.23622)
    );
    assert!(
        !read.findings.iter().any(|f| f.code.starts_with("units-")),
        "{:?}",
        read.findings
    );
}

/// It was one of the ignored blocks, and the start of the job stayed unchanged.
#[test]
fn a_motion_before_the_cycle_was_a_note() {
    let own = with(
        &default_job("probing-two-circles").unwrap(),
        "control.post",
        Value::Text("heidenhain".to_owned()),
    );
    let text = planned(&with(&own, "control.form", Value::Text("cycle".to_owned())))
        .program
        .text;
    let at = text
        .lines()
        .find(|line| line.contains("TCH PROBE"))
        .unwrap();
    let number = at.trim_start().split(' ').next().unwrap();
    let with_block = |block: &str| text.replacen(at, &format!("{number} {block}\n{at}"), 1);
    assert_eq!(said(&text), [""; 0]);
    for block in [
        "L Z-50 R0 FMAX",
        "l z-50",
        "CC X+0 Y+0\nC X+10 Y+0 DR+",
        "CALL LBL 1",
        "G00 G90 Z+5",
        "G17 G0 Z+5",
        "X+10,5 Y+0",
    ] {
        let findings = import(&with_block(block)).unwrap().findings;
        let found = findings
            .iter()
            .find(|f| f.code == "moves-before-cycle")
            .unwrap_or_else(|| panic!("{block}: {findings:?}"));
        assert!(
            found.level == Level::Warning && found.message.contains(block.lines().last().unwrap()),
            "{}",
            found.message
        );
    }
    for block in [
        "M5",
        "CYCL DEF 7.1 X+10",
        "G54 X+10",
        "STOP",
        "G04 F2",
        "FN 0: Q5 = +3",
        "LBL 1",
    ] {
        let found = said(&with_block(block));
        assert!(
            !found
                .iter()
                .any(|code| code == "moves-before-cycle" || code == "unsafe-program"),
            "{block}: {found:?}"
        );
    }
    for block in ["M3", "L Z+100 R0 FMAX M03", "S500 M13"] {
        assert!(
            said(&with_block(block)).contains(&"unsafe-program".to_owned()),
            "{block}"
        );
    }
    // After the cycle it does not change the job.
    let behind = text.replacen(" END PGM", " L Z+200 R0 FMAX M3\n99 END PGM", 1);
    assert!(
        !said(&behind)
            .iter()
            .any(|code| code == "moves-before-cycle" || code == "unsafe-program")
    );
}
