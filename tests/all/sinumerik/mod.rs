//! SINUMERIK: the programs are read back, run on a simulated control, and broken on purpose.

mod stops;

use crate::common::mpf::{Program, Statement, read};
use crate::common::sinumerik::Machine;
use crate::common::{job, number, planned, point, values, with};
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, check, default_job};

/// Every job of the repository that a SINUMERIK supports, converted for it, and its own ones.
fn plans() -> Vec<(String, Value, Plan)> {
    crate::common::unlimited_jobs()
        .into_iter()
        .filter_map(|(name, job)| {
            let own = crate::common::planned(&job).program.post == "sinumerik";
            let job = if own {
                job
            } else {
                let job = with(&job, "control.post", Value::Text("sinumerik".to_owned()));
                with(
                    &with(&job, "control.form", Value::Text("moves".to_owned())),
                    "control.workOffset",
                    number(7.0),
                )
            };
            let plan = touchpath::job::plan(&job).ok()?;
            Some((name, job, plan))
        })
        .collect()
}

fn parsed(plan: &Plan) -> Program {
    let program =
        read(&plan.program.text).unwrap_or_else(|t| panic!("{t:?}\n{}", plan.program.text));
    assert_eq!(program.troubles(), [], "{}", plan.program.text);
    program
}

fn machine(job: &Value, plan: &Plan) -> Machine {
    let mut machine = Machine::new(plan.triggers.clone());
    machine.metric = job.get("units") != Some(&Value::Text("inch".to_owned()));
    machine
}

fn axes(job: &Value) -> [usize; 3] {
    match job.get("plane") {
        Some(Value::Text(p)) if p == "G18" => [2, 0, 1],
        Some(Value::Text(p)) if p == "G19" => [1, 2, 0],
        _ => [0, 1, 2],
    }
}

fn moves_form(plan: &Plan) -> bool {
    !plan.program.text.contains("CYCLE977")
}

#[test]
fn on_the_virtual_part_the_program_computes_the_results_that_are_shown() {
    let (mut compared, mut deviating) = (0, 0);
    for (name, job, plan) in plans().into_iter().filter(|(.., plan)| moves_form(plan)) {
        let program = parsed(&plan);
        let mut machine = machine(&job, &plan);
        machine
            .run(&program)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        if plan.triggers.contains(&None) {
            assert!(machine.message.starts_with("No contact"), "{name}");
            assert_eq!(machine.writes, 0, "{name}");
            continue;
        }
        assert_eq!(machine.alarm, None, "{name}: {}", machine.message);
        // R parameters of the results, as stated in the program. Verdicts and single touches are not computed by it.
        let found: Vec<&str> = plan
            .program
            .text
            .lines()
            .filter_map(|l| l.strip_prefix("; Results: "))
            .collect();
        assert_eq!(found.is_empty(), plan.touches.is_empty(), "{name}");
        for entry in found.iter().flat_map(|line| line.split(", ")) {
            let (register, code) = entry.split_once(" = ").unwrap();
            let held = machine.r[&register[1..].parse::<usize>().unwrap()];
            let row = plan
                .results
                .iter()
                .find(|r| r.code == code)
                .unwrap_or_else(|| panic!("{name}: {code}"));
            // Angles in millionths of a degree: constants of the program have 12 decimals.
            assert!(
                (held - row.value.unwrap()).abs() < 2e-6,
                "{name}: {register} = {held}, {code} is {:?}",
                row.value
            );
            compared += 1;
            deviating += usize::from(row.deviation.is_some_and(|d| d.abs() > 0.01));
        }
    }
    assert!(compared > 150 && deviating > 20, "{compared} {deviating}");
}

