//! The state of a program at a place: what is active there, and what the blocks below it rely on.

use crate::control::header;
use crate::control::inside::{BEGINS, ENDS};
use crate::control::iso::block::Block;
use crate::control::iso::codes::{Effect, FRAMES, Family, Shift};
use crate::control::iso::lex::{strip_prefix_nocase, trimmed};
use crate::control::iso::script::Motion;
use crate::text::{Text, text};

/// A change of the coordinate system that stays until it is ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Change {
    /// G92.
    Shift,
    /// G52.
    Local,
    /// G68, and `G10 L2` with R.
    Turn,
    Polar,
    /// Scale, mirror, tilted plane.
    Transform,
    Frame,
    Cycle800,
}

/// A modal code: its effect, and as it is written.
type Mode = Option<(Effect, String)>;

/// The state after some lines.
#[derive(Debug, Default)]
pub struct State {
    /// Changes of the coordinate system with their 0-based lines.
    changes: Vec<(Change, usize)>,
    /// Absolute or incremental, feed per minute or otherwise, plane.
    modes: [Mode; 3],
    /// Number of the selected work offset.
    pub offset: Option<i32>,
    /// Loops, conditions and subprograms that are open: the 0-based line, and whether a `while` ends it.
    open: Vec<(usize, bool)>,
    /// The first end or jump without a condition.
    bar: Option<usize>,
    /// Whether the next lines are an inserted program, which jumps to its own end.
    inserted: bool,
}

impl State {
    /// The state after these lines, each with its 0-based number.
    pub fn after(lines: &[(usize, &str)], family: Family) -> State {
        let mut state = State::default();
        for &(index, line) in lines {
            if let Some(comment) = header::comment(line) {
                let is = |words: &str| strip_prefix_nocase(comment, words).is_some();
                state.inserted = is(BEGINS) || state.inserted && !is(ENDS);
                continue;
            }
            let block = Block::of(line, family);
            if !state.inserted {
                state.structure(index, &block);
            }
            state.transform(index, &block);
            state.modes(&block);
        }
        state
    }

    fn set(&mut self, change: Change, line: Option<usize>) {
        self.changes.retain(|(known, _)| *known != change);
        self.changes.extend(line.map(|line| (change, line)));
    }

    /// Changes of the coordinate system by a block.
    fn transform(&mut self, index: usize, block: &Block) {
        let on = |is: bool| is.then_some(index);
        let axes = block.has_axes();
        for (effect, _) in block.effects() {
            match effect {
                Effect::Shift(Shift::Position) if axes => self.set(Change::Shift, on(true)),
                // G50 alone ends a scale.
                Effect::Shift(Shift::Position) | Effect::Elsewhere => {
                    self.set(Change::Transform, None);
                }
                Effect::Shift(Shift::Value) if axes => {
                    self.set(Change::Local, on(!block.is_at_zero()));
                }
                Effect::Shift(Shift::End | Shift::Off) => self.set(Change::Shift, None),
                Effect::Shift(Shift::Back) => self.set(Change::Shift, on(true)),
                Effect::Turn(turns) => {
                    self.set(Change::Turn, on(turns));
                    if !turns {
                        self.set(Change::Transform, None);
                    }
                }
                Effect::Polar(polar) => self.set(Change::Polar, on(polar)),
                Effect::Transform { own_axes: true } => self.set(Change::Transform, on(true)),
                Effect::Setting if block.has(b'R') && block.number(b'L') == Some(2.0) => {
                    self.set(Change::Turn, on(block.number(b'R') != Some(0.0)));
                }
                _ => {}
            }
        }
        let code = trimmed(&block.code);
        if let Some(rest) = code.strip_prefix("CYCLE800(") {
            self.set(Change::Cycle800, on(!rest.starts_with(')')));
        } else if let Some(rest) = FRAMES.iter().find_map(|frame| code.strip_prefix(frame)) {
            self.set(Change::Frame, on(!trimmed(rest).is_empty()));
        }
    }

