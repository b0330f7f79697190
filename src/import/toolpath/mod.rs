//! The moves of any program, as columns. This reader follows words and ignores lines that it does not understand, with a note. It proves nothing: the readers
//! of `control` do, which refuse lines that they do not understand.
//!
//! G0 to G3, probing as `G38.n`, `G31`, `G31.n` and `MEAS=1 G1`, units, planes, absolute and incremental positions, arcs by centre or radius.

mod block;
mod calls;
pub(in crate::import) mod control_kind;
mod count;
mod findings;
mod flow;
mod foreign;
mod fork;
mod frames;
pub(in crate::import) mod guess;
mod heidenhain;
mod key;
mod klartext;
mod known;
mod modes;
mod moves;
mod moves_system;
mod native;
mod outline;
mod own_path;
mod plain;
mod probe_intent;
mod reader;
mod rules;
mod script;
mod skipped;
mod system;
mod way;
mod words;
mod writes;
mod wrote;

use crate::control::edition::Edition;
use crate::control::iso::lex::{self, line_end, lines_of, trimmed};
use crate::form::{Finding, Level};
use crate::geom::{Plane, Vec3};
use crate::import::dialect_markers;
use crate::job::JobError;
use crate::part::Machine as Inertia;
use crate::text::text;
use block::EMPTY;
use calls::{Calls, Place};
use control_kind::ControlKind;
pub use control_kind::{PROGRAM_POSTS, program_post_title};
use flow::LineAction;
use frames::Frames;
pub(super) use guess::guessed;
use klartext::Klartext;
#[allow(deprecated)]
pub use known::{Ask, Known, Trip};
pub use known::{Feature, RunInputs, TriggerAt, UnsetVariable};
pub use native::{NativeArgument, NativeCall};
pub use outline::{Heading, outline};
use probe_intent::{AfterProbe, has_probing_code};
use reader::{ProbeModel, Reader};
use rules::Log;
pub use rules::{RUN_RULES, RunRule};
use script::grammar::{HEIDENHAIN, SINUMERIK};
use script::{Machine, is_macro};
use skipped::Skip;
pub use writes::{WRITE_KINDS, Write};

/// Longest program that is read, in UTF-16 units.
pub use crate::job::LONGEST_PROGRAM;

/// Refusal of a program with this number of UTF-16 units.
pub fn too_long(units: usize) -> JobError {
    let message = text!(
        "This text has {size} million characters: at most {most} million are read",
        super::millions(units),
        LONGEST_PROGRAM / 1_000_000
    );
    super::refused_as_too_long(message)
}

/// Kinds of moves, by their values in the column `kind`.
pub const KINDS: [&str; 3] = ["rapid", "feed", "probe"];
const RAPID: u8 = 0;
const FEED: u8 = 1;
const PROBE: u8 = 2;

/// Dialects that this reader distinguishes.
pub const DIALECTS: [&str; 3] = ["iso", "sinumerik", "klartext"];

/// The moves of a program, column by column. Lengths are in the units that the program states first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Toolpath {
    /// Dialect, one of [`DIALECTS`].
    pub dialect: &'static str,
    /// Key of the control that it was read for: the given one, or the recognised one.
    pub post: Option<&'static str>,
    /// Whether its units are millimetres; `None` if it does not say.
    pub metric: Option<bool>,
    /// End of each move, three numbers a move; NaN along an axis with an unknown position.
    pub to: Vec<f64>,
    /// Kind of each move: an index into [`KINDS`].
    pub kind: Vec<u8>,
    /// Feed of each move, units per minute; NaN for a rapid, or without a stated feed.
    pub feed: Vec<f64>,
    /// The 0-based line of each move, in its own text.
    pub line: Vec<u32>,
    /// File of each move: 0 is the program, higher numbers are files of subprograms, counted from 1. Empty without files.
    pub file: Vec<u32>,
    /// Arcs: index of the move, centre, degrees counter-clockwise seen against the axis of their plane, and the plane: 17, 18 or 19.
    pub arcs: Vec<[f64; 6]>,
    /// Plane that the program chose first; arcs may be in another one.
    pub plane: Plane,
    /// Contacts of probing moves: index of the move, and position. For a run with known triggers.
    pub contacts: Vec<[f64; 4]>,
    /// Moves that do not begin at the end of the previous one: index of the move, and start. From the branches of an unknown condition.
    pub resumes: Vec<[f64; 4]>,
    /// Changes of the coordinate system: index of the first move in it, its origin in the system of the first move, and its rotation in degrees. NaN is
    /// unknown.
    pub systems: Vec<[f64; 5]>,
    /// Notes about ignored lines and unknown positions.
    pub findings: Vec<Finding>,
    /// 0-based lines of each finding.
    pub finding_lines: Vec<Vec<u32>>,
    /// Values that the program reads without setting them.
    pub asks: Vec<UnsetVariable>,
    /// Calls of native cycles, in the order in which they run.
    pub calls: Vec<NativeCall>,
    /// Safety rules for a run that probes.
    pub rules: Vec<RunRule>,
    /// Lasting writes of a run, in order.
    pub writes: Vec<Write>,
    /// Position of the stylus before the first move.
    pub(crate) start: [f64; 3],
    /// Whether it probes with G38.2 and related codes.
    pub(crate) by_g38: bool,
    /// Whether it is for a Centroid, whose macros share numbers with Renishaw's.
    pub(crate) centroid: bool,
    /// Edition of Renishaw's macros that it is for.
    pub(crate) edition: Edition,
    /// Line of the alarm that ends a run.
    pub(crate) stopped: Option<u32>,
}

