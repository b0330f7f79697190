//! Lines of the shop in a program: where they are, which ones are refused, and that the program around them stays the proven one.

use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{import, interpret, job, jobs, law, number, on_virtual_part, planned, with};
use touchpath::config::Config;
use touchpath::control::POSTS;
use touchpath::control::shop::coded::{decoded, encoded};
use touchpath::control::shop::place::CHOICES;
use touchpath::form::{Finding, Level, Value};
use touchpath::import::insert::insert;
use touchpath::job::{Plan, check_program, default_job, plan};

fn lines(lines: &[&str]) -> Value {
    Value::List(
        lines
            .iter()
            .map(|line| Value::Text((*line).to_owned()))
            .collect(),
    )
}

fn with_lines(job: &Value, places: &[(&str, &[&str])]) -> Value {
    let entries = places
        .iter()
        .map(|(place, own)| ((*place).to_owned(), lines(own)));
    with(job, "machine.frame", Value::Map(entries.collect()))
}

/// A bore with a tool number, in moves if the control supports them.
fn bore(post: &str) -> Value {
    let job = default_job("hole").expect("a cycle");
    let job = with(&job, "control.post", Value::Text(post.to_owned()));
    let job = with(&job, "control.tool", number(7.0));
    let moves = with(&job, "control.form", Value::Text("moves".to_owned()));
    match plan(&moves) {
        Ok(_) => moves,
        Err(_) => with(&job, "control.form", Value::Text("cycle".to_owned())),
    }
}

/// Findings about the lines, whether the job is planned or not.
fn found(job: &Value) -> Vec<Finding> {
    let all = match plan(job) {
        Ok(plan) => plan.findings,
        Err(error) => error.findings,
    };
    all.into_iter()
        .filter(|finding| finding.code.starts_with("shop-line"))
        .collect()
}

/// Lines that every control has: a comment with the place, and a stop.
fn marked(post: &str, place: &str) -> Vec<String> {
    let comment = match post {
        "heidenhain" | "sinumerik" => format!("; at {place}"),
        _ => format!("(AT {})", place.to_uppercase()),
    };
    let stop = if post == "heidenhain" { "STOP" } else { "M1" };
    vec![comment, stop.to_owned()]
}

/// The blocks without the shop's lines, the job in the header and its hash.
fn around(plan: &Plan) -> Vec<String> {
    let mut skipped = 0;
    let text = plan.program.text.lines();
    let code = |line: &str| {
        let bare = line.trim_start_matches(|c: char| c.is_ascii_digit()).trim();
        let bare = if plan.program.post == "heidenhain" {
            bare
        } else {
            line
        };
        // With lines of the shop, something may have moved.
        bare.to_lowercase().replace(". nothing has moved", "")
    };
    text.map(code)
        .filter(|line| {
            if line.contains("shop's lines, ") {
                skipped = 2;
                return false;
            }
            skipped -= i32::from(skipped > 0);
            let header = ["job ", "blocks below", "from this job"];
            let own = line.contains("at ") && skipped > 0;
            let stops = line.ends_with("m1") || line.ends_with("stop");
            !(own || stops || header.iter().any(|word| line.contains(word)))
        })
        .collect()
}

