//! Missing, repeated or ambiguous values are refused with their line, and nothing is guessed.

use super::{PRB, UGS, codes, errors, is_the_pocket, measured, pocket, value};
use crate::common::{values, with};
use touchpath::form::Value;
use touchpath::job::{measure, plan};

/// With the offset in which the touches were made.
fn log(touches: &[&str]) -> String {
    format!(
        "G54\nWCO:-200.000,-150.000,-60.000\n{}\n",
        touches.join("\n")
    )
}

/// Code and values of the refusal of a text.
fn refusal(text: &str) -> (String, Vec<String>) {
    let error = measure(&pocket(), &Value::Text(text.to_owned())).expect_err(text);
    let [only] = &error.findings[..] else {
        panic!("{text}: {error:?}")
    };
    (only.code.clone(), values(only))
}

#[test]
fn without_a_work_offset_it_is_asked_for() {
    let touches = PRB.join("\n");
    assert_eq!(errors(&pocket(), &touches), ["work-offset-needed"]);
    // An offset by its name needs its numbers, and the numbers need the name.
    assert_eq!(
        errors(&pocket(), &format!("G54\n{touches}")),
        ["work-offset-needed"]
    );
    let answer = "[G54:-200.000,-150.000,-60.000]\n[G55:0.000,0.000,0.000]\n[G92:0.000,0.000,0.000]\n[TLO:0.000]\nok\n";
    assert_eq!(
        errors(&pocket(), &format!("{answer}{touches}")),
        ["work-offset-needed"]
    );
    // The answer has no G55, which was active.
    let (code, of) = refusal(&format!("G55\n[G54:-200.000,-150.000,-60.000]\n{touches}"));
    assert_eq!(
        (code.as_str(), of[0].as_str()),
        ("work-offset-needed", "G55")
    );
    is_the_pocket(&measured(&pocket(), &format!("G54\n{answer}{touches}")));
}

#[test]
fn two_work_offsets_are_not_mixed() {
    let [a, b, c, d] = PRB;
    let moved = "<Idle|MPos:0.000,0.000,0.000|WCO:-201.000,-150.000,-60.000>";
    assert_eq!(
        errors(&pocket(), &log(&[a, b, moved, c, d])),
        ["work-offset-unclear"]
    );
    assert_eq!(
        errors(&pocket(), &log(&[a, b, ">>> G55", c, d])),
        ["work-offset-unclear"]
    );
    assert_eq!(
        errors(&pocket(), &log(&[a, b, ">>> G10 L20 P1 X0", c, d])),
        ["work-offset-unclear"]
    );
    let answer = "[G54:-201.000,-150.000,-60.000]\n[G92:0.000,0.000,0.000]\n[TLO:0.000]\nok";
    assert_eq!(
        errors(&pocket(), &log(&[answer, a, b, c, d])),
        ["work-offset-unclear"]
    );
    // Values from before a change do not hold after it.
    let stale = format!(
        "WCO:-200.000,-150.000,-60.000\n>>> G10 L20 P1 X0\nok\n{}",
        PRB.join("\n")
    );
    assert_eq!(errors(&pocket(), &stale), ["work-offset-needed"]);
    let selected = format!(
        "[GC:G0 G54]\nWCO:-200.000,-150.000,-60.000\n>>> G55\nok\n{}",
        PRB.join("\n")
    );
    assert_eq!(errors(&pocket(), &selected), ["work-offset-needed"]);
}

#[test]
fn a_missed_touch_is_said_by_its_line() {
    let [a, b, ..] = PRB;
    let missed = measured(
        &pocket(),
        &log(&[a, b, "[PRB:-236.900,-150.000,-70.000:0]", "ALARM:5"]),
    );
    assert_eq!(
        codes(&missed),
        ["converted", "touch-missed", "touch-missed", "no-block"]
    );
    assert_eq!(missed.findings[1].path, "measured[2]");
    assert_eq!(
        values(&missed.findings[1]),
        ["3", "5"],
        "the touch and its line"
    );
    assert_eq!(
        values(&missed.findings[2]),
        ["3", "4"],
        "so many were made of so many"
    );
    assert_eq!(missed.points[2..], [None, None]);
    super::near(value(&missed, "center.x").unwrap(), 0.1);
    assert_eq!(
        (
            value(&missed, "center.y"),
            value(&missed, "width2"),
            missed.block
        ),
        (None, None, None)
    );
}

