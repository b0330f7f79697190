//! A program inside another one: what is around keeps its bytes, and what is inside stays the job's program.

use crate::common::{interpret, job, jobs, number, on_virtual_part, planned, with};
use touchpath::control::{POSTS, inside};
use touchpath::form::{Level, Value};
use touchpath::import::insert::{Insertion, insert};
use touchpath::import::{Imported, import};
use touchpath::job::{JobError, plan};

/// A program of each language with a probe, a tool before and a tool after it. Jobs in inch get the same in inch.
fn other(post: &str, units: &str) -> String {
    other_in(post, units, "G17")
}

fn other_in(post: &str, units: &str, plane: &str) -> String {
    let inch = units == "inch";
    match post {
        "sinumerik" => format!(
            "%_N_PART_MPF\n;$PATH=/_N_WKS_DIR\nN10 {plane} {} G90\nT=\"MILL\"\nM6\nG54 D1\nG0 Z100\nT=\"PROBE\"\nM6\nD1\nG0 Z200\nT=\"DRILL\"\nM6\nD1\nR5=3\nM30\n",
            if inch { "G70" } else { "G71" }
        ),
        "linuxcnc" | "grbl" | "grblhal" | "fluidnc" => format!(
            "(PART)\n{} {plane} G90\nT1 M6\nG43\nG0 Z100\n(the probe)\nT24 M6\nG43 H24\nG0 Z200\nT2 M6\nG43\nM30\n",
            if inch { "G20" } else { "G21" }
        ),
        _ => format!(
            "%\nO0100 (PART)\n{} {plane} G90\nT1 M6\nG54\nG43 H1 Z100.\nN10 (PROBE)\nT24 M6\nG43 H24 Z200.\nM19\n\nT2 M6\n#120=5.\nG43 H2 Z100.\nM30\n%\n",
            if inch { "G20" } else { "G21" }
        ),
    }
}

fn text<'v>(job: &'v Value, path: [&str; 2]) -> Option<&'v str> {
    match job.get(path[0])?.get(path[1])? {
        Value::Text(text) => Some(text),
        _ => None,
    }
}

fn units(job: &Value) -> &str {
    match job.get("units") {
        Some(Value::Text(units)) => units,
        _ => "mm",
    }
}

/// The text without the inserted lines and declarations.
fn around(made: &Insertion) -> String {
    let lines: Vec<&str> = made.text.split_inclusive('\n').collect();
    lines
        .iter()
        .enumerate()
        .filter(|(line, _)| !(made.first..made.first + made.count).contains(line))
        .map(|(_, text)| *text)
        .filter(|line| !line.starts_with("DEF INT TP"))
        .collect()
}

/// Blocks of a program without its number and its tape marks.
fn own(program: &str) -> Vec<&str> {
    let numbered =
        |line: &&str| line.starts_with('O') && line[1..].starts_with(|c: char| c.is_ascii_digit());
    program
        .lines()
        .filter(|line| !line.is_empty() && *line != "%")
        // The hash is over the tape marks as well.
        .filter(|line| {
            !numbered(line)
                && !line.contains("NO NUMBER WAS CHOSEN")
                && !line.to_uppercase().contains("BLOCKS BELOW")
        })
        .collect()
}

/// Every job of the repository for every control that takes it, in both forms.
fn programs() -> Vec<(String, Value, String)> {
    let mut all = Vec::new();
    for (name, value) in jobs() {
        for post in POSTS {
            for form in ["moves", "cycle"] {
                let mut job = with(&value, "control.post", Value::Text(post.key.to_owned()));
                job = with(&job, "control.form", Value::Text(form.to_owned()));
                job = with(&job, "control.workOffset", Value::Null);
                if let Ok(plan) = plan(&job) {
                    all.push((
                        format!("{name} {} {form}", post.key),
                        job,
                        plan.program.text,
                    ));
                }
            }
        }
    }
    all
}

