//! The proof and the safety rules: every rule for every control and cycle, a broken program for every rule, and a program with any digit changed.

mod proof;

use crate::common::{number, with};
use touchpath::control::safety::RULES;
use touchpath::control::shop::place::ON_ALARM;
use touchpath::control::{ORIENT, POSTS, ProgramForm, WRITE_OFFSET};
use touchpath::cycle::CYCLES;
use touchpath::form::Value;
use touchpath::job::{Plan, SafetyRow, check_program, default_job, plan};

fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

fn job_for(cycle: &str, post: &str, form: ProgramForm, offset: bool) -> Value {
    let job = with(&default_job(cycle).unwrap(), "control.post", text(post));
    let job = with(&job, "control.form", text(form.word()));
    // P9834 would check the angle of two circles after the write.
    let late = offset && form == ProgramForm::Cycle && cycle == "probing-two-circles";
    let job = if late {
        with(&job, "limits.angle", Value::Null)
    } else {
        job
    };
    with(
        &job,
        "control.workOffset",
        if offset { number(1.0) } else { Value::Null },
    )
}

fn judged(job: &Value, program: &str) -> Result<Vec<SafetyRow>, String> {
    check_program(job, program)
        .expect("a sound job")
        .map_err(|faults| format!("{faults:?}"))
}

fn broken(rows: &[SafetyRow]) -> Vec<&'static str> {
    rows.iter()
        .filter(|row| row.holds == Some(false))
        .map(|row| row.rule)
        .collect()
}

/// A control gives the reason for each rule that it cannot guarantee; all other rules hold.
#[test]
fn every_rule_holds_for_every_control_and_cycle() {
    let (mut held, mut unable) = (0, 0);
    for post in POSTS {
        for def in CYCLES {
            for form in ProgramForm::ALL
                .into_iter()
                .filter(|form| (post.supports)(def.probes, *form).is_ok())
            {
                // Cycle 1411 corrects the active preset itself.
                let itself = form == ProgramForm::Cycle && (post.cycle_sets_preset)(def.probes);
                let takes = post.work_offsets > 0 && !itself;
                for offset in [false, true].into_iter().filter(|offset| !offset || takes) {
                    // The cycle that retracts between the walls of a groove writes.
                    if (post.key, def.key, offset) == ("heidenhain", "groove-protected", false) {
                        continue;
                    }
                    let plan = match plan(&job_for(def.key, post.key, form, offset)) {
                        Ok(plan) => plan,
                        // Single touches write nothing.
                        Err(error)
                            if offset
                                && error
                                    .findings
                                    .iter()
                                    .any(|f| f.code == "work-offset-unsupported") =>
                        {
                            continue;
                        }
                        Err(error) => panic!("{} {}: {error}", post.key, def.key),
                    };
                    let names: Vec<&str> = plan.safety.iter().map(|row| row.rule).collect();
                    // Without a tolerance there is no action.
                    let asked = RULES.iter().map(|rule| rule.name).filter(|rule| {
                        ![
                            "tolerance-obeyed",
                            "place-within-limit",
                            "asked-before-write",
                        ]
                        .contains(rule)
                    });
                    assert_eq!(names, asked.collect::<Vec<_>>());
                    assert_eq!(
                        plan.program.proof.is_some(),
                        form == ProgramForm::Moves,
                        "{} {}",
                        post.key,
                        def.key
                    );
                    if let Some(proof) = &plan.program.proof {
                        assert_eq!(
                            (proof.moves, proof.touches),
                            (plan.moves.len(), plan.touches.len())
                        );
                        assert_eq!(proof.arithmetic, post.computes);
                    }
                    for row in &plan.safety {
                        let cannot = post
                            .unsupported_rules
                            .iter()
                            .find(|(rule, _)| *rule == row.rule);
                        match row.holds {
                            Some(holds) => {
                                assert!(
                                    holds && row.lines.is_empty() && cannot.is_none(),
                                    "{} {}: {row:?}",
                                    post.key,
                                    def.key
                                )
                            }
                            None => {
                                assert!(
                                    cannot.is_some_and(|(_, why)| *why == row.said.template())
                                        || form == ProgramForm::Cycle,
                                    "{row:?}"
                                )
                            }
                        }
                        held += usize::from(row.holds.is_some());
                        unable += usize::from(row.holds.is_none());
                    }
                }
            }
        }
    }
    assert!(held > 1500 && unable > 50, "{held} {unable}");
}

