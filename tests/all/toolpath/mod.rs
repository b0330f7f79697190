//! The reader of any program's moves: against LinuxCNC's interpreter, against the plans whose programs it reads, and by hand.

mod macros;
mod plain;
mod runs;
mod state;

use crate::common::{interpret, jobs, planned};
use touchpath::import::toolpath::{KINDS, RunInputs, run_program};
use touchpath::import::{Toolpath, read_program};

fn places(path: &Toolpath) -> Vec<[f64; 3]> {
    path.to.chunks(3).map(|p| [p[0], p[1], p[2]]).collect()
}

fn said(path: &Toolpath) -> Vec<&str> {
    path.findings.iter().map(|f| f.code.as_str()).collect()
}

fn kinds(path: &Toolpath) -> Vec<&'static str> {
    path.kind.iter().map(|k| KINDS[usize::from(*k)]).collect()
}

/// Random programs of words: every position, kind, feed, centre and sense equals the interpreter's.
#[test]
fn words_mean_what_the_interpreter_says() {
    let mut state = 0x5DEE_CE66u64;
    let mut random = |count: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % count
    };
    let (mut moves, mut arcs) = (0, 0);
    for _ in 0..80 {
        let inch = random(2) == 0;
        let plane = random(3) as usize;
        let axes = [["X", "Y", "Z"], ["Z", "X", "Y"], ["Y", "Z", "X"]][plane];
        let centers = [["I", "J"], ["K", "I"], ["J", "K"]][plane];
        let mut text = format!(
            "{} {} G90 G94\nG0 X0 Y0 Z0\nF1000\n",
            if inch { "G20" } else { "g21" },
            ["G17", "G18", "G19"][plane]
        );
        let mut place = [0i64; 3];
        let mut absolute = true;
        for line in 0..40 {
            if random(6) == 0 {
                absolute = !absolute;
                text.push_str(if absolute {
                    "G90 (absolute)\n"
                } else {
                    "N10 G91 ; from here\n"
                });
            }
            let mut target = place;
            let axis = random(3) as usize;
            target[axis] += random(200) as i64 - 100;
            target[2] += random(3) as i64;
            let word = |i: usize, target: [i64; 3]| {
                let x = if absolute {
                    target[i]
                } else {
                    target[i] - place[i]
                };
                format!(" {}{}", axes[i], x as f64 / 8.0)
            };
            let words = |target: [i64; 3]| (0..3).map(|i| word(i, target)).collect::<String>();
            match random(8) {
                0 => text.push_str(&format!("G0{}\n", words(target))),
                1 => text.push_str(&format!(
                    "g1{} F{}\n",
                    words(target).to_lowercase().replace(' ', ""),
                    100 + random(900)
                )),
                // The interpreter has its own position after a probing move, so the next block has all axes.
                2 if target != place && absolute => {
                    let probe = format!(
                        "G38.{}{} F{}",
                        2 + random(2),
                        words(target),
                        50 + random(100)
                    );
                    text.push_str(&format!("{probe} (a probing move)\nG1{}\n", words(target)));
                }
                // Half a circle about a centre, up along the third axis.
                3 | 4 => {
                    let [a, o] = [8 * (1 + random(9) as i64), 8 * random(9) as i64];
                    target = [
                        place[0] + 2 * a,
                        place[1] + 2 * o,
                        place[2] + random(2) as i64,
                    ];
                    let turn = ["G2", "G3"][random(2) as usize];
                    let middle = if random(2) == 0 {
                        format!(
                            "G90.1 {turn}{} {}{} {}{}\nG91.1",
                            words(target),
                            centers[0],
                            (place[0] + a) as f64 / 8.0,
                            centers[1],
                            (place[1] + o) as f64 / 8.0
                        )
                    } else {
                        format!(
                            "{turn}{} {}{} {}{}",
                            words(target),
                            centers[0],
                            a as f64 / 8.0,
                            centers[1],
                            o as f64 / 8.0
                        )
                    };
                    text.push_str(&format!("{middle}\n"));
                }
                // By its radius, the short or the long arc.
                5 | 6 => {
                    target = [place[0] + 24, place[1] + 8 * random(5) as i64, place[2]];
                    let sign = if random(2) == 0 { "-" } else { "" };
                    text.push_str(&format!(
                        "{}{} R{sign}{}\n",
                        ["G2", "G3"][random(2) as usize],
                        words(target),
                        4 + random(20)
                    ));
                }
                // A whole circle.
                _ => {
                    target = place;
                    text.push_str(&format!(
                        "G3{} {}{} {}0\n",
                        words(target),
                        centers[0],
                        1 + random(20),
                        centers[1]
                    ));
                }
            }
            place = target;
            if line == 20 {
                text.push_str(
                    "
/G4 P0.1
T1 M5 S100
",
                );
            }
        }
        text.push_str("M2\n");
        let ran = interpret(&text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        let path = read_program(&text, None);
        assert_eq!((path.dialect, path.metric), ("iso", Some(!inch)));
        assert!(said(&path).is_empty(), "{:?}\n{text}", path.findings);
        assert_eq!(path.len(), ran.moves.len(), "{text}");
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 2e-4);
        for (i, wanted) in ran.moves.iter().enumerate() {
            let shown = format!("move {i}, line {}: {wanted:?}\n{text}", path.line[i] + 1);
            assert!(near(places(&path)[i], wanted.to), "{shown}");
            assert_eq!(
                kinds(&path)[i],
                if wanted.kind == "arc" {
                    "feed"
                } else {
                    wanted.kind
                },
                "{shown}"
            );
            assert!(
                wanted.kind == "rapid" || (path.feed[i] - wanted.feed).abs() < 1e-3,
                "{shown}"
            );
            let arc = path.arcs.iter().find(|arc| arc[0] == i as f64);
            assert_eq!(arc.is_some(), wanted.arc.is_some(), "{shown}");
            if let (Some([_, x, y, z, sweep, own]), Some((center, counter))) = (arc, wanted.arc) {
                assert!(
                    near([*x, *y, *z], center) && (*sweep > 0.0) == counter,
                    "{arc:?} {shown}"
                );
                assert_eq!(*own, 17.0 + plane as f64);
                arcs += 1;
            }
            moves += 1;
        }
    }
    assert!(moves > 2500 && arcs > 800, "{moves} {arcs}");
}