    /// Modes and the work offset that a block selects.
    fn modes(&mut self, block: &Block) {
        for (effect, code) in block.effects() {
            let group = match effect {
                Effect::Absolute(_) => 0,
                Effect::PerMinute(_) => 1,
                Effect::Plane(_) => 2,
                Effect::Offset(number) => {
                    self.offset = Some(number);
                    continue;
                }
                Effect::OffsetOf(first) => {
                    let number = block.number(b'P').unwrap_or(f64::NAN);
                    self.offset = Some(first + number as i32);
                    continue;
                }
                // Okuma's G15 H selects a work offset.
                Effect::Polar(false) if block.has(b'H') => {
                    self.offset = block.number(b'H').map(|number| number as i32);
                    continue;
                }
                _ => continue,
            };
            self.modes[group] = Some((effect, code));
        }
    }

    /// Structures that a block begins or ends, the end of the program, and jumps.
    fn structure(&mut self, index: usize, block: &Block) {
        let code = trimmed(&block.code);
        // `O100 WHILE`, `O<NAME> SUB`
        let label = code.strip_prefix('O');
        let words = label.map_or(code, |label| {
            label
                .trim_start_matches(|c: char| c != ' ' && c != '>')
                .trim_start_matches(['>', ' '])
        });
        let length = words.find(|c: char| !c.is_ascii_alphanumeric());
        let word = &words[..length.unwrap_or(words.len())];
        let begins = match word {
            "SUB" | "DO" => label.is_some(),
            "WHILE" | "REPEAT" | "IF" | "FOR" | "LOOP" => {
                !code.contains("GOTO") && !code.contains("THEN")
            }
            _ => false,
        };
        let ends_do = word == "WHILE" && self.open.last().is_some_and(|(_, is_do)| *is_do);
        let stops = word == "RET"
            || word.starts_with("GOTO")
            || block.does(|effect| matches!(effect, Effect::End | Effect::Return));
        if ends_do || word.starts_with("END") || word == "UNTIL" {
            self.open.pop();
        } else if begins {
            self.open.push((index, word == "DO"));
        } else if self.open.is_empty() && stops {
            self.bar.get_or_insert(index);
        }
    }

    /// Refuses a place in this state for these lines. `restores`: the lines end with the modes before them.
    pub fn check(&self, own: &State, restores: bool) -> Result<(), Text> {
        let open = self.open.first().map(|(line, _)| *line);
        if let Some(line) = self.bar.or(open) {
            return Err(text!(
                "The place is not reached exactly once, because of line {line} of your program",
                line + 1
            ));
        }
        if let Some((_, line)) = self.changes.first() {
            return Err(text!(
                "A shift, a rotation, a scale or a mirror of line {line} is active there",
                line + 1
            ));
        }
        for modes in self.modes.iter().zip(&own.modes).filter(|_| !restores) {
            if let (Some((before, code)), Some((after, own))) = modes
                && before != after
            {
                return Err(text!(
                    "{before} is active there, and {after} after the inserted lines",
                    code.clone(),
                    own.clone()
                ));
            }
        }
        Ok(())
    }
}

/// Refuses blocks below the inserted lines that move without a motion code or a feed of their own.
pub fn check_below(lines: &[(usize, &str)], family: Family) -> Result<(), Text> {
    let (mut motion, mut feed) = (false, false);
    for &(index, line) in lines {
        let block = Block::of(line, family);
        motion |= block.does(|effect| {
            matches!(
                effect,
                Effect::Motion(_)
                    | Effect::Once(_)
                    | Effect::Curve { .. }
                    | Effect::Cycle
                    | Effect::Home
                    | Effect::ThereAndBack
            )
        });
        feed |= block.has(b'F');
        let moves = block.has_axes() && !block.does(has_own_axes);
        let cuts = block.does(|effect| {
            matches!(
                effect,
                Effect::Motion(Motion::Straight | Motion::Clockwise | Motion::Counter)
            )
        });
        if moves && !motion || cuts && !feed {
            return Err(text!(
                "Line {line} of your program states no motion code or no feed: it would have those of the inserted lines",
                index + 1
            ));
        }
        if motion && feed || block.does(|effect| effect == Effect::End) {
            break;
        }
    }
    Ok(())
}

/// Whether the axis words of a block with this effect are no positions.
fn has_own_axes(effect: Effect) -> bool {
    matches!(
        effect,
        Effect::Length(_)
            | Effect::LengthGiven { .. }
            | Effect::Setting
            | Effect::Dwell
            | Effect::Transform { own_axes: true }
            | Effect::Elsewhere
            | Effect::Shift(_)
            | Effect::Turn(_)
            | Effect::Macro { .. }
            | Effect::Call(_)
            | Effect::Sets
            | Effect::Ahead
    )
}
