//! HEIDENHAIN 1411: motion, results, tolerances.

mod fits;
mod interpreted;
mod klartext;

use crate::common::{job, number, planned, point, values, with};
use touchpath::form::{Level, Value};
use touchpath::job::{Plan, ResultRow, check};

fn text(t: &str) -> Value {
    Value::Text(t.to_owned())
}

/// Two holes of 20 at ±30, measuring height −10, ball 6, SET_UP 2, DIST 10, clearance height 50, stylus at Z 80.
fn holes() -> Value {
    job(
        r#"{ "format": 1, "control": { "post": "heidenhain", "form": "cycle" }, "cycle": { "type": "probing-two-circles",
        "point1": [-30, 0, -10], "point2": [30, 0, -10], "diameter1": 20, "diameter2": 20, "clearanceHeight": 50,
        "start": [5, 7, 80] } }"#,
    )
}

fn on_linuxcnc(job: &Value) -> Value {
    with(
        &with(job, "control.post", text("linuxcnc")),
        "control.form",
        text("moves"),
    )
}

fn row<'a>(rows: &'a [ResultRow], code: &str) -> &'a ResultRow {
    rows.iter()
        .find(|r| r.code == code)
        .unwrap_or_else(|| panic!("{code}"))
}

fn value(plan: &Plan, code: &str) -> f64 {
    row(&plan.results, code)
        .value
        .unwrap_or_else(|| panic!("{code} has a value"))
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} is not {b}");
}

fn errors(job: &Value) -> Vec<String> {
    check(job)
        .iter()
        .filter(|f| f.level == Level::Error)
        .map(|f| format!("{} {}", f.code, f.path))
        .collect()
}

fn warnings(job: &Value) -> Vec<String> {
    check(job)
        .iter()
        .filter(|f| f.level == Level::Warning)
        .map(|f| f.code.clone())
        .collect()
}

/// Clearance 2 + ball 3 = 5 off a wall of radius 10: the touches of a hole start 5 from its centre and end at 7.
#[test]
fn the_way_of_two_holes_by_hand() {
    let plan = planned(&holes());
    let ways: Vec<([f64; 3], &str, &str, u8)> = plan
        .moves
        .iter()
        .take(11)
        .map(|m| (m.to, m.kind, m.feed, m.step))
        .collect();
    let expected = [
        // The stylus is at the start, above the clearance height: first in the plane, then down.
        ([-30.0, 0.0, 80.0], "position", "rapid", 1),
        ([-30.0, 0.0, 50.0], "position", "rapid", 1),
        ([-25.0, 0.0, 50.0], "position", "rapid", 3),
        ([-25.0, 0.0, -10.0], "position", "work", 4),
        ([-23.0, 0.0, -10.0], "touch", "work", 4),
        ([-25.0, 0.0, -10.0], "back", "rapid", 4),
        // Q1125 = 2: at the clearance height to the next point, 90° counter-clockwise.
        ([-25.0, 0.0, 50.0], "position", "rapid", 4),
        ([-30.0, 5.0, 50.0], "position", "rapid", 4),
        ([-30.0, 5.0, -10.0], "position", "work", 4),
        ([-30.0, 7.0, -10.0], "touch", "work", 4),
        ([-30.0, 5.0, -10.0], "back", "rapid", 4),
    ];
    assert_eq!(ways, expected);
    let last = plan.moves.last().unwrap();
    assert_eq!((last.to, last.step), ([30.0, -5.0, 50.0], 8));
    assert_eq!(plan.touches[0].point, [-20.0, 0.0, -10.0]);
    assert_eq!(
        plan.touches[0].vector,
        [-1.0, 0.0, 0.0],
        "from the material into the hole"
    );
    assert_eq!(
        plan.touches.iter().map(|t| t.group).collect::<Vec<_>>(),
        [0, 0, 0, 0, 1, 1, 1, 1]
    );
    // From below: first up to the clearance height.
    let below = planned(&with(&holes(), "cycle.start", point([5.0, 7.0, 20.0])));
    assert_eq!(below.moves[0].to, [5.0, 7.0, 50.0]);
    assert_eq!(below.moves[1].to, [-30.0, 0.0, 50.0]);
}

