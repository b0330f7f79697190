//! Dangerous or incomplete jobs without a finding, and valid ones that were refused at a limit.

use super::{cycle, errors, picked, warnings};
use crate::common::{job, number, planned, point, with};
use touchpath::cycle::CYCLES;
use touchpath::form::Value;
use touchpath::job::{check, plan};

fn studs(more: &str) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "geometryType": 3, "diameter1": 12, "diameter2": 38.5, "point1": [0, 0, 0],
        "point2": [35, 0, 0], "clearanceHeight": 30, "start": [0, 0, 50], "setUpClearance": 2, "transferPosition": 1, "probe": {{ "dist": 10 }} }}{more} }}"#
    ))
}

/// The ball descends 13 beside the first stud: 19.25 + 3 around the second one reach to 35 − 22.25 = 12.75 only on a displaced part.
#[test]
fn a_part_that_lies_elsewhere_hid_a_collision_with_the_drawn_one() {
    assert_eq!(errors(&studs("")), ["collision cycle"]);
    for part in [
        r#""offset": [1, 0, 0]"#,
        r#""offset": [2, -1, 0]"#,
        r#""sizes": { "diameter2": -1 }"#,
    ] {
        assert!(
            errors(&studs(&format!(r#", "part": {{ {part} }}"#)))
                .contains(&"collision cycle".to_owned()),
            "{part}"
        );
    }
}

/// 45.5 away, the right wall is out of reach of the first touch, which ends at 42 + 3: there a control stops. The left wall at −34.5 is touched later.
#[test]
fn a_touch_that_meets_nothing_before_a_collision_is_said() {
    let job =
        cycle(r#"{ "type": "internal-rectangle-protected" }, "part": { "offset": [5.5, 0, 0] }"#);
    assert!(
        errors(&job).is_empty() && warnings(&job).contains(&"collision".to_owned()),
        "{:?}",
        check(&job)
    );
    let missed: Vec<String> = check(&job)
        .into_iter()
        .filter(|f| f.code == "no-contact")
        .map(|f| f.message)
        .collect();
    assert_eq!(missed.len(), 1);
    assert!(missed[0].starts_with("Touch 1 "), "{missed:?}");
}

/// The program is that of the drawing, and the part is a trial, which must not prevent saving. A run that ends in the part stores nothing, not even earlier
/// measurements: the arithmetic comes after the last move.
#[test]
fn a_trial_of_the_virtual_part_took_the_program_away() {
    let nominal = cycle(
        r#"{ "type": "internal-rectangle-protected" }, "control": { "post": "linuxcnc", "workOffset": 1 }"#,
    );
    for part in [[30.0, 0.0, 0.0], [5.5, 0.0, 0.0], [0.0, -30.0, 0.0]] {
        let job = with(&nominal, "part.offset", point(part));
        let (trial, drawn) = (planned(&job), planned(&nominal));
        assert_eq!(
            (&trial.program.text, &trial.moves),
            (&drawn.program.text, &drawn.moves),
            "{part:?}"
        );
        let told: Vec<_> = trial
            .findings
            .iter()
            .filter(|f| f.code == "collision")
            .collect();
        assert_eq!(told.len(), 1, "{told:?}");
        assert_eq!(
            (told[0].level, told[0].path.as_str()),
            (touchpath::form::Level::Warning, "part")
        );
        assert!(
            drawn.results.iter().any(|row| row.value.is_some())
                && trial.results.len() == drawn.results.len()
        );
        for row in &trial.results {
            assert_eq!(
                (row.value, row.deviation, row.uncertainty, &row.verdict),
                (None, None, None, &None),
                "{}",
                row.code
            );
        }
    }
    // A result that needs no touch is not stored either: 1411 reports nominal heights.
    let circles = cycle(r#"{ "type": "probing-two-circles" }, "part": { "offset": [25, 0, 0] }"#);
    assert!(
        planned(&circles)
            .results
            .iter()
            .all(|row| row.value.is_none() && row.verdict.is_none())
    );
}

/// Three touches over two degrees, each with a radial error e: along the middle one the centre moves by d with d + ρ = e2 and d cos 1° + ρ = (e1 + e3) / 2, so
/// d scatters by √1.5 / (1 − cos 1°) of a single touch, 8041 times.
#[test]
fn touches_side_by_side_wrote_an_offset_that_scatters_by_millimetres() {
    for kind in ["hole", "hole-protected", "boss"] {
        let job = cycle(&format!(
            r#"{{ "type": "{kind}", "variant": 1, "startAngle": 0, "angularStep": 1, "stepCount": 3 }}"#
        ));
        assert!(
            warnings(&job).contains(&"uncertain-result".to_owned()),
            "{kind}"
        );
        let plan = planned(&job);
        let center = plan
            .results
            .iter()
            .find(|row| row.code == "center.x")
            .unwrap();
        let degree = 1f64.to_radians();
        let expected = 0.001 * 1.5f64.sqrt() / (1.0 - degree.cos()) * degree.cos();
        assert!(
            (center.uncertainty.unwrap() / expected - 1.0).abs() < 1e-3,
            "{:?} {expected}",
            center.uncertainty
        );
    }
    let far = r#"{ "type": "double-wall-external-corner", "angle": 90, "distance1": 400, "distance2": 400, "step1": 2, "step2": 2 }"#;
    assert!(
        warnings(&cycle(far)).contains(&"uncertain-result".to_owned()),
        "{:?}",
        check(&cycle(far))
    );
    for kind in [
        "hole",
        "double-wall-internal-corner",
        "double-wall-external-corner",
        "triple-wall-internal-corner",
    ] {
        assert!(
            warnings(&cycle(&format!(r#"{{ "type": "{kind}" }}"#))).is_empty(),
            "{kind}"
        );
    }
}

/// Fourteen chords of a quarter of a millimetre went unwatched, although the rule was reported to hold.
#[test]
fn an_arc_in_pieces_too_short_to_be_watched_is_watched() {
    let tight = cycle(
        r#"{ "type": "probing-two-circles", "diameter1": 9.4, "diameter2": 9.4, "probePoints": 3, "setUpClearance": 0.01, "clearanceHeightMode": 1,
        "probe": { "setUp": 0, "dist": 10 } }, "control": { "post": "linuxcnc" }"#,
    );
    let plan = planned(&tight);
    let arc = plan
        .moves
        .iter()
        .position(|step| step.arc.is_some())
        .unwrap();
    let lines: Vec<&str> = plan.program.text.lines().collect();
    let (from, to) = (
        plan.program.move_lines[arc] as usize,
        plan.program.move_lines[arc + 1] as usize,
    );
    let pieces: Vec<&&str> = lines[from..to]
        .iter()
        .filter(|line| line.starts_with('G'))
        .collect();
    assert!(
        pieces.len() > 3 && pieces.iter().all(|line| line.starts_with("G38.3 ")),
        "{pieces:?}"
    );
}

/// Positions are written with four digits: writer and proof must agree about a move of exactly 0.2 or 0.3 mm.
#[test]
fn moves_as_long_as_the_shortest_probing_move_are_proven() {
    for (post, kind, base, shortest) in [
        ("fanuc", "groove-protected", 14.8, 0.2),
        ("linuxcnc", "groove-protected", 14.7, 0.3),
    ] {
        for n in -20..=20 {
            let clearance = base + f64::from(n) * 0.000_05;
            let job = job(&format!(
                r#"{{ "format": 1, "cycle": {{ "type": "{kind}", "width": 30, "sideClearance": {clearance} }}, "control": {{ "post": "{post}" }} }}"#
            ));
            let findings = check(&job);
            assert!(
                findings.iter().all(|f| f.code != "not-proven"),
                "{post} {clearance} {shortest}: {findings:?}"
            );
        }
    }
}

/// The proof's trigger was before the start of the touch.
#[test]
fn a_long_overtravel_behind_a_short_way_is_proven() {
    let job = job(
        r#"{ "format": 1, "overtravel": 10, "control": { "post": "fanuc" }, "cycle": { "type": "double-wall-external-corner", "clearance1": 20,
        "clearance2": 3.3, "count1": 8, "count2": 8 } }"#,
    );
    assert!(
        check(&job).iter().all(|f| f.code != "not-proven"),
        "{:?}",
        check(&job)
    );
}

/// The rotation of the ninth work offset is in #5390.
#[test]
fn the_last_work_offset_of_linuxcnc_is_turned_like_the_others() {
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "confirmRotation": 1, "transferPosition": 1 },
        "control": { "post": "linuxcnc", "workOffset": 9 } }"#,
    );
    assert_eq!(errors(&job), Vec::<String>::new());
}

/// Exactly at the end of a search a wall was missed and a hole was touched.
#[test]
fn what_lies_at_the_very_end_of_a_search_is_met() {
    for (kind, size) in [
        ("internal-rectangle-protected", "width1"),
        ("groove", "width"),
        ("hole", "diameter"),
    ] {
        // Both sides are 5 farther away: the overtravel.
        let at = |more: f64| {
            with(
                &cycle(&format!(r#"{{ "type": "{kind}" }}"#)),
                &format!("part.sizes.{size}"),
                number(10.0 + more),
            )
        };
        assert!(
            planned(&at(0.0)).triggers[..2].iter().all(Option::is_some),
            "{kind}"
        );
        assert!(
            planned(&at(1e-5)).triggers[..2].iter().all(Option::is_none),
            "{kind}"
        );
    }
}

/// A shaft would touch an overhanging wall before the ball does, and the retract after a miss moves up under it.
#[test]
fn a_wall_that_hangs_over_is_refused_for_every_pick() {
    let (side, down) = (0.96f64.sqrt(), -0.2);
    let picks = [
        ([0.0, 20.0, -10.0], [side, 0.0, down]),
        ([20.0, 0.0, -10.0], [0.0, 1.0, 0.0]),
        ([20.0, 20.0, -20.0], [0.0, 0.0, 1.0]),
    ];
    let found = errors(&picked("triple-wall-internal-corner", &picks));
    assert!(
        found.contains(&"vector-wrong-way cycle.touches[0].vector".to_owned()),
        "{found:?}"
    );
}

#[test]
fn a_feed_of_a_hundred_metres_a_minute_and_a_clearance_height_on_the_part_are_warned_of() {
    let fast = with(
        &cycle(r#"{ "type": "hole" }"#),
        "feeds.longLink",
        number(100_000.0),
    );
    assert!(warnings(&fast).contains(&"unusual".to_owned()));
    let low = with(
        &with(&studs(""), "cycle.clearanceHeight", number(3.3)),
        "cycle.start",
        point([0.0, 0.0, 3.3]),
    );
    assert!(
        warnings(&with(&low, "cycle.diameter2", number(20.0))).contains(&"low-start".to_owned())
    );
}

#[test]
fn the_empty_tool_is_no_probe() {
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles" }, "control": { "post": "heidenhain", "form": "cycle", "tool": 0 } }"#,
    );
    assert_eq!(errors(&job), ["out-of-range control.tool"]);
    assert!(plan(&with(&job, "control.tool", number(1.0))).is_ok());
}

/// A slope that is 1 off along X is touched 0.5 lower or higher: Z got a part of that, although the part has its nominal height.
#[test]
fn an_offset_in_axes_that_were_not_measured_apart_is_said() {
    let said = |text: &str| warnings(&cycle(text)).contains(&"offset-one-direction".to_owned());
    let offset = r#""control": { "workOffset": 1 }"#;
    for (text, expected) in [
        (r#"{ "type": "surface", "elevation": 30 }"#, true),
        (r#"{ "type": "surface", "elevation": 90 }"#, false),
        (r#"{ "type": "surface", "elevation": 0 }"#, false),
        (r#"{ "type": "web", "rotation": 30 }"#, true),
        (r#"{ "type": "web", "rotation": 90 }"#, false),
        (r#"{ "type": "web-three-points", "rotation": 30 }"#, true),
        (r#"{ "type": "web-three-points" }"#, false),
        (r#"{ "type": "hole", "rotation": 30 }"#, false),
        (
            r#"{ "type": "double-wall-internal-corner", "rotation": 30, "angle": 60 }"#,
            false,
        ),
        (
            r#"{ "type": "triple-wall-external-corner", "rotation": 30 }"#,
            false,
        ),
    ] {
        assert_eq!(said(&format!("{text}, {offset}")), expected, "{text}");
        assert!(!said(text), "nothing is written: {text}");
    }
}

/// The ball's edge is 0.4 from the wall at the start of the touch; or 0.55, with a sigma of 0.1.
#[test]
fn a_touch_that_begins_close_to_its_wall_is_said() {
    let said = |text: &str| warnings(&cycle(text)).contains(&"touch-close".to_owned());
    assert!(said(r#"{ "type": "boss", "sideClearance": 3.4 }"#));
    assert!(!said(r#"{ "type": "boss", "sideClearance": 3.5 }"#));
    let scatters =
        cycle(r#"{ "type": "boss", "sideClearance": 3.55 }, "stylus": { "repeatability": 0.1 }"#);
    let message = |job: &Value| {
        check(job)
            .into_iter()
            .find(|f| f.code == "touch-close")
            .unwrap()
            .message
    };
    assert!(message(&scatters).ends_with(
        "0.55 mm before its nominal contact: that is less than six times the repeatability"
    ));
    let close =
        cycle(r#"{ "type": "boss", "sideClearance": 3.4 }, "stylus": { "repeatability": 0.1 }"#);
    assert!(
        message(&close)
            .contains("0.4 mm before its nominal contact: on a part displaced by that much")
    );
    assert!(
        said(r#"{ "type": "hole", "diameter": 6.9 }"#),
        "half of what a hole leaves free"
    );
    assert!(said(
        r#"{ "type": "probing-two-circles", "probe": { "setUp": 0.3 } }"#
    ));
    let inch = r#"{ "type": "boss", "diameter": 1.5, "sideClearance": 0.2 }, "units": "inch", "stylus": { "diameter": 0.37 }"#;
    assert!(said(inch), "0.015 inch");
}

/// Distance of the ball from surfaces that it passes, by hand: 3.2 above a top is 0.2 for a ball of 6; in a hole of 80 a position 36.7 before one wall is 3.3
/// before the other, which leaves 0.3.
#[test]
fn a_move_that_passes_the_part_closely_is_said() {
    let said = |text: &str| {
        let found = check(&cycle(text))
            .into_iter()
            .find(|f| f.code == "passes-close");
        found.map(|f| {
            f.message
                .split(" only ")
                .nth(1)
                .unwrap()
                .split(' ')
                .next()
                .unwrap()
                .parse::<f64>()
                .unwrap()
        })
    };
    for (text, gap) in [
        (r#"{ "type": "boss", "topClearance": 3.2 }"#, 0.2),
        (r#"{ "type": "web", "topClearance": 3.0001 }"#, 0.0001),
        (
            r#"{ "type": "external-rectangle", "topClearance": 3.49 }"#,
            0.49,
        ),
        (
            r#"{ "type": "hole-protected", "diameter": 40, "sideClearance": 36.7 }"#,
            0.3,
        ),
        (
            r#"{ "type": "groove-protected", "width": 30, "sideClearance": 26.9999 }"#,
            0.0001,
        ),
        (
            r#"{ "type": "internal-rectangle-protected", "sideClearance1": 76.9 }"#,
            0.1,
        ),
    ] {
        assert!(
            said(text).is_some_and(|found| (found - gap).abs() < 1e-3),
            "{text}: {:?}",
            said(text)
        );
    }
    for text in [
        r#"{ "type": "boss", "topClearance": 3.5 }"#,
        r#"{ "type": "hole-protected", "diameter": 40, "sideClearance": 36.5 }"#,
    ] {
        assert_eq!(said(text), None, "{text}");
    }
    for def in CYCLES {
        assert_eq!(
            said(&format!(r#"{{ "type": "{}" }}"#, def.key)),
            None,
            "{}",
            def.key
        );
    }
}

/// From the middle to 3.25 before the wall of a groove of 7 is 0.25 across: too short for a probe move.
#[test]
fn positioning_that_is_not_watched_though_the_job_asks_for_it_is_said() {
    let said = |text: &str| {
        warnings(&cycle(text))
            .into_iter()
            .filter(|code| code == "positioning-not-watched")
            .count()
    };
    let groove = r#"{ "type": "groove-protected", "width": 7, "sideClearance": 3.25 }"#;
    // grbl has no shortest probing move.
    for (post, expected) in [("linuxcnc", 1), ("grbl", 0)] {
        assert_eq!(
            said(&format!(r#"{groove}, "control": {{ "post": "{post}" }}"#)),
            expected,
            "{post}"
        );
    }
    for post in ["linuxcnc", "grbl"] {
        let unwatched =
            format!(r#"{groove}, "control": {{ "post": "{post}", "protection": "none" }}"#);
        assert_eq!(said(&unwatched), 1, "{post}");
    }
    assert_eq!(said(r#"{ "type": "groove-protected" }"#), 0);
    for kind in ["nc-action", "probe-on-off"] {
        assert_eq!(
            said(&format!(
                r#"{{ "type": "{kind}" }}, "control": {{ "post": "grbl" }}"#
            )),
            0,
            "{kind}: nothing moves"
        );
    }
}

#[test]
fn a_low_rapid_is_said() {
    let feeds =
        r#""feeds": { "approach": null, "longLink": null, "retract": null, "return": null }"#;
    let said = |control: &str| {
        let job = cycle(&format!(
            r#"{{ "type": "internal-rectangle-protected" }}, {feeds}, "control": {{ {control} }}"#
        ));
        warnings(&job).contains(&"low-rapid".to_owned())
    };
    for post in ["grbl", "linuxcnc"] {
        assert!(
            said(&format!(r#""post": "{post}", "protection": "none""#)),
            "{post}"
        );
        assert!(
            !said(&format!(r#""post": "{post}""#)),
            "watched, it is no rapid: {post}"
        );
    }
    assert!(
        warnings(&cycle(
            r#"{ "type": "hole" }, "control": { "post": "grbl" }"#
        ))
        .iter()
        .all(|code| code != "low-rapid")
    );
}

#[test]
fn a_rotation_that_is_measured_and_not_written_is_said() {
    let said = |more: &str| {
        let job = cycle(&format!(
            r#"{{ "type": "double-wall-internal-corner" }}{more}"#
        ));
        check(&job).iter().any(|f| f.code == "rotation-not-written")
    };
    assert!(said(r#", "control": { "workOffset": 1 }"#));
    assert!(!said(""));
    for (transfer, confirm, expected) in [(1, 1, false), (1, 0, true), (0, 1, false), (0, 0, false)]
    {
        let circles = format!(
            r#"{{ "type": "probing-two-circles", "transferPosition": {transfer}, "confirmRotation": {confirm} }},
            "control": {{ "post": "linuxcnc", "workOffset": 1 }}"#
        );
        let found = check(&cycle(&circles))
            .iter()
            .any(|f| f.code == "rotation-not-written");
        assert_eq!(found, expected, "{transfer} {confirm}");
    }
}
