//! Values that a portal's config fills in or refuses, and its checks of the path: against hand calculations.

use crate::common::{job, values};
use touchpath::config::Config;
use touchpath::form::{Finding, Level, Value};
use touchpath::job::{plan, planned};

fn config(rest: &str) -> Config {
    Config::read(&job(&format!(r#"{{ "format": 1, {rest} }}"#))).expect("a good config")
}

/// Code and path of every refusal.
fn refused(config: &Config, text: &str) -> Vec<String> {
    let judged = config.judge(&config.fill(&job(text)));
    judged
        .iter()
        .filter(|f| f.level == Level::Error)
        .map(|f| format!("{} {}", f.code, f.path))
        .collect()
}

fn at<'v>(job: &'v Value, path: &str) -> Option<&'v Value> {
    path.split('.').try_fold(job, |place, key| place.get(key))
}

fn number(job: &Value, path: &str) -> f64 {
    match at(job, path) {
        Some(Value::Number(x)) => *x,
        other => panic!("{path}: {other:?}"),
    }
}

fn text(job: &Value, path: &str) -> String {
    match at(job, path) {
        Some(Value::Text(text)) => text.clone(),
        other => panic!("{path}: {other:?}"),
    }
}

#[test]
fn what_a_job_leaves_out_is_filled_in_and_converted() {
    let rules = config(
        r#""fields": { "feeds.work": { "value": 127 }, "stylus.diameter": { "value": 5.08 }, "control.tool": { "value": 99 },
            "cycle.depth": { "value": 12.7 }, "cycle.width": { "value": 25.4 }, "limits.position": { "value": null } }"#,
    );
    let filled = rules.fill(&job(
        r#"{ "format": 1, "units": "inch", "cycle": { "type": "groove", "depth": 0.25 }, "feeds": { "return": null } }"#,
    ));
    assert_eq!(number(&filled, "feeds.work"), 5.0);
    assert_eq!(number(&filled, "stylus.diameter"), 0.2);
    assert_eq!(number(&filled, "control.tool"), 99.0);
    assert_eq!(number(&filled, "cycle.width"), 1.0);
    assert_eq!(
        number(&filled, "cycle.depth"),
        0.25,
        "what the job says stays"
    );
    assert_eq!(
        at(&filled, "feeds.return"),
        Some(&Value::Null),
        "null is said"
    );
    assert_eq!(at(&filled, "limits.position"), Some(&Value::Null));
    // A hole has no width.
    let hole = rules.fill(&job(r#"{ "format": 1, "cycle": { "type": "hole" } }"#));
    assert_eq!(
        (number(&hole, "cycle.depth"), at(&hole, "cycle.width")),
        (12.7, None)
    );
    let set_up =
        rules.fill(&job(r#"{ "format": 2, "cycles": [{ "type": "hole" }, { "type": "web", "name": "RIB", "depth": 3 }] }"#));
    let Some(Value::List(cycles)) = set_up.get("cycles") else {
        panic!("the cycles")
    };
    assert_eq!(
        (
            number(&cycles[0], "depth"),
            number(&cycles[1], "depth"),
            number(&cycles[1], "width")
        ),
        (12.7, 3.0, 25.4)
    );
    assert_eq!(
        (number(&set_up, "feeds.work"), set_up.get("cycle")),
        (127.0, None)
    );
    // A config in inch has the same effect in inch.
    let inch = config(
        r#""units": "inch", "fields": { "feeds.work": { "value": 5 }, "cycle.depth": { "value": 0.5 } }"#,
    );
    let mm = inch.fill(&job(r#"{ "format": 1, "cycle": { "type": "hole" } }"#));
    assert_eq!(
        (number(&mm, "feeds.work"), number(&mm, "cycle.depth")),
        (127.0, 12.7)
    );
}

#[test]
fn a_job_that_names_no_control_gets_one_that_is_allowed_and_takes_its_cycle() {
    let rules = config(
        r#""allow": { "controls": ["haas", "heidenhain"], "units": ["inch"], "workOffsets": [2, 3] }"#,
    );
    let hole = rules.fill(&job(
        r#"{ "format": 1, "cycle": { "type": "hole", "diameter": 1 } }"#,
    ));
    assert_eq!(
        (
            text(&hole, "control.post"),
            text(&hole, "units"),
            number(&hole, "control.workOffset")
        ),
        ("haas".into(), "inch".into(), 2.0)
    );
    let circles = rules.fill(&job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles" } }"#,
    ));
    assert_eq!(
        text(&circles, "control.post"),
        "haas",
        "it makes the moves of 1411"
    );
    let only = config(r#""allow": { "controls": ["heidenhain"] }"#);
    let circles = only.fill(&job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles" } }"#,
    ));
    assert_eq!(
        (
            text(&circles, "control.post"),
            text(&circles, "control.form")
        ),
        ("heidenhain".into(), "cycle".into())
    );
    // The default takes precedence over other allowed values.
    let default = config(r#""allow": { "controls": ["haas", "linuxcnc"] }"#);
    assert_eq!(
        text(
            &default.fill(&job(r#"{ "format": 1, "cycle": { "type": "hole" } }"#)),
            "control.post"
        ),
        "linuxcnc"
    );
    // An allowed form is chosen, too: LinuxCNC has no native cycles.
    for allow in [
        r#""forms": ["cycle"]"#,
        r#""forms": ["cycle"], "controls": ["linuxcnc", "haas"]"#,
    ] {
        let rules = config(&format!(r#""allow": {{ {allow} }}"#));
        let hole = r#"{ "format": 1, "cycle": { "type": "hole" } }"#;
        assert_eq!(refused(&rules, hole), [""; 0], "{allow}");
        assert_eq!(text(&rules.fill(&job(hole)), "control.form"), "cycle");
        assert_eq!(
            refused(
                &rules,
                r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "form": "moves" } }"#
            ),
            ["not-allowed control.form"]
        );
    }
}

#[test]
fn what_is_not_allowed_is_refused_where_it_stands() {
    let rules = config(
        r#""title": "Hall 3", "allow": { "cycles": ["hole", "web"], "controls": ["fanuc"], "forms": ["moves"], "units": ["mm"], "workOffsets": [null, 1] }"#,
    );
    assert_eq!(
        refused(
            &rules,
            r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "workOffset": 1 } }"#
        ),
        [""; 0]
    );
    assert_eq!(
        refused(
            &rules,
            r#"{ "format": 1, "units": "inch", "cycle": { "type": "boss" }, "control": { "post": "haas", "form": "cycle", "workOffset": 3 } }"#
        ),
        [
            "not-allowed cycle.type",
            "not-allowed control.post",
            "not-allowed control.form",
            "not-allowed units",
            "not-allowed control.workOffset"
        ]
    );
    let set_up = r#"{ "format": 2, "cycles": [{ "type": "hole" }, { "type": "boss" }, { "type": "groove" }] }"#;
    assert_eq!(
        refused(&rules, set_up),
        ["not-allowed cycles[1].type", "not-allowed cycles[2].type"]
    );
    let one = config(r#""allow": { "setUps": false }"#);
    assert_eq!(refused(&one, set_up), ["not-allowed cycles"]);
    // The words of the form.
    let said =
        rules.judge(&job(r#"{ "format": 1, "cycle": { "type": "boss" }, "control": { "post": "haas", "workOffset": 3 } }"#));
    let said: Vec<&str> = said.iter().map(|f| f.message.as_str()).collect();
    assert_eq!(
        said,
        [
            "Hall 3 does not allow Boss: it allows Hole, Web",
            "Hall 3 does not allow Haas NGC: it allows Fanuc 30i / 0i-F",
            "Hall 3 does not allow G56: it allows measuring only, G54"
        ]
    );
}

#[test]
fn fields_are_fixed_and_bounded_in_any_units() {
    let rules = config(
        r#""fields": { "feeds.work": { "value": 100, "locked": true, "reason": "calibrated" }, "overtravel": { "min": 2, "max": 8 },
            "stylus.diameter": { "min": 1 }, "cycle.origin": { "value": [1, 2, 3], "locked": true }, "stylus.length": { "max": 60 } }"#,
    );
    let base = r#""cycle": { "type": "hole", "diameter": 25, "origin": [1, 2, 3] }, "stylus": { "length": 50 }"#;
    assert_eq!(
        refused(&rules, &format!(r#"{{ "format": 1, {base} }}"#)),
        [""; 0]
    );
    assert_eq!(
        refused(
            &rules,
            &format!(
                r#"{{ "format": 1, {base}, "feeds": {{ "work": 101 }}, "overtravel": 8.1, "stylus": {{ "diameter": 0.9, "length": null }} }}"#
            )
        ),
        [
            "locked feeds.work",
            "not-allowed overtravel",
            "not-allowed stylus.diameter",
            "not-allowed stylus.length"
        ]
    );
    // 8 mm are 0.314961 inch; 100 mm/min are 3.937008 inch/min.
    let inch = |overtravel: f64, feed: f64| {
        format!(
            r#"{{ "format": 1, "units": "inch", "cycle": {{ "type": "hole", "diameter": 1, "origin": [0.03937, 0.07874, 0.11811] }}, "stylus": {{ "length": 2 }}, "overtravel": {overtravel}, "feeds": {{ "work": {feed} }} }}"#
        )
    };
    assert_eq!(refused(&rules, &inch(0.314961, 3.937008)), [""; 0]);
    assert_eq!(
        refused(&rules, &inch(0.314961, 3.937)),
        [""; 0],
        "as people type it"
    );
    assert_eq!(
        refused(&rules, &inch(0.3151, 3.94)),
        ["locked feeds.work", "not-allowed overtravel"]
    );
    let set_up = r#"{ "format": 2, "feeds": { "work": 90 }, "stylus": { "length": 9 }, "cycles": [{ "type": "hole" }, { "type": "hole", "origin": [1, 2, 4] }] }"#;
    assert_eq!(
        refused(&rules, set_up),
        ["locked feeds.work", "locked cycles[1].origin"]
    );
}

/// Null is rapid, no limit or no tool call: outside all bounds.
#[test]
fn null_is_within_no_bounds() {
    let rules = config(
        r#""fields": { "feeds.approach": { "max": 500 }, "control.tool": { "min": 1, "max": 24 }, "limits.position": { "max": 2 } }"#,
    );
    let given = r#"{ "format": 1, "cycle": { "type": "hole" }, "feeds": { "approach": null }, "control": { "tool": null }, "limits": { "position": null } }"#;
    assert_eq!(
        refused(&rules, given),
        [
            "not-allowed control.tool",
            "not-allowed feeds.approach",
            "not-allowed limits.position"
        ]
    );
    let good = r#"{ "format": 1, "cycle": { "type": "hole" }, "feeds": { "approach": 500 }, "control": { "tool": 24 }, "limits": { "position": 2 } }"#;
    assert_eq!(refused(&rules, good), [""; 0]);
}

/// 1411 sets the active preset: its job specifies no work offset.
#[test]
fn a_cycle_that_writes_by_itself_is_measured_by_what_it_writes() {
    let circles = |confirm: u8, transfer: u8| {
        format!(
            r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles", "confirmRotation": {confirm}, "transferPosition": {transfer} }}, "control": {{ "post": "heidenhain", "form": "cycle" }} }}"#
        )
    };
    let measuring = config(r#""allow": { "workOffsets": [null] }"#);
    assert_eq!(
        refused(&measuring, &circles(1, 1)),
        ["not-allowed control.workOffset"]
    );
    assert_eq!(refused(&measuring, &circles(0, 0)), [""; 0]);
    for offsets in ["[1]", "[null, 2]"] {
        let writing = config(&format!(r#""allow": {{ "workOffsets": {offsets} }}"#));
        assert_eq!(refused(&writing, &circles(1, 1)), [""; 0]);
        assert!(
            plan(&writing.fill(&job(&circles(1, 1)))).is_ok(),
            "no work offset was filled in"
        );
    }
}

/// 1493 is a form inside that of 1411: a value in it does not switch it on.
#[test]
fn a_form_inside_the_form_that_is_not_used_stays_so() {
    let rules = config(r#""fields": { "cycle.extrusion.points": { "value": 5, "locked": true } }"#);
    let circles = |extrusion: &str| {
        format!(r#"{{ "format": 1, "cycle": {{ "type": "probing-two-circles"{extrusion} }} }}"#)
    };
    assert_eq!(at(&rules.fill(&job(&circles(""))), "cycle.extrusion"), None);
    assert_eq!(refused(&rules, &circles("")), [""; 0]);
    assert_eq!(refused(&rules, &circles(r#", "extrusion": null"#)), [""; 0]);
    assert_eq!(
        number(
            &rules.fill(&job(&circles(r#", "extrusion": { "length": 3 }"#))),
            "cycle.extrusion.points"
        ),
        5.0
    );
    assert_eq!(
        refused(&rules, &circles(r#", "extrusion": { "points": 4 }"#)),
        ["locked cycle.extrusion.points"]
    );
}

/// A bore of 25 mm at X100 Y50, 10 mm deep, touched with a ball of 6 mm: its centre touches at 9.5 mm from the middle and searches 5 mm farther.
const BORE: &str = r#"{ "format": 1, "cycle": { "type": "hole", "diameter": 25, "depth": 10, "origin": [100, 50, 0], "feedDistance": 20 }"#;

fn bore(rest: &str) -> String {
    format!("{BORE}{rest} }}")
}

#[test]
fn the_searches_of_a_path_stay_within_the_travel() {
    let highest = planned(&job(&bore("")))
        .unwrap()
        .path
        .moves
        .iter()
        .map(|step| step.to.z)
        .fold(f64::MIN, f64::max);
    let travel = |x: f64, low: f64| {
        format!(
            r#""space": {{ "travel": {{ "min": [{}, {}, {low}], "max": [{}, {}, {highest}] }} }}"#,
            100.0 - x,
            50.0 - x,
            100.0 + x,
            50.0 + x
        )
    };
    assert_eq!(refused(&config(&travel(14.5, -10.0)), &bore("")), [""; 0]);
    assert_eq!(
        refused(&config(&travel(14.4, -10.0)), &bore("")),
        ["beyond-travel cycle"; 4]
    );
    assert_eq!(
        refused(&config(&travel(14.5, -9.9)), &bore("")),
        ["beyond-travel cycle"]
    );
    let said = config(&travel(14.4, -10.0)).judge(&job(&bore("")));
    let said = values(&said[0]);
    assert_eq!(
        said[said.len() - 2..],
        ["85.5 mm", "85.6 mm"],
        "the search, and where the travel ends"
    );
    // The same machine with another zero, in inch.
    let moved = r#""units": "inch", "space": { "zero": [10, 0, -20], "travel": { "min": [13.36615, 0, -21], "max": [20, 10, 0] } }"#;
    // 85.5 mm are 3.366142 inch.
    assert_eq!(refused(&config(moved), &bore("")), ["beyond-travel cycle"]);
    assert_eq!(
        refused(&config(&moved.replace("13.36615", "13.36614")), &bore("")),
        [""; 0]
    );
    let set_up = r#"{ "format": 2, "cycles": [{ "type": "hole", "diameter": 25 }, { "type": "hole", "diameter": 25, "origin": [100, 50, 0] }] }"#;
    let narrow = r#""space": { "travel": { "min": [-50, -50, -50], "max": [114, 90, 90] } }"#;
    assert_eq!(
        refused(&config(narrow), set_up),
        ["beyond-travel cycles[1]"]
    );
    // A cycle that follows a result moves at most 2 mm farther: to X 116.5; it does not follow along Y, 64.5.
    let follows = r#"{ "format": 2, "limits": { "position": 2 }, "cycles": [{ "type": "hole", "name": "A", "diameter": 25 },
        { "type": "hole", "diameter": 25, "origin": ["=A.center.x+100", 50, 0] }] }"#;
    let most = |x: f64, y: f64| {
        format!(r#""space": {{ "travel": {{ "min": [-50, -50, -50], "max": [{x}, {y}, 90] }} }}"#)
    };
    assert_eq!(refused(&config(&most(116.5, 64.5)), follows), [""; 0]);
    assert_eq!(
        refused(&config(&most(116.4, 64.5)), follows),
        ["beyond-travel cycles[1]"]
    );
    assert_eq!(
        refused(&config(&most(116.5, 64.4)), follows),
        ["beyond-travel cycles[1]"]
    );
    // The range of a size is known only at the machine: a field with bounds accepts no result.
    let sized = r#"{ "format": 2, "limits": { "size": 1 }, "cycles": [{ "type": "hole", "name": "A", "diameter": 25 },
        { "type": "hole", "diameter": "=A.diameter-2", "origin": [100, 50, 0] }] }"#;
    let bounds = |least: f64| {
        format!(r#""fields": {{ "cycle.diameter": {{ "min": {least}, "max": 60 }} }}"#)
    };
    assert_eq!(
        refused(&config(&bounds(5.0)), sized),
        ["not-allowed cycles[1].diameter"]
    );
    let post = |x: f64| {
        format!(
            r#""space": {{ "keepOut": [{{ "name": "post", "min": [{x}, 40, -20], "max": [200, 60, 20] }}] }}"#
        )
    };
    assert_eq!(
        refused(&config(&post(119.6)), follows),
        [""; 0],
        "the ball reaches 119.5"
    );
    assert_eq!(
        refused(&config(&post(119.4)), follows),
        ["keep-out cycles[1]"]
    );
    // The move away from a cycle that follows starts at its position: at X 100 and up to 5 farther, with a ball of radius 3.
    let leaves = r#"{ "format": 2, "limits": { "position": 5 }, "cycles": [{ "type": "hole", "name": "A", "diameter": 25 },
        { "type": "hole", "diameter": 25, "origin": ["=A.center.x+100", 0, 0] }, { "type": "hole", "diameter": 25, "origin": [100, 100, 0] }] }"#;
    let beside = |x: f64| {
        format!(
            r#""space": {{ "keepOut": [{{ "name": "post", "min": [{x}, 30, -50], "max": [200, 31, 90] }}] }}"#
        )
    };
    assert_eq!(refused(&config(&beside(108.1)), leaves), [""; 0]);
    assert_eq!(
        refused(&config(&beside(106.0)), leaves),
        ["keep-out cycles[2]"]
    );
}

#[test]
fn nothing_of_the_probe_enters_a_keep_out_zone() {
    let zone = |min: [f64; 3], max: [f64; 3]| {
        config(&format!(
            r#""space": {{ "keepOut": [{{ "name": "vise", "min": {min:?}, "max": {max:?} }}] }}"#
        ))
    };
    let far = [200.0, 60.0, 20.0];
    // The ball's far side reaches 100 + 9.5 + 5 + 3.
    assert_eq!(
        refused(&zone([117.4, 40.0, -20.0], far), &bore("")),
        ["keep-out cycle"]
    );
    assert_eq!(
        refused(&zone([117.6, 40.0, -20.0], far), &bore("")),
        [""; 0]
    );
    // Beside the path: the ball at Y 50 passes a corner at 2.9 mm, and not at 3.1.
    assert_eq!(
        refused(&zone([110.0, 52.9, -20.0], far), &bore("")),
        ["keep-out cycle"]
    );
    assert_eq!(
        refused(&zone([110.0, 53.1, -20.0], [200.0, 60.0, 20.0]), &bore("")),
        [""; 0]
    );
    // Below the ball: its lower side is at -13.
    assert_eq!(
        refused(&zone([90.0, 40.0, -50.0], [110.0, 60.0, -12.9]), &bore("")),
        ["keep-out cycle"]
    );
    assert_eq!(
        refused(&zone([90.0, 40.0, -50.0], [110.0, 60.0, -13.1]), &bore("")),
        [""; 0]
    );
    // A clamp over the bore's edge, 40 mm above it and from X 118 on: a body of 40 mm reaches X 134.5 with its lower end at -10 + 50.
    let clamp = || zone([118.0, 40.0, 39.0], [200.0, 60.0, 41.0]);
    assert_eq!(
        refused(&clamp(), &bore("")),
        [""; 0],
        "of a stylus that is not known only the ball"
    );
    assert_eq!(
        refused(
            &clamp(),
            &bore(r#", "stylus": { "length": 50, "shank": 4, "body": 40 }"#)
        ),
        ["keep-out cycle"]
    );
    let message = &clamp().judge(&job(&bore(
        r#", "stylus": { "length": 50, "shank": 4, "body": 40 }"#,
    )))[0]
        .message;
    assert!(
        message.ends_with("the probe body enters the keep-out zone vise"),
        "{message}"
    );
    // A longer stylus clears it.
    let highest = zone([118.0, 40.0, -5.0], [200.0, 60.0, 41.0]);
    assert_eq!(
        refused(
            &highest,
            &bore(r#", "stylus": { "length": 51.1, "shank": 4, "body": 40 }"#)
        ),
        [""; 0]
    );
    assert_eq!(
        refused(
            &highest,
            &bore(r#", "stylus": { "length": 50.9, "shank": 4, "body": 40 }"#)
        ),
        ["keep-out cycle"]
    );
    // A shank of 8 mm reaches 118.5 where the ball reaches 117.5.
    let post = || zone([118.0, 40.0, 5.0], [200.0, 60.0, 41.0]);
    assert_eq!(
        refused(
            &post(),
            &bore(r#", "stylus": { "length": 52, "shank": 6, "body": 40 }"#)
        ),
        [""; 0]
    );
    let thick = &post().judge(&job(&bore(
        r#", "stylus": { "length": 52, "shank": 8, "body": 40 }"#,
    )))[0]
        .message;
    assert!(
        thick.ends_with("the stylus enters the keep-out zone vise"),
        "{thick}"
    );
}

#[test]
fn a_plan_holds_what_the_portal_says() {
    let info =
        config(r#""findings": [{ "level": "info", "path": "stylus", "message": "Use probe 7" }]"#);
    let said = |findings: &[Finding]| {
        findings
            .iter()
            .filter(|f| f.code == "portal")
            .map(|f| f.message.clone())
            .collect::<Vec<_>>()
    };
    let made = info
        .plan(&job(r#"{ "format": 1, "cycle": { "type": "hole" } }"#))
        .unwrap();
    assert_eq!(said(&made.findings), ["Use probe 7"]);
    let plain = plan(&job(r#"{ "format": 1, "cycle": { "type": "hole" } }"#)).unwrap();
    assert_eq!(
        made.program.text, plain.program.text,
        "a config that only speaks changes no program"
    );
    let error = config(r#""findings": [{ "message": "The order is closed" }]"#);
    let refused = error
        .plan(&job(r#"{ "format": 1, "cycle": { "type": "hole" } }"#))
        .unwrap_err();
    assert_eq!(said(&refused.findings), ["The order is closed"]);
    // Errors of the job and refusals of the portal are reported together.
    let both = error
        .plan(&job(
            r#"{ "format": 1, "cycle": { "type": "hole", "diameter": -1 } }"#,
        ))
        .unwrap_err();
    assert!(
        both.findings.iter().any(|f| f.path == "cycle.diameter") && said(&both.findings).len() == 1
    );
}

#[test]
fn everything_wrong_with_a_config_is_said_at_once() {
    let wrong = |text: &str| -> Vec<String> {
        let error = Config::read(&job(text)).expect_err(text);
        error
            .findings
            .iter()
            .map(|f| format!("{} {}", f.code, f.path))
            .collect()
    };
    assert_eq!(
        wrong(
            r#"{ "format": 2, "titel": "x", "allow": { "cycles": ["hole", "well"], "controls": 5, "workOffsets": [0], "setUps": 1 },
                "fields": { "feeds.wrk": {}, "feeds.work": { "value": 0 }, "cycle.depth": { "value": "deep" }, "stylus.diameter": { "min": 5, "max": 4 },
                    "name": { "max": 5 }, "control.post": { "locked": true } },
                "machines": [{ "stylus": { "diameter": "x" } }], "styli": [{ "name": "A", "diametre": 4 }],
                "space": { "travel": { "min": [0, 0, 0] }, "keepOut": [{ "min": [1, 0, 0], "max": [0, 0, 0] }] },
                "findings": [{ "level": "fatal" }] }"#
        ),
        [
            "unknown-value config.format",
            "unknown-key config.titel",
            "wrong-type config.allow.setUps",
            "unknown-value config.allow.cycles[1]",
            "wrong-type config.allow.controls",
            "unknown-value config.allow.workOffsets[0]",
            "unknown-key config.fields.control.post",
            "unknown-key config.fields.feeds.wrk",
            "wrong-type config.fields.name",
            "out-of-range config.fields.stylus.diameter",
            "missing config.machines[0].name",
            "wrong-type config.machines[0].stylus.diameter",
            "unknown-key config.styli[0].diametre",
            "missing config.space.travel.max",
            "missing config.space.keepOut[0].name",
            "out-of-range config.space.keepOut[0]",
            "unknown-value config.findings[0].level",
            "missing config.findings[0].message",
            "wrong-type config.fields.cycle.depth.value",
            "out-of-range config.fields.feeds.work.value",
        ]
    );
    // A config that would refuse a job without values.
    for (text, path) in [
        (
            r#""fields": { "overtravel": { "value": 50, "min": 2, "max": 8 } }"#,
            "out-of-range config.fields.overtravel.value",
        ),
        (
            r#""fields": { "units": { "value": "inch" } }"#,
            "unknown-key config.fields.units",
        ),
        (
            r#""allow": { "controls": ["haas"] }, "fields": { "control.post": { "value": "fanuc" } }"#,
            "not-allowed config.fields.control.post.value",
        ),
        (
            r#""allow": { "workOffsets": [1] }, "fields": { "control.workOffset": { "value": 7 } }"#,
            "not-allowed config.fields.control.workOffset.value",
        ),
        (
            r#""allow": { "controls": ["haas"] }, "machines": [{ "name": "A", "control": { "post": "fanuc" } }]"#,
            "not-allowed config.machines[0].control.post",
        ),
        (
            r#""allow": { "workOffsets": [] }"#,
            "missing config.allow.workOffsets",
        ),
    ] {
        assert_eq!(wrong(&format!(r#"{{ "format": 1, {text} }}"#)), [path]);
    }
    for text in ["[]", "5", "null", r#""x""#] {
        assert_eq!(wrong(text).len(), 1, "{text}");
    }
}

/// Invalid values at every position of a valid config.
#[test]
fn no_config_and_no_job_under_it_panics() {
    let good = job(
        r#"{ "format": 1, "title": "A", "units": "mm", "allow": { "cycles": ["hole"], "controls": ["haas"], "forms": ["moves"], "units": ["mm"], "workOffsets": [1], "setUps": false },
            "hide": { "cycles": ["web"], "controls": [], "panels": ["table"] }, "fields": { "feeds.work": { "value": 1, "locked": true, "hidden": false, "min": 1, "max": 5, "reason": "r" } },
            "machines": [{ "name": "M", "stylus": { "diameter": 4 } }], "styli": [{ "name": "S", "diameter": 4 }],
            "space": { "zero": [0, 0, 0], "travel": { "min": [0, 0, 0], "max": [1, 1, 1] }, "keepOut": [{ "name": "K", "min": [0, 0, 0], "max": [1, 1, 1] }] },
            "findings": [{ "level": "info", "path": "p", "message": "m" }] }"#,
    );
    Config::read(&good).expect("a good config");
    let odd = [
        Value::Null,
        Value::Flag(true),
        Value::Number(f64::NAN),
        Value::Number(1e300),
        Value::Number(-0.5),
        Value::Text("é\u{0}".repeat(300)),
        Value::Text(String::new()),
        Value::List(vec![Value::Null; 300]),
        Value::Map(vec![("a\u{301}.b".to_owned(), Value::Null)]),
        Value::Other("a function"),
    ];
    let mut taken = 0;
    for change in changes(&good, &odd) {
        let Ok(config) = Config::read(&change) else {
            continue;
        };
        taken += 1;
        for text in [
            r#"{ "format": 1, "cycle": { "type": "hole" } }"#,
            "[]",
            r#"{ "format": 2, "cycles": [{ "type": "hole" }, 5] }"#,
        ] {
            let _ = config.check(&job(text));
        }
        odd.iter().for_each(|job| {
            let _ = config.check(job);
        });
    }
    assert!(taken > 5, "some of them are good: {taken}");
}

/// A value with one of its parts changed: every part and every change.
fn changes(value: &Value, odd: &[Value]) -> Vec<Value> {
    let mut all = odd.to_vec();
    match value {
        Value::Map(entries) => {
            for (i, (_, inner)) in entries.iter().enumerate() {
                all.extend(changes(inner, odd).into_iter().map(|change| {
                    let mut entries = entries.clone();
                    entries[i].1 = change;
                    Value::Map(entries)
                }));
            }
        }
        Value::List(items) => {
            for (i, inner) in items.iter().enumerate() {
                all.extend(changes(inner, odd).into_iter().map(|change| {
                    let mut items = items.clone();
                    items[i] = change;
                    Value::List(items)
                }));
            }
        }
        _ => {}
    }
    all
}
