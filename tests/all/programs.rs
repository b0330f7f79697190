//! The programs in `tests/programs`. Comments at the top of each file give its start, its inputs, and the expected results. `tests/README.md` has the notation.

use std::path::{Path, PathBuf};

use crate::common::{import, interpret};
use touchpath::form::Value;
use touchpath::import::toolpath::{
    DIALECTS, Feature, KINDS, PROGRAM_POSTS, RunInputs, TriggerAt, run_program,
};
use touchpath::import::{Toolpath, read_program};

/// Function that reads a text.
#[derive(Clone, Copy, PartialEq)]
enum Door {
    /// `readProgram`: without inputs.
    Read,
    /// `runProgram`, with inputs.
    Run,
    /// `importJob`: the strict reader.
    Import,
}

/// A program of a file, read by one function.
#[derive(Clone)]
struct Case {
    door: Door,
    dialect: Option<&'static str>,
    post: Option<&'static str>,
    /// Whether work offsets and lengths are 0.
    zero: bool,
    start: Option<[f64; 3]>,
    touch: TriggerAt,
    positioning: TriggerAt,
    set: Vec<(String, f64)>,
    part: Option<Value>,
    files: Vec<(String, String)>,
    /// Expected results: a key and its value.
    wanted: Vec<(String, String)>,
}

/// The header of a file and the program below it. The header is the comments at the top; `; program:` ends it if the program itself begins with a comment.
fn split(text: &str) -> (Vec<&str>, &str) {
    let mut rest = text;
    let mut header = Vec::new();
    while let Some(line) = rest.lines().next().filter(|line| line.starts_with(';')) {
        rest = rest[line.len()..]
            .trim_start_matches('\r')
            .strip_prefix('\n')
            .unwrap_or("");
        if line.trim() == "; program:" {
            break;
        }
        header.push(line);
    }
    (header, rest)
}

/// The directives of a header with their continuation lines. Sentences begin with a capital letter.
fn directives(header: &[&str]) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    let mut prose = false;
    for line in header {
        let text = &line[1..];
        if text.trim().is_empty() {
            continue;
        }
        if text.starts_with("   ") {
            if !prose {
                let (_, value) = found
                    .last_mut()
                    .unwrap_or_else(|| panic!("{line:?} continues nothing"));
                value.push(' ');
                value.push_str(text.trim());
            }
            continue;
        }
        let text = text.trim();
        prose = !text.starts_with(|c: char| c.is_ascii_lowercase());
        if !prose {
            let (key, value) = text.split_once(':').unwrap_or_else(|| {
                panic!("{line:?} has no colon: a sentence begins with a capital letter")
            });
            found.push((key.trim().to_owned(), value.trim().to_owned()));
        }
    }
    found
}

fn place(text: &str) -> [f64; 3] {
    let numbers: Vec<f64> = text
        .split_whitespace()
        .map(|word| {
            if word == "?" {
                f64::NAN
            } else {
                word.parse().unwrap_or_else(|_| panic!("{text}"))
            }
        })
        .collect();
    numbers
        .try_into()
        .unwrap_or_else(|_| panic!("{text:?} is not three numbers"))
}

/// `touch 0.5 positioning never`: trigger points of probing moves.
fn trips(case: &mut Case, text: &str) {
    let words: Vec<&str> = text.split_whitespace().collect();
    for pair in words.chunks(2) {
        let trip = match pair {
            [_, "never"] => TriggerAt::Never,
            [_, share] => TriggerAt::At(share.parse().unwrap_or_else(|_| panic!("{text:?}"))),
            _ => panic!("{text:?}"),
        };
        match pair[0] {
            "touch" => case.touch = trip,
            "positioning" => case.positioning = trip,
            other => panic!("{other} of {text:?} is not known"),
        }
    }
}