/// The lines of the moves come from the writer, those of the rules from the reader.
#[test]
fn a_rule_names_the_lines_that_it_was_asked_of() {
    let mut written = 0;
    for post in POSTS {
        for def in CYCLES
            .iter()
            .filter(|def| (post.supports)(def.probes, ProgramForm::Moves).is_ok())
        {
            let plan = plan(&job_for(
                def.key,
                post.key,
                ProgramForm::Moves,
                post.work_offsets > 0,
            ))
            .unwrap();
            let about = |rule: &str| {
                let row = plan.safety.iter().find(|row| row.rule == rule).unwrap();
                row.about
                    .iter()
                    .map(|line| i32::try_from(*line).unwrap())
                    .collect::<Vec<_>>()
            };
            let lines = |touches: bool| -> Vec<i32> {
                let moves = plan.moves.iter().zip(&plan.program.move_lines);
                moves
                    .filter(|(step, _)| (step.kind == "touch") == touches)
                    .map(|(_, line)| *line)
                    .collect()
            };
            let at = format!("{} {}", post.key, def.key);
            let touches = lines(true);
            assert_eq!(about("missed-touch-stops"), touches, "{at}");
            assert_eq!(
                about("probe-asked"),
                touches.iter().take(1).copied().collect::<Vec<_>>(),
                "{at}"
            );
            assert!(
                touches
                    .iter()
                    .all(|line| about("feeds-stated").contains(line)),
                "{at}"
            );
            if let Some(last) = plan.program.move_lines.last() {
                assert_eq!(about("ends-above"), [*last], "{at}");
                let before = about("modes-stated");
                assert!(
                    before.len() == 1
                        && plan
                            .program
                            .move_lines
                            .iter()
                            .all(|line| *line >= before[0]),
                    "{at}"
                );
            }
            // A plain retract from a touch is no positioning.
            let watched = about("positioning-watched");
            let asked = plan
                .safety
                .iter()
                .find(|row| row.rule == "positioning-watched")
                .unwrap()
                .holds
                .is_some();
            let wanted = plan
                .moves
                .iter()
                .zip(&plan.program.move_lines)
                .filter(|(step, _)| step.kind == "position");
            assert!(
                !asked || wanted.clone().all(|(_, line)| watched.contains(line)),
                "{at}"
            );
            assert!(!touches.iter().any(|line| watched.contains(line)), "{at}");
            let text: Vec<&str> = plan.program.text.lines().collect();
            for line in about("one-write") {
                let block = text[usize::try_from(line).unwrap()];
                assert!(
                    ["G10 L2", "$P_UIFR", "#5221=", "#5222=", "#5223="]
                        .iter()
                        .any(|word| block.contains(word)),
                    "{at}: {block}"
                );
                written += 1;
            }
        }
    }
    assert!(written > 60, "{written}");
}

/// The blocks with the write show the corrected axes. An axis that is not measured is written on LinuxCNC with its current value; on a SINUMERIK it gets its
/// share if the frame is rotated.
#[test]
fn what_a_program_writes_is_in_its_blocks() {
    const LETTERS: [&str; 3] = ["X", "Y", "Z"];
    let mut seen = std::collections::BTreeMap::new();
    for post in POSTS {
        for def in CYCLES
            .iter()
            .filter(|def| (post.supports)(def.probes, ProgramForm::Moves).is_ok())
        {
            for offset in [false, true] {
                let plan = plan(&job_for(
                    def.key,
                    post.key,
                    ProgramForm::Moves,
                    offset && post.work_offsets > 0,
                ))
                .unwrap();
                let (text, at) = (
                    plan.program.text.as_str(),
                    format!("{} {}", post.key, def.key),
                );
                let block = text
                    .lines()
                    .find(|line| line.contains("G10 L20 P1 "))
                    .unwrap_or("");
                let corrects = |axis: usize| {
                    let letter = LETTERS[axis];
                    text.contains(&format!("\n#522{}=#522{}+", axis + 1, axis + 1))
                        || text.contains(&format!("\n$P_UIFR[1,{letter},TR]="))
                        || block.contains(&format!(" {letter}["))
                            && !block.contains(&format!("{letter}[#<_{}>]", letter.to_lowercase()))
                };
                let turns = text.contains("\nG10 L2 P1 R[") || text.contains("\n$P_UIFR[1,Z,RT]=");
                let axes = (0..3)
                    .filter(|axis| corrects(*axis))
                    .map(|axis| LETTERS[axis]);
                let found: Vec<&str> = axes.chain(turns.then_some("rotation")).collect();
                let writes = &plan.program.writes;
                let shares = post.key == "sinumerik"
                    && found.starts_with(&["X", "Y"])
                    && writes.iter().all(|w| found.contains(w));
                assert!(*writes == found || shares, "{at}: {writes:?} {found:?}");
                *seen.entry(writes.join(" ")).or_insert(0) += 1;
            }
        }
    }
    for (writes, times) in [("", 100), ("X Y", 30), ("X Y Z", 5), ("X", 5), ("Z", 3)] {
        assert!(
            seen.get(writes).is_some_and(|n| *n >= times),
            "{writes}: {seen:?}"
        );
    }
}