impl Toolpath {
    /// Decides what the numbers of macros mean.
    fn is_for(&mut self, kind: ControlKind, text: &str) {
        self.centroid = kind == ControlKind::Centroid;
        self.edition = guess::edition(text);
    }

    /// Number of moves: `kind`, `feed` and `line` have one entry for each.
    pub fn len(&self) -> usize {
        self.kind.len()
    }

    /// Whether the program has no moves.
    pub fn is_empty(&self) -> bool {
        self.kind.is_empty()
    }

    /// End of a move in the program's units: NaN along an axis with an unknown position. Panics beyond the last move.
    pub fn end(&self, index: usize) -> Vec3 {
        Vec3::from_slice(&self.to[3 * index..3 * index + 3])
    }

    /// Start of a move: the end or the contact of the previous one.
    fn begin(&self, index: usize) -> Vec3 {
        let Some(before) = index.checked_sub(1) else {
            return self.start.into();
        };
        let found = |places: &[[f64; 4]], index: usize| {
            let at = places.partition_point(|place| place[0] < index as f64);
            places
                .get(at)
                .filter(|place| place[0] == index as f64)
                .map(|[_, x, y, z]| Vec3::new(*x, *y, *z))
        };
        if let Some(place) = found(&self.resumes, index) {
            return place;
        }
        let place = found(&self.contacts, before).unwrap_or_else(|| self.end(before));
        let (old, new) = (self.system(before), self.system(index));
        if same(old, new) {
            return place;
        }
        // Its coordinates in the system of this move.
        turned(-new[3], turned(old[3], place) + origin(old) - origin(new))
    }

    /// The next move is in a system with this origin and rotation.
    fn enters_system(&mut self, system: [f64; 4]) {
        if !same(self.system(self.len()), system) {
            let [x, y, z, angle] = system;
            self.systems.push([self.len() as f64, x, y, z, angle]);
        }
    }

    /// Origin and rotation of the system of a move.
    fn system(&self, index: usize) -> [f64; 4] {
        let at = self
            .systems
            .partition_point(|system| system[0] <= index as f64);
        match at.checked_sub(1) {
            Some(at) => {
                let [_, x, y, z, angle] = self.systems[at];
                [x, y, z, angle]
            }
            None => [0.0; 4],
        }
    }

    /// Coordinates of a position in the system of the first move: NaN if its origin is unknown.
    fn drawn(&self, index: usize, position: Vec3) -> Vec3 {
        let system = self.system(index);
        turned(system[3], position) + origin(system)
    }

    /// The path with all positions in the system of the first move. Along an axis with an unknown origin they stay as written.
    pub fn in_one_system(self) -> Toolpath {
        if self.systems.is_empty() {
            return self;
        }
        let mut path = self.clone();
        let drawn = |index: usize, position: Vec3| {
            let system = self.system(index).map(|x| if x.is_nan() { 0.0 } else { x });
            turned(system[3], position) + origin(system)
        };
        for index in 0..self.len() {
            let end = drawn(index, self.end(index)).to_array();
            path.to[3 * index..3 * index + 3].copy_from_slice(&end);
        }
        for places in [&mut path.contacts, &mut path.resumes] {
            for [index, x, y, z] in places {
                [*x, *y, *z] = drawn(*index as usize, Vec3::new(*x, *y, *z)).to_array();
            }
        }
        for [index, x, y, z, ..] in &mut path.arcs {
            [*x, *y, *z] = drawn(*index as usize, Vec3::new(*x, *y, *z)).to_array();
        }
        path
    }
}

