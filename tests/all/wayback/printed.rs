//! Results and points as programs and posts print them.

use super::{codes, errors, measured, near, pocket, value};
use crate::common::{job, with};
use touchpath::form::Value;
use touchpath::job::plan;

const RESULTS: [(&str, f64); 4] = [
    ("center.x", 0.1),
    ("center.y", 0.2),
    ("width1", 80.04),
    ("width2", 50.0),
];

#[test]
fn printed_results_give_rows() {
    let plain: String = RESULTS
        .iter()
        .map(|(code, x)| format!("{code}={x:.4}\n"))
        .collect();
    let dprnt: String = RESULTS
        .iter()
        .map(|(code, x)| format!("{}= {x:8.4}\n", code.to_uppercase().replace('.', " ")))
        .collect();
    let forms = [
        plain.clone(),
        format!("PROBE\n{plain}"),
        format!("4711\n{plain}"),
        dprnt.clone(),
        dprnt.replace("= ", " =\t"),
        plain
            .lines()
            .map(|line| format!("12:30:01 emctask: {line}\r\n"))
            .collect(),
        plain.replace('\n', " "),
        format!("%\n{dprnt}%\n"),
        // The program itself is in a log, and a result appears twice with one value.
        format!("(PRINT,center.x=#<center_x>)\n#<center_x>=[[#1+#2]/2]\n{plain}{plain}"),
    ];
    let expected = plan(&pocket()).unwrap().results;
    for form in forms {
        let found = measured(&pocket(), &form);
        assert!(
            found.points.is_empty() && found.block.is_none() && found.findings.is_empty(),
            "{form}: {:?}",
            found.findings
        );
        for ((code, x), planned) in RESULTS.iter().zip(&expected) {
            let row = found.results.iter().find(|row| row.code == *code).unwrap();
            near(row.value.unwrap(), *x);
            near(row.deviation.unwrap(), x - planned.nominal.unwrap());
            // Both are for the nominal part: a centre between two touches of 0.001 scatters by 0.001/√2.
            assert_eq!(
                (row.uncertainty, row.truth),
                (planned.uncertainty, None),
                "{form}"
            );
        }
        near(found.results[0].uncertainty.unwrap(), 0.001 / 2f64.sqrt());
    }
}

/// Output of the programs themselves: LinuxCNC's messages, a message of a SINUMERIK, its log, and DPRNT.
#[test]
fn what_the_programs_show_is_read() {
    for form in [
        "center.x=0.1\ncenter.y=0.2\nwidth1=80.04\nwidth2=50",
        "center.x=0.1 center.y=0.2 width1=80.04 width2=50",
        "; center.x=0.1\n; center.y=0.2\n; width1=80.04\n; width2=50",
        "CENTER X     .100\nCENTER Y     .200\nWIDTH1   80.040\nWIDTH2   50.000",
    ] {
        let found = measured(&pocket(), form);
        for (code, wanted) in RESULTS {
            near(value(&found, code).unwrap(), wanted);
        }
    }
}

/// Lines that Renishaw's macros print with `W`, with blanks or `*`: kind and nominal value identify the result. A line of another part is refused.
#[test]
fn the_lines_of_renishaws_macros_are_read() {
    let print = "COMPONENT NO 1   FEATURE NO 1\n\
        SIZE X 80.0000   ACTUAL 80.0400   TOL 0.5000   DEV 0.0400\n\
        POSN X 0.0000   ACTUAL 0.1000   DEV 0.1000\n\
        COMPONENT NO 1   FEATURE NO 2\n\
        SIZE Y50.0000   ACTUAL 50.0000   DEV 0.0000\n\
        +++++OUT OF POS+++++ ERROR TP 0.4000 RADIAL 0.2000\n\
        POSN Y 0.0000   ACTUAL 0.2000   TOL TP 0.1000   DEV 0.2000\n";
    for text in [
        print.to_owned(),
        print.replace(' ', "*"),
        print.replace('\n', "\r\n"),
    ] {
        let found = measured(&pocket(), &text);
        assert_eq!(codes(&found), [""; 0], "{text}");
        for (code, wanted) in RESULTS {
            near(value(&found, code).unwrap(), wanted);
        }
    }
    // A centre and a width with one nominal value: the kind distinguishes them.
    let off = with(
        &pocket(),
        "cycle.origin",
        crate::common::point([50.0, 0.0, 0.0]),
    );
    let found = measured(
        &off,
        "SIZE Y 50.0000   ACTUAL 50.0300\nPOSN X 50.0000   ACTUAL 50.1000\n",
    );
    for (code, wanted) in [("center.x", 50.1), ("width2", 50.03)] {
        near(value(&found, code).unwrap(), wanted);
    }
    let inch = touchpath::job::convert_units(&pocket(), "inch").unwrap();
    // 80 mm are 3.1496 inch.
    let found = measured(&inch, "SIZE X 3.1496   ACTUAL 3.1512   DEV 0.0016\n");
    near(value(&found, "width1").unwrap(), 3.1512);
    assert_eq!(
        errors(
            &pocket(),
            &print.replace("SIZE X 80.0000", "SIZE X 81.0000")
        ),
        ["unclear-line"]
    );
}