/// The moves of every generated program are in the lines of the plan, probing moves as such.
#[test]
fn programs_of_plans_are_their_plans() {
    let mut seen = 0;
    for (name, job) in jobs() {
        let plan = planned(&job);
        let path = read_program(&plan.program.text, None);
        if plan.program.post == "heidenhain" {
            assert!(path.is_empty(), "{name}: Klartext has no words");
            continue;
        }
        assert_eq!(
            path.dialect == "sinumerik",
            plan.program.post == "sinumerik",
            "{name}"
        );
        for (step, line) in plan.moves.iter().zip(&plan.program.move_lines) {
            let Some(i) = path.line.iter().position(|at| *at as i32 == *line) else {
                continue;
            };
            let end = places(&path)[i];
            if step.kind == "touch" {
                assert_eq!(kinds(&path)[i], "probe", "{name} line {line}");
            } else if step.arc.is_none() {
                assert!(
                    (0..3)
                        .all(|axis| end[axis].is_nan() || (end[axis] - step.to[axis]).abs() < 1e-4),
                    "{name} line {line}: {end:?} {step:?}"
                );
            }
            seen += 1;
        }
    }
    assert!(seen > 1000, "{seen}");
}

/// The words of one block do not carry over: a centre with only I has no J of the arc before.
#[test]
fn no_word_stays_for_the_next_block() {
    let begin = "G21 G17\nG0 X10 Y0 Z0\n";
    let before = [
        "G3 X0 Y10 I-13 J-3 F100",
        "G2 X0 Y10 R10 F70",
        "G53 X5",
        "G4 P2",
        "G1 X3 Y4 Z5",
        "G1 X#5 Y[2]",
        "G1 X1 F=",
        "G10 L2 X7",
    ];
    for after in [
        "G2 X10 Y0 I-10",
        "G3 X10 Y0 J12",
        "G3 X10 I1",
        "G1 X2",
        "X4",
        "G38.2 Z-1 F50",
        "G2 X10 Y0 R10",
        "I-4",
    ] {
        // To the same position, with the same feed and modes.
        let set = "G1 X10 Y0 Z0 F100\n";
        let alone = read_program(&format!("{begin}{set}{after}\n"), Some("iso"));
        for first in before {
            let both = read_program(&format!("{begin}{first}\n{set}{after}\n"), Some("iso"));
            let last = |path: &Toolpath| {
                let index = path.len() - 1;
                let arc = path
                    .arcs
                    .last()
                    .filter(|arc| arc[0] == index as f64)
                    .map(|arc| arc[1..].to_vec());
                format!(
                    "{:?} {} {} {arc:?}",
                    path.end(index),
                    path.kind[index],
                    path.feed[index]
                )
            };
            assert_eq!(last(&both), last(&alone), "{first}, then {after}");
        }
    }
}

