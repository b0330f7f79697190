//! Print-outs of machines become results, and on grbl the block to type. Every number here is computed by hand.

mod laws;
mod printed;
mod refused;

use crate::common::{job, planned, values, with};
use touchpath::form::{Level, Value};
use touchpath::job::{Measurement, measure};

/// A pocket of 80 × 50 about the origin, 10 deep, a ball of 6: nominal contacts at X±37 and Y±22, Z−10; the path ends at X0 Y0 Z30.
fn pocket() -> Value {
    job(
        r#"{ "format": 1, "control": { "post": "grbl" }, "cycle": { "type": "internal-rectangle-protected" } }"#,
    )
}

fn measured(job: &Value, text: &str) -> Measurement {
    measure(job, &Value::Text(text.to_owned()))
        .unwrap_or_else(|error| panic!("{text}\n{:#?}", error.findings))
}

/// Codes of the errors.
fn errors(job: &Value, text: &str) -> Vec<String> {
    let error = measure(job, &Value::Text(text.to_owned())).expect_err(text);
    error
        .findings
        .iter()
        .filter(|f| f.level == Level::Error)
        .map(|f| f.code.clone())
        .collect()
}

fn codes(measurement: &Measurement) -> Vec<&str> {
    measurement
        .findings
        .iter()
        .map(|f| f.code.as_str())
        .collect()
}

fn value(measurement: &Measurement, code: &str) -> Option<f64> {
    measurement
        .results
        .iter()
        .find(|row| row.code == code)
        .unwrap_or_else(|| panic!("no {code}"))
        .value
}

#[track_caller]
fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} is not {b}");
}

/// The same four touches in every log here: walls 0.1 further in X, 0.2 further in Y, by hand 37.1, −36.9, 22.2, −21.8 in work coordinates, and
/// G54 at X−200 Y−150 Z−60.
const PRB: [&str; 4] = [
    "[PRB:-162.900,-150.000,-70.000:1]",
    "[PRB:-236.900,-150.000,-70.000:1]",
    "[PRB:-200.000,-127.800,-70.000:1]",
    "[PRB:-200.000,-171.800,-70.000:1]",
];

/// Centre and widths of these touches: 37.1 − 36.9 = 0.2, half of it; 74 + 6 wide; 44 + 6.
fn is_the_pocket(measurement: &Measurement) {
    near(value(measurement, "center.x").unwrap(), 0.1);
    near(value(measurement, "center.y").unwrap(), 0.2);
    near(value(measurement, "width1").unwrap(), 80.0);
    near(value(measurement, "width2").unwrap(), 50.0);
    assert_eq!(measurement.points[1], Some([-36.9, 0.0, -10.0]));
}

/// As UGS shows it: sent lines after `>>> `, answers and reports as they arrive.
const UGS: &str = "\
Grbl 1.1h ['$' for help]
>>> $G
[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]
ok
<Idle|MPos:-200.000,-150.000,-20.000|FS:0,0|WCO:-200.000,-150.000,-60.000>
>>> (Measures only: each touch is reported as PRB in machine coordinates)
ok
>>> G21
ok
>>> G17 G40 G61 G80 G90 G94
ok
>>> G1 X0 Y0 F2000
ok
<Run|MPos:-200.000,-150.000,-30.000|FS:2000,0>
>>> G38.2 X42 F150
[PRB:-162.900,-150.000,-70.000:1]
ok
>>> G1 X29 F1000
ok
>>> G38.2 X-42 F150
[PRB:-236.900,-150.000,-70.000:1]
ok
>>> G38.2 Y27 F150
[PRB:-200.000,-127.800,-70.000:1]
ok
>>> G38.2 Y-27 F150
[PRB:-200.000,-171.800,-70.000:1]
ok
>>> G1 Z30 F2000
ok
>>> M2
[MSG:Pgm End]
ok
<Idle|MPos:-200.000,-150.000,-30.000|FS:0,0>
";

#[test]
fn a_log_of_ugs_gives_results_and_the_block() {
    let found = measured(&pocket(), UGS);
    is_the_pocket(&found);
    // The ball is at X0 Y0, and the measured centre at 0.1, 0.2 must read 0: the ball then reads −0.1, −0.2.
    assert_eq!(found.block.as_deref(), Some("G21 G10 L20 P1 X-0.1 Y-0.2"));
    assert_eq!(codes(&found), ["converted", "block-to-type"]);
    assert_eq!(values(&found.findings[0]), ["5", "X-200 Y-150 Z-60", "mm"]);
}