#[test]
fn every_program_goes_in_and_comes_out_as_it_was() {
    let mut seen = 0;
    for (name, job, program) in programs().into_iter().step_by(2) {
        let post = text(&job, ["control", "post"]).unwrap();
        if post == "heidenhain" {
            continue;
        }
        let plane = match job.get("plane") {
            Some(Value::Text(plane)) => plane,
            _ => "G17",
        };
        let other = other_in(post, units(&job), plane);
        let made = insert(&job, &other, None)
            .unwrap_or_else(|error| panic!("{name}: {:#?}", error.findings));
        assert_eq!(around(&made), other, "{name}");
        // Behind the length of the probe, and before the next tool.
        let above: Vec<&str> = made.text.lines().take(made.first).collect();
        assert!(
            above
                .last()
                .is_some_and(|line| line.contains("H24") || *line == "D1"),
            "{name}: {above:?}"
        );
        let alone = inside::alone(&made.text).unwrap();
        assert_eq!(own(&alone), own(&program), "{name}");
        // The way back reads the job's program in the middle of the other one.
        let Ok(Imported::Job { findings, .. }) = import(&made.text) else {
            panic!("{name}");
        };
        assert!(
            findings.iter().all(|finding| finding.level == Level::Info),
            "{name}: {findings:#?}"
        );
        // Again: the program is replaced.
        let again = insert(&job, &made.text, None).unwrap();
        assert_eq!(again.text, made.text, "{name}");
        assert_eq!(again.first, made.first, "{name}");
        seen += 1;
    }
    assert!(seen > 120, "{seen}");
}

#[test]
fn a_changed_digit_inside_is_found_and_one_around_is_not() {
    let job = job(
        r#"{ "format": 1, "name": "BORE", "cycle": { "type": "hole", "diameter": 30 }, "control": { "post": "fanuc", "workOffset": 2 } }"#,
    );
    let made = insert(&job, &other("fanuc", "mm"), None).unwrap();
    let codes = |text: &str| {
        let Ok(Imported::Job { findings, .. }) = import(text) else {
            return vec!["refused".to_owned()];
        };
        findings.into_iter().map(|f| f.code).collect()
    };
    assert_eq!(codes(&made.text), ["part-not-in-program"]);
    assert_eq!(
        codes(&made.text.replace("H24 Z200.", "H24 Z201.")),
        ["part-not-in-program"]
    );
    for (from, to) in [("X17. Y0.", "X19. Y0."), ("#5241=#5241+", "#5242=#5242+")] {
        let changed = made.text.replacen(from, to, 1);
        assert_ne!(changed, made.text);
        assert!(
            codes(&changed).iter().any(|code| code == "program-differs"),
            "{from}: {:?}",
            codes(&changed)
        );
    }
}

/// Two programs in one: labels and names of the second one are its own.
#[test]
fn two_programs_go_into_one() {
    for post in ["fanuc", "haas", "linuxcnc", "sinumerik"] {
        let bore = |name: &str, diameter: f64| {
            let job = job(&format!(
                r#"{{ "format": 1, "name": "{name}", "cycle": {{ "type": "hole" }}, "control": {{ "post": "{post}", "workOffset": 1 }} }}"#
            ));
            with(&job, "cycle.diameter", number(diameter))
        };
        let (one, two) = (bore("ONE", 30.0), bore("TWO", 60.0));
        let first = insert(&one, &other(post, "mm"), None).unwrap();
        let both = insert(&two, &first.text, Some(first.first + first.count)).unwrap();
        let ranges = inside::ranges(&both.text);
        let sets: Vec<usize> = ranges.iter().map(|(_, set)| *set).collect();
        assert!(sets == [0, 1] || sets == [1, 0], "{post}: {sets:?}");
        let labels: Vec<&str> = both
            .text
            .lines()
            .filter(|line| {
                line.starts_with("N9")
                    || line.starts_with("TP") && line.ends_with(':')
                    || line.ends_with(" sub")
            })
            .collect();
        let mut once = labels.clone();
        once.sort_unstable();
        once.dedup();
        assert!(
            labels.len() > 2 && once.len() == labels.len(),
            "{post}: {labels:?}"
        );
        // Variables are shared, which is said where the other program uses them.
        assert!(
            both.findings.iter().any(|f| f.code == "variables-shared"),
            "{post}"
        );
        // The first is replaced by a larger bore, the second stays.
        let larger = insert(&bore("ONE", 40.0), &both.text, None).unwrap();
        assert_eq!(inside::ranges(&larger.text).len(), 2, "{post}");
        assert_eq!(
            around(&larger),
            {
                let lines: Vec<&str> = both.text.split_inclusive('\n').collect();
                let range = ranges[usize::from(both.first <= first.first)].0.clone();
                [&lines[..range.start], &lines[range.end..]]
                    .concat()
                    .concat()
                    .replace("DEF INT TP_MOVE\n", "")
                    .replace("DEF INT TP2_MOVE\n", "")
            },
            "{post}"
        );
    }
}

