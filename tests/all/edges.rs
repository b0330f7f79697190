//! The edges: how a program begins and ends, what a path must hold, and what stands between two values that look alike. Each test is named
//! after a failure that was seen.

use crate::common::{job, number, planned, point, with};
use touchpath::describe::{catalog, export_table};
use touchpath::form::{Level, Value};
use touchpath::import::import;
use touchpath::job::{check, convert_units, default_job, plan};

fn errors(job: &Value) -> Vec<String> {
    check(job).iter().filter(|f| f.level == Level::Error).map(|f| format!("{} {}", f.code, f.path)).collect()
}

fn warnings(job: &Value) -> Vec<String> {
    check(job).iter().filter(|f| f.level == Level::Warning).map(|f| f.code.clone()).collect()
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
        .map(|(p, v)| Value::Map(vec![("point".to_owned(), point(*p)), ("vector".to_owned(), point(*v))]))
        .collect();
    with(&default_job(kind).unwrap(), "cycle.touches", Value::List(touches))
}

/// The picks that the default dimensions give.
fn default_picks(kind: &str) -> Vec<([f64; 3], [f64; 3])> {
    planned(&default_job(kind).unwrap()).touches.iter().map(|t| (t.point, t.vector)).collect()
}

// Touches vanish and the program computes and writes all the same.

