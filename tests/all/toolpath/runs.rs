//! Programs that are run with inputs. More of them are in `tests/programs`.

use super::*;
use crate::common::with;
use proptest::prelude::*;
use touchpath::form::Value;
use touchpath::import::toolpath::{
    DIALECTS, Feature, RUN_RULES, RunInputs, TriggerAt, run_program,
};

fn met(at: f64) -> RunInputs<'static> {
    RunInputs {
        touch: TriggerAt::At(at),
        positioning: TriggerAt::Never,
        ..RunInputs::default()
    }
}

/// Start position of a job.
fn start(job: &Value) -> Option<[f64; 3]> {
    let job = touchpath::job::resolved(job)?;
    let Some(Value::List(place)) = job.get("cycle")?.get("start") else {
        return None;
    };
    let axis = |i: usize| match place.get(i) {
        Some(Value::Number(x)) => *x,
        _ => f64::NAN,
    };
    Some([axis(0), axis(1), axis(2)])
}

/// Every generated program runs to its end if there are contacts only in touches: each move of the plan once, in its line, at its position.
#[test]
fn every_program_that_is_made_here_runs_as_its_plan() {
    let mut seen = 0;
    for (name, job) in jobs() {
        let plan = planned(&job);
        if plan.program.post == "heidenhain" || plan.program.proof.is_none() {
            continue;
        }
        let run = run_program(
            &plan.program.text,
            &RunInputs {
                start: start(&job),
                ..met(0.9)
            },
        );
        // The approach to the first position is a subroutine's, in its own lines.
        let called = |line: i32| {
            plan.program
                .text
                .lines()
                .nth(line as usize)
                .is_some_and(|text| text.contains("call"))
        };
        let mut next = 0;
        for (step, line) in plan
            .moves
            .iter()
            .zip(&plan.program.move_lines)
            .filter(|(_, line)| !called(**line))
        {
            let what = || {
                format!(
                    "{name} for {}, line {}: {step:?}\n{:?}",
                    plan.program.post,
                    line + 1,
                    run.findings
                )
            };
            let own = (next..run.len())
                .find(|i| run.line[*i] as i32 == *line)
                .unwrap_or_else(|| panic!("{}", what()));
            let end = places(&run)[own];
            let touch = step.kind == "touch";
            assert!(!touch || kinds(&run)[own] == "probe", "{}", what());
            // A touch continues past its contact.
            let off = (0..3)
                .map(|axis| (end[axis] - step.to[axis]).powi(2))
                .sum::<f64>()
                .sqrt();
            assert!(
                if touch {
                    off > 0.0 && off < 100.0
                } else {
                    off < 1e-4 || step.arc.is_some()
                },
                "{end:?} {}",
                what()
            );
            next = own + 1;
            seen += 1;
        }
    }
    assert!(seen > 1000, "{seen}");
}

/// Rules of a run of generated programs: nothing is broken except rules that the control cannot guarantee.
#[test]
fn the_rules_of_a_run_agree_with_those_of_the_proof() {
    let mut asked = 0;
    // Each for its own control, and for a Fanuc, whose programs store positions in variables.
    let of_fanuc = jobs().into_iter().map(|(name, job)| {
        (
            name,
            with(
                &with(&job, "control.post", Value::Text("fanuc".to_owned())),
                "control.form",
                Value::Text("moves".to_owned()),
            ),
        )
    });
    for (name, job) in jobs().into_iter().chain(of_fanuc) {
        let Ok(plan) = touchpath::job::plan(&job) else {
            continue;
        };
        if plan.program.proof.is_none() || plan.touches.is_empty() {
            continue;
        }
        // With contacts, and as a text without inputs.
        let runs =
            [met(0.9), RunInputs::default()].map(|known| run_program(&plan.program.text, &known));
        assert!(
            runs.iter().all(|run| run.rules.len() == RUN_RULES.len()),
            "{name}"
        );
        for rule in runs.iter().flat_map(|run| &run.rules) {
            let proven = plan
                .safety
                .iter()
                .find(|row| row.rule == rule.rule)
                .map(|row| row.holds);
            let what = || {
                format!(
                    "{name} for {}: {rule:?}\n{}",
                    plan.program.post, plan.program.text
                )
            };
            // Without a limit for any result, its program checks none.
            let unlimited = rule.rule == "plausible-before-write"
                && !plan.program.text.to_ascii_lowercase().contains("more than");
            if unlimited {
                continue;
            }
            // A rule that the proof confirms may be unknown to the run, but never broken; a rule that the proof refutes never holds in the run.
            match proven {
                Some(Some(true)) => assert_ne!(rule.holds, Some(false), "{}", what()),
                Some(Some(false)) => assert_ne!(rule.holds, Some(true), "{}", what()),
                Some(None) | None => {}
            }
            asked += usize::from(rule.holds.is_some());
        }
    }
    assert!(asked > 600, "{asked}");
}