#[test]
fn every_rule_says_what_and_why_and_what_a_control_cannot_names_a_rule() {
    for rule in RULES {
        assert!(
            rule.requirement.len() > 20 && rule.why.ends_with('.'),
            "{}",
            rule.name
        );
        assert!(
            rule.name
                .bytes()
                .all(|b| b.is_ascii_lowercase() || b == b'-'),
            "{}",
            rule.name
        );
    }
    for (what, why) in POSTS.iter().flat_map(|post| post.unsupported_rules) {
        let rule = RULES.iter().any(|known| known.name == *what);
        let other = [ORIENT, WRITE_OFFSET, ON_ALARM.key].contains(what);
        assert!((rule || other) && why.len() > 20, "{what}");
    }
}

/// A program that breaks each rule: the rule, the control, the replaced text and its replacement.
pub const BROKEN: &[(&str, &str, &str, &str)] = &[
    ("modes-stated", "linuxcnc", "G21\n", ""),
    ("modes-stated", "linuxcnc", "G17 G8", "G18 G8"),
    ("modes-stated", "linuxcnc", " G61 ", " G64 "),
    ("modes-stated", "linuxcnc", " G61 ", " "),
    ("modes-stated", "linuxcnc", "\nG54\n", "\nG54\nM72\n"),
    ("modes-stated", "grbl", " G61 ", " "),
    ("spindle-off", "linuxcnc", "\nM72\nM2\n", "\nM3\nM72\nM2\n"),
    ("modes-stated", "grbl", " G90", ""),
    ("feeds-stated", "grblhal", "G38.2 X42 F150", "G38.2 X42"),
    ("feeds-stated", "fluidnc", "G38.2 X42 F150", "G38.2 X42"),
    ("modes-stated", "sinumerik", " G94", ""),
    ("modes-stated", "fanuc", "G54\nG53\n#100", "G55\nG53\n#100"),
    ("spindle-off", "linuxcnc", "M5 M9", "M9"),
    ("spindle-off", "haas", "M5\n", "M3\n"),
    // Without watched positioning the first touch has the check.
    (
        "probe-asked",
        "sinumerik",
        "IF $A_PROBE[1]<>0 GOTOF TP_DEFLECTED\n",
        "",
    ),
    (
        "probe-free-again",
        "sinumerik",
        "IF $A_PROBE[1]<>0 GOTOF TP_STUCK\n",
        "",
    ),
    (
        "probe-free-again",
        "sinumerik",
        "TP_STUCK:\n",
        "TP_STUCK:\nG1 X500 F5000\n",
    ),
    (
        "probe-free-again",
        "sinumerik",
        "TP_STUCK:\n",
        "TP_STUCK:\nLIMS=5\n",
    ),
    (
        "probe-free-again",
        "sinumerik unwatched",
        "IF $A_PROBE[1]<>0 GOTOF TP_STUCK\n",
        "",
    ),
    (
        "low-start-goes-up",
        "linuxcnc",
        "o4 if [#<_z> LT 30]",
        "o4 if [#<_z> LT -900]",
    ),
    (
        "low-start-goes-up",
        "sinumerik",
        "IF $AA_IW[Z]>=30 GOTOF TP_ABOVE",
        "IF $AA_IW[Z]>=-900 GOTOF TP_ABOVE",
    ),
    (
        "low-start-goes-up",
        "fanuc",
        "IF [#5043-#100 LT 29.95] GOTO 9005\n",
        "",
    ),
    (
        "positioning-watched",
        "linuxcnc",
        "G38.3 X32 Y0 Z10 F1000",
        "G1 X32 Y0 Z10 F1000",
    ),
    (
        "positioning-watched",
        "sinumerik",
        "MEAS=1 G1 X32 F1000",
        "G1 X32 F1000",
    ),
    (
        "positioning-watched",
        "fanuc",
        "IF [ABS[#5061-32.]+ABS[#5062]+ABS[#5063-#100-10.] GT 0.05] GOTO 9001\n",
        "",
    ),
    (
        "positioning-watched",
        "haas",
        " M78\nG103 P1\nIF [ABS[#5061-32.]+ABS[#5062]+ABS[#5063-#100-10.] GT 0.05] GOTO 9001\n",
        "\n",
    ),
    // After a semicolon it is only a comment: a contact just ends the program.
    (
        "positioning-watched",
        "linuxcnc",
        "(ABORT,Contact in move",
        ";ABORT,Contact in move",
    ),
    (
        "contact-lifts",
        "linuxcnc",
        "G1 Z30 F2000\no1",
        "G1 Z10 X3 F2000\no1",
    ),
    (
        "contact-lifts",
        "linuxcnc",
        "G1 Z30 F2000\no1",
        "G1 Z9999 F2000\no1",
    ),
    (
        "contact-lifts",
        "linuxcnc",
        "o<tp_exit> call [3] [1]",
        "o<tp_exit> call [3] [0]",
    ),
    (
        "contact-lifts",
        "sinumerik",
        "G1 Z30 F2000\nTP_STOP",
        "G1 Z-30 F2000\nTP_STOP",
    ),
    (
        "contact-lifts",
        "fanuc",
        "N9001\nIF [#5043-#100 GE 30.] GOTO 9011\n",
        "N9001\nGOTO 9011\n",
    ),
    (
        "missed-touch-stops",
        "sinumerik",
        "IF $AC_MEA[1]==0 GOTOF TP_MISSED\n",
        "",
    ),
    (
        "missed-touch-stops",
        "fanuc",
        "GT 0.05] GOTO 9001",
        "GT 500.] GOTO 9001",
    ),
    (
        "missed-touch-lifts",
        "sinumerik",
        "GOTOF TP_MISSED",
        "GOTOF TP_DEFLECTED",
    ),
    (
        "missed-touch-lifts",
        "fanuc",
        "LE 0.05] GOTO 9002",
        "LE 0.05] GOTO 9003",
    ),
    (
        "feeds-stated",
        "linuxcnc",
        "G38.2 X42 Y0 Z-10 F150",
        "G38.2 X42 Y0 Z-10",
    ),
    ("feeds-stated", "grbl", "G38.2 X42 F150", "G38.2 X42"),
    ("feeds-stated", "haas", " F150. M79", " M79"),
    ("no-low-rapid", "grbl", "G38.3 Z-10 F1000", "G0 Z-10"),
    (
        "positioning-watched",
        "grbl",
        "G38.3 Z-10 F1000",
        "G1 Z-10 F1000",
    ),
    (
        "positioning-watched",
        "fluidnc",
        "G38.3 X-32 F1000\n",
        "G38.3 X-32 F1000\nG1 X-32.1\n",
    ),
    (
        "no-low-rapid",
        "linuxcnc",
        "G38.3 X32 Y0 Z-10 F1000",
        "G0 X32 Y0 Z-10",
    ),
    (
        "offset-after-touches",
        "linuxcnc",
        "M5 M9\n",
        "M5 M9\nG10 L20 P1 X0 Y0\n",
    ),
    (
        "offset-after-touches",
        "sinumerik",
        "TP_MOVE=5\n",
        "TP_MOVE=5\n$P_UIFR[1,X,TR]=0\n",
    ),
    (
        "offset-after-touches",
        "fanuc",
        "N9002\n",
        "N9002\n#5221=0\n",
    ),
    ("one-write", "linuxcnc", "G10 L20 P1", "G10 L20 P2"),
    (
        "one-write",
        "sinumerik",
        "R11=$P_UIFR[1,Z,RT]",
        "$P_UIFR[1,X,TR]=0\n$P_UIFR[1,X,TR]=1\nR11=$P_UIFR[1,Z,RT]",
    ),
    ("one-write", "haas", "#5222=#5222", "#5221=#5222"),
    (
        "plausible-before-write",
        "linuxcnc",
        "(ABORT,width1",
        "(DEBUG,width1",
    ),
    (
        "plausible-before-write",
        "sinumerik",
        "Nothing is written\")\nGOTOF TP_STOP\n",
        "Nothing is written\")\n",
    ),
    (
        "plausible-before-write",
        "fanuc",
        "GT 0.5] GOTO 9061",
        "GT 5.] GOTO 9061",
    ),
    (
        "plausible-before-write",
        "haas",
        "GT 0.5] GOTO 9062",
        "GT 0.05] GOTO 9062",
    ),
    (
        "tolerance-obeyed",
        "linuxcnc stop",
        "(ABORT,width1 is #<width1>, not ",
        "(DEBUG,width1 is #<width1>, not ",
    ),
    ("tolerance-obeyed", "linuxcnc stop", " GT 0.1]", " GT 0.01]"),
    (
        "tolerance-obeyed",
        "sinumerik stop",
        "<=0.1 GOTOF TP_GOOD",
        "<=0.2 GOTOF TP_GOOD",
    ),
    (
        "tolerance-obeyed",
        "haas stop",
        "GT 0.1] GOTO",
        "GT 0.2] GOTO",
    ),
    (
        "tolerance-obeyed",
        "fanuc mark",
        "#3006=31(WIDTH1 OUT",
        "#3000=31(WIDTH1 OUT",
    ),
    (
        "place-within-limit",
        "linuxcnc follows",
        "(ABORT,TOP.point.z is",
        "(DEBUG,TOP.point.z is",
    ),
    (
        "place-within-limit",
        "linuxcnc follows",
        "[ABS[#<top_point_z>] GT 1]",
        "[ABS[#<top_point_z>] GT 1.5]",
    ),
    (
        "place-within-limit",
        "linuxcnc follows",
        "[ABS[#<bore_center_x>] GT 1]",
        "[ABS[#<bore_center_y>] GT 1]",
    ),
    (
        "place-within-limit",
        "sinumerik follows",
        "IF ABS(R3)<=1 GOTOF TP_GOOD_1",
        "IF ABS(R3)<=2 GOTOF TP_GOOD_1",
    ),
    (
        "place-within-limit",
        "fanuc follows",
        "IF [ABS[#103] GT 1.] GOTO 9061\n",
        "",
    ),
    (
        "place-within-limit",
        "haas follows",
        "IF [ABS[#105] GT 1.] GOTO 9062\n",
        "",
    ),
    (
        "place-within-limit",
        "linuxcnc turns",
        "[ABS[#<side_rotation>+90] GT 1.5]",
        "[ABS[#<side_rotation>+90] GT 2.5]",
    ),
    (
        "place-within-limit",
        "linuxcnc turns",
        "[ABS[#<side_rotation>+90] GT 1.5]",
        "[[#<side_rotation>+90] GT 1.5]",
    ),
    (
        "place-within-limit",
        "linuxcnc grows",
        "[ABS[#<slot_width>-30] GT 2]",
        "[ABS[#<slot_width>-30] GT 3]",
    ),
    (
        "place-within-limit",
        "linuxcnc grows",
        "[ABS[#<slot_width>-30] GT 2]",
        "[[30-#<slot_width>] GT 2]",
    ),
    (
        "place-within-limit",
        "linuxcnc relates",
        "[ABS[#<row_rotation>] GT 1.5]",
        "[ABS[#<row_rotation>] GT 2.5]",
    ),
    (
        "place-within-limit",
        "linuxcnc relates",
        "[ABS[#<mid_center_x>] GT 3]",
        "[#<mid_center_x> GT 3]",
    ),
    (
        "place-within-limit",
        "sinumerik relates",
        "IF ABS(R10)<=1.5 GOTOF TP_GOOD_4",
        "IF R10<=1.5 GOTOF TP_GOOD_4",
    ),
    (
        "place-within-limit",
        "fanuc relates",
        "IF [ABS[#110] GT 1.5] GOTO 9064\n",
        "",
    ),
    (
        "restart-writes-nothing",
        "fanuc",
        "IF [#109 NE 4] GOTO 9006\n",
        "",
    ),
    ("restart-writes-nothing", "haas", "#109=0\n#5221=", "#5221="),
    (
        "restart-writes-nothing",
        "sinumerik",
        "R10=0\n$P_UIFR",
        "$P_UIFR",
    ),
    ("asked-before-write", "linuxcnc asks", "\nM0\n", "\n"),
    ("asked-before-write", "fanuc asks", "\nM0\n", "\n"),
    ("asked-before-write", "sinumerik asks", "\nM0\n", "\n"),
    (
        "asked-before-write",
        "linuxcnc outside",
        "[ABS[#<width1>-80] GT 0.1]",
        "[ABS[#<width1>-80] GT 0.2]",
    ),
    (
        "asked-before-write",
        "haas outside",
        "-80.] GT 0.1] GOTO",
        "-80.] GT 0.2] GOTO",
    ),
    (
        "restart-writes-nothing",
        "fanuc asks",
        "#109=0\nM0\n",
        "M0\n",
    ),
    (
        "restart-writes-nothing",
        "sinumerik asks",
        "R10=0\nM0\n",
        "M0\n",
    ),
    ("ends-above", "linuxcnc", "\nM72\nM2\n", "\nM72\n"),
    ("ends-above", "grbl", "G38.3 Z30 F2000\nM2", "M2"),
];

