//! The ENCY / SprutCAM family: rows as in the source's pages, moves and measurements by hand, and the uncertainties of results.

mod dumps;
mod picks;

use crate::common::{job, number, planned, with};
use proptest::prelude::*;
use touchpath::cycle::CYCLES;
use touchpath::describe::export_table;
use touchpath::form::{Default, Field, Kind, Level, Value};
use touchpath::job::{Plan, check, default_job};

fn cycle(text: &str) -> Value {
    job(&format!(r#"{{ "format": 1, "cycle": {text} }}"#))
}

/// Number of cycles in the family.
fn numbered() -> usize {
    CYCLES.iter().filter(|def| def.number.is_some()).count()
}

fn codes(plan: &Plan) -> Vec<String> {
    plan.table
        .iter()
        .map(|r| r.code.strip_prefix("CmdPrm.").unwrap().to_owned())
        .collect()
}

/// The rows of each page of the source, in its order: the rows before the touch points, the touches, the rows after them.
#[test]
fn every_type_has_the_rows_of_its_page() {
    let pages: &[(&str, i32, &str, i32, &str)] = &[
        ("probe-on-off", 0, "Int[-2] Bol[-3]", 0, ""),
        ("nc-action", 1, "Int[-2]", 0, ""),
        ("surface", 2, "Int[-2] Flt[-50]", 1, "Flt[-56] Flt[-66]"),
        (
            "hole",
            3,
            "Int[-2] Flt[-50] Flt[-51] Flt[-52] Flt[-55] Int[-59]",
            4,
            "",
        ),
        (
            "hole-protected",
            4,
            "Int[-2] Flt[-50] Flt[-51] Flt[-52] Flt[-55] Flt[-56] Int[-59]",
            4,
            "Flt[-66]",
        ),
        (
            "boss",
            5,
            "Int[-2] Flt[-50] Flt[-51] Flt[-52] Flt[-55] Flt[-56] Int[-59]",
            4,
            "Flt[-66]",
        ),
        (
            "internal-rectangle",
            6,
            "Int[-2] Flt[-50] Flt[-51] Flt[-53] Flt[-54] Flt[-55]",
            4,
            "",
        ),
        (
            "internal-rectangle-protected",
            7,
            "Int[-2] Flt[-50] Flt[-51] Flt[-53] Flt[-54] Flt[-55] Flt[-56] Flt[-57]",
            4,
            "Flt[-66]",
        ),
        (
            "external-rectangle",
            8,
            "Int[-2] Flt[-50] Flt[-51] Flt[-53] Flt[-54] Flt[-55] Flt[-56] Flt[-57]",
            4,
            "Flt[-66]",
        ),
        (
            "web",
            9,
            "Int[-2] Flt[-50] Flt[-51] Flt[-53] Flt[-55] Flt[-56]",
            2,
            "Flt[-66]",
        ),
        (
            "web-three-points",
            10,
            "Int[-2] Flt[-50] Flt[-51] Flt[-53] Flt[-56] Flt[-57]",
            3,
            "Flt[-66]",
        ),
        (
            "groove",
            11,
            "Int[-2] Flt[-50] Flt[-51] Flt[-53] Flt[-55]",
            2,
            "",
        ),
        (
            "groove-protected",
            12,
            "Int[-2] Flt[-50] Flt[-51] Flt[-53] Flt[-55] Flt[-56]",
            2,
            "Flt[-66]",
        ),
        (
            "double-wall-internal-corner",
            13,
            "Int[-2] Flt[-50] Flt[-56] Flt[-57] Int[-63] Int[-64] Flt[-65] Flt[-67]",
            4,
            "",
        ),
        (
            "double-wall-external-corner",
            14,
            "Int[-2] Flt[-50] Flt[-56] Flt[-57] Int[-63] Int[-64] Flt[-65] Flt[-67]",
            4,
            "Flt[-66]",
        ),
        (
            "triple-wall-internal-corner",
            15,
            "Int[-2] Flt[-50] Flt[-56] Flt[-57] Flt[-58]",
            3,
            "",
        ),
        (
            "triple-wall-external-corner",
            16,
            "Int[-2] Flt[-50] Flt[-51] Flt[-56] Flt[-57] Flt[-58]",
            3,
            "",
        ),
    ];
    let listed: Vec<&str> = pages.iter().map(|page| page.0).collect();
    for def in CYCLES.iter().filter(|def| def.number.is_some()) {
        assert!(listed.contains(&def.key), "{} lacks its page here", def.key);
    }
    assert_eq!(listed.len(), numbered());
    for (key, kind, before, touches, behind) in pages {
        let plan = planned(&default_job(key).unwrap());
        let mut expected = vec!["Int[-1]".to_owned()];
        expected.extend(before.split(' ').map(str::to_owned));
        for base in [-100, -200] {
            expected.extend((0..6 * touches).map(|i| format!("Flt[{}]", base - i)));
        }
        expected.extend(
            behind
                .split(' ')
                .filter(|c| !c.is_empty())
                .map(str::to_owned),
        );
        assert_eq!(codes(&plan), expected, "{key}");
        assert_eq!(
            plan.table[0].value,
            touchpath::job::ParameterValue::Whole(*kind),
            "{key}"
        );
        assert_eq!(
            touchpath::cycle::find(key).unwrap().number,
            Some(*kind),
            "{key}"
        );
        assert_eq!(plan.touches.len(), *touches as usize, "{key}");
    }
    // The one Boolean, the fixed SubCode, the Integer after a Flt, and a top clearance that is not checked.
    let text = |t: &str| export_table(&planned(&cycle(t)), "text").unwrap();
    assert_eq!(
        text(r#"{ "type": "probe-on-off", "on": false }"#),
        "CmdPrm.Int[-1] = 0\nCmdPrm.Int[-2] = -500\nCmdPrm.Bol[-3] = false\n"
    );
    assert!(!text(r#"{ "type": "groove", "topClearance": null }"#).contains("[-55]"));
    let properties = r#"{ "type": "web", "properties": { "wcsMode": 1, "wcsNumber": 3, "reportFeature": 9 },
        "custom": [{ "code": 101, "type": "Flt", "value": 2.5 }, { "code": 7, "type": "Bol", "value": true }] }"#;
    let tail = "CmdPrm.Flt[-66] = 0\nCmdPrm.Int[-10] = 1\nCmdPrm.Int[-11] = 3\nCmdPrm.Int[-25] = 9\nCmdPrm.Flt[101] = 2.5\nCmdPrm.Bol[7] = true\n";
    assert!(text(properties).ends_with(tail), "{}", text(properties));
}

/// Each move as "x y z feed step", the feed by its first letter (rEtract and rEturn by their second).
fn walked(text: &str) -> Vec<String> {
    planned(&cycle(text))
        .moves
        .iter()
        .map(|m| {
            let feed = match m.feed {
                "retract" => "t",
                "return" => "r",
                other => &other[..1],
            };
            format!(
                "{} {feed}{}",
                m.to.map(|x| touchpath::num::decimal(x, 3)).join(" "),
                m.step
            )
        })
        .collect()
}

/// By hand from the step lists: ball 6, so contacts are 3 in front of the surface.
#[test]
fn the_moves_of_each_kind_by_hand() {
    // A hole of 40 with its top at 5: entry at 5 + 8, touches at 5 − 10, contacts 17 from the middle.
    let hole = walked(
        r#"{ "type": "hole", "origin": [0, 0, 5], "diameter": 40, "depth": 10, "topClearance": 8, "feedDistance": 20 }"#,
    );
    let expected = [
        "0 0 33 a1",
        "0 0 13 a1",
        "0 0 -5 l1",
        "17 0 -5 w3",
        "0 0 -5 l3",
        "-17 0 -5 w3",
        "0 0 -5 l3",
        "0 17 -5 w3",
        "0 0 -5 l3",
        "0 -17 -5 w3",
        "0 0 -5 l3",
        "0 0 13 l4",
        "0 0 33 r5",
    ];
    assert_eq!(hole, expected);
    let unchecked = walked(
        r#"{ "type": "groove", "width": 20, "depth": 10, "topClearance": null, "feedDistance": 20 }"#,
    );
    assert_eq!(
        unchecked,
        [
            "0 0 10 a2",
            "0 0 -10 a2",
            "7 0 -10 w3",
            "0 0 -10 l3",
            "-7 0 -10 w3",
            "0 0 -10 l3",
            "0 0 10 r5"
        ]
    );
    // A boss of 40, three touches from 90° on: over 20 + 8 from the middle, contact at 23.
    let boss = walked(
        r#"{ "type": "boss", "diameter": 40, "depth": 6, "topClearance": 9, "sideClearance": 8, "variant": 1, "startAngle": 90,
        "angularStep": 90, "stepCount": 3, "feedDistance": 1 }"#,
    );
    let around = [
        "0 28 9 l2",
        "0 28 -6 l3",
        "0 23 -6 w4",
        "0 28 -6 l4",
        "0 28 9 l5",
        "0 0 9 l6",
    ];
    assert_eq!(
        boss[..8],
        [["0 0 10 a1", "0 0 9 a1"].as_slice(), around.as_slice()].concat()
    );
    assert_eq!(boss[8], "-28 0 9 l2");
    // The web's left touch is against the first direction; the middle one straight down from the start.
    let web = walked(
        r#"{ "type": "web-three-points", "width": 30, "depth": 5, "sideClearance": 7, "middleClearance": 12, "feedDistance": 3 }"#,
    );
    assert_eq!(
        web[..4],
        ["0 0 15 a1", "0 0 12 a1", "-22 0 12 l2", "-22 0 -5 l3"]
    );
    assert_eq!(web[14..], ["0 0 3 w8", "0 0 12 l8", "0 0 15 r9"]);
    // A slope of 30° over X, clearance 10: up by 10·(cos 30°, sin 30°), back on the retract feed.
    let slope =
        walked(r#"{ "type": "surface", "elevation": 30, "clearance": 10, "feedDistance": 4 }"#);
    assert_eq!(
        slope,
        [
            "8.66 0 9 a1",
            "8.66 0 5 a1",
            "2.598 0 1.5 w2",
            "8.66 0 5 t3",
            "8.66 0 9 r4"
        ]
    );
    // Outside a corner: the start is (−c1, −c2), the first touches 20 and 25 from the corner.
    let corner = walked(
        r#"{ "type": "double-wall-external-corner", "clearance1": 10, "clearance2": 12, "distance1": 20, "distance2": 25,
        "count1": 2, "count2": 1, "step1": 30, "feedDistance": 5 }"#,
    );
    let expected = [
        "-10 -12 5 a1",
        "-10 -12 0 a1",
        "-10 20 0 l2",
        "-3 20 0 w2",
        "-10 20 0 l2",
        "-10 50 0 l3",
        "-3 50 0 w3",
        "-10 50 0 l3",
        "-10 -12 0 l5",
        "25 -12 0 l6",
        "25 -3 0 w6",
        "25 -12 0 l6",
        "-10 -12 0 l9",
        "-10 -12 5 r10",
    ];
    assert_eq!(corner, expected);
    // Three walls inside: one start, three touches. Outside: the start is the top clearance above the top side.
    let inside = walked(
        r#"{ "type": "triple-wall-internal-corner", "clearance1": 10, "clearance2": 11, "clearance3": 12, "feedDistance": 5 }"#,
    );
    let expected = [
        "10 11 17 a1",
        "10 11 12 a1",
        "3 11 12 w2",
        "10 11 12 l2",
        "10 3 12 w3",
        "10 11 12 l3",
        "10 11 3 w4",
        "10 11 12 l4",
        "10 11 17 r5",
    ];
    assert_eq!(inside, expected);
    let outside = walked(
        r#"{ "type": "triple-wall-external-corner", "clearance1": 10, "clearance2": 11, "topClearance": 8, "depth": 6,
        "distance1": 20, "distance2": 21, "topDistance1": 14, "topDistance2": 15, "feedDistance": 5 }"#,
    );
    let expected = [
        "-10 -11 13 a1",
        "-10 -11 8 a1",
        "-10 20 -6 l2",
        "-3 20 -6 w2",
        "-10 20 -6 l2",
        "-10 -11 8 l3",
        "21 -11 -6 l4",
        "21 -3 -6 w4",
        "21 -11 -6 l4",
        "-10 -11 8 l5",
        "14 15 8 l6",
        "14 15 3 w6",
        "14 15 8 l6",
        "-10 -11 8 l7",
        "-10 -11 13 r8",
    ];
    assert_eq!(outside, expected);
    assert_eq!(walked(r#"{ "type": "probe-on-off" }"#), [""; 0]);
}

fn value(plan: &Plan, code: &str) -> f64 {
    plan.results
        .iter()
        .find(|r| r.code == code)
        .and_then(|r| r.value)
        .unwrap_or_else(|| panic!("{code}"))
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-7
}

/// Results of each kind on a displaced part, by formulas on paper.
#[test]
fn the_virtual_part_of_each_kind_by_hand() {
    let off = |text: &str, part: &str| {
        planned(&job(&format!(
            r#"{{ "format": 1, "cycle": {text}, "part": {part} }}"#
        )))
    };
    // A circle stays one: centre and diameter are exact. Uncertainties of four touches: σ/√2 for the centre, σ for the size.
    for kind in ["hole", "hole-protected", "boss"] {
        let plan = off(
            &format!(r#"{{ "type": "{kind}", "origin": [10, 20, 0], "diameter": 40 }}"#),
            r#"{ "offset": [0.3, -0.2, 0], "sizes": { "diameter": 0.05 } }"#,
        );
        assert!(
            near(value(&plan, "center.x"), 10.3) && near(value(&plan, "center.y"), 19.8),
            "{kind}"
        );
        assert!(near(value(&plan, "diameter"), 40.05), "{kind}");
        let sigma: Vec<f64> = plan
            .results
            .iter()
            .take(3)
            .map(|r| r.uncertainty.unwrap())
            .collect();
        let half = 0.001 / 2f64.sqrt();
        assert!(
            (sigma[0] - half).abs() < 2e-6
                && (sigma[1] - half).abs() < 2e-6
                && (sigma[2] - 0.001).abs() < 2e-6,
            "{sigma:?}"
        );
    }
    // Rotated by t, the walls of a groove are (W − d)(1/cos t − 1) too far apart, those of a web (W + d)(1/cos t − 1).
    let secant = 1.0 / 1f64.to_radians().cos() - 1.0;
    let turned = r#"{ "rotation": 1 }"#;
    assert!(near(
        value(
            &off(r#"{ "type": "groove", "width": 30 }"#, turned),
            "width"
        ),
        30.0 + 24.0 * secant
    ));
    assert!(near(
        value(&off(r#"{ "type": "web", "width": 30 }"#, turned), "width"),
        30.0 + 36.0 * secant
    ));
    let block = off(
        r#"{ "type": "external-rectangle", "width1": 80, "width2": 50 }"#,
        turned,
    );
    assert!(
        near(value(&block, "width1"), 80.0 + 86.0 * secant)
            && near(value(&block, "width2"), 50.0 + 56.0 * secant)
    );
    assert!(
        block
            .results
            .iter()
            .find(|r| r.code == "width1")
            .unwrap()
            .note
            .as_ref()
            .unwrap()
            .contains("(W + d)")
    );
    // A groove along Y detects a shift only in X; one rotated by 30° the part of it along its normal.
    let groove = off(
        r#"{ "type": "groove", "origin": [5, 6, 0], "rotation": 30, "width": 30 }"#,
        r#"{ "offset": [0.2, 0.1, 0] }"#,
    );
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let along = 0.2 * cos + 0.1 * sin;
    assert!(
        near(value(&groove, "center.x"), 5.0 + along * cos)
            && near(value(&groove, "center.y"), 6.0 + along * sin)
    );
    let straight = off(
        r#"{ "type": "groove", "origin": [5, 6, 0], "width": 30 }"#,
        r#"{ "offset": [0.2, 0.1, 0] }"#,
    );
    assert!(
        near(value(&straight, "center.x"), 5.2)
            && straight.results.iter().all(|r| r.code != "center.y")
    );
    // Heights.
    let web = off(
        r#"{ "type": "web-three-points", "origin": [0, 0, 2] }"#,
        r#"{ "offset": [0, 0, 0.25] }"#,
    );
    assert!(near(value(&web, "height"), 2.25));
    let top = off(
        r#"{ "type": "surface", "origin": [1, 2, 3] }"#,
        r#"{ "offset": [0, 0, -0.4] }"#,
    );
    assert!(near(value(&top, "point.z"), 2.6) && near(value(&top, "deviation"), -0.4));
    for kind in ["triple-wall-internal-corner", "triple-wall-external-corner"] {
        let plan = off(
            &format!(
                r#"{{ "type": "{kind}", "origin": [10, 20, 30], "rotation": 25, "angle": 75 }}"#
            ),
            r#"{ "offset": [0.3, -0.2, 0.1] }"#,
        );
        let corner = ["corner.x", "corner.y", "corner.z"].map(|c| value(&plan, c));
        assert!(
            near(corner[0], 10.3) && near(corner[1], 19.8) && near(corner[2], 30.1),
            "{kind} {corner:?}"
        );
    }
    // A corner that measures its angles has no error, rotated and with another angle.
    let corner = off(
        r#"{ "type": "double-wall-external-corner", "origin": [10, 20, 0], "rotation": 25, "angle": 75, "count1": 2, "count2": 3 }"#,
        r#"{ "offset": [0.3, -0.2, 0], "rotation": 0.4, "sizes": { "angle": 0.3 } }"#,
    );
    let (sin, cos) = 0.4f64.to_radians().sin_cos();
    assert!(
        near(value(&corner, "corner.x"), 10.0 * cos - 20.0 * sin + 0.3)
            && near(value(&corner, "corner.y"), 10.0 * sin + 20.0 * cos - 0.2)
    );
    assert!(
        near(value(&corner, "angle"), 75.3) && near(value(&corner, "rotation"), 0.4),
        "{:?}",
        corner.results
    );
}

/// A wrong dimension is found if the part is in the way: a crossing below the top of a block, a ball that does not fit.
#[test]
fn dimensions_that_do_not_go_together_are_refused() {
    let found = |text: &str| -> Vec<String> {
        check(&cycle(text))
            .iter()
            .filter(|f| f.level == Level::Error)
            .map(|f| format!("{} {}", f.code, f.path))
            .collect()
    };
    assert_eq!(
        found(r#"{ "type": "boss", "topClearance": 3 }"#),
        ["crossing-too-low cycle.topClearance"]
    );
    assert_eq!(
        found(r#"{ "type": "boss", "sideClearance": 3 }"#),
        ["clearance-too-small cycle.sideClearance"]
    );
    assert_eq!(
        found(r#"{ "type": "hole", "diameter": 6 }"#),
        ["ball-too-wide cycle.diameter"]
    );
    assert_eq!(
        found(r#"{ "type": "hole-protected", "diameter": 10 }"#),
        ["approach-beyond-wall cycle.sideClearance"]
    );
    assert_eq!(
        found(r#"{ "type": "groove", "width": 5 }"#),
        ["ball-too-wide cycle.width"]
    );
    assert_eq!(
        found(r#"{ "type": "web-three-points", "middleClearance": 2 }"#),
        ["clearance-too-small cycle.middleClearance"]
    );
    assert_eq!(
        found(r#"{ "type": "surface", "clearance": 2 }"#),
        ["clearance-too-small cycle.clearance"]
    );
    assert_eq!(
        found(r#"{ "type": "triple-wall-external-corner", "topClearance": 2 }"#),
        ["clearance-too-small cycle.topClearance"]
    );
    assert_eq!(
        found(r#"{ "type": "double-wall-external-corner", "count1": 9, "count2": 8 }"#),
        ["too-many-touches cycle.count1"]
    );
    assert_eq!(
        found(r#"{ "type": "hole", "variant": 1, "stepCount": 17 }"#),
        ["out-of-range cycle.stepCount"]
    );
    // An internal corner of three walls with a sharp angle: the ball touches the other wall.
    assert_eq!(
        found(
            r#"{ "type": "triple-wall-internal-corner", "angle": 150, "clearance1": 40, "clearance2": 4 }"#
        ),
        ["touch-beyond-corner cycle.clearance2"]
    );
    // Touches of which two coincide define no circle: reported, and the results are null.
    let twice = cycle(r#"{ "type": "hole", "variant": 1, "stepCount": 4, "angularStep": 180 }"#);
    assert!(
        check(&twice)
            .iter()
            .any(|f| f.code == "no-circle" && f.level == Level::Warning)
    );
    assert!(planned(&twice).results.iter().all(|r| r.value.is_none()));
}

fn picked(kind: &str, rest: &str, touches: &[([f64; 3], [f64; 3])]) -> Value {
    let touches: Vec<String> = touches
        .iter()
        .map(|(p, v)| format!(r#"{{ "point": {p:?}, "vector": {v:?} }}"#))
        .collect();
    cycle(&format!(
        r#"{{ "type": "{kind}", {rest} "touches": [{}] }}"#,
        touches.join(", ")
    ))
}

/// A number as in a form: three decimals.
fn written(low: f64, high: f64) -> BoxedStrategy<Value> {
    ((low * 1000.0) as i64..=(high * 1000.0) as i64)
        .prop_map(|n| number(n as f64 / 1000.0))
        .boxed()
}

fn field_value(field: &'static Field) -> BoxedStrategy<Value> {
    let (low, high) = field
        .usual
        .unwrap_or((field.hard.min.max(-170.0), field.hard.max.min(170.0)));
    match field.kind {
        Kind::Length if field.null.is_some() => {
            prop_oneof![3 => written(low, high.min(300.0)), 1 => Just(Value::Null)].boxed()
        }
        Kind::Length => written(low.max(0.01), high.min(300.0)),
        // A top side has no direction in the plane that its vector would keep.
        Kind::Angle if field.key == "elevation" => written(1.0, 80.0),
        Kind::Angle => written(low, high),
        Kind::Count => (field.hard.min.max(-99.0) as i32..=field.hard.max.min(9.0) as i32)
            .prop_map(|n| number(f64::from(n)))
            .boxed(),
        Kind::Flag => any::<bool>().prop_map(Value::Flag).boxed(),
        Kind::Code(codes) => (0..codes.len())
            .prop_map(move |i| number(f64::from(codes[i].value)))
            .boxed(),
        Kind::Point => proptest::collection::vec(written(-200.0, 200.0), 3)
            .prop_map(Value::List)
            .boxed(),
        _ => Just(Value::Null).boxed(),
    }
}

/// A job of the family that its dump could restore: defaults around the cycle, except stylus and plane.
fn dumped_job() -> impl Strategy<Value = Value> {
    (0..CYCLES.len())
        .prop_filter("of the family", |i| CYCLES[*i].number.is_some())
        .prop_flat_map(|i| {
            let def = CYCLES[i];
            let fields: Vec<_> = def.fields.iter().map(field_value).collect();
            let has_properties = !def.sections.is_empty();
            (fields, any::<bool>(), 0..3usize, written(0.5, 8.0)).prop_map(
                move |(values, properties, plane, ball)| {
                    let mut job = default_job(def.key).unwrap();
                    for (field, value) in def.fields.iter().zip(values) {
                        job = with(&job, &format!("cycle.{}", field.key), value);
                    }
                    if properties && has_properties {
                        let all: Vec<(String, Value)> = def.sections[0]
                            .fields
                            .iter()
                            .enumerate()
                            .map(|(i, f)| {
                                (
                                    f.key.to_owned(),
                                    if i % 3 == 0 {
                                        number(i as f64)
                                    } else {
                                        Value::Null
                                    },
                                )
                            })
                            .collect();
                        job = with(&job, "cycle.properties", Value::Map(all));
                        let own = vec![
                            ("code", number(31.0)),
                            ("type", Value::Text("Flt".into())),
                            ("value", number(0.25)),
                        ];
                        let own =
                            Value::Map(own.into_iter().map(|(k, v)| (k.to_owned(), v)).collect());
                        job = with(&job, "cycle.custom", Value::List(vec![own]));
                    }
                    // The vectors show the plane if not all surfaces are perpendicular to its tool axis; compensated points show the ball.
                    if def.place.is_some() && def.key != "surface" {
                        job = with(
                            &job,
                            "plane",
                            Value::Text(["G17", "G18", "G19"][plane].to_owned()),
                        );
                    }
                    let compensated = job.get("cycle").and_then(|c| c.get("compensateDimensions"))
                        == Some(&Value::Flag(true));
                    if compensated {
                        with(&job, "stylus.diameter", ball)
                    } else {
                        job
                    }
                },
            )
        })
}

#[test]
fn defaults_are_complete() {
    for def in CYCLES {
        let job = default_job(def.key).unwrap();
        for field in def.fields {
            assert!(
                job.get("cycle").unwrap().get(field.key).is_some(),
                "{} {}",
                def.key,
                field.key
            );
            assert!(
                !field.help.is_empty() && !field.group.is_empty(),
                "{} {}",
                def.key,
                field.key
            );
            assert!(
                !matches!(field.default, Default::Text("")),
                "{} {}",
                def.key,
                field.key
            );
        }
    }
}

/// The uncertainty of every result of every type equals the effect of each touch's scatter, by difference quotients through the evaluation of measured points.
#[test]
fn uncertainties_agree_with_difference_quotients() {
    let step = 1e-4;
    let mut compared = 0;
    for def in CYCLES.iter().filter(|c| c.number.is_some_and(|n| n > 1)) {
        let job = with(
            &default_job(def.key).unwrap(),
            "cycle.rotation",
            number(20.0),
        );
        let plan = planned(&job);
        let measured = |k: usize, by: f64| {
            let point =
                |(i, t): (usize, &Option<[f64; 3]>)| {
                    let vector = plan.touches[i].vector;
                    crate::common::point([0, 1, 2].map(|axis| {
                        t.unwrap()[axis] + if i == k { by * vector[axis] } else { 0.0 }
                    }))
                };
            let points = Value::List(plan.triggers.iter().enumerate().map(point).collect());
            touchpath::job::evaluate(&job, &points).unwrap()
        };
        let slopes: Vec<Vec<Option<f64>>> = (0..plan.touches.len())
            .map(|k| {
                let (up, down) = (measured(k, step), measured(k, -step));
                up.iter()
                    .zip(&down)
                    .map(|(u, d)| Some((u.value? - d.value?) / (2.0 * step)))
                    .collect()
            })
            .collect();
        for (i, row) in plan
            .results
            .iter()
            .enumerate()
            .filter(|(_, r)| r.value.is_some() && r.uncertainty.is_some())
        {
            let sum: f64 = slopes.iter().map(|s| s[i].unwrap().powi(2)).sum();
            let (wanted, shown) = (0.001 * sum.sqrt(), row.uncertainty.unwrap());
            assert!(
                (wanted - shown).abs() < 1e-6 + 1e-3 * wanted,
                "{} {}: {shown}, {wanted} by quotients",
                def.key,
                row.code
            );
            compared += 1;
        }
    }
    assert!(compared > 45, "{compared}");
}
