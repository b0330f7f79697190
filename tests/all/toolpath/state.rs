//! State that carries over from block to block, and early returns.

use super::*;
/// G53 alone only stops look-ahead on some controls; it was reported as a move to a machine position.
#[test]
fn a_code_of_the_machines_system_without_places_goes_nowhere() {
    let codes = |text: &str| -> Vec<String> {
        read_program(text, None)
            .findings
            .into_iter()
            .map(|f| f.code)
            .collect()
    };
    let program = |code: &str| format!("G21 G90\nG0 X0 Y0 Z5\n{code}\nG31 Z0 F100\nM30\n");
    assert!(!codes(&program("G53")).contains(&"machine-places".to_owned()));
    for code in ["G53 G0 Z0", "G28", "G28 Z0"] {
        assert!(
            codes(&program(code)).contains(&"machine-places".to_owned()),
            "{code}"
        );
    }
}

/// A program below `G21 G90 F100`, `G0 X10 Y0 Z20`: its last move ends like the interpreter's, with its feed, except for unknown values (axes, and F for the
/// feed), and has these findings.
fn ends_as_interpreted(cases: &[(&str, &str, &[&str])]) {
    for (text, unknown, wanted) in cases {
        let text = format!("G21 G90 F100\nG0 X10 Y0 Z20\n{text}\nM2\n");
        let ran = interpret(&text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        let path = read_program(&text, Some("iso"));
        let (last, true_last) = (
            path.end(path.len() - 1).to_array(),
            ran.moves.last().expect("a move"),
        );
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let right = if unknown.contains(name) {
                last[axis].is_nan()
            } else {
                (last[axis] - true_last.to[axis]).abs() < 1e-3
            };
            assert!(right, "{text}{name}: {last:?}, truly {:?}", true_last.to);
        }
        let feed = path.feed[path.len() - 1];
        let right = if unknown.contains('F') || true_last.kind == "rapid" {
            feed.is_nan()
        } else {
            feed == true_last.feed
        };
        assert!(right, "{text}feed {feed}, truly {}", true_last.feed);
        assert_eq!(said(&path), *wanted, "{text}");
    }
}

/// Positions, modes and feeds after unfollowed lines kept their earlier values.
#[test]
fn nothing_stale_stays_after_a_line_that_is_not_followed() {
    ends_as_interpreted(&[
        ("#1=5 G91 G1 X7\nG1 Y1", "", &[]),
        ("#1=[3+4]G91G1Z7\nG1 Y1", "", &[]),
        ("#<x1>=5 (X5 G91)\nG1 Y1", "", &[]),
        ("#1 = 5 F83\nG1 Y1", "", &[]),
        ("G1 XSIN[30]\nY1", "", &[]),
        ("G1 X#5063\nY1", "X", &["places-computed"]),
        ("G1 XSIN[#5063]\nY1", "X", &["places-computed"]),
        ("ZATAN[1]/[2]\nG1 Y1", "", &[]),
        ("G1 FSQRT[49] Y1", "", &[]),
        ("G1 FSQRT[#5063+49] Y1", "F", &[]),
        ("G1 @5 ^30\nZ1", "XY", &["places-computed"]),
        ("G1 @5^30Z1", "XY", &["places-computed"]),
        ("G1 @5 ^30\nG1 X1 Y2", "", &["places-computed"]),
        ("F1 00\nG1 Y1", "F", &["lines-skipped"]),
        ("G1 Y1 X1 0 F70\nY2", "X", &["lines-skipped"]),
    ]);
}

/// The body of a subroutine was read as moves if its O words followed a number or a slash.
#[test]
fn an_o_word_may_stand_behind_a_number() {
    ends_as_interpreted(&[
        ("N5 o100 sub\nG1 X77\nN6 o100 endsub\nG1 X1", "", &[]),
        ("/o100 sub\nG1 X77\n/ N6 O100 endsub\nG1 X1", "", &[]),
        (
            "n5o<s>sub\nG1 X77\nN6 o<s> endsub\nG1 X1\nN7 o<s> call\nG1 X2 Y3",
            "",
            &[],
        ),
        ("N5 o1 if [0]\nM2\nN6 o1 endif\nG1 X5", "", &[]),
        ("G1 Y5\n/N5\nN6.5\nX4", "", &[]),
    ]);
}