/// LinuxCNC's interpreter runs the whole: the moves of the other program, then those of the job, the write, and the rest.
#[test]
fn linuxcnc_runs_the_whole() {
    let job = job(
        r#"{ "format": 1, "name": "BORE", "cycle": { "type": "hole", "diameter": 30 }, "control": { "workOffset": 1 }, "part": { "offset": [0.1, -0.2, 0] } }"#,
    );
    let planned = planned(&job);
    let other = "G21 G90 G17 G54\nG0 X0 Y0 Z50\nG43 H0\nG1 X7 Y8 F100\nM2\n";
    let made = insert(&job, other, Some(2)).unwrap();
    let alone = interpret(&on_virtual_part(&planned)).unwrap();
    // The touches end where the displaced part stops them.
    let with_part = {
        let own = on_virtual_part(&planned);
        let mut text = made.text.clone();
        for (a, b) in planned.program.text.lines().zip(own.lines()) {
            text = if a == b { text } else { text.replace(a, b) };
        }
        text
    };
    let whole = interpret(&with_part).unwrap();
    assert_eq!(
        whole.offsets_after_moves.last(),
        alone.offsets_after_moves.last()
    );
    assert_ne!(with_part, made.text);
    let last = whole.moves.last().unwrap();
    assert_eq!([last.to[0], last.to[1]], [7.0, 8.0]);
    assert!(whole.moves.len() > alone.moves.len());
}

fn refused(error: JobError) -> String {
    error
        .findings
        .iter()
        .map(|finding| format!("{}: {}", finding.code, finding.message))
        .collect::<Vec<_>>()
        .join("; ")
}

#[test]
fn what_does_not_fit_is_refused_with_its_reason() {
    let fanuc = job(
        r#"{ "format": 1, "name": "BORE", "cycle": { "type": "hole" }, "control": { "post": "fanuc" } }"#,
    );
    let post = |post: &str| {
        let job = with(&fanuc, "control.post", Value::Text(post.to_owned()));
        with(&job, "control.workOffset", Value::Null)
    };
    let why = |job: &Value, other: &str, line: Option<usize>| {
        refused(insert(job, other, line).unwrap_err())
    };
    let part = other("fanuc", "mm");
    assert!(why(&fanuc, "G21 G90\nT1 M6\nM30\n", None).starts_with("no-place: No tool change"));
    assert!(why(&fanuc, "", Some(0)).starts_with("no-place: There is no line 1"));
    assert!(why(&fanuc, &part, Some(99)).contains("no line 100"));
    assert!(why(&fanuc, &other("sinumerik", "mm"), None).contains("another language"));
    assert!(why(&post("sinumerik"), &part, None).contains("another language"));
    assert!(why(&fanuc, &other("fanuc", "inch"), None).contains("in inch, and the job in mm"));
    let shifted = part.replace("H24 Z200.", "H24 Z200.\nG68 X0. Y0. R30.");
    let line = shifted.lines().position(|line| line.starts_with("G68"));
    assert!(
        why(&fanuc, &shifted, line).contains("rotation"),
        "{}",
        why(&fanuc, &shifted, line)
    );
    // Every set of labels is taken.
    let labels: String = (0..100).map(|k| format!("N{}\n", 9001 + 100 * k)).collect();
    assert!(why(&fanuc, &format!("{part}{labels}"), None).contains("labels"));
    let wrong = with(&fanuc, "cycle.diameter", number(2.0));
    assert!(!why(&wrong, &part, None).contains("insert"));
    let klartext = job(
        r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "post": "heidenhain", "form": "cycle" } }"#,
    );
    let program = "0 BEGIN PGM A MM\n1 TOOL CALL 24 Z\n2 END PGM A MM\n";
    assert!(why(&klartext, program, Some(1)).contains("numbers every block"));
}

