//! State that stays active from block to block, and the reading of blocks.

use crate::control::iso::codes::Family;
use crate::control::iso::lex::{comment_at, end_of, end_of_value, head, next_word, number, valued};
use crate::geom::Plane;
use crate::import::toolpath::block::{
    Block, Call, Fork, Length, ModeChange, UnfollowedCode, UnfollowedCount,
};
use crate::import::toolpath::control_kind::ControlKind;
use crate::import::toolpath::count::{Count, count};
use crate::import::toolpath::frames::{Axes, Frames, Position};
use crate::import::toolpath::key::Key;
use crate::import::toolpath::known::{Feature, TriggerAt};
use crate::import::toolpath::modes::{Given, Modes};
use crate::import::toolpath::native::{letters, places};
use crate::import::toolpath::probe_intent::AfterProbe;
use crate::import::toolpath::rules::Log;
use crate::import::toolpath::skipped::{Skip, Skipped};
use crate::import::toolpath::system::System;
use crate::import::toolpath::way::Way;
use crate::import::toolpath::writes::{self, Variable};
use crate::import::toolpath::{DIALECTS, Toolpath};
use crate::path::Stored;

/// Modes saved by M70 and M73.
#[derive(Clone)]
pub(super) struct Kept {
    modes: Modes,
    feed: f64,
    length: Position,
    offset: Option<i32>,
    /// Call depth at whose end they are restored automatically: M73.
    depth: Option<usize>,
}

/// Probe model of a run.
pub(super) struct ProbeModel {
    pub touch: TriggerAt,
    pub positioning: TriggerAt,
    /// Part that probing moves contact; replaces both triggers.
    pub feature: Option<Feature>,
    /// Behaviour of the program after the next probing move.
    pub behind: AfterProbe,
    /// End of the last probing move, in the units of the path, and whether it had a contact.
    pub contact: [f64; 3],
    /// That position in machine coordinates: a work offset that is written later does not change it.
    pub contact_in_machine: [f64; 3],
    pub met: Option<bool>,
}

/// Follows a program block by block.
#[derive(Default)]
pub(super) struct Reader {
    pub path: Toolpath,
    /// First line and name of each file after the program.
    pub files: Vec<(u32, String)>,
    pub line: usize,
    pub sinumerik: bool,
    /// HEIDENHAIN's ISO, which begins with `%NAME G71 *`.
    pub heidenhain: bool,
    /// Position in the active system, in the units of the path.
    pub place: Position,
    /// Coordinate systems.
    pub frames: Frames,
    /// Probe model of a run; `None` if the text is only read.
    pub run: Option<ProbeModel>,
    /// Events beside the moves, for the rules.
    pub log: Option<Log>,
    /// The tool that is called next, and the active one; NaN if it is computed.
    pub next_tool: f64,
    pub tool: Option<f64>,
    pub modes: Modes,
    /// First chosen plane.
    pub plane: Option<Plane>,
    /// Whether the tool axis is at the machine's zero or at its home position.
    pub is_up: bool,
    /// Number of active calls.
    pub depth: usize,
    /// Between `sub` and `endsub`: these lines run at their call.
    pub inside: bool,
    /// Number of open conditions.
    pub conditions: usize,
    /// Unknown conditions of a run whose branches have not met.
    pub forks: Vec<Fork>,
    /// Whether the next move begins elsewhere than at the end of the previous one.
    pub resumes: bool,
    /// Number of open loops.
    pub loops: usize,
    /// Axes that were last moved by a distance instead of to a position.
    pub relative: Axes,
    /// Whether the previous block may jump over this one.
    pub may_skip_next: bool,
    /// Whether there was any code: a tape sign `%` before it begins the program, one after it ends it.
    pub has_code: bool,
    /// After the end of the program.
    pub ended: bool,
    /// Subprogram that the block calls. If it is followed, its lines come next.
    pub call: Option<Call>,
    /// Whether something outside this text, or unknown, was called: it may set any variable.
    pub called_external: bool,
    /// Whether a macro with its own locals was called: G65.
    pub called_macro: bool,
    /// Whether it is one of Renishaw's.
    pub renishaw: bool,
    /// Outputs of the last native cycle, by number: mm or degrees.
    pub outputs: Vec<(u16, f64)>,
    /// Name of the variable with an output of Renishaw's macros, if the control is known.
    pub output_name: Option<fn(Stored) -> String>,
    /// Whether the current call is an Okuma's.
    pub okuma: bool,
    /// Whether the block returns to the caller of its subprogram.
    pub returned: bool,
    /// Whether the next line may come from elsewhere: after a call, in a subprogram, at its end.
    pub may_leave_sequence: bool,
    pub feed: f64,
    /// Whether the program has stated a feed.
    pub states_feed: bool,
    /// Full turns of arcs by P.
    pub turns: f64,
    /// Modes that M72 restores.
    pub kept: Option<Kept>,
    /// Axes on which a tool length offset has been active.
    pub long: Axes,
    /// Axes whose tool length changed after the modes were saved.
    pub lengthened: Axes,
    /// Axes that a tool length made unknown, not reported yet.
    pub lost: Axes,
    pub skipped: Skipped,
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
    /// Native macros with known moves, and those that stop with an alarm.
    pub own_moves: Count,
    /// HEIDENHAIN cycles with known moves, and those that stop with an alarm.
    pub own_cycles: Count,
    /// SINUMERIK cycles with known moves, and those that stop with an alarm.
    pub measuring_cycles: Count,
    pub stopped: Count,
    /// Touches without contact, at which the control stops.
    pub missed: Count,
    /// Whether a touch has stopped the program.
    pub stopped_by_touch: bool,
    /// P in probing blocks, which has a meaning on some controls.
    pub probe_words: Count,
    /// Calls that write if an unknown argument is given.
    pub may_write: Count,
    /// Divisions by zero.
    pub divisions: Count,
    /// Rapids, and other moves, that collide with the given part.
    pub collisions: [Count; 2],
    /// Codes whose axis words are not a position, by name.
    pub foreign: Vec<UnfollowedCount>,
    /// Line of the first units, if moves come before it.
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

