//! The moves of any program, as columns: a reader that follows words and nothing else. What has to be computed or jumped to is passed over, and
//! said. Nothing is proven of what it reads: that is for the readers of `control`, which refuse what they do not understand.
//!
//! G0 to G3, probing as `G38.n`, `G31` and `MEAS=1 G1`, units, planes, absolute and incremental places, arcs by centre or radius.

use crate::control::iso::lines::{next_line, trimmed};
use crate::form::{Checker, Finding};
use crate::geom::{Plane, Vec3};
use crate::job::JobError;
use crate::num::read_digits;
use crate::text::{Text, text};

/// The longest program that is read, in bytes.
pub const LONGEST_PROGRAM: usize = 20_000_000;

/// Refuses a program of so many bytes.
pub fn too_long(bytes: usize) -> JobError {
    super::longer_than(LONGEST_PROGRAM, bytes)
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
        let end = memchr::memchr(b'\n', &bytes[at..]).map_or(bytes.len(), |length| at + length);
        let line = match &bytes[at..end] {
            line @ [first, .., last] if first.is_ascii_graphic() && last.is_ascii_graphic() => line,
            _ => text[at..end].trim().as_bytes(),
        };
        reader.read(line, &mut block);
        reader.line += 1;
        at = end + 1;
    }
    reader.finish()
}

/// A SINUMERIK assigns with `=`, calls with `( )` and comments with `;` alone.
fn guessed(text: &str) -> &'static str {
    let mut rest = text;
    for _ in 0..2000 {
        if rest.is_empty() {
            break;
        }
        let line = trimmed(next_line(&mut rest)).as_bytes();
        // Most lines begin with a G, a number or an axis, and assign nothing.
        let begins = line.first().is_some_and(|b| matches!(b, b'C' | b'D' | b'I' | b'M' | b'S' | b'T' | b'R'));
        if matches!(line.first(), Some(b'(' | b'%' | b';' | b'O' | b'o' | b'#'))
            || !(begins || memchr::memchr2(b'=', b'$', line).is_some())
        {
            continue;
        }
        // A comment may say anything.
        let code = String::from_utf8_lossy(line.split(|b| matches!(b, b';' | b'(')).next().unwrap_or_default());
        let calls = line.starts_with(b"MSG(") || line.starts_with(b"CYCLE");
        if calls || ["MEAS=", "MEAW=", "GOTOF", "STOPRE", "$A", "$P", "DEF ", "CR="].iter().any(|word| code.contains(word)) {
            return DIALECTS[1];
        }
    }
    DIALECTS[0]
}

/// How a block moves.
#[derive(Clone, Copy, PartialEq)]
enum Motion {
    Rapid,
    Straight,
    Clockwise,
    Counter,
    Probe,
}

/// A value of a word.
#[derive(Clone, Copy)]
enum Word {
    Number(f64),
    /// What the control would compute.
    Computed,
}

/// Which of X, Y, Z, or of I, J, K: a bit each.
type Axes = u8;

/// What a block says.
struct Block {
    /// X, Y, Z, where they are given.
    places: [f64; 3],
    given: Axes,
    /// Those of them that the control would compute.
    computed: Axes,
    /// I, J, K from where the arc begins, or as places.
    center: [f64; 3],
    centered: Axes,
    radius: Option<f64>,
    /// A motion for this block alone.
    once: Option<Motion>,
    /// Its axis words are no place to go to: G10, G92, a cycle of the control's own.
    elsewhere: bool,
    /// Its places are of the machine: where that is in the work system is not known.
    machine: bool,
    /// Its feed, or the time of a dwell.
    feed: Option<f64>,
    /// Something in it is not a word.
    strange: bool,
}

const EMPTY: Block = Block {
    places: [0.0; 3],
    given: 0,
    computed: 0,
    center: [0.0; 3],
    centered: 0,
    radius: None,
    once: None,
    elsewhere: false,
    machine: false,
    feed: None,
    strange: false,
};

impl Block {
    /// Takes all words out. Places and centres stay: nothing says that they are given.
    fn empty(&mut self) {
        (self.given, self.computed, self.centered) = (0, 0, 0);
        (self.radius, self.once, self.feed) = (None, None, None);
        (self.elsewhere, self.machine, self.strange) = (false, false, false);
    }
}

/// Something that is said once, with how often and where first.
#[derive(Clone, Copy, Default)]
struct Count {
    times: usize,
    first: usize,
}

