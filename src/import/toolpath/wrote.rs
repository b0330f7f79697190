//! Blocks, variables and calls with lasting writes: each becomes an event and changes the known coordinate system.

use crate::control::native::{Call, tool_name};
use crate::import::toolpath::block::Block;
use crate::import::toolpath::count::count;
use crate::import::toolpath::frames::{Axes, Frames, Position, Register};
use crate::import::toolpath::known::TriggerAt;
use crate::import::toolpath::reader::Reader;
use crate::import::toolpath::writes::{
    AXES, LENGTH, OFFSET, RADIUS, SHIFT, TABLE, Variable, WEAR, Write,
};

/// Largest number of listed writes.
const MOST_WRITES: usize = 10_000;

impl Reader {
    fn wrote(
        &mut self,
        kind: &'static str,
        register: String,
        axis: Option<&'static str>,
        value: f64,
    ) {
        let (moves, line) = (self.path.len(), self.line as u32);
        let Some(log) = self
            .log
            .as_mut()
            .filter(|log| log.writes.len() < MOST_WRITES)
        else {
            return;
        };
        log.writes.push(Write {
            line,
            file: 0,
            kind,
            register,
            axis,
            value: value.is_finite().then_some(value),
            guarded: Some(false),
            moves,
        });
    }

    fn wrote_axes(&mut self, kind: &'static str, register: &str, (axes, values): (Axes, Position)) {
        for axis in (0..3).filter(|axis| axes & (1 << axis) != 0) {
            self.wrote(kind, register.to_owned(), Some(AXES[axis]), values[axis]);
        }
    }

    /// `G10 L2`, `G10 L20`: without a number the active work offset.
    pub(super) fn wrote_offset(
        &mut self,
        number: Option<i32>,
        given: (Axes, Position),
        angle: Option<f64>,
    ) {
        let register = match number.or(self.frames.active()) {
            Some(number) => self.frames.kind.offset_name(number),
            None => "active".to_owned(),
        };
        self.wrote_axes(OFFSET, &register, given);
        if let Some(angle) = angle {
            self.wrote(OFFSET, register, Some(AXES[3]), angle);
        }
    }

    pub(super) fn wrote_shift(&mut self, given: (Axes, Position)) {
        self.wrote_axes(SHIFT, "G92", given);
    }

    pub(super) fn wrote_external(&mut self, given: (Axes, Position)) {
        self.wrote_axes(OFFSET, "external offset", given);
    }

    /// A write of unknown registers.
    pub(super) fn wrote_any(&mut self) {
        self.wrote(OFFSET, "?".to_owned(), None, f64::NAN);
    }

    /// `G10 L1 P5 Z…` of a LinuxCNC, `G10 L10 P5 R…` of a Fanuc.
    pub(super) fn wrote_tool(&mut self, block: &Block, l: f64, given: (Axes, Position)) {
        let tool = tool_name(block.p.unwrap_or(f64::NAN));
        // LinuxCNC with axis words, a Fanuc with R only; L1 with R is LinuxCNC's radius.
        let (axes, radius) = match l as i32 {
            1 | 10 | 11 if given.0 != 0 => (LENGTH, RADIUS),
            1 | 12 => (TABLE, RADIUS),
            10 => (TABLE, LENGTH),
            11 | 13 => (TABLE, WEAR),
            _ => (TABLE, TABLE),
        };
        self.wrote_axes(axes, &tool, given);
        if let Some(value) = block.radius {
            self.wrote(radius, tool, None, value * self.modes.scale);
        }
    }

    /// A program sets a variable that is a register of the control.
    #[cold]
    pub(super) fn writes_variable(&mut self, variable: &Variable, value: f64) {
        // In inch the unit of the number depends on the machine.
        let ambiguous = self.is_inch() && value != 0.0 && !self.sinumerik;
        let length = if ambiguous {
            f64::NAN
        } else {
            value * self.modes.scale
        };
        match variable {
            Variable::Offset(number, axis) => {
                let (number, axis) = (*number, *axis);
                let value = if axis == 3 { value } else { length };
                let register = self.frames.kind.offset_name(number);
                self.wrote(OFFSET, register, Some(AXES[axis]), value);
                self.with_frames(|frames, place| frames.write_variable(number, axis, value, place));
            }
            Variable::AnyOffset(name) => {
                self.wrote(OFFSET, name.clone(), None, f64::NAN);
                self.with_frames(|frames, place| frames.forget(7, place));
            }
            Variable::ProgramFrame => self.with_frames(Frames::lose),
            Variable::Shift(axis) => {
                self.wrote(SHIFT, "G92".to_owned(), Some(AXES[*axis]), length);
            }
            Variable::External(axis) => {
                let given = (1 << axis, [length; 3]);
                self.wrote_external(given);
                self.with_frames(|frames, place| {
                    frames.set_shift(Register::External, given, false, place);
                });
            }
            Variable::Tool(kind, name) => self.wrote(kind, name.clone(), None, length),
        }
    }

    /// Whether the program's units are inches here.
    pub(super) fn is_inch(&self) -> bool {
        match self.path.metric {
            Some(first) => first != (self.modes.scale == 1.0),
            None => false,
        }
    }

    /// `FN 17: SYSWRITE ID50 NR5 …`, `FN 27: TABWRITE 5/"X" = …`: the written value is not followed.
    #[cold]
    pub(super) fn wrote_by_function(&mut self, word: &str, rest: &str) {
        let rest = rest.strip_prefix(word).unwrap_or(rest).trim();
        let named = rest.split('=').next().unwrap_or_default().trim();
        let register = format!("{word} {}", crate::form::printable(named));
        self.wrote(TABLE, register, None, f64::NAN);
        if word == "SYSWRITE" {
            self.with_frames(|frames, place| frames.forget(7, place));
        }
    }

    /// Writes of a native call.
    #[cold]
    pub(super) fn wrote_by_call(&mut self, call: &Call, arguments: &[(String, f64)]) {
        for written in call.written(arguments) {
            let number = match written.number {
                Some(0) => Some(self.frames.number()),
                number => number,
            };
            let register = match number {
                _ if !written.register.is_empty() => written.register,
                _ if written.number == Some(0) && self.frames.active().is_none() => {
                    "active".to_owned()
                }
                Some(number) => self.frames.kind.offset_name(number),
                None => "?".to_owned(),
            };
            let one = (written.axes.count_ones() == 1)
                .then(|| AXES[written.axes.trailing_zeros() as usize]);
            if written.is_sure {
                self.wrote(written.kind, register, one, f64::NAN);
            } else {
                count(&mut self.may_write, self.line);
            }
            if written.kind == OFFSET {
                // Without a part a call finds the feature at its nominal position.
                let nominal = self
                    .run
                    .as_ref()
                    .is_some_and(|run| run.feature.is_none() && run.touch == TriggerAt::Unknown);
                self.with_frames(|frames, place| {
                    frames.measured(number, written.axes, nominal, place);
                });
            }
        }
    }

    /// P of a FluidNC in a probing block: the contact gets this number along the first named axis, in the active work offset.
    pub(super) fn writes_by_probing(&mut self, block: &Block, p: f64) {
        let Some(axis) = (0..3).find(|axis| block.given & (1 << axis) != 0) else {
            return;
        };
        let given = (1 << axis, [p * self.modes.scale; 3]);
        self.wrote_offset(None, given, None);
        self.with_frames(|frames, place| frames.write_position(None, given.0, given.1, place));
    }
}