#[test]
fn too_few_and_too_many_reports_are_counted() {
    let [a, b, c, d] = PRB;
    let counted = |text: &str, said: &[&str]| {
        let (code, of) = refusal(text);
        assert_eq!(
            (code.as_str(), of),
            (
                "wrong-count",
                said.iter().map(|own| (*own).to_owned()).collect()
            ),
            "{text}"
        );
    };
    counted(&log(&[a, b, c]), &["3", "4"]);
    counted(&log(&[a, b, c, d, a]), &["5", "4"]);
    // The repetition in $# is no touch, and the message gives its line.
    counted(&log(&[a, b, c, "[TLO:0.000]", d, "ok"]), &["3", "4", "7"]);
    // A run that missed, and the next one.
    assert_eq!(
        errors(
            &pocket(),
            &log(&[a, "[PRB:0.000,0.000,0.000:0]", a, b, c, d])
        ),
        ["unclear-line"]
    );
    assert_eq!(
        errors(&pocket(), &log(&[a, "[PRB:0.000,0.000,0.000:0]", c, d])),
        ["unclear-line"]
    );
}

#[test]
fn an_echo_counts_once_and_half_an_echo_is_refused() {
    let both: Vec<String> = PRB
        .iter()
        .flat_map(|line| [format!("<<< {line}"), (*line).to_owned()])
        .collect();
    let both: Vec<&str> = both.iter().map(String::as_str).collect();
    is_the_pocket(&measured(&pocket(), &log(&both)));
    // One touch appears in two ways, and another is missing: counting lines would have used the echo for the missing one.
    let half = [both[0], both[1], both[2], both[4]];
    assert_eq!(errors(&pocket(), &log(&half)), ["unclear-line"]);
}

#[test]
fn lines_that_could_be_measurements_are_refused() {
    let [a, b, c, d] = PRB;
    for line in ["1.0, 2.0, -3.0", "17.5", "-5 0 0 1 2 3 4 5 6"] {
        assert_eq!(
            errors(&pocket(), &log(&[a, b, line, c, d])),
            ["unclear-line"],
            "{line}"
        );
    }
    for line in ["X1 Y2 Z3", "center.x=0.1", "CENTER X= 1.000"] {
        assert_eq!(
            errors(&pocket(), &log(&[a, b, line, c, d])),
            ["mixed-forms"],
            "{line}"
        );
    }
    for line in [
        "[PRB:1,2:1]",
        "[PRB:1,2,3]",
        "[PRB:1,2,3:2]",
        "[PRB:1,2,x:1]",
        "[PRB:1,2,3:1",
        "[PRB:1e9,2,3:1]",
    ] {
        assert_eq!(
            errors(&pocket(), &log(&[a, b, c, line]))
                .first()
                .map(String::as_str),
            Some("unclear-line"),
            "{line}"
        );
    }
    // Lines that are clearly no measurements are ignored.
    for line in [
        "ok",
        "[MSG:Check limits]",
        "Feed=100",
        "$110=500.000 (x:max)",
        "$/axes/x/steps_per_mm=80",
        "Sent 12 of 40",
        "(X1 Y2 Z3)",
        ">>> X1 Y2 Z3",
        "***",
    ] {
        is_the_pocket(&measured(&pocket(), &log(&[a, b, line, c, d])));
    }
    assert_eq!(errors(&pocket(), "center.x=1\nX1 Y2 Z3"), ["mixed-forms"]);
    assert_eq!(errors(&pocket(), "center.x=0.1\n1,2,3"), ["unclear-line"]);
    assert_eq!(
        errors(&pocket(), "X37 Y0 Z-10\n1,2,3\nX37 Y0\nG1 X3 Y3 Z3"),
        ["unclear-line", "unclear-line", "unclear-line", "too-far"][..3]
    );
}