/// With a shift and a rotation already in the frame, the measured feature must come to its nominal position: the machine position of the measured point in the
/// old frame is that of the nominal point in the new one.
#[test]
fn the_frame_is_written_once_and_is_right_under_a_turn_that_was_there() {
    let mut seen = 0;
    for (name, job, plan) in plans().into_iter().filter(|(.., plan)| moves_form(plan)) {
        let program = parsed(&plan);
        let mut machine = machine(&job, &plan);
        let [a, o, w] = axes(&job);
        machine.frame[0] = [7.0, -3.0, 2.0];
        machine.frame[1][w] = 25.0;
        machine.frame[4] = [0.3, -0.2, 0.1];
        let before = machine.frame;
        machine
            .run(&program)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let places: Vec<_> = ["center", "corner"]
            .iter()
            .filter_map(|base| {
                let row = |axis: &str| {
                    plan.results
                        .iter()
                        .find(|r| r.code == format!("{base}.{axis}"))
                };
                Some((row("x")?, row("y")?))
            })
            .collect();
        let [(x, y)] = places.as_slice() else {
            continue;
        };
        let (Some(mx), Some(my)) = (x.value, y.value) else {
            continue;
        };
        let place = |frame: &[[f64; 3]; 5], x: f64, y: f64| {
            let (sin, cos) = frame[1][w].to_radians().sin_cos();
            [
                frame[0][a] + frame[4][a] + x * cos - y * sin,
                frame[0][o] + frame[4][o] + x * sin + y * cos,
            ]
        };
        if job.get("control").and_then(|c| c.get("workOffset")) == Some(&Value::Null)
            || machine.writes == 0
        {
            assert_eq!(machine.frame, before, "{name}");
            continue;
        }
        let (old, new) = (
            place(&before, mx, my),
            place(&machine.frame, x.nominal.unwrap(), y.nominal.unwrap()),
        );
        assert!(
            (old[0] - new[0]).abs() < 1e-6 && (old[1] - new[1]).abs() < 1e-6,
            "{name}: {old:?} {new:?}"
        );
        let height = plan
            .results
            .iter()
            .find(|r| r.code == "offset.z")
            .map(|r| r.value.unwrap());
        let moved = machine.frame[0][w] - before[0][w];
        assert!(
            (moved - height.unwrap_or(0.0)).abs() < 1e-9,
            "{name}: the tool axis moves by {moved}"
        );
        assert_eq!(
            machine.writes,
            2 + usize::from(height.is_some()),
            "{name}: one write an axis"
        );
        seen += 1;
    }
    assert!(seen >= 10, "{seen}");
}

/// A rotation too: two circles, both centres and the line between them come to their nominal positions.
#[test]
fn the_turn_of_two_circles_is_written_with_the_shift() {
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "point1": [-40, 10, -5], "point2": [60, 30, -5],
        "confirmRotation": 1, "transferPosition": 3 }, "control": { "post": "sinumerik", "form": "moves", "workOffset": 1 },
        "part": { "offset": [0.6, -0.4, 0], "rotation": 0.7 } }"#,
    );
    let plan = planned(&job);
    let mut machine = machine(&job, &plan);
    (machine.frame[0], machine.frame[1][2]) = ([100.0, 50.0, 0.0], 12.0);
    let before = machine.frame;
    machine.run(&parsed(&plan)).unwrap();
    let value = |code: &str| {
        plan.results
            .iter()
            .find(|r| r.code == code)
            .unwrap()
            .value
            .unwrap()
    };
    assert!(
        (machine.frame[1][2] - 12.7).abs() < 1e-3,
        "{:?}",
        machine.frame
    );
    let place = |frame: &[[f64; 3]; 5], p: [f64; 2]| {
        let (sin, cos) = frame[1][2].to_radians().sin_cos();
        [
            frame[0][0] + p[0] * cos - p[1] * sin,
            frame[0][1] + p[0] * sin + p[1] * cos,
        ]
    };
    // The midpoint of both circles is transferred.
    let middle = [
        (value("Q950") + value("Q953")) / 2.0,
        (value("Q951") + value("Q954")) / 2.0,
    ];
    let (old, new) = (place(&before, middle), place(&machine.frame, [10.0, 20.0]));
    assert!(
        (old[0] - new[0]).abs() < 1e-6 && (old[1] - new[1]).abs() < 1e-6,
        "{old:?} {new:?}"
    );
}

