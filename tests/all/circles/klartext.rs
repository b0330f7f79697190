//! The block of 1411 as on HEIDENHAIN controls, read and written again.

use super::{holes, text};
use crate::common::import;
use crate::common::{law, number, number_at, planned, point, values, with};
use proptest::prelude::*;
use touchpath::form::{Level, Value};
use touchpath::job::plan;

/// The example of the manual, block by block.
const SEED: &str = "11 TCH PROBE 1411 PROBING TWO CIRCLES ~
Q1100=+0 ;1ST POINT REF AXIS ~
Q1101=+0 ;1ST POINT MINOR AXIS ~
Q1102=+0 ;1ST POINT TOOL AXIS ~
Q1116=+0 ;DIAMETER 1 ~
Q1103=+0 ;2ND POINT REF AXIS ~
Q1104=+0 ;2ND POINT MINOR AXIS ~
Q1105=+0 ;2ND POINT TOOL AXIS ~
Q1117=+0 ;DIAMETER 2 ~
Q1115=+0 ;GEOMETRY TYPE ~
Q423=+4 ;NO. OF PROBE POINTS ~
Q325=+0 ;STARTING ANGLE ~
Q1119=+360 ;ANGULAR LENGTH ~
Q320=+0 ;SET-UP CLEARANCE ~
Q260=+100 ;CLEARANCE HEIGHT ~
Q1125=+2 ;CLEAR. HEIGHT MODE ~
Q309=+0 ;ERROR REACTION ~
Q1126=+0 ;ALIGN ROTARY AXIS ~
Q1120=+0 ;TRANSER POSITION ~
Q1121=+0 ;CONFIRM ROTATION";

fn block_lines(program: &str) -> Vec<String> {
    // The block number differs, because our programs have other comments.
    let lines = program
        .lines()
        .skip_while(|l| !l.contains("TCH PROBE 1411"))
        .take(20);
    lines
        .map(|l| {
            l.trim_start_matches(|c: char| c.is_ascii_digit())
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" ")
        })
        .collect()
}

/// The manual's example is read and written again letter by letter. Its diameters of 0 cannot be probed, so they are set to 10
/// and the points are moved apart; the other lines must equal the manual's.
#[test]
fn the_manuals_example_is_read_and_written() {
    let imported = import(SEED).unwrap();
    assert_eq!(
        imported.job.get("cycle").unwrap().get("diameter1"),
        Some(&number(0.0))
    );
    // A text without a name gets the default name of its job.
    let mut job = with(
        &with(&imported.job, "cycle.diameter1", number(10.0)),
        "name",
        Value::Text("PROBE".to_owned()),
    );
    job = with(&job, "cycle.diameter2", number(10.0));
    job = with(&job, "cycle.point2", point([50.0, 0.0, 0.0]));
    let program = planned(&job).program.text;
    let expected = SEED
        .replacen("Q1116=+0", "Q1116=+10", 1)
        .replacen("Q1117=+0", "Q1117=+10", 1)
        .replacen("Q1103=+0", "Q1103=+50", 1);
    assert_eq!(block_lines(&program), block_lines(&expected));
    assert!(program.starts_with(
        "0 BEGIN PGM PROBE MM\n1 ; Job: PROBE\n2 ; HEIDENHAIN cycle 1411: Probing two circles\n"
    ));
    // Blocks are numbered one by one.
    let numbers = program
        .lines()
        .filter(|l| !l.starts_with(' '))
        .map(|l| l.split(' ').next().unwrap().parse::<usize>().unwrap());
    assert!(
        numbers.enumerate().all(|(i, number)| i == number)
            && program.ends_with(" END PGM PROBE MM\n")
    );
}