#[test]
fn results_that_cannot_be_of_the_job_are_refused() {
    assert_eq!(
        errors(&pocket(), "corner.x=1\nCORNER Y=2"),
        ["unknown-result", "unknown-result"]
    );
    assert_eq!(
        errors(&pocket(), "center.x=0.1\ncenter.x=0.2"),
        ["result-twice"]
    );
    assert_eq!(
        errors(&pocket(), "center.x=0.1\ncenter.y=nan"),
        ["not-a-number"]
    );
    assert_eq!(
        errors(&pocket(), "center.x=0,1,2\nwidth1=1e99"),
        ["not-a-number", "not-a-number"]
    );
    assert_eq!(errors(&pocket(), "center.x=0.1 mm"), ["not-a-number"]);
    // 120 from the nominal centre no touch reaches, and a value with another name is not confused with one of the same ending.
    assert_eq!(errors(&pocket(), "center.x=120"), ["too-far"]);
    assert_eq!(errors(&pocket(), "old_center.x=0.1"), ["unknown-result"]);
}

/// The block is correct only with the ball at the end of the path.
#[test]
fn no_block_where_the_machine_may_have_moved() {
    for (line, why) in [
        (">>> $J=G91 X10 F500", "moves the machine"),
        (">>> G0 X10", "moves the machine after the end"),
        (
            "<Idle|MPos:-190.000,-150.000,-30.000|FS:0,0>",
            "another position",
        ),
        ("<Idle|WPos:10.000,0.000,30.000|FS:0,0>", "another position"),
        ("ALARM:3", "an alarm or an error"),
        ("error:9", "an alarm or an error"),
        (">>> G10 L20 P1 X0", "changes an offset"),
        ("Grbl 1.1h ['$' for help]", "changes an offset"),
    ] {
        let found = measured(&pocket(), &format!("{UGS}{line}\n"));
        is_the_pocket(&found);
        assert_eq!(found.block, None, "{line}");
        let last = found.findings.last().unwrap();
        assert!(
            last.code == "no-block" && last.message.contains(why),
            "{line}: {}",
            last.message
        );
    }
    // Nor if another control's program wrote the offset, or if points were given without a log.
    let other = with(&pocket(), "control.post", Value::Text("linuxcnc".into()));
    assert_eq!(measured(&other, UGS).block, None);
    assert_eq!(
        measured(&pocket(), "37,0,-10\n-37,0,-10\n0,22,-10\n0,-22,-10").block,
        None
    );
}

#[test]
fn reports_in_inch_are_found_or_asked_for() {
    // The same touches in inch, as grbl prints them under $13=1: −162.9 mm is −6.4134 inch.
    let inch = |line: &str| {
        let numbers: Vec<f64> = line[5..line.len() - 3]
            .split(',')
            .map(|x| x.parse::<f64>().unwrap() / 25.4)
            .collect();
        format!(
            "[PRB:{:.4},{:.4},{:.4}:1]",
            numbers[0], numbers[1], numbers[2]
        )
    };
    let touches = PRB.map(inch).join("\n");
    let wco = "G54\nWCO:-7.8740,-5.9055,-2.3622\n";
    assert!(touches.starts_with("[PRB:-6.4134,-5.9055,-2.7559:1]"));
    for (log, found_out) in [
        (format!("$13=1\n{wco}{touches}"), false),
        (format!("{wco}{touches}"), true),
    ] {
        for job in [
            pocket(),
            touchpath::job::convert_units(&pocket(), "inch").unwrap(),
        ] {
            let found = measured(&job, &log);
            let units = if codes(&found).contains(&"converted") && found.results[0].unit == "inch" {
                25.4
            } else {
                1.0
            };
            // Rounded to 0.0001 inch, 0.0025 mm.
            assert!(
                (value(&found, "center.x").unwrap() * units - 0.1).abs() < 3e-3,
                "{found:?}"
            );
            assert_eq!(codes(&found).contains(&"units-found"), found_out, "{log}");
            let unit = if units == 1.0 { "G21" } else { "G20" };
            assert!(
                found
                    .block
                    .as_deref()
                    .unwrap()
                    .starts_with(&format!("{unit} G10 L20 P1 X-0.")),
                "{found:?}"
            );
        }
    }
    // An inch job on a grbl in mm, as most are: the reports are in mm.
    let inch_job = touchpath::job::convert_units(&pocket(), "inch").unwrap();
    let found = measured(&inch_job, UGS);
    assert!((value(&found, "center.x").unwrap() - 0.1 / 25.4).abs() < 1e-6);
    assert_eq!(
        found.block.as_deref(),
        Some("G20 G10 L20 P1 X-0.0039 Y-0.0079")
    );
    assert!(codes(&found).contains(&"units-found"));
    assert!(!codes(&measured(&inch_job, &format!("$13=0\n{UGS}"))).contains(&"units-found"));
    assert_eq!(errors(&pocket(), &format!("$13=1\n{UGS}")), ["too-far"; 4]);
    assert_eq!(
        errors(&inch_job, &UGS.replace("WCO:-200", "WCO:-100")),
        ["too-far"]
    );
    assert_eq!(
        errors(&pocket(), &format!("$13=1\n{UGS}$13=0\n")),
        ["units-unclear"]
    );
}