/// No text causes a panic, a hang, or an invalid position.
#[test]
fn hostile_texts_are_read() {
    let long = format!("G1 X{}\n", "1".repeat(5_000));
    let deep = format!("G1 X{}1\n", "[".repeat(100_000));
    for text in [
        "",
        "\u{feff}",
        "G",
        "G1X",
        "X1",
        "G1 X",
        "/",
        "/;",
        "(",
        "G2 X1 Y1 I",
        "é\n",
        "G1 X1é\n",
        "O",
        "o<",
        "%",
        "G99999999999 X1\n",
        &long,
        &deep,
        "G91 G1 X1\n",
    ] {
        for dialect in [None, Some("iso"), Some("sinumerik")] {
            let path = read_program(text, dialect);
            assert_eq!(path.to.len(), 3 * path.len(), "{text:.40}");
            assert!(path.to.iter().all(|x| !x.is_infinite()), "{text:.40}");
        }
    }
    assert_eq!(
        said(&read_program("G91 G1 X1\n", None)),
        ["start-unknown", "no-units"]
    );
    // Long lines of invalid words take time linear in their length.
    for part in ["Xa1X1", "X1!", "#1=", "XSIN[", "_X1 ", "/N1"] {
        for dialect in ["iso", "sinumerik"] {
            read_program(&part.repeat(1_000_000 / part.len()), Some(dialect));
        }
    }
}

