//! Reasons that end a program before it does harm: contacts in positioning, a probe that is not free, a control in a wrong state.

use super::{axes, machine, moves_form, parsed, plans};
use crate::common::mpf::read;
use crate::common::sinumerik::Machine;
use crate::common::{job, planned, with};
use touchpath::form::Value;

/// For any move that a contact stops: the message has its number, the program writes nothing, and the ball moves only up, not after a contact in an upward
/// move, and never down from above.
#[test]
fn a_contact_ends_the_program_and_names_the_move() {
    let low = job(
        r#"{ "format": 1, "cycle": { "type": "probing-two-circles", "geometryType": 1, "start": [0, 0, 0], "clearanceHeight": 50 },
        "control": { "post": "sinumerik", "form": "moves", "workOffset": 1 } }"#,
    );
    let low = ("low start".to_owned(), low.clone(), planned(&low));
    let (mut lifted, mut stayed) = (0, 0);
    for (name, job, plan) in plans()
        .into_iter()
        .filter(|(name, ..)| name.contains("sinumerik") || name == "corner")
        .chain([low])
    {
        let program = parsed(&plan);
        let w = axes(&job)[2];
        let highest = plan
            .moves
            .iter()
            .map(|m| m.to[w])
            .fold(f64::NEG_INFINITY, f64::max);
        for (index, step) in plan
            .moves
            .iter()
            .enumerate()
            .filter(|(_, m)| m.kind == "position")
        {
            if !moves_form(&plan) && plan.program.move_lines[index] < 0 {
                continue;
            }
            let mut machine = machine(&job, &plan);
            // Down from far above: the first move may have a contact up there.
            machine.start = plan.moves[0].to;
            machine.start[w] = highest + 100.0;
            machine.contact_in = Some((index + 1) as f64);
            machine
                .run(&program)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            assert!(
                machine
                    .message
                    .starts_with(&format!("Contact in move {},", index + 1)),
                "{name}: {}",
                machine.message
            );
            let by_cycle = !moves_form(&plan) && index > 2;
            assert_eq!(
                machine.message.contains("Nothing is written"),
                moves_form(&plan),
                "{name}: {}",
                machine.message
            );
            assert_eq!(
                (machine.alarm, machine.writes),
                (Some(65000.0), usize::from(by_cycle)),
                "{name} {step:?}"
            );
            // An arc consists of several moves: the last position is where it stopped, or where it retracted to.
            let planned_up = index > 0 && step.to[w] > plan.moves[index - 1].to[w] + 1e-6;
            let last = machine.path[machine.path.len() - 1];
            let before = if machine.path.len() > 1 {
                machine.path[machine.path.len() - 2]
            } else {
                machine.start
            };
            if index == 0 || planned_up {
                assert!(
                    machine.path.len() <= index.max(1) + 200
                        && (index > 0 || machine.path.len() == 1),
                    "{name} {index}: it stays"
                );
                stayed += 1;
            } else if last[w] == highest && before[w] < highest {
                assert!(
                    (0..3).all(|i| i == w || last[i] == before[i]),
                    "{name} {index}: along the tool axis only"
                );
                lifted += 1;
            }
            assert!(
                index == 0
                    || last[w] >= before[w] - 1e-9
                    || step.to[w] < plan.moves[index - 1].to[w],
                "{name} {index}: not down"
            );
        }
        for k in 0..plan.touches.len() {
            if !moves_form(&plan) {
                continue;
            }
            let mut machine = machine(&job, &plan);
            machine.triggers[k] = None;
            machine.run(&program).unwrap();
            let index = plan
                .moves
                .iter()
                .position(|m| m.kind == "touch" && m.touch == Some(k))
                .unwrap();
            assert!(
                machine
                    .message
                    .starts_with(&format!("No contact in move {},", index + 1)),
                "{name}: {}",
                machine.message
            );
            assert_eq!(
                (machine.alarm, machine.writes),
                (Some(65000.0), 0),
                "{name}"
            );
            assert_eq!(
                machine.path[machine.path.len() - 1][w],
                highest,
                "{name}: it lifts"
            );
        }
    }
    assert!(lifted > 40 && stayed > 20, "{lifted} {stayed}");
    // By hand: the pocket's third upward move is blocked immediately, and nothing more moves; its move across retracts to Z30.
    let (_, job, plan) = plans()
        .into_iter()
        .find(|(name, ..)| name == "pocket-sinumerik")
        .unwrap();
    let ends = |number: f64| {
        let mut machine = machine(&job, &plan);
        machine.contact_in = Some(number);
        machine.run(&parsed(&plan)).unwrap();
        machine.path.len()
    };
    // The approach consists of three moves.
    assert_eq!((ends(7.0), ends(8.0)), (9, 11));
}

