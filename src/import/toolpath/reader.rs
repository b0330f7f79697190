//! What stays in force from block to block.

use crate::control::iso::codes::Family;
use crate::control::iso::lex::{comment_at, end_of, end_of_value, head, next_word, number, valued};
use crate::control::iso::script::Motion;
use crate::geom::Plane;
use crate::import::toolpath::block::{Axes, Block, Call, Foreign, Fork, ModeChange, Named};
use crate::import::toolpath::count::{Count, count};
use crate::import::toolpath::known::{Feature, Trip};
use crate::import::toolpath::native::{letters, places};
use crate::import::toolpath::rules::Log;
use crate::import::toolpath::system::System;
use crate::import::toolpath::{DIALECTS, Toolpath};

/// What places are, until a motion.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Given {
    /// Where the axes go.
    Place,
    /// Where a cycle runs, from G81 on; G80 ends it, too.
    Cycle,
    /// Control points of a spline; its end ends them, too.
    Control,
}

/// What stays in force from block to block.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Modes {
    pub motion: Motion,
    /// That motion is a curve, straight here.
    pub curve: bool,
    pub given: Given,
    pub absolute: bool,
    /// Whether the program says so.
    pub stated: bool,
    pub centers_absolute: bool,
    pub plane: Option<Plane>,
    /// Units of the path in a unit that the program has now.
    pub scale: f64,
    /// Feeds are not by the minute: G93, G95.
    pub by_other: bool,
    /// X is a diameter: G7.
    pub diameter: bool,
}

/// What a run knows of touches.
pub(super) struct Touching {
    pub touch: Trip,
    pub positioning: Trip,
    /// What probing moves meet, in the place of both.
    pub feature: Option<Feature>,
    /// Whether the next probing move is a positioning move that is watched.
    pub watched: bool,
    /// Whether the program asks behind it for a contact, and whether it reads where it ended.
    pub asked: bool,
    pub reads: bool,
    /// Whether the motion behind it is an alarm after a contact.
    pub chained: bool,
    /// Where the last one ended, in the units of the path, and whether it met something.
    pub contact: [f64; 3],
    pub met: Option<bool>,
}

impl Default for Modes {
    fn default() -> Self {
        Modes {
            motion: Motion::Rapid,
            curve: false,
            given: Given::Place,
            absolute: true,
            stated: false,
            centers_absolute: false,
            plane: None,
            scale: 1.0,
            by_other: false,
            diameter: false,
        }
    }
}