/// For every job of the repository, control and form: the lines are at their places, the rest of the program keeps its blocks, and the header gives the job back.
#[test]
fn lines_change_nothing_else() {
    let mut counted = 0;
    for (name, value) in jobs() {
        for post in POSTS {
            for form in ["moves", "cycle"] {
                let own = with(&value, "control.post", Value::Text(post.key.to_owned()));
                let own = with(&own, "control.form", Value::Text(form.to_owned()));
                let own = with(&own, "control.header", Value::Text("full".to_owned()));
                let Ok(before) = plan(&own) else { continue };
                let each: Vec<(&str, Vec<String>)> = CHOICES
                    .iter()
                    .map(|place| (place.value, marked(post.key, place.value)))
                    .collect();
                let places: Vec<(&str, Vec<&str>)> = each
                    .iter()
                    .map(|(place, own)| (*place, own.iter().map(String::as_str).collect()))
                    .collect();
                let places: Vec<(&str, &[&str])> = places
                    .iter()
                    .map(|(place, own)| (*place, &own[..]))
                    .collect();
                let given = with_lines(&own, &places);
                let after = planned(&given);
                let what = format!("{name} {} {form}", post.key);
                assert_eq!(around(&before), around(&after), "{what}");
                assert_eq!(
                    before.program.proof.is_some(),
                    after.program.proof.is_some(),
                    "{what}"
                );
                assert_eq!(before.moves, after.moves, "{what}");
                let text = after.program.text.to_lowercase();
                let at = |place: &str| text.find(&format!("at {}", place.to_lowercase()));
                let order: Vec<usize> = [
                    "head",
                    "probeOn",
                    "beforeFirstMove",
                    "beforeWrite",
                    "probeOff",
                    "foot",
                ]
                .into_iter()
                .filter_map(at)
                .collect();
                assert!(
                    order.is_sorted() && order.len() >= 5,
                    "{what}: {order:?}\n{text}"
                );
                let read =
                    import(&after.program.text).unwrap_or_else(|why| panic!("{what}: {why:?}"));
                assert_eq!(
                    read.job
                        .get("machine")
                        .and_then(|machine| machine.get("frame")),
                    given
                        .get("machine")
                        .and_then(|machine| machine.get("frame")),
                    "{what}"
                );
                let differs = ["program-differs", "header-unknown", "lines-differ"];
                assert!(
                    !read
                        .findings
                        .iter()
                        .any(|f| differs.contains(&f.code.as_str())),
                    "{what}: {:?}",
                    read.findings
                );
                counted += 1;
            }
        }
    }
    assert!(counted > 350, "{counted}");
}

/// LinuxCNC's interpreter runs the lines of every place, and the usual ones with a tool of its table. The touches are those of the program without them.
#[test]
fn lines_of_the_shop_run_on_linuxcnc() {
    let job = with(&bore("linuxcnc"), "control.workOffset", number(2.0));
    // The table of the interpreter has tool 1.
    let first_tool = with(&job, "control.tool", number(1.0));
    let job = with(&job, "control.tool", Value::Null);
    let lines = [
        ("head", &["G53 G0 {axis}90", "M0"][..]),
        ("beforeFirstMove", &["M0"]),
        ("beforeWrite", &["G91 G0 Z5", "G90"]),
        ("probeOff", &["M64 P0"]),
        ("foot", &["G53 G0 Z0"]),
    ];
    let given = planned(&with_lines(&job, &lines));
    let with = interpret(&on_virtual_part(&given)).expect("it runs");
    let without = interpret(&on_virtual_part(&planned(&job))).expect("it runs");
    let touches = |ran: &crate::common::Interpreted| {
        let probes = ran.moves.iter().filter(|step| step.kind == "probe");
        probes.map(|step| step.to).collect::<Vec<_>>()
    };
    assert!(!touches(&with).is_empty());
    assert_eq!(touches(&with), touches(&without));
    assert_eq!(
        with.offsets_after_moves.last(),
        without.offsets_after_moves.last()
    );
    let linuxcnc = POSTS.iter().find(|post| post.key == "linuxcnc");
    let usual = with_lines(&first_tool, linuxcnc.expect("a control").usual_lines);
    let ran = interpret(&on_virtual_part(&planned(&usual))).expect("it runs");
    assert_eq!(
        ran.offsets_after_moves.last(),
        without.offsets_after_moves.last()
    );
}

/// The usual lines of every control are understood, with the job's tool and tool axis.
#[test]
fn the_usual_lines_are_understood() {
    for post in POSTS.iter().filter(|post| !post.usual_lines.is_empty()) {
        let job = with_lines(&bore(post.key), post.usual_lines);
        assert_eq!(found(&job), [], "{}", post.key);
        let text = planned(&job).program.text;
        assert!(!text.contains('{'), "{}", post.key);
        if ["fanuc", "haas", "sinumerik", "linuxcnc"].contains(&post.key) {
            assert!(text.contains("T7"), "{}", post.key);
        }
    }
    let fanuc = planned(&with_lines(
        &bore("fanuc"),
        &[("foot", &["G91 G28 {axis}0.", "G90"])],
    ));
    assert!(
        fanuc
            .program
            .text
            .contains("(SHOP'S LINES, FOOT)\nG91 G28 Z0.\nG90\n")
    );
}