/// A tool with another length is at another position, which was read unchanged.
#[test]
fn a_tools_length_changes_places() {
    let computed: &[&str] = &["places-computed"];
    ends_as_interpreted(&[
        ("G43.1 Z50\nG0 X5", "Z", computed),
        ("G43.1 Z50\nG0 X5\nY3\nZ4", "", computed),
        ("G43.1 X3\nG0 Z5", "X", computed),
        ("G43.1 X3\nG0 X5\nG49\nZ6", "", &[]),
        ("G43.1 Z50\nG0 X5 Z3", "", &[]),
        ("G43.1 X50\nG0 X0\nG49 G0 Z3", "", &[]),
        ("T1 M6\nG43 H1 Z50", "", &[]),
        ("T1 M6\nG0 X3", "", &[]),
        ("T1 M6\nG43 H1\nG0 X3", "Z", computed),
        ("G43 H1\nG49\nG0 X3", "Z", computed),
        ("G4 P0\nM70\nG43.1 Z5\nG0 Z3\nM72\nX5", "Z", computed),
    ]);
}

/// M70 and M73 save the modes, M72 restores them.
#[test]
fn modes_are_kept_and_given_back() {
    ends_as_interpreted(&[
        ("M70\nG91\nG0 X5\nM72\nX5", "", &[]),
        ("M73\nG91\nM72\nG91\nM72\nX5\nX5", "", &[]),
        ("G91 M70\nG90\nM72\nX5\nX5", "", &[]),
        ("M70 G91\nX5\nM72 G91\nX5", "", &[]),
        ("M70\nG20 F10 G1 X1\nM72\nG1 X5", "", &[]),
        ("M70 F50\nF60\nM72 F30\nG1 X5", "", &[]),
        ("M70\nG1 X5\nM72\nX6", "", &[]),
        ("M70\nG93\nM72\nG1 X6 F7", "", &[]),
    ]);
}

/// The feed of a block without motion was lost, and so was a position beside the time of a dwell.
#[test]
fn feeds_and_places_of_blocks_that_are_left_early_stay() {
    ends_as_interpreted(&[
        ("G43.1 Z0 F83\nG1 X5 Z5", "", &[]),
        ("G4 P.01 F35\nG1 X5", "", &[]),
        ("G10 L1 P1 Z0 F36\nG1 X5", "", &[]),
        ("G92 X10 F33\nG1 X5", "", &[]),
        ("G52 X0 F44\nG1 X5", "", &[]),
        ("G4 P0.1 X7", "", &[]),
        ("G1 Y1\nG4 P0.1 X7 F83", "", &[]),
    ]);
}

/// P was not read in an arc: its full turns were lost.
#[test]
fn an_arc_turns_as_often_as_p_says() {
    for (arc, sweep) in [
        ("G2 X-10 I-10 P3", -900.0),
        ("G3 X-10 I-10 P1", 180.0),
        ("G3 X0 Y10 R10 P2", 450.0),
        ("G2 X10 Y0 I-10 P2", -720.0),
        ("G3 Z21 I-26 J-9 P2", 720.0),
    ] {
        let text = format!("G21 G90 F100\nG0 X10 Y0 Z0\n{arc}\nM2\n");
        let turns = crate::common::canonical(&text).iter().find_map(|line| {
            let (_, rest) = line.split_once("ARC_FEED(")?;
            rest.split(", ").nth(4)?.parse::<f64>().ok()
        });
        let path = read_program(&text, None);
        assert!(
            (path.arcs[0][4] - sweep).abs() < 1e-9,
            "{arc}: {:?}",
            path.arcs
        );
        assert_eq!(
            turns,
            Some((sweep / 360.0).abs().ceil().copysign(sweep)),
            "{arc}"
        );
    }
    // The number of turns is unknown, or too large to draw.
    for arc in ["G2 X-10 I-10 P#5", "G2 X-10 I-10 P1000000000"] {
        let path = read_program(&format!("G21 G90 F100\nG0 X10 Y0 Z0\n{arc}\n"), None);
        assert_eq!(
            (path.arcs.len(), said(&path)),
            (0, vec!["arc-unsolved"]),
            "{arc}"
        );
    }
}