/// A Fanuc may store the end of a move before the check: the last check before the next motion counts.
#[test]
fn a_place_that_was_kept_is_asked_by_its_name() {
    let program = |ask: &str| {
        format!(
            "%\nO1\nG21 G17 G90\nM5\nG31 Z30. F2000.\n#148=#5043-30.\n{ask}G31 Z0. F50.\nIF [ABS[#5063] LE 0.05] GOTO 9\nG1 Z30. F900.\nM30\nN9 #3000=1(MISSED)\n%\n"
        )
    };
    let broken = |ask: &str| -> Vec<&'static str> {
        let run = run_program(&program(ask), &RunInputs::default());
        run.rules
            .iter()
            .filter(|rule| rule.holds == Some(false))
            .map(|rule| rule.rule)
            .collect()
    };
    assert_eq!(
        broken("IF [ABS[#148] LE 0.05] GOTO 1\nIF [ABS[#148-#100] GT 0.05] GOTO 9\nN1\n"),
        [""; 0]
    );
    assert_eq!(broken("IF [ABS[#148] GT 0.05] GOTO 9\n"), [""; 0]);
    // A check of another variable proves nothing about the move.
    assert_eq!(
        broken("IF [ABS[#1480] GT 0.05] GOTO 9\n"),
        ["missed-touch-stops"]
    );
    assert_eq!(broken(""), ["missed-touch-stops"]);
}

/// Ends of moves, to a ten-thousandth, and their lines from 1.
fn shown(run: &Toolpath) -> Vec<String> {
    let axis = |x: f64| {
        if x.is_nan() {
            "?".to_owned()
        } else {
            format!("{}", (x * 1e4).round() / 1e4 + 0.0)
        }
    };
    let row = |i: usize| {
        format!(
            "{} {} {}",
            run.line[i] + 1,
            kinds(run)[i],
            places(run)[i].map(axis).join(" ")
        )
    };
    (0..run.len()).map(row).collect()
}

/// Each rule is broken by a foreign program, at its lines.
#[test]
fn a_rule_names_the_lines_that_break_it() {
    let broken = |text: &str| {
        let run = run_program(
            text,
            &RunInputs {
                start: Some([0.0, 0.0, 20.0]),
                ..met(0.5)
            },
        );
        let rows = run.rules.iter().filter(|row| row.holds == Some(false));
        rows.map(|row| {
            format!(
                "{} {:?}",
                row.rule,
                row.lines.iter().map(|line| line + 1).collect::<Vec<_>>()
            )
        })
        .collect::<Vec<_>>()
    };
    let good = "G21 G17 G90\nM5\nG38.3 X5 Y5 F900\no1 if [#5070 NE 0]\n(ABORT, contact)\no1 endif\nG38.2 Z-5 F60\n#<z> = #5063\nG1 Z20 F600\no2 if [#<z> GT 100]\n(ABORT, far)\no2 endif\nG10 L20 P1 Z0\nM2\n";
    assert_eq!(broken(good), Vec::<String>::new());
    // A touch that begins in contact is an error.
    let chain = good.replace("o1 if [#5070 NE 0]\n(ABORT, contact)\no1 endif\n", "");
    assert_eq!(broken(&chain), Vec::<String>::new());
    assert_eq!(
        broken(&good.replace("M5\n", "M5\nG4 P0.5\nG4 X1\ng04 s1\n")),
        Vec::<String>::new()
    );
    for (from, to, rule) in [
        ("G17 G90", "G90", "modes-stated [3]"),
        ("M5\n", "M3 S500\n", "spindle-off [2]"),
        ("G38.3 X5 Y5 F900", "G0 X5 Y5", "positioning-watched [3]"),
        ("G38.2 Z-5 F60", "G38.3 Z-5 F60", "missed-touch-stops [7]"),
        // Nothing reads its end, and nothing checks it: a positioning move whose contact goes unnoticed.
        (
            "G38.3 X5 Y5 F900\no1 if [#5070 NE 0]\n(ABORT, contact)\no1 endif\n",
            "G38.3 X5 Y5 F900\nG1 X6 F900\n",
            "positioning-watched [3, 4]",
        ),
        (
            "#<z> = #5063\nG1 Z20 F600\n",
            "G0 X9\nG38.2 Z-6 F60\n",
            "no-low-rapid [8]",
        ),
        (
            "G38.2 Z-5 F60\n",
            "G10 L20 P1 Z0\nG38.2 Z-5 F60\n",
            "offset-after-touches [7]",
        ),
        (
            "G10 L20 P1 Z0\nM2\n",
            "#9=0\no5 while [#9 LT 2]\nG10 L20 P1 Z0\n#9=[#9+1]\no5 endwhile\nM2\n",
            "one-write [15]",
        ),
        (
            "o2 if [#<z> GT 100]\n(ABORT, far)\no2 endif\n",
            "",
            "plausible-before-write [10]",
        ),
        ("M5\n", "M5\nG4\n", "waits-stated [3]"),
        ("M2\n", "G91\nM2\n", "modes-left []"),
    ] {
        let rows = broken(&good.replacen(from, to, 1));
        assert!(
            rows.iter().any(|row| row == rule),
            "{from} → {to}: {rows:?}"
        );
    }
    let feedless = good.replace(" F900", "").replace(" F60\n", "\n");
    assert!(broken(&feedless).contains(&"feeds-stated [7]".to_owned()));
    // A mode that was stated before holds.
    assert_eq!(
        broken(&good.replace("G38.2 Z-5 F60", "G38.2 Z-5")),
        Vec::<String>::new()
    );
    assert!(
        run_program("G21 G90\nG0 X1\nM2\n", &RunInputs::default())
            .rules
            .is_empty()
    );
}