/// Lines that would make the program another one, by control: each is refused at its own path.
#[test]
fn dangerous_lines_are_refused() {
    let cases: &[(&str, &str, &[&str])] = &[
        // Jumps, ends, labels.
        ("fanuc", "head", &["IF [#100 GT 0] GOTO 9010"]),
        ("fanuc", "head", &["N9010"]),
        ("fanuc", "foot", &["M99"]),
        ("haas", "head", &["M97 P10"]),
        ("linuxcnc", "head", &["o9 if [1]"]),
        ("linuxcnc", "head", &["(abort,no)"]),
        ("sinumerik", "head", &["TP_STOP:"]),
        ("sinumerik", "foot", &["M17"]),
        ("sinumerik", "head", &["IF R1==0 GOTOF TP_STOP"]),
        ("heidenhain", "head", &["FN 9: IF +Q1 EQU +Q1 GOTO LBL 1"]),
        ("heidenhain", "foot", &["M30"]),
        // Values.
        ("fanuc", "beforeWrite", &["#101=0"]),
        ("okuma", "head", &["VC101=0"]),
        ("linuxcnc", "beforeWrite", &["#<width>=0"]),
        ("sinumerik", "beforeWrite", &["R1=0"]),
        ("sinumerik", "beforeWrite", &["$P_UIFR[1,X,TR]=0"]),
        ("heidenhain", "head", &["Q1 = 5"]),
        // Offsets and coordinate systems.
        ("fanuc", "beforeWrite", &["G10 L2 P1 Z0."]),
        ("haas", "beforeWrite", &["#5223=0"]),
        ("haas", "head", &["G52 X1."]),
        ("linuxcnc", "head", &["G92 Z0"]),
        ("linuxcnc", "beforeWrite", &["G55"]),
        ("okuma", "beforeFirstMove", &["G15 H5"]),
        ("fanuc", "head", &["G68 X0. Y0. R10."]),
        ("sinumerik", "head", &["TRANS X10"]),
        ("heidenhain", "head", &["CYCL DEF 7.1 X+10"]),
        (
            "heidenhain",
            "foot",
            &["PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY"],
        ),
        // Modes that stay.
        ("fanuc", "head", &["G91 G28 Z0."]),
        ("fanuc", "head", &["G20"]),
        ("linuxcnc", "probeOn", &["G18"]),
        ("haas", "beforeFirstMove", &["G49"]),
        ("haas", "head", &["M3 S500"]),
        ("okuma", "head", &["G56 H1 M3 S500"]),
        ("sinumerik", "head", &["SUPA G0 Z0 D0"]),
        ("heidenhain", "head", &["M3"]),
        // Moves.
        ("fanuc", "head", &["G28 Z0."]),
        ("fanuc", "head", &["G91 G28 X0. Y0.", "G90"]),
        ("linuxcnc", "head", &["G28"]),
        ("haas", "head", &["G53 G0 X0. Y0."]),
        ("haas", "beforeFirstMove", &["G0 Z0."]),
        ("haas", "beforeFirstMove", &["G0 X0. Z500."]),
        ("haas", "probeOff", &["Z-5."]),
        ("haas", "probeOff", &["G91 G0 Z-5.", "G90"]),
        ("haas", "onAlarm", &["G53 G0 Z0."]),
        ("linuxcnc", "probeOn", &["G38.2 Z-5 F100"]),
        ("fanuc", "probeOn", &["G81 Z-5. R2. F100."]),
        ("fanuc", "probeOn", &["G66 P9000"]),
        ("heidenhain", "head", &["L Z+0 R0 FMAX"]),
        ("heidenhain", "head", &["L X+0 Y+0 R0 FMAX M91"]),
        // Tools.
        ("fanuc", "beforeFirstMove", &["T7 M6"]),
        ("heidenhain", "probeOff", &["TOOL CALL 3 Z"]),
        // A dwell, another axis, a small step or a skipped block hides nothing.
        ("linuxcnc", "head", &["G4 P0.1 G0 Z-50"]),
        ("grbl", "foot", &["G4 P0.1 G0 X10 Z-50"]),
        ("haas", "onAlarm", &["G0 A90."]),
        ("linuxcnc", "onAlarm", &["G0 W-50"]),
        ("sinumerik", "foot", &["G91", "SUPA G0 Z-100", "G90"]),
        ("heidenhain", "head", &["L IZ-100 R0 FMAX M91"]),
        ("haas", "head", &["/G53 G0 Z0."]),
        ("heidenhain", "head", &["/ M30"]),
        // Before its modes nothing is known about units, length and offset.
        ("haas", "head", &["T7 M6", "G0 Z{clearance}", "G43 H7"]),
        ("haas", "probeOff", &["G20 G0 Z30.", "G21"]),
        // Blanks, comments and signs of the control.
        ("fanuc", "foot", &["M3 0"]),
        ("fanuc", "foot", &["N 9001"]),
        ("fanuc", "foot", &["M1 N9001"]),
        ("fanuc", "head", &["M0 ; G10 L2 P1 X5."]),
        ("haas", "head", &["(TURN PROBE ON"]),
        ("fanuc", "foot", &["M0 %"]),
        ("linuxcnc", "beforeWrite", &["(py,this.params[5221]=0)"]),
        ("linuxcnc", "head", &["M1 ( abort,x)"]),
        ("linuxcnc", "head", &["(LOGCLOSE)"]),
        ("grbl", "head", &["(ready?)"]),
        ("haas", "head", &["(TOUCHPATH ENDS)"]),
        // The length and the tool of the probe.
        ("fanuc", "beforeFirstMove", &["G43 H0"]),
        ("haas", "beforeWrite", &["G43 H7"]),
        ("haas", "head", &["G43 H3"]),
        ("sinumerik", "beforeFirstMove", &["D2"]),
        ("heidenhain", "probeOn", &["TOOL CALL 3 Z S50"]),
        ("heidenhain", "head", &["TOOL CALL 7 Z S50 DL-50"]),
        ("haas", "head", &["T3 M6"]),
        ("heidenhain", "head", &["STOP M30"]),
        // A line that is not understood may still be refused.
        ("haas", "head", &["M3 S500 M59"]),
        ("haas", "head", &["G20 M59 P3"]),
        ("heidenhain", "head", &["FN9:IF+Q1 EQU+Q1 GOTO LBL 1"]),
        ("heidenhain", "head", &["FN17:SYSWRITE ID10 NR1"]),
        ("heidenhain", "head", &["CR X+10 Y+0 R+5 DR-"]),
        ("sinumerik", "head", &["MCALL CYCLE83"]),
        // Each code of a line, and each way to move.
        ("fanuc", "head", &["M5 M98 P9000 M3"]),
        ("linuxcnc", "probeOff", &["G4 P0.1 Z-50"]),
        ("grbl", "foot", &["G4 P0.1 Z-50"]),
        ("linuxcnc", "onAlarm", &["G4 P0.1 Z-50"]),
        ("haas", "foot", &["G49", "G0 Z{clearance}"]),
        ("haas", "foot", &["T3 M6", "G0 Z{clearance}"]),
        ("sinumerik", "foot", &["G0 Z30 D0"]),
        ("haas", "beforeFirstMove", &["G0 Z{clearance}"]),
        (
            "haas",
            "foot",
            &["G53 G0 Z0.", "G53 G0 X0. Y0.", "G0 Z{clearance}"],
        ),
        ("sinumerik", "beforeFirstMove", &["T=\"ENDMILL\""]),
        ("sinumerik", "head", &["T=3", "M6", "D1"]),
        ("sinumerik", "onAlarm", &["SPOS=90"]),
        ("sinumerik", "onAlarm", &["G0 Z=-50"]),
        ("sinumerik", "foot", &["M=30"]),
        ("sinumerik", "beforeFirstMove", &["D=0"]),
        ("haas", "onAlarm", &["M3 S5000", "M5"]),
        ("heidenhain", "probeOn", &["TOOL CALL 7 Y S50"]),
        ("haas", "beforeWrite", &["M0"]),
        ("haas", "beforeFirstMove", &["G103 P0"]),
        ("linuxcnc", "beforeFirstMove", &["G43.2 H5"]),
        // Placeholders and texts.
        ("fanuc", "head", &["T{tol} M6"]),
        ("fanuc", "head", &["{offset}"]),
    ];
    for (post, place, own) in cases {
        let base = match *place {
            "beforeWrite" => with(&bore(post), "control.workOffset", number(1.0)),
            _ => bore(post),
        };
        let job = with_lines(&base, &[(place, own)]);
        let found = found(&job);
        let path = format!("machine.frame.{place}[");
        assert!(
            found.iter().any(|f| f.level == Level::Error
                && f.code == "shop-line"
                && f.path.starts_with(&path)),
            "{post} {place} {own:?}: {found:?}"
        );
    }
}