/// The cases of a header. Lines above the first one belong to all of them.
fn cases(header: &[&str], folder: &Path) -> Vec<Case> {
    let mut all = Case {
        door: Door::Read,
        dialect: None,
        post: None,
        zero: false,
        start: None,
        touch: TriggerAt::Unknown,
        positioning: TriggerAt::Unknown,
        set: Vec::new(),
        part: None,
        files: Vec::new(),
        wanted: Vec::new(),
    };
    let mut cases: Vec<Case> = Vec::new();
    for (key, value) in directives(header) {
        let door = match key.as_str() {
            "read" => Some(Door::Read),
            "run" => Some(Door::Run),
            "import" => Some(Door::Import),
            _ => None,
        };
        if let Some(door) = door {
            let mut case = Case {
                door,
                ..all.clone()
            };
            trips(&mut case, &value);
            cases.push(case);
            continue;
        }
        let begun = !cases.is_empty();
        let case = cases.last_mut().unwrap_or(&mut all);
        match key.as_str() {
            "dialect" => {
                case.dialect = Some(
                    DIALECTS
                        .into_iter()
                        .find(|one| *one == value)
                        .unwrap_or_else(|| panic!("no dialect {value}")),
                );
            }
            "post" => {
                case.post = Some(
                    PROGRAM_POSTS
                        .into_iter()
                        .find(|one| *one == value)
                        .unwrap_or_else(|| panic!("no control {value}")),
                );
            }
            "offsets" => case.zero = value == "0",
            "start" => case.start = Some(place(&value)),
            "set" => {
                for pair in value.split_whitespace() {
                    let (name, x) = pair.split_once('=').unwrap_or_else(|| panic!("{pair}"));
                    case.set.push((
                        name.to_owned(),
                        x.parse().unwrap_or_else(|_| panic!("{pair}")),
                    ));
                }
            }
            "part" => {
                case.part = Some(
                    touchpath::job::from_json(&value)
                        .unwrap_or_else(|why| panic!("{value}: {why:?}")),
                )
            }
            "file" => {
                let text = std::fs::read_to_string(folder.join("called").join(&value))
                    .unwrap_or_else(|why| panic!("{value}: {why}"));
                case.files.push((value, text));
            }
            _ => {
                assert!(begun, "{key}: stands above the first read, run or import");
                case.wanted.push((key, value));
            }
        }
    }
    cases
}

/// A coordinate in the notation of the files: to a ten-thousandth, `?` if unknown.
fn coordinate(x: f64) -> String {
    if x.is_nan() {
        "?".to_owned()
    } else {
        format!("{}", (x * 1e4).round() / 1e4 + 0.0)
    }
}

fn coordinates(p: impl IntoIterator<Item = f64>) -> String {
    p.into_iter().map(coordinate).collect::<Vec<_>>().join(" ")
}

fn list(rows: impl IntoIterator<Item = String>, between: &str) -> String {
    let rows: Vec<String> = rows.into_iter().collect();
    if rows.is_empty() {
        "none".to_owned()
    } else {
        rows.join(between)
    }
}

/// `name:line` of a 0-based line; only the line in the program itself.
fn line_of(case: &Case, file: u32, line: u32) -> String {
    match file {
        0 => (line + 1).to_string(),
        file => format!("{}:{}", case.files[file as usize - 1].0, line + 1),
    }
}

fn place_in(path: &Toolpath, case: &Case, index: usize) -> String {
    line_of(
        case,
        path.file.get(index).copied().unwrap_or(0),
        path.line[index],
    )
}

fn numbered(lines: &[u32]) -> String {
    list(lines.iter().map(|line| (line + 1).to_string()), " ")
}

/// Value and meaning of an argument in the first call that has it.
fn argument(path: &Toolpath, name: &str) -> String {
    let found = path
        .calls
        .iter()
        .flat_map(|call| &call.arguments)
        .find(|argument| argument.name == name);
    found.map_or("none".to_owned(), |argument| {
        format!(
            "{} {}",
            coordinate(argument.value.unwrap_or(f64::NAN)),
            argument.meaning.unwrap_or("not known")
        )
    })
}

/// `all hold`, or the rules that do not hold, or whose result is unknown.
fn rules(path: &Toolpath) -> String {
    let states = path.rules.iter().filter(|rule| rule.holds != Some(true));
    let rows = states.map(|rule| {
        format!(
            "{}: {}",
            rule.rule,
            if rule.holds.is_some() {
                "broken"
            } else {
                "not known"
            }
        )
    });
    match list(rows, " | ") {
        rows if rows == "none" && !path.rules.is_empty() => "all hold".to_owned(),
        rows => rows,
    }
}

