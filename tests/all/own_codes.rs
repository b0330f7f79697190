//! Codes that are no moves, and texts that are read literally: never a move that is not in the text.

use crate::common::with;
use touchpath::form::Value;
use touchpath::import::toolpath::KINDS;
use touchpath::import::{Toolpath, import, read_program};

/// Moves of a line, counted from 1: kind and end of each.
fn on(path: &Toolpath, line: u32) -> Vec<(&'static str, [f64; 3])> {
    let moves = (0..path.len()).filter(|i| path.line[*i] + 1 == line);
    moves
        .map(|i| (KINDS[usize::from(path.kind[i])], path.end(i).to_array()))
        .collect()
}

fn messages(path: &Toolpath) -> String {
    path.findings
        .iter()
        .map(|f| format!("{}: {}\n", f.code, f.message))
        .collect()
}

/// Codes with which X and Y are a position, from the manuals: LinuxCNC, Fanuc, Haas.
const PLACES: [&str; 77] = [
    "0", "1", "2", "3", "5", "5.1", "7", "8", "9", "13.1", "15", "17", "18", "19", "20", "21",
    "31", "31.1", "31.2", "31.3", "31.4", "31.5", "31.6", "31.7", "31.8", "31.9", "32", "33",
    "38.2", "38.3", "38.4", "38.5", "38.6", "38.7", "38.8", "38.9", "40", "40.1", "41", "41.1",
    "42", "42.1", "43", "43.4", "43.5", "44", "45", "46", "47", "48", "49", "54", "54.1", "55",
    "56", "57", "58", "59", "59.1", "59.2", "59.3", "61", "61.1", "62", "63", "64", "67", "69",
    "80", "90", "90.1", "91", "91.1", "94", "96", "97", "98",
];
/// More of them: the end of a spline, inverse time, feed per revolution, a Haas's offsets.
const MORE_PLACES: [&str; 27] = [
    "5.3", "6.3", "93", "95", "99", "110", "111", "112", "113", "114", "115", "116", "117", "118",
    "119", "120", "121", "122", "123", "124", "125", "126", "127", "128", "129", "154", "4",
];
/// Known codes whose X and Y are no position: their effect is reported, or they have none that is drawn.
const KNOWN: [&str; 45] = [
    "5.2", "6.2", "10", "12", "12.1", "13", "16", "28", "30", "33.1", "43.1", "43.2", "50", "50.1",
    "51", "51.1", "52", "53", "65", "66", "66.1", "68", "68.2", "68.3", "68.4", "73", "74", "75",
    "76", "81", "82", "83", "84", "85", "86", "87", "88", "89", "92", "92.1", "92.2", "92.3",
    "150", "-", "-",
];
/// The same for a SINUMERIK.
const PLACES_840D: [&str; 46] = [
    "0", "1", "2", "3", "4", "9", "17", "18", "19", "33", "34", "35", "38.2", "38.3", "38.4",
    "38.5", "38.6", "38.7", "38.8", "38.9", "40", "41", "42", "54", "55", "56", "57", "60", "61",
    "62", "63", "64", "70", "71", "90", "90.1", "91", "91.1", "93", "94", "95", "96", "97", "80",
    "331", "332",
];
const MORE_840D: [&str; 19] = [
    "450", "451", "500", "601", "602", "603", "641", "642", "643", "644", "645", "700", "710",
    "961", "962", "971", "972", "973", "-",
];
const KNOWN_840D: [&str; 12] = [
    "10", "25", "26", "53", "58", "59", "74", "75", "110", "111", "112", "153",
];

/// Decimals to try with a code: all below 1000, where makers use them; above, none and one.
fn tenths(number: u32) -> impl Iterator<Item = u32> {
    (0..=9).filter(move |tenth| number < 1000 || *tenth == number % 10 || *tenth == 0)
}