/// The end of each program's moves, and its findings: each of these was read as something else.
#[test]
fn words_that_are_no_moves_were_read_as_moves() {
    let unknown = [f64::NAN; 3];
    let known = |x: f64, y: f64, z: f64| [x, y, z];
    type Case<'a> = (&'a str, usize, [f64; 3], &'a [&'a str]);
    let cases: &[Case<'_>] = &[
        // A macro's arguments, and the ball position after it.
        (
            "G65 P9811 Z-5. F300\nG0 X10",
            2,
            known(10.0, f64::NAN, f64::NAN),
            &["lines-skipped"],
        ),
        (
            "M98 P100\nG0 X10",
            2,
            known(10.0, f64::NAN, f64::NAN),
            &["lines-skipped"],
        ),
        (
            "o<probe> call [1]\nG0 X10",
            2,
            known(10.0, f64::NAN, f64::NAN),
            &["lines-skipped"],
        ),
        // Other systems.
        ("G68 X0 Y0 R45\nX20", 2, known(20.0, 0.0, 10.0), &[]),
        (
            "G51.1 X0\nX20",
            2,
            known(20.0, 10.0, 10.0),
            &["places-transformed"],
        ),
        ("G92 X0 Y0\nX20", 2, known(20.0, 0.0, 10.0), &[]),
        (
            "G54\nX20\nG55\nX30",
            3,
            known(30.0, 10.0, 10.0),
            &["places-transformed"],
        ),
        ("G54\nX20\nG54\nX30", 3, known(30.0, 10.0, 10.0), &[]),
        // A cycle leaves the ball at its retract plane, at any height.
        (
            "G81 X20 Y20 Z-5 R2 F100\nX25 Y5\nX27 Z-8\nG80\nG0 X30",
            2,
            known(30.0, f64::NAN, f64::NAN),
            &["lines-skipped"],
        ),
        (
            "G81 X20 Y20 Z-5 R2 F100\nX25\nG1 X30",
            2,
            known(30.0, f64::NAN, f64::NAN),
            &["lines-skipped"],
        ),
        // A tool's length, and rotated planes.
        (
            "G43.1 Z-1.5\nX2",
            2,
            known(2.0, 10.0, f64::NAN),
            &["places-computed"],
        ),
        (
            "G68.2 X0 Y0 Z0 I0 J90 K0\nX2",
            2,
            known(2.0, 10.0, 10.0),
            &["places-transformed"],
        ),
        // Moves before any selection were in G54.
        (
            "G55\nX30",
            2,
            known(30.0, 10.0, 10.0),
            &["places-transformed"],
        ),
        (
            "G54.1 P1\nX30\nG54.1 P2\nX31",
            3,
            known(31.0, 10.0, 10.0),
            &["places-transformed"],
        ),
        ("G10 L2 P2 X100\nX30", 2, known(30.0, 10.0, 10.0), &[]),
        ("G10 L1 P2 Z100\nX30", 2, known(30.0, 10.0, 10.0), &[]),
        // A dwell beside a motion; a dwell alone, whose X is its time.
        ("G4 P0.001 G0 X20", 2, known(20.0, 10.0, 10.0), &[]),
        ("G4 X2.", 1, known(10.0, 10.0, 10.0), &[]),
        // A spline, and a tapping cycle that returns.
        (
            "G5 X20 Y20 I1 J1 P1 Q1",
            2,
            known(20.0, 20.0, 10.0),
            &["arc-unsolved"],
        ),
        (
            "G33.1 Z-5 K1\nX2",
            2,
            known(2.0, 10.0, 10.0),
            &["lines-skipped"],
        ),
        // The modes before an unknown word count.
        (
            "G91\nG90 G1 X50 ,R2 F100\nX60 Y30",
            2,
            known(60.0, 30.0, 10.0),
            &["lines-skipped"],
        ),
        // Blanks have no meaning in O words.
        (
            "o100 if[#1 EQ 1]\nM2\no100 endif\nG0 X5",
            2,
            known(5.0, 10.0, 10.0),
            &["lines-skipped"],
        ),
        (
            "o100sub\nG0 X5\no100endsub",
            1,
            known(10.0, 10.0, 10.0),
            &[],
        ),
        (
            "o<x>if[1 EQ 1]\nM2\no<x>endif\nG0 X5",
            1,
            known(10.0, 10.0, 10.0),
            &["lines-skipped"],
        ),
        // Axes that are not drawn.
        ("G0 X20 A90", 2, known(20.0, 10.0, 10.0), &["lines-skipped"]),
        // To the reference point, with all axes or those given.
        (
            "G28\nX1",
            2,
            known(1.0, f64::NAN, f64::NAN),
            &["machine-places"],
        ),
        (
            "G91 G28 Z0\nG90 X1",
            3,
            known(1.0, 10.0, f64::NAN),
            &["machine-places"],
        ),
        // A line that is not followed, with positions in it.
        (
            "Z-#5\nX2",
            3,
            known(2.0, 10.0, f64::NAN),
            &["places-computed"],
        ),
        (
            "Z[#5+1] IF\nX2",
            2,
            known(2.0, 10.0, f64::NAN),
            &["lines-skipped"],
        ),
        // A subroutine runs at its call; lines after the end do not run.
        (
            "o<s> sub\nG1 Z-50\no<s> endsub\nX2",
            2,
            known(2.0, 10.0, 10.0),
            &[],
        ),
        ("M30\nX99", 1, known(10.0, 10.0, 10.0), &["lines-skipped"]),
        ("M99\nX99", 1, known(10.0, 10.0, 10.0), &["lines-skipped"]),
        (
            "M99 P5\nX99",
            2,
            known(99.0, f64::NAN, f64::NAN),
            &["lines-skipped"],
        ),
        // Two motions or positions in a block: LinuxCNC refuses them.
        (
            "G0 X20 Y20 G1 X5 F100",
            2,
            known(5.0, 20.0, 10.0),
            &["words-twice"],
        ),
        ("G0 G1 X5 F100", 2, known(5.0, 10.0, 10.0), &["words-twice"]),
        // A lathe's code that sets the position of the tool.
        ("G50 X5\nX20", 2, known(20.0, 10.0, 10.0), &[]),
        ("G50 S2000\nG50\nX20", 2, known(20.0, 10.0, 10.0), &[]),
        // Blocks with block skip, and main blocks.
        ("/2 X3", 2, known(3.0, 10.0, 10.0), &["lines-optional"]),
        ("/G91\nX3", 2, known(13.0, 10.0, 10.0), &["lines-optional"]),
        ("/M5\n/T1", 1, known(10.0, 10.0, 10.0), &[]),
        (":10 X3", 2, known(3.0, 10.0, 10.0), &[]),
        // An end off its circle.
        (
            "G2 X20 Y10 I1 J0",
            2,
            known(20.0, 10.0, 10.0),
            &["arc-unsolved"],
        ),
    ];
    for (text, moves, end, said_of_it) in cases {
        let path = read_program(&format!("G21 G90\nG0 X10 Y10 Z10\n{text}\n"), None);
        assert_eq!(path.len(), *moves, "{text}: {:?}", places(&path));
        let last = *places(&path).last().unwrap_or(&unknown);
        let same = (0..3)
            .all(|axis| last[axis] == end[axis] || (last[axis].is_nan() && end[axis].is_nan()));
        assert!(same, "{text}: {last:?}");
        assert_eq!(said(&path), *said_of_it, "{text}");
    }
}