#[test]
fn a_clearance_that_is_the_radius_but_for_noise_programs_no_touch() {
    for clearance in [3.000_000_000_1, 3.0, 3.005] {
        let job = cycle(&format!(r#"{{ "type": "boss", "sideClearance": {clearance} }}"#));
        assert_eq!(errors(&job), ["clearance-too-small cycle.sideClearance"], "{clearance}");
    }
    let least = planned(&cycle(r#"{ "type": "boss", "sideClearance": 3.01 }"#));
    assert_eq!(least.moves.iter().filter(|m| m.kind == "touch").count(), 4);
    assert_eq!(least.program.text.lines().filter(|l| l.starts_with("G38.2")).count(), 4);
}

#[test]
fn an_inch_ball_as_large_as_the_clearance_writes_a_frame_from_nothing() {
    for kind in ["external-rectangle", "boss", "hole-protected", "web", "groove-protected", "internal-rectangle-protected"] {
        let job = job(&format!(
            r#"{{ "format": 1, "units": "inch", "stylus": {{ "diameter": {} }}, "cycle": {{ "type": "{kind}" }},
            "control": {{ "post": "sinumerik", "workOffset": 1 }} }}"#,
            16.0 / 25.4
        ));
        assert!(errors(&job).iter().any(|e| e.starts_with("clearance-too-small")), "{kind}: {:?}", errors(&job));
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
        let job = |x: f64| with(&default_job(kind).unwrap(), &format!("cycle.{key}"), number(x));
        // A step of 3e-5 divided by zero after the touches.
        assert!(errors(&job(3e-5)).contains(&format!("out-of-range cycle.{key}")), "{kind} {key}");
        assert!(!errors(&job(0.001)).contains(&format!("out-of-range cycle.{key}")), "{kind} {key}");
    }
    let circles = |set_up: f64| cycle(&format!(r#"{{ "type": "probing-two-circles", "probe": {{ "setUp": {set_up} }} }}"#));
    assert_eq!(errors(&circles(1e-10)).first().map(String::as_str), Some("clearance-too-small cycle.setUpClearance"));
    assert_eq!(errors(&circles(0.01)), [""; 0]);
}

#[test]
fn a_ball_that_fits_by_a_hair_begins_in_contact() {
    for (kind, key) in [("hole", "diameter"), ("groove", "width"), ("internal-rectangle", "width1")] {
        let job = |x: f64| with(&default_job(kind).unwrap(), &format!("cycle.{key}"), number(x));
        assert_eq!(errors(&job(6.019)), [format!("ball-too-wide cycle.{key}")], "{kind}");
        assert!(errors(&job(6.02)).is_empty(), "{kind}: {:?}", errors(&job(6.02)));
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
                errors(&picked(kind, &wrong)).contains(&format!("touches-not-level cycle.touches[{k}].point")),
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
        // Of a corner the signs say it first.
        let said = found.iter().any(|e| e.starts_with("touch-above-top") || e.starts_with("vector-wrong-way cycle.touches[2]"));
        assert!(said, "{kind}: {found:?}");
    }
}

/// A touch with a short way to its contact may be aside by the tolerance of picks, and would run at 80° to its vector.
#[test]
fn a_pick_is_approached_askew() {
    let job = with(&default_job("double-wall-internal-corner").unwrap(), "cycle.count1", number(1.0));
    let job = with(&with(&job, "cycle.count2", number(1.0)), "cycle.clearance1", number(3.02));
    let touches = planned(&job).touches;
    // Aside by a hundredth of a millimetre, over a way of two hundredths.
    let picks = |aside: f64| {
        let list = touches
            .iter()
            .enumerate()
            .map(|(k, t)| {
                let mut p = t.point;
                if k == 0 {
                    p[1] += aside;
                }
                Value::Map(vec![("point".to_owned(), point(p)), ("vector".to_owned(), point(t.vector))])
            })
            .collect();
        with(&job, "cycle.touches", Value::List(list))
    };
    assert_eq!(errors(&picks(0.0)), [""; 0]);
    assert_eq!(errors(&picks(0.02)), ["touch-askew cycle.touches[0]"]);
}

// The first block dives into the feature, and the program ends inside it.

#[test]
fn the_first_block_dives_into_the_feature() {
    for kind in ["hole", "internal-rectangle", "groove"] {
        let job =
            |distance: f64| cycle(&format!(r#"{{ "type": "{kind}", "topClearance": null, "feedDistance": {distance} }}"#));
        assert_eq!(errors(&job(5.0)), ["start-in-feature cycle.feedDistance"], "{kind}");
        // Ten down to the touches, and the ball's radius over the top.
        let finding = check(&job(5.0)).into_iter().find(|f| f.code == "start-in-feature").unwrap();
        assert!(finding.message.contains("at least 13 mm"), "{}", finding.message);
        assert_eq!(errors(&job(12.999)), ["start-in-feature cycle.feedDistance"]);
        let plan = planned(&job(13.0));
        assert_eq!((plan.moves[0].to[2], plan.moves.last().unwrap().to[2]), (3.0, 3.0));
        // With a top clearance too: the ball must be clear of the top.
        let low = cycle(&format!(r#"{{ "type": "{kind}", "topClearance": 1, "feedDistance": 1.5 }}"#));
        assert_eq!(errors(&low), ["start-in-feature cycle.feedDistance"], "{kind}");
    }
    let inch = job(r#"{ "format": 1, "units": "inch", "stylus": { "diameter": 0.25 },
        "cycle": { "type": "hole", "depth": 0.3, "topClearance": null, "feedDistance": 0.1 } }"#);
    let finding = check(&inch).into_iter().find(|f| f.code == "start-in-feature").unwrap();
    assert!(finding.message.contains("at least 0.425 inch"), "{}", finding.message);
}

#[test]
fn a_corner_with_no_feed_distance_begins_and_ends_at_the_touches() {
    for kind in ["double-wall-internal-corner", "double-wall-external-corner", "triple-wall-internal-corner"] {
        let low = with(&default_job(kind).unwrap(), "cycle.feedDistance", number(0.0));
        assert!(warnings(&low).contains(&"low-start".to_owned()), "{kind}");
        for post in ["linuxcnc", "grbl", "sinumerik"] {
            let plan = planned(&with(&default_job(kind).unwrap(), "control.post", text(post)));
            let said = plan.program.text.replace("\n; ", " ").replace(")\n(", " ");
            assert!(said.contains("This cycle knows no top side: it begins and ends at Z"), "{kind} {post}");
        }
    }
    let side = cycle(r#"{ "type": "surface", "elevation": 0, "feedDistance": 0 }"#);
    assert!(warnings(&side).contains(&"low-start".to_owned()));
    let top = cycle(r#"{ "type": "surface", "elevation": 90, "feedDistance": 1 }"#);
    assert_eq!(warnings(&top), [""; 0]);
    assert!(!planned(&top).program.text.contains("no top side"));
}

// 1411 as moves drives to `start`.

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
                    let text = plan.program.text.lines().nth(plan.program.move_lines[i] as usize).unwrap();
                    text.split(' ').filter(|w| w.starts_with(['X', 'Y', 'Z'])).map(str::to_owned).collect::<Vec<_>>()
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
            assert_eq!(blocks[1].last().map(String::as_str), Some("Z50"), "{post} {protection}\n{program}");
            let comments = program.replace("\n; ", " ").replace(")\n(", " ");
            assert!(comments.contains("taken to be at X17 Y23 Z80 before the start"), "{program}");
            let blocks = program.lines().filter(|l| !l.starts_with(['(', ';']));
            assert!(!blocks.clone().any(|l| l.contains("X17") || l.contains("Y23")), "{program}");
        }
    }
}

/// Nothing is wrong with these: an invented top side stood in the way.
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

#[test]
fn the_ball_comes_down_into_the_material_beside_a_hole() {
    // Stand-off 2 + 3: beyond it the ball comes down on the plate, wherever that is.
    for shift in [9.0, 11.0, 14.0, 25.0] {
        for y in [0.0, shift] {
            let job = job(&format!(
                r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles" }}, "part": {{ "offset": [{shift}, {y}, 0] }} }}"#
            ));
            assert_eq!(errors(&job), ["collision part"], "{shift} {y}");
        }
    }
    // A stud stands free.
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
        let deeper =
            plan.moves.windows(2).filter(|w| w[1].kind == "position" && w[1].to[2] < w[0].to[2] - 1e-9 && w[0].to[2] < 20.0);
        let feeds: Vec<&str> = deeper.map(|w| w[1].feed).collect();
        assert!(feeds.len() >= 2 && feeds.iter().all(|f| *f == "work"), "{length} {mode}: {feeds:?}");
    }
}

// Programs.

#[test]
fn grbl_descends_by_rapid() {
    let job = job(
        r#"{ "format": 1, "cycle": { "type": "boss" }, "feeds": { "approach": null, "longLink": null }, "control": { "post": "grbl" } }"#,
    );
    let plan = planned(&job);
    for (i, pair) in plan.moves.windows(2).enumerate() {
        let line = plan.program.text.lines().nth(plan.program.move_lines[i + 1] as usize).unwrap();
        let down = pair[1].to[2] < pair[0].to[2];
        assert!(!(down && line.starts_with("G0")), "{line}");
        assert!(!down || line.ends_with("F150"), "{line}");
    }
    assert!(plan.findings.iter().any(|f| f.code == "rapid-at-feed"));
}

#[test]
fn comment_lines_are_longer_than_the_control_takes() {
    for (post, longest) in [("linuxcnc", 160), ("grbl", 80), ("sinumerik", 120), ("heidenhain", 80)] {
        for def in touchpath::cycle::CYCLES {
            let form = if post == "heidenhain" { "cycle" } else { "moves" };
            let job = with(&with(&default_job(def.key).unwrap(), "control.post", text(post)), "control.form", text(form));
            let job = with(&job, "name", text(&"long name ".repeat(20)));
            let Ok(plan) = plan(&job) else { continue };
            for line in plan.program.text.lines() {
                let comment = line.starts_with(['(', ';']) || line.contains(" ; ");
                assert!(!comment || line.len() <= longest, "{post} {}: {line}", line.len());
                assert!(line.len() <= 512);
            }
        }
    }
}

#[test]
fn the_note_quotes_another_name_than_the_program_bears() {
    let name = "Größe Ø 12";
    for (post, form, wanted) in [("linuxcnc", "moves", "Gr__e _ 12"), ("heidenhain", "cycle", "Gr__e___12")] {
        let job =
            with(&with(&default_job("probing-two-circles").unwrap(), "control.post", text(post)), "control.form", text(form));
        let job = with(&job, "name", text(name));
        let finding = check(&job).into_iter().find(|f| f.code == "name-changed").unwrap();
        assert!(finding.message.contains(&format!("\"{wanted}\"")), "{}", finding.message);
        assert!(planned(&job).program.text.contains(wanted));
    }
}

#[test]
fn angles_of_1411_have_three_decimals() {
    let job = cycle(r#"{ "type": "probing-two-circles", "startingAngle": 12.3456, "angularLength": 300.5 }"#);
    let job = with(&job, "control", crate::common::job(r#"{ "post": "heidenhain", "form": "cycle" }"#));
    let plan = planned(&job);
    assert!(plan.program.text.contains("Q325=+12.346 ;") && plan.program.text.contains("Q1119=+300.5 ;"));
    assert_eq!(plan.findings.iter().filter(|f| f.code == "angle-rounded").count(), 1);
}

#[test]
fn printing_in_inch_hides_small_values() {
    let inch = job(r#"{ "format": 1, "units": "inch", "cycle": { "type": "hole" } }"#);
    assert!(planned(&inch).program.text.contains("PRINT shows a value below .0001 inch as 0"));
    assert!(!planned(&default_job("hole").unwrap()).program.text.contains("below .0001"));
}

#[test]
fn calling_the_probe_is_a_tool_change_that_was_not_asked_for() {
    let job = default_job("probing-two-circles").unwrap();
    assert!(!planned(&job).program.text.contains("TOOL CALL"));
    assert!(planned(&job).program.text.contains("No tool is called"));
    let called = planned(&with(&job, "control.tool", number(7.0))).program.text;
    assert_eq!(called.lines().filter(|l| l.contains("TOOL CALL 7 Z S50")).count(), 1);
    // Comments never continue a block, and the program is read back.
    assert!(called.lines().filter(|l| l.contains(" ; ")).all(|l| !l.ends_with('~')));
    assert_eq!(import(&called).unwrap().job.get("control").unwrap().get("tool"), Some(&number(7.0)));
}

/// Another version's defaults would make another program of a header that leaves them out.
#[test]
fn the_header_says_only_what_the_loose_job_said() {
    let loose = job(r#"{ "format": 1, "cycle": { "type": "hole", "rotation": -0.0 }, "control": { "post": "sinumerik" } }"#);
    let text = planned(&loose).program.text;
    for said in [
        "format=1",
        "units=mm",
        "cycle.diameter=40",
        "cycle.topClearance=10",
        "cycle.rotation=0",
        "stylus.diameter=6",
        "overtravel=5",
    ] {
        assert!(text.lines().any(|l| l.starts_with("; job ") && l.split(' ').any(|w| w == said)), "{said}\n{text}");
    }
    assert!(!text.contains("-0 ") && !text.contains("=-0"));
    assert!(text.contains(&format!("; Made by Touchpath {} ", env!("CARGO_PKG_VERSION"))));
    let imported = import(&text).unwrap();
    assert!(imported.findings.iter().all(|f| f.level == Level::Info), "{:?}", imported.findings);
    assert_eq!(planned(&imported.job).program.text, text);
}

#[test]
fn positioning_is_watched_unless_the_job_says_not() {
    for kind in ["hole", "boss", "double-wall-internal-corner"] {
        for post in ["linuxcnc", "sinumerik"] {
            let job = with(&default_job(kind).unwrap(), "control.post", text(post));
            let checked = planned(&job);
            assert_eq!(checked.program.text, planned(&with(&job, "control.protection", text("checked"))).program.text);
            let bare = planned(&with(&job, "control.protection", text("none")));
            let watched =
                |plan: &touchpath::job::Plan| plan.program.text.contains("G38.3") || plan.program.text.contains("TP_CONTACT");
            assert_eq!((watched(&checked), watched(&bare)), (true, false), "{kind} {post}");
            assert!(bare.program.text.contains("NOT watched"));
            assert_eq!(bare.moves, checked.moves);
        }
    }
    assert_eq!(
        errors(&with(&default_job("hole").unwrap(), "control.protection", text("some"))),
        ["unknown-value control.protection"]
    );
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
            assert!((m.point[axis] - i.point[axis] * 25.4).abs() < 1e-4, "{m:?} {i:?}");
        }
    }
    let middle = |plan: &touchpath::job::Plan| plan.results.iter().find(|r| r.code == "Q996").unwrap().deviation.unwrap();
    // 10H7 is 10 + 0.015: the middle of the zone is 7.5 µm above the nominal size.
    assert!((middle(&metric) + 0.0075).abs() < 1e-9 && (middle(&imperial) * 25.4 + 0.0075).abs() < 2e-5);
    assert_eq!(convert_units(&inch, "mm").unwrap().get("cycle"), job.get("cycle"));
}

#[test]
fn a_circle_swallows_the_other() {
    // 10 mm taken for 10 inch.
    let job = cycle(r#"{ "type": "probing-two-circles", "diameter1": 254 }"#);
    assert_eq!(errors(&job), ["circle-in-circle cycle.diameter1"]);
    let other = cycle(r#"{ "type": "probing-two-circles", "diameter2": 140 }"#);
    assert_eq!(errors(&other), ["circle-in-circle cycle.diameter2"]);
}

#[test]
fn a_decimal_comma_in_a_json_dump_ends_the_value() {
    let dump = r#"{ "rows": [ { "code": "CmdPrm.Int[-1]", "value": 7 }, { "code": "CmdPrm.Flt[-53]", "value": "64,5", "meaning": "a } in it" } ] }"#;
    assert_eq!(crate::common::number_at(&import(dump).unwrap().job, "cycle.width1", 0.0), 64.5);
}

#[test]
fn a_jobs_own_json_is_refused_by_import() {
    let imported = import(r#"{ "format": 1, "cycle": { "type": "hole", "diameter": -3 } }"#).unwrap();
    assert_eq!(crate::common::number_at(&imported.job, "cycle.diameter", 0.0), -3.0);
    assert_eq!(imported.findings, check(&imported.job));
}

#[test]
fn predef_has_no_place_in_a_job() {
    let klartext = "0 BEGIN PGM A MM\n1 TCH PROBE 1411 ~\nQ1100=-30 ~\nQ1101=+0 ~\nQ1102=-10 ~\nQ1116=+20 ~\nQ1103=+30 ~\nQ1104=+0 ~\n\
                    Q1105=-10 ~\nQ1117=+20 ~\nQ320=PREDEF ~\nQ260=PREDEF\n2 END PGM A MM\n";
    let imported = import(klartext).unwrap();
    let at = |key: &str| imported.job.get("cycle").unwrap().get(key).cloned();
    assert_eq!((at("setUpClearancePredef"), at("clearanceHeightPredef")), (Some(Value::Flag(true)), Some(Value::Flag(true))));
    assert_eq!(imported.findings.iter().filter(|f| f.code == "predefined").count(), 2);
    let plan = planned(&imported.job);
    assert!(
        plan.program.text.contains("Q320=PREDEF ;SET-UP CLEARANCE")
            && plan.program.text.contains("Q260=PREDEF ;CLEARANCE HEIGHT")
    );
    let row = plan.table.iter().find(|r| r.code == "Q260").unwrap();
    assert_eq!(row.value, touchpath::job::ParameterValue::Text("PREDEF".to_owned()));
    // It is no tolerance that plain moves would have to judge.
    let moves = with(&imported.job, "control", job(r#"{ "post": "linuxcnc", "form": "moves" }"#));
    assert_eq!(warnings(&with(&moves, "cycle.errorReaction", number(1.0))), [""; 0]);
}

#[test]
fn the_star_of_an_iso_block_takes_the_last_parameter_with_it() {
    let iso = "%A G71 *\nN10 G1411 Q1100=-30 Q1103=+30 Q1126=+1 Q1121=+1*\n";
    assert_eq!(crate::common::number_at(&import(iso).unwrap().job, "cycle.confirmRotation", 0.0), 1.0);
}

#[test]
fn rows_of_the_angular_variant_contradict_the_rectangular_one() {
    for kind in ["hole", "hole-protected", "boss"] {
        let rectangular = cycle(&format!(r#"{{ "type": "{kind}", "variant": 0, "stepCount": 2 }}"#));
        let codes: Vec<String> = planned(&rectangular).table.iter().map(|r| r.code.clone()).collect();
        assert!(codes.iter().all(|c| !["[-60]", "[-61]", "[-62]"].iter().any(|end| c.ends_with(end))), "{codes:?}");
        // And their absence is none in a dump.
        let dump = export_table(&planned(&rectangular), "text").unwrap();
        assert!(import(&dump).unwrap().findings.iter().all(|f| f.code != "missing-code"));
        let angular = planned(&cycle(&format!(r#"{{ "type": "{kind}", "variant": 1 }}"#)));
        assert!(angular.table.iter().any(|r| r.code == "CmdPrm.Int[-62]"));
    }
}

#[test]
fn the_most_touches_are_said_of_each_cycle() {
    for entry in catalog().cycles {
        let plan = planned(&default_job(entry.key).unwrap());
        assert!(plan.touches.len() <= entry.max_touches, "{}", entry.key);
    }
    let most = |kind: &str| catalog().cycles.iter().find(|c| c.key == kind).unwrap().max_touches;
    assert_eq!([most("web"), most("boss"), most("nc-action"), most("probing-two-circles")], [2, 16, 0, 1584]);
    let circles = cycle(r#"{ "type": "probing-two-circles", "probePoints": 8, "extrusion": { "points": 99, "length": -9 } }"#);
    assert_eq!(planned(&circles).touches.len(), 1584);
}

/// The angle of a corner comes back as 19.999999… or its place lies out of what a form takes: the job is not refused for it.
#[test]
fn dumps_at_the_ends_of_ranges_come_back_refused() {
    for (kind, fields) in [
        ("double-wall-internal-corner", r#""rotation": 1, "angle": 20, "clearance1": 60, "clearance2": 60"#),
        ("double-wall-external-corner", r#""rotation": 1, "angle": 20"#),
        ("double-wall-external-corner", r#""rotation": -77.7, "angle": 160, "distance1": 0.001, "distance2": 1000"#),
        ("triple-wall-external-corner", r#""rotation": 33.3, "angle": 160, "distance1": 1000, "topDistance1": 0.001"#),
        ("surface", r#""rotation": 12, "elevation": 0"#),
        ("web", r#""width": 10000, "rotation": 0.1"#),
    ] {
        let job = cycle(&format!(r#"{{ "type": "{kind}", {fields} }}"#));
        let Ok(first) = plan(&job) else { panic!("{kind} {fields}: {:?}", errors(&job)) };
        let imported = import(&export_table(&first, "text").unwrap()).unwrap();
        assert_eq!(
            errors(&imported.job),
            [""; 0],
            "{kind} {fields}: {}",
            imported.job.get("cycle").map_or(String::new(), |c| format!("{c:?}"))
        );
        let again = planned(&imported.job);
        for (a, b) in first.moves.iter().zip(&again.moves) {
            assert!((0..3).all(|i| (a.to[i] - b.to[i]).abs() < 1e-5), "{kind}: {a:?} {b:?}");
        }
    }
}

/// Walls that are nearly parallel meet far away: such picks stay picks.
#[test]
fn picks_that_meet_beyond_every_range_stay_picks() {
    let picks =
        [([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]), ([0.0, 99_000.0, 0.0], [-0.342_020_143_325_669, -0.939_692_620_785_908, 0.0])];
    let base = job(r#"{ "format": 1, "cycle": { "type": "double-wall-external-corner", "count1": 1, "count2": 1 } }"#);
    let touches = picks
        .iter()
        .map(|(p, v)| Value::Map(vec![("point".to_owned(), point(*p)), ("vector".to_owned(), point(*v))]))
        .collect();
    let job = with(&base, "cycle.touches", Value::List(touches));
    let refused = plan(&job).is_err();
    if let Ok(first) = plan(&job) {
        let imported = import(&export_table(&first, "text").unwrap()).unwrap();
        assert_eq!(errors(&imported.job), [""; 0]);
    }
    // Distances beyond the form's range are refused as picks already.
    assert!(refused, "the distance to the first touch is beyond its range");
}

// Handing over.

#[test]
fn a_turned_part_reads_six_millimetres_too_large_without_a_word() {
    let turned =
        job(r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected", "sideClearance1": 25, "sideClearance2": 15 },
        "overtravel": 20, "part": { "rotation": 22 } }"#);
    let finding = check(&turned).into_iter().find(|f| f.code == "result-untrue").unwrap();
    // (80 - 6)(1/cos 22° - 1) = 5.8116.
    assert!(finding.level == Level::Warning && finding.message.contains("85.812 mm as width1"), "{}", finding.message);
    let slight = with(&turned, "part.rotation", number(1.0));
    assert!(!warnings(&slight).contains(&"result-untrue".to_owned()), "0.011 mm at one degree");
    let shifted = job(r#"{ "format": 1, "cycle": { "type": "hole" }, "part": { "offset": [1, 0.5, 0] } }"#);
    assert_eq!(warnings(&shifted), [""; 0], "a part that lies elsewhere is what probing is for");
}

// The readers.

#[test]
fn findings_are_capped_with_a_count() {
    // The first line is taken for a heading.
    let measured = Value::Text("x\n".repeat(400_000));
    let Err(error) = touchpath::job::evaluate(&default_job("hole").unwrap(), &measured) else { panic!() };
    assert_eq!(error.findings.len(), 201);
    let last = error.findings.last().unwrap();
    assert_eq!((last.code.as_str(), last.level), ("more-findings", Level::Error));
    assert!(last.message.contains("399799 errors"), "{}", last.message);
    // What is beyond the list is not forgotten: a good job with two hundred warnings and one error is refused.
    let unknown: Vec<(String, Value)> = (0..5000).map(|i| (format!("k{i}"), Value::Null)).collect();
    let mut job = default_job("hole").unwrap();
    if let Value::Map(entries) = &mut job {
        entries.extend(unknown);
    }
    assert_eq!(check(&job).len(), 201);
    assert!(plan(&job).is_err());
}

#[test]
fn a_text_of_any_length_is_read() {
    let long = "CmdPrm.Int[-1] = 7\n".repeat(200_000);
    let error = import(&long).unwrap_err();
    assert_eq!(error.findings[0].code, "text-too-long");
    assert_eq!(catalog().longest_text, 2_000_000);
    assert!(import(&long[..1_000_000]).is_ok());
}

/// A job read natively and in a browser is the same to the last bit.
#[test]
fn numbers_are_read_an_ulp_apart() {
    for text in [
        "0.1",
        "5e-324",
        "2.2250738585072011e-308",
        "123456789.12345679",
        "8.988465674311579e307",
        "17.976931348623157",
        "3.3306690738754696e-16",
    ] {
        let Value::Number(x) = job(text) else { panic!() };
        assert_eq!(x, text.parse::<f64>().unwrap(), "{text}");
    }
    let mut state = 88_172_645_463_325_252u64;
    for _ in 0..20_000 {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        let text = format!("{}.{:017}", state % 1000, state % 100_000_000_000_000_000);
        let Value::Number(x) = job(&text) else { panic!() };
        assert_eq!(x.to_bits(), text.parse::<f64>().unwrap().to_bits(), "{text}");
    }
}

// What the control has, and the moves cannot know.

#[test]
fn predefined_heights_become_no_program_of_moves() {
    let predef = r#""type": "probing-two-circles", "setUpClearancePredef": true, "clearanceHeightPredef": true"#;
    let moves = cycle(&format!("{{ {predef} }}"));
    assert_eq!(
        errors(&moves),
        ["not-known cycle.setUpClearancePredef".to_owned(), "not-known cycle.clearanceHeightPredef".to_owned()]
    );
    // The control's own cycle takes them from GLOBAL DEF: what stands in for the picture refuses nothing.
    let own = job(&format!(
        r#"{{ "format": 1, "control": {{ "post": "heidenhain", "form": "cycle" }},
        "cycle": {{ {predef}, "point1": [-30, 0, 140], "point2": [30, 0, 140], "probe": {{ "setUp": 0 }},
        "start": [0, 0, 200] }} }}"#
    ));
    let plan = planned(&own);
    assert!(plan.program.text.contains("Q320=PREDEF") && plan.program.text.contains("Q260=PREDEF"));
    assert_eq!(plan.findings.iter().filter(|f| f.code == "predefined").count(), 2);
}

#[test]
fn unknown_keys_do_not_hide_the_error_that_matters() {
    let noise = |cycle: &str| {
        let keys: String = (0..200).map(|i| format!(r#""zz{i}": 1, "#)).collect();
        job(&format!(r#"{{ {keys} "format": 1, "cycle": {cycle} }}"#))
    };
    // One pick where four are needed: a panic where the 201st error was forgotten.
    for kind in ["hole", "internal-rectangle", "triple-wall-external-corner"] {
        let job = noise(&format!(r#"{{ "type": "{kind}", "touches": [{{ "point": [0, 0, 0], "vector": [1, 0, 0] }}] }}"#));
        assert!(plan(&job).is_err(), "{kind}");
    }
}

#[test]
fn a_sinumerik_header_says_the_job_that_made_the_program() {
    // No form is said: the reader takes moves, though the cycle's own control is another.
    let job = job(r#"{ "format": 1, "cycle": { "type": "probing-two-circles" }, "control": { "post": "sinumerik" } }"#);
    let text = planned(&job).program.text;
    assert!(text.contains("control.form=moves") && !text.contains("control.form=cycle"));
    let read = import(&text).unwrap();
    assert_eq!(read.findings.iter().map(|f| f.code.as_str()).collect::<Vec<_>>(), ["part-not-in-program"]);
    assert_eq!(planned(&read.job).program.text, text);
    // A header without the control: the blocks cannot be compared, and that is said.
    let other = import(&text.replace("control.post=sinumerik ", "")).unwrap();
    assert!(other.findings.iter().any(|f| f.code == "program-differs" && f.path == "control.post"), "{:?}", other.findings);
}

#[test]
fn the_plate_around_a_hole_leaves_room_beside_the_stud() {
    for (diameter, geometry, offset) in [(0.0, 2, 0.001), (1.0, 2, 0.6), (1.0, 3, -0.6), (6.0, 2, 1.0)] {
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
        assert!(!crosses || (from[2] >= -10.0 && to[2] >= -10.0), "{from:?} {to:?}");
    }
}

#[test]
fn a_dump_that_is_a_hundredth_of_a_micrometre_off_level_is_level() {
    let corner = |feed: &str| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "double-wall-internal-corner"{feed}, "touches": [
            {{ "point": [15, 0, 0], "vector": [0, 1, 0] }}, {{ "point": [35, 0, 0.00001], "vector": [0, 1, 0] }},
            {{ "point": [0, 15, 0], "vector": [1, 0, 0] }}, {{ "point": [0, 35, 0], "vector": [1, 0, 0] }}] }} }}"#
        ))
    };
    // A contact in a crossing lifts; only the last move, up, does not.
    let exits: Vec<String> =
        planned(&corner("")).program.text.lines().filter(|l| l.contains("tp_exit> call")).map(str::to_owned).collect();
    let blocked: Vec<bool> = exits.iter().map(|l| l.ends_with("[0]")).collect();
    assert_eq!(blocked.iter().filter(|b| **b).count(), 1, "{exits:?}");
    assert_eq!(blocked.last(), Some(&true));
    assert_eq!(errors(&corner(r#", "feedDistance": 0"#)), [""; 0]);
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
        let ranges = |job: &Value| check(job).iter().filter(|f| f.code == "out-of-range" || f.code == "unusual").count();
        let before = ranges(&asked);
        assert_eq!(ranges(&convert_units(&asked, "inch").unwrap()), before, "{kind} {path}");
    }
}

#[test]
fn chords_around_a_stud_stay_clear_of_it() {
    let job =
        cycle(r#"{ "type": "probing-two-circles", "geometryType": 1, "clearanceHeightMode": 1, "probe": { "setUp": 0.012 } }"#);
    let text = planned(&job).program.text;
    let mut at = [f64::NAN; 3];
    let mut nearest = f64::INFINITY;
    for line in text.lines().filter(|l| l.starts_with("G38") || l.starts_with("G0") || l.starts_with("G1 ")) {
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
        assert!(warnings(&job).contains(&"positioning-not-watched".to_owned()), "{post}");
        assert!(!warnings(&with(&job, "control.protection", text("checked"))).contains(&"positioning-not-watched".to_owned()));
    }
}

#[test]
fn a_lift_is_made_before_the_program_aborts() {
    // ABORT throws away what LinuxCNC has read and not yet moved; M66 waits for it.
    let text = planned(&default_job("hole").unwrap()).program.text;
    let lines: Vec<&str> = text.lines().collect();
    let aborts: Vec<usize> = (0..lines.len()).filter(|i| lines[*i].starts_with("(ABORT,Contact")).collect();
    assert_eq!(aborts.len(), 1);
    assert_eq!(lines[aborts[0] - 1], "M66 E0 L0");
    assert!(lines[..aborts[0] - 1].iter().any(|l| l.starts_with("G1 Z") && l.contains('F')));
}

#[test]
fn an_iso_block_may_end_and_begin_without_a_space() {
    let iso = "%X G70*\nN10 T5 G18*\nN20G1411 Q1100=+0 Q1101=+0 Q1102=-1 Q1116=+1 Q1103=+2 Q1104=+0 Q1105=-1 Q1117=+1*\n";
    let read = import(iso).unwrap();
    let at = |path: &str| path.split('.').try_fold(&read.job, |v, key| v.get(key)).cloned();
    assert_eq!(at("units"), Some(text("inch")));
    assert_eq!(at("plane"), Some(text("G18")));
    assert_eq!(at("control.tool"), Some(Value::Number(5.0)));
    assert_eq!(at("cycle.diameter2"), Some(Value::Number(1.0)));
}

#[test]
fn a_program_high_above_the_table_is_read_with_the_stylus_above_it() {
    let high = with(&default_job("probing-two-circles").unwrap(), "cycle.point1", point([-30.0, 0.0, 140.0]));
    let high = with(&with(&high, "cycle.point2", point([30.0, 0.0, 140.0])), "cycle.clearanceHeight", number(200.0));
    let high = with(&high, "cycle.start", point([0.0, 0.0, 300.0]));
    let text = planned(&high).program.text;
    let read = import(&text).unwrap().job;
    assert_eq!(errors(&read), [""; 0]);
    assert_eq!(planned(&read).program.text.lines().filter(|l| !l.contains("taken to be at")).count() + 1, text.lines().count());
    // With PREDEF the clearance height is not known: the stylus is taken above the touches all the same.
    let predef = import(&text.replace("Q260=+200", "Q260=PREDEF")).unwrap().job;
    assert_eq!(errors(&predef), [""; 0]);
}
