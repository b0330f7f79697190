//! The ball off the spindle axis: stated values against the virtual part for every angle of the spindle.

use crate::common::{job, number, planned, point, with};
use touchpath::form::Value;
use touchpath::job::Plan;

const RUNOUT: f64 = 0.02;

/// Spread of every result over the angles of the spindle. A ball that is off the axis by e touches the part like a centred one touches a part shifted by −e: so
/// the part of the job is moved, and the crate's path and contacts give the machine position.
fn spread(job: &Value) -> Vec<(String, f64)> {
    const ANGLES: usize = 36;
    let offset = |angle: f64| match job.get("part").and_then(|part| part.get("offset")) {
        Some(Value::List(list)) => {
            let at = |i: usize| {
                if let Value::Number(x) = list[i] {
                    x
                } else {
                    0.0
                }
            };
            point([
                at(0) - RUNOUT * angle.cos(),
                at(1) - RUNOUT * angle.sin(),
                at(2),
            ])
        }
        _ => point([-RUNOUT * angle.cos(), -RUNOUT * angle.sin(), 0.0]),
    };
    let plans: Vec<Plan> = (0..ANGLES)
        .map(|k| {
            planned(&with(
                job,
                "part.offset",
                offset(k as f64 * std::f64::consts::TAU / ANGLES as f64),
            ))
        })
        .collect();
    let of = |i: usize| {
        let values: Vec<f64> = plans
            .iter()
            .filter_map(|plan| plan.results[i].value)
            .collect();
        let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
        (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len().max(1) as f64).sqrt()
    };
    plans[0]
        .results
        .iter()
        .enumerate()
        .map(|(i, row)| (row.code.clone(), of(i)))
        .collect()
}

/// Every stated share equals the spread, within `off` of the eccentricity. Returns the results that move by more than that.
fn agrees_within(text: &str, off: f64) -> Vec<(String, f64)> {
    let own = with(&job(text), "stylus.runout", number(RUNOUT));
    let plan = planned(&own);
    let mut moving = Vec::new();
    for (row, (code, spread)) in plan.results.iter().zip(spread(&own)) {
        let Some(stated) = row.uncertainty_runout else {
            assert!(
                row.uncertainty.is_none() || row.value.is_none(),
                "{code} states none"
            );
            continue;
        };
        assert!(
            (spread - stated).abs() <= off * RUNOUT,
            "{code}: {spread} drawn, {stated} stated"
        );
        if stated > off * RUNOUT {
            moving.push((code, stated));
        }
    }
    moving
}

/// On the nominal part they agree to a thousandth, the curvature of a round wall.
fn agrees(text: &str) -> Vec<(String, f64)> {
    agrees_within(text, 1e-3)
}

