//! Behaviour of a program during its moves: spindle, unexpected contacts, the first move.

use super::*;
/// M72 would restart a spindle that was turning at M70, with the stylus in it.
#[test]
fn the_spindle_stays_off() {
    for (name, _, plan) in linuxcnc_jobs() {
        let text = &plan.program.text;
        let canon = crate::common::canonical(&format!("T1 M6\nS500 M3 M8\n{text}"));
        let last = |words: &[&str]| {
            canon
                .iter()
                .rposition(|line| words.iter().any(|w| line.contains(w)))
        };
        let on = last(&["START_SPINDLE_CLOCKWISE", "FLOOD_ON"]);
        let off = last(&["STOP_SPINDLE_TURNING", "FLOOD_OFF"]);
        assert!(
            on.is_some() && on < off,
            "{name}: the spindle or the coolant is started after they were stopped"
        );
        let before = text.lines().position(|l| l == "M5 M9").unwrap();
        assert!(
            before < text.lines().position(|l| l == "M70").unwrap(),
            "{name}"
        );
        assert!(
            !canon[on.unwrap() + 1..]
                .iter()
                .any(|l| l.contains("START_SPINDLE")),
            "{name}"
        );
    }
}

/// A contact is inserted in each watched move: the program stops with its number, retracts only where the path up is free, and writes nothing.
#[test]
fn a_contact_in_any_positioning_move_leads_to_the_exit() {
    let (_, _, plan) = linuxcnc_jobs()
        .into_iter()
        .find(|(name, ..)| name == "pocket")
        .expect("the pocket");
    let lines: Vec<&str> = plan.program.text.lines().collect();
    let mut exits = 0;
    for (index, step) in plan
        .moves
        .iter()
        .enumerate()
        .filter(|(_, m)| m.kind == "position")
        .skip(1)
    {
        let line = plan.program.move_lines[index] as usize;
        assert!(
            lines[line].starts_with("G38.3 ") && lines[line + 1].ends_with("if [#5070 NE 0]"),
            "{}",
            lines[line]
        );
        let mut broken: Vec<String> = lines.iter().map(|l| (*l).to_owned()).collect();
        broken[line + 1] = broken[line + 1].replace("[#5070 NE 0]", "[1 EQ 1]");
        let (ran, why) = interpret_until_stop(&(broken.join("\n") + "\n"));
        let why = why.unwrap_or_else(|| panic!("move {} does not stop", index + 1));
        assert!(
            why.contains(&format!("Contact in move {}.000000", index + 1)),
            "{why}"
        );
        let up = index > 0 && step.to[2] > plan.moves[index - 1].to[2];
        let last = ran.moves.last().unwrap();
        if up {
            assert_eq!(
                (last.kind, last.to),
                ("probe", step.to),
                "nothing moves after a contact on the way up"
            );
        } else {
            assert_eq!(
                (last.kind, last.to[2]),
                ("feed", 30.0),
                "it lifts to the height of the path"
            );
        }
        assert_eq!(
            (ran.written, ran.prints.len()),
            (None, 0),
            "nothing is written"
        );
        exits += 1;
    }
    assert_eq!(exits, 18);
    // A probe that is triggered before the start stops the first block.
    let tripped = plan
        .program
        .text
        .replacen("o3 if [#5070 NE 0]", "o3 if [1 EQ 1]", 1);
    let (ran, why) = interpret_until_stop(&tripped);
    assert!(why.unwrap().contains("Contact in move 1.000000"));
    assert_eq!(ran.moves.len(), 1, "{:?}", ran.moves);
}