/// On the simulated control MEAS reacts only to the edge of the signal. A probe that stays deflected from some touch on ends the program before the next
/// probing move: nothing is measured with it, nothing is written, and the ball moves only up.
#[test]
fn a_probe_that_does_not_come_free_ends_the_program_before_the_next_probing_move() {
    let (mut ended, mut touches_refused) = (0, 0);
    for (name, job, _) in plans().into_iter().filter(|(.., plan)| moves_form(plan)) {
        for protection in ["checked", "none"] {
            let job = with(
                &job,
                "control.protection",
                Value::Text(protection.to_owned()),
            );
            let Ok(plan) = touchpath::job::plan(&job) else {
                continue;
            };
            // Positions of a real part: a program that continues would find its next wall.
            if plan.triggers.contains(&None) {
                continue;
            }
            let program = read(&plan.program.text).unwrap();
            let w = axes(&job)[2];
            let highest = plan
                .moves
                .iter()
                .map(|m| m.to[w])
                .fold(f64::NEG_INFINITY, f64::max);
            for k in 0..plan.touches.len() {
                let touch = plan
                    .moves
                    .iter()
                    .position(|m| m.kind == "touch" && m.touch == Some(k))
                    .unwrap();
                // The next move that needs the probe: a positioning move only if it is watched.
                let probes =
                    |kind: &str| kind == "touch" || kind == "position" && protection == "checked";
                let Some(next) =
                    (touch + 1..plan.moves.len()).find(|i| probes(plan.moves[*i].kind))
                else {
                    continue;
                };
                let mut machine = machine(&job, &plan);
                machine.start = plan.moves[0].to;
                machine.start[w] = highest;
                machine.stuck_from = Some(k + 1);
                machine
                    .run(&program)
                    .unwrap_or_else(|e| panic!("{name} {protection} {k}: {e}"));
                let wanted = format!("The probe is deflected before move {}.", next + 1);
                assert!(
                    machine.message.starts_with(&wanted),
                    "{name} {protection} {k}: {}",
                    machine.message
                );
                assert_eq!(
                    (machine.alarm, machine.writes),
                    (Some(65000.0), 0),
                    "{name} {protection} {k}"
                );
                let last = machine.path[machine.path.len() - 1];
                let stood = plan.moves[next - 1].to;
                assert!(
                    (0..3).all(|i| i == w || (last[i] - stood[i]).abs() < 1e-3),
                    "{name} {protection} {k}: {last:?} {stood:?}"
                );
                assert!(
                    (last[w] - highest).abs() < 1e-3,
                    "{name} {protection} {k}: it lifts"
                );
                ended += 1;
                touches_refused += usize::from(plan.moves[next].kind == "touch");
            }
        }
    }
    assert!(
        ended > 300 && touches_refused > 150,
        "{ended} {touches_refused}"
    );
}

#[test]
fn nothing_moves_where_the_control_is_not_as_it_must_be() {
    let (_, job, plan) = plans()
        .into_iter()
        .find(|(name, ..)| name == "pocket-sinumerik")
        .unwrap();
    let program = parsed(&plan);
    type Spoil = fn(&mut Machine);
    let cases: [(&str, Spoil); 9] = [
        ("The basic system", |m| m.metric = !m.metric),
        ("The probe is deflected", |m| m.deflected = true),
        ("The work offset is turned", |m| m.frame[1][0] = 3.0),
        ("The work offset is turned", |m| m.frame[1][1] = 3.0),
        ("The work offset is turned", |m| m.frame[2][2] = 1.0),
        ("The work offset is turned", |m| m.frame[3][0] = 2.0),
        // Left active by TOROT and CYCLE800.
        ("The work offset is turned", |m| m.behind[1][1][1] = 30.0),
        ("The work offset is turned", |m| m.behind[2][1][0] = 30.0),
        ("The work offset is turned", |m| m.behind[2][0][2] = 5.0),
    ];
    for (message, spoil) in cases {
        let mut machine = machine(&job, &plan);
        spoil(&mut machine);
        machine.run(&program).unwrap();
        assert!(
            machine.message.starts_with(message),
            "{message}: {}",
            machine.message
        );
        assert_eq!(
            (machine.alarm, machine.writes, machine.path.len()),
            (Some(65000.0), 0, 0),
            "{message}"
        );
    }
}