/// Follows a program block by block.
#[derive(Default)]
pub(super) struct Reader {
    pub path: Toolpath,
    /// The first line and the name of each file that is below the program.
    pub files: Vec<(u32, String)>,
    pub line: usize,
    pub sinumerik: bool,
    /// The ISO of a HEIDENHAIN: `%NAME G71 *` begins it.
    pub heidenhain: bool,
    pub place: [f64; 3],
    /// The axes whose place is from before the work system was moved.
    pub stale: Axes,
    /// A code of the block shifts or turns the work system; and whether one did.
    pub turned: bool,
    pub shifted: bool,
    /// What a run knows of touches; none where the text is read only.
    pub run: Option<Touching>,
    /// What happens beside the moves, for the rules.
    pub log: Option<Log>,
    /// The tool that is called next, and the one that was changed to; NaN where it is computed.
    pub next_tool: f64,
    pub tool: Option<f64>,
    pub modes: Modes,
    /// The plane that was chosen first.
    pub plane: Option<Plane>,
    /// The work offset that was selected first.
    pub offset: Option<i32>,
    /// Between `sub` and `endsub`: what stands there runs where it is called.
    pub inside: bool,
    /// How many conditions are open.
    pub conditions: usize,
    /// The conditions of a run that are not known, and whose ways have not met.
    pub forks: Vec<Fork>,
    /// Whether the next move begins elsewhere than where the one before ended.
    pub resumes: bool,
    /// How many loops are open.
    pub loops: usize,
    /// The axes that were last moved by a distance, not to a place.
    pub relative: Axes,
    /// Whether the block before may jump over this one.
    pub leaps: bool,
    /// Whether there was any code: a tape sign `%` before it begins the program, one after it ends it.
    pub begun: bool,
    /// After the end of the program.
    pub ended: bool,
    /// The subprogram that the block calls: where it is followed, whoever gives the lines gives its lines next.
    pub call: Option<Call>,
    /// Whether something was called that is not in this text, or not known: it may set any variable.
    pub called_out: bool,
    /// The same of a macro, which has locals of its own: G65.
    pub called_macro: bool,
    /// Whether the call that is read is an Okuma's.
    pub okuma: bool,
    /// Whether the block goes back to where its subprogram was called from.
    pub returned: bool,
    /// Whether the next line may be another one than the next: after a call, in a subprogram, at its end.
    pub turns_off: bool,
    pub feed: f64,
    /// Whole turns of arcs by P.
    pub turns: f64,
    /// The modes and the feed that M72 gives back.
    pub kept: Option<(Modes, f64)>,
    /// The axes along which a tool has been long.
    pub long: Axes,
    /// Those whose tool length changed after the modes were kept.
    pub lengthened: Axes,
    /// Those that a tool length made unknown: not said yet.
    pub lost: Axes,
    pub skipped: Count,
    pub after_end: Count,
    pub computed: Count,
    pub from_unknown: Count,
    pub arcs_unsolved: Count,
    pub machine: Count,
    pub transformed: Count,
    pub others: Count,
    pub optional: Count,
    pub twice: Count,
    pub aborted: Count,
    pub branches: Count,
    /// Macros of the control's own whose moves are known, and those that stop with an alarm.
    pub own_moves: Count,
    /// The same of a HEIDENHAIN's cycles.
    pub own_cycles: Count,
    /// The same of a SINUMERIK's.
    pub measuring_cycles: Count,
    pub stopped: Count,
    /// Codes that make no place of their axis words, by name.
    pub foreign: Vec<Named>,
    /// The line of the first units, where moves stand above it.
    pub late_units: Option<usize>,
}

