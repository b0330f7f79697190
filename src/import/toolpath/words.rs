//! Effects of words: G codes by their number, positions, and the names of a SINUMERIK.

use crate::control::iso::codes::{Effect, effect};
use crate::control::iso::lex::{end_of_value, is_first_word, number};
use crate::control::iso::script::Motion;
use crate::import::toolpath::block::{Block, Length, ModeChange, UnfollowedCode, Word};
use crate::import::toolpath::count::count;
use crate::import::toolpath::modes::Given;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::skipped::Skip;
use crate::num::read_digits;

/// What follows a letter.
enum Value {
    /// A value and its end.
    Is(Word, usize),
    /// The letter belongs to a label, with its end.
    Label(usize),
    /// The letter begins a name.
    Named,
}

impl Reader {
    /// Reads the word at `at` and returns the start of the next one; `None` if it is not a word.
    pub(super) fn word(&mut self, line: &[u8], at: usize, block: &mut Block) -> Option<usize> {
        let letter = line[at].to_ascii_uppercase();
        let (word, end) = match self.value(line, at, letter)? {
            Value::Is(word, end) => (word, end),
            Value::Label(end) => return Some(end),
            Value::Named => return self.name(line, at, block),
        };
        match (letter, word) {
            // Arguments of a macro: `G65 P9814 D25. M2.` ends no program.
            (b'M' | b'T', _) if block.macros => {}
            (b'X'..=b'Z', word) => {
                let axis = letter - b'X';
                block.conflicting_words |= block.given & (1 << axis) != 0;
                block.given |= 1 << axis;
                match word {
                    Word::Number(x) => block.places[usize::from(axis)] = x,
                    Word::Placed(x, place) => {
                        block.places[usize::from(axis)] = x;
                        *if place {
                            &mut block.placed
                        } else {
                            &mut block.moved
                        } |= 1 << axis;
                        block.needs_reset = true;
                    }
                    Word::Computed => block.computed |= 1 << axis,
                }
            }
            (b'I'..=b'K', word) => {
                let axis = letter - b'I';
                // On a HEIDENHAIN it is the pole of circles, which is modal: not followed.
                block.centered |= u8::from(!self.heidenhain) << axis;
                // A computed centre gives no arc.
                block.center[usize::from(axis)] = word.number();
            }
            (b'F', word) => block.feed = Some(word.number()),
            (b'R', word) => block.radius = Some(word.number()),
            (b'G', Word::Number(x)) => {
                let foreign = self.code(effect(self.family(), letter, tenths(x)), block);
                // Whether a G31 probes depends on its other words.
                if foreign == UnfollowedCode::No && block.once == Some(Motion::MayTouch) {
                    (block.name, block.needs_reset) = ([at, end], true);
                }
                if foreign > block.foreign {
                    (block.foreign, block.name, block.needs_reset) = (foreign, [at, end], true);
                }
            }
            (b'G', _) if block.foreign < UnfollowedCode::Computed => {
                (block.foreign, block.needs_reset) = (UnfollowedCode::Computed, true);
            }
            (b'M', Word::Number(x)) => {
                let led = self.code(effect(self.family(), letter, tenths(x)), block);
                if led != UnfollowedCode::No && is_first_word(line, block.begin, at) {
                    (block.leading_m_code, block.name, block.needs_reset) = (led, [at, end], true);
                }
            }
            // A tool's edge has its length from here on.
            (b'D', _) if self.sinumerik => block.changes_tool_length = Some(Length::Table),
            // A subprogram: L100 P2.
            (b'L', _) if self.sinumerik => {
                self.lose(Skip::Call, self.line);
            }
            (b'L', word) => block.l = Some(word.number()),
            (b'P', word) => block.p = Some(word.number()),
            (b'T', word) => self.next_tool = word.number(),
            (b'A'..=b'C' | b'U'..=b'W', _) => block.others = true,
            _ => {}
        }
        Some(end)
    }

    /// Value after the letter of a word; `None` for anything else.
    #[inline]
    fn value(&self, line: &[u8], at: usize, letter: u8) -> Option<Value> {
        let next = skip_blanks(line, at + 1);
        let first = *line.get(next)?;
        // `Z-5` and `Z - 5`.
        let after_sign = if matches!(first, b'-' | b'+') {
            skip_blanks(line, next + 1)
        } else {
            next
        };
        Some(match first {
            b'-' | b'+' if matches!(line.get(after_sign), Some(b'#' | b'[')) => {
                Value::Is(Word::Computed, end_of_value(line, after_sign))
            }
            b'0'..=b'9' | b'.' | b'-' | b'+' => {
                let (size, length) = read_digits(line.get(after_sign..)?)?;
                let number = if first == b'-' { -size } else { size };
                let end = after_sign + length;
                match line.get(end) {
                    // `R1=5` sets a variable.
                    Some(b'=') => return None,
                    // A label: `L1: G1 X5`.
                    Some(b':') if self.sinumerik => return Some(Value::Label(end + 1)),
                    _ => {}
                }
                Value::Is(Word::Number(number), end)
            }
            b'#' | b'[' => Value::Is(Word::Computed, end_of_value(line, next)),
            b'=' if self.sinumerik => {
                let (word, end) =
                    by_its_own(line, next + 1).unwrap_or_else(|| assigned(line, next + 1));
                Value::Is(word, end)
            }
            // Result of a function: XSIN[30].
            _ if !self.sinumerik && matches!(letter, b'X'..=b'Z' | b'F') => {
                let name = line[next..]
                    .iter()
                    .take(7)
                    .take_while(|b| b.is_ascii_alphabetic())
                    .count();
                if line.get(next + name) != Some(&b'[') {
                    return None;
                }
                Value::Is(Word::Computed, end_of_value(line, next))
            }
            _ => Value::Named,
        })
    }

