//! Codes whose axis words are no place: they are passed by, and named.

use crate::control::iso::script::Motion;
use crate::form::printable;
use crate::import::toolpath::block::{Block, Foreign};
use crate::import::toolpath::count::{Count, count};
use crate::import::toolpath::reader::Reader;
use crate::text::{Text, text};

/// So many codes are named; others are lines that are not understood.
const MOST_NAMES: usize = 12;

impl Reader {
    /// Passes by a block whose axis words may be no place; false where it is followed as any other.
    #[cold]
    #[inline(never)]
    pub(super) fn pass_by(&mut self, line: &[u8], block: &Block) -> bool {
        let names_axes = block.given | block.centered != 0 || block.others;
        let moves = block.motion || block.once.is_some();
        // Axis words behind a motion are the motion's, and an M code without axis words moves none.
        let led = if names_axes && !moves { block.led } else { Foreign::No };
        match if block.foreign == Foreign::No { led } else { block.foreign } {
            Foreign::No => return false,
            Foreign::Sets if !names_axes => return false,
            Foreign::Sets => self.forget(block.given),
            Foreign::Unknown => self.forget(7),
        }
        // Its F may be anything.
        if block.feed.is_some() {
            self.feed = f64::NAN;
        }
        let [begin, end] = block.name;
        let foreign = if block.foreign == Foreign::No { led } else { block.foreign };
        self.named(&line[begin..end], foreign);
        true
    }

    /// A macro of the control's own is called. Renishaw's 9810 goes to the position that it gives, and where the others end is not known.
    #[cold]
    pub(super) fn macro_call(&mut self, block: &mut Block) {
        self.called_out = true;
        let name = |p: f64| "G65P".to_owned() + &crate::num::decimal(p, 0);
        match block.p {
            Some(9810.0 | 8810.0) => {
                (block.elsewhere, block.once) = (false, Some(Motion::Straight));
                self.feed = block.feed.map_or(self.feed, |feed| feed * self.modes.scale);
            }
            // They switch the probe on and off.
            Some(p @ (9832.0 | 9833.0)) => self.named(name(p).as_bytes(), Foreign::Sets),
            Some(p) => {
                self.forget(7);
                self.named(name(p).as_bytes(), Foreign::Unknown);
            }
            None => self.lose(self.line),
        }
    }

    /// Counts a block that is not followed, by the name of its code.
    pub(super) fn named(&mut self, name: &[u8], foreign: Foreign) {
        const LONGEST: usize = 12;
        let letters = name.iter().filter(|b| !b.is_ascii_whitespace()).take(LONGEST);
        let name: String = letters.map(|b| char::from(b.to_ascii_uppercase())).collect();
        if let Some((.., times)) = self.foreign.iter_mut().find(|(known, ..)| *known == name) {
            return count(times, self.line);
        }
        if self.foreign.len() == MOST_NAMES {
            return count(&mut self.skipped, self.line);
        }
        let mut times = Count::default();
        count(&mut times, self.line);
        self.foreign.push((printable(&name), foreign, times));
    }
}

/// What is said of such a code.
pub(super) fn by_name(name: String, foreign: Foreign) -> Text {
    if foreign == Foreign::Sets {
        text!("{code} moves nothing here, and the axis words beside it are not a position: its block is not followed", name)
    } else {
        text!(
            "{code} is not known here: its block is not followed, and positions after it are not known until a number is given",
            name
        )
    }
}
