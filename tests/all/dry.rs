//! A dry run: the same moves without a part, on the simulated controls and LinuxCNC's interpreter.

use crate::common::fanuc::Control;
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{import, interpret, interpret_until_stop, job, law, number, planned, with};
use crate::tests::controls::{of_moves, skipping};
use crate::tests::laws::whole_job;
use proptest::prelude::*;
use touchpath::control::{POSTS, ProgramForm};
use touchpath::cycle::{CYCLES, CycleDef};
use touchpath::form::Value;
use touchpath::job::{Plan, check, default_job, plan};

fn text(word: &str) -> Value {
    Value::Text(word.to_owned())
}

fn hole() -> &'static CycleDef {
    touchpath::cycle::find("hole").expect("a cycle")
}

fn dry(job: &Value, lift: f64) -> Value {
    with(
        &with(job, "control.run", text("dry")),
        "control.lift",
        number(lift),
    )
}

/// A job for a control, with a write if it supports one.
fn writing(cycle: &str, post: &str) -> Value {
    let job = with(&default_job(cycle).unwrap(), "control.post", text(post));
    let takes = POSTS
        .iter()
        .any(|known| known.key == post && known.work_offsets > 0);
    let job = if takes {
        with(&job, "control.workOffset", number(1.0))
    } else {
        job
    };
    with(&job, "control.form", text(ProgramForm::Moves.word()))
}

fn lines_of_moves(plan: &Plan) -> Vec<String> {
    let lines: Vec<&str> = plan.program.text.lines().collect();
    plan.program
        .move_lines
        .iter()
        .map(|line| lines[usize::try_from(*line).unwrap()].to_owned())
        .collect()
}