#[test]
fn other_ways_to_write_the_block_are_read() {
    let iso = "N10 G1411 Q1100=-30 Q1101=+0,5 Q1102=-10 QS1116=\"10H7\" Q1103=+30 Q1104=+0 Q1105=-10 Q1117=+12.5 Q1115=+2 Q423=+3 \
               Q325=+0 Q1119=+360 Q320=+1 Q260=+80 Q1125=+1 Q309=+0 Q1126=+0 Q1120=+1 Q1121=+1";
    let cycle = import(iso).unwrap().job.get("cycle").unwrap().clone();
    assert_eq!(cycle.get("point1"), Some(&point([-30.0, 0.5, -10.0])));
    assert_eq!(cycle.get("diameter1"), Some(&text("10H7")));
    assert_eq!(
        (cycle.get("geometryType"), cycle.get("transferPosition")),
        (Some(&number(2.0)), Some(&number(1.0)))
    );
    let messy = "0 BEGIN PGM A_B INCH\r\n1 L Z+100 R0 FMAX M91\r\n2 TOOL CALL 7 Y S50\r\n3 TCH PROBE 1493 EXTRUSION PROBING ~\r\n\
                 Q1140=+1 ;anything at all ~\r\n Q1145=+4 ~\r\nQ1146=-2,5;x ~\r\nQ1149=+0\r\n4 TCH PROBE 1411 ~\r\n  Q1100=+1 ;x ~\r\n Q1101=+0 Q1102=+0 Q1116=+1 Q1103=+4 Q1104=+0 Q1105=+0 Q1117=+1 ~\r\n Q9999=+1\r\n\
                 5 END PGM A_B INCH\r\n";
    let imported = import(messy).unwrap();
    let at = |path: &str| number_at(&imported.job, path, f64::NAN);
    assert_eq!(imported.job.get("units"), Some(&text("inch")));
    assert_eq!(
        (imported.job.get("plane"), at("control.tool")),
        (Some(&text("G18")), 7.0)
    );
    assert_eq!(
        (at("cycle.extrusion.points"), at("cycle.extrusion.length")),
        (4.0, -2.5)
    );
    let codes: Vec<&str> = imported.findings.iter().map(|f| f.code.as_str()).collect();
    assert!(
        codes.contains(&"unknown-parameter")
            && codes.contains(&"missing-parameter")
            && codes.contains(&"passed-over")
    );
    assert!(import("nothing at all").is_err() && import("").is_err() && import("{").is_err());
}

/// Positions and diameters of both circles.
const PLACED: &str =
    "Q1100=-31 Q1101=+1 Q1102=-11 Q1116=+21 Q1103=+29 Q1104=+2 Q1105=-12 Q1117=+22";

/// The example at the end of the manual's page of 1411, as the page prints it: with blank lines, and each comment with its `~` on a separate line. Its values
/// differ from the form's defaults.
#[test]
fn the_example_of_the_manual_is_read_as_it_is_printed() {
    let parameters = [
        ("1100", "+5", "1ST POINT REF AXIS"),
        ("1101", "+75", "1ST POINT MINOR AXIS"),
        ("1102", "-3", "1ST POINT TOOL AXIS"),
        ("1116", "+12", "DIAMETER 1"),
        ("1103", "+75", "2ND POINT REF AXIS"),
        ("1104", "+76", "2ND POINT MINOR AXIS"),
        ("1105", "-4", "2ND POINT TOOL AXIS"),
        ("1117", "+14", "DIAMETER 2"),
        ("1115", "+1", "GEOMETRY TYPE"),
        ("423", "+5", "NO. OF PROBE POINTS"),
        ("325", "+10", "STARTING ANGLE"),
        ("1119", "+300", "ANGULAR LENGTH"),
        ("320", "+2", "SET-UP CLEARANCE"),
        ("260", "+101", "CLEARANCE HEIGHT"),
        ("1125", "+1", "CLEAR. HEIGHT MODE"),
        ("309", "+1", "ERROR REACTION"),
        ("1126", "+0", "ALIGN ROTARY AXIS"),
        ("1120", "+1", "TRANSER POSITION"),
        ("1121", "+1", "CONFIRM ROTATION"),
    ];
    let rows: Vec<String> = parameters
        .map(|(number, value, name)| format!("Q{number}={value}\n\n;{name}"))
        .to_vec();
    let block = format!(
        "11 TCH PROBE 1411 PROBING TWO CIRCLES ~\n\n{}\n\n12 M5\n",
        rows.join(" ~\n\n")
    );
    let read = import(&block).unwrap();
    assert!(
        read.findings.iter().all(|f| f.code != "missing-parameter"),
        "{:?}",
        read.findings
    );
    let cycle = read.job.get("cycle").unwrap();
    assert_eq!(cycle.get("point1"), Some(&point([5.0, 75.0, -3.0])));
    assert_eq!(cycle.get("point2"), Some(&point([75.0, 76.0, -4.0])));
    for (key, wanted) in [
        ("diameter1", 12.0),
        ("diameter2", 14.0),
        ("clearanceHeight", 101.0),
        ("confirmRotation", 1.0),
    ] {
        assert_eq!(cycle.get(key), Some(&number(wanted)), "{key}");
    }
}