/// The same lines where they are right.
#[test]
fn usual_lines_are_accepted() {
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "fanuc",
            "head",
            &["G91 G28 Z0.", "G90", "G54", "T7 M6", "G43 H7"],
        ),
        ("haas", "probeOff", &["G0 Z{clearance}"]),
        ("haas", "beforeFirstMove", &["G91 G0 Z50.", "G90"]),
        ("haas", "foot", &["G91 G0 Z50.", "G90", "G49", "M5"]),
        ("haas", "head", &["M0 (PROBE READY?)"]),
        ("linuxcnc", "head", &["G20", "G21", "G4 P0.5", "G59.1"]),
        ("fanuc", "head", &["G4 X1."]),
        (
            "sinumerik",
            "head",
            &["SUPA G0 Z0 D0", "T=\"PROBE\" M6", "D1"],
        ),
        (
            "heidenhain",
            "head",
            &["L M140 MB MAX", "TOOL CALL 7 Z S50", "M5"],
        ),
        ("grbl", "probeOn", &["M0"]),
    ];
    for (post, place, own) in cases {
        assert_eq!(
            found(&with_lines(&bore(post), &[(place, own)])),
            [],
            "{post} {place} {own:?}"
        );
    }
}

/// Lines that are not understood are listed in a finding and marked in the program.
#[test]
fn lines_that_are_not_understood_are_named() {
    for (post, own, mark) in [
        (
            "haas",
            "M59 P3",
            "(SHOP'S LINES, PROBE ON, NOT CHECKED)\nM59 P3\n",
        ),
        (
            "fanuc",
            "G65 P9832",
            "(SHOP'S LINES, PROBE ON, NOT CHECKED)\nG65 P9832\n",
        ),
        (
            "linuxcnc",
            "o<probe_on> call",
            "(Shop's lines, probe on, not checked)\no<probe_on> call\n",
        ),
        (
            "sinumerik",
            "PROBE_ON",
            "; Shop's lines, probe on, not checked\nPROBE_ON\n",
        ),
        (
            "heidenhain",
            "CALL PGM TNC:\\PROBE.H",
            "; Shop's lines, probe on, not checked\n",
        ),
        ("haas", "M50", "NOT CHECKED)\nM50\n"),
        ("haas", "G53 G0 Z-10.", "NOT CHECKED)\nG53 G0 Z-10.\n"),
        ("sinumerik", "L9810", "not checked\nL9810\n"),
        (
            "sinumerik",
            "SUPA G0 Z=500 D1",
            "not checked\nSUPA G0 Z=500 D1\n",
        ),
        ("sinumerik", "G75 Z0", "not checked\nG75 Z0\n"),
        ("sinumerik", "OMP40_ON", "not checked\nOMP40_ON\n"),
        ("fanuc", "G5.1 Q0", "NOT CHECKED)\nG5.1 Q0\n"),
        ("okuma", "G15 H5", "NOT CHECKED)\nG15 H5\n"),
        ("okuma", "CALL O9832", "NOT CHECKED)\nCALL O9832\n"),
        ("okuma", "G53 G0 Z0", "NOT CHECKED)\nG53 G0 Z0\n"),
        ("brother", "G121", "NOT CHECKED)\nG121\n"),
        ("fanuc", "M5 M13 S1000", "NOT CHECKED)\nM5 M13 S1000\n"),
        ("fanuc", "G53 G0 Z0. Z-300.", "NOT CHECKED)\n"),
        ("linuxcnc", "G64 P5", "not checked)\nG64 P5\n"),
        ("haas", "G63", "NOT CHECKED)\nG63\n"),
        ("heidenhain", "L Z+0 R0 FMAX M92", "not checked\n"),
        ("heidenhain", "CYCL DEF 9.0 DWELL TIME", "not checked\n"),
        ("heidenhain", "TOOL CALL 7 Z S50 M8", "not checked\n"),
        ("heidenhain", "PLANE RESET STAY", "not checked\n"),
        ("okuma", "G20 HP=1", "NOT CHECKED)\nG20 HP=1\n"),
        ("sinumerik", "$A_OUT[5]=1", "not checked\n$A_OUT[5]=1\n"),
        ("sinumerik", "SPOS=0", "not checked\nSPOS=0\n"),
        ("fanuc", "M70", "NOT CHECKED)\nM70\n"),
        ("linuxcnc", "o100 call", "not checked)\no100 call\n"),
        ("linuxcnc", "M61 Q7", "not checked)\nM61 Q7\n"),
    ] {
        let job = with_lines(&bore(post), &[("probeOn", &[own])]);
        let found = found(&job);
        assert_eq!(found.len(), 1, "{post}: {found:?}");
        assert_eq!(
            (found[0].code.as_str(), found[0].level),
            ("shop-lines-unknown", Level::Info),
            "{post} {own}: {found:?}"
        );
        assert!(planned(&job).program.text.contains(mark), "{post}");
    }
}

