//! Blocks that move the coordinate system: work offsets, shifts, rotations.

use crate::control::iso::codes::Shift;
use crate::control::iso::lex::number;
use crate::import::toolpath::block::Block;
use crate::import::toolpath::control_kind::{ControlKind, counted};
use crate::import::toolpath::count::count;
use crate::import::toolpath::frames::{Axes, Frames, Position, Register};
use crate::import::toolpath::reader::Reader;

impl Reader {
    /// Changes the system. Reports it if the system is unknown afterwards.
    pub(super) fn with_frames(&mut self, change: impl FnOnce(&mut Frames, &mut Position)) {
        let begun = !self.path.is_empty();
        // A text that is only read is read on as written.
        self.frames.begun = begun && self.run.is_some();
        let was_known = self.frames.is_known();
        change(&mut self.frames, &mut self.place);
        let guessed = self.frames.take_guess() && begun;
        if guessed || was_known && !self.frames.is_known() {
            count(&mut self.transformed, self.line);
        }
    }

    /// Numbers of a block in the units of the path; NaN is unknown.
    pub(super) fn values(&self, block: &Block) -> Position {
        let half = if self.modes.diameter { 0.5 } else { 1.0 };
        [0, 1, 2].map(|axis: usize| {
            if block.computed & (1 << axis) != 0 {
                return f64::NAN;
            }
            let x = block.places[axis] * self.modes.scale;
            if axis == 0 { x * half } else { x }
        })
    }

    /// Effect of a block on the system.
    #[cold]
    #[inline(never)]
    pub(super) fn moves_system(&mut self, block: &Block) {
        let given = (block.given, self.values(block));
        if let Some(first) = block.offset {
            // PlanetCNC counts on from G59 by P.
            let is_more = self.frames.kind == ControlKind::PlanetCnc && first == 6;
            let number = if is_more && block.p.is_some() {
                block
                    .p
                    .filter(|p| p.fract() == 0.0)
                    .map_or(i32::MAX, |p| p as i32)
            } else if block.counts {
                counted(first, block.p.unwrap_or(f64::NAN))
            } else {
                first
            };
            self.with_frames(|frames, place| frames.select(number, place));
        }
        if block.writes {
            self.writes_setting(block, given);
        }
        match block.shift {
            Some(Shift::Position) if given.0 != 0 => {
                self.wrote_shift(given);
                self.with_frames(|frames, place| frames.shift_to(given.0, given.1, place));
            }
            Some(Shift::Value) if given.0 != 0 => {
                let added = !self.modes.absolute && self.heidenhain;
                self.with_frames(|frames, place| {
                    frames.set_shift(Register::Local, given, added, place)
                });
            }
            Some(Shift::Position | Shift::Value) | None => {}
            // PlanetCNC sets the active work offset with it.
            Some(Shift::End) if given.0 != 0 && self.frames.kind == ControlKind::PlanetCnc => {
                self.wrote_any();
                self.with_frames(|frames, place| frames.forget(given.0, place));
            }
            Some(end @ (Shift::End | Shift::Off)) => {
                self.with_frames(|frames, place| frames.end_shift(end == Shift::End, place));
            }
            Some(Shift::Back) => self.with_frames(Frames::bring_shift_back),
        }
        match block.turns {
            Some(true) => self.begins_turn(block, given),
            Some(false) => self.with_frames(Frames::end_turn),
            None => {}
        }
        if block.distorts && (block.given != 0 || block.radius.is_some()) {
            self.with_frames(Frames::lose);
        }
    }

    /// `G68 X Y R`: about a centre, or about the stylus position.
    fn begins_turn(&mut self, block: &Block, (axes, values): (Axes, Position)) {
        let level = self.modes.plane.unwrap_or_default().axes()[2] == 2;
        let angle = block.radius.unwrap_or(f64::NAN);
        let center = (axes & 3 == 3).then_some(values);
        let partly = center.is_none() && axes & 3 != 0;
        // RepRapFirmware rotates in the opposite direction.
        let other = self.frames.kind == ControlKind::RepRap;
        if !level || partly || other || !self.modes.absolute {
            return self.with_frames(Frames::lose);
        }
        self.with_frames(|frames, place| frames.begin_turn(center, angle, false, place));
    }