/// What stays in force from block to block.
#[derive(Clone, Copy)]
struct Modes {
    motion: Motion,
    absolute: bool,
    centers_absolute: bool,
    plane: Option<Plane>,
}

struct Reader {
    path: Toolpath,
    line: usize,
    sinumerik: bool,
    place: [f64; 3],
    modes: Modes,
    /// The plane that was chosen first.
    plane: Option<Plane>,
    /// The work offset that was selected first: ten times its code.
    offset: Option<i32>,
    /// Between `sub` and `endsub`: what stands there runs where it is called.
    inside: bool,
    /// Behind the end of the program.
    ended: bool,
    /// Units of the path in a unit that the program has now.
    scale: f64,
    feed: f64,
    skipped: Count,
    computed: Count,
    from_unknown: Count,
    arcs_unsolved: Count,
    machine: Count,
    transformed: Count,
}

impl Reader {
    fn new(text: &str, dialect: &'static str) -> Self {
        let moves = text.len() / 24 + 8;
        let path = Toolpath {
            dialect,
            to: Vec::with_capacity(3 * moves),
            kind: Vec::with_capacity(moves),
            feed: Vec::with_capacity(moves),
            line: Vec::with_capacity(moves),
            ..Toolpath::default()
        };
        Reader {
            path,
            line: 0,
            sinumerik: dialect == DIALECTS[1],
            place: [f64::NAN; 3],
            modes: Modes { motion: Motion::Rapid, absolute: true, centers_absolute: false, plane: None },
            plane: None,
            offset: None,
            inside: false,
            ended: false,
            scale: 1.0,
            feed: f64::NAN,
            skipped: Count::default(),
            computed: Count::default(),
            from_unknown: Count::default(),
            arcs_unsolved: Count::default(),
            machine: Count::default(),
            transformed: Count::default(),
        }
    }

    /// Reads one line, into a block that is used again for every line.
    fn read(&mut self, line: &[u8], block: &mut Block) {
        match line.first() {
            None | Some(b'%' | b';') => return,
            Some(b'(') if self.ended => return,
            _ if self.ended => return count(&mut self.skipped, self.line),
            // O words jump, loop and call; alone they number a program.
            Some(b'O' | b'o') if !self.sinumerik => return self.o_word(line),
            _ if self.inside => return,
            // A variable gets a value.
            Some(b'#') => return count(&mut self.skipped, self.line),
            Some(_) => {}
        }
        let before = self.modes;
        block.empty();
        // A block that may be left out, `/2`, and the number of a main block, `:10`.
        let mut at = usize::from(matches!(line[0], b'/' | b':'));
        while at > 0 && line.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        while at < line.len() {
            match line[at] {
                b' ' | b'\t' => at += 1,
                b';' => break,
                b'(' if !self.sinumerik => at = end_of(line, at, b')'),
                letter if letter.is_ascii_alphabetic() => {
                    let Some(next) = self.word(line, at, block) else {
                        block.strange = true;
                        break;
                    };
                    at = next;
                }
                _ => {
                    block.strange = true;
                    break;
                }
            }
        }
        if block.strange {
            // Nothing of such a line is a move: it jumps, calls or computes. Where it might go to is not known.
            self.modes = before;
            self.forget(line);
            return count(&mut self.skipped, self.line);
        }
        if block.elsewhere {
            return;
        }
        self.feed = block.feed.map_or(self.feed, |feed| feed * self.scale);
        // Without a place, a centre makes a whole circle back to where it begins.
        if block.given | block.centered != 0 {
            self.moves(block);
        } else if block.machine {
            self.place = [f64::NAN; 3];
            count(&mut self.machine, self.line);
        }
    }

    /// `o<name> sub`, `o1 if`, `O1000`.
    fn o_word(&mut self, line: &[u8]) {
        let code = line.split(|b| matches!(b, b'(' | b';')).next().unwrap_or_default();
        let named = |word: &[u8]| {
            let mut words = code.split(|b| matches!(b, b' ' | b'\t')).filter(|part| !part.is_empty());
            words.any(|part| part.eq_ignore_ascii_case(word))
        };
        if named(b"sub") {
            self.inside = true;
        } else if named(b"endsub") {
            self.inside = false;
        }
        if named(b"call") {
            self.place = [f64::NAN; 3];
        }
        let alone = code.len() > 1 && code[1..].iter().all(|b| b.is_ascii_digit() || b.is_ascii_whitespace());
        if !alone {
            count(&mut self.skipped, self.line);
        }
    }