/// Approach to the first position: up if the stylus is lower, then in the plane, then down.
#[test]
fn the_first_place_is_reached_up_across_and_down() {
    for protection in ["checked", "none"] {
        for (name, job, _) in linuxcnc_jobs()
            .into_iter()
            .filter(|(_, job, _)| plane_axes(job) == [0, 1])
        {
            let plan = planned(&with(
                &job,
                "control.protection",
                Value::Text(protection.to_owned()),
            ));
            let Some(first) = plan.moves.first() else {
                continue;
            };
            let unit = if plan.program.text.contains("\nG20\n") {
                "G20"
            } else {
                "G21"
            };
            for (start, wanted) in [(-50.0, 3), (500.0, 2)] {
                let before = format!("{unit} G90\nG0 X-7 Y9 Z{start}\n{}", plan.program.text);
                let ran = interpret(&before).unwrap_or_else(|e| panic!("{name}: {e}"));
                let places: Vec<[f64; 3]> = ran
                    .moves
                    .iter()
                    .skip(1)
                    .take(wanted)
                    .map(|m| m.to)
                    .collect();
                let near = |a: f64, b: f64| (a - b).abs() < 0.26;
                let highest = first.to[2].max(start);
                if wanted == 3 {
                    assert!(
                        near(places[0][0], -7.0)
                            && near(places[0][1], 9.0)
                            && near(places[0][2], first.to[2]),
                        "{name} {places:?}"
                    );
                }
                let across = places[wanted - 2];
                assert!(
                    near(across[0], first.to[0])
                        && near(across[1], first.to[1])
                        && near(across[2], highest),
                    "{name} {places:?}"
                );
                assert!(
                    (0..3).all(|i| (places[wanted - 1][i] - first.to[i]).abs() < 1e-3),
                    "{name} {places:?}"
                );
            }
        }
    }
}

/// The operator states the start position of a job: a stylus that is lower moves up before it moves across.
#[test]
fn a_stylus_below_the_stated_start_goes_up_first() {
    let circles = with(
        &default_job("probing-two-circles").unwrap(),
        "control.post",
        Value::Text("linuxcnc".to_owned()),
    );
    let circles = with(&circles, "control.form", Value::Text("moves".to_owned()));
    for (protection, kind) in [("checked", "probe"), ("none", "rapid")] {
        let plan = planned(&with(
            &circles,
            "control.protection",
            Value::Text(protection.to_owned()),
        ));
        for (z, first) in [
            (5.0, Some([60.0, 20.0, 100.0])),
            (100.0, None),
            (150.0, None),
        ] {
            let ran =
                interpret(&format!("G21 G90\nG0 X60 Y20 Z{z}\n{}", plan.program.text)).unwrap();
            let wanted: Vec<[f64; 3]> = first
                .into_iter()
                .chain([[-30.0, 0.0, f64::max(z, 100.0)]])
                .collect();
            for (ran, wanted) in ran.moves.iter().skip(1).zip(&wanted) {
                // A probe move of this interpreter ends 0.254 mm before its target.
                let near = (0..3).all(|axis| (ran.to[axis] - wanted[axis]).abs() < 0.26);
                assert!(
                    ran.kind == kind && near,
                    "{protection} {z}: {ran:?} {wanted:?}"
                );
            }
        }
    }
}

/// Under G7 an X word is a diameter: the program states G8.
#[test]
fn a_lathes_diameters_are_switched_off() {
    let (_, job, plan) = linuxcnc_jobs()
        .into_iter()
        .find(|(name, ..)| name == "boss-picked")
        .expect("a boss");
    let ran = interpret(&format!("G7\n{}", plan.program.text)).unwrap();
    compare_moves(&plan, |_| overtravel(&job), &ran).unwrap();
}

/// A touch that is too short for a probe move is refused, and short positioning moves are plain.
#[test]
fn short_probe_moves_are_not_left_to_the_interpreter() {
    let short = crate::common::job(
        r#"{ "format": 1, "overtravel": 0.05, "cycle": { "type": "boss", "sideClearance": 3.05 } }"#,
    );
    let found = touchpath::job::check(&short);
    assert!(
        found.iter().any(|f| f.code == "probe-move-too-short"),
        "{found:?}"
    );
    let near = crate::common::job(
        r#"{ "format": 1, "cycle": { "type": "web", "sideClearance": 3.05, "width": 30, "depth": 0.02, "topClearance": 3.1 } }"#,
    );
    let plan = planned(&with(&near, "cycle.feedDistance", Value::Number(0.1)));
    let ran = interpret(&plan.program.text).unwrap();
    compare_moves(&plan, |_| 5.0, &ran).unwrap();
    assert!(
        plan.program
            .text
            .lines()
            .any(|l| l.starts_with("G1 ") && l.contains("Z3.1 ")),
        "{}",
        plan.program.text
    );
}