/// Studs are touched inwards: touches start at 10 + 5 from the centre and end at 13. With Q1125 = 1 the ball moves from point to point along the arc of 15, and
/// at the clearance height to the other stud.
#[test]
fn the_way_of_two_studs_by_hand() {
    let mut job = with(
        &with(&holes(), "cycle.geometryType", number(1.0)),
        "cycle.clearanceHeightMode",
        number(1.0),
    );
    job = with(&job, "cycle.startingAngle", number(90.0));
    job = with(&job, "cycle.angularLength", number(-180.0));
    job = with(&job, "cycle.probePoints", number(3.0));
    let plan = planned(&job);
    // Three points over −180°: at 90°, 0°, −90°.
    assert_eq!(plan.touches[0].vector, [0.0, 1.0, 0.0]);
    assert_eq!(plan.touches[1].vector, [1.0, 0.0, 0.0]);
    assert_eq!(plan.touches[2].vector, [0.0, -1.0, 0.0]);
    let touch = plan.moves.iter().position(|m| m.kind == "touch").unwrap();
    assert_eq!(plan.moves[touch - 1].to, [-30.0, 15.0, -10.0]);
    assert_eq!(plan.moves[touch].to, [-30.0, 13.0, -10.0]);
    let around = &plan.moves[touch + 2];
    let arc = around.arc.as_ref().expect("an arc, not a chord");
    assert_eq!(
        (around.to, arc.center, arc.sweep),
        ([-15.0, 0.0, -10.0], [-30.0, 0.0, -10.0], -90.0)
    );
    assert!(warnings(&job).contains(&"no-retract".to_owned()));
    // The length of an arc: 15·π/2 each.
    let bows: f64 = plan
        .moves
        .iter()
        .filter_map(|m| m.arc.as_ref())
        .map(|a| 15.0 * a.sweep.abs().to_radians())
        .sum();
    assert!((bows - 4.0 * 15.0 * std::f64::consts::FRAC_PI_2).abs() < 1e-9);
}

#[test]
fn without_a_retract_between_objects_studs_may_be_free_and_holes_are_not() {
    let studs = with(
        &with(&holes(), "cycle.geometryType", number(1.0)),
        "cycle.clearanceHeightMode",
        number(0.0),
    );
    // From stud 1's last touch at −90° straight to stud 2's first at 0°: the line (−30, −15) to (45, 0) passes stud 2 at (30, 0) within 2.9 of its centre, so
    // it cuts the stud.
    assert_eq!(errors(&studs), ["collision cycle"]);
    // With a start at 180° the near side of the second stud comes first, and the path is free.
    let facing = with(&studs, "cycle.startingAngle", number(180.0));
    assert_eq!(errors(&facing), [""; 0]);
    let plan = planned(&facing);
    assert_eq!(
        plan.moves.iter().filter(|m| m.to[2] == 50.0).count(),
        3,
        "down to it and across before, up to it after the cycle"
    );
    // A move out of a hole cuts its wall.
    assert_eq!(
        errors(&with(&holes(), "cycle.clearanceHeightMode", number(0.0))),
        ["collision cycle"]
    );
    assert_eq!(
        errors(&with(&holes(), "cycle.clearanceHeightMode", number(-1.0))),
        ["collision cycle"]
    );
}

#[test]
fn small_holes() {
    // 8 wide: 4 minus 5 of stand-off is negative; from the centre 4 − 3 = 1 is reachable.
    let job = with(&holes(), "cycle.diameter1", number(8.0));
    let finding = check(&job)
        .into_iter()
        .find(|f| f.code == "small-hole")
        .expect("a notice");
    assert_eq!(
        (finding.path.as_str(), values(&finding)),
        ("cycle.diameter1", ["1", "1 mm"].map(str::to_owned).to_vec())
    );
    let plan = planned(&job);
    let touch = plan.moves.iter().position(|m| m.kind == "touch").unwrap();
    assert_eq!(plan.moves[touch - 1].to, [-30.0, 0.0, -10.0]);
    assert_eq!(plan.moves[touch].to, [-29.0, 0.0, -10.0]);
    assert_eq!(
        errors(&with(&holes(), "cycle.diameter1", number(6.0))),
        ["ball-too-wide cycle.diameter1"]
    );
}