    /// The axes that a line names which is not followed are somewhere else afterwards.
    fn forget(&mut self, line: &[u8]) {
        for (at, b) in line.iter().enumerate() {
            let axis = b.to_ascii_uppercase().wrapping_sub(b'X');
            let begins = at == 0 || !(line[at - 1].is_ascii_alphabetic() || b"_[,".contains(&line[at - 1]));
            let valued = line.get(at + 1).is_some_and(|next| next.is_ascii_digit() || b".+-=#[ ".contains(next));
            if axis < 3 && begins && valued {
                self.place[usize::from(axis)] = f64::NAN;
            }
        }
    }

    /// Takes the word at `at` and gives where the next one begins; none where it is none.
    fn word(&mut self, line: &[u8], at: usize, block: &mut Block) -> Option<usize> {
        let letter = line[at].to_ascii_uppercase();
        let mut next = at + 1;
        while matches!(line.get(next), Some(b' ' | b'\t')) {
            next += 1;
        }
        let (word, end) = match line.get(next)? {
            b'-' | b'+' if matches!(line.get(next + 1), Some(b'#' | b'[')) => (Word::Computed, end_of_value(line, next + 1)),
            b'0'..=b'9' | b'.' | b'-' | b'+' => {
                let (number, end) = number(line, next)?;
                // `R1=5` gives a variable a value.
                if line.get(end) == Some(&b'=') {
                    return None;
                }
                (Word::Number(number), end)
            }
            b'#' | b'[' => (Word::Computed, end_of_value(line, next)),
            b'=' if self.sinumerik => {
                let end = end_of_value(line, next + 1);
                let plain = line.get(next + 1).is_some_and(|b| b.is_ascii_digit() || b".-+".contains(b));
                match number(line, next + 1).filter(|(_, stop)| plain && *stop == end) {
                    Some((number, _)) => (Word::Number(number), end),
                    None => (Word::Computed, end),
                }
            }
            _ => return self.name(line, at, block),
        };
        match (letter, word) {
            (b'X'..=b'Z', word) => {
                let axis = letter - b'X';
                block.given |= 1 << axis;
                match word {
                    Word::Number(x) => block.places[usize::from(axis)] = x,
                    Word::Computed => block.computed |= 1 << axis,
                }
            }
            (b'I'..=b'K', word) => {
                let axis = letter - b'I';
                block.centered |= 1 << axis;
                // A centre that is computed makes no arc.
                block.center[usize::from(axis)] = if let Word::Number(x) = word { x } else { f64::NAN };
            }
            (b'F', Word::Number(x)) => block.feed = Some(x),
            (b'R', Word::Number(x)) => block.radius = Some(x),
            (b'G', Word::Number(x)) => self.code((x * 10.0 + 0.5) as i32, block),
            (b'G', Word::Computed) => return None,
            // Another program is called: where the ball is afterwards is not known.
            (b'M', Word::Number(97.0 | 98.0 | 198.0)) => {
                self.place = [f64::NAN; 3];
                count(&mut self.skipped, self.line);
            }
            (b'M', Word::Number(2.0 | 30.0)) => self.ended = true,
            _ => {}
        }
        Some(end)
    }

    /// A word of more letters: `MEAS=1`, `CR=5`, and none else.
    fn name(&mut self, line: &[u8], at: usize, block: &mut Block) -> Option<usize> {
        let rest = &line[at..];
        let begins = |word: &[u8]| rest.len() > word.len() && rest[..word.len()].eq_ignore_ascii_case(word);
        if !self.sinumerik {
            return None;
        }
        if begins(b"MEAS=") || begins(b"MEAW=") {
            block.once = Some(Motion::Probe);
            return Some(number(line, at + 5)?.1);
        }
        if begins(b"CR=") {
            let (radius, end) = number(line, at + 3)?;
            block.radius = Some(radius);
            return Some(end);
        }
        None
    }

