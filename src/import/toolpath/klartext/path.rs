//! Path functions: straight moves, circles about a pole or by their radius, polar coordinates.

use crate::control::iso::script::Motion;
use crate::import::toolpath::block::{Block, EMPTY};
use crate::import::toolpath::count::count;
use crate::import::toolpath::klartext::Klartext;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::script::expression::Cursor;
use crate::import::toolpath::script::variables::Value;
use crate::import::toolpath::skipped::Skip;

/// First words of path functions.
const PATHS: [&str; 14] = [
    "L", "LP", "LN", "C", "CP", "CR", "CT", "CTP", "CC", "RND", "CHF", "APPR", "DEP", "FPOL",
];

/// Words of a path block, longer ones first.
const WORDS: [&str; 32] = [
    "IPA", "IPR", "IX", "IY", "IZ", "IA", "IB", "IC", "IU", "IV", "IW", "PA", "PR", "DR", "FMAX",
    "FAUTO", "R0", "RL", "RR", "LEN", "X", "Y", "Z", "A", "B", "C", "U", "V", "W", "F", "R", "M",
];

/// Whether a block begins with a path function.
pub(super) fn is_path(word: &str) -> bool {
    PATHS.contains(&word)
        || word
            .strip_prefix('L')
            .is_some_and(|rest| rest.starts_with(['X', 'Y', 'Z']))
}

/// Words of a path block.
#[derive(Default)]
struct Said {
    /// X, Y, Z: a position or a distance.
    axes: [Option<(f64, bool)>; 3],
    others: bool,
    /// Polar radius and angle, and whether the angle is incremental.
    radius: Option<f64>,
    angle: Option<(f64, bool)>,
    /// Radius of an arc.
    arc: Option<f64>,
    counter: Option<bool>,
    rapid: bool,
    feed: Option<f64>,
    machine: bool,
    calls: bool,
    ends: bool,
    /// Something is not understood.
    strange: bool,
}

impl Klartext {
    /// Follows the block of a path function; returns whether it ends the program.
    pub(super) fn path(&mut self, text: &str, reader: &mut Reader) -> bool {
        let kind = text.split_whitespace().next().unwrap_or_default();
        let kind = PATHS
            .into_iter()
            .find(|known| *known == kind)
            .unwrap_or("L");
        let mut rest = &text[kind.len()..];
        // APPR LT, DEP LCT …: the kind of approach.
        if matches!(kind, "APPR" | "DEP") {
            rest = rest.trim_start();
            rest = &rest[rest.find(char::is_whitespace).unwrap_or(rest.len())..];
        }
        let said = self.said(rest);
        if said.strange {
            self.strange(reader);
            return said.ends;
        }
        if let Some(feed) = said.feed {
            (reader.feed, reader.states_feed) = (feed * reader.modes.scale, true);
        }
        match kind {
            "CC" => self.set_pole(&said, reader),
            // The previous corner is rounded or chamfered.
            "RND" | "CHF" => count(&mut reader.arcs_unsolved, reader.line),
            "DEP" | "FPOL" => {
                reader.forget(7);
                reader.skipped.count(Skip::Words, reader.line);
            }
            _ => self.moves(kind, &said, reader),
        }
        if said.calls {
            self.cycle("M99", "", reader);
        }
        said.ends
    }

    /// Reads the words of a block.
    fn said(&mut self, rest: &str) -> Said {
        let mut said = Said::default();
        let mut valued = 0;
        let mut cursor = Cursor::new(rest.as_bytes(), 0, &self.machine.variables);
        loop {
            if cursor.is_done() {
                self.machine.valued |= valued;
                return said;
            }
            let Some(word) = WORDS.into_iter().find(|word| cursor.eat(word)) else {
                said.strange = true;
                return said;
            };
            match word {
                "FMAX" => said.rapid = true,
                "FAUTO" => said.feed = Some(f64::NAN),
                "F" if cursor.eat("MAX") => said.rapid = true,
                "F" if cursor.eat("AUTO") => said.feed = Some(f64::NAN),
                "R0" | "RL" | "RR" => {}
                "DR" => {
                    said.counter = if cursor.eat("+") {
                        Some(true)
                    } else {
                        cursor.eat("-").then_some(false)
                    }
                }
                _ => {
                    let from = cursor.at;
                    let value = cursor.operand().map(Value::or_nan);
                    let is_valued = rest.as_bytes()[from..cursor.at].contains(&b'Q');
                    valued |= match word.bytes().last() {
                        _ if !is_valued => 0,
                        Some(axis @ b'X'..=b'Z') => 1 << (axis - b'X'),
                        // A polar radius or angle.
                        _ if word.contains('P') => 7,
                        _ => 0,
                    };
                    let Some(value) = value else {
                        said.strange = true;
                        return said;
                    };
                    said.take(word, value);
                }
            }
        }
    }