/// A missing position or diameter must not become the form's default, a hole of 20 at X-30. The control refuses such a block.
#[test]
fn a_position_or_a_diameter_that_is_not_given_is_no_default() {
    let refused = |text: &str| -> Vec<String> {
        let findings = import(text).expect_err("refused").findings;
        let errors = findings.into_iter().filter(|f| f.level == Level::Error);
        errors.map(|f| format!("{} {}", f.code, f.path)).collect()
    };
    assert_eq!(
        refused("TCH PROBE 1411 ~\nQ1115=+1").len(),
        8,
        "all at once"
    );
    assert_eq!(
        refused(&format!(
            "TCH PROBE 1411 {}",
            PLACED.replace("Q1102=-11 ", "")
        )),
        ["missing-parameter cycle.point1[2]"]
    );
    assert_eq!(
        refused(&format!("TCH PROBE 1411 {}", PLACED.replace("+22", "abc"))),
        ["not-a-number cycle.diameter2"]
    );
}

/// The finding must show the form's default. The numbers are typed from the manual page of the cycle (docs/cycles/probing-two-circles.md), in mm.
#[test]
fn a_parameter_that_is_not_given_has_the_forms_default() {
    let defaults: [(u32, &str, f64); 11] = [
        (1115, "geometryType", 0.0),
        (423, "probePoints", 4.0),
        (325, "startingAngle", 0.0),
        (1119, "angularLength", 360.0),
        (320, "setUpClearance", 0.0),
        (260, "clearanceHeight", 100.0),
        (1125, "clearanceHeightMode", 2.0),
        (309, "errorReaction", 0.0),
        (1126, "alignRotaryAxis", 0.0),
        (1120, "transferPosition", 0.0),
        (1121, "confirmRotation", 0.0),
    ];
    let extrusion = [
        (1140, "extrusion.direction", 3.0),
        (1145, "extrusion.points", 1.0),
        (1146, "extrusion.length", 0.0),
        (1149, "extrusion.modal", 0.0),
    ];
    let at = |job: &Value, key: &str| {
        let (name, axis) = key.split_once('[').unwrap_or((key, ""));
        let value = name
            .split('.')
            .try_fold(job.get("cycle").unwrap(), |value, key| value.get(key))
            .unwrap();
        match (value, axis.trim_end_matches(']').parse::<usize>()) {
            (Value::List(items), Ok(axis)) => items[axis].clone(),
            (value, _) => value.clone(),
        }
    };
    let placed = |units: &str, more: &str| {
        import(&format!("0 BEGIN PGM A {units}\n1 TCH PROBE 1493\n2 TCH PROBE 1411 {PLACED} {more}\n3 END PGM A {units}\n"))
            .unwrap()
    };
    let bare = placed("MM", "");
    let missing: Vec<(String, Vec<String>)> = bare
        .findings
        .iter()
        .filter(|f| f.code == "missing-parameter")
        .map(|f| (f.path.clone(), values(f)))
        .collect();
    assert_eq!(missing.len(), defaults.len() + extrusion.len());
    for (number, key, default) in extrusion.into_iter().chain(defaults) {
        assert_eq!(
            at(&bare.job, key),
            touchpath::form::Value::Number(default),
            "Q{number}"
        );
        let wanted = (
            format!("cycle.{key}"),
            vec![number.to_string(), default.to_string()],
        );
        assert!(missing.contains(&wanted), "{wanted:?}: {missing:#?}");
    }
    // A given value replaces the default, and an unreadable one is reported once.
    let one = placed("MM", "Q325=+7 Q320=abc");
    assert_eq!(
        (
            at(&one.job, "startingAngle"),
            at(&one.job, "setUpClearance")
        ),
        (number(7.0), number(0.0))
    );
    let unread: Vec<_> = one
        .findings
        .iter()
        .filter(|f| f.path == "cycle.setUpClearance")
        .map(|f| f.code.as_str())
        .collect();
    assert_eq!(unread, ["not-a-number"], "it is reported once");
    // In inch the defaults are those of the form in inch: 100 mm are 3.937 inch.
    let Value::Number(x) = at(&placed("INCH", "").job, "clearanceHeight") else {
        panic!()
    };
    assert!((x - 100.0 / 25.4).abs() < 0.1, "{x}");
}