/// Real calls of CYCLE977 from the field, and ours: the same positions have the same kind of value.
#[test]
fn the_call_of_the_cycle_has_its_arguments_where_real_calls_have_them() {
    let arguments = |line: &str| -> Vec<Option<String>> {
        let program = read(line).unwrap();
        let Statement::Call(name, arguments) = &program.blocks[0].statement else {
            panic!("{line}")
        };
        assert_eq!(name, "CYCLE977");
        arguments
            .iter()
            .map(|a| a.as_ref().map(|t| format!("{t:?}")))
            .collect()
    };
    // A bore with a protection zone that corrects G54; the newer example has two more arguments.
    let zone =
        "CYCLE977(1101,10001,,1,32,,,7,5,11,16,5,,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,11,-3,15)";
    let bore = "CYCLE977(101,9000,,1,32,,,10,5,0,1,1,,,1,\"\",,0,0.2,0.1,-0.1,0.34,1,0,,1,1)";
    let plan = planned(&job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected", "width1": 80, "width2": 50, "depth": 10,
        "topClearance": 10, "sideClearance1": 8, "sideClearance2": 8 }, "overtravel": 4,
        "control": { "post": "sinumerik", "form": "cycle", "workOffset": 1 } }"#,
    ));
    let line = plan
        .program
        .text
        .lines()
        .find(|l| l.starts_with("CYCLE977"))
        .unwrap();
    // By hand: 80 and 50 wide; path 8 - 3; safe range 4; down 10 + 10; zone 80 - 2*(8+3), 50 - 2*(8+3).
    assert_eq!(
        line,
        "CYCLE977(1105,10001,,1,,80,50,5,4,0,20,58,28,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,11,0,0)"
    );
    // The centre is that of the job, or the control would set zero onto the feature.
    let elsewhere = planned(&job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected", "origin": [120, -35.5, 4] },
        "control": { "post": "sinumerik", "form": "cycle", "workOffset": 3 } }"#,
    ));
    assert!(
        elsewhere
            .program
            .text
            .contains(",0.34,1,0,,1,11,120,-35.5)\n"),
        "{}",
        elsewhere.program.text
    );
    // 2, and 22 to 24, are empty if nothing is corrected.
    let measured = planned(&job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected" }, "control": { "post": "sinumerik", "form": "cycle" } }"#,
    ));
    assert!(
        measured.program.text.contains("CYCLE977(1005,,,1,,80,50,"),
        "{}",
        measured.program.text
    );
    assert!(
        measured
            .program
            .text
            .contains(",1.01,1.01,-1.01,,,,,1,11,0,0)\n"),
        "{}",
        measured.program.text
    );
    assert_eq!(
        measured.program.text.matches("NOT VERIFIED").count(),
        1,
        "what is open stays marked"
    );
    let inches = planned(&job(
        r#"{ "format": 1, "units": "inch", "cycle": { "type": "internal-rectangle-protected" },
        "control": { "post": "sinumerik", "form": "cycle" } }"#,
    ));
    assert!(
        inches
            .program
            .text
            .contains("NOT VERIFIED: the measuring path is written in inches")
    );
    let (ours, zone, bore) = (arguments(line), arguments(zone), arguments(bore));
    assert_eq!((ours.len(), bore.len(), zone.len()), (29, 27, 29));
    for (i, argument) in ours.iter().enumerate() {
        // A rectangle has its two lengths in arguments that a bore leaves empty, no diameter, and a second extent of its zone.
        let rectangle = matches!(i, 4 | 5 | 6 | 12);
        assert!(
            rectangle || i >= bore.len() || argument.is_some() == bore[i].is_some(),
            "argument {}",
            i + 1
        );
        assert!(
            rectangle || argument.is_some() == zone[i].is_some(),
            "argument {}",
            i + 1
        );
    }
    assert_eq!(ours[17..27], zone[17..27]);
}

fn found(job: &Value) -> Vec<String> {
    check(job)
        .iter()
        .filter(|f| f.level == Level::Error)
        .map(|f| format!("{} {}", f.code, f.path))
        .collect()
}