/// The native cycle corrects the coarse part of the offset: any other shift of the offset's zero would be in the result.
#[test]
fn the_cycle_is_not_called_where_the_offset_has_a_fine_part() {
    let (_, job, plan) = plans()
        .into_iter()
        .find(|(name, ..)| name == "pocket-sinumerik-cycle")
        .unwrap();
    let program = parsed(&plan);
    for (axis, refused) in [(0, true), (1, true), (2, false)] {
        let mut machine = machine(&job, &plan);
        machine.frame[4][axis] = -0.01;
        machine.run(&program).unwrap();
        assert_eq!(
            machine.alarm.is_some(),
            refused,
            "axis {axis}: {}",
            machine.message
        );
        assert_eq!(
            (machine.path.is_empty(), machine.writes),
            (refused, usize::from(!refused)),
            "axis {axis}"
        );
        assert_eq!(
            machine
                .message
                .starts_with("The work offset has a fine part"),
            refused,
            "axis {axis}: {}",
            machine.message
        );
    }
}

/// A program that only measures keeps a programmed shift, and refuses a rotation, a mirror and a scale before it moves.
#[test]
fn a_programmed_turn_mirror_or_scale_is_refused_where_nothing_is_written() {
    let job =
        job(r#"{ "format": 1, "cycle": { "type": "hole" }, "control": { "post": "sinumerik" } }"#);
    let plan = planned(&job);
    let program = parsed(&plan);
    assert!(
        !plan.program.text.contains("TRANS"),
        "a shift is the user's"
    );
    type Spoil = fn(&mut Machine);
    let cases: [(bool, Spoil); 4] = [
        (false, |m| m.behind[0][0][0] = 5.0),
        (true, |m| m.behind[0][1][2] = 10.0),
        (true, |m| m.behind[0][2][0] = 1.0),
        (true, |m| m.behind[0][3][1] = 2.0),
    ];
    for (refused, spoil) in cases {
        let mut machine = machine(&job, &plan);
        spoil(&mut machine);
        machine.run(&program).unwrap();
        assert_eq!(
            machine.message.starts_with("A programmed turn"),
            refused,
            "{}",
            machine.message
        );
        assert_eq!(machine.path.is_empty(), refused);
    }
}

/// Every broken program is found: by the syntax, by the structure, or by the path.
#[test]
fn a_broken_program_is_caught() {
    let (_, _, plan) = plans()
        .into_iter()
        .find(|(name, ..)| name == "pocket-sinumerik")
        .unwrap();
    let text = &plan.program.text;
    let judge = |broken: &str| -> Result<(), String> {
        assert_ne!(broken, text);
        let program = read(broken).map_err(|t| format!("{t:?}"))?;
        let troubles = program.troubles();
        if !troubles.is_empty() {
            return Err(format!("{troubles:?}"));
        }
        crate::common::compare_mpf(&plan, |_| 5.0, &program)
    };
    crate::common::compare_mpf(&plan, |_| 5.0, &parsed(&plan)).unwrap();
    let broken = [
        text.replacen("IF $AC_MEA[1]<>0 GOTOF TP_CONTACT\n", "", 1),
        text.replacen("STOPRE\n", "", 1),
        text.replacen("MEAS=1 G1 X100", "G1 X100", 1),
        text.replacen("MEAS=1 G1 X100", "MEAS=1 G1 X-100", 1),
        text.replacen("MEAS=1 G1 Z10 F2000", "MEAS=1 G0 Z10", 1),
        text.replacen("MEAS=1 G1 Z10 F2000", "G0 Z10", 1),
        text.replacen("TP_CONTACT:\n", "", 1),
        text.replacen("TP_EXIT:\n", "TP_EXIT:\nTP_EXIT:\n", 1),
        text.replacen("GOTOF TP_BLOCKED", "GOTOF TP_BLOCK", 1),
        text.replacen("(R13+R5)/2", "(R13+R5/2", 1),
        text.replacen("G90 ", "", 1),
        text.replacen("G71\n", "", 1),
        text.replacen(
            "MEAS=1 G1 X139.4671 Y64.3648 Z-10 F150",
            "MEAS=1 G1 X139.4671 Y64.3648 Z-10.01 F150",
            1,
        ),
        text.replacen("R1=", "1=", 1),
        text.replacen("$P_UIFR[2,X,TR]=$P", "$P_UIFR[2,X,TR]=$P_", 1)
            .replace("TR]+R21", "TR]+*R21"),
        text.replacen("F2000", "F0", 1),
        text.replacen("F2000", "", 1),
    ];
    for (i, program) in broken.iter().enumerate() {
        assert!(judge(program).is_err(), "{i} is not caught:\n{program}");
    }
}

/// With D0 the length of the probe does not count: the program stops before anything moves. Of the two probe inputs it reads the one of the job.
#[test]
fn the_tool_offset_and_the_probe_input_are_asked() {
    for input in [1, 2] {
        for (name, job, _) in plans()
            .into_iter()
            .filter(|(.., plan)| !plan.touches.is_empty())
        {
            let job = with(&job, "control.probeInput", Value::Number(f64::from(input)));
            let plan =
                touchpath::job::plan(&job).unwrap_or_else(|e| panic!("{name}: {:?}", e.findings));
            let program = read(&plan.program.text).unwrap();
            let mut machine = machine(&job, &plan);
            machine.input = input;
            machine.tool_offset = 0;
            machine.run(&program).unwrap();
            assert!(
                machine.message.starts_with("No tool offset is active"),
                "{name}: {}",
                machine.message
            );
            assert_eq!(
                (machine.path.len(), machine.writes, machine.alarm),
                (0, 0, Some(65000.0)),
                "{name}"
            );
            if !moves_form(&plan) || plan.triggers.contains(&None) {
                continue;
            }
            for (connected, ends) in [(input, None), (3 - input, Some("No contact"))] {
                let mut machine = super::machine(&job, &plan);
                machine.input = connected;
                machine.run(&program).unwrap();
                assert_eq!(
                    machine.alarm.is_some(),
                    ends.is_some(),
                    "{name}: {}",
                    machine.message
                );
                assert!(
                    machine.message.starts_with(ends.unwrap_or_default()),
                    "{name}: {}",
                    machine.message
                );
            }
            let other = plan.program.text.replacen(
                &format!("$AC_MEA[{input}]"),
                &format!("$AC_MEA[{}]", 3 - input),
                1,
            );
            let found = touchpath::import::import(&other)
                .map_or_else(|e| e.findings, |imported| imported.findings().to_vec());
            assert!(
                found.iter().any(|f| f.code == "program-differs"),
                "{name}: {found:?}"
            );
        }
    }
}

/// On a lathe X may be a diameter in G18.
#[test]
fn g18_states_radii() {
    for (name, job, plan) in plans() {
        let lathe = job.get("plane") == Some(&Value::Text("G18".to_owned()));
        assert_eq!(
            plan.program.text.lines().any(|line| line == "DIAMOF"),
            lathe,
            "{name}"
        );
    }
}

/// A cycle that only measures ends at the centre that it found: from there the ball moves straight up first.
#[test]
fn from_a_cycle_that_only_measures_the_way_out_is_straight_up() {
    let mut counted = 0;
    for (name, job) in crate::common::unlimited_jobs() {
        let given =
            |key: &str, value: &str| (format!("control.{key}"), Value::Text(value.to_owned()));
        let changes = [
            given("post", "sinumerik"),
            given("form", "cycle"),
            ("control.workOffset".to_owned(), Value::Null),
        ];
        let job = changes
            .iter()
            .fold(job, |job, (path, value)| with(&job, path, value.clone()));
        let Ok(plan) = touchpath::job::plan(&job) else {
            continue;
        };
        let lines: Vec<&str> = plan.program.text.lines().collect();
        let call = lines.iter().rposition(|line| line.starts_with("CYCLE97"));
        let Some(call) = call.filter(|call| lines[*call].starts_with("CYCLE977")) else {
            continue;
        };
        let tool = axes(&job)[2];
        let [.., before, last] = plan.moves.as_slice() else {
            continue;
        };
        if last.to[tool] <= before.to[tool] {
            continue;
        }
        let axis = ["X", "Y", "Z"][tool];
        let first = lines[call..]
            .iter()
            .find_map(|line| line.strip_prefix("MEAS=1 G1 "))
            .unwrap();
        assert!(
            first.starts_with(axis) && first.split(' ').count() == 2,
            "{name}: {first}"
        );
        counted += 1;
    }
    assert!(counted > 3);
}

/// Of several cycles the last one corrects, and those before it only measure: the ball leaves each of them straight up.
#[test]
fn of_several_cycles_those_that_only_measure_are_left_straight_up() {
    let set_up = job(
        r#"{ "format": 2, "control": { "post": "sinumerik", "form": "cycle", "workOffset": 1 }, "cycles": [
             { "name": "LEFT", "type": "hole", "diameter": 20, "origin": [-60, 0, 0] },
             { "name": "RIGHT", "type": "hole", "diameter": 20, "origin": [60, 0, 0] } ] }"#,
    );
    let text = planned(&set_up).program.text;
    let ways: Vec<Option<&str>> = text
        .split("CYCLE977(")
        .skip(1)
        .map(|behind| {
            behind
                .lines()
                .find_map(|line| line.strip_prefix("MEAS=1 G1 "))
        })
        .collect();
    let [Some(left), Some(right)] = ways[..] else {
        panic!("{text}")
    };
    assert!(
        left.starts_with('Z') && left.split(' ').count() == 2,
        "{left}"
    );
    assert!(right.starts_with('X'), "{right}");
}