/// Emit, import, emit: the same bytes.
#[test]
fn a_program_is_read_back_as_it_was_written() {
    law(
        300,
        60,
        (
            proptest::array::uniform4(-400.0..400.0f64),
            -50.0..0.0f64,
            (10.0..80.0f64, 0usize..6),
            0..4i32,
            3..9i32,
            (-360.0..360.0f64, 30.0..360.0f64),
            (-1..3i32, 0..3i32, 0..4i32, 0..2i32),
            any::<bool>(),
            any::<bool>(),
            "[A-Za-z ]{0,12}",
        ),
        |(places, height, diameters, geometry, points, angles, modes, extruded, inch, name)| {
            let forms = ["15H7", "22m", "30+0.01-0.015", "18-0.2", "25h6", "16+1-1"];
            let scale = if inch { 25.4 } else { 1.0 };
            let second = if inch {
                number(diameters.0 / scale)
            } else {
                text(forms[diameters.1])
            };
            let mut job = with(&holes(), "units", text(if inch { "inch" } else { "mm" }));
            job = with(&job, "name", text(&name));
            job = with(
                &job,
                "cycle.point1",
                point([places[0] / scale, places[1] / scale, height / scale]),
            );
            job = with(
                &job,
                "cycle.point2",
                point([places[2] / scale, places[3] / scale, height / scale]),
            );
            job = with(&job, "cycle.diameter1", number(diameters.0 / scale));
            job = with(&job, "cycle.diameter2", second);
            for (key, value) in [
                ("geometryType", geometry),
                ("probePoints", points),
                ("clearanceHeightMode", modes.0),
                ("errorReaction", modes.1),
                ("transferPosition", modes.2),
                ("confirmRotation", modes.3),
            ] {
                job = with(&job, &format!("cycle.{key}"), number(f64::from(value)));
            }
            job = with(&job, "cycle.startingAngle", number(angles.0));
            job = with(&job, "cycle.angularLength", number(angles.1));
            job = with(&job, "stylus.diameter", number(1.0 / scale));
            job = with(&job, "cycle.start", point([0.0, 0.0, 100.0]));
            if extruded {
                job = with(
                    &job,
                    "cycle.extrusion",
                    Value::Map(vec![
                        ("points".into(), number(2.0)),
                        ("length".into(), number(-1.0 / scale)),
                    ]),
                );
            }
            let Ok(first) = plan(&job) else {
                return Ok(false);
            };
            let imported =
                import(&first.program.text).map_err(|e| TestCaseError::fail(e.to_string()))?;
            let again = with(&imported.job, "stylus.diameter", number(1.0 / scale));
            let again = with(&again, "cycle.start", point([0.0, 0.0, 100.0]));
            let second =
                plan(&again).map_err(|e| TestCaseError::fail(format!("{e}: {:?}", e.findings)))?;
            prop_assert_eq!(first.program.text, second.program.text);
            Ok(true)
        },
    );
}

