//! Edge cases: the start and end of a program, requirements of a path, and differences between values that look alike. Each test is named after a failure.

mod begin;
mod limits;
mod texts;

use crate::common::{job, number, planned, point, with};
use touchpath::describe::catalog;
use touchpath::form::{Level, Value};
use touchpath::job::{check, convert_units, default_job, plan};

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

fn text(t: &str) -> Value {
    Value::Text(t.to_owned())
}

fn cycle(text: &str) -> Value {
    job(&format!(r#"{{ "format": 1, "cycle": {text} }}"#))
}

fn picked(kind: &str, picks: &[([f64; 3], [f64; 3])]) -> Value {
    let touches = picks
        .iter()
        .map(|(p, v)| {
            Value::Map(vec![
                ("point".to_owned(), point(*p)),
                ("vector".to_owned(), point(*v)),
            ])
        })
        .collect();
    with(
        &default_job(kind).unwrap(),
        "cycle.touches",
        Value::List(touches),
    )
}

/// Picked touches at the positions that the default dimensions give.
fn default_picks(kind: &str) -> Vec<([f64; 3], [f64; 3])> {
    planned(&default_job(kind).unwrap())
        .touches
        .iter()
        .map(|t| (t.point, t.vector))
        .collect()
}

// Touches vanish, but the program computes and writes.

#[test]
fn a_clearance_that_is_the_radius_but_for_noise_programs_no_touch() {
    for clearance in [3.000_000_000_1, 3.0, 3.005] {
        let job = cycle(&format!(
            r#"{{ "type": "boss", "sideClearance": {clearance} }}"#
        ));
        assert_eq!(
            errors(&job),
            ["clearance-too-small cycle.sideClearance"],
            "{clearance}"
        );
    }
    let least = planned(&cycle(r#"{ "type": "boss", "sideClearance": 3.01 }"#));
    assert_eq!(least.moves.iter().filter(|m| m.kind == "touch").count(), 4);
    assert_eq!(
        least
            .program
            .text
            .lines()
            .filter(|l| l.starts_with("G38.2"))
            .count(),
        4
    );
}

#[test]
fn an_inch_ball_as_large_as_the_clearance_writes_a_frame_from_nothing() {
    for kind in [
        "external-rectangle",
        "boss",
        "hole-protected",
        "web",
        "groove-protected",
        "internal-rectangle-protected",
    ] {
        let job = job(&format!(
            r#"{{ "format": 1, "units": "inch", "stylus": {{ "diameter": {} }}, "cycle": {{ "type": "{kind}" }},
            "control": {{ "post": "sinumerik", "workOffset": 1 }} }}"#,
            16.0 / 25.4
        ));
        assert!(
            errors(&job)
                .iter()
                .any(|e| e.starts_with("clearance-too-small")),
            "{kind}: {:?}",
            errors(&job)
        );
    }
}

#[test]
fn sizes_and_steps_below_a_thousandth_are_none() {
    for (kind, key) in [
        ("double-wall-internal-corner", "step1"),
        ("double-wall-external-corner", "distance2"),
        ("boss", "diameter"),
        ("web", "width"),
        ("boss", "depth"),
    ] {
        let job = |x: f64| {
            with(
                &default_job(kind).unwrap(),
                &format!("cycle.{key}"),
                number(x),
            )
        };
        // A step of 3e-5 divided by zero after the touches.
        assert!(
            errors(&job(3e-5)).contains(&format!("out-of-range cycle.{key}")),
            "{kind} {key}"
        );
        assert!(
            !errors(&job(0.001)).contains(&format!("out-of-range cycle.{key}")),
            "{kind} {key}"
        );
    }
    let circles = |set_up: f64| {
        cycle(&format!(
            r#"{{ "type": "probing-two-circles", "probe": {{ "setUp": {set_up} }} }}"#
        ))
    };
    assert_eq!(
        errors(&circles(1e-10)).first().map(String::as_str),
        Some("clearance-too-small cycle.setUpClearance")
    );
    assert_eq!(errors(&circles(0.01)), [""; 0]);
}

#[test]
fn a_ball_that_fits_by_a_hair_begins_in_contact() {
    for (kind, key) in [
        ("hole", "diameter"),
        ("groove", "width"),
        ("internal-rectangle", "width1"),
    ] {
        let job = |x: f64| {
            with(
                &default_job(kind).unwrap(),
                &format!("cycle.{key}"),
                number(x),
            )
        };
        assert_eq!(
            errors(&job(6.019)),
            [format!("ball-too-wide cycle.{key}")],
            "{kind}"
        );
        assert!(
            errors(&job(6.02)).is_empty(),
            "{kind}: {:?}",
            errors(&job(6.02))
        );
    }
}

// Picked touches at different heights.

#[test]
fn picks_at_different_heights_make_the_ball_cross_inside() {
    for kind in [
        "web",
        "boss",
        "hole",
        "hole-protected",
        "internal-rectangle",
        "internal-rectangle-protected",
        "external-rectangle",
        "groove",
        "groove-protected",
        "double-wall-internal-corner",
        "double-wall-external-corner",
    ] {
        let picks = default_picks(kind);
        assert_eq!(errors(&picked(kind, &picks)), [""; 0], "{kind}");
        // One wrong digit in a dump.
        for k in 1..picks.len() {
            let mut wrong = picks.clone();
            wrong[k].0[2] += 50.0;
            assert!(
                errors(&picked(kind, &wrong))
                    .contains(&format!("touches-not-level cycle.touches[{k}].point")),
                "{kind} {k}: {:?}",
                errors(&picked(kind, &wrong))
            );
        }
        // A dump is rounded.
        let mut rounded = picks.clone();
        rounded[1].0[2] += 0.001;
        assert_eq!(errors(&picked(kind, &rounded)), [""; 0], "{kind}");
    }
}

#[test]
fn a_middle_touch_below_the_sides_is_taken_for_the_top() {
    for (kind, top) in [("web-three-points", 2), ("triple-wall-external-corner", 2)] {
        let mut picks = default_picks(kind);
        picks[top].0[2] = picks[0].0[2] - 1.0;
        let found = errors(&picked(kind, &picks));
        // For a corner the signs report it first.
        let said = found.iter().any(|e| {
            e.starts_with("touch-above-top") || e.starts_with("vector-wrong-way cycle.touches[2]")
        });
        assert!(said, "{kind}: {found:?}");
    }
}

/// A touch with a short approach may be aside by the tolerance of picks, and would run at 80° to its vector.
#[test]
fn a_pick_is_approached_askew() {
    let job = with(
        &default_job("double-wall-internal-corner").unwrap(),
        "cycle.count1",
        number(1.0),
    );
    let job = with(
        &with(&job, "cycle.count2", number(1.0)),
        "cycle.clearance1",
        number(3.02),
    );
    let touches = planned(&job).touches;
    // Aside by a hundredth of a millimetre, over two hundredths.
    let picks = |aside: f64| {
        let list = touches
            .iter()
            .enumerate()
            .map(|(k, t)| {
                let mut p = t.point;
                if k == 0 {
                    p[1] += aside;
                }
                Value::Map(vec![
                    ("point".to_owned(), point(p)),
                    ("vector".to_owned(), point(t.vector)),
                ])
            })
            .collect();
        with(&job, "cycle.touches", Value::List(list))
    };
    assert_eq!(errors(&picks(0.0)), [""; 0]);
    assert_eq!(errors(&picks(0.02)), ["touch-askew cycle.touches[0]"]);
}

/// These jobs are valid: an invented top side refused them.
#[test]
fn circles_are_refused_where_nothing_is_wrong() {
    for text in [
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles" }, "part": { "offset": [0, 0, 0.001] } }"#,
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles" }, "stylus": { "diameter": 0 } }"#,
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles" }, "stylus": { "diameter": 0 }, "part": { "offset": [0, 0, 0.001] } }"#,
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "geometryType": 1, "clearanceHeight": 65.621 }, "stylus": { "diameter": 2.997 } }"#,
    ] {
        assert_eq!(errors(&job(text)), [""; 0], "{text}");
    }
}