#[test]
fn each_rule_catches_a_program_that_breaks_it() {
    for rule in RULES {
        assert!(
            BROKEN.iter().any(|(name, ..)| *name == rule.name),
            "no program breaks {}",
            rule.name
        );
    }
    for (rule, post, old, new) in BROKEN {
        let (post, how) = post.split_once(' ').unwrap_or((post, ""));
        let known = touchpath::control::find(post).unwrap();
        let job = job_for(
            "internal-rectangle-protected",
            post,
            ProgramForm::Moves,
            known.work_offsets > 0,
        );
        let job = with(
            &job,
            "control.protection",
            text(if how == "unwatched" {
                "none"
            } else {
                "checked"
            }),
        );
        let job = match how {
            "turns" => with(
                &crate::common::job(crate::tests::set_ups::turns::TURNED),
                "control.post",
                text(post),
            ),
            "grows" => with(
                &crate::common::job(crate::tests::set_ups::turns::GROWN),
                "control.post",
                text(post),
            ),
            "follows" => with(
                &crate::common::job(crate::tests::set_ups::follows::STEPS),
                "control.post",
                text(post),
            ),
            "relates" => with(
                &crate::common::job(crate::tests::set_ups::led::PLATE),
                "control.post",
                text(post),
            ),
            "asks" => with(&job, "control.ask", text("always")),
            "outside" => {
                let width = [("tolerance".to_owned(), text("±0.1"))].to_vec();
                let tolerances = Value::Map(vec![("width1".to_owned(), Value::Map(width))]);
                let job = with(&job, "tolerances", tolerances);
                with(&job, "control.ask", text("outside"))
            }
            "stop" | "mark" => {
                let width = [
                    ("tolerance".to_owned(), text("±0.1")),
                    ("action".to_owned(), text(how)),
                ];
                with(
                    &job,
                    "tolerances",
                    Value::Map(vec![("width1".to_owned(), Value::Map(width.to_vec()))]),
                )
            }
            _ => job,
        };
        let program = plan(&job).unwrap().program.text;
        assert!(
            !broken(&judged(&job, &program).unwrap()).contains(rule),
            "{post}"
        );
        assert!(
            program.contains(old),
            "{post} {rule}: {old} is not in\n{program}"
        );
        let changed = program.replacen(old, new, 1);
        let rows = judged(&job, &changed).unwrap_or_else(|e| panic!("{post} {rule} {new}: {e}"));
        let row = rows.iter().find(|row| row.rule == *rule).unwrap();
        assert_eq!(
            row.holds,
            Some(false),
            "{post}: {old} became {new}: {:?}",
            broken(&rows)
        );
        assert_ne!(
            row.message,
            RULES.iter().find(|r| r.name == *rule).unwrap().requirement
        );
    }
}