impl Reader {
    pub fn new(text: &str, dialect: &'static str) -> Self {
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
            sinumerik: dialect == DIALECTS[1],
            place: [f64::NAN; 3],
            next_tool: f64::NAN,
            feed: f64::NAN,
            ..Reader::default()
        }
    }

    /// What the control itself knows now, in the units of the program.
    pub fn system(&self) -> System {
        let scale = self.modes.scale;
        let now = |axis: usize| {
            if self.stale & (1 << axis) == 0 {
                self.place[axis] / scale
            } else {
                f64::NAN
            }
        };
        let (contact, met) = self
            .run
            .as_ref()
            .map_or(([f64::NAN; 3], None), |run| (run.contact, run.met));
        System {
            place: [now(0), now(1), now(2)],
            contact: contact.map(|x| x / scale),
            met,
            rests: self.run.as_ref().is_some_and(|run| {
                run.met.is_none() && (run.touch != Trip::Unknown || run.feature.is_some())
            }),
            metric: self.path.metric.map(|first| (scale == 1.0) == first),
            absolute: self.modes.stated.then_some(self.modes.absolute),
            plane: self.modes.plane,
            offset: self.offset.filter(|_| self.transformed.times == 0),
            tool: self.tool.filter(|tool| !tool.is_nan()),
            feed: self.feed / scale,
            moves: self.path.len(),
        }
    }

    /// Where the stylus stands, in the units that the program has now.
    pub fn here(&self) -> [f64; 3] {
        self.place.map(|x| x / self.modes.scale)
    }

    pub fn family(&self) -> Family {
        match (self.sinumerik, self.heidenhain) {
            (true, _) => Family::Sinumerik,
            (_, true) => Family::Heidenhain,
            _ => Family::Iso,
        }
    }

    /// Reads one line, into a block that is used again for every line.
    pub fn read(&mut self, line: &[u8], block: &mut Block) {
        let Some(&first) = line.first() else { return };
        if self.plain(line) {
            return;
        }
        if first == b'%' {
            if !self.sinumerik && line.last() == Some(&b'*') {
                return self.heidenhain_head(line);
            }
            // `%_N_PART_MPF` and `%100` name a program.
            self.ended |= self.begun && line[1..].trim_ascii().is_empty();
            return;
        }
        self.begun |= !matches!(first, b'(' | b';');
        if first == b';' || first == b'(' && self.ended {
            return;
        }
        if self.ended && self.heidenhain && line.contains(&b'%') {
            return;
        }
        if self.ended {
            return count(&mut self.after_end, self.line);
        }
        let head = head(line);
        let begin = head.end;
        match line.get(begin) {
            // O words jump, loop and call; alone they number a program.
            Some(b'O' | b'o') if !self.sinumerik => return self.o_word(&line[begin..]),
            _ if self.inside => return,
            Some(b'%') if self.heidenhain => return self.ended = true,
            Some(_) if self.sinumerik => match frame(&line[begin..]) {
                Some(true) => {
                    self.moved_system(7);
                    return count(&mut self.transformed, self.line);
                }
                // Alone it takes the shifts away.
                Some(false) => return,
                None => {}
            },
            _ => {}
        }
        if matches!(line.get(begin), Some(b'C' | b'V' | b'c' | b'v'))
            && !self.sinumerik
            && !self.okuma
        {
            let code = &line[begin..];
            if gives_variable(code) {
                return;
            }
            if let Some(call) = as_g65(code) {
                self.okuma = true;
                self.read(&call, block);
                return self.okuma = false;
            }
        }
        let before = self.modes;
        block.empty();
        block.begin = begin;
        // Between a jump and the end that it leaves out may stand comments, and variables that get a value.
        let leaped = self.leaps;
        self.leaps &= matches!(line.get(begin), Some(b'(' | b'#'));
        self.words(line, block);
        if block.strange {
            return self.pass_strange(line, block, before);
        }
        // With block skip on, the control leaves it out: an end there ends nothing.
        let moves_before = self.path.len();
        self.follow(line, block, before, leaped || head.skips);
        if head.skips && (self.path.len() > moves_before || self.modes != before || block.ends) {
            count(&mut self.optional, self.line);
        }
    }

    /// Takes the words of a block.
    #[inline]
    fn words(&mut self, line: &[u8], block: &mut Block) {
        let mut at = block.begin;
        while at < line.len() {
            at = match line[at] {
                b' ' | b'\t' => at + 1,
                b';' => break,
                // The end of a block on a HEIDENHAIN, and of old.
                b'*' if !self.sinumerik && line[at + 1..].trim_ascii().is_empty() => break,
                b'(' if !self.sinumerik => end_of(line, at, b')'),
                b'@' | b'^' if !self.sinumerik => self.polar(line, at, block),
                letter if letter.is_ascii_alphabetic() => match self.word(line, at, block) {
                    Some(next) => next,
                    None => self.unrecognised(line, at, block),
                },
                _ => self.unrecognised(line, at, block),
            };
        }
    }

    /// Nothing of such a line is a move: it jumps, calls or computes. Where it might go to is not known. Its modes count, unless it jumps.
    #[cold]
    fn pass_strange(&mut self, line: &[u8], block: &Block, before: Modes) {
        if block.jumps {
            self.modes = before;
        }
        self.settle(block, before);
        let here = self.here();
        let cycle = self.sinumerik && runs_cycle(line);
        if cycle && !block.jumps {
            let name =
                String::from_utf8_lossy(&line[block.begin..][..name_length(&line[block.begin..])])
                    .into_owned();
            if self.makes_measuring_cycle(&name, &places(line)) {
                return self.listed(&name, places(line), here);
            }
        }
        let lost = block.foreign == Foreign::Unknown || block.calls.is_some() || cycle;
        let gone = if lost { 7 } else { block.given };
        self.forget(gone);
        // It is said of the line already.
        self.lost &= !gone;
        self.leaps |= block.jumps
            && line[block.begin..]
                .get(..2)
                .is_some_and(|word| word.eq_ignore_ascii_case(b"IF"));
        if !block.jumps {
            let named = |b: &&u8| {
                b.is_ascii_alphabetic() || self.sinumerik && (b.is_ascii_digit() || **b == b'_')
            };
            let word = &line[block.begin..][..line[block.begin..].iter().take_while(named).count()];
            self.branch(word, self.sinumerik);
            if cycle {
                return self.native(&String::from_utf8_lossy(word), places(line), here);
            }
            if let Some(name) = lnc_macro(&line[block.begin..]) {
                return self.native(&name, letters(&line[block.begin + name.len()..]), here);
            }
        }
        count(&mut self.skipped, self.line);
    }

    /// Follows a block of words.
    fn follow(&mut self, line: &[u8], block: &mut Block, before: Modes, leaped: bool) {
        if block.returns {
            // It continues in another line, or goes back.
            if block.p.is_some() {
                self.lose(self.line);
            } else {
                self.returned = !leaped && self.conditions == 0;
                self.turns_off |= self.returned;
                block.ends = true;
            }
        }
        let transformed = self.transformed.times;
        if block.renames && block.given != 0 {
            count(&mut self.transformed, self.line);
        }
        // An end that may be jumped over, or that stands in a condition, ends nothing here.
        self.ended = block.ends && !leaped && self.conditions == 0;
        if block.offset.is_some() | block.writes {
            self.shift(block);
        }
        // A block that only ends a shift changes nothing if no shift is active.
        if (self.transformed.times > transformed || self.turned)
            && (block.given != 0 || block.radius.is_some() || block.offset.is_some())
        {
            // Without a turn these are shifted alone.
            let shifts = (block.writes || block.renames)
                && block.radius.is_none()
                && block.offset.is_none()
                && !self.turned;
            self.moved_system(if shifts { block.given } else { 7 });
        }
        self.turned = false;
        if self.log.is_some() {
            self.logs(line, block);
        }
        self.settle(block, before);
        if block.macros && block.foreign == Foreign::No {
            self.macro_call(line, block);
        } else if block.special && self.pass_by(line, block) {
            return;
        }
        self.place_of(block);
        if let Some(code) = block.calls.filter(|_| block.special) {
            self.call(code, block);
        }
    }

    /// Places along these axes that were given before are of another system from here on.
    #[cold]
    fn moved_system(&mut self, axes: Axes) {
        (self.stale, self.shifted) = (self.stale | axes, true);
        if let Some(run) = &mut self.run {
            (0..3)
                .filter(|axis| axes & (1 << axis) != 0)
                .for_each(|axis| run.contact[axis] = f64::NAN);
        }
    }

    /// What the rules ask for beside moves.
    #[cold]
    fn logs(&mut self, line: &[u8], block: &Block) {
        let timed = || {
            line[block.begin..]
                .iter()
                .any(|b| matches!(b.to_ascii_uppercase(), b'P' | b'X' | b'U' | b'S' | b'F'))
        };
        let waits = block.dwells && !timed();
        let (moves, line) = (self.path.len(), self.line);
        let [units, plane, distance] = [
            self.path.metric.is_some(),
            self.modes.plane.is_some(),
            self.modes.stated,
        ];
        let incremental = !self.modes.absolute;
        let Some(log) = &mut self.log else { return };
        if let Some(on) = block.spindle {
            log.spindle.push((moves, line, on));
        }
        // Work offsets; what tools get is none of them.
        let written = block.writes && block.l.is_some_and(|l| l == 2.0 || l == 20.0);
        if written && (block.given != 0 || block.radius.is_some()) {
            log.writes.push((moves, line));
        }
        if block.given != 0 && !block.elsewhere && log.stated.is_none() {
            log.stated = Some((line, [units, plane, distance]));
        }
        if waits {
            log.endless_waits.push(line);
        }
        log.left_incremental = incremental;
        log.ends |= block.ends;
    }

    /// Goes to the place of a block, where it names one.
    #[inline]
    fn place_of(&mut self, block: &mut Block) {
        let waits = block.dwells && !block.motion && (self.sinumerik || block.p.is_none());
        if block.elsewhere || waits {
            return;
        }
        if block.twice {
            count(&mut self.twice, self.line);
        }
        if block.others {
            count(&mut self.others, self.line);
        }
        if self.modes.given != Given::Place && block.once.is_none() && block.given != 0 {
            if self.modes.given == Given::Cycle {
                return self.lose(self.line);
            }
            self.forget(block.given);
            return count(&mut self.arcs_unsolved, self.line);
        }
        if self.modes.diameter {
            block.places[0] *= 0.5;
        }
        // Without a place, a centre makes a whole circle back to where it begins.
        if block.given | block.centered != 0 {
            self.moves(block);
        } else if block.home {
            self.place = [f64::NAN; 3];
            count(&mut self.machine, self.line);
        }
    }

    /// Something that is no word: nothing of its line is a move. Gives where the next word begins, unless the line jumps.
    fn unrecognised(&mut self, line: &[u8], at: usize, block: &mut Block) -> usize {
        if !block.strange {
            (block.strange, block.jumps) = (true, jumps(line));
        }
        match line[at].to_ascii_uppercase() {
            axis @ b'X'..=b'Z' if !self.sinumerik || valued(line, at) => {
                block.given |= 1 << (axis - b'X')
            }
            b'F' if !self.sinumerik => block.feed = Some(f64::NAN),
            b'A'..=b'P' if self.sinumerik && !block.jumps && begins_curve(&line[at..]) => {
                self.modes.given = Given::Control
            }
            b',' | b'#' | b'A'..=b'Z' => {}
            // The number before may go on: F1 00.
            _ => block.feed = block.feed.map(|_| f64::NAN),
        }
        if block.jumps {
            line.len()
        } else {
            next_word(line, at)
        }
    }

    /// A place by a distance and a direction, `@5 ^30`: the control computes it.
    fn polar(&mut self, line: &[u8], at: usize, block: &mut Block) -> usize {
        let [a, o, _] = self.modes.plane.unwrap_or_default().axes();
        let axes = 1 << a | 1 << o;
        block.given |= axes;
        block.computed |= axes;
        number(line, at + 1).map_or_else(|| end_of_value(line, at + 1), |(_, end)| end)
    }

    /// What a block changes whether or not it is followed: the feed, then the modes that are kept, then the length of the tool.
    fn settle(&mut self, block: &Block, before: Modes) {
        if let Some(feed) = block.feed.filter(|_| !block.feedless) {
            self.feed = feed * self.modes.scale;
        }
        match block.keeps {
            None => {}
            Some(ModeChange::Forget) => self.kept = None,
            Some(ModeChange::GiveBack) => self.give_back(),
            Some(ModeChange::Keep) => (self.kept, self.lengthened) = (Some((before, self.feed)), 0),
        }
        if block.changes {
            self.tool = Some(self.next_tool);
        }
        if block.lengthens {
            // G43.1 names its axes. Others change the length along Z or across the plane, and what G43.1 gave.
            let across = 1 << self.modes.plane.unwrap_or_default().axes()[2];
            let axes = if block.elsewhere && block.given != 0 {
                block.given
            } else {
                4 | across | self.long
            };
            self.long |= axes;
            self.lengthen(axes);
        }
    }

    /// The tool is longer or shorter: these axes stay where they are, and are somewhere else in the work system.
    pub fn lengthen(&mut self, axes: Axes) {
        let known = (0..3)
            .filter(|axis| !self.place[*axis].is_nan())
            .fold(0, |known, axis| known | 1 << axis);
        self.lost |= axes & known;
        self.lengthened |= axes;
        self.forget(axes);
    }

    /// M72: the modes and the feed that M70 kept, whatever its block says beside it. Not the motion, nor the place along a tool whose length
    /// is another one now.
    fn give_back(&mut self) {
        let Some((kept, feed)) = self.kept else {
            return;
        };
        self.modes = Modes {
            motion: self.modes.motion,
            curve: self.modes.curve,
            given: self.modes.given,
            ..kept
        };
        self.feed = feed;
        self.lengthen(self.lengthened);
    }

    /// What moves the system that places are in: another work offset, or one that is written.
    fn shift(&mut self, block: &Block) {
        if let Some(first) = block.offset {
            // G54.1 P2, G154 P2: one of many; without a number it is none that has another name.
            let counted = block
                .p
                .map_or(i32::MAX, |p| first.saturating_add((1000.0 * p) as i32));
            let offset = if block.counts { counted } else { first };
            if self.path.is_empty() {
                self.offset = Some(offset);
            // Moves before any selection were in G54.
            } else if *self.offset.get_or_insert(1) != offset {
                count(&mut self.transformed, self.line);
            }
        }
        // An L that is computed may be any.
        let written = block.writes && block.l.is_some_and(|l| l == 2.0 || l == 20.0 || l.is_nan());
        // R turns it.
        if written && (block.given != 0 || block.radius.is_some()) && !self.path.is_empty() {
            count(&mut self.transformed, self.line);
        }
    }

    /// `o<name> sub`, `o1 if`, `o100if[…]`, `O1000`: blanks mean nothing.
    fn o_word(&mut self, line: &[u8]) {
        let code = line[1..comment_at(line, true).unwrap_or(line.len())].trim_ascii();
        let label = match code.first() {
            Some(b'<') => end_of(code, 0, b'>'),
            Some(b'#' | b'[') => end_of_value(code, 0),
            _ => code
                .iter()
                .take_while(|b| b.is_ascii_digit() || b.is_ascii_whitespace())
                .count(),
        };
        let rest = code[label..].trim_ascii_start();
        let word = &rest[..rest.iter().take_while(|b| b.is_ascii_alphabetic()).count()];
        let is = |keyword: &[u8]| word.eq_ignore_ascii_case(keyword);
        if is(b"sub") {
            self.inside = true;
        } else if is(b"endsub") {
            self.inside = false;
        } else if is(b"call") {
            self.place = [f64::NAN; 3];
        } else {
            self.branch(word, true);
        }
        let alone = label > 0 && rest.is_empty();
        if !alone {
            count(&mut self.skipped, self.line);
        }
    }

    /// `IF` opens a condition and `ENDIF` closes it, but where an `IF` stands alone. What a loop moves by a distance is somewhere else after
    /// its next round. A `WHILE` within a loop may be the end of a `DO`.
    fn branch(&mut self, word: &[u8], conditional: bool) {
        let is = |words: &[&[u8]]| words.iter().any(|name| word.eq_ignore_ascii_case(name));
        if is(&[b"IF"]) {
            self.conditions += usize::from(conditional);
            if conditional {
                self.parts(None);
            }
        } else if is(&[b"ELSE", b"ELSEIF"]) {
            self.other_way(is(&[b"ELSE"]));
        } else if is(&[b"ENDIF"]) {
            self.conditions = self.conditions.saturating_sub(1);
            self.meet(None);
        } else if is(&[b"WHILE", b"DO", b"REPEAT", b"FOR", b"LOOP"]) {
            if self.loops == 0 {
                self.relative = 0;
            } else {
                self.forget(self.relative);
            }
            self.loops += 1;
            self.parts(None);
        } else if is(&[
            b"END",
            b"ENDWHILE",
            b"ENDREPEAT",
            b"ENDFOR",
            b"ENDLOOP",
            b"UNTIL",
        ]) {
            self.loops = self.loops.saturating_sub(1);
            self.forget(self.relative);
            self.meet(None);
        }
    }

    /// The program stops itself: `(ABORT, …)`.
    #[cold]
    pub fn aborts(&mut self) {
        if !self.ended {
            count(&mut self.aborted, self.line);
        }
        self.ended = true;
    }

    /// A branch whose condition is not known ends the program.
    #[cold]
    pub fn branch_ends(&mut self) {
        count(&mut self.branches, self.line);
    }

    /// A condition that asks for something else than a contact.
    pub fn asks(&mut self) {
        if let Some(log) = &mut self.log {
            log.conditions.push((self.path.len(), self.line));
        }
    }

    /// A condition that is not known begins.
    #[cold]
    pub fn condition_begins(&mut self) {
        self.conditions += 1;
        self.parts(None);
        count(&mut self.skipped, self.line);
    }

    /// A loop ends of which it is not known how often it runs: what it moves by a distance is somewhere else after the next round.
    #[cold]
    pub fn loop_ends(&mut self) {
        self.forget(self.relative);
        count(&mut self.skipped, self.line);
    }

    /// These axes are somewhere else.
    pub fn forget(&mut self, axes: Axes) {
        for (axis, place) in self.place.iter_mut().enumerate() {
            if axes & (1 << axis) != 0 {
                *place = f64::NAN;
            }
        }
    }
}