/// What is active at a place, and what the blocks below it rely on.
#[test]
fn a_place_where_something_else_would_happen_is_refused() {
    let head = |post: &str| match post {
        "sinumerik" => "G71 G17 G90\nT=\"PROBE\"\nM6\nD1\n",
        "linuxcnc" => "G21 G17 G90\nT24 M6 (PROBE)\nG43\n",
        _ => "G21 G17 G90\nT24 M6 (PROBE)\nG43 H24 Z50.\n",
    };
    let tail = "G0 X0 Y0\nG1 X1 F100.\nM30\n";
    let job_of = |post: &str| {
        job(&format!(
            r#"{{ "format": 1, "name": "BORE", "cycle": {{ "type": "hole" }}, "control": {{ "post": "{post}", "workOffset": 2 }} }}"#
        ))
    };
    for (post, before, below, why) in [
        ("fanuc", "G52 X10.\n", tail, "line 1 is active"),
        ("fanuc", "G92 X10.\n", tail, "is active there"),
        (
            "fanuc",
            "G68.2 X0 Y0 Z0 I0 J30. K0\n",
            tail,
            "is active there",
        ),
        ("haas", "G51.1 X0\n", tail, "is active there"),
        ("fanuc", "G52 X#500\n", tail, "is active there"),
        ("fanuc", "G52 X10.\nG52 X0 Y0\n", tail, ""),
        ("fanuc", "G68 X0 Y0 R30.\nG69\n", tail, ""),
        ("linuxcnc", "G10 L2 P1 R30\n", tail, "is active there"),
        ("linuxcnc", "G92 X10\n", tail, "is active there"),
        ("linuxcnc", "G92 X10\nG92.1\n", tail, ""),
        ("sinumerik", "TRANS X10\n", tail, "is active there"),
        ("sinumerik", "ROT RPL=30\n", tail, "is active there"),
        (
            "sinumerik",
            "CYCLE800(0,\"\",0,57)\n",
            tail,
            "is active there",
        ),
        ("sinumerik", "TRANS X10\nTRANS\nCYCLE800()\n", tail, ""),
        ("fanuc", "", "X10. Y10.\nM30\n", "states no motion code"),
        (
            "fanuc",
            "",
            "G1 X10.\nM30\n",
            "states no motion code or no feed",
        ),
        ("fanuc", "G90 G58 G0 X0 Y0\n", tail, ""),
        ("sinumerik", "G58 X10\n", tail, "is active there"),
        ("fanuc", "G91\n", tail, "G91 is active there, and G90 after"),
        ("fanuc", "G95\n", tail, "G95 is active there, and G94 after"),
        // Never reached, or more than once.
        ("fanuc", "M30\n", tail, "not reached exactly once"),
        ("fanuc", "M5 M30\n", tail, "not reached exactly once"),
        ("sinumerik", "/TRANS X10\n", tail, "is active there"),
        (
            "fanuc",
            "G80\n",
            "X10. Y10.\nM30\n",
            "states no motion code",
        ),
        (
            "fanuc",
            "GOTO 500\n",
            "N500\nM30\n",
            "not reached exactly once",
        ),
        ("linuxcnc", "M2\n", tail, "not reached exactly once"),
        (
            "linuxcnc",
            "o100 sub\n",
            "G0 X0\no100 endsub\nM2\n",
            "not reached exactly once",
        ),
        (
            "sinumerik",
            "FOR R1=1 TO 3\n",
            "ENDFOR\nM30\n",
            "not reached exactly once",
        ),
    ] {
        let text = format!("{}{before}{below}", head(post));
        let line = head(post).lines().count() + before.lines().count() - 1;
        let told = match insert(&job_of(post), &text, Some(line)) {
            Ok(_) => String::new(),
            Err(error) => refused(error),
        };
        let head_lines = head(post).lines().count();
        let why = why.replace("line 1 ", &format!("line {} ", head_lines + 1));
        assert!(
            told.contains(&why) && told.is_empty() == why.is_empty(),
            "{post} {before:?} {below:?}: {told}"
        );
    }
    // Another work offset stays active: that is a warning.
    let text = format!("G21 G17 G90 G54\n{}{tail}", head("fanuc"));
    let made = insert(&job_of("fanuc"), &text, None).unwrap();
    assert!(
        made.findings
            .iter()
            .any(|f| f.level == Level::Warning && f.message.starts_with("G55 is active")),
        "{:?}",
        made.findings
    );
}