/// Lines that no program may have between its moves, even if everything else is correct.
pub const DANGEROUS: &[(&str, &[&str])] = &[
    (
        "linuxcnc",
        &[
            "G20",
            "G18",
            "G55",
            "G64",
            "G49",
            "G91",
            "M3",
            "M3\nM5",
            "M72",
            "#5211=5",
            "#5403=50",
            "G1 Z-80 F100",
            "G0 X5",
            "o77 if [#<never_set> EQ 0]
o77 endif",
            "(ABORT,here)",
            "(abort,here)",
            "(py,here)",
            ";py,here",
        ],
    ),
    ("grblhal", &["G20", "G55", "M3", "G1 Z-80 F100"]),
    ("fluidnc", &["G20", "G55", "M3", "G1 Z-80 F100"]),
    (
        "grbl",
        &["G20", "G18", "G55", "G49", "G64", "M3", "G1 Z-80 F100"],
    ),
    (
        "fanuc",
        &[
            "G20",
            "G18",
            "G55",
            "M3",
            "#5201=5.",
            "#5203=-50.",
            "#2001=5.",
            "#3003=2",
            "#3004=7",
            "G53 G0 Z0.",
            "G1 Z-80. F100.",
            "IF [#500 EQ 1] GOTO 9001",
            "#101=#5041",
            "#5221=0",
            "O1001",
        ],
    ),
    (
        "haas",
        &[
            "G20",
            "G18",
            "G55",
            "G154 P3",
            "O1001",
            "M3",
            "#5201=5.",
            "#3003=2",
            "G53 G0 Z0.",
            "G1 Z-80. F100.",
            "IF [#500 EQ 1] GOTO 9001",
        ],
    ),
    (
        "sinumerik",
        &[
            "G70",
            "G18",
            "G505",
            "M3",
            "Z=-80",
            "X=5",
            "F=5",
            "T=5",
            "D=0",
            "S=1000",
            "LIMS=5",
            "G1 Z-80 F100",
            "IF R90==1 GOTOF TP_EXIT",
            "R95=$AA_IW[X]",
            "MSG(\"\") G0 X5 Y5 Z-50 MSG(\"\")",
            "MSG() G0 Z-50 )",
            "MSG(\"A\"<<TP_MOVE) Z=-(50)",
            "SETAL(65000) G0 Z=-(50)",
            "$P_UIFR[1,X,TR]=0",
        ],
    ),
];