/// A position has e/√2 along each axis, for any touches; a size, an angle and a direction do not change.
#[test]
fn places_move_and_sizes_do_not() {
    let place = RUNOUT / 2f64.sqrt();
    let shapes = [
        (
            r#"{ "type": "internal-rectangle-protected" }"#,
            ["center.x", "center.y"],
        ),
        (
            r#"{ "type": "internal-rectangle-protected", "rotation": 33 }"#,
            ["center.x", "center.y"],
        ),
        (
            r#"{ "type": "external-rectangle" }"#,
            ["center.x", "center.y"],
        ),
        (r#"{ "type": "hole" }"#, ["center.x", "center.y"]),
        (
            r#"{ "type": "boss", "variant": 1, "startAngle": 10, "angularStep": 70, "stepCount": 5 }"#,
            ["center.x", "center.y"],
        ),
        (
            r#"{ "type": "double-wall-internal-corner" }"#,
            ["corner.x", "corner.y"],
        ),
        (
            r#"{ "type": "double-wall-internal-corner", "angle": 55, "rotation": 25 }"#,
            ["corner.x", "corner.y"],
        ),
        (
            r#"{ "type": "triple-wall-external-corner" }"#,
            ["corner.x", "corner.y"],
        ),
    ];
    for (cycle, codes) in shapes {
        let moving = agrees(&format!(r#"{{ "format": 1, "cycle": {cycle} }}"#));
        assert_eq!(
            moving
                .iter()
                .map(|(code, _)| code.as_str())
                .collect::<Vec<_>>(),
            codes,
            "{cycle}"
        );
        assert!(
            moving
                .iter()
                .all(|(_, stated)| (stated - place).abs() < 1e-9),
            "{cycle}: {moving:?}"
        );
    }
}

/// Features measured along one direction: a groove rotated by 30° is measured along u, so its middle moves by e/√2·cos 30° and e/√2·sin 30°. A slope of 60° is
/// measured along its normal: e/√2·cos 60°, and its point moves along the normal.
#[test]
fn one_direction_takes_its_share() {
    let place = RUNOUT / 2f64.sqrt();
    let near = |moving: &[(String, f64)], code: &str, by_hand: f64| {
        let (_, stated) = moving
            .iter()
            .find(|(own, _)| own == code)
            .unwrap_or_else(|| panic!("{code}: {moving:?}"));
        assert!(
            (stated - by_hand).abs() < 1e-9,
            "{code}: {stated}, by hand {by_hand}"
        );
    };
    let groove = agrees(r#"{ "format": 1, "cycle": { "type": "groove", "rotation": 30 } }"#);
    let cos = 3f64.sqrt() / 2.0;
    near(&groove, "center.x", place * cos);
    near(&groove, "center.y", place * 0.5);
    let slope = agrees(r#"{ "format": 1, "cycle": { "type": "surface", "elevation": 60 } }"#);
    near(&slope, "deviation", place * 0.5);
    near(&slope, "point.x", place * 0.25);
    near(&slope, "point.z", place * 0.5 * cos);
    assert_eq!(
        agrees(r#"{ "format": 1, "cycle": { "type": "surface", "elevation": 90 } }"#),
        [],
        "down the axis nothing moves"
    );
}

/// 1411: both circles move alike, so the rotation does not change; repeated touches move alike, too, whereas their scatter would shrink.
#[test]
fn two_circles_move_together() {
    for extrusion in [
        "null",
        r#"{ "direction": 3, "points": 4, "length": -6, "modal": 0 }"#,
    ] {
        let text = format!(
            r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "diameter1": 24, "probePoints": 5, "extrusion": {extrusion} }},
                "control": {{ "post": "heidenhain", "form": "cycle" }} }}"#
        );
        let moving = agrees(&text);
        let place = RUNOUT / 2f64.sqrt();
        for code in ["Q950", "Q951", "Q953", "Q954"] {
            assert!(
                moving
                    .iter()
                    .any(|(own, x)| own == code && (x - place).abs() < 1e-6),
                "{code}: {moving:?}"
            );
        }
        assert!(
            moving
                .iter()
                .all(|(code, _)| !matches!(code.as_str(), "Q964" | "Q965" | "Q966" | "Q967")),
            "{moving:?}"
        );
    }
}

/// A displaced part is touched slightly askew, which the stated share omits: 3 % for a hole 0.5 mm off its centre.
#[test]
fn a_displaced_part_changes_little() {
    let part = r#""part": { "offset": [0.4, -0.3, 0], "rotation": 0.5 }"#;
    for cycle in [
        "internal-rectangle-protected",
        "hole-protected",
        "double-wall-external-corner",
    ] {
        assert_eq!(
            agrees_within(
                &format!(r#"{{ "format": 1, "cycle": {{ "type": "{cycle}" }}, {part} }}"#),
                0.03
            )
            .len(),
            2,
            "{cycle}"
        );
    }
}

/// Repeatability and eccentricity are independent: their squares add up. At the angle of calibration the eccentricity has no effect; without a
/// value it is not computed.
#[test]
fn it_adds_to_the_scatter_and_calibration_takes_it_out() {
    let pocket = job(
        r#"{ "format": 1, "stylus": { "repeatability": 0.003 }, "cycle": { "type": "internal-rectangle-protected" } }"#,
    );
    let row = |job: &Value| planned(job).results[0].clone();
    let alone = row(&pocket).uncertainty.unwrap();
    assert_eq!(row(&pocket).uncertainty_runout, None);
    let eccentric = with(&pocket, "stylus.runout", number(0.004));
    // 0.003/√2 and 0.004/√2: 0.005/√2.
    assert!((alone - 0.003 / 2f64.sqrt()).abs() < 1e-12);
    assert!((row(&eccentric).uncertainty.unwrap() - 0.005 / 2f64.sqrt()).abs() < 1e-12);
    let oriented = row(&with(&eccentric, "control.orient", number(0.0)));
    assert_eq!(
        (oriented.uncertainty, oriented.uncertainty_runout),
        (Some(alone), None)
    );
    // The finding must not blame the touches for a large eccentricity.
    assert!(
        planned(&with(&pocket, "stylus.runout", number(0.1)))
            .findings
            .iter()
            .all(|f| f.code != "uncertain-result")
    );
}

/// In G18 abscissa and ordinate are Z and X; in inch it is the same share.
#[test]
fn planes_and_inches() {
    let inch = r#"{ "format": 1, "units": "inch", "plane": "G18", "stylus": { "diameter": 0.25, "runout": 0.001 }, "cycle": { "type": "hole" } }"#;
    let plan = planned(&job(inch));
    for row in &plan.results[..2] {
        assert!(
            (row.uncertainty_runout.unwrap() - 0.001 / 2f64.sqrt()).abs() < 1e-12,
            "{row:?}"
        );
    }
    assert_eq!(plan.results[2].uncertainty_runout, Some(0.0));
}