// Numbers.

#[test]
fn another_unit_leaves_tolerances_as_they_are() {
    let mut job = default_job("probing-two-circles").unwrap();
    for (key, value) in [("diameter1", "10H7"), ("diameter2", "20+0.05-0.02")] {
        job = with(&job, &format!("cycle.{key}"), text(value));
    }
    let inch = convert_units(&job, "inch").unwrap();
    let (metric, imperial) = (planned(&job), planned(&inch));
    for (m, i) in metric.touches.iter().zip(&imperial.touches) {
        for axis in 0..3 {
            assert!(
                (m.point[axis] - i.point[axis] * 25.4).abs() < 1e-4,
                "{m:?} {i:?}"
            );
        }
    }
    let middle = |plan: &touchpath::job::Plan| {
        plan.results
            .iter()
            .find(|r| r.code == "Q996")
            .unwrap()
            .deviation
            .unwrap()
    };
    // 10H7 is 10 + 0.015: the middle of the zone is 7.5 µm above the nominal size.
    assert!(
        (middle(&metric) + 0.0075).abs() < 1e-9 && (middle(&imperial) * 25.4 + 0.0075).abs() < 2e-5
    );
    assert_eq!(
        convert_units(&inch, "mm").unwrap().get("cycle"),
        job.get("cycle")
    );
}