#[test]
fn what_the_control_cannot_do_is_refused() {
    let pocket = default_job("internal-rectangle-protected").unwrap();
    let text = |t: &str| Value::Text(t.to_owned());
    let pocket = with(&pocket, "control.post", text("sinumerik"));
    let cycle = with(&pocket, "control.form", text("cycle"));
    assert_eq!(found(&pocket), [""; 0]);
    assert_eq!(found(&cycle), [""; 0]);
    // Rotated by argument 10; parallel to the axes, but with width 1 along the second one, the widths are exchanged.
    let call = |turn: f64| {
        planned(&with(&cycle, "cycle.rotation", number(turn)))
            .program
            .text
    };
    assert!(
        call(10.0).contains("CYCLE977(1005,,,1,,80,50,5,5,10,20,58,28,"),
        "{}",
        call(10.0)
    );
    assert!(
        call(90.0).contains("CYCLE977(1005,,,1,,50,80,5,5,0,20,28,58,"),
        "{}",
        call(90.0)
    );
    assert_eq!(
        found(&with(&cycle, "cycle.sideClearance1", number(9.0))),
        ["cycle-one-path cycle.sideClearance2"]
    );
    assert_eq!(
        found(&with(&cycle, "cycle.sideClearance2", number(7.0))),
        ["cycle-one-path cycle.sideClearance2"]
    );
    assert_eq!(
        found(&with(&cycle, "cycle.width2", number(20.0))),
        ["cycle-no-zone cycle.sideClearance2"]
    );
    assert_eq!(
        found(&with(&cycle, "plane", text("G18"))),
        ["cycle-plane plane"]
    );
    let close = with(
        &with(&cycle, "cycle.sideClearance1", number(3.05)),
        "cycle.sideClearance2",
        number(3.05),
    );
    assert_eq!(found(&close), ["cycle-path-short cycle.sideClearance1"]);
    let corner = with(
        &default_job("double-wall-internal-corner").unwrap(),
        "control",
        pocket.get("control").unwrap().clone(),
    );
    assert_eq!(found(&corner), [""; 0]);
    let refused = with(&corner, "control.form", text("cycle"));
    assert_eq!(found(&refused), ["form-unsupported control.form"]);
    assert_eq!(
        found(&with(&corner, "control.workOffset", number(99.0))),
        [""; 0]
    );
    assert!(
        planned(&with(&corner, "control.workOffset", number(99.0)))
            .program
            .text
            .contains("G599\n")
    );
}