/// A log as printed in HEIDENHAIN's guide: labels and values, on one line or on two. The job's unit may differ from that of the log.
#[test]
fn the_log_of_heidenhains_cycles_is_read() {
    let bore = job(
        r#"{ "format": 1, "control": { "post": "heidenhain", "form": "cycle" },
             "cycle": { "type": "hole-protected", "origin": [50, 65, 0], "diameter": 12 } }"#,
    );
    let log = "Measuring log for touch probe cycle 421 Hole measuring\n\nDate: 30-06-2005\nTime: 6:55:04\n\
        Measuring program: TNC:\\GEH35712\\CHECK1.H\nType of dimension (0 = MM / 1 = INCH): 0\n\
        Nominal values:\nCenter in reference axis: 50.0000\nCenter in minor axis: 65.0000\nDiameter: 12.0000\n\
        Given limit values:\nMaximum limit for center in reference axis: 50.1000\nMinimum limit for center in reference axis: 49.9000\n\
        Actual values:\nCenter in reference axis: 50.0810\nCenter in minor axis: 64.9530\nDiameter: 12.0259\n\
        Deviations:\nCenter in reference axis: 0.0810\n";
    let inch = touchpath::job::convert_units(&bore, "inch").unwrap();
    let apart = log
        .replace("axis: ", "axis:\n\n")
        .replace("Diameter: ", "Diameter:\n\n");
    for (job, unit) in [(&bore, 1.0), (&inch, 25.4)] {
        for text in [log.to_owned(), apart.clone(), log.replace('\n', "\r\n")] {
            let found = measured(job, &text);
            assert_eq!(codes(&found), [""; 0], "{text}");
            for (code, wanted) in [
                ("center.x", 50.081),
                ("center.y", 64.953),
                ("diameter", 12.0259),
            ] {
                assert!(
                    (value(&found, code).unwrap() - wanted / unit).abs() < 1e-6,
                    "{code}"
                );
            }
        }
    }
    assert_eq!(
        errors(
            &bore,
            &log.replace("Diameter: 12.0000", "Diameter: 14.0000")
        ),
        ["unclear-line"]
    );
    // An actual value with an unknown label, or without its nominal value, is not ignored.
    assert_eq!(
        errors(
            &bore,
            &log.replace("Diameter: 12.0259", "Roundness: 12.0259")
        ),
        ["unclear-line"]
    );
    assert_eq!(
        errors(&bore, &log.replace("Diameter: 12.0000\n", "")),
        ["unclear-line"]
    );
    // Lines outside the log are read as usual.
    assert_eq!(
        errors(&bore, &format!("{log}diameter=12.5\n")),
        ["result-twice"]
    );
    assert_eq!(
        errors(&bore, &format!("{log}[PRB:1.000,2.000,3.000:1]\n")),
        ["mixed-forms"]
    );
    // The same log in inch is for a bore that is 25 times larger.
    assert_eq!(
        errors(&bore, &log.replace("): 0", "): 1")),
        ["unclear-line"; 3]
    );
}

/// DPRNT prints the sign before the blanks, and no digit before the point.
#[test]
fn a_sign_stands_before_blanks() {
    let found = measured(
        &pocket(),
        "CENTER X=-    .1000\nCENTER Y=    .2000\nWIDTH1=  80.0400\nWIDTH2= 50.",
    );
    near(value(&found, "center.x").unwrap(), -0.1);
    near(value(&found, "center.y").unwrap(), 0.2);
}

#[test]
fn results_in_inch_are_in_inch() {
    let inch = touchpath::job::convert_units(&pocket(), "inch").unwrap();
    let found = measured(
        &inch,
        "center.x=0.0040\ncenter.y=0\nwidth1=3.15\nwidth2=1.9685",
    );
    let row = &found.results[2];
    assert_eq!((row.unit, row.value), ("inch", Some(3.15)));
    near(row.deviation.unwrap(), 3.15 - 80.0 / 25.4);
    // Millimetres for the same part are far out of reach.
    assert_eq!(
        errors(
            &inch,
            "center.x=0.1\ncenter.y=0.2\nwidth1=80.04\nwidth2=50.0"
        ),
        ["too-far", "too-far"]
    );
}