    /// Sets work offsets, shift and tool known before the program, by the names of variables.
    pub fn tell(&mut self, set: &[(&str, f64)]) {
        let numbers = set
            .iter()
            .filter_map(|(name, value)| match Key::named(name) {
                Some(Key::Number(number)) => Some((number, *value)),
                _ => None,
            });
        for (number, value) in numbers {
            match writes::of_number(number, self.frames.kind == ControlKind::LinuxCnc) {
                Some(Variable::Offset(offset, axis)) => {
                    self.frames.tell_offset(offset, axis, value);
                }
                Some(Variable::Shift(axis)) => self.frames.tell_shift(axis, value),
                _ if number == 5220 && value.fract() == 0.0 => {
                    self.frames.tell_active(Some(value as i32));
                }
                _ if (5401..=5403).contains(&number) => {
                    self.frames.tell_length((number - 5401) as usize, value);
                }
                _ => {}
            }
        }
        for (name, value) in set {
            if let Some(Variable::Offset(offset, axis)) =
                writes::of_name(&name.to_ascii_uppercase())
            {
                self.frames.tell_offset(offset, axis, *value);
            }
        }
    }

    /// Lines with possible events that are not seen.
    pub fn unread(&self) -> Vec<u32> {
        let unknown = self
            .foreign
            .iter()
            .filter(|named| named.title.is_none() && named.foreign == UnfollowedCode::Unknown)
            .flat_map(|named| &named.count.lines);
        let mut lines: Vec<u32> = self
            .skipped
            .unread()
            .chain(unknown.copied())
            .chain(self.probe_words.lines.iter().copied())
            .chain(self.may_write.lines.iter().copied())
            .collect();
        lines.sort_unstable();
        lines.dedup();
        lines
    }