/// A surface at X0 touched at the origin: 0.1 off is in reach as mm and as inch.
#[test]
fn where_mm_and_inch_are_both_in_reach_an_inch_job_is_asked() {
    let touch = r#"{ "format": 1, "units": "inch", "stylus": { "diameter": 0 }, "control": { "post": "grbl" }, "overtravel": 0.2,
        "cycle": { "type": "surface", "touches": [{ "point": [0, 0, 0], "vector": [1, 0, 0] }] } }"#;
    let job = crate::common::job(touch);
    assert!(plan(&job).is_ok(), "{:?}", plan(&job).unwrap_err().findings);
    assert_eq!(
        errors(&job, "G54\nWCO:0,0,0\n[PRB:0.100,0.000,0.000:1]"),
        ["units-unclear"]
    );
    let found = measured(&job, "G54\n$13=1\nWCO:0,0,0\n[PRB:0.1000,0.0000,0.0000:1]");
    assert_eq!(found.points, [Some([0.1, 0.0, 0.0])]);
}

#[test]
fn a_text_that_is_no_measurement_at_all_is_refused_in_words() {
    assert_eq!(errors(&pocket(), "")[..], ["wrong-count"]);
    assert_eq!(
        errors(&pocket(), "[GC:G0 G54]\nok")
            .last()
            .map(String::as_str),
        Some("not-a-number")
    );
    for text in [
        "PRB:",
        "[PRB:",
        "[[[[<<<<",
        "=",
        "===",
        "center.x=",
        "X",
        "XYZ",
        "X1Y",
        "(((",
        "[PRB:1,2,3:1]=X",
        "\u{0}=\u{0}",
        "é=1",
        "Xé1 Y2 Z3",
        "X1é",
        "WCO:",
        "[G54:]",
        "[TLO:]",
        "$13=",
        "<Idle|MPos:",
        ">\u{301}",
    ] {
        assert!(
            measure(&pocket(), &Value::Text(text.to_owned())).is_err(),
            "{text}"
        );
    }
}

/// Each line is read once: these take a moment, and some would take hours if the end of a bracket were searched.
#[test]
fn long_lines_of_brackets_do_not_hang() {
    for part in [
        "[",
        "<",
        "<Idle|",
        "[TLO:",
        "PRB:",
        "[PRB:1,2,3:1] ",
        "PRB:1,2,3:1 ",
        "a=",
        "a=1 ",
        "X1",
        "X",
        "(",
        "(a",
        "G54 ",
        "WCO:",
        "WCO:1,2,3 ",
        "1",
        "1,",
        "[PRB:1,2,3:1]\n",
    ] {
        let text = part.repeat(100_000 / part.len());
        for text in [text.clone(), format!("[PRB:1,2,3:1]\n{text}")] {
            let begun = std::time::Instant::now();
            let _ = measure(&pocket(), &Value::Text(text));
            assert!(
                begun.elapsed().as_secs() < 20,
                "{part}: {:?}",
                begun.elapsed()
            );
        }
    }
    let kinds: String = (0..60_000)
        .map(|i| {
            format!(
                "{}[PRB:1,2,3:1]\n",
                "ab".chars()
                    .cycle()
                    .skip(i % 2)
                    .take(i % 97)
                    .collect::<String>()
            )
        })
        .collect();
    assert!(measure(&pocket(), &Value::Text(kinds)).is_err());
}