/// Each of them is reported in a generated program that is opened again, and refused by the proof: after a plain retract, where nothing has stopped look-ahead.
#[test]
fn no_dangerous_line_between_two_moves_goes_unnoticed() {
    for (post, lines) in DANGEROUS {
        let known = touchpath::control::find(post).unwrap();
        let job = job_for(
            "internal-rectangle-protected",
            post,
            ProgramForm::Moves,
            known.work_offsets > 0,
        );
        let plan = plan(&job).unwrap();
        let back = plan
            .moves
            .iter()
            .position(|step| step.kind == "back")
            .unwrap();
        let at = plan.program.move_lines[back] as usize + 1;
        let moved: Vec<i32> = plan.program.move_lines.clone();
        let unnoticed = |line: &str| {
            let mut text: Vec<&str> = plan.program.text.lines().collect();
            line.lines()
                .enumerate()
                .for_each(|(i, line)| text.insert(at + i, line));
            let more = line.lines().count() as i32;
            let moved: Vec<i32> = moved
                .iter()
                .map(|n| if *n >= at as i32 { n + more } else { *n })
                .collect();
            let text = text.join("\n");
            let good = judged(&job, &text).is_ok_and(|rows| broken(&rows).is_empty());
            good && touchpath::job::proves(&job, &text, &moved)
        };
        let comment = if *post == "sinumerik" {
            "; HERE"
        } else {
            "(HERE)"
        };
        assert!(unnoticed(comment), "{post}: a comment between two moves");
        for line in *lines {
            assert!(!unnoticed(line), "{post}: {line}");
        }
    }
}

