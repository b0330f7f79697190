//! Foreign or changed programs, and faults in reading them.

use super::*;

/// Blanks separate words, and many of them cost no more time than as many letters.
#[test]
fn blanks_between_words_are_passed_over_once() {
    for blank in ["  ", "\t", " \t "] {
        let text = format!(
            "G21{blank}G17{blank}G90\nG0{blank}X1{blank}Y2{blank}Z[1{blank}+{blank}2]\nG1 X5 F100\nM2\n"
        );
        let imported = crate::common::import(&text).unwrap_or_else(|e| panic!("{blank:?}: {e}"));
        let moves = imported.trace.unwrap().moves;
        assert_eq!(moves[0].to, [Some(1.0), Some(2.0), Some(3.0)], "{blank:?}");
        // Hundreds of thousands of characters in a line without probing: the search for it ends.
        let said = said(&format!(
            "G0 X0\n{}Q1\nM2\n",
            format!("G21{blank}").repeat(150_000)
        ));
        assert_eq!(said, ["nothing-to-import"], "{blank:?}");
    }
}

/// A semicolon is no comment of a Fanuc, whose screen shows one as the end of a block: the text after it was read as another comment.
#[test]
fn a_semicolon_hid_a_motion_from_fanuc_and_haas() {
    for post in ["fanuc", "haas"] {
        let text = program(post);
        let line = |part: &str| {
            text.lines()
                .find(|line| line.contains(part))
                .unwrap()
                .to_owned()
        };
        let (touch, name, hash, set) = (
            line("G31 X"),
            line("JOB: "),
            line("BLOCKS BELOW"),
            line("#149="),
        );
        for (old, new) in [
            (&set, format!("{set};G0 Z-50")),
            (&touch, format!("{touch};G0 Z-50")),
            (&touch, format!("{touch} ; (A)")),
            (&touch, format!("{touch};")),
            (&touch, format!(";\n{touch}")),
            (&name, format!("{name};G0 Z-50")),
            (&name, name.replace(')', ";G0 Z-50)")),
            (&hash, format!(";G0 Z-50{hash}")),
            (&hash, format!("{hash}\n(A;B)")),
            (&"%".to_owned(), "%;G0 Z-50".to_owned()),
        ] {
            assert!(text.contains(old), "{old}");
            let found = said(&text.replacen(old.as_str(), &new, 1));
            assert_eq!(found, ["not-understood"], "{post} {new}");
        }
        // All of them together, each once.
        let found = said(
            &text
                .replace(&touch, &format!("{touch};A"))
                .replace("M30\n", "M30;\nWHAT\n"),
        );
        assert!(
            found.len() > 2 && found.iter().all(|code| code == "not-understood"),
            "{found:?}"
        );
    }
    // After a comment sign it is part of a comment.
    for post in ["linuxcnc", "grbl"] {
        assert_eq!(
            said(&program(post).replacen("G21", "G21 ; mm", 1)),
            [""; 0],
            "{post}"
        );
    }
}