/// Read back, each program is the path of the job, raised, without a touch or a write; a touch keeps its feed.
#[test]
fn every_cycle_has_a_dry_run_on_every_control_that_takes_moves() {
    let mut seen = 0;
    for post in of_moves() {
        for def in CYCLES {
            let given = writing(def.key, post);
            let Ok(normal) = plan(&given) else { continue };
            let dry = planned(&dry(&given, 40.0));
            assert_eq!(
                dry.moves, normal.moves,
                "{post} {}: what is shown is the path of the job",
                def.key
            );
            assert_eq!(dry.program.writes, [""; 0], "{post} {}", def.key);
            assert!(
                dry.results.iter().all(|row| row.value.is_none()),
                "{post} {}",
                def.key
            );
            let program = &dry.program.text;
            assert!(
                !program.contains("G38.2") && !program.contains("M79") && !program.contains("G10 "),
                "{program}"
            );
            let first = program.lines().find(|line| line.contains("DRY RUN"));
            assert!(first.is_some_and(|line| line.contains("40")), "{program}");
            if let Some(proof) = dry.program.proof.as_ref() {
                assert_eq!(
                    (proof.moves, proof.touches),
                    (normal.moves.len(), 0),
                    "{post} {}",
                    def.key
                );
            }
            let back = import(program).unwrap();
            assert_eq!(
                planned(&back.job).program.text,
                *program,
                "{post} {}: the header says the job",
                def.key
            );
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen}");
}

/// Every job that can be measured can be run dry.
#[test]
fn every_job_of_moves_has_a_dry_run() {
    law(300, 30, (whole_job(), 0.0..200.0f64), |(job, lift)| {
        let Ok(normal) = plan(&job) else {
            return Ok(false);
        };
        if normal.program.proof.is_none() {
            return Ok(false);
        }
        let dry = plan(&dry(&job, lift))
            .map_err(|refused| TestCaseError::fail(format!("{:#?}", refused.findings)))?;
        prop_assert_eq!(&dry.moves, &normal.moves);
        prop_assert!(dry.program.writes.is_empty() && !dry.program.text.contains("G38.2"));
        prop_assert_eq!(dry.program.proof.map(|proof| proof.touches), Some(0));
        Ok(true)
    });
}

/// LinuxCNC's interpreter ends each probing move at its target: the program ends, each touch at its nominal contact, 40 mm higher.
#[test]
fn linuxcnc_runs_it_without_a_part() {
    for cycle in [
        "hole",
        "internal-rectangle-protected",
        "double-wall-internal-corner",
        "probing-two-circles",
    ] {
        let given = dry(&writing(cycle, "linuxcnc"), 40.0);
        let plan = planned(&given);
        let ran = interpret(&plan.program.text).unwrap();
        assert_eq!(
            (ran.offsets_after_moves.len(), ran.prints.len()),
            (0, 0),
            "{cycle}"
        );
        for touch in plan.moves.iter().filter(|step| step.kind == "touch") {
            let [x, y, z] = touch.to;
            let made = ran.moves.iter().find(|made| {
                [x, y, z + 40.0]
                    .iter()
                    .zip(made.to)
                    .all(|(wanted, made)| (wanted - made).abs() < 6e-5)
            });
            assert_eq!(
                made.map(|made| made.kind),
                Some("probe"),
                "{cycle} {touch:?}"
            );
        }
        // A contact, inserted at each check.
        for (at, _) in plan.program.text.match_indices("if [#5070 NE 0]") {
            let met = format!(
                "{}if [1 EQ 1]{}",
                &plan.program.text[..at],
                &plan.program.text[at + "if [#5070 NE 0]".len()..]
            );
            let (ran, why) = interpret_until_stop(&met);
            assert!(
                why.is_some_and(|why| why.contains("Dry run: something is in the way of move")),
                "{cycle}"
            );
            assert_eq!((ran.written, ran.prints.len()), (None, 0), "{cycle}");
        }
    }
}

#[test]
fn the_other_controls_run_it_without_a_part_and_stop_at_a_contact() {
    let pocket = |post: &str| planned(&dry(&writing("internal-rectangle-protected", post), 0.0));
    let plan = pocket("sinumerik");
    let program = read(&plan.program.text).unwrap();
    for contact in
        std::iter::once(None).chain((1..=plan.moves.len()).map(|number| Some(number as f64)))
    {
        let mut machine = Machine::new(Vec::new());
        machine.contact_in = contact;
        machine.run(&program).unwrap();
        assert_eq!(
            (machine.alarm.is_some(), machine.writes),
            (contact.is_some(), 0),
            "{contact:?}"
        );
        assert!(contact.is_none_or(|number| machine.message
            == format!("Dry run: something is in the way of move {number}")));
    }
    for post in skipping() {
        let plan = pocket(post);
        for contact in
            std::iter::once(None).chain((1..=plan.moves.len()).map(|number| Some(number as f64)))
        {
            let mut control = Control::new(post == "haas", false);
            control.at = [0.0, 0.0, 200.0];
            control.blocked = contact;
            control
                .run(&plan.program.text)
                .unwrap_or_else(|e| panic!("{post} {e}\n{}", plan.program.text));
            assert_eq!(
                (control.alarm.is_some(), control.writes.len()),
                (contact.is_some(), 0),
                "{post} {contact:?}"
            );
        }
    }
}

/// A set-up whose cycles follow results: nothing is measured, so every position is nominal.
#[test]
fn a_set_up_runs_dry_at_its_nominal_places() {
    for post in of_moves() {
        let given = with(
            &job(super::set_ups::turns::TURNED),
            "control.post",
            text(post),
        );
        let Ok(normal) = plan(&given) else { continue };
        let dry = planned(&dry(&given, 0.0));
        assert_eq!(lines_of_moves(&dry).len(), normal.moves.len(), "{post}");
        assert!(
            dry.program.writes.is_empty() && dry.datum.len() == normal.datum.len(),
            "{post}"
        );
        assert!(
            !dry.program.text.contains("SIN[") && !dry.program.text.contains("SIN("),
            "{}",
            dry.program.text
        );
    }
}

#[test]
fn a_cycle_of_the_controls_own_has_no_dry_run() {
    for post in POSTS
        .iter()
        .filter(|post| (post.supports)(hole().probes, ProgramForm::Cycle).is_ok())
    {
        let given = with(
            &with(
                &default_job(hole().key).unwrap(),
                "control.post",
                text(post.key),
            ),
            "control.form",
            text("cycle"),
        );
        let found = check(&dry(&given, 0.0));
        assert!(
            found
                .iter()
                .any(|f| f.code == "dry-run-unsupported" && f.path == "control.run"),
            "{}: {found:?}",
            post.key
        );
    }
    let unused = check(&with(
        &default_job("hole").unwrap(),
        "control.lift",
        number(10.0),
    ));
    assert!(unused.iter().any(|f| f.code == "lift-unused"), "{unused:?}");
}