    fn code(&mut self, tenths: i32, block: &mut Block) {
        match tenths {
            0 => self.modes.motion = Motion::Rapid,
            10 => self.modes.motion = Motion::Straight,
            20 => self.modes.motion = Motion::Clockwise,
            30 => self.modes.motion = Motion::Counter,
            310 if !self.sinumerik => block.once = Some(Motion::Probe),
            382..=385 => self.modes.motion = Motion::Probe,
            170 => self.turn(Plane::G17),
            180 => self.turn(Plane::G18),
            190 => self.turn(Plane::G19),
            200 | 210 if !self.sinumerik => self.units(tenths == 210),
            700 | 710 | 7000 | 7100 if self.sinumerik => self.units(matches!(tenths, 710 | 7100)),
            900 => self.modes.absolute = true,
            910 => self.modes.absolute = false,
            901 => self.modes.centers_absolute = true,
            911 => self.modes.centers_absolute = false,
            // Dwells, tables, zones and what the control measures by itself are no places to go to.
            40 | 100 | 220 | 230 | 370 => block.elsewhere = true,
            // Nor are shifts, turns, mirrors, scales and polar places; but what comes after them is another place than it says.
            160 | 510 | 511 | 520 | 680 | 920..=923 if !self.sinumerik => {
                block.elsewhere = true;
                count(&mut self.transformed, self.line);
            }
            // A macro that is called, or a cycle of the control's own, moves by itself: where to is not known.
            650 | 660 | 661 | 730 | 740 | 760 | 810..=890 if !self.sinumerik => {
                block.elsewhere = true;
                self.place = [f64::NAN; 3];
                count(&mut self.skipped, self.line);
            }
            // One work offset is what all is seen in; another one lies elsewhere.
            540..=599 if *self.offset.get_or_insert(tenths) != tenths => count(&mut self.transformed, self.line),
            280 | 300 | 530 | 1530 => block.machine = true,
            740 | 750 if self.sinumerik => block.machine = true,
            _ => {}
        }
    }

    fn turn(&mut self, plane: Plane) {
        self.plane.get_or_insert(plane);
        self.modes.plane = Some(plane);
    }

    fn units(&mut self, metric: bool) {
        let first = *self.path.metric.get_or_insert(metric);
        self.scale = match (first, metric) {
            (true, false) => 25.4,
            (false, true) => 1.0 / 25.4,
            _ => 1.0,
        };
    }

    fn moves(&mut self, block: &Block) {
        let motion = block.once.unwrap_or(self.modes.motion);
        let from = self.place;
        for (axis, place) in self.place.iter_mut().enumerate().filter(|(axis, _)| block.given & (1 << axis) != 0) {
            let x = block.places[axis] * self.scale;
            *place = if block.computed & (1 << axis) != 0 {
                count(&mut self.computed, self.line);
                f64::NAN
            } else if block.machine {
                f64::NAN
            } else if self.modes.absolute {
                x
            } else if from[axis].is_nan() {
                // The begin is not known: it is counted from 0.
                count(&mut self.from_unknown, self.line);
                x
            } else {
                from[axis] + x
            };
        }
        if block.machine {
            count(&mut self.machine, self.line);
        }
        if matches!(motion, Motion::Clockwise | Motion::Counter) {
            match self.arc(block, from, motion == Motion::Counter) {
                Some([a, b, c, sweep]) => {
                    let plane = match self.modes.plane.unwrap_or_default() {
                        Plane::G17 => 17.0,
                        Plane::G18 => 18.0,
                        Plane::G19 => 19.0,
                    };
                    self.path.arcs.push([self.path.kind.len() as f64, a, b, c, sweep, plane]);
                }
                None => count(&mut self.arcs_unsolved, self.line),
            }
        }
        self.place.into_iter().for_each(|x| self.path.to.push(x));
        let kind = match motion {
            Motion::Rapid => RAPID,
            Motion::Straight | Motion::Clockwise | Motion::Counter => FEED,
            Motion::Probe => PROBE,
        };
        self.path.kind.push(kind);
        self.path.feed.push(if kind == RAPID { f64::NAN } else { self.feed });
        self.path.line.push(self.line as u32);
    }