/// Blanks that no control accepts, and characters that may end a line: they were read between words and in comments.
#[test]
fn what_no_control_takes_for_a_blank_was_one() {
    for post in crate::tests::controls::of_moves() {
        let text = program(post);
        let touch = text.lines().find(|line| {
            !line.starts_with(['(', ';'])
                && ["G38.2 ", "G31 ", "MEAS=1 "]
                    .iter()
                    .any(|code| line.contains(code))
        });
        let touch = touch.unwrap();
        let comment = text
            .lines()
            .find(|line| line.to_uppercase().contains("BLOCKS BELOW"))
            .unwrap();
        for blank in ["\u{b}", "\u{c}", "\0"] {
            for (old, new) in [
                (touch, touch.replacen(' ', blank, 1)),
                (touch, touch.replacen(' ', &format!(" {blank}"), 1)),
                (touch, format!("{touch}{blank}")),
                (touch, format!("{blank}{touch}")),
                (touch, format!("{touch}\n{blank}")),
                (comment, comment.replacen(' ', blank, 1)),
                (comment, format!("{comment}{blank}")),
            ] {
                let found = said(&text.replacen(old, &new, 1));
                assert_eq!(found, ["not-understood"], "{post} {new:?}");
            }
        }
        for blank in [
            "\u{a0}", "\u{2003}", "\u{85}", "\u{3000}", "\u{1a}", "\u{7f}",
        ] {
            for new in [
                touch.replacen(' ', blank, 1),
                format!("{touch}{blank}"),
                format!("{blank}{touch}"),
                format!("{touch}\n{blank}"),
            ] {
                let found = said(&text.replacen(touch, &new, 1));
                assert_eq!(found, ["not-understood"], "{post} {new:?}");
            }
        }
        assert_eq!(
            said(&text.replacen(touch, &touch.replace(' ', " \t "), 1)),
            [""; 0],
            "{post}"
        );
    }
    // Klartext has a separate reader.
    let own = with(
        &default_job("probing-two-circles").unwrap(),
        "control.post",
        Value::Text("heidenhain".to_owned()),
    );
    let text = planned(&with(&own, "control.form", Value::Text("cycle".to_owned())))
        .program
        .text;
    for blank in ["\u{b}", "\u{c}", "\0"] {
        for part in ["TCH PROBE", "; Made by", "END PGM"] {
            assert!(text.contains(part), "{part}");
            let found = said(&text.replacen(part, &part.replace(' ', blank), 1));
            assert_eq!(found, ["not-understood"], "{part} {blank:?}");
        }
    }
    // With such a blank LinuxCNC's interpreter reads another comment, and does not stop.
    let stop = "G21 G17 G90\nG0 X0 Y0 Z10\nG38.3 X5 F100\no1 if [#5070 NE 0]\n(\u{a0}ABORT,x)\no1 endif\nG1 X9\nM2\n";
    assert!(
        interpret_until_stop("G21\n(\u{a0}ABORT,x)\nG0 X1\nM2\n")
            .1
            .is_none()
    );
    assert_eq!(
        import(stop).unwrap().trace.unwrap().moves[1].kind,
        Kind::Unchecked
    );
}

/// Harmless lines that no generated program has do not invalidate the job.
#[test]
fn everyday_lines_of_other_hands_lose_nothing() {
    for post in ["fanuc", "haas"] {
        let text = program(post).replacen("M30\n", "G53 G0 Z0.\nM30\n", 1);
        let read = import(&text).unwrap();
        assert!(!matches!(read.job, Value::Null), "{post}");
        assert!(
            read.findings.iter().any(|f| f.code == "unsafe-program"),
            "{post}: {:?}",
            read.findings
        );
    }
}

/// It took time quadratic in the number of names.
#[test]
fn many_declared_names_are_read_at_once() {
    let names: String = (0..25_000).map(|i| format!("DEF INT V{i}\n")).collect();
    let sets: String = (0..100_000)
        .map(|i| format!("V{}=1\n", 24_999 - i % 9))
        .collect();
    let read = import(&format!(
        "{names}{sets}G0 X0 Y0 Z5\nMEAS=1 G1 Z0 F100\nM30\n"
    ))
    .unwrap();
    assert_eq!(read.trace.unwrap().moves.len(), 2);
}