/// The probe's first length must act along the tool axis: the answers are LENTOAX's table of values.
#[test]
fn the_tool_section_says_which_length_acts_on_the_tool_axis() {
    let pocket = with(
        &default_job("internal-rectangle-protected").unwrap(),
        "control.post",
        Value::Text("sinumerik".to_owned()),
    );
    let frame = |text: &str| job(text);
    let wrong = ["length-not-along-tool-axis tool"];
    let fine: [&str; 0] = [];
    let cases = [
        ("tool.type", number(710.0), true),
        ("tool.type", number(120.0), true),
        // A turning tool in G17: L1 along Y.
        ("tool.type", number(500.0), false),
        // The assignment of G18 in every plane: L1 along Y.
        ("tool.sd42940", number(18.0), false),
        ("tool.sd42940", number(-17.0), true),
        ("tool.sd42950", number(2.0), false),
        (
            "tool.frame",
            frame(r#"[{ "rot": "Z", "angle": 60 }]"#),
            true,
        ),
        (
            "tool.frame",
            frame(r#"[{ "rot": "X", "angle": 60 }]"#),
            false,
        ),
        (
            "tool.frame",
            frame(r#"[{ "rot": "X", "angle": 360 }]"#),
            true,
        ),
        ("tool.frame", frame(r#"[{ "mirror": "X" }]"#), true),
    ];
    for (path, value, good) in cases {
        let job = with(&pocket, path, value.clone());
        assert_eq!(
            found(&job),
            if good { &fine[..] } else { &wrong[..] },
            "{path} {value:?}"
        );
        // Other controls do not check it.
        let other = with(&job, "control.post", Value::Text("linuxcnc".to_owned()));
        assert_eq!(found(&other), fine, "{path} {value:?}");
    }
    // Mirrored, with or without the length: up in the program is down on the machine.
    let mirrored = with(&pocket, "tool.frame", frame(r#"[{ "mirror": "Z" }]"#));
    assert_eq!(found(&mirrored), ["tool-axis-reversed tool.frame"]);
    assert_eq!(
        found(&with(&mirrored, "tool.sd42900", Value::Flag(true))),
        ["tool-axis-reversed tool.frame"]
    );
    for plane in ["G18", "G19"] {
        assert_eq!(
            found(&with(&pocket, "plane", Value::Text(plane.to_owned()))),
            fine,
            "{plane}"
        );
    }
    let turned = with(&pocket, "tool.type", number(500.0));
    assert_eq!(
        values(&check(&turned)[0]),
        ["1", "+Y", "2", "+X", "3", "+Z"],
        "each length and its axis"
    );
    assert_eq!(
        found(&with(&pocket, "tool.frame", number(1.0))),
        ["wrong-type tool.frame"]
    );
    assert_eq!(
        found(&with(
            &pocket,
            "tool.frame",
            frame(r#"[{ "rot": "A", "angle": 1 }]"#)
        )),
        ["wrong-type tool.frame[0]"]
    );
    assert_eq!(
        found(&with(&pocket, "tool.colour", point([0.0; 3]))),
        ["unknown-key tool.colour"]
    );
}

/// A feed may be left to the control's rapid; MEAS needs a stated one.
#[test]
fn rapids_stay_protected() {
    let job = with(
        &default_job("internal-rectangle-protected").unwrap(),
        "control.post",
        Value::Text("sinumerik".to_owned()),
    );
    let job = with(
        &with(&job, "feeds.approach", number(1500.0)),
        "feeds.return",
        number(1500.0),
    );
    let job = with(&job, "feeds.longLink", Value::Null);
    let plan = planned(&job);
    assert!(
        plan.findings
            .iter()
            .any(|f| f.code == "rapid-at-feed" && values(f) == ["2000 mm"])
    );
    assert!(!plan.program.text.contains("G0 "));
    assert_eq!(
        plan.program.text.matches("F2000").count(),
        plan.moves.iter().filter(|m| m.feed == "rapid").count()
    );
}

/// A program is read back as the job: the header contains it, the blocks agree, and the path is the same.
#[test]
fn a_program_is_read_back_as_its_job() {
    for (name, job, plan) in plans() {
        let imported =
            crate::common::import(&plan.program.text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let warnings: Vec<_> = imported
            .findings
            .iter()
            .filter(|f| f.level != Level::Info)
            .collect();
        assert!(warnings.is_empty(), "{name}: {warnings:?}");
        let back = planned(&with(
            &imported.job,
            "part",
            job.get("part").cloned().unwrap_or(Value::Map(Vec::new())),
        ));
        assert_eq!(back.moves, plan.moves, "{name}");
        assert_eq!(back.table, plan.table, "{name}");
        assert_eq!(back.results, plan.results, "{name}");
        let same = |text: &str| {
            text.lines()
                .filter(|l| !l.starts_with("; "))
                .collect::<Vec<_>>()
                .join("\n")
        };
        assert_eq!(same(&back.program.text), same(&plan.program.text), "{name}");
    }
}

#[test]
fn a_program_that_was_changed_is_told() {
    let (_, _, plan) = plans()
        .into_iter()
        .find(|(name, ..)| name == "pocket-sinumerik")
        .unwrap();
    let text = &plan.program.text;
    let said = |text: &str| -> Vec<String> {
        match crate::common::import(text) {
            Ok(imported) => imported
                .findings
                .into_iter()
                .filter(|f| f.level != Level::Info)
                .map(|f| f.code)
                .collect(),
            Err(error) => error.findings.into_iter().map(|f| f.code).collect(),
        }
    };
    assert_eq!(said(text), [""; 0]);
    // Any change is found: a position, a feed, a plane, a sign, an axis, a check, a jump, the exit, the header.
    let changes = [
        ("Z10 F2000", "Z9 F2000"),
        ("X139.4671", "X119.4671"),
        ("X139.4671", "X239.4671"),
        ("cycle.width1=80", "cycle.width1=81"),
        ("F150", "F15000"),
        ("G17 ", "G18 "),
        ("G55\n", "G54\n"),
        ("R6*0.342020143326+3", "R6*0.342020143326-3"),
        ("$AA_MW[X]", "$AA_MW[Y]"),
        ("$P_UIFR[2,X,TR]=$P", "$P_UIFR[3,X,TR]=$P"),
        ("R17*COS(R15)-R18", "R17*COS(R15)+R18"),
        ("IF $A_PROBE[1]<>0 GOTOF TP_DEFLECTED\n", ""),
        ("G1 Z30 F2000\nTP_STOP", "G1 Z-30 F2000\nTP_STOP"),
        ("SETAL(65000)\n", ""),
        ("GOTOF TP_MISSED", "GOTOF TP_FRAME"),
        ("TP_MOVE=5\n", "TP_MOVE=5\nGOTOF TP_EXIT\n"),
    ];
    for (old, new) in changes {
        let changed = text.replacen(old, new, 1);
        assert_ne!(&changed, text, "{old}");
        let found = said(&changed);
        assert!(
            found.contains(&"program-differs".to_owned()),
            "{old}: {found:?}"
        );
        assert!(
            found
                .iter()
                .all(|code| matches!(code.as_str(), "program-differs" | "unsafe-program")),
            "{old}: {found:?}"
        );
    }
    assert_eq!(
        said(&text.replacen("cycle.width1=80", "cycle.width1=-1", 1)),
        ["header-unsound"]
    );
    let unchecked = said(&text.replacen("IF $AC_MEA[1]<>0 GOTOF TP_CONTACT\n", "", 1));
    assert!(
        unchecked.contains(&"unsafe-program".to_owned())
            && unchecked.contains(&"program-differs".to_owned())
    );
    assert_eq!(
        said(&format!("%_N_POCKET_MPF\n;$PATH=/_N_MPF_DIR\n{text}")),
        [""; 0]
    );
    assert_eq!(
        said(&text.replacen("STOPRE", "STOPP", 2)),
        ["not-understood", "not-understood"]
    );
    // Without its job it is a program of moves.
    let moves = crate::common::import(&text.replace("cycle.type=", "cycle_type=")).unwrap();
    assert_eq!(moves.job, Value::Null);
    assert_eq!(
        moves
            .trace
            .unwrap()
            .moves
            .iter()
            .filter(|m| m.kind == touchpath::control::trace::Kind::Touch)
            .count(),
        4
    );
    // A program of version 0.1.0 has one value per line.
    let old = "; job cycle.type = hole\n; job cycle.diameter = 30\n; job control.post = sinumerik\nG71\nG90\nM30\n";
    let imported = crate::common::import(old).unwrap();
    assert_eq!(
        crate::common::number_at(&imported.job, "cycle.diameter", 0.0),
        30.0
    );
    // Only known keys of a job are read, no invalid number, and the version is checked.
    let header = "; Made by Touchpath 99.0.0 from this job\n; job cycle.type=hole cycle.diameter=inf __proto__.x=1 cycle.origin=[1,2,3]\n\
                  ; job cycle.touches[16].point=[1,2,3] a[999][999].b=1 cycle.origin[7]=1 constructor=1 feeds.longLink=inf\nG71\nG90\nM30\n";
    let imported = crate::common::import(header).unwrap();
    let Value::Map(entries) = &imported.job else {
        panic!()
    };
    assert_eq!(
        entries.iter().map(|(k, _)| k.as_str()).collect::<Vec<_>>(),
        ["format", "cycle", "feeds"]
    );
    assert_eq!(
        imported.job.get("feeds").unwrap().get("longLink"),
        Some(&Value::Text("inf".to_owned())),
        "not null: null is rapid"
    );
    assert_eq!(
        imported.job.get("cycle").unwrap().get("origin"),
        Some(&crate::common::point([1.0, 2.0, 3.0]))
    );
    let codes: Vec<&str> = imported.findings.iter().map(|f| f.code.as_str()).collect();
    assert!(
        codes.contains(&"header-unknown")
            && codes.contains(&"other-version")
            && codes.contains(&"header-unsound"),
        "{codes:?}"
    );
    let long = format!(
        "{text}; job cycle.touches[999999999999].point = 1\n; job cycle.origin.x.y = 2\n; job  = 3\n"
    );
    let _ = said(&long);
    // Hostile ones are read or refused quickly, and nothing overflows.
    let head = "; job cycle.type = hole\nMEAS=1 G1 X1 F1\n";
    for hostile in [
        "IF 1 GOTOF A\n",
        "; job aN = 1\n",
        "; job a0001[999][999][999] = 1\n",
        "; job cycle.touches[15][2][2][2].point[2] = 1\n",
        "A:\n",
        "R1=1\n",
    ] {
        let _ = said(&format!("{head}{}", hostile.repeat(20_000)));
    }
    for deep in ["+1", "*(1", "-", " OR 1", "<<1"] {
        assert!(
            said(&format!("{head}R1=1{}\n", deep.repeat(50_000)))
                .contains(&"not-understood".to_owned()),
            "{deep}"
        );
    }
    // Foreign texts that only mention it stay foreign.
    let klartext = "0 BEGIN PGM A MM\n1 TCH PROBE 1411 Q1100=0 Q1101=0 Q1102=0 Q1116=20 Q1103=50 Q1104=0 Q1105=0 Q1117=20 ; was CYCLE977\n2 END PGM A MM\n";
    assert!(crate::common::import(klartext).is_ok());
}
