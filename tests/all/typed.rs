//! Jobs with types are the jobs of JSON.

use touchpath::form::Value;
use touchpath::job::{check, from_json, plan};
use touchpath::typed::*;

#[test]
fn a_typed_job_says_what_it_says_in_json() {
    let typed = Job {
        name: Some("BORE".to_owned()),
        units: Some(Units::Inch),
        plane: Some(Plane::G18),
        stylus: Some(Stylus { diameter: Some(0.25), length: Some(None), ..Stylus::default() }),
        feeds: Some(Feeds { approach: Some(None), return_: Some(Some(80.0)), ..Feeds::default() }),
        control: Some(Control { post: Some(Post::Linuxcnc), work_offset: Some(Some(2)), ..Control::default() }),
        part: Some(Part { sizes: Some([("diameter".to_owned(), 0.01)].into()), ..Part::default() }),
        tool: Some(Tool {
            type_: Some(710),
            frame: Some(vec![FrameStep::Turn(Axis::X, 90.0), FrameStep::Mirror(Axis::Z)]),
            ..Tool::default()
        }),
        cycle: Hole {
            diameter: Some(1.5),
            touches: Some(vec![PickedTouch { point: [1.0, 2.0, 3.0], vector: [0.0, 1.0, 0.0] }]),
            custom: Some(vec![CustomCode::Flt(-300, 0.5), CustomCode::Bol(-301, true)]),
            properties: Some(None),
            ..Hole::default()
        }
        .into(),
        ..Job::default()
    };
    let json = r#"{ "format": 1, "name": "BORE", "units": "inch", "plane": "G18",
        "stylus": { "diameter": 0.25, "length": null }, "feeds": { "approach": null, "return": 80 },
        "control": { "post": "linuxcnc", "workOffset": 2 }, "part": { "sizes": { "diameter": 0.01 } },
        "tool": { "type": 710, "frame": [{ "rot": "X", "angle": 90 }, { "mirror": "Z" }] },
        "cycle": { "type": "hole", "diameter": 1.5, "touches": [{ "point": [1, 2, 3], "vector": [0, 1, 0] }], "properties": null,
            "custom": [{ "code": -300, "type": "Flt", "value": 0.5 }, { "code": -301, "type": "Bol", "value": true }] } }"#;
    assert_eq!(sorted(&Value::from(typed)), sorted(&from_json(json).unwrap()));
}

/// Keys in their order: JSON's have none.
fn sorted(value: &Value) -> Value {
    match value {
        Value::Map(entries) => {
            let mut entries: Vec<_> = entries.iter().map(|(key, value)| (key.clone(), sorted(value))).collect();
            entries.sort_by(|(a, _), (b, _)| a.cmp(b));
            Value::Map(entries)
        }
        Value::List(items) => Value::List(items.iter().map(sorted).collect()),
        value => value.clone(),
    }
}

#[test]
fn a_typed_cycle_of_defaults_is_the_default_cycle() {
    let cycles: [(Cycle, &str); 3] = [
        (DoubleWallInternalCorner::default().into(), "double-wall-internal-corner"),
        (Groove::default().into(), "groove"),
        (ProbingTwoCircles { diameter1: Some("20H7".into()), ..Default::default() }.into(), "probing-two-circles"),
    ];
    for (cycle, key) in cycles {
        let control = Control { post: Some(Post::Sinumerik), ..Control::default() };
        let typed = Value::from(&Job { cycle, control: Some(control), ..Job::default() });
        let diameter = if key == "probing-two-circles" { r#", "diameter1": "20H7""# } else { "" };
        let json =
            format!(r#"{{ "format": 1, "control": {{ "post": "sinumerik" }}, "cycle": {{ "type": "{key}"{diameter} }} }}"#);
        assert_eq!(plan(&typed).unwrap(), plan(&from_json(&json).unwrap()).unwrap(), "{key}");
    }
}

/// No number in place of a feed is a finding, and no rapid.
#[test]
fn what_is_no_number_is_no_rapid() {
    let feeds = Feeds { approach: Some(Some(f64::NAN)), ..Feeds::default() };
    let findings = check(&Job { feeds: Some(feeds), ..Job::default() }.into());
    assert!(findings.iter().any(|f| f.path == "feeds.approach" && f.level == touchpath::form::Level::Error), "{findings:?}");
}
