//! Changes of the coordinate system in Klartext: presets, datum shifts, rotations.
//!
//! A shift counts from the preset, and a rotation is about the shifted datum. Mirrors, scales, tilted planes, datum tables, and a shift after a rotation are
//! not modelled: then the origin is unknown.

use crate::control::heidenhain::read::transforms;
use crate::import::toolpath::frames::{Frames, Register};
use crate::import::toolpath::klartext::Klartext;
use crate::import::toolpath::reader::Reader;

impl Klartext {
    /// A block that moves the coordinate system; false for any other.
    pub(super) fn datum(&mut self, words: &[&str], reader: &mut Reader) -> bool {
        match words {
            ["CYCL", "DEF", "247", rest @ ..] => {
                let row = rest
                    .iter()
                    .find_map(|word| word.strip_prefix("Q339="))
                    .map_or(f64::NAN, |value| self.value(value));
                let number = if row.is_nan() { i32::MAX } else { row as i32 };
                // It ends the shift and the rotation [R].
                reader.with_frames(|frames, place| {
                    frames.replace_program_shift(0, [0.0; 3], place);
                    frames.select(number, place);
                });
                return false;
            }
            ["CYCL", "DEF", part, rest @ ..] if part.starts_with("7.") && *part != "7.0" => {
                self.shift(rest, reader);
            }
            ["CYCL", "DEF", "10.1", rest @ ..] => self.rotation(rest, reader),
            ["TRANS", "DATUM", "AXIS", rest @ ..] => self.shift(rest, reader),
            ["TRANS", "DATUM", "RESET", ..] => {
                reader.with_frames(|frames, place| {
                    frames.set_shift(Register::Local, (7, [0.0; 3]), false, place);
                });
            }
            _ if transforms(words).is_some_and(|(_, changes)| changes) => {
                reader.with_frames(Frames::lose);
            }
            _ => return false,
        }
        true
    }

    /// `X+10 IY-5`: a shift, axis by axis. `#5` is a row of a table.
    fn shift(&mut self, words: &[&str], reader: &mut Reader) {
        let scale = reader.modes.scale;
        for word in words {
            let (added, axis) = match word.strip_prefix('I') {
                Some(axis) => (true, axis),
                None => (false, *word),
            };
            let Some(number) = ["X", "Y", "Z"]
                .iter()
                .position(|letter| axis.starts_with(letter))
            else {
                reader.with_frames(Frames::lose);
                continue;
            };
            let value = self.value(&axis[1..]) * scale;
            reader.with_frames(|frames, place| {
                frames.set_shift(Register::Local, (1 << number, [value; 3]), added, place);
            });
        }
    }

    /// `ROT+30`, `IROT+5`; 0 ends it.
    fn rotation(&mut self, words: &[&str], reader: &mut Reader) {
        let given = words.iter().find_map(|word| {
            let added = word.starts_with('I');
            let value = word.trim_start_matches('I').strip_prefix("ROT")?;
            Some((added, value.to_owned()))
        });
        let Some((added, value)) = given else {
            return reader.with_frames(Frames::lose);
        };
        let angle = self.value(&value);
        reader.with_frames(|frames, place| {
            if angle == 0.0 && !added {
                frames.end_turn(place);
            } else {
                frames.begin_turn(Some([0.0; 3]), angle, added, place);
            }
        });
    }
}