    /// A word with several letters: `MEAS=1`, `CR = 5`, `SPOS=0`, or a label.
    fn name(&mut self, line: &[u8], at: usize, block: &mut Block) -> Option<usize> {
        if !self.sinumerik {
            return None;
        }
        let past_blanks = |at: usize| {
            at + line[at..]
                .iter()
                .take_while(|b| matches!(b, b' ' | b'\t'))
                .count()
        };
        // No name is longer.
        let end = at
            + line[at..]
                .iter()
                .take(32)
                .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
                .count();
        let name = &line[at..end];
        match line.get(past_blanks(end)) {
            Some(b':') if line.get(end) == Some(&b':') => return Some(end + 1),
            Some(b'=') => {}
            _ => return None,
        }
        let value = past_blanks(past_blanks(end) + 1);
        // A number ends at the next word: MEAS=1G1X5.
        let stated = number(line, value);
        let stop = stated.map_or_else(|| end_of_value(line, value), |(_, end)| end);
        let is = |word: &[u8]| name.eq_ignore_ascii_case(word);
        if is(b"MEAS") || is(b"MEAW") {
            block.once = Some(Motion::MayTouch);
        } else if is(b"CR") {
            block.radius = Some(stated.map_or(f64::NAN, |(radius, _)| radius));
        } else if !(is(b"SPOS") || is(b"SPOSA")) {
            return None;
        }
        (stop > value).then_some(stop)
    }

    /// Applies the effect of a code. Axis words are a position only under codes that leave them one.
    fn code(&mut self, effect: Option<Effect>, block: &mut Block) -> UnfollowedCode {
        let Some(effect) = effect else {
            // It may run a native macro.
            self.called_external = true;
            return UnfollowedCode::Unknown;
        };
        match effect {
            Effect::Motion(motion) => self.go(motion, block),
            Effect::Curve { stays: true } => {
                self.go(Motion::Straight, block);
                self.modes.curve = true;
            }
            Effect::Curve { stays: false } => {
                (block.once, block.curve) = (Some(Motion::Straight), true)
            }
            Effect::Once(motion) => block.once = Some(motion),
            Effect::ControlPoints(on) => {
                self.modes.given = if on { Given::Control } else { Given::Place }
            }
            Effect::Cycle => self.modes.given = Given::Cycle,
            Effect::CycleEnds => self.modes.given = Given::Place,
            Effect::Plane(plane) => {
                self.plane.get_or_insert(plane);
                self.modes.plane = Some(plane);
            }
            Effect::Metric(metric) => self.units(metric),
            Effect::Absolute(absolute) => {
                (self.modes.absolute, self.modes.stated) = (absolute, true);
                self.modes.unsure.distance = false;
                self.modes.maybe_changed = false;
            }
            Effect::CentersAbsolute(absolute) => self.modes.centers_absolute = absolute,
            // A feed stays in the mode in which it was stated.
            Effect::PerMinute(on) if on != self.modes.by_other => {}
            Effect::PerMinute(on) => (self.modes.by_other, self.feed) = (!on, f64::NAN),
            Effect::Diameter(on) => self.modes.diameter = on,
            Effect::Dwell => {
                (block.dwells, block.f_is_not_feed) = (
                    true,
                    block.f_is_not_feed || self.sinumerik || self.heidenhain,
                )
            }
            Effect::Setting => (block.axis_words_are_data, block.writes) = (true, true),
            Effect::Length(counts) => {
                block.changes_tool_length = Some(if counts {
                    Length::Table
                } else {
                    Length::Nothing
                });
            }
            Effect::LengthGiven { added } => {
                (block.axis_words_are_data, block.changes_tool_length) =
                    (true, Some(Length::AxisWords { added }));
            }
            Effect::Tool => {
                block.changes = true;
                if self.sinumerik {
                    block.changes_tool_length = Some(Length::Table);
                }
            }
            Effect::Elsewhere => block.axis_words_are_data = true,
            Effect::Shift(shift) => (block.axis_words_are_data, block.shift) = (true, Some(shift)),
            Effect::Turn(begins) => {
                (block.axis_words_are_data, block.turns) =
                    (block.axis_words_are_data || begins, Some(begins));
            }
            Effect::Polar(on) => self.modes.polar = on,
            Effect::Transform { own_axes } => {
                (block.axis_words_are_data, block.distorts) =
                    (block.axis_words_are_data | own_axes, own_axes);
                count(&mut self.transformed, self.line);
            }
            Effect::ThereAndBack => {
                block.axis_words_are_data = true;
                self.skipped.count(Skip::Canned, self.line);
            }
            Effect::Macro { takes_feed: true } => {
                (
                    block.axis_words_are_data,
                    block.f_is_not_feed,
                    block.macros,
                    block.needs_reset,
                ) = (true, true, true, true);
            }
            Effect::Macro { takes_feed: false } => {
                block.axis_words_are_data = true;
                self.lose(Skip::Canned, self.line);
            }
            Effect::Offset(number) => block.offset = Some(number),
            Effect::OffsetOf(from) => (block.offset, block.counts) = (Some(from), true),
            Effect::Machine => block.machine = true,
            Effect::Home => (block.machine, block.home) = (true, true),
            Effect::Keep { of_subprogram } => {
                block.mode_change = Some(ModeChange::Keep { of_subprogram });
            }
            Effect::Forget => block.mode_change = Some(ModeChange::Discard),
            Effect::GiveBack => block.mode_change = Some(ModeChange::Restore),
            Effect::End => block.ends = true,
            Effect::Return => {
                block.returns = true;
                return UnfollowedCode::Unknown;
            }
            Effect::Call(code) => {
                (block.calls, block.needs_reset) = (Some(code), true);
                return UnfollowedCode::Unknown;
            }
            Effect::Contact(motion) => {
                block.contact = Some(motion);
                return UnfollowedCode::Unknown;
            }
            Effect::Sets | Effect::Ahead => return UnfollowedCode::Sets,
            Effect::ProbeFeed => {
                (block.f_is_not_feed, self.states_feed) = (true, true);
                return UnfollowedCode::Sets;
            }
            Effect::Spindle(on) => block.spindle = Some(on),
            Effect::Exact(_) | Effect::Halt | Effect::Pause | Effect::Nothing => {}
        }
        UnfollowedCode::No
    }