/// Reports of a control for the pocket's program: for each `G38.3` its end, and `:0`; the touches of [`PRB`].
fn reports() -> Vec<(bool, String)> {
    let plan = planned(&pocket());
    let mut touches = PRB.iter();
    let reports = plan
        .moves
        .iter()
        .zip(&plan.program.move_lines)
        .filter_map(|(step, line)| {
            match plan
                .program
                .text
                .lines()
                .nth(*line as usize)?
                .split(' ')
                .next()?
            {
                "G38.2" => Some((true, (*touches.next().unwrap()).to_owned())),
                "G38.3" => {
                    let [x, y, z] = step.to;
                    Some((
                        false,
                        format!("[PRB:{:.3},{:.3},{:.3}:0]", x - 200.0, y - 150.0, z - 60.0),
                    ))
                }
                _ => None,
            }
        });
    reports.collect()
}

fn log_of<'a>(reports: impl IntoIterator<Item = &'a str>) -> String {
    let reports: Vec<&str> = reports.into_iter().collect();
    format!(
        "G54\nWCO:-200.000,-150.000,-60.000\n{}\n",
        reports.join("\nok\n")
    )
}

/// Each positioning move is reported, too: a miss there is not a missed touch.
#[test]
fn the_reports_of_watched_positioning_are_no_touches() {
    let reports = reports();
    assert!(
        reports.iter().filter(|(touch, _)| !touch).count() > 4,
        "{reports:?}"
    );
    let found = measured(
        &pocket(),
        &log_of(reports.iter().map(|(_, report)| report.as_str())),
    );
    is_the_pocket(&found);
    assert_eq!(codes(&found), ["converted", "block-to-type"]);
    // The last report is that of a missed touch.
    for (k, (at, _)) in reports
        .iter()
        .enumerate()
        .filter(|(_, (touch, _))| *touch)
        .enumerate()
    {
        let missed = reports[at].1.replace(":1]", ":0]");
        let log = log_of(
            reports[..at]
                .iter()
                .map(|(_, report)| report.as_str())
                .chain([missed.as_str(), "ALARM:5"]),
        );
        let found = measured(&pocket(), &log);
        assert_eq!(found.findings[1].code, "touch-missed", "{log}");
        assert_eq!(values(&found.findings[1])[0], (k + 1).to_string(), "{log}");
        assert_eq!(
            found.points.iter().filter(|point| point.is_some()).count(),
            k,
            "{log}"
        );
    }
}

/// A contact in positioning does not count as the touch.
#[test]
fn a_contact_in_positioning_is_no_touch() {
    let reports = reports();
    for (at, _) in reports.iter().enumerate().filter(|(_, (touch, _))| !touch) {
        let met = reports[at].1.replace(":0]", ":1]");
        let before = || {
            reports[..at]
                .iter()
                .map(|(_, report)| report.as_str())
                .chain([met.as_str()])
        };
        for log in [log_of(before()), log_of(before().chain(["ALARM:4"]))] {
            let refused = measure(&pocket(), &Value::Text(log.clone())).expect_err(&log);
            let codes: Vec<&str> = refused
                .findings
                .iter()
                .map(|finding| finding.code.as_str())
                .collect();
            assert!(
                matches!(codes[..], ["unclear-line"] | ["wrong-count"]),
                "{log}{codes:?}"
            );
        }
        // A sender that logs only the contacts, and the alarm.
        let contacts = log_of(
            before()
                .filter(|report| report.ends_with(":1]"))
                .chain(["ALARM:4"]),
        );
        assert!(
            measure(&pocket(), &Value::Text(contacts.clone())).is_err(),
            "{contacts}"
        );
    }
}

/// With $10=0 a control reports positions of the work system: X0 Y0 Z30 is the end of the program. As a machine position it would be 250 mm away, and there
/// would be no block.
#[test]
fn a_status_in_work_coordinates_says_where_the_ball_stands() {
    let at_the_end = measured(
        &pocket(),
        &format!("{UGS}<Idle|WPos:0.000,0.000,30.000|FS:0,0>\n"),
    );
    assert_eq!(
        at_the_end.block.as_deref(),
        Some("G21 G10 L20 P1 X-0.1 Y-0.2")
    );
    let elsewhere = measured(
        &pocket(),
        &format!("{UGS}<Idle|WPos:-200.000,-150.000,-30.000|FS:0,0>\n"),
    );
    assert_eq!(
        elsewhere.block, None,
        "the place of the machine is none of the work system"
    );
}

