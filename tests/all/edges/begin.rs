//! The start of a program, its moves between touches, and its end.

use super::{cycle, errors, text, warnings};
use crate::common::import;
use crate::common::{job, number, planned, with};
use touchpath::job::{Plan, check, default_job};

// The first block must not dive into the feature, and the program must not end inside it.

#[test]
fn the_first_block_dives_into_the_feature() {
    for kind in ["hole", "internal-rectangle", "groove"] {
        let job = |distance: f64| {
            cycle(&format!(
                r#"{{ "type": "{kind}", "topClearance": null, "feedDistance": {distance} }}"#
            ))
        };
        assert_eq!(
            errors(&job(5.0)),
            ["start-in-feature cycle.feedDistance"],
            "{kind}"
        );
        // Ten down to the touches, and the ball's radius above the top.
        let finding = check(&job(5.0))
            .into_iter()
            .find(|f| f.code == "start-in-feature")
            .unwrap();
        assert!(
            finding.message.contains("at least 13 mm"),
            "{}",
            finding.message
        );
        assert_eq!(
            errors(&job(12.999)),
            ["start-in-feature cycle.feedDistance"]
        );
        let plan = planned(&job(13.0));
        assert_eq!(
            (plan.moves[0].to[2], plan.moves.last().unwrap().to[2]),
            (3.0, 3.0)
        );
        // With a top clearance too: the ball must be clear of the top.
        let low = cycle(&format!(
            r#"{{ "type": "{kind}", "topClearance": 1, "feedDistance": 1.5 }}"#
        ));
        assert_eq!(
            errors(&low),
            ["start-in-feature cycle.feedDistance"],
            "{kind}"
        );
    }
    let inch = job(
        r#"{ "format": 1, "units": "inch", "stylus": { "diameter": 0.25 },
        "cycle": { "type": "hole", "depth": 0.3, "topClearance": null, "feedDistance": 0.1 } }"#,
    );
    let finding = check(&inch)
        .into_iter()
        .find(|f| f.code == "start-in-feature")
        .unwrap();
    assert!(
        finding.message.contains("at least 0.425 inch"),
        "{}",
        finding.message
    );
}

#[test]
fn a_corner_with_no_feed_distance_begins_and_ends_at_the_touches() {
    for kind in [
        "double-wall-internal-corner",
        "double-wall-external-corner",
        "triple-wall-internal-corner",
    ] {
        let low = with(
            &default_job(kind).unwrap(),
            "cycle.feedDistance",
            number(0.0),
        );
        assert!(warnings(&low).contains(&"low-start".to_owned()), "{kind}");
        for post in ["linuxcnc", "grbl", "sinumerik"] {
            let plan = planned(&with(
                &default_job(kind).unwrap(),
                "control.post",
                text(post),
            ));
            let said = plan.program.text.replace("\n; ", " ").replace(")\n(", " ");
            assert!(
                said.contains("This cycle knows no top side: it begins and ends at Z"),
                "{kind} {post}"
            );
        }
    }
    let side = cycle(r#"{ "type": "surface", "elevation": 0, "feedDistance": 0 }"#);
    assert!(warnings(&side).contains(&"low-start".to_owned()));
    let top = cycle(r#"{ "type": "surface", "elevation": 90, "feedDistance": 1 }"#);
    assert_eq!(warnings(&top), [""; 0]);
    assert!(!planned(&top).program.text.contains("no top side"));
}

// 1411 as moves starts at `start`.

#[test]
fn the_first_block_of_1411_drives_to_where_the_stylus_is_said_to_be() {
    for post in ["linuxcnc", "grbl", "sinumerik"] {
        for protection in ["checked", "none"] {
            let from = |z: f64| {
                let job = job(&format!(
                    r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "start": [17, 23, {z}], "clearanceHeight": 50 }},
                    "control": {{ "post": "{post}", "form": "moves", "protection": "{protection}" }} }}"#
                ));
                let plan = planned(&job);
                let line = |i: usize| {
                    let text = plan
                        .program
                        .text
                        .lines()
                        .nth(plan.program.move_lines[i] as usize)
                        .unwrap();
                    text.split(' ')
                        .filter(|w| w.starts_with(['X', 'Y', 'Z']))
                        .map(str::to_owned)
                        .collect::<Vec<_>>()
                };
                let blocks = [line(0), line(1), line(2)];
                (plan.program.text.clone(), blocks)
            };
            // From below: the tool axis alone, then the plane.
            let (program, blocks) = from(20.0);
            assert_eq!(blocks[0], ["Z50"], "{post} {protection}\n{program}");
            assert_eq!(&blocks[1][..2], ["X-30", "Y0"], "{post} {protection}");
            // From above: the plane alone, then down.
            let (program, blocks) = from(80.0);
            assert_eq!(blocks[0], ["X-30", "Y0"], "{post} {protection}\n{program}");
            assert_eq!(
                blocks[1].last().map(String::as_str),
                Some("Z50"),
                "{post} {protection}\n{program}"
            );
            let comments = program.replace("\n; ", " ").replace(")\n(", " ");
            assert!(
                comments.contains("taken to be at X17 Y23 Z80 before the start"),
                "{program}"
            );
            let blocks = program.lines().filter(|l| !l.starts_with(['(', ';']));
            assert!(
                !blocks
                    .clone()
                    .any(|l| l.contains("X17") || l.contains("Y23")),
                "{program}"
            );
        }
    }
}