    /// Values of the control now, in the units of the program.
    pub fn system(&self) -> System {
        let scale = self.modes.scale;
        let to_units = |position: Position| position.map(|x| x / scale);
        let unknown = [f64::NAN; 3];
        let (contact, contact_in_machine, met) =
            self.run.as_ref().map_or((unknown, unknown, None), |run| {
                (run.contact, run.contact_in_machine, run.met)
            });
        System {
            place: to_units(self.place),
            contact: to_units(contact),
            contact_in_machine: to_units(contact_in_machine),
            machine: to_units(self.frames.in_machine(self.place)),
            // In inch the unit of these depends on the machine.
            offsets: self.frames.values().map(|offset| {
                let offset = to_units(offset);
                if self.is_inch() {
                    offset.map(|x| if x == 0.0 { x } else { f64::NAN })
                } else {
                    offset
                }
            }),
            shift: to_units(self.frames.shift()),
            table: to_units(self.frames.table()),
            met,
            rests: self.run.as_ref().is_some_and(|run| {
                run.met.is_none() && (run.touch != TriggerAt::Unknown || run.feature.is_some())
            }),
            metric: self.path.metric.map(|first| (scale == 1.0) == first),
            absolute: self.modes.stated.then_some(self.modes.absolute),
            plane: self.modes.plane,
            offset: self.frames.assumed_active(),
            tool: self.tool.filter(|tool| !tool.is_nan()),
            feed: self.feed / scale,
        }
    }

    pub fn tool_axis(&self) -> usize {
        self.modes.plane.unwrap_or_default().axes()[2]
    }

    /// Position of the stylus in the current units of the program.
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

