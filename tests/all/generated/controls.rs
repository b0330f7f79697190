//! The matrix of controls and cycles, printed from the list of controls: a page of the manual.

use std::fmt::Write;

use touchpath::control::safety::RULES;
use touchpath::control::{POSTS, PostDef, ProgramForm, WRITE_OFFSET};
use touchpath::cycle::{CYCLES, CycleDef};
use touchpath::path::FeatureKind;

fn cell(post: &PostDef, def: &CycleDef) -> &'static str {
    // Rows without touches: a program of moves states its modes and ends.
    if matches!(def.probes, FeatureKind::Switch | FeatureKind::Action) {
        return match ProgramForm::ALL.map(|form| (post.supports)(def.probes, form).is_ok()) {
            [_, true] => "native cycle",
            [true, false] => "table only",
            [false, false] => "–",
        };
    }
    match ProgramForm::ALL.map(|form| (post.supports)(def.probes, form).is_ok()) {
        [true, true] => "moves, own cycle",
        [true, false] => "moves",
        [false, true] => "native cycle",
        [false, false] => "–",
    }
}

fn matrix() -> String {
    let heads: Vec<&str> = POSTS.iter().map(|post| post.title).collect();
    let mut text = format!(
        "| cycle | source | {} |\n|---|---|{}\n",
        heads.join(" | "),
        "---|".repeat(POSTS.len())
    );
    for def in CYCLES {
        let cells: Vec<&str> = POSTS.iter().map(|post| cell(post, def)).collect();
        let page = format!("cycles/{}.md", def.key);
        writeln!(
            text,
            "| [{}]({page}) | {} | {} |",
            def.title,
            def.source,
            cells.join(" | ")
        )
        .unwrap();
    }
    text
}

/// `docs/controls.md`.
pub fn page() -> String {
    let mut text = "# The controls\n\n<!-- generated: UPDATE=1 cargo test --lib generated -->\n\nWhat each control takes, what its programs \
        hold, and what they cannot. [The programs](programs.md) says how they are written, and where that comes from.\n\n"
        .to_owned();
    text.push_str(&matrix());
    text.push_str(
        "\n*Table only*: the cycle is rows of the parameter table. A program says the job in its header, states its modes and ends; it switches nothing and moves \
         nothing (`nothing-switched`).\n",
    );
    text.push_str(
        "\n## What a program has\n\n| control | `control.post` | file | work offsets | positioning is watched | computes the results |\n\
         |---|---|---|---|---|---|\n",
    );
    let yes = |is: bool| if is { "yes" } else { "no" };
    // A control without plain moves uses its native cycle for both.
    let moves = |post: &PostDef| {
        CYCLES
            .iter()
            .any(|def| (post.supports)(def.probes, ProgramForm::Moves).is_ok())
    };
    let by = |post: &PostDef, is: bool| {
        if moves(post) {
            yes(is)
        } else {
            "by its own cycle"
        }
    };
    for post in POSTS {
        let offsets = match post.work_offsets {
            0 => format!(
                "none: {}",
                post.why_not(WRITE_OFFSET)
                    .map_or_else(String::new, |why| post.control_text(why).english())
            ),
            last => format!(
                "{} to {}",
                (post.work_offset_word)(1),
                (post.work_offset_word)(last)
            ),
        };
        let cells = [
            post.title,
            post.key,
            post.extension,
            &offsets,
            by(post, post.watches_positioning),
            by(post, post.computes),
        ];
        writeln!(
            text,
            "| {} | `{}` | `.{}` | {} | {} | {} |",
            cells[0], cells[1], cells[2], cells[3], cells[4], cells[5]
        )
        .unwrap();
    }
    text.push('\n');
    for post in POSTS {
        writeln!(
            text,
            "- **{}** (`.{}`): {}",
            post.title, post.extension, post.about
        )
        .unwrap();
    }
    text.push_str("\n## What they do not take, and why\n");
    for post in POSTS {
        let mut reasons: Vec<(&str, Vec<&str>)> = Vec::new();
        for (def, form) in CYCLES
            .iter()
            .flat_map(|def| ProgramForm::ALL.map(|form| (def, form)))
        {
            let Err(why) = (post.supports)(def.probes, form) else {
                continue;
            };
            let what = if form == ProgramForm::Moves {
                "moves"
            } else {
                "native cycle"
            };
            match reasons.iter_mut().find(|(known, _)| *known == why) {
                Some((_, titles)) if titles.last() != Some(&def.title) => titles.push(def.title),
                Some(_) => {}
                None => reasons.push((why, vec![what, def.title])),
            }
        }
        writeln!(text, "\n### {}\n", post.title).unwrap();
        for (why, titles) in reasons {
            let all = titles.len() > CYCLES.len();
            let which = if all {
                "any cycle".to_owned()
            } else {
                titles[1..].join(", ")
            };
            writeln!(text, "- As {}, {which}: {why}.", titles[0]).unwrap();
        }
    }
    text.push_str(
        "\n## Safety rules\n\nEvery program is read back and followed: what it does when all goes well, when a positioning move hits something, when a \
         touch makes no contact, with a probe that is deflected from the start, and from a stylus that is too low. Then every rule is asked. A program \
         that breaks one is refused, but for the two that depend on what the job asks for.\n\n| rule | what it asks | why | cannot |\n|---|---|---|---|\n",
    );
    for rule in RULES {
        let cannot: Vec<String> = POSTS
            .iter()
            .flat_map(|post| {
                post.unsupported_rules
                    .iter()
                    .filter(|(name, _)| *name == rule.name)
                    .map(move |(_, why)| {
                        format!("{}: {}", post.title, post.control_text(why).english())
                    })
            })
            .collect();
        let job = if rule.mandatory {
            ""
        } else {
            " (as the job asks)"
        };
        writeln!(
            text,
            "| `{}`{job} | {} | {} | {} |",
            rule.name,
            rule.requirement,
            rule.why,
            cannot.join("; ")
        )
        .unwrap();
    }
    text
}