#[test]
fn the_ball_comes_down_into_the_material_beside_a_hole() {
    // Stand-off 2 + 3: beyond it the ball descends onto the plate at any height.
    for shift in [9.0, 11.0, 14.0, 25.0] {
        for y in [0.0, shift] {
            let job = job(&format!(
                r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles" }}, "part": {{ "offset": [{shift}, {y}, 0] }} }}"#
            ));
            assert!(
                errors(&job).is_empty() && warnings(&job).contains(&"collision".to_owned()),
                "{shift} {y}: {:?}",
                check(&job)
            );
        }
    }
    // A stud has no material around it.
    let studs = job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "geometryType": 1 }, "part": { "offset": [-1, 1, 0] } }"#,
    );
    assert_eq!(errors(&studs), [""; 0]);
}

#[test]
fn an_extrusion_goes_deeper_by_rapid() {
    for (length, mode) in [(-6.0, 2), (6.0, 1), (-6.0, 1)] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "clearanceHeightMode": {mode}, "geometryType": 1,
            "extrusion": {{ "points": 3, "length": {length} }} }}, "control": {{ "post": "linuxcnc", "form": "moves" }} }}"#
        ));
        let plan = planned(&job);
        let deeper = plan.moves.windows(2).filter(|w| {
            w[1].kind == "position" && w[1].to[2] < w[0].to[2] - 1e-9 && w[0].to[2] < 20.0
        });
        let feeds: Vec<&str> = deeper.map(|w| w[1].feed).collect();
        assert!(
            feeds.len() >= 2 && feeds.iter().all(|f| *f == "work"),
            "{length} {mode}: {feeds:?}"
        );
    }
}

// Programs.

#[test]
fn grbl_descends_at_a_feed_where_nothing_watches() {
    let boss = |protection: &str| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "boss" }}, "feeds": {{ "approach": null, "longLink": null }},
                "control": {{ "post": "grbl", "protection": "{protection}" }} }}"#
        ))
    };
    let lines = |plan: &Plan| -> Vec<(bool, String)> {
        let line = |i: usize| {
            plan.program
                .text
                .lines()
                .nth(plan.program.move_lines[i] as usize)
                .unwrap()
                .to_owned()
        };
        (1..plan.moves.len())
            .map(|i| (plan.moves[i].to[2] < plan.moves[i - 1].to[2], line(i)))
            .collect()
    };
    let plan = planned(&boss("none"));
    for (down, line) in lines(&plan) {
        assert!(!(down && line.starts_with("G0")), "{line}");
        assert!(!down || line.ends_with("F150"), "{line}");
    }
    assert!(plan.findings.iter().any(|f| f.code == "rapid-at-feed"));
    // When watched, it runs at the feed from which a machine stops.
    let plan = planned(&boss("checked"));
    for (down, line) in lines(&plan).iter().filter(|(_, line)| line.contains(" Z")) {
        assert!(
            line.starts_with("G38.3") && line.ends_with("F2000"),
            "{down} {line}"
        );
    }
    assert!(plan.findings.iter().all(|f| f.code != "rapid-at-feed"));
}