#[test]
fn a_circle_swallows_the_other() {
    // 10 mm read as 10 inch.
    let job = cycle(r#"{ "type": "probing-two-circles", "diameter1": 254 }"#);
    assert_eq!(errors(&job), ["circle-in-circle cycle.diameter1"]);
    let other = cycle(r#"{ "type": "probing-two-circles", "diameter2": 140 }"#);
    assert_eq!(errors(&other), ["circle-in-circle cycle.diameter2"]);
}

#[test]
fn the_most_touches_are_said_of_each_cycle() {
    for entry in catalog().cycles {
        let plan = planned(&default_job(entry.key).unwrap());
        assert!(plan.touches.len() <= entry.max_touches, "{}", entry.key);
    }
    let most = |kind: &str| {
        catalog()
            .cycles
            .iter()
            .find(|c| c.key == kind)
            .unwrap()
            .max_touches
    };
    assert_eq!(
        [
            most("web"),
            most("boss"),
            most("nc-action"),
            most("probing-two-circles")
        ],
        [2, 16, 0, 1584]
    );
    let circles = cycle(
        r#"{ "type": "probing-two-circles", "probePoints": 8, "extrusion": { "points": 99, "length": -9 } }"#,
    );
    assert_eq!(planned(&circles).touches.len(), 1584);
}

// Passing data.

#[test]
fn a_turned_part_reads_six_millimetres_too_large_without_a_word() {
    let turned = job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected", "sideClearance1": 25, "sideClearance2": 15 },
        "overtravel": 20, "part": { "rotation": 22 } }"#,
    );
    let finding = check(&turned)
        .into_iter()
        .find(|f| f.code == "result-untrue")
        .unwrap();
    // (80 - 6)(1/cos 22° - 1) = 5.8116.
    assert!(
        finding.level == Level::Warning && finding.message.contains("85.812 mm as Width 1"),
        "{}",
        finding.message
    );
    let slight = with(&turned, "part.rotation", number(1.0));
    assert!(
        !warnings(&slight).contains(&"result-untrue".to_owned()),
        "0.011 mm at one degree"
    );
    let shifted =
        job(r#"{ "format": 1, "cycle": { "type": "hole" }, "part": { "offset": [1, 0.5, 0] } }"#);
    assert_eq!(
        warnings(&shifted),
        [""; 0],
        "a part that lies elsewhere is what probing is for"
    );
}

// The readers.

#[test]
fn findings_are_capped_with_a_count() {
    // The first line is read as a heading.
    let measured = Value::Text("x\n".repeat(400_000));
    let Err(error) = touchpath::job::evaluate(&default_job("hole").unwrap(), &measured) else {
        panic!()
    };
    assert_eq!(error.findings.len(), 201);
    let last = error.findings.last().unwrap();
    assert_eq!(
        (last.code.as_str(), last.level),
        ("more-findings", Level::Error)
    );
    assert!(last.message.contains("399799 errors"), "{}", last.message);
    // Findings beyond the list count: a job with two hundred warnings and one error is refused.
    let unknown: Vec<(String, Value)> = (0..5000).map(|i| (format!("k{i}"), Value::Null)).collect();
    let mut job = default_job("hole").unwrap();
    if let Value::Map(entries) = &mut job {
        entries.extend(unknown);
    }
    assert_eq!(check(&job).len(), 201);
    assert!(plan(&job).is_err());
}

#[test]
fn unknown_keys_do_not_hide_the_error_that_matters() {
    let noise = |cycle: &str| {
        let keys: String = (0..200).map(|i| format!(r#""zz{i}": 1, "#)).collect();
        job(&format!(r#"{{ {keys} "format": 1, "cycle": {cycle} }}"#))
    };
    // One pick where four are needed: a panic when the 201st error was dropped.
    for kind in ["hole", "internal-rectangle", "triple-wall-external-corner"] {
        let job = noise(&format!(
            r#"{{ "type": "{kind}", "touches": [{{ "point": [0, 0, 0], "vector": [1, 0, 0] }}] }}"#
        ));
        assert!(plan(&job).is_err(), "{kind}");
    }
}

#[test]
fn the_ends_of_ranges_hold_in_inch() {
    for (kind, path, mm) in [
        ("hole", "overtravel", 1000.0),
        ("hole", "stylus.diameter", 100.0),
        ("hole", "feeds.work", 0.1),
        ("hole", "cycle.depth", 0.001),
        ("probing-two-circles", "cycle.probe.dist", 1000.0),
        ("double-wall-internal-corner", "cycle.step1", 0.001),
    ] {
        let asked = with(&default_job(kind).unwrap(), path, number(mm));
        let ranges = |job: &Value| {
            check(job)
                .iter()
                .filter(|f| f.code == "out-of-range" || f.code == "unusual")
                .count()
        };
        let before = ranges(&asked);
        assert_eq!(
            ranges(&convert_units(&asked, "inch").unwrap()),
            before,
            "{kind} {path}"
        );
    }
}

/// The modes of the source are 0 to 3. A postprocessor may support another, so it is accepted with a note.
#[test]
fn a_mode_of_the_work_offset_that_the_source_does_not_have_is_warned_of() {
    for (mode, warned) in [(0, false), (3, false), (4, true), (-1, true)] {
        let job = cycle(&format!(
            r#"{{ "type": "boss", "properties": {{ "wcsMode": {mode} }} }}"#
        ));
        let found = check(&job)
            .iter()
            .any(|f| f.code == "unusual" && f.path == "cycle.properties.wcsMode");
        assert_eq!(found, warned, "{mode}");
        assert!(
            planned(&job)
                .table
                .iter()
                .any(|row| row.code == "CmdPrm.Int[-10]"),
            "{mode}"
        );
    }
}

/// On a tie a coordinate is rounded differently than beside it: the same digits must count as the same word. No word has changed here, so all three are in the
/// block.
#[test]
fn the_same_number_made_in_two_ways_is_another_word() {
    let job = job(
        r#"{ "format": 1, "control": { "post": "grbl", "form": "moves", "protection": "none" },
             "cycle": { "type": "probing-two-circles", "diameter1": 10, "diameter2": 10.000034, "point1": [0, 0, 0], "point2": [49.99955, 0, 0] } }"#,
    );
    let program = planned(&job).program.text;
    assert!(
        program
            .lines()
            .filter(|line| *line == "G0 X49.9995 Y0 Z100")
            .count()
            == 2,
        "{program}"
    );
}
