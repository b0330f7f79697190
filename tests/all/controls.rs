//! Requirements for each control of the list besides its writer, so that none is missed.

use std::collections::BTreeSet;

use crate::common::{job, owed, with};
use crate::tests::safety::{BROKEN, DANGEROUS};
use touchpath::control::iso::writer::Dialect;
use touchpath::control::native_run::CorrectsTools;
use touchpath::control::{ORIENT, POSTS, PostDef, ProgramForm, WRITE_OFFSET};
use touchpath::cycle::CYCLES;
use touchpath::form::{Field, Kind, Level, Value};
use touchpath::job::{self, SECTIONS, check, default_job, plan};

type Keys = Vec<&'static str>;

fn text(word: &str) -> Value {
    Value::Text(word.to_owned())
}

/// Keys of the controls with this ability, in the order of the form. A test names an ability, so that one more control joins it automatically.
fn which(can: impl Fn(&PostDef) -> bool) -> Keys {
    POSTS
        .iter()
        .filter(|post| can(post))
        .map(|post| post.key)
        .collect()
}

fn takes_moves(post: &PostDef) -> bool {
    CYCLES
        .iter()
        .any(|def| (post.supports)(def.probes, ProgramForm::Moves).is_ok())
}

/// A control's spelling of this word of a native call; empty without one.
fn word(post: &PostDef, number: u32, letter: &str) -> String {
    post.own
        .map_or_else(String::new, |own| (own.word)(number, letter))
}

/// Keys of the controls that support plain moves.
pub fn of_moves() -> Keys {
    which(takes_moves)
}

/// Controls whose programs of moves compute the results.
pub fn computing() -> Keys {
    which(|post| takes_moves(post) && post.computes)
}

/// Controls whose programs of moves have a decimal point in every number.
pub fn pointed() -> Keys {
    which(|post| takes_moves(post) && post.dialect.points)
}

/// Controls of moves whose numbers need no decimal point.
pub fn unpointed() -> Keys {
    which(|post| takes_moves(post) && !post.dialect.points)
}

/// Controls that touch with the skip function G31 and detect a contact by the distance to the end of the move: the simulated Fanuc runs them.
pub fn skipping() -> Keys {
    which(|post| takes_moves(post) && post.nearest_trigger > 0.0)
}

/// Controls whose programs have a number.
pub fn numbered() -> Keys {
    which(|post| !post.unused.contains(&"number"))
}

/// Controls whose programs have no number.
pub fn unnumbered() -> Keys {
    which(|post| post.unused.contains(&"number"))
}

/// Controls whose programs can write a work offset.
pub fn with_offsets() -> Keys {
    which(|post| post.work_offsets > 0)
}

/// Controls with native cycles whose path is known.
pub fn calling() -> Keys {
    which(|post| post.own.is_some())
}

/// Controls whose native cycles are Renishaw's macros: a letter precedes the number, whose thousands differ on a Brother.
pub fn calling_macros() -> Keys {
    which(|post| {
        let word = word(post, 9814, "D");
        let number = word.strip_prefix(|letter: char| letter.is_ascii_uppercase());
        number.is_some_and(|number| number.starts_with("9814 ") || number.starts_with("8814 "))
    })
}

/// Controls that call the macros with the usual numbers and letters, like a Fanuc.
pub fn calling_macros_as_a_fanuc() -> Keys {
    which(|post| word(post, 9814, "D") == "P9814 D")
}

/// Controls whose native cycles correct no tool offset.
pub fn correcting_no_tools() -> Keys {
    which(|post| {
        post.own
            .is_some_and(|own| own.corrects_tools == CorrectsTools::Never)
    })
}

/// Controls whose native cycles can correct a tool offset by a share of the error.
pub fn correcting_tools() -> Keys {
    which(|post| {
        post.own
            .is_some_and(|own| own.corrects_tools == CorrectsTools::AsAsked)
    })
}