/// Every possible code, before and after positions, in both dialects.
#[test]
fn a_code_that_is_not_known_makes_no_place_of_its_words() {
    let mut checked = 0;
    for dialect in ["iso", "sinumerik"] {
        for number in 0..=9999 {
            for tenth in tenths(number) {
                let code = if tenth == 0 {
                    number.to_string()
                } else {
                    format!("{number}.{tenth}")
                };
                let own =
                    |lists: &[&[&str]]| lists.iter().any(|list| list.contains(&code.as_str()));
                let offset = dialect == "sinumerik" && tenth == 0 && (505..=599).contains(&number);
                // Cycles with a decimal stay cycles.
                let cycle = dialect == "iso" && (81..=88).contains(&number);
                let (place, known) = match dialect {
                    "iso" => (own(&[&PLACES, &MORE_PLACES]), own(&[&KNOWN]) || cycle),
                    _ => (
                        own(&[&PLACES_840D, &MORE_840D]) || offset,
                        own(&[&KNOWN_840D]),
                    ),
                };
                if place {
                    continue;
                }
                let text = format!(
                    "G90\nG1 F50 X1 Y2 Z3\nG{code} X7 Y8\nG1 Z9\nG1 X1 Y2\nX7 Y8 G{code}\nG1 Z9\n"
                );
                let path = read_program(&text, Some(dialect));
                for line in [3, 6] {
                    let drawn = on(&path, line);
                    assert!(
                        drawn.iter().all(|(_, to)| to[0].is_nan() && to[1].is_nan()),
                        "{dialect} G{code}: {drawn:?}"
                    );
                }
                if !known {
                    for line in [4, 7] {
                        let [(_, to)] = on(&path, line)[..] else {
                            panic!("{dialect} G{code}: one move in line {line}")
                        };
                        assert!(
                            to[0].is_nan() && to[1].is_nan() && to[2] == 9.0,
                            "{dialect} G{code}: {to:?}"
                        );
                    }
                    let said = messages(&path);
                    let named = format!("lines-skipped: G{code} ");
                    assert!(
                        said.contains(&named) && said.contains("2 times, the first in line 3"),
                        "{dialect} G{code}: {said}"
                    );
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 38_000, "{checked}");
}

/// The same for M codes: leading ones may have any effect, those after a motion belong to the machine.
#[test]
fn an_m_code_in_front_of_places_makes_none_of_them() {
    // Stops, spindle, tool, coolant, clamps, overrides, inputs and outputs, modes.
    let plain: &[&[u32]] = &[
        &[
            0, 1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 19, 50, 51, 52, 53,
        ],
        &[60, 61, 62, 63, 64, 65, 66, 67, 68, 70, 71, 72, 73],
    ];
    for dialect in ["iso", "sinumerik"] {
        for number in 0..=9999u32 {
            // Ends and calls have separate tests.
            if matches!(number, 2 | 17 | 30 | 97 | 98 | 99 | 198) {
                continue;
            }
            let gears = dialect == "sinumerik" && (40..=45).contains(&number);
            for tenth in tenths(number) {
                let code = if tenth == 0 {
                    format!("M{number}")
                } else {
                    format!("M{number}.{tenth}")
                };
                let known =
                    tenth == 0 && (plain.iter().any(|list| list.contains(&number)) || gears);
                let text = format!(
                    "G90\nG1 F50 X1 Y2 Z3\n{code} X7 Y8\nG1 Z9\nG1 X1 Y2 Z4\nX7 Y8 {code}\nG1 Z9\n{code} G1 X5\n"
                );
                let path = read_program(&text, Some(dialect));
                let (before, behind) = (on(&path, 3), on(&path, 6));
                // A SINUMERIK's new tool has another length.
                let tool = dialect == "sinumerik" && code == "M6";
                let [(kind, to)] = behind[..] else {
                    panic!("{dialect} {code}: {behind:?}")
                };
                let level = if tool { to[2].is_nan() } else { to[2] == 4.0 };
                assert!(
                    kind == "feed" && to[..2] == [7.0, 8.0] && level,
                    "{dialect} {code}: {to:?}"
                );
                assert_eq!(on(&path, 8)[0].1[0], 5.0, "{dialect} {code}");
                if known {
                    assert!(
                        before.len() == 1 && before[0].1[..2] == [7.0, 8.0],
                        "{dialect} {code}: {before:?}"
                    );
                    continue;
                }
                assert!(before.is_empty(), "{dialect} {code}: {before:?}");
                let after = on(&path, 4)[0].1;
                assert!(
                    after[0].is_nan() && after[1].is_nan() && after[2] == 9.0,
                    "{dialect} {code}: {after:?}"
                );
                let said = messages(&path);
                assert!(
                    said.contains(&format!("lines-skipped: {code} "))
                        && said.contains("once, in line 3"),
                    "{dialect} {code}: {said}"
                );
            }
        }
    }
}

#[test]
fn of_very_many_codes_the_first_are_named() {
    let many: String = (600..700).map(|code| format!("G{code} X1\n")).collect();
    let said = read_program(&format!("G21\nG0 X0\n{many}"), None).findings;
    assert!(
        said.len() < 20 && said.iter().any(|f| f.message.contains("88 times")),
        "{said:?}"
    );
}

/// Control points were drawn as cuts; so were the positions of other curves.
#[test]
fn control_points_of_a_spline_are_no_moves() {
    for (begin, end, dialect) in [
        ("G5.2 P1 L3", "G5.3", "iso"),
        ("G6.2 Q1", "G6.3", "iso"),
        ("BSPLINE", "G1", "sinumerik"),
        ("CSPLINE X1 Y1", "G1", "sinumerik"),
        ("N7 POLY PO[X]=(1,2)", "G1", "sinumerik"),
        ("CIP X4 Y4 I1=2", "G1", "sinumerik"),
    ] {
        let path = read_program(
            &format!("G90\nG1 X0 Y0 Z2 F90\n{begin}\nX4 Y2 P1\nX6 Y9 P2\n{end}\nG1 Z1\nX3\n"),
            Some(dialect),
        );
        assert_eq!((on(&path, 4).len(), on(&path, 5).len()), (0, 0), "{begin}");
        let after = on(&path, 7)[0].1;
        assert!(
            after[0].is_nan() && after[1].is_nan() && after[2] == 1.0,
            "{begin}: {after:?}"
        );
        assert_eq!(on(&path, 8)[0].1[0], 3.0, "{begin}");
        assert!(
            path.findings.iter().any(|f| f.code == "arc-unsolved"),
            "{begin}: {}",
            messages(&path)
        );
    }
}

/// A Haas has offsets beyond G59; a selection before any move is the first one.
#[test]
fn other_work_offsets_of_a_haas_were_unsaid() {
    let codes = |text: &str| {
        read_program(text, None)
            .findings
            .iter()
            .any(|f| f.code == "places-transformed")
    };
    for code in (110..=129).chain([154]) {
        let code = format!("G{code}{}", if code == 154 { " P3" } else { "" });
        assert!(
            codes(&format!("G21 G90\nG54 G0 X0 Y0\n{code} G0 X15\n")),
            "{code}"
        );
        if code != "G112" {
            assert!(
                !codes(&format!("G21 G90\n{code}\nG0 X0 Y0\n{code} X15\n")),
                "{code}"
            );
        }
    }
    assert!(!codes("G21 G54\nG110\nG0 X1\n") && codes("G21\nG0 X1\nG110\nX2\n"));
}

/// Other makers assign as well, and a text may contain anything.
#[test]
fn an_assigned_axis_alone_is_no_sinumerik() {
    for (text, dialect) in [
        ("G21\nG0 X1\nZ=VC1\n", "iso"),
        ("G21\nG0 Z=5\n", "iso"),
        ("M4000 P0 R3 S\"CR=0 T=1\"\nG21\nG1 X5\n", "iso"),
        ("G21\nR1=5\nG31 X5 F100\n", "iso"),
        ("G21\nCR=5\n#<a>=1\n", "iso"),
        ("G71\nG0 X=5\n", "sinumerik"),
        ("N5 G710 G90\nN6 G0 Z=R1\n", "sinumerik"),
        ("G2 X5 Y5 CR=5\n", "sinumerik"),
        ("G0 X=AC(5)\n", "sinumerik"),
        ("T=\"PROBE\"\nM6\nG0 X5\n", "sinumerik"),
        ("G31 X5\nSTOPRE\nG1 X5\n", "sinumerik"),
    ] {
        assert_eq!(read_program(text, None).dialect, dialect, "{text}");
    }
}

/// Nothing was read, and nothing was reported.
#[test]
fn a_text_without_moves_says_so() {
    let no_moves = |text: &str| {
        read_program(text, None)
            .findings
            .into_iter()
            .find(|f| f.code == "no-moves")
            .map(|f| f.message)
    };
    for text in [
        "",
        "G6500\n",
        "hello\n",
        "G21 ; mm\nM2\n",
        "0 BEGIN PGM A MM\n",
        ";G1 X5\n",
        "G21 ; G1 is not here\n",
    ] {
        let said = no_moves(text).unwrap_or_else(|| panic!("{text:?}"));
        assert_eq!(
            said.contains("semicolon"),
            text.contains("G21 ; G1"),
            "{text:?}"
        );
    }
    assert_eq!(no_moves("G21\nG0 X5\n"), None);
}

/// After a call of a subprogram that cannot be followed, positions are unknown, and no call runs forever.
#[test]
fn a_subprogram_that_cannot_be_followed_leaves_nothing_known() {
    // If it is missing, repeated, endless, or called with computed values, positions after it are unknown.
    for text in [
        "M98 P100\nG0 Z9\nM30\n",
        "M98 P100\nG0 Z9\nM30\nO100\nM99\nO100\nM99\n",
        "M98 P#1\nG0 Z9\nM30\nO1\nX5\nM99\n",
        "M98 P100\nG0 Z9\nM30\nO100\nX5\nO200\nM99\n",
        "M98 P100\nG0 Z9\nM30\nO100\nX5\n",
        "M98 P100 L0\nG0 Z9\nM30\nO100\nX5\nM99\n",
        "M198 P100\nG0 Z9\nM30\nO100\nX5\nM99\n",
    ] {
        let path = read_program(&format!("G21 G90\nG0 X1 Y2 Z3\n{text}"), None);
        let after = on(&path, 4);
        assert!(
            after.len() == 1 && after[0].1[0].is_nan() && after[0].1[2] == 9.0,
            "{text}: {after:?}"
        );
        assert!(
            path.findings.iter().any(|f| f.code == "lines-skipped"),
            "{text}"
        );
    }
    // Recursion ends, and so do endless repetitions.
    for text in [
        "M98 P5\nM30\nO5\nG91 G1 X1 F10\nM98 P5\nM99\n",
        "M98 P5 L9999\nM30\nO5\nX1\nM98 P6 L9999\nM99\nO6\nY1\nM98 P7 L9999\nM99\nO7\nZ1\nM99\n",
    ] {
        let path = read_program(&format!("G21 G90\nG0 X1 Y1\n{text}"), None);
        assert!(
            path.len() < 600_000 && path.findings.iter().any(|f| f.code == "lines-skipped"),
            "{text}"
        );
    }
}

/// An obstacle to the moves of a header's job stays refused.
#[test]
fn a_job_whose_program_has_a_code_of_another_maker_is_refused() {
    let job = with(
        &touchpath::job::default_job("hole").unwrap(),
        "control.post",
        Value::Text("linuxcnc".to_owned()),
    );
    let text = touchpath::job::plan(&job).unwrap().program.text.replacen(
        "M2\n",
        "M463 X-12 Y-12\nM2\n",
        1,
    );
    assert!(
        import(&text)
            .unwrap_err()
            .findings
            .iter()
            .any(|f| f.code == "not-understood")
    );
}
