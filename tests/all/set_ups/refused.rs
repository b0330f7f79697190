//! Findings of invalid set-ups, each at its path.

use crate::common::{job, planned, values, with};
use touchpath::form::Value;
use touchpath::job::check;

/// Code and path of each finding of a level.
fn found(text: &str, level: &str) -> Vec<String> {
    let findings = check(&job(text));
    let of_level = findings
        .iter()
        .filter(|f| format!("{:?}", f.level).eq_ignore_ascii_case(level));
    of_level.map(|f| format!("{} {}", f.code, f.path)).collect()
}

fn errors(text: &str) -> Vec<String> {
    found(text, "error")
}

#[test]
fn a_set_up_that_is_none_is_refused_at_its_place() {
    let two = |cycles: &str| format!(r#"{{ "format": 2, "cycles": [{cycles}] }}"#);
    for (text, wanted) in [
        (r#"{ "format": 2 }"#.to_owned(), vec!["missing cycles"]),
        (
            r#"{ "format": 2, "cycles": {} }"#.to_owned(),
            vec!["wrong-type cycles"],
        ),
        (two(""), vec!["wrong-count cycles"]),
        (
            r#"{ "format": 1, "cycles": [{ "type": "hole" }] }"#.to_owned(),
            vec!["unknown-value format"],
        ),
        (
            r#"{ "format": 2, "cycle": { "type": "hole" }, "cycles": [{ "type": "hole" }] }"#
                .to_owned(),
            vec!["unknown-key cycle"],
        ),
        (
            two(r#"{ "type": "hole" }, 5"#),
            vec!["wrong-type cycles[1]"],
        ),
        (
            two(r#"{ "type": "hole" }, { "type": "well" }"#),
            vec!["unknown-value cycles[1].type"],
        ),
        (
            two(r#"{ "type": "hole" }, { "type": "hole", "diameter": -1 }"#),
            vec!["out-of-range cycles[1].diameter"],
        ),
        (
            two(r#"{ "type": "hole", "name": "A B" }"#),
            vec!["cycle-name cycles[0].name"],
        ),
        (
            two(r#"{ "type": "hole", "name": "A)\nG0 Z-99" }"#),
            vec!["cycle-name cycles[0].name"],
        ),
        (
            two(r#"{ "type": "hole", "name": "1A" }"#),
            vec!["cycle-name cycles[0].name"],
        ),
        (
            two(r#"{ "type": "hole", "name": "" }"#),
            vec!["cycle-name cycles[0].name"],
        ),
        (
            two(r#"{ "type": "hole", "name": "away" }"#),
            vec!["cycle-name cycles[0].name"],
        ),
        (
            two(r#"{ "type": "hole", "name": "A" }, { "type": "web", "name": "a" }"#),
            vec!["cycle-name cycles[1].name"],
        ),
        (
            two(r#"{ "type": "hole", "name": 5 }"#),
            vec!["wrong-type cycles[0].name"],
        ),
        (
            two(r#"{ "type": "hole" }, { "type": "nc-action" }"#),
            vec!["set-up-unsupported cycles[1].type"],
        ),
    ] {
        assert_eq!(errors(&text), wanted, "{text}");
    }
    // A finding that all cycles share is reported once, at no cycle.
    let text = r#"{ "format": 2, "feeds": { "work": -1 }, "cycles": [{ "type": "hole" }, { "type": "web" }] }"#;
    assert_eq!(errors(text), ["out-of-range feeds.work"]);
}

#[test]
fn a_datum_that_is_no_result_is_refused_with_those_that_are() {
    let of = |datum: &str| {
        format!(
            r#"{{ "format": 2, "control": {{ "workOffset": 1 }}, "datum": {datum},
            "cycles": [{{ "type": "hole", "name": "BORE" }}, {{ "type": "surface", "name": "TOP", "origin": [80, 0, 0] }}, {{ "type": "double-wall-internal-corner", "name": "WALL", "origin": [200, 0, 0] }}] }}"#
        )
    };
    for (datum, wanted) in [
        (r#"{ "x": "BORE.diameter" }"#, "datum-unknown datum.x"),
        (r#"{ "x": "HOLE.center.x" }"#, "datum-unknown datum.x"),
        (r#"{ "z": "BORE.center.x" }"#, "datum-unknown datum.z"),
        (
            r#"{ "rotation": "WALL.angle" }"#,
            "datum-unknown datum.rotation",
        ),
        (r#"{ "x": 5 }"#, "wrong-type datum.x"),
        (r#"{ "a": "BORE.center.x" }"#, "unknown-key datum.a"),
        ("7", "wrong-type datum"),
        (
            r#"{ "x": "BORE.center.x", "y": "WALL.corner.y", "rotation": "WALL.rotation" }"#,
            "datum-apart datum",
        ),
        (
            r#"{ "x": null, "rotation": "WALL.rotation" }"#,
            "datum-apart datum",
        ),
        (
            r#"{ "y": null, "rotation": "WALL.rotation" }"#,
            "datum-apart datum",
        ),
    ] {
        assert_eq!(errors(&of(datum)), [wanted], "{datum}");
    }
    let said = check(&job(&of(r#"{ "x": "BORE.diameter" }"#)));
    let unknown = said.iter().find(|f| f.code == "datum-unknown").unwrap();
    assert_eq!(
        values(unknown),
        ["BORE.diameter", "BORE.center.x, WALL.corner.x"]
    );
    // Without a rotation two cycles may give an axis each, in any spelling.
    for datum in [
        r#"{ "x": "bore.CENTER.X", "y": "WALL.corner.y" }"#,
        r#"{ "x": null, "y": null }"#,
        "null",
        "{}",
    ] {
        assert!(
            errors(&of(datum)).is_empty(),
            "{datum}: {:?}",
            errors(&of(datum))
        );
    }
}

/// A native cycle writes everything that it measures: a job that would write less is refused, and no program claims to write less.
#[test]
fn what_a_cycle_of_the_control_writes_is_not_left_out() {
    let of = |post: &str, offset: &str, datum: &str| {
        format!(
            r#"{{ "format": 2, "control": {{ "post": "{post}", "form": "cycle", "workOffset": {offset} }}, "datum": {datum},
            "cycles": [{{ "type": "surface", "origin": [-60, 0, 0] }}, {{ "type": "hole", "diameter": 30 }}] }}"#
        )
    };
    for post in crate::tests::controls::calling() {
        let own = touchpath::control::find(post).unwrap().own.unwrap();
        // The cycles of a TNC write a row that is activated at the end: each may write, or none.
        let each_writes = own.several.activates.is_some();
        let nothing = r#"{ "x": null, "y": null, "z": null }"#;
        for datum in [r#"{ "x": null }"#, r#"{ "y": null }"#, nothing] {
            let refused: &[&str] = match each_writes && datum == nothing {
                true => &[],
                false => &["set-up-unsupported datum"],
            };
            assert_eq!(errors(&of(post, "2", datum)), refused, "{post} {datum}");
            assert!(
                errors(&of(post, "null", datum)).is_empty(),
                "{post} {datum}"
            );
        }
        let writes = |datum: &str| planned(&job(&of(post, "2", datum))).program.writes;
        assert_eq!(writes(r#"{ "z": null }"#), ["X", "Y"], "{post}");
        // Otherwise Z is not measured by the cycle that writes: nothing to omit.
        let all: &[&str] = if each_writes {
            &["X", "Y", "Z"]
        } else {
            &["X", "Y"]
        };
        assert_eq!(writes("{}"), all, "{post}");
    }
}

/// A position that one cycle touches is material for every other one, even if the rest is unknown.
#[test]
fn no_cycle_goes_through_what_another_one_touches() {
    let of = |x: f64, z: f64| {
        format!(
            r#"{{ "format": 2, "cycles": [{{ "type": "hole", "diameter": 25 }}, {{ "type": "surface", "origin": [{x}, 0, {z}] }}] }}"#
        )
    };
    // The move down into the hole passes the middle of the surface.
    assert_eq!(errors(&of(0.0, 0.0)), ["collision cycles"]);
    // 12.5 and the ball's radius from the axis: the touches of the hole reach 9.5 from it, 3 from its wall.
    assert_eq!(errors(&of(12.0, -10.0)), ["collision cycles"]);
    assert!(errors(&of(-30.0, 0.0)).is_empty());
    // For any size of the ball.
    assert_eq!(
        errors(&of(0.0, 0.0).replace(
            r#""cycles""#,
            r#""stylus": { "diameter": 0.001 }, "cycles""#
        )),
        ["collision cycles"]
    );
    // The bottom of the same hole, deeper than its touches.
    assert!(errors(&of(0.0, -20.0)).is_empty());
}

/// The proposal: the first cycle that measures both axes of the plane, the first that measures the tool axis, no rotation.
#[test]
fn what_is_written_is_proposed() {
    let text = r#"{ "format": 2, "control": { "post": "linuxcnc", "workOffset": 1 },
        "cycles": [{ "type": "surface", "name": "TOP" }, { "type": "web", "name": "WEB", "origin": [100, 0, 0] },
                   { "type": "hole", "name": "BORE", "origin": [250, 0, 0] }, { "type": "surface", "name": "LOW", "origin": [350, 0, -5] }] }"#;
    let plan = crate::common::planned(&job(text));
    let sources: Vec<_> = plan
        .results
        .iter()
        .filter(|r| r.code.starts_with("offset."))
        .map(|r| (r.code.as_str(), r.cycle))
        .collect();
    assert_eq!(sources, [("offset.x", 2), ("offset.y", 2), ("offset.z", 0)]);
    assert_eq!(plan.program.writes, ["X", "Y", "Z"]);
}

/// By hand: a stud of 20, 30 high, is in the way; the hole beside it is approached at the height of the job.
#[test]
fn the_way_to_a_cycle_does_not_hit_another_feature() {
    let of = |clear: &str, stud: f64| {
        format!(
            r#"{{ "format": 2, "clear": {clear}, "cycles": [
            {{ "type": "hole", "name": "A", "origin": [0, 0, 0], "feedDistance": 12 }},
            {{ "type": "hole", "name": "B", "origin": [200, 0, 0], "feedDistance": 12 }},
            {{ "type": "boss", "name": "STUD", "origin": [100, 0, {stud}], "diameter": 20, "feedDistance": 5 }}] }}"#
        )
    };
    // The stud's own clearance height is above its top: the height of the highest cycle is enough.
    assert!(
        errors(&of("null", 30.0)).is_empty(),
        "{:?}",
        errors(&of("null", 30.0))
    );
    let low = errors(&of("25", 30.0));
    assert!(
        low.contains(&"clear-too-low clear".to_owned())
            && low.contains(&"collision cycles".to_owned()),
        "{low:?}"
    );
    assert_eq!(errors(&of("5", -60.0)), ["clear-too-low clear"]);
}

#[test]
fn a_top_that_is_measured_late_is_said() {
    let text = r#"{ "format": 2, "cycles": [{ "type": "hole", "name": "BORE" }, { "type": "surface", "name": "TOP", "origin": [60, 0, 0] }] }"#;
    assert!(found(text, "info").contains(&"order-of-cycles cycles[1]".to_owned()));
    let text = r#"{ "format": 2, "cycles": [{ "type": "surface", "name": "TOP", "origin": [60, 0, 0] }, { "type": "hole", "name": "BORE" }] }"#;
    assert!(
        !found(text, "info")
            .iter()
            .any(|f| f.starts_with("order-of-cycles"))
    );
}

/// A part without contact in the third cycle gives no results of it, and the program writes nothing.
#[test]
fn a_miss_in_the_last_cycle_is_said_by_its_name() {
    let text = r#"{ "format": 2, "control": { "workOffset": 1 }, "part": { "sizes": { "C.diameter": 30 } },
        "cycles": [{ "type": "hole", "name": "A" }, { "type": "hole", "name": "B", "origin": [100, 0, 0] }, { "type": "hole", "name": "C", "origin": [200, 0, 0] }] }"#;
    let plan = crate::common::planned(&job(text));
    let missed = plan
        .findings
        .iter()
        .find(|f| f.code == "no-contact")
        .unwrap();
    assert_eq!(values(missed)[..2], ["C", "1"], "the cycle and its touch");
    let value = |cycle: usize| {
        plan.results
            .iter()
            .find(|r| r.cycle == cycle && r.code == "diameter")
            .and_then(|r| r.value)
    };
    assert_eq!(
        (value(0).is_some(), value(1).is_some(), value(2)),
        (true, true, None)
    );
    let unknown = with(
        &job(text),
        "part.sizes",
        job(r#"{ "D.diameter": 1, "diameter": 1 }"#),
    );
    let paths: Vec<String> = check(&unknown).into_iter().map(|f| f.path).collect();
    assert!(
        paths.contains(&"part.sizes.D.diameter".to_owned())
            && paths.contains(&"part.sizes.diameter".to_owned()),
        "{paths:?}"
    );
    let _ = Value::Null;
}