    /// Centre and sweep of an arc, in degrees; none where the block does not give one.
    fn arc(&self, block: &Block, from: [f64; 3], counter: bool) -> Option<[f64; 4]> {
        let [a, o, _] = self.modes.plane.unwrap_or_default().axes();
        let (begin, end) = ([from[a], from[o]], [self.place[a], self.place[o]]);
        if begin.iter().chain(&end).any(|x| x.is_nan()) {
            return None;
        }
        let middle = match block.radius {
            Some(radius) => by_radius(begin, end, radius * self.scale, counter)?,
            None => {
                let given = |axis: usize| block.centered & (1 << axis) != 0;
                let offset = |axis: usize| if given(axis) { block.center[axis] * self.scale } else { 0.0 };
                if self.modes.centers_absolute { [offset(a), offset(o)] } else { [begin[0] + offset(a), begin[1] + offset(o)] }
            }
        };
        let angle = |at: [f64; 2]| (at[1] - middle[1]).atan2(at[0] - middle[0]).to_degrees();
        let mut sweep = (angle(end) - angle(begin)).rem_euclid(360.0);
        if !counter {
            sweep -= 360.0;
        }
        // A circle comes back to where it began.
        let same = (end[0] - begin[0]).hypot(end[1] - begin[1]) < 1e-9;
        if same || sweep == 0.0 {
            sweep = if counter { 360.0 } else { -360.0 };
        }
        let out = (begin[0] - middle[0]).hypot(begin[1] - middle[1]);
        // An end that is not on the circle is an alarm of any control, but for rounding.
        if ((end[0] - middle[0]).hypot(end[1] - middle[1]) - out).abs() > 0.02 + 0.01 * out {
            return None;
        }
        let mut center = [self.place[0], self.place[1], self.place[2]];
        (center[a], center[o]) = (middle[0], middle[1]);
        (out > 0.0 && out.is_finite()).then_some([center[0], center[1], center[2], sweep])
    }

    fn finish(mut self) -> Toolpath {
        let mut checker = Checker::default();
        let mut say = |count: Count, code: &str, what: Text| {
            if count.times > 0 {
                let message = if count.times == 1 {
                    text!("{what}: once, in line {line}", what, count.first + 1)
                } else {
                    text!("{what}: {times} times, the first in line {line}", what, count.times, count.first + 1)
                };
                checker.warning(code, "", message);
            }
        };
        say(
            self.skipped,
            "lines-skipped",
            text!("Lines that jump, call, compute or run a cycle of the control's own are not followed"),
        );
        say(
            self.computed,
            "places-computed",
            text!("Places that the control computes are not known here, until a number is given"),
        );
        say(self.machine, "machine-places", text!("Places in the machine's own system are not known in the work system"));
        say(
            self.transformed,
            "places-transformed",
            text!(
                "Shifts, turns, mirrors, scales, polar places and other work offsets are not followed: later places are as written"
            ),
        );
        say(
            self.from_unknown,
            "start-unknown",
            text!("Incremental moves begin at a place that is not known: they are counted from 0"),
        );
        say(self.arcs_unsolved, "arc-unsolved", text!("Arcs whose centre or begin is not known are straight here"));
        if self.path.metric.is_none() && !self.path.is_empty() {
            checker.info("no-units", "", text!("The program does not say its units"));
        }
        self.path.findings = checker.findings();
        self.path.plane = self.plane.unwrap_or_default();
        self.path
    }
}

fn count(count: &mut Count, line: usize) {
    if count.times == 0 {
        count.first = line;
    }
    count.times += 1;
}

/// The centre of an arc of this radius; of a negative one the long way round.
fn by_radius(begin: [f64; 2], end: [f64; 2], radius: f64, counter: bool) -> Option<[f64; 2]> {
    let (dx, dy) = (end[0] - begin[0], end[1] - begin[1]);
    let chord = dx.hypot(dy);
    // A little too short is rounding.
    let square = radius * radius - chord * chord / 4.0;
    if chord < 1e-9 || square < -1e-3 * radius * radius {
        return None;
    }
    let side = if counter == (radius > 0.0) { 1.0 } else { -1.0 };
    let off = side * square.max(0.0).sqrt() / chord;
    Some([(begin[0] + end[0]) / 2.0 - dy * off, (begin[1] + end[1]) / 2.0 + dx * off])
}

/// A number, and where it ends.
fn number(line: &[u8], at: usize) -> Option<(f64, usize)> {
    let negative = line.get(at) == Some(&b'-');
    let first = at + usize::from(matches!(line.get(at), Some(b'-' | b'+')));
    let (size, length) = read_digits(line.get(first..)?)?;
    Some((if negative { -size } else { size }, first + length))
}

/// Behind the bracket that closes; the end of the line where none does.
fn end_of(line: &[u8], at: usize, close: u8) -> usize {
    line[at..].iter().position(|b| *b == close).map_or(line.len(), |n| at + n + 1)
}

/// Behind a value that is not a plain number: brackets belong together.
fn end_of_value(line: &[u8], at: usize) -> usize {
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