/// Prompts and times as senders have them: cncjs `<`, bCNC times, Candle's answers behind the block, ioSender without prompts.
#[test]
fn logs_of_other_senders() {
    let wco = "<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:-200.000,-150.000,-60.000>";
    let with = |each: &dyn Fn(usize, &str) -> String| {
        let lines: Vec<String> = PRB
            .iter()
            .enumerate()
            .map(|(i, line)| each(i, line))
            .collect();
        format!("G54\n{wco}\n{}\n", lines.join("\n"))
    };
    let logs = [
        with(&|_, line| format!("cncjs> G38.2 X42 F150\n< {line}\n< ok")),
        with(&|i, line| {
            format!(
                "1{i}:22:3{i} >>> G38.2 X4{i} F150\n1{i}:22:4{i} <<< {line}\n1{i}:22:4{i} <<< ok"
            )
        }),
        with(&|_, line| format!("G38.2 X42 F150 < {line} / ok")),
        with(&|_, line| format!("[14:03:59.{:03}] {line}", 7)),
        with(&|_, line| line.trim_matches(['[', ']']).to_owned()),
        // grblHAL and FluidNC with further axes.
        with(&|_, line| line.replace(":1]", ",0.000,12.500:1]")),
        with(&|_, line| line.replace(":1]", ",0.000:1]")).replace(",-60.000>", ",-60.000,5.000>"),
        format!("\u{feff}{}", with(&|_, line| format!("{line}\r"))),
    ];
    for log in logs {
        let found = measured(&pocket(), &log);
        is_the_pocket(&found);
        assert_eq!(
            found.block.as_deref(),
            Some("G21 G10 L20 P1 X-0.1 Y-0.2"),
            "{log}"
        );
    }
}

/// The sum of `$#`: G55 −203.5, −150, −50; G92 3, 0, 0; TLO −10 along Z, so −200.5, −150, −60. Its PRB line repeats the last touch.
#[test]
fn the_answer_to_settings_says_the_work_offset() {
    let touches = PRB
        .join("\nok\n")
        .replace("-162.900", "-163.400")
        .replace("-236.900", "-237.400");
    let answer = "[G54:0.000,0.000,0.000]\n[G55:-203.500,-150.000,-50.000]\n[G56:1.000,2.000,3.000]\n[G57:0.000,0.000,0.000]\n\
        [G58:0.000,0.000,0.000]\n[G59:0.000,0.000,0.000]\n[G28:0.000,0.000,0.000]\n[G30:0.000,0.000,0.000]\n\
        [G92:3.000,0.000,0.000]\n[TLO:-10.000]\n[PRB:-200.000,-171.800,-70.000:1]\nok\n";
    for log in [
        format!("G55\n{answer}{touches}"),
        format!("G55\n{touches}\nok\n{answer}"),
    ] {
        let found = measured(&pocket(), &log);
        is_the_pocket(&found);
        assert_eq!(
            found.block.as_deref(),
            Some("G21 G10 L20 P2 X-0.1 Y-0.2"),
            "{log}"
        );
        assert_eq!(
            values(&found.findings[0])[0],
            "G55",
            "made of it, G92 and TLO"
        );
    }
    // grblHAL reports three axes of TLO, and the active offset in its status reports.
    let hal = answer.replace("[TLO:-10.000]", "[TLO:0.000,0.000,-10.000]\n[TLR:0.000]");
    let status = "<Idle|MPos:0.000,0.000,0.000|WCS:G55>";
    is_the_pocket(&measured(
        &pocket(),
        &format!("{status}\n{touches}\nok\n{hal}"),
    ));
    // WCO alone contains no number; with $# it does: only G55 matches it.
    let wco = "<Idle|MPos:0.000,0.000,0.000|WCO:-200.500,-150.000,-60.000>";
    let found = measured(&pocket(), &format!("{wco}\n{touches}\nok\n{answer}"));
    assert_eq!(found.block.as_deref(), Some("G21 G10 L20 P2 X-0.1 Y-0.2"));
    let alone = measured(&pocket(), &format!("{wco}\n{touches}"));
    is_the_pocket(&alone);
    assert_eq!(
        (alone.block.as_deref(), codes(&alone)),
        (None, vec!["converted", "no-block"])
    );
}

