//! Programs that are run with what is known beside their text.

use super::*;
use crate::common::with;
use proptest::prelude::*;
use touchpath::form::Value;
use touchpath::import::toolpath::{DIALECTS, Feature, Known, RUN_RULES, Trip, run_program};

fn met(at: f64) -> Known<'static> {
    Known { touch: Trip::At(at), positioning: Trip::Never, ..Known::default() }
}

/// Where a job says that the stylus stands.
fn start(job: &Value) -> Option<[f64; 3]> {
    let job = touchpath::job::resolved(job)?;
    let Some(Value::List(place)) = job.get("cycle")?.get("start") else { return None };
    let axis = |i: usize| match place.get(i) {
        Some(Value::Number(x)) => *x,
        _ => f64::NAN,
    };
    Some([axis(0), axis(1), axis(2)])
}

/// Every program that is made here runs to its end where touches are made and nothing else is met: each move of the plan once, in its line, where the plan has it.
#[test]
fn every_program_that_is_made_here_runs_as_its_plan() {
    let mut seen = 0;
    for (name, job) in jobs() {
        let plan = planned(&job);
        if plan.program.post == "heidenhain" || plan.program.proof.is_none() {
            continue;
        }
        let run = run_program(&plan.program.text, &Known { start: start(&job), ..met(0.9) });
        // The way to the first place is a subroutine's, in its own lines.
        let called = |line: i32| plan.program.text.lines().nth(line as usize).is_some_and(|text| text.contains("call"));
        let mut next = 0;
        for (step, line) in plan.moves.iter().zip(&plan.program.move_lines).filter(|(_, line)| !called(**line)) {
            let what = || format!("{name} for {}, line {}: {step:?}\n{:?}", plan.program.post, line + 1, run.findings);
            let own = (next..run.len()).find(|i| run.line[*i] as i32 == *line).unwrap_or_else(|| panic!("{}", what()));
            let end = places(&run)[own];
            let touch = step.kind == "touch";
            assert!(!touch || kinds(&run)[own] == "probe", "{}", what());
            // A touch runs on behind its contact.
            let off = (0..3).map(|axis| (end[axis] - step.to[axis]).powi(2)).sum::<f64>().sqrt();
            assert!(if touch { off > 0.0 && off < 100.0 } else { off < 1e-4 || step.arc.is_some() }, "{end:?} {}", what());
            next = own + 1;
            seen += 1;
        }
    }
    assert!(seen > 1000, "{seen}");
}

