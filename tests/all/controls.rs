//! What each control of the list must have beside its writer: nobody adds one and is told so by chance.

use std::collections::BTreeSet;

use crate::common::{job, owed};
use crate::tests::safety::{BROKEN, DANGEROUS};
use touchpath::control::iso::writer::Dialect;
use touchpath::control::{Form, POSTS, PostDef};
use touchpath::cycle::CYCLES;
use touchpath::job;

/// The keys of the controls that take plain moves.
pub fn of_moves() -> Vec<&'static str> {
    let takes = |post: &&&PostDef| CYCLES.iter().any(|def| (post.serves)(def.probes, Form::Moves).is_ok());
    POSTS.iter().filter(takes).map(|post| post.key).collect()
}

#[test]
fn every_control_states_what_is_its_own() {
    let keys: BTreeSet<&str> = POSTS.iter().map(|post| post.key).collect();
    assert_eq!(keys.len(), POSTS.len());
    for post in POSTS {
        assert!(![post.key, post.title, post.about, post.extension].contains(&""), "{}", post.key);
        assert!(
            post.work_offsets > 0 || !post.no_work_offset.is_empty(),
            "{} does not say why it writes no work offset",
            post.key
        );
        let served = CYCLES.iter().flat_map(|def| Form::ALL.map(|form| (post.serves)(def.probes, form)));
        assert!(served.clone().any(|answer| answer.is_ok()), "{} takes no cycle", post.key);
        assert!(served.clone().all(|answer| answer != Err("")), "{} does not say why", post.key);
        let hole =
            job(&format!(r#"{{ "format": 1, "cycle": {{ "type": "hole" }}, "control": {{ "post": "{}" }} }}"#, post.key));
        let lines = touchpath::job::plan(&hole).map_or(0, |plan| plan.program.text.lines().count());
        assert!(lines > 10 || !of_moves().contains(&post.key), "{} writes no program", post.key);
        assert_eq!(post.read.is_some(), of_moves().contains(&post.key), "{}: programs of moves are read back", post.key);
    }
}

#[test]
fn every_control_has_a_judge() {
    for post in POSTS {
        assert!(owed::judge(post.key).is_some(), "nobody judges the programs of {}: add it to tests/common/owed.rs", post.key);
    }
}

#[test]
fn every_control_of_moves_has_broken_programs() {
    for post in of_moves() {
        let broken = BROKEN.iter().any(|(_, key, ..)| key.trim_end_matches(" unwatched") == post);
        assert!(broken, "no broken program of {post} in tests/all/safety/mod.rs, BROKEN");
        assert!(
            DANGEROUS.iter().any(|(key, _)| *key == post),
            "no dangerous lines of {post} in tests/all/safety/mod.rs, DANGEROUS"
        );
    }
}

#[test]
fn every_control_has_its_facts() {
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/programs.md")).unwrap();
    let headings: Vec<String> = page.lines().filter(|line| line.starts_with("## ")).map(str::to_lowercase).collect();
    for post in POSTS {
        let named = headings.iter().any(|heading| heading.contains(post.key));
        assert!(named, "docs/programs.md has no section on {}: what is sourced, recalled, and ours", post.key);
    }
}

/// A control of a kin with comments of 30 characters and two decimals: its programs are written, read back and judged so.
#[test]
fn a_dialect_of_its_own_is_written() {
    let kin = touchpath::control::find("grbl").unwrap();
    let narrow: &Dialect = Box::leak(Box::new(Dialect { comment_width: 30, decimals_mm: 2, ..*kin.dialect }));
    let own: &PostDef = Box::leak(Box::new(PostDef { key: "own", dialect: narrow, ..*kin }));
    let pocket =
        job(r#"{ "format": 1, "cycle": { "type": "internal-rectangle", "width1": 80.123 }, "control": { "post": "grbl" } }"#);
    let mut planned = job::planned(&pocket).unwrap();
    let wide = job::released(&planned).unwrap();
    assert!(wide.contains("X42.0615") && wide.lines().any(|line| line.len() > 60), "{wide}");
    planned.job.post = own;
    let text = job::released(&planned).unwrap();
    assert!(text.contains("X42.06 "), "{text}");
    assert!(text.lines().filter(|line| line.starts_with('(')).all(|line| line.len() <= 30), "{text}");
    assert_eq!(own.half_digit(1.0), 0.005 * (1.0 + 1e-6));
}