/// Lines at a place that the program does not have are left out, and a finding reports them.
#[test]
fn unused_places_are_reported() {
    for (post, place) in [
        ("grbl", "onAlarm"),
        ("fanuc", "beforeWrite"),
        ("heidenhain", "onAlarm"),
    ] {
        let job = with_lines(&bore(post), &[(place, &["M1"])]);
        let found = found(&job);
        assert_eq!(found.len(), 1, "{post}: {found:?}");
        assert_eq!(found[0].code, "shop-lines-unused", "{post}");
        let count = |job: &Value| planned(job).program.text.matches("M1\n").count();
        // One is the header's.
        assert!(count(&job) <= 1, "{post}");
    }
}

/// A line that someone adds below the shop's lines is read like any line of the program.
#[test]
fn only_the_lines_of_the_job_are_left_out() {
    let job = with(&bore("haas"), "control.workOffset", number(1.0));
    let job = with_lines(&job, &[("probeOn", &["M59 P3"]), ("probeOff", &["M69 P3"])]);
    let text = planned(&job).program.text;
    let broken = |text: &str| match check_program(&job, text).expect("it is read") {
        Ok(rows) => rows.iter().filter(|row| row.holds == Some(false)).count(),
        Err(faults) => faults.len(),
    };
    assert_eq!(broken(&text), 0);
    for (line, other) in [
        ("M59 P3\n", "M59 P3\nG10 L2 P1 X5.\n"),
        ("M59 P3\n", "M59 P4\n"),
        ("M69 P3\n", "M69 P3\n#5221=5.\n"),
        // The lines before the touches.
        (
            "M5\n",
            "(SHOP'S LINES, PROBE OFF, NOT CHECKED)\nM69 P3\nM5\n",
        ),
        // A second copy of the lines.
        (
            "M5\n",
            "M5\n(SHOP'S LINES, PROBE OFF, NOT CHECKED)\nM69 P3\n",
        ),
    ] {
        assert!(broken(&text.replacen(line, other, 1)) > 0, "{other}");
    }
}

