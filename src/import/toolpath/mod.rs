//! The moves of any program, as columns: a reader that follows words and nothing else. What has to be computed or jumped to is passed over, and
//! said. Nothing is proven of what it reads: that is for the readers of `control`, which refuse what they do not understand.
//!
//! G0 to G3, probing as `G38.n`, `G31`, `G31.n` and `MEAS=1 G1`, units, planes, absolute and incremental places, arcs by centre or radius.

mod block;
mod calls;
mod count;
mod findings;
mod foreign;
mod guess;
mod heidenhain;
mod macros;
mod moves;
mod reader;
mod words;

use crate::control::iso::lex::{self, line_end, lines_of, trimmed};
use crate::form::{Finding, Level};
use crate::geom::{Plane, Vec3};
use crate::job::JobError;
use crate::text::text;
use block::EMPTY;
use calls::{Calls, Place};
pub(super) use guess::guessed;
use macros::{Macros, Step};
use reader::Reader;

/// The longest program that is read, in UTF-16 units.
pub use crate::job::LONGEST_PROGRAM;

/// Refuses a program of so many UTF-16 units.
pub fn too_long(units: usize) -> JobError {
    let message = text!(
        "This text has {size} million characters: at most {most} million are read",
        super::millions(units),
        LONGEST_PROGRAM / 1_000_000
    );
    super::refused_as_too_long(message)
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
    /// The plane that the program chose first; arcs may be in another one.
    pub plane: Plane,
    /// What was ignored, and where the path is not known.
    pub findings: Vec<Finding>,
}

impl Toolpath {
    /// The number of moves: `kind`, `feed` and `line` have one entry for each.
    pub fn len(&self) -> usize {
        self.kind.len()
    }

    /// Whether the program has no moves.
    pub fn is_empty(&self) -> bool {
        self.kind.is_empty()
    }

    /// Where a move ends, in the program's units: NaN along an axis whose place is not known. Panics beyond the last move.
    pub fn end(&self, index: usize) -> Vec3 {
        Vec3::from_slice(&self.to[3 * index..3 * index + 3])
    }
}

/// Reads a program. `dialect` is one of [`DIALECTS`]; none is looked for in the text.
pub fn read_program(text: &str, dialect: Option<&'static str>) -> Toolpath {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let dialect = dialect.unwrap_or_else(|| guessed(text));
    let reader = Reader::new(text, dialect);
    let macros = if reader.sinumerik { None } else { Macros::of(text) };
    let mut run = Run { text, reader, calls: Calls::new(text), macros };
    run.lines(Place { at: 0, line: 0 });
    let shown = if run.reader.path.is_empty() { run.subroutines() } else { Vec::new() };
    let mut path = run.reader.finish();
    if path.is_empty() {
        path.findings.push(no_moves(text));
    } else {
        path.findings.extend(shown.iter().map(|name| not_called(name)));
    }
    path
}

/// A program while it is read.
struct Run<'t> {
    text: &'t str,
    reader: Reader,
    calls: Calls<'t>,
    macros: Option<Macros>,
}

impl Run<'_> {
    /// Reads from a line on, up to the end of the text.
    fn lines(&mut self, from: Place) {
        let (bytes, mut block) = (self.text.as_bytes(), EMPTY);
        let mut at = from.at;
        self.reader.line = from.line;
        while at < bytes.len() {
            let (end, below) = line_end(bytes, at);
            let line = match &bytes[at..end] {
                line @ [first, .., last] if first.is_ascii_graphic() && last.is_ascii_graphic() => line,
                _ => self.text[at..end].trim().as_bytes(),
            };
            let here = Place { at, line: self.reader.line };
            match self.step(line, here, below) {
                Step::AsWritten => self.reader.read(line, &mut block),
                Step::Read(line) => self.reader.read(&line, &mut block),
                Step::Done => {}
                Step::Go(to) => {
                    (at, self.reader.line) = (to.at, to.line);
                    continue;
                }
                Step::Condition => self.reader.condition_begins(),
                Step::LoopEnds => self.reader.loop_ends(),
                Step::Stop => return self.reader.lose(here.line),
            }
            self.reader.line += 1;
            at = below;
            if self.reader.turns_off {
                let next = self.calls.step(&mut self.reader, line, Place { at, line: here.line + 1 });
                (at, self.reader.line) = (next.at, next.line);
            }
            if std::mem::take(&mut self.reader.called_out)
                && let Some(macros) = &mut self.macros
            {
                macros.forget();
            }
            while at >= bytes.len() && self.calls.is_inside() {
                let next = Place { at, line: self.reader.line };
                let next = self.calls.fall_out(&mut self.reader, next);
                (at, self.reader.line) = (next.at, next.line);
            }
            while at >= bytes.len()
                && let Some(back) = self.macros.as_mut().and_then(|macros| macros.fall_out(true))
            {
                (at, self.reader.line) = (back.at, back.line);
            }
        }
    }

    /// In a text of subroutines alone these are shown, though nothing says what they are called with: their names.
    fn subroutines(&mut self) -> Vec<String> {
        let mut shown = Vec::new();
        let end = Place { at: self.text.len(), line: self.reader.line };
        while let Some((name, begin)) = self.macros.as_mut().and_then(|macros| macros.uncalled(end)) {
            self.reader.ended = false;
            self.reader.forget(7);
            let before = self.reader.path.len();
            self.lines(begin);
            shown.extend((self.reader.path.len() > before).then_some(name));
        }
        shown
    }

    /// What becomes of a line. Below the end, what ran where it was called is not reported.
    #[inline]
    fn step(&mut self, line: &[u8], here: Place, below: usize) -> Step {
        let ended = self.reader.ended;
        match &mut self.macros {
            _ if ended && self.calls.has_run(here.line) => Step::Done,
            Some(macros) if ended && macros.has_run(here.line) => Step::Done,
            Some(macros) if !ended && !self.reader.heidenhain => {
                macros.step(line, here, Place { at: below, line: here.line + 1 }, self.calls.depth())
            }
            _ => Step::AsWritten,
        }
    }
}

/// Says that a subroutine is shown though nothing calls it.
#[cold]
fn not_called(name: &str) -> Finding {
    let message = text!(
        "Nothing in this text calls {name}: it is shown as if it were called with arguments that are not known",
        crate::form::printable(name)
    );
    Finding::new(Level::Info, "not-called", "", message)
}

/// Says that a text gives no move, and whether that may be because of its semicolons.
#[cold]
#[inline(never)]
fn no_moves(text: &str) -> Finding {
    let is_code = |code: &str| {
        matches!(code.as_bytes(), [b'G' | b'g' | b'M' | b'm' | b'X'..=b'Z' | b'x'..=b'z', b'0'..=b'9' | b'-' | b'.', ..])
    };
    let hidden = lines_of(text).position(|line| {
        let code = lex::code(line, false);
        line.get(code.len() + 1..).is_some_and(|behind| is_code(trimmed(code)) && is_code(trimmed(behind)))
    });
    let message = match hidden {
        Some(line) => {
            text!("No move was found in this text: the code after a semicolon is a comment, as in line {line}", line + 1)
        }
        None => text!("No move was found in this text"),
    };
    Finding::new(Level::Warning, "no-moves", "", message)
}
