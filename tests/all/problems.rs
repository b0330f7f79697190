//! Every problem that a job can have, by code and path, and all of them together.

use crate::common::{job, number, point, values, with};
use crate::tests::controls::unpointed;
use touchpath::form::{Finding, Level, Value};
use touchpath::job::{Units, check, default_job, new_job, plan};
use touchpath::path::FeatureKind;

fn pocket() -> Value {
    default_job("internal-rectangle-protected").unwrap()
}

fn corner() -> Value {
    default_job("double-wall-internal-corner").unwrap()
}

fn text(t: &str) -> Value {
    Value::Text(t.to_owned())
}

/// The findings of one level as "code path".
fn found(job: &Value, level: Level) -> Vec<String> {
    check(job)
        .iter()
        .filter(|f| f.level == level)
        .map(|f| format!("{} {}", f.code, f.path))
        .collect()
}

#[test]
fn default_jobs_are_without_any_finding() {
    for cycle in touchpath::cycle::CYCLES {
        let job = default_job(cycle.key).unwrap();
        // Cycles without motion state it.
        let still = matches!(cycle.probes, FeatureKind::Switch | FeatureKind::Action);
        assert_eq!(
            found(&job, Level::Warning),
            vec!["nothing-switched cycle"; usize::from(still)],
            "{}",
            cycle.key
        );
        // No job states the stylus above the ball by default.
        let others = check(&job)
            .into_iter()
            .filter(|f| f.code != "stylus-not-known");
        assert_eq!(others.count(), usize::from(still), "{}", cycle.key);
        plan(&job).unwrap();
    }
    assert!(default_job("bogus").is_none());
}

#[test]
fn new_jobs_in_inch_are_sound_and_say_what_inch_users_type() {
    for cycle in touchpath::cycle::CYCLES {
        let job = new_job(cycle.key, Units::Inch).unwrap();
        let mm = new_job(cycle.key, Units::Mm).unwrap();
        assert_eq!(mm, default_job(cycle.key).unwrap());
        let codes = |job: &Value| check(job).into_iter().map(|f| f.code).collect::<Vec<_>>();
        assert_eq!(codes(&job), codes(&mm), "{}", cycle.key);
        // No number needs more than three digits, for any size.
        fn numbers(value: &Value, seen: &mut Vec<f64>) {
            match value {
                Value::Number(x) => seen.push(*x),
                Value::List(items) => items.iter().for_each(|x| numbers(x, seen)),
                Value::Map(map) => map.iter().for_each(|(_, x)| numbers(x, seen)),
                _ => {}
            }
        }
        let mut seen = Vec::new();
        numbers(&job, &mut seen);
        assert!(seen.len() > 20, "{}", cycle.key);
        for x in seen {
            let digits = format!("{x:e}")
                .split('e')
                .next()
                .unwrap()
                .replace(['-', '.'], "")
                .len();
            assert!(digits <= 3, "{}: {x}", cycle.key);
        }
    }
    // Typical input on the shop floor, from users' reports.
    let corner = new_job("double-wall-internal-corner", Units::Inch).unwrap();
    for (path, typed) in [
        ("cycle.clearance1", 0.6),
        ("cycle.step1", 0.8),
        ("feeds.longLink", 40.0),
        ("stylus.diameter", 0.236),
        ("stylus.repeatability", 0.000_05),
        ("overtravel", 0.2),
    ] {
        let found = path
            .split('.')
            .fold(&corner, |value, key| value.get(key).unwrap());
        assert_eq!(found, &number(typed), "{path}");
    }
    assert_eq!(corner.get("units"), Some(&text("inch")));
}