/// After its end a program's work offset is G54 again: P0 would then write G54, and `WCO` is that of G54.
#[test]
fn the_end_of_a_program_makes_g54_active() {
    let touches = PRB.join("\nok\n");
    let ended = "M2\nok\n[MSG:Pgm End]\n[GC:G1 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]\n\
        <Idle|MPos:-200.000,-150.000,-30.000|WCO:-200.000,-150.000,-60.000>\n";
    assert_eq!(
        errors(&pocket(), &format!("{touches}\n{ended}")),
        ["work-offset-needed"]
    );
    assert_eq!(
        errors(&pocket(), &format!("G55\n{touches}\n{ended}")),
        ["work-offset-needed"]
    );
    is_the_pocket(&measured(&pocket(), &format!("G54\n{touches}\n{ended}")));
    // A sender is some lines ahead: with one touch the end is sent before the touch is reported.
    let surface = with(&pocket(), "cycle", job(r#"{ "type": "surface" }"#));
    let contact = touchpath::job::plan(&surface).unwrap().triggers[0].unwrap();
    let report = format!(
        "[PRB:{},{},{}:1]",
        contact[0] - 200.0,
        contact[1] - 150.0,
        contact[2] - 60.0
    );
    let ahead = format!(
        "[GC:G0 G55]\nWCO:-200,-150,-60\n>>> G38.2 X9 F150\n>>> G1 Z50\n>>> M2\nok\n{report}\nok\nok\n"
    );
    assert!(
        measured(&surface, &ahead)
            .block
            .unwrap()
            .starts_with("G21 G10 L20 P2 ")
    );
    // An earlier program has ended in G54 as well, on grbl; others keep the offset, so it must be entered.
    let before = "[GC:G0 G55 G17 G21 G90]\nM30\nok\n<Idle|MPos:0.000,0.000,0.000|WCO:-200.000,-150.000,-60.000>\n";
    let found = measured(&pocket(), &format!("{before}{touches}"));
    assert_eq!(
        (found.block, found.findings.last().unwrap().code.as_str()),
        (None, "no-block")
    );
    // The first line of the user counts, a block in the log does not.
    assert!(
        measured(&pocket(), &format!("G55\n{before}{touches}"))
            .block
            .unwrap()
            .starts_with("G21 G10 L20 P2 ")
    );
    assert_eq!(
        measured(&pocket(), &format!("G55\nok\n{before}{touches}")).block,
        None
    );
}

/// Effect of the block on a control: G10 L20 sets the offset to the machine position minus the value, so the measured datum reads its nominal value.
#[test]
fn after_the_block_the_measured_place_reads_its_nominal() {
    let off = with(
        &pocket(),
        "cycle.origin",
        Value::List([5.0, 7.0, 2.0].map(Value::Number).to_vec()),
    );
    // The same part for this job: every touch 5, 7, 2 further; nominal centre 5, 7, and the path ends at X5 Y7 Z32.
    let shifted = PRB.map(|line| {
        let numbers: Vec<f64> = line[5..line.len() - 3]
            .split(',')
            .map(|x| x.parse().unwrap())
            .collect();
        format!(
            "[PRB:{:.3},{:.3},{:.3}:1]",
            numbers[0] + 5.0,
            numbers[1] + 7.0,
            numbers[2] + 2.0
        )
    });
    let log = format!("G54\nWCO:-200,-150,-60\n{}\n", shifted.join("\n"));
    let found = measured(&off, &log);
    assert_eq!(found.block.as_deref(), Some("G21 G10 L20 P1 X4.9 Y6.8"));
    // By hand: the machine is at 5 − 200 = −195, the offset becomes −195 − 4.9 = −199.9, and the centre, measured at 5.1 − 200 = −194.9,
    // reads −194.9 + 199.9 = 5.
    let machine = 5.0 - 200.0;
    let offset = machine - 4.9;
    near((value(&found, "center.x").unwrap() - 200.0) - offset, 5.0);
}