    /// `G10`: a work offset by its L and P.
    fn writes_setting(&mut self, block: &Block, given: (Axes, Position)) {
        let kind = self.frames.kind;
        let angle = block.radius;
        let Some(l) = block.l else {
            // A Fanuc writes a tool by P only.
            if block.p.is_some() && (given.0 != 0 || angle.is_some()) {
                self.wrote_tool(block, 0.0, given);
            }
            return;
        };
        if l.is_nan() {
            self.wrote_any();
            return self.with_frames(|frames, place| frames.forget(7, place));
        }
        if given.0 == 0 && angle.is_none() {
            return;
        }
        if l != 2.0 && l != 20.0 {
            return self.wrote_tool(block, l, given);
        }
        let number = block.p.filter(|p| *p != 0.0);
        if number.is_some_and(f64::is_nan) {
            self.wrote_any();
            return self.with_frames(|frames, place| frames.forget(given.0, place));
        }
        let number = number.map(|p| p as i32);
        if block.p == Some(0.0) && l == 2.0 && kind.has_external_offset() {
            self.wrote_external(given);
            let added = !self.modes.absolute;
            return self.with_frames(|frames, place| {
                frames.set_shift(Register::External, given, added, place)
            });
        }
        if l == 20.0 && !kind.counts_by_l20() {
            self.wrote_offset(number, given, None);
            return self.with_frames(|frames, place| {
                frames.write_position(number, given.0, given.1, place)
            });
        }
        let number = if l == 20.0 {
            number.map(|p| counted(6, f64::from(p)))
        } else {
            number
        };
        let added = !self.modes.absolute && kind.adds_settings();
        // Whether G91 adds depends on the control.
        let ambiguous = !self.modes.absolute && kind == ControlKind::Unknown;
        let given = if ambiguous {
            (given.0, [f64::NAN; 3])
        } else {
            given
        };
        // Rotations on other controls are not modelled.
        let angle = angle.map(|angle| {
            if kind == ControlKind::LinuxCnc || angle == 0.0 {
                angle
            } else {
                f64::NAN
            }
        });
        self.wrote_offset(number, given, angle);
        self.with_frames(|frames, place| frames.write_value(number, given, angle, added, place));
    }

    /// A frame set by a SINUMERIK program: `TRANS X5`, `AROT RPL=30`. False for any other block.
    pub(super) fn program_frame(&mut self, code: &[u8]) -> bool {
        const WORDS: [&str; 10] = [
            "TRANS", "ATRANS", "ROT", "AROT", "ROTS", "AROTS", "SCALE", "ASCALE", "MIRROR",
            "AMIRROR",
        ];
        let length = code
            .iter()
            .take_while(|b| b.is_ascii_alphanumeric() || **b == b'_')
            .count();
        let name = &code[..length];
        let Some(word) = WORDS
            .into_iter()
            .find(|word| name.eq_ignore_ascii_case(word.as_bytes()))
        else {
            return false;
        };
        let rest = code[length..].trim_ascii_start();
        if matches!(rest.first(), Some(b'=' | b':' | b'(')) {
            return false;
        }
        let scale = self.modes.scale;
        match (word, arguments(rest)) {
            (
                _,
                Some(Arguments {
                    axes: 0,
                    plane: None,
                    ..
                }),
            ) => {
                self.with_frames(|frames, place| frames.replace_program_shift(0, [0.0; 3], place));
            }
            (
                "TRANS",
                Some(Arguments {
                    axes,
                    values,
                    plane: None,
                }),
            ) => {
                let values = values.map(|x| x * scale);
                self.with_frames(|frames, place| frames.replace_program_shift(axes, values, place));
            }
            (
                "ATRANS",
                Some(Arguments {
                    axes,
                    values,
                    plane: None,
                }),
            ) => {
                let given = (axes, values.map(|x| x * scale));
                self.with_frames(|frames, place| {
                    frames.set_shift(Register::Local, given, true, place)
                });
            }
            ("ROT" | "AROT", Some(given)) if given.turn().is_some() => {
                let angle = given.turn().unwrap_or(f64::NAN);
                let level = self.modes.plane.unwrap_or_default().axes()[2] == 2;
                let added = word == "AROT";
                self.with_frames(|frames, place| {
                    if !level {
                        return frames.lose(place);
                    }
                    if !added {
                        frames.replace_program_shift(0, [0.0; 3], place);
                    }
                    frames.begin_turn(Some([0.0; 3]), angle, added, place);
                });
            }
            _ => self.with_frames(Frames::lose),
        }
        true
    }
}

/// Arguments after the word of a frame.
struct Arguments {
    axes: Axes,
    values: Position,
    /// `RPL=30`: a rotation in the plane.
    plane: Option<f64>,
}

impl Arguments {
    /// A rotation about the tool axis of G17.
    fn turn(&self) -> Option<f64> {
        match (self.axes, self.plane) {
            (0, Some(angle)) => Some(angle),
            (4, None) => Some(self.values[2]),
            _ => None,
        }
    }
}

/// `X5 Y=3`, `RPL=30`; `None` for anything else. A value that is not a number is unknown.
fn arguments(rest: &[u8]) -> Option<Arguments> {
    let mut found = Arguments {
        axes: 0,
        values: [0.0; 3],
        plane: None,
    };
    let mut at = 0;
    while at < rest.len() {
        match rest[at].to_ascii_uppercase() {
            b' ' | b'\t' => at += 1,
            b';' => break,
            letter => {
                let plane = rest[at..]
                    .get(..3)
                    .is_some_and(|word| word.eq_ignore_ascii_case(b"RPL"));
                if !plane && !letter.is_ascii_uppercase() {
                    return None;
                }
                at += if plane { 3 } else { 1 };
                while matches!(rest.get(at), Some(b' ' | b'\t' | b'=')) {
                    at += 1;
                }
                let (value, end) = number(rest, at)?;
                at = end;
                match letter {
                    _ if plane => found.plane = Some(value),
                    b'X'..=b'Z' => {
                        let axis = usize::from(letter - b'X');
                        found.axes |= 1 << axis;
                        found.values[axis] = value;
                    }
                    _ => return None,
                }
            }
        }
    }
    Some(found)
}