/// Rotations of the system and the tool radius were not reported; a diameter was read as a position.
#[test]
fn rotations_diameters_and_radii_are_not_passed_over() {
    ends_as_interpreted(&[
        ("G7 X30\nG1 X5", "", &[]),
        ("G7\nG91 X3\nG8 X3", "", &[]),
        ("G7\nG0 X30\nG2 X30 I5\nG1 Y3", "", &[]),
        ("M70\nG7\nG0 X30\nM72\nX7", "", &[]),
        ("G10 L1 P1 R90\nG0 Z5", "", &[]),
    ]);
    for code in [
        "G10 L2 P1 R90",
        "G10 L[1+1] P1 X7",
        "G10 L2 P1 R#5",
        "G41 D1",
        "G42 X5 D1",
        "G41.1 D6",
        "G42.1 D6",
    ] {
        let path = read_program(&format!("G21 G90\nG0 X1 Y2 Z3\n{code}\nG1 X5 F100\n"), None);
        assert_eq!(said(&path), ["places-transformed"], "{code}");
    }
}

/// A loop was read once, and incremental moves in its body were reported as after one round.
#[test]
fn a_loop_leaves_its_incremental_moves_somewhere() {
    ends_as_interpreted(&[
        ("o1 repeat [3]\nG91 G1 X5\no1 endrepeat\nG90 Y3", "", &[]),
        (
            "#1=0\no1 while [#1 LT 3]\nG91 G1 X5\nG90 Y7\n#1=[#1+1]\no1 endwhile\nZ3",
            "",
            &[],
        ),
        (
            "#1=0\no1 do\nG91 G1 X5\n#1=[#1+1]\no1 while [#1 LT 3]\nG90 Y3",
            "",
            &[],
        ),
        (
            "#1=0\nG91 G1 X5\nG90\no1 while [#1 LT 3]\nY7\n#1=[#1+1]\no1 endwhile\nZ3",
            "",
            &[],
        ),
        (
            "o1 repeat [2]\nG91 G1 X5\nG90\no2 repeat [2]\nG91 Y5\nG90\no2 endrepeat\nG91 Z1\nG90\no1 endrepeat\nZ3",
            "",
            &[],
        ),
        (
            "o1 repeat [2]\nG91 G1 X5\nG90 X3\no1 endrepeat\nG1 Y6",
            "",
            &[],
        ),
    ]);
    let unknown = |text: &str, dialect: &'static str| {
        let path = read_program(&format!("G90\nG1 X1 Y1 Z1 F100\n{text}\n"), Some(dialect));
        ["X", "Y", "Z"]
            .into_iter()
            .zip(path.end(path.len() - 1).to_array())
            .filter(|(_, x)| x.is_nan())
            .map(|(name, _)| name)
            .collect::<String>()
    };
    let body = "G91\nX5\nG90\nY4";
    for (begin, end, dialect) in [
        ("WHILE [#1 LT 3] DO1", "END1", "iso"),
        ("N5 WHILE R1<3", "N6 ENDWHILE", "sinumerik"),
        ("FOR R1=1 TO 3", "ENDFOR", "sinumerik"),
        ("LOOP", "ENDLOOP", "sinumerik"),
        ("REPEAT", "UNTIL R1>3", "sinumerik"),
        ("o1 do", "o1 while [#1 LT 3]", "iso"),
    ] {
        assert_eq!(
            unknown(&format!("{begin}\n{body}\n{end}\nY6"), dialect),
            "X",
            "{begin}"
        );
        let (inner, ends) = (
            begin.replace("o1", "o2").replace("DO1", "DO2"),
            end.replace("o1", "o2").replace("END1", "END2"),
        );
        assert_eq!(
            unknown(
                &format!("{begin}\nG91\nX5\nG90\n{inner}\nZ4\n{ends}\n{body}\n{end}\nZ6"),
                dialect
            ),
            "X",
            "{begin}"
        );
    }
}

/// With block skip on, an end with a slash is omitted: the lines below it are drawn.
#[test]
fn an_end_that_may_be_left_out_ends_nothing() {
    for end in ["/M30", "/M99", "/ M2"] {
        let path = read_program(&format!("G21 G0 X0 Y0 Z0\n{end}\nG0 X5\nM30\n"), None);
        assert_eq!(places(&path).len(), 2, "{end}");
        assert!(
            said(&path).contains(&"lines-optional"),
            "{end}: {:?}",
            said(&path)
        );
    }
}