/// `G65 "PROBEX" A54. B1.`: a macro that an LNC calls by its name.
fn lnc_macro(code: &[u8]) -> Option<String> {
    let name = code
        .strip_prefix(b"G65")
        .or_else(|| code.strip_prefix(b"g65"))?
        .trim_ascii_start()
        .strip_prefix(b"\"")?;
    let end = name.iter().position(|b| *b == b'"')?;
    let length = code.len() - name.len() + end + 1;
    Some(String::from_utf8_lossy(&code[..length]).into_owned())
}

/// How long the name is that a call of a SINUMERIK begins with.
fn name_length(code: &[u8]) -> usize {
    code.iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count()
}

fn jumps(line: &[u8]) -> bool {
    line.windows(4)
        .any(|word| word.eq_ignore_ascii_case(b"GOTO"))
}

/// A call of one of Renishaw's macros on an Okuma as the others write it: `CALL O9814 PD=25.` is `G65 P9814 D25.`.
fn as_g65(code: &[u8]) -> Option<Vec<u8>> {
    let mut words = code[..comment_at(code, true).unwrap_or(code.len())]
        .split(|b| b.is_ascii_whitespace())
        .filter(|word| !word.is_empty());
    words
        .next()
        .filter(|word| word.eq_ignore_ascii_case(b"CALL"))?;
    let number = words.next()?.strip_prefix(b"O")?;
    (number.len() == 4 && number.starts_with(b"98") && number.iter().all(u8::is_ascii_digit))
        .then_some(())?;
    let mut call = [b"G65 P", number].concat();
    for word in words {
        let [b'P' | b'p', letter, b'=', value @ ..] = word else {
            return None;
        };
        call.extend([b' ', *letter]);
        call.extend(value);
    }
    Some(call)
}