/// Invalid inputs are reported together, and nothing runs.
#[test]
fn what_is_known_is_checked() {
    let json = r##"{ "dialect": "apt", "set": { "#5": "x", "5": 1, "R1": 2 }, "start": [1, 2], "part": { "at": 2, "positioning": null }, "files": { "a": 5 }, "more": 1 }"##;
    let value =
        touchpath::form::Value::from(&serde_json::from_str::<serde_json::Value>(json).unwrap());
    let error = RunInputs::of(&value).unwrap_err();
    let found: Vec<(&str, &str)> = error
        .findings
        .iter()
        .map(|finding| (finding.code.as_str(), finding.path.as_str()))
        .collect();
    assert_eq!(
        found,
        [
            ("unknown-value", "dialect"),
            ("wrong-type", "files.a"),
            ("unknown-key", "more"),
            ("out-of-range", "part.at"),
            ("not-a-number", "set.#5"),
            ("unknown-value", "set.5"),
            ("wrong-type", "start"),
        ]
    );
    // A part of several cycles was taken for no part.
    let several = r#"{ "part": { "cycles": [{ "type": "hole" }] } }"#;
    let value =
        touchpath::form::Value::from(&serde_json::from_str::<serde_json::Value>(several).unwrap());
    let error = RunInputs::of(&value).unwrap_err();
    assert_eq!(error.findings[0].path, "part.cycles");
}

/// A change of the coordinate system under the stylus changes its coordinates to new numbers, or makes them unknown.
#[test]
fn a_position_is_one_of_the_active_system() {
    let last = |text: &str| {
        let known = RunInputs {
            start: Some([0.0; 3]),
            ..met(0.5)
        };
        shown(&run_program(text, &known)).pop().unwrap()
    };
    for (shift, after) in [
        ("G10 L20 P1 X0", "0"),
        ("G10 L20 P2 X0", "5"),
        ("G10 L2 P1 X4", "?"),
        ("G10 L2 P2 X4", "5"),
        ("G92 X1", "1"),
        ("G92 X1\nG92.1", "?"),
        ("G92.1\nG92 X1\nG92.1", "?"),
        ("G55", "?"),
        ("G10 L20 P2 X7\nG55", "7"),
        ("G68 X5 Y0 R90", "5"),
        ("G68 X0 Y0 R180", "-5"),
    ] {
        let text = format!("G21 G54 G90\nG0 X5\n{shift}\nG0 Z#<_x>\n");
        let ended = last(&text);
        assert!(ended.ends_with(&format!(" {after}")), "{shift}: {ended}");
        let text = format!("G21 G54 G90\nG0 X5\n{shift}\nG0 X7\nG0 Z#<_x>\n");
        assert!(last(&text).ends_with(" 7"), "{shift}");
    }
    // Before the first move the start is a position in the system that is active then.
    for header in ["G55", "G92.1", "G49", "G43 H1", "G10 L2 P1 Z5", "G52 X0"] {
        assert_eq!(
            last(&format!("G21 G90\n{header}\nG91 G0 Z4\n")),
            "3 rapid 0 0 4",
            "{header}"
        );
    }
}

