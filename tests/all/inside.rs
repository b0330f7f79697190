//! A program inside another one: what is around keeps its bytes, and what is inside stays the job's program.

use crate::common::{interpret, job, jobs, number, on_virtual_part, planned, with};
use touchpath::control::{POSTS, inside};
use touchpath::form::{Level, Value};
use touchpath::import::insert::{Insertion, insert};
use touchpath::import::{Imported, import};
use touchpath::job::{JobError, plan};

/// A program of each language with a probe, a tool before and a tool after it. Jobs in inch get the same in inch.
fn other(post: &str, units: &str) -> String {
    let inch = units == "inch";
    match post {
        "sinumerik" => format!(
            "%_N_PART_MPF\n;$PATH=/_N_WKS_DIR\nN10 G17 {} G90\nT=\"MILL\"\nM6\nG54 D1\nG0 Z100\nT=\"PROBE\"\nM6\nD1\nG0 Z200\nT=\"DRILL\"\nM6\nD1\nR5=3\nM30\n",
            if inch { "G70" } else { "G71" }
        ),
        "linuxcnc" | "grbl" | "grblhal" | "fluidnc" => format!(
            "(PART)\n{} G17 G90\nT1 M6\nG43\nG0 Z100\n(the probe)\nT24 M6\nG43 H24\nG0 Z200\nT2 M6\nG43\nM30\n",
            if inch { "G20" } else { "G21" }
        ),
        _ => format!(
            "%\nO0100 (PART)\n{} G17 G90\nT1 M6\nG54\nG43 H1 Z100.\nN10 (PROBE)\nT24 M6\nG43 H24 Z200.\nM19\n\nT2 M6\n#120=5.\nG43 H2 Z100.\nM30\n%\n",
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
    for (name, job, program) in programs() {
        let post = text(&job, ["control", "post"]).unwrap();
        if post == "heidenhain" {
            continue;
        }
        let other = other(post, units(&job));
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
    assert!(seen > 250, "{seen}");
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
    let labels: String = (0..10).map(|k| format!("N{}\n", 9001 + 100 * k)).collect();
    assert!(why(&fanuc, &format!("{part}{labels}"), None).contains("labels"));
    let wrong = with(&fanuc, "cycle.diameter", number(2.0));
    assert!(!why(&wrong, &part, None).contains("insert"));
    let klartext = job(
        r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "post": "heidenhain", "form": "cycle" } }"#,
    );
    let program = "0 BEGIN PGM A MM\n1 TOOL CALL 24 Z\n2 END PGM A MM\n";
    assert!(why(&klartext, program, Some(1)).contains("numbers every block"));
}

#[test]
fn the_tool_change_of_the_probe_is_found() {
    let fanuc = job(
        r#"{ "format": 1, "name": "BORE", "cycle": { "type": "hole" }, "control": { "post": "fanuc" } }"#,
    );
    let head = "G21 G90\nT1 M6\nG43 H1\nG0 Z50.\n";
    for (lines, behind) in [
        ("T24 M06 (TASTER)\nG0 X0\nG43 H24\nG0 X1.\nM30\n", "G43 H24"),
        ("(OMP40)\n/T24\nM6\nG43H24Z50.\nM30\n", "G43H24Z50."),
        (
            "(RENISHAW PROBE) T24 M6\nM19\nM30\n",
            "(RENISHAW PROBE) T24 M6",
        ),
        ("T24 M6\n(3D-TASTER)\nG54\nM30\n", "T24 M6"),
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