#[test]
fn the_shift_of_the_offset_follows_from_the_results() {
    let job = with(
        &with(&pocket(), "control.post", Value::Text("fanuc".into())),
        "control.workOffset",
        Value::Number(1.0),
    );
    let found = measured(
        &job,
        "CENTER.X=0.1\nCENTER.Y=0.2\nWIDTH1=80\nWIDTH2=50\nOFFSET.X=0.1\nOFFSET.Y=0.2",
    );
    near(value(&found, "offset.x").unwrap(), 0.1);
    near(value(&found, "offset.y").unwrap(), 0.2);
}

/// A diameter of 10H7 (0 to +0.015) of 10.02 is scrap for a hole, and 10.01 is good.
#[test]
fn printed_results_are_judged_as_measured_points_are() {
    let job = crate::common::jobs()
        .into_iter()
        .find(|(name, _)| name == "circles-tolerances")
        .unwrap()
        .1;
    let rows = plan(&job).unwrap().results;
    let limited = rows
        .iter()
        .find(|row| row.limits.is_some() && row.code == "Q966")
        .expect("a limited diameter");
    let [low, high] = limited.limits.unwrap();
    let with_diameter = |x: f64| -> String {
        let row = |row: &touchpath::job::ResultRow| {
            format!(
                "{}={}\n",
                row.code,
                if row.code == "Q966" {
                    x
                } else {
                    row.nominal.unwrap()
                }
            )
        };
        rows.iter()
            .filter(|row| row.nominal.is_some() && !row.code.starts_with("form"))
            .map(row)
            .collect()
    };
    let verdict = |x: f64| {
        let found = measured(&job, &with_diameter(x));
        let row = found
            .results
            .into_iter()
            .find(|row| row.code == "Q966")
            .unwrap();
        (row.limits, row.verdict)
    };
    assert_eq!(
        verdict((low + high) / 2.0),
        (Some([low, high]), Some("good".to_owned()))
    );
    assert_ne!(verdict(high + 0.1).1, Some("good".to_owned()));
}

#[test]
fn a_result_that_is_missing_is_unknown() {
    let found = measured(&pocket(), "center.x=0.1\nwidth1=80");
    assert_eq!(codes(&found), ["result-missing"]);
    assert_eq!(
        crate::common::values(&found.findings[0]),
        ["center.y, width2"]
    );
    let row = &found.results[1];
    assert_eq!(
        (row.value, row.deviation, row.uncertainty),
        (None, None, None)
    );
}

#[test]
fn points_by_their_letters() {
    let forms = [
        "X37.1 Y0 Z-10\nX-36.9 Y0. Z-10.\nX0 Y22.2 Z-10\nX0 Y-21.8 Z-10",
        "POCKET\nTOUCH 1: X37.1Y0Z-10\ntouch 2: x=-36.9 y=0 z=-10\nTOUCH 3 Z-10 X0 Y22.2\n4, X 0.000 Y- 21.8000 Z- 10.0000\nEND OF PROBE 1",
    ];
    for form in forms {
        let found = measured(&pocket(), form);
        near(value(&found, "center.x").unwrap(), 0.1);
        near(value(&found, "center.y").unwrap(), 0.2);
        assert!(found.findings.is_empty() && found.block.is_none(), "{form}");
    }
}

/// The raw output of LinuxCNC's interpreter: the program's output is mixed with the calls. There a touch runs to its end, 5 past the contact: the pocket is 10
/// wider.
#[test]
fn what_linuxcnc_prints_is_read_as_it_comes() {
    let job = with(
        &pocket(),
        "control",
        crate::common::job(r#"{ "post": "linuxcnc", "protection": "none", "report": "none" }"#),
    );
    let job = crate::common::unlimited(&job);
    let output = crate::common::canonical(&plan(&job).unwrap().program.text).join("\n");
    let found = measured(&job, &output);
    near(value(&found, "center.x").unwrap(), 0.0);
    near(value(&found, "width1").unwrap(), 90.0);
    near(value(&found, "width2").unwrap(), 60.0);
    assert!(found.findings.is_empty(), "{:?}", found.findings);
}

/// Codes differ in every spelling.
#[test]
fn no_two_results_of_a_job_have_one_name() {
    for (name, job) in crate::common::jobs() {
        let Ok(plan) = plan(&job) else { continue };
        let mut names: Vec<String> = plan
            .results
            .iter()
            .map(|row| row.code.to_lowercase().replace('.', ""))
            .collect();
        names.sort();
        assert!(
            names.windows(2).all(|pair| pair[0] != pair[1]),
            "{name}: {names:?}"
        );
    }
}