/// Part shifted by (0.2, −0.1) and rotated by 0.5° about the work origin; hole 1 is 0.04 wider.
#[test]
fn results_by_hand() {
    let mut job = with(&holes(), "part.offset", point([0.2, -0.1, 0.0]));
    job = with(&job, "part.rotation", number(0.5));
    job = with(&job, "part.sizes.diameter1", number(0.04));
    job = with(&job, "cycle.transferPosition", number(3.0));
    job = with(&job, "cycle.confirmRotation", number(1.0));
    let plan = planned(&job);
    let (sin, cos) = (0.008_726_535_498, 0.999_961_923_064);
    for (code, wanted) in [
        ("Q950", 0.2 - 30.0 * cos),
        ("Q951", -0.1 - 30.0 * sin),
        ("Q952", -10.0),
        ("Q953", 0.2 + 30.0 * cos),
        ("Q954", -0.1 + 30.0 * sin),
        ("Q964", 0.5),
        ("Q965", -0.5),
        ("Q966", 20.04),
        ("Q967", 20.0),
        ("Q980", 30.2 - 30.0 * cos),
        ("Q984", -0.1 + 30.0 * sin),
        ("Q994", 0.5),
        ("Q995", -0.5),
        ("Q996", 0.04),
        ("Q997", 0.0),
        ("preset.x", 0.2),
        ("preset.y", -0.1),
        ("preset.rotation", 0.5),
        ("Q183", -1.0),
        ("form1", 0.0),
    ] {
        assert!(
            (value(&plan, code) - wanted).abs() < 1e-8,
            "{code}: {} for {wanted}",
            value(&plan, code)
        );
    }
    assert!(
        plan.results.iter().all(|r| r.code != "Q970"),
        "only with an extrusion"
    );
    near(row(&plan.results, "Q964").truth.unwrap(), 0.5);
}

/// Angles wrap: a line along −X, rotated in both directions.
#[test]
fn the_rotation_wraps() {
    for turn in [0.4, -0.4] {
        let mut job = with(&holes(), "cycle.point1", point([30.0, 0.0, -10.0]));
        job = with(&job, "cycle.point2", point([-30.0, 0.0, -10.0]));
        near(
            value(&planned(&with(&job, "part.rotation", number(turn))), "Q964"),
            turn,
        );
    }
}

