//! Loading a program: LinuxCNC's screens read it with their own module, in which each probing move ends at its target and `#5070` is 0.

use crate::common::{job, jobs, number, preview, with};
use touchpath::form::Value;
use touchpath::job::{default_job, plan};

/// Programs that stop on results: every cycle that writes, with each limit, in mm and inch, a set-up that follows a result, tolerances that stop.
fn programs() -> Vec<(String, String)> {
    let offset = |job: &Value| {
        with(
            &with(job, "control.post", Value::Text("linuxcnc".to_owned())),
            "control.workOffset",
            number(1.0),
        )
    };
    let limited = |job: &Value| {
        with(
            &with(job, "limits.position", number(0.5)),
            "limits.size",
            number(0.2),
        )
    };
    let mut all: Vec<(String, Value)> = jobs()
        .into_iter()
        .map(|(name, job)| (name, offset(&job)))
        .collect();
    for cycle in touchpath::cycle::CYCLES {
        let own = offset(&default_job(cycle.key).unwrap());
        all.push((format!("{} limited", cycle.key), limited(&own)));
        all.push((
            format!("{} in inch", cycle.key),
            with(
                &with(&own, "units", Value::Text("inch".to_owned())),
                "cycle",
                job(&format!(r#"{{ "type": "{}" }}"#, cycle.key)),
            ),
        ));
    }
    let set_up = r#"{ "format": 2, "limits": { "position": 1 }, "control": { "post": "linuxcnc", "workOffset": 1 },
        "cycles": [{ "name": "A", "type": "hole", "diameter": 20 }, { "name": "B", "type": "hole", "diameter": 20, "origin": ["=A.center.x+60", 0, 0] }],
        "tolerances": { "B.diameter": { "tolerance": "H7", "action": "stop" } } }"#;
    all.push(("a set-up".to_owned(), job(set_up)));
    let planned = all
        .into_iter()
        .filter_map(|(name, job)| Some((name, plan(&job).ok()?.program.text)));
    planned.filter(|(_, text)| text.contains("G38.2")).collect()
}

#[test]
fn a_program_is_loaded_without_an_error() {
    let programs = programs();
    let texts: Vec<&str> = programs.iter().map(|(_, text)| text.as_str()).collect();
    let guarded = texts
        .iter()
        .filter(|text| text.contains("#<_task>"))
        .count();
    assert!(
        programs.len() > 60 && guarded > 30,
        "{guarded} of {}",
        programs.len()
    );
    for ((name, text), said) in programs.iter().zip(preview(&texts)) {
        assert_eq!(said, "ok", "{name}\n{text}");
    }
}

/// Without the guard the screen shows an error: the hole of 40 is measured 10 too large.
#[test]
fn a_program_that_stops_on_a_result_of_the_preview_is_refused_there() {
    let hole = with(
        &with(
            &default_job("hole").unwrap(),
            "control.post",
            Value::Text("linuxcnc".to_owned()),
        ),
        "control.workOffset",
        number(1.0),
    );
    let text = plan(&hole).unwrap().program.text;
    let said = preview(&[&text.replace("#<_task> EQ 1", "1 EQ 1")]).remove(0);
    assert!(said.contains("diameter is 50"), "{said}");
}
