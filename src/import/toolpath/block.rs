//! What one block of a program says: its words, and the numbers in them.

use crate::num::read_digits;

/// A call of a subprogram.
#[derive(Clone, Copy)]
pub(super) struct Call {
    /// Whether its lines begin at a block number, and not at a program's.
    pub local: bool,
    pub number: u32,
    pub times: u32,
}

/// How a block moves.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Motion {
    Rapid,
    Straight,
    Clockwise,
    Counter,
    Probe,
    /// A spline: straight here.
    Curve,
}

/// What a block says of a code that makes no place of its axis words.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) enum Foreign {
    /// There is none.
    No,
    /// The code sets or stores something: nothing moves.
    Sets,
    /// Nothing is known of the code: it may move anything.
    Unknown,
}

/// A value of a word.
#[derive(Clone, Copy)]
pub(super) enum Word {
    Number(f64),
    /// A place (true) or a distance, whatever the mode: `AC(5)`, `IC(5)`.
    Placed(f64, bool),
    /// What the control would compute.
    Computed,
}

impl Word {
    /// NaN where the control would compute it.
    pub fn number(self) -> f64 {
        if let Word::Number(x) = self { x } else { f64::NAN }
    }
}

/// Which of X, Y, Z, or of I, J, K: a bit each.
pub(super) type Axes = u8;

/// What a block says.
pub(super) struct Block {
    /// X, Y, Z, where they are given.
    pub places: [f64; 3],
    pub given: Axes,
    /// Those of them that the control would compute.
    pub computed: Axes,
    /// Those of them that are places, and those that are distances, whatever the mode.
    pub placed: Axes,
    pub moved: Axes,
    /// I, J, K from where the arc begins, or as places.
    pub center: [f64; 3],
    pub centered: Axes,
    pub radius: Option<f64>,
    /// A motion for this block alone.
    pub once: Option<Motion>,
    /// It names one of the motions that stay: G0 to G3, G38.n.
    pub motion: bool,
    /// Its axis words are no place to go to: G10, G92, a cycle of the control's own.
    pub elsewhere: bool,
    /// It waits. Its axis words are its time, unless it names a motion or its time by P, too.
    pub dwells: bool,
    /// It writes settings, G10: which by L.
    pub writes: bool,
    /// It changes the length of the tool.
    pub lengthens: bool,
    /// It keeps the modes (M70, M73), forgets them (M71) or gives them back (M72).
    pub keeps: Option<u8>,
    /// The work offset that it selects, as ten times its code.
    pub offset: Option<i32>,
    /// L and P; NaN where the control would compute them.
    pub l: Option<f64>,
    pub p: Option<f64>,
    /// It moves axes other than X, Y and Z.
    pub others: bool,
    /// Its places are of the machine: where that is in the work system is not known.
    pub machine: bool,
    /// It goes to a place that the machine knows, whether or not it names axes.
    pub home: bool,
    /// Its F.
    pub feed: Option<f64>,
    /// Its F is no feed that stays: a time, or an argument of a macro.
    pub feedless: bool,
    /// It ends the program.
    pub ends: bool,
    /// It goes back to where the program was called from, M99, or to the number in its P.
    pub returns: bool,
    /// Its places, if it has any, are where the tool is called to be: G50 of a lathe.
    pub renames: bool,
    /// It names two motions, or an axis twice.
    pub twice: bool,
    /// Something in it is not a word.
    pub strange: bool,
    /// It jumps.
    pub jumps: bool,
    /// It names a code that makes no place of its axis words.
    pub foreign: Foreign,
    /// An M code stands first in it, and its axis words may be that code's: unless it names a motion.
    pub led: Foreign,
    /// Where the name of that code begins and ends in its line.
    pub name: [usize; 2],
    /// Where the words begin, behind the block's number.
    pub begin: usize,
    /// It calls a subprogram: 97, 98 or 198.
    pub calls: Option<u8>,
    /// Whether one of these is so, or an axis is a place or a distance by its own.
    pub special: bool,
}

pub(super) const EMPTY: Block = Block {
    places: [0.0; 3],
    given: 0,
    computed: 0,
    placed: 0,
    moved: 0,
    center: [0.0; 3],
    centered: 0,
    radius: None,
    once: None,
    motion: false,
    elsewhere: false,
    dwells: false,
    writes: false,
    lengthens: false,
    keeps: None,
    offset: None,
    l: None,
    p: None,
    others: false,
    machine: false,
    home: false,
    feed: None,
    feedless: false,
    ends: false,
    returns: false,
    renames: false,
    twice: false,
    strange: false,
    jumps: false,
    foreign: Foreign::No,
    led: Foreign::No,
    name: [0; 2],
    begin: 0,
    calls: None,
    special: false,
};

