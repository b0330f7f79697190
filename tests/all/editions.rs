//! Editions of Renishaw's macros: letters that exclude each other, what the job is asked for, and the way back.

use crate::common::{import, job, planned, with};
use touchpath::form::Value;
use touchpath::job::plan;

/// A bore whose work offset is written, with a limit of its size.
fn bore(post: &str, edition: &str, more: &str) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": 25 }}, "limits": {{ "size": 0.5, "position": 1 }},
            "machine": {{ "edition": "{edition}" }}, "control": {{ "post": "{post}", "form": "cycle" {more} }} }}"#
    ))
}

fn call(job: &Value) -> String {
    let text = planned(job).program.text;
    let line = text.lines().find(|line| line.starts_with("G65 P9814"));
    line.expect("a call").to_owned()
}

fn warned(job: &Value, code: &str) -> Vec<String> {
    let findings = plan(job).expect("a program").findings;
    let own = findings.into_iter().filter(|finding| finding.code == code);
    own.map(|finding| format!("{}: {}", finding.path, finding.message))
        .collect()
}

/// Mazak's edition has the alarm SH INPUT MIXED in every macro [S: one shop's program]: H is left out, and the job says that the size is not checked.
#[test]
fn letters_that_exclude_each_other_are_not_given_together() {
    let writes = r#", "workOffset": 1"#;
    let limited = "G65 P9814 D25. Q2. H0.5 M2. S1.";
    for (post, edition, wanted) in [
        ("mazak", "mazak-a-4013-0113", "G65 P9814 D25. Q2. M2. S1."),
        ("mazak", "haas-ngc", limited),
        ("mazak", "unknown", limited),
        ("haas", "unknown", limited),
        ("fanuc", "mazak-a-4013-0113", "G65 P9814 D25. Q2. M2. S1."),
    ] {
        let job = bore(post, edition, writes);
        assert_eq!(call(&job), wanted, "{post} {edition}");
        let unchecked = warned(&job, "limits-not-asked");
        assert_eq!(
            !unchecked.is_empty(),
            !wanted.contains('H'),
            "{post} {edition}"
        );
        assert!(unchecked.iter().all(|message| message.contains("diameter")));
        // It is asked for where the program depends on it.
        let asked = warned(&job, "edition-not-stated");
        assert_eq!(
            asked.len(),
            usize::from(post == "mazak" && edition == "unknown"),
            "{post} {edition}"
        );
    }
    let measures = bore("mazak", "unknown", "");
    assert_eq!(call(&measures), "G65 P9814 D25. Q2. H0.5 M2.");
    assert!(warned(&measures, "edition-not-stated").is_empty());
    let asked = warned(&bore("mazak", "unknown", writes), "edition-not-stated");
    assert_eq!(
        asked,
        [
            "machine.edition: Edition A-4013-0113 of Renishaw's macros stops with an alarm for S beside H: state the edition on your machine"
        ]
    );
}

/// T and M exclude each other there, too: the tool is corrected, and the position is not checked.
#[test]
fn a_corrected_tool_leaves_the_position_unchecked_in_the_edition_for_mazak() {
    let wear = r#"{ "diameter": { "tolerance": "±0.05", "wear": { "tool": 5 } } }"#;
    let wear = touchpath::job::from_json(wear).unwrap();
    let of = |edition| with(&bore("mazak", edition, ""), "tolerances", wear.clone());
    assert_eq!(call(&of("haas-ngc")), "G65 P9814 D25. Q2. T5. H0.5 M2.");
    assert_eq!(
        call(&of("mazak-a-4013-0113")),
        "G65 P9814 D25. Q2. T5. H0.5"
    );
    assert_eq!(warned(&of("unknown"), "edition-not-stated").len(), 1);
    // The macro for the mean needs T and M in every edition.
    let mean = r#"{ "diameter": { "tolerance": "±0.05", "wear": { "tool": 5, "parts": 3, "store": 20 } } }"#;
    let mean = touchpath::job::from_json(mean).unwrap();
    let averaged = with(&bore("mazak", "unknown", ""), "tolerances", mean);
    assert!(
        planned(&averaged)
            .program
            .text
            .contains("G65 P9835 T5. M20.")
    );
    assert!(warned(&averaged, "edition-not-stated").is_empty());
}

/// Calibration by directions is K4 of P9801 there, P9804 elsewhere.
#[test]
fn the_header_names_the_edition_and_the_way_back_has_it() {
    let turned = |edition: &str| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "groove", "rotation": 30 }}, "machine": {{ "edition": "{edition}" }},
                "control": {{ "post": "mazak", "form": "cycle" }} }}"#
        ))
    };
    for (edition, named, calibrated) in [
        ("unknown", None, "P9804"),
        ("haas-ngc", Some("3.11 FOR HAAS NGC"), "P9804"),
        (
            "mazak-a-4013-0113",
            Some("A-4013-0113 FOR MAZAK"),
            "P9801 K4",
        ),
    ] {
        let text = planned(&turned(edition)).program.text;
        let line = named.map(|name| format!("(EDITION OF THE MACROS: {name})"));
        let lines = text.lines().filter(|line| line.contains("EDITION OF THE"));
        assert_eq!(
            lines.map(str::to_owned).collect::<Vec<_>>(),
            Vec::from_iter(line)
        );
        assert!(
            text.contains(&format!("BY DIRECTIONS: {calibrated})")),
            "{edition}: {text}"
        );
        let back = import(&text).expect("the job").job;
        let machine = back.get("machine").expect("a machine");
        assert_eq!(
            machine.get("edition"),
            Some(&Value::Text(edition.to_owned()))
        );
    }
}

/// A value that has no effect is said, like other unused fields.
#[test]
fn an_edition_without_macros_has_no_effect() {
    for control in [
        r#"{ "post": "haas" }"#,
        r#"{ "post": "linuxcnc" }"#,
        r#"{ "post": "heidenhain", "form": "cycle" }"#,
    ] {
        let job = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "hole" }}, "machine": {{ "edition": "haas-ngc" }}, "control": {control} }}"#
        ));
        assert_eq!(warned(&job, "field-unused").len(), 1, "{control}");
    }
}

/// A call of a program for this edition becomes a job for it.
#[test]
fn a_call_of_its_program_becomes_a_job_for_the_edition() {
    let text = "(RENISHAW INSPECTION PLUS A-4013-0113)\nG21 G90\nG65 P9810 X0. Y0. Z-10. F2000.\nG65 P9814 D25. Q2. S2.\n";
    let path = touchpath::import::read_program(text, None);
    let own = path.calls.last().and_then(|call| call.job.clone());
    let job = own.expect("a job");
    let at = |section: &str, key: &str| job.get(section).and_then(|s| s.get(key)).cloned();
    let word = |word: &str| Some(Value::Text(word.to_owned()));
    assert_eq!(at("machine", "edition"), word("mazak-a-4013-0113"));
    assert_eq!(at("control", "post"), word("mazak"));
    assert_eq!(at("control", "workOffset"), Some(Value::Number(2.0)));
    assert_eq!(call(&job), "G65 P9814 D25. Q2. S2.");
}