/// A variable has several spellings: in capitals, with blanks, with leading zeros.
#[test]
fn a_result_that_is_overwritten_in_another_spelling_is_not_proven() {
    for (post, line, before) in [
        ("linuxcnc", "#<center_x>=99", "(DEBUG,"),
        ("linuxcnc", "#<CENTER_X>=99", "(DEBUG,"),
        ("linuxcnc", "#<center _x>=99", "(DEBUG,"),
        ("fanuc", "#0100=99.", "M30"),
        ("haas", "#0100=99.", "M30"),
        ("sinumerik", "R01=99", "M30"),
        ("sinumerik", "r1=99", "M30"),
    ] {
        let job = job_for(
            "internal-rectangle-protected",
            post,
            ProgramForm::Moves,
            false,
        );
        let plan = plan(&job).unwrap();
        // The first result is in this variable.
        let named = plan
            .program
            .text
            .split_once("RESULTS: #")
            .map_or("100", |(_, list)| list.split(' ').next().unwrap());
        let line = line.replace("100", named);
        let changed =
            plan.program
                .text
                .replacen(&format!("\n{before}"), &format!("\n{line}\n{before}"), 1);
        assert_ne!(changed, plan.program.text, "{post}");
        assert!(
            !touchpath::job::proves(&job, &changed, &plan.program.move_lines),
            "{post}: {line}"
        );
        let comment = if post == "sinumerik" {
            "; HERE"
        } else {
            "(HERE)"
        };
        let same = changed.replacen(&line, comment, 1);
        assert!(
            touchpath::job::proves(&job, &same, &plan.program.move_lines),
            "{post}: {line}"
        );
    }
}