#[test]
fn an_import_takes_the_probes_tool_and_says_what_it_does_not_know() {
    let with_tools = |before: &str, after: &str| {
        import(&format!("0 BEGIN PGM A MM\n{before}\n{SEED}\n{after}\n")).unwrap()
    };
    let later = with_tools(
        "1 TOOL CALL 100 Y S50\n2 TOOL CALL S60",
        "13 TOOL CALL 5 Z S3000",
    );
    assert_eq!(number_at(&later.job, "control.tool", 0.0), 100.0);
    assert_eq!(
        later.job.get("plane"),
        Some(&text("G18")),
        "a call without an axis leaves the plane"
    );
    let named = with_tools("1 TOOL CALL \"TOUCH_PROBE\" Z", "");
    assert!(named.findings.iter().any(|f| f.code == "tool-by-name"));
    // A block without a tool number only states the tool axis or the spindle speed.
    for axis in ["1 TOOL CALL Z S50", "1 TOOL CALL S50", "1 TOOL CALL"] {
        let read = with_tools(axis, "");
        assert!(
            read.findings.iter().all(|f| f.code != "tool-by-name"),
            "{axis}"
        );
    }
    let block =
        SEED.replace(" ~\n", " ")
            .replacen("11 TCH PROBE 1411 PROBING TWO CIRCLES", "N20 G1411", 1);
    let block: String = block
        .split_whitespace()
        .filter(|w| w.starts_with('Q') || w.starts_with('N') && w.len() == 3 || *w == "G1411")
        .collect::<Vec<_>>()
        .join(" ");
    let iso = import(&format!("%A G70 *\nN10 T7 G19 S50 *\n{block}\n")).unwrap();
    assert_eq!(
        (iso.job.get("units"), iso.job.get("plane")),
        (Some(&text("inch")), Some(&text("G19")))
    );
    assert_eq!(number_at(&iso.job, "control.tool", 0.0), 7.0);
    assert!(
        import(&block)
            .unwrap()
            .findings
            .iter()
            .any(|f| f.code == "units-unknown")
    );
}

/// A block that shifts, rotates, mirrors, scales or tilts has a warning; one that resets or has no effect has none.
#[test]
fn transformations_before_the_cycle_are_said() {
    let cycle = touchpath::job::plan(&with(
        &with(&holes(), "control.post", text("heidenhain")),
        "control.form",
        text("cycle"),
    ));
    let program = cycle.unwrap().program.text;
    let warned = |before: &str| {
        let bare: String = program
            .lines()
            .filter(|line| !line.contains(" ; "))
            .map(|line| format!("{line}\n"))
            .collect();
        let bare = bare.replacen(
            " TCH PROBE 1411",
            &format!(" L X+0\n{before}\n99 TCH PROBE 1411"),
            1,
        );
        let read = import(&bare).unwrap();
        read.findings.iter().any(|f| f.code == "places-transformed")
    };
    for block in [
        "CYCL DEF 7.1 X+10",
        "CYCL DEF 7.1 #5",
        "CYCL DEF 8.1 X",
        "CYCL DEF 10.1 ROT+30",
        "CYCL DEF 11.1 SCL0.5",
        "TRANS DATUM AXIS X+10 Y+5",
        "TRANS MIRROR AXIS X",
        "PLANE SPATIAL SPA+0 SPB+45 SPC+0 STAY",
        "N50 G54 X+10 Y+5",
        "N60 G73 G90 H+30",
    ] {
        assert!(warned(block), "{block}");
    }
    for block in [
        "CYCL DEF 247 DATUM SETTING Q339=+1",
        "CYCL DEF 7.1 X+0",
        "CYCL DEF 8.1",
        "CYCL DEF 10.1 ROT+0",
        "TRANS DATUM RESET",
        "PLANE RESET STAY",
        "CYCL DEF 10.1 ROT+30\nCYCL DEF 10.1 ROT+0",
    ] {
        assert!(!warned(block), "{block}");
    }
}