impl Block {
    /// Takes all words out. Places and centres stay: nothing says that they are given.
    pub fn empty(&mut self) {
        (self.given, self.computed, self.centered) = (0, 0, 0);
        (self.radius, self.once, self.feed, self.offset, self.l, self.p) = (None, None, None, None, None, None);
        (self.motion, self.elsewhere, self.dwells, self.writes) = (false, false, false, false);
        (self.lengthens, self.feedless, self.keeps) = (false, false, None);
        (self.machine, self.home, self.others) = (false, false, false);
        (self.ends, self.strange, self.jumps) = (false, false, false);
        (self.returns, self.renames, self.twice) = (false, false, false);
        if self.special {
            (self.foreign, self.led, self.calls, self.special) = (Foreign::No, Foreign::No, None, false);
            (self.placed, self.moved) = (0, 0);
        }
    }
}

/// Whether nothing but blanks and comments stands in front of a word.
pub(super) fn leads(line: &[u8], begin: usize, at: usize) -> bool {
    let mut before = line[begin..at].trim_ascii();
    while before.first() == Some(&b'(') {
        before = before[end_of(before, 0, b')')..].trim_ascii();
    }
    before.is_empty()
}

/// A number, and where it ends.
pub(super) fn number(line: &[u8], at: usize) -> Option<(f64, usize)> {
    let negative = line.get(at) == Some(&b'-');
    let first = at + usize::from(matches!(line.get(at), Some(b'-' | b'+')));
    let (size, length) = read_digits(line.get(first..)?)?;
    Some((if negative { -size } else { size }, first + length))
}

/// After the bracket that closes; the end of the line where none does.
pub(super) fn end_of(line: &[u8], at: usize, close: u8) -> usize {
    line[at..].iter().position(|b| *b == close).map_or(line.len(), |n| at + n + 1)
}

/// After a value that is not a plain number: brackets belong together.
pub(super) fn end_of_value(line: &[u8], at: usize) -> usize {
    let mut depth = 0usize;
    for (n, b) in line.iter().enumerate().skip(at) {
        match b {
            b'[' | b'(' | b'<' => depth += 1,
            b']' | b')' | b'>' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return n + 1;
                }
            }
            b' ' | b'\t' | b';' if depth == 0 => return n,
            // `#5` ends where the next word begins.
            b if depth == 0 && n > at && line[at] == b'#' && b.is_ascii_alphabetic() => return n,
            _ => {}
        }
    }
    line.len()
}

/// Where the next word begins behind something that is none: a letter with a value, outside of brackets and comments.
pub(super) fn next_word(line: &[u8], at: usize) -> usize {
    let mut depth = 0usize;
    for n in at + 1..line.len() {
        match line[n - 1] {
            b'[' | b'(' | b'<' => depth += 1,
            b']' | b')' | b'>' => depth = depth.saturating_sub(1),
            b';' => break,
            before if before.is_ascii_alphabetic() || before == b'_' => continue,
            _ => {}
        }
        if depth == 0 && line[n].is_ascii_alphabetic() && valued(line, n) {
            return n;
        }
    }
    line.len()
}

/// Whether what may be a value stands after a letter.
pub(super) fn valued(line: &[u8], at: usize) -> bool {
    line.get(at + 1).is_some_and(|next| next.is_ascii_digit() || b".+-=#[ ".contains(next))
}

/// Where the words of a block begin: behind its number, `N10` or `:10`, and what leaves it out, `/2`.
pub(super) fn head(line: &[u8]) -> usize {
    let mut at = 0;
    while let Some(b'/' | b':' | b'N' | b'n') = line.get(at) {
        let digits = line[at + 1..].iter().take_while(|b| b.is_ascii_digit()).count();
        let end = at + 1 + digits;
        if line[at].is_ascii_alphabetic() && (digits == 0 || line.get(end) == Some(&b'.')) {
            break;
        }
        at = end + line[end..].iter().take_while(|b| matches!(b, b' ' | b'\t')).count();
    }
    at
}

/// A line without the number of its block.
pub(super) fn numbered(line: &[u8]) -> &[u8] {
    let [b'N' | b'n', rest @ ..] = line else { return line };
    &rest[rest.iter().take_while(|b| b.is_ascii_digit() || **b == b' ').count()..]
}