/// A move; with its feed if that is expected.
fn moved(path: &Toolpath, index: usize, feed: bool) -> String {
    let kind = KINDS[usize::from(path.kind[index])];
    let feed = if feed {
        format!(" F{}", coordinate(path.feed[index]))
    } else {
        String::new()
    };
    format!("{kind} {}{feed}", coordinates(path.end(index).to_array()))
}

/// Result of a program in the notation of a key. Panics for an unknown key.
fn found(path: &Toolpath, case: &Case, text: &str, key: &str, wanted: &str) -> String {
    let feed = wanted.contains(" F");
    let row = |index: usize| {
        format!(
            "{} {}",
            place_in(path, case, index),
            moved(path, index, feed)
        )
    };
    let indices = 0..path.len();
    match key {
        "moves" => list(indices.map(row), " | "),
        "last" => list(indices.last().map(row), ""),
        "first" => list((!path.is_empty()).then(|| row(0)), ""),
        "count" => path.len().to_string(),
        "lines" => list(indices.map(|index| place_in(path, case, index)), " "),
        "kinds" => list(
            indices.map(|index| KINDS[usize::from(path.kind[index])].to_owned()),
            " ",
        ),
        "probes" => indices
            .filter(|index| KINDS[usize::from(path.kind[*index])] == "probe")
            .count()
            .to_string(),
        "findings" => list(
            path.findings.iter().map(|finding| finding.code.clone()),
            " ",
        ),
        "asks" => list(path.asks.iter().map(|ask| ask.name.clone()), " "),
        "systems" => {
            let rows = path.systems.iter().map(|[index, x, y, z, angle]| {
                let turn = if *angle == 0.0 {
                    String::new()
                } else {
                    format!(" turned {}", coordinate(*angle))
                };
                format!(
                    "{} {}{turn}",
                    path.line[*index as usize] + 1,
                    coordinates([*x, *y, *z])
                )
            });
            list(rows, " | ")
        }
        "writes" => {
            let rows = path.writes.iter().map(|write| {
                let value = write.value.map_or("?".to_owned(), coordinate);
                let axis = write.axis.unwrap_or("?");
                let line = line_of(case, write.file, write.line);
                format!("{line} {} {} {axis} {value}", write.kind, write.register)
            });
            list(rows, " | ")
        }
        "contacts" => list(
            path.contacts
                .iter()
                .map(|[_, place @ ..]| coordinates(*place)),
            " | ",
        ),
        "resumes" => {
            let rows = path.resumes.iter().map(|[index, place @ ..]| {
                format!("{} {}", path.line[*index as usize] + 1, coordinates(*place))
            });
            list(rows, " | ")
        }
        "arcs" => {
            let rows = path.arcs.iter().map(|[index, x, y, z, sweep, plane]| {
                format!(
                    "{} {} turn {} G{plane}",
                    path.line[*index as usize] + 1,
                    coordinates([*x, *y, *z]),
                    coordinate(*sweep)
                )
            });
            list(rows, " | ")
        }
        "calls" => {
            let rows = path.calls.iter().map(|call| {
                let contradictions: String = call
                    .contradictions
                    .iter()
                    .map(|text| format!("; {text}"))
                    .collect();
                let line = line_of(case, call.file, call.line);
                format!(
                    "{line} {}: {}{contradictions}",
                    call.name,
                    call.title.unwrap_or("not known")
                )
            });
            list(rows, " | ")
        }
        "broken" => {
            let broken = path.rules.iter().filter(|rule| rule.holds == Some(false));
            list(
                broken.map(|rule| {
                    format!("{}@{}", rule.rule, numbered(&rule.lines).replace(' ', ","))
                }),
                " ",
            )
        }
        "rules" => rules(path),
        "plane" => path.plane.word().to_owned(),
        "is" => {
            let units = path
                .metric
                .map_or("no units", |metric| if metric { "mm" } else { "inch" });
            format!("{} {units}", path.dialect)
        }
        "judge" => judged(path, text),
        _ => match key.split_once(' ') {
            Some(("line", line)) => {
                let line: u32 = line.parse().unwrap_or_else(|_| panic!("{key}"));
                list(
                    indices
                        .filter(|index| path.line[*index] + 1 == line)
                        .map(|index| moved(path, index, feed)),
                    " | ",
                )
            }
            Some(("ask", name)) => path
                .asks
                .iter()
                .find(|ask| ask.name == name)
                .map_or("none".to_owned(), |ask| numbered(&ask.lines)),
            Some(("argument", name)) => argument(path, name),
            _ => panic!("{key}: is not known"),
        },
    }
}

