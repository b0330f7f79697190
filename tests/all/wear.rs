//! Tools that a macro corrects from its measurement: the letters of its call, refusals, and the header.

use crate::common::{import, job, planned, refused, with};
use crate::tests::controls::{calling_macros_as_a_fanuc, correcting_no_tools, correcting_tools};
use touchpath::form::{Level, Value};
use touchpath::job::{convert_units, plan};

/// A bore of 25 mm that is larger by `off`.
fn bore(post: &str, wear: &str, off: f64) -> Value {
    job(&format!(
        r#"{{ "format": 1, "cycle": {{ "type": "hole", "diameter": 25 }}, "control": {{ "post": "{post}", "form": "cycle" }},
            "part": {{ "sizes": {{ "diameter": {off} }} }}, "tolerances": {{ "diameter": {{ "tolerance": "±0.05", "wear": {wear} }} }} }}"#
    ))
}

/// Letters of the reference sheets: T the offset, F the share, V the dead band, which a measuring macro compares with half of the error; 9835 has M, the
/// offsets that store the values, and C, the parts.
#[test]
fn the_macro_gets_the_tool_in_its_own_letters() {
    let whole = r#"{ "tool": 5, "percent": 50, "deadBand": 0.005 }"#;
    let calls = |post: &str, wear: &str| -> Vec<String> {
        let text = planned(&bore(post, wear, 0.03)).program.text;
        let measures = |line: &&str| {
            ["9814", "8814", "9835", "8835"]
                .iter()
                .any(|number| line.contains(number))
                && !line.contains('(')
        };
        text.lines().filter(measures).map(str::to_owned).collect()
    };
    for post in calling_macros_as_a_fanuc() {
        assert_eq!(
            calls(post, whole),
            ["G65 P9814 D25. Q2. T5. F0.5 V0.0025 H0.5"],
            "{post}"
        );
    }
    assert_eq!(
        calls("brother", whole),
        ["G65 P8814 D25. Q2. T5. F0.5 V0.0025 H0.5"]
    );
    assert_eq!(
        calls("okuma", whole),
        ["CALL O9814 PD=25. PQ=2. PT=5. PF=0.5 PV=0.0025 PH=0.5"]
    );
    assert_eq!(
        calls("haas", r#"{ "tool": 12 }"#),
        ["G65 P9814 D25. Q2. T12. H0.5"],
        "the whole error, without a dead band"
    );
    let mean = r#"{ "tool": 5, "percent": 25, "parts": 4, "store": 20 }"#;
    assert_eq!(
        calls("haas", mean),
        ["G65 P9814 D25. Q2. H0.5", "G65 P9835 T5. M20. C4. F0.25"]
    );
    let banded = r#"{ "tool": 5, "deadBand": 0.005, "parts": 4, "store": 20 }"#;
    assert_eq!(
        calls("haas", banded)[1],
        "G65 P9835 T5. M20. C4. V0.005",
        "the mean compares the whole error"
    );
    // The mean may clear results of the measuring macro: they are saved before.
    let plan = planned(&bore("haas", mean, 0.03));
    let row = plan
        .results
        .iter()
        .find(|row| row.code == "diameter")
        .unwrap();
    let kept = format!("{}=#188", row.stored.as_deref().unwrap());
    let at = |what: &str| {
        plan.program
            .text
            .lines()
            .position(|line| line.starts_with(what))
            .unwrap_or_else(|| panic!("{what}"))
    };
    assert!(
        at("G65 P9814") < at(&kept) && at(&kept) < at("G65 P9835"),
        "{}",
        plan.program.text
    );
}

/// Only in the call of its size, in a rectangle and in a set-up.
#[test]
fn only_the_call_of_that_size_corrects() {
    let text = r#"{ "format": 2, "control": { "post": "haas", "form": "cycle" },
        "cycles": [ { "name": "BORE", "type": "hole", "diameter": 25 }, { "name": "POCKET", "type": "internal-rectangle", "origin": [0, 100, 0] } ],
        "tolerances": { "pocket.width2": { "tolerance": "±0.1", "wear": { "tool": 8 } }, "BORE.diameter": { "tolerance": "±0.1" } } }"#;
    let plan = planned(&job(text));
    let calls: Vec<&str> = plan
        .program
        .text
        .lines()
        .filter(|line| line.starts_with("G65 P981") && !line.contains("P9810"))
        .collect();
    assert_eq!(
        calls,
        [
            "G65 P9814 D25. Q2. H0.5",
            "G65 P9812 X80. Q2. H0.5",
            "G65 P9812 Y50. Q2. T8. H0.5"
        ]
    );
    let alone = r#"{ "format": 2, "control": { "post": "haas", "form": "cycle" }, "cycles": [ { "name": "BORE", "type": "hole", "diameter": 25 } ],
        "tolerances": { "diameter": { "tolerance": "±0.1", "wear": { "tool": 4 } } } }"#;
    assert_eq!(
        planned(&job(alone)).program.does,
        "corrects tool offset 4",
        "the name of an only cycle may be left out"
    );
    assert_eq!(plan.program.does, "corrects tool offset 8");
    // With a work offset that the last cycle writes, both are reported.
    let both = text
        .replace(
            "\"form\": \"cycle\"",
            "\"form\": \"cycle\", \"workOffset\": 1",
        )
        .replace("pocket.width2", "BORE.DIAMETER");
    let both = both.replace(", \"BORE.diameter\": { \"tolerance\": \"±0.1\" }", "");
    let said = planned(&job(&both));
    assert_eq!(said.program.does, "writes G54 X Y, corrects tool offset 8");
    assert!(
        said.program
            .text
            .contains("(WRITES G54 X Y, CORRECTS TOOL OFFSET 8: BY THE MACROS"),
        "{}",
        said.program.text
    );
    // Two means in one pair of offsets would mix two features.
    let means = text
        .replace(
            "{ \"tool\": 8 }",
            "{ \"tool\": 8, \"parts\": 3, \"store\": 20 }",
        )
        .replace(
            "{ \"tolerance\": \"±0.1\" }",
            "{ \"tolerance\": \"±0.1\", \"wear\": { \"tool\": 9, \"parts\": 3, \"store\": 21 } }",
        );
    let wanted = [
        "wear-unsupported tolerances.BORE.diameter.wear.store",
        "wear-unsupported tolerances.pocket.width2.wear.store",
    ];
    assert_eq!(refused(&job(&means)), wanted);
    assert!(
        plan.program
            .text
            .contains("(CORRECTS TOOL OFFSET 8: BY THE MACROS, AS SOON AS THE SIZE IS MEASURED."),
        "{}",
        plan.program.text
    );
}

