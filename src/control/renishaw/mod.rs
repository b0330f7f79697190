//! Renishaw's macros for Fanuc and compatible controls: their moves, and the programs that call them.

pub mod macros;
pub(super) mod post;
mod serve;

use crate::control::own::OwnCycles;
use crate::path::Stored;

/// Native cycles of a control with this notation of work offsets and results.
pub const fn cycles(offset: fn(i32) -> f64, name: fn(Stored) -> String) -> OwnCycles {
    let word = |number, letter: &str| format!("P{number} {letter}");
    OwnCycles {
        plan: serve::serve,
        rerun: serve::rerun,
        followed: false,
        offset,
        word,
        name,
        corrects_tools: true,
        several: serve::SEVERAL,
    }
}