fn origin([x, y, z, _]: [f64; 4]) -> Vec3 {
    Vec3::new(x, y, z)
}

/// Whether two systems are equal, comparing known values.
fn same(one: [f64; 4], other: [f64; 4]) -> bool {
    let alike = |(a, b): (f64, f64)| a == b || a.is_nan() && b.is_nan();
    one.into_iter().zip(other).all(alike)
}

/// A position rotated about 0 around Z. Without a known angle each axis is known or unknown independently.
fn turned(angle: f64, position: Vec3) -> Vec3 {
    frames::turn(angle, position.to_array()).into()
}

/// Reads a program. `dialect` is one of [`DIALECTS`]; `None` recognises it from the text.
pub fn read_program(text: &str, dialect: Option<&'static str>) -> Toolpath {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let dialect = dialect.unwrap_or_else(|| guessed(text));
    let mut reader = Reader::new(text, dialect);
    // Long programs show their dialect early.
    const ENOUGH: usize = 50_000;
    let head = (ENOUGH..ENOUGH + 4).find_map(|end| text.get(..end));
    let head = head.unwrap_or(text);
    let kind = ControlKind::of(head, dialect, None);
    reader.path.is_for(kind, head);
    reader.path.post = kind.post();
    run(text, text.len(), dialect, &[], reader)
}

/// Runs a program with inputs beyond its text: [`read_program`] with values of variables, a start, and triggers of touches. After a touch with an unknown
/// trigger the position along it is unknown. Lines of other files are numbered after those of the text.
pub fn run_program(text: &str, known: &RunInputs<'_>) -> Toolpath {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let told = known
        .dialect
        .or(known.post.and_then(control_kind::dialect_of));
    let dialect = told.unwrap_or_else(|| guessed(text));
    let mut whole = text.to_owned();
    let mut files = Vec::new();
    for (name, file) in &known.files {
        if !whole.ends_with(['\n', '\r']) {
            whole.push('\n');
        }
        files.push((
            lines_of(&whole).count() as u32,
            crate::form::printable(name),
        ));
        whole.push_str(file);
    }
    let mut reader = Reader::new(text, dialect);
    if let Some(start) = known.start {
        reader.place = start;
    }
    let kind = ControlKind::of(text, dialect, known.post);
    reader.frames = Frames::new(kind, known.zero);
    reader.tell(&known.set);
    reader.run = Some(ProbeModel {
        touch: known.touch,
        positioning: known.positioning,
        feature: known.feature.clone(),
        behind: AfterProbe::default(),
        contact: [f64::NAN; 3],
        contact_in_machine: [f64::NAN; 3],
        met: None,
    });
    reader.path.is_for(kind, text);
    reader.path.post = known.post.or(kind.post());
    let native = known.post.and_then(crate::control::find);
    reader.output_name = native.and_then(|post| Some(post.own?.name));
    reader.files = files.clone();
    reader.path.start = reader.place;
    reader.log = Some(Log::default());
    let mut path = run(&whole, text.len(), dialect, &known.set, reader);
    // From line numbers of the whole to those of each file.
    if !files.is_empty() {
        path.file = path
            .line
            .iter()
            .map(|line| files.partition_point(|(first, _)| first <= line) as u32)
            .collect();
        for (line, file) in path
            .line
            .iter_mut()
            .zip(&path.file)
            .filter(|(_, file)| **file > 0)
        {
            *line -= files[*file as usize - 1].0;
        }
        let own = files[0].0;
        path.finding_lines
            .iter_mut()
            .for_each(|lines| lines.retain(|line| *line < own));
        path.asks
            .iter_mut()
            .for_each(|ask| ask.lines.retain(|line| *line < own));
        path.rules
            .iter_mut()
            .for_each(|rule| rule.lines.retain(|line| *line < own));
        let places = path
            .calls
            .iter_mut()
            .map(|call| (&mut call.file, &mut call.line));
        let written = path
            .writes
            .iter_mut()
            .map(|write| (&mut write.file, &mut write.line));
        for (file, line) in places.chain(written) {
            *file = files.partition_point(|(first, _)| first <= line) as u32;
            *line -= file.checked_sub(1).map_or(0, |file| files[file as usize].0);
        }
    }
    if told.is_none() && matches!(kind, ControlKind::LinuxCnc | ControlKind::Fanuc) {
        ask_control(text, &mut path);
    }
    path
}