#[test]
fn tolerances_and_verdicts() {
    let toleranced = |diameter: &str, delta: f64, geometry: f64| {
        let mut job = with(&holes(), "cycle.diameter1", text(diameter));
        job = with(&job, "cycle.geometryType", number(geometry));
        with(&job, "part.sizes.diameter1", number(delta))
    };
    for (diameter, delta, geometry, status, verdict) in [
        // 20H7 is 20 … 20.021.
        ("20H7", 0.010, 0.0, 0.0, "good"),
        ("20H7", 0.021, 0.0, 0.0, "good"),
        ("20H7", 0.0, 0.0, 0.0, "good"),
        ("20H7", -0.005, 0.0, 1.0, "rework"),
        ("20H7", 0.022, 0.0, 2.0, "scrap"),
        // A stud: an oversize can be reworked, an undersize cannot.
        ("20h6", 0.005, 1.0, 1.0, "rework"),
        ("20h6", -0.014, 1.0, 2.0, "scrap"),
        ("20m", 0.2, 0.0, 0.0, "good"),
        ("20+0.01-0.015", 0.0101, 0.0, 2.0, "scrap"),
    ] {
        let plan = planned(&toleranced(diameter, delta, geometry));
        assert_eq!(value(&plan, "Q183"), status, "{diameter} {delta}");
        assert_eq!(
            row(&plan.results, "Q966").verdict.as_deref(),
            Some(verdict),
            "{diameter} {delta}"
        );
    }
    // Deviations are from the middle: 20H7 is 20.0105.
    let plan = planned(&toleranced("20H7", 0.0, 0.0));
    near(value(&plan, "Q996"), -0.0105);
    near(row(&plan.results, "Q966").deviation.unwrap(), -0.0105);
    // A position out of its zone is scrap; the worst verdict counts.
    let job = with(
        &toleranced("20H7", -0.005, 0.0),
        "cycle.point1",
        Value::List(vec![text("-30+0.1-0.1"), number(0.0), number(-10.0)]),
    );
    let moved = planned(&with(&job, "part.offset", point([0.15, 0.0, 0.0])));
    assert_eq!(
        (
            value(&moved, "Q183"),
            row(&moved.results, "Q950").verdict.as_deref()
        ),
        (2.0, Some("scrap"))
    );
    // The effect of Q309.
    let says = |reaction: f64, delta: f64| {
        let plan = planned(&with(
            &toleranced("20H7", delta, 0.0),
            "cycle.errorReaction",
            number(reaction),
        ));
        row(&plan.results, "Q183").verdict.clone().unwrap()
    };
    assert_eq!(says(0.0, 0.05), "scrap: the program continues");
    assert_eq!(
        says(1.0, -0.01),
        "rework: the control stops and shows the results"
    );
    assert_eq!(says(2.0, -0.01), "rework: the program continues");
    assert_eq!(
        says(2.0, 0.05),
        "scrap: the control stops and shows the results"
    );
}

#[test]
fn semi_automatic_and_given_objects() {
    let semi = with(
        &holes(),
        "cycle.point1",
        Value::List(vec![text("?-30"), text("?"), number(-10.0)]),
    );
    let plan = planned(&semi);
    assert_eq!(plan.touches.len(), 4, "only the second object is probed");
    assert_eq!(row(&plan.results, "Q950").value, None);
    assert_eq!(row(&plan.results, "Q964").value, None);
    near(value(&plan, "Q953"), 30.0);
    assert!(
        plan.findings
            .iter()
            .any(|f| f.code == "semi-automatic" && f.path == "cycle.point1")
    );
    assert!(
        plan.program
            .text
            .contains("QS1100=\"?-30\" ;1ST POINT REF AXIS ~\n    QS1101=\"?\" ;")
    );
    assert_eq!(
        errors(&on_linuxcnc(&semi)),
        ["semi-automatic-unsupported control.post"]
    );
    // Entered: not probed, but its position counts. 60 along and 0.6 across is 0.57294°.
    let given = with(
        &holes(),
        "cycle.point1",
        Value::List(vec![text("-30@-30"), text("0@-0.6"), text("-10@-10")]),
    );
    let plan = planned(&given);
    assert_eq!(plan.touches.len(), 4);
    near(value(&plan, "Q951"), -0.6);
    assert!((value(&plan, "Q964") - 0.01f64.atan().to_degrees()).abs() < 1e-9);
    assert_eq!(
        row(&plan.results, "Q966").value,
        None,
        "its diameter is not measured"
    );
    let partly = with(
        &holes(),
        "cycle.point1",
        Value::List(vec![text("-30@-30"), number(0.0), number(-10.0)]),
    );
    assert_eq!(errors(&partly), ["given-incomplete cycle.point1"]);
    // Both entered or unknown: nothing is probed, and there is still a program.
    let neither = with(
        &semi,
        "cycle.point2",
        Value::List(vec![text("?"), text("?"), text("?")]),
    );
    let plan = planned(&neither);
    assert_eq!((plan.moves.len(), plan.length), (0, 0.0));
}