    /// Reads one line, into a block that is reused for every line.
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
            self.ended |= self.has_code && line[1..].trim_ascii().is_empty();
            return;
        }
        self.has_code |= !matches!(first, b'(' | b';');
        if first == b';' || first == b'(' && self.ended {
            return;
        }
        if self.ended && self.heidenhain && line.contains(&b'%') {
            return;
        }
        if self.ended {
            if !self.stopped_by_touch {
                count(&mut self.after_end, self.line);
            }
            return;
        }
        let head = head(line);
        let begin = head.end;
        match line.get(begin) {
            // O words jump, loop and call; single ones number a program.
            Some(b'O' | b'o') if !self.sinumerik => return self.o_word(&line[begin..]),
            _ if self.inside => return,
            Some(b'%') if self.heidenhain => return self.ended = true,
            Some(_) if self.sinumerik && self.program_frame(&line[begin..]) => return,
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
        // Between a jump and the end that it skips there may be comments and assignments.
        let leaped = self.may_skip_next;
        self.may_skip_next &= matches!(line.get(begin), Some(b'(' | b'#'));
        self.words(line, block);
        if block.has_unrecognised {
            return self.pass_strange(line, block, before);
        }
        // With block skip on, the control omits it: an end there ends nothing.
        let moves_before = self.path.len();
        self.follow(line, block, before, leaped || head.skips);
        if head.skips && (self.path.len() > moves_before || self.modes != before || block.ends) {
            count(&mut self.optional, self.line);
        }
    }

    /// Reads the words of a block.
    #[inline]
    fn words(&mut self, line: &[u8], block: &mut Block) {
        let mut at = block.begin;
        while at < line.len() {
            at = match line[at] {
                b' ' | b'\t' => at + 1,
                b';' => break,
                // End of a block on a HEIDENHAIN, and formerly on others.
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

    /// Skips a line that jumps, calls or computes. Its target is unknown. Its modes count, unless it jumps.
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
                self.listed(&name, places(line), here);
                return;
            }
        }
        let lost = block.foreign == UnfollowedCode::Unknown || block.calls.is_some() || cycle;
        let gone = if lost { 7 } else { block.given };
        self.forget(gone);
        // Already reported for the line.
        self.lost &= !gone;
        self.may_skip_next |= block.jumps
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
        self.skipped
            .count(self.why_strange(&line[block.begin..], block), self.line);
    }

    /// Reason why a line with unrecognised text is not followed.
    fn why_strange(&self, code: &[u8], block: &Block) -> Skip {
        let letters = code
            .iter()
            .take_while(|b| b.is_ascii_alphabetic())
            .count()
            .min(9);
        let word = code[..letters].to_ascii_uppercase();
        const CONDITIONS: [&[u8]; 15] = [
            b"IF",
            b"ELSE",
            b"ELSEIF",
            b"ENDIF",
            b"WHILE",
            b"ENDWHILE",
            b"DO",
            b"END",
            b"REPEAT",
            b"UNTIL",
            b"FOR",
            b"ENDFOR",
            b"LOOP",
            b"ENDLOOP",
            b"ENDREPEAT",
        ];
        if CONDITIONS.contains(&word.as_slice()) {
            Skip::Condition
        } else if block.jumps {
            Skip::Jump
        } else if !runs_cycle(code) && memchr::memchr(b'=', code).is_some() {
            Skip::Value
        } else {
            Skip::Words
        }
    }

    /// Follows a block of words.
    fn follow(&mut self, line: &[u8], block: &mut Block, before: Modes, leaped: bool) {
        if block.returns {
            // It continues on another line, or returns.
            if block.p.is_some() {
                self.lose(Skip::Jump, self.line);
            } else {
                self.returned = !leaped && self.conditions == 0;
                self.may_leave_sequence |= self.returned;
                block.ends = true;
            }
        }
        // An end inside a condition, or one that a jump may skip, ends nothing here.
        self.ended = block.ends && !leaped && self.conditions == 0;
        if block.offset.is_some()
            | block.writes
            | block.distorts
            | block.shift.is_some()
            | block.turns.is_some()
        {
            self.moves_system(block);
        }
        if self.log.is_some() {
            self.logs(line, block);
        }
        self.settle(block, before);
        if block.macros && block.foreign == UnfollowedCode::No {
            self.macro_call(line, block);
        } else if block.needs_reset && self.pass_by(line, block) {
            return;
        }
        self.place_of(block);
        if let Some(code) = block.calls.filter(|_| block.needs_reset) {
            self.call(code, block);
        }
    }

    /// Records events for the rules.
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
        let returns = block.returns && self.depth == 0;
        let is_sure = self.forks.is_empty();
        let Some(log) = &mut self.log else { return };
        match block.spindle {
            Some(true) if !is_sure => log.may_spin.push((moves, line)),
            Some(on) => log.spindle.push((moves, line, on)),
            None => {}
        }
        log.returns |= returns;
        if block.given != 0 && !block.axis_words_are_data && log.stated.is_none() {
            log.stated = Some((line, [units, plane, distance]));
        }
        if waits {
            log.endless_waits.push(line);
        }
        log.ends |= block.ends;
    }

    /// Moves to the position of a block, if it gives one.
    #[inline]
    fn place_of(&mut self, block: &mut Block) {
        let waits = block.dwells && !block.motion && (self.sinumerik || block.p.is_none());
        if block.axis_words_are_data || waits {
            return;
        }
        if block.conflicting_words {
            count(&mut self.twice, self.line);
        }
        if block.others {
            count(&mut self.others, self.line);
        }
        if self.modes.given != Given::Place && block.once.is_none() && block.given != 0 {
            if self.modes.given == Given::Cycle {
                return self.lose(Skip::Canned, self.line);
            }
            self.forget(block.given);
            return count(&mut self.arcs_unsolved, self.line);
        }
        if self.modes.diameter {
            block.places[0] *= 0.5;
        }
        if self.modes.polar {
            let [a, o, _] = self.modes.plane.unwrap_or_default().axes();
            block.computed |= block.given & (1 << a | 1 << o);
        }
        // Without a position, a centre makes a full circle back to its start.
        if block.given | block.centered != 0 {
            self.moves(block);
        } else if block.home {
            (self.place, self.is_up) = ([f64::NAN; 3], true);
            count(&mut self.machine, self.line);
        }
    }

    /// Text that is not a word: nothing of its line is a move. Returns the start of the next word, unless the line jumps.
    fn unrecognised(&mut self, line: &[u8], at: usize, block: &mut Block) -> usize {
        if !block.has_unrecognised {
            (block.has_unrecognised, block.jumps) = (true, jumps(line));
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
            // The number before it may continue: F1 00.
            _ => block.feed = block.feed.map(|_| f64::NAN),
        }
        if block.jumps {
            line.len()
        } else {
            next_word(line, at)
        }
    }

    /// A position by distance and direction, `@5 ^30`: the control computes it.
    fn polar(&mut self, line: &[u8], at: usize, block: &mut Block) -> usize {
        let [a, o, _] = self.modes.plane.unwrap_or_default().axes();
        let axes = 1 << a | 1 << o;
        block.given |= axes;
        block.computed |= axes;
        number(line, at + 1).map_or_else(|| end_of_value(line, at + 1), |(_, end)| end)
    }

    /// Effects of a block whether or not it is followed: feed, saved modes, tool length.
    fn settle(&mut self, block: &Block, before: Modes) {
        if let Some(feed) = block.feed.filter(|_| !block.f_is_not_feed) {
            (self.feed, self.states_feed) = (feed * self.modes.scale, true);
        }
        match block.mode_change {
            None => {}
            Some(ModeChange::Discard) => self.kept = None,
            Some(ModeChange::Restore) => self.give_back(),
            Some(ModeChange::Keep { of_subprogram }) => {
                self.kept = Some(Kept {
                    modes: before,
                    feed: self.feed,
                    length: self.frames.length(),
                    offset: self.frames.assumed_active(),
                    depth: of_subprogram.then_some(self.depth),
                });
                self.lengthened = 0;
            }
        }
        if block.changes {
            self.tool = Some(self.next_tool);
            self.frames.change_tool();
        }
        if let Some(length) = block.changes_tool_length {
            // G43.1 names its axes. Other codes change the length along Z or across the plane, and what G43.1 set.
            let across = 1 << self.modes.plane.unwrap_or_default().axes()[2];
            let axes = if block.axis_words_are_data && block.given != 0 {
                block.given
            } else {
                4 | across | self.long
            };
            self.long |= axes;
            let (values, added) = match length {
                Length::Table => (self.frames.table(), false),
                Length::Nothing => ([0.0; 3], false),
                Length::AxisWords { added } => (self.values(block), added),
            };
            self.lengthen(axes, values, added);
        }
    }

    /// Changes the tool length: these axes stay, and get another position in the work system. NaN is unknown.
    pub fn lengthen(&mut self, axes: Axes, values: Position, added: bool) {
        self.frames.begun = !self.path.is_empty();
        self.lost |= self.frames.set_length(axes, values, added, &mut self.place);
        self.lengthened |= axes;
    }

    /// M72: restores the modes, feed, work offset and tool length that M70 saved, whatever else the block contains. The motion is not restored.
    fn give_back(&mut self) {
        let Some(kept) = self.kept.clone() else {
            return;
        };
        self.modes = Modes {
            motion: self.modes.motion,
            curve: self.modes.curve,
            given: self.modes.given,
            ..kept.modes
        };
        self.feed = kept.feed;
        self.lengthen(self.lengthened, kept.length, false);
        if kept.offset != self.frames.active() {
            self.with_frames(|frames, place| frames.select(kept.offset.unwrap_or(1), place));
        }
    }

    /// A call begins.
    pub fn enters_call(&mut self) {
        self.depth += 1;
    }

    /// A call ends: modes that M73 saved in it are restored.
    #[cold]
    pub fn leaves_call(&mut self) {
        if self
            .kept
            .as_ref()
            .is_some_and(|kept| kept.depth == Some(self.depth))
        {
            self.give_back();
            self.kept = None;
        }
        self.depth = self.depth.saturating_sub(1);
    }

    /// `o<name> sub`, `o1 if`, `o100if[…]`, `O1000`: blanks do not matter.
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
            self.modes.maybe_changed = true;
        } else {
            self.branch(word, true);
        }
        let alone = label > 0 && rest.is_empty();
        if !alone {
            let why = if is(b"call") {
                Skip::Call
            } else if is(b"sub") || is(b"endsub") || is(b"return") {
                Skip::Words
            } else {
                Skip::Condition
            };
            self.skipped.count(why, self.line);
        }
    }

    /// `IF` begins a condition and `ENDIF` ends it; macro B has no `ENDIF`. A `WHILE` inside a loop may end a `DO`.
    fn branch(&mut self, word: &[u8], conditional: bool) {
        let way = match word.to_ascii_uppercase().as_slice() {
            b"IF" if conditional => Way::Begins,
            b"ELSE" => Way::Branches { otherwise: true },
            b"ELSEIF" => Way::Branches { otherwise: false },
            b"ENDIF" => Way::Ends,
            b"WHILE" | b"DO" | b"REPEAT" | b"FOR" | b"LOOP" => Way::LoopBegins,
            b"END" | b"ENDWHILE" | b"ENDREPEAT" | b"ENDFOR" | b"ENDLOOP" | b"UNTIL" => {
                Way::LoopEnds(0)
            }
            _ => return,
        };
        self.follows_way(way);
    }

    /// The program stops itself: `(ABORT, …)`.
    #[cold]
    pub fn aborts(&mut self) {
        if !self.ended {
            count(&mut self.aborted, self.line);
        }
        self.stops();
    }

    /// The program ends here with an alarm: its continuation is unknown.
    #[cold]
    pub fn stops(&mut self) {
        self.ended = true;
        self.path.stopped.get_or_insert(self.line as u32);
    }

    /// A branch with an unknown condition ends the program.
    #[cold]
    pub fn branch_ends(&mut self) {
        count(&mut self.branches, self.line);
    }

    /// A condition that does not check a contact.
    pub fn asks(&mut self) {
        if let Some(log) = &mut self.log {
            log.conditions.push((self.path.len(), self.line));
        }
    }

    /// The program may return from a subprogram to a line, or continue below. Both branches meet at that line.
    #[cold]
    pub fn may_leave(&mut self, to: usize) {
        self.begin_branch(Some(to));
        self.skipped.count(Skip::Condition, self.line);
    }

    /// An unknown condition or loop begins, continues or ends.
    #[cold]
    pub fn goes_unknown_way(&mut self, way: Way) {
        self.follows_way(way);
        self.skipped.count(Skip::Condition, self.line);
    }

    /// Positions that a loop moves by a distance differ after its next round.
    fn follows_way(&mut self, way: Way) {
        match way {
            Way::Begins => {
                self.conditions += 1;
                self.begin_branch(None);
            }
            Way::Branches { otherwise } => self.next_branch(otherwise),
            Way::Ends => {
                self.conditions = self.conditions.saturating_sub(1);
                self.join_branches(None);
            }
            Way::LoopBegins => {
                if self.loops == 0 {
                    self.relative = 0;
                } else {
                    self.forget(self.relative);
                }
                self.loops += 1;
                self.begin_branch(None);
            }
            Way::LoopEnds(axes) => {
                self.loops = self.loops.saturating_sub(1);
                self.forget(self.relative | axes);
                self.join_branches(None);
            }
            Way::LoopLeft(axes) => self.forget(self.relative | axes),
        }
    }

    /// The positions of these axes are unknown.
    pub fn forget(&mut self, axes: Axes) {
        self.is_up &= axes & 1 << self.tool_axis() == 0;
        for (axis, place) in self.place.iter_mut().enumerate() {
            if axes & (1 << axis) != 0 {
                *place = f64::NAN;
            }
        }
    }
}