/// By hand: 0.03 too large, half of it is 0.015; 0.004 is within the dead band.
#[test]
fn what_becomes_of_the_offset_is_said() {
    let said = |off: f64, wear: &str| -> String {
        let plan = planned(&bore("haas", wear, off));
        let mut found = plan
            .findings
            .into_iter()
            .filter(|finding| finding.code == "tool-corrected");
        found.next().unwrap().message
    };
    let band = r#"{ "tool": 5, "percent": 50, "deadBand": 0.005 }"#;
    assert_eq!(
        said(0.03, band),
        "Diameter is off by 0.03 mm: the macro corrects tool offset 5 by 50 % of that, 0.015 mm"
    );
    assert_eq!(
        said(-0.02, band),
        "Diameter is off by -0.02 mm: the macro corrects tool offset 5 by 50 % of that, -0.01 mm"
    );
    assert_eq!(
        said(0.004, band),
        "Diameter is off by 0.004 mm, no more than the dead band of 0.005 mm: tool offset 5 stays"
    );
    assert_eq!(
        said(0.0, r#"{ "tool": 5 }"#),
        "Diameter is as large as the nominal part's: tool offset 5 stays"
    );
    // H0.5 is in the call: the macro stops before it corrects.
    assert_eq!(
        said(1.0, band),
        "Diameter is off by 1 mm: the macro stops with an alarm. Tool offset 5 stays, unless the program is continued"
    );
    let unlimited = with(&bore("haas", band, 0.0), "limits.size", Value::Null);
    assert!(
        planned(&unlimited)
            .findings
            .iter()
            .any(|finding| finding.code == "wear-unlimited")
    );
    let mean = said(0.03, r#"{ "tool": 5, "parts": 3, "store": 21 }"#);
    assert_eq!(
        mean,
        "Diameter deviates by 0.03 mm: the macro stores that in offset 21, and corrects tool offset 5 by 100 % of the mean of 3 parts"
    );
}

/// H7 of 25 is 0 to 0.021: corrected towards 25 the bores would be at the edge of their zone.
#[test]
fn a_nominal_value_at_the_edge_of_its_zone_is_a_warning() {
    let warned = |tolerance: &str| {
        let job = with(
            &bore("haas", r#"{ "tool": 5 }"#, 0.0),
            "tolerances.diameter.tolerance",
            Value::Text(tolerance.to_owned()),
        );
        planned(&job)
            .findings
            .iter()
            .any(|finding| finding.code == "wear-off-middle" && finding.level == Level::Warning)
    };
    assert!(warned("H7") && warned("+0.02/0"));
    assert!(!warned("±0.02") && !warned("js7"));
}

#[test]
fn what_cannot_be_corrected_is_refused() {
    let tool = r#"{ "tool": 5 }"#;
    for post in correcting_no_tools() {
        assert_eq!(
            refused(&bore(post, tool, 0.0)),
            ["wear-unsupported tolerances.diameter.wear"],
            "{post}"
        );
    }
    let writes = with(
        &bore("haas", tool, 0.0),
        "control.workOffset",
        Value::Number(1.0),
    );
    assert_eq!(
        refused(&writes),
        ["wear-unsupported tolerances.diameter.wear"]
    );
    let place = r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "post": "haas", "form": "cycle" },
        "tolerances": { "center.x": { "tolerance": "±0.05", "wear": { "tool": 5 } } } }"#;
    assert_eq!(
        refused(&job(place)),
        ["wear-unsupported tolerances.center.x.wear"]
    );
    for (wear, wanted) in [
        ("5", "wrong-type tolerances.diameter.wear"),
        ("{}", "missing tolerances.diameter.wear.tool"),
        (
            r#"{ "tool": 0 }"#,
            "out-of-range tolerances.diameter.wear.tool",
        ),
        (
            r#"{ "tool": 2.5 }"#,
            "not-whole tolerances.diameter.wear.tool",
        ),
        (
            r#"{ "tool": "5\nM30" }"#,
            "wrong-type tolerances.diameter.wear.tool",
        ),
        (
            r#"{ "tool": 5, "percent": 0 }"#,
            "out-of-range tolerances.diameter.wear.percent",
        ),
        (
            r#"{ "tool": 5, "percent": 150 }"#,
            "out-of-range tolerances.diameter.wear.percent",
        ),
        (
            r#"{ "tool": 5, "deadBand": -0.1 }"#,
            "out-of-range tolerances.diameter.wear.deadBand",
        ),
        (
            r#"{ "tool": 5, "parts": 3 }"#,
            "missing tolerances.diameter.wear.store",
        ),
        (
            r#"{ "tool": 5, "deadBand": 1.1 }"#,
            "out-of-range tolerances.diameter.wear.deadBand",
        ),
        (
            r#"{ "tool": null }"#,
            "wrong-type tolerances.diameter.wear.tool",
        ),
        (
            r#"{ "tool": 5, "parts": 3, "store": 999 }"#,
            "out-of-range tolerances.diameter.wear.store",
        ),
        (
            r#"{ "tool": 5, "store": 3 }"#,
            "missing tolerances.diameter.wear.parts",
        ),
        (
            r#"{ "tool": 5, "parts": 3, "store": 5 }"#,
            "wear-unsupported tolerances.diameter.wear.store",
        ),
        (
            r#"{ "tool": 5, "parts": 3, "store": 4 }"#,
            "wear-unsupported tolerances.diameter.wear.store",
        ),
        (
            r#"{ "tool": 5, "radius": 3 }"#,
            "unknown-key tolerances.diameter.wear.radius",
        ),
    ] {
        assert_eq!(refused(&bore("haas", wear, 0.0)), [wanted], "{wear}");
    }
}

/// Q330 of the measuring cycles corrects DR of its tool by the whole error, also inside the tolerance [S: the manual of a TNC 640]; a share, a dead band and a mean
/// are not possible, and no source shows which side of a rectangle counts.
#[test]
fn a_heidenhain_names_the_tool_in_its_cycle() {
    let tools = |job: &Value| -> Vec<String> {
        let text = planned(job).program.text;
        let named = text.lines().filter(|line| line.contains("Q330="));
        named.map(|line| line.trim().to_owned()).collect()
    };
    let bored = bore("heidenhain", r#"{ "tool": 5 }"#, 0.03);
    assert_eq!(tools(&bored), ["Q330=+5 ;TOOL NUMBER"]);
    let plan = planned(&bored);
    assert_eq!(plan.program.does, "corrects tool offset 5");
    assert!(
        plan.program
            .text
            .contains("Corrects tool offset 5: by the cycle, as soon as the size is measured"),
        "{}",
        plan.program.text
    );
    let said: Vec<&str> = plan
        .findings
        .iter()
        .filter(|finding| finding.code == "tool-corrected")
        .map(|finding| finding.message.as_str())
        .collect();
    assert_eq!(
        said,
        ["Diameter is off by 0.03 mm: the cycle corrects DR of tool 5, also within the tolerance"]
    );
    let far = planned(&bore("heidenhain", r#"{ "tool": 5 }"#, 2.0)).findings;
    assert!(
        far.iter()
            .any(|f| f.code == "tool-corrected" && f.message.contains("may have corrected DR")),
        "{far:?}"
    );
    assert_eq!(
        tools(&bore("heidenhain", "null", 0.0)),
        ["Q330=+0 ;TOOL NUMBER"]
    );
    for wear in [
        r#"{ "tool": 5, "percent": 50 }"#,
        r#"{ "tool": 5, "deadBand": 0.01 }"#,
        r#"{ "tool": 5, "parts": 3, "store": 20 }"#,
    ] {
        assert_eq!(
            refused(&bore("heidenhain", wear, 0.0)),
            ["wear-unsupported tolerances.diameter.wear"],
            "{wear}"
        );
    }
    let of = |cycle: &str, code: &str| {
        job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "{cycle}" }}, "control": {{ "post": "heidenhain", "form": "cycle" }},
                "tolerances": {{ "{code}": {{ "tolerance": "±0.05", "wear": {{ "tool": 5 }} }} }} }}"#
        ))
    };
    assert_eq!(
        refused(&of("internal-rectangle", "width1")),
        ["wear-unsupported tolerances.width1.wear"]
    );
    for cycle in ["groove", "web"] {
        assert_eq!(tools(&of(cycle, "width")), ["Q330=+5 ;TOOL NUMBER"]);
    }
    // In a set-up only the call of that size.
    let two = r#"{ "format": 2, "control": { "post": "heidenhain", "form": "cycle" },
        "cycles": [ { "name": "ONE", "type": "hole" }, { "name": "TWO", "type": "hole", "origin": [0, 100, 0] } ],
        "tolerances": { "TWO.diameter": { "tolerance": "±0.1", "wear": { "tool": 8 } } } }"#;
    assert_eq!(
        tools(&job(two)),
        ["Q330=+0 ;TOOL NUMBER", "Q330=+8 ;TOOL NUMBER"]
    );
    let text = planned(&bored).program.text;
    assert_eq!(planned(&import(&text).unwrap().job).program.text, text);
}

