//! Blocks of plain words have a fast reader. A comment after such a block does not change its meaning, but has it read word by word: both must agree.

use super::read_program;
use crate::common::{Draws, with_comments};
use touchpath::import::toolpath::DIALECTS;

/// Parts of blocks: plain words much more often than words that change their meaning.
const PLAIN: [&str; 19] = [
    "G0", "G1", "G01", "g00", "G1.", "G38.2", "G38.3", "X1.5", "Y-2", "Z+.25", "x3", "F100",
    "f250.5", "X 4", "G2", "X0Y0", "N10", "N20 /", "Z-0",
];
const OTHER: [&str; 49] = [
    "G91",
    "G90",
    "G20",
    "G21",
    "G18",
    "G81 R2",
    "G80",
    "G3 I1 J2",
    "G53",
    "G54",
    "G55",
    "G92 X1",
    "G10 L2 P1 X3",
    "G43 H1",
    "G7",
    "G8",
    "G93",
    "G94",
    "M70",
    "M72",
    "G5.2",
    "/",
    "A10",
    "U1",
    "#1=5",
    "X#1",
    "IF [#1 EQ 2] GOTO 5",
    "G31 Z-1",
    "M6 T2",
    "G999",
    "IF R1==2 GOTOF END",
    "M30",
    "G68 R10 &",
    "G51 &",
    "O100 sub",
    "O100 endsub",
    "o<a> call",
    "M98 P5",
    "M99",
    "WHILE [#1 LT 2] DO1",
    "END1",
    "REPEAT",
    "N5",
    "%",
    "M98 P200",
    "O200",
    "(x)",
    "%A G71 *",
    "G01 X+5 *",
];

#[test]
fn a_block_of_plain_words_is_what_it_is_word_by_word() {
    let mut draws = Draws(0x9E37_79B9);
    let mut plain = 0;
    for round in 0..1500 {
        let mut text = String::new();
        for _ in 0..25 {
            if draws.below(14) == 0 {
                text.push_str(OTHER[draws.below(OTHER.len())]);
                text.push_str(["", " ", "\n"][draws.below(3)]);
            }
            for _ in 0..draws.below(5) {
                text.push_str(PLAIN[draws.below(PLAIN.len())]);
                text.push_str(["", " ", "\t"][draws.below(3)]);
            }
            text.push('\n');
        }
        let slow = with_comments(&text);
        plain += slow.matches(';').count();
        let dialect = Some(DIALECTS[round % 2]);
        let (fast, slow) = (read_program(&text, dialect), read_program(&slow, dialect));
        assert_eq!(format!("{fast:?}"), format!("{slow:?}"), "{text}");
    }
    assert!(plain > 20_000, "{plain} plain blocks");
}

/// Blocks that are nearly plain, among lines of any control.
#[test]
fn random_signs_among_lines_are_what_they_are_word_by_word() {
    let mut draws = Draws(0xABCDEF);
    let signs = b"0123456789 .+-/NGXYZFn\t";
    let lines = [
        "G91",
        "G1 X1",
        "M30",
        "L1 X1 Y2 F100",
        "BEGIN PGM A MM",
        "* - x",
        "(a)",
        "; x",
        "%",
        "O1",
        "#1=3",
        "G38.2 Z-1 F10",
        "12 L X+5",
        "TOOL CALL 5",
        "G53",
    ];
    for round in 0..6000 {
        let mut text = String::new();
        for _ in 0..6 {
            if draws.below(2) == 0 {
                text.push_str(lines[draws.below(lines.len())]);
            } else {
                for _ in 0..draws.below(9) {
                    text.push(signs[draws.below(signs.len())] as char);
                }
            }
            text.push('\n');
        }
        let slow = with_comments(&text);
        let dialect = Some(DIALECTS[round % 3]);
        let (fast, slow) = (read_program(&text, dialect), read_program(&slow, dialect));
        assert_eq!(
            format!("{fast:?}"),
            format!("{slow:?}"),
            "{text} {dialect:?}"
        );
    }
}