/// Labels of the other program, however they are written.
#[test]
fn labels_are_seen_in_every_spelling() {
    for (post, label, own) in [
        ("fanuc", "/N9001 G0 Z9.", "N9101"),
        ("fanuc", "GOTO9001", "N9101"),
        ("fanuc", "N 9001", "N9101"),
        ("linuxcnc", "N10 o1 while [#1 LT 2]", "o101 if"),
        ("linuxcnc", "O 1 while [#1 LT 2]", "o101 if"),
        ("sinumerik", "tp_exit:", "TP2_EXIT:"),
    ] {
        let job = job(&format!(
            r#"{{ "format": 1, "name": "BORE", "cycle": {{ "type": "hole" }}, "control": {{ "post": "{post}" }} }}"#
        ));
        let program = planned(&job).program.text;
        let post = POSTS.iter().find(|def| def.key == post).unwrap();
        let put = inside::put(post, &program, &format!("{label}\n")).unwrap();
        assert!(
            put.lines.iter().any(|line| line.starts_with(own)),
            "{label}: {:?}",
            put.lines
                .iter()
                .filter(|line| line.starts_with(&own[..2]))
                .collect::<Vec<_>>()
        );
    }
    // A program numbered from N1 to N1000.
    let numbered: String = (1..=1000).map(|n| format!("N{n} G0 X{n}.\n")).collect();
    let fanuc = POSTS.iter().find(|def| def.key == "fanuc").unwrap();
    let job =
        job(r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "post": "fanuc" } }"#);
    let put = inside::put(fanuc, &planned(&job).program.text, &numbered).unwrap();
    assert!(put.lines[0].ends_with("LABEL SET 11)"), "{}", put.lines[0]);
}