/// Each macro would correct the tool by its own error, so that a tool that is off by 0.02 becomes wrong by 0.02 the other way.
#[test]
fn two_results_do_not_correct_one_tool() {
    for post in ["haas", "mazak", "heidenhain"] {
        let two = |other: i32| {
            job(&format!(
                r#"{{ "format": 2, "control": {{ "post": "{post}", "form": "cycle" }},
                    "cycles": [ {{ "name": "ONE", "type": "hole" }}, {{ "name": "TWO", "type": "hole", "origin": [0, 100, 0] }} ],
                    "tolerances": {{ "ONE.diameter": {{ "tolerance": "±0.1", "wear": {{ "tool": 8 }} }},
                        "TWO.diameter": {{ "tolerance": "±0.1", "wear": {{ "tool": {other} }} }} }} }}"#
            ))
        };
        assert_eq!(
            refused(&two(8)),
            [
                "wear-unsupported tolerances.ONE.diameter.wear.tool",
                "wear-unsupported tolerances.TWO.diameter.wear.tool"
            ],
            "{post}"
        );
        planned(&two(9));
    }
}

/// The header contains it, and it is read back; in inch the dead band is the same length.
#[test]
fn it_comes_back_from_the_header_and_is_converted() {
    let mean = r#"{ "tool": 5, "percent": 50, "deadBand": 0.005, "parts": 3, "store": 20 }"#;
    for post in correcting_tools() {
        let bored = bore(post, mean, 0.0);
        let text = planned(&bored).program.text;
        let back = import(&text).unwrap().job;
        let at = |job: &Value| {
            job.get("tolerances")
                .and_then(|all| all.get("diameter"))
                .and_then(|one| one.get("wear"))
                .cloned()
                .unwrap()
        };
        for key in ["tool", "percent", "deadBand", "parts", "store"] {
            assert_eq!(at(&back).get(key), at(&bored).get(key), "{post} {key}");
        }
        assert_eq!(planned(&back).program.text, text, "{post}");
    }
    // `null` adds nothing to the header.
    let none = bore("heidenhain", "null", 0.0);
    let text = planned(&none).program.text;
    assert!(!text.contains("wear"), "{text}");
    assert_eq!(planned(&import(&text).unwrap().job).program.text, text);
    // In inch as long as in mm: a band that is valid in one is valid in the other.
    let wide = convert_units(
        &bore("haas", r#"{ "tool": 5, "deadBand": 1 }"#, 0.0),
        "inch",
    )
    .unwrap();
    assert!(plan(&wide).is_ok() && plan(&convert_units(&wide, "mm").unwrap()).is_ok());
    let long = with(
        &wide,
        "tolerances.diameter.wear.deadBand",
        Value::Number(0.5),
    );
    assert_eq!(
        refused(&long),
        ["out-of-range tolerances.diameter.wear.deadBand"]
    );
    let inch = convert_units(&bore("haas", mean, 0.0), "inch").unwrap();
    let text = planned(&inch).program.text;
    assert!(text.contains("T5. M20. C3. F0.5 V0.0002\n"), "{text}");
}