/// A comment stops a program exactly where LinuxCNC's interpreter stops at it.
#[test]
fn a_comment_that_stops_nothing_was_taken_for_an_alarm() {
    let kind = |comment: &str| {
        let text = format!(
            "G21 G17 G90\nG0 X0 Y0 Z10\nG38.3 X5 F100\no1 if [#5070 NE 0]\n{comment}\no1 endif\nG1 X9\nM2\n"
        );
        import(&text).unwrap().trace.unwrap().moves[1].kind
    };
    for (comment, stops) in [
        ("(ABORT,x)", true),
        (";ABORT,x", false),
        ("; (ABORT,x)", false),
        ("(ABORT ,x)", false),
    ] {
        let (_, stopped) = interpret_until_stop(&format!("G21\n{comment}\nG0 X1\nM2\n"));
        assert_eq!(stopped.is_some(), stops, "{comment}: {stopped:?}");
        assert_eq!(
            kind(comment),
            if stops {
                Kind::Watched
            } else {
                Kind::Unchecked
            },
            "{comment}"
        );
    }
    // Python is executed after either sign.
    for comment in ["(py,x=1)", ";py,x=1", "(PYRUN,x.py)", "; pyreload"] {
        let error = import(&format!("G21\n#1=1\n{comment}\nG38.2 X#1 F100\nM2\n")).unwrap_err();
        assert_eq!(
            error.findings[0].code, "not-understood",
            "{comment}: {error}"
        );
    }
    let ran = interpret_until_stop("G21\n;py,raise Exception()\nM2\n").1;
    assert!(ran.is_some_and(|why| why.contains("Exception")));
    // The same in a program with a job in its header.
    let text = program("linuxcnc").replace("(ABORT,Contact", ";ABORT,Contact");
    let found = said(&text);
    assert!(
        found.contains(&"program-differs".to_owned())
            && found.contains(&"unsafe-program".to_owned()),
        "{found:?}"
    );
}

/// Variables of a subroutine were confused with those outside: numbers up to 30, names without `_`.
#[test]
fn a_subroutines_own_variables_are_not_those_outside() {
    let program = |before: &str, inside: &str| {
        format!(
            "G21 G17 G90\n{before}\no<a> sub\n{inside}\nG0 X[1+#1] Y[1+#2]\no<a> endsub\nG38.2 Z-5 F100\no<a> call [3]\nG0 Z[#2+1]\nM2\n"
        )
    };
    let read = |before: &str, inside: &str| import(&program(before, inside));
    // An argument that is not given is 0 inside, for any value outside.
    let text = program("#2=7", "#<_n>=1");
    let ran = interpret_until_stop(&text).0;
    let moves = import(&text).unwrap().trace.unwrap().moves;
    let [inside, after] = [ran.moves[1].to, ran.moves[2].to];
    assert_eq!((inside[0], inside[1], after[2]), (4.0, 1.0, 8.0));
    assert_eq!(
        (moves[1].to[0], moves[1].to[1], moves[2].to[2]),
        (Some(4.0), Some(1.0), Some(8.0))
    );
    for inside in [
        "#<h>=1",
        "#<H>=1",
        "#2=1",
        "#02=1",
        "#12=1",
        "G0 Z#12",
        "G0 Z[1+#<h>]",
        "(PRINT,h=#<h>)",
    ] {
        let error = read("#2=7", inside).unwrap_err();
        assert_eq!(
            error.findings[0].code, "not-understood",
            "{inside}: {error}"
        );
    }
}

/// Everything between the first bracket of a call and the last one of its line was ignored.
#[test]
fn a_call_of_a_sinumerik_ends_at_its_own_bracket() {
    let text = program("sinumerik");
    for (line, good) in [
        ("MSG()", true),
        ("MSG(\"A) B\"<<R90<<\", C;\")", true),
        ("MSG(R90)", true),
        ("MSG(\"\") G0 Z-50 MSG(\"\")", false),
        ("MSG() G0 Z-50 )", false),
        ("MSG(\"A)", false),
    ] {
        let found = said(&text.replacen("\nSTOPRE\n", &format!("\n{line}\nSTOPRE\n"), 1));
        assert_eq!(
            found.contains(&"not-understood".to_owned()),
            !good,
            "{line}: {found:?}"
        );
    }
    for alarm in ["SETAL(1)", "SETAL(650001)", "SETAL(65000,\"A\")"] {
        let found = said(&text.replacen("SETAL(65000)", alarm, 1));
        assert_eq!(found, ["not-understood"], "{alarm}");
    }
    let own = with(
        &default_job("internal-rectangle-protected").unwrap(),
        "control.post",
        Value::Text("sinumerik".to_owned()),
    );
    let cycle = planned(&with(&own, "control.form", Value::Text("cycle".to_owned())))
        .program
        .text;
    assert_eq!(said(&cycle), [""; 0]);
    let (head, _) = cycle.split_once("CYCLE977(").unwrap();
    let call = cycle[head.len()..].lines().next().unwrap();
    let moved = format!("{}) G0 Z=-(50)", &call[..call.len() - 1]);
    assert_eq!(said(&cycle.replacen(call, &moved, 1)), ["not-understood"]);
}

