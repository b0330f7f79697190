//! Inertia: moves that stop too late or have not reached their feed. Numbers by hand: v²/2a + v·t.

use crate::common::{job, number, planned, values, with};
use touchpath::control::{POSTS, ProgramForm};
use touchpath::cycle::CYCLES;
use touchpath::form::{Finding, Level, Value};
use touchpath::job::{check, convert_units, default_job};

fn text(word: &str) -> Value {
    Value::Text(word.to_owned())
}

/// Findings about inertia.
fn found(job: &Value) -> Vec<Finding> {
    check(job)
        .into_iter()
        .filter(|f| matches!(f.code.as_str(), "stops-too-late" | "not-at-feed"))
        .collect()
}

fn codes(job: &Value) -> Vec<String> {
    found(job)
        .iter()
        .map(|f| format!("{:?} {} {}", f.level, f.code, f.path))
        .collect()
}

fn pocket() -> Value {
    job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle-protected" }, "control": { "post": "linuxcnc" } }"#,
    )
}

/// Every cycle on every control that supports it, in mm and in inch, with its default feeds and with every feed left to the control.
#[test]
fn the_defaults_stop_in_time() {
    let mut asked = 0;
    for def in CYCLES {
        for post in POSTS {
            for form in [ProgramForm::Moves, ProgramForm::Cycle] {
                if (post.supports)(def.probes, form).is_err() {
                    continue;
                }
                let mut own = default_job(def.key).unwrap();
                for (path, word) in [("control.post", post.key), ("control.form", form.word())] {
                    own = with(&own, path, text(word));
                }
                let mut rapid = own.clone();
                for feed in ["approach", "longLink", "retract", "return"] {
                    rapid = with(&rapid, &format!("feeds.{feed}"), Value::Null);
                }
                for job in [own, rapid] {
                    for job in [convert_units(&job, "inch").unwrap(), job] {
                        assert_eq!(
                            codes(&job),
                            [""; 0],
                            "{} {} {}",
                            def.key,
                            post.key,
                            form.word()
                        );
                        asked += 1;
                    }
                }
            }
        }
    }
    assert!(asked > 300, "{asked}");
}

/// 6000 mm/min are 100 mm/s: 100²/1000 + 100·0.005 = 10.5 mm. The stopping distance is 3 mm at 500·(√(0.005² + 0.012) − 0.005) = 52.33 mm/s, 3139 mm/min.
#[test]
fn touches_that_stop_too_late_are_refused() {
    let fast = with(&pocket(), "feeds.work", number(6000.0));
    // And 100²/1000 = 10 mm to reach that feed, more than available.
    let [finding, _] = &found(&fast)[..] else {
        panic!("{:?}", codes(&fast))
    };
    assert_eq!(codes(&fast)[1], "Warning not-at-feed feeds.work");
    assert_eq!(
        (finding.level, finding.path.as_str()),
        (Level::Error, "feeds.work")
    );
    assert_eq!(
        values(finding),
        ["6000 mm", "10.5 mm", "3 mm", "3100 mm"],
        "feed, way, deflection, fastest feed"
    );
    assert!(
        found(&with(&fast, "feeds.work", number(3139.0)))
            .iter()
            .all(|f| f.code != "stops-too-late")
    );
    assert!(
        found(&with(&fast, "feeds.work", number(3141.0)))
            .iter()
            .any(|f| f.code == "stops-too-late")
    );
    let circles = with(
        &default_job("probing-two-circles").unwrap(),
        "cycle.probe.feed",
        number(6000.0),
    );
    assert!(
        codes(&circles).contains(&"Error stops-too-late cycle.probe.feed".to_owned()),
        "{:?}",
        codes(&circles)
    );
}

/// A deflection of 12 mm, 2000 mm/s² and no latency: √(2·2000·12) = 219.1 mm/s, 13,145 mm/min.
#[test]
fn a_better_machine_is_allowed_more() {
    let mut fast = pocket();
    for (path, value) in [
        ("acceleration", 2000.0),
        ("latency", 0.0),
        ("deflection", 12.0),
    ] {
        fast = with(&fast, &format!("machine.{path}"), number(value));
    }
    for (feed, late) in [(13_140.0, false), (13_150.0, true)] {
        let codes = codes(&with(&fast, "feeds.approach", number(feed)));
        assert_eq!(
            codes.contains(&"Warning stops-too-late feeds.approach".to_owned()),
            late,
            "{feed}"
        );
    }
}