/// Reports signs of two controls: the user has to say which one it is.
fn ask_control(text: &str, path: &mut Toolpath) {
    let Some([linuxcnc, fanuc]) = dialect_markers::contradiction(text) else {
        return;
    };
    let message = text!(
        "Line {linuxcnc} is for LinuxCNC, and line {fanuc} for a Fanuc: choose the control",
        linuxcnc + 1,
        fanuc + 1
    );
    let finding = Finding::new(Level::Warning, "signs-contradict", "", message);
    path.findings.insert(0, finding);
    path.finding_lines
        .insert(0, vec![linuxcnc as u32, fanuc as u32]);
}

/// Whether a text is HEIDENHAIN's ISO, which begins with `%NAME G71 *`.
fn is_heidenhain(text: &str) -> bool {
    let first = lines_of(text).map(trimmed).find(|line| !line.is_empty());
    first.is_some_and(|line| line.starts_with('%') && line.ends_with('*'))
}

/// Reads the first bytes of a text; lines below may be called.
fn run(
    text: &str,
    end: usize,
    dialect: &'static str,
    set: &[(&str, f64)],
    mut reader: Reader,
) -> Toolpath {
    if dialect == DIALECTS[2] {
        let mut klartext = Klartext::new(&text[..end], set);
        klartext.run(&mut reader);
        return finished(text, reader, klartext.asks(), &[]);
    }
    let kind = reader.frames.kind;
    let grammar = if dialect == DIALECTS[1] {
        // A text that is only read is not run: the run adds knowledge.
        reader.run.is_some().then_some(&SINUMERIK)
    } else if reader.run.is_some() && is_heidenhain(text) {
        Some(&HEIDENHAIN)
    } else {
        let computes = kind.computes() && (is_macro(text) || kind == ControlKind::RepRap);
        computes.then(|| kind.grammar(text, dialect))
    };
    let files = &reader.files;
    let mut macros = grammar.map(|grammar| Machine::new(text, end, grammar, set, files));
    if let Some(macros) = macros.as_mut().filter(|_| reader.run.is_some()) {
        macros.set_system(reader.system());
    }
    let mut run = Run {
        text,
        end,
        start: reader.place,
        reader,
        calls: Calls::new(text),
        macros,
    };
    run.lines(Place { at: 0, line: 0 });
    for line in run
        .macros
        .as_ref()
        .map_or_else(Vec::new, |macros| macros.divisions())
    {
        count::count(&mut run.reader.divisions, line as usize);
    }
    let shown = if run.reader.path.is_empty() {
        run.subroutines()
    } else {
        Vec::new()
    };
    let asks = run
        .macros
        .as_ref()
        .map_or_else(Vec::new, |macros| macros.asks());
    finished(text, run.reader, asks, &shown)
}

/// The path, with findings about the whole program.
fn finished(
    text: &str,
    mut reader: Reader,
    asks: Vec<UnsetVariable>,
    shown: &[String],
) -> Toolpath {
    let log = reader.log.take();
    let unread = reader.unread();
    let left = reader.modes;
    let mut path = reader.finish();
    path.asks = asks;
    if let Some(mut log) = log {
        let machine = Inertia {
            acceleration: 500.0,
            latency: 0.005,
            deflection: 3.0,
        };
        let inch = if path.metric == Some(false) {
            25.4
        } else {
            1.0
        };
        if let Some((lines, way, feed)) = log.fast_touches(&machine, inch) {
            let unit = if inch == 1.0 { "mm" } else { "inch" };
            path.findings.push(fast(way / inch, feed / inch, unit));
            path.finding_lines.push(lines);
        }
        log.unread = unread;
        (log.left_incremental, log.maybe_changed) = (!left.absolute, left.maybe_changed);
        log.left_unsure = left.unsure.distance;
        log.stopped = path.stopped;
        log.returns |= !shown.is_empty();
        path.rules = rules::checks_contact(&path, &mut log);
        path.writes = log.writes;
    }
    let mut note = |finding: Finding| {
        path.findings.push(finding);
        path.finding_lines.push(Vec::new());
    };
    if path.kind.is_empty() {
        note(no_moves(text));
    } else {
        shown.iter().for_each(|name| note(not_called(name)));
    }
    path
}

/// State of reading a program.
struct Run<'t> {
    text: &'t str,
    /// End of the program itself: lines below may be called.
    end: usize,
    /// Position of the stylus before the first block.
    start: [f64; 3],
    reader: Reader,
    calls: Calls<'t>,
    macros: Option<Machine>,
}