#[test]
fn calling_the_probe_is_a_tool_change_that_was_not_asked_for() {
    let job = default_job("probing-two-circles").unwrap();
    assert!(!planned(&job).program.text.contains("TOOL CALL"));
    assert!(planned(&job).program.text.contains("No tool is called"));
    let called = planned(&with(&job, "control.tool", number(7.0)))
        .program
        .text;
    assert_eq!(
        called
            .lines()
            .filter(|l| l.contains("TOOL CALL 7 Z S50"))
            .count(),
        1
    );
    // Comments never continue a block, and the program is read back.
    assert!(
        called
            .lines()
            .filter(|l| l.contains(" ; "))
            .all(|l| !l.ends_with('~'))
    );
    assert_eq!(
        import(&called)
            .unwrap()
            .job
            .get("control")
            .unwrap()
            .get("tool"),
        Some(&number(7.0))
    );
}

#[test]
fn positioning_is_watched_unless_the_job_says_not() {
    for kind in ["hole", "boss", "double-wall-internal-corner"] {
        for post in ["linuxcnc", "sinumerik"] {
            let job = with(&default_job(kind).unwrap(), "control.post", text(post));
            let checked = planned(&job);
            assert_eq!(
                checked.program.text,
                planned(&with(&job, "control.protection", text("checked")))
                    .program
                    .text
            );
            let bare = planned(&with(&job, "control.protection", text("none")));
            let watched = |plan: &touchpath::job::Plan| {
                plan.program.text.contains("G38.3") || plan.program.text.contains("TP_CONTACT")
            };
            assert_eq!(
                (watched(&checked), watched(&bare)),
                (true, false),
                "{kind} {post}"
            );
            assert!(bare.program.text.contains("NOT watched"));
            assert_eq!(bare.moves, checked.moves);
        }
    }
    assert_eq!(
        errors(&with(
            &default_job("hole").unwrap(),
            "control.protection",
            text("some")
        )),
        ["unknown-value control.protection"]
    );
}

// Values of the control that the moves cannot contain.

#[test]
fn predefined_heights_become_no_program_of_moves() {
    let predef = r#""type": "probing-two-circles", "setUpClearancePredef": true, "clearanceHeightPredef": true"#;
    let moves = cycle(&format!("{{ {predef} }}"));
    assert_eq!(
        errors(&moves),
        [
            "not-known cycle.setUpClearancePredef".to_owned(),
            "not-known cycle.clearanceHeightPredef".to_owned()
        ]
    );
    // The native cycle reads them from GLOBAL DEF: the values for the picture refuse nothing.
    let own = job(&format!(
        r#"{{ "format": 1, "control": {{ "post": "heidenhain", "form": "cycle" }},
        "cycle": {{ {predef}, "point1": [-30, 0, 140], "point2": [30, 0, 140], "probe": {{ "setUp": 0 }},
        "start": [0, 0, 200] }} }}"#
    ));
    let plan = planned(&own);
    assert!(plan.program.text.contains("Q320=PREDEF") && plan.program.text.contains("Q260=PREDEF"));
    assert_eq!(
        plan.findings
            .iter()
            .filter(|f| f.code == "predefined")
            .count(),
        2
    );
}