/// 5000 mm/min: 83.33²/1000 + 0.417 = 7.361 mm. One warning per feed, and only if this control watches.
#[test]
fn watched_positioning_that_stops_too_late_is_named() {
    let fast = with(&pocket(), "feeds.approach", number(5000.0));
    let [finding] = &found(&fast)[..] else {
        panic!("{:?}", codes(&fast))
    };
    assert_eq!(
        (finding.level, finding.path.as_str()),
        (Level::Warning, "feeds.approach")
    );
    assert_eq!(values(finding), ["5000 mm", "7.3611 mm", "3 mm", "3100 mm"]);
    assert_eq!(
        codes(&with(&fast, "feeds.approach", number(3100.0))),
        [""; 0]
    );
    let both = with(&fast, "feeds.longLink", number(5000.0));
    assert_eq!(
        codes(&both),
        [
            "Warning stops-too-late feeds.approach",
            "Warning stops-too-late feeds.longLink"
        ]
    );
    for post in ["linuxcnc", "grbl"] {
        let own = with(&both, "control.post", text(post));
        assert_eq!(
            codes(&own),
            [
                "Warning stops-too-late feeds.approach",
                "Warning stops-too-late feeds.longLink"
            ],
            "{post}"
        );
        assert_eq!(
            codes(&with(&own, "control.protection", text("none"))),
            [""; 0],
            "{post}"
        );
    }
    // 1411: FMAX; its arcs are watched, too, and whether the native cycle watches is unknown.
    let circles = with(
        &default_job("probing-two-circles").unwrap(),
        "cycle.probe.rapid",
        number(5000.0),
    );
    assert_eq!(codes(&circles), [""; 0]);
    let moves = with(
        &with(&circles, "control.post", text("sinumerik")),
        "control.form",
        text("moves"),
    );
    assert_eq!(codes(&moves), ["Warning stops-too-late cycle.probe.rapid"]);
}

/// A native cycle measures at its own feed; its approach belongs to the program.
#[test]
fn a_cycle_of_the_controls_own_has_its_own_feed() {
    let own = with(
        &with(&pocket(), "control.post", text("sinumerik")),
        "control.form",
        text("cycle"),
    );
    assert_eq!(codes(&with(&own, "feeds.work", number(6000.0))), [""; 0]);
    assert_eq!(
        codes(&with(&own, "feeds.longLink", number(6000.0))),
        [""; 0]
    );
    assert_eq!(
        codes(&with(&own, "feeds.approach", number(6000.0))),
        ["Warning stops-too-late feeds.approach"]
    );
}

/// In inch the same physics: 200 inch/min are 84.67 mm/s, 7.168 + 0.423 mm = 0.29889 inch; 3139.8 mm/min are 123.6 inch/min.
#[test]
fn inches_stop_as_late() {
    let inch = with(
        &convert_units(&default_job("hole").unwrap(), "inch").unwrap(),
        "feeds.approach",
        number(200.0),
    );
    let [finding] = &found(&inch)[..] else {
        panic!("{:?}", codes(&inch))
    };
    let said = values(finding);
    assert_eq!(
        (&said[..2], said[3].as_str()),
        (
            &["200 inch", "0.29889 inch"].map(str::to_owned)[..],
            "120 inch"
        )
    );
}

/// From 5 mm before the wall the ball (radius 3) runs 2 mm; 3000 mm/min take 50²/1000 = 2.5. √(2·500·2) = 44.7 mm/s, 2683 mm/min.
#[test]
fn a_touch_that_still_accelerates_is_named() {
    let close = with(
        &with(&pocket(), "cycle.sideClearance1", number(5.0)),
        "feeds.work",
        number(3000.0),
    );
    let [finding] = &found(&close)[..] else {
        panic!("{:?}", codes(&close))
    };
    assert_eq!(
        (finding.level, finding.code.as_str(), finding.path.as_str()),
        (Level::Warning, "not-at-feed", "feeds.work")
    );
    assert_eq!(
        values(finding),
        ["1", "2 mm", "2.5 mm", "3000 mm", "2600 mm"],
        "touch, way, run-up, feed, fastest feed"
    );
    assert_eq!(codes(&with(&close, "feeds.work", number(2680.0))), [""; 0]);
    assert_eq!(codes(&with(&close, "feeds.work", number(2690.0))).len(), 1);
}

/// A watched rapid runs at a feed from which the default machine stops, and the time counts that feed.
#[test]
fn a_watched_rapid_is_slow() {
    let rapid = with(&pocket(), "feeds.longLink", Value::Null);
    for (post, feed) in [
        ("linuxcnc", 2000.0),
        ("sinumerik", 2000.0),
        ("fanuc", 2000.0),
        ("haas", 2400.0),
    ] {
        let own = with(&rapid, "control.post", text(post));
        let plan = planned(&own);
        let note = plan
            .findings
            .iter()
            .find(|f| f.code == "rapid-at-feed")
            .expect("it is said");
        assert_eq!(values(note), [format!("{feed} mm")], "{post}");
        let stated = planned(&with(&own, "feeds.longLink", number(feed)));
        // Retracts are not watched: LinuxCNC makes them at its own rapid, which counts as 5000.
        if post != "linuxcnc" {
            assert!(
                (plan.time - stated.time).abs() < 1e-9,
                "{post}: {} {}",
                plan.time,
                stated.time
            );
        }
    }
}