/// Three touches along the tool axis for each point: the circle uses their means, and its uncertainty shrinks by √3.
#[test]
fn extrusion_repeats_touches() {
    let extruded = with(
        &holes(),
        "cycle.extrusion",
        job(r#"{ "direction": 3, "points": 3, "length": -6 }"#),
    );
    let (once, thrice) = (planned(&holes()), planned(&extruded));
    assert_eq!(thrice.touches.len(), 24);
    assert_eq!(thrice.touches[1].point, [-20.0, 0.0, -13.0]);
    let ratio = row(&once.results, "Q950").uncertainty.unwrap()
        / row(&thrice.results, "Q950").uncertainty.unwrap();
    assert!((ratio - 3f64.sqrt()).abs() < 1e-8, "{ratio}");
    // Single deviations: hole 1 is 0.05 wider and shifted by 0.3.
    let off = planned(&with(
        &with(&extruded, "part.offset", point([0.3, 0.0, 0.0])),
        "part.sizes.diameter1",
        number(0.05),
    ));
    near(value(&off, "Q970"), 0.3);
    near(value(&off, "Q973"), 0.05);
    near(value(&off, "Q974"), 0.0);
    let block = &off.program.text;
    assert!(block.contains(" TCH PROBE 1493 EXTRUSION PROBING ~\n    Q1140=+3 ;EXTRUSION DIRECTION ~\n    Q1145=+3 ;EXTRUSION POINTS ~\n    Q1146=-6 ;EXTRUSION LENGTH ~\n    Q1149=+0 ;EXTRUSION MODAL\n"));
    assert!(block.find(" TCH PROBE 1493").unwrap() < block.find(" TCH PROBE 1411").unwrap());
}

#[test]
fn every_enumeration_value_is_taken_and_the_next_one_is_not() {
    for (key, low, high) in [
        ("geometryType", 0, 3),
        ("probePoints", 3, 8),
        ("errorReaction", 0, 2),
        ("transferPosition", 0, 3),
        ("confirmRotation", 0, 2),
        ("clearanceHeightMode", -1, 2),
        ("alignRotaryAxis", 0, 2),
    ] {
        let base = with(
            &with(&holes(), "cycle.confirmRotation", number(1.0)),
            "cycle.startingAngle",
            number(180.0),
        );
        for n in low..=high {
            let mut job = with(&base, &format!("cycle.{key}"), number(f64::from(n)));
            if key == "clearanceHeightMode" && n < 1 {
                // Between two holes the ball must move at the clearance height; between two studs with half circles it need not.
                job = with(
                    &with(&job, "cycle.geometryType", number(1.0)),
                    "cycle.angularLength",
                    number(-180.0),
                );
            }
            assert_eq!(errors(&job), [""; 0], "{key} {n}");
            let q = planned(&job)
                .table
                .iter()
                .find(|r| r.field == Some(format!("cycle.{key}")))
                .unwrap()
                .code
                .clone();
            assert!(
                planned(&job)
                    .program
                    .text
                    .contains(&format!("{q}={}{n} ;", if n < 0 { "" } else { "+" })),
                "{key} {n}"
            );
        }
        for n in [low - 1, high + 1] {
            let found = errors(&with(&base, &format!("cycle.{key}"), number(f64::from(n))));
            assert!(
                found.contains(&format!("out-of-range cycle.{key}")),
                "{key} {n}: {found:?}"
            );
        }
    }
}

#[test]
fn bad_input_is_named() {
    let bad = |path: &str, value: Value| errors(&with(&holes(), path, value));
    assert_eq!(
        bad("cycle.probePoints", number(2.0)),
        ["out-of-range cycle.probePoints"]
    );
    assert_eq!(
        bad("cycle.probePoints", number(9.0)),
        ["out-of-range cycle.probePoints"]
    );
    assert_eq!(
        bad("cycle.angularLength", number(0.0)),
        ["no-arc cycle.angularLength"]
    );
    for wrong in ["10H", "10H99", "?x", "10@"] {
        assert_eq!(
            bad("cycle.diameter1", text(wrong)),
            ["not-a-value cycle.diameter1"],
            "{wrong}"
        );
        let message = check(&with(&holes(), "cycle.diameter1", text(wrong)))[0]
            .message
            .clone();
        assert_eq!(
            message.matches(touchpath::tolerance::FORMS).count(),
            1,
            "the forms are shown: {message}"
        );
    }
    assert_eq!(
        bad("cycle.diameter1", text("?10")),
        ["not-a-value cycle.diameter1"]
    );
    assert_eq!(
        bad("cycle.point2", point([-30.0, 0.0, -10.0])),
        ["no-direction cycle.point2"]
    );
    assert_eq!(
        bad("cycle.alignRotaryAxis", number(1.0)),
        ["align-needs-confirm cycle.alignRotaryAxis"]
    );
    assert_eq!(
        bad("cycle.clearanceHeight", number(-10.0)),
        ["clearance-height-too-low cycle.clearanceHeight"]
    );
    assert_eq!(
        bad("cycle.probe.dist", number(2.0)),
        ["dist-too-short cycle.probe.dist"]
    );
    assert_eq!(
        bad("cycle.probe.bogus", number(2.0)),
        ["unknown-key cycle.probe.bogus"]
    );
    assert_eq!(
        bad("cycle.extrusion", number(2.0)),
        ["wrong-type cycle.extrusion"]
    );
    assert_eq!(
        bad("control.form", text("moves")),
        ["form-unsupported control.form"]
    );
    let corner = job(
        r#"{ "format": 1, "control": { "post": "heidenhain", "form": "cycle" }, "cycle": { "type": "double-wall-external-corner" } }"#,
    );
    assert_eq!(errors(&corner), ["form-unsupported control.form"]);
}

/// Mode −1: the clearance height is not used; the ball crosses at its current height and moves down at the probing feed.
#[test]
fn without_the_clearance_height() {
    let mut job = with(
        &with(&holes(), "cycle.geometryType", number(1.0)),
        "cycle.clearanceHeightMode",
        number(-1.0),
    );
    job = with(&job, "cycle.startingAngle", number(180.0));
    job = with(&job, "cycle.start", point([0.0, 40.0, 10.0]));
    let plan = planned(&job);
    let first: Vec<([f64; 3], &str)> = plan.moves.iter().take(2).map(|m| (m.to, m.feed)).collect();
    assert_eq!(
        first,
        [([-45.0, 0.0, 10.0], "rapid"), ([-45.0, 0.0, -10.0], "work")]
    );
    assert_eq!(plan.moves.last().unwrap().to[2], -10.0);
}

#[test]
fn nothing_is_called_good_that_was_not_measured() {
    let missed = with(
        &with(&holes(), "cycle.diameter1", text("20H7")),
        "part.sizes.diameter1",
        number(25.0),
    );
    let status = row(&planned(&missed).results, "Q183").clone();
    assert_eq!(status.value, None);
    assert!(status.verdict.unwrap().starts_with("unknown"));
    // The tool axis of a probed object is not measured: its tolerance has no verdict.
    let axis = with(
        &holes(),
        "cycle.point1",
        Value::List(vec![number(-30.0), number(0.0), text("-10-0.2-0.1")]),
    );
    let plan = planned(&axis);
    assert_eq!((value(&plan, "Q982"), value(&plan, "Q183")), (0.0, -1.0));
}

#[test]
fn plain_moves_do_not_pretend_to_judge() {
    let mut job = on_linuxcnc(&with(
        &with(&holes(), "cycle.diameter1", text("20H7")),
        "cycle.errorReaction",
        number(1.0),
    ));
    assert_eq!(warnings(&job), ["reaction-unsupported"]);
    job = with(
        &with(&job, "control.workOffset", number(1.0)),
        "cycle.transferPosition",
        number(1.0),
    );
    assert_eq!(errors(&job), ["reaction-unsupported cycle.errorReaction"]);
    let sideways = with(
        &holes(),
        "cycle.extrusion",
        Value::Map(vec![
            ("direction".into(), number(1.0)),
            ("points".into(), number(3.0)),
            ("length".into(), number(2.0)),
        ]),
    );
    assert_eq!(
        errors(&sideways),
        ["extrusion-direction cycle.extrusion.direction"]
    );
}