#[test]
fn each_problem_is_found_where_it_is() {
    let cases: &[(Value, &str)] = &[
        // The job itself.
        (number(3.0), "wrong-type "),
        (Value::Null, "wrong-type "),
        (
            with(&pocket(), "format", number(3.0)),
            "newer-format format",
        ),
        (
            with(&pocket(), "format", number(0.0)),
            "unknown-value format",
        ),
        (with(&pocket(), "format", text("1")), "unknown-value format"),
        (
            job(r#"{ "cycle": { "type": "internal-rectangle-protected" } }"#),
            "missing format",
        ),
        (job(r#"{ "format": 1 }"#), "missing cycle"),
        (job(r#"{ "format": 1, "cycle": {} }"#), "missing cycle.type"),
        (job(r#"{ "format": 1, "cycle": 7 }"#), "wrong-type cycle"),
        (
            with(&pocket(), "cycle.type", text("pocket")),
            "unknown-value cycle.type",
        ),
        (
            with(&pocket(), "cycle.type", number(7.0)),
            "wrong-type cycle.type",
        ),
        // Unknown keys, at every level.
        (with(&pocket(), "speed", number(1.0)), "unknown-key speed"),
        (
            with(&pocket(), "stylus.lenght", number(1.0)),
            "unknown-key stylus.lenght",
        ),
        (
            with(&pocket(), "cycle.angle", number(1.0)),
            "unknown-key cycle.angle",
        ),
        (
            with(&pocket(), "part.sizes.depth", number(1.0)),
            "unknown-key part.sizes.depth",
        ),
        // Wrong types.
        (with(&pocket(), "stylus", number(6.0)), "wrong-type stylus"),
        (
            with(&pocket(), "stylus.diameter", text("6")),
            "wrong-type stylus.diameter",
        ),
        (
            with(&pocket(), "stylus.diameter", Value::Null),
            "wrong-type stylus.diameter",
        ),
        (
            with(&pocket(), "cycle.compensateDimensions", number(1.0)),
            "wrong-type cycle.compensateDimensions",
        ),
        (
            with(&pocket(), "cycle.origin", number(1.0)),
            "wrong-type cycle.origin",
        ),
        (
            with(&pocket(), "cycle.origin", Value::List(vec![number(1.0)])),
            "wrong-type cycle.origin",
        ),
        (
            with(
                &pocket(),
                "cycle.origin",
                Value::List(vec![number(1.0), text("2"), number(3.0)]),
            ),
            "wrong-type cycle.origin[1]",
        ),
        (with(&pocket(), "name", number(1.0)), "wrong-type name"),
        (
            with(&pocket(), "name", text(&"x".repeat(201))),
            "too-long name",
        ),
        (
            with(&pocket(), "part.sizes", number(1.0)),
            "wrong-type part.sizes",
        ),
        // Words.
        (with(&pocket(), "units", text("cm")), "unknown-value units"),
        (with(&pocket(), "plane", text("G20")), "unknown-value plane"),
        (
            with(&pocket(), "control.post", text("mazatrol")),
            "unknown-value control.post",
        ),
        // Invalid numbers.
        (
            with(&pocket(), "cycle.width1", number(f64::NAN)),
            "not-finite cycle.width1",
        ),
        (
            with(&pocket(), "cycle.width1", number(f64::INFINITY)),
            "not-finite cycle.width1",
        ),
        (
            with(&pocket(), "cycle.width1", number(1e300)),
            "out-of-range cycle.width1",
        ),
        (
            with(&pocket(), "cycle.origin", point([0.0, -1e300, 0.0])),
            "out-of-range cycle.origin[1]",
        ),
        (
            with(&pocket(), "cycle.subCode", number(1.5)),
            "not-whole cycle.subCode",
        ),
        // Ranges.
        (
            with(&pocket(), "cycle.depth", number(0.0)),
            "out-of-range cycle.depth",
        ),
        (
            with(&pocket(), "cycle.depth", number(-1.0)),
            "out-of-range cycle.depth",
        ),
        (
            with(&pocket(), "cycle.feedDistance", number(-1.0)),
            "out-of-range cycle.feedDistance",
        ),
        (
            with(&pocket(), "feeds.work", number(0.0)),
            "out-of-range feeds.work",
        ),
        (
            with(&pocket(), "feeds.work", Value::Null),
            "wrong-type feeds.work",
        ),
        (
            with(&pocket(), "feeds.longLink", number(-5.0)),
            "out-of-range feeds.longLink",
        ),
        (
            with(&pocket(), "overtravel", number(0.0)),
            "out-of-range overtravel",
        ),
        (
            with(&pocket(), "stylus.diameter", number(-1.0)),
            "out-of-range stylus.diameter",
        ),
        (
            with(&pocket(), "stylus.repeatability", number(-1.0)),
            "out-of-range stylus.repeatability",
        ),
        (
            with(&corner(), "cycle.count1", number(0.0)),
            "out-of-range cycle.count1",
        ),
        (
            with(&corner(), "cycle.count2", number(16.0)),
            "out-of-range cycle.count2",
        ),
        (
            with(&corner(), "cycle.step1", number(0.0)),
            "out-of-range cycle.step1",
        ),
        (
            with(&corner(), "cycle.angle", number(19.9)),
            "out-of-range cycle.angle",
        ),
        (
            with(&corner(), "cycle.angle", number(160.1)),
            "out-of-range cycle.angle",
        ),
        (
            with(&pocket(), "part.sizes.width1", number(-80.0)),
            "out-of-range part.sizes.width1",
        ),
        // Dimensions that do not fit together. Ball diameter 6 by default.
        (
            with(&pocket(), "cycle.sideClearance1", number(3.0)),
            "clearance-too-small cycle.sideClearance1",
        ),
        (
            with(&pocket(), "cycle.sideClearance2", number(2.0)),
            "clearance-too-small cycle.sideClearance2",
        ),
        (
            with(&corner(), "cycle.clearance1", number(3.0)),
            "clearance-too-small cycle.clearance1",
        ),
        (
            with(&corner(), "cycle.clearance2", number(1.0)),
            "clearance-too-small cycle.clearance2",
        ),
        (
            with(&pocket(), "cycle.width1", number(6.0)),
            "ball-too-wide cycle.width1",
        ),
        (
            with(&pocket(), "cycle.width2", number(5.0)),
            "ball-too-wide cycle.width2",
        ),
        (
            with(&pocket(), "cycle.sideClearance1", number(77.0)),
            "approach-beyond-wall cycle.sideClearance1",
        ),
        (
            with(&pocket(), "cycle.sideClearance2", number(60.0)),
            "approach-beyond-wall cycle.sideClearance2",
        ),
        // 15 + 15·cos 160° = 0.9 is the projection; 15 + 12·cos 160° = 3.72 > 3 is free, 4 + 12·cos … is not.
        (
            with(
                &with(&corner(), "cycle.angle", number(160.0)),
                "cycle.clearance2",
                number(14.0),
            ),
            "touch-beyond-corner cycle.clearance2",
        ),
        (
            with(
                &with(&corner(), "cycle.angle", number(120.0)),
                "cycle.clearance1",
                number(7.0),
            ),
            "touch-beyond-corner cycle.clearance1",
        ),
        // 8 + 9 touches are one too many.
        (
            with(
                &with(&corner(), "cycle.count1", number(8.0)),
                "cycle.count2",
                number(9.0),
            ),
            "too-many-touches cycle.count2",
        ),
        // Controls.
        (
            with(&pocket(), "control.form", text("cycle")),
            "form-unsupported control.form",
        ),
        (
            with(&pocket(), "control.workOffset", number(0.0)),
            "out-of-range control.workOffset",
        ),
        (
            with(&pocket(), "control.workOffset", number(10.0)),
            "work-offset-unsupported control.workOffset",
        ),
        (
            with(
                &with(&pocket(), "control.post", text("grbl")),
                "control.workOffset",
                number(1.0),
            ),
            "work-offset-unsupported control.workOffset",
        ),
    ];
    for (job, wanted) in cases {
        let errors = found(job, Level::Error);
        assert!(errors.iter().any(|e| e == wanted), "{wanted}: {errors:?}");
        let error = plan(job).expect_err(wanted);
        assert_eq!(error.findings, check(job), "{wanted}");
        assert!(check(job).iter().all(|f| !f.message.is_empty()));
    }
}

#[test]
fn one_problem_is_one_error() {
    for (job, wanted) in [
        (
            with(&pocket(), "cycle.sideClearance1", number(3.0)),
            "clearance-too-small cycle.sideClearance1",
        ),
        (
            with(&pocket(), "cycle.width1", number(5.0)),
            "ball-too-wide cycle.width1",
        ),
        (
            with(&pocket(), "cycle.width1", text("x")),
            "wrong-type cycle.width1",
        ),
        (
            with(&pocket(), "stylus.diameter", number(f64::NAN)),
            "not-finite stylus.diameter",
        ),
        (
            with(&corner(), "cycle.angle", number(0.0)),
            "out-of-range cycle.angle",
        ),
    ] {
        assert_eq!(found(&job, Level::Error), [wanted]);
    }
}

#[test]
fn all_problems_come_at_once() {
    let mut job = with(&pocket(), "stylus.diameter", text("6"));
    job = with(&job, "bogus", number(1.0));
    job = with(&job, "cycle.depth", number(-1.0));
    job = with(&job, "feeds.work", Value::Null);
    job = with(&job, "control.post", text("mazatrol"));
    job = with(&job, "cycle.width2", number(1e9));
    job = with(&job, "part.rotation", number(f64::NAN));
    let mut errors = found(&job, Level::Error);
    errors.sort();
    assert_eq!(
        errors,
        [
            "not-finite part.rotation",
            "out-of-range cycle.depth",
            "out-of-range cycle.width2",
            "unknown-key bogus",
            "unknown-value control.post",
            "wrong-type feeds.work",
            "wrong-type stylus.diameter",
        ]
    );
}

#[test]
fn unusual_values_and_near_misses_are_warnings() {
    let warned = |job: &Value| found(job, Level::Warning);
    assert_eq!(
        warned(&with(&pocket(), "overtravel", number(80.0))),
        ["unusual overtravel"]
    );
    assert_eq!(
        warned(&with(&pocket(), "feeds.work", number(4000.0))),
        ["unusual feeds.work"]
    );
    assert_eq!(
        warned(&with(&pocket(), "cycle.depth", number(2.0))),
        ["touch-near-edge cycle.depth"]
    );
    assert_eq!(
        warned(&with(&pocket(), "cycle.topClearance", number(3.0))),
        ["low-crossing cycle.topClearance"]
    );
    // 6 mm further away than nominal, with 5 mm of overtravel: no contact on that wall.
    let job = with(
        &with(&pocket(), "part.sizes.width1", number(12.0)),
        "control.workOffset",
        number(1.0),
    );
    assert_eq!(warned(&job), ["no-contact part", "no-contact part"]);
    let plan = plan(&job).unwrap();
    let value = |code: &str| plan.results.iter().find(|r| r.code == code).unwrap().value;
    assert_eq!(
        (value("center.x"), value("width1"), value("offset.x")),
        (None, None, None)
    );
    assert_eq!(
        (value("center.y"), value("width2")),
        (Some(0.0), Some(50.0))
    );
}

#[test]
fn a_count_above_what_the_table_holds_says_why() {
    let findings = check(&with(
        &with(&corner(), "cycle.count1", number(9.0)),
        "cycle.count2",
        number(8.0),
    ));
    let finding: &Finding = findings
        .iter()
        .find(|f| f.code == "too-many-touches")
        .unwrap();
    // 17 are given, and there is room for 16: the 17th would start at -100 - 6 · 16.
    assert_eq!(values(finding), ["17", "16", "17", "-196"]);
    assert_eq!(
        found(
            &with(
                &with(&corner(), "cycle.count1", number(8.0)),
                "cycle.count2",
                number(8.0)
            ),
            Level::Error
        ),
        [""; 0]
    );
}

#[test]
fn messages_speak_in_the_jobs_units() {
    let job = with(
        &with(&pocket(), "units", text("inch")),
        "cycle.sideClearance1",
        number(0.1),
    );
    let job = with(&job, "stylus.diameter", number(0.25));
    let finding = check(&job)
        .into_iter()
        .find(|f| f.code == "clearance-too-small")
        .unwrap();
    assert_eq!(values(&finding)[..2], ["0.1 inch", "0.125 inch"]);
}

#[test]
fn a_hostile_name_stays_inside_its_comment() {
    for name in [
        "A)\nG0 Z-100",
        "(PRINT,#5061",
        "x\r\nM3",
        "%\nO1",
        ")G0X0(",
        "\u{2028}G0",
        "é;#<x>=1",
    ] {
        for post in unpointed() {
            let (begin, end) = touchpath::control::find(post).unwrap().dialect.comment;
            let job = with(
                &with(&pocket(), "name", text(name)),
                "control.post",
                text(post),
            );
            let hostile = plan(&job).unwrap();
            let plain = plan(&with(&job, "name", text("x"))).unwrap();
            let rest = |text: &str| text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
            assert_eq!(
                rest(&hostile.program.text),
                rest(&plain.program.text),
                "only the first line may differ"
            );
            let first = hostile.program.text.lines().next().unwrap();
            assert!(
                first.starts_with(&format!("{begin}Job: ")) && first.ends_with(end),
                "{post}: {first}"
            );
            for mark in [begin.trim(), end]
                .into_iter()
                .filter(|mark| !mark.is_empty())
            {
                assert_eq!(first.matches(mark).count(), 1, "{post}: {first}");
            }
            assert!(found(&job, Level::Info).contains(&"name-changed name".to_owned()));
        }
    }
}

#[test]
fn missing_values_are_the_catalogs_defaults_and_keep_their_size_in_inch() {
    let short = plan(&job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected" } }"#,
    ))
    .unwrap();
    let long = plan(&pocket()).unwrap();
    assert_eq!(
        short
            .program
            .text
            .replace("Job: PROBE", "Job: POCKET-80X50"),
        long.program.text,
        "but for its name"
    );
    let inch = plan(&job(
        r#"{ "format": 1, "units": "inch", "cycle": { "type": "internal-rectangle-protected" } }"#,
    ))
    .unwrap();
    assert!((inch.touches[0].point[0] * 25.4 - 40.0).abs() < 1e-9);
    assert!(inch.program.text.contains("G20"));
}

#[test]
fn what_is_said_goes_out_as_its_template_and_its_values() {
    let job = serde_json::json!({ "format": 1, "overtravel": -1, "cycle": { "type": "hole", "depth": [] } });
    let found = serde_json::to_value(touchpath::job::check(&Value::from(&job))).unwrap();
    let said = |path: &str| {
        found
            .as_array()
            .unwrap()
            .iter()
            .find(|f| f["path"] == path)
            .unwrap()["said"]
            .clone()
    };
    let range = serde_json::json!(["from {min} to {max}{unit}", "0.01", "1000", " mm"]);
    assert_eq!(
        said("overtravel"),
        serde_json::json!(["{label} must be {allowed}", ["Overtravel"], range])
    );
    assert_eq!(
        said("cycle.depth"),
        serde_json::json!([
            "{label} must be a number, not {given}",
            ["Depth"],
            ["a list"]
        ])
    );
}

/// A finding at the control's name holds for every job: it appears with every cycle of a control and form, or with none that moves.
#[test]
fn standing_findings_hold_for_every_job_of_a_control() {
    use std::collections::BTreeMap;
    let mut held = 0;
    for post in touchpath::control::POSTS {
        for form in ["moves", "cycle"] {
            let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
            let mut jobs = 0;
            for cycle in touchpath::cycle::CYCLES
                .iter()
                .filter(|cycle| !cycle.steps.is_empty() && cycle.key != "probing-two-circles")
            {
                let job = with(
                    &with(
                        &default_job(cycle.key).unwrap(),
                        "control.post",
                        text(post.key),
                    ),
                    "control.form",
                    text(form),
                );
                let Ok(plan) = plan(&job) else { continue };
                jobs += 1;
                for code in touchpath::form::STANDING {
                    *counts.entry(code).or_default() +=
                        plan.findings.iter().filter(|f| f.code == *code).count();
                }
            }
            for (code, count) in counts.into_iter().filter(|(_, count)| *count > 0) {
                assert_eq!(
                    count, jobs,
                    "{} {form}: {code} comes with some cycles only",
                    post.key
                );
                held += 1;
            }
        }
    }
    assert!(held > 20, "{held}");
}