#[test]
fn the_plate_around_a_hole_leaves_room_beside_the_stud() {
    for (diameter, geometry, offset) in [
        (0.0, 2, 0.001),
        (1.0, 2, 0.6),
        (1.0, 3, -0.6),
        (6.0, 2, 1.0),
    ] {
        let job = job(&format!(
            r#"{{ "format": 1, "stylus": {{ "diameter": {diameter} }}, "part": {{ "offset": [{offset}, 0, 0] }},
            "cycle": {{ "type": "probing-two-circles", "geometryType": {geometry}, "clearanceHeightMode": 1 }} }}"#
        ));
        assert_eq!(errors(&job), [""; 0], "{diameter} {geometry} {offset}");
    }
}

#[test]
fn an_extrusion_is_left_before_the_next_object() {
    let job = cycle(
        r#"{ "type": "probing-two-circles", "geometryType": 1, "clearanceHeightMode": 0, "startingAngle": 90,
        "extrusion": { "points": 3, "length": -8 } }"#,
    );
    let plan = planned(&job);
    // Nothing crosses more than a millimetre below the measuring height.
    for pair in plan.moves.windows(2) {
        let [from, to] = [pair[0].to, pair[1].to];
        let crosses = (from[0] - to[0]).hypot(from[1] - to[1]) > 1.0 && pair[1].kind == "position";
        assert!(
            !crosses || (from[2] >= -10.0 && to[2] >= -10.0),
            "{from:?} {to:?}"
        );
    }
}

#[test]
fn chords_around_a_stud_stay_clear_of_it() {
    let job = cycle(
        r#"{ "type": "probing-two-circles", "geometryType": 1, "clearanceHeightMode": 1, "probe": { "setUp": 0.012 } }"#,
    );
    let text = planned(&job).program.text;
    let mut at = [f64::NAN; 3];
    let mut nearest = f64::INFINITY;
    // Blocks with their own positions, not those of a subroutine.
    let blocks = text.lines().filter(|l| {
        ["G38", "G0", "G1 "].iter().any(|word| l.starts_with(word)) && !l.contains('#')
    });
    for line in blocks {
        let mut to = at;
        for word in line.split(' ') {
            if let Some(axis) = ["X", "Y", "Z"].iter().position(|a| word.starts_with(a)) {
                to[axis] = word[1..].parse().unwrap();
            }
        }
        // The middle of a chord is nearest. Both studs have a diameter of 20, and the ball one of 6.
        if line.starts_with("G38.3") && to[2] == -10.0 && at[2] == -10.0 {
            let middle = [(at[0] + to[0]) / 2.0, (at[1] + to[1]) / 2.0];
            for centre in [-30.0, 30.0] {
                nearest = nearest.min((middle[0] - centre).hypot(middle[1]) - 13.0);
            }
        }
        at = to;
    }
    assert!(nearest > 0.005 && nearest < 0.012, "{nearest}");
}

#[test]
fn unwatched_positioning_is_said_where_it_could_be_watched() {
    for post in ["linuxcnc", "sinumerik"] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "hole" }}, "control": {{ "post": "{post}", "protection": "none" }} }}"#
        ));
        assert!(
            warnings(&job).contains(&"positioning-not-watched".to_owned()),
            "{post}"
        );
        assert!(
            !warnings(&with(&job, "control.protection", text("checked")))
                .contains(&"positioning-not-watched".to_owned())
        );
    }
}

#[test]
fn a_lift_is_made_before_the_program_aborts() {
    // ABORT discards what LinuxCNC has read and not yet moved; M66 waits for it.
    let text = planned(&default_job("hole").unwrap()).program.text;
    let lines: Vec<&str> = text.lines().collect();
    let aborts: Vec<usize> = (0..lines.len())
        .filter(|i| lines[*i].starts_with("(ABORT,Contact"))
        .collect();
    assert_eq!(aborts.len(), 1);
    assert_eq!(lines[aborts[0] - 1], "M66 E0 L0");
    assert!(
        lines[..aborts[0] - 1]
            .iter()
            .any(|l| l.starts_with("G1 Z") && l.contains('F'))
    );
}
