//! The write summary of a program is one true sentence, the same in list, sheet and header. Each test is named after a failure.

use crate::common::{job, jobs, number, planned, with};
use touchpath::form::Value;
use touchpath::job::{ProgramText, default_job};

fn text(t: &str) -> Value {
    Value::Text(t.to_owned())
}

/// Comments of a program as one lower-case text: lines are broken anywhere.
fn comments(program: &ProgramText) -> String {
    let plain = |line: &str| {
        let line = line.trim_start_matches(|c: char| c.is_ascii_digit()).trim();
        let comment = line.strip_prefix(['(', ';'])?;
        Some(comment.trim().trim_end_matches(')').to_lowercase())
    };
    program
        .text
        .lines()
        .filter_map(plain)
        .collect::<Vec<_>>()
        .join(" ")
}

fn circles(transfer: i32, confirm: i32, align: i32, plane: &str) -> ProgramText {
    let job = job(&format!(
        r#"{{ "format": 1, "plane": "{plane}", "cycle": {{ "type": "probing-two-circles", "transferPosition": {transfer}, "confirmRotation": {confirm},
        "alignRotaryAxis": {align}, "point1": [-30, 0, 0], "point2": [30, 0, 0], "start": [0, 0, 100] }},
        "control": {{ "post": "heidenhain", "form": "cycle" }} }}"#
    ));
    planned(&job).program
}

/// Q1121 = 1 is the basic rotation, 2 the offset of the table; Q1120 is the position; Q1126 turns the table.
#[test]
fn a_cycle_that_sets_rotation_and_preset_was_said_to_measure_only() {
    for (transfer, confirm, align, does, writes) in [
        (0, 0, 0, "measures only", &[][..]),
        (1, 0, 0, "sets preset X Y", &["preset X", "preset Y"]),
        (0, 1, 0, "sets the basic rotation", &["basic rotation"]),
        (
            3,
            1,
            0,
            "sets the basic rotation and preset X Y",
            &["preset X", "preset Y", "basic rotation"],
        ),
        (
            0,
            2,
            0,
            "sets the rotary table offset of the preset",
            &["table offset"],
        ),
        (
            2,
            2,
            0,
            "sets the rotary table offset and preset X Y",
            &["preset X", "preset Y", "table offset"],
        ),
        (
            3,
            1,
            2,
            "sets the basic rotation and preset X Y, turns the rotary table",
            &["preset X", "preset Y", "basic rotation"],
        ),
        (
            0,
            2,
            1,
            "sets the rotary table offset of the preset, turns the rotary table",
            &["table offset"],
        ),
    ] {
        let program = circles(transfer, confirm, align, "G17");
        assert_eq!(
            (program.does.as_str(), program.writes.as_slice()),
            (does, writes),
            "{transfer} {confirm} {align}"
        );
        assert!(
            comments(&program).contains(&does.to_lowercase()),
            "{}",
            program.text
        );
        for (q, value) in [(1120, transfer), (1121, confirm), (1126, align)] {
            assert!(
                program.text.contains(&format!("Q{q}=+{value} ;")),
                "{}",
                program.text
            );
        }
    }
    // The main and the minor axis of the plane.
    assert_eq!(circles(1, 0, 0, "G18").writes, ["preset X", "preset Z"]);
    assert_eq!(circles(1, 0, 0, "G19").writes, ["preset Y", "preset Z"]);
}

/// A position that the operator shows is unknown, and the control still corrects its preset with it.
#[test]
fn an_object_whose_place_is_not_known_corrects_the_preset_too() {
    let job = with(
        &default_job("probing-two-circles").unwrap(),
        "cycle.transferPosition",
        number(1.0),
    );
    let unknown = with(
        &job,
        "cycle.point1",
        Value::List(vec![text("?"), number(0.0), number(-10.0)]),
    );
    assert_eq!(planned(&unknown).program.does, "sets preset X Y");
}

/// The hundreds of the variant correct the work offset: 1105 does, 1005 does not.
#[test]
fn a_measuring_cycle_with_a_work_offset_writes_it() {
    let job = |offset: Value| {
        let job = with(
            &default_job("internal-rectangle-protected").unwrap(),
            "control.post",
            text("sinumerik"),
        );
        planned(&with(
            &with(&job, "control.form", text("cycle")),
            "control.workOffset",
            offset,
        ))
        .program
    };
    let writes = job(number(2.0));
    assert!(writes.text.contains("CYCLE977(1105,10002,"));
    assert_eq!(
        (writes.does.as_str(), writes.writes.as_slice()),
        ("writes G55 X Y", &["X", "Y"][..])
    );
    let measures = job(Value::Null);
    assert!(measures.text.contains("CYCLE977(1005,,"));
    assert_eq!(
        (measures.does.as_str(), measures.writes.len()),
        ("measures only", 0)
    );
}

#[test]
fn header_and_sentence_are_one() {
    let mut writing = 0;
    for (name, job) in jobs() {
        let Ok(plan) = touchpath::job::plan(&job) else {
            continue;
        };
        let program = plan.program;
        assert_eq!(program.does, program.said.english(), "{name}");
        assert_eq!(
            program.writes.is_empty(),
            program.does == "measures only" || program.does.ends_with("writes nothing"),
            "{name}: {}",
            program.does
        );
        assert!(
            program.writes.is_empty() || program.does != "measures only",
            "{name}: {}",
            program.does
        );
        if ["probe-on", "nc-action"].contains(&name.as_str()) {
            assert_eq!(program.does, "moves nothing, writes nothing", "{name}");
            continue;
        }
        let sentence = program.does.to_lowercase();
        assert!(
            comments(&program).contains(&sentence),
            "{name}: {sentence}\n{}",
            program.text
        );
        writing += usize::from(!program.writes.is_empty());
    }
    assert!(writing > 10, "{writing}");
}

/// Only a rotation is written, without the position: LinuxCNC's G10 has R and no X.
#[test]
fn a_rotation_alone_is_said_to_be_one() {
    let job = with(
        &default_job("probing-two-circles").unwrap(),
        "control.post",
        text("linuxcnc"),
    );
    let job = with(
        &with(&job, "control.form", text("moves")),
        "control.workOffset",
        number(1.0),
    );
    let program = |transfer: f64| {
        let job = with(
            &with(&job, "cycle.confirmRotation", number(1.0)),
            "cycle.transferPosition",
            number(transfer),
        );
        planned(&job).program
    };
    assert_eq!(program(0.0).does, "writes the rotation of G54");
    assert_eq!(program(3.0).does, "writes G54 X Y and rotation");
    let write = |program: &ProgramText| {
        program
            .text
            .lines()
            .find(|line| line.starts_with("G10"))
            .unwrap()
            .to_owned()
    };
    assert!(
        write(&program(0.0)).contains(" R") && !write(&program(0.0)).contains(" X"),
        "{}",
        program(0.0).text
    );
}
