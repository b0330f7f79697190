//! Blocks of plain words: `N20 G1 X5 Y-3.2 F800`. Almost all blocks of long programs are of this form.

use crate::control::iso::codes::{Effect, effect};
use crate::control::iso::lex::head;
use crate::control::iso::script::Motion;
use crate::import::toolpath::modes::{Given, Modes};
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::words::tenths;
use crate::num::read_digits;

impl Reader {
    /// Reads a block that consists of a linear motion, positions and a feed, each at most once and with a plain number. False, without any effect, for another
    /// block or if an earlier state gives it further meaning: then it is read word by word, with the same result.
    pub(super) fn plain(&mut self, line: &[u8]) -> bool {
        if !self.takes_plain() {
            return false;
        }
        let mut rest = line;
        if matches!(line, [b'N' | b'n', ..]) {
            let head = head(line);
            // Block skip is reported.
            if head.skips {
                return false;
            }
            rest = &line[head.end..];
        }
        let (mut motion, mut feed) = (None, None);
        let (mut places, mut given) = (self.place, 0);
        while let [letter, value @ ..] = rest {
            let letter = letter.to_ascii_uppercase();
            if !matches!(letter, b'X'..=b'Z' | b'G' | b'F') {
                if !matches!(letter, b' ' | b'\t') {
                    return false;
                }
                rest = value;
                continue;
            }
            let (negative, digits) = match value {
                [b'-', digits @ ..] => (true, digits),
                [b'+', digits @ ..] => (false, digits),
                digits => (false, digits),
            };
            let Some((size, length)) = read_digits(digits) else {
                return false;
            };
            let value = if negative { -size } else { size };
            rest = &digits[length..];
            match letter {
                b'G' if motion.is_none() => match effect(self.family(), b'G', tenths(value)) {
                    Some(Effect::Motion(stays)) => motion = Some(stays),
                    _ => return false,
                },
                b'F' if feed.is_none() => feed = Some(value),
                b'X'..=b'Z' if given & 1 << (letter - b'X') == 0 => {
                    places[usize::from(letter - b'X')] = value * self.modes.scale;
                    given |= 1 << (letter - b'X');
                }
                _ => return false,
            }
        }
        let motion = motion.unwrap_or(self.modes.motion);
        // An arc has its centre or radius in other words.
        if matches!(motion, Motion::Clockwise | Motion::Counter) {
            return false;
        }
        (self.has_code, self.may_skip_next, self.modes.motion) = (true, false, motion);
        if let Some(feed) = feed {
            self.feed = feed * self.modes.scale;
        }
        if given != 0 {
            self.place = places;
            self.relative &= !given;
            self.arrives(motion);
        }
        true
    }

    /// Whether axis words are just targets, and nothing is pending for the next block.
    #[inline]
    fn takes_plain(&self) -> bool {
        let Modes {
            curve,
            given,
            absolute,
            diameter,
            polar,
            ..
        } = self.modes;
        let modes = absolute && !curve && !diameter && !polar && given == Given::Place;
        modes
            && !self.ended
            && !self.inside
            && self.lost == 0
            && self.run.is_none()
            && self.log.is_none()
    }
}