/// Any printable line comes back from a header, with capitals only as well, and has no character that a comment cannot have.
#[test]
fn lines_come_back_from_a_header() {
    law(400, 300, "[ -~]{0,80}", |line| {
        for capitals in [false, true] {
            let code = encoded(&line, capitals);
            proptest::prop_assert!(
                code.chars()
                    .all(|c| c.is_ascii_alphanumeric() || "_.-+@".contains(c))
            );
            proptest::prop_assert!(!capitals || !code.contains(|c: char| c.is_ascii_lowercase()));
            let read = decoded(&code);
            proptest::prop_assert_eq!(read.as_deref(), Some(line.as_str()));
        }
        Ok(!line.is_empty())
    });
}

/// A place that is `null`, a blank line and a line that begins with a number come back as they were.
#[test]
fn unusual_lists_come_back() {
    for post in ["haas", "linuxcnc", "heidenhain", "okuma"] {
        let frame = job(r#"{ "head": null, "probeOn": [], "foot": ["", "M1", ""] }"#);
        let given = with(&bore(post), "machine.frame", frame.clone());
        let read = import(&planned(&given).program.text).expect("a job");
        let machine = read.job.get("machine").expect("a machine");
        assert_eq!(machine.get("frame"), Some(&frame), "{post}");
    }
    let numbered = with_lines(
        &bore("linuxcnc"),
        &[("head", &["5 M0"]), ("foot", &["M1 {name}"])],
    );
    assert!(
        planned(&with(&numbered, "name", Value::Text(" ".to_owned())))
            .program
            .proof
            .is_some()
    );
}

/// A long line of 80 characters comes back from the header of each control.
#[test]
fn the_longest_line_comes_back() {
    let longest =
        "(a comment with = signs, [brackets] and #5221; 80 characters long: 0123456789ab)";
    assert_eq!(longest.len(), 80);
    for post in ["linuxcnc", "fanuc"] {
        let given = with_lines(&bore(post), &[("head", &[longest, "M1", longest])]);
        let read = import(&planned(&given).program.text).expect("a job");
        let frame = |job: &Value| {
            job.get("machine")
                .and_then(|machine| machine.get("frame"))
                .cloned()
        };
        assert_eq!(frame(&read.job), frame(&given), "{post}");
    }
}

/// Wrong types, unknown places, long lists and characters that no control has are findings with their paths.
#[test]
fn wrong_lines_are_findings() {
    for (frame, code, path) in [
        (r#"{ "heads": [] }"#, "unknown-key", "machine.frame.heads"),
        (r#"[]"#, "wrong-type", "machine.frame"),
        (r#"{ "head": "M0" }"#, "wrong-type", "machine.frame.head"),
        (r#"{ "head": [7] }"#, "wrong-type", "machine.frame.head[0]"),
        (
            r#"{ "head": ["M0\nM30"] }"#,
            "line-characters",
            "machine.frame.head[0]",
        ),
        (
            r#"{ "head": ["M0", "é"] }"#,
            "line-characters",
            "machine.frame.head[1]",
        ),
    ] {
        let given = with(&bore("fanuc"), "machine.frame", job(frame));
        let findings = touchpath::job::check(&given);
        assert!(
            findings.iter().any(|f| f.code == code && f.path == path),
            "{frame}: {findings:?}"
        );
    }
    let many = Value::List(vec![Value::Text("M0".to_owned()); 21]);
    let long = lines(&[&"M0 ".repeat(40)]);
    let blank = with_lines(&bore("fanuc"), &[("head", &["", "", "M30"])]);
    assert_eq!(found(&blank)[0].path, "machine.frame.head[2]");
    for (given, path) in [
        (many, "machine.frame.head"),
        (long, "machine.frame.head[0]"),
    ] {
        let given = with(&bore("fanuc"), "machine.frame.head", given);
        let findings = touchpath::job::check(&given);
        assert!(
            findings
                .iter()
                .any(|f| f.code == "too-long" && f.path == path),
            "{findings:?}"
        );
    }
}

/// With another tool in the spindle than the job's nothing moves; with the right one the program ends. Judges: the tests' own Fanuc, Haas and SINUMERIK.
#[test]
fn the_tool_of_the_probe_is_checked() {
    for (tool, stops) in [(7, false), (8, true)] {
        let plan = planned(&bore("sinumerik"));
        let mut machine = Machine::new(plan.triggers.clone());
        machine.tool = Some(f64::from(tool));
        machine
            .run(&read(&plan.program.text).expect("a program"))
            .expect("it runs");
        assert_eq!(
            (machine.alarm.is_some(), machine.path.is_empty()),
            (stops, stops),
            "{tool}"
        );
        assert!(
            !stops || machine.message.contains("tool 7"),
            "{}",
            machine.message
        );
        for post in ["fanuc", "haas"] {
            let plan = planned(&bore(post));
            let mut control = Control::new(post == "haas", false);
            control.at = [0.0, 0.0, 200.0];
            control.contacts = plan.triggers.iter().flatten().copied().collect();
            let variable = if post == "haas" { 3026 } else { 4120 };
            control.variables.insert(variable, f64::from(tool));
            control
                .run(&plan.program.text)
                .unwrap_or_else(|why| panic!("{post} {why}"));
            assert_eq!(
                (control.alarm.is_some(), control.path.is_empty()),
                (stops, stops),
                "{post} {tool}"
            );
            let alarm = control.alarm.unwrap_or_default();
            assert!(!stops || alarm.contains("ANOTHER TOOL"), "{alarm}");
        }
    }
    // The interpreter has tool 1 in its table and none in its spindle.
    let linuxcnc = with(&bore("linuxcnc"), "control.tool", number(1.0));
    let refused =
        interpret(&on_virtual_part(&planned(&linuxcnc))).expect_err("no tool is in the spindle");
    assert!(refused.contains("the probe is tool 1"), "{refused}");
    assert!(!refused.contains("STRAIGHT_"), "{refused}");
    let called = with_lines(&linuxcnc, &[("head", &["T{tool} M6", "G43"])]);
    interpret(&on_virtual_part(&planned(&called))).expect("it runs");
}

/// A program that neither calls nor checks the tool has a finding, unless a line of the shop calls it.
#[test]
fn an_unused_tool_is_reported() {
    let is_unused = |job: &Value| {
        planned(job)
            .findings
            .iter()
            .any(|f| f.code == "tool-unused")
    };
    let native = with(
        &bore("haas"),
        "control.form",
        Value::Text("cycle".to_owned()),
    );
    for job in [bore("grbl"), native] {
        assert!(is_unused(&job));
        assert!(!is_unused(&with_lines(&job, &[("head", &["T{tool} M6"])])));
    }
    assert!(
        ["linuxcnc", "fanuc", "sinumerik", "heidenhain"]
            .iter()
            .all(|post| !is_unused(&bore(post)))
    );
}

/// Lines that change tool, length or offset would change them for the other program.
#[test]
fn lines_of_the_head_and_the_foot_are_not_inserted() {
    let other = "T24 M6 (PROBE)\nG43 H24 Z50.\nM30\n";
    let haas = with(&bore("haas"), "control.tool", number(24.0));
    assert!(insert(&haas, other, None).is_ok());
    assert!(insert(&with_lines(&haas, &[("probeOn", &["M59 P3"])]), other, None).is_ok());
    for place in ["head", "foot"] {
        let error = insert(&with_lines(&haas, &[(place, &["M5"])]), other, None).expect_err(place);
        assert_eq!(error.findings[0].code, "not-inserted");
        assert!(error.findings[0].message.contains(place), "{error}");
    }
}

/// A portal fixes the lines: others are refused, and its own are checked.
#[test]
fn a_portal_fixes_the_lines() {
    let config = job(
        r#"{ "format": 1, "title": "Hall 3", "fields": { "machine.frame":
        { "value": { "probeOn": ["M59 P3"] }, "locked": true, "reason": "OMP40" } } }"#,
    );
    let config = Config::read(&config).expect("a config");
    let own = config.fill(&job(
        r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "post": "haas" } }"#,
    ));
    assert!(planned(&own).program.text.contains("\nM59 P3\n"));
    let other = with_lines(&bore("haas"), &[("probeOn", &["M59 P4"])]);
    let locked: Vec<String> = config
        .judge(&other)
        .into_iter()
        .map(|f| f.message)
        .collect();
    assert!(
        locked.contains(&"Hall 3 fixes Shop's lines at M59 P3: OMP40".to_owned()),
        "{locked:?}"
    );
    for wrong in [
        r#"{ "probeOn": [7] }"#,
        r#"{ "probeOn": ["\u00e9"] }"#,
        r#"{ "on": [] }"#,
    ] {
        let config = job(&format!(
            r#"{{ "format": 1, "fields": {{ "machine.frame": {{ "value": {wrong} }} }} }}"#
        ));
        let error = Config::read(&config).expect_err(wrong);
        assert_eq!(error.findings[0].path, "config.fields.machine.frame.value");
    }
}