    /// `CC X+10 Y+5`, `CC IX+5`; without words at the stylus position.
    fn set_pole(&mut self, said: &Said, reader: &Reader) {
        let here = reader.place.map(|x| x / reader.modes.scale);
        let alone = said.axes.iter().all(Option::is_none);
        self.pole = [0, 1, 2].map(|axis: usize| match said.axes[axis] {
            Some((x, false)) => x,
            Some((x, true)) => here[axis] + x,
            None if alone => here[axis],
            None => self.pole[axis],
        });
    }

    /// Makes the move of a block.
    fn moves(&mut self, kind: &str, said: &Said, reader: &mut Reader) {
        let mut block: Block = EMPTY;
        for (axis, given) in said.axes.iter().enumerate() {
            let Some((x, distance)) = given else { continue };
            block.given |= 1 << axis;
            block.places[axis] = *x;
            block.moved |= u8::from(*distance) << axis;
            block.computed |= u8::from(x.is_nan()) << axis;
        }
        (block.others, block.machine) = (said.others, said.machine);
        let polar = matches!(kind, "LP" | "CP" | "CTP");
        if polar {
            self.polar(said, reader, &mut block);
        }
        let arc = |counter: bool| {
            if counter {
                Motion::Counter
            } else {
                Motion::Clockwise
            }
        };
        block.once = Some(match (kind, said.counter) {
            ("C" | "CP", Some(counter)) => {
                block.center = self.pole;
                block.centered = 7;
                arc(counter)
            }
            ("CR", Some(counter)) => {
                block.radius = Some(said.arc.unwrap_or(f64::NAN));
                arc(counter)
            }
            ("L" | "LP" | "LN", _) if said.rapid => Motion::Rapid,
            _ => Motion::Straight,
        });
        block.curve = !matches!(kind, "L" | "LP" | "LN") && block.once == Some(Motion::Straight);
        if block.others {
            count(&mut reader.others, reader.line);
        }
        reader.modes.centers_absolute = true;
        if block.given != 0 {
            reader.moves(&block);
        }
    }

    /// Position of polar coordinates about the pole.
    fn polar(&self, said: &Said, reader: &Reader, block: &mut Block) {
        let [a, o, _] = reader.modes.plane.unwrap_or_default().axes();
        let here = reader.place.map(|x| x / reader.modes.scale);
        let (dx, dy) = (here[a] - self.pole[a], here[o] - self.pole[o]);
        let angle = match said.angle {
            Some((angle, false)) => angle,
            Some((angle, true)) => dy.atan2(dx).to_degrees() + angle,
            None => dy.atan2(dx).to_degrees(),
        };
        let radius = said.radius.unwrap_or(dx.hypot(dy));
        let place = [
            self.pole[a] + radius * angle.to_radians().cos(),
            self.pole[o] + radius * angle.to_radians().sin(),
        ];
        for (axis, x) in [a, o].into_iter().zip(place) {
            // Without rounding noise.
            let x = (x * 1e9).round() / 1e9;
            block.given |= 1 << axis;
            block.places[axis] = x;
            block.moved &= !(1 << axis);
            block.computed |= u8::from(x.is_nan()) << axis;
        }
        // More than a turn: the last one ends there.
        if let Some((turn, true)) = said.angle.filter(|(turn, _)| turn.abs() > 360.0) {
            block.p = Some((turn.abs() / 360.0).ceil());
        }
    }
}

impl Said {
    fn take(&mut self, word: &str, value: f64) {
        match word {
            "X" | "Y" | "Z" => {
                self.axes[usize::from(word.as_bytes()[0] - b'X')] = Some((value, false))
            }
            "IX" | "IY" | "IZ" => {
                self.axes[usize::from(word.as_bytes()[1] - b'X')] = Some((value, true))
            }
            "PR" => self.radius = Some(value),
            // An incremental radius is not followed.
            "IPR" => self.radius = Some(f64::NAN),
            "PA" => self.angle = Some((value, false)),
            "IPA" => self.angle = Some((value, true)),
            "R" => self.arc = Some(value),
            "F" => self.feed = Some(value),
            "M" => {
                self.machine |= value == 91.0 || value == 92.0;
                self.calls |= value == 99.0 || value == 89.0;
                self.ends |= value == 2.0 || value == 30.0;
            }
            "LEN" => {}
            _ => self.others = true,
        }
    }
}