/// `linuxcnc` if every move equals that of LinuxCNC's interpreter, in which a probing move ends at its target.
fn judged(path: &Toolpath, text: &str) -> String {
    let ran = match interpret(text) {
        Ok(ran) => ran,
        Err(why) => return format!("refused: {why}"),
    };
    if ran.moves.len() != path.len() {
        return format!("{} moves, linuxcnc {}", path.len(), ran.moves.len());
    }
    for (index, other) in ran.moves.iter().enumerate() {
        let own = path.end(index).to_array();
        // An axis that no block has moved is at 0 there, and unknown here.
        let near = |axis: usize| {
            (own[axis] - other.to[axis]).abs() < 1e-3 || own[axis].is_nan() && other.to[axis] == 0.0
        };
        let kind = if other.kind == "arc" {
            "feed"
        } else {
            other.kind
        };
        if !(0..3).all(near) || kind != KINDS[usize::from(path.kind[index])] {
            return format!(
                "move {index} is {}, linuxcnc {} {:?}",
                moved(path, index, false),
                other.kind,
                other.to
            );
        }
    }
    "linuxcnc".to_owned()
}

/// A finding: its code, its message, its 0-based lines.
type Said = (String, String, Vec<u32>);

/// Whether some finding matches `code "text" in line N`; `wanted` may omit text and line.
fn has_finding(findings: &[Said], wanted: &str) -> bool {
    let (code, rest) = wanted.split_once(' ').unwrap_or((wanted, ""));
    let part = rest
        .split_once('"')
        .and_then(|(_, rest)| rest.rsplit_once('"'))
        .map_or("", |(part, _)| part);
    let line = rest
        .rsplit_once("in line ")
        .filter(|_| !rest.ends_with('"'))
        .map(|(_, line)| line.parse::<u32>().expect("a line"));
    findings.iter().any(|(own, message, lines)| {
        own == code && message.contains(part) && line.is_none_or(|line| lines.contains(&(line - 1)))
    })
}

/// The moves of the strict reader, each with its line.
fn imported(text: &str) -> (Option<Vec<String>>, Vec<Said>) {
    let (trace, findings) = match import(text) {
        Ok(read) => (read.trace, read.findings),
        Err(error) => (None, error.findings),
    };
    let row = |one: &touchpath::import::TraceMove| {
        let kind = format!("{:?}", one.kind).to_lowercase();
        format!(
            "{} {kind} {}",
            one.line + 1,
            coordinates(one.to.map(|x| x.unwrap_or(f64::NAN)))
        )
    };
    let moves = trace.map(|trace| trace.moves.iter().map(row).collect());
    (
        moves,
        findings
            .into_iter()
            .map(|finding| (finding.code, finding.message, Vec::new()))
            .collect(),
    )
}

/// The path of the lenient reader.
fn followed(case: &Case, text: &str) -> (Toolpath, Vec<Said>) {
    let path = if case.door == Door::Read {
        read_program(text, case.dialect)
    } else {
        run_program(
            text,
            &RunInputs {
                dialect: case.dialect,
                set: case
                    .set
                    .iter()
                    .map(|(name, x)| (name.as_str(), *x))
                    .collect(),
                post: case.post,
                zero: case.zero,
                start: case.start,
                touch: case.touch,
                positioning: case.positioning,
                feature: case
                    .part
                    .as_ref()
                    .map(|job| Feature::of(job).expect("a part without errors")),
                files: case
                    .files
                    .iter()
                    .map(|(name, text)| (name.as_str(), text.as_str()))
                    .collect(),
            },
        )
    };
    let findings = path.findings.iter().zip(&path.finding_lines);
    let findings = findings
        .map(|(one, lines)| (one.code.clone(), one.message.clone(), lines.clone()))
        .collect();
    (path, findings)
}