/// Whether a block gives one of an Okuma's common variables the value of another: nothing moves.
fn gives_variable(code: &[u8]) -> bool {
    let is_variable = |name: &[u8]| matches!(name, [b'V' | b'v', b'C' | b'c' | b'S' | b's', number @ ..] if !number.is_empty() && number.iter().all(u8::is_ascii_digit));
    let mut sides = code.split(|b| *b == b'=').map(<[u8]>::trim_ascii);
    let (left, right) = (sides.next(), sides.next());
    left.is_some_and(is_variable) && right.is_some_and(is_variable) && sides.next().is_none()
}

/// Whether a block of a SINUMERIK shifts, turns, mirrors or scales: none where it does nothing of that, false where it ends it.
fn frame(code: &[u8]) -> Option<bool> {
    const WORDS: [&[u8]; 10] = [
        b"TRANS", b"ATRANS", b"ROT", b"AROT", b"ROTS", b"AROTS", b"SCALE", b"ASCALE", b"MIRROR",
        b"AMIRROR",
    ];
    let word = &code[..code
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count()];
    let known = WORDS.iter().any(|known| word.eq_ignore_ascii_case(known));
    let rest = code[word.len()..].trim_ascii_start();
    let assigned = matches!(rest.first(), Some(b'=' | b':' | b'('));
    (known && !assigned).then(|| !matches!(rest.first(), None | Some(b';')))
}

/// Whether a line is a cycle of a SINUMERIK that leaves the tool somewhere: `CYCLE977(…)`, `POCKET4(…)`. CYCLE832 sets tolerances.
fn runs_cycle(line: &[u8]) -> bool {
    let code = line[head(line).end..].to_ascii_uppercase();
    let names: [&[u8]; 5] = [b"CYCLE", b"POCKET", b"HOLES", b"SLOT", b"LONGHOLE"];
    names.iter().any(|name| code.starts_with(name)) && !code.starts_with(b"CYCLE832")
}

/// Whether a word of a SINUMERIK begins splines, polynomials, involutes, or arcs that are not by centre or radius.
fn begins_curve(code: &[u8]) -> bool {
    const WORDS: [&[u8]; 8] = [
        b"ASPLINE", b"BSPLINE", b"CSPLINE", b"POLY", b"INVCW", b"INVCCW", b"CIP", b"CT",
    ];
    let word = &code[..code
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count()];
    WORDS.iter().any(|known| word.eq_ignore_ascii_case(known))
}