/// Beginnings of real programs, and texts that no SINUMERIK would have.
#[test]
fn the_user_is_asked_for_the_control_where_signs_contradict() {
    let text = "G21 G90\nG38.2 Z-5 F100\nG0 Z5\nG31 Z-5. F100\n";
    let asked = |post| {
        let known = RunInputs {
            post,
            ..RunInputs::default()
        };
        let run = run_program(text, &known);
        let asks = run
            .findings
            .iter()
            .zip(&run.finding_lines)
            .find(|(finding, _)| finding.code == "signs-contradict");
        asks.map(|(finding, lines)| (finding.message.clone(), lines.clone()))
    };
    assert_eq!(
        asked(None),
        Some((
            "Line 2 is for LinuxCNC, and line 4 for a Fanuc: choose the control".to_owned(),
            vec![1, 3]
        ))
    );
    assert_eq!(asked(Some("fanuc")), None);
}

#[test]
fn a_dialect_is_that_of_its_words() {
    for text in [
        "%_N_A_MPF\nG0 X1\n",
        "N5 R1=5\n",
        "n5 meas=1 g1 x5\n",
        "N5 MSG(\"x\")\n",
        "N1 IF $AC_MEA[1]==0 GOTOF E\n",
    ] {
        assert_eq!(read_program(text, None).dialect, "sinumerik", "{text}");
    }
    assert_eq!(
        kinds(&read_program("G71\nn5 meas=1 g1 x5\n", None)),
        ["probe"]
    );
    for text in [
        "$Alarm/Send=3\nG21\n",
        "$P\nG21\n",
        "N5 G65 P9810 R1\n",
        "N5 (MSG)\n",
        "T1 M6\n",
        "#<meas>=1\n",
    ] {
        assert_eq!(read_program(text, None).dialect, "iso", "{text}");
    }
}

/// Moves above the first units were read in them without a note.
#[test]
fn units_below_the_first_moves_are_said() {
    for (text, codes) in [
        ("G0 X1\nG20\nG0 X2\n", vec!["no-units"]),
        ("G20 G0 X1\nG0 X2\n", vec![]),
        ("G0 X1\n", vec!["no-units"]),
        ("T1\nG21\nG0 X1\nG20\nG0 X2\n", vec![]),
    ] {
        assert_eq!(said(&read_program(text, None)), codes, "{text}");
    }
}

/// Frames of a SINUMERIK were reported as lines that are not understood.
#[test]
fn a_frame_of_a_sinumerik_transforms_places() {
    let transformed = Some("places-transformed");
    for (line, code, end) in [
        ("TRANS X10 Y5", None, [20.0, -3.0, 3.0]),
        ("N5 trans x=R1", transformed, [20.0, 2.0, 3.0]),
        ("ATRANS Z1", None, [20.0, 2.0, 2.0]),
        // −1·sin 30° + 2·cos 30°.
        ("AROT RPL=30", None, [20.0, 1.232_050_808, 3.0]),
        ("ROT RPL=30 ; turned", None, [20.0, 1.232_050_808, 3.0]),
        ("AMIRROR X0", transformed, [20.0, 2.0, 3.0]),
        ("SCALE X2 Y2", transformed, [20.0, 2.0, 3.0]),
        ("TRANS", None, [20.0, 2.0, 3.0]),
        ("ROT ; none", None, [20.0, 2.0, 3.0]),
        ("TRANSMIT", Some("lines-skipped"), [20.0, 2.0, 3.0]),
    ] {
        let path = read_program(
            &format!("G71 G90\nG0 X1 Y2 Z3\n{line}\nX20\n"),
            Some("sinumerik"),
        );
        assert_eq!(
            (said(&path), path.len()),
            (code.into_iter().collect(), 2),
            "{line}"
        );
        assert_eq!(path.end(1).to_array(), end, "{line}");
    }
}

/// A carriage return ends a line, as on grbl; lines count as in an editor.
#[test]
fn a_carriage_return_ends_a_line() {
    for (text, lines) in [
        ("G21\rG0 X1\rG0 X2", [1, 2]),
        ("G21\r\nG0 X1\r\nG0 X2\r\n", [1, 2]),
        ("G21\n(a\rG0 X1\r)\nG0 X2", [2, 4]),
        ("G21\r\r\nG0 X1\n\rG0 X2\r", [2, 4]),
    ] {
        assert_eq!(read_program(text, None).line, lines, "{text:?}");
    }
}