/// AND binds tighter than a comparison on a Fanuc and a SINUMERIK: without brackets it combines the bits of numbers. It was read as a condition.
#[test]
fn and_beside_a_comparison_needs_brackets() {
    for (condition, good) in [
        ("1 EQ 1 AND 2 EQ 2", false),
        ("[1 EQ 1] AND 2 EQ 2", false),
        ("1 EQ 1 OR [2 EQ 2]", false),
        ("1 AND 3", false),
        ("[1 EQ 1] AND [2 EQ 2]", true),
        ("[1 EQ 1] OR [2 EQ 3] AND [2 EQ 2]", true),
    ] {
        let fanuc = format!("IF [{condition}] GOTO 77\nG0 X5.\nN77\nG31 X1. F100.\nM30\n");
        let signs = condition
            .replace("EQ", "==")
            .replace('[', "(")
            .replace(']', ")");
        let sinumerik = format!("IF {signs} GOTOF A\nG0 X5\nA:\nMEAS=1 G1 X1 F100\nM30\n");
        for text in [fanuc, sinumerik] {
            let read = import(&text);
            assert_eq!(read.is_ok(), good, "{text}");
            match read {
                Ok(read) => assert_eq!(read.trace.unwrap().moves.len(), 1, "{text}"),
                Err(error) => assert_eq!(error.findings[0].code, "not-understood", "{error}"),
            }
        }
    }
}

/// Found by the fuzzer: a program that writes and ends before it has results has no values to run the rest with.
#[test]
fn a_program_that_writes_before_its_results_was_a_panic() {
    for (post, writes) in [
        ("linuxcnc", "G10"),
        ("sinumerik", "$P_UIFR"),
        ("fanuc", "#5221="),
        ("haas", "#5221="),
    ] {
        let job = default_job("internal-rectangle-protected").unwrap();
        let job = with(
            &with(&job, "control.post", Value::Text(post.to_owned())),
            "control.workOffset",
            Value::Number(1.0),
        );
        let text = planned(&job).program.text;
        let lines: Vec<&str> = text.lines().collect();
        let first = lines.iter().position(|line| line.starts_with('G')).unwrap();
        let write = lines.iter().find(|line| line.starts_with(writes)).unwrap();
        for at in (first..lines.len() - 1).step_by(7) {
            let cut = [&lines[..at], &[write, "M30"], &lines[at..]]
                .concat()
                .join("\n")
                + "\n";
            assert_ne!(said(&cut), [""; 0], "{post} line {at}");
        }
    }
}

/// A residual was allowed a thousandth of a millimetre for any size of the part.
#[test]
fn a_residual_that_is_off_by_half_a_micrometre_is_not_proven() {
    let boss = with(
        &default_job("boss").unwrap(),
        "control.post",
        Value::Text("fanuc".to_owned()),
    );
    let text = planned(&boss).program.text;
    let last = text.lines().find(|line| line.starts_with("#104=")).unwrap();
    assert_eq!(said(&text), [""; 0]);
    for more in ["+0.0005", "-0.0005", "*1.001"] {
        assert_ne!(
            said(&text.replacen(last, &format!("{last}{more}"), 1)),
            [""; 0],
            "{last}{more}"
        );
    }
}

/// Touches hundreds of millimetres apart: the root of their scatter is compared within the rounding of sums of that size.
#[test]
fn a_corner_with_a_long_wall_was_not_proven() {
    let job = job(
        r#"{ "format": 1, "plane": "G18", "cycle": { "type": "double-wall-internal-corner", "clearance1": 50.499210021065,
        "count2": 3, "step1": 343, "step2": 244, "feedDistance": 262 } }"#,
    );
    assert!(planned(&job).program.proof.is_some());
}