/// Controls of one list that are not in another one.
pub fn without(keys: &[&'static str], others: &[&str]) -> Keys {
    keys.iter()
        .copied()
        .filter(|key| !others.contains(key))
        .collect()
}

#[test]
fn every_control_states_what_is_its_own() {
    let keys: BTreeSet<&str> = POSTS.iter().map(|post| post.key).collect();
    assert_eq!(keys.len(), POSTS.len());
    for post in POSTS {
        assert!(
            ![post.key, post.title, post.about, post.extension].contains(&""),
            "{}",
            post.key
        );
        assert!(
            (post.work_offsets > 0) == post.why_not(WRITE_OFFSET).is_none(),
            "{} does not say why it writes no work offset",
            post.key
        );
        let served = CYCLES
            .iter()
            .flat_map(|def| ProgramForm::ALL.map(|form| (post.supports)(def.probes, form)));
        assert!(
            served.clone().any(|answer| answer.is_ok()),
            "{} takes no cycle",
            post.key
        );
        assert!(
            served.clone().all(|answer| answer != Err("")),
            "{} does not say why",
            post.key
        );
        let hole = job(&format!(
            r#"{{ "format": 1, "cycle": {{ "type": "hole" }}, "control": {{ "post": "{}" }} }}"#,
            post.key
        ));
        let lines = touchpath::job::plan(&hole).map_or(0, |plan| plan.program.text.lines().count());
        assert!(
            lines > 10 || !of_moves().contains(&post.key),
            "{} writes no program",
            post.key
        );
        assert_eq!(
            post.read.is_some(),
            of_moves().contains(&post.key),
            "{}: programs of moves are read back",
            post.key
        );
    }
}

/// Lists of the controls, by hand from docs/controls.md, and from docs/programs.md for points, skips, numbers and macros. A control that is added later may be
/// in any.
#[test]
fn each_control_is_in_the_lists_of_what_it_can() {
    let today =
        "linuxcnc grbl grblhal fluidnc sinumerik heidenhain fanuc haas mazak brother hurco okuma";
    for (what, found, wanted) in [
        (
            "moves",
            of_moves(),
            "linuxcnc grbl grblhal fluidnc sinumerik fanuc haas",
        ),
        ("computes", computing(), "linuxcnc sinumerik fanuc haas"),
        ("points", pointed(), "fanuc haas"),
        (
            "no points",
            unpointed(),
            "linuxcnc grbl grblhal fluidnc sinumerik",
        ),
        ("skips", skipping(), "fanuc haas"),
        ("numbers", numbered(), "fanuc haas mazak hurco okuma"),
        (
            "no numbers",
            unnumbered(),
            "linuxcnc grbl grblhal fluidnc sinumerik heidenhain brother",
        ),
        (
            "work offsets",
            with_offsets(),
            "linuxcnc sinumerik heidenhain fanuc haas mazak brother hurco okuma",
        ),
        (
            "own cycles",
            calling(),
            "sinumerik heidenhain fanuc haas mazak brother hurco okuma",
        ),
        (
            "macros",
            calling_macros(),
            "fanuc haas mazak brother hurco okuma",
        ),
        (
            "macros as a Fanuc",
            calling_macros_as_a_fanuc(),
            "fanuc haas mazak hurco",
        ),
        (
            "tool offsets",
            correcting_tools(),
            "fanuc haas mazak brother hurco okuma",
        ),
    ] {
        let known = found
            .into_iter()
            .filter(|key| today.split(' ').any(|known| known == *key));
        assert_eq!(known.collect::<Vec<_>>().join(" "), wanted, "{what}");
    }
}

#[test]
fn every_control_has_a_judge() {
    for post in POSTS {
        assert!(
            owed::judge(post.key).is_some(),
            "nobody judges the programs of {}: add it to tests/common/owed.rs",
            post.key
        );
    }
}

#[test]
fn every_control_of_moves_has_broken_programs() {
    for post in of_moves() {
        let broken = BROKEN
            .iter()
            .any(|(_, key, ..)| key.trim_end_matches(" unwatched") == post);
        assert!(
            broken,
            "no broken program of {post} in tests/all/safety/mod.rs, BROKEN"
        );
        assert!(
            DANGEROUS.iter().any(|(key, _)| *key == post),
            "no dangerous lines of {post} in tests/all/safety/mod.rs, DANGEROUS"
        );
    }
}

#[test]
fn every_control_has_its_facts() {
    let page =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/programs.md")).unwrap();
    let headings: Vec<String> = page
        .lines()
        .filter(|line| line.starts_with("## "))
        .map(str::to_lowercase)
        .collect();
    for post in POSTS {
        let named = headings.iter().any(|heading| heading.contains(post.key));
        assert!(
            named,
            "docs/programs.md has no section on {}: what is sourced, recalled, and ours",
            post.key
        );
    }
}

/// A related control with comments of 30 characters and two decimals: its programs are written, read back and judged in that dialect.
#[test]
fn a_dialect_of_its_own_is_written() {
    let kin = touchpath::control::find("grbl").unwrap();
    let narrow: &Dialect = Box::leak(Box::new(Dialect {
        comment_width: 30,
        decimals_mm: 2,
        ..*kin.dialect
    }));
    let own: &PostDef = Box::leak(Box::new(PostDef {
        key: "own",
        dialect: narrow,
        ..*kin
    }));
    let pocket = job(
        r#"{ "format": 1, "cycle": { "type": "internal-rectangle", "width1": 80.123 }, "control": { "post": "grbl" } }"#,
    );
    let mut planned = job::planned(&pocket).unwrap();
    let wide = job::released(&planned).unwrap();
    assert!(
        wide.contains("X42.0615") && wide.lines().any(|line| line.len() > 60),
        "{wide}"
    );
    planned.job.post = own;
    let text = job::released(&planned).unwrap();
    assert!(text.contains("X42.06 "), "{text}");
    assert!(
        text.lines()
            .filter(|line| line.starts_with('('))
            .all(|line| line.len() <= 30),
        "{text}"
    );
    assert_eq!(own.half_digit(1.0), 0.005 * (1.0 + 1e-6));
}

/// Refusals of the control: every cycle in every form, and reasons against native cycles.
fn refused_jobs() -> Vec<Value> {
    let variants: [&[(&str, &str)]; 8] = [
        &[],
        &[("cycle.rotation", "30")],
        &[("cycle.count1", "3"), ("cycle.count2", "3")],
        &[("cycle.stepCount", "5"), ("cycle.angularStep", "70")],
        &[("cycle.elevation", "30")],
        &[("cycle.repeat", r#"{ "times": 2 }"#)],
        &[("control.workOffset", "1"), ("cycle.rotation", "30")],
        &[("plane", "\"G18\"")],
    ];
    let mut jobs = Vec::new();
    for post in POSTS {
        for def in CYCLES {
            for form in ProgramForm::ALL {
                for changes in variants {
                    let mut job = with(
                        &default_job(def.key).unwrap(),
                        "control.post",
                        text(post.key),
                    );
                    job = with(&job, "control.form", text(form.word()));
                    for (path, value) in changes {
                        let key = path.strip_prefix("cycle.");
                        if key.is_none_or(|key| {
                            key == "repeat" || def.fields.iter().any(|field| field.key == key)
                        }) {
                            job = with(&job, path, crate::common::job(value));
                        }
                    }
                    jobs.push(job);
                }
            }
        }
    }
    jobs
}

/// A message never recommends a refused form: if it names a form, the job is not refused for that form.
#[test]
fn no_message_recommends_what_the_control_refuses() {
    let mut asked = 0;
    for job in refused_jobs() {
        for finding in check(&job).into_iter().filter(|f| f.level == Level::Error) {
            for form in ProgramForm::ALL {
                if !finding
                    .message
                    .contains(&format!("Use the form \"{}\"", form.word()))
                {
                    continue;
                }
                let other = check(&with(&job, "control.form", text(form.word())));
                let refused: Vec<_> = other
                    .iter()
                    .filter(|f| f.level == Level::Error && f.message.contains("form \""))
                    .collect();
                assert!(refused.is_empty(), "{}\n{refused:?}", finding.message);
                asked += 1;
            }
        }
    }
    assert!(asked > 100, "{asked}");
}

/// Another valid value of a field.
fn changed(field: &Field) -> Vec<Value> {
    let numbers = |low: f64, high: f64| [low, high, (low + high) / 2.0].map(Value::Number).to_vec();
    let (low, high) = field
        .usual
        .unwrap_or((field.hard.min.max(1.0), field.hard.max.min(9.0)));
    match field.kind {
        Kind::Length | Kind::Feed | Kind::Acceleration | Kind::Time | Kind::Angle => {
            numbers(low, high)
        }
        Kind::Count => [1.0, 2.0, 7.0].map(Value::Number).to_vec(),
        Kind::Flag => [true, false].map(Value::Flag).to_vec(),
        Kind::Choice(choices) => choices.iter().map(|choice| text(choice.value)).collect(),
        Kind::Text(_) => vec![text("OTHER")],
        _ => Vec::new(),
    }
}

/// Changing a field of the control or a feed changes the program of some cycle, or a finding states that it has no effect.
#[test]
fn no_field_is_ignored_without_a_word() {
    let mut silent = BTreeSet::new();
    let fields = SECTIONS
        .iter()
        .filter(|section| ["control", "feeds"].contains(&section.key));
    let paths: Vec<(String, &Field)> = fields
        .flat_map(|section| {
            section
                .fields
                .iter()
                .map(move |field| (format!("{}.{}", section.key, field.key), field))
        })
        .collect();
    for post in POSTS {
        for form in ProgramForm::ALL {
            let cycles = CYCLES
                .iter()
                .filter(|def| (post.supports)(def.probes, form).is_ok());
            let mut jobs: Vec<Value> = cycles
                .map(|def| {
                    let job = with(
                        &default_job(def.key).unwrap(),
                        "control.post",
                        text(post.key),
                    );
                    with(
                        &with(&job, "control.form", text(form.word())),
                        "control.header",
                        text("short"),
                    )
                })
                .collect();
            // Some fields only matter for the correction of a tool.
            let bore = jobs.iter().find(|job| {
                job.get("cycle").and_then(|cycle| cycle.get("type")) == Some(&text("hole"))
            });
            let wear = r#"{ "diameter": { "tolerance": "±0.05", "wear": { "tool": 5, "parts": 3, "store": 520 } } }"#;
            let wear = touchpath::job::from_json(wear).unwrap();
            jobs.extend(bore.map(|job| with(job, "tolerances", wear)));
            let said = |job: &Value| {
                plan(job)
                    .map(|plan| (plan.program.text, plan.findings))
                    .map_err(|refused| refused.findings)
            };
            let before: Vec<_> = jobs.iter().map(said).collect();
            if before.iter().all(Result::is_err) {
                continue;
            }
            for (path, field) in &paths {
                let own =
                    ["control.post", "control.form", "control.header"].contains(&path.as_str());
                let changes = |value: &Value| {
                    jobs.iter()
                        .zip(&before)
                        .any(|(job, before)| said(&with(job, path, value.clone())) != *before)
                };
                if !own && !changed(field).iter().any(changes) {
                    silent.insert(format!("{path} on {} {}", post.key, form.word()));
                }
            }
        }
    }
    assert!(silent.is_empty(), "{silent:#?}");
}

/// A control with unsupported rules lists all of them: with the list of its base it would seem to turn a spindle.
#[test]
fn these_controls_turn_the_spindle() {
    let turns = POSTS.iter().filter(|post| post.why_not(ORIENT).is_none());
    let keys: Vec<&str> = turns.map(|post| post.key).collect();
    assert_eq!(keys, ["linuxcnc", "sinumerik", "fanuc", "haas"]);
}