    fn go(&mut self, motion: Motion, block: &mut Block) {
        block.conflicting_words |= block.motion;
        self.modes.unsure.motion = false;
        (
            self.modes.motion,
            self.modes.curve,
            self.modes.given,
            block.motion,
        ) = (motion, false, Given::Place, true);
    }

    pub(super) fn units(&mut self, metric: bool) {
        if self.path.metric.is_none() && !self.path.is_empty() {
            self.late_units = Some(self.line);
        }
        let first = *self.path.metric.get_or_insert(metric);
        self.modes.scale = match (first, metric) {
            (true, false) => 25.4,
            (false, true) => 1.0 / 25.4,
            _ => 1.0,
        };
    }
}

/// Ten times the number of a code. For more decimals, or too large a number, a number that no code has.
pub(super) fn tenths(code: f64) -> i32 {
    let tenths = (code * 10.0 + 0.5) as i32;
    if (f64::from(tenths) - code * 10.0).abs() < 1e-6 {
        tenths
    } else {
        -1
    }
}

/// The assigned value in `X=5`, and its end.
fn assigned(line: &[u8], at: usize) -> (Word, usize) {
    // A number ends at the next word: X=5Y3. Otherwise it is a part of a sum: X=5+R1.
    let end = end_of_value(line, at);
    let whole = |stop: usize| stop == end || line[stop].is_ascii_alphabetic();
    match number(line, at).filter(|(_, stop)| whole(*stop)) {
        Some((number, stop)) => (Word::Number(number), stop),
        None => (Word::Computed, end),
    }
}

/// The number in `AC(5)` or `IC(5)`, a position (true) or a distance, and its end.
fn by_its_own(line: &[u8], at: usize) -> Option<(Word, usize)> {
    let past_blanks = |at: usize| {
        at + line[at..]
            .iter()
            .take_while(|b| matches!(b, b' ' | b'\t'))
            .count()
    };
    let begin = past_blanks(at);
    let word = line.get(begin..begin + 2)?;
    let place = word.eq_ignore_ascii_case(b"AC");
    let open = past_blanks(begin + 2);
    if !(place || word.eq_ignore_ascii_case(b"IC")) || line.get(open) != Some(&b'(') {
        return None;
    }
    let (x, end) = number(line, past_blanks(open + 1))?;
    let close = past_blanks(end);
    (line.get(close) == Some(&b')')).then_some((Word::Placed(x, place), close + 1))
}

/// Next non-blank position.
fn skip_blanks(line: &[u8], mut at: usize) -> usize {
    while matches!(line.get(at), Some(b' ' | b'\t')) {
        at += 1;
    }
    at
}