/// Differences between a case and its file.
fn wrong(case: &Case, text: &str) -> Vec<String> {
    let import = case.door == Door::Import;
    let (moves, path, findings) = if import {
        let (moves, findings) = imported(text);
        (moves, Toolpath::default(), findings)
    } else {
        let (path, findings) = followed(case, text);
        (None, path, findings)
    };
    let own = |key: &str, wanted: &str| match key {
        "finding" | "no finding" => {
            let there = has_finding(&findings, wanted);
            if there == (key == "finding") {
                wanted.to_owned()
            } else {
                format!("{there} of {findings:?}")
            }
        }
        "findings" => list(findings.iter().map(|(code, ..)| code.clone()), " "),
        "moves" if import => moves
            .clone()
            .map_or("refused".to_owned(), |moves| list(moves, " | ")),
        _ if import => panic!("{key}: is not known of an import"),
        _ => found(&path, case, text, key, wanted),
    };
    let rows = case
        .wanted
        .iter()
        .map(|(key, wanted)| (key, wanted, own(key, wanted)));
    rows.filter(|(_, wanted, own)| *wanted != own)
        .map(|(key, wanted, own)| {
            format!(
                "  {key}: {own}\n  {0:>1$}: {wanted}\n  {findings:?}",
                "not",
                key.len()
            )
        })
        .collect()
}

/// Every program, by its path.
fn programs() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs");
    let entries = std::fs::read_dir(folder).expect("tests/programs");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .collect();
    paths.sort();
    paths
}

#[test]
fn each_program_comes_to_what_its_file_says() {
    let mut failures = Vec::new();
    let (mut programs_read, mut asked) = (0, 0);
    for path in programs() {
        let name = path
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let whole = std::fs::read_to_string(&path).unwrap_or_else(|why| panic!("{name}: {why}"));
        let (header, text) = split(&whole);
        let cases = cases(&header, path.parent().expect("a folder"));
        assert!(
            !cases.is_empty(),
            "{name}: nothing is read, run or imported"
        );
        for (index, case) in cases.iter().enumerate() {
            assert!(
                !case.wanted.is_empty(),
                "{name}: nothing is expected of case {}",
                index + 1
            );
            failures.extend(
                wrong(case, text)
                    .into_iter()
                    .map(|why| format!("{name}, case {}\n{why}", index + 1)),
            );
            asked += case.wanted.len();
        }
        programs_read += 1;
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(
        programs_read > 155 && asked > 310,
        "{asked} of {programs_read} programs"
    );
}

/// A runner that finds no difference would prove nothing: each kind of expectation must fail if it is wrong.
#[test]
fn a_wrong_expectation_is_found() {
    let text = "G21 G90\nG0 X1 Y2 Z3\nG38.2 Z-5 F50\nWHAT\nM2\n";
    let case = |wanted: &str| {
        let header = format!("; read:\n; {wanted}\n");
        wrong(
            &cases(&split(&format!("{header}{text}")).0, Path::new("."))[0],
            text,
        )
    };
    for (right, not) in [
        (
            "moves: 2 rapid 1 2 3 | 3 probe 1 2 -5",
            "moves: 2 rapid 1 2 3",
        ),
        ("line 3: probe 1 2 -5 F50", "line 3: probe 1 2 -5 F51"),
        ("last: 3 probe 1 2 -5", "last: 3 probe 1 2 ?"),
        ("count: 2", "count: 3"),
        ("kinds: rapid probe", "kinds: rapid feed"),
        ("findings: lines-skipped", "findings: none"),
        (
            "finding: lines-skipped \"not understood\" in line 4",
            "finding: lines-skipped in line 3",
        ),
        ("no finding: start-unknown", "no finding: lines-skipped"),
        ("is: iso mm", "is: iso inch"),
        ("asks: none", "asks: #1"),
        ("plane: G17", "plane: G18"),
        ("rules: none", "rules: all hold"),
        ("ask #1: none", "ask #1: 3"),
        ("argument D: none", "argument D: 5 diameter"),
    ] {
        assert_eq!(
            (case(right).len(), case(not).len()),
            (0, 1),
            "{right} / {not}: {:?}",
            case(right)
        );
    }
}
