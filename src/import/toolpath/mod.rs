//! The moves of any program, as columns: a reader that follows words and nothing else. What has to be computed or jumped to is passed over, and
//! said. Nothing is proven of what it reads: that is for the readers of `control`, which refuse what they do not understand.
//!
//! G0 to G3, probing as `G38.n`, `G31`, `G31.n` and `MEAS=1 G1`, units, planes, absolute and incremental places, arcs by centre or radius.

mod block;
mod moves;
mod reader;
mod words;

use crate::control::iso::lines::{next_line, trimmed};
use crate::form::Finding;
use crate::geom::{Plane, Vec3};
use crate::job::JobError;
use block::{EMPTY, numbered};
use reader::Reader;

/// The longest program that is read, in UTF-16 units.
pub const LONGEST_PROGRAM: usize = 20_000_000;

/// Refuses a program of so many UTF-16 units.
pub fn too_long(units: usize) -> JobError {
    super::longer_than(LONGEST_PROGRAM, units)
}

/// What a move is, by its place in the column `kind`.
pub const KINDS: [&str; 3] = ["rapid", "feed", "probe"];
const RAPID: u8 = 0;
const FEED: u8 = 1;
const PROBE: u8 = 2;

/// The ways programs are written that this reader tells apart.
pub const DIALECTS: [&str; 2] = ["iso", "sinumerik"];

/// The moves of a program, column by column. Lengths are in the units that the program states first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Toolpath {
    /// Which of [`DIALECTS`] it was read as.
    pub dialect: &'static str,
    /// Whether its units are millimetres; none where it does not say.
    pub metric: Option<bool>,
    /// Where each move ends, three numbers a move. NaN along an axis whose place is not known.
    pub to: Vec<f64>,
    /// What each move is: a place in [`KINDS`].
    pub kind: Vec<u8>,
    /// The feed of each move, units per minute; NaN for a rapid, or where none was stated.
    pub feed: Vec<f64>,
    /// The 0-based line of each move.
    pub line: Vec<u32>,
    /// The arcs: index of the move, centre, degrees counter-clockwise seen against the axis of their plane, and that plane: 17, 18 or 19.
    pub arcs: Vec<[f64; 6]>,
    /// The plane that the program chose first.
    pub plane: Plane,
    /// What was passed over.
    pub findings: Vec<Finding>,
}

impl Toolpath {
    /// How many moves.
    pub fn len(&self) -> usize {
        self.kind.len()
    }

    /// Whether nothing moves.
    pub fn is_empty(&self) -> bool {
        self.kind.is_empty()
    }

    /// Where a move ends.
    pub fn end(&self, index: usize) -> Vec3 {
        Vec3::from_slice(&self.to[3 * index..3 * index + 3])
    }
}

/// Reads a program. `dialect` is one of [`DIALECTS`]; none is looked for in the text.
pub fn read_program(text: &str, dialect: Option<&'static str>) -> Toolpath {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let dialect = dialect.unwrap_or_else(|| guessed(text));
    let mut reader = Reader::new(text, dialect);
    let mut block = EMPTY;
    let (bytes, mut at) = (text.as_bytes(), 0);
    while at < bytes.len() {
        let end = memchr::memchr2(b'\n', b'\r', &bytes[at..]).map_or(bytes.len(), |length| at + length);
        let line = match &bytes[at..end] {
            line @ [first, .., last] if first.is_ascii_graphic() && last.is_ascii_graphic() => line,
            _ => text[at..end].trim().as_bytes(),
        };
        reader.read(line, &mut block);
        reader.line += 1;
        at = end + if bytes[end..].starts_with(b"\r\n") { 2 } else { 1 };
    }
    reader.finish()
}

/// What stands in programs of a SINUMERIK alone.
const SINUMERIK: [&str; 16] = [
    "X=", "Y=", "Z=", "MEAS=", "MEAW=", "GOTOF", "STOPRE", "$A_", "$AA_", "$AC_", "$P_", "$TC_", "DEF ", "CR=", "T=\"", "SPOS=",
];

/// Whether a line gives an R parameter a value: `R1=5`.
fn parameter(code: &str) -> bool {
    let value = code.strip_prefix('R').map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    value.is_some_and(|value| value.len() + 1 < code.len() && value.starts_with('='))
}

/// A SINUMERIK assigns with `=`, calls with `( )` and comments with `;` alone.
fn guessed(text: &str) -> &'static str {
    let mut rest = text;
    for _ in 0..2000 {
        if rest.is_empty() {
            break;
        }
        let line = trimmed(next_line(&mut rest)).as_bytes();
        // What an archive begins with.
        if line.starts_with(b"%_N_") || line.starts_with(b";$PATH=") {
            return DIALECTS[1];
        }
        let line = numbered(line);
        // Most lines begin with a G or an axis, and assign nothing.
        let begins =
            line.first().is_some_and(|b| matches!(b.to_ascii_uppercase(), b'C' | b'D' | b'I' | b'M' | b'S' | b'T' | b'R'));
        if matches!(line.first(), Some(b'(' | b'%' | b';' | b'O' | b'o' | b'#'))
            || !(begins || memchr::memchr2(b'=', b'$', line).is_some())
        {
            continue;
        }
        // A variable by its number is of no SINUMERIK, whatever the text around it: DPRNT[MEAS=#101[43]].
        if line.contains(&b'#') {
            continue;
        }
        // A comment may say anything.
        let code = line.split(|b| matches!(b, b';' | b'(')).next().unwrap_or_default();
        let code = String::from_utf8_lossy(code).to_ascii_uppercase();
        let called = line.get(code.len()) == Some(&b'(');
        if called && (code == "MSG" || code.starts_with("CYCLE"))
            || SINUMERIK.iter().any(|word| code.contains(word))
            || parameter(&code)
        {
            return DIALECTS[1];
        }
    }
    DIALECTS[0]
}