/// Random programs that move the coordinate system: every position equals the interpreter's, with all offsets 0 before.
#[test]
fn positions_in_moved_systems_are_those_of_the_interpreter() {
    let mut state = 0x0BAD_5EEDu64;
    let mut random = |count: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % count
    };
    let mut moves = 0;
    for _ in 0..60 {
        let turns = random(2) == 0;
        let mut text = "G21 G17 G90 G94 F100\nG0 X1 Y2 Z3\n".to_owned();
        for _ in 0..40 {
            let x = random(161) as f64 / 8.0 - 10.0;
            let axis = ["X", "Y", "Z"][random(3) as usize];
            let number = 1 + random(3);
            let line = match random(16) {
                0 => format!("G10 L2 P{number} {axis}{x}"),
                1 => format!("G10 L20 P{number} {axis}{x}"),
                2 => format!("G10 L20 P0 X{x} Y{}", x / 2.0),
                3 if turns => format!("G10 L2 P{number} R{}", 15 * random(24)),
                4 => format!("G{}", 54 + random(3)),
                5 => format!("G92 {axis}{x}"),
                6 => format!("G92.{}", 1 + random(3)),
                7 => format!("G52 {axis}{x}"),
                8 => format!("G43.1 Z{x}"),
                9 => "G49".to_owned(),
                10 => format!("G53 G0 {axis}{x}"),
                11 => format!("G91 G0 {axis}{x}\nG90"),
                _ => format!("G0 {axis}{x}"),
            };
            text.push_str(&line);
            text.push('\n');
        }
        text.push_str("G0 X0 Y0 Z0\nM2\n");
        let ran = interpret(&text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        let known = RunInputs {
            start: Some([0.0; 3]),
            post: Some("linuxcnc"),
            zero: true,
            ..RunInputs::default()
        };
        let run = run_program(&text, &known);
        assert_eq!(run.len(), ran.moves.len(), "{text}");
        for (i, wanted) in ran.moves.iter().enumerate() {
            let own = places(&run)[i];
            // Some effects of a rotation on shifts and writes are not followed.
            let near = (0..3).all(|axis| {
                (own[axis] - wanted.to[axis]).abs() < 1e-3 || own[axis].is_nan() && turns
            });
            let known = own.iter().filter(|x| !x.is_nan()).count();
            assert!(
                near,
                "line {}: {own:?}, truly {:?}\n{text}",
                run.line[i] + 1,
                wanted.to
            );
            moves += known;
        }
    }
    assert!(moves > 3000, "{moves}");
}

/// A generated program, run on the displaced part of its job: each touch triggers where the plan predicts, and no positioning move does.
#[test]
fn a_program_run_on_the_part_of_its_job_triggers_as_its_plan() {
    let mut seen = 0;
    for (name, job) in jobs() {
        for (offset, turn) in [([0.0, 0.0, 0.0], 0.0), ([0.3, -0.2, 0.1], 0.2)] {
            let part = touchpath::job::from_json(&format!(
                r#"{{ "offset": [{}, {}, {}], "rotation": {turn} }}"#,
                offset[0], offset[1], offset[2]
            ))
            .unwrap();
            let job = with(&job, "part", part);
            let (Some(planned), Ok(plan)) =
                (touchpath::job::planned(&job), touchpath::job::plan(&job))
            else {
                continue;
            };
            if plan.program.proof.is_none()
                || plan.moves.is_empty()
                || planned.run.triggers.iter().any(Option::is_none)
            {
                continue;
            }
            let known = RunInputs {
                feature: Feature::of(&job),
                start: Some(plan.moves[0].to),
                ..RunInputs::default()
            };
            let run = run_program(&plan.program.text, &known);
            let scale = planned.job.scale;
            let touches: Vec<[f64; 3]> = run
                .contacts
                .iter()
                .map(|contact| [contact[1], contact[2], contact[3]])
                .collect();
            // An alarm for an implausible result comes after the last touch.
            assert_eq!(
                touches.len(),
                planned.run.triggers.len(),
                "{name} {offset:?}: {:?}",
                run.findings
            );
            // A move that is free in the plan is free here.
            if plan
                .findings
                .iter()
                .all(|f| f.code != "collision" && f.code != "passes-close")
            {
                let collision = run.findings.iter().find(|f| f.code == "collision");
                assert!(collision.is_none(), "{name} {offset:?}: {collision:?}");
            }
            for (own, trigger) in touches.iter().zip(&planned.run.triggers) {
                let trigger = trigger.expect("checked").to_array();
                let off = (0..3)
                    .map(|axis| (own[axis] * scale - trigger[axis]).abs())
                    .fold(0.0, f64::max);
                assert!(off < 2e-3, "{name} {offset:?}: {own:?} {trigger:?}");
                seen += 1;
            }
        }
    }
    assert!(seen > 200, "{seen}");
}