/// What the rules of a run say of the programs that are made here: nothing is broken but what the control cannot do.
#[test]
fn the_rules_of_a_run_agree_with_those_of_the_proof() {
    let mut asked = 0;
    // Each for its own control, and for a Fanuc, whose programs keep places in variables.
    let of_fanuc = jobs().into_iter().map(|(name, job)| {
        (
            name,
            with(&with(&job, "control.post", Value::Text("fanuc".to_owned())), "control.form", Value::Text("moves".to_owned())),
        )
    });
    for (name, job) in jobs().into_iter().chain(of_fanuc) {
        let Ok(plan) = touchpath::job::plan(&job) else { continue };
        if plan.program.proof.is_none() || plan.touches.is_empty() {
            continue;
        }
        // With contacts, and as a text of which nothing is known.
        let runs = [met(0.9), Known::default()].map(|known| run_program(&plan.program.text, &known));
        assert!(runs.iter().all(|run| run.rules.len() == RUN_RULES.len()), "{name}");
        for rule in runs.iter().flat_map(|run| &run.rules) {
            let proven = plan.safety.iter().find(|row| row.rule == rule.rule).map(|row| row.holds);
            let what = || format!("{name} for {}: {rule:?}\n{}", plan.program.post, plan.program.text);
            // Where a job limits no result its program asks for none.
            let unlimited =
                rule.rule == "plausible-before-write" && !plan.program.text.to_ascii_lowercase().contains("more than");
            if unlimited {
                continue;
            }
            // What the proof holds the run may not know, and never denies; what the proof denies the run does not hold.
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

/// A Fanuc may keep where a move ended before it asks: what it asks last before the next motion counts.
#[test]
fn a_place_that_was_kept_is_asked_by_its_name() {
    let program = |ask: &str| {
        format!(
            "%\nO1\nG21 G17 G90\nM5\nG31 Z30. F2000.\n#148=#5043-30.\n{ask}G31 Z0. F50.\nIF [ABS[#5063] LE 0.05] GOTO 9\nG1 Z30. F900.\nM30\nN9 #3000=1(MISSED)\n%\n"
        )
    };
    let broken = |ask: &str| -> Vec<&'static str> {
        let run = run_program(&program(ask), &Known::default());
        run.rules.iter().filter(|rule| rule.holds == Some(false)).map(|rule| rule.rule).collect()
    };
    assert_eq!(broken("IF [ABS[#148] LE 0.05] GOTO 1\nIF [ABS[#148-#100] GT 0.05] GOTO 9\nN1\n"), [""; 0]);
    assert_eq!(broken("IF [ABS[#148] GT 0.05] GOTO 9\n"), [""; 0]);
    // What it asks of another variable says nothing of the move.
    assert_eq!(broken("IF [ABS[#1480] GT 0.05] GOTO 9\n"), ["missed-touch-stops"]);
    assert_eq!(broken(""), ["missed-touch-stops"]);
}

/// Where moves end, to a ten-thousandth, and their lines from 1.
fn shown(run: &Toolpath) -> Vec<String> {
    let axis = |x: f64| if x.is_nan() { "?".to_owned() } else { format!("{}", (x * 1e4).round() / 1e4 + 0.0) };
    let row = |i: usize| format!("{} {} {}", run.line[i] + 1, kinds(run)[i], places(run)[i].map(axis).join(" "));
    (0..run.len()).map(row).collect()
}

fn asks(run: &Toolpath) -> Vec<&str> {
    run.asks.iter().map(|ask| ask.name.as_str()).collect()
}

/// The way of a touch is from 10 to −10; met half way, it ends at 0. By hand.
const EDGE: &str = "G21 G90\nF50\nG38.3 X-10\n#<edge> = #5061\nG1 X[#<edge> + 3] F200\nG0 Y#5422\nM2\n";

#[test]
fn a_touch_ends_where_it_meets_something_and_the_next_move_begins_there() {
    let at = |trip: Trip| {
        let run = run_program(EDGE, &Known { touch: trip, start: Some([10.0, 4.0, -2.0]), ..Known::default() });
        assert_eq!(run.contacts.len(), usize::from(matches!(trip, Trip::At(_))));
        (shown(&run), run.contacts)
    };
    let (moves, contacts) = at(Trip::At(0.5));
    assert_eq!(moves, ["3 probe -10 4 -2", "5 feed 3 4 -2", "6 rapid 3 -2 -2"]);
    assert_eq!(contacts, [[0.0, 0.0, 4.0, -2.0]]);
    assert_eq!(at(Trip::Never).0, ["3 probe -10 4 -2", "5 feed -7 4 -2", "6 rapid -7 -2 -2"]);
    // Not told, it may have ended anywhere along its way.
    assert_eq!(at(Trip::Unknown).0, ["3 probe -10 4 -2", "5 feed ? 4 -2", "6 rapid ? -2 -2"]);
    let nowhere = run_program(EDGE, &Known { touch: Trip::At(0.5), ..Known::default() });
    assert_eq!(shown(&nowhere), ["3 probe -10 ? ?", "5 feed ? ? ?", "6 rapid ? ? ?"]);
}

/// LinuxCNC's interpreter itself, whose probing moves meet nothing: #5070 is 0 and #5061 the target.
#[test]
fn a_run_in_which_nothing_is_met_is_the_interpreters() {
    for text in [
        "G21 G90\no<side> sub\nG91\nG38.3 X[#1] F[#2]\nG90\no1 if [#5070 EQ 0]\n#<found> = [#5061 + 1]\no1 else\n#<found> = -99\no1 endif\nG0 X#<found> Z#5422\no<side> endsub [#<found>]\nG0 X0 Y0 Z5\no<side> call [2] [40]\nG1 Y#<_value> F90\no<side> call [-1.5] [40]\nG1 Y#<_value>\nM2\n",
        "G20 G90\nG0 X0.05 Y0 Z0.1\n#100 = #5420\nG38.3 Z0.05 F4\nG0 Z[#5063 + 1] X[#5420 * 2]\nG91\nG1 X#<_x> F10\nG90\nG0 Y[#<_metric> * 7]\nM2\n",
        "G21 G90 G17\nG0 X1 Y2 Z3\n#1 = 0\no1 while [#1 LT 3]\nG38.3 Y[2 - #1 * 0.5] F30\no2 if [#5070 EQ 1]\no1 break\no2 endif\nG0 Y[#5062 + #<_incremental>]\n#1 = [#1 + 1]\no1 endwhile\nG0 Z#5420\nM2\n",
    ] {
        let ran = interpret(text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        let run = run_program(
            text,
            &Known { touch: Trip::Never, positioning: Trip::Never, start: Some([0.0; 3]), ..Known::default() },
        );
        assert_eq!(run.len(), ran.moves.len(), "{text}\n{:?}\n{:?}", shown(&run), ran.moves);
        for (i, other) in ran.moves.iter().enumerate() {
            let own = places(&run)[i];
            let same = (0..3).all(|axis| (own[axis] - other.to[axis]).abs() < 1e-3) && kinds(&run)[i] == other.kind;
            assert!(same, "{text}\nmove {i}, line {}: {own:?}, truly {other:?}", run.line[i] + 1);
        }
    }
}

#[test]
fn what_is_read_before_anything_sets_it_is_asked_for() {
    let text = "G21 G90\no<m> sub\no1 if [#5400 NE #<tool>]\n(ABORT, wrong tool)\no1 endif\n#<r> = [#3014 / 2]\nG0 X#1\nG38.2 Z[0 - #2] F50\n#<r> = #5063\nG0 Z#<r>\no<m> endsub\n";
    let known =
        |set: Vec<(&'static str, f64)>| Known { set, start: Some([0.0, 0.0, 9.0]), touch: Trip::At(1.0), ..Known::default() };
    let run = run_program(text, &known(Vec::new()));
    assert_eq!(asks(&run), ["#1", "#2", "#3014", "#5400", "#<tool>"]);
    assert_eq!(run.asks[2].lines, [5]);
    assert!(run.findings.iter().any(|finding| finding.code == "branch-ends"), "{:?}", run.findings);
    // Given, it is asked no longer; what an argument list leaves out is 0.
    let run = run_program(text, &known(vec![("#1", 4.0), ("#3014", 6.0), ("#5400", 5.0), ("#<tool>", 5.0)]));
    assert_eq!(
        (asks(&run), shown(&run)),
        (Vec::new(), vec!["7 rapid 4 0 9".to_owned(), "8 probe 4 0 0".to_owned(), "10 rapid 4 0 0".to_owned()])
    );
    // Another tool is in the spindle: the program stops itself, which is said at its line.
    let run = run_program(text, &known(vec![("#5400", 4.0), ("#<tool>", 5.0)]));
    let stops = run.findings.iter().position(|finding| finding.code == "program-stops").expect("it stops");
    assert_eq!((run.len(), run.finding_lines[stops].as_slice()), (0, &[3][..]));
}

/// G65 into a program of another file, by hand: #26 is Z, #24 is X.
#[test]
fn subprograms_of_other_files_are_run_in_their_own_lines() {
    let text = "%\nO1\nG21 G90\nG0 X0. Y0. Z20.\nG65 P9701 X4. Z-2.\nG0 Y7.\nM30\n%\n";
    let file = "%\nO9701\nG31 Z#26 F100.\n#101=#5063\nIF [#101 LE [#26+0.05]] GOTO 9\nG1 X#24 F200.\nG0 Z20.\nM99\nN9\n#3000=1 (NOTHING MET)\n%\n";
    let known = |trip: Trip| Known { touch: trip, files: vec![("O9701.nc", file)], ..Known::default() };
    let run = run_program(text, &known(Trip::At(0.5)));
    assert_eq!(shown(&run), ["4 rapid 0 0 20", "3 probe 0 0 -2", "6 feed 4 0 9", "7 rapid 4 0 20", "6 rapid 4 7 20"]);
    assert_eq!(run.file, [0, 1, 1, 1, 0]);
    let run = run_program(text, &known(Trip::Never));
    assert_eq!(shown(&run), ["4 rapid 0 0 20", "3 probe 0 0 -2"]);
    let stops = run.findings.iter().find(|finding| finding.code == "program-stops").expect("it stops");
    assert!(stops.message.contains("line 10 (O9701.nc)"), "{}", stops.message);
}

#[test]
fn klartext_runs_by_hand() {
    let text = "0 BEGIN PGM K MM\n1 TOOL CALL 5 Z S1000\n2 L X+0 Y+0 Z+50 R0 FMAX M3\n3 CC X+0 Y+0\n4 L X+20 F500\n5 C X+0 Y+20 DR+\n6 CR X-20 Y+0 R+20 DR+\n7 LP PR+10 PA+90\n8 CP IPA-90 DR-\n9 Q1 = +5 * ( 2 + SQ 2 )\n10 FN 1: Q2 = +Q1 + +4\n11 L Z-Q2\n12 LBL 1\n13 L IX+1 F MAX\n14 CALL LBL 1 REP 3\n15 CALL LBL \"SUB\"\n16 FN 9: IF +Q2 EQU +34 GOTO LBL 9\n17 L X+999\n18 LBL 9\n19 L IZ+Q5\n20 M30\n21 LBL \"SUB\"\n22 L Y-1,5\n23 LBL 0\n24 END PGM K MM\n";
    let run = run_program(text, &Known { set: vec![("Q5", 4.0)], ..Known::default() });
    assert_eq!((run.dialect, run.metric), ("klartext", Some(true)));
    assert_eq!(
        shown(&run),
        [
            "3 rapid 0 0 50",
            "5 feed 20 0 50",
            "6 feed 0 20 50",
            "7 feed -20 0 50",
            "8 feed 0 10 50",
            "9 feed 10 0 50",
            "12 feed 10 0 -34",
            "14 rapid 11 0 -34",
            "14 rapid 12 0 -34",
            "14 rapid 13 0 -34",
            "14 rapid 14 0 -34",
            "23 feed 14 -1.5 -34",
            "20 feed 14 -1.5 -30",
        ]
    );
    // A quarter counter-clockwise about 0, another, and a quarter clockwise on the radius of 10.
    let arcs: Vec<[f64; 4]> = run.arcs.iter().map(|arc| [arc[0], arc[1].round(), arc[2].round(), arc[4].round()]).collect();
    assert_eq!(arcs, [[2.0, 0.0, 0.0, 90.0], [3.0, 0.0, 0.0, 90.0], [5.0, 0.0, 0.0, -90.0]]);
    assert_eq!(asks(&run_program(text, &Known::default())), ["Q5"]);
    // A jump that is not known: nothing that was computed is known from there on.
    let run = run_program(
        "BEGIN PGM A MM\nQ1 = 5\nFN 11: IF +Q9 GT +0 GOTO LBL 7\nL X+Q1 F100\nLBL 7\nL Y+2\nEND PGM A MM\n",
        &Known::default(),
    );
    assert_eq!(shown(&run), ["4 feed ? ? ?", "6 feed ? 2 ?"]);
    let run = run_program(
        "BEGIN PGM A INCH\nL X+1 Y+2 Z+3 FMAX\nTCH PROBE 412 DATUM INSIDE CIRCLE ~\n Q321=+1 ;CENTER ~\n Q262=+25\nL Z+3 FMAX\nL X+Q151\nEND PGM A INCH\n",
        &Known::default(),
    );
    assert_eq!(shown(&run), ["2 rapid 1 2 3", "6 rapid ? ? 3", "7 feed ? ? 3"]);
    let call = &run.calls[0];
    assert_eq!((call.name.as_str(), call.line, run.metric), ("TCH PROBE 412", 2, Some(false)));
    assert_eq!((call.arguments[1].value, call.arguments[1].meaning), (Some(25.0), Some("nominal diameter")));
}

#[test]
fn sinumerik_runs_by_hand() {
    let text = "DEF REAL HEIGHT=5, LIST[3]\nG71 G17 G90\nR1=3 R2=R1*2+1\nG0 X=R2 Y=0 Z=HEIGHT\nFOR R3=1 TO 3\nLIST[R3-1]=R3*10\nG1 Y=LIST[R3-1] F=R1*100\nENDFOR\nIF (R1>2) AND NOT (R1==4)\nG1 X=IC(-R1)\nELSE\nG1 X=99\nENDIF\nWHILE R1>0\nR1=R1-1\nIF R1==1 GOTOF NEXT\nG1 Z=R1\nNEXT:\nENDWHILE\nSIDE(2, R2)\nREPEAT\nR1=R1+1\nUNTIL R1>=2\nG1 Z=R1\nMEAS=1 G1 X=0 F50\nSTOPRE\nIF $AC_MEA[1]==0 GOTOF MISSED\nG1 X=$AA_MW[X]+1 Y=ABS(-3)\nM30\nMISSED:\nSETAL(65000)\nM30\nPROC SIDE(REAL A, INT B)\nG1 X=A Y=B\nRET\n";
    let known = |trip: Trip| Known { touch: trip, positioning: Trip::Never, ..Known::default() };
    let run = run_program(text, &known(Trip::At(0.5)));
    assert_eq!(
        shown(&run),
        [
            "4 rapid 7 0 5",
            "7 feed 7 10 5",
            "7 feed 7 20 5",
            "7 feed 7 30 5",
            "10 feed 4 30 5",
            "17 feed 4 30 2",
            "17 feed 4 30 0",
            "34 feed 2 7 0",
            "24 feed 2 7 2",
            "25 probe 0 7 2",
            "28 feed 2 3 2",
        ]
    );
    assert_eq!(run.feed[1], 300.0);
    // The alarm below the end is not reached.
    assert_eq!((said(&run), asks(&run)), (vec!["lines-skipped"], Vec::new()), "{:?}", run.findings);
    // Nothing met: an alarm; not told: the alarm's branch ends, the rest stands where the touch has ended.
    assert_eq!(shown(&run_program(text, &known(Trip::Never))).last().map(String::as_str), Some("25 probe 0 7 2"));
    assert_eq!(shown(&run_program(text, &known(Trip::Unknown))).last().map(String::as_str), Some("28 feed ? 3 2"));
    let run = run_program(
        "G71 G90\nG0 X0 Y0 Z5\nCYCLE977(101,,,1,25,,,2,0.5,0,10,,,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,1)\nG0 X=R7\n",
        &Known::default(),
    );
    assert_eq!(run.calls[0].arguments[2].meaning, Some("diameter or width"));
    assert_eq!((shown(&run).last().map(String::as_str), asks(&run)), (Some("4 rapid ? 0 5"), vec!["R7"]));
    // The cycle's own moves: from 2 in front of each contact to 2 behind it, by a ball of 6, X plus first, and back to the middle.
    assert_eq!(
        shown(&run)[1..7],
        ["3 rapid 7.5 0 5", "3 probe 11.5 0 5", "3 rapid 7.5 0 5", "3 rapid 0 0 5", "3 rapid -7.5 0 5", "3 probe -11.5 0 5"]
    );
    let contacts: Vec<String> = run.contacts.iter().map(|c| format!("{:.3} {:.3}", c[1] + 1e-9, c[2] + 1e-9)).collect();
    assert_eq!(contacts, ["9.500 0.000", "-9.500 0.000", "0.000 9.500", "0.000 -9.500"]);
}

/// A condition of a SINUMERIK that is not known: both branches are read, what they set is not known, an end behind it ends; a known one within it is decided.
#[test]
fn an_unknown_condition_of_a_sinumerik_is_left_at_its_end() {
    let text = "G71 G90\nR1=1 R2=5\nG0 X0 Y0 Z0\nIF R9==1\nR2=6\nIF R1==1\nG1 X1 F9\nELSE\nG1 X99\nENDIF\nELSE\nG1 X2\nENDIF\nG1 Y=R1 Z=R2\nM30\nG1 X77\n";
    let run = run_program(text, &Known::default());
    assert_eq!(shown(&run), ["3 rapid 0 0 0", "7 feed 1 0 0", "12 feed 2 0 0", "14 feed ? 1 ?"]);
    let run = run_program(text, &Known { set: vec![("R9", 0.0)], ..Known::default() });
    assert_eq!(shown(&run), ["3 rapid 0 0 0", "12 feed 2 0 0", "14 feed 2 1 5"]);
}

/// A jump that only skips some lines comes to the planned end, too: what it skips may not have run.
#[test]
fn a_jump_to_the_rest_of_a_program_is_no_way_out() {
    let text = "%\nO1\nG21 G90\nG0 X0. Y0. Z9.\n#100=1.\nIF [#500 EQ 1] GOTO 20\n#100=2.\nN20\nG31 Z0. F9.\nG0 X#100\nM30\n";
    let run = run_program(text, &met(0.5));
    assert_eq!(shown(&run), ["4 rapid 0 0 9", "9 probe 0 0 0", "10 rapid ? 0 4.5"]);
    let text = "G71 G90\nG0 X0 Y0 Z9\nR1=1\nIF R9==1 GOTOF REST\nR1=2\nREST:\nG1 X=R1 F9\nM30\n";
    assert_eq!(shown(&run_program(text, &Known::default())), ["2 rapid 0 0 9", "7 feed ? 0 9"]);
    // To an alarm it is one.
    let text = text.replace("M30\n", "M30\nFAIL:\nSETAL(65000)\nM30\n").replace("GOTOF REST", "GOTOF FAIL");
    assert_eq!(shown(&run_program(&text, &Known::default())), ["2 rapid 0 0 9", "7 feed 2 0 9"]);
}

/// The ISO of a HEIDENHAIN: D codes, formulas, labels, calls, repeats and jumps. By hand.
#[test]
fn heidenhain_iso_runs_by_hand() {
    let text = "%HOLES G71 *\nN10 G00 G40 G90 X+0 Y+0 Z+20 *\nN20 D00 Q1 P01 +12 *\nN30 D03 Q2 P01 +Q1 P02 +2,5 *\nN40 Q3 = Q2 - SQ 4 + Q1 / 3 *\n\
                N50 L1,0 *\nN60 G98 L5 *\nN70 G91 G01 X+Q3 F500 *\nN80 L5,2 *\nN90 D12 P01 +Q1 P02 +Q9 P03 7 *\nN100 G90 Y+50 *\nN110 G98 L7 *\n\
                N120 D11 P01 +Q1 P02 +5 P03 8 *\nN130 X+999 *\nN140 G98 L8 *\nN150 G90 Z-Q1 *\nN160 M30 *\n\
                N170 G98 L1 *\nN180 G01 Y+Q2 *\nN190 G98 L0 *\nN99999 %HOLES G71 *\n";
    let run = |set: Vec<(&str, f64)>| shown(&run_program(text, &Known { set: set.into_iter().collect(), ..Known::default() }));
    // Q2 = 30, Q3 = 30 − 16 + 4 = 18: the section runs three times.
    let begin = ["2 rapid 0 0 20", "19 feed 0 30 20", "8 feed 18 30 20", "8 feed 36 30 20", "8 feed 54 30 20"];
    let ends = |rows: &[&str]| begin.iter().chain(rows).map(|row| (*row).to_owned()).collect::<Vec<_>>();
    assert_eq!(run(vec![("Q9", 5.0)]), ends(&["11 feed 54 50 20", "16 feed 54 50 -12"]));
    assert_eq!(run(vec![("Q9", 50.0)]), ends(&["16 feed 54 30 -12"]));
    let unknown = run_program(text, &Known::default());
    assert_eq!(asks(&unknown), ["Q9"]);
    // Nothing is known of any parameter then: line 14 is read in its order, and Z is not known.
    assert_eq!(shown(&unknown)[5..], ["11 feed 54 50 20", "14 feed 999 ? 20", "16 feed ? ? ?"]);
}

/// Of one value ATAN gives the angle of a slope: above 0 all controls agree.
#[test]
fn the_angle_of_a_slope_is_computed() {
    let run = run_program("O1\nG21 G90\n#1=ATAN[3/4]\n#2=ATAN[1.]*2\nG1 X#1 Y#2 Z[ATAN[0-1]] F9.\nM30\n", &Known::default());
    assert_eq!(shown(&run), ["5 feed 36.8699 90 ?"]);
}

/// Both ways of a condition that is not known begin where they part, and where they meet a place is known only if both say the same. By hand.
#[test]
fn both_ways_of_an_unknown_condition_are_run_from_where_they_part() {
    let begin = |run: &Toolpath| run.resumes.iter().map(|[index, place @ ..]| (*index as usize, *place)).collect::<Vec<_>>();
    let same = |a: &[(usize, [f64; 3])], b: &[(usize, [f64; 3])]| format!("{a:?}") == format!("{b:?}");
    let unknown = f64::NAN;
    // A jump: X may still be 0.
    let run = run_program("G21 G90\nG0 X0 Y0 Z20\nIF [#100 GT 5] GOTO 10\nG0 X50 Y0\nN10 G0 Y5\nG0 X1\nM30\n", &met(0.5));
    assert_eq!(shown(&run), ["2 rapid 0 0 20", "4 rapid 50 0 20", "5 rapid ? 5 20", "6 rapid 1 5 20"]);
    assert!(same(&begin(&run), &[(2, [unknown, 0.0, 20.0])]), "{:?}", run.resumes);
    // Two branches: the second begins where the first did. Both end at Y 3.
    let text = "G21 G90\nG0 X0 Y0 Z20\no1 if [#100 GT 5]\nG0 X50 Y3\no1 else\nG0 Y3\no1 endif\nG0 Z5\nM2\n";
    let run = run_program(text, &met(0.5));
    assert_eq!(shown(&run), ["2 rapid 0 0 20", "4 rapid 50 3 20", "6 rapid 0 3 20", "8 rapid ? 3 5"]);
    assert!(same(&begin(&run), &[(2, [0.0, 0.0, 20.0]), (3, [unknown, 3.0, 20.0])]), "{:?}", run.resumes);
    // Of a loop: it may not have run at all.
    let run = run_program("G21 G90\nG0 X0 Y0 Z20\no1 while [#100 GT 5]\nG0 Y7\no1 endwhile\nG0 X1\nM2\n", &met(0.5));
    assert_eq!(shown(&run), ["2 rapid 0 0 20", "4 rapid 0 7 20", "6 rapid 1 ? 20"]);
    // One within the other, with three ways.
    let text = "G71 G90\nG0 X0 Y0 Z20\nIF R9>5\nG0 X1\nIF R8>5\nG0 Y1\nENDIF\nELSE\nG0 X1 Y0\nENDIF\nG0 Z5\nM30\n";
    assert_eq!(shown(&run_program(text, &Known::default())).last().unwrap(), "11 rapid 1 ? 5");
    let text = "BEGIN PGM T MM\nL X+0 Y+0 Z+20 R0 FMAX\nFN 9: IF +Q1 EQU +Q2 GOTO LBL 5\nL X+50 R0 FMAX\nLBL 5\nL Y+5 R0 FMAX\nEND PGM T MM\n";
    assert_eq!(shown(&run_program(text, &Known::default())), ["2 rapid 0 0 20", "4 rapid 50 0 20", "6 rapid ? 5 20"]);
}

/// Each rule is broken by a program of someone else's, at its lines.
#[test]
fn a_rule_names_the_lines_that_break_it() {
    let broken = |text: &str| {
        let run = run_program(text, &Known { start: Some([0.0, 0.0, 20.0]), ..met(0.5) });
        let rows = run.rules.iter().filter(|row| row.holds == Some(false));
        rows.map(|row| format!("{} {:?}", row.rule, row.lines.iter().map(|line| line + 1).collect::<Vec<_>>()))
            .collect::<Vec<_>>()
    };
    let good = "G21 G17 G90\nM5\nG38.3 X5 Y5 F900\no1 if [#5070 NE 0]\n(ABORT, contact)\no1 endif\nG38.2 Z-5 F60\n#<z> = #5063\nG1 Z20 F600\no2 if [#<z> GT 100]\n(ABORT, far)\no2 endif\nG10 L20 P1 Z0\nM2\n";
    assert_eq!(broken(good), Vec::<String>::new());
    assert_eq!(broken(&good.replace("M5\n", "M5\nG4 P0.5\nG4 X1\ng04 s1\n")), Vec::<String>::new());
    for (from, to, rule) in [
        ("G17 G90", "G90", "modes-stated [3]"),
        ("M5\n", "M3 S500\n", "spindle-off [2]"),
        ("G38.3 X5 Y5 F900", "G0 X5 Y5", "positioning-watched [3]"),
        ("G38.2 Z-5 F60", "G38.3 Z-5 F60", "missed-touch-stops [7]"),
        // Nothing reads where it ended, and nothing asks: a positioning move whose contact goes unnoticed.
        ("G38.3 X5 Y5 F900\no1 if [#5070 NE 0]\n(ABORT, contact)\no1 endif\n", "G38.3 X5 Y5 F900\n", "positioning-watched [3]"),
        ("G38.2 Z-5 F60", "G38.2 Z-5", "feeds-stated [7]"),
        ("#<z> = #5063\nG1 Z20 F600\n", "G0 X9\nG38.2 Z-6 F60\n", "no-low-rapid [8]"),
        ("G38.2 Z-5 F60\n", "G10 L20 P1 Z0\nG38.2 Z-5 F60\n", "offset-after-touches [7]"),
        ("G10 L20 P1 Z0\nM2\n", "#9=0\no5 while [#9 LT 2]\nG10 L20 P1 Z0\n#9=[#9+1]\no5 endwhile\nM2\n", "one-write [15]"),
        ("o2 if [#<z> GT 100]\n(ABORT, far)\no2 endif\n", "", "plausible-before-write [10]"),
        ("M5\n", "M5\nG4\n", "waits-stated [3]"),
        ("M2\n", "G91\nM2\n", "modes-left []"),
    ] {
        let rows = broken(&good.replacen(from, to, 1));
        assert!(rows.iter().any(|row| row == rule), "{from} → {to}: {rows:?}");
    }
    assert!(run_program("G21 G90\nG0 X1\nM2\n", &Known::default()).rules.is_empty());
}

/// The number of a macro may be computed: it is named without one, and where it ends is not known.
#[test]
fn a_macro_whose_number_is_computed_is_named() {
    for text in ["G21 G90\nG0 X0 Y0 Z5\nG65 P#100 D5.\nG1 X1 F9\n", "G21 G90\nG0 X0 Y0 Z5\nG65 P[#1+9800] X3.\nG1 X1 F9\n"] {
        let run = run_program(text, &Known::default());
        assert_eq!((run.calls[0].name.as_str(), run.calls[0].title), ("G65", None));
        assert_eq!(shown(&run).last().map(String::as_str), Some("4 feed 1 ? ?"));
    }
}

#[test]
fn a_native_call_says_what_contradicts_in_it() {
    let text = "%\nO1\nG21 G90 G0 X0. Y0. Z5.\nG65 P9812 X30. Y20. Q5.\nG65 P9814 Q3.\nG65 P9810 X1. Y2. Z-8. F800.\nG65 P8811 Z-10.\nG65 P9999 A1.\nM30\n%\n";
    let run = run_program(text, &Known::default());
    let calls: Vec<(&str, Option<&str>, String)> =
        run.calls.iter().map(|call| (call.name.as_str(), call.title, call.contradictions.join(", "))).collect();
    assert_eq!(
        calls,
        [
            ("G65 P9812", Some("web or slot"), "X and Y exclude each other".to_owned()),
            ("G65 P9814", Some("hole or boss, four touches"), "D is missing".to_owned()),
            ("G65 P9810", Some("protected positioning move"), String::new()),
            ("G65 P8811", Some("single surface"), String::new()),
            ("G65 P9999", None, String::new()),
        ]
    );
    assert_eq!(shown(&run)[1], "6 feed 1 2 -8");
}

/// A Centroid's macros have numbers of Renishaw's: P9813 is a slot, P9817 a hole, and a letter names the axis. Values that no control takes are said.
#[test]
fn a_centroid_is_told_from_a_renishaw() {
    let calls = |text: &str| {
        let run = run_program(text, &Known::default());
        run.calls
            .iter()
            .map(|call| format!("{}: {}", call.title.unwrap_or("?"), call.contradictions.join(", ")))
            .collect::<Vec<_>>()
    };
    let begin = "G21 G90 G0 X0. Y0. Z5.\n";
    assert_eq!(
        calls(&format!("{begin}G65 P9813 A1 X30. Q5.\nG65 P9817 D25. Q5.\nG65 P9811 A4 X3.\nM30\n")),
        ["slot, or with C1 a rectangular pocket: ", "hole, four touches: ", "single surface: A is 4: 1 to 3 is possible"]
    );
    assert_eq!(
        calls(&format!("{begin}G65 P9817 X30. Z5.\nG65 P9814 D-3. F2.\nM30\n")),
        [
            "fourth axis by two touches along X or Y: ",
            "hole or boss, four touches: D is -3: more than 0 is possible, F is 2: 0 to 1 is possible"
        ]
    );
}

/// A hole of 40 that lies 0.7 and −0.4 off, run on by P9814 from its nominal middle: where Renishaw's own macros, run the same way, touch it (the places are theirs).
#[test]
fn a_macro_of_renishaws_runs_on_a_part_as_the_macro_itself() {
    let job = r#"{ "format": 1, "stylus": { "diameter": 6 }, "cycle": { "type": "hole", "origin": [0, 0, 10], "diameter": 40, "depth": 20 }, "part": { "offset": [0.7, -0.4, 0] } }"#;
    let feature = Feature::of(&touchpath::job::from_json(job).unwrap());
    let text = "O1\nG21 G17 G90\nG0 X0. Y0. Z-5.\nG65 P9814 D40. Q5.\nG65 P9810 Z50. F900.\nM30\n";
    let run = run_program(text, &Known { feature, ..Known::default() });
    let contact = |i: usize| run.contacts.iter().find(|contact| contact[0] == i as f64).map(|contact| [contact[1], contact[2]]);
    let round = |x: f64| (x * 1e3).round() / 1e3 + 0.0;
    let touches: Vec<([f64; 2], [f64; 2])> = (0..run.len())
        .filter_map(|i| Some(([places(&run)[i][0], places(&run)[i][1]].map(round), contact(i)?.map(round))))
        .collect();
    assert_eq!(
        touches,
        [
            ([0.0, -25.0], [0.0, -17.386]),
            ([0.0, -25.0], [0.0, -17.386]),
            ([0.0, 25.0], [0.0, 16.586]),
            ([0.0, 25.0], [0.0, 16.586]),
            ([-25.0, -0.4], [-16.3, -0.4]),
            ([-25.0, -0.4], [-16.3, -0.4]),
            ([25.0, -0.4], [17.7, -0.4]),
            ([25.0, -0.4], [17.7, -0.4]),
        ]
    );
    assert_eq!(shown(&run)[2], "4 feed 0 -15.7856 -5", "1.6 back from the first contact");
    assert_eq!(shown(&run).last().unwrap(), "5 feed 0 0 50");
    // Without a part each touch ends where the call says the feature is; with none to meet the macro stops the program.
    let nominal = run_program(text, &Known::default());
    assert_eq!(nominal.contacts[0][1..], [0.0, -17.0, -5.0]);
    let nothing = run_program(text, &Known { touch: Trip::Never, ..Known::default() });
    assert!(nothing.findings.iter().any(|finding| finding.code == "macro-stops"), "{:?}", nothing.findings);
    assert_eq!(shown(&nothing).len(), 2);
}

/// A HEIDENHAIN's circle: 40 about (5, 6), 4 aside by a ball of 6. By hand: it begins at a radius of 13, its ball's centre makes contact at 17; between touches an
/// arc of 90 degrees; at the end the clearance height.
#[test]
fn heidenhains_cycles_make_their_moves() {
    let text = |cycle: &str| format!("BEGIN PGM T MM\nL X+0 Y+0 Z+50 R0 FMAX\n{cycle}\nL X+1 R0 FMAX\nEND PGM T MM\n");
    let circle =
        text("TCH PROBE 412 DATUM INSIDE CIRCLE Q321=+5 Q322=+6 Q262=40 Q325=+0 Q247=+90 Q261=-5 Q320=4 Q260=+20 Q301=0");
    let run = run_program(&circle, &Known::default());
    assert_eq!(
        shown(&run)[..8],
        [
            "2 rapid 0 0 50",
            "3 rapid 18 6 50",
            "3 rapid 18 6 -5",
            "3 probe 32 6 -5",
            "3 rapid 18 6 -5",
            "3 feed 5 19 -5",
            "3 probe 5 33 -5",
            "3 rapid 5 19 -5"
        ]
    );
    assert_eq!((run.arcs[0], run.arcs.len()), ([5.0, 5.0, 6.0, -5.0, 90.0, 17.0], 3));
    assert_eq!(run.contacts[0], [3.0, 22.0, 6.0, -5.0], "where the cycle says the hole is");
    assert_eq!(shown(&run)[14..], ["3 rapid 5 -7 20", "4 rapid 1 -7 20"]);
    // Q301 = 1 lifts between the touches, from outside; a part that lies 2 off.
    let stud = text("TCH PROBE 413 Q321=+0 Q322=+0 Q262=40 Q325=+90 Q247=+90 Q261=-5 Q320=4 Q260=+20 Q301=1");
    let job = r#"{ "format": 1, "stylus": { "diameter": 6 }, "cycle": { "type": "boss", "origin": [0, 0, 5], "diameter": 40, "depth": 20 }, "part": { "offset": [0, 2, 0] } }"#;
    let feature = Feature::of(&touchpath::job::from_json(job).unwrap());
    let run = run_program(&stud, &Known { feature, ..Known::default() });
    assert_eq!(run.contacts[0].map(|x| (x * 1e6).round() / 1e6), [3.0, 0.0, 25.0, -5.0]);
    assert_eq!(shown(&run)[4..8], ["3 rapid 0 27 -5", "3 rapid 0 27 20", "3 rapid -27 0 20", "3 rapid -27 0 -5"]);
    // A surface from above, a wall towards X minus; one that is not there stops the program.
    let top = run_program(&text("TCH PROBE 417 Q263=+7 Q264=-12 Q294=+2 Q320=4 Q260=+20"), &Known::default());
    assert_eq!(
        shown(&top)[1..],
        ["3 rapid 7 -12 50", "3 rapid 7 -12 9", "3 probe 7 -12 -5", "3 rapid 7 -12 9", "3 rapid 7 -12 20", "4 rapid 1 -12 20"]
    );
    let wall = text("TCH PROBE 427 Q263=+7 Q264=-12 Q261=-3 Q320=4 Q272=1 Q267=-1 Q260=+20");
    assert_eq!(run_program(&wall, &Known::default()).contacts[0], [3.0, 10.0, -12.0, -3.0]);
    let missed = run_program(&wall, &Known { touch: Trip::Never, ..Known::default() });
    assert!(missed.findings.iter().any(|finding| finding.code == "macro-stops") && shown(&missed).len() == 4);
    // What is not known makes no move.
    assert_eq!(shown(&run_program(&text("TCH PROBE 412 Q321=+5"), &Known::default())), ["2 rapid 0 0 50", "4 rapid 1 ? ?"]);
}

/// What is handed over wrongly is said, all at once, and nothing runs.
#[test]
fn what_is_known_is_checked() {
    let json = r##"{ "dialect": "apt", "set": { "#5": "x", "5": 1, "R1": 2 }, "start": [1, 2], "part": { "at": 2, "positioning": null }, "files": { "a": 5 }, "more": 1 }"##;
    let value = touchpath::form::Value::from(&serde_json::from_str::<serde_json::Value>(json).unwrap());
    let error = Known::of(&value).unwrap_err();
    let found: Vec<(&str, &str)> =
        error.findings.iter().map(|finding| (finding.code.as_str(), finding.path.as_str())).collect();
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
}

/// A work offset that is written moves the system under the stylus: what stood before is not known in the new one. G92.1 alone changes nothing.
#[test]
fn places_from_before_a_shift_are_not_known_after_it() {
    let run = |text: &str| shown(&run_program(text, &Known { start: Some([0.0; 3]), ..met(0.5) }));
    let last = |text: &str| run(text).pop().unwrap();
    assert_eq!(last("G21 G90\nG92.1\nG0 X5\nG0 Y#<_x>\n"), "4 rapid 5 5 0");
    for shift in ["G10 L20 P1 X0", "G10 L2 P1 X4", "G92 X1", "G55", "G68 X0 Y0 R30", "G52 X3"] {
        let text = format!("G21 G54 G90\nG0 X5\n{shift}\nG0 Y#<_x>\n");
        assert_eq!(last(&text), "4 rapid 5 ? 0", "{shift}");
        let text = format!("G21 G54 G90\nG0 X5\n{shift}\nG0 X7\nG0 Y#<_x>\n");
        assert_eq!(last(&text), "5 rapid 7 7 0", "{shift}");
        // A touch from a place of the old system meets something at no known place.
        let text = format!("G21 G54 G90\nG0 X5\n{shift}\nG38.3 X1 F9\nG0 Y#5061\n");
        let others = if shift.starts_with("G10") { "0" } else { "?" };
        assert_eq!(last(&text), format!("5 rapid ? ? {others}"), "{shift}");
    }
    assert_eq!(last("G71 G90\nG0 X5 Y0 Z0\nTRANS X3\nG0 Y=$AA_IW[X]\n"), "4 rapid 5 ? 0");
    // By a distance from nowhere is nowhere.
    assert_eq!(shown(&run_program("G21 G91\nG0 X5\nM2\n", &Known::default())), ["2 rapid ? ? ?"]);
}

/// What is called and not there has locals of its own: those here stay known.
#[test]
fn a_call_that_is_not_there_leaves_the_locals() {
    let last = |text: &str| shown(&run_program(text, &Known { start: Some([0.0; 3]), ..met(0.5) })).pop().unwrap();
    assert_eq!(last("G21 G90\n#1=4\n#<l>=2\n#100=3\no<gone> call [5]\nG0 X#1 Y#<l> Z#100\n"), "6 rapid 4 2 ?");
    assert_eq!(last("%\nO1\nG21 G90\n#1=4.\n#100=3.\nG65 P9999 A1.\nG0 X#1 Y0. Z#100\nG31 X0. F9.\nM30\n"), "8 probe 0 0 ?");
}

/// A program that is made here, run on the displaced part of its job: each touch triggers where the plan says that it does, and no positioning move does.
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
            let (Some(planned), Ok(plan)) = (touchpath::job::planned(&job), touchpath::job::plan(&job)) else { continue };
            if plan.program.proof.is_none() || plan.moves.is_empty() || planned.run.triggers.iter().any(Option::is_none) {
                continue;
            }
            let known = Known { feature: Feature::of(&job), start: Some(plan.moves[0].to), ..Known::default() };
            let run = run_program(&plan.program.text, &known);
            let scale = planned.job.scale;
            let touches: Vec<[f64; 3]> = run.contacts.iter().map(|contact| [contact[1], contact[2], contact[3]]).collect();
            // An alarm, where a result is implausible, comes after the last touch.
            assert_eq!(touches.len(), planned.run.triggers.len(), "{name} {offset:?}: {:?}", run.findings);
            for (own, trigger) in touches.iter().zip(&planned.run.triggers) {
                let trigger = trigger.expect("checked").to_array();
                let off = (0..3).map(|axis| (own[axis] * scale - trigger[axis]).abs()).fold(0.0, f64::max);
                assert!(off < 2e-3, "{name} {offset:?}: {own:?} {trigger:?}");
                seen += 1;
            }
        }
    }
    assert!(seen > 200, "{seen}");
}

/// A Haas says in the block itself what a contact is; rules and calls of another file stay there.
#[test]
fn an_alarm_of_the_block_itself_counts_and_lines_are_those_of_their_text() {
    let text = "%\nO1\nG21 G17 G90\nM5\nG31 X5. Y5. F500. M78\nG31 Z-5. F50. M79\nG1 Z20. F500.\nM30\n%\n";
    let run = run_program(text, &Known { start: Some([0.0, 0.0, 20.0]), ..met(0.5) });
    assert_eq!(shown(&run), ["5 probe 5 5 20", "6 probe 5 5 -5", "7 feed 5 5 20"]);
    assert!(run.rules.iter().all(|rule| rule.holds == Some(true)), "{:?}", run.rules);
    let text = "G21 G17 G90\nM5\nG65 P50\nM30\n";
    let file = "O50\nG31 Z-5.\nG65 P9814 D5.\nM99\n";
    let run = run_program(text, &Known { files: vec![("O50", file)], ..met(0.5) });
    assert_eq!((run.calls[0].line, run.calls[0].file), (2, 1));
    let missed = run.rules.iter().find(|rule| rule.rule == "missed-touch-stops").unwrap();
    assert_eq!((missed.holds, missed.lines.as_slice()), (Some(false), &[][..]));
}

/// Lines of every dialect, whole and broken.
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

    /// Whatever a text says, a run comes back, the same each time, and no move is in a line that is not there.
    #[test]
    fn any_text_comes_back(
        picks in proptest::collection::vec(0..LINES.len(), 1..40),
        dialect in 0..4_usize,
        trip in 0..3_usize,
        file in proptest::bool::ANY,
    ) {
        let lines: Vec<&str> = picks.iter().map(|pick| LINES[*pick]).collect();
        let text = lines.join("\n");
        let trip = [Trip::Unknown, Trip::At(0.5), Trip::Never][trip];
        let known = Known {
            dialect: (dialect < 3).then(|| DIALECTS[dialect]),
            touch: trip,
            set: vec![("#1", 2.0), ("R1", 1.0), ("Q1", 1.0)],
            files: if file { vec![("b", "o1 sub\nG38.3 X9 F9\no1 endsub\n")] } else { Vec::new() },
            ..Known::default()
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