/// Without the blocks that stop look-ahead, a control evaluates positions before the ball reaches them: no program without them is accepted.
#[test]
fn the_blocks_that_stop_reading_ahead_are_asked_for() {
    for (post, halt) in [
        ("fanuc", "G53\n"),
        ("haas", "G103 P1\n"),
        ("sinumerik", "STOPRE\n"),
        ("linuxcnc", "M66 E0 L0\n"),
    ] {
        let job = job_for(
            "internal-rectangle-protected",
            post,
            ProgramForm::Moves,
            true,
        );
        let plan = plan(&job).unwrap();
        let places: Vec<usize> = plan
            .program
            .text
            .match_indices(halt)
            .map(|(at, _)| at)
            .collect();
        assert!(!places.is_empty(), "{post}");
        let comment = if post == "sinumerik" {
            "; no\n"
        } else {
            "(NO)\n"
        };
        // A Haas stops automatically at M78 and M79: lines after its end run only if nothing has moved.
        let end = if post == "haas" {
            plan.program.text.find("\nM30").unwrap()
        } else {
            plan.program.text.len()
        };
        let after_motion = |at: usize| {
            let line = plan.program.text[..at].lines().last().unwrap();
            ["G1 ", "G31 ", "MEAS=1 "]
                .iter()
                .any(|head| line.starts_with(head))
                || line == "o1 endif"
        };
        for at in places
            .iter()
            .copied()
            .filter(|at| *at < end && after_motion(*at))
        {
            let text = format!(
                "{}{comment}{}",
                &plan.program.text[..at],
                &plan.program.text[at + halt.len()..]
            );
            assert!(
                !touchpath::job::proves(&job, &text, &plan.program.move_lines),
                "{post}: {text}"
            );
        }
        let text = plan.program.text.replace(halt, comment);
        let rules = judged(&job, &text).map(|rows| broken(&rows));
        assert!(
            rules.is_err() || rules.is_ok_and(|broken| !broken.is_empty()),
            "{post}"
        );
    }
}

/// A comment about the start position makes no program safe: only the job can state it.
#[test]
fn a_comment_holds_no_rule() {
    let job = job_for(
        "internal-rectangle-protected",
        "linuxcnc",
        ProgramForm::Moves,
        false,
    );
    let program = plan(&job).unwrap().program.text;
    let broken_one = program.replacen("o4 if [#<_z> LT 30]", "o4 if [#<_z> LT -900]", 1);
    assert!(broken(&judged(&job, &broken_one).unwrap()).contains(&"low-start-goes-up"));
    let said = format!("(The stylus is taken to be at X0 Y0 Z30 before the start)\n{broken_one}");
    assert!(broken(&judged(&job, &said).unwrap()).contains(&"low-start-goes-up"));
}

/// A setting of the user is no fault, and is reported.
#[test]
fn what_the_job_asks_for_is_said_and_not_refused() {
    let job = with(
        &job_for("hole-protected", "linuxcnc", ProgramForm::Moves, true),
        "control.protection",
        text("none"),
    );
    let job = with(&job, "feeds.longLink", Value::Null);
    let plan = plan(&job).unwrap();
    assert_eq!(
        broken(&plan.safety),
        ["positioning-watched", "no-low-rapid"]
    );
    let watched = plan
        .safety
        .iter()
        .find(|row| row.rule == "positioning-watched")
        .unwrap();
    let lines: Vec<&str> = plan.program.text.lines().collect();
    assert!(
        !watched.lines.is_empty()
            && watched
                .lines
                .iter()
                .all(|line| lines[*line].starts_with('G')),
        "{watched:?}"
    );
}