/// Lines of every dialect, valid and broken.
const LINES: [&str; 74] = [
    "G21 G90",
    "G91",
    "G0 X1 Y2 Z3",
    "G38.2 Z-5 F50",
    "G38.3 X#1",
    "#1=5",
    "#1=[#1+1]",
    "#<a>=#5061",
    "G1 X#<a> F#2",
    "o1 sub",
    "o1 endsub",
    "o1 call [1] [2]",
    "o1 if [#5070 EQ 0]",
    "o1 else",
    "o1 elseif [#1 GT 2]",
    "o1 endif",
    "o2 while [#1 LT 9]",
    "o2 endwhile",
    "o2 do",
    "o2 repeat [3]",
    "o2 endrepeat",
    "o2 break",
    "o2 continue",
    "o1 return",
    "(ABORT, x)",
    "M2",
    "M30",
    "M99",
    "%",
    "O100",
    "O200 (SUB)",
    "G65 P100 A1. B2.",
    "G65 P9814 D25.",
    "M98 P200 L3",
    "IF [#1 EQ 5] GOTO 10",
    "N10 G31 X5. F9.",
    "GOTO 10",
    "WHILE [#1 LT 4] DO1",
    "END1",
    "#3000=1 (STOP)",
    "#[#1]=#[#2]",
    "IF R1==2 GOTOF A",
    "A: G1 X=R1",
    "GOTOB A",
    "R1=R1+1",
    "R[R1]=$AA_IW[X]",
    "DEF REAL B[3]=2",
    "FOR R1=1 TO 3",
    "ENDFOR",
    "WHILE TRUE",
    "ENDWHILE",
    "LOOP",
    "ENDLOOP",
    "REPEAT",
    "UNTIL R1>3",
    "IF R1",
    "ELSE",
    "ENDIF",
    "PROC P(REAL A)",
    "P(1,R1)",
    "RET",
    "MEAS=1 G1 X=IC(5)",
    "CYCLE977(1,,2)",
    "BEGIN PGM A MM",
    "END PGM A MM",
    "L IX+1 FMAX",
    "L X+Q1 F100",
    "CC",
    "C X+1 Y+1 DR+",
    "LBL 1",
    "CALL LBL 1 REP 9",
    "FN 9: IF +Q1 EQU +0 GOTO LBL 1",
    "Q1 = +Q1 + 1",
    "TCH PROBE 412 X ~",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 30, ..ProptestConfig::default() })]

    /// A run ends for any text, with the same result each time, and every move is in an existing line.
    #[test]
    fn any_text_comes_back(
        picks in proptest::collection::vec(0..LINES.len(), 1..40),
        dialect in 0..4_usize,
        trip in 0..3_usize,
        file in proptest::bool::ANY,
    ) {
        let lines: Vec<&str> = picks.iter().map(|pick| LINES[*pick]).collect();
        let text = lines.join("\n");
        let trip = [TriggerAt::Unknown, TriggerAt::At(0.5), TriggerAt::Never][trip];
        let known = RunInputs {
            dialect: (dialect < 3).then(|| DIALECTS[dialect]),
            touch: trip,
            set: vec![("#1", 2.0), ("R1", 1.0), ("Q1", 1.0)],
            files: if file { vec![("b", "o1 sub\nG38.3 X9 F9\no1 endsub\n")] } else { Vec::new() },
            ..RunInputs::default()
        };
        let run = run_program(&text, &known);
        prop_assert!(run.to.len() == 3 * run.len() && run.feed.len() == run.len() && run.line.len() == run.len());
        prop_assert_eq!(run.findings.len(), run.finding_lines.len());
        for (i, line) in run.line.iter().enumerate() {
            let most = if run.file.get(i).is_some_and(|file| *file > 0) { 3 } else { lines.len() };
            prop_assert!((*line as usize) < most, "{} of {}", line, text);
        }
        prop_assert!(run.contacts.iter().all(|contact| contact[0] < run.len() as f64));
        prop_assert!(run.finding_lines.iter().flatten().all(|line| (*line as usize) < lines.len()));
        prop_assert_eq!(format!("{run:?}"), format!("{:?}", run_program(&text, &known)));
    }
}