impl Run<'_> {
    /// Reads from a line on, up to the end of the program.
    fn lines(&mut self, from: Place) {
        let (bytes, mut block) = (self.text.as_bytes(), EMPTY);
        let mut at = from.at;
        self.reader.line = from.line;
        loop {
            let is_below = at >= self.end && (self.reader.ended || !self.is_called());
            if at >= bytes.len() || is_below {
                let Some(next) = self.behind_the_end(at) else {
                    break;
                };
                (at, self.reader.line) = (next.at, next.line);
                continue;
            }
            let (end, below) = line_end(bytes, at);
            let line = match &bytes[at..end] {
                line @ [first, .., last] if first.is_ascii_graphic() && last.is_ascii_graphic() => {
                    line
                }
                _ => self.text[at..end].trim().as_bytes(),
            };
            let here = Place {
                at,
                line: self.reader.line,
            };
            if !self.reader.forks.is_empty() {
                self.reader.join_branches(Some(here.line));
            }
            self.looks_ahead(line, below);
            match self.step(line, here, below) {
                LineAction::AsWritten => self.reader.read(line, &mut block),
                LineAction::Read(read) => {
                    // The replacement may be another code.
                    if !has_probing_code(line) {
                        self.probes_ahead(&read, below);
                    }
                    self.reader.read(&read, &mut block);
                }
                LineAction::Skip => {}
                LineAction::JumpTo(to) => {
                    (at, self.reader.line) = (to.at, to.line);
                    continue;
                }
                LineAction::Enter(to) => {
                    self.reader.enters_call();
                    (at, self.reader.line) = (to.at, to.line);
                    continue;
                }
                LineAction::Leave(to) => {
                    self.reader.leaves_call();
                    (at, self.reader.line) = (to.at, to.line);
                    continue;
                }
                LineAction::Astray => self.reader.lose(Skip::Jump, here.line),
                LineAction::MayJump(to) => {
                    self.reader.begin_branch(Some(to));
                    self.reader.read(line, &mut block);
                }
                LineAction::MayLeave(to) => self.reader.may_leave(to),
                LineAction::Way(way) => self.reader.goes_unknown_way(way),
                LineAction::Again(way) => {
                    self.reader.goes_unknown_way(way);
                    continue;
                }
                LineAction::BranchEnds(to) => {
                    self.reader.branch_ends();
                    if let Some(to) = to {
                        (at, self.reader.line) = (to.at, to.line);
                        continue;
                    }
                }
                LineAction::Ends => self.reader.aborts(),
                LineAction::Stop => return self.reader.lose(Skip::Endless, here.line),
            }
            self.reader.line += 1;
            at = below;
            // An unknown jump may have passed the end of a subprogram.
            let is_open = self.macros.as_ref().is_some_and(|macros| !macros.is_sure());
            if self.reader.returned
                && is_open
                && let Some(back) = self.calls.back()
            {
                (self.reader.returned, self.reader.ended) = (false, false);
                self.reader.may_leave(back.line);
            }
            if self.reader.may_leave_sequence {
                let next = self.calls.step(
                    &mut self.reader,
                    line,
                    Place {
                        at,
                        line: here.line + 1,
                    },
                );
                (at, self.reader.line) = (next.at, next.line);
            }
            if std::mem::take(&mut self.reader.called_external)
                && let Some(macros) = &mut self.macros
            {
                macros.forget();
            }
            if std::mem::take(&mut self.reader.called_macro)
                && let Some(macros) = &mut self.macros
            {
                self.reader.ends_macro(macros);
            }
            while at >= bytes.len() && self.calls.is_inside() {
                let next = Place {
                    at,
                    line: self.reader.line,
                };
                let next = self.calls.fall_out(&mut self.reader, next);
                (at, self.reader.line) = (next.at, next.line);
            }
        }
    }

    /// Continuation at the end of the lines: in a loop that ends with them, or after the call of a subprogram that ends with the text.
    fn behind_the_end(&mut self, at: usize) -> Option<Place> {
        let macros = self.macros.as_mut().filter(|_| !self.reader.ended)?;
        while let Some(step) = macros.dedents(self.reader.line) {
            match step {
                LineAction::JumpTo(begin) => return Some(begin),
                LineAction::Again(way) => self.reader.goes_unknown_way(way),
                _ => break,
            }
        }
        let is_over = at >= self.text.len();
        let back = is_over.then(|| macros.end_subprogram(true)).flatten()?;
        self.reader.leaves_call();
        Some(back)
    }

    /// Whether lines run because something called them.
    fn is_called(&self) -> bool {
        self.calls.is_inside()
            || self
                .macros
                .as_ref()
                .is_some_and(|macros| macros.is_inside())
    }

    /// Passes the control's values to the macros of a run, and whether the next probing move is watched positioning.
    #[inline]
    fn looks_ahead(&mut self, line: &[u8], below: usize) {
        if self.reader.run.is_none() {
            return;
        }
        self.probes_ahead(line, below);
        if probe_intent::judges(line) {
            self.reader.asks();
        }
        if let Some(macros) = self
            .macros
            .as_mut()
            .filter(|_| memchr::memchr3(b'#', b'[', b'$', line).is_some())
        {
            macros.set_system(self.reader.system());
        }
    }

    /// Behaviour of the program after a probing move.
    fn probes_ahead(&mut self, line: &[u8], below: usize) {
        let Some(touching) = &mut self.reader.run else {
            return;
        };
        if has_probing_code(line) || self.reader.modes.motion.probes() {
            touching.behind = probe_intent::after_probe(line, &self.text[below..]);
        }
    }

    /// Names of subroutines in a text without a main program. They are shown, although their arguments are unknown.
    fn subroutines(&mut self) -> Vec<String> {
        let mut shown = Vec::new();
        let end = Place {
            at: self.text.len(),
            line: self.reader.line,
        };
        while let Some((name, begin)) = self.macros.as_mut().and_then(|macros| macros.uncalled(end))
        {
            self.reader.ended = false;
            (self.reader.place, self.reader.depth) = (self.start, 0);
            self.reader.enters_call();
            let before = self.reader.path.len();
            self.lines(begin);
            shown.extend((self.reader.path.len() > before).then_some(name));
        }
        shown
    }

    /// Treatment of a line. Lines after the end that ran where they were called are not reported.
    #[inline]
    fn step(&mut self, line: &[u8], here: Place, below: usize) -> LineAction {
        let ended = self.reader.ended;
        match &mut self.macros {
            _ if ended && self.calls.has_run(here.line) => LineAction::Skip,
            Some(macros) if ended && macros.has_run(here.line) => LineAction::Skip,
            Some(macros) if !ended && (!self.reader.heidenhain || self.reader.run.is_some()) => {
                let next = Place {
                    at: below,
                    line: here.line + 1,
                };
                let step = macros.step(line, here, next, self.calls.depth());
                for (variable, value) in macros.written() {
                    self.reader.writes_variable(&variable, value);
                }
                step
            }
            _ => LineAction::AsWritten,
        }
    }
}

