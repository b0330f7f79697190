//! Codes whose axis words are not a position: they are skipped and reported by name.

use crate::control::iso::script::Motion;
use crate::control::native::{self, Call};
use crate::form::printable;
use crate::import::toolpath::block::{Block, UnfollowedCode, UnfollowedCount};
use crate::import::toolpath::control_kind::ControlKind;
use crate::import::toolpath::count::{Count, count};
use crate::import::toolpath::native::{letters, listed as native_call};
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::skipped::Skip;
use crate::text::{Text, text};

/// Largest number of reported names; other codes count as lines that are not understood.
const MOST_NAMES: usize = 12;

impl Reader {
    /// Skips a block whose axis words may not be a position; false if it is followed like any other.
    #[cold]
    #[inline(never)]
    pub(super) fn pass_by(&mut self, line: &[u8], block: &Block) -> bool {
        let names_axes = block.given | block.centered != 0 || block.others;
        let moves = block.motion || block.once.is_some();
        // Axis words after a motion belong to it, and an M code without axis words moves nothing.
        let led = if names_axes && !moves {
            block.leading_m_code
        } else {
            UnfollowedCode::No
        };
        // RepRapFirmware configures its probe with G31. Skip signals are P1 to P4, and P98 and P99 skip by torque.
        let is_signal = |p: f64| p < 5.0 || p == 98.0 || p == 99.0;
        let sets =
            self.frames.kind == ControlKind::RepRap || block.p.is_some_and(|p| !is_signal(p));
        if sets
            && names_axes
            && block.once == Some(Motion::MayTouch)
            && block.foreign == UnfollowedCode::No
            && !self.sinumerik
        {
            self.named(&line[block.name[0]..block.name[1]], UnfollowedCode::Sets);
            return true;
        }
        let here = self.here();
        match if block.foreign == UnfollowedCode::No {
            led
        } else {
            block.foreign
        } {
            UnfollowedCode::No => return false,
            UnfollowedCode::Computed => {
                self.modes.maybe_changed = true;
                self.forget(block.given);
                self.skipped.count(Skip::Words, self.line);
                return names_axes;
            }
            UnfollowedCode::Sets if !names_axes => return false,
            UnfollowedCode::Sets => self.forget(block.given),
            UnfollowedCode::Unknown => self.forget(7),
        }
        // Its F may have any meaning.
        if block.feed.is_some() {
            self.feed = f64::NAN;
        }
        let [begin, end] = block.name;
        let foreign = if block.foreign == UnfollowedCode::No {
            led
        } else {
            block.foreign
        };
        let name = String::from_utf8_lossy(&line[begin..end]).to_ascii_uppercase();
        if foreign == UnfollowedCode::Unknown && native::find(&name).is_some() {
            self.native(&name, letters(&line[end..]), here);
            return true;
        }
        self.named(&line[begin..end], foreign);
        true
    }

    /// Lists a call of a native cycle and reports its name.
    pub(super) fn native(&mut self, name: &str, arguments: Vec<(String, f64)>, place: [f64; 3]) {
        let call = self.listed(name, arguments, place);
        let named = call.map_or(name, |call| call.name);
        self.count_named(
            named.to_owned(),
            UnfollowedCode::Unknown,
            call.map(|call| call.title),
        );
    }

    /// Lists a native cycle whose moves were made.
    pub(super) fn listed(
        &mut self,
        name: &str,
        arguments: Vec<(String, f64)>,
        place: [f64; 3],
    ) -> Option<&'static Call> {
        let call = native_call(&mut self.path, self.line, name, arguments.clone(), place)?;
        if self.run.is_some() {
            self.wrote_by_call(call, &arguments);
        }
        Some(call)
    }

    /// Calls a native macro. Renishaw's 9810 moves to its position; the ends of the others are unknown.
    #[cold]
    pub(super) fn macro_call(&mut self, line: &[u8], block: &mut Block) {
        self.called_macro = true;
        self.renishaw = false;
        let place = self.here();
        let call = if self.okuma { "CALL O" } else { "G65 P" };
        let name = |p: f64| call.to_owned() + &crate::num::decimal(p, 0);
        let arguments = || -> Vec<(String, f64)> {
            let all = letters(&line[block.begin..]);
            all.into_iter()
                .filter(|(name, _)| name != "G" && name != "P")
                .collect()
        };
        match block.p {
            // A computed number.
            Some(p) if !p.is_finite() => {
                self.forget(7);
                self.native("G65", arguments(), place);
            }
            Some(p) if self.run.is_some() && self.makes_macro(p as u32, &arguments()) => {
                self.renishaw = true;
                self.listed(&name(p), arguments(), place);
                block.axis_words_are_data = true;
            }
            Some(p @ (9810.0 | 8810.0)) => {
                self.listed(&name(p), arguments(), place);
                self.renishaw = self.run.is_some();
                (block.axis_words_are_data, block.once) = (false, Some(Motion::Straight));
                self.feed = block.feed.map_or(self.feed, |feed| feed * self.modes.scale);
            }
            // These switch the probe, compare two features, and correct a tool: nothing moves.
            Some(p @ (9832.0 | 9833.0 | 9834.0 | 9835.0 | 8832.0 | 8833.0 | 8834.0 | 8835.0))
                if !self.path.centroid || p < 9834.0 =>
            {
                self.listed(&name(p), arguments(), place);
                self.renishaw = self.run.is_some();
                // Switching the probe keeps the outputs of the last measurement; 9834 and 9835 have outputs that are not modelled.
                if p % 1000.0 > 833.0 {
                    self.outputs.clear();
                }
            }
            Some(p) => {
                self.forget(7);
                self.native(&name(p), arguments(), place);
            }
            None => self.lose(Skip::Call, self.line),
        }
    }

    /// Counts a block that is not modelled, by the name of its code.
    pub(super) fn named(&mut self, name: &[u8], foreign: UnfollowedCode) {
        const LONGEST: usize = 12;
        let letters = name
            .iter()
            .filter(|b| !b.is_ascii_whitespace())
            .take(LONGEST);
        let name: String = letters
            .map(|b| char::from(b.to_ascii_uppercase()))
            .collect();
        self.count_named(name, foreign, None);
    }

    fn count_named(&mut self, name: String, foreign: UnfollowedCode, title: Option<&'static str>) {
        if let Some(known) = self.foreign.iter_mut().find(|known| known.name == name) {
            return count(&mut known.count, self.line);
        }
        if self.foreign.len() == MOST_NAMES {
            return self.skipped.count(Skip::Words, self.line);
        }
        let mut times = Count::default();
        count(&mut times, self.line);
        self.foreign.push(UnfollowedCount {
            name,
            foreign,
            title,
            count: times,
        });
    }
}

/// Text about such a code.
pub(super) fn by_name(named: &UnfollowedCount) -> Text {
    let (name, foreign) = (printable(&named.name), named.foreign);
    if let Some(title) = named.title {
        return text!(
            "{code} ({title}) is a native cycle: it chooses its moves, and positions after it are unknown until the program gives a number",
            name,
            title.to_owned()
        );
    }
    if foreign == UnfollowedCode::Sets {
        text!(
            "{code} moves nothing here, and the axis words beside it are not a position: its block is not followed",
            name
        )
    } else {
        text!(
            "{code} is unknown: its block is not followed, and positions after it are unknown until the program gives a number",
            name
        )
    }
}