/// `G65 "PROBEX" A54. B1.`: a macro that an LNC calls by name.
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

/// Length of the name at the start of a SINUMERIK's call.
fn name_length(code: &[u8]) -> usize {
    code.iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
        .count()
}

fn jumps(line: &[u8]) -> bool {
    line.windows(4)
        .any(|word| word.eq_ignore_ascii_case(b"GOTO"))
}

/// An Okuma's call of one of Renishaw's macros in the notation of the others: `CALL O9814 PD=25.` is `G65 P9814 D25.`.
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

/// Whether a block copies one of an Okuma's common variables to another: nothing moves.
fn gives_variable(code: &[u8]) -> bool {
    let is_variable = |name: &[u8]| matches!(name, [b'V' | b'v', b'C' | b'c' | b'S' | b's', number @ ..] if !number.is_empty() && number.iter().all(u8::is_ascii_digit));
    let mut sides = code.split(|b| *b == b'=').map(<[u8]>::trim_ascii);
    let (left, right) = (sides.next(), sides.next());
    left.is_some_and(is_variable) && right.is_some_and(is_variable) && sides.next().is_none()
}

/// Whether a line is a SINUMERIK cycle with an unknown end position: `CYCLE977(…)`, `POCKET4(…)`. CYCLE832 sets tolerances.
fn runs_cycle(line: &[u8]) -> bool {
    let code = line[head(line).end..].to_ascii_uppercase();
    let names: [&[u8]; 5] = [b"CYCLE", b"POCKET", b"HOLES", b"SLOT", b"LONGHOLE"];
    names.iter().any(|name| code.starts_with(name)) && !code.starts_with(b"CYCLE832")
}

/// Whether a word of a SINUMERIK begins splines, polynomials, involutes, or arcs without centre or radius.
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