#[test]
fn a_line_is_that_of_the_given_text() {
    let job = job(
        r#"{ "format": 1, "name": "BORE", "cycle": { "type": "hole" }, "control": { "post": "sinumerik" } }"#,
    );
    let first = insert(&job, &other("sinumerik", "mm"), None).unwrap();
    // With the declaration above it, the place is one line lower in the new text.
    let again = insert(&job, &first.text, Some(first.line + 1)).unwrap();
    assert_eq!(again.text, first.text);
    assert_eq!(again.line, first.line + 1);
    assert!(again.places.iter().any(|place| place.line == again.line));
    // Far below the inserted lines.
    let lines: Vec<&str> = first.text.lines().collect();
    let last = lines
        .iter()
        .rposition(|line| line.starts_with("G0 Z200"))
        .unwrap();
    let below = insert(&job, &first.text, Some(last)).unwrap();
    assert_eq!(below.text.lines().nth(below.first - 1), Some("G0 Z200"));
    // A fault is told at its line of the whole.
    let changed = first.text.replacen("MEAS=1 G1 X", "MEAS=1 G1 X1", 1);
    let line = changed
        .lines()
        .zip(first.text.lines())
        .position(|(a, b)| a != b)
        .unwrap();
    let Ok(Imported::Job { findings, .. }) = import(&changed) else {
        panic!();
    };
    let named = format!("Line {} ", line + 1);
    assert!(
        findings
            .iter()
            .any(|finding| finding.message.contains(&named)),
        "{named}: {findings:#?}"
    );
}

#[test]
fn the_tool_change_of_the_probe_is_found() {
    let fanuc = job(
        r#"{ "format": 1, "name": "BORE", "cycle": { "type": "hole" }, "control": { "post": "fanuc" } }"#,
    );
    let head = "G21 G90\nT1 M6\nG43 H1\nG0 Z50.\n";
    for (lines, behind) in [
        ("T24 M06 (TASTER)\nG0 X0\nG43 H24\nG0 X1.\nM30\n", "G43 H24"),
        ("(OMP40)\nT24\nM6\nG43H24Z50.\nM30\n", "G43H24Z50."),
        (
            "(RENISHAW PROBE) T24 M6\nM19\nM30\n",
            "(RENISHAW PROBE) T24 M6",
        ),
        ("T24 M6\n(3D-TASTER)\nG54\nM30\n", "T24 M6"),
        // G56 is a work offset here, and Okuma's tool length.
        ("T24 M6 (PROBE)\nG56\nG43 H24\nM30\n", "G43 H24"),
    ] {
        let made = insert(&fanuc, &format!("{head}{lines}"), None)
            .unwrap_or_else(|error| panic!("{lines}: {}", refused(error)));
        assert_eq!(
            made.text.lines().nth(made.first - 1),
            Some(behind),
            "{lines}"
        );
        assert_eq!(made.places.len(), 2, "{lines}");
    }
    // Comments about another tool, several probes, a block that may be skipped, and a tool number that is not there.
    for lines in [
        "(T1 MILL)\n(T24 PROBE)\nT1 M6\nG43 H1\nM30\n",
        "T1 M6 (NO PROBE)\nG43 H1\nM30\n",
        "T1 M6 (STOMP4)\nM30\n",
        "T1 M6 (PROBE)\nT2 M6 (PROBE)\nM30\n",
        "/T24 M6 (PROBE)\n/G43 H24\nT2 M6\nM30\n",
        "T24 M6 (PROBE)\n/G43 H24\nM30\n",
    ] {
        let error = insert(&fanuc, &format!("G21\n{lines}"), None).unwrap_err();
        assert!(refused(error).starts_with("no-place"), "{lines}");
    }
    let numbered = with(&fanuc, "control.tool", number(7.0));
    assert!(insert(&numbered, &other("fanuc", "mm"), None).is_err());
    // Windows' line ends, and a last line without an end.
    for other in [
        other("fanuc", "mm").replace('\n', "\r\n"),
        "T24 M6 (PROBE)".to_owned(),
    ] {
        let made = insert(&fanuc, &other, None).unwrap();
        assert!(made.text.contains(&other[..14]));
        assert_eq!(
            made.text.matches('\n').count(),
            made.text
                .matches("\r\n")
                .count()
                .max(if other.contains('\r') {
                    0
                } else {
                    made.text.matches('\n').count()
                })
        );
        let Ok(Imported::Job { findings, .. }) = import(&made.text) else {
            panic!("{other}");
        };
        assert_eq!(findings.len(), 1, "{findings:?}");
    }
}