/// Finding: distance that the axes travel after the contact of the fastest touch.
#[cold]
fn fast(way: f64, feed: f64, unit: &str) -> Finding {
    let message = text!(
        "Touches at up to F{feed}: at 500 mm/s² and after 5 ms the axes run on for {way} after the contact. Check that the stylus takes it, or touch more slowly",
        crate::num::decimal(feed, 1),
        format!("{} {unit}", crate::num::decimal(way, 2))
    );
    Finding::new(Level::Warning, "touch-fast", "", message)
}

/// Finding: a subroutine is shown although nothing calls it.
#[cold]
fn not_called(name: &str) -> Finding {
    let message = text!(
        "{name} is never called in this text: shown with unknown arguments",
        crate::form::printable(name)
    );
    Finding::new(Level::Info, "not-called", "", message)
}

/// Finding: a text has no moves, and whether its semicolons may be the reason.
#[cold]
#[inline(never)]
fn no_moves(text: &str) -> Finding {
    let is_code = |code: &str| {
        matches!(
            code.as_bytes(),
            [
                b'G' | b'g' | b'M' | b'm' | b'X'..=b'Z' | b'x'..=b'z',
                b'0'..=b'9' | b'-' | b'.',
                ..,
            ]
        )
    };
    let hidden = lines_of(text).position(|line| {
        let code = lex::code(line, false);
        line.get(code.len() + 1..)
            .is_some_and(|behind| is_code(trimmed(code)) && is_code(trimmed(behind)))
    });
    let message = match hidden {
        Some(line) => {
            text!(
                "No move was found in this text: the code after a semicolon is a comment, as in line {line}",
                line + 1
            )
        }
        None => text!("No move was found in this text"),
    };
    Finding::new(Level::Warning, "no-moves", "", message)
}
